"""Overconstrained linkages of the literature: geometry as drawn, freedoms and redundant constraints, sources.

All are drawn in a general pose, in ground axes; the trees give every link axes that coincide with ground's there, so
that a joint's point and axis have the same components on both links.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians, sin, sqrt
from typing import Any

import numpy as np

from tests.oracles.reading import Tree
from tests.oracles.space.parts import plain, skew
from tests.oracles.space.screws import Joint, Loop

CARRIED = {"revolute": 5, "prismatic": 5, "screw": 5, "cylindrical": 4, "universal": 4, "spherical": 3}
"""Constraints of each joint."""

BAKER = "J. E. Baker, An analysis of the Bricard linkages, Mechanism and Machine Theory 15 (1980) 267-286"
GOGU = "G. Gogu, Mobility of mechanisms: a critical review, Mechanism and Machine Theory 40 (2005) 1068-1097"
HUNT = "K. H. Hunt, Kinematic Geometry of Mechanisms (1978), chapters 2 and 12"
YOU_CHEN = "Z. You and Y. Chen, Motion Structures (2011), chapter 3"
PHILLIPS = "J. Phillips, Freedom in Machinery 2 (1990), chapter 20"


@dataclass(frozen=True)
class Classic:
    """Published freedoms; `moves` says how far the first drive may go from the drawn pose (degrees or metres)."""

    name: str
    source: str
    joints: dict[str, Joint]
    freedoms: int = 1
    drives: tuple[str, ...] = ()
    moves: float = 15.0

    @property
    def links(self) -> tuple[str, ...]:
        """Ground first."""
        return tuple(
            dict.fromkeys(["ground", *(x for joint in self.joints.values() for x in (joint.i, joint.j))])
        )

    @property
    def count(self) -> int:
        """Gruebler and Kutzbach: 6 a moving link less the joints' constraints."""
        return 6 * (len(self.links) - 1) - sum(CARRIED[joint.type] for joint in self.joints.values())

    @property
    def redundant(self) -> int:
        return self.freedoms - self.count

    def tree(self, steps: int = 1) -> Tree:
        """For the product: every link the same mass; drives go from the drawn pose, 0, in equal steps."""
        points: dict[str, Tree] = {link: {} for link in self.links}
        for name, joint in self.joints.items():
            for link in (joint.i, joint.j):
                points[link][name] = plain(joint.at)
        links: Tree = {}
        for link, at in points.items():
            middle = np.mean(list(at.values()), 0)
            links[link] = {"points": at, "mass": 1.0, "center": plain(middle), "inertia": [0.02, 0.03, 0.04]}
        links["ground"] = {"points": points["ground"]}
        drives = {name: self._drive(name, steps) for name in self.drives}
        return {
            "dalembert": 1, "title": self.name, "source": self.source, "space": "space", "gravity": [1.0, 2.0, -9.0],
            "links": links, "joints": {name: _tree(joint) for name, joint in self.joints.items()}, "drives": drives,
        }  # fmt: skip

    def _drive(self, name: str, steps: int) -> Tree:
        slides = self.joints[name].type == "prismatic"
        unit = "m" if slides else "deg"
        position = (
            f"0 {unit}" if steps == 1 else {"from": f"0 {unit}", "to": f"{self.moves} {unit}", "count": steps}
        )
        freedom = "slide" if slides else "turn"
        return {"freedom": freedom, "position": position, "speed": "0.1 m/s" if slides else "0.7 rad/s"}


def _tree(joint: Joint) -> Tree:
    out: Tree = {"type": joint.type, "links": [joint.i, joint.j]}
    if joint.type == "universal":
        first, second = (plain(np.asarray(u) / np.linalg.norm(u)) for u in joint.axes)
        out["axes"] = {"i": {"z": first}, "j": {"z": second}}
    elif joint.axes:
        out["axis"] = plain(joint.axes[0])
    if joint.lead:
        out["lead"] = joint.lead
    return out


# loops of revolutes by Denavit-Hartenberg


def _loop(name: str, source: str, loop: Loop, start: list[float], **more: Any) -> Classic:
    turns = loop.closed(start[0], np.array(start))
    return Classic(name, source, loop.joints(turns), drives=("J1",), **more)


def _ratio(twist: float) -> float:
    """Bennett's condition: a / sin(twist) is the same for all links; here of the link of 50 degrees and length 1."""
    return sin(radians(twist)) / sin(radians(50))


def _bennett(twist: float) -> Loop:
    return Loop((1.0, _ratio(twist)) * 2, (50.0, twist) * 2, (0.0,) * 4)


def loops() -> list[Classic]:
    b, c, d = _ratio(100), _ratio(70), 1 / sin(radians(40))
    last = sqrt(1.0 + 0.9**2 + 1.2**2 - 0.7**2 - 1.1**2)
    return [
        _loop("Bennett 4R", "G. T. Bennett, A new mechanism, Engineering 76 (1903) 777-778", _bennett(100),
              [0.8, 2.78, -0.8, -2.78]),
        _loop("Goldberg 5R", "M. Goldberg, New five-bar and six-bar linkages in three dimensions, Trans. ASME 65 "
              "(1943) 649-661; " + YOU_CHEN, Loop((1, b, c, 1, b + c), (50, 100, 70, 50, 170), (0,) * 5),
              [0.8, 2.78, -0.73, 0.37, 3.07]),
        _loop("Myard 5R", "F. E. Myard, Contribution a la geometrie des systemes articules, Bull. Soc. Math. France 59 "
              "(1931) 183-210; " + YOU_CHEN, Loop((1, d, 0, d, 1), (40, 90, 100, 90, 140), (0,) * 5),
              [0.8, 1.92, 1.17, -1.97, -1.92]),
        _loop("Bricard, line-symmetric 6R", BAKER, Loop((1, 1.4, 0.8) * 2, (60, 80, 110) * 2, (0.3, 0.2, 0.5) * 2),
              [0.8, -0.96, -2.97, 0.8, -0.96, -2.97], moves=8.0),
        _loop("Bricard, plane-symmetric 6R", BAKER,
              Loop((1, 1.3, 0.8, 0.8, 1.3, 1), (60, 80, 110, 250, 280, 300), (0, 0.3, 0.4, 0, -0.4, -0.3)),
              [0.8, -2.05, -0.51, 2.19, -0.51, -2.05]),
        _loop("Bricard, trihedral 6R", BAKER, Loop((1, 0.7, 0.9, 1.1, 1.2, last), (90, 270) * 3, (0,) * 6),
              [0.8, 1.82, 0.58, 1.9, 0.83, 2.33]),
        _loop("Altmann 6R", "P. G. Altmann, communication to Grodzinski and M'Ewen, Proc. IMechE 168 (1954) 889-896; "
              + YOU_CHEN, Loop((1, 0, 1.3) * 2, (90, 90, 270) * 2, (0,) * 6),
              [0.8, -0.39, -2.66, -0.8, 0.39, 2.66]),
        _loop("Schatz 6R (Turbula)", PHILLIPS,
              Loop((0, 1, 1, 1, 0, sqrt(3)), (90, 90, 90, 90, 90, 0), (0.4, 0, 0, 0, 0, -0.4)),
              [0.8, -2.22, -1.79, 1.3, 2.46, -0.45]),
        waldron(),
    ]  # fmt: skip


def waldron() -> Classic:
    """Two Bennett loops on one common axis, their links next to it made one, the common joint left out."""
    first, second = _bennett(100), Loop((0.8, 0.8 * _ratio(70)) * 2, (50.0, 70.0) * 2, (0.0,) * 4)
    a = first.frames(first.closed(0.8, np.array([0.8, 2.78, -0.8, -2.78])))
    place = np.eye(4)
    place[:2, :2] = [[np.cos(0.7), -np.sin(0.7)], [np.sin(0.7), np.cos(0.7)]]
    place[2, 3] = 0.6
    b = place @ second.frames(second.closed(1.1, seed=1))
    order = [(a, 3, "A34"), (a, 2, "A23"), (a, 1, "both"), (b, 1, "B23"), (b, 2, "B34"), (b, 3, "ground")]
    joints: dict[str, Joint] = {}
    before = "ground"
    for k, (f, n, link) in enumerate(order):
        joints[f"J{k + 1}"] = Joint("revolute", before, link, f[n, :3, 3], (f[n, :3, 2],))
        before = link
    source = "K. J. Waldron, Hybrid overconstrained linkages, Journal of Mechanisms 3 (1968) 73-78"
    return Classic("Waldron hybrid 6R", source, joints, drives=("J1",), moves=8.0)


# planar linkages in space


def flat(
    pins: dict[str, tuple[str, str, float, float]], kind: str = "revolute", **more: Any
) -> dict[str, Joint]:
    """Parallel axes through points of one plane, which lies askew."""
    r, at = skew(50), np.array([0.3, -0.2, 0.5])
    return {
        name: Joint(kind, i, j, at + r @ [x, y, 0.0], (r[:, 2],), **more)
        for name, (i, j, x, y) in pins.items()
    }


FOUR_BAR = {
    "O2": ("ground", "crank", 0.0, 0.0), "A": ("crank", "coupler", 0.1, 0.2), "B": ("coupler", "rocker", 0.5, 0.45),
    "O4": ("rocker", "ground", 0.4, -0.05),
}  # fmt: skip
STEPHENSON = FOUR_BAR | {
    "P": ("coupler", "rod", 0.3, 0.6), "E": ("rod", "output", 0.6, 0.8), "O6": ("output", "ground", 0.8, 0.4),
}  # fmt: skip


def _cranks(third: tuple[float, float]) -> dict[str, tuple[str, str, float, float]]:
    """Three cranks of a coupler; with the third like the others, a doubled parallelogram."""
    foot = {"O1": (0.0, 0.0), "O2": (1.0, 0.1), "O3": (1.7, -0.1)}
    tips = {"O1": (0.2, 0.5), "O2": (0.2, 0.5), "O3": third}
    pins = {}
    for k, (name, (x, y)) in enumerate(foot.items(), 1):
        pins[name] = ("ground", f"crank{k}", x, y)
        pins[f"A{k}"] = (f"crank{k}", "coupler", x + tips[name][0], y + tips[name][1])
    return pins


ROBERVAL = {
    "O1": ("ground", "upper", 0.0, 0.0), "L1": ("upper", "left", -0.6, 0.15), "R1": ("upper", "right", 0.8, -0.2),
    "O2": ("ground", "lower", 0.0, -0.5), "L2": ("lower", "left", -0.6, -0.35), "R2": ("lower", "right", 0.8, -0.7),
}  # fmt: skip


def planar() -> list[Classic]:
    planar_loop = HUNT + ": 3 constraints of each planar loop are redundant in space"
    return [
        Classic("planar four-bar", planar_loop, flat(FOUR_BAR), drives=("O2",)),
        Classic("Stephenson III", planar_loop, flat(STEPHENSON), drives=("O2",)),
        Classic("parallelogram with a third crank", HUNT, flat(_cranks((0.2, 0.5))), drives=("O1",)),
        Classic("three unlike cranks", "a structure, by the count of the plane", flat(_cranks((0.25, 0.4))), 0),
        Classic("Roberval balance", "G. P. de Roberval (1669); " + HUNT, flat(ROBERVAL), drives=("O1",)),
        Classic(
            "four parallel screws of equal lead",
            "E. Delassus, Les chaines articulees fermees et deformables a quatre membres, Bull. Sci. Math. 46 (1922) "
            "283-304",
            flat(FOUR_BAR, "screw", lead=0.1), drives=("O2",),
        ),
    ]  # fmt: skip


# shafts


def _cardan(coupled: bool, phase: float) -> dict[str, Joint]:
    """Parallel shafts and a middle shaft with two universal joints; `phase` turns its second fork, degrees."""
    x, o2 = np.array([1.0, 0.0, 0.0]), np.array([1.0, 0.5, 0.2])
    u = o2 / np.linalg.norm(o2)
    p1 = np.array([0.0, np.cos(0.5), np.sin(0.5)])
    p2 = np.cross(u, p1) / np.linalg.norm(np.cross(u, p1))
    p3 = np.cos(radians(phase)) * p2 + np.sin(radians(phase)) * np.cross(u, p2)
    joints = {
        "O1": Joint("revolute", "ground", "input", (-0.4, 0.0, 0.0), (x,)),
        "U1": Joint("universal", "input", "middle", (0.0, 0.0, 0.0), (p1, p2)),
        "U2": Joint("universal", "middle", "output", o2, (p3, np.cross(x, p3))),
        "O2": Joint("revolute", "ground", "output", o2 + 0.4 * x, (x,)),
    }
    if coupled:
        pin = np.array([-0.2, 0.1, 0.3])
        joints["A"] = Joint("revolute", "input", "rod", pin, (x,))
        joints["B"] = Joint("revolute", "rod", "output", pin + o2 + 0.4 * x, (x,))
    return joints


def shafts() -> list[Classic]:
    x, n2 = np.array([1.0, 0.0, 0.0]), np.array([0.8, 0.48, 0.36])
    p1 = np.array([0.0, np.cos(0.5), np.sin(0.5)])
    hooke = {
        "O1": Joint("revolute", "ground", "input", (-0.4, 0.0, 0.0), (x,)),
        "U": Joint("universal", "input", "output", (0.0, 0.0, 0.0), (p1, np.cross(n2, p1))),
        "O2": Joint("revolute", "ground", "output", 0.5 * n2, (n2,)),
    }
    y, z = np.array([0.0, 0.6, 0.8]), np.array([0.0, -0.8, 0.6])
    oldham = {
        "O1": Joint("revolute", "ground", "input", (-0.2, 0.0, 0.0), (x,)),
        "P1": Joint("prismatic", "input", "disk", (0.0, 0.1, 0.0), (y,)),
        "P2": Joint("prismatic", "disk", "output", (0.1, 0.0, 0.1), (z,)),
        "O2": Joint("revolute", "ground", "output", (0.3, 0.1, 0.05), (x,)),
    }
    radial = [np.array([np.cos(t), 0.9 * np.sin(t), 0.4 * np.sin(2 * t + 1)]) for t in (0.1, 1.1, 2.6, 4.0)]
    names = ["ground", "link2", "link3", "link4", "ground"]
    spherical = {
        f"J{k + 1}": Joint("revolute", names[k], names[k + 1], 0.4 * u, (u,)) for k, u in enumerate(radial)
    }
    return [
        Classic("spherical 4R", HUNT, spherical, drives=("J1",)),
        Classic("Hooke joint between two bearings", HUNT, hooke, drives=("O1",)),
        Classic("double Cardan shaft", "J. E. Baker, The double Hooke joint linkage; " + HUNT, _cardan(False, 40.0),
                drives=("O1",)),
        Classic("Cardan shaft and coupling rod, right phase", "equal speeds: " + HUNT, _cardan(True, 0.0),
                drives=("O1",)),
        Classic("Cardan shaft and coupling rod, wrong phase", "unequal speeds: a structure", _cardan(True, 60.0), 0),
        Classic("Oldham coupling", HUNT, oldham, drives=("O1",)),
    ]  # fmt: skip


# slides, hybrid chains and platforms


def _sarrus() -> dict[str, Joint]:
    x, y = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
    return {
        "A1": Joint("revolute", "ground", "lower1", (0.0, -1.0, 0.0), (x,)),
        "A2": Joint("revolute", "lower1", "upper1", (0.0, -1.5, 0.7), (x,)),
        "A3": Joint("revolute", "upper1", "top", (0.0, -0.8, 1.5), (x,)),
        "B1": Joint("revolute", "ground", "lower2", (1.0, 0.0, 0.0), (y,)),
        "B2": Joint("revolute", "lower2", "upper2", (1.6, 0.0, 0.8), (y,)),
        "B3": Joint("revolute", "upper2", "top", (0.9, 0.0, 1.5), (y,)),
    }


def _wedges() -> dict[str, Joint]:
    r = skew(51)
    along = [r @ [np.cos(t), np.sin(t), 0.0] for t in (0.0, 0.4, 1.7)]
    return {
        "P1": Joint("prismatic", "ground", "wedge", (0.1, 0.0, 0.0), (along[0],)),
        "P2": Joint("prismatic", "wedge", "follower", (0.2, 0.1, 0.1), (along[1],)),
        "P3": Joint("prismatic", "ground", "follower", (0.2, 0.3, 0.0), (along[2],)),
    }


def _press() -> dict[str, Joint]:
    z = skew(52)[:, 2]
    return {
        "R": Joint("revolute", "ground", "spindle", (0.0, 0.0, 0.0), (z,)),
        "H": Joint("screw", "spindle", "ram", 0.3 * z, (z,), 0.02),
        "P": Joint("prismatic", "ground", "ram", 0.5 * z, (z,)),
    }


def _tripteron() -> dict[str, Joint]:
    """Three legs P R R R, all axes of a leg parallel to its slide; the slides are at right angles."""
    joints, e, top = {}, np.eye(3), np.array([0.6, 0.5, 0.7])
    for k, name in enumerate("XYZ"):
        u, v, w = e[k], e[(k + 1) % 3], e[(k + 2) % 3]
        start = top[k] * u - 0.2 * v + 0.1 * w
        knee, tip = start + 0.5 * w + 0.1 * k * v + 0.05 * u, top + 0.1 * v + 0.05 * w
        joints[f"P{name}"] = Joint("prismatic", "ground", f"slide{name}", start - 0.3 * w, (u,))
        joints[f"A{name}"] = Joint("revolute", f"slide{name}", f"lower{name}", start, (u,))
        joints[f"B{name}"] = Joint("revolute", f"lower{name}", f"upper{name}", knee, (u,))
        joints[f"C{name}"] = Joint("revolute", f"upper{name}", "platform", tip, (u,))
    return joints


def _spherical_platform() -> dict[str, Joint]:
    """Three legs R R R whose nine axes all meet in the origin."""
    rng = np.random.default_rng(60)
    joints = {}
    for name in "123":
        links = ["ground", f"lower{name}", f"upper{name}", "platform"]
        for k, axis in enumerate(rng.normal(size=(3, 3))):
            joints["ABC"[k] + name] = Joint("revolute", links[k], links[k + 1], 0.3 * axis, (axis,))
    return joints


def others() -> list[Classic]:
    return [
        Classic("Sarrus 6R", "P. F. Sarrus, Note sur la transformation des mouvements rectilignes alternatifs, Comptes "
                "Rendus 36 (1853) 1036-1038", _sarrus(), drives=("A1",)),
        Classic("wedges 3P", HUNT, _wedges(), drives=("P1",), moves=0.1),
        Classic("screw press R H P", HUNT, _press(), drives=("R",)),
        Classic("Tripteron 3-PRRR", "C. Gosselin and X. Kong, Cartesian parallel manipulators (2004); " + GOGU,
                _tripteron(), 3, ("PX", "PY", "PZ"), 0.05),
        Classic("spherical platform 3-RRR", "C. Gosselin and J.-F. Hamel, The agile eye, IEEE ICRA (1994) 781-786",
                _spherical_platform(), 3, ("A1", "A2", "A3"), 5.0),
    ]  # fmt: skip


CLASSICS: dict[str, Classic] = {c.name: c for c in (*loops(), *planar(), *shafts(), *others())}
