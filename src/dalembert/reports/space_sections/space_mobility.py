"""In space: the degree of freedom by count and by rank, and the redundant constraints."""

from __future__ import annotations

from dalembert.analysis.degree_of_freedom import Mobility
from dalembert.analysis.result.reaction_components import unknown_count
from dalembert.reports.report_context import ReportContext
from dalembert.reports.sheet import ReportSheet, Working


def degrees_of_freedom(sheet: ReportSheet, c: ReportContext) -> None:
    """Each joint with what it carries, their sum, and what the rank says of it."""
    r, mobility = c.r, c.r.mobility
    if mobility is None:
        return
    sheet.heading("Degree of freedom")
    rows = [_row(c, joint) for joint in r.joints]
    constraints = sum(unknown_count(r, joint) for joint in r.joints)
    heads = ["Joint", "Type", "Links", "Reactions, joint axes", "Constraints"]
    caption = (
        "By the table of pairs: a force along every axis without slide, a moment about every one without turn"
    )
    sheet.table(heads, [*rows, ["sum", "", "", "", str(constraints)]], caption, total=True)
    n, passive = len(r.links), len(mobility.passive)
    count = 6 * n - constraints
    lines = [Working("F = 6 n − sum c", f"6 cdot {n} − {constraints}", _integer(count))]
    if passive:
        lines.append(Working('F − "spins"', f"{_integer(count)} − {passive}", _integer(count - passive)))
    sheet.equations(lines)
    sheet.text(" ".join(_words(mobility, n, constraints)))


def _row(c: ReportContext, joint: str) -> list[str]:
    described = c.r.mechanism.joints[joint]
    carried = ", ".join(f"${name[0]}_{{{name[1]}'}}$" for name in described.pair.reactions)
    if described.pair.threaded:
        carried += " ($M_{x'}$ with $F_{x'}$)"
    links = " – ".join(c.shown.heading(link) for link in described.links)
    count = str(unknown_count(c.r, joint))
    return [joint, described.type.replace("_", " "), links, carried or "the force of the teeth", count]


def _words(dof: Mobility, n: int, constraints: int) -> list[str]:
    """Sentences on free spins, rank, redundancy and drives."""
    out, motions = [], 6 * n - len(dof.passive)
    if dof.passive:
        out.append(
            f"{' and '.join(dof.passive)} could spin about the line of two ball joints, which moves nothing else: "
            "set to no spin."
        )
    out.append(
        f"By rank: the matrix of the {constraints} constraints has the rank {motions - dof.freedoms}, so that "
        f"{dof.freedoms} of {motions} motions {'is' if dof.freedoms == 1 else 'are'} left."
    )
    if dof.redundant:
        verb = "is" if dof.redundant == 1 else "are"
        out.append(
            f"{dof.redundant} of the constraints {verb} redundant, among joints {', '.join(dof.redundant_joints)}: "
            "the count alone is wrong by as many, and equilibrium alone does not settle all reactions."
        )
    else:
        out.append("No constraint is redundant.")
    drives = f"{dof.drives} drive{'' if dof.drives == 1 else 's'}" if dof.drives else "no drive"
    return [*out, f"Mobility {dof.freedoms}, {drives}."]


def _integer(number: int) -> str:
    return str(number).replace("-", "−")
