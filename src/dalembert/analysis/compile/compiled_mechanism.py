"""A description as numbers for the core: the only place that knows both."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from itertools import combinations, starmap

import numpy as np

from dalembert.algebra import plane, space
from dalembert.analysis.compile import plane_rows as table
from dalembert.analysis.compile.elements.brake_contacts import with_unknown_clamps
from dalembert.analysis.compile.elements.held_clutches import with_clutches
from dalembert.analysis.compile.elements.rope_parts import with_rope_parts
from dalembert.analysis.compile.elements.turning_plane import turning_frame
from dalembert.analysis.compile.joint_rows import ELEMENTS, PlaneJoints, SpaceJoints
from dalembert.analysis.compile.load_arrays import LoadSetting, forcing, unknown_columns
from dalembert.analysis.compile.pair_table import Geometry
from dalembert.analysis.compile.pushing_contacts import pushing_contacts
from dalembert.analysis.compile.table_ends import Beyond, beyond_ends
from dalembert.arrays import Array, Tree
from dalembert.core.elements.pushing import Pushing
from dalembert.core.equilibrium import Known
from dalembert.core.forcing import Forcing
from dalembert.core.friction.contact_equations import Contacts
from dalembert.core.layout import Layout, Rows
from dalembert.core.position.first_pose_plane import Guess, Modes
from dalembert.core.position.first_pose_space import PoseGuess
from dalembert.errors import ModelError
from dalembert.model import GROUND, Mechanism, Schedule
from dalembert.model.load_types import Directed
from dalembert.model.quantities.coordinates import SPEED, TIME, parts
from dalembert.model.quantities.values import Vector


@dataclass(frozen=True)
class Count:
    """Record of the count of one torsion spring's turns.

    spring: its load; place: among the resistances; near: the reference value of the count, and whether `assembly` gives
    it; at (D,): the drives' positions where it is counted, ``met`` if the motion reaches them, None at the first
    position; margin (P,): radians to the edge of the half turn at those positions.
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
    guess: Guess | PoseGuess
    forcing: Forcing
    known: Known
    contacts: Contacts | None  # of the joints with friction; None without
    geometries: tuple[Geometry, ...] = ()  # of the joints, in space
    pushing: Pushing | None = None  # contacts that hold one way alone
    passive: tuple[str, ...] = ()  # links whose spin moves nothing else, set to none
    pose_names: tuple[str, ...] = ()  # what loads go by that is known once the motion is
    counts: tuple[Count, ...] = ()  # of the whole turns of torsion springs, once the motion is known
    pose_turns: Mapping[str, Array] = field(
        default_factory=dict
    )  # (P,) what the count adds to angles of pose_names
    beyond: tuple[Beyond, ...] = ()  # tables that end before some position

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

    @cached_property
    def first_modes(self) -> Modes | None:
        """Assembly modes at the first position; None where it does not close."""
        return self.guess.modes(self.layout, self.first_target)

    @property
    def origin(self) -> Array:
        """Ground's reference point."""
        return np.asarray(self.layout.reference[-1])

    @cached_property
    def period(self) -> Array | None:
        """Increment of the targets over a full cycle; None if the list of positions is not one."""
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
    m = with_unknown_clamps(with_clutches(with_rope_parts(m), len(schedule.names)))
    joined = _Joined(m, schedule.names, redundant)
    geometry = _geometry(joined) if like is None else _lay_out(joined, like)
    pose_names, standing = _without_pose_loads(m)
    setting = _setting(standing, schedule, geometry)
    unknown = tuple(name for name, load in m.loads.items() if load.unknown)
    return Compiled(
        mechanism=m,
        schedule=schedule,
        unknown_loads=unknown,
        forcing=replace(forcing(setting), turning=turning_frame(setting, schedule)),
        known=unknown_columns(setting, schedule, unknown),
        pose_names=pose_names,
        beyond=beyond_ends(m, setting.drives),
        **geometry,
    )


class _Joined:
    """The links and joints of a mechanism without their loads and masses: the same where nothing of the geometry
    differs, so that what follows from it is kept."""

    def __init__(self, m: Mechanism, drives: tuple[str, ...], redundant: bool) -> None:
        self.m, self.drives, self.redundant = m, drives, redundant
        self.at = {name: m.joint_points(name) for name in m.joints}
        driven = ((name, d.joint, d.freedom, d.axis, d.turns) for name, d in m.drives.items())
        parts = (*m.joints.values(), m.friction, *m.assembly.values())
        self.unplaced = (
            m.dimension,
            redundant,
            drives,
            *driven,
            *m.links,
            *m.joints,
            *m.assembly,
            *map(id, parts),
        )
        self.key = (*self.unplaced, *self.at.values())  # its mechanism keeps the parts alive

    def __hash__(self) -> int:
        return hash(self.key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Joined) and self.key == other.key


class _Unplaced:
    """Layout that does not depend on the joints' points on their links."""

    def __init__(self, joined: _Joined) -> None:
        self.joined = joined

    def __hash__(self) -> int:
        return hash(self.joined.unplaced)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Unplaced) and self.joined.unplaced == other.joined.unplaced


@lru_cache(maxsize=32)
def _geometry(joined: _Joined) -> Tree:
    """Geometries met lately, for all threads."""
    like, geometry = _first_placed(_Unplaced(joined))
    if like.key == joined.key:
        return geometry
    of_points = any(ELEMENTS.get(joint.type) for joint in joined.m.joints.values())
    complete = (
        joined.m.dimension == 3
        or geometry["contacts"]
        or of_points
        or np.isfinite(geometry["guess"].point).any()
    )
    return _lay_out(joined, None) if complete else geometry | {"layout": _moved(joined, geometry)}


@lru_cache(maxsize=32)
def _first_placed(unplaced: _Unplaced) -> tuple[_Joined, Tree]:
    """The geometry of those joints that was met first."""
    return unplaced.joined, _lay_out(unplaced.joined, None)


def _moved(joined: _Joined, geometry: Tree) -> Layout:
    """The layout of the same joints in the plane, without friction, at other points of their links."""
    m, at = joined.m, joined.at
    layout: Layout = geometry["layout"]
    index = _numbers(geometry["links"])
    reference = _references(m, index, at)
    ends = np.array([[index[link] for link in joint.links] for joint in m.joints.values()], np.intp)
    arms = table.numbers(list(at.values())).reshape(-1, 2, 2) - reference[ends.reshape(-1, 2)]

    def moved(rows: Rows) -> Rows:
        families = []
        for f in rows.families:
            ui, uj = arms[rows.joint[f.row[:, 0] if f.row.ndim > 1 else f.row]].swapaxes(0, 1)
            families.append(type(f)(**{**vars(f), "ui": ui, "uj": uj}) if hasattr(f, "ui") else f)
        return replace(rows, families=tuple(families))

    return replace(
        layout,
        constraints=moved(layout.constraints),
        freedoms=moved(layout.freedoms),
        length=characteristic_length(m, at),
        reference=reference,
    )


def _lay_out(joined: _Joined, like: Compiled | None) -> Tree:
    """Data that depend on the joints and their points alone, by their names in ``Compiled``."""
    m, at = joined.m, joined.at
    links = tuple(name for name in m.links if name != GROUND)
    index = _numbers(links)
    reference = _references(m, index, at)
    kind = PlaneJoints if m.dimension == 2 else SpaceJoints
    jointing: PlaneJoints | SpaceJoints = kind(m, joined.drives, index, reference, at)
    fixed, names = jointing.constraints.rows(), jointing.names
    layout = Layout(
        algebra=plane if m.dimension == 2 else space,
        links=len(links),
        joints=len(m.joints),
        constraints=fixed,
        freedoms=jointing.freedoms.rows(),
        driven=np.array([names.index(_driven_freedom(m, d)) for d in joined.drives], np.intp),
        length=characteristic_length(m, at) if like is None else like.layout.length,
        redundant=joined.redundant,
        reference=reference,
        compliance=jointing.compliance(fixed),
    )
    return {
        "links": links,
        "joints": tuple(m.joints),
        "freedoms": tuple(names),
        "layout": layout,
        "target": table.numbers(jointing.constraints.targets),
        "guess": jointing.guess() if like is None else like.guess,
        "contacts": jointing.contacts(fixed),
        "geometries": jointing.geometries,
        "pushing": pushing_contacts(m, fixed) if m.dimension == 2 else None,
        "passive": jointing.passive,
    }


def _numbers(links: tuple[str, ...]) -> dict[str, int]:
    """Links by name, ground the last."""
    return {name: k for k, name in enumerate((*links, GROUND))}


def setting_of(c: Compiled) -> LoadSetting:
    """Setting in which the loads of a compiled mechanism were compiled."""
    return _setting(c.mechanism, c.schedule, vars(c))


def _setting(m: Mechanism, schedule: Schedule, geometry: Tree) -> LoadSetting:
    layout, count = geometry["layout"], len(schedule.position)
    index, drives = _numbers(geometry["links"]), _drives(schedule)
    return LoadSetting(m, layout.algebra, index, layout.reference, geometry["freedoms"], drives, count)


def _drives(schedule: Schedule) -> dict[str, Array]:
    """Quantities on which changing quantities may depend: time, where it is known; the drives' positions and speeds."""
    time = schedule.clock
    values = {name: schedule.position[:, k] for k, name in enumerate(schedule.names)}
    values |= {f"{name}{SPEED}": schedule.speed[:, k] for k, name in enumerate(schedule.names)}
    return values if time is None else {TIME: time} | values


def _without_pose_loads(m: Mechanism) -> tuple[tuple[str, ...], Mechanism]:
    """Variables of loads that only the pose gives, and the mechanism with 1 instead of their values."""
    names: dict[str, None] = {}
    loads = {}
    for name, load in m.loads.items():
        if not isinstance(load, Directed):
            continue
        used = [n for value in load.varying for n in getattr(value, "names", ()) if parts(n)]
        if used:
            one = tuple(1.0 for _ in load.value) if isinstance(load.value, tuple) else 1.0
            names |= dict.fromkeys(used)
            loads[name] = load.model_copy(update={"value": one})
    return tuple(sorted(names)), m.model_copy(update={"loads": {**m.loads, **loads}}) if loads else m


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
    """Mean over the links of the largest distance between two points of joints, and over the cams of a radius; or else
    of any points; 1 m if all links are points."""
    spans = [span for span in link_spans(m, at).values() if span > 0]
    spans += [j.profile.size for j in m.joints.values() if j.outlined]  # type: ignore[union-attr]
    if not spans:
        every = [_span(list(m.points(link).values())) for link in m.links]
        spans = [span for span in every if span > 0]
    try:
        return math.fsum(spans) / len(spans) if spans else 1.0
    except OverflowError:  # the sum has no number, the mean has one; a position of such lengths is refused
        return math.fsum(x / len(spans) for x in spans)


def link_spans(m: Mechanism, at: Places) -> dict[str, float]:
    """Largest distance between two points of joints, by link."""
    ends: dict[str, list[Vector]] = {}
    for name, joint in m.joints.items():
        for link, u in zip(joint.links, at[name], strict=True):
            ends.setdefault(link, []).append(tuple(u))
    return {link: _span(points) for link, points in ends.items()}


def _span(points: list[Vector]) -> float:
    """Largest distance of two points: not their extents, so that it is the same in whatever axes."""
    return max(starmap(math.dist, combinations(points, 2)), default=0.0)


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
