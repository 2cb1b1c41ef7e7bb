"""The classic engine of the seeds, and other small machines whose friction has a closed form."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

import dalembert as da

GAS = 450e3 * np.pi / 4 * 0.25**2
"""N on the piston: 450 kPa on a bore of 250 mm."""


def engine(
    mu: float = 0.4,
    circle: str = "tan",
    guide: float | None = None,
    position: Any = 50,
    speed: float = 1.0,
    gas: float = GAS,
    **more: Any,
) -> Any:
    """Crank 0.3 m, rod 1.25 m, journals of 140, 120 and 80 mm; guide coefficient 0.07."""
    sliding: dict[str, Any] = {"coefficient": 0.07}
    if guide is not None:
        sliding["guide"] = [guide, guide]

    def pin(i: str, j: str, radius: float) -> dict[str, Any]:
        return {"type": "pin", "links": [i, j], "friction": {"radius": radius}}

    return da.mechanism(
        {
            "friction": {"coefficient": mu, "circle": circle},
            "links": {
                "ground": {"points": {"O": [0, 0]}},
                "crank": {"points": {"O": [0, 0], "A": [0.3, 0]}},
                "rod": {"points": {"A": [0, 0], "B": [1.25, 0], "W": [0.6, 0]}},
                "piston": {"points": {"B": [0, 0]}},
            },
            "joints": {
                "O": pin("ground", "crank", 0.07),
                "A": pin("crank", "rod", 0.06),
                "B": pin("rod", "piston", 0.04),
                "guide": {
                    "type": "slider",
                    "links": ["ground", "piston"],
                    "at": ["O", "B"],
                    "friction": sliding,
                },
            },
            "drives": {"O": {"position": position, "speed": f"{speed!r} rad/s"}},
            "loads": {"gas": {"type": "force", "on": "piston", "at": "B", "value": [-gas, 0]}},
            "assembly": {"rod": -11},
            **more,
        }
    )


class ByHand(NamedTuple):
    """Of the engine: effort, force in the rod and the angle of its line, normal force, couple and corners of the guide,
    efforts of the taught iteration, determinant over that without friction."""

    effort: float
    rod: float
    angle: float
    normal: float
    couple: float
    lower: float
    upper: float
    iteration: list[float]
    determinant: float


def engine_by_hand(
    sense: int = 1, mu: float = 0.4, circle: str = "tan", half: float = np.inf, position: float = 50.0
) -> ByHand:
    """The line of the rod's force touches the circles at A and B on the sides that the turning tells; at O likewise.

    A slow motion of the crank in a sense; the guide has 0.07 and half a length, and bears on two corners
    where the couple of friction at B is more than one face takes. The iteration is that of a long guide.
    """
    r, length, t, guide, gas = 0.3, 1.25, np.radians(position), 0.07 * sense, GAS
    share = mu if circle == "tan" else np.sin(np.arctan(mu))
    main, big, small = (sense * share * radius for radius in (0.07, 0.06, 0.04))  # at O, A and B
    small *= np.sign(np.cos(t))  # where the rod swings back it turns the other way against the piston
    beta = np.arcsin(r * np.sin(t) / length)  # of the rod, gamma of its force's line
    gamma = beta - np.arcsin((big + small) / length)
    corners = abs(small) / half
    rod = gas / (np.cos(gamma) + guide * max(np.sin(gamma), corners))
    normal, ends = rod * np.sin(gamma), rod * max(np.sin(gamma), corners)
    pressed = normal, abs(small) * rod, (ends + normal) / 2, (ends - normal) / 2
    x, y = length * np.cos(beta), length * np.sin(beta)
    found = [-r * gas * np.sin(t + beta) / np.cos(beta)]
    size, normal = gas / np.cos(beta), gas * np.tan(beta)
    for _ in range(30):  # friction of the last forces, then new forces
        along = gas - guide * normal
        normal = (y * along - (big + small) * size) / x
        found.append(-(r * np.sin(t) * along + r * np.cos(t) * normal - (big + main) * size))
        size = np.hypot(along, normal)
    c = big + small
    determinant = (x + c * np.sin(gamma) + guide * (y - c * np.cos(gamma))) / x
    effort = -rod * (r * np.sin(t + gamma) - big - main)
    return ByHand(effort, rod, float(gamma), *pressed, found, determinant)


def pushed_slider(mu: float, speed: float = 1.0, angle: float = 45.0, load: float = 100.0) -> Any:
    """A slider pushed by a force at an angle against a load; the force is asked for."""
    return da.mechanism(
        {
            "links": {"ground": {"points": {"O": [0, 0]}}, "block": {"points": {"B": [0, 0]}}},
            "joints": {
                "guide": {
                    "type": "slider",
                    "links": ["ground", "block"],
                    "at": ["O", "B"],
                    "friction": {"coefficient": mu},
                }
            },
            "drives": {"guide": {"position": 1, "speed": speed, "effort": 0}},
            "loads": {
                "rod": {"type": "force", "on": "block", "at": "B", "value": "unknown", "direction": angle},
                "Q": {"type": "force", "on": "block", "at": "B", "value": [-load, 0]},
            },
        }
    )


def collar(eccentricity: float, mu: float = 0.25, length: float = 0.1, push: float = 100.0) -> Any:
    """A collar of a length on a bar, pushed at an eccentricity; the drive's effort is what it still delivers."""
    return da.mechanism(
        {
            "links": {
                "ground": {"points": {"O": [0, 0]}},
                "collar": {"points": {"B": [0, 0], "P": [0, eccentricity]}},
            },
            "joints": {
                "bar": {
                    "type": "slider",
                    "links": ["ground", "collar"],
                    "at": ["O", "B"],
                    "friction": {"coefficient": mu, "guide": [length / 2, length / 2]},
                }
            },
            "drives": {"bar": {"position": 0.5, "speed": 1}},
            "loads": {"P": {"type": "force", "on": "collar", "at": "P", "value": [push, 0]}},
        }
    )


def guided(normal: float, couple: float, l1: float, l2: float, half_height: float = 0.0) -> Any:
    """A slider whose guide must take a normal force and a couple about its pin."""
    return da.mechanism(
        {
            "links": {"ground": {"points": {"O": [0, 0]}}, "block": {"points": {"B": [0, 0]}}},
            "joints": {
                "guide": {
                    "type": "slider",
                    "links": ["ground", "block"],
                    "at": ["O", "B"],
                    "friction": {"coefficient": 0.3, "guide": [l1, l2], "half_height": half_height},
                }
            },
            "drives": {"guide": {"position": 1, "speed": 1}},
            "loads": {
                "N": {"type": "force", "on": "block", "at": "B", "value": [0, -normal]},
                "M": {"type": "couple", "on": "block", "value": -couple},
            },
        }
    )
