"""Compares the answers in a model file with the computed ones."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.analysis.result.position_lookup import no_position
from dalembert.arrays import Array
from dalembert.errors import STATUSES, ModelError, errors_at
from dalembert.grading.quantities import QUANTITIES, WHOLE, WORDS, Series, component, series_of, size
from dalembert.grading.tolerance import Target, percent, radians
from dalembert.unit_names import unit
from dalembert.units import KINDS, NUMBER, Units, file_units, quantity
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism, StatedAnswer


TOLERANCE = 1e-6
"""Relative deviation allowed for an answer without a tolerance."""

EXACT = 1e-7
"""Relative deviation from an independent exact value."""

DIGITS = 7
"""Significant digits of the numbers shown."""

SAME_POSITION = 1e-6
"""Difference, in radians or metres, up to which a drive's position is the one that an answer names."""


class ComparedAnswer(NamedTuple):
    """One answer compared: as published, as computed, how far apart and how far they may be; ok, and why not."""

    case: str
    quantity: str
    published: str
    exact: str
    computed: str
    tolerance: str
    deviation: str
    ok: bool
    why: str
    problem: str = ""
    line: int = 0


def check_file(path: str | Path) -> list[ComparedAnswer]:
    """The answers of a model file compared with what is computed; raises ModelError where the file is wrong.

    >>> from dalembert.bundled import examples
    >>> check_file(examples()["four_bar"])
    []
    """
    from dalembert.model import load

    return check(load(path), Path(path).stem)


def check(mechanism: Mechanism, case: str = "") -> list[ComparedAnswer]:
    """The answers of a mechanism compared with what is computed: one row an answer."""
    from dalembert.analysis.solution import solve

    if not mechanism.answers:
        return []
    result = solve(mechanism)
    return [_row(result, answer, k, case or mechanism.title) for k, answer in enumerate(mechanism.answers)]


def _row(result: Result, answer: StatedAnswer, number: int, case: str) -> ComparedAnswer:
    source = result.mechanism.source
    path = ("answers", number)
    try:
        with errors_at(*path):
            row = _compare(result, answer, case)
    except ModelError as error:
        raise error.at_source(source) from None
    return row._replace(line=source.line(path) if source else 0)


def _compare(result: Result, answer: StatedAnswer, case: str) -> ComparedAnswer:
    if answer.quantity in WHOLE:
        return _word(answer, case, WHOLE[answer.quantity](result), "")
    if answer.quantity in WORDS:
        position = position_of(result, answer)
        return _word(answer, case, WORDS[answer.quantity](result, position), reason_at(result, position))
    if answer.quantity not in QUANTITIES:
        known = [*QUANTITIES, *WORDS, *WHOLE]
        what = f"unknown quantity {answer.quantity!r}"
        raise ModelError(what, closest(answer.quantity, known, 40), ("quantity",))
    rows = [_difference(side, answer, read(side, answer), case) for side in sides_of(result, answer)]
    return next((row for row in rows if row.ok), rows[0])


def read(result: Result, answer: StatedAnswer) -> Series:
    """The quantity of an answer over the positions."""
    return component(series_of(result, answer), answer.component)


def sides_of(result: Result, answer: StatedAnswer) -> tuple[Result, ...]:
    """The results that an answer may be of: just before reversals or just after; of an extreme the one that has it."""
    if result.after is None or answer.quantity.endswith(("_low", "_high")):
        return (result,)
    if answer.extreme is None:
        return result.sides
    largest = []
    for side in result.sides:
        values = BY[answer.extreme](size(read(side, answer)))
        largest.append(float(np.nanmax(values)) if np.isfinite(values).any() else -math.inf)
    return (result.sides[int(np.argmax(largest))],)


def describe_answer(answer: StatedAnswer) -> str:
    """The quantity in words: 'reaction of A on crank, magnitude, at 60 deg'."""
    parts = [answer.quantity.replace("_", " ")]
    parts += [f"of {answer.of}"] if answer.of else []
    parts += [f"on {answer.on}"] if answer.on else [f"by {answer.by}"] if answer.by else []
    text = " ".join(parts)
    where = "" if answer.at is None else _at_text(answer.at)
    axes = "" if answer.axes == "ground" else f"{answer.axes} axes"
    return ", ".join(part for part in (text, answer.component, axes, where, answer.extreme) if part)


def _at_text(at: object) -> str:
    return f"at no. {at}" if isinstance(at, int) else f"at {at}"


# words and counts


def _word(answer: StatedAnswer, case: str, value: str | int | None, problem: str) -> ComparedAnswer:
    published, computed = _plain(answer.value), "-" if value is None else str(value)
    ok = computed == published
    why, sentence = answer.why or "", "" if ok else problem
    return ComparedAnswer(case, describe_answer(answer), published, "", computed, "", "", ok, why, sentence)


def _plain(value: object) -> str:
    return str(int(value)) if isinstance(value, float) and value.is_integer() else str(value)


def reason_at(result: Result, position: int) -> str:
    """Why a position is not solved; empty where it is."""
    if result.status[position] == "ok":
        return ""
    return result.reasons[position] or STATUSES[result.status[position]].sentence


# positions


def position_of(result: Result, answer: StatedAnswer, series: Series | None = None) -> int:
    """Position of an answer, from 0."""
    count = len(result.status)
    if answer.extreme is not None and series is not None:
        return _extreme(answer.extreme, size(series))
    if answer.at is None:
        if count == 1:
            return 0
        what = f"the answer has {count} positions"
        raise ModelError(what, "say which: at: 1, or at: 60 deg", ("quantity",))
    if isinstance(answer.at, int):
        if not 1 <= answer.at <= count:
            raise no_position(answer.at, count, "at")
        return answer.at - 1
    return _position_name(result, answer.at)


BY: dict[str, Callable[[Array], Array]] = {"max": lambda v: v, "min": lambda v: -v, "maxabs": np.abs}
"""Functions whose largest value is the extreme."""


def _extreme(which: str, values: Array) -> int:
    return 0 if np.isnan(values).all() else int(np.nanargmax(BY[which](values)))


def _position_name(result: Result, at: object) -> int:
    """The position where the first drive has a value: `60 deg`."""
    if not result.drives:
        what = "the mechanism has no drive to name a position by"
        raise ModelError(what, "number the position: at: 1", ("at",))
    drive = result.drives[0]
    kind = drive_kinds(result, drive)["position"]
    with errors_at("at"):
        wanted = quantity(at, kind, file_units(result.mechanism.units))
    away = np.abs(_subtract(result.drive_position(drive), wanted, kind))
    if not away.min() < SAME_POSITION:
        problem = f"no position has {drive} = {at}"
        raise ModelError(problem, "number the position, or give the drive that value", ("at",))
    return int(away.argmin())


def _subtract(value: Array, wanted: object, kind: str) -> Array:
    """Difference of two values; angles a full turn apart are the same."""
    difference = value - wanted
    return np.asarray(np.angle(np.exp(1j * difference)) if kind == "angle" else difference)


# numbers and vectors


def target(value: object, series: Series, units: Units, key: str) -> Target:
    """A value as written in the file, read as the kind of the series."""
    from dalembert.model.part import ReadingRules
    from dalembert.model.quantities.values import at_item, check_vector, vector

    rules = ReadingRules(units, dimension=series.values.shape[-1])
    depth = series.values.ndim - 1
    with errors_at(key):
        if depth == 2:
            rows = check_vector(value, rules, "")
            read: Any = [at_item(k, vector, row, series.kind, rules) for k, row in enumerate(rows)]
        else:
            read = vector(value, series.kind, rules) if depth else quantity(value, series.kind, units)
    polar = depth == 1 and isinstance(value, str)
    return Target(np.array(read, dtype=float), _unit_of(value, series.kind, units), polar)


def _unit_of(value: object, kind: str, units: Units) -> str:
    """Unit of a published value: the one written with it, or the file's."""
    for item in value if isinstance(value, (list, tuple)) else [value]:
        for text in re.findall(rf"(?>{NUMBER})\s*([^\W\d][^@]*)", str(item)):
            if unit(text.strip()).dimension == KINDS[kind].dimension:
                return str(text.strip())
    return units.text(kind)


def _difference(result: Result, answer: StatedAnswer, series: Series, case: str) -> ComparedAnswer:
    units = file_units(result.mechanism.units)
    position = position_of(result, answer, series)
    published = target(answer.value, series, units, "value")
    exact = None if answer.exact is None else target(answer.exact, series, units, "exact")
    value = _same_turn(np.asarray(series.values[position], dtype=float), published.value, series.kind)
    scale = _scale((exact or published).value, series)
    away = _away(value, published.value, series.kind)
    allowed, allowed_text = _tolerance(answer.tolerance, scale, series.kind, units, TOLERANCE, "tolerance")
    met = exact is None or _meets_exact(value, exact, answer, series, units)
    problem = reason_at(result, position) or ("" if met else "The exact value is missed.")
    texts = value_text(answer.value), "" if exact is None else _shorten(value_text(answer.exact))
    computed = computed_text(value, published, series.kind, units, answer.value)
    off = _deviation(away, _size(published.value) and scale, series.kind, published.unit)
    ok = away <= allowed and met
    why, problem = answer.why or "", "" if ok else problem
    return ComparedAnswer(
        case, describe_answer(answer), *texts, computed, allowed_text, off, ok, why, problem
    )


def _meets_exact(value: Array, exact: Target, answer: StatedAnswer, series: Series, units: Units) -> bool:
    scale = _scale(exact.value, series)
    allowed, _ = _tolerance(answer.exact_tolerance, scale, series.kind, units, EXACT, "exact_tolerance")
    return _away(value, exact.value, series.kind) <= allowed


def _same_turn(angle: Array, wanted: Array, kind: str) -> Array:
    """An angle in the turn that the published one is in."""
    return angle + 2 * np.pi * np.round((wanted - angle) / (2 * np.pi)) if kind == "angle" else angle


def _away(value: Array, wanted: Array, kind: str) -> float:
    """Distance of two numbers or vectors."""
    return _size(_subtract(value, wanted, kind))


def _size(value: Array) -> float:
    return float(np.linalg.norm(np.atleast_1d(value)))


def _scale(wanted: Array, series: Series) -> float:
    """Reference of a relative tolerance: the published value, or where that is 0 the largest of its series."""
    values = size(series)
    return _size(wanted) or (float(np.nanmax(np.abs(values))) if np.isfinite(values).any() else 0.0)


def _tolerance(
    stated: object, scale: float, kind: str, units: Units, default: float, key: str
) -> tuple[float, str]:
    """Allowed distance in SI, and as text: relative (`0.3 %`) or a quantity of the same kind."""
    if stated is None:
        return default * scale, f"{default:g}"
    if isinstance(stated, str) and stated.strip().endswith("%"):
        return percent(stated, key, None) * scale, stated.strip()
    with errors_at(key):
        return quantity(stated, kind, units), value_text(stated)


# as text


def value_text(value: object) -> str:
    """A value as written in the file."""
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(value_text(item) for item in value) + "]"
    return f"{value:.{DIGITS}g}" if isinstance(value, float) else str(value)


def _shorten(text: str) -> str:
    """The same with no more digits than a computed value is shown with."""
    return re.sub(rf"(?<![\w.]){NUMBER}", lambda match: f"{float(match[0]):.{DIGITS}g}", text)


def computed_text(value: Array, published: Target, kind: str, units: Units, form: object = "") -> str:
    """A computed value in the unit and the form of the published one, its direction in the turn of that."""
    if not np.isfinite(value).all():
        return "-"
    to_unit = unit(published.unit).of_si if published.unit else float
    behind = "" if published.unit in ("", units.text(kind)) else f" {published.unit}"
    if value.ndim == 0:
        return f"{to_unit(float(value)):.{DIGITS}g}{behind}"
    if published.polar:
        turn = float(np.angle(complex(*value) * complex(*published.value).conjugate()))
        angle = units.unit("angle").of_si(_direction(form, units, published.value) + turn)
        return f"{to_unit(float(np.hypot(*value))):.{DIGITS}g}{behind} @ {angle:.6g}"
    clean = np.where(np.abs(value) < 1e-12 * np.abs(value).max(), 0.0, value)
    return _bracket(clean, to_unit) + behind


def _direction(form: object, units: Units, vector: Array) -> float:
    """The angle of a polar value in radians as it was written, 220 deg and not -140."""
    number = re.search(NUMBER, str(form).partition("@")[2])
    angle = math.atan2(vector[1], vector[0])
    if number is None:
        return angle
    written = radians(float(number[0]), str(form), units)
    return angle + 2 * math.pi * round((written - angle) / (2 * math.pi))


def _bracket(values: Array, to_unit: Callable[[float], float]) -> str:
    """Numbers in brackets; of a rotation one bracket per row."""
    inner = [f"{to_unit(float(v)):.{DIGITS}g}" if v.ndim == 0 else _bracket(v, to_unit) for v in values]
    return "[" + ", ".join(inner) + "]"


def _deviation(away: float, scale: float, kind: str, unit_text: str) -> str:
    """Deviation: in percent, or in the published unit without a reference value."""
    if not math.isfinite(away):
        return "-"
    if scale and kind != "angle":
        return f"{100 * away / scale:.2g} %"
    return f"{unit(unit_text).of_si(away):.2g} {unit_text}" if unit_text else f"{away:.2g}"
