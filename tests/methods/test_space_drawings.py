"""Drawings in space as data: to scale, all joints there, both parts of a joint meet, texts cover nothing."""

from __future__ import annotations

import json
import math
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

import dalembert as da
from dalembert.algebra import space
from dalembert.arrays import Array
from dalembert.bundled import examples
from dalembert.machine.shaking import shaking_force
from dalembert.model.joints.pairs import PAIRS
from dalembert.views.paper.scene import Line, Polygon, Text
from dalembert.views.space.camera import CAMERAS, Camera
from dalembert.views.space.link_solids import link_solids, mount, pose
from dalembert.views.space.painter import paint
from dalembert.views.space.solids import (
    Ball,
    Block,
    GlassTube,
    Pane,
    Plate,
    RoundBar,
    Solid,
    Wire,
    helix,
)
from dalembert.views.space.space_mechanism import every_place, full_sight
from dalembert.views.symbols.joint_solids import wheel_solids
from dalembert.views.symbols.pair_symbols import SYMBOLS, symbol
from tests.methods.readable import text_over_lines, text_overlaps
from tests.methods.space_machines import MACHINES, solved
from tests.oracles.space import random_drawn
from tests.tiers import crossed, tiers

each = pytest.mark.parametrize("name", list(MACHINES))
VIEWS: list[Any] = ["isometric", "front", "top", "side", (20.0, 35.0)]


def check(scene: Any) -> None:
    """No text covers a line or a text, every vector is as long as it is seen, and every format can write it."""
    assert text_overlaps(scene) == []
    assert text_over_lines(scene) == []
    for arrow in scene.arrows():
        if arrow.kind:
            assert arrow.length * scene.scales[arrow.kind] == pytest.approx(arrow.value, rel=1e-9)
    ElementTree.fromstring(scene.to_svg())
    json.dumps(scene.to_dict())


@crossed("name, camera", MACHINES, VIEWS)
def test_mechanisms_from_every_side(name: str, camera: Any) -> None:
    r = solved(name)
    scene = da.draw.mechanism(r, at=4, camera=camera, forces=True)
    check(scene)
    texts = [t.text for t in scene.texts()]
    assert set(r.joints) <= set(texts)
    assert any(t.startswith("Lengths across the view: 1 mm = ") for t in texts)


@each
def test_places_are_to_scale(name: str) -> None:
    """A distance on paper is that across the view, divided by the scale."""
    r = solved(name)
    camera = Camera(0.4, 0.7)
    s = full_sight(r, 0, camera, 100.0, 80.0)
    for p, q in pairwise(every_place(r, 0)):
        across = (p - q) - float((p - q) @ camera.eye) * camera.eye
        assert math.dist(s(p), s(q)) * s.frame.per_mm == pytest.approx(
            float(np.linalg.norm(across)), abs=1e-12
        )


@each
def test_both_parts_of_a_joint_meet(name: str) -> None:
    """At every position the directions that a joint keeps together are together, those across are across."""
    r = solved(name)
    for joint in r.joints:
        m, pair = mount(r, joint), PAIRS[r.mechanism.joints[joint].type]
        for k in range(0, len(r.status), 5):
            (ri, pi), (rj, pj) = (pose(r, link, k) for link in m.links)
            on_i, on_j = m.axes[0] @ ri.T, m.axes[1] @ rj.T
            held = pair.forces.replace("x", "") if m.kind == "screw" else pair.forces
            away = on_i @ (rj @ m.points[1] + pj - ri @ m.points[0] - pi)
            assert [float(away["xyz".index(a)]) for a in held] == pytest.approx([0.0] * len(held), abs=1e-9)
            if len(pair.turns) == 1:
                axis = "xyz".index(pair.turns)
                assert on_i[axis] == pytest.approx(on_j[axis], abs=1e-9)
            if len(pair.turns) == 2:
                first, second = ("xyz".index(a) for a in pair.turns)
                assert float(on_i[first] @ on_j[second]) == pytest.approx(0.0, abs=1e-9)


def extent(solid: Solid) -> Array:
    """Points (n, 3) that a solid reaches, as far as a box around it needs them."""
    if isinstance(solid, (Plate, Pane)):
        return solid.corners
    if isinstance(solid, Wire):
        return solid.points
    if isinstance(solid, Block):
        return block_corners(solid)
    reach = solid.radius + getattr(solid, "thickness", 0.0)
    ends = [solid.start, solid.end] if isinstance(solid, (RoundBar, GlassTube)) else [solid.center]
    return np.array([p + reach * e for p in ends for e in (*np.eye(3), *-np.eye(3))])


def block_corners(block: Block) -> Array:
    """The eight corners (8, 3), x slowest."""
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    return np.asarray(block.center + (signs * block.half) @ block.axes)


@each
def test_bars_reach_their_joints(name: str) -> None:
    """Every joint of a link has a solid of that link near it; a slide's rail is where j goes."""
    r, size = solved(name), 0.002
    found = link_solids(r, size)
    for joint in r.joints:
        m = mount(r, joint)
        rail = m.points[0] + m.low @ m.axes[0]
        for link, at in zip(m.links, (rail, m.points[1]), strict=True):
            near = [np.linalg.norm(extent(s) - at, axis=1).min() for s in found[link]]
            assert min(near) < 12 * size, (joint, link)


def test_strokes_of_the_ground_start_at_the_edge_of_its_square() -> None:
    solids = link_solids(solved("rssr"), 0.002)["ground"]
    squares = [s.corners for s in solids if isinstance(s, Plate)]
    strokes = [s.points[0] for s in solids if isinstance(s, Wire) and s.role == "hatch"]
    assert len(strokes) == 20 * len(squares) > 0
    for p in strokes:
        sides = [(a, b) for square in squares for a, b in pairwise([*square, square[0]])]
        around = [np.linalg.norm(p - a) + np.linalg.norm(p - b) - np.linalg.norm(a - b) for a, b in sides]
        assert min(around) < 1e-12


def test_a_small_wheel_is_no_worm() -> None:
    """Drawn where a wheel is thicker than its radius; the first wheel of a worm gear alone is a threaded bar."""
    for name, bars in (("bevel_differential", 0), ("worm_gear", 1)):
        r = da.kinematics(getattr(da, name)(), 1)
        joint = next(n for n, j in r.mechanism.joints.items() if getattr(j, "wheels", None))
        solids = [solid for _, solid in wheel_solids(r, joint, 100.0)]
        assert sum(isinstance(solid, RoundBar) for solid in solids) == bars


def test_a_link_that_is_one_point_has_a_free_body() -> None:
    tree: Any = {
        "space": "space",
        "gravity": "standard",
        "links": {"ground": {"points": {"O": [0, 0, 0]}}, "ball": {"points": {"O": [0, 0, 0]}, "mass": 2}},
        "joints": {"O": {"type": "prismatic", "links": ["ground", "ball"], "axis": [0, 0, 1]}},
        "drives": {"O": {"position": 0.1}},
    }
    check(da.draw.free_body(da.statics(da.mechanism(tree)), "ball"))


@each
@pytest.mark.parametrize("camera", ["isometric", "front"])
def test_free_bodies(name: str, camera: str) -> None:
    r = solved(name)
    for link in r.links:
        check(da.draw.free_body(r, link, at=4, camera=camera))
    assert text_overlaps(da.draw.free_bodies(r, at=4, camera=camera)) == []


@each
def test_components_make_up_the_reaction(name: str) -> None:
    """The arrows of a joint on a link add to its force and to its moment as they are seen."""
    r = solved(name)
    for link in r.links:
        scene = da.draw.free_body(r, link, at=4)
        for joint in (n for n in r.joints if link in r.mechanism.joints[n].links):
            least, axes = r.least_norm(joint, link, "joint")[3], r.joint_axes(joint)[3]
            for kind, part in (("force-seen", least[:3]), ("moment-seen", least[3:])):
                some = [
                    a for a in scene.arrows() if a.of == joint and a.kind == kind and a.role == "joint-force"
                ]
                per_mm = scene.scales.get(kind, math.inf)
                seen = [v / per_mm for v in CAMERAS["isometric"](part[:, None] * axes)]
                longer = [v for v in seen if np.hypot(*v) >= 0.6]
                assert len(some) == len(longer)
                total = sum((np.subtract(a.head, a.tail) for a in some), np.zeros(2))
                assert total == pytest.approx(sum(longer, np.zeros(2)), abs=1e-6)


@pytest.mark.parametrize("seed", tiers(range(2), range(2, 10), range(10, 40)))
def test_random_mechanisms_of_all_pairs(seed: int) -> None:
    r = da.dynamics(da.mechanism(random_drawn.mechanism(seed)[0]))
    check(da.draw.mechanism(r, at=1, camera=(200.0, -25.0), forces=True))
    for link in r.links:
        check(da.draw.free_body(r, link, at=1))
    assert len(da.draw.solid_model(r).document["nodes"]) == len(r.links) + 2


def test_the_table_of_a_free_body() -> None:
    r = solved("shaft")
    texts = [t.text for t in da.draw.free_body(r, "shaft", at=4).texts()]
    fx, fy, fz = r.reaction("A", axes="joint")[3]
    row = texts.index("A", texts.index("F_{z'}"))
    shown = [float(t.replace("−", "-")) for t in texts[row + 1 : row + 4]]
    assert shown == pytest.approx([fx, fy, fz], rel=1e-3)
    assert texts[row + 4 : row + 7] == ["–"] * 3


def test_what_is_not_unique_stands_in_brackets() -> None:
    texts = [t.text for t in da.draw.free_body(solved("press"), "ram", at=4).texts()]
    assert any("not unique, least-norm values" in t for t in texts)
    assert any(t.startswith("(") and t.endswith(")") for t in texts)


def test_loads_in_the_turn_of_a_joint_have_their_symbols_about_its_axis() -> None:
    """A spiral in the plane across the axis, seen aslant."""
    m = da.load(examples()["rssr"])
    loads = {"coil": {"type": "torsion_spring", "joint": "C", "stiffness": "3 N*m/rad"}}
    sprung = da.mechanism({**m.to_tree(), "loads": loads})
    drawn = da.draw.mechanism(da.statics(sprung)).flat()
    (spiral,) = (item for item in drawn if isinstance(item, Line) and item.role == "spring")
    points = np.array(spiral.points)
    assert len(points) > 40
    flat = np.linalg.svd(points - points.mean(axis=0))[1]
    assert 0.3 < flat[1] / flat[0] < 1.0


def test_near_things_cover_far_ones() -> None:
    """Of two crossing bars, and of balls one behind the other, the nearer is painted later."""
    x, y, z = np.eye(3)
    top = CAMERAS["top"]
    bars = [RoundBar(-20 * x + 3 * z, 20 * x + 3 * z, 1.0, "outer"), RoundBar(-20 * y, 20 * y, 1.0, "inner")]
    roles = [i.role for i in paint(bars, top) if isinstance(i, Polygon)]
    assert roles.index("inner-fill") < roles.index("outer-fill")
    balls = [Ball(k * np.array([1.0, 1.0, 1.0]), 1.0, role) for k, role in ((2, "a"), (0, "b"), (1, "c"))]
    order = [i.role for i in paint(balls, CAMERAS["isometric"]) if "spot" not in i.role]  # type: ignore[union-attr]
    assert order == ["b", "c", "a"]


def test_wires_are_cut_so_that_each_piece_has_its_own_depth() -> None:
    """A wire towards the eye goes partly behind a ball on it, and partly before."""
    wire, ball = (
        Wire(np.array([[0.0, -20.0, 0.0], [0.0, 20.0, 0.0]]), "outline"),
        Ball(np.zeros(3), 3.0, "link"),
    )
    items = paint([wire, ball], CAMERAS["front"])
    lines = [k for k, item in enumerate(items) if isinstance(item, Line) and item.role == "outline"]
    assert len(lines) == 16  # of 40 mm
    covered = next(k for k, item in enumerate(items) if not isinstance(item, Line))
    assert sum(k < covered for k in lines) == 8


def test_every_pair_has_a_symbol() -> None:
    assert set(SYMBOLS) == set(PAIRS)
    for kind in SYMBOLS:
        found = symbol(kind)
        assert found.on_i
        assert found.on_j or kind == "weld"


@each
def test_charts(name: str) -> None:
    scene = da.draw.charts(solved(name))
    assert text_overlaps(scene) == []


def test_rounding_noise_is_no_force() -> None:
    """The output shaft turns about its mass centre: its inertia force is rounding beside its couple."""
    texts = [t.text for t in da.draw.mechanism(solved("hooke"), at=5, forces=True).texts()]
    assert any(t.startswith("T_{I3} = ") for t in texts)
    assert not any(t.startswith("F_{I3}") or "forces: 1 mm" in t for t in texts)


@pytest.mark.long
def test_a_position_without_a_pose_is_refused_with_its_reason() -> None:
    """Others are drawn, and move; where only the forces are missing they are left out."""
    long = da.mechanism(MACHINES["rssr"]).with_values({"links.crank.points.B": ["0.2 m", "0 m", "0 m"]})
    r = da.dynamics(long, positions=8)
    bad = r.status.index("not_assembled")
    for drawn in (
        lambda: da.draw.mechanism(r, at=bad + 1),
        lambda: da.draw.free_body(r, "rocker", at=bad + 1),
    ):
        with pytest.raises(da.AnalysisError, match=f"position {bad + 1}: "):
            drawn()
    check(da.draw.mechanism(r))
    assert len(da.draw.animation(r).frames) == int(r.ok.sum())


PLANE_ONLY = [
    "force_chain",
    "velocity_polygon",
    "acceleration_polygon",
    "instant_centers",
    "motion",
    "superposition",
]


@pytest.mark.parametrize("noun", PLANE_ONLY)
def test_what_is_of_the_plane_is_refused(noun: str) -> None:
    with pytest.raises(da.ModelError, match="is for planar mechanisms, but this one is in space"):
        getattr(da.draw, noun)(solved("rssr"))


@pytest.mark.parametrize("noun", ["force_polygon", "lines_of_action", "displaced_inertia", "components"])
def test_what_is_of_plane_links_is_refused(noun: str) -> None:
    with pytest.raises(da.ModelError, match="is for planar mechanisms, but this one is in space"):
        getattr(da.draw, noun)(solved("rssr"), "rocker")


def test_a_camera_needs_space() -> None:
    from dalembert.model.library import four_bar

    with pytest.raises(da.ModelError, match="a camera looks at a mechanism in space"):
        da.draw.mechanism(da.solve(four_bar()), camera="top")


@pytest.mark.parametrize("kind", ["svg", "gif"])
def test_animations(kind: str, tmp_path: Path) -> None:
    if kind == "gif":
        pytest.importorskip("matplotlib")
        pytest.importorskip("PIL")
    drives = {"A": {"position": {"from": 0, "to": 90, "count": 3}, "speed": "10 rad/s"}}
    animation = da.draw.animation(solved("rssr", drives=drives), camera="front")
    animation.save(tmp_path / f"a.{kind}")
    assert len(animation.frames) == 3
    axes = [i for i in animation.still if isinstance(i, Text) and i.text in ("x", "y", "z")]
    assert [i.text for i in axes] == ["x", "z"], "seen from the front"
    for scene in animation.frames:
        for arrow in scene.arrows():
            if arrow.kind:
                assert arrow.length * animation.scales[arrow.kind] == pytest.approx(arrow.value, rel=1e-9)


@pytest.mark.parametrize("theme", ["light", "dark", "print"])
def test_every_theme(theme: Any) -> None:
    assert da.draw.mechanism(solved("hooke")).to_svg(theme).startswith("<svg")


@pytest.mark.parametrize("seed", range(20))
def test_quaternions(seed: int) -> None:
    """The rotation by the quaternion's angle about its axis is the rotation, half turns too."""
    rng = np.random.default_rng(seed)
    n = rng.normal(size=3)
    n /= np.linalg.norm(n)
    for angle in (0.0, 1e-9, rng.uniform(0, np.pi), np.pi - 1e-9, np.pi):
        r = space.exp(n * angle)
        q = space.quaternion(r)
        w = 2 * math.atan2(float(np.linalg.norm(q[:3])), float(q[3]))
        axis = q[:3] / max(float(np.linalg.norm(q[:3])), 1e-300)
        assert space.exp(axis * w) == pytest.approx(r, abs=1e-14)
        assert float(q @ q) == pytest.approx(1.0)


def lifted() -> da.Result:
    """A plane four-bar in space, redundant at every position."""
    return da.dynamics(da.lifted(da.four_bar(), {"coupler": "20 mm"}), positions=6)


def test_redundant_positions_move_and_are_named() -> None:
    """The motion is drawn, and said that forces are those of least norm."""
    r = lifted()
    assert not r.ok.any()
    animation = da.draw.animation(r)
    assert len(animation.frames) == 6
    for frame in animation.frames:
        assert any("redundant, forces not unique: those of least norm" in t.text for t in frame.texts())


def test_the_shaking_force_is_unique_where_reactions_are_not() -> None:
    """A plane mechanism shakes its ground alike in the plane and in space."""
    plane = da.dynamics(da.four_bar(), positions=6)
    flat, lift = shaking_force(plane), shaking_force(lifted())
    largest = float(np.abs(flat).max())
    assert lift[:, :2] == pytest.approx(flat, abs=1e-10 * largest)
    assert lift[:, 2] == pytest.approx(0, abs=1e-10 * largest)


@pytest.mark.parametrize("thread", [2.0, -3.0])
def test_a_thread_lies_on_its_cylinder(thread: float) -> None:
    """Right-handed where positive: it turns about its axis as it goes along, by one turn a lead."""
    start, along = np.array([1.0, 2.0, 3.0]), np.array([2.0, -1.0, 2.0]) / 3
    points = helix(RoundBar(start, start + 10 * along, 1.5, "link", thread=thread)) - start
    height = points @ along
    radial = points - height[:, None] * along
    assert (height[0], height[-1]) == pytest.approx((0, 10))
    assert np.linalg.norm(radial, axis=1) == pytest.approx(1.5)
    turned = np.cross(radial[:-1], radial[1:]) @ along
    assert np.sign(turned) == pytest.approx(np.sign(thread))
    assert np.abs(np.arcsin(turned / 1.5**2)).sum() == pytest.approx(2 * np.pi * 10 / abs(thread), rel=1e-9)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_worm_of_either_hand_is_a_threaded_bar(sign: float) -> None:
    tree = da.worm_gear().to_tree()
    (name,) = (n for n, j in tree["joints"].items() if "helix_angle" in j)
    size = abs(math.degrees(da.worm_gear().joints[name].helix_angle))
    tree["joints"][name]["helix_angle"] = f"{sign * size!r} deg"
    r = da.kinematics(da.mechanism(tree), 1)
    assert sum(isinstance(solid, RoundBar) for _, solid in wheel_solids(r, name, 100.0)) == 1
