"""Virtual work: efforts from powers alone, without any reaction; the independent check of the matrix.

For every drive, with the others held and unit speed: sum of F . v + T omega over all loads, weights, springs and
inertia wrenches, plus the power of the unknowns, is zero. Dry friction does work too, and its forces follow the
reactions: they come from the solution, so that with friction virtual work checks it and does not replace it. Mechanics:
docs/theory.md 5.2.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import (
    Action,
    State,
    friction_actions,
    known_actions,
    magnitude,
    state,
)
from dalembert.analysis.methods.belt_tensions import tension_actions
from dalembert.answer.equality import Compared
from dalembert.arrays import Array
from dalembert.core.constraints import rates
from dalembert.core.equilibrium import load_rows, relative
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


@dataclass(frozen=True, eq=False)
class VirtualWork(Compared):
    """Efforts (P, D) and unknown loads (P, U) by virtual work, and what they came from.

    For action a of ``actions`` and drive d at unit speed: velocity of its point (A, P, D, d), spin of its link
    (A, P, D), in space (A, P, D, 3), power (A, P, D). The friction of a joint is one action, with the motion of j
    against i.
    """

    result: Result = field(repr=False)
    actions: tuple[Action, ...] = field(repr=False)
    velocity: Array = field(repr=False)
    spin: Array = field(repr=False)
    power: Array = field(repr=False)
    effort: Array = field(repr=False)
    load: Array = field(repr=False)

    @property
    def independent(self) -> bool:
        """True if no reaction enters: without friction."""
        return self.result.friction is None

    @property
    def gap(self) -> Array:
        """Largest difference to the matrix answer (P,), over the largest force times its point's speed."""
        r = self.result
        unknowns = np.concatenate([self.effort, self.load], axis=-1)
        other = np.concatenate([r.effort_array, r.load_array], axis=-1)
        largest = np.abs(unknowns).max(axis=-1, initial=0.0)
        for k, a in enumerate(self.actions):
            turning = a.couple[:, None] * self.spin[k]
            turning = np.abs(turning.sum(axis=-1) if turning.ndim == 3 else turning)
            most = magnitude(a.force)[:, None] * magnitude(self.velocity[k]) + turning
            largest = np.maximum(largest, most.max(axis=-1, initial=0.0))
        gap = np.abs(unknowns - other).max(axis=-1, initial=0.0)
        return relative(gap, largest)

    @property
    def answer(self) -> Result:
        """The result with these efforts and no reactions: what the method can find."""
        behind = self.result.after
        return replace(
            self.result,
            after=None if behind is None else virtual_work(behind).answer,
            force_array=np.full_like(self.result.force_array, np.nan),
            moment_array=np.full_like(self.result.moment_array, np.nan),
            effort_array=self.effort,
            load_array=self.load,
        )


def virtual_work(r: Result) -> VirtualWork:
    """Efforts and unknown loads of a result by virtual work, and the power of every action.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> found = da.virtual_work(da.dynamics(da.load(examples()["four_bar"])))
    >>> f"{float(found.effort[0, 0]):.4f} N m, gap below 1e-11: {bool(found.gap.max() < 1e-11)}"
    '27.4822 N m, gap below 1e-11: True'

    With friction its losses come from the reactions of the result: the answer is checked, not found anew.

    >>> from dalembert.bundled import cases
    >>> found = da.virtual_work(da.statics(da.load(cases()["seed-002-7a-engine-friction-circles"])))
    >>> [a.source for a in found.actions], found.independent, round(float(found.effort[0, 0]), 4)
    (['gas', 'friction in O', 'friction in A', 'friction in B', 'friction in guide'], False, -4521.8475)
    """
    at = state(r)
    g = r.compiled.layout.algebra
    loads, friction = (*known_actions(r, at), *tension_actions(r, at)), friction_actions(r)
    known = (*loads, *friction)
    motions = [*(_motion(r, at, a) for a in loads), *(_relative(r, at, a) for a in friction)]
    shape = (len(known), len(r.status), len(r.drives))
    velocity = np.array([v for v, _ in motions]).reshape((*shape, g.d))
    spin = np.array([w for _, w in motions]).reshape(shape if g.d == 2 else (*shape, 3))
    powers = (
        a.power(np.moveaxis(v, 1, 0), np.moveaxis(w, 1, 0)).T
        for a, (v, w) in zip(known, motions, strict=True)
    )
    power = np.array([*powers]).reshape(shape)
    effort, load = _solve_power_balance(r, at, power.sum(axis=0))
    return VirtualWork(r, known, velocity, spin, power, effort, load)


def _motion(r: Result, at: State, a: Action) -> tuple[Array, Array]:
    """Velocity of an action's point (P, D, d) and spin of its link (P, D), (P, D, 3) at unit speed of each drive."""
    link, g = (*r.links, "ground").index(a.link), r.compiled.layout.algebra
    twist = at.moving.virtual[..., link, :]
    arm = (a.at - r.compiled.origin - at.pose.point[:, link, :])[:, None, :]
    w = twist[..., g.d :]
    return twist[..., : g.d] + g.spin(w, arm), w if g.d == 3 else w[..., 0]


def _relative(r: Result, at: State, a: Action) -> tuple[Array, Array]:
    """The same of a link against the one that exerts the action."""
    motion, other = _motion(r, at, a), _motion(r, at, replace(a, link=a.by or GROUND))
    return motion[0] - other[0], motion[1] - other[1]


def _solve_power_balance(r: Result, at: State, power: Array) -> tuple[Array, Array]:
    """Solve power + given efforts + C x = 0 for the efforts and loads asked for, x."""
    c = r.compiled
    requested = c.known.requested
    effort = np.broadcast_to(c.known.effort, power.shape).copy()
    right = -(power + np.where(requested, 0.0, effort))
    columns = np.broadcast_to(np.eye(len(requested))[:, requested], (*power.shape, int(requested.sum())))
    matrix = np.concatenate([columns, _unit_powers(r, at)], axis=-1)
    with np.errstate(all="ignore"):
        if not r.unknown_loads:
            x = right
        else:
            from dalembert.core.linear import solve_square

            x = solve_square(matrix, right)
    effort[:, requested] = x[:, : int(requested.sum())]
    return effort, x[:, int(requested.sum()) :]


def _unit_powers(r: Result, at: State) -> Array:
    """Power (P, D, U) of unit unknown loads at unit speed of each drive."""
    c = r.compiled
    if not r.unknown_loads:
        return np.zeros((len(r.status), len(r.drives), 0))
    unit = load_rows(c.layout, c.known, at.pose)
    spread = unit._replace(on_i=unit.on_i[..., None, :, :], on_j=unit.on_j[..., None, :, :])
    return rates(spread, at.moving.virtual)
