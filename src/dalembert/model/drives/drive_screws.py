"""Power screws: what turns a slide's force into the torque of its drive.

Mechanics: docs/theory.md 10.12.
"""

from __future__ import annotations

import math
from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from dalembert.errors import ModelError
from dalembert.model.part import Part
from dalembert.model.quantities.values import Scalar

Length = Annotated[float, Scalar("length", "positive")]
Coefficient = Annotated[float, Scalar("number", "not negative")]


class ThreadFriction(Part):
    """Dry friction of a thread."""

    coefficient: Coefficient = Field(description="of the thread's flanks")


class Collar(Part):
    """The collar that bears the force of a screw."""

    radius: Length = Field(description="mean radius, a length")
    coefficient: Coefficient = Field(description="of its friction")


class DriveScrew(Part):
    """A screw whose nut is driven along a slide.

    >>> screw = DriveScrew(lead="8 mm", radius="15 mm", friction={"coefficient": 0.08})
    >>> round(screw.locking_coefficient, 5)
    0.08488
    """

    lead: Length | None = Field(None, description="advance in a turn, a length; or pitch")
    pitch: Length | None = Field(
        None, description="distance of threads, a length: the lead is starts times it"
    )
    starts: Annotated[float, Scalar("number", "positive", "starts")] = Field(
        1.0, description="number of threads side by side; default 1"
    )
    radius: Length = Field(description="mean radius of the thread, a length")
    thread_angle: Annotated[float, Scalar("angle", "not negative")] = Field(
        0.0, description="of a flank in the axial section, half of the thread's; default 0, square"
    )
    friction: ThreadFriction | None = Field(
        None, description="{coefficient: 0.08}, dry friction of the thread"
    )
    collar: Collar | None = Field(None, description="{radius: 20 mm, coefficient: 0.08}")

    @property
    def advance(self) -> Any:
        """The lead, m."""
        return self.lead if self.lead is not None else self.pitch * self.starts  # type: ignore[operator]

    @property
    def slope(self) -> Any:
        """tan(lambda), lead over the mean circumference."""
        return self.advance / (2 * math.pi * self.radius)

    @property
    def flank(self) -> Any:
        """cos b_n, of the flank's angle normal to the thread: tan b_n = tan b cos lambda."""
        angle: Any = self.thread_angle
        sloped = angle.tan() if hasattr(angle, "tan") else math.tan(angle)
        return 1.0 / (1.0 + sloped * sloped / (1.0 + self.slope * self.slope)) ** 0.5

    @property
    def locking_coefficient(self) -> float:
        """Coefficient from which on the thread alone holds any force."""
        return float(self.slope * self.flank)

    @model_validator(mode="after")
    def _one_lead(self) -> Self:
        if (self.lead is None) == (self.pitch is None):
            raise ModelError("the lead of the screw is not clear", "give either lead, or pitch and starts")
        if not self.thread_angle < 1.5:
            raise ModelError(
                "the thread angle is not below 86 deg", "15 deg is that of Acme threads", ("thread_angle",)
            )
        if self.friction is not None and not self.slope * self.friction.coefficient < self.flank:
            what = "the thread jams: no torque raises a load"
            raise ModelError(what, "write a smaller lead, or a smaller coefficient", ("friction",))
        return self
