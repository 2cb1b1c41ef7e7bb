"""The numbers of a description that a study varies, and how a quantity is read at their place."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np

from dalembert.analysis.batch.tracing.symbolic_model import (
    DRIVEN,
    VariedNumber,
    number_kinds,
    numbers,
    refuse_twofold,
)
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.model.paths import parameter_name, value_at
from dalembert.studies.spreads import Spread, read_spread
from dalembert.units import quantity
from dalembert.wording import quote_value


def varied_numbers(m: Mechanism, path: str) -> list[VariedNumber]:
    """The numbers behind a path: of a vector its components; a drive's position too, which no kernel varies,
    and where a motion starts."""
    keys = path.split(".")
    if name := parameter_name(path, m.parameters, m.keys()):
        return [VariedNumber(name, float(m.parameters[name].value), parameter=True)]
    value = value_at(m, keys)
    if keys[0] in ("drives", "start") and isinstance(value, (int, float)) and not isinstance(value, bool):
        return [VariedNumber(path, float(value))]
    if keys[0] == "drives" and keys[2:3] and keys[2] in DRIVEN:
        raise ModelError(f"{path!r} is not a single number", "leave it out: a single position may vary", keys)
    return list(numbers(m, [path]))


def check_twofold(m: Mechanism, varied: Iterable[VariedNumber]) -> None:
    """Raise ModelError for a number that is varied twice, or follows from another."""
    refuse_twofold(m, list(varied))
    paths = [n.path for n in varied]
    twice = next((p for p in paths if paths.count(p) > 1), "")
    if twice:
        raise ModelError(f"{twice!r} is varied twice", "name it once", (twice,))


def reader(m: Mechanism, number: VariedNumber) -> Callable[[object], float]:
    """A reader of quantities at a number's place: texts by the file's units, plain numbers in SI."""
    nameless = number.parameter and m.parameters[number.path].kind is None
    (kind,) = number_kinds(m, [number])

    def si(value: object) -> float:
        if isinstance(value, bool) or value is None:
            raise ModelError(f"{quote_value(value)} is not a quantity", "write a number with its unit")
        if not isinstance(value, str):
            return quantity(value, "number")
        if nameless:
            return float(m.with_values({number.path: value}).parameters[number.path].value)
        return quantity(value, kind, m.units)

    return si


def _at(path: str, error: ModelError) -> ModelError:
    what = error.what if path in error.what else f"{path}: {error.what}"
    return ModelError(what, error.remedy, ("vary", path))


Found = tuple[list[VariedNumber], tuple[Spread, ...], Array | None]
"""Numbers, how each spreads, and the designs of a table."""


def spreads_of(m: Mechanism, stated: Mapping[str, object]) -> Found:
    """Numbers and spreads of what varies."""
    numbers, spreads = [], []
    for path, text in stated.items():
        try:
            for number in varied_numbers(m, str(path)):
                limits = m.parameters[number.path].range if number.parameter else None
                spreads.append(read_spread(text, number.value, reader(m, number), limits))
                numbers.append(number)
        except ModelError as error:
            raise _at(str(path), error) from None
    return numbers, tuple(spreads), None


def columns_of(m: Mechanism, stated: Mapping[str, object], table: Mapping[str, Sequence[object]]) -> Found:
    """The designs of a table: path -> values."""
    if extra := [path for path in stated if path not in table]:
        raise ModelError(f"the table has no column {extra[0]!r}", f"it has: {', '.join(table)}", ("vary",))
    numbers, columns = [], list[list[float]]()
    for path, values in table.items():
        try:
            parts = varied_numbers(m, path)
            if len(parts) != 1:
                raise ModelError(f"{path!r} is a vector", f"give a column of {parts[0].path!r}, and so on")
            si = reader(m, parts[0])
            columns.append([si(v.item() if isinstance(v, np.generic) else v) for v in values])
        except ModelError as error:
            raise _at(path, error) from None
        numbers += parts
    if not columns or len({len(c) for c in columns}) > 1 or not columns[0]:
        raise ModelError(
            "a table of designs needs columns of one length", "give a value of each path for each"
        )
    return numbers, (), np.ascontiguousarray(np.array(columns).T)
