"""Points of links at a pose: arms, spans between points of two links, and how they move."""

from __future__ import annotations

import numpy as np

from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array, Index, Ints
from dalembert.core.elements.cam_family import CamRow
from dalembert.core.elements.linings import Lining
from dalembert.core.elements.strand_family import Strand, StrandSum
from dalembert.core.layout import Along, Distance, Gearing, Helix, Meet, Mesh, Pose

Spanning = Meet | Along | Mesh | Distance | Helix | Gearing | Strand | StrandSum | Lining | CamRow
"""Rows between a point of i and a point of j."""


def arm(g: Algebra, pose: Pose, link: Index, u: Array) -> Array:
    """Ground components of link vectors u (..., k, d)."""
    rotated: Array = g.rotate(pose.rotation[..., link, :], u)
    return rotated


def span(g: Algebra, f: Spanning, pose: Pose) -> Array:
    """P_j - P_i."""
    pi, pj = pose.point[..., f.i, :], pose.point[..., f.j, :]
    return np.asarray((pj + arm(g, pose, f.j, f.uj)) - (pi + arm(g, pose, f.i, f.ui)))


def point_motion(g: Algebra, pose: Pose, twist: Array, link: Ints, r: Array) -> tuple[Array, Array]:
    """Velocity, and acceleration at zero link accelerations, of the points with arms r."""
    v, w = twist[..., link, : g.d], twist[..., link, g.d :]
    return v + g.spin(w, r), g.centripetal(w, r)


def span_motion(g: Algebra, f: Spanning, pose: Pose, twist: Array) -> tuple[Array, Array]:
    """First and second rate of P_j - P_i, the second at zero link accelerations."""
    vi, ai = point_motion(g, pose, twist, f.i, arm(g, pose, f.i, f.ui))
    vj, aj = point_motion(g, pose, twist, f.j, arm(g, pose, f.j, f.uj))
    return vj - vi, aj - ai
