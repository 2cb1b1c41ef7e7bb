"""Contacts that only push: their normal forces from the joints' reactions.

Mechanics: docs/theory.md 5.5.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dalembert.algebra import plane
from dalembert.arrays import Array, Flags, Ints
from dalembert.core.branchless import larger, root, top
from dalembert.core.constraints import wrenches
from dalembert.core.elements import cam_rows
from dalembert.core.elements.cam_family import CamRow
from dalembert.core.elements.linings import BandStrands, Lining
from dalembert.core.geometry import span
from dalembert.core.layout import Along, Distance, Layout, Mesh, Pose

SLIP = 2
"""Instead of a corner: a limit of friction along the track."""
LOST = 1e-9
"""Part of the largest force of a position that a contact may lack: rounding."""
AT_SPEED = 1e-5
"""Part of the inertia forces that the speeds of a position can bring about, added to its largest force: where nothing
else loads a contact, as in a dwell without weight, all forces there are rounding of these."""


@dataclass(frozen=True)
class Pushing:
    """Forces (K,) that must not be negative, one for each contact, two for the corners of a guide with lengths.

    joint, row (K,)     the joint, and the constraint along its normal
    force, moment (K,)  the force is ``force`` times the normal reaction plus ``moment`` times the couple on j
    corner (K,)         -1 behind j's point, 1 ahead of it, 0 of a contact without corners, ``SLIP`` of a friction limit
    tangent (K,)        and ``tangent`` times the reaction along the normal turned by +90 deg
    """

    joint: Ints
    row: Ints
    force: Array
    moment: Array
    corner: Ints
    tangent: Array

    @property
    def key(self) -> tuple[bytes, ...]:
        """Everything in it, to compare structures by."""
        return tuple(
            np.asarray(x).tobytes()
            for x in (self.joint, self.row, self.force, self.moment, self.corner, self.tangent)
        )

    @property
    def slips(self) -> Flags:
        """Limits of friction (K,): mu N less the force along the track, in both senses."""
        return np.asarray(self.corner == SLIP)


def normals(layout: Layout, pose: Pose, row: Ints) -> Array:
    """Unit normals (..., K, 2) of contacts, in ground axes: the direction in which their constraints push j."""
    g, out = layout.algebra, dict[int, Array]()
    for f in layout.constraints.families:
        if isinstance(f, Along):
            unit = g.rotate(pose.rotation[..., f.i, :], f.axis)
        elif isinstance(f, Lining | BandStrands):
            on_j = wrenches(g, layout.constraints, pose)[1][..., f.row, : g.d]
            unit = on_j / root((on_j * on_j).sum(axis=-1))[..., None]
        elif isinstance(f, Distance):
            line = span(g, f, pose)
            unit = line / root((line * line).sum(axis=-1))[..., None]
        elif isinstance(f, CamRow):
            unit = cam_rows.normal(g, f, pose)
        elif isinstance(f, Mesh):
            line = span(g, f, pose)
            unit = plane.across(line / root((line * line).sum(axis=-1))[..., None])
        else:
            continue
        out |= {int(r): unit[..., k, :] for k, r in enumerate(f.row)}
    none = 0.0 * pose.point[..., 0, :]  # of a couple
    return np.stack([out.get(int(r), none) for r in row], axis=-2)


def contact_margins(
    layout: Layout, p: Pushing | None, pose: Pose, force: Array, moment: Array, heavy: Array
) -> Array:
    """Forces (..., K) of contacts and what of them may be rounding: below 0 where a contact is lost."""
    if p is None:
        return np.zeros(0)
    return contact_forces(layout, p, pose, force, moment) + rounding(layout, p, force, moment, heavy)


def rounding(layout: Layout, p: Pushing, force: Array, moment: Array, heavy: Array) -> Array:
    """What of the forces (..., K) of contacts may be rounding; ``heavy`` (...,): ``forces_at_speed``, or 0 where masses
    have no part."""
    largest = top(abs(force), 2) + AT_SPEED * heavy
    couple = top(abs(moment), moment.ndim - force.ndim + 2) + AT_SPEED * layout.length * heavy
    return LOST * np.where(p.force == 0, np.asarray(couple)[..., None], np.asarray(largest)[..., None])


def forces_at_speed(layout: Layout, mass: Array, twist: Array) -> Array:
    """Force (...,) that gives the largest mass the largest acceleration of the links' speeds over the characteristic
    length: w^2 L or v^2 / L."""
    d = layout.algebra.d
    turning = larger(top(abs(twist[..., d:]), 2), top(abs(twist[..., :d]), 2) / layout.length)
    return np.asarray(top(abs(mass), 1) * layout.length * turning * turning)


def contact_forces(layout: Layout, p: Pushing, pose: Pose, force: Array, moment: Array) -> Array:
    """Forces (..., K) of contacts, of reactions (..., joints, 2) on j and couples (..., joints) about its points."""
    unit, reaction = normals(layout, pose, p.row), force[..., p.joint, :]
    out = p.force * (unit * reaction).sum(axis=-1) + p.moment * moment[..., p.joint]
    if p.slips.any():
        along = unit[..., 0] * reaction[..., 1] - unit[..., 1] * reaction[..., 0]
        out = out + p.tangent * along
    return np.asarray(out)
