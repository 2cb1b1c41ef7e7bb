"""Factor by which friction helps a contact that causes it: its force over that without friction, and where it grabs.

Mechanics: docs/theory.md 6.4.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import state
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.analysis.result.kept import kept
from dalembert.arrays import Array, Flags
from dalembert.core.equilibrium import known_sources, load_rows
from dalembert.core.forcing import pair, total_wrench
from dalembert.core.friction.contact_equations import (
    ContactResponse,
    Contacts,
    bearing,
    jacobian,
    response,
    slope,
    strength,
    with_strength,
)

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

NEVER = 1e-9
"""Change of the determinant with a contact's strength, over the determinant, below which it is rounding."""


@kept
def _problem(r: Result) -> ContactResponse:
    """Contact forces without friction, and their change with it, at the present loads."""
    c, s = r.compiled, state(r)
    assert c.contacts is not None
    pose = full_pose(r)
    with np.errstate(all="ignore"):
        w = total_wrench(c.layout, *known_sources(c.layout, c.forcing, pose, s.moving, r.inertia).values())
        w = np.broadcast_to(w, (len(r.status), *w.shape[1:]))
        if c.known.link.size:
            w = w + total_wrench(c.layout, pair(load_rows(c.layout, c.known, pose), r.load_array))
        return response(c.layout, c.contacts, pose, s.solver, w, s.moving.twist)[1]


def self_help(r: Result, e: int) -> tuple[Array, float]:
    """Force of a contact over its value without friction at this contact, and the coefficient at which it grabs.

    The determinant of friction's equations is linear in the strength of one contact; it grabs where that is 0.
    """
    c, problem, f = r.compiled.contacts, _problem(r), r.friction
    assert c is not None
    assert f is not None
    with np.errstate(all="ignore"):
        y = np.where(np.isnan(f.argument), problem.y, f.argument)
        cz = np.nan_to_num(f.cz)
        alone = y - problem.h[..., e] * cz[:, None, [e]]
        helped = np.abs(bearing(c, y)[:, e]) / np.abs(bearing(c, alone)[:, e])
        helped = np.where(np.isnan(f.cz[:, e]), np.nan, helped)
        at = strength(c, 1.0, f.open, f.sense)
        steep = slope(c, y, np.abs(y).max(axis=(-2, -1), initial=0.0))[0]
        factor = _grabbing(c, problem, steep, f.sense, at, e)
    least = np.nanmin(np.where(factor > 0, at[:, e] * factor, np.inf), initial=np.inf)
    return helped, _coefficient(c, e, float(least))


def _grabbing(c: Contacts, problem: ContactResponse, steep: Array, sense: Array, at: Array, e: int) -> Array:
    """Factor (P,) of a contact's strength at which the determinant is 0; not positive where none is."""
    without = at.copy()
    without[:, e] = 0.0
    full, bare = (np.linalg.det(jacobian(with_strength(problem, k), steep, sense)) for k in (at, without))
    change = bare - full
    some: Flags = np.asarray(np.abs(change) > NEVER * np.abs(bare))
    return np.where(some, bare / np.where(some, change, 1.0), 0.0)


def _coefficient(c: Contacts, e: int, strong: float) -> float:
    """Coefficient of friction at which a contact has this strength."""
    if not c.wound[e]:
        return strong / float(c.lever[e])
    if strong >= 2 * (1 - NEVER):
        return math.inf
    grip, wrap, blocks = math.atanh(strong / 2), float(c.wrap[e]), float(c.blocks[e])
    if not blocks:
        return 2 * grip / wrap
    return math.tanh(grip / blocks) / math.tan(wrap / (2 * blocks))
