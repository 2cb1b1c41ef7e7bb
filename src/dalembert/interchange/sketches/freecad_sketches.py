"""Sketches of a FreeCAD document (.FCStd) as a skeleton: the label of a sketch is the layer of a DXF skeleton.

A document is a zip; only its Document.xml is read, without entities, up to a bounded size. Lengths are millimetres.
"""

from __future__ import annotations

import io
import zipfile
from collections.abc import Iterator

from dalembert.errors import ModelError
from dalembert.interchange.sketches.dxf_skeletons import SPECIAL, Shape, join_shapes
from dalembert.interchange.sketches.plane_sketch import PlaneSketch
from dalembert.interchange.xml_tree import LARGEST, Element, parse

ENDS = {
    "LineSegment": (("StartX", "StartY"), ("EndX", "EndY")),
    "Circle": (("CenterX", "CenterY"),),
    "GeomPoint": (("X", "Y"),),
}
"""Element of a geometry -> attributes of its points."""

UNIT = 1e-3


def read_freecad(content: bytes, file: str) -> PlaneSketch:
    """The linkage of a document's sketches; raises ModelError for a document without lines that would be links."""
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive, archive.open("Document.xml") as document:
            text = document.read(LARGEST + 1)
    except (zipfile.BadZipFile, KeyError, OSError, RuntimeError, NotImplementedError) as error:
        what = f"the file is not a FreeCAD document: {error}"
        raise ModelError(what, "save it in FreeCAD as .FCStd", (), file, 1) from None
    root = parse(text, f"{file}:Document.xml")
    sketch = PlaneSketch("FreeCAD sketch")
    shapes = list(_shapes(root, sketch))
    if not any(layer not in SPECIAL for layer, _ in shapes):
        raise ModelError(
            "the document has no sketch with lines that would be links", "draw links as lines", (), file
        )
    join_shapes(sketch, shapes)
    return sketch


def _shapes(root: Element, sketch: PlaneSketch) -> Iterator[Shape]:
    """Layer and points of each line, circle and point of every sketch, construction lines left out."""
    data = root.first("ObjectData") or root
    for thing in data.all("Object"):
        properties = {p.get("name"): p for part in thing.all("Properties") for p in part.all("Property")}
        if "Geometry" not in properties:
            continue
        texts = (
            [e.get("value") for e in properties["Label"].walk() if e.tag == "String"]
            if "Label" in properties
            else []
        )
        label = texts[0] if texts else thing.get("name")
        count = 0
        for geometry in (e for e in properties["Geometry"].walk() if e.tag == "Geometry"):
            construction = geometry.first("Construction")
            shape = next((e for e in geometry.parts if e.tag in ENDS), None)
            if shape is None:
                sketch.lost.append(f"{geometry.get('type')} of sketch {label!r}")
                continue
            if construction is not None and construction.get("value") == "1":
                continue
            count += 1
            points = [(shape.number(x) * UNIT, shape.number(y) * UNIT) for x, y in ENDS[shape.tag]]
            upper = label.upper()
            layer = upper if upper in SPECIAL else "PIN" if shape.tag != "LineSegment" else f"{label} {count}"
            yield layer, points
