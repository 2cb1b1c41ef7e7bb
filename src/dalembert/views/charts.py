"""Curves over the cycle and polar diagrams, as scenes with axes."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from operator import methodcaller
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import magnitude
from dalembert.analysis.output.columns import drive_kinds
from dalembert.analysis.result.reaction_axes import Axes
from dalembert.arrays import Array, Flags
from dalembert.machine.shaking import shaking_force
from dalembert.views.notation import Notation, Shown, pretty
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import round_up
from dalembert.views.paper.scene import Circle, Line, Point, Scene, Text
from dalembert.views.space.space_view import NOTHING

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

SIZE = (84.0, 52.0)


def ticks(low: float, high: float, most: int = 6, angle: bool = False) -> list[float]:
    """Round values that cover a range.

    >>> ticks(0.0, 360.0, 7, True)
    [0.0, 60.0, 120.0, 180.0, 240.0, 300.0, 360.0]
    """
    if not high > low:
        low, high = low - 1.0, high + 1.0
    step = round_up((high - low) / most)
    if angle:
        step = next(
            (s for s in (5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0) if (high - low) / s <= most), 360.0
        )
    first = math.floor(low / step + 1e-9)
    last = math.ceil(high / step - 1e-9)
    return [float(f"{n * step:.10g}") for n in range(first, last + 1)]


def curves_scene(
    x: Array, series: Mapping[str, Array], x_label: str, y_label: str, title: str = "", angle: bool = False
) -> Scene:
    """Curves against one axis, each with its name at its end or in a legend."""
    canvas = Canvas()
    values = np.concatenate([np.asarray(v, float) for v in series.values()])
    values = values[np.isfinite(values)]
    low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 1.0)
    x_ticks = ticks(float(np.nanmin(x)), float(np.nanmax(x)), 6, angle)
    y_ticks = ticks(min(low, 0.0), max(high, 0.0))
    to = _axes(canvas, x_ticks, y_ticks, x_label, y_label)
    for n, (name, curve) in enumerate(series.items()):
        role = f"curve-{n % 6 + 1}"
        for run in _runs(x, curve):
            canvas.add(Line(tuple(to(a, b) for a, b in run), role))
        _legend(canvas, n, name, role)
    return canvas.scene(title, numbers={name: [float(v) for v in curve] for name, curve in series.items()})


def _axes(
    canvas: Canvas, xs: list[float], ys: list[float], x_label: str, y_label: str
) -> Callable[[float, float], Point]:
    width, height = SIZE

    def to(a: float, b: float) -> Point:
        return (
            width * (float(a) - xs[0]) / (xs[-1] - xs[0]),
            height * (float(b) - ys[0]) / (ys[-1] - ys[0]),
        )

    for x in xs:
        px = to(x, ys[0])[0]
        canvas.add(Line(((px, 0.0), (px, height)), "grid"))
        canvas.add(Text((px, -3.2), _tick(x), 2.6, "note"))
    for y in ys:
        py = to(xs[0], y)[1]
        canvas.add(Line(((0.0, py), (width, py)), "axis" if y == 0 else "grid"))
        canvas.add(Text((-1.5, py), _tick(y), 2.6, "note", "end"))
    canvas.add(Line(((0.0, height), (0.0, 0.0), (width, 0.0)), "axis"))
    canvas.add(Text((width / 2, -7.6), x_label, 2.8, "note"))
    canvas.add(Text((-1.5, height + 4.2), y_label, 2.8, "note", "start"))
    return to


def _tick(value: float) -> str:
    return f"{value:g}".replace("-", "−")


def _legend(canvas: Canvas, n: int, name: str, role: str) -> None:
    y = SIZE[1] - 2.0 - 4.6 * n
    canvas.add(Line(((SIZE[0] + 3.0, y), (SIZE[0] + 10.0, y)), role))
    canvas.add(Text((SIZE[0] + 11.5, y), name, 2.8, "text", "start"))


def _runs(x: Array, y: Array) -> list[list[tuple[float, float]]]:
    """Pieces without gaps."""
    out: list[list[tuple[float, float]]] = [[]]
    for a, b in zip(x, y, strict=True):
        if math.isfinite(b) and math.isfinite(a):
            out[-1].append((float(a), float(b)))
        elif out[-1]:
            out.append([])
    return [run for run in out if len(run) > 1]


def stepped_series(r: Result, read: Callable[[Result], Array]) -> Array:
    """What is read of a result, position by position, twice where contacts reverse: just before and just after, in the
    order in which the list passes them."""
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
    """Where the list of positions goes against the motion of the first drive."""
    if not r.drives or len(r.status) < 2 or r.schedule.time is not None:
        return np.zeros(len(r.status), bool)
    step = np.diff(r.drive_position(r.drives[0]))
    return np.asarray(np.append(step, step[-1]) * r.drive_speed(r.drives[0]) < 0)


def along(r: Result, shown: Shown) -> tuple[Array, str, bool]:
    """What charts are drawn against: the first drive, or the number of the position."""
    if not r.drives:
        return (
            stepped_series(r, lambda side: np.arange(1, len(side.status) + 1, dtype=float)),
            "position",
            False,
        )
    kind = drive_kinds(r, r.drives[0])["position"]
    places = stepped_series(r, lambda side: side.drive_position(side.drives[0]))
    values = np.array([shown.value(kind, v) for v in places])
    unit = shown.unit(kind)
    return values, f"{r.drives[0]} in {unit}", unit == "°"


def effort_chart(r: Result, notation: Notation | None = None) -> list[Scene]:
    """Efforts over the cycle, torques and forces apart."""
    shown = Shown(r, notation or Notation())
    x, label, angle = along(r, shown)
    out = []
    for kind in ("moment", "force"):
        names = [d for d in r.drives if drive_kinds(r, d)["effort"] == kind]
        efforts = {d: stepped_series(r, methodcaller("effort", d)) for d in names}
        series = {d: np.array([shown.value(kind, v) for v in values]) for d, values in efforts.items()}
        if series:
            word = "Torque" if kind == "moment" else "Force"
            out.append(curves_scene(x, series, label, f"{word} in {shown.unit(kind)}", "Drive effort", angle))
    return out


def reaction_chart(r: Result, notation: Notation | None = None) -> Scene:
    """Magnitudes of all joint forces over the cycle."""
    shown = Shown(r, notation or Notation())
    x, label, angle = along(r, shown)
    unit = shown.unit("force")
    size = 1 / shown.value("force", 1.0)
    series = {n: magnitude(stepped_series(r, methodcaller("reaction", n))) / size for n in r.joints}
    return curves_scene(x, series, label, f"Joint force in {unit}", "Joint forces", angle)


def moment_chart(r: Result, joints: Sequence[str], notation: Notation | None = None) -> Scene:
    """In space: magnitudes of joint moments over the cycle."""
    shown = Shown(r, notation or Notation())
    x, label, angle = along(r, shown)
    size = shown.size("moment")
    series = {n: magnitude(stepped_series(r, methodcaller("reaction_moment", n))) / size for n in joints}
    return curves_scene(x, series, label, f"Joint moment in {shown.unit('moment')}", "Joint moments", angle)


def components_chart(r: Result, joint: str, notation: Notation | None = None) -> Scene:
    """Components and magnitude of one joint's force over the cycle; in space in the joint's own axes."""
    shown = Shown(r, notation or Notation())
    space = r.mechanism.dimension == 3
    axes: Axes = "joint" if space else "ground"
    force = stepped_series(r, lambda side: side.reaction(joint, axes=axes)) * shown.value("force", 1.0)
    on = shown.heading(r.mechanism.joints[joint].links[1])
    title = f"Joint {joint}: force on link {on}" + (", joint's axes" if space else "")
    return vector_chart(r, force, "force", title, shown)


def moment_components_chart(r: Result, joint: str, notation: Notation | None = None) -> Scene:
    """In space: components and magnitude of one joint's moment over the cycle, in the joint's own axes."""
    shown = Shown(r, notation or Notation())
    moment = stepped_series(r, lambda side: side.reaction_moment(joint, axes="joint")) / shown.size("moment")
    on = shown.heading(r.mechanism.joints[joint].links[1])
    return vector_chart(r, moment, "moment", f"Joint {joint}: moment on link {on}, joint's axes", shown)


def vector_chart(r: Result, vectors: Array, kind: str, title: str, shown: Shown) -> Scene:
    """Components and magnitude of vectors in the reader's unit, over the cycle: ``stepped_series`` as they are."""
    x, label, angle = along(r, shown)
    series = dict(zip("xyz", vectors.T, strict=False)) | {"magnitude": magnitude(vectors)}
    return curves_scene(x, series, label, f"{kind.capitalize()} in {shown.unit(kind)}", title, angle)


def polar_scene(paths: Mapping[str, Array], unit: str, title: str, radius: float = 34.0) -> Scene:
    """Hodographs: ends of force vectors over the cycle, circles of equal magnitude around the pole."""
    canvas = Canvas()
    largest = max((float(np.nanmax(np.hypot(*p.T), initial=0.0)) for p in paths.values()), default=1.0) or 1.0
    step = round_up(largest / 3)
    rings = math.ceil(largest / step - 1e-9)
    scale = radius / (rings * step)
    reach = radius + 3.0
    canvas.add(Line(((-reach, 0.0), (reach, 0.0)), "axis"), Line(((0.0, -reach), (0.0, reach)), "axis"))
    for n in range(1, rings + 1):
        canvas.add(Circle((0.0, 0.0), n * step * scale, "grid"))
    for n, (name, path) in enumerate(paths.items()):
        points = [(float(x) * scale, float(y) * scale) for x, y in path if math.isfinite(x)]
        if len(points) > 1:
            canvas.add(Line((*points, points[0]), f"curve-{n % 6 + 1}"))
            canvas.label(name, *points[:: max(1, len(points) // 12)], size=2.8)
    for n in range(1, rings + 1):
        r = n * step * scale
        spots = [(r * math.cos(a), r * math.sin(a)) for a in np.arange(16) * math.pi / 8 + 0.2]
        canvas.label(_tick(n * step), *spots, size=2.4, role="note", leads=False)
    canvas.label("x", (reach, 0.0), prefer=0.0, size=2.8, role="note", leads=False)
    canvas.label("y", (0.0, reach), prefer=math.pi / 2, size=2.8, role="note", leads=False)
    return canvas.scene(title, notes=[f"Circles in {unit}"], scales={"force": 1 / scale})


def polar_chart(
    r: Result, joints: Sequence[str], axes: str = "ground", notation: Notation | None = None
) -> Scene:
    """Polar diagrams of joint forces in ground axes, or in the axes of the link (where a bearing wears)."""
    shown = Shown(r, notation or Notation())
    unit = shown.value("force", 1.0)
    paths = {}
    seen: Axes = "link" if axes == "link" else "ground"
    for joint in joints:
        i, j = r.mechanism.joints[joint].links
        on = j if axes == "ground" or j != "ground" else i
        paths[joint] = stepped_series(r, methodcaller("reaction", joint, on=on, axes=seen)) * unit
    where = "ground axes" if axes == "ground" else "axes of the link"
    return polar_scene(paths, shown.unit("force"), f"Joint forces in {where}")


def shaking_chart(r: Result, notation: Notation | None = None) -> Scene:
    """Hodograph of the shaking force, all that the machine exerts on the ground; in space its components."""
    shown = Shown(r, notation or Notation())
    total, title = stepped_series(r, shaking_force) * shown.value("force", 1.0), "Shaking force on the ground"
    if r.mechanism.dimension == 3:
        return vector_chart(r, total, "force", title, shown)
    return polar_scene({"shaking force": total}, shown.unit("force"), title)


def chart_scenes(r: Result, notation: Notation | None = None) -> list[Scene]:
    """All charts of a cycle."""
    shown = notation or Notation()
    if r.mechanism.dimension == 3:
        return _space_charts(r, shown)
    loaded = [j for j in r.joints if np.nanmax(magnitude(r.reaction(j)), initial=0.0) > 0]
    out = [*effort_chart(r, shown), reaction_chart(r, shown)]
    out += [components_chart(r, j, shown) for j in loaded]
    pins = [j for j in loaded if r.mechanism.joints[j].hinge][:6]
    if pins:
        out += [polar_chart(r, pins, "ground", shown), polar_chart(r, pins, "link", shown)]
    return [*out, shaking_chart(r, shown)]


def _space_charts(r: Result, notation: Notation) -> list[Scene]:
    """Sizes of all forces and moments, then components joint by joint; what is rounding is left out."""
    sizes = {j: [_largest(r.reaction(j)), _largest(r.reaction_moment(j))] for j in r.joints}
    length = r.compiled.layout.length
    force = max([f for f, _ in sizes.values()], default=0.0)
    moment = max([m for _, m in sizes.values()], default=0.0)
    loaded = [j for j, (f, _) in sizes.items() if f > NOTHING * max(force, moment / length)]
    turned = [j for j, (_, m) in sizes.items() if m > NOTHING * max(moment, force * length)]
    out = effort_chart(r, notation)
    out += [reaction_chart(r, notation)] if loaded else []
    out += [moment_chart(r, turned, notation)] if turned else []
    for j in r.joints:
        out += [components_chart(r, j, notation)] if j in loaded else []
        out += [moment_components_chart(r, j, notation)] if j in turned else []
    return [
        *out,
        *(
            [shaking_chart(r, notation)]
            if _largest(shaking_force(r)) > NOTHING * max(force, moment / length)
            else []
        ),
    ]


def _largest(vectors: Array) -> float:
    sizes = magnitude(vectors)
    return float(sizes[np.isfinite(sizes)].max(initial=0.0))


__all__ = ["chart_scenes", "curves_scene", "polar_scene", "pretty", "ticks"]
