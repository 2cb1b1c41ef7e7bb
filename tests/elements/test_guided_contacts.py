"""Guides that push at both ends, lift off at one and tip; contacts of standing boxes; starts that do not close."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from tests.elements.test_landing import LADDER, G, box
from tests.tiers import crossed

BLOCK = """
gravity: [{gx!r}, {gy!r}]
links:
  ground: {{points: {{O: [0, 0]}}}}
  block: {{points: {{C: [0, 0], T: {t}}}, mass: 2, center: {c}, inertia: 0.03}}
joints:
  S: {{type: slider, links: [ground, block], at: [O, C], direction: {direction}, angle: {angle}, contact: {mode},
      friction: {{guide: [0.2, 0.1], coefficient: {mu}}}}}
drives: {{S: {{effort: 0}}}}
start: {{S: {{position: 0, speed: 1}}}}
loads: {{F: {{type: force, on: block, at: T, value: ["{fx!r}*({force})", "{fy!r}*({force})"]}}}}
"""


def block(
    force: str, mode: str = "pushes", mu: float = 0.0, direction: float = 0.0, angle: float = 0.0
) -> Any:
    """A block of 2 kg, its guide from 0.2 m behind its point C to 0.1 m ahead, pushed along it 0.3 m above."""
    d, a = math.radians(direction), math.radians(-angle)
    t, c = (
        [x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a)]
        for x, y in ((0, 0.3), (0.02, 0.1))
    )
    gravity = {"gx": 10 * math.sin(d), "gy": -10 * math.cos(d)}
    push = {"fx": math.cos(d), "fy": math.sin(d), "force": force}
    text = BLOCK.format(t=t, c=c, direction=direction, angle=angle, mode=mode, mu=mu, **gravity, **push)
    return da.loads(text)


def newton_euler(s: da.Simulation, force: Any, direction: float = 0.0) -> tuple[Any, Any]:
    """What is left of the laws for the block about its mass centre, from the joint's force and moment on it."""
    r, d = s.result, math.radians(direction)
    c, at, load = (r.point("block", n) for n in ("center", "C", "T"))
    push = np.outer(force, [math.cos(d), math.sin(d)])
    weight = 2 * 10 * np.array([math.sin(d), -math.cos(d)])
    left = 2 * r.point_acceleration("block", "center") - push - weight - r.reaction("S")

    def turn(arm: Any, f: Any) -> Any:
        return arm[:, 0] * f[:, 1] - arm[:, 1] * f[:, 0]

    moments = turn(load - c, push) + turn(at - c, r.reaction("S")) + r.reaction_moment("S")
    return left, 0.03 * r.acceleration("block") - moments


@pytest.mark.parametrize("mu", [0.0, 0.1])
@pytest.mark.parametrize("mode", ["pushes", "holds"])
def test_while_a_guide_bears_at_both_ends_it_is_as_if_it_were_held(mode: str, mu: float) -> None:
    """M = 0.2 m F + 0.4 N m + 0.1 m mu N about C, and N = 20 N: 0.1 N_ahead - 0.2 N_behind = M."""
    s = da.simulate(block("2", mode, mu), "0.2 s", count=3)
    r, moment = s.result, 0.4 + 0.4 + 0.1 * mu * 20
    assert r.reaction("S") == pytest.approx(np.array([[-mu * 20, 20.0]] * 3), abs=1e-12)
    assert r.reaction_moment("S") == pytest.approx([moment] * 3, rel=1e-12)
    assert s.position("S") == pytest.approx(s.time + (2 - 20 * mu) / 4 * s.time**2, abs=1e-12)
    ahead = (moment + 0.2 * 20) / 0.3
    ends = {"S.behind": [20 - ahead] * 3, "S.ahead": [ahead] * 3} if mode == "pushes" else {}
    assert {n: f.tolist() for n, f in s.normals.items()} == {n: pytest.approx(f) for n, f in ends.items()}


TIPS = {  # force over time: when and where it lifts off, and the arm of the end that is left
    "-400*time": (0.055, "front", -0.2),
    "200*time": (0.04, "rear", 0.1),
}


@crossed("force, place", TIPS, [(0.0, 0.0), (-50.0, 110.0)])
def test_a_block_that_tips_turns_about_the_end_that_is_left(force: str, place: tuple[float, float]) -> None:
    """Its normal force acts there, perpendicular to the guide, however far it has tipped."""
    direction, angle = place
    s = da.simulate(block(force, direction=direction, angle=angle), "0.17 s", count=9)
    when, end, reach = TIPS[force]
    (event, *more) = s.events
    assert event.time == pytest.approx(when, rel=1e-12)
    assert event.sentence == f"S lifts off at its {end} end"
    assert not [e for e in more if e.name != "reversal"]
    along = np.array([float(v) * t for v, t in ((force.split("*")[0], t) for t in s.time)])
    left, turned = newton_euler(s, along, direction)
    assert np.abs(left).max() < 1e-10
    assert np.abs(turned).max() < 1e-10
    tipped = s.time > when
    angle_of = s.result.angle("block")
    leant = angle_of - angle_of[0]
    assert np.abs(leant[-1]) > 0.05
    normal = s.normals["S.behind" if reach < 0 else "S.ahead"]
    assert s.result.reaction_moment("S")[tipped] == pytest.approx(
        (reach * np.cos(leant) * normal)[tipped], rel=1e-9
    )
    gaps = {"S.behind": -0.2, "S.ahead": 0.1}
    d = math.radians(direction)
    high = s.result.point("block", "C") @ np.array([-math.sin(d), math.cos(d)])
    for name, arm in gaps.items():
        assert s.gaps[name] == pytest.approx(high + arm * np.sin(leant), abs=1e-12)


def test_a_guide_with_friction_is_not_followed_on_one_end() -> None:
    """mu N = 2 N at the guide, 0.1 m below the centre: it tips a little later."""
    s = da.simulate(block("-400*time", mu=0.1), "0.08 s", count=5)
    assert s.status == "stopped"
    assert s.ended == (
        "stopped at 0.0575 s: S tips, and its guide has friction, which is not followed on one end; write two slots "
        "with contact: pushes and friction, one at each end"
    )
    assert s.time[-1] == pytest.approx(0.0575, rel=1e-9)
    assert s.result.reaction_moment("S") == pytest.approx(0.6 - 80 * s.time, abs=1e-9)


def test_a_ladder_that_does_not_reach_the_wall_cannot_begin() -> None:
    with pytest.raises(ModelError) as refused:
        da.simulate(da.loads(LADDER % 5.0), "1 s")
    assert str(refused.value) == (
        "text:10: the motion cannot begin: The linkage does not close at floor = 5 m: the points of joint wall remain "
        "1 m apart. Change a length or the assembly, or give floor another range.; start elsewhere"
    )


def test_the_force_of_a_corner_that_stands_is_watched() -> None:
    """A box of 2 kg lifted by 10 N/s: each of two corners has half of what is left of its weight."""
    lifted = box(0, 0.2, 0, 0) + "\nloads: {F: {type: force, on: box, at: G, value: [0, 10*time]}}"
    s = da.simulate(da.loads(lifted), "2.6 s", events=["normal.A = 5 N", "gap.C = 0.5 m"], count=3)
    met = s.event("condition")
    assert [e.sentence for e in met] == ["normal.A = 5 N", "gap.C = 0.5 m"]
    assert met[0].time == pytest.approx((2 * G - 10) / 10, rel=1e-9)
    off = 2 * G / 10
    assert met[1].time == pytest.approx(
        off + (0.1 * 6 * 2 / 10) ** (1 / 3), rel=1e-9
    )  # 0.1 m by 10 t^3/(6 m)
    assert [e.sentence for e in s.event("lift-off")] == ["A lifts off", "B lifts off"]
    assert [e.time for e in s.event("lift-off")] == pytest.approx([off, off], rel=1e-9)
