"""Vectors through a camera: what is drawn of them, how long, where, and what is too small; systems seen end on."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import Action
from dalembert.bundled import examples
from dalembert.views.force_system import SystemDrawing, clip_line, force_system_scene, reduced_scene
from dalembert.views.notation import Figures, Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.paper.scene import Arrow, Circle, Line
from dalembert.views.plane.mechanism_view import points_inwards, role_of
from dalembert.views.space.camera import CAMERAS, Camera
from dalembert.views.space.space_arrows import Arrows, _largest
from dalembert.views.space.space_view import Sight, camera_of, foreshortening_note, scale_notes, sight, triad
from dalembert.wrench import Couple, Force, System

FRONT = CAMERAS["front"]  # x to the right, z up, the eye towards -y


def action(force: Any, couple: Any = (0, 0, 0), kind: str = "load", of: str = "F") -> Any:
    """An action at (0.1, 0.2, 0.3) m on the ground, at two positions, twice as large at the second."""
    both = np.array([[1.0], [2.0]])
    at = np.array([[0.1, 0.2, 0.3]] * 2)
    f, c = both * np.array([force], float), both * np.array([couple], float)
    return Action(of, kind, "", "ground", None, at, f, c)  # type: ignore[arg-type]


def arrows(some: list[Any], at: Any = 0, longest: float = 22.0, values: bool | None = True) -> Arrows:
    r = da.dynamics(da.load(examples()["rssr"]))
    s = Sight(FRONT, PaperFrame(0.01, (0.0, 0.0)))
    return Arrows(Canvas(), r, s, Shown(r, Notation()), some, at, longest, values)


def test_the_largest_force_and_the_largest_moment_have_round_scales() -> None:
    some = [action([30, 0, 40]), action([3, 0, 4], [0, 0.6, 0.8])]
    a = arrows(some)
    assert a.sizes == pytest.approx([50.0, 1.0])
    assert 50.0 / 22.0 <= a.per_mm < 1.5 * 50.0 / 22.0
    assert arrows(some, slice(None)).sizes == pytest.approx([100.0, 2.0])
    assert arrows(some, longest=5.0).per_mm >= 10.0
    length = a.r.compiled.layout.length
    assert a.floor == pytest.approx((1e-9 * max(50, 1 / length), 1e-9 * max(1, 50 * length)))
    small = arrows([action([30, 0, 40], [0, 0, 1e-9 * 50 * length / 2])])
    assert small.sizes[1] == 0.0  # rounding beside the force
    assert _largest([np.array([[np.nan, 0, 0], [3, 0, 4]]), np.array([[1.0, 0, 0]])]) == 5.0
    assert _largest([]) == 0.0


def test_a_force_leaves_its_place_and_a_moment_stands_beside_it_with_two_heads() -> None:
    a = arrows([action([30, 0, 40], [0.0, 0.0, 2.0])])
    a.action(action([30, 0, 40], [0.0, 0.0, 2.0]), 0)
    force, moment, second = (i for i in a.canvas.items if isinstance(i, Arrow))
    place = np.array([10.0, 30.0])
    assert force.tail == pytest.approx(tuple(place))
    assert (force.role, force.kind) == ("load", "force-seen")
    assert np.subtract(force.head, force.tail) * a.per_mm == pytest.approx([30, 40])
    assert force.value == pytest.approx(50)
    assert moment.tail == pytest.approx((11.2, 30))  # 1.2 mm to the right of its direction
    assert np.subtract(moment.head, moment.tail) * a.moment_per_mm == pytest.approx([0, 2])
    assert moment.value == pytest.approx(2)
    assert (moment.kind, second.value) == ("moment-seen", None)
    texts = {t.text for t in a.canvas.scene("").texts()}
    assert f"F = {a.shown.text('force', 50.0)}" in texts
    assert f"F = {a.shown.text('moment', 2.0)}" in texts
    assert a.drawn == [True, True]
    assert list(a.scale_notes()[1]) == ["length", "force-seen", "moment-seen"]


@pytest.mark.parametrize(("values", "said"), [(True, "F = 50.00 N"), (False, "F"), (None, "")])
def test_an_arrow_has_its_value_its_name_or_nothing(values: bool | None, said: str) -> None:
    a = arrows([action([30, 0, 40])], values=values)
    a.action(action([30, 0, 40]), 0)
    assert [t.text for t in a.canvas.scene(heading=False).texts()] == ([said] if said else [])
    assert a.drawn == [True, False]
    assert list(a.scale_notes()[1]) == ["length", "force-seen"]
    idle = arrows([action([30, 0, 40], [0, 0, 5])])
    assert list(idle.scale_notes()[1]) == ["length"]
    assert list(idle.scale_notes(everything=True)[1]) == ["length", "force-seen", "moment-seen"]
    forces = arrows([action([30, 0, 40])])
    assert list(forces.scale_notes(everything=True)[1]) == ["length", "force-seen"]


def test_a_vector_towards_the_eye_is_a_dot_and_one_away_from_it_a_cross() -> None:
    for y, lines in ((-50.0, 0), (50.0, 2)):
        a = arrows([action([0, y, 0])])
        a.action(action([0, y, 0]), 0)
        assert len([i for i in a.canvas.items if isinstance(i, Line)]) == lines
        assert not [i for i in a.canvas.items if isinstance(i, Arrow)]
        rings = [i for i in a.canvas.items if isinstance(i, Circle)]
        assert [c.center for c in rings] == [pytest.approx((10, 30))] * (2 - lines // 2)
    a = arrows([action([0, 0, 50])])
    a.vector((1.0, 2.0), np.array([0.0, 0.5 * a.per_mm, 0.0]), "load", "F", "short")
    assert a.canvas.items == []  # too short to be seen from any side
    a.vector((1.0, 2.0), np.array([0.0, np.nan, 0.0]), "load", "F", "none")
    assert a.canvas.items == []
    a.vector((1.0, 2.0), np.array([0.0, 0.0, 0.59 * a.per_mm]), "load", "F", "short")
    assert a.canvas.items == []
    a.vector((1.0, 2.0), np.array([0.0, 0.0, 0.61 * a.per_mm]), "load", "F", "long", inward=True)
    (arrow,) = a.canvas.items
    assert isinstance(arrow, Arrow)
    assert (*arrow.tail, *arrow.head) == pytest.approx((1.0, 2.0 - 0.61, 1.0, 2.0))


def test_a_force_pushes_where_it_points_to_the_middle_of_what_it_acts_on() -> None:
    a = action([1, 0, -2])
    assert points_inwards(a, 0, [np.array([0.5, 0.2, 0.3]), np.array([0.3, 0.2, 0.3])])
    assert not points_inwards(a, 0, [np.array([-0.5, 0.2, 0.3]), np.array([0.3, 0.2, 0.3])])
    assert not points_inwards(a, 0, [np.array([0.5, 0.2, 0.3])])
    assert [role_of(kind) for kind in ("joint", "spring", "damper", "load", "weight")] == [
        "joint-force",
        "load",
        "friction",
        "load",
        "weight",
    ]


def test_a_camera_by_its_name_or_by_its_angles() -> None:
    assert camera_of(None) is CAMERAS["isometric"]
    assert camera_of("side") is CAMERAS["side"]
    camera = camera_of((30.0, 20.0))
    assert (camera.azimuth, camera.elevation) == pytest.approx((math.pi / 6, math.pi / 9))
    eye = [math.cos(math.pi / 9) * math.cos(math.pi / 6), math.cos(math.pi / 9) / 2, math.sin(math.pi / 9)]
    assert camera.eye == pytest.approx(eye)
    assert camera.right == pytest.approx([-0.5, math.cos(math.pi / 6), 0])
    assert camera.up == pytest.approx(np.cross(camera.eye, camera.right))
    axes = {
        "front": ([1, 0], [0, 0], [0, 1]),
        "side": ([0, 0], [1, 0], [0, 1]),
        "top": ([1, 0], [0, 1], [0, 0]),
    }
    for name, seen in axes.items():
        assert CAMERAS[name](np.eye(3)) == pytest.approx(np.array(seen), abs=1e-15)
    assert FRONT.order([[0, 5, 0], [0, -3, 0], [0, 1, 0]]) == [0, 2, 1]
    assert Camera() == CAMERAS["isometric"]


def test_a_sight_holds_all_known_places_and_says_its_scales() -> None:
    places = [np.array(p, float) for p in ((0, 9, 0), (0.5, 0, 0.33), (np.nan, 0, 5))]
    s = sight(FRONT, places, 100.0, 50.0, 1.0)
    assert (s.frame.per_mm, *s.frame.middle) == pytest.approx((0.008, 0.25, 0.165))
    assert s(np.array([0.5, 7.0, 0.33])) == pytest.approx((31.25, 20.625))
    assert s.ahead((1.0, 2.0), np.array([3.0, 5.0, -4.0]), 0.5) == pytest.approx((7.0, -6.0))
    assert foreshortening_note(FRONT) == "foreshortening along x, y and z: 1.000, 0.000, 1.000"
    shown = Figures(None, Notation())
    notes, scales = scale_notes(shown, s, 2.0, 0.5)
    assert notes == [
        "Lengths across the view: 1 mm = 0.008 m; forces: 1 mm = 2 N; moments, with two heads: 1 mm = 0.5 N·m.",
        "Parallel view; foreshortening along x, y and z: 1.000, 0.000, 1.000.",
    ]
    assert scales == {"length": 0.008, "force-seen": 2.0, "moment-seen": 0.5}
    assert scale_notes(shown, s, None)[1] == {"length": 0.008}
    canvas = Canvas()
    triad(canvas, FRONT, (5.0, 6.0))
    heads = [i.head for i in canvas.items if isinstance(i, Arrow)]
    assert heads == [pytest.approx((14.0, 6.0)), pytest.approx((5.0, 15.0))]
    assert {t.text for t in canvas.scene(heading=False).texts()} == {"x", "z"}


# force systems


def test_a_couple_towards_the_eye_is_a_dot() -> None:
    s = System(Force([3, 0, 4], at=[1, 2, 0]), Force([1, 0, 0], at=[0, 0, 2]), Couple([0, 5, 0], "M"))
    scene = force_system_scene(s, camera=FRONT)
    dots = [i for i in scene.items if isinstance(i, Circle) and i.role == "load" and i.radius == 0.8]
    assert len(dots) == 1
    assert "M = 5.000 N·m" in {t.text for t in scene.texts()}


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_the_couple_of_a_wrench_is_before_its_force_or_behind_it(sense: float) -> None:
    """3 mm before the head of R where they agree, else 3 mm behind its tail; moments to one scale either way."""
    s = System(Force([0, 0, 50], at=[0.1, 0, 0]), Couple([0, 0, 8 * sense]), Couple([0, 0, -sense]))
    d = SystemDrawing(s, Figures(s.units, Notation()), FRONT)
    assert d.moment_per_mm == pytest.approx(
        SystemDrawing(-s, Figures(s.units, Notation()), FRONT).moment_per_mm
    )
    assert d.resultant() == []
    force = next(i for i in d.canvas.items if isinstance(i, Arrow) and i.of == "R")
    moment = next(i for i in d.canvas.items if isinstance(i, Arrow) and i.of == "M")
    start = force.head[1] + 3.0 if sense > 0 else force.tail[1] - 3.0
    assert moment.tail == pytest.approx((force.tail[0], start))
    assert (moment.head[1] - moment.tail[1]) * d.moment_per_mm == pytest.approx(7 * sense)
    assert d.describe_result().startswith("The system is a wrench: R = (0, 0, 50.00) N, 50.00 N, on the line")
    assert f"pitch {d.shown.text('length', 0.14 * sense)}." in d.describe_result()


def test_a_line_far_away_is_said_and_not_drawn() -> None:
    s = System(Force([0, 1], at=[0, 0]), Force([0, -0.999], at=[1, 0]))
    d = SystemDrawing(s, Figures(s.units, Notation()), None)
    (said,) = d.resultant()
    assert said.startswith("Its line is outside this drawing: it passes through (−999.0, 0) m.")
    assert d.canvas.items == []
    alone = System(Force([3, 4], at=[1, 2]))
    assert SystemDrawing(alone, Figures(alone.units, Notation()), None).resultant() == []


def test_the_distance_of_the_resultant_is_that_from_the_origin() -> None:
    s = System(Force([0, 3], at=[2, 0]), Force([0, 5], at=[4, 0]))
    texts = {t.text for t in force_system_scene(s).texts()}
    assert "d = 3.250 m" in texts
    near = System(Force([0, 3], at=[-4, 0]), Force([0, 5], at=[2.4, 0]))
    assert not [t for t in force_system_scene(near).texts() if t.text.startswith("d = ")]


def test_a_reduction_is_at_its_point_with_its_force_and_couple() -> None:
    s = System(Force([3, 4], at=[1, 2]), Couple(5), points={"A": [2, -1]})
    scene = reduced_scene(s, "A")
    force = next(a for a in scene.arrows() if a.of == "R")
    assert np.subtract(force.head, force.tail) * scene.scales["force"] == pytest.approx([3, 4])
    couple = 5 + (1 - 2) * 4 - (2 + 1) * 3
    assert f"R = (3.000, 4.000) N, M = {couple:.3f} N·m.".replace("-", "−") in " ".join(
        t.text for t in scene.texts()
    )
    assert scene.title == "Force and couple at A (2.000, −1.000) m"
    assert scene.numbers["resultant"] == pytest.approx(5)


@pytest.mark.parametrize(
    ("at", "along", "ends"),
    [
        ((0, 5), (1, 0), ((-10, 5), (10, 5))),
        ((0, 5), (-2, 0), ((10, 5), (-10, 5))),
        ((0, 9), (1, 0), None),
        ((0, 8), (1, 0), ((-10, 8), (10, 8))),
        ((3, 50), (0, 1), ((3, 0), (3, 8))),
        ((11, 4), (0, 1), None),
        ((0, 4), (1, 2), ((-2, 0), (2, 8))),
        ((0, 40), (1, 1), None),
        ((0, 4), (0, 0), None),
    ],
)
def test_a_line_is_drawn_as_far_as_the_drawing_reaches(at: Any, along: Any, ends: Any) -> None:
    found: Any = clip_line(at, along, (-10, 0, 10, 8))
    assert found == (None if ends is None else tuple(pytest.approx(end) for end in ends))
