"""Random cams: knife, roller or flat, sliding or swinging, in both senses, with masses and loads."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from dalembert.arrays import Array

RISES = ("cycloidal", "modified_sine", "polynomial345", "polynomial4567", "modified_trapezoid")
FOLLOWERS: tuple[Any, ...] = ("knife", {"roller": 0.008}, "flat")


class Case:
    """A machine with a cam, its segments, and what it takes to write it without."""

    def __init__(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        self.follower = FOLLOWERS[seed % 3]
        self.swings = seed // 3 % 2 == 1
        self.flat = self.follower == "flat"
        self.sense = rng.choice(["ccw", "cw"])
        self.first = bool(rng.integers(2))  # the carrier is link i of the guide
        self.up = float(rng.choice([-1, 1])) if self.swings else 1.0
        lengths = rng.uniform(50, 110, 2).tolist()
        self.lift = float(math.radians(rng.uniform(3, 6)) if self.swings else rng.uniform(0.006, 0.012))
        to = self.up * self.lift
        self.segments = [
            {
                "to": f"{math.degrees(to)!r} deg" if self.swings else to,
                "in": f"{lengths[0]!r} deg",
                "by": str(rng.choice(RISES)),
            },
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

    def tree(self, contact: str = "holds") -> dict[str, Any]:
        """The machine with its cam."""
        profile = {"base": self.base, "sense": str(self.sense), "segments": self.segments}
        cam = {"type": "cam", "links": ["cam", "follower"], "at": ["O", "F"], "follower": self.follower}
        tree = self.frame()
        tree["joints"]["F"] = cam | {"profile": profile, "contact": contact}
        return tree

    def frame(self) -> dict[str, Any]:
        """The machine without it."""
        m, p = self.masses, self.places.tolist()
        c, s = math.cos(-self.turn), math.sin(-self.turn)
        guide = [float(x) for x in (self.axis if self.swings else self._foot())]
        arm = [0.1 * x for x in (c, s)] if self.swings else [0.0, 0.0]
        links = {
            "ground": {"points": {"O": self.center.tolist(), "Q": guide}},
            "cam": {"points": {"O": [0, 0], "P": p[0]}, "mass": m[0], "center": p[1], "inertia": 0.002},
            "follower": {
                "points": {"Q": [0, 0], "F": arm, "P": p[1]},
                "mass": m[1],
                "center": p[0],
                "inertia": 0.003,
            },
        }
        ends = ["ground", "follower"] if self.first else ["follower", "ground"]
        slide = {
            "direction": f"{math.degrees(self._along())!r} deg",
            "angle": f"{math.degrees(self._angle())!r} deg",
        }
        kind = {"type": "pin"} if self.swings else {"type": "slider"} | slide
        joints = {"O": {"type": "pin", "links": ["ground", "cam"]}, "Q": kind | {"links": ends, "at": "Q"}}
        w, a = self.speeds
        drive = {
            "position": {"from": 0, "to": 360, "count": 11},
            "speed": f"{w!r} rad/s",
            "acceleration": f"{a!r} rad/s^2",
        }
        loads = {
            "A": {"type": "force", "on": "cam", "at": "P", "value": self.loads[:2].tolist()},
            "B": {"type": "force", "on": "follower", "at": "P", "value": self.loads[2:].tolist()},
        }
        return {
            "links": links,
            "joints": joints,
            "drives": {"O": drive},
            "loads": loads,
            "gravity": "standard",
        }

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
