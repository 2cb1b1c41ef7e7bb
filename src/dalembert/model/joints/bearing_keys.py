"""The bearing of a joint that turns: the data for its pressure and its life."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from dalembert.errors import ModelError
from dalembert.model.part import Part
from dalembert.model.quantities.values import Scalar

Length = Annotated[float, Scalar("length", "positive")]
Factor = Annotated[float, Scalar("number", "not negative")]
Rating = Annotated[float, Scalar("force", "positive")]


class Bearing(Part):
    """A plain bearing by its diameter and length, a rolling one by its rating, or both.

    >>> Bearing(rating="12 kN").exponent
    3.0
    """

    diameter: Length | None = Field(None, description="of the pin, a length")
    length: Length | None = Field(None, description="along the pin that bears, a length")
    rating: Rating | None = Field(None, description="C, dynamic load rating, a force")
    static_rating: Rating | None = Field(None, description="C0, static load rating, a force")
    kind: Literal["ball", "roller"] = Field("ball", description="exponent of the life: 3, or 10/3")
    radial_factor: Factor = Field(1.0, description="in space: X of P = X F_r + Y F_a, never less than F_r")
    axial_factor: Factor | None = Field(
        None, description="in space: Y of P; without it no axial force is borne"
    )

    @property
    def area(self) -> float | None:
        """Projected, diameter times length; None where one is not given."""
        return self.diameter * self.length if self.diameter and self.length else None

    @property
    def exponent(self) -> float:
        """Load exponent of the life equation."""
        return 3.0 if self.kind == "ball" else 10 / 3

    @model_validator(mode="after")
    def _enough(self) -> Self:
        remedy = "give rating: 12 kN, or diameter: 20 mm and length: 15 mm"
        if self.rating is None and (self.diameter is None or self.length is None):
            known = "length" if self.length is None and self.diameter is not None else "rating"
            raise ModelError(f"the bearing has no {known}", remedy)
        return self
