"""Plane joints as rows: freedoms by name, constraints by complement; higher pairs by their constraints.

A kind of joint that slides or turns needs nothing here but the ``FREEDOMS`` of its class; one that does not, a row in
``HIGHER``. The local axes of a joint are `slide` (its direction, in i's axes), `across` and `turn`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from dalembert.arrays import Array, Numeric, Tree
from dalembert.core.elements.cam_curves import same_count
from dalembert.core.elements.cam_family import CamGap
from dalembert.core.elements.strand_family import Strand
from dalembert.core.layout import (
    Along,
    Angle,
    BeltMesh,
    Distance,
    Family,
    Idle,
    Meet,
    Mesh,
    Perpendicular,
    Rows,
    ToothCouple,
    Turn,
)
from dalembert.model.joints.elements.belts import Belt
from dalembert.model.joints.elements.ropes import StrandJoint
from dalembert.model.joints.plane_joints import CircularSlot, Gear, Joint, Rolling

Vector = tuple[float, float]

ANGULAR = (Turn, Angle, Perpendicular, Idle, ToothCouple)
"""Families whose measure is an angle and whose wrench is a couple."""


class RowBuilder:
    """Collects rows one by one, then groups them into families."""

    def __init__(self, links: int, dimension: int = 2) -> None:
        self.links, self.dimension, self.counted = links, dimension, 0
        self.targets: list[float] = []
        self._joint: list[int] = []
        self._angular: list[bool] = []
        self._families: dict[type, list[Tree]] = {}
        self._ropes: dict[str, int] = {}

    def add(
        self, kind: type, joint: int, ends: tuple[int, int], target: Numeric = 0.0, **numbers: object
    ) -> int:
        """One row (one a ground axis for ``Meet``) between links i and j; returns its place."""
        count = self.dimension if kind is Meet else 1
        first = len(self.targets)
        row: object = tuple(range(first, first + count)) if kind is Meet else first
        self.targets += [target] * count
        self._joint += [joint] * count
        self._angular += [kind in ANGULAR] * count
        self._families.setdefault(kind, []).append({"row": row, "i": ends[0], "j": ends[1], **numbers})
        return first

    def next_counted_angle(self) -> int:
        """Index of another relative angle whose full turns are counted."""
        self.counted += 1
        return self.counted - 1

    def number_of(self, rope: str) -> int:
        """A number for each rope."""
        return self._ropes.setdefault(rope, len(self._ropes))

    def rows(self) -> Rows:
        """All of them, frozen."""
        families = tuple(_family(kind, entries) for kind, entries in self._families.items())
        joint, angular = np.array(self._joint, np.intp), np.array(self._angular, bool)
        return Rows(len(self.targets), self.links, families, joint, angular)


def _family(kind: type, entries: list[Tree]) -> Family:
    columns: Tree = {}
    for name in entries[0]:
        is_index = name in ("row", "i", "j", "end_a", "end_b", "count", "rope", "form")
        values = [e[name] for e in entries]
        if name == "curve":
            values = same_count(values)
        columns[name] = np.array(values, np.intp) if is_index else numbers(values)
    family: Family = kind(**columns)
    return family


def numbers(values: object) -> Array:
    """An array of floats; of symbols where some are (the kernel is traced on them)."""
    array = np.asarray(values)
    return array if array.dtype.kind in "fO" else array.astype(float)


def direction(joint: Joint) -> Array:
    """Unit vector of the slide in i's axes; x where the joint has none."""
    angle = getattr(joint, "direction", 0.0) or 0.0
    return np.array([np.cos(angle), np.sin(angle)])


def add_constraints(
    rows: RowBuilder, index: int, joint: Joint, ends: tuple[int, int], ui: Array, uj: Array
) -> None:
    """Rows of a joint's constraints; of one whose contact is opened those that it has besides."""
    if not joint.gaps:
        _add_all_constraints(rows, index, joint, ends, ui, uj)
        return
    for kind, numbers in opened_rows(joint, ends, ui, uj)[len(joint.gaps) :]:
        rows.add(kind, index, ends, **numbers)


def opened_rows(
    joint: Joint, ends: tuple[int, int], ui: Array, uj: Array
) -> list[tuple[type, dict[str, Any]]]:
    """Constraints of a joint by kind, those that its contact has first; a guide's with lengths are its ends'."""
    if joint.outlined:
        return [(CamGap, {})]
    value = CapturedRows()
    _add_all_constraints(value, 0, joint, ends, ui, uj)  # type: ignore[arg-type]
    if joint.lifted != ("gap_behind", "gap_ahead"):
        return value.rows
    guide: Any = joint
    behind, ahead = guide.friction.guide
    along = np.array([np.cos(guide.angle), -np.sin(guide.angle)])
    kind, numbers = value.rows[0]
    return [(kind, numbers | {"uj": uj + reach * along}) for reach in (-behind, ahead)]


class CapturedRows:
    """Rows that are only noted: their kinds and numbers."""

    def __init__(self) -> None:
        self.rows: list[tuple[type, dict[str, Any]]] = []

    def add(self, kind: type, joint: int, ends: tuple[int, int], **numbers: Any) -> None:
        """One row."""
        self.rows.append((kind, numbers))


def _add_all_constraints(
    rows: RowBuilder, index: int, joint: Joint, ends: tuple[int, int], ui: Array, uj: Array
) -> None:
    """Constraints that its freedoms leave over, or those of a higher pair."""
    higher = HIGHER.get(joint.type)
    if higher is not None:
        higher(rows, index, joint, ends, ui, uj)
        return
    if not joint.slides:
        rows.add(Meet, index, ends, ui=ui, uj=uj)
    else:
        across = _across(direction(joint))
        rows.add(Along, index, ends, ui=ui, uj=uj, axis=across, pitch=0.0)
    if "turn" not in joint.freedoms:
        rows.add(Turn, index, ends, target=_fixed_angle(joint))


def _fixed_angle(joint: Any) -> Numeric:
    """Angle of j's axes to i's where the joint fixes it."""
    return joint.angle + getattr(joint, "direction", 0.0)


def _across(e: Array) -> Array:
    return np.array([-e[1], e[0]])


def add_freedom(
    rows: RowBuilder, index: int, joint: Joint, ends: tuple[int, int], ui: Array, uj: Array
) -> None:
    """Rows of a joint's freedoms, in their order."""
    for name in joint.FREEDOMS:
        if name == "slide":
            rows.add(Along, index, ends, ui=ui, uj=uj, axis=direction(joint), pitch=0.0)
        else:
            rows.add(Turn, index, ends)
    for kind, numbers in opened_rows(joint, ends, ui, uj)[: len(joint.gaps)] if joint.gaps else ():
        rows.add(kind, index, ends, **numbers)


def _gear(rows: RowBuilder, index: int, joint: Gear, ends: tuple[int, int], ui: Array, uj: Array) -> None:
    ri, rj = signed_radii(joint)
    rows.add(Mesh, index, ends, ui=ui, uj=uj, ri=ri, rj=rj)


def signed_radii(joint: Gear | Rolling | Belt) -> Vector:
    """Pitch radii of i and j; of an internal pair the inner (smaller) wheel's is negative, so that their sum is the
    distance of the centres; of an open belt j's."""
    if isinstance(joint, Belt):
        return joint.signed_radii
    ri, rj = joint.pitch_radii
    if not joint.internal:
        return ri, rj
    return (ri, -rj) if ri > rj else (-ri, rj)


def _rolling(
    rows: RowBuilder, index: int, joint: Rolling, ends: tuple[int, int], ui: Array, uj: Array
) -> None:
    """A wheel on a line stays at its radius from it and rolls: e . span + r theta is constant."""
    if joint.radii is not None:
        ri, rj = signed_radii(joint)
        rows.add(Distance, index, ends, target=ri + rj, ui=ui, uj=uj)
        rows.add(Mesh, index, ends, ui=ui, uj=uj, ri=ri, rj=rj)
        return
    e, r = direction(joint), joint.radius
    rows.add(Along, index, ends, target=r, ui=ui, uj=uj, axis=_across(e), pitch=0.0)
    rows.add(Along, index, ends, ui=ui, uj=uj, axis=e, pitch=r)


def _circular_slot(
    rows: RowBuilder, index: int, joint: CircularSlot, ends: tuple[int, int], ui: Array, uj: Array
) -> None:
    rows.add(Distance, index, ends, target=joint.radius, ui=ui, uj=uj)


def _belt(rows: RowBuilder, index: int, joint: Belt, ends: tuple[int, int], ui: Array, uj: Array) -> None:
    ri, rj = joint.signed_radii
    rows.add(BeltMesh, index, ends, ui=ui, uj=uj, ri=ri, rj=rj)


def _strand(
    rows: RowBuilder, index: int, joint: StrandJoint, ends: tuple[int, int], ui: Array, uj: Array
) -> None:
    (ri, rj), (wi, wj), e = joint.radii, joint.winds, joint.direction
    axis = np.zeros(2) if e is None else np.array([np.cos(e), np.sin(e)])
    numbers = {"ri": ri, "rj": rj, "wi": wi, "wj": wj, "axis": axis, "zero": np.array([1.0, 0.0])}
    rows.add(Strand, index, ends, rope=rows.number_of(joint.rope), ui=ui, uj=uj, **numbers)


def _one_way(rows: RowBuilder, index: int, joint: Any, ends: tuple[int, int], ui: Array, uj: Array) -> None:
    """A clutch that holds keeps the angle between its links; one that is released, nothing."""
    if not joint.RELEASED:
        rows.add(Turn, index, ends, target=joint.angle)


HIGHER: dict[str, Callable[..., None]] = {
    "belt": _belt,
    "circular_slot": _circular_slot,
    "strand": _strand,
    "gear": _gear,
    "one_way": _one_way,
    "ratchet": _one_way,
    "rolling": _rolling,
}
"""Joints that are given by their constraints."""
