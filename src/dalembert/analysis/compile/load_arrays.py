"""Loads, masses and given efforts of a description as numbers for the core."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cache, lru_cache
from typing import Any, Literal

import numpy as np

from dalembert.algebra.protocol import Algebra
from dalembert.analysis.compile.elements.belt_arrays import belt_pulls
from dalembert.analysis.compile.elements.rope_parts import rope_grips
from dalembert.analysis.compile.plane_rows import numbers
from dalembert.arrays import Array, Numeric, Tree
from dalembert.core.equilibrium import Known
from dalembert.core.forcing import Couples, Forcing, Inertia, PointForces, Resistances, Springs
from dalembert.errors import ModelError
from dalembert.model import Mechanism, Schedule
from dalembert.model.drives.turning_checks import freed_drive
from dalembert.model.joints.plane_joints import Joint
from dalembert.model.load_types import Couple
from dalembert.model.quantities.values import Vector


@dataclass(frozen=True)
class LoadSetting:
    """Data needed to compile loads: numbers and reference points of the links, freedoms by name, drives' positions."""

    m: Mechanism
    g: Algebra
    index: dict[str, int]
    reference: Array
    freedoms: Sequence[tuple[str, str]]
    drives: dict[str, Array]
    count: int


def point_of(m: Mechanism, link: str, at: str | Vector, path: tuple[str | int, ...] = ()) -> Array:
    """A point of a link in its axes: by name, `center`, or as a vector."""
    if not isinstance(at, str):
        return numbers(at)
    points = m.links[link].points
    if at in points:
        return np.array(m.links[link].point(at))
    if at == "center":
        return np.array(m.center(link))
    raise ModelError(f"link {link!r} has no point {at!r}", f"it has {', '.join(points) or 'none'}", path)


def load_forces(s: LoadSetting) -> tuple[PointForces, Couples]:
    """The loads that are forces and couples."""
    return _forces(s, _known_on(s.m, "point")), _couples(s, _known_on(s.m, "link"))


def forcing(s: LoadSetting) -> Forcing:
    """Everything that loads the links, but for the drives' efforts."""
    m, g = s.m, s.g
    forces, couples = load_forces(s)
    links = [name for name in m.links if name != "ground"]
    centers = numbers([m.center(k) for k in links]).reshape(-1, g.d)
    return Forcing(
        inertia=Inertia(
            mass=numbers([m.mass(k) for k in links]),
            center=centers - s.reference[: len(links)],
            inertia=numbers([_inertia(m, k) for k in links]).reshape(len(links), -1),
            gravity=np.array(m.gravity_vector),
        ),
        forces=forces,
        couples=couples,
        springs=_springs(s),
        resistances=_resistances(s),
        separation=numbers(_mesh_tangents(m)),
        belts=belt_pulls(m),
        ropes=rope_grips(m),
    )


def _known_on(m: Mechanism, what: Literal["point", "link"]) -> Tree:
    return {name: load for name, load in m.loads_on(what).items() if not load.unknown}


def _inertia(m: Mechanism, link: str) -> Numeric:
    """One number in the plane; in space the matrix row by row."""
    inertia = m.inertia(link)
    if m.dimension == 2:
        return inertia
    if isinstance(inertia, tuple):
        return np.ravel(inertia if isinstance(inertia[0], tuple) else np.diag(inertia))
    return (inertia * np.eye(3)).ravel()


def _mesh_tangents(m: Mechanism) -> list[float]:
    """tan(pressure angle) of each mesh row, 0 for a wheel that rolls on a circle; in the order of the rows."""
    out = []
    for joint in m.joints.values():
        if joint.wheels == 2 and not joint.WRAPPED:
            out.append(np.tan(getattr(joint, "pressure_angle", 0.0)))
    return out


def _forces(s: LoadSetting, loads: Tree) -> PointForces:
    link, at, value = [], [], []
    for name, load in loads.items():
        link.append(s.index[load.on])
        at.append(point_of(s.m, load.on, load.at, ("loads", name, "at")) - s.reference[s.index[load.on]])
        constant = all(isinstance(part, float) for part in getattr(load, "varying", (None,)))
        value += load.force({} if constant else s.drives)
    follows = np.array([load.axes == "link" for load in loads.values()], bool)
    values = _along(value, s.count).reshape(s.count, len(loads), s.g.d)
    return PointForces(np.array(link, np.intp), numbers(at).reshape(-1, s.g.d), follows, values)


def _along(values: list[Numeric], count: int) -> Array:
    """Numbers, and columns (P,) of those that change, as an array (P, N), to be read only."""
    if not any(isinstance(value, np.ndarray) for value in values):
        return np.broadcast_to(numbers(values), (count, len(values)))
    return numbers([np.broadcast_to(value, (count,)) for value in values]).T


def _couples(s: LoadSetting, loads: Tree) -> Couples:
    size = s.g.n - s.g.d
    value = []
    for load in loads.values():
        for part in load.components or (load.value,):
            number = part.at(s.drives) if hasattr(part, "at") else part
            value += [number] if load.components else [number * factor for factor in load.axis]
    values = _along(value, s.count).reshape(s.count, len(loads), size)
    follows = np.array([load.axes == "link" for load in loads.values()], bool)
    link = np.array([s.index[load.on] for load in loads.values()], np.intp)
    return Couples(link, values, follows)


def _springs(s: LoadSetting) -> Springs:
    """Loads along a span: each number of ``Springs`` is the key of that name, 0 of a load without it."""
    loads = s.m.loads_on("span")
    if not loads:
        return _no_springs(s.g.d)
    ends = [[(s.index[link], u) for link, u in s.m.load_points(name)] for name in loads]
    links = [np.array([end[side][0] for end in ends], np.intp) for side in (0, 1)]
    arms = [numbers([end[side][1] - s.reference[end[side][0]] for end in ends]) for side in (0, 1)]
    values: Tree = {key: numbers([getattr(load, key, 0.0) for load in loads.values()]) for key in SPRING_KEYS}
    at_a, at_b = (arm.reshape(-1, s.g.d) for arm in arms)
    return Springs(a=links[0], b=links[1], at_a=at_a, at_b=at_b, **values, **_tables(loads))


SPRING_KEYS = [field.name for field in fields(Springs)[4:-3]]
"""Numbers of springs and dampers that are keys of loads."""


def _tables(loads: Tree) -> Tree:
    """Tension before the first bend, bends and slopes of the tables of springs and dampers."""
    laws = [[getattr(load, name, None) for load in loads.values()] for name in ("law", "rate_law")]
    most = max((len(law.bends) for some in laws for law in some if law is not None), default=0)
    start, table = np.zeros((2, len(loads))), np.zeros((2, 2, most, len(loads)))
    for which, some in enumerate(laws):
        for k, law in enumerate(some):
            if law is not None:
                start[which, k] = law.y[0]
                table[:, which, : len(law.bends), k] = np.array(law.bends).T
    return {"start": start, "bends": table[0], "slopes": table[1]}


@cache
def _no_springs(d: int) -> Springs:
    none: Tree = dict.fromkeys(SPRING_KEYS, np.zeros(0))
    end, arm = np.zeros(0, np.intp), np.zeros((0, d))
    return Springs(a=end, b=end, at_a=arm, at_b=arm, **none, **_tables({}))


def _resistances(s: LoadSetting) -> Resistances:
    """Torsion springs, torsion dampers and the joints' damping, each in its freedom."""
    rows: list[tuple[int, float, float, float]] = []
    for load in s.m.loads_on("turn").values():
        turn = s.m.joints[load.joint].turn_of(load.freedom)
        stiffness, free, damping = (getattr(load, key, 0.0) for key in ("stiffness", "free_angle", "damping"))
        rows.append((s.freedoms.index((load.joint, str(turn))), stiffness, free, damping))
    return _in_freedoms([*rows, *_damper_rows(s.m, s.freedoms)])


def joint_resistances(m: Mechanism, freedoms: Sequence[tuple[str, str]]) -> Resistances:
    """The joints' damping."""
    return _in_freedoms(_damper_rows(m, freedoms))


def _damper_rows(m: Mechanism, freedoms: Sequence[tuple[str, str]]) -> list[tuple[int, float, float, float]]:
    """Row, no spring, and coefficient of each freedom that its joint damps."""
    return [
        (freedoms.index((name, freedom)), 0.0, 0.0, damping)
        for name, joint in m.joints.items()
        for freedom, damping in joint_damping(joint).items()
    ]


def _in_freedoms(rows: list[tuple[int, float, float, float]]) -> Resistances:
    if not rows:
        return NO_RESISTANCES
    columns = list(zip(*rows, strict=True))
    stiffness, free, damping = (numbers(c) for c in columns[1:])
    return Resistances(np.array(columns[0], np.intp), stiffness, free, damping, turns=np.zeros(len(rows)))


NO_RESISTANCES = Resistances(np.zeros(0, np.intp), *(np.zeros(0),) * 4)


def joint_damping(joint: Joint) -> dict[str, float]:
    """Viscous coefficient of each damped freedom of a joint."""
    damping = getattr(joint, "damping", None)
    if not damping:
        return {}
    if isinstance(damping, dict):
        return {k: v for k, v in damping.items() if v}
    if not isinstance(damping, tuple):
        return {joint.freedoms[0]: damping}
    return {k: v for k, v in zip(joint.freedoms, damping, strict=not joint.gaps) if v}


def _effort(s: LoadSetting, name: str, schedule: Schedule) -> Array:
    """Given effort of a drive at each position, NaN where it is unknown."""
    if _requested(s.m, name) or schedule.unknown is not None:
        return np.full(s.count, np.nan)
    return given_effort(s, name)


def given_effort(s: LoadSetting, name: str) -> Array:
    """Effort of a drive as the description gives it (P,), 0 where it does not."""
    effort = s.m.drives[name].effort or 0.0
    return np.broadcast_to(effort.at(s.drives) if hasattr(effort, "at") else effort, (s.count,))


def _requested(m: Mechanism, name: str) -> bool:
    """True if the effort of a drive is unknown, or is met by the speed of a turning frame."""
    return m.drives[name].effort is None or name == freed_drive(m)


def unknown_columns(s: LoadSetting, schedule: Schedule, unknown: tuple[str, ...]) -> Known:
    """Given efforts and unknown loads."""
    g = s.g
    if not unknown and all(_requested(s.m, n) for n in schedule.names):
        return _requested_efforts(len(schedule.names), s.count, g.d, g.n)
    effort = [_effort(s, name, schedule) for name in schedule.names]
    requested = np.array([_requested(s.m, n) or schedule.unknown is not None for n in schedule.names], bool)
    loads: list[Any] = [s.m.loads[name] for name in unknown]
    at = [
        point_of(s.m, load.on, load.at, ("loads", name, "at")) - s.reference[s.index[load.on]]
        if load.ON == "point"
        else np.zeros(g.d)
        for name, load in zip(unknown, loads, strict=True)
    ]
    direction = [load.force({}) if load.ON == "point" else (0.0,) * g.d for load in loads]
    about = [_about(load) if load.ON == "link" else (0.0,) * (g.n - g.d) for load in loads]
    return Known(
        requested=requested,
        effort=numbers(effort).reshape(len(effort), s.count).T,
        link=np.array([s.index[load.on] for load in loads], np.intp),
        at=numbers(at).reshape(-1, g.d),
        direction=numbers(direction).reshape(-1, g.d),
        about=numbers(about).reshape(-1, g.n - g.d),
        follows=np.array([load.axes == "link" for load in loads], bool),
        couple=np.array([load.ON == "link" for load in loads], bool),
    )


@lru_cache(maxsize=32)
def _requested_efforts(drives: int, count: int, d: int, n: int) -> Known:
    """All efforts asked for, and no loads."""
    none, never = np.zeros((0, d)), np.zeros(0, bool)
    effort = np.broadcast_to(np.nan, (count, drives))
    return Known(
        np.ones(drives, bool), effort, np.zeros(0, np.intp), none, none, np.zeros((0, n - d)), never, never
    )


def _about(load: Couple) -> Vector:
    """A unit of an unknown couple: counter-clockwise, in space about its direction."""
    return tuple(load.axis)
