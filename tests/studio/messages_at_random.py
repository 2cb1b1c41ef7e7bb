"""Messages to the studio drawn at random: sensible ones, sensible ones with something wrong in them, and rubbish."""

from __future__ import annotations

import json
from random import Random
from typing import Any

from dalembert.studio.document import Document
from tests.studio.gestures_at_random import message as gesture_at_random

WORDS = (
    *("", " ", "a", "ground", "link2", "../../x.yaml", "/etc/passwd", "C:\\x.yaml", "m.yaml", "other.yaml"),
    *(
        "\0",
        "\ud800",
        "\u202e",
        "x" * 300,
        "1e400",
        "nan",
        "2 parsecs",
        "a.b",
        "a: b",
        "{",
        "'",
        '"',
        "\n",
        "&a [*a]",
    ),
    *("1,5", "2 in", "-0", "__class__", "disk", "mine", "kept", "forget", "empty"),
)
NUMBERS = (0, 1, -1, 2**70, -(2**70), 1e308, -1e308, 5e-324, float("inf"), float("-inf"), float("nan"), 3.7)
KEYS = (
    "do",
    "edit",
    "undo",
    "redo",
    "pull",
    "save",
    "choose",
    "options",
    "open",
    "problems",
    "ask",
    "n",
    "token",
)
DEEP = (
    "[" * 40,
    "{a: " * 40,
    "a:\n " * 40,
    "&a [*a, *a]\n" * 5,
    "- " * 60,
    "!!python/object:os.system x\n",
    "<<: *x\n",
)


def rubbish(r: Random, depth: int = 0) -> Any:
    """Any value."""
    kind = r.randrange(6 if depth < 3 else 4)
    if kind < 4:
        return (r.choice(WORDS), r.choice(NUMBERS), r.random() < 0.5, None)[kind]
    inside = [rubbish(r, depth + 1) for _ in range(r.randrange(4))]
    return inside if kind == 4 else {r.choice(WORDS): x for x in inside}


def spoiled(r: Random, value: Any) -> Any:
    """A value with one place in it changed, taken out or added to."""
    if r.random() < 0.25 or not isinstance(value, (dict, list, tuple)) or not value:
        return rubbish(r)
    if isinstance(value, dict):
        key = r.choice(list(value))
        out = {k: x for k, x in value.items() if k != key or r.random() < 0.9}
        return out | {key if r.random() < 0.9 else r.choice(WORDS): spoiled(r, value[key])}
    place = r.randrange(len(value))
    return [spoiled(r, x) if k == place else x for k, x in enumerate(value)]


def typed(r: Random, d: Document) -> dict[str, Any]:
    """Characters typed into the text."""
    end = len(d.text)
    start = r.randint(0, end)
    new = r.choice([*DEEP, *WORDS, "\nloads: {}\n", "mass: 2", "#", "\r\n", "\t"])
    return {"edit": [[start, min(end, start + r.choice([0, 0, 1, 3, 30])), new]], "base": d.hash}


def sensible(r: Random, d: Document) -> dict[str, Any]:
    """A message that a tab might send."""
    if r.random() < 0.4 and not d.reading.error and not d.reading.drawing.get("space"):
        return {"do": gesture_at_random(r, d)}
    links = [link["name"] for link in d.reading.drawing.get("links", [])] or ["none"]
    path = [[r.uniform(-1, 1), r.uniform(-1, 1)] for _ in range(r.randrange(12))]
    opened = {
        "kind": r.choice(["template", "example"]),
        "name": r.choice(["four_bar", "rssr", "engine", "none"]),
    }
    return r.choice(
        [
            typed(r, d),
            typed(r, d),
            {"undo": True},
            {"undo": True},
            {"redo": True},
            {"pull": {"link": r.choice(links), "at": [0.0, 0.01], "path": path}},
            {"save": r.choice([True, "other.yaml", "../m.yaml", "m.json"])},
            {"choose": r.choice(["disk", "mine", "kept", "forget"])},
            {"options": {"static": r.random() < 0.5, "friction": r.random() < 0.5}},
            {"open": r.choice(["empty", opened])},
            {"problems": True},
            {"ask": r.choice(["modes", "check", "data", "gradient"])},
        ]
    )


def text_of_message(r: Random, d: Document) -> str:
    """A message as it comes in."""
    draw = r.random()
    if draw < 0.08:
        return r.choice(
            ["[" * r.randrange(1, 9000), "{", "nul", "\ud800", "9" * 5000, json.dumps(rubbish(r))]
        )
    if draw < 0.16:
        return json.dumps({r.choice(KEYS): rubbish(r) for _ in range(r.randrange(1, 4))})
    whole = {"n": r.randrange(99)} | sensible(r, d)
    return json.dumps(spoiled(r, whole) if draw < 0.7 else whole)
