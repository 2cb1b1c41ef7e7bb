"""Free bodies' equations: letters, numbers, results."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from dalembert.analysis.methods.applied_forces import actions, joint_place, on_link
from dalembert.reports.sections.terms import AXES, About, EquationTerm, join_signed, setting, terms
from dalembert.reports.sections.terms import about as at
from dalembert.reports.sheet import Working
from dalembert.views.notation import Shown

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def moment_point(r: Result, link: str, k: int, wanted: str = "") -> About:
    """A joint of one's choice if the link has it.

    Else in the plane the mass centre, or the first joint; in space the joint with the most unknown forces, which then
    are not in the moments, and of several that with the most unknowns.
    """
    joints = [name for name, d in r.mechanism.joints.items() if link in d.links]
    if wanted in joints:
        return About(wanted, joint_place(r, wanted)[k])
    if not joints or (r.mechanism.dimension == 2 and r.mechanism.mass(link)):
        return About("G", r.center(link)[k])
    if r.mechanism.dimension == 2:
        return About(joints[0], joint_place(r, joints[0])[k])
    rows = {n: r.mechanism.joints[n].pair for n in joints}
    most = max(joints, key=lambda n: (len(rows[n].forces), len(rows[n].moments)))
    return About(most, joint_place(r, most)[k])


def link_equations(
    r: Result, link: str, k: int, shown: Shown, wanted: str = ""
) -> tuple[list[Working], About]:
    """Sums of forces along the axes and of moments, each in letters, with numbers, and its value."""
    about, everything = moment_point(r, link, k, wanted), actions(r)
    s = setting(r, link, k, shown, about)
    some = terms(s, on_link(everything, link))
    axes, plane = AXES[: r.mechanism.dimension], r.mechanism.dimension == 2
    lines = []
    for axis, letter in enumerate(axes):
        pieces = [piece for t in some for piece in t.force(axis)]
        lines.append(_line(f"sum F_{{{letter}}}", pieces, shown, "force"))
    for axis, letter in [(2, "")] if plane else list(enumerate(axes)):
        pieces = [piece for t in some for piece in t.moment(axis)]
        lines.append(_line(f"sum M_{{{at(about.name, letter)}}}", pieces, shown, "moment"))
    return lines, about


def _line(left: str, pieces: list[EquationTerm], shown: Shown, kind: str) -> Working:
    """One sum; 1e-9 of its terms' sizes and less is rounding."""
    if not pieces:
        none = "no force acts along it" if kind == "force" else "no moment acts on the link"
        return Working(f'{left}: quad "{none}"')
    total = math.fsum(p.value for p in pieces)
    size = math.fsum(abs(p.value) for p in pieces)
    shown_total = shown.notation.number(0.0 if abs(total) < 1e-9 * size else total)
    letters, numbers = join_signed([p.letters for p in pieces]), join_signed([p.numbers for p in pieces])
    return Working(f"{left}: quad {letters} = 0", f"{numbers} = {shown.with_unit(shown_total, kind)}")
