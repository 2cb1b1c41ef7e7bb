"""Marks of a class: every figure judged, mistakes named, and carried-forward errors not penalised twice."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from dalembert.answer.answer import Worked
from dalembert.answer.column import WORD, Axes, Column, Scale, UnitChoice
from dalembert.errors import DalembertError, ModelError
from dalembert.grading.explanation import explain
from dalembert.grading.figure import StudentValue
from dalembert.grading.file_answers import describe_answer, position_of
from dalembert.grading.marking.by_hand import ReadFigure, check_class, decide_cells, read_figure
from dalembert.grading.marking.class_sheets import StudentSheet, class_sheets
from dalembert.grading.marking.key import Asked, ExamVariant, Key, place, read_key
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
        """Marks have no unit; figures are texts with units."""
        return Scale(None)

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Student, variant, figure, as given and as computed, outcome, marks, why, and its place."""
        rows = list(figures(self.students))
        for k, name in enumerate(FIGURE):
            yield Column(name, WORD, [row[k] for row in rows])

    def record(self, to: Scale) -> Tree:
        """Marks of each student, mistakes, and what could not be read."""
        totals = {s.student: {"variant": s.variant, "marks": s.total, "of": s.most} for s in self.students}
        unread = {s.student: s.problems for s in self.students if s.problems}
        return {"students": totals, "mistakes": dict(self.mistakes()), "not_read": unread}

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterator[Part]:
        """A row a student, the mistakes of most students, and what one mistake costs."""
        yield from marks_parts(self.students, SHOWN)
        most = max((s.most for s in self.students), default=0.0)
        yield f"One mistake costs at most {self.rubric.cap * most:.4g} of {most:.4g} marks."

    def text(self, units: UnitChoice = "file", **choice: Any) -> str:
        """The same as the command prints it."""
        return "\n\n".join(map(str, self.contents(units)))

    def tabs(self, units: UnitChoice = "file", axes: Axes = "ground") -> Iterator[Tab]:
        """Marks, figures, mistakes, what a teacher must read, and the rubric."""
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
    columns: Mapping[str, str] | None = None,
    decide: str | Path | None = None,
) -> ClassMarks:
    """Marks of a folder of sheets, or of a table, by a key: a CSV or JSON file, its rows, or a model file.

    ``tolerance``, as `3 %`, is that of figures to which the key gives none; ``static`` leaves inertia out. ``columns``
    says what headings of a table mean (`{"Response 1": "effort.O2"}`); ``decide`` is a table of student, figure and
    value for the cells that a teacher has read. Raises ModelError where the key, the rubric or the folder is wrong, or
    no figure of a class is right; what is wrong with a sheet is a sentence of that student's.

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
    sheets = class_sheets(answers, marker.key.names(), columns)
    if decide is not None:
        decide_cells(sheets, Path(decide))
    out = []
    with progress("Marking", len(sheets)) as step:
        for k, sheet in enumerate(sheets):
            step(k, sheet.student)
            if any(sheet.student == other.student for other in sheets[:k]):
                sheet.problems.append(f"{sheet.file}:{sheet.line}: there is another sheet of {sheet.student}")
            out.append(marker.mark(sheet))
    check_class(out, str(answers))
    return ClassMarks(out, rules)


class _Taken(NamedTuple):
    """A student's answer to a required figure: compared, or a sentence why it cannot be; notes: how it was read."""

    asked: Asked
    given: StatedAnswer | None
    found: StudentValue | Verdict | None
    sentence: str
    line: int
    notes: tuple[str, ...] = ()

    @property
    def part(self) -> bool:
        """True if only the size of a required vector is given."""
        known = self.asked.answer
        vector = known.value in (None, "") or isinstance(known.value, tuple) or "@" in str(known.value)
        size = self.given is not None and self.given.component == "magnitude"
        return size and vector and known.component is None


class _Marker:
    def __init__(self, key: Key, rubric: Rubric, tolerance: str | None) -> None:
        self.key, self.rubric, self.tolerance = key, rubric, tolerance
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
        out.problems += self._of_neighbour(sheet, variant, taken)
        return out

    def _of_neighbour(self, sheet: StudentSheet, variant: ExamVariant, taken: list[_Taken]) -> Iterator[str]:
        """A sentence where no figure is right and all are those of another variant."""
        known = [t for t in taken if t.given is not None and isinstance(t.found, StudentValue)]
        if len(known) < 2 or any(isinstance(t.found, StudentValue) and t.found.met for t in known):
            return
        for other in self.key.variants.values():
            if other is not variant and all(self._is_of(other, t) for t in known):
                yield f"{sheet.file}:{sheet.line}: the figures are those of variant {other.name}"

    def _is_of(self, other: ExamVariant, t: _Taken) -> bool:
        """True if a figure is that of another variant."""
        same = (
            a for a in other.asked if _fit(a.answer, {**t.asked.answer.model_dump(), "extreme": None}) == 0
        )
        question = next(same, None)
        if question is None or t.given is None:
            return False
        try:
            value = other.compare(question, t.given, self.tolerance)
        except ModelError:
            return False
        return isinstance(value, StudentValue) and value.met

    def _taken(
        self, sheet: StudentSheet, variant: ExamVariant, problems: list[str]
    ) -> tuple[list[_Taken], list[str]]:
        """The sheet's answers to the required figures, and its other figures."""
        names = self.key.names()
        read = [read_figure(one, sheet, names) for one in sheet.figures]
        given = [g.keys | {"at": _place(variant, g.keys.get("at"))} for g in sheet.figures]
        used: set[int] = set()
        out = []
        for question in variant.asked:
            asked = question.answer.model_copy(update={"at": _place(variant, question.answer.at)})
            fits = [(f, n) for n, keys in enumerate(given) if (f := _fit(asked, keys)) is not None]
            if not fits:
                out.append(_Taken(question, None, None, "", 0))
                continue
            _, n = min(fits)
            used.add(n)
            taken = self._best(variant, question, read[n], problems)
            if taken.sentence:
                problems.append(taken.sentence)
            out.append(taken)
        unused = []
        for n, one in enumerate(sheet.figures):
            if n not in used and read[n].problem:
                problems.append(read[n].problem)
            elif n not in used:
                unused.append(f"{sheet.file}:{one.line}: {one.name}")
        return out, unused

    def _best(self, variant: ExamVariant, question: Asked, read: ReadFigure, problems: list[str]) -> _Taken:
        """The reading of a figure that comes nearest to the right value; more than one is a sentence to the teacher."""
        if read.problem:
            return _Taken(question, None, None, read.problem, read.where[1])
        some = [self._one(variant, question, answer, read.where) for answer in read.answers]

        def off(k: int) -> tuple[bool, float]:
            value = some[k].found
            if not isinstance(value, StudentValue) or value.met:
                return False, 0.0
            return bool(value.impossible), value.off

        best = min(range(len(some)), key=off)
        if len(some) > 1:
            problems.append(read.choice(best))
        return some[best]._replace(notes=read.notes)

    def _one(
        self,
        variant: ExamVariant,
        question: Asked,
        answer: StatedAnswer | None,
        where: tuple[str, int],
    ) -> _Taken:
        """An answer beside the computed value: keys that it leaves out are as required, and a student's tolerance is
        ignored."""
        if answer is None or answer.value in (None, ""):
            return _Taken(question, answer, None, "", where[1])
        keys = ("on", "by") if not (answer.on or answer.by) else ()
        filled = {k: getattr(question.answer, k) for k in (*keys, "at", "extreme")}
        answer = answer.model_copy(update=filled | {"tolerance": question.answer.tolerance})
        try:
            return _Taken(question, answer, variant.compare(question, answer, self.tolerance), "", where[1])
        except ModelError as error:
            return _Taken(question, answer, None, str(error.at_line(*where)), where[1])

    def _marks(self, variant: ExamVariant, taken: list[_Taken]) -> list[Mark]:
        figures = [t.found for t in taken if isinstance(t.found, StudentValue)]
        problem = variant.problem
        wrong = (problem.wrong_problems(figures), problem.own_figures(figures)) if problem else (None, None)
        explanations = explain(figures, *wrong)
        paid: set[str] = set()
        out, n = [], 0
        for t in taken:
            verdict = t.found if isinstance(t.found, Verdict) else None
            if isinstance(t.found, StudentValue):
                verdict = verdict_of(t.found, explanations.get(n))
                n += 1
            out.append(self._mark(t, verdict, paid))
        return self.rubric.capped(out)

    def _mark(self, t: _Taken, verdict: Verdict | None, paid: set[str]) -> Mark:
        """The marks of a figure; ``paid``: the mistakes that earlier figures have lost marks for."""
        most = self.rubric.marks_of(t.asked.answer.quantity) if t.asked.marks is None else t.asked.marks
        words = describe_answer(t.asked.answer)
        if verdict is None:
            outcome, sentence = (
                ("unreadable", t.sentence) if t.sentence else ("missing", "no answer is given")
            )
            written = "" if t.given is None else quote_value(t.given.value)
            if outcome not in self.rubric.shares:
                return Mark(words, written, "", "waits", sentence, 0.0, 0.0, t.line)
            lost = most * self.rubric.shares[outcome]
            return Mark(words, written, "", outcome, sentence, lost, most, t.line)
        outcome, sentence = verdict.kind, verdict.mistake
        if outcome == "open":
            return Mark(words, verdict.given, "", outcome, sentence, 0.0, 0.0, t.line)
        if verdict.weight and outcome == "named":
            outcome = verdict.weight
        elif sentence in paid:
            outcome = "repeated"
        elif outcome in ("named", "sign", "unit"):
            paid.add(sentence)
        share = self.rubric.share(outcome, sentence)
        if t.part:
            share *= self.rubric.shares["part"]
        sentence = "; ".join(filter(None, [sentence, "only its size" if t.part else "", *t.notes]))
        return Mark(words, verdict.given, verdict.computed, outcome, sentence, most * share, most, t.line)


def _place(variant: ExamVariant, at: object) -> object:
    """The number of a position that is named by the value of a drive, if the problem has such a one."""
    at = None if at is None else place(str(at))
    if not isinstance(at, str) or variant.problem is None:
        return at
    named = variant.asked[0].answer.model_copy(update={"at": at, "extreme": None})
    try:
        return position_of(variant.problem.result, named) + 1
    except DalembertError:
        return at


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
