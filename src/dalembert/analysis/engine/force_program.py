"""Motion and forces from a program where the poses are known: for structures that a complete program does not support.

These are structures whose positions the careful path computes (gears, groups without closed form, springs whose turns
are counted, mechanisms in space) and those with friction. Where friction is in doubt, at rest, reverses or jams, and
near singular places, the careful path answers.

Mechanics: docs/theory.md 8.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.engine.flat_numbers import Numbers, values, with_nodes
from dalembert.analysis.engine.kept_program import (
    CHECKS,
    DeadCentreError,
    TracedOutputs,
    force_nodes,
    problem_of,
)
from dalembert.analysis.result.force_arrays import Friction, SolvedForces
from dalembert.analysis.status.statuses import UNBALANCED
from dalembert.arrays import Array, Flags, Tree
from dalembert.core.branchless import top
from dalembert.core.equilibrium import usual
from dalembert.core.friction.contact_equations import (
    argument,
    jacobian,
    multiplier,
    slope,
    strength,
    with_strength,
)
from dalembert.core.friction.losses import friction_arrays
from dalembert.core.layout import Pose
from dalembert.kernel.doubts import uncertain
from dalembert.kernel.elimination import structural
from dalembert.kernel.friction_trace import trace_slip
from dalembert.kernel.graph import Graph, Node, is_zero, trace_array
from dalembert.kernel.trace import Traced, TracedProblem, trace_at

KEPT = ("twist", "acceleration", "effort", "load", "force", "moment")
SAMPLES = 24
"""Positions of the motion by which pivots and Newton's steps are chosen."""

DATA = "friction "
"""Before the names of what a ``Friction`` keeps, among the outputs of a program."""

MARKS = ("unsure", "sure", "turned", "still")


class ForceBlock(NamedTuple):
    """Twists and accelerations of the links, forces, and at which positions (P,) they are surely right."""

    twist: Array
    acceleration: Array
    forces: SolvedForces
    sure: Flags


@dataclass(frozen=True)
class ForceProgram(TracedOutputs):
    """A structure from its poses to all forces; inputs: numbers, then columns."""

    friction: bool


def trace_forces(c: Compiled, pose: Pose, numbers: Numbers, inertia: bool) -> ForceProgram | None:
    """The program of a mechanism whose poses (P, L+1, ...) are known; None where it cannot be traced, or not in these:
    DeadCentreError."""
    graph = Graph()
    known = np.flatnonzero(np.isfinite(pose.point).all(axis=(1, 2)))
    some = known[np.linspace(0, len(known) - 1, min(len(known), SAMPLES)).astype(int)]
    some = some[usual(c.layout, c.known, pose.at(some))]
    if not some.size:
        raise DeadCentreError
    symbols = with_nodes(graph, c, numbers._replace(columns=numbers.columns[:, some]), pose)
    assert symbols.pose is not None

    def none(*names: object) -> Node:
        raise KeyError(names)

    problem = problem_of(graph, symbols, c, inertia, none, none)
    try:
        t = trace_at(problem, symbols.pose)
    except (ValueError, TypeError, KeyError):
        return None
    outputs, friction = force_nodes(t), _friction_nodes(problem, symbols.pose, t)
    flags = t.friction.flags
    outputs["margin"] = _varying(t.doubt, t.contacts, flags.slips, flags.rest)
    nodes = friction | {name: outputs[name] for name in KEPT} | {name: outputs[name] for name in CHECKS}
    nodes |= {f"flag {name}": _varying(getattr(flags, name)) for name in MARKS}
    nodes["flag locked"] = np.array([*flags.locked, None], object)[:-1]  # 0: it never locks without inertia
    graph.samples.clear()
    return ForceProgram(graph, symbols.inputs, nodes, bool(friction))


def _varying(*nodes: Sequence[Node]) -> Array:
    varying = {n.index: n for some in nodes for n in uncertain(some)}
    return np.array([*varying.values(), None], object)[:-1]


def _friction_nodes(p: TracedProblem, pose: Pose, t: Traced) -> dict[str, Array]:
    """Data that a ``Friction`` keeps, by name; none without contacts."""
    contacts, slip, g = p.contacts, t.friction.slip, p.graph
    if contacts is None or slip is None:
        return {}
    layout = p.layout
    arrays = friction_arrays(layout, contacts, pose, t.twist, slip.along, slip.r, slip.state, slip.cz)
    bare = _without_friction(p, t)
    count, efforts = layout.constraints.count, int(p.known.requested.sum())
    effort = p.known.effort[0].astype(object)
    effort[p.known.requested] = bare[count : count + efforts]
    nodes: Tree = arrays | {
        "determinant": _determinant(p, t),
        "bare_effort": effort,
        "bare_load": bare[count + efforts :],
    }
    return {DATA + name: trace_array(g, array) for name, array in nodes.items()}


def _without_friction(p: TracedProblem, t: Traced) -> Array:
    """Multipliers without friction; the teeth's separation stays."""
    contacts, slip = p.contacts, t.friction.slip
    assert contacts is not None
    assert slip is not None
    if not contacts.fixed.any():
        return slip.r.x
    c = trace_array(p.graph, strength(contacts, 0.0))
    sense = trace_array(p.graph, np.where(contacts.fixed, -1.0, 0.0))
    z, _, _ = trace_slip(p.graph, contacts, with_strength(slip.r, c), sense)
    return multiplier(slip.r, c * z)


def _determinant(p: TracedProblem, t: Traced) -> Node:
    """det(A + J) / det(A): above zero where the solution is the only one."""
    contacts, slip, g = p.contacts, t.friction.slip, p.graph
    assert contacts is not None
    assert slip is not None
    sense = trace_array(g, slip.state.sense)
    y = argument(slip.r, slip.cz)
    steep, _ = slope(contacts, y, top(np.abs(y), 2))
    c = trace_array(g, strength(contacts, 1.0, sense=sense))
    matrix = jacobian(with_strength(slip.r, c), steep, sense)
    rows = [{k: x for k, x in enumerate(row) if not is_zero(x)} for row in matrix]
    out = g.one
    for pivot in structural(g, rows, len(rows)).pivots:
        out = out * pivot
    return abs(out)


def force_blocks(c: Compiled, k: ForceProgram, numbers: Numbers, size: int) -> ForceBlock | None:
    """Motion and forces at all positions, ``size`` at a time; None where the numbers raise an error."""
    single, columns = values(numbers)
    count = c.schedule.count
    out, work = np.empty((k.kept, count)), np.empty((k.size, min(count, size)))
    (residual, power), (certain, locked) = np.zeros((2, count)), np.zeros((2, count), bool)
    for start in range(0, count, size):
        part = slice(start, min(start + size, count))
        here = work[:, : part.stop - start]
        try:
            k.run([*single, *columns[:, part]], here)
        except (ArithmeticError, ValueError):
            return None
        residual[part], power[part] = k.balance(c.layout, here)
        locked[part], doubt = _locked(k, here)
        certain[part] = k.sure(here) & (residual[part] <= UNBALANCED) & ~doubt
        out[:, part] = here[: k.kept]
    names = ("force", "moment", "effort", "load")
    arrays: Tree = {name: k.part(name, out) for name in names}
    friction = _friction(c, k, out, locked) if k.friction else None
    ones = np.ones(count)
    forces = SolvedForces(
        **arrays,
        residual=residual,
        power_balance=power,
        rcond=ones,
        unique=None,
        unique_unknowns=None,
        friction=friction,
    )
    return ForceBlock(k.part("twist", out), k.part("acceleration", out), forces, certain)


def _below(k: ForceProgram, name: str, out: Array) -> Flags:
    """True at positions where a flag is negative, or not a number."""
    return np.asarray(~(out[k.rows[f"flag {name}"]] >= 0).all(axis=0))


def _locked(k: ForceProgram, out: Array) -> tuple[Flags, Flags]:
    """Flags where friction reverses the sign of the power of the unknowns, and where that, or friction, is in doubt."""
    doubt = _below(k, "unsure", out) & _below(k, "sure", out)
    turned = _below(k, "turned", out)
    locked = turned & _below(k, "locked", out) if k.nodes["flag locked"].size else turned
    return locked, doubt | (turned & _below(k, "still", out))


def _friction(c: Compiled, k: ForceProgram, out: Array, locked: Flags) -> Friction:
    """Friction at the positions where it is certain."""
    same = {name: k.part(DATA + name, out) for name in Friction._fields if DATA + name in k.nodes}
    count, never = len(locked), np.zeros(len(locked), bool)
    none = np.zeros(same["cz"].shape, bool)
    unknowns = int(c.known.requested.sum()) + len(c.known.link)
    return Friction(
        **same,
        critical=np.full(count, np.nan),
        single=~never,
        open=none,
        reversing=none.copy(),
        blocked=never,
        locked=locked,
        holding=np.full((count, unknowns, 2), np.nan),
    )
