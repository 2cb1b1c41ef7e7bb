"""Contacts that only push: the joints that have one, and its side."""

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
BELOW = "from below"
EXAMPLE = "contact: {pushes: true, restitution: 0.3}"


@dataclass(frozen=True, slots=True)
class ContactMode:
    """Force that a contact can carry: ``holds`` in both senses, ``pushes`` or ``pulls`` in one; coefficient of
    restitution of its landings, 0 to 1. below: the end of a guide pushes at position 0 of its slide, along it; opened:
    its normal constraint is a freedom, that a ``drive`` has or that has a ``stop``; empty where it is a constraint."""

    mode: str = "holds"
    restitution: float = 0.0
    below: bool = False
    opened: str = ""


class ContactValue(ValueField):
    """A contact: `holds`, `pushes` or `pulls`, or `{pushes: true, restitution: 0.3}`."""

    def read(self, value: object, info: ValidationInfo) -> ContactMode:
        if isinstance(value, ContactMode):
            return value
        if isinstance(value, Mapping):
            return _long(value, info)
        if not isinstance(value, str) or value not in MODES:
            raise ModelError(f"unknown contact {quote_value(value)}", closest(str(value), list(MODES)))
        return ContactMode(value)

    def write(self, value: ContactMode) -> object:
        if not value.restitution and not value.below:
            return value.mode
        return {"pushes" if value.below else value.mode: BELOW if value.below else True} | (
            {"restitution": value.restitution} if value.restitution else {}
        )

    def json_schema(self) -> JsonSchema:
        number = {"type": "number", "minimum": 0, "maximum": 1, "description": RESTITUTION}
        words = {"holds": "both senses", "pushes": "compression only", "pulls": "tension only"}
        modes = {m: {"enum": [True, BELOW], "description": words[m]} for m in MODES}
        return {
            "anyOf": [
                {"enum": list(MODES)},
                object_schema(modes | {"restitution": number}),
            ]
        }


RESTITUTION = "speed after a landing over that before; default 0: used by simulate"


def _long(value: Mapping[str, object], info: ValidationInfo) -> ContactMode:
    """The long form of a contact."""
    keys = mapping(value, [*MODES, "restitution"], EXAMPLE)
    modes = [mode for mode in MODES if mode in keys]
    if len(modes) != 1:
        raise ModelError("the contact does not say what it does", f"write {EXAMPLE}")
    below = keys[modes[0]] == BELOW and modes == ["pushes"] and info.data.get("type") == "slider"
    if keys[modes[0]] is not True and not below:
        what = f"{modes[0]} is {quote_value(keys[modes[0]])}"
        raise ModelError(what, f"write {modes[0]}: true; of a slider also pushes: {BELOW}", (modes[0],))
    back = at_item("restitution", reading(info).quantity, keys.get("restitution", 0.0), "number")
    if not 0 <= back <= 1:
        what = f"restitution is {back:g}; it is the speed after a landing over the speed before"
        raise ModelError(what, "write a number from 0 (no rebound) to 1 (no energy lost)", ("restitution",))
    return ContactMode("holds" if below else modes[0], back, below)


Contact = Annotated[ContactMode, ContactValue()]
Side = Literal["left", "right"]
HOLDS, PUSHES = ContactMode(), ContactMode("pushes")
CONTACT = "normal forces that it carries: holds (both senses), pushes or pulls"
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


def refuse_contact(keys: object) -> None:
    """Refuse a contact on a joint that transmits forces in all directions."""
    if isinstance(keys, Mapping) and "contact" in keys:
        kind = str(keys.get("type", "joint"))
        article = "an" if kind[0] in "aeiou" else "a"
        raise ModelError(
            f"{article} {kind} joint transmits forces in all directions",
            "use a slot with contact: pushes",
            ("contact",),
        )


def check_flank(contact: ContactMode, flank: str | None, flat: bool) -> None:
    """Refuse teeth that pull, or of which it is not known which flank pushes."""
    pushes = contact.mode != "holds"
    if contact.mode == "pulls":
        raise ModelError("teeth push, they do not pull", "write contact: pushes", ("contact",))
    if pushes and flank is None:
        what = "teeth that only push need the flank that they push with"
        remedy = "write flank: left, the side to which they push j, or flank: right"
        raise ModelError(what, remedy, ("contact",))
    if flank is not None and not pushes:
        raise ModelError("a flank is given without contact", "write contact: pushes beside it", ("flank",))
    if pushes and (contact.restitution or not flat):
        what = "contact: pushes of teeth is for the plane, without restitution"
        raise ModelError(what, "leave it out", ("contact",))
