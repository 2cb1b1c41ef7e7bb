"""Positions at which a cylinder would be shorter or longer than it can be, in sentences.

Mechanics: docs/theory.md 10.11.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.friction_status import Check, arc
from dalembert.analysis.methods.elements.cylinder_quantities import cylinders, stroke_margins
from dalembert.analysis.status.closure_failure import quantity_text
from dalembert.arrays import Array, Flags, Ints

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled

OUT = (
    "Cylinder {name} would be {by} {sense} than it can be{arc}: {end} {which} it is {length} long. "
    "Change its closed length or its stroke, or the range of the motion."
)


def out_of_stroke(c: Compiled) -> Flags:
    """True (P,) where some cylinder is shorter or longer than it can be."""
    margins = stroke_margins(c.mechanism, c.schedule.names, c.schedule.position)
    flags = np.zeros(len(c.schedule.position), bool)
    return np.any(np.less(margins, 0.0), axis=0) if margins else flags


def stroke_checks(c: Compiled) -> list[Check]:
    """Check for cylinders that are out of their stroke."""
    flags = out_of_stroke(c)
    return [("out_of_stroke", flags, lambda k: _out_sentence(c, k))] if flags.any() else []


def _out_sentence(c: Compiled, run: Ints) -> str:
    worst = ("", 0.0, 0.0, False)
    for name, of in cylinders(c.mechanism).items():
        at: Array = c.schedule.position[run, c.schedule.names.index(name)]
        for end, long in zip(of.lengths or (), (False, True), strict=False):
            by = float((at - end if long else end - at).max())
            worst = max(worst, (name, by, end, long), key=lambda x: x[1])
    name, by, end, long = worst
    return OUT.format(
        name=name,
        by=quantity_text(c, "length", by),
        sense="longer" if long else "shorter",
        arc=arc(c, run),
        end="with its rod",
        which="out" if long else "in",
        length=quantity_text(c, "length", end),
    )
