"""Gestures that draw links and join them."""

from __future__ import annotations

import math
from typing import Literal

from dalembert.errors import ModelError
from dalembert.model import GROUND
from dalembert.studio.editing.draft import STILL, Draft, End, Point
from dalembert.studio.editing.entries import remove
from dalembert.studio.editing.gesture import Gesture, Place, Text, Where


class DrawnLink(Gesture):
    """A link of two points; an end that snapped to a point is pinned to it.

    A typed length and angle place its second end; if that one snapped, the joints then pull the ends together.
    """

    op: Literal["bar"]
    ends: tuple[Where, Where]
    length: Text = ""
    angle: Text = ""
    name: Text = ""

    def apply(self, d: Draft) -> None:
        first, second = self.ends
        a = d.world(first.end) if first.end else snapped(d, first.at)
        b = d.world(second.end) if second.end else snapped(d, second.at)
        long, turn = math.dist(a, b), math.atan2(b[1] - a[1], b[0] - a[0])
        if self.length:
            long = d.size(self.length, "length")
        if self.angle:
            turn = d.size(self.angle, "angle")
        if not long > 0:
            raise ModelError("a bar needs two ends that are apart", "draw it longer")
        link = self.name or d.numbered("links", "link", 2)
        names = [end.end[1] if end.end else d.letter() for end in (first, second)]
        names[1] = d.letter(names[0]) if names[1] == names[0] or not second.end else names[1]
        digits = 12 if self.length else 8
        points = {names[0]: [0, 0], names[1]: [d.number(long, "length", digits), 0]}
        d.put("links", link, {"points": points})
        d.placed[link] = (*a, turn)
        d.points |= {(link, names[0]): (0.0, 0.0), (link, names[1]): (long, 0.0)}
        ends = [(end.end, name) for end, name in zip(self.ends, names, strict=True) if end.end]
        for other, name in ends:
            pin(d, other, (link, name))
        d.assemble(link, *a, turn, joined=any(rooted(d, other[0]) for other, _ in ends))
        for other, _ in ends:
            if rooted(d, other[0]):
                root(d, other[0])


class GroundPoint(Gesture):
    """A point of the ground; a link's point that is clicked is pinned to it."""

    op: Literal["ground"]
    where: Where
    x: Text = ""
    y: Text = ""

    def apply(self, d: Draft) -> None:
        end = self.where.end
        at = d.world(end) if end else snapped(d, self.where.at)
        at = (d.size(self.x, "length") if self.x else at[0], d.size(self.y, "length") if self.y else at[1])
        if end and end[0] == GROUND:
            raise ModelError(f"{end[1]!r} is already a point of the ground", "choose a point of a link")
        name = end[1] if end and not d.has_point(GROUND, end[1]) else d.letter()
        d.add_point(GROUND, name, at)
        if end:
            pin(d, (GROUND, name), end)
            root(d, end[0])


class LinkPoint(Gesture):
    """One more point of a link: at a place, or with typed coordinates in the link's axes."""

    op: Literal["point"]
    link: Text
    at: Place
    x: Text = ""
    y: Text = ""

    def apply(self, d: Draft) -> None:
        if self.link not in d.entries("links"):
            raise ModelError(f"links has no {self.link!r}", "choose a link of the drawing")
        name = d.letter()
        d.add_point(self.link, name, snapped(d, self.at))
        typed = {k: text for k, text in enumerate((self.x, self.y)) if text}
        if typed:
            drawn = d.vector(d.points[self.link, name])
            value = [d.number(d.size(typed[k], "length")) if k in typed else drawn[k] for k in (0, 1)]
            d.splice({("links", self.link, "points", name): value})


class Merge(Gesture):
    """Two points pinned together; the joints bring them to one place."""

    op: Literal["merge"]
    first: Where
    second: Where

    def apply(self, d: Draft) -> None:
        if not self.first.end or not self.second.end:
            raise ModelError("two points are joined", "drag a point onto another one")
        pin(d, self.second.end, self.first.end)
        if rooted(d, self.first.link) or rooted(d, self.second.link):
            root(d, self.first.link)
            root(d, self.second.link)


class Slide(Gesture):
    """A point guided along a line: by a block that is pinned to it (``slider``), as a pin in a slot (``slot``), or with
    its whole link, which then cannot turn in the guide (``slide``).

    guide: the link with the line, which lies along ``direction``, in ground axes, or through two points of the link.
    """

    op: Literal["slider", "slot", "slide"]
    where: Where
    guide: Text = GROUND
    direction: float = 0.0
    angle: Text = ""

    def apply(self, d: Draft) -> None:
        end = self.where.end
        if end is None:
            raise ModelError(
                f"a {self.op} guides a point of a link", "press on a point, and drag along the guide"
            )
        if end[0] == self.guide:
            raise ModelError("a link cannot guide a point of itself", "choose another link, or the ground")
        if self.guide not in d.entries("links"):
            raise ModelError(f"links has no {self.guide!r}", "choose a link of the drawing")
        at = d.world(end)
        turn = d.size(self.angle, "angle") if self.angle else self.direction
        direction = self._direction(d, turn)
        path = line_point(d, self.guide)
        if path is None:
            path = d.letter()
            d.add_point(self.guide, path, at)
        keys: dict[str, object] = (
            {"direction": d.angle_text(direction)}
            if abs(math.remainder(direction, 2 * math.pi)) > 1e-9
            else {}
        )
        if self.op == "slot":
            d.put(
                "joints",
                d.letter(),
                {"type": "slot", "links": [self.guide, end[0]], "at": [path, end[1]], **keys},
            )
            return
        block, angle = end[0], d.placed.get(self.guide, (0.0, 0.0, 0.0))[2] + direction
        if self.op == "slider":
            block = d.numbered("links", "block", 2)
            d.put("links", block, {"points": {end[1]: [0, 0]}})
            d.points[block, end[1]] = (0.0, 0.0)
            d.placed[block] = (*at, angle)
            pin(d, end, (block, end[1]))
        else:
            keys |= turned(d, end[0], angle)
        name = d.letter() if path in d.entries("joints") or path in d.entries("drives") else path
        d.put("joints", name, {"type": "slider", "links": [self.guide, block], "at": [path, end[1]], **keys})
        if rooted(d, end[0]):
            root(d, end[0])

    def _direction(self, d: Draft, turn: float) -> float:
        """The line's direction in the guide's axes: that of a bar."""
        if self.guide == GROUND:
            return turn
        places = [d.points[end] for end in d.ends() if end[0] == self.guide]
        if len(places) == 2 and places[0] != places[1]:
            (x, y), (u, v) = places
            return math.atan2(v - y, u - x)
        return turn - d.placed.get(self.guide, (0.0, 0.0, 0.0))[2]


class Wheels(Gesture):
    """Two gears about two points of their links, pitch circles that touch between them."""

    op: Literal["gear"]
    first: Where
    second: Where
    ratio: float = 1.0

    def apply(self, d: Draft) -> None:
        a, b = self.first.end, self.second.end
        if a is None or b is None or a[0] == b[0]:
            raise ModelError(
                "gears turn about points of two links", "drag from the axis of one to that of the other"
            )
        apart = math.dist(d.world(a), d.world(b))
        if not apart > STILL * d.width:
            raise ModelError("the axes of two gears are apart", "draw them at two places")
        radius = apart / (1 + abs(self.ratio or 1.0))
        radii = [d.number(radius, "length", 8), d.number(apart - radius, "length", 8)]
        d.put(
            "joints", d.letter(), {"type": "gear", "links": [a[0], b[0]], "at": [a[1], b[1]], "radii": radii}
        )


class Join(Gesture):
    """Points of two links joined by something that needs no more than the points; its sizes are as drawn.

    ``weld``: rigidly; a pin between the two links becomes the weld. ``circular_slot``: from the pin to the slot's
    centre. ``rolling``: from the axis of a wheel to the point of its track below it. ``belt``: round wheels about both
    points, each a third of their distance, with 100 N in each strand. ``cam``: from its axis to the roller of its
    follower, which it lifts by a fifth of their distance, or swings by 15 degrees.
    """

    op: Literal["weld", "circular_slot", "rolling", "belt", "cam"]
    first: Where
    second: Where

    def apply(self, d: Draft) -> None:
        a, b = self.first.end, self.second.end
        if a is None or b is None or a[0] == b[0]:
            raise ModelError("points of two links are joined", "drag from one point to the other")
        (x, y), (u, v) = d.world(a), d.world(b)
        apart, of, what = math.dist((x, y), (u, v)), (a, b), self.op.replace("_", " ")
        keys: dict[str, object]
        if self.op == "weld":
            self._unpin(d, a, b)
            keys = turned(d, b[0], d.placed.get(a[0], (0.0, 0.0, 0.0))[2])
        elif not apart > 0:
            raise ModelError(f"the points of a {what} are apart", "drag between two places")
        elif self.op == "belt":
            keys = {"radii": [d.number(apart / 3, "length", 4)] * 2, "tension": "100 N"}
        elif self.op == "cam":
            lift = "15 deg" if self._swings(d, a[0], b[0]) else d.number(apart / 5, "length", 4)
            half = {"by": "cycloidal", "in": d.number(math.radians(120), "angle")}
            segments = [half | {"to": lift}, half | {"to": 0}, {"dwell": "rest"}]
            profile = {"prime": d.number(apart, "length", 8), "segments": segments}
            keys = {"follower": {"roller": d.number(apart / 5, "length", 4)}, "profile": profile}
        else:
            of, keys = (b, a), {"radius": d.number(apart, "length", 8)}
            if self.op == "rolling":
                line = math.atan2(y - v, x - u) - math.pi / 2 - d.placed.get(b[0], (0.0, 0.0, 0.0))[2]
                keys |= {"direction": d.angle_text(line)}
        at = {"at": [of[0][1], of[1][1]]}
        d.put("joints", d.letter(), {"type": self.op, "links": [of[0][0], of[1][0]], **at, **keys})

    @staticmethod
    def _swings(d: Draft, cam: str, follower: str) -> bool:
        """True if a follower is pinned to a link that the cam is pinned to."""
        pins = [set(j.get("links") or ()) for j in d.entries("joints").values() if j.get("type") == "pin"]
        return any({follower, *(pair - {cam})} in pins for pair in pins if cam in pair)

    @staticmethod
    def _unpin(d: Draft, a: End, b: End) -> None:
        for name, joint in list(d.entries("joints").items()):
            if joint.get("type") == "pin" and set(joint.get("links") or ()) == {a[0], b[0]}:
                d.text = remove(d.text, d.form, d.tree, "joints", name)


def turned(d: Draft, link: str, angle: float) -> dict[str, object]:
    """The key ``angle`` of a joint that holds a link's axes at an angle: from a direction to the link's axes."""
    off = math.remainder(d.placed.get(link, (0.0, 0.0, 0.0))[2] - angle, 2 * math.pi)
    return {"angle": d.angle_text(off)} if abs(off) > 1e-9 else {}


def snapped(d: Draft, at: Point) -> Point:
    """A drawn place, rounded."""
    width = d.width
    return d.drawn(at[0], width), d.drawn(at[1], width)


def pin(d: Draft, first: End, second: End) -> str:
    """A pin between two points of links; its name."""
    if first[0] == second[0]:
        raise ModelError(f"both points are on link {first[0]!r}", "join points of two links")
    for name, joint in d.entries("joints").items():
        if set(joint.get("links") or ()) == {first[0], second[0]} and joint.get("type") == "pin":
            raise ModelError(
                f"{first[0]!r} and {second[0]!r} are already joined by {name!r}", "join other links"
            )
    same = first[1] == second[1]
    name = first[1] if same else second[1]
    if name in {**d.entries("joints"), **d.entries("drives")}:
        name = d.letter()
    at: dict[str, object] = (
        {} if same and name == first[1] else {"at": first[1] if same else [first[1], second[1]]}
    )
    d.put("joints", name, {"type": "pin", "links": [first[0], second[0]], **at})
    return name


def line_point(d: Draft, guide: str) -> str | None:
    """A point on the line of a bar; None for the ground and other links."""
    ends = [end for end in d.ends() if end[0] == guide]
    return ends[0][1] if len(ends) == 2 and guide != GROUND else None


def neighbours(d: Draft, link: str) -> set[str]:
    """Links that a joint joins to a link."""
    joints = [set(joint.get("links") or ()) for joint in d.entries("joints").values()]
    return set().union(*(links for links in joints if link in links)) - {link} if joints else set()


def rooted(d: Draft, link: str) -> bool:
    """True if a chain of joints leads from a link to the ground."""
    seen, todo = {link}, [link]
    while todo:
        here = todo.pop()
        if here == GROUND:
            return True
        new = neighbours(d, here) - seen
        seen |= new
        todo += new
    return False


def root(d: Draft, link: str) -> None:
    """Links that now hang on the ground need no place in the file any more, only an angle."""
    seen, todo = {link, GROUND}, [link]
    while todo:
        here = todo.pop()
        if here != GROUND and isinstance(d.entries("assembly").get(here), list):
            d.assemble(here, *d.placed[here], joined=True)
        new = neighbours(d, here) - seen
        seen |= new
        todo += new
