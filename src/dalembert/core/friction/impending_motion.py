"""What friction can hold: the extremes of an effort where contacts have no relative rate to tell their sense.

A contact that would move with the unknown has the sense of that impending motion; its influence on the unknown says
which (virtual work: g = minus the relative rate per unit of the unknown's own). One that would not only loads the
others; it takes the sense that carries the unknown furthest.

g   change of the unknown with a unit of each contact (..., E)
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.core.friction.contact_equations import (
    STILL,
    Contacts,
    Response,
    Senses,
    argument,
    impending,
    jacobian,
    moving_together,
    sign,
    slope,
    strong,
)
from dalembert.core.friction.friction_solver import Slip, slipping
from dalembert.core.friction.rod_spin import Spins, solve_spins
from dalembert.core.linear import solve_square

ROUNDS = 12
"""Changes of the senses of contacts without impending motion after which the last is taken."""


class Extreme(NamedTuple):
    """The solution at one end, and the sense (P, E) of each contact there: 0 where friction plays no part."""

    slip: Slip
    sense: Array


def extreme(
    layout: Any,
    contacts: Contacts,
    r: Response,
    known: Senses,
    unknown: int,
    end: float,
    spins: Spins | None = None,
) -> Extreme:
    """The lowest (end -1) or highest (end 1) value of one of the multipliers; rods between balls spin as they must."""
    g = np.broadcast_to(r.change[..., unknown, :], known.sense.shape)
    row = np.zeros(0, np.intp) if spins is None else spins.rods.row
    held = np.zeros(known.sense.shape)

    def senses_at(phi: Array) -> tuple[Array, Flags]:
        """Senses where the rods spin at phi, and the contacts that do not move."""
        rate = g if spins is None else g + spins.spin_rates(r, g, phi)
        size = np.abs(rate) * np.where(contacts.rows.angular, layout.length, 1.0)
        moves = (size > STILL * size.max(axis=-1, keepdims=True, initial=0.0))[..., contacts.led]
        still = known.open & ~moving_together(contacts, moves)
        sense = np.where(known.open, end * impending(contacts, rate, moves), known.sense)
        if spins is not None:
            sense = np.where(known.open, sense, spins.told(phi).sense)
        return np.where(still, held, sense), still

    def moment(phi: Array) -> Array:
        return np.nan_to_num(slipping(contacts, r, senses_at(phi)[0], known.open).x[..., row])

    for _ in range(ROUNDS):
        sense, idle = senses_at(solve_spins((len(g), len(row)), moment))
        found = slipping(contacts, r, sense, known.open)
        if not idle.any():
            break
        new = np.where(idle, -end * _influence(contacts, r, found, sense, g)[..., contacts.led], 0.0)
        if np.array_equal(new, held):
            break
        held = new
    return Extreme(found, sense)


def _influence(contacts: Contacts, r: Response, found: Slip, sense: Array, g: Array) -> Array:
    """Sign of the change of the unknown with each friction force, the other contacts following."""
    y = argument(r, found.c * np.nan_to_num(found.z))
    largest = np.abs(y).max(axis=(-2, -1), initial=0.0)
    j = jacobian(strong(r, found.c), slope(contacts, y, largest)[0], sense)
    a = solve_square(np.swapaxes(j, -1, -2), found.c * g)
    negligible = np.abs(a) <= STILL * np.abs(a).max(axis=-1, keepdims=True, initial=0.0)
    return sign(contacts, np.nan_to_num(a), negligible)
