"""Common keys of all joints: two links and a point on each."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Self

from pydantic import Field, ValidationInfo, model_validator

from dalembert.errors import ModelError
from dalembert.model.joints.contact_keys import refuse_contact
from dalembert.model.joints.pairs import PAIRS, TEETH, Pair
from dalembert.model.joints.stiffness import Stiffness
from dalembert.model.part import Part, reading
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    TwoNames,
    ValueField,
    at_item,
    check_count,
    check_sign,
    name,
    numbers,
    pair_of_names,
    value_text,
)


class At(ValueField):
    """The name of a point, or `[point of i, point of j]`."""

    def read(self, value: object, info: ValidationInfo) -> str | tuple[str, str]:
        return pair_of_names(value) if isinstance(value, (list, tuple)) else name(value)

    def write(self, value: str | tuple[str, str]) -> object:
        return value if isinstance(value, str) else list(value)

    def json_schema(self) -> JsonSchema:
        names = {"type": ["string", "integer"]}
        return {"anyOf": [names, {"type": "array", "items": names, "minItems": 2, "maxItems": 2}]}


Path = tuple[str | int, ...]
"""Keys and items from a joint to a value in it."""


class TwoNumbers(ValueField):
    """Two positive numbers of a kind, `[of i, of j]`; integers where they count things."""

    sign = "positive"

    def __init__(self, kind: str, counts: str = "") -> None:
        self.kind, self.counts = kind, counts

    def read(self, value: Any, info: ValidationInfo) -> tuple[float, float]:
        pair = numbers(value, self.kind, reading(info))
        if len(pair) != 2:
            raise ModelError(f"a list of {len(pair)} is given; two values are needed", "write [of i, of j]")
        for i, number in enumerate(pair):
            at_item(i, check_sign, number, value[i], self.sign)
            at_item(i, check_count, number, self.counts)
        return pair[0], pair[1]

    def write(self, value: tuple[float, float]) -> object:
        return [value_text(number, self.kind) for number in value]

    def json_schema(self) -> JsonSchema:
        return {"type": "array", "items": NUMBER_OR_TEXT, "minItems": 2, "maxItems": 2}


def kinds_of(part: type[Any]) -> list[type[Any]]:
    """The classes of a part without subclasses: those that a file can name."""
    kinds = part.__subclasses__()
    return [leaf for kind in kinds for leaf in kinds_of(kind)] if kinds else [part]


class JointPart(Part):
    """Common keys of all joints: the links i and j, and the point on each."""

    FREEDOMS: ClassVar[tuple[str, ...]] = ()

    DIMENSIONS: ClassVar[tuple[int, ...]] = (2,)
    """Dimensions it is for: plane, space, or both."""

    TOOTHED: ClassVar[bool] = False
    """True if its wheels have teeth."""

    WRAPPED: ClassVar[bool] = False
    """True if a belt or a chain joins its wheels, which do not touch."""
    BRAKES: ClassVar[bool] = False
    """True of brakes and clutches: friction of what is pressed together."""

    type: str
    links: TwoNames = Field(description="[i, j]: motion and reaction are those of j against i")
    at: Annotated[str | tuple[str, str], At()] | None = Field(
        None,
        description="point of both links, or [point of i, point of j]; default the point with the joint's name",
    )

    stiffness: Stiffness | None = Field(
        None,
        description="where reactions are not unique: {force: ..., moment: ...}, from which they are computed",
    )

    @property
    def freedoms(self) -> tuple[str, ...]:
        """The freedoms of j in i that a drive can prescribe."""
        return self.FREEDOMS + self.gaps

    @property
    def gaps(self) -> tuple[str, ...]:
        """Freedoms that an opened contact has besides: the gap along its normal."""
        contact = getattr(self, "contact", None)
        return () if contact is None or not contact.opened else self.lifted

    @property
    def lifted(self) -> tuple[str, ...]:
        """Freedoms that j has besides once its contact is lost; none of a contact that motions under forces keep."""
        return () if self.BRAKES else ("gap",)

    @property
    def wheels(self) -> int:
        """Number of wheels in contact about its points: two, or j's with a line of i; 0 for other joints."""
        return 0

    @property
    def reach(self) -> float:
        """Radius about i's point within which a brake lies, m; 0 of other joints."""
        return 0.0

    @property
    def slides(self) -> bool:
        """True if j slides along a straight line of i."""
        return any(freedom.startswith("slide") for freedom in self.freedoms)

    @property
    def apart(self) -> bool:
        """True if j's point, the joint's place, moves away from i's."""
        return self.slides

    @property
    def outlined(self) -> bool:
        """True if link i has an outline, on which j's point moves."""
        return False

    @property
    def guides(self) -> bool:
        """In the plane: whether j does not turn in a guide, whose faces bear a couple."""
        return self.freedoms == ("slide",) and 2 in self.DIMENSIONS

    @property
    def ball(self) -> bool:
        """True if j can turn about any axis of i."""
        return False

    @property
    def hinge(self) -> bool:
        """True if j only turns about one axis of i."""
        return self.freedoms == ("turn",) and not (self.ball or self.apart or self.wheels)

    @property
    def pair(self) -> Pair:
        """In space: its row of the table; a gear carries nothing by name."""
        return PAIRS.get(self.type, TEETH)

    def turn_of(self, named: str | None) -> str | None:
        """The named turn, or the only one; None where it does not exist, or a name is needed."""
        turns = [freedom for freedom in self.freedoms if freedom.startswith("turn")]
        if named is not None:
            return named if named in turns else None
        return turns[0] if len(turns) == 1 else None

    def point_names(self, joint: str) -> tuple[str, str]:
        """Names of its points on i and on j; `joint` is the joint's name."""
        if isinstance(self.at, tuple):
            return self.at
        point = self.at or joint
        return point, point

    def places(self, joint: str) -> Iterator[tuple[str, str, Path, Path]]:
        """Link and point of each place that it is at, and the keys that name the link and the point."""
        at: Path = () if self.at is None else ("at",)
        for k, (link, point) in enumerate(zip(self.links, self.point_names(joint), strict=True)):
            yield link, point, ("links", k), at

    def frictions(self) -> Iterator[tuple[Any, Path]]:
        """Each friction that it has, and the keys that it is at."""
        friction = getattr(self, "friction", None) or getattr(self, "grip", None)
        if friction is not None:
            yield friction, ("friction",)

    @model_validator(mode="before")
    @classmethod
    def _holds_all_round(cls, keys: object) -> object:
        if "contact" not in cls.model_fields:
            refuse_contact(keys)
        return keys

    @model_validator(mode="after")
    def _two_links(self) -> Self:
        if self.links[0] == self.links[1]:
            raise ModelError(
                f"it connects link {self.links[0]!r} with itself", "name two different links", ("links",)
            )
        return self
