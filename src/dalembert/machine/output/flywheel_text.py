"""A flywheel as a person reads it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.machine.flywheel.flywheel_size import FlywheelSize
from dalembert.machine.flywheel.speed_fluctuation import SpeedFluctuation
from dalembert.printing import Part, Table, number, remainder, round_components

if TYPE_CHECKING:
    from dalembert.machine.flywheel.flywheels import Flywheel

NONE = 1e-6
"""Part of the links' own inertia below which a flywheel is none."""


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
        "the mean, E is the energy asked for above it since the first position, the pulses are the areas between."
    )
    heads = [f"{f.drive}\n{angle}", f"energy\n{energy}", f"pulse after\n{energy}", "speed"]
    yield Table(heads, rows, 0) if rows else "It never differs from its mean: no flywheel is needed."
    share = f.coefficient_of_energy
    work = f", {number(100 * share, 4)} % of the work of the cycle" if math.isfinite(share) else ""
    yield f"dE = {to.quantity('energy', f.size.energy)}{work}"
    yield _sizes(f, to)
    yield comparison(f, to)


def _sizes(f: Flywheel, to: Printed) -> Table:
    rows, unit = [], to.text("angular_speed")
    last = "no flywheel, exact" if _needless(f) else "for that Cs, exact"
    for name, s in (("by dE / (Cs w^2)", f.size), ("its exact speed", f.exact), (last, f.exact_size)):
        if s is not None:
            limits = s.limits if isinstance(s, FlywheelSize) else (s.least[0], s.greatest[0])
            speeds = [to.number("angular_speed", w) for w in limits]
            inertia = 0.0 if s is f.exact_size and _needless(f) else s.inertia
            rows.append([name, to.number("inertia", inertia), number(s.fluctuation, 5), *speeds])
    heads = ["flywheel", f"inertia\n{to.text('inertia')}", "Cs", f"least speed\n{unit}", f"greatest\n{unit}"]
    return Table(heads, rows)


def _needless(f: Flywheel) -> bool:
    """Whether the links alone turn as steadily as is asked."""
    return f.exact_size is not None and f.exact_size.inertia < NONE * f.own


def comparison(f: Flywheel, to: Printed) -> str:
    """What the book's rule leaves out, in a sentence."""
    if f.exact is None:
        return f"No exact speed: {f.reason}."
    said = (
        f"The links have an inertia of their own of {to.quantity('inertia', f.own)} on the mean, as seen from "
        f"{f.drive}, which dE / (Cs w^2) leaves out: with that flywheel Cs is {number(f.exact.fluctuation, 5)}"
        f"{_percent(f.exact, f.size.fluctuation)}. "
    )
    if f.exact_size is not None and _needless(f):
        said += "For the Cs asked for no flywheel is needed: that of the links alone is smaller. "
    elif f.exact_size is not None:
        rule = f.size.inertia - f.own
        said += f"For the Cs asked for {to.quantity('inertia', f.exact_size.inertia)} will do"
        said += (
            f"; the rule less the links' own inertia says {to.quantity('inertia', rule)}" if rule > 0 else ""
        )
        said += ". "
    elif f.reason:
        said += f"The flywheel for just that Cs is not found: {f.reason}. "
    return f"{said}The exact motion, prescribed, asks for a constant torque within {remainder(f.exact.residual)}."


def _percent(s: SpeedFluctuation, asked: float) -> str:
    if not asked:
        return ""
    off = 100 * (s.fluctuation / asked - 1)
    return f", {number(abs(off), 3)} % {'more' if off > 0 else 'less'}"
