"""Rows of gear teeth in space.

Mechanics: docs/theory.md 2.2.
"""

from __future__ import annotations

from dataclasses import dataclass

from dalembert.arrays import Array, Ints


@dataclass(frozen=True)
class Teeth:
    """In space: teeth of wheels i and j that meet at their pitch point C = P_i + ri e_i = P_j + rj e_j.

    e is the direction from a wheel's axis a to C, across a along
    way[0] (P_j - P_i) + way[1] a_other + way[2] a_i x a_j
    (one of them, for parallel, intersecting, or skew axes); a radius is negative where e points away
    from C. The force of the teeth on j per unit of multiplier is n, across their trace in the tangent plane at C:
    n = cos(helix) sgn(ri) a_i x e_i - sin(helix) (cone[0] a_i + cone[1] e_i). Measure ki psi_i - kj psi_j, with psi the
    angle of e in the wheel from its direction b, whole turns counted at ``count``, and k = r (a x e) . n.

    ``outward`` is 1 where separation pushes j away from the axis of i, -1 in a ring wheel i; way, cone, outward, ki
    and kj are those of the first pose (``core.gear_rows.mesh_wheels``).
    """

    row: Ints
    i: Ints
    j: Ints
    ui: Array
    uj: Array
    ai: Array
    aj: Array
    bi: Array
    bj: Array
    ri: Array
    rj: Array
    helix: Array
    direction: Array  # (k, 3)
    cone: Array  # (k, 2)
    outward: Array
    ki: Array
    kj: Array
    count: Ints  # (k, 2)


@dataclass(frozen=True)
class Gearing(Teeth):
    """The constraint of teeth: the force across their trace."""


@dataclass(frozen=True)
class ToothForce(Teeth):
    """A force on j at C: ``along`` (k, 2) the teeth's trace, where they slide on each other, and pushing j away."""

    along: Array


@dataclass(frozen=True)
class ToothCouple(Teeth):
    """A couple on j along the generator of the pitch cones, about which the wheels turn on each other."""
