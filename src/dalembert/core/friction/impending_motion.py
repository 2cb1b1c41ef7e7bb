"""What friction can hold: the extremes of an effort where contacts have no relative rate to tell their sense.

A contact that would move with the unknown has the sense of that impending motion; its influence on the unknown says
which (virtual work: g = minus the relative rate per unit of the unknown's own). One that would not only loads the
others; it takes the sense that carries the unknown furthest.

g   change of the unknown with a unit of each contact (..., E)
"""

from __future__ import annotations

from typing import Any

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.core.friction.contact_equations import (
    STILL,
    Contacts,
    Response,
    SlipState,
    argument,
    impending,
    jacobian,
    moving_together,
    sign,
    slope,
    strong,
)
from dalembert.core.friction.friction_solver import FrictionSolution, slipping
from dalembert.core.friction.rod_spin import SpinningRods, solve_spins
from dalembert.core.linear import solve_square

ROUNDS = 12
"""Changes of the senses of contacts without impending motion after which the last is taken."""


def extreme(
    layout: Any,
    contacts: Contacts,
    r: Response,
    known: SlipState,
    unknown: int,
    end: float,
    rods: SpinningRods | None = None,
) -> FrictionSolution:
    """The solution with the lowest (end -1) or highest (end 1) value of one of the multipliers, and its senses: 0 where
    friction plays no part. Rods between balls spin as they must."""
    g = np.broadcast_to(r.change[..., unknown, :], known.sense.shape)
    row = np.zeros(0, np.intp) if rods is None else rods.row
    held = np.zeros(known.sense.shape)

    def state(phi: Array) -> tuple[SlipState, Flags]:
        """Senses where the rods spin at phi, and the contacts that do not move."""
        rate = g if rods is None else g + rods.spin_rates(r, g, phi)
        size = np.abs(rate) * np.where(contacts.rows.angular, layout.length, 1.0)
        moves = (size > STILL * size.max(axis=-1, keepdims=True, initial=0.0))[..., contacts.led]
        still = known.open & ~moving_together(contacts, moves)
        told = known.sense if rods is None else rods.senses(phi).sense
        sense = np.where(known.open, end * impending(contacts, rate, moves), told)
        return known._replace(sense=np.where(still, held, sense)), still

    def moment(phi: Array) -> Array:
        return np.nan_to_num(slipping(contacts, r, state(phi)[0]).x[..., row])

    for _ in range(ROUNDS):
        now, idle = state(solve_spins((len(g), len(row)), moment))
        found = slipping(contacts, r, now)
        if not idle.any():
            break
        new = np.where(idle, -end * _influence(contacts, r, found, g)[..., contacts.led], 0.0)
        if np.array_equal(new, held):
            break
        held = new
    return found


def _influence(contacts: Contacts, r: Response, found: FrictionSolution, g: Array) -> Array:
    """Sign of the change of the unknown with each friction force, the other contacts following."""
    y = argument(r, found.c * np.nan_to_num(found.z))
    largest = np.abs(y).max(axis=(-2, -1), initial=0.0)
    j = jacobian(strong(r, found.c), slope(contacts, y, largest)[0], found.state.sense)
    a = solve_square(np.swapaxes(j, -1, -2), found.c * g)
    negligible = np.abs(a) <= STILL * np.abs(a).max(axis=-1, keepdims=True, initial=0.0)
    return sign(contacts, np.nan_to_num(a), negligible)
