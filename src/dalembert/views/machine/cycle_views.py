"""Charts over the cycle of machine design: balance, bearings, flywheel, motor; a simulated motion over time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import magnitude
from dalembert.analysis.result.named_quantities import quantity
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.balance.comparison import Comparison, values_of
from dalembert.views.charts import MOST, along, polar_chart
from dalembert.views.not_shown import refuse_still
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.diagrams import curves_scene, polar_scene
from dalembert.views.paper.scene import Scene

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.machine.balance.balancing import Balance
    from dalembert.machine.balance.rotors import RotorBalance
    from dalembert.machine.bearings.bearing_table import BearingTable
    from dalembert.machine.flywheel.flywheels import Flywheel
    from dalembert.machine.motion.simulation import Simulation
    from dalembert.machine.motors.motor_choice import MotorChoice

NOTHING = 1e-6
"""Gain or cost of a trade-off, in per cent, below which it is ignored."""


@dataclass(frozen=True)
class ChartAxis:
    """Abscissa of charts: values in the reader's unit, their label, and whether they are degrees."""

    shown: Shown
    values: Array
    label: str
    degrees: bool = False

    def chart(self, kind: str, curves: Mapping[str, Array], title: str, about: str = "") -> Scene:
        """Chart of curves, SI, of one kind of number, with an optional remark on the axis."""
        series = {name: values / self.shown.size(kind) for name, values in curves.items()}
        label = f"{(about or kind).capitalize()} in {self.shown.unit(kind)}"
        return curves_scene(self.values, series, self.label, label, title, self.degrees)

    def percents(self, curves: Mapping[str, Array], title: str, label: str) -> Scene:
        """Chart of numbers in per cent."""
        return curves_scene(self.values, curves, self.label, f"{label} in %", title, self.degrees)


def cycle_axis(r: Result, notation: Notation) -> ChartAxis:
    """The first drive, or the number of the position, once at each: what answers have of a position is just before it
    where the result has two sides."""
    shown = Shown(r, notation)
    return ChartAxis(shown, *along(r.before, shown))


def balance_scenes(b: Balance, notation: Notation) -> list[Scene]:
    """Force (in the plane a polar diagram, in space its magnitude), moment and torque over the cycle, the trade-off."""
    axis = cycle_axis(b.result, notation)
    return [*comparison_scenes(b, axis), *_trade_off(b, axis)]


def rotor_scenes(b: RotorBalance, notation: Notation) -> list[Scene]:
    """Magnitudes of force and moment over the cycle, and the torque."""
    return comparison_scenes(b, cycle_axis(b.result, notation))


def comparison_scenes(b: Comparison, axis: ChartAxis) -> list[Scene]:
    """Force (in the plane a polar diagram, in space its magnitude), moment and torque, before and after."""
    sides, plane = {"before": b.before, "after": b.after}, b.result.mechanism.dimension == 2
    by_name = {name: {side: values_of(s)[name] for side, s in sides.items()} for name in values_of(b.before)}
    out = []
    if plane:
        scaled = {side: values / axis.shown.size("force") for side, values in by_name.pop("force").items()}
        out.append(polar_scene(scaled, axis.shown.unit("force"), "Shaking force"))
    if len(b.result.status) < 3 or not b.result.drives:
        return out
    titles = {"force": "shaking force", "moment": f"shaking moment about {b.before.about}"}
    for name, both in by_name.items():
        kind = b.kind(name)
        sizes = {side: v if v.ndim == 1 else magnitude(v) for side, v in both.items()}
        title = titles.get(name, f"{'force' if kind == 'force' else 'torque'} of {b.result.drives[0]}")
        title = f"Magnitude of the {title}" if not plane and name in titles else title[0].upper() + title[1:]
        if max(np.abs(v).max() for v in sizes.values()) > b.before.floor(kind):
            out.append(axis.chart(kind, sizes, title))
    return out


def _trade_off(b: Balance, axis: ChartAxis) -> list[Scene]:
    """The minimized quantity against the first one that is not, where one increases as the other decreases."""
    if len(b.result.status) < 3 or not b.result.drives:
        return []
    others = [name for name in ("torque", "force", "moment") if name in b.problem.base and name not in b.of]
    other: str | None = next(iter(others), None)
    try:
        pairs = 100 * np.array(b.trade_off(other) if other else [(0.0, 0.0)])
    except ModelError:  # the other asks for bounds that are not given
        return []
    if not other or np.ptp(pairs, axis=0).min() < NOTHING:
        return []
    of = " and ".join(b.of)
    title, left = f"Trade-off: {b.least} of {of} against {other}", {other: pairs[:, 1]}
    return [ChartAxis(axis.shown, pairs[:, 0], f"{of} left in %").percents(left, title, f"{other} left")]


def bearing_scenes(t: BearingTable, notation: Notation) -> list[Scene]:
    """Polar diagrams of the first joints, in ground axes and the link's (where it wears), their forces and turning."""
    r, some, axis = t.result, [*t.loads.items()][:MOST], cycle_axis(t.result, notation)
    out: list[Scene] = []
    if r.mechanism.dimension == 2:
        out = [polar_chart(r, [joint], axes, notation) for joint, _ in some for axes in ("ground", "link")]
    series = {
        "Radial force": ("force", {j: b.radial for j, b in some}),
        "Turning": ("angular_speed", {j: b.rate for j, b in some}),
        "Pressure": ("pressure", {j: b.pressure for j, b in some if b.sized}),
    }
    drawn = {title: both for title, both in series.items() if both[1] and len(r.status) > 1}
    return out + [axis.chart(kind, v, f"{title} of the joints", title) for title, (kind, v) in drawn.items()]


def flywheel_scenes(f: Flywheel, notation: Notation) -> list[Scene]:
    """The turning-moment diagram with its mean, the energy curve, and the exact speeds, each over the period."""
    shown, q = Shown(f.result, notation), f.result.drive_position(f.drive)
    unit = shown.unit("angle")
    axis = ChartAxis(shown, q / shown.size("angle"), f"{f.drive} in {unit}", unit == "°")
    torque = {"effort": f.torque, "mean": np.full_like(f.torque, f.mean)}
    out = [axis.chart("moment", torque, "Turning moment", "torque")]
    out.append(axis.chart("energy", {"E": f.energy}, "Energy above the mean"))
    if f.exact is None:
        return out
    some = {"book's flywheel": f.exact} | ({"exact for Cs": f.exact_size} if f.exact_size else {})
    speeds = {n: np.interp(np.sort(q), s.angle, s.speed) for n, s in some.items()}
    percents = {n: 100 * (speed / abs(f.size.speed) - 1) for n, speed in speeds.items()}
    axis = ChartAxis(shown, np.sort(q) / shown.size("angle"), axis.label, axis.degrees)
    return [*out, axis.percents(percents, "Speed off its mean", "Speed off its mean")]


def motor_scenes(c: MotorChoice, notation: Notation) -> list[Scene]:
    """Effort, speed and power of the drive; torque of the motor for each ratio, with what the curve allows."""
    refuse_still(c.result, "a chart")
    axis, kinds, out = cycle_axis(c.result, notation), drive_kinds(c.result, c.drive), []
    for name in ("effort", "speed", "power"):
        title = f"{name.capitalize()} of {c.drive}"
        out.append(axis.chart(kinds.get(name, name), {name: getattr(c, name)}, title, name))
    for name, need in c.needs.items():
        series, allowed = {"torque": c.torque(need.ratio)}, c.allowed(need.ratio)
        if np.isfinite(allowed).any():
            series["allowed"] = allowed
        title = f"Motor, {name}: ratio {notation.number(need.ratio)}"
        out.append(axis.chart("moment", series, title, "torque"))
    return out


def simulation_scenes(s: Simulation, notation: Notation) -> list[Scene]:
    """Speed and effort of each drive, the curves asked for, and the energies, over time."""
    shown, out = Shown(s.result, notation), []
    axis = ChartAxis(shown, s.time / shown.size("time"), f"Time in {shown.unit('time')}")
    for k, drive in enumerate(s.drives):
        kinds = drive_kinds(s.result, drive)
        for what, values in (("speed", s.speed(drive)), ("effort", s.applied[:, k])):
            out.append(axis.chart(kinds[what], {what: values}, f"{what.capitalize()} of {drive}", what))
    energies = {"kinetic": s.kinetic, "potential": s.potential - s.potential[0]}
    energies |= {f"work of {name}": w for name, w in s.works.items()}
    series = {name: e for name, e in energies.items() if np.abs(e).max() > 0}
    out += [_named_chart(s, name, axis) for name in s.curves]
    return [*out, *([axis.chart("energy", series, "Energies and works")] if series else [])]


def _named_chart(s: Simulation, name: str, axis: ChartAxis) -> Scene:
    """A quantity over time, of a vector the components and the magnitude."""
    kind, values = quantity(s.result, name)
    series = {name: values}
    if values.ndim > 1:
        series = dict(zip("xyz", values.T, strict=False)) | {"magnitude": np.asarray(magnitude(values))}
    return axis.chart(kind, series, name, kind.replace("_", " "))
