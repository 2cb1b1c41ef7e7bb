"""The inertia force of a link on its displaced line: one force instead of the force at G and the couple."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from dalembert.analysis.methods.members import displaced_inertia
from dalembert.views.notation import Notation, Shown, load_sign
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import PaperFrame, fit_frame, force_scale
from dalembert.views.paper.scene import Arrow, Line, Point, Scene
from dalembert.views.plane.force_polygons import dimension
from dalembert.views.plane.mechanism_view import place_title, scale_notes, unit_size
from dalembert.views.plane.outline import link_points, link_shape
from dalembert.views.symbols import plane_symbols

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def displaced_inertia_scene(r: Result, link: str, k: int, notation: Notation | None = None) -> Scene:
    """A link with the acceleration of its mass centre, its inertia force displaced by h = I alpha / F."""
    shown = Shown(r, notation or Notation(), k)
    displaced = displaced_inertia(r, link)
    g, at = displaced.center[k], displaced.at[k]
    places = [*link_points(r, link, k).values(), tuple(g)]
    places += [tuple(at)] if _has_acceleration(r, link, k, shown) else []
    frame = fit_frame(places, 40.0, 34.0, unit_size(r, "length", shown.notation))
    canvas = Canvas()
    canvas.add(*link_shape(r, link, k, frame))
    for name, place in link_points(r, link, k).items():
        canvas.add(*plane_symbols.pin(frame(place)))
        if " " not in name:
            sign = load_sign(name) if name in r.mechanism.loads else name
            canvas.label(sign, frame(place), size=3.2, role="title", leads=False)
    canvas.add(*plane_symbols.mass_center(frame(g)))
    canvas.label("G", frame(g), size=3.0, role="title", leads=False)
    scales = _arrows(canvas, r, link, k, frame, shown)
    per_mm = scales["force"]
    notes, lengths = scale_notes(shown, frame, per_mm)
    notes[0] += f"; accelerations: 1 mm = {shown.plain('acceleration', scales['acceleration'])}"
    title = place_title(r, k, f"Inertia force of link {shown.heading(link)}", shown)
    return canvas.scene(title, notes=notes, scales=lengths | scales)


def _arrows(
    canvas: Canvas, r: Result, link: str, k: int, frame: PaperFrame, shown: Shown
) -> dict[str, float]:
    displaced, n = displaced_inertia(r, link), shown.link(link)
    g, at = frame(displaced.center[k]), frame(displaced.at[k])
    a, f = r.center_acceleration(link)[k], displaced.force[k]
    size, pull = math.hypot(*map(float, a)), math.hypot(*map(float, f))
    if not _has_acceleration(r, link, k, shown):
        canvas.label(f"a_{{G{n}}} = 0", g, size=2.8, role="acceleration")
        return {kind: unit_size(r, kind, shown.notation) for kind in ("force", "acceleration")}
    slow = force_scale([size], 20.0, unit_size(r, "acceleration", shown.notation))
    per_mm = force_scale([pull], 20.0, unit_size(r, "force", shown.notation))
    head = _arrow_head(g, a, slow)
    canvas.add(Arrow(g, head, "acceleration", link, "acceleration", size))
    canvas.label(f"a_{{G{n}}} = {shown.text('acceleration', size)}", head, size=2.8, role="acceleration")
    tip = _arrow_head(at, f, per_mm)
    canvas.add(Line((_arrow_head(at, f, -per_mm), tip), "construction"))
    canvas.add(Arrow(at, tip, "inertia", link, "force", pull))
    canvas.label(f"F_{{I{n}}} = {shown.text('force', pull)}", tip, size=2.8, role="inertia")
    if math.dist(g, at) > 1.0:
        dimension(canvas, g, at, f"h = {shown.text('length', float(displaced.offset[k]))}")
    return {"force": per_mm, "acceleration": slow}


def _has_acceleration(r: Result, link: str, k: int, shown: Shown) -> bool:
    """True if the acceleration of the mass centre is above rounding level."""
    return math.hypot(*map(float, r.center_acceleration(link)[k])) > shown.least["acceleration"]


def _arrow_head(p: Point, v: object, per_mm: float) -> Point:
    x, y = (float(c) for c in v)  # type: ignore[attr-defined]
    return (p[0] + x / per_mm, p[1] + y / per_mm)
