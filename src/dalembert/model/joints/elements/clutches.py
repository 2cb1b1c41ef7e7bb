"""Discs and cones on one axis, pressed together: clutches and brakes; mechanics: docs/theory.md 6.4."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from dalembert.arrays import Numeric
from dalembert.errors import ModelError
from dalembert.model.joints.elements.brake_keys import Button, Clamp, ClampForce, Heat, Radii
from dalembert.model.joints.elements.brakes import HEAT, Angle, BrakePart
from dalembert.model.quantities.values import Scalar


class Faces(BrakePart):
    """Common to discs and cones: faces on one axis, pressed together by a force; they carry a couple only."""

    radii: Annotated[tuple[float, float], Radii()] | None = Field(
        None, description="of the faces, [inner, outer], lengths"
    )
    faces: Annotated[float, Scalar("number", "positive", "faces")] = Field(
        1.0, description="number of pairs of rubbing faces; default 1"
    )
    law: Literal["wear", "pressure"] = Field(
        "wear", description="of the pressure: as 1/radius by uniform wear (default), or uniform pressure"
    )
    force: Annotated[float | Literal["unknown"], ClampForce()] | None = Field(
        None, description="that presses the faces together, or unknown where the torque is given"
    )
    pressure: Annotated[float, Scalar("pressure", "positive")] | None = Field(
        None, description="greatest pressure on the faces, instead of force"
    )
    cylinder: Clamp | None = Field(
        None, description="{bore: 40 mm, pressure: 20 bar}: presses the faces; with an unknown force its bore"
    )
    spring: Clamp | None = Field(
        None, description="{stiffness: 40 N/mm, compression: 8 mm}: presses the faces"
    )
    heat: Heat | None = Field(None, description=HEAT)

    SECTOR: ClassVar[float] = 2 * math.pi

    @property
    def edges(self) -> tuple[Numeric, Numeric]:
        """Inner and outer radius, m."""
        return self.radii or (0.0, 0.0)

    @property
    def reach(self) -> float:
        """Radius within which it lies, m."""
        return float(self.edges[1])

    @property
    def share(self) -> Numeric:
        """Angle of a face that is covered, rad."""
        return getattr(self, "sector", None) or self.SECTOR

    @property
    def slope(self) -> Numeric:
        """sin of half the cone's angle; 1 of discs."""
        return 1.0

    @property
    def friction_radius(self) -> Numeric:
        """r_e, m: couple of a face over mu times its force."""
        inner, outer = self.edges
        if self.law == "wear":
            return (inner + outer) / 2
        return 2 / 3 * (outer**3 - inner**3) / (outer**2 - inner**2)

    @property
    def force_area(self) -> Numeric:
        """Force over greatest pressure, m2."""
        inner, outer = self.edges
        if self.law == "wear":
            return self.share * inner * (outer - inner)
        return self.share * (outer**2 - inner**2) / 2

    @property
    def lining_area(self) -> Numeric:
        """Area of all rubbing faces, m2."""
        inner, outer = self.edges
        return self.faces * self.share * (outer**2 - inner**2) / 2 / self.slope

    @property
    def lever(self) -> Numeric:
        """Couple over coefficient times force: faces times r_e, over sin(alpha) of a cone."""
        return self.faces * self.friction_radius / self.slope

    @property
    def clamped(self) -> Numeric | None:
        """The force that presses, N; None where it is unknown."""
        if self.force is not None:
            return None if self.force == "unknown" else self.force
        if self.pressure is not None:
            return self.pressure * self.force_area
        part = self.cylinder or self.spring
        return None if part is None else part.force

    @model_validator(mode="after")
    def _pressed(self) -> Self:
        known = [key for key in ("force", "pressure", "cylinder", "spring") if getattr(self, key) is not None]
        if "cylinder" in known and self.cylinder is not None and self.cylinder.pressure is None:
            known.remove("cylinder")
        if len(known) != 1:
            what = f"{' and '.join(known)} are given" if known else "no force presses its faces together"
            remedy = "write one of force: 3 kN, force: unknown, pressure: 0.3 MPa, cylinder or spring"
            raise ModelError(what, remedy, (known[-1],) if known else ())
        if (self.radii is None) == (getattr(self, "button", None) is None):
            raise ModelError("the size of its faces is not clear", "give radii: [inner, outer]")
        if self.radii is not None and self.radii[0] >= self.radii[1]:
            raise ModelError(
                "the inner radius is not smaller than the outer", "write [inner, outer]", ("radii",)
            )
        return self


class Disc(Faces):
    """Discs or plates on one axis, pressed together: a clutch, or with a ground link a brake.

    >>> plates = Disc(links=("ground", "disc"), radii=(0.05, 0.1), force=3000, faces=2)
    >>> plates.friction_radius, plates.lever
    (0.07500000000000001, 0.15000000000000002)
    """

    type: Literal["disc"] = "disc"
    sector: Annotated[float, Scalar("angle", "positive")] | None = Field(
        None, description="angle of a pad; default the complete ring"
    )
    button: Button | None = Field(
        None, description="{radius: 20 mm, at: 100 mm}: round pads, instead of radii"
    )

    @property
    def edges(self) -> tuple[Numeric, Numeric]:
        """Inner and outer radius, m."""
        pad = self.button
        return (pad.at - pad.radius, pad.at + pad.radius) if pad else super().edges

    @property
    def friction_radius(self) -> Numeric:
        """r_e, m: couple of a face over mu times its force."""
        if self.button and self.law == "pressure":
            return self.button.at
        return self.button.friction_radius if self.button else super().friction_radius

    @property
    def force_area(self) -> Numeric:
        """Force over greatest pressure, m2."""
        return self.button.area(self.law) if self.button else super().force_area

    @property
    def force_radius(self) -> Numeric:
        """Distance of a pad's resultant force from the axis, m; 0 for a complete ring."""
        if self.button:
            return self.button.at
        if self.sector is None:
            return 0.0
        spread = 2 * np.sin(self.sector / 2) / self.sector
        inner, outer = self.edges
        return spread * ((inner + outer) / 2 if self.law == "wear" else super().friction_radius)


class Cone(Faces):
    """A cone pressed into a cup; its couple while it slips is mu F r_e / sin(alpha).

    >>> round(float(Cone(links=("a", "b"), radii=(0.1, 0.14), force=500, half_angle="12.5 deg").lever), 6)
    0.554427
    """

    type: Literal["cone"] = "cone"
    half_angle: Angle = Field(description="of the cone, from its axis, an angle")

    @property
    def slope(self) -> Numeric:
        """sin of half the cone's angle."""
        return np.sin(self.half_angle)

    @property
    def push_in(self) -> float:
        """Force that pushes it in without slip, over the normal clamping force."""
        mu = (self.friction and self.friction.coefficient) or 0.0
        return 1 + mu / math.tan(self.half_angle)

    @property
    def draw_off(self) -> float:
        """Force that draws it off without slip, over the clamping force; not positive where it comes off by itself."""
        return self.push_in - 2

    @model_validator(mode="after")
    def _steep(self) -> Self:
        if not 0 < self.half_angle < math.pi / 2:
            what = "half the angle of the cone is not between 0 and 90 deg"
            raise ModelError(what, "write for example half_angle: 12.5 deg", ("half_angle",))
        return self
