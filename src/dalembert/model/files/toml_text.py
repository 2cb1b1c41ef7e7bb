"""TOML to a tree."""

from __future__ import annotations

import re
import tomllib

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.files.yaml_text import DEEPEST, at_line


def read(text: str) -> Tree:
    """The tree; raises ModelError with its `line`."""
    lines = text.split("\n")
    for number, line in enumerate(lines, 1):
        if _openings(line) > 1000 and re.search(r"([\[{]\s*|\.\w*){40}", line):
            raise _too_deep(number)
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise _too_deep(1 + max(range(len(lines)), key=lambda k: _openings(lines[k]))) from None
    except tomllib.TOMLDecodeError as error:
        message = str(error)
        match = re.search(r"\(at line (\d+), column \d+\)", message)
        problem = re.sub(r" \(at .*\)", "", message).lower()
        line_number = int(match[1]) if match else text.count("\n") + 1
        words = f"it is not TOML here: {problem}"
        raise at_line(words, "check quotes, commas and brackets", line_number) from None


def _openings(line: str) -> int:
    """Brackets and points of a line, which may each be a level."""
    return line.count("[") + line.count("{") + line.count(".")


def _too_deep(line: int) -> ModelError:
    return at_line(f"the file is nested deeper than {DEEPEST} levels", "a model file needs 6 or so", line)
