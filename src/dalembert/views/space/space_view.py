"""A machine in space on paper: places and vectors through a camera, to scale."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.views.notation import Figures
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import PaperFrame, fit_frame
from dalembert.views.paper.scene import Arrow, Circle, Item, Line, Point
from dalembert.views.space.camera import CAMERAS, ISOMETRIC, Camera
from dalembert.views.space.link_solids import link_solids, pose
from dalembert.views.space.painter import paint
from dalembert.views.space.solids import Solid, place_solid
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

NOTHING = 1e-9
"""A force, or a moment over the machine's length, below this fraction of the largest of both is rounding error."""

View = Camera | str | tuple[float, float] | None


def camera_of(view: View) -> Camera:
    """A camera by its name or by (azimuth, elevation) in degrees; isometric without either.

    >>> camera_of((0.0, 90.0)).eye.round(3).tolist()
    [0.0, 0.0, 1.0]
    """
    if view is None or isinstance(view, Camera):
        return view or ISOMETRIC
    if isinstance(view, tuple):
        return Camera(*(math.radians(angle) for angle in view))
    if view not in CAMERAS:
        raise ModelError(f"unknown view {view!r}", closest(view, list(CAMERAS)))
    return CAMERAS[view]


@dataclass(frozen=True)
class Sight:
    """A camera with its scale."""

    camera: Camera
    frame: PaperFrame

    def __call__(self, p: Point | Array) -> Point:
        """A place of the machine (metres) on paper."""
        return self.frame(self.camera(p))

    def ahead(self, start: Point, v: Array, per_mm: float) -> Point:
        """Head of an arrow from a point on paper that represents a vector in space."""
        dx, dy = self.camera(v) / per_mm
        return start[0] + float(dx), start[1] + float(dy)

    def paint(self, solids: Iterable[Solid]) -> list[Item]:
        """Solids in ground axes and metres, on paper."""
        x, y = self.frame.middle
        middle = x * self.camera.right + y * self.camera.up
        scale = 1 / self.frame.per_mm
        return paint((place_solid(s, np.eye(3), -scale * middle, scale) for s in solids), self.camera)


def sight(camera: Camera, places: Iterable[Array], width: float, height: float, factor: float) -> Sight:
    """A camera that shows all places in a space on paper; ``factor`` is the size of the reader's unit in metres."""
    seen = camera(np.array([p for p in places if np.isfinite(p).all()]).reshape(-1, 3))
    return Sight(camera, fit_frame([tuple(p) for p in seen], width, height, factor))


def standing(r: Result, k: int, size: float, links: Iterable[str] | None = None) -> list[Solid]:
    """Solids of links, ground included, at a position, in ground axes and metres."""
    solids = link_solids(r, size)
    out = []
    for link in solids if links is None else links:
        turn, at = pose(r, link, k)
        if np.isfinite(turn).all():
            out += [place_solid(s, turn, at) for s in solids[link]]
    return out


def triad(canvas: Canvas, camera: Camera, at: Point, length: float = 9.0) -> None:
    """The ground axes, foreshortened; an axis along the line of sight is omitted."""
    for name, e in zip("xyz", camera(np.eye(3)), strict=True):
        head = (at[0] + length * float(e[0]), at[1] + length * float(e[1]))
        if math.dist(at, head) > 0.5:
            canvas.add(Arrow(at, head, "axis-arrow"))
            canvas.label(name, head, size=2.6, role="note", leads=False)


def end_on(at: Point, towards: bool, role: str) -> list[Item]:
    """A vector along the line of sight: a dot in a circle towards the eye, a cross away from it."""
    ring: list[Item] = [Circle(at, 1.1, f"{role}-end")]
    if towards:
        return [*ring, Circle(at, 0.3, role)]
    d = 0.78
    cross = [((at[0] - d, at[1] - s * d), (at[0] + d, at[1] + s * d)) for s in (-1, 1)]
    return [*ring, *(Line(ends, role) for ends in cross)]


def foreshortening_note(camera: Camera) -> str:
    """Sentence on the foreshortening of the axes."""
    short = np.linalg.norm(camera(np.eye(3)), axis=-1)
    return f"foreshortening along x, y and z: {', '.join(f'{x:.3f}' for x in short)}"


def scale_notes(
    shown: Figures, s: Sight, force: float | None, moment: float | None = None
) -> tuple[list[str], dict[str, float]]:
    """The scales as a note and as numbers: lengths across the line of sight are to scale, others foreshortened by their
    slope."""
    parts = [f"lengths across the view: 1 mm = {shown.plain('length', s.frame.per_mm)}"]
    scales = {"length": s.frame.per_mm}
    if force:
        parts.append(f"forces: 1 mm = {shown.plain('force', force)}")
        scales["force-seen"] = force
    if moment:
        parts.append(f"moments, with two heads: 1 mm = {shown.plain('moment', moment)}")
        scales["moment-seen"] = moment
    text = "; ".join(parts)
    return [f"{text[:1].upper()}{text[1:]}.", f"Parallel view; {foreshortening_note(s.camera)}."], scales
