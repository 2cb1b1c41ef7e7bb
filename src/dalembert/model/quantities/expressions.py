"""Expressions in the drives' names, parsed against a fixed grammar of our own; nothing in a file is ever executed.

sum     = product {("+" | "-") product}
product = sign {("*" | "/") sign}
sign    = {"+" | "-"} power
power   = atom [("^" | "**") sign]          the exponent: a number from -16 to 16, without drives
atom    = NUMBER | "pi" | NAME | FUNCTION "(" sum {"," sum} ")" | "(" sum ")"

NAME is a drive, its speed (`O2.speed`), a coordinate (`time`, `links.rod.angle`) or a parameter of the file;
in an expression of parameters a NUMBER may have a unit: `r + 5 mm`.
"""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache

from dalembert.arrays import Array, Numeric
from dalembert.errors import ModelError
from dalembert.unit_names import NONE, SYMBOLS, unit
from dalembert.wording import closest, quote_value

GRAMMAR = (
    "an expression is made of numbers, names of drives and parameters, pi, + - * / ^, brackets and sin cos tan asin "
    "acos atan atan2 sqrt exp log abs sign min max"
)
ARGUMENTS = dict.fromkeys(
    ["sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "exp", "log", "abs", "sign"], 1
)
ARGUMENTS |= dict.fromkeys(("atan2", "min", "max"), 2)
"""Function -> how many arguments it takes."""

CONSTANTS = {"pi": math.pi}

LONGEST, DEEPEST, MOST, EXPONENT = 1000, 40, 200, 16
"""Characters, brackets, operations, and size of an exponent."""
Functions = Mapping[str, Callable[..., Numeric]]
OPERATORS: dict[str, Callable[[Numeric, Numeric], Numeric]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "^": operator.pow,
}
RANKS = {"+": 1, "-": 1, "*": 2, "/": 2, "^": 4}


@dataclass(frozen=True, slots=True)
class Number:
    """A number, in SI where it was written with a unit; `dimension` is that of its unit, `pi` may be an angle."""

    value: float
    text: str = ""
    dimension: tuple[float, float, float, float | None] = NONE


@dataclass(frozen=True, slots=True)
class Name:
    name: str


@dataclass(frozen=True, slots=True)
class Apply:
    """An operator (`+ - * / ^`, one argument: the sign) or a function applied to its arguments."""

    function: str
    arguments: tuple[Tree, ...]


Tree = Number | Name | Apply


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
            what = f"{quote_value(self.text)} ends with {quote_value(rest)}, which has no place there"
            raise ModelError(what, GRAMMAR)
        object.__setattr__(self, "tree", tree)

    @property
    def numbers(self) -> frozenset[str]:
        """The numbers that stand in it, as written."""
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
        said = [f"{name} = {x:.6g}" for name, x in values.items()]
        return "at " + ", ".join(said) if said else "anywhere"


def numpy_functions() -> Functions:
    """The functions of the grammar for numbers and arrays."""
    import numpy as np

    other = {"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2}
    other |= {"min": np.minimum, "max": np.maximum}
    return {name: other.get(name) or getattr(np, name) for name in ARGUMENTS}


def evaluate(tree: Tree, drives: Mapping[str, Numeric], functions: Functions) -> Numeric:
    """The value of a tree over anything that has operators, functions from the table given."""
    if isinstance(tree, Number):
        return tree.value
    if isinstance(tree, Name):
        if tree.name not in drives:
            raise unknown_name("an expression uses", tree.name, list(drives))
        return drives[tree.name]
    values = [evaluate(argument, drives, functions) for argument in tree.arguments]
    return apply_function(tree.function, values, functions)


def unknown_name(what: str, name: str, known: list[str]) -> ModelError:
    """The error that ``what`` goes by a name that has no value."""
    if name == "time":
        remedy = "give a drive a law of motion, or let forces move the machine: simulate"
        return ModelError(
            "a quantity goes by time, and several positions without a law have no times", remedy
        )
    return ModelError(f"{what} {name!r}, which is no drive", closest(name, known))


def apply_function(name: str, values: Sequence[Numeric], functions: Functions) -> Numeric:
    """The value of an operator or a function of its arguments."""
    if name in OPERATORS:
        return -values[0] if len(values) == 1 else _apply(name, *values)
    return functions[name](*values)


def _apply(sign: str, a: Numeric, b: Numeric) -> Numeric:
    if isinstance(a, float) and isinstance(b, float):
        import numpy as np

        return OPERATORS[sign](np.float64(a), np.float64(b))
    return OPERATORS[sign](a, b)


def names_in(tree: Tree) -> frozenset[str]:
    """The names of drives and parameters in a tree."""
    return frozenset(node.name for node in nodes(tree) if isinstance(node, Name))


def nodes(tree: Tree) -> Iterator[Tree]:
    """The tree and everything in it."""
    yield tree
    if isinstance(tree, Apply):
        for argument in tree.arguments:
            yield from nodes(argument)


def expression_text(tree: Tree, rank: int = 0) -> str:
    """The tree as text that parses to the same tree.

    >>> expression_text(parse_expression("2*( (O2) + 1)^2")[0])
    '2*(O2 + 1)^2'
    """
    if isinstance(tree, Number):
        exact = tree.value == round(tree.value, 12)
        return tree.text or (repr(tree.value).removesuffix(".0") if exact else f"{tree.value:.17g}")
    if isinstance(tree, Name):
        return tree.name
    if tree.function not in OPERATORS:
        return f"{tree.function}({', '.join(expression_text(argument) for argument in tree.arguments)})"
    own = RANKS[tree.function]
    if len(tree.arguments) == 1:
        own, said = 3, "-" + expression_text(tree.arguments[0], 3)
    else:
        left, right = tree.arguments
        space = " " if own == 1 else ""
        base = own + 1 if own == 4 else own
        last = expression_text(right, 3 if own == 4 else own + 1)
        said = f"{expression_text(left, base)}{space}{tree.function}{space}{last}"
    return f"({said})" if own < rank else said


_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[^\W\d]\w*(?:\.\w+\.\w+|\.speed\b)?)|(?P<sign>\*\*|[-+*/^(),]))"
)


_UNIT = re.compile(r"\s*([^\W\d_]+|[°%])(\s*(?:\^|\*\*)\s*-?[1-6])?")
_MORE = re.compile(r"\s*[*/·]" + _UNIT.pattern + r"(?!\w|\s*\()")


def parse_expression(text: str, parameters: Iterable[str] | None = None) -> tuple[Tree, str]:
    """The tree of the longest expression that the text begins with, and the text left over.

    With `parameters`, names or none, a number may have a unit behind it.
    """
    return _parse(text, None if parameters is None else frozenset(parameters))


@lru_cache(maxsize=1024)
def _parse(text: str, parameters: frozenset[str] | None) -> tuple[Tree, str]:
    if len(text) > LONGEST:
        what = f"an expression of {len(text)} characters is too long"
        raise ModelError(what, f"at most {LONGEST}; use a table instead")
    parser = _Parser(text.replace("\u2212", "-"), parameters)
    tree = parser.sum(0)
    return tree, text[parser.place :].strip()


class _Parser:
    """Recursive descent over the grammar at the head of this file."""

    def __init__(self, text: str, parameters: frozenset[str] | None) -> None:
        self.text, self.place, self.operations = text, 0, 0
        self.parameters = parameters

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
        found = self.sign_among(("+", "-"))
        if found is None:
            return self.power(depth)
        inner = self.sign(depth + 1)
        return inner if found == "+" else Apply("-", (inner,))

    def power(self, depth: int) -> Tree:
        base = self.atom(depth)
        if not self.sign_among(("^", "**")):
            return base
        exponent = self.sign(depth + 1)
        value = _constant(exponent)
        if value is None or abs(value) > EXPONENT:
            words = f"has an exponent that is no number from -{EXPONENT} to {EXPONENT}"
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
            return self.close_bracket(self.sum(depth + 1))
        return self.parse_name(match["name"], depth)

    def number(self, digits: str) -> Number:
        """A number, with the unit behind it in an expression of parameters."""
        value, start = _finite(digits), self.place
        match = _UNIT.match(self.text, start) if self.parameters is not None else None
        if match is None or self.parameters is None:
            return Number(value)
        if match[1] in self.parameters:
            what = f"{quote_value(self.text)} has a number beside the parameter {match[1]!r}"
            raise ModelError(what, f"write {digits}*{match[1]}")
        while match and (match.start() == start or match[1] in SYMBOLS):
            self.place = match.end()
            match = _MORE.match(self.text, self.place)
        name = self.text[start : self.place].strip()
        named = unit(name)
        return Number(named.si(value), f"{digits} {name}", named.dimension)

    def parse_name(self, name: str, depth: int) -> Tree:
        call = self.sign_among(("(",))
        if call and name not in ARGUMENTS:
            raise ModelError(f"there is no function {quote_value(name)} in an expression", GRAMMAR)
        if call:
            return self.parse_call(name, depth)
        if name in CONSTANTS:
            return Number(CONSTANTS[name], name if self.parameters is not None else "", (0, 0, 0, None))
        if name in ARGUMENTS:
            raise ModelError(f"the function {name} stands without its brackets", f"write {name}(...)")
        if "__" in name:
            raise self.refusal(name)
        return Name(name)

    def parse_call(self, name: str, depth: int) -> Tree:
        arguments = [self.sum(depth + 1)]
        while self.sign_among((",",)):
            arguments.append(self.sum(depth + 1))
        tree = self.close_bracket(Apply(name, tuple(arguments)))
        if len(arguments) != ARGUMENTS[name]:
            what = f"{name} is given {len(arguments)} arguments in {quote_value(self.text)}"
            raise ModelError(what, f"it takes {ARGUMENTS[name]}")
        return tree

    def close_bracket(self, tree: Tree) -> Tree:
        if not self.sign_among((")",)):
            raise self.refusal("", "a bracket is not closed")
        return tree

    def refusal(self, found: str = "", why: str = "") -> ModelError:
        rest = found or self.text[self.place :].strip()
        why = why or (f"{quote_value(rest[:20])} has no place there" if rest else "it stops in the middle")
        return ModelError(f"{quote_value(self.text)} is no expression: {why}", GRAMMAR)


def _finite(digits: str) -> float:
    value = float(digits)
    if not math.isfinite(value):
        raise ModelError(f"{quote_value(digits)} is no finite number", "write a finite one")
    return value


def _constant(tree: Tree) -> float | None:
    if any(isinstance(node, Name) for node in nodes(tree)):
        return None
    import numpy as np

    with np.errstate(all="ignore"):
        value = float(evaluate(tree, {}, numpy_functions()))
    return value if math.isfinite(value) else None
