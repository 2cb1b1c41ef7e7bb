"""Cones, mass numbers and bounds of counterweights by hand, and the programme that finds the least within them."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.balance.balance_problem import BalanceProblem, _buildable, _cones
from dalembert.machine.balance.balancing import _aim, _placed, _wanted
from dalembert.machine.balance.cone_programme import (
    _inside,
    _product,
    _quotient,
    _reach,
    _Scaling,
    _square,
    minimise,
)
from dalembert.machine.balance.counterweights import Counterweight, _spread, with_masses
from dalembert.machine.balance.mass_columns import MassNumbers, _axis, numbers_of, units
from dalembert.machine.motion.many.over_instants import over_instants

UNKNOWN: Any = None
S = np.array([[3.0, 1, -2], [5.0, -2, 4]])
Z = np.array([[2.0, -0.5, 1], [7.0, 3, 1]])


def test_products_of_cones_have_their_quotients() -> None:
    assert _product(S, Z).tolist() == [[6 - 0.5 - 2, 3 * -0.5 + 2 * 1, 3 - 4], [35 - 6 + 4, 15 - 14, 5 + 28]]
    assert _quotient(S, _product(S, Z)) == pytest.approx(Z)
    assert _square(S) == pytest.approx([9 - 5, 25 - 20])
    assert _square(np.array([[1.0, 2, 0]])).tolist() == [1e-300]


def test_the_scaling_of_a_pair_makes_both_alike() -> None:
    """W z = W^-1 s, with eta^4 the ratio of their squares."""
    w = _Scaling(S, Z)
    assert w.times(Z) == pytest.approx(w.over(S[..., None])[..., 0])
    assert w.over(w.times(Z)[..., None])[..., 0] == pytest.approx(Z)
    assert w.eta**4 == pytest.approx(_square(S) / _square(Z))
    assert _square(w.times(Z)) == pytest.approx(np.sqrt(_square(S) * _square(Z)))


@pytest.mark.parametrize(
    ("v", "d", "step"),
    [
        ([3.0, 1, -2], [-1.0, 0, 0], 3 - math.sqrt(5)),
        ([2.0, 0, 0], [1.0, 3, 4], 0.5),
        ([2.0, 1, 0], [-1.0, 1, 0], 0.5),  # its square falls as a line
        ([2.0, 0, 0], [1.0, 0.5, 0], math.inf),
        ([2.0, 0, 0], [-4.0, 0, 0], 0.5),
        ([2.0, 1, 0], [0.0, -1, 0], 3.0),
    ],
)
def test_a_step_reaches_the_boundary_of_its_cone(v: Any, d: Any, step: float) -> None:
    assert _reach(np.array([v]), np.array([d])) == pytest.approx(step)
    wide = np.array([[9.0, 0, 0], v])
    assert _reach(wide, np.array([[-1.0, 0, 0], d])) == pytest.approx(min(step, 9.0))


def test_points_outside_their_cones_are_moved_along_the_axes() -> None:
    """By one more than they are short; points well within stay."""
    assert _inside(S).tolist() == S.tolist()
    outside = np.array([[1.0, 3, 4], [9.0, 0, 1]])
    assert _inside(outside).tolist() == [[1 + 1 + 4, 3, 4], [9 + 1 + 4, 0, 1]]
    on = np.array([[5.0, 3, 4]])
    assert _inside(on).tolist() == [[6.0, 3, 4]]


def test_a_point_in_a_disc_nearest_to_a_line_has_its_value_and_proof() -> None:
    """Least 3 x + 4 y of |(x, y) - (1, -2)| <= 2 is -5 - 10; with x >= 0.5 the rest of the disc."""
    G = np.zeros((2, 3, 2))
    G[0, 1:] = -np.eye(2)
    h = np.array([[2.0, -1, 2], [4.0, 0, 0]])  # the second one is met everywhere
    x = minimise(np.array([3.0, 4.0]), G, h)
    assert x.x == pytest.approx([1 - 1.2, -2 - 1.6], rel=1e-7)
    assert (x.primal, x.dual) == pytest.approx((-15.0, -15.0))
    assert max(x.gap, x.infeasible) < 1e-10
    G[1, 0, 0], h[1, 0] = -1.0, -0.5
    y = minimise(np.array([3.0, 4.0]), G, h)
    low = -2 - math.sqrt(4 - 0.25)
    assert y.x == pytest.approx([0.5, low], rel=1e-7)
    assert y.dual == pytest.approx(1.5 + 4 * low)


def within(cones: Any, x: Any) -> bool:
    return all(v[0] >= np.linalg.norm(v[1:]) - 1e-12 for v in (h - g @ np.array(x) for g, h in cones))


@pytest.mark.parametrize("part", [0.999, 1.001])
def test_a_counterweight_is_within_each_of_its_bounds(part: float) -> None:
    """Variables m, m x, m y, I with radius 0.2 m and 3 kg: each limit by itself, both sides of it."""
    inside = part < 1
    kept, moment = ["mass", "moment 0", "moment 1", "inertia"], np.eye(4)[1:3]
    free = _cones(4, 0, Counterweight(radius=0.2, mass=3.0), kept, moment)
    assert within(free, [2.0, 0.1, -0.2, 0.05])
    assert within(free, [3 * part, 0.0, 0, 0.01]) is inside
    assert not within(free, [-0.001, 0, 0, 0])
    h2 = 0.1**2 + 0.2**2
    assert within(free, [2.0, 0.1, -0.2, h2 / 2 / part]) is inside  # h^2 <= m I
    assert within(free, [2.0, 0.01, 0, 0.04 * 2 * part]) is inside  # I <= R^2 m
    short = _cones(4, 0, Counterweight(radius=0.2, mass=3.0, moment=0.25), kept, moment)
    assert within(short, [2.9, 0.15 * part, -0.2 * part, 0.1]) is inside
    ranged = _cones(4, 0, Counterweight(radius=0.2, mass=3.0, x=(-0.05, 0.1), y=(-0.3, -0.02)), kept, moment)
    assert within(ranged, [2.9, 0.1 * part, -0.2, 0.08]) is inside
    assert within(ranged, [2.9, -0.05 * part, -0.2, 0.08]) is inside
    assert within(ranged, [2.9, 0.0, -0.02 / part, 0.08]) is inside
    alone = _cones(2, 0, Counterweight(radius=0.2, mass=3.0), ["moment 0", "moment 1"], np.eye(2))
    assert within(alone, [0.36 * part, 0.48 * part]) is inside


def test_a_counterweight_at_its_place_has_its_mass_alone() -> None:
    for w, most in (
        (Counterweight(place=(0.3, 0.4), mass=3.0), 3.0),
        (Counterweight(place=(0.3, 0.4), mass=3.0, moment=1.2), 2.4),
        (Counterweight(place=(0.3, 0.4)), 1e9),
    ):
        cones = _cones(1, 0, w, ["mass"], np.zeros((2, 1)))
        assert within(cones, [0.999 * most])
        assert within(cones, [1.001 * most]) is (most > 1e8)
        assert not within(cones, [-1e-3])
    assert _cones(1, 0, Counterweight(), [], np.zeros((2, 1))) == []


def test_a_mass_is_built_as_light_as_its_numbers_allow() -> None:
    h, none = np.array([0.3, -0.4, 0.0]), np.zeros((3, 3))
    z = np.array([0, 0, 1.0])
    w = Counterweight(radius=0.2)

    def built(mass: float, inertia: float, of: Counterweight = w, at: Any = h) -> MassNumbers:
        return _buildable(MassNumbers(mass, at, inertia * np.eye(3) / 3), of, z)

    light = built(0.0, 0.0)
    assert (light.mass, np.trace(light.second)) == pytest.approx((0.5 / 0.2, 0.5 * 0.2))
    by_inertia = built(0.0, 0.05)
    assert by_inertia.mass == pytest.approx(max(0.25 / 0.05, 0.05 / 0.04))
    wide = built(0.0, 0.5)
    assert wide.mass == pytest.approx(0.5 / 0.04)
    assert np.trace(wide.second) == pytest.approx(0.5)
    full = built(7.0, 0.2)
    beside = full.second - np.outer(h, h) / 7
    assert np.trace(beside) == pytest.approx(0.2 - 0.25 / 7)
    assert beside @ z == pytest.approx([0, 0, 0])
    assert beside @ h == pytest.approx([0, 0, 0])
    disc = built(0.0, 0.0, Counterweight(disc=(7000.0, 0.01, 0.3)))
    size = (0.5 / (math.pi * 7000 * 0.01)) ** (1 / 3)
    assert (disc.mass, np.trace(disc.second)) == pytest.approx((0.5 / size, 1.5 * 0.5 * size))
    nothing = built(0.0, 0.0, w, 0 * h)
    assert (nothing.mass, nothing.moment.tolist(), nothing.second.tolist()) == (0.0, [0, 0, 0], none.tolist())


@pytest.mark.parametrize("d", [2, 3])
def test_mass_numbers_are_a_vector_and_back(d: int) -> None:
    count = 4 if d == 2 else 10
    vector = np.arange(2.0, 2 + count)
    assert numbers_of(vector).vector(d) == pytest.approx(vector)
    points = [(2.0, np.array([0.1, 0.2, 0.3])), (3.0, np.array([-0.4, 0.5, 0.7]))]
    if d == 2:
        points = [(m, p * [1, 1, 0]) for m, p in points]
    mass, moment = 5.0, sum(m * p for m, p in points)
    second = sum(m * np.outer(p, p) for m, p in points)
    found = MassNumbers(mass, moment, second).vector(d)  # type: ignore[arg-type]
    xx, yy, zz, xy, xz, yz = (second[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)))  # type: ignore[index]
    rest = [xx + yy] if d == 2 else [xx, yy, zz, xy, xz, yz]
    assert found == pytest.approx([mass, *moment[:d], *rest])  # type: ignore[index]
    u = units(d)
    assert [len(x) for x in u] == [count] * 3
    assert np.array([MassNumbers(*(x[k] for x in u)).vector(d) for k in range(count)]) == pytest.approx(
        np.eye(count)
    )


def test_an_axis_is_that_of_all_turnings_or_none() -> None:
    t = np.array([0.6, -0.8, 0.0])
    for size, off, one in ((3.0, 0.0, True), (3.0, 2e-9, True), (3.0, 1e-8, False)):
        turning = np.stack([size * t, -2 * t + off * np.array([0, 0, 1.0])])
        found = _axis(turning)
        assert (found is not None) is one
        if found is not None:
            assert abs(found @ t) == pytest.approx(1.0)
    assert _axis(np.zeros((2, 3))) is None
    assert _axis(np.zeros((0, 3))) is None


def test_moments_of_a_counterweight_have_directions_across_its_axis() -> None:
    def found(w: Counterweight, axis: Any) -> list[list[float]]:
        return [np.abs(u).round(9).tolist() for u in w.directions(axis)]

    x, y, z = np.eye(3).tolist()
    assert found(Counterweight(), np.array(z)) == [x, y]
    assert found(Counterweight(x=(0, 0)), np.array(z)) == [y]
    assert found(Counterweight(x=(0, 0), y=(-1, 2)), None) == [y, z]
    assert found(Counterweight(), None) == [x, y, z]
    tilted = Counterweight().directions(np.array([0.6, 0.8, 0.0]))
    assert [abs(u @ [0.6, 0.8, 0]) < 1e-12 for u in tilted] == [True, True]
    assert Counterweight(moment=3.0, disc=(2.0, 0.5, 1.5)).most_moment == 3.0
    assert Counterweight(moment=9.0, disc=(2.0, 0.5, 0.7)).most_moment == pytest.approx(math.pi * 0.7**3)
    assert Counterweight().most_moment == math.inf
    assert Counterweight(disc=(2.0, 0.5, 1.5)).disc_of(math.pi * 0.7**3) == pytest.approx(0.7)


def test_masses_that_are_added_keep_moment_and_inertia_of_all() -> None:
    """A crank of 2 kg with 3 kg at one place and nothing at another; in the plane I = sum of i + m r^2."""
    m = da.four_bar().with_values(
        {"links.crank.mass": 2.0, "links.crank.center": [0.1, 0.05], "links.crank.inertia": 0.02}
    )
    parts: Any = [(3.0, np.array([-0.2, 0.1]), 0.01), (0.0, np.array([9.0, 9.0]), 5.0)]
    link = with_masses(m, {"crank": parts}).links["crank"]
    center = (2 * np.array([0.1, 0.05]) + 3 * np.array([-0.2, 0.1])) / 5
    spread = sum(w * ((np.array(c) - center) ** 2).sum() for w, c in ((2, (0.1, 0.05)), (3, (-0.2, 0.1))))
    assert (link.mass, link.center) == (pytest.approx(5), pytest.approx(center))  # type: ignore[comparison-overlap]
    assert link.inertia == pytest.approx(0.03 + spread)
    assert with_masses(m, {"crank": parts[1:]}).links["crank"] == m.links["crank"]
    arm = np.array([1.0, -2, 3])
    assert _spread(arm) == pytest.approx(np.array([[13.0, 2, -3], [2, 10, 6], [-3, 6, 5]]))
    assert _spread(arm[:2]) == 5.0


def test_a_counterweight_is_placed_by_its_numbers() -> None:
    r: Any = SimpleNamespace(mechanism=da.four_bar())
    base = np.array(r.mechanism.point("rocker", "O4") if "O4" in r.mechanism.points("rocker") else (0.0, 0.0))
    w = Counterweight(at="O4", disc=(7000.0, 0.01, 0.3))
    p = _placed(r, "rocker", w, np.array([4.0, 0.3, -0.4, 0.1]))
    assert p.center == pytest.approx(base + np.array([0.075, -0.1]))
    assert (p.mass, p.moment, p.angle) == pytest.approx((4.0, 0.5, math.atan2(-0.4, 0.3)))
    assert p.inertia == pytest.approx(0.1 - 0.25 / 4)
    assert p.radius == pytest.approx(w.disc_of(0.5))
    none = _placed(r, "rocker", Counterweight(at="O4"), np.zeros(4))
    assert (none.mass, none.inertia, none.angle, none.radius) == (0.0, 0.0, 0.0, None)
    assert none.center == pytest.approx(base)
    point = _placed(r, "rocker", Counterweight(at="O4"), np.array([4.0, 0.3, -0.4, 0.25 / 4 - 1e-12]))
    assert point.inertia == 0.0


BASE = {
    "force": np.array([[3.0, 4], [0, -10]]),
    "moment": np.array([[2.0], [-6]]),
    "torque": np.zeros((2, 1)),
}
COLUMNS = {
    "force": np.arange(16.0).reshape(2, 2, 4),
    "moment": np.ones((2, 1, 4)),
    "torque": np.ones((2, 1, 4)),
}


def test_weights_of_what_counts_add_up_to_one() -> None:
    """Rms values by their squares; what was nothing before does not count."""
    problem = BalanceProblem(BASE, COLUMNS, (("crank", Counterweight()),), {})
    assert (problem.count, problem.dimension) == (4, 2)
    rms = {"force": math.sqrt((25 + 100) / 2), "moment": math.sqrt(20), "torque": 0.0}
    assert problem.sizes("rms") == pytest.approx(rms)
    assert problem.sizes("max") == pytest.approx({"force": 10.0, "moment": 6.0, "torque": 0.0})
    of = {"force": 3.0, "moment": 4.0, "torque": 7.0}
    assert problem.weighted("rms", of) == pytest.approx({"force": 0.6, "moment": 0.8})
    assert problem.weighted("max", of) == pytest.approx({"force": 3 / 7, "moment": 4 / 7})
    assert problem.weighted("max", {"force": 0.0, "moment": 2.0}) == {"moment": 1.0}
    parts = {"force": 0.5, "moment": 0.25, "torque": 9.0}
    assert problem.part("rms", of, parts) == pytest.approx(math.hypot(0.3, 0.2))
    assert problem.part("max", of, parts) == pytest.approx(1.5 / 7 + 1 / 7)
    numbers = np.array([1.0, -2, 0.5, 3])
    assert problem.predict("force", numbers) == pytest.approx(BASE["force"] + COLUMNS["force"] @ numbers)


FOUND: Any = {
    "unknown_loads": (),
    "compiled": SimpleNamespace(known=SimpleNamespace(requested=np.array([True, True]))),
}
"""All efforts are found, and no load."""


def test_aims_name_a_reduction_and_a_quantity() -> None:
    r: Any = SimpleNamespace(drives=("O2", "O4"), **FOUND)
    assert _aim("rms shaking_force", "moment", r) == ("rms", "force")
    assert _aim(" peak shaking_moment", "force", r) == ("max", "moment")
    assert _aim("max effort.O2", "force", r) == ("max", "torque")
    assert _aim("rms", {"force": 1.0}, r) == ("rms", {"force": 1.0})
    for wrong, said in (
        ("least", "write rms or peak and a quantity"),
        ("rms effort.O4", "choose among shaking_force, shaking_moment, effort.O2"),
    ):
        with pytest.raises(da.ModelError) as refused:
            _aim(wrong, "force", r)
        assert said in str(refused.value)
    assert _wanted("force", r) == {"force": 1.0}
    assert _wanted({"force": 0.5, "torque": 2.0}, r) == {"force": 0.5, "torque": 2.0}
    still: Any = SimpleNamespace(drives=(), **FOUND)
    for of, by, said in (
        ({"speed": 1.0}, r, "'speed' is not an objective"),
        ("torque", still, "no drive has a torque"),
        ({"force": 0.0}, r, "no objective to minimise"),
    ):
        with pytest.raises(da.ModelError, match=said):
            _wanted(of, by)


def test_values_over_instants_are_those_that_are_known() -> None:
    """Greatest ones of all instants, means of even ones between start and end."""
    time, values = np.array([0.0, 0.5, 2.0, 4.0]), np.array([1.0, np.nan, -3.0, 5.0])
    assert over_instants("peak", values, time, 3) == 5.0
    assert over_instants("peak", -values, time, 3) == 5.0
    assert over_instants("final", values[:3], time[:3], 3) == -3.0
    assert over_instants(None, values, time, 5) == pytest.approx([1, -1, -3, 1, 5])
    pair = np.stack([values, 2 * values], axis=1)
    assert over_instants(None, pair, time, 3) == pytest.approx(np.array([[1.0, 2], [-3, -6], [5, 10]]))
    assert over_instants("mean", values, time, 5) == pytest.approx(3 / 5)
    lost = over_instants(None, np.full(2, np.nan), np.array([0.0, 1.0]), 2)
    assert np.isnan(lost).all()
