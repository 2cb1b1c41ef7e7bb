"""A student's figures against the computed ones, and the usual mistakes that explain the differences of a sheet
together.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from dalembert.errors import NUMBERED, ModelError, errors_at
from dalembert.grading.answer_sheet import AnswerSheet
from dalembert.grading.explanation import Explanation, explain
from dalembert.grading.figure import StudentValue, figure
from dalembert.grading.file_answers import describe_answer, position_of, value_text
from dalembert.grading.own_figures import OwnFigures, own_figures
from dalembert.grading.quantities import WHOLE, WORDS
from dalembert.grading.sheet_equations import SheetEquations
from dalembert.grading.tolerance import percent
from dalembert.grading.wrong.wrong_problems import WrongProblems
from dalembert.model import ModelOrPath, as_mechanism

if TYPE_CHECKING:
    from dalembert.model import Mechanism, StatedAnswer


class Verdict(NamedTuple):
    """One figure compared: its subject, as given, as computed, relative difference, and the explanation.

    kind: ``right``; sign, unit, named (another mistake), rounding or unknown; ``open`` where nothing can be compared.
    line: its line in the file, 0 without a file. weight: of a mistake in the problem, ``concept`` or ``datum``.
    """

    quantity: str
    given: str
    computed: str
    off: float
    right: bool
    mistake: str
    kind: str = ""
    line: int = 0
    weight: str = ""


def check_answers(
    mechanism: ModelOrPath,
    answers: Sequence[StatedAnswer],
    static: bool = False,
    tolerance: str | None = None,
) -> list[Verdict]:
    """Verdicts on figures for a mechanism; ``tolerance``, `3 %`, is that of the figures that state none.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> mine = da.Answer(quantity="effort", of="O2", value="-243.2 lbf*in")
    >>> da.check_answers(da.load(examples()["four_bar"]), [mine])[0].mistake
    'the sense is opposite: action mistaken for reaction'
    """
    mechanism = as_mechanism(mechanism)
    return SolvedProblem(mechanism, static).verdicts(answers, tolerance)


class SolvedProblem:
    """A mechanism solved once, for many sheets; wrong solutions are kept with it."""

    def __init__(self, mechanism: Mechanism, static: bool = False) -> None:
        from dalembert.analysis.solution import solve

        self.result = solve(mechanism, static=static)
        self._wrong: dict[tuple[int, ...], WrongProblems] = {}
        self._equations: dict[int, SheetEquations] = {}

    def verdicts(self, answers: Sequence[StatedAnswer], tolerance: str | None = None) -> list[Verdict]:
        """Verdicts on the figures of one sheet."""
        if tolerance is not None:
            percent(tolerance)
        compared = []
        for k, answer in enumerate(answers):
            with errors_at(k):
                compared.append(self.compare(answer, tolerance))
        some = [f for f in compared if isinstance(f, StudentValue)]
        explanations = explain(some, self.wrong_problems(some), self.own_figures(some))
        numbers = iter(range(len(some)))
        return [
            f if isinstance(f, Verdict) else verdict_of(f, explanations.get(next(numbers))) for f in compared
        ]

    def verdicts_of(self, sheet: AnswerSheet, tolerance: str | None = None) -> list[Verdict]:
        """Verdicts with the lines of the sheet; ``tolerance`` replaces the sheet's."""
        try:
            verdicts = self.verdicts(sheet.answers, tolerance or sheet.tolerance)
        except ModelError as error:
            number = error.path[0] if error.path else None
            if sheet.file and not error.file and isinstance(number, int):
                raise error.at_line(sheet.file, sheet.line(number)) from None
            raise
        return [v._replace(line=sheet.line(k)) for k, v in enumerate(verdicts)]

    def compare(self, answer: StatedAnswer, tolerance: str | None = None) -> StudentValue | Verdict:
        """A figure beside what is computed, or the verdict on a word or a count."""
        r = self.result
        if answer.quantity in WHOLE:
            return verdict_on_word(answer, WHOLE[answer.quantity](r))
        if answer.quantity in WORDS:
            return verdict_on_word(answer, WORDS[answer.quantity](r, position_of(r, answer)))
        return figure(r, answer, tolerance)

    def own_figures(self, figures: Sequence[StudentValue]) -> OwnFigures:
        """Wrong figures that are right with the student's other figures, position by position."""
        out = OwnFigures()
        if self.result.schedule.unknown is not None:
            return out
        for place in sorted({f.position for f in figures}):
            here = [n for n, f in enumerate(figures) if f.position == place and not f.answer.extreme]
            some = [figures[n] for n in here]
            if self.result.status[place] not in NUMBERED or all(f.met or not f.judged for f in some):
                continue
            if place not in self._equations:
                self._equations[place] = SheetEquations(self.result, place)
            value = own_figures(self._equations[place], some)
            out.follows |= {here[k]: how for k, how in value.follows.items()}
            out.first |= {here[k]: [here[m] for m in rest] for k, rest in value.first.items()}
            out.numbers |= {here[k]: count for k, count in value.numbers.items()}
            out.slip = out.slip or value.slip
        return out

    def wrong_problems(self, some: Sequence[StudentValue]) -> WrongProblems:
        """The wrong problems at the positions that a sheet asks for."""
        r, which = self.result, tuple(sorted({f.position for f in some}))
        s = r.schedule
        standing = bool((s.speed[list(which)] == 0).all(axis=-1).any())
        every = len(which) == len(r.status) or any(f.answer.extreme for f in some) or s.unknown is not None
        key = () if every or (standing and r.status[0] != "at_rest") or not which else which
        if key not in self._wrong:
            self._wrong[key] = WrongProblems(r, key or None)
        return self._wrong[key]


def verdict_of(f: StudentValue, explanation: Explanation | None) -> Verdict:
    """The verdict on a figure, with what explains it."""
    if not f.judged:
        open_sentence = f"it cannot be judged: {f.reason}"
        return Verdict(f.words, f.written, f.computed, f.off, False, open_sentence, "open")
    mistake, kind, weight = ("", "right", "") if f.met else explanation or ("", "unknown", "")
    return Verdict(f.words, f.written, f.computed, f.off, f.met, mistake, kind, weight=weight)


def verdict_on_word(answer: StatedAnswer, right: object) -> Verdict:
    """The verdict on a word or a count."""
    answered, known = (value_text(value).strip().removesuffix(".0") for value in (answer.value, right))
    met = answered == known
    mistake = "" if met else "another count" if known.isdigit() else "another word"
    off, kind = (0.0, "right") if met else (1.0, "unknown")
    return Verdict(describe_answer(answer), answered, known, off, met, mistake, kind)
