"""Entries of a model file added in the style of their neighbours, and taken out with everything that refers to them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from dalembert.errors import ModelError
from dalembert.model.files.places import Places, inside, places
from dalembert.model.files.source import Path
from dalembert.model.files.splicing import REMOVED, Change, splice, value_text, with_changes
from dalembert.model.files.yaml_writing import word

Entries = Mapping[tuple[str, str], object]
"""Section and name -> value."""


def add_entries(text: str, form: str, entries: Entries) -> str:
    """The text with entries, each on one line behind the last one of its section and aligned as that is.

    >>> print(add_entries("links:\\n  ground:  {}\\n", "yaml", {("links", "rod"): {"mass": 2}}), end="")
    links:
      ground:  {}
      rod:     {mass: 2}
    """
    index, line = places(text, form), _line_end(text)
    for section, name in entries:
        if (section, name) in index:
            raise ModelError(f"the name {name!r} is already used in {section}", "choose another name")
    changes, tail = list[Change](), ""
    for section in dict.fromkeys(section for section, _ in entries):
        values = {name: value for (part, name), value in entries.items() if part == section}
        if form == "yaml" and (section,) not in index:
            added = [f"  {word(name)}: {value_text(value, form)}{line}" for name, value in values.items()]
            tail += f"{line}{section}:{line}" + "".join(added)
            continue
        neighbours = inside(index, (section,)) if (section,) in index else []
        if form != "yaml" or index[(section,)].form != "block" or not neighbours:
            every: dict[Path, object] = {(part, name): value for (part, name), value in entries.items()}
            return splice(text, form, every)
        changes.append(_behind(text, form, index, neighbours, values))
    text = with_changes(text, changes)
    return text if not tail else text + ("" if text.endswith("\n") or not text else line) + tail


def _behind(
    text: str, form: str, index: Places, neighbours: list[Path], values: Mapping[str, object]
) -> Change:
    """Lines behind the last entry of a section."""
    first, last = index[neighbours[0]].key, index[neighbours[-1]]
    assert first is not None
    assert last.key is not None
    indent = text[text.rfind("\n", 0, first[0]) + 1 : first[0]]
    beside = last.form == "flow" and "\n" not in text[last.key[1] : last.start]
    column = last.start - last.key[0] if beside else 0
    lines = [
        indent + f"{word(name)}:".ljust(max(column, len(word(name)) + 2)) + value_text(value, form)
        for name, value in values.items()
    ]
    at = text.find("\n", last.end)
    at = len(text) if at < 0 else at - (text[at - 1] == "\r")
    end = _line_end(text)
    return Change(at, at, end + end.join(lines))


def _line_end(text: str) -> str:
    return "\r\n" if "\r\n" in text else "\n"


def remove(text: str, form: str, tree: Any, kind: str, name: str) -> str:
    """The text without a link, joint, drive or load, and without what needs it: joints of a link, drives and loads of
    a joint, the assembly, answers about them. ``tree``: that of the text."""
    if name not in (tree.get(kind) or {}):
        raise ModelError(f"{kind} has no {name!r}", "choose one that is in the file")
    gone = set(_dependents(tree, kind, name))
    return splice(text, form, _whole_sections(tree, gone))


def _dependents(tree: Any, kind: str, name: str) -> Iterator[Path]:
    yield kind, name
    if kind == "links":
        if name in (tree.get("assembly") or {}):
            yield "assembly", name
        for joint, part in (tree.get("joints") or {}).items():
            if name in (part.get("links") or ()):
                yield from _dependents(tree, "joints", joint)
    if kind == "joints":
        for drive, part in (tree.get("drives") or {}).items():
            if (part or {}).get("joint", drive) == name:
                yield from _dependents(tree, "drives", drive)
    if kind == "drives" and name in (tree.get("start") or {}):
        yield "start", name
    if kind in ("links", "joints"):
        for load, part in (tree.get("loads") or {}).items():
            ends = [part.get("on"), part.get("by"), *(_link(end) for end in part.get("between") or ())]
            if (name in ends) if kind == "links" else part.get("joint") == name:
                yield from _dependents(tree, "loads", load)
        for drive, part in (tree.get("drives") or {}).items():
            cylinder = (part or {}).get("cylinder") or {}
            if kind == "links" and name in [_link(end) for end in cylinder.get("between") or ()]:
                yield from _dependents(tree, "drives", drive)
    for k, answer in enumerate(tree.get("answers") or ()):
        if name in {_link(answer.get(key)) for key in ("of", "on", "by")}:
            yield "answers", k


def _link(end: object) -> str:
    return str(end).split(".")[0]


def _whole_sections(tree: Any, gone: set[Path]) -> dict[Path, object]:
    """Removals; an empty section is removed too."""
    out: dict[Path, object] = {}
    for section in dict.fromkeys(path[0] for path in gone):
        paths = [path for path in gone if path[0] == section]
        if len(paths) == len(tree[section]):
            out[(section,)] = REMOVED
        else:
            out |= dict.fromkeys(sorted(paths, key=str, reverse=True), REMOVED)
    return out
