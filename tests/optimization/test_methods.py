"""Optimizers, starts, steps and judgement on problems whose best places are known in closed form."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.optimization import optimizers, optimizing, pareto_front, polishing
from dalembert.optimization.aims import Aim, parse_aim, parse_condition
from dalembert.optimization.design_problem import AimValue, DesignProblem, Margins
from dalembert.optimization.optimizers import METHODS, find_method, polish_by, search_by
from dalembert.optimization.polishing import _Design, polish
from dalembert.optimization.side_by_side import minimize


@pytest.mark.parametrize(
    ("name", "does", "found"),
    [
        *((name, (what,), name) for name, (what, _) in METHODS.items()),
        ("scipy", ("polish", "search"), "scipy.slsqp"),
        ("nlopt", ("polish", "search"), "nlopt.slsqp"),
        ("nlopt", ("search",), "nlopt.crs"),
        ("pymoo", ("polish", "search"), "pymoo.de"),
        ("pymoo", ("front",), "pymoo.nsga2"),
        ("slsqp", ("polish",), None),
        ("pymoo.nsga2", ("polish", "search"), None),
        ("nlopt.mma", ("front",), None),
        (None, ("polish", "search", "front"), None),
    ],
)
def test_an_optimizer_by_its_name(
    name: str, does: Any, found: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(optimizers, "find_spec", lambda package: package in ("scipy", "nlopt", "pymoo"))
    if found is not None:
        assert find_method(name, *does) == found
        return
    with pytest.raises(da.ModelError, match=f"unknown method {name!r}".replace(".", r"\.")):
        find_method(name, *does)


def quadratic(x: Any) -> tuple[float, Any]:
    """Least at (0.9, 1.5), without bounds."""
    off = np.asarray(x) - [0.9, 1.5]
    return float(off @ off), 2 * off


RULES = (lambda x: np.array([1 - x.sum()]), lambda x: -np.ones((1, 2)))
POLISHING = [name for name, (does, _) in METHODS.items() if does == "polish"]


@pytest.mark.parametrize("name", [*POLISHING, "pymoo.de"])
def test_a_polish_ends_at_the_known_best_place(name: str) -> None:
    """The sum stays below 1; then the second number below 0.7 too; without a rule, at the ends of the box. What does
    not polish leaves it to the default."""
    if METHODS[name][0] == "polish":
        pytest.importorskip(name.partition(".")[0])
    start, wide = np.array([0.1, 0.1]), np.array([1.0, np.inf])
    for rules, high, best in (
        (RULES, wide, (0.2, 0.8)),
        (RULES, np.array([1.0, 0.7]), (0.3, 0.7)),
        (None, wide, (0.9, 1.5)),
        (None, np.ones(2), (0.9, 1.0)),
    ):
        found = polish_by(name, quadratic, rules, start, high)  # type: ignore[arg-type]
        assert found == pytest.approx(best, abs=2e-4)


@pytest.mark.parametrize("name", [name for name, (does, _) in METHODS.items() if does == "search"])
def test_a_search_ends_near_the_known_best_place(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where it has no value, it is no place."""
    pytest.importorskip(name.partition(".")[0])
    monkeypatch.setattr(optimizers, "GENERATIONS", 40)
    asked: list[int] = []

    def value(u: Any) -> Any:
        asked.append(len(u))
        return np.where(u[:, 0] > 0.5, np.nan, ((u - [0.8, 0.3]) ** 2).sum(axis=1))

    found = search_by(name, value, np.array([[0.1, 0.9], [0.2, 0.2]]), 3)
    best = found[np.nanargmin(np.where(found[:, 0] > 0.5, np.nan, ((found - [0.5, 0.3]) ** 2).sum(axis=1)))]
    assert best == pytest.approx([0.5, 0.3], abs=0.03)
    assert sum(asked) <= optimizers.EVALUATIONS + 1000


class Nlopt:
    """Stands for nlopt where it is not installed: asks as it does, with slopes or without, and answers by scipy's."""

    RoundoffLimited, LD_MMA, LN_COBYLA, GN_CRS2_LM = ValueError, True, False, False

    def __init__(self) -> None:
        self.met: dict[str, Any] = {}

    def opt(self, slopes: bool, count: int) -> Any:
        self.slopes, self.rules = slopes, list[Any]()
        keep = lambda name: lambda *values: self.met.update({name: values})  # noqa: E731
        names = ("set_lower_bounds", "set_upper_bounds", "set_maxeval", "set_ftol_rel", "set_min_objective")
        add = lambda rule, off: self.rules.append((rule, off))  # noqa: E731
        return SimpleNamespace(
            **{n: keep(n) for n in names}, add_inequality_mconstraint=add, optimize=self.optimize
        )

    def srand(self, seed: int) -> None:
        self.met["seed"] = seed

    def value(self, x: Any) -> tuple[float, Any]:
        slope = np.full(len(x) if self.slopes else 0, np.nan)
        return self.met["set_min_objective"][0](x, slope), slope

    def optimize(self, start: Any) -> Any:
        from scipy.optimize import minimize as best

        def lacks(x: Any) -> tuple[Any, Any]:
            out = np.full(1, np.nan)
            slope = np.full((1, len(x)) if self.slopes else 0, np.nan)
            self.rules[0][0](out, x, slope)
            return -out, -slope

        jac = {"jac": lambda x: self.value(x)[1]} if self.slopes else {}
        rule = {"type": "ineq", "fun": lambda x: lacks(x)[0]}
        rule |= {"jac": lambda x: lacks(x)[1]} if self.slopes else {}
        ends = list(zip(self.met["set_lower_bounds"][0], self.met["set_upper_bounds"][0], strict=True))
        if self.met.get("fails"):
            self.value(np.array([0.25, 0.75]))
            raise self.met["fails"]
        solver: Any = best
        return solver(
            lambda x: self.value(x)[0],
            start,
            method="SLSQP",
            bounds=ends,
            constraints=[rule] if self.rules else [],
            tol=1e-12,
            **jac,
        ).x


def test_what_nlopt_is_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    nlopt = Nlopt()
    monkeypatch.setattr(optimizers, "import_module", lambda name: nlopt)
    start, high = np.array([0.1, 2.5]), np.array([1.0, 2.0])
    for name in ("nlopt.mma", "nlopt.cobyla"):
        assert polish_by(name, quadratic, RULES, start, high) == pytest.approx([0.2, 0.8], abs=1e-5)  # type: ignore[arg-type]
        assert polish_by(name, quadratic, None, start, high) == pytest.approx([0.9, 1.5], abs=1e-5)  # type: ignore[arg-type]
    assert nlopt.met["set_maxeval"] == (10 * optimizers.STEPS,)
    for error in (RuntimeError(), ValueError()):
        nlopt.met["fails"] = error
        assert polish_by("nlopt.mma", quadratic, None, start, high).tolist() == [0.25, 0.75]  # type: ignore[arg-type]
    nlopt.met["fails"] = None
    value = lambda u: ((u - [0.8, 0.3]) ** 2).sum(axis=1)  # noqa: E731
    found = search_by("nlopt.crs", value, np.array([[0.1, 0.9], [0.7, 0.2]]), 3)
    assert found == pytest.approx(np.array([[0.8, 0.3]]), abs=1e-5)
    assert nlopt.met["set_upper_bounds"][0].tolist() == [1.0, 1.0]
    assert (nlopt.met["seed"], nlopt.met["set_maxeval"]) == (3, (optimizers.EVALUATIONS,))


def test_what_pymoo_is_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its populations begin with the starts; of one aim the last population is taken, of two the front."""
    met: dict[str, Any] = {}

    def run(problem: Any, method: Any, end: Any, seed: int) -> Any:
        out: dict[str, Any] = {}
        problem._evaluate(np.full((2, 2), 0.5), out)
        met.update(out=out, end=end, seed=seed, **vars(problem), **method)
        return SimpleNamespace(pop={"X": [[0.1, 0.2], [0.3, 0.4]]}, opt={"X": [0.5, 0.6]})

    class Problem:
        def __init__(self, **numbers: Any) -> None:
            vars(self).update(numbers)

    made = dict.fromkeys(("DE", "NSGA2"), lambda **how: how)
    package = SimpleNamespace(Problem=Problem, minimize=run, **made)
    monkeypatch.setattr(optimizers, "import_module", lambda name: met.setdefault(name, package))
    starts = np.array([[0.1, 0.9], [0.7, 0.2]])
    value = lambda u: np.array([3.0, np.nan])  # noqa: E731
    assert search_by("pymoo.de", value, starts, 4).tolist() == [[0.1, 0.2], [0.3, 0.4]]
    assert met["out"]["F"].tolist() == [[3.0], [optimizers.OPEN]]
    known = {"n_var": 2, "n_obj": 1, "n_ieq_constr": 0, "xl": 0.0, "xu": 1.0, "seed": 4}
    assert {name: met[name] for name in known} == known
    assert (met["end"], met["pop_size"]) == (("n_gen", optimizers.GENERATIONS), optimizers.POPULATION)
    assert met["sampling"].shape == (optimizers.POPULATION, 2)
    np.testing.assert_array_equal(met["sampling"][:2], starts)
    np.testing.assert_array_equal(met["sampling"][2:4], np.random.default_rng(4).random((2, 2)))
    front = optimizers.evolve("pymoo.nsga2", lambda u: {"F": u}, 2, 1, starts, 4)
    assert (front.tolist(), met["n_obj"], met["n_ieq_constr"]) == ([[0.5, 0.6]], 2, 1)
    places = ("algorithms.soo.nonconvex.de", "algorithms.moo.nsga2", "core.problem", "optimize")
    assert {f"pymoo.{place}" for place in places} <= set(met)


def bowl(u: Any) -> AimValue:
    """A narrow valley askew, least at (0.3, 0.8); the last number is at its bound 1."""
    off = u - [0.3, 0.8, 1.4]
    along, across = off[:, 0] + off[:, 1], off[:, 0] - off[:, 1]
    slope = np.stack([2 * along + 120 * across, 2 * along - 120 * across, 2 * off[:, 2]], axis=1)
    return AimValue(along**2 + 60 * across**2 + off[:, 2] ** 2, slope)


@pytest.mark.parametrize("mirrored", [False, True])
def test_starts_side_by_side_end_at_the_known_best_place(mirrored: bool) -> None:
    """Whether the numbers have to rise or to fall; the first step is a tenth of the box in the steepest number."""

    def of(u: Any) -> AimValue:
        asked.append(u)
        answer = bowl(1 - u if mirrored else u)
        return AimValue(answer.value, -answer.slope if mirrored else answer.slope)

    asked = list[Any]()
    starts, steps = np.random.default_rng(4).random((9, 3)), list[int]()
    starts = 1 - starts if mirrored else starts
    places, values = minimize(of, starts, progress=steps.append)
    np.testing.assert_allclose(asked[0], starts)
    longest = np.abs(asked[1] - starts).max(axis=1)
    assert longest.max() == pytest.approx(0.1)
    assert (longest > 0.05).all()
    best = [0.7, 0.2, 0.0] if mirrored else [0.3, 0.8, 1.0]
    np.testing.assert_allclose(places, np.tile(best, (9, 1)), atol=1e-5)
    np.testing.assert_allclose(values, 0.16, rtol=1e-9)
    assert steps == list(range(1, len(steps) + 1))
    assert len(steps) < 60
    places, values = minimize(of, starts, steps=2)
    np.testing.assert_allclose(values, of(places).value)
    assert (values < of(starts).value).all()


@pytest.mark.parametrize(("answers", "count"), [(0.3, 6), (1.1, 6), (0.3, 200)])
def test_starts_are_those_that_have_an_answer(answers: float, count: int) -> None:
    """The description's own first, if it has one, then the first of a fixed draw."""
    own, has = np.array([0.5, 0.5]), lambda u: (u[:, 0] < answers) & (u[:, 1] < answers)
    found = optimizing.random_places(has, own, count, 11)
    draw = np.random.default_rng(11).random((40 * max(count, 64), 2))
    kept = draw[(draw < answers).all(axis=1)][:count]
    np.testing.assert_array_equal(found, np.concatenate([own[None][has(own[None])], kept]))
    with pytest.raises(da.ModelError, match="none of 6,016 random designs within the bounds can be solved"):
        optimizing.random_places(lambda u: np.zeros(len(u), bool), own, 60, 11)


class Known:
    """A problem in closed form: stepped numbers, an aim least at a place, one condition on the first number."""

    method, aim, conditions = "scipy.slsqp", Aim("mean", "x"), ()

    def __init__(self, best: Any, span: Any, least: float = -np.inf) -> None:
        self.best, self.span, self.least, self.sizes = np.array(best), np.array(span), least, np.array([2.0])

    def __call__(self, u: Any) -> Any:
        return SimpleNamespace(value=((u - self.best) ** 2).sum(axis=1))

    def at(self, u: Any) -> Margins:
        none = np.zeros((1, 0))
        return Margins(none, none, np.array([[u[0] - self.least]]), none)

    def sharp(self, u: Any) -> tuple[float, Any]:
        return float(((u - self.best) ** 2).sum()), 2 * (u - self.best)


def test_a_condition_is_kept_but_for_rounding() -> None:
    """By its usual size, 2: within a millionth of it, from either side."""
    p: Any = Known([0.0], [1.0], 0.5)
    for u, lacks in ((0.6, 0.0), (0.5, 0.0), (0.5 - 1.9e-6, 0.0), (0.5 - 2.1e-6, 1.05e-6), (0.3, 0.1)):
        assert optimizing.judge(p, np.array([u])) == pytest.approx((lacks, u * u))
    p.at = lambda u: Margins(u, u, np.array([[np.nan]]), u)
    assert optimizing.judge(p, np.array([0.1]))[0] == np.inf


@pytest.mark.parametrize(
    ("best", "steps", "span", "kept"),
    [
        ([0.37, 0.52], [0.1, 0.2], [1.0, 1.0], [0.4, 0.6]),
        ([0.37, 0.52], [0.2, 0.4], [2.0, 1.0], [0.4, 0.4]),  # the step as a part of the span
        ([0.97, 0.02], [0.3, 0.3], [1.0, 1.0], [0.9, 0.0]),  # no step beyond the box
        ([0.61, 0.4], [5.0, 0.25], [0.0, 1.0], [1.0, 0.5]),  # without a span, and to the nearer one
        ([0.61, 0.9], [0.25, 3.0], [1.0, 1.0], [0.5, 0.0]),  # a step longer than the span
        ([0.22] * 11, [0.1] * 11, [1.0] * 11, [0.2] * 11),  # too many to look at all neighbours
    ],
)
def test_whole_steps(best: list[float], steps: list[float], span: list[float], kept: list[float]) -> None:
    p: Any = Known(best, span)
    found = optimizing._stepped(p, np.array(best), np.array(steps))
    np.testing.assert_allclose(found[np.array(span) > 0], np.array(kept)[np.array(span) > 0], atol=1e-12)
    free = np.full(len(best), np.nan)
    np.testing.assert_array_equal(optimizing._stepped(p, np.array(best), free), best)


def test_of_steps_the_neighbour_that_keeps_the_condition() -> None:
    """The nearest step breaks it; the other is taken."""
    p: Any = Known([0.42], [1.0], 0.45)
    assert optimizing._stepped(p, np.array([0.42]), np.array([0.1])) == pytest.approx([0.5])


@pytest.mark.parametrize(("count", "kept"), [(10, 0.5), (11, 0.4)])
def test_of_up_to_ten_steps_every_neighbour_is_looked_at(count: int, kept: float) -> None:
    """Then, as above, one is found that keeps the condition; of more numbers only the nearest steps are."""
    best = [0.42, *[0.25] * (count - 1)]
    p: Any = Known(best, [1.0] * count, 0.45)
    found = optimizing._stepped(p, np.array(best), np.array([0.1, *[0.25] * (count - 1)]))
    assert found == pytest.approx([kept, *best[1:]])


BOX = {"links.ground.points.O4.0": (0.28, 0.36), "links.rocker.points.B.0": (0.2, 0.29)}


def problem(aim: str, rules: tuple[str, ...] = ("transmission.B >= 60 deg",)) -> DesignProblem:
    m, (low, high) = da.four_bar(positions=7), np.array(list(BOX.values())).T
    conditions = tuple(map(parse_condition, rules))
    return DesignProblem(m, tuple(BOX), low, high, parse_aim(aim), conditions, m.schedule().position)


@pytest.mark.parametrize("aim", ["peak effort.O2", "rms effort.O2"])
@pytest.mark.parametrize("free", [(True, True), (False, True)])
def test_what_a_polish_is_told_of_a_design(aim: str, free: tuple[bool, bool]) -> None:
    """Room and its slopes: margins by their sizes, of a peak its distance from both signs; others stand still."""
    p, u, who = problem(aim), np.array([0.31, 0.62]), np.array(free)
    d, peak = _Design(p, u, who), aim.startswith("peak")
    x = np.append(u[who], 1.7) if peak else u[who]
    rows = p.at(u)
    known = [(rows.margin / p.sizes[:, None]).ravel()]
    known += [1.7 - rows.aim / p.scale, 1.7 + rows.aim / p.scale] if peak else []
    np.testing.assert_allclose(d.room(x), np.concatenate(known))
    value, slope = d.aim(x)
    assert value == pytest.approx(1.7 if peak else np.sqrt((rows.aim**2).mean()) / p.scale)
    for k, h in enumerate(np.eye(len(x)) * 1e-6):
        np.testing.assert_allclose(
            d.room_slope(x)[:, k], (d.room(x + h) - d.room(x - h)) / 2e-6, rtol=1e-4, atol=1e-6
        )
        assert slope[k] == pytest.approx((d.aim(x + h)[0] - d.aim(x - h)[0]) / 2e-6, rel=1e-4, abs=1e-7)
    assert (d.room(x * np.nan if not peak else np.append(u[who] * np.nan, 1.7)) == -optimizers.OPEN).all()
    np.testing.assert_array_equal(polish(p, u, np.zeros(2, bool)), u)
    still = polish(p, u, who)[~who]
    np.testing.assert_array_equal(still, u[~who])


def test_an_evolved_fronts_designs_are_those_of_the_analyses(monkeypatch: pytest.MonkeyPatch) -> None:
    """What its method is asked with is the analyses'; its designs, some of them evenly, and none that breaks a rule."""
    monkeypatch.setattr(optimizers, "find_spec", lambda package: True)
    grid, met = np.random.default_rng(2).random((9, 2)), dict[str, Any]()

    def evolve(name: str, of: Any, aims: int, rules: int, starts: Any, seed: int) -> Any:
        met.update(of(grid), method=name, counts=(aims, rules, len(starts), seed))
        return grid

    monkeypatch.setattr(pareto_front, "evolve", evolve)
    low, high = np.array(list(BOX.values())).T
    numbers = [dict(zip(BOX, (low + u * (high - low)).tolist(), strict=True)) for u in grid]
    runs = [da.solve(da.four_bar().with_values(each), positions=7) for each in numbers]
    values = np.array([[np.sqrt((r["effort.O2"] ** 2).mean()), r["power.O2"].mean()] for r in runs])
    least = np.sort([np.degrees(r["transmission.B"].min()) for r in runs])
    bound = round(float(least[2:4].mean()), 6)  # some designs keep it
    lacks = [np.maximum(0, np.radians(bound) - r["transmission.B"]) for r in runs]
    aims, how = ["rms effort.O2", "mean power.O2"], {"starts": 3, "seed": 5, "positions": 7}
    rule = f"transmission.B >= {bound} deg"
    front = da.pareto(da.four_bar(), BOX, aims, rule, points=4, method="pymoo", **how)
    assert (met["method"], met["counts"]) == ("pymoo.nsga2", (2, 1, 4, 5))
    np.testing.assert_allclose(met["F"], values, rtol=1e-9)
    np.testing.assert_allclose(met["G"][:, 0], [(x**2).mean() for x in lacks], atol=1e-12)
    order = np.argsort(values[:, 0])[[0, 3, 5, 8]]
    kept = [k for k in order if lacks[k].max() <= 1e-6]
    assert 0 < len(kept) < len(order)
    undominated = [kept[k] for k in pareto_front._undominated(values[kept])]
    np.testing.assert_allclose(front.values, values[undominated], rtol=1e-9)
    heads = str(front)
    assert all(name in heads for name in (*aims, *BOX))
    with pytest.raises(da.ModelError, match=r"pymoo\.nsga2 takes no steps; give \(low, high\)"):
        da.pareto(da.four_bar(), {next(iter(BOX)): (0.28, 0.36, 0.01)}, aims, method="pymoo")


@pytest.mark.parametrize("curvature", [40.0, 0.05])
def test_of_a_round_bowl_the_second_step_is_the_last(curvature: float) -> None:
    """The first change of the slope gives the curvature of all directions, not only of its own."""
    best, seen = np.array([0.3, 0.6, 0.45]), list[Any]()

    def round_bowl(u: Any) -> AimValue:
        off = (u - best) * [1.0, 1.001, 0.999]  # so that no single step ends there
        seen.append(np.abs(u - best).max())
        return AimValue(curvature * (off**2).sum(axis=1) / 2, curvature * off * [1.0, 1.001, 0.999])

    places, _ = minimize(round_bowl, np.array([[0.31, 0.5, 0.5]]))
    np.testing.assert_allclose(places[0], best, atol=1e-6)
    assert sum(off > 2e-3 for off in seen) <= 4


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_polish_of_a_peak_starts_where_both_its_signs_have_room(
    sign: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    p, met = problem("peak effort.O2"), list[Any]()
    at = p.at

    def turned(_: Any, u: Any) -> Margins:
        """All of one sign."""
        rows = at(u)
        return rows._replace(aim=sign * np.abs(rows.aim))

    monkeypatch.setattr(DesignProblem, "at", turned)
    monkeypatch.setattr(polishing, "polish_by", lambda *told: met.append(told) or told[3])
    u = np.array([0.31, 0.62])
    np.testing.assert_array_equal(polish(p, u), u)
    ((_, aim, (room, _), start, high),) = met
    assert start[-1] == pytest.approx(float(np.abs(at(u).aim).max()) / p.scale)
    assert high.tolist() == [1.0, 1.0, np.inf]
    assert room(start).min() > -1e-9 or room(start).argmin() < len(p.conditions)
    assert aim(start)[0] == start[-1]


def test_a_front_of_which_no_design_keeps_its_conditions_is_refused() -> None:
    with pytest.raises(da.ModelError, match="no design meets every condition") as refused:
        da.pareto(
            da.four_bar(),
            BOX,
            ["rms effort.O2", "peak effort.O2"],
            "transmission.B >= 89.5 deg",
            positions=7,
            points=3,
            starts=3,
        )
    assert refused.value.remedy == "widen the bounds, or leave a condition out"
