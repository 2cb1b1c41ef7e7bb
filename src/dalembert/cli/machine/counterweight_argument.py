"""Counterweights as the command line says them: crank:radius=80mm,mass=2kg."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dalembert.errors import ModelError
from dalembert.units import file_units, quantity

if TYPE_CHECKING:
    from dalembert.model import Mechanism

KINDS = {"radius": "length", "mass": "mass"}
DISC = ("density", "length", "length")


def bounds_of(m: Mechanism, text: str) -> tuple[str, dict[str, object]]:
    """A link with the bounds of its counterweight, in the units of the file."""
    link, _, rest = text.partition(":")
    units, found = file_units(m.units), dict[str, object]()
    for part in filter(None, rest.split(",")):
        key, equals, value = part.partition("=")
        if not equals:
            raise ModelError(f"--on {text}: {part!r} is no bound", "write --on crank:radius=80mm,mass=2kg")
        if key == "disc":
            sizes = value.split("/m^3/", 1)
            sizes = [f"{sizes[0]}/m^3", *sizes[1].split("/")] if len(sizes) > 1 else value.split("/")
            if len(sizes) != len(DISC):
                raise ModelError(
                    f"--on {text}: a disc is density/thickness/radius", "write disc=7800kg/m^3/20mm/80mm"
                )
            found[key] = tuple(quantity(v, kind, units) for v, kind in zip(sizes, DISC, strict=True))
        elif key == "moment":
            mass, _, length = value.partition("*")
            found[key] = quantity(mass, "mass", units) * quantity(length or "1", "length", units)
        else:
            found[key] = quantity(value, KINDS[key], units) if key in KINDS else value
    return link, found


def sum_of(text: str) -> str | dict[str, float]:
    """What is to be least: a word, or parts with their weights."""
    if "=" not in text:
        return text
    try:
        return {name: float(value) for name, value in (part.split("=") for part in text.split(","))}
    except ValueError:
        raise ModelError(f"--of {text} is no sum", "write --of force=1,torque=0.5") from None
