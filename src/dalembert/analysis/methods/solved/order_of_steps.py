"""The order of the steps: which free body, which equation, which unknown next; a block where none has a single one.

Two-force links first: their directions. Then of all equations with one unknown the one of fewest links, which completes
a joint, after which a neighbour can complete it, on the link of the step before, the one that is prettier on paper.

Mechanics: docs/theory.md 7.1.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import NamedTuple

import numpy as np

from dalembert.analysis.methods.members import members
from dalembert.analysis.methods.solved.paper_equations import (
    FLAT,
    PaperEquation,
    PaperTwists,
    about_line,
    joined,
    null_space,
)
from dalembert.analysis.methods.solved.step_choice import Choice
from dalembert.analysis.methods.solved.unknown_forces import ForceEquations, cross, on_links
from dalembert.arrays import Array
from dalembert.model import GROUND

MOST_LINKS = 3
"""Links of a free body."""

MOST_JOINTS = 4
"""Unknowns of a block up to which all sets are tried; beyond them all that is left is one block."""

MOST_OPEN = 12
"""Unknowns left up to which sets of more than two are tried."""


@dataclass(frozen=True)
class SolvedNumber:
    """One solved number: ``vector`` (c,) of unknown ``of`` by an equation; ``rod``: a two-force link's direction."""

    of: int
    vector: Array
    equation: PaperEquation
    rod: bool = False


class Simultaneous(NamedTuple):
    """Unknowns that are solved together, and the equations that settle them."""

    unknowns: tuple[int, ...]
    equations: tuple[PaperEquation, ...]


class StepOrder:
    """The search: what of each unknown is still sought, and the next step."""

    def __init__(self, e: ForceEquations, choice: Choice) -> None:
        self.e, self.choice, self.twists = e, choice, PaperTwists(e, choice)
        self.sought = [np.eye(u.columns.shape[-1]) for u in e.unknowns]
        self.free_bodies = list(e.connected(min(MOST_LINKS, len(e.links))))
        self.columns = {some: on_links(e, some)[0] for some in self.free_bodies}
        self.largest = max((float(np.abs(u.columns).max(initial=0.0)) for u in e.unknowns), default=1.0)

    def run(self) -> Iterator[SolvedNumber | Simultaneous]:
        """All steps; it ends early where what is left is not unique."""
        for rod in self._rods():
            self._learn(rod.of, rod.vector)
            yield rod
        last: tuple[int, ...] = ()
        while self.open():
            next_one = self._next(last)
            if next_one is not None:
                last = next_one.equation.links
                self._learn(next_one.of, next_one.vector)
                yield next_one
                continue
            block = self._block()
            if block is None:
                return
            for k in block.unknowns:
                self.sought[k] = np.zeros((len(self.sought[k]), 0))
            yield block

    def open(self) -> list[int]:
        """Unknowns of which something is still sought."""
        return [k for k, left in enumerate(self.sought) if left.shape[1]]

    def _learn(self, k: int, vector: Array) -> None:
        """One number of unknown k becomes known: the rest is at right angles to it."""
        left = self.sought[k]
        self.sought[k] = left @ null_space(left.T @ vector[:, None], left.shape[1])

    def _parts(self, some: tuple[int, ...]) -> dict[int, Array]:
        """Scaled columns of all that is sought on a free body."""
        out = {}
        for k, columns in enumerate(self.columns[some]):
            if self.sought[k].shape[1]:
                part = self.e.scale[:, None] * (columns @ self.sought[k])
                if np.abs(part).max() > 1e-9 * max(self.largest, 1.0):
                    out[k] = part
        return out

    def _rods(self) -> Iterator[SolvedNumber]:
        """Links on which two pins act and nothing else: the moment about one gives the direction at the other."""
        e, kinds = self.e, members(self.e.r)
        if e.d == 3:
            return
        for n, name in enumerate(e.links):
            here = [k for k, u in enumerate(e.unknowns) if name in u.links]
            pins = [
                k
                for k in here
                if e.unknowns[k].kind == "joint" and np.linalg.matrix_rank(e.unknowns[k].force) == 2
            ]
            pins = [k for k in pins if e.unknowns[k].columns.shape[-1] == 2]
            loaded = np.abs(e.wrenches[n] * e.scale).max() > 1e-12 * e.largest_force
            if len(here) != 2 or len(pins) != 2 or loaded or not kinds[name].kind.startswith(("two", "zero")):
                continue
            for k, other in (pins, pins[::-1]):
                if self.sought[k].shape[1] != 2:
                    continue
                at, mine = e.unknowns[other].at, e.unknowns[other].name
                q = PaperEquation((n,), "moments", mine, about_line(at), at)
                vector = q.twist @ e.unknowns[k].columns[n]
                if np.linalg.norm(vector) > FLAT * e.length:
                    yield SolvedNumber(k, vector / np.linalg.norm(vector), q, rod=True)

    def _pure(self, k: int, vector: Array) -> bool:
        """True if a number of an unknown is of its force alone, or of its couple alone."""
        u = self.e.unknowns[k]
        end = self.e.links.index(next(n for n in reversed(u.links) if n != GROUND))
        w = u.columns[end] @ vector
        couple = (w[self.e.d :] - cross(u.at, w[: self.e.d, None])[:, 0]) / self.e.length
        sizes = float(np.linalg.norm(w[: self.e.d])), float(np.linalg.norm(couple))
        return min(sizes) <= FLAT * max(sizes)

    def _singles(self, some: tuple[int, ...]) -> Iterator[tuple[int, SolvedNumber]]:
        """Equations of a free body with one unknown number, the prettiest of each unknown with its rank."""
        parts = self._parts(some)
        for k, mine in parts.items():
            others = joined([b for j, b in parts.items() if j != k], self.e.n)
            space = null_space(others, self.e.n)
            if not space.shape[1] or np.abs(space.T @ mine).max() < FLAT * np.abs(mine).max():
                continue
            alone = not others.shape[1]
            candidates = [
                (1 - rank if alone and rank in (0, 1) else rank, q)
                for rank, q in self.twists.within(some, space)
            ]
            for rank, q in sorted(candidates, key=lambda c: c[0]):
                t = q.twist / self.e.scale
                c = t @ mine
                if np.abs(c).max() <= FLAT * np.abs(mine).max() * np.linalg.norm(t):
                    continue
                vector = self.sought[k] @ (c / np.linalg.norm(c))
                if self._pure(k, vector):
                    yield rank, SolvedNumber(k, vector, q)
                    break

    def _next(self, last: tuple[int, ...]) -> SolvedNumber | None:
        """The next step by the order of the top of this file."""
        begin = self.choice.begin
        first = [some for some in self.free_bodies if begin and self.e.links.index(begin) in some]
        first = [some for some in first if len(some) == 1] if last else first
        for lot in ([first] if first else []) + [self.free_bodies]:
            for size in range(1, MOST_LINKS + 1):
                steps = [
                    (self.sought[f.of].shape[1] != 1, some != last, rank, number, f)
                    for some in lot
                    if len(some) == size
                    for number, (rank, f) in enumerate(self._singles(some))
                ]
                if not steps:
                    continue
                if all(f[0] for f in steps):
                    keyed = [(*f[:1], not self._completed(f[4]), *f[1:]) for f in steps]
                    return min(keyed, key=lambda f: f[:-1])[-1]
                return min(steps, key=lambda f: f[:-1])[-1]
        return None

    def _completed(self, number: SolvedNumber) -> bool:
        """True if after this step a neighbour can find the rest of the unknown."""
        before = self.sought[number.of]
        self._learn(number.of, number.vector)
        links = {n for n, name in enumerate(self.e.links) if name in self.e.unknowns[number.of].links}
        other = [(n,) for n in links if (n,) != number.equation.links]
        can = any(f.of == number.of for some in other for _, f in self._singles(some))
        self.sought[number.of] = before
        return can

    def _block(self) -> Simultaneous | None:
        """The fewest numbers that simultaneous equations of free bodies determine."""
        left = self.open()
        sizes = {k: self.sought[k].shape[1] for k in left}
        parts = [(some, part) for some in self.free_bodies if (part := self._parts(some))]
        few = range(2, min(MOST_JOINTS, len(left)) + 1) if len(left) <= MOST_OPEN else range(2, 3)
        sets = [some for count in few for some in combinations(left, count) if self._touching(some)]
        for which in [*sorted(sets, key=lambda some: sum(sizes[k] for k in some)), tuple(left)]:
            equations = self._settling(which, parts, sum(sizes[k] for k in which))
            if equations:
                return Simultaneous(which, equations)
        return None

    def _touching(self, some: tuple[int, ...]) -> bool:
        """True if links lead from each of some unknowns to all others."""
        links = [set(self.e.unknowns[k].links) - {GROUND} for k in some]
        reached, rest = links[0], links[1:]
        while near := next((n for n in rest if n & reached), None):
            reached = reached | near
            rest.remove(near)
        return not rest

    def _settling(
        self, which: tuple[int, ...], parts: list[tuple[tuple[int, ...], dict[int, Array]]], count: int
    ) -> tuple[PaperEquation, ...]:
        """Equations without other unknowns that settle some; nothing where they are too few."""
        chosen, matrix = list[PaperEquation](), np.zeros((0, count))
        for some, part in parts:
            if len(chosen) == count or not set(part) & set(which):
                continue
            space = null_space(joined([b for k, b in part.items() if k not in which], self.e.n), self.e.n)
            for _, q in self.twists.within(some, space):
                t = q.twist / self.e.scale
                row = [t @ part[k] if k in part else np.zeros(self.sought[k].shape[1]) for k in which]
                new = np.concatenate([matrix, np.concatenate(row)[None]])
                if len(chosen) < count and np.linalg.matrix_rank(new, FLAT) == len(new):
                    matrix, chosen = new, [*chosen, q]
        return tuple(chosen) if len(chosen) == count else ()
