"""Energies of a computed motion, and its checks: energy balance, inverse dynamics, closure of the loops.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import state
from dalembert.analysis.output.rounding import sizes
from dalembert.analysis.result.closure_residual import closure_gap
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.arrays import Array
from dalembert.core.constraints import measure
from dalembert.core.elements.turning_frame import second_moment
from dalembert.core.equilibrium import with_ground
from dalembert.core.forcing import Springs, center_motion
from dalembert.core.geometry import arm
from dalembert.machine.motion.actuation import Actuation

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

SURE = ("ok", "self_locking", "outside_table", "redundant", "freewheels")
"""Statuses of instants at which the efforts are compared."""
CLOSE, DOUBT = 1e-10, 1e-5
"""Gap of a check that needs no other measure; and that above which the answer says so."""
NOTHING = 1e-6
"""Least size of the largest effort that is compared, as part of the moments of inertia, weights and loads."""


def energies(r: Result) -> tuple[Array, Array]:
    """Kinetic energy sum (m v_G^2 + w I w) / 2, and that of weights, springs and centrifugal forces, each (P,), J.

    Weights: -m g r_G; springs: k (l - l0)^2 / 2 + F l, of a table the area below it; gas springs: p V/(n - 1) ((V/(V -
    A x))^(n - 1) - 1) - p_out A x; in turns k (q - q0)^2 / 2; a plane that turns: -W^2 J / 2.
    """
    layout, f, pose, twist = r.compiled.layout, r.compiled.forcing, full_pose(r), with_ground(r.twist_array)
    g, masses = layout.algebra, f.inertia
    if not np.isfinite(twist).all():  # left out where forces have no answer
        twist = state(r).moving.twist
    place, v, _ = center_motion(layout, masses, pose, twist, np.zeros_like(twist[..., :-1, :]))
    w = twist[..., :-1, g.d :]
    turning = (g.angular_momentum_rate(pose.rotation[..., :-1, :], w, masses.inertia) * w).sum(axis=-1)
    kinetic = (masses.mass * (v * v).sum(axis=-1) + turning).sum(axis=-1) / 2
    potential = -(masses.mass * (place @ masses.gravity)).sum(axis=-1)
    if f.turning is not None:  # seen from the plane that turns
        potential = potential - f.turning.square / 2 * second_moment(layout, masses, f.turning, pose)
    s, t = f.springs, f.resistances
    span = pose.point[:, s.b] + arm(g, pose, s.b, s.at_b) - pose.point[:, s.a] - arm(g, pose, s.a, s.at_a)
    length = np.sqrt((span * span).sum(axis=-1))
    potential = potential + (s.stiffness * (length - s.free_length) ** 2 / 2 + s.force * length).sum(axis=-1)
    potential = potential + (table_energy(s, length) + gas_energy(s, length)).sum(axis=-1)
    turn = measure(g, layout.freedoms, pose)[..., t.row] + t.turns - t.free
    return np.asarray(kinetic), np.asarray(potential + (t.stiffness * turn**2 / 2).sum(axis=-1))


def table_energy(s: Springs, length: Array) -> Array:
    """Area below the tables (..., k), from no change of length on."""
    at = length - s.free_length
    out = s.start[0] * at
    for bend, slope in zip(s.bends[0], s.slopes[0], strict=True):
        out = out + slope * (np.maximum(at - bend, 0.0) ** 2 - np.maximum(-bend, 0.0) ** 2) / 2
    return np.asarray(out)


def gas_energy(s: Springs, length: Array) -> Array:
    """Work done on gas springs (..., k) since their length."""
    out, x = np.zeros(length.shape), s.length - length
    for k in np.flatnonzero(s.area):
        ratio, n = s.volume[k] / (s.volume[k] - s.area[k] * x[..., k]), s.exponent[k]
        grown = np.log(ratio) if n == 1 else (ratio ** (n - 1) - 1) / (n - 1)
        out[..., k] = s.pressure[k] * s.volume[k] * grown - s.outside[k] * s.area[k] * x[..., k]
    return out


class MotionChecks:
    """Checks of a motion: from ``free_result``, in which the gaps of contacts are separate freedoms, the
    ``efforts`` (T, D) in the freedom of each drive and gap, and the works."""

    works: Mapping[str, Array]
    moves: Actuation

    @property
    def free_result(self) -> Result:
        """The analysis in which the gaps of contacts are separate freedoms."""
        raise NotImplementedError

    @property
    def time(self) -> Array:
        """Instants (T,), s."""
        raise NotImplementedError

    @cached_property
    def efforts(self) -> Array:
        """Effort in the freedom of each drive and gap (T, D), N m or N."""
        raise NotImplementedError

    @cached_property
    def _energies(self) -> tuple[Array, Array]:
        return energies(self.free_result)

    @property
    def kinetic(self) -> Array:
        """Kinetic energy (T,), J."""
        return self._energies[0]

    @property
    def potential(self) -> Array:
        """Energy of weights and springs (T,), J."""
        return self._energies[1]

    @cached_property
    def energy_residual(self) -> float:
        """Gap of the energy balance over the largest energy."""
        gained, works = [x - x[0] for x in self._energies], [x - x[0] for x in self.works.values()]
        exchanged = [self.kinetic, gained[1], *works]
        largest = max(float(np.nanmax(np.abs(x), initial=0.0)) for x in exchanged)
        return float(np.nanmax(np.abs(sum(gained) - sum(works)), initial=0.0)) / (largest or 1.0)

    @cached_property
    def law_gap(self) -> Array:
        """Difference of the efforts of the computed motion, prescribed, from those that made it: where they are numbers
        and no contact reverses."""
        r, free = self.free_result, self.moves.free
        sure = np.array([s in SURE for s in r.status])
        if r.friction is not None:
            sure &= ~r.friction.reversing.any(axis=1)
        arm = np.where(self.moves.turns, 1.0, r.compiled.layout.length)[free]  # forces as couples
        required, applied = r.effort_array[:, free] * arm, self.efforts[:, free] * arm
        inner = np.nan_to_num(r.force_array) * r.compiled.layout.length  # beside it an effort may be nothing
        forces, couples = r.compiled.forcing.forces.value, r.compiled.forcing.couples.value
        loads = np.append(np.ravel(forces) * r.compiled.layout.length, couples)  # of numbers that cancel
        compared = (required[sure], applied[sure], inner[sure], np.asarray(loads, float))
        largest = max(float(np.abs(x).max(initial=0.0)) for x in compared)
        gap = np.where(sure, np.abs(required - applied).max(axis=1, initial=0.0), 0.0)
        if gap.max(initial=0.0) > CLOSE * largest:  # all these may be rounding themselves
            largest = max(largest, float((NOTHING * sizes(r)["moment"][sure]).max(initial=0.0)))
        return np.asarray(gap / (largest or 1.0))

    @property
    def law_residual(self) -> float:
        """The largest of ``law_gap``."""
        return float(self.law_gap.max(initial=0.0))

    @cached_property
    def closure(self) -> float:
        """Gap of the loops, m or rad."""
        return float(np.nanmax(closure_gap(self.free_result), initial=0.0))

    @property
    def doubt(self) -> str:
        """Failed checks, as beside a singular position where a motion ends; empty where all are met."""
        at, doubts = np.flatnonzero(self.law_gap > DOUBT), []
        if len(at):
            when = f"{self.time[at[0]]:.6g} s" + (f" and {len(at) - 1} more" if len(at) > 1 else "")
            doubts.append(
                f"at {when} accelerations and forces are uncertain: prescribed, that motion asks for other efforts, "
                f"by {self.law_residual:.1g} of the largest"
            )
        if self.energy_residual > DOUBT:
            doubts.append(f"the energy balance has a gap of {self.energy_residual:.1g} of the largest energy")
        if self.closure > DOUBT and self.closure > DOUBT * self.free_result.compiled.layout.length:
            doubts.append(f"the loops are open by up to {self.closure:.1g} m or rad")
        return "; ".join(doubts)
