"""Small machines that between them have every kind of group, joint and load, for tests that need one of each."""

from __future__ import annotations

from typing import Any

import dalembert as da

KINDS = {
    "pin-pin-pin": da.four_bar,
    "pin-pin-slider": da.slider_crank,
    "pin-slider-pin": da.inverted_slider_crank,
    "slider-pin-slider": da.scotch_yoke,
    "slots": da.whitworth,
    "ram": da.crank_shaper,
    "two drives": da.five_bar,
    "law of a cylinder": da.bucket,
    "three loops": da.stephenson_3,
    "no closed form": da.stephenson_2,
    "scissor": da.scissor,
}


def four_bar_tree(count: int = 24) -> dict[str, Any]:
    """A four-bar with masses, a force, a couple, a spring, dampers and an expression."""
    return {
        "gravity": [0, -9.81],
        "links": {
            "ground": {"points": {"O2": [0, 0], "O4": [0.3, 0.02], "S": [0.2, 0.4]}},
            "crank": {
                "points": {"O2": [0, 0], "A": [0.1, 0]},
                "mass": 1.5,
                "center": [0.02, 0.01],
                "inertia": 0.01,
            },
            "coupler": {
                "points": {"A": [0, 0], "B": [0.32, 0], "P": [0.1, 0.12]},
                "mass": 2.5,
                "center": [0.13, 0.06],
                "inertia": 0.05,
            },
            "rocker": {
                "points": {"O4": [0, 0], "B": [0.25, 0]},
                "mass": 2.0,
                "center": [0.1, 0],
                "inertia": 0.03,
            },
        },
        "joints": {
            "O2": {"type": "pin", "links": ["ground", "crank"]},
            "A": {"type": "pin", "links": ["crank", "coupler"], "damping": 0.02},
            "B": {"type": "pin", "links": ["coupler", "rocker"]},
            "O4": {"type": "pin", "links": ["ground", "rocker"]},
        },
        "drives": {
            "O2": {
                "position": {"from": 0, "to": 360, "count": count},
                "speed": "25 rad/s",
                "acceleration": "-40 rad/s^2",
            }
        },
        "loads": {
            "P": {"type": "force", "on": "coupler", "at": "P", "value": ["30*sin(2*O2)", -40]},
            "F": {"type": "force", "on": "rocker", "at": "B", "value": 25, "direction": 20, "axes": "link"},
            "T": {"type": "couple", "on": "rocker", "value": 12},
            "table": {
                "type": "couple",
                "on": "coupler",
                "value": {"against": "O2", "x": [0, 90, 180, 360], "y": [0, 3, 5, 0], "periodic": True},
            },
            "spring": {
                "type": "spring",
                "between": ["ground.S", "coupler.P"],
                "stiffness": 500,
                "free_length": 0.1,
            },
            "twist": {"type": "torsion_spring", "joint": "O4", "stiffness": 3, "free_angle": 40},
        },
        "assembly": {"coupler": 20, "rocker": 70},
    }


def four_bar(count: int = 24) -> Any:
    return da.mechanism(four_bar_tree(count))
