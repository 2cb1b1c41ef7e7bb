"""Charts of a result: efforts and joint forces over the cycle, polar diagrams, the shaking force."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from operator import methodcaller
from typing import TYPE_CHECKING, Literal

import numpy as np

from dalembert.analysis.methods.applied_forces import magnitude
from dalembert.analysis.output import rounding
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.analysis.result.reaction_axes import Axes
from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError
from dalembert.machine.harmonics import whole_turns
from dalembert.machine.shaking import shaking_force
from dalembert.model import GROUND
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.diagrams import Ticks, curves_scene, inner_ticks, polar_scene
from dalembert.views.paper.scene import Scene
from dalembert.views.space.space_view import NOTHING

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

MOST = 6
"""Largest number of curves of one chart that remain distinguishable."""


READS = {"force": "reaction", "moment": "reaction_moment"}
"""Methods of a result that return a joint's force and moment."""


def stepped_series(r: Result, read: Callable[[Result], Array]) -> Array:
    """Values of ``read`` at every position, twice where contacts reverse: just before and just after, in the order of
    the list."""
    values = read(r.before)
    if r.after is None:
        return values
    behind, back = read(r.after), _backwards(r)
    rows: list[Array] = []
    for k, twice in enumerate(r.reverses):
        both = [values[k], behind[k]] if twice else [values[k]]
        rows += reversed(both) if back[k] else both
    return np.array(rows)


def _backwards(r: Result) -> Flags:
    """True where the list of positions runs against the motion of the first drive."""
    if not r.drives or len(r.status) < 2 or r.schedule.time is not None:
        return np.zeros(len(r.status), bool)
    step = np.diff(r.drive_position(r.drives[0]))
    return np.asarray(np.append(step, step[-1]) * r.drive_speed(r.drives[0]) < 0)


def along(r: Result, shown: Shown) -> tuple[Array, str, bool]:
    """Abscissa of charts: the first drive, or the number of the position."""
    if not r.drives:
        return stepped_series(r, lambda side: np.arange(1.0, len(side.status) + 1)), "position", False
    kind = drive_kinds(r, r.drives[0])["position"]
    places = stepped_series(r, lambda side: side.drive_position(side.drives[0]))
    values = np.asarray(shown.values(kind, places), float)
    unit = shown.unit(kind)
    return values, f"{r.drives[0]} in {unit}", unit == "°"


def effort_chart(r: Result, notation: Notation | None = None) -> list[Scene]:
    """Efforts over the cycle with the mean of each, torques and forces in separate charts."""
    shown = Shown(r, notation or Notation())
    x, label, angle = along(r, shown)
    out = []
    for kind in ("moment", "force"):
        names = [d for d in r.drives if drive_kinds(r, d)["effort"] == kind]
        efforts = {d: stepped_series(r, methodcaller("effort", d)) for d in names}
        series = {d: np.asarray(shown.values(kind, v), float) for d, v in efforts.items()}
        means = {d: mean_effort(r, d) for d in names}
        known = {d: v for d, v in means.items() if v is not None}
        levels = {f"mean of {d}: {shown.number(kind, v)}": shown.value(kind, v) for d, v in known.items()}
        if series:
            y_label = f"{'Torque' if kind == 'moment' else 'Force'} in {shown.unit(kind)}"
            out.append(curves_scene(x, series, label, y_label, "Drive effort", angle, levels))
    return out


def mean_effort(r: Result, drive: str) -> float | None:
    """Work of a drive's effort over its travel, by the trapezoidal rule (N m or N); None where an effort is unknown, or
    the drive returns to its first position. For full turns, a last step closes the cycle."""
    effort = stepped_series(r, methodcaller("effort", drive))
    place = stepped_series(r, methodcaller("drive_position", drive))
    if len(place) > 2 and drive_kinds(r, drive)["effort"] == "moment":
        try:
            turned = math.copysign(2 * math.pi * whole_turns(r.drive_position(drive)), place[-1] - place[0])
            effort, place = np.append(effort, effort[0]), np.append(place, place[0] + turned)
        except ModelError:
            pass
    travel = float(place[-1] - place[0])
    if not np.isfinite(effort).all() or abs(travel) <= 1e-9 * float(np.ptp(place)):
        return None
    mean = float(np.trapezoid(effort, place)) / travel
    return mean if abs(mean) > 1e-9 * float(np.abs(effort).max()) else 0.0


def reaction_charts(r: Result, notation: Notation | None = None, joints: Sequence[str] = ()) -> list[Scene]:
    """Magnitudes of joint forces over the cycle, six joints per chart."""
    return _size_charts(r, "force", joints or r.joints, notation)


def _size_charts(r: Result, kind: str, joints: Sequence[str], notation: Notation | None) -> list[Scene]:
    shown = Shown(r, notation or Notation())
    x, label, angle = along(r, shown)
    out, floor = [], rounding.PART * float(np.nanmax(rounding.sizes(r)[kind], initial=0.0))
    many = -(-len(joints) // MOST)
    each = -(-len(joints) // max(many, 1))  # as many in one as in another
    for first in range(0, len(joints), max(each, 1)):
        some = joints[first : first + each]
        values = {n: magnitude(stepped_series(r, methodcaller(READS[kind], n))) for n in some}
        sizes = {n: np.where(v <= floor, 0.0, v) / shown.size(kind) for n, v in values.items()}
        y_label = f"Joint {kind} in {shown.unit(kind)}"
        out.append(curves_scene(x, sizes, label, y_label, f"Joint {kind}s", angle))
    return out


def components_chart(
    r: Result, joint: str, notation: Notation | None = None, kind: Literal["force", "moment"] = "force"
) -> Scene:
    """Components and magnitude of one joint's force or moment over the cycle; in space in the joint's axes."""
    shown = Shown(r, notation or Notation())
    space = r.mechanism.dimension == 3
    axes: Axes = "joint" if space else "ground"
    components = stepped_series(r, methodcaller(READS[kind], joint, axes=axes)) / shown.size(kind)
    on = shown.heading(r.mechanism.joints[joint].links[1])
    title = f"Joint {joint}: {kind} on link {on}" + (", joint's axes" if space else "")
    return vector_chart(r, components, kind, title, shown)


def vector_chart(r: Result, vectors: Array, kind: str, title: str, shown: Shown) -> Scene:
    """Components and magnitude of vectors in the reader's unit over the cycle, given as by ``stepped_series``."""
    x, label, angle = along(r, shown)
    series = dict(zip("xyz", vectors.T, strict=False)) | {"magnitude": magnitude(vectors)}
    return curves_scene(x, series, label, f"{kind.capitalize()} in {shown.unit(kind)}", title, angle)


def crank_ticks(r: Result, shown: Shown) -> Ticks:
    """Positions nearest to round values of the first drive, with those values, for polar diagrams."""
    if not r.drives:
        return ()
    x, label, angle = along(r, shown)
    known = x[np.isfinite(x)]
    if known.size < 3:
        return ()
    low, high, step = float(known.min()), float(known.max()), float(np.nanmax(np.abs(np.diff(x))))
    unit = "°" if angle else f" {label.rpartition(' in ')[2]}"
    ticks = [(int(np.nanargmin(np.abs(x - t))), t) for t in inner_ticks(low, high, 12, angle)]
    return [(k, f"{t:g}{unit}".replace("-", "−")) for k, t in ticks if abs(float(x[k]) - t) <= 0.51 * step]


def polar_path(r: Result, joint: str, axes: str, shown: Shown) -> tuple[str, Array]:
    """Link that a joint's force is drawn on (j, unless that is the ground and link axes are requested), and the forces
    in the reader's unit (P, 2)."""
    i, j = r.mechanism.joints[joint].links
    on, seen = j if axes == "ground" or j != GROUND else i, "link" if axes == "link" else "ground"
    path = stepped_series(r, methodcaller("reaction", joint, on=on, axes=seen))
    return on, path * shown.value("force", 1.0)


def polar_chart(
    r: Result, joints: Sequence[str], axes: str = "ground", notation: Notation | None = None
) -> Scene:
    """Polar diagrams of joint forces in ground axes, or in the axes of the link (where a bearing wears), with the first
    drive's positions marked."""
    shown = Shown(r, notation or Notation())
    paths, title = {}, "Joint forces"
    for joint in joints:
        on, paths[joint] = polar_path(r, joint, axes, shown)
        title = f"Joint {joint} on link {shown.heading(on)}" if len(joints) == 1 else title
    whose = "the link's axes" if len(joints) == 1 else "axes of the link"
    title = f"{title}, {'ground axes' if axes == 'ground' else whose}"
    return polar_scene(paths, shown.unit("force"), title, labels=crank_ticks(r, shown))


def shaking_chart(r: Result, notation: Notation | None = None) -> Scene:
    """Hodograph of the shaking force, all that the machine exerts on the ground; in space its components."""
    shown = Shown(r, notation or Notation())
    total, title = stepped_series(r, shaking_force) * shown.value("force", 1.0), "Shaking force on the ground"
    if r.mechanism.dimension == 3:
        return vector_chart(r, total, "force", title, shown)
    return polar_scene({"shaking force": total}, shown.unit("force"), title, labels=crank_ticks(r, shown))


def chart_scenes(r: Result, notation: Notation | None = None) -> list[Scene]:
    """All charts of a cycle."""
    shown = notation or Notation()
    if r.mechanism.dimension == 3:
        return _space_charts(r, shown)
    loaded = [j for j in r.joints if np.nanmax(magnitude(r.reaction(j)), initial=0.0) > 0]
    out = [*effort_chart(r, shown), *reaction_charts(r, shown)]
    out += [components_chart(r, j, shown) for j in loaded]
    pins = [j for j in loaded if r.mechanism.joints[j].hinge][:6]
    out += [polar_chart(r, [pin], axes, shown) for pin in pins for axes in ("ground", "link")]
    return [*out, shaking_chart(r, shown)]


def _space_charts(r: Result, notation: Notation) -> list[Scene]:
    """Magnitudes of all forces and moments, then components joint by joint; without those that are rounding errors."""
    forces, moments = ({j: _largest(getattr(r, read)(j)) for j in r.joints} for read in READS.values())
    length = r.compiled.layout.length
    force, moment = (max(sizes.values(), default=0.0) for sizes in (forces, moments))
    least = NOTHING * max(force, moment / length)
    loaded = [j for j, f in forces.items() if f > least]
    turned = [j for j, m in moments.items() if m > least * length]
    out = [*effort_chart(r, notation), *(reaction_charts(r, notation) if loaded else [])]
    out += _size_charts(r, "moment", turned, notation)
    for j in r.joints:
        out += [components_chart(r, j, notation)] * (j in loaded)
        out += [components_chart(r, j, notation, "moment")] * (j in turned)
    return out + ([shaking_chart(r, notation)] if _largest(shaking_force(r)) > least else [])


def _largest(vectors: Array) -> float:
    sizes = magnitude(vectors)
    return float(sizes[np.isfinite(sizes)].max(initial=0.0))
