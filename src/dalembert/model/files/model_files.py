"""Model files: YAML, JSON and TOML carry the same keys."""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from dalembert.errors import MissingFileError, ModelError
from dalembert.model.description import Mechanism, mechanism
from dalembert.model.files.source import STANDARD_INPUT, FileSource, Lines, is_stream
from dalembert.saving import DATA_FOLDER, new_file
from dalembert.wording import nearest

LARGEST = 1_000_000
"""Bytes of a model file."""

YAML_AND_TOML = (".yaml", ".yml", ".toml")
"""Suffixes that no other program's files have."""

FORMATS = {".yaml": "yaml", ".yml": "yaml", ".json": "json", ".toml": "toml"}

FilePath = str | os.PathLike[str]
ModelOrPath = Mechanism | FilePath
"""A description, or the name of a model file: what every analysis starts from."""


def as_mechanism(m: ModelOrPath) -> Mechanism:
    """A description as it is, or that of a model file."""
    if isinstance(m, Mechanism):
        return m
    if not isinstance(m, (str, os.PathLike)):
        raise ModelError(
            f"a {type(m).__name__} is not a mechanism", "give a Mechanism or the path of a model file"
        )
    return load(m)


def load(path: FilePath, data: FilePath = "") -> Mechanism:
    """The mechanism of a .yaml, .json or .toml file; raises ModelError with file and line.

    Files of other programs are read by their suffix (docs/formats.md), with a warning for each thing that is not kept.
    Tables may come from text files in its folder; from those in the folder ``data`` too. Raises
    FileNotFoundError, which is a ModelError too, for a file that does not exist.

    >>> from dalembert.bundled import examples
    >>> load(examples()["four_bar"]).title
    'Four-bar linkage, dynamic'
    """
    if Path(path).suffix.lower() not in YAML_AND_TOML and not is_stream(path):
        from dalembert.interchange.file_formats import is_foreign, load_foreign

        if is_foreign(path):
            return load_foreign(path)
    tree, source = read_file(path)
    return mechanism(tree, replace(source, data=os.fspath(data)) if data else source)


def loads(text: str, form: str = "yaml", name: str = "text") -> Mechanism:
    """The mechanism of a text; `name` is the name of the file in messages.

    >>> loads("{links: {ground: {}, bar: {mass: 2 lbm}}}").mass("bar")
    0.90718474
    """
    return mechanism(*read_text(text, form, name))


def read_file(path: FilePath) -> tuple[Any, FileSource]:
    """The tree of a file as it is written, and where it came from; `-` is standard input."""
    name = STANDARD_INPUT[-1] if os.fspath(path) in STANDARD_INPUT[:2] else os.fspath(path)
    text = _decode(_content(Path(path), name), name)
    return read_text(text, _form_of_stream(path, text) if is_stream(path) else format_of(path), name)


def read_text(text: str, form: str = "yaml", name: str = "text") -> tuple[Any, FileSource]:
    """The tree of a text as it is written, and where it came from."""
    if form not in FORMATS.values():
        raise ModelError(f"unknown format {form!r}", "use yaml, json or toml")
    if len(text) > LARGEST:
        what = f"the file has more than {LARGEST} characters"
        raise ModelError(what, "give large tables fewer points", (), name, 1)
    try:
        tree, lines = _tree(text.removeprefix("\ufeff"), form)
    except ModelError as error:
        raise error.at_line(name, error.line or 1) from None
    if tree is None or tree == {}:
        problem = "the file is empty"
        raise ModelError(problem, "begin with links: and joints:, or with `dalembert new`", (), name, 1)
    return tree, FileSource(name, lines, text, form, DATA_FOLDER.get())


def _tree(text: str, form: str) -> tuple[object, Callable[[], Lines]]:
    """Tree of a text, and its lines: those of YAML are read with it, others when a message needs them."""
    if form == "yaml":
        from dalembert.model.files import yaml_text

        tree, known = yaml_text.read(text)
        return tree, partial(_known, known)
    from dalembert.model.files import json_text, toml_text
    from dalembert.model.files.places import lines

    return (json_text if form == "json" else toml_text).read(text), partial(lines, text, form)


def _known(lines: Lines) -> Lines:
    return lines


def _content(path: Path, name: str) -> bytes:
    try:
        directory = path.is_dir()
        content = b"" if directory else _first_bytes(path)
    except FileNotFoundError:
        raise MissingFileError(name, _neighbour(path)) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        words = f"the file {name!r} cannot be read: {reason}"
        raise ModelError(words, "check its name and permissions", (), repr(name)[1:-1], 1) from None
    if directory:
        raise ModelError(f"{name} is a directory", "name a .yaml, .json or .toml file", (), name, 1)
    if len(content) > LARGEST:
        what = f"the file has more than {LARGEST} bytes"
        raise ModelError(what, "give large tables fewer points", (), name, 1)
    return content


def _form_of_stream(path: FilePath, text: str) -> str:
    """The format by the name's ending, or else by how the text begins."""
    suffix = Path(path).suffix.lower()
    if suffix in FORMATS:
        return FORMATS[suffix]
    text = text.removeprefix("\ufeff")
    if text.lstrip()[:1] == "{":
        try:
            json.loads(text)
        except (ValueError, RecursionError):
            return "yaml"
        return "json"
    line = re.search(r"^(?!\s*(#|$)).*", text, re.MULTILINE)
    return "toml" if line and re.match(r"\[|[\w.\"'-]+\s*=", line[0]) else "yaml"


def _first_bytes(path: Path) -> bytes:
    if str(path) in STANDARD_INPUT[:2]:
        return sys.stdin.buffer.read(LARGEST + 1)
    with path.open("rb") as file:
        return file.read(LARGEST + 1)


def _neighbour(path: Path) -> str:
    files = sorted(path.parent.iterdir()) if path.parent.is_dir() else []
    named = {p.stem: p.name for p in reversed(files) if p.suffix in FORMATS}
    near = nearest(path.stem, list(named))
    return f"did you mean {named[near]!r}?" if near else ""


def _decode(content: bytes, name: str) -> str:
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        what = f"the file is not UTF-8 text: invalid byte {content[error.start]:#04x}"
        raise ModelError(what, "save it as UTF-8", (), name, line) from None


def format_of(path: FilePath) -> str:
    """The format that the ending of a name says."""
    suffix = Path(path).suffix.lower()
    if suffix not in FORMATS:
        what = f"{os.fspath(path)}: {suffix!r} is not an extension of model files"
        raise ModelError(what, "use .yaml, .json or .toml")
    return FORMATS[suffix]


def save_tree(tree: Mapping[str, object], path: FilePath, overwrite: bool = False) -> None:
    """Write a tree to a .yaml, .json or .toml file; raises ModelError if there is one and not `overwrite`."""
    save_text(tree_text(tree, format_of(path)), path, overwrite)


def save_text(text: str, path: FilePath, overwrite: bool = False) -> None:
    """Write the text of a model file; raises ModelError if there is one and not `overwrite`."""
    try:
        content = text.encode("utf-8")
    except UnicodeEncodeError as error:
        half = text[error.start]
        what = f"cannot write {os.fspath(path)}: a text in it has {half!r}, half a character"
        raise ModelError(what, "write that text again") from None
    with new_file(path, overwrite) as temporary:
        temporary.write_bytes(content)


def tree_text(tree: Mapping[str, object], form: str = "yaml") -> str:
    """A tree as text.

    >>> print(tree_text({"title": "Bar", "links": {"bar": {"points": {"A": [0, "1 m"]}}}}), end="")
    title: Bar
    links:
      bar: {points: {A: [0, 1 m]}}
    """
    if form == "yaml":
        from dalembert.model.files.yaml_writing import to_yaml

        return to_yaml(tree)
    if form == "json":
        return json.dumps(tree, indent=2, ensure_ascii=False) + "\n"
    return _toml_text(tree)


def _toml_text(tree: Mapping[str, object]) -> str:
    try:
        import tomli_w
    except ImportError:
        what = "TOML is written by the package tomli-w"
        raise ModelError(what, "install it: pip install tomli-w") from None
    return tomli_w.dumps(tree)
