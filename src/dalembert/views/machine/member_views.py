"""Diagrams of N, V and M along each member: least and greatest of the cycle, and where the size is largest."""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array
from dalembert.machine.members.member_forces import IN_PLANE, ORDER, MemberCurve, MemberForces, kind_of
from dalembert.machine.members.member_table import MemberTable
from dalembert.machine.output.member_text import SIGNS, floors
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.diagrams import curves_scene
from dalembert.views.paper.frame import round_up
from dalembert.views.paper.scene import Line, Scene
from dalembert.views.plane.mechanism_view import draw_links, place_title, scale_notes, whole_frame

ORDINATE = 18.0
"""Millimetres that the largest inner force is drawn, at most."""
PLACES = 61
"""Along a member, beside both sides of every force."""


def member_scenes(t: MemberTable, notation: Notation) -> list[Scene]:
    """In the plane each inner force on the links where it is largest; a chart of each over every member's length."""
    shown = Shown(t.result, notation)
    out = _on_links(t, shown) if t.result.mechanism.dimension == 2 else []
    for forces in t.links.values():
        least = floors(forces)
        for curve in forces.curves:
            for of in forces.names:
                size = np.nanmax(np.abs(curve.greatest(of)[0]), initial=0.0)
                if size > least[kind_of(of)]:
                    out.append(_diagram(forces, curve, of, shown))
    return out


def _on_links(t: MemberTable, shown: Shown) -> list[Scene]:
    """The mechanism where an inner force is largest, its diagram on every member, + to the left of it."""
    out = []
    for of in IN_PLANE:
        kind, row = kind_of(of), ORDER.index(of)
        largest = {link: f.largest(of) for link, f in t.links.items()}
        some = {n: f for n, f in t.links.items() if abs(largest[n][0]) > floors(f)[kind]}
        if not some:
            continue
        size, k = max((abs(largest[n][0]), largest[n][3]) for n in some)
        per_mm = round_up(size / shown.size(kind) / ORDINATE) * shown.size(kind)
        frame, canvas = whole_frame(t.result, k, 112.0, 80.0), Canvas()
        draw_links(canvas, t.result, k, frame)
        for link, curve in ((link, c) for link, f in some.items() for c in f.curves):
            places, values = sampled(curve)
            turned, at = t.result.rotation(link)[k], t.result.position(link)[k]
            along, start = turned @ curve.member.along[:2], turned @ curve.member.start[:2] + at
            feet = [frame(start + s * along) for s in places]
            mm = values[k, :, row] / per_mm
            tips = [(x - h * along[1], y + h * along[0]) for (x, y), h in zip(feet, mm, strict=True)]
            canvas.add(Line((feet[0], *tips, feet[-1]), "curve-1"))
            canvas.add(*(Line((a, b), "curve-1") for a, b in zip(feet[::6], tips[::6], strict=True)))
            n = int(np.argmax(np.abs(mm)))
            canvas.label(shown.text(kind, float(values[k, n, row])), tips[n], size=2.8)
        notes, scales = scale_notes(shown, frame, None)
        notes[0] += f"; {SIGNS[of]}: 1 mm = {shown.plain(kind, per_mm)}, + to the left of its member"
        title = place_title(t.result, k, f"{SIGNS[of]}, {of}", shown)
        out.append(canvas.scene(title, notes=notes, scales=scales | {kind: per_mm}))
    return out


def _diagram(forces: MemberForces, curve: MemberCurve, of: str, shown: Shown) -> Scene:
    """One inner force over the distance along the member."""
    kind, row = kind_of(of), ORDER.index(of)
    places, values = sampled(curve)
    values = values[:, :, row] / shown.size(kind)
    k = int(np.nanargmax(np.abs(curve.greatest(of)[0])))
    series = {SIGNS[of]: values[k]}
    if len(values) > 1:
        with np.errstate(all="ignore"):
            known = values[np.isfinite(values).all(axis=1)]
        series = {"least": known.min(axis=0), "greatest": known.max(axis=0), f"position {k + 1}": values[k]}
    title = f"{SIGNS[of]}, {of} of {forces.link}"
    x = f"From {curve.member.ends[0]} to {curve.member.ends[1]} in {shown.unit('length')}"
    y = f"{SIGNS[of]} in {shown.unit(kind)}"
    return curves_scene(places / shown.size("length"), series, x, y, title)


def sampled(curve: MemberCurve) -> tuple[Array, Array]:
    """Distances (S,) and inner forces (P, S, 6) there, on both sides of every force that keeps its place."""
    length = curve.member.length
    known = curve.edges[np.isfinite(curve.edges).all(axis=1)]
    steady = np.ptp(known, axis=0) <= 1e-9 * length if len(known) else np.zeros(0, bool)
    jumps = known[0][steady] if len(known) else np.zeros(0)
    even = np.linspace(0.0, length, PLACES)
    before, behind = np.union1d(jumps[jumps > 0], even[1:]), np.union1d(jumps[jumps < length], even[:-1])
    places = np.concatenate([before, behind])
    values = np.concatenate([curve.at(before, "before"), curve.at(behind, "behind")], axis=1)
    order = np.argsort(places, kind="stable")
    return places[order], values[:, order]
