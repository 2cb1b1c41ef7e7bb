"""A scene by matplotlib: PDF and PNG, and frames of animations as pictures."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from dalembert.arrays import Array, Tree
from dalembert.views.formats.svg import MARGIN, arc_head, arrow_parts
from dalembert.views.formats.themes import BACKGROUND, THEMES, Look
from dalembert.views.paper.lettering import BOLD, SMALL, Box, letters_width, pieces
from dalembert.views.paper.scene import Arc, Arrow, Circle, Group, Item, Line, Polygon, Scene, Text

POINT = 72 / 25.4
"""Points in a millimetre."""


def write_figure(scene: Scene, path: str | Path, theme: str = "light", dpi: int = 200) -> None:
    """Write a PDF or a PNG, to scale."""
    path = Path(path)
    metadata: Tree = {"Title": scene.title} if path.suffix != ".png" else {}
    if path.suffix == ".pdf":
        metadata["CreationDate"] = None
    _save(scene, theme, scene.bounds, path, dpi=dpi, metadata=metadata, format=path.suffix[1:])


def png_bytes(scene: Scene, theme: str = "light", dpi: int = 110, bounds: Box | None = None) -> bytes:
    """A PNG picture; ``bounds`` in mm keep the frames of an animation alike."""
    out = BytesIO()
    _save(scene, theme, bounds or scene.bounds, out, dpi=dpi, format="png")
    return out.getvalue()


SETTINGS = {"pdf.fonttype": 42, "text.hinting": "none"}
"""Fonts as such in a PDF; letters as wide in a PNG as they are, for what stands behind others is placed by that."""


def _save(scene: Scene, theme: str, bounds: Box, target: Any, **options: Any) -> None:
    import matplotlib

    with matplotlib.rc_context(SETTINGS):
        _figure(scene, theme, bounds).savefig(target, **options)


def _figure(scene: Scene, theme: str, bounds: Box) -> Any:
    from matplotlib.figure import Figure

    left, bottom, right, top = bounds
    left, bottom, right, top = left - MARGIN, bottom - MARGIN, right + MARGIN, top + MARGIN
    paper = BACKGROUND[theme]
    figure = Figure(figsize=((right - left) / 25.4, (top - bottom) / 25.4), facecolor=paper)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0), frameon=False)
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    axes.set_axis_off()
    painter = _Painter(axes, theme)
    for item in scene.items:
        painter.item(item)
    return figure


class _Painter:
    """Primitives to artists, in drawing order."""

    def __init__(self, axes: Any, theme: str) -> None:
        self.axes, self.looks, self.order = axes, THEMES[theme], 1

    def item(self, item: Item) -> None:
        if isinstance(item, Group):
            for one in item.items:
                self.item(one)
            return
        self.order += 1
        look = self.looks[item.role]
        if isinstance(item, Text):
            self.text(item, look)
        elif isinstance(item, Circle):
            points = Arc(item.center, item.radius, 0.0, 2 * math.pi).points
            self.area(_smooth(item), look) if look.fill != "none" else self.line(points, look)
        elif isinstance(item, Polygon):
            self.area(item.points, look)
        elif isinstance(item, Line):
            self.line(item.points, look)
        elif isinstance(item, Arc):
            self.line(item.points, look)
            if item.arrow:
                self.head(arc_head(item), look)
        else:
            self.arrow(item, look)

    def arrow(self, a: Arrow, look: Look) -> None:
        shaft, head = arrow_parts(a.tail, a.head)
        self.line(shaft, look)
        self.head(head, look)

    def line(self, points: Iterable[Sequence[float]] | Array, look: Look) -> None:
        from matplotlib.lines import Line2D

        x, y = zip(*points, strict=True)
        style: Any = (0, [d * POINT for d in look.dash]) if look.dash else "-"
        line = Line2D(
            x, y, color=look.stroke, linewidth=look.width * POINT, zorder=self.order, solid_capstyle="round"
        )
        line.set_linestyle((0, [d / look.width for d in look.dash]) if look.dash else style)
        self.axes.add_line(line)

    def area(self, points: ArrayLike, look: Look) -> None:
        from matplotlib.patches import Polygon as Patch

        self.axes.add_patch(
            Patch(
                points,
                closed=True,
                facecolor=look.fill,
                edgecolor=look.stroke,
                linewidth=look.width * POINT,
                zorder=self.order,
                joinstyle="round",
            )
        )

    def head(self, points: ArrayLike, look: Look) -> None:
        from matplotlib.patches import Polygon as Patch

        if points:
            self.axes.add_patch(
                Patch(points, closed=True, facecolor=look.stroke, linewidth=0, zorder=self.order)
            )

    def text(self, t: Text, look: Look) -> None:
        bold = BOLD if look.weight != "normal" else 1.0
        left, base = t.box[0], t.at[1] - 0.36 * t.size
        for piece in pieces(t.text):
            size = t.size * (SMALL if piece.level else 1.0)
            self.axes.text(
                left,
                base + piece.level * 0.28 * t.size,
                piece.text.replace("$", r"\$"),
                fontsize=size * POINT,
                color=look.stroke,
                fontweight=look.weight,
                fontfamily="DejaVu Sans",
                verticalalignment="baseline",
                zorder=self.order,
            )
            left += size * letters_width(piece.text) * bold


def _smooth(c: Circle) -> list[tuple[float, float]]:
    return [
        (c.center[0] + c.radius * math.cos(t), c.center[1] + c.radius * math.sin(t))
        for t in (n * math.pi / 36 for n in range(72))
    ]
