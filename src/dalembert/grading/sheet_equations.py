"""The single equations of a position that a sheet is judged by, and what a sheet says of the unknowns.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.methods.solved.carried_out import solved_forces
from dalembert.analysis.methods.solved.paper_equations import null_space
from dalembert.analysis.methods.solved.unknown_forces import ForceEquations
from dalembert.arrays import Array

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.grading.figure import StudentValue

ROUNDING = 1e-9
"""Part of an equation's largest coefficient below which one is rounding."""


class SheetRow(NamedTuple):
    """One equation: coefficients of each unknown (c,), what is known, and the twist on each link (L, n)."""

    words: str
    links: tuple[int, ...]
    kind: str
    parts: dict[int, Array]
    known: float
    twist: Array


class OwnNumbers(NamedTuple):
    """Numbers of a sheet about an unknown, the projector on what is known, and the figures they come from."""

    value: Array
    through: Array
    figures: tuple[int, ...]


class SheetEquations:
    """The equations of a position that a sheet is judged by."""

    def __init__(self, r: Result, k: int = 0) -> None:
        self.r, self.k, self.e = r, k, ForceEquations(r, k)
        self.index: dict[tuple[str, str], int] = {(u.kind, u.name): n for n, u in enumerate(self.e.unknowns)}
        steps = solved_forces(r, k).steps
        last = {f.of: s.number for s in steps for f in s.finds}
        self.order = {n: last.get(n, len(steps)) for n in range(len(self.e.unknowns))}
        self.rows = [self._row(*text) for text in self._said()]

    def _said(self) -> Iterator[tuple[str, str, tuple[int, ...], Array]]:
        e = self.e
        for some in e.connected(2):
            names = {e.links[n] for n in some}
            each = np.zeros((len(e.links), e.n))
            for axis in range(e.d):
                twist = each.copy()
                twist[list(some), axis] = 1.0
                yield "forces", f"sum of forces along {'xyz'[axis]}", some, twist
            seen: list[Array] = []
            for u in e.unknowns:
                close = any(np.allclose(u.at, at, atol=1e-9 * e.length) for at in seen)
                if u.kind != "joint" or not names & set(u.links) or close:
                    continue
                seen.append(u.at)
                for axis in range(e.n - e.d):
                    twist = each.copy()
                    turn = np.eye(e.n - e.d)[axis]
                    along = np.cross(u.at, turn) if e.d == 3 else np.array([u.at[1], -u.at[0]])
                    twist[list(some)] = np.concatenate([along, turn])
                    about = f" (axis {'xyz'[axis]})" if e.d == 3 else ""
                    yield "moments", f"moments about {u.name}{about}", some, twist
        joints = [u.columns.reshape(-1, u.columns.shape[-1]) for u in e.unknowns if u.kind == "joint"]
        scale = np.tile(e.scale, len(e.links))
        if joints:
            every = tuple(range(len(e.links)))
            for t in null_space(scale[:, None] * np.concatenate(joints, axis=1), len(scale)).T:
                yield "powers", "powers", every, (t * scale).reshape(len(e.links), e.n)

    def _row(self, kind: str, words: str, links: tuple[int, ...], twist: Array) -> SheetRow:
        total = {n: np.einsum("ln,lnc->c", twist, u.columns) for n, u in enumerate(self.e.unknowns)}
        size = max((float(np.abs(c).max(initial=0.0)) for c in total.values()), default=0.0)
        parts = {n: c for n, c in total.items() if np.abs(c).max(initial=0.0) > ROUNDING * size}
        text = "of" if kind == "powers" else "on"
        of = "all links" if kind == "powers" else " and ".join(self.e.links[n] for n in links)
        return SheetRow(
            f"{words} {text} {of}", links, kind, parts, float((twist * self.e.wrenches).sum()), twist
        )

    # figures

    def of(self, f: StudentValue) -> tuple[int, Array, str | None] | None:
        """Unknown of a figure, the matrix (k, c) of its vector or number, and the component that it is."""
        a = f.answer
        kinds = {"effort": "effort", "unknown_load": "load", "reaction": "joint"}
        n = self.index.get((kinds.get(a.quantity, ""), str(a.of)))
        if n is None or (a.quantity == "reaction" and a.axes != "ground"):
            return None
        u = self.e.unknowns[n]
        if u.kind != "joint":
            return n, np.eye(1), a.component
        i, j = u.links
        on = a.on or (j if a.by in (None, i) else i)
        return n, (1.0 if on == j else -1.0) * u.force, a.component

    def linear(self, f: StudentValue) -> tuple[int, Array, Array] | None:
        """A figure as rows (k, c) of an unknown and their values; None for sizes and directions."""
        of = self.of(f)
        if of is None or of[2] in ("magnitude", "direction"):
            return None
        n, rows, part = of
        rows = rows if part is None else rows["xyz".index(part)][None]
        return n, rows, np.atleast_1d(np.asarray(f.given.value, float))

    def stated(self, figures: Sequence[StudentValue], which: Sequence[int]) -> dict[int, OwnNumbers]:
        """Statements of some figures about the unknowns."""
        lots: dict[int, list[tuple[int, Array, Array]]] = {}
        for k in which:
            if (value := self.linear(figures[k])) is not None:
                lots.setdefault(value[0], []).append((k, value[1], value[2]))
        out = {}
        for n, lot in lots.items():
            rows, values = np.concatenate([r for _, r, _ in lot]), np.concatenate([v for _, _, v in lot])
            inverse = np.linalg.pinv(rows, 1e-9)
            out[n] = OwnNumbers(inverse @ values, inverse @ rows, tuple(k for k, _, _ in lot))
        return out

    def accelerations(
        self, figures: Sequence[StudentValue], which: Sequence[int]
    ) -> dict[int, tuple[int, Array]]:
        """Change of the wrench on a link by the student's acceleration of it: figure -> link, wrench."""
        r, k = self.r, self.k
        out: dict[int, tuple[int, Array]] = {}
        if r.mechanism.dimension == 3 or not r.inertia:
            return out
        for n in which:
            a, value = figures[n].answer, figures[n].given.value
            if a.component or a.axes != "ground" or a.of not in r.links:
                continue
            link, name = r.links.index(a.of), a.of
            if a.quantity == "acceleration":
                couple = -r.mechanism.inertia(name) * (float(value) - float(r.acceleration(name)[k]))
                out[n] = link, np.array([0.0, 0.0, couple])
            elif a.quantity == "center_acceleration":
                force = -r.mechanism.mass(name) * (value - r.center_acceleration(name)[k])
                at = r.center(name)[k]
                out[n] = link, np.array([*force, at[0] * force[1] - at[1] * force[0]])
        return out
