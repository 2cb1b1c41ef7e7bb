"""The mistakes that explain the wrong figures of a sheet, all of them together.

A mistake in the problem (a load, a mass, friction) moves many figures at once: it explains the sheet only if no right
figure would have moved with it. A slip in one value (sense, axis, unit, another joint) is of one figure. The sheet's
explanation is that of fewest mistakes, a figure that stays unexplained counting as one and a half; among equals the
likeliest of those that come nearest.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.arrays import Array, Tree
from dalembert.errors import DalembertError
from dalembert.grading.figure import StudentValue, values_of
from dalembert.grading.value_errors import Hypothesis, of_units, of_value
from dalembert.grading.wrong_problems import WrongProblem, WrongProblems

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

SMALL = 0.03
"""Relative difference up to which a figure is nearly right."""

MUCH = 5
"""Factor by which a mistake must be nearer than the right value to explain a figure that is nearly right."""

GRAPHICAL = 0.05
"""Relative difference that a drawing may have."""

UNEXPLAINED, ROUNDED = 1.5, 1.2
"""Cost of a figure that is not explained, or only nearly right, relative to that of a mistake."""

SAME = 2e-4
"""Relative difference below which explanations cannot be distinguished."""


class Explanation(NamedTuple):
    """Explanation of a wrong figure, in words and by kind: sign, unit, named, rounding, or unknown."""

    sentence: str
    kind: str


class _Slip(NamedTuple):
    off: float
    order: int
    kind: str


@dataclass
class _Option:
    """Explanations of the wrong figures together: how many mistakes, how far off at most, how likely."""

    cost: float
    off: float
    order: int
    explained: dict[int, Explanation] = field(default_factory=dict)

    @property
    def is_exact(self) -> bool:
        """True if one mistake gives all figures: no other explanation is better, but a likelier one."""
        return self.cost <= 1 and self.off <= SAME


def explain(figures: Sequence[StudentValue], problems: WrongProblems | None) -> dict[int, Explanation]:
    """Explanation of each wrong figure, by its number; without a problem only slips in the values are considered."""
    wrong = [n for n, f in enumerate(figures) if f.judged and not f.met]
    out = {n: Explanation(figures[n].impossible, "sign") for n in wrong if figures[n].impossible}
    wrong = [n for n in wrong if n not in out]
    if not wrong:
        return out
    sheet = _Sheet(figures, wrong, problems)
    return out | _best(sheet.options()).explained


def _best(options: list[_Option]) -> _Option:
    """Among the options with fewest mistakes, the likeliest that is about as near as any."""
    least = min(o.cost for o in options)
    among = [o for o in options if o.cost <= least + 1e-9]
    nearest = min(o.off for o in among)
    near = [o for o in among if o.off <= 3 * nearest + SAME]
    return min(near, key=lambda o: o.order)


class _Sheet:
    """The figures of a sheet that are wrong, and those that are not, beside wrong problems."""

    def __init__(
        self, figures: Sequence[StudentValue], wrong: list[int], problems: WrongProblems | None
    ) -> None:
        self.figures, self.wrong, self.problems = figures, wrong, problems
        self.met = [n for n, f in enumerate(figures) if f.judged and f.met]
        places = {int(k): n for n, k in enumerate(problems.which)} if problems else {0: 0}
        self.places = {n: places[f.position] for n, f in enumerate(figures) if f.judged}

    def options(self) -> list[_Option]:
        """Explanations, without a wrong problem and with each; none further where no later one can be better."""
        tried = [self._covered(None if self.problems is None else self.problems.result, {}, 0.0, 0)]
        if self.problems is None or (tried[0].order == 0 and tried[0].is_exact):
            return tried
        for problem in self.problems:
            if problem.order > tried[0].order and tried[0].is_exact:
                break
            option = self._under(problem)
            if option is not None:
                tried.append(option)
                if option.is_exact:
                    break
        return tried

    def _under(self, problem: WrongProblem) -> _Option | None:
        """The sheet as the work of one who solved a wrong problem; None if a right figure speaks against it, or no
        wrong one for it."""
        result = problem.solution()
        if result is None or not all(self.figures[n].holds(self._values(result, n)) for n in self.met):
            return None
        direct = {n: off for n in self.wrong if (off := self._away(n, self._values(result, n))) is not None}
        if not direct:
            return None
        named = dict.fromkeys(direct, Explanation(problem.sentence, "named"))
        option = self._covered(result, named, max(direct.values()), problem.order)
        option.cost += 1
        return option

    def _values(self, result: Result | None, n: int) -> tuple[Array, ...]:
        """Values of a problem for figure n; the right value without a problem."""
        if result is None:
            return self.figures[n].right
        try:
            return values_of(result, self.figures[n].answer, self.places[n])[0]
        except (DalembertError, IndexError):
            return ()

    def _away(self, n: int, values: tuple[Array, ...]) -> float | None:
        """Distance of a figure from the nearest of some values that explain it, 0 if it is one of them rounded."""
        f = self.figures[n]
        offs = [f.close.off(v) for v in values if self._explains(f, v)]
        if not offs:
            return None
        return 0.0 if any(f.close.is_rounded(v) for v in values) else min(offs)

    def _explains(self, f: StudentValue, value: Array) -> bool:
        """So many mistakes are tried that some come near any figure: one that is itself nearly right is explained only
        by a mistake that comes much nearer."""
        return f.close.off(value) <= f.off / MUCH if f.off <= SMALL else f.close.holds(value)

    def _covered(
        self, result: Result | None, named: dict[int, Explanation], off: float, order: int
    ) -> _Option:
        """Slips for the figures that are left, those first that explain most of them."""
        rest = [n for n in self.wrong if n not in named]
        slips = {n: self._slips(result, n) for n in rest}
        option = _Option(0.0, off, order, dict(named))
        while True:
            left = [n for n in rest if n not in option.explained]
            by: dict[str, list[int]] = {}
            for n in left:
                for sentence in slips[n]:
                    by.setdefault(sentence, []).append(n)
            if not by:
                break
            nearest = min(slips[n][s].off for s, some in by.items() for n in some)

            def rank(s: str, by: dict[str, list[int]] = by, nearest: float = nearest) -> tuple[float, ...]:
                worst = max(slips[n][s].off for n in by[s])
                return (-len(by[s]), worst > 3 * nearest + SAME, slips[by[s][0]][s].order, worst)

            best = min(by, key=rank)
            option.cost += 1
            for n in by[best]:
                slip = slips[n][best]
                option.explained[n] = Explanation(best, slip.kind)
                option.off, option.order = max(option.off, slip.off), max(option.order, slip.order)
        for n in left:
            option.explained[n], cost = _unexplained(self.figures[n])
            option.cost += cost
        return option

    def _slips(self, result: Result | None, n: int) -> dict[str, _Slip]:
        """Sentences that make one of a problem's values the figure, each with how near it comes."""
        out: dict[str, _Slip] = {}
        for order, h in self._hypotheses(result, n):
            if not np.isfinite(h.value).all() or (off := self._away(n, (h.value,))) is None:
                continue
            if h.sentence not in out or off < out[h.sentence].off:
                out[h.sentence] = _Slip(off, order, h.kind)
        return out

    def _hypotheses(self, result: Result | None, n: int) -> Iterator[tuple[int, Hypothesis]]:
        f = self.figures[n]
        for value in self._values(result, n):
            for h in of_value(f.series, value):
                yield 0, h
            for h in of_units(f.series, value):
                yield 4, h
        if result is None:
            return
        for change, sentence in others(result, f):
            try:
                values, _ = values_of(result, f.answer.model_copy(update=change), self.places[n])
            except (DalembertError, IndexError):
                continue
            for value in values:
                yield 2, Hypothesis(sentence, value)


def _unexplained(f: StudentValue) -> tuple[Explanation, float]:
    """Explanation of a figure that no mistake explains, and its cost."""
    if f.off <= SMALL:
        return Explanation("close: rounded too early, or a small slip", "rounding"), ROUNDED
    sentence = "none of the usual mistakes explains it"
    if f.off <= GRAPHICAL and not f.close.stated:
        sentence += f"; it is {100 * f.off:.2g} % off, which a drawing may be: state a tolerance if it is one"
    return Explanation(sentence, "unknown"), UNEXPLAINED


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
