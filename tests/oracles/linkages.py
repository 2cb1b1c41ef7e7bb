"""Four-bar, slider-crank and what grows from them: trees beside their closed forms."""

from __future__ import annotations

from math import radians

from tests.oracles.jets import Jet, Pose, at, circles, heading, line_circle
from tests.oracles.parts import (
    Example,
    couple,
    damper,
    force,
    gear,
    ground,
    link,
    pin,
    slider,
    sliding,
    slot,
    spring,
    tree,
    turning,
)  # fmt: skip

COUNT = 24


def four_bar() -> Example:
    links = {
        "ground": ground(O2=(0, 0), O4=(0.40, 0.05), G=(0.1, -0.2)),
        "crank": link(1.2, (0.04, 0.02), 0.003, O2=(0, 0), A=(0.12, 0)),
        "coupler": link(2.1, (0.2, 0.06), 0.02, A=(0, 0), B=(0.38, 0), P=(0.25, 0.15)),
        "rocker": link(1.7, (0.1, -0.03), 0.011, O4=(0, 0), B=(0.25, 0)),
    }
    joints = {
        "O2": pin("ground", "crank"),
        "A": pin("crank", "coupler", damping="0.2 N*m*s/rad"),
        "B": pin("rocker", "coupler"),
        "O4": pin("ground", "rocker"),
    }
    loads = {
        "F": force("coupler", "P", [120.0, -75.0]),
        "H": force("rocker", [0.1, 0.05], "60 @ 20", axes="link"),
        "T": couple("rocker", -14.0),
        "S": spring("ground.G", "coupler.P", 900.0, 0.2),
        "R": {"type": "torsion_spring", "joint": "O4", "stiffness": "12 N*m/rad", "free_angle": 70.0},
    }
    made = tree(links, joints, {"O2": turning(10.0, 370.0, COUNT, 18.0, -40.0)}, loads)

    def kinematics(t: Jet) -> dict[str, Pose]:
        crank = (0.0, 0.0, t)
        a, o4 = at(crank, 0.12, 0), (0.40, 0.05)
        b = circles(a, 0.38, o4, 0.25, 1)
        return {"crank": crank, "coupler": (*a, heading(a, b)), "rocker": (*o4, heading(o4, b))}

    return Example("four_bar", made, kinematics)


def slider_crank() -> Example:
    links = {
        "ground": ground(O=(0, 0), S=(0.02, 0.035)),
        "crank": link(0.9, (0.01, 0.0), 0.002, O=(0, 0), A=(0.08, 0)),
        "rod": link(0.8, (0.09, 0.004), 0.004, A=(0, 0), B=(0.27, 0)),
        "piston": link(1.5, (0.01, 0.005), 0.001, B=(0, 0), F=(0.03, 0.01)),
    }
    joints = {
        "O": pin("crank", "ground"),
        "A": pin("crank", "rod"),
        "B": pin("rod", "piston"),
        "S": slider("ground", "piston", 15.0, at=["S", "B"], angle=20.0, damping=8.0),
    }
    loads = {"gas": force("piston", "F", 800.0, direction=190.0), "D": damper("ground.S", "rod.B", 15.0)}
    made = tree(links, joints, {"O": turning(0.0, -360.0, COUNT, -60.0, 100.0)}, loads, [0.5, -9.6])

    def kinematics(t: Jet) -> dict[str, Pose]:
        crank = (0.0, 0.0, -t)
        a = at(crank, 0.08, 0)
        b = line_circle(a, 0.27, (0.02, 0.035), 15.0, 1)
        return {"crank": crank, "rod": (*a, heading(a, b)), "piston": (*b, radians(35.0))}

    return Example("slider_crank", made, kinematics)


def watt() -> Example:
    links = {
        "ground": ground(O2=(0, 0), O4=(0.3, 0.0), O6=(0.55, 0.05)),
        "crank": link(0.5, (0.03, 0.0), 0.001, O2=(0, 0), A=(0.08, 0)),
        "coupler": link(1.0, (0.15, 0.02), 0.01, A=(0, 0), B=(0.3, 0)),
        "rocker": link(1.5, (0.1, 0.02), 0.015, O4=(0, 0), B=(0.2, 0), D=(0.15, -0.12)),
        "rod": link(0.6, (0.1, 0.0), 0.004, D=(0, 0), E=(0.26, 0)),
        "output": link(1.1, (0.07, 0.01), 0.006, O6=(0, 0), E=(0.2, 0)),
    }
    joints = {
        "O2": pin("ground", "crank"), "A": pin("crank", "coupler"), "B": pin("coupler", "rocker"),
        "O4": pin("rocker", "ground"), "D": pin("rocker", "rod"), "E": pin("rod", "output"),
        "O6": pin("ground", "output"),
    }  # fmt: skip
    loads = {"T": couple("output", 9.0), "F": force("rod", [0.05, 0.02], [30.0, -80.0])}
    made = tree(links, joints, {"O2": turning(0.0, 360.0, COUNT, 12.0, 30.0)}, loads)

    def kinematics(t: Jet) -> dict[str, Pose]:
        crank = (0.0, 0.0, t)
        a, o4, o6 = at(crank, 0.08, 0), (0.3, 0.0), (0.55, 0.05)
        b = circles(a, 0.3, o4, 0.2, 1)
        rocker = (*o4, heading(o4, b))
        d = at(rocker, 0.15, -0.12)
        e = circles(d, 0.26, o6, 0.2, 1)
        return {
            "crank": crank, "coupler": (*a, heading(a, b)), "rocker": rocker,
            "rod": (*d, heading(d, e)), "output": (*o6, heading(o6, e)),
        }  # fmt: skip

    return Example("watt", made, kinematics)


def stephenson3() -> Example:
    links = {
        "ground": ground(O2=(0, 0), O4=(0.3, 0.0), O6=(0.1, 0.5)),
        "crank": link(0.5, (0.03, 0.0), 0.001, O2=(0, 0), A=(0.08, 0)),
        "coupler": link(1.0, (0.15, 0.05), 0.01, A=(0, 0), B=(0.3, 0), P=(0.18, 0.15)),
        "rocker": link(0.9, (0.1, 0.0), 0.006, O4=(0, 0), B=(0.2, 0)),
        "rod": link(0.6, (0.1, 0.0), 0.004, P=(0, 0), E=(0.25, 0)),
        "output": link(1.1, (0.07, 0.01), 0.006, O6=(0, 0), E=(0.22, 0)),
    }
    joints = {
        "O2": pin("ground", "crank"), "A": pin("crank", "coupler"), "B": pin("coupler", "rocker"),
        "O4": pin("ground", "rocker"), "P": pin("coupler", "rod"), "E": pin("output", "rod"),
        "O6": pin("ground", "output"),
    }  # fmt: skip
    loads = {
        "T": couple("output", 7.0),
        "D": {"type": "torsion_damper", "joint": "O6", "damping": "0.8 N*m*s/rad"},
    }
    made = tree(links, joints, {"O2": turning(0.0, 360.0, COUNT, -14.0, 0.0)}, loads)

    def kinematics(t: Jet) -> dict[str, Pose]:
        crank = (0.0, 0.0, t)
        a, o4, o6 = at(crank, 0.08, 0), (0.3, 0.0), (0.1, 0.5)
        b = circles(a, 0.3, o4, 0.2, 1)
        coupler = (*a, heading(a, b))
        p = at(coupler, 0.18, 0.15)
        e = circles(p, 0.25, o6, 0.22, -1)
        return {
            "crank": crank, "coupler": coupler, "rocker": (*o4, heading(o4, b)),
            "rod": (*p, heading(p, e)), "output": (*o6, heading(o6, e)),
        }  # fmt: skip

    return Example("stephenson3", made, kinematics)


def five_bar(geared: bool = False) -> Example:
    """Two drives; geared, the second crank's drive is replaced by a mesh 2 : 1."""
    links = {
        "ground": ground(O1=(0, 0), O5=(0.24, 0.0)),
        "left": link(0.7, (0.04, 0.01), 0.001, O1=(0, 0), A=(0.07, 0)),
        "first": link(1.0, (0.1, 0.02), 0.005, A=(0, 0), C=(0.22, 0)),
        "second": link(0.9, (0.1, -0.02), 0.004, B=(0, 0), C=(0.24, 0)),
        "right": link(0.6, (0.03, 0.0), 0.001, O5=(0, 0), B=(0.06, 0)),
    }
    joints = {
        "O1": pin("ground", "left"), "A": pin("left", "first"), "C": pin("first", "second"),
        "B": pin("right", "second"), "O5": pin("ground", "right"),
    }  # fmt: skip
    drives = {"O1": turning(20.0, 380.0, COUNT, 10.0, 15.0), "O5": turning(100.0, 220.0, COUNT, 7.0, -20.0)}
    loads = {"F": force("first", "C", "90 @ 250"), "S": spring("ground.O1", "second.C", 400.0, 0.1)}
    if geared:
        joints["G"] = gear("left", "right", (0.16, 0.08), at=["O1", "O5"])
        del drives["O5"]
    made = tree(links, joints, drives, loads)

    def kinematics(t1: Jet, t5: Jet | None = None) -> dict[str, Pose]:
        left, right = (
            (0.0, 0.0, t1),
            (0.24, 0.0, radians(60.0) - 2.0 * (t1 - radians(20.0)) if t5 is None else t5),
        )
        a, b = at(left, 0.07, 0), at(right, 0.06, 0)
        c = circles(a, 0.22, b, 0.24, 1)
        return {"left": left, "first": (*a, heading(a, c)), "second": (*b, heading(b, c)), "right": right}

    return Example("geared_five_bar" if geared else "five_bar", made, kinematics)


def bucket() -> Example:
    """Boom and bucket, each moved by a hydraulic cylinder."""
    links = {
        "ground": ground(O=(0, 0), P=(0.4, -0.6)),
        "boom": link(150.0, (1.2, 0.2), 90.0, O=(0, 0), C=(1.1, 0.1), E=(1.5, 0.45), K=(2.6, 0)),
        "barrel": link(20.0, (0.3, 0), 2.0, P=(0, 0), B=(0.2, 0)),
        "rod": link(12.0, (-0.3, 0.0), 1.0, C=(0, 0)),
        "bucket": link(80.0, (0.3, 0.25), 12.0, K=(0, 0), F=(-0.15, 0.3), T=(0.6, 0.3)),
        "barrel2": link(9.0, (0.2, 0), 0.5, E=(0, 0), B=(0.1, 0)),
        "rod2": link(6.0, (-0.2, 0.01), 0.3, F=(0, 0)),
    }
    joints = {
        "O": pin("ground", "boom"), "P": pin("ground", "barrel"), "C": pin("boom", "rod"), "K": pin("boom", "bucket"),
        "lift": slider("barrel", "rod", 0.0, at=["P", "C"]), "E": pin("boom", "barrel2"), "F": pin("bucket", "rod2"),
        "tilt": slider("barrel2", "rod2", 0.0, at=["E", "F"]),
    }  # fmt: skip
    drives = {"lift": sliding(0.85, 1.25, COUNT, 0.3, -0.5), "tilt": sliding(0.92, 1.3, COUNT, -0.2, 0.4)}
    made = tree(links, joints, drives, {"dig": force("bucket", "T", [-4000.0, 2500.0], axes="link")})

    def kinematics(lift: Jet, tilt: Jet) -> dict[str, Pose]:
        o, p = (0.0, 0.0), (0.4, -0.6)
        c = circles(o, (1.1**2 + 0.1**2) ** 0.5, p, lift, 1)
        boom = (*o, heading(o, c) - heading(o, (1.1, 0.1)))
        e, k = at(boom, 1.5, 0.45), at(boom, 2.6, 0)
        f = circles(k, (0.15**2 + 0.3**2) ** 0.5, e, tilt, -1)
        bucket = (*k, heading(k, f) - heading((0, 0), (-0.15, 0.3)))
        barrel, barrel2 = heading(p, c), heading(e, f)
        return {
            "boom": boom, "barrel": (*p, barrel), "rod": (*c, barrel),
            "bucket": bucket, "barrel2": (*e, barrel2), "rod2": (*f, barrel2),
        }  # fmt: skip

    return Example("bucket", made, kinematics)


def slotted_rod() -> Example:
    """A crank's rod whose end runs in an inclined slot of the frame."""
    links = {
        "ground": ground(O=(0, 0), S=(0.1, -0.02)),
        "crank": link(0.4, (0.02, 0.01), 0.001, O=(0, 0), A=(0.06, 0)),
        "rod": link(0.9, (0.12, 0.02), 0.006, A=(0, 0), B=(0.21, 0), T=(0.3, 0.05)),
    }
    joints = {
        "O": pin("ground", "crank"), "A": pin("rod", "crank"),
        "B": slot("ground", "rod", -10.0, at=["S", "B"], damping={"slide": 5.0}),
    }  # fmt: skip
    made = tree(
        links, joints, {"O": turning(0.0, 360.0, COUNT, 20.0, 0.0)}, {"F": force("rod", "T", [50.0, 40.0])}
    )

    def kinematics(t: Jet) -> dict[str, Pose]:
        crank = (0.0, 0.0, t)
        a = at(crank, 0.06, 0)
        return {"crank": crank, "rod": (*a, heading(a, line_circle(a, 0.21, (0.1, -0.02), -10.0, 1)))}

    return Example("slotted_rod", made, kinematics)
