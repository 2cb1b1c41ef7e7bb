"""The JSON Schema of model files in short: a line for each key, with what may be written there.

`python -m tests.model.schema_lines` writes it anew; read the difference before it is committed.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from dalembert.model import json_schema

SILENT = ("title", "description", "default", "$schema")


def short(part: Any) -> str:
    """What a part of the schema lets be written: `3..4 of [number or string]`, `pin`, `-> Pin`."""
    if not isinstance(part, dict):
        return str(part)
    if "$ref" in part:
        return f"-> {part['$ref'].rpartition('/')[2]}"
    words = {key: value for key, value in part.items() if key not in SILENT}
    kinds = words.pop("type", ())
    out = [" or ".join([kinds] if isinstance(kinds, str) else kinds)]
    out += [f"= {words.pop('const')!r}"] if "const" in words else []
    out += [f"one of {words.pop('enum')}"] if "enum" in words else []
    for low, high in (("minItems", "maxItems"), ("minimum", "maximum")):
        if low in words or high in words:
            out.append(f"{words.pop(low, '')}..{words.pop(high, '')}")
    out += [f"of [{short(words.pop('items'))}]"] if "items" in words else []
    for word in ("anyOf", "oneOf"):
        out += [f"({' | '.join(map(short, words.pop(word)))})"] if word in words else []
    inner = words.pop("properties", {})
    out += ["{" + ", ".join(f"{key}: {short(value)}" for key, value in inner.items()) + "}"] if inner else []
    out += [f"{key} {short(words[key])}" for key in sorted(words)]
    return " ".join(filter(None, out))


def lines() -> Iterator[str]:
    schema = json_schema()
    for name, part in {"file": schema, **schema["$defs"]}.items():
        rest = {key: value for key, value in part.items() if key not in ("properties", "$defs")}
        yield f"{name}: {short(rest)}"
        for key, value in part.get("properties", {}).items():
            default = None if key in part.get("required", ()) else value.get("default")
            yield f"  {key}: {short(value)}" + ("" if default is None else f", default {default}")


WRITTEN = Path(__file__).with_name("schema.txt")

if __name__ == "__main__":
    WRITTEN.write_text("\n".join(lines()) + "\n", encoding="utf-8", newline="\n")
