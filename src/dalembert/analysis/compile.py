"""A description as numbers for the core: the only place that knows both."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dalembert.algebra import plane
from dalembert.analysis import joints as table
from dalembert.analysis.contacts import contacts
from dalembert.core.assembly import Guess
from dalembert.core.equilibrium import Known
from dalembert.core.forcing import Couples, Forces, Forcing, Inertia, Resistances, Springs
from dalembert.core.friction import Contacts
from dalembert.core.layout import Layout
from dalembert.errors import ModelError
from dalembert.model import Mechanism, Schedule

Array = NDArray[Any]
GROUND = "ground"


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
    guess: Guess
    forcing: Forcing
    known: Known
    joint_at: Array  # (joints, d) arm of j's point
    damping: Resistances  # of the joints themselves, which the forcing has too
    contacts: Contacts | None  # of the joints with friction; None without
    contact_kinds: tuple[str, ...]

    @cached_property
    def targets(self) -> Array:
        """Stacked targets (P, K + D)."""
        positions = self.schedule.position
        return np.concatenate(
            [np.broadcast_to(self.target, (len(positions), len(self.target))), positions], axis=1
        )

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


def compiled(
    m: Mechanism, schedule: Schedule, redundant: bool = False, like: Compiled | None = None
) -> Compiled:
    """The mechanism at the positions of a schedule.

    Its numbers may be symbols (one position then): scale and first guess are taken from ``like``, the mechanism with
    numbers in their places.
    """
    _refuse_unready(m)
    links = tuple(name for name in m.links if name != GROUND)
    index = {name: k for k, name in enumerate(links)} | {GROUND: len(links)}
    joints = tuple(m.joints)
    reference = _references(m, index)
    constraints, freedoms = table.RowBuilder(len(links)), table.RowBuilder(len(links))
    names: list[tuple[str, str]] = []
    pairs: list[tuple[int, int]] = []
    arms: list[tuple[Array, Array]] = []
    for k, name in enumerate(joints):
        joint = m.joints[name]
        ends = (index[joint.links[0]], index[joint.links[1]])
        ui, uj = (np.subtract(u, reference[e]) for u, e in zip(m.joint_points(name), ends, strict=True))
        table.add_constraints(constraints, k, joint, ends, ui, uj)
        table.add_freedom(freedoms, k, joint, ends, ui, uj)
        names += [(name, freedom) for freedom in table.FREEDOMS[joint.type]]
        pairs.append(ends)
        arms.append((ui, uj))
    driven = np.array([names.index(_driven_freedom(m, d)) for d in schedule.names], np.intp)
    fixed = constraints.rows()
    touching, kinds = contacts(m, fixed, pairs, arms) or (None, ())
    layout = Layout(
        algebra=plane,
        links=len(links),
        joints=len(joints),
        constraints=fixed,
        freedoms=freedoms.rows(),
        driven=driven,
        length=characteristic_length(m) if like is None else like.layout.length,
        redundant=redundant,
        reference=reference,
    )
    drives = {name: schedule.position[:, k] for k, name in enumerate(schedule.names)}
    unknown = tuple(name for name, load in m.loads.items() if getattr(load, "unknown", False))
    return Compiled(
        mechanism=m,
        schedule=schedule,
        links=links,
        joints=joints,
        freedoms=tuple(names),
        unknown_loads=unknown,
        layout=layout,
        target=table.numbers(constraints.targets),
        guess=_guess(m, index, reference) if like is None else like.guess,
        forcing=_forcing(m, index, reference, names, drives, len(schedule.position)),
        known=_known(m, schedule, index, reference, unknown, drives),
        joint_at=table.numbers([uj for _, uj in arms]).reshape(-1, 2),
        damping=_in_freedoms(_damped(m, names)),
        contacts=touching,
        contact_kinds=kinds,
    )


def _refuse_unready(m: Mechanism) -> None:
    """What later issues bring is refused, never left out silently."""
    if m.space != "plane":
        raise ModelError(
            "mechanisms in space cannot be analysed yet", "describe the plane mechanism", ("space",)
        )
    for name, joint in m.joints.items():
        if joint.type not in table.FREEDOMS:
            what = f"joint {name!r}: joints of type {joint.type!r} cannot be analysed yet"
            raise ModelError(what, "use " + ", ".join(table.FREEDOMS), ("joints", name, "type"))


def _references(m: Mechanism, index: dict[str, int]) -> Array:
    """Reference point of each link: its point of the first joint, one with the ground before others, so that arms stay
    short and many, and many velocities, are zero."""
    reference: dict[int, Any] = {}
    for name, joint in sorted(m.joints.items(), key=lambda item: GROUND not in item[1].links):
        for link, u in zip(joint.links, m.joint_points(name), strict=True):
            reference.setdefault(index[link], u)
    return table.numbers([reference.get(k, (0.0, 0.0)) for k in range(len(index))])


def characteristic_length(m: Mechanism) -> float:
    """Mean over the links of the largest distance between two points of joints; 1 m if all links are points."""
    spans = []
    at: dict[str, list[tuple[float, ...]]] = {}
    for name, joint in m.joints.items():
        for link, u in zip(joint.links, m.joint_points(name), strict=True):
            at.setdefault(link, []).append(tuple(u))
    for points in at.values():
        p = np.array(points)
        spans.append(float(np.hypot(*(p.max(axis=0) - p.min(axis=0)))))
    spans = [s for s in spans if s > 0]
    return float(np.mean(spans)) if spans else 1.0


def _driven_freedom(m: Mechanism, drive: str) -> tuple[str, str]:
    """(joint, freedom) that a drive prescribes."""
    d = m.drives[drive]
    joint = d.joint or drive
    freedoms = table.FREEDOMS[m.joints[joint].type]
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


def _guess(m: Mechanism, index: dict[str, int], reference: Array) -> Guess:
    turn, point = np.full(len(index), np.nan), np.full((len(index), 2), np.nan)
    for link, given in m.assembly.items():
        k = index[link]
        if isinstance(given, float):
            turn[k] = given
            continue
        if not isinstance(given, tuple):
            raise ModelError(
                "a pose in space means nothing in the plane", "give an angle", ("assembly", link)
            )
        x, y, angle = given
        turn[k] = angle
        arm = plane.rotate(plane.rotation(np.array(angle)), reference[k])
        point[k] = np.array([x, y]) + arm - reference[-1]
    return Guess(turn, point)


def _forcing(
    m: Mechanism,
    index: dict[str, int],
    reference: Array,
    freedoms: list[tuple[str, str]],
    drives: dict[str, Array],
    count: int,
) -> Forcing:
    links = [name for name in index if name != GROUND]
    known = {k: v for k, v in m.loads.items() if not getattr(v, "unknown", False)}
    return Forcing(
        inertia=Inertia(
            mass=table.numbers([m.mass(k) for k in links]),
            center=table.numbers([np.subtract(m.center(k), reference[index[k]]) for k in links]).reshape(
                -1, 2
            ),
            inertia=table.numbers([m.inertia(k) for k in links])[:, None],
            gravity=np.array(m.gravity_vector),
        ),
        forces=_forces(
            m, {k: v for k, v in known.items() if v.type == "force"}, index, reference, drives, count
        ),
        couples=_couples({k: v for k, v in known.items() if v.type == "couple"}, index, drives, count),
        springs=_springs(m, known, index, reference),
        resistances=_resistances(m, known, freedoms),
        separation=table.numbers(_mesh_tangents(m)),
    )


def _mesh_tangents(m: Mechanism) -> list[Any]:
    """tan(pressure angle) of each mesh row, 0 for a wheel that rolls on a circle; in the order of the rows."""
    out = []
    for joint in m.joints.values():
        if joint.type == "gear":
            out.append(np.tan(joint.pressure_angle))
        elif joint.type == "rolling" and getattr(joint, "radii", None) is not None:
            out.append(0.0)
    return out


def point_of(m: Mechanism, link: str, at: Any, path: tuple[str | int, ...] = ()) -> Array:
    """A point of a link in its axes: by name, `center`, or as a vector."""
    if not isinstance(at, str):
        return table.numbers(at)
    points = m.points(link)
    if at in points:
        return np.array(points[at])
    if at == "center":
        return np.array(m.center(link))
    raise ModelError(f"link {link!r} has no point {at!r}", f"it has {', '.join(points) or 'none'}", path)


def _forces(
    m: Mechanism,
    loads: dict[str, Any],
    index: dict[str, int],
    reference: Array,
    drives: dict[str, Array],
    count: int,
) -> Forces:
    link, at, value = [], [], []
    for name, load in loads.items():
        link.append(index[load.on])
        at.append(point_of(m, load.on, load.at, ("loads", name, "at")) - reference[index[load.on]])
        value += [np.broadcast_to(f, (count,)) for f in load.force(drives)]
    follows = np.array([load.axes == "link" for load in loads.values()], bool)
    values = table.numbers(value).reshape(len(loads), 2, count)
    return Forces(
        np.array(link, np.intp), table.numbers(at).reshape(-1, 2), follows, np.moveaxis(values, -1, 0)
    )


def _couples(loads: dict[str, Any], index: dict[str, int], drives: dict[str, Array], count: int) -> Couples:
    value = [load.value.at(drives) if hasattr(load.value, "at") else load.value for load in loads.values()]
    columns = table.numbers([np.broadcast_to(v, (count,)) for v in value]).reshape(len(loads), count)
    return Couples(np.array([index[load.on] for load in loads.values()], np.intp), columns.T[..., None])


def _springs(m: Mechanism, loads: dict[str, Any], index: dict[str, int], reference: Array) -> Springs:
    rows: list[tuple[Any, ...]] = []
    for name, load in loads.items():
        if load.type in ("spring", "damper"):
            (a, ua), (b, ub) = m.load_points(name)
            ka, kb = index[a], index[b]
            stiffness = getattr(load, "stiffness", 0.0)
            free, damping = getattr(load, "free_length", 0.0), getattr(load, "damping", 0.0)
            rows.append((ka, kb, ua - reference[ka], ub - reference[kb], stiffness, free, damping or 0.0))
    columns = list(zip(*rows, strict=True)) if rows else [()] * 7
    return Springs(
        np.array(columns[0], np.intp),
        np.array(columns[1], np.intp),
        table.numbers(columns[2]).reshape(-1, 2),
        table.numbers(columns[3]).reshape(-1, 2),
        *(table.numbers(column) for column in columns[4:]),
    )


def _resistances(m: Mechanism, loads: dict[str, Any], freedoms: list[tuple[str, str]]) -> Resistances:
    """Torsion springs, torsion dampers and the joints' own damping, each in its freedom."""
    rows: list[tuple[int, float, float, float]] = []
    for name, load in loads.items():
        if load.type in ("torsion_spring", "torsion_damper"):
            if (load.joint, "turn") not in freedoms:
                what = f"load {name!r}: joint {load.joint!r} does not turn"
                raise ModelError(what, "name a pin or slot", ("loads", name, "joint"))
            stiffness, free = getattr(load, "stiffness", 0.0), getattr(load, "free_angle", 0.0)
            rows.append(
                (freedoms.index((load.joint, "turn")), stiffness, free, getattr(load, "damping", 0.0) or 0.0)
            )
    return _in_freedoms([*rows, *_damped(m, freedoms)])


def _damped(m: Mechanism, freedoms: list[tuple[str, str]]) -> list[tuple[int, float, float, float]]:
    """Row, no spring, and coefficient of each freedom that its joint damps."""
    return [
        (freedoms.index((name, freedom)), 0.0, 0.0, damping)
        for name, joint in m.joints.items()
        for freedom, damping in joint_damping(joint).items()
    ]


def _in_freedoms(rows: list[tuple[int, float, float, float]]) -> Resistances:
    columns = list(zip(*rows, strict=True)) if rows else [()] * 4
    return Resistances(np.array(columns[0], np.intp), *(table.numbers(c) for c in columns[1:]))


def joint_damping(joint: Any) -> dict[str, float]:
    """Viscous coefficient of each damped freedom of a joint."""
    damping = getattr(joint, "damping", None)
    if not damping:
        return {}
    if not isinstance(damping, tuple):
        return {table.FREEDOMS[joint.type][0]: damping}
    return {k: v for k, v in zip(table.FREEDOMS[joint.type], damping, strict=True) if v}


def _effort(m: Mechanism, name: str, schedule: Schedule, drives: dict[str, Array], count: int) -> Array:
    """Given effort of a drive at each position, NaN where it is asked for."""
    given = m.drives[name].effort
    if given is None or schedule.unknown is not None:
        return np.full(count, np.nan)
    return np.broadcast_to(given.at(drives) if hasattr(given, "at") else given, (count,))


def _known(
    m: Mechanism,
    schedule: Schedule,
    index: dict[str, int],
    reference: Array,
    unknown: tuple[str, ...],
    drives: dict[str, Array],
) -> Known:
    count = len(schedule.position)
    effort = [_effort(m, name, schedule, drives, count) for name in schedule.names]
    asked = np.array(
        [m.drives[n].effort is None or schedule.unknown is not None for n in schedule.names], bool
    )
    loads: list[Any] = [m.loads[name] for name in unknown]
    at = [
        point_of(m, load.on, load.at, ("loads", name, "at")) - reference[index[load.on]]
        if load.type == "force"
        else np.zeros(2)
        for name, load in zip(unknown, loads, strict=True)
    ]
    direction = [
        (np.cos(load.direction), np.sin(load.direction)) if load.type == "force" else (0.0, 0.0)
        for load in loads
    ]
    return Known(
        asked=asked,
        effort=table.numbers(effort).reshape(len(effort), count).T,
        link=np.array([index[load.on] for load in loads], np.intp),
        at=table.numbers(at).reshape(-1, 2),
        direction=table.numbers(direction).reshape(-1, 2),
        follows=np.array([getattr(load, "axes", "ground") == "link" for load in loads], bool),
        couple=np.array([load.type == "couple" for load in loads], bool),
    )
