"""One set of values tried: solved, kept away from dead centres, and whether its figures show the usual mistakes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.analysis.solution import solve
from dalembert.arrays import Array, Tree
from dalembert.errors import NUMBERED, STATUSES, DalembertError
from dalembert.exams.asked import ExpectedValue, figure, place_of_answer
from dalembert.exams.titles import variant_title
from dalembert.grading.figure import values_of
from dalembert.grading.file_answers import describe_answer
from dalembert.grading.quantities import Series
from dalembert.grading.tolerance import NEAR, Closeness
from dalembert.grading.value_errors import of_value
from dalembert.grading.wrong.wrong_problems import WrongProblems

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism, StatedAnswer

ASIDE = {"turn": pi / 90, "slide": 0.01}
"""Distance from its position at which a drive is checked too, rad or characteristic lengths."""

GROWTH = 2.0
"""Ratio of the largest reactions on both sides at which a dead centre is near: forces go as one over its distance."""

CLEAR = 3.0
"""Times the tolerance by which a mistake plainly changes a figure."""

SMALL = 0.02
"""Part of its usual size at which a figure is near zero."""


@dataclass(frozen=True)
class Candidate:
    """Values, the problem they make, its figures, and by how many tolerances a known mistake changes them at most."""

    values: Mapping[str, object]
    mechanism: Mechanism
    result: Result
    figures: tuple[ExpectedValue, ...]
    mistakes: Mapping[str, float]

    @property
    def clear(self) -> list[str]:
        """Mistakes that plainly change a figure."""
        return [sentence for sentence, by in self.mistakes.items() if by > CLEAR]

    def hidden(self, usual: Iterable[str]) -> list[str]:
        """Usual mistakes that change no asked figure by more than the tolerance."""
        return sorted(s for s in usual if self.mistakes.get(s, 0.0) <= 1.0)

    def near_zero(self, usual: Sequence[float]) -> int | None:
        """Index of a figure near zero beside its usual size, if any."""
        for k, (f, size) in enumerate(zip(self.figures, usual, strict=True)):
            if f.kind not in ("angle", "number") and figure_size(f) < SMALL * size:
                return k
        return None

    def same(self, other: Candidate, near: float) -> bool:
        """True if all figures are those of another candidate."""
        pairs = zip(self.figures, other.figures, strict=True)
        return all(difference(a, b.value) <= near for a, b in pairs)


@dataclass(frozen=True)
class Variant:
    """One variant: its name (01, 02, ...), the values drawn, its problem with the right answers, its result."""

    name: str
    values: Mapping[str, object]
    mechanism: Mechanism
    result: Result
    key: tuple[dict[str, object], ...]


class Unfit(Exception):  # noqa: N818
    """A set of values makes no sound problem: the sentence says why."""


def figure_size(f: ExpectedValue) -> float:
    """Size of a number, vector or rotation."""
    return float(np.linalg.norm(f.value))


def difference(right: ExpectedValue, value: Array) -> float:
    """Relative difference of a value from a figure; of an angle in radians."""
    return Closeness(right.value, right.kind, NEAR, (), False).off(value)


def candidate(
    m: Mechanism,
    values: Mapping[str, object],
    questions: Sequence[StatedAnswer],
    near: float = NEAR,
    static: bool = False,
) -> Candidate:
    """The problem with some values replaced; raises Unfit where it is not sound."""
    try:
        changed = m.with_values(values)
        if (title := variant_title(m, changed, values)) != m.title:
            changed = changed.with_values({"title": title})
        r = solve(changed, static=static)
        figures = tuple(figure(r, a) for a in questions)
        places = [place_of_answer(r, a) for a in questions]
    except DalembertError as error:
        raise Unfit(f"the problem cannot be solved: {error}") from None
    for k in dict.fromkeys(places):
        _check_position(r, k, static)
    for a, f in zip(questions, figures, strict=True):
        if not np.isfinite(f.value).all():
            raise Unfit(f"{describe_answer(a)} has no value")
    by: dict[str, float] = {}
    for sentence, off in _mistakes(r, questions, figures, places):
        by[sentence] = max(by.get(sentence, 0.0), off / near)
    return Candidate(values, changed, r, figures, by)


def _check_position(r: Result, k: int, static: bool) -> None:
    """Raise Unfit where a position is not solved, or near one that is not."""
    if r.status[k] not in (*NUMBERED, "at_rest"):
        raise Unfit(STATUSES[r.status[k]].sentence.rstrip(".").lower())
    for drive in r.drives:
        sizes = _beside(r, k, drive, static)
        if len(sizes) and (not np.isfinite(sizes).all() or max(sizes) > GROWTH * min(sizes)):
            raise Unfit(f"a dead centre of {drive} is near")


def _beside(r: Result, k: int, drive: str, static: bool) -> list[float]:
    """The largest reaction with one drive a little before its position, at it, and a little after it."""
    m, values = r.mechanism, Tree()
    if any(d.law is not None or d.unknown for d in m.drives.values()):
        return []
    for name in r.drives:
        values[f"drives.{name}.position"] = float(r.drive_position(name)[k])
        values[f"drives.{name}.speed"] = float(r.drive_speed(name)[k])
        values[f"drives.{name}.acceleration"] = float(r.drive_acceleration(name)[k])
    if m.dimension == 2:
        values["assembly"] = {link: float(r.angle(link)[k]) for link in r.links}
    turns = drive_kinds(r, drive)["position"] == "angle"
    step = ASIDE["turn"] if turns else ASIDE["slide"] * r.compiled.layout.length
    at = values.pop(f"drives.{drive}.position")
    # behind the rates, which may have been lists
    values[f"drives.{drive}.position"] = [at - step, at, at + step]
    try:
        beside = solve(m.with_values(values), static=static)
    except DalembertError:
        return [np.nan]
    if any(s not in (*NUMBERED, "at_rest") for s in beside.status):
        return [np.nan]
    forces = [beside.least_norm(joint)[:, : m.dimension] for joint in beside.joints]
    largest = np.max([np.linalg.norm(f, axis=-1) for f in forces], axis=0)
    return [float(x) for x in largest] if np.isfinite(largest).all() and largest.min() > 0 else []


def _mistakes(
    r: Result, questions: Sequence[StatedAnswer], figures: Sequence[ExpectedValue], places: Sequence[int]
) -> Iterator[tuple[str, float]]:
    """Every known mistake and how far it takes each figure; infinitely far where it leads to none."""
    which = [*range(len(r.status))] if any(a.extreme for a in questions) else sorted(set(places))
    for problem in WrongProblems(r, which).usual():
        other = problem.solution()
        asks = zip(questions, figures, map(which.index, places), strict=True)
        yield problem.sentence, max(np.inf if other is None else _change(other, *one) for one in asks)
    for f in figures:
        for slip in of_value(Series(f.kind, f.value[None]), f.value) if f.value.ndim < 2 else ():
            yield slip.sentence, difference(f, slip.value)


def _change(other: Result, answer: StatedAnswer, right: ExpectedValue, place: int) -> float:
    """Distance of the figure of a wrong problem from the right one."""
    try:
        values, _ = values_of(other, answer, place)
    except (DalembertError, IndexError):
        return np.inf
    return min((difference(right, v) for v in values), default=np.inf)
