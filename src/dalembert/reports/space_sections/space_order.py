"""In space: two-force links, the order in which the links can be solved, and each step's equations as one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from dalembert.analysis.methods.applied_forces import joint_place
from dalembert.analysis.methods.members import ZERO, Member, SolutionStep, members, order_of_solution
from dalembert.arrays import Array
from dalembert.reports.report_context import ReportContext, in_ground
from dalembert.reports.sections.matrix import Unknown, matrix_equation, unknowns
from dalembert.reports.sections.terms import floors
from dalembert.reports.sheet import ReportSheet, Working

ABREAST = 3
"""Unknowns side by side in a list."""


def order_and_solution(sheet: ReportSheet, c: ReportContext) -> None:
    """The two-force members, then the steps with their matrices, or the complete system with its size."""
    r = c.r
    sheet.heading("Order of solution")
    every = unknowns(r, c.k, c.shown)
    if r.friction is not None:
        sheet.text(
            f"With friction the equations of the {len(every)} unknowns are not linear, as friction follows the "
            "reactions: all links are solved together, by Newton's method from the answer without friction."
        )
        return
    if r.mobility is not None and r.mobility.redundant:
        _together(sheet, c, every, r.mobility.redundant)
        return
    by_link = {link: _two_force_step(c, member) for link, member in members(r).items()}
    rods = [link for link in by_link if _between_balls(c, link) and by_link[link].kind in ("two-force", ZERO)]
    for link in rods:
        _rod(sheet, c, link, by_link[link])
    steps = order_of_solution(r, by_link)
    order = "; then ".join(step.why for step in steps)
    sheet.text(f"{'In this order' if len(steps) > 1 else 'All at once'}: {order}." if steps else "")
    tensions = {link: _tension(c, link, by_link[link]) for link in rods}
    for step in steps:
        pulled = [u for link, u in tensions.items() if f"the line of {link}" in step.finds]
        _step(sheet, c, step, [*pulled, *(u for u in every if _finds(u, step))])


def _two_force_step(c: ReportContext, member: Member) -> Member:
    """A two-force member as such where that is seen before the solution."""
    if member.kind != "two-force" or _between_balls(c, member.link):
        return member
    return replace(member, kind="general")


def _between_balls(c: ReportContext, link: str) -> bool:
    """True if a link has two ball joints and no other."""
    joints = [d for d in c.r.mechanism.joints.values() if link in d.links]
    return len(joints) == 2 and all(d.ball and not d.slides for d in joints)


def _ends(c: ReportContext, link: str) -> tuple[tuple[str, Array], tuple[str, Array]]:
    """The two joints of a two-force link, and the unit vector from each to the other."""
    a, b = (n for n in c.r.joints if link in c.r.mechanism.joints[n].links)
    span = joint_place(c.r, b)[c.k] - joint_place(c.r, a)[c.k]
    e = span / np.linalg.norm(span)
    return (a, e), (b, -e)


def _rod(sheet: ReportSheet, c: ReportContext, link: str, member: Member) -> None:
    """A two-force link: its direction and what it pulls or pushes."""
    (a, e), (b, _) = _ends(c, link)
    n, state = c.shown.link(link), member.state(c.k)
    state = f", in {state}" if state else " without force" if member.kind == ZERO else ""
    sheet.text(
        f"Link {c.shown.heading(link)} carries the forces of {a} and {b} alone: a two-force member"
        f"{state}. Both forces lie on the line {a}{b}; one unknown is left of them, the "
        f"tension $S_{{{n}}}$ along"
    )
    numbers = ", ".join(c.shown.number("number", float(x)) for x in e)
    sheet.equations([Working(f"e_{{{n}}}", "", f"({numbers})")])


def _tension(c: ReportContext, link: str, member: Member) -> Unknown:
    """The tension of a two-force link as an unknown of its neighbours, which it pulls towards its other end."""
    ends, on = _ends(c, link), dict[str, tuple[Array, Array]]()
    place = joint_place(c.r, ends[0][0])[c.k]
    for joint, e in ends:
        i, j = c.r.mechanism.joints[joint].links
        neighbour = i if j == link else j
        arm = joint_place(c.r, joint)[c.k] - place
        force, couple = on.get(neighbour, (np.zeros(3), np.zeros(3)))
        on[neighbour] = (force + e, couple + np.cross(arm, e))
    value = float(member.tension[c.k]) if member.tension is not None else 0.0
    of = tuple(("joint", joint) for joint, _ in ends)
    return Unknown(f"S_{{{c.shown.link(link)}}}", value, "force", on, place, of)


def _finds(u: Unknown, step: SolutionStep) -> bool:
    """True if a step determines an unknown."""
    ((kind, name),) = u.of
    return any(
        n in step.finds for n in ((f"torque {name}", f"force {name}") if kind == "effort" else (name,))
    )


def _step(sheet: ReportSheet, c: ReportContext, step: SolutionStep, some: list[Unknown]) -> None:
    """The equations of the links of one step as one, or their number where they are too many to print."""
    links = " and ".join(c.shown.heading(link) for link in step.links)
    spinning = {link: _along(c, link) for link in c.r.compiled.passive if link in step.links}
    matrix = matrix_equation(c.r, c.k, c.shown, c.about, step.links, some, spinning)
    if matrix is None:
        _system_size(sheet, c, f"Link{'s' if len(step.links) > 1 else ''} {links}", step.equations, some)
        return
    spins = "".join(
        f" The moments of {c.shown.heading(link)} about {'xyz'[axis]} follow from its others: its spin is free."
        for link, axis in spinning.items()
    )
    words = (
        f"The {len(some)} equations of {links} in matrix form; known terms are on the right (forces in "
        f"{c.shown.unit('force')}, lengths in {c.shown.arm_unit}, moments in {c.shown.unit('moment')}), the "
        f"solution follows them{in_ground(c)}.{spins}"
    )
    sheet.blocks.append(replace(matrix, caption=words))


def _along(c: ReportContext, link: str) -> int:
    """The axis nearest to the line of a link that could spin about it."""
    (_, e), _ = _ends(c, link)
    return int(np.abs(e).argmax())


def _together(sheet: ReportSheet, c: ReportContext, every: list[Unknown], redundant: int) -> None:
    how = "with the joints' stiffness" if "redundant reactions" in c.r.assumptions else "by least squares"
    sheet.text(
        f"With {redundant} redundant constraint{'' if redundant == 1 else 's'} the links cannot be solved one after "
        f"the other: all equations are solved together, {how}."
    )
    _system_size(sheet, c, "All links", 6 * len(c.r.links), every)


def _system_size(
    sheet: ReportSheet, c: ReportContext, links: str, equations: int, some: list[Unknown]
) -> None:
    """The size of a system that is not printed, and its solution."""
    sheet.text(
        f"{links}: {equations} equations with {len(some)} unknowns, assembled from those above and solved as one."
    )
    least = _least(c)
    cells = [(f"${u.sign}$", c.shown.text(u.kind, u.value, least[u.kind])) for u in some]
    cells += [("", "")] * (-len(cells) % ABREAST)
    high = len(cells) // ABREAST
    rows = [[text for n in range(ABREAST) for text in cells[n * high + row]] for row in range(high)]
    caption = f"Reactions as they act on the second link of each joint{in_ground(c)}"
    sheet.table(["Unknown", "Value"] * ABREAST, rows, caption)


def _least(c: ReportContext) -> dict[str, float]:
    """Below these an unknown is rounding."""
    return dict(zip(("force", "moment"), floors(c.r, c.k), strict=False))
