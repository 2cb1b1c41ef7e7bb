"""A drawing as a model tree: lengths read off, in any units, moved, with i and j of its joints exchanged."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, pi, sin
from typing import Any

import numpy as np

from tests.random_mechanisms.drawing import Drawing, Drive, Joint, Load, Point, Rigid

Tree = dict[str, Any]
POUND_FORCE, INCH = 4.4482216152605, 0.0254


@dataclass(frozen=True)
class Style:
    """Units of a file: names, and how many SI units one of them is."""

    units: Tree
    length: float = 1.0
    force: float = 1.0
    mass: float = 1.0

    def kind(self, value: float, length: int = 0, force: int = 0, mass: int = 0) -> float:
        """A value in SI as a bare number of this file."""
        return value / (self.length**length * self.force**force * self.mass**mass)


SI = Style({})
MM_N = Style({"length": "mm", "force": "N", "mass": "kg", "angle": "deg"}, length=1e-3)
IN_LBF = Style({"length": "in", "force": "lbf", "mass": "blob"}, INCH, POUND_FORCE, POUND_FORCE / INCH)


@dataclass(frozen=True)
class Scale:
    """Factors on the loads and the masses: for the laws of superposition."""

    loads: float = 1.0
    masses: float = 1.0
    speeds: float = 1.0


def tree(
    d: Drawing,
    style: Style = SI,
    motion: Rigid | None = None,
    exchange: frozenset[str] = frozenset(),
    scale: Scale | None = None,
) -> Tree:
    """The model tree of a drawing; ``exchange`` names the joints whose i and j are swapped."""
    w = _Writer(_moved(d, motion or Rigid()), style, exchange, scale or Scale())
    made = {
        "dalembert": 1,
        "gravity": [style.kind(g * w.scale.masses, length=1) for g in w.d.gravity],
        "links": {name: w.link(name) for name in d.spots},
        "joints": {name: w.joint(name) for name in d.joints},
        "drives": {name: w.drive(drive) for name, drive in d.drives.items()},
        "loads": {name: w.load(load) for name, load in w.d.loads.items()},
        "assembly": {name: w.assembly(k, name) for k, name in enumerate(d.poses) if name != "ground"},
    }
    return made | ({"units": style.units} if style.units else {})


def pose_array(d: Drawing, motion: Rigid | None = None) -> np.ndarray:
    """The drawn poses (P, L, 3), ground first, once for each position."""
    q = np.array(list(_moved(d, motion or Rigid()).poses.values()))
    count = max((len(drive.steps) for drive in d.drives.values()), default=1)
    return np.broadcast_to(q, (count, *q.shape)).copy()


def exchangeable(d: Drawing) -> frozenset[str]:
    """Joints that are the same with i and j swapped (a slot and a rail belong to i)."""
    return frozenset(name for name, j in d.joints.items() if j.type in ("pin", "weld", "gear", "slider"))


def _moved(d: Drawing, m: Rigid) -> Drawing:
    """The whole machine moved; ground's axes stay."""
    poses = {k: (*m.point(p[:2]), p[2] + m.turn) if k != "ground" else p for k, p in d.poses.items()}
    spots = {link: {k: m.point(p) for k, p in points.items()} for link, points in d.spots.items()}
    joints = {k: Joint(**{**vars(j), "direction": j.direction + m.turn}) for k, j in d.joints.items()}
    loads = {
        k: load if load.follows else Load(**{**vars(load), "vector": m.vector(load.vector)})
        for k, load in d.loads.items()
    }
    return Drawing(poses, spots, joints, d.drives, loads, d.masses, m.vector(d.gravity), d.seed)


def mirrored(d: Drawing) -> Drawing:
    """The drawing reflected in ground's x axis, every link in its own."""

    def flipped(p: Point) -> Point:
        return p[0], -p[1]

    def joint(j: Joint) -> Joint:
        wheel = pi if j.type == "rolling" and not j.radii[0] else 0.0  # on the left of its line
        return replace(j, direction=wheel - j.direction)

    def drive(q: Drive) -> Drive:
        turned = replace(q, steps=tuple(-x for x in q.steps), speed=-q.speed, acceleration=-q.acceleration)
        return turned if q.freedom == "turn" else q

    def load(f: Load) -> Load:
        turns = {"couple": {"value": -f.value}, "torsion_spring": {"free": -f.free}}
        return replace(f, vector=flipped(f.vector), **turns.get(f.type, {}))

    return Drawing(
        {k: (x, -y, -angle) for k, (x, y, angle) in d.poses.items()},
        {link: {k: flipped(p) for k, p in points.items()} for link, points in d.spots.items()},
        {k: joint(j) for k, j in d.joints.items()},
        {k: drive(q) for k, q in d.drives.items()},
        {k: load(f) for k, f in d.loads.items()},
        {k: (mass, flipped(center), inertia) for k, (mass, center, inertia) in d.masses.items()},
        flipped(d.gravity),
        d.seed,
    )


@dataclass(frozen=True)
class _Writer:
    d: Drawing
    style: Style
    exchange: frozenset[str]
    scale: Scale

    def length(self, value: float) -> float:
        return self.style.kind(value, length=1)

    def angle(self, value: float) -> float:
        return value * 180 / pi

    def local(self, link: str, p: Point) -> list[float]:
        """A place in ground axes as a vector of link axes."""
        x, y, angle = self.d.poses[link]
        c, s = cos(angle), sin(angle)
        dx, dy = p[0] - x, p[1] - y
        return [self.length(c * dx + s * dy), self.length(-s * dx + c * dy)]

    def link(self, name: str) -> Tree:
        made: Tree = {"points": {k: self.local(name, p) for k, p in self.d.spots[name].items()}}
        if name not in self.d.masses:
            return made
        mass, center, inertia = self.d.masses[name]
        made["mass"] = self.style.kind(mass * self._mass_factor(), mass=1)
        made["center"] = [self.length(c) for c in center]
        made["inertia"] = self.style.kind(inertia * self._mass_factor(), mass=1, length=2)
        return made

    def _mass_factor(self) -> float:
        """Gravity carries the factor on the weights; inertia is dropped by statics."""
        return 1.0

    def joint(self, name: str) -> Tree:
        j = self.d.joints[name]
        swapped = name in self.exchange
        i, k = (j.j, j.i) if swapped else (j.i, j.j)
        made: Tree = {
            "type": j.type,
            "links": [i, k],
            "at": [j.at_j, j.at_i] if swapped else [j.at_i, j.at_j],
        }
        direction = j.direction - self.d.poses[i][2]
        turn = self.d.poses[k][2] - self.d.poses[i][2]
        if j.type in ("slider", "slot") or (j.type == "rolling" and not j.radii[0]):
            made["direction"] = self.angle(direction)
        if j.type in ("slider", "weld"):
            made["angle"] = self.angle(turn - (direction if j.type == "slider" else 0.0))
        if j.type == "circular_slot":
            made["radius"] = self.length(j.radii[0])
        if j.type == "rolling":
            made["contact"] = "holds"  # loads are random: half of them would lift the wheel off
        if j.type in ("gear", "rolling"):
            made |= self._wheels(j, swapped)
        if j.damping:
            made["damping"] = self._damping(j)
        return made

    def _wheels(self, j: Joint, swapped: bool) -> Tree:
        if not j.radii[0]:
            return {"radius": self.length(j.radii[1])}
        radii = [self.length(r) for r in (reversed(j.radii) if swapped else j.radii)]
        pressure = {"pressure_angle": j.pressure} if j.type == "gear" else {}
        return {"radii": radii, "internal": j.internal, **pressure}

    def _damping(self, j: Joint) -> Any:
        if j.type == "slot":
            return {"slide": self.style.kind(j.damping, force=1, length=-1)}
        turns = j.type != "slider"
        return self.style.kind(j.damping, force=1, length=1 if turns else -1)

    def drive(self, drive: Drive) -> Tree:
        sign = -1.0 if drive.joint in self.exchange else 1.0
        start, turns = self._start(self.d.joints[drive.joint], drive.freedom), drive.freedom == "turn"
        positions = [sign * (start + step) for step in drive.steps]
        speed, gain = (
            sign * x for x in (drive.speed * self.scale.speeds, drive.acceleration * self.scale.speeds**2)
        )
        return {
            "joint": drive.joint,
            "freedom": drive.freedom,
            "position": [self.angle(p) if turns else self.length(p) for p in positions],
            "speed": f"{speed!r} rad/s" if turns else self.length(speed),
            "acceleration": f"{gain!r} rad/s^2" if turns else self.length(gain),
        }

    def _start(self, j: Joint, freedom: str) -> float:
        """Drawn value of a freedom, unexchanged."""
        if freedom == "turn":
            return self.d.poses[j.j][2] - self.d.poses[j.i][2]
        p, r = self.d.ends(j)
        return cos(j.direction) * (r[0] - p[0]) + sin(j.direction) * (r[1] - p[1])

    def load(self, load: Load) -> Tree:
        factor = self.scale.loads
        kind = self.style.kind
        if load.type == "force":
            value = [kind(factor * c, force=1) for c in load.vector]
            axes = "link" if load.follows else "ground"
            return {"type": "force", "on": load.a[0], "at": load.a[1], "axes": axes, "value": value}
        if load.type == "couple":
            return {"type": "couple", "on": load.a[0], "value": kind(factor * load.value, force=1, length=1)}
        if load.b[0]:
            return self._line(load, factor)
        sign = -1.0 if load.joint in self.exchange else 1.0
        made: Tree = {"type": load.type, "joint": load.joint}
        value = kind(factor * load.value, force=1, length=1)
        if load.type == "torsion_damper":
            return made | {"damping": value}
        free = self._start(self.d.joints[load.joint], "turn") + load.free
        return made | {"stiffness": value, "free_angle": self.angle(sign * free)}

    def _line(self, load: Load, factor: float) -> Tree:
        made: Tree = {"type": load.type, "between": [".".join(load.a), ".".join(load.b)]}
        if load.type == "constant_force_spring":
            return made | {"force": self.style.kind(factor * load.value, force=1)}
        value = self.style.kind(factor * load.value, force=1, length=-1)
        if load.type == "damper":
            return made | {"damping": value}
        return made | {"stiffness": value, "free_length": self.length(load.free)}

    def assembly(self, k: int, name: str) -> Any:
        """The drawn angle; the whole pose for some links, and where an angle does not tell two places apart."""
        x, y, angle = self.d.poses[name]
        round_slot = any(j.type == "circular_slot" and name in (j.i, j.j) for j in self.d.joints.values())
        if (self.d.seed + k) % 5 and not round_slot:
            return self.angle(angle)
        return [self.length(x), self.length(y), self.angle(angle)]
