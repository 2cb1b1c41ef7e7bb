"""XML as text: elements indented, attributes quoted, numbers with all their digits."""

from __future__ import annotations

from collections.abc import Iterable
from xml.sax.saxutils import escape, quoteattr


class XmlText:
    """Lines of an XML text, element by element."""

    def __init__(self, comment: str = "") -> None:
        self.lines = ['<?xml version="1.0"?>']
        if comment:
            self.lines.append(f"<!-- {comment.replace('--', '- -')} -->")
        self.depth = 0
        self.open: list[str] = []

    def add(self, tag: str, text: str = "", /, **attributes: object) -> None:
        """An element without parts; an attribute None is left out, and class_ is class."""
        head = self._head(tag, attributes)
        self._line(f"<{head}>{escape(text)}</{tag}>" if text else f"<{head}/>")

    def begin(self, tag: str, **attributes: object) -> None:
        """An element whose parts follow up to `end`."""
        self._line(f"<{self._head(tag, attributes)}>")
        self.open.append(tag)
        self.depth += 1

    def end(self) -> None:
        """The end of the last element that began."""
        self.depth -= 1
        self._line(f"</{self.open.pop()}>")

    def _head(self, tag: str, attributes: dict[str, object]) -> str:
        shown = (f"{k.rstrip('_')}={quoteattr(str(v))}" for k, v in attributes.items() if v is not None)
        return " ".join([tag, *shown])

    def _line(self, text: str) -> None:
        self.lines.append("  " * self.depth + text)

    def __str__(self) -> str:
        return "\n".join(self.lines) + "\n"


def digits(numbers: float | Iterable[float]) -> str:
    """Numbers with all their digits, separated by spaces.

    >>> digits([0.1, 2.0])
    '0.1 2.0'
    """
    values = [numbers] if isinstance(numbers, (int, float)) else list(numbers)
    return " ".join(repr(float(x) + 0.0) for x in values)
