"""Writing files: what exists is kept unless told otherwise, and a file appears whole or not at all."""

from __future__ import annotations

import os
import secrets
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from dalembert.errors import DalembertError, ModelError


def check_installed(package: str, what: str, extra: str = "results") -> None:
    """Raise where an optional package is missing, with the line that installs it."""
    from importlib.util import find_spec

    if find_spec(package) is None:
        remedy = f"pip install 'dalembert[{extra}]'"
        raise DalembertError(f"{what} needs the package {package}, which is not installed; {remedy}")


def check_new(path: Path, overwrite: bool) -> None:
    """Raise where a file cannot be new: before the work, not behind it."""
    if os.path.isdir(path):
        raise ModelError(f"{path} is a folder", "name a file in it")
    if not os.path.isdir(path.parent):
        raise ModelError(f"cannot write {path}: there is no folder {path.parent}", "make it, or name another")
    if os.path.exists(path) and not overwrite:
        raise ModelError(
            f"{path} exists", "name another file, or overwrite it: --force, in Python overwrite=True"
        )


@contextmanager
def new_file(path: str | os.PathLike[str], overwrite: bool = False) -> Iterator[Path]:
    """A temporary file beside `path` that takes its place when all is written; an existing one is kept.

    What is overwritten keeps its permissions, and a symbolic link goes on pointing where it did.
    """
    asked = Path(path)
    check_new(asked, overwrite)
    try:
        target = Path(os.path.realpath(asked))
        temporary = target.with_name(f".{target.stem[:40]}.{secrets.token_hex(8)}{target.suffix}")
    except (OSError, ValueError) as error:  # a ValueError where the name has the character 0
        raise _unwritable(asked, error) from None
    try:  # the name is known before the file exists: an interruption at any moment leaves nothing behind
        os.close(os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600))
        yield temporary
        temporary.chmod(stat.S_IMODE(target.stat().st_mode) if target.exists() else 0o666 & ~_umask())
        temporary.replace(target)
    except OSError as error:
        raise _unwritable(asked, error) from None
    finally:
        temporary.unlink(missing_ok=True)


def _unwritable(path: Path, error: OSError | ValueError) -> ModelError:
    said = (getattr(error, "strerror", None) or str(error)).lower()
    return ModelError(f"cannot write {path}: {said}", "name a file that can be written")


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
