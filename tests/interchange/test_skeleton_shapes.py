"""Skeletons of DXF and FreeCAD, whole: which ends are one pin, which pin slides, what a drawing says beside them."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from dalembert.errors import ModelError
from dalembert.interchange.sketches.dxf_skeletons import Shape, join_shapes, read_dxf
from dalembert.interchange.sketches.plane_sketch import PlaneSketch, SketchJoint

GROUND = "ground"
FAR = [(6.0, 19.0), (7.0, 19.0)]
"""A link whose first end is 4 m to the left of (10, 20): so large is the drawing, and a thousandth of it 4 mm."""


def joined(*shapes: Shape) -> PlaneSketch:
    sketch = PlaneSketch("")
    join_shapes(sketch, list(shapes))
    return sketch


@pytest.mark.parametrize(("gap", "pins"), [(0.0039, 4), (-0.0039, 4), (0.0041, 5), (-0.0041, 5)])
def test_ends_within_a_thousandth_of_the_drawing_are_one_pin(gap: float, pins: int) -> None:
    """Of its largest width or height from its first point on, to either side."""
    crank, rod = ("crank", [(10.0, 20.0), (10.0, 21.0)]), ("rod", [(10.0 + gap, 21.0), (6.0, 19.0)])
    sketch = joined(crank, rod, ("far", FAR))
    assert len(sketch.joints) == pins
    assert [j.links for j in sketch.joints[: pins - 2]] == (
        [["crank"], ["crank", "rod"]] if pins == 4 else [["crank"], ["crank"], ["rod"]]
    )


def test_a_skeleton_of_one_place_has_one_pin() -> None:
    sketch = joined(("a", [(2.0, 3.0), (2.0, 3.0)]), ("b", [(2.0, 3.0), (2.0, 3.0)]))
    assert sketch.joints == [SketchJoint("P1", 2.0, 3.0, ["a", "b"])]


def test_links_of_one_layer_and_of_the_layer_0_get_names_of_their_own() -> None:
    """A pin of a layer PIN alone is none; the ground comes first, a driven pin stands still."""
    sketch = joined(
        ("0", [(0.0, 0.0), (1.0, 0.0)]),
        ("0", [(1.0, 0.0), (2.0, 1.0), (2.0, 0.0)]),
        ("0", [(2.0, 0.0), (3.0, 0.0)]),
        ("ROD", [(2.0, 1.0), (3.0, 1.0)]),
        ("PIN", [(9.0, 9.0)]),
        ("GROUND", [(0.0, 0.0), (3.0, 0.0)]),
        ("GROUND", [(0.0, 0.0)]),
        ("DRIVE", [(3.0, 0.0)]),
    )
    assert sketch == PlaneSketch(
        "",
        [
            SketchJoint("P1", 0.0, 0.0, [GROUND, "link_1"]),
            SketchJoint("P2", 1.0, 0.0, ["link_1", "link_1_2"]),
            SketchJoint("P3", 2.0, 1.0, ["link_1_2", "rod"]),
            SketchJoint("P4", 2.0, 0.0, ["link_1_2", "link_1_3"]),
            SketchJoint("P5", 3.0, 0.0, [GROUND, "link_1_3"], speed=0.0),
            SketchJoint("P6", 3.0, 1.0, ["rod"]),
        ],
    )


@pytest.mark.parametrize(
    ("along", "across", "slides"),
    [
        *((0.0, 0.0, True), (5.0, 0.0, True), (2.0, 0.0, True), (2.0, 0.0079, True), (2.0, -0.0079, True)),
        *((2.0, 0.0081, False), (2.0, -0.0081, False), (2.0, 3.0, False), (2.0, -3.0, False)),
        *((-0.0079, 0.0, True), (-0.0081, 0.0, False), (5.0079, 0.0, True), (5.0081, 0.0, False)),
        *((-2.0, 0.0, False), (6.0, 0.0, False)),
    ],
)
def test_the_pin_within_a_thousandth_of_a_line_slides_along_it(
    along: float, across: float, slides: bool
) -> None:
    """Of 5 m by (3, 4), with a corner on it, in a drawing of 8 m. A pin on the ground, which is on it too, stays."""
    x, y = 12 + 0.6 * along + 0.8 * across, 13 + 0.8 * along - 0.6 * across
    sketch = joined(
        ("base", [(10.0, 20.0), (13.5, 15.0)]),
        ("GROUND", [(13.5, 15.0)]),
        ("SLIDE", [(12.0, 13.0), (13.5, 15.0), (15.0, 17.0)]),
        ("rod", [(10.0, 20.0), (x, y)]),
        ("far", [(2.0, 19.0), (3.0, 19.0)]),
    )
    pins = [
        SketchJoint("P1", 10.0, 20.0, ["base", "rod"]),
        SketchJoint("P2", 13.5, 15.0, [GROUND, "base"]),
        SketchJoint("P3", x, y, ["rod", "P3 block"] if slides else ["rod"]),
        SketchJoint("P4", 2.0, 19.0, ["far"]),
        SketchJoint("P5", 3.0, 19.0, ["far"]),
    ]
    block = SketchJoint("P3 slide", x, y, [GROUND, "P3 block"], math.atan2(4, 3))
    assert sketch.joints == [*pins, *([block] if slides else [])]
    assert sketch.lost == ([] if slides else ["a line of layer SLIDE at (12, 13) m with no pin on it"])


def test_a_slide_without_a_length_holds_nothing() -> None:
    sketch = joined(("rod", [(0.0, 0.0), (1.0, 0.0)]), ("SLIDE", [(1.0, 0.0), (1.0, 0.0)]))
    assert [j.links for j in sketch.joints] == [["rod"], ["rod"]]
    assert sketch.lost == ["a line of layer SLIDE at (1, 0) m with no pin on it"]


def test_a_drawing_of_every_entity(tmp_path: Path) -> None:
    """Centimetres. A circle that says neither ground nor drive is a pin's mark, whatever its layer; a bulge is lost."""
    ezdxf = pytest.importorskip("ezdxf")
    drawing = ezdxf.new(units=5)
    space = drawing.modelspace()
    space.add_line((1, 2), (1, 4), {"layer": "Crank"})
    space.add_lwpolyline([(1, 4), (5, 5, 0, 0, 0.3), (6, 2)], dxfattribs={"layer": "plate"})
    space.add_polyline2d([(6, 2), (8, 2), (8, 3)], dxfattribs={"layer": "0"})
    space.add_circle((30, 40), 1, {"layer": "plate"})
    space.add_circle((1, 2), 1, {"layer": "drive"})
    space.add_point((8, 3), {"layer": "Ground"})
    space.add_point((1, 2), {"layer": "Ground"})
    space.add_text("a title")
    space.add_arc((0, 0), 1, 0, 90)
    space.add_ellipse((0, 0), (1, 0))
    space.add_spline([(0, 0), (1, 1), (2, 0)])
    space.add_ray((0, 0), (1, 0))
    space.add_xline((0, 0), (1, 0))
    drawing.saveas(tmp_path / "x.dxf")
    sketch = read_dxf((tmp_path / "x.dxf").read_bytes(), "x.dxf")
    expected = [
        SketchJoint("P1", 0.01, 0.02, [GROUND, "crank"], speed=0.0),
        SketchJoint("P2", 0.01, 0.04, ["crank", "plate"]),
        SketchJoint("P3", 0.05, 0.05, ["plate"]),
        SketchJoint("P4", 0.06, 0.02, ["plate", "link_1"]),
        SketchJoint("P5", 0.08, 0.02, ["link_1"]),
        SketchJoint("P6", 0.08, 0.03, [GROUND, "link_1"]),
    ]
    assert sketch.joints == expected
    kinds = ("ARC", "ELLIPSE", "RAY", "SPLINE", "TEXT", "XLINE")
    assert sketch.lost == [f"{kind} entities" for kind in kinds]


PLAIN = "0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n"
LINE = "0\nLINE\n8\n{}\n10\n0\n20\n0\n11\n1000\n21\n0\n"


def test_a_drawing_without_a_unit_is_in_millimetres() -> None:
    """That of the first DXF, which knew no units."""
    pytest.importorskip("ezdxf")
    sketch = read_dxf(PLAIN.format(LINE.format("rod")).encode(), "x.dxf")
    assert [(j.x, j.y) for j in sketch.joints] == [(0.0, 0.0), (1.0, 0.0)]
    assert sketch.lost == ["the drawing has no unit: taken as millimetres"]


@pytest.mark.parametrize(
    ("number", "metres"), [(1, 0.0254), (2, 0.3048), (4, 1e-3), (5, 1e-2), (6, 1.0), (0, 1e-3)]
)
def test_units_of_a_drawing(number: int, metres: float) -> None:
    """Inch, foot, millimetre, centimetre and metre by their numbers in DXF; 0 says that there is none."""
    pytest.importorskip("ezdxf")
    head = f"0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{number}\n0\nENDSEC\n"
    sketch = read_dxf((head + PLAIN.format(LINE.format("rod"))).encode(), "x.dxf")
    assert sketch.joints[1].x == pytest.approx(1000 * metres, rel=1e-15)
    assert sketch.lost == ([] if number else ["the drawing has no unit: taken as millimetres"])


def test_a_drawing_that_is_no_skeleton_is_refused_at_its_first_line() -> None:
    pytest.importorskip("ezdxf")
    for content, said in (
        (b"0" * 5_000_001, "the file has more than 5000000 bytes; leave all but the skeleton out"),
        (
            PLAIN.format(LINE.format("GROUND")).encode(),
            "the drawing has no lines that would be links; draw links as lines",
        ),
    ):
        with pytest.raises(ModelError) as refused:
            read_dxf(content, "x.dxf")
        assert str(refused.value) == f"x.dxf:1: {said}"
