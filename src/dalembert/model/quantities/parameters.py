"""Named parameters of a file, and the numbers that follow from them."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

from dalembert.arrays import Numeric
from dalembert.errors import ModelError
from dalembert.model.quantities.dependent_numbers import Dependent, dependent_text, with_new
from dalembert.model.quantities.dimensions import (
    OF_TURN,
    Powers,
    dimension,
    is_bare,
    kind_of_dimension,
    phrase,
    si_unit,
)
from dalembert.model.quantities.expression_trees import ARGUMENTS, Functions, names_in
from dalembert.model.quantities.expressions import CONSTANTS, Expression, parse_expression
from dalembert.model.quantities.figures import shortest, without_fraction
from dalembert.unit_names import NONE, ONE, SYMBOLS, Dimension, unit
from dalembert.units import KINDS, NUMBER, REFUSED_BARE, Units, check_unit, quantity
from dalembert.wording import closest, quote_value

RESERVED = ("none", "standard", "unknown", "nan", "inf", "infinity", "time")
"""Words with another meaning where a quantity is expected."""
KEYS = ("value", "about", "range")
_WORD = re.compile(r"(?<![\w.])[^\W\d]\w*")


@dataclass(frozen=True, slots=True)
class Parameter:
    """A named quantity of a file.

    value:     SI; of an expression of other parameters a number that keeps the expression
    dimension: powers of length, mass, time and angle
    unit:      the unit it was written in; of an expression the file's
    about:     what it is, in words
    range:     between which values it makes sense, SI
    """

    value: float
    dimension: Powers
    unit: str = field(default="", compare=False)
    about: str = ""
    range: tuple[float, float] | None = None

    @property
    def kind(self) -> str | None:
        """Kind of the quantity, such as `length`; None where the kind has no name."""
        return kind_of_dimension(self.dimension)

    def in_unit(self, number: float | None = None) -> float:
        """Its value, or another SI number, in its unit.

        >>> Parameter(0.045, (1, 0, 0, 0), "mm").in_unit()
        45.0
        """
        number = self.value if number is None else number
        return unit(self.unit).of_si(number) if self.unit else float(number)

    def tree(self) -> object:
        """Form of the parameter in a file."""
        value = dependent_text(self.value) if isinstance(self.value, Dependent) else self._text(self.value)
        beside = {"about": self.about} if self.about else {}
        ends = {"range": [self._text(x) for x in self.range]} if self.range else {}
        return {"value": value, **beside, **ends} if beside or ends else value

    def _text(self, number: float) -> object:
        value = shortest(number, unit(self.unit)) if self.unit else without_fraction(number)
        if value is None:
            return f"{number!r} {si_unit(self.dimension)}"
        return f"{value} {self.unit}" if self.unit else value


Parameters = Mapping[str, Parameter]


def uses(value: object, names: Mapping[str, object]) -> bool:
    """True if a text contains one of the names."""
    return isinstance(value, str) and any(word in names for word in _WORD.findall(value))


def of_parameters(
    text: str,
    kind: str,
    units: Units | None,
    parameters: Parameters,
    drives: Mapping[str, str],
    unit_text: str = "",
) -> float | Expression:
    """The number that an expression of parameters gives; with drives in it, the expression.

    A plain number that it comes to is in the unit given, or in the file's, as a bare number is. Raises ModelError where
    it is another kind of quantity.
    """
    if unit_text:
        check_unit(unit_text, kind)
    expression, of = _read(text, parameters, drives)
    if expression.unit:
        check_unit(expression.unit, kind)
    elif is_bare(of, kind, text):
        if units is not None and units.refuses_bare(kind) and not unit_text:
            what = f"{quote_value(text)} is {KINDS[kind].phrase} without a unit"
            raise ModelError(what, f"write ({text}) with its unit behind it: {REFUSED_BARE[kind]}")
        expression = replace(expression, unit=unit_text or (units.text(kind) if units else KINDS[kind].si))
    if expression.names:
        return expression
    return Dependent(expression) if expression.parameters else float(expression.at({}))


def _read(text: str, parameters: Parameters, drives: Mapping[str, str]) -> tuple[Expression, Powers | None]:
    """An expression and its dimension; a unit behind it is that of a plain number."""
    text = _without_unit_names(text, {*parameters, *drives})
    tree, rest = parse_expression(text, {*parameters, *drives})
    names = names_in(tree)
    if parameters:
        refuse_unknown(text, names, parameters, drives)
    known: dict[str, Powers | None] = dict.fromkeys(names)  # of any dimension: the description checks names
    known |= {n: p.dimension for n, p in parameters.items()} | {n: OF_TURN[d] for n, d in drives.items()}
    of = dimension(tree, known)
    if rest and re.match(r"[^\W\d]|[°%]", rest):
        named = unit(rest)
        text = text.strip()[: -len(rest)].strip()
        if of is not None and (any(of[:3]) or of[3]):
            what = f"{quote_value(text)} is {phrase(of)} by itself, and has the unit {rest!r} behind it"
            raise ModelError(what, "leave the unit out")
        return _expression(text, parameters, rest), named.dimension
    return _expression(text, parameters), of


def _without_unit_names(text: str, names: Collection[str]) -> str:
    """The text with names that are units too in brackets, where they are factors: `40 N*(t)` of a drive t."""
    both = "|".join(sorted(SYMBOLS.keys() & names))
    return re.sub(rf"(?<=[*/])(\s*)({both})\b(?!\s*\()", r"\1(\2)", text) if both else text


def _expression(text: str, parameters: Parameters, name: str = "") -> Expression:
    names = sorted(set(_WORD.findall(text)) & parameters.keys())
    return Expression(text, name, tuple((name, parameters[name].value) for name in names))


def stated_dimension(value: object, parameters: Parameters) -> Dimension | None:
    """The dimension that a text says by its unit or its parameters; None of a bare number."""
    if not isinstance(value, str):
        return None
    if uses(value, parameters):
        of = _read(value, parameters, {})[1] or NONE
        return (int(of[0]), int(of[1]), int(of[2]), int(of[3] or 0)) if any(of) else None
    match = re.fullmatch(rf"\s*(?>{NUMBER})\s*([^\W\d].*|[°%].*)", value.replace("\u2212", "-"))
    return unit(match[1]).dimension if match else None


def refuse_unknown(
    text: object, names: frozenset[str], parameters: Mapping[str, object], drives: Mapping[str, str]
) -> None:
    """Raise ModelError for a name in an expression that is neither a parameter nor a drive."""
    for name in sorted(names - {*parameters, *drives}):
        what = f"{quote_value(text)} uses {name!r}, which is not a parameter"
        raise ModelError(what, closest(name, [*parameters, *drives]))


def refuse_other_names(text: str, parameters: Parameters) -> None:
    """Raise ModelError where a text is an expression with names that are not parameters."""
    try:
        names = names_in(parse_expression(text, parameters)[0])
    except ModelError:
        return
    refuse_unknown(text, names, parameters, {})


def read_parameters(
    tree: object, units: Units | None, drives: Mapping[str, str], keys: Sequence[str] = ()
) -> dict[str, Parameter]:
    """Parameters of a file's `parameters`.

    keys: the file's keys, which parameters may not use as names. Raises ModelError for a cycle, an unknown name, a name
    that means something else, and quantities that do not fit together.

    >>> found = read_parameters({"area": "pi*bore^2/4", "bore": "80 mm"}, None, {})
    >>> found["area"].value, found["area"].unit, found["bore"].in_unit()
    (0.005026548245743669, 'm^2', 80.0)
    """
    if not isinstance(tree, Mapping):
        what = f"expected a mapping, not {quote_value(tree)}"
        raise ModelError(what, "write {r: 45 mm}", ("parameters",))
    parameters: dict[str, Parameter] = {}
    for name in tree:
        with _parameter_path(name):
            _check_name(name, drives, keys)
    for name in tree:
        _resolve(name, tree, units, parameters, ())
    return {name: parameters[name] for name in tree}


@contextmanager
def _parameter_path(name: object) -> Iterator[None]:
    """Assigns errors inside to the parameter."""
    try:
        yield
    except ModelError as error:
        path = ("parameters", str(name), *error.path)
        raise ModelError(f"parameter {name!r}: {error.what}", error.remedy, path) from None


def _check_name(name: object, drives: Mapping[str, str], keys: Sequence[str]) -> None:
    means = {
        **dict.fromkeys(RESERVED, "a word of the file"),
        **dict.fromkeys(keys, "a key of the file"),
        **dict.fromkeys(SYMBOLS, "a unit"),
        **dict.fromkeys(ARGUMENTS, "a function"),
        **dict.fromkeys(CONSTANTS, "a constant"),
        **dict.fromkeys(drives, "a drive"),
    }
    if not isinstance(name, str) or not re.fullmatch(r"[^\W\d]\w*", name) or "__" in name:
        what = "its name cannot be used in expressions"
        raise ModelError(what, "write a word of letters, digits and _, as in rod_length")
    if name in means:
        raise ModelError(f"its name is that of {means[name]}", f"call it otherwise, for example {name}_1")


def _resolve(
    name: str,
    tree: Mapping[str, object],
    units: Units | None,
    resolved: dict[str, Parameter],
    path: tuple[str, ...],
) -> None:
    """Find a parameter, after those it follows from."""
    if name in resolved:
        return
    if name in path:
        with _parameter_path(name):
            circle = " from ".join([*path[path.index(name) :], name])
            raise ModelError(f"it follows from itself: {circle}", "give one of them a value")
    for other in _WORD.findall(_text(tree[name])):
        if other in tree:
            _resolve(other, tree, units, resolved, (*path, name))
    with _parameter_path(name):
        resolved[name] = _parameter(tree[name], units, resolved, tree)


def _text(entry: object) -> str:
    """The expression that a parameter may be."""
    if isinstance(entry, Parameter):
        return entry.value.expression.text if isinstance(entry.value, Dependent) else ""
    text = entry.get("value") if isinstance(entry, Mapping) else entry
    return text if isinstance(text, str) else ""


def _parameter(
    entry: object, units: Units | None, resolved: Parameters, tree: Mapping[str, object]
) -> Parameter:
    if isinstance(entry, Parameter):
        return replace(entry, value=with_new(entry.value, values_of(resolved, {})))
    if not isinstance(entry, Mapping):
        return _value(entry, units, resolved, tree)
    for key in entry:
        if key not in KEYS:
            raise ModelError(f"unknown key {quote_value(key)}", closest(str(key), list(KEYS)), (key,))
    if "value" not in entry:
        raise ModelError("the key 'value' is missing", "write {value: 45 mm, about: ...}")
    try:
        of = _value(entry["value"], units, resolved, tree)
    except ModelError as error:
        raise ModelError(error.what, error.remedy, ("value",)) from None
    if not isinstance(about := entry.get("about", ""), str):
        raise ModelError(f"{quote_value(about)} is not text", "put it in quotes", ("about",))
    return replace(of, about=about, range=_range(entry.get("range"), of, units))


def _value(entry: object, units: Units | None, resolved: Parameters, tree: Mapping[str, object]) -> Parameter:
    if not isinstance(entry, str):
        return Parameter(quantity(entry, "number"), NONE)
    match = re.fullmatch(rf"\s*((?>{NUMBER}))\s*(|[^\W\d].*|[°%].*)\s*", entry.replace("\u2212", "-"))
    if match and not uses(match[2], tree):
        try:
            named = unit(match[2].strip()) if match[2] else ONE
        except ModelError:
            if re.fullmatch(r"[\w°%]*", match[2]):
                raise
        else:
            return Parameter(named.si(float(match[1])), named.dimension, match[2].strip())
    refuse_unknown(entry, names_in(parse_expression(entry, tree)[0]), tree, {})
    expression, of = _read(entry, resolved, {})
    of = of or NONE
    kind = kind_of_dimension(of)
    name = expression.unit or (units.text(kind) if units and kind else si_unit(of))
    return Parameter(Dependent(expression), of, name)


def _range(entry: object, of: Parameter, units: Units | None) -> tuple[float, float] | None:
    if entry is None:
        return None
    example = f"write range: [{of._text(of.value / 2)}, {of._text(of.value * 2)}]"
    if not isinstance(entry, (list, tuple)) or len(entry) != 2:
        raise ModelError(f"{quote_value(entry)} is not a range", example, ("range",))
    low, high = (_like(_value(x, units, {}, {}), x, of, units).value for x in entry)
    if not low < high:
        raise ModelError("a range is two increasing values", example, ("range",))
    return low, high


def _like(new: Parameter, value: object, of: Parameter, units: Units | None) -> Parameter:
    """A new value of a parameter, of the same dimension; a bare number is in the file's unit."""
    a, b = new.dimension, of.dimension
    if a[:3] == b[:3] and (a[3] == b[3] or None in (a[3], b[3])):
        return new
    if not any(a) and of.kind and not isinstance(new.value, Dependent):
        return replace(of, value=quantity(value, of.kind, units))
    what = f"{quote_value(value)} is {phrase(a)}, but {phrase(b)} is needed"
    raise ModelError(what, f"write for example {of._text(of.value)}")


def change_parameters(
    parameters: Parameters, changes: Mapping[str, object], units: Units, drives: Mapping[str, str]
) -> dict[str, Parameter]:
    """The parameters with other values for some: numbers in SI, or texts as in the file."""
    tree: dict[str, object] = dict(parameters)
    for name, value in changes.items():
        if name not in parameters:
            raise ModelError(f"unknown parameter {name!r}", closest(name, list(parameters)), ("parameters",))
        tree[name] = (
            value if isinstance(value, str) else replace(parameters[name], value=_finite(name, value))
        )
    changed = read_parameters(tree, units, drives)
    for name, value in changes.items():
        if isinstance(value, str):
            with _parameter_path(name):
                of = parameters[name]
                changed[name] = replace(
                    _like(changed[name], value, of, units), about=of.about, range=of.range
                )
    return read_parameters(changed, units, drives)


def _finite(name: str, value: object) -> float:
    with _parameter_path(name):
        return quantity(value, "number")


def values_of(
    parameters: Parameters, changes: Mapping[str, Numeric], functions: Functions | None = None
) -> dict[str, Numeric]:
    """SI values of all parameters where some have other ones, numbers or symbols."""
    values = dict(changes)

    def value(name: str) -> Numeric:
        if name not in values:
            entry = parameters[name].value
            if isinstance(entry, Dependent):
                needed = {n: value(n) for n, _ in entry.expression.parameters or ()}
                entry = with_new(entry, needed, functions)
            values[name] = entry
        return values[name]

    return {name: value(name) for name in parameters}
