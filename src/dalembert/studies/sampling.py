"""Designs by their number: each depends on the seed, the path and its number alone.

So any part of them can be computed by any process in any order, with the same bits; no state is kept between designs.
Random numbers are Philox's, addressed by counter, a separate row for each path: `kernel.emit.random_numbers`.

Mechanics: docs/theory.md 11.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import prod
from typing import Any

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.kernel.emit.random_numbers import FIELDS, draw, quantiles
from dalembert.saving import check_installed
from dalembert.studies.spreads import Spread
from dalembert.wording import closest, quote_value

DRAWS = ("random", "sobol", "latin", "factorial", "table")
MOST = 10**12
"""Designs of one study."""
BITS = 30
"""Bits of a Sobol number; at most 2^30 of them exist."""
LOW = 16
"""Bits of a Sobol point's number that are looked up in one table."""
SHARE, SCORE = Spread("uniform", 0, 1), Spread("normal", 0, 1)
"""Spreads whose value is the share, and the normal score."""


def triangle_of(
    paths: Sequence[str], correlations: Mapping[tuple[str, str], float], draw: str
) -> Array | None:
    """The triangle that makes correlated normal scores."""
    if not correlations:
        return None
    if draw in ("table", "factorial"):
        raise ModelError(f"a {draw} has no correlation", "leave it out, or draw at random", ("correlation",))
    matrix = np.eye(len(paths))
    for pair, r in correlations.items():
        for path in pair:
            if path not in paths:
                raise ModelError(
                    f"correlation names {path!r}, which does not vary",
                    f"there are: {', '.join(paths)}",
                    ("correlation",),
                )
        i, j = (paths.index(path) for path in pair)
        if i == j:
            raise ModelError(
                f"correlation names {paths[i]!r} with itself", "name two paths", ("correlation",)
            )
        if isinstance(r, bool) or not isinstance(r, (int, float)) or not -1 < r < 1:
            raise ModelError(
                f"{quote_value(r)} is not a correlation of two numbers",
                "give one between -1 and 1",
                ("correlation",),
            )
        matrix[i, j] = matrix[j, i] = r
    try:
        return np.asarray(np.linalg.cholesky(matrix))
    except np.linalg.LinAlgError:
        raise ModelError(
            "the correlations contradict each other", "make some of them smaller", ("correlation",)
        ) from None


@dataclass(frozen=True)
class DesignPlan:
    """Plan of the designs: values (design, number) in SI by the number of the design, from 0."""

    paths: tuple[str, ...]
    spreads: tuple[Spread, ...]
    draw: str = "random"
    designs: int = 0
    seed: int = 0
    table: Array | None = field(default=None, repr=False)
    mixing: Array | None = field(default=None, repr=False)
    """For correlated numbers, the lower triangle that makes their normal scores from independent ones."""

    def __post_init__(self) -> None:
        if self.draw not in DRAWS:
            raise ModelError(f"unknown sampling method {self.draw!r}", closest(self.draw, list(DRAWS)))
        if self.draw == "factorial" and any(s.kind != "levels" for s in self.spreads):
            k = next(k for k, s in enumerate(self.spreads) if s.kind != "levels")
            what = f"{self.paths[k]}: a factorial needs levels"
            raise ModelError(what, "write a list, or 70..90 N in 5", (self.paths[k],))
        if self.draw not in ("factorial", "table"):
            check_installed("llvmlite", "drawing designs", "study")
        most = 2**BITS if self.draw == "sobol" else MOST
        if not 1 <= self.count <= most:
            more = "; more can be drawn at random" if self.draw == "sobol" else ""
            raise ModelError(f"designs={self.count} is out of range", f"use 1 to {most}{more}", ("designs",))

    @property
    def count(self) -> int:
        """Number of designs."""
        if self.draw == "factorial":
            return prod(len(s.levels) for s in self.spreads)
        return self.designs if self.table is None else len(self.table)

    @property
    def extendable(self) -> bool:
        """True if more designs leave the existing ones unchanged."""
        return self.draw in ("random", "sobol")

    def values(self, start: int, stop: int) -> Array:
        """Designs ``start`` to ``stop``, always the same bits."""
        if self.table is not None:
            return np.ascontiguousarray(self.table[start:stop])
        out = np.empty((stop - start, len(self.paths)))
        if self.draw == "factorial":
            place = np.arange(start, stop)
            for j in range(len(self.paths) - 1, -1, -1):
                levels = np.asarray(self.spreads[j].levels)
                place, k = np.divmod(place, len(levels))
                out[:, j] = levels[k]
            return out
        if self.draw == "random" and self.mixing is None:
            out = draw(self._rows, start, stop)
        else:
            out = quantiles(self._rows, self._shares(start, stop))
        for j, s in enumerate(self.spreads):
            if s.kind == "levels":
                out[:, j] = s.pick(out[:, j])
        return out

    def _shares(self, start: int, stop: int) -> Array:
        """Share of the designs below each number's value (number, design)."""
        if self.draw == "sobol":
            u = self._sobol(np.arange(start, stop))
        else:
            u = draw(self._rows_of([SHARE.law] * len(self.paths)), start, stop).T
        if self.draw == "latin":
            for path, row in zip(self.paths, u, strict=True):
                row += permuted(np.arange(start, stop), self.count, self.seed, path)
                row /= self.count
        if self.mixing is None:
            return u
        from scipy.special import ndtr

        scores = quantiles(self._rows_of([SCORE.law] * len(self.paths)), u).T
        return np.asarray(ndtr(sum_in_order(self.mixing, scores)))

    @cached_property
    def _rows(self) -> Array:
        return self._rows_of([s.law for s in self.spreads])

    def _rows_of(self, laws: Sequence[tuple[float, ...]]) -> Array:
        """Sampling law of each number, as `draw` reads it."""
        out = np.zeros((len(laws), FIELDS), np.uint64)
        out[:, :2] = [_key(self.seed, path) for path in self.paths]
        out.view(float)[:, 2 : 2 + len(laws[0])] = laws
        return out

    @cached_property
    def _sobol(self) -> Sobol:
        return Sobol(self.seed, len(self.paths), self.count)

    def __getstate__(self) -> dict[str, object]:
        return {name: value for name, value in self.__dict__.items() if name != "_sobol"}


def sum_in_order(matrix: Array, rows: Array) -> Array:
    """The product, summed in one order whatever the number of columns: a BLAS sums as it likes."""
    out = np.zeros_like(rows)
    for i in range(len(matrix)):
        for j in range(i + 1):
            if matrix[i, j]:
                out[i] += matrix[i, j] * rows[j]
    return out


def _key(seed: int, path: str) -> Array:
    name = int.from_bytes(hashlib.sha256(path.encode()).digest()[:8], "little")
    return np.array([seed % 2**64, name], np.uint64)


def permuted(index: Array, count: int, seed: int, path: str) -> Array:
    """Place of each index in a permutation of ``count`` things: rounds of a Feistel network until inside."""
    half = np.uint64((max(2, int(count - 1).bit_length()) + 1) // 2)
    mask = np.uint64((1 << int(half)) - 1)
    keys = np.random.Philox(key=_key(seed, f"{path} permuted")).random_raw(6)

    def rounds(x: Array) -> Array:
        left, right = x >> half, x & mask
        for key in keys:
            f = (right + key) * np.uint64(0x9E3779B97F4A7C15)
            f ^= f >> np.uint64(29)
            f *= np.uint64(0xBF58476D1CE4E5B9)
            left, right = right, (left ^ f ^ (f >> np.uint64(32))) & mask
        return np.asarray((left << half) | right)

    x = rounds(np.asarray(index, np.uint64))
    while (out := x >= np.uint64(count)).any():
        x[out] = rounds(x[out])
    return x


class Sobol:
    """Scrambled Sobol points by number: the exclusive or of one direction for each bit of the number's Gray code.

    The directions are those of scipy's points 0, 1, 2, 4, ..., so that all the others are scipy's too.
    """

    def __init__(self, seed: int, numbers: int, count: int) -> None:
        from scipy.stats import qmc

        row = qmc.Sobol(numbers, scramble=True, bits=BITS, rng=np.random.default_rng(seed))
        self.shift, at, directions = self._next(row), 1, list[Array]()
        for k in range(max(1, int(count - 1).bit_length())):
            if (1 << k) > at:
                row.fast_forward((1 << k) - at)
            point, at = self._next(row), (1 << k) + 1
            directions.append(point ^ self.shift ^ (directions[-1] if k else np.uint64(0)))
        self.directions = np.array(directions, np.uint64)  # (bit, number)
        table = np.zeros((numbers, 1), np.uint64)
        for v in self.directions[:LOW]:
            table = np.concatenate([table, table ^ v[:, None]], axis=1)
        self.table = table

    @staticmethod
    def _next(row: Any) -> Array:
        return np.asarray(row.random(1)[0] * 2.0**BITS, np.uint64)

    def __call__(self, index: Array) -> Array:
        """Points (number, index)."""
        gray = index ^ (index >> 1)
        low, high = (gray & ((1 << LOW) - 1)) % self.table.shape[1], gray >> LOW
        out = np.empty((len(self.table), len(index)))
        for row, table, shift, directions in zip(out, self.table, self.shift, self.directions.T, strict=True):
            x = table[low] ^ shift
            for k, direction in enumerate(directions[LOW:]):
                x ^= np.where((high >> k) & 1, direction, np.uint64(0))
            row[:] = (x + 0.5) * 2.0**-BITS
        return out
