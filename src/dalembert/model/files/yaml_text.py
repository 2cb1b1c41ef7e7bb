"""YAML 1.2 to a tree of mappings, lists, texts and numbers, with the line of each; nothing else is built.

The events of ruamel's parser are taken one by one, so that depth and size are bounded before anything is stored,
keys are texts, equal keys are refused, and tags and second documents never come in.
"""

from __future__ import annotations

import re
from copy import deepcopy
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from dalembert.errors import ModelError
from dalembert.model.files.source import Path
from dalembert.wording import quote_value

if TYPE_CHECKING:
    from ruamel.yaml.error import MarkedYAMLError, StreamMark
    from ruamel.yaml.events import CollectionStartEvent, ScalarEvent

DEEPEST, MOST = 30, 50_000
"""Levels of nesting and values of one file."""

SHORT, KEPT = 20_000, 64
"""Characters of a text whose tree is kept, as of a template that is solved again and again, and how many are."""

MERGE = "<<"
"""The key that takes in another mapping."""

_WORDS: dict[str, object] = {"": None, "~": None, "null": None, "Null": None, "NULL": None}
_WORDS |= {
    word: value for value in (True, False) for word in (str(value), str(value).lower(), str(value).upper())
}
_INTEGER = re.compile(r"[-+]?[0-9]{1,18}")
_BASED = re.compile(r"0o[0-7]{1,20}|0x[0-9a-fA-F]{1,16}")
_FLOAT = re.compile(
    r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)"
)


def read(text: str) -> tuple[object, dict[Path, int]]:
    """The tree and the line of each path; raises ModelError with its `line`. Short texts are parsed once."""
    if len(text) > SHORT:
        return _parse(text)
    root, lines = _parsed(text)
    return deepcopy(root), lines


def _parse(text: str) -> tuple[object, dict[Path, int]]:
    from ruamel.yaml import YAML
    from ruamel.yaml.error import MarkedYAMLError, YAMLError

    _check_properties(text)
    builder = _TreeBuilder()
    try:
        for event in YAML(typ="safe", pure=True).parse(text):
            builder.take(event)
    except MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        what, line = f"this is not valid YAML: {_problem(error)}", mark.line + 1 if mark else 1
        raise at_line(what, _advice(text, mark), line) from None
    except (YAMLError, ValueError, IndexError, AssertionError, RecursionError, OverflowError) as error:
        if isinstance(error, ModelError):
            raise
        message = str(error).split("\n")[0]
        raise at_line(f"it is not YAML: {message}", "check its characters and brackets", 1) from None
    return builder.root, builder.lines


_parsed = lru_cache(KEPT)(_parse)
_LONG = re.compile(r"[!&*%][^\s,\[\]{}]{2000}")


def _check_properties(text: str) -> None:
    """Refuse long tags, anchors and directives, over which the parser takes its time."""
    match = _LONG.search(text)
    if match:
        line = text.count("\n", 0, match.start()) + 1
        what = f"{quote_value(match[0])} is longer than any word of a model file"
        raise at_line(what, "put text in quotes", line)


def _problem(error: MarkedYAMLError) -> str:
    message = " ".join(str(error.problem or error.context).split())
    begun, problem = error.context_mark, error.problem_mark
    if begun is not None and problem is not None and begun.line != problem.line:
        return f"{message}, {error.context} that begins in line {begun.line + 1}"
    return message


def at_line(what: str, remedy: str, line: int) -> ModelError:
    """An error whose line is known before there is a tree."""
    return ModelError(what, remedy, (), "", line)


def _advice(text: str, mark: StreamMark | None) -> str:
    lines = text.split("\n")
    line = lines[mark.line] if mark and mark.line < len(lines) else ""
    if "\t" in line[: len(line) - len(line.lstrip())]:
        return "indent with spaces, not with tabs"
    return "check indentation, brackets and colons, and put text with ': ' or '#' in quotes"


class _TreeBuilder:
    """Stacks the open mappings and lists; `line` is that of the event at hand."""

    def __init__(self) -> None:
        self.root: object = None
        self.lines: dict[Path, int] = {}
        self.anchors: dict[str, tuple[object, int]] = {}
        self.stack: list[_Open] = []
        self.size = self.documents = self.line = 0

    def error(self, what: str, remedy: str) -> ModelError:
        return at_line(what, remedy, self.line)

    def take(self, event: Any) -> None:
        kind = type(event).__name__
        self.line = event.start_mark.line + 1 if event.start_mark else 1
        self.size += 1
        if self.size > MOST:
            what = f"the file has more than {MOST} values"
            raise self.error(what, "give large tables fewer points, or write the file as JSON")
        if (tag := getattr(event, "tag", None)) is not None:
            raise self.error(f"a tag {quote_value(str(tag))} has no place in a model file", "leave it out")
        if kind == "DocumentStartEvent":
            self.document()
        elif kind == "ScalarEvent":
            self.scalar(event)
        elif kind == "AliasEvent":
            self.alias(event.anchor)
        elif kind in ("MappingStartEvent", "SequenceStartEvent"):
            self.open_node(event, {} if kind == "MappingStartEvent" else [])
        elif kind in ("MappingEndEvent", "SequenceEndEvent"):
            self.close_node()

    @property
    def wants_key(self) -> bool:
        return bool(self.stack) and self.stack[-1].wants_key

    def document(self) -> None:
        self.documents += 1
        if self.documents > 1:
            remedy = "keep one mechanism in a file: leave out the line ---"
            raise self.error("a second document begins", remedy)

    def scalar(self, event: ScalarEvent) -> None:
        if self.wants_key:
            self.stack[-1].merges |= event.value == MERGE and event.implicit[0]
            self.key(event.value)
            return
        value = scalar(event.value) if event.implicit[0] else event.value
        self.add(value)
        self.add_anchor(event.anchor, value, 1)

    def key(self, key: str) -> None:
        top = self.stack[-1]
        if key in top.value:
            first = self.lines.get((*top.path, key), self.line)
            what = f"the key {quote_value(key)} occurs twice, first on line {first}"
            raise self.error(what, "leave one of them out")
        top.key, top.wants_key = key, False
        self.lines[(*top.path, key)] = self.line

    def open_node(self, event: CollectionStartEvent, value: dict[str, object] | list[object]) -> None:
        if self.wants_key:
            raise self.error("a list or mapping cannot be a key", "write key: value")
        if len(self.stack) >= DEEPEST:
            what = f"the file is nested deeper than {DEEPEST} levels"
            raise self.error(what, "a model file needs 6 or so")
        path = self.add(value)
        self.stack.append(_Open(value, path, event.anchor, self.size))

    def close_node(self) -> None:
        top = self.stack.pop()
        if top.merges:
            self.merge(top)
        self.add_anchor(top.anchor, top.value, self.size - top.start)

    def merge(self, top: _Open) -> None:
        """Merges the mappings that `<<: *name` names; keys of the mapping itself, and earlier ones, take precedence."""
        sources = top.value.pop(MERGE)
        line = self.line = self.lines.pop((*top.path, MERGE))
        merged: dict[str, object] = {}
        for other in reversed(sources if isinstance(sources, list) else [sources]):
            if not isinstance(other, dict):
                what = f"{quote_value(other)} cannot be merged: {MERGE} needs a mapping"
                raise self.error(what, f"write {MERGE}: *name, after &name {{...}}")
            merged |= other
        before = dict(top.value)
        top.value.clear()
        top.value.update(merged | before)
        self.lines |= {(*top.path, key): line for key in merged if key not in before}

    def add_anchor(self, anchor: str | None, value: object, size: int) -> None:
        if anchor:
            self.anchors[anchor] = value, size

    def alias(self, anchor: str) -> None:
        if anchor not in self.anchors:
            remedy = f"write &{anchor} before a complete value"
            raise self.error(f"unknown anchor {quote_value(anchor)}", remedy)
        if self.wants_key:
            raise self.error("an alias cannot be a key", "write the key")
        value, size = self.anchors[anchor]
        self.size += size
        self.add(value)

    def add(self, value: object) -> Path:
        if not self.stack:
            self.root = value
            return ()
        top = self.stack[-1]
        if isinstance(top.value, list):
            path = (*top.path, len(top.value))
            self.lines[path] = self.line
            top.value.append(value)
        else:
            path = (*top.path, top.key)
            top.value[top.key], top.wants_key = value, True
        return path


class _Open:
    """A mapping or list that is not closed yet."""

    def __init__(self, value: Any, path: Path, anchor: str | None, start: int) -> None:
        self.value, self.path, self.anchor, self.start = value, path, anchor, start
        self.key, self.wants_key, self.merges = "", isinstance(value, dict), False


def scalar(text: str) -> object:
    """The value of a plain scalar by the core schema of YAML 1.2: `1e-3` is a number, `on` is text.

    >>> scalar("1e-3"), scalar("on"), scalar("true")
    (0.001, 'on', True)
    """
    if text in _WORDS:
        return _WORDS[text]
    if _INTEGER.fullmatch(text):
        return int(text)
    if _BASED.fullmatch(text):
        return int(text, 0)
    if _FLOAT.fullmatch(text):
        return float(re.sub(r"\.(?=[a-zA-Z])", "", text))
    return text
