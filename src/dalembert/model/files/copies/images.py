"""Values of a file as they are in a copy, which is turned or reflected against what it hangs on.

A copied link is reflected in its own x axis. A link that stays has an image for the copy: turned by an angle, or
reflected in a line; its image's axes stand at `offset` from its own.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

from dalembert.errors import ModelError
from dalembert.model.part import Reading
from dalembert.model.quantities.expressions import parse_expression
from dalembert.model.quantities.values import polar, vector
from dalembert.units import NUMBER, quantity


@dataclass(frozen=True)
class Image:
    """Of a copy: its number among all, what its names end with, and how it differs from the original.

    phase: links that stay -> angle of what hangs on them, radians; with `mirrored` that of the line
    shift: how much later its loads come, SI
    """

    ending: str
    phase: Mapping[str, float]
    mirrored: bool
    shift: object
    about: str
    rules: Reading

    @property
    def side(self) -> int:
        """-1 of a reflected copy."""
        return -1 if self.mirrored else 1

    def offset(self, link: str) -> float:
        """Angle of a link's image against the link, radians."""
        return self.phase.get(link, 0.0) * (2 if self.mirrored else 1)

    def angle(self, value: object, offset: float = 0.0) -> object:
        """An angle of the copy: that of the original, or its opposite, and an offset."""
        if offset == 0 and not self.mirrored:
            return value
        try:
            return f"{self.side * quantity(value, 'angle', self.rules.units) + offset!r} rad"
        except ModelError:
            sign = "-" if self.mirrored else "+"
            return f"{math.degrees(offset)!r} deg {sign} ({value})"

    def opposite(self, value: object) -> object:
        """What changes its sign in a reflection: a couple, the speed of a turn."""
        return negative(value) if self.mirrored else value

    def components(self, value: object, offset: float = 0.0, kind: str = "length") -> object:
        """A vector of a link of the copy, or of one that stays with its image's offset."""
        if not self.mirrored and offset == 0:
            return value
        if isinstance(value, str) and "@" in value:
            size, angle = polar(value, kind, self.rules)
            return f"{size} @ {self.side * angle + offset!r} rad"
        if not isinstance(value, list) or len(value) != 2:
            return value
        if offset == 0:
            return [value[0], negative(value[1])]
        x, y = vector(value, kind, self.rules)
        cos, sin, unit = math.cos(offset), math.sin(offset), "m" if kind == "length" else "N"
        return [f"{cos * x - self.side * sin * y!r} {unit}", f"{sin * x + self.side * cos * y!r} {unit}"]


def negative(value: object) -> object:
    """The negative of a number, a quantity, an expression or a table."""
    if isinstance(value, list):
        return [negative(item) for item in value]
    if isinstance(value, Mapping):
        if "expression" in value:
            return {**value, "expression": f"-({value['expression']})"}
        return {**value, "times": negative(value.get("times", 1))}
    if not isinstance(value, str) or value == "unknown":
        return -value if isinstance(value, (int, float)) else value
    if re.fullmatch(rf"\s*(?>{NUMBER})(\s*[^\W\d].*|\s*[°%].*|\s*)", value):
        bare = value.strip()
        return bare[1:] if bare[0] == "-" else f"-{bare.lstrip('+')}"
    try:
        rest = parse_expression(value)[1]
    except ModelError:
        rest = ""
    return f"-({value.strip().removesuffix(rest).strip()}) {rest}".strip()
