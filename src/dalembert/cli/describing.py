"""`dalembert schema`, `new`, `convert` and `examples`: descriptions rather than answers."""

from __future__ import annotations

import json
from pathlib import Path

from dalembert.cli.text import table
from dalembert.errors import ModelError
from dalembert.wording import closest


def schema_text() -> str:
    """The JSON schema of the model file."""
    from dalembert.model import json_schema

    return json.dumps(json_schema(), indent=2, ensure_ascii=False) + "\n"


def example_list() -> str:
    """Names and titles of the bundled examples."""
    from dalembert.bundled import cases, examples

    rows = [[name, _title(path)] for name, path in examples().items()]
    shown = table(["example", "title"], rows, 2)
    return f"{shown}\n\n{len(cases())} published problems with their answers are bundled too: `dalembert validate`."


def example_text(name: str) -> str:
    """The file of a bundled example, or of a bundled published problem."""
    from dalembert.bundled import cases, examples

    found = {**cases(), **examples()}
    if name not in found:
        raise ModelError(f"there is no example {name!r}", closest(name, list(examples())))
    return found[name].read_text(encoding="utf-8")


def _title(path: Path) -> str:
    """The title of a model file, read without the rest."""
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("title:"):
            return line.removeprefix("title:").strip().strip("\"'")
    return ""


def converted(file: Path, output: Path, force: bool) -> int:
    """Write a model file in the format that the ending of the output names."""
    from dalembert.model import convert
    from dalembert.saving import check_new

    check_new(output, force)
    convert(file, output, overwrite=force)
    print(f"Written: {output}")
    return 0


def template_list() -> str:
    """Names of the templates and what they build."""
    from dalembert.model.library import TEMPLATES

    return table(["template", "what it is"], [[name, t.description] for name, t in TEMPLATES.items()], 2)


def template_file(name: str) -> str:
    """The commented model file of a template."""
    from dalembert.model.library import template_text

    return template_text(name)
