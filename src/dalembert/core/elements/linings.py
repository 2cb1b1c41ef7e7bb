"""Rows between a drum i and what is pressed on it, j: the resultant of a lining, the two strands of a band."""

from __future__ import annotations

from dataclasses import dataclass

from dalembert.arrays import Array, Ints


@dataclass(frozen=True)
class Lining:
    """A force on j at a fixed angle to the line from i's point, the drum's axis, to j's point; it acts at the axis,
    with a couple.

    The normal pressure on a lining has its resultant through the axis. Its friction, turned by 90 degrees, acts at a
    distance from it: with a couple.
    """

    row: Ints
    i: Ints
    j: Ints
    ui: Array
    uj: Array
    along: Array  # (k,) cosine and sine of the angle from the line to the force
    across: Array
    couple: Array  # (k,) on j, a unit of force


@dataclass(frozen=True)
class BandStrands:
    """Tensions of the two strands of a band around a drum i about i's point: ``first`` and ``last`` a unit.

    The ends are on j or on ground, links ``end_a`` and ``end_b`` with arms ``ua`` and ``ub``. The strands pull along
    the tangents of the drum, or, where ``parallel`` is 1, across the line of the ends: in their measure along ``axis``,
    that direction at the first pose, so that its rate there is the power of the tensions.
    """

    row: Ints
    i: Ints
    j: Ints
    end_a: Ints
    end_b: Ints
    ui: Array
    uj: Array  # arm of the end on j that its reaction is about
    ua: Array
    ub: Array
    radius: Array
    first: Array
    last: Array
    parallel: Array  # (k,) 1 or 0
    axis: Array  # (k, d) 0 before the first pose is known
