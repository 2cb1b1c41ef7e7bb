"""Brakes, bands and cams on paper and as solids: their sizes, sides and senses, in any place of the machine."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.model.library import template
from dalembert.views.formats.glb import times
from dalembert.views.notation import Notation
from dalembert.views.paper.scene import Circle, Line, Polygon, Scene
from dalembert.views.space.link_solids import link_solids, shape_solids
from dalembert.views.space.solids import Ball, Ring, RoundBar
from tests.elements.test_elements_shown import CLUTCH, FACES, TANGENT

THIN, WIDE = 0.6, 3.6
"""Widths of a band on paper without tension, and at its greatest, mm."""


def blocks(scene: Scene, corners: int) -> list[Any]:
    """Polygons of linings, bands and followers with so many corners."""
    return [
        np.array(item.points)
        for item in scene.items
        if isinstance(item, Polygon) and item.role == "block" and len(item.points) == corners
    ]


def angles(points: Any, center: Any) -> Any:
    x, y = (points - center).T
    return np.degrees(np.unwrap(np.arctan2(y, x)))


def middle(scene: Scene, role: str) -> Any:
    return np.array(next(i.center for i in scene.items if isinstance(i, Circle) and i.role == role))


@pytest.mark.parametrize("sector", [60, 135])
def test_pads_cover_their_sector_above_the_axis(sector: int) -> None:
    m = da.loads(FACES.replace("faces: 2", f"faces: 2, sector: {sector} deg"))
    scene = da.draw.mechanism(da.dynamics(m))
    (pad,) = blocks(scene, 50)
    center, size = middle(scene, "journal"), 0.001 / scene.scales["length"]
    radii = np.hypot(*(pad - center).T)
    assert radii == pytest.approx([90 * size] * 25 + [140 * size] * 25, rel=1e-9)
    inner, outer = angles(pad[:25], center), angles(pad[25:], center)
    assert (inner[0], inner[-1]) == pytest.approx((90 - sector / 2, 90 + sector / 2))
    assert outer[::-1] == pytest.approx(inner)
    assert blocks(da.draw.mechanism(da.dynamics(da.loads(FACES))), 50) == []


def shoe(side: str | None = None, turned: float = 0.0, **friction: Any) -> tuple[Scene, Any]:
    """The block brake, turned round its drum's axis; its lining from 30 to 80 deg from the line to the pin."""
    tree: Any = template("block_brake").to_tree()
    c, s = math.cos(turned), math.sin(turned)
    for point, at in tree["links"]["ground"]["points"].items():
        x, y = (float(str(v).removesuffix(" m")) for v in at)
        tree["links"]["ground"]["points"][point] = [c * x - s * y, s * x + c * y]
    tree["assembly"] = {"lever": math.degrees(turned)}
    if side:
        tree["joints"]["lining"]["side"] = side
    return da.draw.mechanism(da.solve(da.mechanism(tree), positions=1)), tree


def lining_angles(side: str | None) -> Any:
    """Of the lining's rim from the line to the lever's pin, in its order."""
    scene, tree = shoe(side)
    (lining,) = blocks(scene, 50)
    center = middle(scene, "pitch")
    x, y = (float(str(v).removesuffix(" m")) for v in tree["links"]["ground"]["points"]["L"])
    return angles(lining[:25], center) - math.degrees(math.atan2(y, x))


def test_a_lining_lies_on_its_side_of_the_line_to_its_pin() -> None:
    left, right = lining_angles("left") % 360, -lining_angles("right") % 360
    for found in (left, right):
        assert (found[0], found[-1]) == pytest.approx((30, 80))
    own = lining_angles(None) % 360
    assert own == pytest.approx(left) or own == pytest.approx(360 - right)


def band(turn: float, **friction: Any) -> tuple[Any, Scene]:
    """The band brake, turned round the axis of its drum."""
    tree: Any = template("band_brake").to_tree()
    c, s = math.cos(turn), math.sin(turn)
    x, y = -0.2, -0.3
    tree["links"]["ground"]["points"]["L"] = [c * x - s * y, s * x + c * y]
    tree["assembly"] = {"lever": turn}
    tree["units"] = {"angle": "rad"}
    for load in tree["loads"].values():
        if "value" in load and load["type"] == "force":
            load["axes"] = "link"
    if friction:
        tree["friction"] = friction
    r = da.solve(da.mechanism(tree), positions=1)
    return r, da.draw.mechanism(r)


@pytest.mark.parametrize("turn", np.arange(8) * math.pi / 4 + 0.1)
def test_a_band_touches_its_drum_clockwise_over_its_wrap(turn: float) -> None:
    """However the machine lies; its width goes with its tension, from one end to the other."""
    r, scene = band(float(turn))
    (rim,) = blocks(scene, 82)
    center, brake = middle(scene, "pitch"), r.brake("band")
    radius = 0.2 / scene.scales["length"]
    assert np.hypot(*(rim[:41] - center).T) == pytest.approx(np.full(41, radius))
    around = angles(rim[:41], center)
    assert around[0] - around[-1] == pytest.approx(math.degrees(brake.wrap), rel=1e-9)
    widths = np.hypot(*(rim[:40:-1] - center).T) - radius
    ratio = float(brake.slack[0] / brake.tight[0])
    assert sorted(widths)[-1] == pytest.approx(WIDE)
    assert sorted(widths)[0] == pytest.approx(THIN + (WIDE - THIN) * ratio)
    assert (np.diff(widths) > 0).all() or (np.diff(widths) < 0).all()


def test_a_band_without_friction_is_as_wide_everywhere() -> None:
    _, scene = band(0.1, enabled=False)
    (rim,) = blocks(scene, 82)
    center = middle(scene, "pitch")
    widths = np.hypot(*(rim[41:] - center).T) - np.hypot(*(rim[0] - center))
    assert widths == pytest.approx(np.full(41, (THIN + WIDE) / 2))


def test_a_knife_has_its_edge_where_it_touches_the_cam() -> None:
    r = da.dynamics(da.loads(TANGENT.replace("{roller: 20}", "knife")))
    scene = da.draw.mechanism(r)
    ((tip, *back),) = blocks(scene, 3)
    center = np.array(next(i.center for i in scene.items if isinstance(i, Circle) and i.role == "pin"))
    place = (r.position("stem")[0] - 0.0) / scene.scales["length"]
    assert np.hypot(*(tip - center)) == pytest.approx(np.hypot(*place), rel=1e-9)
    assert np.hypot(*(back[0] - tip)) == pytest.approx(np.hypot(*(back[1] - tip)))
    assert all(point[1] > tip[1] for point in back)


LEVER = (
    TANGENT.split("links:")[0]
    + """links:
  ground: {points: {O: [0, 0], P: [-120, 60]}}
  cam: {points: {O: [0, 0]}}
  lever: {points: {P: [0, 0], F: [110, -10]}, mass: 0.8}
joints:
  O: {type: pin, links: [ground, cam]}
  P: {type: pin, links: [ground, lever]}
  F: {type: cam, links: [cam, lever], at: [O, F], follower: {roller: 10}, contact: holds,
      profile: {base: 60, segments: [{to: 12 deg, in: 110, by: cycloidal}, {to: 0 deg, in: 120, by: cycloidal},
      {dwell: rest}]}}
drives: {O: {position: 50, speed: 20 rad/s}}
"""
)


def test_a_cam_of_a_lever_shows_the_arm_to_its_pin() -> None:
    """From the middle of the roller to the lever's pin: the length between its points."""

    def arms(text: str) -> tuple[Any, list[Any]]:
        (shown, *_) = da.cam(da.loads(text), "F").drawings(Notation())
        return shown, [i for i in shown.items if isinstance(i, Line) and i.role == "link"]

    scene, (arm,) = arms(LEVER)
    assert math.dist(*arm.points) * scene.scales["length"] == pytest.approx(math.hypot(0.11, 0.01), rel=1e-9)
    assert arms(TANGENT)[1] == []


def solids(text: str, link: str, kind: type) -> list[Any]:
    """Solids of a kind of a link, of symbols with a millimetre of 1 mm."""
    return [s for s in link_solids(da.dynamics(da.loads(text)), 0.001)[link] if isinstance(s, kind)]


@pytest.mark.parametrize(("follower", "radius"), [("{roller: 20}", 0.02), ("knife", 0.0009)])
def test_a_follower_has_a_peg_through_the_plate_of_its_cam(follower: str, radius: float) -> None:
    (peg,) = [
        s
        for s in solids(TANGENT.replace("{roller: 20}", follower), "stem", RoundBar)
        if s.role == "inner" and s.radius == pytest.approx(radius)
    ]
    assert peg.end - peg.start == pytest.approx([0, 0, 0.004])
    assert (peg.end + peg.start) / 2 == pytest.approx([0, 0, 2 * 0.0022])


@pytest.mark.parametrize("kind", ["ratchet, teeth: 24", "one_way"])
def test_a_one_way_clutch_has_a_ring_round_its_axis(kind: str) -> None:
    text = CLUTCH.replace("ratchet, teeth: 24", kind)
    (ring,) = [s for s in solids(text, "one", Ring) if s.radius == pytest.approx(0.0036)]
    assert (ring.center, ring.axis) == (pytest.approx([0, 0, 0.0022]), pytest.approx([0, 0, 1]))
    assert ring.thickness == pytest.approx(0.0009)


def test_linings_have_no_solids() -> None:
    """A disc on its pin, with pads or without them."""
    bare = FACES.replace("  pads", "  # pads")
    with_pads, without = (link_solids(da.dynamics(da.loads(t)), 0.001) for t in (FACES, bare))
    assert {k: len(v) for k, v in with_pads.items()} == {k: len(v) for k, v in without.items()}


def test_a_sphere_is_a_ball_where_its_middle_is() -> None:
    shape = {"type": "sphere", "radius": "30 mm", "center": [0.2, 0.1, -0.05], "density": 1000}
    points = {"O": [0, 0, 0]}
    m = da.mechanism(
        {
            "space": "space",
            "links": {"ground": {"points": points}, "a": {"points": points, "shape": shape}},
            "joints": {"P": {"type": "revolute", "links": ["ground", "a"], "at": "O", "axis": [0, 0, 1]}},
            "drives": {"P": {"position": 0.3}},
        }
    )
    (ball,) = shape_solids(da.kinematics(m), "a", 0.001)
    assert isinstance(ball, Ball)
    assert (ball.center, ball.radius) == (pytest.approx([0.2, 0.1, -0.05]), 0.03)


def test_a_model_moves_by_the_clock_of_its_law() -> None:
    r = da.kinematics(da.load(examples()["bucket"]))
    assert r.schedule.time is not None
    k = np.arange(2, len(r.status))
    assert times(r, k) == pytest.approx(r["time"][2:] - r["time"][2], rel=1e-12)
