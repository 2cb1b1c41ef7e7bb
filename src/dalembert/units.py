"""Text to SI and back, at the border; inside the package everything is SI and radians.

A quantity is a number and a unit; what it may be the number of is its kind (`KINDS`).
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import lru_cache

from dalembert.errors import ModelError
from dalembert.unit_names import (
    ANGLE,
    FORCE,
    LENGTH,
    MASS,
    MOMENT,
    NONE,
    ONE,
    SYMBOLS,
    TIME,
    Dimension,
    Unit,
    unit,
)
from dalembert.wording import closest, quote_value


@dataclass(frozen=True, slots=True)
class Kind:
    """Kind of a number: its SI unit, and the powers of the file's units that apply to a bare number."""

    phrase: str
    si: str
    dimension: Dimension
    file: Mapping[str, int]
    example: str


def _kind(phrase: str, si: str, dimension: Dimension, file: str, example: str) -> Kind:
    powers = {name: int(power or 1) for name, power in re.findall(r"(\w+)(?:\^(-?\d+))?", file)}
    return Kind(phrase, si, dimension, powers, example)


KINDS: dict[str, Kind] = {
    "number": _kind("a plain number", "", NONE, "", "0.15"),
    "length": _kind("a length", "m", LENGTH, "length", "127 mm"),
    "angle": _kind("an angle", "rad", ANGLE, "angle", "60 deg"),
    "time": _kind("a time", "s", TIME, "time", "0.5 s"),
    "mass": _kind("a mass", "kg", MASS, "mass", "1.5 kg"),
    "force": _kind("a force", "N", FORCE, "force", "80 N"),
    "moment": _kind("a moment", "N*m", MOMENT, "force length", "12 N*m"),
    "inertia": _kind("a moment of inertia", "kg*m^2", (2, 1, 0, 0), "mass length^2", "0.02 kg*m^2"),
    "speed": _kind("a speed", "m/s", (1, 0, -1, 0), "length time^-1", "200 mm/s"),
    "acceleration": _kind("an acceleration", "m/s^2", (1, 0, -2, 0), "length time^-2", "9.81 m/s^2"),
    "angular_speed": _kind("an angular speed", "rad/s", (0, 0, -1, 1), "angle time^-1", "25 rad/s"),
    "angular_acceleration": _kind(
        "an angular acceleration", "rad/s^2", (0, 0, -2, 1), "angle time^-2", "-40 rad/s^2"
    ),
    "jerk": _kind("a jerk", "m/s^3", (1, 0, -3, 0), "length time^-3", "50 m/s^3"),
    "angular_jerk": _kind("an angular jerk", "rad/s^3", (0, 0, -3, 1), "angle time^-3", "200 rad/s^3"),
    "stiffness": _kind("a stiffness", "N/m", (0, 1, -2, 0), "force length^-1", "2000 N/m"),
    "damping": _kind("a damping", "N*s/m", (0, 1, -1, 0), "force time length^-1", "30 N*s/m"),
    "torsion_stiffness": _kind(
        "a torsional stiffness", "N*m/rad", (2, 1, -2, -1), "force length", "50 N*m/rad"
    ),
    "torsion_damping": _kind(
        "a torsional damping", "N*m*s/rad", (2, 1, -1, -1), "force length time", "0.2 N*m*s/rad"
    ),
    "density": _kind("a density", "kg/m^3", (-3, 1, 0, 0), "mass length^-3", "7850 kg/m^3"),
    "line_density": _kind("a mass per length", "kg/m", (-1, 1, 0, 0), "mass length^-1", "0.4 kg/m"),
    "area": _kind("an area", "m^2", (2, 0, 0, 0), "length^2", "2 cm^2"),
    "section_modulus": _kind("a section modulus", "m^3", (3, 0, 0, 0), "length^3", "4 cm^3"),
    "second_moment": _kind("a second moment of area", "m^4", (4, 0, 0, 0), "length^4", "12 cm^4"),
    "power": _kind("a power", "W", (2, 1, -3, 0), "force length time^-1", "2 kW"),
    "energy": _kind("an energy", "J", MOMENT, "force length", "20 J"),
    "pressure": _kind("a pressure", "N/m^2", (-1, 1, -2, 0), "force length^-2", "6 N/mm^2"),
    "pressure_speed": _kind(
        "a pressure times a speed", "W/m^2", (0, 1, -3, 0), "force length^-1 time^-1", "1 MPa*m/s"
    ),
    "volume": _kind("a volume", "m^3", (3, 0, 0, 0), "length^3", "0.4 l"),
    "flow": _kind("a flow", "m^3/s", (3, 0, -1, 0), "length^3 time^-1", "20 l/min"),
}
"""Every kind of number in a file or an answer. A bare torsional stiffness or damping is one per radian."""

ALSO_CALLED = {"torque": "moment", "work": "energy"}
"""Other names of kinds in a file's `units`."""
PER_RADIAN = ("torsion_stiffness", "torsion_damping")
REFUSED_BARE = {"angular_speed": "rad/s, deg/s or rpm", "angular_acceleration": "rad/s^2 or deg/s^2"}


@dataclass(frozen=True, slots=True)
class Units:
    """The units that a file's bare numbers are in; those left out are SI, angles degrees.

    >>> Units(length="in", force="lbf", mass="blob").text("inertia")
    'blob*in^2'
    """

    length: str = "m"
    force: str = "N"
    mass: str = "kg"
    time: str = "s"
    angle: str = "deg"
    derived: tuple[tuple[str, str], ...] = ()
    """Kinds with a named unit, and that unit; the others have products of the five."""

    def own(self, kind: str) -> str:
        """The unit that the file gives for this kind; torsional stiffness and damping follow the moment's unit."""
        stated = dict(self.derived)
        if kind in stated or kind not in PER_RADIAN or "moment" not in stated:
            return stated.get(kind, "")
        return stated["moment"] + (f"*{_power(self.time, 1)}" if kind == "torsion_damping" else "")

    def of_texts(self) -> TextUnits:
        """The same for the numbers in texts only."""
        return TextUnits(**{field.name: getattr(self, field.name) for field in fields(self)})

    def unit(self, kind: str) -> Unit:
        """The unit of a bare number of this kind: the product of the file's units."""
        return _file_unit(self, kind)

    def text(self, kind: str) -> str:
        """The same unit as text, to print after a number."""
        if self.own(kind):
            return self.own(kind)
        powers = KINDS[kind].file
        up = [_power(getattr(self, name), power) for name, power in powers.items() if power > 0]
        down = [_power(getattr(self, name), -power) for name, power in powers.items() if power < 0]
        return "/".join(["*".join(up), *down]) if up else ""

    def refuses_bare(self, kind: str) -> bool:
        """True if a bare number of this kind would be ambiguous."""
        return kind in REFUSED_BARE and not self.own(kind)

    def tree(self) -> dict[str, str]:
        """As a file says it."""
        five = {name: getattr(self, name) for name in BASES}
        return five | dict(self.derived)


BASES = ("length", "force", "mass", "time", "angle")
"""The units of which the others are products."""


class TextUnits(Units):
    """Units of the bare numbers in texts only; numbers by themselves are SI and radians, as in Python."""

    __slots__ = ()


@lru_cache(maxsize=1024)
def _file_unit(units: Units, kind: str) -> Unit:
    if units.own(kind):
        return unit(units.own(kind))
    product = ONE
    for name, power in KINDS[kind].file.items():
        product = product.times(unit(getattr(units, name)), power)
    return product


def _power(text: str, power: int) -> str:
    base = f"({text})" if re.search(r"[*/^ ]", text) else text
    return base if power == 1 else f"{base}^{power}"


def file_units(tree: object) -> Units:
    """The `units` of a file: a mapping of length, force, mass, time and angle to names of units, and of any other kind.

    >>> file_units({"length": "mm"}).text("moment"), file_units({"length": "mm", "torque": "N*m"}).text("moment")
    ('N*mm', 'N*m')
    """
    if isinstance(tree, Units):
        return tree
    names = [*BASES, *(kind for kind in KINDS if kind not in (*BASES, "number")), *ALSO_CALLED]
    if not isinstance(tree, Mapping):
        raise ModelError(
            f"units are {quote_value(tree)}, not a mapping", "write units: {length: mm, force: N}"
        )
    derived: dict[str, str] = {}
    for name, text in tree.items():
        kind = ALSO_CALLED.get(str(name), str(name))
        _check_file_unit(name, kind, text, names)
        if kind not in BASES and derived.setdefault(kind, text) != text:
            raise ModelError(
                f"units gives {kind} twice: {derived[kind]} and, as {name}, {text}",
                "leave one of them out",
                (str(name),),
            )
    five = {name: text for name, text in tree.items() if name in BASES}
    return Units(**five, derived=tuple(derived.items()))


def _check_file_unit(name: object, kind: str, text: object, names: list[str]) -> None:
    if name not in names:
        raise ModelError(f"units has no key {quote_value(name)}", closest(str(name), names), (str(name),))
    if not isinstance(text, str):
        raise ModelError(
            f"{quote_value(text)} is not a unit", f"write {KINDS[kind].si}, for example", (str(name),)
        )
    try:
        check_unit(text, kind)
    except ModelError as error:
        raise ModelError(error.what, error.remedy, (str(name),)) from None


NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_QUANTITY = re.compile(rf"\s*({NUMBER})\s*(.*?)\s*", re.DOTALL)


def quantity(value: object, kind: str, units: Units | None = None) -> float:
    """The SI value of a number or a text with its unit.

    A bare number is in the file's `units`; without `units`, as in Python, in SI and radians. Raises ModelError
    for a unit of another dimension, an unknown unit, no number, NaN and infinity.

    >>> quantity("1500 rpm", "angular_speed")
    157.07963267948966
    >>> quantity(30, "angle", Units())
    0.5235987755982988
    """
    number, unit_text = _split(value, kind)
    if not unit_text:
        return _finite(_bare(number, kind, units, value), value)
    named = _unit_of(unit_text, kind)
    _check_dimension(unit_text, named, value, kind)
    return _finite(named.si(number), value)


def _split(value: object, kind: str) -> tuple[float, str]:
    if isinstance(value, str):
        return _split_text(value, kind)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ModelError(f"{quote_value(value)} is not {KINDS[kind].phrase}", _write(kind))
    return _float(value), ""


def _float(value: int | float | str) -> float:
    try:
        return float(value)
    except OverflowError:
        raise ModelError(f"{quote_value(value)} is too large", "write a number below 1e300") from None


def _split_text(text: str, kind: str) -> tuple[float, str]:
    match = _QUANTITY.fullmatch(text.replace("\u2212", "-"))
    if match is None:
        raise ModelError(f"{quote_value(text)} is not {KINDS[kind].phrase}", _write(kind))
    number, rest = match.groups()
    if re.match(r",\s*\d", rest):
        write = f"write {text.replace(',', '.', 1)!r}"
        if re.match(r",\d{3}(?!\d)", rest):
            raise ModelError(
                f"{quote_value(text)} has a comma", f"{write}, or {text.replace(',', '')!r} for thousands"
            )
        raise ModelError(f"{quote_value(text)} has a decimal comma", write)
    if polar := re.fullmatch(rf"(.*?)\s*(?:\bat\b|∠)\s*({NUMBER}.*)", rest):
        raise ModelError(
            f"{quote_value(text)} is not one number",
            f"a size and a direction are written {' '.join(filter(None, (number, polar[1])))} @ {polar[2]}",
        )
    if re.match(r"[\d/]", rest) and not re.match(r"1/[^\W\d]", rest):
        raise ModelError(f"{quote_value(text)} is not one number", "write a decimal: 1.5 in for 1 1/2 in")
    return _float(number), rest


def _bare(number: float, kind: str, units: Units | None, value: object) -> float:
    if units is None or (isinstance(units, TextUnits) and not isinstance(value, str)):
        return number
    if units.refuses_bare(kind):
        if number == 0:  # in whichever unit
            return number
        raise ModelError(
            f"{quote_value(value)} is {KINDS[kind].phrase} without a unit",
            f"write {REFUSED_BARE[kind]}",
        )
    return units.unit(kind).si(number)


def _finite(number: float, value: object) -> float:
    if not math.isfinite(number):
        raise ModelError(f"{quote_value(value)} is not a finite number", "write a finite one")
    return number


def _write(kind: str) -> str:
    example = KINDS[kind].example
    return f"write one, for example {example!r}" if " " in example else f"write one, for example {example}"


def check_unit(text: str, kind: str) -> Unit:
    """The unit that a text names, if it is one of this kind; else raises ModelError."""
    named = _unit_of(text, kind)
    _check_dimension(text, named, text, kind)
    return named


def _unit_of(text: str, kind: str) -> Unit:
    """The unit that a text names; for an unknown one the error lists units of the kind that is needed."""
    try:
        return unit(text)
    except ModelError as error:
        if not error.remedy.startswith("choose among"):
            raise
        if kind not in BASES:
            raise ModelError(error.what, _write(kind)) from None
        same = [name for name, known in SYMBOLS.items() if known.dimension == KINDS[kind].dimension]
        phrase = KINDS[kind].phrase.removeprefix("an ").removeprefix("a ")
        listed = ", ".join(same[:8]) + (", ..." if len(same) > 8 else "")
        raise ModelError(error.what, f"units of {phrase}: {listed}") from None


def _check_dimension(unit_text: str, named: Unit, value: object, kind: str) -> None:
    wanted = KINDS[kind]
    dimension = named.dimension
    if dimension == wanted.dimension:
        return
    if kind in PER_RADIAN and dimension == (*wanted.dimension[:3], 0):
        return
    raise ModelError(
        f"{quote_value(value)} is {_phrase(dimension)}, but {wanted.phrase} is needed",
        _remedy(unit_text, dimension, kind),
    )


def _phrase(dimension: Dimension) -> str:
    phrases = [kind.phrase for kind in KINDS.values() if kind.dimension == dimension]
    if phrases:
        return phrases[0]
    names = ("m", "kg", "s", "rad")
    powers = [f"{name}^{power}" for name, power in zip(names, dimension, strict=True) if power]
    return "in " + "*".join(powers).replace("^1", "")


def _remedy(unit_text: str, dimension: Dimension, kind: str) -> str:
    if re.search(r"\blb\b", unit_text) and "force" in KINDS[kind].file:
        return f"lb is a mass: write {re.sub(r'lb', 'lbf', unit_text)} (lbf is the force, lbm the mass)"
    if kind == "angular_speed" and dimension == (0, 0, -1, 0):
        return "Hz and 1/s do not say whether turns or radians are counted: write rev/s, rpm or rad/s"
    return _write(kind)


def text(number: float, kind: str) -> str:
    """The number as text with its SI unit, exact when read again.

    >>> text(0.127, "length")
    '0.127 m'
    """
    return f"{number!r} {KINDS[kind].si}".rstrip()
