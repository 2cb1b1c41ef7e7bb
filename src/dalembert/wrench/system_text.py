"""A force system as tables: forces with their points, couples, the sum of all."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.summary.printed_units import scale_for
from dalembert.answer.column import UnitChoice
from dalembert.arrays import Array
from dalembert.printing import Part, TextTable, number
from dalembert.wrench.forces import Couple

if TYPE_CHECKING:
    from dalembert.wrench.system import System


def system_parts(s: System, units: UnitChoice) -> Iterator[Part]:
    """Forces with their points, couples, the sum of all at the origin, and what they reduce to."""
    total, turning = s.reduced(), [c.size for c in s.couples]
    most = {"force": max(f.size for f in (*s.forces, *total.parts[:1]))}
    to = scale_for(
        None if units == "SI" else s.units, most | {"moment": max([*turning, total.parts[1].size])}
    )
    axes = "xyz"[: s.dimension]
    shown = (to.text("force"), to.text("length"), to.text("moment"))
    heads = ["part", *(f"F {a}\n{shown[0]}" for a in axes), *(f"at {a}\n{shown[1]}" for a in axes)]
    heads += [f"M {a}\n{shown[2]}" for a in axes] if s.dimension == 3 else [f"M\n{shown[2]}"]
    blank = [""] * s.dimension
    rows = []
    for name, part in zip(s.names, s.parts, strict=True):
        if isinstance(part, Couple):
            rows.append([name, *blank, *blank, *_cells(to("moment", part.vector))])
        else:
            rows.append([name, *_cells(to("force", part.vector)), *_cells(to("length", part.at)), ""])
    named = {"force": total.force, "length": total.at, "moment": total.vector}
    sums = [cell for kind, vector in named.items() for cell in _cells(to(kind, vector))]
    rows = [[*row, *[""] * (len(heads) - len(row))] for row in [*rows, ["sum at the origin", *sums]]]
    yield TextTable(heads, rows, 1)
    yield f"It reduces to: {s.kind()}. {s.equilibrium().sentence}"


def _cells(vector: Array) -> list[str]:
    return [number(float(v)) for v in np.ravel(vector)]
