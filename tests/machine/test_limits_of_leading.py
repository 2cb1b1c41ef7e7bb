"""Freedoms that lead instead of drives near their dead centres: when they are looked for, and efforts on them."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.motion.actuation import actuation
from dalembert.machine.motion.coordinates.dead_centres import HEAVY, PLACES, WATCHED, LeadState
from dalembert.machine.motion.coordinates.leading_freedoms import Led, LedCondition, can_change_lead
from tests.machine.test_limits_of_actuation import machine, three

UNKNOWN: Any = None


class Leading(Led):
    """Two drives, the first free, led by freedoms of which they have twice and minus half the rate."""

    def __init__(self, own: Any) -> None:
        self.own, self.free, self.last = own, np.array([True, False]), np.array([9.0, 9.0])
        rows = np.array([[3.5, 0, 0, 2.0, 1.0], [0.25, 0, 0, 0.0, -0.5]])
        self.equation = lambda t, p, u: SimpleNamespace(freedoms=rows)  # type: ignore[assignment]


def test_efforts_on_freedoms_that_lead_have_the_power_of_those_of_the_drives() -> None:
    given: list[Any] = []

    def effort(t: float, q: Any, u: Any) -> Any:
        given.append((t, q.tolist(), u.tolist()))
        return np.array([3.0, 5.0])

    drives = [SimpleNamespace(turns=True, effort=0.0), SimpleNamespace(turns=False, effort=None)]
    own = SimpleNamespace(drives=drives, effort=effort, known=lambda *at: at, motors={})
    leading = Leading(own)
    q, rate = leading.follow(0.5, np.zeros(2))
    assert q == pytest.approx([3.5 + 2 * math.pi, 0.25])  # nearest to where they were
    assert rate.tolist() == [[2.0, 1.0], [0.0, -0.5]]
    u = np.array([4.0, 6.0])
    drive = [2 * 4 + 6.0, -3.0]
    assert leading.effort(0.5, q, u) == pytest.approx([2 * 3, 3 - 0.5 * 5])
    assert given[-1][2] == drive
    assert leading.known(0.5, q, u)[2] == pytest.approx(drive)  # type: ignore[index]
    on_led = np.array([10.0, 20.0])
    # the free drive has its effort; the other what is left over of the led ones
    assert leading.powers(0.5, q, u, on_led)[0] == pytest.approx(3 * drive[0])
    left = on_led - np.array([2.0, 1.0]) * 3
    assert leading.powers(0.5, q, u, on_led)[1] == pytest.approx(left[1] * drive[1])
    assert [x.tolist() for x in leading.lines(u, u)] == [[0, 0], [0, 0]]  # type: ignore[union-attr]
    drives[1].effort = 2.0
    assert leading.lines(u, u) is None
    for what, value in (("position", q[1] - 0.5), ("speed", drive[1] - 0.5)):
        condition = LedCondition("c", 1, what, 0.5, True, leading=leading)
        assert condition.value_at(2)(0.5, np.array([0, 0, 4.0, 6.0])) == pytest.approx(value)


class Lead(LeadState):
    """A state of two drives, one free, with what its mass and its places say told."""

    def __init__(self) -> None:
        self.d, self.rows, self.watch, self.lightest = 2, [], WATCHED, np.inf
        self.may_turn_over, self.mass = True, 1.0
        self.acting = SimpleNamespace(free=np.array([True, False]))  # type: ignore[assignment]
        self.fastest = np.array([10.0, 10.0])
        self.equation = lambda t, q, u: SimpleNamespace(mass=np.diag([self.mass, self.mass]))  # type: ignore[assignment]

    def keep_samples(self) -> None:
        pass


def test_inertia_is_heavy_above_twice_its_least() -> None:
    s, y = Lead(), np.array([0.0, 0, 9.0, 0])
    for mass, heavy in ((1.0, False), (HEAVY, False), (HEAVY * 1.001, True), (0.4, False), (0.81, True)):
        s.mass = mass
        assert s.is_heavy(0.0, y) is heavy
    s.may_turn_over = False
    assert not s.is_heavy(0.0, y)


def test_a_dead_centre_is_looked_for_where_a_free_drive_becomes_slow_or_steps_short() -> None:
    """Half of what was looked at is watched next; else it rises again up to where it began."""
    s = Lead()
    for speed, shorter, watch in (
        (9.0, 1.0, WATCHED),
        (-2.0, 1.0, 0.1),
        (1.5, 1.0, 0.1),
        (9.0, 0.05, 0.025),
        (0.4, 1.0, 0.025),
        (3.0, 1.0, 0.15),
        (9.0, 1.0, WATCHED),
    ):
        assert not s.nears_dead_centre(0.0, np.array([0, 0, speed, 0.0]), shorter)
        assert s.watch == pytest.approx(watch)
    s.may_turn_over = False
    assert not s.nears_dead_centre(0.0, np.array([0, 0, 0.0, 0.0]), 1.0)
    assert s.watch == WATCHED


@pytest.mark.parametrize(("count", "every"), [(3, 1), (PLACES, 1), (PLACES + 1, 2), (3 * PLACES - 1, 3)])
def test_the_path_of_drives_is_that_of_a_hundred_instants_at_most(count: int, every: int) -> None:
    s = Lead()
    s.rows = [(0.0, np.array([float(k), -k]), *[UNKNOWN] * 6) for k in range(count)]
    path = s.travel(np.array([0.5, 0.75, 8.0, 9.0]))
    assert path[-1].tolist() == [0.5, 0.75]
    assert path[:-1].tolist() == [[float(k), -k] for k in range(0, count, every)]


@pytest.mark.parametrize(
    ("drive", "more", "can"),
    [
        ("effort: 5", "", True),
        ("effort: 5, brake: 3", "", False),
        ("effort: 5, stops: {from: -1 rad, to: 1 rad}", "", False),
        ("motor: {stall: 4, no_load: 9 rad/s}", "", True),
        ("motor: {stall: 4, no_load: 9 rad/s, inertia: 0.1}", "", False),
        ("motor: {stall: 4, no_load: 9 rad/s, time_constant: 1 s}", "", False),
        ("motor: {curve: {speed: [0 rpm, 9 rpm], torque: [4, 0]}}", "", False),
        ("motor: {stall: 4, no_load: 9 rad/s, off: 1 s}", "", False),
        ("motor: {stall: 4, no_load: 9 rad/s, on: 1 s}", "", False),
        ("effort: 5", "cos(O2)", False),
        ("effort: 5", "cos(time)", True),
    ],
)
def test_other_freedoms_may_lead_where_nothing_belongs_to_the_drive(drive: str, more: str, can: bool) -> None:
    m = da.slider_crank(crank=0.05, rod=0.2)
    load = {"loads.load.value": [f"3*{more}" if more else 1.0, 0.0]}
    tree = m.with_values(load).to_tree()
    tree["drives"] = machine(three(f"position: 0, {drive}")).to_tree()["drives"]
    tree["drives"] = {"O2": tree["drives"]["O"]}
    described = da.mechanism(tree)
    prescribed, acting = actuation(described)
    assert can_change_lead(prescribed, acting) is can
