"""In space: positions by the closure equations, velocities and accelerations, inertia forces and couples."""

from __future__ import annotations

import math

import numpy as np

from dalembert.algebra import space
from dalembert.analysis.methods.applied_forces import joint_place
from dalembert.analysis.methods.inertia_couples import turning
from dalembert.analysis.output.rounding import PART
from dalembert.analysis.result.closure_residual import closure_gap
from dalembert.arrays import Array
from dalembert.printing import remainder
from dalembert.reports.report_context import ReportContext
from dalembert.reports.sections.motion import shares, units_of_inertia
from dalembert.reports.sheet import ReportSheet, Working
from dalembert.reports.space_sections.space_closure import closing_lines

AXES = "xyz"


def space_motion(sheet: ReportSheet, c: ReportContext) -> None:
    """Computation of the position, the loops in figures, joint values, places, and the motion of the links."""
    r, k = c.r, c.k
    sheet.heading("Position and motion" if _moves(c) else "Position")
    spins = len(r.compiled.passive)
    count = r.compiled.layout.constraints.count - spins
    added = f", {spins} that set spins to none" if spins else ""
    added += f", {len(r.drives)} of the drives" if r.drives else ""
    many = f"{len(r.links)} links" if len(r.links) > 1 else "link"
    gap, length = float(closure_gap(r)[k]), r.compiled.layout.length
    sheet.text(
        f"The {6 * len(r.links)} coordinates of the {many} satisfy {count} closure equations of the "
        f"joints{added}; they are solved together by Newton's method. The largest gap left in any of them is "
        f"{remainder(gap / length)} of the characteristic length {c.shown.text('length', length)}."
    )
    meshes = [n for n in r.joints if r.mechanism.joints[n].wheels]
    if meshes:
        sheet.text(f"The pitch circles of {' and '.join(meshes)} tie the turns of their wheels.")
    closing_lines(sheet, r, k, c.shown, _moves(c))
    joint_values(sheet, c)
    unit = c.shown.unit("length")
    places = [[j, *_vector(c, "length", joint_place(r, j)[k])] for j in r.joints]
    sheet.table(["Joint", *(f"{a} ({unit})" for a in AXES)], places, "Places of the joints, ground axes")
    _orientations(sheet, c)
    if _moves(c):
        _rates(sheet, c)


def _moves(c: ReportContext) -> bool:
    return any(np.any(c.r.speed(n)[c.k]) or np.any(c.r.acceleration(n)[c.k]) for n in c.r.links)


def joint_values(sheet: ReportSheet, c: ReportContext) -> None:
    """Turns and slides of the joints, with their rates."""
    rows = []
    for joint, freedom in c.r.compiled.freedoms:
        angular = freedom.startswith("turn")
        kinds = (
            ("angle", "angular_speed", "angular_acceleration")
            if angular
            else ("length", "speed", "acceleration")
        )
        values = [float(v[c.k]) for v in c.r.freedom(joint, freedom)]
        cells = [c.shown.text(kind, v) for kind, v in zip(kinds, values, strict=True)]
        rows.append([joint, freedom, *(cells if _moves(c) else cells[:1])])
    heads = ["Joint", "Freedom", "Value", *(["Rate", "Second rate"] if _moves(c) else [])]
    sheet.table(heads, rows, "Zero where the joint's axes, or its points, agree")


def _vector(c: ReportContext, kind: str, v: Array) -> list[str]:
    """Components; rounding is 0."""
    return [c.shown.number(kind, float(x)) for x in v]


def _orientations(sheet: ReportSheet, c: ReportContext) -> None:
    """Orientation of each link, turned from ground's axes about an axis, and its mass centre."""
    r, rows = c.r, []
    for link in r.links:
        angle, axis = space.angle_and_axis(r.rotation(link)[c.k])
        figures = _vector(c, "number", axis)
        turn = [c.shown.text("angle", float(angle)), *figures] if angle > PART else ["none", "–", "–", "–"]
        center = ["–"] * 3
        if r.mechanism.mass(link):
            center = _vector(c, "length", r.center(link)[c.k])
        rows.append([c.shown.heading(link), *turn, *center])
    unit = c.shown.unit("length")
    heads = ["Link", "Turned by", *(f"about {a}" if a == "x" else a for a in AXES)]
    heads += [f"$G_{{{a}}}$ ({unit})" for a in AXES]
    sheet.table(
        heads, rows, "Each link as turned from ground's axes about the axis shown, and its mass centre"
    )


def _rates(sheet: ReportSheet, c: ReportContext) -> None:
    """omega and alpha of the links, velocity and acceleration of their mass centres."""
    r, k = c.r, c.k
    for letters, kinds, reads in (
        (("omega", "alpha"), ("angular_speed", "angular_acceleration"), (r.speed, r.acceleration)),
        (("v_{G", "a_{G"), ("speed", "acceleration"), (r.center_velocity, r.center_acceleration)),
    ):
        links = [n for n in r.links if "{" not in letters[0] or r.mechanism.mass(n)]
        heads, rows = ["Link"], [[c.shown.heading(link)] for link in links]
        for letter, kind, read in zip(letters, kinds, reads, strict=True):
            sign = [f"{letter}{a}}}" if "{" in letter else f"{letter}_{{{a}}}" for a in AXES]
            heads += [
                f"${name}$ ({c.shown.unit(kind)})" if n == 0 else f"${name}$" for n, name in enumerate(sign)
            ]
            for row, link in zip(rows, links, strict=True):
                row += _vector(c, kind, read(link)[k])
        sheet.table(heads, rows, "Ground axes")


def space_inertia(sheet: ReportSheet, c: ReportContext) -> None:
    """F_I = -m a_G and T_I = -(J alpha + omega x J omega) of every link that has them."""
    r = c.r
    heavy = [n for n in r.links if r.mechanism.mass(n) or np.any(turning(r, n).inertia)]
    if not r.inertia or not heavy or not _moves(c):
        return
    sheet.heading("Inertia forces and couples")
    sheet.text(
        "The couple is computed in the link's axes (primed), in which its inertia is constant, and "
        "then rotated to ground axes; $omega' times J omega'$ is its gyroscopic part."
    )
    units_of_inertia(sheet, c)
    for link in heavy:
        lines = [*_force(c, link), *_couple(c, link)]
        still = "" if lines else " neither its mass centre nor its turning is accelerated."
        sheet.text(f"Link {c.shown.heading(link)}:{still}")
        sheet.equations(lines)
    shares(sheet, c)


def _force(c: ReportContext, link: str) -> list[Working]:
    r, n, mass = c.r, c.shown.link(link), c.r.mechanism.mass(link)
    a = r.center_acceleration(link)[c.k]
    if not mass or not (np.abs(a) > c.shown.least["acceleration"]).any():
        return []
    product = f"−{c.shown.number('mass', mass)} ({', '.join(_vector(c, 'acceleration', a))})"
    numbers = c.shown.with_factor(product, "force", "mass", "acceleration")
    force = ", ".join(_vector(c, "force", -mass * a))
    size = c.shown.text("force", mass * math.hypot(*a))
    return [
        Working(
            f"F_{{I{n}}} = −m_{{{n}}} a_{{G{n}}}",
            numbers,
            f'({force}) "{c.shown.unit("force")}, size {size}"',
        )
    ]


def _couple(c: ReportContext, link: str) -> list[Working]:
    """J alpha and omega x J omega in link axes, their sum reversed, and the same in ground axes."""
    t, n, k, unit = turning(c.r, link), c.shown.link(link), c.k, c.shown.unit("moment")
    couple = -(t.rate + t.gyroscopic)[k]
    if not (np.abs([t.rate[k], t.gyroscopic[k]]) > c.shown.least["moment"]).any():
        return []

    def vector(kind: str, v: Array) -> str:
        return f"({', '.join(_vector(c, kind, v))})"

    omega, alpha = vector("angular_speed", t.speed[k]), vector("angular_acceleration", t.acceleration[k])
    rate, gyroscopic, total = (vector("moment", v) for v in (t.rate[k], t.gyroscopic[k], couple))
    numbers = [
        c.shown.with_factor(text, "moment", "inertia", *of)
        for text, of in (
            (f"J_{{{n}}} {alpha}", ["angular_acceleration"]),
            (f"{omega} times J_{{{n}}} {omega}", ["angular_speed"] * 2),
        )
    ]
    ground = vector("moment", c.r.rotation(link)[k] @ couple)
    speed, second, inertia = f"omega_{{{n}'}}", f"alpha_{{{n}'}}", f"J_{{{n}}}"
    return [
        Working(
            f'{speed} = {omega} "{c.shown.unit("angular_speed")}", quad '
            f'{second} = {alpha} "{c.shown.unit("angular_acceleration")}"'
        ),
        Working(f"{inertia} {second}", numbers[0], f'{rate} "{unit}"'),
        Working(f"{speed} times {inertia} {speed}", numbers[1], f'{gyroscopic} "{unit}"'),
        Working(
            f"T_{{I{n}'}} = −({inertia} {second} + {speed} times {inertia} {speed})",
            f"−({rate} + {gyroscopic})",
            f'{total} "{unit}, link axes"',
        ),
        Working(f"T_{{I{n}}}", "", f'{ground} "{unit}, ground axes"'),
    ]
