"""How near is near enough, at each limit from both sides; what is nothing beside the machine; marks of each outcome."""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.grading.figure import NOTHING, floor
from dalembert.grading.file_answers import computed_text
from dalembert.grading.marking.rubric import SHARES, Rubric, load_rubric, read_rubric
from dalembert.grading.marking.student_marks import NAMED, Mark
from dalembert.grading.quantities import Series
from dalembert.grading.tolerance import Closeness, relative
from dalembert.grading.value_errors import of_units
from dalembert.grading.wrong.wrong_problems import _scaling
from dalembert.units import Units

DEG = math.pi / 180


def close(given: Any, near: float, halves: tuple[float, ...] = (), kind: str = "force", **more: Any) -> Any:
    return Closeness(np.array(given, float), kind, near, halves, more.pop("polar", False), **more)


@pytest.mark.parametrize(
    ("figure", "off", "holds"),
    [
        (close([100], 0.005), 0.499, True),
        (close([100], 0.005), -0.499, True),
        (close([100], 0.005), 0.501, False),
        (close([100], 0.005), -0.501, False),
        (close([-100], 0.005), 0.501, False),
        (close([100], 0.005, (0.9,)), 0.9, True),  # half a unit of its last digit
        (close([100], 0.005, (0.9,)), 0.901, False),
        (close([100], 0.005, (5.0,)), 0.999, True),  # coarser than two digits excuses nothing more
        (close([-100], 0.005, (5.0,)), -0.999, True),
        (close([100], 0.005, (5.0,)), 1.001, False),
        (close([100], 0.0001, (0.9,), stated=True), 0.02, False),  # only what is stated
        (close([100], 0.02, stated=True), 1.99, True),
        (close([100], 0.02, stated=True), -2.01, False),
        (close([0], 0.5), 0.1, False),  # of nothing there is no part
        (close([0], 0.5, floor=0.2), 0.1, True),
        (close([0], 0.5, floor=0.2), 0.3, False),
    ],
)
def test_a_number_is_near_up_to_its_limits(figure: Closeness, off: float, holds: bool) -> None:
    assert figure.holds(figure.given + off) is holds


def test_rounded_is_within_half_a_unit_of_each_number() -> None:
    assert close([100], 0.005, (0.9,)).is_rounded(np.array([100.9]))
    assert not close([100], 0.005, (0.2,)).is_rounded(np.array([100.21]))
    assert not close([100], 0.005).is_rounded(np.array([100.0]))
    pair = close([30, -40], 0.0, (0.2, 0.05))
    assert pair.holds(np.array([30.2, -39.95]))
    assert not pair.holds(np.array([30.2, -39.94]))
    assert not pair.holds(np.array([30.21, -39.95]))


@pytest.mark.parametrize(
    ("value", "near", "halves", "holds"),
    [
        (-3.1, 0.0832, (), True),  # 0.0832 rad from 3.1 to -3.1 through pi
        (-3.1, 0.0831, (), False),
        (3.1 + 4 * math.pi, 1e-9, (), True),
        (3.1 + 0.5 * DEG, 0.0, (0.5 * DEG,), True),
        (3.1 - 0.5 * DEG, 0.0, (5 * DEG,), True),
        (3.1 + 0.51 * DEG, 0.0, (5 * DEG,), False),  # in tens of degrees it is not excused
        (3.1 + 0.3 * DEG, 0.0, (0.25 * DEG,), False),
    ],
)
def test_an_angle_is_near_round_the_turn(
    value: float, near: float, halves: tuple[float, ...], holds: bool
) -> None:
    assert close([3.1], near, halves, "angle").holds(np.array([value])) is holds


@pytest.mark.parametrize(
    ("size", "turned", "holds"),
    [
        (100.0, 0.0, True),
        (100.9, 0.5, True),
        (99.1, -0.5, True),
        (101.01, 0.0, False),
        (98.99, 0.0, False),
        (100.0, 0.501, False),
        (100.0, -0.501, False),
        (100.0, 360.0, True),
    ],
)
def test_a_polar_figure_is_near_in_size_and_in_direction(size: float, turned: float, holds: bool) -> None:
    """100 @ 170, of which the size may be off by 1 %, the direction by half a degree."""

    def at(r: float, degrees: float) -> Any:
        return np.array([r * math.cos(degrees * DEG), r * math.sin(degrees * DEG)])

    figure = close(at(100, 170), 0.0005, (5.0, 5 * DEG), polar=True)
    assert figure.holds(at(size, 170 + turned)) is holds


def test_how_far_a_vector_is_off() -> None:
    figure = close([3, 4], 0.005)
    assert figure.off(np.array([3.03, 4.04])) == pytest.approx(0.01)
    assert figure.off(np.array([4, -3])) == pytest.approx(math.sqrt(2))
    assert close([0, 0], 0.005).off(np.array([3, 4])) == 1.0
    angles = close([1, -2], 0.005, kind="angle")
    assert angles.off(np.array([1.1, -2.5])) == pytest.approx(0.5)
    assert angles.off(np.array([1.7, -2.5])) == pytest.approx(0.7)


def test_what_is_nothing_beside_the_machine() -> None:
    """Of each kind a part of the largest force, rate or length; angular rates count by the machine's length."""
    r = da.dynamics(da.load(examples()["four_bar"]), positions=5)
    length = r.compiled.layout.length
    twist, gain = (np.abs(a) for a in (r.twist_array, r.acceleration_array))
    force = max(np.abs(r.force_array).max(), np.abs(r.moment_array).max() / length)
    speed = max(twist[..., :2].max() / length, twist[..., 2].max())
    fastest = max(gain[..., :2].max() / length, gain[..., 2].max(), speed**2)
    for kind, size in (
        ("force", force),
        ("moment", force * length),
        ("length", length),
        ("speed", speed * length),
        ("angular_speed", speed),
        ("acceleration", fastest * length),
        ("angular_acceleration", fastest),
        ("angle", 0.0),
        ("power", 0.0),
    ):
        assert floor(r, kind) == pytest.approx(NOTHING * size), kind


KEY = """variant,quantity,of,on,value,unit,marks
01,effort,O2,,243.2376,lbf*in,4
01,reaction,A,coupler,154.8052 @ -139.678,lbf,2
"""
SHEETS = {
    "right": ("efforts: {O2: 243.2}", 0),
    "rounding": ("efforts: {O2: 240}", 0),
    "sign": ("efforts: {O2: -243.2}", 0),
    "unit": ("efforts: {O2: 243200}", 0),
    "unknown": ("efforts: {O2: 17}", 0),
    "unreadable": ("efforts: {O2: about three}", 0),
    "missing": ("reactions: {A: 154.8 @ -139.7}", 0),
    "part": ("reactions: {A: 154.8}", 1),
}


@pytest.mark.parametrize("outcome", SHEETS)
def test_every_outcome_keeps_its_share(outcome: str, tmp_path: Path) -> None:
    """By default, and by a rubric that gives it another share; the marks are those of the key."""
    text, place = SHEETS[outcome]
    (tmp_path / "key.csv").write_text(KEY)
    (tmp_path / "answers").mkdir()
    (tmp_path / "answers" / "ann.yaml").write_text(text)
    default = [(None, SHARES[outcome])] if outcome in SHARES else []  # a cell without a reading waits
    for rubric, share in (*default, (read_rubric({"share": {outcome: 0.3}}), 0.3)):
        (student,) = da.grade(tmp_path / "answers", tmp_path / "key.csv", rubric).students
        mark = student.marks[place]
        most = (4.0, 2.0)[place]
        assert (mark.outcome, mark.most) == ("right" if outcome == "part" else outcome, most)
        assert mark.marks == pytest.approx(share * most)
        assert student.most == 6.0
        assert student.total == pytest.approx(sum(m.marks for m in student.marks))


def test_a_part_that_is_nearly_right_keeps_both_shares(tmp_path: Path) -> None:
    (tmp_path / "key.csv").write_text(KEY)
    (tmp_path / "answers").mkdir()
    (tmp_path / "answers" / "ann.yaml").write_text("reactions: {A: 153}")
    (student,) = da.grade(tmp_path / "answers", tmp_path / "key.csv").students
    assert student.marks[1].outcome == "rounding"
    assert student.marks[1].marks == pytest.approx(2 * 0.875 * 0.5)
    assert student.marks[1].sentence.endswith("; only its size")


def test_shares_by_the_words_of_a_mistake() -> None:
    rubric = Rubric(mistakes={"Moment Arm": 0.25}, marks={"effort": 3.0, "default": 2.0})
    said = "the moment arm of F3 is wrong"
    shares = {kind: rubric.share(kind, said) for kind in SHARES}
    assert shares == SHARES | dict.fromkeys(NAMED, 0.25)
    assert rubric.share("named", "another") == 0.5
    assert (rubric.marks_of("effort"), rubric.marks_of("reaction")) == (3.0, 2.0)
    assert Rubric().marks_of("reaction") == 1.0
    assert read_rubric({"marks": {"default": 1e6}, "share": {"sign": 1.0}}).share("sign", "") == 1.0


MIXED = {
    "inches and feet": (0.3048 / 0.0254, {"length", "moment", "speed", "acceleration"}),
    "millimetres and inches": (0.0254 / 1e-3, {"length", "moment", "speed", "acceleration"}),
    "centimetres and metres": (100.0, {"length", "moment", "speed", "acceleration"}),
    "millimetres and centimetres": (10.0, {"length", "moment", "speed", "acceleration"}),
    "pounds and newtons": (0.45359237 * 9.80665, {"force", "moment"}),
    "g: kilograms and newtons": (9.80665, {"force", "moment"}),
    "g in ft/s2: pounds and slugs": (9.80665 / 0.3048, {"force", "moment"}),
    "g in in/s2: pounds and blobs": (9.80665 / 0.0254, {"force", "moment"}),
    "rpm and rad/s": (60 / math.tau, {"angular_speed"}),
    "degrees and radians": (360 / math.tau, {"angular_speed", "angular_acceleration"}),
}
"""What one unit is of the other, and of which kinds of numbers that is offered."""


def test_units_are_mixed_up_either_way_by_what_one_is_of_the_other() -> None:
    kinds = set().union(*(some for _, some in MIXED.values()))
    for kind in sorted(kinds | {"power"}):
        found = list(of_units(Series(kind, np.zeros(1)), np.array(6.0)))
        assert {h.kind for h in found} == {"unit"}
        sizes: dict[str, set[float]] = {}
        for h in found:
            sizes.setdefault(h.sentence.removeprefix("units are mixed up: "), set()).add(float(h.value))
        own = {words: factor for words, (factor, some) in MIXED.items() if kind in some}
        own |= {"a factor of 1000 (mm and m, N and kN)": 1000.0, "a factor of 2": 2.0}
        assert sizes.keys() == own.keys(), kind
        for words, factor in own.items():
            assert sorted(sizes[words]) == pytest.approx(sorted([6 * factor, 6 / factor]), rel=1e-5), words


def test_components_that_are_rounding_are_shown_as_zero_whatever_the_sign_of_the_others() -> None:
    published: Any = SimpleNamespace(unit="N", polar=False)
    units = da.four_bar().units
    assert computed_text(np.array([1e-14, -5.0]), published, "force", units) == "[0, -5]"
    assert computed_text(np.array([-5.0, -1e-10, 3.0]), published, "force", units) == "[-5, -1e-10, 3]"


@pytest.mark.parametrize("factor", [0.0, -1.0])
@pytest.mark.parametrize(("part", "of"), [("couple", "inertia"), ("force", "mass")])
def test_an_inertia_couple_and_force_are_those_of_their_link(part: str, of: str, factor: float) -> None:
    r = da.dynamics(da.load(examples()["four_bar"]))
    change = _scaling(r, [f"inertia {part} of coupler"], factor)
    assert change is not None
    before, after = r.compiled.forcing.inertia, change(r.compiled).forcing.inertia
    for name in ("inertia", "mass"):
        was, now = getattr(before, name), getattr(after, name)
        mine = (np.array(r.links) == "coupler").reshape(-1, *[1] * (np.ndim(was) - 1))
        assert np.any(was[r.links.index("coupler")])
        assert np.array_equal(now, np.where(mine & (name == of), factor * was, was))


def test_one_mistake_costs_half_a_figure_at_least_and_its_cap_at_most(tmp_path: Path) -> None:
    """0.2 + 0.1 of figures of 4 and 2 is raised to half of the 2; 12 of 16 is lowered to 8."""

    def left(*rows: tuple[str, str, float, float]) -> list[float]:
        marks = [Mark("effort", "", "", outcome, words, got, most) for outcome, words, got, most in rows]
        return [m.marks for m in Rubric().capped(marks)]

    raised = left(("datum", "x", 3.8, 4), ("datum", "x", 1.9, 2), ("right", "", 2, 2))
    assert raised == pytest.approx([4 - 2 / 3, 2 - 1 / 3, 2])
    lowered = left(*[("concept", "y", 0.0, 4.0)] * 3, ("right", "", 4, 4))
    assert lowered == pytest.approx([4 / 3] * 3 + [4])
    (tmp_path / "rubric.yaml").write_text("share: {named: 0.6, datum: 0.9}\ncap: 0.25\n", encoding="utf-8")
    rubric = load_rubric(tmp_path / "rubric.yaml")
    kept = {k: rubric.shares[k] for k in ("named", "datum", "concept", "sign")}
    assert (kept, rubric.cap) == ({"named": 0.6, "datum": 0.9, "concept": 0.6, "sign": 0.5}, 0.25)


def test_a_tolerance_may_be_nothing_but_not_less() -> None:
    assert relative("0 N", 200.0, "force", Units()) == relative("0 %", 200.0, "force", Units()) == 0.0
    assert relative("2 deg", 200.0, "angle", Units()) == pytest.approx(math.radians(2))
    assert relative("3 N", 0.0, "force", Units()) == 3.0
    for below, said in (
        ("-1 N", "'-1 N' is below 0; write one of 0 or more"),
        ("-1 %", "not a tolerance in percent"),
    ):
        with pytest.raises(da.ModelError, match=said):
            relative(below, 200.0, "force", Units())
