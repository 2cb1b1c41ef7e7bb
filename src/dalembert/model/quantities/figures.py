"""Numbers in the units and the few figures that a person writes, exact when read again."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from dalembert.unit_names import Unit, unit
from dalembert.units import KINDS, NUMBER, Units, quantity, text

SHORT = 12
"""Characters up to which a number is one that somebody wrote, and no noise of a conversion."""

FILE_UNITS: ContextVar[Units | None] = ContextVar("FILE_UNITS", default=None)
"""The units in which a description is being written; without, every quantity is text with its SI unit."""

OTHER_UNITS = {
    "angle": ("rad",),
    "angular_speed": ("rad/s", "rpm", "deg/s"),
    "angular_acceleration": ("rad/s^2", "deg/s^2"),
}
"""Kind -> units a person may have meant besides the file's."""


@contextmanager
def in_units(units: Units | None) -> Iterator[None]:
    """Values written inside are as a file in these units has them."""
    token = FILE_UNITS.set(units)
    try:
        yield
    finally:
        FILE_UNITS.reset(token)


def shortest(number: float, of: Unit) -> float | int | None:
    """The number of this unit with the fewest figures that is read as exactly this SI value, if there is one.

    >>> shortest(0.3048, unit("in")), shortest(0.5235987755982988, unit("deg"))
    (12, 30)
    """
    value = of.of_si(number)
    if not math.isfinite(value):
        return None
    near = (value, math.nextafter(value, math.inf), math.nextafter(value, -math.inf))
    for rounded in (*(float(f"{value:.{figures}g}") for figures in (3, 6, 9, 12, 15, 16)), *near):
        if of.si(rounded) == number:
            return without_fraction(rounded)
    return None


def without_fraction(number: float) -> float | int:
    """2 for 2.0; -0.0 stays what it is."""
    return (
        int(number)
        if number.is_integer() and abs(number) < 1e15 and (number or _sign(number) > 0)
        else number
    )


def _sign(number: float) -> float:
    return math.copysign(1.0, number)


def plain(number: float, kind: str, units: Units) -> float | str:
    """The number bare in the file's units where that says it best; else with a unit.

    >>> plain(0.0254, "length", Units(length="in")), plain(157.07963267948966, "angular_speed", Units())
    (1, '1500 rpm')
    """
    if not KINDS[kind].si:
        return without_fraction(number)
    names = OTHER_UNITS.get(kind, (KINDS[kind].si,))
    texts = [f"{rounded} {name}" for name in names if (rounded := shortest(number, unit(name))) is not None]
    bare = shortest(number, units.unit(kind)) if not units.refuses_bare(kind) else 0 if number == 0 else None
    if bare is not None and (
        len(str(bare)) <= SHORT or not texts or len(str(bare)) <= min(map(len, texts)) - 4
    ):
        return bare
    return min(texts, key=len) if texts else text(number, kind)


def in_stated_unit(number: float, kind: str, name: str, units: Units) -> str | None:
    """The number in a unit, or bare in the file's without; in SI where that is what somebody wrote."""
    rounded = shortest(number, unit(name) if name else units.unit(kind))
    if rounded is None or len(str(rounded)) > SHORT:
        si = f"{without_fraction(number)} {KINDS[kind].si}".rstrip()
        if len(si) <= SHORT and KINDS[kind].si:
            return si
    return None if rounded is None else f"{rounded} {name}".rstrip()


def plain_vector(vector: tuple[float, ...], kind: str, units: Units) -> object:
    """Components bare in the file's units; polar text where that is short and they are not."""
    components = [plain(x, kind, units) for x in vector]
    if len(vector) == 2 and max(len(str(x)) for x in components) > SHORT:
        polar = polar_text(vector, kind, units)
        if polar is not None and len(polar) < 2 * SHORT:
            return polar
    return components


def polar_units(old: str, kind: str, units: Units) -> tuple[str, str]:
    """Units of size and angle written in a polar text; empty where they are the file's."""
    size, angle = (
        re.fullmatch(rf"\s*(?>{NUMBER})\s*(.*?)\s*", side.replace("\u2212", "-"))
        for side in old.split("@", 1)
    )
    names = [match[1] if match else "" for match in (size, angle)]
    if names[1] and unit(names[1]).dimension == KINDS[kind].dimension:
        return names[1], ""
    return names[0], names[1]


def unit_vector(angle: float) -> tuple[float, float]:
    """Cosine and sine, exact at the quarter turns."""
    quarter = round(angle / (math.pi / 2))
    if abs(angle - quarter * (math.pi / 2)) < 1e-15 * max(1.0, abs(angle)):
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[quarter % 4]
    return math.cos(angle), math.sin(angle)


def polar_text(
    vector: tuple[float, ...], kind: str, units: Units, size: str = "", angle: str = ""
) -> str | None:
    """`r @ angle` that is read as exactly this planar vector, if possible; `size` and `angle` are units."""
    length = unit(size) if size else units.unit(kind)
    turn = unit(angle) if angle else units.unit("angle")
    r0, turn0 = length.of_si(math.hypot(*vector)), turn.of_si(math.atan2(vector[1], vector[0]))
    if turn0 < 0:
        turn0 += turn.of_si(2 * math.pi)
    for figures in (3, 6, 9, 12, 15, 16, 17):
        r, phi = float(f"{r0:.{figures}g}"), float(f"{turn0:.{figures}g}")
        x, y = unit_vector(turn.si(phi))
        if (length.si(r) * x, length.si(r) * y) == vector:
            return f"{without_fraction(r)} {size}".rstrip() + f" @ {without_fraction(phi)} {angle}".rstrip()
    return None


def with_kept_unit(number: float, kind: str, old: str, units: Units) -> str | None:
    """A text with its number changed and all else of it kept: `60deg` becomes `75deg`."""
    match = re.fullmatch(rf"(\s*)((?>{NUMBER}))(\s*)([^\s\d].*|)", old.replace("\u2212", "-"), re.DOTALL)
    if match is None or quantity_fails(old, kind, units):
        return None
    name = match[4].strip()
    changed = in_stated_unit(number, kind, name, units)
    if changed is None or not changed.endswith(name):
        return changed
    return f"{match[1]}{changed.removesuffix(name).rstrip()}{match[3]}{match[4]}"


def quantity_fails(value: str, kind: str, units: Units) -> bool:
    """True if a text is not a quantity of this kind."""
    try:
        quantity(value, kind, units)
    except ValueError:
        return True
    return False


SI_KINDS = {kind.si: name for name, kind in KINDS.items() if kind.si}
"""SI unit as text -> the kind of quantity that is written with it."""


def si_quantity(value: object) -> tuple[float, str] | None:
    """The number and kind of a text as a description writes its quantities: `0.127 m`."""
    if isinstance(value, str):
        number, _, si = value.partition(" ")
        if si in SI_KINDS and re.fullmatch(rf"{NUMBER}", number):
            return float(number), SI_KINDS[si]
    return None
