"""What is given: links, joints, drives, loads, assumptions."""

from __future__ import annotations

from typing import Any

from dalembert.analysis.actions import actions
from dalembert.analysis.columns import drive_kinds
from dalembert.analysis.contacts import coefficient, resting_coefficient
from dalembert.report.chosen import Chosen, as_formula
from dalembert.report.sheet import Sheet
from dalembert.views.mechanism import mechanism_scene
from dalembert.views.notation import Shown, own_name


def knowns(sheet: Sheet, c: Chosen) -> None:
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
        [name, f"{d.type}{_rubbing(c, d)}", f"{shown.heading(d.links[0])} – {shown.heading(d.links[1])}"]
        for name, d in m.joints.items()
    ]
    drives = [[f"drive {d}", *_drive_row(c, d)] for d in r.drives]
    sheet.table(["Joint or drive", "Type or motion", "Links"], [*joints, *drives])
    loads = [
        [as_formula(own_name(n)), load.type.replace("_", " "), _load_text(c, n)]
        for n, load in m.loads.items()
    ]
    sheet.table(["Load", "Type", "Value"], loads)
    assumed = "; ".join(f"{name} {value}" for name, value in r.assumptions.items())
    sheet.text(f"Assumptions: {assumed}. {_convention(c)}")
    sheet.figure(mechanism_scene(r, c.k, c.notation, friction=False))


def _rubbing(c: Chosen, joint: Any) -> str:
    """The friction of a joint as it was given: '; μ = 0.4, R = 0.07 m'."""
    f, shown = getattr(joint, "friction", None), c.shown
    if f is None or c.r.friction is None:
        return ""
    mu, still = coefficient(c.r.mechanism, joint), resting_coefficient(c.r.mechanism, joint)
    parts = [f"μ = {mu:.6g}", f"at rest {still:.6g}" if still != mu else ""]
    for key, sign in (("radius", "R"), ("half_height", "half height"), ("arm", "arm")):
        value = getattr(f, key, None)
        parts.append(f"{sign} = {shown.text('length', value)}" if value else "")
    if getattr(f, "guide", None):
        behind, ahead = (shown.text("length", x) for x in f.guide)
        parts.append(f"guide {behind} behind and {ahead} ahead")
    return f"; {', '.join(p for p in parts if p)}"


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
        at = (
            f" at {spot}"
            if isinstance(spot, str)
            else f" at ({_pair(c.shown, spot)})"
            if spot is not None
            else ""
        )
        return c.shown.polar((fx, fy)) + where + at
    return f"{c.shown.text('moment', float(a.couple[c.k]))} on {c.shown.heading(a.link)}"
