"""The values that a quantity may be given: a list, or a range in round steps."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import NamedTuple

from dalembert.errors import ModelError
from dalembert.model.paths import as_in_file
from dalembert.unit_names import unit
from dalembert.units import NUMBER
from dalembert.wording import quote_value

MOST = 10_000
"""Values that one quantity may be drawn from."""

DIGITS = 15
"""Most digits of a step in another unit; one that has more is rounded to 12."""

FEWEST = 5
"""Values that a range without a step has at least."""

ROUND = (Decimal(5), Decimal(2), Decimal(1))
FORMS = "write PATH=40..60 mm step 5 mm, or PATH=[400 N, 500 N, 600 N]"
RANGE = re.compile(
    rf"\s*({NUMBER})\s*(.*?)\s*\.\.\s*({NUMBER})\s*(.*?)\s*(?:\bstep\s*({NUMBER})\s*(.*?)\s*)?"
)


class Choices(NamedTuple):
    """The path of a quantity, and the values that it may be given."""

    path: str
    values: tuple[object, ...]


def read_choices(vary: Mapping[str, object]) -> list[Choices]:
    """Path -> values as they are written: '40..60 mm step 5 mm', '[400 N, 500 N]', or a list in Python.

    A range without a step goes in the largest step of 1, 2 or 5 times a power of ten that gives five values or more.

    >>> read_choices({"r": "40..60 mm step 10 mm"})[0].values
    ('40 mm', '50 mm', '60 mm')
    >>> read_choices({"loads.P.value": "1..2"})[0].values
    ('1', '1.2', '1.4', '1.6', '1.8', '2')
    """
    choices = [Choices(path, tuple(_values(path, texts))) for path, texts in vary.items()]
    for path, values in choices:
        if len({str(v) for v in values}) < 2:
            raise ModelError(f"--vary {path}: there is one value only, and nothing to draw", FORMS)
    if not choices:
        raise ModelError("no number varies", FORMS)
    return choices


def read_option(text: str) -> tuple[str, str]:
    """PATH=values of the command line."""
    path, equals, values = text.partition("=")
    if not equals or not path.strip() or not values.strip():
        raise ModelError(f"--vary {quote_value(text)} names no values", FORMS)
    return path.strip(), values.strip()


def _values(path: str, stated: object) -> Sequence[object]:
    if isinstance(stated, str) and stated.lstrip().startswith("["):
        stated = as_in_file(stated)
    if isinstance(stated, (list, tuple)):
        return _within_limits(path, len(stated), stated)
    match = RANGE.fullmatch(str(stated).replace("\u2212", "-"))
    if match is None:
        raise ModelError(f"--vary {path}: {quote_value(stated)} is neither a range nor a list", FORMS)
    start, first, stop, last, step, each = match.groups()
    named = last or first
    if first and first != named:
        raise ModelError(f"--vary {path}: the range begins in {first} and ends in {named}", "write one unit")
    low, high = Decimal(start), Decimal(stop)
    if not low < high:
        raise ModelError(f"--vary {path}: the range does not increase from {low} to {high}", FORMS)
    size = _round_step(high - low) if step is None else _in_units(path, step, each or named, named)
    if size <= 0:
        raise ModelError(f"--vary {path}: the step {step} is not positive", FORMS)
    begin = low if step is not None else (low / size).to_integral_value("ROUND_CEILING") * size
    count = int((high - begin) / size) + 1
    return _within_limits(path, count, list(_steps(begin, size, min(count, MOST), named)))


def _within_limits(path: str, count: int, values: Sequence[object]) -> Sequence[object]:
    if count > MOST:
        raise ModelError(f"--vary {path}: {count} values are more than {MOST}", "take a larger step")
    return values


def _steps(begin: Decimal, size: Decimal, count: int, named: str) -> Iterator[str]:
    for k in range(count):
        yield f"{(begin + k * size).normalize():f} {named}".strip()


def _round_step(span: Decimal) -> Decimal:
    """The largest round step of which a span has room for enough."""
    power = span.adjusted()
    steps = (factor * Decimal(10) ** p for p in range(power, power - 3, -1) for factor in ROUND)
    return next(step for step in steps if span / step >= FEWEST - 1)


def _in_units(path: str, step: str, of: str, named: str) -> Decimal:
    """A step in the unit of the range, exact where its digits end."""
    if of == named:
        return Decimal(step)
    a, b = unit(of), unit(named)
    if a.dimension != b.dimension:
        raise ModelError(f"--vary {path}: the step is in {of}, the range in {named}", "write one unit")
    up, down, over, under = (
        Fraction(repr(x)) for x in (a.numerator, a.denominator, b.denominator, b.numerator)
    )
    size = Fraction(step) * up * over / (down * under)
    exact = Decimal(size.numerator) / Decimal(size.denominator)
    return exact if len(exact.as_tuple().digits) <= DIGITS else Decimal(f"{exact:.12g}")
