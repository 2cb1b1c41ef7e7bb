"""The figure of a question: the mechanism with the given data, without anything that reveals an answer."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, other_actions
from dalembert.views.notation import Notation, Shown, load_sign
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import fit_frame
from dalembert.views.paper.scene import Scene
from dalembert.views.plane.mechanism_view import (
    canvas_names,
    draw_actions,
    draw_links,
    is_drawn,
    place_title,
    scale_notes,
    unit_size,
)
from dalembert.views.plane.outline import every_path
from dalembert.views.space.camera import Camera
from dalembert.views.space.space_arrows import Arrows
from dalembert.views.space.space_mechanism import HEIGHT, WIDTH, draw_machine, draw_names, every_place
from dalembert.views.space.space_view import sight, triad
from dalembert.views.stated import as_stated, drive_text, stated_lines

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

ASKED = 14.0
"""Length in mm of the arrow of an unknown, whatever its value."""

UNNUMBERED = "Arrows without a number are unknowns, drawn in their positive sense."
ELSEWHERE = "Not drawn at an equilibrium position."


def question_scene(
    r: Result,
    k: int = 0,
    notation: Notation | None = None,
    camera: Camera | None = None,
    data: bool = True,
    by_letters: Collection[str] = (),
) -> Scene:
    """The mechanism to scale with known loads by name and value, and unknown ones by name alone.

    Computed efforts, reactions, speeds and angles are left out, and so are the senses of efforts and unknown loads;
    ``data`` lists the given data below; loads ``by_letters`` have no number, as the reader is to find it. Equilibrium
    positions are unknowns and are not drawn.
    """
    title, notation = r.mechanism.title or "Mechanism", as_stated(notation)
    stated = [f"Drive {d}: {drive_text(Shown(r, notation), k, d)}." for d in r.drives]
    sought = [d for d in r.drives if r.mechanism.drives[d].unknown]
    if sought:
        r, k = _elsewhere(r), 0
    shown = Shown(r, notation)
    canvas = Canvas()
    known, unknown = _sort(r, sought)
    if camera is None:
        notes, scales = _draw_plane(canvas, k, shown, known, unknown, by_letters)
    else:
        notes, scales = _draw_space(canvas, k, shown, camera, known, unknown)
    lettered = [load_sign(n) for n in by_letters]
    notes += [f"Given in letters: {', '.join(lettered)}."] * bool(lettered and camera is None)
    notes += [UNNUMBERED.replace("Arrows", "Other arrows") if lettered else UNNUMBERED] * bool(unknown)
    notes += [ELSEWHERE] * bool(sought)
    heading = title if sought else place_title(r, k, title, shown)
    lines = [*stated, *stated_lines(shown, k)] if data else []
    return canvas.scene(heading, notes=[*notes, *lines], scales=scales)


def _elsewhere(r: Result) -> Result:
    """The mechanism at another position of the range in which its equilibrium is sought."""
    from dalembert.analysis.solution import kinematics

    values: dict[str, object] = {}
    for name, drive in r.mechanism.drives.items():
        if drive.unknown:
            low, high = drive.range or (0.0, 1.0)
            position = low + 0.381966 * (high - low)
            values[f"drives.{name}"] = drive.model_copy(
                update={"position": position, "effort": None, "range": None}
            )
    return kinematics(r.mechanism.with_values(values))


def _sort(r: Result, without: Sequence[str]) -> tuple[list[Action], list[Action]]:
    """Known and unknown loads and efforts, the unknown ones with the value 1; without those of some drives."""
    ones = replace(r, effort_array=np.ones_like(r.effort_array), load_array=np.ones_like(r.load_array))
    stated: list[Action] = []
    unknown: list[Action] = []
    for old, new in zip(other_actions(r), other_actions(ones), strict=True):
        if old.kind in ("load", "effort") and is_drawn(r, old) and old.of not in without:
            known = bool(old.source)
            (stated if known else unknown).append(old if known else new)
    return stated, unknown


def _draw_plane(
    canvas: Canvas,
    k: int,
    shown: Shown,
    known: list[Action],
    unknown: list[Action],
    by_letters: Collection[str],
) -> tuple[list[str], dict[str, float]]:
    """The mechanism and its loads; notes and scales."""
    r = shown.r
    lettered = [a for a in known if a.of in by_letters]
    known = [a for a in known if a.of not in by_letters]
    frame = fit_frame(every_path(r)[:, k], 120.0, 90.0, unit_size(r, "length"))
    draw_links(canvas, r, k, frame)
    canvas_names(canvas, r, k, frame, shown)
    per_mm = draw_actions(canvas, r, known, k, frame, shown, 22.0, clear=True)
    draw_actions(canvas, r, lettered, k, frame, shown, 22.0, values=False, clear=True)
    draw_actions(canvas, r, unknown, k, frame, shown, ASKED, per_mm=1 / ASKED, values=False, clear=True)
    return scale_notes(shown, frame, per_mm)


def _draw_space(
    canvas: Canvas, k: int, shown: Shown, camera: Camera, known: list[Action], unknown: list[Action]
) -> tuple[list[str], dict[str, float]]:
    """The same in space."""
    r = shown.r
    s = sight(camera, every_place(r, k), WIDTH, HEIGHT, unit_size(r, "length"))
    draw_machine(canvas, r, k, s)
    draw_names(canvas, r, k, s, shown)
    arrows = Arrows(canvas, r, s, shown, known, k)
    for a in known:
        arrows.action(a, k)
    others = Arrows(canvas, r, s, shown, unknown, k, ASKED, values=False)
    for a in unknown:
        others.action(a, k)
    left, bottom, _, _ = Scene(tuple(canvas.items)).bounds
    triad(canvas, camera, (left - 12.0, bottom))
    return arrows.scale_notes()
