"""The inner forces of several links of a machine, with stresses where a section is given."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING

from dalembert.analysis.output.columns import Column, Scale
from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.machine.members.link_balance import acting
from dalembert.machine.members.member_forces import MemberForces, forces_inside
from dalembert.machine.members.stresses import Buckling, Stresses
from dalembert.machine.output.answer import Answer

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


@dataclass(frozen=True)
class MemberTable(Answer):
    """Links by name; ``stress`` and ``buckling`` of those with a section; ``left_out``: why others are not there."""

    NAME = "member"

    result: Result = field(repr=False)
    links: dict[str, MemberForces]
    stress: dict[str, Stresses]
    buckling: dict[str, Buckling]
    left_out: dict[str, str]

    @property
    def unknown(self) -> dict[str, str]:
        """Positions at which some link has not all numbers, with the reason."""
        some = {which for f in self.links.values() for which in f.unknown()}
        return {which: sentence for which, _, sentence in self.result.problems() if which in some}

    def columns(self) -> Iterator[Column]:
        """The drives' positions, every inner force, and the greatest stress."""
        yield from self.drive_columns()
        for link, forces in self.links.items():
            yield from forces.columns()
            if link in self.stress:
                yield Column(f"stress {link}", "pressure", self.stress[link].equivalent)
                yield Column(f"stress {link} at", "length", self.stress[link].place)

    def record(self, to: Scale) -> Tree:
        """The largest of each link over the cycle, in the units of a scale."""
        out: Tree = {}
        for link, forces in self.links.items():
            out[link] = forces.record(to)
            if link in self.stress:
                out[link]["stress"] = _stress_record(self.stress[link], to)
            if link in self.buckling:
                b = asdict(self.buckling[link])
                for key in ("critical", "compression"):
                    b[key] = to("force", b[key])
                out[link]["buckling"] = b | {"position": b["position"] + 1}
        return {"members": out, "left_out": self.left_out, "unknown": self.unknown}


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
        },
    }


def member_table(r: Result, links: Iterable[str] | None = None) -> MemberTable:
    """Inner forces of the links asked for, or of all that have a length; raises ModelError for one asked for that has
    none, and where none has."""
    found: dict[str, MemberForces] = {}
    left: dict[str, str] = {}
    all_of_them = acting(r)
    asked = [links] if isinstance(links, str) else links
    for link in r.links if asked is None else asked:
        try:
            found[link] = forces_inside(r, link, all_of_them)
        except ModelError as error:
            if asked is not None:
                raise
            left[link] = f"{error.what}; {error.remedy}"
    if not found:
        raise ModelError(next(iter(left.values()), "no link moves"), "")
    sections = {link: r.mechanism.links[link].section for link in found}
    stress = {link: found[link].stress() for link, s in sections.items() if s}
    columns = [link for link, s in sections.items() if s and s.elasticity and len(found[link].curves) == 1]
    return MemberTable(r, found, stress, {link: found[link].buckling() for link in columns}, left)
