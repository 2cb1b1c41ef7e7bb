"""Expressions of quantities, ``reaction.O2.x + reaction.O4.x``: parsed by our grammar, never executed."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping, Sequence

from dalembert.errors import ModelError
from dalembert.model.quantities.dimensions import Powers, dimension, kind_of_dimension
from dalembert.model.quantities.expression_trees import (
    COMPARISONS,
    REDUCTIONS,
    Apply,
    NameNode,
    NumberNode,
    Tree,
    names_in,
    nodes,
)
from dalembert.model.quantities.expressions import GRAMMAR, parse_expression
from dalembert.wording import closest, quote_value

COMPONENTS = ("x", "y", "z", "magnitude", "direction")
"""Components of a vector, after a dot."""

KEEP_KIND = ("+", "-", "max", "min", "abs", *REDUCTIONS)
"""Functions that keep the kind of their arguments."""


def parse_quantity(text: str, names: Sequence[str], what: str = "output") -> Tree:
    """The tree of an expression over quantities. Their names may hold signs, such as ``-``: of two names that fit the
    longer one is meant. Numbers are SI, or have a unit.

    >>> parse_quantity("2*effort.O-2 - 3 kN", ["effort.O", "effort.O-2"]).arguments[1].value
    3000.0
    """
    prefix = "quantity"
    while prefix in text:
        prefix += "y"
    matches: list[str] = []

    def mark(match: re.Match[str]) -> str:
        matches.append(match[0])
        return f"{prefix}{len(matches) - 1}"

    one = "|".join(re.escape(name) for name in sorted(names, key=len, reverse=True))
    plain = re.sub(rf"(?<![\w.])(?:{one})(?:\.(?:{'|'.join(COMPONENTS)}))?(?![\w.])", mark, text)
    unknown = re.search(r"[^\W\d][\w-]*(?:\.[\w-]+)+", plain)
    if unknown:
        raise ModelError(f"unknown {what} {unknown[0]!r}", closest(unknown[0], list(names)))
    try:
        tree, rest = parse_expression(plain, (), reductions=True)
        if rest:
            raise ModelError(f"{quote_value(plain)}: unexpected {quote_value(rest)} at the end", GRAMMAR)
    except ModelError as error:
        message = re.sub(prefix + r"(\d+)", lambda m: matches[int(m[1])], error.what)
        raise ModelError(message, error.remedy) from None
    places = {f"{prefix}{k}": name for k, name in enumerate(matches)}
    for name in names_in(tree) - places.keys():
        raise ModelError(f"unknown {what} {name!r}", closest(name, list(names)))
    return _rename(tree, places)


def _rename(tree: Tree, names: dict[str, str]) -> Tree:
    if isinstance(tree, NameNode):
        return NameNode(names[tree.name])
    if isinstance(tree, Apply):
        return Apply(tree.function, tuple(_rename(argument, names) for argument in tree.arguments))
    return tree


def check_units(tree: Tree, known: Mapping[str, Powers | None], parameters: Collection[str] = ()) -> None:
    """Raise ModelError where a number with a unit, or a parameter of those given, is added to, or compared with, a
    quantity of another kind. Plain numbers are SI beside anything, and so are weights in a sum of unlike quantities.

    >>> known = {"effort.O": (2, 1, -2, 0), "reaction.A.x": (1, 1, -2, 0)}
    >>> check_units(parse_quantity("abs(effort.O) + 0.1*reaction.A.x - 3 N*m", list(known)), known)
    >>> check_units(parse_quantity("reaction.A.x - 3 kg", list(known)), known)
    Traceback (most recent call last):
    dalembert.errors.ModelError: 'reaction.A.x - 3 kg' cannot be evaluated: reaction.A.x is a force, ...
    """
    for part in nodes(tree):
        if not isinstance(part, Apply) or part.function not in (*KEEP_KIND, *COMPARISONS):
            continue
        if any(_with_unit(a, [n for n in parameters if any(known.get(n) or ())]) for a in part.arguments):
            try:
                for argument in part.arguments:
                    dimension(argument, known)
            except ModelError:
                continue
            dimension(part, known)


def check_reductions(tree: Tree, functions: Collection[str]) -> None:
    """Raise ModelError for a reduction over the cycle where each position needs its value."""
    for part in nodes(tree):
        if isinstance(part, Apply) and part.function in REDUCTIONS and part.function not in functions:
            what = f"{part.function}(...) is a number of a complete cycle, and an output has one at every position"
            raise ModelError(
                what, "compile what is inside, with reduce=, or name it in an aim or a condition"
            )


def _with_unit(tree: Tree, parameters: Collection[str]) -> bool:
    """True if a part is of numbers and of names given alone, and has one of these or a number with a unit."""
    stated = any(isinstance(n, NumberNode) and n.text not in ("", "pi") for n in nodes(tree))
    return names_in(tree) <= set(parameters) and (stated or bool(names_in(tree)))


def kind_of(tree: Tree, kind: Callable[[str], str], parameters: Collection[str] = ()) -> str:
    """The kind of an expression's value: that of its quantities while they are added, compared and scaled; a `number`
    (in SI) otherwise."""
    if isinstance(tree, NameNode):
        return kind(tree.name)
    if isinstance(tree, NumberNode):
        return kind_of_dimension(tree.dimension) or "number" if any(tree.dimension[:3]) else ""
    if tree.function in COMPARISONS:
        return ""
    keeps = tree.function in KEEP_KIND
    arguments = [a for a in tree.arguments if not (keeps and _with_unit(a, parameters))] or tree.arguments
    kinds = [kind_of(argument, kind, parameters) for argument in arguments]
    scales = (tree.function == "*" and "" in kinds) or (tree.function == "/" and kinds[1] == "")
    named = set(kinds) - {""}
    if not named:
        return ""
    return named.pop() if len(named) == 1 and (scales or tree.function in KEEP_KIND) else "number"
