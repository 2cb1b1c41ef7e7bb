"""The drawing of a sketch as data for the front end: places in ground axes, m and rad."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from dalembert.arrays import Tree
from dalembert.model import GROUND, Mechanism
from dalembert.studio.editing.sketch_pose import SketchPose
from dalembert.units import KINDS, quantity

Place = tuple[float, float]
SHOWN = ("length", "angle", "force", "moment", "mass", "stiffness", "damping")


def drawing(m: Mechanism, sketch: SketchPose | None, written: Tree, hidden: str = "") -> Tree:
    """Links, joints, loads and drives where they are drawn; ``written``: the tree of the text, for the author's
    wording.

    ``hidden``: a link that is in no file.
    """
    placed: Mapping[str, tuple[float, float, float]] = sketch.placed if sketch else {}

    def place(link: str, u: Any) -> Place:
        x, y, angle = placed.get(link, (0.0, 0.0, 0.0))
        c, s = math.cos(angle), math.sin(angle)
        return x + c * u[0] - s * u[1], y + s * u[0] + c * u[1]

    return {
        "title": m.title,
        "units": {kind: {"unit": m.units.text(kind), "size": _size(m, kind)} for kind in SHOWN},
        "freedoms": sketch.freedoms if sketch else 0,
        "closed": sketch.closed if sketch else True,
        "links": [_link(m, name, placed, place, written) for name in m.links if name != hidden],
        "joints": [
            _joint(m, name, placed, place, sketch) | {"written": _of(written, "joints", name)}
            for name, joint in m.joints.items()
            if len(joint.links) == 2
        ],
        "loads": [load for name in m.loads if (load := _load(m, name, placed, place, written))],
        "drives": [
            {"name": name, "joint": m.drive_joint(name), "written": _of(written, "drives", name)}
            for name in m.drives
        ],
    }


def _size(m: Mechanism, kind: str) -> float:
    """SI value of one of the file's units; of those that are refused bare, of the SI unit."""
    return 1.0 if m.units.refuses_bare(kind) or not KINDS[kind].si else quantity(1.0, kind, m.units)


def _of(tree: Tree, section: str, name: str) -> object:
    return (tree.get(section) or {}).get(name)


def _link(m: Mechanism, name: str, placed: Any, place: Any, written: Tree) -> Tree:
    points = m.points(name)
    out: Tree = {
        "name": name,
        "points": {point: place(name, u) for point, u in points.items()},
        "pose": placed.get(name, (0.0, 0.0, 0.0)),
        "written": _of(written, "links", name),
    }
    if name != GROUND:
        u = list(points.values())
        out["bar"] = len(u) == 2 and u[0] == (0.0, 0.0)
        if m.mass(name):
            out["center"] = place(name, m.center(name))
    return out


def _joint(m: Mechanism, name: str, placed: Any, place: Any, sketch: SketchPose | None) -> Tree:
    joint: Any = m.joints[name]
    ends = m.joint_points(name)
    i, j = joint.links
    out: Tree = {
        "name": name,
        "type": joint.type,
        "links": [i, j],
        "at": list(joint.point_names(name)),
        "p": place(i, ends[0]),
        "q": place(j, ends[1]),
        "freedoms": list(joint.freedoms),
    }
    turn = placed.get(i, (0.0, 0.0, 0.0))[2]
    if hasattr(joint, "direction"):
        out["direction"] = turn + float(joint.direction)
    if getattr(joint, "radii", None):
        out["radii"] = [float(r) for r in joint.radii]
    if isinstance(getattr(joint, "radius", None), float):
        out["radius"] = joint.radius
    if sketch is not None:
        positions = sketch.drive_positions
        out["here"] = {
            freedom: positions[name, freedom] for freedom in joint.freedoms if (name, freedom) in positions
        }
    return out


def _load(m: Mechanism, name: str, placed: Any, place: Any, written: Tree) -> Tree | None:
    load = m.loads[name]
    out: Tree = {"name": name, "type": load.type, "written": _of(written, "loads", name)}
    if load.ON == "span":
        (a, u), (b, v) = m.load_points(name)
        return out | {"between": [place(a, u), place(b, v)], "links": [a, b]}
    if load.ON == "turn":
        ends = m.joint_points(load.joint)
        return out | {"p": place(m.joints[load.joint].links[0], ends[0]), "joint": load.joint}
    out["on"] = load.on
    at = getattr(load, "at", None)
    u = m.point(load.on, at) if isinstance(at, str) else at if isinstance(at, tuple) else m.center(load.on)
    out["p"] = place(load.on, u)
    if hasattr(load, "axes") and m.dimension == 2 and hasattr(load, "direction"):
        out["vector"] = _vector(load, placed.get(load.on, (0.0, 0.0, 0.0))[2])
    return out


def _vector(load: Any, turn: float) -> list[float] | None:
    """A constant force in ground axes; of others the direction alone, or nothing."""
    value, direction = load.value, load.direction
    angle = turn if load.axes == "link" else 0.0
    if isinstance(value, tuple) and all(isinstance(x, float) for x in value):
        x, y = value
    elif isinstance(direction, float):
        size = value if isinstance(value, float) else 1.0
        x, y = size * math.cos(direction), size * math.sin(direction)
    else:
        return None
    c, s = math.cos(angle), math.sin(angle)
    return [c * x - s * y, s * x + c * y]
