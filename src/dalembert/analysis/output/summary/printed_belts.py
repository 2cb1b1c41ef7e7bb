"""Printed form of belts and ropes: tensions, friction needed, wraps."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from dalembert.analysis.compile.elements.belt_arrays import belts_of
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.printing import Part, TextTable, number

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def belt_tables(result: Result, to: Printed) -> Iterator[Part]:
    """A table of the belts and one of the ropes of a single position."""
    force = to.text("force")

    def size(value: float) -> str:
        return number(float(to("force", value)))

    rows = []
    for name in belts_of(result.mechanism):
        b = result.belt(name)
        has = "-" if math.isnan(b.coefficient) else number(b.coefficient)
        wraps = (number(math.degrees(wrap), 5) for wrap in b.wrap)
        tensions = (size(x[0]) for x in (b.tight, b.slack, b.centrifugal, b.shaft_force))
        rows.append([name, *tensions, number(float(b.slip_coefficient[0]), 4), has, *wraps])
    if rows:
        heads = [
            "belt",
            "tight",
            "slack",
            "centrifugal",
            "on shaft",
            "needs mu",
            "has mu",
            "wrap i",
            "wrap j",
        ]
        yield TextTable(
            heads, rows, 1, f"Tensions and the force on a shaft in {force}; wraps on i and j in degrees."
        )
    rows = []
    for name in result.mechanism.ropes:
        rope = result.rope(name)
        for k, tension in enumerate(rope.tension[0]):
            wheel = ["-", "-"]
            if k < len(rope.wheels):
                wheel = [rope.wheels[k], number(math.degrees(rope.wrap[0, k]), 5)]
            rows.append([f"{name}_{k + 1}", size(tension), *wheel])
    if rows:
        note = f"Tensions in {force}; the wheel behind each strand, and the angle of wrap on it in degrees."
        yield TextTable(["strand", "tension", "wheel", "wrap"], rows, 1, note)
