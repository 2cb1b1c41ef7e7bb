"""Contacts that only push: the joints that have one, its side, and the restitution of an impact."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationInfo

from dalembert.errors import ModelError
from dalembert.model.part import mapping, reading
from dalembert.model.quantities.values import JsonSchema, ValueField, at_item, object_schema
from dalembert.wording import closest, quote_value

MODES = ("holds", "pushes", "pulls")
EXAMPLE = "contact: pushes, or {pushes: true, restitution: 0.3}"


@dataclass(frozen=True, slots=True)
class ContactMode:
    """Force that a contact can carry: ``holds`` in both senses, ``pushes`` or ``pulls`` in one; restitution of an
    impact, 0 to 1."""

    mode: str = "holds"
    restitution: float = 0.0


class ContactValue(ValueField):
    """A contact: `holds`, `pushes` or `pulls`, or `{pushes: true, restitution: 0.3}`."""

    def read(self, value: object, info: ValidationInfo) -> ContactMode:
        if isinstance(value, ContactMode):
            return value
        if isinstance(value, str):
            if value not in MODES:
                raise ModelError(f"unknown contact {quote_value(value)}", closest(value, list(MODES)))
            return ContactMode(value)
        keys = mapping(value, [*MODES, "restitution"], EXAMPLE)
        modes = [mode for mode in MODES if keys.get(mode)]
        wrong = next((mode for mode in MODES if not isinstance(keys.get(mode, False), bool)), None)
        if wrong:
            raise ModelError(
                f"{quote_value(keys[wrong])} is neither true nor false", f"write {wrong}: true", (wrong,)
            )
        if len(modes) != 1:
            raise ModelError("it must be exactly one of holds, pushes and pulls", f"write {EXAMPLE}")
        back = at_item("restitution", reading(info).quantity, keys.get("restitution", 0.0), "number")
        if not 0 <= back <= 1:
            what = f"{back:g} is not a ratio of the speeds after and before an impact"
            raise ModelError(what, "write a number from 0 (no rebound) to 1 (no loss)", ("restitution",))
        return ContactMode(modes[0], back)

    def write(self, value: ContactMode) -> object:
        return {value.mode: True, "restitution": value.restitution} if value.restitution else value.mode

    def json_schema(self) -> JsonSchema:
        restitution = {
            "type": "number",
            "minimum": 0,
            "maximum": 1,
            "description": "ratio of the speeds after and before an impact",
        }
        modes = {mode: {"type": "boolean", "description": f"true: it {mode}"} for mode in MODES}
        return {"anyOf": [{"enum": list(MODES)}, object_schema(modes | {"restitution": restitution})]}


Contact = Annotated[ContactMode, ContactValue()]
Side = Literal["left", "right"]
HOLDS, PUSHES = ContactMode(), ContactMode("pushes")
CONTACT = (
    "normal forces that it carries: holds (both senses), pushes or pulls; or {pushes: true, restitution: 0.3}"
)
SIDE = (
    "side of the direction on which j's point lies, for a contact that pushes or pulls: left (default; outside "
    "of a circle) or right"
)


def contact_field(default: ContactMode = HOLDS) -> Any:
    """The key `contact` of a joint."""
    return Field(default, description=f"{CONTACT}; default {default.mode}")


def side_field() -> Any:
    """The key `side` of a joint."""
    return Field("left", description=SIDE)


def check_contact(keys: object) -> object:
    """Refuse a side of a contact that carries forces in both senses."""
    if isinstance(keys, Mapping) and "side" in keys and "contact" not in keys:
        raise ModelError("side is given without contact", "write contact: pushes beside it", ("side",))
    return keys


def refuse_contact(keys: object, kind: str) -> None:
    """Refuse a contact on a joint that transmits forces in all directions."""
    if isinstance(keys, Mapping) and "contact" in keys:
        article = "an" if kind[0] in "aeiou" else "a"
        raise ModelError(
            f"{article} {kind} transmits forces in all directions",
            "use a slot with contact: pushes",
            ("contact",),
        )
