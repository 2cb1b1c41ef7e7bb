"""One design at a time by sequential quadratic programming (SLSQP), with every position a row of its own.

A peak is no smooth function, but its least value is that of t under -t <= T_k <= t at all positions k.
"""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.optimization.aims import Problem, Rows

STEPS = 100
"""Most iterations."""
OPEN = 1e3
"""What is lacked where there is no answer, over the usual size."""


def polish(p: Problem, u: Array, free: Flags | None = None) -> Array:
    """A better place from a place u (number,) in the unit box; numbers that are not free stay. u itself where none is
    found."""
    from scipy.optimize import minimize

    solver: Any = minimize
    free = np.ones(len(u), bool) if free is None else free
    if not free.any():
        return u
    peak, kept = p.aim.word == "peak", dict[bytes, Rows]()

    def whole(x: Array) -> Array:
        place = u.copy()
        place[free] = np.clip(x[: free.sum()], 0.0, 1.0)
        return place

    def rows(x: Array) -> Rows:
        place = whole(x)
        key = place.tobytes()
        if key not in kept:
            kept.clear()
            kept[key] = p.at(place)
        return kept[key]

    def room(x: Array) -> Array:
        r = rows(x)
        parts = [(r.margin / p.sizes[:, None]).ravel()]
        if peak:
            parts += [x[-1] - r.aim / p.scale, x[-1] + r.aim / p.scale]
        return np.nan_to_num(np.concatenate(parts), nan=-OPEN)

    def room_slope(x: Array) -> Array:
        r = rows(x)
        part = (r.margin_slope / p.sizes[:, None, None]).reshape(-1, len(u))[:, free]
        if peak:
            sides = r.aim_slope[:, free] / p.scale
            one = np.ones((len(sides), 1))
            part = np.hstack([part, np.zeros((len(part), 1))])
            part = np.vstack([part, np.hstack([-sides, one]), np.hstack([sides, one])])
        return np.nan_to_num(part)

    def aim(x: Array) -> tuple[float, Array]:
        if peak:
            return float(x[-1]), np.eye(len(x))[-1]
        value, slope = p.sharp(whole(x))
        return (value / p.scale, slope[free] / p.scale) if np.isfinite(value) else (OPEN, np.zeros(len(x)))

    start = u[free]
    bounds: list[tuple[float, float | None]] = [(0.0, 1.0)] * int(free.sum())
    if peak:
        start = np.append(start, np.nanmax(np.abs(rows(start).aim), initial=0.0) / p.scale)
        bounds.append((0.0, None))
    rules: list[dict[str, Any]] = []
    if peak or p.conditions:
        rules = [{"type": "ineq", "fun": room, "jac": room_slope}]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # scipy says where a step leaves the bounds by rounding
        options = {"maxiter": STEPS, "ftol": 1e-10}
        found = solver(
            aim, start, jac=True, method="SLSQP", bounds=bounds, constraints=rules, options=options
        )
    return whole(found.x) if np.isfinite(found.x).all() else u
