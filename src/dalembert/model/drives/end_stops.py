"""End stops: where a drive's or a joint's freedom strikes something, and how it comes back: restitution, or spring and
damper."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf, isfinite

from pydantic import ValidationInfo

from dalembert.errors import ModelError
from dalembert.model.joints.pairs import PAIRS
from dalembert.model.part import ReadingRules, mapping, reading
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    ValueField,
    at_item,
    check_sign,
    object_schema,
    value_text,
)

STOPS = "least and greatest position, where forces move the machine: used by simulate"
EXAMPLE = "stops: {from: 0 mm, to: 80 mm, restitution: 0.4}"
PUSH = {
    "length": {"stiffness": "stiffness", "damping": "damping"},
    "angle": {"stiffness": "torsion_stiffness", "damping": "torsion_damping"},
}
"""Kinds of the numbers of elastic stops, by the kind of the position."""


@dataclass(frozen=True, slots=True)
class Stops:
    """Least and greatest position, rad or m, infinite without a stop; coefficient of restitution, 0 to 1.

    Elastic where there is a ``stiffness``, N/m or N m/rad: beyond the position a spring and a ``damping`` push back.
    """

    least: float = -inf
    greatest: float = inf
    restitution: float = 0.0
    kind: str = ""
    """Kind of the joint's freedom: angle or length."""
    stiffness: float = 0.0
    damping: float = 0.0

    def tree(self, kind: str) -> dict[str, object]:
        """As a file says it."""
        ends = {"from": self.least, "to": self.greatest}
        out = {key: value_text(x, kind) for key, x in ends.items() if isfinite(x)}
        pushes = {"stiffness": self.stiffness, "damping": self.damping}
        out |= {key: value_text(x, PUSH[kind][key]) for key, x in pushes.items() if x}
        return out | ({"restitution": self.restitution} if self.restitution else {})


def end_stops(value: object, kind: str, rules: ReadingRules) -> Stops:
    """The stops that a mapping describes; ``kind`` is that of the drive's position."""
    if isinstance(value, Stops):
        return value
    keys = mapping(value, ["from", "to", "restitution", "stiffness", "damping"], EXAMPLE)
    least, greatest = (
        at_item(key, rules.quantity, keys[key], kind) if key in keys else none
        for key, none in (("from", -inf), ("to", inf))
    )
    if not ("from" in keys or "to" in keys):
        raise ModelError("the stops say neither from nor to", f"write {EXAMPLE}; one of the two is enough")
    if not least < greatest:
        problem = f"the stops go from {keys['from']} to {keys['to']}"
        raise ModelError(problem, "give from the least and to the greatest position", ("from",))
    back = at_item("restitution", rules.quantity, keys.get("restitution", 0.0), "number")
    if not 0 <= back <= 1:
        problem = f"restitution is {back:g}; it is the speed after an impact over the speed before"
        raise ModelError(
            problem, "write a number from 0 (no rebound) to 1 (no energy lost)", ("restitution",)
        )
    stiffness, damping = (
        at_item(key, _positive, keys[key], PUSH[kind][key], rules) if key in keys else 0.0
        for key in PUSH[kind]
    )
    for key in ("restitution", "damping"):
        if key in keys and (key == "restitution") == bool(stiffness):
            raise ModelError(*AGAINST[key], (key,))
    return Stops(least, greatest, back, stiffness=stiffness, damping=damping)


AGAINST = {
    "restitution": (
        "the stops have a restitution and a stiffness",
        "leave one out; what an elastic stop takes of the speed is its damping",
    ),
    "damping": ("the stops have a damping without a stiffness", "write stiffness: 2e5 N/m, or a damper load"),
}
"""Problem and remedy of keys that do not fit together."""


def _positive(value: object, kind: str, rules: ReadingRules) -> float:
    return check_sign(rules.quantity(value, kind), value, "positive")


def stops_schema() -> JsonSchema:
    """JSON schema of stops in a file."""
    return object_schema(
        {
            "from": NUMBER_OR_TEXT | {"description": "least position"},
            "to": NUMBER_OR_TEXT | {"description": "greatest position"},
            "restitution": {
                "type": "number",
                "minimum": 0,
                "maximum": 1,
                "description": "speed after an impact over that before; default 0",
            },
            "stiffness": NUMBER_OR_TEXT
            | {"description": "of an elastic stop: force over the depth beyond it; it only pushes"},
            "damping": NUMBER_OR_TEXT
            | {"description": "of an elastic stop: force over the speed; default 0"},
        }
    )


class JointStops(ValueField):
    """Stops of a joint with one freedom; of a slot, of its slide."""

    def __init__(self, kind: str = "") -> None:
        self.kind = kind

    def read(self, value: object, info: ValidationInfo) -> Stops:
        pair = PAIRS.get(str(info.data.get("type")))
        freedoms = pair.freedoms if pair else ()
        if pair and pair.ball and freedoms == ("turn",):
            raise ModelError(
                "a ball turns about any axis, so no one position of it has stops", "leave them out"
            )
        if not self.kind and len(freedoms) != 1:
            raise ModelError(
                f"stops are of a joint with one freedom, and this one has {', '.join(freedoms) or 'none'}",
                "let a drive of that freedom go, and give the stops to the drive",
            )
        kind = self.kind or ("length" if freedoms[0] == "slide" else "angle")
        return replace(end_stops(value, kind, reading(info)), kind=kind)

    def write(self, value: Stops) -> object:
        return value.tree(value.kind)

    def json_schema(self) -> JsonSchema:
        return stops_schema()
