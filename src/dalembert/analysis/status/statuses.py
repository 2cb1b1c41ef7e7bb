"""Status and sentence of every position of an analysis: of all that can be wrong, the first that applies.

Mechanics: docs/theory.md 5.1.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.elements.turning_speeds import speed_checks
from dalembert.analysis.friction.friction_status import (
    Check,
    alone,
    arc,
    friction_checks,
    locking_checks,
    reversal_checks,
)
from dalembert.analysis.status.acceleration_jumps import jump_sentence
from dalembert.analysis.status.brake_verdicts import clamp_checks, helping
from dalembert.analysis.status.closure_failure import open_sentence
from dalembert.analysis.status.cylinder_strokes import stroke_checks
from dalembert.analysis.status.freewheeling import freewheel_checks, grip_checks
from dalembert.analysis.status.lost_contacts import contact_checks
from dalembert.analysis.status.outside_tables import outside, outside_sentence
from dalembert.analysis.status.overflow import FORCES, RATES, fast, not_finite, overflow_sentence, strong
from dalembert.analysis.status.slipping_belts import belt_checks
from dalembert.analysis.status.slipping_ropes import rope_checks
from dalembert.analysis.status.undefined_springs import find_undefined_springs, undefined_sentence
from dalembert.arrays import Array, Flags, Ints
from dalembert.core.rank import singular_below
from dalembert.errors import NUMBERED

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.positions import Positions
    from dalembert.analysis.result.force_arrays import SolvedForces

UNBALANCED = 1e-6
"""Residual above which a position has no equilibrium."""

KEPT = (*NUMBERED, "redundant", "jammed", "at_rest", "undefined_load", "contact_lost", "slips", "slack")
"""Statuses that keep the motion, and the available numbers of the forces."""


def statuses(
    followed: Positions,
    twist: Array,
    acceleration: Array,
    rcond: Array,
    f: SolvedForces,
    forces: bool,
    inertia: bool,
    jumps: Flags | None = None,
) -> tuple[tuple[str, ...], tuple[str | None, ...]]:
    """Status and sentence of each position; ``rcond`` is that of the closure equations, ``forces`` and
    ``inertia`` asked for or not; ``jumps`` (P,) of accelerations."""
    c, path = followed.compiled, followed.path
    assert path is not None
    limit = singular_below(c.layout)
    unbalanced = (f.rcond < limit) | ~(f.residual <= UNBALANCED)
    unheld = np.array([e.residual for e in f.ends] or [np.zeros(len(f.rcond))]) > UNBALANCED
    partial = f.unique is not None and not f.unique.all()
    checks: list[Check] = [
        ("not_assembled", ~path.reached, lambda k: open_sentence(c, path, k)),
        *stroke_checks(c),
        ("singular", ~(rcond >= limit), lambda k: _singular_sentence(c, k)),
    ]
    racing = fast(twist, acceleration)
    checks += [("overflow", racing.any(axis=1), lambda k: overflow_sentence(c, RATES, c.links, racing, k))]
    if forces:
        loaded, held = strong(f), f.rcond >= limit
        pushing = find_undefined_springs(c, path.pose)
        checks += [("undefined_load", pushing.any(axis=-1), lambda k: undefined_sentence(c, pushing, k))]
        checks += speed_checks(c, f)
        checks += [("no_balance", unheld.all(axis=0), lambda k: no_balance_sentence(c, k))]
        checks += clamp_checks(c, twist, f)
        checks += friction_checks(c, f, held)
        checks += [
            ("overflow", not_finite(f) & held, lambda k: overflow_sentence(c, FORCES, c.joints, loaded, k)),
            ("no_balance", unbalanced, lambda k: no_balance_sentence(c, k)),
            *contact_checks(c, path.pose, twist, f, inertia),
            *(belt_checks(c, path.pose, twist, f) if c.mechanism.has_limits else ()),
            *(rope_checks(c, path.pose, f) if c.mechanism.has_limits else ()),
            *grip_checks(c, f),
            *locking_checks(c, f, held),
            ("redundant", np.full(len(f.rcond), partial), lambda k: _redundant_sentence(followed)),
            ("outside_table", outside(c), lambda k: outside_sentence(c, k)),
            *reversal_checks(c, f),
            *freewheel_checks(c, twist),
        ]
    if jumps is not None:
        checks += [("jump", jumps, lambda k: jump_sentence(c, k, arc(c, k)))]
    status = np.full(len(rcond), "ok", dtype=object)
    reasons = np.full(len(rcond), None, dtype=object)
    single = alone(f) if jumps is None else alone(f) | jumps
    for code, mask, sentence in checks:
        where = np.flatnonzero(mask & (status == "ok"))
        status[where] = code
        breaks = (np.diff(where) > 1) | single[where[1:]] | single[where[:-1]]
        for run in np.split(where, np.flatnonzero(breaks) + 1):
            if run.size:
                reasons[run] = sentence(run)
    return tuple(status), tuple(reasons)


SINGULAR = "Dead centre or change point{at}: drive another joint, or step over this position."


def _singular_sentence(c: Compiled, where: Ints) -> str:
    return SINGULAR.format(at=arc(c, where[:1]))


def no_balance_sentence(c: Compiled, where: Ints) -> str:
    """Why the loads have no equilibrium at some positions."""
    known = ", ".join(
        n for n, requested in zip(c.schedule.names, c.known.requested, strict=True) if not requested
    )
    unknown = ", ".join(c.unknown_loads)
    if c.passive:
        links = " or ".join(c.passive)
        holds = "which no force prevents" if c.contacts is None else "more than friction holds"
        return (
            f"The loads have no equilibrium here: they turn {links} about the line of two ball joints, {holds}. "
            "Replace one of them by a universal joint, or move the mass centre onto the line."
        )
    if unknown and (text := helping(c, where)):
        return text
    if unknown:
        why = "it has no power here"
        if c.contacts is not None and c.schedule.moves[where].any():
            why += ", and the friction that it causes does not balance it either"
        elif c.contacts is not None:
            why += ", and friction at rest may have any value within its limits. Give the drive a speed"
        return f"The unknown {unknown} cannot balance the given effort of {known}: {why}."
    return "The loads have no equilibrium here."


def _redundant_sentence(followed: Positions) -> str:
    m = followed.mobility
    assert m is not None
    many = "constraints are" if m.redundant > 1 else "constraint is"
    return (
        f"{m.redundant} {many} redundant among joints {', '.join(m.redundant_joints)}: "
        "reactions that are not unique are left out, their least-norm values given beside."
    )
