"""Diagrams of N, V and M along each member: least and greatest of the cycle, and where the size is largest."""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array
from dalembert.machine.members.member_forces import ORDER, MemberCurve, MemberForces, kind_of
from dalembert.machine.members.member_table import MemberTable
from dalembert.machine.output.member_text import SIGNS, floors
from dalembert.views.charts import curves_scene
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.scene import Scene

PLACES = 61
"""Along a member, beside both sides of every force."""


def member_scenes(t: MemberTable, notation: Notation) -> list[Scene]:
    """A chart for each inner force of each member that carries it."""
    shown = Shown(t.result, notation)
    out = []
    for forces in t.links.values():
        least = floors(forces)
        for curve in forces.curves:
            for of in forces.names:
                size = np.nanmax(np.abs(curve.greatest(of)[0]), initial=0.0)
                if size > least[kind_of(of)]:
                    out.append(_diagram(forces, curve, of, shown))
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
