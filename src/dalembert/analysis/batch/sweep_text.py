"""A sweep as printed text: one row per design, and the positions that are not solved."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.summary.printed_units import scale_for
from dalembert.answer.column import UnitChoice
from dalembert.printing import Part, TextTable, number

if TYPE_CHECKING:
    from dalembert.analysis.batch.design_sweep import Sweep

MOST_SAID = 8
"""Problems that are listed one by one."""


def sweep_parts(s: Sweep, units: UnitChoice) -> Iterator[Part]:
    """A row a design: what was varied, the positions solved, the largest size of each quantity over the positions."""
    named = [name for name, a in s.answers.arrays.items() if a.ndim - len(s.shape) < 3]
    peaks = {name: s.over(name).reshape(-1) for name in named}
    most = {s.kinds[name]: 0.0 for name in named}
    for name, peak in peaks.items():
        most[s.kinds[name]] = max(most[s.kinds[name]], float(np.nanmax(np.abs(peak), initial=0.0)))
    to = scale_for(None if units == "SI" else s.mechanism.units, most)
    heads = [*s.paths, "solved", *(f"largest {name}\n{to.text(s.kinds[name])}" for name in peaks)]
    solved = s.ok.reshape(-1, s.status.shape[-1]).sum(axis=1)
    cells = [[number(float(v)) for v in to(s.kinds[name], peak)] for name, peak in peaks.items()]
    rows = [
        [*values, f"{count} of {s.status.shape[-1]}", *more]
        for values, count, *more in zip(s.designs, map(str, solved), *cells, strict=True)
    ]
    sentences = [f"{status}: {which}: {sentence}" for which, status, sentence in s.problems()[:MOST_SAID]]
    yield repr(s).strip("<>")
    yield TextTable(heads, rows, len(s.paths) + 1)
    yield from sentences
