"""Positions at which one-way clutches and ratchets turn freely, or would be turned the other way by drives.

Mechanics: docs/theory.md 10.13.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.friction.friction_status import Check, arc
from dalembert.analysis.status.closure_failure import quantity_text
from dalembert.arrays import Array, Ints
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.result.force_arrays import SolvedForces
    from dalembert.model import Mechanism

STILL = 1e-8
"""Part of the greatest angular speed that is rounding."""
FREE = "{joint} freewheels{arc}: {j} turns ahead of {i} with {rate}, and the clutch carries no couple."
SLIPS = (
    "The rollers of {joint} do not grip: they need a coefficient of friction of {least}, the tangent of half their "
    "wedge, and have {has}. Make the wedge narrower."
)
STANDS = "{joint} does not turn{arc}, as drives hold both of its links: its couple is taken as 0."


def released_joints(m: Mechanism) -> dict[str, Any]:
    """One-way clutches and ratchets whose links are both moved by drives."""
    return {name: joint for name, joint in m.joints.items() if getattr(joint, "RELEASED", False)}


def freewheel_checks(c: Compiled, twist: Array) -> list[Check]:
    """Checks for clutches that turn freely; raises ModelError where drives turn one in the sense it blocks."""
    joints = released_joints(c.mechanism)
    if not joints:
        return []
    spin = np.concatenate([twist[..., 2], np.zeros((len(twist), 1))], axis=1)
    links = [*c.links, "ground"]
    rates = {
        n: spin[:, links.index(j.links[1])] - spin[:, links.index(j.links[0])] for n, j in joints.items()
    }
    small = STILL * np.nanmax(np.abs(spin), initial=0.0)
    for name, rate in rates.items():
        lost = joints[name].pitch and c.schedule.time is not None  # within its lost motion, as forces move it
        blocked = np.flatnonzero((joints[name].way * rate < -small) & (not lost))
        if blocked.size:
            text = quantity_text(c, "angular_speed", abs(float(rate[blocked[0]])))
            raise ModelError(
                f"joint {name!r} is turned in the sense that it blocks{arc(c, blocked[:1])}, with {text}",
                "reverse a drive, or leave one out: then the joint holds",
                ("joints", name),
            )
    held = {
        n: any(load.startswith(f"stop of {n} on ") for load in c.mechanism.loads) for n in joints
    }  # simulated
    out: list[Check] = []
    for name, rate in rates.items():
        turns = (np.abs(rate) > small) | (not held[name])
        out.append(("freewheels", turns, partial(_sentence, c, joints[name], name, rate)))
    return out


def grip_checks(c: Compiled, f: SolvedForces) -> list[Check]:
    """Checks for clutches whose rollers need more friction than they have."""
    out: list[Check] = []
    for k, (name, joint) in enumerate(c.mechanism.joints.items()):
        rollers = getattr(joint, "rollers", None)
        if rollers is not None and rollers.coefficient < rollers.least_coefficient:
            least = f"{rollers.least_coefficient:.4g}"
            sentence = SLIPS.format(joint=name, least=least, has=f"{rollers.coefficient:.4g}")
            out.append(("slips", f.moment[:, k] != 0, partial(_said, sentence)))
    return out


def _said(sentence: str, _: Ints) -> str:
    return sentence


def grip_margins(m: Mechanism) -> list[Any]:
    """Below zero where the rollers of a clutch do not grip."""
    rollers = [r for j in m.joints.values() if (r := getattr(j, "rollers", None)) is not None]
    return [r.coefficient - r.least_coefficient for r in rollers]


def _sentence(c: Compiled, joint: Any, name: str, rate: Array, run: Ints) -> str:
    greatest = float(np.abs(rate[run]).max())
    i, j = joint.links
    if not greatest:
        return STANDS.format(joint=name, arc=arc(c, run))
    return FREE.format(
        joint=name, arc=arc(c, run), i=i, j=j, rate=quantity_text(c, "angular_speed", greatest)
    )
