"""DXF skeletons: lines are links, circles pins; layers say what is ground, what slides, and what is driven.

Layers: GROUND, its points and lines are fixed; SLIDE, a line along which the pin at its middle or ends slides on the
ground; DRIVE, a circle at the pin that is driven. Every other LINE, LWPOLYLINE or POLYLINE is a link with its vertices;
ends within a thousandth of the drawing are one pin.
"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Iterator
from typing import Any

from dalembert.errors import ModelError
from dalembert.interchange.link_graph import plain_name
from dalembert.interchange.sketches.plane_sketch import PlaneSketch, SketchJoint
from dalembert.model import GROUND
from dalembert.saving import check_installed

UNITS = {1: 0.0254, 2: 0.3048, 4: 1e-3, 5: 1e-2, 6: 1.0}
"""$INSUNITS -> metres."""

SPECIAL = ("GROUND", "SLIDE", "DRIVE", "PIN")
"""Layers that are not links."""

Point = tuple[float, float]
Shape = tuple[str, list[Point]]
"""A layer, and the points of a shape, metres."""


def read_dxf(content: bytes, file: str) -> PlaneSketch:
    """The linkage of a DXF skeleton; raises ModelError for a file without links or ground."""
    check_installed("ezdxf", "A DXF skeleton", "cad")
    import ezdxf

    if len(content) > 5_000_000:
        raise ModelError(
            "the file has more than 5000000 bytes", "leave all but the skeleton out", (), file, 1
        )
    text = content.decode("utf-8", "replace")
    try:
        drawing = ezdxf.read(io.StringIO(text))
    except (ezdxf.DXFError, ValueError, IndexError) as error:
        raise ModelError(f"the file is not DXF: {error}", "save it as ASCII DXF", (), file, 1) from None
    has_unit = re.search(r"^\s*\$INSUNITS\s*$", text, re.M)  # ezdxf takes metres where the file says nothing
    unit = UNITS.get(int(drawing.header["$INSUNITS"])) if has_unit else None
    sketch = PlaneSketch("DXF skeleton")
    if unit is None:
        unit = 1e-3
        sketch.lost.append("the drawing has no unit: taken as millimetres")
    shapes = list(_shapes(drawing, unit, sketch))
    if not any(layer not in SPECIAL for layer, _ in shapes):
        raise ModelError("the drawing has no lines that would be links", "draw links as lines", (), file, 1)
    join_shapes(sketch, shapes)
    return sketch


def _shapes(drawing: Any, unit: float, sketch: PlaneSketch) -> Iterator[Shape]:
    """Layer and points, metres, of each line, polyline, point and circle."""
    left: set[str] = set()
    for entity in drawing.modelspace():
        kind, layer = entity.dxftype(), entity.dxf.layer.upper()
        if kind == "LINE":
            points = [entity.dxf.start, entity.dxf.end]
        elif kind == "LWPOLYLINE":
            points = list(entity.vertices())
        elif kind == "POLYLINE":
            points = [v.dxf.location for v in entity.vertices]
        elif kind in ("CIRCLE", "POINT"):
            points = [entity.dxf.center if kind == "CIRCLE" else entity.dxf.location]
            layer = layer if layer in ("GROUND", "DRIVE") else "PIN"
        else:
            left.add(kind)
            continue
        yield layer, [(float(p[0]) * unit, float(p[1]) * unit) for p in points]
    sketch.lost += [f"{kind} entities" for kind in sorted(left)]


def join_shapes(sketch: PlaneSketch, shapes: list[Shape]) -> None:
    """Joints where ends of links meet, or are on the ground."""
    every = [p for _, points in shapes for p in points]
    size = max(max(abs(c - d) for c, d in zip(p, every[0], strict=True)) for p in every)
    places: list[Point] = []
    on: list[list[str]] = []

    def at(point: Point) -> int:
        for k, place in enumerate(places):
            if math.dist(place, point) <= 1e-3 * size:
                return k
        places.append(point)
        on.append([])
        return len(places) - 1

    names: dict[str, object] = {}
    slides, driven = [], []
    for layer, points in shapes:
        if layer == "SLIDE":
            slides.append(points)
        elif layer == "DRIVE":
            driven.append(at(points[0]))
        elif layer == "GROUND":
            for point in points:
                if GROUND not in on[at(point)]:
                    on[at(point)].insert(0, GROUND)
        elif layer != "PIN":
            link = plain_name(layer.lower() if layer != "0" else "link_1", names)
            names[link] = None
            for point in points:
                if link not in on[at(point)]:
                    on[at(point)].append(link)
    for k, (place, links) in enumerate(zip(places, on, strict=True)):
        if links:
            sketch.joints.append(SketchJoint(f"P{k + 1}", *place, links, speed=0.0 if k in driven else None))
    for points in slides:
        _slide(sketch, points, size)


def _slide(sketch: PlaneSketch, points: list[Point], size: float) -> None:
    """A block on the ground at the pin that is on a line of the layer SLIDE."""
    (x0, y0), (x1, y1) = points[0], points[-1]
    length = math.hypot(x1 - x0, y1 - y0)
    for joint in list(sketch.joints):
        across = ((joint.x - x0) * (y1 - y0) - (joint.y - y0) * (x1 - x0)) / length if length else math.inf
        along = ((joint.x - x0) * (x1 - x0) + (joint.y - y0) * (y1 - y0)) / length if length else math.inf
        if (
            abs(across) <= 1e-3 * size
            and -1e-3 * size <= along <= length + 1e-3 * size
            and GROUND not in joint.links
        ):
            block = f"{joint.name} block"
            joint.links.append(block)
            angle = math.atan2(y1 - y0, x1 - x0)
            sketch.joints.append(SketchJoint(f"{joint.name} slide", joint.x, joint.y, [GROUND, block], angle))
            return
    sketch.lost.append(f"a line of layer SLIDE at ({x0:g}, {y0:g}) m with no pin on it")
