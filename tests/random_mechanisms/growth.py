"""Growing a drawing: each step adds a driven link, or a group that closes on two links and adds no freedom."""

from __future__ import annotations

from contextlib import suppress
from copy import deepcopy
from functools import lru_cache
from math import cos, pi, sin
from typing import NamedTuple

import numpy as np

from tests.oracles import lagrange
from tests.random_mechanisms.drawing import Drawing, Drive, Load, Point, beside, gap
from tests.random_mechanisms.writing import Tree, pose_array, tree

POSITIONS = 3
CONDITION = 300.0
"""Of the constraints' Jacobian with lengths on the machine's scale; a group that makes it worse is drawn again."""


def random_mechanism(seed: int, links: tuple[int, int] = (4, 20), loads: bool = True) -> Drawing:
    """A drawing with about as many links as drawn from ``links``; the same for the same seed."""
    rng = np.random.default_rng(seed)
    wanted = int(rng.integers(links[0], links[1] + 1))
    d = Drawing(seed=seed)
    _driven(d, rng)
    while len(d.poses) - 1 < wanted:
        d = _grown(d, rng)
    _masses(d, rng)
    if loads:
        _loads(d, rng)
    return d


class Case(NamedTuple):
    """A random mechanism with its tree in SI and the oracle's answer."""

    drawing: Drawing
    tree: Tree
    answer: lagrange.Answer


@lru_cache(maxsize=256)
def random_case(seed: int) -> Case:
    """The mechanism of a seed, well conditioned at all its positions (or else that of a later seed)."""
    for k in range(20):
        d = random_mechanism(seed + 1_000_000 * k)
        made = tree(d)
        with suppress(ArithmeticError, np.linalg.LinAlgError):
            answer = lagrange.solve(made, pose_array(d))
            if answer.condition < 2 * CONDITION:
                return Case(d, made, answer)
    raise RuntimeError(f"seed {seed}: no well-conditioned mechanism")


def _grown(d: Drawing, rng: np.random.Generator) -> Drawing:
    """The drawing with one more group, well conditioned at its positions."""
    steps = [_driven, _dyad, _dyad, _dyad, _single, _single, _wheels, _rolling, _welded]
    for _ in range(200):
        trial = deepcopy(d)
        steps[int(rng.integers(len(steps)))](trial, rng)
        if len(trial.joints) > len(d.joints) and _sound(trial):
            return trial
    raise RuntimeError(f"seed {d.seed}: no group fits")


def _sound(d: Drawing) -> bool:
    try:
        condition, v, a = lagrange.quality(tree(d), pose_array(d)[:1])
    except np.linalg.LinAlgError:
        return False
    return condition < CONDITION and np.max(np.abs(v)) < 10 and np.max(np.abs(a)) < 100


def _link(d: Drawing, rng: np.random.Generator, near: Point) -> str:
    """A link with axes anywhere near a place."""
    name = f"L{len(d.poses)}"
    d.poses[name] = (near[0] + rng.uniform(-0.5, 0.5), near[1] + rng.uniform(-0.5, 0.5), rng.uniform(-3, 3))
    d.spots[name] = {}
    return name


def _some(d: Drawing, rng: np.random.Generator, last: int = 6) -> str:
    """An existing link, rather one of the last."""
    names = list(d.poses)
    return names[int(rng.integers(max(0, len(names) - last), len(names)))] if rng.random() < 0.8 else "ground"


def _place(rng: np.random.Generator) -> Point:
    return float(rng.uniform(-1, 1)), float(rng.uniform(-1, 1))


def _joined(d: Drawing, rng: np.random.Generator, type_: str, i: str, j: str, p: Point, **more: float) -> str:
    """A pin or slide at p, with i and j in either order; a slide's points lie apart."""
    if rng.random() < 0.5:
        i, j = j, i
    damping = float(rng.uniform(0.1, 2.0)) if rng.random() < 0.2 and type_ != "weld" else 0.0
    if type_ not in ("slider", "slot"):
        return d.join(type_, i, j, p, damping=damping, **more)
    direction = float(more.get("direction", rng.uniform(-3, 3)))
    return d.join(type_, i, j, p, beside(p, float(rng.uniform(-0.5, 0.5)), direction), direction=direction, damping=damping)


def _driven(d: Drawing, rng: np.random.Generator) -> None:
    """One link on a driven pin, slide or (two drives) slot."""
    p, base = _place(rng), _some(d, rng)
    type_ = ("pin", "pin", "pin", "slider", "slot")[int(rng.integers(5))]
    joint = _joined(d, rng, type_, base, _link(d, rng, p), p)
    freedoms = {"pin": ["turn"], "slider": ["slide"], "slot": ["slide", "turn"]}[type_]
    for freedom in freedoms:
        name = joint if len(freedoms) == 1 else f"{joint}_{freedom}"
        size = 0.01 if freedom == "turn" else 0.005
        steps = (0.0, *np.cumsum(rng.uniform(0.3, 1.0, POSITIONS - 1) * size).tolist())
        speed = float(rng.choice([-1, 1]) * rng.uniform(0.5, 2))
        d.drives[name] = Drive(joint, freedom, steps, speed, float(rng.uniform(-5, 5)))


def _dyad(d: Drawing, rng: np.random.Generator) -> None:
    """Two links between two others, by three pins or slides of which at least one is a pin."""
    a, b = _some(d, rng), _some(d, rng)
    if a == b:
        return
    p, middle, r = _place(rng), _place(rng), _place(rng)
    kinds = [("pin", "slider")[int(rng.random() < 0.3)] for _ in range(3)]
    if "pin" not in kinds:
        return
    first, second = _link(d, rng, p), _link(d, rng, r)
    for kind, i, j, at in zip(kinds, (a, first, second), (first, second, b), (p, middle, r), strict=True):
        _joined(d, rng, kind, i, j, at)


def _single(d: Drawing, rng: np.random.Generator) -> None:
    """One link: a pin or slide on one and a slot with another, or three slots."""
    a, b, c = _some(d, rng), _some(d, rng), _some(d, rng)
    if a == b:
        return
    p = _place(rng)
    link = _link(d, rng, p)
    if rng.random() < 0.15:
        for other in (a, b, c):
            _joined(d, rng, "slot", other, link, _place(rng))
        return
    _joined(d, rng, ("pin", "slider")[int(rng.random() < 0.4)], a, link, p)
    _joined(d, rng, "slot", b, link, _place(rng))


def _welded(d: Drawing, rng: np.random.Generator) -> None:
    if rng.random() < 0.3:
        p = _place(rng)
        _joined(d, rng, "weld", _some(d, rng), _link(d, rng, p), p)


def _wheels(d: Drawing, rng: np.random.Generator) -> None:
    """A wheel pinned to the carrier of another pinned link, and the mesh (or rolling circle's row) of the two."""
    pins = [j for j in d.joints.values() if j.type == "pin"]
    if not pins:
        return
    pin = pins[int(rng.integers(len(pins)))]
    carrier, wheel = (pin.i, pin.j) if rng.random() < 0.5 else (pin.j, pin.i)
    if "ground" == wheel:
        return
    center = d.spots[pin.i][pin.at_i]
    ri, rj = (float(x) for x in rng.uniform(0.2, 0.5, 2))
    internal = rng.random() < 0.3 and abs(ri - rj) > 0.1
    p = beside(center, abs(ri - rj) if internal else ri + rj, float(rng.uniform(-3, 3)))
    new = _link(d, rng, p)
    _joined(d, rng, "pin", carrier, new, p)
    pressure = float(rng.uniform(10, 25))
    d.join("gear", wheel, new, center, p, radii=(ri, rj), internal=internal, pressure=pressure)


def _rolling(d: Drawing, rng: np.random.Generator) -> None:
    """A wheel that rolls on a rail or circle of one link, held by a rod (pin and pin) to another."""
    a, b = _some(d, rng), _some(d, rng)
    if a == b:
        return
    p, r = _place(rng), _place(rng)
    direction, radius = float(rng.uniform(-3, 3)), float(rng.uniform(0.1, 0.5))
    wheel, rod = _link(d, rng, p), _link(d, rng, r)
    if rng.random() < 0.7:
        foot = beside(p, -radius, direction + pi / 2)
        d.join("rolling", a, wheel, beside(foot, float(rng.uniform(-1, 1)), direction), p, direction=direction, radii=(0.0, radius))
    else:
        inner = float(rng.uniform(0.2, 0.5))
        d.join("rolling", a, wheel, beside(p, radius + inner, direction), p, radii=(inner, radius))
    _joined(d, rng, "pin", wheel, rod, beside(p, radius * float(rng.uniform(0, 0.8)), float(rng.uniform(-3, 3))))
    _joined(d, rng, "pin", rod, b, r)


def _masses(d: Drawing, rng: np.random.Generator) -> None:
    for link in d.poses:
        if link != "ground" and rng.random() < 0.8:
            d.masses[link] = float(rng.uniform(0.1, 3)), _place(rng), float(rng.uniform(0.01, 0.5))
    size, direction = (9.80665, -pi / 2) if rng.random() < 0.5 else (float(rng.uniform(0, 20)), float(rng.uniform(-3, 3)))
    d.gravity = size * cos(direction), size * sin(direction)


def _loads(d: Drawing, rng: np.random.Generator) -> None:
    links = [name for name in d.poses if name != "ground"]
    for k in range(int(rng.integers(1, 5))):
        on = links[int(rng.integers(len(links)))]
        at = d.spot(on, _place(rng))
        d.loads[f"F{k}"] = Load("force", (on, at), vector=tuple(rng.uniform(-50, 50, 2)), follows=bool(rng.random() < 0.4))
    if rng.random() < 0.6:
        d.loads["C"] = Load("couple", (links[int(rng.integers(len(links)))], ""), value=float(rng.uniform(-20, 20)))
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
    a, b = _some(d, rng, 20), _some(d, rng, 20)
    p, r = _place(rng), _place(rng)
    if a == b or gap(p, r)[0] < 0.3:
        return
    ends = (a, d.spot(a, p)), (b, d.spot(b, r))
    d.loads[kind] = Load(kind, *ends, value=float(rng.uniform(1, 50)), free=float(rng.uniform(0, 1)))
