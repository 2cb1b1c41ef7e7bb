"""Counterweights as the command line says them: crank:radius=80mm,mass=2kg."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from dalembert.errors import ModelError
from dalembert.units import Units, file_units, quantity

if TYPE_CHECKING:
    from dalembert.model import Mechanism

Range = tuple[float, float]
KINDS = {"radius": "length", "mass": "mass"}
RANGES = ("x", "y", "z")
DISC = ("density", "length", "length")


def bounds_of(m: Mechanism, text: str) -> tuple[str, dict[str, object]]:
    """A link with the bounds of its counterweight, in the units of the file."""
    link, _, rest = text.partition(":")
    units, bounds = file_units(m.units), dict[str, object]()
    for part in filter(None, rest.split(",")):
        key, equals, value = part.partition("=")
        if not equals:
            raise ModelError(f"--on {text}: {part!r} is not a bound", "write --on crank:radius=80mm,mass=2kg")
        if key == "disc":
            sizes = re.fullmatch(r"(.+)/([^/^]*)/([^/^]*)", value)
            if sizes is None:
                raise ModelError(
                    f"--on {text}: a disc is density/thickness/radius", "write disc=7800kg/m^3/20mm/80mm"
                )
            bounds[key] = tuple(
                quantity(v, kind, units) for v, kind in zip(sizes.groups(), DISC, strict=True)
            )
        elif key == "place":
            bounds[key] = tuple(quantity(v, "length", units) for v in value.split("/"))
        elif key in RANGES:
            bounds[key] = tuple(_moment(v, units) for v in value.split("/"))
        elif key == "moment":
            bounds[key] = _moment(value, units)
        else:
            bounds[key] = quantity(value, KINDS[key], units) if key in KINDS else value
    return link, bounds


def _moment(text: str, units: Units) -> float:
    """A mass times a length, kg m: 0.3kg*m, 2kg*80mm, or a number in the units of the file."""
    mass, _, length = text.partition("*")
    length = length if length[:1].isdigit() else f"1{length}"
    return quantity(mass, "mass", units) * quantity(length, "length", units)


def two_planes(m: Mechanism, planes: str, radii: str, on: object) -> tuple[Range, Range]:
    """The planes and the radii of a rotor's corrections, in the units of the file."""
    if on:
        raise ModelError(
            "--planes puts masses on a rotor, --on counterweights on links", "ask for one of both"
        )
    units, pairs = file_units(m.units), []
    for option, text in (("planes", planes), ("radii", radii)):
        numbers = [quantity(part, "length", units) for part in text.split(",") if part.strip()]
        numbers *= 2 if option == "radii" and len(numbers) == 1 else 1
        if len(numbers) != 2:
            raise ModelError(
                f"--{option} has {len(numbers)} lengths, not two", f"write --{option} 50mm,450mm"
            )
        pairs.append((numbers[0], numbers[1]))
    return pairs[0], pairs[1]


def sum_of(text: str) -> str | dict[str, float]:
    """Objective: a word, or parts with their weights."""
    if "=" not in text:
        return text
    try:
        return {name: float(value) for name, value in (part.split("=") for part in text.split(","))}
    except ValueError:
        raise ModelError(f"--of {text} is not a sum", "write --of force=1,torque=0.5") from None
