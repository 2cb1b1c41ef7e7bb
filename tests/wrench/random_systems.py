"""Random force systems, and what is measured in them without the product: moments term by term."""

from __future__ import annotations

from typing import Any

import numpy as np

from dalembert.wrench import Couple, Force, System
from tests.tiers import tiers

SEEDS = tiers(range(6), range(6, 20), range(20, 100))
DIMENSIONS = (2, 3)


def random_system(seed: int, d: int, size: float = 1.0, length: float = 1.0) -> System:
    """Two to six forces and up to three couples."""
    rng = np.random.default_rng([seed, d])
    forces = [
        Force(size * rng.normal(size=d), length * rng.normal(size=d), f"F{k}")
        for k in range(int(rng.integers(2, 7)))
    ]
    turning = 1 if d == 2 else 3
    couples = [
        Couple(size * length * rng.normal(size=turning), f"M{k}") for k in range(int(rng.integers(0, 4)))
    ]
    return System(*forces, *couples)


def point(seed: int, d: int, far: float = 3.0) -> Any:
    """A random point."""
    return far * np.random.default_rng([seed, d, 7]).normal(size=d)


def moment_by_terms(system: System, about: Any) -> Any:
    """Sum of moments (1,) or (3,), written out: x Fy - y Fx and its two sisters."""
    d = system.dimension
    total = np.zeros(1 if d == 2 else 3)
    for couple in system.couples:
        total = total + np.atleast_1d(couple.moment)
    for force in system.forces:
        x, y, z = (*(force.at - about), 0.0)[:3]
        fx, fy, fz = (*force.vector, 0.0)[:3]
        all_three = np.array([y * fz - z * fy, z * fx - x * fz, x * fy - y * fx])
        total = total + (all_three[2:] if d == 2 else all_three)
    return total


def scales(system: System, about: Any) -> tuple[float, float]:
    """Sizes that a difference of forces and of moments is compared with."""
    force = max(f.size for f in system.forces)
    arm = max(float(np.linalg.norm(f.at - about)) for f in system.forces)
    return force, max([force * arm, *(c.size for c in system.couples)])


def rotation(seed: int) -> Any:
    """A random rotation of space."""
    q, _ = np.linalg.qr(np.random.default_rng([seed, 99]).normal(size=(3, 3)))
    return q * np.sign(np.linalg.det(q))


def turned(system: System, turn: Any, shift: Any) -> System:
    """The whole system rotated, then moved."""
    plane = system.dimension == 2
    parts = [
        Force(turn @ p.vector, turn @ p.at + shift, p.name)
        if isinstance(p, Force)
        else Couple(p.vector if plane else turn @ p.vector, p.name)
        for p in system
    ]
    return System(*parts)
