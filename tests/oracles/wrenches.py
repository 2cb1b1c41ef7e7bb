"""What loads, gravity, springs, dampers and inertia do to each link: (fx, fy, moment) about its origin.

All arrays are (P, L, 3); ``q`` positions, ``v`` speeds, ``a`` accelerations, ground first.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.oracles.reading import Array, Joint, Machine, Tree, angle, number, vector


def turned(angles: Array, local: Any) -> Array:
    """A vector of link axes in ground axes."""
    x, y = local
    return np.stack([x * np.cos(angles) - y * np.sin(angles), x * np.sin(angles) + y * np.cos(angles)], -1)


def cross(a: Array, b: Array) -> Array:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def placed(q: Array, link: int, local: Any) -> Array:
    return q[:, link, :2] + turned(q[:, link, 2], local)


def carried(q: Array, v: Array, link: int, spot: Array) -> Array:
    """Velocity of the material of a link that is at ``spot`` now."""
    arm, w = spot - q[:, link, :2], v[:, link, 2]
    return v[:, link, :2] + np.stack([-w * arm[:, 1], w * arm[:, 0]], -1)


def push(w: Array, q: Array, link: int, spot: Array, force: Any) -> None:
    """Add a force at a spot (ground axes)."""
    force = np.broadcast_to(force, spot.shape)
    w[:, link, :2] += force
    w[:, link, 2] += cross(spot - q[:, link, :2], force)


def known(m: Machine, q: Array, v: Array, a: Array | None) -> Array:
    """Loads, weights, springs, dampers and, with ``a``, minus the rates of momentum."""
    w = np.zeros_like(q)
    for load in m.loads.values():
        LOADS[load["type"]](m, load, w, q, v)
    for joint in m.joints:
        _joint_damping(joint, w, q, v)
    _masses(m, w, q, v, a)
    return w


def _masses(m: Machine, w: Array, q: Array, v: Array, a: Array | None) -> None:
    for link in range(1, len(m.links)):
        arm = turned(q[:, link, 2], m.center[link])
        force = np.broadcast_to(m.mass[link] * np.array(m.gravity), arm.shape)
        if a is not None:
            spin, gain = v[:, link, 2, None], a[:, link, 2, None]
            normal = np.stack([-arm[:, 1], arm[:, 0]], -1)
            force = force - m.mass[link] * (a[:, link, :2] + gain * normal - spin**2 * arm)
            w[:, link, 2] -= m.inertia[link] * gain[:, 0]
        push(w, q, link, q[:, link, :2] + arm, force)


def _force(m: Machine, load: Tree, w: Array, q: Array, v: Array) -> None:
    link = m.links.index(load["on"])
    at = m.points[load["on"]][load["at"]] if isinstance(load["at"], str) else vector(load["at"])
    force = force_of(load)
    local = load.get("axes", "ground") == "link"
    push(w, q, link, placed(q, link, at), turned(q[:, link, 2], force) if local else force)


def force_of(load: Tree) -> tuple[float, float]:
    """Components of a constant force in its own axes."""
    if "direction" in load:
        r, direction = number(load["value"]), angle(load["direction"])
        return r * np.cos(direction), r * np.sin(direction)
    return vector(load["value"])


def _couple(m: Machine, load: Tree, w: Array, q: Array, v: Array) -> None:
    w[:, m.links.index(load["on"]), 2] += number(load["value"])


def _line(m: Machine, load: Tree, w: Array, q: Array, v: Array) -> None:
    """A spring or damper between two points pulls them together with its tension."""
    (i, at_i), (j, at_j) = (m.place(text) for text in load["between"])
    p, r = placed(q, i, at_i), placed(q, j, at_j)
    length = np.hypot(*(r - p).T)
    along = (r - p) / length[:, None]
    rate = np.sum((carried(q, v, j, r) - carried(q, v, i, p)) * along, -1)
    tension = _tension(load, length, rate)[:, None] * along
    push(w, q, i, p, tension)
    push(w, q, j, r, -tension)


def _tension(load: Tree, stretch: Array, rate: Array) -> Array:
    if "force" in load:
        return number(load["force"]) + 0 * stretch
    if "stiffness" in load:
        return number(load["stiffness"]) * (stretch - number(load.get("free_length", 0.0)))
    return number(load["damping"]) * rate


def _torsion(m: Machine, load: Tree, w: Array, q: Array, v: Array) -> None:
    joint = next(joint for joint in m.joints if joint.name == load["joint"])
    turn, rate = (x[:, joint.j, 2] - x[:, joint.i, 2] for x in (q, v))
    if "stiffness" in load:
        _couples(joint, w, -number(load["stiffness"]) * (turn - angle(load.get("free_angle", 0.0))))
    else:
        _couples(joint, w, -number(load["damping"]) * rate)


def _couples(joint: Joint, w: Array, on_j: Array) -> None:
    w[:, joint.j, 2] += on_j
    w[:, joint.i, 2] -= on_j


def _joint_damping(joint: Joint, w: Array, q: Array, v: Array) -> None:
    given = joint.tree.get("damping", {})
    if not isinstance(given, dict):
        given = {"slide" if joint.type in ("slider", "slot") else "turn": given}
    if "turn" in given:
        _couples(joint, w, -number(given["turn"]) * (v[:, joint.j, 2] - v[:, joint.i, 2]))
    if "slide" in given:
        _slide_damping(joint, number(given["slide"]), w, q, v)


def _slide_damping(joint: Joint, c: float, w: Array, q: Array, v: Array) -> None:
    along = turned(q[:, joint.i, 2] + joint.angle("direction"), (1.0, 0.0))
    spot = placed(q, joint.j, joint.at_j)
    rate = np.sum((carried(q, v, joint.j, spot) - carried(q, v, joint.i, spot)) * along, -1)
    force = -c * rate[:, None] * along
    push(w, q, joint.j, spot, force)
    push(w, q, joint.i, spot, -force)


LOADS = {
    "force": _force, "couple": _couple, "spring": _line, "constant_force_spring": _line, "damper": _line,
    "torsion_spring": _torsion, "torsion_damper": _torsion,
}  # fmt: skip
