"""A tree as YAML: one line for each link, joint, drive and load where it fits."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

from dalembert.model.files.yaml_text import scalar

WIDTH = 110
_PLAIN = re.compile(r"[^\W\d_][\w./*^() +@-]*|[-+]?\.?[0-9][\w./*^() +@-]*")


def to_yaml(tree: Mapping[str, object]) -> str:
    """The tree as YAML text that reads back equal."""
    return "".join(line + "\n" for key, value in tree.items() for line in _entry(word(key), value, 0))


def _entry(head: str, value: object, indent: int) -> list[str]:
    """The lines of `head: value`; a mapping at the top level is always opened up."""
    space = " " * indent
    on_one_line = flow(value)
    short = len(space) + len(head) + 2 + len(on_one_line) <= WIDTH
    if (
        not isinstance(value, (Mapping, list, tuple))
        or not value
        or (short and not _open_value(value, indent))
    ):
        return [f"{space}{head}: {on_one_line}"]
    lines = [f"{space}{head}:"]
    if isinstance(value, Mapping):
        return lines + [line for key, item in value.items() for line in _entry(word(key), item, indent + 2)]
    if any(isinstance(item, (Mapping, list, tuple)) for item in value):
        return lines + [f"{space}  - {flow(item)}" for item in value]
    return [f"{space}{head}: {on_one_line}"]


def _open_value(value: Mapping[str, object] | Iterable[object], indent: int) -> bool:
    inner = value.values() if isinstance(value, Mapping) else value
    return indent == 0 and any(isinstance(item, (Mapping, list, tuple)) for item in inner)


def flow(value: object) -> str:
    """A value on one line."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{word(key)}: {flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, Sequence) and not isinstance(value, str):
        return "[" + ", ".join(flow(item) for item in value) + "]"
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    return word(value) if isinstance(value, str) else repr(value)


def word(text: str) -> str:
    """A text, in quotes where YAML would read something else."""
    plain = _PLAIN.fullmatch(text) and scalar(text) == text and not text.endswith(" ")
    return text if plain else _quote(text)


def _quote(text: str) -> str:
    import json

    return re.sub(
        r"[\x7f-\x9f\u2028\u2029\ufeff\ufffe\uffff\ud800-\udfff]",
        _escape,
        json.dumps(text, ensure_ascii=False),
    )


def _escape(match: re.Match[str]) -> str:
    return f"\\u{ord(match[0]):04x}"
