"""The answers a file claims for itself, to be compared with what is computed."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

from pydantic import Field, ValidationInfo, field_validator

from dalembert.errors import ModelError
from dalembert.model.part import Part
from dalembert.wording import quote_value

_NAMES = """
effort reaction moment unknown_load position velocity angle rotation speed acceleration center center_velocity
center_acceleration point point_velocity point_acceleration drive slide slide1 slide2 turn turn1 turn2 effort_low
effort_high unknown_load_low unknown_load_high friction_force friction_moment power_lost shaking_force shaking_moment
shaking_couple energy_fluctuation lower_face upper_face residual power_balance status count mobility redundant stability
"""
RATES = ("", "_speed", "_acceleration")
"""What freedoms, slides and turns, have behind their names besides."""

QUANTITIES = tuple(
    name + rate for name in _NAMES.split() for rate in (RATES if name.startswith(("slide", "turn")) else [""])
)
"""Whatever may be claimed: numbers of a position or of the mechanism, and words."""

if TYPE_CHECKING:
    Quantity = str
else:
    Quantity = Literal[QUANTITIES]


class Answer(Part):
    """One claimed value; numbers and texts stay as written, in the file's units.

    >>> Answer(quantity="effort", of="O2", value="243.23 lbf*in", tolerance="0.01 %").of
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
        None, description="over all positions, in place of at"
    )
    component: Literal["x", "y", "z", "magnitude", "direction"] | None = Field(
        None, description="of a vector; without it the whole vector"
    )
    axes: Literal["ground", "link", "joint"] = Field(
        "ground",
        description="the axes of a vector: ground's, the link's (acted on), in space the joint's own",
    )
    value: object = Field(
        None,
        description="as published: number, text with unit, [x, y], r @ angle, [x, y, z], 3 rows, a status",
    )
    exact: object = Field(None, description="the exact value, computed independently; checked to 1e-7")
    tolerance: object = Field(None, description="relative, 0.3 %, or a quantity; default 1e-6 relative")
    exact_tolerance: object = Field(None, description="in place of 1e-7 relative")
    why: str | None = Field(None, description="the reason of the tolerance")

    @field_validator("value", "exact", "at", "tolerance", "exact_tolerance")
    @classmethod
    def _plain(cls, value: object, info: ValidationInfo) -> object:
        for item in value if isinstance(value, (list, tuple)) else (value,):
            rows = info.field_name in ("value", "exact") and isinstance(item, (list, tuple))
            for number in item if rows else (item,):
                _check_plain(number)
        return _frozen(value)


def _frozen(value: object) -> object:
    return tuple(_frozen(item) for item in value) if isinstance(value, (list, tuple)) else value


def _check_plain(item: object) -> None:
    if item is not None and (isinstance(item, bool) or not isinstance(item, (int, float, str))):
        raise ModelError(
            f"{quote_value(item)} is no value", "write a number, a text with its unit, or a list of them"
        )
    if isinstance(item, float) and not math.isfinite(item):
        raise ModelError(f"{quote_value(item)} is no finite number", "write a finite one, or leave it out")
