"""Every primitive of a drawing in the text of each format, as written and looked at once: `formats/`.

`python -m tests.methods.test_formats` writes the files anew, after a look at them in a viewer.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from dalembert.views.formats.svg import svg_text
from dalembert.views.formats.tikz import tikz_picture
from dalembert.views.paper.scene import Arc, Arrow, Circle, Group, Line, Polygon, Scene, Text


def in_lines(text: str) -> str:
    """Markup with an element a line."""
    return text.replace("><", ">\n<")


FOLDER = Path(__file__).with_name("formats")
WRITERS: dict[str, Callable[[Scene], str]] = {
    "plain.svg": lambda s: in_lines(svg_text(s)),
    "dark.svg": lambda s: in_lines(svg_text(s, "dark")),
    "plain.tex": lambda s: tikz_picture(s, str),
}

EVERYTHING = Scene(
    (
        Line(((0, 0), (10, 0), (10, 5)), "link"),
        Line(((0, 1), (4, 1)), "construction"),
        Polygon(((20, 0), (26, 0), (23, 5)), "link-area"),
        Polygon(((30, 0), (36, 0), (33, 5)), "center-dark"),
        Circle((45, 3), 2.5, "pin"),
        Arc((55, 3), 3, 0.2, 1.7, "construction"),
        Arc((65, 3), 3, 1.7, 0.2, "construction"),
        Arc((75, 3), 3, 0.0, 1.5 * math.pi, "effort", True, "A", 2.0),
        Arc((85, 3), 3, 0.0, -1.5 * math.pi, "load", True),
        Arrow((0, 10), (12, 15), "joint-force", "A", "force", 3.0),
        Arrow((20, 15), (20, 10), "weight", "W", "force", 1.0),
        Arrow((30, 10), (30.4, 10), "inertia"),
        Group((Text((40, 12), "F_{12}^{n} = 3 N", 2.8, "joint-force"), Line(((40, 10), (50, 10)))), "inner"),
        Text((0, 22), "A & <B> 5 % $ #", 3.6, "title", "start"),
        Text((40, 22), "μ = −0.5, φ_{A} = 20°", 2.6, "note", "end"),
        Text((60, 22), "ω_{3/2} ẋ aʹ", 3.0, "text", "middle"),
    ),
    "All primitives",
)


def words(text: str) -> list[str]:
    return re.findall(r"-?\d+\.?\d*(?:e-?\d+)?|[^\d\s]+", text)


def same(a: str, b: str) -> bool:
    """True if two words are one, or two numbers that differ by the rounding of what is written."""
    try:
        return a == b or abs(float(a) - float(b)) < 2e-3
    except ValueError:
        return False


@pytest.mark.parametrize("name", WRITERS)
def test_every_primitive_is_written_as_it_was(name: str) -> None:
    now, before = (words(t) for t in (WRITERS[name](EVERYTHING), (FOLDER / name).read_text(encoding="utf-8")))
    for k, (a, b) in enumerate(zip(now, before, strict=False)):
        assert same(a, b), f"{' '.join(now[max(0, k - 12) : k + 3])} | before: {' '.join(before[k : k + 3])}"
    assert len(now) == len(before)


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for file, write in WRITERS.items():
        (FOLDER / file).write_text(write(EVERYTHING), encoding="utf-8")
