"""The worst position of each thing of a result, sought over the positions."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

import numpy as np

from dalembert.analysis.methods.elements.cylinder_quantities import cylinders
from dalembert.analysis.result.named_quantities import quantity, solved_names
from dalembert.analysis.result.position_lookup import QuantityExtreme, extreme
from dalembert.errors import ModelError
from dalembert.reports.design.verdict import DesignContext

WORST_HEADS = ("Quantity", "Extreme", "Value", "At")
LARGEST = ("effort", "power", "load", "reaction", "power_lost", "pressure", "screw_torque")
"""Words of quantities whose largest magnitude is wanted."""
SMALLEST = ("normal", "transmission")
"""Words of quantities whose smallest value is wanted."""
SINGLE = ("shaking_force",)
NOTHING = 1e-9
"""Part of the largest of its kind below which an extreme is rounding."""


def sought(c: DesignContext) -> Iterator[QuantityExtreme]:
    """The extremes of a report, of the quantities that the result has."""
    r = c.r
    words = [*LARGEST, *SMALLEST, *SINGLE]
    joints, names = r.mechanism.joints, cylinders(r.mechanism)
    ends = {joint for name in names for joint in joints if joint.startswith(f"{name}_")}
    for name in solved_names(r, words):
        word, *rest = name.split(".")
        if name.endswith((".low", ".high")) or (word == "transmission" and ".".join(rest) not in joints):
            continue
        if rest and rest[0] in ends:  # of a cylinder: its force is that of its drive
            continue
        if word == "power_lost" and r.friction is None:
            continue
        try:
            value = extreme(r, f"{'min' if word in SMALLEST else 'peak'} {name}")
        except (ModelError, ValueError):
            continue
        if value is not None and np.isfinite(value.value):
            yield value


MOST = 4
"""Rows of one word: those of the most extreme quantities."""


def _few(some: list[QuantityExtreme]) -> list[QuantityExtreme]:
    """The most extreme quantities of each word, in the order of the words."""
    out: list[QuantityExtreme] = []
    for _, those in groupby(some, lambda e: e.of.partition(".")[0]):
        listed = list(those)
        sign = 1.0 if listed[0].word == "min" else -1.0
        keep = sorted(listed, key=lambda e: sign * abs(e.value))[:MOST]
        out += [e for e in listed if e in keep]
    return out


def worst_rows(c: DesignContext) -> list[list[str]]:
    """A row for each extreme that is more than rounding, few of each word."""
    some = _few(list(sought(c)))
    largest: dict[str, float] = {}
    for e in some:
        largest[e.kind] = max(largest.get(e.kind, 0.0), abs(e.value))
    rows = []
    for e in some:
        if abs(e.value) > NOTHING * largest[e.kind]:
            signed = (
                float(np.ravel(quantity(c.r, e.of).values[e.position])[0]) if e.word == "peak" else e.value
            )
            scalar = np.ndim(quantity(c.r, e.of).values) == 1
            value = c.text(e.kind, signed if scalar and np.isfinite(signed) else e.value)
            rows.append([e.of, "smallest" if e.word == "min" else "largest", value, c.at(e.position) or "–"])
    return rows
