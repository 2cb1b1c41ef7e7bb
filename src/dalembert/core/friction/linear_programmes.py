"""Linear programmes of a batch by the simplex method (Dantzig): the largest q . d where G d <= h, with h >= 0.

All programmes of a batch are solved together, on whole tables: every basic variable is b - M n of the variables n that
are zero. The d themselves have no bounds: each enters once, with the sense that raises q . d, and then stays.

Friction at rest asks for hundreds of programmes of ten unknowns a position; ``scipy.optimize.linprog`` solves the same
ones one by one, in fifty times the time.

Mechanics: docs/theory.md 6.3.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array, Flags

ZERO = 1e-11
"""Entries of a table, made of numbers around one, that count as zero."""

PIVOTS = 8
"""Exchanges of variables by rows of the table after which the point reached is taken: allowed, if not the furthest."""


FAR = 1e3
"""How far along a way without an end."""


def furthest(g: Array, h: Array, q: Array) -> tuple[Array, Flags]:
    """d (B, n) with the largest q . d where G (B, m, n) d <= h (B, m), and where there is no largest (B,): there a d
    far out on the way that has no end."""
    count, m, n = g.shape
    whole = np.concatenate([np.concatenate([g, h[..., None]], 2), np.pad(-q, ((0, 0), (0, 1)))[:, None]], 1)
    names = np.tile(np.arange(n + m), (count, 1))
    tables = _Tables(whole, names[:, n:], names[:, :n], np.zeros((count, n)))
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
    """Tables (B, m + 1, n + 1), the last column b and the last row minus the gain; names of the variables of the rows
    (B, m) and columns (B, n): below n those of d; beyond (B, n): what d has as a column, far out."""

    def __init__(self, table: Array, rows: Array, columns: Array, beyond: Array) -> None:
        self.table, self.rows, self.columns, self.beyond = table, rows, columns, beyond

    def some(self, which: Array) -> _Tables:
        return _Tables(*(a[which] for a in vars(self).values()))

    def keep(self, which: Array, part: _Tables) -> None:
        for name, whole in vars(self).items():
            whole[which] = getattr(part, name)

    def entering(self) -> tuple[Array, Flags]:
        """The column that gains most, those of d first; whether one gains."""
        gain, free = -self.table[:, -1, :-1], self.columns < self.columns.shape[1]
        gain = np.where(free & (np.abs(gain) > ZERO), 1e30 * np.abs(gain), np.where(free, 0.0, gain))
        column = gain.argmax(axis=1)
        return column, gain.max(axis=1) > ZERO

    def towards_gain(self, column: Array, on: Array, sign: Array) -> None:
        """A d that gains by falling is counted the other way."""
        every = np.arange(len(column))
        down = self.table[every, -1, column] > 0
        self.table[every[down], :, column[down]] *= -1
        sign[on[down], self.columns[every[down], column[down]]] *= -1

    def leaving(self, column: Array) -> tuple[Array, Flags]:
        """The row whose variable first comes to zero; whether there is one."""
        every = np.arange(len(column))
        steep = self.table[every, :-1, column]
        falls = (steep > ZERO) & (self.rows >= self.columns.shape[1])
        ratio = np.where(falls, np.maximum(self.table[:, :-1, -1], 0.0) / np.where(falls, steep, 1.0), np.inf)
        least = ratio.min(axis=1, keepdims=True)
        row = np.where(falls & (ratio <= least * (1 + ZERO) + ZERO), steep, 0.0).argmax(axis=1)
        return row, np.isfinite(least[:, 0])

    def go_far(self, column: Array, which: Flags) -> None:
        """Raise the variable of a column, which nothing ends."""
        some = np.flatnonzero(which)
        self.table[some, :, -1] -= FAR * self.table[some, :, column[some]]
        own = some[self.columns[some, column[some]] < self.columns.shape[1]]
        self.beyond[own, self.columns[own, column[own]]] = FAR

    def exchange(self, row: Array, column: Array) -> None:
        """Exchange the variables of a row and a column of each table."""
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
        """d: of a row its b, of a column 0."""
        out = np.zeros((len(self.rows), n))
        table, row = np.nonzero(self.rows < n)
        out[table, self.rows[table, row]] = self.table[table, row, -1]
        return out
