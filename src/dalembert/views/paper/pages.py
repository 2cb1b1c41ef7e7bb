"""A drawing split into pages of paper at true size: complete panels, in their rows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from dalembert.views.paper.scene import Group, Item, Scene, Text

PAPERS = {"a4": (210.0, 297.0), "letter": (215.9, 279.4)}
"""Width and height of a page, mm."""

MARGIN = 12.0
GAP = 8.0
"""Around a page and between panels, mm."""


HEADING = 20.0
"""Room for lines of text above a panel, mm."""


class Page(NamedTuple):
    """A page in mm, with its drawing placed from the lower left corner."""

    width: float
    height: float
    items: tuple[Item, ...]


def room(paper: str = "a4") -> tuple[float, float]:
    """Width and height available for a drawing on one page."""
    width, height = PAPERS[paper]
    return width - 2 * MARGIN, height - 2 * MARGIN


def fits(scene: Scene, paper: str = "a4") -> bool:
    """True if a drawing fits on one page."""
    width, height = _size(scene)
    return width <= room(paper)[0] and height <= room(paper)[1]


def break_pages(scene: Scene, paper: str = "a4") -> list[Page]:
    """Pages that contain all panels; a panel larger than a page gets a page of its size, in landscape if it fits so.

    >>> from dalembert.views.paper.scene import Line, stack_scenes
    >>> panel = Scene((Line(((0, 0), (100, 100))),))
    >>> [len(page.items) for page in break_pages(stack_scenes([panel] * 5))]
    [2, 2, 1]
    """
    out: list[list[list[Scene]]] = [[]]
    for row in _with_headings(_rows(scene, *room(paper))):
        if out[-1] and _sheet([*out[-1], *row], paper) is None:
            out.append([])
        out[-1] += row
    return [_page(lines, paper) for lines in out]


def _size(scene: Scene) -> tuple[float, float]:
    left, bottom, right, top = scene.bounds
    return right - left, top - bottom


def _height(line: Sequence[Scene]) -> float:
    return max(_size(panel)[1] for panel in line)


def _rows(scene: Scene, wide: float, high: float) -> Iterator[list[Scene]]:
    """Panels side by side, as many as fit; stacks that are too large are unpacked."""
    line: list[Scene] = []
    for panel in _panels(scene, wide, high):
        same = bool(line) and abs(panel.bounds[3] - line[0].bounds[3]) < 1e-6
        if line and not (same and sum(_size(p)[0] + GAP for p in line) + _size(panel)[0] <= wide):
            yield line
            line = []
        line.append(panel)
    if line:
        yield line


def _panels(scene: Scene, wide: float, high: float) -> Iterator[Scene]:
    """Panels of a stack of drawings, or the drawing itself."""
    if len(scene.items) < 2 or not all(isinstance(item, Group) for item in scene.items):
        yield scene
        return
    for item in scene.items:
        assert isinstance(item, Group)
        panel = Scene(item.items, item.name)
        width, height = _size(panel)
        upright = width <= wide and height <= high - HEADING
        along = width <= high and height <= wide - HEADING
        if upright or along:
            yield panel
        else:
            yield from _panels(panel, wide, high)


def _with_headings(rows: Iterator[list[Scene]]) -> Iterator[list[list[Scene]]]:
    """Rows with the headings (lines of text alone) that precede them."""
    kept: list[list[Scene]] = []
    for row in rows:
        kept.append(row)
        if not all(isinstance(item, Text) for panel in row for item in panel.flat()):
            yield kept
            kept = []
    if kept:
        yield kept


def _need(lines: Sequence[Sequence[Scene]]) -> tuple[float, float]:
    """Width and height of a page that just contains some rows."""
    wide = max(sum(_size(p)[0] + GAP for p in line) - GAP for line in lines)
    return wide + 2 * MARGIN, sum(_height(line) + GAP for line in lines) - GAP + 2 * MARGIN


def _sheet(lines: Sequence[Sequence[Scene]], paper: str) -> tuple[float, float] | None:
    """The paper in portrait or landscape, whichever first contains some rows; a wide row leaves only the height of
    landscape."""
    wide, high = _need(lines)
    formats = (PAPERS[paper], PAPERS[paper][::-1])
    return next((size for size in formats if wide <= size[0] + 1e-6 and high <= size[1] + 1e-6), None)


def _page(lines: Sequence[Sequence[Scene]], paper: str) -> Page:
    """The page for some rows: portrait, landscape, or of their size."""
    width, height = _sheet(lines, paper) or _need(lines)
    items: list[Item] = []
    y = height - MARGIN
    for line in lines:
        x = MARGIN
        for panel in line:
            left, _, right, top = panel.bounds
            items.append(Group(panel.shift(x - left, y - top).items, panel.title))
            x += right - left + GAP
        y -= _height(line) + GAP
    return Page(width, height, tuple(items))
