"""A scene by matplotlib: PDF and PNG, and frames of animations as pictures."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from dalembert.arrays import Array, Tree
from dalembert.views.formats.svg import MARGIN, arc_head, arrow_parts
from dalembert.views.formats.themes import BACKGROUND, THEMES, Look
from dalembert.views.paper.lettering import BOLD, SMALL, Box, letters_width, pieces
from dalembert.views.paper.pages import break_pages
from dalembert.views.paper.scene import Arc, Arrow, Circle, Group, Item, Line, Polygon, Scene, Text, around

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from PIL import Image

POINT = 72 / 25.4
"""Points per millimetre."""


SETTINGS = {"pdf.fonttype": 42, "text.hinting": "none"}
"""Fonts embedded in a PDF as fonts; unhinted letter widths in a PNG, since later text is placed by them."""


def write_figure(
    scene: Scene, path: str | Path, theme: str = "light", dpi: int = 200, paper: str | None = None
) -> None:
    """Writes a PDF or a PNG, to scale; with ``paper`` a PDF in pages."""
    import matplotlib

    if paper is not None:
        _write_pages(scene, path, theme, dpi, paper)
        return
    path = Path(path)
    metadata: Tree = {"Title": scene.title} if path.suffix != ".png" else {}
    if path.suffix == ".pdf":
        metadata["CreationDate"] = None
    with matplotlib.rc_context(SETTINGS):
        painter = _Painter(scene.bounds, theme, dpi)
        for artist in painter.artists(scene.items):
            painter.figure.add_artist(artist)
        painter.figure.savefig(path, dpi=dpi, metadata=metadata, format=path.suffix[1:])


def _write_pages(scene: Scene, path: str | Path, theme: str, dpi: int, paper: str) -> None:
    import matplotlib
    from matplotlib.backends.backend_pdf import PdfPages

    metadata: Tree = {"Title": scene.title, "CreationDate": None}
    with matplotlib.rc_context(SETTINGS), PdfPages(path, metadata=metadata) as file:
        for page in break_pages(scene, paper):
            painter = _Painter((MARGIN, MARGIN, page.width - MARGIN, page.height - MARGIN), theme, dpi)
            for artist in painter.artists(page.items):
                painter.figure.add_artist(artist)
            file.savefig(painter.figure)


def pictures(
    still: Sequence[Item], frames: Iterable[Sequence[Item]], bounds: Box, theme: str = "light", dpi: int = 90
) -> list[Image.Image]:
    """Pictures of PIL: the items of each frame over the static ones, drawn once; ``bounds`` in mm."""
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    with matplotlib.rc_context(SETTINGS):
        painter = _Painter(bounds, theme, dpi)
        figure, canvas = painter.figure, FigureCanvasAgg(painter.figure)
        for artist in painter.artists(still):
            figure.add_artist(artist)
        canvas.draw()
        behind, out = canvas.copy_from_bbox(figure.bbox), []
        for items in frames:
            canvas.restore_region(behind)
            for artist in painter.artists(items):
                figure.draw_artist(artist)
            out.append(Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB"))
    return out


class _Painter:
    """Primitives to artists of a figure, in drawing order; without axes, which would take longer than the drawing
    itself."""

    def __init__(self, bounds: Box, theme: str, dpi: int) -> None:
        from matplotlib.figure import Figure
        from matplotlib.transforms import Bbox, BboxTransformFrom, BboxTransformTo

        left, bottom, right, top = bounds
        left, bottom, right, top = left - MARGIN, bottom - MARGIN, right + MARGIN, top + MARGIN
        size = ((right - left) / 25.4, (top - bottom) / 25.4)
        self.figure = Figure(figsize=size, dpi=dpi, facecolor=BACKGROUND[theme])
        paper = BboxTransformFrom(Bbox.from_extents(left, bottom, right, top))
        self.transform = paper + BboxTransformTo(self.figure.bbox)
        self.looks, self.order = THEMES[theme], 1
        self._out: list[Artist] = []

    def artists(self, items: Iterable[Item]) -> list[Artist]:
        """Matplotlib artists of the items."""
        self._out = []
        for item in items:
            self.item(item)
        return self._out

    def _add(self, artist: Artist) -> None:
        artist.set(figure=self.figure, transform=self.transform, zorder=self.order)
        self._out.append(artist)

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
            points = around(item.center, item.radius, 72)
            self.area(points, look) if look.fill != "none" else self.line([*points, points[0]], look)
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
        dash: Any = (0, [d / look.width for d in look.dash]) if look.dash else "-"
        width = look.width * POINT
        self._add(Line2D(x, y, color=look.stroke, linewidth=width, linestyle=dash, solid_capstyle="round"))

    def area(self, points: ArrayLike, look: Look) -> None:
        from matplotlib.patches import Polygon as Patch

        colors = {"facecolor": look.fill, "edgecolor": look.stroke}
        self._add(Patch(points, closed=True, linewidth=look.width * POINT, joinstyle="round", **colors))

    def head(self, points: ArrayLike, look: Look) -> None:
        from matplotlib.patches import Polygon as Patch

        if points:
            self._add(Patch(points, closed=True, facecolor=look.stroke, linewidth=0))

    def text(self, t: Text, look: Look) -> None:
        from matplotlib.text import Text as Letters

        bold = BOLD if look.weight != "normal" else 1.0
        left, base = t.box[0], t.at[1] - 0.36 * t.size
        for piece in pieces(t.text):
            size = t.size * (SMALL if piece.level else 1.0)
            self._add(
                Letters(
                    left,
                    base + piece.level * 0.28 * t.size,
                    piece.text.replace("$", r"\$"),
                    fontsize=size * POINT,
                    color=look.stroke,
                    fontweight=look.weight,
                    fontfamily="DejaVu Sans",
                    verticalalignment="baseline",
                )
            )
            left += size * letters_width(piece.text) * bold
