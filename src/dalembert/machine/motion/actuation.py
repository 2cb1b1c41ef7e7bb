"""Actuation of each drive: a given effort, a motor with its switches, nothing; or a prescribed motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from dalembert.analysis.compile.elements.held_clutches import with_clutches
from dalembert.analysis.compile.pose_loads import TIME
from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError
from dalembert.machine.motion.corners.elastic_stops import ElasticStops, stop_forces
from dalembert.machine.motion.corners.one_sided import Sided, has_corners
from dalembert.machine.motion.corners.prescribed_laws import PrescribedLaw
from dalembert.machine.motion.stops.gap_contacts import contact_stops
from dalembert.model import Mechanism, Schedule
from dalembert.model.drives.drives import Drive, Range
from dalembert.model.drives.end_stops import Stops
from dalembert.model.drives.motors import Switch
from dalembert.model.drives.starting import Start, StartValue
from dalembert.model.drives.turning_checks import refuse_unsteady
from dalembert.model.joints.plane_joints import Joint
from dalembert.model.quantities.coordinates import SPEED
from dalembert.model.quantities.expressions import Expression
from dalembert.model.quantities.tables import Table
from dalembert.wording import closest

FADES = 3.0
"""Time constants of a motor that a step lasts at most: up to 6 the method is stable, and in between less exact."""


def joint_stops(m: Mechanism) -> dict[tuple[str, str], Stops]:
    """Stops of joints by joint and freedom, and of the gaps of opened contacts."""
    stopped = {n: s for n, j in m.joints.items() if (s := getattr(j, "stops", None)) is not None}
    stops = {(n, "slide" if s.kind == "length" else "turn"): s for n, s in stopped.items()}
    return stops | contact_stops(m)


def drive_lengths(m: Mechanism) -> Array:
    """Reference length for a position of each drive (D,): 1 rad for a turn; for a slide the size of the largest link,
    or else its start; 1 m for a lone point at 0."""
    at = [np.array(list(m.points(name).values()), float) for name, link in m.links.items() if link.points]
    size = max((float(np.ptp(x, axis=0).max()) for x in at), default=0.0)
    start = [float(np.ravel(np.array(d.position, object))[0]) for d in m.drives.values()]
    return np.array(
        [1.0 if d.turns else size or abs(q) or 1.0 for d, q in zip(m.drives.values(), start, strict=True)]
    )


@dataclass
class Actuation:
    """Actuation of the drives of a mechanism: ``free`` (D,) by forces from ``position`` and ``speed``, the others at a
    constant ``acceleration`` (D,) or by ``laws``; ``on`` (D,): True where a motor is switched on."""

    m: Mechanism
    free: Flags
    position: Array
    speed: Array
    acceleration: Array
    laws: dict[int, PrescribedLaw] = field(default_factory=dict)
    contacts: tuple[Any, ...] = ()
    """Contacts that push, whose gaps are drives or have stops: ``landing.opened_contacts.GapContact``."""
    equation: Any = None
    """An ``Equation`` that several machines share; None: each has a separate one."""
    on: Flags = field(init=False)

    def __post_init__(self) -> None:
        self.names = tuple(self.m.drives)
        self.speeds = [name + SPEED for name in self.names]
        self.drives = tuple(self.m.drives.values())
        self.motors = {k: d.motor.at_drive for k, d in enumerate(self.drives) if d.motor is not None}
        geared = {k: d.motor for k, d in enumerate(self.drives) if d.motor is not None and self.free[k]}
        self.gears = {k: x for k, x in geared.items() if x.inertia or x.efficiency < 1}
        self.late = [k for k, x in self.motors.items() if x.time_constant and self.free[k]]
        self.torque = np.zeros(len(self.late))  # of the late motors, at the state that is looked at
        self.side = np.ones(len(self.drives))  # the sign of what the motor's shaft gives to its gear
        self.gain = np.ones(len(self.drives))  # the efficiency of gears, or its inverse
        self.lossy = np.array(
            [k in self.gears and self.gears[k].efficiency < 1 for k in range(len(self.drives))]
        )
        self.brake = np.array([d.brake for d in self.drives])
        self.turns = np.array([d.turns for d in self.drives])
        self.on = np.array([self._begins(k) for k in range(len(self.names))])
        efforts = {k: d.effort for k, d in enumerate(self.drives) if has_corners(d.effort)}
        self.sided = {
            k: Sided(e, f"the effort of drive {self.names[k]!r}")
            for k, e in efforts.items()
            if isinstance(e, Expression | Table)
        }
        self.elastic = {
            k: ElasticStops(
                None, f"the stop of drive {name!r}", name=name, freedom=str(d.freedom), stops=d.stops
            )
            for k, (name, d) in enumerate(self.m.drives.items())
            if d.stops is not None and d.stops.stiffness
        }

    def _begins(self, k: int) -> bool:
        motor = self.motors.get(k)
        return motor is not None and (
            motor.on is None or self.switched(motor.on, k, 0.0, self.position, self.speed) == 0
        )

    def accelerations(self, t: float) -> Array:
        """Accelerations (D,) of the drives that forces do not move; 0 of the others."""
        out = np.where(self.free, 0.0, self.acceleration)
        for k, law in self.laws.items():
            out[k] = law.at(t)[2]
        return out

    def next_joint(self, t: float) -> float:
        """The next instant at which two pieces of a law join."""
        return min((law.next_joint(t) for law in self.laws.values()), default=np.inf)

    def follow_laws(self, t: float, end: float, y: Array) -> None:
        """Begin pieces that go up to an end: positions and speeds are those of the laws."""
        for k, law in self.laws.items():
            law.end = np.inf if end < t else end
            y[k], y[len(self.free) + k] = law.at(t)[:2]

    def switched(self, switch: Switch, k: int, t: float, q: Array, u: Array) -> float:
        """Switching variable of a motor, less its switching value."""
        by, value = switch
        return float({"time": t, "position": q[k], "speed": u[k]}[by] - value)

    def known(self, t: float, q: Array, u: Array) -> dict[str, float]:
        """Variables of efforts: time, positions and speeds of the drives."""
        return {TIME: t, **dict(zip((*self.names, *self.speeds), (*q, *u), strict=True))}

    def effort(self, t: float, q: Array, u: Array) -> Array:
        """Efforts (D,) of motors and elastic stops with those that are given, without brakes."""
        out, known = np.zeros(len(q)), self.known(t, q, u)
        for k, drive in enumerate(self.drives):
            if drive.effort is not None:
                effort = self.sided.get(k, drive.effort)
                out[k] = effort.at(known) if hasattr(effort, "at") else effort
            if k in self.motors:
                out[k] += self.gain[k] * self.motor_effort(k, u)
            if k in self.elastic:
                out[k] += self.elastic[k].at(known)
        return out

    def motor_effort(self, k: int, u: Array) -> float:
        """Effort of a motor: that of its curve, 0 switched off; of a late one what it has come to."""
        if k in self.late:
            return float(self.torque[self.late.index(k)])
        return self.steady(k, u)

    def steady(self, k: int, u: Array) -> float:
        """Effort of a motor that its time constant leads to: of its curve, 0 switched off."""
        return float(self.motors[k].at(u[k])) if self.on[k] else 0.0

    @property
    def longest_step(self) -> float:
        """Longest step, s, within which the efforts of the late motors die down instead of swinging."""
        return min((FADES * self.motors[k].time_constant for k in self.late), default=np.inf)

    def torque_rates(self, u: Array) -> Array:
        """Rates (L,) of the efforts of the late motors: (curve - T)/tau."""
        goals = [self.steady(k, u) for k in self.late]
        late = np.array([self.motors[k].time_constant for k in self.late])
        return np.asarray((goals - self.torque) / late)

    def elastic_forces(self, along: Schedule) -> Array:
        """Forces (T, D) of elastic stops along a motion."""
        out = np.zeros_like(along.position)
        for k, elastic in self.elastic.items():
            out[:, k] = stop_forces(elastic.stops, along.position[:, k], along.speed[:, k])
        return out

    @property
    def switched_efforts(self) -> tuple[Sided, ...]:
        """Efforts and elastic stops that have corners or jumps."""
        return (*self.sided.values(), *self.elastic.values())

    def take_ways(self, toward: Array) -> Array:
        """Take the efficiencies of gears for senses of motion (D,); the inertias (D,) of their rotors at the drives."""
        rotor = np.zeros(len(self.drives))
        for k, gear in self.gears.items():
            self.gain[k] = gear.efficiency ** float(self.side[k] * toward[k])
            rotor[k] = gear.inertia * gear.ratio**2 * self.gain[k]
        return rotor

    def shaft(self, k: int, u: Array, a: Array) -> float:
        """Torque of a motor's shaft on its gear, times the ratio: n (T - J n a)."""
        gear = self.gears[k]
        return float(self.motor_effort(k, u) - gear.inertia * gear.ratio**2 * a[k])

    def set_anchor(self) -> None:
        """Keep the last state as the one at which a step begins: unused here."""

    def powers(self, t: float, q: Array, u: Array, effort: Array) -> Array:
        """Powers (D,) of the drives, that have these efforts."""
        return effort * u

    def lines(self, u: Array, ahead: Array) -> tuple[Array, Array] | None:
        """Efforts (D,) at speed 0 and their slopes (D,), until a motor's next corner or switch; None where an effort
        depends on positions, speeds or the time. ``ahead``: accelerations, which decide the side on which a motor
        leaves a corner."""
        first, slope = np.zeros((2, len(u)))
        if self.gears or self.elastic or self.late:
            return None
        for k, drive in enumerate(self.drives):
            if hasattr(drive.effort, "at"):
                return None
            first[k] = drive.effort or 0.0
            if drive.effort is None and k in self.motors and self.on[k]:
                first[k], slope[k] = self.motors[k].line(u[k], ahead[k])
        return first, slope


def actuation(m: Mechanism, start: dict[str, Start] | None = None) -> tuple[Mechanism, Actuation]:
    """The mechanism with all its drives prescribed where they start, and how they move."""
    m = with_clutches(m, len(m.drives))
    if start:
        m = m.model_copy(update={"start": {**m.start, **start}})
    refuse_unsteady(m)
    free = [n for n, d in m.drives.items() if n in m.start or d.motor is not None or d.effort is not None]
    if not free:
        raise ModelError(
            "no drive is free: none has a start, a motor or an effort",
            "write start: {O2: {position: 60 deg, speed: 0}}, with the name of a drive",
            ("drives",),
        )
    braked = next((n for n, d in m.drives.items() if d.brake and n not in free), "")
    if braked:
        raise ModelError(
            f"drive {braked!r} is prescribed, and its brake would have no effect on the motion",
            f"release it: start: {{{braked}: {{position: ..., speed: 0}}}}, or leave the brake out",
            ("drives", braked, "brake"),
        )
    for name in free:
        cylinder = m.drives[name].cylinder
        if cylinder is not None and cylinder.known_force is not None and cylinder.loses:
            raise ModelError(
                f"cylinder {name!r} has losses and both pressures, and a motion under forces leaves such losses out",
                "leave its efficiency and friction out, or give the joint it moves friction",
                ("drives", name, "cylinder"),
            )
    at = {name: _at_start(name, d, m.start.get(name), name in free) for name, d in m.drives.items()}
    q, u, a = np.array(list(at.values())).T
    steady = {"speed": 1.0, "acceleration": 0.0, "brake": 0.0} | dict.fromkeys(
        ("effort", "motor", "law", "range", "stops")
    )
    drives = {n: d.model_copy(update={**steady, "position": at[n][0]}) for n, d in m.drives.items()}
    unknown = [name for name, load in m.loads.items() if load.unknown]
    if unknown:
        raise ModelError(
            f"load {unknown[0]!r} is unknown, but forces move the machine",
            "give it a value",
            ("loads", unknown[0], "value"),
        )
    m, joints = _with_stops_of_drives(m, free)
    prescribed = m.model_copy(update={"drives": drives, "joints": joints, "start": {}, "answers": ()})
    laws = {
        k: PrescribedLaw(n, d.law)
        for k, (n, d) in enumerate(m.drives.items())
        if d.law is not None and n not in free
    }
    return prescribed, Actuation(m, np.array([n in free for n in m.drives]), q, u, a, laws=laws)


def _with_stops_of_drives(m: Mechanism, free: list[str]) -> tuple[Mechanism, dict[str, Joint]]:
    """The mechanism with stops of joints that are driven given to their drives; and its joints without these."""
    drives, joints, stops = dict(m.drives), dict(m.joints), joint_stops(m)
    for name, drive in m.drives.items():
        joint, c = m.drive_joint(name), drive.cylinder
        if c is not None and c.lengths and not drive.stops and name in free:
            drives[name] = drive = drive.model_copy(update={"stops": Stops(*c.lengths)})
        ends = stops.get((joint, str(drive.freedom)))
        path = ("joints", joint, "stops") if ends else ("drives", name, "stops")
        if ends and drive.stops:
            raise ModelError(f"joint {joint!r} and its drive have stops", "leave one of them out", path)
        if (ends or drive.stops) and name not in free:
            what = f"drive {name!r} is prescribed, and its stops would be gone through"
            raise ModelError(what, f"let it go: start: {{{name}: {{position: ..., speed: 0}}}}", path)
        if ends:
            drives[name] = drive.model_copy(update={"stops": ends})
            joints[joint] = joints[joint].model_copy(update={"stops": None})
    return m.model_copy(update={"drives": drives}), joints


def _at_start(name: str, d: Drive, start: Start | None, free: bool) -> tuple[float, float, float]:
    """Position, speed and acceleration at time 0."""
    if start is not None:
        return start.position, start.speed, 0.0
    if d.law is not None:
        s, v, a = PrescribedLaw(name, d.law).at(0.0)
        return float(s), float(v), float(a)
    if d.position is None or isinstance(d.position, str):
        raise ModelError(
            f"drive {name!r} has no position to start at",
            f"write start: {{{name}: {{position: ..., speed: 0}}}}",
            ("drives", name),
        )
    first = d.position.start if isinstance(d.position, Range) else np.ravel(d.position)[0]
    rate = float(np.ravel(d.acceleration)[0])
    return float(first), float(np.ravel(d.speed)[0]), 0.0 if free else rate


def read_start(m: Mechanism, start: Mapping[str, object] | None) -> dict[str, Start]:
    """Starts given in the call, read as in a file."""
    if not start:
        return {}
    for name in start:
        if name not in m.drives:
            raise ModelError(
                f"start names the drive {name!r}, which does not exist", closest(name, list(m.drives))
            )
    return StartValue().starts(start, m._later_rules({}))
