"""Checks of a description in space: planar poses, welds by an angle, and inertias that no body can have."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model.assembly import SpacePose
from dalembert.model.joints.plane_joints import Gear
from dalembert.model.links.link import GROUND

if TYPE_CHECKING:
    from dalembert.model.description import Mechanism
    from dalembert.model.links.link import Inertia

PARALLEL = 1e-6
"""Radians by which two axes may differ."""
ROUNDED = 1e-6
"""Relative excess of a principal inertia over the sum of the others that rounding may bring in."""

POSE = "write {position: [0, 0, 0], axis: [0, 0, 1], angle: 30 deg}"


def assembly_problems(m: Mechanism) -> Iterator[ModelError]:
    """Errors for planar poses in space, and spatial ones in the plane."""
    for link, pose in m.assembly.items():
        path = ("assembly", link)
        if isinstance(pose, SpacePose) and m.dimension == 2:
            yield ModelError(
                f"assembly gives link {link!r} a pose in space, but the mechanism is planar",
                "give an angle, or [x, y, angle]",
                path,
            )
        elif not isinstance(pose, SpacePose) and m.dimension == 3:
            yield ModelError(
                f"assembly gives link {link!r} a planar pose, but the mechanism is in space", POSE, path
            )


def space_problems(m: Mechanism) -> Iterator[ModelError]:
    """Everything that does not fit in space only."""
    if m.dimension == 2:
        return
    for name, joint in m.joints.items():
        if getattr(joint, "angle", 0.0):
            yield ModelError(
                f"joint {name!r} is a weld by an angle, which is for the plane",
                "write axes: {i: {x: [1, 0, 0], z: [0, 0, 1]}, j: {...}}",
                ("joints", name, "angle"),
            )
        if isinstance(joint, Gear):
            yield from _other_axes(m, name, joint)


def _other_axes(m: Mechanism, name: str, gear: Gear) -> Iterator[ModelError]:
    """Errors for wheels that turn about other axes than their gear says."""
    for side, link in enumerate(gear.links):
        axis, about = np.array(gear.frames[side], float)[:, 2], dict[str, Array]()
        for other, joint in m.joints.items():
            turns = getattr(getattr(joint, "pair", None), "turns", "")
            if link in joint.links and link != GROUND and len(turns) == 1:
                frames = getattr(joint, "frames")  # noqa: B009
                about[other] = np.array(frames[joint.links.index(link)], float)[:, "xyz".index(turns)]
        if about and not any(np.linalg.norm(np.cross(axis, x)) < PARALLEL for x in about.values()):
            what = (
                f"gear {name!r} gives {link!r} an axis about which it does not turn in {' or '.join(about)}"
            )
            yield ModelError(what, f"write the one of {next(iter(about))}", ("joints", name))


def principal_inertias(inertia: Inertia) -> tuple[float, ...]:
    """The three principal values of an inertia as it is given.

    >>> principal_inertias(((2.0, 1.0, 0.0), (1.0, 2.0, 0.0), (0.0, 0.0, 5.0)))
    (1.0, 3.0, 5.0)
    """
    if not isinstance(inertia, tuple):
        return (inertia,) * 3
    if not isinstance(inertia[0], tuple):
        return tuple(sorted(inertia))
    return tuple(np.linalg.eigvalsh(np.array(inertia, float)).tolist())


def impossible(inertia: Inertia) -> bool:
    """True if no body can have the inertia: one principal value exceeds the sum of the others.

    >>> impossible((1.2, 0.0, 0.0)), impossible((1.0, 1.0, 2.0))
    (True, False)
    """
    low, middle, high = principal_inertias(inertia)
    return bool(high - low - middle > ROUNDED * high)
