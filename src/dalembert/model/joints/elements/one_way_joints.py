"""One-way clutches and ratchets: joints that carry a couple in one sense and turn freely in the other.

Mechanics: docs/theory.md 10.13.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from dalembert.model.drives.end_stops import Stops
from dalembert.model.joints.joint_part import JointPart
from dalembert.model.part import Part
from dalembert.model.quantities.values import Scalar

Length = Annotated[float, Scalar("length", "positive")]
Angle = Annotated[float, Scalar("angle")]
Wedge = Annotated[float, Scalar("angle", "positive")]
Number = Annotated[float, Scalar("number", "positive")]
FREE = "sense in which j turns freely in i: ccw or cw; the couple on j is always in this sense"
ANGLE = "of j's axes to i's where it holds; default 0"


class Rollers(Part):
    """Rollers between a ring and a wedge-shaped face."""

    count: Annotated[float, Scalar("number", "positive", "rollers")] = Field(description="number of rollers")
    radius: Length = Field(description="of the ring, a length")
    wedge: Wedge = Field(description="angle between ring and face at a roller")
    coefficient: Number = Field(description="of friction, static")

    @property
    def least_coefficient(self) -> float:
        """Coefficient from which on they grip, tan(wedge/2)."""
        half: Any = self.wedge / 2
        return float(math.tan(half)) if isinstance(half, float) else half.tan()


class Pawl(Part):
    """A pawl that pushes on a tooth."""

    radius: Length = Field(description="of the place where it pushes, a length")
    angle: Angle = Field(0.0, description="of its line of action to the tangent, default 0")
    coefficient: Annotated[float, Scalar("number", "not negative")] = Field(
        0.0, description="of friction on the tooth's flank"
    )


class Clutch(JointPart):
    """Common keys of joints that carry a couple in one sense."""

    RELEASED: ClassVar[bool] = False
    """True of the same joint where drives move both of its links, so that it holds nothing."""

    type: str
    free: Literal["ccw", "cw"] = Field(description=FREE)
    angle: Angle = Field(0.0, description=ANGLE)

    @property
    def way(self) -> float:
        """Sense of the couple on j: 1 counter-clockwise, -1 clockwise."""
        return 1.0 if self.free == "ccw" else -1.0

    @property
    def pitch(self) -> float:
        """Angle from one engagement to the next, 0 where it engages anywhere."""
        return 0.0

    @property
    def hinge(self) -> bool:
        """It holds no point."""
        return False


class OneWay(Clutch):
    """A one-way clutch between two links on one axis.

    >>> OneWay(links=("one", "two"), at="O", free="ccw").way
    1.0
    """

    type: Literal["one_way"] = "one_way"
    rollers: Rollers | None = Field(None, description="{count, radius, wedge, coefficient}")


class Ratchet(Clutch):
    """A ratchet: a one-way clutch that engages at its teeth.

    >>> round(Ratchet(links=("one", "two"), at="O", free="ccw", teeth=24).pitch, 6)
    0.261799
    """

    type: Literal["ratchet"] = "ratchet"
    teeth: Annotated[float, Scalar("number", "positive", "teeth")] = Field(description="number of teeth")
    pawl: Pawl | None = Field(None, description="{radius, angle, coefficient}")

    @property
    def pitch(self) -> float:
        """Angle from one tooth to the next."""
        return 2 * math.pi / self.teeth

    @property
    def reach(self) -> float:
        """Radius of the wheel where it is known, m, else 0."""
        return self.pawl.radius if self.pawl else 0.0


class ReleasedOneWay(OneWay):
    """A one-way clutch whose links drives move: it has the turn as its freedom."""

    FREEDOMS: ClassVar = ("turn",)
    RELEASED: ClassVar = True

    @property
    def stops(self) -> Stops:
        """Place at which it holds in a motion under forces, which moves on with it."""
        return Stops(kind="angle")


class ReleasedRatchet(Ratchet):
    """A ratchet whose links drives move: it has the turn as its freedom."""

    FREEDOMS: ClassVar = ("turn",)
    RELEASED: ClassVar = True

    @property
    def stops(self) -> Stops:
        """Place at which it holds in a motion under forces: its last tooth."""
        return Stops(kind="angle")


@lru_cache(maxsize=64)
def released(joint: Clutch) -> Clutch:
    """The joint without its constraint."""
    kind = ReleasedRatchet if isinstance(joint, Ratchet) else ReleasedOneWay
    return kind.model_construct(**{name: getattr(joint, name) for name in type(joint).model_fields})
