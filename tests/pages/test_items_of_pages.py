"""Parts of a page's drawings that few machines have: clutches, wedges, cylinders, drums, rails, rates of points."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.compile.elements.cam_motion import outline
from dalembert.kernel.graph import Graph
from dalembert.model.library import template_text
from dalembert.pages.page_data import page_data
from dalembert.pages.sweep import with_cycle
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.plane.elements.cam_symbol import follower_items, resting_follower
from tests.elements.test_cams import machine
from tests.elements.test_one_way import FILE as ONE_WAY
from tests.pages import test_page_inputs as inputs
from tests.pages.test_page_data import run_page

RAIL = """
links:
  ground: {points: {O: [0, 0], C: [0.02, -0.3]}}
  crank: {points: {O: [0, 0], P: [0.1, 0]}, mass: 1, center: [0.05, 0], inertia: 0.01}
  lever: {points: {C: [0, 0], Q: [0.11, 0.02]}, mass: 1, center: [0.2, 0.03], inertia: 0.01}
  block: {points: {P: [0, 0]}, mass: 0.2}
joints:
  O: {type: pin, links: [ground, crank]}
  C: {type: pin, links: [ground, lever]}
  P: {type: pin, links: [crank, block]}
  S: {type: slider, links: [lever, block], at: [Q, P], direction: 5 deg}
drives: {O: {position: [0.3, 0.5, 0.9, 1.2], speed: 3 rad/s}}
assembly: {lever: 70 deg, block: 75 deg}
"""
MADE = {"clutch": ONE_WAY, "rail": RAIL}


@pytest.mark.parametrize(("name", "types"), [("clutch", {"one_way"}), ("rail", {"slider", "pin"})])
def test_symbols_of_rare_joints_are_those_of_the_drawing(
    name: str, types: set[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for key, text in MADE.items():
        monkeypatch.setitem(inputs.MADE, key, text)
    inputs.test_symbols_of_a_page_are_those_of_the_drawing(name, types, monkeypatch)


def test_a_rail_goes_from_its_point_to_the_block_on_it() -> None:
    m = da.loads(RAIL)
    data, r = page_data(m), da.dynamics(m)
    out = run_page(data)
    (rail,) = (i for i in data["views"]["mechanism"]["items"] if i["t"] == "path" and i["role"] == "link")
    assert rail["of"] == ["link", "lever"]
    ends = [out[p].T for p in rail["p"]]
    np.testing.assert_allclose(ends[0], r.point("lever", "Q"), atol=1e-12)
    np.testing.assert_allclose(ends[1], r.point("block", "P"), atol=1e-12)


def test_a_page_tells_velocities_and_accelerations_of_joints_and_mass_centres() -> None:
    m = da.loads(RAIL)
    data, r = page_data(m), da.dynamics(m)
    out, rates = run_page(data), data["views"]["rates"]
    links = [("joint", "P", "block"), ("joint", "S", "block")]
    links += [("center", link, link) for link in ("crank", "lever", "block")]
    assert [rate["of"] for rate in rates] == [[kind, name] for kind, name, _ in links]
    for rate, (kind, name, link) in zip(rates, links, strict=True):
        u = m.point(link, "P") if kind == "joint" else m.center(link)
        place = r.point(link, "P") if kind == "joint" else r.center(name)
        places = (place, r._velocity(link, np.array(u)), r._acceleration(link, np.array(u)))
        for key, values in zip("pva", places, strict=True):
            np.testing.assert_allclose(out[rate[key]].T, values, atol=1e-9)
    assert page_data(m, static=True)["views"]["rates"] == []


def test_a_wedge_is_its_corners_and_its_block_lies_on_its_face() -> None:
    m = with_cycle(da.wedge())
    data = page_data(m)
    out = run_page(data)
    items = data["views"]["mechanism"]["items"]
    (hull,) = (i for i in items if i["t"] == "hull" and i["link"] == "wedge")
    corners = np.array([out[p] for p in hull["p"]])
    assert len(corners) in (3, 4)
    moved = corners - corners[:1]
    np.testing.assert_allclose(moved, np.repeat(moved[:, :, :1], out.shape[1], axis=2), atol=1e-12)
    sliders = [name for name, j in m.joints.items() if j.type == "slider"]
    symbols = {n: [i for i in items if i["t"] == "symbol" and i["of"] == ["joint", n]] for n in sliders}
    base = next(n for n in sliders if m.joints[n].links == ("ground", "wedge"))
    assert not any("l-block" in i["svg"] for i in symbols[base])
    assert all(any("l-block" in i["svg"] for i in symbols[n]) for n in sliders if n != base)


@pytest.mark.parametrize("template", ["block_brake", "band_brake", "plate_clutch"])
def test_the_free_body_of_a_lever_has_no_drum(template: str) -> None:
    """The drum is on the free body of the link whose axis it has; what is pressed on it is on none."""
    m = da.loads(template_text(template))
    data = page_data(m)
    (name,) = (n for n, j in m.joints.items() if j.type in ("shoe", "band", "disc"))
    i, j = m.joints[name].links
    bodies = {body["link"]: body["items"] for body in data["views"]["bodies"]}
    drawn = {link: [x["svg"] for x in items if x["of"] == ["joint", name]] for link, items in bodies.items()}
    assert [link for link, some in drawn.items() if some] == [link for link in (i,) if link in bodies]
    assert j not in bodies or not drawn[j]
    assert all("l-pitch" in svg and "l-block" not in svg for some in drawn.values() for svg in some)
    assert max(map(len, drawn.values())) <= 1


QUICK_FALL = [
    {"to": "8 mm", "in": "110 deg", "by": "cycloidal"},
    {"to": 0, "in": "80 deg", "by": "cycloidal"},
    {"dwell": "rest"},
]


@pytest.mark.parametrize("follower", ["knife", "flat", {"roller": "9 mm"}])
@pytest.mark.parametrize("segments", [None, QUICK_FALL])
def test_a_follower_that_only_slides_is_the_same_at_rest(follower: Any, segments: Any) -> None:
    """Its face is as long as the contact wanders to either side."""
    r = da.dynamics(da.mechanism(machine(follower, segments)))
    frame = PaperFrame(0.0004, (0.013, -0.021))
    at, turn = np.array(frame(r.point("stem", "F")[0])), float(r.angle("stem")[0])
    turned = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    for moved, own in zip(follower_items(r, "F", 0, frame), resting_follower(r, "F", frame), strict=True):
        (size, points), (same, resting) = (inputs.spread(item) for item in (moved, own))
        assert size == same
        assert moved.role == own.role  # type: ignore[union-attr]
        assert points - at == pytest.approx(resting @ turned)


def test_a_page_of_a_cam_has_its_outline_and_room_for_it() -> None:
    m = da.mechanism(machine("knife"))
    data = page_data(m)
    out = run_page(data)
    mine = [i for i in data["views"]["mechanism"]["items"] if i.get("of") == ["joint", "F"]]
    assert "l-link-area" in mine[0]["svg"]
    room = [i for i in mine if not i["svg"]]
    assert len(room) == 4
    edge = outline(m, "F")
    r = da.dynamics(m)
    turn = r.angle("cam")[3]
    e = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    for one, way in zip(room, ((1, 0), (0, 1), (-1, 0), (0, -1)), strict=True):
        corner = edge[int(np.argmax(edge @ way))]
        np.testing.assert_allclose(out[one["p"]][:, 3], corner @ e, atol=1e-9)


def test_a_page_has_the_slopes_of_as_many_curves_as_fit(monkeypatch: pytest.MonkeyPatch) -> None:
    """The first curve's fit where they take exactly as many operations as are allowed, and not one more."""
    sizes, order = list[int](), Graph.order

    def counted(*of: Any) -> Any:
        if sys._getframe(1).f_code.co_name == "_gradient":
            sizes.append(len(order(*of)))
        return order(*of)

    m = da.four_bar(positions=8)
    monkeypatch.setattr(Graph, "order", counted)
    every = page_data(m)
    assert every["gradient"]["curves"] == [
        c["row"] for chart in every["views"]["charts"] for c in chart["curves"]
    ]
    for allowed, curves in ((sizes[0] - 1, 0), (sizes[0], 1), (sizes[1] - 1, 1), (sizes[1], 2)):
        monkeypatch.setattr("dalembert.pages.page_data.OPERATIONS", allowed)
        assert len(page_data(m).get("gradient", {"curves": []})["curves"]) == curves
