"""Flywheels at the limits of what is told apart: roughness, rounding, turning points, sizes that just can be."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.flywheel.legendre_panels import Panels, _may_vanish, _roots, _turns, resolve
from dalembert.machine.flywheel.speed_fluctuation import _with_mean_speed, speed_fluctuation
from dalembert.machine.flywheel.turning_moment import TurningMoment
from dalembert.machine.harmonics import EVEN, harmonics, whole_turns

SHAFT = """
links:
  ground: {points: {O: [0, 0]}}
  shaft: {points: {O: [0, 0]}, inertia: 2}
joints:
  O: {type: pin, links: [ground, shaft]}
drives:
  O: {position: {from: 0 deg, to: 360 deg, count: 24}, speed: 20 rad/s}
loads:
  engine: {type: couple, on: shaft, value: '%s'}
"""


def shaft(value: str) -> Any:
    return da.dynamics(da.loads(SHAFT % value))


@pytest.mark.parametrize("sign", ["", "-"])
def test_an_effort_that_stays_at_its_mean_for_a_part_of_the_turn_is_not_even(sign: str) -> None:
    """max(0, sin q - 1/2) + min(0, sin q + 1/2): each part has the area sqrt(3) - pi / 3."""
    r = shaft(f"10 {sign or '+'} (max(0, sin(O) - 0.5) + min(0, sin(O) + 0.5))")
    f = da.flywheel(r, Cs=0.02)
    area = math.sqrt(3) - math.pi / 3
    assert f.size.energy == pytest.approx(area, rel=1e-9)
    assert f.mean == pytest.approx(-10, rel=1e-9)
    assert f.inertia == pytest.approx(area / (0.02 * 400), rel=1e-9)
    assert f.reason == ""


@pytest.mark.parametrize(("part", "even"), [(99.5, True), (100.4, False), (102.0, False)])
@pytest.mark.parametrize("sign", ["+", "-"])
def test_an_effort_within_a_hundred_roundings_of_its_mean_is_even(
    part: float, even: bool, sign: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a dip three times as deep as the rest is high it is the dip that counts, and of a hump the hump."""
    r = shaft(f"5 {sign} (0.75 + cos(O) + 0.5*cos(2*O) - 0.75)")
    most = 1.5  # at q = 0; the other side reaches 0.75
    monkeypatch.setattr(TurningMoment, "floor", property(lambda t: most / part * 0.9999))
    f = da.flywheel(r, Cs=0.02)
    assert (f.reason == "the effort never differs from its mean") is even
    assert (f.inertia == 0) is even


def test_the_floor_is_a_part_of_the_largest_of_forces_moments_and_efforts() -> None:
    """Of a shaft with no force there is only its effort; a weight gives forces times the mechanism's length."""
    assert TurningMoment(shaft("8*(1 + 0.5*sin(2*O))")).floor == pytest.approx(1.2e-12, rel=1e-3)
    r = da.dynamics(da.slider_crank(crank=0.05, rod=0.2))
    t = TurningMoment(r)
    force = max(float(np.abs(r.reaction(j)).max()) for j in r.joints) * r.compiled.layout.length
    moment = float(np.abs(r.moment_array).max())
    assert t.floor == pytest.approx(1e-13 * max(force, moment, float(np.abs(r.effort("O2")).max())))


@pytest.mark.parametrize(
    ("values", "floor", "turns"),
    [
        ([0.0, 2.0, 1.0], 0.5, [0, 1]),
        ([0.0, 2.0, 1.0, 1.5, 1.0], 0.4, [0, 1, 2, 3]),
        ([0.0, 2.0, 1.0, 1.5, 1.0], 0.5, [0, 1]),  # what returns by no more than the floor has not turned
        ([0.0, 2.0, 1.0, 1.5, 1.0], 0.6, [0, 1]),
        ([2.0, 1.0, 1.5, 0.0], 0.4, [0, 1, 2, 3]),
        ([2.0, 0.0, 0.0, 1.0], 0.5, [0, 1]),  # the first of equal ones
        ([1.0, 1.0, 1.0], 0.0, []),
        ([1.0, 0.0], 0.999, [0, 1]),
        ([1.0, 0.0], 1.0, []),
        ([-3.0, -1.0, -2.0], 0.0, [0, 1]),
    ],
)
def test_values_over_a_period_turn_where_they_change_by_more_than_the_floor(
    values: list[float], floor: float, turns: list[int]
) -> None:
    assert _turns(np.array(values), floor) == turns


def test_roots_at_the_ends_of_a_panel_count_and_others_do_not() -> None:
    line = np.array([[0.5, 1.0], [-1.0, 1.0], [1.0, 1.0], [1.001, 1.0], [0.0, 0.0], [0.0, 1.0], [0.3, -1.0]])
    assert _may_vanish(line.T).tolist() == _may_vanish(-line.T).tolist() == [0, 1, 2, 5, 6]
    assert [_roots(-c).tolist() for c in line if c.any()] == [_roots(c).tolist() for c in line if c.any()]
    roots = [_roots(c).tolist() for c in line if c.any()]
    assert [len(x) for x in roots] == [1, 1, 1, 0, 1, 1]
    assert np.concatenate(roots) == pytest.approx([-0.5, 1.0, -1.0, 0.0, 0.3], abs=1e-15)
    square = np.array([1 / 3 - 0.25, 0.0, 2 / 3])  # x^2 - 1/4
    assert _roots(square) == pytest.approx([-0.5, 0.5])
    assert _roots(np.array([1 / 3 + 0.25, 0.0, 2 / 3])).size == 0  # x^2 + 1/4
    assert _roots(np.array([0.2, 1.0, 5e-16])) == pytest.approx([-0.2])  # the rest is rounding
    assert len(_roots(np.array([1 / 3, 0.0, 2 / 3]))) == 2  # x^2 touches


def test_a_curve_is_followed_in_as_many_pieces_as_it_needs() -> None:
    """A polynomial of the eighth degree needs one, of the ninth more; a jump is found to rounding."""
    edges = np.array([0.0, 1.0])
    for degree, count in ((0, 1), (8, 1)):
        panels, values = resolve(lambda x, n=degree: x**n, edges)
        assert len(panels.low) == count
        assert panels.mean(values) == pytest.approx(1 / (degree + 1), rel=1e-14)
    panels, values = resolve(lambda x: np.where(x < 1 / 3, 1.0, -2.0), edges)
    assert panels.mean(values) == pytest.approx(1 / 3 - 4 / 3, abs=1e-12)
    assert (np.diff(panels.low) > 0).all()
    assert panels.width.sum() == pytest.approx(1.0, rel=1e-15)
    for below in (lambda x: -2 - np.exp(5 * x), lambda x: 1 - np.exp(5 * x)):
        above = resolve(lambda x, below=below: -below(x), edges)
        assert resolve(below, edges)[0].low.tolist() == above[0].low.tolist()
    small = resolve(lambda x: np.sin(40 * x), edges, floor=2.0)
    assert len(small[0].low) == 1  # all of it is below the floor
    with pytest.raises(da.AnalysisError, match="over 10000 pieces do not resolve it"):
        resolve(lambda x: np.where(np.floor(x * 1e7) % 2 < 1, 1.0, -1.0), edges)


@pytest.mark.parametrize("orders", [[0, 1], [1.0], 1])
def test_three_positions_are_a_period_of_one_harmonic(orders: Any) -> None:
    """Of one turn orders are integers, of two they come in halves; what halving the positions changes has no sign."""
    q = np.arange(3) * 2 * math.pi / 3
    found = harmonics(2 + np.cos(q - 0.3), q, orders)
    assert found.amplitude[-1] == pytest.approx(1.0)
    assert math.isnan(found.aliasing)
    for order, said in ((0.5, "a period of 1 turn has no harmonic .* its orders are integers"),):
        with pytest.raises(da.ModelError, match=said):
            harmonics(np.cos(q), q, [order])
    with pytest.raises(da.ModelError, match=r"a period of 2 turns has no .* its orders are multiples of 1/2"):
        harmonics(np.ones(8), np.arange(8) * math.pi / 2, [1 / 3])
    with pytest.raises(da.ModelError, match=r"order 2 needs more than 4 positions, and there are 4"):
        harmonics(np.ones(4), np.arange(4) * math.pi / 2, [2])
    fine = np.arange(12) * math.pi / 6
    for sign in (1.0, -1.0):  # seen at every other position the fourth is the second
        found = harmonics(sign * (np.cos(2 * fine) + 0.25 * np.cos(4 * fine)), fine, [2])
        assert found.cosine == pytest.approx([sign])
        assert found.aliasing == pytest.approx(0.25)


def test_the_extremes_of_a_curve_are_between_its_points_or_at_its_ends() -> None:
    panels = Panels(np.array([0.0, 1.0]), np.array([1.0, 2.0]))
    for of, least, most in (
        (lambda x: (x - 0.3) ** 2, (0.0, 0.3), (2.7**2, 3.0)),
        (lambda x: -((x - 2.2) ** 3), (-(0.8**3), 3.0), (2.2**3, 0.0)),
        (lambda x: x * (3.1 - x), (0.0, 0.0), (1.55**2, 1.55)),
    ):
        low, high = panels.extremes(of(panels.points))
        assert low == pytest.approx(least, abs=1e-12)
        assert high == pytest.approx(most, rel=1e-12)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize(("turns", "count"), [(1, 12), (7, 5)])
def test_a_period_may_be_off_by_rounding(turns: int, count: int, sense: int) -> None:
    """In all by that of each of its positions, in one step by that of a radian or of the step if that is more."""
    step = sense * turns * 2 * math.pi / count
    for part in (0.9, -0.9):
        assert whole_turns(np.arange(count) * step * (1 + part * EVEN * count / turns)) == turns
        with pytest.raises(da.ModelError, match="which is not a whole number of turns"):
            whole_turns(np.arange(count) * step * (1 + 1.2 * part * EVEN * count / turns))
        one = EVEN * max(1.0, abs(step)) * (np.arange(count) == 2)
        assert whole_turns(np.arange(count) * step + part * one) == turns
        with pytest.raises(da.ModelError, match="the positions are not even"):
            whole_turns(np.arange(count) * step + 1.2 * part * one)
    with pytest.raises(da.ModelError, match="which is not a whole number of turns"):
        whole_turns(np.arange(4) * math.pi / 8)


def test_a_rim_may_just_reach_its_axis() -> None:
    """A section of height 2 R about the radius R: I = rho 2 pi R b h (R^2 + h^2 / 4)."""
    radius, breadth, density = 0.3, 0.1, 7800.0

    def of(part: float) -> tuple[float, da.FlywheelSize]:
        """The height, and the flywheel whose inertia is that of the rim."""
        h = 2 * radius * part
        inertia = density * 2 * math.pi * radius * breadth * h * (radius**2 + h**2 / 4)
        return h, da.flywheel_size(inertia * 0.02 * 400, speed=20, Cs=0.02)

    for part in (0.5, 0.999, 1.0):
        height, size = of(part)
        assert size.rim(density, radius, height=height) == pytest.approx(breadth)
    for part in (0.5, 0.999):
        height, size = of(part)
        assert size.rim(density, radius, breadth=breadth) == pytest.approx(height)
    height, size = of(1.001)
    with pytest.raises(da.ModelError, match=r"m high about a mean radius of 0\.3 m"):
        size.rim(density, radius, breadth=breadth)
    with pytest.raises(da.ModelError, match="beyond its axis"):
        size.rim(density, radius, height=height)


@pytest.mark.parametrize("beyond", [1e-3, 0.2, 1e3])
@pytest.mark.parametrize(("inertia", "swing"), [(2.0, 5.0), (0.3, -5.0), (40.0, 0.02)])
def test_the_speed_has_its_mean_over_time_however_near_to_rest(
    beyond: float, inertia: float, swing: float
) -> None:
    """sqrt(2 (E + A sin q) / I) with E a little beyond |A|; the mean speed is the way over its time, by quadrature."""
    energy = abs(swing) * (1 + beyond)

    def speed(q: Any) -> Any:
        return np.sqrt(2 * (energy + swing * np.sin(q)) / inertia)

    edges = np.linspace(0, 2 * np.pi, 9)
    panels, values = resolve(lambda q: 1 / speed(q), edges)
    mean = 1 / panels.mean(values)
    found = _with_mean_speed(panels, np.full(values.shape, inertia), swing * np.sin(panels.points), mean)
    assert found == pytest.approx(speed(panels.points), rel=1e-6)


def test_a_speed_whose_energy_only_grows_is_found_too() -> None:
    """Where nothing is below its start; and one that does not change is the mean itself."""
    panels, values = resolve(lambda q: 1 / np.sqrt(9 + q), np.linspace(0, 2 * np.pi, 9))
    mean = 1 / panels.mean(values)
    found = _with_mean_speed(panels, np.full(values.shape, 2.0), panels.points, mean)
    assert found == pytest.approx(np.sqrt(9 + panels.points), rel=1e-9)
    still = _with_mean_speed(panels, np.full(values.shape, 2.0), 0 * panels.points, 0.25)
    assert still == pytest.approx(np.full(values.shape, 0.25), rel=1e-12)


def test_a_machine_of_no_inertia_anywhere_has_no_speed() -> None:
    t = TurningMoment(shaft("5 + cos(O)"))
    panels, values = resolve(t.steady, t.edges, t.floor)
    with pytest.raises(da.AnalysisError, match="nothing in this machine has inertia"):
        speed_fluctuation(t, panels, 0 * values, 0.0)
    assert speed_fluctuation(t, panels, 0 * values + 2, 0.0).fluctuation > 0
