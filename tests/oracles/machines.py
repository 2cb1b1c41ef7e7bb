"""Slides, slots, wheels and long chains: trees beside their closed forms."""

from __future__ import annotations

from math import pi, radians

from tests.oracles.jets import Jet, Pose, at, atan2, cos, heading, jet, line_circle, sin, sqrt
from tests.oracles.linkages import COUNT
from tests.oracles.parts import (
    Example,
    couple,
    force,
    gear,
    ground,
    link,
    pin,
    slider,
    slot,
    spring,
    tree,
    turning,
)  # fmt: skip


def inverted_slider_crank() -> Example:
    """The block on the crank pin slides on a rocking lever, its line 0.02 m beside the pivot."""
    links = {
        "ground": ground(O2=(0, 0), O4=(-0.1, -0.3)),
        "crank": link(0.8, (0.05, 0.0), 0.002, O2=(0, 0), A=(0.12, 0)),
        "block": link(0.3, (0.005, 0.01), 0.0004, A=(0, 0)),
        "lever": link(1.9, (0.2, 0.03), 0.03, O4=(0, 0), L=(0, 0.02), T=(0.5, 0)),
    }
    joints = {
        "O2": pin("ground", "crank"), "A": pin("crank", "block"), "O4": pin("ground", "lever"),
        "L": slider("lever", "block", 0.0, at=["L", "A"], angle=30.0),
    }  # fmt: skip
    loads = {"F": force("lever", "T", "150 @ 90", axes="link"), "T": couple("block", 2.0)}
    made = tree(links, joints, {"O2": turning(0.0, 360.0, COUNT, 9.0, 20.0)}, loads)

    def kinematics(t: Jet) -> dict[str, Pose]:
        crank, o4 = (0.0, 0.0, t), (-0.1, -0.3)
        a = at(crank, 0.12, 0)
        dx, dy = a[0] - o4[0], a[1] - o4[1]
        lever = atan2(dy, dx) - atan2(jet(0.02), sqrt(dx * dx + dy * dy - 0.02**2))
        return {"crank": crank, "block": (*a, lever + radians(30.0)), "lever": (*o4, lever)}

    return Example("inverted_slider_crank", made, kinematics)


def scotch_yoke() -> Example:
    links = {
        "ground": ground(O=(0, 0), S=(0.3, 0.1)),
        "crank": link(0.7, (0.03, 0.0), 0.001, O=(0, 0), A=(0.1, 0)),
        "yoke": link(2.0, (0.1, 0.02), 0.01, Y=(0, 0), R=(0.3, 0.1)),
    }
    joints = {
        "O": pin("ground", "crank"), "A": slot("yoke", "crank", 90.0, at=["Y", "A"]),
        "S": slider("ground", "yoke", 0.0, at=["S", "R"]),
    }  # fmt: skip
    loads = {"F": force("yoke", "R", [-200.0, 30.0]), "K": spring("ground.S", "crank.A", 300.0, 0.05)}
    made = tree(links, joints, {"O": turning(5.0, 365.0, COUNT, 30.0, 0.0)}, loads)

    def kinematics(t: Jet) -> dict[str, Pose]:
        return {"crank": (0.0, 0.0, t), "yoke": (0.1 * cos(t), 0.0, 0.0)}

    return Example("scotch_yoke", made, kinematics)


def shaper() -> Example:
    """Crank-shaper: the crank pin drives a slotted lever, whose end draws the ram."""
    links = {
        "ground": ground(O2=(0, 0), O4=(0, -0.4), S=(0, 0.45)),
        "crank": link(2.0, (0.05, 0.02), 0.02, O2=(0, 0), A=(0.15, 0)),
        "lever": link(4.0, (0.4, 0.01), 0.3, O4=(0, 0), B=(0.8, 0)),
        "rod": link(1.0, (0.1, 0.0), 0.01, B=(0, 0), C=(0.3, 0)),
        "ram": link(9.0, (0.1, 0.05), 0.1, C=(0, 0), T=(-0.3, 0.05)),
    }
    joints = {
        "O2": pin("ground", "crank"), "A": slot("lever", "crank", 0.0, at=["O4", "A"]), "O4": pin("ground", "lever"),
        "B": pin("lever", "rod"), "C": pin("rod", "ram"),
        "S": slider("ground", "ram", 180.0, at=["S", "C"], angle=-180.0),
    }  # fmt: skip
    loads = {"cut": force("ram", "T", [1200.0, -200.0])}
    made = tree(links, joints, {"O2": turning(0.0, 360.0, COUNT, 6.0, 5.0)}, loads)

    def kinematics(t: Jet) -> dict[str, Pose]:
        crank, o4 = (0.0, 0.0, t), (0.0, -0.4)
        lever = (*o4, heading(o4, at(crank, 0.15, 0)))
        b = at(lever, 0.8, 0)
        c = line_circle(b, 0.3, (0.0, 0.45), 180.0, 1)
        return {"crank": crank, "lever": lever, "rod": (*b, heading(b, c)), "ram": (*c, 0.0)}

    return Example("shaper", made, kinematics)


def planetary() -> Example:
    """Sun and carrier driven; the planet meshes with the sun outside and with the ring inside."""
    links = {
        "ground": ground(O=(0, 0)),
        "sun": link(1.0, (0.002, 0.0), 0.002, O=(0, 0)),
        "carrier": link(2.0, (0.03, 0.01), 0.01, O=(0, 0), K=(0.09, 0)),
        "planet": link(0.5, (0.0, 0.003), 0.0004, K=(0, 0)),
        "ring": link(3.0, (0.0, -0.004), 0.05, O=(0, 0)),
    }
    joints = {
        "O": pin("ground", "sun"), "C": pin("ground", "carrier", at="O"), "K": pin("carrier", "planet"),
        "R": pin("ground", "ring", at="O"), "in": gear("sun", "planet", (0.06, 0.03), at=["O", "K"]),
        "out": gear("planet", "ring", (0.03, 0.12), at=["K", "O"], internal=True, pressure_angle=25.0),
    }  # fmt: skip
    drives = {"O": turning(0.0, 720.0, COUNT, 40.0, 100.0), "C": turning(0.0, 360.0, COUNT, -15.0, 60.0)}
    loads = {"T": couple("ring", 33.0), "F": force("planet", "K", [20.0, 10.0])}
    made = tree(links, joints, drives, loads)

    def kinematics(sun: Jet, carrier: Jet) -> dict[str, Pose]:
        planet = 3.0 * carrier - 2.0 * sun
        ring = 1.5 * carrier - 0.5 * sun
        return {
            "sun": (0.0, 0.0, sun), "carrier": (0.0, 0.0, carrier),
            "planet": (*at((0.0, 0.0, carrier), 0.09, 0), planet), "ring": (0.0, 0.0, ring),
        }  # fmt: skip

    return Example("planetary", made, kinematics)


def rolling_wheel() -> Example:
    """A crank pulls a wheel along an inclined rail by a rod."""
    links = {
        "ground": ground(O=(0, 0), S=(0.2, -0.1)),
        "crank": link(0.5, (0.02, 0.0), 0.001, O=(0, 0), A=(0.07, 0)),
        "rod": link(0.7, (0.1, 0.01), 0.004, A=(0, 0), W=(0.3, 0)),
        "wheel": link(4.0, (0.005, 0.0), 0.01, W=(0, 0)),
    }
    joints = {
        "O": pin("ground", "crank"), "A": pin("crank", "rod"), "W": pin("rod", "wheel"),
        "R": {"type": "rolling", "links": ["ground", "wheel"], "at": ["S", "W"], "direction": 5.0, "radius": 0.06},
    }  # fmt: skip
    made = tree(
        links,
        joints,
        {"O": turning(0.0, 360.0, COUNT, 11.0, 9.0)},
        {"F": force("wheel", [0.02, 0.0], [30.0, -60.0])},
    )
    c, s = float(cos(jet(radians(5.0))).x), float(sin(jet(radians(5.0))).x)
    start = (0.2 - 0.06 * s, -0.1 + 0.06 * c)

    def kinematics(t: Jet) -> dict[str, Pose]:
        crank = (0.0, 0.0, t)
        a = at(crank, 0.07, 0)
        w = line_circle(a, 0.3, start, 5.0, 1)
        along = c * w[0] + s * w[1]
        return {"crank": crank, "rod": (*a, heading(a, w)), "wheel": (*w, (along.x[0] - along) / 0.06)}

    return Example("rolling_wheel", made, kinematics)


def double_pendulum() -> Example:
    links = {
        "ground": ground(O=(0.1, 0.2)),
        "upper": link(3.0, (0.2, 0.01), 0.05, O=(0, 0), K=(0.4, 0)),
        "lower": link(2.0, (0.15, -0.02), 0.03, K=(0, 0), T=(0.35, 0)),
    }
    joints = {"O": pin("ground", "upper"), "K": pin("upper", "lower")}
    drives = {"O": turning(-90.0, 270.0, COUNT, 4.0, -12.0), "K": turning(30.0, 150.0, COUNT, -6.0, 25.0)}
    loads = {"F": force("lower", "T", [10.0, -40.0]), "H": force("lower", "T", "5 @ 30", axes="link")}
    made = tree(links, joints, drives, loads)

    def kinematics(upper: Jet, knee: Jet) -> dict[str, Pose]:
        first = (0.1, 0.2, upper)
        return {"upper": first, "lower": (*at(first, 0.4, 0), upper + knee)}

    return Example("double_pendulum", made, kinematics)


def scissor(stages: int = 3, count: int = COUNT) -> Example:
    """Crossed bars of 1 m; the foot of the rising bars is driven, that of the falling ones runs in a slot."""
    links = {"ground": ground(U0=(0, 0), V0=(0, 0))}
    joints = {"U0": pin("ground", "up1"), "V0": slot("ground", "down1", 0.0)}
    for k in range(1, stages + 1):
        ends = {"left": f"U{k}", "right": f"V{k}"}
        links[f"up{k}"] = link(
            1.5, (0.5, 0.01), 0.13, **{f"U{k - 1}": (0, 0), "X": (0.5, 0), ends["right"]: (1, 0)}
        )
        links[f"down{k}"] = link(
            1.4, (0.5, 0.0), 0.12, **{f"V{k - 1}": (0, 0), "X": (0.5, 0), ends["left"]: (1, 0)}
        )
        joints[f"X{k}"] = pin(f"up{k}", f"down{k}", at="X")
        if k < stages:
            joints[f"U{k}"] = pin(f"down{k}", f"up{k + 1}")
            joints[f"V{k}"] = pin(f"up{k}", f"down{k + 1}")
    loads = {
        "P": force(f"up{stages}", f"V{stages}", [0.0, -400.0]),
        "Q": force(f"down{stages}", f"U{stages}", [20.0, -300.0]),
    }
    made = tree(links, joints, {"U0": turning(20.0, 65.0, count, 0.5, 0.2)}, loads)

    def kinematics(t: Jet) -> dict[str, Pose]:
        poses: dict[str, Pose] = {}
        for k in range(stages):
            height = float(k) * sin(t)
            poses[f"up{k + 1}"] = (0.0, height, t)
            poses[f"down{k + 1}"] = (cos(t), height, pi - t)
        return poses

    return Example(f"scissor{stages}", made, kinematics)
