"""Random machines of every family of elements; each with paths that a kernel varies."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from tests.elements.random_brakes import band, faces, one_way, shoe
from tests.elements.random_cams import Case
from tests.elements.random_drives import bevel, cylinder, train, wedge, worm
from tests.elements.random_wrapped import belt, idler, tackle
from tests.elements.written_machines import G, Machine, Written, couple, force, pin, wheel


def cam(seed: int, w: Written) -> Machine:
    """Knife, roller or flat, sliding or swinging, pressed on the disc or held in a groove; knife and face rub."""
    case = Case(seed)
    tree = case.tree("holds" if seed % 4 == 3 else "pushes", w)
    if case.follower in ("knife", "flat"):
        tree["joints"]["F"]["friction"] = {"coefficient": 0.02 + 0.06 * (seed % 7) / 6}
    tree["loads"]["press"] = force(w, "follower", "F", case.press(4000.0))
    return tree, ["joints.F.profile.base", "links.follower.mass"]


def governor(seed: int, w: Written) -> Machine:
    """Porter's, with arms of any lengths off the axis, a sleeve that rubs or not, at a given speed."""
    rng = np.random.default_rng(seed)
    upper, lower, off = rng.uniform(0.2, 0.3), rng.uniform(0.25, 0.35), rng.uniform(0, 0.05, 2)
    down = -rng.uniform(0.6, 1.1)
    ball = (off[0] + upper * math.cos(down), upper * math.sin(down))
    lower = max(lower, 1.1 * abs(ball[0] - off[1]))  # long enough to reach the sleeve
    lean = -math.pi / 2 - math.asin((ball[0] - off[1]) / lower)
    rubs = (
        {},
        {"friction": {"coefficient": rng.uniform(0.05, 0.2)}},
        {"friction": {"force": w.by(rng.uniform(5, 30), 1, 1)}},
    )[seed % 3]
    tree = {
        "gravity": w.at(G),
        "links": {
            "ground": {"points": {"O": w.at((off[0], 0)), "Z": [0, 0]}},
            "upper": {
                "points": {"O": [0, 0], "B": w.at((upper, 0))},
                "mass": w.by(rng.uniform(2, 8), 1),
                "center": w.at((upper, 0)),
            },
            "lower": {"points": {"B": [0, 0], "S": w.at((lower, 0))}},
            "sleeve": {"points": {"Z": [0, 0], "S": w.at((off[1], 0))}, "mass": w.by(rng.uniform(5, 30), 1)},
        },
        "joints": {
            "O": pin("ground", "upper"),
            "B": pin("upper", "lower"),
            "S": pin("lower", "sleeve"),
            "axis": {
                "type": "slider",
                "links": ["ground", "sleeve"],
                "at": ["Z", "Z"],
                "direction": w.turn(-math.pi / 2),
                "angle": w.turn(math.pi / 2),
            }
            | rubs,
        },
        "drives": {"O": w.spins(down, float(rng.choice([-1, 1])), rng.uniform(-3, 3))},
        "turning": {"axis": w.turn(math.pi / 2), "speed": f"{rng.uniform(10, 25)!r} rad/s"},
        "assembly": {"lower": w.turn(lean)},
    }
    return tree, ["links.upper.mass", "links.sleeve.mass", "turning.speed"]


def pushing(seed: int, w: Written) -> Machine:
    """A pin in one side of a slot, straight or round, a wheel on a track, a block on a floor that rubs."""
    rng = np.random.default_rng(seed)
    side = str(rng.choice(["left", "right"]))
    sign = 1 if side == "left" else -1
    rubs = {"friction": {"coefficient": rng.uniform(0.02, 0.15)}}
    slope = rng.uniform(-0.4, 0.4)
    track = {
        "direction": w.turn(slope if w.flip > 0 else slope + math.pi),
        "radius": w.by(rng.uniform(0.05, 0.2), 0, 1),
    }
    round_ = seed % 3 == 1
    slot = {"type": "slot", "direction": w.turn(rng.uniform(-0.3, 0.3))} | rubs
    if round_:
        slot = {"type": "circular_slot", "radius": w.by(0.4, 0, 1)}
    tree = {
        "gravity": w.at(G),
        "links": {
            "ground": {
                "points": {"O": [0, 0], "Q": w.at((-0.3, 0.02)), "T": w.at((1, 0)), "F": w.at((0, -1))}
            },
            "crank": wheel(w, "O", rng) | {"points": {"O": [0, 0], "A": w.at((0.1, 0))}},
            "lever": {
                "points": {"Q": [0, 0], "C": w.at((0.05, 0.2))},
                "mass": w.by(rng.uniform(1, 5), 1),
                "center": w.at((0.2, 0.03)),
                "inertia": w.by(0.2, 1, 2),
            },
            "wheel": wheel(w, "C", rng),
            "block": {
                "points": {"B": [0, 0]},
                "mass": w.by(rng.uniform(1, 9), 1),
                "center": w.at((0.01, 0.05)),
                "inertia": w.by(0.02, 1, 2),
            },
        },
        "joints": {
            "O": pin("ground", "crank"),
            "Q": pin("ground", "lever"),
            "slot": {"links": ["lever", "crank"], "at": ["C" if round_ else "Q", "A"], "contact": "pushes"}
            | slot
            | {"side": side if round_ else w.side(side)},
            "track": {
                "type": "rolling",
                "links": ["ground", "wheel"],
                "at": ["T", "C"],
                "contact": "pushes",
            }
            | track,
            "floor": {
                "type": "slider",
                "links": ["ground", "block"],
                "at": ["F", "B"],
                "direction": 0,
                "contact": "pushes",
                "side": w.side("left"),
                "friction": {
                    "coefficient": rng.uniform(0.05, 0.3),
                    "guide": [w.by(0.1, 0, 1), w.by(0.1, 0, 1)],
                    "half_height": 0,
                },
            },
        },
        "drives": {
            "O": w.spins(rng.uniform(0.3, 1.2), rng.uniform(2, 9), rng.uniform(-9, 9)),
            "track": w.spins(0.5, rng.uniform(-9, 9), rng.uniform(-9, 9)) | {"freedom": "turn"},
            "floor": w.slides(0.2, float(rng.choice([-1, 1])), rng.uniform(-4, 4)),
        },
        "loads": {"C": couple(w, "lever", (-sign if round_ else sign) * rng.uniform(-10, 90))},
        "assembly": {"lever": w.turn(0.2)},
    }
    return tree, ["links.lever.mass", "links.block.mass", "joints.floor.friction.coefficient"]


FAMILIES: dict[str, Callable[[int, Written], Machine]] = {
    f.__name__: f
    for f in (
        cam,
        belt,
        idler,
        tackle,
        shoe,
        band,
        faces,
        cylinder,
        worm,
        bevel,
        wedge,
        one_way,
        train,
        governor,
        pushing,
    )
}
