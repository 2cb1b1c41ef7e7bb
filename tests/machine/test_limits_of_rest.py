"""Drives and contacts that come to rest, stay, and go on: each decision at its limits, with told ranges and forces."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.core.friction.contact_equations import ContactResponse
from dalembert.machine.motion.occurrences import say
from dalembert.machine.motion.rest.dry_friction import _sticking, side_margins, sided
from dalembert.machine.motion.rest.standstill import SETTLED, STILL, ContactState, holding_efforts
from dalembert.machine.motion.rest.sticking import StickState, _choices, _parallel, _within

UNKNOWN: Any = None


def test_what_holds_a_drive_is_its_range_at_rest_where_that_is_known() -> None:
    """At the second of two positions; each end by itself."""

    def ends(interval: Any, holding: Any) -> tuple[float, float]:
        r: Any = SimpleNamespace(
            drives=("O", "S"),
            interval=lambda name: np.array([[0, 0], interval], float) if name == "S" else UNKNOWN,
            holding=lambda name: np.array([[0, 0], holding], float),
        )
        return holding_efforts(r, 1)

    nan = math.nan
    assert ends([2, 5], [1, 7]) == (1, 7)
    assert ends([2, 5], [nan, 7]) == (2, 7)
    assert ends([2, 5], [1, nan]) == (1, 5)
    assert ends([2, 5], [nan, nan]) == (2, 5)


class Resting(ContactState):
    """Two drives, the second at rest with a told effort and range; one contact whose rate is 3 times the second's."""

    def __init__(self, tau: float, low: float, high: float, rate: float = 0.0) -> None:
        self.d, self.told, self.rate_now = 2, (tau, low, high), rate
        names = ("O", "S")
        self.acting: Any = SimpleNamespace(
            names=names, motors={}, on=[False, False], drives=[SimpleNamespace(freedom="slide")] * 2
        )
        self.equation: Any = SimpleNamespace(
            dry=SimpleNamespace(own=np.array([0])),
            rates=None,
        )
        self.locked, self.on_stop = np.zeros(2, bool), np.zeros(2)
        self.toward, self.sense = np.ones(2), np.ones(1)
        self.resting, self.in_contact, self.clutches = {1: "G"}, set(), set()
        self.events: list[Any] = []

        def terms(t: float, q: Any, u: Any) -> Any:
            return SimpleNamespace(rates=np.array([-3.0 * u[1]]))

        terms.dry = SimpleNamespace(own=np.array([0]))  # type: ignore[attr-defined]
        self.equation = terms

    def _range(self, k: int, t: float, y: Any) -> tuple[float, float, float]:
        return self.told

    def rubbing_rates(self, t: float, y: Any) -> Any:
        return np.array([self.rate_now])

    def _is_late(self, k: int) -> bool:
        return False

    def settle(self, t: float = 1.0) -> list[tuple[str, str, str]]:
        self._settle(1, t, np.zeros(8))
        return [(e.name, e.of, say(e.words)) for e in self.events]


@pytest.mark.parametrize("tau", [-3.0, 2.0, 5.0])
def test_a_drive_within_its_range_comes_to_rest(tau: float) -> None:
    s = Resting(tau, -3.0, 5.0)
    held = f"friction holds it; effort {tau:g} N, held from -3 N to 5 N"
    assert s.settle() == [("rest", "S", f"S comes to rest and stays: {held}")]
    assert s.locked.tolist() == [False, True]
    motor = Resting(tau, -3.0, 5.0)
    motor.acting.motors, motor.acting.on = {1: None}, [False, True]
    assert "its motor stalls; effort" in motor.settle()[0][2]
    motor = Resting(tau, -3.0, 5.0)
    motor.acting.motors = {1: None}  # switched off
    assert "friction holds it" in motor.settle()[0][2]


@pytest.mark.parametrize(
    ("tau", "low", "high", "toward"),
    [
        (5.0 + 1e-9, -3.0, 5.0, 1.0),
        (-3.0 - 1e-9, -3.0, 5.0, -1.0),
        (4.0, 4.0, 4.0, 1.0),  # no range: nothing holds it
        (4.0, 4.0, 4.0 + 3e-12, -1.0),
        (4.0 + 2e-12, 4.0, 4.0 + 3e-12, 1.0),
        (3.9, 4.0, 4.0, -1.0),
        (-4.0, -4.0, -4.0, 1.0),
        (-4.1, -4.0 - 3e-12, -4.0, -1.0),
    ],
)
def test_a_drive_beyond_its_range_moves_in_that_sense(
    tau: float, low: float, high: float, toward: float
) -> None:
    s = Resting(tau, low, high)
    s.toward[1] = -toward
    assert s.settle() == [("reversal", "S", "S turns back")]
    assert (s.locked.tolist(), s.toward.tolist()) == ([False, False], [1.0, toward])
    assert s.sense.tolist() == [-toward]
    again = Resting(tau, low, high)
    again.locked[1] = True
    assert again.settle(0.0) == [("start", "S", "S starts again")]
    assert Resting(tau, low, high).settle(0.0) == []  # at the start nothing turns back


def test_a_contact_that_slips_keeps_its_sense_when_a_drive_is_let_go() -> None:
    for rate, sense in ((0.0, -1.0), (3 * STILL, -1.0), (-3 * STILL, -1.0), (3.1 * STILL, 1.0), (-0.1, 1.0)):
        s = Resting(9.0, -3.0, 5.0, rate)
        s.settle()
        assert s.sense.tolist() == [sense]


@pytest.mark.parametrize(
    ("group", "stays", "leaves"),
    [
        ("", ("rest", "G stays on its stop"), ("reversal", "G leaves its stop")),
        ("in_contact", ("rest", "G stays in contact"), ("lift-off", "G lifts off")),
        ("clutches", ("rest", "G holds"), ("reversal", "G turns freely")),
    ],
)
def test_a_drive_on_a_stop_stays_or_leaves_it_in_the_words_of_the_stop(
    group: str, stays: tuple[str, str], leaves: tuple[str, str]
) -> None:
    def on_stop(tau: float, locked: bool = False) -> Resting:
        s = Resting(tau, -3.0, math.inf)
        if group:
            getattr(s, group).add("G")
        s.on_stop[1], s.locked[1] = 1.0, locked
        return s

    s = on_stop(4.0)
    assert s.settle() == [(stays[0], "G", stays[1])]
    assert (s.locked[1], s.on_stop[1]) == (True, 1.0)
    assert on_stop(4.0, locked=True).settle() == []  # it was there before
    s = on_stop(-4.0)
    assert s.settle() == [(leaves[0], "G", leaves[1])]
    assert (s.locked[1], s.on_stop[1], s.toward[1]) == (False, 0.0, -1.0)
    if group != "in_contact":
        assert on_stop(-4.0, locked=True).settle() == [("start", "G", leaves[1])]
    narrow = Resting(4.0, 4.0, 4.0)
    narrow.on_stop[1] = 1.0
    assert narrow.settle() == [("rest", "G", "G stays on its stop")]


def test_locked_drives_are_loose_beyond_their_ranges() -> None:
    for tau, loose in ((-3.0, []), (5.0, []), (-3.01, [1]), (5.01, [1])):
        s = Resting(tau, -3.0, 5.0)
        assert s._loose(0.0, np.zeros(8)) == []
        s.locked[1] = True
        assert s._loose(0.0, np.zeros(8)) == loose


def test_the_instant_at_which_a_part_is_let_go_is_found_by_halving() -> None:
    s = Resting(0.0, 0.0, 0.0)
    for at in (0.37, 1e-9, 2.0):
        s._yields = lambda t, y, at=at: t >= at  # type: ignore[method-assign,misc]
        assert s._loosening(0.0, 2.0, lambda t: UNKNOWN) == pytest.approx(at, rel=1e-13)


class Waiting(Resting):
    """A machine at rest whose motors are switched by told switches."""

    def __init__(self, on: Any = None, off: Any = None, yields: float = math.inf) -> None:
        super().__init__(0.0, 0.0, 0.0)
        motor = SimpleNamespace(on=on, off=off, effort=(4.0, -8.0))
        self.acting.motors, self.acting.on, self.acting.late = {1: motor}, np.array([False, False]), []
        self.acting.steady, self.acting.next_joint = lambda k, u: 2.0, lambda t: math.inf
        self.switched, self.by_time, self.tables, self.yielding = set(), [], [], yields

    def _yields(self, t: float, y: Any) -> bool:
        return t >= self.yielding


def test_motors_at_rest_are_switched_by_time() -> None:
    s = Waiting(on=("time", 2.0), off=("time", 3.0))
    assert s._switches(1) == [("on", ("time", 2.0)), ("off", ("time", 3.0))]
    assert s._let_go(0.0, 5.0, UNKNOWN) == 5.0
    assert [(e.time, e.name, say(e.words)) for e in s.events] == [
        (2.0, "motor on", "the motor of S is switched on"),
        (3.0, "motor off", "the motor of S is switched off"),
    ]
    assert s._switches(1) == []
    s = Waiting(on=("time", 2.0), off=("time", 3.0), yields=2.0)
    assert s._let_go(0.0, 5.0, UNKNOWN) == 2.0
    assert s.acting.on.tolist() == [False, True]
    assert s._switches(1) == [("off", ("time", 3.0))]
    s = Waiting(on=("time", 2.0))
    assert s._let_go(2.0, 5.0, UNKNOWN) == 5.0  # one that is past
    assert s.events == []
    s = Waiting(on=("time", 6.0))
    assert (s._let_go(0.0, 5.0, UNKNOWN), s.events) == (5.0, [])
    s = Waiting(on=("speed", 2.0))
    assert (s._let_go(0.0, 5.0, UNKNOWN), s.events) == (5.0, [])
    s.acting.on[1] = True
    assert s._switches(1) == []  # it is on


def test_loads_over_time_let_go_at_their_instant() -> None:
    s = Waiting(yields=1.2345678)
    s.by_time, s.tables = [UNKNOWN], [SimpleNamespace(next_point=lambda t: math.inf)]  # type: ignore[list-item]
    assert s._let_go(0.0, 5.0, UNKNOWN) == pytest.approx(1.2345678, rel=1e-13)
    points = [0.5, 2.0, 4.5, 7.0]
    s.tables = [SimpleNamespace(next_point=lambda t: next((x for x in points if x > t), math.inf))]  # type: ignore[list-item]
    s.tables += [SimpleNamespace(next_point=lambda t: 3.0 if t < 3 else math.inf)]  # type: ignore[list-item]
    assert s._bends(0.25, 4.5) == [0.25, 0.5, 2.0, 3.0]
    assert s.next_bend(3.5) == 4.5
    s.tables, s.acting.next_joint = [], lambda t: t + 9
    assert s.next_bend(1.0) == 10.0


@pytest.mark.parametrize(
    ("torque", "waits"), [(2.0, False), (2 + 7 * SETTLED, False), (2 + 9 * SETTLED, True), (1.99, True)]
)
def test_a_late_motor_at_rest_is_waited_for(torque: float, waits: bool) -> None:
    s: Any = Waiting(on=("speed", 1.0))
    s._is_late = lambda k: ContactState._is_late(s, k)
    s.acting.late, s.acting.motor_effort = [1], lambda k, u: s.acting.torque[0]
    assert s.torques_change(np.array([9.0, 9, 9, torque])) is waits
    assert s.acting.torque.tolist() == [torque]
    s.acting.motors[1].on = ("time", 1.0)
    assert s.torques_change(np.array([9.0, 9, 9, torque]))


def test_a_brake_and_a_gear_hold_a_range_about_the_effort() -> None:
    s: Any = Waiting()
    s.acting.gears, s.acting.side, s.acting.brake = {1: None}, np.ones(2), np.array([7.0, 0.5])
    for shaft in (3.0, -3.0, 0.0):
        taken: list[float] = []
        s.acting.shaft = lambda k, u, a, shaft=shaft: shaft
        s.acting.take_ways = lambda toward, taken=taken: taken.append(float(toward[1]))
        s.acting.effort = lambda t, q, u, taken=taken: np.array([99.0, 10.0 + 2 * taken[-1]])
        assert s._held(1, 0.0, np.zeros(2), np.zeros(2)) == (10.0, 2.5)
        assert taken == [1.0, -1.0]
        assert s.acting.side.tolist() == [1.0, 1.0 if shaft >= 0 else -1.0]
        assert s.toward.tolist() == [1, 1]


COLUMNS = np.array([[1.0, -2, 0, 0.5, 0], [2.0, -4, 3, 1.0, -1]])


def test_contacts_of_one_direction_slip_together() -> None:
    ways = _parallel(COLUMNS)
    assert [w.tolist() for w in ways] == [[1, -1, 0, 1, 0], [0, 0, 1, 0, -1]]
    for off, count in ((1e-6, 1), (1e-4, 2)):  # the cosine differs by half of its square
        assert len(_parallel(np.array([[1.0, 1.0], [0.0, off]]))) == count


def test_sets_of_contacts_begin_with_one_that_sticks_and_end_with_all_that_slip() -> None:
    ways, sense, free = np.array([1.0, 0, -1]), np.array([1.0, 1, 1]), np.zeros(3)
    found = [x.tolist() for x in _choices(ways, sense, free)]
    assert found == [
        [0, 0, 1],
        [1, 0, 0],
        [0, 0, 1],  # all push back
        [1, 0, 0],  # the first one ahead
        [1, 0, -1],
        [-1, 0, 1],
    ]
    forced = np.array([0.0, 0, 1])  # it leaves against the way of the first
    assert [x.tolist() for x in _choices(ways, sense, forced)] == [[0, 0, 1], [0, 0, 1], [-1, 0, 1]]
    alone = [x.tolist() for x in _choices(np.array([0.0, 1]), np.array([1.0, -1]), np.zeros(2))]
    assert alone == [[0, 0], [0, -1], [0, 1]]
    leaving = [x.tolist() for x in _choices(np.array([0.0, 1]), np.array([1.0, -1]), np.array([0, 1.0]))]
    assert leaving == [[0, 1]]


def test_columns_within_others_are_sums_of_them() -> None:
    of = np.array([[1.0, 0], [0, 2], [1, 1]])
    columns = np.stack(
        [of @ [3, -1], of @ [3, -1] + [0, 0, 1e-12], of @ [3, -1] + [0, 0, 1e-6], [0, 0, 1]], 1
    )
    assert _within(columns, of).tolist() == [True, True, False, False]
    assert _within(np.eye(2), np.zeros((2, 0))).tolist() == [False, False]


class Sticking(StickState):
    """Three contacts that slip by themselves, of joints A, B and C."""

    def __init__(self, now: Any, tied: Any, sense: Any) -> None:
        own = np.array([2, 0, 1])
        self.equation: Any = SimpleNamespace(dry=SimpleNamespace(own=own), joints=("A", "B", "C"))
        self.stuck = np.zeros(3, bool)
        self.stuck[own] = now
        self.tied, self.sense, self.events = np.array(tied), np.array(sense, float), []


@pytest.mark.parametrize(
    ("before", "now", "tied", "sense", "said"),
    [
        ([0, 0, 0], [0, 1, 0], [0, 0, 0], [1, 1, 1], [("rest", "B", "B sticks: its friction holds it")]),
        (
            [0, 1, 0],
            [0, 1, 0],
            [0, 0, 0],
            [1, -1, 1],
            [("reversal", "B", "B reverses: its friction turns round")],
        ),
        ([1, 0, 0], [0, 0, 0], [0, 0, 0], [1, 1, 1], [("start", "A", "A slips again")]),
        ([1, 0, 0], [0, 0, 0], [1, 0, 0], [-1, 1, 1], []),
        (
            [0, 0, 0],
            [0, 0, 0],
            [0, 0, 0],
            [1, 1, -1],
            [("reversal", "C", "C reverses: its friction turns round")],
        ),
        ([0, 0, 0], [0, 0, 0], [0, 0, 1], [1, 1, -1], []),
    ],
)
def test_contacts_say_when_they_stick_slip_and_turn(
    before: Any, now: Any, tied: Any, sense: Any, said: Any
) -> None:
    s = Sticking(np.array(now, bool), np.array(tied, bool), sense)
    s._note_change(np.array(before, bool), np.ones(3), 2.0)
    assert [(e.name, e.of, say(e.words)) for e in s.events] == said
    assert all(e.time == 2.0 for e in s.events)


def test_friction_of_sticking_contacts_keeps_their_multipliers_at_nothing() -> None:
    """x + C f with f of the held ones such that their rows vanish, whatever the friction of the others."""
    rng = np.random.default_rng(3)
    r = ContactResponse(*(rng.normal(size=n) for n in (5, (5, 3), (3, 3), (3, 3, 3))))
    held, rows = np.array([0, 2]), np.array([4, 1])
    part = _sticking(r, rows, held)
    other = np.array([7.0, 2.5, -9.0])  # that of the held ones does not count
    free = np.where([False, True, False], other, 0.0)
    force = np.linalg.solve(r.change[rows][:, held], -(r.x + r.change @ free)[rows])
    whole = free.copy()
    whole[held] = force
    assert part.x + part.change @ other == pytest.approx(r.x + r.change @ whole)
    assert (part.x + part.change @ other)[rows] == pytest.approx([0, 0], abs=1e-12)
    assert part.y + part.h @ other == pytest.approx(r.y + r.h @ whole)
    assert _sticking(r, rows[:0], held[:0]) is r


def test_bearing_forces_have_corners_where_two_sides_bear_alike() -> None:
    kinds = ("guide", "pin", "mesh", "separation", "guide")
    c: Any = SimpleNamespace(kind=kinds, signed=np.array([0, 0, 0, 0, 1], bool), at=np.zeros((4, 2)))
    assert sided(c).tolist() == [0, 2, 3]
    y = np.array([[1.0, 9, 2, 3, 9], [9.0] * 5, [0.25, 9, 0.5, -4, 9]])
    assert side_margins(c, y).tolist() == [1.25, 2.5, -1, 0.75, 1.5, 7]
    c.at = np.zeros((4, 3))
    assert (sided(c).size, side_margins(c, y).size) == (0, 0)
