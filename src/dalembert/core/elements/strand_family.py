"""The rows of ropes: straight strands between points or wheels of two links."""

from __future__ import annotations

from dataclasses import dataclass

from dalembert.arrays import Array, Ints


@dataclass(frozen=True)
class StrandSum:
    """Half the length of both strands of a belt between wheels of signed radii: a unit pulls their centres apart by
    the cosine of the strands' angle to the line of centres."""

    row: Ints
    i: Ints
    j: Ints
    ui: Array
    uj: Array
    ri: Array
    rj: Array


@dataclass(frozen=True)
class Strand:
    """A straight strand of a rope from link i to link j, tangent to their circles of signed radii about two points.

    A radius is positive where the strand touches on its left side, 0 at a point. Measure
    -(l - (ri - rj) psi + wi theta_i - wj theta_j), with l the strand's length, psi its angle from ``zero`` and w the
    length of rope that a radian of the link winds: the radius, or any length for a pulley that is a point. The
    multiplier is the tension. Where ``axis`` is not 0 the strand keeps this direction in ground axes, and l is the
    coordinate along it.
    """

    row: Ints
    rope: Ints  # (k,) number of the rope
    i: Ints
    j: Ints
    ui: Array
    uj: Array
    ri: Array
    rj: Array
    wi: Array
    wj: Array
    axis: Array  # (k, d)
    zero: Array  # (k, d) unit vector
