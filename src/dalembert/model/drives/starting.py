"""Start of a motion under forces: position and speed of the drives that forces move."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from pydantic import ValidationInfo

from dalembert.errors import ModelError
from dalembert.model.drives.drives import SLIDE, TURN, Drive
from dalembert.model.part import ReadingRules, mapping, reading
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    ValueField,
    at_item,
    object_schema,
    value_text,
)

EXAMPLE = "start: {O2: {position: 60 deg, speed: 0}}"


@dataclass(frozen=True, slots=True)
class Start:
    """Position and speed of a drive at time 0, SI and radians; ``turns``: whether it is an angle."""

    position: float
    speed: float = 0.0
    turns: bool = True

    @property
    def keys(self) -> dict[str, float]:
        """Its numbers by their keys in a file."""
        return {"position": self.position, "speed": self.speed}

    def with_key(self, key: str, value: float) -> Start:
        """Another start, one of its numbers replaced."""
        return replace(self, position=value) if key == "position" else replace(self, speed=value)


def drives_at_start(drives: Mapping[str, Drive], start: Mapping[str, Start]) -> Mapping[str, Drive]:
    """The drives; those without a position take that of the start."""
    if not start:
        return drives
    at = {
        name: {"position": s.position, "speed": s.speed}
        for name, s in start.items()
        if name in drives and drives[name].position is None
    }
    return {name: d.model_copy(update=at[name]) if name in at else d for name, d in drives.items()}


class StartValue(ValueField):
    """`{O2: {position: 60 deg, speed: 0}}`."""

    def read(self, value: object, info: ValidationInfo) -> dict[str, Start]:
        return self.starts(value, reading(info))

    def starts(self, value: object, rules: ReadingRules) -> dict[str, Start]:
        """Starts by drive, from a tree."""
        if not isinstance(value, Mapping):
            raise ModelError("a start has a position and a speed by drive", f"write {EXAMPLE}")
        return {
            str(name): at_item(str(name), self._one, start, str(name), rules) for name, start in value.items()
        }

    def _one(self, start: object, name: str, rules: ReadingRules) -> Start:
        if isinstance(start, Start):
            return start
        turns = rules.freedoms.get(name, "turn") == "turn"
        keys, kinds = mapping(start, ["position", "speed"], EXAMPLE), TURN if turns else SLIDE
        if "position" not in keys:
            raise ModelError("its position is missing", f"write {EXAMPLE}")
        position = at_item("position", rules.quantity, keys["position"], kinds[""])
        return Start(position, at_item("speed", rules.quantity, keys.get("speed", 0), kinds["speed"]), turns)

    def write(self, value: Mapping[str, Start]) -> object:
        return {name: self._tree(start) for name, start in value.items()}

    def _tree(self, start: Start) -> dict[str, object]:
        kinds = TURN if start.turns else SLIDE
        return {
            "position": value_text(start.position, kinds[""]),
            "speed": value_text(start.speed, kinds["speed"]),
        }

    def json_schema(self) -> JsonSchema:
        position = NUMBER_OR_TEXT | {"description": "angle of a turn, length of a slide"}
        one = {"position": position, "speed": NUMBER_OR_TEXT | {"description": "default 0"}}
        return {"type": "object", "additionalProperties": object_schema(one, "position")}
