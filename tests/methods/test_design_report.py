"""The design report: every limit of a file judged with its margin, all else named, for every bundled machine."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.cli import main
from dalembert.errors import ModelError
from dalembert.machine.members.member_table import member_table
from dalembert.machine.output.sizes_over_cycle import rms
from dalembert.reports.design.design_report import PARTS, design_sheet, parts_of
from dalembert.reports.design.element_parts import element_parts
from dalembert.reports.design.motion_part import motion_part
from dalembert.reports.design.power_parts import balance_part, motor_part
from dalembert.reports.design.strength_parts import member_part
from dalembert.reports.design.summary_page import summary
from dalembert.reports.design.verdict import DesignContext, DesignPart, DesignVerdict, judged, together
from dalembert.reports.sheet import Drawings, Heading, Paragraph, ReportSheet, SheetTable
from tests.elements.test_cylinders import BOOM, SIZES
from tests.tiers import sampled

BUNDLED = cases() | examples()
QUICK = ("boom", "two_drives", "truss", "fr-05-clamp-tightened", "brk-1-simple-band-brake")
SLOW = ("cam_and_follower", "four_cylinder")
"""Their own commands take seconds."""
STEEL = {"rectangle": ["20 mm", "40 mm"], "elasticity": "206 GPa"}


def verdicts(r: da.Result) -> dict[str, DesignVerdict]:
    return {v.item: v for part in member_part(DesignContext(r, 0, da.Notation())) for v in part.verdicts}


@pytest.mark.parametrize("name", sampled(QUICK, BUNDLED.keys() - SLOW))
def test_every_bundled_machine_has_a_report(name: str) -> None:
    r = da.solve(da.load(BUNDLED[name]))
    sheet = design_sheet(r)
    summary = next(b for b in sheet.blocks if isinstance(b, SheetTable))
    titles = [b.text for b in sheet.blocks if isinstance(b, Heading) and b.level == 1]
    assert titles[:3] == ["Summary", "Title block", "Given"]
    assert [row[0] for row in summary.rows] == titles[3:]
    for b in sheet.blocks:
        for row in b.rows if isinstance(b, SheetTable) else ():
            assert not any(cell in ("nan", "inf", "None") or "nan " in cell for cell in row), row
    named = [v for part in parts_of(r) for v in part.verdicts if v.state == "not judged"]
    assert all(v.remark for v in named)


def loaded(stress: float) -> Any:
    m = da.load(examples()["four_bar"])
    sections = {f"links.{link}.section": STEEL | {"yield_stress": stress} for link in ("coupler", "rocker")}
    return da.dynamics(m.with_values(sections), positions=24)


def test_a_stress_is_judged_on_both_sides_of_its_limit() -> None:
    largest = member_table(loaded(1e9)).stress["coupler"].largest
    low, high = (verdicts(loaded(largest * share))["yield of coupler"] for share in (0.999, 1.001))
    assert (low.state, high.state) == ("exceeded", "ok")
    assert [low.margin, high.margin] == pytest.approx([0.999, 1.001], rel=1e-6)
    assert low.at == high.at != ""


def test_what_has_no_data_is_named_with_the_reason() -> None:
    found = verdicts(loaded(1e9))
    assert found["crank"].remark == "the file has no section for them"
    assert found["fatigue of coupler"].remark == "no endurance and ultimate stress in the section"
    assert found["crank"].state == "not judged"


def test_the_summary_counts_what_is_exceeded() -> None:
    r = loaded(1e6)
    every = [v for part in parts_of(r) for v in part.verdicts]
    count = {state: sum(v.state == state for v in every) for state in ("ok", "exceeded")}
    text = str(da.report(r, design=True))
    assert count["exceeded"] >= 2
    assert f"{count['exceeded']} of {sum(count.values())} limits are exceeded." in text
    least = min(v.margin for v in every if v.state == "exceeded")
    assert f"{least:.3g}" in text.partition("2 Title block")[0]
    k = int(
        np.argmax(np.hypot(*r["reaction.B"].T))
    )  # the worst position of a joint is that of its largest force
    at = f"{math.degrees(r.drive_position('O2')[k]):.0f}° (no. {k + 1})"
    assert at in next(line for line in text.splitlines() if line.startswith("reaction.B "))


@pytest.mark.parametrize(
    ("margins", "said"),
    [
        ([2.0, 1.0, 3.0], "All 3 limits that can be checked are met."),
        ([1.0], "The one limit that can be checked is met."),
        ([math.nan], "No limit can be checked. 1 item is not judged; it is named with the reason."),
        ([0.5, 2.0], "1 of 2 limits is exceeded."),
        (
            [0.5, 0.9, 2.0, math.nan, math.nan],
            "2 of 3 limits are exceeded. 2 items are not judged; they are named with the reason.",
        ),
    ],
)
def test_the_verdict_of_all_in_one_sentence(margins: list[float], said: str) -> None:
    part, sheet = DesignPart("Strength"), ReportSheet("t")
    part.verdicts += [judged(f"item {k}", margin) for k, margin in enumerate(margins)]
    summary(sheet, DesignContext(da.dynamics(da.four_bar(positions=3)), 0, da.Notation()), [part])
    assert sheet.blocks[1] == Paragraph(said)


@pytest.mark.parametrize("sense", [1, -1])
def test_the_motor_is_judged_where_its_torque_is_nearest_to_its_limit(sense: int) -> None:
    """Whichever sense of turning its stall torque and free speed are given for."""
    # dwells need torques of rounding alone there, whose margins of 1e16 are no scale for those of the strokes
    m = da.load(BUNDLED["carton_pusher"])
    tree = m.to_tree()
    tree["drives"]["O"]["motor"] |= {"stall": f"{2 * sense} N*m", "no_load": f"{2850 * sense} rpm"}
    r = da.solve(da.mechanism(tree))
    (part,) = motor_part(DesignContext(r, 0, da.Notation()))
    line = 2 * (1 - 30 * 60 / 2850)  # stall 2 N m, no load 2850 rpm, ratio 30, 60 rpm
    effort = r.effort("O")
    torque = effort / 30 / np.where(effort > 0, 0.94, 1 / 0.94)
    assert part.verdicts[0].margin == pytest.approx(line / np.abs(torque).max(), rel=1e-6)
    assert part.verdicts[0].at == DesignContext(r, 0, da.Notation()).at(int(np.abs(torque).argmax()))


def test_counterweights_are_for_whole_turns_and_a_sliding_drive_has_a_force() -> None:
    r = da.solve(da.load(BUNDLED["excavator"]))
    with pytest.raises(ModelError, match="'boom_cylinder' slides"):
        list(balance_part(DesignContext(r, 0, da.Notation())))
    b = da.balance(r, ["boom"])
    assert {c.name: c.kind for c in b.columns()}["before.effort.boom_cylinder"] == "force"
    assert f"rms drive force {rms(r.effort('boom_cylinder')):.6g} N" in " ".join(str(b).split())


def test_each_link_has_its_curve_in_one_chart() -> None:
    links = [f"bar{k}" for k in range(8)]
    ends = {link: ([link, links[k - 1]] if k else [link, "ground"]) for k, link in enumerate(links)}
    law = {"type": "harmonic", "from": 0, "to": 1, "duration": 1, "count": 5}
    m = da.Mechanism(
        links={
            "ground": {"points": {"bar0": [0, 0]}},
            **{link: {"points": {link: [0, 0], f"bar{k + 1}": [1, 0]}} for k, link in enumerate(links)},
        },
        joints={link: {"type": "pin", "links": both} for link, both in ends.items()},
        drives={link: {"law": law} for link in links},
    )
    (part,) = motion_part(DesignContext(da.solve(m), 0, da.Notation()))
    (figure,) = (b for b in part.sheet.blocks if isinstance(b, Drawings))
    assert [(scene.title, list(scene.numbers)) for scene in figure.scenes] == [
        (f"{word} of the links", some)
        for word in ("Speed", "Acceleration")
        for some in (links[:6], links[6:])
    ]


def test_a_limit_without_a_number_is_not_judged() -> None:
    assert judged("x", math.nan).state == "not judged"
    assert [judged("x", margin).state for margin in (1.0, math.nextafter(1.0, 0.0), math.inf)] == [
        "ok",
        "exceeded",
        "ok",
    ]


def test_the_command_goes_over_the_turn_of_a_drive_that_moves(tmp_path: Any) -> None:
    out = tmp_path / "four_bar.txt"
    assert main(["report", str(examples()["four_bar"]), "--design", "-o", str(out)]) == 0
    text = out.read_text(encoding="utf-8")
    assert "72, 72 of them solved" in text
    assert all(title in text for title, _ in PARTS if title not in ("Machine elements", "Pins"))


def test_of_many_names_a_dozen_is_written() -> None:
    names = [f"J{k}" for k in range(1, 15)]
    assert together(names[:12]) == "J1, J2, J3, J4, J5, J6, J7, J8, J9, J10, J11, J12"
    assert together(names) == "J1, J2, J3, J4, J5, J6, J7, J8, J9, J10, J11, J12 and 2 more"


@pytest.mark.parametrize(
    ("closed", "stroke", "state"),
    [
        *(("1000 mm", "400 mm", "ok"), ("999.999 mm", "400 mm", "ok"), ("1000.001 mm", "400 mm", "exceeded")),
        *(("700 mm", "300 mm", "ok"), ("700 mm", "299.999 mm", "exceeded"), ("700 mm", "300.001 mm", "ok")),
    ],
)
def test_a_cylinder_may_stand_at_the_ends_of_its_stroke(closed: str, stroke: str, state: str) -> None:
    """It is 1000 mm long; at either end rounding is no reason."""
    text = BOOM.replace(SIZES, f"{SIZES}, closed: {closed}, stroke: {stroke}")
    (part,) = element_parts(DesignContext(da.statics(da.loads(text)), 0, da.Notation()))
    (verdict,) = (v for v in part.verdicts if v.item == "stroke of C")
    assert (verdict.state, verdict.value) == (state, "1000 mm to 1000 mm")
