"""Motions of many designs side by side: what each step, event, stop and rest does to the designs concerned alone."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.machine.motion.many.course import course_events, course_rest, course_stops
from dalembert.machine.motion.many.course.course_events import MANY, MOST_EVENTS, Course
from dalembert.machine.motion.many.course.course_rest import FLICKERS
from dalembert.machine.motion.many.course.course_state import EventMachine
from dalembert.machine.motion.many.course.guards import Guards
from dalembert.machine.motion.many.event_program import EventCode
from dalembert.machine.motion.occurrences import ROUNDING

UNKNOWN: Any = None
STEPS: Any = SimpleNamespace(n=5, watched=8)
"""Two positions, two speeds, the effort of a late motor; watched: a contact, two margins, a stop, a corner."""
ROWS = [
    ("rest", 1, 3),
    ("contact", 0, 5),
    ("stop", 0, 8),
    ("side", 0, 6),
    ("corner", 0, 12),
    ("kink", 1, 3),
    ("on", 1, 13),
    ("off", 1, 1),
    ("condition", 0, 1),
    ("clutch", 0, 8),
    ("lost", 0, 8),
]
KINDS = [row[0] for row in ROWS]


def machine(**more: Any) -> EventMachine:
    code = EventCode(STEPS, UNKNOWN, 2, 1, 2, 0, 1, 0, 1, 1, np.zeros(1, bool))
    given: dict[str, Any] = {
        "code": code, "free": 1, "moves": np.array([False, True]), "alone": True, "drives": 2, "rests": True,
        "first": 2, "sides": np.array([0]), "stop_drives": [1], "guards": Guards.of(ROWS),
        "stops": np.array([kind == "condition" for kind in KINDS]), "by_time": False, "end": 9.0, "tolerance": 1e-9,
        "lengths": np.ones(2), "largest": np.array([7.0]),
    }  # fmt: skip
    return EventMachine(**(given | more))


def course(count: int = 3, **more: Any) -> Any:
    """Designs whose values are a side, another number, lines, brakes, accelerations, a sense and rest."""
    row = [1.0, 50, 10, 20, 0.5, 0.25, -3, -6, 0, 0, 1.0, 0.0]
    values = np.array([row] * count) + np.arange(count)[:, None] * np.array([0, 1, 1, 1, *[0] * 8])
    begin = np.tile([0.5, 1.0, 0.0, 2.0], (count, 1)) + 0.125 * np.arange(count)[:, None]
    return Course(machine(**more), begin, values, np.zeros((count, len(ROWS))), np.ones((count, 2)))


def test_what_is_watched_has_its_places() -> None:
    code = EventCode(STEPS, UNKNOWN, 3, 2, 4, 6, 2, 5, 7, 1, np.zeros(1, bool))
    names = ("contacts", "margins", "sticking", "stops", "lost", "corners")
    assert [code.place(name) for name in names] == [0, 2, 6, 12, 22, 27]


def test_guards_are_found_by_their_kinds() -> None:
    guards = Guards.of(ROWS)
    assert len(guards) == 11
    assert guards.those("stop", "clutch").tolist() == [2, 9]
    assert guards.those("side").tolist() == [3]
    assert (guards.which[[0, 1, 6]].tolist(), guards.column[[0, 1, 6]].tolist()) == ([1, 0, 1], [3, 5, 13])
    none = Guards.of([])
    assert (len(none), none.those("stop").size) == (0, 0)


def test_designs_begin_with_their_states_lines_and_nothing_met() -> None:
    c = course()
    assert c.y.shape == (3, 5)
    assert c.y[1].tolist() == [0.625, 1.125, 0.125, 2.125, 0.0]
    assert c.fastest.tolist() == [[0.0, 2.0], [0.125, 2.125], [0.25, 2.25]]
    assert c.lines[1].tolist() == [11.0, 21.0, 0.5, 0.25]
    assert (c.met.tolist(), c.lost.any(), c.live.all(), np.isnan(c.rest).all()) == (
        [-1] * 3,
        False,
        True,
        True,
    )
    assert [c._given(k) for k in range(4)] == [slice(2 + 2 * k, 4 + 2 * k) for k in range(4)]
    assert c._senses == slice(10, 11)
    assert (c.growth.tolist(), c.size.shape, c.closing.shape) == ([10.0] * 3, (3, 5), (3, 1))


def test_guards_see_the_state_what_is_watched_and_the_time() -> None:
    c = course()
    seen = c.columns(np.arange(5.0)[None], np.arange(10.0, 18)[None], np.array([99.0]))
    assert seen[0].tolist() == [3, 10, 13, 11, 17, 3, 99, 1, 1, 13, 13]
    c.bearing[:] = [1.0, 2.0, 4.0]
    least = c._least(np.array([0, 2]))
    assert least[:, 3] == pytest.approx([ROUNDING, 4 * ROUNDING])
    assert np.delete(least, 3, axis=1).max() == 0.0


def test_designs_are_lost_kept_and_noted_by_themselves() -> None:
    c = course()
    c.lose(np.array([1]))
    assert (c.lost.tolist(), c.live.tolist()) == ([False, True, False], [True, False, True])
    c._keep_version(np.array([0, 2]))
    c._keep_version(np.array([2]))
    assert (c.version.tolist(), len(c.versions)) == ([0, 0, 2], 3)
    assert c.versions[1].tolist() == c.values[2].tolist()
    c.t[:] = [1.0, 2, 3]
    c._note(np.array([2]))
    c._note(np.array([], int))
    ((k, t, version, y),) = c.instants
    assert (k.tolist(), t.tolist(), version.tolist(), y.tolist()) == ([2], [3.0], [2], [c.y[2].tolist()])


def test_motors_that_are_off_have_no_lines_and_brakes_go_against_the_motion() -> None:
    c = course()
    c.on[1] = [0.0, 1.0]
    c.values[:, 2:6] = 99
    c._switch_lines(np.array([1, 2]))
    assert c.values[:, 2:6].tolist() == [[99] * 4, [0, 21, 0, 0.25], [12, 22, 0.5, 0.25]]
    c.toward[:] = [1.0, -1.0, 1.0]
    c._brake(np.array([1, 2]))
    assert c.values[:, 7].tolist() == [-6.0, 6.0, -6.0]
    c._brake(np.array([1]))
    assert c.values[1, 7] == 6.0
    assert c.values[:, 6].tolist() == [-3.0] * 3


def test_switches_wait_until_they_are_used_and_flickers_are_not_looked_at() -> None:
    c = course()
    c.on[0, 1] = 0.0
    c.used[1, KINDS.index("off")] = True
    c.flickers[:] = [FLICKERS - 1, FLICKERS, FLICKERS + 1]
    waiting = c._waiting(np.arange(3))
    assert waiting[:, KINDS.index("on")].tolist() == [True, False, False]
    assert waiting[:, KINDS.index("off")].tolist() == [True, False, True]
    assert waiting[:, KINDS.index("side")].tolist() == [True, False, False]
    others = [k for k, kind in enumerate(KINDS) if kind not in ("on", "off", "side")]
    assert waiting[:, others].all()


def told(monkeypatch: pytest.MonkeyPatch, ahead: float, back: float, rate: float = 3.0) -> None:
    """Accelerations of the free drive in both senses; the contact's rate is so many times its speed."""

    def look(code: Any, values: Any, t: Any, y: Any) -> Any:
        rates, watched = np.zeros((len(y), 5)), np.zeros((len(y), 8))
        rates[:, 3] = np.where(values[:, 7] < 0, ahead, back)  # the brake tells the sense
        watched[:, 0] = rate * y[:, 3]
        watched[:, 3:7] = [0.25, 0.5, 0.0, -2.0]
        return rates, watched

    for module in (course_rest, course_stops, course_events):
        monkeypatch.setattr(module, "look", look)


@pytest.mark.parametrize(
    ("ahead", "back", "on_stop", "state", "toward"),
    [
        (2.0, 5.0, 0.0, "moves", 1.0),
        (-5.0, -2.0, 0.0, "moves", -1.0),
        (-2.0, 2.0, 0.0, "held", 1.0),
        (2.0, -2.0, 0.0, "lost", 1.0),  # both ways are open
        (1e-9, 2.0, 0.0, "lost", 1.0),  # as good as at its limit
        (-2.0, 1e-9, 0.0, "lost", 1.0),
        (2.0, 5.0, 1.0, "held", 1.0),  # against its stop
        (2.0, 5.0, -1.0, "moves", 1.0),
        (-5.0, -2.0, -1.0, "held", 1.0),
        (-5.0, -2.0, 1.0, "moves", -1.0),
        (2.0, -2.0, 1.0, "moves", -1.0),
        (2.0, -2.0, -1.0, "moves", 1.0),
        (math.nan, 2.0, 0.0, "lost", 1.0),
    ],
)
def test_a_design_at_rest_is_held_or_goes_on_in_the_sense_that_it_is_pushed(
    ahead: float, back: float, on_stop: float, state: str, toward: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    told(monkeypatch, ahead, back)
    c = course()
    c.t[:], c.on_stop[1], c.used[:] = 4.0, on_stop, True
    c._settle(np.array([1]))
    assert (bool(c.lost[1]), bool(c.live[1])) == (state == "lost", state == "moves")
    assert c.y[:, 3].tolist() == [2.0, 0.0, 2.25]
    assert c.live[[0, 2]].all()
    if state == "moves":
        assert (c.toward[1], c.on_stop[1], c.values[1, 7]) == (toward, 0.0, -6 * toward)
        assert c.values[1, 10] == toward
    if state == "held":
        assert (c.rest[1], c.on_stop[1], c.values[1, -1]) == (4.0, on_stop, 1.0)
        assert len(c.instants) == 1
    assert np.isnan(c.rest[[0, 2]]).all()


def test_a_design_at_rest_that_something_may_move_later_is_left_alone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    told(monkeypatch, -2.0, 2.0)
    for by_time, waits, lost in ((True, False, True), (False, True, True), (False, False, False)):
        c = course(by_time=by_time)
        c.used[:, KINDS.index("on")] = not waits
        c.on[:, 1] = 0.0
        c._settle(np.array([1]))
        assert bool(c.lost[1]) is lost
        assert bool(np.isnan(c.rest[1])) is lost
    c = course()
    c._settle(np.array([], int))
    assert c.live.all()


def test_margins_and_speeds_of_stops_are_read_in_their_places(monkeypatch: pytest.MonkeyPatch) -> None:
    told(monkeypatch, -2.0, 2.0)
    c = course()
    watched = np.arange(16.0).reshape(2, 8)
    margin, restitution, slopes = c.stop_block(watched)
    assert (margin.tolist(), restitution.tolist()) == ([[3], [11]], [[4], [12]])
    assert slopes.tolist() == [[[5, 6]], [[13, 14]]]
    y = np.array([[9.0, 9, 2, -3, 9], [9, 9, 1, 0.5, 9]])
    assert c.closing_speeds(y, watched).tolist() == [[10 - 18], [13 + 7]]


@pytest.mark.parametrize("restitution", [0.5, 0.0])
def test_a_design_strikes_its_stop_and_comes_back_or_rests(
    restitution: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its stop is at 1.5 of the free drive, whose margin shrinks with it; others are as they were."""

    def look(code: Any, values: Any, t: Any, y: Any) -> Any:
        rates, watched = np.zeros((len(y), 5)), np.zeros((len(y), 8))
        rates[:, 3] = 4.0
        watched[:, 0] = -y[:, 3]
        watched[:, 3], watched[:, 4], watched[:, 6] = 1.5 - y[:, 1], restitution, 1.0
        return rates, watched

    monkeypatch.setattr(course_stops, "look", look)
    c = course()
    c.y[1, 1], c.y[1, 3] = 1.5 + 1e-9, 3.0
    rests = c.strike(np.array([1]), np.array([[True]]))
    assert rests.tolist() == [restitution == 0]
    assert c.y[1, 3] == pytest.approx(-3.0 * restitution)
    assert c.y[1, 1] == 1.5
    assert c.fastest[1, 1] == 3.0
    assert c.on_stop.tolist() == [0.0, 1.0 if restitution == 0 else 0.0, 0.0]
    assert c.toward[1] == (1.0 if restitution == 0 else -1.0)
    assert c.y[[0, 2], 3].tolist() == [2.0, 2.25]
    if restitution:
        assert c.values[1, 10] == 1.0  # the contact's rate is against the drive's
    assert not c.lost.any()


def test_a_clutch_that_holds_stops_its_design(monkeypatch: pytest.MonkeyPatch) -> None:
    told(monkeypatch, -2.0, 2.0)
    for outputs, alone, lost in ((0, True, False), (1, True, True), (0, False, True)):
        c = course(alone=alone)
        object.__setattr__(c.machine, "code", SimpleNamespace(**{**vars(c.machine.code), "outputs": outputs}))
        c.machine.code.place = lambda what: 3
        c.latch(np.array([2]), np.array([0]))
        assert c.y[:, 3].tolist() == [2.0, 2.125, 0.0]
        assert c.on_stop.tolist() == [0.0, 0.0, -1.0]
        assert c.lost.tolist() == [False, False, lost]


class Happening(Course):
    """What the designs of an event do next is told."""

    def _settle(self, k: Any) -> None:
        self.settled = k.tolist()

    def _begin(self, k: Any, first: bool = False, gone: Any = None) -> None:
        self.begun, self.gone = k.tolist(), gone

    def strike(self, k: Any, met: Any) -> Any:
        self.struck = (k.tolist(), met.tolist())
        return np.array([True] * len(k))

    def latch(self, k: Any, which: Any) -> None:
        self.latched = (k.tolist(), which.tolist())

    def find_nested_sides(self, k: Any, before: Any) -> None:
        self.nested = (k.tolist(), before[:, 0].tolist())


def happening(*kinds: str, **more: Any) -> Any:
    """Of three designs the second and third meet guards of these kinds."""
    c: Any = course(**more)
    c.__class__ = Happening
    c.settled = c.begun = c.struck = c.latched = None
    met = np.zeros((2, len(ROWS)), bool)
    for k, kind in enumerate(kinds):
        met[k, KINDS.index(kind)] = True
    c.t[:], c.began[:], c.longest[:] = 4.0, 1.0, 1.0
    c._happen(np.array([1, 2]), met)
    return c


def test_events_of_designs_have_their_consequences() -> None:
    c = happening("condition", "rest")
    assert (c.met.tolist(), c.live.tolist()) == ([-1, KINDS.index("condition"), -1], [True, False, True])
    assert (c.settled, c.begun, c.events.tolist()) == ([2], [2], [0, 1, 1])
    c = happening("on", "off")
    assert c.on[:, 1].tolist() == [1.0, 1.0, 0.0]
    assert c.used[1, KINDS.index("on")]
    assert c.used[2, KINDS.index("off")]
    assert c.used.sum() == 2
    assert c.values[2, 2:6].tolist() == [12.0, 0.0, 0.5, 0.0]
    c = happening("contact", "corner")
    assert c.values[:, 10].tolist() == [1.0, -1.0, 1.0]
    assert c.values[:, 0].tolist() == [1.0, 1.0, -1.0]
    assert c.nested == ([2], [1.0])  # with its side of before
    assert (c.settled, c.begun) == ([], [1, 2])
    assert np.flatnonzero(c.gone[1]).tolist() == [KINDS.index("corner")]
    assert not c.gone[0].any()
    c = happening("stop", "clutch")
    assert (c.struck, c.latched, c.settled) == (([1], [[True]]), ([2], [0]), [1, 2])
    c = happening("lost", "side")
    assert (c.lost.tolist(), c.begun) == ([False, True, False], [2])
    assert [k.tolist() for k, *_ in c.instants] == []  # sides alone are noted by nobody
    c = happening("kink", "contact")
    assert [k.tolist() for k, *_ in c.instants] == [[1, 2]]
    assert np.flatnonzero(c.gone[0]).tolist() == [KINDS.index("kink")]


def test_a_contact_that_turns_at_rest_brings_its_drive_to_rest() -> None:
    for part, rests, settled in ((1e-9, True, [2]), (1.01e-9, True, []), (1e-9, False, [])):
        c: Any = course(rests=rests)
        c.__class__, c.fastest[2] = Happening, [5.0, 1.0]
        c.y[2, 3] = -5 * part
        met = np.zeros((1, len(ROWS)), bool)
        met[0, KINDS.index("contact")] = True
        c._happen(np.array([2]), met)
        assert c.settled == settled


def test_events_in_turn_lose_a_design_only_beyond_their_limit() -> None:
    """A segment of a step or two flickers; a longer one begins anew."""
    for since, flickers in ((2.0, 8), (2.01, 0)):
        c: Any = course()
        c.__class__, c.flickers[:], c.longest[:] = Happening, 7, 1.0
        c.t[:], c.began[:] = 5.0, 5.0 - since
        c._happen(np.array([1]), np.zeros((1, len(ROWS)), bool))
        assert c.flickers.tolist() == [7, flickers, 7]
    for kind, count, limit in (("corner", "flickers", MANY), ("rest", "events", MOST_EVENTS)):
        for before, lost in ((limit - 1, False), (limit, True)):
            c = course()
            c.__class__, c.longest[:] = Happening, 9.0
            getattr(c, count)[:] = before
            met = np.zeros((1, len(ROWS)), bool)
            met[0, KINDS.index(kind)] = True
            c._happen(np.array([1]), met)
            assert c.lost.tolist() == [False, lost, False]


def test_sides_of_what_began_at_zero_are_those_behind_the_first_step() -> None:
    c = course()
    c.side[:, :2] = [[0.0, 1.0], [0.0, 0.0], [0.0, 0.0]]
    value = np.zeros((3, 2, len(ROWS)))
    value[:, 0, :2], value[:, 1, :2] = [-3.0, -4.0], [5.0, 6.0]
    taken = np.array([[True, True], [False, True], [False, False]])
    least = np.zeros((3, len(ROWS)))
    least[1, 1] = 6.0
    c._find_sides(np.arange(3), value, taken, least)
    assert c.side[:, :2].tolist() == [[-1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]
    assert not c.side[:, 2:].any()


def test_steps_are_stored_with_their_design_and_version_and_margins_remembered() -> None:
    c = course()
    c.version[:] = [5, 6, 7]
    records = np.arange(2 * 3 * 60.0).reshape(2, 3, 60)
    taken = np.array([[True, False, True], [False, True, False]])
    c._store(np.array([2, 0]), records, taken)
    assert (c.of[0].tolist(), c.by[0].tolist()) == ([2, 2, 0], [7, 7, 5])
    size = c.rows[0].shape[1]
    assert c.rows[0].tolist() == [
        records[0, 0, :size].tolist(),
        records[0, 2, :size].tolist(),
        records[1, 1, :size].tolist(),
    ]
    c.bearing[:] = [1.0, 2.0, 30.0]
    watched = np.zeros((2, 2, 8))
    watched[0, :, 1:3], watched[1, :, 1:3] = [[3.0, -9], [4, 5]], [[3.0, -9], [4, 5]]  # type: ignore[assignment]
    c._see_margins(np.array([1, 2]), watched)
    assert c.bearing.tolist() == [1.0, 9.0, 30.0]
