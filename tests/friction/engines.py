"""The classic engine of the seeds, and other small machines whose friction has a closed form."""

from __future__ import annotations

from typing import Any

import dalembert as da


def engine(
    mu: float = 0.4,
    circle: str = "tan",
    guide: float | None = None,
    position: Any = 50,
    speed: float = 1.0,
    gas: float = 22089.32334555,
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
