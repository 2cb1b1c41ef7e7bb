"""What the laws measure in a result, from its own numbers: wrenches on links, powers, differences.

Nothing here reads ``residual`` or ``power_balance`` of the product; known loads come from the oracles.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from tests.oracles.lagrange import Answer, contact
from tests.oracles.lagrange import rows as oracle_rows
from tests.oracles.reading import Array, Machine
from tests.oracles.wrenches import carried, cross, known, placed, push, turned
from tests.random_mechanisms import Drawing


def state(r: Any, links: tuple[str, ...]) -> tuple[Array, Array, Array]:
    """Positions, speeds and accelerations (P, L, 3) of the links' origins, ground first, from a result."""
    q, v, a = (np.zeros((len(r.status), len(links), 3)) for _ in range(3))
    for k, link in enumerate(links):
        if k == 0:
            continue
        q[:, k, :2], q[:, k, 2] = r.position(link), r.angle(link)
        v[:, k, 2], a[:, k, 2] = r.speed(link), r.acceleration(link)
        arm = r.position(link) - r.center(link)
        normal = np.stack([-arm[:, 1], arm[:, 0]], -1)
        spin, gain = v[:, k, 2, None], a[:, k, 2, None]
        v[:, k, :2] = r.center_velocity(link) + spin * normal
        a[:, k, :2] = r.center_acceleration(link) + gain * normal - spin**2 * arm
    return q, v, a


def known_wrenches(r: Any, answer: Answer, inertia: bool = True) -> Array:
    """Loads and inertia at the result's own motion."""
    q, v, a = state(r, answer.machine.links)
    return known(answer.machine, q, v, a if inertia else None)


def joint_wrenches(r: Any, answer: Answer) -> Array:
    """What reactions and efforts of a result do to the links, about their origins."""
    m = answer.machine
    q = state(r, m.links)[0]
    w = np.zeros_like(q)
    for joint, spot in spots(answer.machine, q).items():
        j = next(x for x in m.joints if x.name == joint)
        force, moment = r.reaction(joint), r.reaction_moment(joint)
        _both(w, q, j.i, j.j, spot, force, moment)
    for drive in m.drives:
        j = next(x for x in m.joints if x.name == drive.joint)
        effort = r.effort(drive.name)
        spot = placed(q, j.j, j.at_j)
        along = turned(q[:, j.i, 2] + j.angle("direction"), (1.0, 0.0))
        slides = drive.freedom == "slide"
        _both(w, q, j.i, j.j, spot, effort[:, None] * along * slides, effort * (not slides))
    return w


def _both(w: Array, q: Array, i: int, j: int, spot: Array, force: Array, moment: Array) -> None:
    push(w, q, j, spot, force)
    push(w, q, i, spot, -force)
    w[:, j, 2] += moment
    w[:, i, 2] -= moment


def spots(m: Machine, q: Array) -> dict[str, Array]:
    """Where each joint's reaction acts."""
    return {row.name: contact(row, q) for row in oracle_rows(m, q)}


def joint_powers(r: Any, answer: Answer) -> dict[str, Array]:
    """Power of each joint's reaction on its relative motion, which must vanish."""
    q, v, _ = state(r, answer.machine.links)
    out = {}
    for joint, spot in spots(answer.machine, q).items():
        j = next(x for x in answer.machine.joints if x.name == joint)
        slip = carried(q, v, j.j, spot) - carried(q, v, j.i, spot)
        spin = v[:, j.j, 2] - v[:, j.i, 2]
        out[joint] = np.sum(r.reaction(joint) * slip, -1) + r.reaction_moment(joint) * spin
    return out


def speed_scale(answer: Answer) -> float:
    return float(np.max(np.abs(answer.v * [1, 1, answer.length()]))) or 1.0


def shifted_moment(moment: Array, force: Array, start: Array, end: Array) -> Array:
    """The same wrench's moment about ``end`` instead of ``start``."""
    return moment + cross(start - end, force)


def difference(r: Any, s: Any, d: Drawing, length: float) -> float:
    """Largest difference of forces, moments and efforts between two results, over the largest force."""
    force = max(float(np.max(np.abs(r.reaction(j)))) for j in d.joints) or 1.0
    gaps = [np.max(np.abs(r.reaction(j) - s.reaction(j))) / force for j in d.joints]
    gaps += [np.max(np.abs(r.reaction_moment(j) - s.reaction_moment(j))) / (force * length) for j in d.joints]
    for name, drive in d.drives.items():
        gaps.append(
            np.max(np.abs(r.effort(name) - s.effort(name)))
            / (force * (length if drive.freedom == "turn" else 1.0))
        )
    return float(np.max(gaps))


def smooth_teeth(d: Drawing) -> Drawing:
    """With gears whose teeth push along the tangent only: then reactions are linear in the loads."""
    return replace(d, joints={k: replace(j, pressure=0.0) for k, j in d.joints.items()})
