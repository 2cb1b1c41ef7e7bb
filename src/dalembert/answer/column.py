"""Columns of an answer, each number named with its kind of unit, and the units that they are written in."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, Literal, NamedTuple

import numpy as np

from dalembert.arrays import Array, Numeric, Tree
from dalembert.units import KINDS, file_units

UnitChoice = Literal["SI", "file"]
Axes = Literal["ground", "link", "joint"]
"""Axes of the components of reactions; other answers have one sort only."""
WORD = "word"
"""Kind of a column of texts, or of numbers that count or name something: they have no unit."""


class Scale:
    """SI numbers into the requested units.

    >>> scale = Scale(None)
    >>> scale.text("moment"), scale("moment", 2.0)
    ('N*m', 2.0)
    """

    def __init__(self, units: object) -> None:
        self._units = None if units is None else file_units(units)

    def bare(self, kind: str) -> bool:
        """True if these units have one for bare numbers of this kind."""
        return self._units is None or not self._units.refuses_bare(kind)

    def text(self, kind: str) -> str:
        """The unit of a kind of number, as text."""
        if kind == WORD:
            return ""
        return KINDS[kind].si if self._units is None else self._units.text(kind)

    def __call__(self, kind: str, values: Numeric) -> Numeric:
        """The values in that unit."""
        if self._units is None or kind == WORD:
            return values
        unit = self._units.unit(kind)
        return values * unit.denominator / unit.numerator

    def names(self) -> str | dict[str, str]:
        """`SI`, or the unit of every kind."""
        if self._units is None:
            return "SI"
        return {kind: self.text(kind) for kind in KINDS if self.text(kind)}


class Column(NamedTuple):
    """One number a row: name, kind (a key of ``units.KINDS``, or `word`), and values in SI, which slices cut."""

    name: str
    kind: str
    values: Any

    def head(self, to: Scale) -> str:
        """Its name with the unit."""
        unit = to.text(self.kind)
        return f"{self.name} [{unit}]" if unit else self.name

    def cells(self, to: Scale, rows: slice) -> list[object]:
        """Values of some rows, None for NaN and infinity."""
        values = to(self.kind, self.values[rows])
        return np.asarray(values).tolist() if self.kind == WORD else nan_to_none(np.asarray(values))


def parts(values: Array) -> Iterator[tuple[str, Array]]:
    """Names and values (P,) of the components of numbers (P,), vectors (P, d) or matrices (P, 3, 3).

    >>> [name for name, _ in parts(np.zeros((1, 3)))]
    ['.x', '.y', '.z']
    """
    if values.ndim == 1:
        yield "", values
        return
    for place in np.ndindex(values.shape[1:]):
        yield "." + "".join("xyz"[k] for k in place), values[(slice(None), *place)]


def nan_to_none(values: Array) -> list[object]:
    """A list with None for NaN and infinity."""
    finite = np.isfinite(values)
    if finite.all():
        return list(values.tolist())
    out = values.astype(object)
    out[~finite] = None
    return list(out.tolist())


def plain(value: object) -> Tree:
    """A tree with plain numbers: arrays as lists, None for what is not finite."""
    made: object = value
    if isinstance(value, dict):
        made = {key: plain(item) for key, item in value.items()}
    elif isinstance(value, (list, tuple, np.ndarray)):
        made = [plain(item) for item in value]
    elif isinstance(value, (float, np.floating)):
        made = float(value) if math.isfinite(value) else None
    elif isinstance(value, (np.integer, np.bool_)):
        made = value.item()
    return made  # type: ignore[return-value]
