"""Gyroscopic couples as the books show them: what turns a rotor's angular momentum about with its carrier.

Mechanics: docs/theory.md 10.1.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.inertia_couples import turning
from dalembert.answer.equality import Compared
from dalembert.arrays import Array
from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


@dataclass(frozen=True, eq=False)
class Gyroscopic(Compared):
    """Spin (P,) of a rotor about its axis (P, 3), precession (P, 3) of its carrier across it, rad/s, and the couple.

    ``couple`` (P, 3), N m, is C = I_s w_s (w_p x e) on the rotor; the frame takes -C. ``exact`` (P, 3): the total rate
    of the rotor's angular momentum, including the terms of accelerations and of an inclined axis.

    >>> import dalembert as da
    >>> g = da.gyroscopic(da.dynamics(da.rotating_shaft()), "shaft")
    >>> g.spin.shape, g.couple.shape
    ((72,), (72, 3))
    """

    result: Result = field(repr=False)
    rotor: str
    carrier: str
    axis: Array = field(repr=False)
    spin: Array = field(repr=False)
    precession: Array = field(repr=False)
    couple: Array = field(repr=False)
    exact: Array = field(repr=False)

    def bearing_force(self, apart: float) -> Array:
        """Size of the pair of bearing forces (P,), N, that the couple is, for bearings so far apart, m."""
        require("distance of the bearings", apart)
        return np.asarray(np.linalg.norm(self.couple, axis=1) / apart)


def gyroscopic(r: Result, rotor: str, carrier: str = GROUND) -> Gyroscopic:
    """The gyroscopic couple of a link in space that spins in a carrier which itself turns.

    The axis e is that of the spin relative to the carrier, I_s the rotor's inertia about it, w_s its total spin along
    it, w_p the carrier's turning across it. Raises ModelError in the plane, and where the rotor does not spin.

    >>> import dalembert as da
    >>> m = da.rotating_shaft()
    >>> g = gyroscopic(da.dynamics(m), next(n for n in m.links if n != "ground"))
    >>> g.couple.shape
    (72, 3)
    """
    if r.mechanism.dimension == 2:
        raise ModelError(
            "a gyroscopic couple is perpendicular to its rotor's axis; a planar mechanism has none",
            "use space",
        )
    still = np.zeros((len(r.status), 3))
    w, held = r.speed(rotor), still if carrier == GROUND else r.speed(carrier)
    relative = w - held
    size = np.linalg.norm(relative, axis=1)
    if not (size > 0).all():
        raise ModelError(
            f"{rotor} does not spin in {carrier} everywhere", "drive it, or name another carrier"
        )
    e = relative / size[:, None]
    motion, turned = turning(r, rotor), r.rotation(rotor)
    axis = (np.swapaxes(turned, 1, 2) @ e[..., None])[..., 0]
    inertia = np.einsum("pi,ij,pj->p", axis, motion.inertia, axis)
    spin = (w * e).sum(axis=1)
    precession = held - (held * e).sum(axis=1)[:, None] * e
    couple = (inertia * spin)[:, None] * np.cross(precession, e)
    exact = (turned @ (motion.rate + motion.gyroscopic)[..., None])[..., 0]
    return Gyroscopic(r, rotor, carrier, e, spin, precession, couple, exact)
