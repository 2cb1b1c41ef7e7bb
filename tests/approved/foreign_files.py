"""Files of other programs as the mechanisms that are read from them, a line for each part, and as they are written."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import dalembert as da
from dalembert.interchange.file_formats import foreign_bytes, read_foreign
from tests.approved.read_out import model

FILES = Path(__file__).parents[1] / "interchange" / "files"
FLOAT = re.compile(r"(?<![\w.])-?\d+(?:\.\d+(?:e[-+]?\d+)?|e[-+]?\d+)")
DIGITS, LEAST = 6, 1e-12
NAMES = (
    *(
        "arm_of_every_key.xml",
        "loops_of_every_kind.xml",
        "frames_of_every_kind.sdf",
        "robot_of_every_kind.urdf",
    ),
    *("multiple_constraints.xml", "actuator_slider_crank.xml", "equality_site.xml", "four_bar_weld.sdf"),
    *(
        "5bar_linkage.urdf",
        "4bar1.pmks",
        "four_bar_a.cmd",
        "four_bar_b.cmd",
        "pendulum.cmd",
        "slider_crank.json",
    ),
)
WHEELS = """
title: wheels
space: space
links:
  ground: {points: {A: [0, 0, 0], B: [0.3, 0, 0], C: [0, 0.1, 0]}}
  sun: {points: {A: [0, 0, 0]}, mass: 2, inertia: [0.02, 0.02, 0.03]}
  wheel: {points: {B: [0, 0, 0], P: [0, 0.1, 0]}, mass: 1, inertia: [0.01, 0.01, 0.02], center: [0.01, 0, 0]}
  ring: {points: {C: [0, 0, 0], P: [0, 0, 0.1]}, mass: 3, inertia: [0.04, 0.04, 0.05]}
joints:
  A: {type: revolute, links: [ground, sun], axis: [0, 0, 1], damping: {turn: 0.3 N*m*s/rad}}
  B: {type: revolute, links: [wheel, ground], at: B, axis: [0, 0, -1], damping: {turn: 0.2 N*m*s/rad}}
  C: {type: revolute, links: [ground, ring], axis: [0, 0, 1]}
  outer: {type: gear, links: [sun, wheel], at: [A, B], radii: [0.1, 0.2], axes: {i: {z: [0, 0, 1]}, j: {z: [0, 0, 1]}}}
  inner: {type: gear, links: [sun, ring], at: [A, C], radii: [0.2, 0.3], internal: true,
    axes: {i: {z: [0, 0, 1]}, j: {z: [0, 0, 1]}}}
drives:
  A: {position: 0.4 rad, speed: 2 rad/s, acceleration: 3 rad/s^2}
loads:
  wound: {type: torsion_spring, joint: B, stiffness: 4 N*m/rad, free_angle: 0.1 rad}
  elastic: {type: spring, between: [ground.C, wheel.P], stiffness: 50 N/m, free_length: 0.2 m}
  soft: {type: damper, between: [ring.P, wheel.P], damping: 6 N*s/m}
  pull: {type: force, on: wheel, at: P, value: [1, 2, 3]}
"""
SPACE = ".xml", ".sdf", ".urdf", ".asmt", ".cmd"
WRITTEN: dict[str, tuple[Callable[[], Any], tuple[str, ...]]] = {
    "pump": (lambda: model("pump"), (*SPACE, ".pmks", ".pylinkage.json")),
    "four_bar": (lambda: model("four_bar"), (".pmks", ".pylinkage.json")),
    "rssr": (lambda: model("rssr"), SPACE),
    "truss": (lambda: model("truss"), (".xml", ".sdf", ".urdf")),
    "double_cardan": (da.double_cardan, (".xml", ".sdf", ".urdf")),
    "wheels": (lambda: da.loads(WHEELS), (".xml", ".urdf")),
}
"""Mechanisms and the formats that they are written in."""


def rounded(text: str, least: float = LEAST) -> str:
    """Its numbers with six digits; rounding is 0.

    >>> rounded('"0.19999999999999998 m", -1e-17, 12.0, 3')
    '"0.2 m", 0, 12, 3'
    """
    return FLOAT.sub(lambda found: f"{x:.{DIGITS}g}" if abs(x := float(found[0])) > least else "0", text)


def lines(tree: Any) -> Iterator[str]:
    for key, value in tree.items():
        if isinstance(value, dict):
            yield f"{key}:"
            yield from (f"  {name}: {json.dumps(part)}" for name, part in value.items())
        else:
            yield f"{key}: {json.dumps(value)}"


def as_read(name: str) -> Callable[[], str]:
    def told() -> str:
        m, lost = read_foreign(FILES / name)
        return rounded("\n".join([*lines(m.to_tree()), "not kept:", *(f"  {note}" for note in lost)])) + "\n"

    return told


def as_written(name: str) -> Callable[[], str]:
    make, suffixes = WRITTEN[name]

    def told() -> str:
        out = []
        for suffix in suffixes:
            content, lost = foreign_bytes(make(), f"x{suffix}")
            out += [f"--- {suffix}", content.decode(), "not kept:", *(f"  {note}" for note in lost)]
        return rounded("\n".join(out)) + "\n"

    return told


FOREIGN = {
    **{f"read-{name}": as_read(name) for name in NAMES},
    **{f"written-{name}": as_written(name) for name in WRITTEN},
}
