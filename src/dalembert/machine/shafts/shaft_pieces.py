"""A shaft of several links in one line, welded end to end, each with a section: their places along it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from dalembert.errors import ModelError
from dalembert.machine.members.member_forces import member_forces
from dalembert.machine.members.struts import PlacedMember
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.machine.members.straight_members import Straight

NEAR = 1e-9
"""Part of the first piece's length by which another may be off its line, or off its end."""


@dataclass(frozen=True)
class ShaftPiece:
    """One link of a shaft: its member, E I in N m2, and where along the shaft the member begins, with its sense."""

    link: str
    member: Straight
    stiffness: float
    joints: Mapping[str, float]
    start: float
    sense: float

    def place(self, s: float) -> float:
        """Place along the shaft of a distance along the member."""
        return float(self.start + self.sense * s)

    @property
    def ends(self) -> tuple[float, float]:
        """Least and greatest place."""
        low, high = sorted((self.start, self.place(self.member.length)))
        return low, high


def shaft_pieces(r: Result, link: str) -> list[ShaftPiece]:
    """The pieces of the shaft that a link is part of, in their order; raises ModelError where they leave a gap."""
    first, line = _placed(r, link)
    pieces, todo = {link: first}, [link]
    while todo:
        for other in _welded_to(r, todo.pop()):
            section = r.mechanism.links[other].section
            if other in pieces or section is None or section.elasticity is None:
                continue
            piece = _placed(r, other, line)[0]
            if piece.sense:
                pieces[other] = piece
                todo.append(other)
    ordered = sorted(pieces.values(), key=lambda p: p.ends)
    least = ordered[0].ends[0]
    for a, b in pairwise(ordered):
        if abs(b.ends[0] - a.ends[1]) > NEAR * line.length:
            what = f"links {a.link!r} and {b.link!r} of a shaft do not meet end to end"
            raise ModelError(what, "name their ends: members: [A, B]", ("links", b.link))
    moved = (ShaftPiece(p.link, p.member, p.stiffness, p.joints, p.start - least, p.sense) for p in ordered)
    return list(moved)


def _welded_to(r: Result, link: str) -> list[str]:
    """Other links that are welded to one."""
    joints = (j for j in r.mechanism.joints.values() if link in j.links and not j.freedoms)
    return [n for j in joints for n in j.links if n not in (link, GROUND)]


def _placed(r: Result, link: str, line: PlacedMember | None = None) -> tuple[ShaftPiece, PlacedMember]:
    """A link along a line, that of the link itself by default; of sense 0 where it is off it."""
    forces, section = member_forces(r, link), r.mechanism.links[link].section
    assert section is not None
    assert section.elasticity is not None
    if len(forces.curves) > 1:
        raise ModelError(
            f"link {link!r} has several members, and a shaft is one line",
            "name its ends: members: [A, B]",
            ("links", link),
        )
    placed = PlacedMember(forces, forces.curves[0])
    along = line or placed
    known = np.flatnonzero(np.isfinite(placed.start).all(axis=1) & np.isfinite(along.start).all(axis=1))
    if not known.size:
        raise ModelError(f"no position has a pose of link {link!r}", "see the reasons: dalembert solve")
    k = known[0]
    away, t = placed.start[k] - along.start[k], along.axes[k][0]
    sense, start = float(placed.axes[k][0] @ t), float(away @ t)
    off = float(np.linalg.norm(away - start * t)) / along.length
    straight = off <= NEAR and abs(abs(sense) - 1) <= NEAR
    joints = {n: float(np.nanmean(s)) for n, s in placed.joints.items()}
    stiffness = section.elasticity * min(section.second_moments)
    member = forces.curves[0].member
    return ShaftPiece(link, member, stiffness, joints, start, np.sign(sense) if straight else 0.0), placed
