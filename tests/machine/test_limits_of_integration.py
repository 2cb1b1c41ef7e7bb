"""Segments of motions by told guards: which event comes first, what happens at it, when a motion gives up and why."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.machine.motion import integration
from dalembert.machine.motion.equation import DEAD_CENTRE, StoppedError
from dalembert.machine.motion.integration import Integration
from dalembert.machine.motion.occurrences import EventCondition, Guard, say

UNKNOWN: Any = None


class Told(Integration):
    """Two free drives; what a segment does is told, and what happens is kept in ``done``."""

    def __init__(self) -> None:
        self.d, self.end, self.lengths = 2, 9.0, np.array([1.0, 0.5])
        self.acting: Any = SimpleNamespace(free=np.ones(2, bool), late=[], side=np.ones(2), on=[])
        self.equation: Any = SimpleNamespace(dry=None, joints=("X", "Y"))
        self.locked, self.bound, self.rubs = np.zeros(2, bool), np.zeros(2, bool), np.ones(2, bool)
        self.inertia, self.fastest = np.array([2.0, 5.0]), np.array([4.0, 3.0])
        self.sense, self.events, self.ends, self.done = np.ones(2), [], [], []  # type: ignore[var-annotated]
        self.coded, self.careful, self.tolerance, self.refusal = UNKNOWN, False, 1e-9, ""
        self.limits = SimpleNamespace(steps=100, time=50.0)  # type: ignore[assignment]
        self.taken, self.status, self.conditions, self.ended = 0, "ended", [], ()
        self.stops, self.rows, self.waiting = [SimpleNamespace(way=-1.0)] * 3, [], None

    def keep_samples(self) -> None:
        self.done.append("samples")

    def keep(self, t: float, y: Any) -> None:
        self.done.append(("keep", t))


def told(s: Any, *names: str) -> Any:
    for name in names:
        setattr(s, name, lambda *a, name=name: s.done.append((name, *a)))
    return s


def test_a_motion_with_too_many_events_at_once_is_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(integration, "MANY", 3)
    monkeypatch.setattr(integration, "MOST_EVENTS", 5)
    s = Told()
    width = integration.CHATTER * 2.0
    for t in (2.0, 2.0 + 0.3 * width, 2.0 + 0.6 * width, 2.0 + 1.01 * width):
        s._watch_chatter(t)
    with pytest.raises(StoppedError, match=r"3 events within .* s: a part comes to rest and starts again"):
        s._watch_chatter(2.0 + 1.2 * width)
    assert len(s.ends) == 4
    s = Told()
    s.events = [UNKNOWN] * 5
    s._watch_chatter(1.0)
    s.events.append(UNKNOWN)
    with pytest.raises(StoppedError, match="5 events have happened; ask for a shorter time"):
        s._watch_chatter(2.0)


@pytest.mark.parametrize(
    ("locked", "bound", "free", "moves", "rests"),
    [
        ([1, 1], [0, 0], [1, 1], False, True),
        ([1, 0], [0, 1], [1, 1], False, True),
        ([1, 0], [0, 0], [1, 0], False, True),
        ([1, 0], [0, 0], [1, 1], False, False),
        ([1, 1], [0, 0], [1, 1], True, False),
    ],
)
def test_a_machine_rests_where_each_drive_is_held(
    locked: Any, bound: Any, free: Any, moves: bool, rests: bool
) -> None:
    s: Any = Told()
    s.locked, s.bound, s.acting.free = (np.array(x, bool) for x in (locked, bound, free))
    s._others_move = lambda: moves
    assert s._all_rest() is rests


@pytest.mark.parametrize(
    ("mass", "locked", "dead"),
    [
        ([2.0 * integration.UNBOUNDED * 0.99, 5.0], [0, 0], False),
        ([2.0 * integration.UNBOUNDED * 1.01, 5.0], [0, 0], True),
        ([-2.0 * integration.UNBOUNDED * 1.01, 5.0], [0, 0], True),
        ([2.0 * integration.UNBOUNDED * 1.01, 5.0], [1, 0], False),
        ([2.0, 5.1 * integration.UNBOUNDED], [1, 0], True),
    ],
)
def test_steps_are_too_small_at_a_dead_centre_where_the_inertia_grows(
    mass: Any, locked: Any, dead: bool
) -> None:
    s: Any = Told()
    s.locked = np.array(locked, bool)
    s.at = lambda t, y: (UNKNOWN, UNKNOWN, SimpleNamespace(mass=np.diag(mass)))
    assert s._why_too_small(0.0, UNKNOWN, "no reason") == (DEAD_CENTRE if dead else "no reason")
    s.inertia = np.zeros(2)
    assert s._why_too_small(0.0, UNKNOWN, "no reason") == "no reason"

    def stopped(t: float, y: Any) -> Any:
        raise StoppedError("elsewhere")

    s.at = stopped
    assert s._why_too_small(0.0, UNKNOWN, "no reason") == "no reason"


def test_a_motion_stops_near_a_singular_pose() -> None:
    s: Any = Told()
    s.why_stopped = lambda otherwise: otherwise
    for closure, stops in (([0.0, 2.0], False), ([3.0, -1e-9], True)):
        s.at = lambda t, y, closure=closure: (UNKNOWN, UNKNOWN, SimpleNamespace(closure=np.array(closure)))
        if stops:
            with pytest.raises(StoppedError, match="dead centre or a change point"):
                s._near_singular(0.0, UNKNOWN)
        else:
            assert s._near_singular(0.0, UNKNOWN) is False


def test_a_step_that_fails_goes_on_with_care_where_that_helps() -> None:
    """In machine code with friction in numpy; in numpy with friction ten times as coarse, up to a limit."""
    s: Any = Told()
    s._near_singular = lambda t, y: False
    s._why_too_small = lambda t, y, why: why
    s.coded, s.equation.dry = ("code",), True
    s.tolerance = 1e-11
    assert s._go_on_with_care(2.0, "y") == (2.0, "y")
    assert (s.careful, s.tolerance, s.done) == (True, 1e-11, ["samples"])
    s.coded = None
    assert s._go_on_with_care(2.0, "y") == (2.0, "y")
    assert s.tolerance == pytest.approx(1e-10)
    s.tolerance = integration.COARSEST
    with pytest.raises(StoppedError, match="the integration steps become too small"):
        s._go_on_with_care(2.0, "y")
    s.refusal, s.tolerance, s.equation.dry = "it does not close", 1e-9, None
    with pytest.raises(StoppedError, match="it does not close"):
        s._go_on_with_care(2.0, "y")
    assert s.tolerance == 1e-9


@pytest.mark.parametrize(("far", "kept"), [(0.0, 0), (0.9, 0), (1.0, 0), (1.1, 1), (2.5, 2)])
def test_long_steps_count_by_their_way_and_keep_instants_within(far: float, kept: int) -> None:
    """The second drive's way counts by its length, half a metre; each thousand of these has an instant."""
    far *= integration.FAR
    s = Told()
    s.limits = SimpleNamespace(steps=100_000, time=50.0)  # type: ignore[assignment]
    y = np.array([1.0, 2.0, 7.0, 7.0])
    solver: Any = SimpleNamespace(
        t=3.0, y=y + np.array([far / 4, -far / 2, 9, 9]), dense_output=lambda: lambda t: UNKNOWN
    )
    assert s._keep_step(solver, 1.0, y)
    assert s.taken == int(far)
    times = [t for _, t in s.done]
    assert times == pytest.approx([1 + 2 * k / (kept + 1) for k in range(1, kept + 1)])


def test_a_motion_gives_up_where_its_steps_are_used_up() -> None:
    s = told(Told(), "_give_up")
    solver: Any = SimpleNamespace(t=3.0, y=np.array([3.0, 0, 0, 0]), dense_output=lambda: lambda t: UNKNOWN)
    s.taken = 97
    assert s._keep_step(solver, 1.0, np.zeros(4))
    assert s.taken == 100
    s.done.clear()
    assert not s._keep_step(solver, 1.0, np.zeros(4))
    assert [x[0] for x in s.done] == ["_give_up"]


def guard(kind: str, at: float, side: float = 1.0, which: int = 0) -> Guard:
    """A guard that passes zero at a time, seen from the side on which it begins."""
    return Guard(kind, which, lambda t, y: side * (at - t), side)


class Eventful(Told):
    """A step from 1 to 3 s."""

    def __init__(self) -> None:
        super().__init__()
        self.solver: Any = SimpleNamespace(t=3.0, y=np.zeros(10), dense_output=lambda: lambda t: UNKNOWN)
        told(self, "_happen", "_keep_until", "_resume")

    def strikes(self, g: Guard, dense: Any, before: float, after: float) -> float | None:
        at = float(g.value(0.0, UNKNOWN) * g.side)
        return at if before <= at <= after else None

    def _meet(self, g: Guard, when: float, t: float, y: Any) -> Any:
        return when, np.zeros(10)

    def first(self, *guards: Guard) -> tuple[float, list[Guard]] | None:
        met = self._event(self.solver, list(guards), 1.0, np.zeros(10))
        if met is None:
            return None
        return met[0], next(x[3] for x in self.done if x[0] == "_happen")


def test_the_first_event_within_a_step_is_met() -> None:
    early, late, none = guard("corner", 1.5), guard("rest", 2.5, -1.0), guard("rest", 3.5)
    assert Eventful().first(none) is None
    when, some = Eventful().first(late, none, early)  # type: ignore[misc]
    assert (when, some) == (pytest.approx(1.5), [early])
    both = guard("rest", 1.5)
    assert Eventful().first(early, both)[1] == [early, both]  # type: ignore[index]
    stop, beside = guard("stop", 1.5), guard("stop", 1.5 + 2e-13)
    assert Eventful().first(stop, beside)[1] == [stop, beside]  # type: ignore[index]
    assert Eventful().first(stop, guard("stop", 1.5 + 4e-13))[1] == [stop]  # type: ignore[index]
    condition = guard("condition", 1.5 + 1e-13)  # looked up behind the event: at zero there too
    assert Eventful().first(early, condition)[1] == [early, condition]  # type: ignore[index]
    s = Eventful()
    s.first(guard("side", 1.5, -1.0, which=2))
    assert s.bears == {2: 1.0}
    assert ("keep", 1.5) not in s.done
    s = Eventful()
    s.first(early)
    assert (s.bears, s.reached[0]) == ({}, 1.5)
    assert ("keep", pytest.approx(1.5)) in s.done


def test_what_is_let_go_within_a_step_ends_it() -> None:
    s: Any = Eventful()
    s._loose = lambda t, y: [0]
    s._loosening = lambda before, after, dense: 2.0
    s._exactly = lambda t, y, when: np.full(10, when)
    assert s._event(s.solver, [], 1.0, np.zeros(10)) is None
    s.locked[0] = True
    when, y = s._event(s.solver, [], 1.0, np.zeros(10))
    assert (when, y[0]) == (2.0, 2.0)
    assert [x[0] for x in s.done] == ["_keep_until", "_resume"]
    s.acting.free[0] = False  # prescribed: it is not let go
    assert s._event(s.solver, [], 1.0, np.zeros(10)) is None
    late: Any = Eventful()
    late.acting.late, late._all_rest = [0], lambda: True
    for change, ends in ((True, False), (False, True)):
        late.torques_change = lambda y, change=change: change
        assert (late._event(late.solver, [], 1.0, np.zeros(10)) is not None) is ends
    late._all_rest = lambda: False
    assert late._event(late.solver, [], 1.0, np.zeros(10)) is None


class Happening(Told):
    """A state at which guards are crossed."""

    def __init__(self) -> None:
        super().__init__()
        told(self, "strike", "leave", "decide_gaps", "go_over", "_switch")
        self.decided: Any = []

    def settle(self, drives: Any, t: float, y: Any, leaving: Any = ()) -> Any:
        self.done.append(("settle", list(drives), list(leaving)))
        return self.decided

    def latch(self, k: int, t: float, y: Any) -> bool:
        return k == 1

    def happens(self, *crossed: Guard, u: Any = (4.0, 3.0)) -> Any:
        y = np.array([1.0, 2.0, *u, *np.zeros(6)])
        self._happen(2.0, y, list(crossed))
        self.done.remove("samples")
        return y


def test_each_kind_of_event_has_its_consequence() -> None:
    for kind, name in (("hold", "leave"), ("lift", "decide_gaps"), ("corner", "go_over")):
        s = Happening()
        s.happens(Guard(kind, 1, UNKNOWN, 1.0))
        assert [x[0] for x in s.done] == [name]
    s = Happening()
    s.happens(Guard("on", 1, UNKNOWN, 1.0), Guard("off", 0, UNKNOWN, 1.0), Guard("gear", 1, UNKNOWN, 1.0))
    assert s.done == [("_switch", 2.0, 1, "on"), ("_switch", 2.0, 0, "off")]
    assert s.acting.side.tolist() == [1.0, -1.0]
    s = Happening()
    s.happens(*(Guard(*x, UNKNOWN, 1.0) for x in (("stop", 2), ("clutch", 0), ("clutch", 1))))
    (strike,) = s.done
    assert strike[:2] == ("strike", [(2, -1.0), (1, 1.0)])
    s = Happening()
    s.coded, s.careful = UNKNOWN, True
    s.happens()
    assert (s.done, s.careful) == ([], False)


@pytest.mark.parametrize("stops", [True, False])
def test_a_condition_that_is_met_is_noted_and_may_end_the_motion(stops: bool) -> None:
    s = Happening()
    s.conditions = [UNKNOWN, EventCondition("A.speed = 0", 0, "speed", 0.0, stops)]
    s.happens(Guard("condition", 1, UNKNOWN, 1.0))
    assert [(e.time, e.name, say(e.words)) for e in s.events] == [(2.0, "condition", "A.speed = 0")]
    assert say(s.ended) == ("A.speed = 0 at 2 s" if stops else "")


def test_drives_come_to_rest_where_they_turn_or_their_contacts_do() -> None:
    s = Happening()
    y = s.happens(Guard("rest", 1, UNKNOWN, 1.0))
    assert y[:4].tolist() == [1.0, 2.0, 4.0, 0.0]
    assert s.done == [("settle", [1], [])]
    still = 4.0 * 1e-9  # a billionth of the greatest speed so far
    for speed, rests in ((still, [0]), (-still, [0]), (1.01 * still, [])):
        s = Happening()
        s.decided = [1]
        y = s.happens(Guard("slip", 1, UNKNOWN, 1.0), u=(speed, 3.0))
        assert s.done == [("settle", rests, [1])]
        assert bool(y[2] == 0) is bool(rests)
        assert (s.sense.tolist(), s.events) == ([1, 1], [])
    for name in ("locked", "bound"):
        s = Happening()
        getattr(s, name)[0] = True
        s.happens(Guard("contact", 0, UNKNOWN, 1.0), u=(0.0, 3.0))
        assert s.done == [("settle", [], [])]
        assert s.sense.tolist() == [-1, 1]
    s = Happening()
    s.rubs[0] = False
    s.happens(Guard("contact", 1, UNKNOWN, 1.0), u=(0.0, 3.0))
    assert (s.done, s.sense.tolist()) == ([("settle", [], [])], [1, -1])
    assert [(e.name, e.of) for e in s.events] == [("reversal", "Y")]
    assert say(s.events[0].words) == "Y reverses: its friction turns round"


def test_a_corner_is_met_a_little_behind_its_zero() -> None:
    """So far that its value is surely of the other side, by steps that double."""
    s: Any = Told()
    s.rate = lambda t, y: np.ones(2)
    for side in (1.0, -1.0):
        g = Guard("corner", 0, lambda t, y, side=side: side * (2.0 - y[0]), side)  # type: ignore[misc]
        when, y = s._beyond(g, 2.0, np.array([2.0, 5.0]), side * 3.0)
        assert 3.0 * integration.BEYOND < y[0] - 2.0 < 12.0 * integration.BEYOND + 1e-14
        assert when - 2.0 == pytest.approx(y[0] - 2.0)
        assert y[1] - 5.0 == pytest.approx(y[0] - 2.0)
    ended: Any = Told()
    ended.rate, ended.end = s.rate, 2.0 + 1e-15
    assert ended._beyond(g, 2.0, np.array([2.0, 5.0]), 3.0)[0] == 2.0


@pytest.mark.parametrize(("slope", "root"), [(1.0, 2.0 + 1e-5), (-3.0, 2.0 - 1e-5)])
def test_an_instant_is_found_by_the_motion_itself(slope: float, root: float) -> None:
    s: Any = Told()
    s._exactly = lambda t, y, when: np.array([slope * (when - root)])
    s.rate = lambda t, y: np.array([slope])
    g = Guard("contact", 0, lambda t, y: float(y[0]), 1.0)
    when, y = s._meet(g, 2.0, 1.0, np.array([9.0]))
    assert when == pytest.approx(root, abs=1e-14)
    assert abs(y[0]) < 1e-12
    side = Guard("side", 0, lambda t, y: float(y[0]), 1.0)
    assert s._meet(side, 2.0, 1.0, np.array([9.0]))[0] == 2.0
    start = np.array([9.0])
    when, y = s._meet(g, 1.0, 1.0, start)
    assert (when, y.tolist(), y is start) == (1.0, [9.0], False)
    far = Guard("contact", 0, lambda t, y: float(y[0]) + 0.5, 1.0)  # its zero is not near
    assert s._meet(far, 2.0, 1.0, np.array([9.0]))[0] == 2.0
