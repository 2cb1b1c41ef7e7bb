"""Velocity and acceleration polygons with the images of the links, lettered as in the lecture notes."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

import numpy as np

from dalembert.analysis.methods.applied_forces import link_place
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.arrays import Array
from dalembert.errors import AnalysisError, ModelError
from dalembert.model import GROUND
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import force_scale
from dalembert.views.paper.lettering import unbroken
from dalembert.views.paper.scene import Arrow, Circle, Line, Point, Polygon, Scene, along
from dalembert.views.plane.mechanism_view import unit_size
from dalembert.views.plane.motion_points import PointLabel, Rates, rates, spots
from dalembert.views.plane.outline import convex

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

Order = Literal["velocity", "acceleration"]

LONGEST = 50.0
"""Largest vector from the pole, mm."""

MOST = 14
"""Number of joints' points on links up to which vectors have their values beside them."""


def stands_still(r: Result, k: int) -> bool:
    """True if no drive moves at a position."""
    return not (r.schedule.speed[k].any() or r.schedule.acceleration[k].any())


def motion_polygon_scene(
    r: Result, k: int, order: Order, notation: Notation | None = None, drive: int | None = None
) -> Scene:
    """Velocities (or accelerations) of points from one pole; between points of one link what one has relative to the
    other, of accelerations the normal, tangential and Coriolis parts dashed; each link has its image.

    Where no drive moves, velocities for unit speed of a ``drive`` (the first), the others held.
    """
    shown = Shown(r, notation or Notation(), k)
    if drive is None and stands_still(r, k):
        if order == "acceleration":
            remedy = "give a drive a speed, or draw the velocity polygon: it is for unit speed then"
            raise ModelError(f"accelerations need a motion, and no drive moves at position {k + 1}", remedy)
        drive = 0
    motion = rates(r, k, drive)
    points = spots(r, k, shown)
    read = motion.velocity if order == "velocity" else motion.acceleration
    vectors = {link: {s.sign: read(link, s.u) for s in some} for link, some in points.items()}
    if not all(np.isfinite(v).all() for some in vectors.values() for v in some.values()):
        what = "velocities" if order == "velocity" else "accelerations"
        raise AnalysisError(f"position {k + 1} has no {what}: {r.reasons[k]}")
    unit, notes = 1.0, []
    if drive is not None:
        kind = "angle" if drive_kinds(r, r.drives[drive])["effort"] == "moment" else "length"
        unit = 1.0 if kind == "angle" else shown.size("length")
        speed = "1 rad/s" if kind == "angle" else f"1 {shown.unit('length')}/s"
        others = ", the other drives held" if len(r.drives) > 1 else ""
        notes.append(
            f"For {speed} of drive {r.drives[drive]}{others}; where it moves otherwise, in proportion."
        )
        vectors = {link: {sign: v * unit for sign, v in some.items()} for link, some in vectors.items()}
    sizes = [math.hypot(*v) for some in vectors.values() for v in some.values()]
    per_mm = force_scale(sizes, LONGEST, unit_size(r, kind_of(order), shown.notation))
    return _Polygon(r, k, order, shown, motion, points, vectors, per_mm, unit).scene(notes)


def kind_of(order: Order) -> str:
    """Kind of unit of a polygon's vectors."""
    return "speed" if order == "velocity" else "acceleration"


@dataclass
class _Polygon:
    """A polygon under construction."""

    r: Result
    k: int
    order: Order
    shown: Shown
    motion: Rates
    points: dict[str, list[PointLabel]]
    vectors: dict[str, dict[str, Array]]
    per_mm: float
    unit: float
    canvas: Canvas = field(default_factory=Canvas)
    listed: list[str] = field(default_factory=list)

    def scene(self, notes: list[str]) -> Scene:
        """Images, then arrows from the pole, then sides, letters, and the list below."""
        velocity, kind = self.order == "velocity", kind_of(self.order)
        self._images()
        self._letters()
        self._rays()
        for link, some in self.points.items():
            self._sides(link, [s for s in some if s.joint])
        word = "Velocities" if velocity else "Accelerations"
        notes = [f"{word}: 1 mm = {self.shown.plain(kind, self.per_mm)}", *notes, self._turns()]
        notes += [", ".join(unbroken(text) for text in self.listed)] if self.listed else []
        return self.canvas.scene(
            f"{self.order.capitalize()} polygon",
            notes=notes,
            scales={self.order: self.per_mm},
            least=150.0 if len(self.listed) > 12 else 80.0,
        )

    def head(self, vector: Array) -> Point:
        """Head of a vector from the pole, mm."""
        return float(vector[0]) / self.per_mm, float(vector[1]) / self.per_mm

    def _images(self) -> None:
        for link in self.points:
            corners = convex(list({self.head(v) for v in self.vectors[link].values()}))
            if len(corners) >= 3:
                self.canvas.add(Polygon(tuple(corners), "image"))
            elif len(corners) == 2:
                self.canvas.add(Line(tuple(corners), "trace"))

    def _rays(self) -> None:
        """Absolute vectors: of joints with their value beside them, of other points the value below."""
        labelled: set[str] = set()
        for link, some in self.points.items():
            for s in some:
                vector = self.vectors[link][s.sign]
                head, size = self.head(vector), math.hypot(*vector)
                if s.sign in labelled or math.hypot(*head) < 0.1:
                    continue
                labelled.add(s.sign)
                name = f"{self.order[0]}_{{{flat(s.sign)}}}"
                text = f"{name} = {self.shown.text(kind_of(self.order), size)}"
                beside, role = (text, "") if s.joint else ("", "-part")
                self._arrow((0.0, 0.0), head, s.sign, size, beside, role)
                self.listed += [] if s.joint else [text]

    def _arrow(self, tail: Point, head: Point, of: str, size: float, text: str, role: str = "") -> None:
        """An arrow with its value beside it, or below if there are too many."""
        self.canvas.add(Arrow(tail, head, self.order + role, of, self.order, size))
        if text and sum(s.joint for some in self.points.values() for s in some) > MOST:
            self.listed += [text] if " = " in text else []
            return
        self.canvas.label(text, *along(tail, head, 0.55, 0.4, 0.7), size=2.6, role=self.order)

    def _sides(self, link: str, some: list[PointLabel]) -> None:
        """Sides from the link's fixed point, or its first joint, to its other points; then across its sliders."""
        if not some:
            return
        still = next((s for s in some if math.hypot(*self.head(self.vectors[link][s.sign])) < 0.1), None)
        base = still or some[0]
        for s in some:
            if s is not base:
                self._side(link, base, s, still is not None)
            if s.sliding:
                self._slide(link, s)

    def _side(self, link: str, base: PointLabel, end: PointLabel, fixed: bool) -> None:
        """Velocity or acceleration of a point relative to another of its link, with normal and tangential parts."""
        start, difference = (
            self.vectors[link][base.sign],
            self.vectors[link][end.sign] - self.vectors[link][base.sign],
        )
        sign = f"{self.order[0]}_{{{flat(end.sign) if fixed else relative(end.sign, base.sign)}}}"
        if not fixed:
            self._vector(start, difference, sign)
        if self.order == "acceleration":
            span = link_place(self.r, link, end.u)[self.k] - link_place(self.r, link, base.u)[self.k]
            normal = -(self.motion.spin(link) ** 2) * span
            self._parts(start, ((f"{sign}^{{n}}", normal), (f"{sign}^{{t}}", difference - normal)))

    def _slide(self, rail: str, s: PointLabel) -> None:
        """Velocity or acceleration of the slider relative to the point under it; for accelerations the Coriolis
        component and the one along the slide."""
        i, j = self.r.mechanism.joints[s.sliding].links
        over = i if rail == j else j
        if over == GROUND:
            start, end = self.vectors[rail][s.sign], np.zeros(2)
            sign, name = "", "o"
        else:
            name = s.sign.partition("_{")[0]
            sign = name if name in self.vectors[over] else next(iter(self.vectors[over]))
            start, end = self.vectors[rail][s.sign], self.vectors[over][sign]
        letter = f"{self.order[0]}_{{{relative(name, s.sign)}}}"
        self._vector(start, end - start, letter)
        if self.order == "acceleration" and sign:
            u = next(spot.u for spot in self.points[over] if spot.sign == sign)
            vx, vy = self.motion.velocity(over, u) - self.motion.velocity(rail, s.u)
            coriolis = 2 * self.motion.spin(rail) * np.array([-vy, vx])
            self._parts(start, ((f"{letter}^{{c}}", coriolis), (f"{letter}^{{s}}", end - start - coriolis)))

    def _vector(self, start: Array, vector: Array, sign: str) -> None:
        size = math.hypot(*vector)
        if size / self.per_mm > 0.3:
            text = f"{sign} = {self.shown.text(kind_of(self.order), size)}"
            self._arrow(self.head(start), self.head(start + vector), sign, size, text)

    def _parts(self, start: Array, parts: tuple[tuple[str, Array], ...]) -> None:
        """Dashed sides one after the other, with their values below; a vector with a single component equals it."""
        for sign, part in parts:
            self.listed.append(f"{sign} = {self.shown.text(kind_of(self.order), math.hypot(*part))}")
        if all(math.hypot(*part) / self.per_mm > 0.3 for _, part in parts):
            for sign, part in parts:
                self._arrow(self.head(start), self.head(start + part), sign, math.hypot(*part), sign, "-part")
                start = start + part

    def _letters(self) -> None:
        """The points' letters at the ends, those at one place together; o at the pole."""
        mark = "'" if self.order == "acceleration" else ""
        self.canvas.add(Circle((0.0, 0.0), 0.7, "mark"))
        at: dict[Point, list[str]] = {(0.0, 0.0): [f"o{mark}"]}
        for link, some in self.points.items():
            for s in some:
                x, y = self.head(self.vectors[link][s.sign])
                place = next((p for p in at if math.dist(p, (x, y)) < 0.1), (x, y))
                names = at.setdefault(place, [])
                name = add_prime(s.letter, mark)
                names += [name] if name not in names and not self._fixed(s) else []
        middle = np.mean([*at], axis=0)
        for (x, y), names in at.items():
            away = math.atan2(y - middle[1], x - middle[0])
            self.canvas.label(", ".join(names), (x, y), prefer=away, size=3.2, role="title")

    def _fixed(self, s: PointLabel) -> bool:
        """True if a point is a pin on the ground: the pole."""
        joint = self.r.mechanism.joints.get(s.sign)
        return joint is not None and joint.hinge and GROUND in joint.links

    def _turns(self) -> str:
        """Angular rates of the links as text."""
        if self.order == "velocity":
            values = {link: self.motion.spin(link) * self.unit for link in self.r.links}
        else:
            values = {link: float(self.r.acceleration(link)[self.k]) for link in self.r.links}
        kind, sign = ("angular_speed", "ω") if self.order == "velocity" else ("angular_acceleration", "α")
        floor = 1e-12 * max(map(abs, values.values()), default=0.0)
        texts = (
            f"{sign}_{{{self.shown.link(n)}}} = {self.shown.text(kind, v, floor)}" for n, v in values.items()
        )
        return ", ".join(map(unbroken, texts))


def add_prime(letter: str, mark: str) -> str:
    """A letter with a prime before the index: g' of mass centre 2."""
    head, index, rest = letter.partition("_{")
    return head + mark + index + rest


def flat(sign: str) -> str:
    """A point's symbol as an index.

    >>> flat("G_{2}")
    'G2'
    """
    return sign.replace("_{", "").replace("}", "")


def relative(of: str, to: str) -> str:
    """Index of a vector of one point relative to another.

    >>> relative("C", "B"), relative("top_pin", "cross_1")
    ('CB', 'top_pin/cross_1')
    >>> relative("G_{2}", "A1"), relative("O12", "A"), relative("A", "O12")
    ('G2A1', 'O12/A', 'A/O12')
    """
    one, other = flat(of), flat(to)
    return f"{one}{'' if len(one) < 3 and len(other) < 3 else '/'}{other}"
