"""Numbers, vectors and directions as users write them: SI numbers, or texts with units as in a model file."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model.part import ReadingRules
from dalembert.model.quantities.figures import unit_vector
from dalembert.model.quantities.values import vector as components_of
from dalembert.units import Units, file_units, quantity
from dalembert.wording import quote_value

Number = float | int | str
Vector = Sequence[Number] | Array | str
UnitNames = Units | dict[str, str] | None


LARGEST = 1e60
"""Largest number in SI, for a moment its square: products of a few stay finite."""


def number(value: object, kind: str, units: UnitNames = None) -> float:
    """A number in SI: bare numbers are SI and radians, or in `units`; a bare angle within a text is in degrees.

    >>> number(2.5, "force"), number("2 kN", "force"), number("180", "angle")
    (2.5, 2000.0, 3.141592653589793)
    """
    plain = value.item() if isinstance(value, np.generic) else value
    read = quantity(plain, kind, _rules(plain, units))
    largest = LARGEST**2 if kind == "moment" else LARGEST
    if abs(read) > largest:
        raise ModelError(f"{quote_value(plain)} is too large", f"write a number below {largest:g}")
    return read


def vector(value: Vector, kind: str, units: UnitNames = None, dimension: int | None = None) -> Array:
    """The components of a vector in SI, read-only: a list, an array, `"600 @ 50 N"` or `"[1 in, 20 mm]"`.

    >>> vector("2 kN @ 90", "force")
    array([   0., 2000.])
    """
    if isinstance(value, str) and "@" in value:
        parts = components_of(value, kind, ReadingRules(_rules(value, units), dimension=dimension))
        return read_only([number(x, kind) for x in parts])
    if isinstance(value, str):
        items: Sequence[object] = _items(value)
        units = _rules(value, units)
    else:
        items = value.tolist() if isinstance(value, np.ndarray) else value
    _count(items, dimension)
    return read_only([number(item, kind, units) for item in items])


def direction(value: Vector | Number, dimension: int | None = None) -> Array:
    """A unit vector along a vector of any length; in the plane also an angle from the x axis.

    >>> direction([0, 0, 2]), direction("90 deg")
    (array([0., 0., 1.]), array([0., 1.]))
    """
    one = isinstance(value, (int, float, np.floating)) or (
        isinstance(value, str) and "[" not in value and "@" not in value
    )
    if one and dimension in (None, 2):
        return read_only(unit_vector(number(value, "angle")))
    if one:
        raise ModelError(f"{quote_value(value)} is not a direction in space", "write [x, y, z]")
    along = vector(value, "number", dimension=dimension)  # type: ignore[arg-type]
    length = math.hypot(*along)
    if length == 0:
        raise ModelError("a vector of length 0 has no direction", "write one along the line")
    return read_only(along / length)


def read_only(values: ArrayLike) -> Array:
    """A read-only array without negative zeros."""
    out = np.array(values, float) + 0.0
    out.setflags(write=False)
    return out


def _rules(value: object, units: UnitNames) -> Units | None:
    if units is None:
        return Units() if isinstance(value, str) else None
    return file_units(units)


def _items(text: str) -> list[str]:
    inside = text.strip()
    if not (inside.startswith("[") and inside.endswith("]")):
        raise ModelError(f"{quote_value(text)} is not a vector", "write [x, y] or polar text r @ angle")
    return [item.strip() for item in inside[1:-1].split(",")]


def _count(items: object, dimension: int | None) -> None:
    if not isinstance(items, Sequence):
        raise ModelError(f"{quote_value(items)} is not a vector", "write [x, y] or [x, y, z]")
    wanted = (2, 3) if dimension is None else (dimension,)
    if len(items) not in wanted:
        places = "2 or 3" if dimension is None else str(dimension)
        raise ModelError(
            f"a vector has {len(items)} components where {places} are needed",
            "the plane takes [x, y], space [x, y, z], in all parts of one system",
        )


def cosines(angles: Sequence[Number]) -> Array:
    """Direction cosines from the angles to the x, y and z axes; their squares must add to 1 within a hundredth.

    >>> cosines(["60 deg", "45 deg", "120 deg"]).round(3)
    array([ 0.5  ,  0.707, -0.5  ])
    """
    _count(angles, 3)
    cosine = np.array([math.cos(number(a, "angle")) for a in angles])
    total = float(cosine @ cosine)
    if abs(total - 1.0) > 0.01:
        raise ModelError(
            f"the squares of the three direction cosines add to {total:.4g}, not to 1",
            "two angles leave two values for the third: check them",
        )
    return read_only(cosine / math.sqrt(total))
