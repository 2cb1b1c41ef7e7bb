"""Gaps of contacts that push: which freedom of a joint each is, and how it is named.

Mechanics: docs/theory.md 10.7.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np

from dalembert.analysis.compile.contacts import has_friction
from dalembert.analysis.compile.plane_rows import opened_rows
from dalembert.analysis.compile.pushing_contacts import pushing_sign
from dalembert.model import Mechanism
from dalembert.model.drives.end_stops import Stops

ENDS = {"gap_behind": " at its rear end", "gap_ahead": " at its front end"}
"""Words for a guide's ends."""


@dataclass(frozen=True)
class GapContact:
    """A contact of a joint: the ``freedom`` that is its gap, measured from ``at``, positive on the ``side`` of j.

    drive: number of the drive that has this freedom, -1 where it has a stop; slip: of that along a wheel's track;
    rough: friction limits the force along it.
    """

    joint: str
    freedom: str
    side: float
    at: float
    restitution: float
    drive: int = -1
    slip: int = -1
    rough: bool = False

    @property
    def name(self) -> str:
        """Its name in `normal.NAME` and `gap.NAME`."""
        return self.joint + {"gap_behind": ".behind", "gap_ahead": ".ahead"}.get(self.freedom, "")

    @property
    def where(self) -> str:
        """Name of the end of a guide, in a sentence."""
        return ENDS.get(self.freedom, "")

    @property
    def stops(self) -> Stops:
        """The gap as a stop of its freedom."""
        least, greatest = (self.at, inf) if self.side > 0 else (-inf, self.at)
        return Stops(least, greatest, self.restitution, "length")


def contacts_of(m: Mechanism, joint: str) -> Iterator[GapContact]:
    """The contacts of a joint, its gap each."""
    part: Any = m.joints[joint]
    ends = (np.zeros(2), np.zeros(2))
    rows = opened_rows(part, (0, 1), *ends)
    for freedom, (_, numbers) in zip(part.lifted, rows, strict=False):
        if freedom != "slip":
            sign, at = pushing_sign(part), float(numbers.get("target", 0.0))
            rough = "slip" in part.lifted and has_friction(m, part)
            yield GapContact(joint, freedom, sign, at, part.contact.restitution, rough=rough)


def contact_stops(m: Mechanism) -> dict[tuple[str, str], Stops]:
    """Gaps of opened contacts that no drive has, as stops of their joints' freedoms."""
    return {
        (name, contact.freedom): contact.stops
        for name, joint in m.joints.items()
        if joint.gaps and joint.contact.opened == "stop"  # type: ignore[union-attr]
        for contact in contacts_of(m, name)
    }


def added_drives(contacts: Sequence[GapContact]) -> int:
    """Number of drives that gaps and slips of contacts are, behind those of the description."""
    return sum(1 + (c.slip >= 0) for c in contacts if c.drive >= 0 and c.freedom != "slide")
