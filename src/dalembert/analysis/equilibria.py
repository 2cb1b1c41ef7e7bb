"""Equilibrium positions: where a given effort holds the machine, all of them in a range, with their stability.

g(q) = effort needed at q - effort given. A root is stable where g grows through it: the given effort then pulls back.
Mechanics: docs/theory.md 5.3.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from dalembert.analysis.one_pass import at_schedule, some_positions
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.analysis.result.result import Result
from dalembert.analysis.status.closure_failure import quantity_text
from dalembert.arrays import Array, Flags, Ints, Tree
from dalembert.model import Mechanism, Schedule

SCAN = 720
"""Positions scanned for changes of sign; equilibria closer together than two of them may be missed in pairs."""

COARSE = 60
STEPS = 60
EQUAL = 1e-9
"""Efforts this close, relative to the largest in the range, count as equal."""


def equilibria(m: Mechanism, schedule: Schedule, inertia: bool) -> Result:
    """Every position of the unknown drive in its range where its given effort is in equilibrium."""
    scan = _Scan(m, schedule, inertia)
    q = np.linspace(*scan.range, SCAN + 1)
    g, scale = scan.excess(q)
    solved = np.isfinite(g)
    if solved.any() and np.nanmax(np.abs(g)) <= EQUAL * scale:
        result = scan.at(q[:1])
        sentence = "Every position of the range is an equilibrium (indifferent): the first is given."
        return replace(result, stability=("neutral",), reasons=(sentence,))
    roots = _distinct(
        np.concatenate([_crossings(scan, q, g, scale), _touches(scan, q, g, scale)]), q[1] - q[0]
    )
    if scan.whole_turn and roots.size > 1 and abs(roots[-1] - roots[0] - 2 * np.pi) < 1e-9:
        roots = roots[:-1]
    if not roots.size:
        return _none(scan, q, g)
    result = scan.at(roots)
    result.effort_array[:, scan.drive] = scan.known_effort(result)
    return replace(result, stability=_stability(scan, roots, scale))


class _Scan:
    """Efforts of the unknown drive at chosen positions, the other drives standing."""

    def __init__(self, m: Mechanism, schedule: Schedule, inertia: bool) -> None:
        assert schedule.unknown is not None
        assert schedule.range is not None
        self.m, self.schedule, self.inertia = m, schedule, inertia
        self.name, self.range = schedule.unknown, schedule.range
        self.drive = schedule.names.index(schedule.unknown)
        self.whole_turn = abs(abs(self.range[1] - self.range[0]) - 2 * np.pi) < 1e-9
        self.grid = np.linspace(*self.range, COARSE + 1)

    def result(self, q: Array) -> tuple[Result, Ints]:
        """Analysis over a coarse grid and the positions q, and the places of q in it.

        Where the grid does not close it is not tried again: each such position is searched for at length.
        """
        grid = np.union1d(self.grid, q)
        result = at_schedule(self.m, self._schedule(grid), self.inertia)
        closes: Flags = np.asarray(np.isfinite(result.point_array).all(axis=(1, 2)))
        closes = closes[np.searchsorted(grid, self.grid)]
        closes[0] = True  # the assembly is that of the first position
        self.grid = self.grid[closes]
        return result, np.searchsorted(grid, q)

    def _schedule(self, grid: Array) -> Schedule:
        def column(values: Array) -> Array:
            return np.repeat(values[:1], len(grid), axis=0)

        position = column(self.schedule.position)
        position[:, self.drive] = grid
        rates = (column(self.schedule.speed), column(self.schedule.acceleration))
        return replace(self.schedule, position=position, speed=rates[0], acceleration=rates[1], time=None)

    def excess(self, q: Array) -> tuple[Array, float]:
        """g at q, NaN where unsolved, and the largest effort met."""
        result, where = self.result(q)
        needed, known = result.effort(self.name), self.known_effort(result)
        forces = np.abs(result.force_array).max(initial=0.0, where=np.isfinite(result.force_array))
        reference = forces * result.compiled.layout.length
        scale = max(float(np.nanmax(np.abs(np.append(needed[np.isfinite(needed)], known)))), reference * 1e-3)
        return (needed - known)[where], scale

    def known_effort(self, result: Result) -> Array:
        """The given effort at the positions of a result."""
        drives = {n: result.schedule.position[:, k] for k, n in enumerate(result.drives)}
        effort: Any = self.m.drives[self.name].effort
        value = effort.at(drives) if hasattr(effort, "at") else effort
        return np.broadcast_to(np.asarray(value, float), (len(result.status),))

    def at(self, q: Array) -> Result:
        """The result at positions q only."""
        result, where = self.result(q)
        return select_positions(result, where)


def select_positions(result: Result, where: Ints) -> Result:
    """A result at some of its positions."""
    counts = tuple(replace(n, margin=n.margin[where]) for n in result.compiled.counts)
    turns = {name: values[where] for name, values in result.compiled.pose_turns.items()}
    arrays: Tree = {
        name: value[where]
        for name, value in vars(result).items()
        if isinstance(value, np.ndarray) and value.ndim > 0
    }
    return replace(
        result,
        compiled=replace(some_positions(result.compiled, where), counts=counts, pose_turns=turns),
        status=tuple(result.status[k] for k in where),
        reasons=tuple(result.reasons[k] for k in where),
        **arrays,
    )


def _crossings(scan: _Scan, q: Array, g: Array, scale: float) -> Array:
    """Roots between neighbours of different sign, all refined together, and those at the ends of the range.

    By secants that keep the root between them (Illinois: an end that stays twice counts with half its value), every
    fourth step halving the interval, because a pole is not a root.
    """
    zero = g == 0
    zero[[0, -1]] = np.abs(g[[0, -1]]) <= EQUAL * scale  # beyond an end no sign is seen that could change
    exact = q[zero]
    k = np.flatnonzero(g[:-1] * g[1:] < 0)
    a, b, ga, gb = q[k].copy(), q[k + 1].copy(), g[k].copy(), g[k + 1].copy()
    fa, fb, side, x = ga.copy(), gb.copy(), np.zeros(len(k)), a.copy()
    for step in range(STEPS if k.size else 0):
        middle, secant = (a + b) / 2, a - fa * (b - a) / (fb - fa)
        before, x = x, middle if step % 4 == 3 else np.clip(secant, np.minimum(a, b), np.maximum(a, b))
        gx, _ = scan.excess(x)
        gx = np.where(np.isfinite(gx), gx, ga)
        left = gx * ga > 0
        a, ga, b, gb = np.where(left, (x, gx, b, gb), (a, ga, x, gx))
        fa = np.where(left, gx, np.where(side < 0, fa / 2, fa))
        fb = np.where(left, np.where(side > 0, fb / 2, fb), gx)
        side = np.where(left, 1.0, -1.0)
        still = np.minimum(np.abs(b - a), np.abs(x - before)) <= 4e-16 * np.maximum(np.abs(x), 1e-3)
        if np.all(still | (gx == 0)):
            break
    roots = np.where(np.abs(ga) < np.abs(gb), a, b)
    poles = np.minimum(np.abs(ga), np.abs(gb)) > 1e-6 * scale
    return np.concatenate([exact, roots[~poles]])


def _touches(scan: _Scan, q: Array, g: Array, scale: float) -> Array:
    """Roots where g touches zero without a change of sign: least values of |g| that vanish."""
    size = np.abs(g)
    inner = (
        np.flatnonzero((size[1:-1] < size[:-2]) & (size[1:-1] <= size[2:]) & (size[1:-1] < 1e-2 * scale)) + 1
    )
    same = inner[(g[inner - 1] * g[inner] > 0) & (g[inner] * g[inner + 1] > 0)]
    if not same.size:
        return np.zeros(0)
    low, high = q[same - 1].copy(), q[same + 1].copy()
    for _ in range(STEPS):
        x1, x2 = low + 0.382 * (high - low), low + 0.618 * (high - low)
        first = np.abs(scan.excess(x1)[0]) < np.abs(scan.excess(x2)[0])
        high, low = np.where(first, x2, high), np.where(first, low, x1)
        if np.all(high - low < 1e-9):
            break
    x = (low + high) / 2
    return np.asarray(x[np.abs(scan.excess(x)[0]) <= EQUAL * scale])


def _distinct(roots: Array, spacing: float) -> Array:
    """Sorted, without repetitions."""
    roots = np.sort(roots)
    return roots[np.append(True, np.diff(roots) > 1e-6 * abs(spacing))] if roots.size else roots


def _stability(scan: _Scan, roots: Array, scale: float) -> tuple[str | None, ...]:
    """Sign of dg/dq at each root."""
    h = 1e-4 * abs(scan.range[1] - scan.range[0])
    slope = (scan.excess(roots + h)[0] - scan.excess(roots - h)[0]) / (2 * h)
    flat = np.abs(slope) * abs(scan.range[1] - scan.range[0]) <= 1e-6 * scale
    return tuple(
        "neutral" if f else "stable" if s > 0 else "unstable" for s, f in zip(slope, flat, strict=True)
    )


def _none(scan: _Scan, q: Array, g: Array) -> Result:
    """No root: one position without values, and the range of efforts that would be met."""
    result = scan.at(q[[int(np.isfinite(g).argmax())]])
    arrays = {n: v for n, v in vars(result).items() if isinstance(v, np.ndarray) and v.dtype.kind == "f"}
    blank: Tree = {n: np.full_like(v, np.nan) for n, v in arrays.items()}
    position = np.full_like(result.schedule.position, np.nan)
    compiled = replace(result.compiled, schedule=replace(result.schedule, position=position))
    sentence = f"No position of {scan.name} in its range has an answer: {result.reasons[0]}"
    if np.isfinite(g).any():
        kind = drive_kinds(result, scan.name)["effort"]
        ends = " to ".join(quantity_text(compiled, kind, float(x)) for x in (np.nanmin(g), np.nanmax(g)))
        sentence = (
            f"No position of {scan.name} in its range is in equilibrium: the effort needed differs from the given one "
            f"by {ends}. Change the effort or widen the range."
        )
    return replace(
        result, compiled=compiled, status=("no_balance",), reasons=(sentence,), stability=(None,), **blank
    )
