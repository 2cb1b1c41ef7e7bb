"""Curves of inner forces, deflections and stresses that follow from them, and pieces of members, from told numbers."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.polynomial import Polynomial

import dalembert as da
from dalembert.machine.members.deflections import DeflectedMember, Deflections
from dalembert.machine.members.end_conditions import ColumnNode
from dalembert.machine.members.mass_along import _along, _off, _section_inertia
from dalembert.machine.members.member_forces import MemberCurve, MemberForces, _stationary
from dalembert.machine.members.straight_members import beyond, straight
from dalembert.machine.members.stresses import (
    Stresses,
    _greatest,
    _utilisation,
    equivalent_stress,
    fibre_stress,
    outer_fibres,
)
from dalembert.machine.members.struts import _merged, _nodes
from dalembert.model.links.sections import Section

UNKNOWN: Any = None
START = np.array([1.0, -2.0, 0.5])
ALONG = np.array([0.0, 1.0, 0.0])
LONG = straight(("A", "B"), START, START + 2 * ALONG)
"""A member of 2 m along y of its link."""
COEFFICIENTS = np.arange(1.0, 49).reshape(2, 6, 4) * np.array([1.0, -2, 0.5, 0.75])


def curve(edges: Any = ((0.0, 0.75, 2.0),), cubics: Any = None) -> MemberCurve:
    edges = np.array(edges, float)
    given = COEFFICIENTS if cubics is None else np.array(cubics, float)
    return MemberCurve(LONG, edges, np.broadcast_to(given, (len(edges), *given.shape)).copy())


def test_inner_forces_are_those_of_the_piece_at_a_place() -> None:
    """Behind a force by default, before it where asked, and at the end of the member."""
    c = curve()
    powers = np.array([1, 0.75, 0.75**2, 0.75**3])
    before, behind = COEFFICIENTS @ powers
    assert c.at(0.75)[0, 0] == pytest.approx(behind)
    assert c.at(0.75, "before")[0, 0] == pytest.approx(before)
    assert c.at(0.75, "behind")[0, 0] == pytest.approx(behind)
    assert c.at([0.0, 2.0])[0] == pytest.approx(  # type: ignore[arg-type]
        np.stack([COEFFICIENTS[0, :, 0], COEFFICIENTS[1] @ [1, 2, 4, 8]])
    )
    assert c.at([0.5, 1.0]).shape == (1, 2, 6)  # type: ignore[arg-type]
    assert c.name == "A-B"
    for wrong in (-0.01, 2.01):
        with pytest.raises(da.ModelError, match="is not along member A-B; give 0 to 2 m"):
            c.at(wrong)


def test_ends_of_pieces_that_move_are_no_jumps() -> None:
    moving = curve(((0.0, 0.75, 1.2, 2.0), (0.0, 0.75, 1.3, 2.0)), np.ones((3, 6, 4)))
    assert moving.jumps.tolist() == [0.0, 0.75, 2.0]
    partly = curve(((0.0, 0.75, 2.0), (np.nan, 0.5, 2.0)))
    assert partly.jumps.tolist() == [0.0, 0.75, 2.0]
    assert curve(((np.nan, 0.75, 2.0),)).jumps.size == 0


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(("of", "row"), [("axial", 0), ("shear", 1), ("torsion", 3), ("bending", 5)])
def test_extremes_are_at_ends_and_where_the_slope_vanishes(of: str, row: int, sign: float) -> None:
    """One piece rises to 3 at 0.5, the other falls as a line from -1 to -6; a piece of no length does not count."""
    cubics = np.zeros((3, 6, 4))
    cubics[0, row] = [3 - 4 * 0.25, 4, -4, 0]  # 3 - 4 (s - 0.5)^2
    cubics[1, row] = [900, 0, 0, 0]
    cubics[2, row] = [2, -4, 0, 0]
    c = curve(((0.0, 0.75, 0.75, 2.0),), sign * cubics)
    found = c.extremes(of)
    least, most = (-6.0, 2.0), (3.0, 0.5)
    want = [*least, *most] if sign > 0 else [-most[0], most[1], -least[0], least[1]]
    assert [float(x[0]) for x in found] == pytest.approx(want)
    assert [float(x[0]) for x in c.greatest(of)] == pytest.approx([sign * -6.0, 2.0])
    cubics[2, row] = np.nan
    assert np.isnan(curve(((0.0, 0.75, 0.75, 2.0),), cubics).extremes(of)).all()
    cubics[2, row], cubics[1, row] = 1.0, np.nan
    assert np.isfinite(curve(((0.0, 0.75, 0.75, 2.0),), cubics).extremes(of)).all()


@pytest.mark.parametrize("roots", [(0.3, 1.7), (-0.4, 0.6), (-2.0, -0.5)])
def test_slopes_of_cubics_vanish_at_their_roots(roots: tuple[float, float]) -> None:
    for scale in (2.0, -3.0):
        slope = scale * Polynomial.fromroots(roots)
        found = _stationary(np.array([slope.integ(k=7).coef]))
        assert sorted(float(x[0]) for x in found) == pytest.approx(sorted(roots))
    one = [float(x[0]) for x in _stationary(np.array([[5.0, 3.0, -2.0, 0.0]]))]
    assert sorted(one)[0] == pytest.approx(0.75)
    assert all(math.isnan(x[0]) for x in _stationary(np.array([[5.0, 1.0, 0.0, 1.0]])))


def forces(*curves: MemberCurve, reasons: Any = ()) -> MemberForces:
    count = len(curves[0].edges)
    m = SimpleNamespace(dimension=2, links={"rod": SimpleNamespace(section=None)})
    r: Any = SimpleNamespace(mechanism=m, problems=lambda: reasons, status=("ok",) * count)
    return MemberForces(r, "rod", curves, np.zeros(count))


def lines(*values: Any) -> MemberCurve:
    """A curve whose axial force is one number at each position."""
    cubics = np.zeros((len(values), 1, 6, 4))
    cubics[:, 0, 0, 0] = values
    return MemberCurve(LONG, np.tile([0.0, 2.0], (len(values), 1)), cubics)


def test_the_largest_of_a_cycle_is_the_first_of_equal_ones_where_all_is_known() -> None:
    assert forces(lines(3, -7, 7)).largest("axial") == (-7.0, "A-B", 0.0, 1)
    assert forces(lines(3, -7, 2), lines(4, 5, -8)).largest("axial")[::3] == (-8.0, 2)
    assert forces(lines(3, np.nan, 2), lines(4, 50, -8)).largest("axial")[::3] == (-8.0, 2)
    lost = forces(lines(np.nan), lines(4)).largest("axial")
    assert (lost[1], lost[3], math.isnan(lost[0]), math.isnan(lost[2])) == ("A-B", 0, True, True)


def test_what_is_unknown_inside_a_link_is_named_by_its_positions() -> None:
    reasons = [("2-3", None, "why"), ("1", None, "why"), ("4", None, "why")]
    f = forces(lines(1, 2, np.nan, np.nan), reasons=reasons)
    assert f.unknown() == {"2-3": ["axial"], "4": ["axial"]}
    with pytest.raises(da.ModelError, match="link 'rod' has no member 'C'"):
        f.curve("C")
    assert f.names == ("axial", "shear", "bending")


def bent(edges: Any, moments: list[Polynomial], other: list[Polynomial] | None = None) -> MemberCurve:
    cubics = np.zeros((1, len(moments), 6, 4))
    for k, p in enumerate(moments):
        cubics[0, k, 5, : len(p.coef)] = p.coef
    for k, p in enumerate(other or []):
        cubics[0, k, 4, : len(p.coef)] = p.coef
    return MemberCurve(LONG, np.array([edges], float), cubics)


FIRST, SECOND = Polynomial([3.0, -2, 5, 1.5]), Polynomial([-1.0, 4, 0.5, -2])
STIFF = (70.0, 30.0)


def integrated(first: Polynomial, second: Polynomial, at: float, s: float) -> tuple[float, float]:
    """Deflection and slope from 0 on by two integrals, the second moment from a place on."""
    one, two = first.integ(), second.integ()
    slope = one if s <= at else two - two(at) + one(at)
    double = one.integ()
    if s <= at:
        return float(double(s)), float(slope(s))
    more = (two - two(at) + one(at)).integ()
    return float(double(at) + more(s) - more(at)), float(slope(s))


@pytest.mark.parametrize("supports", [(0.5,), (0.25, 1.75), (1.5, 0.5)])
def test_deflections_are_twice_integrated_moments_from_the_line_of_the_supports(
    supports: tuple[float, ...],
) -> None:
    """E I v'' = M_z and E I w'' = -M_y; both moments change at 0.75 m."""
    member = DeflectedMember(
        bent((0.0, 0.75, 2.0), [FIRST, SECOND], [SECOND, FIRST]),
        ("X", "Y")[: len(supports)],
        np.array([supports]),
        STIFF,
    )
    places = np.array([0.0, 0.3, 0.75, 1.1, 2.0])
    deflected, sloped = member.at(places)[0], member.slope(places)[0]
    for plane, (a, b, stiff) in enumerate(((FIRST, SECOND, 70.0), (-SECOND, -FIRST, 30.0))):

        def raw(s: float, a: Any = a, b: Any = b, stiff: Any = stiff) -> Any:
            return np.array(integrated(a, b, 0.75, s)) / stiff

        low = supports[0]
        tilt = (
            raw(low)[1] if len(supports) == 1 else (raw(supports[1])[0] - raw(low)[0]) / (supports[1] - low)
        )
        for k, s in enumerate(places):
            v, slope = raw(float(s))
            assert deflected[k, plane] == pytest.approx(
                v - raw(low)[0] - tilt * (s - low), rel=1e-9, abs=1e-12
            )
            assert sloped[k, plane] == pytest.approx(slope - tilt, rel=1e-9, abs=1e-12)
    both = np.hypot(*member.slope(np.array(supports))[0].T)
    assert member.slopes()[0] == pytest.approx(both)


def test_the_greatest_deflection_is_found_between_the_places_that_are_looked_at() -> None:
    """A moment of one number M: M / 2 E I times the distances from both supports, also beyond these."""
    for places, where, parts in (
        ((0.0, 2.0), 1.0, 1.0 * 1.0),
        ((0.25, 1.5), 2.0, 1.75 * 0.5),
        ((0.0, 0.6), 2.0, 2.0 * 1.4),
    ):
        member = DeflectedMember(
            bent((0.0, 0.75, 2.0), [Polynomial([7.0])] * 2), ("X", "Y"), np.array([places]), STIFF
        )
        best, at = member.greatest()
        assert abs(float(at[0]) - where) < 1e-4
        assert float(best[0]) == pytest.approx(7 / 70 / 2 * parts, rel=1e-7)


def test_deflections_name_the_largest_of_their_members() -> None:
    one = DeflectedMember(bent((0.0, 2.0), [Polynomial([7.0])]), ("X", "Y"), np.array([[0.0, 2.0]]), STIFF)
    d = Deflections(UNKNOWN, (one,), np.array([np.nan, 2.0, 3.0, 3.0]), ("A-B",) * 4, np.zeros(4))
    assert (d.position, d.largest) == (2, 3.0)
    assert [*d.slopes()] == ["X", "Y"]
    assert d.slopes()["X"] == pytest.approx([7 * 2 / 2 / 70])
    lost = Deflections(UNKNOWN, (one,), np.array([np.nan]), ("A-B",), np.zeros(1))
    assert (lost.position, math.isnan(lost.largest)) == (0, True)


BAR = Section(rectangle=("20 mm", "30 mm"))
ROUND = Section(circle="40 mm")
INNER = np.array([[6000.0, 700, -900, 120, -35, 80]])


def test_stresses_of_fibres_are_those_of_navier() -> None:
    """sigma = N/A - M_z y/I_z + M_y z/I_y; of a circle the larger of both moments together."""
    area, iy, iz = 6e-4, 0.03 * 0.02**3 / 12, 0.02 * 0.03**3 / 12
    if BAR.second_moments[0] > BAR.second_moments[1]:
        iy, iz = iz, iy
    y, z = BAR.reach
    places = np.array([[0.004, -0.003], [y, z]])
    expected = [6000 / area - 80 * a / iz + -35 * b / iy for a, b in places]
    assert fibre_stress(BAR, INNER, False, places)[0] == pytest.approx(expected)
    plane = [6000 / area - 80 * y / iz, 6000 / area + 80 * y / iz]
    assert fibre_stress(BAR, INNER * [1, 1, 1, 1, 0, 1], True)[0] == pytest.approx(plane)
    i = math.pi / 64 * 0.04**4
    round_ = 6000 / (math.pi / 4 * 0.04**2)
    both = math.hypot(35, 80) * 0.02 / i
    assert fibre_stress(ROUND, INNER, False)[0] == pytest.approx([round_ + both, round_ - both])
    assert fibre_stress(ROUND, INNER, True)[0] == pytest.approx(
        [round_ - 80 * 0.02 / i, round_ + 80 * 0.02 / i]
    )


def test_outer_fibres_are_corners_or_round_a_circle() -> None:
    y, z = BAR.reach
    assert outer_fibres(BAR, True).tolist() == [[y, 0], [-y, 0]]
    assert outer_fibres(BAR, False).tolist() == [[y, z], [y, -z], [-y, z], [-y, -z]]
    circle = outer_fibres(ROUND, False)
    assert circle.shape == (73, 2)
    assert np.hypot(*circle.T) == pytest.approx(np.full(73, 0.02))
    part = outer_fibres(ROUND, False, 0.5, 0.25)
    assert np.arctan2(part[[0, 36, 72], 1], part[[0, 36, 72], 0]) == pytest.approx([0.25, 0.5, 0.75])


@pytest.mark.parametrize("scale", [1.0, 1e3])
def test_the_stress_of_a_cut_is_von_mises_at_its_fibre_or_its_axis(scale: float) -> None:
    """Little shear leaves the outer fibre, much shear the axis, where only N, V and T act."""
    comps = INNER * [1, scale, scale, 1, 1, 1]
    sigma = np.abs(fibre_stress(ROUND, comps, False)).max()
    twist = 120 / ROUND.torsion
    area = math.pi / 4 * 0.04**2
    shear = 4 / 3 * math.hypot(700, 900) * scale / area
    fibre, axis = (
        math.hypot(sigma, math.sqrt(3) * twist),
        math.hypot(6000 / area, math.sqrt(3) * (shear + twist)),
    )
    assert (axis > fibre) is (scale > 1)
    assert equivalent_stress(ROUND, comps, False) == pytest.approx([max(fibre, axis)])
    plane = np.array([[6000.0, 700 * scale, 0, 0, 0, 80]])
    flat = math.hypot(6000 / 6e-4, math.sqrt(3) * 1.5 * 700 * scale / 6e-4)
    outer = np.abs(fibre_stress(BAR, plane, True)).max()
    assert equivalent_stress(BAR, plane, True) == pytest.approx([max(flat, outer)])


def test_the_greatest_stress_is_found_inside_a_piece_and_at_its_ends() -> None:
    cubics = np.zeros((2, 6, 4))
    cubics[0, 0] = [3 - 4 * 0.25, 4, -4, 0]
    cubics[1, 5] = [1.0, 0.5, 0, 0]
    value = lambda comps: np.abs(comps[..., 0]) + np.abs(comps[..., 5])  # noqa: E731
    best, at, comps = _greatest(curve(((0.0, 0.75, 2.0),), cubics), value)
    assert (best[0], at[0], comps[0, 0]) == pytest.approx((3.0, 0.5, 3.0), rel=1e-7)
    best, at, comps = _greatest(curve(((0.0, 0.75, 2.0),), cubics * np.array([0.5, 3])[:, None, None]), value)
    assert (best[0], at[0], comps[0, 5]) == pytest.approx((6.0, 2.0, 6.0))
    lost = _greatest(curve(((np.nan, 0.75, 2.0),), cubics), value)
    assert np.isnan(lost[0]).all()
    cubics[1] = np.nan
    assert np.isnan(_greatest(curve(((0.0, 0.75, 2.0),), cubics), value)[0]).all()


def test_use_by_goodman_counts_a_mean_in_tension_alone() -> None:
    full = Section(circle="40 mm", endurance="200 MPa", ultimate="500 MPa")
    assert _utilisation(full, 50e6, 80e6) == pytest.approx(0.4 + 0.1)
    assert _utilisation(full, -50e6, 80e6) == pytest.approx(0.4)
    for lacks in ({"endurance": "200 MPa"}, {"ultimate": "500 MPa"}, {}):
        assert _utilisation(Section(circle="40 mm", **lacks), 50e6, 80e6) == 80e6


def test_safety_against_yield_is_that_of_the_largest_stress() -> None:
    def safety(largest: Any, limit: str | None = "300 MPa") -> Any:
        s = Section(circle="40 mm", yield_stress=limit) if limit else ROUND
        return Stresses(UNKNOWN, s, np.array(largest), ("A-B",) * 3, np.zeros(3), np.zeros(3))

    assert safety([50e6, 60e6, 20e6]).safety == pytest.approx(5.0)
    assert safety([0.0, 0.0, 0.0]).safety == math.inf
    assert safety([50e6, 60e6, 20e6], None).safety is None
    assert safety([np.nan, 20e6, np.nan]).position == 1
    assert safety([np.nan] * 3).position == 0


def test_a_foot_is_the_nearest_place_of_a_member() -> None:
    s, off = LONG.foot(START + np.array([[0.3, 0.5, 0], [0, -1.5, 2], [0, 3.5, 2.0], [0, 2 * (1 / 3), 0]]))
    assert s == pytest.approx([0.5, 0.0, 2.0, 2 / 3])
    assert off == pytest.approx([0.3, 2.5, 2.5, 0.0])
    assert LONG.axes == pytest.approx(np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1.0]]))
    assert (LONG.length, LONG.along.tolist()) == (2.0, [0, 1, 0])


def test_members_beyond_others_are_those_behind_their_second_end() -> None:
    a, b, c, d = (
        straight(ends, START, START + ALONG) for ends in (("A", "B"), ("C", "B"), ("C", "D"), ("E", "A"))
    )
    assert beyond([a, b, c, d]).astype(int).tolist() == [
        [0, 1, 1, 0],
        [1, 0, 0, 1],
        [0, 0, 0, 0],
        [1, 1, 1, 0],
    ]


def test_a_prism_lies_on_members_along_it_and_sticks_out_beyond_them() -> None:
    upper = straight(("B", "C"), START + 2 * ALONG, START + 3 * ALONG)
    section = np.diag([1.0, 2, 3])
    center = START + 2.25 * ALONG
    for t in (np.array([0, 1.0, 0]), np.array([0, -1.0, 0])):
        pieces, free = _along([LONG, upper], center, t, 2.5, 7.0, section)
        assert [(p.member, p.start, p.end, p.density) for p in pieces] == [
            (0, 1.0, 2.0, 7.0),
            (1, 0.0, 1.0, 7.0),
        ]
        ends = [sorted(center[1] + t[1] * x for x in part) for part in free]
        assert ends == [pytest.approx([START[1] + 3.0, START[1] + 3.5])]
    assert _along([LONG], center, np.array([0, 0, 1.0]), 2.5, 7.0, section) == ([], [(-1.25, 1.25)])
    beside = center + np.array([1e-3, 0, 0])
    assert _along([LONG], beside, np.array([0, 1.0, 0]), 2.5, 7.0, section)[0] == []
    assert _off(beside, LONG) == pytest.approx(1e-3)


def test_the_inertia_of_a_section_is_what_is_left_of_the_prisms() -> None:
    mass, length, j = 3.0, 2.0, np.diag([0.02, 0.03, 0.05])
    rod = mass * length**2 / 12 * np.diag([1.0, 0, 1])
    assert _section_inertia(j * length + rod, mass, np.array([0, 1.0, 0]), length) == pytest.approx(j)


def test_nodes_of_a_column_gather_the_joints_of_one_place() -> None:
    at = {"A": 0.0, "B": 0.5, "C": 0.5 + 1e-10, "D": 2.0, "E": np.nan, "S": 1.0}
    e: Any = SimpleNamespace(link="rod", joints={n: np.array([9.0, x]) for n, x in at.items()})
    alone = _nodes(e, 1, 0.0, 1.0, 2.0)
    assert [(n.s, n.joints) for n in alone] == [
        (0.0, ("A",)),
        (0.5, ("B", "C")),
        (1.0, ("S",)),
        (2.0, ("D",)),
    ]
    back = _nodes(e, 1, 2.0, -1.0, 2.0, "S")
    assert [(round(n.s, 6), n.joints) for n in back] == [(0.0, ("D",)), (1.5, ("B", "C")), (2.0, ("A",))]
    turned = _nodes(e, 1, -2.5, 1.0, 2.0, "S", -1.0)
    assert [(round(n.s, 6), n.joints) for n in turned] == [(0.5, ("D",)), (2.0, ("B", "C")), (2.5, ("A",))]
    bare: Any = SimpleNamespace(link="rod", joints={})
    assert [(n.s, n.joints) for n in _nodes(bare, 0, 0.0, 1.0, 2.0)] == [(0.0, ()), (2.0, ())]
    assert _nodes(bare, 0, 0.0, 1.0, 2.0, "S") == ()


def test_nodes_of_barrel_and_rod_have_ends_and_the_gland_between() -> None:
    barrel, rod = ColumnNode("barrel", 0.25, ("A",)), ColumnNode("rod", 2.5, ("D",))
    out = ColumnNode("rod", 3.2, ("X",))
    found = _merged([rod, barrel, out], 1.0, 3.0)
    assert [(n.link, n.s, n.joints) for n in found] == [
        ("rod", 0.0, ()), ("barrel", 0.25, ("A",)), ("rod", 1.0, ()), ("rod", 2.5, ("D",)), ("barrel", 3.0, ()),
    ]  # fmt: skip
    found = _merged([barrel, ColumnNode("barrel", 1e-10), ColumnNode("rod", 3.0 + 1e-9, ("D",))], 1.0, 3.0)
    assert [(n.link, round(n.s, 6)) for n in found] == [
        ("barrel", 0),
        ("barrel", 0.25),
        ("barrel", 1),
        ("rod", 3),
    ]


def test_a_piece_with_one_unknown_number_leaves_no_extreme() -> None:
    """Of the position that has it; the other one keeps its own, and so do the other forces."""
    edges = np.tile([0.0, 1.0, 2.0], (2, 1))
    cubics = np.zeros((2, 2, 6, 4))
    cubics[:, :, 0, :2] = [[1.0, 1.0], [3.0, -0.5]]
    cubics[:, :, 1, 0] = 7.0
    cubics[1, 1, 0, 3] = np.nan
    curve = MemberCurve(LONG, edges, cubics)
    least, at_least, greatest, at_greatest = curve.extremes("axial")
    assert (least[0], at_least[0], greatest[0], at_greatest[0]) == (1.0, 0.0, 2.5, 1.0)
    assert np.isnan([least[1], at_least[1], greatest[1], at_greatest[1]]).all()
    assert curve.extremes("shear")[2].tolist() == [7.0, 7.0]
