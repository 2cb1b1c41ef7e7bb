"""A scene as SVG text, in millimetres, so that a print is to scale."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from html import escape

import numpy as np

from dalembert.views.formats.themes import BACKGROUND, FONT, THEMES, Look
from dalembert.views.paper.lettering import SMALL, Box, pieces
from dalembert.views.paper.scene import Arc, Arrow, Circle, Group, Item, Line, Point, Polygon, Scene, Text

MARGIN = 3.0
HEAD = 3.0
"""Length of an arrow's head in mm; shorter arrows have shorter heads."""


def svg_text(scene: Scene, theme: str = "light") -> str:
    """The drawing as a standalone SVG."""
    return page(scene.bounds, scene.title, theme, lambda writer: "".join(map(writer.item, scene.items)))


def page(bounds: Box, title: str, theme: str, drawn: Callable[[Writer], str]) -> str:
    """An SVG that shows some bounds, filled by ``drawn`` with the writer."""
    left, bottom, right, top = bounds
    width, height = right - left + 2 * MARGIN, top - bottom + 2 * MARGIN
    prefix = theme[0]
    writer = Writer(left - MARGIN, top + MARGIN, prefix)
    body = drawn(writer)
    style = "".join(rule(prefix, role, THEMES[theme][role]) for role in sorted(writer.roles))
    paper = BACKGROUND[theme]
    back = f'<rect width="{width:.2f}" height="{height:.2f}" fill="{paper}"/>'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.2f}mm" height="{height:.2f}mm" '
        f'viewBox="0 0 {width:.2f} {height:.2f}" font-family="{FONT}">'
        f"<title>{escape(title)}</title><style>{style}</style>{back}{body}</svg>\n"
    )


def rule(prefix: str, role: str, look: Look) -> str:
    """CSS rule of a role: its lines, letters and heads."""
    bold = ";font-weight:bold" if look.weight != "normal" else ""
    dash = f";stroke-dasharray:{' '.join(f'{d:g}' for d in look.dash)}" if look.dash else ""
    stroke = f".{prefix}-{role}{{stroke:{look.stroke};stroke-width:{look.width:g};fill:{look.fill}{dash}"
    return (
        stroke + ";stroke-linecap:round;stroke-linejoin:round}"
        f".{prefix}-{role}-t{{fill:{look.stroke}{bold}}}"
        f".{prefix}-{role}-h{{fill:{look.stroke};stroke:none}}"
    )


class Writer:
    """Primitives to elements; page coordinates have y down from the top."""

    def __init__(self, left: float, top: float, prefix: str) -> None:
        self.left, self.top, self.prefix = left, top, prefix
        self.roles: set[str] = set()

    def item(self, item: Item) -> str:
        """One primitive."""
        if isinstance(item, Group):
            inside = "".join(self.item(one) for one in item.items)
            return f'<g data-name="{escape(item.name)}">{inside}</g>'
        self.roles.add(item.role)
        if isinstance(item, Text):
            return self.text(item)
        if isinstance(item, Circle):
            x, y = self.at(item.center)
            return f'<circle {self.look(item.role)} cx="{x}" cy="{y}" r="{_n(item.radius)}"/>'
        if isinstance(item, Polygon):
            return f'<path {self.look(item.role)} d="{self.path(item.points)}Z"/>'
        if isinstance(item, Line):
            return f'<path {self.look(item.role)} style="fill:none" d="{self.path(item.points)}"/>'
        return self.arc(item) if isinstance(item, Arc) else self.arrow(item)

    def look(self, role: str, part: str = "") -> str:
        return f'class="{self.prefix}-{role}{part}"'

    def at(self, p: Point) -> tuple[str, str]:
        return _n(p[0] - self.left), _n(self.top - p[1])

    def path(self, points: tuple[Point, ...]) -> str:
        if len(points) <= FEW:
            places = [self.at(p) for p in points]
            return "M" + "L".join(f"{x} {y}" for x, y in places)
        far = (np.array(points, float) - (self.left, self.top)) * (1, -1)
        written = (
            "%.2f %.2fL" * len(points) % tuple(np.where(np.abs(far) < NOTHING, 0.0, far).ravel().tolist())
        )
        return "M" + ZEROS.sub("", written)[:-1]

    def text(self, t: Text) -> str:
        x, y = self.at((t.at[0], t.at[1] - 0.36 * t.size))
        spans, level = [], 0
        for piece in pieces(t.text):
            shift = (level - piece.level) * 0.28 * t.size
            level = piece.level
            size = f' font-size="{_n(t.size * SMALL)}"' if piece.level else ""
            dy = f' dy="{_n(shift)}"' if shift else ""
            letters = escape(piece.text)
            spans.append(f"<tspan{dy}{size}>{letters}</tspan>" if dy or size else letters)
        return (
            f'<text {self.look(t.role, "-t")} x="{x}" y="{y}" font-size="{_n(t.size)}" '
            f'text-anchor="{t.anchor}" xml:space="preserve">{"".join(spans)}</text>'
        )

    def arrow(self, a: Arrow) -> str:
        shaft, head = arrow_parts(a.tail, a.head)
        out = f'<path {self.look(a.role, "-h")} d="{self.path(head)}Z"/>' if head else ""
        return f'<path {self.look(a.role)} style="fill:none" d="{self.path(shaft)}"/>' + out

    def arc(self, a: Arc) -> str:
        (x0, y0), (x1, y1) = self.at(a.at(a.start)), self.at(a.at(a.end))
        large, sweep = int(abs(a.end - a.start) > math.pi), int(a.end < a.start)
        r = _n(a.radius)
        d = f"M{x0} {y0}A{r} {r} 0 {large} {sweep} {x1} {y1}"
        out = f'<path {self.look(a.role)} style="fill:none" d="{d}"/>'
        if a.arrow:
            out += f'<path {self.look(a.role, "-h")} d="{self.path(arc_head(a))}Z"/>'
        return out


FEW = 8
"""Points up to which writing them one by one is faster."""
NOTHING = 0.005
ZEROS = re.compile(r"\.?0+(?=[ L])")
"""Zeros at the end of a number with two decimals."""


def _n(x: float) -> str:
    return f"{x:.2f}".rstrip("0").rstrip(".") if abs(x) >= NOTHING else "0"


def arrow_parts(tail: Point, head: Point) -> tuple[tuple[Point, Point], tuple[Point, ...]]:
    """Shaft, ended inside the head, and the triangle of the head."""
    length = math.dist(tail, head)
    if length < 0.05:
        return (tail, head), ()
    ux, uy = (head[0] - tail[0]) / length, (head[1] - tail[1]) / length
    size = min(HEAD, 0.75 * length)
    base = (head[0] - size * ux, head[1] - size * uy)
    side = 0.3 * size
    left, right = (base[0] - side * uy, base[1] + side * ux), (base[0] + side * uy, base[1] - side * ux)
    end = (head[0] - 0.8 * size * ux, head[1] - 0.8 * size * uy)
    return (tail, end), (head, left, right)


def arc_head(a: Arc) -> tuple[Point, ...]:
    """Triangle at the end of an arc, along it."""
    sign = math.copysign(1.0, a.end - a.start)
    size = min(0.85 * HEAD, 0.9 * a.radius)
    back = a.end - sign * size / a.radius
    tail, tip = a.at(back), a.at(a.end)
    return arrow_parts((tip[0] - 2 * (tip[0] - tail[0]), tip[1] - 2 * (tip[1] - tail[1])), tip)[1]
