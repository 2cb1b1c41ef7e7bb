"""Fixed-point iteration of friction as a table, the textbook method: solve, set friction by the reactions, solve
again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.joint_friction import friction_of, unknown_names
from dalembert.arrays import Array
from dalembert.core.equilibrium import known_sources, motion, statement
from dalembert.core.forcing import total_wrench
from dalembert.core.friction.contact_equations import (
    SlipState,
    argument,
    bearing,
    multiplier,
    response,
    strength,
)
from dalembert.core.rank import singular_below
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.core.friction.contact_equations import ContactResponse, Contacts


@dataclass(frozen=True)
class FixedPoint:
    """Steps of the iteration at one position; step 0 is without friction.

    unknowns: name -> its value at each step; friction: joint and kind -> force (N) or couple (N m) on j at each step
    change: largest change of a friction force at each step, by the largest force; rate: what a step leaves of it, at
    the end; below 1 it converges; arrived: whether it did
    """

    unknowns: dict[str, Array]
    friction: dict[str, Array]
    change: Array
    rate: float
    arrived: bool

    @property
    def steps(self) -> int:
        """Steps made."""
        return len(self.change) - 1

    def rows(self) -> list[list[float]]:
        """The table: step, unknowns, friction, change."""
        columns = [np.arange(len(self.change)), *self.unknowns.values(), *self.friction.values(), self.change]
        return [[float(v) for v in row] for row in zip(*columns, strict=True)]


def fixed_point(r: Result, position: int = 0, most: int = 1000, tolerance: float = 1e-12) -> FixedPoint:
    """The iteration at one position of a result with friction (counted from 0).

    It converges more slowly with larger mu r / l and may diverge where a solution exists. It is for reading; the answer
    is computed otherwise.

    >>> import dalembert as da
    >>> m = da.slider_crank().with_values({"joints.B.friction": {"coefficient": 0.1, "radius": "10 mm"}})
    >>> fixed_point(da.statics(m), position=5).arrived
    True
    """
    contacts, problem, sense = contacts_in_motion(r, position)
    c = strength(contacts, 1.0, sense=sense)
    z = np.where(contacts.fixed, -sense * bearing(contacts, problem.y), 0.0)
    x, forces, change = [problem.x[0]], [(c * z)[0]], [np.nan]
    for _ in range(most):
        new = -sense * bearing(contacts, argument(problem, c * z))
        size = np.abs(problem.y).max() + np.abs(new).max()
        change.append(float(np.abs(new - z).max() / size))
        z = new
        x.append(multiplier(problem, c * z)[0])
        forces.append((c * z)[0])
        if change[-1] <= tolerance or not np.isfinite(change[-1]) or np.abs(z).max() > 1e12 * size:
            break
    changes = np.array(change)
    arrived = bool(changes[-1] <= tolerance)
    return FixedPoint(
        _unknowns(r, np.array(x)), _forces(r, contacts, np.array(forces)), changes, _rate(changes), arrived
    )


def _rate(change: Array) -> float:
    """Ratio by which a step reduces the change, over the last five."""
    last = change[1:][-6:]
    return float((last[-1] / last[0]) ** (1 / (len(last) - 1))) if len(last) > 1 and last[0] > 0 else 0.0


def contacts_in_motion(r: Result, position: int) -> tuple[Contacts, ContactResponse, Array]:
    """Contacts, their response and senses (1, E) at one position; refused at rest."""
    contacts, problem, slip = contacts_at(r, position)
    if slip.open.any():
        what = "the machine is at rest here: the senses of friction are not given"
        raise ModelError(what, "give the drive a speed")
    return contacts, problem, slip.sense


def contacts_at(r: Result, position: int) -> tuple[Contacts, ContactResponse, SlipState]:
    """The same, at rest too."""
    from dalembert.analysis.one_pass import slice_forcing
    from dalembert.analysis.result.joint_freedoms import full_pose

    f, contacts = friction_of(r)
    c, part = r.compiled, slice(position, position + 1)
    pose = full_pose(r, part)
    forcing, known = slice_forcing(c, part)
    moving, rows, solver = motion(c.layout, pose, r.schedule.speed[part], r.schedule.acceleration[part])
    sources = known_sources(c.layout, forcing, pose, moving, r.inertia)
    w = total_wrench(c.layout, *sources.values())
    w = np.broadcast_to(w, (1, *w.shape[1:]))
    stated = statement(c.layout, known, pose, rows, solver, w)
    if (stated.forces.rcond < singular_below(c.layout)).any():
        what = f"{' and '.join(c.unknown_loads)}: only friction balances the given effort: no start exists"
        raise ModelError(what, "give the load and leave the effort unknown")
    _, problem = response(c.layout, contacts, pose, stated.forces, stated.w, moving.twist)
    return contacts, problem, SlipState(f.sense[part], f.open[part], f.rate[part])


def _unknowns(r: Result, x: Array) -> dict[str, Array]:
    return dict(zip(unknown_names(r), x[:, r.compiled.layout.constraints.count :].T, strict=True))


def _forces(r: Result, contacts: Contacts, cz: Array) -> dict[str, Array]:
    names = [f"{r.joints[k]} {kind}" for k, kind in zip(contacts.joint, contacts.kind, strict=True)]
    return {name: cz[:, e] for e, name in enumerate(names) if not contacts.fixed[e]}
