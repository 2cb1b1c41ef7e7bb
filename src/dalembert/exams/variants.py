"""Variants of a problem: random values until enough sound problems exist, all different."""

from __future__ import annotations

import random
import secrets
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING, overload

import numpy as np

from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.exams.asked import key_row, requested_quantities, stated_value
from dalembert.exams.candidates import Candidate, Unfit, Variant, candidate, figure_size
from dalembert.exams.choices import Choices, read_choices
from dalembert.grading.file_answers import describe_answer
from dalembert.grading.tolerance import NEAR, percent
from dalembert.model import ModelOrPath, as_mechanism
from dalembert.progress import progress
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.model import Mechanism, StatedAnswer

TRIES = 20
"""Sets of values tried for each requested variant."""


@dataclass(frozen=True)
class Variants(Sequence[Variant]):
    """Variants of a problem, their required quantities, and the seed that repeats them."""

    found: tuple[Variant, ...]
    asked: tuple[StatedAnswer, ...]
    seed: int

    @overload
    def __getitem__(self, k: int) -> Variant: ...

    @overload
    def __getitem__(self, k: slice) -> tuple[Variant, ...]: ...

    def __getitem__(self, k: int | slice) -> Variant | tuple[Variant, ...]:
        return self.found[k]

    def __len__(self) -> int:
        return len(self.found)

    def __repr__(self) -> str:
        return f"<{len(self)} variants of {self.found[0].mechanism.title!r}, seed {self.seed}>"

    def key(self, folder: str = "") -> list[dict[str, object]]:
        """The key: a row an asked figure, with the file of its variant in a folder."""
        start = f"{folder}/" if folder else ""
        return [{"variant": v.name, "file": f"{start}{v.name}.yaml", **row} for v in self for row in v.key]

    def save(
        self,
        folder: str | Path,
        overwrite: bool = False,
        course: str = "",
        text: str = "",
        marks: Mapping[str, float] | None = None,
    ) -> None:
        """Write problems, question sheets, solutions and the key into a new folder, all of it or nothing.

        ``course`` is printed under the title, ``text`` (paragraphs, an empty line between) before the given data;
        ``marks``: of a question by its name, `effort.O2`, its quantity, `reaction`, or `default`.
        """
        from dalembert.exams.exam_folder import write_folder
        from dalembert.exams.question_sheet import ExamText

        exam = ExamText(course, text, read_marks(marks or {}, self.asked))
        key = [
            row | ({} if (worth := exam.marks_of(a)) is None else {"marks": worth})
            for row, a in zip(self.key("problems"), self.asked * len(self), strict=True)
        ]
        record = {
            "title": self[0].mechanism.title,
            "seed": self.seed,
            "asked": [describe_answer(a) for a in self.asked],
            "variants": {v.name: dict(v.values) for v in self},
        }
        write_folder(self.found, self.asked, key, record, Path(folder), overwrite, exam)


def read_marks(marks: Mapping[str, float], asked: Sequence[StatedAnswer]) -> dict[str, float]:
    """Marks of questions; ModelError for a name that no question has, or a number below 0."""
    names = {n for a in asked for n in (a.name, f"{a.quantity}.{a.of}", a.quantity)} | {"default"}
    for name, worth in marks.items():
        if name not in names:
            raise ModelError(f"no question is named {name!r}", closest(name, sorted(names)), ("marks", name))
        if isinstance(worth, bool) or not isinstance(worth, (int, float)) or not 0 <= worth <= 1e6:
            raise ModelError(f"marks of {name}: {worth!r} is not a number of marks", "write 0 or more")
    return dict(marks)


def variants(
    mechanism: ModelOrPath,
    vary: Mapping[str, object],
    count: int = 30,
    seed: int | None = None,
    ask: Sequence[object] = (),
    at: int | str | None = None,
    static: bool = False,
    tolerance: str = "",
) -> Variants:
    """Variants of a problem with random values of stated numbers, all different, each solved and checked.

    ``vary``: path -> a range ("40..60 mm step 5 mm"), or a list of values. ``ask``: the required quantities
    ("effort.O2", "reaction.A", a `StatedAnswer`); by default the file's `answers`, else all efforts and reactions. A
    variant is sound where all positions are solved and no dead centre is near (the largest reaction less than doubles
    within 2 degrees of the drive on both sides), where no figure is near zero, and where every mistake that
    `check_answers` knows, and that most sets of values show, changes one asked figure at least by more than
    ``tolerance`` ("3 %", by default 0.5 %). Raises ModelError where too few are sound, with the faults of the others.
    The same ``seed`` draws the same variants.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> m = da.load(examples()["four_bar"])
    >>> some = variants(m, {"loads.T_4.value": "[100, 120, 140]"}, count=2, seed=1, ask=["effort.O2"])
    >>> [(v.name, v.key[0]["unit"]) for v in some]
    [('01', 'lbf*in'), ('02', 'lbf*in')]
    """
    from dalembert.analysis.solution import solve

    mechanism = as_mechanism(mechanism)
    require("variants", count, "count")
    require("seed", seed)
    choices, near = read_choices(vary), percent(tolerance) if tolerance else NEAR
    for path, some in choices:
        for value in (some[0], some[-1]):
            mechanism.with_values({path: value})
    possible = prod(len(c.values) for c in choices)
    if possible < count:
        what = f"the values allow {possible} different problems, but {count} are requested"
        raise ModelError(what, "give more values, or smaller steps")
    questions = requested_quantities(solve(mechanism, static=static), ask, at)
    seed = secrets.randbelow(10**6) if seed is None else seed
    pool = _Pool(mechanism, questions, near, static)
    with progress("Variants", count) as step:
        for tried, values in enumerate(_draws(choices, possible, random.Random(seed))):
            if len(pool.sound(count)) >= count or tried >= TRIES * count:
                break
            pool.add(values)
            step(len(pool.sound(count)))
    sound = pool.sound(count)
    if len(sound) < count:
        raise ModelError(pool.why_so_few(len(sound), count, possible), "give other values, or ask for fewer")
    width = max(2, len(str(count)))
    return Variants(
        tuple(_variant(f"{k + 1:0{width}d}", c, questions, tolerance) for k, c in enumerate(sound)),
        questions,
        seed,
    )


def _draws(choices: Sequence[Choices], possible: int, chance: random.Random) -> Iterator[dict[str, object]]:
    """Sets of values in a random order, none twice: the first part of a shuffle of all."""
    moved: dict[int, int] = {}
    for k in range(possible):
        other = k + int(chance.random() * (possible - k))
        number, moved[other] = moved.get(other, other), moved.get(k, k)
        values = {}
        for path, some in choices:
            number, place = divmod(number, len(some))
            values[path] = some[place]
        yield values


class _Pool:
    """The sets of values tried, and what they say together: which mistakes there are to show, how large figures are."""

    def __init__(self, m: Mechanism, questions: Sequence[StatedAnswer], near: float, static: bool) -> None:
        self.m, self.asked, self.near, self.static = m, questions, near, static
        self.tried: list[Candidate] = []
        self.unfit: list[str] = []
        self._sound: list[Candidate] | None = None

    def add(self, values: Mapping[str, object]) -> None:
        """Try a set of values."""
        self._sound = None
        try:
            tested = candidate(self.m, values, self.asked, self.near, self.static)
        except Unfit as reason:
            self.unfit.append(str(reason))
            return
        self.tried.append(tested)

    def sound(self, count: int) -> list[Candidate]:
        """The first of the sound ones, all different: those before are judged by what those behind have shown."""
        if self._sound is None:
            self._sound, usual = [], self._usual()
            for one in self.tried:
                if len(self._sound) < count and not self._fault(one, usual, self._sound):
                    self._sound.append(one)
        return self._sound

    def _usual(self) -> tuple[list[float], list[str]]:
        """Usual size of each figure, the median of all that were tried; mistakes that most of them show plainly."""
        sizes = [[figure_size(f) for f in c.figures] for c in self.tried]
        times = Counter(sentence for c in self.tried for sentence in c.clear)
        often = [sentence for sentence, n in times.items() if 2 * n > len(self.tried)]
        return [float(x) for x in np.median(np.array(sizes), axis=0)] if sizes else [], often

    def _fault(
        self, one: Candidate, usual: tuple[list[float], list[str]], others: Sequence[Candidate]
    ) -> str:
        """Fault of a solved candidate, if any."""
        small = one.near_zero(usual[0])
        if small is not None:
            return f"{describe_answer(self.asked[small])} is near zero"
        if hidden := one.hidden(usual[1]):
            return f"no asked figure shows the mistake '{hidden[0]}'"
        return "the figures are those of another one" if any(one.same(o, self.near) for o in others) else ""

    def why_so_few(self, sound_count: int, count: int, possible: int) -> str:
        """A sentence for too few variants, with the most frequent reasons."""
        usual, kept = self._usual(), self.sound(count)
        reasons = Counter(self.unfit)
        reasons.update(f for c in self.tried if c not in kept and (f := self._fault(c, usual, kept)))
        reasons_text = "; ".join(f"{n} where {reason}" for reason, n in reasons.most_common(3))
        tried = len(self.tried) + len(self.unfit)
        were = f"{sound_count} of {count} variants were drawn from {tried} sets of values"
        return f"{were}, of {possible} possible ones; rejected: {reasons_text}"


def _variant(name: str, c: Candidate, questions: Sequence[StatedAnswer], tolerance: str) -> Variant:
    """A sound candidate with its answers in the file's units."""
    units = c.mechanism.units
    key, answers = [], []
    for answer, right in zip(questions, c.figures, strict=True):
        key.append(key_row(answer, right, units) | ({"tolerance": tolerance} if tolerance else {}))
        value = stated_value(right, units)
        plain = {n: v for n, v in key[-1].items() if n not in ("value", "unit", "tolerance")}
        answers += [plain | {"value": value}] if value is not None else []
    return Variant(name, c.values, c.mechanism.with_values({"answers": answers}), c.result, tuple(key))
