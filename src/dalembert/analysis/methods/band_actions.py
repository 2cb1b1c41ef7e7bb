"""Forces of a band on its drum and on the ground, beside those on its lever, since an end may be on the ground.

Mechanics: docs/theory.md 6.4.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.arrays import Array
from dalembert.core.branchless import sign
from dalembert.core.constraints import rates, system
from dalembert.core.elements.lining_rows import strands
from dalembert.core.elements.linings import BandStrands
from dalembert.core.equilibrium import with_ground
from dalembert.core.friction.contact_equations import strength
from dalembert.core.layout import Layout, Rows

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

Both = tuple[Array, Array]
"""Force (P, 2) and couple (P,)."""


def has_strands(r: Result, joint: str) -> bool:
    """True of a band."""
    layout: Layout = r.compiled.layout
    k = r.joints.index(joint)
    bands = (f for f in layout.constraints.families if isinstance(f, BandStrands))
    return any(layout.constraints.joint[row] == k for f in bands for row in f.row)


def on_drum(r: Result, joint: str, place: Array) -> tuple[Both, Both]:
    """Force and couple about a place (P, 2) of a band on its drum, all of it, and friction's part; of symbols too.

    With M the mean tension and D = -s c M the difference, F_j = M w_j + D f_j, w_j and f_j the two rows on j.
    """
    layout, contacts = r.compiled.layout, r.compiled.contacts
    k = r.joints.index(joint)
    row = int(np.flatnonzero(layout.constraints.joint == k)[0])
    pull, lever = _wrenches(r, layout.constraints, row, place)
    square, rubbing = np.asarray((lever[0] ** 2).sum(axis=-1)), None
    size: Array = np.zeros(1)
    if contacts is not None and r.friction is not None:
        e = int(np.flatnonzero(contacts.joint == k)[0])
        rubbing, dragged = _wrenches(r, contacts.rows, e, place)
        known = (r.friction.open, r.friction.sense) if hasattr(r.friction, "sense") else ()
        size = -_sense(r, e) * strength(contacts, 1.0, *known)[..., e]
        square = square + size * (dragged[0] * lever[0]).sum(axis=-1)
    mean = (r.force_array[:, k] * lever[0]).sum(axis=-1) / square
    if rubbing is None:
        return (mean[:, None] * pull[0], mean * pull[1]), (0.0 * pull[0], 0.0 * pull[1])
    part = ((size * mean)[:, None] * rubbing[0], size * mean * rubbing[1])
    return (mean[:, None] * pull[0] + part[0], mean * pull[1] + part[1]), part


def _sense(r: Result, e: int) -> Array:
    """Sense of the slip of a contact (P,), of symbols from the rates."""
    if hasattr(r.friction, "sense"):
        return np.asarray(r.friction.sense[:, e])  # type: ignore[union-attr]
    along = system(r.compiled.layout.algebra, r.compiled.contacts.rows, full_pose(r))  # type: ignore[union-attr]
    return sign(rates(along, with_ground(r.twist_array))[:, e])


def _wrenches(r: Result, rows: Rows, row: int, place: Array) -> tuple[Both, Both]:
    """A unit of a row on i and on j: force, and couple about a place."""
    pose, layout = full_pose(r), r.compiled.layout
    with np.errstate(all="ignore"):
        at = system(layout.algebra, rows, pose)
    out = []
    for link, wrench in ((at.i[row], at.on_i[:, row]), (at.j[row], at.on_j[:, row])):
        away = pose.point[:, link] + r.compiled.origin - place
        out.append((wrench[:, :2], wrench[:, 2] + away[:, 0] * wrench[:, 1] - away[:, 1] * wrench[:, 0]))
    return out[0], out[1]


def strand_directions(r: Result, joint: str) -> list[Both]:
    """Places (P, 2) of both ends of a band, and the unit vectors (P, 2) of their pull."""
    layout, pose = r.compiled.layout, full_pose(r)
    k = r.joints.index(joint)
    f = next(
        f
        for f in layout.constraints.families
        if isinstance(f, BandStrands) and k in layout.constraints.joint[f.row]
    )
    mine = list(layout.constraints.joint[f.row]).index(k)
    value = strands(layout.algebra, f, pose)
    return [
        (pose.point[:, link[mine]] + arm[:, mine] + r.compiled.origin, t[:, mine])
        for link, arm, _, t, *_ in value
    ]
