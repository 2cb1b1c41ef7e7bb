"""One-way clutches and ratchets: those that hold, and those whose links are both moved by drives."""

from __future__ import annotations

import numpy as np

from dalembert.analysis.compile import plane_rows
from dalembert.analysis.compile.elements.rope_parts import with_rope_parts
from dalembert.errors import ModelError
from dalembert.model import Joint, Mechanism
from dalembert.model.joints.elements.clutches import Faces
from dalembert.model.joints.elements.one_way_joints import Clutch, released


def with_clutches(m: Mechanism, drives: int) -> Mechanism:
    """The mechanism with its clutches as they are: constraints where so many drives leave them a freedom to hold, else
    released. Raises ModelError where some hold and some do not: only the motion decides which."""
    clutches = {n: j for n, j in m.joints.items() if isinstance(j, Clutch) and not j.RELEASED}
    if not clutches or m.dimension != 2:
        return m
    expanded = with_rope_parts(m)
    held = sum(
        _constraint_count(joint) for joint in expanded.joints.values() if not isinstance(joint, Clutch)
    )
    left = 3 * sum(name != "ground" for name in expanded.links) - held - drives
    if left >= len(clutches):
        return m
    if left > 0:
        names = " and ".join(clutches)
        raise ModelError(
            f"{left} of the clutches {names} would hold, and which of them depends on the motion",
            "drive the links of the others too, or let forces move them (simulate)",
            ("joints", next(iter(clutches))),
        )
    loose = {name: released(joint) for name, joint in clutches.items()}
    return m.model_copy(update={"joints": {**m.joints, **loose}})


def _constraint_count(joint: Joint) -> int:
    """Constraints of a joint; 0 of faces on an axis, which only rub."""
    if joint.BRAKES or joint.outlined:
        return int(not isinstance(joint, Faces) and not joint.gaps)
    rows = plane_rows.RowBuilder(2)
    plane_rows.add_constraints(rows, 0, joint, (0, 1), np.zeros(2), np.zeros(2))
    return len(rows.targets)
