"""Statistics of the designs of a study: counts by status, percentiles, worst and best, designs within limits."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.analysis.batch.batch_result import CODES, NUMBERED, SOLVED, among, first_mark, one_number
from dalembert.answer.answer import Drawn, Labelled, Worked
from dalembert.answer.column import Axes, Column, Scale, UnitChoice
from dalembert.answer.named_answer import NamedAnswer
from dalembert.arrays import Array, Flags, Ints, Tree
from dalembert.bounds import require
from dalembert.errors import STATUSES, DalembertError, ModelError
from dalembert.studies.design_study import Study, study_of_tree
from dalembert.studies.limits import Limit, read_limit
from dalembert.studies.motion_engines import SENTENCES
from dalembert.studies.store import Store
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.model import Mechanism
    from dalembert.printing import Part
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene

PERCENTILES = (0.1, 5.0, 50.0, 95.0, 99.9)
ROUNDING = 1e-12
"""Spread of values over their mean that is none."""
REFUSED = "The description refuses the values of these designs, or one of them is not finite."
SAMPLE = 1_000
"""Designs of each sort that are compared, evenly out of all."""
CERTAIN = 2.2
"""Kolmogorov and Smirnov's statistic times the root of n m/(n + m) that one number in 8,000 exceeds at random."""
LEAST = 0.3
"""Difference of two distributions below which a number is not reported."""


class Difference(NamedTuple):
    """A number whose values for failing designs are mostly on one side of a value: the shares on that side of these,
    and of the solved designs."""

    path: str
    above: bool
    value: float
    failing: float
    answered: float


class Failure(NamedTuple):
    """Designs that are not solved for one reason: status, number, the first of them, the sentence; their share of the
    computed designs, the sentence of a separate analysis of the first one, how their numbers differ."""

    status: str
    designs: int
    first: tuple[int, ...]
    sentence: str
    share: float = 0.0
    reason: str = ""
    differs: Difference | None = None


class StudyResult(NamedAnswer, Labelled, Drawn, Worked):
    """Answers of a study by output, SI, NaN where there is none: ``r["effort.O2"]`` (design, ...).

    In an unfinished store `done` is true for the computed designs.

    >>> import dalembert as da
    >>> s = da.study(da.four_bar(), {"links.coupler.mass": "± 5 %"}, ["effort.O2"], designs=100, seed=7)
    >>> r = s.run()
    >>> r["effort.O2"].shape, bool(r.done.all())
    ((100,), True)
    """

    def __init__(self, study: Study, arrays: Mapping[str, Any], ledger: Ints, block: int) -> None:
        self.study, self.arrays, self.ledger, self.block = study, arrays, ledger, block

    @classmethod
    def open(cls, path: str | os.PathLike[str], check: bool = True) -> StudyResult:
        """The results of a store, finished or not; the study is that of the store's attributes.

        check: blocks that do not match their checksums count as not done; a resumed run repairs them.
        """
        store = Store(path)
        attributes = store.open("r")
        try:
            study, block = stored_study(store, attributes), int(attributes["block"])
        except (KeyError, TypeError, ValueError) as error:
            raise store.unreadable(error) from None
        ledger = store.ledger()
        for b in np.flatnonzero(ledger[:, 0]) if check else ():
            if not store.sound(int(b), block, study.count, ledger[b]):
                ledger[b] = 0
        return cls(study, store.arrays, ledger, block)

    ROW = "design"

    def keys(self) -> list[str]:
        """Names of the outputs."""
        return list(self.study.outputs)

    @property
    def codes(self) -> Array:
        """Statuses of the designs, of their positions where these are kept, as numbers."""
        return self["status"]

    def __len__(self) -> int:
        return self.study.count

    @property
    def mechanism(self) -> Mechanism:
        """The description that is varied."""
        return self.study.mechanism

    @property
    def extent(self) -> str:
        """Number of computed designs."""
        return f"{int(self.done.sum()):,} of {self.study.count:,} designs"

    @property
    def outcome(self) -> str:
        """Counts by status, from the ledger alone."""
        return ", ".join(f"{n:,} {status}" for status, n in self.counts().items()) or "none done"

    def both_sides(self, name: str) -> list[Array]:
        """An output; where it is reduced, one number for each design."""
        return [one_number(name, self[name], self.study.reduce is not None)]

    def compared(self) -> Tree:
        """Data that equal answers share: the study, the statuses and all outputs."""
        return {"study": self.study, "status": self["status"], **{name: self[name] for name in self.keys()}}

    @property
    def done(self) -> Flags:
        """True for computed designs."""
        return np.repeat(self.ledger[:, 0] > 0, self.block)[: self.study.count]

    def __getitem__(self, name: str) -> Array:
        if name not in self.arrays or name == "ledger":
            what = f"{name!r} is not an output of this study"
            raise ModelError(what, closest(name, list(self.study.outputs)))
        array = self.arrays[name]
        try:
            values = np.array(array[: self.study.count])
        except Exception:  # whatever a codec says of a chunk that was cut, which is not done
            values = np.zeros(array.shape, array.dtype)
            for b in np.flatnonzero(self.ledger[:, 0]):
                which = slice(b * self.block, (b + 1) * self.block)
                values[which] = array[which]
        values[~self.done] = 255 if values.dtype == np.uint8 else np.nan
        return values

    @property
    def status(self) -> Array:
        """Code of each design; of one with several positions that of the first that is not solved."""
        names = np.array([*CODES, *[""] * (256 - len(CODES))], object)
        return names[self._marks]

    @property
    def _marks(self) -> Array:
        codes = self["status"]
        return codes if codes.ndim == 1 else np.where(codes[:, 0] == 255, 255, first_mark(codes))

    @property
    def ok(self) -> Flags:
        """True for designs that are solved at all positions."""
        return among(self._marks, SOLVED)

    def counts(self) -> dict[str, int]:
        """Designs by status, from the ledger alone."""
        total = self.ledger[:, 2:].sum(axis=0)
        return {name: int(n) for name, n in zip(CODES, total, strict=False) if n}

    def failed(self, some: int = 5) -> list[Failure]:
        """Designs that are not solved, by status: their share, the numbers of the first few, the reason from a separate
        analysis of the first one, and the number by which they differ most from the solved designs."""
        require("some", some)
        return failures(self, self._marks, some)

    def unsolved(self) -> tuple[int, int]:
        """Number of computed designs, and number of those without numbers: statistics are of the others."""
        return unsolved(self._marks)

    def values(self, name: str) -> Array:
        """The finite numbers of an output of one number a design, in the order of the designs."""
        numbers = self._single(name)
        return numbers[np.isfinite(numbers)]

    def _single(self, name: str) -> Array:
        return one_number(name, self[name], True)

    def worst(self, name: str) -> int:
        """Number of the design with the greatest value."""
        return self._extreme(name, np.nanargmax)

    def best(self, name: str) -> int:
        """Number of the design with the least value."""
        return self._extreme(name, np.nanargmin)

    def _extreme(self, name: str, where: Callable[[Array], np.intp]) -> int:
        numbers = self._single(name)
        if not np.isfinite(numbers).any():
            raise ModelError(f"no design has a value of {name}", "see failed()")
        return int(where(numbers))

    def percentiles(self, name: str, of: tuple[float, ...] = PERCENTILES) -> dict[float, float]:
        """Percent -> value that this percentage of the solved designs does not exceed."""
        for percent in of:
            require("percentile", percent)
        values = self.values(name)
        levels = np.percentile(values, of) if len(values) else np.full(len(of), np.nan)
        return dict(zip(of, levels.tolist(), strict=True))

    def histogram(self, name: str, bins: int = 40) -> tuple[Ints, Array]:
        """Designs in each of some equal intervals, and the intervals' ends."""
        require("bins", bins)
        values = self.values(name)
        middle = float(np.mean(values)) if len(values) else 0.0
        alike = bool((np.abs(values - middle) <= ROUNDING * np.abs(middle)).all())  # then 1 wide
        counts, ends = np.histogram(values, bins, (middle - 0.5, middle + 0.5) if alike else None)
        return counts, ends

    def share(self, output: str, limit: str) -> float:
        """Share of the designs that keep a limit, as ``"< 45 N*m"``; a failed design keeps none."""
        return self._share(read_limit(output, limit, self.kinds, self.study.mechanism))

    def _share(self, limit: Limit) -> float:
        return float(limit.kept(self[limit.output])[self.done].mean())

    def capability(self, output: str, limit: str) -> float:
        """Process capability Cpk: the least distance of the mean from a limit over three standard deviations; infinite
        where all values are equal, and negative where these are beyond the limit."""
        bounds = read_limit(output, limit, self.kinds, self.study.mechanism)
        values = self.values(output)
        mean, sigma = float(values.mean()), float(values.std())
        if not sigma:
            return np.inf if bounds.kept(values).all() else -np.inf
        return min(bounds.high - mean, mean - bounds.low) / (3 * sigma)

    def shares(self) -> dict[str, float]:
        """The same for the limits of the study, and under "all" of the designs that keep them all together."""
        done, limits = self.done, self.study.limits
        kept = [limit.kept(self[limit.output])[done] for limit in limits]
        by_output = {
            f"{limit.output} {limit.text}": float(k.mean()) for limit, k in zip(limits, kept, strict=True)
        }
        return by_output | ({"all": float(np.logical_and.reduce(kept).mean())} if len(kept) > 1 else {})

    @property
    def kinds(self) -> dict[str, str]:
        """Kind of each output, from `units.KINDS`."""
        return self.study.kinds

    # as an answer

    ROWS, FIRST = "designs", 0

    def blocks(self, count: int) -> Iterator[slice]:
        """The existing blocks of designs."""
        for b in np.flatnonzero(self.ledger[:, 0]).tolist():
            yield slice(b * self.block, min((b + 1) * self.block, count))

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """A row a design: its numbers, status and outputs, read from the store by blocks."""
        from dalembert.studies.output.study_columns import study_columns

        return study_columns(self)

    def record(self, to: Scale) -> Tree:
        """Designs by status, and shares of those that keep the limits."""
        return {"designs_done": int(self.done.sum()), "statuses": self.counts(), "shares": self.shares()}

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterator[Part]:
        """Designs by status, percentiles, worst and best, limits."""
        from dalembert.studies.output.study_text import study_parts

        return study_parts(self)

    def text(self, units: UnitChoice = "file", **choice: Any) -> str:
        """The same with histograms, as `dalembert study show` prints it."""
        from dalembert.studies.output.study_text import summary

        return summary(self)

    def drawings(self, notation: Notation | None = None) -> list[Scene]:
        """Distribution of each output with one number per design."""
        from dalembert.studies.output.study_text import output_rows
        from dalembert.studies.output.study_views import histogram_scene

        return [histogram_scene(self, row[0]) for row in output_rows(self)[1]]

    def sheet(self, notation: Notation | None = None) -> ReportSheet:
        """All that the designs say as a page."""
        from dalembert.studies.output.study_report import study_sheet

        return study_sheet(self)

    def labelled(self, to: Scale, axes: Axes) -> tuple[Tree, Tree]:
        """Outputs over the designs, and their numbers as coordinates."""
        values, kinds = self.study.plan.values(0, self.study.count), self.study.number_kinds
        data: Tree = {"status": ("design", self.status.astype(str))}
        for name in self.study.outputs:
            array, kind = self[name], self.kinds[name]
            rest = [f"{name} axis {k}" for k in range(1, array.ndim)]
            data[name] = (("design", *rest), to(kind, array), {"units": to.text(kind)})
        named = [(path, kinds[path], values[:, j]) for j, path in enumerate(self.study.paths)]
        return data, {path: ("design", to(kind, v), {"units": to.text(kind)}) for path, kind, v in named}


def stored_study(store: Store, attributes: Mapping[str, Any]) -> Study:
    """The study that a store's attributes describe, of as many designs as it has."""
    from dalembert.model import loads

    m = loads(attributes["model"], name=f"the model in {store}")
    table = np.asarray(store.group["table"][:]) if "table" in store.group else None
    tree = {**attributes["study"], "designs": attributes["designs"]}
    return study_of_tree(m, tree, table)


def failures(r: StudyResult, codes: Array, some: int) -> list[Failure]:
    """Each reason why designs are not solved, by the status codes of all designs (255 where not computed)."""
    out, computed, solved = [], codes != 255, np.flatnonzero(among(codes, SOLVED))
    known = {} if r.study.motion is None else SENTENCES
    for mark in np.unique(codes[~among(codes, (*SOLVED, 255))]):
        where = np.flatnonzero(codes == mark)
        code = CODES[mark]
        sentence = STATUSES[code].sentence if code in STATUSES else REFUSED
        first, share = tuple(where[:some].tolist()), len(where) / int(computed.sum())
        reason = _reason(r.study, first[0], code) if r.study.motion is None else ""
        differs = _difference(r.study, where, solved)
        out.append(Failure(code, len(where), first, known.get(code, sentence), share, reason, differs))
    return out


def unsolved(codes: Array) -> tuple[int, int]:
    """Number of computed designs, and number of those without numbers."""
    computed = codes != 255
    return int(computed.sum()), int((computed & ~among(codes, NUMBERED)).sum())


def _reason(study: Study, n: int, status: str) -> str:
    """Sentence of a separate analysis of one design, with its position; empty where that has another status."""
    try:
        problems = study.answer(study.mechanism_of(n)).problems()
    except DalembertError as error:
        return str(error) if status == "failed" else ""
    return next((f"position {which}: {text}" for which, code, text in problems if code == status), "")


def _difference(study: Study, failing: Ints, answered: Ints) -> Difference | None:
    """Number whose distributions over failing and answering designs are farthest apart (Kolmogorov and Smirnov)."""
    if not (len(failing) and len(answered)):
        return None
    one, other = (_values(study, of) for of in (failing, answered))
    differences = [_distance(path, one[:, k], other[:, k]) for k, path in enumerate(study.paths)]
    best = max(differences, key=lambda of: of.failing - of.answered)
    gap = best.failing - best.answered
    sure = gap * np.sqrt(len(one) * len(other) / (len(one) + len(other))) >= CERTAIN
    return best if sure and gap >= LEAST else None


def _values(study: Study, designs: Ints) -> Array:
    kept = designs[np.unique(np.linspace(0, len(designs) - 1, min(len(designs), SAMPLE)).astype(int))]
    return np.concatenate([study.plan.values(n, n + 1) for n in kept.tolist()])


def _distance(path: str, one: Array, other: Array) -> Difference:
    """Largest difference of the empirical distributions of two samples, and the side on which the first one lies."""
    ends = np.unique(np.concatenate([one, other]))
    below = [np.searchsorted(np.sort(of), ends, side="right") / len(of) for of in (one, other)]
    k = int(np.argmax(np.abs(below[0] - below[1])))
    above = bool(below[0][k] < below[1][k])
    shares = [float(1 - of[k]) if above else float(of[k]) for of in below]
    middle = (ends[k] + ends[min(k + 1, len(ends) - 1)]) / 2
    return Difference(path, above, float(middle), *shares)
