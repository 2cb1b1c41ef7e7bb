"""Symbols and marks of drawings as data: springs, balls, ground axes, colours; one force has no polygon."""

from __future__ import annotations

import math

import numpy as np
import pytest

import dalembert as da
from dalembert.model.joints.joint_part import JointPart
from dalembert.model.load_types import SpanLoad
from dalembert.views.formats.glb import _material
from dalembert.views.formats.themes import SOLIDS
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.scene import Arrow, Line
from dalembert.views.plane.joint_drawings import DRAWINGS
from dalembert.views.space.camera import CAMERAS
from dalembert.views.space.solids import Ball
from dalembert.views.space.space_view import triad
from dalembert.views.symbols.pair_symbols import SYMBOLS, symbol
from dalembert.views.symbols.plane_symbols import SPANS, spring, strip_spring
from dalembert.wrench import Force, System


def test_every_joint_of_the_plane_and_every_load_between_points_has_a_symbol() -> None:
    joints = {
        part.model_fields["type"].default for part in JointPart.__subclasses__() if part is not da.SpaceJoint
    }
    assert set(DRAWINGS) == joints
    assert set(SPANS) == {part.model_fields["type"].default for part in SpanLoad.__subclasses__()}


@pytest.mark.parametrize(("a", "b"), [((3.0, 1.0), (23.0, 1.0)), ((5.0, -3.0), (2.0, 1.0))])
def test_a_strip_spring_goes_from_its_bracket_to_the_other_end(
    a: tuple[float, float], b: tuple[float, float]
) -> None:
    """The bracket holds the middle of the coil, whose strip is straight on the line of the ends behind it."""
    bracket, strip = strip_spring(a, b)
    assert isinstance(bracket, Line)
    assert isinstance(strip, Line)
    coil = min(1.8, 0.2 * math.dist(a, b))
    assert (*bracket.points[0], *strip.points[-1]) == pytest.approx((*a, *b))
    far = [math.dist(p, bracket.points[-1]) for p in strip.points[:-1]]
    assert max(far) == pytest.approx(coil)
    assert min(far) == pytest.approx(0.3 * coil)
    e = np.subtract(b, a) / math.dist(a, b)
    off = np.subtract(strip.points[-2], a)
    assert off[0] * e[1] - off[1] * e[0] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(("a", "b"), [((1.0, 2.0), (21.0, 2.0)), ((5.0, -3.0), (2.0, 1.0))])
def test_a_spring_goes_from_end_to_end_the_same_from_either(
    a: tuple[float, float], b: tuple[float, float]
) -> None:
    (line,) = spring(a, b)
    assert isinstance(line, Line)
    points, length = np.array(line.points), math.dist(a, b)
    assert (*points[0], *points[-1]) == pytest.approx((*a, *b))
    along = (points - a) @ (np.subtract(b, a) / length)
    assert along == pytest.approx((length - along)[::-1])
    assert np.ptp(np.diff(along[2:-2])) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("kind", list(SYMBOLS))
def test_balls_of_symbols_are_in_the_middle(kind: str) -> None:
    parts = symbol(kind)
    solids = [s for part in (parts.on_i, parts.on_j) for s in part]
    for ball in (s for s in solids if isinstance(s, Ball)):
        assert ball.center.tolist() == [0, 0, 0]


@pytest.mark.parametrize("camera", CAMERAS.values(), ids=list(CAMERAS))
def test_ground_axes_are_seen_along_their_directions(camera: object) -> None:
    canvas = Canvas()
    triad(canvas, camera, (3.0, 4.0), 10.0)  # type: ignore[arg-type]
    arrows = [item for item in canvas.items if isinstance(item, Arrow)]
    seen = [10 * e for e in camera(np.eye(3)) if np.hypot(*e) > 0.05]  # type: ignore[operator]
    assert len(arrows) == len(seen)
    for arrow, e in zip(arrows, seen, strict=True):
        assert np.subtract(arrow.head, arrow.tail) == pytest.approx(e, abs=1e-9)


@pytest.mark.parametrize("role", list(SOLIDS))
def test_materials_have_the_colours_of_the_theme(role: str) -> None:
    """In linear intensities: back through the curve of IEC 61966-2-1 stand the theme's bytes."""
    *linear, opaque = _material(role)["pbrMetallicRoughness"]["baseColorFactor"]
    curved = [12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055 for c in linear]
    assert "#" + "".join(f"{round(255 * c):02x}" for c in curved) == SOLIDS[role][1]
    assert opaque == 1.0


def test_one_force_has_no_polygon() -> None:
    one = da.draw.force_system(System(Force([3, 4], name="F")))
    two = da.draw.force_system(System(Force([3, 4], name="F"), Force([1, 0], at=[0, 1], name="G")))
    assert [a.of for a in one.arrows()].count("F") == 1
    assert [a.of for a in two.arrows()].count("F") == 2
