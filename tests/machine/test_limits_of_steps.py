"""Steps of motions: their first length, states within them, and the guards that are crossed in one, at their limits."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.machine.motion.coded.steps import Between, between, first_step
from dalembert.machine.motion.occurrences import Guard
from dalembert.machine.motion.stepping import StepState

UNKNOWN: Any = None


def test_a_step_that_stands_stays_and_one_of_a_polynomial_is_exact() -> None:
    y = np.array([3.0, -5.0])
    stands = Between.standing(2.0, y)
    assert stands(2.0).tolist() == stands(2.7).tolist() == [3.0, -5.0]
    t, h = 2.0, 0.5
    new, f, ahead = y + np.array([0.7, 1.1]), np.array([2.0, -4.0]), np.array([1.0, 6.0])
    rest = np.zeros(8)
    record = np.concatenate([[t, h], y, new, f, ahead, rest])
    found = between(np.tile(record, (5, 1)), t + h * np.array([0.0, 0.25, 0.5, 0.8, 1.0]))
    for x, row in zip((0.0, 0.25, 0.5, 0.8, 1.0), found, strict=True):  # Hermite's cubic
        cubic = (
            y * (1 - 3 * x**2 + 2 * x**3) + new * (3 * x**2 - 2 * x**3)
            + h * f * (x - 2 * x**2 + x**3) + h * ahead * (x**3 - x**2)
        )  # fmt: skip
        assert row == pytest.approx(cubic, rel=1e-14)


@pytest.mark.parametrize(
    ("y", "f", "second", "room", "pace", "step"),
    [
        # by hand: |y| / scale = 1e4 each, so that d0 = 1e4; d1, d2 of the rates, times in 1 / pace
        (1.0, 2.0, 0.0, 9.0, 1.0, (0.01 / 2e4) ** (1 / 8)),
        (1.0, 2.0, 0.0, 0.05, 1.0, 0.05),
        (1.0, 2.0, 400.0, 9.0, 1.0, (0.01 / 4e6) ** (1 / 8)),
        (1.0, 200.0, 0.0, 9.0, 1.0, 100 * 0.01 / 200),
        (1.0, 8.0, 0.0, 9.0, 4.0, (0.01 / 2e4) ** (1 / 8) / 4),
        (1.0, 0.0, 0.0, 9.0, 1.0, 1e-6),  # where all rests
    ],
)
def test_the_first_step_is_that_of_its_rates(
    y: float, f: float, second: float, room: float, pace: float, step: float
) -> None:
    """Hairer, Norsett and Wanner, II.4; the scale is the tolerance times the size of the state."""
    rate = np.array([[f, f]])
    found = first_step(
        np.array([[y, y]]),
        rate,
        lambda h: rate + second * h[:, None],
        room,
        1e-4,
        (np.zeros((1, 2)), np.array([pace])),
    )
    assert found == pytest.approx([step], rel=1e-9)


class Stepping(StepState):
    """A state of one drive with no equation."""

    def __init__(self) -> None:
        self.d, self.bearing = 1, 50.0


def test_a_guard_crosses_beyond_its_least_amount_and_learns_its_side() -> None:
    s = Stepping()
    told = [0.0]
    g = Guard("corner", 0, lambda t, y: told[0], 1.0, least=0.1)
    for value, crossed in ((0.5, False), (-0.1, False), (-0.11, True)):
        told[0] = value
        assert s._crosses(g, 0.0, UNKNOWN) is crossed
    free = Guard("side", 0, lambda t, y: told[0], 0.0, least=0.1)
    for value, side in ((0.1, 0.0), (-0.11, -1.0)):
        told[0] = value
        assert not s._crosses(free, 0.0, UNKNOWN)
        assert free.side == side


def test_guards_begin_on_their_side_or_at_zero() -> None:
    s, y = Stepping(), np.array([2.0, 1.0])
    guards = [
        Guard("corner", 0, lambda t, y: -3.0),
        Guard("corner", 0, lambda t, y: -1.9e-12),
        Guard("corner", 0, lambda t, y: 2.1e-12),
        Guard("corner", 0, lambda t, y: -3.0, 1.0),
        Guard("side", 0, lambda t, y: 4.9e-8),
        Guard("side", 0, lambda t, y: -5.1e-8),
    ]
    s.take_side(guards, 0.0, y)
    assert [g.side for g in guards] == [-1.0, 0.0, 1.0, 1.0, 0.0, -1.0]
    assert [g.least for g in guards[-2:]] == pytest.approx([5e-8] * 2)


def test_the_root_of_a_guard_is_within_its_step() -> None:
    s = Stepping()

    def root(value: Any, side: float, kind: str = "corner", **more: Any) -> float:
        g = Guard(kind, 0, lambda t, y: value(t), side, **more)
        return s._root(g, lambda t: UNKNOWN, 1.0, 3.0)

    assert root(lambda t: 2.25 - t, 1.0) == pytest.approx(2.25, rel=1e-14)
    assert root(lambda t: t - 2.25, -1.0) == pytest.approx(2.25, rel=1e-14)
    assert root(lambda t: 1 - t, 1.0) == 1.0
    assert root(lambda t: 0.5 - t, 1.0) == 1.0
    assert root(lambda t: 3 - t, 1.0) == 3.0
    assert root(lambda t: 3.5 - t, 1.0) == 3.0
    assert root(lambda t: 2.25 - t, 1.0, turned=2.0) == 2.0
    assert root(lambda t: 0.05 + (1 - t) * 0.2, 1.0, "slip", least=0.1) == pytest.approx(1.75)
    assert root(lambda t: 0.15 + (1 - t) * 0.2, 1.0, "slip", least=0.1) == pytest.approx(1.75)


def test_a_condition_that_is_passed_and_passed_back_within_a_step_is_met() -> None:
    s: Any = Stepping()

    def dips(value: Any, kind: str = "clutch", side: float = 1.0, trend: float = -1.0) -> tuple[bool, Guard]:
        g = Guard(kind, 0, lambda t, y: float(value(y[0])), side, trend)
        solver = SimpleNamespace(
            t=3.0, y=np.array([3.0]), ahead_rate=np.array([1.0]), dense_output=lambda: lambda t: np.array([t])
        )
        return s._dips(g, solver, 1.0), g

    low = lambda x: (x - 2.2) ** 2 - 0.01  # noqa: E731
    found, g = dips(low)
    assert found
    assert g.turned == pytest.approx(2.2, abs=1e-5)
    assert dips(lambda x: -low(x), side=-1.0)[0]  # type: ignore[no-untyped-call]
    assert not dips(lambda x: low(x) + 0.02)[0]  # type: ignore[no-untyped-call]
    assert dips(lambda x: low(x) + 0.02)[1].turned == math.inf  # type: ignore[no-untyped-call]
    assert not dips(low, trend=1.0)[0]
    assert not dips(low, "contact")[0]
    assert not dips(low, side=0.0)[0]
    assert not dips(lambda x: 5 - x)[0]


@pytest.mark.parametrize("kind", ["corner", "condition"])
def test_what_may_pass_zero_anywhere_is_looked_at_within_a_step(kind: str) -> None:
    """Where steps are not chosen by it: without a number of the state."""
    s: Any = Stepping()
    dense = lambda t: np.array([t])  # noqa: E731
    solver = SimpleNamespace(t=3.0, y=np.array([3.0]), dense_output=lambda: dense)
    values = (
        lambda x: (x - 2.2) ** 2 - 0.01,
        lambda x: (x - 2.2) ** 2 + 0.01,
        lambda x: math.cos(40 * (x - 1)),
    )
    guards = [Guard(kind, k, lambda t, y, f=f: float(f(y[0])), 1.0) for k, f in enumerate(values)]
    plain = Guard(kind, 3, lambda t, y: float(y[0] - 2), -1.0, column=0)
    unknown = Guard(kind, 4, lambda t, y: -1.0, 0.0)
    s._look_within([*guards, plain, unknown], solver, 1.0)
    assert [s._dips(g, solver, 1.0) for g in guards] == [True, False, True]
    assert abs(guards[0].turned - 2.2) < 0.1
    assert 1.039 < guards[2].turned < 1.12
    assert [g.turned for g in (guards[1], plain, unknown)] == [math.inf] * 3
    assert not s._dips(Guard("clutch", 5, unknown.value, 0.0), solver, 1.0)
