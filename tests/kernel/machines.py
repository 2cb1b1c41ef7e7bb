"""Small machines that between them have every kind of group, joint and load, for tests that need one of each."""

from __future__ import annotations

from functools import partial
from typing import Any

import dalembert as da
from tests.friction.rough import CYCLES, cycle


def block_in_a_yoke(positions: int = 24) -> Any:
    """Crank, a block pinned to it that slides in a yoke, and the yoke on the ground, both slides askew."""
    joints = {
        "A": {"type": "pin", "links": ["crank", "block"]},
        "slide": {"type": "slider", "links": ["yoke", "block"], "at": ["S", "A"], "direction": 70},
        "guide": {"type": "slider", "links": ["ground", "yoke"], "at": ["G", "S"], "direction": 15},
    }
    links = {
        "block": {"points": {"A": [0, 0]}, "mass": 0.4, "center": [0.01, 0.02], "inertia": 0.002},
        "yoke": {"points": {"S": [0, 0]}, "mass": 1.5, "center": [0.05, 0.03], "inertia": 0.01},
    }
    return _cranked(links, joints, "yoke", {"from": 0, "to": 360, "count": positions})


def block_on_a_crank(positions: int = 24) -> Any:
    """A block that slides along the crank, pinned to a slider on the ground."""
    joints = {
        "slide": {"type": "slider", "links": ["crank", "block"], "at": ["A", "B"], "direction": 10},
        "B": {"type": "pin", "links": ["block", "ram"]},
        "guide": {"type": "slider", "links": ["ground", "ram"], "at": ["G", "B"], "direction": 80},
    }
    links = {
        "block": {"points": {"B": [0, 0]}, "mass": 0.4, "center": [0.01, 0.02], "inertia": 0.002},
        "ram": {"points": {"B": [0, 0]}, "mass": 1.5, "center": [0.05, 0.03], "inertia": 0.01},
    }
    return _cranked(links, joints, "ram", {"from": -50, "to": 50, "count": positions})


AT = {
    "O": (0.0, 0.0),
    "A": (0.06, 0.0),
    "D": (0.0, 0.05),
    "K": (0.43, 0.23),
    "B": (0.17, 0.41),
    "C": (0.36, 0.17),
    "E": (0.65, 0.33),
    "F": (0.58, 0.07),
    "G": (0.26, 0.53),
    "H": (0.68, 0.66),
}
"""Joints of the eight-bar where its drive is at 0."""
PINS = {
    "O": ("ground", "crank"),
    "A": ("crank", "AC"),
    "C": ("AC", "plate"),
    "G": ("ground", "GB"),
    "B": ("GB", "plate"),
    "K": ("plate", "wing"),
    "D": ("crank", "DF"),
    "F": ("DF", "wing"),
    "H": ("ground", "HE"),
    "E": ("HE", "wing"),
}


def eight_bar(positions: int = 24) -> Any:
    """Two plates pinned together, each on a bar from the crank and one from the ground: six links, nine pins and three
    loops that have no smaller group in them and no closed form."""
    shapes = {"crank": "OAD", "plate": "KBC", "wing": "KEF", "AC": "AC", "GB": "GB", "DF": "DF", "HE": "HE"}
    links: dict[str, Any] = {"ground": {"points": {name: list(AT[name]) for name in "OGH"}}}
    for link, names in shapes.items():
        (x, y), count = AT[names[0]], len(names)
        points = {name: [AT[name][0] - x, AT[name][1] - y] for name in names}
        center = [sum(p[k] for p in points.values()) / count for k in (0, 1)]
        links[link] = {"points": points, "mass": 1, "center": center, "inertia": 0.01}
    drive = {
        "position": {"from": -30, "to": 40, "count": positions},
        "speed": "5 rad/s",
        "acceleration": "3 rad/s^2",
    }
    return da.mechanism(
        {
            "gravity": [0, -9.81],
            "links": links,
            "joints": {name: {"type": "pin", "links": list(pair)} for name, pair in PINS.items()},
            "drives": {"O": drive},
            "loads": {"F": {"type": "force", "on": "wing", "at": "E", "value": [-50, -20]}},
            "assembly": dict.fromkeys(list(shapes)[1:], 0),
        }
    )


def _cranked(links: dict[str, Any], joints: dict[str, Any], loaded: str, position: dict[str, Any]) -> Any:
    crank = {"points": {"O": [0, 0], "A": [0.08, 0]}, "mass": 0.9, "center": [0.04, 0], "inertia": 0.003}
    point = next(iter(links[loaded]["points"]))
    return da.mechanism(
        {
            "gravity": [0, -9.81],
            "links": {"ground": {"points": {"O": [0, 0], "G": [0.2, 0.05]}}, "crank": crank} | links,
            "joints": {"O": {"type": "pin", "links": ["ground", "crank"]}} | joints,
            "drives": {"O": {"position": position, "speed": "12 rad/s", "acceleration": "7 rad/s^2"}},
            "loads": {"F": {"type": "force", "on": loaded, "at": point, "value": [-90, 40]}},
        }
    )


KINDS = {
    "pin-pin-pin": da.four_bar,
    "pin-pin-slider": da.slider_crank,
    "pin-slider-pin": da.inverted_slider_crank,
    "pin-slider-slider": block_in_a_yoke,
    "slider-pin-slider": block_on_a_crank,
    "a slot and a slider": da.scotch_yoke,
    "slots": da.whitworth,
    "ram": da.crank_shaper,
    "two drives": da.five_bar,
    "law of a cylinder": da.bucket,
    "Stephenson III": da.stephenson_3,
    "no closed form": da.stephenson_2,
    "three loops, no closed form": eight_bar,
    "scissor": da.scissor,
}

ROUGH = {name: partial(cycle, name, 24) for name in CYCLES.split()}
"""Templates with friction in every pin, guide and slot."""


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


def turning_arm() -> Any:
    """An arm that turns evenly about a pin, without gravity."""
    arm = {"points": {"O": [0, 0]}, "mass": 2, "center": [0.17, 0.05], "inertia": 0.01}
    drive = {"position": {"from": "0 deg", "to": "355 deg", "count": 72}, "speed": "300 rpm"}
    links = {"ground": {"points": {"O": [0, 0]}}, "arm": arm}
    joints = {"O": {"type": "pin", "links": ["ground", "arm"]}}
    return da.mechanism({"gravity": "none", "links": links, "joints": joints, "drives": {"O": drive}})


def four_bar(count: int = 24) -> Any:
    return da.mechanism(four_bar_tree(count))
