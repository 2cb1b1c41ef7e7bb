"""Position of each value of a model file in its text: its line, and the characters that change with it."""

from __future__ import annotations

import json
import re
from bisect import bisect_left
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from dalembert.model.files.source import Lines, Path


@dataclass
class TextSpan:
    """The characters of a value and of its key; `form` is scalar, alias, flow (in brackets) or block (on lines)."""

    start: int
    end: int
    form: str
    key: tuple[int, int] | None = None
    mapping: bool = False


Places = dict[Path, TextSpan]


@lru_cache(maxsize=4)
def places(text: str, form: str) -> Places:
    """Path -> place of every value of a text that has been read without an error; keys in the order of the file.

    Kept for the last texts: not to be changed by its users.
    """
    return {"yaml": _of_yaml, "json": _of_json, "toml": _of_toml}[form](text)


@lru_cache(maxsize=4)
def lines(text: str, form: str) -> Lines:
    """The line of every path of a text that has been read without an error."""
    ends = [match.start() for match in re.finditer("\n", text)]
    numbers: dict[Path, int] = {}
    for path, place in places(text, form).items():
        line = bisect_left(ends, place.key[0] if place.key else place.start) + 1
        for length in range(1, len(path) + 1):
            numbers.setdefault(path[:length], line)
    return numbers


def inside(index: Places, path: Path) -> list[Path]:
    """Values directly inside a mapping or list."""
    return [other for other in index if len(other) == len(path) + 1 and other[: len(path)] == path]


class _Stack:
    """The open mappings and lists, and where the next value goes."""

    def __init__(self) -> None:
        self.found: Places = {}
        self.open: list[tuple[Path, bool]] = []
        self.next: list[Any] = []
        self.keys: list[tuple[int, int] | None] = []
        self.last = 0

    @property
    def wants_key(self) -> bool:
        return bool(self.open) and self.open[-1][1] and self.keys[-1] is None

    def key(self, name: str, start: int, end: int) -> None:
        self.next[-1], self.keys[-1] = name, (start, end)

    def value(self, place: TextSpan) -> Path:
        path: Path = (*self.open[-1][0], self.next[-1]) if self.open else ()
        if self.open:
            place.key, self.keys[-1] = self.keys[-1], None
            if not self.open[-1][1]:
                self.next[-1] += 1
        self.found[path], self.last = place, place.end
        return path

    def begin(self, place: TextSpan) -> None:
        self.open.append((self.value(place), place.mapping))
        self.next.append(0)
        self.keys.append(None)

    def finish(self, end: int) -> None:
        path, _ = self.open.pop()
        self.next.pop()
        self.keys.pop()
        place = self.found[path]
        place.end = self.last = max(self.last, place.start) if place.form == "block" else end


_PROPERTIES = re.compile(r"(?:&[^\s,\[\]{}]+\s+)?")


def _of_yaml(text: str) -> Places:
    from ruamel.yaml import YAML

    stack = _Stack()
    for event in YAML(typ="safe", pure=True).parse(text):
        kind = type(event).__name__
        if kind in ("MappingEndEvent", "SequenceEndEvent"):
            stack.finish(event.end_mark.index)
        elif kind in ("ScalarEvent", "AliasEvent", "MappingStartEvent", "SequenceStartEvent"):
            start, end = event.start_mark.index, event.end_mark.index
            if kind == "ScalarEvent" and stack.wants_key:
                stack.key(event.value, start, end)
                continue
            if kind != "AliasEvent" and event.anchor:
                match = _PROPERTIES.match(text, start)
                start = match.end() if match else start
            if kind in ("ScalarEvent", "AliasEvent"):
                stack.value(TextSpan(start, max(start, end), "alias" if kind == "AliasEvent" else "scalar"))
            else:
                form = "flow" if event.flow_style else "block"
                stack.begin(TextSpan(start, end, form, mapping=kind == "MappingStartEvent"))
    return stack.found


_JSON = re.compile(r'"(?:[^"\\\n]|\\.)*"|[][{},:]|[^][{},:"\s]+')


def _of_json(text: str) -> Places:
    stack = _Stack()
    for match in _JSON.finditer(text):
        token = match[0]
        if token in "[{":
            stack.begin(TextSpan(match.start(), match.end(), "flow", mapping=token == "{"))
        elif token in "]}":
            stack.finish(match.end())
        elif token in ",:":
            continue
        elif stack.wants_key:
            stack.key(json.loads(token), *match.span())
        else:
            stack.value(TextSpan(*match.span(), "scalar"))
    return stack.found


_SPACE = re.compile(r"(?:[ \t\r\n]+|#[^\n]*)*")
_BARE = r"[A-Za-z0-9_-]+"
_TEXT = r'"""[\s\S]*?"""+|\'\'\'[\s\S]*?\'\'\'+|"(?:[^"\\\n]|\\.)*"|\'[^\'\n]*\''
_SCALAR = re.compile(rf"{_TEXT}|\d{{4}}-\d\d-\d\d \d\d:[^\s,\]}}#]+|[^\s,\]}}#]+")
_KEY = re.compile(rf"({_BARE}|{_TEXT})(?:[ \t]*\.[ \t]*({_BARE}|{_TEXT}))*")


class _Toml:
    """A walk over a text that is known to be TOML."""

    def __init__(self, text: str) -> None:
        self.text, self.at = text, 0
        self.found: Places = {(): TextSpan(0, 0, "block", mapping=True)}
        self.counts: dict[Path, int] = {}

    def space(self) -> None:
        match = _SPACE.match(self.text, self.at)
        self.at = match.end() if match else self.at

    def key(self) -> tuple[Path, tuple[int, int]]:
        match = _KEY.match(self.text, self.at)
        assert match is not None
        self.at = match.end()
        parts = re.findall(rf"{_BARE}|{_TEXT}", match[0])
        return tuple(_toml_text(part) for part in parts), match.span()

    def pair(self, table: Path) -> None:
        name, span = self.key()
        self.space()
        self.at += 1
        self.space()
        path = table
        for part in name[:-1]:
            path = (*path, part)
            self.found.setdefault(path, TextSpan(span[0], span[1], "dotted"))
        self.value((*path, name[-1]), span)

    def value(self, path: Path, key: tuple[int, int] | None = None) -> None:
        start, first = self.at, self.text[self.at]
        if first not in "[{":
            match = _SCALAR.match(self.text, self.at)
            assert match is not None
            self.at = match.end()
            self.found[path] = TextSpan(start, self.at, "scalar", key)
            return
        place = self.found[path] = TextSpan(start, start, "flow", key, first == "{")
        self.at += 1
        index = 0
        while True:
            self.space()
            if self.text[self.at] in "]}":
                break
            if self.text[self.at] == ",":
                self.at += 1
            elif first == "{":
                self.pair(path)
            else:
                self.value((*path, index))
                index += 1
        self.at += 1
        place.end = self.at

    def header(self) -> Path:
        start, several = self.at, self.text.startswith("[[", self.at)
        self.at += 1 + several
        self.space()
        path = self.key()[0]
        self.at = self.text.index("]", self.at) + 1 + several
        if several:
            self.counts[path] = self.counts.get(path, -1) + 1
            path = (*path, self.counts[path])
        self.found[path] = TextSpan(start, self.at, "block", mapping=True)
        return path

    def read(self) -> Places:
        table: Path = ()
        self.space()
        while self.at < len(self.text):
            if self.text[self.at] == "[":
                table = self.header()
            else:
                self.pair(table)
                self.found[table].end = self.at
            self.space()
        return self.found


def _toml_text(part: str) -> str:
    if part[0] not in "\"'":
        return part
    import tomllib

    value: str = tomllib.loads(f"x = {part}")["x"]
    return value


def _of_toml(text: str) -> Places:
    return _Toml(text).read()
