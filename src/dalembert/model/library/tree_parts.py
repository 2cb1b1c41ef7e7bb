"""The pieces templates are put together from: small trees in the words of the model file, SI inside."""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees, isfinite
from typing import TYPE_CHECKING, Any

from dalembert.arrays import Tree
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.model import Mechanism


def slender(mass_per_length: float, **points: float) -> Tree:
    """A uniform slender link along its x axis, with named points on it.

    >>> slender(2.0, O2=0.0, A=0.6)
    {'points': {'O2': [0.0, 0.0], 'A': [0.6, 0.0]}, 'mass': 1.2, 'center': [0.3, 0.0], 'inertia': 0.036}
    """
    low, high = min(points.values()), max(points.values())
    length = high - low
    mass = mass_per_length * length
    return {
        "points": {name: [x, 0.0] for name, x in points.items()},
        "mass": mass,
        "center": [(low + high) / 2, 0.0],
        "inertia": mass * length**2 / 12,
    }


def pin(i: str, j: str, at: str | None = None) -> Tree:
    """A pin at the point with its name, or at another that both links have."""
    return {"type": "pin", "links": [i, j]} | ({"at": at} if at else {})


def slider(i: str, j: str, at: tuple[str, str], direction: float = 0.0) -> Tree:
    """A slider: point of j on the line through the point of i, direction in degrees."""
    return {"type": "slider", "links": [i, j], "at": list(at), "direction": direction}


def slot(i: str, j: str, at: tuple[str, str], direction: float = 0.0) -> Tree:
    """A pin of j in a straight slot of i, direction in degrees."""
    return {"type": "slot", "links": [i, j], "at": list(at), "direction": direction}


def turning(sweep: tuple[float, float], positions: int, speed: float) -> Tree:
    """A drive that turns through the sweep at a steady speed (radians and rad/s)."""
    start, stop = (degrees(end) for end in sweep)
    return {"position": {"from": start, "to": stop, "count": positions}, "speed": f"{speed!r} rad/s"}


def sliding(
    sweep: tuple[float, float], positions: int, speed: float = 0.0, freedom: str | None = None
) -> Tree:
    """A drive that slides through the sweep at a steady speed (metres and m/s)."""
    start, stop = sweep
    drive: Tree = {"freedom": freedom} if freedom else {}
    drive["position"] = {"from": start, "to": stop, "count": positions}
    return drive | ({"speed": speed} if speed else {})


def force(on: str, at: str, value: object, **more: object) -> Tree:
    return {
        "type": "force",
        "on": on,
        "at": at,
        "value": list(value) if isinstance(value, tuple) else value,
    } | more


def build_mechanism(title: str, **sections: object) -> Mechanism:
    """The mechanism of a complete tree, through the public constructor with all its checks."""
    from dalembert.model import mechanism

    return mechanism({"dalembert": 1, "title": title} | tidy(sections))


def tidy(tree: object) -> Any:
    """The same tree without the last digits of rounding, for files that people read.

    >>> tidy({"mass": 0.1 + 0.2})
    {'mass': 0.3}
    """
    if isinstance(tree, float):
        return float(f"{tree:.14g}")
    if isinstance(tree, Mapping):
        return {key: tidy(value) for key, value in tree.items()}
    return [tidy(value) for value in tree] if isinstance(tree, list) else tree


def finite(template: str, /, **values: float) -> None:
    """Refuse what is not a finite number, by name."""
    for name, value in values.items():
        if not isfinite(value):
            raise ModelError(f"{template}: {name} is {value}", "give a finite value")


def positive(template: str, unit: str = "m", /, **values: float) -> None:
    """Refuse what is not a finite number greater than 0, by name."""
    for name, value in values.items():
        if not (isfinite(value) and value > 0):
            raise ModelError(
                f"{template}: {name} is {value:g} {unit}, and must be greater than 0",
                f"give {name} a finite value in {unit}",
            )
