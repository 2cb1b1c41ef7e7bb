"""Motions in machine code at their limits: steps where nothing happens, what is watched, conditions of designs."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.machine.motion.coded.coded_motion import CodedState
from dalembert.machine.motion.many.motion_block import MotionBlock
from dalembert.machine.motion.occurrences import EventCondition, Guard

UNKNOWN: Any = None


class Coded(CodedState):
    """Two independent contacts and three that bear on sides, in machine code that watches what is told."""

    def __init__(self, coded: bool = True, dry: bool = True) -> None:
        self.d, self.sense, self.sided = 2, np.ones(2), np.arange(3)
        self.bearing, self.asked = 4.0, 0

        def watch(values: Any, t: Any, y: Any) -> Any:
            self.asked += 1
            return np.array([[9.0, 9.0]]), np.array([[1.0, 2, 3, -40, 5, 6, 7, 8, 9, 10, 11]])

        own = np.array([1, 0])
        self.equation: Any = SimpleNamespace(dry=SimpleNamespace(own=own) if dry else None)
        code = SimpleNamespace(rates_watched=watch, rates=lambda values, t, y: 3 * y)
        self.coded = (code, "values") if coded else None  # type: ignore[assignment]
        self.forget()

    def solved(self, t: float, y: Any) -> Any:
        self.asked += 1
        margins = np.array([1.5, 2.5, 3.5, 4.5, 5.5, -6.5])
        return SimpleNamespace(margins=margins, room=np.array([70.0, 80.0])), UNKNOWN, UNKNOWN


def test_what_is_watched_is_read_in_its_places_and_kept_for_a_state() -> None:
    s, y = Coded(), np.array([1.0, 2.0])  # type: ignore[abstract]
    assert s.rubbing_rates(0.5, y).tolist() == [1, 2]
    assert s.margins(0.5, y).tolist() == [3, -40, 5, 6, 7, 8]
    assert s.room(0.5, y).tolist() == [9, 10]
    assert (s.bearing, s.asked) == (40.0, 1)
    s.room(0.5, y + 1)
    s.room(0.75, y + 1)
    assert s.asked == 3
    s.forget()
    s.room(0.75, y + 1)
    assert s.asked == 4
    assert s.rate(0.5, y).tolist() == [3.0, 6.0]


def test_without_machine_code_it_is_the_solution_itself() -> None:
    s, y = Coded(coded=False), np.array([1.0, 2.0])  # type: ignore[abstract]
    assert s.margins(0.5, y).tolist() == [1.5, 2.5, 3.5, 4.5, 5.5, -6.5]
    assert s.bearing == 6.5
    assert s.room(0.5, y).tolist() == [80, 70]
    assert s.own(np.array([5.0, 6.0])).tolist() == [6, 5]


N = 4


def records(*values: Any) -> Any:
    """Steps of half a second, of a state of four numbers whose third ends at these values, moving by 2 a second."""
    out = np.zeros((len(values), 2 + 8 * N))
    out[:, 0], out[:, 1] = 0.5 * np.arange(len(values)), 0.5
    out[:, 2 + N + 2] = values
    out[:, 2 + 3 * N + 2] = 2.0
    return out


def quiet(guards: list[Guard], *values: Any, watched: Any = None) -> int:
    s: Any = Coded()  # type: ignore[abstract]
    code = SimpleNamespace(n=N, rates_watched=lambda values, t, y: (UNKNOWN, np.zeros((len(y), 1))))
    s.coded = code, UNKNOWN
    seen = np.zeros((len(values), 1)) if watched is None else np.array(watched, float)[:, None]
    return int(s.quiet(records(*values), seen, guards))


def column(column: int = 2, side: float = 1.0, **more: Any) -> Guard:
    return Guard(more.pop("kind", "stop"), 0, UNKNOWN, side, column=column, **more)


@pytest.mark.parametrize(
    ("guard", "values", "count"),
    [
        (column(), [3.0, 1.0, 0.0, -1e-9], 3),
        (column(side=-1.0), [-3.0, 1.0, -2.0], 1),
        (column(level=2.0), [3.0, 2.0, 1.9], 2),
        (column(least=0.5), [3.0, -0.5, -0.51], 2),
        (column(), [3.0, 1.0], 2),
        (column(), [-3.0, 1.0], 0),
        (column(column=-1), [3.0, 1.0], 0),  # it is not watched
        (column(side=0.0), [3.0, 1.0], 0),  # its side is not known
        (column(side=0.0, kind="side", least=0.5), [0.5, -2.0, -3.0, 0.4, 0.6], 4),
        (column(side=0.0, kind="side", least=9.0), [0.5, -2.0], 2),
    ],
)
def test_steps_are_quiet_up_to_the_first_in_which_a_guard_changes(
    guard: Guard, values: Any, count: int
) -> None:
    assert quiet([guard], *values) == count


def test_of_several_guards_the_first_change_counts_also_of_what_is_watched() -> None:
    both = [column(), column(column=N)]
    assert quiet(both, 3, 2, 1, 1, watched=[1, 1, -1, 1]) == 2
    assert quiet(both, 3, -2, 1, 1, watched=[1, 1, -1, 1]) == 1
    assert quiet([], 3, 2) == 2
    free = column(side=0.0, kind="side", least=0.5)
    quiet([free], 0.5, -2.0, -3.0)
    assert free.side == -1.0


@pytest.mark.parametrize(("trend", "count"), [(-1.0, 0), (1.0, 2), (0.0, 2)])
def test_a_step_in_which_a_corner_comes_near_and_goes_again_is_not_quiet(trend: float, count: int) -> None:
    """It grows at the end of each step; had it fallen at the start, it may have passed zero between."""
    g = column(kind="corner", trend=trend)
    assert quiet([g], 3.0, 4.0) == count
    assert g.trend == (pytest.approx(2.0 * 1e-6 * 0.5, rel=1e-6) if count else trend)
    assert quiet([column(kind="contact", trend=-1.0)], 3.0, 4.0) == 2


@pytest.mark.parametrize("rough", ["pressed", "elastic_joints", "laws", "careful", "stuck"])
def test_what_is_rough_is_not_in_machine_code(rough: str) -> None:
    s: Any = Coded()  # type: ignore[abstract]
    made: list[Any] = []
    acting = SimpleNamespace(
        free=np.array([True, False]), laws={}, motors={}, brake=np.array([3.0, 5.0]), acceleration=np.array([7.0, 9.0]),
        lines=lambda u, ahead: (np.array([10.0, 11]), np.array([12.0, 13])),
    )  # fmt: skip
    s.acting, s.locked, s.stuck = acting, np.zeros(2, bool), np.zeros(2, bool)
    s.pressed, s.elastic_joints, s.careful, s.toward = [], {}, False, np.array([-1.0, 1.0])
    s.equation.steps = lambda free: made.append(free.tolist()) or "code"  # type: ignore[func-returns-value]
    s.equation.values = np.array([99.0])
    code, values = s.machine(0.0, np.zeros(4))
    assert (code, made) == ("code", [[True, False]])
    assert values.tolist() == [99, 10, 11, 12, 13, 3, 0, 0, 9, 1, 1, 0, 0]
    if rough == "laws":
        acting.laws = {1: UNKNOWN}
    elif rough == "stuck":
        s.stuck[0] = True
    else:
        setattr(s, rough, [UNKNOWN])
    assert s.machine(0.0, np.zeros(4)) is None
    if rough == "stuck":
        acting.free = np.ones(2, bool)
        assert s.machine(0.0, np.zeros(4)) is not None
        acting.lines = lambda u, ahead: None
        assert s.machine(0.0, np.zeros(4)) is None


def block(*conditions: EventCondition) -> MotionBlock:
    equation: Any = SimpleNamespace(names=("A", "B"))
    code: Any = SimpleNamespace(n=N)
    return MotionBlock(equation, code, conditions, 9.0, 1e-9, 3, np.ones(2))


def step(t: float, h: float, old: Any, new: Any) -> Any:
    """A step along which each number changes evenly."""
    out = np.zeros(2 + 8 * N)
    slope = (np.array(new, float) - old) / h
    out[0], out[1], out[2 : 2 + N], out[2 + N : 2 + 2 * N] = t, h, old, new
    out[2 + 2 * N : 2 + 3 * N] = out[2 + 3 * N : 2 + 4 * N] = slope
    return out


def condition(drive: int, what: str, value: float) -> EventCondition:
    return EventCondition("c", drive, what, value, True)


def test_conditions_are_met_in_steps_that_pass_their_value() -> None:
    """Not in one that begins at it, but in one that ends at it."""
    b = block()
    rows = np.array(
        [step(0, 1, [0, x, 0, 0], [0, y, 0, 0]) for x, y in ((1, 3), (3, 1), (2, 3), (1, 2), (3, 4))]
    )
    assert b._meets(condition(1, "position", 2.0), rows).tolist() == [True, True, False, True, False]
    speeds = np.array([step(0, 1, [0, 0, x, 0], [0, 0, y, 0]) for x, y in ((1, 3), (5, 6))])
    assert b._meets(condition(0, "speed", 2.0), speeds).tolist() == [True, False]


def test_a_design_ends_at_the_first_condition_that_it_meets() -> None:
    rows = np.array(
        [
            step(0.0, 1.0, [0, 0, 4, 0], [4, 0, 4, 0]),
            step(1.0, 2.0, [4, 0, 4, 0], [0, 0, -4, 0]),
            step(0.0, 1.0, [5, 0, 4, 0], [5, 0, 3, 0]),
        ]
    )
    design = np.array([0, 0, 2])
    time, met = block(condition(0, "position", 1.0), condition(0, "speed", 3.0))._ends(rows, design, 4)
    assert met.tolist() == [0, -1, 1, -1]
    assert time == pytest.approx([0.25, 9.0, 1.0, 9.0])
    time, met = block(condition(0, "speed", 3.0), condition(0, "position", 1.0))._ends(rows, design, 3)
    assert met.tolist() == [1, -1, 0]
    time, met = block(condition(0, "speed", 0.0), condition(0, "position", 3.0))._ends(
        rows[1:2], design[1:2], 1
    )
    assert (met.tolist(), time) == ([1], pytest.approx([1.5]))  # type: ignore[comparison-overlap]
    assert math.isclose(block()._ends(rows, design, 1)[0][0], 9.0)
