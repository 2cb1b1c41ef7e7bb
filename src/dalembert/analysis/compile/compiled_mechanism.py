"""A description as numbers for the core: the only place that knows both."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, starmap

import numpy as np

from dalembert.algebra import plane, space
from dalembert.analysis.compile import plane_rows as table
from dalembert.analysis.compile.joint_rows import Jointing, PlaneJoints, SpaceJoints
from dalembert.analysis.compile.load_arrays import Setting, forcing, unknown_columns
from dalembert.analysis.compile.pair_table import Geometry
from dalembert.arrays import Array
from dalembert.core.equilibrium import Known
from dalembert.core.forcing import Forcing
from dalembert.core.friction.contact_equations import Contacts
from dalembert.core.layout import Layout
from dalembert.core.position.first_pose_plane import Guess
from dalembert.core.position.first_pose_space import Drawing
from dalembert.errors import ModelError
from dalembert.model import GROUND, Mechanism, Schedule
from dalembert.model.load_types import Directed
from dalembert.model.quantities.coordinates import TIME
from dalembert.model.quantities.values import Vector


@dataclass(frozen=True)
class Count:
    """How the turn of one torsion spring is counted.

    spring: its load; place: among the resistances; near: what its angle is counted by, and whether `assembly`
    states it; at (D,): the drives' positions where it is counted, ``met`` if the motion reaches them, None at the
    first position; margin (P,): radians to the edge of the half turn, there.
    """

    spring: str
    place: int
    near: float
    stated: bool
    at: Array | None
    met: bool
    margin: Array


@dataclass(frozen=True)
class Compiled:
    """Names in the order of the arrays, the layout, and the numbers.

    target (K,) constants of the constraints; positions (P, D) of the drives come from the schedule. ``origin`` is the
    ground point that the core calls (0, 0), so that a machine far from the origin loses no digits.
    """

    mechanism: Mechanism
    schedule: Schedule
    links: tuple[str, ...]
    joints: tuple[str, ...]
    freedoms: tuple[tuple[str, str], ...]  # (joint, freedom) of each freedom row
    unknown_loads: tuple[str, ...]
    layout: Layout
    target: Array
    guess: Guess | Drawing
    forcing: Forcing
    known: Known
    contacts: Contacts | None  # of the joints with friction; None without
    geometries: tuple[Geometry, ...] = ()  # of the joints, in space
    passive: tuple[str, ...] = ()  # links whose spin moves nothing else, set to none
    pose_names: tuple[str, ...] = ()  # what loads go by that is known once the motion is
    counts: tuple[Count, ...] = ()  # of the whole turns of torsion springs, once the motion is known

    @cached_property
    def targets(self) -> Array:
        """Stacked targets (P, K + D)."""
        positions = self.schedule.position
        return np.concatenate(
            [np.broadcast_to(self.target, (len(positions), len(self.target))), positions], axis=1
        )

    @property
    def first_target(self) -> Array:
        """Stacked targets (K + D,) of the first position."""
        return np.concatenate([self.target, self.schedule.position[0]])

    @property
    def origin(self) -> Array:
        """Ground's reference point."""
        return np.asarray(self.layout.reference[-1])

    @cached_property
    def period(self) -> Array | None:
        """What a whole cycle adds to the targets; None if the list of positions is not one."""
        turns = _whole_turns(self.schedule.position, self.layout)
        return None if turns is None else np.concatenate([np.zeros(len(self.target)), turns])


def _whole_turns(positions: Array, layout: Layout) -> Array | None:
    if len(positions) < 3:
        return None
    closing = positions[-1] + (positions[-1] - positions[-2]) - positions[0]
    angular = layout.freedoms.angular[layout.driven]
    turns = np.where(angular, np.abs(np.abs(closing) - 2 * np.pi) < 1e-6, False)
    if not turns.any() or np.any(~turns & (np.abs(closing) > 1e-9)):
        return None
    return np.where(turns, np.sign(closing) * 2 * np.pi, 0.0)


def compile_mechanism(
    m: Mechanism, schedule: Schedule, redundant: bool = False, like: Compiled | None = None
) -> Compiled:
    """The mechanism at the positions of a schedule.

    Its numbers may be symbols (one position then): scale and first guess are taken from ``like``, the mechanism with
    numbers in their places.
    """
    g = plane if m.dimension == 2 else space
    links = tuple(name for name in m.links if name != GROUND)
    index = {name: k for k, name in enumerate(links)} | {GROUND: len(links)}
    at = {name: m.joint_points(name) for name in m.joints}
    reference = _references(m, index, at)
    jointing: Jointing = (PlaneJoints if m.dimension == 2 else SpaceJoints)(m, schedule, index, reference, at)
    fixed, freedoms = jointing.constraints.rows(), jointing.freedoms.rows()
    names = jointing.names
    driven = np.array([names.index(_driven_freedom(m, d)) for d in schedule.names], np.intp)
    layout = Layout(
        algebra=g,
        links=len(links),
        joints=len(m.joints),
        constraints=fixed,
        freedoms=freedoms,
        driven=driven,
        length=characteristic_length(m, at) if like is None else like.layout.length,
        redundant=redundant,
        reference=reference,
        compliance=jointing.compliance(fixed),
    )
    unknown = tuple(name for name, load in m.loads.items() if load.unknown)
    pose_names, standing = _without_pose_loads(m)
    setting = Setting(standing, g, index, reference, names, _drives(schedule), len(schedule.position))
    return Compiled(
        mechanism=m,
        schedule=schedule,
        links=links,
        joints=tuple(m.joints),
        freedoms=tuple(names),
        unknown_loads=unknown,
        layout=layout,
        target=table.numbers(jointing.constraints.targets),
        guess=jointing.guess() if like is None else like.guess,
        forcing=forcing(setting),
        known=unknown_columns(setting, schedule, unknown),
        contacts=jointing.contacts(fixed),
        geometries=jointing.geometries,
        passive=jointing.passive,
        pose_names=pose_names,
    )


def setting_of(c: Compiled) -> Setting:
    """What the loads of a compiled mechanism were compiled in."""
    index = {name: k for k, name in enumerate(c.links)} | {GROUND: len(c.links)}
    count = len(c.schedule.position)
    drives = _drives(c.schedule)
    return Setting(c.mechanism, c.layout.algebra, index, c.layout.reference, list(c.freedoms), drives, count)


def _drives(schedule: Schedule) -> dict[str, Array]:
    """What changing quantities may go by: time, where a law says it, and the drives' positions."""
    time = {} if schedule.time is None else {TIME: schedule.time}
    return time | {name: schedule.position[:, k] for k, name in enumerate(schedule.names)}


def _without_pose_loads(m: Mechanism) -> tuple[tuple[str, ...], Mechanism]:
    """What loads go by that only the pose says, and the mechanism with 1 in place of their values."""
    found: dict[str, None] = {}
    loads = {}
    for name, load in m.loads.items():
        if not isinstance(load, Directed):
            continue
        used = [n for value in load.varying for n in getattr(value, "names", ()) if "." in n]
        if used:
            one = tuple(1.0 for _ in load.value) if isinstance(load.value, tuple) else 1.0
            found |= dict.fromkeys(used)
            loads[name] = load.model_copy(update={"value": one})
    return tuple(sorted(found)), m.model_copy(update={"loads": {**m.loads, **loads}}) if loads else m


Places = dict[str, tuple[Vector, Vector]]
"""Points of each joint on both its links, in their axes."""


def _references(m: Mechanism, index: dict[str, int], at: Places) -> Array:
    """Reference point of each link: its point of the first joint, one with the ground before others, so that arms stay
    short and many, and many velocities, are zero."""
    reference: dict[int, Vector] = {}
    for name, joint in sorted(m.joints.items(), key=lambda item: GROUND not in item[1].links):
        for link, u in zip(joint.links, at[name], strict=True):
            reference.setdefault(index[link], u)
    return table.numbers([reference.get(k, (0.0,) * m.dimension) for k in range(len(index))])


def characteristic_length(m: Mechanism, at: Places) -> float:
    """Mean over the links of the largest distance between two points of joints; 1 m if all links are points."""
    spans = []
    ends: dict[str, list[tuple[float, ...]]] = {}
    for name, joint in m.joints.items():
        for link, u in zip(joint.links, at[name], strict=True):
            ends.setdefault(link, []).append(tuple(u))
    for points in ends.values():  # distances, not extents: the same in whatever axes
        spans.append(max(starmap(math.dist, combinations(points, 2)), default=0.0))
    spans = [s for s in spans if s > 0]
    return math.fsum(spans) / len(spans) if spans else 1.0


def _driven_freedom(m: Mechanism, drive: str) -> tuple[str, str]:
    """(joint, freedom) that a drive prescribes."""
    d = m.drives[drive]
    joint = d.joint or drive
    freedoms = m.joints[joint].freedoms
    freedom = d.freedom or (freedoms[0] if len(freedoms) == 1 else None)
    if freedom not in freedoms:
        has = " and ".join(freedoms) or "no freedom"
        remedy = (
            f"name one of them with `freedom`: {', '.join(freedoms)}" if freedoms else "drive another joint"
        )
        raise ModelError(
            f"drive {drive!r}: joint {joint!r} ({m.joints[joint].type}) has {has}", remedy, ("drives", drive)
        )
    return joint, str(freedom)
