"""The steps carried out: each number from its one equation and the numbers before it, never from the answer.

Mechanics: docs/theory.md 7.1.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from dalembert.analysis.methods.applied_forces import Action
from dalembert.analysis.methods.solved.order_of_steps import Simultaneous, SolvedNumber, StepOrder
from dalembert.analysis.methods.solved.paper_equations import FLAT, PaperEquation, PaperTwists, about_line
from dalembert.analysis.methods.solved.step_choice import Choice
from dalembert.analysis.methods.solved.unknown_forces import (
    ForceEquations,
    UnknownForce,
    cross,
    on_links,
    wrench_of,
)
from dalembert.arrays import Array
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

NOTHING = 1e-10
"""Part of the largest force below which a result is nothing."""


@dataclass(frozen=True)
class ForceNumber:
    """A number of an unknown: the part of its force along ``direction`` (d,), or of its couple, on its last link.

    ``mark``: `x`, `y`, `t` across the line to the moment point, `n` the rest, `` for the vector; ``value`` in SI.
    """

    of: int
    vector: Array
    step: int
    mark: str
    turning: bool
    direction: Array
    value: float


@dataclass(frozen=True)
class StepTerm:
    """A term of an equation: what acts, on which link of the free body, and what it brings to the equation (SI).

    An ``action`` is known from the start; else it is of unknown ``of``: the numbers ``numbers`` so far, the step's own
    with ``sought``. Force (d,) at a place (d,) and couple (1,) or (3,) on ``link``.
    """

    link: str
    force: Array
    at: Array
    couple: Array
    value: float
    action: Action | None = None
    of: UnknownForce | None = None
    numbers: tuple[ForceNumber, ...] = ()
    sought: bool = False


@dataclass(frozen=True)
class SolvedStep:
    """One step: the free body of ``links``, its equation, its terms with the unknown first, and what it finds.

    ``coefficient`` of the unknown in the equation; ``right``: the same number of the computed answer; ``whole`` (d,):
    the joint's force on the free body where it is complete now. ``kind``: `rod` the direction of a two-force link,
    `single` one unknown, `block` several equations together, `check` an equation that no step has used.
    """

    number: int
    kind: Literal["rod", "single", "block", "check"]
    links: tuple[str, ...]
    equations: tuple[PaperEquation, ...]
    terms: tuple[StepTerm, ...] = ()
    finds: tuple[ForceNumber, ...] = ()
    unknowns: tuple[UnknownForce, ...] = ()
    coefficient: float = 0.0
    right: tuple[float, ...] = ()
    whole: Array | None = None

    @property
    def equation(self) -> PaperEquation:
        """Its equation, the first of a block."""
        return self.equations[0]

    @property
    def gap(self) -> float:
        """Largest difference between what it finds and the answer, SI."""
        return max((abs(f.value - v) for f, v in zip(self.finds, self.right, strict=True)), default=0.0)


@dataclass
class ForceSteps:
    """The solution of a position: ``steps`` in order, the check last; ``open``: what is not unique."""

    equations: ForceEquations
    choice: Choice
    steps: list[SolvedStep] = field(default_factory=list)
    open: list[UnknownForce] = field(default_factory=list)

    @property
    def single(self) -> bool:
        """True if every number comes from an equation with one unknown, on one link each."""
        return not self.open and all(
            s.kind != "block" and (s.kind == "check" or len(s.links) == 1) for s in self.steps
        )


def solved_forces(r: Result, k: int = 0, choice: Choice | None = None) -> ForceSteps:
    """The forces of position ``k``, step by step."""
    e, choice = ForceEquations(r, k), choice or Choice()
    return _Carrier(e, choice).run()


class _Carrier:
    def __init__(self, e: ForceEquations, choice: Choice) -> None:
        self.e, self.choice = e, choice
        self.numbers: list[list[ForceNumber]] = [[] for _ in e.unknowns]
        self.out = ForceSteps(e, choice)

    def run(self) -> ForceSteps:
        order = StepOrder(self.e, self.choice)
        for one in order.run():
            self.out.steps.append(self._block(one) if isinstance(one, Simultaneous) else self._one(one))
        self.out.open = [self.e.unknowns[k] for k in order.open()]
        if not self.out.open and self.e.links:
            self.out.steps += self._check()
        return self.out

    # one number

    def _one(self, solved: SolvedNumber) -> SolvedStep:
        q, k = solved.equation, solved.of
        columns, known = on_links(self.e, q.links)
        coefficient = float(q.twist @ columns[k] @ solved.vector)
        rest = float(q.twist @ known) + self._known_part(q, columns)
        value = 0.0 if solved.rod else -rest / coefficient
        number, factor, sign = self._named(solved.of, solved.vector, value, q, coefficient)
        least = NOTHING * self.e.largest_force * (self.e.length if number.turning else 1.0)
        number = replace(number, value=0.0) if abs(number.value) < least else number
        terms = [] if solved.rod else list(self._terms(q, k))
        own = self._own(number, q.links, coefficient / factor * sign)
        self.numbers[k].append(number)
        return SolvedStep(
            len(self.out.steps) + 1,
            "rod" if solved.rod else "single",
            tuple(self.e.links[n] for n in q.links),
            (q,),
            (own, *terms),
            (number,),
            (self.e.unknowns[k],),
            coefficient / factor * sign,
            (float(solved.vector @ self.e.unknowns[k].value) * factor * sign,),
            None if solved.rod or number.turning else self._whole(k, q.links),
        )

    def _known_part(self, q: PaperEquation, columns: list[Array]) -> float:
        """Contribution of the numbers known so far to an equation."""
        return sum(
            float(q.twist @ columns[n] @ f.vector) * f.value
            for n, some in enumerate(self.numbers)
            for f in some
        )

    def _named(
        self, k: int, vector: Array, value: float, q: PaperEquation, coefficient: float
    ) -> tuple[ForceNumber, float, float]:
        """A number as a force or couple along a direction, positive as it is counted in the equation."""
        u = self.e.unknowns[k]
        force, turning = self._force(u, q.links) @ vector, False
        if np.linalg.norm(force) <= FLAT:
            end = self.e.links.index(next(n for n in reversed(u.links) if n != GROUND))
            sign = 1.0 if u.links[-1] != GROUND else -1.0
            whole = sign * u.columns[end] @ vector
            force, turning = whole[self.e.d :] - cross(u.at, whole[: self.e.d, None])[:, 0], True
        factor = float(np.linalg.norm(force)) or 1.0
        on_last = u.links[-1] in {self.e.links[n] for n in q.links} or not q.links
        sense, direction = (1.0 if on_last else -1.0), force / factor
        mark, sign = self._mark(k, direction, turning, q), float(np.sign(coefficient)) or 1.0
        if u.kind != "joint":
            sign = sense * float(np.sign(vector[0]))  # its one number, as the answer counts it
        elif mark in ("x", "y", "z"):
            sign = sense * float(np.sign(direction["xyz".index(mark)]))
        shown = ForceNumber(
            k,
            vector * sign / factor,
            len(self.out.steps) + 1,
            mark,
            turning,
            sign * direction,
            value * factor * sign,
        )
        return shown, factor, sign

    def _force(self, u: UnknownForce, links: tuple[int, ...]) -> Array:
        """Force (d, c) of an unknown on its last link; in a free body of a band's drum the opposite of that on it."""
        drum = self.e.unpaired.get(u.name, [])[:1]
        if u.kind == "joint" and drum and set(drum) & set(links):
            return -u.columns[drum[0], : self.e.d]
        return u.force

    def _mark(self, k: int, direction: Array, turning: bool, q: PaperEquation) -> str:
        """The index of a component; empty for the vector."""
        u, before = self.e.unknowns[k], [f for f in self.numbers[k] if f.turning == turning]
        rank = np.linalg.matrix_rank(u.force, FLAT) if not turning else self.e.n - self.e.d
        if (
            u.kind != "joint"
            or rank <= 1
            or (before and all(self._rod(f) for f in before) and len(before) == rank - 1)
        ):
            return ""
        taken = {f.mark for f in before}
        for letter, axis in zip(("x", "y", "z"), np.eye(self.e.d), strict=False):
            if abs(abs(direction @ axis) - 1) < FLAT and letter not in taken and "t" not in taken:
                return letter
        if self.e.d == 3:
            return "abcdef"[len(before)]
        if not before:
            return "t" if q.kind == "moments" else "u"
        return "n" if before[0].mark == "t" else "v"

    def _rod(self, f: ForceNumber) -> bool:
        return f.step <= len(self.out.steps) and self.out.steps[f.step - 1].kind == "rod"

    def _own(self, number: ForceNumber, links: tuple[int, ...], coefficient: float) -> StepTerm:
        u = self.e.unknowns[number.of]
        return replace(
            self._term(number.of, links, (number,), 0.0), value=coefficient * number.value, sought=True, of=u
        )

    def _whole(self, k: int, links: tuple[int, ...]) -> Array | None:
        """The joint's force on the free body, if all its components are known and there are several."""
        u, some = self.e.unknowns[k], tuple(f for f in self.numbers[k] if not f.turning)
        if len(some) < 2 or len(some) < np.linalg.matrix_rank(u.force, FLAT):
            return None
        return self._term(k, links, some, 0.0).force

    # terms

    def _terms(self, q: PaperEquation, sought: int = -1) -> Iterator[StepTerm]:
        """Loads, weights, inertia, then known forces, as far as they enter the equation."""
        columns, _ = on_links(self.e, q.links)
        names = {self.e.links[n] for n in q.links}
        out = [self._applied(a, q) for a in self.e.known if a.link in names]
        for k, some in enumerate(self.numbers):
            mine = [f for f in some if not (self._rod(f) and f.value == 0)]
            complete = k != sought and len(some) == self.e.unknowns[k].columns.shape[-1]
            for lot in [tuple(mine)] if complete and mine else [(f,) for f in mine]:
                value = sum(float(q.twist @ columns[k] @ f.vector) * f.value for f in lot)
                out.append(self._term(k, q.links, lot, value))
        largest = max((abs(t.value) for t in out), default=0.0)
        size = self.e.largest_force * float(np.abs(q.twist / self.e.scale).max())
        return (t for t in out if abs(t.value) > max(1e-9 * largest, NOTHING * size))

    def _applied(self, a: Action, q: PaperEquation) -> StepTerm:
        k = self.e.k
        return StepTerm(
            a.link, a.force[k], a.at[k], np.atleast_1d(a.couple[k]), float(q.twist @ wrench_of(a, k)), a
        )

    def _term(self, k: int, links: tuple[int, ...], some: tuple[ForceNumber, ...], value: float) -> StepTerm:
        """Solved numbers of an unknown as a force at its place and a couple, on the link of the free body."""
        u = self.e.unknowns[k]
        ends = [n for n in u.links if n != GROUND and self.e.links.index(n) in links]
        on = ends[-1] if ends else u.links[-1]
        x = sum((f.vector * f.value for f in some), np.zeros(u.columns.shape[-1]))
        columns, _ = on_links(self.e, links)
        w = columns[k] @ x
        force = w[: self.e.d]
        return StepTerm(
            on, force, u.at, w[self.e.d :] - cross(u.at, force[:, None])[:, 0], value, of=u, numbers=some
        )

    # several numbers

    def _block(self, block: Simultaneous) -> SolvedStep:
        """Equations solved together: what is still sought of each unknown, as one force or couple each."""
        bases = {k: self._open_basis(k) for k in block.unknowns}
        matrix, right = [], []
        for q in block.equations:
            columns, known = on_links(self.e, q.links)
            matrix.append(np.concatenate([q.twist @ columns[k] @ bases[k] for k in block.unknowns]))
            right.append(-float(q.twist @ known) - self._known_part(q, columns))
        numbers = np.linalg.lstsq(np.array(matrix), np.array(right), rcond=None)[0]
        finds, answers, place = [], [], 0
        for k in block.unknowns:
            size = bases[k].shape[1]
            for x, true in self._split(k, bases[k], bases[k] @ numbers[place : place + size]):
                finds.append(x)
                answers.append(true)
                self.numbers[k].append(x)
            place += size
        links = tuple(dict.fromkeys(self.e.links[n] for q in block.equations for n in q.links))
        unknowns = tuple(self.e.unknowns[k] for k in block.unknowns)
        return SolvedStep(
            len(self.out.steps) + 1,
            "block",
            links,
            block.equations,
            (),
            tuple(finds),
            unknowns,
            0.0,
            tuple(answers),
        )

    def _open_basis(self, k: int) -> Array:
        count = self.e.unknowns[k].columns.shape[-1]
        known = np.array([f.vector for f in self.numbers[k]]).reshape(-1, count).T
        left, s, _ = (
            np.linalg.svd(known, full_matrices=True) if known.size else (np.eye(count), np.zeros(0), None)
        )
        return np.asarray(left[:, int((s > FLAT * s.max(initial=0.0)).sum()) :])

    def _split(self, k: int, basis: Array, x: Array) -> Iterator[tuple[ForceNumber, float]]:
        """The open numbers of an unknown, those along x and y where all are open."""
        u = self.e.unknowns[k]
        vectors = list(basis.T)
        if basis.shape[1] == u.force.shape[1] and np.linalg.matrix_rank(u.force, FLAT) == basis.shape[1]:
            vectors = list(np.linalg.qr(np.linalg.pinv(u.force) @ np.eye(self.e.d)[:, : basis.shape[1]])[0].T)
        for v in vectors:
            q = PaperEquation((), "forces", "", np.zeros(self.e.n))
            number, factor, sign = self._named(k, v, float(v @ x), q, 1.0)
            yield number, float(v @ u.value) * factor * sign

    # the check

    def _check(self) -> list[SolvedStep]:
        """An equation that no step has used, with most of the numbers in it: of all links, or of the last."""
        every = tuple(range(len(self.e.links)))
        used = [(s.equation.links, s.equation.twist) for s in self.out.steps if s.equations]
        best: tuple[int, PaperEquation, tuple[StepTerm, ...]] | None = None
        for links in filter(self.e.paired, dict.fromkeys([every, *(q for q, _ in used)])):
            here = [a for a in self.e.known if self.e.d == 2 and self.e.links.index(a.link) in links]
            places = [self._about_load(links, a) for a in here]
            for q in [*(q for _, q in PaperTwists(self.e, self.choice).usual(links)), *places]:
                if any(links == some and np.allclose(q.twist, t) for some, t in used):
                    continue
                terms = tuple(self._terms(q))
                if best is None or len(terms) > best[0]:
                    best = len(terms), q, terms
            if best is not None and best[0] > 1:
                break
        if best is None or not best[0]:
            return []
        names = tuple(self.e.links[n] for n in best[1].links)
        return [SolvedStep(len(self.out.steps) + 1, "check", names, (best[1],), best[2])]

    def _about_load(self, links: tuple[int, ...], a: Action) -> PaperEquation:
        """Moments about the point where a load acts."""
        at = a.at[self.e.k]
        name = f"the mass centre of {a.link}" if a.kind in ("weight", "inertia") else f"the point of {a.of}"
        return PaperEquation(links, "moments", name, about_line(at), at)
