"""Friction in drawings of space as data: forces touch their circles, angles are those of friction, arrows add up."""

from __future__ import annotations

import math
from copy import deepcopy
from functools import cache
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.friction.bearing_ends import bearing_axis, bearing_ends, thread
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.scene import Arc, Circle
from dalembert.views.plane.guide_details import guide_detail
from dalembert.views.space.camera import CAMERAS
from dalembert.views.space.journal_details import along_axis, journal_detail
from dalembert.views.space.space_guides import slide_on_paper
from tests.methods.readable import text_over_lines, text_overlaps
from tests.oracles.space import rough_machines
from tests.space.test_friction import body

MACHINES = ("rssp", "press", *(pytest.param(name, marks=pytest.mark.long) for name in ("rssr", "rccc")))
JOURNALS = (("rssr", "O"), ("rssr", "F"), ("rccc", "A"), ("rccc", "B"), ("press", "R"))
GUIDES = (("rssp", "F"), ("rccc", "C"), ("rccc", "A"))


def check(scene: Any) -> None:
    """No text covers a line or a text, and every arrow that stands for a number is as long as its scale says."""
    assert text_overlaps(scene) == []
    assert text_over_lines(scene) == []
    for arrow in scene.arrows():
        if arrow.value is not None:
            scale = next(v for name, v in scene.scales.items() if name.endswith(arrow.kind))
            assert arrow.length * scale == pytest.approx(arrow.value, rel=1e-9)


@cache
def solved(name: str) -> Any:
    tree = deepcopy(rough_machines.machine(name)[0])
    tree["drives"]["O"]["position"] = {"from": 10, "to": 100, "count": 4}
    return da.dynamics(da.mechanism(tree))


@pytest.mark.parametrize("name", MACHINES)
def test_drawings_are_to_scale_and_texts_cover_nothing(name: str) -> None:
    r = solved(name)
    check(da.draw.mechanism(r, at=2, camera="front"))
    for link in r.links:
        check(da.draw.free_body(r, link, at=2))


@pytest.mark.parametrize(("name", "joint"), [*JOURNALS, *GUIDES])
def test_ends_of_a_bearing_make_up_its_reaction(name: str, joint: str) -> None:
    r = solved(name)
    axis = bearing_axis(r, joint)
    ends = bearing_ends(r, joint, "pin" if (name, joint) in JOURNALS else "guide")
    sums = [(r.reaction(joint), sum(end.force for end in ends))]
    if len(ends) > 1:
        sums.append((r.reaction_moment(joint), sum(np.cross(end.along * axis, end.force) for end in ends)))
    for whole, found in sums:
        across = whole - np.sum(whole * axis, -1, keepdims=True) * axis
        assert found == pytest.approx(across, abs=1e-10 * np.max(np.abs(whole)))


@pytest.mark.parametrize(("name", "joint"), JOURNALS)
@pytest.mark.parametrize("k", [0, pytest.param(2, marks=pytest.mark.long)])
def test_forces_touch_the_circle_against_the_turn(name: str, joint: str, k: int) -> None:
    """Each arrow passes the middle at the circle's radius, turning against the curved arrow; radii are to scale."""
    r = solved(name)
    for on in r.mechanism.joints[joint].links:
        scene = journal_detail(r, joint, k, Shown(r, Notation()), on)
        check(scene)
        (circle,) = (c for c in scene.flat() if isinstance(c, Circle) and c.role == "friction-circle")
        (turn,) = (c for c in scene.flat() if isinstance(c, Arc))
        ends = bearing_ends(r, joint, "pin")
        some = [a for a in scene.arrows() if a.role == "joint-force"]
        assert len(some) == len(ends)
        for arrow, end in zip(some, ends, strict=True):
            e = np.subtract(arrow.head, arrow.tail) / arrow.length
            moment = arrow.head[0] * e[1] - arrow.head[1] * e[0]
            assert abs(moment) == pytest.approx(circle.radius, rel=1e-9)
            assert np.sign(moment) == -np.sign(turn.end - turn.start)
            size = abs(end.friction[k]) / np.linalg.norm(end.force[k])
            assert circle.radius * scene.scales[f"length at {joint}"] == pytest.approx(size, rel=1e-9)
            sign = 1.0 if on == r.mechanism.joints[joint].links[1] else -1.0
            seen = sign * along_axis(bearing_axis(r, joint)[k])(end.force[k])
            assert e == pytest.approx(seen / np.hypot(*seen), abs=1e-9)
    f = r.mechanism.joints[joint].friction
    if r.mechanism.joints[joint].type == "revolute":
        mu = f.coefficient or 0.1
        assert size == pytest.approx(f.radius * (mu if f.circle == "tan" else math.sin(math.atan(mu))))


@pytest.mark.parametrize(("name", "joint"), GUIDES)
def test_a_guide_shows_the_angle_of_friction_at_each_end(name: str, joint: str) -> None:
    """Normal force and friction at a right angle; friction against the arrow of the slide, together what it is."""
    r, k = solved(name), 1
    on = r.mechanism.joints[joint].links[1]
    scene = guide_detail(r, joint, k, Shown(r, Notation()), on)
    check(scene)
    slide = next(a for a in scene.arrows() if a.role == "velocity")
    parts = {role: [a for a in scene.arrows() if a.role == role] for role in ("effort", "friction")}
    per_mm = scene.scales[f"force at {joint}"]
    total = 0.0
    for end, normal, rub in zip(bearing_ends(r, joint, "guide"), *parts.values(), strict=True):
        assert normal.length * per_mm == pytest.approx(np.linalg.norm(end.force[k]))
        across = np.subtract(normal.head, normal.tail) @ np.subtract(rub.head, rub.tail)
        assert across == pytest.approx(0.0, abs=1e-9)
        assert (rub.head[0] - rub.tail[0]) * (slide.head[0] - slide.tail[0]) < 0
        total += (rub.head[0] - rub.tail[0]) * per_mm
    assert total == pytest.approx(r.friction_force(joint)[k] @ bearing_axis(r, joint)[k])


def test_a_thread_unrolled_carries_the_force_along_the_axis_and_the_couple_about_it() -> None:
    """Down the thread and up again: its normal force and friction are the screw's axial force and torque."""
    r = solved("press")
    axis, found, radius = r.joint_axes("H")[:, 0], thread(r, "H"), 0.022
    along, around = (np.sum(v * axis, -1) for v in (r.reaction("H"), r.reaction_moment("H") / radius))
    assert found.climb == pytest.approx(math.atan(-0.04 / (2 * math.pi * radius)))
    across = np.array([-math.sin(found.climb), math.cos(found.climb)])
    for k in range(len(along)):
        e = slide_on_paper(r, "H", k)
        assert np.array([around[k], along[k]]) == pytest.approx(
            found.normal[k] * across + found.friction[k] * e
        )
    scene = guide_detail(r, "H", 1, Shown(r, Notation()), "spindle")
    check(scene)
    angle = math.atan2(abs(found.friction[1]), abs(found.normal[1]))
    assert f"φ = {Notation().degrees(angle)}°" in [t.text for t in scene.texts()]
    slide, rub = (next(a for a in scene.arrows() if a.role == role) for role in ("velocity", "friction"))
    assert np.subtract(slide.head, slide.tail) @ np.subtract(rub.head, rub.tail) < 0


@pytest.mark.parametrize("name", MACHINES)
def test_arrows_of_friction_and_of_the_rest_make_up_the_reaction(name: str) -> None:
    """What is longer than 0.6 mm as it is seen; friction at a guide points against the arrow of its slide."""
    r, k, camera = solved(name), 1, CAMERAS["isometric"]
    for link in r.links:
        scene = da.draw.free_body(r, link, at=k + 1)
        for joint in (n for n in r.joints if link in r.mechanism.joints[n].links):
            rub = (r.friction_force(joint, link)[k], r.friction_moment(joint, link)[k])
            for kind, v in zip(("force-seen", "moment-seen"), rub, strict=True):
                some = [a for a in scene.arrows() if (a.of, a.kind, a.role) == (joint, kind, "friction")]
                seen = camera(v) / scene.scales.get(kind, math.inf)
                assert bool(some) == (np.hypot(*seen) >= 0.6)
                for a in some:
                    assert np.subtract(a.head, a.tail) == pytest.approx(seen, abs=1e-9)
            slides = [a for a in scene.arrows() if (a.of, a.role, a.kind) == (joint, "velocity", "direction")]
            if slides and rub[0].any():
                assert np.subtract(slides[0].head, slides[0].tail) @ camera(rub[0]) < 0


def test_the_table_has_friction_s_part_below_the_reaction() -> None:
    r = solved("press")
    texts = [t.text for t in da.draw.free_body(r, "spindle", at=2).texts()]
    row = texts.index("friction", texts.index("H", texts.index("F_{x'}")))
    force, moment = r.friction_force("H", "spindle")[1], r.friction_moment("H", "spindle")[1]
    x = r.joint_axes("H")[1][0]
    shown = [float(texts[row + n].replace("−", "-")) for n in (1, 4)]
    assert shown == pytest.approx([force @ x, moment @ x], rel=1e-3)
    assert [texts[row + n] for n in (2, 3, 5, 6)] == ["–"] * 4


def test_at_rest_both_ends_are_drawn() -> None:
    tree = deepcopy(rough_machines.machine("rssp")[0])
    tree["drives"]["O"] = {"position": 40}
    r = da.statics(da.mechanism(tree))
    for scene in (da.draw.mechanism(r), da.draw.free_body(r, "follower")):
        assert text_overlaps(scene) == text_over_lines(scene) == []
        texts = [t.text for t in scene.texts()]
        assert sum(t.startswith(("Low end of O, ", "High end of O, ")) for t in texts) == 2


@pytest.mark.parametrize(("speed", "along"), [("1 m/s", "−16.00"), ("-1 m/s", "16.00")])
def test_the_table_of_a_body_has_friction_alone_in_its_own_row(speed: str, along: str) -> None:
    """A guide of two ends 50 mm off with 10 N across and 4 N·m: 35 N and 45 N bear, a fifth of both rubs, against the
    slide; what friction has no part in has a dash, and what the guide could carry and does not a 0."""
    guide = {"type": "prismatic", "axis": [1, 0, 0], "friction": {"coefficient": 0.2, "guide": [0.05, 0.05]}}
    r = body(guide, [0, 10, 0], [0, 0, 4], P={"position": 0, "speed": speed})
    texts = [t.text for t in da.draw.free_body(r, "body", at=1).texts()]
    head = texts.index("F_{x'}")
    assert texts[head : head + 6] == [f"{of}_{{{axis}'}}" for of in "FM" for axis in "xyz"]
    assert texts[head + 6 : head + 12] == ["N"] * 3 + ["N·m"] * 3
    assert texts[head + 12 : head + 19] == ["P", along, "−10.00", "0", "0", "0", "−4.000"]
    assert texts[head + 19 : head + 26] == ["friction", along, "–", "–", "–", "–", "–"]
