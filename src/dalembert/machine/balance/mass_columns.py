"""Shaking force, moment and effort per unit of each mass number of a counterweight.

With A the base point, D = A - P and U = [alpha]x + [w]x [w]x, the inertia force of a mass element at s from A is
-(a_A + U s) dm. The numbers m, h = int s dm and S = int s s' dm of all of it, in the plane only the trace of S, give

    force   -(m a_A + U h)
    moment  -(h x a_A + int s x U s dm) + D x force       the integral is the axial vector of U S
    effort  -(power of these and of the weight at unit speed of the drive)

Mechanics: docs/theory.md 10.2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import state
from dalembert.arrays import Array, Numeric
from dalembert.machine.balance.counterweights import Counterweight, base_point
from dalembert.machine.link_axes import LinkAxes, couple_in_space, in_space

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

NOISE = 1e-13
"""Part of the machine's largest acceleration that is rounding."""
ONE_AXIS = 1e-9
"""Turning off an axis, as a part of that about it, that is none."""


class MassNumbers(NamedTuple):
    """m, kg, h (3,), kg m, and S (3, 3), kg m2, about the base point in link axes; or of several, a first axis more."""

    mass: Numeric
    moment: Array
    second: Array

    def vector(self, d: int) -> Array:
        """The planar numbers (4,): m, x, y and the trace; in space (10,): S as xx, yy, zz, xy, xz, yz."""
        rows, columns = (0, 1, 2, 0, 0, 1), (0, 1, 2, 1, 2, 2)
        second = [np.trace(self.second)] if d == 2 else self.second[rows, columns]
        return np.array([self.mass, *self.moment[:d], *second])


def units(d: int) -> MassNumbers:
    """A unit of each number, in the order of the vector: 4 in the plane, 10 in space."""
    mixed = [np.outer(*np.eye(3)[[i, j]]) for i, j in ((0, 1), (0, 2), (1, 2))]
    second = [np.diag([0.5, 0.5, 0.0])] if d == 2 else [*map(np.diag, np.eye(3)), *(s + s.T for s in mixed)]
    n = 1 + d + len(second)
    moment, seconds = np.zeros((n, 3)), np.zeros((n, 3, 3))
    moment[1 : d + 1], seconds[d + 1 :] = np.eye(3)[:d], second
    return MassNumbers(np.eye(n)[0], moment, seconds)


def numbers_of(vector: Array) -> MassNumbers:
    """Mass numbers of a vector (4,) or (10,)."""
    m, h, s = units(2 if len(vector) == 4 else 3)
    return MassNumbers(vector @ m, vector @ h, np.tensordot(vector, s, 1))


class Columns(NamedTuple):
    """``of``: columns (P, d, N W) of `force`, of `moment` and `torque`; ``axes`` by link: the one it turns about."""

    of: dict[str, Array]
    axes: dict[str, Array | None]


def mass_columns(r: Result, weights: dict[str, Counterweight], about: Array, drive: str | None) -> Columns:
    """Columns of the numbers (N) of every counterweight (W); axes (3,) in link axes, None of a link with several."""
    parts, axes = [], {}
    for link, w in weights.items():
        local = LinkAxes(r, link)
        part, spin = _columns(r, local, base_point(r.mechanism, link, w.at), in_space(about), drive)
        parts.append(part)
        plane = r.mechanism.dimension == 2
        axes[link] = np.eye(3)[2] if plane else _axis(np.concatenate([local.turning, spin]))
    return Columns({name: np.concatenate([p[name] for p in parts], axis=-1) for name in parts[0]}, axes)


def _axis(turning: Array) -> Array | None:
    """The direction (3,) of all turnings (T, 3), if there is one."""
    _, size, axes = np.linalg.svd(np.concatenate([turning, np.zeros((3, 3))]), full_matrices=False)
    return None if size[1] > ONE_AXIS * size[0] or not size[0] else np.asarray(axes[0])


def _columns(
    r: Result, local: LinkAxes, base: Array, about: Array, drive: str | None
) -> tuple[dict[str, Array], Array]:
    """Columns of one counterweight, and the link's turning (P, 3) in link axes at unit speed of the drive."""
    d, link = r.mechanism.dimension, local.link
    m, h, s = units(d)
    a, rate = local.to_link(r._acceleration(link, base)), local.rate
    largest = max(np.abs(a).max(), np.abs(rate).max())
    if not r.inertia or largest <= NOISE * np.abs(r.acceleration_array).max():
        a, rate = 0 * a, 0 * rate  # a link that stands still
    force = -(m[:, None] * a[:, None] + np.einsum("pij,nj->pni", rate, h))
    product = np.einsum("pij,njk->pnik", rate, s)
    axial = (product - np.swapaxes(product, -1, -2))[..., (2, 0, 1), (1, 2, 0)]
    couple = -(np.cross(h, a[:, None]) + axial)
    force, couple = (np.einsum("pij,pnj->pin", local.rotation, v) for v in (force, couple))
    moment = couple + _cross(in_space(r._place(link, base)) - about, force)
    columns = {"force": force[:, :d], "moment": moment[:, 2:] if d == 2 else moment}
    columns["torque"], spin = np.zeros((len(a), 1, len(m))), np.zeros((0, 3))
    if drive is not None:
        k, gravity = r.links.index(link), in_space(r.mechanism.gravity_vector)
        virtual = state(r).moving.virtual[:, r.drives.index(drive)]
        twist = virtual[:, k] * (np.abs(virtual[:, k]).max() > NOISE * np.abs(virtual).max())
        spin = couple_in_space(twist[:, 2] if d == 2 else twist[:, 3:])
        arm = local.rotation @ (in_space(base) - in_space(r.compiled.layout.reference[k]))
        velocity = in_space(twist[:, :d]) + np.cross(spin, arm)
        turned = local.rotation @ h.T
        couple = couple - _cross(np.broadcast_to(gravity, arm.shape), turned)
        power = np.einsum("pi,pin->pn", velocity, force + gravity[:, None] * m)
        columns["torque"] = -(power + np.einsum("pi,pin->pn", spin, couple))[:, None]
        spin = local.to_link(spin)
    return columns, spin


def _cross(arm: Array, columns: Array) -> Array:
    """Products of arms (P, 3) with columns (P, 3, N)."""
    return np.cross(arm[:, :, None], columns, axis=1)
