"""Dry friction in a compiled analysis: semi-smooth Newton, unrolled to a fixed number of steps.

The result is accepted where a sufficient condition for a unique solution holds (the fixed-point map is a contraction)
and the last step is small; elsewhere it is in doubt, and the general executor decides.

A contact's force changes the reactions of the links between it and the ground only, so the small system falls into
blocks, each two-link group one of three or four contacts; each block is solved for itself, those that load others
first.

Mechanics: docs/theory.md 6.2.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from dalembert.arrays import Array, Tree
from dalembert.core.branchless import above, top, where
from dalembert.core.equilibrium import LinkMotions, Statement
from dalembert.core.forcing import pair, total_wrench
from dalembert.core.friction.contact_equations import (
    ContactResponse,
    Contacts,
    SlipState,
    argument,
    bearing,
    correction,
    multiplier,
    response,
    senses,
    slope,
    strength,
    under,
    with_strength,
)
from dalembert.core.friction.friction_solver import LOST
from dalembert.core.friction.losses import dry_wrenches, power_reversed, viscous_wrenches
from dalembert.core.friction.reversal import crossing
from dalembert.core.layout import ConstraintRows, Layout, Pose
from dalembert.kernel.doubts import uncertain
from dalembert.kernel.elimination import components, structural
from dalembert.kernel.graph import Graph, Node, is_zero, trace_array
from dalembert.kernel.jam_proof import jams, lever
from dalembert.kernel.program import KernelFlags

FEWEST, MOST = 3, 7
"""Least and largest number of Newton's steps."""

ENOUGH = 1e-4
"""Change of a force in a step, relative to the largest, that requires one more step, checked over the file's motion. A
kink costs other designs a step; it pays, as each one that the general executor redoes costs as much as thousands of
positions."""

LAST = 1e-7
"""Largest change of the last step in any design: the remaining error is its square."""

CARRIES = 1e-8
"""Fraction of the largest force above which a contact is surely loaded."""

POWER = 12
"""Power of the fixed point's matrix whose norm bounds its spectral radius."""


TRACED = ("read", "lever", "coefficient", "resting", "reach", "viscous", "reckoned", "wrap", "given")
"""Arrays of contacts that follow from numbers that vary."""


class Slip(NamedTuple):
    """Rows that the contacts act along, their senses and rates, the response to c z, and c z (E,)."""

    along: ConstraintRows
    state: SlipState
    r: ContactResponse
    cz: Array


@dataclass(frozen=True)
class FrictionTrace:
    """Multipliers x, total wrenches w, friction's and damping's force (joints, 2) and moment (joints,) on j; and flags
    for doubt, rest, jams, and reversed power of the unknowns; ``slip`` of each contact."""

    x: Array
    total: Array
    force: Array
    moment: Array
    flags: KernelFlags
    slip: Slip | None = None


def trace_friction(
    graph: Graph,
    layout: Layout,
    contacts: Contacts,
    pose: Pose,
    moving: LinkMotions,
    s: Statement,
    still: Array | None,
    slips: Array | None = None,
    reversals: Array | None = None,
    side: Node | None = None,
    friction: Array | None = None,
) -> FrictionTrace:
    """Multipliers with friction; ``still``: wrenches on the links without inertia, None if the same.

    ``slips``: z of each contact where the solution is known; then no verdicts are computed, as they are known too, and
    ``reversals`` has the sense of contacts that reverse, else 0. ``side``: -1 just before reversals, 1 just after.
    ``friction``: c z of each contact, whatever its law; then no verdicts are computed either.
    """
    contacts = trace_contacts(graph, contacts)
    twist = trace_array(graph, moving.twist)  # without motion they are numbers
    along, arrays = response(layout, contacts, pose, s.forces, s.w, twist)
    r = ContactResponse(*(trace_array(graph, a) for a in arrays))
    state = senses(layout, contacts, along, twist)
    if side is not None:
        state = _at_side(layout, contacts, along, pose, moving, state, side)
    if reversals is not None:
        moves = 1.0 - np.abs(reversals)
        open_: Any = moves * trace_array(graph, state.open)
        state = state._replace(sense=reversals + moves * state.sense, open=open_)
    if friction is not None:
        total = s.w + total_wrench(layout, pair(along, friction))
        wrenches = dry_wrenches(layout, contacts, pose, along, np.where(contacts.fixed, 0.0, friction))
        x, slip = multiplier(r, friction), Slip(along, state, r, friction)
        return FrictionTrace(x, total, *wrenches, KernelFlags(), slip)
    sense, c = trace_array(graph, state.sense), trace_array(graph, strength(contacts, 1.0, sense=state.sense))
    z, bears, flags = trace_slip(graph, contacts, with_strength(r, c), sense, slips)
    x = multiplier(r, c * z)
    unknown = layout.constraints.count < len(x) and slips is None

    def turning(problem: ContactResponse, x: Array, w: Array) -> Node:
        bare = problem.x  # separating forces of teeth have no power: the centres keep their distance
        flag: Node = -trace_array(graph, power_reversed(layout, s.unknown, moving.twist, w, x, bare)).item()
        return flag

    turns = turning(r, x, s.w) if unknown else graph.zero
    if still is not None and not is_zero(turns):
        other = under(layout, contacts, pose, s.forces, still, state.rate, r)
        other = ContactResponse(*(trace_array(graph, a) for a in other))
        alone, _, doubt = trace_slip(graph, contacts, with_strength(other, c), sense)
        locked = turning(other, multiplier(other, c * alone), still)
        flags = flags if locked is turns else replace(flags, still=doubt.slips, locked=(locked,))
    force, moment = dry_wrenches(layout, contacts, pose, along, np.where(contacts.fixed, 0.0, c * z))
    viscous_force, viscous_moment, _ = viscous_wrenches(layout, contacts, pose, moving.twist)
    rest, idle = _at_rest(graph, trace_array(graph, state.open), bears, top(np.abs(r.y), 2))
    return FrictionTrace(
        x=x,
        total=s.w + total_wrench(layout, pair(along, c * z)),
        force=force + viscous_force,
        moment=moment + viscous_moment,
        flags=replace(flags, slips=(*flags.slips, *idle), rest=rest, turned=_nonzero(turns)),
        slip=Slip(along, state, r, c * z),
    )


def _at_side(
    layout: Layout,
    contacts: Contacts,
    along: ConstraintRows,
    pose: Pose,
    moving: LinkMotions,
    now: SlipState,
    side: Node,
) -> SlipState:
    """Senses just before or just after; open where the second rates do not determine them either."""
    sides = crossing(layout, contacts, along, pose, moving, now, np.ones(contacts.count, bool))
    sense = where(np.array(side.positive(), object), sides.after, sides.before)
    unknown = ~sides.here & ~sides.slow
    return now._replace(sense=where(unknown, now.sense, sense), open=now.open & unknown)


def trace_contacts(graph: Graph, contacts: Contacts) -> Contacts:
    numbers: Tree = {name: trace_array(graph, getattr(contacts, name)) for name in TRACED}
    return replace(contacts, **numbers)


def _nonzero(*nodes: Node) -> tuple[Node, ...]:
    return tuple(n for n in nodes if not is_zero(n))


def _at_rest(graph: Graph, open_: Array, bears: Array, largest: Array) -> tuple[tuple[Node, ...], ...]:
    """Nodes that are negative where a contact without a rate is surely loaded, and where such contacts may
    be unloaded."""
    carries = above(np.abs(bears), CARRIES * largest)
    rest, idle = (
        trace_array(graph, (open_ & carries).sum()).item(),
        trace_array(graph, (open_ & ~carries).sum()).item(),
    )
    return _nonzero(-rest), _nonzero(-(idle & ~rest.positive()))


def trace_slip(
    graph: Graph,
    contacts: Contacts,
    r: ContactResponse,
    sense: Array,
    slips: Array | None = None,
    fixed: bool = False,
) -> tuple[Array, Array, KernelFlags]:
    """z and S of each contact (E,) for known senses, from the response with H after z, and flags for doubt and jams;
    ``slips`` are z where it is known; ``fixed``: with as many steps of Newton as there are, and no proof of jams."""
    count, largest = contacts.count, trace_array(graph, top(np.abs(r.y), 2))
    z, bears = trace_array(graph, np.zeros(count)), trace_array(graph, np.zeros(count))
    acts = [b for b in range(count) if not is_zero(sense[b])]
    needs = {a: {b for b in acts if not all(is_zero(x) for x in r.h[:, a, b])} for a in range(count)}
    doubt: list[Node] = []
    unsure: list[Node] = []
    single: list[Node] = []
    stuck: list[Node] = []
    right: dict[int, Node] = {}
    for block in components({a: needs[a] - {a} if a in acts else needs[a] for a in range(count)}):
        k = np.array(sorted(block))
        others = sorted({b for a in block for b in needs[a]} - set(block))
        y = argument(r._replace(y=r.y[:, k], h=r.h[:, k][:, :, others]), z[others])
        part = replace(contacts, signed=contacts.signed[k], ball=contacts.ball[k])
        known = graph.one
        for b in others:
            known = known * right.get(b, graph.one)
        if len(block) == 1 and (block[0] not in acts or block[0] not in needs[block[0]]):
            bears[k] = bearing(part, y)
            z[k] = -sense[k] * bears[k]
            right |= dict.fromkeys(block, known)
            continue
        inner = r._replace(y=y, h=r.h[:, k][:, :, k])
        rough, sure = _contraction(graph, lever(inner.h, part.ball), sense[k])
        start = None if slips is None else slips[k]
        z[k], bears[k], last = _newton(graph, part, inner, sense[k], largest, None if fixed else sure, start)
        doubt.append(last)
        if slips is not None:
            continue
        unsure.append(rough)
        single.append(sure)
        stuck.append(graph.zero if fixed else jams(graph, part, inner, sense[k]) * known)
        right |= dict.fromkeys(block, known * last.positive() * rough.positive().larger(sure.positive()))
    flags = KernelFlags(
        slips=uncertain(doubt), unsure=uncertain(unsure), sure=uncertain(single), jam=uncertain(stuck)
    )
    if not (flags.unsure and flags.sure):  # in doubt, or jammed, only where both are
        flags = KernelFlags(slips=flags.slips)
    return z, bears, flags


def _contraction(graph: Graph, bound: Array, sense: Array) -> tuple[Node, Node]:
    """Positive where the fixed-point map is proved to be a contraction: then its solution is unique, at any smaller
    scale too.

    First by the sums of the rows of its matrix, without signs, then by those of a power of it.
    """
    moves, reached = np.abs(sense), np.abs(sense)
    bounds = []
    for _ in range(POWER):
        reached = (bound @ (moves * reached)[:, None])[:, 0]
        bounds.append(reached)
    short, long = (1.0 - 2 / LOST - trace_array(graph, top(bounds[k], 1)).item() for k in (0, -1))
    return short, long


def _newton(
    graph: Graph,
    contacts: Contacts,
    r: ContactResponse,
    sense: Array,
    largest: Array,
    sure: Node | None,
    known: Array | None,
) -> tuple[Array, Array, Node]:
    """z and S of one block, and nodes that are negative where the last step is not small. The steps start from no
    friction; from a known solution only the last step is taken, and it must be small: the solution may be unknown for a
    contact without strength. All but the last are constants to derivatives: it carries them exactly.
    """
    detached: Any = np.frompyfunc(graph.without_gradient, 1, 1)
    fixed, scale, z = detached(r.h), np.asarray(detached(largest)), known
    if z is None:
        z = trace_array(graph, np.zeros(len(sense)))

    def solve(matrix: Array, right: Array) -> Array:
        rows = [{c: x for c, x in enumerate(row) if not is_zero(x)} for row in matrix]
        return structural(graph, rows, len(rows)).motion(right)

    enough = known is not None
    for k in range(1, MOST + 1):
        y = argument(r, z)
        steep, bears = slope(contacts, detached(y), scale)
        off = z + sense * (steep * y).sum(axis=0)
        step = trace_array(graph, correction(r._replace(h=fixed), steep, sense, off, solve))
        felt = step if known is None else (fixed @ step[:, None])[..., 0]
        change = trace_array(graph, top(np.abs(felt), felt.ndim))
        if k == MOST or enough:
            break
        enough = sure is not None and k + 1 >= FEWEST and _small(graph, change, scale, sure)
        z = detached(z + step)
    return z + step, bears, trace_array(graph, LAST * scale - change).item()


def _small(graph: Graph, change: Array, scale: Array, sure: Node) -> bool:
    """True if a change is small everywhere in the file's motion."""
    values = graph.evaluate([change.item(), scale.item(), sure], {})
    size, force, single = np.broadcast_arrays(*values)
    with np.errstate(all="ignore"):
        return not bool(((size > ENOUGH * force) & (single > 0)).any())
