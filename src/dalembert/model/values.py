"""Types of values for pydantic: scalars, vectors, names and quantities that change along the motion."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema, core_schema

from dalembert.errors import ModelError
from dalembert.model.expressions import Expression, parsed
from dalembert.model.part import Reading, mapping, reading
from dalembert.model.tables import Table
from dalembert.symbols import unit
from dalembert.units import KINDS, NUMBER, quantity, text
from dalembert.wording import shown

Varying = float | Expression | Table
"""A quantity that may change along the motion, in SI."""

Vector = tuple[float, ...]

JsonSchema = dict[str, Any]
NUMBER_OR_TEXT: JsonSchema = {"type": ["number", "string"]}


class Value:
    """Annotation of a field: how its value is read from a tree, written to one, and described."""

    def read(self, value: Any, info: ValidationInfo) -> Any:
        raise NotImplementedError

    def write(self, value: Any) -> Any:
        return value

    def json_schema(self) -> JsonSchema:
        raise NotImplementedError

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(
            self.read,
            serialization=core_schema.plain_serializer_function_ser_schema(self.write, when_used="json"),
        )

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchema:
        return self.json_schema()


class Scalar(Value):
    """A number of one kind, in SI inside."""

    def __init__(self, kind: str, sign: str = "") -> None:
        self.kind, self.sign = kind, sign

    def read(self, value: Any, info: ValidationInfo) -> float:
        return signed(quantity(value, self.kind, reading(info).units), value, self.sign)

    def write(self, value: float) -> Any:
        return written(value, self.kind)

    def json_schema(self) -> JsonSchema:
        return NUMBER_OR_TEXT | {"description": f"{KINDS[self.kind].phrase}, SI unit {KINDS[self.kind].si}"}


def signed(number: float, value: object, sign: str) -> float:
    """The number, if it has the sign wanted: `positive`, `not negative` or any."""
    if (sign == "positive" and not number > 0) or (sign == "not negative" and number < 0):
        raise ModelError(
            f"{shown(value)} is not {sign}" if sign == "positive" else f"{shown(value)} is negative",
            f"write one that is {sign}",
        )
    return number


def written(number: float, kind: str) -> Any:
    """The number with its SI unit as text; a plain number as it is."""
    return text(number, kind) if KINDS[kind].si else number


class Components(Value):
    """A vector `[x, y]`, polar text `r @ angle`, in space `[x, y, z]`; Cartesian and SI inside."""

    def __init__(self, kind: str) -> None:
        self.kind = kind

    def read(self, value: Any, info: ValidationInfo) -> Vector:
        return vector(value, self.kind, reading(info))

    def write(self, value: Vector) -> Any:
        return [written(number, self.kind) for number in value]

    def json_schema(self) -> JsonSchema:
        return vector_schema()


def vector_schema() -> JsonSchema:
    items = {"type": "array", "items": NUMBER_OR_TEXT, "minItems": 2, "maxItems": 3}
    return {"anyOf": [items, {"type": "string", "description": "polar: r @ angle"}]}


def vector(value: object, kind: str, rules: Reading) -> Vector:
    """The Cartesian components of a vector, SI.

    >>> vector("2 m @ 90 deg", "length", Reading())
    (0.0, 2.0)
    """
    if isinstance(value, str) and "@" in value:
        radius, angle = polar(value, kind, rules)
        x, y = unit_vector(angle)
        size = quantity(radius, kind, rules.units)
        return size * x, size * y
    items = listed(value, rules, "[x, y] or polar text r @ angle")
    return tuple(at_item(i, quantity, item, kind, rules.units) for i, item in enumerate(items))


def at_item(index: int | str, function: Callable[..., Any], *arguments: Any) -> Any:
    """The function's value; an error in it is one of this item."""
    try:
        return function(*arguments)
    except ModelError as error:
        raise type(error)(error.what, error.remedy, (index, *error.path)) from None


def listed(value: object, rules: Reading, example: str) -> Sequence[object]:
    """The components of a vector, counted."""
    if rules.dimension == 3:
        example = "[x, y, z]"
    if isinstance(value, str) or not isinstance(value, Sequence):
        raise ModelError(f"{shown(value)} is no vector", f"write {example}")
    wanted = (rules.dimension,) if rules.dimension else (2, 3)
    if len(value) not in wanted:
        raise ModelError(
            f"a vector has {len(value)} components where {wanted[0]} are needed", f"write {example}"
        )
    return value


def polar(value: str, kind: str, rules: Reading) -> tuple[str, float]:
    """The radius as text and the angle in radians of `r @ angle`; a unit behind belongs where its dimension fits."""
    if rules.dimension == 3:
        raise ModelError(f"{shown(value)} is polar, which is for the plane", "write [x, y, z]")
    radius, angle = (side.strip() for side in value.split("@", 1))
    if "@" in angle or not radius or not angle:
        raise ModelError(f"{shown(value)} is no polar vector", "write r @ angle, for example 3 @ 30 deg")
    match = re.fullmatch(rf"({NUMBER})\s*(.*)", angle.replace("\u2212", "-"))
    if match and match[2] and unit(match[2]).dimension == KINDS[kind].dimension:
        if not re.fullmatch(NUMBER, radius) and parsed(radius)[1]:
            raise ModelError(
                f"{shown(value)} has two units of {KINDS[kind].phrase[2:].strip()}", "leave one of them out"
            )
        return f"{radius} {match[2]}", quantity(match[1], "angle", rules.units)
    try:
        return radius, quantity(angle, "angle", rules.units)
    except ModelError as error:
        if match is None:
            raise
        both = f"an angle or {KINDS[kind].phrase}"
        raise ModelError(f"{shown(value)} ends with a unit that is neither {both}", error.remedy) from None


def unit_vector(angle: float) -> tuple[float, float]:
    """Cosine and sine, exact at the quarter turns."""
    quarter = round(angle / (math.pi / 2))
    if abs(angle - quarter * (math.pi / 2)) < 1e-15 * max(1.0, abs(angle)):
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[quarter % 4]
    return math.cos(angle), math.sin(angle)


class Changing(Value):
    """A quantity that may change along the motion: number, text with unit, expression, table."""

    def __init__(self, kind: str) -> None:
        self.kind = kind

    def read(self, value: Any, info: ValidationInfo) -> Varying:
        return varying(value, self.kind, reading(info))

    def write(self, value: Varying) -> Any:
        return varying_tree(value, self.kind)

    def json_schema(self) -> JsonSchema:
        return varying_schema()


def varying_schema() -> JsonSchema:
    table = {
        "type": "object",
        "properties": {
            "against": {"type": "string", "description": "the drive whose position x is"},
            "x": {
                "type": "array",
                "items": NUMBER_OR_TEXT,
                "description": "positions of the drive, increasing",
            },
            "y": {"type": "array", "items": NUMBER_OR_TEXT, "description": "values there, one for each x"},
            "interpolate": {"enum": ["linear", "cubic"], "description": "between the points; default linear"},
            "periodic": {
                "type": ["boolean", "number", "string"],
                "description": "true: repeats every turn (along a slide: after its length); or the period",
            },
        },
        "required": ["against", "x", "y"],
        "additionalProperties": False,
    }
    expression = {
        "type": "object",
        "properties": {
            "expression": {"type": "string", "description": "in the drives' names, radians and metres"},
            "unit": {"type": "string", "description": "of its result; default the file's"},
        },
        "required": ["expression"],
        "additionalProperties": False,
    }
    return {"anyOf": [NUMBER_OR_TEXT, table, expression]}


def varying(value: object, kind: str, rules: Reading) -> Varying:
    """A number, an expression or a table, as its form says.

    >>> varying("2*sin(O2) kN", "force", Reading())
    Expression(text='2*sin(O2)', unit='kN')
    """
    if isinstance(value, (Expression, Table)):
        return value
    if isinstance(value, Mapping):
        return _mapped(value, kind, rules)
    if isinstance(value, str) and _is_expression(value):
        return expression(value, kind, rules)
    return quantity(value, kind, rules.units)


def _is_expression(value: str) -> bool:
    plain = value.strip().replace("\u2212", "-")
    if re.fullmatch(r"[+-]?(nan|inf|infinity)", plain.lower()):
        return False
    return bool(plain) and not re.fullmatch(
        rf"{NUMBER}(\s*[^\W\d].*|\s*[°%].*|\s+\d.*|,.*|\s*)", plain, re.DOTALL
    )


def expression(value: object, kind: str, rules: Reading, unit_text: str = "") -> Expression:
    """An expression, with a unit behind it or the file's."""
    if not isinstance(value, str):
        raise ModelError(f"{shown(value)} is no expression", "write it as text, for example 500*sin(O2)")
    rest = parsed(value)[1]
    if rest and not re.match(r"[^\W\d]", rest):
        Expression(value)
    if rest:
        value, unit_text = value.strip()[: -len(rest)].strip(), rest
    if unit_text:
        quantity(f"1 {unit_text}", kind)
    default = rules.units.text(kind) if rules.units else KINDS[kind].si
    return Expression(value, unit_text or default)


def _mapped(value: Mapping[str, Any], kind: str, rules: Reading) -> Varying:
    if "expression" in value:
        keys = mapping(value, ["expression", "unit"], "")
        unit_text = keys.get("unit", "")
        if not isinstance(unit_text, str):
            raise ModelError(
                f"{shown(unit_text)} is no unit", f"write {KINDS[kind].si}, for example", ("unit",)
            )
        return at_item("expression", expression, keys["expression"], kind, rules, unit_text)  # type: ignore[no-any-return]
    return _table(value, kind, rules)


def _table(value: Mapping[str, Any], kind: str, rules: Reading) -> Table:
    example = "{against: O2, x: [...], y: [...]}"
    keys = mapping(value, ["against", "x", "y", "interpolate", "periodic"], example)
    for key in ("against", "x", "y"):
        if key not in keys:
            raise ModelError(f"the key {key!r} of a table is missing", f"write {example}")
    against = at_item("against", name, keys["against"])
    along = _along(keys["x"], rules.freedoms.get(against))
    x = at_item("x", numbers, keys["x"], along, rules)
    return Table(
        against,
        x,
        at_item("y", numbers, keys["y"], kind, rules),
        keys.get("interpolate", "linear"),
        at_item("periodic", _period, keys.get("periodic", False), along, x, rules),
        along,
    )


def _along(x: object, freedom: str | None) -> str:
    """Whether a table's x are angles or lengths: the drive's freedom says; without one, their unit."""
    if freedom:
        return "length" if freedom == "slide" else "angle"
    first = x[0] if isinstance(x, (list, tuple)) and x else 0
    try:
        quantity(first, "angle")
    except ModelError:
        return "length"
    return "angle"


def _period(value: object, along: str, x: tuple[float, ...], rules: Reading) -> float | None:
    if value is False:
        return None
    if value is not True:
        return quantity(value, along, rules.units)
    return 2 * math.pi if along == "angle" else x[-1] - x[0]


def numbers(value: object, kind: str, rules: Reading) -> tuple[float, ...]:
    """The SI values of a list of quantities."""
    if isinstance(value, str) or not isinstance(value, Sequence):
        raise ModelError(f"{shown(value)} stands where a list is needed", "write [..., ...]")
    if not value:
        raise ModelError("an empty list stands where values are needed", "write [..., ...]")
    return tuple(at_item(i, quantity, item, kind, rules.units) for i, item in enumerate(value))


def varying_tree(value: Varying, kind: str) -> Any:
    """The value as it stands in a file, in SI, units said."""
    if isinstance(value, Expression):
        return {"expression": value.text, "unit": value.unit} if value.unit else {"expression": value.text}
    if isinstance(value, Table):
        tree: dict[str, Any] = {
            "against": value.against,
            "x": [written(x, value.along) for x in value.x],
            "y": [written(y, kind) for y in value.y],
        }
        if value.interpolate != "linear":
            tree["interpolate"] = value.interpolate
        if value.period is not None:
            tree["periodic"] = written(value.period, value.along)
        return tree
    return written(value, kind)


def value_at(value: Varying, drives: Mapping[str, Any], functions: Mapping[str, Any] | None = None) -> Any:
    """The SI value at the drives' positions, of the drives' common shape.

    >>> value_at(3.0, {})
    np.float64(3.0)
    """
    found = value if isinstance(value, (int, float)) else value.at(drives, functions)
    if functions is not None:
        return found
    import numpy as np

    shape = np.broadcast_shapes(*(np.shape(position) for position in drives.values()))
    return np.broadcast_to(np.asarray(found, float), shape)[()]


def name(value: object) -> str:
    """A name of a link, point, joint, drive or load; a whole number is one too."""
    if isinstance(value, int) and not isinstance(value, bool):
        return str(value)
    if not isinstance(value, str):
        raise ModelError(f"{shown(value)} is no name", "write a name as text")
    if not value.strip() or value != value.strip() or not value.isprintable() or re.search(r"[.@]", value):
        raise ModelError(
            f"{shown(value)} cannot be a name", "a name is text without '.', '@' and spaces at its ends"
        )
    return value


class NameValue(Value):
    """A name."""

    def read(self, value: Any, info: ValidationInfo) -> str:
        return name(value)

    def json_schema(self) -> JsonSchema:
        return {"type": ["string", "integer"]}


class PairOfNames(Value):
    """Two names, `[i, j]`."""

    def read(self, value: Any, info: ValidationInfo) -> tuple[str, str]:
        return pair_of_names(value)

    def write(self, value: tuple[str, str]) -> Any:
        return list(value)

    def json_schema(self) -> JsonSchema:
        return {"type": "array", "items": {"type": ["string", "integer"]}, "minItems": 2, "maxItems": 2}


def pair_of_names(value: object) -> tuple[str, str]:
    if isinstance(value, str) or not isinstance(value, Sequence) or len(value) != 2:
        found = f"a list of {len(value)}" if isinstance(value, (list, tuple)) else shown(value)
        raise ModelError(f"{found} stands where two names are needed", "write [ground, crank]")
    first, second = (at_item(i, name, item) for i, item in enumerate(value))
    return first, second


Name = Annotated[str, NameValue()]
TwoNames = Annotated[tuple[str, str], PairOfNames()]
