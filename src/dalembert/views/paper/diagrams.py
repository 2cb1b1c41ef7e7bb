"""Curves over an axis and polar diagrams, as scenes."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError
from dalembert.machine.harmonics import whole_turns
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import round_up
from dalembert.views.paper.lettering import Box
from dalembert.views.paper.scene import Circle, Line, Point, Polygon, Scene, Text

SIZE = (84.0, 52.0)
"""Size of the plotting area of a chart, mm."""

Ticks = Sequence[tuple[int, str]]
"""Indices of positions, and the labels beside them."""


def ticks(low: float, high: float, most: int = 6, angle: bool = False) -> list[float]:
    """Round values that cover a range.

    >>> ticks(0.0, 360.0, 7, True)
    [0.0, 60.0, 120.0, 180.0, 240.0, 300.0, 360.0]
    """
    if not high > low:
        low, high = low - 1.0, high + 1.0
    step = round_up((high - low) / most)
    if angle:
        step = next(
            (s for s in (5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0) if (high - low) / s <= most), 360.0
        )
    first = math.floor(low / step + 1e-9)
    last = math.ceil(high / step - 1e-9)
    return [float(f"{n * step:.10g}") for n in range(first, last + 1)]


def inner_ticks(low: float, high: float, most: int = 6, angle: bool = False) -> list[float]:
    """Round values within a range.

    >>> inner_ticks(90.0, 805.0, 6, True)
    [180.0, 360.0, 540.0, 720.0]
    """
    slack = 1e-9 * (high - low)
    return [t for t in ticks(low, high, most, angle) if low - slack <= t <= high + slack]


def curves_scene(
    x: Array,
    series: Mapping[str, Array],
    x_label: str,
    y_label: str,
    title: str = "",
    angle: bool = False,
    levels: Mapping[str, float] | None = None,
) -> Scene:
    """Curves against one axis with a legend; ``levels`` are horizontal lines. Ranges without any value are grey."""
    canvas, levels = Canvas(), levels or {}
    places, curves = _closed_cycle(np.asarray(x, float), series) if angle else (np.asarray(x, float), series)
    low, high = _reach(np.concatenate([*curves.values(), [*levels.values()]]))
    known = places[np.isfinite(places)]
    left, right = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
    left, right = (left, right) if right > left else (left - 1.0, right + 1.0)
    to = Field((left, right), ticks(low, high))
    missing = _missing(places, np.any([np.isfinite(v) for v in curves.values()], axis=0))
    for a, b in missing:
        corners = ((a, to.y[0]), (b, to.y[0]), (b, to.y[-1]), (a, to.y[-1]))
        canvas.add(Polygon(tuple(to(*p) for p in corners), "missing-fill"))
    to.draw_axes(canvas, inner_ticks(left, right, 6, angle), x_label, y_label)
    for n, (name, curve) in enumerate(curves.items()):
        role = f"curve-{n % 6 + 1}"
        for run in _runs(places, curve):
            line = tuple(to(a, b) for a, b in run)
            canvas.add(Line(line, role) if len(line) > 1 else Circle(line[0], 0.4, role))
        to.draw_legend(canvas, name, role)
    for name, value in levels.items():
        canvas.add(Line((to(left, value), to(right, value)), "level"))
        to.draw_legend(canvas, name, "level")
    if missing:
        to.draw_legend(canvas, "no answer", "missing-fill")
    return canvas.scene(title, numbers={name: [float(v) for v in curve] for name, curve in series.items()})


def _closed_cycle(x: Array, series: Mapping[str, Array]) -> tuple[Array, Mapping[str, Array]]:
    """Angles (degrees) that cover full turns, with the start repeated at the end."""
    try:
        turns = whole_turns(np.radians(x))
    except ModelError:
        return x, series
    end = x[0] + math.copysign(360.0 * turns, x[-1] - x[0])
    return np.append(x, end), {name: np.append(v, v[0]) for name, v in series.items()}


def _reach(values: Array) -> tuple[float, float]:
    """Range of an axis: that of its values, including zero where they come close to it compared with their spread, or
    hardly vary.

    >>> _reach(np.array([10500.0, 12500.0])), _reach(np.array([800.0, 2500.0]))
    ((10500.0, 12500.0), (0.0, 2500.0))
    """
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
    spread, near, far = high - low, min(abs(low), abs(high)), max(abs(low), abs(high))
    return (low, high) if 0.01 * far < spread < 0.5 * near else (min(low, 0.0), max(high, 0.0))


def _missing(x: Array, known: Flags) -> list[tuple[float, float]]:
    """Parts of the axis between known places in which some values are missing."""
    known_places = np.flatnonzero(known)
    if not known_places.size:
        return [(float(np.nanmin(x)), float(np.nanmax(x)))] if np.isfinite(x).any() else []
    edges = [0, *known_places.tolist(), len(x) - 1]
    steps = [(a, b) for a, b in pairwise(edges) if b - a > 1 or not (known[a] and known[b])]
    return [(float(x[a]), float(x[b])) for a, b in steps if x[a] != x[b]]


@dataclass
class Field:
    """Plotting area of a chart: maps values to millimetres; ``y``: the values with a horizontal line."""

    x: tuple[float, float]
    y: list[float]
    listed: int = 0
    """Number of legend lines so far."""

    @classmethod
    def around(cls, x: Array, y: Array) -> Field:
        """A plotting area that contains some values."""
        low, high = float(x.min()), float(x.max())
        return cls((low, high) if high > low else (low - 1.0, high + 1.0), ticks(*_reach(y)))

    def __call__(self, a: float, b: float) -> Point:
        (left, right), low, high = self.x, self.y[0], self.y[-1]
        return SIZE[0] * (float(a) - left) / (right - left), SIZE[1] * (float(b) - low) / (high - low)

    def holds(self, p: Point, edge: float = 0.0) -> bool:
        """True if a point of the paper is inside, at least ``edge`` (mm) from the border."""
        return edge <= p[0] <= SIZE[0] - edge and edge <= p[1] <= SIZE[1] - edge

    def draw_axes(self, canvas: Canvas, xs: list[float], x_label: str, y_label: str) -> None:
        width, height = SIZE
        for x in xs:
            px = self(x, self.y[0])[0]
            canvas.add(Line(((px, 0.0), (px, height)), "grid"))
            canvas.add(Text((px, -3.2), _tick(x), 2.6, "note"))
        for y in self.y:
            py = self(0.0, y)[1]
            canvas.add(Line(((0.0, py), (width, py)), "axis" if y == 0 else "grid"))
            canvas.add(Text((-1.5, py), _tick(y), 2.6, "note", "end"))
        canvas.add(Line(((0.0, height), (0.0, 0.0), (width, 0.0)), "axis"))
        canvas.add(Text((width / 2, -7.6), x_label, 2.8, "note"))
        canvas.add(Text((-1.5, height + 4.2), y_label, 2.8, "note", "start"))

    def draw_legend(self, canvas: Canvas, name: str, role: str) -> None:
        """Adds a line to the legend."""
        y, left, right = SIZE[1] - 2.0 - 4.6 * self.listed, SIZE[0] + 3.0, SIZE[0] + 10.0
        self.listed += 1
        if role.endswith("-fill"):
            corners = ((left, y - 1.4), (right, y - 1.4), (right, y + 1.4), (left, y + 1.4))
            canvas.add(Polygon(corners, role))
        else:
            canvas.add(Line(((left, y), (right, y)), role))
        canvas.add(Text((right + 1.5, y), name, 2.8, "text", "start"))


def _tick(value: float) -> str:
    return f"{value:g}".replace("-", "−")


def _runs(x: Array, y: Array) -> list[list[tuple[float, float]]]:
    """Pieces without gaps."""
    out: list[list[tuple[float, float]]] = [[]]
    for a, b in zip(np.asarray(x, float).tolist(), np.asarray(y, float).tolist(), strict=True):
        if math.isfinite(b) and math.isfinite(a):
            out[-1].append((a, b))
        elif out[-1]:
            out.append([])
    return [run for run in out if run]


def polar_scene(
    paths: Mapping[str, Array], unit: str, title: str, size: float = 62.0, labels: Ticks = ()
) -> Scene:
    """Hodographs: ends of force vectors over the cycle around the pole, with circles of equal magnitude as far as the
    paths extend; ``labels`` label some positions. A path is closed only where its ends are as close as its steps."""
    canvas, everything = Canvas(), np.concatenate([*paths.values(), np.zeros((1, 2))])
    known = everything[np.isfinite(everything).all(axis=1)]
    low, high = known.min(axis=0), known.max(axis=0)
    widest = float((high - low).max()) or 1.0
    step, scale = round_up(float(np.hypot(*known.T).max()) / 4), size / widest
    left, bottom = (float(v) for v in low * scale - 0.1 * size)
    right, top = (float(v) for v in high * scale + 0.1 * size)
    canvas.add(Line(((left, 0.0), (right, 0.0)), "axis"), Line(((0.0, bottom), (0.0, top)), "axis"))
    rings = [
        n * step * scale for n in range(1, 10) if n * step * scale <= math.dist((left, bottom), (right, top))
    ]
    for radius in rings:
        for run in _ring(radius, (left, bottom, right, top)):
            canvas.add(Line(run, "grid"))
    for n, (name, path) in enumerate(paths.items()):
        _draw_path(canvas, path * scale, f"curve-{n % 6 + 1}", labels)
        points = [(x, y) for x, y in (path * scale).tolist() if math.isfinite(x)]
        if points and len(paths) > 1:
            canvas.label(name, *points[:: max(1, len(points) // 12)], size=2.8)
    for n, radius in enumerate(rings, 1):
        spots = [p for run in _ring(radius, (left, bottom, right, top)) for p in run[2:-2:6]]
        if spots:
            canvas.label(_tick(n * step), *spots, size=2.4, role="note", leads=False)
    canvas.label("x", (right, 0.0), prefer=0.0, size=2.8, role="note", leads=False)
    canvas.label("y", (0.0, top), prefer=math.pi / 2, size=2.8, role="note", leads=False)
    return canvas.scene(title, notes=[f"Circles in {unit}"], scales={"force": 1 / scale})


def _ring(radius: float, window: Box) -> list[tuple[Point, ...]]:
    """Arcs of a circle about the pole within a window."""
    turn = np.linspace(0.0, 2 * math.pi, 145)
    x, y = radius * np.cos(turn), radius * np.sin(turn)
    inside = (x >= window[0]) & (y >= window[1]) & (x <= window[2]) & (y <= window[3])
    runs = _runs(np.where(inside, x, math.nan), y)
    if len(runs) > 1 and inside[0]:  # the first and the last piece are one
        runs = [*runs[1:-1], [*runs[-1], *runs[0][1:]]]
    return [tuple(run) for run in runs if len(run) > 1]


def _draw_path(canvas: Canvas, path: Array, role: str, labels: Ticks) -> None:
    """A path in mm in pieces without gaps, with labels at a distance from one another."""
    runs = _runs(*path.T)
    steps = np.hypot(*np.diff(path, axis=0).T)
    is_cycle = len(runs) == 1 and len(runs[0]) == len(path) > 2
    if is_cycle and math.dist(runs[0][0], runs[0][-1]) <= 2.0 * float(steps.max()):
        runs = [[*runs[0], runs[0][0]]]
    for run in runs:
        canvas.add(Line(tuple(run), role) if len(run) > 1 else Circle(run[0], 0.4, role))
    labelled: list[Point] = []
    for k, text in labels:
        at = (float(path[k, 0]), float(path[k, 1]))
        if math.isfinite(at[0]) and all(math.dist(at, other) > 3.0 for other in labelled):
            labelled.append(at)
            canvas.add(Circle(at, 0.5, "mark"))
            canvas.label(text, at, prefer=math.atan2(at[1], at[0]), size=2.3, role="note")
