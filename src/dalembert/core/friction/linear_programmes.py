"""Linear programmes of a batch by the simplex method (Dantzig): the largest q . d where G d <= h, with h >= 0.

All programmes of a batch are solved together, on full tableaux: every basic variable is b - M n of the variables n that
are zero. The d themselves have no bounds: each enters once, with the sense that raises q . d, and then stays.

Friction at rest needs hundreds of programmes with ten unknowns per position; ``scipy.optimize.linprog`` solves them one
by one and takes fifty times as long.

Mechanics: docs/theory.md 6.3.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array, Flags

ZERO = 1e-11
"""Entries of a tableau, scaled near one, that count as zero."""

PIVOTS = 8
"""Exchanges of variables, per row of the tableau, after which the current point is accepted: feasible, if
not optimal."""


FAR = 1e3
"""Step along an unbounded direction."""


def furthest(g: Array, h: Array, q: Array) -> tuple[Array, Flags]:
    """d (B, n) with the largest q . d where G (B, m, n) d <= h (B, m), and a flag where q . d is unbounded (B,); d is
    then a point far out along an unbounded direction."""
    count, m, n = g.shape
    table = np.concatenate([np.concatenate([g, h[..., None]], 2), np.pad(-q, ((0, 0), (0, 1)))[:, None]], 1)
    names = np.tile(np.arange(n + m), (count, 1))
    tables = _Tables(table, names[:, n:], names[:, :n], np.zeros((count, n)))
    sign, unbounded, on = np.ones((count, n)), np.zeros(count, bool), np.arange(count)
    for _ in range(PIVOTS * m):
        part = tables.some(on)
        column, gains = part.entering()
        on, part, column = on[gains], part.some(gains), column[gains]
        if not on.size:
            break
        part.towards_gain(column, on, sign)
        row, blocked = part.leaving(column)
        unbounded[on[~blocked]] = True
        part.go_far(column, ~blocked)
        tables.keep(on, part)
        on, part = on[blocked], part.some(blocked)
        part.exchange(row[blocked], column[blocked])
        tables.keep(on, part)
    return sign * (tables.free(n) + tables.beyond), unbounded


class _Tables:
    """Tableaux (B, m + 1, n + 1), the last column b and the last row minus the gain; names of the variables of the rows
    (B, m) and columns (B, n): below n those of d; beyond (B, n): value of d's variables while nonbasic and far out."""

    def __init__(self, table: Array, rows: Array, columns: Array, beyond: Array) -> None:
        self.table, self.rows, self.columns, self.beyond = table, rows, columns, beyond

    def some(self, which: Array) -> _Tables:
        return _Tables(*(a[which] for a in vars(self).values()))

    def keep(self, which: Array, part: _Tables) -> None:
        for name, values in vars(self).items():
            values[which] = getattr(part, name)

    def entering(self) -> tuple[Array, Flags]:
        """Column that gains most, those of d first, and a flag if one gains."""
        gain, free = -self.table[:, -1, :-1], self.columns < self.columns.shape[1]
        gain = np.where(free & (np.abs(gain) > ZERO), 1e30 * np.abs(gain), np.where(free, 0.0, gain))
        column = gain.argmax(axis=1)
        return column, gain.max(axis=1) > ZERO

    def towards_gain(self, column: Array, on: Array, sign: Array) -> None:
        """Reverses the sign of each d that gains by falling."""
        every = np.arange(len(column))
        down = self.table[every, -1, column] > 0
        self.table[every[down], :, column[down]] *= -1
        sign[on[down], self.columns[every[down], column[down]]] *= -1

    def leaving(self, column: Array) -> tuple[Array, Flags]:
        """Row whose variable reaches zero first, and a flag if one does."""
        every = np.arange(len(column))
        steep = self.table[every, :-1, column]
        falls = (steep > ZERO) & (self.rows >= self.columns.shape[1])
        ratio = np.where(falls, np.maximum(self.table[:, :-1, -1], 0.0) / np.where(falls, steep, 1.0), np.inf)
        least = ratio.min(axis=1, keepdims=True)
        row = np.where(falls & (ratio <= least * (1 + ZERO) + ZERO), steep, 0.0).argmax(axis=1)
        return row, np.isfinite(least[:, 0])

    def go_far(self, column: Array, which: Flags) -> None:
        """Raises the variable of a column that no limit bounds."""
        some = np.flatnonzero(which)
        self.table[some, :, -1] -= FAR * self.table[some, :, column[some]]
        unbounded = some[self.columns[some, column[some]] < self.columns.shape[1]]
        self.beyond[unbounded, self.columns[unbounded, column[unbounded]]] = FAR

    def exchange(self, row: Array, column: Array) -> None:
        """Exchanges the variables of a row and a column of each tableau."""
        every = np.arange(len(row))
        pivot = self.table[every, row, column]
        line = self.table[every, row, :] / pivot[:, None]
        edge = self.table[every, :, column]
        self.table -= edge[:, :, None] * line[:, None, :]
        self.table[every, :, column] = -edge / pivot[:, None]
        self.table[every, row, :] = line
        self.table[every, row, column] = 1 / pivot
        self.rows[every, row], self.columns[every, column] = (
            self.columns[every, column],
            self.rows[every, row],
        )

    def free(self, n: int) -> Array:
        """d: b of its row where basic, 0 in a column."""
        out = np.zeros((len(self.rows), n))
        table, row = np.nonzero(self.rows < n)
        out[table, self.rows[table, row]] = self.table[table, row, -1]
        return out
