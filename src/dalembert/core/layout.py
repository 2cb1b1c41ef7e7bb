"""Compiled form of a description: integers that no numeric value changes (Rows), and numeric arrays.

L   moving links; ground is link number L, the last
K   rows (constraints, or freedoms) of a system
d,n components of a force (2, 3) and of a wrench (3, 6)

A *row* is one scalar condition between two links i and j: its measure m(q), the wrench it exerts on j per unit of
multiplier, and the drift, the part of the second derivative of m that does not contain accelerations. Constraints keep
their measure at a target; freedoms are the same thing left free, driven, damped or sprung (docs/theory.md 1).

All arms (``ui``, ``uj``) are in link axes from the link's reference point. Shapes: (K, d), or (design, 1, K, d).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from dalembert.algebra import plane, space
from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array, Flags, Index, Ints
from dalembert.core.elements.cam_family import CamRow
from dalembert.core.elements.linings import BandStrands, Lining
from dalembert.core.elements.strand_family import Strand, StrandSum
from dalembert.core.elements.tooth_families import Gearing as Gearing
from dalembert.core.elements.tooth_families import Teeth as Teeth
from dalembert.core.elements.tooth_families import ToothCouple as ToothCouple
from dalembert.core.elements.tooth_families import ToothForce as ToothForce


class Pose(NamedTuple):
    """Pose of all links, ground last.

    point (..., L+1, d) reference points in ground axes. In the plane turn (..., L+1) are the links' angles, not reduced
    to one turn, and rotation (..., L+1, 2) their cosines and sines. In space rotation (..., L+1, 9) are matrices, and
    turn (..., T) the relative angles of the rows that count whole turns, accurate enough to identify the turn.
    """

    point: Array
    turn: Array
    rotation: Array

    def at(self, index: Index) -> Pose:
        """The poses at an index of the leading axes."""
        return Pose(self.point[index], self.turn[index], self.rotation[index])


@dataclass(frozen=True)
class Meet:
    """A point of j stays on a point of i: d rows, one a ground axis. Measure P_j - P_i."""

    row: Ints  # (k, d) places of the rows in the system
    i: Ints
    j: Ints
    ui: Array
    uj: Array


@dataclass(frozen=True)
class Along:
    """Coordinate of j's point along an axis fixed in i, plus pitch times the relative turn.

    Measure e . (P_j - P_i) + pitch (theta_j - theta_i); the force acts at P_j.
    """

    row: Ints
    i: Ints
    j: Ints
    ui: Array
    uj: Array
    axis: Array  # (k, d) in i's axes
    pitch: Array  # (k,)


@dataclass(frozen=True)
class Turn:
    """Relative angle theta_j - theta_i; a pure couple."""

    row: Ints
    i: Ints
    j: Ints


@dataclass(frozen=True)
class Mesh:
    """Pitch circles of signed radii that roll on each other at the pitch point, centres free to move.

    Measure r_i (theta_i - phi) + r_j (theta_j - phi) with phi the angle of the line from centre i to centre j; a
    ring wheel has a negative radius. The tangential force acts at the pitch point.
    """

    row: Ints
    i: Ints
    j: Ints
    ui: Array
    uj: Array
    ri: Array
    rj: Array
    touches = True


@dataclass(frozen=True)
class BeltMesh(Mesh):
    """A belt round wheels whose centres are apart: the row of a mesh, r_j negative where they turn in the same sense.

    The multiplier is the difference of both strands' tensions; its force is reported at j's point, with the couple.
    """

    touches = False


@dataclass(frozen=True)
class Distance:
    """Distance of a point of j from a point of i."""

    row: Ints
    i: Ints
    j: Ints
    ui: Array
    uj: Array


@dataclass(frozen=True)
class Perpendicular:
    """In space: a direction of i perpendicular to one of j. Measure a . p; a pure couple along p x a."""

    row: Ints
    i: Ints
    j: Ints
    a: Array  # (k, 3) unit vector in i's axes
    p: Array  # (k, 3) unit vector in j's axes


@dataclass(frozen=True)
class Angle:
    """In space: angle of the direction p of j about the axis a of i, from b of i; a pure couple.

    Measure atan2(p . (a x b), p . b), with whole turns counted in ``turn`` of the pose at ``count``.
    """

    row: Ints
    i: Ints
    j: Ints
    a: Array
    b: Array  # (k, 3) perpendicular to a
    p: Array
    count: Ints


@dataclass(frozen=True)
class Helix:
    """In space: coordinate of j's point along the axis a of i, plus pitch times the angle about it (``Angle``)."""

    row: Ints
    i: Ints
    j: Ints
    ui: Array
    uj: Array
    a: Array
    b: Array
    p: Array
    pitch: Array  # (k,) length a radian
    count: Ints


@dataclass(frozen=True)
class Idle:
    """In space: spin of j about a direction p fixed in j, set to zero.

    Its measure is 0 in every pose: the link is in its ``drawn`` orientation, turned by the smallest angle that aligns
    p. Where the line of spin moves in the link (``stands`` is 0), the link keeps its present spin.
    """

    row: Ints
    i: Ints
    j: Ints
    p: Array
    drawn: Array  # (k, 9)
    stands: Array  # (k,) 1 or 0


Family = (
    Meet | Along | Turn | Mesh | BeltMesh | Distance | Perpendicular | Angle | Helix | Idle | Gearing
    | ToothForce | ToothCouple | Strand | StrandSum | Lining | BandStrands | CamRow
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class Rows:
    """The rows of one system by family; ``count`` is their number, ``joint`` the joint of each."""

    count: int
    links: int
    families: tuple[Family, ...]
    joint: Ints  # (K,) joint of each row, -1 where it belongs to none
    angular: Flags  # (K,) the measure is an angle, the wrench a couple

    @cached_property
    def idle(self) -> Ints:
        """Rows of spins set to zero; they carry no load."""
        idle = [f.row for f in self.families if isinstance(f, Idle)]
        return np.concatenate([*idle, np.zeros(0, np.intp)]).astype(np.intp)

    @cached_property
    def lots(self) -> list[tuple[bool, Ints]]:
        """Rows of joints in batches, angular ones or not, no two rows of a joint in one batch, so that a batch is
        summed at once."""
        lots = []
        for turns in (False, True):
            left = np.flatnonzero((self.joint >= 0) & (self.angular == turns))
            while left.size:
                first = np.unique(self.joint[left], return_index=True)[1]
                lots.append((turns, left[first]))
                left = np.delete(left, first)
        return lots

    @cached_property
    def ends(self) -> tuple[Ints, Ints]:
        """Links i and j of each row."""
        i, j = np.zeros(self.count, np.intp), np.zeros(self.count, np.intp)
        for family in self.families:
            row = family.row.T if isinstance(family, Meet) else family.row
            i[row], j[row] = family.i, family.j
        return i, j


class ConstraintRows(NamedTuple):
    """Rows between links i and j (K,), with their wrenches on them (..., K, n): the columns of A, row by row."""

    i: Ints
    j: Ints
    angular: Flags
    on_i: Array
    on_j: Array

    def __add__(self, other: ConstraintRows) -> ConstraintRows:  # type: ignore[override]
        """Both, one after the other."""
        lead = np.broadcast_shapes(self.on_j.shape[:-2], other.on_j.shape[:-2])
        wide = [
            np.broadcast_to(a, lead + a.shape[-2:]) for a in (self.on_i, other.on_i, self.on_j, other.on_j)
        ]
        return ConstraintRows(
            np.concatenate([self.i, other.i]),
            np.concatenate([self.j, other.j]),
            np.concatenate([self.angular, other.angular]),
            np.concatenate(wide[:2], axis=-2),
            np.concatenate(wide[2:], axis=-2),
        )

    def at(self, where: Index) -> ConstraintRows:
        """The rows at some positions."""
        return self._replace(on_i=self.on_i[where], on_j=self.on_j[where])

    def rows(self, which: Index) -> ConstraintRows:
        """Some of the rows."""
        on_i, on_j = self.on_i[..., which, :], self.on_j[..., which, :]
        return ConstraintRows(self.i[which], self.j[which], self.angular[which], on_i, on_j)


def select_rows(rows: Rows, kept: Ints, first: int = 0) -> list[Family]:
    """The families of some rows only (ascending), renumbered from ``first``."""
    out: list[Family] = []
    for f in rows.families:
        same = f.row == kept[0] if len(kept) == 1 else np.isin(f.row, kept)
        mask = np.asarray(same.reshape(len(f.i), -1).all(axis=1))
        if mask.any():
            parts = {name: value[mask] for name, value in vars(f).items() if name != "row"}
            out.append(type(f)(row=first + np.searchsorted(kept, f.row[mask]), **parts))
    return out


def _merge(families: list[Family]) -> tuple[Family, ...]:
    """Families of one kind joined into one."""
    kinds: dict[type, list[Family]] = {}
    for f in families:
        kinds.setdefault(type(f), []).append(f)
    return tuple(_concatenate(kind, group) for kind, group in kinds.items())


def _concatenate(kind: type, group: list[Family]) -> Family:
    family: Family = kind(**{name: np.concatenate([vars(f)[name] for f in group]) for name in vars(group[0])})
    return family


@dataclass(frozen=True)
class Layout:
    """A compiled mechanism: the connections of its links.

    constraints, freedoms   the rows of A and of the joints' freedoms
    driven (D,)             the freedom each drive prescribes
    redundant               solve by singular values: constraints repeat each other
    length                  characteristic length: makes angles and moments comparable with lengths and forces
    """

    algebra: Algebra
    links: int
    joints: int
    constraints: Rows
    freedoms: Rows
    driven: Ints
    length: float
    redundant: bool
    reference: Array = field(repr=False)  # (L+1, d) reference point of each link in its axes
    compliance: Array | None = field(repr=False, default=None)  # (K,) of each constraint, 0 where it is rigid
    solver: Callable[[Layout, ConstraintRows], Any] | None = field(
        repr=False, default=None
    )  # factors systems that are not made of numbers (the kernel's)

    def __getstate__(self) -> dict[str, Any]:
        """Pickles the algebra by its name, since a module cannot be pickled."""
        return {f.name: getattr(self, f.name) for f in fields(self)} | {"algebra": self.algebra.name}

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state, algebra=space if state["algebra"] == space.name else plane)

    @cached_property
    def stack(self) -> Rows:
        """The constraints, then the driven freedoms: the rows of the square system."""
        count = self.constraints.count
        driven = [
            select_rows(self.freedoms, self.driven[k : k + 1], count + k) for k in range(len(self.driven))
        ]
        families = _merge([*self.constraints.families, *(f for one in driven for f in one)])
        return Rows(
            count + len(self.driven),
            self.links,
            families,
            np.concatenate([self.constraints.joint, self.freedoms.joint[self.driven]]),
            np.concatenate([self.constraints.angular, self.freedoms.angular[self.driven]]),
        )

    @cached_property
    def counted(self) -> tuple[Angle | Helix | Gearing, ...]:
        """Families of freedoms and constraints that count whole turns of their relative angles."""
        families = (*self.freedoms.families, *self.constraints.families)
        return tuple(f for f in families if isinstance(f, Angle | Helix | Gearing))

    @cached_property
    def row_scale(self) -> Array:
        """Scale of the stacked measures: angles times the characteristic length."""
        return np.where(self.stack.angular, self.length, 1.0)

    @cached_property
    def wrench_scale(self) -> Array:
        """Scale of a wrench's components (n,): moments over the characteristic length."""
        g = self.algebra
        return np.repeat([1.0, 1 / self.length], [g.d, g.n - g.d])

    @cached_property
    def column_scale(self) -> Array:
        """Scale of the equilibrium equations (n L,), and inverse scale of the displacements."""
        return np.tile(self.wrench_scale, self.links)

    @property
    def unknowns(self) -> int:
        """n L, the number of velocities, and of equilibrium equations."""
        return int(self.algebra.n) * self.links

    @property
    def square(self) -> bool:
        """True with as many rows as unknowns and no redundant row: J has a determinant."""
        return self.constraints.count + len(self.driven) == self.unknowns and not self.redundant
