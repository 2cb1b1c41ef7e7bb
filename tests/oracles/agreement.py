"""How far a result of the product is from an oracle's answer, each quantity on its own scale."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.oracles.lagrange import Answer
from tests.oracles.reading import Array


def disagreement(r: Any, answer: Answer) -> dict[str, float]:
    """Largest differences: lengths over the machine's, rates over the largest, forces over the largest force.

    Angular rates times the machine's length are on the scale of linear ones; moments are over force times length.
    """
    out = motion(r, answer)
    length, force = answer.length(), answer.force_scale()
    for name, expected in answer.forces.items():
        out[f"reaction {name}"] = _gap(r.reaction(name), expected, force)
        out[f"moment {name}"] = _gap(r.reaction_moment(name), answer.moments[name], force * length)
    for name, expected in answer.efforts.items():
        unit = force * length if _turns(answer, name) else force
        out[f"effort {name}"] = _gap(r.effort(name), expected, unit)
    return out


def motion(r: Any, answer: Any) -> dict[str, float]:
    """Positions, speeds and accelerations of every link."""
    links = answer.machine.links
    length = float(np.max(np.abs(answer.q[..., :2]))) or 1.0
    speed, gain = (_rate_scale(x, length) for x in (answer.v, answer.a))
    out = {}
    for k, link in enumerate(links):
        if k == 0:
            continue
        q, v, a = (x[:, k] for x in (answer.q, answer.v, answer.a))
        turned = np.remainder(r.angle(link) - q[:, 2] + np.pi, 2 * np.pi) - np.pi
        out[f"position {link}"] = _gap(r.position(link), q[:, :2], length)
        out[f"angle {link}"] = float(np.max(np.abs(turned)))
        out[f"speed {link}"] = _gap(r.speed(link) * length, v[:, 2] * length, speed)
        out[f"acceleration {link}"] = _gap(r.acceleration(link) * length, a[:, 2] * length, gain)
        arm = r.center(link) - r.position(link)
        turn, normal = v[:, 2, None], np.stack([-arm[:, 1], arm[:, 0]], -1)
        velocity = v[:, :2] + turn * normal
        out[f"center velocity {link}"] = _gap(r.center_velocity(link), velocity, speed)
        expected = a[:, :2] + a[:, 2, None] * normal - turn**2 * arm
        out[f"center acceleration {link}"] = _gap(r.center_acceleration(link), expected, gain)
    return out


def worst(differences: dict[str, float]) -> tuple[str, float]:
    """The quantity that differs most; NaN counts as infinite."""
    name = max(differences, key=lambda key: np.nan_to_num(differences[key], nan=np.inf))
    return name, differences[name]


def _gap(found: Array, expected: Array, scale: float) -> float:
    return float(np.max(np.abs(np.asarray(found) - expected))) / (scale or 1.0)


def _rate_scale(rates: Array, length: float) -> float:
    return float(np.max(np.abs(rates * [1.0, 1.0, length]))) or 1.0


def _turns(answer: Answer, drive: str) -> bool:
    return next(d.freedom for d in answer.machine.drives if d.name == drive) == "turn"
