"""Answers of a motion whose contacts open, in the terms of the description: reactions, normal forces, gaps.

Mechanics: docs/theory.md 10.7.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from dalembert.algebra import plane
from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.analysis.result.result import Result
from dalembert.arrays import Array
from dalembert.core.constraints import measure, system
from dalembert.core.elements.cam_family import CamGap
from dalembert.core.layout import Pose
from dalembert.machine.motion.stops.gap_contacts import GapContact
from dalembert.model import GROUND, Mechanism, Schedule


def normal_size(r: Result, c: GapContact) -> Array:
    """Normal force (T,) of a contact for a unit effort along its gap: 1, but of cams, whose gap is along the follower's
    way."""
    row, layout = r.compiled.freedoms.index((c.joint, c.freedom)), r.compiled.layout
    on_j = system(layout.algebra, layout.freedoms, full_pose(r)).on_j[:, row, : layout.algebra.d]
    return np.asarray(np.sqrt((on_j**2).sum(axis=-1)))


def _about_point(c: Compiled, pose: Pose, row: int, force: Array) -> Array:
    """Moment (T,) about the reference point of its link of a force at the point of a follower."""
    cams = (f for f in c.layout.freedoms.families if isinstance(f, CamGap))
    f, n = next((f, n) for f in cams for n, of in enumerate(f.row) if of == row)
    arm = plane.rotate(pose.rotation[:, int(f.j[n])], f.uj[n])
    return np.asarray(plane.cross(arm, force)[:, 0])


def _end_of_guide(r: Result, guide: Any, pose: Pose, reach: float) -> Array:
    """Vectors (T, 2) from the point of a guide to one of its ends: they turn with j, which may tip."""
    along = reach * np.array([np.cos(guide.angle), -np.sin(guide.angle)])
    return plane.rotate(pose.rotation[:, (*r.links, GROUND).index(guide.links[1])], along)


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

    def normals(self, r: Result, effort: Array, stops: Mapping[str, Array]) -> dict[str, Array]:
        """Normal force (T,) of each contact, N, from efforts (T, D) and the forces of stops."""
        return {
            c.name: c.side * (effort[:, c.drive] if c.drive >= 0 else stops[c.name]) * normal_size(r, c) + 0.0
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
            if own.joints[joint].outlined:  # a face touches beside its point
                moment[:, k] += value * rows.on_j[:, row, 2] - _about_point(opened, pose, row, push)
            if freedom in ("gap_behind", "gap_ahead") and guide is not None:
                reach = -guide[0] if freedom == "gap_behind" else guide[1]
                moment[:, k] += plane.cross(_end_of_guide(r, own.joints[joint], pose, reach), push)[:, 0]
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
