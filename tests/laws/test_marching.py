"""How a motion is followed: the course of the drives, polynomials between stations, steps, and Newton's convergence."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import pytest
from benchmarks.linkages import four_bar, pin
from numpy.polynomial import Polynomial

import dalembert as da
from dalembert.algebra import plane
from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.core.layout import Pose
from dalembert.core.position import newton
from dalembert.core.position.continuation import (
    STEP,
    Nodes,
    Station,
    _bend,
    _passes,
    _safe,
    _setting,
    interpolate,
    march,
)
from dalembert.core.position.path_parameter import course

DEG = np.pi / 180
NO_POSE = Pose(*(np.zeros(0),) * 3)


def compiled(tree: dict[str, Any]) -> Compiled:
    m = da.mechanism(tree)
    return compile_mechanism(m, m.schedule())


def first(c: Compiled) -> Pose:
    found = c.guess.modes(c.layout, c.targets[0])
    assert found is not None
    return found.pose.at(0)


def crank(position: Any) -> Compiled:
    points = {"O": [0, 0]}
    return compiled(
        {
            "links": {"ground": {"points": points}, "crank": {"points": points}},
            "joints": {"O": pin("ground", "crank")},
            "drives": {"O": {"position": position}},
        }
    )


def test_the_course_of_one_drive_runs_through_its_values_in_order() -> None:
    c = crank([30, 10, 10, 50, 20])
    along, k = course(c.layout, c.targets), c.layout.constraints.count
    assert along.order.tolist() == [1, 2, 4, 0, 3]
    assert along.s == pytest.approx(np.array([0, 0, 10, 20, 40]) * DEG)
    assert along.breaks == pytest.approx([0, 40 * DEG])
    assert [along.at(p) for p in range(5)] == pytest.approx(np.array([20, 0, 0, 40, 10]) * DEG)
    assert along.end == along.at(3)
    for s in np.linspace(0, along.end, 9):
        assert along.target(s)[0, k:] == pytest.approx([s + 10 * DEG])
        for side in (-1.0, 1.0):
            assert along.slope(s, side)[0] == pytest.approx([0.0] * k + [1.0])
    assert along.limit(0.1, 1.0) == along.end
    assert along.limit(0.1, -1.0) == along.limit(0.0, -1.0) == 0.0
    assert along.limit(along.end, 1.0) == along.end


def test_a_course_as_short_as_rounding_leads_nowhere() -> None:
    c = crank([0, 1e-13])
    along = course(c.layout, c.targets)
    assert 0 < along.end < 1e-14
    assert not any(along.slope(s, side).any() for s in along.s for side in (-1.0, 1.0))


def test_the_course_of_two_drives_breaks_where_it_turns() -> None:
    """A turn and a slide: the faster of them is the parameter, the slide over the machine's length."""
    turn, slide = [0, 20, 40, 40, 40, 30], [0.1, 0.1, 0.1, 0.1, 0.3, 0.3]
    tree = {
        "links": {
            "ground": {"points": {"O": [0, 0]}},
            "arm": {"points": {"O": [0, 0], "A": [0.5, 0]}},
            "block": {"points": {"A": [0, 0]}},
        },
        "joints": {"O": pin("ground", "arm"), "A": {"type": "slider", "links": ["arm", "block"]}},
        "drives": {"O": {"position": turn}, "A": {"position": slide}},
    }
    c = compiled(tree)
    along, k, length = course(c.layout, c.targets), c.layout.constraints.count, c.layout.length
    assert length != pytest.approx(1.0)
    steps = [20 * DEG, 20 * DEG, 0, 0.2 / length, 10 * DEG]
    assert along.order.tolist() == list(range(6))
    assert along.s == pytest.approx(np.cumsum([0, *steps]))
    assert along.breaks == pytest.approx(along.s[[0, 2, 4, 5]])
    for place, s in enumerate(along.s):  # two of them at the same s
        assert along.target(s)[0, k:] == pytest.approx([turn[place] * DEG, slide[place]])
    corner = along.s[2]
    assert along.target(corner + 0.1)[0, k:] == pytest.approx([40 * DEG, 0.1 + 0.1 * length])
    assert along.slope(corner, -1.0)[0, k:] == pytest.approx([1, 0])
    assert along.slope(corner, 1.0)[0, k:] == pytest.approx([0, length])
    assert along.slope(along.end, 1.0)[0, k:] == pytest.approx([-1, 0])
    assert along.limit(0.0, 1.0) == along.limit(along.s[4], -1.0) == pytest.approx(corner)


class Polynomials(NamedTuple):
    """A motion of two links whose coordinates are polynomials."""

    of: list[list[Polynomial]]

    @classmethod
    def drawn(cls, degree: int, rng: np.random.Generator) -> Polynomials:
        return cls([[Polynomial(rng.normal(size=degree + 1)) for _ in range(3)] for _ in range(2)])

    def at(self, s: np.ndarray, order: int = 0) -> np.ndarray:
        value = np.array([[p.deriv(order)(s) if order else p(s) for p in link] for link in self.of])
        return np.concatenate([value.transpose(2, 0, 1), np.zeros((len(s), 1, 3))], axis=1)

    def nodes(self, s: np.ndarray) -> Nodes:
        q = self.at(s)
        return Nodes(s, Pose(q[..., :2], q[..., 2], plane.rotation(q[..., 2])), self.at(s, 1))


def assert_follows(found: Pose, motion: Polynomials, s: np.ndarray) -> None:
    expected = motion.nodes(s).pose
    for a, b in zip(found, expected, strict=True):
        assert a == pytest.approx(b, abs=1e-11)


def test_poses_between_stations_follow_polynomials_exactly() -> None:
    """Values and slopes at five stations fix a polynomial of degree 9, next to the ends as in the middle; of two
    stations one of degree 3."""
    layout, rng = crank([0, 10]).layout, np.random.default_rng(4)
    for count in (2, 5, 9):
        s = np.cumsum(rng.uniform(0.2, 0.25, count)) - 1.0
        motion = Polynomials.drawn(2 * min(count, STEP.interpolation_stations) - 1, rng)
        between = np.sort(np.concatenate([s, rng.uniform(s[0], s[-1], 20)]))
        assert_follows(interpolate(layout, between, motion.nodes(s)), motion, between)


def test_no_polynomial_reaches_over_stations_that_crowd() -> None:
    """They crowd where a motion bends: on each side of a bend at 0 it is the polynomial of that side alone."""
    layout, rng = crank([0, 10]).layout, np.random.default_rng(4)
    left = np.array([-1.0, -0.8, -0.6, -0.4, -0.2])
    s = np.concatenate([left, [-0.15, 0.15], -left[::-1]])
    sides = [Polynomials.drawn(9, rng) for _ in range(2)]
    values = [motion.nodes(s) for motion in sides]
    bent = Nodes(
        s,
        Pose(*(np.concatenate([a[:6], b[6:]]) for a, b in zip(values[0].pose, values[1].pose, strict=True))),
        np.concatenate([values[0].rate[:6], values[1].rate[6:]]),
    )
    for sign, motion in zip((-1, 1), sides, strict=True):
        between = np.sort(sign * np.linspace(0.2, 1.0, 30))
        assert_follows(interpolate(layout, between, bent), motion, between)


def standing(s: float, clear: float) -> Station:
    return Station(s, NO_POSE, np.zeros(0), clear, None, 0.0)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
@pytest.mark.parametrize("way", [-1.0, 1.0])
def test_a_step_stays_clear_of_the_singular_pose_that_two_stations_foresee(sign: float, way: float) -> None:
    """The measure of clearness falls by 0.1 over 0.2 of the way: from 0.3 it is 0 after another 0.6."""
    ahead = [standing(5.0, sign * 0.4), standing(5.0 + way * 0.2, sign * 0.3)]
    assert _safe(ahead) == pytest.approx(STEP.towards_singular * 0.6)
    assert _passes(ahead, 0.61)
    assert not _passes(ahead, 0.59)
    behind = [standing(5.0, -sign * 0.1), standing(5.0 + way * 0.2, sign * 0.3)]
    assert _safe(behind) == pytest.approx(STEP.away_from_singular * 0.15)
    assert not _passes(behind[::-1][:1] + behind[1:], 9.0)
    close = [standing(5.0, sign * 0.2), standing(5.0 + way * 0.1, sign * 1e-6)]
    assert _safe(close) == pytest.approx(1e-6 / 2 + STEP.through_singular, rel=1e-4)
    assert _safe(ahead[:1]) == _safe([ahead[0], standing(6.0, sign * 0.4)]) == np.inf


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_a_bend_is_told_by_the_faster_rate(sign: float) -> None:
    """Over 0.5 of the way a turn at rates 1 and 3 goes 1.0 by their mean; 1.3 is 0.3 off, the faster would go 1.5."""
    c = crank([0, 90])
    at = _setting(c.layout, course(c.layout, c.targets))
    stations = []
    for s, turn, rate in ((1.0, 0.2, 1.0), (1.5, 1.5, 3.0)):
        pose = Pose(np.zeros((2, 2)), np.array([sign * turn, 0]), plane.rotation(np.array([sign * turn, 0])))
        moving = np.array([[0, 0, sign * rate], [0, 0, 0]])
        stations.append(Station(s, pose, moving, 1.0, None, 0.0))
    first, second = stations
    assert _bend(at, first, second) == pytest.approx(0.3 / 1.5)
    assert _bend(at, second, first) == pytest.approx(0.3 / 1.5)
    shifted = second._replace(pose=second.pose._replace(point=np.array([[0.0, -2.0], [0, 0]])))
    assert _bend(at, first, shifted) == pytest.approx(2.0 / c.layout.length / 1.5)
    swapped = first._replace(rate=second.rate), second._replace(rate=first.rate)
    assert _bend(at, *swapped) == pytest.approx(0.3 / 1.5)


def test_a_smooth_motion_is_marched_with_the_longest_steps() -> None:
    c = crank({"from": 0, "to": 360, "count": 73})
    along = course(c.layout, c.targets)
    for start, back, expected in (
        (0.0, False, np.append(np.arange(0, along.end, STEP.step), along.end)),
        (1.0, False, np.append(np.arange(1.0, along.end, STEP.step), along.end)),
        (1.0, True, [0.0, 1 - 2 * STEP.step, 1 - STEP.step, 1.0]),
    ):
        pose = first(c)
        pose.turn[0], pose.rotation[0] = start, plane.rotation(np.array(start))
        found = march(c.layout, pose, along, start, back)
        assert found.complete
        assert found.s == pytest.approx(expected)
        assert found.pose.turn[:, 0] == pytest.approx(found.s)


def linkage(lengths: tuple[float, ...], position: Any, stated: dict[str, float]) -> Compiled:
    """A four-bar of crank, coupler, rocker and ground."""
    crank, coupler, rocker, ground = lengths
    tree = {
        "links": {
            "ground": {"points": {"O2": [0, 0], "O4": [ground, 0]}},
            "crank": {"points": {"O2": [0, 0], "A": [crank, 0]}},
            "coupler": {"points": {"A": [0, 0], "B": [coupler, 0]}},
            "rocker": {"points": {"O4": [0, 0], "B": [rocker, 0]}},
        },
        "joints": {
            "O2": pin("ground", "crank"),
            "A": pin("crank", "coupler"),
            "B": pin("coupler", "rocker"),
            "O4": pin("ground", "rocker"),
        },
        "drives": {"O2": {"position": position}},
        "assembly": stated,
    }
    return compiled(tree)


def test_a_march_ends_at_a_dead_centre() -> None:
    """Where coupler and rocker are stretched; each step takes three quarters of the way that seems to be left."""
    c = linkage((0.3, 0.15, 0.2, 0.2), {"from": 40, "to": 140, "count": 101}, {"coupler": 270})
    found = march(c.layout, first(c), course(c.layout, c.targets), 0.0)
    dead = np.arccos((0.3**2 + 0.2**2 - 0.35**2) / (2 * 0.3 * 0.2)) - 40 * DEG
    assert not found.complete
    assert dead - 1e-6 < found.s[-1] <= dead
    assert len(found.s) < 25


def test_a_march_goes_straight_through_a_change_point() -> None:
    """A parallelogram stays one, where its other branch crosses; the steps close in on the place and open again."""
    c = linkage((0.1, 0.3, 0.1, 0.3), {"from": 20, "to": 340, "count": 100}, {"coupler": 0, "rocker": 20})
    found = march(c.layout, first(c), course(c.layout, c.targets), 0.0)
    assert found.complete
    assert found.pose.turn[:, :3] - 20 * DEG == pytest.approx(
        np.column_stack([found.s, 0 * found.s - 20 * DEG, found.s]), abs=1e-4
    )
    assert len(found.s) < 45


def test_newton_doubles_the_digits(monkeypatch: pytest.MonkeyPatch) -> None:
    """From 0.3 rad off a pose closes to rounding in 6 steps, and what has closed is worked on no longer."""
    layout, target = (c := compile_mechanism(m := four_bar(9), m.schedule())).layout, c.targets[:1]
    pose, sizes, own = first(c).at(None), list[int](), newton.step

    def step(*given: Any) -> Any:
        sizes.append(len(given[1].turn))
        return own(*given)

    monkeypatch.setattr(newton, "step", step)
    off = np.array([0.3, 0.01, 0.0])
    turn = pose.turn + off[:, None] * [1, -1, 1, 0]
    start = Pose(np.repeat(pose.point, 3, axis=0), turn, plane.rotation(turn))
    found, missing = newton.close_loops(layout, start, np.repeat(target, 3, axis=0))
    assert found.turn == pytest.approx(np.repeat(pose.turn, 3, axis=0), abs=1e-14)
    assert missing.max() < 1e-15
    assert sizes[0] == 3
    assert len(sizes) <= 6
    assert sizes[-1] == 1


def test_no_step_of_newton_is_long() -> None:
    """It is shortened as a whole to half a radian, or half the characteristic length, and its size before that told."""
    c = compile_mechanism(m := four_bar(9), m.schedule())
    layout, pose = c.layout, first(c).at(None)
    one = np.zeros((1, layout.stack.count))
    one[0, -1] = layout.length
    dq, size = newton.step(layout, pose, one)
    assert dq[0, 0, 2] == pytest.approx(0.5 / size[0])
    long, again = newton.step(layout, pose, 0.1 * one)
    assert again == pytest.approx(0.1 * size)
    assert long == pytest.approx(dq * 0.1 * size[0] / 0.5)


@pytest.mark.parametrize("make", [da.four_bar, da.rssr])
def test_the_distance_of_two_poses_is_that_of_the_link_that_moves_most(make: Any) -> None:
    """A turn in radians, a shift in characteristic lengths; the links that stay do not matter."""
    r = da.kinematics(make(positions=1))
    layout, pose = r.compiled.layout, full_pose(r, slice(0, 1))
    assert newton.distance(layout, pose, pose)[0] == 0
    for link in range(layout.links):
        for part in range(layout.algebra.n):
            dq = np.zeros((1, layout.links, layout.algebra.n))
            dq[0, link, part] = -1e-3 * (layout.length if part < layout.algebra.d else 1.0)
            assert newton.distance(layout, pose, newton.displace(layout, pose, dq))[0] == pytest.approx(
                1e-3, rel=1e-6
            )
