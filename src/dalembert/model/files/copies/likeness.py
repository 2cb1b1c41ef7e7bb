"""Relation of a copy of links to its original: its angles count full turns as the image's do."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace


@dataclass(frozen=True)
class Likeness:
    """One copy: side 1, or -1 of a reflected one; offsets: links that stay -> angle of their image against them, rad.

    The others map a name of the copy to that of the original. An angle of the copy is side times that of the original
    plus an offset, where the drives have the image's positions.

    >>> Likeness(-1, {"ground": 3.0}, {"rod_2": "rod"}).between("ground", "rod_2")
    3.0
    """

    side: int
    offsets: Mapping[str, float]
    links: Mapping[str, str] = field(default_factory=dict)
    joints: Mapping[str, str] = field(default_factory=dict)
    drives: Mapping[str, str] = field(default_factory=dict)

    def between(self, i: str, j: str) -> float:
        """Angle of j against i, one of them a copy's, minus that of the image; radians."""
        a, b = (0.0 if link in self.links else self.offsets.get(link, 0.0) for link in (i, j))
        return a - b

    def staying(self, i: str, j: str) -> float:
        """Angle of j against i, links that are not copied, minus that in the image's position; radians."""
        return self.offsets.get(i, 0.0) - self.offsets.get(j, 0.0)

    def without(self, links: Iterable[str], ends: Mapping[str, tuple[str, ...]]) -> Likeness:
        """The likeness of what does not touch these links, whose angles are stated by themselves; ``ends``: links of
        joints."""
        stated = set(links)
        joints = {new: of for new, of in self.joints.items() if not stated & set(ends.get(new, ()))}
        return replace(self, links={k: v for k, v in self.links.items() if k not in stated}, joints=joints)
