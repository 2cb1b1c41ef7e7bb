"""Normal force of a contact that only pushes, and the speed at which it is lost.

Mechanics: docs/theory.md 5.5.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.compile.pushing_contacts import with_held_contacts
from dalembert.analysis.methods.cam_contacts import cam_contact, is_cam, normal_force
from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.answer.equality import Compared
from dalembert.arrays import Array
from dalembert.core.elements.pushing import LOST, contact_forces, forces_at_speed, rounding
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

SPEEDS = (0.5, 1.0, 2.0)
"""Parts of the given speeds at which the force is computed: it is a quadratic function of them."""

ROUNDS, EXACT = 12, 1e-12
"""Secants to the place where a force passes a limit, and the part of the force that ends them."""


@dataclass(frozen=True, eq=False)
class ContactHistory(Compared):
    """Normal force of a joint whose ``contact`` pushes or pulls, at every position (P,), N.

    needed (P,): the force as if the contact could also pull, below 0 where it is lost (``force`` is NaN). behind,
    ahead (P,): of a guide with lengths, the forces at its ends, the same way. lift_factor: the least factor of all
    speeds (accelerations by its square) from which on the contact is lost somewhere, NaN where it never is, 0 where the
    loads alone do not close it; lift_speed: that of the first drive that moves. lift_acceleration: size of that of the
    first drive that accelerates, at the given speeds, from which on the contact is lost. Loads that depend on time or
    speeds keep their values at the given speeds only to second order.

    place, pressure_angle (P,): of a cam, where a flat face touches, from its point along it, m; and the angle from the
    motion of that place to the normal, > 0 against the cam's sense.

    walls (2, P): of a roller in a groove the forces of its inner and outer wall, of conjugate cams those of both discs;
    changes (K,): positions of the first drive at which it goes over from one to the other, or a disc of a preloaded
    pair comes off or on again.
    """

    joint: str
    needed: Array = field(repr=False)
    behind: Array | None = field(repr=False)
    ahead: Array | None = field(repr=False)
    lift_factor: float
    lift_speed: float
    lift_acceleration: float = np.nan
    place: Array | None = field(default=None, repr=False)
    pressure_angle: Array | None = field(default=None, repr=False)
    walls: Array | None = field(default=None, repr=False)
    changes: Array | None = field(default=None, repr=False)

    @property
    def force(self) -> Array:
        """The normal force (P,), N, NaN where the contact is lost; in a groove < 0 of the outer wall."""
        return self.needed if self.walls is not None else np.where(self.needed < 0, np.nan, self.needed)


def contact_force(r: Result, joint: str) -> ContactHistory:
    """Normal force of a contact along a result, also where it is lost; raises ModelError for a joint that holds and is
    no cam.

    >>> import dalembert as da
    >>> crate = {"points": {"F": [0, 0]}, "mass": 40, "center": [0, 0.6], "inertia": 3}
    >>> floor = {"type": "slider", "links": ["ground", "crate"], "at": ["O", "F"], "contact": "pushes"}
    >>> joints = {"floor": floor | {"friction": {"guide": [0.25, 0.25], "coefficient": 0}}}
    >>> drives = {"floor": {"position": 0, "speed": "10 m/s", "acceleration": "-3 m/s^2"}}
    >>> links = {"ground": {"points": {"O": [0, 0]}}, "crate": crate}
    >>> m = da.mechanism({"gravity": "standard", "links": links, "joints": joints, "drives": drives})
    >>> c = da.dynamics(m).contact("floor")
    >>> c.ahead.round(3), c.behind.round(3)
    (array([340.133]), array([52.133]))
    """
    pushing = r.compiled.pushing
    of = [] if pushing is None else sorted({r.joints[k] for k in pushing.joint})
    if joint not in r.joints:
        raise ModelError(f"unknown joint {joint!r}", closest(joint, of or list(r.joints)))
    if joint not in of and is_cam(r, joint):
        return _held_follower(r, joint)
    if pushing is None or joint not in of:
        what = f"the contact of joint {joint!r} both pushes and pulls"
        raise ModelError(what, "write contact: pushes" if not of else f"choose among {', '.join(of)}")
    rows = np.flatnonzero((pushing.joint == r.joints.index(joint)) & ~pushing.slips)
    holding = with_held_contacts(r.mechanism)
    parts = np.array([_forces(r, holding, factor)[:, rows] for factor in SPEEDS])  # (3, P, K)
    size = np.abs(parts[1]).max(initial=0.0)
    forces = parts[1]
    corners = pushing.corner[rows]
    ends = [forces[:, corners == side] for side in (-1, 1)]
    behind, ahead = (end[:, 0] if end.size else None for end in ends)
    factor = _lift_factor(parts, size)
    moving = r.schedule.speed[:, (r.schedule.speed != 0).any(axis=0)]
    speed = float(np.abs(moving[:, 0]).max()) if moving.size else np.nan
    of_cam = cam_contact(r, joint)[1:] if is_cam(r, joint) else (None, None)
    needed, speeding = forces.sum(axis=1), _lift_acceleration(r, holding, rows, forces)
    return ContactHistory(joint, needed, behind, ahead, factor, factor * speed, speeding, *of_cam)


def _held_follower(r: Result, joint: str) -> ContactHistory:
    """Forces of both walls or discs on a follower in a groove or on conjugate cams, and where it changes."""
    force, cam = normal_force(r, joint), cam_contact(r, joint)
    preload = getattr(r.mechanism.joints[joint], "preload", None) or 0.0
    force = np.where(np.abs(force) <= LOST * np.nanmax(np.abs(r.force_array), initial=0.0), 0.0, force)
    alone = np.abs(force) > 2 * preload
    walls = np.array([np.where(alone, np.maximum(s * force, 0.0), preload + s * force / 2) for s in (1, -1)])
    state = np.where(alone, np.sign(force), 0.0)
    known = np.flatnonzero(np.isfinite(force) if preload else state != 0)
    pairs = [(a, b) for a, b in pairwise(known.tolist()) if state[a] != state[b]]
    changes = _crossings(r, joint, force, np.array(pairs), preload) if r.drives and pairs else np.zeros(0)
    none = (None, None, np.nan, np.nan, np.nan)
    return ContactHistory(joint, force, *none, cam.place, cam.pressure_angle, walls, changes)


def _crossings(r: Result, joint: str, force: Array, pairs: Array, preload: float) -> Array:
    """Positions (K,) of the first drive between ``pairs`` (K, 2) of positions where a force passes a limit: by secants
    that keep the limit between them (Illinois), all at once."""
    low, high = np.zeros(len(pairs)), np.ones(len(pairs))
    at_low, at_high = force[pairs].T
    limit = np.zeros(len(pairs))
    if preload:
        limit = 2 * preload * np.where(at_low + at_high < 0, -1.0, 1.0)
    at_low, at_high = at_low - limit, at_high - limit
    part = low - at_low * (high - low) / (at_high - at_low)
    for _ in range(ROUNDS):
        value = normal_force(_between(r, pairs, part), joint)[1:] - limit
        if not np.isfinite(value).all() or np.abs(value).max() <= EXACT * np.abs(force[pairs]).max():
            break
        same = np.sign(value) == np.sign(at_high)
        low, at_low = np.where(same, low, high), np.where(same, at_low / 2, at_high)
        high, at_high = part, value
        part = low - at_low * (high - low) / (at_high - at_low)
    q = r.schedule.position[:, 0]
    return np.asarray(q[pairs[:, 0]] + part * (q[pairs[:, 1]] - q[pairs[:, 0]]))


def _between(r: Result, pairs: Array, part: Array) -> Result:
    """The first position, and one at each ``part`` (K,) of the way between two."""
    s = r.schedule

    def rows(x: Array) -> Array:
        first, last = x[pairs[:, 0]], x[pairs[:, 1]]
        return np.concatenate([x[:1], first + (part[:, None] if x.ndim > 1 else part) * (last - first)])

    time = None if s.time is None else rows(s.time)
    moved = replace(
        s,
        position=rows(s.position),
        speed=rows(s.speed),
        acceleration=rows(s.acceleration),
        time=time,
        parts=None,
        after=None,
    )
    return at_schedule(r.mechanism, moved, r.inertia)


def _lift_acceleration(r: Result, holding: Mechanism, rows: Array, forces: Array) -> float:
    """Size of the first acceleration from which on a contact is lost; of forces at the given one they are linear."""
    known = r.schedule.acceleration[:, (r.schedule.acceleration != 0).any(axis=0)]
    if not known.size:
        return np.nan
    even = _forces(r, holding, 1.0, 0.0)[:, rows]
    falls = (even > 0) & (even - forces > LOST * np.abs(forces).max(initial=0.0))
    part = np.where(falls, even / np.where(falls, even - forces, 1.0), np.inf).min(initial=np.inf)
    return float(part * np.abs(known[:, 0]).max()) if np.isfinite(part) else np.nan


def _forces(r: Result, holding: Mechanism, factor: float, ahead: float | None = None) -> Array:
    """Forces (P, K) of all contacts at a factor of the speeds, and of the accelerations, by default its square."""
    s, part = r.schedule, factor**2 if ahead is None else ahead
    schedule = replace(s, speed=factor * s.speed, acceleration=part * s.acceleration)
    other = at_schedule(holding, schedule, r.inertia)
    c = r.compiled
    assert c.pushing is not None
    pose, wrenches = full_pose(other), (other.force_array, other.moment_array)
    force = contact_forces(c.layout, c.pushing, pose, *wrenches)
    heavy = forces_at_speed(c.layout, c.forcing.inertia.mass, other.twist_array) if r.inertia else np.zeros(1)
    small = rounding(c.layout, c.pushing, *wrenches, heavy)  # as the status has it
    return np.where(np.abs(force) <= small, 0.0, force)


def _lift_factor(parts: Array, size: float) -> float:
    """Least positive root of the forces (3, P, K) as quadratic functions of the factor; they begin above 0."""
    still, linear, square = np.linalg.solve(np.vander(SPEEDS, 3, increasing=True), parts.reshape(3, -1))
    small = LOST * size
    if (still < -small).any():
        return 0.0
    least = np.inf
    for force in np.stack([square, linear, still], axis=1):
        c = np.where(np.abs(force) > small, force, 0.0)
        if np.isfinite(c).all() and c[:2].any():
            roots = np.roots(c)
            least = min([least, *(x.real for x in roots if abs(x.imag) <= LOST and x.real > LOST)])
    return float(least) if np.isfinite(least) else np.nan
