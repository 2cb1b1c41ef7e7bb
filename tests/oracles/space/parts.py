"""Short ways to write the numbers and the trees of the oracle mechanisms in space."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.oracles.jets import Jet
from tests.oracles.reading import Array, Tree
from tests.oracles.space.statics import Answer, Body, Hinge

COUNT = 24


@dataclass(frozen=True)
class Example:
    """A mechanism over its cycle: the tree, and the answer with or without inertia."""

    name: str
    tree: Tree
    answer: Callable[[bool], Answer]


# numbers


def turning(start: float, end: float, speed: float, acceleration: float) -> Jet:
    """A drive's turn in equal steps, degrees; rates in radians."""
    whole = abs(end - start) == 360.0
    x = np.radians(np.linspace(start, end, COUNT, endpoint=not whole))
    return Jet(x, np.full(COUNT, speed), np.full(COUNT, acceleration))


def skew(seed: int) -> Array:
    """Some rotation."""
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return np.asarray(q if np.linalg.det(q) > 0 else q @ np.diag([1.0, 1.0, -1.0]))


def inertia(seed: int, size: float) -> Array:
    """Of some cloud of points, so that it is one a body can have."""
    points = np.random.default_rng(seed).normal(size=(8, 3)) * [1.0, 0.7, 0.4]
    points -= points.mean(0)
    full = np.eye(3) * np.sum(points**2) - points.T @ points
    full = full * size / np.trace(full)
    return np.asarray(0.5 * (full + full.T))


def slender(line: Array, size: float) -> Array:
    """Of a rod, the same about all axes across it."""
    u = line / np.linalg.norm(line)
    return size * (np.eye(3) - 0.9 * np.outer(u, u))


# trees


def plain(values: Any) -> Any:
    return np.asarray(values, float).tolist()


def link(body: Body, **points: Any) -> Tree:
    return {
        "points": {k: plain(p) for k, p in points.items()},
        "mass": body.mass,
        "center": plain(body.center),
        "inertia": plain(body.inertia),
    }


def joint(kind: str, i: str, j: str, z: Any = None, x: Any = None, **more: Any) -> Tree:
    """``z`` and ``x``: pairs of directions, in i and in j."""
    both = {
        side: {name: plain(pair[k]) for name, pair in (("z", z), ("x", x)) if pair is not None}
        for k, side in enumerate("ij")
    }
    return {"type": kind, "links": [i, j], **({"axes": both} if both["i"] else {}), **more}


def hinge(kind: str, i: str, j: str, h: Hinge, **more: Any) -> Tree:
    return joint(
        kind, i, j, z=(h.frame_i[:, 2], h.frame_j[:, 2]), x=(h.frame_i[:, 0], h.frame_j[:, 0]), **more
    )


def driven(start: float, end: float, turn: Jet) -> Tree:
    return {
        "position": {"from": start, "to": end, "count": COUNT},
        "speed": f"{turn.v[0]} rad/s",
        "acceleration": f"{turn.a[0]} rad/s^2",
    }


def tree(links: Tree, joints: Tree, drives: Tree, answer: Answer) -> Tree:
    loads: Tree = {}
    for name, body in answer.bodies.items():
        for k, (at, value) in enumerate(body.forces):
            loads[f"F{k} {name}"] = {"type": "force", "on": name, "at": plain(at), "value": plain(value)}
        for k, value in enumerate(body.couples):
            loads[f"M{k} {name}"] = {"type": "couple", "on": name, "value": plain(value)}
    return {
        "dalembert": 1, "space": "space", "gravity": [0.0, 0.0, -9.80665], "links": links, "joints": joints,
        "drives": drives, "loads": loads, "assembly": {name: _first(pose) for name, pose in answer.poses.items()},
    }  # fmt: skip


def _first(pose: Any) -> Tree:
    """The pose of the first position, roughly, as a turn about an axis."""
    r, at = pose.rotation.x[0], pose.origin.x[0]
    w = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    angle = np.arctan2(np.linalg.norm(w), np.trace(r) - 1.0)
    return {
        "position": plain(np.round(at, 4)),
        "axis": plain(w / np.linalg.norm(w)),
        "angle": float(np.degrees(angle)),
    }
