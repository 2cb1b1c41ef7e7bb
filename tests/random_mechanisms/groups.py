"""Groups of links that a drawing grows by: a driven link, dyads, links with slots, wheels in mesh and rolling."""

from __future__ import annotations

from math import pi

import numpy as np

from tests.random_mechanisms.drawing import Drawing, Drive, Point, beside

POSITIONS = 3

ROUND = 5000
"""Seeds from which on a link alone has a circular slot in place of a straight one."""


def _link(d: Drawing, rng: np.random.Generator, near: Point) -> str:
    """A link with axes anywhere near a place."""
    name = f"L{len(d.poses)}"
    d.poses[name] = (near[0] + rng.uniform(-0.5, 0.5), near[1] + rng.uniform(-0.5, 0.5), rng.uniform(-3, 3))
    d.spots[name] = {}
    return name


def some(d: Drawing, rng: np.random.Generator, last: int = 6) -> str:
    """An existing link, rather one of the last."""
    names = list(d.poses)
    return names[int(rng.integers(max(0, len(names) - last), len(names)))] if rng.random() < 0.8 else "ground"


def place(rng: np.random.Generator) -> Point:
    return float(rng.uniform(-1, 1)), float(rng.uniform(-1, 1))


def _joined(d: Drawing, rng: np.random.Generator, type_: str, i: str, j: str, p: Point) -> str:
    """A pin or slide at p, with i and j in either order; a slide's points lie apart."""
    if rng.random() < 0.5:
        i, j = j, i
    damping = float(rng.uniform(0.1, 2.0)) if rng.random() < 0.2 and type_ != "weld" else 0.0
    if type_ not in ("slider", "slot", "circular_slot"):
        return d.join(type_, i, j, p, damping=damping)
    direction, away = float(rng.uniform(-3, 3)), float(rng.uniform(-0.5, 0.5))
    if type_ == "circular_slot":
        radius = 0.1 + abs(away)
        return d.join(type_, i, j, p, beside(p, radius, direction), radii=(radius, 0.0), damping=damping)
    return d.join(type_, i, j, p, beside(p, away, direction), direction=direction, damping=damping)


def driven(d: Drawing, rng: np.random.Generator) -> None:
    """One link on a driven pin, slide or (two drives) slot."""
    p, base = place(rng), some(d, rng)
    type_ = ("pin", "pin", "pin", "slider", "slot")[int(rng.integers(5))]
    joint = _joined(d, rng, type_, base, _link(d, rng, p), p)
    freedoms = {"pin": ["turn"], "slider": ["slide"], "slot": ["slide", "turn"]}[type_]
    for freedom in freedoms:
        name = joint if len(freedoms) == 1 else f"{joint}_{freedom}"
        size = 0.01 if freedom == "turn" else 0.005
        steps = (0.0, *np.cumsum(rng.uniform(0.3, 1.0, POSITIONS - 1) * size).tolist())
        speed = float(rng.choice([-1, 1]) * rng.uniform(0.5, 2))
        d.drives[name] = Drive(joint, freedom, steps, speed, float(rng.uniform(-5, 5)))


def dyad(d: Drawing, rng: np.random.Generator) -> None:
    """Two links between two others, by three pins or slides of which at least one is a pin."""
    a, b = some(d, rng), some(d, rng)
    if a == b:
        return
    p, middle, r = place(rng), place(rng), place(rng)
    kinds = [("pin", "slider")[int(rng.random() < 0.3)] for _ in range(3)]
    if "pin" not in kinds:
        return
    first, second = _link(d, rng, p), _link(d, rng, r)
    for kind, i, j, at in zip(kinds, (a, first, second), (first, second, b), (p, middle, r), strict=True):
        _joined(d, rng, kind, i, j, at)


def single(d: Drawing, rng: np.random.Generator) -> None:
    """One link: a pin or slide on one and a slot, straight or round, with another, or three slots."""
    a, b, c = some(d, rng), some(d, rng), some(d, rng)
    if a == b:
        return
    p = place(rng)
    link = _link(d, rng, p)
    if rng.random() < 0.15:
        for other in (a, b, c):
            _joined(d, rng, "slot", other, link, place(rng))
        return
    _joined(d, rng, ("pin", "slider")[int(rng.random() < 0.4)], a, link, p)
    _joined(d, rng, "circular_slot" if d.seed % 1_000_000 >= ROUND else "slot", b, link, place(rng))


def welded(d: Drawing, rng: np.random.Generator) -> None:
    if rng.random() < 0.3:
        p = place(rng)
        _joined(d, rng, "weld", some(d, rng), _link(d, rng, p), p)


def wheels(d: Drawing, rng: np.random.Generator) -> None:
    """A wheel pinned to the carrier of another pinned link, and the mesh (or rolling circle's row) of the two."""
    pins = [j for j in d.joints.values() if j.type == "pin"]
    if not pins:
        return
    pin = pins[int(rng.integers(len(pins)))]
    carrier, wheel = (pin.i, pin.j) if rng.random() < 0.5 else (pin.j, pin.i)
    if wheel == "ground":
        return
    center = d.spots[pin.i][pin.at_i]
    ri, rj = (float(x) for x in rng.uniform(0.2, 0.5, 2))
    internal = rng.random() < 0.3 and abs(ri - rj) > 0.1
    p = beside(center, abs(ri - rj) if internal else ri + rj, float(rng.uniform(-3, 3)))
    new = _link(d, rng, p)
    _joined(d, rng, "pin", carrier, new, p)
    pressure = float(rng.uniform(10, 25))
    d.join("gear", wheel, new, center, p, radii=(ri, rj), internal=internal, pressure=pressure)


def rolling(d: Drawing, rng: np.random.Generator) -> None:
    """A wheel that rolls on a rail or circle of one link, held by a rod (pin and pin) to another."""
    a, b = some(d, rng), some(d, rng)
    if a == b:
        return
    p, r = place(rng), place(rng)
    direction, radius = float(rng.uniform(-3, 3)), float(rng.uniform(0.1, 0.5))
    wheel, rod = _link(d, rng, p), _link(d, rng, r)
    if rng.random() < 0.7:
        foot = beside(p, -radius, direction + pi / 2)
        d.join(
            "rolling",
            a,
            wheel,
            beside(foot, float(rng.uniform(-1, 1)), direction),
            p,
            direction=direction,
            radii=(0.0, radius),
        )
    else:
        inner = float(rng.uniform(0.2, 0.5))
        d.join("rolling", a, wheel, beside(p, radius + inner, direction), p, radii=(inner, radius))
    _joined(
        d, rng, "pin", wheel, rod, beside(p, radius * float(rng.uniform(0, 0.8)), float(rng.uniform(-3, 3)))
    )
    _joined(d, rng, "pin", rod, b, r)
