"""Printed form of a flywheel."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.machine.flywheel.flywheel_size import FlywheelSize
from dalembert.machine.flywheel.speed_fluctuation import SpeedFluctuation
from dalembert.printing import Part, TextTable, number, remainder, round_components

if TYPE_CHECKING:
    from dalembert.machine.flywheel.flywheels import Flywheel

NONE = 1e-6
"""Part of the links' inertia below which a flywheel counts as none."""


def flywheel_parts(f: Flywheel, to: Printed) -> Iterator[Part]:
    """The energy curve, the book's flywheel, the exact speed and how far both differ."""
    energy, angle = to.text("energy"), to.text("angle")
    rows = []
    for q, e, pulse in zip(f.zeros, f.energies, f.size.pulses, strict=True):
        mark = "slowest" if q == f.slowest else "fastest" if q == f.fastest else ""
        energies = [to.number("energy", x) for x in round_components((e, pulse), f.size.energy)]
        rows.append([to.number("angle", q), *energies, mark])
    mean = round_components([f.mean], float(np.abs(f.torque).max()))[0]
    yield (
        f"The effort of {f.drive} at steady speed has the mean {to.quantity('moment', mean)}; where it crosses "
        "the mean, E is the energy needed above it since the first position; pulses are the areas between crossings."
    )
    heads = [f"{f.drive}\n{angle}", f"energy\n{energy}", f"pulse after\n{energy}", "speed"]
    yield TextTable(heads, rows, 0) if rows else "It never differs from its mean: no flywheel is needed."
    share = f.coefficient_of_energy
    work = f", {number(100 * share, 4)} % of the work of the cycle" if math.isfinite(share) else ""
    yield f"dE = {to.quantity('energy', f.size.energy)}{work}"
    yield _sizes(f, to)
    yield comparison(f, to)


def _sizes(f: Flywheel, to: Printed) -> TextTable:
    rows, unit = [], to.text("angular_speed")
    last = "no flywheel, exact" if _needless(f) else "for that Cs, exact"
    for name, s in (("by dE / (Cs w^2)", f.size), ("its exact speed", f.exact), (last, f.exact_size)):
        if s is not None:
            limits = s.limits if isinstance(s, FlywheelSize) else (s.least[0], s.greatest[0])
            speeds = [to.number("angular_speed", w) for w in limits]
            inertia = 0.0 if s is f.exact_size and _needless(f) else s.inertia
            rows.append([name, to.number("inertia", inertia), number(s.fluctuation, 5), *speeds])
    heads = ["flywheel", f"inertia\n{to.text('inertia')}", "Cs", f"least speed\n{unit}", f"greatest\n{unit}"]
    return TextTable(heads, rows)


def _needless(f: Flywheel) -> bool:
    """True if the links alone turn as steadily as required."""
    return f.exact_size is not None and f.exact_size.inertia < NONE * f.own


def comparison(f: Flywheel, to: Printed) -> str:
    """Sentence on the inertia that the textbook rule omits."""
    if f.exact is None:
        return f"No exact speed: {f.reason}."
    text = (
        f"The mean inertia of the links, reduced to "
        f"{f.drive}, is {to.quantity('inertia', f.own)}; dE / (Cs w^2) omits it, "
        f"so that with this flywheel Cs is {number(f.exact.fluctuation, 5)}"
        f"{_percent(f.exact, f.size.fluctuation)}. "
    )
    if f.exact_size is not None and _needless(f):
        text += "For the required Cs no flywheel is needed: that of the links alone is smaller. "
    elif f.exact_size is not None:
        rule = f.size.inertia - f.own
        text += f"For the required Cs {to.quantity('inertia', f.exact_size.inertia)} is enough"
        text += (
            f"; the rule minus the links' inertia gives {to.quantity('inertia', rule)}" if rule > 0 else ""
        )
        text += ". "
    elif f.reason:
        text += f"The flywheel for exactly that Cs cannot be computed: {f.reason}. "
    return f"{text}Check: the exact motion, prescribed, needs a torque constant to {remainder(f.exact.residual)}."


def _percent(s: SpeedFluctuation, required: float) -> str:
    if not required:
        return ""
    off = 100 * (s.fluctuation / required - 1)
    return f", {number(abs(off), 3)} % {'more' if off > 0 else 'less'}"
