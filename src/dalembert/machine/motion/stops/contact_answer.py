"""Answers of a motion whose contacts open, in the terms of the description: reactions, normal forces, gaps.

Mechanics: docs/theory.md 10.7.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.analysis.result.result import Result
from dalembert.arrays import Array
from dalembert.core.constraints import measure, system
from dalembert.machine.motion.stops.gap_contacts import GapContact
from dalembert.model import Mechanism, Schedule


@dataclass(frozen=True)
class OpenedMotion:
    """A motion with opened contacts: of this mechanism, over this schedule of its drives and gaps."""

    mechanism: Mechanism = field(repr=False)
    schedule: Schedule = field(repr=False)
    contacts: tuple[GapContact, ...]

    def gaps(self, r: Result) -> dict[str, Array]:
        """Gap (T,) of each contact, m."""
        c, out = r.compiled, {}
        values = measure(c.layout.algebra, c.layout.freedoms, full_pose(r))
        for contact in self.contacts:
            row = c.freedoms.index((contact.joint, contact.freedom))
            x = values[:, row] if contact.drive < 0 else self.schedule.position[:, contact.drive]
            out[contact.name] = contact.side * (x - contact.at) + 0.0
        return out

    def normals(self, effort: Array, stops: Mapping[str, Array]) -> dict[str, Array]:
        """Normal force (T,) of each contact, N, from efforts (T, D) and the forces of stops."""
        return {
            c.name: c.side * (effort[:, c.drive] if c.drive >= 0 else stops[c.name]) + 0.0
            for c in self.contacts
        }

    def of_description(
        self, r: Result, own: Mechanism, schedule: Schedule, effort: Array, stops: Mapping[str, Array]
    ) -> Result:
        """The result of the description itself: its drives alone, and the contacts' forces in its joints."""
        pose, opened, count = full_pose(r), r.compiled, len(own.drives)
        g = opened.layout.algebra
        rows = system(g, opened.layout.freedoms, pose)
        force, moment = r.force_array.copy(), r.moment_array.copy()
        sent = self._efforts(effort, stops)
        for (joint, freedom), value in sent.items():
            row, k = opened.freedoms.index((joint, freedom)), r.joints.index(joint)
            push = np.where(value[:, None] == 0, 0.0, value[:, None] * rows.on_j[:, row, : g.d])
            force[:, k] += push
            guide = getattr(getattr(own.joints[joint], "friction", None), "guide", None)
            if freedom in ("gap_behind", "gap_ahead") and guide is not None:
                reach = -guide[0] if freedom == "gap_behind" else guide[1]
                moment[:, k] += reach * value
        c = compile_mechanism(own, schedule)
        mobility = replace(r.mobility, freedoms=count, drives=count) if r.mobility else None
        ends = tuple(
            tuple(replace(e, compiled=c, effort_array=e.effort_array[:, :count]) for e in pair)
            for pair in r.ends
        )
        return replace(
            r,
            compiled=c,
            mobility=mobility,
            force_array=force,
            moment_array=moment,
            effort_array=r.effort_array[:, :count],
            unique_array=None,
            ends=ends,  # type: ignore[arg-type]
        )

    def _efforts(self, effort: Array, stops: Mapping[str, Array]) -> dict[tuple[str, str], Array]:
        """Efforts (T,) along the freedoms of opened contacts."""
        out = {}
        for c in self.contacts:
            if c.freedom == "slide":
                continue
            out[c.joint, c.freedom] = effort[:, c.drive] if c.drive >= 0 else stops[c.name]
            if c.slip >= 0:
                out[c.joint, "slip"] = effort[:, c.slip]
        return out
