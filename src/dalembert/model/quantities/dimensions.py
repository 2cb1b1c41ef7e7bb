"""Dimensions of expressions: the kind of an expression of quantities, and whether it fits where one is needed.

A dimension is the powers of length, mass, time and angle. The angle of `pi` and of a turning drive is open (None):
`pi/4` is a number or an angle, depending on where it is used. In a product of other quantities the angle does not
count, so that `theta*r` is a length, and `omega + v/r` an angular speed. A bare 0 has every dimension.
"""

from __future__ import annotations

from collections.abc import Mapping

from dalembert.errors import ModelError
from dalembert.model.quantities.expression_trees import (
    COMPARISONS,
    REDUCTIONS,
    Apply,
    NumberNode,
    Tree,
    expression_text,
    names_in,
)
from dalembert.model.quantities.expression_trees import NameNode as Variable
from dalembert.unit_names import ANGLE, NONE
from dalembert.units import KINDS, REFUSED_BARE
from dalembert.wording import quote_value

Powers = tuple[float, float, float, float | None]
EITHER: Powers = (0, 0, 0, None)
"""A number of radians: an angle, or no unit."""
OF_TURN = {"turn": EITHER, "slide": (1, 0, 0, 0), "time": (0, 0, 1, 0)}
OF_TURN |= {"turn speed": (0, 0, -1, None), "slide speed": (1, 0, -1, 0)}
"""Freedom of a drive -> dimension of its position and speed."""


def dimension(tree: Tree, names: Mapping[str, Powers | None]) -> Powers | None:
    """The dimension of an expression, None of a 0; raises ModelError for a sum of unlike quantities and the like.

    >>> from dalembert.model.quantities.expressions import (parse_expression)
    >>> dimension(parse_expression("pi*d^2/4", ["d"])[0], {"d": (1, 0, 0, 0)})
    (2, 0, 0, None)
    """
    if isinstance(tree, NumberNode):
        return tree.dimension if tree.value or tree.text else None
    if isinstance(tree, Variable):
        return names[tree.name]
    parts = [dimension(argument, names) for argument in tree.arguments]
    if tree.function in ("*", "/"):
        return _product(parts[0], parts[1], -1 if tree.function == "/" else 1)
    if tree.function == "^":
        return _power(parts[0], _exponent(tree.arguments[1]))
    if tree.function == "sqrt":
        return _power(parts[0], 0.5)
    if tree.function in ("+", "-", "abs", "min", "max", "atan2", *REDUCTIONS, *COMPARISONS):
        common = parts[0]
        for other in parts[1:]:
            common = _common(tree, common, other)
        if tree.function in COMPARISONS:
            return NONE
        return ANGLE if tree.function == "atan2" else common
    _check_argument(tree, parts[0])
    return ANGLE if tree.function in ("asin", "acos", "atan") else NONE


def _exponent(tree: Tree) -> float:
    from dalembert.model.quantities.expression_trees import evaluate, numpy_functions

    return float(evaluate(tree, {}, numpy_functions()))


def _product(a: Powers | None, b: Powers | None, sign: int) -> Powers | None:
    if a is None or b is None:
        return None
    angle = None if a[3] is None or b[3] is None else a[3] + sign * b[3]
    return a[0] + sign * b[0], a[1] + sign * b[1], a[2] + sign * b[2], angle


def _power(a: Powers | None, exponent: float) -> Powers | None:
    if a is None:
        return None
    length, mass, time, angle = (None if x is None else _plain(x * exponent) for x in a)
    assert length is not None
    assert mass is not None
    assert time is not None
    return length, mass, time, angle


def _plain(x: float) -> float:
    return round(x) if abs(x - round(x)) < 1e-9 else x


def _common(tree: Apply, a: Powers | None, b: Powers | None) -> Powers | None:
    """The dimension of a sum, a comparison or a ratio of two like quantities."""
    if a is None or b is None:
        return b if a is None else a
    if a[:3] == b[:3]:
        if a[3] == b[3] or b[3] is None:
            return a
        if a[3] is None:
            return b
        if any(a[:3]):
            return (*a[:3], None)
    if any(not any(x[:3]) for x in (a, b)) and any(map(_of_seconds, tree.arguments, (a, b))):
        return EITHER
    first, second = (
        f"{expression_text(x)} is {phrase(d)}" for x, d in zip(tree.arguments, (a, b), strict=True)
    )
    verb = {"+": "added", "-": "subtracted"}.get(tree.function, "compared")
    angle = "; a number of radians is written with its unit, 0.5 rad" if a[:3] == b[:3] else ""
    what = f"{quote_value(expression_text(tree))} cannot be evaluated: {first}, and {second}"
    raise ModelError(what, f"only quantities of one kind are {verb}{angle}")


def _check_argument(tree: Apply, powers: Powers | None) -> None:
    if (
        powers is not None
        and tree.function != "sign"
        and any(powers[:3])
        and not _of_seconds(tree.arguments[0], powers)
    ):
        text = f"{expression_text(tree.arguments[0])} is {phrase(powers)}"
        raise ModelError(
            f"{quote_value(expression_text(tree))} cannot be evaluated: {text}",
            f"{tree.function} needs a plain number or an angle; divide by a quantity of the same kind",
        )


def _of_seconds(tree: Tree, powers: Powers) -> bool:
    """True for a multiple of `time`, which beside plain numbers is a number of seconds: `sin(20*time + 1)`."""
    return powers[:3] == (0, 0, 1) and names_in(tree) == {"time"}


def is_bare(powers: Powers | None, kind: str, text: str) -> bool:
    """True if a number of this dimension is a bare one where one of the kind is needed, in the file's unit.

    Raises ModelError where it is of another kind.
    """
    if powers is None or kind == "number":
        if powers is not None and any(powers):
            raise _unfit(powers, kind, text)
        return False
    need = KINDS[kind].dimension
    if powers[:3] == need[:3] and (not need[3] or kind not in ("angle", *REFUSED_BARE)):
        return False
    if powers[:3] == need[:3] and powers[3] in (need[3], None):
        return False
    if any(powers):
        raise _unfit(powers, kind, text)
    return True


def _unfit(powers: Powers, kind: str, text: str) -> ModelError:
    wanted = KINDS[kind]
    remedy = "check it, and the units of its parameters"
    if powers[:3] == wanted.dimension[:3] and kind in REFUSED_BARE:
        remedy = "say radians or turns: multiply by 1 rad, or by 1 rev"
    return ModelError(f"{quote_value(text)} is {phrase(powers)}, but {wanted.phrase} is needed", remedy)


def kind_of_dimension(powers: Powers | None) -> str | None:
    """The first kind of quantity of this dimension, if there is one.

    >>> kind_of_dimension((2, 0, 0, None)), kind_of_dimension((-2, 1, 0, 0))
    ('area', None)
    """
    if powers is None or powers == EITHER:
        return "number"
    for exact in (True, False):
        for name, kind in KINDS.items():
            if kind.dimension[:3] == powers[:3] and (kind.dimension[3] == powers[3] or not exact):
                return name
    return None


def si_unit(powers: Powers | None) -> str:
    """The SI unit of a dimension.

    >>> si_unit((-1, 1, 0, 0)), si_unit((1, 1, -2, 0)), si_unit((0, 0, 0, 0))
    ('kg/m', 'N', '')
    """
    kind = kind_of_dimension(powers)
    if kind is not None:
        return KINDS[kind].si
    return _base_units(powers)


def _base_units(of: Powers | None) -> str:
    powers = [(n, p) for n, p in zip(("m", "kg", "s", "rad"), of or NONE, strict=True) if p]
    up = [f"{n}^{p:g}" if p != 1 else n for n, p in powers if p > 0]
    down = [f"{n}^{-p:g}" if p != -1 else n for n, p in powers if p < 0]
    return "/".join(["*".join(up) or ("1" if down else ""), *down])


def phrase(powers: Powers | None) -> str:
    """Name of a quantity of this dimension."""
    kind = kind_of_dimension(powers)
    exact = kind is not None and (
        powers is None or powers[3] is None or KINDS[kind].dimension[3] == powers[3]
    )
    return KINDS[kind].phrase if kind and exact else f"in {_base_units(powers)}"
