"""Gestures that drive a mechanism and load it."""

from __future__ import annotations

import math
from typing import Literal

from dalembert.errors import ModelError
from dalembert.model import GROUND
from dalembert.studio.editing.draft import Draft
from dalembert.studio.editing.gesture import Coordinate, Gesture, Text, Where

WHOLE_TURN = {"from": 0, "to": 360, "count": 72}


class DriveJoint(Gesture):
    """A drive of a joint: at the position that is drawn (``here``, rad or m), or over a whole turn."""

    op: Literal["drive"]
    joint: Text
    here: Coordinate = 0.0
    freedom: Literal["", "turn", "slide"] = ""
    position: Text = ""
    whole_turn: bool = False
    speed: Text = ""

    def apply(self, d: Draft) -> None:
        joint = d.entries("joints").get(self.joint)
        if joint is None:
            raise ModelError(f"joints has no {self.joint!r}", "click a joint of the drawing")
        slides = self.freedom == "slide" or joint.get("type") == "slider"
        kind = "length" if slides else "angle"
        value: object = d.number(self.here, kind, 6) if slides else d.angle_text(self.here)
        if self.position:
            value = typed(d, self.position, kind)
        if self.whole_turn and not slides:
            value = {
                key: d.number(math.radians(x), "angle") if key != "count" else x
                for key, x in WHOLE_TURN.items()
            }
        keys: dict[str, object] = {"position": value}
        if self.freedom and joint.get("type") in ("slot", "circular_slot"):
            keys["freedom"] = self.freedom
        if self.speed:
            keys["speed"] = typed(d, self.speed, "speed" if slides else "angular_speed")
        if self.joint in d.entries("drives"):
            d.splice({("drives", self.joint, key): x for key, x in keys.items()})
        else:
            d.put("drives", self.joint, keys)


class PointForce(Gesture):
    """A force on a point of a link: drawn as a vector, N in ground axes, or typed as a size and a direction."""

    op: Literal["force"]
    where: Where
    vector: tuple[Coordinate, Coordinate] = (0.0, 0.0)
    value: Text = ""
    angle: Text = ""

    def apply(self, d: Draft) -> None:
        if self.where.end is None or self.where.link == GROUND:
            raise ModelError("a force acts on a point of a moving link", "draw it from such a point")
        turn = d.size(self.angle, "angle") if self.angle else math.atan2(self.vector[1], self.vector[0])
        size: object = d.number(math.hypot(*self.vector), "force", 3)
        if self.value:
            size = typed(d, self.value, "force")
        name = d.numbered("loads", "F", 1)
        text = {"value": f"{size} @ {d.angle_text(turn)}"}
        if isinstance(size, str):  # a unit may be written once only, and the direction is in the file's
            text = {"value": size, "direction": d.angle_text(turn)}  # type: ignore[dict-item]
        d.put("loads", name, {"type": "force", "on": self.where.link, "at": self.where.point, **text})


class LinkCouple(Gesture):
    """A couple on a link, counter-clockwise."""

    op: Literal["couple"]
    link: Text
    value: Text = "10 N*m"

    def apply(self, d: Draft) -> None:
        if self.link == GROUND or self.link not in d.entries("links"):
            raise ModelError("a couple acts on a moving link", "click a link of the drawing")
        value = typed(d, self.value, "moment")
        d.put("loads", d.numbered("loads", "T", 1), {"type": "couple", "on": self.link, "value": value})


class Span(Gesture):
    """A spring, a damper or a cylinder between points of two links.

    A spring is unloaded as it is drawn; a cylinder drives the distance of its points.
    """

    op: Literal["spring", "damper", "cylinder"]
    first: Where
    second: Where
    value: Text = ""

    def apply(self, d: Draft) -> None:
        a, b = self.first.end, self.second.end
        if a is None or b is None or a[0] == b[0]:
            raise ModelError(f"a {self.op} joins points of two links", "drag from one point to the other")
        between = [f"{a[0]}.{a[1]}", f"{b[0]}.{b[1]}"]
        long = d.number(math.dist(d.world(a), d.world(b)), "length", 6)
        if self.op == "spring":
            stiffness = typed(d, self.value or "1000 N/m", "stiffness")
            keys = {"type": "spring", "between": between, "stiffness": stiffness, "free_length": long}
            d.put("loads", d.numbered("loads", "K", 1), keys)
        elif self.op == "damper":
            damping = typed(d, self.value or "100 N*s/m", "damping")
            d.put(
                "loads",
                d.numbered("loads", "D", 1),
                {"type": "damper", "between": between, "damping": damping},
            )
        else:
            bore = typed(d, self.value or "50 mm", "length")
            cylinder = {"between": between, "bore": bore}
            d.put("drives", d.numbered("drives", "cylinder", 1), {"position": long, "cylinder": cylinder})


def typed(d: Draft, text: str, kind: str) -> object:
    """A typed value as the file says it: bare where it was bare, else with its unit."""
    si = d.size(text, kind)
    stripped = text.strip()
    try:
        float(stripped.replace(",", "."))
    except ValueError:
        return stripped.replace(",", ".")
    return d.number(si, kind)
