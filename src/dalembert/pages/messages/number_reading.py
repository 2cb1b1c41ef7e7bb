"""Reading of typed numbers on a page, with the units, bounds and messages of the model.

No message is written in this module: each is the one that the model raises for an example, with placeholders for its
values.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache, partial
from typing import Any, get_args

from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.batch.tracing.traced_parameters import symbol_functions
from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.kernel.graph import Node
from dalembert.model import Mechanism
from dalembert.model.part import Part
from dalembert.model.paths import dependents
from dalembert.model.quantities.dependent_numbers import Dependent, with_new
from dalembert.model.quantities.parameters import values_of
from dalembert.model.quantities.values import check_count, check_sign
from dalembert.pages.rows import NodeRows
from dalembert.unit_names import SYMBOLS
from dalembert.units import KINDS, PER_RADIAN, quantity


def required_of(m: Mechanism, path: str) -> Tree:
    """Requirements of the field of a path's number: its sign, `positive` or `not negative`; the things it counts.

    >>> from dalembert.model.library import four_bar
    >>> required_of(four_bar(), "links.crank.mass"), required_of(four_bar(), "links.crank.points.A.0")
    ({'sign': 'not negative'}, {})
    """
    part: Any = m
    keys = path.split(".")
    for place, key in enumerate(keys):
        if isinstance(part, Part):
            name = next((n for n, f in type(part).model_fields.items() if (f.alias or n) == key), "")
            part, field = getattr(part, name), type(part).model_fields[name]
            if _is_number(part, keys[place + 1 :]):
                rules = list(_inside([*field.metadata, field.annotation]))
                wanted = {key: [getattr(x, key, "") for x in rules] for key in ("sign", "counts")}
                return {key: next(filter(None, texts)) for key, texts in wanted.items() if any(texts)}
        elif isinstance(part, Mapping):
            part = part[key]
        elif isinstance(part, tuple):
            part = part[int(key)]
        else:
            break  # keys of a value with messages of its own: a motor, a start, a section
    return {}


def _is_number(value: object, rest: list[str]) -> bool:
    """True for a number, and for an item of a list of numbers; False where the path leads to another part."""
    if isinstance(value, tuple):
        return len(rest) == 1 and isinstance(value[0], float)
    return isinstance(value, float) and not rest


def _inside(annotations: Iterable[Any]) -> Iterator[Any]:
    """Annotations, with those inside unions."""
    for one in annotations:
        yield one
        yield from _inside(get_args(one))


def limits(m: Mechanism, k: Kernel, rows: NodeRows) -> list[Tree]:
    """Bounds of values that depend on parameters: the row of the value, its path, its sign and what it counts."""
    parameters = {
        n.path: node for n, node in zip(k.trace.numbers, k.number_nodes, strict=True) if n.parameter
    }
    functions = symbol_functions(k.trace.catalogue.graph)
    new, out = values_of(m.parameters, parameters, functions), list[Tree]()
    for keys, leaf in dependents(m):
        required = required_of(m, path := ".".join(keys)) if isinstance(leaf, Dependent) else {}
        value = with_new(leaf, new, functions) if required else None
        if isinstance(value, Node):
            out.append({"row": rows.of(value), "path": path, **required})
    return out


@cache
def reading() -> Tree:
    """Units by name, kinds with their names, and the messages for unreadable input."""
    return {
        "units": {name: [u.numerator, u.denominator, *u.dimension] for name, u in SYMBOLS.items()},
        "kinds": {kind: _kind(kind) for kind in KINDS},
        "sentences": {name: _left_open(*example) for name, example in EXAMPLES.items()}
        | {"range": RANGE, "count": _refused(partial(check_count, 0.5, "{what}"))},
    }


def _kind(kind: str) -> Tree:
    of = KINDS[kind]
    texts: Tree = {
        "phrase": of.phrase,
        "dimension": list(of.dimension),
        "remedy": _message("#", kind).split("; ")[1],
        "units": _message(UNKNOWN, kind).split("; ")[1],
    }
    return (
        texts
        | ({"per_radian": True} if kind in PER_RADIAN else {})
        | ({"force": True} if "force" in of.file else {})
    )


RANGE = "{text} is outside its range; write one from {low} to {high}"
"""Message for a parameter with a `range`; a file may give other values, so the model has no such message."""

UNKNOWN = "7 qqq"
"""A number with a unit that does not exist."""

EXAMPLES: dict[str, tuple[str, str, dict[str, str]]] = {
    "number": ("#", "length", {"a length": "{phrase}", "write one, for example '127 mm'": "{remedy}"}),
    "comma": ("7,2", "length", {"7.2": "{point}"}),
    "thousands": ("7,250", "length", {"7.250": "{point}", "7250": "{plain}"}),
    "several": ("7/2", "length", {}),
    "finite": ("1e999", "number", {}),
    "no_unit": (UNKNOWN, "number", {"'qqq'": "{unit}", "write one, for example 0.15": "{units}"}),
    "form": ("7 m*", "length", {"'m*'": "{unit}", "a name is missing": "{why}"}),
    "power": ("7 m^9", "length", {"'m^9'": "{unit}"}),
    "dimension": (
        "7 s",
        "length",
        {"a time": "{given}", "a length": "{phrase}", "write one, for example '127 mm'": "{remedy}"},
    ),
    "pounds": ("7 lb", "force", {"write lbf ": "write {unit} "}),
    "hertz": ("7 Hz", "angular_speed", {}),
}
"""Wrong input, the quantity that it is read as, and the parts of the message that vary."""


def _left_open(text: str, kind: str, places: dict[str, str]) -> str:
    message = _message(text, kind)
    for word, place in ({repr(text): "{text}"} | places).items():
        message = message.replace(word, place)
    return message


def _message(text: str, kind: str) -> str:
    return _refused(partial(quantity, text, kind))


def _refused(check: Callable[[], object]) -> str:
    """The message with which the model refuses a wrong value."""
    try:
        check()
    except ModelError as error:
        return str(error)
    raise AssertionError("it is not refused")


@cache
def sign_sentences() -> Tree:
    """Messages for a number with the wrong sign for its field."""
    return {
        sign: _refused(partial(check_sign, -1.0, "#", sign)).replace("'#'", "{text}")
        for sign in ("positive", "not negative")
    }
