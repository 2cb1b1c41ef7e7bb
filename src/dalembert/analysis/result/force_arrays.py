"""Forces at some positions as arrays, and friction at them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Ints, Tree, at
from dalembert.core.equilibrium import known_sources

if TYPE_CHECKING:
    from dalembert.analysis.result.reaction_axes import Uniqueness
    from dalembert.core.equilibrium import Equilibrium


class Friction(NamedTuple):
    """Friction at each position.

    force (P, joints, 2), moment (P, joints): dry friction on j, moment about j's point; viscous beside it
    dry_loss, viscous_loss (P, joints): power
    cz, sense, rate (P, E), argument (P, 3, E) of each contact
    determinant, critical, single (P,): of the solution (core.friction.friction_solver)
    open (P, E): contacts at rest, whose sense is not known; reversing (P, E): contacts that only reverse here, so that
    these are the numbers just before, and others hold just after; blocked (P,): their reactions are not unique
    locked (P,): the unknowns' power has the opposite sign to that without friction, with and without inertia
    bare_effort (P, D), bare_load (P, U): without friction
    holding (P, unknowns, 2): low and high that friction can hold at rest for some history (core.friction.holding_range)
    """

    force: Array
    moment: Array
    viscous_force: Array
    viscous_moment: Array
    dry_loss: Array
    viscous_loss: Array
    cz: Array
    sense: Array
    rate: Array
    argument: Array
    determinant: Array
    critical: Array
    single: Flags
    open: Flags
    reversing: Flags
    blocked: Flags
    locked: Flags
    bare_effort: Array
    bare_load: Array
    holding: Array

    def known(self, position: int) -> bool:
        """True if every contact has its numbers at a position."""
        return bool(np.isfinite(self.cz[position]).all())


class SolvedForces(NamedTuple):
    """Forces of some positions; ``ends``: the low and high end of each unknown where friction leaves it open;
    ``after``: just after positions where contacts reverse, the same elsewhere."""

    force: Array
    moment: Array
    effort: Array
    load: Array
    residual: Array
    power_balance: Array
    rcond: Array
    unique: Array | None
    unique_unknowns: Array | None
    friction: Friction | None = None
    ends: tuple[SolvedForces, ...] = ()
    unique_in: Array | None = None
    after: SolvedForces | None = None
    square: Array | None = None  # (P,) of the speed of a turning frame, where it is solved


def forces_of(
    equilibrium: Equilibrium,
    force: Array,
    moment: Array,
    unique: Uniqueness,
    friction: Friction | None = None,
) -> SolvedForces:
    """Forces of an equilibrium, with its reactions and which of them statics alone determines."""
    return SolvedForces(
        force=force,
        moment=moment,
        effort=equilibrium.effort,
        load=equilibrium.load,
        residual=equilibrium.residual,
        power_balance=equilibrium.power_balance,
        rcond=equilibrium.rcond,
        unique=unique.reactions,
        unique_unknowns=unique.others,
        friction=friction,
        unique_in=unique.inside,
    )


ARRAYS = tuple(name for name in SolvedForces._fields if name not in ("friction", "ends", "after"))
"""Fields with an array over the positions, or none."""


def concatenate_blocks(parts: list[SolvedForces]) -> SolvedForces:
    """Blocks of positions one after the other."""
    if len(parts) == 1:
        return parts[0]
    count = max(len(p.ends) for p in parts)
    friction = [p.friction for p in parts if p.friction is not None]
    made: Tree = {name: _concatenate([getattr(p, name) for p in parts]) for name in ARRAYS}
    joined = SolvedForces(
        **made,
        friction=Friction(*(np.concatenate(a) for a in zip(*friction, strict=True))) if friction else None,
        ends=tuple(concatenate_blocks([p.ends[k] if p.ends else p for p in parts]) for k in range(count)),
    )
    some = any(p.after is not None for p in parts)
    return joined._replace(after=concatenate_blocks([p.after or p for p in parts]) if some else None)


def at_places(f: SolvedForces, where: Ints) -> SolvedForces:
    """Forces at some positions, or in another order."""
    made: Tree = {name: None if (a := getattr(f, name)) is None else a[where] for name in ARRAYS}
    return SolvedForces(
        **made,
        friction=None if f.friction is None else at(f.friction, where),
        ends=tuple(at_places(end, where) for end in f.ends),
        after=None if f.after is None else at_places(f.after, where),
    )


def _concatenate(arrays: list[Array | None]) -> Array | None:
    some = [a for a in arrays if a is not None]
    return np.concatenate(some) if some else None


_SOURCES = {"point": "force", "link": "couple", "span": "spring", "turn": "resistance"}


def given_load(r: Any, name: str) -> Array:
    """Force (P, d) of a given load on its link, or its couple (P,), in space (P, 3), in ground axes; traced, nodes.

    A spring or damper between two points has the force on the link of the first, one in a turn the moment on j.
    """
    m, c, on = r.mechanism, r.compiled, r.mechanism.loads[name].ON
    alike = [n for n, load in m.loads_on(on).items() if not getattr(load, "unknown", False)]
    place, d = alike.index(name), c.layout.algebra.d
    wrenches = _known_wrenches(r, _SOURCES[on])
    if on == "turn":  # those on all links i precede those on j
        place += wrenches.shape[-2] // 2
    wrench = wrenches[..., place, :]
    if on in ("point", "span"):
        return np.asarray(wrench[..., :d])
    return np.asarray(wrench[..., d] if d == 2 else wrench[..., d:])


def _known_wrenches(r: Any, kind: str) -> Array:
    """Wrenches of one kind of known loads: numbers of a result (P, k, n), nodes of a trace (k, n)."""
    if hasattr(r, "traced"):
        return np.reshape(r.traced.sources[kind].wrench, (-1, r.compiled.layout.algebra.n))
    from dalembert.analysis.methods.applied_forces import state

    s = state(r)
    with np.errstate(all="ignore"):
        wrench = known_sources(r.compiled.layout, r.compiled.forcing, s.pose, s.moving, r.inertia)[
            kind
        ].wrench
    return np.broadcast_to(wrench, (len(r.status), *wrench.shape[-2:]))
