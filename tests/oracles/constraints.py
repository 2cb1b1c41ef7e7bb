"""Constraint functions of each joint, written once as formulas; sympy differentiates them.

Every function is zero when the joint fits. Its derivative by q is the Jacobian J, and
J a = gamma with gamma = -(J v)_q v, both derived here and never written by hand.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp

Q = sp.symbols("xi yi ti xj yj tj", real=True)
V = sp.symbols("vxi vyi wi vxj vyj wj", real=True)
AT = sp.symbols("aix aiy ajx ajy", real=True)
DIRECTION, ANGLE, RI, RJ, PHASE, START = sp.symbols("direction angle ri rj phase start", real=True)
PARAMETERS = (*AT, DIRECTION, ANGLE, RI, RJ, PHASE, START)
"""``ri, rj``: signed radii of i and j; ``phase``: mesh constant; ``start``: a direction near the line of centres."""


def _gap() -> sp.Matrix:
    """From i's point to j's point."""
    xi, yi, ti, xj, yj, tj = Q
    aix, aiy, ajx, ajy = AT
    at_i = sp.Matrix([xi + aix * sp.cos(ti) - aiy * sp.sin(ti), yi + aix * sp.sin(ti) + aiy * sp.cos(ti)])
    at_j = sp.Matrix([xj + ajx * sp.cos(tj) - ajy * sp.sin(tj), yj + ajx * sp.sin(tj) + ajy * sp.cos(tj)])
    return at_j - at_i


def _along() -> sp.Expr:
    d = _gap()
    return d[0] * sp.cos(Q[2] + DIRECTION) + d[1] * sp.sin(Q[2] + DIRECTION)


def _across() -> sp.Expr:
    d = _gap()
    return -d[0] * sp.sin(Q[2] + DIRECTION) + d[1] * sp.cos(Q[2] + DIRECTION)


def _mesh() -> sp.Expr:
    """Arc rolled off on i against that on j, both counted from the line of centres."""
    d = _gap()
    c, s = sp.cos(START), sp.sin(START)
    centres = START + sp.atan2(d[1] * c - d[0] * s, d[0] * c + d[1] * s)
    return RI * (Q[2] - centres) + RJ * (Q[5] - centres) - PHASE


def functions(kind: str) -> list[sp.Expr]:
    """The constraint functions of a joint type, or of a driven freedom (``turn``, ``slide``)."""
    d, turn = _gap(), Q[5] - Q[2]
    return {
        "pin": lambda: [d[0], d[1]],
        "weld": lambda: [d[0], d[1], turn - ANGLE],
        "slider": lambda: [_across(), turn - DIRECTION - ANGLE],
        "slot": lambda: [_across()],
        "circular_slot": lambda: [sp.sqrt(d[0] ** 2 + d[1] ** 2) - RI],
        "gear": lambda: [_mesh()],
        "rolling": lambda: [_across() - RJ, _along() + RJ * turn - PHASE],
        "rolling_circle": lambda: [sp.sqrt(d[0] ** 2 + d[1] ** 2) - RI - RJ, _mesh()],
        "turn": lambda: [turn - PHASE],
        "slide": lambda: [_along() - PHASE],
    }[kind]()


@lru_cache(None)
def size(kind: str) -> int:
    return len(functions(kind))


@lru_cache(None)
def compiled(kind: str) -> Callable[..., Any]:
    """f(qi, qj, vi, vj, parameters) -> (phi, J, gamma) with shapes (P, k), (P, k, 6), (P, k)."""
    phi = sp.Matrix(functions(kind))
    jacobian = phi.jacobian(Q)
    rate = jacobian * sp.Matrix(V)
    gamma = -rate.jacobian(Q) * sp.Matrix(V)
    flat = sp.lambdify((Q, V, PARAMETERS), [*phi, *jacobian, *gamma], "numpy", cse=True)
    k = len(phi)

    def evaluated(q: Any, v: Any, parameters: Any) -> Any:
        values = flat(q, v, parameters)
        out = np.empty((*q[0].shape, len(values)), q[0].dtype)
        for n, value in enumerate(values):
            out[..., n] = value
        return out[..., :k], out[..., k : 7 * k].reshape(*out.shape[:-1], k, 6), out[..., 7 * k :]

    return evaluated
