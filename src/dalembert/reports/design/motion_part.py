"""The motion: positions without an answer, ranges of joints, curves, numerical checks."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from dalembert.analysis.methods.applied_forces import magnitude
from dalembert.analysis.methods.elements.cylinder_quantities import cylinders
from dalembert.arrays import Array
from dalembert.machine.whole_cycle import is_period
from dalembert.model.drives.cylinders import PARTS
from dalembert.printing import remainder
from dalembert.reports.design.verdict import DesignContext, DesignPart, DesignVerdict, State, not_judged
from dalembert.views.charts import MOST
from dalembert.views.machine.cycle_views import ChartAxis, cycle_axis
from dalembert.views.paper.scene import Scene

UNKNOWN = ("redundant", "at_rest", "undefined_load", "outside_table", "freewheels")
"""Statuses that leave something open, and break no limit."""
CLOSED = 1e-9
"""Residual within which the equations hold."""
TURNING, SLIDING = ("angular_speed", "angular_acceleration"), ("length", "speed", "acceleration")


def motion_part(c: DesignContext) -> Iterator[DesignPart]:
    """Verdicts on the positions, ranges of the joints, and curves where there are several positions."""
    part, r = DesignPart("Motion"), c.r
    part.verdicts += list(_positions(c))
    part.sheet.table(["Joint or drive", "Motion", "From", "To", "Range"], _ranges(c))
    part.sheet.figure(*(_curves(c) if len(r.status) >= 3 else ()))
    yield part


def _positions(c: DesignContext) -> Iterator[DesignVerdict]:
    r, count = c.r, len(c.r.status)
    problems = r.problems()
    if r.ok.any():
        solved, text = bool(r.ok.all()), f"{int(r.ok.sum())} of {count}"
        yield DesignVerdict(
            "positions solved", "ok" if solved else "not judged", text, remark="" if solved else "see below"
        )
    for which, code, sentence in problems:
        state: State = "not judged" if code in UNKNOWN else "exceeded"
        yield DesignVerdict(f"position {which}" if count > 1 else code, state, remark=sentence.rstrip("."))
    known = [np.abs(x[np.isfinite(x)]) for x in (r.residual, r.power_balance)]
    if not known[0].size:
        yield not_judged("equilibrium", "no position has forces")
        return
    worst = max(float(x.max(initial=0.0)) for x in known)
    value = f"{remainder(float(known[0].max()))}, power balance {remainder(float(known[1].max(initial=0.0)))}"
    yield DesignVerdict("equilibrium holds to", "ok" if worst < CLOSED else "exceeded", value)


def _ranges(c: DesignContext) -> list[list[str]]:
    """The range of each freedom of a joint that moves."""
    rows, r = [], c.r
    for joint, freedom in r.compiled.freedoms:
        values = r.freedom(joint, freedom)[0]
        kind = "length" if freedom.startswith("slide") else "angle"
        low, high = float(np.nanmin(values, initial=np.inf)), float(np.nanmax(values, initial=-np.inf))
        if not np.isfinite([low, high]).all() or high - low < 1e-12 * max(1.0, abs(high)):
            continue
        ends = [c.text(kind, x) for x in (low, high, high - low)]
        if kind == "angle" and joint in r.drives and is_period(values):
            ends[2] = "full turns"
        rows.append([joint, freedom, *ends])
    return rows


def _curves(c: DesignContext) -> list[Scene]:
    """Slides, and turning of the links, with their rates, over the cycle."""
    r = c.r.before
    axis = cycle_axis(r, c.notation)
    slides = [(j, f) for j, f in r.compiled.freedoms if f.startswith("slide")]
    out: list[Scene] = []
    for order, kind in enumerate(SLIDING):
        out += _chart(axis, kind, {j: r.freedom(j, f)[order] for j, f in slides}, "slides", order)
    hidden = {f"{name}_{half}" for name in cylinders(r.mechanism) for half in PARTS}
    links = [link for link in r.links if link not in hidden]
    reads: tuple[Callable[[str], Array], ...] = (r.speed, r.acceleration)
    for order, (kind, read) in enumerate(zip(TURNING, reads, strict=True), 1):
        out += _chart(axis, kind, {link: _size(read(link)) for link in links}, "links", order)
    return out


def _size(values: Array) -> Array:
    return values if values.ndim == 1 else np.asarray(magnitude(values))


WORDS = ("", "Speed of the ", "Acceleration of the ")


def _chart(axis: ChartAxis, kind: str, curves: dict[str, Array], of: str, order: int) -> Iterator[Scene]:
    """Charts of those that change, a few curves in each."""
    known = {n: v for n, v in curves.items() if np.isfinite(v).any()}
    most = max((float(np.nanmax(np.abs(v))) for v in known.values()), default=0.0)
    moving = {n: v for n, v in known.items() if np.nanmax(v) - np.nanmin(v) > 1e-9 * most}
    names = list(moving)
    for k in range(0, len(names), MOST):
        title = f"{WORDS[order]}{of}".capitalize()
        about = kind.replace("_", " ")
        yield axis.chart(kind, {n: moving[n] for n in names[k : k + MOST]}, title, about)
