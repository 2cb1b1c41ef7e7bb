"""Unknown loads without virtual power: the friction they cause must balance the given efforts.

Without friction the columns of such loads depend on those of the constraints, A is singular, and the response that
friction is solved with does not exist. With every drive's effort unknown and the loads u known it does: friction is
that of known loads, on its physical branch, and the efforts follow from it,

e(u) = e0 + Eu u + Ez c z,   z + s S(y0 + Yu u + H c z) = 0,   de/du = Eu - Ez c (I + s S' H c)^-1 s S' Yu.

Newton's method solves e(u) = e, the given efforts. Bearing forces load a contact in either sense, so that there can be
a solution for either sense of a load: the one in which every load acts in its direction comes first.

Mechanics: docs/theory.md 6.2.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.core.equilibrium import Known, load_rows
from dalembert.core.factor import row_scale
from dalembert.core.forcing import WrenchSource, total_wrench
from dalembert.core.friction.contact_equations import (
    ContactResponse,
    Contacts,
    SlipState,
    argument,
    jacobian,
    repeat,
    response,
    slope,
    under,
    with_strength,
)
from dalembert.core.friction.friction_solver import FrictionSolution, solve_friction
from dalembert.core.layout import ConstraintRows, Layout, Pose
from dalembert.core.linear import Factor, solve_square

NEWTON = 30
"""Steps after which Newton has failed."""

ARRIVED = 1e-13
"""Change of a load, relative to its size, at which Newton has converged."""

STARTS = (1.0, 1e3)
"""Sizes of the loads at which Newton starts, over those of the known loads and efforts."""


class ThroughFriction(NamedTuple):
    """Positions whose unknown loads are determined by friction alone: the response at these loads (P, ...), the loads
    (P, U), the smallest singular value of the scaled de/du (P,), the positions that are solved, and those that jam."""

    response: ContactResponse
    load: Array
    rcond: Array
    solved: Flags
    jammed: Flags


class _Loaded(NamedTuple):
    """The response with every effort unknown, its x and y by load, and the given efforts."""

    layout: Layout
    contacts: Contacts
    known: Known
    state: SlipState
    r: ContactResponse
    x_by_load: Array  # (P, U, X)
    y_by_load: Array  # (P, U, 3, E)

    @property
    def known_efforts(self) -> Ints:
        """Columns of x that hold the given efforts."""
        return np.asarray(self.layout.constraints.count + np.flatnonzero(~self.known.requested))

    @property
    def effort(self) -> Array:
        """The given efforts (P, G)."""
        return np.asarray(self.known.effort[:, ~self.known.requested])

    @property
    def effort_scale(self) -> Array:
        """Characteristic length of each given effort (G,) that is a couple, else 1."""
        return row_scale(self.layout, self.layout.freedoms.angular[self.layout.driven])[~self.known.requested]

    @property
    def load_scale(self) -> Array:
        """Characteristic length of each unknown load (U,) that is a couple, else 1."""
        return row_scale(self.layout, self.known.couple)

    def at_loads(self, u: Array) -> ContactResponse:
        x = self.r.x + (u[:, None] @ self.x_by_load)[:, 0]
        return self.r._replace(x=x, y=self.r.y + np.einsum("pu,puae->pae", u, self.y_by_load))


def solve_unpowered(
    layout: Layout,
    contacts: Contacts,
    known: Known,
    pose: Pose,
    rows: ConstraintRows,
    solver: Factor,
    w: Array,
    twist: Array,
    state: SlipState,
) -> ThroughFriction:
    """Loads at which friction balances the given efforts; w (P, L, n) without these efforts, ``state`` without open
    contacts."""
    p = _loaded(layout, contacts, known, pose, solver, w, rows, twist, state)
    size = _size(p, w)
    u, solved, weak, jammed = np.full(size.shape, np.nan), np.zeros(len(w), bool), np.zeros(len(w)), None
    positive = np.zeros(len(w), bool)
    for far, signs in product(STARTS, product((1.0, -1.0), repeat=size.shape[1])):
        loads, arrived, least, jams = _newton(p, far * size * np.array(signs))
        jammed = jams if jammed is None else jammed & jams
        forward = arrived & (loads >= 0).all(axis=-1)
        better = np.flatnonzero((arrived & ~solved) | (forward & ~positive))
        u[better], weak[better] = loads[better], least[better]
        solved, positive = solved | arrived, positive | forward
    assert jammed is not None
    u = np.where((jammed & ~solved)[:, None], size, u)
    jams = jammed & ~solved
    return ThroughFriction(_arranged(p, u), u, np.where(jams, 1.0, weak), solved, jams)


def _loaded(
    layout: Layout,
    contacts: Contacts,
    known: Known,
    pose: Pose,
    solver: Factor,
    w: Array,
    rows: ConstraintRows,
    twist: Array,
    state: SlipState,
) -> _Loaded:
    _, r = response(layout, contacts, pose, solver, w, twist)
    r = repeat(r, len(w))
    loads, still = load_rows(layout, known, pose), np.zeros((len(w), contacts.count))
    each, bare = [], replace(contacts, given=np.zeros(contacts.count))
    for k in range(len(known.link)):
        unit = total_wrench(layout, WrenchSource(loads.j[k : k + 1], loads.on_j[..., k : k + 1, :]))
        each.append(repeat(under(layout, bare, pose, solver, unit, still, r), len(w)))
    by_load = (np.stack([one.x for one in each], axis=1), np.stack([one.y for one in each], axis=1))
    return _Loaded(layout, contacts, known, state, r, *by_load)


def _size(p: _Loaded, w: Array) -> Array:
    """Sizes (P, U) of loads like those of the known loads and the given efforts."""
    forces = np.abs(p.effort / p.effort_scale).max(axis=-1)
    forces = forces + np.abs(w * p.layout.wrench_scale).max(axis=(-2, -1), initial=0.0)
    return np.asarray(np.where(forces > 0, forces, 1.0)[:, None] * p.load_scale)


def _newton(p: _Loaded, u: Array) -> tuple[Array, Flags, Array, Flags]:
    """Loads (P, U) from a start, convergence flags, the least singular value of the scaled de/du, and flags where the
    start jams."""
    arrived, least, jams = np.zeros(len(u), bool), np.zeros(len(u)), np.zeros(len(u), bool)
    for k in range(NEWTON):
        solution, here = _friction(p, u)
        if k == 0:
            jams = ~np.isnan(solution.critical)
        rate = _effort_rate(p, solution, here)
        step = solve_square(rate, p.effort - solution.x[:, p.known_efforts])
        u = np.where(arrived[:, None], u, u + step)
        arrived |= (np.abs(step) <= ARRIVED * np.abs(u)).all(axis=-1)
        if arrived.all() or not np.isfinite(u).any():
            break
    if arrived.any():
        least[arrived] = np.linalg.svd(_scaled(p, rate)[arrived], compute_uv=False).min(axis=-1)
    return u, arrived, least, jams


def _friction(p: _Loaded, u: Array) -> tuple[FrictionSolution, ContactResponse]:
    here = p.at_loads(u)
    return solve_friction(p.contacts, here, p.state), here


def _effort_rate(p: _Loaded, solution: FrictionSolution, here: ContactResponse) -> Array:
    """de/du (P, G, U) where friction is solved."""
    y, r = argument(here, solution.c * solution.z), with_strength(here, solution.c)
    steep, _ = slope(p.contacts, y, np.abs(y).max(axis=(-2, -1), initial=0.0))
    sense = solution.state.sense
    rates = np.swapaxes(p.x_by_load[..., p.known_efforts], -1, -2)
    for k in range(p.y_by_load.shape[1]):
        off = sense * (steep * p.y_by_load[:, k]).sum(axis=-2)
        z = solve_square(jacobian(r, steep, sense), -off)
        rates[:, :, k] += (here.change[:, p.known_efforts] @ (solution.c * z)[..., None])[..., 0]
    return np.asarray(rates)


def _scaled(p: _Loaded, rate: Array) -> Array:
    """Dimensionless de/du."""
    return np.asarray(rate / p.effort_scale[:, None] * p.load_scale)


def _arranged(p: _Loaded, u: Array) -> ContactResponse:
    """The response at loads u, in the order of the original unknowns: constraints, other efforts, loads, which friction
    does not change."""
    r, none = p.at_loads(u), np.zeros((*u.shape, p.contacts.count))
    kept = np.setdiff1d(np.arange(r.x.shape[-1]), p.known_efforts)
    x, change = np.concatenate([r.x[:, kept], u], axis=-1), np.concatenate([r.change[:, kept], none], axis=-2)
    return r._replace(x=x, change=change)
