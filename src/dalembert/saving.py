"""Writing files: existing files are kept unless ``overwrite`` is true, and a file appears complete or not at all."""

from __future__ import annotations

import os
import secrets
import shutil
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from tempfile import gettempdir
from typing import IO

from dalembert.errors import DalembertError, ModelError

DATA_FOLDER: ContextVar[str] = ContextVar("DATA_FOLDER", default="")
"""Folder, besides that of a model file, from which its tables may be read; empty for none."""


def check_installed(package: str, what: str, extra: str = "results") -> None:
    """Raise where an optional package is missing, with the line that installs it."""
    from importlib.util import find_spec

    if find_spec(package) is None:
        remedy = f"pip install 'dalembert[{extra}]'"
        raise DalembertError(f"{what} needs the package {package}, which is not installed; {remedy}")


def check_new(path: Path, overwrite: bool) -> None:
    """Raise where a file cannot be new: before the work, not behind it."""
    kind = _kind(path)
    if kind in STREAMS:
        return
    if kind:
        raise ModelError(f"{path} is {kind}", "name a file" + (" in it" if kind == "a folder" else ""))
    if not os.path.isdir(path.parent):
        raise ModelError(
            f"cannot write {path}: folder {path.parent} does not exist", "create it, or name another"
        )
    if os.path.exists(path) and not overwrite:
        raise ModelError(
            f"{path} exists", "name another file, or overwrite it: --force, in Python overwrite=True"
        )


KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a block device",
    stat.S_IFSOCK: "a socket",
}
STREAMS = ("a pipe", "a device")
"""Special targets that are written into and not replaced: a named pipe, `>(...)`, /dev/null."""


def _kind(path: Path) -> str:
    """Kind of the object at a path, if it is not an ordinary file."""
    try:
        return KINDS.get(stat.S_IFMT(os.stat(path).st_mode), "")
    except (OSError, ValueError):
        return ""


@contextmanager
def new_file(path: str | os.PathLike[str], overwrite: bool = False) -> Iterator[Path]:
    """A temporary file that takes the place of `path` when all is written; an existing one is kept.

    What is overwritten keeps its permissions, a symbolic link goes on pointing where it did, and all names of a file
    that has several (hard links) name the new content. Pipes and devices are written into.
    """
    requested = Path(path)
    check_new(requested, overwrite)
    stream = _kind(requested) in STREAMS
    try:
        target = requested if stream else Path(os.path.realpath(requested))
        beside = Path(gettempdir()) if stream else target.parent
        temporary = beside / f".{target.stem[:40]}.{secrets.token_hex(8)}{target.suffix}"
    except (OSError, ValueError) as error:  # a ValueError where the name has the character 0
        raise _unwritable(requested, error) from None
    try:  # the name is known before the file exists: an interruption at any moment leaves nothing behind
        os.close(os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600))
        yield temporary
        old = None if stream or not target.exists() else target.stat()
        temporary.chmod(stat.S_IMODE(old.st_mode) if old else 0o666 & ~_umask())
        if stream or (old and old.st_nlink > 1):
            _write_into(target, temporary.read_bytes(), b"" if stream else target.read_bytes())
        else:
            temporary.replace(target)
    except OSError as error:
        raise _unwritable(requested, error) from None
    finally:
        temporary.unlink(missing_ok=True)


def _write_into(target: Path, content: bytes, before: bytes) -> None:
    """Write a file that stays the same file; if that fails, it has what it had before."""
    try:
        with open(target, "wb", buffering=0) as file:
            _write_all(file, content)
    except BaseException:
        if before:
            with open(target, "wb", buffering=0) as file:
                _write_all(file, before)
        raise


def _write_all(file: IO[bytes], content: bytes) -> None:
    done = 0
    while done < len(content):
        done += file.write(content[done:])


def _unwritable(path: Path, error: OSError | ValueError) -> ModelError:
    reason = (getattr(error, "strerror", None) or str(error)).lower()
    return ModelError(f"cannot write {path}: {reason}", "name a file that can be written")


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def check_new_folder(folder: Path, overwrite: bool) -> bool:
    """Raise where a folder cannot be written: before the work; whether it has files, which ``overwrite`` allows."""
    if not folder.parent.is_dir():
        raise ModelError(
            f"cannot write {folder}: folder {folder.parent} does not exist", "create it, or name another"
        )
    if folder.exists() and not folder.is_dir():
        raise ModelError(f"{folder} is a file", "name a folder")
    full = folder.is_dir() and any(folder.iterdir())
    if full and not overwrite:
        raise ModelError(
            f"{folder} has files", "name another folder, or overwrite: --force, in Python overwrite=True"
        )
    return full


@contextmanager
def new_folder(folder: Path) -> Iterator[Path]:
    """A temporary folder that takes the place of `folder`, and of all that is in it, when all is written."""
    beside = folder.parent / f".{folder.name[:40]}.{secrets.token_hex(8)}"
    old = beside.with_suffix(".old")
    try:
        beside.mkdir()
        yield beside
        if folder.exists():
            folder.rename(old)
        beside.rename(folder)
    finally:
        if old.exists() and not folder.exists():
            old.rename(folder)
        for path in (beside, old):
            shutil.rmtree(path, ignore_errors=True)
