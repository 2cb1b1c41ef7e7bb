"""The answers a file claims for itself, to be compared with what is computed."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, Literal

from pydantic import Field, ValidationInfo, field_validator, model_validator

from dalembert.errors import ModelError
from dalembert.model.part import Part
from dalembert.wording import quote_value

_WITHOUT_RATES = """friction_force friction_moment power_lost normal power transmission closure pressure flow
screw_torque lower_face upper_face energy_fluctuation shaking_moment mass stress fatigue
buckling deflection bearing_slope life pin_stress play"""
NAMES = {
    "effort": "effort.{of}",
    "effort_low": "effort.{of}.low",
    "effort_high": "effort.{of}.high",
    "unknown_load": "load.{of}",
    "unknown_load_low": "load.{of}.low",
    "unknown_load_high": "load.{of}.high",
    "reaction": "reaction.{of}",
    "moment": "reaction_moment.{of}",
    **{
        f"{word}_{end}": f"{word}.{{of}}.{end}"
        for word in ("reaction", "reaction_moment")
        for end in ("low", "high")
    },
    "drive": "drive.{of}",
    "drive_speed": "drive.{of}.speed",
    "drive_acceleration": "drive.{of}.acceleration",
    "angle": "angle.{of}",
    "speed": "angle.{of}.speed",
    "acceleration": "angle.{of}.acceleration",
    "rotation": "rotation.{of}",
    "position": "point.{of}.origin",
    "velocity": "point.{of}.origin.velocity",
    "center": "point.{of}.center",
    "center_velocity": "point.{of}.center.velocity",
    "center_acceleration": "point.{of}.center.acceleration",
    "point": "point.{of}",
    "point_velocity": "point.{of}.velocity",
    "point_acceleration": "point.{of}.acceleration",
    **{
        freedom + rate: f"{freedom}.{{of}}{rate.replace('_', '.')}"
        for freedom in ("slide", "slide1", "slide2", "turn", "turn1", "turn2")
        for rate in ("", "_speed", "_acceleration")
    },
    **{word: f"{word}.{{of}}" for word in _WITHOUT_RATES.split()},
    "play_worst": "play.{of}.worst",
    "turning_speed_low": "turning_speed.low",
    "turning_speed_high": "turning_speed.high",
    **{word: word for word in ("turning_speed", "turning_torque")},
    **{word: word for word in ("shaking_force", "shaking_couple", "residual", "power_balance", "time")},
}
"""Words of format version 1 for quantities, with the names they mean (docs/quantities.md)."""

QUANTITIES = (*NAMES, "status", "count", "mobility", "redundant", "stability")
"""Quantities an answer may have: numbers of a position or of the mechanism, and words."""

if TYPE_CHECKING:
    Quantity = str
else:
    Quantity = Literal[QUANTITIES]


class StatedAnswer(Part):
    """One claimed value; numbers and texts stay as written, in the file's units.

    >>> StatedAnswer(quantity="effort", of="O2", value="243.23 lbf*in", tolerance="0.01 %").of
    'O2'
    """

    quantity: Quantity = Field(description="what is claimed")
    of: str | None = Field(
        None, description="of which joint, drive, load, link or link.point; about which point"
    )
    on: str | None = Field(None, description="the link a reaction acts on; default the joint's j")
    by: str | None = Field(None, description="the link a reaction is exerted by")
    at: object = Field(None, description="position: its number from 1, or the drive's value as text")
    extreme: Literal["max", "min", "maxabs"] | None = Field(
        None, description="over all positions, instead of at"
    )
    component: Literal["x", "y", "z", "magnitude", "direction"] | None = Field(
        None, description="of a vector; default the full vector"
    )
    axes: Literal["ground", "link", "joint"] = Field(
        "ground",
        description="axes of a vector: the ground's, those of the link acted on, in space the joint's",
    )
    value: object = Field(
        None,
        description="as published: number, text with unit, [x, y], r @ angle, [x, y, z], 3 rows, a status",
    )
    exact: object = Field(None, description="the exact value, computed independently; checked to 1e-7")
    tolerance: object = Field(None, description="relative, 0.3 %, or a quantity; default 1e-6 relative")
    exact_tolerance: object = Field(None, description="instead of 1e-7 relative")
    why: str | None = Field(None, description="the reason of the tolerance")

    @model_validator(mode="before")
    @classmethod
    def _from_name(cls, keys: Any) -> Any:
        """A name such as `reaction.A.x` as quantity, of and component."""
        if not isinstance(keys, dict) or "." not in str(keys.get("quantity")):
            return keys
        return {**keys, **parts_of_name(str(keys["quantity"]))}

    @property
    def name(self) -> str:
        """The name of the quantity, without its component: `angle.rod.speed`."""
        return NAMES[self.quantity].format(of=self.of or "").rstrip(".")

    @field_validator("value", "exact", "at", "tolerance", "exact_tolerance")
    @classmethod
    def _plain(cls, value: object, info: ValidationInfo) -> object:
        for item in value if isinstance(value, (list, tuple)) else (value,):
            rows = info.field_name in ("value", "exact") and isinstance(item, (list, tuple))
            for number in item if rows else (item,):
                _check_plain(number)
        return _frozen(value)


_COMPONENTS = ("x", "y", "z", "magnitude", "direction")


def parts_of_name(name: str) -> dict[str, str]:
    """The keys of an answer for the name of a quantity.

    >>> parts_of_name("point.rod.center.velocity.x")
    {'quantity': 'center_velocity', 'of': 'rod', 'component': 'x'}
    >>> parts_of_name("shaking_force.x")
    {'quantity': 'shaking_force', 'component': 'x'}
    >>> parts_of_name("speed.rod") == parts_of_name("angle.rod.speed")
    True
    """
    stem, _, last = name.rpartition(".")
    part = {"component": last} if last in _COMPONENTS and ("." in stem or NAMES.get(stem) == stem) else {}
    fits = {
        word: re.fullmatch(re.escape(form).replace(r"\{of\}", "(.+)"), stem if part else name)
        for word, form in NAMES.items()
    }
    keys = {word: "".join(match.groups()) for word, match in fits.items() if match}
    word, _, of = (stem if part else name).partition(".")
    keys = keys or ({word: of} if word in NAMES and of else {})  # in the words of the first format
    if not keys:
        raise ModelError(
            f"unknown quantity {name!r}",
            "write effort.NAME, reaction.NAME.x or another of docs/quantities.md",
        )
    best = min(keys, key=lambda word: len(keys[word]))
    return {"quantity": best, **({"of": keys[best]} if keys[best] else {}), **part}


def _frozen(value: object) -> object:
    return tuple(_frozen(item) for item in value) if isinstance(value, (list, tuple)) else value


def _check_plain(item: object) -> None:
    if item is not None and (isinstance(item, bool) or not isinstance(item, (int, float, str))):
        raise ModelError(
            f"{quote_value(item)} is not a value", "write a number, a text with its unit, or a list of them"
        )
    if isinstance(item, float) and not math.isfinite(item):
        raise ModelError(f"{quote_value(item)} is not a finite number", "write a finite one, or leave it out")
