"""Members and columns at the limits of what is told apart: loose or held, straight or bent, Euler or Johnson."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.machine.members.column_loads import (
    column_space,
    critical_load,
    effective_length,
    is_loose,
    johnson,
    within,
)
from dalembert.machine.members.end_conditions import end_words
from dalembert.machine.members.link_balance import LinkBalance, Wrench, acting
from dalembert.machine.members.mass_along import mass_layout
from dalembert.machine.members.member_forces import ORDER, _residual, forces_inside, kind_of
from dalembert.machine.members.straight_members import beyond, members_of, straight
from dalembert.machine.members.struts import rod_of
from tests.machine.test_member_buckling import COLUMN, ENDS


def test_johnson_takes_over_just_where_both_loads_are_half_of_the_yield() -> None:
    area, limit = 2e-4, 300e6
    half = area * limit / 2
    assert johnson(half, area, limit) == (half, "Euler")
    for euler, words in (
        (half * (1 - 1e-9), "Euler"),
        (half * (1 + 1e-9), "Johnson"),
        (1.5 * half, "Johnson"),
    ):
        load, word = johnson(euler, area, limit)
        assert word == words
        assert load == pytest.approx(euler if word == "Euler" else 2 * half - half**2 / euler, rel=1e-12)
    assert johnson(100 * half, area, None) == (100 * half, "Euler")
    assert johnson(1e12 * half, area, limit)[0] == pytest.approx(2 * half)


def test_a_loose_column_has_an_effective_length_without_end() -> None:
    assert effective_length(0.0, 5.0, 2.0) == math.inf
    assert effective_length(math.pi**2 * 5.0 / 0.7**2 / 4, 5.0, 2.0) == pytest.approx(0.7)
    assert effective_length(1e-12, 5.0, 2.0) == pytest.approx(math.pi / 2 * math.sqrt(5e12))


RIGID = np.array([[1.0, 0, 1, 0], [0, 1, 1, 1]]).T
"""Motions y, y' of both ends of a bar of one unit that bend nothing."""


@pytest.mark.parametrize(("bent", "loose"), [(0.0, True), (1e-11, True), (1e-7, False), (1e-2, False)])
def test_a_motion_that_bends_a_little_holds_a_column(bent: float, loose: bool) -> None:
    for k in (0, 1):
        motion = RIGID[:, [k]] + bent * np.array([[0.0, 1, 0, -1]]).T
        motion = motion / np.linalg.norm(motion)
        assert is_loose(motion, [1.0]) is loose
        assert (critical_load([2.0], [[3.0]], motion * np.array([[2.0, 1, 2, 1]]).T) == 0) is loose
    assert not is_loose(np.zeros((4, 0)), [1.0])
    assert is_loose(np.eye(4), [1.0])
    assert is_loose(column_space(RIGID), [1.0])


def test_a_motion_of_both_planes_is_of_one_where_the_other_rests() -> None:
    y, z = np.array([0.0, 1, 0, 0, 0, 0, 0, 0]), np.array([0.0, 0, 0, 0, 0, 0, 0, 1])
    for other, one in ((0.0, 1), (1e-12, 1), (1e-6, 0)):
        free = np.stack([y + other * z], axis=1)
        assert within(free, 0).shape == (4, one)
        assert within(free[[4, 5, 6, 7, 0, 1, 2, 3]], 1).shape == (4, one)
        both = np.stack([y + other * z, z], axis=1)
        assert within(both, 0).shape == (4, 1)
        assert within(both, 1).shape == (4, 1)
    assert np.abs(within(np.stack([y, z], axis=1), 0)) == pytest.approx(np.array([[0, 1.0, 0, 0]]).T)


def test_directions_that_differ_by_rounding_are_one() -> None:
    x, y = np.eye(5)[:2]
    for off, count in ((0.0, 1), (1e-10, 1), (1e-7, 2)):
        for size in (1.0, 1e3):
            assert column_space(size * np.stack([x, x + off * y], axis=1)).shape == (5, count)
    assert column_space(1e-7 * x[:, None]).shape == (5, 1)
    assert column_space(1e-11 * x[:, None]).shape == (5, 0)  # below what counts as a motion at all
    assert column_space(np.zeros((5, 0))).shape == (5, 0)


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ([0, 0, 0, 0], ("fixed", "fixed")),
        ([0, 1, 1, 0], ("pinned", "guided")),
        ([1, 1, 0, 1e-6], ("free", "fixed")),
        ([1e-3, 0, 0, 1e-3], ("guided", "pinned")),
    ],
)
def test_ends_are_named_by_what_is_held(rows: Any, words: Any) -> None:
    assert end_words(np.array(rows, float)[:, None]) == words
    inner = np.array([*rows[:2], 1, 1, *rows[2:]], float)[:, None]
    assert end_words(inner) == words
    assert end_words(-inner) == words
    assert end_words(np.hstack([0 * inner, inner])) == words


@pytest.mark.parametrize(("tilt", "turned"), [(0.0, False), (1e-11, False), (1e-7, True)])
def test_a_member_along_z_has_its_y_axis_along_y(tilt: float, turned: bool) -> None:
    e = straight(("A", "B"), np.zeros(3), np.array([tilt, 0.0, 2.0]))
    assert e.axes[1] == pytest.approx([0, 1, 0])
    aside = straight(("A", "B"), np.zeros(3), np.array([0.0, tilt, 2.0]))
    assert aside.axes[1] == pytest.approx([-1.0, 0, 0] if turned else [0, 1, 0], abs=1e-6)
    assert np.linalg.det(aside.axes) == pytest.approx(1.0)


BAR = """
gravity: none
links:
  ground: {points: {O: [0, 0], T: [1, 0]}}
  bar: {points: {O: [0, 0], T: [1, 0], F: [0.5, %r], %s}%s}
joints: {O: {type: pin, links: [ground, bar]}, T: {type: slot, links: [ground, bar], direction: 0}}
loads: {F: {type: force, on: bar, at: F, value: [0, -12 N]}, P: {type: force, on: bar, at: T, value: [%r, 0]}}
"""


def bar(aside: float = 0.0, more: str = "G: [0.2, 0]", link: str = "", push: float = 0.0) -> Any:
    return da.statics(da.loads(BAR % (aside, more, link, push)))


@pytest.mark.parametrize(
    ("aside", "named"), [(0.0, False), (5e-7, False), (-5e-7, False), (2e-6, True), (-1e-5, True)]
)
def test_a_load_beside_its_member_by_more_than_a_millionth_has_a_bracket(aside: float, named: bool) -> None:
    f = da.member_forces(bar(aside), "bar")
    assert f.brackets == ({"F": pytest.approx(abs(aside))} if named else {})
    assert f.at(0.5, side="before")["bending"] == pytest.approx(3.0)


def test_places_of_a_member_end_with_it() -> None:
    f = da.member_forces(bar(), "bar")
    assert f.at([0.0, 1.0])["shear"].ravel() == pytest.approx([6, -6])
    assert f.at([0.5, 0.5 - 1e-13, 0.5 + 1e-13])["shear"].ravel() == pytest.approx([-6, -6, -6])
    assert f.at([0.5 - 1e-9, 0.5 + 1e-9])["shear"].ravel() == pytest.approx([6, -6])
    assert f.at(0.5, side="before")["shear"] == pytest.approx(6)
    for wrong in (-1e-9, 1 + 1e-9):
        with pytest.raises(ModelError, match="is not along member O-T"):
            f.at(wrong)
    assert sorted({*f.curve().jumps.tolist()}) == pytest.approx([0.0, 0.5, 1.0])


@pytest.mark.parametrize(("off", "straight_"), [(1e-11, True), (1e-7, False)])
def test_joints_within_rounding_of_a_line_have_one_member(off: float, straight_: bool) -> None:
    joints = (
        "joints: {O: {type: pin, links: [ground, bar]}, T: {type: slot, links: [ground, bar], direction: 0},"
        " G: {type: pin, links: [bar, arm]}}"
    )
    text = (BAR % (0.0, f"G: [0.2, {off!r}]", "", 0.0)).replace(BAR.splitlines()[5], joints)
    text = text.replace("joints:", "  arm: {points: {G: [0, 0], H: [0.1, 0]}}\njoints:", 1)
    text += "drives: {G: {position: 0}}\n"
    r = da.statics(da.loads(text))
    if straight_:
        found = da.member_forces(r, "bar")
        assert found.curve().member.length == pytest.approx(1.0)
        assert found.brackets == {}
    else:
        with pytest.raises(ModelError, match="the joints of link 'bar' do not lie on one line"):
            da.member_forces(r, "bar")


ROD = "section: {rectangle: [20 mm, 30 mm], elasticity: 210 GPa}"


@pytest.mark.parametrize(
    ("across", "two_force"),
    [(0.0, True), (1e-10, True), (-1e-10, True), (1e-6, False), (-1e-6, False), (0.1, False)],
)
def test_a_column_that_is_bent_by_more_than_rounding_is_no_two_force_member(
    across: float, two_force: bool
) -> None:
    text = (BAR % (0.0, "G: [0.2, 0]", f", {ROD}", -12e3)).replace(
        "value: [0, -12 N]", f"value: [0, {-12e3 * across!r} N]"
    )
    b = da.member_forces(da.statics(da.loads(text)), "bar").buckling()
    assert b.two_force is two_force
    assert b.safety == pytest.approx(math.pi**2 * 210e9 * 0.03 * 0.02**3 / 12 / 12e3, rel=1e-6)


TWO = """
gravity: none
links:
  ground: {points: {O: [0, 0], T: [1, 0], G: [0, 1]}}
  bar: {points: {O: [0, 0], T: [1, 0], F: [0.5, 0]}, section: {rectangle: [20 mm, 30 mm], yield_stress: 300 MPa}}
  arm: {points: {G: [0, 0]}}
joints:
  O: {type: pin, links: [ground, bar]}
  T: {type: slot, links: [ground, bar], direction: 0}
  G: {type: pin, links: [ground, arm]}
drives: {G: {position: [0, 120]}}
loads:
  F: {type: force, on: bar, at: F, value: [0, '%r*cos(G)']}
  P: {type: force, on: bar, at: T, value: ['%r*cos(G)', 0]}
"""


@pytest.mark.parametrize("across", [1200.0, -1200.0])
@pytest.mark.parametrize("along", [9000.0, -9000.0])
def test_what_is_largest_in_a_member_does_not_go_by_its_sign(across: float, along: float) -> None:
    """At the first position all is twice as large, and of the other sign, as at the second: N / A and M / W by hand."""
    f = da.member_forces(da.statics(da.loads(TWO % (across, along))), "bar")
    assert f.largest("bending")[::3] == pytest.approx((-across / 4, 0), rel=1e-9)
    assert f.largest("bending")[1:3] == ("O-T", 0.5)
    assert f.largest("axial")[::3] == pytest.approx((along, 0), rel=1e-9)
    assert (abs(f.largest("shear")[0]), f.largest("shear")[3]) == pytest.approx(
        (abs(across) / 2, 0), rel=1e-9
    )
    s = f.stress()
    most = abs(along) / 6e-4 + abs(across) / 4 / (0.02 * 0.03**2 / 6)
    assert s.equivalent == pytest.approx([most, most / 2], rel=1e-9)
    assert s.normal == pytest.approx(np.sign(along) * np.array([most, -most / 2]), rel=1e-9)
    assert (s.position, s.largest) == (0, pytest.approx(most, rel=1e-9))
    assert s.safety == pytest.approx(300e6 / most, rel=1e-9)
    assert s.parts()[0] == pytest.approx(along / 6e-4, rel=1e-9)
    assert s.fatigue().amplitude == pytest.approx(0.75 * most, rel=1e-6)
    assert abs(s.fatigue().mean) == pytest.approx(0.25 * most, rel=1e-6)


def test_inner_forces_have_their_kinds() -> None:
    kinds = {of: kind_of(of) for of in ORDER}
    assert kinds == {
        "axial": "force", "shear": "force", "shear z": "force",
        "torsion": "moment", "bending y": "moment", "bending": "moment",
    }  # fmt: skip


def test_a_load_of_nothing_beside_its_member_needs_no_bracket() -> None:
    text = (BAR % (0.1, "G: [0.2, 0]", "", 0.0)).replace("[0, -12 N]", "[0, 0]")
    assert da.member_forces(da.statics(da.loads(text)), "bar").brackets == {}


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("component", [0, 1, 3])
def test_what_does_not_close_is_told_by_its_size(component: int, sign: float) -> None:
    """A force of 3 N, or a couple of 3 N times the machine's length, too much at the end, beside 12 N."""
    r = bar()
    sets = acting(r)
    body = LinkBalance(r, "bar", sets)
    members = members_of(r.mechanism, "bar", body.joints())
    loads, far = body.loads(members, mass_layout(r.mechanism, "bar", members)), beyond(members)
    curves = forces_inside(r, "bar", sets).curves
    assert _residual(body, curves, loads, far) == pytest.approx(0, abs=1e-14)
    more = np.zeros((1, 6))
    more[:, 5 if component == 3 else component] = (
        3 * sign * (r.compiled.layout.length if component == 3 else 1.0)
    )
    place = np.array([[1.0, 0, 0]])
    loads.seated.append(Wrench(place, more[:, :3], more[:, 3:], np.array([0]), np.array([1.0])))
    gap = float(_residual(body, curves, loads, far)[0])
    length = r.compiled.layout.length
    about = 3 * max(1.0, (1.0 - body.center[0]) / length, 1.0 / length) if component == 1 else 3
    moment = max(12 * (0.5 - body.center[0]), 6 * (1 - body.center[0])) / length
    assert gap == pytest.approx(about / max(12.0, moment, *([] if component != 3 else [3.0])), rel=1e-6)


@pytest.mark.parametrize("name", ENDS)
def test_a_column_whose_joints_are_written_the_other_way_round_is_the_same(name: str) -> None:
    low, high, drives, in_plane, across = ENDS[name]
    first = f"O: {{{low}, links: [ground, beam]}}"
    joints = f"T: {{{high}, links: [ground, beam]}}, {first}" if high else first
    text = COLUMN.format(joints=joints, drives=drives, on="beam").replace(
        "  block: {points: {T: [0, 0]}}\n", ""
    )
    b = da.member_forces(da.statics(da.loads(text)), "beam").buckling()
    assert b.effective_length == pytest.approx((in_plane, across), rel=1e-9)


def test_a_chord_does_not_go_by_the_order_of_its_supports() -> None:
    """F L^3 / (48 E I) in the middle of the chord, and F L^2 / (16 E I) at both ends."""
    f = da.member_forces(bar(link=f", {ROD}"), "bar")
    stiffness = 210e9 * 0.02 * 0.03**3 / 12
    for names in (("O", "T"), ("T", "O")):
        d = f.deflection(supports=names)
        assert d.largest == pytest.approx(12 / (48 * stiffness), rel=1e-6)
        assert d.slopes()["O"] == pytest.approx(12 / (16 * stiffness), rel=1e-9)
        assert d.slopes()["T"] == pytest.approx(12 / (16 * stiffness), rel=1e-9)
    tilted = f.deflection(supports=("T",))
    assert tilted.largest == pytest.approx(12 / (16 * stiffness), rel=1e-6)


RAM = """
gravity: none
links:
  ground: {points: {A: [0, 0], D: [1.6, %r]}}
  barrel: {points: {A: [0, 0], B: [1, 0]}}
  rod: {points: {C: [0, 0], E: [0, %r], D: [1, %r]}, members: [[E, D]]}
joints:
  A: {type: pin, links: [ground, barrel]}
  S: {type: slider, links: [barrel, rod], at: [B, C], direction: 0}
  D: {type: pin, links: [ground, rod]}
"""


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(
    ("near", "far", "joined"),
    [
        (0, 0, True),
        (1e-9, 1e-9, True),
        (1e-5, 1e-5, False),
        (0, 1e-9, True),
        (0, 1e-5, False),
        (1e-5, 0, False),
    ],
)
def test_barrel_and_rod_in_one_line_are_one_column(
    near: float, far: float, joined: bool, sign: float
) -> None:
    """Both ends of the rod on the barrel's line but for rounding, on either side of it."""
    r = da.statics(da.loads(RAM % (sign * far, sign * near, sign * far)))
    table = {link: da.member_forces(r, link) for link in ("barrel", "rod")}
    assert rod_of(r, "barrel", table) == (("S", "rod") if joined else ("", ""))
    assert rod_of(r, "rod", table) == (("S", "barrel") if joined else ("", ""))
