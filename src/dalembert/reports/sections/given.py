"""What is given: links, joints, drives, loads, assumptions."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import numpy as np

from dalembert.analysis.compile.contacts import coefficient, resting_coefficient
from dalembert.analysis.methods.applied_forces import actions
from dalembert.analysis.methods.inertia_couples import inertia_matrix
from dalembert.analysis.output.columns import drive_kinds
from dalembert.analysis.output.rounding import PART
from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.model.joints.pairs import AXES
from dalembert.model.joints.plane_joints import Joint
from dalembert.reports.pictures import given_picture
from dalembert.reports.report_context import ReportContext, as_formula
from dalembert.reports.sheet import Sheet
from dalembert.views.notation import Shown, own_name


def knowns(sheet: Sheet, c: ReportContext) -> None:
    """Tables of what the file says; of its numbers none is rounding, however small."""
    c = replace(c, shown=Shown(c.r, c.notation))
    r, shown, m = c.r, c.shown, c.r.mechanism
    sheet.heading("Given")
    _links(sheet, c)
    joints = [
        [
            name,
            f"{d.type}{_measures(shown, d)}{_friction(c, d)}",
            f"{shown.heading(d.links[0])} – {shown.heading(d.links[1])}",
        ]
        for name, d in m.joints.items()
    ]
    drives = [[f"drive {d}", *_drive_row(c, d)] for d in r.drives]
    sheet.table(["Joint or drive", "Type or motion", "Links"], [*joints, *drives])
    if m.dimension == 3:
        joint_axes(sheet, c)
    loads = [
        [as_formula(own_name(n)), load.type.replace("_", " "), _load_text(c, n)]
        for n, load in m.loads.items()
    ]
    sheet.table(["Load", "Type", "Value"], loads)
    assumed = "; ".join(f"{name} {value}" for name, value in r.assumptions.items())
    sheet.text(f"Assumptions: {assumed}. {_convention(c)}")
    sheet.figure(given_picture(c))


def _links(sheet: Sheet, c: ReportContext) -> None:
    """Points, mass and mass centre of each link; its inertia, in space as a table of its own."""
    r, shown, m = c.r, c.shown, c.r.mechanism
    rows = []
    for link in r.links:
        g = m.center(link)
        cells = [
            shown.heading(link),
            "; ".join(f"{n} ({_pair(shown, p)})" for n, p in m.points(link).items()),
            shown.text("mass", m.mass(link)) if m.mass(link) else "massless",
            _pair(shown, g) if m.mass(link) else "–",
        ]
        if m.dimension == 2:
            cells.append(shown.text("inertia", m.inertia(link)) if m.inertia(link) else "–")
        rows.append(cells)
    length = shown.unit("length")
    heads = ["Link", f"Points, own axes ({length})", "Mass", f"Centre ({length})"]
    sheet.table([*heads, "Inertia"] if m.dimension == 2 else heads, rows)
    if m.dimension == 3:
        ground = "; ".join(f"{n} ({_pair(shown, p)})" for n, p in m.points(GROUND).items())
        sheet.text(f"On the ground ({length}): {ground}." if ground else "")
        _inertias(sheet, c)


def _inertias(sheet: Sheet, c: ReportContext) -> None:
    """Matrices J of inertia about the mass centres; off its diagonal stand the products with their minus."""
    r, shown = c.r, c.shown
    found = {link: inertia_matrix(r, link) for link in r.links}
    found = {link: j for link, j in found.items() if j.any()}
    diagonal = not any((j - np.diag(np.diag(j))).any() for j in found.values())
    places = [(0, 0), (1, 1), (2, 2), *([] if diagonal else [(0, 1), (0, 2), (1, 2)])]
    heads = ["Link", *(f"$J_{{{AXES[a]}{AXES[b]}}}$" for a, b in places)]
    rows = []
    for link, j in found.items():
        least = PART * float(np.abs(j).max())
        rows.append([shown.heading(link), *(shown.number("inertia", float(j[p]), least) for p in places)])
    about = f"Inertia ({shown.unit('inertia')}) about the mass centre, in the link's own axes"
    sheet.table(
        heads, rows, about if diagonal else f"{about}; off the diagonal J holds the products with a minus"
    )


def joint_axes(sheet: Sheet, c: ReportContext) -> None:
    """Each joint's own axes at this position, in ground axes."""
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
    heads = ["Joint", "x'", "y'", "z'", "What they are"]
    sheet.table(heads, rows, "The joints' own axes, marked by a prime, at this position in ground axes")


def _add_primes(words: str) -> str:
    """The letters of a joint's own axes with their prime."""
    return re.sub(r"\b([xyz])\b", r"\1'", words)


def _cosine(x: float, figures: int) -> str:
    return "0" if abs(x) < PART else f"{x:.{figures}f}".rstrip("0").rstrip(".").replace("-", "−")


def _measures(shown: Shown, joint: Any) -> str:
    """What a joint has of its own besides its points: ', pitch radii 80 mm and 40 mm, pressure angle 20°'."""
    parts = []
    if joint.wheels == 2:
        both = " and ".join(shown.text("length", float(x)) for x in joint.pitch_radii)
        parts.append(f"{'pitch ' if joint.TOOTHED else ''}radii {both}")
        parts.append("internal" if joint.internal else "")
    for key, words, kind in OWN_MEASURES:
        value = getattr(joint, key, None)
        parts.append(
            f"{words} {shown.text(kind, float(value))}" if isinstance(value, float) and value else ""
        )
    return "".join(f", {part}" for part in parts if part)


OWN_MEASURES = (
    ("radius", "radius", "length"),
    ("direction", "along", "angle"),
    ("pressure_angle", "pressure angle", "angle"),
    ("helix_angle", "helix angle", "angle"),
    ("lead", "lead", "length"),
)
"""Keys of joints, what they are called and of which kind."""


def _friction(c: ReportContext, joint: Joint) -> str:
    """The friction of a joint as it was given: '; μ = 0.4, R = 0.07 m'."""
    f, shown = getattr(joint, "friction", None), c.shown
    if f is None or c.r.friction is None:
        return ""
    mu, still = coefficient(c.r.mechanism, joint), resting_coefficient(c.r.mechanism, joint)
    parts = [f"μ = {c.notation.given(mu)}", f"at rest {c.notation.given(still)}" if still != mu else ""]
    for key, sign in (("radius", "R"), ("half_height", "half height"), ("arm", "arm")):
        value = getattr(f, key, None)
        parts.append(f"{sign} = {shown.text('length', value)}" if value else "")
    if getattr(f, "guide", None):
        behind, ahead = (shown.text("length", x) for x in f.guide)
        parts.append(f"guide {behind} behind and {ahead} ahead")
    return f"; {', '.join(p for p in parts if p)}"


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
            f"by the right hand; components in {axes}, with a prime along the joint's own."
        )
    return f"${n.letter}_{{ij}}$ is the force {first}; moments are positive {sense}; components in {axes}."


def _pair(shown: Shown, p: Any) -> str:
    least = PART * shown.r.compiled.layout.length
    return ", ".join(shown.number("length", float(x), least) for x in p)


def _drive_row(c: ReportContext, d: str) -> list[str]:
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


def _load_text(c: ReportContext, name: str) -> str:
    load = c.r.mechanism.loads[name]
    if getattr(load, "unknown", False):
        return "unknown"
    some = [a for a in actions(c.r) if a.of == name and a.kind in ("load", "spring", "damper")]
    if not some:
        return ""
    a = next((a for a in some if a.link != GROUND), some[0])
    if a.force.any():
        where = f" on {c.shown.heading(a.link)}"
        spot = getattr(load, "at", None)
        at = (
            f" at {spot}"
            if isinstance(spot, str)
            else f" at ({_pair(c.shown, spot)})"
            if spot is not None
            else ""
        )
        known = np.isfinite(a.force[c.k]).all()
        return (_vector_text(c, "force", a.force[c.k]) if known else "no value") + where + at
    return f"{_vector_text(c, 'moment', a.couple[c.k])} on {c.shown.heading(a.link)}"


def _vector_text(c: ReportContext, kind: str, v: Array) -> str:
    """A force or couple as the reader writes it: in the plane by size and angle, in space by components."""
    if np.ndim(v) == 0:
        return c.shown.text(kind, float(v))
    if len(v) == 2:
        return c.shown.polar((float(v[0]), float(v[1])))
    least = PART * float(np.abs(v).max())
    return f"({', '.join(c.shown.number(kind, float(x), least) for x in v)}) {c.shown.unit(kind)}"
