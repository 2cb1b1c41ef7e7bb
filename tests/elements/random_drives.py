"""Random cylinders, worms, bevel wheels, wedges on screws, and planetary trains."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from tests.elements.written_machines import G, Machine, Written, couple, force, pin, wheel


def cylinder(seed: int, w: Written) -> Machine:
    """A boom on a cylinder with seals that lose power or rub, with and without masses."""
    rng = np.random.default_rng(seed)
    foot, head = (
        (rng.uniform(0.1, 0.3), rng.uniform(-0.5, -0.3)),
        (rng.uniform(0.8, 1), rng.uniform(0.05, 0.2)),
    )
    angle = rng.uniform(-0.3, 0.9)
    c, s = math.cos(angle), math.sin(angle)
    span = math.hypot(c * head[0] - s * head[1] - foot[0], s * head[0] + c * head[1] - foot[1])
    part = {
        "between": ["ground.A", "boom.B"],
        "bore": w.by(rng.uniform(0.06, 0.12), 0, 1),
        "rod": w.by(rng.uniform(0.03, 0.05), 0, 1),
    }
    part |= ({}, {"efficiency": rng.uniform(0.8, 0.97)}, {"friction": w.by(rng.uniform(50, 500), 1, 1)})[
        seed % 3
    ]
    part |= {"rod_pressure": w.by(rng.uniform(0, 5e5), 1, -1)} if seed % 2 else {}
    if seed % 5 < 2:
        part |= {
            "closed": w.by(0.62 * span, 0, 1),
            "stroke": w.by(0.6 * span, 0, 1),
            "mass": [w.by(18, 1), w.by(9, 1)],
        }
    boom = {
        "points": {"O": [0, 0], "B": w.at(head)},
        "mass": w.by(320, 1),
        "center": w.at((1.6, 0.1)),
        "inertia": w.by(rng.uniform(50, 150), 1, 2),
    }
    tree = {
        "gravity": w.at(G),
        "links": {"ground": {"points": {"O": [0, 0], "A": w.at(foot)}}, "boom": boom},
        "joints": {"O": pin("ground", "boom")},
        "drives": {"C": {"cylinder": part} | w.slides(span, rng.uniform(-0.2, 0.2), rng.uniform(-0.5, 0.5))},
        "assembly": {"boom": w.turn(angle)},
    }
    return tree, ["drives.C.cylinder.bore", "links.boom.mass", "links.boom.points.B.0"]


def _mesh(seed: int, w: Written, gear: dict[str, Any], radii: Any, apart: Any) -> dict[str, Any]:
    rng = np.random.default_rng(seed)
    z, x = [0, 0, 1], [1, 0, 0]
    joint = {
        "type": "gear",
        "links": ["p", "w"],
        "at": ["A", "B"],
        "axes": {"i": {"z": z}, "j": {"z": x}},
        "radii": [w.by(r, 0, 1) for r in radii],
    }

    def shaft(at: str) -> dict[str, Any]:
        inertia = [w.by(0.01 * (1 + k), 1, 2) for k in (1, 1.5, 2)]
        return {"points": {at: [0, 0, 0]}, "mass": w.by(rng.uniform(1, 4), 1), "inertia": inertia}

    return {
        "space": "space",
        "gravity": w.at((0, -9.8, 0)),
        "links": {"ground": {"points": {"A": [0, 0, 0], "B": w.at(apart)}}, "p": shaft("A"), "w": shaft("B")},
        "joints": {
            "A": {"type": "revolute", "links": ["ground", "p"], "at": "A", "axis": z},
            "B": {"type": "revolute", "links": ["ground", "w"], "at": "B", "axis": x},
            "G": joint | gear,
        },
        "drives": {"A": w.spins(0.2, float(rng.choice([-10, 10])), rng.uniform(-5, 5))},
        "loads": {"T": {"type": "couple", "on": "w", "value": [w.couple(rng.uniform(-300, 300)), 0, 0]}},
    }


def worm(seed: int, w: Written) -> Machine:
    """One to four starts, right or left, driving or driven, beyond self-locking too."""
    rng = np.random.default_rng([seed, 1])
    r1, r2, lead = (
        rng.uniform(0.02, 0.03),
        rng.uniform(0.08, 0.15),
        rng.uniform(0.1, 0.6) * rng.choice([-1, 1]),
    )
    helix = math.copysign(math.pi / 2 - abs(lead), lead)
    gear = {
        "helix_angle": w.turn(helix),
        "pressure_angle": f"{rng.uniform(0.25, 0.4)!r} rad",
        "friction": {"coefficient": rng.uniform(0.02, 0.1)},
    }
    return _mesh(seed, w, gear, (r1, r2), (0, r1 + r2, 0)), [
        "joints.G.friction.coefficient",
        "loads.T.value.0",
    ]


def bevel(seed: int, w: Written) -> Machine:
    """Straight teeth with an efficiency, driving or driven."""
    rng = np.random.default_rng([seed, 2])
    r1, r2 = rng.uniform(0.02, 0.06, 2)
    return _mesh(seed, w, {"efficiency": rng.uniform(0.8, 0.97)}, (r1, r2), (-r1, 0, r2)), [
        "joints.G.efficiency",
        "loads.T.value.0",
    ]


def wedge(seed: int, w: Written) -> Machine:
    """Driven by a screw below a block in a guide, three faces that rub, lifted or let down."""
    rng = np.random.default_rng(seed)
    slope, mu = rng.uniform(0.1, 0.5), [{"friction": {"coefficient": x}} for x in rng.uniform(0.03, 0.2, 3)]
    screw = {
        "lead": w.by(rng.uniform(0.004, 0.012), 0, 1),
        "radius": w.by(rng.uniform(0.01, 0.02), 0, 1),
        "thread_angle": "15 deg",
        "friction": {"coefficient": rng.uniform(0.05, 0.2)},
    }
    tree = {
        "gravity": w.at(G),
        "links": {
            "ground": {"points": {"O": [0, 0]}},
            "wedge": {"points": {"W": [0, 0]}, "mass": w.by(rng.uniform(1, 9), 1)},
            "block": {"points": {"B": [0, 0]}, "mass": w.by(rng.uniform(1, 9), 1)},
        },
        "joints": {
            "floor": {"type": "slider", "links": ["ground", "wedge"], "at": ["O", "W"], "direction": 0}
            | mu[0],
            "face": {
                "type": "slider",
                "links": ["wedge", "block"],
                "at": ["W", "B"],
                "direction": w.turn(math.pi - slope),
                "angle": w.turn(slope - math.pi),
            }
            | mu[1],
            "guide": {
                "type": "slot",
                "links": ["ground", "block"],
                "at": ["O", "B"],
                "direction": w.turn(math.pi / 2),
            }
            | mu[2],
        },
        "drives": {
            "floor": w.slides(0.0, float(rng.choice([-0.1, 0.1])), rng.uniform(-2, 2)) | {"screw": screw}
        },
        "loads": {"load": force(w, "block", "B", (rng.uniform(-300, 300), -rng.uniform(500, 5000)))},
    }
    return tree, ["joints.face.friction.coefficient", "joints.guide.friction.coefficient", "links.block.mass"]


def train(seed: int, w: Written) -> Machine:
    """A planetary gear with losses in both meshes, driven by any two shafts."""
    rng = np.random.default_rng(seed)
    sun, planet = (int(z) for z in rng.integers(15, 50, 2))
    arm = w.by(0.001 * (sun + planet), 0, 1)
    gear = {"type": "gear", "module": w.by(0.002, 0, 1), "at": ["O", "P"]}
    loss = ({"efficiency": rng.uniform(0.8, 0.97)}, {"friction": {"coefficient": rng.uniform(0.02, 0.1)}})[
        seed % 3 == 2
    ]
    tree = {
        "gravity": w.at(G),
        "links": {
            "ground": {"points": {"O": [0, 0]}},
            "sun": wheel(w, "O", rng),
            "ring": wheel(w, "O", rng),
            "planet": wheel(w, "P", rng),
            "arm": {
                "points": {"O": [0, 0], "P": [arm, 0]},
                "mass": w.by(1, 1),
                "center": w.at((0.02, 0.01)),
                "inertia": w.by(0.1, 1, 2),
            },
        },
        "joints": {
            "S": pin("ground", "sun", "O"),
            "A": pin("ground", "arm", "O"),
            "R": pin("ground", "ring", "O"),
            "P": pin("arm", "planet"),
            "SP": gear | {"links": ["sun", "planet"], "teeth": [sun, planet]} | loss,
            "RP": gear
            | {"links": ["ring", "planet"], "teeth": [sun + 2 * planet, planet], "internal": True}
            | loss,
        },
        "drives": {
            n: w.spins(0.2, rng.uniform(-20, 20), rng.uniform(-20, 20))
            for n in rng.choice(["S", "A", "R"], 2, False)
        },
        "loads": {n: couple(w, n, rng.uniform(-40, 40)) for n in ("sun", "arm", "ring")},
    }
    first = "friction.coefficient" if "friction" in loss else "efficiency"
    return tree, [f"joints.SP.{first}", "links.planet.inertia", "loads.arm.value"]
