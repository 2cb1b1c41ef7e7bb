"""Parts of plane drawings on their own: meeting points, lines to the edge of the paper, frames, what is too small."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import Action
from dalembert.bundled import examples
from dalembert.views.formats.glb import _extent, solid_model
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import FINE, PaperFrame, round_up
from dalembert.views.paper.scene import Arc, Arrow, Circle, Line, Polygon
from dalembert.views.plane.force_polygons import (
    _inside,
    _mark,
    _through,
    _two_meetings,
    arm_of_couple,
    dimension,
)
from dalembert.views.plane.mechanism_view import draw_actions
from dalembert.views.plane.outline import convex
from dalembert.views.space import journal_details
from dalembert.views.space.link_solids import Mount, _symbol
from dalembert.views.space.solids import Block
from tests.friction.engines import engine
from tests.methods.space_machines import solved as solved_in_space
from tests.methods.test_space_friction_drawings import solved

SPAN = (0.0, 0.0, 100.0, 60.0)
NAMES = ("a", "b", "c", "d")


@pytest.mark.parametrize(
    ("p", "q", "ends", "words"),
    [
        ((10, 20), (90, 50), ((10, 20), (90, 50)), ("P", "Q")),
        ((10, 20), (10, 220), ((10, 20), (10, 60)), ("P", "Q (beyond the drawing)")),
        ((-190, 0), (10, 0), ((-30, 0), (10, 0)), ("P (beyond the drawing)", "Q")),
        ((148, 10), (152, 10), ((148, 10), (152, 10)), ("P", "Q (beyond the drawing)")),
        ((200, 0), (10, 300), None, ("P (beyond the drawing)", "Q (beyond the drawing)")),
    ],
)
def test_two_points_where_lines_meet(p: Any, q: Any, ends: Any, words: Any) -> None:
    """The line through them goes from point to point, or 40 mm towards one that is beyond the drawing."""
    canvas = Canvas()
    said = _two_meetings(canvas, p, q, SPAN, NAMES)
    assert said == [f"a, b meet in {words[0]}, c, d in {words[1]}; PQ carries both resultants."]
    lines = [i.points for i in canvas.items if isinstance(i, Line)]
    assert len(lines) == (ends is not None)
    assert [pytest.approx(end) for line in lines for end in line] == list(ends or ())
    marks = [i.center for i in canvas.items if isinstance(i, Circle)]
    assert marks == [at for at, word in zip((p, q), words, strict=True) if "beyond" not in word]


@pytest.mark.parametrize(
    ("at", "force", "ends"),
    [
        ((50, 30), (5, 0), ((95, 30), (5, 30))),
        ((90, 30), (5, 0), ((113, 30), (45, 30))),
        ((10, 30), (-5, 0), ((-13, 30), (55, 30))),
        ((50, 30), (0, 2), ((50, 73), (50, -13))),
        ((200, 30), (1, 0), ((207, 30), (193, 30))),
        ((50, 30), (3, 4), ((77, 66), (23, -6))),
    ],
)
def test_a_line_goes_on_a_little_beyond_the_drawing(at: Any, force: Any, ends: Any) -> None:
    """From 45 mm back in steps of 2 to where it is within 14 mm of it; 7 mm at least."""
    found = _through(at, np.array(force, float), SPAN)
    assert [*found[0], *found[1]] == pytest.approx([*ends[0], *ends[1]])


def test_what_is_near_a_drawing() -> None:
    for x, y, near in (
        (-5, 30, True),
        (-5.1, 30, False),
        (105, 65, True),
        (105.1, 65, False),
        (50, -5.1, False),
    ):
        assert _inside((x, y), SPAN, 5.0) == near
    canvas = Canvas()
    _mark(canvas, (161.0, 0.0), SPAN, "P")
    assert canvas.items == []
    dimension(canvas, (1, 2), (5, 6), "h")
    assert [(i.tail, i.head) for i in canvas.items if isinstance(i, Arrow)] == [
        ((3, 4), (1, 2)),
        ((3, 4), (5, 6)),
    ]


def action(at: Any, force: Any = (0, 0), couple: float = 0.0) -> Action:
    one = np.array([at], float), np.array([force], float), np.array([couple])
    return Action("F", "load", "rocker", "", None, *one)


def test_the_arm_of_two_opposite_forces() -> None:
    assert arm_of_couple([action((0, 0), (3, 4)), action((5, 0), (-3, -4))], 0) == pytest.approx(4.0)
    assert arm_of_couple([action((1, 1), (0, -2)), action((-2, 9), (0, 2))], 0) == pytest.approx(3.0)
    assert arm_of_couple([action((0, 0)), action((5, 0))], 0) == 0.0


def test_what_is_too_small_beside_the_largest_is_not_drawn() -> None:
    r = da.statics(da.load(examples()["four_bar"]))
    shown = Shown(r, Notation(), 0)

    def drawn(*some: Action) -> list[Any]:
        canvas = Canvas()
        draw_actions(canvas, r, list(some), 0, PaperFrame(0.001), shown, 22.0)
        return [i.value for i in canvas.items if isinstance(i, (Arc, Arrow))]

    least, o = shown.least["moment"], (0, 0)
    assert drawn(action(o, couple=100.0), action(o, couple=-3.0), action(o, couple=5e-8)) == [100.0, -3.0]
    assert drawn(action(o, couple=0.5 * least)) == []
    assert drawn(action(o, couple=-2 * least)) == [-2 * least]
    assert drawn(action(o, (3, 4)), action(o, (4e-9, 0)), action(o, (0.02, 0))) == [5.0, 0.02]
    assert drawn(action(o, (3, 4)), action(o, (0.005, 0))) == [5.0]
    assert drawn(action(o, (3, math.nan)), action(o, couple=math.nan), action(o)) == []


def test_a_free_body_has_room_for_its_friction_circles_and_its_guide() -> None:
    """The lines of the other links' joints and guides take no room."""
    tree = engine(mu=0.2, guide=1.5).to_tree()
    r = da.statics(da.mechanism(tree))
    per_mm = {link: da.draw.free_body(r, link).scales["length"] for link in ("crank", "rod", "piston")}
    radius = {"O": 0.014, "A": 0.012, "B": 0.008}
    place = {"O": (0.0, 0.0), "A": r.point("crank", "A")[0], "B": r.point("rod", "B")[0]}
    ends = {"crank": "OA", "rod": "AB"}
    for link, joints in ends.items():
        low, high = (np.array([np.add(place[j], s * radius[j]) for j in joints]) for s in (-1, 1))
        need = (high.max(axis=0) - low.min(axis=0)) / (40.0, 34.0)
        assert per_mm[link] == pytest.approx(round_up(float(need.max()), FINE))
    assert per_mm["piston"] == pytest.approx(round_up(3.0 / 40.0, FINE))


@pytest.mark.parametrize("speed", [1.0, -1.0])
@pytest.mark.parametrize("given", [True, False])
def test_a_guide_is_as_high_as_given_or_drawn_apart(given: bool, speed: float) -> None:
    tree = engine(guide=0.05).to_tree()
    tree["drives"]["O"]["speed"] = f"{speed} rad/s"
    if given:
        tree["joints"]["guide"]["friction"]["half_height"] = 0.03
    scene = da.draw.mechanism(da.statics(da.mechanism(tree)))
    words = " ".join(t.text for t in scene.texts())
    assert ("faces drawn apart" in words) != given
    if given:
        per_mm = scene.scales["length at guide"]
        block = [i for i in scene.flat() if isinstance(i, Polygon) and i.role == "block"][-1]
        assert np.ptp(np.array(block.points)[:, 1]) * per_mm == pytest.approx(0.06)


@pytest.mark.parametrize("sense", [0.0, math.nan])
def test_no_arrow_where_nothing_turns(sense: float, monkeypatch: pytest.MonkeyPatch) -> None:
    r, canvas = solved("rssr"), Canvas()
    monkeypatch.setattr(journal_details, "friction_sense", lambda *a: sense)
    journal_details._turning(canvas, r, "O", 0, Shown(r, Notation(), 0), r.mechanism.joints["O"].links[1], [])
    assert canvas.items == []


@pytest.mark.parametrize(
    ("points", "hull"),
    [
        ([(0, 0), (4, 0), (4, 3), (0, 3), (2, 1)], [(0, 0), (4, 0), (4, 3), (0, 3)]),
        ([(0, 0), (2, 0), (4, 0), (4, 3)], [(0, 0), (4, 0), (4, 3)]),
        ([(1, 1), (0, 0), (2, 2)], [(0, 0), (2, 2)]),
        ([(1, 5), (1, 2)], [(1, 2), (1, 5)]),
        ([(3, 3), (3, 3)], [(3, 3)]),
    ],
)
def test_the_outline_of_points(points: Any, hull: Any) -> None:
    assert convex(points) == hull


@pytest.mark.parametrize(
    ("name", "drive", "positions", "closed"),
    [
        ("four_bar", "O2", range(0, 360, 30), True),
        ("four_bar", "O2", range(30, -330, -30), True),
        ("four_bar", "O2", range(0, 720, 45), True),
        ("four_bar", "O2", [k * 360 / 7 for k in range(7)], False),
        ("four_bar", "O2", range(0, 180, 15), False),
        ("four_bar", "O2", (0, 10, 20, 30, 40, 30, 20, 10, 0), False),
        ("gear_train", "sun_bearing", range(0, 360, 20), False),
        ("shaker", "S", (0, 1, 2, 3, 4, 3, 2, 1), False),
    ],
    ids=["turn", "back", "two turns", "seven", "half a turn", "to and fro", "planet", "slide"],
)
def test_a_motion_is_closed_where_it_comes_round(name: str, drive: str, positions: Any, closed: bool) -> None:
    m = da.loads(SHAKER) if name == "shaker" else da.load(examples()[name])
    unit = "mm" if name == "shaker" else "deg"
    r = da.kinematics(m.with_values({f"drives.{drive}.position": [f"{x} {unit}" for x in positions]}))
    document = solid_model(r).document
    (motion,) = document["animations"]
    count = document["accessors"][motion["samplers"][0]["input"]]["count"]
    assert count == len(r.status) + closed


SHAKER = """
links: {ground: {points: {S: [0, 0]}}, block: {points: {S: [0, 0]}, mass: 1}}
joints: {S: {type: slider, links: [ground, block]}}
drives: {S: {position: 0}}
"""


def test_what_acts_is_drawn_as_asked() -> None:
    r = da.dynamics(da.load(examples()["four_bar"]).with_values({"gravity": "standard"}))
    roles = [
        {i.role for i in da.draw.mechanism(r, forces=f).items if isinstance(i, (Arrow, Arc))}
        for f in (False, True)
    ]
    assert roles == [{"load", "effort"}, {"load", "effort", "weight", "inertia"}]


def test_symbols_are_as_large_as_the_longer_side_of_the_machine_says() -> None:
    r = da.statics(da.load(examples()["four_bar"]))
    points = [r.point(link, n)[0] for link in r.links for n in r.mechanism.points(link)]
    assert _extent(r, np.array([0])) == pytest.approx(np.ptp([*points, (0.0, 0.0)], axis=0).max())


@pytest.mark.parametrize(("low", "high"), [((2, 0, 0), (5, 0, 0)), ((-5, 0, 0), (-2, 0, 0))])
def test_a_rail_on_a_moving_link_begins_at_its_point(low: Any, high: Any) -> None:
    r = solved_in_space("slider_crank")
    size = 0.001
    one = Mount(
        "prismatic",
        ("rod", "slider"),
        (np.zeros(3),) * 2,
        (np.eye(3),) * 2,
        np.array(low) * size,
        np.array(high) * size,
    )
    (rail,) = _symbol(r, one, size).on_i
    assert isinstance(rail, Block)
    ends = [rail.center[0] - rail.half[0], rail.center[0] + rail.half[0]]
    assert ends == pytest.approx([min(0, low[0]) - 5.0, max(0, high[0]) + 5.0])


def test_an_animation_shows_the_paths_that_are_described() -> None:
    r = da.statics(da.load(examples()["four_bar"]), positions=8)
    assert any(i.role == "trace" for i in da.draw.animation(r).still)
