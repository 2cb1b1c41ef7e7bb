"""The convex problem of balancing: values y + C p of some quantities, least over cones of p.

Mechanics: docs/theory.md 10.2.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import AnalysisError, ModelError
from dalembert.machine.balance.cone_programme import minimise
from dalembert.machine.balance.counterweights import Counterweight
from dalembert.machine.balance.mass_columns import MassNumbers, numbers_of
from dalembert.machine.link_axes import in_space
from dalembert.machine.output.sizes_over_cycle import greatest, rms

NOTHING = 1e-12
"""Part of the largest effect below which a mass number has none."""


@dataclass(frozen=True)
class Solved:
    """Mass numbers (N W,), the value reached and a bound below all values, and the single quantities: all as parts of
    what they were before."""

    numbers: Array
    value: float
    bound: float
    parts: dict[str, float]


@dataclass(frozen=True)
class BalanceProblem:
    """Values (P, d) by quantity, their columns (P, d, N W), the counterweights' bounds, and the axis (3,) that each
    one's link turns about, None of several: N numbers each, 4 in the plane and 10 in space (``mass_columns``)."""

    base: dict[str, Array]
    columns: dict[str, Array]
    weights: tuple[tuple[str, Counterweight], ...]
    axes: dict[str, Array | None]

    @property
    def count(self) -> int:
        """N."""
        return int(self.columns["force"].shape[-1] // len(self.weights))

    @property
    def dimension(self) -> int:
        """Dimension of the mechanism."""
        return int(self.columns["force"].shape[1])

    def sizes(self, least: str) -> dict[str, float]:
        """Rms or greatest value of each quantity without counterweights."""
        return {name: _size(least, y) for name, y in self.base.items()}

    def predict(self, name: str, numbers: Array) -> Array:
        """Values (P, d) of a quantity with these mass numbers."""
        return np.asarray(self.base[name] + self.columns[name] @ numbers)

    def weighted(self, least: str, of: Mapping[str, float]) -> dict[str, float]:
        """The weights of what counts, that is not 0 before, so that their sum, of squares under a root or as they are,
        is 1 without counterweights."""
        before = self.sizes(least)
        used = {n: w for n, w in of.items() if w and before[n]}
        total = math.hypot(*used.values()) if least == "rms" else sum(used.values())
        return {n: w / total for n, w in used.items()}

    def part(self, least: str, of: Mapping[str, float], parts: Mapping[str, float]) -> float:
        """Remaining part of a weighted sum, relative to its value before; ``parts``: the remaining value of each
        quantity."""
        some = [w * parts[n] for n, w in self.weighted(least, of).items()]
        return math.hypot(*some) if least == "rms" else sum(some)

    def solve(self, least: str, of: Mapping[str, float]) -> Solved:
        """The least weighted sum: of squares of rms values under a root, or of greatest values."""
        before = self.sizes(least)
        used = {n: w / before[n] for n, w in self.weighted(least, of).items()}
        if not used:
            return self._solved(np.zeros(self.count * len(self.weights)), 0.0, least, of)
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
        p = numbers.reshape(len(self.weights), -1).copy()
        for k, (link, w) in enumerate(self.weights):
            if not w.place:
                body = _buildable(numbers_of(p[k]), w, self.axes[link])
                p[k] = body.vector(self.dimension)
            p[k] *= p[k][0] > NOTHING * (w.mass or 0.0)
        left = {n: self.predict(n, p.ravel()) for n in self.base}
        parts = {n: _size(least, v) / (_size(least, self.base[n]) or 1.0) for n, v in left.items()}
        return Solved(p.ravel(), self.part(least, of, parts), bound, parts)

    def _variables(self, used: Mapping[str, float]) -> tuple[Array, list[tuple[Array, Array]]]:
        """Mass numbers as a linear map (N W, n) of the numbers that matter, and the cones (G, h) these are in."""
        each = self.count
        columns = np.concatenate([f * self.columns[n] for n, f in used.items()], axis=1)
        parts = np.split(columns, len(self.weights), axis=-1)
        kept = [self._numbers(link, w, part) for (link, w), part in zip(self.weights, parts, strict=True)]
        starts = np.cumsum([0, *map(len, kept)])
        maps = np.zeros((columns.shape[-1], starts[-1]))
        for k, some in enumerate(kept):
            for j, v in enumerate(some.values(), starts[k]):
                maps[each * k : each * (k + 1), j] = v
        cones = []
        for k, (_, w) in enumerate(self.weights):
            moment = maps[each * k + 1 : each * k + 1 + self.dimension]
            cones += _cones(starts[-1], starts[k], w, [*kept[k]], moment)
        return maps, cones

    def _numbers(self, link: str, w: Counterweight, columns: Array) -> dict[str, Array]:
        """The numbers of one counterweight that matter, by kind, each as a direction (N,) of its mass numbers."""
        d, axis, radius = self.dimension, self.axes[link], w.radius or 1.0
        if w.place:
            place = in_space(w.place)
            point = MassNumbers(1.0, place, np.outer(place, place)).vector(d)
            return {"mass": point} if (columns @ point).any() else {}
        sizes = np.array([1.0, *[radius] * d, *[radius**2] * (self.count - 1 - d)])
        effect = np.sqrt(((columns * sizes) ** 2).sum(axis=1).mean(axis=0))
        least, none = NOTHING * float(effect.max()), np.zeros((3, 3))
        by_kind = {"mass": MassNumbers(1.0, none[0], none)}
        by_kind |= {f"moment {i}": MassNumbers(0.0, v, none) for i, v in enumerate(w.directions(axis))}
        spread = bool((effect[d + 1 :] > least).any())
        if spread and axis is not None:
            by_kind["inertia"] = MassNumbers(0.0, none[0], (np.eye(3) - np.outer(axis, axis)) / 2)
        scale = {"mass": 1.0, "inertia": radius**2}
        kept = {n: v.vector(d) for n, v in by_kind.items()}
        kept = {n: v for n, v in kept.items() if np.abs(columns @ v).max() * scale.get(n, radius) > least}
        where = f"counterweight on {link}: its "
        if spread and axis is None:
            remedy = "give its place: place: (x, y, z)"
            raise ModelError(
                f"{where}inertia matters here, but its link does not turn about a fixed axis", remedy
            )
        if {"mass", "inertia"} & kept.keys() and (w.mass is None or w.disc is not None):
            remedy = "give radius and mass" + (" instead of the disc" if w.disc else "")
            raise ModelError(f"{where}mass and inertia matter here, but its mass has no bound", remedy)
        return kept

    def _least_squares(
        self, y: dict[str, Array], C: dict[str, Array], cones: list[tuple[Array, Array]]
    ) -> tuple[Array, float]:
        """Without bounds by a factorisation, whose residual is at right angles to all columns; else by cones."""
        count = math.sqrt(len(next(iter(y.values()))))
        right = np.concatenate([v.ravel() for v in y.values()]) / count
        left = np.concatenate([np.concatenate(c) for c in C.values()]) / count
        x = np.linalg.lstsq(left, -right, rcond=1e-13)[0]
        rest = right + left @ x
        if all(h[0] + g[0] @ -x >= np.linalg.norm(h[1:] - g[1:] @ x) for g, h in cones):
            size = float(np.linalg.norm(rest))
            off = float(np.abs(left.T @ rest).max(initial=0.0)) * float(np.abs(x).sum())
            return x, max(0.0, size - off / size) if size else 0.0
        n, r_ = len(x), np.asarray(np.linalg.qr(np.column_stack([left, right]), mode="r"))
        g = np.zeros((len(r_) + 1, n + 1))
        g[0, n], g[1:, :n] = -1.0, -r_[:, :n]
        return _programme(n, [(g, np.concatenate([[0.0], r_[:, n]]))], cones, 1)


def _size(least: str, values: Array) -> float:
    return rms(values) if least == "rms" else greatest(values)[0]


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
    optimum = minimise(cost, G, h)
    left = optimum.gap + optimum.infeasible
    if not left < 1e-6:
        raise AnalysisError(f"optimum not proved: duality gap {left:.1e}; give narrower bounds")
    return optimum.x[:n], optimum.dual


def _cones(
    n: int, start: int, w: Counterweight, kept: Sequence[str], moment: Array
) -> list[tuple[Array, Array]]:
    """The bounds of one counterweight on the variables that matter, each as (G, h) with h - G x in a cone.

    ``kept``: kinds of its variables, from ``start``; ``moment`` (d, n): its m x, m y, m z as rows of all variables.
    """
    row = {name: np.eye(n)[start + k] for k, name in enumerate(kept)}
    radius, mass = w.radius or 1.0, math.inf if w.mass is None else w.mass
    out: list[tuple[Array, Array]] = []

    def cone(scale: float, *rows: tuple[Array | float, float]) -> None:
        """Rows of terms and a constant, the first at least the size of the others, over a scale."""
        terms = np.array([np.zeros(n) + term for term, _ in rows])
        out.append((-terms / scale, np.array([constant / scale for _, constant in rows])))

    if not kept:
        return out
    if w.place:
        most = min(mass, w.most_moment / max(math.hypot(*w.place), 1e-300))
        cone(1.0, (row["mass"], 0.0))
        if math.isfinite(most):
            cone(most, (-row["mass"], most))
        return out
    along, largest = [(m, 0.0) for m in moment], min(mass * radius, w.most_moment)
    if math.isfinite(largest):
        cone(largest, (0.0, largest), *along)
    for m, span in zip(moment, w.spans, strict=False):
        low, high = span or (-math.inf, math.inf)
        size = max(abs(low), abs(high))
        if math.isfinite(size) and m.any():
            cone(size, (m, -low))
            cone(size, (-m, high))
    if not {"mass", "inertia"} & row.keys():
        return out
    scale = mass * radius
    heavy = (radius * row["mass"], 0.0) if "mass" in row else (np.zeros(n), scale)
    if "mass" in row:
        cone(scale, (-heavy[0], scale))
        cone(scale, heavy, *along)
    if "inertia" in row:  # h^2 <= m I and I <= R^2 m
        more, less = (heavy[0] + sign * row["inertia"] / radius for sign in (1, -1))
        cone(scale, (more, heavy[1]), (less, heavy[1]), *((2 * m, 0.0) for m in moment))
        cone(scale, (less, heavy[1]))
    return out


def _buildable(p: MassNumbers, w: Counterweight, axis: Array | None) -> MassNumbers:
    """Numbers of a counterweight whose mass or inertia did not matter: the lightest within the radius, or the disc.

    What inertia it has beyond that of its centre is of two points beside it, across the axis, or of the disc.
    """
    mass, inertia, h = float(p.mass), float(np.trace(p.second)), p.moment
    moment, radius = float(np.linalg.norm(h)), w.radius or 1.0
    if w.disc is not None and moment:
        size = w.disc_of(moment)
        mass, inertia = moment / size, 1.5 * moment * size
    elif inertia <= 0 and mass <= 0:
        mass, inertia = moment / radius, moment * radius
    elif mass <= 0:
        mass = max(moment**2 / inertia, inertia / radius**2)
    if mass <= 0:
        return MassNumbers(0.0, 0 * h, np.zeros((3, 3)))
    axis = np.zeros(3) if axis is None else axis
    beside = np.linalg.svd(np.array([axis, h]))[2][-1]
    spread = (np.eye(3) - np.outer(axis, axis)) / 2 if w.disc is not None else np.outer(beside, beside)
    return MassNumbers(mass, h, np.outer(h, h) / mass + max(inertia - moment**2 / mass, 0.0) * spread)
