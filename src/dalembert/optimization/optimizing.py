"""``da.optimize``: the optimal design for an aim, within bounds and conditions.

Mechanics: docs/theory.md 11.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np

from dalembert.analysis.batch.tracing.course import in_mode_of
from dalembert.analysis.batch.tracing.symbolic_model import VariedNumber, number_kinds, numbers
from dalembert.arrays import Array, Flags
from dalembert.bounds import require
from dalembert.errors import ModelError, errors_at
from dalembert.machine.motion.coded.shared_motion import SharedMotion
from dalembert.machine.motion.many.simulation_plan import read_motion
from dalembert.machine.whole_cycle import over_a_turn
from dalembert.model import AtPositions, Mechanism, ModelOrPath, as_mechanism
from dalembert.optimization.aims import Aim, Constraint, parse_aim, parse_condition
from dalembert.optimization.design_problem import DesignProblem
from dalembert.optimization.one_by_one import Function, named
from dalembert.optimization.optimizers import DEFAULT, METHODS, find_method, search_by
from dalembert.optimization.optimum import Optimum
from dalembert.optimization.polishing import polish
from dalembert.optimization.side_by_side import STEPS, minimize
from dalembert.progress import progress
from dalembert.wording import quote_value

POLISHED, POLISHED_ANALYSED = 10, 5
"""Number of the best starts that are polished, and where designs are analysed one by one."""
MOST_DRAWN = 100
"""Random designs for each start, where few of them can be solved."""
KEPT = 1e-6
"""Violation of a condition, over its usual size, that counts as rounding error."""
SAME = 1e-3
"""Fraction of the aim within which two designs count as equally good."""
CORNERS = 10
"""Largest number of stepped numbers whose neighbours are all examined together; with more, the nearest steps alone."""

STARTS, STARTS_ANALYSED = 1000, 20
"""Random designs by default, of compiled analyses and where designs are analysed one by one."""

BLOCK = 64
"""Random designs that are solved side by side, at least."""

Bounds = Mapping[str, Sequence[object]]
Rule = str | Function


def optimize(
    mechanism: ModelOrPath,
    vary: Bounds,
    least: str | Function,
    where: Rule | Sequence[Rule] = (),
    starts: int | None = None,
    seed: int = 0,
    positions: AtPositions = None,
    static: bool = False,
    method: str = DEFAULT,
    simulate: Mapping[str, object] | None = None,
) -> Optimum:
    """Optimal design of a mechanism: numbers within bounds, an aim to minimize, conditions at every position.

    vary: path -> (low, high), or (low, high, step) for values in steps from low; texts are read as in the file
    ("13 in"), plain numbers are SI, "range" is that of a parameter; for a vector the bounds apply to each component.
    least: ``peak``, ``mean``, ``rms`` or ``norm8`` of an output or an expression of outputs (`da.compile`), or an
    expression of such numbers,
    ``peak(effort.O2) + 0.1 m*range(reaction.A.x)``. where: conditions such as ``transmission.B >= 33 deg``,
    ``peak effort.O2 <= 2 N*m`` or ``range(slide.G) >= 60 mm``. starts: random designs within the bounds, besides the
    mechanism's (default 1000), all improved side by side with exact gradients; the best ten are polished one by one.
    method: another local or global optimizer (``METHODS``), such as ``nlopt.slsqp`` or ``pymoo.de``, if installed.

    An aim may be a Python function of a result that returns a number; a condition one whose numbers, one or one a
    position, must not be negative. With these, and with quantities that are not compiled (``deflection.rod``),
    designs are analysed one by one with gradients by differences: by default 20 starts, the best five polished.
    ``simulate``: motions under forces, ``{"until": ["2 s", "O.speed = 0 rad/s"], "start": ...}`` as in `da.study`; aims
    and conditions are of quantities along each design's motion, ``final time``, ``peak drive.O.speed``.
    Raises ModelError for unknown names, empty bounds, and where no design within the bounds can be solved.

    >>> import dalembert as da
    >>> best = da.optimize(
    ...     da.four_bar(), vary={"links.ground.points.O4.0": (0.28, 0.36)}, least="peak effort.O2", starts=8
    ... )
    >>> best.value < best.value_before, best.feasible
    (True, True)
    """
    mechanism = as_mechanism(mechanism)
    name = find_method(method, "polish", "search")
    p, steps, varied = problem_of(mechanism, vary, least, where, positions, static, simulate)
    p = replace(p, method=name)
    usual = STARTS_ANALYSED if p.one_by_one else STARTS
    return _best(p, steps, varied, usual if starts is None else starts, seed)


def aim_of(least: str | Function, functions: Mapping[str, Function]) -> Aim:
    """An aim from its text, or from a function that has a name."""
    if isinstance(least, str):
        return parse_aim(least)
    return Aim("", next(name for name, f in functions.items() if f is least))


def problem_of(
    m: Mechanism,
    vary: Bounds,
    least: str | Function,
    where: Rule | Sequence[Rule],
    positions: AtPositions,
    static: bool,
    simulate: Mapping[str, object] | None = None,
) -> tuple[DesignProblem, Array, tuple[VariedNumber, ...]]:
    """The problem, the steps of its numbers (NaN for none), and the numbers."""
    m, motion = (m, None) if simulate is None else read_motion(m, simulate)
    varied, low, high, steps = bounds_of(m, vary)
    rules: list[Any] = [where] if isinstance(where, str) or callable(where) else list(where)
    functions = named([f for f in dict.fromkeys((least, *rules)) if callable(f)])
    for key, value in (("positions", positions), ("static", static)):
        if motion is not None and value:
            raise ModelError(f"{key} is given, and forces move the designs", f"leave {key} out", (key,))
    with errors_at("positions"):
        at = positions if motion else over_a_turn(m, positions)
        place = np.zeros((motion.count, len(m.drives))) if motion else m.schedule(at).position
    with errors_at("least"):
        aim = aim_of(least, functions)
    conditions = list[Constraint]()
    for k, rule in enumerate(rules):
        with errors_at("where", k):
            conditions.append(_condition(rule, functions))
    problem = DesignProblem(
        m, tuple(vary), low, high, aim, tuple(conditions), place, static, DEFAULT, at, functions, motion
    )
    problem.check()
    return problem, steps, varied


def _condition(rule: Rule, functions: Mapping[str, Function]) -> Constraint:
    """A condition from its text, or a function that must not be negative."""
    if isinstance(rule, str):
        return parse_condition(rule)
    name = aim_of(rule, functions).of
    return Constraint(f"{name} >= 0", name)


def bounds_of(m: Mechanism, vary: Bounds) -> tuple[tuple[VariedNumber, ...], Array, Array, Array]:
    """The varied numbers, their low and high ends, and their steps (NaN for none)."""
    if not vary:
        raise ModelError("no number varies", 'give vary={"links.crank.points.A.0": (0.1, 0.15)}')
    varied, ends = list[VariedNumber](), list[tuple[Array, Array, Array]]()
    for path, ends_of in vary.items():
        try:
            known, varied = len(varied), list(numbers(m, list(vary)[: len(ends) + 1]))
            ends.append(_ends(m, path, ends_of, len(varied) - known))
        except ModelError as error:  # with the line of the request, not the model file's
            raise ModelError(error.what, error.remedy, ("vary", path)) from None
    low, high, steps = (np.concatenate(of) for of in zip(*ends, strict=True))
    return tuple(varied), low, high, steps


def _stated(m: Mechanism, path: str) -> tuple[float, float]:
    """Range that the file states with a parameter."""
    parameter = m.parameters.get(path)
    if parameter is None or parameter.range is None:
        what = f"{path!r} states no range"
        raise ModelError(what, f"write {path}: [low, high], or give the parameter a range: [low, high]")
    low, high = parameter.range
    return low, high


def _ends(m: Mechanism, path: str, bounds: Sequence[object], count: int) -> tuple[Array, Array, Array]:
    """Low, high and step (count,) of the numbers at a path; a parameter has its ``range``."""
    if bounds == "range":
        bounds = _stated(m, path)
    if not isinstance(bounds, Sequence) or isinstance(bounds, str) or len(bounds) not in (2, 3):
        raise ModelError(
            f"the bounds of {path!r} are {quote_value(bounds)}", "give (low, high) or (low, high, step)"
        )

    def read(value: object) -> Array:
        if isinstance(value, str):
            return np.array([n.value for n in numbers(m.with_values({path: value}), [path])])
        return np.broadcast_to(np.asarray(value, float), (count,))

    low, high = read(bounds[0]), read(bounds[1])
    step = np.full(count, np.nan) if len(bounds) == 2 else read(bounds[2])
    if not np.isfinite([low, high]).all() or (low > high).any() or (step <= 0).any():
        raise ModelError(
            f"the bounds of {path!r} go from {quote_value(bounds[0])} to {quote_value(bounds[1])}",
            "use (low, high, step) with low <= high and step > 0",
        )
    return low, high, step


def _best(
    p: DesignProblem, steps: Array, varied: tuple[VariedNumber, ...], starts: int, seed: int
) -> Optimum:
    places = started = starts_of(p, starts, seed)
    if METHODS[p.method][0] == "search":
        places = search_by(p.method, lambda u: p(u).value, places, seed)
        values = p(places).value
    elif p.one_by_one:
        values = p(places).value
    else:
        with progress("Improving designs, steps at most", STEPS) as step:
            places, values = minimize(p, places, progress=lambda done: step(done))
    order = np.argsort(values)[: POLISHED_ANALYSED if p.one_by_one else POLISHED]
    with progress("Polishing designs", len(order)) as step:
        ends = []
        for k, start in enumerate(places[order]):
            ends.append(_stepped(p, polish(p, start), steps))
            step(k + 1)
    ends += [_stepped(p, u, steps) for u in places[order]]
    judged = [judge(p, u) for u in ends]
    best = min(range(len(ends)), key=lambda k: judged[k])
    alike = [j for j in judged[: len(order)] if is_alike(j, judged[best])]
    return optimum_of(p, ends[best], varied, judged[best][0] <= 0, len(alike), len(order), len(started))


def is_alike(one: tuple[float, float], best: tuple[float, float]) -> bool:
    """True if a design keeps every condition and is as good as the best one, whatever the sign of the aim; both by
    `judge`."""
    return one[0] <= 0 and one[1] <= best[1] + SAME * abs(best[1])


def starts_of(p: DesignProblem, count: int, seed: int) -> Array:
    """Solvable points: the description's, then random ones."""
    block = 1 if p.one_by_one else BLOCK
    return random_places(lambda u: np.isfinite(p(u).value), p.nominal, count, seed, block)


def random_places(
    answers: Callable[[Array], Flags], nominal: Array, count: int, seed: int, block: int = BLOCK
) -> Array:
    """Solvable points (start, number) in the unit box: a given one, then random ones, ``block`` or more at once."""
    require("starts", count, path=("starts",))
    require("seed", seed, path=("seed",))
    draw, got, drawn = np.random.default_rng(seed), 0, 0
    accepted = [nominal[None][answers(nominal[None])]]
    while got < count and drawn < MOST_DRAWN * count:
        u = draw.random((max(count - got, block), len(nominal)))
        drawn += len(u)
        u = u[answers(u)][: count - got]
        got += len(u)
        accepted.append(u)
    places = np.concatenate(accepted)
    if not len(places):
        raise ModelError(
            f"none of {drawn:,} random designs within the bounds can be solved at every position",
            "narrow the bounds, or the range of the drive",
            ("vary",),
        )
    return places


def judge(p: DesignProblem, u: Array) -> tuple[float, float]:
    """Largest violation of a condition, zero if all hold, and the aim; the smaller the pair, the better."""
    r = p.at(u)
    lacks = float(-(r.margin / p.sizes[:, None]).min(initial=0.0)) if np.isfinite(r.margin).all() else np.inf
    return (lacks if lacks > KEPT else 0.0), p.sharp(u)[0]


def _stepped(p: DesignProblem, u: Array, steps: Array) -> Array:
    """The point with stepped numbers on their steps, its other numbers polished again."""
    free = np.isnan(steps)
    if free.all():
        return u
    span = np.where(p.span > 0, p.span, 1.0)
    pitch = np.where(free, 1.0, np.minimum(steps / span, np.where(p.span > 0, np.inf, 1.0)))
    count = np.floor(1 / pitch[~free] + 1e-9)
    down = np.clip(np.floor(u[~free] / pitch[~free]), 0, count)
    up = np.minimum(down + 1, count)
    near = np.clip(np.rint(u[~free] / pitch[~free]), 0, count)
    choices = product(*zip(down, up, strict=True)) if len(near) <= CORNERS else [near]
    places = np.array([_on(u, ~free, np.array(c) * pitch[~free]) for c in choices])
    order = np.argsort(p(places).value)[:3]
    ends = [polish(p, places[k], free) for k in order]
    return min(ends, key=lambda end: judge(p, end))


def _on(u: Array, which: Flags, values: Array) -> Array:
    out = u.copy()
    out[which] = np.minimum(values, 1.0)
    return out


def optimum_of(
    p: DesignProblem,
    u: Array,
    varied: tuple[VariedNumber, ...],
    feasible: bool,
    alike: int,
    polished: int,
    started: int,
) -> Optimum:
    m, values = p.mechanism, p.numbers(u)
    best = m.with_values({n.path: float(v) for n, v in zip(varied, values, strict=True)})
    if p.motion:
        best = SharedMotion(p.mechanism, p.vary).in_mode(best)
    else:
        best = in_mode_of(best, p.nominal_answer, p.requested)
    return Optimum(
        mechanism=best,
        numbers=tuple(n.path for n in varied),
        values=values,
        nominal=np.array([n.value for n in varied]),
        bounds=np.stack([p.low, p.high], axis=1),
        aim=p.aim,
        conditions=p.conditions,
        before=p.nominal_answer,
        after=p.answer_of(best),
        feasible=feasible,
        found=alike,
        polished=polished,
        started=started,
        kinds=number_kinds(m, varied),
        functions=p.functions,
        instants=p.motion.count if p.motion else 0,
    )
