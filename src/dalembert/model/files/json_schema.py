"""The JSON Schema of a model file."""

from __future__ import annotations

from dalembert.arrays import Tree
from dalembert.model.description import Mechanism
from dalembert.model.files.copies.expansion import copies_schema


def json_schema() -> Tree:
    """The JSON Schema of a model file: every key with its meaning and units.

    >>> json_schema()["properties"]["links"]["description"]
    'the rigid bodies; ground is the fixed one'
    """
    schema = Mechanism.model_json_schema(by_alias=True)
    for part in schema["$defs"].values():
        if "type" in part.get("properties", {}):
            part["required"] = ["type", *(key for key in part.get("required", []) if key != "type")]
        for key in ("stiffness", "damping"):  # or a law instead of it
            if key in part.get("required", []) and "force" in part["properties"]:
                part["required"].remove(key)
                part["anyOf"] = [{"required": [key]}, {"required": ["force"]}]
    schema["properties"]["copies"] = copies_schema()
    return (
        {"$schema": "https://json-schema.org/draft/2020-12/schema"}
        | schema
        | {"title": "dalembert model file"}
    )
