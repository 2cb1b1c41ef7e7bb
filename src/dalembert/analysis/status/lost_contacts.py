"""Positions at which a contact that only pushes would have to pull, or the reverse, in sentences.

Mechanics: docs/theory.md 5.5.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.friction_status import Check, arc
from dalembert.analysis.status.brake_verdicts import lifting
from dalembert.analysis.status.closure_failure import quantity_text
from dalembert.arrays import Array, Ints, first_largest
from dalembert.core.elements.pushing import LOST, contact_forces, forces_at_speed, rounding
from dalembert.core.layout import Pose

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.result.force_arrays import SolvedForces

LACKS = (
    "{joint} would have to {missing} with {force}{arc}: {what}. This contact only {mode}; "
    "write contact: holds if it carries forces in both directions."
)
SLIPS = (
    "{joint} slips{arc}: to roll it needs a coefficient of friction of {needs} at rest and has {has}. Load it more, or "
    "let forces move it (simulate), where it slides."
)
UNPRESSED = (
    "{joint} slips{arc}: its links are not pressed together. Load it, or let forces move it (simulate), where it "
    "slides."
)
FREE = (
    "{joint} would have to hold with {couple} in its free sense{arc}: {j} runs ahead of {i}, and the drives do not say "
    "how fast. Drive both links, or let forces move them (simulate)."
)
FLANK = "the teeth change flank"
CORNERS = {
    -1: "it tips, its rear end lifts off",
    0: "the contact is lost",
    1: "it tips, its front end lifts off",
}


def contact_checks(c: Compiled, pose: Pose, twist: Array, f: SolvedForces, inertia: bool) -> list[Check]:
    """Checks for lost contacts; none if every joint holds in both senses."""
    if c.pushing is None:
        return []
    lacking, limits = _lacking_forces(c, pose, twist, f, inertia), c.pushing.slips
    lost, slipping = np.where(limits, 0.0, lacking), np.where(limits, lacking, 0.0)
    checks: list[Check] = [
        ("contact_lost", (lost > 0).any(axis=1), lambda k: _lost_sentence(c, lost, k)),
        ("slips", (slipping > 0).any(axis=1), lambda k: _slip_sentence(c, slipping, pose, f, k)),
    ]
    return checks if limits.any() else checks[:1]


def _lacking_forces(c: Compiled, pose: Pose, twist: Array, f: SolvedForces, inertia: bool) -> Array:
    """Force with which each contact (P, K) would have to pull; 0 where it pushes or its force is not determined."""
    assert c.pushing is not None
    heavy = np.zeros(len(twist))
    if inertia:
        heavy = forces_at_speed(c.layout, c.forcing.inertia.mass, twist)
    force = contact_forces(c.layout, c.pushing, pose, f.force, f.moment)
    lost = force < -rounding(c.layout, c.pushing, f.force, f.moment, heavy)
    if f.unique is not None:
        lost &= f.unique[:, c.pushing.joint].all(axis=-1)
    return np.where(lost, -force, 0.0)


def _slip_sentence(c: Compiled, slipping: Array, pose: Pose, f: SolvedForces, run: Ints) -> str:
    """Coefficient that rolling needs where most of it is missing, and that it has."""
    assert c.pushing is not None
    position, limit = np.unravel_index(first_largest(slipping[run]), slipping[run].shape)
    at, k = run[position], c.pushing.joint[limit]
    forces = contact_forces(c.layout, c.pushing, pose, f.force, f.moment)[at]
    first = int(np.flatnonzero(c.pushing.joint == k)[0])
    has = abs(float(c.pushing.force[limit]))
    if not forces[first] > LOST * slipping[at, limit]:
        return UNPRESSED.format(joint=c.joints[k], arc=arc(c, run))
    needs = has + float(slipping[at, limit]) / float(forces[first])
    return SLIPS.format(joint=c.joints[k], needs=f"{needs:.6g}", has=f"{has:.6g}", arc=arc(c, run))


def _lost_sentence(c: Compiled, lacking: Array, run: Ints) -> str:
    assert c.pushing is not None
    position, contact = np.unravel_index(first_largest(lacking[run]), lacking[run].shape)
    joint = c.joints[c.pushing.joint[contact]]
    if not c.pushing.force[contact] and not c.pushing.corner[contact]:
        couple = quantity_text(c, "moment", float(lacking[run][position, contact]))
        i, j = c.mechanism.joints[joint].links
        return FREE.format(joint=joint, couple=couple, arc=arc(c, run), i=i, j=j)
    force = quantity_text(c, "force", float(lacking[run][position, contact]))
    if text := lifting(c, joint, force, run):
        return text
    mode: str = c.mechanism.joints[joint].contact.mode  # type: ignore[union-attr]
    return LACKS.format(
        joint=joint,
        missing="push" if mode == "pulls" else "pull",
        mode=mode,
        force=force,
        arc=arc(c, run),
        what=FLANK if c.mechanism.joints[joint].TOOTHED else CORNERS[int(c.pushing.corner[contact])],
    )
