"""Many positions in one table, and their peaks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.output.columns import reactions
from dalembert.analysis.output.summary.printed_friction import cycle_table, with_ends
from dalembert.analysis.output.summary.printed_turning import turning_columns
from dalembert.analysis.output.summary.printed_units import (
    Printed,
    motion_only,
    significant,
    without_reactions,
)
from dalembert.analysis.result.number_kinds import drive_kinds, in_plane, load_kind
from dalembert.analysis.result.reaction_axes import Axes
from dalembert.arrays import Array, first_largest
from dalembert.printing import Part, TextTable, folded, number, wrap

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

MANY = 12
"""Positions that are printed without `--all`."""


MORE = "--all prints every one, --csv FILE writes them"


def position_tables(result: Result, to: Printed, axes: Axes, every: bool, more: str = MORE) -> Iterator[Part]:
    """The table of the positions, or of some of many; the largest and smallest values; what friction takes."""
    count = len(result.status)
    shown = (
        range(count)
        if every or count <= MANY
        else sorted(set(np.linspace(0, count - 1, MANY).round().astype(int).tolist()))
    )
    heads, values = _series(result.before, to, axes)
    after = values if result.after is None else _series(result.after, to, axes)[1]
    marked = not all(s == "ok" for s in result.status)
    rows = []
    for k in shown:
        mark = [result.status[k]] if marked else []
        stability = [result.stability[k] or "-"] if result.stability else []
        cells = [number(float(v[k]), 5) for v in values]
        if result.status[k] == "at_rest":
            cells = with_ends(result, to, k, cells)
        rows.append([str(k + 1), *mark, *stability, *cells])
        if result.reverses[k]:
            behind = [number(float(v[k]), 5) for v in after[len(result.drives) :]]
            rows.append(["", "after", *stability, *[""] * len(result.drives), *behind])
    first = ["no.", *(["status"] if marked else []), *(["stability"] if result.stability else [])]
    drives = len(result.drives)
    yield TextTable([*first, *heads], folded(rows), len(first) + drives)
    if len(shown) < count:
        yield f"{len(shown)} of {count} positions are shown; {more}."
    if any(r.least_norm is not None and np.isfinite(r.least_norm).any() for r in reactions(result, axes)):
        yield "Least-norm values of what is not unique: --csv, --json, or a single position."
    if count > 2:
        yield _peak_table(result, to, axes)
        yield cycle_table(result, to)


def _series(result: Result, to: Printed, axes: Axes) -> tuple[list[str], list[Array]]:
    """Columns of the table of positions: drives, efforts, unknown loads, magnitudes of the reactions.

    Where only the motion is known, the links' angles (in the plane), angular speeds and accelerations.
    """
    named: list[tuple[str, str, Array]] = []
    for drive in result.drives:
        named.append((drive, drive_kinds(result, drive)["position"], result.drive_position(drive)))
    for link in result.links if motion_only(result) else ():
        named += _turning(result, link)
    for drive in () if motion_only(result) else result.drives:
        named.append((f"effort {drive}", drive_kinds(result, drive)["effort"], result.effort(drive)))
    for load in result.unknown_loads:
        named.append((load, load_kind(result, load), result.unknown_load(load)))
    named += turning_columns(result)
    for r in () if without_reactions(result) else reactions(result, axes):
        named += [(name, "force", values) for name, values in _sizes(f"F {r.joint}", r.force)]
        moments = _sizes(f"M {r.joint}", r.moment) if r.moment.ndim == 2 else ()
        named += [
            (n, "moment", v) for n, v in moments if np.any(np.nan_to_num(significant(result, "moment", v)))
        ]
    return [f"{name}\n{to.text(kind)}" for name, kind, _ in named], [
        to(kind, significant(result, kind, values)) for _, kind, values in named
    ]


def _turning(result: Result, link: str) -> list[tuple[str, str, Array]]:
    """Angle, angular speed and acceleration of a link; in space the magnitudes of the last two."""
    rates = [
        ("ang. speed", "angular_speed", result.speed(link)),
        ("ang. acc.", "angular_acceleration", result.acceleration(link)),
    ]
    if in_plane(result):
        return [
            (f"{name} {link}", kind, v) for name, kind, v in [("angle", "angle", result.angle(link)), *rates]
        ]
    return [(f"|{name}| {link}", kind, np.linalg.norm(v, axis=-1)) for name, kind, v in rates]


def _sizes(name: str, vectors: Array) -> list[tuple[str, Array]]:
    """The magnitudes of vectors (P, d); where none is known because a component is not, the components that are."""
    known = np.asarray(np.isfinite(vectors).any(axis=0))
    if known.all() or not known.any():
        letter, _, joint = name.partition(" ")
        return [(f"|{letter}| {joint}", np.linalg.norm(vectors, axis=-1))]
    return [(f"{name} {axis}", vectors[:, k]) for k, axis in enumerate("xyz"[: len(known)]) if known[k]]


class Extreme(NamedTuple):
    """The largest and the smallest value of something over the positions, and the positions (from 0) they are at."""

    name: str
    unit: str
    largest: float
    most: int
    smallest: float
    least: int


def extremes(result: Result, to: Printed, axes: Axes = "ground") -> Iterator[Extreme]:
    """Extremes of each effort, unknown load and reaction, both sides of reversals included; where only the motion is
    known, of the links' angles and rates."""
    drives = len(result.drives)
    heads, *sides = _series(result.before, to, axes)
    sides += [] if result.after is None else [_series(result.after, to, axes)[1]]
    for head, *series in zip(heads[drives:], *(values[drives:] for values in sides), strict=True):
        low, high = np.fmin.reduce(series), np.fmax.reduce(series)
        if np.isfinite(low).any():
            least, most = first_largest(-low), first_largest(high)
            name, unit = head.split("\n")
            yield Extreme(name, unit, float(high[most]), most, float(low[least]), least)


def _peak_table(result: Result, to: Printed, axes: Axes) -> Part:
    """Largest and smallest value of each effort, unknown load and reaction, and where."""
    rows, zero = [], []
    for e in extremes(result, to, axes):
        if e.largest == e.smallest == 0:
            zero.append(e.name)
            continue
        largest = [number(e.largest), _place_text(result, to, e.most)]
        rows.append([e.name, e.unit, *largest, number(e.smallest), _place_text(result, to, e.least)])
    marked = any("*" in cell for row in rows for cell in row[3::2])
    heads = ["over the positions", "unit", "largest", "at", "smallest", "at"]
    what = "reversal" if "reversal" in result.status else "jump"
    notes = [f"* one side of a {what}"] if marked else []
    notes += [wrap(f"0 at every position: {', '.join(zero)}.")] if zero else []
    return TextTable(heads, rows, 2, "\n".join(notes)) if rows else "\n".join(notes)


def _place_text(result: Result, to: Printed, position: int) -> str:
    """Position of an extreme, with the side of a reversal."""
    return where(result, to, position) + (" *" if result.reverses[position] else "")


def where(result: Result, to: Printed, position: int) -> str:
    """'60 deg', or the number of the position."""
    if len(result.drives) != 1:
        return f"no. {position + 1}"
    kind = drive_kinds(result, result.drives[0])["position"]
    value = float(to(kind, result.drive_position(result.drives[0])[position]))
    return f"{number(value)} {to.text(kind)}"
