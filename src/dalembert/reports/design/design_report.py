"""The design report of a result: a page of summary, then every section with its verdicts."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.result.position_lookup import PositionChoice, position_at
from dalembert.progress import progress
from dalembert.reports.design.element_parts import element_parts
from dalembert.reports.design.force_part import force_part
from dalembert.reports.design.given_parts import given_parts
from dalembert.reports.design.motion_part import motion_part
from dalembert.reports.design.power_parts import balance_part, flywheel_part, motor_part, shaking_part
from dalembert.reports.design.start_up import start_up_part
from dalembert.reports.design.strength_parts import bearing_part, member_part, pin_part
from dalembert.reports.design.summary_page import summary, title_block
from dalembert.reports.design.verdict import DesignContext, DesignPart, Parts, attempted
from dalembert.reports.report_context import ReportContext
from dalembert.reports.sections.given import knowns
from dalembert.reports.sheet import PageBreak, ReportSheet
from dalembert.views.notation import Notation, Shown

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

PARTS: tuple[tuple[str, Parts], ...] = (
    ("Motion", motion_part),
    ("Joint forces", force_part),
    ("Pins", pin_part),
    ("Bearings", bearing_part),
    ("Members", member_part),
    ("Machine elements", element_parts),
    ("Motor", motor_part),
    ("Flywheel", flywheel_part),
    ("Shaking force", shaking_part),
    ("Balance", balance_part),
    ("Start-up", start_up_part),
)
"""Title of a section -> what gives it, in the order of the report."""


def design_sheet(
    r: Result, at: PositionChoice = None, notation: Notation | None = None, notes: Iterable[str] = ()
) -> ReportSheet:
    """The design report of a result; ``at``: the position that is drawn, by default the one of the largest effort."""
    notation = notation or Notation()
    k = position_at(r, at if at is not None else worst_position(r))
    c = DesignContext(r, k, notation)
    parts = list[DesignPart]()
    with progress("Design report,", len(PARTS)) as step:
        for done, (title, find) in enumerate(PARTS):
            step(done, title)
            parts += attempted(c, title, find)
    m = r.mechanism
    sheet = ReportSheet(m.title or "Machine", m.source_text, "Design report")
    summary(sheet, c, parts)
    sheet.blocks.append(PageBreak())
    title_block(sheet, c, notes)
    knowns(sheet, ReportContext(r, k, Shown(r, notation, k), notation=notation))
    given_parts(sheet, c)
    for part in parts:
        part.put_on(sheet)
    return sheet


def worst_position(r: Result) -> PositionChoice:
    """The position of the largest effort, or joint force; None where no force is known."""
    names = [*(f"effort.{d}" for d in r.drives), *(f"reaction.{j}" for j in r.joints)]
    for name in names:
        values = np.nan_to_num(r[name])
        if values.any() and np.ptp(np.abs(values), axis=0).any():
            return f"peak {name}"
    return None


def parts_of(r: Result, notation: Notation | None = None) -> list[DesignPart]:
    """The sections of a result's design report with their verdicts, without the report."""
    c = DesignContext(r, position_at(r), notation or Notation())
    return [part for title, find in PARTS for part in attempted(c, title, find)]
