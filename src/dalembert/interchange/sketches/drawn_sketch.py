"""A plane mechanism as a sketch: pins and sliders where they are at its first position."""

from __future__ import annotations

import math
from typing import Any

from dalembert.analysis.methods.applied_forces import known_actions
from dalembert.analysis.result.result import Result
from dalembert.analysis.solution import dynamics
from dalembert.errors import FORCED, ModelError
from dalembert.interchange.sketches.plane_sketch import PlaneSketch, SketchJoint, SketchMass
from dalembert.model import GROUND, Mechanism, Pin, Slider
from dalembert.model.load_types import ForceLoad


def sketch_of(m: Mechanism, program: str) -> PlaneSketch:
    """The sketch of a mechanism of pins, and of sliders on the ground; raises ModelError for what it cannot have."""
    if m.space != "plane":
        raise ModelError(
            f"{program} has plane linkages, and this mechanism is in space", "draw it in the plane"
        )
    r = dynamics(m)
    if r.status[0] not in FORCED:
        what = f"position 1 has no pose to write: {r.reasons[0] or r.status[0]}"
        raise ModelError(what, "give a range of drives that begins where the linkage closes")
    sketch = PlaneSketch(m.title)
    for name in m.joints:
        sketch.joints.append(_joint(m, r, name, program))
    for link in (name for name in m.links if name != GROUND):
        inertia: Any = m.inertia(link)
        center = r.point(link, "center")[0]
        sketch.masses[link] = SketchMass(
            m.mass(link), float(inertia or 0.0), float(center[0]), float(center[1])
        )
    for action in known_actions(r):
        if isinstance(m.loads.get(action.of), ForceLoad) and action.link != GROUND:
            (x, y), (fx, fy) = action.at[0], action.force[0]
            sketch.forces[action.of] = (action.link, float(x), float(y), float(fx), float(fy))
    _lose(sketch, m, r, program)
    return sketch


def _joint(m: Mechanism, r: Result, name: str, program: str) -> SketchJoint:
    joint = m.joints[name]
    i, j = joint.links
    is_slider = isinstance(joint, Slider) and GROUND in joint.links
    if not (is_slider or isinstance(joint, Pin)):
        what = f"joint {name!r}: {program} has pins and sliders on the ground, not a {joint.type} between {i} and {j}"
        raise ModelError(what, "leave it out, or replace it by links with pins", ("joints", name))
    sides = zip(joint.links, joint.point_names(name), strict=True)
    link, point = next((link, point) for link, point in sides if link != GROUND)
    x, y = (float(c) for c in r.point(link, point)[0])
    sketched = SketchJoint(name, x, y, [i, j] if j != GROUND else [j, i])
    if isinstance(joint, Slider):
        turn = 0.0 if i == GROUND else float(r.angle(i)[0])
        sketched.slides_along = turn + joint.direction
    drive = next((d for d in m.drives if m.drive_joint(d) == name), None)
    if drive is not None:
        speed = float(r.drive_speed(drive)[0])
        sketched.speed = -speed if j == GROUND else speed
    return sketched


def _lose(sketch: PlaneSketch, m: Mechanism, r: Result, program: str) -> None:
    """Note what a sketch does not have."""
    x, y = m.gravity_vector
    sketch.gravity = math.isclose(y, -9.80665, rel_tol=1e-3) and x == 0
    if (x or y) and not sketch.gravity:
        sketch.lost.append(f"gravity of {x:g}, {y:g} m/s2: {program} has the standard one, down, or none")
    kept = [name for name in m.loads if name not in sketch.forces]
    sketch.lost += [f"load {name!r} ({m.loads[name].type})" for name in kept]
    if len(r.status) > 1:
        sketch.lost.append(f"{len(r.status) - 1} of {len(r.status)} positions: the file has the first")
    if any(float(r.drive_acceleration(d)[0]) for d in m.drives):
        sketch.lost.append("accelerations of drives")
    if m.friction.enabled and any(getattr(joint, "friction", None) for joint in m.joints.values()):
        sketch.lost.append("dry friction")
    if m.answers:
        sketch.lost.append("published answers")


def sliding_blocks(sketch: PlaneSketch, program: str) -> dict[str, tuple[SketchJoint, SketchJoint]]:
    """Link that slides -> its pin and its slider, at one place; raises ModelError for others."""
    blocks = {}
    for link in sketch.masses:
        on = [joint for joint in sketch.joints if link in joint.links]
        sliders = [joint for joint in on if joint.slides_along is not None]
        if not sliders:
            continue
        if len(on) != 2 or len(sliders) != 1 or math.dist((on[0].x, on[0].y), (on[1].x, on[1].y)) > 1e-9:
            what = f"link {link!r}: a sliding link of {program} has one pin, at its slider"
            raise ModelError(what, "give it one pin at the point of its slider", ("links", link))
        blocks[link] = (next(joint for joint in on if joint is not sliders[0]), sliders[0])
    return blocks
