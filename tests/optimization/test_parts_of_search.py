"""Parts of a search by themselves: which starts are polished and counted, differences of designs, instants."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.optimization import free_timing, one_by_one, optimizers, optimizing
from dalembert.optimization.design_problem import AimValue, DesignProblem
from dalembert.optimization.one_by_one import STEP, OneByOne, analysed_names, named, value_of
from dalembert.optimization.optimizing import problem_of
from dalembert.optimization.optimum import Optimum, row_of
from dalembert.units import Units

NAN, INF = np.nan, np.inf


def test_a_design_without_all_its_slopes_has_no_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    vary = {"links.ground.points.O4.0": (0.28, 0.36), "links.rocker.points.B.0": (0.2, 0.3)}
    p, _, _ = problem_of(da.four_bar(positions=3), vary, "rms effort.O2", (), None, True)
    known = AimValue(
        np.array([3.0, 2.0, INF, NAN, -4.0]),
        np.array([[1.0, 2.0], [NAN, 1.0], [1.0, 1.0], [2.0, 2.0], [3.0, -5.0]]),
    )
    monkeypatch.setattr(DesignProblem, "aims", lambda *_, **__: known)
    found = p(np.full((5, 2), 0.5))
    size = p.scale
    assert found.value == pytest.approx([3 / size, INF, INF, INF, -4 / size])
    slopes = np.array([[1.0, 2.0], [0, 0], [0, 0], [0, 0], [3.0, -5.0]]) * [0.08, 0.1] / size
    assert found.slope == pytest.approx(slopes)


class Searched:
    """A problem whose aim is the first number, as far as a search asks it."""

    method = "scipy.slsqp"

    def __init__(self, one_by_one: bool = False) -> None:
        self.one_by_one = one_by_one

    def __call__(self, u: Any) -> Any:
        return SimpleNamespace(value=u[:, 0])


@pytest.fixture
def search(monkeypatch: pytest.MonkeyPatch) -> Any:
    """What is polished of 30 starts that are put in, and what becomes of it."""
    polished: list[float] = []

    def polish(_: Any, u: Any) -> Any:
        polished.append(float(u[0]))
        return u - 0.25

    def found(p: Any, seed: int = 7, aim: Any = lambda u: float(u[0]), lacks: Any = lambda u: 0.0) -> Any:
        starts = (np.random.default_rng(seed).permutation(30)[:, None] + 1.0) / 2
        monkeypatch.setattr(optimizing, "starts_of", lambda _, count, number: starts[:count])
        monkeypatch.setattr(optimizing, "minimize", lambda _, u, progress: (u + 100.0, u[:, 0] + 100.0))
        monkeypatch.setattr(optimizing, "polish", polish)
        monkeypatch.setattr(optimizing, "judge", lambda _, u: (lacks(u), aim(u)))
        monkeypatch.setattr(optimizing, "optimum_of", lambda *given: given[1:])
        out = optimizing._best(p, np.array([NAN]), (), 30, 3)
        return [float(out[0][0]), *out[2:]], polished

    return found


def test_the_ten_best_starts_are_polished_after_their_steps_side_by_side(search: Any) -> None:
    """Half a unit apart, from 100.5 on: of these only the best is as good as itself."""
    out, polished = search(Searched())
    assert polished == [100.5 + 0.5 * k for k in range(10)]
    assert out == [100.25, True, 1, 10, 30]


def test_of_designs_that_are_analysed_one_by_one_the_five_best_starts_are_polished(search: Any) -> None:
    out, polished = search(Searched(one_by_one=True))
    assert polished == [0.5 + 0.5 * k for k in range(5)]
    assert out == [0.25, True, 1, 5, 30]


def test_a_start_that_its_polish_made_worse_stays_and_does_not_count(search: Any) -> None:
    """Above 2 the aim falls: the best is a start itself, and none of the polished ones comes near."""
    out, _ = search(Searched(True), aim=lambda u: -float(u[0]))
    assert out == [2.5, True, 0, 5, 30]


def test_designs_within_a_thousandth_count_and_what_keeps_its_conditions_is_first(search: Any) -> None:
    out, _ = search(Searched(True), aim=lambda u: 1000.0 + 0.6 * float(u[0]))
    assert out == [0.25, True, 4, 5, 30]  # 1000.15, and up to 1001.15015
    out, _ = search(Searched(True), lacks=lambda u: 0.0 if u[0] > 1.4 else 1.0)
    assert out == [1.5, True, 0, 5, 30]
    out, _ = search(Searched(True), lacks=lambda u: 0.1 + float(u[0]))
    assert out == [0.25, False, 0, 5, 30]


def test_designs_side_by_side_that_a_search_finds_are_sorted_by_their_aims(
    search: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    p = Searched()
    p.method = "pymoo.de"
    asked = []

    def by(name: str, value: Any, starts: Any, seed: int) -> Any:
        asked.append((name, len(starts), seed, value(starts[:2]).tolist() == starts[:2, 0].tolist()))
        return np.array([[7.0], [5.0], [6.0]])

    monkeypatch.setattr(optimizing, "search_by", by)
    out, polished = search(p)
    assert asked == [("pymoo.de", 30, 3, True)]
    assert polished == [5.0, 6.0, 7.0]
    assert out == [4.75, True, 1, 3, 30]


def three(low: Any, high: Any) -> OneByOne:
    m = da.four_bar(positions=3)
    return OneByOne(
        m, ("a", "b", "c"), np.array(low), np.array(high), ("x", "y"), {}, True, None, da.statics(m)
    )


def test_differences_are_of_neighbours_from_the_bound_that_is_farther_away(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of x = a^2 b and y = c at each of three positions; a number whose bounds are one place has no slope."""
    asked: list[Any] = []

    def at(_: OneByOne, design: Any) -> Any:
        asked.append(design.tolist())
        a, b, c = design
        return np.array([[a * a * b] * 3, [c, 2 * c, 3 * c]])

    monkeypatch.setattr(OneByOne, "at", at)
    some = three([0.0, -2.0, 5.0], [4.0, 2.0, 5.0])
    (block,) = some.blocks(np.array([[1.0, 1.5, 5.0], [3.0, -1.5, 5.0]]))
    assert block.value("y")[0] == pytest.approx([5.0, 10.0, 15.0])
    assert block.value("x")[:, 1] == pytest.approx([1.5, -13.5])
    assert block.gradient("x").shape == (2, 3, 3)
    assert block.gradient("x")[0, 2] == pytest.approx([3.0, 1.0, 0.0], rel=1e-5)
    assert block.gradient("x")[1, 0] == pytest.approx([-9.0, 9.0, 0.0], rel=1e-5)
    assert not block.gradient("y").any()
    step = 4 * STEP
    assert [a[0] for a in asked if a[0] not in (1.0, 3.0)] == pytest.approx([1 + step, 3 - step], rel=1e-12)
    assert [a[1] for a in asked if a[1] not in (1.5, -1.5)] == pytest.approx(
        [1.5 - step, -1.5 + step], rel=1e-12
    )


def test_a_design_is_analysed_once_and_has_no_numbers_without_an_answer() -> None:
    m = da.four_bar(positions=3)
    path = "links.coupler.points.B.0"
    some = OneByOne(
        m,
        (path,),
        np.array([0.01]),
        np.array([0.4]),
        ("effort.O2", "angle.rocker"),
        {},
        True,
        None,
        da.statics(m),
    )
    length = float(m.links["coupler"].points["B"][0])  # type: ignore[arg-type]
    own = da.statics(m)
    found = some.at(np.array([length]))
    assert found == pytest.approx(np.array([own.effort("O2"), own.angle("rocker")]))
    assert some.at(np.array([length])) is found
    assert np.isnan(some.at(np.array([0.01]))).all()
    assert some.at(np.array([0.01])).shape == (2, 3)
    assert len(some.known) == 2


def test_only_many_designs_have_a_progress_of_their_own(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[Any] = []

    def progress(words: str, count: int) -> Any:
        told.append((words, count))
        return nullcontext(lambda done: told.append(done))

    monkeypatch.setattr(one_by_one, "progress", progress)
    monkeypatch.setattr(OneByOne, "at", lambda _, design: np.zeros((2, 3)))
    some = three([0.0, -2.0, 5.0], [4.0, 2.0, 5.0])
    for count in (1, 2):
        (_,) = some.blocks(np.ones((count, 3)))
    assert told == [("Analysing designs", 2), 1, 2]


def test_positions_are_begun_for_a_block_of_designs_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(free_timing, "BLOCK", 2)
    sizes: list[int] = []

    def timing(u: Any) -> Any:
        sizes.append(len(u))
        return 10 * u[:, :1]

    problem: Any = SimpleNamespace(_timing=timing)
    u = np.arange(10.0).reshape(5, 2)
    assert free_timing.FreeTiming.begin(problem, u).tolist() == [[a, b, 10 * a] for a, b in u.tolist()]
    assert sizes == [2, 2, 1]


def test_an_optimizer_of_nlopt_begins_within_the_bounds(monkeypatch: pytest.MonkeyPatch) -> None:
    begun: list[Any] = []

    class Solver:
        def __getattr__(self, name: str) -> Any:
            return lambda *_: None

        def optimize(self, start: Any) -> Any:
            begun.append(start.tolist())
            return start.tolist()

    nlopt = SimpleNamespace(opt=lambda which, count: Solver(), LD_MMA=1, RoundoffLimited=ValueError)
    monkeypatch.setattr(optimizers, "import_module", lambda name: nlopt)
    high = np.array([1.0, INF, 1.0])
    found = optimizers.polish_by("nlopt.mma", lambda x: (0.0, 0 * x), None, np.array([1.5, 7.0, 0.25]), high)
    assert found.tolist() == begun[0] == [1.0, 7.0, 0.25]


def test_functions_have_names_that_expressions_may_hold() -> None:
    def size(r: Any) -> float:
        return 1.0

    class Weight:
        def __call__(self, r: Any) -> float:
            return 2.0

    other, weight = (lambda r: 3.0), Weight()
    again = [lambda r: 4.0, lambda r: 5.0]
    assert named([size, other, weight, size, *again]) == {
        "size": size, "lambda": other, "Weight": weight, "size_4": size, "lambda_5": again[0], "lambda_6": again[1],
    }  # fmt: skip
    assert named([]) == {}


@pytest.mark.parametrize(
    ("gives", "values"), [(2.5, [2.5] * 3), ([1.0, 2.0, 4.0], [1.0, 2.0, 4.0]), (np.float64(7), [7.0] * 3)]
)
def test_a_function_gives_one_number_or_one_a_position(gives: Any, values: list[float]) -> None:
    r = da.statics(da.four_bar(positions=3))
    assert value_of(r, "f", {"f": lambda _: gives}).tolist() == values
    assert value_of(r, "effort.O2", {"f": lambda _: gives}) == pytest.approx(r.effort("O2"))


@pytest.mark.parametrize(
    ("gives", "said"),
    [
        ([1.0, 2.0], "f gives 2 numbers; return one, or 3, one a position"),
        ([[1.0, 2.0]] * 3, "f gives 3 x 2 numbers; return one, or 3, one a position"),
        (
            "many",
            "f gives no number: could not convert string to float: 'many'; return one number, or one a position",
        ),
    ],
)
def test_a_function_that_gives_something_else_is_refused(gives: Any, said: str) -> None:
    with pytest.raises(da.ModelError) as refused:
        value_of(da.statics(da.four_bar(positions=3)), "f", {"f": lambda _: gives})
    assert str(refused.value) == said


def test_quantities_of_members_and_bearings_are_analysed_one_by_one() -> None:
    text = (
        "stress.rod + 2*deflection.coupler - life.A/effort.O2 + effort_low.O2 + reaction.A.x + mystress.rod"
    )
    assert {("stress", "rod"), ("deflection", "coupler"), ("life", "A")} <= set(analysed_names(text))
    assert not {"effort", "reaction", "mystress"} & {word for word, _ in analysed_names(text)}


@pytest.fixture(scope="module")
def optimum() -> Optimum:
    """An optimum of motions that are compared at five instants."""
    vary = {"links.ground.points.O4.0": (0.28, 0.36)}
    o = da.optimize(
        da.four_bar(positions=3), vary, "mean effort.O2", ["effort.O2 <= 90 N*m"], starts=1, static=True
    )
    return replace(o, instants=5)


def moving(time: list[float] | None) -> Any:
    return SimpleNamespace(schedule=SimpleNamespace(time=None if time is None else np.array(time)))


def test_motions_are_compared_at_even_instants_between_which_values_go_straight(optimum: Optimum) -> None:
    r, values = moving([0.0, 0.5, 1.5, 2.0]), np.array([1.0, 3.0, NAN, 9.0])
    assert optimum.sampled(r, values) == pytest.approx([1.0, 3.0, 5.0, 7.0, 9.0])
    assert np.isnan(optimum.sampled(r, np.full(4, NAN))).tolist() == [True] * 5
    assert optimum.sampled(moving(None), values) is values
    assert replace(optimum, instants=0).sampled(r, values) is values


def test_the_place_of_an_instant_is_the_nearest_computed_one(optimum: Optimum) -> None:
    r = moving([0.0, 0.45, 1.6, 2.0])
    assert [optimum.place(r, k) for k in range(5)] == [1, 2, 2, 3, 4]
    assert [optimum.place(moving(None), k) for k in range(3)] == [1, 2, 3]
    assert [replace(optimum, instants=0).place(r, k) for k in range(3)] == [1, 2, 3]


def test_an_optimum_is_read_before_and_after_with_its_margins(optimum: Optimum) -> None:
    o = replace(optimum, instants=0)
    before, after = (r.effort("O2") for r in (o.before, o.after))
    assert (o.value_before, o.value) == pytest.approx((before.mean(), after.mean()))
    (aim, margin) = o.aim_rows("SI")
    assert aim == ["mean effort.O2 [N*m]", f"{before.mean():.6g}", f"{after.mean():.6g}"]
    assert margin[0] == "margin of effort.O2 <= 90 N*m [N*m]"
    assert [float(x) for x in margin[1:]] == pytest.approx([90 - before.max(), 90 - after.max()], rel=1e-4)
    (row,) = o.number_rows("SI")
    assert row[0] == "links.ground.points.O4.0 [m]"
    assert [float(x) for x in row[1:]] == pytest.approx([o.nominal[0], o.values[0], 0.28, 0.36], rel=1e-4)


def test_a_row_has_the_unit_behind_its_name_where_there_is_one() -> None:
    from dalembert.analysis.output.summary.printed_units import scale_for

    to = scale_for(Units(), {})
    assert row_of(to, "a", "length", 0.25, 3.0) == ["a [m]", "0.25", "3"]
    assert row_of(to, "b", "number", 0.25) == ["b", "0.25"]


@pytest.mark.parametrize(
    ("feasible", "said"),
    [
        (True, "4 of the 10 best of 31 starts converged to this design."),
        (False, "No design meets every condition; this one violates them least."),
    ],
)
def test_how_sure_an_optimum_is_is_said(feasible: bool, said: str, optimum: Optimum) -> None:
    assert replace(optimum, feasible=feasible, found=4, polished=10, started=31).words == said
