"""The core's equations traced once: from the drives' positions to every reaction, as nodes of one graph.

Mechanics: docs/theory.md 8.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.core import forcing as fc
from dalembert.core.constraints import measure
from dalembert.core.elements.cam_rows import jump_margins
from dalembert.core.elements.pushing import Pushing, contact_margins, forces_at_speed
from dalembert.core.elements.turning_frame import turning_square
from dalembert.core.equilibrium import (
    NEAR,
    Equilibrium,
    Known,
    Statement,
    known_sources,
    load_rows,
    motion,
    reactions,
    statement,
    virtual_power,
)
from dalembert.core.equilibrium import LinkMotions as Moving
from dalembert.core.forcing import Forcing, WrenchSource, pair, total_wrench
from dalembert.core.friction.contact_equations import Contacts
from dalembert.core.geometry import span
from dalembert.core.layout import Angle, ConstraintRows, Layout, Pose
from dalembert.core.linear import Factor
from dalembert.core.position.first_pose_plane import held_places, held_wheels, phase_rows, with_rows
from dalembert.core.position.newton import CLOSED, gap
from dalembert.kernel.doubts import largest, uncertain, unheld, unmet
from dalembert.kernel.elimination import Structural
from dalembert.kernel.friction_trace import FrictionTrace, trace_friction
from dalembert.kernel.graph import CONSTANT, Graph, Node, Scalar, trace_array
from dalembert.kernel.position.closed_forms import newton_correction, positions
from dalembert.kernel.position.rigid_parts import PlacedPose, TracePlan
from dalembert.kernel.position.space_positions import space_correction, space_positions
from dalembert.kernel.position.unrolled_newton import solver
from dalembert.kernel.program import KernelFlags

PASSES = 40
"""Largest number of repetitions for tooth forces that push movable centres."""


@dataclass(frozen=True)
class Drives:
    """Inputs of the drives as nodes (D,): position, its cosine and sine (turns), speed, acceleration."""

    position: Array
    cosine: Array
    sine: Array
    speed: Array
    acceleration: Array


@dataclass(frozen=True)
class TracedProblem:
    """A compiled mechanism whose numbers are nodes; ``like`` is the same with the file's numbers, ``like_target`` its
    stacked targets at the first position. With ``slips``, the friction of each contact, the known motion is the
    solution (``reversals``: the sense where a contact reverses); one step of Newton remains, which carries the
    derivatives. ``margins``: by freedom, how far springs' turns may differ from the known motion's for the same count.
    ``moves``: the drives move on from it, and friction is an input."""

    graph: Graph
    layout: Layout
    forcing: Forcing
    known: Known
    target: Array
    drives: Drives
    first: Drives
    like: Layout
    like_target: Array
    guess: Any
    inertia: bool
    path: Callable[[str, int], Node]
    first_path: Callable[[str, int], Node]
    signs: Callable[[tuple[Scalar, ...], tuple[Scalar, ...], int, int], Scalar]
    contacts: Contacts | None
    slips: Array | None
    reversals: Array | None
    margins: dict[int, Node]
    at_pose: Callable[[Forcing, Pose, Array], Forcing] | None = None  # of loads by the pose and its rates
    moves: bool = False
    side: Node | None = None  # -1 just before reversals, 1 just after
    redundant: bool = False  # some rows repeat others
    unsplit: bool = False  # and where closed forms need a choice of these, Newton's steps take all
    phased: bool = False  # the phases of wheels are in the target
    pushing: Pushing | None = None  # contacts that hold one way alone
    usual: Flags | None = None  # positions of the known motion by whose pivots others are judged


@dataclass(frozen=True)
class Traced:
    """All possible outputs as nodes: arrays as in a ``Result`` without the position axis. closure: doubts that are
    squares of what vanishes at a dead centre, or fourth powers where rows are redundant; unbalanced, loads (L, n):
    residual of all wrenches on a link, sum of those that are not reactions; virtual (D, L+1, n): twists at unit speeds
    of drives; power (D,) of loads and efforts; sources: wrenches of loads by kind, `asked` the unknown ones."""

    pose: Pose
    twist: Array
    acceleration: Array
    force: Array
    moment: Array
    effort: Array
    load: Array
    unbalanced: Array
    loads: Array
    virtual: Array
    power: Array
    open: list[Node]
    closure: list[Node]
    doubt: list[Node]
    contacts: list[Node]
    friction: FrictionTrace
    flips: bool
    sources: dict[str, WrenchSource]
    forcing: Forcing
    graph: Graph
    scale: Array
    square: list[Node]  # of the speed of a turning frame
    pivots: tuple[Node, ...] = ()  # of one sign along a motion

    @cached_property
    def residual(self) -> Node:
        """Largest out-of-balance force (moment over length) over the largest load."""
        out, size = (trace_array(self.graph, a * self.scale) for a in (self.unbalanced, self.loads))
        return largest(self.graph, out) / (largest(self.graph, size) + 1e-300)


def trace(p: TracedProblem) -> Traced:
    """Positions, motion and equilibrium of one position of one design."""
    layout, decided = replace(p.layout, solver=solver(p.graph)), _decided(p.graph)
    target, gaps = _with_phase(p, layout)
    placed = _trace_pose(p, layout, target, p.drives, p.path)
    if p.redundant:
        placed.open.append(_closed(p, layout, placed.pose, target))
    if p.phased:
        gaps = _centre_gaps(p, layout, placed)
    return replace(_trace_at(p, layout, placed, [*gaps, *decided]), pivots=tuple(placed.pivots))


def trace_at(p: TracedProblem, pose: Pose) -> Traced:
    """Motion and equilibrium of one position where the pose is known."""
    return _trace_at(p, replace(p.layout, solver=solver(p.graph)), PlacedPose(pose), _decided(p.graph))


def _trace_at(p: TracedProblem, layout: Layout, placed: PlacedPose, gaps: list[Node]) -> Traced:
    pose = placed.pose
    moving, rows, factors = motion(layout, pose, p.drives.speed, p.drives.acceleration)
    if p.at_pose is not None:
        p = replace(p, forcing=p.at_pose(p.forcing, pose, moving.twist))
    sources = known_sources(layout, p.forcing, pose, moving, p.inertia)
    square = list[Node]()
    if p.forcing.turning is not None:
        square = list(trace_array(p.graph, turning_square(layout, p.forcing, pose, moving.virtual, sources)))
    s, friction = _trace_equilibrium(p, layout, pose, moving, rows, factors, sources)
    x, idle = friction.x, layout.constraints.idle
    spins = trace_array(p.graph, x[idle])
    x[idle] = 0.0
    count, count_efforts = layout.constraints.count, int(p.known.requested.sum())
    effort = p.known.effort[0].astype(object)
    effort[p.known.requested] = x[count : count + count_efforts]
    pushed = fc.between_wheels(layout, p.forcing, pose, moving.twist, x)
    balance = Equilibrium(x[:count], effort, x[count + count_efforts :], *(np.zeros(0),) * 3, None, pushed)
    force, couple = reactions(layout, pose, rows, balance)
    g, singular = p.graph, _singular(p, factors, s.forces)
    reacted = total_wrench(layout, pair(s.unknown, x))
    if p.known.link.size:
        unit = load_rows(layout, p.known, pose)
        sources["asked"] = WrenchSource(unit.j, unit.on_j * balance.load[:, None])
    force, moment = force + friction.force, couple.reshape(friction.moment.shape) + friction.moment
    heavy = forces_at_speed(layout, p.forcing.inertia.mass, moving.twist if p.inertia else 0.0 * moving.twist)
    return Traced(
        pose=pose,
        twist=trace_array(g, moving.twist),
        acceleration=trace_array(g, moving.acceleration),
        force=trace_array(g, force),
        moment=trace_array(g, moment),
        effort=trace_array(g, effort),
        load=trace_array(g, balance.load),
        unbalanced=trace_array(g, reacted + friction.total),
        loads=trace_array(g, friction.total),
        virtual=trace_array(g, moving.virtual),
        power=trace_array(g, virtual_power(layout, moving.virtual, s.unknown, x, friction.total)),
        open=placed.open,
        closure=[*placed.doubt, *singular] if p.redundant else placed.doubt,
        doubt=[
            *gaps,
            *placed.doubt,
            *singular,
            *_short(p, layout, pose),
            *_turn_count_doubt(p, layout, pose),
            *(jump_margins(layout, pose) if p.inertia else ()),
            *trace_array(g, fc.limit_margins(layout, p.forcing, pose, moving.twist, x)),
            *unheld(p.graph, layout, spins, friction.total),
            *unmet(p.forcing.turning, square, effort, layout.length * largest(g, trace_array(g, force))),
        ],
        contacts=list(trace_array(g, contact_margins(layout, p.pushing, pose, force, moment, heavy))),
        friction=friction,
        flips=placed.flips,
        sources=sources,
        forcing=p.forcing,
        graph=g,
        scale=layout.wrench_scale,
        square=square,
    )


def _trace_equilibrium(
    p: TracedProblem,
    layout: Layout,
    pose: Pose,
    moving: Moving,
    rows: ConstraintRows,
    factors: Factor,
    sources: dict[str, WrenchSource],
) -> tuple[Statement, FrictionTrace]:
    """Equilibrium system, and its multipliers, with friction where contacts have any."""

    def statement_of(*kinds: str) -> Statement:
        loads = total_wrench(layout, *(sources[kind] for kind in kinds))
        equations = statement(layout, p.known, pose, rows, factors, loads)
        return equations._replace(w=equations.w.reshape(equations.w.shape[-2:]))

    s = statement_of(*sources)
    if p.contacts is None:
        x, total = _multipliers(p, layout, pose, s)
        d = layout.algebra.d
        none = np.zeros((layout.joints, d)), np.zeros((layout.joints, 3) if d == 3 else layout.joints)
        return s, FrictionTrace(x, total, *none, KernelFlags())
    still = statement_of(*(kind for kind in sources if kind != "inertia")).w if p.inertia else None
    known = p.slips, p.reversals, p.side
    count = p.contacts.count if p.moves else 0
    friction = np.array([p.graph.input("channel", f"friction {e}", 0.0) for e in range(count)], object)
    return s, trace_friction(
        p.graph, layout, p.contacts, pose, moving, s, still, *known, friction if p.moves else None
    )


def _trace_pose(
    p: TracedProblem, layout: Layout, target: Array, drives: Drives, path: Callable[[str, int], Node]
) -> PlacedPose:
    """Poses at the drives' positions."""
    count = layout.constraints.count
    angular = layout.freedoms.angular[layout.driven]
    turns = {
        int(r): (_circular("cos", target[r]), _circular("sin", target[r]))
        for r in np.flatnonzero(layout.constraints.angular)
    }
    turns |= {count + int(k): (drives.cosine[k], drives.sine[k]) for k in np.flatnonzero(angular)}
    inputs = trace_array(p.graph, np.concatenate([target, drives.position]))
    methods = (positions, newton_correction) if layout.algebra.d == 2 else (space_positions, space_correction)
    place = methods[p.slips is not None]
    known_motion = TracePlan(
        p.graph, layout, inputs, turns, path, p.signs, moves=p.moves, redundant=p.redundant
    )
    pose = place(known_motion)
    if p.unsplit and layout.algebra.d == 2 and pose.doubt:  # of a choice of rows, not of all
        return place(replace(known_motion, placed=set(), unsplit=True))
    return pose


def _closed(p: TracedProblem, layout: Layout, pose: Pose, target: Array) -> Node:
    """Nodes that are negative where some constraint is not met: redundant ones may have been left out."""
    rest = replace(layout, driven=np.zeros(0, np.intp))
    off = np.delete(gap(rest, pose, trace_array(p.graph, target)), layout.constraints.idle)
    margin: Node = (CLOSED * layout.length) ** 2 - (off * off).sum()
    return margin


def _circular(name: str, angle: Scalar) -> Scalar:
    return getattr(angle, name)() if type(angle) is Node else getattr(np, name)(float(angle))  # type: ignore[no-any-return]


def _with_phase(p: TracedProblem, layout: Layout) -> tuple[Array, list[Node]]:
    """Targets of meshes and rolling wheels, their measures at the first position of each design; and nodes that are
    negative where wheels do not meet."""
    rows = phase_rows(layout.constraints)
    if not rows.size or p.phased:
        return p.target, []
    geometry = [a for f in layout.stack.families for n, a in vars(f).items() if n not in ("row", "i", "j")]
    if not any(type(x) is Node for a in geometry for x in np.ravel(a)):
        return p.target, []
    kept = np.setdiff1d(np.arange(layout.constraints.count), rows)
    known = np.concatenate([p.like_target[kept], p.like_target[layout.constraints.count :]])
    held = held_wheels(p.like, with_rows(p.like, kept, []), known, rows, p.guess)
    angles = np.nan_to_num(p.guess.turn[np.array(held, np.intp)])
    known = np.concatenate([known[: len(kept)], angles, known[len(kept) :]])
    places = held_places(p.like, with_rows(p.like, kept, held), known, p.guess)
    values = np.zeros(0) if places is None else places.value
    places = None if places is None else places.of(layout)
    target = np.concatenate([p.target[kept], angles, values])
    first = _trace_pose(p, with_rows(layout, kept, held, places), target, p.first, p.first_path)
    out = p.target.astype(object)
    out[rows] = measure(layout.algebra, layout.constraints, first.pose)[rows]
    doubts = uncertain((*first.doubt, *first.open))  # of the first position
    return out, [*doubts, *_centre_gaps(p, layout, first)]


def _centre_gaps(p: TracedProblem, layout: Layout, first: PlacedPose) -> list[Node]:
    """Negative where the distance of two centres is not the sum of the pitch radii."""
    out: list[Node] = []
    for f in fc.meshes(layout):
        line = span(layout.algebra, f, first.pose)
        for k in range(len(f.i)):
            wanted = trace_array(p.graph, f.ri[k] + f.rj[k]).item()
            distance = (line[k] * line[k]).sum().sqrt()
            out.append(MESH * wanted - abs(distance - wanted))
    return list(uncertain(out))


MESH = 1e-3
"""Relative error of a centre distance that a mesh tolerates, as in the general executor."""


def _multipliers(p: TracedProblem, layout: Layout, pose: Pose, s: Statement) -> tuple[Array, Array]:
    """Multipliers and total wrenches; tooth forces push the wheels apart by the size of the tangential ones."""
    x, total = s.forces.forces(-s.w.reshape(-1)), s.w
    if not p.forcing.follows_reactions:
        return x, total
    before = None
    for _ in range(PASSES):
        total = s.w + fc.following(layout, p.forcing, pose, x)
        x = s.forces.forces(-total.reshape(-1))
        now = np.array(np.broadcast_arrays(*p.graph.evaluate(trace_array(p.graph, x), {})))
        if before is not None and np.nanmax(np.abs(now - before)) <= 1e-15 * np.nanmax(np.abs(now)):
            break
        before = now
    return x, total


def _decided(graph: Graph) -> list[Node]:
    return [n for n in graph.decisions if n.level != CONSTANT]


def _singular(p: TracedProblem, *factors: object) -> list[Node]:
    """Nodes that are negative near a singular configuration; known solutions are exempt."""
    if p.slips is not None:
        return []
    pivots = [x for f in {id(f): f for f in factors}.values() for x in _pivots(f)]
    if p.usual is not None and not p.usual.any():
        return [p.graph.constant(-1.0)]
    out = []
    for pivot, sample in zip(pivots, p.graph.evaluate(pivots, {}), strict=True):
        sizes = np.abs(sample if np.ndim(sample) == 0 or p.usual is None else sample[p.usual])
        usual = float(np.nanquantile(sizes, 0.75))
        if usual > 0:
            out.append(pivot * pivot * (1 / usual / usual) - NEAR)
    return out


def _turn_count_doubt(p: TracedProblem, layout: Layout, pose: Pose) -> list[Node]:
    """Nodes that are negative where a design turns a spring so far from the known motion that its whole turns may
    differ."""
    if p.slips is not None or not p.margins:
        return []
    if layout.algebra.d == 2:
        i, j = layout.freedoms.ends
        known = {row: p.path("turn", int(j[row])) - p.path("turn", int(i[row])) for row in p.margins}
    else:
        known = {
            int(row): p.path("turn", int(place))
            for f in layout.freedoms.families
            if isinstance(f, Angle)
            for row, place in zip(f.row, f.count, strict=True)
        }
    value = measure(layout.algebra, layout.freedoms, pose)
    return [margin - 2 * abs(value[row] - known[row]) for row, margin in p.margins.items()]


def _short(p: TracedProblem, layout: Layout, pose: Pose) -> list[Node]:
    """Not positive where a spring or damper whose direction matters has zero length."""
    springs = p.forcing.springs
    nodes = trace_array(p.graph, fc.away(layout, springs, pose))[fc.needs_direction(springs)]
    return list(uncertain(nodes))


def _pivots(factors: object) -> list[Node]:
    assert isinstance(factors, Structural)
    return [x for x in factors.pivots if type(x) is Node and x.level != CONSTANT]
