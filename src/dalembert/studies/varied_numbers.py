"""The numbers of a description that a study varies, and how a quantity is read at their place."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from dalembert.analysis.batch.tracing.symbolic_model import (
    DRIVEN,
    Number,
    number_kinds,
    numbers,
    refuse_twofold,
)
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.model.paths import parameter_name, value_at
from dalembert.units import quantity
from dalembert.wording import quote_value


def varied_numbers(m: Mechanism, path: str) -> list[Number]:
    """The numbers behind a path: of a vector its components; a drive's position too, which no kernel varies."""
    keys = path.split(".")
    if name := parameter_name(path, m.parameters, m.keys()):
        return [Number(name, float(m.parameters[name].value), parameter=True)]
    value = value_at(m, keys)
    if keys[0] == "drives" and isinstance(value, (int, float)) and not isinstance(value, bool):
        return [Number(path, float(value))]
    if keys[0] == "drives" and keys[2:3] and keys[2] in DRIVEN:
        raise ModelError(f"{path!r} is no single number", "leave it out: a single position may vary", keys)
    return list(numbers(m, [path]))


def check_twofold(m: Mechanism, found: Iterable[Number]) -> None:
    """Raise ModelError for a number that is varied twice, or follows from another."""
    refuse_twofold(m, list(found))
    paths = [n.path for n in found]
    twice = next((p for p in paths if paths.count(p) > 1), "")
    if twice:
        raise ModelError(f"{twice!r} is varied twice", "name it once", (twice,))


def reader(m: Mechanism, number: Number) -> Callable[[object], float]:
    """A reader of quantities at a number's place: texts by the file's units, plain numbers in SI."""
    nameless = number.parameter and m.parameters[number.path].kind is None
    (kind,) = number_kinds(m, [number])

    def si(value: object) -> float:
        if isinstance(value, bool) or value is None:
            raise ModelError(f"{quote_value(value)} is no quantity", "write a number with its unit")
        if not isinstance(value, str):
            return quantity(value, "number")
        if nameless:
            return float(m.with_values({number.path: value}).parameters[number.path].value)
        return quantity(value, kind, m.units)

    return si
