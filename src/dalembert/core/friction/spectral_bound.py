"""A bound below which the friction of a position has one solution.

Mechanics: docs/theory.md 6.2.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array
from dalembert.core.friction.contact_equations import ContactResponse, Contacts


def levers(contacts: Contacts, h: Array) -> Array:
    """Bounds (..., E, E) of the change of S with what H (..., 3, E, E) is after."""
    lever = np.maximum(np.hypot(h[..., 0, :, :], h[..., 1, :, :]), np.abs(h[..., 2, :, :]))
    if contacts.ball.any():
        lever = np.where(contacts.ball[:, None], np.sqrt((h * h).sum(axis=-3)), lever)
    return np.where(contacts.signed[:, None], np.abs(h[..., 0, :, :]), lever)


def spectral_bound(contacts: Contacts, r: ContactResponse) -> Array:
    """Bound (...) of the spectral radius of the fixed point, from H after z without its sign.

    Below 1 there is one solution, at any smaller scale too.
    """
    power = levers(contacts, r.h)
    log, size = np.zeros(power.shape[:-2]), 1
    for _ in range(6):
        largest = np.maximum(power.sum(axis=-1).max(axis=-1, initial=0.0), 1e-300)
        power = power / largest[..., None, None]
        log = log + np.log(largest) / size
        power, size = power @ power, 2 * size
    return np.asarray(
        np.exp(log + np.log(np.maximum(power.sum(axis=-1).max(axis=-1, initial=0.0), 1e-300)) / size)
    )
