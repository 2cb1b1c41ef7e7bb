"""Superposition as T = F h: the force that each source makes at the crank's pin, and its arm about the driven joint.

Mechanics: docs/theory.md 5.2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import joint_place
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.methods.superposition import Superposition


class EffortArm(NamedTuple):
    """A source's part of a driving torque (N m): force (N) of the pin with its arm (m), and what acts on the crank
    itself."""

    source: str
    force: float
    arm: float
    at_pin: float
    own: float

    @property
    def torque(self) -> float:
        """The part of the torque, counter-clockwise on the crank positive."""
        return self.at_pin + self.own


class DrivenCrank(NamedTuple):
    """A crank with one pin besides the driven one."""

    drive: str
    link: str
    pin: str
    joint: str


def driven_crank(parts: Superposition, drive: str) -> DrivenCrank | None:
    """The crank of a drive whose torque is sought, at a fixed pin in the plane, if it has one other joint."""
    r, m = parts.result, parts.result.mechanism
    if not r.compiled.known.requested[r.drives.index(drive)] or r.unknown_loads:
        return None
    joint = m.drives[drive].joint or drive
    i, j = m.joints[joint].links
    if m.dimension == 3 or GROUND not in (i, j) or not m.joints[joint].hinge:
        return None
    crank = j if i == GROUND else i
    pins = [n for n, d in m.joints.items() if crank in d.links and n != joint]
    return DrivenCrank(drive, crank, pins[0], joint) if len(pins) == 1 and m.joints[pins[0]].hinge else None


def effort_arms(parts: Superposition, crank: DrivenCrank, k: int = 0) -> list[EffortArm]:
    """Every source's part: T = F h of the force at the crank's pin, and for a source on the crank itself its moment.

    >>> import dalembert as da
    >>> from dalembert.bundled import cases
    >>> parts = da.superposition(da.statics(da.load(cases()["seed-000-a-four-bar-loaded-rocker"])))
    >>> arms = effort_arms(parts, driven_crank(parts, parts.result.drives[0]))
    >>> all(abs(abs(a.force * a.arm) - abs(a.torque)) < 1e-9 for a in arms)
    True
    """
    r = parts.result
    n, d = r.joints.index(crank.pin), r.drives.index(crank.drive)
    sign = 1.0 if r.mechanism.joints[crank.pin].links[1] == crank.link else -1.0
    turn = 1.0 if r.mechanism.joints[crank.joint].links[1] == crank.link else -1.0
    arm = joint_place(r, crank.pin)[k] - joint_place(r, crank.joint)[k]
    out = []
    for s, source in enumerate(parts.sources):
        force = sign * parts.force[s, k, n]
        size, torque = float(np.hypot(*force)), turn * float(parts.efforts[s, k, d])
        moment = float(arm[0] * force[1] - arm[1] * force[0])
        out.append(EffortArm(source, size, abs(moment) / size if size else 0.0, -moment, torque + moment))
    return out
