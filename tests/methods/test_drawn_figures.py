"""What a drawing shows is what was computed: senses, arms and forces read back from its lines and words."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import actions
from dalembert.bundled import cases, examples
from dalembert.machine.shaking import shaking_force
from dalembert.views.charts import shaking_chart
from dalembert.views.force_system import force_system_scene
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.scene import Arc, Arrow, Circle, Line, Polygon, Scene, Text
from dalembert.views.plane.circle_details import pin_detail
from dalembert.views.plane.guide_details import faces_of, guide_detail
from dalembert.views.space.camera import Camera
from tests.friction.engines import engine


def cross(a: Any, b: Any) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


POINTS = {"crank": "OA", "rod": "AB", "piston": "B"}


@pytest.mark.parametrize("speed", [1.0, -1.0])
@pytest.mark.parametrize("joint", ["O", "A", "B"])
def test_turning_and_side_of_a_friction_circle(joint: str, speed: float) -> None:
    """The curved arrow turns as the link does against the other one; the reaction's arm makes friction's couple."""
    r = da.statics(engine(mu=0.2).with_values({"drives.O.speed": speed}))
    links = r.mechanism.joints[joint].links
    for on, other in (ends for ends in (links, links[::-1]) if ends[0] != "ground"):
        scene = pin_detail(r, joint, 0, Shown(r, Notation(), 0), on)
        turning = float(r.speed(on)[0]) - (float(r.speed(other)[0]) if other != "ground" else 0.0)
        (arc,) = (i for i in scene.items if isinstance(i, Arc) and i.role == "velocity")
        assert arc.arrow
        assert (arc.end - arc.start) * turning > 0
        middle, at = (arc.start + arc.end) / 2, r.point(on, joint)[0]
        away = sum(
            (v / math.hypot(*v) for v in (r.point(on, n)[0] - at for n in POINTS[on] if n != joint)),
            np.zeros(2),
        )
        off_line = abs(cross(r.reaction(joint, on)[0], (math.cos(middle), math.sin(middle))))
        assert off_line / math.hypot(*r.reaction(joint, on)[0]) > math.sin(math.radians(54.9))
        if away.any():
            assert away @ (math.cos(middle), math.sin(middle)) < -0.5 * math.hypot(*away)
        assert any("μ = " in t.text for t in scene.texts())
        (arrow,) = (i for i in scene.items if isinstance(i, Arrow) and i.role == "joint-force")
        force = r.reaction(joint, on)[0]
        e = np.subtract(arrow.head, arrow.tail) / math.dist(arrow.head, arrow.tail)
        assert e == pytest.approx(force / np.hypot(*force), abs=1e-9)
        arm = cross(arrow.tail, e) * scene.scales[f"length at {joint}"]
        couple = float(r.friction_moment(joint, on)[0])
        assert arm * np.hypot(*force) == pytest.approx(couple, rel=1e-6)
        assert couple * turning < 0


NUMBER = r"(−?[\d.]+)"


@pytest.mark.parametrize("case", ["seed-000-a-four-bar-loaded-rocker", "seed-002-1-four-link-open"])
def test_the_arm_of_two_oblique_forces(case: str) -> None:
    """The dimension is drawn square to the forces, from line to line, and h times the force is the effort."""
    r = da.statics(da.load(cases()[case]))
    (drive,) = r.drives
    link = next(n for n, m in da.members(r).items() if m.kind == "two-force with couple")
    scene = da.draw.lines_of_action(r, link)
    force = r.reaction(drive, on=link)[0]
    assert min(abs(force)) > 0.05 * max(abs(force))  # oblique
    exact = abs(float(r.effort(drive)[0])) / float(np.hypot(*force))
    ends = [i.head for i in scene.items if isinstance(i, Arrow) and i.kind == "dimension"]
    span = np.subtract(*ends)
    assert np.hypot(*span) * scene.scales["length"] == pytest.approx(exact, rel=1e-9)
    assert abs(float(span @ force)) < 1e-9 * np.hypot(*span) * np.hypot(*force)
    words = " ".join(t.text for t in scene.texts())
    found = re.search(rf"forces {NUMBER} \S+ at h = {NUMBER} \S+ make the couple {NUMBER}", words)
    assert found is not None
    shown = Shown(r, Notation())
    couple = shown.value("moment", float(r.effort(drive)[0]))
    for text, value in zip(
        found.groups(),
        (np.hypot(*force) / shown.size("force"), exact / shown.size("length"), abs(couple)),
        strict=True,
    ):
        assert abs(float(text.replace("−", "-"))) == pytest.approx(value, rel=1e-3)


GUIDED_TWICE = """
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}, mass: 3, center: [0.02, 0.01], inertia: 0.01}
  rod: {points: {A: [0, 0], B: [0.4, 0]}, mass: 1, center: [0.15, 0], inertia: 0.02}
  block: {points: {B: [0, 0], C: [0.2, 0]}, mass: 2, center: [0.1, 0.02]}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, block]}
  behind: {type: slider, links: [ground, block], at: [O, B]}
  ahead: {type: slider, links: [ground, block], at: [O, C]}
drives: {O: {position: {from: 10 deg, to: 370 deg, count: 12}, speed: 20 rad/s}}
loads: {F: {type: force, on: block, at: C, value: [-50, 20]}}
gravity: standard
assembly: {rod: -5}
"""


def test_the_shaking_force_where_reactions_are_not_unique() -> None:
    """It is all that is not held inside: weights, loads and inertia forces; and that is what is drawn."""
    r = da.dynamics(da.loads(GUIDED_TWICE))
    assert set(r.status) == {"redundant"}
    assert np.isnan(r.reaction("behind")).any()
    masses = {"crank": 3.0, "rod": 1.0, "block": 2.0}
    down = np.array([0.0, -9.80665])
    total = sum(m * (down - r.center_acceleration(link)) for link, m in masses.items()) + np.array(
        [-50.0, 20.0]
    )
    assert shaking_force(r) == pytest.approx(total, rel=1e-9)
    scene = shaking_chart(r)
    (drawn,) = (item for item in scene.items if isinstance(item, Line) and item.role == "curve-1")
    size = np.array([math.hypot(*p) for p in drawn.points])
    assert len(size) >= len(total)
    scale = scene.scales["force"]
    for f in total:
        near = min(math.dist(p, f / scale) for p in drawn.points)
        assert near < 0.05, (f, near)


def test_no_arrow_is_drawn_of_rounding() -> None:
    """At the piston's greatest speed it has no acceleration; a free motion has no effort."""
    r = da.dynamics(da.load(cases()["sc-01-greatest-piston-speed"]))
    still = da.draw.displaced_inertia(r, "piston")
    assert [a for a in still.arrows() if a.kind in ("force", "acceleration")] == []
    assert "a_{G4} = 0" in [t.text for t in still.texts()]
    free = da.draw.mechanism(da.solve(da.load(cases()["sp-01-swinging-body-on-an-inclined-revolute"])))
    assert [a for a in free.arrows() if a.role == "effort"] == []
    assert not any("two heads" in t.text for t in free.texts())


SYSTEM = da.wrench.System(
    da.wrench.Force([30, 40], at=[0.5, 0.2]),
    da.wrench.Couple(-7.0),
    da.wrench.Force([15, -20]),
    title="bracket",
)


def test_a_force_system_in_the_plane_arrow_by_arrow() -> None:
    """Tails at their points, heads a force ahead, by the scales stated; the resultant on its line."""
    scene = force_system_scene(SYSTEM)
    axes = [a for a in scene.arrows() if a.role == "axis-arrow"]
    origin = np.array(axes[0].tail)
    assert [np.subtract(a.head, origin).round(9).tolist() for a in axes] == [[9.0, 0.0], [0.0, 9.0]]
    drawn = {a.of: a for a in scene.arrows() if a.of}
    force, moment = np.array([45.0, 20.0]), 0.5 * 40 - 0.2 * 30 - 7
    foot = moment * np.array([-force[1], force[0]]) / (force @ force)
    known = {"F1": ([0.5, 0.2], [30, 40]), "F2": ([0, 0], [15, -20]), "R": (foot, force)}
    assert set(drawn) == set(known)
    for name, (at, vector) in known.items():
        a = drawn[name]
        start = np.subtract(a.tail, origin) * scene.scales["length"]
        if name == "R":  # somewhere on its line
            assert np.cross([*start, 0.0], [*force, 0.0])[2] == pytest.approx(moment)
        else:
            assert start == pytest.approx(np.array(at), abs=1e-9)
        assert np.subtract(a.head, a.tail) * scene.scales["force"] == pytest.approx(np.array(vector))
        assert (a.value, a.kind) == (pytest.approx(float(np.hypot(*vector))), "force")
    (turn,) = (i for i in scene.items if isinstance(i, Arc))
    assert (turn.of, turn.value, turn.end < turn.start) == ("M1", -7.0, True)
    texts = {t.text for t in scene.texts()}
    labels = {"F_{1} = 50.00 N", "F_{2} = 25.00 N", "R = 49.24 N", "M_{1} = −7.000 N·m"}
    assert labels - texts <= {"M_{1} = −7.000 N·m"}
    assert "The system is a single force: R = (45.00, 20.00) N, 49.24 N ∠ 23.96°." in texts
    other = force_system_scene(da.wrench.System(*SYSTEM.parts[:1], da.wrench.Couple(9.0)))
    (turn,) = (i for i in other.items if isinstance(i, Arc))
    assert turn.end > turn.start


def test_a_force_system_in_space_arrow_by_arrow() -> None:
    """Through its camera; the way to each head along x, y and z; a wrench's couple along its force."""
    parts = {"F1": ([0.5, 0.2, 0.1], [30, 40, -5]), "F2": ([0, 0.4, 0.3], [10, 0, 25])}
    s = da.wrench.System(
        *(da.wrench.Force(v, at=at) for at, v in parts.values()), da.wrench.Couple([1, 2, 3.0]), title="s"
    )
    camera = Camera()
    scene = force_system_scene(s, None, camera)
    axes = [a for a in scene.arrows() if a.role == "axis-arrow"]
    origin = np.array(axes[0].tail)
    for axis, a in zip(np.eye(3), axes, strict=True):
        assert np.subtract(a.head, origin) == pytest.approx(9 * camera(axis))
    drawn = {a.of: a for a in scene.arrows() if a.of}
    for name, (at, vector) in parts.items():
        a = drawn[name]
        tail, way = np.array(a.tail), np.array(vector, float) / scene.scales["force-seen"]
        seen = (tail - origin) * scene.scales["length"]
        assert seen == pytest.approx(camera(np.array(at)), abs=1e-9)
        assert np.subtract(a.head, tail) == pytest.approx(camera(way))
        assert (a.value, a.kind) == (pytest.approx(a.length * scene.scales["force-seen"]), "force-seen")
        corners = [tail + camera(way * (np.arange(3) < k)) for k in range(4)]
        corners = [p for k, p in enumerate(corners) if not k or math.dist(p, corners[k - 1]) > 0.05]
        boxes = [i.points for i in scene.items if isinstance(i, Line) and i.role == "construction"]
        assert any(np.shape(b) == np.shape(corners) and np.allclose(b, corners) for b in boxes)
    total = np.sum([v for _, v in parts.values()], axis=0)
    assert np.subtract(drawn["R"].head, drawn["R"].tail) * scene.scales["force-seen"] == pytest.approx(
        camera(total)
    )
    couple = np.subtract(drawn["M1"].head, drawn["M1"].tail)
    assert couple / np.hypot(*couple) == pytest.approx(
        camera(np.array([1, 2, 3.0])) / np.hypot(*camera(np.array([1, 2, 3.0])))
    )
    assert drawn["M1"].kind == "moment-seen"


@pytest.mark.parametrize("link", ["crank", "coupler", "rocker"])
def test_a_free_body_in_the_plane_arrow_by_arrow(link: str) -> None:
    """Every force from its place or up to it, as far as it is large, with its number."""
    r = da.dynamics(da.load(examples()["four_bar"]))
    scene = da.draw.free_body(r, link)
    known = {(a.of, a.kind): a for a in actions(r) if a.link == link and np.hypot(*a.force[0]) > 0}
    roles = {"joint": "joint-force"}
    places: dict[Any, Any] = {}
    for (of, kind), a in known.items():
        (arrow,) = (
            x for x in scene.arrows() if (x.of, x.role, x.kind) == (of, roles.get(kind, kind), "force")
        )
        assert np.subtract(arrow.head, arrow.tail) * scene.scales["force"] == pytest.approx(a.force[0])
        assert arrow.value == pytest.approx(float(np.hypot(*a.force[0])))
        places[of, kind] = [
            np.array(end) * scene.scales["length"] - a.at[0] for end in (arrow.tail, arrow.head)
        ]
    assert len(places) >= 3
    for start in next(
        iter(places.values())
    ):  # one of the first arrow's ends is its place, and so of all others
        if all(min(np.abs(end - start).max() for end in ends) < 1e-9 for ends in places.values()):
            break
    else:
        raise AssertionError(places)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        *((999999.0, "999999"), (9999400.0, "9999400"), (9999500.0, "1.000e+07"), (1.0e7, "1.000e+07")),
        *((1e6, "1000000"), (-1e-4, "−0.0001000"), (9.9999e-5, "0.0001000"), (9.9e-5, "9.900e−05")),
        *((0.0, "0"), (-0.0, "0"), (float("nan"), "-"), (1234.56, "1235"), (-12.3456, "−12.35")),
    ],
)
def test_a_number_for_show_from_both_sides_of_its_limits(value: float, text: str) -> None:
    assert Notation().number(value) == text


def test_a_drawing_as_dxf_item_by_item(tmp_path: Any) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    items = (
        Line(((0.0, 0.0), (3.0, 4.0), (5.0, 4.0)), "link"),
        Polygon(((0.0, 0.0), (1.0, 0.0), (0.0, 2.0)), "block"),
        Circle((2.0, 1.0), 0.7, "mark"),
        Arc((1.0, 1.0), 2.0, math.pi / 2, 0.25, "load"),
        Text((4.0, 5.0), "F_{12} = 3 N", 2.8, "note", "end"),
        Arrow((0.0, 0.0), (10.0, 0.0), "effort"),
    )
    Scene(items).save(tmp_path / "a.dxf")
    space = list(ezdxf.readfile(tmp_path / "a.dxf").modelspace())
    line, polygon, circle, arc, text, shaft, head = space
    assert [e.dxf.layer for e in space] == ["link", "block", "mark", "load", "note", "effort", "effort"]
    for e, item, closed in ((line, items[0], False), (polygon, items[1], True)):
        assert ([p[:2] for p in e.get_points()], e.closed) == (list(item.points), closed)  # type: ignore[union-attr]
    assert (tuple(circle.dxf.center)[:2], circle.dxf.radius) == ((2.0, 1.0), 0.7)
    assert (arc.dxf.start_angle, arc.dxf.end_angle) == pytest.approx((math.degrees(0.25), 90.0))
    assert (tuple(arc.dxf.center)[:2], arc.dxf.radius) == ((1.0, 1.0), 2.0)
    assert (text.dxf.text, text.dxf.height) == ("F_12 = 3 N", pytest.approx(2.1))
    assert tuple(text.get_placement()[1])[:2] == (4.0, 5.0)
    assert text.get_placement()[0].name == "MIDDLE_RIGHT"
    assert tuple(shaft.dxf.start)[:2] == (0.0, 0.0)
    assert max(v[0] for v in head.vertices()) == pytest.approx(10.0)


@pytest.mark.parametrize("on", ["piston", "ground"])
def test_a_guide_in_the_plane_arrow_by_arrow(on: str) -> None:
    """On the block faces push inwards: normal force, friction and reaction end where the face bears, to scale."""
    r = da.statics(engine(mu=0.2))
    joint = next(j for j in r.joints if not r.mechanism.joints[j].hinge)
    scene = guide_detail(r, joint, 0, Shown(r, Notation(), 0), on)
    sign = 1.0 if on == r.mechanism.joints[joint].links[1] else -1.0
    per_mm = scene.scales[f"force at {joint}"]
    faces = faces_of(r, joint, 0)
    assert not any("turned into the paper" in t.text for t in scene.texts())
    arrows = {role: [a for a in scene.arrows() if a.role == role] for role in ("effort", "friction")}
    for face, normal, rub in zip(faces, arrows["effort"], arrows["friction"], strict=True):
        for arrow, vector in ((normal, face.normal[0]), (rub, face.friction[0])):
            assert np.subtract(arrow.head, arrow.tail) * per_mm == pytest.approx(sign * vector)
            assert arrow.value == pytest.approx(float(np.hypot(*vector)))
        assert rub.head == pytest.approx(normal.tail)
        assert np.dot(normal.head, face.normal[0]) < 0, "the face that bears is behind the push on the block"
    total = sum(sign * (f.normal[0] + f.friction[0]) for f in faces)
    assert total == pytest.approx(r.reaction(joint, on=on)[0])
