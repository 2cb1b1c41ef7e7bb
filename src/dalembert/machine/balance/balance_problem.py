"""The convex problem of balancing: values y + C p of some quantities, least over cones of p.

Mechanics: docs/theory.md 10.2.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import AnalysisError, ModelError
from dalembert.machine.balance.cone_programme import minimise
from dalembert.machine.balance.counterweights import NONE, Counterweight
from dalembert.machine.output.written import greatest, rms

NOTHING = 1e-12
"""Part of the largest effect below which a mass number has none."""


@dataclass(frozen=True)
class Solved:
    """Mass numbers (4 W,), the value reached and a bound below all values, and the single quantities: all as parts of
    what they were before."""

    numbers: Array
    value: float
    bound: float
    parts: dict[str, float]


@dataclass(frozen=True)
class Problem:
    """Values (P, d) by quantity, their columns (P, d, 4 W), and the counterweights' bounds."""

    base: dict[str, Array]
    columns: dict[str, Array]
    weights: tuple[tuple[str, Counterweight], ...]

    def sizes(self, least: str) -> dict[str, float]:
        """Rms or greatest value of each quantity without counterweights."""
        return {name: rms(y) if least == "rms" else greatest(y)[0] for name, y in self.base.items()}

    def predict(self, name: str, numbers: Array) -> Array:
        """Values (P, d) of a quantity with these mass numbers."""
        return np.asarray(self.base[name] + self.columns[name] @ numbers)

    def solve(self, least: str, of: Mapping[str, float]) -> Solved:
        """The least weighted sum: of squares of rms values under a root, or of greatest values."""
        before = self.sizes(least)
        used = {n: w / before[n] for n, w in of.items() if w and before[n]}
        if not used:
            return self._solved(np.zeros(4 * len(self.weights)), 0.0, least, of)
        maps, cones = self._variables(used)
        y = {n: f * self.base[n] for n, f in used.items()}
        C = {n: f * np.einsum("pdk,kn->pdn", self.columns[n], maps) for n, f in used.items()}
        scale = np.sqrt(sum((c**2).sum(axis=(0, 1)) for c in C.values()) / len(next(iter(y.values()))))
        scale = np.where(scale > NOTHING * scale.max(initial=0.0), scale, 1.0)
        C = {n: c / scale for n, c in C.items()}
        cones = [(g / scale, h) for g, h in cones]
        x, bound = self._least_squares(y, C, cones) if least == "rms" else _least_peak(y, C, cones)
        return self._solved(maps @ (x / scale), bound, least, of)

    def _solved(self, numbers: Array, bound: float, least: str, of: Mapping[str, float]) -> Solved:
        p = numbers.reshape(-1, 4).copy()
        for k, (_, w) in enumerate(self.weights):
            p[k] = _buildable(p[k], w)
        before = self.sizes(least)
        left = {n: self.predict(n, p.ravel()) for n in self.base}
        parts = {
            n: (rms(v) if least == "rms" else greatest(v)[0]) / (before[n] or 1.0) for n, v in left.items()
        }
        some = [w * parts[n] for n, w in of.items()]
        return Solved(p.ravel(), math.hypot(*some) if least == "rms" else sum(some), bound, parts)

    def _variables(self, used: Mapping[str, float]) -> tuple[Array, list[tuple[Array, Array]]]:
        """Mass numbers as a linear map (4 W, n) of the numbers that matter, and the cones (G, h) these are in."""
        squares = np.concatenate([(f * self.columns[n]) ** 2 for n, f in used.items()], axis=1)
        effect = np.sqrt(squares.sum(axis=1).mean(axis=0))
        columns: list[Array] = []
        bounds: list[tuple[int, Counterweight, list[int]]] = []
        for k, (link, w) in enumerate(self.weights):
            radius = w.radius or 1.0
            mine = effect[4 * k : 4 * k + 4] * np.array([1.0, radius, radius, radius**2])
            matter = [bool(e > NOTHING * max(mine.max(), 1e-300)) for e in mine]
            kept = [0] if w.place else [j for j in range(4) if j in (1, 2) or matter[j]]
            kept = [j for j in kept if w.span(j) is None or tuple(w.span(j) or ()) != NONE]
            if not w.place and {0, 3} & {*kept} and (w.mass is None or w.disc is not None):
                raise ModelError(
                    f"counterweight on {link}: its mass and inertia matter here, and its mass has no bound",
                    "give radius and mass" + (" in place of the disc" if w.disc else ""),
                )
            bounds.append((len(columns), w, kept))
            for j in kept:
                column = np.zeros(4 * len(self.weights))
                place = w.place or (0.0, 0.0)
                part = np.array([1.0, *place, math.hypot(*place) ** 2]) if w.place else np.eye(4)[j]
                column[4 * k : 4 * k + 4] = part
                columns.append(column)
        maps = np.stack(columns, axis=1)
        cones = [cone for start, w, kept in bounds for cone in _cones(maps.shape[1], start, w, kept)]
        return maps, cones

    def _least_squares(
        self, y: dict[str, Array], C: dict[str, Array], cones: list[tuple[Array, Array]]
    ) -> tuple[Array, float]:
        """Without bounds by a factorisation, whose residual is at right angles to all columns; else by cones."""
        count = math.sqrt(len(next(iter(y.values()))))
        right = np.concatenate([v.ravel() for v in y.values()]) / count
        left = np.concatenate([c.reshape(-1, c.shape[-1]) for c in C.values()]) / count
        x = np.linalg.lstsq(left, -right, rcond=1e-13)[0]
        rest = right + left @ x
        if all(h[0] + g[0] @ -x >= np.linalg.norm(h[1:] - g[1:] @ x) for g, h in cones):
            size = float(np.linalg.norm(rest))
            off = float(np.abs(left.T @ rest).max(initial=0.0)) * float(np.abs(x).sum())
            return x, max(0.0, size - off / size) if size else 0.0
        q, r_ = np.linalg.qr(np.column_stack([left, right]))
        del q
        n = len(x)
        g = np.zeros((len(r_) + 1, n + 1))
        g[0, n], g[1:, :n] = -1.0, -r_[:, :n]
        return _programme(n, [(g, np.concatenate([[0.0], r_[:, n]]))], cones, 1)


def _least_peak(
    y: dict[str, Array], C: dict[str, Array], cones: list[tuple[Array, Array]]
) -> tuple[Array, float]:
    """|y_k + C_k x| <= t of each quantity, the sum of the t least."""
    n, some = next(iter(C.values())).shape[-1], []
    for q, (values, c) in enumerate(zip(y.values(), C.values(), strict=True)):
        for v, part in zip(values, c, strict=True):
            g = np.zeros((len(v) + 1, n + len(y)))
            g[0, n + q], g[1:, :n] = -1.0, -part
            some.append((g, np.concatenate([[0.0], v])))
    return _programme(n, some, cones, len(y))


def _programme(
    n: int, goals: list[tuple[Array, Array]], cones: list[tuple[Array, Array]], extra: int
) -> tuple[Array, float]:
    """Least sum of the extra variables; all cones padded to one dimension."""
    every = [*goals, *((np.column_stack([g, np.zeros((len(g), extra))]), h) for g, h in cones)]
    d = max(len(h) for _, h in every)
    G, h = np.zeros((len(every), d, n + extra)), np.zeros((len(every), d))
    for k, (g, right) in enumerate(every):
        G[k, : len(g)], h[k, : len(g)] = g, right
    cost = np.concatenate([np.zeros(n), np.ones(extra)])
    found = minimise(cost, G, h)
    if not found.gap + found.infeasible < 1e-6:
        raise AnalysisError(
            f"no best counterweights are found: the proof leaves a gap of {found.gap:.1e}; give narrower bounds"
        )
    return found.x[:n], found.dual


def _cones(n: int, start: int, w: Counterweight, kept: list[int]) -> list[tuple[Array, Array]]:
    """The bounds of one counterweight on the variables that matter, each as (G, h) with h - G x in a cone."""
    at = {j: start + k for k, j in enumerate(kept)}
    radius, mass = w.radius or 1.0, math.inf if w.mass is None else w.mass
    out: list[tuple[Array, Array]] = []

    def cone(scale: float, *rows: tuple[Mapping[int, float], float]) -> None:
        """Rows of terms and a constant, the first at least the size of the others, over a scale."""
        g, h = np.zeros((len(rows), n)), np.array([constant / scale for _, constant in rows])
        for k, (terms, _) in enumerate(rows):
            for j in terms.keys() & at.keys():
                g[k, at[j]] = -terms[j] / scale
        out.append((g, h))

    if w.place:
        most = min(mass, w.most_moment / max(math.hypot(*w.place), 1e-300))
        cone(1.0, ({0: 1.0}, 0.0))
        if math.isfinite(most):
            cone(most, ({0: -1.0}, most))
        return out
    x, y, largest = ({1: 1.0}, 0.0), ({2: 1.0}, 0.0), min(mass * radius, w.most_moment)
    if math.isfinite(largest):
        cone(largest, ({}, largest), x, y)
    for j in {1, 2} & at.keys():
        low, high = w.span(j) or (-math.inf, math.inf)
        size = max(abs(low), abs(high))
        if math.isfinite(size):
            cone(size, ({j: 1.0}, -low))
            cone(size, ({j: -1.0}, high))
    if not {0, 3} & at.keys():
        return out
    scale = mass * radius
    heavy: tuple[Mapping[int, float], float] = ({0: radius}, 0.0) if 0 in at else ({}, scale)
    if 0 in at:
        cone(scale, ({0: -radius}, scale))
        cone(scale, heavy, x, y)
    if 3 in at:  # X^2 + Y^2 <= m I and I <= R^2 m
        less = ({**heavy[0], 3: -1 / radius}, heavy[1])
        cone(scale, ({**heavy[0], 3: 1 / radius}, heavy[1]), less, ({1: 2.0}, 0.0), ({2: 2.0}, 0.0))
        cone(scale, less)
    return out


def _buildable(p: Array, w: Counterweight) -> Array:
    """Numbers of a counterweight whose mass or inertia did not matter: the lightest within the radius, or the disc."""
    mass, x, y, inertia = (float(v) for v in p)
    moment, radius = math.hypot(x, y), w.radius or 1.0
    if w.disc is not None and moment:
        size = w.disc_of(moment)
        return np.array([moment / size, x, y, 1.5 * moment * size])
    if inertia <= 0 and mass <= 0:
        return np.array([moment / radius, x, y, moment * radius])
    if mass <= 0:
        mass = max(moment**2 / inertia, inertia / radius**2)
    return np.array([mass, x, y, max(inertia, moment**2 / mass if mass > 0 else 0.0)])
