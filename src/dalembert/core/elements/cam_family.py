"""The row of a cam on a follower: its numbers."""

from __future__ import annotations

from dataclasses import dataclass

from dalembert.arrays import Array, Ints

SLIDES, SWINGS, FLAT, FLAT_SWINGS = range(4)
"""Forms of followers: a point that slides or swings, a flat face that slides or swings."""


@dataclass(frozen=True)
class CamRow:
    """A follower on link j on the cam of link i, about i's point.

    A point follower is at the distance rho from the cam's axis, in the direction beta of the cam; a flat one has the
    distance rho along its outward ``normal`` (in j's axes), and is turned by beta. Its motion gives the coordinate
    q(rho) and the turn of the cam A(rho) - beta at which it would reach this place on the link that carries both.
    Measure: q - base - Q(sense (A - beta)), with the lift Q of ``curve``, over the size of its gradient: the gap along
    the normal.

    form SLIDES: a the offset, gamma the direction of the stem on the carrier; SWINGS: a the arm, b the distance of the
    axes, gamma the direction of the follower's axis; FLAT: a the cosine between face normal and slide; FLAT_SWINGS: a
    the distance of the face from the follower's axis, b that of the axes. sigma: 1 where lift turns the follower
    counter-clockwise, else -1.
    """

    row: Ints
    i: Ints
    j: Ints
    ui: Array
    uj: Array
    form: Ints  # (k,) SLIDES, SWINGS, FLAT or FLAT_SWINGS
    normal: Array  # (k, 2)
    sense: Array  # (k,)
    base: Array
    a: Array
    b: Array
    gamma: Array
    sigma: Array
    curve: Array  # (k, N, W) pieces of the lift, as ``cam_curves`` has them


@dataclass(frozen=True)
class CamGap(CamRow):
    """The gap of a follower off its cam, along its path: a freedom, whose wrench is not of unit size."""


@dataclass(frozen=True)
class CamSlip(CamRow):
    """Sliding of a knife edge or a face on the cam, along the tangent: a rate without a measure."""
