"""Printed form of bearings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.summary.printed_series import where
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.machine.output.sizes_over_cycle import greatest
from dalembert.machine.whole_cycle import sampled
from dalembert.printing import Part, TextTable, number

if TYPE_CHECKING:
    from dalembert.machine.bearings.bearing_load import BearingLoad
    from dalembert.machine.bearings.bearing_table import BearingTable

PV_UNITS = (("MPa*m/s", 1e6), ("lbf/in^2*ft/min", 4.4482216152605 / 0.0254**2 * 0.3048 / 60))
"""In which makers give the limit of PV, with metres and with inches, and what one of it is in W/m^2."""


def _one_way(b: BearingLoad) -> str:
    """Motion of a joint that never turns back: all round, or not over these positions."""
    swept = float((np.abs(b.rate) * b.time).sum())
    return "continuous" if len(b.rate) == 1 or swept > 2 * math.pi * (1 - 1e-6) else "one way"


def bearing_parts(t: BearingTable, to: Printed) -> Iterator[Part]:
    """Loads, pressure and PV, life, and what is chosen."""
    force, rate = to.text("force"), to.text("angular_speed")
    pv, unit = PV_UNITS[to.text("length") in ("in", "ft", "yd")]
    loads, plain, rolling = [], [], []
    for joint, b in t.loads.items():
        size, k = greatest(b.radial)
        most, *others = (to.number("force", x) for x in (size, b.axial.max(), b.equivalent))
        turning = [
            to.number("angular_speed", b.speed),
            "oscillating" if b.swings else _one_way(b) if b.speed > 0 else "-",
        ]
        loads.append([joint, most, where(t.result, to, k), *others, *turning])
        if b.sized:
            values = [number(x / unit) for x in (float(b.pv.max()), b.mean_pv)]
            plain.append([joint, to.number("pressure", b.pressure.max()), *values])
        if b.bearing and b.bearing.rating:
            safety = "-" if b.static_safety is None else number(b.static_safety, 4)
            life = [number(b.turns / 1e6), number(b.hours), safety]
            rolling.append([joint, b.bearing.kind, to.number("force", b.bearing.rating), *life])
    heads = ["joint", f"radial force\n{force}", "at\n", f"axial\n{force}", f"equivalent\n{force}"]
    heads += [f"mean speed\n{rate}", "rotation\n"]
    if not any(b.axial.any() for b in t.loads.values()):
        heads, *loads = [[*row[:3], *row[4:]] for row in (heads, *loads)]
    yield TextTable(heads, loads)
    if plain:
        yield TextTable(
            ["joint", f"pressure\n{to.text('pressure')}", f"greatest PV\n{pv}", "mean PV\n"], plain
        )
    if rolling:
        life = ["L10\n10^6 turns", "L10\nhours", "C0 / load\n"]
        yield TextTable(["joint", "bearing", f"rating C\n{force}", *life], rolling, 2)
    if t.hours is not None:
        yield _choice(t, to)
    yield (
        "The equivalent load is weighted by the relative rotation of the joint's links; exponent 3, for rollers "
        "10/3. For oscillating joints, revolutions = swept angle / 360 deg."
    )
    if any(np.isnan(b.time).all() for b in t.loads.values()):
        yield (
            "The time of each position is not known, so PV, equivalent loads and lives are not computed; "
            "give a drive a range and a speed that is not 0 in it."
        )
    changes = {f"{what} of {j}": part for j, b in t.loads.items() for what, part in b.sampling().items()}
    yield sampled(t.result, changes)
    thrust = [j for j, b in t.loads.items() if np.isfinite(b.radial).all() and not np.isfinite(b.load).all()]
    if thrust:
        yield f"{', '.join(thrust)}: an axial force, but the bearing has no axial_factor for it."
    tilted = [f"{joint} ({to.quantity('moment', b.tilting)})" for joint, b in t.loads.items() if b.tilting]
    if tilted:
        yield (
            f"{', '.join(tilted)}: a couple normal to the axis, the largest in brackets, that load and life do not "
            "include; model two joints if two bearings carry it."
        )


def _choice(t: BearingTable, to: Printed) -> TextTable:
    rows, hours, force = [], t.hours or 0.0, to.text("force")
    for joint, b in t.loads.items():
        needed, row = b.rating_for(hours, t.factor), t.chosen.get(joint)
        cells = [
            "no table given" if not t.rows else "none is enough" if needed == needed else "-",
            "",
            "",
            "",
        ]
        if row:
            cells = [row.name, *(to.number("force", x) for x in (row.C, row.C0)), to.number("length", row.d)]
        rows.append([joint, to.number("force", needed), *cells])
    heads = ["joint", f"C needed\n{force}", "chosen\n", f"C\n{force}", "C0\n", f"bore\n{to.text('length')}"]
    factor = f", with {number(t.factor)} times the load" if t.factor != 1 else ""
    return TextTable(heads, rows, note=f"For {number(hours)} hours{factor}.")
