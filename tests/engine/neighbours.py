"""Descriptions that differ from one in a single element: what a program kept for one may not answer for the other."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from copy import deepcopy
from typing import Any

Tree = dict[str, Any]
Change = tuple[str, Callable[[Tree], None]]

AS_ONE = {
    "spring": ("damper", {"stiffness": "damping"}),
    "damper": ("spring", {"damping": "stiffness"}),
    "constant_force_spring": ("damper", {"force": "damping"}),
    "torsion_spring": ("torsion_damper", {"stiffness": "damping"}),
    "torsion_damper": ("torsion_spring", {"damping": "stiffness"}),
}
"""Loads that the same numbers stand for."""

BESIDE = {
    "pin": "slider",
    "slider": "pin",
    "slot": "circular_slot",
    "gear": "rolling",
    "rolling": "gear",
    "revolute": "prismatic",
    "prismatic": "revolute",
    "cylindrical": "screw",
    "screw": "cylindrical",
    "spherical": "plane",
}
"""Joints that take as many freedoms."""


def neighbours(tree: Tree) -> Iterator[tuple[str, Tree]]:
    """Every description with one element changed: its name, and itself."""
    for name, change in changes(tree):
        other = deepcopy(tree)
        change(other)
        yield name, other


def changes(tree: Tree) -> Iterator[Change]:
    """Each numbers part, then what is counted or named."""
    for name in tree["joints"]:
        yield from of_joint(tree, name)
    for name in tree.get("loads", {}):
        yield from of_load(tree, name)
    for name in tree["links"]:
        yield from of_link(tree, name)
    for name in tree["drives"]:
        yield from of_drive(tree, name)
    yield from of_gravity(tree)
    for name, near in tree.get("assembly", {}).items():
        if isinstance(near, int | float):
            yield f"assembly {name} mirrored", at("assembly", name, value=-near)


def at(*path: Any, value: Any) -> Callable[[Tree], None]:
    """Puts a value at a path; takes the key out where it is None."""

    def change(tree: Tree) -> None:
        for key in path[:-1]:
            tree = tree[key]
        if value is None:
            del tree[path[-1]]
        else:
            tree[path[-1]] = value

    return change


def both(*parts: Callable[[Tree], None]) -> Callable[[Tree], None]:
    def change(tree: Tree) -> None:
        for part in parts:
            part(tree)

    return change


def point_of(tree: Tree, link: str, point: str, other: str) -> Callable[[Tree], None]:
    """The same coordinates as a point of another link, under a new name."""
    return at("links", other, "points", "moved", value=tree["links"][link]["points"][point])


def of_joint(tree: Tree, name: str) -> Iterator[Change]:
    joint = tree["joints"][name]
    i, j = joint["links"]
    ends = joint["at"] if isinstance(joint.get("at"), list) else [joint.get("at", name)] * 2
    path = ("joints", name)
    exchanged = both(at(*path, "links", value=[j, i]), at(*path, "at", value=ends[::-1]))
    yield f"{name} exchanged", exchanged
    for end, link in enumerate((i, j)):
        for other in [k for k in tree["links"] if k not in (i, j)][:2]:
            links, points = [i, j], list(ends)
            links[end], points[end] = other, "moved"
            there = both(at(*path, "links", value=links), at(*path, "at", value=points))
            yield f"{name} on {other} for {link}", both(point_of(tree, link, ends[end], other), there)
    for axis in [joint["axis"]] if isinstance(joint.get("axis"), list) else []:
        for k in range(3):
            yield f"{name} along {k}", at(*path, "axis", value=[float(x == k) for x in range(3)])
        yield f"{name} against", at(*path, "axis", value=[-x for x in axis])
    for key in ("direction", "angle"):
        if isinstance(joint.get(key), float):
            for value in (0, 90, 180, 37.3):
                yield f"{name} {key} {value}", at(*path, key, value=value)
    for key in ("pressure_angle", "damping", "stiffness"):
        if key in joint:
            yield f"{name} without {key}", at(*path, key, value=None)
            yield f"{name} {key} 0", at(*path, key, value=0)
    if "radii" in joint:
        a, b = joint["radii"]
        yield f"{name} equal wheels", at(*path, "radii", value=[(a + b) / 2] * 2)
        turned = (a - 2 * b, False) if joint["internal"] else (a + 2 * b, True)  # the centres as far apart
        change = both(at(*path, "radii", value=[turned[0], b]), at(*path, "internal", value=turned[1]))
        yield f"{name} internal {turned[1]}", change
    if joint["type"] in BESIDE:
        yield f"{name} {BESIDE[joint['type']]}", at(*path, "type", value=BESIDE[joint["type"]])
    friction = joint.get("friction", {})
    for key in friction:
        yield f"{name} without {key}", at(*path, "friction", key, value=None)
    if "coefficient" in friction:
        yield f"{name} smooth", at(*path, "friction", "coefficient", value=0)
    if "radius" in friction:
        circle = "sin" if friction.get("circle") == "tan" else "tan"
        yield f"{name} circle {circle}", at(*path, "friction", "circle", value=circle)


def of_load(tree: Tree, name: str) -> Iterator[Change]:
    load, path = tree["loads"][name], ("loads", name)
    yield f"without {name}", at(*path, value=None)
    if load["type"] in AS_ONE:
        kind, keys = AS_ONE[load["type"]]
        kept = {k: v for k, v in load.items() if k not in ("free_length", "free_angle")}
        yield f"{name} {kind}", at(*path, value={keys.get(k, k): v for k, v in kept.items()} | {"type": kind})
        for key, unit in (("free_length", "m"), ("free_angle", "rad")):
            for number in (0, 1, -1) if key in load else ():
                yield f"{name} {key} {number}", at(*path, key, value=f"{number} {unit}")
    if "between" in load:
        a, b = load["between"]
        yield f"{name} exchanged", at(*path, "between", value=[b, a])
        link, point = a.split(".")
        for other in [k for k in tree["links"] if k not in (link, b.split(".")[0])][:2]:
            there = at(*path, "between", value=[f"{other}.moved", b])
            yield f"{name} on {other}", both(point_of(tree, link, point, other), there)
    if "joint" in load:
        same = [k for k, j in tree["joints"].items() if j["type"] == tree["joints"][load["joint"]]["type"]]
        for other in [k for k in same if k != load["joint"]][:2]:
            yield f"{name} at {other}", at(*path, "joint", value=other)
    if "on" in load:
        for other in [k for k in tree["links"] if k not in (load["on"], "ground")][:2]:
            there = at(*path, "on", value=other)
            if "at" in load:
                there = both(
                    point_of(tree, load["on"], load["at"], other), there, at(*path, "at", value="moved")
                )
            yield f"{name} on {other}", there
        value = load["value"]
        if "axes" in load:
            axes = "link" if load["axes"] == "ground" else "ground"
            yield f"{name} {axes}", at(*path, "axes", value=axes)
        if isinstance(value, list):
            yield f"{name} other way", at(*path, "value", value=value[::-1])
            yield f"{name} equal", at(*path, "value", value=[value[0]] * len(value))
            for k in range(len(value)):
                for number in (0, 1, -1):
                    yield f"{name} {k} {number}", at(*path, "value", k, value=number)
        else:
            drive = next(iter(tree["drives"]))
            yield f"{name} unit", at(*path, "value", value=1)
            yield f"{name} changing", at(*path, "value", value=f"{value} + 0.7*{drive}_speed")
            law = f"{value}*(1 + 0.3*sin(3*{drive}))"
            yield f"{name} by a law", at(*path, "value", value=law)
            yield f"{name} asked", both(at(*path, "value", value="unknown"), known_effort(drive))
    if "direction" in load and "value" in load:
        yield f"{name} turned", at(*path, "direction", value=90)


def known_effort(drive: str) -> Callable[[Tree], None]:
    return at("drives", drive, "effort", value=0.83)


def of_link(tree: Tree, name: str) -> Iterator[Change]:
    link, path = tree["links"][name], ("links", name)
    if "mass" in link:
        yield f"{name} without mass", both(at(*path, "mass", value=0), at(*path, "inertia", value=0))
        yield f"{name} unit", at(*path, "mass", value=1)
        other = next((k for k, x in tree["links"].items() if k != name and "mass" in x), None)
        if other:
            yield f"{name} as heavy as {other}", at(*path, "mass", value=tree["links"][other]["mass"])
        middle = link.get("center")
        if isinstance(middle, list):
            yield f"{name} center at origin", at(*path, "center", value=[0] * len(middle))
            yield f"{name} center even", at(*path, "center", value=[middle[0]] * len(middle))
    for point, value in list(link["points"].items())[:2]:
        if isinstance(value, list):
            for k in range(len(value)):
                yield f"{name}.{point} {k} 0", at(*path, "points", point, k, value=0)
            yield f"{name}.{point} even", at(*path, "points", point, value=[value[0]] * len(value))


def of_drive(tree: Tree, name: str) -> Iterator[Change]:
    path = ("drives", name)
    for key in ("speed", "acceleration"):
        yield f"{name} {key} 0", at(*path, key, value=0)
    places = tree["drives"][name]["position"]
    if isinstance(places, list):
        yield f"{name} once", at(*path, "position", value=places[:1])
        yield f"{name} at 0 first", at(*path, "position", value=[0, *places[1:]])
    joint = tree["drives"][name].get("joint", name)
    for other in [k for k, j in tree["joints"].items() if k != joint and j["type"] == "pin"][:3]:
        yield f"{name} at {other}", at(*path, "joint", value=other)


def of_gravity(tree: Tree) -> Iterator[Change]:
    g = tree.get("gravity")
    if isinstance(g, list):
        for k in range(len(g)):
            for number in (0, 1, -1):
                yield f"gravity {k} {number}", at("gravity", k, value=number)
        yield "gravity turned", at("gravity", value=g[::-1])
        yield "gravity up", at("gravity", value=[-x for x in g])
        yield "no gravity", at("gravity", value="none")
