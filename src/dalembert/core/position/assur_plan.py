"""Groups of links of a planar linkage, from its joints alone, in the order in which they are placed.

With the drives known, the conditions split into groups that are solved one after another (Assur, 1916; the block
triangular form of ``core.position.assur_groups``). Each condition between two links i and j is

    n . (P_j + R_j u_j - P_i - R_i u_i) = target

with n ground's x and y for points that coincide, an axis of i for a slide. Links with a prescribed relative angle turn
together: all of them follow a leader's angle.

Mechanics: docs/theory.md 3.1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.core.layout import Along, Distance, Layout, Meet, Turn
from dalembert.core.position.assur_groups import block_triangular


class Conditions(NamedTuple):
    """Scalar conditions (K,): links i and j, arms (K, 2), the axis n in the axes of link ``frame``, the target's row.

    Of ``far`` ones the axis is the line of the two points: they hold their distance.
    """

    i: Ints
    j: Ints
    frame: Ints
    ui: Array
    uj: Array
    axis: Array
    row: Ints
    far: Flags

    def at(self, rows: list[int]) -> Conditions:
        """Some of them."""
        parts: Any = (part[rows] for part in self)
        return Conditions(*parts)


@dataclass(frozen=True)
class AssurGroup:
    """A group: its conditions, the unknown coordinates of its links, the links that turn with each unknown angle.

    ``links`` are all links that it involves; the other fields index into this list.
    """

    links: Ints
    conditions: Conditions
    link: Ints  # (p,)
    axis: Ints  # (p,)
    turning: tuple[Ints, ...]
    separate: bool  # each condition determines one coordinate, along an axis of ground

    @cached_property
    def incidence(self) -> Array:
        """1 where a coordinate is that of link j of a condition, -1 of link i (K, p)."""
        c = self.conditions
        return np.asarray((c.j[:, None] == self.link) * 1.0 - (c.i[:, None] == self.link))

    @cached_property
    def turned(self) -> list[tuple[Flags, ...]]:
        """For each unknown angle, the conditions (K, 1) whose link i, whose link j and whose axis turn with it."""
        c = self.conditions
        ends = np.stack([c.i, c.j, c.frame])[..., None]
        return [tuple((ends == links).any(axis=-1, keepdims=True)) for links in self.turning]

    @cached_property
    def some(self) -> tuple[Flags, ...]:
        """The conditions (K, 1) whose arm on i, arm on j and axis is not 0."""
        c = self.conditions
        return tuple((u != 0).any(axis=-1, keepdims=True) for u in (c.ui, c.uj, c.axis))

    @cached_property
    def sliding(self) -> int:
        """Conditions along axes that turn with an unknown angle."""
        return sum(int(turned[2].sum()) for turned in self.turned)

    @cached_property
    def closed(self) -> bool:
        """True if the group has a closed form (``core.position.dyads``)."""
        count = len(self.turning)
        return not self.conditions.far.any() and (count < 2 or (count == 2 and not self.sliding))


@dataclass(frozen=True)
class PlacementPlan:
    """Order in which links are placed: angles that follow from others, then group after group.

    turns   a link, the one it turns with, sign and row of the angle between them, in an order that starts from leaders
    """

    links: int
    turns: tuple[tuple[int, int, float, int], ...]
    groups: tuple[AssurGroup, ...]

    @cached_property
    def closed(self) -> bool:
        """True if every group has a closed form."""
        return all(group.closed for group in self.groups)


def plan(layout: Layout) -> PlacementPlan | None:
    """The plan of a layout without phases; None where its conditions are too few, too many or repeated."""
    if layout.stack.count != layout.unknowns or layout.algebra.d != 2:
        return None
    turns, leader = _turns(layout)
    conditions = _conditions(layout)
    held = sum(len(f.row) for f in layout.stack.families if isinstance(f, Turn))
    if len(turns) != held or conditions is None:
        return None
    heads, places = sorted(set(leader.tolist()) - {layout.links}), 2 * layout.links
    angles = {head: places + k for k, head in enumerate(heads)}
    entries = [_entries(conditions, k, leader, angles) for k in range(len(conditions.i))]
    blocks = block_triangular(entries, places + len(heads))
    if blocks is None:
        return None
    groups = []
    for (rows, columns), separate in _side_by_side(blocks, entries, conditions, layout.links):
        link = np.array([c for c in columns if c < places], np.intp)
        turning = [np.flatnonzero(leader == heads[c - places]) for c in columns if c >= places]
        groups.append(_group(conditions.at(rows), link // 2, link % 2, turning, separate))
    return PlacementPlan(layout.links, turns, tuple(groups))


Block = tuple[list[int], list[int]]
"""Conditions, and the unknowns that they determine."""


def _side_by_side(
    blocks: list[Block], entries: list[list[int]], c: Conditions, ground: int
) -> list[tuple[Block, bool]]:
    """Coordinates that one condition each determines, along ground's axes, joined where none depends on another (True):
    those of long chains are then placed at once. The other blocks stay in their order."""
    place: dict[int, tuple[int, int]] = {}
    joined: dict[tuple[int, int], Block] = {}
    count = 0
    for rows, columns in blocks:
        unknowns = set(columns)
        after = max((place[x] for row in rows for x in entries[row] if x not in unknowns), default=(0, 0))
        separate = len(rows) == 1 and columns[0] < 2 * ground
        if separate and c.frame[rows[0]] == ground and not c.far[rows[0]]:
            key = after[0], after[1] + 1
        else:
            count += 1
            key = count, 0
        place |= dict.fromkeys(columns, key)
        entry = joined.setdefault(key, ([], []))
        entry[0].extend(rows)
        entry[1].extend(columns)
    return [(joined[key], key[1] > 0) for key in sorted(joined)]


def _group(c: Conditions, link: Ints, axis: Ints, turning: list[Ints], separate: bool) -> AssurGroup:
    """The group of the links involved in some conditions."""
    links = np.unique(np.concatenate([c.i, c.j, c.frame, link, *turning]))
    i, j, frame, place, *turns = (
        np.searchsorted(links, part) for part in (c.i, c.j, c.frame, link, *turning)
    )
    return AssurGroup(links, c._replace(i=i, j=j, frame=frame), place, axis, tuple(turns), separate)


def _turns(layout: Layout) -> tuple[tuple[tuple[int, int, float, int], ...], Ints]:
    """Angles that follow from others by rows that hold relative angles; the leader of each link, ground where fixed."""
    rows = [
        (int(i), int(j), int(row))
        for f in layout.stack.families
        if isinstance(f, Turn)
        for i, j, row in zip(f.i, f.j, f.row, strict=True)
    ]
    leader, out = np.full(layout.links + 1, -1, np.intp), []
    for head in (layout.links, *range(layout.links)):
        if leader[head] >= 0:
            continue
        leader[head] = head
        queue = [head]
        for known in queue:
            for i, j, row in rows:
                new, sign = (j, 1.0) if i == known else (i, -1.0)
                if known in (i, j) and leader[new] < 0:
                    leader[new] = head
                    out.append((new, known, sign, row))
                    queue.append(new)
    return tuple(out), leader


def _conditions(layout: Layout) -> Conditions | None:
    """The rows but for those of angles; None where there are others than points, slides and distances."""
    ground, parts = layout.links, []
    for f in layout.stack.families:
        count, none = len(f.i), np.zeros(len(f.i), bool)
        if isinstance(f, Meet):
            for k, axis in enumerate(np.eye(2)):
                frame, axes = np.full(count, ground), np.tile(axis, (count, 1))
                parts.append(Conditions(f.i, f.j, frame, f.ui, f.uj, axes, f.row[:, k], none))
        elif isinstance(f, Along) and not f.pitch.any():
            parts.append(Conditions(f.i, f.j, f.i, f.ui, f.uj, f.axis, f.row, none))
        elif isinstance(f, Distance):
            frame, axes = np.full(count, ground), np.zeros((count, 2))
            parts.append(Conditions(f.i, f.j, frame, f.ui, f.uj, axes, f.row, ~none))
        elif not isinstance(f, Turn):
            return None
    return Conditions(*(np.concatenate(part) for part in zip(*parts, strict=True))) if parts else None


def _entries(c: Conditions, k: int, leader: Ints, angles: dict[int, int]) -> list[int]:
    """Unknowns of a condition: coordinates 2 link + axis, then the angles by their leaders."""
    ground, frame = len(leader) - 1, int(c.frame[k])
    unknowns = {angles.get(int(leader[frame]), -1)}
    for link, arm in ((int(c.i[k]), c.ui[k]), (int(c.j[k]), c.uj[k])):
        if link != ground:
            unknowns |= {2 * link + a for a in range(2) if c.axis[k, a] or c.far[k] or frame != ground}
            unknowns |= {angles.get(int(leader[link]), -1)} if arm.any() else set()
    return sorted(unknowns - {-1})
