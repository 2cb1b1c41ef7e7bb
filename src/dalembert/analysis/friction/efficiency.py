"""Cost of friction: efficiency at each position and over the cycle, the share of each joint, both senses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from operator import methodcaller
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.answer.equality import Compared
from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

NOTHING = 1e-9
"""A power, or an efficiency, below this part of the total is rounding."""


@dataclass(frozen=True, eq=False)
class Efficiency(Compared):
    """Efficiency of a machine with friction.

    At a reversal forward and reverse are those just before it.
    forward (P,): of the drive against the load, static: effort without friction over effort with it; 0 where it jams
    reverse (P,): of the load against the drive, static; 0 or less where the machine locks itself, or where the drive
    must help the load against damping at this speed (``damped``)
    cycle: work that arrives over work put in, all positions together; put_in and lost are those works, J
    share: part of the work put in that is lost in each joint, by dry and viscous friction
    by_load: the drives act with known efforts, and the load is unknown
    """

    forward: Array
    reverse: Array
    cycle: float
    put_in: float
    lost: float
    share: dict[str, float]
    damped: Flags
    by_load: bool = False

    def driven(self, k: int) -> str:
        """Meaning of an efficiency below 0 where the drive moves the load at a position."""
        return " (below 0: the load must help)" if self.forward[k] < 0 else ""

    def held(self, k: int) -> str:
        """Meaning of an efficiency of 0 or less where the load moves the drive at a position."""
        if self.by_load or not self.reverse[k] <= 0:
            return ""
        return (
            " (0 or less: the damping takes more at this speed)"
            if self.damped[k]
            else " (0 or less: self-locking)"
        )


def efficiency(r: Result) -> Efficiency:
    """Efficiency of a result with friction.

    Forward is the sense of motion in which the drives (and the unknown loads) put power in: eta = P0 / P; reverse the
    other one, in which they take it out: eta = P / P0, with P0 the power in the same sense with the same loads but
    without the joints' friction, dry and viscous, inertia left out. Where drives act with known efforts, P is the power
    of the unknown loads alone: they put power in in reverse, so that the two are interchanged.
    Over the cycle: (W - L) / W, with W the work of the drives, or of the loads where those drive, and L what the joints
    lose. NaN where the machine does not move.

    >>> import dalembert as da
    >>> r = da.statics(da.mechanism({
    ...     "links": {"ground": {"points": {"O": [0, 0]}}, "block": {"points": {"O": [0, 0]}}},
    ...     "joints": {"O": {"type": "slider", "links": ["ground", "block"], "friction": {"coefficient": 0.2}}},
    ...     "drives": {"O": {"position": 0, "speed": 1}},
    ...     "loads": {"F": {"type": "force", "on": "block", "at": "O", "value": [-100, -100]}},
    ... }))
    >>> round(float(efficiency(r).forward[0]), 6), round(float(efficiency(r).reverse[0]), 6)
    (0.833333, 0.8)
    """
    if r.friction is None:
        raise ModelError("this result has no friction", "give a joint `friction`, and do not switch it off")
    one, other = (_static(r, sign) for sign in (1.0, -1.0))
    drives = one.bare >= 0
    ahead, back = (
        _Sense(*(np.where(drives, *pair) for pair in zip(*two, strict=True)))
        for two in ((one, other), (other, one))
    )
    with np.errstate(all="ignore"):
        put = np.where(
            (ahead.bare >= 0) & (ahead.with_friction > 0), ahead.bare / ahead.with_friction, np.nan
        )
        taken = np.where(back.bare < 0, back.with_friction / back.bare, np.nan)
    put = np.where(ahead.jammed & (ahead.bare > 0), 0.0, put)
    known = r.compiled.known
    moved = known.requested & (r.schedule.speed != 0).any(axis=0)  # drives that only hold have no power
    values = np.where(known.requested, 0.0, known.effort * r.schedule.speed)
    by_load = bool(not moved.any() and values.any())
    forward, reverse = (taken, put) if by_load else (put, taken)
    return Efficiency(forward, reverse, *_cycle(r), back.damped, by_load)


class _Sense(NamedTuple):
    """Power (P,) of the unknowns in one sense of the motion, without the joints' friction and with it."""

    bare: Array
    with_friction: Array
    jammed: Flags
    damped: Flags


def _static(r: Result, sign: float) -> _Sense:
    from dalembert.analysis.one_pass import at_schedule

    schedule = replace(r.schedule, speed=sign * r.schedule.speed, acceleration=0 * r.schedule.acceleration)
    turned = at_schedule(r.mechanism, schedule, inertia=False)
    assert turned.friction is not None
    f = turned.friction
    damping = f.viscous_loss.sum(axis=-1)
    bare = unknown_power(turned, f.bare_effort, f.bare_load) - damping
    with_friction = unknown_power(turned, turned.effort_array, turned.load_array)
    return _Sense(
        np.where(np.abs(bare) < NOTHING * np.abs(with_friction), 0.0, bare),
        with_friction,
        np.array([s == "jammed" for s in turned.status]),
        damping > 0,
    )


def unknown_power(r: Result, effort: Array, load: Array) -> Array:
    """Power (P,) of the unknown efforts and loads."""
    requested = r.compiled.known.requested
    power = (effort * r.schedule.speed)[:, requested].sum(axis=-1)
    for k, name in enumerate(r.unknown_loads):
        power = power + load[:, k] * load_rate(r, name)
    return np.asarray(power)


def load_rate(r: Result, name: str) -> Array:
    """Speed of a load's point along its direction (P,), or turning rate of a couple's link."""
    from dalembert.analysis.compile.load_arrays import point_of
    from dalembert.analysis.methods.applied_forces import unit_load

    load: Any = r.mechanism.loads[name]
    force, couple = unit_load(r, r.unknown_loads.index(name))
    if load.ON == "link":
        turning = r.speed(load.on) * couple
        return np.asarray(turning if turning.ndim == 1 else turning.sum(axis=-1))
    velocity = r._velocity(load.on, point_of(r.mechanism, load.on, load.at))
    return np.asarray((velocity * force).sum(axis=-1))


def _cycle(r: Result) -> tuple[float, float, float, dict[str, float]]:
    """Efficiency, work put in, work lost and shares over the positions."""
    weight = durations(r)
    lost = {joint: _work(r, methodcaller("power_lost", joint), weight) for joint in r.joints}
    drives = _work(r, lambda side: (side.effort_array * side.schedule.speed).sum(axis=-1), weight)
    loads = [_work(r, partial(_load_power, k), weight) for k in range(len(r.unknown_loads))]
    total, net = sum(lost.values()), drives + sum(loads)
    put_in = supplied(net, total)
    if not put_in > 0:
        return float("nan"), put_in, total, dict.fromkeys(lost, float("nan"))
    return (put_in - total) / put_in, put_in, total, {joint: w / put_in for joint, w in lost.items()}


def supplied(net: float, lost: float) -> float:
    """Work or power put in, where the drives give ``net`` of what is lost and the loads the rest: both may put in.

    >>> supplied(5.0, 2.0), supplied(-5.0, 2.0), supplied(1.5, 2.0)
    (5.0, 7.0, 2.0)
    """
    return max(net, 0.0) + max(lost - net, 0.0)


def durations(r: Result) -> Array:
    """Time (P,) represented by each position, s: half the interval to both neighbours, round the turn if it is full.

    A single position represents one second. From the schedule's times, or from the first drive that moves.
    """
    count = len(r.status)
    if count == 1:
        return np.ones(1)
    steps = _steps(r)
    weight = np.zeros(count)
    weight[: len(steps)] += steps / 2
    weight[(np.arange(len(steps)) + 1) % count] += steps / 2
    return weight


def _steps(r: Result) -> Array:
    """Time between neighbouring positions; with the last one, back to the first, where the turn is full."""
    s = r.schedule
    if s.time is not None:
        return np.diff(s.time)
    moving = np.flatnonzero((s.speed != 0).all(axis=0))
    if not moving.size:
        return np.full(len(r.status) - 1, np.nan)
    k = int(moving[0])
    position, speed = s.position[:, k], s.speed[:, k]
    if r.compiled.period is not None:
        target = r.compiled.period[len(r.compiled.target) + k]
        position, speed = np.append(position, position[0] + target), np.append(speed, speed[0])
    twice = speed[1:] + speed[:-1]
    return np.asarray(np.abs(2 * np.diff(position) / np.where(twice != 0, twice, np.nan)))


def _load_power(k: int, r: Result) -> Array:
    """Power (P,) of unknown load number k."""
    return np.asarray(r.load_array[:, k] * load_rate(r, r.unknown_loads[k]))


def _work(r: Result, power: Callable[[Result], Array], weight: Array) -> float:
    """Integral of power over the times, with half of a position's time before a reversal and half after it; single
    positions without a value take that of their neighbours."""
    work = []
    for side in r.sides:
        values = power(side)
        known = np.flatnonzero(np.isfinite(values))
        if not known.size or np.diff(known).max(initial=1) > 2:
            return float("nan")
        work.append((np.interp(np.arange(len(values)), known, values[known]) * weight).sum())
    return float(np.mean(work))
