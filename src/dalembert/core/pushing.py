"""Contacts that only push: their normal forces from the joints' reactions.

Mechanics: docs/theory.md 5.5.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array, Ints, Numeric
from dalembert.core.branchless import root
from dalembert.core.geometry import span
from dalembert.core.layout import Along, Distance, Layout, Pose

LOST = 1e-9
"""Part of the largest force of a position that a contact may lack: rounding."""


@dataclass(frozen=True)
class Pushing:
    """Forces (K,) that must not be negative, one for each contact, two for the corners of a guide with lengths.

    joint, row (K,)     the joint, and the constraint along its normal
    force, moment (K,)  the force is ``force`` times the normal reaction plus ``moment`` times the couple on j
    corner (K,)         -1 behind j's point, 1 ahead of it, 0 of a contact without corners
    """

    joint: Ints
    row: Ints
    force: Array
    moment: Array
    corner: Ints

    @property
    def key(self) -> tuple[bytes, ...]:
        """Everything in it, to compare structures by."""
        return tuple(
            np.asarray(x).tobytes() for x in (self.joint, self.row, self.force, self.moment, self.corner)
        )


def normals(layout: Layout, pose: Pose, row: Ints) -> Array:
    """Unit normals (..., K, 2) of contacts, in ground axes: the way in which their constraints push j."""
    g, out = layout.algebra, dict[int, Array]()
    for f in layout.constraints.families:
        if isinstance(f, Along):
            unit = g.rotate(pose.rotation[..., f.i, :], f.axis)
        elif isinstance(f, Distance):
            line = span(g, f, pose)
            unit = line / root((line * line).sum(axis=-1))[..., None]
        else:
            continue
        out |= {int(r): unit[..., k, :] for k, r in enumerate(f.row)}
    return np.stack([out[int(r)] for r in row], axis=-2)


def contact_margins(
    layout: Layout, p: Pushing | None, pose: Pose, force: Array, moment: Array, largest: Numeric
) -> Array:
    """Forces (..., K) of contacts with the rounding of the largest force: below 0 where a contact is lost."""
    if p is None:
        return np.zeros(0)
    return np.asarray(contact_forces(layout, p, pose, force, moment) + LOST * largest)


def contact_forces(layout: Layout, p: Pushing, pose: Pose, force: Array, moment: Array) -> Array:
    """Forces (..., K) of contacts, of reactions (..., joints, 2) on j and couples (..., joints) about its points."""
    normal = (normals(layout, pose, p.row) * force[..., p.joint, :]).sum(axis=-1)
    return np.asarray(p.force * normal + p.moment * moment[..., p.joint])
