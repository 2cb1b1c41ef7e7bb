"""Expressions of quantities, ``reaction.O2.x + reaction.O4.x``: parsed by our grammar, never executed."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from dalembert.errors import ModelError
from dalembert.model.quantities.dimensions import dimension
from dalembert.model.quantities.expressions import (
    GRAMMAR,
    Apply,
    Name,
    Number,
    Tree,
    names_in,
    nodes,
    parse_expression,
)
from dalembert.units import KINDS
from dalembert.wording import closest, quote_value

COMPONENTS = ("x", "y", "z", "magnitude")
"""Of a vector, behind a dot."""

KEEP_KIND = ("+", "-", "max", "min", "abs")
"""What gives a quantity of the kind of its arguments."""


def parse_quantity(text: str, names: Sequence[str], what: str = "output") -> Tree:
    """The tree of an expression over quantities. Their names may hold signs, such as ``-``: of two names that fit the
    longer one is meant. Numbers are SI, or have a unit.

    >>> parse_quantity("2*effort.O-2 - 3 kN", ["effort.O", "effort.O-2"]).arguments[1].value
    3000.0
    """
    prefix = "quantity"
    while prefix in text:
        prefix += "y"
    found: list[str] = []

    def mark(match: re.Match[str]) -> str:
        found.append(match[0])
        return f"{prefix}{len(found) - 1}"

    one = "|".join(re.escape(name) for name in sorted(names, key=len, reverse=True))
    plain = re.sub(rf"(?<![\w.])(?:{one})(?:\.(?:{'|'.join(COMPONENTS)}))?(?![\w.])", mark, text)
    unknown = re.search(r"[^\W\d][\w-]*(?:\.[\w-]+)+", plain)
    if unknown:
        raise ModelError(f"there is no {what} {unknown[0]!r}", closest(unknown[0], list(names)))
    try:
        tree, rest = parse_expression(plain, ())
        if rest:
            raise ModelError(
                f"{quote_value(plain)} ends with {quote_value(rest)}, which has no place there", GRAMMAR
            )
    except ModelError as error:
        told = re.sub(prefix + r"(\d+)", lambda m: found[int(m[1])], error.what)
        raise ModelError(told, error.remedy) from None
    places = {f"{prefix}{k}": name for k, name in enumerate(found)}
    for name in names_in(tree) - places.keys():
        raise ModelError(f"there is no {what} {name!r}", closest(name, list(names)))
    return _rename(tree, places)


def _rename(tree: Tree, names: dict[str, str]) -> Tree:
    if isinstance(tree, Name):
        return Name(names[tree.name])
    if isinstance(tree, Apply):
        return Apply(tree.function, tuple(_rename(argument, names) for argument in tree.arguments))
    return tree


def check_units(tree: Tree, kind: Callable[[str], str]) -> None:
    """Raise ModelError where what is written with a unit is added to, or compared with, a quantity of another kind.
    Plain numbers are SI beside anything, and so are weights in a sum of unlike quantities.

    >>> kinds = {"effort.O": "moment", "magnitude.A": "force"}
    >>> check_units(parse_quantity("abs(effort.O) + 0.1*magnitude.A - 3 N*m", list(kinds)), kinds.__getitem__)
    >>> check_units(parse_quantity("magnitude.A - 3 kg", list(kinds)), kinds.__getitem__)
    Traceback (most recent call last):
    dalembert.errors.ModelError: 'magnitude.A - 3 kg' cannot be: magnitude.A is a force, and 3 kg is a mass; ...
    """
    known = {name: KINDS[kind(name)].dimension for name in names_in(tree)}
    for part in nodes(tree):
        if isinstance(part, Apply) and part.function in KEEP_KIND and any(map(_with_unit, part.arguments)):
            try:
                for argument in part.arguments:
                    dimension(argument, known)
            except ModelError:
                continue
            dimension(part, known)


def _with_unit(tree: Tree) -> bool:
    """Whether a part is of numbers alone, and some of them have a unit."""
    return not names_in(tree) and any(isinstance(n, Number) and n.text not in ("", "pi") for n in nodes(tree))


def kind_of(tree: Tree, kind: Callable[[str], str]) -> str:
    """The kind of an expression's value: that of its quantities while they are added, compared and scaled; a `number`
    (in SI) otherwise."""
    if isinstance(tree, Name):
        return kind(tree.name)
    if isinstance(tree, Number):
        return ""
    kinds = [kind_of(argument, kind) for argument in tree.arguments]
    scales = (tree.function == "*" and "" in kinds) or (tree.function == "/" and kinds[1] == "")
    named = set(kinds) - {""}
    if not named:
        return ""
    return named.pop() if len(named) == 1 and (scales or tree.function in KEEP_KIND) else "number"
