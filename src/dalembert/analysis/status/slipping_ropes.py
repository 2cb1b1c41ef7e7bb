"""Positions at which a rope hangs slack or slips on a wheel that it drives, in sentences.

Mechanics: docs/theory.md 5.7.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.compile.elements.rope_parts import RopeWheel, rope_wheels, strand_names
from dalembert.analysis.friction.friction_status import Check, arc
from dalembert.analysis.output.rounding import PART, largest
from dalembert.analysis.status.closure_failure import quantity_text
from dalembert.arrays import Array, Ints, first_largest
from dalembert.core.elements import strand_rows
from dalembert.core.layout import Pose

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.result.force_arrays import SolvedForces

SLACK = (
    "{kind} {rope} would have to push with {force} in strand {strand}{arc}: it hangs slack. "
    "Load it, or move more slowly."
)
SLIPS = (
    "{kind} {rope} needs {needed:.4g}, has {has:.4g}: it slips on {wheel}{arc}. "
    "Give it more turns or a greater coefficient, or lower the load."
)
ROUNDING = 1e-9
"""Part of the greatest tension that a strand may lack."""


class RopeLines(NamedTuple):
    """Strands of one rope: tension (P, S), direction (P, S, 2) and length (P, S); its wheels (W) with the
    wrap (P, W) and the least coefficient (P, W) by which both strands hold on each."""

    tension: Array
    direction: Array
    length: Array
    wheels: tuple[RopeWheel, ...]
    wrap: Array
    needed: Array


def rope_lines(c: Compiled, name: str, pose: Pose, force: Array) -> RopeLines:
    """The strands of a rope from poses and the joints' forces (P, joints, 2) on j."""
    g, f = c.layout.algebra, strand_rows.strands(c.layout)
    assert f is not None
    joints = [c.joints[c.layout.constraints.joint[row]] for row in f.row]
    own = [joints.index(strand) for strand in strand_names(c.mechanism.written, name)]
    unit, length = strand_rows.direction(g, f, pose)
    pull = force[:, [c.joints.index(joints[k]) for k in own]]
    tension = -g.dot(unit[:, own], pull)
    tension = np.where(np.abs(tension) <= PART * largest(len(force), force)[:, None], 0.0, tension)
    wheels = rope_wheels(c.mechanism.written, name)
    before = np.array([own[w.place - 1] for w in wheels], np.intp)
    after = np.array([own[w.place] for w in wheels], np.intp)
    way, turns = (np.array([getattr(w, key) for w in wheels], float) for key in ("way", "turns"))
    wrap = strand_rows.wraps(g, f, pose, before, after, way, turns)
    places = np.array([w.place for w in wheels], np.intp)
    a, b = tension[:, places - 1], tension[:, places]
    holds = (a > 0) & (b > 0)
    ratio = np.where(holds, np.maximum(a, b) / np.where(holds, np.minimum(a, b), 1.0), np.inf)
    needed = np.log(np.where(a == b, 1.0, ratio)) / wrap
    return RopeLines(tension, unit[:, own], length[:, own], wheels, wrap, needed + 0 * a)


def rope_checks(c: Compiled, pose: Pose, f: SolvedForces) -> list[Check]:
    """Checks for ropes that hang slack or slip; none without ropes."""
    out: list[Check] = []
    for name in c.mechanism.ropes if strand_rows.strands(c.layout) is not None else ():
        lines = rope_lines(c, name, pose, f.force)
        largest = np.abs(lines.tension).max(axis=1, initial=0.0)
        loose = (lines.tension < -ROUNDING * largest[:, None]).any(axis=1)
        out.append(("slack", loose, partial(_slack_sentence, c, name, lines)))
        for k, wheel in enumerate(lines.wheels):
            if wheel.holds is not None:
                slipping = lines.needed[:, k] > wheel.holds * (1 + ROUNDING)
                out.append(("slips", slipping, partial(_slip_sentence, c, name, lines, k)))
    return out


def _slack_sentence(c: Compiled, name: str, lines: RopeLines, run: Ints) -> str:
    worst, strand = np.unravel_index(first_largest(-lines.tension[run]), lines.tension[run].shape)
    force = quantity_text(c, "force", float(-lines.tension[run][worst, strand]))
    return SLACK.format(kind=_kind(c, name), rope=name, force=force, strand=int(strand) + 1, arc=arc(c, run))


def _slip_sentence(c: Compiled, name: str, lines: RopeLines, k: int, run: Ints) -> str:
    wheel, needed = lines.wheels[k], float(lines.needed[run, k].max())
    assert wheel.holds is not None
    has, of_flat = wheel.holds * wheel.wedge, needed * wheel.wedge
    kind, where = _kind(c, name), arc(c, run)
    return SLIPS.format(kind=kind, rope=name, needed=of_flat, has=has, wheel=wheel.link, arc=where)


def _kind(c: Compiled, name: str) -> str:
    return "Belt" if c.mechanism.ropes[name].RING else "Rope"
