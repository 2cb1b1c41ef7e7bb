"""End stops: where a freedom that forces move strikes something fixed, and how much of its speed comes back."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, isfinite

from dalembert.errors import ModelError
from dalembert.model.part import Reading, mapping
from dalembert.model.quantities.values import NUMBER_OR_TEXT, JsonSchema, at_item, object_schema, value_text

EXAMPLE = "stops: {from: 0 mm, to: 80 mm, restitution: 0.4}"


@dataclass(frozen=True, slots=True)
class Stops:
    """Least and greatest position, rad or m, infinite where nothing is; part of the speed that comes back, 0 to 1."""

    least: float = -inf
    greatest: float = inf
    restitution: float = 0.0

    def tree(self, kind: str) -> dict[str, object]:
        """As a file says it."""
        ends = {"from": self.least, "to": self.greatest}
        out = {key: value_text(x, kind) for key, x in ends.items() if isfinite(x)}
        return out | ({"restitution": self.restitution} if self.restitution else {})


def end_stops(value: object, kind: str, rules: Reading) -> Stops:
    """The stops that a mapping describes; ``kind`` is that of the drive's position."""
    if isinstance(value, Stops):
        return value
    keys = mapping(value, ["from", "to", "restitution"], EXAMPLE)
    least, greatest = (
        at_item(key, rules.quantity, keys[key], kind) if key in keys else none
        for key, none in (("from", -inf), ("to", inf))
    )
    if not ("from" in keys or "to" in keys):
        raise ModelError("the stops say neither from nor to", f"write {EXAMPLE}; one of the two is enough")
    if not least < greatest:
        said = f"the stops go from {keys['from']} to {keys['to']}"
        raise ModelError(said, "give from the least and to the greatest position", ("from",))
    back = at_item("restitution", rules.quantity, keys.get("restitution", 0.0), "number")
    if not 0 <= back <= 1:
        said = f"a restitution of {back:g}: it is the speed after an impact over that before"
        raise ModelError(said, "write 0 (it stays) to 1 (nothing is lost)", ("restitution",))
    return Stops(least, greatest, back)


def stops_schema() -> JsonSchema:
    """Of stops in a file."""
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
        }
    )
