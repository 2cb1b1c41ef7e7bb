"""In space: the degree of freedom by count and by rank, and the redundant constraints."""

from __future__ import annotations

from dalembert.analysis.degree_of_freedom import Mobility
from dalembert.analysis.result.reaction_components import unknown_count
from dalembert.reports.report_context import ReportContext
from dalembert.reports.sheet import Sheet, Working


def degrees_of_freedom(sheet: Sheet, c: ReportContext) -> None:
    """Each joint with what it carries, their sum, and what the rank says of it."""
    r, found = c.r, c.r.mobility
    if found is None:
        return
    sheet.heading("Degree of freedom")
    rows = [_row(c, joint) for joint in r.joints]
    constraints = sum(unknown_count(r, joint) for joint in r.joints)
    heads = ["Joint", "Type", "Links", "Reactions, joint axes", "Constraints"]
    caption = (
        "By the table of pairs: a force along every axis without slide, a moment about every one without turn"
    )
    sheet.table(heads, [*rows, ["sum", "", "", "", str(constraints)]], caption, total=True)
    n, passive = len(r.links), len(found.passive)
    count = 6 * n - constraints
    lines = [Working("F = 6 n − sum c", f"6 cdot {n} − {constraints}", _whole(count))]
    if passive:
        lines.append(Working('F − "spins"', f"{_whole(count)} − {passive}", _whole(count - passive)))
    sheet.equations(lines)
    sheet.text(" ".join(_words(found, n, constraints)))


def _row(c: ReportContext, joint: str) -> list[str]:
    described = c.r.mechanism.joints[joint]
    carried = ", ".join(f"${name[0]}_{{{name[1]}'}}$" for name in described.pair.reactions)
    if described.pair.threaded:
        carried += " ($M_{x'}$ with $F_{x'}$)"
    links = " – ".join(c.shown.heading(link) for link in described.links)
    count = str(unknown_count(c.r, joint))
    return [joint, described.type.replace("_", " "), links, carried or "the force of the teeth", count]


def _words(found: Mobility, n: int, constraints: int) -> list[str]:
    """Sentences on free spins, rank, redundancy and drives."""
    out, motions = [], 6 * n - len(found.passive)
    if found.passive:
        out.append(
            f"{' and '.join(found.passive)} could spin about the line of two ball joints, which moves nothing else: "
            "set to no spin."
        )
    out.append(
        f"By rank: the matrix of the {constraints} constraints has the rank {motions - found.freedoms}, so that "
        f"{found.freedoms} of {motions} motions {'is' if found.freedoms == 1 else 'are'} left."
    )
    if found.redundant:
        verb = "is" if found.redundant == 1 else "are"
        out.append(
            f"{found.redundant} of the constraints {verb} redundant, among joints {', '.join(found.redundant_joints)}: "
            "the count alone is wrong by as many, and equilibrium alone does not settle all reactions."
        )
    else:
        out.append("No constraint is redundant.")
    drives = f"{found.drives} drive{'' if found.drives == 1 else 's'}" if found.drives else "no drive"
    return [*out, f"Mobility {found.freedoms}, {drives}."]


def _whole(number: int) -> str:
    return str(number).replace("-", "−")
