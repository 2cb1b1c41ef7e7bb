"""Random masses, gravity and loads of a drawing."""

from __future__ import annotations

import numpy as np

from tests.random_space.drawing import BALLS, PAIRS, Array, Drawing, Load, Mass
from tests.random_space.groups import place


def masses(d: Drawing, rng: np.random.Generator) -> None:
    """Of most links; a rod's lies on its line, and is the same about all axes across it."""
    for link in d.poses:
        if link == "ground" or rng.random() < 0.2 or _slides_in(d, link):
            continue
        mass = float(rng.uniform(0.1, 3))
        if link in d.rods:
            a, b = d.rods[link]
            u = (b - a) / np.linalg.norm(b - a)
            inertia = rng.uniform(0.05, 0.3) * (np.eye(3) - 0.9 * np.outer(u, u))
            d.masses[link] = Mass(mass, a + rng.uniform(0, 1) * (b - a), inertia)
        else:
            d.masses[link] = Mass(mass, place(rng), cloud(rng, float(rng.uniform(0.02, 0.6))))
    d.gravity = np.array([0.0, 0.0, -9.80665]) if rng.random() < 0.5 else rng.uniform(-10, 10, 3)


def _slides_in(d: Drawing, link: str) -> bool:
    """Whether the line that a rod may spin about moves in it: a ball slides in the rod's own guide."""
    return link in d.rods and any(j.i == link and PAIRS[j.type].slides for j in d.joints.values())


def cloud(rng: np.random.Generator, size: float) -> Array:
    """Inertia of some points, so that it is one a body can have."""
    points = rng.normal(size=(8, 3)) * [1.0, 0.7, 0.4]
    points -= points.mean(0)
    full = np.eye(3) * np.sum(points**2) - points.T @ points
    full *= size / np.trace(full)
    return np.asarray(0.5 * (full + full.T))


def loads(d: Drawing, rng: np.random.Generator) -> None:
    links = [name for name in d.poses if name != "ground" and name not in d.rods]
    for k in range(int(rng.integers(1, 5))):
        on = links[int(rng.integers(len(links)))]
        follows, along = bool(rng.random() < 0.4), bool(rng.random() < 0.3)
        at = d.spot(on, place(rng))
        d.loads[f"F{k}"] = Load(
            "force", (on, at), vector=rng.uniform(-50, 50, 3), follows=follows, along=along
        )
    for k in range(int(rng.integers(0, 3))):
        on = links[int(rng.integers(len(links)))]
        follows, along = bool(rng.random() < 0.4), bool(rng.random() < 0.5)
        d.loads[f"C{k}"] = Load(
            "couple", (on, ""), vector=rng.uniform(-20, 20, 3), follows=follows, along=along
        )
    for kind in ("spring", "damper"):
        if rng.random() < 0.5:
            _line_load(d, rng, kind)
    turning = [name for name, j in d.joints.items() if PAIRS[j.type].freedoms[-1:] == ("turn",)]
    turning = [name for name in turning if d.joints[name].type not in BALLS]
    for kind in ("torsion_spring", "torsion_damper"):
        if turning and rng.random() < 0.5:
            joint = turning[int(rng.integers(len(turning)))]
            value, free = float(rng.uniform(1, 20)), float(rng.uniform(-1, 1))
            d.loads[kind] = Load(kind, joint=joint, value=value, free=free)


def _line_load(d: Drawing, rng: np.random.Generator, kind: str) -> None:
    links = [name for name in d.poses if name not in d.rods]
    a, b = (links[int(rng.integers(len(links)))] for _ in range(2))
    p, r = place(rng), place(rng)
    if a == b or np.linalg.norm(p - r) < 0.3:
        return
    ends = (a, d.spot(a, p)), (b, d.spot(b, r))
    kind = "constant_force_spring" if kind == "spring" and d.seed % 3 == 0 else kind
    d.loads[kind] = Load(kind, *ends, value=float(rng.uniform(1, 50)), free=float(rng.uniform(0, 1)))
