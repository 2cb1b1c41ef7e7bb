"""The worked solution of a force system: sums, moments, reduction, central axis, equilibrium, drawings."""

from __future__ import annotations

import math
import re

import numpy as np

from dalembert.arrays import Array
from dalembert.reports.formula import bracket_negative
from dalembert.reports.report_context import as_formula
from dalembert.reports.sections.terms import join_numbers
from dalembert.reports.sheet import ReportSheet, Working
from dalembert.views import draw
from dalembert.views.notation import Figures, Notation, load_sign, pretty
from dalembert.wrench import Couple, Force, System
from dalembert.wrench.forces import Axis
from dalembert.wrench.reading import Vector

MOMENT_TERMS = {2: ("x F_y − y F_x",), 3: ("y F_z − z F_y", "z F_x − x F_z", "x F_y − y F_x")}
"""Moment of a force about the point from arm and components, by dimension."""


def force_system_sheet(s: System, at: Vector | None = None, notation: Notation | None = None) -> ReportSheet:
    """Worked solution of a force system, with moments about a point (default the origin)."""
    shown = Figures(s.units, notation or Notation())
    sheet = ReportSheet(
        s.title or "Force system", s.source, f"{'Plane' if s.dimension == 2 else 'Space'}, {_count(s)}"
    )
    work = _Solution(s, s.point(at), shown, sheet)
    work.stated()
    sheet.figure(draw.force_system(s, notation=notation))
    work.resultant()
    work.moments()
    work.reduction()
    work.equilibrium()
    return sheet


def _count(s: System) -> str:
    def many(n: int, word: str) -> str:
        return f"{n} {word}{'' if n == 1 else 's'}"

    return f"{many(len(s.forces), 'force')} and {many(len(s.couples), 'couple')}"


class _Solution:
    """The sections one by one."""

    def __init__(self, s: System, at: Array, shown: Figures, sheet: ReportSheet) -> None:
        self.s, self.at, self.shown, self.sheet = s, at, shown, sheet
        self.d = s.dimension
        self.axes = "xyz"[: self.d]
        self.named = list(zip(s.names, s.parts, strict=True))
        self.largest, self.moment_scale = s.scales()
        self.reduced = s.reduced(at)
        self.name = s.point_name(at)
        self.about = f"M_{{{self.name}}}"

    # numbers in the reader's units, rounding noise shown as 0

    def force(self, value: float) -> str:
        return self.shown.number("force", float(value), 1e-12 * self.largest)

    def cosine(self, value: float) -> str:
        return self.shown.number("number", float(value), 1e-12)

    def length(self, value: float) -> str:
        """In the unit in which arms times forces are moments."""
        floor = 1e-12 * max(self.s.length, float(np.abs(self.at).max()))
        return self.shown.notation.number(0.0 if abs(value) < floor else float(value) / self.shown.arm)

    def moment(self, value: float) -> str:
        return self.shown.number("moment", float(value), 1e-12 * self._moment_size())

    def _moment_size(self) -> float:
        arms = [f.size * float(np.linalg.norm(f.at - self.at)) for f in self.s.forces]
        return max([self.moment_scale, *arms])

    def unit(self, kind: str) -> str:
        return f'"{self.shown.unit(kind)}"'

    def point(self, p: Array) -> str:
        return f"({', '.join(self.length(x) for x in p)}) {self.shown.arm_unit}"

    @property
    def length_unit(self) -> str:
        return f'"{self.shown.arm_unit}"'

    # sections

    def stated(self) -> None:
        self.sheet.heading("Given")
        force, length, moment = self.shown.unit("force"), self.shown.arm_unit, self.shown.unit("moment")
        directions = ["angle °"] if self.d == 2 else [f"cos {a}" for a in self.axes]
        rows = []
        for name, f in self.named:
            if isinstance(f, Force):
                parts = [self.force(v) for v in f.vector]
                rows.append(
                    [
                        _sign(name),
                        *parts,
                        self.force(f.size),
                        *self._directions(f),
                        *(self.length(x) for x in f.at),
                    ]
                )
        heads = ["Force", *(f"F_{a}" for a in self.axes), "size", *directions, *self.axes]
        self.sheet.table(_formulas(heads), rows, f"Forces in {force}, at points in {length}")
        rows = [
            [_sign(n), *(self.moment(v) for v in c.vector)] for n, c in self.named if isinstance(c, Couple)
        ]
        turning = ["M"] if self.d == 2 else [f"M_{a}" for a in self.axes]
        words = f"Couples in {moment}: free vectors, the same about every point"
        self.sheet.table(_formulas(["Couple", *turning]), rows, words)

    def _directions(self, f: Force) -> list[str]:
        if f.size == 0:
            return ["–"] * (1 if self.d == 2 else 3)
        if self.d == 2:
            return [self.shown.notation.direction(*f.vector)]
        return [self.cosine(c) for c in f.cosines]

    def resultant(self) -> None:
        self.sheet.heading("Resultant")
        lines = []
        for k, axis in enumerate(self.axes):
            terms = join_numbers([self.force(f.vector[k]) for f in self.s.forces])
            total = f"{self.force(self.s.resultant[k])} {self.unit('force')}"
            lines.append(Working(f"R_{{{axis}}} = sum F_{{{axis}}}", terms, total))
        r = Force(self.s.resultant)
        roots = " + ".join(f"R_{{{a}}}^{{2}}" for a in self.axes)
        lines.append(Working("R", f"({roots})^{{1/2}}", f"{self.force(r.size)} {self.unit('force')}"))
        if r.size > 1e-9 * self.largest:
            lines += self._direction(r)
        self.sheet.equations(lines)

    def _direction(self, r: Force) -> list[Working]:
        if self.d == 2:
            degrees = self.shown.notation.direction(*r.vector)
            return [Working(f"theta quad (tan theta = R_{{y}} / R_{{x}}) = {degrees} deg")]
        return [
            Working(f"cos theta_{{{a}}}", f"R_{{{a}}} / R", self.cosine(c))
            for a, c in zip(self.axes, r.cosines, strict=True)
        ]

    def moments(self) -> None:
        self.sheet.heading("Moments")
        self.sheet.text(
            f"About {self.name} at {self.point(self.at)}; {', '.join(self.axes)} are measured from that point. "
            "The moment of a force is the sum of the moments of its components (Varignon)."
        )
        rows = []
        for name, part in self.named:
            if isinstance(part, Force):
                arm = part.at - self.at
                numbers = [*(self.length(x) for x in arm), *(self.force(v) for v in part.vector)]
                rows.append([_sign(name), *numbers, *(self.moment(m) for m in part._moment(self.at))])
            else:
                blank = ["–"] * (2 * self.d)
                rows.append([_sign(name), *blank, *(self.moment(m) for m in part.vector)])
        rows.append(["sum", *([""] * (2 * self.d)), *(self.moment(m) for m in self.reduced.vector)])
        heads = ["Part", *self.axes, *(f"F_{a}" for a in self.axes), *MOMENT_TERMS[self.d]]
        self.sheet.table(
            _formulas(heads),
            rows,
            f"Moments in {self.shown.unit('moment')}; a couple has the same moment about every point",
            total=True,
        )

    def reduction(self) -> None:
        self.sheet.heading("Resultant")
        self.sheet.text(
            f"At {self.name}: the force $R$ and the couple ${self.about}$. Lines of action: {self._lie()}."
        )
        kind = self.s.kind()
        if kind in ("zero", "couple"):
            words = {
                "zero": "Both are zero: the system is in equilibrium.",
                "couple": "The force is zero: the system is a couple, the same about every point.",
            }
            self.sheet.text(words[kind])
            return
        (self._line if self.d == 2 else self._screw)(kind)
        self._check()

    def _check(self) -> None:
        """The moment about another point, from all parts and from the reduction."""
        place = self.s.middle
        if np.allclose(place, self.at):
            place = place + (self.s.length or 1.0) * np.eye(self.d)[0]
        other = self.s.point_name(place, "P", self.name)
        moment, again = self.s._moment(place), self.reduced.moved(place).vector
        unit = self.shown.unit("moment")
        self.sheet.text(
            f"Check at another point {other}, {self.point(place)}: from all parts M = {self._vector(moment)}, from R "
            f"and M at {self.name} by ${self.about} + ({self.name} − {other}) times R$: {self._vector(again)} {unit}."
        )

    def _lie(self) -> str:
        from dalembert.wrench import arrangement, concurrency

        how = arrangement(self.s)
        point = concurrency(self.s)
        return how if point is None else f"{how} at {self.point(point)}"

    def _vector(self, v: Array) -> str:
        numbers = [self.moment(x) for x in v]
        return numbers[0] if len(numbers) == 1 else f"({', '.join(numbers)})"

    def _line(self, kind: str) -> None:
        """The line of action of a plane resultant."""
        r, m = self.s.resultant, float(self.reduced.vector[0])
        size, axis = math.hypot(*r), self.s.central_axis().axis
        self.sheet.text(
            "The force is not zero: the system is a single force R on a line that makes the same moment."
        )
        distance = f"{self.length(m / size)} {self.length_unit}"
        lines = [
            Working(f"d = {self.about} / R", f"{self.moment(m)} / {self.force(size)}", distance),
            Working(f"x R_{{y}} − y R_{{x}} = {self.about}: quad {self._equation(r, m)}"),
        ]
        self.sheet.equations(lines)
        cuts = [self._intercepts(axis, name) for name in ("y", "x")]
        self.sheet.text(
            f"Looking along R, the line passes {self.name} at the distance d, to the right where d is positive. "
            f"Measured from {self.name} it {' and '.join(c for c in cuts if c)}."
        )

    def _equation(self, r: Array, m: float) -> str:
        return f"{self.force(r[1])} x − {bracket_negative(self.force(r[0]))} y = {self.moment(m)}"

    def _intercepts(self, axis: Axis, name: str) -> str:
        """Intersections of a line with the axes or planes through the point."""
        k = self.axes.index(name)
        if abs(axis.direction[k]) < 1e-9:
            return ""
        place = axis.crossing(**{name: float(self.at[k])}) - self.at
        if self.d == 2:
            other = "x" if name == "y" else "y"
            return f"cuts {name} = 0 at {other} = {self.length(place[1 - k])} {self.shown.arm_unit}"
        return f"cuts the plane {name} = 0 at {self.point(place)}"

    def _screw(self, kind: str) -> None:
        """The central axis of a system in space."""
        r, m = self.s.resultant, self.reduced.vector
        size, screw = math.hypot(*r), self.s.central_axis()
        moment, length, force = self.unit("moment"), self.length_unit, self.shown.unit("force")
        parts = self.shown.unit("moment").split("·")
        square = "·".join(f"{x}²" if x == force else x for x in parts)  # both have the unit of force
        product = join_numbers(
            [f"{self.force(a)} cdot {bracket_negative(self.moment(b))}" for a, b in zip(r, m, strict=True)]
        )
        value = self.shown.value("force", 1.0) * self.shown.value("moment", float(r @ m))
        foot = np.cross(r / size, m) / size
        lines = [
            Working(f"R cdot {self.about}", product, f'{self.shown.notation.number(value)} "{square}"'),
            Working(f"M = R cdot {self.about} / R", "", f"{self.moment(screw.moment)} {moment}"),
            Working("p = M / R", "", f"{self.length(screw.pitch)} {length}"),
            Working(
                f"r = R times {self.about} / R^{{2}} = ({', '.join(self.length(x) for x in foot)}) {length}"
            ),
        ]
        both = f"R and ${self.about}$"
        words = {
            "single force": f"{both} are perpendicular: the system is a single force R on the line through r.",
            "wrench": f"{both} are not perpendicular: the system is a wrench, R and a couple M along it, on the "
            "central axis through r; p is its pitch. M and p are positive by the right hand along R.",
        }
        self.sheet.text(words[kind])
        self.sheet.equations(lines)
        cuts = [c for c in (self._intercepts(screw.axis, name) for name in "xyz") if c]
        self.sheet.text(
            f"r is the point of the axis nearest to {self.name}. "
            f"Measured from {self.name} the axis {'; it '.join(cuts)}."
        )

    def equilibrium(self) -> None:
        self.sheet.heading("Equilibrium")
        check = self.s.equilibrium()
        self.sheet.text(re.sub(r"-(?=\d)", "−", pretty(check.sentence)))
        self.sheet.text(f"{self._scales()} It is {check.residual:.2g}.")

    def _scales(self) -> str:
        """Divisors of the two parts of the residual."""
        length = self.shown.text("length", self.s.length)
        force = max((f.size for f in self.s.forces), default=0.0)
        if not self.s.length:
            over = ("the largest force", "the largest couple, as no two forces are apart")
        elif self.largest > force:
            over = (f"the largest couple divided by the length {length}", "that couple")
        else:
            over = ("the largest force", f"that force times the length {length}")
        return (
            "The residual is the larger of two parts: the sum of forces over "
            f"{over[0]}, and the sum of moments over {over[1]}."
        )


def _sign(name: str) -> str:
    return as_formula(load_sign(name))


def _formulas(heads: list[str]) -> list[str]:
    """Heads of columns with their indices lowered."""
    return [f"${_lower_case(h)}$" if "_" in h or h in ("x", "y", "z", "M") else h for h in heads]


def _lower_case(head: str) -> str:
    for axis in "xyz":
        head = head.replace(f"_{axis}", f"_{{{axis}}}")
    return head
