"""Contacts that only push or pull, from the planar joints."""

from __future__ import annotations

from typing import Any

import numpy as np

from dalembert.analysis.compile.contacts import has_friction, resting_coefficient
from dalembert.analysis.compile.plane_rows import numbers
from dalembert.arrays import Numeric
from dalembert.core.elements.cam_family import CamRow
from dalembert.core.elements.linings import BandStrands, Lining
from dalembert.core.elements.pushing import SLIP, Pushing
from dalembert.core.layout import Along, Distance, Mesh, Rows
from dalembert.model import Mechanism
from dalembert.model.joints.contact_keys import HOLDS
from dalembert.model.joints.elements.one_way_joints import Clutch

BEHIND, AHEAD = -1, 1


def pushing_contacts(m: Mechanism, rows: Rows) -> Pushing | None:
    """The contacts of a mechanism's joints that hold in one sense only; None without."""
    normal = _normal_rows(rows)
    pressed = {
        int(rows.joint[n]) for f in rows.families if isinstance(f, Lining | BandStrands) for n in f.row
    }
    out: list[tuple[int, int, Numeric, Numeric, int, float]] = []
    for k, joint in enumerate(m.joints.values()):
        if isinstance(joint, Clutch) and not joint.RELEASED:  # its couple on j has one sense
            out.append((k, int(np.flatnonzero(rows.joint == k)[0]), 0.0, joint.way, 0, 0.0))
        contact = getattr(joint, "contact", None)
        if contact is None or contact.mode == "holds" or contact.opened or k not in normal:
            continue
        sign = pushing_sign(joint, k in pressed)
        if joint.TOOTHED:
            out.append((k, normal[k], sign, 0.0, 0, 0.0))
            continue
        guide = getattr(getattr(joint, "friction", None), "guide", None) if joint.guides else None
        if guide is None:
            out.append((k, normal[k], sign, 0.0, 0, 0.0))
            if joint.wheels and has_friction(m, joint):
                limit = sign * resting_coefficient(m, joint)
                out += [(k, normal[k], limit, 0.0, SLIP, along) for along in (-1.0, 1.0)]
            continue
        behind, ahead = guide
        out.append((k, normal[k], sign * ahead / (behind + ahead), -sign / (behind + ahead), BEHIND, 0.0))
        out.append((k, normal[k], sign * behind / (behind + ahead), sign / (behind + ahead), AHEAD, 0.0))
    if not out:
        return None
    joints, row, force, moment, corner, tangent = map(list, zip(*out, strict=True))
    return Pushing(
        np.array(joints, np.intp),
        np.array(row, np.intp),
        numbers(force),
        numbers(moment),
        np.array(corner, np.intp),
        np.array(tangent, float),
    )


def pushing_sign(joint: Any, pressed: bool = False) -> float:
    """1 where a contact pushes j along its normal, -1 against it; a ``pressed`` lining has its normal."""
    if joint.TOOTHED:
        return -1.0 if joint.flank == "right" else 1.0
    other = not pressed and (getattr(joint, "side", "left") == "right" or getattr(joint, "internal", False))
    return -1.0 if (joint.contact.mode == "pulls") != other else 1.0


def with_held_contacts(m: Mechanism) -> Mechanism:
    """The mechanism with contacts that push and pull."""
    joints = {
        name: j.model_copy(update={"contact": HOLDS}) if "contact" in type(j).model_fields else j
        for name, j in m.joints.items()
    }
    return m.model_copy(update={"joints": joints})


def _normal_rows(rows: Rows) -> dict[int, int]:
    """Constraint along the normal of each joint, by joint."""
    out: dict[int, int] = {}
    for f in rows.families:
        if isinstance(f, Along | Distance | Lining | BandStrands | CamRow):
            flat = f.pitch if isinstance(f, Along) else np.zeros(len(f.row))
            for row, pitch in zip(f.row.tolist(), flat, strict=True):
                if not (isinstance(pitch, float) and pitch) and getattr(pitch, "op", "const") == "const":
                    out.setdefault(int(rows.joint[row]), row)
    for f in rows.families:
        if isinstance(f, Mesh):  # of a wheel that rolls, its distance comes first
            for row in f.row.tolist():
                out.setdefault(int(rows.joint[row]), row)
    return out
