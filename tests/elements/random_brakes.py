"""Random shoes, bands, faces and one-way clutches."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from tests.elements.written_machines import Machine, Written, couple, force, pin, wheel


def shoe(seed: int, w: Written) -> Machine:
    """Long or short, outside or inside, ahead of the turn or behind it."""
    rng = np.random.default_rng(seed)
    radius, internal = rng.uniform(0.05, 0.3), bool(rng.integers(2))
    far = radius * (rng.uniform(0.6, 0.95) if internal else rng.uniform(1.1, 1.6))
    line, side, begin = rng.uniform(-3, 3), int(rng.choice([-1, 1])), rng.uniform(0.1, 0.8)
    way = np.array([math.cos(line), math.sin(line)])
    off = side * np.array([-way[1], way[0]])
    pivot, tip = far * way, -1.7 * far * way + 0.3 * radius * off
    joint = {
        "type": "shoe",
        "links": ["drum", "shoe"],
        "at": ["O", "Q"],
        "radius": w.by(radius, 0, 1),
        "internal": internal,
        "width": w.by(0.04, 0, 1),
        "side": w.side("left" if side > 0 else "right"),
        "friction": {"coefficient": rng.uniform(0.05, 0.3)},
    }
    vary = ["joints.S.friction.coefficient", "loads.F.value.1"]
    if seed % 3:
        joint |= {"from": f"{begin!r} rad", "to": f"{begin + rng.uniform(0.4, 1.8)!r} rad"}
        vary = ["joints.S.friction.coefficient", "joints.S.from"]
    else:
        joint = {k: v for k, v in joint.items() if k not in ("side", "width")} | {"at": ["O", "T"]}
    push = off if internal else -off
    points = {"Q": (0, 0), "P": tip, "T": radius * (0.6 * way + 0.8 * off) - pivot}
    tree = {
        "gravity": "none",
        "links": {
            "ground": {"points": {"O": [0, 0], "Q": w.at(pivot)}},
            "drum": wheel(w, "O", rng),
            "shoe": {"points": {n: w.at(p) for n, p in points.items()}},
        },
        "joints": {"O": pin("ground", "drum"), "Q": pin("ground", "shoe"), "S": joint},
        "drives": {"O": w.spins(0.3, float(rng.choice([-5, 5])), rng.uniform(-9, 9))},
        "loads": {"F": force(w, "shoe", "P", 1000 * rng.uniform(0.5, 2) * push)},
    }
    return tree, vary


def band(seed: int, w: Written) -> Machine:
    """Plain or of blocks, wound by the tangents or by a given angle, both senses."""
    rng = np.random.default_rng(seed)
    ends = ["ground.L", "lever.B"]
    joint = {
        "type": "band",
        "links": ["drum", "lever"],
        "around": "O",
        "radius": w.by(rng.uniform(0.08, 0.14), 0, 1),
        "ends": ends[:: w.flip],
        "friction": {"coefficient": rng.uniform(0.1, 0.4)},
    }
    joint |= {"wrap": f"{rng.uniform(2, 4)!r} rad"} if seed % 3 == 1 else {}
    joint |= {"blocks": {"count": int(rng.integers(6, 14)), "angle": "12 deg"}} if seed % 3 == 2 else {}
    lever = {"L": (0, 0), "B": (rng.uniform(0.12, 0.25), 0), "P": (0.6, 0)}
    tree = {
        "gravity": "none",
        "links": {
            "ground": {"points": {"O": [0, 0], "L": w.at((-0.1, -0.3))}},
            "drum": wheel(w, "O", rng),
            "lever": {"points": {n: w.at(p) for n, p in lever.items()}},
        },
        "joints": {"O": pin("ground", "drum"), "L": pin("ground", "lever"), "S": joint},
        "drives": {"O": w.spins(0.3, float(rng.choice([-10, 10])), rng.uniform(-9, 9))},
        "loads": {"P": force(w, "lever", "P", (0, -rng.uniform(50, 200)))},
    }
    return tree, ["joints.S.friction.coefficient", "joints.S.radius"]


def faces(seed: int, w: Written) -> Machine:
    """Plates between two shafts and a cone on the ground, each pressed in one of the ways that there are."""
    rng = np.random.default_rng(seed)
    presses: tuple[dict[str, Any], ...] = (
        {"force": w.by(rng.uniform(500, 4000), 1, 1)},
        {"pressure": w.by(rng.uniform(1e5, 4e5), 1, -1)},
        {"cylinder": {"bore": w.by(0.04, 0, 1), "pressure": w.by(rng.uniform(5e5, 2e6), 1, -1)}},
        {"spring": {"stiffness": w.by(rng.uniform(2e4, 6e4), 1), "compression": w.by(0.02, 0, 1)}},
    )
    inner = rng.uniform(0.03, 0.06, 2)
    rings = [[w.by(a, 0, 1), w.by(a * rng.uniform(1.3, 2), 0, 1)] for a in inner]
    law = {"law": str(rng.choice(["wear", "pressure"])), "friction": {"coefficient": rng.uniform(0.1, 0.4)}}
    speeds = rng.permutation([4.0, -7.0, 11.0])[:2]
    tree = {
        "gravity": "none",
        "links": {"ground": {"points": {"O": [0, 0]}}, "a": wheel(w, "O", rng), "b": wheel(w, "O", rng)},
        "joints": {
            "A": pin("ground", "a", "O"),
            "B": pin("ground", "b", "O"),
            "plates": {
                "type": "disc",
                "links": ["a", "b"],
                "at": "O",
                "radii": rings[0],
                "faces": int(rng.integers(1, 5)),
            }
            | law
            | presses[seed % 4],
            "cone": {
                "type": "cone",
                "links": ["ground", "b"],
                "at": "O",
                "radii": rings[1],
                "half_angle": f"{rng.uniform(0.15, 0.5)!r} rad",
            }
            | law
            | presses[0],
        },
        "drives": {n: w.spins(0.2, s, rng.uniform(-9, 9)) for n, s in zip("AB", speeds, strict=True)},
        "loads": {"T": couple(w, "b", rng.uniform(-50, 50))},
    }
    return tree, ["joints.plates.friction.coefficient", "joints.cone.half_angle", "joints.cone.force"]


def one_way(seed: int, w: Written) -> Machine:
    """A clutch with or without rollers, or a ratchet, that holds its load or lets it run ahead, before a brake."""
    rng = np.random.default_rng(seed)
    free, sign = (("ccw", 1), ("cw", -1))[int(rng.integers(2))]
    kind = {"type": "ratchet", "teeth": int(rng.integers(8, 30))} if seed % 3 == 2 else {"type": "one_way"}
    rollers = {
        "count": 6,
        "radius": w.by(0.04, 0, 1),
        "wedge": "7 deg",
        "coefficient": rng.uniform(0.06, 0.1),
    }
    kind |= {"rollers": rollers} if seed % 3 == 1 else {}
    speed = rng.uniform(3, 20) * rng.choice([-1, 1])
    tree = {
        "gravity": "none",
        "links": {"ground": {"points": {"O": [0, 0]}}, "one": wheel(w, "O", rng), "two": wheel(w, "O", rng)},
        "joints": {
            "A": pin("ground", "one", "O"),
            "B": pin("ground", "two", "O"),
            "K": {"links": ["one", "two"], "at": "O", "free": w.side(free)} | kind,
            "pads": {
                "type": "disc",
                "links": ["ground", "two"],
                "at": "O",
                "radii": [w.by(0.05, 0, 1), w.by(0.1, 0, 1)],
                "force": w.by(rng.uniform(10, 500), 1, 1),
                "friction": {"coefficient": 0.3},
            },
        },
        "drives": {"A": w.spins(0.0, speed, rng.uniform(-30, 30))},
        "loads": {"T": couple(w, "two", -sign * rng.uniform(-10, 120))},
    }
    if seed % 4 == 3:
        tree["drives"]["B"] = w.spins(0.0, speed + sign * rng.uniform(1, 9))
    return tree, ["links.two.inertia", "joints.pads.friction.coefficient"]
