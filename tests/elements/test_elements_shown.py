"""Elements are drawn to scale, printed, written, reported and put on live pages."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.model.library import template_text
from dalembert.pages.page_data import page_data
from dalembert.views.paper.scene import Circle, Polygon
from dalembert.views.plane.elements.turning_axis import BALL, axis_ends
from dalembert.views.plane.elements.wedge_drawing import wedge_corners

CYLINDER = """units: {length: mm, mass: kg, force: N}
gravity: standard
links:
  ground: {points: {O: [0, 0], A: [200, -400]}}
  boom: {points: {O: [0, 0], B: [900, 150]}, mass: 320, center: [1600, 0]}
joints: {O: {type: pin, links: [ground, boom]}}
drives:
  C: {position: 1000, cylinder: {between: [ground.A, boom.B], bore: 80, rod: 60, barrel: 95, closed: 700, stroke: 450}}
loads: {g: {type: gas_spring, between: [ground.A, boom.B], rod: 20, volume: 0.4 l, pressure: 20 bar, length: 1200}}
assembly: {boom: 10}
"""
SCREW = """units: {length: mm, mass: kg, force: N}
links: {ground: {points: {O: [0, 0]}}, nut: {points: {N: [0, 0]}}}
joints: {S: {type: slider, links: [ground, nut], at: [O, N]}}
drives: {S: {position: 50, speed: 10 mm/s, screw: {lead: 8, radius: 15, friction: {coefficient: 0.08}}}}
loads: {W: {type: force, on: nut, at: N, value: [-6400, 0]}}
"""
CLUTCH = """units: {length: mm, mass: kg, force: N}
links: {ground: {points: {O: [0, 0]}}, one: {points: {O: [0, 0]}}, two: {points: {O: [0, 0]}}}
joints:
  A: {type: pin, links: [ground, one], at: O}
  B: {type: pin, links: [ground, two], at: O}
  K: {type: ratchet, teeth: 24, links: [one, two], at: O, free: cw}
drives: {A: {position: 0, speed: 1 rad/s}}
loads: {T: {type: couple, on: two, value: 120}}
"""
FACES = """units: {length: mm, mass: kg, force: N, moment: N*m}
links: {ground: {points: {O: [0, 0]}}, disc: {points: {O: [0, 0]}}}
joints:
  O: {type: pin, links: [ground, disc]}
  pads: {type: disc, links: [ground, disc], at: O, radii: [90, 140], faces: 2, friction: {coefficient: 0.4}, force: 900}
drives: {O: {position: 0, speed: 10 rad/s}}
"""
TACKLE = """units: {length: mm, mass: kg, force: N}
gravity: standard
links:
  ground: {points: {T: [0, 0], E: [300, 0], P: [-200, -800]}}
  block: {points: {B: [0, 0]}, mass: 40}
  hand: {points: {h: [0, 0]}}
joints:
  lift: {type: slider, links: [ground, block], at: [T, B], direction: -90, angle: 90}
  pull: {type: slider, links: [ground, hand], at: [P, h], direction: -90, angle: 90}
  rope: {type: rope, through: [hand.h, {round: ground.T, radius: 60}, {round: block.B, radius: 60}, ground.E],
         parallel: true, efficiency: 0.95}
drives: {pull: {position: 0, speed: 200 mm/s}}
assembly: {block: [150, -900, 0]}
"""
TANGENT = """units: {length: mm, mass: kg, force: N}
links: {ground: {points: {O: [0, 0]}}, cam: {points: {O: [0, 0]}}, stem: {points: {F: [0, 0]}, mass: 1}}
joints:
  O: {type: pin, links: [ground, cam]}
  guide: {type: slider, links: [ground, stem], at: [O, F], direction: 90}
  F: {type: cam, links: [cam, stem], at: [O, F], follower: {roller: 20}, contact: holds,
      profile: {tangent: {base: 38, lift: 9.5, half_angle: 75 deg}}}
drives: {O: {position: 50, speed: 20 rad/s}}
"""
FILES = {
    "cylinder": CYLINDER,
    "screw": SCREW,
    "clutch": CLUTCH,
    "faces": FACES,
    "tackle": TACKLE,
    "tangent": TANGENT,
}


@pytest.mark.parametrize("name", FILES)
def test_everything_that_shows_a_mechanism_shows_it(name: str, tmp_path: Path) -> None:
    m = da.loads(FILES[name])
    r = da.dynamics(m)
    assert r.ok.all()
    r.save(tmp_path / "drawing.svg")
    r.save(tmp_path / "answer.json")
    r.save(tmp_path / "answer.csv")
    assert "<html" in da.page(m)
    assert r.sheet()
    assert b"=" in da.report(r).to_bytes("txt")
    assert da.virtual_work(r) is not None


def test_the_direction_of_parallel_strands_cannot_vary() -> None:
    with pytest.raises(da.ModelError, match="of a rope follows from 'joints"):
        da.compile(da.loads(TACKLE), ["joints.lift.direction"])


def test_a_cylinder_is_drawn_to_scale() -> None:
    r = da.statics(da.loads(CYLINDER))
    scene = da.draw.mechanism(r)
    per_mm = scene.scales["length"]
    sizes = [np.array(i.points) for i in scene.items if isinstance(i, Polygon) and len(i.points) == 4]
    widths = sorted(
        min(float(np.hypot(*(p[1] - p[0]))), float(np.hypot(*(p[2] - p[1])))) * per_mm for p in sizes
    )
    assert any(w == pytest.approx(0.095, rel=1e-9) for w in widths)
    assert any(w == pytest.approx(0.060, rel=1e-9) for w in widths)


def test_a_wedge_is_drawn_with_its_faces() -> None:
    """The triangle below the part of the face that its block slides along: travel times the tangent of the slope."""
    for slope in (10, -10):
        corners = wedge_corners(da.statics(da.wedge(slope=f"{slope} deg")), "wedge")
        height = math.copysign(0.1 * math.tan(math.radians(10)), slope)
        assert corners is not None
        assert np.allclose(corners[np.lexsort(corners.T[::-1])], sorted([(0, 0), (0, height), (0.1, 0)]))
    assert wedge_corners(da.statics(da.loads(CYLINDER)), "boom") is None


def test_tables_say_what_elements_need() -> None:
    words = " ".join(da.statics(da.loads(CYLINDER)).text().split())
    c = da.statics(da.loads(CYLINDER)).cylinder("C")
    assert f"of {c.critical[0]:.6g} N (ends pin and pin" in words
    assert "Play and misalignment are left out." in words
    screw = da.statics(da.loads(SCREW)).text()
    assert "does not lock by itself" in screw
    assert "from a coefficient of 0.08488 on" in " ".join(screw.split())
    entry = da.statics(da.loads(SCREW)).to_dict()["positions"][0]
    slope, mu = 8 / (30 * math.pi), 0.08
    assert entry["screw_torque"]["S"] == pytest.approx(
        6400 * 0.015 * (slope + mu) / (1 - slope * mu), rel=1e-12
    )
    assert set(da.statics(da.loads(CYLINDER)).to_dict()["positions"][0]) >= {"pressure", "flow"}


def test_a_lifted_cylinder_has_the_same_pressure() -> None:
    m = da.loads(CYLINDER.replace("loads:", "answers: []\n#"))
    plane, space = da.statics(m), da.statics(da.lifted(m))
    assert space.cylinder("C").pressure == pytest.approx(plane.cylinder("C").pressure, rel=1e-9)


@pytest.mark.parametrize(("template", "shapes"), [("block_brake", 1), ("band_brake", 3), ("plate_clutch", 2)])
def test_a_page_shows_what_is_pressed_on_a_drum(template: str, shapes: int) -> None:
    """The lining, the band with both strands, the edges of the faces, as large as the drum that they are about."""
    m = da.loads(template_text(template))
    items = page_data(m)["views"]["mechanism"]["items"]
    drawn = [item["svg"] for item in items if item["t"] == "symbol" and "per_mm" in item]
    linings = [svg for svg in drawn if "journal" in svg or "block" in svg]
    assert len(linings) == 1
    assert linings[0].count("l-journal" if template == "plate_clutch" else "l-block") == shapes


@pytest.mark.parametrize(("template", "arcs"), [("belt_drive", 2), ("hoist", 2), ("disc_cam", 0)])
def test_a_page_shows_a_belt_on_its_wheels(template: str, arcs: int) -> None:
    """Arcs about the wheels' centres from one strand to the next."""
    items = page_data(da.loads(template_text(template)))["views"]["mechanism"]["items"]
    drawn = [item for item in items if item["t"] == "arc"]
    ends = [tuple(p) for item in items if item["t"] == "path" for p in item["p"]]
    assert len(drawn) == arcs
    for item in drawn:
        assert {tuple(p) for p in item["p"][1:]} <= {*ends}
        assert tuple(item["p"][0]) not in ends


def test_a_governor_has_its_ball_and_its_axis() -> None:
    for template in ("porter_governor", "hartnell_governor"):
        m = da.loads(template_text(template))
        r = da.statics(m)
        balls = [i for i in da.draw.mechanism(r).items if isinstance(i, Circle) and i.role == "block"]
        assert [ball.radius for ball in balls] == [BALL]
        items = page_data(m)["views"]["mechanism"]["items"]
        links = [
            item["of"][1] for item in items if item["t"] == "symbol" and 'class="l-block"' in item["svg"]
        ]
        assert [n for n in links if n in m.links] == ["upper" if "upper" in m.links else "bell"]
        assert [len(item["p"]) for item in items if item.get("role") == "pitch"] == [2]
    assert axis_ends(da.statics(da.loads(CYLINDER)), slice(None), 0.0) is None


def test_the_axis_reaches_over_all_heights() -> None:
    ends = axis_ends(da.statics(da.loads(template_text("porter_governor"))), slice(0, 1), 0.01)
    assert ends is not None
    assert np.allclose(ends, [(0, -0.5 * math.sin(math.radians(60)) - 0.01), (0, 0.01)])


def test_corners_of_a_wedge_are_found_once() -> None:
    r = da.statics(da.wedge())
    assert wedge_corners(r, "wedge") is wedge_corners(r, "wedge")
