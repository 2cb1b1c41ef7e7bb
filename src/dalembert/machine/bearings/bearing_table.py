"""The bearings of all joints of a machine, and the choice of one for each from a table."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from dalembert.answer.column import Axes, Column, Scale
from dalembert.arrays import Tree
from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.machine.bearings.bearing_load import BearingLoad, bearing, turning_joints
from dalembert.machine.bearings.catalogue import CatalogueBearing, catalogue, choose
from dalembert.machine.output.machine_answer import MachineAnswer

if TYPE_CHECKING:
    from dalembert.analysis.output.summary.printed_units import Printed
    from dalembert.analysis.result.result import Result
    from dalembert.printing import Part
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation, Shown
    from dalembert.views.paper.scene import Scene


@dataclass(frozen=True, eq=False)
class BearingTable(MachineAnswer):
    """Loads by joint; ``hours`` of life asked for, the load times ``factor``; ``chosen`` from a table of ``rows``.

    >>> import dalembert as da
    >>> list(da.bearings(da.dynamics(da.slider_crank())).loads)
    ['O2', 'A', 'B']
    """

    result: Result = field(repr=False)
    loads: dict[str, BearingLoad]
    hours: float | None = None
    factor: float = 1.0
    rows: int = 0
    chosen: dict[str, CatalogueBearing | None] = field(default_factory=dict)

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """The drives' positions; forces and turning of each joint, pressure and PV of those with a size."""
        yield from self.drive_columns()
        for joint, b in self.loads.items():
            yield Column(f"radial_force.{joint}", "force", b.radial)
            if b.axial.any():
                yield Column(f"axial_force.{joint}", "force", b.axial)
            if b.tilting:
                yield Column(f"couple_across.{joint}", "moment", b.couple)
            yield Column(f"turning_speed.{joint}", "angular_speed", b.rate)
            if b.sized:
                yield Column(f"pressure.{joint}", "pressure", b.pressure)
                yield Column(f"pv.{joint}", "pressure_speed", b.pv)

    def record(self, to: Scale) -> Tree:
        """Equivalent load, life and what was chosen, in the units of a scale."""
        out: Tree = {}
        for joint, b in self.loads.items():
            entry = out[joint] = {"equivalent_load": to("force", b.equivalent), "swings": b.swings}
            entry["couple_not_counted"] = to("moment", b.tilting)
            entry["sampling"] = b.sampling()
            entry["mean_turning"] = to("angular_speed", b.speed)
            if b.sized:
                entry |= {
                    "pressure": to("pressure", b.pressure.max()),
                    "mean_PV": b.mean_pv,
                    "PV": b.pv.max(),
                }
            if b.bearing and b.bearing.rating:
                entry |= {"turns": b.turns, "hours": b.hours, "static_safety": b.static_safety}
            if self.hours:
                entry["rating_needed"] = to("force", b.rating_for(self.hours, self.factor))
                row = self.chosen.get(joint)
                entry["chosen"] = row.name if row else None
        return {"bearings": out, "hours": self.hours, "factor": self.factor}

    def printed(self, to: Printed, **choice: Any) -> Iterator[Part]:
        """Printed answer, in the units of a scale."""
        from dalembert.machine.output.bearing_text import bearing_parts

        return bearing_parts(self, to, **choice)

    def scenes(self, notation: Notation) -> list[Scene]:
        """Its drawings in a notation."""
        from dalembert.views.machine.cycle_views import bearing_scenes

        return bearing_scenes(self, notation)

    def section(self, sheet: ReportSheet, shown: Shown) -> None:
        """Its equations in letters and numbers, put on a sheet."""
        from dalembert.reports.machine_sections.design_sections import bearing_section

        bearing_section(sheet, self, shown)


def bearings(
    r: Result,
    joints: Iterable[str] | None = None,
    hours: float | None = None,
    table: str | Path | None = None,
    factor: float = 1.0,
    safety: float = 1.0,
) -> BearingTable:
    """Bearings of the joints asked for, or of all that turn: pressure, PV, equivalent load, life, and a choice.

    ``hours``: the life to be had with the load times ``factor``; ``table``: a text file with columns name, C, C0, d, of
    which the smallest row is chosen that lives so long and whose C0 is ``safety`` times the largest load.

    >>> import dalembert as da
    >>> list(bearings(da.dynamics(da.slider_crank())).loads)
    ['O2', 'A', 'B']
    """
    for key, value in (("hours", hours), ("factor", factor), ("safety", safety)):
        require(key, value)
    names = [joints] if isinstance(joints, str) else list(joints or turning_joints(r))
    loads = {joint: bearing(r, joint) for joint in names}
    if not loads:
        raise ModelError("no joint turns about one axis", "give the machine a pin")
    if table is None:
        return BearingTable(r, loads, hours, factor)
    if hours is None:
        raise ModelError(
            "a bearing is chosen from a table by its required life", "give the hours, for example 20000"
        )
    rows = catalogue(table, r.mechanism.units)
    chosen = {joint: choose(b, rows, hours, factor, safety) for joint, b in loads.items()}
    return BearingTable(r, loads, hours, factor, len(rows), chosen)
