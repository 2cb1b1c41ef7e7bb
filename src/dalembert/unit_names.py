"""Units by name, and the products of them that a text such as `lbf*in*s^2` names.

The vocabulary of the model file is in `SYMBOLS` with exact factors (a test compares each of them with pint); any other
name is looked up in pint, imported only then. An angle counts as a separate dimension, so that `Hz` is not a shaft
speed and `N*m/rad` is not a couple.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import lru_cache

from dalembert.errors import ModelError
from dalembert.wording import closest, quote_value

Dimension = tuple[int, int, int, int]
"""Powers of length, mass, time and angle."""


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit: SI value = number * numerator / denominator.

    >>> unit("lbf*in").si(1.0)
    0.1129848290276167
    """

    numerator: float
    denominator: float
    dimension: Dimension

    def si(self, number: float) -> float:
        """The number of SI units in `number` of this unit."""
        return number * self.numerator / self.denominator

    def of_si(self, number: float) -> float:
        """The number of this unit in `number` of SI units."""
        return number * self.denominator / self.numerator

    def times(self, other: Unit, power: int = 1) -> Unit:
        """This unit times a power of the other."""
        up, down = other.numerator, other.denominator
        if power < 0:
            up, down = down, up
        dimension = tuple(a + b * power for a, b in zip(self.dimension, other.dimension, strict=True))
        size = abs(power)
        return Unit(self.numerator * up**size, self.denominator * down**size, dimension)  # type: ignore[arg-type]


NONE: Dimension = (0, 0, 0, 0)
LENGTH: Dimension = (1, 0, 0, 0)
MASS: Dimension = (0, 1, 0, 0)
TIME: Dimension = (0, 0, 1, 0)
ANGLE: Dimension = (0, 0, 0, 1)
FORCE: Dimension = (1, 1, -2, 0)
MOMENT: Dimension = (2, 1, -2, 0)
LBF = 44482216152605.0
"""One pound-force in units of 1e-13 N: 0.45359237 kg times 9.80665 m/s2, exactly."""

SYMBOLS: dict[str, Unit] = {
    name: Unit(float(up), float(down), dimension)
    for names, up, down, dimension in (
        ("m meter metre", 1, 1, LENGTH),
        ("mm", 1, 1000, LENGTH),
        ("cm", 1, 100, LENGTH),
        ("dm", 1, 10, LENGTH),
        ("um µm μm", 1, 1e6, LENGTH),
        ("km", 1000, 1, LENGTH),
        ("in inch inches", 254, 1e4, LENGTH),
        ("ft foot feet", 3048, 1e4, LENGTH),
        ("yd", 9144, 1e4, LENGTH),
        ("N newton", 1, 1, FORCE),
        ("mN", 1, 1000, FORCE),
        ("kN", 1000, 1, FORCE),
        ("MN", 1e6, 1, FORCE),
        ("lbf", LBF, 1e13, FORCE),
        ("kip", LBF, 1e10, FORCE),
        ("ozf", LBF, 16e13, FORCE),
        ("kgf kp", 980665, 1e5, FORCE),
        ("Nm", 1, 1, MOMENT),
        ("Nmm", 1, 1000, MOMENT),
        ("kNm", 1000, 1, MOMENT),
        ("kg", 1, 1, MASS),
        ("g gram", 1, 1000, MASS),
        ("t tonne", 1000, 1, MASS),
        ("lbm lb", 45359237, 1e8, MASS),
        ("slug", LBF, 3048e9, MASS),
        ("blob", LBF, 254e9, MASS),
        ("s sec second", 1, 1, TIME),
        ("ms", 1, 1000, TIME),
        ("min minute", 60, 1, TIME),
        ("h hr hour", 3600, 1, TIME),
        ("rad radian radians", 1, 1, ANGLE),
        ("mrad", 1, 1000, ANGLE),
        ("deg ° degree degrees", math.pi, 180, ANGLE),
        ("rev turn", 2 * math.pi, 1, ANGLE),
        ("rpm RPM", math.pi, 30, (0, 0, -1, 1)),
        ("rps", 2 * math.pi, 1, (0, 0, -1, 1)),
        ("Hz", 1, 1, (0, 0, -1, 0)),
        ("J", 1, 1, MOMENT),
        ("W", 1, 1, (2, 1, -3, 0)),
        ("kW", 1000, 1, (2, 1, -3, 0)),
        ("%", 1, 100, NONE),
    )
    for name in names.split()
}
"""Name of a unit -> the unit, exact, for the vocabulary of the model file."""

ONE = Unit(1.0, 1.0, NONE)
EXAMPLE = "write one such as lbf*in*s^2"

_TOKEN = re.compile(r"\s*(\d+|[^\W\d]+|[°%]|[-*/^()])")
_SUPERSCRIPTS = str.maketrans({"²": "^2", "³": "^3", "·": "*", "⋅": "*", "×": "*", "\u2212": "-"})


@lru_cache(maxsize=1024)
def unit(text: str) -> Unit:
    """The unit that a text names: names, products `*` or `N-m`, quotients, integer powers, brackets.

    >>> unit("N-m") == unit("N*m")
    True
    >>> unit("s^-2*kg^2 m^-1/s").dimension
    (-1, 2, -3, 0)
    """
    if len(text) > 60:
        raise ModelError(f"{quote_value(text)} is not a unit", EXAMPLE)
    product, rest = _product(_tokens(text), text, 1)
    if rest:
        raise ModelError(f"{quote_value(text)} is not a unit: unexpected {rest[0]!r}", EXAMPLE)
    return product


def _tokens(text: str) -> list[str]:
    plain = re.sub(r"\b(ft|in)-lb\b", r"\1*lbf", text.translate(_SUPERSCRIPTS).replace("**", "^"))
    plain = re.sub(r"\blb-(ft|in)\b", r"lbf*\1", plain)
    plain = re.sub(r"(?<=[^\W\d])[-.](?=[^\W\d])", "*", plain).strip()
    tokens, place = [], 0
    while place < len(plain):
        match = _TOKEN.match(plain, place)
        if match is None:
            raise ModelError(
                f"{quote_value(text)} is not a unit: unexpected {plain[place:].strip()[:1]!r}",
                EXAMPLE,
            )
        tokens.append(match[1])
        place = match.end()
    return tokens


def _product(tokens: list[str], text: str, depth: int) -> tuple[Unit, list[str]]:
    if tokens[:2] == ["1", "/"]:
        product, tokens = ONE, tokens[1:]
    else:
        product, tokens = _factor(tokens, text, 1, ONE, depth)
    while tokens and tokens[0] != ")":
        sign = -1 if tokens[0] == "/" else 1
        product, tokens = _factor(tokens[tokens[0] in "*/" :], text, sign, product, depth)
    return product, tokens


def _factor(tokens: list[str], text: str, sign: int, product: Unit, depth: int) -> tuple[Unit, list[str]]:
    if tokens[:1] == ["("] and depth < 5:
        inner, tokens = _product(tokens[1:], text, depth + 1)
        if not tokens:
            raise ModelError(f"{quote_value(text)} is not a unit: a bracket is not closed", EXAMPLE)
        tokens = tokens[1:]
    elif tokens and (tokens[0][0].isalpha() or tokens[0] in "°%_"):
        inner, tokens = _by_name(tokens[0], text), tokens[1:]
    else:
        missing = f"expected a name, not {tokens[0]!r}" if tokens else "a name is missing"
        raise ModelError(f"{quote_value(text)} is not a unit: {missing}", EXAMPLE)
    power, tokens = _exponent(tokens, text)
    return product.times(inner, sign * power), tokens


def _exponent(tokens: list[str], text: str) -> tuple[int, list[str]]:
    if tokens[:1] != ["^"]:
        return 1, tokens
    minus = tokens[1:2] == ["-"]
    digits = tokens[1 + minus :]
    if not digits or not re.fullmatch(r"[1-6]", digits[0]):
        raise ModelError(
            f"{quote_value(text)} is not a unit: a power must be an integer from -6 to 6", "write s^2, s^-1"
        )
    return (-1 if minus else 1) * int(digits[0]), digits[1:]


def _by_name(name: str, text: str) -> Unit:
    known = SYMBOLS.get(name) or _from_pint(name)
    if known is None:
        context = f" in {quote_value(text)}" if name != text.strip() else ""
        raise ModelError(f"unknown unit {quote_value(name)}{context}", closest(name, list(SYMBOLS), 8))
    return known


@lru_cache(maxsize=256)
def _from_pint(name: str) -> Unit | None:
    """Any unit that pint knows and that is made of length, mass, time and angle."""
    import pint

    try:
        factor, root = _registry().get_root_units(name)
    except (pint.PintError, AttributeError, ValueError, TypeError, KeyError):
        return None
    order = ("meter", "gram", "second", "radian")
    powers = dict(root._units)
    dimension = tuple(int(powers.pop(base, 0)) for base in order)
    if powers or not math.isfinite(factor) or any(root._units.get(base, 0) % 1 for base in order):
        return None
    return Unit(float(factor), 1000.0 ** dimension[1], dimension)  # type: ignore[arg-type]


@lru_cache(maxsize=1)
def _registry():  # type: ignore[no-untyped-def]
    import pint

    return pint.UnitRegistry(autoconvert_offset_to_baseunit=False)
