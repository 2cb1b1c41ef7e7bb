"""pylinkage's mechanism files (`mechanism_to_dict`): joints with positions, links with joints; no masses."""

from __future__ import annotations

import json
import math
from typing import Any

from dalembert.errors import ModelError
from dalembert.interchange.link_graph import plain_name
from dalembert.interchange.sketches.plane_sketch import PlaneSketch, SketchJoint
from dalembert.model import GROUND


def read_pylinkage(content: bytes, file: str) -> PlaneSketch:
    """The linkage of a pylinkage file; raises ModelError for any other file."""
    try:
        tree = json.loads(content)
        joints, links = tree["joints"], tree["links"]
        places = {str(j["id"]): (float(j["position"][0]), float(j["position"][1])) for j in joints}
        members: dict[str, list[str]] = {}
        for link in links:
            name = GROUND if link["type"] == "ground" else plain_name(str(link["id"]), members)
            for joint in link["joints"]:
                places[str(joint)]
                members.setdefault(name, []).append(str(joint))
    except (ValueError, RecursionError, KeyError, TypeError, IndexError) as error:
        what = f"this is not a file of pylinkage's mechanism_to_dict: {error}"
        raise ModelError(
            what, "give joints with id and position, links with id and joints", (), file, 1
        ) from None
    if not all(abs(x) < 1e60 for place in places.values() for x in place):
        raise ModelError("a position is not finite", "write finite numbers", (), file, 1)
    sketch = PlaneSketch(str(tree.get("name", "")))
    sketch.lost.append("lengths have no unit in the file: taken as metres")
    names: dict[str, str] = {}
    for joint in joints:
        names[str(joint["id"])] = plain_name(str(joint["id"]), dict.fromkeys(names.values()))
    for joint in joints:
        key = str(joint["id"])
        on = [link for link, those in members.items() if key in those]
        if joint["type"] == "ground" and GROUND not in on:
            on.insert(0, GROUND)
        on.sort(key=lambda link: link != GROUND)
        sketch.joints += _joints(joint, names[key], *places[key], on)
    for link in links:
        if link["type"] == "driver":
            _drive(sketch, link, names)
    return sketch


def _joints(joint: dict[str, Any], name: str, x: float, y: float, on: list[str]) -> list[SketchJoint]:
    """A pin; a slider is a block with a pin and a slide on the ground."""
    if joint["type"] != "prismatic":
        return [SketchJoint(name, x, y, on)]
    axis = joint.get("axis", [1.0, 0.0])
    block, angle = f"{name} block", math.atan2(float(axis[1]), float(axis[0]))
    return [SketchJoint(name, x, y, [*on, block]), SketchJoint(f"{name} slide", x, y, [GROUND, block], angle)]


def _drive(sketch: PlaneSketch, link: dict[str, Any], names: dict[str, str]) -> None:
    motor = names.get(str(link.get("motor_joint")), "")
    for joint in sketch.joints:
        if joint.name == motor:
            joint.speed = 0.0
    speed = link.get("angular_velocity")
    if speed:
        sketch.lost.append(
            f"{speed:g} rad a step of driver {link['id']!r}: a step has no time, so the drive has no speed"
        )
