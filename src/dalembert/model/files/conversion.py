"""A model file in another format, or a file of another program."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING

from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.model.description import Mechanism

FilePath = str | os.PathLike[str]


def convert(
    path: FilePath,
    target: FilePath,
    overwrite: bool = False,
    strict: bool = False,
    change: Callable[[Mechanism], Mechanism] | None = None,
    fmi: str = "",
    forward: bool = False,
) -> list[str]:
    """Write a model file in another format, keeping the user's units, texts and order of keys.

    The mechanism is read first, so that a wrong file is not converted. Comments are not kept. Either file may be
    that of another program (docs/formats.md). change: applied to the mechanism before it is written. fmi: version of
    an .fmu file, "2.0" or "3.0"; forward: its inputs are the efforts of the drives, which forces move. Returns what is
    not kept, a line each; with strict such a line raises ModelError, and no file is written.

    >>> from tempfile import TemporaryDirectory
    >>> from dalembert.bundled import examples
    >>> with TemporaryDirectory() as folder:
    ...     print(convert(examples()["four_bar"], f"{folder}/bar.sdf")[0])
    drive 'O2': SDFormat prescribes no motion
    """
    from dalembert.interchange.file_formats import foreign_bytes, is_foreign, is_writable, read_foreign
    from dalembert.model.description import mechanism
    from dalembert.model.files.model_files import load, read_file, save_tree
    from dalembert.model.files.rewriting import in_folder
    from dalembert.saving import new_file

    if (fmi or forward) and os.path.splitext(target)[1].lower() != ".fmu":
        option = f"fmi {fmi}" if fmi else "forward"
        raise ModelError(f"{option} is for a file .fmu, not {os.fspath(target)}", "leave it out")
    if not (change or is_foreign(path) or is_writable(target)):
        tree, source = read_file(path)
        tree = in_folder(mechanism(tree, source), tree, os.path.dirname(target))
        save_tree({key: value for key, value in tree.items() if value is not None}, target, overwrite)
        return []
    m, lost = read_foreign(path) if is_foreign(path) else (load(path), [])
    m = change(m) if change else m
    content, more = foreign_bytes(m, target, fmi, forward) if is_writable(target) else (b"", [])
    lost += more
    if strict and lost:
        raise ModelError(f"not kept: {'; '.join(lost)}", "convert without strict", (), os.fspath(path))
    if not is_writable(target):
        m.save(target, overwrite)
        return lost
    with new_file(target, overwrite) as temporary:
        temporary.write_bytes(content)
    return lost


def save(m: Mechanism, path: FilePath, overwrite: bool = False) -> None:
    """Write a mechanism to a model file, or to a file of another program with a warning for each thing not kept."""
    from dalembert.interchange.file_formats import is_writable, save_with_warnings
    from dalembert.model.files.model_files import format_of, save_text
    from dalembert.model.files.rewriting import text_of

    if is_writable(path):
        save_with_warnings(m, path, overwrite)
    else:
        save_text(text_of(m.written, format_of(path), os.path.dirname(path)), path, overwrite)
