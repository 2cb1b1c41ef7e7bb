"""The hand calculation of a result, section by section, with the numbers that were computed."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from dalembert.analysis.actions import actions, magnitude, on_link
from dalembert.analysis.columns import drive_kinds, load_kind
from dalembert.analysis.members import (
    components_along,
    displaced_inertia,
    inertia_shares,
    members,
    order_of_solution,
)
from dalembert.errors import ModelError
from dalembert.report import balance, kinematics
from dalembert.report.sheet import Sheet, Working
from dalembert.views import draw
from dalembert.views.mechanism import position_at
from dalembert.views.notation import Notation, Shown, own_name

if TYPE_CHECKING:
    from dalembert.analysis.result import Result

Method = Literal["matrix", "graphical", "superposition", "virtual-work"]
METHODS: tuple[Method, ...] = ("matrix", "graphical", "superposition", "virtual-work")


@dataclass(frozen=True)
class Chosen:
    """What a report is about: the result, the position, the reader's notation, and the methods shown."""

    r: Result
    k: int
    shown: Shown
    methods: tuple[Method, ...] = METHODS
    about: str = ""
    notation: Notation = field(default_factory=Notation)


def working(
    r: Result,
    at: Any = None,
    methods: tuple[Method, ...] = METHODS,
    notation: Notation | None = None,
    about: str = "",
) -> Sheet:
    """The worked solution of one position of a result, with charts where there are more."""
    notation = notation or Notation()
    c = Chosen(r, position_at(r, at), Shown(r, notation), methods, about, notation)
    m = r.mechanism
    sheet = Sheet(m.title or "Force analysis", m.source_text, _where(c))
    _knowns(sheet, c)
    if r.status[c.k] not in ("ok", "redundant"):
        sheet.heading("No answer")
        sheet.text(f"{r.status[c.k]}: {r.reasons[c.k]}")
        return sheet
    _motion(sheet, c)
    _inertia(sheet, c)
    _bodies(sheet, c)
    _answers(sheet, c)
    if "graphical" in methods:
        _graphical(sheet, c)
    if "superposition" in methods:
        _superposition(sheet, c)
    if "virtual-work" in methods:
        _virtual_work(sheet, c)
    _cycle(sheet, c)
    _checks(sheet, c)
    return sheet


def _where(c: Chosen) -> str:
    parts = []
    for d in c.r.drives:
        kinds = drive_kinds(c.r, d)
        parts.append(f"{d} = {c.shown.text(kinds['position'], float(c.r.drive_position(d)[c.k]))}")
    many = f", position {c.k + 1} of {len(c.r.status)}" if len(c.r.status) > 1 else ""
    return (f"Position {', '.join(parts)}" if parts else "Structure") + many


def _math(sign: str) -> str:
    """A sign of a drawing as a formula: only its index is marked there."""
    return f"${sign}$" if "_{" in sign or len(sign) == 1 else sign


def _knowns(sheet: Sheet, c: Chosen) -> None:
    r, shown, m = c.r, c.shown, c.r.mechanism
    sheet.heading("Given")
    rows = []
    for link in r.links:
        g = m.center(link)
        rows.append(
            [
                shown.heading(link),
                "; ".join(f"{n} ({_pair(shown, p)})" for n, p in m.points(link).items()),
                shown.text("mass", m.mass(link)) if m.mass(link) else "massless",
                _pair(shown, g) if m.mass(link) else "–",
                shown.text("inertia", m.inertia(link)) if m.inertia(link) else "–",
            ]
        )
    length = shown.unit("length")
    sheet.table(["Link", f"Points, own axes ({length})", "Mass", f"Centre ({length})", "Inertia"], rows)
    joints = [
        [name, d.type, f"{shown.heading(d.links[0])} – {shown.heading(d.links[1])}"] for name, d in m.joints.items()
    ]
    drives = [[f"drive {d}", *_drive_row(c, d)] for d in r.drives]
    sheet.table(["Joint or drive", "Type or motion", "Links"], [*joints, *drives])
    loads = [[_math(own_name(n)), load.type.replace("_", " "), _load_text(c, n)] for n, load in m.loads.items()]
    sheet.table(["Load", "Type", "Value"], loads)
    assumed = "; ".join(f"{name} {value}" for name, value in r.assumptions.items())
    sheet.text(f"Assumptions: {assumed}. {_convention(c)}")
    sheet.figure(draw.mechanism(r, c.k + 1, c.notation))


def _convention(c: Chosen) -> str:
    n = c.notation
    first = "by link i on link j" if n.order == "by-on" else "on link i by link j"
    sense = "counter-clockwise" if n.torque > 0 else "clockwise"
    axes = "ground axes (x right, y up)" if n.axes == "ground" else "the axes of the link acted on"
    return f"${n.letter}_{{ij}}$ is the force {first}; moments are positive {sense}; components in {axes}."


def _pair(shown: Shown, p: Any) -> str:
    return ", ".join(shown.notation.number(shown.value("length", float(x))) for x in p)


def _drive_row(c: Chosen, d: str) -> list[str]:
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


def _load_text(c: Chosen, name: str) -> str:
    load: Any = c.r.mechanism.loads[name]
    if getattr(load, "unknown", False):
        return "unknown"
    some = [a for a in actions(c.r) if a.of == name and a.kind in ("load", "spring", "damper")]
    if not some:
        return ""
    a = some[0]
    if a.force.any():
        fx, fy = (float(f) for f in a.force[c.k])
        where = f" on {c.shown.heading(a.link)}"
        spot = getattr(load, "at", None)
        at = f" at {spot}" if isinstance(spot, str) else f" at ({_pair(c.shown, spot)})" if spot is not None else ""
        return c.shown.polar((fx, fy)) + where + at
    return f"{c.shown.text('moment', float(a.couple[c.k]))} on {c.shown.heading(a.link)}"


def _motion(sheet: Sheet, c: Chosen) -> None:
    r, shown = c.r, c.shown
    if not r.drives:
        return
    sheet.heading("Motion")
    moving = any(np.any(r.speed(link)) or np.any(r.acceleration(link)) for link in r.links)
    for n, loop in enumerate(kinematics.loops(r, c.k)):
        names = " – ".join(shown.heading(link) for link in loop.links)
        sheet.text(f"Loop {n + 1} through links {names}: the sides sum to zero.")
        sheet.equations(kinematics.position_lines(loop, shown))
        if moving:
            sheet.equations(kinematics.velocity_lines(loop, shown))
            sheet.equations(kinematics.acceleration_lines(loop, shown))
    heads, rows = _motion_table(c, moving)
    sheet.table(heads, rows, "Solved for the motion of the links and of their mass centres")
    if moving:
        sheet.figure(draw.velocity_polygon(r, c.k + 1, c.notation), draw.acceleration_polygon(r, c.k + 1, c.notation))


def _motion_table(c: Chosen, moving: bool) -> tuple[list[str], list[list[str]]]:
    r, shown, k = c.r, c.shown, c.k
    number = shown.notation.number
    heads = ["Link", "$theta$ (°)"]
    if moving:
        heads += ["$omega$ (rad/s)", "$alpha$ (rad/s²)"]
        heads += [f"$a_{{G{axis}}}$ ({shown.unit('acceleration')})" for axis in "xy"]
    rows = []
    for link in r.links:
        row = [shown.heading(link), f"{math.degrees(float(r.angle(link)[k])):.3f}".replace("-", "−")]
        if moving:
            a = r.center_acceleration(link)[k]
            row += [number(float(r.speed(link)[k])), number(float(r.acceleration(link)[k]))]
            row += [shown.number("acceleration", float(x)) for x in a]
        rows.append(row)
    return heads, rows


def _inertia(sheet: Sheet, c: Chosen) -> None:
    r, shown, k = c.r, c.shown, c.k
    heavy = [link for link in r.links if r.mechanism.mass(link)]
    if not r.inertia or not heavy:
        return
    sheet.heading("Inertia forces")
    lines = [line for link in heavy for line in _inertia_lines(c, link)]
    sheet.equations(lines)
    shares = inertia_shares(r) if not r.compiled.forcing.separation.any() else ()
    if shares:
        least = max(s.share for s in shares)
        worst = shares[0]
        said = "could be left out" if least < 0.05 else "must not be left out"
        sheet.text(
            f"Inertia {said}: it makes up to {100 * least:.0f} % of the largest {worst.quantity} of {worst.of}"
            f"{' over the cycle' if len(r.status) > 1 else ''}."
        )
    assert shown is not None
    assert k >= 0


def _inertia_lines(c: Chosen, link: str) -> list[Working]:
    r, shown, k = c.r, c.shown, c.k
    n, m, inertia = shown.link(link), r.mechanism.mass(link), r.mechanism.inertia(link)
    a, found = r.center_acceleration(link)[k], displaced_inertia(r, link)
    fx, fy = (float(f) for f in found.force[k])
    size, angle = math.hypot(fx, fy), math.degrees(math.atan2(fy, fx))
    number = shown.number
    out = [
        Working(
            f"F_{{I{n}}} = −m_{{{n}}} a_{{G{n}}}",
            f"−{number('mass', m)} ({number('acceleration', float(a[0]))}, {number('acceleration', float(a[1]))})",
            f"({number('force', fx)}, {number('force', fy)}) = {number('force', size)} \"{shown.unit('force')}\" "
            f"angle {angle:.2f} deg".replace("-", "−"),
        )
    ]
    if inertia and float(r.acceleration(link)[k]):
        couple = number("moment", float(found.couple[k]))
        moment = shown.unit("moment")
        alpha = shown.notation.number(float(r.acceleration(link)[k]))
        out.append(
            Working(
                f"T_{{I{n}}} = −I_{{{n}}} alpha_{{{n}}}",
                f"−{number('inertia', inertia)} cdot {_bracketed(alpha)}",
                f"{couple} \"{moment}\"",
            )
        )
        if size > 0:
            offset = number("length", float(found.offset[k]))
            out.append(
                Working(
                    f"h_{{{n}}} = frac(I_{{{n}}} alpha_{{{n}}}; F_{{I{n}}})",
                    f"frac({couple.lstrip('−')}; {number('force', size)})",
                    f"{offset} \"{shown.unit('length')}\"",
                )
            )
    return out


def _bracketed(text: str) -> str:
    return f"({text})" if text.startswith("−") else text


def _bodies(sheet: Sheet, c: Chosen) -> None:
    r, shown = c.r, c.shown
    sheet.heading("Free bodies and their equations")
    sheet.figure(*(draw.free_body(r, link, c.k + 1, c.notation) for link in r.links))
    if "matrix" not in c.methods:
        return
    for link in r.links:
        lines, about = balance.link_equations(r, link, c.k, shown, c.about)
        place = "the mass centre G" if about.name == "G" else f"joint {about.name}"
        sheet.text(f"Link {shown.heading(link)}, moments about {place}; R from there to each force:")
        sheet.equations(lines)
    found = balance.matrix_equation(r, c.k, shown, c.about)
    if found is not None:
        sheet.heading(f"The {len(found.unknowns)} equations as one", 2)
        units = f"forces in {shown.unit('force')}, lengths in {shown.unit('length')}, moments in {shown.unit('moment')}"
        sheet.text(f"The knowns stand on the right ({units}); the solution behind it.")
        sheet.blocks.append(found)


def _answers(sheet: Sheet, c: Chosen) -> None:
    r, shown, k = c.r, c.shown, c.k
    sheet.heading("Joint forces and efforts")
    unit = shown.unit("force")
    rows = []
    for joint in r.joints:
        i, j = r.mechanism.joints[joint].links
        on = j if j != "ground" else i
        f = r.reaction(joint, on)[k]
        moment = float(r.reaction_moment(joint, on)[k])
        a = next(a for a in actions(r) if a.kind == "joint" and a.of == joint and a.link == on)
        along = components_along(r, a, k) if np.isfinite(f).all() else (math.nan, math.nan)
        largest = float(np.nanmax(np.abs(r.force_array[k]), initial=0.0)) * 1e-10
        rows.append(
            [
                joint,
                _math(shown.reaction(joint, on)),
                *(shown.number("force", float(x), largest) for x in f),
                shown.number("force", float(np.hypot(*f))),
                f"{math.degrees(math.atan2(f[1], f[0])):.2f}".replace("-", "−") if np.hypot(*f) > largest else "–",
                *(shown.number("force", x, largest) for x in along),
                shown.number("moment", moment) if abs(moment) > 0 else "–",
            ]
        )
    heads = ["Joint", "Force", "x", "y", "size", "angle °", "along", "across", f"couple ({shown.unit('moment')})"]
    sheet.table(heads, rows, f"Forces in {unit}, on the link that the sign names; along and across that link")
    lines = []
    for d in r.drives:
        kind = drive_kinds(r, d)["effort"]
        a = next(a for a in actions(r) if a.kind == "effort" and a.of == d)
        lines.append(Working(f"{shown.symbol(a)} = {shown.number(kind, float(r.effort(d)[k]))} \"{shown.unit(kind)}\""))
    for u in r.unknown_loads:
        kind = load_kind(r, u)
        lines.append(Working(f"{own_name(u)} = {shown.number(kind, float(r.unknown_load(u)[k]))} \"{shown.unit(kind)}\""))
    sheet.equations(lines)


def _graphical(sheet: Sheet, c: Chosen) -> None:
    r, shown = c.r, c.shown
    sheet.heading("Graphical solution")
    found = members(r)
    kinds = [f"{shown.heading(link)}: {m.kind} {m.state(c.k)}".strip() for link, m in found.items()]
    sheet.text(f"Classes of the links. {'; '.join(kinds)}.")
    sheet.text(f"Order of solution: {'; then '.join(step.why for step in order_of_solution(r, found))}.")
    at = c.k + 1
    lines = [
        draw.lines_of_action(r, link, at, c.notation)
        for link, m in found.items()
        if m.kind in ("three-force", "four-force")
    ]
    polygons = [draw.force_polygon(r, link, at, c.notation) for link, m in found.items() if len(m.forces) > 1]
    sheet.figure(*lines, *polygons, *([draw.force_chain(r, at, c.notation)] if len(r.links) > 1 else []))


def _superposition(sheet: Sheet, c: Chosen) -> None:
    from dalembert.analysis.superposition import superposition

    r, shown, k = c.r, c.shown, c.k
    try:
        parts = superposition(r)
    except ModelError as error:
        sheet.heading("Superposition")
        sheet.text(f"{error.what}.")
        return
    if len(parts.sources) < 2:
        return
    sheet.heading("Superposition")
    columns = [(shown_name(c, "effort", d), parts.efforts[:, k, n], drive_kinds(r, d)["effort"]) for n, d in enumerate(r.drives)]
    columns += [(own_name(u), parts.loads[:, k, n], load_kind(r, u)) for n, u in enumerate(r.unknown_loads)]
    for n, joint in enumerate(r.joints[:5]):
        sign = shown.reaction(joint, r.mechanism.joints[joint].links[1])
        for axis in (0, 1):
            columns.append((f"{sign[:-1]}{'xy'[axis]}}}", parts.force[:, k, n, axis], "force"))
    columns = columns[:9]
    heads = ["Source", *(f"{_math(name)}" for name, _, _ in columns)]
    floor = {kind: 1e-10 * max((np.abs(v).max() for _, v, q in columns if q == kind), default=0.0) for _, _, kind in columns}
    rows = [
        [_source(c, s), *(shown.number(kind, float(v[n]), floor[kind]) for _, v, kind in columns)]
        for n, s in enumerate(parts.sources)
    ]
    rows.append(["sum", *(shown.number(kind, float(v.sum()), floor[kind]) for _, v, kind in columns)])
    units = f"Forces in {shown.unit('force')}, couples in {shown.unit('moment')}"
    sheet.table(heads, rows, f"{units}; the parts sum to the whole within {parts.gap[k]:.0e}", total=True)
    external = [s for s in parts.sources if s in r.mechanism.loads]
    if 2 <= len(external) <= 4 and "graphical" in c.methods:
        sheet.figure(*(draw.force_chain(r, k + 1, c.notation, case=s) for s in external))


def shown_name(c: Chosen, kind: str, of: str) -> str:
    """The sign of a drive's effort."""
    return c.shown.symbol(next(a for a in actions(c.r) if a.kind == kind and a.of == of))


def _source(c: Chosen, source: str) -> str:
    """A contribution as the reader writes it."""
    if source in c.r.mechanism.loads:
        return _math(own_name(source))
    for words, letter in (("inertia force of ", "F_{I"), ("inertia couple of ", "T_{I"), ("weight of ", "W_{")):
        if source.startswith(words):
            return f"${letter}{c.shown.link(source.removeprefix(words))}}}$"
    return source


def _virtual_work(sheet: Sheet, c: Chosen) -> None:
    from dalembert.analysis.virtual_work import virtual_work

    r, shown, k = c.r, c.shown, c.k
    if not r.drives:
        return
    sheet.heading("Virtual work, the independent check")
    try:
        found = virtual_work(r)
    except ModelError as error:
        sheet.text(f"{error.what}.")
        return
    for n, drive in enumerate(r.drives):
        kind = drive_kinds(r, drive)["effort"]
        angular = kind == "moment"
        unit = "rad" if angular else shown.unit("length")
        sheet.text(f"Displacements for one {unit} of drive {drive}; no reaction does work.")
        length = shown.value("length", 1.0)
        move, turn = (length, 1.0) if angular else (1.0, 1.0 / length)
        rows = []
        largest = float(np.abs(found.power[:, k, n]).max(initial=0.0))
        for a, v, w, p in zip(found.actions, found.velocity, found.spin, found.power, strict=True):
            force = bool(a.force.any())
            dx, dy = (shown.notation.number(float(x) * move if abs(float(x)) > 1e-12 else 0.0) for x in v[k, n])
            rows.append(
                [
                    _source(c, a.source),
                    _pair_of(shown, "force", a.force[k]) if force else shown.number("moment", float(a.couple[k])),
                    f"({dx}, {dy})" if force else shown.notation.number(float(w[k, n]) * turn * c.notation.torque),
                    shown.number(kind, float(p[k, n]) * c.notation.torque**angular, 1e-12 * largest),
                ]
            )
        total = float(found.power[:, k, n].sum())
        rows.append(["sum", "", "", shown.number(kind, total * c.notation.torque**angular)])
        heads = ["Load", "Force or couple", "Displacement or turn", f"Work ({shown.unit(kind)})"]
        sheet.table(heads, rows, total=True)
        sign = shown_name(c, "effort", drive)
        effort = shown.number(kind, float(found.effort[k, n]))
        sheet.equations([Working(f"{sign} = −sum (F cdot delta r + T delta theta)", "", f"{effort} \"{shown.unit(kind)}\"")])
    sheet.text(f"The matrix answer agrees within {float(found.gap[k]):.0e} of the largest work.")


def _pair_of(shown: Shown, kind: str, v: Any) -> str:
    return f"({', '.join(shown.number(kind, float(x)) for x in v)})"


def _cycle(sheet: Sheet, c: Chosen) -> None:
    from dalembert.views import charts

    r = c.r
    if len(r.status) < 8 or not r.drives:
        return
    sheet.heading("Over the cycle")
    scenes = [*charts.effort_chart(r, c.notation), charts.reaction_chart(r, c.notation)]
    sheet.figure(*scenes)
    rows = []
    for d in r.drives:
        value, where = r.worst("effort", d)
        rows.append([f"effort {d}", c.shown.text(drive_kinds(r, d)["effort"], value), str(where + 1)])
    for j in r.joints:
        value, where = r.worst("reaction", j)
        rows.append([f"joint {j}", c.shown.text("force", value), str(where + 1)])
    sheet.table(["Largest", "Value", "Position"], rows)


def _checks(sheet: Sheet, c: Chosen) -> None:
    r, k = c.r, c.k
    sheet.heading("Checks")
    links = []
    for link in r.links:
        some = on_link(actions(r), link)
        total = sum((a.force[k] for a in some), np.zeros(2))
        largest = max((float(magnitude(a.force[k])) for a in some), default=0.0) or 1.0
        links.append(f"{c.shown.heading(link)} {float(np.hypot(*total)) / largest:.0e}")
    sheet.text(
        f"Out-of-balance force or moment over the largest force: {float(r.residual[k]):.0e}; power balance: "
        f"{float(r.power_balance[k]):.0e}. Closure gaps of the force polygons over their largest force: {', '.join(links)}."
    )
    if r.mobility is not None:
        sheet.text(f"Mobility {r.mobility.freedoms}, drives {r.mobility.drives}, redundant constraints {r.mobility.redundant}.")
