"""Supports, mounts and bars of links as solids, corner by corner, and triangles of what is thin."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.views.space.link_solids import (
    Mount,
    _down,
    _feet,
    _foot,
    _frame,
    _tree,
    link_solids,
    mount,
    pose,
)
from dalembert.views.space.solids import (
    Ball,
    Block,
    Plate,
    RoundBar,
    Wire,
    across,
    circle,
    helix,
    place_solid,
)
from dalembert.views.space.triangles import TriangleMesh, _grid, _side, _wire, join_meshes, mesh

DOWN = np.array([0.6, 0.0, -0.8])


def test_a_foot_is_a_post_a_square_and_five_strokes_below_each_of_its_edges() -> None:
    """At 2 mm of paper for one: the square 5.6 mm away to each side, 2.4 mm beyond the start of 1.5 mm."""
    at = np.array([10.0, -20.0, 30.0])
    post, plate, *strokes = _foot(at, DOWN, 1.5, 2.0)
    assert isinstance(post, RoundBar)
    assert post.start == pytest.approx(at + 3.0 * DOWN)
    assert post.end == pytest.approx(at + 7.8 * DOWN)
    assert (post.radius, post.role) == (1.1, "ground-solid")
    assert isinstance(plate, Plate)
    u, v = across(DOWN)
    local = (plate.corners - post.end) @ np.stack([u, v, DOWN]).T
    assert local == pytest.approx(5.6 * np.array([(1, 1, 0), (-1, 1, 0), (-1, -1, 0), (1, -1, 0)]), abs=1e-9)
    assert (plate.thickness, plate.role) == (0.8, "ground-solid")
    assert len(strokes) == 20
    places = [-4.2, -1.75, 0.7, 3.15, 5.6]  # from three quarters of the half edge to its end
    for n, stroke in enumerate(strokes):
        assert isinstance(stroke, Wire)
        assert stroke.role == "hatch"
        start, end = (stroke.points - post.end) @ np.stack([u, v, DOWN]).T
        side, t = divmod(n, 5)
        away = 5.6 if side % 2 == 0 else -5.6
        along = (away, places[t]) if side < 2 else (places[t], away)
        assert start == pytest.approx([*along, 0.0], abs=1e-9)
        back = np.array([0.0, -1.8, 2.4]) if side < 2 else np.array([-1.8, 0.0, 2.4])
        assert end - start == pytest.approx(back, abs=1e-9)


def test_bars_join_places_with_the_least_length_from_the_first_on() -> None:
    places = [np.array(p, float) for p in ((0, 0, 0), (9, 0, 0), (4, 1, 0), (5, 5, 0), (8, 3, 1))]
    assert _tree(places) == [(0, 2), (2, 3), (3, 4), (4, 1)]
    assert _tree(places[:1]) == []


def rod(length: float = 0.3) -> Any:
    return da.statics(
        da.loads(f"""
links:
  ground: {{points: {{O: [0, 0]}}}}
  rod: {{points: {{O: [0, 0], A: [{length}, 0]}}}}
  tip: {{points: {{A: [0, 0], B: [0.1, 0.05]}}, mass: 2, center: [0.02, 0.04]}}
joints: {{O: {{type: pin, links: [ground, rod]}}, A: {{type: pin, links: [rod, tip]}}}}
drives: {{O: {{position: 0.5 rad}}, A: {{position: 0.2 rad}}}}
""")
    )


def test_a_bar_leaves_the_room_of_its_symbols() -> None:
    r = rod()
    (bar,) = _frame(r, "rod", {("rod", "O"): 0.02, ("rod", "A"): 0.05}, 0.001)
    assert isinstance(bar, RoundBar)
    height = bar.start[2]
    assert bar.start == pytest.approx([0.02, 0, height])
    assert bar.end == pytest.approx([0.25, 0, height])
    assert bar.radius == pytest.approx(0.0008)
    clear = {("rod", "O"): 0.1, ("rod", "A"): 0.1997}
    assert len(_frame(r, "rod", clear, 0.001)) == 1  # 0.3 mm are left, more than a fifth of a millimetre
    assert len(_frame(r, "rod", clear | {("rod", "A"): 0.1999}, 0.001)) == 0
    assert len(_frame(rod(0.04e-3), "rod", {}, 0.001)) == 0  # within a twentieth of a millimetre: one place
    assert len(_frame(rod(0.3e-3), "rod", {}, 0.001)) == 1
    (other,) = _frame(r, "tip", {}, 0.001)  # to its mass centre, as it has a single joint
    assert isinstance(other, RoundBar)
    assert other.end[:2] == pytest.approx([0.02, 0.04])


def test_the_pose_of_the_ground_is_none_and_that_of_a_plane_link_a_turn_about_z() -> None:
    r = rod()
    turn, at = pose(r, "ground", 0)
    assert (turn.tolist(), at.tolist()) == (np.eye(3).tolist(), [0, 0, 0])
    turn, at = pose(r, "tip", 0)
    c, s = math.cos(0.7), math.sin(0.7)
    assert turn == pytest.approx(np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]))
    assert at == pytest.approx([0.3 * math.cos(0.5), 0.3 * math.sin(0.5), 0])


SLIDE = """
links:
  ground: {points: {O: [0, 0], C: [0.02, -0.03]}}
  block: {points: {B: [0, 0], Q: [0.1, 0.2]}, mass: 1}
joints: {C: {type: slider, links: [ground, block], at: [C, B], direction: 30 deg, angle: 10 deg}}
drives: {C: {position: [-0.1, 0.3, 0.2]}}
"""


def test_a_mount_has_the_axes_of_its_slide_and_how_far_it_goes() -> None:
    r = da.statics(da.loads(SLIDE.replace("angle: 10 deg", "angle: 0.2 rad")))
    m = mount(r, "C")
    assert (m.kind, m.links, m.blocked, m.hand) == ("prismatic", ("ground", "block"), "x", 1.0)
    assert m.points[0][:2] == pytest.approx([0.02, -0.03])
    c, s = math.cos(math.pi / 6), 0.5
    assert m.axes[0] == pytest.approx(np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]))
    c, s = math.cos(-0.2), math.sin(-0.2)
    assert m.axes[1] == pytest.approx(np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]))
    assert (m.low.tolist(), m.high.tolist()) == ([-0.1, 0, 0], [0.3, 0, 0])


def feet_of(kind: str, end: int = 0, clear: float = 1.7) -> list[np.ndarray]:
    """Where the posts of a joint on the ground begin, in the joint's axes, at 0.002 m for a millimetre."""
    r = rod()
    axes = np.array([[0.0, 1, 0], [0, 0, 1], [1, 0, 0]])
    links = ("ground", "rod") if end == 0 else ("rod", "ground")
    m = Mount(
        kind,
        links,
        (np.zeros(3), np.zeros(3)),
        (axes, axes),
        np.array([-0.1, 0.02, 0.06]),
        np.array([0.3, 0.08, 0.1]),
    )
    posts = [s for s in _feet(r, m, clear, 0.002) if isinstance(s, RoundBar)]
    return [axes @ post.start for post in posts]


def test_a_rail_has_a_post_at_each_end_and_a_plane_one_behind_its_middle() -> None:
    first, last = feet_of("prismatic")
    assert (first[0], last[0]) == (pytest.approx(-0.1 - 0.01 + 0.0016), pytest.approx(0.3 + 0.01 - 0.0016))
    assert math.hypot(*first[1:]) == math.hypot(*last[1:]) == pytest.approx(0.8 * 0.002)
    first, last = feet_of("slotted_cylinder")
    assert (first[0], last[0]) == (
        pytest.approx(-0.1 - 0.0068 + 0.0016),
        pytest.approx(0.3 + 0.0068 - 0.0016),
    )
    assert math.hypot(*first[1:]) == pytest.approx(0.7 * 0.002)
    for kind, aside in (
        ("cylindrical", 0.9),
        ("sphere_in_cylinder", 2.5),
        ("slotted_sphere_in_cylinder", 2.5),
    ):
        assert math.hypot(*feet_of(kind)[0][1:]) == pytest.approx(aside * 0.002)
    for kind, off in (("plane", 1.0), ("sphere_between_planes", 2.2), ("cylinder_between_planes", 1.8)):
        (post,) = feet_of(kind)
        assert post == pytest.approx([-off * 0.002, 0.05, 0.08])
    for kind, away in (("revolute", 1.7), ("spherical", 3.1), ("slotted_sphere", 3.1), ("weld", 1.7)):
        (post,) = feet_of(kind)
        assert np.linalg.norm(post) == pytest.approx(away * 0.002)
    assert len(feet_of("prismatic", end=1)) == len(feet_of("plane", end=1)) == 1


def test_a_post_goes_down_unless_something_is_in_the_way() -> None:
    """Of a rod that hangs it goes up in part: sideways, away from it; beside an upright rail, sideways too."""
    r = rod()
    m = mount(r, "O")
    assert _down(r, m, None) == pytest.approx([0, -1, 0])
    assert _down(r, m, np.array([0.0, 1.0, 0.0])) == pytest.approx([-1, 0, 0])
    slanted = np.array([0.6, -0.8, 0.0])
    down = _down(r, m, slanted)
    assert down @ slanted == pytest.approx(0.0, abs=1e-12)
    hanging = da.statics(r.mechanism.with_values({"drives.O.position": -math.pi / 2}))
    assert _down(hanging, mount(hanging, "O"), None) == pytest.approx([-1, 0, 0])
    left = da.statics(r.mechanism.with_values({"drives.O.position": -2.2}))
    assert _down(left, mount(left, "O"), None) == pytest.approx([1, 0, 0])


def test_solids_of_a_mechanism_in_space_stand_on_the_ground() -> None:
    r = da.kinematics(da.load(examples()["rssr"]))
    solids = link_solids(r, 0.001)
    assert list(solids) == [*r.links, "ground"]
    feet = [s for s in solids["ground"] if isinstance(s, Plate) and s.role == "ground-solid"]
    on_ground = [j for j in r.mechanism.joints.values() if "ground" in j.links]
    assert len(feet) >= len(on_ground)


# triangles


def volume(m: TriangleMesh) -> float:
    """Of a closed surface whose triangles are counter-clockwise from outside."""
    a, b, c = (m.points[m.triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def test_a_wire_is_a_bar_of_five_sides_for_each_of_its_pieces() -> None:
    points = np.array([[0.0, 0, 0], [3, 4, 0], [3, 4, 0], [3, 4, 2]])
    area = 5 / 2 * 0.2**2 * math.sin(2 * math.pi / 5)
    assert volume(_wire(points, 0.2)) == pytest.approx((5 + 2) * area)
    assert volume(mesh(Wire(points), 0.5)) == pytest.approx(7 * area * (0.12 * 0.5 / 0.2) ** 2)


def test_meshes_are_joined_with_their_corners_counted_on() -> None:
    one = mesh(Block(np.zeros(3), np.eye(3), np.array([1.0, 2, 3])), 1.0)
    other = mesh(Ball(np.array([9.0, 8, 7]), 2.0), 1.0)
    both = join_meshes([one, other])
    assert len(both.points) == len(both.normals) == len(one.points) + len(other.points)
    assert both.triangles[len(one.triangles) :].min() == len(one.points)
    assert volume(both) == pytest.approx(48 + volume(other))
    assert 0.96 * 32 / 3 * math.pi < volume(other) < 32 / 3 * math.pi


def test_a_grid_has_two_triangles_for_each_of_its_fields() -> None:
    found = _grid(2, 3)
    assert found.shape == (12, 3)
    fields = {tuple(sorted({*map(int, t)})) for t in found}
    assert (0, 4, 5) in fields
    assert (0, 1, 5) in fields
    assert (6, 10, 11) in fields
    assert (6, 7, 11) in fields


def test_the_side_of_a_cylinder_has_normals_straight_outwards() -> None:
    ring = circle(np.array([1.0, 2, 3]), np.array([0.0, 0, 5]), 2.0, 8)
    side = _side(ring, np.array([0.0, 0, 5]))
    assert side.points[:9] == pytest.approx(ring)
    assert side.points[9:] - side.points[:9] == pytest.approx(np.tile([0, 0, 5], (9, 1)))
    assert 2 * side.normals[:9] == pytest.approx(ring - [1, 2, 3])
    assert side.normals[9:] == pytest.approx(side.normals[:9])
    assert len(side.triangles) == 16
    assert ring[0] == pytest.approx(ring[-1])


@pytest.mark.parametrize("thread", [1.5, -1.5])
def test_a_thread_advances_by_its_lead_in_a_turn(thread: float) -> None:
    bar = RoundBar(np.array([1.0, 0, 0]), np.array([1.0, 0, 6]), 2.0, thread=thread)
    points = helix(bar, 12)
    assert len(points) == 4 * 12 + 1
    assert points[:, 2] == pytest.approx(np.linspace(0, 6, 49))
    turn = np.unwrap(np.arctan2(points[:, 1], points[:, 0] - 1))
    assert turn[-1] - turn[0] == pytest.approx(math.copysign(8 * math.pi, thread))
    assert np.hypot(points[:, 0] - 1, points[:, 1]) == pytest.approx(2.0)


def test_a_solid_is_enlarged_then_turned_then_moved() -> None:
    turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    at = np.array([10.0, 20, 30])
    block: Any = place_solid(
        Block(np.array([1.0, 2, 3]), np.eye(3), np.array([4.0, 5, 6]), "outer", True), turn, at, 2.0
    )
    assert block.center == pytest.approx([10 - 4, 20 + 2, 36])
    assert block.axes == pytest.approx(np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]]))
    assert (block.half.tolist(), block.role, block.whole) == ([8, 10, 12], "outer", True)
    bar: Any = place_solid(
        RoundBar(np.array([1.0, 0, 0]), np.array([0.0, 1, 0]), 3.0, "inner", True, 0.5), turn, at, 2.0
    )
    assert (bar.start.tolist(), bar.end.tolist()) == ([10, 22, 30], [8, 20, 30])
    assert (bar.radius, bar.thread, bar.role, bar.whole) == (6.0, 1.0, "inner", True)
