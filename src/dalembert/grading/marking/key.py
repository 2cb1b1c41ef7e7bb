"""The key of an exam: required figures of each variant, their right values, and the model file that explains wrong
ones."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from dalembert.errors import ModelError, errors_at
from dalembert.grading.answer_sheet import answer_of, without_value
from dalembert.grading.figure import StudentValue, figure_of_key
from dalembert.grading.file_answers import describe_answer, value_text
from dalembert.grading.marking.figure_names import FigureNames
from dalembert.grading.marking.table_files import KEYS, TableRow, read_table
from dalembert.grading.mistakes import SolvedProblem, Verdict, verdict_on_word
from dalembert.grading.quantities import WHOLE, WORDS
from dalembert.model.quantities.column_files import file_text
from dalembert.units import NUMBER
from dalembert.wording import closest, quote_value

if TYPE_CHECKING:
    from dalembert.model import Mechanism, StatedAnswer


@dataclass(frozen=True)
class Asked:
    """A required figure: its subject, with its right value if the key has one; its unit, marks and line."""

    answer: StatedAnswer
    unit: str = ""
    marks: float | None = None
    line: int = 0


@dataclass
class ExamVariant:
    """A variant: its required figures, and its problem, solved when it is needed; None without a model file."""

    name: str
    asked: list[Asked] = field(default_factory=list)
    load: Callable[[], Mechanism] | None = None
    static: bool = False

    @cached_property
    def problem(self) -> SolvedProblem | None:
        """The problem solved."""
        return None if self.load is None else SolvedProblem(self.load(), self.static)

    def compare(self, question: Asked, answer: StatedAnswer, tolerance: str | None) -> StudentValue | Verdict:
        """A student's figure beside the problem's, or without a problem beside the key's; bare numbers in its unit."""
        answer = answer.model_copy(update={"value": with_units(answer.value, question.unit)})
        if self.problem is not None:
            return self.problem.compare(answer, tolerance)
        if question.answer.quantity in WORDS | WHOLE:
            return verdict_on_word(answer, question.answer.value)
        return figure_of_key(answer, question.answer, tolerance)

    def check(self, file: str) -> None:
        """Raise where a value of the key cannot be read, or is not that of its problem."""
        for question in self.asked:
            if question.answer.value is None:
                continue
            with errors_at(file=file, line=question.line):
                compared = self.compare(
                    question, question.answer.model_copy(update={"tolerance": None}), None
                )
                if not (compared.met if isinstance(compared, StudentValue) else compared.right):
                    problem = f"{describe_answer(question.answer)} is {value_text(question.answer.value)} in the key"
                    raise ModelError(
                        f"{problem}, and {compared.computed} by the model file", "correct one of them"
                    )


class Key:
    """All variants by name."""

    def __init__(self, variants: Sequence[ExamVariant], file: str = "") -> None:
        self.variants, self.file = {plain(v.name): v for v in variants}, file

    @cache  # noqa: B019  (a key lives as long as its class is marked)
    def names(self) -> FigureNames:
        """Names by which figures may be written: those of the first variant's problem and of all required figures."""
        problem = next((v.problem for v in self.variants.values() if v.problem is not None), None)
        requested = [question.answer for v in self.variants.values() for question in v.asked]
        return FigureNames.of(None if problem is None else problem.result.mechanism, requested)

    def variant(self, name: str, student: str) -> ExamVariant:
        """The variant that a sheet names, that of a student's name, or the only one."""
        for label in (name, student):
            if label and plain(label) in self.variants:
                return self.variants[plain(label)]
        if len(self.variants) == 1 and not name:
            return next(iter(self.variants.values()))
        known = [v.name for v in self.variants.values()]
        if name:
            raise ModelError(f"unknown variant {name!r}", closest(name, known))
        raise ModelError("the sheet does not say its variant", f"write variant: {known[0]}")


def plain(name: str) -> str:
    """A variant's name as it is compared: case, leading zeros and what a spreadsheet adds count for nothing.

    >>> plain("07"), plain("7.0"), plain("A")
    ('7', '7', 'a')
    """
    return name.strip().removesuffix(".0").lstrip("0").lower() or "0"


def read_key(source: str | Path | Mechanism | Sequence[Mapping[str, object]], static: bool = False) -> Key:
    """The key of a CSV or JSON file or of its rows; of a model file what its answers ask, or all efforts and forces."""
    from dalembert.model import Mechanism, load

    if isinstance(source, Mechanism):
        return Key([_of_model(source, static)])
    if not isinstance(source, (str, Path)):
        return _of_rows(
            [TableRow(k + 1, _cells(row)) for k, row in enumerate(source)], Path(), "the key", static
        )
    path = Path(source)
    if path.suffix.lower() == ".csv":
        return _of_rows(read_table(path), path.parent, str(path), static)
    if path.suffix.lower() == ".json":
        try:
            tree = json.loads(file_text(path))
        except (ValueError, RecursionError) as error:
            line = getattr(error, "lineno", 1)
            raise ModelError("the key is not JSON", "write a list of figures", (), str(path), line) from None
        if isinstance(tree, list):
            return _of_rows([TableRow(0, _cells(row)) for row in tree], path.parent, str(path), static)
    return Key([_of_model(load(path), static)], str(path))


def _cells(row: object) -> dict[str, str]:
    if not isinstance(row, Mapping):
        what = f"{quote_value(row)} is not a figure of the key"
        raise ModelError(what, "write its quantity")
    return {str(k): str(v) for k, v in row.items() if v not in (None, "")}


def _of_model(m: Mechanism, static: bool) -> ExamVariant:
    from dalembert.model import StatedAnswer

    out = ExamVariant(m.title or "", load=lambda: m, static=static)
    questions = [without_value(a) for a in m.answers]
    if not questions:
        assert out.problem is not None
        r = out.problem.result
        named = {"effort": r.drives, "unknown_load": r.unknown_loads, "reaction": r.joints}
        questions = [StatedAnswer(quantity=q, of=name) for q, names in named.items() for name in names]
    out.asked = [Asked(a) for a in questions]
    return out


def _of_rows(rows: Sequence[TableRow], folder: Path, file: str, static: bool) -> Key:
    out: dict[str, ExamVariant] = {}
    models: dict[str, str] = {}
    for row in rows:
        with errors_at(file=file, line=row.line):
            name = row.cells.get("variant", "")
            v = out.setdefault(plain(name), ExamVariant(name, static=static))
            model = row.cells.get("file", models.get(plain(name), ""))
            if model != models.setdefault(plain(name), model):
                raise ModelError(f"variant {name!r} has two files", f"it had {models[plain(name)]!r}")
            if model and v.load is None:
                v.load = _loader(folder, model)
            v.asked.append(_question(row, bool(model)))
    return Key(list(out.values()), file)


def _loader(folder: Path, model: str) -> Callable[[], Mechanism]:
    """Reads a model file inside the key's folder."""
    from dalembert.model import load

    path = folder / model
    if Path(model).is_absolute() or not path.resolve().is_relative_to(folder.resolve()):
        raise ModelError(f"{model!r} is outside the key's folder", "name a file inside it")
    return lambda: load(path)


def _question(row: TableRow, has_model: bool) -> Asked:
    cells = row.cells
    if "value" not in cells and not has_model:
        raise ModelError("the figure has neither a value nor a model file", "give it one of them")
    item: dict[str, object] = {k: cells[k] for k in KEYS if k in cells} | {
        "tolerance": cells.get("tolerance")
    }
    item["value"] = cell_value(cells["value"], cells.get("unit", "")) if "value" in cells else None
    item["at"] = place(cells.get("at"))
    points = cells.get("marks")
    if points is not None and not (_is_number(points) and 0 <= float(points) <= 1e6):
        raise ModelError(f"{points!r} is not a number of marks", "write a number, 0 or more")
    return Asked(answer_of(item), cells.get("unit", ""), None if points is None else float(points), row.line)


def place(text: str | None) -> object:
    """A position: its number, or a drive's value."""
    return int(text) if text and text.isascii() and text.isdigit() and len(text) < 9 else text


def _is_number(text: str) -> bool:
    try:
        return bool(np.isfinite(float(text)))
    except ValueError:
        return False


def with_units(value: object, unit: str) -> object:
    """A figure with the unit of its bare numbers: a number, `size @ direction`, or a list.

    >>> with_units("154.8 @ 220", "lbf"), with_units([1, "2 kN"], "N"), with_units("3 N", "lbf")
    ('154.8 lbf @ 220', ['1 N', '2 kN'], '3 N')
    """
    if isinstance(value, (list, tuple)):
        return [with_units(part, unit) for part in value]
    size, at, direction = str(value).partition("@")
    if not unit or re.fullmatch(NUMBER, size.strip()) is None:
        return value
    return f"{size.strip()} {unit}{' @ ' + direction.strip() if at else ''}"


def cell_value(text: str, unit: str = "") -> object:
    """A figure of a table: `[x, y]` is a list.

    >>> cell_value("[1, 2 kN]", "N")
    ['1 N', '2 kN']
    """
    text = text.strip()
    listed = text.startswith("[") and text.endswith("]")
    return with_units(re.split(r"\s*[,;]\s*", text[1:-1].strip()) if listed else text, unit)
