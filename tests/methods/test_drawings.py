"""Drawings as data: gaps are residuals, lengths are forces by the stated scale, texts cover nothing."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.cli import main
from dalembert.views.charts import chart_scenes, effort_chart, mean_effort, polar_chart
from dalembert.views.notation import Shown
from dalembert.views.paper.canvas import crossings
from dalembert.views.paper.scene import Circle, Line, Polygon, Scene, Text
from dalembert.views.plane.force_polygons import forces_of
from dalembert.views.plane.instant_centers import all_centers, instant_centers
from dalembert.views.plane.motion_points import spots
from tests.methods.readable import text_over_lines, text_overlaps

SHOWN = [
    "seed-000-a-four-bar-loaded-rocker",
    "seed-002-2-slider-crank-2kn",
    "seed-002-3-four-link-three-forces",
    "seed-002-4-four-link-two-couples",
    "seed-002-5-slider-crank-force-on-rod",
    "seed-003-norton-11-3",
    "vw-07-lazy-tongs-between-two-hinges",
]
VIEWS = ["mechanism", "free-bodies", "force-polygons", "motion", "superposition", "all"]


@pytest.mark.parametrize("at", [1, 5, 20])
def test_the_force_of_teeth_is_along_the_line_of_action(at: int) -> None:
    """Its components are to scale, head to tail, the radial one inwards;
    the line of action touches both base circles."""
    r = result("gear_train")
    for panel in da.draw.teeth(r, at=at).items:
        whole, around, radial = (a for a in Scene(panel.items).arrows() if a.kind == "force")
        joint, per_mm = whole.of, math.hypot(*r.reaction(whole.of)[at - 1]) / whole.length
        assert [a.role for a in (whole, around, radial)] == ["joint-force", "effort", "effort"]
        assert whole.value == pytest.approx(whole.length * per_mm)
        assert radial.length == pytest.approx(around.length * math.tan(math.radians(20)))
        assert radial.tail == pytest.approx(around.head)
        assert radial.head == pytest.approx(whole.head)
        circles = [c for c in panel.items if isinstance(c, Circle)]
        pitch = [c for c in circles if c.role == "pitch"]
        base = [c for c in circles if c.role == "grid"]
        for one, other in zip(pitch, base, strict=True):
            assert other.radius == pytest.approx(one.radius * math.cos(math.radians(20)))
            dx, dy = (np.array(whole.head) - whole.tail) / whole.length
            x, y = np.array(one.center) - whole.tail
            assert abs(x * dy - y * dx) == pytest.approx(other.radius, rel=1e-6)
        planet = next(c for c in pitch if c.radius == min(p.radius for p in pitch))
        inwards = np.array(planet.center) - whole.tail
        assert float(inwards @ (np.array(radial.head) - radial.tail)) > 0, joint


@pytest.mark.parametrize("name", ["scissor_lift", "ba-04-partly-balanced-cylinder"])
def test_every_force_of_a_crowded_chain_is_labelled(name: str) -> None:
    scene = da.draw.force_chain(result(name))
    labels = " ".join(text.text for text in scene.texts())
    forces = [a for a in scene.arrows() if a.kind == "force" and a.role != "gap"]
    assert labels.count(" = ") >= len(forces)
    assert "Without room" not in labels
    assert text_overlaps(scene) == []


def test_teeth_without_gears_are_refused() -> None:
    with pytest.raises(da.ModelError, match="has no gears to draw; look at its free bodies"):
        da.draw.teeth(result("four_bar"))


def result(name: str, **options: Any) -> Any:
    return da.solve(da.load((cases() | examples())[name]), **options)


def words(scene: Any) -> set[str]:
    """Every text of a drawing."""
    return {item.text for item in scene.items if isinstance(item, Text)}


def is_met(box: Any, start: Any, end: Any) -> bool:
    """Whether a straight piece has a part in a box: what is left of it between each two sides."""
    first, last = Fraction(0), Fraction(1)
    for at, to, low, high in zip(start, end, box[:2], box[2:], strict=True):
        if at == to:
            first, last = (first, last) if low <= at <= high else (1, 0)
        else:
            ways = sorted(Fraction(int(side - at), int(to - at)) for side in (low, high))
            first, last = max(first, ways[0]), min(last, ways[1])
    return first <= last


def test_a_line_meets_a_box_where_a_part_of_it_is_inside_or_on_a_side() -> None:
    random = np.random.default_rng(3)
    places, pieces = random.integers(-6, 7, (2, 50, 2, 2))
    boxes = np.concatenate([places.min(axis=1), places.max(axis=1) + 1], axis=1)
    found = crossings(boxes.astype(float), pieces.astype(float))
    assert 500 < found.sum() < 2000
    assert found.tolist() == [[is_met(box, *piece) for piece in pieces] for box in boxes]


@pytest.mark.parametrize("name", SHOWN)
@pytest.mark.parametrize("view", VIEWS)
def test_texts_cover_nothing_and_lengths_are_to_scale(name: str, view: Any) -> None:
    r = result(name)
    scene = da.draw.view(r, view if r.drives or view != "motion" else "mechanism")
    assert text_overlaps(scene) == []
    ElementTree.fromstring(scene.to_svg())
    json.dumps(scene.to_dict())


@pytest.mark.parametrize("name", SHOWN)
def test_arrows_are_to_the_stated_scale(name: str) -> None:
    r = result(name)
    scenes = [da.draw.mechanism(r, forces=True), da.draw.force_chain(r)]
    scenes += [da.draw.free_body(r, link) for link in r.links] + [
        da.draw.force_polygon(r, link) for link in r.links
    ]
    if r.drives:
        scenes.append(da.draw.velocity_polygon(r))
        scenes += [da.draw.acceleration_polygon(r)] if r.schedule.speed.any() else []
    for scene in scenes:
        for arrow in scene.arrows():
            if arrow.kind != "dimension":
                assert arrow.length * scene.scales[arrow.kind] == pytest.approx(arrow.value, rel=1e-9)
        assert text_over_lines(scene) == []


@pytest.mark.parametrize("name", SHOWN)
def test_the_gap_of_a_polygon_is_the_residual(name: str) -> None:
    r = result(name)
    for link in r.links:
        scene = da.draw.force_polygon(r, link)
        arrows = scene.arrows()
        total = [sum(a.head[n] - a.tail[n] for a in arrows) for n in (0, 1)]
        assert (
            math.hypot(*total) * scene.scales.get("force", 1.0)
            <= scene.numbers["gap"] + 1e-9 * scene.numbers["largest"]
        )
        assert scene.numbers["gap"] <= (r.residual[0] + 1e-15) * 10 * max(scene.numbers["largest"], 1e-12)


def test_a_free_body_shows_everything() -> None:
    r = result("four_bar")
    scene = da.draw.free_body(r, "coupler")
    assert [a.of for a in scene.arrows()] == ["A", "B", "F_P", "coupler"]
    texts = [t.text for t in scene.texts()]
    assert "F_{43} = 87.41 lbf" in texts
    assert "T_{I3} = 181.3 lbf·in" in texts


def test_signs_follow_the_notation() -> None:
    r = result("four_bar")
    other = da.Notation(order="on-by", letter="G", decimals=1)
    assert "G_{34} = 87.4 lbf" in [t.text for t in da.draw.free_body(r, "coupler", notation=other).texts()]
    named = da.Notation(links="name", units="SI")
    assert "F_{rocker,coupler} = 388.8 N" in [
        t.text for t in da.draw.free_body(r, "coupler", notation=named).texts()
    ]


def test_a_subcase_closes_alone() -> None:
    r = result("seed-002-3-four-link-three-forces")
    for source in da.superposition(r).sources:
        for link in r.links:
            numbers = da.draw.force_polygon(r, link, case=source).numbers
            assert numbers["gap"] <= 1e-12 * max(numbers["largest"], 1e-30)


def test_the_four_bar_polygon_of_the_book() -> None:
    """Seed 000-A: F32 = 113.53 lb on the 120-lb rocker."""
    r = result("seed-000-a-four-bar-loaded-rocker")
    sizes = sorted(a.value / 4.4482216152605 for a in da.draw.force_polygon(r, "rocker").arrows())
    assert sizes == pytest.approx([75.4268451134, 113.530652089, 120.0], rel=1e-7)


def test_instant_centers_of_the_four_bar() -> None:
    r = result("four_bar")
    found = instant_centers(r, 0)
    assert found["ground", "crank"] == pytest.approx((0.0, 0.0), abs=1e-12)
    p = found["ground", "coupler"]
    assert p is not None
    assert all(place is not None for place in found.values())
    a, b, o4 = r.point("crank", "A")[0], r.point("coupler", "B")[0], (19 * 0.0254, 0.0)
    assert a[0] * p[1] - a[1] * p[0] == pytest.approx(0.0, abs=1e-9)
    assert (b[0] - o4[0]) * (p[1] - o4[1]) == pytest.approx((b[1] - o4[1]) * (p[0] - o4[0]), abs=1e-9)


@pytest.mark.parametrize("theme", ["light", "dark", "print"])
def test_svg_in_every_theme(theme: Any, tmp_path: Path) -> None:
    scene = da.draw.mechanism(result("four_bar"))
    scene.save(tmp_path / "a.svg", theme=theme)
    text = (tmp_path / "a.svg").read_text(encoding="utf-8")
    assert text.startswith("<svg")
    assert len(text) < 12_000
    with pytest.raises(da.ModelError, match="exists"):
        scene.save(tmp_path / "a.svg")


def test_charts_over_a_cycle() -> None:
    r = result("four_bar", positions=36)
    scene = da.draw.charts(r)
    assert text_overlaps(scene) == []
    assert len(scene.numbers["Drive effort"]["O2"]) == 36


@pytest.mark.parametrize("kind", ["pdf", "png", "dxf"])
def test_other_formats(kind: str, tmp_path: Path) -> None:
    pytest.importorskip("ezdxf" if kind == "dxf" else "matplotlib")
    path = tmp_path / f"a.{kind}"
    da.draw.free_bodies(result("four_bar")).save(path)
    assert path.stat().st_size > 3000


def test_loads_come_before_joints_in_a_polygon() -> None:
    r = result("four_bar")
    from dalembert.analysis.methods.applied_forces import actions

    assert [a.kind for a in forces_of(actions(r), "coupler", 0)] == ["load", "inertia", "joint", "joint"]


@pytest.mark.parametrize("kind", ["svg", "gif", "webp"])
def test_animations(kind: str, tmp_path: Path) -> None:
    if kind != "svg":
        pytest.importorskip("matplotlib")
        pytest.importorskip("PIL")
    animation = da.draw.animation(result("four_bar", positions=4))
    animation.save(tmp_path / f"a.{kind}")
    content = (tmp_path / f"a.{kind}").read_bytes()
    if kind == "svg":
        assert content.count(b"<animate ") == 4
        assert b"<script" not in content
    for scene in animation.frames:
        for arrow in scene.arrows():
            assert arrow.length * animation.scales["force"] == pytest.approx(arrow.value, rel=1e-9)


def test_a_frame_says_where_both_drives_are_and_what_they_do() -> None:
    """In the order of the file."""
    r = da.dynamics(da.five_bar(positions=3))
    for k, frame in enumerate(da.draw.animation(r).frames):
        (said,) = (t.text for t in frame.texts() if ", effort " in t.text)
        parts = [part.replace("−", "-").split(", effort ") for part in said.split("; ")]
        for drive, (place, effort) in zip(r.drives, parts, strict=True):
            name, _, angle = place.partition(" = ")
            assert name == drive
            assert float(angle.rstrip("°")) == pytest.approx(np.degrees(r.drive_position(drive)[k]), abs=0.01)
            assert float(effort.split()[0]) == pytest.approx(r.effort(drive)[k], rel=1e-3)


def test_frames_drawn_over_what_stays_still_are_pictures_of_both(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    image = pytest.importorskip("PIL.Image")
    from dalembert.views.formats.matplotlib_figure import pictures, write_figure

    animation = da.draw.animation(result("four_bar", positions=3))
    first, *others = animation.frames
    for frame in others:
        scene = Scene((*animation.still, *frame.items))
        write_figure(scene, tmp_path / "whole.png", "dark", 90)
        picture = pictures(animation.still, [first.items, frame.items], scene.bounds, "dark", 90)[1]
        assert image.open(tmp_path / "whole.png").convert("RGB").tobytes() == picture.tobytes()


def test_the_command_writes_an_animation(tmp_path: Path) -> None:
    out = tmp_path / "a.svg"
    asked = ["draw", str(examples()["four_bar"]), "-o", str(out), "--view", "animation", "--positions", "3"]
    assert main(asked) == 0
    assert "animate" in out.read_text(encoding="utf-8") or "@keyframes" in out.read_text(encoding="utf-8")


def test_an_animation_needs_positions() -> None:
    with pytest.raises(da.ModelError, match="an animation needs two positions; ask for more"):
        da.draw.animation(result("four_bar"))


def test_positions_at_rest_are_in_the_animation() -> None:
    """Still, with dry friction: the efforts are intervals, and no force is drawn that is not known."""
    m = da.load(cases()["seed-002-7d-engine-at-rest"])
    animation = da.draw.animation(da.statics(m.with_values({"drives.O.position": [0.8, 0.9, 1.0]})))
    assert len(animation.frames) == 3
    for frame in animation.frames:
        assert any("at_rest, forces not known: left out" in t.text for t in frame.texts())
        assert {arrow.of for arrow in frame.arrows()} <= {"gas"}


def test_the_arm_of_the_book() -> None:
    """Seed 000-A: the forces on the crank are 2.428 in apart."""
    r = result("seed-000-a-four-bar-loaded-rocker")
    texts = [t.text for t in da.draw.lines_of_action(r, "crank").texts()]
    assert "h = 2.428 in" in texts


def test_displaced_inertia_of_the_book() -> None:
    """Seed 000-B: 16 lb, offset 1.8 in."""
    scene = da.draw.displaced_inertia(result("seed-000-b-crank-inertia-force"), "crank")
    texts = [t.text for t in scene.texts()]
    assert "F_{I2} = 16.00 lbf" in texts
    assert "h = 1.800 in" in texts
    for arrow in scene.arrows():
        if arrow.kind != "dimension":
            assert arrow.length * scene.scales[arrow.kind] == pytest.approx(arrow.value, rel=1e-9)


def test_positions_by_number_and_by_value() -> None:
    r = result("four_bar", positions=36)
    assert da.draw.mechanism(r, at="70 deg").title.endswith("O2 = 70.00°")
    assert da.draw.mechanism(r, at=2).title.endswith("O2 = 70.00°")
    assert da.draw.mechanism(r, at="72 deg").title.endswith("O2 = 70.00°")
    cycle = result("engine")
    for at, found in (("430.3 deg", "430.00"), ("-20 deg", "700.00"), ("1150 deg", "430.00")):
        assert da.draw.mechanism(cycle, at=at).title.endswith(f"O2 = {found}°")
    with pytest.raises(da.ModelError, match="no position has O2 = 90 deg; the nearest is 60"):
        da.draw.mechanism(result("four_bar"), at="90 deg")


def test_the_command_goes_to_a_position(tmp_path: Path) -> None:
    path = tmp_path / "a.svg"
    given = ["draw", str(examples()["four_bar"]), "--view", "mechanism", "--at", "90deg", "-o", str(path)]
    assert main(given) == 0
    whole = result("four_bar", positions=36)
    assert f"{whole.effort('O2')[3] / 0.1129848290276167:.1f} lbf·in" in path.read_text(
        encoding="utf-8"
    ).replace("−", "-")


STRUCTURE = (
    "an?( velocity polygon| animation| chart| drawing of instant centres) shows a motion, and a structure has none; "
    "draw the mechanism"
)


def test_a_structure_has_no_motion_to_draw() -> None:
    r = result("truss")
    for drawn in (da.draw.animation, da.draw.charts, da.draw.motion, da.draw.instant_centers):
        with pytest.raises(da.ModelError, match=STRUCTURE):
            drawn(r)


def test_equilibria_and_single_positions_are_no_motion() -> None:
    with pytest.raises(da.ModelError, match="and here are equilibrium positions"):
        da.draw.animation(result("balance_position"))
    with pytest.raises(da.ModelError, match="a chart needs two positions; ask for more: positions=36"):
        da.draw.charts(result("four_bar"))


def test_a_position_that_is_not_assembled_cannot_be_drawn() -> None:
    m = da.load(examples()["four_bar"]).with_values({"links.crank.points.A": [0.3, 0.0]})
    r = da.dynamics(m, positions=36)
    bad = r.status.index("not_assembled") + 1
    with pytest.raises(da.AnalysisError, match=f"position {bad}: The linkage does not close between "):
        da.draw.mechanism(r, at=bad)
    assert da.draw.mechanism(r).items  # the first that is ok


def test_forces_that_are_not_unique_or_not_known_are_said_on_the_picture() -> None:
    beam = {
        "links": {
            "ground": {"points": {"A": [0, 0], "B": [4, 0]}},
            "beam": {"points": {"A": [0, 0], "B": [4, 0]}},
        },
        "joints": {n: {"type": "pin", "links": ["ground", "beam"]} for n in "AB"},
        "loads": {"F": {"type": "force", "on": "beam", "at": [1.0, 0.5], "value": [5.0, -9.0]}},
    }
    r = da.statics(da.Mechanism(**beam))
    for drawn in (da.draw.free_body, da.draw.force_polygon, da.draw.lines_of_action):
        assert "Not unique, drawn with the least norm: the reactions of A, B." in words(drawn(r, "beam"))
    flat = da.four_bar(ground=0.3, crank=0.1, coupler=0.3, rocker=0.1).with_values(
        {"drives.O2.position": 0.0}
    )
    r = da.statics(flat)
    assert r.status == ("singular",)
    assert {"forces not known", "Not known (singular): the reactions of B, O4."} <= words(
        da.draw.force_polygon(r, "rocker")
    )
    assert any("torque" in text for text in words(da.draw.free_body(r, "rocker")))  # the load is known
    with pytest.raises(da.AnalysisError, match="position 1 has no velocities: Dead centre or change point"):
        da.draw.velocity_polygon(r)


def test_a_trace_has_a_gap_where_the_linkage_does_not_close() -> None:
    m = da.load(examples()["four_bar"]).with_values({"links.crank.points.A": [0.3, 0.0]})
    r = da.dynamics(m, positions=90)
    closed = [r.status[k] == "ok" for k in range(90)]
    arcs = sum(a and not b for a, b in zip(closed, [*closed[1:], closed[0]], strict=True))
    assert 0 < sum(closed) < 90
    traces = [i for i in da.draw.mechanism(r).items if isinstance(i, Line) and i.role == "trace"]
    joins = closed[0] and closed[-1]
    assert len(traces) == 2 * (arcs + joins)  # of A and B
    step = 0.3 * 2 * math.pi / 90
    reach = max(math.dist(*pair) for t in traces for pair in pairwise(t.points))
    assert reach < 2.5 * step / (da.draw.mechanism(r).scales["length"])


def test_a_chart_reaches_as_far_as_its_data_and_is_grey_where_there_is_no_answer() -> None:
    m = da.load(examples()["four_bar"]).with_values({"links.crank.points.A": [0.3, 0.0]})
    r = da.dynamics(m, positions=90)
    x, effort = np.degrees(r.drive_position("O2")), r.effort("O2")
    (scene,) = effort_chart(r)
    band = next(i for i in scene.items if isinstance(i, Polygon) and i.role == "missing-fill")
    per_mm = (float(np.nanmax(x)) + 4.0 - float(np.nanmin(x))) / 84.0  # whole turns: the beginning once more
    known = np.flatnonzero(np.isfinite(effort))
    gap = int(np.flatnonzero(np.diff(known) > 1)[0])
    edges = [(float(x[known[k]]) - float(x[0])) / per_mm for k in (gap, gap + 1)]
    assert [band.points[0][0], band.points[1][0]] == pytest.approx(edges, abs=1e-9)
    runs = [i for i in scene.items if isinstance(i, Line) and i.role == "curve-1" and len(i.points) > 2]
    assert [run.points[-1][0] for run in runs] == pytest.approx([edges[0], 84.0], abs=1e-9)
    assert "no answer" in words(scene)
    assert not any(word.startswith("mean") for word in words(scene))


def test_the_mean_torque_is_the_work_over_the_cycle() -> None:
    """Of 90 to 800 degrees the axis has no room beyond them, and the mean is the integral over the travel."""
    m = da.load(examples()["engine"])
    whole = da.dynamics(m, positions=72)
    assert mean_effort(whole, "O2") == pytest.approx(float(whole.effort("O2").mean()), rel=1e-12)
    turns = np.radians(np.linspace(90.0, 800.0, 143))
    part = da.dynamics(m.with_values({"drives.O2.position": turns.tolist()}))
    work = np.trapezoid(part.effort("O2"), turns)
    assert mean_effort(part, "O2") == pytest.approx(work / (turns[-1] - turns[0]), rel=1e-12)
    (scene,) = effort_chart(part)
    curve = next(i for i in scene.items if isinstance(i, Line) and i.role == "curve-1")
    assert (curve.points[0][0], curve.points[-1][0]) == pytest.approx((0.0, 84.0))
    back = [0.1, 0.5, 0.9, 0.5, 0.1]
    assert mean_effort(da.statics(m.with_values({"drives.O2.position": back})), "O2") is None


def test_a_polar_diagram_is_closed_only_by_a_cycle_and_marked_with_the_drives_positions() -> None:
    def path(r: da.Result) -> Line:
        items = polar_chart(r, ["A"]).items
        return max((i for i in items if getattr(i, "role", "") == "curve-1"), key=lambda i: len(i.points))

    m = da.load(examples()["four_bar"])
    whole = path(da.dynamics(m, positions=36))
    assert len(whole.points) == 37
    assert whole.points[0] == whole.points[-1]
    part = da.dynamics(m.with_values({"drives.O2.position": np.radians(range(60, 181, 5)).tolist()}))
    assert len(path(part).points) == 25
    scene = polar_chart(part, ["A"])
    marks = [i.center for i in scene.items if isinstance(i, Circle) and i.role == "mark"]
    at = {k: path(part).points[(k - 60) // 5] for k in range(60, 181, 10)}
    assert marks
    assert all(min(math.dist(mark, place) for place in at.values()) < 1e-9 for mark in marks)
    assert {f"{k}°" for k in at} >= {w for w in words(scene) if w.endswith("°")} != set()


def test_a_slot_is_named_where_its_pin_is() -> None:
    m = da.scotch_yoke()
    r = da.dynamics(m, positions=4)
    (slot,) = (name for name, joint in m.joints.items() if joint.type == "slot")
    arm = m.joints[slot].links[0]
    scene = da.draw.free_body(r, arm, at=2)
    (label,) = (item for item in scene.items if isinstance(item, Text) and item.text == slot)
    (force,) = (a for a in scene.arrows() if a.of == slot and a.kind == "force")
    assert min(math.dist(label.at, end) for end in (force.tail, force.head)) < 6.0


def test_a_free_body_has_the_wheel_of_its_own_link() -> None:
    """Of a wheel on a moving rail, the wheel's has it and the rail's has none."""
    links = {
        "ground": {"points": {"O": [0, 0]}},
        "rail": {"points": {"O": [0, 0], "W": [0, 0]}},
        "wheel": {"points": {"W": [0, 0]}},
    }
    joints = {
        "O": {"type": "slider", "links": ["ground", "rail"]},
        "W": {"type": "rolling", "links": ["rail", "wheel"], "radius": 0.1},
    }
    drives = {"O": {"position": 0.2}, "W": {"position": 0}}
    r = da.statics(da.mechanism({"links": links, "joints": joints, "drives": drives}))
    bodies = (da.draw.free_body(r, link) for link in ("rail", "wheel"))
    assert [sum(item.role == "pitch" for item in body.items) for body in bodies] == [0, 1]


@pytest.mark.parametrize("name", ["four_bar", "rssr"])
def test_charts_are_of_joints_that_carry_something_and_have_one_axis(name: str) -> None:
    """Components of each loaded joint, none of one without a force; only the line of zero is an axis."""
    r = da.solve(da.load(examples()[name]), positions=12)
    out = chart_scenes(r)
    titles = [scene.title or "" for scene in out]
    for joint in r.joints:
        assert any(title.startswith(f"Joint {joint}: force") for title in titles), titles
    if name == "rssr":
        turned = {title[6] for title in titles if ": moment" in title}
        assert turned == {j for j in r.joints if r.mechanism.joints[j].type != "spherical"}
    for scene in out:
        lines = [i for i in scene.items if isinstance(i, Line) and len(i.points) == 2]
        flat = [i for i in lines if i.points[0][1] == i.points[1][1] and i.role in ("axis", "grid")]
        assert sum(line.role == "axis" for line in flat) <= 1


def test_the_image_of_a_wheel_has_no_point_of_the_other() -> None:
    """The place of a mesh is the centre of its second wheel, which is not a point of the first."""
    r = da.kinematics(da.load(examples()["gear_train"]))
    found = spots(r, 0, Shown(r, da.Notation()))
    assert {link: [s.sign for s in some] for link, some in found.items()} == {
        "sun": ["sun_bearing"],
        "planet": ["P"],
        "carrier": ["carrier_bearing", "P"],
    }


def letters(scene: Scene) -> dict[str, Any]:
    """Letters of a polygon's points, and where the arrows of theirs end."""
    return {text.text: text.at for text in scene.texts() if text.role == "title" and text.size == 3.2}


def test_a_velocity_polygon_has_the_letters_of_the_notes_and_what_points_have_to_each_other() -> None:
    """Without speeds it is that of the crank at 1 rad/s, which virtual work multiplies with the loads."""
    r = result("seed-002-3-four-link-three-forces")
    scene = da.draw.velocity_polygon(r)
    assert set(letters(scene)) == {"o", "b", "c", "e", "f", "g"}
    arrow = {a.of: a for a in scene.arrows()}
    assert set(arrow) == {"B", "C", "E", "F", "G", "v_{CB}"}
    assert (arrow["v_{CB}"].tail, arrow["v_{CB}"].head) == (arrow["B"].head, arrow["C"].head)
    assert arrow["B"].value == pytest.approx(0.5, rel=1e-12)
    assert "For 1 rad/s of drive A; where it moves otherwise, in" in " ".join(sorted(words(scene)))
    work = da.virtual_work(r)
    for a, v in zip(work.actions, work.velocity, strict=True):
        head = arrow[str(r.mechanism.loads[a.of].at)].head
        assert head == pytest.approx(tuple(v[0, 0] / scene.scales["velocity"]), rel=1e-9)
    with pytest.raises(da.ModelError, match="no drive moves at position 1; give a drive a speed"):
        da.draw.acceleration_polygon(r)


def test_normal_tangential_and_coriolis_parts_make_the_acceleration() -> None:
    """Normal along the link towards the pivot, Coriolis' across the slide, and both parts of each side meet its end."""
    r = result("quick_return")
    scene = da.draw.acceleration_polygon(r, at="40 deg")
    k = int(np.argmin(np.abs(r.drive_position("O2") - np.radians(40))))
    arrow = {a.of: a for a in scene.arrows()}

    def span(name: str) -> Any:
        return np.subtract(arrow[name].head, arrow[name].tail)

    for whole, *parts in (
        ("C", "a_{C}^{n}", "a_{C}^{t}"),
        ("a_{DC}", "a_{DC}^{n}", "a_{DC}^{t}"),
        ("a_{AA4}", "a_{AA4}^{c}", "a_{AA4}^{s}"),
    ):
        assert span(parts[0]) + span(parts[1]) == pytest.approx(span(whole), abs=1e-9)
        assert arrow[parts[0]].tail == arrow[whole].tail
        assert {arrow[p].role for p in parts} == {"acceleration-part"}
    along = r.point("lever", "C")[k] - r.point("lever", "O4")[k]
    rate = float(r.speed("lever")[k])
    per_mm = scene.scales["acceleration"]
    assert span("a_{C}^{n}") * per_mm == pytest.approx(-(rate**2) * along, rel=1e-9)
    slide = float(r.freedom("slide", "slide")[1][k])
    assert arrow["a_{AA4}^{c}"].value == pytest.approx(2 * abs(rate * slide), rel=1e-9)
    assert abs(float(span("a_{AA4}^{c}") @ along)) < 1e-9 * arrow["a_{AA4}^{c}"].length
    across = np.array([-along[1], along[0]])
    assert abs(float(span("a_{AA4}^{s}") @ across)) < 1e-9 * arrow["a_{AA4}^{s}"].length
    assert {"o'", "a'", "a'_{4}", "c'", "d'", "g'_{4}", "g'_{5}"} == set(letters(scene))


def test_of_instant_centres_that_are_not_drawn_the_first_24_are_listed() -> None:
    bars = [f"bar{k}" for k in range(8)]
    arms = {bar: {"points": {bar: [0, 0], f"bar{k + 1}": [1, 0]}} for k, bar in enumerate(bars)}
    pairs = zip(["ground", *bars], bars, strict=False)
    m = da.Mechanism(
        links={"ground": {"points": {"bar0": [0, 0]}}, **arms},
        joints={bar: {"type": "pin", "links": list(pair)} for pair, bar in zip(pairs, bars, strict=True)},
        drives={bar: {"position": 0.3, "speed": 0 if k else "1 rad/s"} for k, bar in enumerate(bars)},
    )
    said = " ".join(text.text for text in da.draw.instant_centers(da.kinematics(m), at=1).texts())
    listed = said.partition("None, as the links move as one: ")[2].split(", ")
    assert len(listed) == 24
    assert listed[-1].endswith(" and 4 more.")


def test_instant_centres_that_are_not_drawn_are_listed_with_their_place_or_direction() -> None:
    said = " ".join(text.text for text in da.draw.instant_centers(result("engine"), at="60 deg").texts())
    r = result("engine")
    k = int(np.argmin(np.abs(r.drive_position("O2") - math.pi / 3)))
    b = float(r.point("piston", "B")[k, 0]) * 1e3
    place = f"I_{{13}} ({b:.1f}, {b * math.tan(math.pi / 3):.1f}) mm"
    assert f"Outside the drawing: {place}." in said
    assert "At infinity, in the direction of: I_{14} 90.00°." in said
    guide = result("quick_return")
    found = all_centers(guide, 4)["block", "lever"]
    assert found.place is None
    across = math.remainder(float(guide.angle("lever")[4]) + math.pi / 2, math.pi)
    assert found.direction == pytest.approx(across, abs=1e-9)


def test_a_load_is_seen_beside_a_large_effort_and_lies_on_nothing() -> None:
    """Efforts have a scale of their own where loads would be too short; an arrow goes where it covers least."""
    r = result("scissor_lift")
    scene = da.draw.mechanism(r)
    load, effort = (next(a for a in scene.arrows() if a.kind == kind) for kind in ("load", "effort"))
    assert load.length > 10.0
    assert load.length * scene.scales["load"] == pytest.approx(load.value, rel=1e-9)
    assert effort.length * scene.scales["effort"] == pytest.approx(effort.value, rel=1e-9)
    gas = next(a for a in da.draw.mechanism(result("engine")).arrows() if a.of == "gas")
    assert gas.tail[0] > gas.head[0]  # it pushes the piston from outside; it does not lie on the rod


def test_a_driven_slide_between_two_pins_is_drawn_as_a_cylinder() -> None:
    blocks = {
        name: [i for i in da.draw.mechanism(result(name)).items if getattr(i, "role", "") == "block"]
        for name in ("bucket", "vw-01-hydraulic-lift", "quick_return")
    }
    corners = {name: [item.points for item in some] for name, some in blocks.items()}
    ratio = {
        name: max(math.dist(p[0], p[1]) / math.dist(p[1], p[2]) for p in some)
        for name, some in corners.items()
    }
    assert ratio["bucket"] > 4.0
    assert ratio["vw-01-hydraulic-lift"] > 4.0
    assert ratio["quick_return"] < 2.0
