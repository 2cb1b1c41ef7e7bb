"""Tensions of a rope, the friction it needs on wheels that it drives, and its angles of wrap.

Mechanics: docs/theory.md 5.7.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.analysis.status.slipping_ropes import rope_lines
from dalembert.answer.equality import Compared
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


@dataclass(frozen=True, eq=False)
class RopeForces(Compared):
    """Rope at every position (P,).

    tension (P, S): of its strands in their order, N, below 0 where it would have to push; direction (P, S, 2): along
    the rope; wheels (W,): link and point of each wheel that it goes round; wrap (P, W): angles on them, radians;
    slip_coefficient (P,): least coefficient by which it holds on the wheels that it turns, 0 without.
    """

    joint: str
    tension: Array = field(repr=False)
    direction: Array = field(repr=False)
    wheels: tuple[str, ...]
    wrap: Array = field(repr=False)
    slip_coefficient: Array = field(repr=False)


def rope_forces(r: Result, joint: str) -> RopeForces:
    """Tensions of a rope, also where it slips or hangs slack; raises ModelError for another joint.

    >>> import dalembert as da
    >>> r = da.statics(da.hoist())
    >>> r.rope("rope").tension.round(2)[0]
    array([1302.97, 1250.85, 1200.81])
    """
    ropes = r.mechanism.ropes
    if joint not in ropes:
        remedy = closest(joint, list(ropes)) if ropes else "add a joint of type: rope"
        raise ModelError(f"{joint!r} is not a rope", remedy)
    held = held_result(r)
    lines = rope_lines(held.compiled, joint, full_pose(held), held.force_array)
    turned = [k for k, wheel in enumerate(lines.wheels) if wheel.drives]
    return RopeForces(
        joint=joint,
        tension=lines.tension,
        direction=lines.direction,
        wheels=tuple(f"{wheel.link}.{wheel.point}" for wheel in lines.wheels),
        wrap=lines.wrap,
        slip_coefficient=lines.needed[:, turned].max(axis=1, initial=0.0),
    )


def held_result(r: Result) -> Result:
    """The result with belts and ropes that neither slip nor go slack, where one does."""
    if not {"slips", "slack"} & {*r.status}:
        return r
    from dalembert.analysis.one_pass import at_schedule

    return at_schedule(r.mechanism.without_limits, r.schedule, r.inertia)
