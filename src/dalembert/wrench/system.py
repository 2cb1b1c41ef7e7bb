"""A force system: forces and couples on one link, or on any rigid body (docs/theory.md 4)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.answer.answer import Drawn, Worked
from dalembert.answer.column import WORD, Axes, Column, Scale, UnitChoice, parts
from dalembert.arrays import Array, Numeric, Tree
from dalembert.bounds import require
from dalembert.errors import AnalysisError, ModelError
from dalembert.units import Units, file_units
from dalembert.wording import closest
from dalembert.wrench import reading
from dalembert.wrench.balance_check import ForceSums, balance
from dalembert.wrench.forces import ALGEBRA, Axis, Couple, Force, moment_about, value_of
from dalembert.wrench.reading import UnitNames, Vector, read_only

if TYPE_CHECKING:
    from dalembert.printing import Part
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene

EXACT = 1e-9
"""Fraction of the largest force (of force times length) below which a force (a moment) counts as zero."""


@dataclass(frozen=True, eq=False)
class ForceCouple:
    """The force (N) at a point (m) and the couple (N m) that a system is equivalent to; ``vector`` is the couple's."""

    at: Array
    force: Array
    vector: Array

    @property
    def couple(self) -> Numeric:
        """The couple: a number in the plane, a vector (3,) in space."""
        return value_of(self.vector)

    @property
    def parts(self) -> tuple[Force, Couple]:
        """The same as a force and a couple."""
        return Force(self.force, self.at, "R"), Couple(self.vector, "M")

    def moved(self, at: Vector) -> ForceCouple:
        """The same at another point B: M_B = M_A + (A - B) x F."""
        place = reading.vector(at, "length", dimension=len(self.force))
        arm = self.at - place
        return ForceCouple(
            place, self.force, read_only(self.vector + ALGEBRA[len(arm)].cross(arm, self.force))
        )


@dataclass(frozen=True, eq=False)
class CentralAxis:
    """The line on which a system is a force and a couple along it, the least couple of all points.

    ``moment`` (N m) is that couple along the force, positive by the right hand, 0 in the plane; ``pitch`` (m) is
    moment over force. ``axis.point`` is the axis' point nearest to the middle of the system.
    """

    axis: Axis
    force: Array
    moment: float
    pitch: float


class System(Drawn, Worked):
    """Forces and couples, all plane or all spatial; ``units`` are those it is shown in (default SI).

    ``points`` names places (m), for drawings and as points to take moments about.

    >>> s = System(Force([10, 0], at=[0, 2]), Force([0, 10], at=[3, 0]), Couple(5))
    >>> s.resultant, s.moment([0, 0]), s.kind()
    (array([10., 10.]), 15.0, 'single force')
    """

    def __init__(
        self,
        *parts: Force | Couple,
        title: str = "",
        units: UnitNames = None,
        points: Mapping[str, Vector] | None = None,
        source: str = "",
    ) -> None:
        dimensions = {part.dimension for part in parts}
        if len(dimensions) > 1:
            raise ModelError(
                "the system has parts in the plane and parts in space",
                "give all vectors 2 components, or all 3",
            )
        if not parts:
            raise ModelError("the system has no force and no couple", "give it at least one")
        self.parts = parts
        self.title, self.source = title, source
        self.units = Units() if units is None else file_units(units)
        self.dimension: int = dimensions.pop()
        self.points = {
            name: reading.vector(p, "length", dimension=self.dimension) for name, p in (points or {}).items()
        }

    # what it is made of

    @property
    def forces(self) -> tuple[Force, ...]:
        """Forces of the system."""
        return tuple(part for part in self.parts if isinstance(part, Force))

    @property
    def couples(self) -> tuple[Couple, ...]:
        """Couples of the system."""
        return tuple(part for part in self.parts if isinstance(part, Couple))

    @property
    def names(self) -> tuple[str, ...]:
        """A name for each part: the given one, else F1, F2, ... and M1, M2, ... in order."""
        counts, out = {"F": 0, "M": 0}, []
        for part in self.parts:
            letter = "F" if isinstance(part, Force) else "M"
            counts[letter] += 1
            out.append(part.name or f"{letter}{counts[letter]}")
        return tuple(out)

    def __iter__(self) -> Iterator[Force | Couple]:
        return iter(self.parts)

    def __len__(self) -> int:
        return len(self.parts)

    def __getitem__(self, name: str) -> Force | Couple:
        matches = [part for part in self.parts if part.name == name]
        if not matches:
            names = [part.name for part in self.parts if part.name]
            raise ModelError(f"the system has no part {name!r}", closest(name, names))
        return matches[0]

    def __add__(self, other: System | Force | Couple) -> System:
        more = other.parts if isinstance(other, System) else (other,)
        return self._of(*self.parts, *more)

    def __neg__(self) -> System:
        return self._of(*(-part for part in self.parts))

    def _of(self, *parts: Force | Couple) -> System:
        """Other parts under the same title, in the same units, with the same points."""
        return System(*parts, title=self.title, units=self.units, points=self.points, source=self.source)

    def __repr__(self) -> str:
        where = "plane" if self.dimension == 2 else "space"
        forces, couples = len(self.forces), len(self.couples)
        return f"System({forces} force{'s' * (forces != 1)} and {couples} couple{'s' * (couples != 1)} in {where})"

    # as an answer

    ROWS = "parts"

    def compared(self) -> Tree:
        """Parts that equal systems share: their parts, and how they are shown."""
        return {"parts": self.parts, "names": self.names, "units": self.units, "points": self.points}

    @property
    def described(self) -> System:
        """Itself."""
        return self

    def basis(self) -> dict[str, str]:
        """Title and source."""
        return {"title": self.title or "Force system", "source": self.source}

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """A row a part: its name, force, point of application, moment."""
        yield Column("name", WORD, np.array(self.names, object))
        missing, turns = np.full(self.dimension, np.nan), ALGEBRA[self.dimension].n - self.dimension
        still = np.full(turns, np.nan)
        sides = [
            (missing, missing, p.vector) if isinstance(p, Couple) else (p.vector, p.at, still)
            for p in self.parts
        ]
        for name, kind, values in zip(
            ("force", "at", "moment"), ("force", "length", "moment"), zip(*sides, strict=True), strict=True
        ):
            numbers = np.stack(values)
            for part, of in parts(numbers[:, 0] if numbers.shape[1] == 1 else numbers):
                yield Column(f"{name}{part}", kind, of)

    def record(self, to: Scale) -> Tree:
        """The sum of all at the origin, what it reduces to, and the equilibrium."""
        sums, kind, held = self.reduced(), self.kind(), self.equilibrium()
        out: Tree = {
            "resultant": to("force", sums.force),
            "moment_at_origin": to("moment", value_of(sums.vector)),
            "kind": kind,
            "equilibrium": {"holds": held.holds, "residual": held.residual, "sentence": held.sentence},
        }
        if kind in ("single force", "wrench"):
            c = self.central_axis()
            axis = {"point": to("length", c.axis.point), "direction": c.axis.direction}
            out["central_axis"] = axis | {"moment": to("moment", c.moment), "pitch": to("length", c.pitch)}
        return {"system": out}

    about: Vector | None = None
    """Point about which its worked solution takes moments, and at which its drawing reduces it."""
    camera = "isometric"

    def seen(self, about: Vector | None, camera: str) -> System:
        """The same system, with moments about a point, drawn by a camera in space."""
        self.point(about)
        made = self._of(*self.parts)
        made.about, made.camera = about, camera
        return made

    def text(self, units: UnitChoice = "file", **choice: Any) -> str:
        """The worked solution as text; ``figures``: significant figures."""
        from dalembert.views.notation import Notation

        return str(self.report(Notation(units=units, **choice))).rstrip("\n")

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterator[Part]:
        """The parts and their sum as a table, and what they reduce to."""
        from dalembert.wrench.system_text import system_parts

        return system_parts(self, units)

    def drawings(self, notation: Notation | None = None) -> list[Scene]:
        """The forces with their resultant; in the plane with the force polygon."""
        from dalembert.views import draw

        return [draw.force_system(self, self.about, notation, self.camera)]

    def sheet(self, notation: Notation | None = None) -> ReportSheet:
        """The reduction in letters and numbers."""
        from dalembert.reports.sections.force_system_solution import force_system_sheet

        return force_system_sheet(self, self.about, notation)

    # its size

    @property
    def middle(self) -> Array:
        """The mean of the points of application (m)."""
        points = [f.at for f in self.forces]
        return read_only(np.mean(points, axis=0) if points else np.zeros(self.dimension))

    @property
    def length(self) -> float:
        """Characteristic length (m): the diagonal of the box around the points of application."""
        points = [f.at for f in self.forces]
        return math.hypot(*np.ptp(points, axis=0)) if points else 0.0

    def scales(self, length: float | None = None) -> tuple[float, float]:
        """Largest force and largest moment (N, N m) relative to which values count as zero.

        The force is the largest of all forces and of couples over the length; the moment is that force times the
        length. At one point, without a length: the largest force and the largest couple.
        """
        require("length", length)
        reach = self.length if length is None else length
        force = max((f.size for f in self.forces), default=0.0)
        couple = max((c.size for c in self.couples), default=0.0)
        if reach == 0:
            return force, couple
        largest = max(force, couple / reach)
        return largest, largest * reach

    # what it comes to

    @property
    def resultant(self) -> Array:
        """The sum of all forces (N)."""
        return read_only(sum((f.vector for f in self.forces), np.zeros(self.dimension)))

    def point(self, at: Vector | None) -> Array:
        """A point (m): by its components, in a text in the system's units; by its name; the origin."""
        if at is None:
            return read_only(np.zeros(self.dimension))
        if isinstance(at, str) and at in self.points:
            return self.points[at]
        if isinstance(at, str) and "[" not in at and "@" not in at:
            raise ModelError(f"the system has no point {at!r}", closest(at, list(self.points)))
        units = self.units if isinstance(at, str) else None
        return reading.vector(at, "length", units, self.dimension)

    def point_name(self, at: Vector | None, other: str = "O", taken: str | None = None) -> str:
        """Name of a point among the system's; else a name that no point has."""
        place = self.point(at)
        for name, p in self.points.items():
            if bool((p == place).all()):
                return name
        free = (name for name in (other, *"OPQSTUVW") if name not in {*self.points, taken})
        return next(free, other)

    def moment(self, about: Vector | Axis | None = None) -> Numeric:
        """Sum of the moments about a point (default the origin) or an axis, couples included, N m.

        A number in the plane, a vector (3,) about a point in space, a number about an axis.
        """
        return moment_about(self, about if isinstance(about, Axis) else self.point(about))

    def _moment(self, about: Array) -> Array:
        zero = np.zeros(ALGEBRA[self.dimension].n - self.dimension)
        return np.asarray(
            sum((f._moment(about) for f in self.forces), zero) + sum(c.vector for c in self.couples)
        )

    def reduced(self, at: Vector | None = None) -> ForceCouple:
        """The force and couple at a point (default the origin) that the system is equivalent to."""
        place = self.point(at)
        return ForceCouple(place, self.resultant, read_only(self._moment(place)))

    def central_axis(self, tolerance: float = EXACT, length: float | None = None) -> CentralAxis:
        """The axis on which force and couple are parallel: r = F x M / F^2 from the point of M; pitch F . M / F^2.

        In the plane it is the line of action of the resultant. Raises AnalysisError where the resultant is zero.

        >>> s = System(Force([0, 0, 5]), Force([0, 10, 0], at=[2, 0, 0]), Couple([0, 4, 0]))
        >>> c = s.central_axis()
        >>> c.axis.crossing(z=0).round(3), round(c.moment, 3)
        (array([1.44, 0.  , 0.  ]), 12.522)
        """
        require("tolerance", tolerance)
        force, at = self.resultant, self.middle
        size = math.hypot(*force)
        if size <= tolerance * self.scales(length)[0]:
            what = {"couple": "a couple", "zero": "in equilibrium"}[self.kind(tolerance, length)]
            raise AnalysisError(
                f"The resultant force is zero, so a central axis does not exist: the system is {what}."
            )
        moment = self._moment(at)
        unit = force / size
        point = at - ALGEBRA[self.dimension].spin(moment, unit) / size
        along = float(moment @ unit) if self.dimension == 3 else 0.0
        return CentralAxis(Axis(point, force), force, along, along / size)

    def kind(self, tolerance: float = EXACT, length: float | None = None) -> str:
        """Simplest equivalent: `zero`, `couple`, `single force`, or in space `wrench` (force and couple along it)."""
        require("tolerance", tolerance)
        largest, moment_scale = self.scales(length)
        size = math.hypot(*self.resultant)
        if size <= tolerance * largest:
            moment = math.hypot(*self._moment(self.middle))
            return "zero" if moment <= tolerance * moment_scale else "couple"
        couple = abs(self.central_axis(tolerance, length).moment)
        return "single force" if couple <= tolerance * moment_scale else "wrench"

    def equilibrant(
        self, tolerance: float = EXACT, length: float | None = None
    ) -> tuple[Force | Couple, ...]:
        """Parts that bring it to equilibrium: none, a couple, a force on its line, or a force and a couple along it."""
        kind = self.kind(tolerance, length)
        if kind == "zero":
            return ()
        if kind == "couple":
            return (Couple(-self._moment(self.middle), "E"),)
        screw = self.central_axis(tolerance, length)
        force = Force(-screw.force, screw.axis.point, "E")
        return (
            (force,) if kind == "single force" else (force, Couple(-screw.moment * screw.axis.direction, "E"))
        )

    def equilibrium(self, tolerance: float = EXACT, length: float | None = None) -> ForceSums:
        """Equilibrium check: the verdict, the residual force and moment, and the missing parts.

        ``tolerance`` is the residual allowed, as a fraction of the largest force, and for moments of that force times
        ``length`` (m, default: that of the system); about 1e-3 suits printed figures.
        """
        at = self.middle
        sums, scales = (self.resultant, self._moment(at)), self.scales(length)
        return balance(sums, at, scales, tolerance, self.equilibrant(tolerance, length), self.units)
