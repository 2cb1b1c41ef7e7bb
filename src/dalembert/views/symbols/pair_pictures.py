"""The joints in space as pictures: each symbol with its local axes and the reactions it carries along them."""

from __future__ import annotations

import numpy as np

from dalembert.errors import ModelError
from dalembert.model.joints.pairs import AXES, PAIRS
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.scene import Arrow, Line, Point, Scene, stack_scenes
from dalembert.views.space.camera import Camera
from dalembert.views.space.painter import paint
from dalembert.views.space.solids import place_solids
from dalembert.views.symbols import plane_symbols
from dalembert.views.symbols.pair_symbols import symbol
from dalembert.wording import closest

FORCE, MOMENT, END, LARGER = (11.0, 18.5), (20.0, 27.5), 30.0, 1.8
"""Distances along an axis of a force, a moment and the end of the axis, mm, not to scale; factor on symbols."""


def pair_scene(kind: str, camera: Camera) -> Scene:
    """One joint: the part on i is blue, the part on j yellow; forces with one head, moments with two."""
    if kind not in PAIRS:
        raise ModelError(f"unknown joint {kind!r} in space", closest(kind, list(PAIRS)))
    pair, drawn = PAIRS[kind], symbol(kind)
    canvas = Canvas()
    seen = dict(zip(AXES, camera(np.eye(3)), strict=True))

    def at(axis: str, distance: float) -> Point:
        return float(distance * seen[axis][0]), float(distance * seen[axis][1])

    for axis in AXES:
        if float(np.hypot(*seen[axis])) > 0.05:
            canvas.add(Line((at(axis, 0.0), at(axis, END)), "construction"))
    solids = place_solids([*drawn.on_i, *drawn.on_j], np.eye(3), np.zeros(3), LARGER)
    canvas.add(*paint(solids, camera))
    for axis in AXES:
        if float(np.hypot(*seen[axis])) <= 0.05:
            continue
        if axis in pair.forces:
            canvas.add(Arrow(at(axis, FORCE[0]), at(axis, FORCE[1]), "joint-force", f"F{axis}"))
            canvas.label(f"F_{{{axis}}}", at(axis, FORCE[1] - 1.5), size=2.8, role="joint-force", leads=False)
        if axis in pair.moments:
            ends = (at(axis, MOMENT[0]), at(axis, MOMENT[1]))
            canvas.add(*plane_symbols.two_heads(*ends, "effort", f"M{axis}", "", None))
            canvas.label(f"M_{{{axis}}}", at(axis, MOMENT[1] - 2.0), size=2.8, role="effort", leads=False)
        canvas.label(axis, at(axis, END), size=2.8, role="note", leads=False)
    return canvas.scene(words(kind), notes=[describe_kind(kind), f"Axes: {pair.local}."])


def pairs_scene(camera: Camera) -> Scene:
    """All joints, those that carry least first."""
    return stack_scenes(
        [pair_scene(kind, camera) for kind in sorted_kinds()], width=270.0, title="Joints in space"
    )


def sorted_kinds() -> list[str]:
    """Kinds of joints, those that carry least first."""
    return sorted(PAIRS, key=lambda kind: len(PAIRS[kind].reactions))


def words(kind: str) -> str:
    """A joint's name as text.

    >>> words("sphere_in_cylinder")
    'Sphere in cylinder'
    """
    return kind.replace("_", " ").capitalize()


def describe_kind(kind: str) -> str:
    """Freedoms of a joint, and the components of force and moment that it carries.

    >>> describe_kind("cylindrical")
    '1 turn, 1 slide; Fy Fz My Mz.'
    """
    pair = PAIRS[kind]
    turns, slides = len(pair.turns), len(pair.slides)
    free = [f"{n} {noun}{'s' * (n > 1)}" for n, noun in ((turns, "turn"), (slides, "slide")) if n]
    return f"{', '.join(free) or 'Nothing free'}; {' '.join(pair.reactions)}."
