"""Types of values for pydantic: scalars, vectors, names and quantities that change along the motion."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Annotated, Any, TypeVar

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, SerializationInfo, ValidationInfo
from pydantic_core import CoreSchema, core_schema

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.part import ReadingRules, reading
from dalembert.model.quantities.dependent_numbers import Dependent, dependent_text, polar_components
from dalembert.model.quantities.expressions import parse_expression
from dalembert.model.quantities.figures import (
    FILE_UNITS,
    in_units,
    plain,
    plain_vector,
    unit_vector,
    without_fraction,
)
from dalembert.model.quantities.parameters import uses
from dalembert.unit_names import unit
from dalembert.units import KINDS, NUMBER, text
from dalembert.wording import quote_value

Vector = tuple[float, ...]

JsonSchema = Tree
T = TypeVar("T")
NUMBER_OR_TEXT: JsonSchema = {"type": ["number", "string"]}
NAME_OR_NUMBER: JsonSchema = {"type": ["string", "integer"]}


def list_schema(items: JsonSchema = NUMBER_OR_TEXT, least: int = 1, most: int | None = None) -> JsonSchema:
    """JSON schema of a list with a least and a largest number of items."""
    return {"type": "array", "items": items, "minItems": least} | ({"maxItems": most} if most else {})


def object_schema(keys: JsonSchema, *required: str) -> JsonSchema:
    """JSON schema of a mapping with these keys and no others."""
    needed = {"required": list(required)} if required else {}
    return {"type": "object", "properties": keys, **needed, "additionalProperties": False}


class ValueField:
    """Annotation of a field: how its value is read from a tree, written to one, and described."""

    def read(self, value: object, info: ValidationInfo) -> object:
        raise NotImplementedError

    def write(self, value: Any) -> object:
        return value

    def json_schema(self) -> JsonSchema:
        return NUMBER_OR_TEXT

    def _serialize(self, value: object, info: SerializationInfo) -> object:
        with in_units(info.context):
            return self.write(value)

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(
            self.read,
            serialization=core_schema.plain_serializer_function_ser_schema(
                self._serialize, info_arg=True, when_used="json"
            ),
        )

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchema:
        return dict(self.json_schema())  # the default of a field is put into it


class Scalar(ValueField):
    """A number of one kind, in SI inside; an integer where it counts things: faces, teeth."""

    def __init__(self, kind: str, sign: str = "", counts: str = "") -> None:
        self.kind, self.sign, self.counts = kind, sign, counts

    def read(self, value: object, info: ValidationInfo) -> float:
        number = check_sign(reading(info).quantity(value, self.kind), value, self.sign)
        return check_count(number, self.counts)

    def write(self, value: float) -> object:
        return value_text(value, self.kind)

    def json_schema(self) -> JsonSchema:
        return NUMBER_OR_TEXT | {"description": f"{KINDS[self.kind].phrase}, SI unit {KINDS[self.kind].si}"}


def check_sign(number: float, value: object, sign: str) -> float:
    """The number, if it has the sign wanted: `positive`, `not negative` or any."""
    if (sign == "positive" and not number > 0) or (sign == "not negative" and number < 0):
        positive = sign == "positive"
        what = f"{quote_value(value)} is {'not positive' if positive else 'negative'}"
        raise ModelError(what, "write a positive one" if positive else "write a positive one, or 0")
    return number


def check_count(number: float, what: str) -> float:
    """The number, if it is an integer or counts nothing."""
    if what and number != round(number):
        raise ModelError(f"the number of {what} is not an integer", "write an integer")
    return number


def value_text(number: float, kind: str) -> object:
    """The number with its SI unit as text, or as a file in the units of the moment has it; a plain number as it is."""
    units = FILE_UNITS.get()
    if isinstance(number, Dependent):
        return dependent_text(number, kind)
    if units is None:
        return text(number, kind) if KINDS[kind].si else number
    return plain(number, kind, units) if KINDS[kind].si else without_fraction(number)


def stated_text(number: float, kind: str) -> object:
    """As ``value_text``, with a unit also where it is the file's: of a value whose unit says which kind it is of."""
    value, units = value_text(number, kind), FILE_UNITS.get()
    return value if units is None or isinstance(value, str) else f"{value} {units.text(kind)}"


def vector_text(vector: Vector, kind: str) -> object:
    """The components, or polar text, as `value_text` has them."""
    units = FILE_UNITS.get()
    dependent = any(isinstance(x, Dependent) for x in vector)
    return (
        [value_text(x, kind) for x in vector]
        if units is None or dependent
        else plain_vector(vector, kind, units)
    )


class Components(ValueField):
    """A vector `[x, y]`, polar text `r @ angle`, in space `[x, y, z]`; Cartesian and SI inside."""

    def __init__(self, kind: str) -> None:
        self.kind = kind

    def read(self, value: object, info: ValidationInfo) -> Vector:
        return vector(value, self.kind, reading(info))

    def write(self, value: Vector) -> object:
        return vector_text(value, self.kind)

    def json_schema(self) -> JsonSchema:
        return vector_schema()


def direction_vector(direction: Vector) -> Vector:
    """The components of a direction in space, if they say one."""
    if len(direction) != 3:
        raise ModelError(f"a direction in space has {len(direction)} components", "write [x, y, z]")
    if not any(direction):
        what = "all its components are 0"
        raise ModelError(what, "write the direction it points in, for example [0, 0, 1]")
    return direction


def vector_schema() -> JsonSchema:
    return {
        "anyOf": [list_schema(NUMBER_OR_TEXT, 2, 3), {"type": "string", "description": "polar: r @ angle"}]
    }


def vector(value: object, kind: str, rules: ReadingRules) -> Vector:
    """The Cartesian components of a vector, SI.

    >>> vector("2 m @ 90 deg", "length", ReadingRules())
    (0.0, 2.0)
    """
    if isinstance(value, str) and "@" in value:
        radius, angle = polar(value, kind, rules)
        size = rules.quantity(radius, kind)
        if isinstance(size, Dependent) or isinstance(angle, Dependent):
            return polar_components(size, angle, kind)
        x, y = unit_vector(angle)
        return size * x, size * y
    items = check_vector(value, rules, "[x, y] or polar text r @ angle")
    return tuple(at_item(i, rules.quantity, item, kind) for i, item in enumerate(items))


def at_item(index: int | str, function: Callable[..., T], *arguments: object) -> T:
    """The function's value; an error in it is one of this item."""
    try:
        return function(*arguments)
    except ModelError as error:
        path = (index, *error.path)
        raise type(error)(error.what, error.remedy, path, error.file, error.line) from None


def check_vector(value: object, rules: ReadingRules, example: str) -> Sequence[object]:
    """The components of a vector, counted."""
    if rules.dimension == 3:
        example = "[x, y, z]"
    if isinstance(value, str) or not isinstance(value, Sequence):
        raise ModelError(f"{quote_value(value)} is not a vector", f"write {example}")
    wanted = (rules.dimension,) if rules.dimension else (2, 3)
    if len(value) not in wanted:
        if rules.dimension == 2 and len(value) == 3:
            example += ", or space: space at the top of the file"
        if len(value) == 1 and len(parts := str(value[0]).split()) in wanted:
            example = f"[{', '.join(parts)}]: separate the components by commas"
        counted = f"{len(value)} component{'' if len(value) == 1 else 's'}"
        raise ModelError(f"a vector has {counted} where {wanted[0]} are needed", f"write {example}")
    return value


def polar(value: str, kind: str, rules: ReadingRules) -> tuple[str, float]:
    """The radius as text and the angle in radians of `r @ angle`; a unit behind belongs where its dimension fits."""
    if rules.dimension == 3:
        raise ModelError(f"{quote_value(value)} is polar, which is for the plane", "write [x, y, z]")
    radius, angle = (side.strip() for side in value.split("@", 1))
    if "@" in angle or not radius or not angle:
        what = f"{quote_value(value)} is not a polar vector"
        raise ModelError(what, "write r @ angle, for example 3 @ 30 deg")
    match = re.fullmatch(rf"({NUMBER})\s*(.*)", angle.replace("\u2212", "-"))
    if uses(angle, rules.parameters):
        return radius, rules.quantity(angle, "angle")
    if match and match[2] and unit(match[2]).dimension == KINDS[kind].dimension:
        if not re.fullmatch(NUMBER, radius) and parse_expression(radius)[1]:
            problem = f"{quote_value(value)} has two units of {KINDS[kind].phrase[2:].strip()}"
            raise ModelError(problem, "leave one of them out")
        return f"{radius} {match[2]}", rules.quantity(match[1], "angle")
    try:
        return radius, rules.quantity(angle, "angle")
    except ModelError:
        if match is None:
            raise
        raise ModelError(
            f"{quote_value(value)} ends with a unit that is neither of {KINDS[kind].phrase} nor of an angle",
            f"write for example 3 {KINDS[kind].example.split(' ')[-1]} @ 30 deg",
        ) from None


def numbers(value: object, kind: str, rules: ReadingRules) -> tuple[float, ...]:
    """The SI values of a list of quantities."""
    if isinstance(value, str) or not isinstance(value, Sequence):
        raise ModelError(f"expected a list, not {quote_value(value)}", "write [..., ...]")
    if not value:
        raise ModelError("the list of values is empty", "write [..., ...]")
    return tuple(at_item(i, rules.quantity, item, kind) for i, item in enumerate(value))


def name(value: object) -> str:
    """A name of a link, point, joint, drive or load; an integer is one too."""
    if isinstance(value, int) and not isinstance(value, bool):
        return str(value)
    if not isinstance(value, str):
        raise ModelError(f"{quote_value(value)} is not a name", "write a name as text")
    if not value.strip() or value != value.strip() or not value.isprintable() or re.search(r"[.@]", value):
        what = f"{quote_value(value)} cannot be a name"
        raise ModelError(what, "a name is text without '.', '@' and spaces at its ends")
    return value


class NameValue(ValueField):
    """A name."""

    def read(self, value: object, info: ValidationInfo) -> str:
        return name(value)

    def json_schema(self) -> JsonSchema:
        return NAME_OR_NUMBER


class PairOfNames(ValueField):
    """Two names, `[i, j]`."""

    def read(self, value: object, info: ValidationInfo) -> tuple[str, str]:
        return pair_of_names(value)

    def write(self, value: tuple[str, str]) -> object:
        return list(value)

    def json_schema(self) -> JsonSchema:
        return list_schema(NAME_OR_NUMBER, 2, 2)


def pair_of_names(value: object) -> tuple[str, str]:
    if isinstance(value, str) or not isinstance(value, Sequence) or len(value) != 2:
        shown = str(len(value)) if isinstance(value, (list, tuple)) else quote_value(value)
        raise ModelError(f"expected two names, not {shown}", "write [ground, crank]")
    first, second = (at_item(i, name, item) for i, item in enumerate(value))
    return first, second


Name = Annotated[str, NameValue()]
TwoNames = Annotated[tuple[str, str], PairOfNames()]
