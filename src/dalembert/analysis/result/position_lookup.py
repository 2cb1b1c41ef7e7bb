"""Finds a position of a result: by its number, the value of its first drive, or an extreme of a quantity."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.answer.named_answer import counted
from dalembert.arrays import Array, first_largest
from dalembert.errors import FORCED, STATUSES, AnalysisError, ModelError
from dalembert.units import file_units, quantity

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


PositionChoice = int | float | str | None
"""A position by its number from 1, by a value of the first drive, or by an extreme: ``max effort.O2``."""

EXTREMES = {
    "max": "largest",
    "greatest": "largest",
    "min": "smallest",
    "least": "smallest",
    "peak": "largest in magnitude",
}
"""Word before a quantity -> the extreme it asks for; ``greatest``, ``least`` and ``peak`` as in aims."""


class QuantityExtreme(NamedTuple):
    """An extreme of a quantity over the positions, SI, and its position from 0."""

    word: str
    of: str
    kind: str
    value: float
    position: int


def extreme(r: Result, text: str) -> QuantityExtreme | None:
    """The extreme that a text names, ``max effort.O2``, ``min transmission.B``, ``peak reaction.A``; None for another.

    A vector counts by its magnitude, and so does a quantity between bars, ``max |effort.O2|``. Both sides of a reversal
    count. Raises ModelError for an unknown quantity, and for one without a value at any position.

    >>> import dalembert as da
    >>> r = da.dynamics(da.four_bar())
    >>> worst = extreme(r, "max |effort.O2|")
    >>> worst.position == r.peak("effort.O2").place, extreme(r, "60 deg")
    (True, None)
    """
    matched = re.fullmatch(rf"\s*({'|'.join(EXTREMES)})\b\s*(\S.*?)\s*", text)
    if matched is None:
        return None
    from dalembert.analysis.result.named_quantities import quantity

    word, of = matched[1], _without_brackets(matched[2])
    bare = of[1:-1].strip() if of[0] == of[-1] == "|" else of
    kind = "number"
    sides = []
    for side in r.sides:
        kind, values = quantity(side, bare)
        sizes = values if values.ndim == 1 else np.sqrt((values.reshape(len(values), -1) ** 2).sum(axis=1))
        sides.append(np.abs(sizes) if bare != of or word == "peak" else sizes)
    low = EXTREMES[word] == "smallest"
    values = (np.fmin if low else np.fmax).reduce(sides)
    if not np.isfinite(values).any():
        raise ModelError(f"{of} has no value at any position", "see status")
    best = float(np.nanmin(values) if low else np.nanmax(values))
    return QuantityExtreme(word, of, kind, best, first_largest(-values if low else values))


def _without_brackets(text: str) -> str:
    """The inside of brackets around all of a text: ``(effort.O2)``."""
    inner = text[1:-1]
    return inner.strip() if text[0] + text[-1] == "()" and "(" not in inner and inner.strip() else text


def position_sentence(r: Result, k: int, at: PositionChoice = None) -> str:
    """Sentence on a position and, of an extreme, on its value in the units of the file.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> r = da.dynamics(examples()["four_bar"], positions=36)
    >>> position_sentence(r, position_at(r, "max effort.O2"), "max effort.O2")
    'Position 3 of 36, O2 = 80 deg: effort.O2 is largest here, 292.29 lbf*in.'
    """
    from dalembert.analysis.output.summary.printed_units import print_scale

    to = print_scale(r, "file")
    kinds = {d: drive_kinds(r, d)["position"] for d in r.drives}
    places = [f"{d} = {to.quantity(kind, float(r.drive_position(d)[k]))}" for d, kind in kinds.items()]
    text = ", ".join([f"Position {k + 1} of {len(r.status)}", *places])
    result = extreme(r, at) if isinstance(at, str) else None
    if result is None:
        return f"{text}."
    value = to.quantity(result.kind, result.value).strip()
    return f"{text}: {result.of} is {EXTREMES[result.word]} here, {value}."


def position_at(r: Result, at: PositionChoice = None) -> int:
    """Index from 0 of a position given by its number from 1, nearest to a value of the first drive (`60 deg`), or at an
    extreme of a quantity (`max effort.O2`).

    Without ``at`` the first that is ok, or else that has a pose. Raises AnalysisError, with its reason, for a position
    that has none.
    """
    k = _place(r, at)
    if not np.isfinite(r.point_array[k]).all():
        raise AnalysisError(f"position {k + 1}: {r.reasons[k] or STATUSES[r.status[k]].sentence}")
    return k


def no_position(n: int, count: int, *key: str) -> ModelError:
    """The error of a number of a position that a result of ``count`` does not have."""
    remedy = f"this result has {counted(count, 'position')}, numbered from 1"
    return ModelError(f"position {n} does not exist", remedy, key)


def _place(r: Result, at: PositionChoice) -> int:
    if at is None:
        posed = np.array([s != "not_assembled" for s in r.status])
        good = np.flatnonzero(r.ok if r.ok.any() else posed)
        return int(good[0]) if len(good) else 0
    if isinstance(at, int) or (isinstance(at, str) and at.strip().isdigit()):
        n = int(at)
        if not 1 <= n <= len(r.status):
            raise no_position(n, len(r.status))
        return n - 1
    if isinstance(at, str) and (value := extreme(r, at)) is not None:
        return value.position
    if not r.drives:
        raise ModelError(
            "the mechanism has no drive to name a position by", "give the number of the position"
        )
    kind = drive_kinds(r, r.drives[0])["position"]
    try:
        wanted = quantity(at, kind, file_units(r.mechanism.units))
    except ModelError as error:
        remedy = f'{error.remedy}, the number of a position, or an extreme such as "max effort.{r.drives[0]}"'
        raise ModelError(f"position: {error.what}", remedy) from None
    values = r.drive_position(r.drives[0])
    k, near = _nearest(values, wanted, kind == "angle")
    if not near:
        shown = r.scale("file")
        nearest = f"{float(shown(kind, values[k])):.6g} {shown.text(kind)}"
        what = f"no position has {r.drives[0]} = {at}; the nearest is {nearest}"
        raise ModelError(what, "give the drive that position, or more positions")
    return k


def _nearest(values: Array, wanted: float, turns: bool) -> tuple[int, bool]:
    """Index of the nearest value, and whether it is within half a step; full cycles away is the same place."""
    away, step = np.abs(values - wanted), float(np.nanmax(np.abs(np.diff(values)), initial=0.0))
    near = 1e-6 + 0.5 * step
    if turns and np.nanmin(away) > near:
        swept = float(np.nanmax(values) - np.nanmin(values)) + step
        cycle = 2 * np.pi * max(1, round(swept / (2 * np.pi)))
        away = np.abs(away - cycle * np.round(away / cycle))
    k = int(np.nanargmin(away))
    return k, bool(away[k] <= near)


def has_forces(r: Result, k: int) -> bool:
    """True where a position has forces, all of them or those that are unique; False of redundant constraints whose
    friction leaves none."""
    lost = r.status[k] == "redundant" and not np.isfinite(r.residual[k])
    return r.status[k] in FORCED and not lost
