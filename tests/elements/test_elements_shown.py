"""Elements are drawn to scale, printed, written, reported and put on live pages."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.views.paper.scene import Polygon

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
FILES = {"cylinder": CYLINDER, "screw": SCREW, "clutch": CLUTCH}


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
    assert da.virtual_work(r) is not None


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
