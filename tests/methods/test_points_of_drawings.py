"""Places that drawings of the plane connect and name, by hand: instant centres, letters, outlines, distances."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.paper.scene import Arrow, Line, Polygon
from dalembert.views.plane.displaced_inertia import displaced_inertia_scene
from dalembert.views.plane.free_body import _distances, components_scene, free_body_scene
from dalembert.views.plane.instant_centers import Center, _beyond, _center, _ends, _within, all_centers
from dalembert.views.plane.motion_points import letter, rates, spots
from dalembert.views.plane.outline import (
    _bar,
    _round,
    convex,
    every_path,
    link_points,
    load_places,
    rail,
    unbroken,
)

FRAME = PaperFrame(0.005, (0.1, -0.2))
MACHINE = """
links:
  ground: {points: {O: [0, 0], C: [0.02, -0.3]}}
  crank: {points: {O: [0, 0], P: [0.1, 0]}, mass: 1, center: [0.05, 0.01], inertia: 0.01}
  lever: {points: {C: [0, 0], Q: [0.11, 0.02], R: [0.4, 0.05]}, mass: 1, center: [0.2, 0.03], inertia: 0.01}
  block: {points: {P: [0, 0]}, mass: 0.2}
joints:
  O: {type: pin, links: [ground, crank]}
  C: {type: pin, links: [ground, lever]}
  P: {type: pin, links: [crank, block]}
  S: {type: slider, links: [lever, block], at: [Q, P], direction: 5 deg}
drives: {O: {position: [0.3, 0.5, 0.9], speed: 3 rad/s}}
loads:
  F: {type: force, on: lever, at: R, value: [3, 4]}
  W: {type: force, on: lever, at: [0.3, 0.07], value: [1, 2]}
  k: {type: spring, between: [ground.O, lever.R], stiffness: 20, free_length: 0.1}
assembly: {lever: 70 deg, block: 75 deg}
"""


def result() -> Any:
    return da.dynamics(da.loads(MACHINE))


# instant centres


def center(ta: Any, pa: Any, tb: Any, pb: Any, length: float = 1.0) -> Center:
    a, at, b, bt = (np.array(x, float) for x in (ta, pa, tb, pb))
    return _center(a, at, b, bt, length)


def test_the_centre_of_two_links_is_where_their_velocities_agree() -> None:
    """Of a turning at 2 rad/s about (3, 1), told at (5, 2), and the ground; then of two that turn."""
    still, about = [0, 0, 0], [3.0, 1.0]
    twist = [-2 * (2 - 1), 2 * (5 - 3), 2.0]
    assert center(still, [0, 0], twist, [5, 2]).place == pytest.approx(about)
    assert center(twist, [5, 2], still, [7, -4]).place == pytest.approx(about)
    ta, pa, tb, pb = [1.0, -2.0, 0.5], [2.0, 3.0], [-0.5, 1.0, -1.5], [4.0, -1.0]
    found = center(ta, pa, tb, pb).place
    assert found is not None
    speeds = [
        (v[0] - v[2] * (found[1] - p[1]), v[1] + v[2] * (found[0] - p[0])) for v, p in ((ta, pa), (tb, pb))
    ]
    assert speeds[0] == pytest.approx(speeds[1])


@pytest.mark.parametrize(
    ("x", "y", "degrees"),
    [(1.0, 0.0, 90.0), (-1.0, 0.0, 90.0), (0.0, 2.0, 0.0), (1.0, 1.0, -45.0), (-1.0, 2.0, 26.56505117707799)],
)
def test_links_that_slide_have_a_centre_across_the_sliding(x: float, y: float, degrees: float) -> None:
    found = center([0, 0, 1.5], [0, 0], [x - 1.5 * 4, y + 1.5 * 3, 1.5], [3, 4])
    assert found.place is None
    assert found.direction is not None
    assert math.degrees(found.direction) == pytest.approx(degrees)


def test_what_is_nothing_and_what_is_far_is_told_by_the_machine() -> None:
    """A billionth of the fastest, and a million lengths."""
    assert center([0, 0, 0], [0, 0], [0, 0, 0], [1, 1]) == Center(None)
    fast = [3.0, 4.0, 0.0]
    assert center(fast, [0, 0], [3 + 4.9e-9, 4, 0], [1, 1]) == Center(None)
    assert center(fast, [0, 0], [3 + 5.1e-9, 4, 0], [1, 1]).direction == pytest.approx(math.pi / 2)
    turning = [0.0, 0.0, -2.0]
    assert center(turning, [1, 1], [0, 0, -2 * (1 + 0.9e-9)], [1, 1], 0.5) == Center(None)
    assert center(turning, [1, 1], [0, 0, -2 * (1 + 1.1e-9)], [1, 1], 0.5).place == pytest.approx((1, 1))
    assert center([0, 0, 0], [0, 0], [0.9e6, 0, 1], [0, 0], 1.0).place == pytest.approx((0, 0.9e6))
    assert center([0, 0, 0], [0, 0], [1.1e6, 0, 1], [0, 0], 1.0).place is None
    assert center([0, 0, 0], [0, 0], [1.1e6, 0, -1], [0, 0], 2.0).place == pytest.approx((0, -1.1e6))


def test_centres_of_a_machine_are_of_its_first_drive_and_listed_by_place_and_direction() -> None:
    r = result()
    found = all_centers(r, 1)
    assert list(found)[:3] == [("ground", "crank"), ("ground", "lever"), ("ground", "block")]
    assert found["ground", "crank"].place == pytest.approx((0, 0), abs=1e-12)
    assert found["ground", "lever"].place == pytest.approx((0.02, -0.3))
    assert found["crank", "block"].place == pytest.approx(tuple(r.point("crank", "P")[1]))
    assert found["lever", "block"].place is None
    shown = Shown(r, Notation())
    said = _beyond(
        {
            ("ground", "crank"): Center((1.5, -2.0)),
            ("crank", "lever"): Center(None, 0.5),
            ("lever", "block"): Center(None),
        },
        shown,
    )
    plain = [s.replace("\u2060", "").replace("\u00a0", " ") for s in said]
    assert [s.partition(":")[0] for s in plain] == [
        "Outside the drawing",
        "At infinity, in the direction of",
        "None, as the links move as one",
    ]
    assert "I_{12}" in plain[0]
    assert f"{math.degrees(0.5):.2f}°" in plain[1]
    assert plain[2] == "None, as the links move as one: I_{34}."
    swapped = _beyond({("lever", "block"): Center(None)}, Shown(r, Notation(order="on-by")))
    assert swapped == ["None, as the links move as one: I_{34}."]


def test_a_place_is_within_a_drawing_with_room_around_it() -> None:
    span = (-3.0, 2.0, 7.0, 11.0)
    for p in ((-5.0, 5.0), (9.0, 5.0), (0.0, 0.0), (0.0, 13.0)):
        assert _within(p, span, 2.0)
    for p in ((-5.1, 5.0), (9.1, 5.0), (0.0, -0.1), (0.0, 13.1)):
        assert not _within(p, span, 2.0)
    assert _ends([(3.0, 1.0), (-2.0, 9.0), (5.0, -4.0)]) == ((-2.0, 9.0), (5.0, -4.0))


# points and letters


@pytest.mark.parametrize(
    ("sign", "small"),
    [
        ("B", "b"),
        ("B2", "b_{2}"),
        ("G_{2}", "g_{2}"),
        ("B3_{4}", "b_{3}_{4}"),
        ("AB", "AB"),
        ("slide_{3}", "slide_{3}"),
    ],
)
def test_a_capital_letter_has_its_small_one_in_a_polygon(sign: str, small: str) -> None:
    assert letter(sign) == small


def test_points_of_each_link_are_joints_sliding_points_loads_and_mass_centres() -> None:
    r = result()
    found = spots(r, 1, Shown(r, Notation()))
    told = {link: [(s.sign, s.letter, s.joint, s.sliding) for s in some] for link, some in found.items()}
    assert told == {
        "crank": [("O", "o", True, ""), ("P", "p", True, ""), ("G_{2}", "g_{2}", False, "")],
        "lever": [
            ("C", "c", True, ""),
            ("P_{3}", "p_{3}", True, "S"),
            ("R", "r", False, ""),
            ("W", "W", False, ""),
            ("G_{3}", "g_{3}", False, ""),
        ],
        "block": [("P", "p", True, "")],
    }
    places = {s.sign: s.u for s in found["lever"]}
    angle, away = float(r.angle("lever")[1]), r.point("crank", "P")[1] - r.point("lever", "C")[1]
    back = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    assert places["P_{3}"] == pytest.approx(back @ away)
    assert places["W"] == pytest.approx([0.3, 0.07])
    moving = rates(r, 1)
    assert (moving.spin("ground"), moving.spin("crank")) == pytest.approx((0.0, 3.0))
    unit = rates(r, 1, 0)
    assert unit.spin("crank") == pytest.approx(1.0)
    p = r.point("crank", "P")[1]
    assert moving.velocity("crank", np.array([0.1, 0])) == pytest.approx([-3 * p[1], 3 * p[0]])
    assert unit.velocity("lever", np.array([0.4, 0.05])) * 3 == pytest.approx(
        moving.velocity("lever", np.array([0.4, 0.05]))
    )


def test_a_shape_connects_joints_and_points_of_loads() -> None:
    r = result()
    assert list(link_points(r, "lever", 1)) == ["C", "S", "S sliding", "R", "W"]
    assert list(link_points(r, "ground", 1)) == ["O", "C"]
    assert list(link_points(r, "block", 1)) == ["P", "S"]
    points = link_points(r, "lever", 1)
    assert points["S sliding"] == pytest.approx(tuple(r.point("block", "P")[1]))
    assert points["S"] == pytest.approx(tuple(r.point("lever", "Q")[1]))
    assert load_places(r.mechanism, "ground") == {"O": (0, 0)}
    (line,) = rail(r, "S", 1, FRAME)
    assert isinstance(line, Line)
    assert line.points == (FRAME(points["S"]), FRAME(points["S sliding"]))
    assert rail(r, "P", 1, FRAME) == []
    assert rail(r, "S", 1, PaperFrame(10.0)) == []  # shorter than half a millimetre
    paths = every_path(r)
    assert paths.shape[1:] == (3, 2)
    assert any(path == pytest.approx(points["R"]) for path in paths[:, 1])


def test_a_bar_or_an_area_joins_the_places_of_a_link() -> None:
    r = result()
    (area,) = _bar(r, "lever", 1, FRAME)
    assert isinstance(area, Polygon)
    hull = convex([_round(FRAME(p)) for p in link_points(r, "lever", 1).values()])
    assert area.points == tuple(hull)
    (bar,) = _bar(r, "crank", 1, FRAME)
    assert isinstance(bar, Line)
    ends = sorted(_round(FRAME(r.point("crank", p)[1])) for p in "OP")
    assert bar.points == tuple(ends)
    assert _bar(r, "block", 1, FRAME) == []  # at its mass centre
    text = MACHINE.replace(
        "{points: {P: [0, 0]}, mass: 0.2}", "{points: {P: [0, 0]}, mass: 0.2, center: [X, 0]}"
    )
    for x, drawn in ((0.0024, False), (0.0026, True)):  # half a millimetre at 5 mm for one is 2.5 mm
        other = da.dynamics(da.loads(text.replace("X", str(x))))
        assert bool(_bar(other, "block", 1, FRAME)) == drawn


def test_the_hull_goes_round_counter_clockwise_without_points_on_its_sides() -> None:
    square: list[Any] = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)]
    inside: list[Any] = [(2.0, 1.0), (2.0, 0.0), (4.0, 2.0), (1.0, 1.0)]
    assert convex([*inside, *square[::-1], *square]) == square
    assert convex([(0.0, 0.0), (9.0, 0.0), (5.0, 0.001)]) == [(0.0, 0.0), (9.0, 0.0)]
    assert convex([(0.0, 0.0), (9.0, 0.0), (5.0, 0.002)]) == [(0.0, 0.0), (9.0, 0.0), (5.0, 0.002)]
    assert convex([(3.0, 1.0), (1.0, 2.0), (3.0, 1.0)]) == [(1.0, 2.0), (3.0, 1.0)]


def test_a_path_is_joined_where_its_ends_are_within_a_fifth_of_its_span() -> None:
    def runs(end: float, first: float = 0.0) -> list[int]:
        path = [[first, 0.0], [10.0, 0.0], [math.nan, 0.0], [10.0, 3.0], [0.0, end]]
        return [len(run) for run in unbroken(np.array(path))]

    assert runs(1.99) == [2, 3]
    assert runs(2.01) == [2, 2]
    assert runs(1.0, math.nan) == [2]
    assert unbroken(np.array([[1.0, 2.0], [1.0, 2.0 + 0.9e-9]])) == []
    assert len(unbroken(np.array([[1.0, 2.0], [1.0, 2.0 + 1.1e-9]]))) == 1
    assert unbroken(np.array([[math.nan, 2.0]])) == []


# free bodies


def test_a_free_body_states_how_far_its_points_are_from_the_first() -> None:
    r = result()
    shown = Shown(r, Notation())
    c, places = (0.02, -0.3), link_points(r, "lever", 1)
    assert places["C"] == pytest.approx(c)
    away = {n: shown.text("length", math.dist(c, places[n])) for n in ("S", "R", "W")}
    g = shown.text("length", math.hypot(0.2, 0.03))
    assert _distances(r, "lever", 1, shown) == (
        f"C–S = {away['S']}, C–R = {away['R']}, C–W = {away['W']}, C–G = {g}"
    )
    assert _distances(r, "block", 1, shown) == ""
    assert (
        _distances(r, "crank", 1, shown)
        == f"O–P = 0.1000 m, O–G = {shown.text('length', math.hypot(0.05, 0.01))}"
    )


def test_components_of_a_joint_force_are_along_its_link_and_across_it() -> None:
    r = da.dynamics(da.load(examples()["four_bar"]))
    scene = components_scene(r, "coupler", 0)
    angle = float(r.angle("coupler")[0])
    e = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    per_mm = scene.scales["force"]
    for joint in ("A", "B"):
        whole, along, across = (a for a in scene.arrows() if a.of == joint)
        force = r.reaction(joint, "coupler")[0]
        assert np.subtract(whole.head, whole.tail) * per_mm == pytest.approx(force)
        for part, axis in ((along, e[0]), (across, e[1])):
            assert part.tail == whole.tail
            assert np.subtract(part.head, part.tail) * per_mm == pytest.approx((force @ axis) * axis)
            assert part.value == pytest.approx(abs(force @ axis))
            dashed = [i.points for i in scene.items if isinstance(i, Line) and i.role == "construction"]
            assert any(p == (part.head, whole.head) for p in dashed)


def test_all_free_bodies_of_a_position_have_one_scale() -> None:
    r = result()
    scales = {free_body_scene(r, link, 1).scales["force"] for link in r.links}
    assert len(scales) == 1
    largest = max(np.hypot(*r.reaction(j)[1]) for j in r.joints)
    assert largest / scales.pop() <= 22.0


def test_a_mass_centre_at_rest_has_no_force_of_inertia() -> None:
    """The crank's of the engine without speed; with speed the force is opposite to the acceleration."""
    m = da.load(examples()["four_bar"])
    still = da.dynamics(m.with_values({"drives.O2.speed": 0.0, "drives.O2.acceleration": 0.0}))
    scene = displaced_inertia_scene(still, "coupler", 0)
    assert "a_{G3} = 0" in {t.text for t in scene.texts()}
    assert not [i for i in scene.items if isinstance(i, Arrow)]
    moving = da.dynamics(m)
    scene = displaced_inertia_scene(moving, "coupler", 0)
    acceleration, force = (a for a in scene.arrows() if a.kind in ("acceleration", "force"))
    a = moving.center_acceleration("coupler")[0]
    assert acceleration.value == pytest.approx(np.hypot(*a))
    assert force.value == pytest.approx(m.mass("coupler") * np.hypot(*a))
    ways = [np.subtract(x.head, x.tail) / x.length for x in (acceleration, force)]
    assert ways[0] == pytest.approx(a / np.hypot(*a))
    assert ways[1] == pytest.approx(-ways[0])
    off = (np.subtract(force.tail, acceleration.tail)) * scene.scales["length"]
    arm = abs(off[0] * ways[1][1] - off[1] * ways[1][0])
    alpha = float(moving["angle.coupler.acceleration"][0])
    inertia: Any = m.inertia("coupler")
    assert arm * float(force.value or 0.0) == pytest.approx(abs(inertia * alpha), rel=1e-9)
    assert (off[0] * ways[1][1] - off[1] * ways[1][0]) * -alpha > 0
