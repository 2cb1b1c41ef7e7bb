"""First position of a wheel that rolls on a line, where nothing else gives it: over the line's point; and of what
slides at the end of a rope: at its assembly, or where its slide is 0.

Mechanics: docs/theory.md 3.1.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from dalembert.algebra import plane
from dalembert.arrays import Array, Flags, Index, Ints
from dalembert.core.constraints import dense, stack_rows
from dalembert.core.elements.strand_family import Strand
from dalembert.core.layout import Along, Layout, Pose, Rows
from dalembert.core.linear import generalized_inverse

LOOSE = 1e-6
"""Part of a wheel's shift along its line left by the constraints above which it can be held."""


class WheelPlaces(NamedTuple):
    """Coordinates of wheels' centres along their lines, the joints they are of, and the values they are held at."""

    along: Along
    joint: Ints
    value: Array

    def at(self, which: Index) -> WheelPlaces:
        parts = {name: value[which] for name, value in vars(self.along).items()}
        return WheelPlaces(Along(**parts), self.joint[which], self.value[which])

    def of(self, layout: Layout) -> WheelPlaces:
        """The same wheels with the geometry of another layout of the same joints, which may be of symbols."""
        count = layout.constraints.count
        families = [f for f in layout.constraints.families if isinstance(f, Along)]
        families += [_beyond(f, count) for f in layout.freedoms.families if isinstance(f, Along)]
        masks: list[Flags] = [np.asarray(np.isin(f.row, self.along.row)) for f in families]
        of_wheels = zip(families, masks, strict=True)
        parts = [{name: value[mask] for name, value in vars(f).items()} for f, mask in of_wheels]
        along = Along(**{name: np.concatenate([part[name] for part in parts]) for name in parts[0]})
        return self._replace(along=replace(along, pitch=np.zeros(len(along.row))))

    def renumbered(self, first: int) -> Along:
        """The rows numbered from ``first``."""
        return replace(self.along, row=np.arange(first, first + len(self.value)))


def loose_places(layout: Layout, free: Layout, pose: Pose, turn: Array, point: Array) -> WheelPlaces | None:
    """The wheels of a layout that the free one lets shift at a pose (1, L+1, ...), each held at 0, or at its given
    place: angles (L+1,) and points (L+1, 2), NaN where unknown."""
    places = _places(layout, turn, point)
    if places is None:
        return None
    rows = _scaled(free, free.constraints, pose)
    idle = np.eye(layout.unknowns) - generalized_inverse(rows, rcond=1e-7) @ np.nan_to_num(rows)
    count = len(places.value)
    alone = Rows(
        count, layout.constraints.links, (places.renumbered(0),), places.joint, np.zeros(count, bool)
    )
    held: list[int] = []
    for k, row in enumerate(_scaled(replace(free, driven=np.zeros(0, np.intp)), alone, pose)):
        shift = idle @ row
        if shift @ shift > LOOSE * (row @ row):
            held.append(k)
            idle = idle - np.outer(shift, shift) / (shift @ shift)
    return places.at(np.array(held, np.intp)) if held else None


def _scaled(layout: Layout, rows: Rows, pose: Pose) -> Array:
    at = replace(layout, constraints=rows)
    return np.asarray(dense(at, stack_rows(at, pose))[0] * at.row_scale[:, None] * at.column_scale)


def _beyond(f: Along, count: int) -> Along:
    """A family of freedoms, its rows numbered behind the constraints."""
    return replace(f, row=f.row + count)


def _places(layout: Layout, turn: Array, point: Array) -> WheelPlaces | None:
    """The wheels on lines, except those on a moving line with the place of the wheel or of the line given; with ropes,
    also what slides without a drive."""
    rows = layout.constraints
    rolling: list[tuple[Along, Flags]] = [
        (f, np.asarray(f.pitch != 0)) for f in rows.families if isinstance(f, Along)
    ]
    sliding = [f for f in layout.freedoms.families if isinstance(f, Along)]
    if any(isinstance(f, Strand) for f in rows.families):
        rolling += [(_beyond(f, rows.count), ~np.isin(f.row, layout.driven)) for f in sliding]
    every = np.concatenate([rows.joint, layout.freedoms.joint])
    parts = [{name: value[mask] for name, value in vars(f).items()} for f, mask in rolling if mask.any()]
    if not parts:
        return None
    f = Along(**{name: np.concatenate([part[name] for part in parts]) for name in parts[0]})
    known = np.isfinite(point[f.j]).all(axis=1)
    arm = plane.rotate(plane.rotation(np.where(known, turn[f.j], 0.0)), f.uj)
    place = plane.dot(f.axis, np.nan_to_num(point[f.j]) + arm - f.ui)
    joint = every[f.row]
    wheels = WheelPlaces(replace(f, pitch=np.zeros(len(f.row))), joint, np.where(known, place, 0.0))
    placed = known | np.isfinite(point[f.i]).all(
        axis=1
    )  # a line that moves may be placed as well as its wheel
    return wheels.at(np.flatnonzero(~placed | (f.i == layout.links) | (f.row >= rows.count)))
