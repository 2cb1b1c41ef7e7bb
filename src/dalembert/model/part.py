"""Base of every part of a description: frozen, no unknown keys, read by a file's rules or by Python's."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Self

from pydantic import (
    BaseModel,
    ConfigDict,
    SerializationInfo,
    SerializerFunctionWrapHandler,
    ValidationError,
    ValidationInfo,
    model_serializer,
    model_validator,
)

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.files.messages import UnknownKey, translate
from dalembert.model.quantities.dependent_numbers import Dependent, follows
from dalembert.model.quantities.expressions import units_inside
from dalembert.model.quantities.parameters import Parameters, of_parameters, refuse_other_names, uses
from dalembert.units import Units, quantity
from dalembert.wording import closest, quote_value


@dataclass(frozen=True)
class ReadingRules:
    """The rules by which values are read.

    units:     of bare numbers; None is Python's rule, SI and radians
    freedoms:  of each drive, `turn` or `slide`: whether an angle or a length is meant
    dimension: components of a vector; None takes 2 and 3
    folder:    that other files are named from; empty is the current one
    parameters: of the file, by name
    data:      another folder that columns may be read from
    """

    units: Units | None = None
    freedoms: Mapping[str, str] = field(default_factory=dict)
    dimension: int | None = None
    folder: str = ""
    parameters: Parameters = field(default_factory=dict)
    data: str = ""

    def quantity(self, value: object, kind: str) -> float:
        """The SI value of a number, a text with its unit, or an expression of parameters and of numbers with units."""
        if isinstance(value, Dependent):
            return value if value.names <= self.parameters.keys() else float(value)
        if not isinstance(value, str):
            return quantity(value, kind, self.units)
        if uses(value, self.parameters) or units_inside(value):
            number = of_parameters(value, kind, self.units, self.parameters, {})
            assert isinstance(number, float)
            return number
        try:
            return quantity(value, kind, self.units)
        except ModelError:
            if not self.parameters:
                raise
            refuse_other_names(value, self.parameters)
            raise


PYTHON = ReadingRules()


def reading(info: ValidationInfo | None) -> ReadingRules:
    """The rules that apply while a value is validated."""
    context = info.context if info is not None else None
    return context if isinstance(context, ReadingRules) else PYTHON


class Part(BaseModel):
    """A part of a description: frozen; in Python bare numbers are SI and radians, texts carry their unit."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        coerce_numbers_to_str=True,
        defer_build=True,  # of thirty kinds of part a file has a few, and a mechanism's schema contains its parts'
    )

    INSTEAD: ClassVar[Mapping[str, str]] = {}
    """Key -> the key that it takes the place of, when it is given a value later."""

    def replaced_by(self, name: str, value: object) -> tuple[str, ...]:
        """The fields that have no place beside one that is given this value later."""
        return (self.INSTEAD[name],) if name in self.INSTEAD and value is not None else ()

    if not TYPE_CHECKING:

        def __init__(self, **keys: object) -> None:
            try:
                self.__pydantic_validator__.validate_python(
                    keys, self_instance=self, context=self._rules(keys)
                )
            except ValidationError as error:
                raise translate(error, keys) from None

        __init__.__pydantic_base_init__ = True

    def __dir__(self) -> list[str]:
        """Its attributes without those of the library that checks it: what an editor completes."""
        taken = set(dir(Part))
        return [name for name in super().__dir__() if name not in taken or name.startswith("__")]

    @classmethod
    def _rules(cls, keys: Mapping[str, object]) -> ReadingRules:
        return PYTHON

    @classmethod
    def model_validate(cls, obj: object, *, context: Any = None, **options: Any) -> Self:
        """The part that a tree describes; raises ModelError."""
        try:
            return super().model_validate(obj, context=context, **options)
        except ValidationError as error:
            raise translate(error, obj) from None

    @model_validator(mode="before")
    @classmethod
    def _known_keys(cls, keys: object) -> object:
        if isinstance(keys, Mapping):
            check_keys(keys, cls.keys())
        return keys

    @classmethod
    def keys(cls) -> list[str]:
        """The keys it may have, as a file writes them."""
        return [field.alias or name for name, field in cls.model_fields.items()]

    @model_serializer(
        mode="wrap", return_type=Tree
    )  # not the annotation: it is read where the schema is built
    def _tree(self, handler: SerializerFunctionWrapHandler, info: SerializationInfo) -> Tree:
        keys: Tree = handler(self)
        if info.mode != "json":
            return keys
        for name, model_field in type(self).model_fields.items():
            if name != "type" and not model_field.is_required():
                default = model_field.get_default(call_default_factory=True)
                value = getattr(self, name)
                if value == default and not follows(value):
                    keys.pop(model_field.alias or name, None)
                    keys.pop(name, None)
        return keys


IN_SPACE = {"pin": "revolute", "slider": "prismatic", "slot": "slotted_cylinder"}
"""Planar joints that have another name in space."""


def check_keys(keys: Mapping[str, object], allowed: list[str]) -> None:
    """Raise for the first key that is not allowed."""
    for key in keys:
        if key not in allowed:
            remedy = closest(str(key), allowed, 20)
            if key in ("axis", "axes") and keys.get("type") in IN_SPACE:
                kind = str(keys["type"])
                remedy = f"a {kind} is for the plane and has none; in space, write type: {IN_SPACE[kind]}"
            raise UnknownKey(f"unknown key {quote_value(key)}", remedy, (str(key),))


def mapping(
    value: object, allowed: list[str], example: str, required: Iterable[str] = ()
) -> Mapping[str, Any]:
    """The value, if it is a mapping with allowed keys only, and with those that are required."""
    if not isinstance(value, Mapping):
        raise ModelError(f"expected a mapping, not {quote_value(value)}", f"write {example}")
    check_keys(value, allowed)
    for key in required:
        if key not in value:
            raise ModelError(f"the key {key!r} is missing", f"write {example}")
    return value


class LoadPart(Part):
    """Common keys of all loads: what they act on, and what their forces count as."""

    ON: ClassVar[Literal["point", "link", "span", "turn"]]
    """A point of a link, a link, the span between two points, or the turn of a joint."""

    FORCE: ClassVar[Literal["load", "spring", "damper"]] = "load"

    type: str

    @property
    def unknown(self) -> bool:
        """True if it is unknown."""
        return False
