"""Positions of the mechanism over the schedule: first pose, assembly mode, the motion from it, its gaps.

Mechanics: docs/theory.md 3.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from dalembert.algebra import plane
from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.compile.elements.teeth_in_space import fitted_contacts
from dalembert.analysis.compile.pose_loads import with_pose_loads
from dalembert.analysis.compile.torsion_turns import wound
from dalembert.analysis.degree_of_freedom import Mobility, check_drives, mobility_at
from dalembert.analysis.status.closure_failure import drive_text
from dalembert.arrays import Array, Ints
from dalembert.core.constraints import measure
from dalembert.core.elements.lining_rows import with_axis
from dalembert.core.elements.linings import BandStrands
from dalembert.core.elements.strand_rows import direction, strands, with_zero
from dalembert.core.gear_rows import MeshMisfit, mesh_wheels
from dalembert.core.layout import BeltMesh, Mesh, Pose
from dalembert.core.position.assembly_modes import Wanted, closing, stated_sides, wrap_angle
from dalembert.core.position.assur_plan import plan
from dalembert.core.position.dyads import sides
from dalembert.core.position.first_pose_plane import Guess, Modes, phase_rows, stated_measures, without_phase
from dalembert.core.position.first_pose_space import PoseGuess
from dalembert.core.position.motion_path import BLOCK, Path, path
from dalembert.core.position.newton import CLOSED, close_loops
from dalembert.core.position.path_parameter import PathSamples, course
from dalembert.core.rank import is_rigid, rank
from dalembert.errors import ModelError

SAMPLES = 12
"""Positions, spread over the course, at which a first pose is sought when the first of the list does not close."""

STATED = 1e-9
"""Angle, radians, or characteristic length, up to which a drive agrees with its links in `assembly`."""

NAMED = 8
"""Ranges behind gaps that are named, each by a position."""

FARTHEST = 1e4
"""Longest path between two positions that is followed, in radians or characteristic lengths."""

MESH = 1e-3
"""Relative error of a centre distance that a mesh of gears forgives."""


@dataclass(frozen=True)
class Positions:
    """The compiled mechanism with its phases set, its path, its mobility and a sentence on the assembly mode."""

    compiled: Compiled
    path: Path | None
    mobility: Mobility | None
    mode: str | None


def positions(c: Compiled) -> Positions:
    """Follow the mechanism over its schedule."""
    if not isinstance(c.guess, Guess):
        _refuse_far(c)
    first_pose = first_position(c)
    if first_pose is None:
        return Positions(c, None, None, None)
    place, first = first_pose
    stood = first.pose.at(0)
    c = _with_phase(c, first.pose.at(0))
    along = course(c.layout, c.targets)
    _refuse_endless(c, along)
    start = along.at(place)
    here = general = first.pose.at(0)
    if c.schedule.names and not is_rigid(c.layout, general):
        ahead, beside = _beside(c, along, start, first)
        general = general if beside is None else beside.pose.at(0)
        if beside is not None and len(c.targets) > 1:
            start, first = ahead, beside
    mobility = mobility_at(c, general, special=general is here)
    if mobility.redundant:
        c = replace(c, layout=replace(c.layout, redundant=True))
    motion = path(c.layout, first.pose.at(0), along, start, c.period, c.guess)
    sentences = [part for part in (mode_sentence(c, first), _ranges(c, motion)) if part]
    c = with_pose_loads(wound(c, (place, stood), motion), motion)
    return Positions(c, motion, mobility, "; ".join(sentences) or None)


def first_position(c: Compiled) -> tuple[int, Modes] | None:
    """The first position that closes on the branches that `assembly` gives, else on others, and its modes.

    Raises ModelError where none may close because the drives are too many: after one search, for all would take as long
    each.
    """
    other: tuple[int, Modes] | None = None
    for n, k in enumerate(_places_to_try(c)):
        modes = c.first_modes if k == 0 else c.guess.modes(c.layout, c.targets[k])
        if modes is None:
            if n == 0:
                _refuse_overdriven(c)
            continue
        if on_stated_sides(c, c.targets[k], modes):
            return int(k), modes
        other = other or (int(k), modes)
    return other


def on_stated_sides(c: Compiled, target: Array, modes: Modes) -> bool:
    """True if no group of the chosen mode is on another side than `assembly` states."""
    if not isinstance(c.guess, Guess) or modes.chosen_by in ("given", "drawn"):
        return True
    free, held = without_phase(c.layout, target, c.guess, hold=True)
    groups = plan(free)
    if groups is None or not groups.closed:
        return True
    stated = stated_sides(free, groups, held, Wanted(c.guess.turn, c.guess.point, None))
    first, nothing = modes.pose.at(slice(0, 1)), np.full((1, len(held)), np.nan)
    with np.errstate(all="ignore"):
        return not (sides(groups, first.turn, first.point, nothing)[0] * stated < 0).any()


def _places_to_try(c: Compiled) -> Iterator[int]:
    """Positions at which a first pose is sought: where the drives agree with `assembly`, some of all, then some of
    those at which groups in closed form close, however few these are."""
    stated = _stated_places(c)
    yield from stated
    sampled = np.setdiff1d(places_to_sample(course(c.layout, c.targets).order), 0)
    yield from np.setdiff1d(np.concatenate([[0], sampled]), stated)
    if not isinstance(c.guess, Guess):
        return
    free, start = without_phase(c.layout, c.targets[0], c.guess, hold=True)
    groups, constant = plan(free), start[: free.constraints.count]
    if groups is not None and groups.closed:
        drives = c.targets[:, c.layout.constraints.count :]
        targets = np.column_stack([np.broadcast_to(constant, (len(drives), len(constant))), drives])
        blocks = range(0, len(targets), BLOCK)
        yield from places_to_sample(
            np.concatenate([k + closing(groups, targets[k : k + BLOCK]) for k in blocks])
        )


def _stated_places(c: Compiled) -> Ints:
    """The position whose drives are where the links have the angles and places in `assembly`; none where these leave
    one of them open."""
    angular = c.layout.freedoms.angular[c.layout.driven]
    if not isinstance(c.guess, Guess) or not len(angular):
        return np.zeros(0, np.intp)
    turn = np.append(c.guess.turn[:-1], 0.0)
    pose = Pose(c.guess.point, turn, plane.rotation(turn))
    stands = measure(c.layout.algebra, c.layout.freedoms, pose)[c.layout.driven]
    if not angular.all() and np.isnan(stands).any():
        stands = np.where(np.isnan(stands), stated_measures(c.layout, c.target, c.guess), stands)
    off = np.abs(c.targets[:, c.layout.constraints.count :] - stands)
    off = np.where(angular, np.abs(wrap_angle(off)), off / c.layout.length)
    return np.flatnonzero(off.max(axis=1) < STATED)[:1]


def places_to_sample(places: Ints) -> Ints:
    """A few of some positions, spread over all of them."""
    kept = np.linspace(0, len(places) - 1, min(len(places), SAMPLES)).astype(int)
    return np.asarray(places[kept])


def _beside(c: Compiled, along: PathSamples, start: float, first: Modes) -> tuple[float, Modes | None]:
    """The mode nearest to the first pose a little further on: the first may be a change point, where the mobility
    cannot be determined, and from which the motion cannot be continued."""
    near = c.guess.near(first.pose.at(0))
    if along.end > 0:
        step = min(0.02, along.end / 2)
        places = [s for s in (start + step, start - step) if 0 <= s <= along.end]
        candidates = ((s, _in_phase(c, along.target(s)[0], near)) for s in places)
        return next(((s, modes) for s, modes in candidates if modes is not None), (start, None))
    angular = c.layout.freedoms.angular[c.layout.driven]
    nudge = np.concatenate([np.zeros(len(c.target)), 0.05 * np.where(angular, 1.0, c.layout.length)])
    sides = (_in_phase(c, c.targets[0] + sign * nudge, near) for sign in (1, -1))
    return start, next((candidates for candidates in sides if candidates is not None), None)


def _in_phase(c: Compiled, target: Array, near: Guess | PoseGuess) -> Modes | None:
    """Modes near a pose, the first of them with its meshes in the phase they already have."""
    modes = near.modes(c.layout, target)
    if modes is None or not phase_rows(c.layout.constraints).size:
        return modes
    pose, missing = close_loops(c.layout, modes.pose.at(slice(0, 1)), target[None])
    return modes._replace(pose=pose) if missing[0] <= CLOSED * c.layout.length else None


def _with_phase(c: Compiled, first: Pose) -> Compiled:
    """Targets of meshes and rolling wheels: their measures at the first pose."""
    rows = phase_rows(c.layout.constraints)
    if not rows.size:
        return c
    _check_meshes(c, first)
    c = _with_bands(_with_strands(c, first), first)
    layout, misfits = mesh_wheels(c.layout, first)
    for misfit in misfits:
        _check_misfit(c, misfit)
    c = replace(c, layout=layout, contacts=fitted_contacts(c.mechanism, c.contacts, layout, first))
    target = c.target.copy()
    target[rows] = measure(c.layout.algebra, c.layout.constraints, first)[rows]
    return replace(c, target=target)


def _with_strands(c: Compiled, first: Pose) -> Compiled:
    """Strands of ropes from their directions at the first pose on; checks that each reaches from wheel to wheel."""
    f = strands(c.layout)
    if f is None:
        return c
    _, length = direction(c.layout.algebra, f, first)
    short = np.flatnonzero(~np.isfinite(length))
    if short.size:
        name = c.joints[c.layout.constraints.joint[f.row[short[0]]]]
        what = f"strand {name!r} is within its wheel at the first position"
        remedy = "give its ends a place there: assembly: {load: [x, y, angle]}"
        raise ModelError(what, remedy, ("joints",))
    rows = c.layout.constraints
    families = tuple(with_zero(c.layout, x, first) if x is f else x for x in rows.families)
    return replace(c, layout=replace(c.layout, constraints=replace(rows, families=families)))


def _with_bands(c: Compiled, first: Pose) -> Compiled:
    """Bands whose strands are parallel, with the direction that they have at the first pose."""
    rows, g = c.layout.constraints, c.layout.algebra
    families = tuple(with_axis(g, f, first) if isinstance(f, BandStrands) else f for f in rows.families)
    return replace(c, layout=replace(c.layout, constraints=replace(rows, families=families)))


GEAR = "gear {}: centres {} m apart, but pitch radii {} m and {} m need {} m"
GEAR_REMEDY = "change the radii or move a centre"


def _check_meshes(c: Compiled, first: Pose) -> None:
    """Checks that wheels in mesh are at the sum (internal: difference) of their pitch radii."""
    g, constraints = c.layout.algebra, c.layout.constraints
    for f in constraints.families:
        if not isinstance(f, Mesh):
            continue
        check = _check_belt if isinstance(f, BeltMesh) else _check_mesh
        a = first.point[f.i] + g.rotate(first.rotation[f.i], f.ui)
        b = first.point[f.j] + g.rotate(first.rotation[f.j], f.uj)
        for k, distance in enumerate(np.hypot(*(b - a).T)):
            check(c.joints[constraints.joint[f.row[k]]], float(distance), float(f.ri[k]), float(f.rj[k]))


def _check_mesh(name: str, distance: float, ri: float, rj: float) -> None:
    wanted = ri + rj
    if abs(distance - wanted) > MESH * wanted:
        what = GEAR.format(repr(name), *(f"{x:.6g}" for x in (distance, abs(ri), abs(rj), wanted)))
        raise ModelError(what, GEAR_REMEDY, ("joints", name))


def _check_belt(name: str, distance: float, ri: float, rj: float) -> None:
    needed = abs(ri) + abs(rj)
    if distance <= needed:
        what = f"belt {name!r}: centres {distance:.6g} m apart, but its wheels need more than {needed:.6g} m"
        raise ModelError(what, "make a wheel smaller or move a centre", ("joints", name))


def _check_misfit(c: Compiled, misfit: MeshMisfit) -> None:
    """Wheels in space touch at their pitch point, but for what rounded figures leave."""
    for row, scale, gap, inside in zip(*misfit, strict=True):
        name = c.joints[c.layout.constraints.joint[row]]
        if gap > MESH or abs(scale) > MESH:
            wrong = (
                f"radii {abs(scale):.2%} too {'small' if scale > 0 else 'large'}, "
                if abs(scale) > MESH
                else ""
            )
            what = f"gear {name!r}: the pitch circles do not touch ({wrong}{gap:.2%} of them apart)"
            remedy = "its points are the centres of the pitch circles; change the radii, or move a point or an axis"
            raise ModelError(what, remedy, ("joints", name))
        internal = bool(getattr(c.mechanism.joints[name], "internal", False))
        if inside and (inside > 0) != internal:
            what = f"gear {name!r}: one wheel lies {'within' if inside > 0 else 'beside'} the other"
            remedy = "write internal: true" if inside > 0 else "leave internal out, or move a centre"
            raise ModelError(what, remedy, ("joints", name, "internal"))


def _refuse_endless(c: Compiled, along: PathSamples) -> None:
    """Nobody waits for a motion of millions of turns between two positions: it is a slip of the pen or of the unit."""
    steps = np.diff(along.s)
    if not steps.size or (steps <= FARTHEST).all():
        return
    k = int(np.argmax(~(steps <= FARTHEST)))
    moved = np.abs(np.diff(c.schedule.position[along.order[k : k + 2]], axis=0))[0]
    drive = int(np.argmax(moved))
    texts = [drive_text(c, int(place), drive) for place in along.order[k : k + 2]]
    what = f"drive {c.schedule.names[drive]!r} goes from {texts[0]} to {texts[1]} between two positions"
    remedy = f"check the position and its unit; {FARTHEST:.0e} rad or link lengths at a time can be followed"
    raise ModelError(what, remedy, ("drives", c.schedule.names[drive], "position"))


def _refuse_far(c: Compiled) -> None:
    """In space the first pose is followed from the drawing, with all drives at 0."""
    away = np.abs(c.schedule.position[0])
    away = away / np.where(c.layout.freedoms.angular[c.layout.driven], 1.0, c.layout.length)
    if away.size and not away.max() <= FARTHEST:
        k = int(np.argmax(away))
        what = f"drive {c.schedule.names[k]!r} begins at {drive_text(c, 0, k)}, and is at 0 as drawn"
        remedy = f"check the position and its unit; {FARTHEST:.0e} rad or link lengths can be followed"
        raise ModelError(what, remedy, ("drives", c.schedule.names[k], "position"))


def _refuse_overdriven(c: Compiled) -> None:
    """Checks, where a position does not close, whether there are more drives than freedoms."""
    if c.layout.stack.count <= c.layout.unknowns:
        return  # as many freedoms as drives at least
    layout = replace(c.layout, driven=np.zeros(0, np.intp))
    modes = c.guess.modes(layout, c.target)
    if modes is None:
        return
    free = rank(layout, modes.pose.at(0))
    if free.freedoms < len(c.schedule.names):
        check_drives(c, free, Mobility(free.freedoms, len(c.schedule.names), free.redundant, ()))


WHY = {
    "nearest": "nearest to the file's assembly",
    "open": "the angles in the file's assembly do not decide",
    "search": "from a search",
}
"""Reasons for an assembly mode."""


def mode_sentence(c: Compiled, modes: Modes) -> str | None:
    """Chosen assembly mode, and the others; None where the file chose it and it is the only one."""
    if modes.chosen_by in ("given", "drawn"):
        return None
    names = _mode_names(c, modes.pose)
    why = WHY[modes.chosen_by]
    others = (
        f"; other modes (the file's `assembly` chooses): {' | '.join(names[1:5])}" if len(names) > 1 else ""
    )
    more = f" and {len(names) - 5} more" if len(names) > 5 else ""
    return f"assembly mode {names[0]} ({why}){others}{more}"


def _ranges(c: Compiled, motion: Path) -> str | None:
    """Ranges that no motion from the first pose reaches, by the positions at which they were entered."""
    if not motion.entered:
        return None
    at = [
        " and ".join(f"{n} = {drive_text(c, k, d)}" for d, n in enumerate(c.schedule.names))
        for k in motion.entered
    ]
    many = "a range is" if len(at) == 1 else f"{len(at)} ranges are"
    at = at[:NAMED] + [f"{len(at) - NAMED} more"] * (len(at) > NAMED)
    return (
        f"{many} beyond a gap in which the linkage does not close, and cannot be reached from the first pose: "
        f"beyond it (at {', '.join(at)}) every group of links keeps its branch"
    )


def _mode_names(c: Compiled, pose: Pose) -> list[str]:
    """Each mode by the angles that distinguish it from the others: of links, in space of joints."""
    if c.geometries:
        rows = np.setdiff1d(np.flatnonzero(c.layout.freedoms.angular), c.layout.driven)
        names = [" ".join(part for part in c.freedoms[k] if part != "turn") for k in rows]
        turn = measure(c.layout.algebra, c.layout.freedoms, pose)[:, rows]
    else:
        names, turn = list(c.links), pose.turn[:, :-1]
    moving = np.ptp(np.sin(turn / 2), axis=0) > 1e-6
    shown = [k for k in range(len(names)) if moving[k]][:4] or list(range(min(len(names), 4)))
    return [", ".join(f"{names[k]} {math.degrees(mode[k]):.2f} deg" for k in shown) for mode in turn]
