"""Friction forces for known senses of slip: semi-smooth Newton (Qi and Sun, 1993), all positions at once.

Newton starts from no friction. Where the map from bearing forces to friction to bearing forces is a contraction
(``spectral_bound`` below 1) there is one solution. Elsewhere there may be several; the physical one is computed by
continuation (Allgower and Georg, 1990): the scale of all coefficients goes from 0 to 1 in steps, with the determinant
of the equations kept positive. Where that branch ends, at the critical scale, the mechanism jams.

Mechanics: docs/theory.md 6.2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, at
from dalembert.core.friction.contact_equations import (
    ContactResponse,
    Contacts,
    SlipState,
    argument,
    bearing,
    correction,
    jacobian,
    multiplier,
    repeat,
    slope,
    strength,
    with_strength,
)
from dalembert.core.friction.spectral_bound import spectral_bound
from dalembert.core.linear import solve_square

NEWTON = 25
"""Steps after which Newton has failed."""

ARRIVED = 1e-13
"""Change of a force, relative to the largest, at which Newton has converged."""

ROUNDING = 1e-15
"""Convergence also holds where the residual, relative to the largest force and by contact, is rounding error: at the
end of the branch the changes do not fall below it times the condition number."""

LONGEST = 0.1
"""Largest step of the friction scale."""

BENT = 0.2
"""Largest distance between Newton's solution and the landing point of its first step, over the length of that step."""

SHORT = 1e-3
"""Changes below this fraction of the largest friction force may exceed it: the branch has a kink."""

SMALLEST = 1e-10
"""Step of the friction scale below which the branch has ended."""

LOST = 1e9
"""Condition number of friction's equations at which the branch has ended: forces would have lost nine digits."""


class FrictionSolution(NamedTuple):
    """Friction in one state of the contacts: z (P, E), c (P, E), the multipliers x (P, X), and the outcome.

    determinant: det(A + J) / det(A); critical: friction scale where the branch ends, NaN where it does not before 1;
    single: proved to be the only solution; locked: friction reverses the power of the unknowns.
    """

    state: SlipState
    z: Array
    c: Array
    x: Array
    determinant: Array
    critical: Array
    single: Flags
    locked: Flags


class NewtonResult(NamedTuple):
    """Result of Newton's method; near: it ended close to where its first step landed, and that step passed no singular
    point."""

    z: Array
    arrived: Flags
    determinant: Array
    near: Flags


def without_friction(contacts: Contacts, r: ContactResponse) -> Array:
    """Multipliers (P, X) without friction; the teeth's separation stays."""
    if not contacts.fixed.any():
        return r.x
    sense = np.broadcast_to(np.where(contacts.fixed, -1.0, 0.0), r.y.shape[:-2] + r.y.shape[-1:])
    c = np.broadcast_to(strength(contacts, 0.0), sense.shape)
    return multiplier(r, c * newton(contacts, r, sense, c, np.zeros_like(sense)).z)


def solve_friction(contacts: Contacts, r: ContactResponse, state: SlipState) -> FrictionSolution:
    """Friction at each position of known senses; contacts of the ``state`` that are open have coefficients at rest."""
    sense, resting = state.sense, state.open
    r = repeat(r, len(sense))
    c = np.broadcast_to(strength(contacts, 1.0, resting, sense), sense.shape)
    first = newton(contacts, r, sense, c, np.zeros_like(sense))
    single = spectral_bound(contacts, with_strength(r, c * np.abs(sense))) < 1
    z, determinant = first.z, first.determinant
    critical = np.full(len(sense), np.nan)
    finite = np.isfinite(r.y).all(axis=(-2, -1))
    rest = np.flatnonzero(~(first.arrived & single) & finite)
    if rest.size:
        part, scale = _follow_branch(contacts, at(r, rest), sense[rest], resting[rest])
        z[rest], determinant[rest] = part.z, part.determinant
        critical[rest] = np.where(part.arrived, np.nan, scale)
        z[rest[~part.arrived]] = np.nan
    solved = np.flatnonzero(np.isfinite(z).all(axis=-1))
    ended = solved[_condition(contacts, at(r, solved), sense[solved], c[solved], z[solved]) > LOST]
    critical[ended], z[ended] = 1.0, np.nan
    x, locked = multiplier(r, c * z), np.zeros(len(sense), bool)
    return FrictionSolution(state, z, c, x, determinant, critical, single, locked)


def _condition(contacts: Contacts, r: ContactResponse, sense: Array, c: Array, z: Array) -> Array:
    """Condition number of the forces z for errors of the terms (Skeel, 1979); infinite if they are singular."""
    r = with_strength(r, c)
    y = argument(r, z)
    equations = jacobian(r, slope(contacts, y, _largest(y))[0], sense)
    unit = np.eye(sense.shape[-1])
    singular = np.linalg.det(equations) == 0
    inverse = np.linalg.inv(np.where(singular[:, None, None], unit, equations))
    size = np.abs(z)
    terms = np.abs(inverse) @ (np.abs(equations - unit) + unit) @ size[..., None]
    largest = size.max(axis=-1, initial=0.0)
    grown = terms[..., 0].max(axis=-1, initial=0.0) / np.where(largest > 0, largest, 1.0)
    return np.where(singular, np.inf, grown)


def roots(contacts: Contacts, r: ContactResponse, sense: Array, starts: Array) -> tuple[Array, Array, Array]:
    """Limits of Newton's method from many starts (P, E): c z, multipliers and determinants of those that converge."""
    c = np.broadcast_to(strength(contacts, 1.0, sense=sense), sense.shape)
    arrivals = newton(contacts, r, sense, c, starts, most=4 * NEWTON)
    cz = (c * arrivals.z)[arrivals.arrived]
    return cz, multiplier(at(r, arrivals.arrived), cz), arrivals.determinant[arrivals.arrived]


def newton(
    contacts: Contacts,
    r: ContactResponse,
    sense: Array,
    c: Array,
    z: Array,
    before: Array | None = None,
    most: int = NEWTON,
) -> NewtonResult:
    """Newton on z + s S(y0 + H c z) = 0 from z, all positions together.

    S is homogeneous: S = slope . y. The first step takes the slope at ``before``, the arguments of a nearby solution,
    rather than at the start, which may be beyond a kink.
    """
    arrived = np.zeros(len(sense), bool)
    r = with_strength(r, c)
    start, y = z, argument(r, z)
    kink = y if before is None else before
    for k in range(most):
        steep, _ = slope(contacts, kink, _largest(kink))
        step = correction(r, steep, sense, z + sense * (steep * y).sum(axis=-2), solve_square)
        z = np.where(arrived[:, None], z, z + step)
        if k == 0:
            first, landing = steep, z
        kink = y = argument(r, z)
        largest = np.maximum(_largest(y), np.abs(z).max(axis=-1, initial=0.0))
        new = np.abs(z + sense * bearing(contacts, y)).max(axis=-1, initial=0.0)
        now = (new <= ROUNDING * contacts.count * largest) | (
            np.abs(step).max(axis=-1, initial=0.0) <= ARRIVED * largest
        )
        arrived |= now
        if arrived.all():
            break
    steep, _ = slope(contacts, y, _largest(y))
    determinant = np.linalg.det(np.nan_to_num(jacobian(r, steep, sense)))
    near = arrived
    if before is not None:
        ahead = np.linalg.det(np.nan_to_num(jacobian(r, first, sense)))
        near = arrived & (ahead > 0) & _goes_on(start, landing, z)
    return NewtonResult(np.where(arrived[:, None], z, np.nan), arrived, determinant, near)


def _largest(y: Array) -> Array:
    return np.asarray(np.abs(y).max(axis=(-2, -1), initial=0.0))


def _follow_branch(
    contacts: Contacts, r: ContactResponse, sense: Array, resting: Array
) -> tuple[NewtonResult, Array]:
    """The branch from scale 0 to 1 and the scale it reaches."""
    count = len(sense)
    scale, step = np.zeros(count), np.full(count, LONGEST)
    c = np.array(np.broadcast_to(strength(contacts, 0.0), sense.shape))
    start = newton(contacts, r, sense, c, np.zeros_like(sense))
    z, determinant = start.z, start.determinant
    while True:
        on = np.flatnonzero((scale < 1) & (step > SMALLEST))
        if not on.size:
            break
        aim = np.minimum(scale[on] + step[on], 1.0)
        part, raised = at(r, on), strength(contacts, aim[:, None], resting[on], sense[on])
        before = argument(part, c[on] * z[on])
        new = newton(contacts, part, sense[on], raised, z[on], before, 10)
        good = new.near & (new.determinant > 0)
        kept = on[good]
        z[kept], determinant[kept] = new.z[good], new.determinant[good]
        scale[kept], c[kept] = aim[good], raised[good]
        step[on] = np.where(good, np.minimum(2 * step[on], LONGEST), step[on] / 2)
    return NewtonResult(z, scale >= 1, determinant, scale >= 1), scale


def _goes_on(start: Array, landing: Array, end: Array) -> Flags:
    """True where Newton ended close to where its first step landed, or hardly moved."""
    first, more, size = (np.abs(a).max(axis=-1, initial=0.0) for a in (landing - start, end - landing, end))
    return np.asarray((more <= BENT * first) | (first + more <= SHORT * size))
