"""Drawings of a study: histogram, scatter, response over one number or two."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.answer.column import Scale
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.studies.contributions import ResponseCurve
from dalembert.studies.study_result import StudyResult
from dalembert.views.notation import pretty
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.diagrams import Field, curves_scene, inner_ticks, ticks
from dalembert.views.paper.scene import Circle, Line, Point, Polygon, Scene

DOTS = 1_000
"""Designs of a scatter diagram."""
LEVELS = 8
"""Lines of equal value in a contour diagram, about."""
EDGE = 8.0
"""Distance from the edge of a diagram, mm, within which lines are not labelled: the axes' numbers are in it."""
PERCENTS = {"median": (50.0, "curve-1"), "5 % and 95 %": (5.0, "curve-3"), "": (95.0, "curve-3")}


def axis_label(to: Scale, name: str, kind: str) -> str:
    """'effort.O2 in N m'."""
    unit = pretty(to.text(kind))
    return f"{name} in {unit}" if unit and unit != "1" else name


def histogram_scene(r: StudyResult, name: str) -> Scene:
    """Number of designs with an output in each of some equal intervals, its percentiles and limits."""
    to, kind, canvas = Printed(r.study.mechanism.units), r.kinds[name], Canvas()
    counts, edges = r.histogram(name)
    x = to(kind, edges)
    ends = [to(kind, e) for limit in r.study.limits if limit.output == name for e in (limit.low, limit.high)]
    ends = [e for e in ends if np.isfinite(e)]
    low, high = min([x[0], *ends]), max([x[-1], *ends])
    field = Field((low, high) if high > low else (low - 1, high + 1), ticks(0.0, float(counts.max())))
    field.draw_axes(canvas, inner_ticks(*field.x), axis_label(to, name, kind), "Designs")
    for n, (a, b) in zip(counts.tolist(), pairwise(x), strict=True):
        if n:
            canvas.add(Polygon((field(a, 0), field(b, 0), field(b, n), field(a, n)), "bar"))
    lines = [(words, to(kind, r.percentiles(name, (p,))[p]), role) for words, (p, role) in PERCENTS.items()]
    lines += [("limit" if k == 0 else "", end, "curve-2") for k, end in enumerate(ends)]
    for words, place, role in lines:
        canvas.add(Line((field(place, field.y[0]), field(place, field.y[-1])), role))
        if words:
            field.draw_legend(canvas, words, role)
    return canvas.scene(f"Distribution of {name}")


def scatter_scene(r: StudyResult, name: str, path: str) -> Scene:
    """An output over one of the numbers, of the first designs that have both."""
    to, kind = Printed(r.study.mechanism.units), r.kinds[name]
    count = min(DOTS, r.study.count)
    over = r.study.plan.values(0, count)[:, r.study.paths.index(path)]
    number_kind = r.study.number_kinds[path]
    x, y = to(number_kind, over), to(kind, r[name][:count])
    known = np.isfinite(y)
    canvas = Canvas()
    field = Field.around(x[known], y[known])
    field.draw_axes(
        canvas, inner_ticks(*field.x), axis_label(to, path, number_kind), axis_label(to, name, kind)
    )
    canvas.add(*(Circle(field(a, b), 0.3, "curve-1") for a, b in zip(x[known], y[known], strict=True)))
    return canvas.scene(f"Designs: {name} over {path}", notes=[f"The first {known.sum():,} that have one"])


def response_scene(r: StudyResult, of: ResponseCurve) -> Scene:
    """A curve over one number; over two, lines of equal value, grey where unsolved."""
    to, kind = Printed(r.study.mechanism.units), r.kinds[of.output]
    z = to(kind, of.values)
    kinds = [r.study.number_kinds[path] for path in of.paths]
    axes = [to(k, a) for k, a in zip(kinds, of.axes, strict=True)]
    labels = [axis_label(to, path, k) for path, k in zip(of.paths, kinds, strict=True)]
    title = f"Response of {of.output} to {' and '.join(of.paths)}"
    if len(axes) == 1:
        return curves_scene(axes[0], {of.output: z}, labels[0], axis_label(to, of.output, kind), title)
    if not np.isfinite(z).any():
        raise ModelError(f"no design has a value of {of.output}", "make the spreads smaller")
    (x, y), canvas, field = axes, Canvas(), Field.around(*axes)
    field.draw_axes(canvas, inner_ticks(*field.x), *labels)
    missing = (cell for cell, values in _cells(x, y, z) if not np.isfinite(values).all())
    canvas.add(*(Polygon(tuple(field(*p) for p in cell), "missing-fill") for cell in missing))
    for level in inner_ticks(float(np.nanmin(z)), float(np.nanmax(z)), LEVELS):
        pieces = [tuple(field(*p) for p in piece) for piece in contour(x, y, z, level)]
        canvas.add(*(Line(piece, "curve-1") for piece in pieces))
        inner = [piece[0] for piece in pieces if field.holds(piece[0], EDGE)]
        if inner:
            spots = inner[:: max(1, len(inner) // 12)]
            canvas.label(f"{level:g}", *spots, size=2.4, role="note", leads=False)
    notes = [
        f"Lines of equal {axis_label(to, of.output, kind)}; the other numbers at the middle of their spreads"
    ]
    return canvas.scene(title, notes=notes)


def _cells(x: Array, y: Array, z: Array) -> Iterator[tuple[list[Point], Array]]:
    """Corners, counter-clockwise, and values of each cell of a grid, z (x, y)."""
    for i in range(len(x) - 1):
        for j in range(len(y) - 1):
            places = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            yield [(float(x[a]), float(y[b])) for a, b in places], np.array([z[p] for p in places])


def contour(x: Array, y: Array, z: Array, level: float) -> list[tuple[Point, Point]]:
    """Straight pieces where z (x, y) has a value, linear in the two triangles of each cell.

    >>> contour(np.array([0.0, 1.0]), np.array([0.0, 1.0]), np.array([[0.0, 0.0], [1.0, 1.0]]), 0.5)
    [((0.5, 0.0), (0.5, 0.5)), ((0.5, 0.5), (0.5, 1.0))]
    """
    out = []
    for corners, values in _cells(x, y, z):
        if np.isfinite(values).all() and values.min() <= level <= values.max():
            for triangle in ((0, 1, 2), (0, 2, 3)):
                cut = []
                for a, b in ((triangle[k], triangle[k - 2]) for k in range(3)):
                    if (values[a] < level) != (values[b] < level):
                        part = float((level - values[a]) / (values[b] - values[a]))
                        cut.append(
                            (
                                corners[a][0] + part * (corners[b][0] - corners[a][0]),
                                corners[a][1] + part * (corners[b][1] - corners[a][1]),
                            )
                        )
                if len(cut) == 2:
                    out.append((cut[0], cut[1]))
    return out
