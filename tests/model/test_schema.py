"""The JSON Schema: every key described, none that the loader refuses."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from dalembert.bundled import cases, examples
from dalembert.model import json_schema, read_file
from dalembert.model.part import Part
from tests.model.schema_lines import WRITTEN, lines

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


def test_what_has_a_type_says_it_first() -> None:
    """An editor that completes a joint or a load asks for its type."""
    of_types = [part for part in SCHEMA["$defs"].values() if "type" in part.get("properties", {})]
    assert len(of_types) > 30
    assert {part["required"][0] for part in of_types} == {"type"}
    assert [part["required"].count("type") for part in of_types] == [1] * len(of_types)
    assert SCHEMA["$defs"]["Pin"]["required"] == ["type", "links"]


def test_it_is_json_and_closed() -> None:
    assert json.loads(json.dumps(SCHEMA)) == SCHEMA
    assert SCHEMA["additionalProperties"] is False
    assert all(part["additionalProperties"] is False for part in SCHEMA["$defs"].values())


def test_what_may_be_written_is_as_it_was_read() -> None:
    """Types, words, counts and defaults of every key, exactly."""
    assert list(lines()) == WRITTEN.read_text(encoding="utf-8").splitlines()


def test_the_keys_are_those_of_the_file() -> None:
    assert list(SCHEMA["properties"]) == [
        "dalembert", "title", "source", "space", "units", "gravity", "g", "parameters", "links", "joints",
        "drives", "loads", "turning", "friction", "assembly", "start", "answers", "copies",
    ]  # fmt: skip
    assert SCHEMA["required"] == ["links"]
    assert SCHEMA["$defs"]["Pin"]["required"] == ["type", "links"]
    assert set(SCHEMA["$defs"]["Link"]["properties"]) == {
        "points", "mass", "weight", "center", "inertia", "place", "shape",
        "mass_along", "members", "section", "effective_length",
    }  # fmt: skip


TYPES: dict[str, Any] = {
    "object": dict,
    "array": list,
    "string": str,
    "integer": int,
    "number": (int, float),
    "boolean": bool,
    "null": type(None),
}


def fits(part: dict[str, Any], value: Any) -> bool:
    """Whether a value is one that a part of the schema describes; the words of the schema that ours uses."""
    part = SCHEMA["$defs"][part["$ref"].rsplit("/", 1)[1]] | part if "$ref" in part else part
    kinds = part.get("type", list(TYPES))
    kinds = [kinds] if isinstance(kinds, str) else kinds
    if not any(isinstance(value, TYPES[k]) and (k == "boolean" or value is not True) for k in kinds):
        return False
    if value not in part.get("enum", [value]) or value != part.get("const", value):
        return False
    for word in ("anyOf", "oneOf"):
        if word in part and not any(fits(one, value) for one in part[word]):
            return False
    if isinstance(value, list) and not part.get("minItems", 0) <= len(value) <= part.get("maxItems", 10**9):
        return False
    if isinstance(value, list) and "items" in part:
        return all(fits(part["items"], item) for item in value)
    if not isinstance(value, dict):
        return True
    known, more = part.get("properties", {}), part.get("additionalProperties", True)
    inner = [(known.get(key, more), item) for key, item in value.items()]
    return set(part.get("required", ())) <= set(value) and all(
        fits(one, item) if isinstance(one, dict) else one for one, item in inner
    )


FILES = {**examples(), **cases(), "rssr in the tests": Path(__file__).parent / "rssr.yaml"}


@pytest.mark.parametrize("name", FILES)
def test_every_bundled_file_is_one_that_it_describes(name: str) -> None:
    tree = json.loads(json.dumps(read_file(FILES[name])[0]))
    for key, value in tree.items():
        if key in ("links", "joints", "drives", "loads"):
            for one, part in value.items():
                assert fits(SCHEMA["properties"][key]["additionalProperties"], part), (key, one)
    assert fits(SCHEMA, tree)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("links", {"rod": {"shape": {"type": "bar", "size": 3}}}),
        ("links", {"rod": {"shape": {"type": "cylinder", "radius": [3]}}}),
        ("joints", {"A": {"type": "sperical", "links": ["a", "b"]}}),
        ("loads", {"F": {"type": "torsion_spring", "joint": "A", "stiffness": 1, "freedom": "slide"}}),
        ("answers", [{"quantity": "rotation", "axes": "joints"}]),
    ],
)
def test_it_tells_what_is_wrong(key: str, value: Any) -> None:
    assert not fits(SCHEMA, {"links": {"ground": {}}, key: value})


def parts(kind: type[Part]) -> Iterator[type[Part]]:
    for each in kind.__subclasses__():
        yield each
        yield from parts(each)


def test_variables_of_the_caller_have_no_part_in_how_a_part_is_read() -> None:
    """A schema is built where a kind of part is first used, and pydantic looks there for what annotations name."""
    for kind in parts(Part):
        of_the_caller = dict.fromkeys([*vars(sys.modules[kind.__module__]), "object", "Any", "Tree"], 3)
        assert kind.model_rebuild(force=True, _types_namespace=of_the_caller)


def test_it_is_the_same_each_time_and_a_law_does_instead_of_a_stiffness_or_damping() -> None:
    assert json_schema() == json_schema()
    for kind, key in (("Spring", "stiffness"), ("Damper", "damping")):
        part = json_schema()["$defs"][kind]
        assert key not in part["required"]
        assert part["anyOf"] == [{"required": [key]}, {"required": ["force"]}]
    assert "default" not in json_schema()["$defs"]["Band"]["properties"]["radius"]
