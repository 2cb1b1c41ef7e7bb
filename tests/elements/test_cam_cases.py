"""Visible cases of cams: to 1e-8 of the exact value, to the source's rounding."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da

CASES: dict[str, dict[str, Any]] = {
    c["id"]: c for c in json.loads(Path(__file__).with_name("cam_cases.json").read_text(encoding="utf-8"))
}
ROOT = 1e-6
"""Accuracy of the place of a greatest value, the root of that of the value."""


def rises_in_harmonic_motion(file: str) -> Iterator[float]:
    """With positions at which the peaks are: a full turn of 1441 positions has none there."""
    r = da.dynamics(da.loads(file.replace("count: 1441", "count: 1440")))
    speed, at = r.freedom("guide", "slide")[1], r.schedule.position[:, 0]
    acceleration = np.max([np.abs(side.freedom("guide", "slide")[2]) for side in r.sides], axis=0)
    yield speed.max()
    yield -speed.min()
    yield acceleration[at < math.radians(89.9)].max()
    yield acceleration[(at > math.radians(119.9)) & (at < math.pi)].max()


def tangent_cam(file: str) -> Iterator[float]:
    m = da.loads(file)
    c, speed = da.cam(m, "F"), 600 * math.pi / 30
    join = float(c.joins[0])
    yield c.nose_distance * 1e3
    yield c.nose_radius * 1e3
    yield math.degrees(join)
    yield c.lift(0.0)[2] * speed**2
    yield c.lift(join, before=True)[2] * speed**2
    yield -c.lift(join)[2] * speed**2
    yield -c.lift(math.radians(75))[2] * speed**2
    yield c.lift(join)[0] * 1e3


def offset_roller(file: str) -> Iterator[float]:
    m = da.loads(file)
    r, c, at = da.dynamics(m), da.cam(m, "F"), math.radians(30)
    yield math.degrees(r.contact("F").pressure_angle[30])
    yield math.degrees(c.pressure_angle_peak)
    yield math.degrees(c.pressure_angle_peak_at)
    yield from c.profile(at) * 1e3
    yield c.pitch_radius(at) * 1e3
    yield c.least_convex_radius * 1e3
    yield c.largest_roller * 1e3
    centred = m.with_values({"links.ground.points.E": [0, 0]})
    yield math.degrees(da.cam(centred, "F").pressure_angle_peak)


def flat_follower(file: str) -> Iterator[float]:
    m = da.loads(file)
    r, c = da.dynamics(m), da.cam(m, "F")
    yield c.least_base * 1e3
    yield math.degrees(c.least_base_at)
    yield r.contact("F").force[0]
    yield r.contact("F").place[0] * 1e3
    yield r.effort("O")[0]
    yield c.face_half_width * 1e3


def steel_on_steel(_: str) -> Iterator[float]:
    x = da.hertz_line(force=1800, width=0.016, radii=(0.045, 0.012), elasticity=206e9, poisson=0.3)
    yield x.half_width * 1e6
    yield x.pressure / 1e6


def sliding(follower: Any, profile: dict[str, Any], **more: Any) -> dict[str, Any]:
    """A cam under a follower that slides upwards."""
    links = {"ground": {"points": {"O": [0, 0], "top": [0, 1]}}, "cam": {"points": {"O": [0, 0]}}}
    cam = {
        "type": "cam",
        "links": ["cam", "stem"],
        "at": ["O", "F"],
        "follower": follower,
        "profile": profile,
    }
    joints = {
        "O": {"type": "pin", "links": ["ground", "cam"]},
        "guide": {"type": "slider", "links": ["ground", "stem"], "at": ["O", "F"], "direction": 90},
        "F": cam,
    }
    stem = {"points": {"F": [0, 0]}, **more.pop("stem", {})}
    return {"links": {**links, "stem": stem}, "joints": joints, "drives": {"O": more.pop("drive")}, **more}


def circular_arcs(_: str) -> Iterator[float]:
    """A flat follower on a base circle, two flanks and a nose; the flank begins at the cam's x axis."""
    base, lift, nose, half = 1.125, 0.5, 0.125, math.radians(55)
    far = base + lift - nose  # of the nose's centre
    op = ((base - nose) ** 2 - far**2) / (2 * far * math.cos(half) - 2 * (base - nose))
    center = [far * math.cos(half), far * math.sin(half)]
    way = math.atan2(center[1], center[0] + op)
    join = [(op + base) * math.cos(way) - op, (op + base) * math.sin(way)]
    angle = math.atan2(join[1], join[0])
    ends = (0.0, angle, 2 * half - angle, 2 * half)
    other = [-op * math.cos(2 * half), -op * math.sin(2 * half)]
    parts = (([0, 0], base), ([-op, 0], op + base), (center, nose), (other, op + base))
    arcs = [
        {"center": c, "radius": r, "to": f"{math.degrees(to)!r} deg"}
        for (c, r), to in zip(parts, ends, strict=True)
    ]
    drive = {"position": 0, "speed": "1200 rpm"}
    m = da.mechanism(sliding("flat", {"arcs": arcs}, drive=drive) | {"units": {"length": "in"}})
    c, w = da.cam(m, "F"), 1200 * math.pi / 30
    turns = (math.pi / 2 - np.array([0.0, way])) % (2 * math.pi)  # of the normals, from the follower's
    assert np.sort(c.joins)[np.searchsorted(np.sort(c.joins), turns - 1e-9)] == pytest.approx(
        turns, abs=1e-12
    )
    yield c.lift(turns[0], before=True)[2] / 0.0254
    yield far * w / 12
    yield -c.lift((math.pi / 2 - half) % (2 * math.pi))[2] * w**2 / 0.3048
    yield c.lift(turns[0], before=True)[2] * w**2 / 0.3048
    yield math.degrees(turns[0] - turns[1])


def harmonic_valve(_: str) -> Iterator[float]:
    segments = [
        {"to": 0.05, "in": "120 deg", "by": "harmonic"},
        {"dwell": "60 deg"},
        {"to": 0, "in": "60 deg", "by": "harmonic"},
        {"dwell": "rest"},
    ]
    drive = {"position": 0, "speed": "100 rpm"}
    profile = {"prime": "55 mm", "segments": segments}
    c, w = da.cam(da.mechanism(sliding({"roller": "10 mm"}, profile, drive=drive)), "F"), 100 * math.pi / 30
    yield c.lift(math.radians(60))[1] * w
    yield -c.lift(math.radians(210))[1] * w
    yield c.lift(0.0)[2] * w**2
    yield -c.lift(math.radians(180))[2] * w**2


def jump_speed(_: str) -> Iterator[float]:
    drive = {"position": [f"{x} deg" for x in range(0, 360, 10)], "speed": "100 rad/s"}
    profile = {"eccentric": "12 mm", "radius": "40 mm"}
    free = 1 - (0.04 - 0.012) + 60 / 8000  # shortened by the preload where the follower is lowest
    spring = {"type": "spring", "between": ["ground.top", "stem.F"], "stiffness": 8000, "free_length": free}
    m = da.mechanism(sliding("flat", profile, drive=drive, stem={"mass": 1.2}, loads={"S": spring}))
    contact = da.dynamics(m).contact("F")
    yield contact.lift_speed
    yield contact.force[9]
    yield contact.force[27]


def overhung_guide(file: str) -> Iterator[float]:
    """The force; the angle and the coefficient at which it jams are between two that are told apart.

    The stem's x axis is along its guide: its top is at [150, 0], not at [0, 150] as the case has it.
    """
    m = da.loads(file.replace("top: [0, 150]", "top: [150, 0]"))
    yield da.dynamics(m).contact("F").force[0]
    exact = [q["exact"] for q in CASES["CAM-17"]["quantities"]]
    ways = (("joints.F.direction", -math.pi / 180), ("joints.guide.friction.coefficient", 1.0))
    for (path, unit), limit in zip(ways, exact[1:], strict=True):
        below, above = (da.dynamics(m.with_values({path: unit * limit * (1 + x)})) for x in (-1e-8, 1e-8))
        assert (below.status[0], above.status[0]) == ("ok", "jammed")
        yield limit


READ: dict[str, Callable[[str], Iterator[float]]] = {
    "CAM-1": circular_arcs,
    "CAM-2": harmonic_valve,
    "CAM-4": jump_speed,
    "CAM-11": rises_in_harmonic_motion,
    "CAM-12": tangent_cam,
    "CAM-13": offset_roller,
    "CAM-15": flat_follower,
    "CAM-17": overhung_guide,
    "CAM-19": steel_on_steel,
}


@pytest.mark.parametrize("case", READ)
def test_case(case: str) -> None:
    quantities = CASES[case]["quantities"]
    computed = list(READ[case](CASES[case].get("file", "")))
    assert len(computed) == len(quantities)
    for value, q in zip(computed, quantities, strict=True):
        close = ROOT if q["name"] == "at" else 1e-8
        assert float(value) == pytest.approx(q["exact"], rel=close), q["name"]
        if "printed" in q:
            assert float(value) == pytest.approx(q["printed"], rel=q["tolerance"]), q["name"]
