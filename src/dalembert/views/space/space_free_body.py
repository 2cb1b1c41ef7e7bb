"""Free bodies in space: a link alone with everything that acts on it, reactions in their joints' axes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import full_actions, joint_place, link_place, on_link
from dalembert.analysis.result.reaction_axes import axes_of
from dalembert.arrays import Array, Flags
from dalembert.model.joints.pairs import AXES, Pair
from dalembert.views.notation import Notation, Shown, along
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.details import with_details
from dalembert.views.paper.lettering import text_width
from dalembert.views.paper.scene import Item, Line, Point, Scene, Text
from dalembert.views.plane.mechanism_view import ring, unit_size
from dalembert.views.space.camera import Camera
from dalembert.views.space.friction_arrows import draw_friction, friction_details, friction_wrench
from dalembert.views.space.link_solids import nodes
from dalembert.views.space.space_arrows import Arrows
from dalembert.views.space.space_mechanism import mark_center, rims
from dalembert.views.space.space_view import Sight, sight, standing, triad

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

WIDTH, HEIGHT = 56.0, 48.0

FRICTION = "friction"
"""Name of a row that is friction's part of the reaction above it."""


def space_free_body_scene(
    r: Result, link: str, k: int, camera: Camera, notation: Notation | None = None
) -> Scene:
    """One link with everything that acts on it; a table gives the reactions in the axes of their joints.

    Forces are arrows, moments arrows with two heads, of one scale for all links.
    """
    shown = Shown(r, notation or Notation(), k)
    s = _sight(r, link, k, camera)
    canvas = Canvas()
    canvas.add(*s.paint(standing(r, k, s.frame.per_mm, [link])))
    if r.mechanism.mass(link):
        at = s(r.center(link)[k])
        mark_center(canvas, at, [s(link_place(r, link, u)[k]) for u in nodes(r, link).values()])
        canvas.label("G", *ring(at, 1.0), size=2.8, role="note", leads=False)
    everything = full_actions(r)
    arrows = Arrows(canvas, r, s, shown, [a for a in everything if a.link != "ground"], k)
    rows = []
    for name in joints_on(r, link):
        axes = [axes_of(r, name, "joint", moment)[k] for moment in (False, True)]
        both = [reaction(r, name, link, k), _friction(r, name, link, k, axes)]
        rows += [row for row in both if row.joint == name or row.carried.any()]
        numbers = both[0].numbers - both[1].numbers
        _components(arrows, s(joint_place(r, name)[k]), link, name, axes, numbers)
        draw_friction(arrows, name, link, k)
        at = s(joint_place(r, name)[k])
        canvas.label(name, *ring(at, 2.4), size=3.4, role="title")
    for a in on_link(everything, link):
        if a.kind != "joint":
            arrows.action(a, k)
    left, bottom, _, _ = Scene(tuple(canvas.items)).bounds
    triad(canvas, camera, (left - 12.0, bottom))
    notes, scales = arrows.scale_notes()
    drawn = canvas.scene(heading=False, scales=scales)
    _, low, right, top = drawn.bounds
    items = [*drawn.items, *_table(rows, shown, arrows.floor, (right + 6.0, max(top, low + 24.0)))]
    full = Canvas()
    full.add(*items)
    words = [_describe_rows(rows), *notes]
    scene = full.scene(f"Link {shown.heading(link)}", notes=[w for w in words if w], scales=scales)
    return with_details(scene, friction_details(r, k, shown, link))


def joints_on(r: Result, link: str) -> list[str]:
    """Joints of a link."""
    return [n for n in r.joints if link in r.mechanism.joints[n].links]


class ReactionInAxes:
    """A joint's force and moment (6,) on a link in the joint's axes, which components are unique, and which it can
    carry."""

    def __init__(self, joint: str, numbers: Array, unique: Flags, carried: Flags) -> None:
        self.joint, self.numbers, self.unique, self.carried = joint, numbers, unique, carried


def reaction(r: Result, joint: str, link: str, k: int) -> ReactionInAxes:
    """The reaction of a joint on a link at a position; least-norm numbers where it is not unique."""
    described = r.mechanism.joints[joint]
    pair = Pair(AXES, "") if described.wheels else described.pair
    carried = np.array([a in pair.forces for a in AXES] + [a in pair.moments for a in AXES])
    exact = np.concatenate([f(joint, link, "joint")[k] for f in (r.reaction, r.reaction_moment)])
    return ReactionInAxes(joint, r.least_norm(joint, link, "joint")[k], np.isfinite(exact), carried)


def _friction(r: Result, joint: str, link: str, k: int, axes: list[Array]) -> ReactionInAxes:
    """Friction's part of a reaction, in the joint's axes."""
    parts = [e @ v for e, v in zip(axes, friction_wrench(r, joint, link, k), strict=True)]
    numbers = np.nan_to_num(np.concatenate(parts))
    least = 1e-12 * max(float(np.abs(numbers).max()), 1e-300)
    return ReactionInAxes(FRICTION, numbers, np.ones(6, bool), np.abs(numbers) > least)


def _sight(r: Result, link: str, k: int, camera: Camera) -> Sight:
    places = [link_place(r, link, u)[k] for u in nodes(r, link).values()]
    places += rims(r, link, k)
    if r.mechanism.mass(link):
        places.append(r.center(link)[k])
    view = sight(camera, places, WIDTH, HEIGHT, unit_size(r, "length"))
    if max(np.ptp(camera(np.array(places)), axis=0)) < 1e-9:  # one place: as the whole machine
        length = r.compiled.layout.length
        near = [places[0] + 0.25 * length * e for e in (*np.eye(3), *-np.eye(3))]
        view = sight(camera, near, WIDTH, HEIGHT, unit_size(r, "length"))
    return view


def _components(arrows: Arrows, at: Point, link: str, name: str, axes: list[Array], numbers: Array) -> None:
    """Arrows along the joint's axes, whose names have a prime."""
    for turning in (False, True):
        part = numbers[3:] if turning else numbers[:3]
        for axis, value, e in zip(AXES, part, axes[turning], strict=True):
            if abs(float(value)) > arrows.floor[turning]:
                letter = (arrows.shown.joint_moment if turning else arrows.shown.reaction)(name, link)
                sign = along(letter, f"{axis}'")
                arrows.vector(at, float(value) * e, "joint-force", name, sign, turning)


def _describe_rows(rows: list[ReactionInAxes]) -> str:
    free = [row.joint for row in rows if not row.unique[row.carried].all()]
    text = "Reactions on this link, along the axes x', y', z' of each joint"
    if any(row.joint == FRICTION for row in rows):
        text += ", friction included; friction's part is below each, and has separate arrows"
    if free:
        text += "; in brackets, of " + ", ".join(free) + ": not unique, least-norm values"
    return f"{text}." if rows else ""


def _table(rows: list[ReactionInAxes], shown: Shown, floor: tuple[float, float], at: Point) -> list[Item]:
    """Table of the reactions' components, one row per joint; components that a joint cannot carry have a dash."""
    units = [shown.unit("force")] * 3 + [shown.unit("moment")] * 3
    head = ["", *(f"{letter}_{{{axis}'}}" for letter in "FM" for axis in AXES)]
    cells = [head, ["", *units], *([row.joint, *_numbers(row, shown, floor)] for row in rows)]
    widths = [max(text_width(line[c], 2.6) for line in cells) + 3.0 for c in range(7)]
    items: list[Item] = []
    for n, line in enumerate(cells):
        x, y = at[0], at[1] - 4.4 * n - (0.8 if n > 1 else 0.0)
        for c, cell in enumerate(line):
            x += widths[c]
            part = n < 2 or (c == 0 and cell == FRICTION)
            role = "note" if part else "title" if c == 0 else "text"
            if cell:
                items.append(Text((x, y), cell, 2.6, role, "end"))
    y = at[1] - 4.4 * 2 + 1.9
    return [*items, Line(((at[0], y), (at[0] + sum(widths), y)), "axis")]


def _numbers(row: ReactionInAxes, shown: Shown, floor: tuple[float, float]) -> list[str]:
    out = []
    for n, value in enumerate(map(float, row.numbers)):
        text = shown.number("force" if n < 3 else "moment", value, floor[n // 3])
        if not row.carried[n] and abs(value) <= floor[n // 3]:
            out.append("–")
        else:
            out.append(text if row.unique[n] else f"({text})")
    return out
