"""Impending motion: the lowest and the highest effort at which friction at its limit still holds a machine at rest.

At rest no relative rate gives the contacts their senses. One that would move with the effort has the sense of that
motion, by virtual work: g, the change of the effort with a unit of friction, is minus the rate of the contact per unit
of the effort's rate. One that would not move only loads the others; it takes the sense that carries the effort
furthest. An effort that no friction changes has one value, with no friction at its limit.

g   change of the unknown with a unit of each contact (..., E)

Mechanics: docs/theory.md 6.3.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.core.friction.contact_equations import (
    STILL,
    ContactResponse,
    Contacts,
    SlipState,
    argument,
    group_moves,
    impending_senses,
    jacobian,
    sign,
    slope,
    with_strength,
)
from dalembert.core.friction.friction_solver import FrictionSolution, solve_friction
from dalembert.core.friction.rod_spin import SpinningRods, solve_spins
from dalembert.core.layout import Layout
from dalembert.core.linear import solve_square

ROUNDING = 1e-13
"""Part of the largest change of any force beside which the change of an effort with friction is rounding."""

ROUNDS = 12
"""Changes of the senses of contacts without impending motion after which the last senses are accepted."""


def extreme(
    layout: Layout,
    contacts: Contacts,
    r: ContactResponse,
    known: SlipState,
    unknown: int,
    end: float,
    rods: SpinningRods | None = None,
) -> FrictionSolution:
    """Solution with the lowest (end -1) or highest (end 1) value of one of the multipliers, and its senses: 0 where
    friction has no effect. Rods between balls take the spin that equilibrium requires."""
    g = np.broadcast_to(_change(layout, contacts, r, unknown), known.sense.shape)
    row = np.zeros(0, np.intp) if rods is None else rods.row
    held = np.zeros(known.sense.shape)

    def state(phi: Array) -> tuple[SlipState, Flags]:
        """Senses where the rods spin at phi, and the contacts that do not move."""
        rate = g if rods is None else g + rods.spin_rates(r, g, phi)
        size = np.abs(rate) * np.where(contacts.rows.angular, layout.length, 1.0)
        moves = (size > STILL * size.max(axis=-1, keepdims=True, initial=0.0))[..., contacts.leader]
        still = known.open & ~group_moves(contacts, moves)
        known_sense = known.sense if rods is None else rods.senses(phi).sense
        sense = np.where(known.open, end * impending_senses(contacts, rate, moves), known_sense)
        return known._replace(sense=np.where(still, held, sense)), still

    def moment(phi: Array) -> Array:
        return np.nan_to_num(solve_friction(contacts, r, state(phi)[0]).x[..., row])

    for _ in range(ROUNDS):
        now, idle = state(solve_spins((len(g), len(row)), moment))
        solution = solve_friction(contacts, r, now)
        if not idle.any():
            break
        new = np.where(idle, -end * _influence(contacts, r, solution, g)[..., contacts.leader], 0.0)
        if np.array_equal(new, held):
            break
        held = new
    return solution


def _change(layout: Layout, contacts: Contacts, r: ContactResponse, unknown: int) -> Array:
    """Change g of an unknown with a unit of each contact; none where it is rounding beside that of the others."""
    size = np.abs(r.change) * np.where(contacts.rows.angular, layout.length, 1.0) / layout.row_scale[:, None]
    least = ROUNDING * size.max(axis=(-2, -1), initial=0.0)[..., None]
    one = size[..., unknown, :].max(axis=-1, keepdims=True, initial=0.0)
    return np.where(one > least, r.change[..., unknown, :], 0.0)


def _influence(contacts: Contacts, r: ContactResponse, solution: FrictionSolution, g: Array) -> Array:
    """Sign of the change of the unknown with each friction force, with the other contacts following."""
    y = argument(r, solution.c * np.nan_to_num(solution.z))
    largest = np.abs(y).max(axis=(-2, -1), initial=0.0)
    j = jacobian(with_strength(r, solution.c), slope(contacts, y, largest)[0], solution.state.sense)
    a = solve_square(np.swapaxes(j, -1, -2), solution.c * g)
    negligible = np.abs(a) <= STILL * np.abs(a).max(axis=-1, keepdims=True, initial=0.0)
    return sign(contacts, np.nan_to_num(a), negligible)
