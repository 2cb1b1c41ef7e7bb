"""Positions at which a belt slips or a chain goes slack, in sentences.

Mechanics: docs/theory.md 5.7.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.compile.elements.belt_arrays import belts_of, grip, wedge
from dalembert.analysis.friction.friction_status import Check, arc
from dalembert.analysis.output.rounding import PART, largest
from dalembert.analysis.status.closure_failure import quantity_text
from dalembert.arrays import Array, Ints, first_largest
from dalembert.core.elements import belt_pulls
from dalembert.core.equilibrium import with_ground
from dalembert.core.layout import Pose

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.result.force_arrays import SolvedForces

SLIPS = (
    "Belt {joint} needs {needed}, has {has:.4g}; slips from {torque} on, at the wheel of {wheel}{arc}. "
    "Raise its tension, its wrap or its coefficient, or lower the load."
)
SLACK = (
    "The slack strand of {kind} {joint} would have to push with {force}{arc}. "
    "Raise its tension, or lower the load."
)
ROUNDING = 1e-9
"""Part of the tight strand's tension that the slack one may lack."""


class Strands(NamedTuple):
    """Both strands of belts (P, k) at every position.

    difference: of the tensions, with the sense of the multiplier; net: T1 + T2 - 2 T_c; tight, slack: tensions;
    centrifugal: T_c; speed: of the belt; wrap (P, 2, k); needed: least coefficient on a flat wheel.
    """

    difference: Array
    net: Array
    tight: Array
    slack: Array
    centrifugal: Array
    speed: Array
    wrap: Array
    needed: Array


def strands(c: Compiled, pose: Pose, twist: Array, moment: Array) -> Strands:
    """The strands of all belts, from poses, twists (P, L, 3) and the joints' moments (P, joints) on j."""
    layout, f, pulls = c.layout, belt_pulls.belts(c.layout), c.forcing.belts
    assert f is not None
    assert pulls is not None
    difference = moment[:, layout.constraints.joint[f.row]] / f.rj
    speed = belt_pulls.belt_speed(layout, f, pose, with_ground(twist))
    net = belt_pulls.net_sum(pulls, speed, difference)
    centrifugal = pulls.carried * speed * speed
    tight, slack = belt_pulls.tensions(net, centrifugal, difference)
    wrap = belt_pulls.wraps(layout, f, pose)
    over, under = tight - centrifugal, slack - centrifugal
    ratio = over / np.where(under > 0, under, 1.0)
    bound = np.log(np.where(under > 0, np.maximum(ratio, 1.0), np.inf)) / wrap.min(axis=1)
    needed = np.where(difference == 0, 0.0, bound)
    return Strands(
        difference, net, tight, slack, centrifugal, speed, wrap, np.asarray(needed + 0 * difference)
    )


def limit_difference(value: Array, share: Array, ratio: Array) -> Array:
    """Largest difference of the tensions at a ratio E of the net ones, where N without the difference is ``value``."""
    part = 1.0 if np.isinf(ratio).all() else (ratio - 1) / (ratio + 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(
            np.where(share * part == 1, np.inf, np.maximum(value, 0.0) * part / (1 - share * part))
        )


def belt_checks(c: Compiled, pose: Pose, twist: Array, f: SolvedForces) -> list[Check]:
    """Checks for belts that slip and chains that hang slack; none without belts."""
    if c.forcing.belts is None:
        return []
    s, out = strands(c, pose, twist, f.moment), list[Check]()
    for k, belt in enumerate(belts_of(c.mechanism).values()):
        has = grip(c.mechanism, belt)
        if has is None:
            lacks = s.centrifugal[:, k] - s.slack[:, k]
            loose = lacks > ROUNDING * np.abs(s.tight[:, k]) + PART * largest(len(lacks), f.force)
            out.append(("slack", loose, partial(_slack_sentence, c, s, k)))
        else:
            slipping = s.needed[:, k] > has * (1 + ROUNDING)
            out.append(("slips", slipping, partial(_slip_sentence, c, s, k)))
    return out


def _slack_sentence(c: Compiled, s: Strands, k: int, run: Ints) -> str:
    name, belt = list(belts_of(c.mechanism).items())[k]
    worst = run[first_largest(s.centrifugal[run, k] - s.slack[run, k])]
    missing = float(s.centrifugal[worst, k] - s.slack[worst, k])
    kind = "chain" if belt.chain else "belt"
    return SLACK.format(kind=kind, joint=name, force=quantity_text(c, "force", missing), arc=arc(c, run))


def _slip_sentence(c: Compiled, s: Strands, k: int, run: Ints) -> str:
    name, belt = list(belts_of(c.mechanism).items())[k]
    worst = run[first_largest(s.needed[run, k])]
    least = first_largest(-s.wrap[worst, :, k])
    has, needed = grip(c.mechanism, belt), float(s.needed[worst, k])
    assert has is not None
    assert c.forcing.belts is not None
    share = c.forcing.belts.share[k]
    free = s.net[worst, k] - share * abs(s.difference[worst, k])
    ratio = np.exp(has * s.wrap[worst, least, k])
    torque = belt.radii[least] * float(limit_difference(free, share, ratio))
    return SLIPS.format(
        joint=name,
        needed="more than any coefficient" if np.isinf(needed) else f"{needed * wedge(belt):.4g}",
        has=has * wedge(belt),
        torque=quantity_text(c, "moment", torque),
        wheel=belt.links[least],
        arc=arc(c, run),
    )
