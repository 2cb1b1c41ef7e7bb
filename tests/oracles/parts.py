"""Short ways to write the trees of the oracle mechanisms."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from tests.oracles.jets import Kinematics
from tests.oracles.reading import Tree


@dataclass(frozen=True)
class Example:
    """A mechanism over its cycle: the tree for the product, the closed form for the oracle."""

    name: str
    tree: Tree
    kinematics: Kinematics


def link(mass: float, center: tuple[float, float], inertia: float, **points: tuple[float, float]) -> Tree:
    return {
        "points": {k: list(p) for k, p in points.items()},
        "mass": mass,
        "center": list(center),
        "inertia": inertia,
    }


def ground(**points: tuple[float, float]) -> Tree:
    return {"points": {k: list(p) for k, p in points.items()}}


def pin(i: str, j: str, **more: Any) -> Tree:
    return {"type": "pin", "links": [i, j], **more}


def slider(i: str, j: str, direction: float = 0.0, **more: Any) -> Tree:
    return {"type": "slider", "links": [i, j], "direction": direction, **more}


def slot(i: str, j: str, direction: float = 0.0, **more: Any) -> Tree:
    return {"type": "slot", "links": [i, j], "direction": direction, **more}


def gear(i: str, j: str, radii: tuple[float, float], **more: Any) -> Tree:
    return {"type": "gear", "links": [i, j], "radii": list(radii), **more}


def turning(start: float, end: float, count: int, speed: float, acceleration: float) -> Tree:
    return {
        "position": {"from": start, "to": end, "count": count},
        "speed": f"{speed} rad/s",
        "acceleration": f"{acceleration} rad/s^2",
    }


def sliding(start: float, end: float, count: int, speed: float, acceleration: float) -> Tree:
    return {
        "position": {"from": start, "to": end, "count": count},
        "speed": speed,
        "acceleration": acceleration,
    }


def force(on: str, at: Any, value: Any, **more: Any) -> Tree:
    return {"type": "force", "on": on, "at": at, "value": value, **more}


def couple(on: str, value: float) -> Tree:
    return {"type": "couple", "on": on, "value": value}


def spring(a: str, b: str, stiffness: float, free_length: float) -> Tree:
    return {"type": "spring", "between": [a, b], "stiffness": stiffness, "free_length": free_length}


def damper(a: str, b: str, damping: float) -> Tree:
    return {"type": "damper", "between": [a, b], "damping": damping}


def tree(
    links: Tree, joints: Tree, drives: Tree, loads: Tree | None = None, gravity: Any = "standard"
) -> Tree:
    return {
        "dalembert": 1, "gravity": gravity, "links": links, "joints": joints, "drives": drives, "loads": loads or {},
    }  # fmt: skip
