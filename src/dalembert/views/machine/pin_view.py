"""A bolt along its axis with the links on it, to scale, and its bending moment where that is largest."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.arrays import first_largest
from dalembert.machine.elements.pin_stresses import PinStresses, moment_along
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import round_up
from dalembert.views.paper.scene import Line, Polygon, Scene, Text

WIDE = 1.9
"""Width of a letter, mm, at least."""
LONG, HIGH = 110.0, 22.0
"""Length of a drawn bolt, and the largest ordinate of its moment, mm."""


class BoltLayer(NamedTuple):
    """A link on a bolt: its name, its middle and its thickness, m; 0 where the file has none."""

    link: str
    middle: float
    thick: float


def layers_of(x: PinStresses) -> list[BoltLayer]:
    """The links from one end of the bolt to the other, as `moment_along` counts places."""
    size, (i, j) = x.size, x.result.mechanism.joints[x.joint].links
    if size.stack is not None and size.layers is not None:
        thick = size.thicknesses or (0.0,) * len(size.stack)
        return [BoltLayer(*of) for of in zip(size.stack, size.layers, thick, strict=True)]
    eye, cheek = size.eye or 0.0, size.cheeks or 0.0
    step = (eye + cheek) / 2 + size.gap
    two = [BoltLayer(i, 0.0, cheek), BoltLayer(j, step, eye)]
    return two if size.planes == 1 else [*two, BoltLayer(i, 2 * step, cheek)]


def pin_scene(x: PinStresses, notation: Notation) -> Scene:
    """The bolt and its links in section, the moment below."""
    shown, canvas, layers = Shown(x.result, notation), Canvas(), layers_of(x)
    d = x.size.diameter
    low = min(e.middle - e.thick / 2 for e in layers) - d / 4
    high = max(e.middle + e.thick / 2 for e in layers) + d / 4
    per_mm = round_up((high - low) / shown.size("length") / LONG) * shown.size("length")
    half = d / 2 / per_mm

    def at(s: float) -> float:
        return (s - low) / per_mm

    rows: list[float] = []  # right ends of what is written in each row above the links
    for e in layers:
        a, b = at(e.middle - e.thick / 2), at(e.middle + e.thick / 2)
        for side in (1, -1):
            y, far = side * half, side * (half + 8.0)
            canvas.add(Polygon(((a, y), (b, y), (b, far), (a, far)), "block"))
        text = e.link
        if e.link in x.pressures:
            text += f", {shown.text('pressure', float(np.nanmax(x.pressures[e.link])))}"
        wide = WIDE * len(text)
        left = (a + b - wide) / 2
        row = next((k for k, right in enumerate(rows) if left > right), len(rows))
        rows[row : row + 1] = [left + wide + WIDE]
        canvas.add(Text(((a + b) / 2, half + 12.0 + 5.0 * row), text, 3.0))
    end = at(high)
    canvas.add(Polygon(((0.0, -half), (end, -half), (end, half), (0.0, half)), "pin"))
    canvas.add(Line(((-4.0, 0.0), (end + 4.0, 0.0)), "construction"))
    if np.isfinite(x.moment).any():
        _draw_moment(x, shown, canvas, -half - 8.0 - 8.0, at)
    title = f"Bolt of {x.joint}, diameter {shown.text('length', d)}"
    note = f"1 mm = {shown.plain('length', per_mm)}. Pressures are the largest of the cycle."
    return canvas.scene(title, notes=[note], scales={"length": per_mm})


def _draw_moment(x: PinStresses, shown: Shown, canvas: Canvas, top: float, at: object) -> None:
    k = first_largest(x.moment)
    s, m = moment_along(x, k)
    if not len(s) or not m.max() > 0:
        return
    assert callable(at)
    points = tuple((at(a), top - HIGH * b / m.max()) for a, b in zip(s.tolist(), m.tolist(), strict=True))
    ends = (points[0][0], top), (points[-1][0], top)
    canvas.add(Line(ends, "construction"), Line((ends[0], *points, ends[1]), "curve-1"))
    place = points[first_largest(m)]
    text = f"M = {shown.text('moment', float(m.max()))} at position {k + 1}"
    canvas.add(Text((place[0], place[1] - 4.0), text, 3.0))
