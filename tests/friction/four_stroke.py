"""The engine of four_stroke.yaml by hand: its nine equations, link by link, with friction of senses that are given.

theta, b  angles of crank and rod; the piston runs along y, so that r cos(theta) + l cos(b) = 0
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import dalembert as da

FILE = Path(__file__).with_name("four_stroke.yaml")
R, LENGTH, MU, SLIDE, HALF = 0.045, 0.150, 0.02, 0.08, 0.043
CRANK, ROD, PISTON = (2.2, 0.005, 4500e-6), (0.65, 0.045, 2100e-6), 0.55
"""Mass, centre along the link, inertia; kg, m, kg m2."""
RADII = {"O": 0.025, "A": 0.022, "B": 0.011}
GAS_AT = [90, 100, 110, 130, 150, 180, 210, 270, 450, 540, 600, 660, 690, 720, 750, 780, 790, 800, 810]
GAS = [45, 29.5, 24, 15, 9.5, 5.5, 3.5, 1.2, 0, 0, 0, 0.3, 0.9, 1.6, 3.5, 8.5, 12, 19, 45]
SPEED, G = 3000 * np.pi / 30, 9.80665


class Found(NamedTuple):
    """Torque, and forces on j of each joint."""

    torque: float
    force: dict[str, Any]


def engine(position: Any = None) -> Any:
    m = da.load(FILE)
    if position is None:
        return m
    return m.model_copy(update={"drives": {"O": m.drives["O"].model_copy(update={"position": position})}})


def gas(theta: float) -> float:
    """Gas force, kN."""
    return float(np.interp(np.degrees(theta), GAS_AT, GAS))


def rod(theta: float) -> tuple[float, float, float]:
    """Angle, rate and second rate of the rod."""
    b = np.arccos(-R / LENGTH * np.cos(theta))
    rate = -R * SPEED * np.sin(theta) / (LENGTH * np.sin(b))
    second = -(R * SPEED**2 * np.cos(theta) + LENGTH * rate**2 * np.cos(b)) / (LENGTH * np.sin(b))
    return float(b), float(rate), float(second)


def rates(theta: float) -> dict[str, float]:
    """Rate of each joint's j against its i."""
    b, rate, _ = rod(theta)
    slide = R * SPEED * np.cos(theta) + LENGTH * rate * np.cos(b)
    return {"O": SPEED, "A": rate - SPEED, "B": -rate, "guide": float(slide)}


def senses(theta: float) -> dict[str, float]:
    return {joint: float(np.sign(rate)) for joint, rate in rates(theta).items()}


def forces(theta: float, sense: dict[str, float]) -> Found:
    """Solve, set friction by the forces found, solve again, until nothing changes."""
    a, x = _coefficients(theta), np.zeros(9)
    for _ in range(60):
        last, x = x, np.linalg.solve(a, -(_known(theta) + _friction(x, sense)))
        if np.max(np.abs(x - last)) < 1e-13 * np.max(np.abs(x)):
            break
    friction = -sense["guide"] * SLIDE * _sizes(x)[3]
    found = {"O": x[0:2], "A": x[2:4], "B": x[4:6], "guide": np.array([-x[6], friction])}
    return Found(float(x[8]), found)


def _coefficients(theta: float) -> Any:
    """Of O, A, B on crank, rod and piston, N to the left of the slide, M and the torque in the nine equations."""
    b = rod(theta)[0]
    out = np.zeros((9, 9))
    out[0:2, 0:2] = out[3:5, 2:4] = out[6:8, 4:6] = np.eye(2)
    out[0:2, 2:4] = out[3:5, 4:6] = -np.eye(2)
    out[2, 2:4] = -_arm(R, theta)  # moments about O, A and B
    out[5, 4:6] = -_arm(LENGTH, b)
    out[2, 8] = out[8, 7] = 1.0
    out[6, 6] = -1.0
    return out


def _arm(length: float, angle: float) -> Any:
    """Moment of unit forces along x and y at the end of a link."""
    return length * np.array([-np.sin(angle), np.cos(angle)])


def _known(theta: float) -> Any:
    """Weights, gas, inertia."""
    b, rate, second = rod(theta)

    def inward(length: float, angle: float, speed: float, spin: float) -> Any:
        """Acceleration of a point at a length of a link from its fixed end."""
        e = np.array([np.cos(angle), np.sin(angle)])
        return length * (spin * np.array([-e[1], e[0]]) - speed**2 * e)

    out, weight = np.zeros(9), np.array([0.0, -G])
    middle, end = inward(CRANK[1], theta, SPEED, 0.0), inward(R, theta, SPEED, 0.0)
    out[0:2] = CRANK[0] * (weight - middle)
    out[2] = _arm(CRANK[1], theta) @ out[0:2]
    of_rod = ROD[0] * (weight - end - inward(ROD[1], b, rate, second))
    out[3:5], out[5] = of_rod, _arm(ROD[1], b) @ of_rod - ROD[2] * second
    out[6:8] = PISTON * (weight - end - inward(LENGTH, b, rate, second)) - np.array([0.0, 1000 * gas(theta)])
    return out


def _friction(x: Any, sense: dict[str, float]) -> Any:
    """Couples of the friction circles on both links, friction of the guide and of its two faces."""
    sizes, sine = _sizes(x), MU / np.hypot(1.0, MU)
    couples = {
        joint: -sense[joint] * sine * RADII[joint] * size
        for joint, size in zip(("O", "A", "B"), sizes, strict=False)
    }
    out = np.zeros(9)
    out[2], out[5] = couples["O"] - couples["A"], couples["A"] - couples["B"]
    out[7] = -sense["guide"] * SLIDE * sizes[3]
    out[8] = couples["B"] - sense["guide"] * SLIDE * HALF * x[6]
    return out


def _sizes(x: Any) -> Any:
    """Forces of the pins, and the sum of the guide's contact forces."""
    tilt = abs(2 * x[7] - (0.020 - 0.025) * x[6]) / 0.045
    return np.array([*(np.hypot(*x[k : k + 2]) for k in (0, 2, 4)), max(abs(x[6]), tilt)])
