"""A figure as people write it, read: decimal commas, directions behind ∠ or `at`, components, a sense in words.

A cell has readings, each in the form of a model file: `41.03 N*m`, `155 N @ 220 deg`, `[229 N, -496 N]`. None: the
teacher reads it. Two: the nearer to the key counts, and the teacher hears of it.
"""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterable
from typing import NamedTuple

from dalembert import units
from dalembert.errors import ModelError
from dalembert.unit_names import unit

NUMBER = r"(?:[-+]\s*)?(?:\d(?:[\d.,'\s]*\d)?\.?|[.,]\d+)(?:\s*(?:[eE]|[*·×x]\s*10\s*\^?)\s*\(?[-+]?\d+\)?)?"
"""A number with marks of thousands and decimals in any use, and a power of ten."""

_REQUIRED = "force moment length angle speed angular_speed acceleration angular_acceleration power"
DIMENSIONS = {units.KINDS[kind].dimension for kind in _REQUIRED.split()}
"""Dimensions of what figures are of."""

LONGEST = 200
"""Characters of a cell that is read."""

_DEGREES = r"°|deg(?:rees?|\.)?|rad(?:ians?)?"
_SENSE = re.compile(
    r"[\s,(]*\b(counter[- ]?clockwise|anti[- ]?clockwise|clockwise|ccw|acw|cw)\b\)?\.?\s*$|\s*([↺↻])\s*$",
    re.I,
)
_ABOUT = re.compile(r"\s*(?:about|approx(?:imately|\.)?|ca\.?|circa|roughly|~|≈)\s*", re.I)
_BLANK = re.compile(r"[-.–—?/\s]*|n\.?/?a\.?|none|no time", re.I)
_NAME = re.compile(r"([A-Za-z][\w{},. ]*?)\s*[=:]\s*(?=[-+~≈(\[\d.,A-Za-z])")
_COMPONENTS = re.compile(r"\s*[;|]\s*|,\s+|,(?=[-+])|\s*,?\s*(?=\bF?_?[yz]\s*[=:])", re.I)
_UNIT_VECTORS = re.compile(rf"({NUMBER})\s*i\s*([-+]\s*{NUMBER})\s*j(?:\s*([-+]\s*{NUMBER})\s*k)?(.*)")
_AT = (
    r"@|∠|<|\bat\b|/(?=\s*[-+]?\d)|,\s*(?:θ|theta|angle|dir(?:ection)?)\s*[=:]?|\bangle\b"
    rf"|,(?=\s*[-+]?[\d.,]+\s*(?:{_DEGREES}))"
)
_POLAR = re.compile(
    rf"(?P<size>{NUMBER})(?P<unit>[^\d@∠<]*?)\s*(?:{_AT})\s*∠?\s*(?P<angle>{NUMBER})(?P<rest>.*)", re.I
)
_SINGLE = re.compile(rf"(?P<size>{NUMBER})(?P<unit>.*)")


class WrittenFigure(NamedTuple):
    """Content of a cell: its readings (none of a blank one), the name that it puts before the value, and notes."""

    readings: tuple[object, ...]
    name: str = ""
    notes: tuple[str, ...] = ()
    blank: bool = False


def decimal_comma(cells: Iterable[object]) -> bool | None:
    """True if the cells of a table have a decimal comma, by those with one reading only; None if no cell decides.

    >>> decimal_comma(["41,03", "344,6 @ -164,8"]), decimal_comma(["41.03", "1,234"]), decimal_comma(["12"])
    (True, False, None)
    """
    text = " | ".join(map(str, cells))
    comma, point = (
        len(re.findall(rf"(?<![\d.,])(?:\d+\{mark}(?:\d{{1,2}}|\d{{4,}})|0\{mark}\d+)(?![\d.,])", text))
        for mark in ",."
    )
    return None if comma == point else comma > point


def read_written(text: object, comma: bool | None = None) -> WrittenFigure:
    """The readings of a cell; ``comma``: whether the table that it is in has decimal commas, None if not known.

    >>> read_written("344,6 ∠ -164,8°").readings
    ('344.6 @ -164.8 deg',)
    >>> read_written("11.84 Nm cw").readings, read_written("x=229, y=-496").readings
    (('-11.84 N*m',), (['229', '-496'],))
    >>> read_written("[1 kN, 2, 3]").readings, read_written("713.3 N, -158.55°").readings
    ((['1 kN', '2 kN', '3 kN'],), ('713.3 N @ -158.55 deg',))
    >>> read_written("1,234").readings, read_written("3 or 4").readings
    (('1.234', '1234'), ())
    """
    if isinstance(text, (list, tuple)):
        text = f"[{'; '.join(map(str, text))}]"
    raw = unicodedata.normalize("NFKC", str(text)).translate(_MARKS).strip().strip("\"'").strip()
    if len(raw) > LONGEST or any(c.isdigit() and not c.isascii() for c in raw):
        return WrittenFigure(())
    if _BLANK.fullmatch(raw):
        return WrittenFigure((), blank=True)
    notes: list[str] = []
    name, raw = _named(raw)
    if about := _ABOUT.match(raw):
        raw = raw[about.end() :]
        notes.append("written as about")
    sense = _SENSE.search(raw)
    turned = 0
    if sense:
        word = (sense[1] or sense[2]).lower()
        turned = 1 if word.startswith(("cc", "counter", "anti", "acw", "↺")) else -1
        raw = raw[: sense.start()]
    try:
        readings = _readings(raw.strip(), comma, turned, notes)
    except ValueError:
        readings = []
    return WrittenFigure(tuple(readings), name, tuple(notes))


def readings_of(value: object, comma: bool | None = None) -> WrittenFigure:
    """The readings of a value from a file: what a model file may hold stays as it is.

    >>> readings_of("155 lbf @ 220 deg").readings, readings_of(["1,5", 2]).readings
    (('155 lbf @ 220 deg',), (['1.5', 2],))
    """
    if isinstance(value, (list, tuple)):
        parts = [readings_of(part, comma) for part in value]
        if any(len(part.readings) != 1 for part in parts):
            return WrittenFigure(())
        return WrittenFigure(([part.readings[0] for part in parts],))
    plain = (
        isinstance(value, str) and not (comma and re.search(r"\d\.\d{3}(?!\d)", value)) and _is_plain(value)
    )
    return WrittenFigure((value,)) if plain or not isinstance(value, str) else read_written(value, comma)


def _is_plain(text: str) -> bool:
    """True for a value as a model file has it."""
    if text.startswith("-") and "@" in text:
        return False
    sizes = [re.fullmatch(rf"\s*({units.NUMBER})(.*)", part) for part in text.split("@")]
    if len(sizes) > 2 or any(size is None or size[2].strip() in (".", ",") for size in sizes):
        return False
    try:
        return all(
            size is not None and unit(size[2].strip()) is not None
            for size in sizes
            if size and size[2].strip()
        )
    except ModelError:
        return False


_MARKS = str.maketrans({"−": "-", "–": "-", "—": "-", "º": "°", "\u202f": " ", "\xa0": " ", "’": "'"})


def _named(raw: str) -> tuple[str, str]:
    """The name before a value, `T12 = 33.9`, and the rest."""
    match = _NAME.match(raw)
    if match is None or re.fullmatch(r"F?_?[xy]", match[1].strip(), re.I):
        return "", raw
    return match[1].strip(), raw[match.end() :].strip()


def _readings(raw: str, comma: bool | None, turned: int, notes: list[str]) -> list[object]:
    """Readings of a value without its name: components, size and direction, or one number."""
    bracketed = re.fullmatch(r"([\[({])(.*)[\])}](.*)", raw)
    inner, behind = (bracketed[2].strip(), bracketed[3]) if bracketed else (raw, "")
    if not turned and (parts := _parts(inner, bracketed is not None)):
        return _vector(parts, behind, comma)
    if polar := _POLAR.fullmatch(inner + behind):
        return _polar(polar, comma, turned, notes)
    single = _SINGLE.fullmatch(inner + behind)
    return [] if single is None else _single(single, comma, turned, notes)


def _parts(inner: str, bracketed: bool) -> list[re.Match[str]]:
    """Components, each a number and a unit; none where the text is not a list of them."""
    if match := _UNIT_VECTORS.fullmatch(inner):
        texts = [f"{part} {match[4]}" for part in match.groups()[:3] if part]
    else:
        texts = [text for text in _COMPONENTS.split(inner) if text]
        if len(texts) == 1 and bracketed:
            texts = inner.split(",")
    if len(texts) not in (2, 3):
        return []
    parts = [
        _SINGLE.fullmatch(re.sub(r"^F?_?[xyz]\s*[=:]\s*", "", text.strip(), flags=re.I)) for text in texts
    ]
    total = [part for part in parts if part is not None]
    angle = re.fullmatch(_DEGREES, total[-1]["unit"].strip(), re.I) if total else None
    return total if len(total) == len(texts) and not (angle and len(texts) == 2) else []


def _vector(parts: list[re.Match[str]], behind: str, comma: bool | None) -> list[object]:
    units = [_unit(part["unit"]) for part in parts]
    common = _unit(behind) or next(filter(None, reversed(units)), "")
    numbers = [number(part["size"], comma) for part in parts]
    choices = dict.fromkeys([tuple(n[0] for n in numbers), tuple(n[-1] for n in numbers)])
    return [[_text(v, u or common) for v, u in zip(some, units, strict=True)] for some in choices]


def _polar(found: re.Match[str], comma: bool | None, turned: int, notes: list[str]) -> list[object]:
    rest = re.fullmatch(rf"\s*(?P<one>{_DEGREES})?(?P<unit>.*?)(?P<two>{_DEGREES})?\s*", found["rest"], re.I)
    assert rest is not None
    if rest["one"] and rest["two"]:
        return []
    unit_text = _unit(found["unit"] or rest["unit"])
    sizes, angle = number(found["size"], comma), number(found["angle"], comma)[0]
    measure = "rad" if (rest["one"] or rest["two"] or "").lower().startswith("rad") else "deg"
    if turned < 0:
        angle = _turned(angle)
        notes.append("its angle is counted clockwise")
    if sizes[0].startswith("-"):
        half = math.pi if measure == "rad" else 180.0
        sizes, angle = tuple(map(_turned, sizes)), f"{float(angle) + half:.15g}"
        notes.append("a negative size is read as the opposite direction")
    explicit = f" {measure}" if rest["one"] or rest["two"] else ""
    return [f"{_text(s, unit_text)} @ {angle.removeprefix('+')}{explicit}" for s in sizes]


def _single(found: re.Match[str], comma: bool | None, turned: int, notes: list[str]) -> list[object]:
    unit_text, values = _unit(found["unit"]), list(number(found["size"], comma))
    if turned and values[0].startswith("-"):
        notes.append("it has a sign and a sense")
        values = [values[0], _turned(values[0])]
    elif turned < 0:
        values = [_turned(v) for v in values]
    return [_text(v, unit_text) for v in values]


def _unit(text: str) -> str:
    """A unit as a model file writes it; ValueError where the text is none."""
    text = text.strip(" .,;").replace("·", "*").replace(".", "*")
    text = re.sub(
        r"\b(lbs?)(?=[*\s-]?(?:in|ft)\b|$)|(?<=in)[*\s-](lbs?)\b|(?<=ft)[*\s-](lbs?)\b", _pounds, text
    )
    text = re.sub(r"(?<=[A-Za-z])[\s-]+(?=[A-Za-z])", "*", text)
    text = {"Nm": "N*m", "Nmm": "N*mm", "kNm": "kN*m"}.get(text, text)
    if not text:
        return ""
    try:
        unit(text)
    except ModelError as error:
        raise ValueError(text) from error
    return text


def written_unit(text: str) -> str:
    """A unit of a force, a moment, a length, an angle or their rates as a model file writes it; empty where the text
    is none, or the letter of another thing.

    >>> written_unit("Nm"), written_unit("lb-in"), written_unit("2 marks"), written_unit("s"), written_unit("P")
    ('N*m', 'lbf*in', '', '', '')
    """
    try:
        known = _unit(text)
    except ValueError:
        return ""
    return known if known and unit(known).dimension in DIMENSIONS else ""


def _pounds(found: re.Match[str]) -> str:
    """Pounds of force: a figure is never a mass."""
    return "lbf" if found[1] else "*lbf"


def number(text: str, comma: bool | None = None) -> tuple[str, ...]:
    """A number with a decimal comma or point and marks of thousands, its digits as they are written; two where the
    mark may be either; ValueError where it is none.

    >>> number("1.234,50"), number("1,234.5"), number("1,234", False), number("0,50")
    (('1234.50',), ('1234.5',), ('1234', '1.234'), ('0.50',))
    """
    if re.search(r"\d\s+(?!\d{3}(?!\d))\d", text):
        raise ValueError(text)
    digits = re.sub(r"[\s']", "", text).rstrip(".")
    digits = re.sub(r"[*·×x]10\^?\(?([-+]?\d+)\)?$", r"e\1", digits)
    mantissa, _, exponent = digits.replace("E", "e").partition("e")
    tail = f"e{exponent}" if exponent else ""
    last = max(",.", key=mantissa.rfind)
    if "," in mantissa and "." in mantissa:
        result: tuple[str, ...] = (_grouped(mantissa, "," if last == "." else ".", last),)
    elif mantissa.count(last) > 1:
        result = (_grouped(mantissa, last, ""),)
    else:
        result = _either(mantissa, last, comma)
    if not all(math.isfinite(float(value + tail)) for value in result):
        raise ValueError(text)
    return tuple(value + tail for value in result)


def _either(mantissa: str, mark: str, comma: bool | None) -> tuple[str, ...]:
    """A number with at most one mark: a decimal mark, or before three digits perhaps one of thousands."""
    plain, grouped = mantissa.replace(",", "."), mantissa.replace(mark, "")
    if not re.fullmatch(rf"[-+]?[1-9]\d{{0,2}}\{mark}\d{{3}}", mantissa):
        return (plain,)
    if (mark == "." and comma is not True) or (mark == "," and comma is True):
        return (plain,)
    return (plain, grouped) if comma is None else (grouped, plain)


def _grouped(mantissa: str, thousands: str, decimal: str) -> str:
    """Digits without the marks of thousands, which must precede groups of three."""
    behind = rf"\{decimal}\d*" if decimal else ""
    if re.fullmatch(rf"[-+]?\d{{1,3}}(\{thousands}\d{{3}})+{behind}", mantissa) is None:
        raise ValueError(mantissa)
    return mantissa.replace(thousands, "").replace(",", ".")


def _turned(digits: str) -> str:
    """The number with the other sign."""
    return digits[1:] if digits.startswith("-") else f"-{digits.removeprefix('+')}"


def _text(digits: str, unit_text: str) -> str:
    return f"{digits.removeprefix('+')} {unit_text}".rstrip()
