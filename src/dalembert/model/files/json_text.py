"""JSON to a tree."""

from __future__ import annotations

import json
import re

from dalembert.model.files.yaml_text import DEEPEST, at_line
from dalembert.wording import quote_value


def read(text: str) -> object:
    """The tree, None of an empty text; raises ModelError with its `line`."""
    if not text.strip():
        return None
    _check_tokens(text)
    try:
        return json.loads(text, object_pairs_hook=_object, parse_int=_number)
    except json.JSONDecodeError as error:
        what = f"it is not JSON here: {error.msg.lower()}"
        raise at_line(what, "check commas, quotes and brackets", error.lineno) from None
    except _TwiceError as twice:
        line = _second(text, str(twice))
        problem = f"the key {quote_value(str(twice))} occurs twice"
        raise at_line(problem, "leave one of them out", line) from None


class _TwiceError(ValueError):
    """A key that an object has twice."""


def _object(pairs: list[tuple[str, object]]) -> dict[str, object]:
    tree: dict[str, object] = {}
    for key, value in pairs:
        if key in tree:
            raise _TwiceError(key)
        tree[key] = value
    return tree


def _number(digits: str) -> int | float:
    return int(digits) if len(digits) < 19 else float(digits)


_TOKEN = re.compile(r'"(?:[^"\\\n]|\\.)*"|[][{},:]|[^][{},:"\s]+|\n')


def _check_tokens(text: str) -> None:
    depth, line = 0, 1
    for match in _TOKEN.finditer(text):
        token = match[0]
        depth += (token in "[{") - (token in "]}")
        line += token == "\n"
        if token in ("NaN", "Infinity", "-Infinity"):
            raise at_line(f"{token} is not a JSON number", "write a finite number", line)
        if depth > DEEPEST:
            what = f"the file is nested deeper than {DEEPEST} levels"
            raise at_line(what, "a model file needs 6 or so", line)


def _second(text: str, key: str) -> int:
    """The line where a key comes a second time within one object, or the first time at all."""
    seen: set[tuple[int, str]] = set()
    stack: list[int] = []
    line = fresh = 0
    previous = ""
    for match in _TOKEN.finditer(text):
        token = match[0]
        if token == "\n":
            line += 1
            continue
        if token in "[{":
            fresh += 1
            stack.append(fresh)
        elif token in "]}":
            stack.pop()
        elif token == ":" and json.loads(previous) == key:
            if (stack[-1], key) in seen:
                return line + 1
            seen.add((stack[-1], key))
        previous = token
    return 1
