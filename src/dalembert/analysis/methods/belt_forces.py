"""Tensions of a belt or a chain, the friction it needs, and the most that it transmits.

Mechanics: docs/theory.md 5.7.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.compile.elements.belt_arrays import SUMS, belts_of, grip, wedge
from dalembert.analysis.methods.rope_forces import held_result
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.analysis.status.slipping_belts import Strands, limit_difference, strands
from dalembert.analysis.status.slipping_ropes import rope_lines
from dalembert.answer.equality import Compared
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model.joints.elements.belts import Belt
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


@dataclass(frozen=True, eq=False)
class BeltLimit(Compared):
    """Belt on the point of slipping (P,): both tensions, N, the torques (P, 2) on the wheels of i and j, N m, and the
    power, W; infinite without a limit. best_speed: of the belt, m/s, at which the power at the limit is
    greatest, and that power; infinite without mass."""

    tight: Array
    slack: Array
    torque: Array
    power: Array
    best_speed: float
    best_power: float


@dataclass(frozen=True, eq=False)
class BeltForces(Compared):
    """Belt or chain at every position (P,).

    length (m) and wrap (2,), radians on the wheels of i and j, at the first solved position; tight, slack: tensions
    with the centrifugal one, N, with idlers the largest and the smallest of all strands; centrifugal: T_c = m v^2;
    speed: m/s, positive with the turn of i; torque (P, 2): of
    the belt on both wheels; slip_coefficient: least coefficient of friction that holds, infinite where none does;
    shaft_force: size of its force on the shaft of either wheel, with idlers of that of i; coefficient: that it has, NaN
    without friction; limit: None with idlers.
    """

    joint: str
    length: float
    wrap: Array
    tight: Array = field(repr=False)
    slack: Array = field(repr=False)
    centrifugal: Array = field(repr=False)
    speed: Array = field(repr=False)
    torque: Array = field(repr=False)
    slip_coefficient: Array = field(repr=False)
    shaft_force: Array = field(repr=False)
    coefficient: float
    limit: BeltLimit | None = field(repr=False)


def belt_forces(r: Result, joint: str) -> BeltForces:
    """Tensions and limits of a belt, also where it slips; raises ModelError for another joint.

    >>> import dalembert as da
    >>> m = da.belt_drive()
    >>> b = da.statics(m).belt("belt")
    >>> round(float(b.tight[0]), 2), round(float(b.slack[0]), 2)
    (391.67, 308.33)
    """
    belts = belts_of(r.mechanism)
    rings = [name for name, rope in r.mechanism.ropes.items() if rope.RING]
    if joint in rings:
        return _with_idlers(r, joint)
    if joint not in belts:
        known = [*belts, *rings]
        remedy = closest(joint, known) if known else "add a joint of type: belt"
        raise ModelError(f"{joint!r} is not a belt", remedy)
    k, belt = list(belts).index(joint), belts[joint]
    held = held_result(r)
    s = Strands(
        *(a[..., k] for a in strands(held.compiled, full_pose(held), held.twist_array, held.moment_array))
    )
    mu, (ri, rj) = grip(r.mechanism, belt), belt.signed_radii
    wrap = s.wrap[int(np.argmax(np.isfinite(s.wrap[:, 0])))]
    return BeltForces(
        joint=joint,
        length=_length(belt, wrap),
        wrap=wrap,
        tight=s.tight,
        slack=s.slack,
        centrifugal=s.centrifugal,
        speed=s.speed,
        torque=np.stack([s.difference * ri, s.difference * rj], axis=-1),
        slip_coefficient=s.needed * wedge(belt),
        shaft_force=np.hypot(*held.force_array[:, held.joints.index(joint)].T),
        coefficient=np.nan if mu is None else mu * wedge(belt),
        limit=_limit(belt, s, np.inf if mu is None else mu),
    )


def _with_idlers(r: Result, joint: str) -> BeltForces:
    """The same of a belt with idlers, whose strands are those of a rope that meets itself."""
    held, belt = held_result(r), r.mechanism.written.joints[joint]
    assert isinstance(belt, Belt)
    pose = full_pose(held)
    lines = rope_lines(held.compiled, joint, pose, held.force_array)
    own = [(belt.links[k], belt.point_names(joint)[k]) for k in (0, 1)]
    first, last = ([(w.link, w.point) for w in lines.wheels].index(place) for place in own)
    speed = belt.radii[0] * held.speed(belt.links[0])
    centrifugal, mu = belt.mass_per_length * speed * speed, grip(r.mechanism, belt)
    at = lines.wheels[last].place
    torque = [lines.tension[:, k] - lines.tension[:, k - 1] for k in (0, at)]
    pull = lines.tension[:, :1] * lines.direction[:, 0] - lines.tension[:, -1:] * lines.direction[:, -1]
    solved = int(np.argmax(np.isfinite(lines.wrap[:, 0])))
    places = [abs(p.radius) for p in r.mechanism.ropes[joint].through]
    arcs = sum(places[w.place] * lines.wrap[solved, k] for k, w in enumerate(lines.wheels))
    return BeltForces(
        joint=joint,
        length=float(lines.length[solved].sum() + arcs),
        wrap=lines.wrap[solved, [first, last]],
        tight=lines.tension.max(axis=1) + centrifugal,
        slack=lines.tension.min(axis=1) + centrifugal,
        centrifugal=centrifugal,
        speed=speed,
        torque=np.stack([-t * radius for t, radius in zip(torque, belt.radii, strict=True)], axis=-1),
        slip_coefficient=r.rope(joint).slip_coefficient * wedge(belt),
        shaft_force=np.hypot(*pull.T),
        coefficient=np.nan if mu is None else mu * wedge(belt),
        limit=None,
    )


def _length(belt: Belt, wrap: Array) -> float:
    """Length of the belt: both strands and the arcs."""
    sine = np.sin((wrap[0] - np.pi) / 2)  # of gamma, the strands' angle to the line of centres
    total = sum(belt.signed_radii)
    straight = total / np.tan(np.arcsin(sine)) if sine else np.nan
    return float(2 * straight + belt.radii[0] * wrap[0] + belt.radii[1] * wrap[1])


def _limit(belt: Belt, s: Strands, mu: float) -> BeltLimit:
    """The belt on the point of slipping on the wheel that holds it least, with a coefficient of a flat wheel."""
    key, value = belt.stated_tension
    factor, share, loses = SUMS[key]
    ratio = np.exp(mu * s.wrap.min(axis=1))
    free = s.net - share * np.abs(s.difference) if np.isfinite(s.difference).all() else None
    if free is None:
        free = factor * value - 2 * loses * s.centrifugal
    difference = limit_difference(free, np.asarray(share), ratio)
    above, below = ((1 + sign * share) / 2 * difference if 1 + sign * share else 0.0 for sign in (1, -1))
    tight, slack = free / 2 + above + s.centrifugal, free / 2 - below + s.centrifugal
    torque = np.stack([difference * radius for radius in belt.radii], axis=-1)
    best, most = np.inf, np.inf
    if loses and belt.mass_per_length:
        best = float(np.sqrt(value / (3 * belt.mass_per_length)))
        most = best * float(
            limit_difference(np.asarray(2 / 3 * factor * value), np.asarray(share), ratio).max()
        )
    return BeltLimit(tight, slack, torque, difference * np.abs(s.speed), best, most)
