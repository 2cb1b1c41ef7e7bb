"""Values of a file in a copy, which is rotated or reflected relative to the links it is attached to.

A copied link is reflected in its local x axis. A link that is not copied has an image for the copy: rotated by an
angle, or reflected in a line; the image's axes are at `offset` from the link's. Values that depend on parameters remain
expressions of them. A value that cannot be read is left as it is: the error is that of the original.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from dalembert.errors import ModelError
from dalembert.model.drives.motors import of_kind, switch
from dalembert.model.part import ReadingRules
from dalembert.model.quantities.dependent_numbers import Dependent, factor_text
from dalembert.model.quantities.expressions import Expression, parse_expression
from dalembert.model.quantities.figures import unit_vector
from dalembert.model.quantities.tables import Table
from dalembert.model.quantities.values import polar
from dalembert.model.quantities.varying import has_units, varying
from dalembert.unit_names import unit
from dalembert.units import KINDS, NUMBER


@dataclass(frozen=True)
class Image:
    """Data of a copy: its number among all, the ending of its names, and its differences from the original.

    phase: links that are not copied -> angle of the parts attached to them, radians; with `mirrored` that of the line
    shift: delay of its loads, SI
    """

    ending: str
    phase: Mapping[str, float]
    mirrored: bool
    shift: float
    about: str
    rules: ReadingRules

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
            return self._angle(self.rules.quantity(value, "angle"), offset)
        except ModelError:
            return value

    def _angle(self, number: float, offset: float) -> str:
        if not isinstance(number, Dependent):
            return f"{self.side * number + offset!r} rad"
        return f"{offset!r} rad {'-' if self.mirrored else '+'} {factor_text(number, 'angle')}"

    def plus(self, value: object, shift: float, kind: str) -> object:
        """A quantity with an SI number added."""
        number, si = self.rules.quantity(value, kind), KINDS[kind].si
        if isinstance(number, Dependent):
            return f"{shift!r} {si} + {factor_text(number, kind)}"
        return f"{number + shift!r} {si}"

    def opposite(self, value: object) -> object:
        """Value that changes sense in a reflection: a couple, the speed of a turn."""
        return self.negative(value) if self.mirrored else value

    def interval(self, value: object, offset: float) -> object:
        """Two angles, the smaller one first: a list, or a mapping with `from` and `to`."""
        if isinstance(value, Mapping):
            names = {"from": "to", "to": "from"} if self.mirrored else {"from": "from", "to": "to"}
            return {names.get(k, k): self.angle(v, offset) if k in names else v for k, v in value.items()}
        if not isinstance(value, list):
            return value
        ends = [self.angle(x, offset) for x in value]
        return ends[::-1] if self.mirrored else ends

    def motor(self, value: object, offset: float) -> object:
        """A motor of a turn: its line of effort over speed, and what it is switched by."""
        if not isinstance(value, Mapping):
            return value
        new = {**value, **{k: self.opposite(value[k]) for k in ("stall", "no_load") if k in value}}
        curve = value.get("curve")
        if self.mirrored and isinstance(curve, Mapping):
            columns = {k: v[::-1] if isinstance(v, list) else v for k, v in curve.items()}
            new["curve"] = {k: self.opposite(v) for k, v in columns.items()}
        return new | {key: self._switch(value[key], offset) for key in ("on", "off") if key in value}

    def cam(self, joint: Mapping[str, object], offset: float) -> dict[str, object]:
        """Keys of a cam that change: where its lift begins, and in the mirror its sense; offset: of its carrier."""
        profile: Any = joint["profile"]
        lift = profile.get("segments")
        new = dict(profile)
        if lift is not None or "tangent" in profile:
            begin = self.angle(profile.get("start", 0), offset)
            new |= {"start": begin} if begin != 0 else {}
        if not self.mirrored:
            return {"profile": new}
        if any(key in profile for key in ("arcs", "points")):
            raise ModelError(
                "the arcs or points of a cam are not mirrored", "write that cam out", ("mirror",)
            )
        new["sense"] = "ccw" if profile.get("sense") == "cw" else "cw"
        if isinstance(lift, Sequence):
            new["segments"] = [self._lift(s) if isinstance(s, Mapping) else s for s in lift]
        return {"profile": new} | ({"face": self.angle(joint["face"])} if "face" in joint else {})

    def _lift(self, segment: Mapping[str, object]) -> Mapping[str, object]:
        """A segment of a lift; an angle is opposite in the mirror."""
        to = segment.get("to")
        try:
            angle = isinstance(to, str) and self.rules.quantity(to, "angle") is not None and bool(to)
        except ModelError:
            angle = False
        return {**segment, "to": self.negative(to)} if angle else segment

    def _switch(self, value: object, offset: float) -> object:
        """A time, a position or a speed."""
        try:
            by, _ = switch(value, of_kind("angle"), self.rules)
        except ModelError:
            return value
        return {"time": value, "position": self.angle(value, offset), "speed": self.opposite(value)}[by]

    def components(self, value: object, offset: float = 0.0, kind: str = "length") -> object:
        """A vector of a link of the copy, or of one that stays with its image's offset."""
        if not self.mirrored and offset == 0:
            return value
        try:
            if isinstance(value, str) and "@" in value:
                size, angle = polar(value, kind, self.rules)
                return f"{size} @ {self._angle(angle, offset)}"
            if not isinstance(value, list) or len(value) != 2:
                return value
            return self._turned(value[0], self.opposite(value[1]), offset, kind)
        except _Unread:
            return value

    def _turned(self, x: object, y: object, offset: float, kind: str) -> list[object]:
        """The components turned by an angle, by a quarter turn without any arithmetic."""
        cos, sin = unit_vector(offset)
        if sin == 0:
            return [x, y] if cos > 0 else [self.negative(x), self.negative(y)]
        if cos == 0:
            return [self.negative(y), x] if sin > 0 else [y, self.negative(x)]
        return [self._sum(cos, x, -sin, y, kind), self._sum(sin, x, cos, y, kind)]

    def _sum(self, a: float, x: object, b: float, y: object, kind: str) -> object:
        """a x + b y of two quantities, which may follow from parameters or change along the motion."""
        parts = [(factor, self._read(value, kind)) for factor, value in ((a, x), (b, y))]
        changing = [v for _, v in parts if isinstance(v, (Dependent, Expression))]
        if not changing:
            return f"{sum(f * v for f, v in parts if isinstance(v, float))!r} {KINDS[kind].si}"
        free = [isinstance(v, Expression) and v.parameters is None for v in changing]
        if all(free):
            return {"expression": " + ".join(_plain(f, v) for f, v in parts), "unit": KINDS[kind].si}
        if any(free):
            raise ModelError(
                "one component of a rotated vector uses parameters or units, and the other does not",
                "write each component as a separate load, a value with a direction",
            )
        return " + ".join(f"{f!r}*{factor_text(v, kind)}" for f, v in parts)

    def _read(self, value: object, kind: str) -> float | Expression:
        try:
            quantity = (
                varying(value, kind, self.rules) if kind == "force" else self.rules.quantity(value, kind)
            )
        except ModelError:
            raise _Unread from None
        if isinstance(quantity, Table):
            raise ModelError(
                "a component of a rotated vector is a table",
                "write each component as a separate load, a value with a direction",
            )
        return quantity

    def negative(self, value: object) -> object:
        """The negative of a number, a quantity, an expression or a table."""
        if isinstance(value, list):
            return [self.negative(item) for item in value]
        if isinstance(value, Mapping):
            if "expression" in value:
                return {**value, "expression": f"-({value['expression']})"}
            return {**value, "times": self.negative(value.get("times", 1))}
        if isinstance(value, bool) or not isinstance(value, (str, int, float)) or value == "unknown":
            return value
        return -value if not isinstance(value, str) else self._negative_text(value)

    def _negative_text(self, value: str) -> str:
        named = has_units(value, self.rules)
        if not named and re.fullmatch(rf"\s*(?>{NUMBER})(\s*[^\W\d].*|\s*[°%].*|\s*)", value):
            bare = value.strip()
            return bare[1:] if bare[0] == "-" else f"-{bare.lstrip('+')}"
        try:
            names = {*self.rules.parameters, *self.rules.freedoms}
            rest = parse_expression(value, names if named else None)[1]
        except ModelError:
            rest = ""
        return f"-({value.strip().removesuffix(rest).strip()}) {rest}".strip()

    def reversed_table(self, table: Mapping[str, object]) -> Mapping[str, object]:
        """The table of the opposite of what it is against."""
        x, y = table.get("x"), table.get("y")
        if not isinstance(x, Sequence) or not isinstance(y, Sequence):
            what = "the columns of a file are not mirrored"
            raise ModelError(what, "write that load's table as x and y, or as an expression")
        return {**table, "x": [self.negative(value) for value in x[::-1]], "y": list(y[::-1])}


class _Unread(Exception):  # noqa: N818
    """A value that is wrong already in the original."""


def _plain(factor: float, value: float | Expression) -> str:
    """A number or an expression without parameters, times a factor, in SI."""
    if isinstance(value, Expression):
        return f"{factor * unit(value.unit).si(1.0)!r}*({value.text})"
    return repr(factor * value)
