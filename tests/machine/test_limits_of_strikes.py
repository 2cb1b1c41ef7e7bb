"""Impacts of a machine of told inertia by hand, its forces on stops, and what its equation of motion refuses."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.machine.motion.equation import (
    WEIGHTLESS,
    Equation,
    LoadChannel,
    StoppedError,
    Terms,
    _solve,
    lightest,
)
from dalembert.machine.motion.stops.gap_contacts import GapContact
from dalembert.machine.motion.stops.impacts import SLOW, Stop, StopState
from dalembert.machine.motion.stops.touching import TouchState
from dalembert.model.drives.end_stops import Stops

UNKNOWN: Any = None
MASS = np.array([[2.0, 0.5], [0.5, 1.0]])


class Struck(StopState):
    """Two drives with stops at 1 and -3, and a joint whose place is q1 + 2 q2, with stops at -6 and 4."""

    def __init__(self, restitution: float = 0.5, free: Any = (True, True), dry: bool = False) -> None:
        self.d, self.lengths = 2, np.ones(2)
        self.rotor: Any = [0.0, 0.0]
        self.acting: Any = SimpleNamespace(
            free=np.array(free),
            take_ways=lambda toward: np.array(self.rotor),
            names=("A", "B"),
        )
        self.stops = [
            Stop("A", "slide", Stops(-9.0, 1.0, restitution), drive=0),
            Stop("B", "slide", Stops(-3.0, 9.0, restitution), drive=1),
            Stop("J", "slide", Stops(-6.0, 4.0, restitution), joint=0),
        ]
        self.fastest, self.toward, self.sense = np.array([1.0, 2.0]), np.ones(2), np.zeros(0)
        self.locked, self.on_stop, self.rubs = np.zeros(2, bool), np.zeros(2), np.zeros(2, bool)
        self.stuck = self.tied = self.bound = np.zeros(2, bool)
        self.losses, self.events, self.settled, self.noted = [], [], [], []  # type: ignore[var-annotated]

        def terms(t: float, q: Any, u: Any) -> Any:
            row = [q[0] + 2 * q[1], u[0] + 2 * u[1], 0.0, 1.0, 2.0]
            return SimpleNamespace(mass=MASS, freedoms=np.array([row]), rates=np.zeros(0))

        terms.dry = dry  # type: ignore[attr-defined]
        self.equation: Any = terms

    def _note_rests(self, t: float, y: Any) -> None:
        self.noted.append(t)

    def settle(self, drives: Any, t: float, y: Any, leaving: Any = ()) -> list[int]:
        self.settled = list(drives)
        return []

    def at(self, t: float, y: Any) -> Any:
        return np.array([3.0, -5.0]), UNKNOWN, UNKNOWN


def struck(s: Struck, hit: Any, q: Any, u: Any) -> Any:
    y = np.array([*q, *u, *np.zeros(6)], float)
    s.strike(hit, 2.0, y)
    return y


def kinetic(u: Any) -> float:
    return float(u @ MASS @ u / 2)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
@pytest.mark.parametrize(
    ("which", "side", "row", "u"),
    [(0, 1.0, (1, 0), (3.0, -4.0)), (1, -1.0, (0, 1), (3.0, -4.0)), (2, 1.0, (1, 2), (3.0, 1.0))],
)
def test_one_stop_is_struck_by_newtons_law(
    which: int, side: float, row: Any, u: Any, restitution: float
) -> None:
    """u+ = u - M^-1 n (1 + e) v / (n M^-1 n): the normal speed is reversed by e, the rest keeps its momentum."""
    s = Struck(restitution)
    q = ([1.0 + 1e-9, 0.25], [0.3, -3.0 - 1e-9], [0.5, 1.75])[which]
    y = struck(s, [(which, side)], q, u)
    n, before, after = side * np.array(row, float), np.array(u), y[2:4]
    closing = float(n @ before)
    assert closing > 0
    assert n @ after == pytest.approx(-restitution * closing, abs=1e-12)
    push = MASS @ (before - after)
    assert push / np.linalg.norm(push) == pytest.approx(n / np.linalg.norm(n))
    (event,) = s.events
    assert (event.name, event.of, event.speed) == ("impact", "ABJ"[which], pytest.approx(closing))  # type: ignore[comparison-overlap]
    assert event.lost == pytest.approx(kinetic(before) - kinetic(after))
    assert s.losses == [(2.0, pytest.approx(event.lost))]  # type: ignore[comparison-overlap]
    ends = {0: (0, 1.0), 1: (1, -3.0)}
    if which in ends:
        k, place = ends[which]
        assert y[k] == place
    resting = side if restitution == 0 else 0.0
    assert [x.resting for x in s.stops] == [resting if k == which else 0.0 for k in range(3)]
    assert s.fastest == pytest.approx(np.maximum([1.0, 2.0], np.abs(before)))
    assert s.toward.tolist() == [-1.0 if x < 0 else 1.0 for x in after]
    assert s.noted == [2.0]
    assert y[4:].tolist() == [0.0] * 6


def test_two_stops_that_are_met_at_once_both_push_or_one_alone() -> None:
    """Both speeds reversed by 1/2; where one leaves by the other's push it has none."""
    s = Struck()
    y = struck(s, [(0, 1.0), (1, -1.0)], [1.0, -3.0], [3.0, -4.0])
    assert y[2:4] == pytest.approx([-1.5, 2.0])
    assert [e.of for e in s.events] == ["A", "B"]
    s = Struck()
    y = struck(s, [(0, 1.0)], [1.0, -3.0], [3.0, 0.0])  # B lies on its stop
    assert y[2] == pytest.approx(-1.5)
    assert y[3] == pytest.approx(0.5 * 4.5)  # it leaves, and nothing pulls it back


def test_a_rebound_below_a_millionth_of_the_greatest_speed_is_rest() -> None:
    """The remaining bounces take 2 v e / (1 - e) over the acceleration towards the stop, 3 m/s2."""
    for e, rests in ((0.9 * SLOW, True), (1.1 * SLOW, False)):
        s = Struck(e)
        y = struck(s, [(0, 1.0)], [1.0, 0.0], [4.0, 0.5])
        assert (s.stops[0].resting == 1.0) is rests
        assert bool(y[2] == 0.0) is rests
        assert s.settled == []
        late = 2 * 4 * e / (1 - e) / 3 if rests else 0.0
        assert s.noted[0] - 2.0 == pytest.approx(late, abs=1e-15)
    rough = Struck(0.9 * SLOW, dry=True)
    struck(rough, [(0, 1.0)], [1.0, 0.0], [4.0, 0.5])
    assert rough.noted == [2.0]


def test_what_is_prescribed_takes_part_with_its_impulse_alone() -> None:
    """The second drive keeps its speed: its actuator does the work of the impulse that holds it."""
    s = Struck(0.5, (True, False))
    y = struck(s, [(0, 1.0)], [1.0, 0.0], [3.0, -4.0])
    assert y[2:4] == pytest.approx([-1.5, -4.0])
    impulse = -0.5 * 4.5  # by the coupling 0.5 kg
    assert y[4:6] == pytest.approx([0.0, impulse * -4.0])
    with pytest.raises(StoppedError, match="B is driven against its stop by what is prescribed"):
        struck(Struck(0.5, (True, False)), [(1, -1.0)], [0.0, -3.0], [3.0, -4.0])


def test_a_rotor_behind_a_gear_takes_part_and_keeps_its_loss_for_itself() -> None:
    s = Struck(0.5)
    s.rotor = [1.5, 0.0]
    y = struck(s, [(0, 1.0)], [1.0, 0.0], [3.0, -4.0])
    mass = MASS + np.diag([1.5, 0])
    n = np.array([1.0, 0])
    ease = np.linalg.solve(mass, n)
    assert y[2:4] == pytest.approx(np.array([3.0, -4.0]) - ease * 4.5 / ease[0])
    assert s.losses[0] == (2.0, pytest.approx(-1.5 * (9 - 2.25) / 2))  # type: ignore[comparison-overlap]
    assert len(s.losses) == 2


def test_drives_at_rest_after_an_impact_are_decided_on_where_they_rub_or_lie() -> None:
    for rubs, lies, settled in ((True, 0.0, [0]), (False, 1.0, [0]), (False, 0.0, [])):
        s = Struck(0.0)
        s.rubs[0], s.on_stop[0], s.locked[:] = rubs, lies, True
        struck(s, [(0, 1.0)], [1.0, 0.0], [4.0, 0.5])
        assert s.settled == settled
        assert s.locked.tolist() == [True, False]


def test_forces_of_stops_on_joints_are_known_or_follow_from_one_drive() -> None:
    s: Any = Struck()
    s.elastic_joints, s.pressed, s.pushing = {}, [], np.zeros(0)
    s._drive_of = lambda stop: 1
    assert s.joint_forces(0.0, np.zeros(10)).tolist() == [[0.0, 0.0]]
    s.stops[2].resting = 1.0
    assert s.joint_forces(0.0, np.zeros(10)).tolist() == [[0.0, 2.0]]
    s.pressed, s.pushing = [s.stops[2]], np.array([-7.0])
    assert s.joint_forces(0.0, np.zeros(10)).tolist() == [[-7.0, 0.0]]
    s.elastic_joints, s.pressed = {0: UNKNOWN}, []
    s.elastic_force = lambda j, terms: 5.5
    assert s.joint_forces(0.0, np.zeros(10)).tolist() == [[5.5, 2.0]]


class Rolling(TouchState):
    """A wheel whose gap and slip are drives 1 and 2, of three."""

    def __init__(self, free: Any, rough: bool = False) -> None:
        self.d, self.slipped = 3, 0.0
        self.acting: Any = SimpleNamespace(free=np.array(free))
        mass = np.array([[3.0, 0.25, 0.5], [0.25, 2.0, 0.75], [0.5, 0.75, 1.0]])
        self.mass = mass
        self.equation: Any = lambda t, q, u: SimpleNamespace(mass=mass)
        self.closed = {GapContact("W", "gap", 1.0, 0.0, 0.0, drive=1, slip=2, rough=rough)}


def test_a_wheel_that_begins_to_roll_loses_its_slip() -> None:
    """Its momentum along all that is free is kept, the energy of the impulse is lost."""
    s, y = Rolling([True, False, False]), np.array([0.0, 0, 0, 4.0, 0.0, -6.0, *np.zeros(7)])
    before = y[3:6].copy()
    s._stop_slips(y)
    change = y[3:6] - before
    assert y[3:6] == pytest.approx([4.0 - 0.5 * 6 / 3, 0.0, 0.0])
    assert (s.mass @ change)[0] == pytest.approx(0.0, abs=1e-12)
    lost = (before @ s.mass @ before - y[3:6] @ s.mass @ y[3:6]) / 2
    assert s.slipped == pytest.approx(lost)
    assert lost > 0
    still, y = Rolling([True, False, False], rough=True), np.array([0.0, 0, 0, 4.0, 0.0, -6.0, *np.zeros(7)])
    still._stop_slips(y)
    assert (still.slipped, y[5]) == (0.0, -6.0)


def test_a_wheel_that_is_driven_rolls_by_the_work_of_its_drive() -> None:
    s, y = Rolling([False, False, False]), np.array([0.0, 0, 0, 4.0, 0.0, -6.0, *np.zeros(7)])
    s._stop_slips(y)
    assert y[3:6].tolist() == [4.0, 0.0, 0.0]
    given = 0.5 * 6 * 4.0  # the impulse on the first drive times its speed
    assert y[6:9] == pytest.approx([given, 0, 0])
    before = np.array([4.0, 0, -6])
    assert s.slipped == pytest.approx((before @ s.mass @ before - 3 * 16) / 2 + given)


def test_a_motion_without_inertia_is_named_by_the_drive_that_moves_most() -> None:
    for small, light in ((0.9e-24, True), (1.1e-24, False)):
        least, k = lightest(np.diag([3.0, 3 * small]))
        assert (least == 0.0) is light
        assert k == 1 or not light
    least, k = lightest(np.array([[1.0, 2.0], [2.0, 4.0]]))
    assert abs(least) < WEIGHTLESS
    least, k = lightest(np.array([[4.0, 1.0], [1.0, 9.0]]))
    assert least == pytest.approx(1 - 1 / 6)
    assert _solve(np.array([[4.0]]), np.array([6.0]), ["A"]).tolist() == [1.5]
    assert _solve(MASS, MASS @ [1.0, -2.0], ["A", "B"]) == pytest.approx([1, -2])
    for mass, name in (([[0.0]], "A"), ([[-1.0]], "A"), ([[1.0, 0], [0, 0.0]], "B")):
        with pytest.raises(StoppedError, match=f"forces that move {name} move no mass"):
            _solve(np.array(mass), np.ones(len(mass)), ["A", "B"])


class Told(Equation):
    """An equation whose terms are told, without friction."""

    def __init__(self, effort: Any, mass: Any = MASS) -> None:
        self.names, self.dry = ("A", "B"), None
        none = np.zeros(0)
        self.told = Terms(np.array(effort), np.array(mass), none, none, none, none, none, None)

    def __call__(self, t: float, q: Any, u: Any) -> Terms:
        return self.told


def test_accelerations_follow_from_efforts_and_prescribed_ones_keep_theirs() -> None:
    e = Told([0.5, -0.25])
    tau, prescribed = np.array([3.0, 7.0]), np.array([9.0, 1.5])
    c, terms = e.accelerations(0, UNKNOWN, UNKNOWN, prescribed, tau, np.array([True, True]), UNKNOWN, UNKNOWN)
    assert MASS @ c.a == pytest.approx(tau - [0.5, -0.25])
    assert c.effort == pytest.approx(tau)
    c, terms = e.accelerations(
        0, UNKNOWN, UNKNOWN, prescribed, tau, np.array([True, False]), UNKNOWN, UNKNOWN, np.array([2.0, 0])
    )
    a = (3.0 - 0.5 - 0.5 * 1.5) / 4
    assert c.a == pytest.approx([a, 1.5])
    assert c.effort == pytest.approx([3.0, -0.25 + 0.5 * a + 1.5])
    assert terms.mass.tolist() == [[4.0, 0.5], [0.5, 1.0]]
    for lost in (Told([np.nan, 0.0]), Told([0.0, 0.0], [[np.inf, 0], [0, 1]])):
        with pytest.raises(StoppedError, match="does not close, or its drives do not place its links"):
            lost.accelerations(0, UNKNOWN, UNKNOWN, prescribed, tau, np.ones(2, bool), UNKNOWN, UNKNOWN)


def test_a_load_of_a_motion_has_the_positions_of_drives_and_the_time() -> None:
    varying: Any = SimpleNamespace(at=lambda known: known["A"] + 10 * known["B"] + 100 * known["time"])
    load = LoadChannel(varying, ("A", "B"))
    assert load(3.0, np.array([1.0, 2.0]), UNKNOWN) == 321.0
    again = load.again()
    assert (again.varying, again.names, again.sided) == (varying, ("A", "B"), None)
    assert math.isclose(load.known(3.0, np.array([1.0, 2.0]))["B"], 2.0)
