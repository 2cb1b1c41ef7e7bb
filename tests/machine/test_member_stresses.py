"""Stresses of members against statics and sections written by hand: bent bars in space, shafts, columns."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.model.links.sections import Section
from tests.tiers import over

PI = np.pi
GAUSS = np.polynomial.legendre.leggauss(8)


def plain(v: Any) -> list[Any]:
    return np.asarray(v).tolist()


class BentBar:
    """A bar A-B-C on a shaft through A that turns ever faster, of even mass, forces at B and C, a couple at C."""

    def __init__(self, rng: Any, section: dict[str, Any]) -> None:
        self.points = {"A": np.zeros(3), "B": rng.uniform(0.2, 0.6, 3)}
        self.points["C"] = self.points["B"] + rng.uniform(-0.5, 0.5, 3)
        axis = rng.normal(size=3)
        axis /= np.linalg.norm(axis)
        self.speed, self.acceleration = axis * rng.uniform(3, 9), axis * rng.uniform(-20, 20)
        self.gravity, self.couple = np.array([0, 0, -9.80665]), rng.normal(size=3) * 20
        self.forces = {"B": rng.normal(size=3) * 50, "C": rng.normal(size=3) * 100}
        self.density = 7.0
        loads: dict[str, Any] = {
            f"F{p}": {"type": "force", "on": "bar", "at": p, "value": plain(v)}
            for p, v in self.forces.items()
        }
        loads["K"] = {"type": "couple", "on": "bar", "at": "C", "value": plain(self.couple)}
        self.tree = {
            "space": "space",
            "gravity": plain(self.gravity),
            "links": {"ground": {"points": {"A": [0, 0, 0]}}, "bar": self.bar(section)},
            "joints": {"O": {"type": "revolute", "links": ["ground", "bar"], "at": "A", "axis": plain(axis)}},
            "drives": {
                "O": {
                    "position": 0.0,
                    "speed": f"{axis @ self.speed} rad/s",
                    "acceleration": f"{axis @ self.acceleration} rad/s^2",
                }
            },
            "loads": loads,
        }

    def bar(self, section: dict[str, Any]) -> dict[str, Any]:
        some = self.masses("A", "B", 0.0) + self.masses("B", "C", 0.0)
        mass = sum(m for _, m in some)
        self.center = sum(m * p for p, m in some) / mass
        arms = [(p - self.center, m) for p, m in some]
        inertia = sum(m * (a @ a * np.eye(3) - np.outer(a, a)) for a, m in arms)
        return {
            "points": {n: plain(p) for n, p in self.points.items()},
            "mass": float(mass),
            "center": plain(self.center),
            "inertia": plain((inertia + inertia.T) / 2),
            "mass_along": "uniform",
            "members": [["A", "B"], ["B", "C"]],
            "section": section,
        }

    def masses(self, a: str, b: str, low: float) -> list[tuple[Any, float]]:
        """Masses at Gauss points of a member behind a part of its length."""
        p, q = self.points[a], self.points[b]
        size = (1 - low) * np.linalg.norm(q - p) * 7.0 / 2
        return [
            (p + (q - p) * (low + (1 - low) * (x + 1) / 2), float(w * size))
            for x, w in zip(*GAUSS, strict=True)
        ]

    def inside(self, a: str, b: str, part: float) -> Any:
        """N, V_y, V_z, T, M_y, M_z by summing what is beyond a cut."""
        p, q = self.points[a], self.points[b]
        cut, far = p + (q - p) * part, self.masses(a, b, part)
        far += self.masses("B", "C", 0.0) if b == "B" else []
        spin, rate = self.speed, self.acceleration
        acting = [
            (r, m * (self.gravity - np.cross(rate, r) - np.cross(spin, np.cross(spin, r)))) for r, m in far
        ]
        acting += [(self.points[n], v) for n, v in self.forces.items() if n == "C" or b == "B"]
        force = sum(v for _, v in acting)
        moment = sum(np.cross(r - cut, v) for r, v in acting) + self.couple
        t = (q - p) / np.linalg.norm(q - p)
        y = np.cross([0, 0, 1], t) / np.linalg.norm(np.cross([0, 0, 1], t))
        axes = np.array([t, y, np.cross(t, y)])
        return np.concatenate([axes @ force * [1, -1, 1], axes @ moment])


def saint_venant(a: float, b: float) -> float:
    """Torque over the greatest shear stress of a rectangle a >= b, by his series."""
    n = np.arange(1, 60, 2)
    twist = a * b**3 * (1 / 3 - 64 * b / PI**5 / a * np.sum(np.tanh(n * PI * a / 2 / b) / n**5))
    return float(
        twist / (b * (1 - 8 / PI**2 * np.sum(1 / n**2 / np.cosh(np.minimum(n * PI * a / 2 / b, 700)))))
    )


def mises(section: dict[str, Any], inner: Any) -> Any:
    """Von Mises stress of N, V_y, V_z, T, M_y, M_z (..., 6): at the fibres all round with torsion, and at the axis."""
    ((kind, size),) = section.items()
    n, vy, vz, torque, my, mz = np.moveaxis(inner, -1, 0)
    angle = np.linspace(0, 2 * PI, 2001)
    corners = np.array([[1, 1], [1, -1], [-1, 1], [-1, -1]])
    if kind == "rectangle":
        b, h = size
        area, iy, iz, fibres = b * h, h * b**3 / 12, b * h**3 / 12, corners * [h / 2, b / 2]
        ky, kz, twist = 1.5 / area, 1.5 / area, saint_venant(max(size), min(size))
    elif kind == "I":
        h, b, web, flange = size
        clear = h - 2 * flange
        area, iy = 2 * b * flange + clear * web, (2 * flange * b**3 + clear * web**3) / 12
        iz, fibres = b * h**3 / 12 - (b - web) * clear**3 / 12, corners * [h / 2, b / 2]
        ky, kz, twist = 1 / (web * clear), 1.5 / (2 * b * flange), 0.0
        twist = (2 * b * flange**3 + clear * web**3) / 3 / max(web, flange)
    else:
        i, o = (0.0, size) if kind == "circle" else size
        area, iy = PI / 4 * (o**2 - i**2), PI / 64 * (o**4 - i**4)
        iz, fibres = iy, o / 2 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        ky = kz = (o**3 - i**3) / 12 / iy / (o - i)  # first moment of half the section over I and what is cut
        twist = 4 * iy / o
    sigma = n[..., None] / area - mz[..., None] * fibres[:, 0] / iz + my[..., None] * fibres[:, 1] / iy
    tau = np.abs(torque) / twist
    axis = (n / area) ** 2 + 3 * (np.hypot(ky * vy, kz * vz) + tau) ** 2
    return np.sqrt(np.maximum(np.abs(sigma).max(axis=-1) ** 2 + 3 * tau**2, axis))


SECTIONS: list[dict[str, Any]] = [
    {"circle": 0.03},
    {"tube": [0.03, 0.034]},
    {"rectangle": [0.02, 0.045]},
    {"rectangle": [0.05, 0.006]},
    {"I": [0.06, 0.05, 0.004, 0.006]},
]


@over(1, 60)
def test_a_bent_bar_in_space_by_hand(seed: int) -> None:
    """Inner forces at any cut; the greatest stress of all places, with each section."""
    rng = np.random.default_rng(seed)
    bar = BentBar(rng, SECTIONS[0])
    f = da.member_forces(da.dynamics(da.mechanism(bar.tree)), "bar")
    by_hand = {}
    for curve in f.curves:
        parts = np.linspace(0, 1, 41)
        by_hand[curve.name] = np.array([bar.inside(*curve.member.ends, part) for part in parts])
        found = curve.at(parts * curve.member.length)[0]
        assert np.abs(found - by_hand[curve.name]).max() < 1e-11 * np.abs(found).max()
    for section in SECTIONS:
        s = f.stress(section)
        greatest = max(mises(section, inner).max() for inner in by_hand.values())
        assert s.largest > greatest * (1 - 2.1e-3)  # Roark's polynomial for torsion of rectangles
        there = bar.inside(*s.member[0].split("-"), float(s.place[0] / f.curve(s.member[0]).member.length))
        assert s.largest == pytest.approx(float(mises(section, there)), rel=2.1e-3)


def test_torsion_of_rectangles() -> None:
    for ratio, size in ((n, size) for n in (1, 1.2, 1.5, 2, 3, 10, 50) for size in ((1, n), (n, 1))):
        assert Section(rectangle=size).torsion == pytest.approx(saint_venant(ratio, 1), rel=2.1e-3)


SHAFT = """
space: space
links:
  ground: {points: {O: [0, 0, 0]}}
  shaft: {points: {O: [0, 0, 0], E: [0.5, 0, 0]},
          section: {circle: 30 mm, yield_stress: 300 MPa, ultimate: 500 MPa, endurance: 200 MPa}}
joints:
  O: {type: revolute, links: [ground, shaft], axis: [1, 0, 0]}
drives: {O: {position: {from: 0 deg, to: 350 deg, count: 36}, speed: 10 rad/s}}
loads:
  F: {type: force, on: shaft, at: E, value: [2000, 300, -400]}
"""


def test_a_turning_shaft_bends_to_and_fro() -> None:
    """A force that stands still: every fibre goes round, so that bending has no mean."""
    s = da.member_forces(da.dynamics(da.loads(SHAFT)), "shaft").stress()
    pull, bent = 2000 / (PI * 0.015**2), 250 / (PI * 0.03**3 / 32)
    found = s.fatigue()
    assert s.largest == pytest.approx(pull + bent, rel=1e-12)
    assert s.safety == pytest.approx(300e6 / (pull + bent), rel=1e-12)
    assert (found.mean, found.amplitude) == pytest.approx((pull, bent), rel=1e-8)
    assert found.safety == pytest.approx(1 / (bent / 200e6 + pull / 500e6), rel=1e-8)


def test_the_worst_fibre_of_a_still_shaft_lies_anywhere() -> None:
    """Bending moments that turn and swell, by trial of very many fibres."""
    table = "{{against: O, x: [0 deg, 1e-6 deg, 2e-6 deg], y: {}}}".format
    still = SHAFT.replace("to: 350 deg, count: 36}, speed: 10 rad/s", "to: 2e-6 deg, count: 3}")
    still = still.replace("[2000, 300, -400]", f"[0, {table('[0, 300, -100]')}, {table('[0, 200, 150]')}]")
    found = da.member_forces(da.statics(da.loads(still)), "shaft").stress().fatigue()
    angle = np.linspace(0, 2 * PI, 100001)
    moments = 0.5 * np.array([[0, 0], [300, 200], [-100, 150]])
    sigma = moments @ [np.cos(angle), np.sin(angle)] / (PI * 0.03**3 / 32)
    mean, swing = (sigma.max(axis=0) + sigma.min(axis=0)) / 2, np.ptp(sigma, axis=0) / 2
    assert found.safety == pytest.approx(1 / (swing / 200e6 + np.maximum(mean, 0) / 500e6).max(), rel=1e-5)
