"""Marks of a class: every figure judged, mistakes named, and carried-forward errors not penalised twice."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from dalembert.answer.answer import Worked
from dalembert.answer.column import WORD, Axes, Column, Scale, UnitChoice
from dalembert.errors import ModelError
from dalembert.grading.answer_sheet import answer_of
from dalembert.grading.explanation import explain
from dalembert.grading.figure import StudentValue
from dalembert.grading.file_answers import describe_answer
from dalembert.grading.marking.class_sheets import StudentSheet, class_sheets
from dalembert.grading.marking.follow_through import LinkEquations, follow_through
from dalembert.grading.marking.key import Asked, ExamVariant, Key, read_key
from dalembert.grading.marking.marks_tabs import FIGURE, figures, marks_parts, marks_tabs
from dalembert.grading.marking.rubric import Rubric, load_rubric
from dalembert.grading.marking.student_marks import Mark, StudentMarks, named_mistakes
from dalembert.grading.mistakes import Verdict, verdict_of
from dalembert.grading.tolerance import percent
from dalembert.progress import progress
from dalembert.wording import quote_value

if TYPE_CHECKING:
    from dalembert.answer.workbook import Tab
    from dalembert.arrays import Tree
    from dalembert.model import Mechanism, StatedAnswer
    from dalembert.printing import Part


SHOWN = 10
"""Mistakes of a class that are printed."""


@dataclass(eq=False)
class ClassMarks(Worked):
    """The marks of a class: an answer with a row a figure of every student."""

    ROWS = "rows"

    students: list[StudentMarks]
    rubric: Rubric

    def mistakes(self) -> list[tuple[str, int]]:
        """The mistakes that were named, those of most students first."""
        return named_mistakes(self.students)

    def basis(self) -> dict[str, str]:
        """Title."""
        return {"title": "Marks"}

    def scale(self, units: UnitChoice) -> Scale:
        """Marks have no unit; figures are texts with their own."""
        return Scale(None)

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Student, variant, figure, as given and as computed, outcome, marks, why, and where it stands."""
        rows = list(figures(self.students))
        for k, name in enumerate(FIGURE):
            yield Column(name, WORD, [row[k] for row in rows])

    def record(self, to: Scale) -> Tree:
        """Marks of each student, mistakes, and what could not be read."""
        totals = {s.student: {"variant": s.variant, "marks": s.total, "of": s.most} for s in self.students}
        unread = {s.student: s.problems for s in self.students if s.problems}
        return {"students": totals, "mistakes": dict(self.mistakes()), "not_read": unread}

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterator[Part]:
        """A row a student, then the mistakes of most students."""
        return marks_parts(self.students, SHOWN)

    def text(self, units: UnitChoice = "file", **choice: Any) -> str:
        """The same as the command prints it."""
        return "\n\n".join(map(str, self.contents(units)))

    def tabs(self, units: UnitChoice = "file", axes: Axes = "ground") -> Iterator[Tab]:
        """Marks, figures, mistakes, what could not be read, and the rubric."""
        return marks_tabs(self.students, self.rubric)

    def save_feedback(self, folder: str | Path, overwrite: bool = False) -> None:
        """A text of plain sentences for each student, in a folder."""
        from dalembert.grading.marking.feedback import write_feedback

        write_feedback(self.students, folder, overwrite)


def grade(
    answers: str | Path,
    key: str | Path | Mechanism | Sequence[Mapping[str, object]],
    rubric: str | Path | Rubric | None = None,
    tolerance: str | None = None,
    static: bool = False,
) -> ClassMarks:
    """Marks of a folder of sheets, or of a table, by a key: a CSV or JSON file, its rows, or a model file.

    ``tolerance``, as `3 %`, is that of figures to which the key gives none; ``static`` leaves inertia out. Raises
    ModelError where the key, the rubric or the folder is wrong; what is wrong with a sheet is a sentence of that
    student's.

    >>> import pathlib, tempfile
    >>> key = [{"quantity": "effort", "of": "O2", "value": 243.2376, "unit": "lbf*in", "marks": 4}]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = pathlib.Path(folder, "ann.yaml").write_text("efforts: {O2: -243.2}")
    ...     marks = grade(folder, key)
    >>> [(s.student, s.total, s.marks[0].outcome) for s in marks.students]
    [('ann', 2.0, 'sign')]
    """
    rules = rubric if isinstance(rubric, Rubric) else Rubric() if rubric is None else load_rubric(rubric)
    tolerance = tolerance or rules.tolerance
    if tolerance is not None:
        percent(tolerance)
    marker = _Marker(read_key(key, static), rules, tolerance)
    sheets = class_sheets(answers)
    out = []
    with progress("Marking", len(sheets)) as step:
        for k, sheet in enumerate(sheets):
            step(k, sheet.student)
            if any(sheet.student == other.student for other in sheets[:k]):
                sheet.problems.append(f"{sheet.file}:{sheet.line}: there is another sheet of {sheet.student}")
            out.append(marker.mark(sheet))
    return ClassMarks(out, rules)


class _Taken(NamedTuple):
    """A student's answer to a required figure: compared, or a sentence why it cannot be; part: not the complete
    figure."""

    asked: Asked
    given: StatedAnswer | None
    found: StudentValue | Verdict | None
    sentence: str
    part: bool
    line: int


class _Marker:
    def __init__(self, key: Key, rubric: Rubric, tolerance: str | None) -> None:
        self.key, self.rubric, self.tolerance = key, rubric, tolerance
        self.equations: dict[tuple[str, int], LinkEquations] = {}
        self.checked: set[str] = set()

    def mark(self, sheet: StudentSheet) -> StudentMarks:
        """The marks of one sheet."""
        out = StudentMarks(sheet.student, sheet.variant, sheet.file, problems=list(sheet.problems))
        try:
            variant = self.key.variant(sheet.variant, sheet.student)
        except ModelError as error:
            here = error.at_line(sheet.file, sheet.line)
            out.problems += [] if sheet.problems and not sheet.figures else [str(here)]
            return out
        out.variant = variant.name
        if variant.name not in self.checked:
            variant.check(self.key.file)
            self.checked.add(variant.name)
        taken, unused = self._taken(sheet, variant, out.problems)
        out.problems += [f"{where}: not asked" for where in unused]
        out.marks = self._marks(variant, taken)
        return out

    def _taken(
        self, sheet: StudentSheet, variant: ExamVariant, problems: list[str]
    ) -> tuple[list[_Taken], list[str]]:
        """The sheet's answers to the required figures, and its other figures."""
        read: list[tuple[StatedAnswer | None, str]] = []
        for one in sheet.figures:
            try:
                read.append((answer_of(one.keys), ""))
            except ModelError as error:
                read.append((None, str(error.at_line(sheet.file, one.line))))
        used: set[int] = set()
        out = []
        for question in variant.asked:
            fits = [
                (f, n)
                for n, g in enumerate(sheet.figures)
                if (f := _fit(question.answer, g.keys)) is not None
            ]
            if not fits:
                out.append(_Taken(question, None, None, "", False, 0))
                continue
            fit, n = min(fits)
            used.add(n)
            answer, problem = read[n]
            taken = self._one(variant, question, answer, fit == 2, (sheet.file, sheet.figures[n].line))
            out.append(taken._replace(sentence=problem) if problem else taken)
        unused = []
        for n, (keys, line) in enumerate(sheet.figures):
            if n not in used and read[n][1]:
                problems.append(read[n][1])
            elif n not in used:
                unused.append(f"{sheet.file}:{line}: {keys.get('quantity')} {keys.get('of', '')}".rstrip())
        return out, unused

    def _one(
        self,
        variant: ExamVariant,
        question: Asked,
        answer: StatedAnswer | None,
        part: bool,
        where: tuple[str, int],
    ) -> _Taken:
        """An answer beside the computed value: keys that it leaves out are as required, and a student's tolerance is
        ignored."""
        if answer is None or answer.value in (None, ""):
            return _Taken(question, answer, None, "", part, where[1])
        keys = ("on", "by") if not (answer.on or answer.by) else ()
        filled = {k: getattr(question.answer, k) for k in (*keys, "at", "extreme")}
        answer = answer.model_copy(update=filled | {"tolerance": question.answer.tolerance})
        try:
            return _Taken(
                question, answer, variant.compare(question, answer, self.tolerance), "", part, where[1]
            )
        except ModelError as error:
            return _Taken(question, answer, None, str(error.at_line(*where)), part, where[1])

    def _marks(self, variant: ExamVariant, taken: list[_Taken]) -> list[Mark]:
        figures = [t.found for t in taken if isinstance(t.found, StudentValue)]
        problem = variant.problem
        explanations = explain(figures, None if problem is None else problem.wrong_problems(figures))
        follows = self._follows(variant, figures)
        paid: set[str] = set()
        out, n = [], 0
        for t in taken:
            verdict, follows_by = t.found if isinstance(t.found, Verdict) else None, ""
            if isinstance(t.found, StudentValue):
                verdict, follows_by = verdict_of(t.found, explanations.get(n)), follows.get(n, "")
                n += 1
            out.append(self._mark(t, verdict, follows_by, paid))
        return out

    def _follows(self, variant: ExamVariant, figures: list[StudentValue]) -> dict[int, str]:
        """Figures that follow from the student's, position by position."""
        problem, out = variant.problem, dict[int, str]()
        if problem is None or problem.result.compiled.contacts or problem.result.schedule.unknown is not None:
            return out
        if problem.result.compiled.forcing.separation.any():
            return out
        for place in {f.position for f in figures}:
            here = [n for n, f in enumerate(figures) if f.position == place and f.judged]
            wrong = [k for k, n in enumerate(here) if not figures[n].met]
            if len(here) < 2 or not wrong:
                continue
            if (variant.name, place) not in self.equations:
                self.equations[variant.name, place] = LinkEquations(problem.at(place))
            followers = follow_through(self.equations[variant.name, place], [figures[n] for n in here], wrong)
            out |= {here[k]: links_text for k, links_text in followers.items()}
        return out

    def _mark(self, t: _Taken, verdict: Verdict | None, followed: str, paid: set[str]) -> Mark:
        """The marks of a figure; ``paid``: the mistakes that earlier figures have lost marks for."""
        most = self.rubric.marks_of(t.asked.answer.quantity) if t.asked.marks is None else t.asked.marks
        words = describe_answer(t.asked.answer)
        if verdict is None:
            outcome = "unreadable" if t.sentence else "missing"
            sentence = t.sentence or "no answer is given"
            written = "" if t.given is None else quote_value(t.given.value)
            return Mark(
                words, written, "", outcome, sentence, most * self.rubric.shares[outcome], most, t.line
            )
        outcome, sentence = verdict.kind, verdict.mistake
        if outcome == "open":
            return Mark(words, verdict.given, "", outcome, sentence, 0.0, 0.0, t.line)
        if followed and not verdict.right:
            outcome, sentence = "follow_through", f"{followed} with your figures"
        elif sentence in paid:
            outcome = "repeated"
        elif outcome in ("named", "sign", "unit"):
            paid.add(sentence)
        share = self.rubric.share(outcome, sentence)
        if t.part:
            share *= self.rubric.shares["part"]
            sentence = "; ".join(filter(None, [sentence, "only its size"]))
        return Mark(words, verdict.given, verdict.computed, outcome, sentence, most * share, most, t.line)


def _fit(question: StatedAnswer, keys: Mapping[str, object]) -> int | None:
    """Match of a given figure with the required one: 0 the same, 1 the complete vector of which it is a component, 2
    only its size; None if it is another."""
    if keys.get("quantity") != question.quantity or (keys.get("of") or None) != question.of:
        return None
    for name in ("at", "extreme"):
        if keys.get(name) is not None and str(keys[name]) != str(getattr(question, name)):
            return None
    component = keys.get("component")
    if component == question.component:
        return 0
    return 1 if component is None else 2 if question.component is None and component == "magnitude" else None
