"""Buckling of links as columns: how the joints hold their ends, Euler's or Johnson's load, barrel and rod as one.

Mechanics: docs/theory.md 10.4.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from dalembert.answer.equality import Compared
from dalembert.arrays import Array, Ints, Tree
from dalembert.errors import ModelError
from dalembert.machine.members.column_loads import critical_load, effective_length, johnson, within
from dalembert.machine.members.end_conditions import EndConditions, end_words
from dalembert.machine.members.stresses import section_of
from dalembert.machine.members.struts import Strut

if TYPE_CHECKING:
    from dalembert.machine.members.member_forces import MemberForces
    from dalembert.model.links.sections import Section

Factors = float | tuple[float, float]
"""K of both planes, or [in the plane, across it]."""
BENT = 1e-9
"""Part of compression times length below which a bending moment is rounding."""
COUPLED = 1e-9
"""Below the load of either plane alone by more than this part, a column bends in both planes together."""


@dataclass(frozen=True, eq=False)
class Buckling(Compared):
    """Critical compression of a link, N, by `Euler` or `Johnson`, beside its compression where the safety is least.

    ``effective_length`` (K in the plane of the mechanism, K across it; in space of bending along the member's y, and
    along z); ``plane`` the governing one, 0 or 1; ``ends``: the end conditions in it (`fixed`, `pinned`, `guided`,
    `free`), or `given`. ``position`` (from 0) where; ``safety`` critical / compression, infinite without compression;
    ``two_force``: True if it is not bent, so that the formula holds: else it is for comparison. ``links``: the link, or
    barrel and rod that are one column, K then with EI of the weaker part and both lengths. ``moves_along``: True if a
    joint at an end of it is free to move across, with links whose push then turns. ``transition``: slenderness
    sqrt(2 pi^2 E / S_y) below which Johnson's load holds, NaN without a yield stress. ``criticals`` and
    ``compressions`` (P,), N, ``factors`` (P, 2) at every position.
    """

    critical: float
    formula: str
    slenderness: float
    compression: float
    position: int
    safety: float
    two_force: bool
    effective_length: tuple[float, float] = (1.0, 1.0)
    plane: int = 0
    ends: tuple[str, str] = ("given", "given")
    member: str = ""
    links: tuple[str, ...] = ()
    moves_along: bool = False
    transition: float = math.nan
    criticals: Array = field(default_factory=lambda: np.zeros(0), repr=False)
    compressions: Array = field(default_factory=lambda: np.zeros(0), repr=False)
    factors: Array = field(default_factory=lambda: np.zeros((0, 2)), repr=False)


def utilisation(forces: MemberForces) -> Array:
    """Compression over critical load (P,) of the member where it is greatest: 1 where it buckles, 0 in tension."""
    loaded = np.maximum.reduce([-curve.extremes("axial")[0] for curve in forces.curves]) > 0
    with np.errstate(all="ignore"):
        b = buckling(forces, at=np.flatnonzero(loaded)) if loaded.any() else None
        used = 0.0 * loaded if b is None else np.where(loaded, b.compressions / b.criticals, 0.0)
    unknown = np.isnan(np.sum([curve.extremes("axial")[0] for curve in forces.curves], axis=0))
    return np.where(unknown, np.nan, used)


def buckling(
    forces: MemberForces,
    section: Section | Tree | None = None,
    ends: Factors | None = None,
    at: Ints | None = None,
) -> Buckling:
    """Critical compression N = pi^2 E I / (K L)^2 in the weaker plane, or Johnson's load.

    Johnson's holds where Euler's stress is above half the yield stress. K follows from the joints at every position,
    unless ``ends`` or the link's `effective_length` gives it. ``at``: only at these positions, from 0.
    Raises ModelError without Young's modulus, for several
    members without a K, and for a link that its joints leave loose.
    """
    s = _elastic(forces, section)
    described = forces.result.mechanism.links[forces.link].effective_length or {}
    known = described if ends is None else {"": ends if isinstance(ends, tuple) else (ends, ends)}
    if len(forces.curves) > 1 and not all({"", c.name} & known.keys() for c in forces.curves):
        names = ", ".join(c.name for c in forces.curves)
        what = f"members {names} of {forces.link!r} are one frame, in which each is held by the others"
        remedy = f"give their factors: effective_length: {{{forces.curves[0].name}: 1, ...}}"
        raise ModelError(what, remedy, ("links", forces.link))
    judged = [
        _judged(Strut((forces,), (c,)), [s], known.get(c.name, known.get("")), at) for c in forces.curves
    ]
    return min(judged, key=lambda b: (math.isnan(b.safety), b.safety, b.critical))


def stepped_column(barrel: MemberForces, rod: MemberForces, joint: str) -> Buckling:
    """Barrel and rod, which slide in each other by a joint, as one column, the rod's section outside the barrel."""
    sections = [_elastic(f, None) for f in (barrel, rod)]
    return _judged(Strut((barrel, rod), (barrel.curve(), rod.curve()), joint), sections, None)


def _elastic(forces: MemberForces, section: Section | Tree | None) -> Section:
    s = section_of(forces, section)
    if s.elasticity is None:
        path = ("links", forces.link, "section")
        raise ModelError(
            f"the section of {forces.link!r} has no elasticity", "give elasticity: 210 GPa", path
        )
    return s


class _Judgement:
    """Critical loads (P,) and factors (P, 2) of a strut, with the plane that decides, the formula and the ends."""

    def __init__(
        self, strut: Strut, sections: list[Section], known: tuple[float, float] | None, at: Ints | None
    ) -> None:
        count = len(strut.forces[0].result.status)
        self.strut, self.sections, self.known = strut, sections, known
        self.criticals, self.factors = np.full(count, np.nan), np.full((count, 2), np.nan)
        self.plane, self.lengths = np.zeros(count, int), np.full(count, np.nan)
        self.formula, self.ends = [""] * count, [("given", "given")] * count
        self.moves = np.zeros(count, bool)
        self.conditions = EndConditions(strut.forces[0].result)
        self.solved: dict[tuple[object, ...], Array] = {}
        placed = np.logical_and.reduce([np.isfinite(e.start).all(axis=1) for e in strut.members])
        for k in np.flatnonzero(placed) if at is None else np.intersect1d(np.flatnonzero(placed), at):
            self._at(int(k))

    def stiffness(self, plane: int) -> list[float]:
        """EI, N m2, of each section against bending along y, or along z; in a twisted pair the lesser."""
        return [float(s.elasticity or 0.0) * s.second_moments[1 - plane] for s in self.sections]

    def _at(self, k: int) -> None:
        column, step = self.strut.column(k)
        spans = column.spans()
        total = self.lengths[k] = sum(spans)
        weakest = np.array([min(self.stiffness(p)) for p in (0, 1)])
        if self.known is not None:
            eulers = math.pi**2 * weakest / (np.array(self.known) * total) ** 2
        else:
            middles = [a.s + x / 2 for a, x in zip(column.nodes, spans, strict=False)]
            each = np.array([[self.stiffness(p)[-1 if x > step else 0] for x in middles] for p in (0, 1)])
            free = self.conditions.motions(k, column)
            eulers = self._eulers(spans, each, free)
        loads = [(*johnson(eulers[p], s.area_of, s.yield_stress), p) for p in (0, 1) for s in self.sections]
        least = min(loads)
        first = next(x for x in loads if x[0] <= least[0] * (1 + COUPLED))  # of two alike the plane itself
        self.criticals[k], self.formula[k], self.plane[k] = first
        factors = [effective_length(*pair, total) for pair in zip(eulers, weakest, strict=True)]
        self.factors[k] = self.known or factors
        if self.known is None:
            half = len(free) // 2
            self.ends[k] = end_words(free[half:] if self.plane[k] else free[:half])
            outer = zip((column.nodes[0], column.nodes[-1]), self.ends[k], strict=True)
            self.moves[k] = any(node.joints and end in ("free", "guided") for node, end in outer)

    def _eulers(self, spans: list[float], stiffness: Array, free: Array) -> Array:
        """Euler loads of both planes (2,), each with the column straight in the other; the combined load twice where
        both bend together.

        Solved once for the same column: most positions do not differ in its data.
        """
        key = (*np.round(spans, 12), stiffness.tobytes(), ((free @ free.T).round(9) + 0.0).tobytes())
        if key not in self.solved:
            unit = np.tile([sum(spans), 1.0], len(free) // 2)[:, None]
            half = unit[: len(free) // 2]
            alone = [critical_load(spans, stiffness[[p]], within(free, p) * half) for p in (0, 1)]
            both = critical_load(spans, stiffness, free * unit)
            self.solved[key] = np.array(alone if both > (1 - COUPLED) * min(alone) else [both, both])
        return self.solved[key]


def _transition(s: Section) -> float:
    """Slenderness at which Euler's stress is half the yield stress."""
    return math.pi * math.sqrt(2 * (s.elasticity or 0.0) / s.yield_stress) if s.yield_stress else math.nan


def _judged(
    strut: Strut, sections: list[Section], known: tuple[float, float] | None, at: Ints | None = None
) -> Buckling:
    """The position of least safety, or without any compression that of the least critical load."""
    judgement, compression = _Judgement(strut, sections, known, at), strut.compression()
    if (judgement.criticals == 0).any():
        names, k = (
            " and ".join(repr(f.link) for f in strut.forces),
            int(np.argmin(judgement.criticals != 0)) + 1,
        )
        what = (
            f"{names} can move without bending at position {k}, as the joints hold it with the drives at rest"
        )
        raise ModelError(what, "give its factor: effective_length: 1", ("links", strut.forces[0].link))
    with np.errstate(all="ignore"):
        safety = np.where(compression > 0, judgement.criticals / compression, np.inf)
    safety[np.isnan(judgement.criticals) | np.isnan(compression)] = np.nan
    order = np.lexsort((judgement.criticals, safety, np.isnan(safety)))
    k = int(order[0])
    plane = int(judgement.plane[k])
    section = min(sections, key=lambda s: (s.elasticity or 0.0) * s.second_moments[1 - plane])
    radius = math.sqrt(section.second_moments[1 - plane] / section.area_of)
    return Buckling(
        critical=float(judgement.criticals[k]),
        formula=judgement.formula[k],
        slenderness=float(judgement.factors[k, plane] * judgement.lengths[k] / radius),
        compression=float(compression[k]),
        position=k,
        safety=float(safety[k]),
        two_force=not strut.is_bent(BENT),
        effective_length=(float(judgement.factors[k, 0]), float(judgement.factors[k, 1])),
        plane=plane,
        ends=judgement.ends[k],
        member=strut.curves[0].name if len(strut.curves) == 1 else "",
        links=tuple(f.link for f in strut.forces),
        moves_along=bool(judgement.moves[k]),
        transition=_transition(section),
        criticals=judgement.criticals,
        compressions=compression,
        factors=judgement.factors,
    )
