"""The file of a document on disk: saved only over what was read, with a side file that keeps what was not saved."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from dalembert.errors import ModelError
from dalembert.model.files.model_files import format_of, save_text
from dalembert.studio.document import LONGEST, text_hash


@dataclass
class StoredFile:
    """A file, the hash of its text when it was last read or written ("" for one that does not exist), and its side
    file ``.NAME.autosave``."""

    path: Path
    known: str = ""

    @property
    def form(self) -> str:
        """The format that the ending of its name says."""
        return format_of(self.path)

    @property
    def side(self) -> Path:
        """The side file, hidden beside it."""
        return self.path.with_name(f".{self.path.name}.autosave")

    def read(self) -> str | None:
        """The text on disk, which is known from now on; None if the file does not exist yet."""
        text = self._content(self.path)
        self.known = "" if text is None else text_hash(text)
        return text

    def outside(self) -> str | None:
        """The text on disk if another program has changed it since it was read or saved."""
        text = self._content(self.path)
        return text if text is not None and text_hash(text) != self.known else None

    def save(self, text: str) -> None:
        """Write the text; raises ModelError where the file has changed since it was read, and for one that cannot be
        written."""
        if self.outside() is not None:
            what = f"{self.path.name} was changed by another program after it was opened here"
            raise ModelError(what, "load what is on disk, or save under another name")
        save_text(text, self.path, overwrite=True)
        self.known = text_hash(text)
        self.discard()

    def keep(self, text: str) -> None:
        """Write the side file, complete or not at all."""
        save_text(text, self.side, overwrite=True)

    def kept(self) -> str | None:
        """The side file's text if it differs from the file's: what was not saved when the studio ended."""
        text = self._content(self.side)
        return text if text is not None and text_hash(text) != self.known else None

    def discard(self) -> None:
        """Take the side file away."""
        self.side.unlink(missing_ok=True)

    def elsewhere(self, name: str) -> StoredFile:
        """A new file of another name in the same folder; raises ModelError for a name with a folder in it, of another
        format, and for one that exists."""
        if (
            not name
            or name != os.path.basename(name.replace("\\", "/"))
            or name.startswith(".")
            or "\0" in name
        ):
            raise ModelError(
                f"{name!r} is not the name of a file in this folder", "give a name without a folder"
            )
        other = StoredFile(self.path.with_name(name))
        if other.form != self.form:
            raise ModelError(
                f"{name} has another format than {self.path.name}", "keep the ending of the name"
            )
        if other.path.exists():
            raise ModelError(f"{name} exists", "choose another name")
        return other

    def _content(self, path: Path) -> str | None:
        try:
            content = path.read_bytes()
        except FileNotFoundError:
            return None
        except OSError as error:
            raise ModelError(
                f"{path.name} cannot be read: {error.strerror}", "check its permissions"
            ) from None
        if len(content) > LONGEST:
            what = f"{path.name} has {len(content)} bytes, more than {LONGEST}"
            raise ModelError(what, "the studio takes smaller files; keep tables in a file beside it")
        try:
            return content.decode("utf-8")
        except UnicodeDecodeError:
            raise ModelError(f"{path.name} is not UTF-8 text", "save it as UTF-8") from None
