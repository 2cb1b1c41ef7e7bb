"""In space: the unknowns of each joint, and the computed reactions, in ground axes and in the joints' axes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from dalembert.model.joints.pairs import AXES
from dalembert.reports.report_context import ReportContext, as_formula
from dalembert.reports.sections.terms import floors
from dalembert.reports.sheet import ReportSheet


def reaction_tables(sheet: ReportSheet, c: ReportContext) -> None:
    """Forces and moments of all joints by components and sizes; what is not unique in brackets."""
    r, on = c.r, {joint: _acting_link(c, joint) for joint in c.r.joints}
    least = floors(r, c.k)
    for axes, words, prime in (("ground", "ground axes", ""), ("joint", "each joint's axes", "'")):
        heads = ["Joint", "Force", *(f"{a}{prime}" for a in AXES), "size"]
        heads += ["Moment", *(f"{a}{prime}" for a in AXES), "size"]
        rows = [_row(c, joint, on[joint], axes, least) for joint in r.joints]
        caption = (
            f"In {words}; forces in {c.shown.unit('force')}, moments in {c.shown.unit('moment')} about the joint, "
            f"on the link that the symbol names{', friction in them' if r.friction is not None else ''}"
        )
        sheet.table(heads, rows, caption)
    sheet.text(uniqueness(c))


def _acting_link(c: ReportContext, joint: str) -> str:
    """j of a joint, or i where j is the ground."""
    i, j = c.r.mechanism.joints[joint].links
    return j if j != "ground" else i


def _row(c: ReportContext, joint: str, on: str, axes: Any, least: tuple[float, ...]) -> list[str]:
    """One joint's force and moment; a dash where it cannot carry a component along its local axes."""
    r, k, shown = c.r, c.k, c.shown
    exact = np.concatenate([f(joint, on, axes)[k] for f in (r.reaction, r.reaction_moment)])
    components = r.least_norm(joint, on, axes)[k]
    row = [joint]
    for n, (kind, sign) in enumerate((("force", shown.reaction), ("moment", shown.joint_moment))):
        part, known = components[3 * n : 3 * n + 3], np.isfinite(exact[3 * n : 3 * n + 3])
        if n and not r.mechanism.joints[joint].pair.moments and not (np.abs(part) > least[1]).any():
            return [*row, *["–"] * 5]
        carried = _carried_components(c, joint, n) if axes == "joint" else (True,) * 3
        row.append(as_formula(sign(joint, on)))
        for value, is_known, is_carried in zip(map(float, part), known, carried, strict=True):
            text = shown.number(kind, value, least[n])
            row.append(
                "–" if not is_carried and abs(value) <= least[n] else text if is_known else f"({text})"
            )
        size = shown.number(kind, math.hypot(*part), least[n])
        row.append(size if known.all() else f"({size})")
    return row


def _carried_components(c: ReportContext, joint: str, moments: int) -> tuple[bool, ...]:
    """Components along its local axes that a joint carries; for a gear any."""
    described = c.r.mechanism.joints[joint]
    pair = described.pair
    letters = pair.moments if moments else pair.forces
    screw = pair.threaded and moments == 1
    return tuple(described.wheels > 0 or a in letters or (screw and a == "x") for a in AXES)


def uniqueness(c: ReportContext) -> str:
    """Reactions that equilibrium alone does not determine, in the joints' axes."""
    r, names = c.r, []
    for joint in r.joints:
        exact = np.concatenate([f(joint, None, "joint")[c.k] for f in (r.reaction, r.reaction_moment)])
        free = [
            f"${'FM'[n // 3]}_{{{AXES[n % 3]}'}}$"
            for n in range(6)
            if not np.isfinite(exact[n]) and _carried_components(c, joint, n // 3)[n % 3]
        ]
        if free:
            names.append(f"{joint} ({', '.join(free)})")
    if names:
        return (
            f"Not unique, because equilibrium alone does not determine them: {'; '.join(names)}. Figures in brackets "
            "have the least sum of squares, one answer of many that balance all links; the others hold in all of them."
        )
    settled = r.assumptions.get("redundant reactions")
    if settled and r.unique_array is not None:
        return f"Equilibrium alone does not determine all reactions; they are computed {settled}."
    return "Every reaction is unique: equilibrium alone determines it."
