"""Closed spatial mechanisms with friction in all joints that have any: RSSR, RSSP, RCCC, a screw press, two rods.

Numbers are meant to bring out every law: both ends of a bearing on one side and on opposite ones, screws that rise and
sink, slips along and around. Links' axes lie askew.
"""

from __future__ import annotations

from copy import deepcopy
from functools import cache
from typing import Any

import numpy as np

from tests.oracles.reading import Array, Tree
from tests.oracles.space import natural
from tests.oracles.space.agreement import coordinates
from tests.oracles.space.machines import EXAMPLES
from tests.oracles.space.parts import COUNT, inertia, plain, skew, slender
from tests.oracles.space.random_drawn import _pose, laid

FRICTION: dict[str, Tree] = {
    "rssr": {
        "O": {"coefficient": 0.15, "radius": 0.012, "guide": [0.02, 0.03], "thrust_radius": 0.018},
        "A": {"coefficient": 0.2, "radius": 0.01, "circle": "tan"},
        "B": {"coefficient": 0.1, "radius": 0.008},
        "F": {"radius": 0.015, "guide": [0.18, 0.03], "circle": "tan", "thrust_radius": 0.02},
    },
    "rssp": {
        "O": {"radius": 0.012},
        "A": {"radius": 0.01},
        "B": {"coefficient": 0.05, "radius": 0.008},
        "F": {"coefficient": 0.18, "guide": [0.078, 0.0455]},
    },
    "rccc": {
        "O": {"radius": 0.014, "guide": [0.06, 0.06], "thrust_radius": 0.02},
        "A": {"radius": 0.012, "guide": [0.22, 0.18]},
        "B": {"coefficient": 0.16, "radius": 0.01, "circle": "tan"},
        "C": {"coefficient": 0.04, "guide": [0.3, 0.2]},
    },
    "press": {
        "O": {"radius": 0.014, "thrust_radius": 0.02},
        "A": {"radius": 0.009},
        "B": {"radius": 0.009},
        "H": {"coefficient": 0.14, "radius": 0.022, "thread_angle": 15.0},
        "R": {"coefficient": 0.08, "radius": 0.02, "guide": [0.01, 0.04], "thrust_radius": 0.03},
    },
    "two_rods": {
        "O": {"radius": 0.01},
        "A": {"coefficient": 0.3, "radius": 0.04},
        "B": {"coefficient": 0.2, "radius": 0.03},
        "C": {"coefficient": 0.25, "radius": 0.03, "circle": "tan"},
        "D": {"coefficient": 0.3, "radius": 0.04},
        "F": {"radius": 0.01, "guide": [0.03, 0.06]},
        "G": {"radius": 0.01},
    },
}
"""Of each joint; coefficient 0.1 where it says none."""


@cache
def machine(name: str) -> tuple[Tree, natural.Machine, Array]:
    """The tree, its machine, and its coordinates over a cycle."""
    drawn = {"rccc": _rccc, "press": _press, "two_rods": _two_rods}.get(name)
    tree = deepcopy(EXAMPLES[name].tree) if drawn is None else drawn()
    tree["friction"] = {"coefficient": 0.1}
    tree["drives"]["O"]["position"]["count"] = 8 if name == "two_rods" else COUNT
    for joint, friction in FRICTION[name].items():
        tree["joints"][joint]["friction"] = friction
    m = natural.Machine(tree)
    if drawn is None:
        return tree, m, coordinates(m, EXAMPLES[name].answer(True).poses)
    path, gaps = natural.marched(tree, laid(m, tree))
    assert max(gaps) < 1e-13
    return tree, m, path


def _rccc() -> Tree:
    """Its axes meet at angles that let the crank turn round: 30, 70, 60 and 80 degrees."""
    z, d = np.eye(3)[2], _along(80.0, 0.0)
    a = _along(30.0, 40.0)
    b = _at_angles(a, 70.0, d, 60.0)
    joints = {
        "O": ("revolute", "ground", "crank", (0.0, 0.0, 0.0), z),
        "A": ("cylindrical", "crank", "coupler", (0.12, 0.05, 0.02), a),
        "B": ("cylindrical", "follower", "coupler", (0.25, 0.3, 0.1), b),
        "C": ("cylindrical", "ground", "follower", (0.4, 0.1, -0.1), d),
    }
    bodies = {
        "crank": (1.0, (0.05, 0.02, 0.01)),
        "coupler": (2.0, (0.2, 0.15, 0.1)),
        "follower": (1.5, (0.3, 0.2, 0.0)),
    }
    tree = _tree(joints, bodies, "O", 7.0, -11.0)
    tree["loads"] = {
        "F": {"type": "force", "on": "follower", "at": "B", "value": [60.0, -40.0, 90.0]},
        "T": {"type": "couple", "on": "follower", "value": [-9.0, 4.0, 3.0]},
    }
    return tree


def _press() -> Tree:
    """A crank rocks the arm of a spindle through a rod between balls; the ram beneath is stopped from turning."""
    z = np.array([0.0, 0.0, 1.0])
    joints = {
        "O": ("revolute", "ground", "crank", (0.0, 0.0, 0.0), np.array([0.1, 0.05, 1.0])),
        "A": ("spherical", "crank", "rod", (0.07, 0.0, 0.02), z),
        "B": ("spherical", "spindle", "rod", (0.3, 0.22, 0.05), z),
        "H": ("screw", "ground", "spindle", (0.35, 0.0, 0.0), z),
        "R": ("revolute", "spindle", "ram", (0.35, 0.0, -0.2), z),
        "stop": ("sphere_between_planes", "ground", "ram", (0.45, 0.0, -0.25), np.array([0.0, 1.0, 0.0])),
    }
    bodies = {
        "crank": (1.0, (0.03, 0.01, 0.0)),
        "rod": (0.8, (0.185, 0.11, 0.035)),
        "spindle": (6.0, (0.34, 0.06, -0.03)),
        "ram": (4.0, (0.36, 0.01, -0.3)),
    }
    tree = _tree(joints, bodies, "O", 5.0, 8.0)
    tree["joints"]["H"]["lead"] = -0.04
    tree["links"]["ram"]["points"]["P"] = plain(_local(tree, "ram", (0.34, 0.03, -0.35)))
    tree["loads"] = {"F": {"type": "force", "on": "ram", "at": "P", "value": [80.0, -30.0, 1500.0]}}
    return tree


def _two_rods() -> Tree:
    """Two rockers moved one by the other, each through a rod between balls: each rod's spin loads the other's balls."""
    z = np.array([0.0, 0.0, 1.0])
    joints = {
        "O": ("revolute", "ground", "crank", (0.0, 0.0, 0.0), np.array([0.1, 0.0, 1.0])),
        "A": ("spherical", "crank", "rod", (0.07, 0.0, 0.02), z),
        "B": ("spherical", "rocker", "rod", (0.3, 0.22, 0.05), z),
        "F": ("revolute", "ground", "rocker", (0.35, 0.0, 0.1), np.array([0.3, 0.2, 1.0])),
        "C": ("spherical", "rocker", "second rod", (0.28, 0.2, 0.2), z),
        "D": ("spherical", "follower", "second rod", (0.6, 0.15, 0.3), z),
        "G": ("revolute", "ground", "follower", (0.65, -0.1, 0.2), np.array([0.1, 0.5, 1.0])),
    }
    bodies = {
        "crank": (1.0, (0.03, 0.01, 0.0)),
        "rod": (0.8, (0.185, 0.11, 0.035)),
        "rocker": (2.0, (0.33, 0.1, 0.1)),
        "second rod": (3.0, (0.44, 0.175, 0.25)),
        "follower": (2.0, (0.6, 0.0, 0.2)),
    }
    tree = _tree(joints, bodies, "O", 5.0, 8.0)
    middle = tree["links"]["rod"]["center"]
    tree["loads"] = {
        "F": {"type": "force", "on": "follower", "at": "D", "value": [80.0, -130.0, 60.0]},
        "L": {"type": "force", "on": "rod", "at": middle, "value": [20.0, 30.0, -40.0]},
    }
    return tree


def _along(polar: float, around: float) -> Array:
    p, a = np.radians([polar, around])
    return np.array([np.sin(p) * np.cos(a), np.sin(p) * np.sin(a), np.cos(p)])


def _at_angles(a: Array, to_a: float, d: Array, to_d: float) -> Array:
    """The unit vector at two angles to two others, on the side of a x d."""
    g = a @ d
    p, q = np.linalg.solve([[1.0, g], [g, 1.0]], np.cos(np.radians([to_a, to_d])))
    up = np.cross(a, d)
    rest = 1.0 - (p * p + q * q + 2 * p * q * g)
    return np.asarray(p * a + q * d + np.sqrt(rest) * up / np.linalg.norm(up))


def _tree(
    joints: dict[str, Any], bodies: dict[str, Any], drive: str, speed: float, acceleration: float
) -> Tree:
    """Joints (type, i, j, point, axis) and bodies (mass, mass centre) drawn in ground axes, put into the links' own."""
    poses = {"ground": (np.zeros(3), np.eye(3))} | {
        link: (np.add(c, [0.02, -0.01, 0.03]), skew(60 + k))
        for k, (link, (_, c)) in enumerate(bodies.items())
    }
    links: Tree = {link: {"points": {}} for link in poses}
    made: Tree = {}
    for name, (kind, i, j, at, axis) in joints.items():
        made[name] = {"type": kind, "links": [i, j], "axes": {}}
        main = "z" if kind == "revolute" else "x"
        for side, link in (("i", i), ("j", j)):
            place, r = poses[link]
            links[link]["points"][name] = plain(r.T @ (np.asarray(at) - place))
            made[name]["axes"][side] = _frame(r, axis / np.linalg.norm(axis), main)
    for k, (link, (mass, center)) in enumerate(bodies.items()):
        place, r = poses[link]
        about = inertia(70 + k, 0.01 * mass)
        if link.endswith("rod"):
            about = slender(np.subtract(*links[link]["points"].values()), 0.01 * mass)
        links[link] |= {
            "mass": mass,
            "center": plain(r.T @ (np.asarray(center) - place)),
            "inertia": plain(about),
        }
    return {
        "dalembert": 1, "space": "space", "gravity": [0.0, 0.0, -9.80665], "links": links, "joints": made,
        "drives": {drive: {
            "position": {"from": 0.0, "to": 360.0, "count": COUNT}, "speed": f"{speed} rad/s",
            "acceleration": f"{acceleration} rad/s^2",
        }},
        "assembly": {link: _pose(*pose) for link, pose in poses.items() if link != "ground"},
    }  # fmt: skip


def _frame(r: Array, axis: Array, main: str) -> Tree:
    """The joint's axes in a link's: the main one, and a second that is the same on both links as drawn."""
    second = np.cross(axis, (0.3, 0.5, 0.7))
    second = second / np.linalg.norm(second)
    other = "x" if main == "z" else "z"
    return {main: plain(r.T @ axis), other: plain(r.T @ second)}


def _local(tree: Tree, link: str, p: Any) -> Array:
    """A place in ground axes as drawn, in a link's axes."""
    m = natural.Machine(tree)
    q, k = laid(m, tree), 4 * m.links.index(link)
    return np.asarray(q[k + 1 : k + 4] @ (np.asarray(p) - q[k]))
