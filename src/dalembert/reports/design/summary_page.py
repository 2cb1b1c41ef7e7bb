"""First page of a design report: verdicts by section, worst positions, signatures; and the title block."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Sequence
from datetime import date
from itertools import groupby

from dalembert.model.files.source import is_stream
from dalembert.reports.design.verdict import DesignContext, DesignPart, DesignVerdict, State, together
from dalembert.reports.design.worst_positions import WORST_HEADS, worst_rows
from dalembert.reports.sheet import Blanks, ReportSheet
from dalembert.views.notation import pretty

KINDS = ("length", "mass", "force", "moment", "angle", "angular_speed", "pressure", "power", "energy")


def summary(sheet: ReportSheet, c: DesignContext, parts: Sequence[DesignPart]) -> None:
    """The verdict of all, the verdicts by section, the worst position of each thing."""
    sheet.heading("Summary")
    sheet.text(_in_one_sentence(parts))
    rows = [_row(title, [v for part in some for v in part.verdicts]) for title, some in _sections(parts)]
    sheet.table(["Section", "Verdict", "Least limit / value", "Item", "At", "Judged"], rows, words=True)
    for title, some in _sections(parts):
        for state in ("exceeded", "not judged"):
            sheet.text(_named(title, state, [v for part in some for v in part.verdicts if v.state == state]))
    sheet.table(WORST_HEADS, worst_rows(c), "Worst position of each kind of quantity")
    sheet.blocks.append(Blanks((("Checked by", (("name", ""), ("date", ""), ("signature", ""))),)))


def _sections(parts: Sequence[DesignPart]) -> list[tuple[str, list[DesignPart]]]:
    return [(title, list(some)) for title, some in groupby(parts, lambda part: part.title)]


def _in_one_sentence(parts: Sequence[DesignPart]) -> str:
    verdicts = [v for part in parts for v in part.verdicts]
    count = {state: sum(v.state == state for v in verdicts) for state in ("ok", "exceeded", "not judged")}
    limits, rest = count["ok"] + count["exceeded"], count["not judged"]
    first = f"All {limits} limits that can be checked are met."
    if limits < 2:
        first = "The one limit that can be checked is met." if limits else "No limit can be checked."
    if count["exceeded"]:
        first = (
            f"{count['exceeded']} of {limits} limits {'is' if count['exceeded'] == 1 else 'are'} exceeded."
        )
    if rest == 1:
        return f"{first} 1 item is not judged; it is named with the reason."
    return f"{first} {rest} items are not judged; they are named with the reason." if rest else first


def _row(title: str, verdicts: Sequence[DesignVerdict]) -> list[str]:
    """The worst verdict of a section, and how many were judged."""
    known = [v for v in verdicts if v.state != "not judged"]
    worst = min(
        known, key=lambda v: (v.state == "ok", v.margin if v.margin == v.margin else 1e300), default=None
    )
    judged = f"{len(known)} of {len(verdicts)}" if verdicts else "–"
    if worst is None:
        return [title, "not judged" if verdicts else "–", "–", "–", "–", judged]
    return [title, worst.state, worst.factor, worst.item, worst.at or "–", judged]


def _named(title: str, state: State, verdicts: Sequence[DesignVerdict]) -> str:
    """Items of a section that are exceeded, or not judged with the reason: those of one reason together."""
    by: dict[str, list[DesignVerdict]] = {}
    for v in verdicts:
        by.setdefault(v.remark, []).append(v)
    some = []
    for remark, those in by.items():
        names = together(v.item for v in those)
        because = f": {remark.partition(';')[0]}" if remark else ""
        some.append(f"{names}{because}" if names != title else because[2:])
    return f"{title}, {state}: {'; '.join(some)}." if some else ""


def title_block(sheet: ReportSheet, c: DesignContext, notes: Iterable[str] = ()) -> None:
    """File, date, program, units, assumptions, the positions."""
    m, r = c.r.mechanism, c.r
    source = m.source
    name = (
        "–"
        if source is None
        else "standard input"
        if is_stream(source.name)
        else os.path.basename(source.name)
    )
    units = ", ".join(f"{kind.replace('_', ' ')} {pretty(c.to.text(kind))}" for kind in KINDS)
    positions = f"{len(r.status)}, {int(r.ok.sum())} of them solved"
    if r.drives and len(r.status) > 1:
        positions += f", from {c.at(0).partition(' (')[0]} to {c.at(len(r.status) - 1).partition(' (')[0]}"
    rows = [
        ("Machine", m.title or "–"),
        ("Source", m.source_text or "–"),
        ("Model file", name),
        ("Date", date.today().isoformat()),
        ("Program", f"dalembert {sys.modules['dalembert'].__version__}"),
        ("Units", units),
        ("Assumptions", "; ".join(f"{key} {text}" for key, text in r.assumptions.items())),
        ("Mobility", r.mobility.sentence if r.mobility is not None else "–"),
        ("Positions", positions),
        *(("Note", note) for note in notes),
    ]
    sheet.heading("Title block")
    sheet.table(["Entry", "Value"], rows, words=True)
