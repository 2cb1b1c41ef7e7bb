"""Random belts, belts with idlers, and tackles."""

from __future__ import annotations

import math

import numpy as np

from tests.elements.written_machines import G, Machine, Written, couple, force, pin, wheel


def belt(seed: int, w: Written) -> Machine:
    """Open or crossed, by one of four pulls, between fixed axes or to a wheel on a cart."""
    rng = np.random.default_rng(seed)
    r1, r2 = rng.uniform(0.03, 0.2, 2)
    distance, angle = (r1 + r2) * rng.uniform(1.3, 4), rng.uniform(-math.pi, math.pi)
    pull = ("tension", "tensioner", "tight", "slack")[seed % 4]
    away = [distance * math.cos(angle), distance * math.sin(angle)]
    joint = {
        "type": "belt",
        "links": ["small", "big"],
        "at": ["A", "B"],
        "radii": [w.by(r1, 0, 1), w.by(r2, 0, 1)],
        "crossed": bool(seed % 2),
        pull: w.by(rng.uniform(3000, 5000), 1, 1),
        "mass_per_length": w.by(rng.uniform(0, 0.5), 1, -1),
        "friction": {"coefficient": rng.uniform(0.2, 0.6)},
    }
    moves = seed % 3 == 0
    tree = {
        "gravity": w.at(G),
        "links": {
            "ground": {"points": {"A": [0, 0], "B": w.at(away)}},
            "small": wheel(w, "A", rng),
            "big": wheel(w, "B", rng),
        },
        "joints": {
            "A": pin("ground", "small"),
            "B": pin("cart" if moves else "ground", "big"),
            "belt": joint,
        },
        "drives": {"A": w.spins(0.4, rng.uniform(5, 30), rng.uniform(-40, 40))},
        "loads": {"work": couple(w, "big", rng.uniform(-10, 10))},
    }
    if moves:
        tree["links"]["cart"] = {"points": {"B": [0, 0]}, "mass": w.by(3, 1)}
        slide = {"type": "slider", "links": ["ground", "cart"], "at": ["B", "B"]}
        tree["joints"]["slide"] = slide | {"direction": w.turn(angle + rng.uniform(-1.4, 1.4))}
        tree["drives"]["slide"] = w.slides(0.0, 0.3, 0.4)
    return tree, ["joints.belt.radii.1", f"joints.belt.{pull}", "links.big.inertia"]


def idler(seed: int, w: Written) -> Machine:
    """A weight presses an idler on the belt; another wheel takes torque."""
    rng = np.random.default_rng(seed)
    lever, weight = rng.uniform(0.25, 0.35), rng.uniform(150, 400)
    wheels = [
        {
            "at": "arm.I",
            "radius": w.by(rng.uniform(0.015, 0.035), 0, 1),
            "strand": w.side("left"),
            "efficiency": rng.uniform(0.9, 0.97),
        },
        {
            "at": "pump.D",
            "radius": w.by(rng.uniform(0.03, 0.06), 0, 1),
            "strand": w.side("right"),
            "side": "inside",
        },
    ]
    joint = {
        "type": "belt",
        "links": ["motor", "fan"],
        "at": ["A", "B"],
        "idlers": wheels,
        "friction": {"coefficient": 1.5},
    }
    ground = {"A": (0, 0), "B": (0.5, 0), "L": (0.15, 0.24), "D": (0.26, -0.15)}
    arm = {"L": (0, 0), "I": (0.1, -0.17), "W": (lever, 0)}
    tree = {
        "gravity": "none",
        "links": {
            "ground": {"points": {n: w.at(p) for n, p in ground.items()}},
            "arm": {"points": {n: w.at(p) for n, p in arm.items()}},
            "motor": wheel(w, "A", rng),
            "fan": wheel(w, "B", rng),
            "pump": wheel(w, "D", rng),
        },
        "joints": {
            "A": pin("ground", "motor"),
            "B": pin("ground", "fan"),
            "D": pin("ground", "pump"),
            "L": pin("ground", "arm"),
            "belt": joint | {"radii": [w.by(r, 0, 1) for r in rng.uniform((0.04, 0.06), (0.09, 0.14))]},
        },
        "drives": {"A": w.spins(0.0, rng.choice([-20, 20]), rng.uniform(-5, 5))},
        "loads": {
            "fan": couple(w, "fan", rng.uniform(-4, 4)),
            "pump": couple(w, "pump", rng.uniform(-2, 2)),
            "weight": force(w, "arm", "W", (0, -weight)),
        },
        "assembly": {"arm": w.turn(rng.uniform(-0.15, 0.15))},
    }
    return tree, ["loads.fan.value", "joints.belt.idlers.1.radius", "links.fan.inertia"]


def tackle(seed: int, w: Written) -> Machine:
    """A block on two to five strands below a beam; sheaves that lose power, or rubbed ones that do not turn."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 5))
    beam, block, through = {"P": (-1.0, -1.0), "E": (float(count), 0.0)}, {}, []
    rubs = {"friction": {"coefficient": rng.uniform(0.02, 0.2)}} if seed % 3 == 1 else {}
    for k in range(count):
        beam[f"U{k}"], block[f"B{k}"] = (float(k), rng.uniform(-0.1, 0.1)), (k + 0.5, rng.uniform(-0.1, 0.1))
        for point, side in ((f"ground.U{k}", "left"), (f"block.B{k}", "right")):
            through.append(
                {"round": point, "radius": w.by(rng.uniform(0.05, 0.2), 0, 1), "side": w.side(side)} | rubs
            )
    rope = {"type": "rope", "through": ["hand.h", *through, "ground.E"]}
    rope |= {"efficiency": rng.uniform(0.85, 0.99)} if seed % 3 == 2 else {}
    slide = {"type": "slider", "direction": w.turn(-math.pi / 2), "angle": w.turn(math.pi / 2)}
    mass = {"mass": w.by(rng.uniform(100, 900), 1), "center": w.at((1, -0.3))}
    tree = {
        "gravity": w.at(G),
        "links": {
            "ground": {"points": {n: w.at(p) for n, p in beam.items()}},
            "block": {"points": {n: w.at(p) for n, p in block.items()}} | mass,
            "hand": {"points": {"h": [0, 0]}},
        },
        "joints": {
            "lift": slide | {"links": ["ground", "block"], "at": ["U0", "B0"]},
            "pull": slide | {"links": ["ground", "hand"], "at": ["P", "h"]},
            "rope": rope,
        },
        "drives": {"pull": w.slides(0.1, float(rng.choice([-0.5, 0.5])), rng.uniform(-1, 1))},
        "assembly": {"block": [*w.at((0.5, -2.0)), 0]},
    }
    return tree, ["links.block.mass", "joints.rope.through.1.radius"]
