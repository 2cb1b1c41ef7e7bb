"""Random masses, gravity and loads of a drawing."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np

from tests.random_mechanisms.drawing import Drawing, Load, gap
from tests.random_mechanisms.groups import place, some


def masses(d: Drawing, rng: np.random.Generator) -> None:
    for link in d.poses:
        if link != "ground" and rng.random() < 0.8:
            d.masses[link] = float(rng.uniform(0.1, 3)), place(rng), float(rng.uniform(0.01, 0.5))
    size, direction = (
        (9.80665, -pi / 2) if rng.random() < 0.5 else (float(rng.uniform(0, 20)), float(rng.uniform(-3, 3)))
    )
    d.gravity = size * cos(direction), size * sin(direction)


def loads(d: Drawing, rng: np.random.Generator) -> None:
    links = [name for name in d.poses if name != "ground"]
    for k in range(int(rng.integers(1, 5))):
        on = links[int(rng.integers(len(links)))]
        at = d.spot(on, place(rng))
        d.loads[f"F{k}"] = Load(
            "force", (on, at), vector=tuple(rng.uniform(-50, 50, 2)), follows=bool(rng.random() < 0.4)
        )
    if rng.random() < 0.6:
        d.loads["C"] = Load(
            "couple", (links[int(rng.integers(len(links)))], ""), value=float(rng.uniform(-20, 20))
        )
    for kind in ("spring", "damper"):
        if rng.random() < 0.5:
            _line_load(d, rng, kind)
    pins = [name for name, j in d.joints.items() if j.type == "pin"]
    for kind in ("torsion_spring", "torsion_damper"):
        if pins and rng.random() < 0.4:
            joint = pins[int(rng.integers(len(pins)))]
            value, free = float(rng.uniform(1, 20)), float(rng.uniform(-1, 1))
            d.loads[kind] = Load(kind, joint=joint, value=value, free=free)


def _line_load(d: Drawing, rng: np.random.Generator, kind: str) -> None:
    a, b = some(d, rng, 20), some(d, rng, 20)
    p, r = place(rng), place(rng)
    if a == b or gap(p, r)[0] < 0.3:
        return
    ends = (a, d.spot(a, p)), (b, d.spot(b, r))
    kind = "constant_force_spring" if kind == "spring" and d.seed % 3 == 0 else kind
    d.loads[kind] = Load(kind, *ends, value=float(rng.uniform(1, 50)), free=float(rng.uniform(0, 1)))
