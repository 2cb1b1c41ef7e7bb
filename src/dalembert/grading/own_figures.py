"""Figures that are right with the student's earlier ones, by parts of the equations of the solution by steps.

A free body of one link, or of two that touch, gives single equations: sums along x, y (and z), moments about each
joint; all links together give the powers of a motion. A wrong figure follows if equations whose other forces are on
the sheet give it, one of these being wrong: a torque or a component by one equation, a force by the sums of one body,
in the plane also by the moments of two links. The first wrong figure is the one from which most follow. A sheet of
sizes, or with gaps, is judged as a unit: one equation of one link, violated by some amount; one figure settles it
and all others must agree.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import combinations, pairwise
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.solved.unknown_forces import cross
from dalembert.arrays import Array
from dalembert.grading.quantities import Series, component
from dalembert.grading.sheet_equations import OwnNumbers, SheetEquations, SheetRow

if TYPE_CHECKING:
    from dalembert.grading.figure import StudentValue

ACROSS = 0.05
"""Sine of the angle between two equations from which they settle a force."""


@dataclass
class OwnFigures:
    """``follows``: right with the student's figures, and by which equation; ``first``: the wrong ones from which they
    follow.

    ``numbers``: of every wrong figure that does not follow, how many independent numbers are wrong in it. ``slip``: one
    violated equation that explains a sheet of sizes or with gaps.
    """

    follows: dict[int, str] = field(default_factory=dict)
    first: dict[int, list[int]] = field(default_factory=dict)
    numbers: dict[int, int] = field(default_factory=dict)
    slip: str = ""


class OwnSheet:
    """One sheet at one position: which of its wrong figures follow from which."""

    def __init__(
        self, equations: SheetEquations, figures: Sequence[StudentValue], wrong: Sequence[int]
    ) -> None:
        self.q, self.figures, self.wrong = equations, figures, set(wrong)

    def run(self) -> OwnFigures:
        """Wrong figures in the order in which they follow; where none does, the one from which most would."""
        out = OwnFigures()
        taken = [n for n in range(len(self.figures)) if n not in self.wrong]
        left = sorted(self.wrong)
        while left:
            match = next(((n, how) for n in left if (how := self._way(n, taken))), None)
            if match is not None:
                n = match[0]
                out.follows[n] = match[1]
            else:
                chains = {n: self._chain(n, taken, left) for n in left}
                n = min(left, key=lambda n: (-len(chains[n]), self._place(n)))
                out.numbers[n] = self._numbers(n, taken)
                if chains[n]:
                    out.first[n] = chains[n]
            taken.append(n)
            left.remove(n)
        if len(self.wrong) > 1 and len(out.follows) < len(self.wrong) - 1:
            out.slip = self._slip()
        if out.slip:
            first, *rest = sorted(self.wrong, key=self._place)
            how = f"equations, all but one slip in the {out.slip}"
            out.follows, out.first, out.numbers = dict.fromkeys(rest, how), {first: rest}, {first: 1}
        return out

    def _place(self, n: int) -> int:
        of = self.q.of(self.figures[n])
        return len(self.q.order) if of is None else self.q.order[of[0]]

    def _chain(self, n: int, taken: list[int], left: list[int]) -> list[int]:
        """Figures that follow if one is taken as it is."""
        some, rest, out = [*taken, n], [m for m in left if m != n], list[int]()
        while (m := next((m for m in rest if self._way(m, some)), None)) is not None:
            some.append(m)
            rest.remove(m)
            out.append(m)
        return out

    def _numbers(self, n: int, taken: list[int]) -> int:
        """Independent wrong numbers of a figure: a force's two, less one that figures before it give."""
        of = self.q.of(self.figures[n])
        if of is None or of[2] is not None or np.linalg.matrix_rank(of[1]) < 2:
            return 1
        mine = self.q.linear(self.figures[n])
        assert mine is not None
        x = np.linalg.pinv(mine[1]) @ mine[2]
        for row, c, b, _ in self._usable(n, taken):
            if abs(float(c @ x) - b) <= 0.004 * max(float(np.abs(c * x).sum()), abs(row.known)):
                return 1
        return 2

    def _usable(self, n: int, taken: Sequence[int]) -> Iterator[tuple[SheetRow, Array, float, bool]]:
        """Equations in which nothing but a figure's unknown is open: coefficients, right side, if a wrong figure is in
        it."""
        of = self.q.of(self.figures[n])
        assert of is not None
        own, changes = self.q.stated(self.figures, taken), self.q.accelerations(self.figures, taken)
        for row in self.q.rows:
            if of[0] not in row.parts:
                continue
            value = self._others(row, of[0], own)
            if value is None:
                continue
            b, wrong = value
            for k, (link, wrench) in changes.items():
                moved = float(row.twist[link] @ wrench)
                b, wrong = b - moved, wrong or (k in self.wrong and bool(moved))
            yield row, row.parts[of[0]], b, wrong

    def _others(self, row: SheetRow, target: int, own: dict[int, OwnNumbers]) -> tuple[float, bool] | None:
        """Remainder of the other forces on the sheet for the target; None where one of them is missing."""
        b, wrong = -row.known, False
        for k, c in row.parts.items():
            if k == target:
                continue
            mine = own.get(k)
            if mine is None or np.abs(c - c @ mine.through).max() > 1e-7 * np.abs(c).max():
                return None
            b -= float(c @ mine.value)
            wrong = wrong or bool(self.wrong & set(mine.figures))
        return b, wrong

    def _way(self, n: int, taken: Sequence[int]) -> str:
        """Equation by which a figure follows from some others, at least one of them wrong; empty if it does not."""
        of, f = self.q.of(self.figures[n]), self.figures[n]
        if of is None:
            return ""
        _, matrix, part = of
        rows = list(self._usable(n, [k for k in taken if k != n]))
        rank = int(np.linalg.matrix_rank(matrix, 1e-7))
        requested = matrix["xyz".index(part)][None] if part in ("x", "y", "z") else matrix
        need = int(np.linalg.matrix_rank(requested, 1e-7))
        for row, c, b, wrong in rows if need == 1 else ():
            unit = requested[int(np.argmax(np.abs(requested).max(axis=1)))]
            factor = float(c @ unit) / float(unit @ unit)
            if not wrong or abs(factor) < 1e-12 or np.abs(c - factor * unit).max() > 1e-7 * np.abs(c).max():
                continue
            along = requested @ np.linalg.pinv(unit[None]) * (b / factor)
            if f.close.holds(_shown(f, along[:, 0], rank)):
                return row.words
        for some in self._together(rows, need) if need > 1 else ():
            x = np.linalg.lstsq(
                np.array([c for _, c, _, _ in some]), np.array([b for _, _, b, _ in some]), rcond=None
            )[0]
            if f.close.holds(_shown(f, matrix @ x, rank)):
                if some[0][0].kind == "forces":
                    return "sums of forces on " + some[0][0].words.partition(" on ")[2]
                return ", ".join(row.words for row, *_ in some)
        return ""

    def _together(
        self, rows: list[tuple[SheetRow, Array, float, bool]], need: int
    ) -> Iterator[list[tuple[SheetRow, Array, float, bool]]]:
        """Equations that settle a force: the sums of one body; in the plane the moments of two links, or of one."""
        sums: dict[tuple[int, ...], list[tuple[SheetRow, Array, float, bool]]] = {}
        for one in rows:
            if one[0].kind == "forces":
                sums.setdefault(one[0].links, []).append(one)
        for lot in sums.values():
            if len(lot) == need and any(wrong for *_, wrong in lot):
                yield lot
        if need != 2 or self.q.e.d == 3:
            return
        moments = [one for one in rows if one[0].kind == "moments" and len(one[0].links) == 1]
        for a, b in combinations(moments, 2):
            two = np.array([a[1] / np.linalg.norm(a[1]), b[1] / np.linalg.norm(b[1])])
            turned = two.shape[1] == 2 and abs(float(np.linalg.det(two))) >= ACROSS
            if a[0].links != b[0].links and (a[3] or b[3]) and turned:
                yield [a, b]

    # a sheet of sizes

    def _slip(self) -> str:
        """One equation of one link violated by an amount that one figure settles and all others confirm."""
        q, n = self.q, self.q.e.n
        every = [(k, of) for k, f in enumerate(self.figures) if (of := q.of(f)) is not None]
        if {k for k, _ in every} < self.wrong or any(k not in {m for m, _ in every} for k in self.wrong):
            return ""
        a = np.concatenate([u.columns for u in q.e.unknowns], axis=-1).reshape(len(q.e.links) * n, -1)
        scale = np.tile(q.e.scale, len(q.e.links))
        inverse = np.linalg.pinv(scale[:, None] * a) * scale
        places = np.cumsum([0, *(u.columns.shape[-1] for u in q.e.unknowns)])
        spans = [slice(*ends) for ends in pairwise(places)]
        x = np.concatenate([u.value for u in q.e.unknowns])
        for words, link, violation in self._violations():
            load = np.zeros(len(q.e.links) * n)
            load[link * n : (link + 1) * n] = violation
            change = -inverse @ load
            values = [
                (k, of[1] @ x[span], of[1] @ change[span]) for k, of in every for span in [spans[of[0]]]
            ]
            first = next(v for v in values if v[0] in self.wrong)
            if any(not np.abs(d).max() and k in self.wrong for k, _, d in values):
                continue
            for amount in _amounts(self.figures[first[0]], first[1], first[2]):
                if all(
                    self.figures[k].close.holds(_shown(self.figures[k], v + amount * d, 2))
                    for k, v, d in values
                ):
                    return words
        return ""

    def _violations(self) -> Iterator[tuple[str, int, Array]]:
        """Equation of one link and a load (n,) that violates it alone: a force through a joint, or a couple."""
        e = self.q.e
        for link, name in enumerate(e.links):
            for u in e.unknowns:
                if u.kind != "joint" or name not in u.links:
                    continue
                for axis, force in enumerate(np.eye(e.d)):
                    moment = cross(u.at, force[:, None])[:, 0]
                    yield (
                        f"sum of forces along {'xyz'[axis]} on {name}",
                        link,
                        np.concatenate([force, moment]),
                    )
            for turn in np.eye(e.n - e.d):
                yield f"moments on {name}", link, np.concatenate([np.zeros(e.d), turn])


def own_figures(equations: SheetEquations, figures: Sequence[StudentValue]) -> OwnFigures:
    """Wrong figures of a sheet that are right with the student's other figures; figures of one position."""
    judged = [n for n, f in enumerate(figures) if f.judged]
    wrong = [k for k, n in enumerate(judged) if not figures[n].met]
    if len(judged) < 2 or not wrong:
        return OwnFigures()
    value = OwnSheet(equations, [figures[n] for n in judged], wrong).run()
    return OwnFigures(
        {judged[k]: how for k, how in value.follows.items()},
        {judged[k]: [judged[m] for m in some] for k, some in value.first.items()},
        {judged[k]: count for k, count in value.numbers.items()},
        value.slip,
    )


def _shown(f: StudentValue, whole: Array, rank: int) -> Array:
    """The number that a figure is of a vector (d,) or number (1,)."""
    if len(whole) == 1:
        value = float(whole[0])
        return np.asarray(abs(value) if f.answer.component == "magnitude" and rank else value)
    kind = "force" if f.series.kind == "angle" else f.series.kind
    return np.asarray(component(Series(kind, whole[None]), f.answer.component).values[0])


def _amounts(f: StudentValue, value: Array, change: Array) -> list[float]:
    """Amounts of a violation that give a figure."""
    known = np.atleast_1d(np.asarray(f.given.value, float))
    if f.answer.component is None:
        return [float(change @ (known - value) / (change @ change))]
    if f.answer.component in ("x", "y", "z"):
        axis = "xyz".index(f.answer.component)
        return [float(known[0] - value[axis]) / float(change[axis])] if abs(change[axis]) > 0 else []
    if f.answer.component != "magnitude":
        return []
    a, b, c = float(change @ change), 2 * float(change @ value), float(value @ value) - float(known[0]) ** 2
    root = b * b - 4 * a * c
    return [] if root < 0 else [(-b + sign * math.sqrt(root)) / (2 * a) for sign in (1, -1)]
