"""Equations of a free body that have one unknown: test twists in the null space of all other unknowns.

A test twist t = (u, m) of a free body makes an equation of its wrenches: a sum of forces along u, or of moments about a
point or line. The twists for which no other unknown has a part are a null space; in it the ones that are written on
paper are looked for first: moments about a joint, sums along the axes, along an oblique line, moments about a meeting
point.

Mechanics: docs/theory.md 7.1.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from dalembert.analysis.methods.solved.step_choice import Choice
from dalembert.analysis.methods.solved.unknown_forces import ForceEquations
from dalembert.arrays import Array

FLAT = 1e-7
"""Relative size below which a coefficient is rounding."""


@dataclass(frozen=True)
class PaperEquation:
    """Equation of a free body of some links: its twist (n,) about the origin, and its name.

    ``kind``: `forces` along ``direction``; `moments` about ``point`` (in space about the line along ``direction``);
    `screw` both at once. ``name``: the joint that the point is, the axis, or the two joints of a line.
    """

    links: tuple[int, ...]
    kind: Literal["forces", "moments", "screw"]
    name: str
    twist: Array
    point: Array | None = None
    direction: Array | None = None


def null_space(a: Array, size: int) -> Array:
    """Orthonormal columns (size, k) at right angles to all columns of a (size, j)."""
    if not a.shape[1]:
        return np.eye(size)
    left, s, _ = np.linalg.svd(a, full_matrices=True)
    return np.asarray(left[:, int((s > FLAT * (s.max() or 1.0)).sum()) :])


def about_line(point: Array, axis: Array | None = None) -> Array:
    """Twist of moments about a point (plane) or a line (space)."""
    if axis is None:
        return np.array([point[1], -point[0], 1.0])
    return np.concatenate([np.cross(point, axis), axis])


class PaperTwists:
    """The equations that are written on paper, for each free body of a machine."""

    def __init__(self, e: ForceEquations, choice: Choice) -> None:
        self.e, self.choice = e, choice
        c, s = np.cos(choice.along), np.sin(choice.along)
        turned = choice.along != 0 and e.d == 2
        self.axes = np.array([[c, s], [-s, c]]) if turned else np.eye(e.d)
        self.letters = ("x'", "y'") if turned else ("x", "y", "z")[: e.d]
        self.kept: dict[tuple[int, ...], list[tuple[int, PaperEquation]]] = {}

    def usual(self, links: tuple[int, ...]) -> list[tuple[int, PaperEquation]]:
        """Moments about joints and sums along axes, each with its rank."""
        if links not in self.kept:
            self.kept[links] = [*self._chosen(links), *self._moments(links), *self._sums(links)]
        return self.kept[links]

    def _chosen(self, links: tuple[int, ...]) -> Iterator[tuple[int, PaperEquation]]:
        about = self.choice.about
        if isinstance(about, str):
            if about and self._touches(links, about):
                yield from ((-1, q) for q in self._about(links, about, self.e.place_of(about)))
        else:
            point = np.asarray(about)
            yield from ((-1, q) for q in self._about(links, "", point))

    def _touches(self, links: tuple[int, ...], joint: str) -> bool:
        names = {self.e.links[n] for n in links}
        return any(u.name == joint and names & set(u.links) for u in self.e.unknowns if u.kind == "joint")

    def _about(self, links: tuple[int, ...], name: str, at: Array) -> Iterator[PaperEquation]:
        if self.e.d == 2:
            yield PaperEquation(links, "moments", name, about_line(at), at)
            return
        for letter, axis in zip(self.letters, self.axes, strict=True):
            yield PaperEquation(links, "moments", f"{name} {letter}", about_line(at, axis), at, axis)

    def _moments(self, links: tuple[int, ...]) -> Iterator[tuple[int, PaperEquation]]:
        places: list[tuple[str, Array]] = []
        for u in self.e.unknowns:
            if u.kind != "joint" or not self._touches(links, u.name):
                continue
            if not any(np.allclose(u.at, at, atol=1e-9 * self.e.length) for _, at in places):
                places.append((u.name, u.at))
        for name, at in places:
            yield from ((0, q) for q in self._about(links, name, at))
        if self.e.d == 3:
            for n, (a, p) in enumerate(places):
                for b, q in places[n + 1 :]:
                    axis = (q - p) / np.linalg.norm(q - p)
                    yield 0, PaperEquation(links, "moments", f"{a}{b}", about_line(p, axis), p, axis)

    def _sums(self, links: tuple[int, ...]) -> Iterator[tuple[int, PaperEquation]]:
        for letter, axis in zip(self.letters, self.axes, strict=True):
            twist = np.concatenate([axis, np.zeros(self.e.n - self.e.d)])
            yield 1, PaperEquation(links, "forces", letter, twist, direction=axis)

    def within(self, links: tuple[int, ...], space: Array) -> Iterator[tuple[int, PaperEquation]]:
        """Equations whose scaled twists lie in a space (n, k), those of paper first, then the general ones."""
        through = space @ space.T
        for rank, q in self.usual(links):
            t = q.twist / self.e.scale
            if np.linalg.norm(through @ t - t) < FLAT * np.linalg.norm(t):
                yield rank, q
        yield from self._oblique(links, space)

    def _oblique(self, links: tuple[int, ...], space: Array) -> Iterator[tuple[int, PaperEquation]]:
        d = self.e.d
        if not space.shape[1]:
            return
        turning = space[d:]
        flat = space @ null_space(turning.T, space.shape[1]) if np.abs(turning).max() > FLAT else space
        for t in flat.T:
            u = t[:d] / np.linalg.norm(t[:d])
            u = u * (np.sign(u[np.flatnonzero(np.abs(u) > FLAT)[0]]) or 1.0)
            yield (
                2,
                PaperEquation(links, "forces", "", np.concatenate([u, np.zeros(self.e.n - d)]), direction=u),
            )
        if space.shape[1] != 1 or np.abs(turning).max() <= FLAT:
            return
        t = space[:, 0] * self.e.scale
        if d == 2:
            t = t / t[2]
            yield 3, PaperEquation(links, "moments", "", t, np.array([-t[1], t[0]]))
            return
        t = t / np.linalg.norm(t[3:])
        axis, pitch = t[3:], float(t[:3] @ t[3:])
        point = np.cross(axis, t[:3])
        kind: Literal["moments", "screw"] = "screw" if abs(pitch) > FLAT * self.e.length else "moments"
        yield 3 + (kind == "screw"), PaperEquation(links, kind, "", t, point, axis)


def joined(parts: Sequence[Array], size: int) -> Array:
    """Columns of several arrays (size, .) in one."""
    return np.concatenate([np.zeros((size, 0)), *parts], axis=1)
