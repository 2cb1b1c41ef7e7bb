"""Limits of reports: which terms an equation has, what is rounding in a sum, from which margin on something is ok."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.analysis.batch import kernel_export
from dalembert.analysis.methods.applied_forces import Action
from dalembert.errors import ModelError
from dalembert.reports.design.design_report import worst_position
from dalembert.reports.design.motion_part import _chart, _positions, _ranges
from dalembert.reports.design.verdict import (
    judged,
    least_place,
    most_place,
    not_judged,
    put_used,
    tightest_place,
    together,
)
from dalembert.reports.sections import methods
from dalembert.reports.sections.sources import WIDEST, _rows, _tables
from dalembert.reports.sections.terms import (
    PARALLEL,
    About,
    ActionVector,
    EquationSetting,
    UnknownLine,
    _remove_noise,
    about,
    join_numbers,
    join_signed,
)
from dalembert.reports.sheet import ReportSheet, SheetTable
from dalembert.reports.space_sections.space_closure import Side, _lines
from dalembert.units import Units
from dalembert.views.notation import Figures, Notation

NAN, INF = math.nan, math.inf
RNG = np.random.default_rng(5)


def setting(dimension: int, torque: int = 1, floor: float = 1e-9, units: Any = None) -> Any:
    """The setting of the equations of some link, about a point that is not the origin."""
    mechanism = SimpleNamespace(dimension=dimension, loads={})
    r: Any = SimpleNamespace(mechanism=mechanism, joints=("A",), unknown_loads=())
    shown: Any = Figures(units, Notation(torque=torque))
    shown.turning_symbol = lambda a: "M_{A}"
    place = np.array([0.5, -0.25, 0.125][:dimension])
    return EquationSetting(r, 0, shown, np.eye(dimension), About("G", place), (floor, 2 * floor, floor))


def action(force: Any, couple: Any = 0.0, at: Any = (0.0, 0.0), kind: Any = "joint") -> Action:
    return Action(
        "A", kind, "", "rod", None, np.array([at], float), np.array([force], float), np.array([couple], float)
    )


AT = (np.zeros(3), np.zeros(3), np.ones(3))
"""A force, a couple and a place that do not matter."""


def total(terms: Any) -> float:
    return float(sum(t.value for t in terms))


@pytest.mark.parametrize("torque", [1, -1])
@pytest.mark.parametrize("units", [None, Units(length="mm", force="kN")])
def test_the_terms_of_a_plane_force_sum_to_its_components_and_its_moment(torque: int, units: Any) -> None:
    """F_x, F_y, and R_x F_y - R_y F_x + M as the reader counts moments, in the reader's units, with their signs."""
    s = setting(2, torque, units=units)
    force, moment = s.shown.size("force"), s.shown.size("moment")
    for _ in range(4):
        f, at, m = RNG.normal(size=2), RNG.normal(size=2), float(RNG.normal())
        v = ActionVector(s, action(f, m, at), f, np.array([m]))
        assert [total(v.force(k)) for k in (0, 1)] == pytest.approx(f / force)
        r = at - s.about.place
        known = (r[0] * f[1] - r[1] * f[0] + m) * torque
        assert total(v.moment(2)) == pytest.approx(known / abs(moment))
        (couple,) = (t for t in v.moment(2) if t.letters[1] == "M_{A}")
        for t in (*v.force(0), *v.force(1), couple):
            assert t.numbers == (t.value < 0, s.number(abs(t.value)))
        levers = [t for t in v.moment(2) if t.letters[1].startswith("R_")]
        assert [t.letters[0] for t in levers] == ([False, True] if torque > 0 else [True, False])
        assert v.turned
        assert v.counts


def test_the_terms_of_a_force_in_space_sum_to_its_vector_product_with_the_arm() -> None:
    s = setting(3)
    for _ in range(4):
        f, at, m = RNG.normal(size=3), RNG.normal(size=3), RNG.normal(size=3)
        v = ActionVector(s, action(f, m, at), f, m)
        line = UnknownLine(s, "F", 3.0, "force", f / np.linalg.norm(f), m, action(f, m, at))
        spun = UnknownLine(s, "M", -2.0, "moment", np.zeros(3), m / np.linalg.norm(m), action(f, m, at))
        r = at - s.about.place
        for k in range(3):
            assert total(v.force(k)) == pytest.approx(f[k])
            assert total(v.moment(k)) == pytest.approx(np.cross(r, f)[k] + m[k])
            assert total(line.force(k)) == pytest.approx(3 * f[k] / np.linalg.norm(f))
            (part,) = line.force(k)
            assert part.letters == (f[k] < 0, f"{s.number(abs(f[k]) / np.linalg.norm(f))} F")
            assert total(line.moment(k)) == pytest.approx(3 * (np.cross(r, f / np.linalg.norm(f))[k] + m[k]))
            assert spun.force(k) == []
            assert total(spun.moment(k)) == pytest.approx(-2 * m[k] / np.linalg.norm(m))
    for axis in range(3):  # along an axis: by its arms
        for sense in (1.0, -1.0):
            e, at = sense * np.eye(3)[axis], np.array([2.0, 3.0, 5.0])
            line = UnknownLine(s, "F", 3.0, "force", e, np.zeros(3), action(e, np.zeros(3), at))
            for k in range(3):
                moment = line.moment(k)
                assert total(moment) == pytest.approx(3 * np.cross(at - s.about.place, e)[k])
                assert [t.letters[1][:3] for t in moment] == ["R_{"] * (k != axis)
            (term,) = line.force(axis)
            assert term.letters == (sense < 0, "F")
            assert term.numbers == (sense < 0, "3.000")


def test_what_is_rounding_has_no_term() -> None:
    """At 1e-9 N, 2e-9 N m and 1e-9 m it is nothing, just above it counts; a reaction is also written where it is 0."""
    s = setting(2)
    on = s.about.place
    for size, counts in ((0.9e-9, False), (1.0e-9, False), (1.1e-9, True)):
        for sign in (1.0, -1.0):
            load = ActionVector(
                s, action((sign * size, 0), 0, on, "load"), np.array([sign * size, 0]), np.zeros(1)
            )
            assert bool(load.force(0)) is counts
            assert load.values[0] == (sign * size if counts else 0.0)
            assert load.counts is counts
            couple = ActionVector(s, action((0, 0), 0, on, "load"), np.zeros(2), np.array([2 * sign * size]))
            assert couple.turned is counts
            assert bool(couple.moment(2)) is counts
    for size, counts in ((0.9e-9, False), (1.1e-9, True)):
        for sign in (1.0, -1.0):
            aside = ActionVector(
                s,
                action((0.0, 4.0), 0, on + np.array([sign * size, 0.0]), "load"),
                np.array([0.0, 4.0]),
                np.zeros(1),
            )
            assert bool(aside.moment(2)) is counts
    clockwise = setting(2, -1)
    for size, counts in ((1.9e-9, False), (2.1e-9, True)):
        couple = ActionVector(clockwise, action((0, 0), 0, on, "load"), np.zeros(2), np.array([size]))
        assert couple.turned is counts
    joint = ActionVector(s, action((0, 0), 0, on + 1.0), np.zeros(2), np.zeros(1))
    assert joint.force(0)[0].numbers == (False, "0")
    assert [len(joint.force(0)), len(joint.force(1)), len(joint.moment(2))] == [1, 1, 2]
    space = setting(3)
    three = ActionVector(space, action(*AT), np.array([0.0, 2.0, 0.0]), np.zeros(3))
    assert [len(three.force(k)) for k in range(3)] == [0, 1, 0]
    sought = ActionVector(space, action(*AT), np.array([0.0, 2.0, 0.0]), np.zeros(3), "force")
    assert [len(sought.force(k)) for k in range(3)] == [1, 1, 1]
    assert [len(sought.moment(k)) for k in range(3)] == [2, 2, 2]
    turning = ActionVector(space, action(*AT), np.zeros(3), np.zeros(3), "moment")
    assert [[t.numbers for t in turning.moment(k)] for k in range(3)] == [[(False, "0")]] * 3
    for value, shown in ((0.9e-9, 0.0), (-0.9e-9, 0.0), (1.1e-9, 1.1e-9), (-1.1e-9, -1.1e-9)):
        lone = UnknownLine(
            space,
            "F",
            value,
            "force",
            np.eye(3)[0],
            np.zeros(3),
            action(*AT),
        )
        assert lone.value == shown
        assert lone.force(0)[0].numbers[0] is (shown < 0)
        lone = UnknownLine(
            space,
            "M",
            2 * value,
            "moment",
            np.zeros(3),
            np.eye(3)[0],
            action(*AT),
        )
        assert lone.value == 2 * shown


def test_direction_cosines_lose_their_rounding() -> None:
    for x, y in (
        (0.9, 0.0), (-0.9, 0.0), (1.1, 1.1 * PARALLEL), (-1.1, -1.1 * PARALLEL),
    ):  # fmt: skip
        assert _remove_noise(np.array([x * PARALLEL])) == [y]
        assert _remove_noise(np.array([1 + x * PARALLEL])) == [1.0 if abs(x) < 1 else 1 + x * PARALLEL]
        assert _remove_noise(np.array([-1 + x * PARALLEL])) == [-1.0 if abs(x) < 1 else -1 + x * PARALLEL]
    assert [about("A", "x"), about("AB", "x"), about("pin", "x"), about("pin", "")] == [
        "Ax",
        "ABx",
        "pin,x",
        "pin",
    ]
    assert join_signed([]) == "0"
    assert join_signed([(True, "a"), (True, "b"), (False, "c")]) == "−a − b + c"
    assert join_numbers(["−1", "2", "−3"]) == "−1 + 2 − 3"


def test_a_loop_closes_within_a_billionth_of_its_sides() -> None:
    """1 and -1 but for 0.9e-9 of the larger side, 2: nothing; for 1.1e-9 of it the rest is written."""
    shown: Any = Figures(None, Notation())
    shown.least = {"length": 1e-12}
    shown.link = lambda link: "2"
    for off, rest in (
        (0.0, "0"),
        (1.8e-9, "0"),
        (2.2e-9, "2.200e−09"),
        (-2.2e-9, "−2.200e−09"),
        (-1.8e-9, "0"),
    ):
        far, back, rest_of = np.array([1.0, -2.0, 0.0]), np.array([-1.0, 1.0, 0.0]), np.array([0.0, 1.0, 0.0])
        sides = [
            Side("r_{AB}", "rod", (far, far, far)),
            Side("r_{BC}", "arm", (back + np.array([off, 0.0, -5e-13]), back, back)),
            Side("r_{CA}", "arm", (rest_of, back, back)),
        ]
        letters, x, y, z = (line.letters for line in _lines(sides, "length", 0, shown))
        assert letters == "r_{AB} + r_{BC} + r_{CA} = 0"
        assert x.endswith(f'= {rest} "m"')
        assert y == 'y: quad −2.000 + 1.000 + 1.000 = 0 "m"'
        assert z == 'z: quad 0 + 0 + 0 = 0 "m"'
    still = Side("r_{AB}", "rod", (far, np.array([0.9e-12, 0.0, -0.9e-12]), far))
    assert _lines([still], "length", 1, shown) == []
    slow = Side("r_{AB}", "rod", (far, np.array([0.0, 0.0, -1.1e-12]), far))
    assert len(_lines([slow], "length", 1, shown)) == 4


@pytest.mark.parametrize(
    ("margin", "state", "factor"),
    [
        *((1.0, "ok", "1"), (0.9999, "exceeded", "1"), (1.0001, "ok", "1")),
        *((INF, "ok", "∞"), (0.0, "exceeded", "0"), (NAN, "not judged", "–")),
    ],
)
def test_a_limit_is_kept_where_the_value_just_reaches_it(margin: float, state: str, factor: str) -> None:
    verdict = judged("pin A", margin)
    assert (verdict.state, verdict.factor) == (state, factor)
    assert verdict.remark == ("its value is not known" if math.isnan(margin) else "")
    assert not_judged("pin A", "no limit").row == ("pin A", "not judged", "", "–", "", "no limit")


def test_places_of_extremes_are_the_first_and_zero_where_nothing_is_known() -> None:
    values = np.array([3.0, NAN, 7.0, -1.0, 7.0, -1.0])
    assert (least_place(values), most_place(values)) == (3, 2)
    nothing = np.full(3, NAN)
    assert (least_place(nothing), most_place(nothing), tightest_place(nothing)) == (0, 0, 0)
    assert tightest_place(np.array([NAN, 5.0, 2.0, INF, 0.0])) == 4
    assert together("abc") == "a, b, c"
    assert together("abcdefghijkl") == ", ".join("abcdefghijkl")
    assert together("abcdefghijklm") == ", ".join("abcdefghijkl") + " and 1 more"
    sheet = ReportSheet("")
    put_used(sheet, ("a", "b", "c", "d"), [("1", "", "–", "x"), ("2", "–", "", "")])
    (table,) = (b for b in sheet.blocks if isinstance(b, SheetTable))
    assert [*table.heads] == ["a", "d"]


class Answer(SimpleNamespace):
    """A result by its named numbers."""

    def __getitem__(self, name: str) -> Any:
        return np.array(self.values[name], float)


@pytest.mark.parametrize(
    ("values", "peak"),
    [
        ({"effort.O": [1, 2], "reaction.A": [[1, 2], [3, 4]]}, "peak effort.O"),
        ({"effort.O": [0, 2], "reaction.A": [[1, 2], [3, 4]]}, "peak effort.O"),
        ({"effort.O": [2, -2], "reaction.A": [[1, 2], [3, 4]]}, "peak reaction.A"),  # of one size everywhere
        ({"effort.O": [0, 0], "reaction.A": [[1, 2], [1, 4]]}, "peak reaction.A"),
        ({"effort.O": [NAN, NAN], "reaction.A": [[1, 2], [1, 2]]}, None),
        ({"effort.O": [2, 2], "reaction.A": [[1, 2], [1, -2]]}, None),
        ({"effort.O": [2, 2], "reaction.A": [[0, 0], [0, 3]]}, "peak reaction.A"),
    ],
)
def test_the_position_drawn_is_the_peak_of_the_first_force_that_changes(
    values: Any, peak: str | None
) -> None:
    r: Any = Answer(drives=("O",), joints=("A",), values=values)
    assert worst_position(r) == peak


def test_gaps_of_polygons_are_parts_of_the_largest_force(monkeypatch: pytest.MonkeyPatch) -> None:
    some = [
        action((3.0, 4.0)),
        action((-3.0, -1.0)),
        Action("B", "joint", "", "arm", None, *(np.zeros((1, 2)),) * 2, np.zeros(1)),
    ]
    monkeypatch.setattr(methods, "actions", lambda r: tuple(some))
    mechanism = SimpleNamespace(dimension=2)
    checked = {"residual": np.array([2e-16]), "power_balance": np.array([0.0]), "mobility": None}
    r = SimpleNamespace(links=("rod", "arm"), mechanism=mechanism, **checked)
    c: Any = SimpleNamespace(r=r, k=0, shown=SimpleNamespace(heading=lambda link: f"2 {link}"))
    sheet = ReportSheet("")
    methods.checks(sheet, c)
    words = " ".join(str(getattr(b, "text", "")) for b in sheet.blocks)
    assert "over the largest force: 2e-16; power balance: 0." in words
    assert "Closure gaps of the force polygons over their largest force: 2 rod 6e-01, 2 arm 0." in words


def test_columns_of_one_joint_stay_in_one_table_of_nine() -> None:
    column: Any = ("F", np.zeros(2), "force")
    assert WIDEST == 9
    assert [len(t) for t in _tables([[column] * 3] * 3)] == [9]
    assert [len(t) for t in _tables([[column] * 3] * 4)] == [9, 3]
    assert [len(t) for t in _tables([[column] * 4] * 3)] == [8, 4]
    assert [len(t) for t in _tables([[column] * 12, [column]])] == [12, 1]
    assert _tables([]) == [[]]


def test_a_source_that_does_nothing_has_no_row_but_a_load_has_one() -> None:
    shown: Any = Figures(None, Notation())
    shown.least = {"force": 1e-9}
    r = SimpleNamespace(mechanism=SimpleNamespace(dimension=2, loads={"P": 1}))
    c: Any = SimpleNamespace(r=r, shown=shown, notation=Notation())
    column: Any = ("F", np.array([0.0, -1.1e-9, 0.9e-9, -0.9e-9, 5.0]), "force")
    rows = _rows(c, ("P", "a", "b", "c"), [column])
    assert [row[0] for row in rows] == ["$P$", "a", "sum"]
    assert rows[0][1] == "0"
    assert rows[-1][1] == "5.000"


def test_a_joint_that_does_not_move_has_no_range() -> None:
    """Within 1e-12 of a metre or radian, or of its place where that is more."""
    found = {
        "A": [0.0, 0.9e-12], "B": [0.0, -1.1e-12], "C": [1e6, 1e6 + 0.5e-6], "D": [-1e6, -1e6 - 2e-6], "E": [NAN, NAN],
        "F": [3.0, NAN, 1.0], "G": [-1e6, -1e6 - 0.5e-6],
    }  # fmt: skip
    r = SimpleNamespace(
        compiled=SimpleNamespace(freedoms=[(j, "slide") for j in found]), drives=(),
        freedom=lambda joint, freedom: (np.array(found[joint]),),
    )  # fmt: skip
    c: Any = SimpleNamespace(r=r, text=lambda kind, x: (kind, x))
    rows = _ranges(c)
    assert [row[0] for row in rows] == ["B", "D", "F"]
    assert rows[-1][2:] == [("length", 1.0), ("length", 3.0), ("length", 2.0)]


def test_curves_that_do_not_change_are_not_drawn() -> None:
    axis: Any = SimpleNamespace(chart=lambda kind, curves, title, words: (kind, list(curves), title, words))
    curves = {
        "a": np.array([-2.0, -2.0]), "b": np.array([0.0, 1.9e-9]), "c": np.array([0.0, -2.1e-9]), "d": np.full(2, NAN),
        "e": np.array([NAN, 0.0, 1.0]),
    }  # fmt: skip
    assert list(_chart(axis, "angular_speed", curves, "links", 1)) == [
        ("angular_speed", ["c", "e"], "Speed of the links", "angular speed")
    ]
    many = {str(n): np.array([0.0, 1.0]) for n in range(8)}
    assert [len(c[1]) for c in _chart(axis, "length", many, "slides", 0)] == [6, 2]  # type: ignore[index]
    assert not list(_chart(axis, "length", {}, "slides", 0))


def test_equilibrium_holds_below_a_billionth_of_the_forces() -> None:
    none, first = [0.0, 0.0], "exceeded"
    for residual, balance, state in (
        *(([0.9e-9, NAN], [0.0, NAN], "ok"), ([1.1e-9, 0.0], none, first), ([-1.1e-9, 0.0], none, first)),
        *((none, [-2e-9, 0.0], first), (none, [2e-12, 0.0], "ok"), ([NAN, NAN], [NAN, NAN], "not judged")),
    ):
        r = SimpleNamespace(
            status=("ok", "singular"), ok=np.array([True, False]), problems=lambda: [("2", "singular", "It jams.")],
            residual=np.array(residual), power_balance=np.array(balance),
        )  # fmt: skip
        c: Any = SimpleNamespace(r=r)
        solved, bad, holds = _positions(c)
        assert (solved.state, solved.value, solved.remark) == ("not judged", "1 of 2", "see below")
        assert (bad.item, bad.state, bad.remark) == ("position 2", "exceeded", "It jams")
        assert holds.state == state
    r = SimpleNamespace(
        status=("singular",), ok=np.array([True]), problems=lambda: [("1", "singular", "It jams.")],
        residual=np.array([2e-10, -3e-10, NAN]), power_balance=np.array([1e-11, NAN, -4e-11]),
    )  # fmt: skip
    _, bad, holds = _positions(SimpleNamespace(r=r))  # type: ignore[arg-type]
    assert bad.item == "singular"
    assert holds.value == "3e-10, power balance 4e-11"


@pytest.mark.parametrize("export", ["c_source", "casadi_function", "wasm_module"])
def test_a_reduced_analysis_is_not_exported(export: str) -> None:
    k: Any = SimpleNamespace(reduce="max")
    with pytest.raises(ModelError, match="a reduced analysis cannot be exported; compile it without reduce"):
        getattr(kernel_export, export)(k, "name") if export != "wasm_module" else kernel_export.wasm_module(
            k, None
        )
