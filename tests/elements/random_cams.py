"""Random cams: knife, roller or flat, sliding or swinging, in both senses, with masses and loads."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from dalembert.arrays import Array
from tests.elements.written_machines import Written

RISES = ("cycloidal", "modified_sine", "polynomial345", "polynomial4567", "modified_trapezoid")
ROLLER = 0.008
FOLLOWERS: tuple[Any, ...] = ("knife", {"roller": ROLLER}, "flat")
DRAWN = Written()


class Case:
    """A machine with a cam, its segments, and what it takes to write it without."""

    def __init__(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        self.follower = FOLLOWERS[seed % 3]
        self.swings = seed // 3 % 2 == 1
        self.flat = self.follower == "flat"
        self.sense = str(rng.choice(["ccw", "cw"]))
        self.first = bool(rng.integers(2))  # the carrier is link i of the guide
        self.up = float(rng.choice([-1, 1])) if self.swings else 1.0
        lengths = rng.uniform(50, 110, 2).tolist()
        self.lift = float(math.radians(rng.uniform(3, 6)) if self.swings else rng.uniform(0.006, 0.012))
        to = self.up * self.lift
        self.segments: list[dict[str, Any]] = [
            {"to": to, "in": f"{lengths[0]!r} deg", "by": str(rng.choice(RISES))},
            {"dwell": "40 deg"},
            {"to": 0, "in": f"{lengths[1]!r} deg", "by": str(rng.choice(RISES))},
            {"dwell": "rest"},
        ]
        self.base = float(rng.uniform(0.095, 0.105) if self.flat else rng.uniform(0.05, 0.07))
        self.tilt = float(rng.uniform(0, 2 * math.pi))
        self.offset = rng.uniform(-0.015, 0.015)
        self.center = rng.uniform(-0.05, 0.05, 2)
        self.loads = rng.uniform(-200, 200, 4)
        self.masses: list[float] = rng.uniform(0.3, 2, 2).tolist()
        self.places = rng.uniform(-0.02, 0.02, (2, 2))
        self.axis = self.center + 0.12 * np.array([math.cos(self.tilt), math.sin(self.tilt)])
        self.turn = float(rng.uniform(-3, 3))  # of the follower's axes
        self.speeds = float(rng.uniform(5, 20)), float(rng.uniform(-30, 30))

    def tree(self, contact: str = "holds", w: Written = DRAWN) -> dict[str, Any]:
        """The machine with its cam."""
        segments = [x | {"to": self._lifted(w, x["to"])} if "to" in x else x for x in self.segments]
        profile = {"base": w.by(self.base, 0, 1), "sense": w.side(self.sense), "segments": segments}
        follower = {"roller": w.by(ROLLER, 0, 1)} if isinstance(self.follower, dict) else self.follower
        cam = {"type": "cam", "links": ["cam", "follower"], "at": ["O", "F"], "follower": follower}
        tree = self.frame(w)
        tree["joints"]["F"] = cam | {"profile": profile, "contact": contact}
        return tree

    def _lifted(self, w: Written, to: float) -> Any:
        return w.turn(to) if self.swings else w.by(to, 0, 1)

    def frame(self, w: Written = DRAWN) -> dict[str, Any]:
        """The machine without it."""
        m, p = self.masses, self.places
        c, s = math.cos(-self.turn), math.sin(-self.turn)
        guide = self.axis if self.swings else self._foot()
        arm = (0.1 * c, 0.1 * s) if self.swings else (0.0, 0.0)
        cam = {"points": {"O": [0, 0], "P": w.at(p[0])}, "center": w.at(p[1]), "inertia": w.by(0.002, 1, 2)}
        follower = {
            "points": {"Q": [0, 0], "F": w.at(arm), "P": w.at(p[1])},
            "center": w.at(p[0]),
            "inertia": w.by(0.003, 1, 2),
        }
        links = {
            "ground": {"points": {"O": w.at(self.center), "Q": w.at(guide)}},
            "cam": cam | {"mass": w.by(m[0], 1)},
            "follower": follower | {"mass": w.by(m[1], 1)},
        }
        ends = ["ground", "follower"] if self.first else ["follower", "ground"]
        slide = {"direction": w.turn(self._along()), "angle": w.turn(self._angle())}
        kind = {"type": "pin"} if self.swings else {"type": "slider"} | slide
        joints = {"O": {"type": "pin", "links": ["ground", "cam"]}, "Q": kind | {"links": ends, "at": "Q"}}
        turn = {"from": 0, "to": 360 * w.flip, "count": 11}
        loads = {
            "A": {"type": "force", "on": "cam", "at": "P", "value": w.force(self.loads[:2])},
            "B": {"type": "force", "on": "follower", "at": "P", "value": w.force(self.loads[2:])},
        }
        return {
            "links": links,
            "joints": joints,
            "drives": {"O": w.spins(0.0, *self.speeds) | {"position": turn}},
            "loads": loads,
            "gravity": w.at((0, -9.80665)),
        }

    def press(self, force: float) -> Array:
        """A force towards the cam at the follower's point in the first position."""
        c, s = math.cos(self.tilt), math.sin(self.tilt)
        if not self.swings:
            return np.array([-force * c, -force * s])
        return np.asarray(force * (self.center - self.axis) / 0.12)

    def _foot(self) -> Array:
        """A point of the line of the slide."""
        aside = np.array([math.sin(self.tilt), -math.cos(self.tilt)])
        return np.asarray(self.center + self.offset * aside)

    def _along(self) -> float:
        """Direction of the slide in the axes of link i, so that the follower slides out as it grows."""
        return self.tilt if self.first else self.tilt + math.pi - self.turn

    def _angle(self) -> float:
        """So that the follower's axes have the angle ``turn`` on the ground."""
        return (self.turn if self.first else -self.turn) - self._along()
