"""A scene as DXF in millimetres, one layer per role."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from dalembert.arrays import Tree
from dalembert.views.formats.svg import arrow_parts
from dalembert.views.paper.lettering import plain
from dalembert.views.paper.scene import Arc, Arrow, Circle, Item, Line, Polygon, Scene, Text

ANCHORS = {"start": "MIDDLE_LEFT", "middle": "MIDDLE_CENTER", "end": "MIDDLE_RIGHT"}


def write_dxf(scene: Scene, path: str | Path) -> None:
    """Writes the drawing for CAD programs."""
    import ezdxf
    from ezdxf import units

    document = ezdxf.new("R2010", setup=True)
    document.units = units.MM
    space = document.modelspace()
    for item in scene.flat():
        role = item.role  # type: ignore[union-attr]
        if role not in document.layers:
            document.layers.add(role)
        _add(space, item, {"layer": role})
    document.saveas(path)


def _add(space: Any, item: Item, at: Tree) -> None:
    if isinstance(item, Text):
        from ezdxf.enums import TextEntityAlignment as Alignment

        text = space.add_text(plain(item.text), height=0.75 * item.size, dxfattribs=at)
        text.set_placement(item.at, align=Alignment[ANCHORS[item.anchor]])
    elif isinstance(item, Circle):
        space.add_circle(item.center, item.radius, dxfattribs=at)
    elif isinstance(item, Arc):
        low, high = sorted((math.degrees(item.start), math.degrees(item.end)))
        space.add_arc(item.center, item.radius, low, high, dxfattribs=at)
    elif isinstance(item, Arrow):
        shaft, head = arrow_parts(item.tail, item.head)
        space.add_line(*shaft, dxfattribs=at)
        if head:
            space.add_solid([*head, head[-1]], dxfattribs=at)
    elif isinstance(item, Line):
        space.add_lwpolyline(item.points, dxfattribs=at)
    elif isinstance(item, Polygon):
        space.add_lwpolyline(item.points, close=True, dxfattribs=at)
