"""Given data: links, joints, drives, loads, assumptions."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import pairwise

import numpy as np

from dalembert.analysis.methods.inertia_couples import inertia_matrix
from dalembert.analysis.output.rounding import PART
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.model import GROUND
from dalembert.model.joints.pairs import AXES
from dalembert.model.quantities.dependent_numbers import Dependent
from dalembert.reports.pictures import stated_picture
from dalembert.reports.report_context import ReportContext, as_formula
from dalembert.reports.sheet import ReportSheet
from dalembert.views.notation import Shown, load_sign, pretty
from dalembert.views.stated import (
    axes_text,
    drive_text,
    joint_text,
    load_text,
    mass_text,
    place_text,
    weights_text,
)


def knowns(sheet: ReportSheet, c: ReportContext) -> None:
    """Tables of what the file says; of its numbers none is rounding, however small."""
    c = replace(c, shown=Shown(c.r, c.notation))
    r, shown, m = c.r, c.shown, c.r.mechanism
    sheet.heading("Given")
    sheet.table(["Parameter", "Value", "Meaning"], _parameters(c))
    _links(sheet, c)
    stated_axes = axes_text if c.question else lambda _: ""
    joints = [
        [
            name,
            f"{d.type}{joint_text(shown, name)}{stated_axes(d)}",
            f"{shown.heading(d.links[0])} – {shown.heading(d.links[1])}",
        ]
        for name, d in m.joints.items()
    ]
    drives = [[f"drive {d}", *_drive_row(c, d)] for d in r.drives]
    sheet.table(["Joint or drive", "Type or motion", "Links"], [*joints, *drives])
    if m.dimension == 3 and not c.question:
        joint_axes(sheet, c)
    loads = [
        [
            as_formula(load_sign(n)),
            load.type.replace("_", " "),
            load_text(shown, c.k, n, c.written.load(n) if c.written else ""),
        ]
        for n, load in m.loads.items()
    ]
    sheet.table(["Load", "Type", "Value"], loads)
    assumed = "; ".join(f"{name} {value}" for name, value in r.assumptions.items())
    divided = weights_text(shown) if c.question else ""
    sheet.text(f"{divided}{'. ' * bool(divided)}Assumptions: {assumed}. {_convention(c)}")
    sheet.figure(stated_picture(c))


def _parameters(c: ReportContext) -> list[list[str]]:
    """The file's parameters: name, expression and value, in their units."""
    rows = []
    for name, p in c.r.mechanism.parameters.items():
        number = f"{p.in_unit():.{c.notation.figures}g} {pretty(p.unit)}".strip()
        follows = f"{p.value.expression.text} = " if isinstance(p.value, Dependent) else ""
        rows.append([name, follows + number, p.about or "–"])
    return rows


def _links(sheet: ReportSheet, c: ReportContext) -> None:
    """Points, mass and mass centre of each link; its inertia, in space as a separate table."""
    r, shown, m = c.r, c.shown, c.r.mechanism
    rows = []
    for link in r.links:
        g = m.center(link)
        cells = [
            shown.heading(link),
            "; ".join(
                f"{n} {(c.written and c.written.point(link, n)) or f'({place_text(shown, p)})'}"
                for n, p in m.points(link).items()
            ),
            _mass(c, link) if m.mass(link) else "massless",
            ((c.written and c.written.center(link)) or place_text(shown, g)) if m.mass(link) else "–",
        ]
        if m.dimension == 2:
            written = c.written.of_link(link, "inertia", "inertia") if c.written else ""
            cells.append((written or shown.text("inertia", m.inertia(link))) if m.inertia(link) else "–")
        rows.append(cells)
    length = shown.unit("length")
    heads = ["Link", f"Points, link axes ({length})", "Mass", f"Centre ({length})"]
    sheet.table([*heads, "Inertia"] if m.dimension == 2 else heads, rows)
    if m.dimension == 3 or c.question:
        ground = "; ".join(f"{n} ({place_text(shown, p)})" for n, p in m.points(GROUND).items())
        sheet.text(f"On the ground ({length}): {ground}." if ground else "")
    if c.question and (between := lengths(c)):
        sheet.text(f"Lengths ({length}): {', '.join(between)}.")
    if m.dimension == 3:
        _inertias(sheet, c)


def _mass(c: ReportContext, link: str) -> str:
    if not c.question:
        return c.shown.text("mass", c.r.mechanism.mass(link))
    return (c.written and c.written.of_link(link, "mass", "mass")) or mass_text(c.shown, link)


def lengths(c: ReportContext) -> list[str]:
    """Distances between the joints of each moving link, one after the other: `AB = 15`."""
    m, out = c.r.mechanism, []
    for link in c.r.links:
        places: dict[str, np.ndarray] = {}
        for name, joint in m.joints.items():
            for end, at in zip(joint.links, m.joint_points(name), strict=True):
                named = [n for n, p in m.points(link).items() if end == link and np.allclose(p, at)]
                places |= {n: np.asarray(at, float) for n in named[:1]}
        for (a, p), (b, q) in pairwise(places.items()):
            if (distance := float(np.linalg.norm(q - p))) > PART * c.r.compiled.layout.length:
                out.append(f"{a}{b} = {c.shown.number('length', distance)}")
    return list(dict.fromkeys(out))


def _inertias(sheet: ReportSheet, c: ReportContext) -> None:
    """Matrices J of inertia about the mass centres; the off-diagonal elements are the negative products of inertia."""
    r, shown = c.r, c.shown
    matrices = {link: inertia_matrix(r, link) for link in r.links}
    matrices = {link: j for link, j in matrices.items() if j.any()}
    diagonal = not any((j - np.diag(np.diag(j))).any() for j in matrices.values())
    places = [(0, 0), (1, 1), (2, 2), *([] if diagonal else [(0, 1), (0, 2), (1, 2)])]
    heads = ["Link", *(f"$J_{{{AXES[a]}{AXES[b]}}}$" for a, b in places)]
    rows = []
    for link, j in matrices.items():
        least = PART * float(np.abs(j).max())
        rows.append([shown.heading(link), *(shown.number("inertia", float(j[p]), least) for p in places)])
    about = f"Inertia ({shown.unit('inertia')}) about the mass centre, in link axes"
    sheet.table(
        heads, rows, about if diagonal else f"{about}; off the diagonal J holds the products with a minus"
    )


def joint_axes(sheet: ReportSheet, c: ReportContext) -> None:
    """Each joint's local axes at this position, in ground axes."""
    rows = []
    for joint in c.r.joints:
        described = c.r.mechanism.joints[joint]
        axes = c.r.joint_axes(joint)[c.k]
        rows.append(
            [
                joint,
                *(f"({', '.join(_cosine(float(x), c.notation.figures) for x in e)})" for e in axes),
                _add_primes(described.pair.local),
            ]
        )
    heads = ["Joint", "x'", "y'", "z'", "Meaning"]
    sheet.table(heads, rows, "The joints' local axes (primed) at this position, in ground axes")


def _add_primes(words: str) -> str:
    """The letters of a joint's axes with their prime."""
    return re.sub(r"\b([xyz])\b", r"\1'", words)


def _cosine(x: float, figures: int) -> str:
    return "0" if abs(x) < PART else f"{x:.{figures}f}".rstrip("0").rstrip(".").replace("-", "−")


def _convention(c: ReportContext) -> str:
    n = c.notation
    space = c.r.mechanism.dimension == 3
    first = "by link i on link j" if n.order == "by-on" else "on link i by link j"
    sense = "counter-clockwise" if n.torque > 0 else "clockwise"
    ground = "ground axes" if space else "ground axes (x right, y up)"
    axes = ground if n.axes == "ground" else "the axes of the link acted on"
    if space:
        return (
            f"${n.letter}_{{ij}}$ is the force and $M_{{ij}}$ the moment about the joint {first}; moments are positive "
            f"by the right hand; components in {axes}, with a prime along the joint's axes."
        )
    return f"${n.letter}_{{ij}}$ is the force {first}; moments are positive {sense}; components in {axes}."


def _drive_row(c: ReportContext, d: str) -> list[str]:
    if c.question:
        written = c.written.drive(d, drive_kinds(c.r, d)) if c.written else ""
        return [written or drive_text(c.shown, c.k, d), ""]
    r, shown, kinds = c.r, c.shown, drive_kinds(c.r, d)
    motion = ", ".join(
        shown.text(kinds[name], float(values[c.k]))
        for name, values in (
            ("position", r.drive_position(d)),
            ("speed", r.drive_speed(d)),
            ("acceleration", r.drive_acceleration(d)),
        )
    )
    return [motion, ""]
