"""Contacts that only push or pull, from the planar joints."""

from __future__ import annotations

import numpy as np

from dalembert.analysis.compile.plane_rows import numbers
from dalembert.arrays import Numeric
from dalembert.core.layout import Along, Distance, Rows
from dalembert.core.pushing import Pushing
from dalembert.model import Mechanism
from dalembert.model.joints.contact_keys import HOLDS

BEHIND, AHEAD = -1, 1


def pushing_contacts(m: Mechanism, rows: Rows) -> Pushing | None:
    """The contacts of a mechanism's joints that hold in one sense only; None without."""
    normal = _normal_rows(rows)
    found: list[tuple[int, int, Numeric, Numeric, int]] = []
    for k, joint in enumerate(m.joints.values()):
        contact = getattr(joint, "contact", None)
        if contact is None or contact.mode == "holds" or k not in normal:
            continue
        other = getattr(joint, "side", "left") == "right" or getattr(joint, "internal", False)
        sign = -1.0 if (contact.mode == "pulls") != other else 1.0
        guide = getattr(getattr(joint, "friction", None), "guide", None) if joint.guides else None
        if guide is None:
            found.append((k, normal[k], sign, 0.0, 0))
            continue
        behind, ahead = guide
        found.append((k, normal[k], sign * ahead / (behind + ahead), -sign / (behind + ahead), BEHIND))
        found.append((k, normal[k], sign * behind / (behind + ahead), sign / (behind + ahead), AHEAD))
    if not found:
        return None
    joints, row, force, moment, corner = map(list, zip(*found, strict=True))
    return Pushing(
        np.array(joints, np.intp),
        np.array(row, np.intp),
        numbers(force),
        numbers(moment),
        np.array(corner, np.intp),
    )


def with_held_contacts(m: Mechanism) -> Mechanism:
    """The mechanism with contacts that hold both ways."""
    joints = {
        name: j.model_copy(update={"contact": HOLDS}) if hasattr(j, "contact") else j
        for name, j in m.joints.items()
    }
    return m.model_copy(update={"joints": joints})


def _normal_rows(rows: Rows) -> dict[int, int]:
    """Constraint along the normal of each joint, by joint."""
    out: dict[int, int] = {}
    for f in rows.families:
        if isinstance(f, Along | Distance):
            flat = f.pitch if isinstance(f, Along) else np.zeros(len(f.row))
            for row, pitch in zip(f.row.tolist(), flat, strict=True):
                if not (isinstance(pitch, float) and pitch) and getattr(pitch, "op", "const") == "const":
                    out.setdefault(int(rows.joint[row]), row)
    return out
