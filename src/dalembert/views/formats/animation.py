"""The mechanism in motion with its forces, at one scale: SVG that plays by itself, GIF, WebP."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, full_actions
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.arrays import Array
from dalembert.errors import SOLVED, ModelError
from dalembert.saving import check_installed, new_file
from dalembert.views.not_shown import refuse_still
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import force_scale
from dalembert.views.paper.lettering import Box
from dalembert.views.paper.scene import Item, Scene, Text
from dalembert.views.plane.mechanism_view import (
    draw_couple,
    draw_force,
    draw_links,
    draw_traces,
    full_frame,
    scale_notes,
    unit_size,
)
from dalembert.views.space import space_mechanism as drawn
from dalembert.views.space.camera import Camera
from dalembert.views.space.space_arrows import Arrows
from dalembert.views.space.space_view import NOTHING, triad

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.views.formats.svg import Writer

LONGEST = 28.0
"""Largest force over the cycle, mm."""


@dataclass(frozen=True)
class Animation:
    """Successive scenes over a static background, shown in a loop of a given duration."""

    still: tuple[Item, ...]
    frames: tuple[Scene, ...]
    seconds: float = 4.0
    title: str = ""
    scales: dict[str, float] = field(default_factory=dict)

    @property
    def bounds(self) -> Box:
        """Bounding box of all frames."""
        boxes = np.array([Scene((*self.still, *f.items)).bounds for f in self.frames])
        low, high = boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)
        return (float(low[0]), float(low[1]), float(high[0]), float(high[1]))

    def to_svg(self, theme: str = "light") -> str:
        """SVG that plays in a browser, without a script."""
        from dalembert.views.formats.svg import page

        return page(self.bounds, self.title, theme, self._draw_frames)

    def _draw_frames(self, writer: Writer) -> str:
        count = len(self.frames)
        out = "".join(writer.item(item) for item in self.still)
        for n, scene in enumerate(self.frames):
            items = "".join(writer.item(item) for item in scene.items)
            shown, timing = "visible" if n == 0 else "hidden", _frame_timing(n, count, self.seconds)
            out += f'<g visibility="{shown}">{timing}{items}</g>'
        return out

    def save(self, path: str | Path, overwrite: bool = False, theme: str = "light") -> None:
        """Writes .svg, .gif or .webp."""
        target = Path(path)
        kind = target.suffix.lower()
        if kind not in (".svg", ".gif", ".webp"):
            raise ModelError(
                f"{target.name}: animations cannot be written in this format", "use .svg, .gif or .webp"
            )
        if kind != ".svg":
            check_installed("matplotlib", f"writing {kind[1:].upper()}", "plot")
            check_installed("PIL", f"writing {kind[1:].upper()}", "plot")
        with new_file(target, overwrite) as temporary:
            if kind == ".svg":
                temporary.write_text(self.to_svg(theme), encoding="utf-8")
            else:
                self._write_pictures(temporary, kind[1:], theme)

    def _write_pictures(self, path: Path, kind: str, theme: str) -> None:
        from PIL import Image

        from dalembert.views.formats.matplotlib_figure import pictures

        shown = pictures(self.still, [f.items for f in self.frames], self.bounds, theme)
        if kind == "gif":
            palette = shown[0].quantize(64)
            shown = [p.quantize(64, palette=palette, dither=Image.Dither.NONE) for p in shown]
        each = round(1000 * self.seconds / len(self.frames))
        shown[0].save(
            path, format=kind.upper(), save_all=True, append_images=shown[1:], duration=each, loop=0
        )

    def _repr_html_(self) -> str:
        return self.to_svg()


def _frame_timing(n: int, count: int, seconds: float) -> str:
    """The element that shows a frame in its part of the time."""
    start, end = n / count, (n + 1) / count
    values, times = ["hidden", "visible", "hidden"], [0.0, start, end]
    if n == 0:
        values, times = values[1:], [0.0, end]
    elif n == count - 1:
        values, times = values[:2], times[:2]
    stops = ";".join(f"{t:.5g}" for t in times)
    return (
        f'<animate attributeName="visibility" values="{escape(";".join(values))}" keyTimes="{stops}" '
        f'dur="{seconds:g}s" calcMode="discrete" repeatCount="indefinite"/>'
    )


class _Film(NamedTuple):
    """Static items, the frames with their positions, the text and the scales."""

    still: Canvas
    frames: list[tuple[int, Scene]]
    notes: list[str]
    scales: dict[str, float]


def animation_scene(
    r: Result,
    notation: Notation | None = None,
    seconds: float = 4.0,
    most: int = 60,
    camera: Camera | None = None,
) -> Animation:
    """The positions of a result as an animation, with loads, efforts and joint forces at one scale.

    Positions whose forces are not known (at rest, jammed) are shown without them, and redundant ones with those of
    least norm; the frames say so. With a camera the mechanism is in space.
    """
    refuse_still(r, "an animation")
    posed = np.flatnonzero(np.isfinite(r.point_array).all(axis=(1, 2)))
    which = posed[np.unique(np.linspace(0, len(posed) - 1, min(most, len(posed))).astype(int))]
    shown = Shown(r, notation or Notation())
    some = [
        a for a in full_actions(r) if a.kind in ("load", "effort", "spring", "joint") and a.link != "ground"
    ]
    film = _in_space(r, which, some, shown, camera) if camera else _in_plane(r, which, some, shown)
    bounds = Animation(tuple(film.still.items), tuple(s for _, s in film.frames)).bounds
    fixed = _fixed_texts(r, bounds, film.notes)
    lettered = tuple(_frame_heading(r, k, scene, bounds, shown) for k, scene in film.frames)
    return Animation((*film.still.items, *fixed), lettered, seconds, r.mechanism.title, film.scales)


def _in_plane(r: Result, which: Array, some: list[Action], shown: Shown) -> _Film:
    frame = full_frame(r, int(which[0]), 110.0, 85.0)
    sizes = [float(np.nanmax(np.hypot(*a.force.T), initial=0.0)) for a in some]
    per_mm = force_scale(sizes, LONGEST, unit_size(r, "force", shown.notation))
    still = Canvas()
    draw_traces(still, r, frame)
    frames = []
    for k in map(int, which):
        canvas = Canvas()
        draw_links(canvas, r, k, frame)
        for a in some:
            if float(np.hypot(*a.force[k])) / per_mm > 0.3:
                draw_force(canvas, r, a, k, frame, shown, per_mm, values=None)
            if abs(float(a.couple[k])) > 0 and a.kind != "joint":
                draw_couple(canvas, r, a, k, frame, shown, values=None)
        frames.append((k, canvas.scene(heading=False)))
    return _Film(still, frames, *scale_notes(shown, frame, per_mm))


def _in_space(r: Result, which: Array, some: list[Action], shown: Shown, camera: Camera) -> _Film:
    s = drawn.full_sight(r, int(which[0]), camera, 110.0, 85.0)
    still = Canvas()
    drawn.draw_traces(still, r, s)
    frames = []
    for k in map(int, which):
        canvas = Canvas()
        drawn.draw_machine(canvas, r, k, s)
        arrows = Arrows(canvas, r, s, shown, some, which, LONGEST, values=None)
        for a in some:
            arrows.action(a, k)
        frames.append((k, canvas.scene(heading=False)))
    left, bottom, _, _ = Animation(tuple(still.items), tuple(scene for _, scene in frames)).bounds
    triad(still, camera, (left - 12.0, bottom))
    still.scene(heading=False)
    return _Film(still, frames, *arrows.scale_notes(everything=True))


def _fixed_texts(r: Result, bounds: Box, notes: Sequence[str]) -> list[Item]:
    left, bottom, _, top = bounds
    title = [Text((left, top + 10.0), r.mechanism.title or "Mechanism", 3.6, "title", "start")]
    return [
        *title,
        *(Text((left, bottom - 4.0 - 4.0 * n), note, 2.6, "note", "start") for n, note in enumerate(notes)),
    ]


def _frame_heading(r: Result, k: int, scene: Scene, bounds: Box, shown: Shown) -> Scene:
    """The position and the efforts of a frame, as text above it."""
    solved = all(np.isfinite(r.least_norm(joint)[k]).all() for joint in r.joints)
    reason = "not unique: those of least norm" if solved else "not known: left out"
    answered = r.status[k] in SOLVED or (r.reverses[k] and solved)
    parts = [] if answered else [f"{r.status[k]}, forces {reason}"]
    parts += ["just before contacts reverse"] if r.reverses[k] else []
    largest = float(np.nanmax(np.abs(r.effort_array), initial=0.0))
    for d in reversed(r.drives):
        kinds, effort = drive_kinds(r, d), float(r.effort(d)[k])
        place = shown.text(kinds["position"], float(r.drive_position(d)[k]))
        force = shown.text(kinds["effort"], effort, NOTHING * largest) if np.isfinite(effort) else "not known"
        parts.insert(0, f"{d} = {place}, effort {force}")
    words = Text((bounds[0], bounds[3] + 5.0), "; ".join(parts), 2.8, "text", "start")
    return Scene((*scene.items, words), scene.title)
