"""Contacts that only push: the joints that have one, and its side."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationInfo

from dalembert.errors import ModelError
from dalembert.model.quantities.values import JsonSchema, ValueField
from dalembert.wording import closest, quote_value

MODES = ("holds", "pushes", "pulls")


@dataclass(frozen=True, slots=True)
class ContactMode:
    """Force that a contact can carry: ``holds`` in both senses, ``pushes`` or ``pulls`` in one."""

    mode: str = "holds"


class ContactValue(ValueField):
    """A contact: `holds`, `pushes` or `pulls`."""

    def read(self, value: object, info: ValidationInfo) -> ContactMode:
        if isinstance(value, ContactMode):
            return value
        if not isinstance(value, str) or value not in MODES:
            raise ModelError(f"unknown contact {quote_value(value)}", closest(str(value), list(MODES)))
        return ContactMode(value)

    def write(self, value: ContactMode) -> object:
        return value.mode

    def json_schema(self) -> JsonSchema:
        return {"enum": list(MODES)}


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


def refuse_contact(keys: object, kind: str) -> None:
    """Refuse a contact on a joint that transmits forces in all directions."""
    if isinstance(keys, Mapping) and "contact" in keys:
        article = "an" if kind[0] in "aeiou" else "a"
        raise ModelError(
            f"{article} {kind} transmits forces in all directions",
            "use a slot with contact: pushes",
            ("contact",),
        )
