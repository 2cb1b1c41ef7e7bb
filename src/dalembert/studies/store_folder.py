"""A store of a study in a folder: completed by a rename, and written by one run at a time under a system lock."""

from __future__ import annotations

import importlib
import os
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from socket import gethostname
from typing import Any

from dalembert.errors import ModelError

BEHIND = 1 << 20
"""Place of the byte that is locked on Windows, where nobody can read what is locked."""

KEPT = "finished blocks are kept: make room, and resume"


def this_run() -> str:
    """This process, in words for those whom its lock keeps out."""
    return f"process {os.getpid()} on {gethostname()} since {time.strftime('%Y-%m-%d %H:%M:%S')}"


class Folder:
    """A folder on a disk."""

    errors: tuple[type[Exception], ...] = (OSError,)
    """Errors raised where it cannot be read or written."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)

    def __str__(self) -> str:
        return str(self.path)

    def group(self) -> Any:
        """The store that zarr uses for the group."""
        return str(self.path)

    def exists(self) -> bool:
        """True if a study exists; raises ModelError where something else exists."""
        if not self.path.exists():
            return False
        if (self.path / "ledger" / "zarr.json").is_file():
            return True
        if self.path.is_dir() and not any(self.path.iterdir()):
            return False
        raise ModelError(f"{self.path} exists and is not a study", "give another name")

    def create(self, fill: Callable[[Any], None]) -> None:
        """Creates it beside its place and renames it, so that it is never partly visible."""
        new = self.path.with_name(self.path.name + ".new")
        shutil.rmtree(new, ignore_errors=True)
        fill(str(new))
        if self.path.exists():
            self.path.rmdir()
        new.rename(self.path)

    def remove(self, key: str) -> None:
        """Deletes a chunk, if it exists."""
        (self.path / key).unlink(missing_ok=True)

    def sweep(self) -> None:
        """Remove half-written files of a run that was killed: zarr writes beside and renames."""
        for path in self.path.rglob("*.partial"):
            path.unlink()

    def check(self) -> None:
        """Does nothing: the lock is not lost while the process runs."""

    @contextmanager
    def locked(self) -> Iterator[None]:
        """One run at a time: a lock on a file beside it, released by the system when its process dies."""
        path = self.path.with_name(self.path.name + ".lock")
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            file = os.open(path, os.O_RDWR | os.O_CREAT, 0o644)
        except OSError as error:
            raise unwritable(self, error) from None
        try:
            try:
                _lock(file)
            except OSError:
                who = os.read(file, 200).decode(errors="replace") or "another process"
                raise ModelError(f"{self} is being written by {who}", "wait for it, or end it") from None
            os.ftruncate(file, 0)
            os.write(file, this_run().encode())
            yield
        finally:
            os.close(file)


def _lock(file: int) -> None:
    """Locks an open file for this process; OSError where another one has it. Without system locks, as in a browser, it
    does nothing."""
    try:
        import fcntl
    except ImportError:
        _lock_on_windows(file)
    else:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


def _lock_on_windows(file: int) -> None:
    """A byte far behind the text, which others can still read."""
    try:
        msvcrt: Any = importlib.import_module("msvcrt")
    except ImportError:
        return
    os.lseek(file, BEHIND, os.SEEK_SET)
    try:
        msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
    finally:
        os.lseek(file, 0, os.SEEK_SET)


def unwritable(place: object, error: Exception) -> ModelError:
    """The sentence for a disk that is full, read-only, or gone; and for an object store that does not answer."""
    reason = getattr(error, "strerror", None) or str(error).strip() or type(error).__name__
    return ModelError(f"{place} cannot be written: {reason[:1].lower()}{reason[1:].splitlines()[0]}", KEPT)
