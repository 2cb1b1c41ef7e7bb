"""XML of other programs: elements with their lines; no entities, no document types, nothing fetched, sizes bounded."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.parsers import expat

from dalembert.errors import ModelError

LARGEST = 5_000_000
"""Bytes of a file."""

DEEPEST = 200
"""Elements inside one another."""

MOST = 100_000
"""Elements of a file."""


@dataclass
class Element:
    """An element: its tag, attributes, text, parts and line."""

    tag: str
    attributes: dict[str, str]
    line: int
    file: str
    text: str = ""
    parts: list[Element] = field(default_factory=list)

    def all(self, *tags: str) -> Iterator[Element]:
        """Its direct parts with one of these tags."""
        return (part for part in self.parts if part.tag in tags)

    def first(self, tag: str) -> Element | None:
        """Its first part with a tag."""
        return next(self.all(tag), None)

    def walk(self) -> Iterator[Element]:
        """Itself and all that is in it."""
        yield self
        for part in self.parts:
            yield from part.walk()

    def get(self, key: str, default: str = "") -> str:
        """An attribute."""
        return self.attributes.get(key, default)

    def error(self, what: str, remedy: str) -> ModelError:
        """A message at its line."""
        return ModelError(what, remedy, (), self.file, self.line)

    def numbers(self, text: str, count: int | tuple[int, ...] = 0, what: str = "") -> list[float]:
        """Numbers separated by spaces; raises ModelError for anything else, or another count."""
        what = what or self.tag
        if len(text) > 10_000:
            raise self.error(f"{what} has too many numbers", "give a shorter list")
        try:
            values = [float(word) for word in text.split()]
        except ValueError:
            raise self.error(
                f"{what}: {text.strip()[:60]!r} is not a list of numbers", "write numbers"
            ) from None
        counts = (count,) if isinstance(count, int) else count
        if any(not abs(x) <= 1e60 for x in values):
            raise self.error(f"{what}: {text.strip()[:60]!r} is not finite", "write finite numbers")
        if count and len(values) not in counts:
            wanted = " or ".join(map(str, counts))
            raise self.error(f"{what} has {len(values)} numbers", f"give {wanted}")
        return values

    def vector(self, key: str, count: int, default: list[float] | None = None) -> list[float]:
        """An attribute of several numbers."""
        if key not in self.attributes:
            if default is None:
                raise self.error(f"<{self.tag}> has no {key}", f"give {key}")
            return default
        return self.numbers(self.attributes[key], count, f"{key} of <{self.tag}>")

    def number(self, key: str, default: float | None = None) -> float:
        """An attribute of one number."""
        return self.vector(key, 1, None if default is None else [default])[0]


_COMMENT = re.compile(rb"<!--.*?-->", re.DOTALL)


def _blank(comment: re.Match[bytes]) -> bytes:
    """The lines of a comment: other programs read drawings of hyphens, which XML does not allow in it."""
    return b"\n" * comment[0].count(b"\n")


def parse(content: bytes, file: str) -> Element:
    """The root of an XML text; raises ModelError for what is not XML, or declares a document type or entities."""
    if len(content) > LARGEST:
        raise ModelError(f"the file has more than {LARGEST} bytes", "leave meshes out", (), file, 1)
    root = Element("", {}, 1, file)
    stack, count = [root], 0
    parser = expat.ParserCreate()

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal count
        count += 1
        line = parser.CurrentLineNumber
        if len(stack) > DEEPEST or count > MOST:
            raise ModelError("the file has too many elements", "split it", (), file, line)
        element = Element(tag, attributes, line, file)
        stack[-1].parts.append(element)
        stack.append(element)

    def end(_: str) -> None:
        stack.pop()

    def text(more: str) -> None:
        stack[-1].text += more

    def refuse(*_: object) -> None:
        what = "the file declares a document type or an entity"
        raise ModelError(what, "leave <!DOCTYPE> out", (), file, parser.CurrentLineNumber)

    parser.StartElementHandler, parser.EndElementHandler, parser.CharacterDataHandler = start, end, text
    parser.StartDoctypeDeclHandler = parser.EntityDeclHandler = refuse
    parser.buffer_text = True
    try:
        parser.Parse(_COMMENT.sub(_blank, content), True)
    except expat.ExpatError as error:
        words = expat.ErrorString(error.code)
        raise ModelError(f"the file is not XML: {words}", "save it again", (), file, error.lineno) from None
    return root.parts[0]
