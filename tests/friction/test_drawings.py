"""Friction drawn: circles to scale, lines that touch them, guides at the angle of friction, both ends at rest."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.friction.lines_of_action import FaceForce, acting_lines, close_by
from dalembert.analysis.methods.applied_forces import magnitude, on_link
from dalembert.bundled import cases
from dalembert.views.paper.scene import Circle, Line, Scene
from tests.friction.engines import collar, engine, engine_by_hand, guided
from tests.friction.rough import rough
from tests.friction.test_laws import solved
from tests.methods.readable import text_over_lines, text_overlaps
from tests.tiers import crossed, over

RUBBING = [name for name, path in cases().items() if "friction:" in path.read_text(encoding="utf-8")]


def strokes(scene: Scene, role: str) -> list[Line]:
    return [i for i in scene.flat() if isinstance(i, Line) and i.role == role]


def circles(scene: Scene) -> list[Circle]:
    return [i for i in scene.flat() if isinstance(i, Circle) and i.role == "friction-circle"]


def distance(line: Line, point: Any) -> float:
    a, b = (np.asarray(p) for p in (line.points[0], line.points[-1]))
    e, arm = (b - a) / np.hypot(*(b - a)), np.asarray(point) - a
    return abs(float(e[0] * arm[1] - e[1] * arm[0]))


@over(8, 200)
def test_reactions_on_their_own_lines_balance(seed: int) -> None:
    """The forces at the places where the links touch, with what couples are left, are the same wrenches."""
    r = da.dynamics(rough(seed))
    for k in np.flatnonzero(solved(r))[:2]:
        some = acting_lines(r, int(k))
        largest = max(float(magnitude(a.force)[k]) for a in some) or 1.0
        for link in r.links:
            mine = on_link(some, link)
            force = sum((a.force[k] for a in mine), np.zeros(2))
            moment = sum(float(a.moment(r.center(link))[k]) for a in mine)
            far = max(float(np.hypot(*(a.at[k] - r.center(link)[k]))) for a in mine)
            size = largest * max(far, r.compiled.layout.length)
            assert np.hypot(*force) < 1e-9 * largest
            assert abs(moment) < 1e-9 * max(size, *(abs(float(a.couple[k])) for a in mine))


@pytest.mark.parametrize(("part", "near"), [(0.9, True), (-0.9, True), (1.1, False), (-1.1, False)])
def test_a_face_that_bears_beyond_the_machine_is_far(part: float, near: bool) -> None:
    r, none = da.statics(collar(0.05)), np.zeros((1, 2))
    away = np.array([part * r.compiled.layout.length])
    assert close_by(r, FaceForce("", none, away, none, none), 0) is near


def test_pins_and_guides_have_no_couple_left() -> None:
    for m in (engine(), engine(guide=0.05), collar(0.05), guided(10.0, 0.2, 0.05, 0.05, 0.01)):
        for a in acting_lines(da.statics(m), 0):
            assert a.kind != "joint" or abs(float(a.couple[0])) == 0


def test_a_two_force_link_lies_on_one_line() -> None:
    r = da.statics(engine())
    a, b = (x for x in acting_lines(r, 0) if x.link == "rod")
    e = a.force[0] / np.hypot(*a.force[0])
    arm = b.at[0] - a.at[0]
    assert abs(e[0] * arm[1] - e[1] * arm[0]) < 1e-15
    rod = da.members(r)["rod"]
    assert rod.tension is not None
    assert rod.tension[0] == pytest.approx(-engine_by_hand().rod, rel=1e-10)
    assert rod.sentence.endswith("both forces lie on one common tangent of the friction circles at A, B")


def test_a_loaded_link_says_that_it_is_no_two_force_member() -> None:
    r = da.statics(da.load(cases()["seed-f-4b-superposition-together"]))
    assert da.members(r)["rod"].touching == (
        "not a two-force member, as weight acts too: each reaction touches the friction circles at A, B, "
        "on different lines"
    )


def test_the_arm_of_the_engine() -> None:
    """The issue of the seeds: 0.204502 m between the lines on the crank."""
    texts = [t.text for t in da.draw.lines_of_action(da.statics(engine()), "crank").texts()]
    assert "h = 0.2045 m" in texts


def test_circles_to_scale_on_the_mechanism() -> None:
    scene = da.draw.mechanism(da.statics(engine()))
    radii = [c.radius * scene.scales["length"] for c in circles(scene)[:3]]
    assert radii == pytest.approx([0.028, 0.024, 0.016], rel=1e-12)
    line = max(strokes(scene, "line-of-action"), key=lambda x: math.dist(*x.points))
    for c in circles(scene)[1:3]:
        assert distance(line, c.center) == pytest.approx(c.radius, rel=1e-9)
    others = [x for x in strokes(scene, "faint") if math.dist(*x.points) > 60]
    assert len(others) == 3
    for other in others:
        for c in circles(scene)[1:3]:
            assert distance(other, c.center) == pytest.approx(c.radius, rel=1e-9)


@pytest.mark.parametrize("joint", ["O", "A", "B"])
def test_small_circles_have_a_detail_at_a_stated_scale(joint: str) -> None:
    scene = da.draw.mechanism(da.statics(engine(mu=0.05)))
    per_mm = scene.scales[f"length at {joint}"]
    radius = {"O": 0.0035, "A": 0.003, "B": 0.002}[joint]
    assert any(c.radius * per_mm == pytest.approx(radius, rel=1e-9) for c in circles(scene))
    texts = " ".join(t.text for t in scene.texts())
    assert f"Pin {joint}: friction circle" in texts
    assert f"1 mm = {per_mm:.6g} m" in texts


def test_the_detail_of_a_guide() -> None:
    scene = da.draw.mechanism(da.statics(engine(guide=0.05)))
    per_mm = scene.scales["force at guide"]
    arrows = [a for a in scene.arrows() if a.kind == "force at guide"]
    for a in arrows:
        assert a.length * per_mm == pytest.approx(a.value, rel=1e-9)
    sizes = sorted(a.value for a in arrows if a.role == "effort" and a.value)
    hand = engine_by_hand(half=0.05)
    assert sizes == pytest.approx([hand.upper, hand.lower], rel=1e-9)
    texts = [t.text for t in scene.texts()]
    assert texts.count("φ = 4.004°") == 2
    assert any("Two corners bear: lower ahead 5161 N and upper behind" in t for t in texts)


@crossed("name, view", RUBBING, ["free-bodies", "mechanism", "force-polygons"])
def test_texts_cover_nothing(name: str, view: Any) -> None:
    scene = da.draw.view(da.solve(da.load(cases()[name])), view)
    assert text_overlaps(scene) == []
    assert text_over_lines(scene) == []
    assert not [t.text for t in scene.texts() if t.text.startswith("Without room")]
    left, bottom, right, top = scene.bounds
    assert right - left < 260
    assert top - bottom < 600


def test_both_ends_are_drawn_at_rest() -> None:
    r = da.statics(engine(speed=0.0))
    texts = [t.text for t in da.draw.mechanism(r).texts()]
    assert "Low end of O, −7304 N·m: friction is at its limit in O, A, B, guide" in texts
    assert "High end of O, −4522 N·m: friction is at its limit in O, A, B, guide" in texts
    assert any("Rod is about to turn clockwise against crank" in t for t in texts)
    lines = [t.text for t in da.draw.lines_of_action(r, "crank").texts()]
    assert "h = 0.3179 m" in lines
    assert "h = 0.2045 m" in lines
    chain = [t.text for t in da.draw.force_polygons(r).texts()]
    assert "F_{23} = 22974 N" in chain
    assert "F_{23} = 22112 N" in chain


def test_the_circle_at_rest_has_the_coefficient_at_rest() -> None:
    m = engine(mu=0.3, speed=0.0, friction={"coefficient": 0.3, "static": 0.4, "circle": "tan"})
    low, _ = da.statics(m).ends[0]
    circle = da.friction_circles(low, "A")
    assert circle.radius == pytest.approx(0.018)
    assert circle.radii[0] == pytest.approx(0.024)
    offset = circle.taken.point[0] - circle.center[0]
    assert np.hypot(*offset) == pytest.approx(0.024, rel=1e-12)


def test_one_circle_has_two_tangents_through_a_pin_without_friction() -> None:
    m = engine().with_values({"joints.B.friction": None})
    circle = da.friction_circles(da.statics(m), "A")
    (other,) = circle.others
    b = da.statics(m).point("rod", "B")[0]
    arm = b - other.point[0]
    assert abs(arm[0] * other.direction[0, 1] - arm[1] * other.direction[0, 0]) < 1e-12
    rod = da.members(da.statics(m))["rod"]
    assert rod.touching == (
        "both forces lie on one line, which touches the friction circle at A and passes the other pin's centre"
    )


def test_the_worked_solution() -> None:
    text = " ".join(da.report(da.statics(engine(guide=0.1))).to_bytes("txt").decode().split())
    for words in (
        "r_A = μ_A R_A = 0.4 · 0.06000 = 0.02400 m",
        "β_3 = arcsin ((r_A + r_B)/(AB)) = arcsin ((0.02400 + 0.01600)/(1.250)) = 1.834 °",
        "θ_AB + β_3 = −10.59 ° + 1.834 ° = −8.760 °",
        "N_lower = (S_guide + N_14)/(2) = 3451 N",
        "With friction: 2 crank: each reaction touches the friction circles at O, A; 3 rod: both forces",
        "10 Virtual work, a check",
        "friction in A 530.4 −1.157 −613.6",
        "Superposition is refused",
    ):
        assert words in text, words


def test_the_worked_solution_at_rest() -> None:
    text = da.report(da.statics(engine(speed=0.0))).to_bytes("txt").decode()
    assert "O: −7304 to −4522 N·m" in text
    assert text.count("Joint  Force") == 2


def test_inertia_with_friction_in_the_worked_solution() -> None:
    """Inertia's share is the difference to the answer without it, as forces do not add."""
    m = engine(speed=20.0).with_values({"links.piston.mass": 20.0})
    r = da.dynamics(m)
    share = next(s for s in da.inertia_shares(r) if (s.of, s.quantity) == ("O", "effort"))
    still = float(da.statics(m).effort("O")[0])
    assert share.inertia == pytest.approx(abs(float(r.effort("O")[0]) - still), rel=1e-12)
    assert b"Inertia" in da.report(r).to_bytes("txt")


@pytest.mark.parametrize("direction", [0, 180, 90, -30])
def test_upper_is_said_where_it_is_not_above(direction: float) -> None:
    """Faces are named along the slide: of a slide to the left the upper face lies below."""
    tree = {
        "links": {"ground": {"points": {"A": [0, 0]}}, "block": {"points": {"A": [0, 0]}}},
        "joints": {
            "A": {
                "type": "slider",
                "links": ["ground", "block"],
                "direction": direction,
                "friction": {"coefficient": 0.2},
            }
        },
        "drives": {"A": {"position": 0, "speed": 1}},
        "loads": {"F": {"type": "force", "on": "block", "at": "A", "value": [3, -10]}},
    }
    texts = " ".join(t.text for t in da.draw.mechanism(da.statics(da.mechanism(tree))).texts())
    assert ("Upper is left of ahead" in texts) == (direction in (180, 90))
