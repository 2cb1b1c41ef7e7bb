"""Positions at which a contact that only pushes would have to pull, or the reverse, in sentences.

Mechanics: docs/theory.md 5.5.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.friction_status import Check, arc
from dalembert.analysis.status.closure_failure import quantity_text
from dalembert.arrays import Array, Ints
from dalembert.core.layout import Pose
from dalembert.core.pushing import LOST, contact_forces

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.result.force_arrays import SolvedForces

LACKS = (
    "{joint} would have to {missing} with {force}{arc}: {what}. This contact only {mode}; "
    "write contact: holds if it carries forces in both senses."
)
CORNERS = {
    -1: "it tips, its rear end lifts off",
    0: "the contact is lost",
    1: "it tips, its front end lifts off",
}


def contact_checks(c: Compiled, pose: Pose, f: SolvedForces) -> list[Check]:
    """Checks for lost contacts; none if every joint holds in both senses."""
    if c.pushing is None:
        return []
    lacking = lacking_forces(c, pose, f)
    return [("contact_lost", (lacking > 0).any(axis=1), lambda k: _lost_sentence(c, lacking, k))]


def lacking_forces(c: Compiled, pose: Pose, f: SolvedForces) -> Array:
    """Force with which each contact (P, K) would have to pull; 0 where it pushes or its force is not determined."""
    assert c.pushing is not None
    force = contact_forces(c.layout, c.pushing, pose, f.force, f.moment)
    largest = np.abs(f.force).max(axis=(1, 2), initial=0.0)[:, None]
    lost = force < -LOST * largest
    if f.unique is not None:
        lost &= f.unique[:, c.pushing.joint].all(axis=-1)
    return np.where(lost, -force, 0.0)


def _lost_sentence(c: Compiled, lacking: Array, run: Ints) -> str:
    assert c.pushing is not None
    position, contact = np.unravel_index(int(np.argmax(lacking[run])), lacking[run].shape)
    joint = c.joints[c.pushing.joint[contact]]
    mode: str = c.mechanism.joints[joint].contact.mode  # type: ignore[union-attr]
    return LACKS.format(
        joint=joint,
        missing="push" if mode == "pulls" else "pull",
        mode=mode,
        force=quantity_text(c, "force", float(lacking[run][position, contact])),
        arc=arc(c, run),
        what=CORNERS[int(c.pushing.corner[contact])],
    )
