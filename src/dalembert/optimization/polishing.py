"""One design at a time by sequential quadratic programming (SLSQP), with a constraint row for every position.

A peak is not a smooth function, but its minimum is the least t with -t <= T_k <= t at all positions k.

Mechanics: docs/theory.md 11.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.optimization.design_problem import DesignProblem, Margins
from dalembert.optimization.optimizers import OPEN, polish_by


@dataclass
class _Design:
    """One design as an SLSQP problem: x are its free numbers u in the unit box, and for a peak t over its
    usual size."""

    p: DesignProblem
    u: Array
    free: Flags
    last: tuple[bytes, Margins] | None = None

    @property
    def peak(self) -> bool:
        return self.p.aim.word == "peak"

    def place(self, x: Array) -> Array:
        """All numbers."""
        place = self.u.copy()
        place[self.free] = np.clip(x[: self.free.sum()], 0.0, 1.0)
        return place

    def rows(self, x: Array) -> Margins:
        """Quantity and margins at every position, cached for the last x, since values and slopes are
        evaluated in turn."""
        place = self.place(x)
        if self.last is None or self.last[0] != place.tobytes():
            self.last = place.tobytes(), self.p.at(place)
        return self.last[1]

    def room(self, x: Array) -> Array:
        """Functions that must not be negative: margins, and t plus and minus the aim's quantity."""
        r = self.rows(x)
        parts = [(r.margin / self.p.sizes[:, None])[self.p.rows_of_margins]]
        if self.peak:
            parts += [x[-1] - r.aim / self.p.scale, x[-1] + r.aim / self.p.scale]
        return np.nan_to_num(np.concatenate(parts), nan=-OPEN)

    def room_slope(self, x: Array) -> Array:
        r = self.rows(x)
        part = (r.margin_slope / self.p.sizes[:, None, None])[self.p.rows_of_margins][:, self.free]
        if self.peak:
            sides = r.aim_slope[:, self.free] / self.p.scale
            one = np.ones((len(sides), 1))
            part = np.hstack([part, np.zeros((len(part), 1))])
            part = np.vstack([part, np.hstack([-sides, one]), np.hstack([sides, one])])
        return np.nan_to_num(part)

    def aim(self, x: Array) -> tuple[float, Array]:
        """The aim and its gradient: for a peak, of t itself."""
        if self.peak:
            return float(x[-1]), np.eye(len(x))[-1]
        value, slope = self.p.sharp(self.place(x))
        if not np.isfinite(value):
            return OPEN, np.zeros(len(x))
        return value / self.p.scale, slope[self.free] / self.p.scale


def polish(p: DesignProblem, u: Array, free: Flags | None = None) -> Array:
    """A better point than u (number,) in the unit box; numbers that are not free stay. Returns u itself if none is
    better."""
    d = _Design(p, u, np.ones(len(u), bool) if free is None else free)
    if not d.free.any():
        return u
    start = u[d.free]
    high = np.ones(len(start))
    if d.peak:
        start = np.append(start, np.nanmax(np.abs(d.rows(start).aim), initial=0.0) / p.scale)
        high = np.append(high, np.inf)
    rules = (d.room, d.room_slope) if d.peak or p.conditions else None
    x = polish_by(p.method, d.aim, rules, start, high)
    return d.place(x) if np.isfinite(x).all() else u
