"""Tables as a file writes them: their points in lists, or columns of another file; times a factor, shifted."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from contextvars import ContextVar
from typing import Any, NamedTuple

from dalembert.errors import ModelError
from dalembert.model.part import ReadingRules, mapping
from dalembert.model.quantities.coordinates import along_of, coordinate_name
from dalembert.model.quantities.figures import FILE_UNITS
from dalembert.model.quantities.parameters import stated_dimension
from dalembert.model.quantities.tables import OUTSIDE, SLACK, ColumnFile, Table
from dalembert.model.quantities.values import (
    NAME_OR_NUMBER,
    NUMBER_OR_TEXT,
    JsonSchema,
    at_item,
    list_schema,
    numbers,
    object_schema,
    value_text,
)
from dalembert.unit_names import Dimension, unit
from dalembert.units import KINDS, Units, check_unit, quantity
from dalembert.wording import quote_value

FILE_FOLDER: ContextVar[str | None] = ContextVar("FILE_FOLDER", default=None)
"""Folder of the file that is being written: columns from it stay in their file, others are listed."""

EXAMPLE = "{against: O2, x: [...], y: [...]}"
KEYS = (
    "against",
    "x",
    "y",
    "file",
    "columns",
    "units",
    "times",
    "shift",
    "interpolate",
    "periodic",
    "outside",
)


def table_schema() -> JsonSchema:
    items = {"type": "array", "items": NUMBER_OR_TEXT}
    against = (
        "quantity of x: a drive, time, links.NAME.angle, joints.NAME.slide or .turn; default the only drive"
    )
    columns = "of the file, x and y: names in its head, or numbers; default [1, 2]"
    period = "true: a full turn, or the full turns that x covers (a slide: all of x); or the period"
    keys = {
        "against": NAME_OR_NUMBER | {"description": against},
        "x": items | {"description": "positions of the drive, increasing"},
        "y": items | {"description": "values, one for each x"},
        "file": {"type": "string", "description": "instead of x and y: a .csv file in the model's folder"},
        "columns": list_schema(NAME_OR_NUMBER, 2, 2) | {"description": columns},
        "units": list_schema({"type": "string"}, 2, 2)
        | {"description": "of the two columns, where the head has none"},
        "times": NUMBER_OR_TEXT | {"description": "what y is multiplied by, such as an area; default 1"},
        "shift": NUMBER_OR_TEXT | {"description": "how much later along x it comes; default 0"},
        "interpolate": {"enum": ["linear", "cubic"], "description": "between the points; default linear"},
        "periodic": {"type": ["boolean", "number", "string"], "description": period},
        "outside": {
            "enum": list(OUTSIDE),
            "description": "beyond its ends; default refuse: hold, with a status",
        },
    }
    return object_schema(keys) | {"anyOf": [{"required": ["x", "y"]}, {"required": ["file"]}]}


class _Points(NamedTuple):
    """SI values of a table, the kind of y, the factor, and where they came from: of a file the lines."""

    x: tuple[float, ...]
    y: tuple[float, ...]
    of: str
    times: float
    file: ColumnFile | None = None
    lines: tuple[int, ...] = ()


def table(value: Mapping[str, object], kind: str, rules: ReadingRules) -> Table:
    """The table that a mapping describes, of a quantity of this kind."""
    keys = mapping(value, list(KEYS), EXAMPLE)
    if "against" not in keys and len(rules.freedoms) == 1:
        keys = {"against": next(iter(rules.freedoms)), **keys}
    for key in ("against",) if "file" in keys else ("against", "x", "y"):
        if key not in keys:
            raise ModelError(f"the key {key!r} of a table is missing", f"write {EXAMPLE}")
    against = at_item("against", coordinate_name, keys["against"])
    abscissas = keys.get("x")
    first = abscissas[0] if isinstance(abscissas, (list, tuple)) and abscissas else 0
    along = along_of(against, rules.freedoms) or _kind_of(first)
    points = (_from_file if "file" in keys else _from_lists)(keys, kind, along, rules)
    period = at_item("periodic", _period, keys.get("periodic", False), along, points.x, rules)
    shift = at_item("shift", rules.quantity, keys["shift"], along) if "shift" in keys else 0.0
    interpolate = keys.get("interpolate", "linear")
    try:
        known = (interpolate, period, along, points.times, shift)
        outside = at_item("outside", _outside, keys.get("outside", "refuse"), period)
        return Table(against, points.x, points.y, *known, points.of, points.file, outside)
    except ModelError as error:
        if points.file is None or error.path[:1] in (("periodic",), ("outside",)):
            raise
        row = int(error.path[1]) if len(error.path) > 1 else -1
        line = points.lines[row] if points.lines else 1
        raise ModelError(
            error.what, error.remedy, (), os.path.join(rules.folder, points.file.written), line
        ) from None


def _kind_of(first: object) -> str:
    """Kind of x, angles or lengths, where only their unit gives it."""
    try:
        quantity(first, "angle")
    except ModelError:
        return "length"
    return "angle"


def _from_lists(keys: Mapping[str, object], kind: str, along: str, rules: ReadingRules) -> _Points:
    for key in ("columns", "units"):
        if key in keys:
            raise ModelError(f"{key} are of a file", "write file: as well, or leave them out", (key,))
    x = at_item("x", numbers, keys["x"], along, rules)
    y = keys["y"]
    first = y[0] if isinstance(y, (list, tuple)) and y else None
    stated = stated_dimension(first, rules.parameters)
    of, times = at_item("times", _factor, keys.get("times"), kind, stated, rules)
    return _Points(x, at_item("y", numbers, y, of, rules), "" if of == kind else of, times)


def _from_file(keys: Mapping[str, object], kind: str, along: str, rules: ReadingRules) -> _Points:
    for key in ("x", "y"):
        if key in keys:
            raise ModelError(f"both file and {key} are given", "leave one of them out", (key,))
    from dalembert.model.quantities.column_files import read_columns

    file, columns = keys["file"], keys.get("columns", (1, 2))
    units: Any = keys.get("units", ("", ""))
    for key, pair in (("columns", columns), ("units", units)):
        if not isinstance(pair, (list, tuple)) or len(pair) != 2:
            example = "columns: [angle, pressure]" if key == "columns" else "units: [deg, bar]"
            what = f"expected two {key}, not {quote_value(pair)}"
            raise ModelError(what, f"write {example}", (key,))
    first, second = at_item("file", read_columns, file, columns, rules)
    names = [_unit_of(first, units[0], 0), _unit_of(second, units[1], 1)]
    try:
        stated = unit(names[1]).dimension if names[1] else None
        of, times = at_item("times", _factor, keys.get("times"), kind, stated, rules)
        x, y = (
            _si(c.values, n, k, rules.units)
            for c, n, k in zip((first, second), names, (along, of), strict=True)
        )
    except ModelError as error:
        where = "" if "units" in keys else os.path.join(rules.folder, str(file))
        raise ModelError(error.what, error.remedy, error.path or ("columns",), where, first.head) from None
    written = {key: keys[key] for key in ("columns", "units") if key in keys}
    return _Points(
        x, y, "" if of == kind else of, times, ColumnFile(str(file), written, rules.folder), first.lines
    )


def _unit_of(column: object, stated: object, k: int) -> str:
    head = getattr(column, "unit", "")
    if not isinstance(stated, str) or (head and stated and head != stated):
        what = f"the head of column {k + 1} says {head!r}, and units {quote_value(stated)}"
        raise ModelError(what, "leave one of them out", ("units", k))
    return head or stated


def _si(values: tuple[float, ...], name: str, kind: str, units: Units | None) -> tuple[float, ...]:
    if name:
        named = check_unit(name, kind)
    elif units is None:
        return values
    else:
        for value in values if units.refuses_bare(kind) else ():
            quantity(value, kind, units)
        named = units.unit(kind)
    return tuple(named.si(value) for value in values)


def _factor(times: object, kind: str, stated: Dimension | None, rules: ReadingRules) -> tuple[str, float]:
    """The kind of y, and what it is multiplied by, SI: together the quantity. `stated` is the dimension of y's unit."""
    if times is None:
        return kind, 1.0
    product = KINDS[kind].dimension
    if stated is None:
        factor_is = stated_dimension(times, rules.parameters)
        stated = _over(product, factor_is) if factor_is else product
    of, factor = _kind_with(stated, kind), _kind_with(_over(product, stated), kind)
    return of, rules.quantity(times, factor)


def _over(a: Dimension, b: Dimension) -> Dimension:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]


def _kind_with(dimension: Dimension, kind: str) -> str:
    if dimension == KINDS[kind].dimension:
        return kind
    match = next((name for name, known in KINDS.items() if known.dimension == dimension), None)
    if match is None:
        what = f"the values times this are not {KINDS[kind].phrase}"
        raise ModelError(what, "a pressure times an area is a force, for example")
    return match


def _outside(value: object, period: float | None) -> str:
    if value not in OUTSIDE:
        raise ModelError(f"outside is {quote_value(value)}", f"write one of {', '.join(OUTSIDE)}")
    if period is not None and value != "refuse":
        raise ModelError("a periodic table goes on outside its points", "leave outside, or periodic, out")
    return str(value)


def _period(value: object, along: str, x: tuple[float, ...], rules: ReadingRules) -> float | None:
    if value is False:
        return None
    if value is not True:
        return rules.quantity(value, along)
    span = x[-1] - x[0] if x else 0.0
    if along != "angle":
        return span
    turns = max(round(span / (2 * math.pi)), 1)
    return span if abs(span - 2 * math.pi * turns) <= SLACK * span else 2 * math.pi


def table_tree(value: Table, kind: str) -> object:
    """The table as written in a file, in SI, with units; columns stay in their file where that is beside it."""
    tree: dict[str, object] = {"against": value.against}
    folder = FILE_FOLDER.get()
    if value.file is not None and folder is not None and same_folder(folder, value.file.folder):
        tree |= {"file": value.file.written, **value.file.keys}
    else:
        tree["x"] = [value_text(x, value.along) for x in value.x]
        y = [value_text(y, value.of or kind) for y in value.y]
        tree["y"] = [_with_unit(y[0], value.of), *y[1:]]
    if value.times != 1.0:
        rest = _over(KINDS[kind].dimension, KINDS[value.of or kind].dimension)
        tree["times"] = value_text(value.times, _kind_with(rest, kind))
    if value.shift:
        tree["shift"] = value_text(value.shift, value.along)
    if value.interpolate != "linear":
        tree["interpolate"] = value.interpolate
    if value.outside != "refuse":
        tree["outside"] = value.outside
    if value.period is not None:
        tree["periodic"] = value_text(value.period, value.along)
    return tree


def _with_unit(first: object, kind: str) -> object:
    """The first value with its unit, which says what kind of quantity the table has."""
    units = FILE_UNITS.get()
    return (
        f"{first} {units.text(kind)}" if kind and units is not None and not isinstance(first, str) else first
    )


def same_folder(a: str, b: str) -> bool:
    """True if two paths are in one folder."""
    return os.path.realpath(a or ".") == os.path.realpath(b or ".")
