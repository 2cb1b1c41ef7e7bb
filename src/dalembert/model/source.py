"""Where a description came from: the file's name and the line of each of its keys."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

Path = tuple[str | int, ...]
Lines = Mapping[Path, int]


@dataclass(frozen=True)
class Source:
    """A file's name, and its lines by path, found when first asked for.

    >>> Source("four.yaml", lambda: {("joints",): 3, ("joints", "A"): 5}).line(("joints", "A", "links", 0))
    5
    """

    name: str
    find: Callable[[], Lines] = field(repr=False, compare=False)

    def line(self, path: Sequence[str | int]) -> int:
        """The line of a path down the tree, or of the nearest part around it that has one."""
        lines = self.find()
        for length in range(len(path), 0, -1):
            if tuple(path[:length]) in lines:
                return lines[tuple(path[:length])]
        return 1
