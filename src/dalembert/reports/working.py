"""The hand calculation of a result, section by section, with the numbers that were computed."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import actions
from dalembert.analysis.methods.members import components_along
from dalembert.analysis.methods.solved.carried_out import solved_forces
from dalembert.analysis.methods.solved.step_choice import Choice
from dalembert.analysis.result.number_kinds import drive_kinds, load_kind
from dalembert.analysis.result.position_lookup import (
    PositionChoice,
    extreme,
    has_forces,
    position_at,
    position_sentence,
)
from dalembert.answer.column import UnitChoice
from dalembert.errors import ModelError
from dalembert.reports.element_sections.belt_lines import belts_and_ropes
from dalembert.reports.element_sections.brake_section import brakes
from dalembert.reports.element_sections.law_lines import motion_laws
from dalembert.reports.element_sections.screw_lines import power_screws
from dalembert.reports.report_context import METHODS, Method, ReportContext, as_formula, figure, in_ground
from dalembert.reports.sections import equilibrium_equations, friction, matrix
from dalembert.reports.sections.given import knowns
from dalembert.reports.sections.methods import checks, cycle, graphical
from dalembert.reports.sections.motion import inertia, motion
from dalembert.reports.sections.motion_steps import motion_steps
from dalembert.reports.sections.solution_steps import solution_steps
from dalembert.reports.sections.sources import shown_name, source_arms, superposition, virtual_work
from dalembert.reports.sheet import Drawings, ReportSheet, Working
from dalembert.reports.space_sections.space_friction_laws import space_friction
from dalembert.reports.space_sections.space_mobility import degrees_of_freedom
from dalembert.reports.space_sections.space_motion import space_inertia, space_motion
from dalembert.reports.space_sections.space_order import order_and_solution
from dalembert.reports.space_sections.space_reactions import reaction_tables
from dalembert.reports.writers.plain_writer import plain_block
from dalembert.views import both_ends, draw
from dalembert.views.notation import Notation, Shown, load_sign

if TYPE_CHECKING:
    from dalembert.analysis.methods.solved.solution_by_steps import PaperSolution
    from dalembert.analysis.result.result import Result


def working(
    r: Result,
    at: PositionChoice = None,
    methods: tuple[Method, ...] = METHODS,
    notation: Notation | None = None,
    choice: Choice | None = None,
) -> ReportSheet:
    """The worked solution of one position of a result, with charts where there are more."""
    notation = notation or Notation()
    plane = r.mechanism.dimension == 2
    if not plane and notation.torque < 0:
        raise ModelError(
            "moments cannot be counted clockwise in space",
            "leave it out: they are positive by the right hand",
        )
    k = position_at(r, at)
    c = ReportContext(r, k, Shown(r, notation, k), methods, choice or Choice(), notation)
    m = r.mechanism
    sought = isinstance(at, str) and extreme(r, at) is not None
    where = position_sentence(r, k, at) if sought else _where(c)
    sheet = ReportSheet(m.title or "Force analysis", m.source_text, where)
    knowns(sheet, c)
    if not plane:
        degrees_of_freedom(sheet, c)
    if both_ends.open_at(r, c.k):
        friction.at_rest(sheet, c, _joint_forces)
        return sheet
    if not has_forces(r, c.k):
        sheet.heading("No answer")
        sheet.text(f"{r.status[c.k]}: {r.reasons[c.k]}")
        return sheet
    if r.reasons[c.k]:
        sheet.text(f"{r.status[c.k]}: {r.reasons[c.k]}")
    cycle_context, c = c, replace(c, r=r.before) if r.reverses[c.k] else c
    if plane:
        motion_laws(sheet, c)
    if plane and "steps" in methods and r.drives:
        motion_steps(sheet, c)
    (motion if plane else space_motion)(sheet, c)
    (inertia if plane else space_inertia)(sheet, c)
    (friction.friction if plane else space_friction)(sheet, c)
    brakes(sheet, c)
    if "steps" in methods:
        steps(sheet, c)
    _bodies(sheet, c)
    _answers(sheet, c)
    if plane:
        belts_and_ropes(sheet, c)
    power_screws(sheet, c)
    if "graphical" in methods and plane:
        graphical(sheet, c)
    if "superposition" in methods:
        superposition(sheet, c)
    if "virtual-work" in methods:
        virtual_work(sheet, c)
    if cycle_context is not c:
        _just_after(sheet, replace(c, r=r.sides[1]))
    cycle(sheet, cycle_context)
    checks(sheet, c)
    return sheet


def steps(sheet: ReportSheet, c: ReportContext, drawn: bool = True) -> None:
    """The solution solved: one unknown after the other."""
    solved = solved_forces(c.r, c.k, c.choice)
    if not solved.steps:
        return
    sheet.heading("Forces, one unknown after the other")
    solution_steps(sheet, c, solved, drawn)


def _just_after(sheet: ReportSheet, c: ReportContext) -> None:
    """Values that differ just after contacts have reversed; all before them in the sheet are just before."""
    sheet.heading("Just after the reversal")
    sheet.text("The motion and the loads are the same, the friction of what reversed has its other sense.")
    (friction.friction if c.r.mechanism.dimension == 2 else space_friction)(sheet, c)
    _bodies(sheet, c)
    _answers(sheet, c)


def _where(c: ReportContext) -> str:
    parts = []
    for d in c.r.drives:
        kinds = drive_kinds(c.r, d)
        parts.append(f"{d} = {c.shown.text(kinds['position'], float(c.r.drive_position(d)[c.k]))}")
    many = f", position {c.k + 1} of {len(c.r.status)}" if len(c.r.status) > 1 else ""
    return (f"Position {', '.join(parts)}" if parts else "Structure") + many


def _bodies(sheet: ReportSheet, c: ReportContext) -> None:
    r, shown = c.r, c.shown
    if "steps" not in c.methods:
        sheet.heading("Free bodies and their equations")
        sheet.figure(*(draw.free_body(r, link, c.k + 1, c.notation) for link in r.links))
    if "matrix" not in c.methods:
        return
    if "steps" in c.methods:
        sheet.heading("All equations at once")
    if r.friction is not None and r.mechanism.dimension == 2:
        sheet.text(
            "A reaction on its friction circle is the same as the force at the pin's centre and the couple "
            "$M_{f} = ± r F$; on a guide $N$ is the normal force and $F_{f}$ the friction. So the equations are:"
        )
    if any(r.mechanism.joints[joint].wheels for joint in r.joints) and r.mechanism.dimension == 3:
        sheet.text(
            "Teeth press with one force, along their line of pressure: the figures before it are the cosines of that "
            "line, in the moments its arms."
        )
    for link in r.links:
        lines, about = equilibrium_equations.link_equations(r, link, c.k, shown, c.about)
        place = "the mass centre G" if about.name == "G" else f"joint {about.name}"
        arm_unit = f" (in {shown.arm_unit})" if shown.arm_unit != shown.unit("length") else ""
        sheet.text(
            f"Link {shown.heading(link)}, moments about {place}; R{arm_unit} from that point to each force:"
        )
        sheet.equations(lines)
    if r.mechanism.dimension == 3:
        order_and_solution(sheet, c)
        return
    equation = matrix.matrix_equation(r, c.k, shown, c.about)
    if equation is not None:
        sheet.heading(f"The {len(equation.unknowns)} equations in matrix form", 2)
        units = (
            f"forces in {shown.unit('force')}, lengths in {shown.arm_unit}, moments in {shown.unit('moment')}"
        )
        words = f"Known terms are on the right ({units}){in_ground(c)}, followed by the solution."
        sheet.blocks.append(replace(equation, caption=words))


def _answers(sheet: ReportSheet, c: ReportContext) -> None:
    sheet.heading("Joint forces and efforts" if c.r.mechanism.dimension == 2 else "Reactions and efforts")
    _joint_forces(sheet, c)


def _joint_forces(sheet: ReportSheet, c: ReportContext) -> None:
    """Table of the joint forces, then the efforts and unknown loads."""
    if c.r.mechanism.dimension == 3:
        reaction_tables(sheet, c)
        sheet.equations(_efforts(c))
        return
    heads = ["Joint", "Force", "x", "y", "size", "angle °", "along", "across"]
    sheet.table(
        [*heads, f"couple ({c.shown.unit('moment')})"],
        [_force_row(c, joint) for joint in c.r.joints],
        f"Forces in {c.shown.unit('force')}{in_ground(c)}, on the link that the symbol names; "
        "components along and across that link",
    )
    sheet.equations(_efforts(c))


def _force_row(c: ReportContext, joint: str) -> list[str]:
    """One joint's force on its j, or on its i where j is ground."""
    r, shown, k = c.r, c.shown, c.k
    i, j = r.mechanism.joints[joint].links
    on = j if j != "ground" else i
    f = r.reaction(joint, on)[k]
    moment = float(r.reaction_moment(joint, on)[k])
    part = next(a for a in actions(r) if a.kind == "joint" and a.of == joint and a.link == on)
    a = replace(part, force=r.reaction(joint, on))
    along = components_along(r, a, k) if np.isfinite(f).all() else (math.nan, math.nan)
    return [
        joint,
        as_formula(shown.reaction(joint, on)),
        *(shown.number("force", float(x)) for x in f),
        shown.number("force", float(np.hypot(*f))),
        c.notation.direction(*map(float, f)) if np.hypot(*f) > shown.least["force"] else "–",
        *(shown.number("force", x) for x in along),
        shown.number("moment", moment) if abs(moment) > shown.least["moment"] else "–",
    ]


def _efforts(c: ReportContext) -> list[Working]:
    """Efforts and unknown loads with their values."""
    r, k = c.r, c.k

    rows = [(shown_name(c, "effort", d), drive_kinds(r, d)["effort"], r.effort(d)[k]) for d in r.drives]
    rows += [(load_sign(u), load_kind(r, u), r.unknown_load(u)[k]) for u in r.unknown_loads]
    return [Working(f"{name} = {figure(c.shown, kind, float(value))}") for name, kind, value in rows]


def steps_sheet(solution: PaperSolution, notation: Notation | None = None, drawn: bool = True) -> ReportSheet:
    """The solved solution by itself."""
    r, k, notation = solution.result, solution.position, notation or Notation()
    r = r.before if r.reverses[k] else r
    c = ReportContext(r, k, Shown(r, notation, k), METHODS, solution.choice, notation)
    sheet = ReportSheet(r.mechanism.title or "Force analysis", r.mechanism.source_text, _where(c))
    if r.mechanism.dimension == 2 and r.drives:
        motion_steps(sheet, c)
    if r.mechanism.dimension == 2:
        friction.friction(sheet, c)
    steps(sheet, c, drawn)
    source_arms(sheet, c)
    return sheet


def steps_text(solution: PaperSolution, units: UnitChoice = "file") -> str:
    """The same as text without drawings."""
    sheet = steps_sheet(solution, Notation(units=units), drawn=False)
    return "\n\n".join(plain_block(b) for b in sheet.blocks if not isinstance(b, Drawings))
