"""Searches at their limits: bounds that hold, fronts of equals, designs that close only at their targets, warnings."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import scipy.optimize

import dalembert as da
from dalembert.optimization import optimizing, polishing
from dalembert.optimization.least_squares import BETWEEN, Errors, TargetErrors, least_squares, wanted
from dalembert.optimization.optimizers import DEFAULT, OPEN, polish_by
from dalembert.optimization.optimizing import is_alike, problem_of
from dalembert.optimization.pareto_front import Front, _undominated
from dalembert.optimization.polishing import _Design
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


@pytest.mark.parametrize("bend", [1.0, 1e-3, 1e-8, 1e-15, 0.0, -1.0])
def test_a_step_without_curvature_teaches_nothing(bend: float) -> None:
    """Of one with curvature the inverse takes the change of the slope to the step."""
    inverse, fresh = np.eye(2)[None].copy(), np.array([True])
    step, change = np.array([[0.1, 0.0]]), np.array([[bend, 1.0]])
    _update(inverse, fresh, np.array([0]), step, change)
    if bend > 1e-12:
        assert bend < 1e-6 or inverse[0] @ change[0] == pytest.approx(step[0], abs=1e-9)
        assert inverse[0].tolist() == inverse[0].T.tolist()
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


def test_a_front_does_not_go_by_the_sign_of_its_aims() -> None:
    """A sum of an aim and a constant has the same designs, but for those that differ by rounding."""
    values = np.array(
        [[1.0, -1.0], [2.0, -1.0], [3.0, -1.0 - 0.9e-6], [4.0, -1.0 - 1.1e-6], [5.0, -3.0], [6.0, -2.0]]
    )
    assert _undominated(values) == [0, 3, 4]
    for first in (0.0, -10.0):
        for second in (2.0, 0.0, -10.0):
            rows = [(1.0, 5.0), (2.0, 5.0), (3.0, 4.0), (4.0, 4.5), (5.0, 4.0)]
            assert _undominated(np.array([(a + first, b + second) for a, b in rows])) == [0, 2]


@pytest.mark.parametrize(
    ("one", "best", "alike"),
    [
        ((0.0, 2.0), (0.0, 2.0), True),
        ((0.0, 2.0019), (0.0, 2.0), True),
        ((0.0, 2.0021), (0.0, 2.0), False),
        ((0.0, -2.0), (0.0, -2.0), True),
        ((0.0, -1.9981), (0.0, -2.0), True),
        ((0.0, -1.9979), (0.0, -2.0), False),
        ((0.0, 0.0), (0.0, 0.0), True),
        ((0.0, 1e-9), (0.0, 0.0), False),
        ((1e-9, 2.0), (0.0, 2.0), False),
        ((0.5, 1.0), (0.0, 2.0), False),
        ((0.0, np.nan), (0.0, 2.0), False),
    ],
)
def test_designs_within_a_thousandth_of_the_best_are_as_good(one: Any, best: Any, alike: bool) -> None:
    assert is_alike(one, best) is alike


def test_starts_that_end_in_the_best_design_count_though_the_aim_is_negative() -> None:
    """cos 100 x + 5 x is least where sin 100 x = 1/20, first at 31 mm, and by 0.31 more a turn further on."""
    x = "links.crank.points.A.0"
    aim = f"mean (cos(100*{x}) + 5*{x})"
    o = da.optimize(da.four_bar(positions=2), {x: (0.02, 0.11)}, aim, starts=6, static=True)
    best = (np.pi - np.arcsin(0.05)) / 100
    assert o.values == pytest.approx([best], abs=1e-6)
    assert o.value == pytest.approx(np.cos(100 * best) + 5 * best, rel=1e-9)
    assert 1 <= o.found < o.polished
    assert o.words.startswith(f"{o.found} of the ")


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


def test_two_positions_have_places_between_them_too() -> None:
    f, asked = errors_of(schedule_of([0.0, 0.8]), [[True], [False]])
    assert f.moves(np.zeros((2, 1))).tolist() == [True, False]
    assert asked[0].ravel() == pytest.approx(0.8 * np.arange(1, BETWEEN) / BETWEEN)


def test_one_of_two_drives_that_has_a_law_is_enough() -> None:
    steady, law = schedule_of([0.0, 0.5, 1.0]), schedule_of([0.0, 0.5, 1.0], speed=[1, 2, 1])
    both = {k: np.hstack([getattr(steady, k), getattr(law, k)]) for k in vars(steady)}
    f, asked = errors_of(SimpleNamespace(**both))
    assert f.moves(np.zeros((2, 1))).all()
    assert asked == []


class _Line(TargetErrors):
    """Errors A x - b, for the steps alone."""

    def __call__(self, x: Any) -> Any:
        matrix, right = self.target, self.spread
        return self.known(x @ matrix.T - right, np.broadcast_to(matrix, (len(x), *matrix.shape)).copy())

    @staticmethod
    def known(error: Any, slope: Any) -> Errors:
        return Errors((error**2).sum(axis=1) / 2, error, slope)


@pytest.mark.parametrize("seed", range(6))
def test_steps_within_bounds_end_at_the_least_sum_of_squares_in_the_box(seed: int) -> None:
    """As another solver has it, from any start, also from a corner; numbers that change nothing stay."""
    rng = np.random.default_rng(seed)
    matrix, right = rng.normal(size=(5, 3)), rng.normal(size=5)
    matrix[:, 2] *= seed % 3 > 0  # of some the last number has no part
    f = _Line(None, np.zeros(3), np.ones(3), matrix, right, None)  # type: ignore[arg-type]
    best = scipy.optimize.lsq_linear(matrix, right, bounds=(0, 1), tol=1e-14).x
    starts = np.vstack([rng.random((3, 3)), np.zeros(3), np.ones(3), np.eye(3)])
    found, cost = least_squares(f, starts)
    least = ((matrix @ best - right) ** 2).sum() / 2
    assert cost == pytest.approx(np.full(len(starts), least), rel=1e-7)
    assert found[:, :2] == pytest.approx(np.tile(best[:2], (len(starts), 1)), abs=1e-4)
    assert ((found >= 0) & (found <= 1)).all()
    if not matrix[:, 2].any():
        assert found[:, 2].tolist() == starts[:, 2].tolist()


@pytest.mark.parametrize(
    ("targets", "spread"),
    [
        ([[-3.0]], 3.0),
        ([[3.0]], 3.0),
        ([[-3.0, 1.0]], 3.0),
        ([[0.0]], 1.0),
        ([[0.0, 0.0], [3.0, -4.0]], 5.0),
        ([[0.0, 0.0], [-3.0, -4.0], [0.0, -4.0]], 5.0),
        ([[-2.0, 1.0], [-2.0, 1.0]], 2.0),
    ],
)
def test_targets_count_by_their_spread_or_else_by_their_size_or_else_as_1(
    targets: Any, spread: float
) -> None:
    values = np.array(targets)
    kernel: Any = SimpleNamespace(nodes={"of": [0] * values.shape[1], "one": [0]})
    found, spreads = wanted(kernel, {"of": values, "one": np.full(len(values), -7.0)}, None)
    assert found.tolist() == np.hstack([values, np.full((len(values), 1), -7.0)]).tolist()
    assert spreads.tolist() == [[*[spread] * values.shape[1], 7.0]] * len(values)


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


def design(value: float = 2.0) -> tuple[_Design, list[Any]]:
    """Three numbers of which the second is held; the places at which it is asked."""
    asked: list[Any] = []

    def sharp(u: Any) -> tuple[float, Any]:
        return value, np.array([1.0, 5.0, -3.0])

    def at(u: Any) -> Any:
        asked.append(u.tolist())
        return SimpleNamespace(aim=u)

    p: Any = SimpleNamespace(aim=SimpleNamespace(word="rms"), conditions=(), method=DEFAULT, scale=4.0)
    p.sharp, p.at = sharp, at
    return _Design(p, np.array([0.2, 0.4, 0.6]), np.array([True, False, True])), asked


def test_a_polish_moves_free_numbers_within_the_box() -> None:
    d, asked = design()
    assert d.place(np.array([1.5, -0.25])).tolist() == [1.0, 0.4, 0.0]
    assert d.place(np.array([1.0, 0.5])).tolist() == [1.0, 0.4, 0.5]
    for x in ([0.5, 0.5], [0.5, 0.5], [0.5, 0.25], [0.5, 0.25], [0.5, 0.5]):
        assert d.rows(np.array(x)).aim.tolist() == [x[0], 0.4, x[1]]  # type: ignore[attr-defined]
    assert asked == [[0.5, 0.4, 0.5], [0.5, 0.4, 0.25], [0.5, 0.4, 0.5]]
    size, slope = d.aim(np.array([0.5, 0.5]))
    assert (size, slope.tolist()) == (0.5, [0.25, -0.75])
    for unknown in (np.nan, np.inf):
        size, slope = design(unknown)[0].aim(np.array([0.5, 0.5]))
        assert (size, slope.tolist()) == (OPEN, [0.0, 0.0])


@pytest.mark.parametrize(
    ("free", "reached", "found"),
    [
        ([True, False, True], [0.5, 0.75], [0.5, 0.4, 0.75]),
        ([True, False, True], [0.5, np.nan], [0.2, 0.4, 0.6]),
        ([False, False, True], [0.75], [0.2, 0.4, 0.75]),
        ([False, False, False], [], [0.2, 0.4, 0.6]),
        (None, [0.5, 0.5, 0.5], [0.5, 0.5, 0.5]),
    ],
)
def test_a_polish_that_ends_nowhere_stays_where_it_began(
    free: Any, reached: Any, found: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    began: list[Any] = []

    def polished(name: str, aim: Any, rules: Any, start: Any, high: Any) -> Any:
        began.append((start.tolist(), high.tolist(), rules))
        return np.array(reached)

    monkeypatch.setattr(polishing, "polish_by", polished)
    d, _ = design()
    out = polishing.polish(d.p, d.u, None if free is None else np.array(free))
    assert out.tolist() == found
    start = d.u if free is None else d.u[np.array(free)]
    assert began == ([(start.tolist(), [1.0] * len(start), None)] if len(start) else [])


@pytest.mark.parametrize(
    "bounds",
    [
        ("[0.2 m, 0.3 m]", "[0.4 m, 0.1 m]"),
        ("[0.4 m, 0.1 m]", "[0.2 m, 0.3 m]"),
        (0.1, 0.4, "[0.1 m, 0 m]"),
        (0.1, 0.4, "[-0.1 m, 0.1 m]"),
        (0.1, 0.4, 0.0),
    ],
)
def test_bounds_of_which_one_number_is_wrong_are_refused(bounds: Any) -> None:
    with pytest.raises(da.ModelError, match=r"use \(low, high, step\) with low <= high and step > 0"):
        problem_of(da.four_bar(), {"links.ground.points.O4": bounds}, "effort.O2", [], None, False)


def test_a_table_of_a_front_has_the_numbers_of_its_designs() -> None:
    """Not those before, nor their bounds."""
    units = da.four_bar().units

    def one(found: str) -> Any:
        rows = [["a [m]", "before", found, "low", "high"], ["b [m]", "before", f"{found}!", "low", "high"]]
        return SimpleNamespace(
            mechanism=SimpleNamespace(units=units),
            functions={},
            kind_of=lambda text: "number",
            number_rows=lambda units: rows,
        )

    front = Front(
        ("peak effort.O2", "rms effort.A"), (one("1"), one("2")), np.array([[0.5, 4.0], [0.75, 3.0]])
    )
    (table,) = front.contents()
    heads: Any = table
    assert [[cell.strip() for cell in row] for row in heads.rows] == [
        ["0.5", "4", "1", "1!"],
        ["0.75", "3", "2", "2!"],
    ]


def test_values_in_steps_are_counted_from_the_lower_bound_whatever_the_span() -> None:
    """Of 30 mm in a span of 80 mm, and of 0.4 kg in one of 1.3 kg."""
    vary = {"links.ground.points.O4.0": (0.28, 0.36, 0.03), "links.coupler.mass": (0.3, 1.6, 0.4)}
    best = da.optimize(da.four_bar(positions=12), vary, "peak effort.O2", starts=4)
    for value, (low, _, step) in zip(best.values, vary.values(), strict=True):
        assert (value - low) / step == pytest.approx(round((value - low) / step), abs=1e-9)
        assert low <= value


def test_progress_of_polishing_counts_the_designs_that_are_done(monkeypatch: pytest.MonkeyPatch) -> None:
    told: dict[str, list[int]] = {}

    @contextmanager
    def recorded(what: str, total: int) -> Iterator[Any]:
        told[f"{what}: {total}"] = done = list[int]()
        yield done.append

    monkeypatch.setattr(optimizing, "progress", recorded)
    da.optimize(da.four_bar(positions=6), {"links.coupler.mass": (0.3, 1.6)}, "peak effort.O2", starts=3)
    assert told["Polishing designs: 4"] == [1, 2, 3, 4]
