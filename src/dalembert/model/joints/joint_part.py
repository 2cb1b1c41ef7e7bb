"""Common keys of all joints: two links and a point on each."""

from __future__ import annotations

from typing import Annotated, ClassVar, Self

from pydantic import Field, ValidationInfo, model_validator

from dalembert.errors import ModelError
from dalembert.model.joints.pairs import PAIRS, TEETH, Pair
from dalembert.model.joints.stiffness import Stiffness
from dalembert.model.part import Part
from dalembert.model.quantities.values import JsonSchema, TwoNames, ValueField, name, pair_of_names


class At(ValueField):
    """The name of a point, or `[point of i, point of j]`."""

    def read(self, value: object, info: ValidationInfo) -> str | tuple[str, str]:
        return pair_of_names(value) if isinstance(value, (list, tuple)) else name(value)

    def write(self, value: str | tuple[str, str]) -> object:
        return value if isinstance(value, str) else list(value)

    def json_schema(self) -> JsonSchema:
        names = {"type": ["string", "integer"]}
        return {"anyOf": [names, {"type": "array", "items": names, "minItems": 2, "maxItems": 2}]}


class JointPart(Part):
    """Common keys of all joints: the links i and j, and the point on each."""

    FREEDOMS: ClassVar[tuple[str, ...]] = ()

    DIMENSIONS: ClassVar[tuple[int, ...]] = (2,)
    """Dimensions it is for: plane, space, or both."""

    TOOTHED: ClassVar[bool] = False
    """True if its wheels have teeth."""

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
        return self.FREEDOMS

    @property
    def wheels(self) -> int:
        """Number of wheels in contact about its points: two, or j's with a line of i; 0 for other joints."""
        return 0

    @property
    def slides(self) -> bool:
        """True if j slides along a straight line of i."""
        return any(freedom.startswith("slide") for freedom in self.freedoms)

    @property
    def apart(self) -> bool:
        """True if j's point, the joint's place, moves away from i's."""
        return self.slides

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

    @model_validator(mode="after")
    def _two_links(self) -> Self:
        if self.links[0] == self.links[1]:
            raise ModelError(
                f"it connects link {self.links[0]!r} with itself", "name two different links", ("links",)
            )
        return self
