"""TOML to a tree, with the line of each path as far as headers and keys at the beginning of a line tell."""

from __future__ import annotations

import re
import tomllib

from dalembert.arrays import Tree
from dalembert.model.files.source import Path
from dalembert.model.files.yaml_text import DEEPEST, at_line


def read(text: str) -> Tree:
    """The tree; raises ModelError with its `line`."""
    for number, line in enumerate(text.split("\n")):
        if line.count("[") + line.count("{") + line.count(".") > 1000 and re.search(
            r"([\[{]\s*|\.\w*){40}", line
        ):
            raise at_line(
                f"the file is nested deeper than {DEEPEST} levels", "a model file needs 6 or so", number + 1
            )
    try:
        return tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        said = str(error)
        match = re.search(r"\(at line (\d+), column \d+\)", said)
        problem = re.sub(r" \(at .*\)", "", said).lower()
        line_number = int(match[1]) if match else text.count("\n") + 1
        raise at_line(
            f"it is not TOML here: {problem}", "check quotes, commas and brackets", line_number
        ) from None


_PART = r'(?:[A-Za-z0-9_-]+|"[^"\n]*"|\'[^\'\n]*\')'
_KEY = rf"{_PART}(?:\s*\.\s*{_PART})*"
_HEADER = re.compile(rf"\s*(\[\[?)\s*({_KEY})\s*\]")
_ASSIGNED = re.compile(rf"\s*({_KEY})\s*=")
_INNER = re.compile(rf"[{{,]\s*({_PART})\s*=")


def lines(text: str) -> dict[Path, int]:
    """The line of each path of a text that is TOML."""
    found: dict[Path, int] = {}
    table: Path = ()
    counts: dict[Path, int] = {}
    for number, line in enumerate(text.split("\n"), 1):
        if header := _HEADER.match(line):
            table = _split(header[2])
            if header[1] == "[[":
                counts[table] = counts.get(table, -1) + 1
                table = (*table, counts[table])
            _note(found, table, number)
        elif assigned := _ASSIGNED.match(line):
            path = table + _split(assigned[1])
            _note(found, path, number)
            for inner in _INNER.finditer(line, assigned.end()):
                found.setdefault(path + _split(inner[1]), number)
    return found


def _note(found: dict[Path, int], path: Path, line: int) -> None:
    for length in range(1, len(path) + 1):
        found.setdefault(path[:length], line)


def _split(key: str) -> Path:
    return tuple(part.strip("\"'") for part in re.findall(_PART, key))
