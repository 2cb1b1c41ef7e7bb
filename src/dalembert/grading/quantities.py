"""The quantities that an answer of a model file may name, read from the catalogue in the axes that the answer gives."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.result import named_quantities as names
from dalembert.analysis.result.named_quantities import Quantity as Series
from dalembert.analysis.result.quantity_catalogue import CATALOGUE
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model.stated_answers import NAMES
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import StatedAnswer

__all__ = ["QUANTITIES", "WHOLE", "WORDS", "Series", "component", "series_of", "size"]

QUANTITIES = tuple(NAMES)
"""Quantities with numbers at each position, by the words of an answer."""


def series_of(r: Result, answer: StatedAnswer) -> Series:
    """The quantity of an answer over the positions, on the link and in the axes that it names."""
    if answer.quantity == "energy_fluctuation":
        return _energy_fluctuation(r, answer)
    word, thing, rate, _ = parts = _parts(r, answer)
    if word in ("reaction", "reaction_moment") and not rate:
        values = getattr(r, word)(thing, _on(r, answer, thing), answer.axes)
    else:
        values = np.asarray(parts.reading.read(r, thing))
        if answer.axes != "ground" and CATALOGUE[word].of in ("links", "points"):
            values = _in_link_axes(r, answer, thing.partition(".")[0], values)
    return Series(parts.kind(r), values)


def _energy_fluctuation(r: Result, answer: StatedAnswer) -> Series:
    """Energy fluctuation of a flywheel at a drive, over the cycle: the same at every position."""
    from dalembert.machine.flywheel.flywheels import flywheel

    if answer.of not in r.drives:
        raise ModelError(f"unknown drive {answer.of!r}", closest(answer.of or "", list(r.drives)), ("of",))
    return Series("energy", np.full(len(r.status), flywheel(r, answer.of, inertia=1.0).size.energy))


def _parts(r: Result, answer: StatedAnswer) -> names.QuantityName:
    """The name of an answer taken apart; ModelError with the names that its thing may have."""
    word = NAMES[answer.quantity].partition(".")[0]
    if (
        answer.of is None
        and "{of}" in NAMES[answer.quantity]
        and "" not in names.things(r, CATALOGUE[word].of)
    ):
        raise ModelError(f"{answer.quantity} needs `of`", closest("", _things(r, word)))
    parts = names.split_name(r, answer.name)
    if parts is None and CATALOGUE[word].of == "points":
        raise ModelError(f"{answer.of!r} names no point of a moving link", "write of: link.point", ("of",))
    if parts is None:
        what = f"{CATALOGUE[word].of.rstrip('s').replace('_', ' ')} {answer.of!r}"
        raise ModelError(f"unknown {what}", closest(answer.of or "", _things(r, word)), ("of",))
    return parts


def _things(r: Result, word: str) -> list[str]:
    return names.things(r, CATALOGUE[word].of)


def _on(r: Result, a: StatedAnswer, joint: str) -> str | None:
    """The link acted on: named by `on`, or the other one than `by`."""
    i, j = r.mechanism.joints[joint].links
    for key, link in (("on", a.on), ("by", a.by)):
        if link not in (None, i, j):
            raise ModelError(f"joint {joint!r} does not join {link!r}", f"it joins {i} and {j}", (key,))
    if a.by is not None and a.by == a.on:
        raise ModelError(f"{a.by!r} exerts no reaction on itself", "leave out on, or by", ("by",))
    return a.on if a.by is None else j if a.by == i else i


def _in_link_axes(r: Result, a: StatedAnswer, link: str, values: Array) -> Array:
    """Vectors of a link, or of a point of it, in the axes of the link."""
    if values.ndim != 2 or a.axes == "joint":
        what = f"{a.axes} axes mean nothing for the {a.quantity.replace('_', ' ')} of {a.of}"
        raise ModelError(what, "leave them out", ("axes",))
    return np.asarray((values[:, None, :] @ r.rotation(link))[:, 0])


WORDS: dict[str, Callable[[Result, int], str | None]] = {
    "status": lambda r, k: r.status[k],
    "stability": lambda r, k: r.stability[k] if r.stability else None,
}
"""Quantities of a position whose value is a word."""

WHOLE: dict[str, Callable[[Result], int | None]] = {
    "count": lambda r: len(r.status),
    "mobility": lambda r: r.mobility.freedoms if r.mobility else None,
    "redundant": lambda r: r.mobility.redundant if r.mobility else None,
}
"""Quantities of the complete mechanism."""


def component(series: Series, name: str | None) -> Series:
    """One component of a vector: x, y, z, magnitude, in the plane direction; the series itself without a name."""
    if name is None:
        return series
    if series.values.ndim == 1 and name == "magnitude":
        return Series(series.kind, np.abs(series.values))
    if series.values.ndim != 2:
        number = series.values.ndim == 1
        what = f"{'a number' if number else 'a rotation'} has no component {name!r}"
        raise ModelError(what, "leave it out" if number else "give all of it, a row each", ("component",))
    known = dict(names.components(series.values))
    if name not in known:
        raise ModelError(f"unknown component {name!r}", closest(name, [*known]), ("component",))
    return Series("angle" if name == "direction" else series.kind, known[name])


def size(series: Series) -> Array:
    """Numbers to compare positions by: the value, or the magnitude of a vector."""
    values = series.values
    return values if values.ndim == 1 else np.sqrt((values**2).sum(axis=tuple(range(1, values.ndim))))
