"""Follow-through: a wrong figure that is right for the student's earlier figures, by the equilibrium of some links.

The unknowns x of A x + w = 0 are efforts, loads and joint forces. Only the rows of some links are used, and the
student's figures, K x = k, replace the others. If these equations are consistent and determine another figure of the
sheet, that one follows. The student's accelerations of links change w. Plane and space, without friction or separating
teeth.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import state
from dalembert.arrays import Array
from dalembert.core.constraints import dense
from dalembert.core.equilibrium import balance, known_sources, reactions, statement
from dalembert.core.forcing import total_wrench
from dalembert.grading.figure import StudentValue
from dalembert.grading.quantities import Series, component

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

AGREES = 0.01
"""Relative difference that rounded figures may leave in equations that agree."""

SETTLED = 1e-6
"""Part of a figure that equations that settle it leave open."""

MANY_LINKS = 6
"""Number of links up to which all combinations are tried; of more links only pairs."""


class _Part(NamedTuple):
    """A figure as a function of the unknowns: its rows (k, X), and the student's value (k,)."""

    rows: Array
    value: Array


class LinkEquations:
    """The equations of the links of a result at its only position."""

    def __init__(self, result: Result) -> None:
        c, s = result.compiled, state(result)
        layout = c.layout
        w = total_wrench(layout, *known_sources(layout, c.forcing, s.pose, s.moving, result.inertia).values())
        w = np.broadcast_to(w, (1, *w.shape[1:]))
        stated = statement(layout, c.known, s.pose, s.rows, s.solver, w)
        one = balance(layout, c.forcing, c.known, s.pose, s.moving, s.rows, s.solver, w)
        self.result, n = result, layout.algebra.n
        self.scale = np.broadcast_to(layout.wrench_scale, (layout.links, n))
        self.a = dense(layout, stated.unknown)[0].T.reshape(layout.links, n, -1) * self.scale[..., None]
        self.w = stated.w[0] * self.scale
        count, size = layout.constraints.count, self.a.shape[-1]
        each = one._replace(constraint=np.eye(size)[:, :count])
        self.forces = np.moveaxis(reactions(layout, s.pose, s.rows, each)[0], 0, -1)  # (joints, d, X)
        self.columns = np.eye(size)[count:]
        self.drives = [
            d for d, is_unknown in zip(result.drives, c.known.requested, strict=True) if is_unknown
        ]

    def part(self, f: StudentValue) -> _Part | None:
        """A figure's rows; None where it is not a linear function of the unknowns."""
        rows = self._rows(f)
        if rows is None or f.answer.component in ("magnitude", "direction"):
            return None
        if f.answer.component:
            rows = rows["xyz".index(f.answer.component)][None]
        return _Part(rows, np.atleast_1d(f.given.value))

    def _rows(self, f: StudentValue) -> Array | None:
        """Rows of the full vector, or number, to which a figure belongs."""
        r, answer = self.result, f.answer
        if answer.quantity == "effort" and answer.of in self.drives:
            return np.asarray(self.columns[self.drives.index(answer.of)][None])
        if answer.quantity == "unknown_load":
            return np.asarray(self.columns[len(self.drives) + r.unknown_loads.index(str(answer.of))][None])
        if answer.quantity != "reaction" or answer.axes != "ground":
            return None
        i, j = r.mechanism.joints[str(answer.of)].links
        on = answer.on or (j if answer.by in (None, i) else i)
        sign = 1.0 if on == j else -1.0
        return np.asarray(sign * self.forces[r.joints.index(str(answer.of))])

    def with_accelerations(self, figures: Sequence[StudentValue]) -> Array:
        """w with the student's accelerations of links in the plane."""
        r, w = self.result, self.w.copy()
        if r.mechanism.dimension == 3 or not r.inertia:
            return np.asarray(w)
        for f in figures:
            if f.answer.component or f.answer.axes != "ground" or f.answer.of not in r.links:
                continue
            k, link = r.links.index(f.answer.of), f.answer.of
            if f.answer.quantity == "acceleration":
                change = float(f.given.value) - float(r.acceleration(link)[0])
                w[k, 2] -= r.mechanism.inertia(link) * change * self.scale[k, 2]
            elif f.answer.quantity == "center_acceleration":
                force = -r.mechanism.mass(link) * (f.given.value - r.center_acceleration(link)[0])
                arm = r.center(link)[0] - r.point_array[0, k] - r.compiled.origin
                w[k] += np.array([*force, arm[0] * force[1] - arm[1] * force[0]]) * self.scale[k]
        return np.asarray(w)

    def groups(self) -> Iterator[tuple[int, ...]]:
        """Links to take together, few first; none at all for what figures say of each other."""
        count = len(self.result.links)
        for size in range((count if count <= MANY_LINKS else 2) + 1):
            yield from combinations(range(count), size)

    def follows(
        self, f: StudentValue, others: Sequence[StudentValue], wrong: Sequence[bool]
    ) -> tuple[str, ...] | None:
        """Links whose equilibrium yields the figure from the student's earlier ones, some of them ``wrong``; None if
        none does."""
        rows = self._rows(f)
        if rows is None:
            return None
        parts = [(p, bad) for g, bad in zip(others, wrong, strict=True) if (p := self.part(g)) is not None]
        w = self.with_accelerations(others)
        moved = bool(np.abs(w - self.w).max(initial=0.0))
        known = np.concatenate([np.zeros((0, rows.shape[1])), *(p.rows for p, _ in parts)])
        values = np.concatenate([np.zeros(0), *(p.value for p, _ in parts)])
        bad = np.concatenate([np.zeros(0, bool), *(np.full(len(p.value), b) for p, b in parts)])
        for group in self.groups():
            m = np.concatenate([self.a[list(group)].reshape(-1, rows.shape[1]), known])
            b = np.concatenate([-w[list(group)].ravel(), values])
            inverse = np.linalg.pinv(m)
            through = rows @ inverse
            depends = np.abs(through[:, len(b) - len(bad) :][:, bad]).max(initial=0.0) > SETTLED
            if not (depends or (moved and group)):
                continue
            if np.abs(rows - through @ m).max() > SETTLED * np.abs(rows).max():
                continue
            x = inverse @ b
            if np.abs(m @ x - b).max() <= AGREES * np.abs(b).max() and self._is(f, rows @ x):
                return tuple(self.result.links[k] for k in group)
        return None

    def _is(self, f: StudentValue, value: Array) -> bool:
        number = f.answer.quantity != "reaction"
        computed = Series(f.series.kind, value if number else value[None])
        return f.close.holds(component(computed, f.answer.component).values[0])


def follow_through(
    equations: LinkEquations, figures: Sequence[StudentValue], wrong: Sequence[int]
) -> dict[int, str]:
    """Wrong figures that follow from others of the sheet, each with how. Of figures that follow from one another
    the error is that from which most of the others follow."""
    out: dict[int, str] = {}
    taken = [n for n in range(len(figures)) if n not in wrong]
    left = list(wrong)

    def explain(n: int, others: Sequence[int]) -> tuple[str, ...] | None:
        known = [m for m in others if m != n]
        return equations.follows(figures[n], [figures[m] for m in known], [m in wrong for m in known])

    def followers(n: int) -> int:
        return sum(explain(m, [*taken, n]) is not None for m in left if m != n)

    while left:
        next_one = next(((n, links) for n in left if (links := explain(n, taken)) is not None), None)
        if next_one is None:
            n = max(left, key=followers)
        else:
            n, links = next_one
            out[n] = f"right by the equilibrium of {' and '.join(links)}" if links else "right"
        taken.append(n)
        left.remove(n)
    return out
