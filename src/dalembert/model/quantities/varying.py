"""Quantities that may change along the motion: a number, an expression in the drives, or a table."""

from __future__ import annotations

import re
from collections.abc import Mapping

from dalembert.arrays import Numeric
from dalembert.errors import ModelError
from dalembert.model.part import ReadingRules, mapping
from dalembert.model.quantities.coordinates import SPEED, going_by
from dalembert.model.quantities.dependent_numbers import expression_with_unit
from dalembert.model.quantities.expression_trees import Functions
from dalembert.model.quantities.expressions import Expression, parse_expression, units_inside
from dalembert.model.quantities.figures import FILE_UNITS
from dalembert.model.quantities.parameters import of_parameters, uses
from dalembert.model.quantities.tables import Table
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    at_item,
    object_schema,
    value_text,
)
from dalembert.model.quantities.written_tables import table, table_schema, table_tree
from dalembert.units import KINDS, NUMBER, check_unit
from dalembert.wording import quote_value

Varying = float | Expression | Table
"""A quantity that may change along the motion, in SI."""


def varying_schema() -> JsonSchema:
    words = "in the drives' names, time, links.NAME.angle, joints.NAME.slide, of an effort NAME.speed: SI and radians"
    keys = {
        "expression": {"type": "string", "description": words},
        "unit": {"type": "string", "description": "of its result; default the file's"},
    }
    return {"anyOf": [NUMBER_OR_TEXT, table_schema(), object_schema(keys, "expression")]}


def varying(value: object, kind: str, rules: ReadingRules) -> Varying:
    """A number, an expression or a table, as its form says.

    >>> varying("2*sin(O2) kN", "force", ReadingRules())
    Expression(text='2*sin(O2)', unit='kN')
    """
    if isinstance(value, Expression) and value.parameters is None and (value.unit or KINDS[kind].si):
        check_unit(value.unit, kind)
    if isinstance(value, (Expression, Table)):
        return value
    if isinstance(value, Mapping):
        return _map_values(value, kind, rules)
    if isinstance(value, str):
        return _read_text(value, kind, rules)
    return rules.quantity(value, kind)


def _read_text(value: str, kind: str, rules: ReadingRules) -> float | Expression:
    if has_units(value, rules):
        return _with_units(value, kind, rules)
    return expression(value, kind, rules) if _is_expression(value) else rules.quantity(value, kind)


def has_units(value: object, rules: ReadingRules) -> bool:
    """True if a text is an expression of parameters, or one with units inside: its dimensions are checked."""
    return uses(value, rules.parameters) or (isinstance(value, str) and units_inside(value, rules.freedoms))


def _with_units(value: str, kind: str, rules: ReadingRules, unit_text: str = "") -> float | Expression:
    known = going_by(value) | dict(rules.freedoms)
    known |= {f"{name}{SPEED}": f"{freedom} speed" for name, freedom in rules.freedoms.items()}
    return of_parameters(value, kind, rules.units, rules.parameters, known, unit_text)


def _is_expression(value: str) -> bool:
    plain = value.strip().replace("\u2212", "-")
    if re.fullmatch(r"[+-]?(nan|inf|infinity)", plain.lower()):
        return False
    return bool(plain) and not re.fullmatch(  # the whole number first: the e of 1e3*O begins no unit
        rf"(?>{NUMBER})(\s*[^\W\d].*|\s*[°%].*|\s+\d.*|,.*|\s*)", plain, re.DOTALL
    )


def expression(value: object, kind: str, rules: ReadingRules, unit_text: str = "") -> Expression:
    """An expression, with a unit behind it or the file's."""
    if not isinstance(value, str):
        what = f"{quote_value(value)} is not an expression"
        raise ModelError(what, "write it as text, for example 500*sin(O2)")
    rest = parse_expression(value)[1]
    if rest and not re.match(r"[^\W\d]", rest):
        Expression(value)
    if rest:
        value, unit_text = value.strip()[: -len(rest)].strip(), rest
    if unit_text:
        check_unit(unit_text, kind)
    default = rules.units.text(kind) if rules.units else KINDS[kind].si
    return Expression(value, unit_text or default)


def _map_values(value: Mapping[str, object], kind: str, rules: ReadingRules) -> Varying:
    if "expression" in value:
        keys = mapping(value, ["expression", "unit"], "")
        unit_text = keys.get("unit", "")
        if not isinstance(unit_text, str):
            what = f"{quote_value(unit_text)} is not a unit"
            raise ModelError(what, f"write {KINDS[kind].si}, for example", ("unit",))
        read = _with_units if has_units(keys["expression"], rules) else expression
        return at_item("expression", read, keys["expression"], kind, rules, unit_text)
    return table(value, kind, rules)


def varying_tree(value: Varying, kind: str) -> object:
    """The value as written in a file, in SI, with units."""
    if isinstance(value, Expression) and value.parameters is not None:
        return expression_with_unit(value, kind)
    if isinstance(value, Expression):
        units = FILE_UNITS.get()
        if units is not None and _is_expression(value.text):
            return value.text if value.unit == units.text(kind) else f"{value.text} {value.unit}"
        return {"expression": value.text, "unit": value.unit} if value.unit else {"expression": value.text}
    if isinstance(value, Table):
        return table_tree(value, kind)
    return value_text(value, kind)


def value_at(value: Varying, drives: Mapping[str, Numeric], functions: Functions | None = None) -> Numeric:
    """The SI value at the drives' positions, of the drives' common shape.

    >>> value_at(3.0, {})
    np.float64(3.0)
    """
    number = value if isinstance(value, (int, float)) else value.at(drives, functions)
    if functions is not None:
        return number
    import numpy as np

    if isinstance(value, (int, float)) and not drives:
        return np.float64(value)
    shape = np.broadcast_shapes(*(np.shape(position) for position in drives.values()))
    return np.broadcast_to(np.asarray(number, float), shape)[()]
