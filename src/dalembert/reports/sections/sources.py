"""Contribution of each source: the answer split by superposition, and the work of each for a displacement of the
drives."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, actions, magnitude
from dalembert.analysis.methods.solved.effort_arms import EffortArm, driven_crank, effort_arms
from dalembert.analysis.methods.superposition import directions, with_sum
from dalembert.analysis.methods.superposition import superposition as split
from dalembert.analysis.output.rounding import PART
from dalembert.analysis.result.number_kinds import drive_kinds, load_kind
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model import GROUND
from dalembert.printing import remainder
from dalembert.reports.report_context import ReportContext, as_formula, in_ground
from dalembert.reports.sections.terms import floors
from dalembert.reports.sheet import ReportSheet, Working
from dalembert.views import draw
from dalembert.views.notation import Shown, along, load_sign
from dalembert.views.plane.velocity_polygons import stands_still

if TYPE_CHECKING:
    from dalembert.analysis.methods.superposition import Superposition
    from dalembert.analysis.methods.virtual_work import VirtualWork
    from dalembert.analysis.result.result import Result

Column = tuple[str, Array, str]
"""Head, the parts (S,) of one number with their sum behind them, and its kind."""

WIDEST = 9
"""Columns of numbers in one table."""

MOST = 8
"""Joints that are split."""


def superposition(sheet: ReportSheet, c: ReportContext) -> None:
    """Tables of the efforts and joint forces by source; in the plane the chain's polygon for each load."""
    r, shown, k = c.r, c.shown, c.k
    try:
        parts = split(r)
    except ModelError as error:
        sheet.heading("Superposition")
        sheet.text(f"{error.what[:1].upper()}{error.what[1:]}.")
        return
    if len(parts.sources) < 2:
        return
    sheet.heading("Superposition")
    efforts: list[Column] = [
        (
            as_formula(shown_name(c, "effort", d)),
            with_sum(parts.efforts[:, k, n]),
            drive_kinds(r, d)["effort"],
        )
        for n, d in enumerate(r.drives)
    ]
    efforts += [
        (as_formula(load_sign(u)), with_sum(parts.loads[:, k, n]), load_kind(r, u))
        for n, u in enumerate(r.unknown_loads)
    ]
    forces = [_columns(c, joint, with_sum(parts.force[:, k, n])) for n, joint in enumerate(r.joints[:MOST])]
    units = f"Forces in {shown.unit('force')}{in_ground(c)}, couples in {shown.unit('moment')}"
    tables, gap = _tables([efforts, *forces]), remainder(float(parts.gap[k]))
    for n, columns in enumerate(tables):
        caption = (
            f"{units}; the parts sum to the total within {gap}" if n == len(tables) - 1 else in_ground(c)[2:]
        )
        heads = ["Source", *(name for name, _, _ in columns)]
        sheet.table(heads, _rows(c, parts.sources, columns), caption, total=True)
    if len(r.joints) > MOST:
        sheet.text(f"Only the first {MOST} of {len(r.joints)} joints are shown.")
    _arms(sheet, c, parts)
    external = [s for s in parts.sources if s in r.mechanism.loads]
    if 2 <= len(external) <= 4 and "graphical" in c.methods and r.mechanism.dimension == 2:
        sheet.figure(*(draw.force_chain(r, k + 1, c.notation, case=s) for s in external))


def source_arms(sheet: ReportSheet, c: ReportContext) -> None:
    """The same by itself, where forces add and there are two sources at least."""
    try:
        parts = split(c.r)
    except ModelError:
        return
    if len(parts.sources) > 1 and any(driven_crank(parts, d) is not None for d in c.r.drives):
        sheet.heading("The driving torque, source by source")
        _arms(sheet, c, parts)


def _arms(sheet: ReportSheet, c: ReportContext, parts: Superposition) -> None:
    """T = F h of each source at the pin of a driven crank."""
    shown = c.shown
    for drive in c.r.drives:
        crank = driven_crank(parts, drive)
        if crank is None:
            continue
        link = shown.heading(crank.link)
        sheet.text(
            f"Torque at {crank.joint} due to each source: its force at {crank.pin} on link {link} times the arm h "
            f"about {crank.joint}, and the couple that balances a source on this link itself."
        )
        every = effort_arms(parts, crank, c.k)
        rows = [row for a in every if (row := _arm_row(c, a)) is not None]
        total = shown.number("moment", math.fsum(a.torque for a in every))
        unit = shown.unit("moment")
        heads = [
            "Source",
            f"F ({shown.unit('force')})",
            f"arm h, {shown.arm_unit}",
            f"F h ({unit})",
            f"direct ({unit})",
        ]
        sheet.table([*heads, f"T ({unit})"], [*rows, ["sum", "", "", "", "", total]], total=True)


def _arm_row(c: ReportContext, a: EffortArm) -> list[str] | None:
    """Force, arm and both parts of one source; None where it does nothing."""
    shown, floor = c.shown, max(c.shown.least["moment"], 1e-12)
    at_pin, own = abs(a.at_pin) > floor, abs(a.own) > max(floor, 1e-9 * abs(a.at_pin))
    if not at_pin and not own:
        return None
    force, arm = shown.number("force", a.force), shown.notation.number(a.arm / shown.arm)
    pin = [force, arm, shown.number("moment", a.at_pin)] if at_pin else ["–", "–", "–"]
    return [
        source_sign(c, a.source),
        *pin,
        shown.number("moment", a.own) if own else "–",
        shown.number("moment", a.torque),
    ]


def _columns(c: ReportContext, joint: str, force: Array) -> list[Column]:
    """Components of a joint's force, its size, and in the plane its direction."""
    sign = c.shown.reaction(joint, c.r.mechanism.joints[joint].links[1])
    out: list[Column] = [
        (as_formula(along(sign, axis)), part, "force") for axis, part in zip("xyz", force.T, strict=False)
    ]
    size = magnitude(force)
    out.append((f"$|{sign}|$", size, "force"))
    if force.shape[-1] == 2:
        seen = size > c.shown.least["force"]
        out.append(("angle °", np.where(seen, directions(force), np.nan), "direction"))
    return out


def _tables(groups: list[list[Column]]) -> list[list[Column]]:
    """Columns side by side, those of a joint in one table."""
    out: list[list[Column]] = [[]]
    for group in groups:
        if out[-1] and len(out[-1]) + len(group) > WIDEST:
            out.append([])
        out[-1] += group
    return out


def _rows(c: ReportContext, sources: tuple[str, ...], columns: list[Column]) -> list[list[str]]:
    """A row a source and the sum; rounding is 0. Weights and inertia that do nothing here have none."""
    rows = [
        [source_sign(c, s), *(_part(c, kind, float(v[n])) for _, v, kind in columns)]
        for n, s in enumerate(sources)
        if (c.r.mechanism.dimension == 2 and s in c.r.mechanism.loads)
        or any(abs(float(v[n])) > c.shown.least.get(kind, math.inf) for _, v, kind in columns)
    ]
    return [*rows, ["sum", *(_part(c, kind, float(v[-1])) for _, v, kind in columns)]]


def _part(c: ReportContext, kind: str, value: float) -> str:
    """A number of a table; the direction of a zero vector is a dash."""
    if kind == "direction":
        return c.notation.degrees(value) if math.isfinite(value) else "–"
    return c.shown.number(kind, value)


def shown_name(c: ReportContext, kind: str, of: str) -> str:
    """The sign of a drive's effort."""
    a = next(a for a in actions(c.r) if a.kind == kind and a.of == of)
    return c.shown.effort(a) if kind == "effort" else c.shown.symbol(a)


def source_sign(c: ReportContext, source: str) -> str:
    """A contribution as the reader writes it."""
    if source in c.r.mechanism.loads:
        return as_formula(load_sign(source))
    for words, letter in (
        ("inertia force of ", "F_{I"),
        ("inertia couple of ", "T_{I"),
        ("weight of ", "W_{"),
    ):
        if source.startswith(words):
            return f"${letter}{c.shown.link(source.removeprefix(words))}}}$"
    return source


def virtual_work(sheet: ReportSheet, c: ReportContext) -> None:
    from dalembert.analysis.methods.virtual_work import virtual_work as by_virtual_work

    r, shown, k = c.r, c.shown, c.k
    if not r.drives:
        return
    answer = by_virtual_work(r)
    if answer.independent:
        sheet.heading("Virtual work, the independent check")
    else:
        sheet.heading("Virtual work, a check")
        sheet.text(
            "The work of friction contains the joint forces computed above, so with friction virtual work checks that "
            "solution but is not independent of it."
        )
    least = floors(r, k)
    idle = "no reaction does work" if answer.independent else "among the reactions only friction does work"
    for n, drive in enumerate(r.drives):
        kind = drive_kinds(r, drive)["effort"]
        angular = kind == "moment"
        unit = "rad" if angular else shown.arm_unit
        clockwise = " clockwise" if angular and c.notation.torque < 0 else ""
        if r.mechanism.dimension == 2 and stands_still(r, k):
            sheet.figure(draw.velocity_polygon(r, k + 1, c.notation, drive))
        sheet.text(f"Displacements for one {unit} of drive {drive}{clockwise}; {idle}.")
        sense = c.notation.torque if angular else 1  # the drive turns the way that counts as positive
        move, turn = (sense / shown.arm, sense) if angular else (1.0, shown.arm)
        reach = (
            1.0 if angular else 1.0 / r.compiled.layout.length
        )  # a turn that moves as far as the drive does
        rows = []
        floor = max(least[angular], 1e-12 * float(np.abs(answer.power[:, k, n]).max(initial=0.0)))
        for a, v, w, p in zip(answer.actions, answer.velocity, answer.spin, answer.power, strict=True):
            if _nothing(a, k, least):
                continue
            force = bool(np.nan_to_num(a.force).any())
            acts = [_vector_of(shown, "force", a.force[k])] if force else []
            moves = [_displacement(shown, v[k, n], move, reach * r.compiled.layout.length)] if force else []
            if np.abs(a.couple[k]).max() > least[1] or not force:
                acts.append(_vector_of(shown, "moment", a.couple[k]))
                moves.append(_displacement(shown, w[k, n], turn * c.notation.torque, reach))
            work = shown.number(kind, float(p[k, n]), floor)
            rows.append([source_sign(c, a.source), " and ".join(acts), " and ".join(moves), work])
        total = float(answer.power[:, k, n].sum())
        rows.append(["sum", "", "", shown.number(kind, total, floor)])
        heads = ["Load", "Force or couple", "Displacement or turn", f"Work ({shown.unit(kind)})"]
        sheet.table(heads, rows, total=True)
        sign = shown_name(c, "effort", drive)
        effort = shown.number(kind, float(answer.effort[k, n]), floor)
        sheet.equations(
            [Working(f"{sign} = −sum (F cdot delta r + T delta theta)", "", f'{effort} "{shown.unit(kind)}"')]
        )
    sheet.text(
        f"The solution of the equations agrees within {remainder(float(answer.gap[k]))} of the largest work."
    )
    if r.mechanism.dimension == 3:
        _powers(sheet, c, answer)


def _powers(sheet: ReportSheet, c: ReportContext, work: VirtualWork) -> None:
    """Power of the drives, loads, inertia and friction at the speeds of this position: their sum is zero."""
    r, k = c.r, c.k
    speed = r.schedule.speed[k]
    if not speed.any():
        return
    words = {kind: f"{kind}s" for kind in ("weight", "damper", "spring")}
    words |= {kind: kind for kind in ("inertia", "friction")}
    parts = {"drives": float(r.effort_array[k] @ speed)}
    for a, power in zip(work.actions, work.power[:, k], strict=True):
        name = words.get(a.kind, "loads")
        parts[name] = parts.get(name, 0.0) + float(power @ speed)
    for name in r.unknown_loads:
        a = next(a for a in actions(r) if a.kind == "load" and a.of == name)
        parts["loads"] = parts.get("loads", 0.0) + _power(r, a, k)
    rows = [[name, c.shown.number("power", value)] for name, value in parts.items()]
    total = sum(parts.values())
    rows.append(["sum", c.shown.number("power", total)])
    heads = ["Power put in by", f"Power ({c.shown.unit('power')})"]
    idle = "no reaction has power" if work.independent else "among the reactions only friction has power"
    sheet.table(heads, rows, f"At the speeds of this position; {idle}", total=True)


def _power(r: Result, a: Action, k: int) -> float:
    """Power of an action on a link in space at the speeds of a position."""
    if a.link == GROUND:
        return 0.0
    w = r.speed(a.link)[k]
    v = r.velocity(a.link)[k] + np.cross(w, a.at[k] - r.position(a.link)[k])
    return float(a.force[k] @ v + a.couple[k] @ w)


def _nothing(a: Action, k: int, least: tuple[float, ...]) -> bool:
    """True if an action in space is rounding at this position."""
    return bool(np.abs(a.force[k]).max() <= least[0] and np.abs(a.couple[k]).max() <= least[1] and least[2])


def _vector_of(shown: Shown, kind: str, v: Array) -> str:
    """A number, or a vector by its components."""
    numbers = [shown.number(kind, float(x)) for x in np.atleast_1d(v)]
    return f"({', '.join(numbers)})" if np.ndim(v) else numbers[0]


def _displacement(shown: Shown, v: Array, factor: float, size: float) -> str:
    """A displacement or turn for a unit of the drive, in the reader's units; beside a size rounding is 0."""
    numbers = [
        shown.notation.number(float(x) * factor if abs(float(x)) > PART * size else 0.0)
        for x in np.atleast_1d(v)
    ]
    return f"({', '.join(numbers)})" if np.ndim(v) else numbers[0]
