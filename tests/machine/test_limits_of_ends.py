"""Ends of motions and their pieces: rest, conditions that are not met, what is kept, pieces joined, starts on stops."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.motion.coordinates import pieces
from dalembert.machine.motion.corners.elastic_joints import ElasticState
from dalembert.machine.motion.equation import StoppedError, Terms
from dalembert.machine.motion.occurrences import EventCondition, say
from dalembert.machine.motion.stops.impacts import Stop, StopState
from dalembert.model.drives.end_stops import Stops
from tests.machine.test_limits_of_integration import Told, told

UNKNOWN: Any = None


def test_a_machine_at_rest_waits_until_it_is_let_go_or_to_the_end() -> None:
    s: Any = told(Told(), "_keep_until", "_resume")
    s.rows, s.by_time, s._let_go = [(1.0,)], [], lambda t, end, y: 4.0
    assert s._rest(2.0, UNKNOWN) == 4.0
    assert [x if isinstance(x, str) else x[0] for x in s.done] == ["samples", "_keep_until", "_resume"]
    s.done, s._let_go = [], lambda t, end, y: end
    assert s._rest(2.0, UNKNOWN) == 9.0
    assert say(s.ended) == "at rest from 2 s on"
    assert s.done[-1] == ("keep", 9.0)
    assert s.status == "ended"
    s.rows = [(9.0,)]
    s.done = []
    s._rest(2.0, UNKNOWN)
    assert ("keep", 9.0) not in s.done


@pytest.mark.parametrize(
    ("by_time", "why"),
    [([], ", and no force moves it any more"), ([UNKNOWN], ", as far as until 50 s")],
)
def test_a_machine_at_rest_without_an_end_says_what_is_not_met(by_time: Any, why: str) -> None:
    s: Any = told(Told(), "_keep_until")
    s.rows = [(1.0,)]
    s.end, s.by_time, s._let_go = math.inf, by_time, lambda t, end, y: end
    s.conditions = [EventCondition("A.speed = 0", 0, "speed", 0.0, True)]
    s._rest(2.0, UNKNOWN)
    assert s.status == "not_met"
    assert say(s.ended).startswith(f"at rest from 2 s on{why}: ")
    assert say(s.ended).endswith(" not met")
    assert "A.speed = 0" in say(s.ended)


def test_what_is_awaited_is_said_in_words() -> None:
    s = Told()
    texts = (("A.speed = 0", True), ("B.speed = 0", False), ("B.position = 2 m", True))
    s.conditions = [EventCondition(text, 0, "speed", 0.0, stops) for text, stops in texts]
    assert s._awaited == "A.speed = 0 or B.position = 2 m are"
    s.conditions = s.conditions[:2]
    assert s._awaited == "A.speed = 0 is"
    s.rows, s.taken = [(1.0,)], 7  # type: ignore[list-item]
    s._give_up(2.0, UNKNOWN)
    assert (s.status, say(s.ended)) == ("not_met", "A.speed = 0 is not met within 7 steps, to 2 s")
    assert s.done == ["samples", ("keep", 2.0), "samples"]
    s.done, s.rows = [], [(2.0,)]  # type: ignore[list-item]
    s._give_up(2.0, UNKNOWN)
    assert s.done == ["samples"]
    s._give_up(50.0, UNKNOWN)
    assert say(s.ended) == "A.speed = 0 is not met until 50 s"
    assert [(e.name, say(e.words)) for e in s.events][-1] == ("not met", say(s.ended))


def test_a_motion_that_stops_keeps_the_state_that_it_reached() -> None:
    s = Told()
    s.rows, s.reached = [(1.0,)], (2.0, UNKNOWN)  # type: ignore[list-item]
    s.stop(StoppedError("it jams"))
    assert s.done == ["samples", ("keep", 2.0), "samples"]
    assert (s.status, say(s.ended)) == ("stopped", "stopped at 1 s: it jams")
    assert [(e.time, e.name, say(e.words)) for e in s.events] == [(1.0, "stopped", say(s.ended))]
    s.done, s.reached = [], (1.0, UNKNOWN)
    s.stop(StoppedError("it jams"))
    assert s.done == ["samples"]
    s.done, s.rows = [], []
    s.stop(StoppedError("it jams"))
    assert (s.done, say(s.ended)) == (["samples"], "stopped at 0 s: it jams")
    with pytest.raises(KeyboardInterrupt):
        s._interrupted()
    s.rows, s.parts = [(1.0,), (1.5,)], [1, 2, 3]  # type: ignore[list-item]
    s._interrupted()
    assert (s.status, say(s.ended), s.parts) == ("interrupted", "interrupted at 1.5 s", [1, 2])  # type: ignore[comparison-overlap]


@dataclass
class Motion:
    """Poses of one link at instants, each number in its array."""

    turn_array: Any
    point_array: Any
    rotation_array: Any
    twist_array: Any
    acceleration_array: Any


def piece(times: Any, turns: Any, parts: Any = ()) -> Any:
    rows = [(t, np.array([10 * t, 1.0])) for t in times]
    return SimpleNamespace(rows=rows, parts=[np.array(x) for x in parts], acting=UNKNOWN, m=turns)


def test_of_two_states_at_one_instant_the_one_behind_the_event_is_kept() -> None:
    one = piece([1.0, 2.0, 2.0, 3.0], UNKNOWN, [[1.0], [2], [3], [4]])
    one.rows[2] = (2.0, np.array([99.0, 1.0]))
    t, q, parts = pieces._rows(one)
    assert (t.tolist(), q[:, 0].tolist(), parts.tolist()) == ([1, 2, 3], [10, 99, 30], [[1], [3], [4]])
    assert pieces._rows(piece([1.0, 2.0], UNKNOWN))[2].shape == (2, 0)
    (times, *_), motion = pieces.instants([one])
    assert (times.tolist(), motion) == ([1, 2, 3], None)


def test_pieces_are_joined_and_links_turn_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """A second piece that counts its turns anew begins within half a turn of where the first has ended."""

    def motion(turns: Any, rows: Any) -> Motion:
        turn = np.array(turns)[:, None]
        return Motion(turn, turn + 100, turn + 200, turn + 300, turn + 400)

    monkeypatch.setattr(pieces, "_motion", motion)
    whole = 2 * math.pi
    first, second, third = (
        piece([1.0, 2.0], [0.5, 3 * whole + 0.25]),
        piece([2.0, 3.0], [0.3, 0.6]),
        piece([3.0, 4.0], [0.6 - whole, 0.7 - whole]),
    )
    (times, *_), joined = pieces.instants([first, second, third])
    assert times.tolist() == [1, 2, 3, 4]
    assert joined is not None
    turned = 3 * whole + np.array([0.3, 0.6, 0.7])
    assert joined.turn_array[:, 0] == pytest.approx([0.5, *turned])
    places = np.array([0.5, 0.3, 0.6 - whole, 0.7 - whole])
    for k, name in enumerate(("point_array", "rotation_array", "twist_array", "acceleration_array"), 1):
        assert getattr(joined, name)[:, 0] == pytest.approx(places + 100 * k)


class Elastic(ElasticState):
    """Two drives and one joint with an elastic stop, whose force is told, moved by the drives at 3 and -2."""

    def __init__(self, elastic: bool, dry: bool = False) -> None:
        none = np.zeros(0)
        row = np.array([[0.5, 7.0, 0.0, 3.0, -2.0]])
        terms = Terms(np.array([1.0, 2.0]), none, np.array([5.0, 6.0]), none, none, row, none, None)
        self.d, self.elastic_joints = 2, {0: UNKNOWN} if elastic else {}

        def equation(t: float, q: Any, u: Any) -> Terms:
            return terms

        equation.dry = dry  # type: ignore[attr-defined]
        equation.pushed = lambda forces, t, q, u: forces  # type: ignore[attr-defined]
        self.equation: Any = equation

    def elastic_force(self, j: int, terms: Terms) -> float:
        return 4.0


def test_a_stop_of_a_joint_pushes_the_drives_that_move_it() -> None:
    """By 3 and -2 times its force, with the power of its rate; with friction it is one more input."""
    found = Elastic(True).loaded_terms(0.0, UNKNOWN, UNKNOWN)
    assert (found.effort.tolist(), found.power.tolist()) == ([1 - 12, 2 + 8], [5 + 28, 6])
    bare = Elastic(False).loaded_terms(0.0, UNKNOWN, UNKNOWN)
    assert (bare.effort.tolist(), bare.power.tolist()) == ([1, 2], [5, 6])
    rough: Any = Elastic(True, True).loaded_terms(0.0, UNKNOWN, UNKNOWN)
    assert rough == {0: 4.0}


@pytest.mark.parametrize(
    ("x", "placed"),
    [
        (0.5, 0.5),
        (1.0 + 9e-10, 1.0),
        (-0.5 - 9e-10, -0.5),
        (0.5 + 2 * math.pi, 0.5),
        (0.5 - 2 * math.pi, 0.5),
    ],
)
def test_a_joint_starts_between_its_stops_full_turns_counted(x: float, placed: float) -> None:
    s: Any = object.__new__(StopState)
    stop = Stop("J", "turn", Stops(-0.5, 1.0), joint=0)
    s._place_at_start(stop, x, 3.0)
    assert stop.looks == [(0.0, pytest.approx(placed, abs=1e-8), 3.0)]  # type: ignore[comparison-overlap]


@pytest.mark.parametrize(
    ("x", "freedom", "said"),
    [
        (1.25, "slide", "starts beyond its stops, at 1.25 m; start between them"),
        (-1.25, "slide", "starts beyond its stops, at -1.25 m"),
        (2e-9, "slide", "starts beyond its stops, at 2e-09 m"),
        (-5e-10, "slide", "starts beyond its stops, at 0 m"),
        (2.0, "turn", "starts beyond its stops, at 2 rad"),
    ],
)
def test_a_start_beyond_the_stops_is_refused_with_its_place(x: float, freedom: str, said: str) -> None:
    s: Any = object.__new__(StopState)
    s.m = da.loads(
        "units: {angle: rad}\nlinks: {ground: {points: {O: [0, 0]}}, a: {points: {O: [0, 0]}, mass: 1}}"
    )
    ends = Stops(-0.75, -0.5) if abs(x) < 1 else Stops(-0.5, 1.0)
    for stop, path in (
        (Stop("J", freedom, ends, joint=0), ("joints", "J", "stops")),
        (Stop("J", freedom, ends, drive=0), ("start", "J", "position")),
    ):
        with pytest.raises(da.ModelError) as refused:
            s._place_at_start(stop, x, 3.0)
        assert said in str(refused.value)
        assert refused.value.path == path
