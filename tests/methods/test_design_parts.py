"""Parts of a design report: which verdict each has, on what, with which reason; the summary and the worst positions."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.errors import AnalysisError, ModelError
from dalembert.reports.design import design_report, given_parts, strength_parts, worst_positions
from dalembert.reports.design.force_part import _above, _extreme
from dalembert.reports.design.given_parts import stated
from dalembert.reports.design.power_parts import _motor
from dalembert.reports.design.strength_parts import _bearing, _bolt, _stress
from dalembert.reports.design.summary_page import _in_one_sentence, _named, _row
from dalembert.reports.design.verdict import (
    DesignContext,
    DesignPart,
    DesignVerdict,
    attempted,
    judged,
    not_judged,
    put_verdicts,
)
from dalembert.reports.sheet import Drawings, Heading, ReportSheet, SheetTable
from dalembert.units import KINDS

NAN, INF = math.nan, math.inf
C: Any = SimpleNamespace(
    text=lambda kind, value: f"{value:g} {kind}", at=lambda k: f"no. {k + 1}", r=SimpleNamespace(status=("ok", "ok")),
    notation=SimpleNamespace(units="file"),
)  # fmt: skip


def rows(verdicts: Any) -> list[tuple[str, ...]]:
    return [(v.item, v.state, v.value, v.factor, v.at, v.remark) for v in verdicts]


def bearing(**more: Any) -> Any:
    b = {
        "radial": np.array([3.0, 7.0, 5.0]),
        "bearing": SimpleNamespace(rating=1.0),
        "static_safety": 2.5,
        "hours": 12345.6,
        "sized": False,
        "pressure": np.array([1.0, 4.0, 9.0]),
    }
    return SimpleNamespace(loads={"A": SimpleNamespace(**{**b, **more})})


def test_a_bearing_is_judged_at_rest_and_its_life_and_pressure_are_told() -> None:
    life = "the file requires no life"
    assert rows(_bearing(C, bearing(), "A")) == [
        ("bearing A, C0 over the load", "ok", "7 force", "2.5", "no. 2", ""),
        ("life of bearing A", "not judged", "1.235e+04 h", "–", "", life),
    ]
    assert rows(_bearing(C, bearing(static_safety=None, hours=INF), "A")) == [
        ("bearing A, at rest", "not judged", "", "–", "no. 2", "the bearing has no static rating"),
        ("life of bearing A", "not judged", "–", "–", "", life),
    ]
    pressure = (
        "pressure of bearing A",
        "not judged",
        "9 pressure",
        "–",
        "no. 2",
        "the file has no limit of it",
    )
    for none in (None, SimpleNamespace(rating=None)):
        assert rows(_bearing(C, bearing(bearing=none, sized=True), "A")) == [pressure]
    assert len(rows(_bearing(C, bearing(sized=True), "A"))) == 3


def test_a_bolt_is_judged_where_it_is_nearest_to_yielding() -> None:
    p: Any = SimpleNamespace(
        bending=np.array([100.0, 50.0, NAN]),
        peak_shear=np.array([10.0, 60.0, 20.0]),
        safety=np.array([1.5, 1.25, NAN]),
        joint="A",
    )
    assert rows([_bolt(C, p)]) == [("yield of the bolt of A", "ok", "103.923 pressure", "1.25", "no. 2", "")]
    p.safety = np.array([0.5, 1.25, NAN])
    assert rows([_bolt(C, p)]) == [
        ("yield of the bolt of A", "exceeded", "103.923 pressure", "0.5", "no. 1", "")
    ]
    p.safety = np.full(3, NAN)
    (row,) = rows([_bolt(C, p)])
    assert row == ("bolt of A", "not judged", "103.923 pressure", "–", "no. 2", "its pin has no yield_stress")


def stress(**more: Any) -> Any:
    fatigue = SimpleNamespace(mean=3.0, amplitude=4.0, safety=more.pop("tired", 0.75))
    s = {
        "largest": 50.0,
        "position": 1,
        "safety": 2.0,
        "section": SimpleNamespace(notch=None),
        "fatigue": lambda: fatigue,
    }
    return SimpleNamespace(stress={"rod": SimpleNamespace(**{**s, **more})})


def test_a_link_is_judged_for_yield_and_over_several_positions_for_fatigue() -> None:
    first = ("yield of rod", "ok", "50 pressure", "2", "no. 2", "")
    second = ("fatigue of rod", "exceeded", "3 pressure ± 4 pressure", "0.75", "", "Goodman, no notches")
    assert rows(_stress(C, stress(), "rod")) == [first, second]
    some = rows(_stress(C, stress(safety=None, tired=None, section=SimpleNamespace(notch=1.5)), "rod"))
    assert some == [
        ("yield of rod", "not judged", "50 pressure", "–", "no. 2", "no yield_stress in the section"),
        (
            "fatigue of rod",
            "not judged",
            second[2],
            "–",
            "",
            "no endurance and ultimate stress in the section",
        ),
    ]
    notched = rows(_stress(C, stress(section=SimpleNamespace(notch=1.5)), "rod"))
    assert notched[1][5] == "Goodman, with its notches"
    one: Any = SimpleNamespace(text=C.text, at=C.at, r=SimpleNamespace(status=("ok",)))
    assert rows(_stress(one, stress(), "rod")) == [first]
    unknown = ("stress of rod", "not judged", "", "–", "", "its inner forces are not known")
    assert rows(_stress(C, stress(largest=NAN), "rod")) == [unknown]


@pytest.mark.parametrize(
    ("allowed", "margin", "at", "remark"),
    [
        ([30.0, 24.0, NAN], 0.0, 2, True),
        ([30.0, 24.0, 60.0], 1.2, 1, False),
        ([30.0, 20.0, 60.0], 1.0, 1, False),
        ([3.0, 24.0, 60.0], 0.3, 0, True),
    ],
)
def test_a_motor_is_judged_where_its_limit_is_nearest(
    allowed: Any, margin: float, at: int, remark: bool
) -> None:
    need, direct = SimpleNamespace(ratio=3.0, rms=7.0), SimpleNamespace(ratio=1.0, rms=9.0)
    torque = np.array([-10.0, 20.0, -30.0])
    choice: Any = SimpleNamespace(
        needs={"given": need, "direct": direct}, curve=1, drive="O", torque=lambda n: torque * (n == 3.0),
        allowed=lambda n: np.array(allowed),
    )  # fmt: skip
    limit, rms = rows(_motor(C, choice))
    assert limit[0] == "torque of the motor of O at its speed"
    assert float(limit[3]) == pytest.approx(margin)
    assert (limit[2], limit[4]) == (f"{abs(torque[at]):g} moment", f"no. {at + 1}")
    assert bool(limit[5]) is remark
    assert rms[:3] == ("rms torque of the motor of O", "not judged", "7 moment")
    choice.curve = None
    assert rows(_motor(C, choice)) == []
    choice.curve, choice.needs = 1, {"direct": direct}
    choice.torque, choice.allowed = lambda n: torque * (n == 1.0), lambda n: np.full(3, 60.0)
    assert rows(_motor(C, choice))[1][2] == "9 moment"


def test_pins_without_sizes_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    joints = {
        "A": SimpleNamespace(pin=1, hinge=True),
        "B": SimpleNamespace(pin=None, hinge=True),
        "S": SimpleNamespace(hinge=False),
        "D": SimpleNamespace(hinge=True),
    }
    units: list[str] = []
    monkeypatch.setattr(
        strength_parts, "pin", lambda r, joint: SimpleNamespace(contents=lambda to: units.append(to) or [])
    )
    monkeypatch.setattr(strength_parts, "_bolt", lambda c, p: judged("bolt", 2.0))
    for reader, printed in (("SI", "SI"), ("file", "file")):
        c: Any = SimpleNamespace(
            r=SimpleNamespace(joints=tuple(joints), mechanism=SimpleNamespace(joints=joints)),
            notation=SimpleNamespace(units=reader),
        )
        (part,) = strength_parts.pin_part(c)
        assert rows(part.verdicts)[1] == (
            "B, D",
            "not judged",
            "",
            "–",
            "",
            "the file has no pin sizes for them",
        )
        assert units.pop() == printed
    c.r.joints = ("S",)
    assert list(strength_parts.pin_part(c)) == []


# what all parts share


def test_a_part_has_its_verdicts_and_its_headings_one_level_lower() -> None:
    part, sheet = (
        DesignPart("Pins", [judged("a", 2.0, "3 N"), not_judged("b", "no limit", at="here")]),
        ReportSheet(""),
    )
    part.sheet.heading("Inner", 1)
    part.sheet.text("words")
    part.sheet.blocks.append(Drawings(()))
    part.put_on(sheet)
    title, table, inner, _, drawn = sheet.blocks
    assert (title, inner) == (Heading("Pins"), Heading("Inner", 2))
    assert isinstance(drawn, Drawings)
    assert drawn.columns == 2
    assert isinstance(table, SheetTable)
    assert table.heads == ("Item", "Verdict", "Value", "Limit / value", "At", "Remark")
    assert table.rows == (("a", "ok", "3 N", "2", "", ""), ("b", "not judged", "", "–", "here", "no limit"))
    assert table.words
    sheet = ReportSheet("")
    put_verdicts(sheet, [judged("a", 2.0)])
    assert isinstance(sheet.blocks[0], SheetTable)
    assert sheet.blocks[0].heads == ("Item", "Verdict", "Limit / value")
    put_verdicts(sheet, [])
    assert len(sheet.blocks) == 1


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (ModelError("it is open", "close it"), "it is open; close it"),
        (ModelError("it is open", ""), "it is open"),
        (AnalysisError("no"), "no"),
    ],
)
def test_a_part_that_cannot_be_made_says_why(error: Exception, said: str) -> None:
    def find(c: Any) -> Any:
        yield DesignPart("first")
        raise error

    first, second = attempted(C, "Motor", find)
    assert (first.title, second.title) == ("first", "Motor")
    assert rows(second.verdicts) == [("Motor", "not judged", "", "–", "", said)]


def test_a_context_writes_numbers_and_positions() -> None:
    r: Any = SimpleNamespace(status=("ok",))
    assert DesignContext(r, 0, C.notation).at(0) == ""
    to = SimpleNamespace(quantity=lambda kind, x: f" {x:g} N*m ", number=lambda kind, x: f"-{x:g}")
    c: Any = SimpleNamespace(to=to)
    assert (DesignContext.text(c, "moment", 3.0), DesignContext.text(c, "moment", INF)) == ("3 N·m", "–")
    assert (DesignContext.number(c, "moment", NAN), DesignContext.number(c, "moment", 3.0)[-1]) == ("–", "3")
    assert (_above(3.0, 2.0), _above(2.0, 2.0), _above(1.0, 2.0)) == (3.0, 0.0, 0.0)
    assert _extreme(C, "force", -5.0, 2) == ["-5 force", "no. 3"]
    assert _extreme(SimpleNamespace(text=C.text, at=lambda k: ""), "force", -5.0, 2) == ["-5 force", "–"]  # type: ignore[arg-type]


def test_a_row_of_the_summary_is_the_worst_of_its_section() -> None:
    some = [
        judged("a", 0.5, at="x"),
        judged("b", 3.0),
        judged("c", 0.25, at="y"),
        not_judged("d", "no"),
        DesignVerdict("e", "exceeded"),
    ]
    assert _row("Pins", some) == ["Pins", "exceeded", "0.25", "c", "y", "4 of 5"]
    assert _row("Pins", [judged("a", 7.0), judged("b", 3.0)]) == ["Pins", "ok", "3", "b", "–", "2 of 2"]
    assert _row("Pins", [judged("a", 7.0), DesignVerdict("e", "exceeded")]) == [
        "Pins",
        "exceeded",
        "–",
        "e",
        "–",
        "2 of 2",
    ]
    assert _row("Pins", [not_judged("d", "no")]) == ["Pins", "not judged", "–", "–", "–", "0 of 1"]
    assert _row("Pins", []) == ["Pins", "–", "–", "–", "–", "–"]
    named = [
        not_judged("d", "no limit; x"),
        not_judged("Pins", "no data"),
        not_judged("e", "no limit; x"),
        not_judged("f", ""),
    ]
    assert _named("Pins", "not judged", named) == "Pins, not judged: d, e: no limit; no data; f."
    assert _named("Pins", "exceeded", []) == ""
    assert _in_one_sentence([DesignPart("a", some)]) == (
        "3 of 4 limits are exceeded. 1 item is not judged; it is named with the reason."
    )


def test_the_worst_positions_are_the_most_extreme_of_each_word(monkeypatch: pytest.MonkeyPatch) -> None:
    def extreme_of(of: str, word: str, value: float, kind: str, position: int = 1) -> Any:
        return SimpleNamespace(of=of, word=word, value=value, kind=kind, position=position)

    some = [
        extreme_of(f"reaction.{n}", "peak", v, "force")
        for n, v in zip("ABCDEF", (3.0, 9.0, 5.0, 1.0, 7.0, 4.0), strict=True)
    ]
    some += [
        extreme_of(f"normal.{n}", "min", v, "length")
        for n, v in zip("PQRST", (3.0, -9.0, 5.0, 1.0, 0.5), strict=True)
    ]
    kept = [e.of for e in worst_positions._few(some)]
    assert kept[:4] == ["reaction.B", "reaction.C", "reaction.E", "reaction.F"]
    assert kept[4:] == ["normal.P", "normal.R", "normal.S", "normal.T"]
    values = {
        "effort.O": np.array([0.0, -8.0]),
        "reaction.A": np.array([[1.0, 2.0], [3.0, -4.0]]),
        "power.O": np.array([0.0, 1e-10]),
        "normal.w": np.array([2.0, 1.0]),
        "power.P": np.array([0.0, 5e-1]),
        "load.X": np.array([0.0, NAN]),
    }
    found = [
        extreme_of("effort.O", "peak", 8.0, "moment"),
        extreme_of("reaction.A", "peak", 5.0, "force"),
        extreme_of("power.O", "peak", 1e-10, "power"),
        extreme_of("power.P", "peak", 0.5, "power"),
        extreme_of("normal.w", "min", 1.0, "force"),
        extreme_of("load.X", "peak", 2.0, "force"),
    ]
    monkeypatch.setattr(worst_positions, "sought", lambda c: iter(found))
    monkeypatch.setattr(worst_positions, "quantity", lambda r, of: SimpleNamespace(values=values[of]))
    assert worst_positions.worst_rows(C) == [
        ["effort.O", "largest", "-8 moment", "no. 2"],
        ["reaction.A", "largest", "5 force", "no. 2"],
        ["power.P", "largest", "0.5 power", "no. 2"],
        ["normal.w", "smallest", "1 force", "no. 2"],
        ["load.X", "largest", "2 force", "no. 2"],
    ]


def test_data_of_a_design_are_stated_in_the_units_of_the_reader() -> None:
    parameter = SimpleNamespace(kind="length", value=0.25)
    bare = SimpleNamespace(kind="", value=0.25)
    m = SimpleNamespace(parameters={"wide": parameter, "n": bare})
    c: Any = SimpleNamespace(
        text=lambda kind, x: f"{x:g} {kind}", r=SimpleNamespace(mechanism=m, status=("ok",))
    )
    assert stated(
        c, {"rectangle": ["0.012 m", "wide"], "yield_stress": f"235000000.0 {KINDS['pressure'].si}"}
    ) == ("rectangle [0.012 length, 0.25 length], yield stress 2.35e+08 pressure")
    assert [stated(c, x) for x in (7, "n", "3 apples", "5 N", "12 kg m", [{"a": 1}, {"b": 2}])] == [
        "7", "n", "3 apples", "5 force", "12 kg m", "[a 1; b 2]",
    ]  # fmt: skip
    assert stated(c, {"values": list(range(13)), "few": list(range(12))}).startswith(
        "values 13 values, few [0, 1, "
    )
    tree = {
        "links": {"a": {"section": {"circle": "0.05 m"}, "mass": 3}, "b": "x"},
        "drives": {"O": {"motor": {"stall": 2}}},
    }
    m.to_tree = lambda: tree
    sheet = ReportSheet("")
    given_parts.given_parts(sheet, c)
    (table,) = sheet.blocks
    assert isinstance(table, SheetTable)
    assert table.rows == (("a", "section", "circle 0.05 length"), ("O", "motor", "stall 2"))
    c.r.status, c.at, c.k = ("ok", "ok"), (lambda k: f"30° (no. {k + 1})"), 1
    sheet = ReportSheet("")
    given_parts.given_parts(sheet, c)
    said = "Motion of the drives, loads and drawing: at 30° (no. 2), of 2 positions."
    assert getattr(sheet.blocks[0], "text", "") == said
    assert len(design_report.PARTS) == 11
