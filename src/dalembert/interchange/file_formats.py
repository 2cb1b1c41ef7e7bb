"""The table of other programs' files: suffix, program, reader, writer; docs/formats.md says what each keeps.

A reader takes the bytes and the name of a file and gives a graph of links, or the tree of a model file in the plane,
with notes of what is not kept. A writer takes a mechanism and gives the file's bytes, with such notes.
"""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

from dalembert.arrays import Tree
from dalembert.errors import MissingFileError, ModelError
from dalembert.interchange.link_graph import LinkGraph, graph_of, tree_of
from dalembert.interchange.sketches.plane_sketch import PlaneSketch, sketch_tree
from dalembert.model import Mechanism
from dalembert.model.files.source import FileSource
from dalembert.saving import new_file

LARGEST = 10_000_000
"""Bytes of a file that is read; each format has a smaller bound."""


class NotKept(UserWarning):
    """Contents of a file of another program that the mechanism does not have, or the reverse."""


@dataclass(frozen=True)
class ReadFile:
    """The tree of a model file, notes of what is not in it, lines of links and joints."""

    tree: Tree
    lines: dict[tuple[str | int, ...], int]
    lost: list[str]


@dataclass(frozen=True)
class FileFormat:
    """A format: its name, the program, and the functions that read and write it, as ``module:function``."""

    name: str
    reader: str = ""
    writer: str = ""

    def function(self, what: str) -> Callable[..., Any]:
        """The function that reads or writes, imported when needed."""
        module, _, name = what.partition(":")
        call: Callable[..., Any] = getattr(import_module(f"dalembert.interchange.{module}"), name)
        return call


PYLINKAGE = ".json"
"""Suffix that a file of pylinkage shares with model files: its links are a list."""

FILE_FORMATS: dict[str, FileFormat] = {
    ".xml": FileFormat("MJCF (MuJoCo)", "robots.mjcf_loops:read_mjcf", "robots.mjcf_writer:write_mjcf"),
    ".mjcf": FileFormat("MJCF (MuJoCo)", "robots.mjcf_loops:read_mjcf", "robots.mjcf_writer:write_mjcf"),
    ".sdf": FileFormat("SDFormat", "robots.sdf_reader:read_sdf", "robots.sdf_writer:write_sdf"),
    ".urdf": FileFormat("URDF", "robots.urdf_reader:read_urdf", "robots.urdf_writer:write_urdf"),
    ".asmt": FileFormat("OndselSolver (FreeCAD Assembly)", "", "assemblies.ondsel_writer:write_asmt"),
    ".cmd": FileFormat(
        "Adams View", "assemblies.adams_reader:read_adams", "assemblies.adams_writer:write_adams"
    ),
    ".pmks": FileFormat("PMKS and PMKS+", "sketches.pmks_links:read_pmks", "sketches.pmks_writer:write_pmks"),
    ".txt": FileFormat("PMKS and PMKS+", "sketches.pmks_links:read_pmks"),
    ".dxf": FileFormat("DXF skeleton", "sketches.dxf_skeletons:read_dxf"),
    ".fcstd": FileFormat("FreeCAD sketches", "sketches.freecad_sketches:read_freecad"),
    PYLINKAGE: FileFormat("pylinkage", "sketches.pylinkage_files:read_pylinkage"),
    ".pylinkage.json": FileFormat(
        "pylinkage", "sketches.pylinkage_files:read_pylinkage", "sketches.pylinkage_writer:write_pylinkage"
    ),
    ".fmu": FileFormat("FMI", "", "targets.source_fmu:write_fmu"),
    ".zip": FileFormat("C and WebAssembly", "", "targets.source_archive:write_sources"),
}
"""Suffix -> format."""


def is_foreign(path: str | os.PathLike[str]) -> bool:
    """True if the suffix is that of another program's file; a .json file if its links are a list."""
    suffix = _suffix(path)
    return suffix in FILE_FORMATS and (suffix != PYLINKAGE or _lists_links(Path(path)))


def is_writable(path: str | os.PathLike[str]) -> bool:
    """True if the suffix is that of another program's file that is written."""
    form = FILE_FORMATS.get(_suffix(path))
    return form is not None and bool(form.writer)


def _suffix(path: str | os.PathLike[str]) -> str:
    """The suffix of a file's name, a double one where the table has it."""
    name = Path(path)
    double = "".join(name.suffixes[-2:]).lower()
    return double if double in FILE_FORMATS else name.suffix.lower()


def _lists_links(path: Path) -> bool:
    """True for a JSON file of pylinkage's form, small enough to be one."""
    try:
        if not path.is_file() or path.stat().st_size > 1_000_000:
            return False
        tree = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return False
    return isinstance(tree, dict) and isinstance(tree.get("links"), list)


def read_foreign(path: str | os.PathLike[str]) -> tuple[Mechanism, list[str]]:
    """The mechanism of another program's file, and what the file says that it does not have, a line each.

    Raises ModelError with file and line for what cannot be left out without another motion or other forces.
    """
    from dalembert.model.description import mechanism

    name = os.fspath(path)
    form = _form(path, "reader")
    read: Any = form.function(form.reader)(_content(Path(path)), name)
    if isinstance(read, LinkGraph):
        read = read_file_of(read)
    elif isinstance(read, PlaneSketch):
        read = ReadFile(*sketch_tree(read, name), read.lost)
    source = FileSource(name, lambda: read.lines, "", form.name)
    return mechanism(read.tree, source), read.lost


def read_file_of(graph: LinkGraph) -> ReadFile:
    """Tree, notes and lines of a graph of links."""
    parts = [("links", link) for link in graph.links.values()] + [
        ("joints", j) for j in graph.joints.values()
    ]
    lines: dict[tuple[str | int, ...], int] = {
        (key, part.name): part.line for key, part in parts if part.line
    }
    return ReadFile(tree_of(graph), lines, graph.lost)


def load_foreign(path: str | os.PathLike[str]) -> Mechanism:
    """As `read_foreign`; what is not kept is a warning (NotKept) each."""
    m, lost = read_foreign(path)
    _warn(path, lost)
    return m


def save_with_warnings(m: Mechanism, path: str | os.PathLike[str], overwrite: bool) -> None:
    """Write another program's file; what of the mechanism is not in it is a warning (NotKept) each."""
    content, lost = foreign_bytes(m, path)
    with new_file(path, overwrite) as temporary:
        temporary.write_bytes(content)
    _warn(path, lost)


def _warn(path: str | os.PathLike[str], lost: list[str]) -> None:
    for note in lost:
        warnings.warn(f"{os.fspath(path)}: not kept: {note}", NotKept, stacklevel=4)


def foreign_bytes(
    m: Mechanism, path: str | os.PathLike[str], version: str = "", forward: bool = False
) -> tuple[bytes, list[str]]:
    """Content of another program's file by the suffix of its name, and what of the mechanism is not in it.

    Of a functional mock-up unit: its version, "2.0" (default) or "3.0", and whether forces move it (``forward``).
    """
    form = _form(path, "writer")
    write = form.function(form.writer)
    if version or forward:
        write = partial(write, version=version or "2.0", forward=forward)
    if form.writer.startswith(("robots", "assemblies")):
        graph = graph_of(m)
        content = write(graph)
        lost = [*graph.lost, *_beyond(m)]
    else:
        content, lost = write(m)
    return (content.encode() if isinstance(content, str) else content), lost


def _beyond(m: Mechanism) -> list[str]:
    """Parts that no format of links and joints keeps."""
    notes = []
    counts = [len(m.schedule().position)]
    if counts[0] > 1:
        notes.append(f"{counts[0] - 1} of {counts[0]} positions: the file has the first")
    if m.friction.enabled and any(getattr(joint, "friction", None) for joint in m.joints.values()):
        notes.append("dry friction")
    if m.answers:
        notes.append("published answers")
    return notes


def _form(path: str | os.PathLike[str], what: str) -> FileFormat:
    suffix = _suffix(path)
    form = FILE_FORMATS.get(suffix)
    if form is None or not getattr(form, what):
        known = [s for s, f in FILE_FORMATS.items() if getattr(f, what)]
        verb = "read" if what == "reader" else "written"
        raise ModelError(
            f"{os.fspath(path)}: {suffix or 'no suffix'} is not {verb}", f"use {', '.join(known)}"
        )
    return form


def _content(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST + 1)
    except FileNotFoundError:
        raise MissingFileError(str(path)) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise ModelError(
            f"the file cannot be read: {reason}", "check its name and permissions", (), str(path)
        ) from None
    if len(content) > LARGEST:
        raise ModelError(f"the file has more than {LARGEST} bytes", "leave meshes out", (), str(path), 1)
    return content
