"""Symbols of the joints in space, as solids in the joint's axes about its point: the part on i and the part on j.

To add a joint, add its symbol to ``SYMBOLS``. Lengths are in millimetres of paper; ``reach`` is the travel of a slide.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array
from dalembert.views.space.solids import Ball, Block, GlassTube, Pane, Ring, RoundBar, Solid, Wire

X, Y, Z = np.eye(3)
BALL = 2.2


class Symbol(NamedTuple):
    """Solids on link i and on link j, and the radius around the joint's point within which no link is drawn."""

    on_i: list[Solid]
    on_j: list[Solid]
    clear: float


@dataclass(frozen=True)
class SymbolSetting:
    """Data of a symbol: directions to the links (unit vectors in the joint's axes), and travel of the slides.

    ``low`` and ``high``: ends of each slide along x, y, z from i's point, mm.
    """

    to_i: Array = field(default_factory=lambda: -Z)
    to_j: Array = field(default_factory=lambda: X)
    low: Array = field(default_factory=lambda: np.zeros(3))
    high: Array = field(default_factory=lambda: np.zeros(3))
    blocked: str = "x"
    hand: float = 1.0


def symbol(kind: str, setting: SymbolSetting | None = None) -> Symbol:
    """The symbol of a kind of joint."""
    return SYMBOLS[kind](setting or SymbolSetting())


def _cylinder(along: Array, half: float, radius: float, role: str, sleeve: bool = False) -> RoundBar:
    return RoundBar(-half * along, half * along, radius, role, sleeve)


def _through(along: Array, start: float, end: float, radius: float, role: str) -> list[Solid]:
    """A bar that runs through a sleeve: both ends and the middle, so that the sleeve covers no more than that."""
    cuts = (-end, -start, start, end)
    return [RoundBar(a * along, b * along, radius, role) for a, b in pairwise(cuts)]


def _block(
    half: tuple[float, float, float], role: str, middle: Array | None = None, sleeve: bool = False
) -> Block:
    return Block(np.zeros(3) if middle is None else middle, np.eye(3), np.array(half), role, sleeve)


def _rails(s: SymbolSetting, beyond: float = 5.0) -> tuple[float, float]:
    """Ends of the rails of a slide along x."""
    return float(s.low[0]) - beyond, float(s.high[0]) + beyond


def _weld(s: SymbolSetting) -> Symbol:
    return Symbol([_block((1.3, 1.3, 1.3), "outer")], [], 1.2)


def _revolute(s: SymbolSetting) -> Symbol:
    return Symbol([_cylinder(Z, 2.0, 1.9, "outer", sleeve=True)], _through(Z, 2.0, 3.4, 0.9, "inner"), 1.8)


def _prismatic(s: SymbolSetting) -> Symbol:
    low, high = _rails(s)
    middle, half = np.array([(low + high) / 2, 0, 0]), (high - low) / 2
    return Symbol(
        [_block((half, 0.8, 0.8), "outer", middle)], [_block((3.2, 2.0, 2.0), "inner", sleeve=True)], 1.9
    )


def _cylindrical(s: SymbolSetting) -> Symbol:
    low, high = _rails(s)
    rail = RoundBar(low * X, high * X, 0.9, "outer")
    return Symbol([rail], [_cylinder(X, 3.0, 2.1, "inner", sleeve=True)], 2.0)


def _screw(s: SymbolSetting) -> Symbol:
    """A nut on i, a threaded spindle on j."""
    half = max(7.0, float(s.high[0] - s.low[0]) / 2 + 6.0)
    spindle = RoundBar(-half * X, half * X, 1.2, "inner", thread=2.0 * s.hand)
    return Symbol([_block((2.4, 2.2, 2.2), "outer", sleeve=True)], [spindle], 2.0)


def _fork(pin: Array, to: Array, role: str, half: float, base: float) -> list[Solid]:
    """A pin with two arms that lead towards its link."""
    away = to - (to @ pin) * pin
    size = float(np.linalg.norm(away))
    away = away / size if size > 0.2 else np.cross(pin, X if abs(pin[0]) < 0.9 else Y)
    ends = [half * pin, -half * pin]
    arms: list[Solid] = [RoundBar(end, end + base * away, 0.5, role) for end in ends]
    return [
        _cylinder(pin, half, 0.7, role),
        *arms,
        RoundBar(ends[0] + base * away, ends[1] + base * away, 0.5, role),
    ]


def _universal(s: SymbolSetting) -> Symbol:
    """A cross whose pins y and z are in the forks of i and of j."""
    return Symbol(_fork(Y, s.to_i, "outer", 2.8, 4.4), _fork(Z, s.to_j, "inner", 2.8, 4.4), 4.4)


def _socket(to: Array) -> list[Solid]:
    return [RoundBar(0.5 * BALL * to, (BALL + 0.9) * to, 0.95 * BALL, "outer")]


def _spherical(s: SymbolSetting) -> Symbol:
    return Symbol(_socket(s.to_i), [Ball(np.zeros(3), BALL, "inner")], BALL)


def _square(s: SymbolSetting, at: float, beyond: float) -> Array:
    """Corners of a rectangle across x that holds slides along y and z."""
    (_, y0, z0), (_, y1, z1) = s.low - beyond, s.high + beyond
    return np.array([[at, y0, z0], [at, y1, z0], [at, y1, z1], [at, y0, z1]])


def _plane(s: SymbolSetting) -> Symbol:
    floor = _square(s, 0.0, 5.5)
    middle, half = floor.mean(axis=0) - 0.5 * X, (floor[2] - floor[0]) / 2
    return Symbol(
        [_block((0.5, float(half[1]), float(half[2])), "outer", middle)],
        [_block((0.8, 2.4, 2.4), "inner", 0.8 * X)],
        1.0,
    )


def _panes(s: SymbolSetting, distance: float, beyond: float = 4.5) -> list[Solid]:
    return [Pane(_square(s, sign * distance, beyond)) for sign in (-1.0, 1.0)]


def _sphere_between_planes(s: SymbolSetting) -> Symbol:
    return Symbol(_panes(s, BALL), [Ball(np.zeros(3), BALL, "inner")], BALL)


def _tube(s: SymbolSetting) -> Solid:
    low, high = _rails(s, 5.0)
    return GlassTube(low * X, high * X, BALL + 0.3)


def _sphere_in_cylinder(s: SymbolSetting) -> Symbol:
    return Symbol([_tube(s)], [Ball(np.zeros(3), BALL, "inner")], BALL)


def _cylinder_between_planes(s: SymbolSetting) -> Symbol:
    return Symbol(_panes(s, 1.8, 5.5), [_cylinder(Z, 4.0, 1.8, "inner")], 1.8)


def _turning(s: SymbolSetting) -> tuple[Array, Array]:
    """Axes about which a slotted sphere turns: the first fixed in i, the second in j."""
    k = "xyz".index(s.blocked)
    return np.eye(3)[(k + 1) % 3], np.eye(3)[(k + 2) % 3]


def _slotted_sphere(s: SymbolSetting) -> Symbol:
    """A peg on the ball stays in a slot of the socket: the plane across the first axis."""
    first, peg = _turning(s)
    t = np.linspace(-1.1, 1.1, 17)[:, None]
    side = np.cross(first, peg)
    arc = (BALL + 0.6) * (np.cos(t) * peg + np.sin(t) * side)
    return Symbol([*_socket(s.to_i), *_slot_edges(arc, first)], _pegged_ball(peg), BALL)


def _slot_edges(middle: Array, first: Array) -> list[Solid]:
    return [Wire(middle + lift * first) for lift in (-0.7, 0.7)]


def _pegged_ball(peg: Array) -> list[Solid]:
    return [Ball(np.zeros(3), BALL, "inner"), RoundBar(BALL * peg, (BALL + 2.2) * peg, 0.5, "inner")]


def _torus(s: SymbolSetting) -> Symbol:
    """A ring about y on i; j turns in it about y and about z."""
    ring = Ring(np.zeros(3), Y, 3.2, 0.6, "outer")
    return Symbol([ring], [_cylinder(Z, 2.3, 1.1, "inner")], 1.1)


def _slotted_cylinder(s: SymbolSetting) -> Symbol:
    """A pin along z in a slot along x."""
    low, high = _rails(s, 3.4)
    middle, half = (low + high) / 2 * X, (high - low) / 2
    sides = [_block((half, 0.5, 0.7), "outer", middle + sign * 1.6 * Y) for sign in (-1.0, 1.0)]
    ends = [_block((0.5, 1.1, 0.7), "outer", (x + sign * 0.5) * X) for x, sign in ((low, 1.0), (high, -1.0))]
    return Symbol([*sides, *ends], [_cylinder(Z, 3.2, 1.0, "inner")], 1.0)


def _slotted_sphere_in_cylinder(s: SymbolSetting) -> Symbol:
    low, high = _rails(s, 5.0)
    first, peg = _turning(s)
    slot = np.array([low * X, high * X]) + (BALL + 0.3) * peg
    return Symbol([_tube(s), *_slot_edges(slot, first)], _pegged_ball(peg), BALL)


SYMBOLS: dict[str, Callable[[SymbolSetting], Symbol]] = {
    "weld": _weld,
    "revolute": _revolute,
    "prismatic": _prismatic,
    "screw": _screw,
    "cylindrical": _cylindrical,
    "universal": _universal,
    "spherical": _spherical,
    "plane": _plane,
    "sphere_between_planes": _sphere_between_planes,
    "sphere_in_cylinder": _sphere_in_cylinder,
    "cylinder_between_planes": _cylinder_between_planes,
    "slotted_sphere": _slotted_sphere,
    "torus": _torus,
    "slotted_cylinder": _slotted_cylinder,
    "slotted_sphere_in_cylinder": _slotted_sphere_in_cylinder,
}
"""Kind of joint -> its symbol: cylinders that turn, blocks that slide, a ball, a cross, a thread, a plate, a slot."""
