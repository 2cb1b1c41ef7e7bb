"""pylinkage's mechanism files (`mechanism_from_dict`) from a plane mechanism of pins and sliders on the ground."""

from __future__ import annotations

import json
import math

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.interchange.sketches.drawn_sketch import sketch_of, sliding_blocks
from dalembert.interchange.sketches.plane_sketch import PlaneSketch, SketchJoint
from dalembert.model import GROUND, Mechanism

STEP = 2 * math.pi / 100
"""Turn of the driver in a step."""


def write_pylinkage(m: Mechanism) -> tuple[str, list[str]]:
    """The text of a file, and what of the mechanism is not in it."""
    sketch = sketch_of(m, "pylinkage")
    blocks = sliding_blocks(sketch, "pylinkage")
    crank, motor, sense = _driver(sketch)
    slides = {pin.name: slider for pin, slider in blocks.values()}
    joints = [_joint(j, slides.get(j.name)) for j in sketch.joints if j.slides_along is None]
    links: list[Tree] = []
    for link, on in sketch.links().items():
        if link in blocks:
            continue
        names = [joint.name for joint in on if joint.slides_along is None]
        tree: Tree = {"id": link, "type": "ground" if link == GROUND else "link", "joints": names}
        if link == crank:
            tip = next((j for j in on if math.hypot(j.x - motor.x, j.y - motor.y) > 0), motor)
            angle = math.atan2(tip.y - motor.y, tip.x - motor.x)
            tree |= {"type": "driver", "angular_velocity": sense * STEP, "initial_angle": angle}
            tree["motor_joint"] = motor.name
        links.append(tree)
    sketch.lost.append(
        "masses, gravity and speeds: pylinkage has geometry, and a driver with an angle a step"
    )
    sketch.lost += [f"load {name!r} (force)" for name in sketch.forces]
    whole = {"name": sketch.title, "joints": joints, "links": links, "ground": GROUND}
    return json.dumps(whole, indent=1, ensure_ascii=False) + "\n", sketch.lost


def _driver(sketch: PlaneSketch) -> tuple[str, SketchJoint, float]:
    """The crank, its pin on the ground and its sense of turning."""
    driven = [joint for joint in sketch.joints if joint.speed is not None]
    fits = [j for j in driven if j.slides_along is None and GROUND in j.links]
    if not fits:
        raise ModelError("the driver of pylinkage turns a crank on the ground", "drive a pin on the ground")
    if len(driven) > 1:
        sketch.lost.append("all drives but one: pylinkage has one driver")
    crank = next(link for link in fits[0].links if link != GROUND)
    return crank, fits[0], math.copysign(1.0, fits[0].speed or 1.0)


def _joint(joint: SketchJoint, slider: SketchJoint | None) -> Tree:
    tree: Tree = {"id": joint.name, "type": "revolute", "position": [joint.x, joint.y]}
    if GROUND in joint.links:
        tree["type"] = "ground"
    if slider is not None and slider.slides_along is not None:
        axis = [math.cos(slider.slides_along), math.sin(slider.slides_along)]
        tree |= {"type": "prismatic", "axis": axis, "line_point": [joint.x, joint.y], "slide_distance": 0.0}
    return tree
