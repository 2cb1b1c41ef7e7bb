"""Forces and moments in space as arrows through a camera, each to its scale, with their names and sizes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, link_place
from dalembert.arrays import Array, Index
from dalembert.model import GROUND
from dalembert.views.notation import Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import force_scale
from dalembert.views.paper.scene import Point, along
from dalembert.views.plane.mechanism_view import points_inwards, ring, role_of, unit_size
from dalembert.views.space.link_solids import nodes
from dalembert.views.space.space_view import NOTHING, Sight, end_on, scale_notes
from dalembert.views.symbols import plane_symbols

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


LONGEST = 22.0
"""Largest force and moment, mm."""


class Arrows:
    """Forces as arrows and moments as arrows with two heads, each by its scale.

    ``at``: the position, or positions, whose largest force and moment are ``longest`` mm. ``values`` False writes
    names alone, None nothing.
    """

    def __init__(
        self,
        canvas: Canvas,
        r: Result,
        s: Sight,
        shown: Shown,
        some: list[Action],
        at: Index,
        longest: float = LONGEST,
        values: bool | None = True,
    ) -> None:
        self.canvas, self.r, self.s, self.shown, self.values = canvas, r, s, shown, values
        self.sizes = [_largest([a.force[at] for a in some]), _largest([a.couple[at] for a in some])]
        force, moment = self.sizes
        length = r.compiled.layout.length
        kinds, sizes = ("force", "moment"), (max(force, moment / length), max(moment, force * length))
        force_floor, moment_floor = (
            max(NOTHING * size, shown.least[kind]) for size, kind in zip(sizes, kinds, strict=True)
        )
        self.floor = (force_floor, moment_floor)
        self.sizes = [x if x > least else 0.0 for x, least in zip(self.sizes, self.floor, strict=True)]
        scales = [
            force_scale([size], longest, unit_size(r, kind, shown.notation))
            for size, kind in zip(self.sizes, kinds, strict=True)
        ]
        self.per_mm, self.moment_per_mm = scales
        self.drawn = [False, False]

    def action(self, a: Action, k: int) -> None:
        """The force of an action at its place and its couple; omitted where negligible next to the largest."""
        place, role = self.s(a.at[k]), role_of(a.kind)
        force, couple = np.linalg.norm(a.force[k]), np.linalg.norm(a.couple[k])
        if float(force) > self.floor[0]:
            text = self._text(self.shown.symbol(a), "force", float(force))
            self.vector(place, a.force[k], role, a.of, text, inward=pushes(self.r, a, k))
        if float(couple) > self.floor[1]:
            text = self._text(self.shown.turning_symbol(a), "moment", float(couple))
            self.vector(place, a.couple[k], role, a.of, text, turning=True)

    def _text(self, name: str, kind: str, size: float) -> str:
        """Text beside an arrow."""
        if not self.values:
            return "" if self.values is None else name
        return f"{name} = {self.shown.text(kind, size)}"

    def vector(
        self, at: Point, v: Array, role: str, of: str, text: str, turning: bool = False, inward: bool = False
    ) -> None:
        """One arrow that leaves its place, or ends at it where it pushes inwards; a moment is drawn slightly to one
        side."""
        if not np.isfinite(v).all():
            return
        per_mm, kind = (self.moment_per_mm, "moment-seen") if turning else (self.per_mm, "force-seen")
        self.drawn[turning] = True
        head = self.s.ahead(at, v, per_mm)
        length = math.dist(at, head)
        if length < 0.6:
            if float(np.linalg.norm(v)) > 0.6 * per_mm:
                self.canvas.add(*end_on(at, float(self.s.camera.depth(v)) > 0, role))
            self.canvas.label(text, at, *ring(at, 1.2), size=2.6, role=role)
            return
        tail = at
        if turning:
            dx, dy = 1.2 * (head[1] - at[1]) / length, 1.2 * (at[0] - head[0]) / length
            tail, head = (at[0] + dx, at[1] + dy), (head[0] + dx, head[1] + dy)
        if inward:
            tail, head = (2 * at[0] - head[0], 2 * at[1] - head[1]), at
        parts = plane_symbols.two_heads if turning else plane_symbols.one_head
        self.canvas.add(*parts(tail, head, role, of, kind, length * per_mm))
        far = tail if inward else head
        away = math.atan2(far[1] - at[1], far[0] - at[0])
        self.canvas.label(text, *along(at, far, 1.0, 0.8, 0.6), prefer=away, size=2.6, role=role)

    def scale_notes(self, everything: bool = False) -> tuple[list[str], dict[str, float]]:
        """The scales of the drawn arrows, or of all existing ones, as notes and as numbers."""
        force, moment = (
            [size > least for size, least in zip(self.sizes, self.floor, strict=True)]
            if everything
            else self.drawn
        )
        return scale_notes(
            self.shown, self.s, self.per_mm if force else None, self.moment_per_mm if moment else None
        )


def _largest(vectors: list[Array]) -> float:
    """The largest of the known vectors (..., 3)."""
    sizes = np.concatenate([np.zeros(1), *(np.ravel(np.linalg.norm(v, axis=-1)) for v in vectors)])
    return float(sizes[np.isfinite(sizes)].max())


def pushes(r: Result, a: Action, k: int) -> bool:
    """True if a force points from its place towards the middle of its link."""
    if a.link == GROUND or a.kind in ("weight", "inertia"):
        return False
    return points_inwards(a, k, [link_place(r, a.link, u)[k] for u in nodes(r, a.link).values()])
