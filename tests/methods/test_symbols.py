"""Symbols and marks of drawings as data: springs, balls, ground axes, colours; one force has no polygon."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import actions
from dalembert.bundled import examples
from dalembert.model.joints.joint_part import JointPart, kinds_of
from dalembert.model.load_types import SpanLoad
from dalembert.views.formats.glb import _material
from dalembert.views.formats.themes import SOLIDS, THEMES
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.scene import Arrow, Circle, Line, Polygon
from dalembert.views.plane.joint_drawings import DRAWINGS
from dalembert.views.space.camera import CAMERAS
from dalembert.views.space.solids import Ball, Block, Pane, RoundBar, Wire
from dalembert.views.space.space_view import triad
from dalembert.views.space.triangles import mesh
from dalembert.views.symbols.pair_symbols import BALL, SYMBOLS, SymbolSetting, symbol
from dalembert.views.symbols.plane_symbols import (
    BLOCK,
    PIN,
    SPANS,
    couple,
    cylinder,
    damper,
    fixed_pin,
    guide,
    hatch,
    mass_center,
    one_way,
    pawl,
    ratchet,
    slider,
    slot,
    spring,
    strip_spring,
    thread,
    torsion_damper,
    torsion_spring,
    two_heads,
    weld,
    wheel,
)
from dalembert.wrench import Force, System


def test_every_joint_of_the_plane_and_every_load_between_points_has_a_symbol() -> None:
    joints = {part.model_fields["type"].default for part in kinds_of(JointPart) if part is not da.SpaceJoint}
    assert set(DRAWINGS) == joints - {"rope"}  # which is drawn by its strands and pulleys
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
    turn = along[1:-1][14:] - along[1:-1][:-14]
    assert turn == pytest.approx(np.full(len(turn), turn[0]))
    assert (np.diff(along) < 0).any()  # loops: a coil, no zigzag


@pytest.mark.parametrize("longest", [1.0, 1.4, 1.8, 2.6])
def test_the_piston_of_a_cylinder_stays_in_its_barrel_and_its_rod_ends_at_the_pin(longest: float) -> None:
    """Barrel and rod keep their lengths over the stroke, as long as the barrel holds the stroke."""
    sizes = []
    for length in np.linspace(20.0, 20.0 * longest, 7):
        end = (3.0 + 0.6 * length, 4.0 + 0.8 * length)
        barrel, piston, rod, eye = cylinder((3.0, 4.0), end, 20.0, 20.0 * longest)
        assert isinstance(barrel, Polygon)
        assert isinstance(piston, Line)
        assert isinstance(rod, Line)
        assert isinstance(eye, Line)
        along = [
            [(x - 3.0) * 0.6 + (y - 4.0) * 0.8 for x, y in item.points] for item in (barrel, piston, rod, eye)
        ]
        assert min(along[0]) <= along[1][0] <= max(along[0]) < 20.0
        assert along[1] == pytest.approx([along[2][0]] * 2)
        assert along[2][1] == pytest.approx(length)
        assert along[3] == pytest.approx([0.0, min(along[0])])
        sizes.append((max(along[0]), along[2][1] - along[2][0]))
    assert len({round(mouth, 9) for mouth, _ in sizes}) == 1
    if longest < 1.7:
        assert len({round(rod, 9) for _, rod in sizes}) == 1


@pytest.mark.parametrize("kind", list(SYMBOLS))
def test_balls_of_symbols_are_in_the_middle(kind: str) -> None:
    parts = symbol(kind)
    solids = [s for part in (parts.on_i, parts.on_j) for s in part]
    for ball in (s for s in solids if isinstance(s, Ball)):
        assert ball.center.tolist() == [0, 0, 0]


@pytest.mark.parametrize(("kind", "end"), [("weld", 0), ("prismatic", 1), ("screw", 0)])
def test_blocks_of_symbols_are_in_the_middle(kind: str, end: int) -> None:
    (block,) = symbol(kind)[end]
    assert isinstance(block, Block)
    assert block.center.tolist() == [0, 0, 0]


def test_balls_touch_their_panes_and_pegs_are_amid_their_slots() -> None:
    slides = SymbolSetting(low=np.array([-3.0, -2.0, -1.0]), high=np.array([4.0, 5.0, 6.0]))
    panes = symbol("sphere_between_planes", slides).on_i
    assert [set(p.corners[:, 0]) for p in panes if isinstance(p, Pane)] == [{-BALL}, {BALL}]
    for pane in (p for p in panes if isinstance(p, Pane)):
        assert pane.corners.min(axis=0)[1:].tolist() == [-6.5, -5.5]
        assert pane.corners.max(axis=0)[1:].tolist() == [9.5, 10.5]
    for kind in ("slotted_sphere", "slotted_sphere_in_cylinder"):
        parts = symbol(kind, slides)
        (peg,) = (p for p in parts.on_j if isinstance(p, RoundBar))
        wires = [p.points for p in parts.on_i if isinstance(p, Wire)]
        e = peg.end / np.linalg.norm(peg.end)
        assert len(wires) == 2
        middle = np.mean(wires, axis=0)
        across_x = middle.mean(axis=0) * [kind == "slotted_sphere", 1, 1]
        assert np.cross(across_x, e) == pytest.approx(np.zeros(3), abs=1e-9)
        assert across_x @ e > 1.0
        assert np.linalg.norm(np.ptp(middle, axis=0)) > BALL
    for kind in ("prismatic", "cylindrical", "sphere_in_cylinder", "slotted_cylinder"):
        reach = np.concatenate([mesh(s, 1.0).points for s in symbol(kind, slides).on_i])[:, 0]
        assert reach.min() + 3.0 == pytest.approx(-(reach.max() - 4.0))
        assert reach.max() > 4.0 + 3.0


SPOT, ANGLE = (3.0, -2.0), 0.7
"""Where symbols are drawn, and how they are turned."""


def local(points: Any) -> Any:
    """Places of a symbol in its own axes."""
    c, s = math.cos(ANGLE), math.sin(ANGLE)
    return (np.array(points) - SPOT) @ np.array([[c, -s], [s, c]])


def check_ground(items: Any, at: Any, side: float, width: float) -> None:
    """A line of ground about a place, with even strokes on one side that lean one way."""
    line, *strokes = (local(i.points) for i in items)
    middle, half = np.array(at), np.array([width / 2, 0.0])
    assert sorted(line.tolist()) == [pytest.approx(middle - half), pytest.approx(middle + half)]
    starts, ends = (np.array([s[k] for s in strokes]) for k in (0, 1))
    assert len(strokes) == max(3, round(width / 1.5))
    assert starts[:, 1] == pytest.approx(middle[1])
    assert np.diff(np.sort(starts[:, 0])) == pytest.approx(width / len(strokes))
    assert abs(starts[:, 0] - middle[0]).max() <= width / 2
    assert ends - starts == pytest.approx(np.tile([side * 1.2, side * 1.4], (len(strokes), 1)))


@pytest.mark.parametrize("width", [2.0, 13.0])
def test_the_ground_has_its_strokes_on_one_side(width: float) -> None:
    check_ground(hatch(SPOT, ANGLE, width), (0, 0), -1.0, width)
    for side in (-1.0, 1.0):
        check_ground(guide(SPOT, ANGLE, width, side), (0, side * (BLOCK[1] / 2 + 0.25)), side, width)


def test_a_pin_on_the_ground_stands_on_its_support() -> None:
    triangle, *ground, circle = fixed_pin(SPOT, ANGLE - math.pi / 2)
    assert local(triangle.points) == pytest.approx(np.array([[0, 0], [-2.6, -4.2], [2.6, -4.2]]))
    check_ground(ground, (0, -4.2), -1.0, 8.4)
    assert (circle, circle.center) == (Circle(SPOT, PIN, "pin"), SPOT)
    upright = fixed_pin(SPOT)[0]
    assert min(y for _, y in upright.points) == pytest.approx(SPOT[1] - 4.2)
    assert max(y for _, y in upright.points) == pytest.approx(SPOT[1])


def test_blocks_slots_and_welds() -> None:
    (block,), (square,), (slotted,) = slider(SPOT, ANGLE), weld(SPOT), slot(SPOT, ANGLE, 12.0)
    w, h = BLOCK[0] / 2, BLOCK[1] / 2
    assert local(block.points) == pytest.approx(np.array([[-w, -h], [w, -h], [w, h], [-w, h]]))
    assert np.array(square.points) - SPOT == pytest.approx(
        0.9 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    )
    x, y = local(slotted.points).T
    assert np.hypot(np.maximum(abs(x) - 6.0, 0), y) == pytest.approx(PIN + 0.5)  # round at its ends
    assert (x.min(), x.max()) == pytest.approx((-6.0 - PIN - 0.5, 6.0 + PIN + 0.5), abs=0.02)
    around = np.unwrap(np.arctan2(y, x))
    assert (np.diff(around) > 0).all()
    assert around[-1] - around[0] < 2 * math.pi


def test_a_mass_centre_has_two_dark_quarters_and_a_wheel_a_spoke() -> None:
    circle, *dark = mass_center(SPOT, 2.0)
    assert circle == Circle(SPOT, 2.0, "center")
    for quarter, sign in zip(dark, (1, -1), strict=True):
        points = sign * (np.array(quarter.points) - SPOT)
        assert points[0] == pytest.approx((0, 0))
        assert points.min() == pytest.approx(0, abs=1e-12)
        assert (points[1], points[-1]) == (pytest.approx((2, 0)), pytest.approx((0, 2), abs=1e-12))
        assert np.hypot(*points[1:].T) == pytest.approx(2.0)
    rim, spoke = wheel(SPOT, 5.0, ANGLE)
    assert rim == Circle(SPOT, 5.0, "pitch")
    assert local(spoke.points) == pytest.approx(np.array([[0, 0], [5, 0]]))


@pytest.mark.parametrize("length", [4.0, 20.0])
def test_a_damper_has_its_piston_in_its_pot(length: float) -> None:
    end = (SPOT[0] + length * math.cos(ANGLE), SPOT[1] + length * math.sin(ANGLE))
    rod, pot, piston, other = (local(i.points) for i in damper(SPOT, end))
    assert (rod[0], other[-1]) == (pytest.approx((0, 0)), pytest.approx((length, 0)))
    assert (rod[:, 1], other[:, 1]) == (pytest.approx(0, abs=1e-12), pytest.approx(0, abs=1e-12))
    assert rod[-1, 0] == pytest.approx(pot[:, 0].min())
    assert other[0, 0] == pytest.approx(piston[0, 0]) == pytest.approx(piston[1, 0])
    assert pot[:, 0].min() < piston[0, 0] < pot[:, 0].max() < length
    assert pot[:, 1] == pytest.approx(-pot[::-1, 1])
    assert piston[0, 1] == pytest.approx(-piston[1, 1])
    assert 0.5 * pot[0, 1] < piston[0, 1] < pot[0, 1] == pytest.approx(min(1.6, 0.2 * length))


def polar(points: Any) -> Any:
    """Distances from the place of a symbol, and angles in one go from that at which it is turned."""
    x, y = local(points).T
    return np.hypot(x, y), np.unwrap(np.arctan2(y, x))


def test_a_spiral_has_two_turns_and_a_quarter_and_its_outer_end_is_held() -> None:
    (line,) = torsion_spring(SPOT)
    *spiral, held = np.array(line.points) - SPOT
    size, turn = np.hypot(*np.array(spiral).T), np.unwrap(np.arctan2(*np.array(spiral).T[::-1]))
    share = np.linspace(0, 1, len(spiral))
    assert size == pytest.approx(PIN + 0.5 + (4.2 - PIN - 0.5) * share)
    assert turn == pytest.approx(4.5 * math.pi * share, abs=1e-12)
    assert held - spiral[-1] == pytest.approx((1.6, 0))


def test_a_turning_damper_is_a_vane_in_a_pot_open_below() -> None:
    pot, vane = torsion_damper(SPOT)
    assert (pot.center, pot.radius) == (SPOT, 3.6)
    assert np.degrees([pot.start, pot.end]) == pytest.approx([20, 160])
    assert np.array(vane.points) - SPOT == pytest.approx(np.array([[0, PIN], [0, 3.0]]))


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_wedges_narrow_and_teeth_are_steep_towards_the_free_sense(way: float) -> None:
    """Seen from the sense in which it turns freely; the pawl's face lies on the steep flank at the angle given."""
    ring, *wedges = one_way(SPOT, way, ANGLE)
    assert ring == Circle(SPOT, 3.6, "link")
    assert len(wedges) == 3
    for k, wedge in enumerate(wedges):
        size, turn = polar(wedge.points)
        assert size == pytest.approx([3.6, 3.6, 2.5])
        assert (turn - k * 2 * math.pi / 3 + 0.1) % (2 * math.pi) - 0.1 == pytest.approx(
            np.array([0, 0.7 * way, 0]) % (2 * math.pi), abs=1e-9
        )
    (toothed,) = ratchet(SPOT, 10.0, 8, way, ANGLE)
    size, turn = polar(toothed.points)
    assert size == pytest.approx([8.2, 10.0] * 8)
    assert turn == pytest.approx(way * np.repeat(np.arange(8), 2) * math.pi / 4)
    for radius, long in ((10.0, 7.0), (4.0, 4.0)):
        finger, pivot = pawl(SPOT, radius, way, ANGLE)
        low = 0.82 * radius
        middle = (low + 0.6 * long, way * long)
        wanted = [(low, 0), (radius, 0), (middle[0] + 0.7, middle[1]), (middle[0] - 0.7, middle[1])]
        assert local(finger.points) == pytest.approx(np.array(wanted), abs=1e-12)
        assert local(pivot.center) == pytest.approx(middle)
        assert (pivot.radius, pivot.role) == (0.8, "pin")


@pytest.mark.parametrize(("lead", "turns"), [(5.0, 4), (6.0, 3), (1.0, 16), (30.0, 1)])
def test_a_screw_has_a_line_for_each_turn_of_its_thread(lead: float, turns: int) -> None:
    """Over 20 mm; lines are 1.2 mm apart at the least, and there is one at least."""
    shaft, *lines = thread(SPOT, ANGLE, 20.0, 1.5, lead)
    assert local(shaft.points) == pytest.approx(
        np.array([[-20, -1.5], [0, -1.5], [0, 1.5], [-20, 1.5]]), abs=1e-12
    )
    assert len(lines) == turns
    for k, line in enumerate(lines):
        step = 20.0 / turns
        assert local(line.points) == pytest.approx(
            np.array([[-k * step, -1.5], [-(k + 0.5) * step, 1.5]]), abs=1e-12
        )


@pytest.mark.parametrize(
    ("length", "turns"), [(5.0, 6.5), (20.0, 6.5), (30.0, 9.5), (60.0, 18.5), (150.0, 30.5)]
)
def test_a_longer_spring_has_more_turns(length: float, turns: float) -> None:
    """From 6 to 30 and a half, within 1.7 mm, or a fifth of a short one; straight ends of 0.15 of the length."""
    (line,) = spring((0.0, 0.0), (length, 0.0))
    x, y = np.array(line.points[1:-1]).T
    assert len(x) == 14 * turns + 1
    assert abs(y).max() == pytest.approx(min(1.7, 0.2 * length), rel=0.03)
    pitch = 0.7 * length / turns
    assert y[0] == pytest.approx(0)
    assert (x[0], x[14] - x[0]) == pytest.approx((0.15 * length - 0.35 * pitch, pitch))


def test_a_cylinder_of_known_diameters_is_drawn_with_them() -> None:
    """A barrel of 3 mm; a rod of 1 mm has two sides, a thinner one is a line."""
    for thick in (1.0, 0.9):
        tube, first, second, _ = cylinder((0.0, 0.0), (25.0, 0.0), 20.0, 30.0, 3.0, thick)
        assert sorted({y for _, y in tube.points}) == [-1.5, 1.5]
        piston, rod = (second, first) if thick == 1.0 else (first, second)
        assert [y for _, y in piston.points] == [-1.5, 1.5]
        assert isinstance(rod, Polygon if thick == 1.0 else Line)
        assert sorted({y for _, y in rod.points}) == ([-0.5, 0.5] if thick == 1.0 else [0.0])
        assert max(x for x, _ in rod.points) == 25.0
        assert {x for x, _ in piston.points} == {min(x for x, _ in rod.points)}
    plain = cylinder((0.0, 0.0), (25.0, 0.0), 20.0, 30.0)[0]
    small = cylinder((0.0, 0.0), (10.0, 0.0), 10.0, 12.0)[0]
    assert max(y for _, y in plain.points) == 2.2
    assert max(y for _, y in small.points) == pytest.approx(1.6)
    assert SPANS["gas_spring"]((0.0, 0.0), (25.0, 0.0)) == cylinder((0.0, 0.0), (25.0, 0.0), 17.5, 25.0)


def test_couples_turn_by_their_sign_and_moments_have_two_heads() -> None:
    for sign in (3.0, -3.0):
        (arc,) = couple(SPOT, sign, 4.0, "load", "T", 7.0)
        assert (arc.center, arc.radius, arc.role, arc.of, arc.value, arc.arrow) == (
            SPOT,
            4.0,
            "load",
            "T",
            7.0,
            True,
        )
        assert arc.end - arc.start == pytest.approx(math.copysign(math.radians(230), sign))
        assert (arc.start + arc.end) / 2 == pytest.approx(math.pi / 2)  # it is open below
    for length in (2.0, 30.0):
        whole, second = two_heads((1.0, 1.0), (1.0, 1.0 + length), "load", "T", "moment", 5.0)
        assert (whole.tail, whole.head, whole.kind, whole.value) == ((1, 1), (1, 1 + length), "moment", 5.0)
        assert second.tail == whole.tail
        assert second.head == pytest.approx((1, 1 + length - min(2.4, 0.4 * length)))
        assert (second.kind, second.of, second.value) == ("", "", None)


@pytest.mark.parametrize("theme", THEMES)
def test_looks_are_colours_widths_and_dashes(theme: str) -> None:
    for role, look in THEMES[theme].items():
        assert re.fullmatch(r"#([0-9a-f]{3}|[0-9a-f]{6})", look.stroke), role
        assert re.fullmatch(r"none|#[0-9a-f]{3,6}", look.fill), role
        assert 0.05 < look.width < 0.8
        assert all(0.3 < dash < 5 for dash in look.dash)
        assert look.weight == ("bold" if role == "title" else "normal")
    assert THEMES[theme].keys() == THEMES["light"].keys()


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


def test_the_signs_of_what_acts_on_a_link() -> None:
    r = da.dynamics(da.load(examples()["four_bar"]), positions=1)
    shown, named = (Shown(r, notation, 0) for notation in (Notation(), Notation(links="name")))
    signs = [
        (a.kind, a.link, shown.symbol(a)) for a in actions(r) if a.link == "coupler" or a.kind == "effort"
    ]
    assert signs == [
        ("joint", "coupler", "F_{23}"),
        ("joint", "coupler", "F_{43}"),
        ("effort", "crank", "T_{12}"),
        ("effort", "ground", "T_{21}"),
        ("load", "coupler", "F_{P}"),
        ("inertia", "coupler", "F_{I3}"),
        ("inertia", "coupler", "T_{I3}"),
    ]
    on_coupler = next(a for a in actions(r) if (a.of, a.link) == ("A", "coupler"))
    parts = [replace(on_coupler, part=part) for part in ("normal", "ahead")]
    assert [shown.symbol(a) for a in parts] == ["N_{23}", "F_{23,ahead}"]
    assert [named.symbol(a) for a in parts] == ["N_{crank,coupler}", "F_{crank,coupler,ahead}"]
