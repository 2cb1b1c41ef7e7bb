"""What a unit of each mass number of a counterweight adds to the shaking force, the moment and the effort.

With A the base point, D = A - P, u = (i alpha - w^2) e^(i theta) in complex numbers: the inertia force of a mass
element at s is -(a_A + u s), so that the columns of (m, X, Y, I) are

    force   -a_A, -u, -i u, 0
    moment  -D x a_A, -(D x u + e x a_A), -(D x i u + i e x a_A), -alpha      e = e^(i theta)
    effort  -(power of these and of the weight at unit speed of the drive)

Mechanics: docs/theory.md 10.2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import state
from dalembert.analysis.plane_only import refuse_space
from dalembert.arrays import Array
from dalembert.machine.balance.counterweights import Counterweight, base_point

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def mass_columns(
    r: Result, weights: dict[str, Counterweight], about: Array, drive: str | None
) -> dict[str, Array]:
    """Columns of `force` (P, 2, 4 W), `moment` and `torque` (P, 1, 4 W)."""
    refuse_space(
        r.mechanism, "a counterweight", "give the shaking force, or balance a rotor: da.balance_rotor"
    )
    parts = [
        _columns(r, link, base_point(r.mechanism, link, w.at), about, drive) for link, w in weights.items()
    ]
    return {name: np.concatenate([p[name] for p in parts], axis=-1) for name in parts[0]}


def _columns(r: Result, link: str, base: Array, about: Array, drive: str | None) -> dict[str, Array]:
    """Of one counterweight, four columns each."""
    place, acceleration = (_complex(v) for v in (r._place(link, base), r._acceleration(link, base)))
    e = np.exp(1j * r.angle(link))
    alpha, u = r.acceleration(link), (1j * r.acceleration(link) - r.speed(link) ** 2) * e
    zero = np.zeros_like(u)
    force = -np.stack([acceleration, u, 1j * u, zero], axis=-1)
    own = -np.stack(
        [zero, _cross(e, acceleration), _cross(1j * e, acceleration), alpha], axis=-1
    ).real  # about A
    moment = _cross((place - complex(*about))[:, None], force) + own
    columns = {"force": np.stack([force.real, force.imag], axis=1), "moment": moment[:, None, :]}
    columns["torque"] = np.zeros_like(columns["moment"])
    if drive is not None:
        twist = state(r).moving.virtual[:, r.drives.index(drive), r.links.index(link)]
        spin, g = twist[:, 2], complex(*r.mechanism.gravity_vector)
        arm = e * complex(*base) - e * complex(*r.compiled.layout.reference[r.links.index(link)])
        velocity = _complex(twist[:, :2]) + 1j * spin * arm
        whole = force + np.stack([zero + g, zero, zero, zero], axis=-1)
        turning = own + np.stack([zero, _cross(e, zero + g), _cross(1j * e, zero + g), zero], axis=-1).real
        power = (np.conj(velocity)[:, None] * whole).real + spin[:, None] * turning
        columns["torque"] = -power[:, None, :]
    return columns


def _complex(v: Array) -> Array:
    return np.asarray(v[..., 0] + 1j * v[..., 1])


def _cross(u: Array, v: Array) -> Array:
    return np.asarray((np.conj(u) * v).imag)
