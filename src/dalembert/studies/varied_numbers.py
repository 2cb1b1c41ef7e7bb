"""The numbers of a description that a study varies, and how a quantity is read at their place."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from dalembert.analysis.batch.symbolic_model import DRIVEN, Number, numbers, refuse_twofold
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.model.paths import parameter_name, value_at
from dalembert.units import KINDS, quantity
from dalembert.wording import quote_value

SAME = {"mass": ("weight", "shape"), "weight": ("mass", "shape"), "center": ("shape",), "inertia": ("shape",)}
"""Key of a link -> the keys that may give the same in its place."""


def varied_numbers(m: Mechanism, path: str) -> list[Number]:
    """The numbers behind a path: of a vector its components; a drive's position too, which no kernel varies."""
    keys = path.split(".")
    if name := parameter_name(path, m.parameters, m.keys()):
        return [Number(name, float(m.parameters[name].value), parameter=True)]
    value = value_at(m, keys)
    if value is None:
        _refuse_absent(m, path, keys)
    if keys[0] == "drives" and isinstance(value, (int, float)) and not isinstance(value, bool):
        return [Number(path, float(value))]
    if keys[0] == "drives" and keys[2:3] and keys[2] in DRIVEN:
        raise ModelError(f"{path!r} is no single number", "leave it out: a single position may vary", keys)
    return list(numbers(m, [path]))


def _refuse_absent(m: Mechanism, path: str, keys: list[str]) -> None:
    """Say which key gives what a path asks for and does not have."""
    others = SAME.get(keys[-1], ()) if keys[0] == "links" and len(keys) == 3 else ()
    part = m.links[keys[1]] if others else None
    given = next((o for o in others if getattr(part, "shapes" if o == "shape" else o) not in (None, ())), "")
    there = ".".join([*keys[:-1], given])
    what = f"{path!r} has no number: the file gives {there!r}" if given else f"{path!r} has no number"
    remedy = {"": f"give {keys[-1]} a value in the model file first", "shape": f"vary a number below {there}"}
    raise ModelError(what, remedy.get(given, f"vary {there}"), keys)


def check_twofold(m: Mechanism, found: Iterable[Number]) -> None:
    """Raise ModelError for a number that is varied twice, or follows from another."""
    refuse_twofold(m, list(found))
    paths = [n.path for n in found]
    twice = next((p for p in paths if paths.count(p) > 1), "")
    if twice:
        raise ModelError(f"{twice!r} is varied twice", "name it once", (twice,))


def kind_at(m: Mechanism, number: Number) -> str:
    """What the number at a path is, of `units.KINDS`; empty for a parameter of a kind without a name."""
    if number.parameter:
        return m.parameters[number.path].kind or ""
    part: Any = m.with_values({number.path: float(number.value)}).to_tree()
    for key in number.keys:
        part = part[int(key)] if isinstance(part, list) else part.get(key) if isinstance(part, dict) else None
    unit = part.partition(" ")[2] if isinstance(part, str) else ""
    return next((kind for kind, of in KINDS.items() if of.si == unit), "number")


def reader(m: Mechanism, number: Number) -> Callable[[object], float]:
    """A reader of quantities at a number's place: texts by the file's units, plain numbers in SI."""
    kind = kind_at(m, number)

    def si(value: object) -> float:
        if isinstance(value, bool) or value is None:
            raise ModelError(f"{quote_value(value)} is no quantity", "write a number with its unit")
        if not isinstance(value, str):
            return quantity(value, "number")
        if kind:
            return quantity(value, kind, m.units)
        changed = m.with_values({number.path: value})
        return float(changed.parameters[number.path].value)

    return si
