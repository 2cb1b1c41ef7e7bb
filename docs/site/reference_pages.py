"""Reference pages made from the program: the command line, the keys of the model file, the names in Python."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from functools import cache
from importlib.metadata import PackageNotFoundError, metadata
from itertools import groupby
from pathlib import Path
from typing import Any

import dalembert as da
from dalembert.cli import app
from dalembert.cli.installation.installed_packages import packages

GROUPS = {
    "Analyse": "analysis errors",
    "Describe a mechanism": "model",
    "Templates": "model.library",
    "Machine design": "machine",
    "Many designs": "optimization studies",
    "Answers, exams and marks": "grading exams",
    "Draw, report, show": "views reports pages notebook wrench",
}
"""Title of a part of the page of names -> the rooms its names come from; the longest fitting one counts."""


def pages() -> Iterator[tuple[str, str]]:
    yield "commands", commands()
    yield "model-keys", keys()
    yield "api", names()
    yield "benchmarks", benchmarks()
    yield "licences", licences()


def commands() -> str:
    """Every command with its arguments, as its help gives them."""
    parts = ["# Commands\n\nEvery command with its options; `dalembert COMMAND --help` prints the same."]
    for title, modules in app.GROUPS.items():
        parts.append(f"## {title}")
        for command in (name for some in modules.values() for name in some):
            text = app.command_line(command).generate_docs(output_format="markdown")
            text = text[text.index(f"## dalembert {command}") :]
            text = re.sub(r"^##(#*) dalembert ", r"###\1 ", text, flags=re.MULTILINE)
            text = re.sub(r"^\*\*Commands\*\*:\n\n(\* .*\n)+", "", text, flags=re.MULTILINE)
            parts.append(text.replace("```console\n", "```text\n").strip())
    return "\n\n".join(parts) + "\n"


def keys() -> str:
    """The keys of the model file, from its schema."""
    parts = [
        "# Keys of the model file",
        "Every key, from the schema that editors check with (`dalembert schema`). "
        "[The model file](model-file.md) has examples.",
        "## The file",
        key_table(schema()),
    ]
    for name, part in sorted(schema()["$defs"].items(), key=lambda item: item[0].lower()):
        if part.get("properties"):
            said = (part.get("description") or "").split("\n\n>>>")[0].strip()
            kind = part["properties"].get("type", {}).get("const")
            head = f"{name} (`type: {kind}`)" if kind else name
            parts += [f"## {head}", plain(said), key_table(part)]
    return "\n\n".join(parts) + "\n"


def benchmarks() -> str:
    """What the benchmarks printed, with date and machine, as `benchmarks/keep.py` kept it."""
    parts = [
        "# Benchmarks",
        "Each script compares the numbers first, then prints medians of one run; `python benchmarks/keep.py` runs "
        "them and keeps their lines, which are below. On a machine with other work the times are longer; "
        "the ratios are what to read.",
    ]
    for kept in sorted((Path(__file__).resolve().parents[2] / "benchmarks" / "kept").glob("*.txt")):
        head, _, printed = kept.read_text(encoding="utf-8").partition("\n\n")
        parts += [f"## {kept.stem.replace('_', ' ').capitalize()}", *head.splitlines()[:2]]
        parts.append("`" + head.splitlines()[2].removeprefix("$ ") + "`")
        for table, lines in groupby(printed.splitlines(), key=lambda line: line.startswith("|")):
            text = "\n".join(lines).strip("\n")
            parts += ([text] if table else [f"```text\n{text}\n```"]) if text else []
    return "\n\n".join(parts) + "\n"


def licences() -> str:
    """What a wheel contains and what it needs, with their licences: by its notices and packages' metadata."""
    notices = (Path(da.__file__).parent / "studio" / "bundle" / "licences.txt").read_text(encoding="utf-8")
    bundled = re.findall(r"^(\S+) (\d\S*) \((.+)\)$", notices, re.MULTILINE)
    states = {state.name: state for state in reversed(packages())}.values()
    parts = [
        "# Licences",
        "dalembert, its bundled problems and its front end are under the MIT licence. Of other packages "
        "a wheel contains these, in the studio; their texts are in `dalembert/studio/bundle/licences.txt`.",
        "| package | version | licence |\n| --- | --- | --- |\n"
        + "\n".join(f"| {name} | {version} | {licence} |" for name, version, licence in bundled),
        "These it only needs, and pip installs them; an extra's packages only with the extra.",
        "| package | lowest version | extra | licence |\n| --- | --- | --- | --- |\n"
        + "\n".join(
            f"| {s.name} | {s.lowest} | {s.extra or '-'} | {licence_of(s.name)} |"
            for s in sorted(states, key=lambda s: s.name.lower())
        ),
    ]
    return "\n\n".join(parts) + "\n"


def licence_of(package: str) -> str:
    """Licence of an installed package by its metadata: the expression, else the classifier, else the first line."""
    try:
        about = metadata(package)
    except PackageNotFoundError:
        return "not installed where this page was made"
    listed = [c.rsplit(" :: ", 1)[-1] for c in about.get_all("Classifier", []) if c.startswith("License ::")]
    classifiers = [c for c in listed if c != "OSI Approved"]
    first = str(about.get("License") or "").strip().partition("\n")[0]
    return str(about.get("License-Expression") or ", ".join(classifiers) or first or "not stated")


def key_table(part: dict[str, Any]) -> str:
    needed = set(part.get("required", ()))
    rows = ["| key | value | meaning |", "| --- | --- | --- |"]
    for key, value in part["properties"].items():
        star = " (required)" if key in needed and "const" not in value else ""
        rows.append(f"| `{key}`{star} | {written(value)} | {cell(value.get('description', ''))} |")
    return "\n".join(rows)


def written(value: dict[str, Any]) -> str:
    """The form of a value in a few words."""
    if "const" in value:
        return f"`{value['const']}`"
    if "enum" in value:
        return ", ".join(f"`{x}`" for x in value["enum"])
    if "$ref" in value:
        name = value["$ref"].rsplit("/", 1)[-1]
        return f"[{name}](#{anchor(name)})"
    for several in ("anyOf", "oneOf"):
        if several in value:
            some = dict.fromkeys(written(v) for v in value[several] if v.get("type") != "null")
            return " or ".join(some)
    kind = value.get("type", "")
    if isinstance(kind, list):
        return "number with its unit" if set(kind) == {"number", "string"} else "name or number"
    if kind == "array":
        return f"list of {written(value['items'])}" if "items" in value else "list"
    if kind == "object":
        inner = value.get("additionalProperties")
        return f"map of {written(inner)}" if isinstance(inner, dict) else "map"
    return {"string": "text", "integer": "whole number"}.get(kind, kind)


@cache
def schema() -> dict[str, Any]:
    return da.json_schema()


def anchor(name: str) -> str:
    """Address of the heading of a part."""
    kind = schema()["$defs"][name].get("properties", {}).get("type", {}).get("const")
    return name.lower() + (f"-type-{kind}" if kind else "")


def cell(text: str) -> str:
    return plain(text).replace("|", "\\|").replace("\n", " ")


def plain(text: str) -> str:
    """A docstring's text as Markdown: its marks of reStructuredText and of polar vectors are no links or formulas."""
    return re.sub(r"(?<!`)([<>$*])(?![^`]*`)", r"\\\1", text.replace("``", "`"))


def names() -> str:
    """The public names in groups, with their signatures and docstrings."""
    rooms = {room: title for title, some in GROUPS.items() for room in some.split()}
    grouped: dict[str, list[str]] = {title: [] for title in GROUPS}
    for name in sorted({*da.__all__} - {"__version__"}, key=str.lower):
        thing = getattr(da, name)
        module = getattr(thing, "__module__", None) or getattr(thing, "__name__", "")
        inside = str(module).removeprefix("dalembert.")
        fits = [room for room in rooms if f"{inside}.".startswith(f"{room}.")]
        grouped[rooms[max(fits, key=len)] if fits else "Analyse"].append(name)
    parts = [
        "# Names in Python\n\n`import dalembert as da`; SI units and radians unless a docstring says otherwise."
    ]
    for title, some in grouped.items():
        directives = "\n\n".join(directive(name) for name in some)
        parts.append(f"## {title}\n\n```{{eval-rst}}\n{directives}\n```")
    return "\n\n".join(parts) + "\n"


def directive(name: str) -> str:
    thing = getattr(da, name)
    if inspect.isclass(thing):
        members = "" if hasattr(thing, "model_fields") else "\n   :members:"  # keys of the file have a page
        return f".. autoclass:: dalembert.{name}{members}"
    if inspect.isfunction(thing):
        return f".. autofunction:: dalembert.{name}"
    if inspect.ismodule(thing):
        return f".. automodule:: dalembert.{name}\n   :noindex:"
    return f".. autodata:: dalembert.{name}\n   :no-value:"
