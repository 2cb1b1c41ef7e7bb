"""The sheets of a result's workbook: every position, extremes, native charts, what the numbers rest on."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.summary.printed_series import extremes
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.analysis.result.number_kinds import drive_kinds, in_plane, unknown_kinds
from dalembert.analysis.result.reaction_axes import Axes
from dalembert.answer.column import Column, Scale, UnitChoice, nan_to_none
from dalembert.answer.table_rows import rows
from dalembert.answer.workbook import MOST_CURVES, MOST_DIAGRAMS, Diagram, Named, Tab, named, with_values
from dalembert.units import KINDS

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

SHOWN_UNITS = [
    "length",
    "angle",
    "force",
    "moment",
    "mass",
    "inertia",
    "angular_speed",
    "angular_acceleration",
]


def result_tabs(result: Result, units: UnitChoice, axes: Axes) -> Iterator[Tab]:
    """Positions, extremes, charts with their numbers, assumptions, title and source."""
    yield Tab("positions", rows(result, units, axes), freeze="C2")
    yield Tab("extremes", _extremes(result, units, axes), (34, 12, 16, 12, 18, 16, 12, 18))
    if len(result.status) > 1 and result.drives and result.stability is None:
        charts = [d for d in _diagrams(result, result.scale(units), axes) if d.curves]
        yield from [Tab("charts", charts=charts)] if charts else []
    yield Tab("assumptions", _assumptions(result, units, axes), (24, 100))
    yield Tab("about", result.basis().items(), (24, 100))


def _extremes(result: Result, units: UnitChoice, axes: Axes) -> Iterator[list[object]]:
    """Largest and smallest value of each effort, unknown load and reaction, with the position and the drives."""
    to = Printed(None if units == "SI" else result.mechanism.units)
    kinds = {drive: drive_kinds(result, drive)["position"] for drive in result.drives}
    places = [f"{drive} [{to.text(kind)}]" for drive, kind in kinds.items()]
    yield ["over the positions", "unit", "largest", "position", *places, "smallest", "position", *places]
    where = [nan_to_none(to(kind, result.drive_position(drive))) for drive, kind in kinds.items()]
    for e in extremes(result, to, axes):
        ends = ((e.largest, e.most), (e.smallest, e.least))
        cells = (cell for value, k in ends for cell in (value, k + 1, *(of[k] for of in where)))
        yield [e.name, e.unit, *cells]


def _assumptions(result: Result, units: UnitChoice, axes: Axes) -> Iterator[tuple[str, object]]:
    """The method, what was assumed, units, and how far the numbers can be trusted."""
    inertia = ", with inertia forces" if result.inertia else ""
    yield "method", f"equilibrium of all links at once, by one matrix{inertia}"
    yield from result.assumptions.items()
    yield "reactions", f"what the joint's first link exerts on its second, in {axes} axes"
    to = result.scale(units)
    yield from ((f"unit of {KINDS[kind].phrase.partition(' ')[2]}", to.text(kind)) for kind in SHOWN_UNITS)
    yield "positions", len(result.status)
    yield "positions solved", int(result.ok.sum())
    for name in ("residual", "power_balance"):
        values = np.abs(getattr(result, name))
        largest = float(np.nanmax(values)) if np.isfinite(values).any() else None
        yield f"largest {name.replace('_', ' ')}", largest
    yield "program", f"dalembert {sys.modules['dalembert'].__version__}"


def _diagrams(result: Result, to: Scale, axes: Axes) -> Iterator[Diagram]:
    """Efforts and unknown loads of one unit together, sizes of the largest joint forces, polar diagrams of pins."""
    first = result.drives[0]
    x = named(Column(first, drive_kinds(result, first)["position"], result.drive_position(first)), to)
    requested = {
        n: (result.effort if n in result.drives else result.unknown_load)(n) for n in unknown_kinds(result)
    }
    unknown = with_values(Named(n, to.text(k), to(k, requested[n])) for n, k in unknown_kinds(result).items())
    for unit in dict.fromkeys(of.unit for of in unknown):
        yield Diagram("Effort", x, [of for of in unknown if of.unit == unit])
    unit = to.text("force")
    forces = {joint: to("force", result.reaction(joint, axes=axes)) for joint in result.joints}
    sizes = with_values(Named(joint, unit, np.linalg.norm(force, axis=-1)) for joint, force in forces.items())
    sizes.sort(key=lambda of: -float(np.nan_to_num(of.values).max(initial=0.0)))
    yield Diagram("Joint forces", x, sizes[:MOST_CURVES])
    pins = [of.name for of in sizes if in_plane(result) and result.mechanism.joints[of.name].hinge]
    for joint in pins[:MOST_DIAGRAMS]:
        along, up = (Named(f"{joint}, force {c}", unit, forces[joint][:, k]) for k, c in enumerate("xy"))
        yield Diagram(f"Polar diagram of {joint}", along, [up], polar=True)
