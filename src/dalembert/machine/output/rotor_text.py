"""Printed form of a rotor balanced in two planes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.machine.output.balance_text import comparison_table, turned
from dalembert.printing import Part, TextTable, number, remainder, round_components

if TYPE_CHECKING:
    from dalembert.machine.balance.rotors import RotorBalance


def rotor_parts(b: RotorBalance, to: Printed) -> Iterator[Part]:
    """The unbalance, the two corrections, and what is left."""
    length, mass, rows = to.text("length"), to.text("mass"), []
    s, t = b.unbalance
    couple = float(to("inertia", abs(t)))
    yield (
        f"Unbalance of {b.shaft} and all that turns with it, from {b.before.about} on the axis: sum of m r "
        f"{number(float(to('mass', to('length', abs(s)))))} {mass}*{length} at {_angle(s)}, sum of m r z "
        f"{number(couple)} {to.text('inertia')} at {_angle(t)}."
    )
    for z, moment, angle, m, center in zip(b.planes, b.moment, b.angle, b.masses, b.centers, strict=True):
        place = map(number, round_components([float(to("length", v)) for v in center]))
        radius = to.number("length", moment / m) if m else "-"
        cells = [to.number("mass", to("length", moment)), turned(angle), radius, to.number("mass", m)]
        rows.append([to.number("length", z), *cells, *place])
    heads = [
        f"plane at\n{length}",
        f"m r\n{mass}*{length}",
        "angle\ndeg",
        f"radius\n{length}",
        f"mass\n{mass}",
    ]
    yield TextTable([*heads, *(f"{x}\n{length}" for x in ("centre x", "y", "z"))], rows, 0)
    yield (
        f"Planes along the axis from {b.before.about}, in the sense in which the shaft turns; angles about it from "
        f"the {b.zero} axis of {b.shaft}, centres in its axes."
    )
    yield comparison_table(b, to)
    if not b.moment.any():
        yield "The rotor was balanced already: no correction is needed."
    else:
        yield f"Recomputed with both corrections, the unbalance left is {remainder(b.residual)} of the corrections."


def _angle(u: complex) -> str:
    return f"{turned(float(np.angle(u)))} deg"
