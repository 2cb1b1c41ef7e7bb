"""The JSON Schema: every key described, none that the loader refuses."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from dalembert.model import json_schema

SCHEMA = json_schema()


def described(part: Any, path: str) -> Iterator[tuple[str, Any]]:
    if isinstance(part, dict):
        for key, value in part.get("properties", {}).items():
            yield f"{path}.{key}", value
        for key, value in part.items():
            yield from described(value, f"{path}.{key}")
    elif isinstance(part, list):
        for i, value in enumerate(part):
            yield from described(value, f"{path}.{i}")


def test_every_key_is_described() -> None:
    keys = dict(described(SCHEMA, ""))
    assert len(keys) > 100
    bare = [path for path, part in keys.items() if not part.get("description") and not path.endswith(".type")]
    assert bare == []


def test_it_is_json_and_closed() -> None:
    assert json.loads(json.dumps(SCHEMA)) == SCHEMA
    assert SCHEMA["additionalProperties"] is False
    assert all(part["additionalProperties"] is False for part in SCHEMA["$defs"].values())


def test_the_keys_are_those_of_the_file() -> None:
    assert list(SCHEMA["properties"]) == [
        "dalembert", "title", "source", "space", "units", "gravity", "g", "links", "joints", "drives", "loads",
        "friction", "assembly", "answers",
    ]  # fmt: skip
    assert SCHEMA["required"] == ["links"]
    assert SCHEMA["$defs"]["Pin"]["required"] == ["type", "links"]
    assert set(SCHEMA["$defs"]["Link"]["properties"]) == {
        "points", "mass", "weight", "center", "inertia", "shape",
    }  # fmt: skip
