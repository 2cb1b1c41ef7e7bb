"""Explanation of the wrong figures of a sheet, given only where chance does not explain them as well.

A mistake in the problem (a load, a mass, a length) moves many figures at once, and none that is right. A slip in one
value (sense, axis, unit, another joint) is of one figure. So many mistakes are tried that some come near any number:
expected are E = N p1 p2 ... coincidences, with N the mistakes that could have moved these figures and no other, and p
the chance that a wrong number lies as near to a candidate. E decides whether a mistake is named, is called
possible, or is not named. A figure that follows from the student's earlier figures needs no other explanation.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import DalembertError
from dalembert.grading.figure import StudentValue, values_of
from dalembert.grading.own_figures import OwnFigures
from dalembert.grading.two_mistakes import two_mistakes
from dalembert.grading.value_slips import (
    FINEST,
    POSSIBLE,
    SMALL,
    ValueSlip,
    alike,
    coincidence,
    distance,
    slip_of,
)
from dalembert.grading.wrong.wrong_problems import WrongProblem, WrongProblems

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

GRAPHICAL = 0.05
"""Relative difference that a drawing may have."""

SURE = 0.01
"""Expected coincidences up to which a mistake is named (up to ``POSSIBLE`` it is called possible)."""

ALONE = 5e-4
"""The same as ``SURE`` for a slip beside unexplained figures."""

MOVED = 0.002
"""Relative difference from which a mistake moves a figure."""

TOGETHER = 3
"""Number of mistakes that are named together if a sheet does not distinguish them."""

ELSEWHERE = 2
"""Different slips of the kind "this is joint A" that one sheet may have: forces often coincide in a machine."""

NONE = "none of the usual mistakes explains it"


class Explanation(NamedTuple):
    """Explanation of a wrong figure, in words and by kind: sign, unit, named, may_be, follow_through, rounding, or
    unknown; ``weight``: that of a mistake in the problem (``WrongProblem``)."""

    sentence: str
    kind: str
    weight: str = ""


@dataclass
class _Option:
    """A mistake with the figures that it explains, and how far off each is; the slips beside it; what stays open;
    and other mistakes that lead to the same figures."""

    problem: WrongProblem
    offs: dict[int, float]
    values: dict[int, Array]
    slips: dict[int, ValueSlip] = field(default_factory=dict)
    open: list[int] = field(default_factory=list)
    also: list[WrongProblem] = field(default_factory=list)

    @property
    def cost(self) -> float:
        """Mistakes, a figure that stays open counting as one and a half."""
        return 1 + len({s.sentence for s in self.slips.values()}) + 1.5 * len(self.open)


def explain(
    figures: Sequence[StudentValue], problems: WrongProblems | None, own: OwnFigures | None = None
) -> dict[int, Explanation]:
    """Explanation of each wrong figure, by its number; without a problem only slips in the values are considered."""
    wrong = [n for n, f in enumerate(figures) if f.judged and not f.met]
    out = {n: Explanation(figures[n].impossible, "sign") for n in wrong if figures[n].impossible}
    wrong = [n for n in wrong if n not in out]
    return out | _Sheet(figures, wrong, problems, own).explanations() if wrong else out


class _Sheet:
    """The figures of a sheet that are wrong, and those that are not, beside wrong problems."""

    def __init__(
        self,
        figures: Sequence[StudentValue],
        wrong: list[int],
        problems: WrongProblems | None,
        own: OwnFigures | None,
    ) -> None:
        self.figures, self.wrong, self.problems = figures, wrong, problems
        self.right = [n for n, f in enumerate(figures) if f.judged and f.met]
        places = {int(k): n for n, k in enumerate(problems.which)} if problems else {0: 0}
        self.places = {n: places[f.position] for n, f in enumerate(figures) if f.judged}
        self.own = own or OwnFigures()

    def explanations(self) -> dict[int, Explanation]:
        """The mistake that explains most, if chance does not; else figures that follow from earlier ones, and slips."""
        slip_cost = len({s.sentence for s in self.slips.values()}) + 1.5 * len(
            [n for n in self.wrong if n not in self.slips and n not in self.own.follows]
        )
        options, compatible = self._options(slip_cost)
        expected = {k: self._expected(option, compatible) for k, option in enumerate(options)}
        order = sorted(expected, key=lambda k: (options[k].cost, expected[k]))
        if not order or not self._better(options[order[0]], slip_cost):
            return self._pair() or self._by_parts(None)
        best = options[order[0]]
        if best.open and (pair := self._pair()):
            return pair
        same = sorted(
            k for k in order if k == order[0] or self._same(best, options[k])
        )  # the most usual first
        best = options[same[0]]
        best.also = [options[k].problem for k in same[1:]]
        return self._with(best, expected[order[0]])

    def _pair(self) -> dict[int, Explanation]:
        """Two mistakes of the problem that explain all wrong figures, where chance does not; else nothing."""
        if self.problems is None or len(self.slips) == len(self.wrong):
            return {}
        pair = two_mistakes(
            self.figures,
            self.wrong,
            self.problems.linear(),
            lambda problem, n: self._values(problem.solution(), n),
            sum(self.own.numbers.values()),
        )
        if pair is None or pair.chance > SURE:
            return {}
        return dict.fromkeys(self.wrong, Explanation(pair.sentence, "named", pair.weight))

    def _same(self, best: _Option, other: _Option) -> bool:
        """True if the sheet does not distinguish two mistakes."""
        figures = best.offs.keys() == other.offs.keys() and best.open == other.open
        return figures and all(alike(self.figures[n], best.values[n], other.values[n]) for n in best.offs)

    def _expected(self, option: _Option, compatible: list[tuple[int, int]]) -> float:
        """Coincidences expected with mistakes at least as usual that could have moved as many figures."""
        usual = max(option.problem.order, 2)
        count = sum(1 for order, moved in compatible if order <= usual and moved >= len(option.offs))
        return max(count, 1) * self._chance(option)

    def _better(self, best: _Option, slip_cost: float) -> bool:
        """True if a mistake explains more than slips and carried-forward errors do."""
        margin = -0.2 if self.own.follows else 1e-9
        return best.cost < slip_cost + margin or (len(best.offs) == len(self.wrong) and slip_cost >= 1)

    def _with(self, best: _Option, chance: float) -> dict[int, Explanation]:
        """The figures with a mistake that is named, or possible."""
        if chance <= SURE and not best.open:
            kind = "named"
        elif chance <= POSSIBLE and (not best.open or len(best.offs) > len(best.open)):
            kind = "may_be"
        else:
            return self._by_parts(None)
        if kind == "may_be" and (self.own.follows or self.own.slip):
            return self._by_parts(best)
        text = self._alone(best, kind) or _said(best, kind)
        slips = {n: Explanation(s.sentence, s.kind) for n, s in best.slips.items()}
        rest = {n: Explanation(NONE, "unknown") for n in best.open}
        return dict.fromkeys(best.offs, text) | slips | rest

    def _alone(self, best: _Option, kind: str) -> Explanation | None:
        """A mistake beside a slip that leads to the same figure, where only one is wrong."""
        slip = self.slips.get(self.wrong[0])
        if len(self.wrong) > 1 or slip is None or slip.chance > SURE or kind != "named":
            return None
        return Explanation(f"{slip.sentence}, or {_said(best, kind).sentence}", slip.kind)

    def _chance(self, option: _Option) -> float:
        """Chance that this many independent wrong numbers lie where a mistake puts them."""
        each = [
            coincidence(self.figures[n], option.values[n], off)
            for n, off in option.offs.items()
            for _ in range(self.figures[n].right[0].size)
        ]
        return math.prod(sorted(each, reverse=True)[: max(self.independent, 1)])

    @cached_property
    def independent(self) -> int:
        """Wrong numbers that no equation joins."""
        if self.own.slip:
            return 1
        if self.own.numbers:
            return sum(self.own.numbers.values())
        alone = len(self.wrong) == 1 and self.figures[self.wrong[0]].right[0].ndim == 0
        return 1 if alone else 2

    def _by_parts(self, possible: _Option | None) -> dict[int, Explanation]:
        """Each figure by itself: a slip, carried forward, or not explained."""
        near = all(self.figures[n].off <= SMALL for n in self.wrong)
        return {n: self._one(n, possible, near) for n in self.wrong}

    def _one(self, n: int, possible: _Option | None, near: bool) -> Explanation:
        slip, own = self.slips.get(n), self.own
        if n in own.follows:
            return Explanation(f"right with your own figures, by the {own.follows[n]}", "follow_through")
        if possible is not None and n in possible.offs:
            return _said(possible, "may_be")
        if slip and self._is_sure(slip):
            return Explanation(slip.sentence, slip.kind)
        if slip and len(self.wrong) == 1:
            return Explanation(f"may be: {slip.sentence}", "may_be")
        if near:
            return Explanation("close: rounded too early, or a small slip", "rounding")
        if n in own.first:
            names = ", ".join(self.figures[m].words for m in own.first[n])
            return Explanation(f"look here first: right with it are {names}", "unknown")
        f = self.figures[n]
        drawn = f"; it is {100 * f.off:.2g} % off, which a drawing may be: state a tolerance if it is one"
        return Explanation(NONE + (drawn if f.off <= GRAPHICAL and not f.close.stated else ""), "unknown")

    def _is_sure(self, slip: ValueSlip) -> bool:
        """True if chance does not explain a slip, nor the structure of the machine."""
        unexplained = [n for n in self.wrong if n not in self.slips and n not in self.own.follows]
        elsewhere = {s.sentence for s in self.slips.values() if s.kind == "named"}
        if slip.kind == "named" and (len(elsewhere) > ELSEWHERE or self.own.follows):
            return False  # a value that is carried on is not one of another joint
        return slip.chance <= (ALONE if unexplained else SURE)

    def _options(self, slip_cost: float) -> tuple[list[_Option], list[tuple[int, int]]]:
        """Mistakes that explain some figure, and the order and number of moved figures of all that could have moved
        wrong ones and no right one. Those that are seldom are not tried where a usual one explains everything."""
        out: list[_Option] = []
        compatible: list[tuple[int, int]] = []
        done = math.inf
        for problem in sorted(self.problems or (), key=lambda p: p.order):
            if problem.order > done:
                break
            result = problem.solution()
            if result is None or not all(self.figures[n].holds(self._values(result, n)) for n in self.right):
                continue
            values = {n: self._values(result, n) for n in self.wrong}
            moved = [n for n, some in values.items() if self._moves(n, some)]
            if not moved:
                continue
            compatible.append((problem.order, len(moved)))
            offs = {
                n: off for n, some in values.items() if (off := distance(self.figures[n], some)) is not None
            }
            if offs:
                out.append(self._option(problem, result, offs, values))
                if len(offs) == len(self.wrong) and max(offs.values()) <= FINEST:
                    done = min(done, max(problem.order, 2))
        return out, compatible

    def _option(
        self,
        problem: WrongProblem,
        result: Result,
        offs: dict[int, float],
        values: Mapping[int, Sequence[Array]],
    ) -> _Option:
        """A mistake with slips of the other figures: from what is right, or from what the mistake makes of them."""
        rest = [n for n in self.wrong if n not in offs]
        slips = {n: self.slips[n] for n in rest if n in self.slips}
        for n in rest if len(offs) > len(rest) else ():
            slip = None if n in slips else self._slip(n, values[n], result)
            if slip is not None and slip.chance <= SURE:
                slips[n] = slip
        nearest = {n: min(values[n], key=self.figures[n].close.off) for n in offs}
        return _Option(problem, offs, nearest, slips, [n for n in rest if n not in slips])

    def _moves(self, n: int, values: Sequence[Array]) -> bool:
        """True if values are another figure than the right one."""
        if not values:
            return False
        f = self.figures[n]
        right = f.right[0]
        size = float(np.linalg.norm(right)) or 1.0
        least = min(float(np.linalg.norm(v - right)) for v in values)
        return f.close.stated or least > MOVED * size

    def _values(self, result: Result | None, n: int) -> tuple[Array, ...]:
        """Values of a problem for figure n; the right value without a problem."""
        if result is None:
            return self.figures[n].right
        try:
            return values_of(result, self.figures[n].answer, self.places[n])[0]
        except (DalembertError, IndexError):
            return ()

    @cached_property
    def slips(self) -> dict[int, ValueSlip]:
        """The slip that explains a figure best, where chance does not."""
        out = {n: self._slip(n, self.figures[n].right) for n in self.wrong}
        return {n: slip for n, slip in out.items() if slip is not None}

    def _slip(self, n: int, values: Sequence[Array], result: Result | None = None) -> ValueSlip | None:
        result = result or (None if self.problems is None else self.problems.result)
        return slip_of(self.figures[n], values, result, self.places[n])


def _said(option: _Option, kind: str) -> Explanation:
    """A mistake in the problem, named or called possible, with those that lead to the same figures."""
    every = [option.problem, *option.also]
    words = [*dict.fromkeys(p.sentence for p in every)]
    more = ["another mistake with the same figures"] if len(words) > TOGETHER else []
    sentence = ", or ".join([*words[:TOGETHER], *more])
    weight = min((p.weight for p in every), key=("datum", "concept").index)
    return Explanation(sentence if kind == "named" else f"may be: {sentence}", kind, weight)
