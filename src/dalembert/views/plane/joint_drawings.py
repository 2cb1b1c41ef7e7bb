"""Symbols of planar joints on paper, at one position: a row of ``DRAWINGS`` for each type."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import joint_place, link_angle, link_place, slide_direction
from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.paper.scene import Arc, Item, Line, Point, Polygon
from dalembert.views.plane.elements import brake_symbols
from dalembert.views.plane.elements.belt_drawings import belt_items, rope_items, sheave_items
from dalembert.views.plane.elements.cam_symbol import cam_items
from dalembert.views.plane.elements.wedge_drawing import block_place, under_wedge
from dalembert.views.plane.outline import wheels
from dalembert.views.space.solids import Ring, RoundBar, Solid
from dalembert.views.symbols import plane_symbols
from dalembert.views.symbols.joint_solids import lift, wheel_solids

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


LONGEST_SCREW = 25.0
"""Greatest length at which a screw is drawn behind its nut, mm."""

RING, PAWL = 3.6, math.pi / 2
"""Least radius of a clutch on paper, mm, and the angle of a pawl to the axes of its link."""


class JointPlace(NamedTuple):
    """A joint to be drawn: its name, a position, a frame, and j's point in it."""

    r: Result
    name: str
    k: int
    frame: PaperFrame
    at: Point


class JointSymbol(NamedTuple):
    """Symbol of a type of joint.

    whole: between its two links; own: at its place in a link's free body; solid: type in space whose solids it uses, or
    a function from the metres per millimetre of a symbol to solids, each with the link whose axes it is in.
    """

    full: Callable[[JointPlace], list[Item]]
    free: Callable[[Point], list[Item]]
    solid: str | Callable[[Result, str, float], list[tuple[str, Solid]]]


def draw_joint(canvas: Canvas, r: Result, name: str, k: int, frame: PaperFrame) -> None:
    """The symbol of a joint."""
    joint: Any = r.mechanism.joints[name]
    at = frame(link_place(r, joint.links[1], r.mechanism.joint_points(name)[1])[k])
    canvas.add(*DRAWINGS[joint.type].full(JointPlace(r, name, k, frame, at)))


def free_symbol(joint_type: str, at: Point) -> list[Item]:
    """Symbol of a joint at its place in a free body."""
    return DRAWINGS[joint_type].free(at)


def _on_ground(s: JointPlace) -> bool:
    return GROUND in s.r.mechanism.joints[s.name].links


def _pin(s: JointPlace) -> list[Item]:
    return plane_symbols.fixed_pin(s.at) if _on_ground(s) else plane_symbols.pin(s.at)


def _along(s: JointPlace) -> float:
    e = slide_direction(s.r, s.name)[s.k]
    return math.atan2(float(e[1]), float(e[0]))


class CylinderSizes(NamedTuple):
    """Shortest and longest distance of a cylinder's pins, and the diameters of its barrel and rod, mm; 0 if unknown."""

    shortest: float
    longest: float
    wide: float = 0.0
    thick: float = 0.0


def cylinder_sizes(s: JointPlace) -> CylinderSizes | None:
    """A driven slide between pins of two links as a hydraulic cylinder; None for any other."""
    m = s.r.mechanism
    joint, driven = m.joints[s.name], {m.drives[d].joint or d: m.drives[d].cylinder for d in s.r.drives}
    if s.name not in driven or _on_ground(s) or not joint.guides:
        return None
    paths = [link_place(s.r, link, u) for link, u in zip(joint.links, m.joint_points(s.name), strict=True)]
    pinned = [
        any(
            other.hinge and link in other.links and _together(joint_place(s.r, name)[s.k], path[s.k], s)
            for name, other in m.joints.items()
        )
        for link, path in zip(joint.links, paths, strict=True)
    ]
    lengths = s.frame.length(1.0) * np.hypot(*(paths[1] - paths[0]).T)
    lengths = lengths[np.isfinite(lengths)]
    if not all(pinned) or float(lengths.min()) < 6.0:
        return None
    least, most, c = float(lengths.min()), float(lengths.max()), driven[s.name]
    if c is None:
        return CylinderSizes(least, most)
    if c.lengths:
        least, most = (s.frame.length(x) for x in c.lengths)
    return CylinderSizes(least, most, s.frame.length(c.barrel or c.bore), s.frame.length(c.rod or 0.0))


def _together(one: Array, other: Array, s: JointPlace) -> bool:
    return math.dist(s.frame(one), s.frame(other)) < 0.05


def _slider(s: JointPlace) -> list[Item]:
    if sizes := cylinder_sizes(s):
        both = zip(s.r.mechanism.joints[s.name].links, s.r.mechanism.joint_points(s.name), strict=True)
        base, end = (s.frame(link_place(s.r, link, u)[s.k]) for link, u in both)
        return plane_symbols.cylinder(base, end, *sizes)
    angle = _along(s)
    side = -1.0 if math.cos(angle) > -1e-9 else 1.0
    at = block_place(s.r, s.name, s.k, s.at)
    if at is None:
        return under_wedge(s.r, s.name, s.k, s.frame) if _on_ground(s) else []
    ground = plane_symbols.guide(at, angle, 13.0, side) if _on_ground(s) else []
    return [*driving_screw(s.r, s.name, s.frame, at, angle), *ground, *plane_symbols.slider(at, angle)]


def driving_screw(r: Result, name: str, frame: PaperFrame, at: Point, angle: float) -> list[Item]:
    """The screw that drives a slide, behind its nut, about as long as the nut moves; nothing where none does."""
    drives = r.mechanism.drives
    screw = next((drives[d].screw for d in r.drives if (drives[d].joint or d) == name), None)
    if screw is None:
        return []
    length = screw_length(r, name, frame)
    return plane_symbols.thread(at, angle, length, frame.length(screw.radius), frame.length(screw.advance))


def screw_length(r: Result, name: str, frame: PaperFrame) -> float:
    """Length of a screw on paper, mm: about as far as its nut moves."""
    moved = r.freedom(name, "slide")[0]
    return min(max(frame.length(float(np.nanmax(moved) - np.nanmin(moved))), 10.0), LONGEST_SCREW)


def _slot(s: JointPlace) -> list[Item]:
    """A slot as long as its slide over the cycle, with a little clearance."""
    values, angle = s.r.freedom(s.name, "slide")[0], _along(s)
    room = min(0.08 * s.r.compiled.layout.length, 12.0 * s.frame.per_mm)
    start = np.array(
        link_place(s.r, s.r.mechanism.joints[s.name].links[0], s.r.mechanism.joint_points(s.name)[0])[s.k]
    )
    e = slide_direction(s.r, s.name)[s.k]
    a, b = (
        s.frame(start + x * e) for x in (float(np.nanmin(values)) - room, float(np.nanmax(values)) + room)
    )
    middle, length = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2), math.dist(a, b)
    ground = plane_symbols.guide(middle, angle, length + 8.0) if _on_ground(s) else []
    return [*ground, *plane_symbols.slot(middle, angle, length), *plane_symbols.pin(s.at)]


def _arm(r: Result, name: str) -> Array:
    """Vector from the centre of a circular slot to its pin (P, 2), ground axes."""
    ends = zip(r.mechanism.joints[name].links, r.mechanism.joint_points(name), strict=True)
    center, at = (link_place(r, link, u) for link, u in ends)
    return np.asarray(at - center)


def _circular_slot(s: JointPlace) -> list[Item]:
    """A slot as long as the path of its pin over the cycle, with a little clearance."""
    joint: Any = s.r.mechanism.joints[s.name]
    radius, i = s.frame.length(joint.radius), joint.links[0]
    angle = np.arctan2(*_arm(s.r, s.name).T[::-1]) - link_angle(s.r, i)
    angles = np.unwrap(angle[np.isfinite(angle)])
    here, room = float(link_angle(s.r, i)[s.k]), 3.0 / radius
    low, high = here + float(angles.min()) - room, here + float(angles.max()) + room
    pin = float(angle[s.k]) + here
    middle = (s.at[0] - radius * math.cos(pin), s.at[1] - radius * math.sin(pin))
    return [
        *round_slot(middle, radius, low, min(high, low + 2 * math.pi), _on_ground(s)),
        *plane_symbols.pin(s.at),
    ]


def round_slot(middle: Point, radius: float, low: float, high: float, ground: bool) -> list[Item]:
    """A slot between two angles about its centre, round at its ends; strokes outside it on the ground."""
    half, angles = plane_symbols.PIN + 0.5, np.linspace(low, high, 2 + int((high - low) / 0.04))
    outside, inside = Arc(middle, radius + half, low, high), Arc(middle, max(radius - half, 0.0), low, high)
    ends = [Arc(middle, radius, low, high).at(t) for t in (low, high)]
    caps = Arc(ends[1], half, high, high + math.pi), Arc(ends[0], half, low + math.pi, low + 2 * math.pi)
    sides = [outside.at(t) for t in angles], [inside.at(t) for t in angles[::-1]]
    out: list[Item] = [Polygon((*sides[0], *caps[0].points, *sides[1], *caps[1].points), "block")]
    for t in np.arange(low, high, 1.5 / outside.radius) if ground else ():
        out.append(
            Line((outside.at(t), Arc(middle, outside.radius + 1.4, t, t).at(t - 1.2 / radius)), "hatch")
        )
    return out


def _circular_slot_solids(r: Result, name: str, size: float) -> list[tuple[str, Solid]]:
    """A ring on i, a peg of j through it."""
    joint: Any = r.mechanism.joints[name]
    (i, j), (ui, uj), up = joint.links, r.mechanism.joint_points(name), np.array([0.0, 0.0, 1.0])
    center, at = lift(r, i, ui, size), lift(r, j, uj, size)
    low, high = (np.array([*at[:2], f(center[2], at[2]) + x * size]) for f, x in ((min, -2.0), (max, 2.0)))
    return [(i, Ring(center, up, joint.radius, 0.9 * size)), (j, RoundBar(low, high, 0.9 * size, "inner"))]


def _cam_solids(r: Result, name: str, size: float) -> list[tuple[str, Solid]]:
    """A peg of j, instead of its roller, on the cam's plate."""
    joint: Any = r.mechanism.joints[name]
    at = lift(r, joint.links[1], r.mechanism.joint_points(name)[1], size)
    radius = joint.follower.roller or 0.9 * size
    up = np.array([0.0, 0.0, 2.0 * size])
    return [(joint.links[1], RoundBar(at - up, at + up, radius, "inner"))]


def _wheels(s: JointPlace) -> list[Item]:
    joint, out = s.r.mechanism.joints[s.name], []
    for link, center, radius in wheels(s.r, s.name, joint, s.k)[::-1]:
        angle = float(link_angle(s.r, link)[s.k])
        out += plane_symbols.wheel(s.frame(center), s.frame.length(radius), angle)
    if joint.wheels == 1:
        out += plane_symbols.hatch(s.frame(joint_place(s.r, s.name)[s.k]), _along(s), 22.0)
    return out


def _cam(s: JointPlace) -> list[Item]:
    return cam_items(s.r, s.name, s.k, s.frame)


def _clutch(s: JointPlace) -> list[Item]:
    """A ring about the axis with wedges that narrow in the sense in which j is free, or a wheel with teeth on j and a
    pawl on i."""
    joint: Any = s.r.mechanism.joints[s.name]
    on_i, on_j = (float(link_angle(s.r, link)[s.k]) for link in joint.links)
    if not joint.pitch:
        return plane_symbols.one_way(s.at, joint.way, on_j)
    return [*ratchet_wheel(joint, s.frame, s.at, on_j), *ratchet_pawl(joint, s.frame, s.at, on_i)]


def ratchet_wheel(joint: Any, frame: PaperFrame, at: Point, angle: float) -> list[Item]:
    """The wheel of a ratchet on j at an angle of j: one of its flanks is at the pawl where it holds."""
    radius, first = max(frame.length(joint.reach), RING), angle - joint.angle + PAWL
    return plane_symbols.ratchet(at, radius, round(joint.teeth), joint.way, first)


def ratchet_pawl(joint: Any, frame: PaperFrame, at: Point, angle: float) -> list[Item]:
    """Its pawl on i."""
    return plane_symbols.pawl(at, max(frame.length(joint.reach), RING), joint.way, angle + PAWL)


def _clutch_solids(r: Result, name: str, size: float) -> list[tuple[str, Solid]]:
    """A ring of i round the axis."""
    joint: Any = r.mechanism.joints[name]
    at = lift(r, joint.links[0], r.mechanism.joint_points(name)[0], size)
    return [(joint.links[0], Ring(at, np.array([0.0, 0.0, 1.0]), 3.6 * size, 0.9 * size))]


def _nothing(at: Point) -> list[Item]:
    """No symbol: wheels meet without a pin."""
    return []


def _no_solids(r: Result, name: str, size: float) -> list[tuple[str, Solid]]:
    """None: a lining is thin."""
    return []


DRAWINGS: dict[str, JointSymbol] = {
    "pin": JointSymbol(_pin, plane_symbols.pin, "revolute"),
    "slider": JointSymbol(_slider, plane_symbols.pin, "prismatic"),
    "slot": JointSymbol(_slot, plane_symbols.pin, "slotted_cylinder"),
    "circular_slot": JointSymbol(_circular_slot, plane_symbols.pin, _circular_slot_solids),
    "weld": JointSymbol(lambda s: plane_symbols.weld(s.at), plane_symbols.weld, "weld"),
    "belt": JointSymbol(lambda s: belt_items(s.r, s.name, s.k, s.frame), _nothing, wheel_solids),
    "strand": JointSymbol(lambda s: rope_items(s.r, s.name, s.k, s.frame), _nothing, wheel_solids),
    "sheave": JointSymbol(lambda s: sheave_items(s.r, s.name, s.k, s.frame), plane_symbols.pin, "revolute"),
    "gear": JointSymbol(_wheels, _nothing, wheel_solids),
    "one_way": JointSymbol(_clutch, _nothing, _clutch_solids),
    "ratchet": JointSymbol(_clutch, _nothing, _clutch_solids),
    "rolling": JointSymbol(_wheels, _nothing, wheel_solids),
    "cam": JointSymbol(_cam, _nothing, _cam_solids),
    "shoe": JointSymbol(brake_symbols.shoe, _nothing, _no_solids),
    "band": JointSymbol(brake_symbols.band, _nothing, _no_solids),
    "disc": JointSymbol(brake_symbols.faces, _nothing, _no_solids),
    "cone": JointSymbol(brake_symbols.faces, _nothing, _no_solids),
}
"""Type of joint -> its symbols."""
