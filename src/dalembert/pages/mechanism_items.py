"""Links, joints, springs, mass centres and traces of planar mechanisms as items that follow the kernel's rows.

Rigid items are drawn once by the views' symbols about the origin, and placed by the rows of a point (``p``) and of a
direction (``e``); a hull follows several points, a span two.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from dalembert.analysis.compile.elements.brake_contacts import seat
from dalembert.analysis.compile.elements.cam_motion import outline
from dalembert.analysis.friction.joint_friction import bearing_contact, friction_circle_radius
from dalembert.analysis.methods.applied_forces import joint_place, link_angle, link_place
from dalembert.analysis.result.result import Result
from dalembert.arrays import Array, Numeric, Tree
from dalembert.core.friction.contact_equations import strength
from dalembert.model import GROUND, Mechanism
from dalembert.pages.elements.wheel_items import belt, strand, wheels
from dalembert.pages.rows import NodeRows
from dalembert.pages.symbolic_result import SymbolicResult
from dalembert.views.formats.svg import Writer
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.paper.scene import Item, Polygon
from dalembert.views.plane.elements.cam_symbol import resting_follower
from dalembert.views.plane.elements.turning_axis import BEYOND, axis_ends, ball, is_ball
from dalembert.views.plane.elements.wedge_drawing import wedge_corners
from dalembert.views.plane.joint_drawings import (
    DRAWINGS,
    CylinderSizes,
    JointPlace,
    cylinder_sizes,
    driving_screw,
    ratchet_pawl,
    ratchet_wheel,
    round_slot,
    screw_length,
)
from dalembert.views.plane.outline import link_paths
from dalembert.views.symbols import plane_symbols

SPAN = 20.0
"""Length in mm at which springs and dampers are drawn; the page stretches them."""


def of(kind: str, name: str, items: Sequence[Tree]) -> list[Tree]:
    """Items with what they are part of: a kind ("link", "joint", "load", "center") and a name."""
    return [{**one, "of": [kind, name]} for one in items]


@dataclass
class Items:
    """Draws parts of a mechanism: ``r`` in nodes, ``known`` the same in the file's numbers, both of one structure."""

    r: SymbolicResult
    known: Result
    rows: NodeRows
    frame: PaperFrame
    roles: set[str] = field(default_factory=set)
    _corners: dict[str, list[list[int]]] = field(default_factory=dict, init=False)

    @property
    def mechanism(self) -> Mechanism:
        return self.r.mechanism

    def markup(self, items: Sequence[Item]) -> str:
        """SVG of symbols about the origin."""
        writer = Writer(0.0, 0.0, "l")
        out = "".join(map(writer.item, items))
        self.roles |= writer.roles
        return out

    def symbol(
        self, items: Sequence[Item], at: list[int], along: list[int] | None = None, sized: bool = False
    ) -> Tree:
        """A symbol at a place, along a direction; ``sized``: its lengths are those of the machine."""
        more: Tree = {"e": along} if along else {}
        more |= {"per_mm": self.frame.per_mm} if sized else {}
        return {"t": "symbol", "svg": self.markup(items), "p": at} | more

    def path(self, kind: str, role: str, points: list[list[int]], **more: object) -> Tree:
        self.roles.add(role)
        return {"t": kind, "role": role, "p": points} | more

    def corners(self, link: str) -> list[list[int]]:
        """Rows of the points that a link's shape connects, each once."""
        if link not in self._corners:
            self._corners[link] = [list(p) for p in dict.fromkeys(map(tuple, self.outline(link)))]
        return [*self._corners[link]]

    def outline(self, link: str) -> list[list[int]]:
        """Rows of the points that a link's shape connects."""
        return [self.rows.vector(path[0]) for path in link_paths(self.r, link).values()]

    def link(self, link: str) -> list[Tree]:
        """A link's outline, or a line from its only joint to its mass centre; rails of blocks on it."""
        out, points = [], self.corners(link)
        if len(points) == 1 and self.known.mechanism.mass(link):
            points.append(self.rows.place(link, self.mechanism.center(link)))
        for name, joint in self.mechanism.joints.items():
            if joint.guides and joint.links[0] == link and not self.cylinder(name):
                both = zip(joint.links, self.mechanism.joint_points(name), strict=True)
                out.append(self.path("path", "link", [self.rows.place(n, u) for n, u in both]))
        self.roles |= {"link-area"}
        corners = wedge_corners(self.known, link) if self.known._d == 2 else None
        if corners is not None:
            points = [self.rows.place(link, u.tolist()) for u in corners]
        out.append(self.path("hull", "link", points, link=link))
        if self.known._d == 2 and is_ball(self.known.mechanism, link):
            out.append(self.symbol(ball((0, 0)), self.rows.place(link, self.mechanism.center(link))))
        return out

    def cylinder(self, name: str) -> CylinderSizes | None:
        """Sizes of a slide that is drawn as a cylinder; None for any other."""
        if self.known._d == 3:
            return None
        k = int(np.argmax(np.isfinite(self.known.point_array).all(axis=(1, 2))))
        return cylinder_sizes(JointPlace(self.known, name, k, self.frame, (0.0, 0.0)))

    def spans(self) -> list[Tree]:
        """Springs and dampers between their two points."""
        out = []
        for name, load in self.mechanism.loads_on("span").items():
            ends = [(link, self.rows.place(link, u)) for link, u in self.mechanism.load_points(name)]
            svg = self.markup(plane_symbols.SPANS[load.type]((0.0, 0.0), (SPAN, 0.0)))
            mine: list[Tree] = [{"t": "span", "svg": svg, "length": SPAN, "p": [at for _, at in ends]}]
            for link, at in ends:
                fixed = link == GROUND
                mine.append(
                    self.symbol((plane_symbols.fixed_pin if fixed else plane_symbols.pin)((0, 0)), at)
                )
            out += of("load", name, mine)
        return out

    def axis(self) -> list[Tree]:
        """The axis of a plane that turns, over the cycle."""
        beyond = BEYOND * self.frame.per_mm
        ends = axis_ends(self.known, slice(None), beyond) if self.known._d == 2 else None
        rows = [self.rows.place(GROUND, tuple(end.tolist())) for end in ends or ()]
        return [self.path("path", "pitch", rows)] if rows else []

    def turns(self) -> list[Tree]:
        """Springs and dampers in the turn of a joint."""
        loads = self.mechanism.loads_on("turn").items()
        return [
            x
            for name, load in loads
            for x in of(
                "load", name, [self.symbol(plane_symbols.TURNS[load.type]((0.0, 0.0)), self.at(load.joint))]
            )
        ]

    def joint(self, name: str, link: str | None = None) -> list[Tree]:
        """A joint's symbol; with ``link``, on that link's free body, without the ground."""
        joint = self.mechanism.joints[name]
        if link is not None and joint.apart and not joint.outlined and link != joint.links[1]:
            return []
        return SYMBOLS[joint.type](self, name, link)

    def at(self, name: str) -> list[int]:
        """Rows of j's point of a joint."""
        return self.rows.place(self.mechanism.joints[name].links[1], self.mechanism.joint_points(name)[1])

    def center(self, link: str) -> list[Tree]:
        """A mass centre, where there is mass."""
        if not self.known.mechanism.mass(link):
            return []
        return [
            self.symbol(plane_symbols.mass_center((0, 0)), self.rows.place(link, self.mechanism.center(link)))
        ]

    def traces(self) -> list[Tree]:
        """Paths of moving joints over the cycle."""
        out = []
        for name, joint in self.mechanism.joints.items():
            if not (GROUND in joint.links and joint.hinge):
                out.append(self.path("trace", "trace", [self.at(name)], of=["trace", name]))
        return out

    def circles(self, joints: Sequence[str]) -> list[Tree]:
        """Friction circles to scale."""
        out = []
        for name in joints:
            radius = self.circle_radius(name)
            if radius is not None:
                self.roles.add("friction-circle")
                at = self.rows.vector(joint_place(self.r, name)[0])
                out += of(
                    "joint",
                    name,
                    [{"t": "circle", "role": "friction-circle", "p": at, "r": self.rows.of(radius)}],
                )
        return out

    def circle_radius(self, name: str) -> Numeric | None:
        """Radius of a pin's friction circle, a node; None without."""
        contacts = self.r.compiled.contacts
        if contacts is None or not friction_circle_radius(self.known, name):
            return None
        return strength(contacts, 1.0)[bearing_contact(self.known, name, "pin")]


def _pin(d: Items, name: str, link: str | None) -> list[Tree]:
    fixed = link is None and GROUND in d.mechanism.joints[name].links
    return [d.symbol((plane_symbols.fixed_pin if fixed else plane_symbols.pin)((0, 0)), d.at(name))]


def _slider(d: Items, name: str, link: str | None) -> list[Tree]:
    e, at, out = d.rows.direction(name), d.at(name), []
    if sizes := d.cylinder(name):
        return _cylinder(d, name, link, sizes)
    joint = d.mechanism.joints[name]
    if link is None and GROUND in joint.links:
        out.append(d.symbol(plane_symbols.guide((0, 0), 0.0, 13.0), at, e))
    if screw := driving_screw(d.known, name, d.frame, (0, 0), 0.0):
        out.insert(0, d.symbol(screw, at, e, sized=True))
        back = -screw_length(d.known, name, d.frame) * d.frame.per_mm
        end = joint_place(d.r, name)[0] + back * np.array(d.rows.direction_nodes(name))
        out.insert(0, d.symbol([], d.rows.vector(end)))  # room for it
    if wedge_corners(d.known, joint.links[1]) is not None:
        return out
    return [*out, d.symbol(plane_symbols.slider((0, 0), 0.0), at, e)]


def _cylinder(d: Items, name: str, link: str | None, sizes: CylinderSizes) -> list[Tree]:
    """Barrel on i and piston with its rod on j, to scale."""
    least, most, wide, thick = sizes
    half, e = plane_symbols.barrel_half(least, wide), d.rows.direction(name)
    i, u = d.mechanism.joints[name].links[0], d.mechanism.joint_points(name)[0]
    rod = plane_symbols.piston_rod((0, 0), 0.0, plane_symbols.rod_length(least, most), half, thick)
    moved = [d.symbol(rod, d.at(name), e, sized=True)]
    if link is not None:
        return moved
    return [
        d.symbol(plane_symbols.barrel((0, 0), 0.0, least, half), d.rows.place(i, u), e, sized=True),
        *moved,
    ]


def _slot(d: Items, name: str, link: str | None) -> list[Tree]:
    """A slot as long as its slide over the file's cycle, with a little clearance."""
    joint, pin = d.mechanism.joints[name], d.symbol(plane_symbols.pin((0, 0)), d.at(name))
    if link is not None:
        return [pin]
    low, high = _span(d.known.freedom(name, "slide")[0])
    room = min(0.08 * d.known.compiled.layout.length, 12.0 * d.frame.per_mm)
    length, middle = d.frame.length(high - low + 2 * room), d.frame.length((high + low) / 2)
    ground = plane_symbols.guide((middle, 0), 0.0, length + 8.0) if GROUND in joint.links else []
    start = d.rows.place(joint.links[0], d.mechanism.joint_points(name)[0])
    items = [*ground, *plane_symbols.slot((middle, 0), 0.0, length)]
    return [d.symbol(items, start, d.rows.direction(name), sized=True), pin]


def _span(values: Array) -> tuple[float, float]:
    known = values[np.isfinite(values)]
    return (float(known.min()), float(known.max())) if known.size else (0.0, 0.0)


def _circular_slot(d: Items, name: str, link: str | None) -> list[Tree]:
    """A slot as long as the path of its pin over the file's cycle, in the axes of its link."""
    pin = d.symbol(plane_symbols.pin((0, 0)), d.at(name))
    if link is not None:
        return [pin]
    m = d.known.mechanism
    joint: Any = m.joints[name]
    ends = [link_place(d.known, n, u) for n, u in zip(joint.links, m.joint_points(name), strict=True)]
    angle = np.arctan2(*(ends[1] - ends[0]).T[::-1]) - link_angle(d.known, joint.links[0])
    low, high = _span(np.unwrap(angle[np.isfinite(angle)]))
    radius = d.frame.length(joint.radius)
    room = 3.0 / radius
    items = round_slot(
        (0.0, 0.0), radius, low - room, min(high + room, low - room + 2 * math.pi), GROUND in joint.links
    )
    start = d.rows.place(joint.links[0], d.mechanism.joint_points(name)[0])
    return [d.symbol(items, start, d.rows.axis(joint.links[0]), sized=True), pin]


def _weld(d: Items, name: str, link: str | None) -> list[Tree]:
    return [d.symbol(plane_symbols.weld((0, 0)), d.at(name))]


def _cam(d: Items, name: str, link: str | None) -> list[Tree]:
    """The outline in the axes of the cam, and what touches it in those of the follower."""
    m, points = d.known.mechanism, d.mechanism.joint_points(name)
    i, j = m.joints[name].links
    out = []
    if link in (None, i):
        edge = outline(m, name)
        shape: list[Item] = [Polygon(tuple(map(PaperFrame(d.frame.per_mm), edge)), "link-area")]
        out.append(d.symbol(shape, d.rows.place(i, points[0]), d.rows.axis(i), sized=True))
        corners = [edge[int(np.argmax(edge @ e))] for e in ((1, 0), (0, 1), (-1, 0), (0, -1))]
        out += [
            d.symbol([], d.rows.place(i, tuple(np.add(points[0], u).tolist()))) for u in corners
        ]  # room for it
    if link in (None, j):
        out.append(d.symbol(resting_follower(d.known, name, d.frame), d.at(name), d.rows.axis(j), sized=True))
    return out


def _brake(d: Items, name: str, link: str | None) -> list[Tree]:
    """The drum or the outer edge of the faces about its axis, with a spoke that shows its turn."""
    joint: Any = d.mechanism.joints[name]
    i, j = joint.links
    if link == j != GROUND:
        return []
    at = d.rows.place(i, d.mechanism.joint_points(name)[0])
    turning = i if i != GROUND else j
    wheel = plane_symbols.wheel((0, 0), d.frame.length(float(d.known.mechanism.joints[name].reach)), 0.0)
    shown = [d.symbol(wheel, at, d.rows.axis(turning), sized=True)]
    linings = _linings(d, name) if link is None else []
    return [*shown, d.symbol(linings, at, sized=True)] if linings else shown


def _linings(d: Items, name: str) -> list[Item]:
    """Lining, band or faces of a brake that the ground carries, about the drum's axis at the first solved position."""
    m, closed = d.known.mechanism, seat(d.known.mechanism, name)
    if closed is not None and closed.carrier != GROUND:
        return []
    k = int(np.argmax(np.isfinite(d.known.point_array).all(axis=(1, 2))))
    (i, j), (u, v) = m.joints[name].links, m.joint_points(name)
    x, y = link_place(d.known, i, u)[k].tolist()
    frame = PaperFrame(d.frame.per_mm, (x, y))
    place = JointPlace(d.known, name, k, frame, frame(link_place(d.known, j, v)[k]))
    drawn = DRAWINGS[m.joints[name].type].full(place)
    return [item for item in drawn if getattr(item, "role", "") in ("block", "journal", "hatch")]


def _clutch(d: Items, name: str, link: str | None) -> list[Tree]:
    joint: Any = d.mechanism.joints[name]
    on_i, on_j = (d.rows.axis(one) for one in joint.links)
    if link is not None:
        return []
    if not joint.pitch:
        return [d.symbol(plane_symbols.one_way((0, 0), joint.way, 0.0), d.at(name), on_j)]
    known: Any = d.known.mechanism.joints[name]
    wheel, pawl = (draw(known, d.frame, (0, 0), 0.0) for draw in (ratchet_wheel, ratchet_pawl))
    return [d.symbol(wheel, d.at(name), on_j, sized=True), d.symbol(pawl, d.at(name), on_i, sized=True)]


SYMBOLS: dict[str, Callable[[Items, str, str | None], list[Tree]]] = {
    "pin": _pin,
    "slider": _slider,
    "slot": _slot,
    "circular_slot": _circular_slot,
    "weld": _weld,
    "belt": belt,
    "strand": strand,
    "sheave": _pin,
    "gear": wheels,
    "one_way": _clutch,
    "ratchet": _clutch,
    "rolling": wheels,
    "cam": _cam,
    "shoe": _brake,
    "band": _brake,
    "disc": _brake,
    "cone": _brake,
}
"""Type of joint -> its items; as ``views.plane.joint_drawings.DRAWINGS``."""
