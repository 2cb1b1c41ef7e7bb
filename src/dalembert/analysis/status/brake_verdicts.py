"""Verdicts on brakes and clutches, in sentences: one that would have to help the motion, one that lifts.

Mechanics: docs/theory.md 6.4.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.friction_status import Check, arc
from dalembert.analysis.status.closure_failure import quantity_text
from dalembert.arrays import Array, Flags, Ints

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.result.force_arrays import SolvedForces

HELPS = (
    "A brake gives no torque that helps the motion: the effort of {drive}, {effort}{arc}, acts against it. "
    "Give it the sign of the speed, or reverse the speed."
)
LIFTS = (
    "{joint} would have to {missing} with {force}{arc}: {what}. "
    "Reverse the actuating force, or the sense in which the drum turns."
)
LIFTED = {"shoe": ("pull", "the lining lifts off the drum"), "band": ("push", "the band goes slack")}


def helping(c: Compiled, where: Ints) -> str | None:
    """Why no brake balances the given efforts of drives; None where their signs are not the reason."""
    if not any(joint.BRAKES for joint in c.mechanism.joints.values()):
        return None
    for k, name in enumerate(c.schedule.names):
        effort, speed = c.known.effort[where[0], k], c.schedule.speed[where[0], k]
        if not c.known.requested[k] and effort * speed < 0:
            kind = "moment" if c.layout.freedoms.angular[c.layout.driven[k]] else "force"
            return HELPS.format(drive=name, effort=quantity_text(c, kind, float(effort)), arc=arc(c, where))
    return None


def clamp_checks(c: Compiled, twist: Array, f: SolvedForces) -> list[Check]:
    """Positions at which faces of an unknown force would have to drive what slips between them."""
    wrong: Flags = np.zeros(len(f.rcond), bool)
    for n, load in enumerate(c.unknown_loads):
        joint = c.mechanism.joints.get(load)
        if joint is not None and joint.BRAKES:
            turning = (c.links.index(link) for link in joint.links if link in c.links)
            rate = sum(twist[:, link, -1] for link in turning)
            wrong |= f.load[:, n] * rate > 0
    if not wrong.any():
        return []
    return [("no_balance", wrong, lambda k: helping(c, k) or HELPED)]


HELPED = "A brake gives no torque that helps the motion: its couple would have to act with the slip."


def lifting(c: Compiled, joint: str, force: str, run: Ints) -> str | None:
    """The sentence of a brake that its force would open; None of another joint."""
    part = c.mechanism.joints[joint]
    if not part.BRAKES:
        return None
    missing, what = LIFTED[part.type]
    return LIFTS.format(joint=joint, missing=missing, force=force, arc=arc(c, run), what=what)
