"""Expressions in the drives' names, parsed by a fixed grammar; text of a file is never executed.

sum     = product {("+" | "-") product}
product = sign {("*" | "/") sign}
sign    = {"+" | "-"} power
power   = atom [("^" | "**") sign]          the exponent: a number from -16 to 16, without drives
atom    = NUMBER [UNIT] | "pi" | NAME | FUNCTION "(" sum {"," sum} ")" | "(" sum [COMPARISON sum] ")"

NAME is a drive, `time`, a coordinate (`links.rod.angle`, `angle.rod`), a speed of these (`O2.speed`), or a parameter.
COMPARISON is >= <= > <, worth 1 or 0. A UNIT ends before a name and a function: `40 N*sin(O2)`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache

from dalembert.arrays import Array, Numeric
from dalembert.errors import ModelError
from dalembert.model.quantities.expression_trees import (
    ARGUMENTS,
    COMPARISONS,
    MANY,
    REDUCTIONS,
    Apply,
    Functions,
    NameNode,
    NumberNode,
    Tree,
    evaluate,
    names_in,
    nodes,
    numpy_functions,
)
from dalembert.unit_names import SYMBOLS, unit
from dalembert.wording import quote_value

GRAMMAR = (
    "an expression is made of numbers, names of drives and parameters, pi, + - * / ^, brackets, comparisons in "
    "brackets and sin cos tan asin acos atan atan2 sqrt exp log abs sign min max"
)
CONSTANTS = {"pi": math.pi}

LONGEST, DEEPEST, MOST, EXPONENT = 1000, 40, 200, 16
"""Characters, brackets, operations, and size of an exponent."""


@dataclass(frozen=True, slots=True)
class Expression:
    """A quantity as an expression in the drives' positions (radians, metres), its result in `unit`.

    >>> Expression("500*sin(O2)", "N").at({"O2": 0.5})
    np.float64(239.712769302...)
    """

    text: str
    unit: str = ""
    parameters: tuple[tuple[str, Numeric], ...] | None = field(default=None, repr=False)
    """The parameters it uses and their SI values; with them a number may have a unit."""
    tree: Tree = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        known = None if self.parameters is None else [name for name, _ in self.parameters]
        tree, rest = parse_expression(self.text, known)
        if rest:
            what = f"{quote_value(self.text)}: unexpected {quote_value(rest)} at the end"
            raise ModelError(what, GRAMMAR)
        object.__setattr__(self, "tree", tree)

    @property
    def numbers(self) -> frozenset[str]:
        """Numbers in it, as written."""
        return frozenset(match["number"] for match in _TOKEN.finditer(self.text) if match["number"])

    @property
    def names(self) -> frozenset[str]:
        """The drives and coordinates (`time`, `links.rod.angle`) it uses."""
        return names_in(self.tree) - {name for name, _ in self.parameters or ()}

    def at(self, drives: Mapping[str, Numeric], functions: Functions | None = None) -> Numeric:
        """The SI value at the drives' positions; `functions` replaces numpy's, for values of another kind."""
        scale = unit(self.unit) if self.unit else None
        drives = {**drives, **dict(self.parameters)} if self.parameters else drives
        value = evaluate(self.tree, drives, functions) if functions else self._of_numbers(drives)
        return value if scale is None else scale.si(value)

    def _of_numbers(self, drives: Mapping[str, Numeric]) -> Numeric:
        import numpy as np

        with np.errstate(all="ignore"):
            value = np.asarray(evaluate(self.tree, drives, numpy_functions()), float)
        if not np.isfinite(value).all():
            what = f"the expression {quote_value(self.text)} has no finite value {self._where(drives, value)}"
            other = "the range of the drive" if self.names else "what it follows from"
            raise ModelError(what, f"change it, or {other}")
        return value[()]

    def _where(self, drives: Mapping[str, Numeric], value: Array) -> str:
        import numpy as np

        first = np.argmin(np.isfinite(value).ravel())
        shape = np.shape(value)
        values = {name: np.broadcast_to(drives[name], shape).ravel()[first] for name in sorted(self.names)}
        parts = [f"{name} = {x:.6g}" for name, x in values.items()]
        return "at " + ", ".join(parts) if parts else "anywhere"


_NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_QUANTITY = r"(?:angle|drive|(?:slide|turn)[12]?)\.(?!speed\b)\w+(?:\.speed\b)?"
_NAME = rf"{_QUANTITY}|[^\W\d]\w*(?:\.\w+\.\w+(?:\.speed\b)?|\.speed\b)?"
_TOKEN = re.compile(rf"\s*(?:(?P<number>{_NUMBER})|(?P<name>{_NAME})|(?P<sign>\*\*|[<>]=?|[-+*/^(),]))")


_WORD = re.compile(r"([^\W\d]\w*)\s*(\(?)")
_UNIT = re.compile(r"\s*([^\W\d_]+|[°%])(\s*(?:\^|\*\*)\s*-?[1-6])?")
_MORE = re.compile(r"\s*[*/·]" + _UNIT.pattern + r"(?!\w|\.\w|\s*\()")


def parse_expression(
    text: str, parameters: Iterable[str] | None = None, reductions: bool = False
) -> tuple[Tree, str]:
    """The tree of the longest expression that the text begins with, and the text left over.

    With `parameters`, names or none, a number may have a unit behind it; none of the names is read as a unit.
    reductions: functions over the cycle are read, `peak(effort.O)`; elsewhere they are refused.
    """
    return _parse(text, None if parameters is None else frozenset(parameters), reductions)


PATHS = ("links.", "joints.")


def long_name(word: str, thing: str) -> str:
    """The path of a coordinate that a quantity's name gives: of `slide` and `G` `joints.G.slide`."""
    return {"angle": f"links.{thing}.angle", "drive": thing}.get(word, f"joints.{thing}.{word}")


def long_names(text: str) -> str:
    """An expression with the names of quantities as paths of coordinates.

    >>> long_names("2*slide.G + sin(angle.rod) - drive.O.speed")
    '2*joints.G.slide + sin(links.rod.angle) - O.speed'
    """
    return _SHORT.sub(lambda match: long_name(match[1], match[2]), text)


_SHORT = re.compile(r"(?<![\w.])(angle|drive|(?:slide|turn)[12]?)\.(?!speed\b)(\w+)")


def units_inside(text: str, names: Iterable[str] = ()) -> bool:
    """True if a text is an expression with a unit at a number inside, among drives of these names.

    A unit behind an expression that has no other is one of its result: `2*sin(O) + 1 kN` is in kN throughout.

    >>> [units_inside(text) for text in ("40 N*sin(O)", "2*(O + 1 N)", "2*sin(O) kN", "12 N-m", "40 N*m")]
    [True, True, False, False, False]
    """
    if not _NUMBER_WITH_UNIT.search(text):
        return False
    try:
        rest = parse_expression(text)[1]
    except ModelError:
        return True
    known = {*names, *ARGUMENTS, "time"} - SYMBOLS.keys()
    words = _PATH.findall(long_names(rest))
    return rest[:1].isalpha() and (
        bool(_MORE_TERMS.search(rest))
        or any(word.removesuffix(".speed") in known or word.startswith(PATHS) for word in words)
    )


_NUMBER_WITH_UNIT = re.compile(r"(?<![\w.])(?>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*[^\W\d_]")
_PATH = re.compile(r"[^\W\d]\w*(?:\.\w+)*")
_MORE_TERMS = re.compile(r"(?<![\^*])\s*[-*/(]\s*\d|\+|[^\W\d_]\w*\s*\(\s*[\d-]")


@lru_cache(maxsize=1024)
def _parse(text: str, parameters: frozenset[str] | None, reductions: bool) -> tuple[Tree, str]:
    if len(text) > LONGEST:
        what = f"an expression of {len(text)} characters is too long"
        raise ModelError(what, f"at most {LONGEST}; use a table instead")
    parser = _Parser(text.replace("\u2212", "-"), parameters, reductions)
    tree = parser.sum(0)
    return tree, text[parser.place :].strip()


class _Parser:
    """Recursive descent over the grammar at the head of this file."""

    def __init__(self, text: str, parameters: frozenset[str] | None, reductions: bool = False) -> None:
        self.text, self.place, self.operations = text, 0, 0
        self.parameters = parameters
        self.functions = ARGUMENTS | dict.fromkeys(REDUCTIONS if reductions else (), 1)

    def error(self, what: str, remedy: str) -> ModelError:
        return ModelError(f"the expression {quote_value(self.text)} {what}", remedy)

    def peek(self) -> re.Match[str] | None:
        return _TOKEN.match(self.text, self.place)

    def sign_among(self, signs: tuple[str, ...]) -> str | None:
        match = self.peek()
        if match is None or match["sign"] not in signs:
            return None
        self.place = match.end()
        return str(match["sign"])

    def sum(self, depth: int) -> Tree:
        if depth > DEEPEST:
            raise self.error(f"is nested deeper than {DEEPEST}", "use fewer brackets")
        return self.chain(("+", "-"), self.product, depth)

    def product(self, depth: int) -> Tree:
        return self.chain(("*", "/"), self.sign, depth)

    def chain(self, signs: tuple[str, ...], part: Callable[[int], Tree], depth: int) -> Tree:
        tree = part(depth)
        while sign := self.sign_among(signs):
            tree = Apply(sign, (tree, part(depth)))
            self.operations += 1
            if self.operations > MOST:
                raise self.error(f"has more than {MOST} operations", "use a table instead")
        return tree

    def sign(self, depth: int) -> Tree:
        if depth > DEEPEST:
            raise self.error(f"is nested deeper than {DEEPEST}", "use fewer signs")
        sign = self.sign_among(("+", "-"))
        if sign is None:
            return self.power(depth)
        inner = self.sign(depth + 1)
        return inner if sign == "+" else Apply("-", (inner,))

    def power(self, depth: int) -> Tree:
        base = self.atom(depth)
        if not self.sign_among(("^", "**")):
            return base
        exponent = self.sign(depth + 1)
        value = _constant(exponent)
        if value is None or abs(value) > EXPONENT:
            words = f"has an exponent that is not a number from -{EXPONENT} to {EXPONENT}"
            raise self.error(words, GRAMMAR)
        return Apply("^", (base, exponent))

    def atom(self, depth: int) -> Tree:
        match = self.peek()
        if match is None or (match["sign"] and match["sign"] != "("):
            raise self.refusal()
        self.place = match.end()
        if match["number"]:
            return self.number(match["number"])
        if match["sign"]:
            return self.close_bracket(self.condition(depth + 1), match.start("sign"))
        return self.parse_name(match["name"], depth)

    def number(self, digits: str) -> NumberNode:
        """A number, with the unit behind it in an expression of parameters."""
        value, start = _finite(digits), self.place
        match = _UNIT.match(self.text, start) if self.parameters is not None else None
        if match is None or self.parameters is None:
            return NumberNode(value)
        self.refuse_beside(digits, match.start(1))
        while match and (match.start() == start or (match[1] in SYMBOLS and match[1] not in self.parameters)):
            self.place = match.end()
            match = _MORE.match(self.text, self.place)
        name = self.text[start : self.place].strip()
        named = unit(name)
        return NumberNode(named.si(value), f"{digits} {name}", named.dimension)

    def refuse_beside(self, digits: str, place: int) -> None:
        """Raise ModelError where a name or a function follows a number without a sign between them."""
        word = _WORD.match(self.text, place)
        if word is None or self.parameters is None:
            return
        call = word[1] in ARGUMENTS and (word[1] not in SYMBOLS or word[2] == "(")
        if call or word[1] in self.parameters:
            what = f"{quote_value(self.text)} has a number beside {word[1]!r}"
            raise ModelError(what, f"write {digits}*{word[1]}{'(...)' if call else ''}")

    def parse_name(self, name: str, depth: int) -> Tree:
        call = self.sign_among(("(",))
        if call and name in REDUCTIONS and name not in self.functions:
            what = f"{quote_value(self.text)}: {name}(...) is a number of a complete cycle"
            raise ModelError(what, "use it in an aim, a condition or a limit; here each position has a value")
        if call and name not in self.functions:
            raise ModelError(f"unknown function {quote_value(name)}", GRAMMAR)
        if call:
            return self.parse_call(name, depth, self.place - 1)
        if name in CONSTANTS:
            return NumberNode(CONSTANTS[name], name if self.parameters is not None else "", (0, 0, 0, None))
        if name in ARGUMENTS:
            raise ModelError(f"the function {name} needs brackets", f"write {name}(...)")
        if "__" in name:
            raise self.refusal(name)
        return NameNode(long_names(name))

    def parse_call(self, name: str, depth: int, opened: int) -> Tree:
        arguments = [self.sum(depth + 1)]
        while self.sign_among((",",)):
            arguments.append(self.sum(depth + 1))
        least, more = self.functions[name], name in MANY
        if len(arguments) < least or (len(arguments) > least and not more):
            what = f"{name} is given {len(arguments)} arguments in {quote_value(self.text)}"
            raise ModelError(what, f"it takes {least}{' or more' if more else ''}")
        first: tuple[Tree, ...] = tuple(arguments[:least])
        tree: Tree = Apply(name, first)
        for argument in arguments[least:]:
            tree = Apply(name, (tree, argument))
        self.operations += len(arguments) - least
        return self.close_bracket(tree, opened)

    def condition(self, depth: int) -> Tree:
        """A sum, or the comparison of two."""
        left = self.sum(depth)
        comparison = self.sign_among(COMPARISONS)
        return Apply(comparison, (left, self.sum(depth))) if comparison else left

    def close_bracket(self, tree: Tree, opened: int) -> Tree:
        if self.sign_among((")",)):
            return tree
        if self.text[self.place :].strip():
            raise self.refusal()
        what = f"{quote_value(self.text)}: the bracket '(' at column {opened + 1} is never closed"
        raise ModelError(what, "write ')' where it ends")

    def refusal(self, text: str = "", why: str = "") -> ModelError:
        rest = text or self.text[self.place :].strip()
        why = why or (f"unexpected {quote_value(rest[:20])}" if rest else "it is incomplete")
        return ModelError(f"{quote_value(self.text)} is not an expression: {why}", GRAMMAR)


def _finite(digits: str) -> float:
    value = float(digits)
    if not math.isfinite(value):
        raise ModelError(f"{quote_value(digits)} is not a finite number", "write a finite one")
    return value


def _constant(tree: Tree) -> float | None:
    if any(isinstance(node, NameNode) for node in nodes(tree)):
        return None
    import numpy as np

    with np.errstate(all="ignore"):
        value = float(evaluate(tree, {}, numpy_functions()))
    return value if math.isfinite(value) else None
