"""Masses of MJCF geoms: volume, mass and inertia of the simple solids, as MuJoCo computes them."""

from __future__ import annotations

import math

import numpy as np

from dalembert.arrays import Array
from dalembert.interchange.placements import along, placement
from dalembert.interchange.xml_tree import Element

DENSITY = 1000.0
"""kg/m3, of a geom without mass or density."""

MASSLESS = ("plane", "hfield")
"""Types that only a fixed body has."""

SIZES = {"sphere": 1, "capsule": 2, "cylinder": 2, "box": 3, "ellipsoid": 3}
"""Type -> numbers of its size."""


def geom_sizes(geom: Element, attributes: dict[str, str], kind: str) -> tuple[list[float], Array | None]:
    """Radii and half lengths, and the place where ``fromto`` gives it."""
    size = geom.numbers(attributes.get("size", ""), what="size of <geom>")
    if "fromto" not in attributes or kind == "sphere":
        if len(size) < SIZES[kind]:
            raise geom.error(f"a geom of type {kind} has {len(size)} sizes", f"give {SIZES[kind]}")
        return size, None
    ends = np.array(geom.numbers(attributes["fromto"], 6, "fromto of <geom>")).reshape(2, 3)
    line = ends[1] - ends[0]
    half = float(np.linalg.norm(line)) / 2
    if not size or half == 0:
        raise geom.error("a geom with fromto needs a size and two different ends", "give size and fromto")
    place = placement(along("z", line), ends.mean(axis=0))
    return ([size[0], size[0], half] if kind in ("box", "ellipsoid") else [size[0], half]), place


def volume(kind: str, size: list[float]) -> float:
    """Volume of a solid, m3."""
    if kind == "sphere":
        return 4 / 3 * math.pi * size[0] ** 3
    if kind == "capsule":
        return math.pi * size[0] ** 2 * (2 * size[1] + 4 / 3 * size[0])
    if kind == "cylinder":
        return 2 * math.pi * size[0] ** 2 * size[1]
    product = size[0] * size[1] * size[2]
    return 8 * product if kind == "box" else 4 / 3 * math.pi * product


def principal_inertia(kind: str, size: list[float], mass: float) -> Array:
    """Principal moments (3,) about the centre; the axis of a capsule or cylinder is z."""
    if kind in ("box", "ellipsoid"):
        squares = np.square(size[:3])
        return np.asarray(mass / (3 if kind == "box" else 5) * (squares.sum() - squares))
    r = size[0]
    if kind == "sphere":
        return np.full(3, 0.4 * mass * r * r)
    h = 2 * size[1]
    if kind == "cylinder":
        across = mass * (3 * r * r + h * h) / 12
        return np.array([across, across, mass * r * r / 2])
    middle = mass * h / (h + 4 / 3 * r)
    ends = mass - middle
    across = middle * (3 * r * r + h * h) / 12 + 0.4 * ends * r * r + ends * h * (3 * r + 2 * h) / 8
    return np.array([across, across, middle * r * r / 2 + 0.4 * ends * r * r])


def combined(masses: list[tuple[float, Array, Array]]) -> tuple[float, Array, Array]:
    """Mass, centre and inertia about it of masses, each with its centre and inertia (3, 3) in the same axes."""
    mass = sum(m for m, _, _ in masses)
    if not mass:
        return 0.0, np.zeros(3), np.zeros((3, 3))
    center = sum((m * c for m, c, _ in masses), np.zeros(3)) / mass
    inertia = np.zeros((3, 3))
    for m, c, about in masses:
        arm = c - center
        inertia += about + m * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return mass, center, inertia
