"""A study as a page: what varied, statuses, each output with its limits, contributions, responses, extreme designs."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.analysis.result.named_quantities import quantity
from dalembert.errors import ModelError
from dalembert.printing import number
from dalembert.reports.sheet import ReportSheet
from dalembert.studies.contributions import Contributions
from dalembert.studies.output.study_text import (
    extreme_rows,
    failure_text,
    heading,
    left_out,
    limit_rows,
    output_rows,
    reduction,
    status_rows,
)
from dalembert.studies.output.study_views import histogram_scene, response_scene, scatter_scene
from dalembert.studies.spreads import CUT
from dalembert.studies.study_result import StudyResult
from dalembert.views import draw
from dalembert.views.paper.scene import Scene

SOBOL = 4096
"""Designs of which each number is exchanged for Sobol's shares."""
AT_LEAST = 0.005
"""Share of the variance from which on a number is listed."""


def study_sheet(r: StudyResult) -> ReportSheet:
    """Page of a study's computed designs."""
    m = r.study.mechanism
    sheet = ReportSheet(m.title or "Study", m.source_text, heading(r))
    sheet.heading("Varied numbers")
    _numbers(sheet, r)
    sheet.heading("Designs by status")
    sheet.table(["status", "designs", "share"], status_rows(r))
    for f in r.failed():
        sheet.text(failure_text(r, f))
    heads, rows = output_rows(r)
    if rows:
        sheet.heading("Outputs")
        sheet.text(left_out(r))
        sheet.table(heads, rows, reduction(r))
        sheet.table(["limit", "designs that keep it", "Cpk"], limit_rows(r))
    for name in (row[0] for row in rows):
        sheet.heading(name)
        _Output(sheet, r, name).write()
    more = [name for name in r.study.outputs if name not in [row[0] for row in rows]]
    sheet.text(
        f"Not shown, as they have several numbers a design or none: {', '.join(more)}." if more else ""
    )
    return sheet


def _numbers(sheet: ReportSheet, r: StudyResult) -> None:
    to, kinds, plan = Printed(r.study.mechanism.units), r.study.number_kinds, r.study.plan
    rows = []
    for path, s in zip(plan.paths, plan.spreads, strict=False):
        ends = [f"{to(kinds[path], x):.6g}" for x in (*s.ends, s.sigma)]
        rows.append([path, to.text(kinds[path]), s.kind, *ends])
    words = f"Standard deviation; a tolerance is a normal distribution cut at {CUT:g} of them"
    sheet.table(["number", "unit", "spread", "from", "to", "sigma"], rows, words)
    if not rows:
        sheet.text(f"The designs of a table of {', '.join(plan.paths)}.")


@dataclass
class _Output:
    """The part of a page about one output of one number a design."""

    sheet: ReportSheet
    r: StudyResult
    name: str
    order: list[str] = field(default_factory=list)
    """Numbers, the one that contributes most first."""

    def write(self) -> None:
        try:
            self._contributions()
        except ModelError as error:
            self.sheet.text(f"No contributions: {error}.")
        self.order = self.order or list(self.r.study.paths)
        over = scatter_scene(self.r, self.name, self.order[0])
        self.sheet.figure(histogram_scene(self.r, self.name), over)
        self._responses()
        self._extremes()

    def text(self, value: float) -> str:
        """A value of the output with its unit."""
        to, kind = Printed(self.r.study.mechanism.units), self.r.kinds[self.name]
        return f"{number(float(to(kind, value)), 5)} {to.text(kind)}".strip()

    def _contributions(self) -> None:
        study = self.r.study
        by_method = {"linear": study.contributions(self.name)}
        if not study.why_slow:
            by_method["Sobol"] = study.contributions(self.name, "sobol", SOBOL)
        last = list(by_method.values())[-1]
        shares = last.total or last.shares
        self.order = sorted(shares, key=lambda path: -shares[path])
        columns = [of.shares for of in by_method.values()] + ([last.total] if last.total else [])
        rows = [
            [path, *(f"{of[path]:.2%}" for of in columns)]
            for path in self.order
            if max(of[path] for of in columns) >= AT_LEAST
        ]
        heads = ["number", *by_method, *(["Sobol, with interactions"] if last.total else [])]
        left = len(study.paths) - len(rows)
        rest = f"; {left} of less than {AT_LEAST:.1%} left out" if left else ""
        self.sheet.table(heads, rows, f"Shares of the variance of {self.name}{rest}")
        self._assumed(by_method)

    def _assumed(self, by_method: dict[str, Contributions]) -> None:
        sigmas = " and ".join(f"{self.text(of.sigma)} ({by})" for by, of in by_method.items())
        notes = [f"Note: {of.note}." for of in by_method.values() if of.note]
        worst = self.r.study.worst_case(self.name)
        case = f"Worst case {self.text(worst.value)}: {worst.assumed}."
        self.sheet.text(" ".join([f"Standard deviation {sigmas}.", *notes, case]))

    def _responses(self) -> None:
        """Over the number that matters most, and over the two of them."""
        for some in (self.order[:1], self.order[:2]) if len(self.order) > 1 else (self.order[:1],):
            try:
                curve = self.r.study.response(self.name, *some, count=9 if self.r.study.why_slow else 33)
                self.sheet.figure(response_scene(self.r, curve))
            except ModelError as error:
                self.sheet.text(f"No response: {error}.")

    def _extremes(self) -> None:
        n, k = self.r.best(self.name), self.r.worst(self.name)
        heads = ["number", "unit", "model file", f"least: design {n}", f"greatest: design {k}"]
        self.sheet.table(heads, extreme_rows(self.r, self.name), f"The least and the greatest {self.name}")
        where = "at the end" if self.at_end else f"where {self.name} is largest in magnitude"
        self.sheet.figure(
            self._drawing(n), self._drawing(k), caption=f"Design {n}, then design {k}, {where}."
        )

    @property
    def at_end(self) -> bool:
        """True if it is the final state of a motion."""
        return self.r.study.reduce == "final" or self.name in self.r.study.end_kinds

    def _drawing(self, design: int) -> Scene:
        """A design where its output has the largest magnitude, or at the end of its motion."""
        result = self.r.study.answer(self.r.study.mechanism_of(design))
        at = len(result.status) - 1
        if not self.at_end:
            size = np.abs(quantity(result, self.name).values)
            at = int(np.nanargmax(size)) if np.isfinite(size).any() else 0
        return draw.mechanism(result, at + 1)
