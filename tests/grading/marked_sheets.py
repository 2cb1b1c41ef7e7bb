"""Sheets with known mistakes: the answers of a wrong problem, or slips, rounded as a student writes them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

import dalembert as da
from dalembert.errors import DalembertError
from dalembert.grading.figure import values_of
from dalembert.grading.mistakes import SolvedProblem
from dalembert.grading.quantities import Series
from dalembert.grading.value_errors import of_units, of_value
from dalembert.grading.wrong.wrong_problems import WrongProblems

Values = dict[tuple[str, str], Any]
"""(quantity, name) -> value in SI, a number or a vector."""


class Made(NamedTuple):
    """A sheet with one mistake in it, in words."""

    mistake: str
    answers: list[da.Answer]


def rounded(value: float, digits: int) -> str:
    return f"{value:.{digits - 1}e}"


def written(value: Any, unit: str, digits: int) -> Any:
    """A number, a polar vector of the plane or components, with so many digits."""
    value = np.asarray(value, float)
    if value.ndim == 0:
        return f"{rounded(float(value), digits)} {unit}"
    if len(value) == 2:
        size, angle = math.hypot(*value), math.degrees(math.atan2(value[1], value[0]))
        return f"{rounded(size, digits)} {unit} @ {angle:.{digits - 2}f} deg"
    return [f"{rounded(float(c), digits)} {unit}" for c in value]


def asked(problem: SolvedProblem, place: int) -> list[tuple[str, str, str]]:
    """Quantity, name and unit of every effort, unknown load and joint force that has a number."""
    r = problem.result
    found = [("effort", d) for d in r.drives] + [("unknown_load", n) for n in r.unknown_loads]
    found += [("reaction", j) for j in r.joints]
    out = []
    for quantity, name in found:
        answer = da.Answer(quantity=quantity, of=name, value=0)
        values, _ = values_of(r, answer, place)
        if values:
            out.append((quantity, name, unit(problem, quantity, name)))
    return out


def unit(problem: SolvedProblem, quantity: str, name: str) -> str:
    from dalembert.analysis.result.number_kinds import drive_kinds, load_kind

    r = problem.result
    kinds = {"effort": lambda: drive_kinds(r, name)["effort"], "unknown_load": lambda: load_kind(r, name)}
    kind = kinds.get(quantity, lambda: "force")()
    return "N*m" if kind == "moment" else "N"


def answers_of(
    problem: SolvedProblem, result: Any, place: int, at: int, digits: int
) -> list[da.Answer] | None:
    """The sheet of one who has a result; None where it lacks a number."""
    out = []
    for quantity, name, units in asked(problem, place):
        answer = da.Answer(quantity=quantity, of=name, value=0, at=place + 1)
        try:
            values, _ = values_of(result, answer, at)
        except DalembertError:
            return None
        if not values:
            return None
        out.append(answer.model_copy(update={"value": written(values[0], units, digits)}))
    return out


def true_sheet(problem: SolvedProblem, place: int, digits: int) -> list[da.Answer]:
    found = answers_of(problem, problem.result, place, place, digits)
    assert found is not None
    return found


def mistaken_sheets(problem: SolvedProblem, place: int, digits: int) -> Iterator[Made]:
    """A sheet for every known mistake in the problem; none where the mistaken problem has no answer."""
    wrong = WrongProblems(problem.result, [place])
    for _, sentence, solution in wrong:
        result = solution()
        sheet = result and answers_of(problem, result, place, 0, digits)
        if sheet:
            yield Made(sentence, sheet)


def slipped_sheets(problem: SolvedProblem, place: int, digits: int) -> Iterator[Made]:
    """The true sheet with one figure of it slipped: its sense, an axis, its unit."""
    sheet = true_sheet(problem, place, digits)
    for k, (quantity, name, units) in enumerate(asked(problem, place)):
        answer = da.Answer(quantity=quantity, of=name, value=0, at=place + 1)
        values, _ = values_of(problem.result, answer, place)
        series = Series("moment" if units == "N*m" else "force", np.array(values))
        for slip in (*of_value(series, values[0]), *of_units(series, values[0])):
            value = written(slip.value, units, digits)
            yield Made(
                slip.sentence, [*sheet[:k], sheet[k].model_copy(update={"value": value}), *sheet[k + 1 :]]
            )


def named_first(made: Made, verdicts: list[Any]) -> bool | None:
    """Whether the mistake is named, or another one that gives all the wrong figures; None if all are right.

    Figures that follow from others of the sheet need no mistake of their own.
    """
    wrong = [v for v in verdicts if not v.right and v.kind not in ("open", "follow_through")]
    if not wrong:
        return None
    said = {v.mistake for v in wrong}
    alone = len(said) == 1 and wrong[0].kind not in ("unknown", "rounding")
    return alone or wrong[0].mistake.removeprefix("may be: ") == made.mistake
