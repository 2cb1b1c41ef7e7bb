"""Optimizers by name, of scipy, nlopt and pymoo: a row of a table each, behind a thin adapter.

To ``polish`` is to improve one design under conditions; to ``search`` is to improve many by the aim and its penalties,
before the best are polished; a ``front`` is between two aims.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.wording import closest

METHODS = {
    "scipy.slsqp": ("polish", "SLSQP"),
    "nlopt.slsqp": ("polish", "LD_SLSQP"),
    "nlopt.mma": ("polish", "LD_MMA"),
    "nlopt.ccsaq": ("polish", "LD_CCSAQ"),
    "nlopt.cobyla": ("polish", "LN_COBYLA"),
    "nlopt.crs": ("search", "GN_CRS2_LM"),
    "nlopt.direct": ("search", "GN_DIRECT_L"),
    "nlopt.isres": ("search", "GN_ISRES"),
    "pymoo.de": ("search", "soo.nonconvex.de.DE"),
    "pymoo.ga": ("search", "soo.nonconvex.ga.GA"),
    "pymoo.pso": ("search", "soo.nonconvex.pso.PSO"),
    "pymoo.nsga2": ("front", "moo.nsga2.NSGA2"),
    "pymoo.spea2": ("front", "moo.spea2.SPEA2"),
}
"""Name -> its role, and its name in its package."""
DEFAULT = "scipy.slsqp"
STEPS, EVALUATIONS, GENERATIONS, POPULATION = 100, 10_000, 200, 100
"""Largest numbers of iterations of a polish, of evaluations of a search of nlopt, and of generations of pymoo and
designs in each."""
OPEN = 1e3
"""Violation assigned to an unsolved design, over the usual size."""

Valued = Callable[[Array], tuple[float, Array]]
Rules = tuple[Callable[[Array], Array], Callable[[Array], Array]]
"""Functions that must not be negative, and their gradients."""


def find_method(name: object, *does: str) -> str:
    """The full name of a method for one of some roles; for a package name, its first method. Raises ModelError if it is
    unknown, or its package is not installed."""
    suited = [n for n, (what, _) in METHODS.items() if what in does]
    full_name = next((n for n in suited if name in (n, n.partition(".")[0])), "")
    if not full_name:
        raise ModelError(f"unknown method {name!r} for this problem", closest(str(name), suited), ("method",))
    package = full_name.partition(".")[0]
    if find_spec(package) is None:
        raise ModelError(f"method {full_name!r} needs {package}", f"pip install {package}", ("method",))
    return full_name


def polish_by(name: str, aim: Valued, rules: Rules | None, start: Array, high: Array) -> Array:
    """A better x, between zero and ``high``, by a method that polishes, or by the default if the method does not."""
    name = name if METHODS[name][0] == "polish" else DEFAULT
    if name != DEFAULT:
        return _nlopt(name, aim, rules, start, high, 10 * STEPS)
    from scipy.optimize import minimize

    solver: Any = minimize
    conditions = [{"type": "ineq", "fun": rules[0], "jac": rules[1]}] if rules else []
    options = {"maxiter": STEPS, "ftol": 1e-10}
    bounds = [(0.0, float(end)) for end in high]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # scipy warns where a step leaves the bounds by rounding
        optimum = solver(
            aim, start, jac=True, method="SLSQP", bounds=bounds, constraints=conditions, options=options
        )
    return np.asarray(optimum.x)


def search_by(name: str, value: Callable[[Array], Array], starts: Array, seed: int) -> Array:
    """Better places (design, number) in the unit box by a method that searches."""

    def finite(u: Array) -> Array:
        return np.nan_to_num(value(u), nan=OPEN, posinf=OPEN)

    if name.startswith("pymoo"):
        return evolve(name, lambda u: {"F": finite(u)[:, None]}, 1, 0, starts, seed)
    import_module("nlopt").srand(seed)
    best, none = starts[np.argmin(finite(starts))], np.zeros(0)
    return _nlopt(name, lambda x: (float(finite(x[None])[0]), none), None, best, best * 0 + 1, EVALUATIONS)[
        None
    ]


def _nlopt(name: str, aim: Valued, rules: Rules | None, start: Array, high: Array, evaluations: int) -> Array:
    nlopt, last = import_module("nlopt"), [start]

    def value(x: Array, slope: Array) -> float:
        last[0] = x.copy()
        size, rate = aim(x)
        slope[:] = rate if slope.size else 0.0
        return size

    solver = nlopt.opt(getattr(nlopt, METHODS[name][1]), len(start))
    solver.set_lower_bounds(np.zeros(len(start)))
    solver.set_upper_bounds(high)
    solver.set_min_objective(value)
    if rules is not None:
        room, room_slope = rules

        def lacks(out: Array, x: Array, slope: Array) -> None:
            out[:] = -room(x)
            slope[:] = -room_slope(x) if slope.size else 0.0

        solver.add_inequality_mconstraint(lacks, np.full(len(room(start)), 1e-9))
    solver.set_maxeval(evaluations)
    solver.set_ftol_rel(1e-10)
    try:
        return np.asarray(solver.optimize(np.minimum(start, high)))
    except (RuntimeError, nlopt.RoundoffLimited):  # no further step is possible
        return last[0]


def evolve(
    name: str, of: Callable[[Array], dict[str, Array]], aims: int, rules: int, starts: Array, seed: int
) -> Array:
    """The last designs (design, number) of a method of pymoo, for two aims its front: ``of`` gives aims F (design, aim)
    and violations G (design, rule)."""
    path, _, made = METHODS[name][1].rpartition(".")
    algorithm = getattr(import_module(f"pymoo.algorithms.{path}"), made)
    kind = import_module("pymoo.core.problem").Problem
    evaluate = {"_evaluate": lambda _, u, out, *args, **more: out.update(of(u))}
    problem = type("Designs", (kind,), evaluate)(
        n_var=starts.shape[1], n_obj=aims, n_ieq_constr=rules, xl=0.0, xu=1.0
    )
    begun = np.concatenate([starts, np.random.default_rng(seed).random((POPULATION, starts.shape[1]))])
    method = algorithm(pop_size=POPULATION, sampling=begun[:POPULATION])
    evolved = import_module("pymoo.optimize").minimize(problem, method, ("n_gen", GENERATIONS), seed=seed)
    return np.atleast_2d(np.asarray((evolved.pop if aims == 1 else evolved.opt).get("X"), float))
