"""What a drawing shows is what was computed: senses, arms and forces read back from its lines and words."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases
from dalembert.machine.shaking import shaking_force
from dalembert.views.charts import shaking_chart
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.scene import Arc, Arrow, Line
from dalembert.views.plane.circle_details import pin_detail
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
