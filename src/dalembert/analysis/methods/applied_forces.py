"""Every force and couple on every link, one by one, with the point where it acts: what a free body shows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from dalembert.analysis.compile.plane_rows import signed_radii
from dalembert.analysis.methods.band_actions import has_strands, on_drum
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.analysis.result.kept import kept
from dalembert.analysis.result.reaction_axes import force_and_moment
from dalembert.answer.equality import Compared
from dalembert.arrays import Array, Tree
from dalembert.core.constraints import system
from dalembert.core.equilibrium import LinkMotions, known_sources, motion
from dalembert.core.forcing import WrenchSource
from dalembert.core.gear_rows import gearings, separation
from dalembert.core.geometry import arm
from dalembert.core.layout import ConstraintRows, Pose
from dalembert.core.linear import Factor
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

Kind = Literal["joint", "friction", "effort", "load", "weight", "spring", "damper", "inertia"]


@dataclass(frozen=True, eq=False)
class Action(Compared):
    """A force (P, d) at a point (P, d) and a couple (P,), in space (P, 3), on a link, all in ground axes.

    ``source`` is the contribution it belongs to in a superposition, empty for joints' reactions; ``by`` the link that
    exerts it, where it is one; ``of`` the joint, drive or load. ``part`` of a joint's reaction, empty where it is
    unsplit: `normal` where dry friction along a slide is separate, `ahead` or `behind` at a corner of a guide.
    """

    of: str
    kind: Kind
    source: str
    link: str
    by: str | None
    at: Array
    force: Array
    couple: Array
    part: str = ""

    def moment(self, about: Array) -> Array:
        """Moment (P,), in space (P, 3), about a point (P, d): couple + r x F."""
        r = self.at - about
        if r.shape[-1] == 3:
            return np.asarray(self.couple + np.cross(r, self.force))
        return np.asarray(self.couple + r[..., 0] * self.force[..., 1] - r[..., 1] * self.force[..., 0])

    def power(self, velocity: Array, spin: Array) -> Array:
        """Power (..., P) for velocities (..., P, d) of its point and spins (..., P) or (..., P, 3) of its link."""
        turning = self.couple * spin
        return np.asarray(
            (self.force * velocity).sum(axis=-1) + (turning.sum(axis=-1) if self.couple.ndim > 1 else turning)
        )


class State(NamedTuple):
    """The core's view of a result: pose, motion, rows of A and its factors."""

    pose: Pose
    moving: LinkMotions
    rows: ConstraintRows
    solver: Factor


@kept
def state(r: Result) -> State:
    """Pose and motion of the links of a result, ready for the core's functions."""
    c = r.compiled
    pose = full_pose(r)
    with np.errstate(all="ignore"):
        moving, rows, solver = motion(c.layout, pose, c.schedule.speed, c.schedule.acceleration)
    return State(pose, moving, rows, solver)


@kept
def actions(r: Result) -> tuple[Action, ...]:
    """Everything that acts on the links: reactions of joints, efforts, loads, weights, inertia.

    Units N, N m, m; the sum over a link is zero (ground aside) at every solved position.
    """
    return (*joint_actions(r), *other_actions(r))


@kept
def full_actions(r: Result) -> tuple[Action, ...]:
    """The same with dry friction inside the reactions, at the joints' places."""
    return (*joint_actions(r, split=False), *other_actions(r))


@kept
def other_actions(r: Result) -> tuple[Action, ...]:
    """Everything but the reactions of joints."""
    return (*effort_actions(r), *known_actions(r), *unknown_load_actions(r))


def forces_on(r: Result, link: str) -> dict[str, tuple[Action, ...]]:
    """Forces on a link by class: `joint`, `applied` (loads, weights, springs, efforts), `friction`, `inertia`.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> found = da.forces_on(da.dynamics(da.load(examples()["four_bar"])), "coupler")
    >>> {name: [a.of for a in some] for name, some in found.items()}
    {'joint': ['A', 'B'], 'applied': ['F_P'], 'friction': [], 'inertia': ['coupler', 'coupler']}
    """
    classes = {"joint": "joint", "friction": "friction", "damper": "friction", "inertia": "inertia"}
    out: dict[str, list[Action]] = {"joint": [], "applied": [], "friction": [], "inertia": []}
    for a in on_link(actions(r), link):
        out[classes.get(a.kind, "applied")].append(a)
    return {name: tuple(some) for name, some in out.items()}


def on_link(all_of_them: tuple[Action, ...], link: str) -> tuple[Action, ...]:
    """Those on one link."""
    return tuple(a for a in all_of_them if a.link == link)


def joint_actions(r: Result, split: bool = True) -> tuple[Action, ...]:
    """Reactions of all joints, on both links; ``split`` takes the part of dry friction by itself."""
    out = []
    for joint in r.joints:
        i, j = r.mechanism.joints[joint].links
        at = joint_place(r, joint)
        for on, by in ((j, i), (i, j)):
            force, moment = force_and_moment(r.least_norm(joint, on))
            friction, couple = r.friction_force(joint, on), r.friction_moment(joint, on)
            if on == i and has_strands(r, joint):
                (force, moment), (friction, couple) = on_drum(r, joint, at)
            slides, turns = (np.nan_to_num(v).any() for v in (friction, couple))
            if not split or not (slides or turns):
                out.append(Action(joint, "joint", "", on, by, at, force, moment))
                continue
            part = "normal" if slides else ""
            out.append(Action(joint, "joint", "", on, by, at, force - friction, moment - couple, part))
            out.append(Action(joint, "friction", "", on, by, at, friction, couple))
    return tuple(out)


def friction_actions(r: Result) -> tuple[Action, ...]:
    """Dry friction and, beside it, damping of each joint on j, exerted by i, at j's point."""
    if r.friction is None:
        return ()
    f, out = r.friction, []
    for k, joint in enumerate(r.joints):
        i, j = r.mechanism.joints[joint].links
        at = joint_place(r, joint)
        rubbing = (f.force[:, k], f.moment[:, k])
        if has_strands(r, joint):  # its power is that on the drum
            force, couple = on_drum(r, joint, at)[1]
            rubbing = (-force, -couple)
        for source, force, couple in (
            (f"friction in {joint}", *rubbing),
            (f"damping of {joint}", f.viscous_force[:, k], f.viscous_moment[:, k]),
        ):
            if force.any() or couple.any():
                out.append(Action(joint, "friction", source, j, i, at, force, couple))
    return tuple(out)


def joint_place(r: Result, joint: str) -> Array:
    """Point where a joint's reaction acts (P, d): j's point, or the contact of a higher pair."""
    described: Any = r.mechanism.joints[joint]
    (i, j), (ui, uj) = described.links, r.mechanism.joint_points(joint)
    pj = link_place(r, j, uj)
    if not described.wheels or described.WRAPPED:
        return pj
    if r.mechanism.dimension == 3:
        return _pitch_point(r, joint)
    if described.wheels == 1:
        angle = link_angle(r, i) + described.direction
        return np.asarray(pj + described.radius * np.stack([np.sin(angle), -np.cos(angle)], axis=-1))
    pi = link_place(r, i, ui)
    ri, rj = signed_radii(described)
    return np.asarray(pi + (pj - pi) * (ri / (ri + rj)))


def _pitch_point(r: Result, joint: str) -> Array:
    """Contact point of the wheels of a mesh in space (P, 3)."""
    layout, k = r.compiled.layout, r.joints.index(joint)
    f = next(f for f in gearings(layout) if k in layout.constraints.joint[f.row])
    _, contact = separation(layout.algebra, f, full_pose(r))
    mine = list(layout.constraints.joint[f.row]).index(k)
    return np.asarray(contact[..., mine, :] + r.compiled.origin)


def link_place(r: Result, link: str, u: Sequence[float] | Array) -> Array:
    """A point of any link, ground included (P, d)."""
    if link == GROUND:
        return np.broadcast_to(np.asarray(u), (len(r.status), len(u)))
    return r._place(link, np.asarray(u))


def link_angle(r: Result, link: str) -> Array:
    """In the plane: angle of any link, ground included (P,)."""
    return np.zeros(len(r.status)) if link == GROUND else r.angle(link)


def link_speed(r: Result, link: str) -> Array:
    """In the plane: angular velocity of any link, ground included (P,)."""
    return np.zeros(len(r.status)) if link == GROUND else r.speed(link)


def effort_actions(r: Result) -> tuple[Action, ...]:
    """Efforts of the drives on both links; given ones are separate sources."""
    out = []
    for k, drive in enumerate(r.drives):
        joint = r.mechanism.drives[drive].joint or drive
        i, j = r.mechanism.joints[joint].links
        source = "" if r.compiled.known.requested[k] else f"effort of {drive}"
        at = joint_place(r, joint)
        force, couple = drive_wrench(r, drive, r.effort(drive))
        out += [
            Action(drive, "effort", source, on, by, at, s * force, s * couple)
            for on, by, s in ((j, i, 1), (i, j, -1))
        ]
    return tuple(out)


def drive_wrench(r: Result, drive: str, value: Array) -> tuple[Array, Array]:
    """Force and couple (P,) of a drive's effort on link j, at the joint's point on j; one of the two is zero."""
    d, row = r.compiled.layout.algebra.d, int(r.compiled.layout.driven[r.drives.index(drive)])
    with np.errstate(all="ignore"):
        rows = system(r.compiled.layout.algebra, r.compiled.layout.freedoms, full_pose(r))
    j = (*r.links, GROUND).index(r.mechanism.joints[r.mechanism.drives[drive].joint or drive].links[1])
    unit = (rows.on_j if rows.j[row] == j else rows.on_i)[:, row, :]
    if not r.compiled.layout.freedoms.angular[row]:
        return value[:, None] * unit[:, :d], np.zeros((len(value), 3) if d == 3 else len(value))
    return np.zeros((len(value), d)), value[:, None] * unit[:, d:] if d == 3 else value


def slide_direction(r: Result, joint: str) -> Array:
    """In the plane: unit vector of a joint's slide (P, 2), ground axes."""
    described = r.mechanism.joints[joint]
    angle = link_angle(r, described.links[0]) + float(getattr(described, "direction", 0.0) or 0.0)
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def normal_direction(r: Result, joint: str) -> Array:
    """In the plane: unit vector (P, 2), ground axes, of the force on j of a joint that carries one along its normal."""
    layout = r.compiled.layout
    row = int(np.flatnonzero(layout.constraints.joint == r.joints.index(joint))[0])
    with np.errstate(all="ignore"):
        return np.asarray(system(layout.algebra, layout.constraints, full_pose(r)).on_j[:, row, :2])


def unknown_load_actions(r: Result) -> tuple[Action, ...]:
    """Unknown loads, with the computed values."""
    from dalembert.analysis.compile.load_arrays import point_of

    out = []
    for k, name in enumerate(r.unknown_loads):
        load: Any = r.mechanism.loads[name]
        value, (force, couple) = r.unknown_load(name), unit_load(r, k)
        u = point_of(r.mechanism, load.on, load.at or "center")
        couple = value * couple if couple.ndim == 1 else value[:, None] * couple
        at = link_place(r, load.on, u)
        out.append(Action(name, "load", "", load.on, None, at, value[:, None] * force, couple))
    return tuple(out)


def unit_load(r: Result, k: int) -> tuple[Array, Array]:
    """Force (P, d) and couple (P,) or (P, 3) of one unit of unknown load number k, ground axes."""
    known, g = r.compiled.known, r.compiled.layout.algebra
    force, couple = known.direction[k], known.about[k]
    if known.follows[k]:
        rotation = full_pose(r).rotation[:, known.link[k], :]
        force, couple = g.rotate(rotation, force[None]), g.rotate_couple(rotation, couple[None])
    force, couple = (np.broadcast_to(v, (len(r.status), v.shape[-1])) for v in (force, couple))
    return force, couple if g.d == 3 else couple[:, 0]


def known_actions(r: Result, at: State | None = None) -> tuple[Action, ...]:
    """Everything on the links that is known before the balance: loads, weights, springs, dampers, inertia."""
    s = at or state(r)
    c = r.compiled
    with np.errstate(all="ignore"):
        sources = known_sources(c.layout, c.forcing, s.pose, s.moving, r.inertia)
    m = r.mechanism
    build = _ActionBuilder(r, s.pose)
    build.centers("weight", "weight of {}", sources["weight"])
    build.forces([n for n, load in m.loads_on("point").items() if not load.unknown], sources["force"])
    build.couples([n for n, load in m.loads_on("link").items() if not load.unknown], sources["couple"])
    build.springs(m.loads_on("span"), sources["spring"])
    build.resistances(m.loads_on("turn"), sources["resistance"])
    for kind, word in (("inertia", "inertia"), ("turning", "centrifugal")):
        if kind in sources:
            build.inertia(sources[kind], word)
    return tuple(build.out)


class _ActionBuilder:
    """Turns the core's wrenches about reference points into forces at points with names."""

    def __init__(self, r: Result, pose: Pose) -> None:
        self.r, self.pose, self.out = r, pose, list[Action]()
        self.links = (*r.links, GROUND)
        self.mechanism = r.mechanism

    def add(self, of: str, kind: Kind, source: str, one: WrenchSource, k: int, r: Array, pure: str) -> None:
        """Wrench k of a source at the arm r (P, d) from its link's reference point."""
        g, link, count = self.r.compiled.layout.algebra, int(one.link[k]), len(self.pose.point)
        wrench = np.broadcast_to(one.wrench[..., k, :], (count, g.n))
        force = wrench[:, : g.d] if pure != "couple" else np.zeros((count, g.d))
        couple = wrench[:, g.d :] - g.cross(r, wrench[:, : g.d])
        if pure == "force":
            couple = np.zeros_like(couple)
        couple = couple if g.d == 3 else couple[:, 0]
        at = self.pose.point[:, link, :] + r + self.r.compiled.origin
        self.out.append(Action(of, kind, source, self.links[link], None, at, force, couple))

    def arm(self, link: int, u: Array) -> Array:
        """Ground components (P, d) of an arm (d,) of a link."""
        return arm(self.r.compiled.layout.algebra, self.pose, np.array([link]), u[None])[:, 0, :]

    def center(self, link: int) -> Array:
        return self.arm(link, self.r.compiled.forcing.inertia.center[link])

    def centers(self, kind: Kind, name: str, one: WrenchSource) -> None:
        """Forces at mass centres, those that are not zero."""
        for k, link in enumerate(self.r.links):
            if np.any(one.wrench[..., k, :]):
                self.add(link, kind, name.format(link), one, k, self.center(k), "force")

    def inertia(self, one: WrenchSource, word: str) -> None:
        """D'Alembert's forces and couples of links with mass, or those of the turning plane."""
        f = self.r.compiled.forcing
        spread = f.inertia.inertia if f.turning is None or word == "inertia" else f.turning.moments
        for k, link in enumerate(self.r.links):
            if f.inertia.mass[k]:
                self.add(link, "inertia", f"{word} force of {link}", one, k, self.center(k), "force")
            if spread[k].any():
                self.add(link, "inertia", f"{word} couple of {link}", one, k, self.center(k), "couple")

    def forces(self, names: list[str], one: WrenchSource) -> None:
        forces = self.r.compiled.forcing.forces
        for k, name in enumerate(names):
            self.add(name, "load", name, one, k, self.arm(int(forces.link[k]), forces.at[k]), "force")

    def couples(self, names: list[str], one: WrenchSource) -> None:
        from dalembert.analysis.compile.load_arrays import point_of

        for k, name in enumerate(names):
            link, at = int(one.link[k]), getattr(self.mechanism.loads[name], "at", None)
            middle = self.center(link) if link < len(self.r.links) else 0 * self.pose.point[:, link, :]
            if at:
                reference = self.r.compiled.layout.reference[link]
                middle = self.arm(link, point_of(self.mechanism, self.links[link], at) - reference)
            self.add(name, "load", name, one, k, middle, "couple")

    def springs(self, loads: Tree, one: WrenchSource) -> None:
        springs = self.r.compiled.forcing.springs
        for k, (name, load) in enumerate(loads.items()):
            ends = (
                (k, int(springs.a[k]), springs.at_a[k]),
                (k + len(loads), int(springs.b[k]), springs.at_b[k]),
            )
            for place, link, u in ends:
                self.add(name, load.FORCE, name, one, place, self.arm(link, u), "force")

    def resistances(self, loads: Tree, one: WrenchSource) -> None:
        from dalembert.analysis.compile.load_arrays import joint_damping

        rows: list[tuple[str, Kind, str, str, str]] = [
            (name, load.FORCE, name, load.joint, "turn")
            for name, load in loads.items()  # the order is that of the compiled resistances
        ]
        for joint, described in self.mechanism.joints.items():
            damped = joint_damping(described)
            rows += [(joint, "damper", f"damping of {joint}", joint, freedom) for freedom in damped]
        for k, (of, kind, source, joint, freedom) in enumerate(rows):
            if self.r.friction is not None and of == joint:
                continue  # with friction a reaction has the viscous part in it
            place = joint_place(self.r, joint)
            for end in (k, k + len(rows)):
                link = int(one.link[end])
                r = place - self.pose.point[:, link, :] - self.r.compiled.origin
                self.add(of, kind, source, one, end, r, "couple" if freedom.startswith("turn") else "force")


def magnitude(force: Array) -> Array:
    """Length of vectors (..., d)."""
    if force.shape[-1] == 3:
        return np.asarray(np.sqrt((force * force).sum(axis=-1)))
    return np.asarray(np.hypot(force[..., 0], force[..., 1]))


def polar(force: Array) -> tuple[float, float]:
    """(magnitude, direction in radians) of one vector."""
    return math.hypot(float(force[0]), float(force[1])), math.atan2(float(force[1]), float(force[0]))
