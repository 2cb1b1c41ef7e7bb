"""What does not fit in a description in space: poses, directions, inertias, drives of balls."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.errors import ModelError
from dalembert.model.assembly import SpacePose
from dalembert.model.loads import ForceLoad
from dalembert.model.space_joints import BALLS

if TYPE_CHECKING:
    from dalembert.model.mechanism import Mechanism

ROUNDED = 1e-6
"""Relative excess of a principal inertia over the sum of the others that rounding may bring in."""

POSE = "write {position: [0, 0, 0], axis: [0, 0, 1], angle: 30 deg}"


def assembly_problems(m: Mechanism) -> Iterator[ModelError]:
    """Poses of the plane in space, and of space in the plane."""
    for link, pose in m.assembly.items():
        path = ("assembly", link)
        if isinstance(pose, SpacePose) and m.dimension == 2:
            yield ModelError(
                f"assembly gives link {link!r} a pose in space, and the mechanism is one of the plane",
                "give an angle, or [x, y, angle]",
                path,
            )
        elif not isinstance(pose, SpacePose) and m.dimension == 3:
            yield ModelError(
                f"assembly gives link {link!r} a pose of the plane, and the mechanism is in space", POSE, path
            )
        elif isinstance(pose, SpacePose) and not any(pose.axis):
            yield ModelError(
                f"the axis of the pose of link {link!r} has no direction",
                "write one of its components other than 0",
                (*path, "axis"),
            )


def space_problems(m: Mechanism) -> Iterator[ModelError]:
    """Everything that does not fit in space only."""
    if m.dimension == 2:
        return
    yield from _inertias(m)
    yield from _drives(m)
    for name, load in m.loads.items():
        if isinstance(load, ForceLoad) and load.direction is not None:
            yield from _direction(name, load.direction)
    for name, joint in m.joints.items():
        if joint.type == "weld" and joint.angle:
            yield ModelError(
                f"joint {name!r} is a weld by an angle, which is for the plane",
                "write axes: {i: {x: [1, 0, 0], z: [0, 0, 1]}, j: {...}}",
                ("joints", name, "angle"),
            )


def _direction(name: str, direction: Any) -> Iterator[ModelError]:
    path = ("loads", name, "direction")
    if not isinstance(direction, tuple):
        yield ModelError(
            f"the direction of load {name!r} is an angle, which is for the plane", "write [x, y, z]", path
        )
    elif not any(direction):
        yield ModelError(
            f"the direction of load {name!r} is 0", "write one of its components other than 0", path
        )


def _drives(m: Mechanism) -> Iterator[ModelError]:
    for name, drive in m.drives.items():
        joint = m.joints.get(m.drive_joint(name))
        if joint is None:
            continue
        ball = joint.type in BALLS and drive.freedom == "turn"
        what = f"drive {name!r} turns joint {m.drive_joint(name)!r}, a {joint.type} joint"
        if ball and drive.axis is None:
            yield ModelError(f"{what}, which turns any way", "write axis: [0, 0, 1]", ("drives", name))
        elif ball and not any(drive.axis or ()):
            yield ModelError(
                f"the axis of drive {name!r} has no direction",
                "write one of its components other than 0",
                ("drives", name, "axis"),
            )
        elif not ball and drive.axis is not None:
            yield ModelError(
                f"drive {name!r} has an axis, and its freedom has one already",
                "leave it out",
                ("drives", name, "axis"),
            )


def _inertias(m: Mechanism) -> Iterator[ModelError]:
    for name, link in m.links.items():
        least = min(principal_inertias(link.inertia))
        if least < -ROUNDED * max(map(abs, principal_inertias(link.inertia))):
            yield ModelError(
                f"the inertia of link {name!r} has a negative principal value",
                "check its products of inertia: they stand in the matrix with the minus sign, -Ixy = -sum of m x y",
                ("links", name, "inertia"),
            )


def principal_inertias(inertia: Any) -> tuple[float, ...]:
    """The three principal values of an inertia as it is given.

    >>> principal_inertias(((2.0, 1.0, 0.0), (1.0, 2.0, 0.0), (0.0, 0.0, 5.0)))
    (1.0, 3.0, 5.0)
    """
    if not isinstance(inertia, tuple):
        return (inertia,) * 3
    if not isinstance(inertia[0], tuple):
        return tuple(sorted(inertia))
    return tuple(np.linalg.eigvalsh(np.array(inertia, float)).tolist())


def impossible(inertia: Any) -> bool:
    """Whether no body has an inertia: one principal value exceeds the sum of the others.

    >>> impossible((1.2, 0.0, 0.0)), impossible((1.0, 1.0, 2.0))
    (True, False)
    """
    low, middle, high = principal_inertias(inertia)
    return bool(high - low - middle > ROUNDED * high)
