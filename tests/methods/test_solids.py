"""Solids as meshes and as pictures: volumes, areas and edges are those of the bodies they stand for."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from dalembert.views.paper.scene import Circle, Line, Polygon
from dalembert.views.space.camera import Camera
from dalembert.views.space.link_solids import _plate, _tree
from dalembert.views.space.painter import LIGHT, LONGEST, _tone, paint
from dalembert.views.space.solids import (
    Ball,
    Block,
    GlassTube,
    Pane,
    Plate,
    Ring,
    RoundBar,
    Solid,
    Wire,
    across,
    helix,
)
from dalembert.views.space.triangles import AROUND, WIRE, mesh

EYE = Camera(0.5, 0.4)
AXES = np.linalg.qr(np.array([[1.0, 0.2, -0.3], [0.1, 1.0, 0.4], [0.3, -0.2, 1.0]]))[0]
HALF = np.array([5.0, 1.0, 2.0])
AT = np.array([3.0, -2.0, 1.0])
BAR = AT + 7.0 * AXES[0]
FLAT = AT + np.array([[4.0, 0], [0, 3], [-4, 0], [0, -3]]) @ AXES[:2]
LEFT = np.diag([1.0, 1.0, -1.0]) @ AXES
"""Axes that are no rotation of x, y and z."""


def round_area(radius: float, corners: int = AROUND) -> float:
    return corners / 2 * radius**2 * math.sin(2 * math.pi / corners)


def ring_volume(radius: float, thick: float) -> float:
    return round_area(thick, 12) * 48 * 2 * radius * math.tan(math.pi / 48)


BODIES: dict[str, tuple[Solid, float, float]] = {
    "bar": (RoundBar(AT, BAR, 1.5), 7.0 * round_area(1.5), 1e-9),
    "ball": (Ball(AT, 2.0), 4 / 3 * math.pi * 8.0, 0.04),
    "block": (Block(AT, AXES, HALF), 8 * HALF.prod(), 1e-9),
    "mirrored block": (Block(AT, LEFT, HALF), 8 * HALF.prod(), 1e-9),
    "plate": (Plate(FLAT, 0.5), 24.0 * 0.5, 1e-9),
    "pane": (Pane(FLAT), 24.0 * 0.1 * 0.8, 1e-9),
    "ring": (Ring(AT, 2.0 * AXES[1], 3.0, 0.6), ring_volume(3.0, 0.6), 0.01),
    "wire": (Wire(np.array([AT, BAR, BAR])), 7.0 * round_area(0.8 * WIRE, 5), 1e-9),
}
"""A solid, its volume with as many corners as it has, and how far that may be off."""


@pytest.mark.parametrize("name", BODIES)
def test_a_mesh_encloses_its_body(name: str) -> None:
    """By the divergence theorem; all is within reach of the middle, and normals are those of the triangles."""
    solid, volume, off = BODIES[name]
    found = mesh(solid, 0.8)
    corners = found.points[found.triangles]
    twice = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert np.einsum("nk,nk->", corners[:, 0], twice) / 6 == pytest.approx(volume, rel=off)
    assert twice.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-9)
    for k in range(3):
        assert (np.einsum("nk,nk->n", twice, found.normals[found.triangles[:, k]]) >= -1e-9).all()


def test_a_tube_is_the_side_of_its_cylinder_and_a_thread_winds_about_its_bar() -> None:
    found = mesh(GlassTube(AT, BAR, 1.5), 0.8)
    corners = found.points[found.triangles]
    area = (
        np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum()
        / 2
    )
    assert area == pytest.approx(7.0 * AROUND * 2 * 1.5 * math.sin(math.pi / AROUND))
    plain, cut = (len(mesh(RoundBar(AT, BAR, 1.5, thread=x), 0.8).points) for x in (0.0, 2.0))
    steps = len(helix(RoundBar(AT, BAR, 1.5, thread=2.0), AROUND)) - 1
    assert steps == math.ceil(AROUND * 7.0 / 2.0)
    wire = mesh(Wire(np.array([AT, BAR])), 0.8)
    assert cut - plain == steps * len(wire.points)
    thick = mesh(RoundBar(AT, BAR, 1.5, thread=2.0), 0.8).points[plain:]
    off = np.linalg.norm(np.cross(thick - AT, AXES[0]), axis=1)
    assert off.max() == pytest.approx(1.5 + 1.5 * WIRE * 0.8, rel=0.02)


def test_a_bar_has_the_corners_that_it_needs() -> None:
    assert len(mesh(BODIES["bar"][0], 0.8).points) == 2 * (AROUND + 1) + 2 * (AROUND + 1)


def test_a_sleeve_is_painted_over_what_runs_in_it() -> None:
    """In one piece, as near as its nearer end; other bars piece by piece at their middles."""
    sleeve, bar = RoundBar(AT, BAR, 1.5, "sleeve", whole=True), RoundBar(AT, BAR, 0.5, "bar")
    roles = [i.role.split("-")[0] for i in paint([sleeve, bar], EYE)]
    assert roles == sorted(roles)  # all of the bar, then the sleeve


def areas(items: Any) -> dict[str, float]:
    """Painted area of each role, outlines either way round."""
    out: dict[str, float] = {}
    for item in items:
        if isinstance(item, Polygon):
            x, y = np.array([*item.points, item.points[0]]).T
            out[item.role] = out.get(item.role, 0.0) + abs(float((x[:-1] * y[1:] - x[1:] * y[:-1]).sum())) / 2
    return out


def length(items: Any, role: str) -> float:
    return sum(
        math.dist(p, q)
        for i in items
        if isinstance(i, Line) and i.role == role
        for p, q in pairwise(i.points)
    )


def seen(*edges: Any) -> float:
    """Length of edges as they are seen."""
    return float(sum(np.hypot(*EYE(e)) for e in edges))


def test_a_bar_as_it_is_seen() -> None:
    """Its side is as wide as it is thick; the nearer end is whole, of the farther one half the edge shows."""
    for start, end in ((AT, BAR), (BAR, AT)):
        items = paint([RoundBar(start, end, 1.5, "x")], EYE)
        cap = round_area(1.5, 32) * abs(float(AXES[0] @ EYE.eye))
        found = areas(items)
        assert found["x-top"] == pytest.approx(cap)
        assert found["x-fill"] == pytest.approx(cap + 2 * 1.5 * seen(7 * AXES[0]))
        sides = 2 * seen(7 * AXES[0])
        e = np.array(EYE(AXES[0])) / seen(AXES[0])
        flat = np.array([p for i in items if isinstance(i, (Line, Polygon)) for p in i.points]) - EYE(AT)
        wide = flat @ np.array([-e[1], e[0]])
        assert (wide.max(), wide.min()) == pytest.approx((1.5, -1.5))
        back = length(items, "x-edge") - sides
        depth = 1.5 * abs(float(AXES[0] @ EYE.eye))
        assert 2 * math.hypot(1.5, depth) < back < 2 * (1.5 + depth)  # half an ellipse
        (far,) = (np.array(i.points) for i in items if isinstance(i, Line) and len(i.points) > 2)
        nearer = EYE(min((AT, BAR), key=lambda p: -float(EYE.depth(p))))
        assert np.hypot(*(far[8] - nearer)) > np.hypot(*(far[0] - nearer))  # it bulges away


def test_a_bar_seen_from_its_end_is_its_end() -> None:
    (cap,) = paint([RoundBar(-3 * EYE.eye, 4 * EYE.eye, 1.5, "x")], EYE)
    assert areas([cap]) == {"x-top": pytest.approx(round_area(1.5, 32))}
    assert paint([RoundBar(AT, AT, 1.5)], EYE) == []


def test_a_block_as_it_is_seen() -> None:
    """Three faces with their own edges, each in the tone of its light."""
    block = Block(AT, AXES, HALF, "x")
    items = paint([block], EYE)
    expected: dict[str, float] = {}
    edges = []
    for k in range(3):
        normal = AXES[k] * math.copysign(1, AXES[k] @ EYE.eye)
        light = float(normal @ LIGHT) / math.hypot(*LIGHT)
        tone = "x-top" if light > 0.6 else "x-front" if light > 0.25 else "x-side"
        u, v = (HALF[m] * AXES[m] for m in range(3) if m != k)
        role = tone if k == int(np.argmax(HALF)) else f"{tone}-fill"
        expected[role] = expected.get(role, 0.0) + 4 * abs(float(np.linalg.det([EYE(u), EYE(v)])))
        edges += [] if role == tone else [2 * u, 2 * u, 2 * v, 2 * v]
    assert areas(items) == pytest.approx(expected)
    assert length(items, "x-edge") == pytest.approx(seen(*edges))
    whole = [paint([Block(AT, AXES, HALF, "x", whole=w)], EYE) for w in (True, False)]
    assert [sum(isinstance(i, Polygon) for i in some) for some in whole] == [
        3,
        2 * math.ceil(10 / LONGEST) + 1,
    ]


@pytest.mark.parametrize(
    ("share", "tone"),
    [(1, "top"), (0.61, "top"), (0.59, "front"), (0.26, "front"), (0.24, "side"), (-0.9, "side")],
)
def test_faces_are_toned_by_how_much_light_falls_on_them(share: float, tone: str) -> None:
    e = LIGHT / np.linalg.norm(LIGHT)
    assert _tone(share * e + math.sqrt(1 - share**2) * across(e)[0]) == tone


def test_plates_panes_wires_and_tubes_as_they_are_seen() -> None:
    area = 24.0 * abs(float(AXES[2] @ EYE.eye))
    sides = [b - a for a, b in pairwise([*FLAT, FLAT[0]])]
    plate = paint([Plate(FLAT, 0.5, "x")], EYE)
    assert areas(plate) == {"x-fill": pytest.approx(area)}
    assert length(plate, "x-edge") == pytest.approx(seen(*sides))
    spoke = paint([Plate(FLAT, 0.5, "x", spoke=True)], EYE)
    assert length(spoke, "x-edge") == pytest.approx(
        seen(*sides, 2 * (FLAT[0] - AT))
    )  # of the triangles on both its sides
    large = paint([Plate(AT + 5 * (FLAT - AT), 0.5, "x")], EYE)
    assert areas(large) == {"x-fill": pytest.approx(25 * area)}
    assert length(large, "x-edge") == pytest.approx(5 * seen(*sides))
    assert length(paint([Pane(FLAT, "x")], EYE), "x") == pytest.approx(seen(*sides))
    assert length(paint([Wire(FLAT, "x")], EYE), "x") == pytest.approx(seen(*sides[:3]))
    tube = paint([GlassTube(AT, BAR, 1.5, "x")], EYE)
    rims = [1.5 * 2 * math.sin(math.pi / 32) * np.array([-math.sin(t), math.cos(t)]) @ np.array(across(AXES[0]))
            for t in (np.arange(32) + 0.5) * 2 * math.pi / 32]  # fmt: skip
    assert length(tube, "x") == pytest.approx(2 * seen(7 * AXES[0]) + 2 * seen(*rims))
    assert length(paint([GlassTube(AT, AT + 7 * EYE.eye, 1.5, "x")], EYE), "x") == pytest.approx(
        2 * 32 * 3 * math.sin(math.pi / 32)
    )


def test_a_ball_has_its_spot_towards_the_light() -> None:
    ball, spot = paint([Ball(AT, 2.0, "x")], EYE)
    assert isinstance(ball, Circle)
    assert isinstance(spot, Circle)
    assert (*ball.center, ball.radius) == pytest.approx((*EYE(AT), 2.0))
    assert np.subtract(spot.center, ball.center) == pytest.approx(EYE(LIGHT / np.linalg.norm(LIGHT)))
    assert (ball.role, spot.role) == ("x", "x-spot")
    assert spot.radius < 1.0


@pytest.mark.parametrize("size", [1e-4, 1.0, 1e4])
def test_a_plate_is_where_nodes_lie_in_a_plane_but_not_on_a_line(size: float) -> None:
    """Whatever the size; its outline goes around all nodes."""
    nodes, lift = size * FLAT, size * 5 * AXES[2]
    (plate,) = _plate(np.array([*nodes, size * AT]), lift, size)
    assert np.array(sorted(plate.corners.tolist())) == pytest.approx(
        np.array(sorted((nodes + lift).tolist()))
    )
    assert plate.thickness == pytest.approx(1.2 * size)
    off = nodes + size * np.array([[0], [0], [0], [0.1]]) * AXES[2]
    bent = size * np.array([AT, BAR, AT - AXES[0] + 1e-4 * AXES[1]])
    assert _plate(off, lift, size) == _plate(bent, lift, size) == []


def test_bars_join_all_nodes_with_the_least_length() -> None:
    places = [np.array(p, float) for p in ((0, 0, 0), (5, 0, 0), (1, 0, 0), (1, 2, 0), (5, 1, 0))]
    assert {frozenset(pair) for pair in _tree(places)} == {
        frozenset(p) for p in ((0, 2), (2, 3), (1, 2), (1, 4))
    }


@pytest.mark.parametrize(
    "direction", [AXES[0], -AXES[1], AXES[2], [0.0, -0.6, -0.8], [-0.8, 0.6, 0.0], [0.0, 1.0, 0.0]]
)
def test_two_directions_across_a_third(direction: Any) -> None:
    e = np.array(direction, float)
    assert np.linalg.det(np.array([e, *across(e)])) == pytest.approx(1.0)
    assert np.array([e, *across(e)]) @ np.array([e, *across(e)]).T == pytest.approx(np.eye(3), abs=1e-12)
