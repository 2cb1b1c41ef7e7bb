"""From a description to a traced analysis: the compile step on symbols, then the kernel's trace."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from dalembert.analysis.batch.tracing.course import PositionPath
from dalembert.analysis.batch.tracing.kernel_inputs import Inputs
from dalembert.analysis.batch.tracing.outputs import Catalogue
from dalembert.analysis.batch.tracing.symbolic_model import (
    VariedNumber,
    functions,
    geometric,
    numbers,
    symbolic,
)
from dalembert.analysis.batch.tracing.traced_parameters import is_table
from dalembert.analysis.batch.tracing.traced_tables import margins
from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.analysis.compile.elements.teeth_in_space import like_contacts
from dalembert.analysis.compile.pose_loads import coordinates, parts
from dalembert.analysis.degree_of_freedom import check_knowns
from dalembert.analysis.elements.turning_speeds import solves_speed
from dalembert.analysis.methods.elements.cylinder_quantities import stroke_margins
from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.named_quantities import quantity
from dalembert.analysis.result.result import Result
from dalembert.analysis.status.closure_failure import open_sentence
from dalembert.analysis.status.freewheeling import grip_margins, released_joints
from dalembert.arrays import Array, Tree
from dalembert.core.constraints import stack_rows, system
from dalembert.core.elements.strand_family import Strand
from dalembert.core.elements.strand_rows import strands
from dalembert.core.equilibrium import UNIQUE, Known, usual
from dalembert.core.factor import factor
from dalembert.core.forcing import Forcing, WrenchSource
from dalembert.core.gear_rows import gearings
from dalembert.core.layout import Family, Gearing, Idle, Layout, Pose
from dalembert.core.linear import PseudoInverse
from dalembert.errors import ModelError
from dalembert.kernel.graph import Graph, Node, node, trace_array
from dalembert.kernel.position.rigid_parts import DEAD
from dalembert.kernel.trace import Traced, TracedProblem, trace
from dalembert.model import Mechanism, Schedule


@dataclass(frozen=True)
class Trace:
    """A traced analysis with the inputs it was traced on."""

    course: PositionPath
    inputs: Inputs
    numbers: tuple[VariedNumber, ...]
    catalogue: Catalogue
    inertia: bool
    redundant: bool = False

    def unique(self, outputs: Sequence[str] | None) -> tuple[str, ...]:
        """The outputs, default all that are unique; raises ModelError where constraints are redundant and statics alone
        does not determine a requested one."""
        m, names = self.course.mechanism, self.catalogue.defaults() if outputs is None else outputs
        if not (self.redundant and names):
            return tuple(names)
        rigid = {name: joint.model_copy(update={"stiffness": None}) for name, joint in m.joints.items()}
        r = at_schedule(m.model_copy(update={"joints": rigid}), self.course.schedule, self.inertia)
        here = np.isin(r.status, ("redundant", "self_locking"))
        shared = "|".join(re.escape(j) for j in r.joints if not here.any() and not r.unique(j).all())
        named = re.compile(rf"\breaction(_moment)?\.({shared})(?![\w-])" if shared else "(?!)")
        open_ = [n for n in names if np.isnan(quantity(r, n).values[here]).any() or named.search(n)]
        if open_ and outputs is not None:
            raise ModelError(
                f"{' and '.join(open_)} cannot be compiled: constraints are redundant, and statics alone does not "
                "determine it",
                "leave it out, free a constraint, or use da.dynamics, which shows the unique reactions",
                ("joints",),
            )
        return tuple(name for name in names if name not in open_)


def _schedule(m: Mechanism, moves: bool) -> Schedule:
    """The positions of the file; where the drives move on, time is an input of every state."""
    schedule = m.schedule()
    if schedule.unknown is not None:
        raise ModelError("equilibrium positions cannot be compiled", "give the drive positions", ("drives",))
    return replace(schedule, time=np.zeros(schedule.count)) if moves else schedule


def trace_analysis(
    m: Mechanism,
    vary: Iterable[str],
    inertia: bool,
    solved: Result | None = None,
    moves: bool = False,
    sided: bool = False,
    redundant: bool = False,
    unsplit: bool = False,
    functions_of: Callable[[Graph], Tree] = functions,
    followed: bool = False,
    pushed: Sequence[tuple[str, str]] = (),
) -> Trace:
    """Everything an analysis computes, as nodes; raises ModelError for cases that only the analyses support.

    With the general executor's answer for the numbers of the file, ``solved``: starts from a known solution.
    ``moves``: the drives continue from the known motion, which is that of the previous state. ``sided``: with the side
    of reversals as an input. ``redundant``: constraints may repeat each other; reactions that are not unique are then
    one choice of many; ``unsplit``: links placed by these are solved with all constraints at once. ``functions_of`` a
    graph: those of loads by the pose. ``followed``: branches of closed forms and phases of wheels are inputs, as the
    motion is followed where the program runs. ``pushed``: freedoms of joints in which a force acts that is an input,
    ``push k``.
    """
    schedule = _schedule(m, moves)
    course = PositionPath(m, schedule, solved, inertia)
    check_knowns(course.compiled)
    repeated, where = _check(course, redundant), numbers(m, vary)
    moved = [n for n in where if geometric(m, n.path)]
    _check_space(course.compiled, moved)
    graph = Graph()
    inputs = Inputs(graph, course, followed)
    description = symbolic(m, where, graph, inputs.load)
    drives = inputs.drives(description)
    like, phased = course.followed.compiled, followed and m.dimension == 2
    c, margins = inputs.turns(compile_mechanism(description, _symbolic(schedule, drives.position), like=like))
    _refuse_slip_limits(c)
    problem = TracedProblem(
        graph=graph,
        layout=with_meshes(c.layout, like.layout),
        forcing=c.forcing,
        known=_known(inputs, c, functions_of(graph)),
        target=_targets(c.target, like.target, like.layout, inputs if phased else None),
        drives=drives,
        first=inputs.drives(description, "common"),
        like=like.layout,
        like_target=like.targets[course.first],
        guess=like.guess,
        inertia=inertia,
        path=inputs.path("channel"),
        first_path=inputs.path("common"),
        signs=inputs.signs,
        slips=None if solved is None else inputs.slips(c),
        reversals=None if solved is None else inputs.reversals(c),
        margins=margins if moved else {},
        contacts=like_contacts(description, c.contacts, m, like.contacts),
        at_pose=_pushes(inputs, c, pushed, _pose_loads(inputs, c, functions_of(graph))),
        pushing=c.pushing,
        usual=usual(like.layout, like.known, course.pose),
        moves=moves,
        side=inputs.side() if sided else None,
        redundant=repeated,
        unsplit=unsplit and repeated,
        phased=phased,
    )
    motion = drives.position, drives.speed, drives.acceleration
    traced = _run(problem, c, decided=moves or solved is not None)
    catalogue = Catalogue(
        graph, replace(c, forcing=traced.forcing, contacts=problem.contacts), traced, motion, inputs, inertia
    )
    return Trace(course, inputs, where, catalogue, inertia, repeated)


AtPose = Callable[[Forcing, Pose, Array], Forcing]
"""Loads that follow from the pose and the twist."""


def _pose_loads(inputs: Inputs, c: Compiled, known: Tree) -> AtPose | None:
    """Loads that depend on the pose, by speeds, or by the time of a constant speed, as nodes of these."""
    graph = inputs.graph
    _note_table_ends(inputs)
    inside = {k: v for k, v in inputs.varying.items() if k.startswith("loads.") and inputs.inside(v)}
    if not inside:
        return None

    def at_pose(forcing: Forcing, pose: Pose, twist: Array) -> Forcing:
        driven = inputs.known()
        names = {name for varying in inside.values() for name in varying.names if parts(name)}
        at = coordinates(c, pose, sorted(names), twist)
        at = {of: value + inputs.pose_turns(of) for of, value in at.items()}
        places = {
            inputs.named["channel", name].index: node(graph, varying.at({**driven, **at}, known))
            for name, varying in inside.items()
        }
        forces, couples = forcing.forces, forcing.couples
        return replace(
            forcing,
            forces=replace(forces, value=_substituted(graph, forces.value, places)),
            couples=replace(couples, value=_substituted(graph, couples.value, places)),
        )

    return at_pose


def _pushes(
    inputs: Inputs, c: Compiled, freedoms: Sequence[tuple[str, str]], at_pose: AtPose | None
) -> AtPose | None:
    """The loads at a pose with those in freedoms of joints that are inputs."""
    if not freedoms:
        return at_pose
    place = np.array([c.freedoms.index(of) for of in freedoms], np.intp)
    size = np.array([inputs.graph.input("number", f"push {k}", 0.0) for k in range(len(place))], object)

    def with_pushes(forcing: Forcing, pose: Pose, twist: Array) -> Forcing:
        rows = system(c.layout.algebra, c.layout.freedoms, pose)
        wrench = np.concatenate([rows.on_i[place], rows.on_j[place]]) * np.tile(size, 2)[:, None]
        source = WrenchSource(np.concatenate([rows.i[place], rows.j[place]]), wrench)
        return replace(at_pose(forcing, pose, twist) if at_pose else forcing, pushes=source)

    return with_pushes


def _known(inputs: Inputs, c: Compiled, functions: Tree) -> Known:
    """Known efforts, those by speeds and by the time of a constant speed as nodes of these."""
    places = {
        inputs.named["channel", name].index: node(inputs.graph, varying.at(inputs.known(), functions))
        for name, varying in inputs.varying.items()
        if name.startswith("drives.") and inputs.inside(varying)
    }
    if not places:
        return c.known
    return replace(c.known, effort=_substituted(inputs.graph, c.known.effort, places))


def _note_table_ends(inputs: Inputs) -> None:
    """Note where tables over drives and time, which are computed outside, end."""
    known = inputs.known()
    for table in inputs.varying.values():
        if is_table(table) and not inputs.inside(table) and table.against in known:
            inputs.graph.outside += margins(table, known[table.against] - table.shift)


def _substituted(graph: Graph, array: Array, places: dict[int, Node]) -> Array:
    nodes = graph.substitute(list(trace_array(graph, array).ravel()), places)
    return np.array(list(nodes), object).reshape(array.shape)


def _check(course: PositionPath, redundant: bool) -> bool:
    """True if constraints are redundant."""
    followed = course.followed
    if solves_speed(course.compiled) and course.compiled.contacts is not None:
        what = "with friction an unknown speed of turning cannot be compiled"
        raise ModelError(what, "give the speed and read the effort, or use da.statics", ("turning", "speed"))
    if followed.path is None:
        raise ModelError(
            open_sentence(course.compiled, None, np.arange(len(course.schedule.position))).rstrip(".")
        )
    mobility = followed.mobility
    repeated = mobility is not None and mobility.redundant > 0
    if mobility is not None and repeated and not redundant:
        joints = ", ".join(mobility.redundant_joints)
        raise ModelError(
            f"{mobility.redundant} redundant constraint(s) among joints {joints}: not all reactions follow "
            "from equilibrium, so it cannot be compiled",
            "free a constraint, or use the analyses, which show the unique reactions",
            ("joints",),
        )
    if repeated and course.followed.compiled.contacts is not None:
        _refuse_friction(course)
    return repeated


def _refuse_friction(course: PositionPath) -> None:
    """Raise ModelError where friction follows a reaction that is not unique."""
    c = course.followed.compiled
    assert c.contacts is not None
    forces = factor(c.layout, stack_rows(c.layout, course.pose))
    assert isinstance(forces, PseudoInverse)
    free = np.nan_to_num(np.abs(forces.null)).max(axis=(0, 2))
    loose = free[: c.layout.constraints.count] > UNIQUE
    rubbing = (c.contacts.read[..., loose] != 0).any(axis=(0, 2))
    if rubbing.any():
        names = list(dict.fromkeys(c.joints[k] for k in c.contacts.joint[rubbing]))
        raise ModelError(
            f"friction in {', '.join(names)} follows reactions that are not unique, as constraints are redundant: so "
            "neither the accelerations nor the efforts are",
            "free a constraint, or leave that friction out",
            ("joints", names[0]),
        )


def _check_space(c: Compiled, moved: list[VariedNumber]) -> None:
    """Refuses cases in space that are not compiled."""
    if c.layout.algebra.d == 2:
        return
    links = dict(enumerate(c.links))
    for f in c.contacts.rows.families if c.contacts is not None else ():
        rods = [links[end] for end in (*f.i, *f.j) if links.get(end) in c.passive]
        if rods:
            what = f"how fast rod {rods[0]!r} spins in its balls follows from their friction, so it cannot be compiled"
            raise ModelError(what, "leave that friction out, or use da.dynamics or da.statics", ("joints",))
    layout = c.layout
    spun = [
        c.links[j] for f in layout.constraints.families if isinstance(f, Idle) for j in f.j[f.stands == 0]
    ]
    wheels = [name for name, joint in c.mechanism.joints.items() if joint.wheels]
    why = ""
    if wheels:
        why = f"the wheels of gear {wheels[0]!r} in space are fitted to each other at the first position"
    elif spun:
        why = f"the spin of link {spun[0]!r} depends on its motion from the first position, as a ball moves along it"
    if moved and why:
        what = f"{moved[0].path!r} places joints, and {why}: so it cannot vary"
        raise ModelError(what, "leave it out, or use da.dynamics or da.statics", moved[0].keys)


def with_meshes(layout: Layout, known: Layout) -> Layout:
    """The layout with what the known one has from its first position: meshes in space, directions of ropes' strands."""
    fitted, begun = iter(gearings(known)), strands(known)

    def first(f: Family) -> Family:
        if isinstance(f, Gearing):
            return next(fitted)
        return replace(f, axis=begun.axis, zero=begun.zero) if begun and isinstance(f, Strand) else f

    families = tuple(first(f) for f in layout.constraints.families)
    return replace(layout, constraints=replace(layout.constraints, families=families))


def _symbolic(schedule: Schedule, position: Array) -> Schedule:
    row = position[None]
    return Schedule(schedule.names, row, row, row)


def _targets(symbolic: Array, known: Array, layout: Layout, inputs: Inputs | None) -> Array:
    """Constants of the constraints; phases of meshes and rolling wheels are those of the known motion, or inputs."""
    from dalembert.core.position.first_pose_plane import phase_rows

    out = np.array(symbolic, object)
    rows = phase_rows(layout.constraints)
    out[rows] = known[rows] if inputs is None else inputs.phases(known, rows)[rows]
    return out


def _run(problem: TracedProblem, c: Compiled, decided: bool) -> Traced:
    """The traced analysis; unless ``decided`` elsewhere, strokes and clutches are left to the general executor."""
    try:
        traced = trace(problem)
    except ZeroDivisionError:  # by constants: what varies is a symbol
        what = "a link's joints coincide, or a length or a mass that a compiled analysis divides by is zero"
        raise ModelError(what, "use da.dynamics or da.sweep, or give it another value", ("links",)) from None
    except ValueError as error:
        if isinstance(error, ModelError):
            raise
        if c.contacts is None or "singular" not in str(error):
            raise ModelError(f"the mechanism cannot be compiled: {error}", "use the analyses") from error
        raise _through_friction(c) from None
    if not decided:
        margins = stroke_margins(c.mechanism, c.schedule.names, problem.drives.position)
        margins += grip_margins(c.mechanism)
        traced.doubt.extend(node(problem.graph, margin) for margin in margins)
        if released_joints(c.mechanism):
            traced.doubt.append(-1.0 - abs(traced.effort[0]))
        if not problem.phased:  # else the motion is followed
            traced.doubt.extend(_on_one_side(traced.pivots))
    return traced


def _on_one_side(pivots: Sequence[Node]) -> Iterator[Node]:
    """Negative where a pivot has the other sign than along the file's motion: the motion of that design decides
    whether it reaches the position, or would have to pass through infinity."""
    for pivot in pivots:
        (values,) = pivot.graph.evaluate([pivot], {})
        signs = np.sign(values[values * values > DEAD])
        if len(np.unique(signs)) == 1:
            yield float(signs[0]) * pivot


def _through_friction(c: Compiled) -> ModelError:
    """Sentence on an unknown that has power only through friction."""
    of = [f"load {name!r}" for name in c.unknown_loads] or ["an effort"]
    what = f"{' or '.join(of)} acts only through friction, which neither a compiled analysis nor a live page solves"
    remedy = "give its value and ask for the effort of a drive, or use the analyses (`dalembert solve`)"
    return ModelError(what, remedy, ("loads", c.unknown_loads[0]) if c.unknown_loads else ("drives",))


def _refuse_slip_limits(c: Compiled) -> None:
    """Refuse wheels that roll with friction: whether they slip is not checked."""
    if c.pushing is not None and c.pushing.slips.any():
        wheel = c.joints[c.pushing.joint[c.pushing.slips][0]]
        raise ModelError(
            f"whether {wheel!r} slips on its track is not checked in compiled analyses",
            "leave its friction out here, or use dynamics",
            ("joints", wheel, "friction"),
        )
