"""Explanation of the wrong figures of a sheet, given only where chance does not explain them as well.

A mistake in the problem (a load, a mass, a length) moves many figures at once, and none that is right. A slip in one
value (sense, axis, unit, another joint) is of one figure. So many mistakes are tried that some come near any number:
expected are E = N p1 p2 ... coincidences, with N the mistakes that could have moved these figures and no other, and p
the chance that a wrong number lies as near to a candidate. E decides whether a mistake is named, is said to be
possible, or is not said. A figure that follows from the student's own earlier figures needs no other explanation.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.arrays import Array, Tree
from dalembert.errors import DalembertError
from dalembert.grading.figure import StudentValue, values_of
from dalembert.grading.own_figures import OwnFigures
from dalembert.grading.value_errors import Hypothesis, of_units, of_value
from dalembert.grading.wrong.wrong_problems import WrongProblem, WrongProblems

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

SMALL = 0.03
"""Relative difference up to which a figure is nearly right."""

MUCH = 5
"""Factor by which a mistake must be nearer than the right value to explain a figure that is nearly right."""

GRAPHICAL = 0.05
"""Relative difference that a drawing may have."""

SURE, POSSIBLE = 0.01, 0.3
"""Expected coincidences up to which a mistake is named, and up to which it is said to be possible."""

ALONE = 5e-4
"""The same as ``SURE`` for a slip beside figures that nothing explains."""

FINEST = 2e-4
"""Relative width below which no figure is trusted."""

MOVED = 0.002
"""Relative difference from which a mistake moves a figure."""

SLIPS = 30
"""Slips of one value that are tried."""

NONE = "none of the usual mistakes explains it"


class Explanation(NamedTuple):
    """Explanation of a wrong figure, in words and by kind: sign, unit, named, may_be, follow_through, rounding, or
    unknown; ``weight``: that of a mistake in the problem (``WrongProblem``)."""

    sentence: str
    kind: str
    weight: str = ""


class _Slip(NamedTuple):
    """A slip of one value: in words, its kind, and the expected coincidences."""

    sentence: str
    kind: str
    chance: float


@dataclass
class _Option:
    """A mistake with the figures that it explains, and how far off each is; the slips beside it; what stays open."""

    problem: WrongProblem
    offs: dict[int, float]
    values: dict[int, Array]
    slips: dict[int, _Slip] = field(default_factory=dict)
    open: list[int] = field(default_factory=list)

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


def density(d: float) -> float:
    """Probability density of a wrong number at a relative distance d from the right one, per unit of distance: slips
    that are small are more frequent.

    >>> density(0.0) > density(0.3) > density(3.0)
    True
    """
    return 0.93 * math.exp(-((d / 0.3) ** 2) / 2) + 0.075 / (1 + d) ** 2


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
        """The mistake that explains most, if chance does not; else what follows from own figures, and slips."""
        slip_cost = len({s.sentence for s in self.slips.values()}) + 1.5 * len(
            [n for n in self.wrong if n not in self.slips and n not in self.own.follows]
        )
        found, compatible = self._options(slip_cost)
        expected = {k: self._expected(option, compatible) for k, option in enumerate(found)}
        order = sorted(expected, key=lambda k: (found[k].cost, expected[k]))
        if not order or not self._better(found[order[0]], slip_cost):
            return self._by_parts(None)
        return self._with(found[order[0]], expected[order[0]])

    def _expected(self, option: _Option, compatible: list[tuple[int, int]]) -> float:
        """Coincidences expected with mistakes at least as usual that could have moved as many figures."""
        usual = max(option.problem.order, 2)
        count = sum(1 for order, moved in compatible if order <= usual and moved >= len(option.offs))
        return max(count, 1) * self._chance(option)

    def _better(self, best: _Option, slip_cost: float) -> bool:
        """True if a mistake says more than slips, and own figures, do."""
        margin = -0.2 if self.own.follows else 1e-9
        return best.cost < slip_cost + margin or (len(best.offs) == len(self.wrong) and slip_cost >= 1)

    def _with(self, best: _Option, chance: float) -> dict[int, Explanation]:
        """The figures with a mistake that is named, or possible."""
        whole = not best.open and len(self.wrong) == len(best.offs) + len(best.slips)
        if chance <= SURE and whole:
            kind = "named"
        elif chance <= POSSIBLE and (not best.open or len(best.offs) > len(best.open)):
            kind = "may_be"
        else:
            return self._by_parts(None)
        if kind == "may_be" and (self.own.follows or self.own.slip):
            return self._by_parts(best)
        said = _said(best, kind)
        slips = {n: Explanation(s.sentence, s.kind) for n, s in best.slips.items()}
        rest = {n: Explanation(NONE, "unknown") for n in best.open}
        return dict.fromkeys(best.offs, said) | slips | rest

    def _chance(self, option: _Option) -> float:
        """Chance that so many independent wrong numbers lie where a mistake puts them."""
        each = [
            self._near(n, option.values[n], off)
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
        """Each figure by itself: a slip, right with own figures, or not explained."""
        near = all(self.figures[n].off <= SMALL for n in self.wrong)
        return {n: self._one(n, possible, near) for n in self.wrong}

    def _one(self, n: int, possible: _Option | None, near: bool) -> Explanation:
        slip, own = self.slips.get(n), self.own
        unexplained = len(self.wrong) - len(self.slips)
        if slip and slip.chance <= (SURE if unexplained <= len(self.slips) else ALONE):
            return Explanation(slip.sentence, slip.kind)
        if n in own.follows:
            return Explanation(f"right with your own figures, by the {own.follows[n]}", "follow_through")
        if possible is not None:
            return _said(possible, "may_be")
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

    def _options(self, slip_cost: float) -> tuple[list[_Option], list[tuple[int, int]]]:
        """Mistakes that explain some figure, and the order and number of moved figures of all that could have moved
        wrong ones and no right one. Those that are seldom are not tried where a usual one explains everything."""
        found: list[_Option] = []
        compatible: list[tuple[int, int]] = []
        done = 9
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
            offs = {n: off for n, some in values.items() if (off := self._away(n, some)) is not None}
            if offs:
                found.append(self._option(problem, result, offs, values))
                if len(offs) == len(self.wrong) and max(offs.values()) <= FINEST:
                    done = min(done, problem.order)
        return found, compatible

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
            slip = None if n in slips else self._slip(result, n, values[n])
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

    def _away(self, n: int, values: Sequence[Array]) -> float | None:
        """Distance of a figure from the nearest of some values that explain it, 0 if it is one of them rounded."""
        f = self.figures[n]
        offs = [
            0.0 if f.close.is_rounded(v) else f.close.off(v)
            for v in values
            if np.isfinite(v).all() and self._explains(f, v)
        ]
        return min(offs, default=None)

    def _explains(self, f: StudentValue, value: Array) -> bool:
        """One that is itself nearly right is explained only by a mistake that comes much nearer."""
        return f.close.off(value) <= f.off / MUCH if f.off <= SMALL else f.close.holds(value)

    def _near(self, n: int, value: Array, off: float) -> float:
        """Chance that a wrong number lies as near to a value as the figure does."""
        f = self.figures[n]
        right = f.right[0]
        size = float(np.linalg.norm(right)) or 1.0
        away = (
            f.close.off(value) or 0.1
            if f.series.kind == "angle"
            else float(np.linalg.norm(value - right)) / size
        )
        width = max(off, _last_digit(f), FINEST, f.close.near if f.close.stated else 0.0)
        return min(1.0, 2 * width * density(away))

    @cached_property
    def slips(self) -> dict[int, _Slip]:
        """The slip that explains a figure best, where chance does not."""
        result = None if self.problems is None else self.problems.result
        found = {n: self._slip(result, n, self.figures[n].right) for n in self.wrong}
        return {n: slip for n, slip in found.items() if slip is not None}

    def _slip(self, result: Result | None, n: int, values: Sequence[Array]) -> _Slip | None:
        best: _Slip | None = None
        for h in self._hypotheses(result, n, values):
            off = self._away(n, (h.value,))
            if off is None:
                continue
            numbers = 1 if h.single else max(h.value.size, 1)
            chance = SLIPS * self._near(n, h.value, off) ** numbers
            if chance <= POSSIBLE and (best is None or chance < best.chance):
                best = _Slip(h.sentence, h.kind, chance)
        return best

    def _hypotheses(self, result: Result | None, n: int, values: Sequence[Array]) -> Iterator[Hypothesis]:
        """Slips of a figure from some values, and values of something else."""
        f = self.figures[n]
        for value in values:
            yield from of_value(f.series, value)
            yield from of_units(f.series, value)
        if result is None:
            return
        for change, sentence in others(result, f):
            try:
                of_other, _ = values_of(result, f.answer.model_copy(update=change), self.places[n])
            except (DalembertError, IndexError):
                continue
            for value in of_other:
                if value.shape == f.right[0].shape:
                    yield Hypothesis(sentence, value)


def _said(option: _Option, kind: str) -> Explanation:
    """A mistake in the problem, named or said to be possible."""
    sentence = option.problem.sentence
    return Explanation(sentence if kind == "named" else f"may be: {sentence}", kind, option.problem.weight)


def _last_digit(f: StudentValue) -> float:
    """Half a unit of the last digit of a figure, relative."""
    size = float(np.linalg.norm(f.given.value)) or 1.0
    if f.series.kind == "angle" or not f.close.halves:
        return 0.005
    if f.given.polar:
        return max(f.close.halves[0] / size, min(f.close.halves[1], 0.01))
    return max(f.close.halves) / size


def others(result: Result, f: StudentValue) -> Iterator[tuple[Tree, str]]:
    """The right value of something else: another joint, component, or axes."""
    answer = f.answer
    if answer.quantity in ("reaction", "moment"):
        for joint in result.joints:
            if joint != answer.of:
                yield {"of": joint, "on": None, "by": None}, f"this is joint {joint}"
        for link in result.mechanism.joints[str(answer.of)].links if answer.of in result.joints else ():
            change = {"axes": "link", "on": link, "by": None}
            yield change, f"components are along and across link {link}, not ground axes"
    if answer.component in ("x", "y"):
        other = "y" if answer.component == "x" else "x"
        yield {"component": other}, "the angle is counted from the other axis: x for y"
        yield {"component": "magnitude"}, "this is the magnitude, not the component"
    if answer.quantity in ("angle", "speed", "acceleration", "center_acceleration", "center"):
        for link in result.links:
            if link != answer.of:
                yield {"of": link}, f"this is link {link}"
