"""Diagrams of N, V, T and M on the links and along each member, least and greatest of the cycle."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array, first_largest
from dalembert.machine.link_axes import LinkAxes, in_space
from dalembert.machine.members.member_forces import ORDER, MemberCurve, MemberForces, kind_of
from dalembert.machine.members.member_table import MemberTable
from dalembert.machine.output.member_text import SIGNS, floors
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.diagrams import curves_scene
from dalembert.views.paper.frame import round_up
from dalembert.views.paper.scene import Line, Point, Scene
from dalembert.views.plane.mechanism_view import draw_links, full_frame, place_title, scale_notes
from dalembert.views.space.camera import Camera
from dalembert.views.space.space_mechanism import draw_machine, full_sight
from dalembert.views.space.space_view import scale_notes as sight_notes
from dalembert.views.space.space_view import triad

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

LETTERS = {of: f"{sign[0]}_{{{sign[2:]}}}" if sign[1:] else sign for of, sign in SIGNS.items()}
ORDINATE = 18.0
"""Largest ordinate of an internal force, mm."""
SEEN = 0.2
"""Ordinate below which a diagram is left out, mm: the charts contain it."""
PLACES = 61
"""Number of places along a member, in addition to both sides of every force."""


def member_scenes(t: MemberTable, notation: Notation) -> list[Scene]:
    """Each internal force on the links at its largest value; a chart of each over every member's length."""
    shown, out = Shown(t.result, notation), []
    for of in next(iter(t.links.values())).names:
        kind = kind_of(of)
        largest = {link: f.largest(of) for link, f in t.links.items()}
        some = {n: f for n, f in t.links.items() if abs(largest[n][0]) > floors(f)[kind]}
        if some:
            size, k, link = max((abs(largest[n][0]), largest[n][3], n) for n in some)
            seen = some[link].curve(largest[link][1]).member.axes @ _turn(t.result, link, k).T
            out.append(_on_links(some, of, size, Paper(t.result, k, shown, seen[[0, _across(of)]])))
    for forces in t.links.values():
        least = floors(forces)
        for curve in forces.curves:
            for of in forces.names:
                size = np.nanmax(np.abs(curve.greatest(of)[0]), initial=0.0)
                if size > least[kind_of(of)]:
                    out.append(_diagram(forces, curve, of, shown))
    return out


class Paper:
    """A position of a machine as drawn, in space turned so that two vectors (2, 3) are clearly visible, with functions
    that map places and vectors to millimetres on the paper."""

    place: Callable[[Array], Point]
    vector: Callable[[Array], Array]

    def __init__(self, r: Result, k: int, shown: Shown, facing: Array) -> None:
        self.r, self.k, self.shown, self.canvas = r, k, shown, Canvas()
        if r.mechanism.dimension == 2:
            frame = full_frame(r, k, 112.0, 80.0)
            self.place, self.vector = lambda p: frame(p[:2]), lambda v: v[:2]
            draw_links(self.canvas, r, k, frame)
            self.notes, self.scales = scale_notes(shown, frame, None)
            return
        cameras = [Camera(math.pi * (2 * n + 1) / 4) for n in range(4)]
        camera = max(cameras, key=lambda c: abs(float(np.linalg.det(c(facing)))))
        s = full_sight(r, k, camera, 112.0, 80.0)
        self.place, self.vector = s, s.camera
        draw_machine(self.canvas, r, k, s)
        left, bottom, _, _ = Scene(tuple(self.canvas.items)).bounds
        triad(self.canvas, s.camera, (left - 12.0, bottom))
        self.notes, self.scales = sight_notes(shown, s, None)


def _on_links(some: dict[str, MemberForces], of: str, size: float, paper: Paper) -> Scene:
    """The mechanism at the position where an internal force is largest, with its diagram on every member, + along the
    member's y or z."""
    r, k, shown, canvas = paper.r, paper.k, paper.shown, paper.canvas
    kind, row, plane = kind_of(of), ORDER.index(of), r.mechanism.dimension == 2
    per_mm = round_up(size / shown.size(kind) / ORDINATE) * shown.size(kind)
    for link, curve in ((link, c) for link, f in some.items() for c in f.curves):
        places, values = sampled(curve)
        mm, turned = values[k, :, row] / per_mm, _turn(r, link, k)
        if not np.abs(mm).max() > SEEN:
            continue
        axes = curve.member.axes @ turned.T
        start = turned @ curve.member.start + in_space(r.position(link))[k]
        feet = [paper.place(start + s * axes[0]) for s in places]
        x, y = map(float, paper.vector(axes[_across(of)]))
        tips = [(a + h * x, b + h * y) for (a, b), h in zip(feet, mm, strict=True)]
        canvas.add(Line((feet[0], *tips, feet[-1]), "curve-1"))
        ordinates = [Line((a, b), "curve-1") for a, b in zip(feet, tips, strict=True)]
        canvas.add(*ordinates[::6])
        canvas.keep_clear(*ordinates)
        first, last = np.flatnonzero(np.abs(mm) > 0.999999 * np.abs(mm).max())[[0, -1]]
        outward = math.atan2(y * mm[first], x * mm[first])
        text = shown.text(kind, float(values[k, first, row]))
        canvas.label(text, tips[first], tips[last], prefer=outward, size=2.8)
    sense = "to the left of" if plane else f"along {' yz'[_across(of)]} of"
    scale = f"{LETTERS[of]}: 1 mm = {shown.plain(kind, per_mm)}, + {sense} its member"
    notes = [f"{paper.notes[0].removesuffix('.')}; {scale}{'' if plane else '.'}", *paper.notes[1:]]
    title = place_title(r, k, f"{LETTERS[of]}, {of}", shown)
    return canvas.scene(title, notes=notes, scales=paper.scales | {kind: per_mm})


def _across(of: str) -> int:
    """Index of the member's axis along which a diagram is plotted: z (2) for bending in the plane that contains it."""
    return 2 if of in ("shear z", "bending y") else 1


def _turn(r: Result, link: str, k: int) -> Array:
    """Rotation (3, 3) of a link at a position."""
    return np.asarray(LinkAxes(r, link).rotation[k])


def _diagram(forces: MemberForces, curve: MemberCurve, of: str, shown: Shown) -> Scene:
    """One internal force over the distance along the member."""
    kind, row = kind_of(of), ORDER.index(of)
    places, values = sampled(curve)
    values = values[:, :, row] / shown.size(kind)
    k = first_largest(np.abs(curve.greatest(of)[0]))
    series = {LETTERS[of]: values[k]}
    if len(values) > 1:
        with np.errstate(all="ignore"):
            known = values[np.isfinite(values).all(axis=1)]
        series = {"least": known.min(axis=0), "greatest": known.max(axis=0), f"position {k + 1}": values[k]}
    title = f"{LETTERS[of]}, {of} of {forces.link}"
    x = f"From {curve.member.ends[0]} to {curve.member.ends[1]} in {shown.unit('length')}"
    y = f"{LETTERS[of]} in {shown.unit(kind)}"
    return curves_scene(places / shown.size("length"), series, x, y, title)


def sampled(curve: MemberCurve) -> tuple[Array, Array]:
    """Distances (S,) and the internal forces (P, S, 6) at them, on both sides of every force with a fixed place."""
    length = curve.member.length
    even, jumps = np.linspace(0.0, length, PLACES), curve.jumps
    before, behind = np.union1d(jumps[jumps > 0], even[1:]), np.union1d(jumps[jumps < length], even[:-1])
    places = np.concatenate([before, behind])
    values = np.concatenate([curve.at(before, "before"), curve.at(behind, "behind")], axis=1)
    order = np.argsort(places, kind="stable")
    return places[order], values[:, order]
