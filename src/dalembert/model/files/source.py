"""Source of a description: the file's name and the line of each of its keys."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

Path = tuple[str | int, ...]
Lines = Mapping[Path, int]


STANDARD_INPUT = ("-", "/dev/stdin", "standard input")
"""Names of standard input: as a path, and in messages."""


def is_stream(path: str | os.PathLike[str]) -> bool:
    """True if the path can be read only once and its name means little: standard input, a pipe, `<(...)`, a device."""
    if os.fspath(path) in STANDARD_INPUT:
        return True
    try:
        mode = os.stat(path).st_mode
    except (OSError, ValueError):
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


@dataclass(frozen=True, eq=False)
class FileSource:
    """A file's name, text and format, and its lines by path, computed when first needed.

    >>> FileSource("four.yaml", lambda: {("joints",): 3, ("joints", "A"): 5}).line(("joints", "A", "links", 0))
    5
    """

    name: str
    find: Callable[[], Lines] = field(repr=False)
    text: str = field(default="", repr=False)
    form: str = "yaml"
    data: str = ""
    """Another folder that columns of numbers may be read from."""
    copied: Mapping[Path, Path] = field(default_factory=dict, repr=False)
    """Paths of parts that are copies -> path of the copy that a file states."""

    @property
    def folder(self) -> str:
        """The folder that other files are named from; empty is the current one."""
        return "" if is_stream(self.name) else os.path.dirname(self.name)

    def line(self, path: Sequence[str | int]) -> int:
        """The line of a path down the tree, or of the nearest part around it that has one."""
        lines = self.find()
        for length in range(len(path), 0, -1):
            if tuple(path[:length]) in self.copied:
                return self.line(self.copied[tuple(path[:length])])
            if tuple(path[:length]) in lines:
                return lines[tuple(path[:length])]
        return 1
