"""A scene as a TikZ picture in millimetres, for LaTeX: in the fonts of its document, to scale when printed."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from dalembert.views.formats.svg import MARGIN, arc_head, arrow_parts
from dalembert.views.formats.themes import THEMES, Look
from dalembert.views.paper.lettering import pieces
from dalembert.views.paper.scene import Arc, Arrow, Circle, Line, Point, Polygon, Scene, Text

POINT = 72.27 / 25.4
"""TeX points per millimetre."""

ANCHORS = {"start": "base west", "middle": "base", "end": "base east"}


def tikz_picture(scene: Scene, words: Callable[[str], str], theme: str = "light") -> str:
    r"""The drawing as a tikzpicture; ``words`` escapes LaTeX's special characters. Each node is on a separate line.

    >>> print(tikz_picture(Scene((Line(((0, 0), (10, 5)), "ground"),)), str).splitlines()[2])
    \draw[draw={rgb,255:red,107;green,119;blue,133},line width=0.4mm] (0,0)--(10,5);
    """
    left, bottom, right, top = scene.bounds
    corners = (
        f"({left - MARGIN:.2f},{bottom - MARGIN:.2f}) rectangle ({right + MARGIN:.2f},{top + MARGIN:.2f})"
    )
    lines = [r"\begin{tikzpicture}[x=1mm,y=1mm,line cap=round,line join=round]", rf"\path {corners};"]
    for item in scene.flat():
        lines += _lines(item, THEMES[theme][item.role], words)  # type: ignore[union-attr]
    return "\n".join([*lines, r"\end{tikzpicture}"])


def _lines(item: object, look: Look, words: Callable[[str], str]) -> Iterator[str]:
    if isinstance(item, Text):
        yield _node(item, look, words)
    elif isinstance(item, Circle):
        yield rf"\path[{_stroke(look)}{_fill(look)}] {_at(item.center)} circle[radius={_number(item.radius)}];"
    elif isinstance(item, Polygon):
        yield rf"\path[{_stroke(look)}{_fill(look)}] {_path(item.points)}--cycle;"
    elif isinstance(item, Line):
        yield rf"\draw[{_stroke(look)}] {_path(item.points)};"
    elif isinstance(item, Arc):
        yield rf"\draw[{_stroke(look)}] {_path(item.points)};"
        yield from _head(arc_head(item) if item.arrow else (), look)
    elif isinstance(item, Arrow):
        shaft, head = arrow_parts(item.tail, item.head)
        yield rf"\draw[{_stroke(look)}] {_path(shaft)};"
        yield from _head(head, look)


def _head(points: tuple[Point, ...], look: Look) -> Iterator[str]:
    if points:
        yield rf"\fill[fill={_color(look.stroke)}] {_path(points)}--cycle;"


def _node(t: Text, look: Look, words: Callable[[str], str]) -> str:
    """Letters on the same baseline as in other formats; superscripts and subscripts by LaTeX."""
    levels = {1: r"\textsuperscript", -1: r"\textsubscript"}
    text = "".join(
        f"{levels[p.level]}{{{words(p.text)}}}" if p.level else words(p.text) for p in pieces(t.text)
    )
    size = t.size * POINT
    font = rf"\sffamily\fontsize{{{size:.1f}}}{{{size:.1f}}}\selectfont"
    bold = r"\bfseries" if look.weight != "normal" else ""
    at = _at((t.at[0], t.at[1] - 0.36 * t.size))
    options = f"anchor={ANCHORS[t.anchor]},inner sep=0pt,text={_color(look.stroke)},font={font}{bold}"
    return rf"\node[{options}] at {at} {{{text}}};"


def _stroke(look: Look) -> str:
    dash = " ".join(f"{'off' if n % 2 else 'on'} {d:g}mm" for n, d in enumerate(look.dash))
    return f"draw={_color(look.stroke)},line width={look.width:g}mm" + (
        f",dash pattern={dash}" if dash else ""
    )


def _fill(look: Look) -> str:
    return "" if look.fill == "none" else f",fill={_color(look.fill)}"


def _color(sign: str) -> str:
    """#1c56a8 or #356 as LaTeX mixes it."""
    digits = sign.lstrip("#")
    digits = digits if len(digits) == 6 else "".join(2 * d for d in digits)
    red, green, blue = (int(digits[k : k + 2], 16) for k in (0, 2, 4))
    return f"{{rgb,255:red,{red};green,{green};blue,{blue}}}"


def _path(points: tuple[Point, ...]) -> str:
    return "--".join(map(_at, points))


def _at(p: Point) -> str:
    return f"({_number(p[0])},{_number(p[1])})"


def _number(x: float) -> str:
    return f"{x:.2f}".rstrip("0").rstrip(".") if abs(x) >= 0.005 else "0"
