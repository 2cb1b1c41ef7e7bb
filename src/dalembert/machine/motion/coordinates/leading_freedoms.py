"""Other coordinates: where a drive that forces move comes near its dead centre, freedoms of other joints lead on.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.compile.joint_rows import stated_poses
from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.joint_freedoms import freedom_motion, full_pose
from dalembert.analysis.result.result import Result
from dalembert.arrays import Array
from dalembert.core.constraints import rates, system
from dalembert.core.equilibrium import with_ground
from dalembert.machine.motion.actuation import Actuation, joint_stops
from dalembert.machine.motion.equation import DEAD_CENTRE, Equation, StoppedError
from dalembert.machine.motion.equation_trace import equation_of
from dalembert.machine.motion.occurrences import EventCondition, Value
from dalembert.model import Mechanism, Schedule
from dalembert.model.drives.drives import Drive

BESIDE = (-1e-4, -1e-7, 1e-8, 1e-6, 1e-4)
"""Seconds before and behind a change of coordinates at which the new ones are tried."""
PIVOT = 0.1
"""A drive whose freedom moves by less than this part of what moves most is left as a coordinate."""


def unit_motions(m: Mechanism, travel: Array, t: float) -> Result:
    """The mechanism at the end of a path (K, D) travelled by its drives: at speed 1 of each of them in turn."""
    k, d = travel.shape
    position, speed = np.vstack([travel, *[travel[-1:]] * (d - 1)]), np.zeros((k + d - 1, d))
    speed[k - 1 :] = np.eye(d)
    schedule = Schedule(tuple(m.drives), position, speed, 0 * speed, np.full(len(speed), t))
    return at_schedule(m, schedule, inertia=True, forces=False)


def rates_of_freedoms(r: Result) -> Array:
    """Rates of all freedoms (F, D) of such motions."""
    layout, last = r.compiled.layout, slice(-len(r.drives), None)
    twist = with_ground(r.twist_array[last])
    return rates(system(layout.algebra, layout.freedoms, full_pose(r, last)), twist).T


def best_freedoms(r: Result, free: Array, left_out: Sequence[int] = ()) -> tuple[list[int], float]:
    """Rows of the freedoms, without those ``left_out``, that place the links best instead of the drives that are
    ``free`` (D,), and the least part of their motion that the drives have: 1 where these are as good, 0 at a dead
    centre."""
    c, layout = r.compiled, r.compiled.layout
    moved = rates_of_freedoms(r) / np.where(layout.freedoms.angular, 1.0, layout.length)[:, None]
    rows = np.array([_drivable(c, k) and k not in left_out for k in range(len(c.freedoms))])
    left, chosen = np.where(rows[:, None], moved, 0.0), list(layout.driven)
    for k in sorted(range(len(free)), key=lambda k: free[k]):  # what is prescribed first
        size = np.linalg.norm(left, axis=1)
        if free[k]:
            size[[chosen[j] for j in range(len(free)) if j != k]] = 0.0
            chosen[k] = int(np.argmax(size))
        direction = left[chosen[k]] / max(np.linalg.norm(left[chosen[k]]), 1e-300)
        left = left - np.outer(left @ direction, direction)
    share = moved[layout.driven] @ np.linalg.pinv(moved[chosen])
    return chosen, float(np.linalg.svd(share[np.ix_(free, free)], compute_uv=False).min())


def _drivable(c: Compiled, row: int) -> bool:
    """True if a drive can be put on a freedom: it is the joint's only one, or has a name."""
    return c.freedoms[row][1] in ("turn", "slide", "turn1", "turn2", "slide1", "slide2")


def can_change_lead(m: Mechanism, acting: Actuation) -> bool:
    """True if other freedoms may lead, where they exist: brakes, stops and switches belong to drives, and loads may
    depend on a drive's position."""
    if sum(len(joint.freedoms) for joint in m.joints.values()) <= len(m.drives) or joint_stops(m):
        return False
    original = getattr(acting, "own", acting)
    drives = [d for d in original.drives if d.brake or d.stops]
    switched = [x for x in original.motors.values() if x.kinks or x.on or x.off]
    motors = [*original.gears, *original.late, *switched]
    names = {
        n for load in m.loads.values() for v in getattr(load, "varying", ()) for n in getattr(v, "names", ())
    }
    return not drives and not motors and not names & set(original.names)


def lead(m: Mechanism, r: Result, chosen: list[int]) -> tuple[Mechanism, Array]:
    """The mechanism with drives of the chosen freedoms at its last position, and their positions."""
    c, drives, at = r.compiled, {}, []
    for (name, drive), row, was in zip(m.drives.items(), chosen, c.layout.driven, strict=True):
        joint, freedom = c.freedoms[row]
        value = float(freedom_motion(r, joint, freedom)[0][-1])
        at.append(value)
        if row == was:
            drives[name] = drive.model_copy(update={"position": value})
        else:
            drives[f"{joint} {freedom}"] = Drive(joint=joint, freedom=freedom, position=value, speed=1.0)
    return m.model_copy(
        update={"drives": drives, "assembly": stated_poses(r.compiled.layout, r.links, full_pose(r, -1))}
    ), np.array(at)


@dataclass
class Led(Actuation):
    """Efforts of the drives of another actuation, ``own``, on the freedoms that lead instead of them."""

    own: Actuation = field(kw_only=True)
    freedoms: tuple[tuple[str, str], ...] = field(kw_only=True)
    equation: Equation = field(kw_only=True)
    last: Array = field(kw_only=True)

    def follow(self, t: float, p: Array) -> tuple[Array, Array]:
        """Positions (D,) of the drives at the freedoms' positions, full turns counted, and their rates for speed 1 of
        each of these (D, D)."""
        freedoms = self.equation(t, p, np.zeros(len(p))).freedoms
        q, turns = freedoms[:, 0], np.array([d.turns for d in self.own.drives])
        self.last = q + np.where(turns, 2 * np.pi * np.round((self.last - q) / (2 * np.pi)), 0.0)
        return self.last, freedoms[:, 3:]

    def set_anchor(self) -> None:
        self.equation.set_anchor()

    def known(self, t: float, q: Array, u: Array) -> dict[str, float]:
        at, rate = self.follow(t, q)
        return self.own.known(t, at, rate @ u)

    def effort(self, t: float, q: Array, u: Array) -> Array:
        """Efforts (D,) on the freedoms that lead: those that have the same power."""
        at, rate = self.follow(t, q)
        return np.asarray(rate.T @ self.own.effort(t, at, rate @ u))

    def powers(self, t: float, q: Array, u: Array, effort: Array) -> Array:
        at, rate = self.follow(t, q)
        applied = self.own.effort(t, at, rate @ u)
        others = effort - rate[self.free].T @ applied[self.free]
        return np.asarray(np.where(self.free, applied, others) * (rate @ u))

    def lines(self, u: Array, ahead: Array) -> tuple[Array, Array] | None:
        """None, as they go with the freedoms, but where there are none."""
        pushed = any(d.effort for d in self.own.drives) or self.own.motors
        return None if pushed else (np.zeros(len(u)), np.zeros(len(u)))


def lead_from(m: Mechanism, acting: Actuation, travel: Array, t: float, u: Array) -> tuple[Mechanism, Led]:
    """The mechanism with the best freedoms leading from a state, the end of a path of its drives, and the efforts on
    them.

    Raises StoppedError where none of these equations is finite on both sides of the state.
    """
    r = unit_motions(m, travel, t)
    driven = r.compiled.layout.driven
    known = tuple(r.compiled.freedoms[k] for k in driven)
    original, last, names = acting, travel[-1], known
    if isinstance(acting, Led):
        original, last, names = acting.own, acting.follow(t, travel[-1])[0], acting.freedoms
    best = best_freedoms(r, acting.free)[0]
    for left_out in ([], *([row] for row in best if row not in driven)):
        chosen, _ = best_freedoms(r, acting.free, left_out)
        mechanism, p = lead(m, r, chosen)
        speed = rates_of_freedoms(r)[chosen] @ u
        equation = equation_of(mechanism, names)
        beside = (equation.again()(t, p + h * speed, speed) for h in BESIDE)
        if all(np.isfinite(e.mass).all() and np.isfinite(e.freedoms).all() for e in beside):
            steady = acting.acceleration
            return mechanism, Led(
                mechanism,
                acting.free,
                p,
                speed,
                steady,
                acting.laws,
                own=original,
                freedoms=names,
                equation=equation,
                last=last,
            )
    raise StoppedError(DEAD_CENTRE)


@dataclass(frozen=True)
class LedCondition(EventCondition):
    """A condition of a drive that is led."""

    leading: Led = field(kw_only=True)

    def value_at(self, d: int) -> Value:
        def value(t: float, y: Array) -> float:
            at, rate = self.leading.follow(t, y[:d])
            return float((at if self.what == "position" else rate @ y[d : 2 * d])[self.drive] - self.value)

        return value
