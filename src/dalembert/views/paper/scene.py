"""A drawing as data: a few primitives in millimetres of paper, x right, y up. It contains no mechanics.

A role (`link`, `joint-force`, `dimension`, ...) classifies a primitive; a theme gives a role its look. An arrow keeps
the value that it represents, so that its length can be checked against the stated scale.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from pathlib import Path

from dalembert.arrays import Tree
from dalembert.views.paper.lettering import Box, text_box

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Line:
    """Straight pieces through points."""

    points: tuple[Point, ...]
    role: str = "link"


@dataclass(frozen=True, slots=True)
class Polygon:
    """A closed, filled outline."""

    points: tuple[Point, ...]
    role: str = "link"


@dataclass(frozen=True, slots=True)
class Circle:
    """A circle."""

    center: Point
    radius: float
    role: str = "link"


@dataclass(frozen=True, slots=True)
class Arc:
    """Part of a circle from angle start to end, radians; ``arrow`` puts a head at its end."""

    center: Point
    radius: float
    start: float
    end: float
    role: str = "construction"
    arrow: bool = False
    of: str = ""
    value: float | None = None

    def at(self, angle: float) -> Point:
        """A point of the arc."""
        return (
            self.center[0] + self.radius * math.cos(angle),
            self.center[1] + self.radius * math.sin(angle),
        )

    @property
    def points(self) -> tuple[Point, ...]:
        """Polyline close to the arc."""
        count = max(2, math.ceil(abs(self.end - self.start) / 0.15) + 1)
        step = (self.end - self.start) / (count - 1)
        return tuple(self.at(self.start + k * step) for k in range(count))


@dataclass(frozen=True, slots=True)
class Arrow:
    """Arrow from tail to head; its length represents ``value`` (SI) at the scale of its ``kind``."""

    tail: Point
    head: Point
    role: str = "joint-force"
    of: str = ""
    kind: str = ""
    value: float | None = None

    @property
    def length(self) -> float:
        """Drawn length in mm."""
        return math.dist(self.tail, self.head)


@dataclass(frozen=True, slots=True)
class Text:
    """Text whose middle height is at a point; `_{...}` and `^{...}` lower and raise."""

    at: Point
    text: str
    size: float = 3.0
    role: str = "text"
    anchor: str = "middle"

    @property
    def box(self) -> Box:
        """Bounding box: (left, bottom, right, top)."""
        return text_box(self.at, self.text, self.size, self.anchor, self.role == "title")


@dataclass(frozen=True, slots=True)
class Group:
    """Items that belong together."""

    items: tuple[Item, ...]
    name: str = ""


Item = Line | Polygon | Circle | Arc | Arrow | Text | Group


@dataclass(frozen=True, repr=False)
class Scene:
    """Items, a title, scales (kind -> SI units per millimetre) and numbers that belong to the drawing.

    >>> scene = Scene((Line(((0, 0), (10, 0))),), "a line")
    >>> scene.bounds
    (0.0, 0.0, 10.0, 0.0)
    """

    items: tuple[Item, ...]
    title: str = ""
    scales: Mapping[str, float] = field(default_factory=dict)
    numbers: Mapping[str, object] = field(default_factory=dict)

    def __repr__(self) -> str:
        return f"<Scene {self.title!r}: {sum(1 for _ in self.flat())} items>"

    def flat(self) -> Iterator[Item]:
        """All primitives, with groups expanded."""
        yield from _flatten(self.items)

    def texts(self) -> list[Text]:
        """All texts."""
        return [item for item in self.flat() if isinstance(item, Text)]

    def arrows(self) -> list[Arrow]:
        """All arrows."""
        return [item for item in self.flat() if isinstance(item, Arrow)]

    @property
    def bounds(self) -> Box:
        """Bounding box of the drawing: (left, bottom, right, top) in mm."""
        boxes = [item_box(item) for item in self.flat()]
        if not boxes:
            return (0.0, 0.0, 0.0, 0.0)
        left, bottom, right, top = zip(*boxes, strict=True)
        return (float(min(left)), float(min(bottom)), float(max(right)), float(max(top)))

    def shift(self, dx: float, dy: float) -> Scene:
        """The scene moved on the paper."""
        return replace(self, items=tuple(shift_item(item, dx, dy) for item in self.items))

    def to_dict(self) -> Tree:
        """The data form: every primitive with its kind, role and numbers."""
        return {
            "title": self.title,
            "scales": dict(self.scales),
            "numbers": dict(self.numbers),
            "items": [_tree(item) for item in self.items],
        }

    def to_svg(self, theme: str = "light") -> str:
        """SVG text, to scale when printed."""
        from dalembert.views.formats.svg import svg_text

        return svg_text(self, theme)

    def save(
        self, path: str | Path, overwrite: bool = False, theme: str = "light", paper: str | None = None
    ) -> None:
        """Writes .svg, .pdf, .png or .dxf; themes: light, dark, print. ``paper``, of a PDF: pages of a4 or letter."""
        from dalembert.views.formats.scene_file import save

        save(self, path, overwrite, theme, paper)

    def _repr_svg_(self) -> str:
        return self.to_svg()


def along(tail: Point, head: Point, *parts: float) -> list[Point]:
    """Points at fractions of the distance from one point to another."""
    return [(tail[0] + t * (head[0] - tail[0]), tail[1] + t * (head[1] - tail[1])) for t in parts]


def around(at: Point, radius: float, count: int, first: float = 0.0) -> list[Point]:
    """Places on a circle, the first at an angle."""
    turns = (first + 2 * math.pi * n / count for n in range(count))
    return [(at[0] + radius * math.cos(t), at[1] + radius * math.sin(t)) for t in turns]


def _flatten(items: Sequence[Item]) -> Iterator[Item]:
    for item in items:
        if isinstance(item, Group):
            yield from _flatten(item.items)
        else:
            yield item


def item_box(item: Item) -> Box:
    """Bounding box of a primitive."""
    if isinstance(item, Text):
        return item.box
    if isinstance(item, Circle):
        (x, y), r = item.center, item.radius
        return (x - r, y - r, x + r, y + r)
    points = (item.tail, item.head) if isinstance(item, Arrow) else item.points  # type: ignore[union-attr]
    across, up = zip(*points, strict=True)
    return (min(across), min(up), max(across), max(up))


def shift_item(item: Item, dx: float, dy: float) -> Item:
    """A primitive moved on the paper."""

    def to(p: Point) -> Point:
        return (p[0] + dx, p[1] + dy)

    if isinstance(item, Group):
        return Group(tuple(shift_item(one, dx, dy) for one in item.items), item.name)
    if isinstance(item, (Line, Polygon)):
        return type(item)(tuple([(x + dx, y + dy) for x, y in item.points]), item.role)
    if isinstance(item, Arrow):
        return Arrow(to(item.tail), to(item.head), item.role, item.of, item.kind, item.value)
    if isinstance(item, Text):
        return Text(to(item.at), item.text, item.size, item.role, item.anchor)
    return replace(item, center=to(item.center))


def _tree(item: Item) -> Tree:
    tree: Tree = {"primitive": type(item).__name__.lower()}
    if isinstance(item, Group):
        return tree | {"name": item.name, "items": [_tree(one) for one in item.items]}
    return tree | {f.name: getattr(item, f.name) for f in fields(item)}


def stack_scenes(scenes: Sequence[Scene], gap: float = 8.0, width: float = 180.0, title: str = "") -> Scene:
    """Several drawings as panels in rows no wider than ``width``, each under its title."""
    items: list[Item] = []
    x, top, row_bottom = 0.0, 0.0, 0.0
    for scene in scenes:
        left, bottom, right, high = scene.bounds
        if x > 0 and x + right - left > width:
            x, top = 0.0, row_bottom - gap
        drawn = scene.shift(x - left, top - high)
        items.append(Group(drawn.items, scene.title))
        row_bottom = min(row_bottom, top - (high - bottom))
        x += right - left + gap
    scales = {f"{s.title}: {k}": v for s in scenes for k, v in s.scales.items()}
    return Scene(tuple(items), title, scales, {s.title: dict(s.numbers) for s in scenes})
