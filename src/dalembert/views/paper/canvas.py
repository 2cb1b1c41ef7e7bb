"""A drawing under construction: primitives first, labels at the end, each where it covers neither a line nor another
text."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain, pairwise
from typing import Any, NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.views.paper.lettering import BOLD, break_lines, text_width, unbroken
from dalembert.views.paper.scene import (
    Arc,
    Arrow,
    Circle,
    Item,
    Line,
    Point,
    Polygon,
    Scene,
    Text,
    item_box,
)

STAGES = ((0.9, 1.6), (2.6, 4.0), (6.0, 8.5), (12.0, 17.0), (24.0, 34.0, 48.0))
"""Distances in mm at which a label is tried, in batches: a free place nearby ends the search."""

CHEAPEST = (0, 12, 60, None)
"""Candidates are examined in batches in order of cost: usually one of the first dozen is free."""

LEADER = 5.0
"""Distance in mm beyond which a leader connects the label to its place."""


NO_ROOM = "Without room"
"""Beginning of the note on labels that would cover something everywhere."""


@dataclass(frozen=True)
class Label:
    """A text near one of some points, preferably in a direction (radians)."""

    text: str
    near: tuple[Point, ...]
    prefer: float | None
    size: float
    role: str
    leads: bool


class Canvas:
    """Collects primitives and labels."""

    def __init__(self) -> None:
        self.items: list[Item] = []
        self._clear: list[Item] = []
        self._labels: list[Label] = []
        self._below: list[str] = []

    def add(self, *items: Item) -> None:
        """Adds primitives."""
        self.items += items

    def keep_clear(self, *items: Item) -> None:
        """Reserves the space of undrawn lines, so that labels avoid it."""
        self._clear += items

    def label(
        self,
        text: str,
        *near: Point,
        prefer: float | None = None,
        size: float = 3.0,
        role: str = "text",
        leads: bool = True,
    ) -> None:
        """Adds a text near one of some points, placed at the end."""
        if text:
            self._labels.append(Label(text, near, prefer, size, role, leads))

    def label_below(self, text: str) -> None:
        """Adds a text to the note below, where its object is too short for a label."""
        self._below.append(text)

    def scene(
        self,
        title: str = "",
        heading: bool = True,
        notes: Sequence[str] = (),
        least: float = 80.0,
        **options: Any,
    ) -> Scene:
        """The finished drawing, with its title above and notes below, and a minimum width (mm)."""
        placer = _Placer([*self.items, *self._clear])
        left_over = []
        for label in self._labels:
            items = placer.place_text(label)
            self.items += items
            left_over += [] if items else [label.text]
        for words, texts in (("Too short", self._below), (NO_ROOM, left_over)):
            listed = ", ".join(map(unbroken, texts))
            notes = [*notes, f"{words} for a label: {listed}"] if texts else notes
        self._labels, self._below = [], []
        if heading:
            self._draw_heading(title, notes, least)
        return Scene(tuple(self.items), title, **options)

    def _draw_heading(self, title: str, notes: Sequence[str], least: float) -> None:
        left, bottom, right, top = Scene(tuple(self.items)).bounds
        width = max(right - left, least)
        title = ", ".join(unbroken(part) if " = " in part else part for part in title.split(", "))
        for k, line in enumerate(reversed(break_lines(title, 3.6 * BOLD, width))):
            self.add(Text((left, top + 4.5 + 4.8 * k), line, 3.6, "title", "start"))
        lines = [line for note in notes for line in break_lines(note, 2.6, width)]
        for k, line in enumerate(lines):
            self.add(Text((left, bottom - 4.0 - 4.0 * k), line, 2.6, "note", "start"))


def segments(items: Sequence[Item]) -> Array:
    """Every stroke as straight pieces (S, 2, 2); areas without an outline (`-fill`) have none."""
    outlines = [
        _outline(item)
        for item in Scene(tuple(items)).flat()
        if not isinstance(item, Text) and not item.role.endswith("-fill")  # type: ignore[union-attr]
    ]
    if not outlines:
        return np.zeros((0, 2, 2))
    points = np.array(list(chain.from_iterable(outlines)), float)
    pieces = np.stack([points[:-1], points[1:]], axis=1)
    ends = (
        np.cumsum([len(outline) for outline in outlines])[:-1] - 1
    )  # from one outline to the next there is none
    return np.delete(pieces, ends, axis=0)


def _outline(item: Item) -> Sequence[Point]:
    if isinstance(item, Circle):
        return Arc(item.center, item.radius, 0.0, 2 * math.pi).points
    if isinstance(item, Arrow):
        return (item.tail, item.head)
    if isinstance(item, Polygon):
        return (*item.points, item.points[0])
    return item.points  # type: ignore[union-attr]


def extents(pieces: Array) -> Array:
    """Bounding boxes (4, S) of straight pieces (S, 2, 2): left, bottom, right, top."""
    low, high = pieces.min(axis=1, initial=math.inf), pieces.max(axis=1, initial=-math.inf)
    return np.concatenate([low.T, high.T])


def crossings(box: Array, pieces: Array, extent: Array | None = None) -> Flags:
    """True where straight pieces (S, 2, 2) touch boxes (B, 4): (B, S), by separating axes; faster with extents."""
    extent = extents(pieces) if extent is None else extent
    left, bottom, right, top = box.T[:, :, None]
    met = extent[0] <= right
    met &= extent[2] >= left
    met &= extent[1] <= top
    met &= extent[3] >= bottom
    b, s = np.nonzero(met)  # few: only of them it is asked whether the box is beside the piece's line
    start, end = pieces[:, 0], pieces[:, 1]
    c, half = (start[s] + end[s] - box[b, :2] - box[b, 2:]) / 2, (box[b, 2:] - box[b, :2]) / 2
    d = (end - start)[s]
    turn = np.abs(c[:, 0] * d[:, 1] - c[:, 1] * d[:, 0])
    met[b, s] = turn <= half[:, 0] * np.abs(d[:, 1]) + half[:, 1] * np.abs(d[:, 0])
    return np.asarray(met)


def overlapping(a: Array, b: Array) -> Flags:
    """True where boxes a (A, 4) and b (B, 4) overlap."""
    (left, bottom, right, top), (lefts, bottoms, rights, tops) = a.T[:, :, None], b.T[:, None, :]
    across = np.minimum(right, rights) > np.maximum(left, lefts)
    return across & (np.minimum(top, tops) > np.maximum(bottom, bottoms))  # type: ignore[no-any-return]


class _Place(NamedTuple):
    """A candidate: its cost, middle, box, the point it belongs to and the distance from it."""

    cost: float
    at: Array
    box: Array
    near: Array
    gap: float


NOWHERE = _Place(math.inf, np.zeros(2), np.zeros(4), np.zeros(2), 0.0)


class _Placer:
    """Finds places for labels one by one."""

    def __init__(self, items: Sequence[Item]) -> None:
        self.strokes = segments(items)
        self.extents = extents(self.strokes)
        self.boxes = np.array([item_box(i) for i in items if isinstance(i, Text)], float).reshape(-1, 4)

    def place_text(self, label: Label) -> list[Item]:
        """The text at its best place, with a leader where that is far; None where every place is occupied."""
        bold = BOLD if label.role == "title" else 1.0
        room = (bold * text_width(label.text, label.size) / 2 + 0.25, 0.65 * label.size + 0.25)
        best = NOWHERE
        for gaps in STAGES:
            if best.cost > gaps[0]:
                best = min(best, self._best(label, room, gaps), key=lambda place: place.cost)
        if best is NOWHERE:
            return []
        x, y = best.at
        lift = 0.07 * label.size if "_{" in label.text else 0.0
        text = Text((float(x), float(y + lift)), label.text, label.size, label.role)
        items: list[Item] = [text]
        if label.leads and best.gap >= LEADER:
            items.append(_leader(best.near, best.box))
            leader = segments(items[1:])
            self.strokes = np.concatenate([self.strokes, leader])
            self.extents = np.concatenate([self.extents, extents(leader)], axis=1)
        self.boxes = np.concatenate([self.boxes, best.box[None]])
        return items

    def _best(self, label: Label, room: tuple[float, float], gaps: tuple[float, ...]) -> _Place:
        """The cheapest free candidate at some distances: near, in the preferred direction, covering nothing."""
        at, near, gap = _candidates(label, room[0] - 0.25, room[1] - 0.25, gaps)
        box = np.concatenate([at - room, at + room], axis=1)
        cost = gap + self._preference(label, at, near)
        order = np.argsort(cost, kind="stable")
        for first, last in pairwise(CHEAPEST):
            free = order[first:last]
            free = free[~overlapping(box[free], self.boxes).any(axis=1)]
            free = free[~crossings(box[free], *self._close(box[free])).any(axis=1)]
            if label.leads and gap.max() >= LEADER:
                free = free[(gap[free] < LEADER) | ~self._is_blocked(near[free], box[free])]
            if len(free):
                k = int(free[0])
                return _Place(float(cost[k]), at[k], box[k], near[k], float(gap[k]))
        return NOWHERE

    def _close(self, box: Array) -> tuple[Array, Array]:
        """Strokes in the region of some boxes, with their extents."""
        low, high = box[:, :2].min(axis=0, initial=math.inf), box[:, 2:].max(axis=0, initial=-math.inf)
        e = self.extents
        kept = np.flatnonzero((e[2] >= low[0]) & (e[3] >= low[1]) & (e[0] <= high[0]) & (e[1] <= high[1]))
        return self.strokes[kept], e[:, kept]

    def _is_blocked(self, near: Array, box: Array) -> Flags:
        """True where the straight line to a candidate crosses a text."""
        if not len(self.boxes):
            return np.zeros(len(box), bool)
        edge = np.clip(near, box[:, :2], box[:, 2:])
        return np.asarray(crossings(self.boxes, np.stack([near, edge], axis=1)).any(axis=0))

    def _preference(self, label: Label, at: Array, near: Array) -> Array:
        if label.prefer is None:
            return np.zeros(len(at))
        away = at - near
        angle = np.arctan2(away[:, 1], away[:, 0]) - label.prefer
        return np.asarray(2.0 * (1 - np.cos(angle)))


AROUND = np.arange(24) * (2 * math.pi / 24)


def _candidates(
    label: Label, half_width: float, half_height: float, distances: tuple[float, ...]
) -> tuple[Array, Array, Array]:
    """Middles of boxes (B, 2) at distances ``gap`` around the points, and those points."""
    angles = AROUND + (label.prefer or 0.0)
    direction = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    reach = np.clip(direction * 1.5, -1, 1) * np.array([half_width, half_height])
    gaps = np.array(distances)
    near = np.array(label.near, float)
    at = near[:, None, None, :] + gaps[None, :, None, None] * direction + reach
    shape = at.shape[:-1]
    starts = np.broadcast_to(near[:, None, None, :], at.shape)
    far = np.broadcast_to(gaps[None, :, None], shape) + 0.2 * np.arange(len(near))[:, None, None]
    return at.reshape(-1, 2), starts.reshape(-1, 2), np.asarray(far).reshape(-1)


def _leader(near: Array, box: Array) -> Line:
    """Leader from the nearest point of the box to the place."""
    edge = np.clip(near, box[:2], box[2:])
    return Line(((float(edge[0]), float(edge[1])), (float(near[0]), float(near[1]))), "leader")
