"""Lift curves of cams as tables of pieces, evaluated with numbers or with traced values.

A piece holds from x0 on and is, with u = x - start,
    sum of c_k u^k + a sin(w u + p) + C cos(v) + S sqrt(R^2 - C^2 sin^2 v) + D / cos(l (u + g)),  v = u + g:
polynomials and sine waves of motion laws, circles and straight lines in polar coordinates.
"""

from __future__ import annotations

import math

import numpy as np

from dalembert.arrays import Array, Numeric
from dalembert.core.branchless import above, any_traced, larger, root

POWERS = 8
COLUMNS = ("from", "start", *(f"c{k}" for k in range(POWERS)), "amplitude", "frequency", "phase")
COLUMNS = (*COLUMNS, "center", "shift", "circle", "radius", "line", "straight", "jump")
WIDTH = len(COLUMNS)
TURN = 2 * np.pi
JUMP = 1e-6
"""Part of the largest second derivative by which two may differ and be equal."""
SNAP = 1e-11
"""Angle by which a place may be short of a piece and be in it: rounding."""


def piece(start: float, **values: object) -> list[object]:
    """A row of a table; ``jump``: 1 where the second derivative jumps at its beginning, as ``with_jumps`` finds."""
    return [start, start, *(values.get(name, 0.0) for name in COLUMNS[2:])]


def with_jumps(table: Array) -> Array:
    """The table with a flag where the second derivative of a piece is not that of the one before it."""
    if any_traced(table):
        return table
    ends = np.append(table[1:, 0], table[0, 0] + TURN)
    places = np.linspace(table[:, 0], ends, 9)
    bends = [_evaluate(table.T, x)[2] for x in places]
    out, size = table.copy(), max(float(np.abs(b).max()) for b in bends)
    out[:, -1] = np.abs(bends[0] - np.roll(bends[-1], 1)) > JUMP * size
    return out


def same_count(tables: list[Array]) -> list[Array]:
    """Tables (N, W) with their last rows repeated, so that all have one length."""
    most = max(len(t) for t in tables)
    return [np.concatenate([t, np.repeat(t[-1:], most - len(t), axis=0)]) for t in tables]


def lift(table: Array, x: Array) -> tuple[Array, Array, Array]:
    """Values and first two derivatives (..., k) of tables (k, N, W) at angles x (..., k), periodic in a turn.

    At a joint of pieces those of the piece that begins at it.
    """
    start = table[:, 0, 0]
    if any_traced(table, x):
        turns = (x - start + SNAP) / TURN
        nearest = _RINT(turns)
        x = x - TURN * (nearest - above(nearest, turns))
        row = np.stack([_choose(table[k], x[..., k]) for k in range(len(table))], axis=-2)
        return _evaluate(np.moveaxis(row, -1, 0), x)
    with np.errstate(invalid="ignore"):
        x = start + np.mod(x - start + SNAP, TURN) - SNAP
        which = (x[..., None] + SNAP >= table[:, :, 0]).sum(axis=-1) - 1
    row = table[np.arange(len(table)), np.clip(which, 0, table.shape[1] - 1)]
    return _evaluate(np.moveaxis(row, -1, 0), x)


def _choose(rows: Array, x: Array) -> Array:
    """The row (..., W) of a table (N, W) that traced places are in, by bisection."""
    if len(rows) == 1:
        return np.broadcast_to(rows[0], (*x.shape, rows.shape[1])).astype(object)
    half = len(rows) // 2
    behind = np.asarray(1.0 - above(rows[half, 0] - SNAP, x))
    low, high = _choose(rows[:half], x), _choose(rows[half:], x)
    out = low.copy()
    for place in np.ndindex(low.shape):
        a, b = low[place], high[place]
        same = a is b or (isinstance(a, float) and isinstance(b, float) and a == b)
        out[place] = a if same else behind[place[:-1]] * (b - a) + a
    return out


def _evaluate(row: Array, x: Array) -> tuple[Array, Array, Array]:
    """Values of pieces (W, ..., k), each a row, at x (..., k)."""
    n = dict(zip(COLUMNS, row, strict=True))
    u = x - n["start"]
    values = [_polynomial(row[2 : 2 + POWERS], u, order) for order in range(3)]
    wave = n["frequency"] * u + n["phase"]
    s, c = n["amplitude"] * sine(wave), n["amplitude"] * cosine(wave)
    values = [values[0] + s, values[1] + n["frequency"] * c, values[2] - n["frequency"] ** 2 * s]
    if _some(n["circle"]):
        values = [a + b for a, b in zip(values, _circle(n, u + n["shift"]), strict=True)]
    if _some(n["straight"]):
        values = [a + b for a, b in zip(values, _line(n, u + n["shift"]), strict=True)]
    return values[0], values[1], values[2]


def _some(column: Array) -> bool:
    if not any_traced(column):
        return bool(np.any(column))
    return any(not isinstance(x, float) or x != 0 for x in np.ravel(column))


def _polynomial(c: Array, u: Array, order: int) -> Array:
    out = np.zeros_like(u)
    for k in range(POWERS - 1, order - 1, -1):
        out = out * u + float(math.perm(k, order)) * c[k]
    return out


def _circle(n: dict[str, Array], v: Array) -> list[Array]:
    side, center, square = n["circle"], n["center"], n["radius"] * n["radius"]
    s, c = sine(v), cosine(v)
    inside = square - center * s * center * s
    far = root(larger(inside + (1 - side * side), 1e-300))  # 1 where the piece is no circle
    slope = -(center * center) * s * c / far
    bend = -(center * center) * (c * c - s * s) / far - slope * slope / far
    return [center * c + side * far, -center * s + side * slope, -center * c + side * bend]


def _line(n: dict[str, Array], v: Array) -> list[Array]:
    angle = n["straight"] * v
    c = cosine(angle)
    value, tan = n["line"] / c, sine(angle) / c
    return [value, value * tan, value * (tan * tan + 1.0 / (c * c))]


_RINT = np.frompyfunc(lambda x: x.rint() if hasattr(x, "rint") else float(np.rint(x)), 1, 1)
_SIN = np.frompyfunc(lambda x: x.sin() if hasattr(x, "sin") else float(np.sin(x)), 1, 1)
_COS = np.frompyfunc(lambda x: x.cos() if hasattr(x, "cos") else float(np.cos(x)), 1, 1)


def _angle(y: Numeric, x: Numeric) -> Numeric:
    for value in (y, x):
        if hasattr(value, "op"):
            return value.graph.binary(
                "atan2", *(v if hasattr(v, "op") else value.graph.constant(v) for v in (y, x))
            )
    return float(np.arctan2(y, x))


_ATAN2 = np.frompyfunc(_angle, 2, 1)


def sine(x: Array) -> Array:
    """Sine."""
    return np.asarray(_SIN(x) if any_traced(x) else np.sin(x))


def cosine(x: Array) -> Array:
    """Cosine."""
    return np.asarray(_COS(x) if any_traced(x) else np.cos(x))


def arctan2(y: Array, x: Array) -> Array:
    """Angle of (x, y)."""
    return np.asarray(_ATAN2(y, x) if any_traced(y, x) else np.arctan2(y, x))
