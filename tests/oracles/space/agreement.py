"""How far a result of the product is from a hand solution in space, each quantity on its own scale."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.oracles.reading import Array
from tests.oracles.space.natural import Machine
from tests.oracles.space.statics import Answer


def disagreement(r: Any, answer: Answer) -> dict[str, float]:
    """Largest differences: lengths over the machine's, rates over the largest, forces over the largest force.

    Angular rates times the machine's length are on the scale of linear ones; moments are over force times length.
    """
    length, force = answer.length(), answer.force_scale()
    out = motion(r, answer, length)
    for name, expected in answer.reactions.items():
        out[f"reaction {name}"] = gap(r.reaction(name), expected.force, force)
        out[f"moment {name}"] = gap(r.reaction_moment(name), expected.moment, force * length)
    for name, effort in answer.efforts.items():
        out[f"effort {name}"] = gap(r.effort(name), effort, force * length)
    return out


def motion(r: Any, answer: Answer, length: float) -> dict[str, float]:
    """Positions, speeds and accelerations of every link and of its mass centre."""
    out = {}
    turning = max(float(np.max(np.abs(pose.w))) for pose in answer.poses.values())
    gaining = max(float(np.max(np.abs(pose.alpha))) for pose in answer.poses.values())
    for link, pose in answer.poses.items():
        local = answer.bodies[link].center
        center = pose.point(local)
        speed = length * turning + float(np.max(np.abs(center.v)))
        gain = length * gaining + float(np.max(np.abs(center.a)))
        if link not in answer.free:
            out[f"position {link}"] = gap(r.position(link), pose.origin.x, length)
            out[f"rotation {link}"] = gap(r.rotation(link), pose.rotation.x, 1.0)
        out[f"speed {link}"] = gap(length * r.speed(link), length * pose.w, speed)
        out[f"acceleration {link}"] = gap(length * r.acceleration(link), length * pose.alpha, gain)
        out[f"center {link}"] = gap(r.center(link), center.x, length)
        out[f"center velocity {link}"] = gap(r.center_velocity(link), center.v, speed)
        out[f"center acceleration {link}"] = gap(r.center_acceleration(link), center.a, gain)
    return out


def gap(found: Array, expected: Array, scale: float) -> float:
    return float(np.max(np.abs(np.asarray(found) - expected))) / (scale or 1.0)


def coordinates(m: Machine, poses: dict[str, Any]) -> Array:
    """Q of the poses of a hand solution."""
    count = max(len(pose.origin.x) for pose in poses.values())
    q = np.zeros((count, m.size, 3))
    q[:, 1:4] = np.eye(3)
    for link, pose in poses.items():
        k = 4 * m.links.index(link)
        q[:, k] = pose.origin.x
        q[:, k + 1 : k + 4] = np.swapaxes(pose.rotation.x, -1, -2)
    return q
