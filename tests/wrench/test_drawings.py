"""Drawings of force systems as data: to the stated scale, the polygon's gap is the resultant, texts cover nothing."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.units import Units
from dalembert.views.force_system import (
    SystemDrawing,
    clip_line,
    force_system_polygon_scene,
    force_system_scene,
    reduced_scene,
)
from dalembert.views.notation import Figures, Notation
from dalembert.views.paper.lettering import text_width
from dalembert.views.paper.scene import Arc, Circle, Line
from dalembert.views.space.camera import CAMERAS, Camera
from dalembert.wrench import Couple, Force, System
from tests.methods.readable import text_over_lines, text_overlaps
from tests.wrench.random_systems import DIMENSIONS, SEEDS, random_system

both = pytest.mark.parametrize("d", DIMENSIONS)
each = pytest.mark.parametrize("seed", SEEDS)


def check(scene: Any) -> None:
    assert text_overlaps(scene) == []
    assert text_over_lines(scene) == []
    json.dumps(scene.to_dict())
    for arrow in scene.arrows():
        if arrow.kind in ("force", "force-seen", "moment-seen"):
            assert arrow.length * scene.scales[arrow.kind] == pytest.approx(arrow.value, rel=1e-9)


@both
@each
def test_texts_cover_nothing_and_arrows_are_to_scale(seed: int, d: int) -> None:
    s = random_system(seed, d)
    check(force_system_scene(s))
    check(reduced_scene(s, np.zeros(d)))
    check(force_system_scene(s + System(*s.equilibrant())))


@each
def test_the_polygons_gap_is_the_resultant(seed: int) -> None:
    s = random_system(seed, 2)
    scene = force_system_polygon_scene(s)
    check(scene)
    heads = {a.of: np.subtract(a.head, a.tail) for a in scene.arrows()}
    whole = heads.pop("R")
    assert whole == pytest.approx(sum(heads.values()), abs=1e-9)
    assert whole * scene.scales["force"] == pytest.approx(s.resultant)
    closed = force_system_polygon_scene(s + System(*s.equilibrant()))
    assert "R" not in {a.of for a in closed.arrows()}
    assert closed.numbers["gap"] <= 1e-12 * closed.numbers["largest"]


@each
def test_the_resultant_stands_on_its_line(seed: int) -> None:
    """Back from paper to metres: the arrow's tail has no moment left, in the plane to a rounding."""
    s = random_system(seed, 2)
    scene = force_system_scene(s)
    arrows = [a for a in scene.arrows() if a.of == "R"]
    assert bool(arrows) != any("outside this drawing" in t.text for t in scene.texts())
    if arrows:
        first = next(a for a in scene.arrows() if a.of == "F0")
        metres = np.subtract(arrows[0].tail, first.tail) * scene.scales["length"] + s.forces[0].at
        assert s.moment(metres) == pytest.approx(0.0, abs=1e-9)


def test_what_is_said() -> None:
    plate = System(Force([40, 0], at=[-7, 0]), Force("80 @ 30 N"), Couple(140))
    texts = " ".join(t.text for t in da.draw.force_system(plate, at=[0, 0]).texts())
    assert "The system is a single force: R = (109.3, 40.00) N, 116.4 N ∠ 20.10°." in texts
    assert "d = 1.203 m" in texts
    assert "Force and couple at (0, 0) m" in texts
    assert "R = (109.3, 40.00) N, M = 140.0 N·m." in texts
    couple = System(Force([5, 0]), Force([-5, 0], at=[0, 2]))
    assert "The system is a couple: 10.00 N·m." in " ".join(
        t.text for t in force_system_scene(couple).texts()
    )


def test_a_free_body_of_a_result() -> None:
    r = da.dynamics(da.load(examples()["four_bar"]))
    scene = da.draw.force_system(da.wrench.on(r, "coupler"))
    texts = [t.text for t in scene.texts()]
    assert "F_{A} = 154.8 lbf" in texts
    assert any(t.startswith("The system is in equilibrium") for t in texts)
    assert "The polygon is closed: the forces balance." in texts


@pytest.mark.parametrize("name", list(CAMERAS))
def test_space_from_every_side(name: str) -> None:
    s = random_system(3, 3)
    check(da.draw.force_system(s, camera=name))
    check(da.draw.force_system(s, camera=Camera(1.0, -0.3)))


def test_no_such_view() -> None:
    with pytest.raises(da.ModelError, match="unknown view 'isometrc'; did you mean 'isometric'"):
        da.draw.force_system(random_system(1, 3), camera="isometrc")


@pytest.mark.parametrize("seed", range(5))
def test_cameras(seed: int) -> None:
    """Right, up and eye are a right-handed triad; seen size and depth make up the whole."""
    rng = np.random.default_rng(seed)
    camera = Camera(float(rng.uniform(-4, 4)), float(rng.uniform(-1.5, 1.5)))
    triad = np.stack([camera.right, camera.up, camera.eye])
    assert triad @ triad.T == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(triad) == pytest.approx(1.0)
    assert camera.up[2] >= 0
    v = rng.normal(size=(6, 3))
    seen = np.linalg.norm(camera(v), axis=-1)
    assert np.hypot(seen, camera.depth(v)) == pytest.approx(np.linalg.norm(v, axis=-1))
    assert camera.order(v) == list(np.argsort(camera.depth(v)))


def test_named_views() -> None:
    x, y, z = CAMERAS["isometric"](np.eye(3))
    assert [math.hypot(*a) for a in (x, y, z)] == pytest.approx([math.sqrt(2 / 3)] * 3)
    assert [float(x @ y), float(y @ z)] == pytest.approx([-1 / 3] * 2)
    for name, (right, up) in {"front": "xz", "side": "yz", "top": "xy"}.items():
        seen = dict(zip("xyz", CAMERAS[name](np.eye(3)), strict=True))
        assert seen[right] == pytest.approx([1, 0], abs=1e-15)
        assert seen[up] == pytest.approx([0, 1], abs=1e-15)


def test_a_force_of_no_size_is_not_in_the_polygon() -> None:
    scene = force_system_polygon_scene(System(Force([3, 0]), Force([0, 0], at=[1, 1]), Force([0, 4])))
    assert [a.length for a in scene.arrows()] == pytest.approx([20, 80 / 3, 100 / 3])
    assert not any("F_{2}" in t.text for t in scene.texts())


def test_lines_in_a_box() -> None:
    assert clip_line((0, 20), (1, 0), (-10, 0, 10, 8)) is None
    assert clip_line((0, 0), (1, 1), (-2, -1, 2, 3)) == ((-1, -1), (2, 2))
    assert clip_line((1, 0), (1, -2), (-2, -1, 2, 3)) == ((-0.5, 3.0), (1.5, -1.0))
    assert clip_line((1, 0), (0, 3), (-2, -1, 2, 3)) == ((1, -1), (1, 3))
    assert clip_line((3, 0), (0, 3), (-2, -1, 2, 3)) is None
    assert clip_line((1, 0), (0, 0), (-2, -1, 2, 3)) is None
    assert clip_line((-5, 0), (1, 1), (-2, -1, 2, 3)) is None


PLATE = [
    Force([40, 0], at=[-7, 0], name="F1"),
    Force([10, -50], at=[-5, 4], name="F2"),
    Couple(140, name="M1"),
    Couple(-260, name="M2"),
]


def test_where_everything_of_a_plane_system_stands() -> None:
    """Forces at their points, axes at the origin, the resultant's distance from it, couples in a row below."""
    s = System(*PLATE)
    scene = force_system_scene(s)
    per_mm, per_newton = scene.scales["length"], scene.scales["force"]
    arrows = {a.of: a for a in scene.arrows() if a.kind == "force"}
    axes = [a for a in scene.arrows() if a.role == "axis-arrow"]
    origin = np.array(axes[0].tail)
    for name, force in (("F1", PLATE[0]), ("F2", PLATE[1])):
        tail = np.subtract(arrows[name].tail, origin) * per_mm
        assert tail == pytest.approx(force.at)
        assert np.subtract(arrows[name].head, arrows[name].tail) * per_newton == pytest.approx(force.vector)
        assert any(
            isinstance(i, Circle) and i.center == arrows[name].tail and i.role == "mark" for i in scene.items
        )
    assert [tuple(np.subtract(a.head, a.tail)) for a in axes] == [
        pytest.approx((9, 0)),
        pytest.approx((0, 9)),
    ]
    foot, moment = [a.head for a in scene.arrows() if a.kind == "dimension"], s.moment([0, 0])
    ends = sorted(math.dist(p, origin) for p in foot)
    assert ends == pytest.approx([0.0, abs(moment) / np.hypot(*s.resultant) / per_mm])
    arcs = [i for i in scene.items if isinstance(i, Arc)]
    assert [math.copysign(1, a.end - a.start) for a in arcs] == [1, -1]
    assert [a.value for a in arcs] == [140, -260]
    assert arcs[0].center[1] == arcs[1].center[1] < min(a.tail[1] for a in arrows.values())
    assert arcs[1].center[0] - arcs[0].center[0] == pytest.approx(text_width("M_{1} = 140.0 N·m", 2.8) + 6.0)
    assert scene.numbers == {
        "kind": "single force",
        "resultant": math.hypot(50, 50),
        "moment": 0.0,
        "pitch": 0.0,
    }
    (line,) = (np.array(i.points) for i in scene.items if isinstance(i, Line) and i.role == "resultant")
    for end in line:
        assert s.moment((end - origin) * per_mm) == pytest.approx(0.0, abs=1e-6)
    marks = np.array(
        [p for a in scene.arrows() if a.kind == "force" and a.of != "R" for p in (a.tail, a.head)]
    )
    assert line.min(axis=0)[1] == pytest.approx(min(marks[:, 1].min(), origin[1]) - 8.0, abs=9.0)
    polygon = force_system_polygon_scene(s)
    assert {polygon.arrows()[0].tail, polygon.arrows()[-1].tail} == {(0.0, 0.0)}
    texts = " ".join(t.text for t in scene.texts())
    assert "M_{1} = 140.0 N·m" in texts
    assert "M_{2} = 260.0 N·m" in texts


BOX = [
    Force([20, 10, 5], at=[0, 0, 0], name="F1"),
    Force([0, -10, 30], at=[8, 4, 6], name="F2"),
    Couple([5, 0, 12], name="M1"),
]


@pytest.mark.parametrize("camera", [CAMERAS["isometric"], Camera(1.0, 0.3)])
def test_where_everything_of_a_space_system_stands(camera: Camera) -> None:
    """Components lead along the axes to the head, places stand over the floor, the couple has its own scale."""
    s = System(*BOX)
    scene = force_system_scene(s, camera=camera)
    per_mm, per_newton, per_couple = (scene.scales[k] for k in ("length", "force-seen", "moment-seen"))
    arrows = {a.of: a for a in scene.arrows() if a.kind == "force-seen"}
    first = np.array(arrows["F1"].tail)
    for force in BOX[:2]:
        a = arrows[force.name]
        assert np.subtract(a.tail, first) * per_mm == pytest.approx(camera(force.at), abs=1e-9)
        assert np.subtract(a.head, a.tail) * per_newton == pytest.approx(camera(force.vector))
        ways = [i.points for i in scene.items if isinstance(i, Line) and i.role == "construction"]
        (way,) = (w for w in ways if w[0] == a.tail)
        assert way[-1] == pytest.approx(a.head)
        steps = [
            v
            for k in range(3)
            if np.hypot(*(v := camera(force.vector[k] * np.eye(3)[k]) / per_newton)) > 0.05
        ]
        assert np.diff(np.array(way), axis=0) == pytest.approx(np.array(steps))
    couple = next(a for a in scene.arrows() if a.of == "M1" and a.kind)
    assert np.subtract(couple.head, couple.tail) * per_couple == pytest.approx(camera(BOX[2].vector))
    high = camera([8, 4, 0]) / per_mm + first
    grid = [i.points for i in scene.items if isinstance(i, Line) and i.role == "grid"]
    assert any(
        p[1] == pytest.approx(high) and p[0] == pytest.approx(camera([8, 4, 6]) / per_mm + first)
        for p in grid
    )
    floor = [p for p in grid if len(p) == 5]
    low, high = (f([[0, 0, 0], [8, 4, 6], s.central_axis().axis.point], axis=0) for f in (np.min, np.max))
    corners = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
    expected = np.array([camera([*c, min(0.0, low[2])]) for c in (*corners, corners[0])]) / per_mm + first
    assert np.array(floor) == pytest.approx(expected[None])
    found = s.central_axis()
    assert scene.numbers["kind"] == "wrench"
    assert (scene.numbers["moment"], scene.numbers["pitch"]) == (found.moment, found.pitch)
    notes = " ".join(t.text for t in scene.texts() if t.role == "note")
    assert "The system is a wrench: R = (20.00, 0, 35.00) N, 40.31 N, on the line through " in notes
    short = [float(np.hypot(*camera(e))) for e in np.eye(3)]
    assert f"foreshortening along x, y and z: {', '.join(f'{x:.3f}' for x in short)}" in notes
    reduced = reduced_scene(s, [1, 2, 0], camera=camera)
    mark = next(i for i in reduced.items if isinstance(i, Circle) and i.role == "mark")
    whole = s.reduced([1, 2, 0])
    for name, v, scale in (("R", whole.force, "force-seen"), ("M", whole.vector, "moment-seen")):
        a = next(x for x in reduced.arrows() if x.of == name and x.kind)
        assert a.tail == pytest.approx(mark.center)
        assert np.subtract(a.head, a.tail) * reduced.scales[scale] == pytest.approx(camera(v))


@pytest.mark.parametrize("moment", [30.0, -30.0])
def test_the_couple_of_a_wrench_lies_on_its_axis(moment: float) -> None:
    """Ahead of the force, or behind where it turns the other way."""
    camera = Camera(0.6, 0.3)
    s = System(Force([0, 20, 0], name="F"), Couple([0, moment, 0], name="C"))
    scene = force_system_scene(s, camera=camera)
    force = next(a for a in scene.arrows() if a.of == "R")
    couple = next(a for a in scene.arrows() if a.of == "M" and a.kind)
    e = np.subtract(force.head, force.tail) / force.length
    start = force.head if moment > 0 else force.tail
    assert np.subtract(couple.tail, start) == pytest.approx(math.copysign(3.0, moment) * e)
    assert np.subtract(couple.head, couple.tail) @ e * moment > 0


def test_one_line_of_forces_in_space_is_a_single_force() -> None:
    s = System(Force([0, 0, 5], at=[1, 2, 0]), Force([0, 0, -2], at=[1, 2, 7]))
    words = " ".join(t.text for t in force_system_scene(s).texts())
    assert (
        "The system is a single force: R = (0, 0, 3.000) N, 3.000 N, on the line through (1.000, 2.000, "
        in words
    )
    left = System(Force([0, 5], at=[-3, -2]), Force([1, 0], at=[-3 - 1e-12, -4]))
    assert any("(−3.000, −" in t.text for t in reduced_scene(left, [-3.0, -4.0]).texts())


def test_coordinates_that_are_rounding_beside_others_are_zero() -> None:
    drawing = SystemDrawing(System(*PLATE), Figures(Units(), Notation()), None)
    assert drawing.coordinates(np.array([-1e12, -1.0])) == "(−1.000e+12, 0) m"
    assert drawing.coordinates(np.array([1e-12, -1.0])) == "(0, −1.000) m"


def test_what_is_far_off_is_said() -> None:
    """A line of action that passes far from all forces; axes stand in the corner where the origin is far."""
    far = System(Force([0, 1.0], at=[0, 0]), Force([0, -0.99], at=[1, 0]))
    scene = force_system_scene(far)
    assert any("outside this drawing: it passes through (" in t.text for t in scene.texts())
    assert not [a for a in scene.arrows() if a.of == "R"]
    shifted = force_system_scene(System(Force([3, 4], at=[500, 500]), Force([1, 0], at=[501, 501])))
    axes = [a for a in shifted.arrows() if a.role == "axis-arrow"]
    assert {a.tail for a in axes} == {axes[0].tail}
    low = np.min([a.tail for a in shifted.arrows() if a.kind == "force"], axis=0)
    assert axes[0].tail[0] < low[0]
    assert axes[0].tail[1] < low[1]


def test_panels_of_many_forces_stand_in_a_column_of_a_page() -> None:
    """The system, its polygon and what it is at another point: no wider together than 240 mm."""
    wide = [Force([0, -1 - k], at=[4.0 * k, 0]) for k in range(4)]
    drawn = da.draw.force_system(System(*wide, title="A beam"), at=[1, 1])
    left, _, right, _ = drawn.bounds
    assert right - left <= 240 + 1e-9
    assert drawn.title == "A beam"
    assert text_overlaps(drawn) == []
