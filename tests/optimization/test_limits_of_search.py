"""Searches at their limits: bounds that hold, fronts of equals, designs that close only at their targets, warnings."""

from __future__ import annotations

import warnings
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import scipy.optimize

import dalembert as da
from dalembert.optimization.least_squares import BETWEEN, TargetErrors
from dalembert.optimization.optimizers import DEFAULT, polish_by
from dalembert.optimization.optimizing import problem_of
from dalembert.optimization.pareto_front import _undominated
from dalembert.optimization.side_by_side import _direction, _update


@pytest.mark.parametrize(
    ("u", "slope", "direction"),
    [
        ([0.0, 0.5], [0.0, 1.0], [0.5, -1.0]),  # no slope pushes it through its bound: it may leave it
        ([0.0, 0.5], [1e-9, 1.0], [0.0, -1.0]),
        ([0.0, 0.5], [-1.0, 1.0], [1.5, -1.5]),
        ([1.0, 0.5], [0.0, -1.0], [-0.5, 1.0]),
        ([1.0, 0.5], [-1e-9, -1.0], [0.0, 1.0]),
        ([1.0, 0.5], [1.0, -1.0], [-1.5, 1.5]),
        ([1e-9, 0.5], [1.0, 1.0], [-0.5, -0.5]),
        ([0.5, 1.0], [1.0, -1.0], [-1.0, 0.0]),
        ([0.0, 1.0], [1.0, -1.0], [0.0, 0.0]),
    ],
)
def test_a_step_goes_along_a_bound_that_the_slope_pushes_against(u: Any, slope: Any, direction: Any) -> None:
    """With the inverse [1 -1/2; -1/2 1]: what a bound holds takes no part."""
    inverse = np.array([[[1.0, -0.5], [-0.5, 1.0]]])
    assert _direction(np.array([u]), np.array([slope]), inverse)[0] == pytest.approx(direction, abs=1e-8)


def test_a_direction_that_goes_uphill_is_that_of_the_slope() -> None:
    slope = np.array([[1.0, 2.0]])
    for inverse in (-np.eye(2), np.zeros((2, 2))):
        assert _direction(np.full((1, 2), 0.5), slope, inverse[None]).tolist() == [[-1.0, -2.0]]


@pytest.mark.parametrize("bend", [1.0, 1e-6, 1e-15, 0.0, -1.0])
def test_a_step_without_curvature_teaches_nothing(bend: float) -> None:
    """Of one with curvature the inverse takes the change of the slope to the step."""
    inverse, fresh = np.eye(2)[None].copy(), np.array([True])
    step, change = np.array([[0.1, 0.0]]), np.array([[bend, 1.0]])
    _update(inverse, fresh, np.array([0]), step, change)
    if bend > 1e-12:
        assert inverse[0] @ change[0] == pytest.approx(step[0], abs=1e-9)
        assert not fresh[0]
    else:
        assert inverse.tolist() == [[[1.0, 0.0], [0.0, 1.0]]]
        assert fresh[0]


def test_of_equals_by_one_aim_a_front_has_the_better_by_the_other() -> None:
    """One that is worse by the first must be better by the second by more than a millionth."""
    values = np.array(
        [[1, 5], [2, 5 * (1 - 0.9e-6)], [3, 5 * (1 - 1.1e-6)], [4, 1], [4, 0.5], [5, 0.5], [5, 0.4]]
    )
    assert _undominated(values) == [0, 2, 4, 6]
    assert _undominated(values[::-1]) == [6, 4, 2, 0]
    assert _undominated(values[:1]) == [0]


def errors_of(schedule: Any, ok: Any = None) -> tuple[TargetErrors, list[Any]]:
    """Targets of a kernel that has this schedule, and the positions at which it is asked."""
    asked: list[Any] = []

    class Kernel:
        @staticmethod
        def course(positions: Any) -> Any:
            return SimpleNamespace(schedule=schedule)

        def __call__(self, values: Any, positions: Any, redo: bool) -> Any:
            asked.append(positions)
            return SimpleNamespace(ok=np.array(ok))

    kernel: Any = Kernel()
    return TargetErrors(kernel, np.zeros(1), np.ones(1), np.zeros((1, 1)), np.ones(1), None), asked


def schedule_of(position: Any, speed: Any = 1.0, acceleration: Any = 0.0) -> Any:
    q = np.array(position, float)[:, None]
    rates = (np.broadcast_to(np.array(x, float).reshape(-1, 1), q.shape) for x in (speed, acceleration))
    return SimpleNamespace(**dict(zip(("position", "speed", "acceleration"), (q, *rates), strict=True)))


def test_designs_move_if_they_close_everywhere_between_their_targets() -> None:
    x = np.zeros((3, 1))
    f, asked = errors_of(schedule_of([0.0, 0.8, 0.0]), [[True, True], [True, False], [False, False]])
    assert f.moves(x).tolist() == [True, False, False]
    share = np.arange(1, BETWEEN) / BETWEEN
    assert asked[0].ravel() == pytest.approx(np.concatenate([0.8 * share, 0.8 * (1 - share)]))


@pytest.mark.parametrize(
    "schedule",
    [
        schedule_of([0.4]),
        schedule_of([0.0, 0.5, 1.0], speed=[1, 2, 1]),
        schedule_of([0.0, 0.5, 1.0], acceleration=[1, 0, 1]),
    ],
)
def test_of_a_law_of_motion_or_a_single_position_there_is_nothing_between(schedule: Any) -> None:
    f, asked = errors_of(schedule)
    assert f.moves(np.zeros((2, 1))).tolist() == [True, True]
    assert asked == []


def test_what_an_optimizer_warns_of_is_not_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """That a step left the bounds by rounding."""
    original = scipy.optimize.minimize

    def warning(*given: Any, **options: Any) -> Any:
        warnings.warn("values in x were outside bounds during a minimize step", RuntimeWarning, stacklevel=1)
        return original(*given, **options)

    monkeypatch.setattr(scipy.optimize, "minimize", warning)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        found = polish_by(
            DEFAULT, lambda x: (float(((x - 0.3) ** 2).sum()), 2 * (x - 0.3)), None, np.zeros(1), np.ones(1)
        )
    assert found == pytest.approx([0.3], abs=1e-6)
    assert told == []


def test_a_number_whose_bounds_are_one_place_stays_there() -> None:
    m = da.four_bar(positions=4)
    vary = {"links.rocker.points.B.0": (0.24, 0.24), "links.crank.points.A.0": (0.05, 0.15)}
    nominal = float(m.links["crank"].points["A"][0])
    p, steps, numbers = problem_of(m, vary, "effort.O2", [], None, False)
    assert p.nominal == pytest.approx([0.0, (nominal - 0.05) / 0.1])
    assert p.span == pytest.approx([0.0, 0.1])
    assert p.numbers(np.array([0.7, 0.5])) == pytest.approx([0.24, 0.1])
    assert (len(numbers), np.isnan(steps).all()) == (2, True)
