"""Force systems as drawings: in the plane to scale with the force polygon, in space through a camera."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from dalembert.analysis.methods.applied_forces import Action
from dalembert.arrays import Array, Tree
from dalembert.views.notation import Figures, Notation, load_sign, pretty
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import fit_frame, force_scale
from dalembert.views.paper.lettering import text_width
from dalembert.views.paper.scene import Arrow, Circle, Line, Point, Scene, along, around
from dalembert.views.plane.force_polygons import LONGEST, dimension, draw_polygon
from dalembert.views.plane.mechanism_view import role_of, scale_notes
from dalembert.views.space.camera import ISOMETRIC, Camera
from dalembert.views.symbols import plane_symbols
from dalembert.wrench import Couple, Force, ForceCouple, System
from dalembert.wrench.reading import Vector

WIDTH, HEIGHT = 84.0, 62.0
"""Space in mm for the points of a system."""

NEAR = 1.5
"""Distance, in lengths of the system, up to which the origin and the central axis are drawn."""


def force_system_scene(s: System, notation: Notation | None = None, camera: Camera | None = None) -> Scene:
    """Forces at their points, couples beside them, the resultant on its line; lengths and forces to scale."""
    d = SystemDrawing(s, Figures(s.units, notation or Notation()), camera)
    d.axes()
    d.points()
    d.known_links()
    notes = [d.describe_result(), *d.resultant()]
    d.couples(s.couples, [n for n, p in zip(s.names, s.parts, strict=True) if isinstance(p, Couple)])
    notes += ["Couples are free vectors, drawn below."] if s.couples else []
    return d.scene(s.title or "Force system", notes)


def reduced_scene(
    s: System, at: Vector, notation: Notation | None = None, camera: Camera | None = None
) -> Scene:
    """The force and the couple at a point that the system is equivalent to."""
    d = SystemDrawing(s, Figures(s.units, notation or Notation()), camera, [s.reduced(at).at])
    reduction = s.reduced(at)
    d.axes()
    for f in s.forces:
        d.canvas.add(Circle(d.place(f.at), 0.6, "center"))
    d.points()
    d.canvas.add(Circle(d.place(reduction.at), 0.8, "mark"))
    force, couple = reduction.parts
    d.force("R", force, "resultant-force")
    d.couple("M", couple, d.place(reduction.at), "resultant-force")
    return d.scene(f"Force and couple at {d.place_name(reduction.at)}", [d.reduction(reduction)])


def force_system_polygon_scene(s: System, notation: Notation | None = None) -> Scene:
    """The forces of a plane system head to tail; the resultant goes from the start to the end."""
    shown = Figures(s.units, notation or Notation())
    resultant, names = s.resultant, dict(zip(s.parts, s.names, strict=True))
    mine = [_action(names[f], f) for f in s.forces if f.size > 0]
    largest = max([f.size for f in s.forces], default=0.0)
    size = math.hypot(*resultant)
    per_mm = force_scale([largest, size], LONGEST, shown.size("force"))
    canvas = Canvas()
    draw_polygon(canvas, mine, 0, shown, per_mm, (0.0, 0.0))
    canvas.items = [item for item in canvas.items if not (isinstance(item, Arrow) and item.role == "gap")]
    closed = size <= 1e-9 * s.scales()[0]
    if not closed:
        head = (float(resultant[0]) / per_mm, float(resultant[1]) / per_mm)
        canvas.add(Arrow((0.0, 0.0), head, "resultant-force", "R", "force", size))
        middle = (head[0] / 2, head[1] / 2)
        canvas.label(f"R = {shown.text('force', size)}", middle, head, size=2.8, role="resultant-force")
    notes, scales = scale_notes(shown, None, per_mm)
    words = "The polygon is closed: the forces balance." if closed else "R goes from the start to the end."
    return canvas.scene(
        "Force polygon", notes=[words, *notes], scales=scales, numbers={"gap": size, "largest": largest}
    )


def _action(name: str, f: Force) -> Action:
    """A force as an action at one position, as drawings of results use it."""
    return Action(name, f.kind, "", "", None, f.at[None], f.vector[None], np.zeros(1))  # type: ignore[arg-type]


class SystemDrawing:
    """One drawing of a system under construction: maps places and vectors, planar or spatial, to paper."""

    def __init__(self, s: System, shown: Figures, camera: Camera | None, more: Sequence[Array] = ()) -> None:
        self.s, self.shown = s, shown
        self.camera = (camera or ISOMETRIC) if s.dimension == 3 else None
        self.canvas = Canvas()
        self.kind = s.kind()
        self.central = s.central_axis() if self.kind in ("single force", "wrench") else None
        origin = np.zeros(s.dimension)
        self.origin = origin if self.near(origin) and not len(more) else None
        places = (
            [f.at for f in s.forces]
            + [p for p in s.points.values() if self.near(p)]
            + list(more)
            + ([] if self.origin is None else [self.origin])
        )
        if self.central is not None and self.near(self.central.axis.point) and not len(more):
            places.append(self.central.axis.point)
        self.places = np.array(places or [origin])
        seen = [self.project(p) for p in self.places]
        if float(np.ptp(seen, axis=0).max()) <= 1e-9 * float(np.abs(self.places).max()):
            seen = seen[:1]  # one behind the other
        self.frame = fit_frame(seen, WIDTH, HEIGHT, shown.size("length"))
        sizes = [f.size for f in s.forces] + [math.hypot(*s.resultant)]
        self.per_mm = force_scale(sizes, 26.0, shown.size("force"))
        turning = [c.size for c in s.couples] + [abs(self.central.moment) if self.central else 0.0]
        turning += [float(np.linalg.norm(s.reduced(p).vector)) for p in more]
        self.moment_per_mm = force_scale(turning, 16.0, shown.size("moment"))

    # from the system to paper

    def near(self, p: Array) -> bool:
        """True if a place is near enough to be drawn."""
        return float(np.linalg.norm(p - self.s.middle)) <= NEAR * self.s.length or not self.s.forces

    def project(self, v: Array) -> Array:
        """Projection of a vector, in its unit."""
        return v if self.camera is None else self.camera(v)

    def place(self, p: Array) -> Point:
        """A place (m) on paper."""
        return self.frame(self.project(p))

    def ahead(self, start: Point, v: Array, per_mm: float) -> Point:
        """The head of an arrow that starts at a place on paper."""
        dx, dy = self.project(v) / per_mm
        return (start[0] + float(dx), start[1] + float(dy))

    def coordinates(self, p: Array) -> str:
        """Coordinates of a place as text."""
        floor = 1e-9 * max(self.s.length, float(np.abs(p).max()))
        numbers = ", ".join(self.shown.number("length", float(x), floor) for x in p)
        return f"({numbers}) {self.shown.unit('length')}"

    def place_name(self, p: Array) -> str:
        """Text for a place: its name, if it has one, else coordinates."""
        name = self.s.point_name(p, "")
        return f"{name} {self.coordinates(p)}".strip()

    # what is drawn

    def axes(self) -> None:
        """Arrows of the axes at the origin, or in the corner where that is far; in space the floor below."""
        d = self.s.dimension
        if d == 3:
            self._floor()
        low = np.array([self.frame(self.project(p)) for p in self.places]).min(axis=0)
        corner = (float(low[0]) - 14.0, float(low[1]) - 14.0)
        start = corner if self.origin is None else self.place(self.origin)
        for k, name in enumerate("xyz"[:d]):
            head = self.ahead(start, np.eye(d)[k], 1 / 9.0)
            if math.dist(start, head) > 0.5:
                self.canvas.add(Arrow(start, head, "axis-arrow"))
                self.canvas.label(name, head, size=2.6, role="note", leads=False)

    def _floor(self) -> None:
        """Rectangle below all places, with lines from the places down to it, which show their depth."""
        low, high = self.places.min(axis=0), self.places.max(axis=0)
        z = min(0.0, low[2]) if self.origin is not None else low[2]
        corners = [
            np.array([x, y, z])
            for x, y in ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]))
        ]
        if np.ptp(self.places[:, 0]) and np.ptp(self.places[:, 1]):
            self.canvas.add(Line(tuple(self.place(p) for p in [*corners, corners[0]]), "grid"))
        for p in self.places:
            foot = np.array([p[0], p[1], z])
            if p[2] > z:
                self.canvas.add(Line((self.place(p), self.place(foot)), "grid"))

    def points(self) -> None:
        """Named points."""
        for name, p in ((n, p) for n, p in self.s.points.items() if self.near(p)):
            at = self.place(p)
            self.canvas.add(Circle(at, 0.6, "center"))
            self.canvas.label(name, at, size=3.2, role="title")

    def known_links(self) -> None:
        """All forces at their points, the farthest first; in space with the box of their components."""
        named = [(n, p) for n, p in zip(self.s.names, self.s.parts, strict=True) if isinstance(p, Force)]
        if self.camera is not None and named:
            named = [named[k] for k in self.camera.order([f.at + 0.5 * f.vector for _, f in named])]
        for name, f in named:
            self.canvas.add(Circle(self.place(f.at), 0.5, "mark"))
            self.force(name, f, role_of(f.kind))

    def force(self, name: str, f: Force, role: str) -> None:
        """An arrow from the point of application, with the force's name and size."""
        tail = self.place(f.at)
        head = self.ahead(tail, f.vector, self.per_mm)
        if math.dist(tail, head) < 0.05:
            return
        if self.camera is not None:
            self._components(tail, f.vector)
        seen = math.dist(tail, head) * self.per_mm
        kind = "force" if self.camera is None else "force-seen"
        self.canvas.add(Arrow(tail, head, role, name, kind, seen))
        spots = along(tail, head, 1.0, 0.8, 0.6)
        away = math.atan2(head[1] - tail[1], head[0] - tail[0])
        text = f"{load_sign(name)} = {self.shown.text('force', f.size)}"
        self.canvas.label(text, *spots, prefer=away, size=2.8, role=role)

    def _components(self, tail: Point, vector: Array) -> None:
        """Path to the head along x, y and z."""
        if np.count_nonzero(np.abs(vector) > 1e-9 * np.abs(vector).max()) < 2:
            return
        steps, at = [tail], tail
        for k in range(3):
            at = self.ahead(at, vector * np.eye(3)[k], self.per_mm)
            if math.dist(at, steps[-1]) > 0.05:
                steps.append(at)
        self.canvas.add(Line(tuple(steps), "construction"))

    def couples(self, couples: Sequence[Couple], names: Sequence[str]) -> None:
        """Couples in a row below the drawing; as free vectors they may be placed anywhere."""
        left, bottom, _, _ = Scene(tuple(self.canvas.items)).bounds
        x = left + 8.0
        for name, c in zip(names, couples, strict=True):
            self.couple(name, c, (x, bottom - 16.0), role_of(c.kind))
            text = f"{load_sign(name)} = {self.shown.text('moment', c.size)}"
            x += max(18.0, text_width(text, 2.8) + 6.0)

    def couple(self, name: str, c: Couple, at: Point, role: str) -> None:
        """A curved arrow in the plane, an arrow with two heads in space."""
        if c.size <= 1e-9 * self.s.scales()[1]:
            return
        if self.camera is None:
            self.canvas.add(*plane_symbols.couple(at, c.moment, 4.2, role, name, c.moment))
            spots = around(at, 4.2, 8)
        else:
            head = self.ahead(at, c.vector, self.moment_per_mm)
            self._two_heads(at, head, role, name)
            spots = along(at, head, 1.0, 0.5)
        self.canvas.label(
            f"{load_sign(name)} = {self.shown.text('moment', c.size)}", *spots, size=2.8, role=role
        )

    def _two_heads(self, tail: Point, head: Point, role: str, name: str) -> None:
        length = math.dist(tail, head)
        if length < 0.05:
            self.canvas.add(Circle(tail, 0.8, role))
            return
        seen = length * self.moment_per_mm
        self.canvas.add(*plane_symbols.two_heads(tail, head, role, name, "moment-seen", seen))

    def resultant(self) -> list[str]:
        """The resultant on its line of action, in space with the couple along it; a note where it is too far away."""
        if self.central is None or len(self.s.forces) + len(self.s.couples) < 2:
            return []
        axis = self.central.axis
        if not self.near(axis.point):
            return [f"Its line is outside this drawing: it passes through {self.coordinates(axis.point)}."]
        at, ahead = self.place(axis.point), self.ahead((0.0, 0.0), axis.direction, 1.0)
        line = clip_line(at, ahead, self._room())
        if line is not None:
            self.canvas.add(Line(line, "resultant"))
        self.force("R", Force(self.central.force, axis.point), "resultant-force")
        if self.kind == "wrench":
            self._couple_on_axis(at)
        if self.camera is None and self.origin is not None:
            self._distance(self.place(self.origin))
        return []

    def _couple_on_axis(self, at: Point) -> None:
        """The couple along the force, in front of it or, if opposite, behind it."""
        assert self.central is not None
        along, moment = self.central.axis.direction, self.central.moment
        head = self.ahead(at, self.central.force, self.per_mm)
        unit = self.project(along) / max(float(np.hypot(*self.project(along))), 1e-9)
        start = head if moment > 0 else at
        gap = math.copysign(3.0, moment)
        tail = (start[0] + gap * float(unit[0]), start[1] + gap * float(unit[1]))
        self.couple("M", Couple(moment * along), tail, "resultant-force")

    def _distance(self, origin: Point) -> None:
        """Distance of the resultant from the origin."""
        assert self.central is not None
        foot = self.central.axis.foot(np.zeros(2))
        length = float(np.linalg.norm(foot))
        end = self.place(foot)
        left, low, right, high = self._room()
        if math.dist(origin, end) > 4.0 and left <= end[0] <= right and low <= end[1] <= high:
            dimension(self.canvas, origin, end, f"d = {self.shown.text('length', length)}")

    def _room(self) -> tuple[float, float, float, float]:
        left, low, right, high = Scene(tuple(self.canvas.items)).bounds
        return (left - 8.0, low - 8.0, right + 8.0, high + 8.0)

    # what is said

    def describe_result(self) -> str:
        """Sentence on the resultant of the system."""
        text, s = self.shown.text, self.s
        if self.kind == "zero":
            return (
                f"The system is in equilibrium: {s.equilibrium().residual:.0e} of the largest force is left."
            )
        if self.kind == "couple":
            return f"The system is a couple: {self.vector(s.reduced(s.middle).vector, 'moment')}."
        assert self.central is not None
        words = (
            f"R = {self.vector(self.central.force, 'force')}, {text('force', Force(self.central.force).size)}"
        )
        if s.dimension == 2:
            degrees = self.shown.notation.direction(*self.central.force)
            return f"The system is a single force: {words} ∠ {degrees}°."
        through = f"on the line through {self.coordinates(self.central.axis.point)}"
        if self.kind == "single force":
            return f"The system is a single force: {words}, {through}."
        pitch = text("length", self.central.pitch)
        return f"The system is a wrench: {words}, {through}; M = {text('moment', self.central.moment)}, pitch {pitch}."

    def reduction(self, pair: ForceCouple) -> str:
        """A force and couple at a point, as text."""
        return f"R = {self.vector(pair.force, 'force')}, M = {self.vector(pair.vector, 'moment')}."

    def vector(self, v: Array, kind: str) -> str:
        """Components with their unit."""
        floor = 1e-9 * float(np.abs(v).max(initial=0.0))
        numbers = [self.shown.number(kind, float(x), floor) for x in v]
        inside = numbers[0] if len(numbers) == 1 else f"({', '.join(numbers)})"
        return f"{inside} {pretty(self.shown.unit(kind))}"

    def scene(self, title: str, notes: list[str]) -> Scene:
        """The finished drawing with its scales."""
        texts, scales = scale_notes(self.shown, self.frame, self.per_mm if self.s.forces else None)
        if self.camera is not None:
            texts, scales = self._scale_notes(texts[0], scales)
        numbers: Tree = {"kind": self.kind, "resultant": math.hypot(*self.s.resultant)}
        if self.central is not None:
            numbers |= {"moment": self.central.moment, "pitch": self.central.pitch}
        return self.canvas.scene(title, notes=[*notes, *texts], scales=scales, numbers=numbers)

    def _scale_notes(self, text: str, scales: dict[str, float]) -> tuple[list[str], dict[str, float]]:
        """Scales of true lengths, and the foreshortening of each axis."""
        assert self.camera is not None
        short = np.linalg.norm(self.camera(np.eye(3)), axis=-1)
        seen = f"foreshortening along x, y and z: {', '.join(f'{x:.3f}' for x in short)}"
        turning = any(isinstance(i, Arrow) and i.kind == "moment-seen" for i in self.canvas.items)
        moments = f"; moments: 1 mm = {self.shown.plain('moment', self.moment_per_mm)}" if turning else ""
        out = {"length": scales["length"], "force-seen": self.per_mm, "moment-seen": self.moment_per_mm}
        return [f"{text}{moments}, in true size; {seen}."], out


def clip_line(at: Point, along: Point, room: tuple[float, float, float, float]) -> tuple[Point, Point] | None:
    """Part of a line through a place on paper that is inside a box; None where it misses the box.

    >>> clip_line((0, 5), (1, 0), (-10, 0, 10, 8))
    ((-10.0, 5.0), (10.0, 5.0))
    """
    low, high = -math.inf, math.inf
    for k in range(2):
        if abs(along[k]) < 1e-12:
            if not room[k] <= at[k] <= room[k + 2]:
                return None
            continue
        a, b = sorted(((room[k] - at[k]) / along[k], (room[k + 2] - at[k]) / along[k]))
        low, high = max(low, a), min(high, b)
    if not low < high or math.isinf(low):
        return None
    first, last = ((float(at[0] + t * along[0]), float(at[1] + t * along[1])) for t in (low, high))
    return first, last
