"""A report as data: text, formulas, tables, matrices, drawings; writers make PDF, HTML, LaTeX or text of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from dalembert.views.paper.scene import Scene


@dataclass(frozen=True)
class Heading:
    """A heading of level 1 or 2; with ``room`` a third of a page stays free below it to write in, at least."""

    text: str
    level: int = 1
    room: bool = False


@dataclass(frozen=True)
class Paragraph:
    """Words; formulas between dollar signs."""

    text: str


@dataclass(frozen=True)
class Working:
    """An equation three times: in letters, with numbers, its result; empty ones are left out."""

    letters: str
    numbers: str = ""
    result: str = ""


@dataclass(frozen=True)
class Equations:
    """Equations one under the other."""

    lines: tuple[Working, ...]


@dataclass(frozen=True)
class SheetTable:
    """Columns under their heads; cells may hold formulas between dollar signs. ``total`` sets the last row apart;
    ``words``: all columns begin at the left, however many there are."""

    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    caption: str = ""
    total: bool = False
    words: bool = False


@dataclass(frozen=True)
class PageBreak:
    """Page break before what follows."""


@dataclass(frozen=True)
class Matrix:
    """A x = b with the unknowns' signs and their values, under some words."""

    rows: tuple[tuple[str, ...], ...]
    unknowns: tuple[str, ...]
    right: tuple[str, ...]
    values: tuple[str, ...]
    caption: str = ""


@dataclass(frozen=True)
class Drawings:
    """Drawings side by side; with ``columns`` those without scales are made smaller until that many fit."""

    scenes: tuple[Scene, ...]
    caption: str = ""
    columns: int = 1


@dataclass(frozen=True)
class Beside:
    """Paragraphs and equations with a drawing beside them, where the page is wide enough; else below it."""

    scene: Scene
    texts: tuple[Paragraph | Equations, ...]


@dataclass(frozen=True)
class Blanks:
    """Lines to be filled in: words, then for each number its name, room to write, and its unit."""

    rows: tuple[tuple[str, tuple[tuple[str, str], ...]], ...]


Text = Paragraph | Equations
Block = Heading | Paragraph | Equations | SheetTable | Matrix | Drawings | Beside | Blanks | PageBreak


@dataclass
class ReportSheet:
    """Title, source and blocks in order."""

    title: str
    source: str = ""
    subtitle: str = ""
    blocks: list[Block] = field(default_factory=list)

    def heading(self, text: str, level: int = 1, room: bool = False) -> None:
        """A heading."""
        self.blocks.append(Heading(text, level, room))

    def text(self, text: str) -> None:
        """A paragraph, if there is something to say."""
        if text:
            self.blocks.append(Paragraph(text))

    def equations(self, lines: Sequence[Working]) -> None:
        """Equations, if there are some."""
        if lines:
            self.blocks.append(Equations(tuple(lines)))

    def table(
        self,
        heads: Sequence[str],
        rows: Sequence[Sequence[str]],
        caption: str = "",
        total: bool = False,
        words: bool = False,
    ) -> None:
        """A table, if it has rows."""
        if rows:
            self.blocks.append(
                SheetTable(tuple(heads), tuple(tuple(row) for row in rows), caption, total, words)
            )

    def figure(self, *scenes: Scene, caption: str = "") -> None:
        """Drawings side by side."""
        if scenes:
            self.blocks.append(Drawings(scenes, caption))

    def beside(self, scene: Scene, texts: Sequence[Text]) -> None:
        """Paragraphs and equations with a drawing beside them."""
        self.blocks.append(Beside(scene, tuple(texts)))
