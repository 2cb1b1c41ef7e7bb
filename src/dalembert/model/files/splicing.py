"""Changes values of a model file's text, each in its place; all other characters are kept."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from dalembert.model.files.places import Places, inside, places
from dalembert.model.files.source import Path


class Removed:
    """A value that is taken out, with its key."""


REMOVED = Removed()


class Renamed(NamedTuple):
    """Another key, and its value, in the place of a key."""

    key: str
    value: object


class Change(NamedTuple):
    """Characters that replace those from `start` to `end`."""

    start: int
    end: int
    text: str


def splice(text: str, form: str, values: Mapping[Path, object]) -> str:
    """The text with values of its tree replaced, added or (REMOVED) taken out; those that overlap one by one."""
    waiting = dict(values)
    while waiting:
        changes, waiting = _round(text, form, waiting)
        text = with_changes(text, changes)
    return text


def with_changes(text: str, changes: Iterable[Change]) -> str:
    """The text with some changes that do not overlap."""
    for change in sorted(changes, reverse=True):
        text = text[: change.start] + change.text + text[change.end :]
    return text


def changes_at_once(text: str, form: str, values: Mapping[Path, object]) -> list[Change] | None:
    """The changes of a splice in the order of the text; None where they overlap."""
    changes, later = _round(text, form, values)
    return None if later else sorted(changes)


def _round(text: str, form: str, values: Mapping[Path, object]) -> tuple[list[Change], dict[Path, object]]:
    """Changes that do not overlap, and the values that are left."""
    index, changes, later = places(text, form), list[Change](), dict[Path, object]()
    for path, value in values.items():
        change = _change(text, form, index, path, value)
        if change is None:
            continue
        if any((change.start < c.end and c.start < change.end) or change.start == c.start for c in changes):
            later[path] = value
        else:
            changes.append(change)
    return changes, later


def _change(text: str, form: str, index: Places, path: Path, value: object) -> Change | None:
    place = index.get(path)
    if value is REMOVED:
        return _removal(text, index, path) if place else None
    if isinstance(value, Renamed):
        assert place is not None
        assert place.key is not None
        return Change(place.key[0], place.end, _pair(value.key, value.value, form))
    if place is None:
        return _addition(text, form, index, path, value)
    if place.form in ("block", "dotted"):
        return _block(text, form, index, path, value)
    return Change(place.start, place.end, value_text(value, form, text[place.start : place.end]))


def value_text(value: object, form: str, old: str = "") -> str:
    """A value as the format writes it on one line; a text keeps the quotes that the old one stood in."""
    if form == "json":
        return json.dumps(value, ensure_ascii=False)
    if form == "yaml":
        from dalembert.model.files.yaml_writing import flow

        plain = isinstance(value, str) and not re.search(r"[\\\"'\n]", value)
        return f"{old[0]}{value}{old[0]}" if plain and old[:1] in ("'", '"') else flow(value)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_toml_key(k)} = {value_text(v, form)}" for k, v in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(value_text(item, form) for item in value) + "]"
    if isinstance(value, str):
        plain = not re.search(r"[\\'\n]", value)
        return f"'{value}'" if plain and old[:1] == "'" else json.dumps(value, ensure_ascii=False)
    return json.dumps(value)


def _toml_key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key, ensure_ascii=False)


def _pair(key: object, value: object, form: str) -> str:
    if form == "toml":
        return f"{_toml_key(str(key))} = {value_text(value, form)}"
    if form == "json":
        return f"{json.dumps(key, ensure_ascii=False)}: {value_text(value, form)}"
    from dalembert.model.files.yaml_writing import word

    return f"{word(str(key))}: {value_text(value, form)}"


def _removal(text: str, index: Places, path: Path) -> Change:
    """A key and its value out: with a comma in brackets, with its line otherwise."""
    place, siblings = index[path], inside(index, path[:-1])
    start = place.key[0] if place.key else place.start
    at = siblings.index(path)
    if index[path[:-1]].form == "flow":
        if at > 0:
            return Change(index[siblings[at - 1]].end, place.end, "")
        after = index[siblings[1]] if len(siblings) > 1 else None
        return Change(start, (after.key[0] if after.key else after.start) if after else place.end, "")
    line, end = text.rfind("\n", 0, start) + 1, text.find("\n", place.end)
    return Change(line, len(text) if end < 0 else end + 1, "")


def _addition(text: str, form: str, index: Places, path: Path, value: object) -> Change:
    """A new key at the end of the mapping it belongs to; what is between that and the value is added too."""
    depth = len(path) - 1
    while path[:depth] not in index or not (
        index[path[:depth]].mapping or index[path[:depth]].form == "alias"
    ):
        depth -= 1
    if form == "toml" and depth < len(path) - 1 and any(p[: depth + 1] == path[: depth + 1] for p in index):
        header = ".".join(_toml_key(str(key)) for key in path[:-1])  # a table that others lie within
        return Change(len(text), len(text), f"\n[{header}]\n{_pair(path[-1], value, form)}\n")
    for key in reversed(path[depth + 1 :]):
        value = {key: value}
    place, siblings = index[path[:depth]], inside(index, path[:depth])
    pair = _pair(path[depth], value, form)
    if place.form == "alias":
        return Change(place.start, place.end, "{<<: " + text[place.start : place.end] + f", {pair}}}")
    if place.form == "flow":
        at = index[siblings[-1]].end if siblings else place.start + 1
        return Change(at, at, f", {pair}" if siblings else pair)
    if form == "toml":
        return _new_line(text, place.end, "", pair)
    first = index[siblings[0]].key
    assert first is not None
    return _new_line(text, place.end, " " * (first[0] - text.rfind("\n", 0, first[0]) - 1), pair)


def _new_line(text: str, behind: int, indent: str, pair: str) -> Change:
    line_end = "\r\n" if "\r\n" in text else "\n"
    at = text.find("\n", behind)
    at = len(text) if at < 0 else at - (text[at - 1] == "\r")
    return Change(at, at, f"{line_end}{indent}{pair}")


def _block(text: str, form: str, index: Places, path: Path, value: object) -> Change:
    """Replaces a block on separate lines by one value behind its key."""
    place = index[path]
    assert place.key is not None, path
    colon = text.index(":", place.key[1])
    return Change(colon + 1, place.end, " " + value_text(value, form))
