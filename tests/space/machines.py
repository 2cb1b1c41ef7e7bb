"""Mechanisms in space that the tests of answers share."""

from __future__ import annotations

from typing import Any

import dalembert as da
from dalembert.bundled import examples
from tests.oracles.space.machines import EXAMPLES


def rssr(**changes: Any) -> Any:
    """The bundled example, with some values changed by path."""
    return da.load(examples()["rssr"]).with_values(changes)


def oracle(name: str) -> Any:
    """A mechanism of the oracles: skew axes, full inertias, loads."""
    return da.mechanism(EXAMPLES[name].tree)


def door(axis: tuple[float, float, float] = (0.0, 0.0, 1.0)) -> Any:
    """A door on two hinges on one line: five constraints too many, the drive at the lower one."""
    return da.mechanism(
        {
            "space": "space",
            "gravity": "standard",
            "links": {
                "ground": {"points": {"A": [0, 0, 0], "B": list(axis)}},
                "door": {
                    "points": {"A": [0, 0, 0], "B": list(axis)},
                    "mass": 20,
                    "center": [0.4, 0.1, 0.5],
                    "inertia": [2, 3, 1.5],
                },
            },
            "joints": {
                "A": {"type": "revolute", "links": ["ground", "door"], "axis": list(axis)},
                "B": {"type": "revolute", "links": ["ground", "door"], "axis": list(axis)},
            },
            "drives": {"A": {"position": [10, 50, 120], "speed": "1 rad/s", "acceleration": "2 rad/s^2"}},
        }
    )
