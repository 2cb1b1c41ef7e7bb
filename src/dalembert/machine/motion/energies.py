"""Kinetic and potential energy of a machine at the positions of a result, in closed form.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import state
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.arrays import Array
from dalembert.core.constraints import measure
from dalembert.core.equilibrium import with_ground
from dalembert.core.forcing import center_motion
from dalembert.core.geometry import arm

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def energies(r: Result) -> tuple[Array, Array]:
    """Kinetic energy sum (m v_G^2 + w I w) / 2, and that of weights and springs, each (P,), J.

    Weights: -m g r_G; springs: k (l - l0)^2 / 2 + F l; in turns k (q - q0)^2 / 2.
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
    s, t = f.springs, f.resistances
    span = pose.point[:, s.b] + arm(g, pose, s.b, s.at_b) - pose.point[:, s.a] - arm(g, pose, s.a, s.at_a)
    length = np.sqrt((span * span).sum(axis=-1))
    potential = potential + (s.stiffness * (length - s.free_length) ** 2 / 2 + s.force * length).sum(axis=-1)
    turn = measure(g, layout.freedoms, pose)[..., t.row] + t.turns - t.free
    return np.asarray(kinetic), np.asarray(potential + (t.stiffness * turn**2 / 2).sum(axis=-1))
