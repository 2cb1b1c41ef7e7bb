"""A drawing as a model tree: numbers read off in the links' axes, in any units, moved, joints' i and j exchanged."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import pi

import numpy as np

from tests.random_mechanisms.writing import IN_LBF, MM_N, SI, Style, Tree
from tests.random_space.drawing import BALLS, Array, Drawing, Joint, Load, Mass, Rigid

__all__ = ["IN_LBF", "MM_N", "SI", "Options", "Style", "exchangeable", "tree"]


@dataclass(frozen=True)
class Options:
    """How a drawing is written.

    motion: of the whole machine; frames: other axes (rotation, origin) of links; exchange: joints whose i and j are
    swapped; order: a seed that shuffles links, joints and loads; loads, speeds: factors.
    """

    style: Style = SI
    motion: Rigid | None = None
    frames: dict[str, tuple[Array, Array]] = field(default_factory=dict)
    exchange: frozenset[str] = frozenset()
    order: int | None = None
    loads: float = 1.0
    speeds: float = 1.0


def tree(d: Drawing, options: Options = Options()) -> Tree:
    """The model tree of a drawing."""
    if options.motion is not None:
        d = _moved(d, options.motion)
    if options.frames:
        d = replace(d, poses={**d.poses, **options.frames}, posed=True)
    w = _Writer(d, options)
    made: Tree = {
        "dalembert": 1,
        "space": "space",
        "gravity": [options.style.kind(g * options.loads, length=1) for g in d.gravity],
        "links": w.shuffled({name: w.link(name) for name in d.poses}),
        "joints": w.shuffled({name: w.joint(name) for name in d.joints}),
        "drives": {name: w.drive(name) for name in d.drives},
        "loads": w.shuffled({name: w.load(load) for name, load in d.loads.items()}),
    }
    if d.posed:
        made["assembly"] = {name: w.pose(name) for name in d.poses if name != "ground"}
    return made | ({"units": options.style.units} if options.style.units else {})


def exchangeable(d: Drawing) -> frozenset[str]:
    """Joints that are the same with i and j swapped; the others' guides belong to i."""
    kinds = ("weld", "revolute", "prismatic", "screw", "cylindrical", "universal", "spherical")
    return frozenset(name for name, j in d.joints.items() if j.type in kinds and j.axis is None)


def _moved(d: Drawing, m: Rigid) -> Drawing:
    """The whole machine moved; ground's axes stay, so that the file has to give the other links' poses."""
    joints = {
        k: replace(
            j,
            on_i=j.on_i @ m.turn.T,
            on_j=j.on_j @ m.turn.T,
            axis=None if j.axis is None else m.vector(j.axis),
        )
        for k, j in d.joints.items()
    }
    return replace(
        d,
        poses={k: (m.turn @ r, m.point(o)) if k != "ground" else (r, o) for k, (r, o) in d.poses.items()},
        spots={link: {k: m.point(p) for k, p in points.items()} for link, points in d.spots.items()},
        joints=joints,
        loads={k: replace(load, vector=m.vector(load.vector)) for k, load in d.loads.items()},
        masses={
            k: Mass(x.mass, m.point(x.center), m.turn @ x.inertia @ m.turn.T) for k, x in d.masses.items()
        },
        gravity=m.vector(d.gravity),
        posed=True,
    )


@dataclass(frozen=True)
class _Writer:
    d: Drawing
    options: Options

    def shuffled(self, items: Tree) -> Tree:
        if self.options.order is None:
            return items
        names = list(items)
        np.random.default_rng(self.options.order).shuffle(names)
        return {name: items[name] for name in names}

    def kind(self, value: float, **powers: int) -> float:
        return float(self.options.style.kind(float(value), **powers))

    def lengths(self, values: Array) -> list[float]:
        return [self.kind(x, length=1) for x in values]

    def local(self, link: str, p: Array) -> list[float]:
        """A place in ground axes as a vector of link axes."""
        r, o = self.d.poses[link]
        return self.lengths(r.T @ (p - o))

    def direction(self, link: str, v: Array) -> list[float]:
        return [float(x) for x in self.d.poses[link][0].T @ v]

    def link(self, name: str) -> Tree:
        made: Tree = {"points": {k: self.local(name, p) for k, p in self.d.spots[name].items()}}
        if name not in self.d.masses:
            return made
        x, r = self.d.masses[name], self.d.poses[name][0]
        inertia = r.T @ x.inertia @ r
        inertia = (inertia + inertia.T) / 2
        made["mass"] = self.kind(x.mass, mass=1)
        made["center"] = self.local(name, x.center)
        made["inertia"] = [[self.kind(c, mass=1, length=2) for c in row] for row in inertia]
        return made

    def pose(self, name: str) -> Tree:
        r, o = self.d.poses[name]
        w = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
        angle = np.arctan2(np.linalg.norm(w), np.trace(r) - 1.0)
        axis = w / np.linalg.norm(w) if np.linalg.norm(w) > 0 else np.array([0.0, 0.0, 1.0])
        return {
            "position": self.lengths(o),
            "axis": [float(x) for x in axis],
            "angle": float(angle * 180 / pi),
        }

    def joint(self, name: str) -> Tree:
        j = self.d.joints[name]
        sides = [(j.i, j.at_i, j.on_i), (j.j, j.at_j, j.on_j)]
        if name in self.options.exchange:
            sides.reverse()
        (i, at_i, on_i), (k, at_j, on_j) = sides
        made: Tree = {"type": j.type, "links": [i, k], "at": [at_i, at_j]}
        if j.type == "universal":
            pins = (j.on_i[1], j.on_j[2]) if name not in self.options.exchange else (j.on_j[2], j.on_i[1])
            made["axes"] = {
                side: {"z": self.direction(link, pin)}
                for side, link, pin in zip("ij", (i, k), pins, strict=True)
            }
        else:
            made["axes"] = {
                side: {"x": self.direction(link, on[0]), "z": self.direction(link, on[2])}
                for side, link, on in (("i", i, on_i), ("j", k, on_j))
            }
        if j.lead:
            made["lead"] = self.kind(j.lead, length=1)
        if j.blocked != "x":
            made["blocked"] = j.blocked
        if j.damping:
            made["damping"] = {self.named(name, f): self.damping(f, c) for f, c in j.damping.items()}
        return made

    def named(self, joint: str, freedom: str) -> str:
        """A freedom's name: the pins of an exchanged universal joint change places."""
        if joint in self.options.exchange and freedom in ("turn1", "turn2"):
            return {"turn1": "turn2", "turn2": "turn1"}[freedom]
        return freedom

    def damping(self, freedom: str, value: float) -> float:
        return self.kind(value, force=1, length=-1 if freedom.startswith("slide") else 1)

    def drive(self, name: str) -> Tree:
        drive = self.d.drives[name]
        exchanged = drive.joint in self.options.exchange
        sign, j = -1.0 if exchanged else 1.0, self.d.joints[drive.joint]
        start, slides = start_of(self.d, j, drive.freedom), drive.freedom.startswith("slide")
        positions = [sign * (start + step) for step in drive.steps]
        speed = sign * drive.speed * self.options.speeds
        gain = sign * drive.acceleration * self.options.speeds**2
        made: Tree = {
            "joint": drive.joint,
            "freedom": self.named(drive.joint, drive.freedom),
            "position": [self.kind(p, length=1) if slides else p * 180 / pi for p in positions],
            "speed": self.kind(speed, length=1) if slides else f"{speed!r} rad/s",
            "acceleration": self.kind(gain, length=1) if slides else f"{gain!r} rad/s^2",
        }
        if j.axis is not None and drive.freedom == "turn":
            made["axis"] = self.direction(j.i, j.axis)
        return made

    def load(self, load: Load) -> Tree:
        factor, kind = self.options.loads, self.kind
        if load.type in ("force", "couple"):
            return self.vectorial(load, factor)
        if load.b[0]:
            made: Tree = {"type": load.type, "between": [".".join(load.a), ".".join(load.b)]}
            if load.type == "constant_force_spring":
                return made | {"force": kind(factor * load.value, force=1)}
            value = kind(factor * load.value, force=1, length=-1)
            if load.type == "damper":
                return made | {"damping": value}
            return made | {"stiffness": value, "free_length": kind(load.free, length=1)}
        sign = -1.0 if load.joint in self.options.exchange else 1.0
        made = {"type": load.type, "joint": load.joint}
        value = kind(factor * load.value, force=1, length=1)
        if load.type == "torsion_damper":
            return made | {"damping": value}
        free = start_of(self.d, self.d.joints[load.joint], "turn") + load.free
        return made | {"stiffness": value, "free_angle": float(sign * free * 180 / pi)}

    def vectorial(self, load: Load, factor: float) -> Tree:
        """A force or couple, as a vector or as a value along a direction."""
        on = load.a[0]
        powers = {"force": 1} if load.type == "force" else {"force": 1, "length": 1}
        vector = np.array(self.direction(on, load.vector)) if load.follows else load.vector
        made: Tree = {"type": load.type, "on": on, "axes": "link" if load.follows else "ground"}
        if load.type == "force":
            made["at"] = load.a[1]
        if load.along:
            value = self.kind(factor * float(np.linalg.norm(vector)), **powers)
            return made | {"value": value, "direction": [2.5 * float(c) for c in vector]}
        return made | {"value": [self.kind(factor * c, **powers) for c in vector]}


def start_of(d: Drawing, j: Joint, freedom: str) -> float:
    """Drawn value of a freedom, i and j not exchanged."""
    if j.type == "universal":
        return _universal(d, j, freedom)
    if j.type in BALLS and freedom == "turn":
        assert j.axis is not None
        return ball_turn(j.axis, j.on_i, j.on_j)
    if j.type == "screw":
        return j.values[0] if freedom == "turn" else j.lead / (2 * pi) * j.values[0]
    place = (int(freedom[-1:]) if freedom[-1:].isdigit() else 1) - 1
    return j.values[place + (len(j.pair.slides) if freedom.startswith("turn") else 0)]


def _universal(d: Drawing, j: Joint, freedom: str) -> float:
    """Turn of a pin: 0 where the other pin has the components in i's axes that it has in j's, made square."""
    first, second = j.on_i[1], j.on_j[2]
    own, other = (j.i, j.j) if freedom == "turn1" else (j.j, j.i)
    pin, far = (first, second) if freedom == "turn1" else (second, first)
    components = d.poses[other][0].T @ far
    zero = d.poses[own][0] @ components
    zero = zero - (zero @ pin) * pin
    assert np.linalg.norm(zero) > 0.1, "no zero of a turn"
    angle = float(np.arctan2(np.cross(zero, far) @ pin, zero @ far))
    return angle if freedom == "turn1" else -angle


def ball_turn(axis: Array, on_i: Array, on_j: Array) -> float:
    """Angle about an axis of i of the direction of j that has the components of one across the axis in i."""
    b, p = ball_directions(axis, on_i, on_j)
    return float(np.arctan2(p @ np.cross(axis / np.linalg.norm(axis), b), p @ b))


def ball_directions(axis: Array, on_i: Array, on_j: Array) -> tuple[Array, Array]:
    """A direction of i across the axis, and that of j with the same components in the joint's local axes."""
    a = on_i @ axis / np.linalg.norm(axis)
    b = np.cross(a, np.eye(3)[np.abs(a).argmin()])
    b /= np.linalg.norm(b)
    return on_i.T @ b, on_j.T @ b
