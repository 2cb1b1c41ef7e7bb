"""Printed form of brakes and clutches: torque, force, pressure, and how far friction helps."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.brake_answer import BandBrake, Brake, FaceBrake, ShoeBrake, brake
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.printing import Part, TextTable, number

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

LEAST = 1e-6
"""Change of a force by friction at the contact that counts as none."""


def brake_parts(r: Result, to: Printed) -> Iterator[Part]:
    """A row and a verdict for each brake at the only position."""
    names = [name for name, part in r.mechanism.joints.items() if part.BRAKES]
    out = [brake(r, name) for name in names if _rubs(r, name)]
    if not out:
        return
    heads = [
        "brake",
        f"torque\n{to.text('moment')}",
        f"force\n{to.text('force')}",
        f"p_max\n{to.text('pressure')}",
    ]
    heads += [f"p v\n{to.text('pressure_speed')}", "grabs\nfrom mu", "now\nmu"]
    rows = [[b.joint, *_cells(b, to)] for b in out]
    verdicts = [f"{b.joint}: {text}." for b in out if (text := "; ".join(_verdicts(b, to)))]
    yield TextTable(heads, rows, 1, "\n".join(verdicts))


def _rubs(r: Result, name: str) -> bool:
    """True where the friction of a brake is known."""
    clamped = name in r.unknown_loads
    return clamped or (
        r.friction is not None and getattr(r.mechanism.joints[name], "friction", None) is not None
    )


def _cells(b: Brake, to: Printed) -> list[str]:
    sizes = (("moment", b.torque), ("force", b.force), ("pressure", b.pressure), ("pressure_speed", b.pv))
    cells = [_text(to, kind, float(values[0])) for kind, values in sizes]
    return [*cells, _finite(b.locking_coefficient), _finite(b.coefficient)]


def _text(to: Printed, kind: str, value: float) -> str:
    return "-" if math.isnan(value) else to.number(kind, value)


def _finite(value: float) -> str:
    return number(value, 4) if math.isfinite(value) else "-"


def _verdicts(b: Brake, to: Printed) -> Iterator[str]:
    """A textbook's figures for it."""
    helped = float(b.self_energising[0])
    if abs(helped - 1) > LEAST:
        yield (
            f"self-energising by {helped:.3g}" if helped > 1 else f"de-energising, {helped:.3g} of the force"
        )
    if isinstance(b, BandBrake):
        ends = to.quantity("force", float(b.tight[0])), to.quantity("force", float(b.slack[0]))
        yield f"tensions {ends[0]} and {ends[1]}, ratio {float(b.ratio[0]):.6g}"
    if isinstance(b, ShoeBrake) and np.isfinite(b.place):
        moments = (to.quantity("moment", float(m[0])) for m in (b.normal_moment, b.friction_moment))
        yield "moments about its point {} of the pressure, {} of friction".format(*moments)
    if isinstance(b, FaceBrake):
        yield f"friction radius {to.quantity('length', b.friction_radius)}"
        if np.isfinite(b.oil[0]):
            yield f"oil pressure {to.quantity('pressure', float(b.oil[0]))}"
        if np.isfinite(b.push_in[0]):
            off = float(b.draw_off[0])
            in_, out = (to.quantity("force", float(f[0])) for f in (b.push_in, b.draw_off))
            drawn = f"{out} draw it off" if off > 0 else "it comes off by itself"
            yield f"{in_} push it in without slip, {drawn}"
