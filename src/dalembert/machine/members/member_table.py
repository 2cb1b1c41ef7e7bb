"""The inner forces of several links of a machine, with stresses where a section is given."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.answer.column import Axes, Column, Scale
from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.machine.members.buckling import Buckling, stepped_column
from dalembert.machine.members.deflections import Deflections
from dalembert.machine.members.link_balance import acting
from dalembert.machine.members.member_forces import MemberForces, forces_inside
from dalembert.machine.members.stresses import Stresses
from dalembert.machine.members.struts import rod_of
from dalembert.machine.output.machine_answer import MachineAnswer

if TYPE_CHECKING:
    from dalembert.analysis.output.summary.printed_units import Printed
    from dalembert.analysis.result.result import Result
    from dalembert.printing import Part
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation, Shown
    from dalembert.views.paper.scene import Scene


@dataclass(frozen=True, eq=False)
class MemberTable(MachineAnswer):
    """Links by name; ``stress`` and ``buckling`` of those with a section; ``left_out``: why others are missing,
    ``not_judged``: why links with a section have no critical compression."""

    result: Result = field(repr=False)
    links: dict[str, MemberForces]
    stress: dict[str, Stresses]
    buckling: dict[str, Buckling]
    left_out: dict[str, str]
    not_judged: dict[str, str] = field(default_factory=dict)
    deflection: dict[str, Deflections] = field(default_factory=dict)

    @property
    def unknown(self) -> dict[str, str]:
        """Positions at which some link has not all numbers, with the reason."""
        some = {which for f in self.links.values() for which in f.unknown()}
        return {which: sentence for which, _, sentence in self.result.problems() if which in some}

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """The drives' positions, every inner force, and the greatest stress."""
        yield from self.drive_columns()
        for link, forces in self.links.items():
            yield from forces.columns()
            if link in self.stress:
                yield Column(f"stress.{link}", "pressure", self.stress[link].equivalent)
                yield Column(f"stress.{link}.place", "length", self.stress[link].place)
            if link in self.buckling:
                b = self.buckling[link]
                yield Column(f"compression.{link}", "force", b.compressions)
                yield Column(f"critical_load.{link}", "force", b.criticals)
                for k, plane in enumerate(self.planes):
                    yield Column(
                        f"effective_length.{link}.{plane.replace(' ', '_')}", "number", b.factors[:, k]
                    )
            if link in self.deflection:
                d = self.deflection[link]
                yield Column(f"deflection.{link}", "length", d.greatest)
                yield Column(f"deflection.{link}.place", "length", d.place)
                for joint, slope in d.slopes().items():
                    yield Column(f"slope.{link}.{joint}", "angle", slope)

    def record(self, to: Scale) -> Tree:
        """The largest of each link over the cycle, in the units of a scale."""
        out: Tree = {}
        for link, forces in self.links.items():
            out[link] = forces.record(to)
            if link in self.stress:
                out[link]["stress"] = _stress_record(self.stress[link], to)
            if link in self.buckling:
                out[link]["buckling"] = self._buckling_record(self.buckling[link], to)
            if link in self.deflection:
                out[link]["deflection"] = _deflection_record(self.deflection[link], to)
        return {
            "members": out,
            "left_out": self.left_out,
            "unknown": self.unknown,
            "not_judged": self.not_judged,
        }

    @property
    def planes(self) -> tuple[str, str]:
        """Words for the two planes of bending."""
        return ("in plane", "across") if self.result.mechanism.dimension == 2 else ("along y", "along z")

    def _buckling_record(self, b: Buckling, to: Scale) -> Tree:
        return {
            "critical": to("force", b.critical),
            "formula": b.formula,
            "slenderness": b.slenderness,
            "compression": to("force", b.compression),
            "position": b.position + 1,
            "safety": b.safety,
            "two_force": b.two_force,
            "effective_length": list(b.effective_length),
            "plane": self.planes[b.plane],
            "ends": list(b.ends),
            "member": b.member,
            "links": list(b.links),
        }

    def printed(self, to: Printed, **choice: Any) -> Iterator[Part]:
        """Printed answer, in the units of a scale."""
        from dalembert.machine.output.member_text import member_parts

        return member_parts(self, to, **choice)

    def scenes(self, notation: Notation) -> list[Scene]:
        """Its drawings in a notation."""
        from dalembert.views.machine.member_views import member_scenes

        return member_scenes(self, notation)

    def section(self, sheet: ReportSheet, shown: Shown) -> None:
        """Its equations in letters and numbers, put on a sheet."""
        from dalembert.reports.machine_sections.member_section import member_section

        member_section(sheet, self, shown)


def _deflection_record(d: Deflections, to: Scale) -> Tree:
    slopes = {joint: to("angle", float(np.nanmax(slope))) for joint, slope in d.slopes().items()}
    place = to("length", float(d.place[d.position]))
    where = {"member": d.member[d.position], "at": place, "position": d.position + 1}
    return {"largest": to("length", d.largest), **where, "slopes": slopes}


def _stress_record(s: Stresses, to: Scale) -> Tree:
    f = s.fatigue()
    return {
        "largest": to("pressure", s.largest),
        "member": s.member[s.position],
        "at": to("length", float(s.place[s.position])),
        "position": s.position + 1,
        "safety": s.safety,
        "fatigue": {
            "member": f.member,
            "at": to("length", f.place),
            "mean": to("pressure", f.mean),
            "amplitude": to("pressure", f.amplitude),
            "safety": f.safety,
            "sampling": f.sampling,
        },
    }


def member_table(r: Result, links: Iterable[str] | None = None) -> MemberTable:
    """Inner forces of the links asked for, or of all that have a length; raises ModelError for one asked for that has
    none, and where none has."""
    forces: dict[str, MemberForces] = {}
    left: dict[str, str] = {}
    all_of_them = acting(r)
    names = [links] if isinstance(links, str) else links
    for link in r.links if names is None else names:
        try:
            forces[link] = forces_inside(r, link, all_of_them)
        except ModelError as error:
            if names is not None:
                raise
            left[link] = f"{error.what}; {error.remedy}"
    if not forces:
        raise ModelError(next(iter(left.values()), "no link moves"), "")
    sections = {link: r.mechanism.links[link].section for link in forces}
    stress = {link: forces[link].stress() for link, s in sections.items() if s}
    buckled, why = buckled_links(r, {link: forces[link] for link, s in sections.items() if s})
    bent = {link: forces[link].deflection() for link, s in sections.items() if s and s.elasticity}
    return MemberTable(r, forces, stress, buckled, left, why, bent)


def buckled_links(r: Result, some: dict[str, MemberForces]) -> tuple[dict[str, Buckling], dict[str, str]]:
    """Buckling of links with a section, barrel and rod as one column, and why others are not judged."""
    out: dict[str, Buckling] = {}
    why: dict[str, str] = {}
    left = dict(some)
    while left:
        link = next(iter(left))
        column, joints = _sliding(r, link, left)
        for name in column:
            del left[name]
        try:
            if len(column) > 2:
                what = f"{', '.join(column)} slide in each other, and only two links are judged as one column"
                raise ModelError(what, "give each an effective_length")
            reason = (
                stepped_column(some[link], some[column[1]], joints[0]) if joints else some[link].buckling()
            )
            out |= dict.fromkeys(column, reason)
        except ModelError as error:
            why[" and ".join(column)] = f"{error.what}; {error.remedy}"
    return out, why


def _sliding(r: Result, link: str, some: dict[str, MemberForces]) -> tuple[list[str], list[str]]:
    """A link with those that slide in it or in each other along its line, and the joints by which they do."""
    free = {n: f for n, f in some.items() if not r.mechanism.links[n].effective_length}
    column, joints = [link], []
    for one in column if link in free else ():
        while (rod := rod_of(r, one, {n: f for n, f in free.items() if n == one or n not in column}))[1]:
            joints.append(rod[0])
            column.append(rod[1])
    return column, joints
