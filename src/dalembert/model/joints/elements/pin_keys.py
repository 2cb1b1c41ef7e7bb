"""The bolt of a pin joint: the data for its shear, its pressure on eye and cheeks, and its bending."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from dalembert.errors import ModelError
from dalembert.model.part import Part
from dalembert.model.quantities.values import Name, Scalar

Length = Annotated[float, Scalar("length", "positive")]


class PinSize(Part):
    """A bolt through an eye and one or two cheeks, or through a stack of links.

    >>> PinSize(diameter="30 mm", eye="40 mm", cheeks="22 mm").planes
    2
    """

    diameter: Length = Field(description="of the bolt, a length")
    planes: Literal[1, 2] = Field(
        2, description="of shear: 2 (default) of a fork, 1 of two plates side by side"
    )
    eye: Length | None = Field(
        None, description="thickness of the middle part, j; of the one plate with planes: 1"
    )
    cheeks: Length | None = Field(
        None, description="thickness of each cheek of the fork, i; of the other plate"
    )
    gap: Annotated[float, Scalar("length", "not negative")] = Field(
        0.0, description="between eye and cheek, a length; default 0"
    )
    yield_stress: Annotated[float, Scalar("pressure", "positive")] | None = Field(
        None, description="of the bolt: its safety by von Mises"
    )
    stack: tuple[Name, ...] | None = Field(
        None,
        description="links on the bolt in their order along it, of all pins that share the point; a fork twice",
    )
    layers: tuple[Annotated[float, Scalar("length")], ...] | None = Field(
        None, description="places of these links along the bolt, increasing lengths"
    )
    thicknesses: tuple[Length, ...] | None = Field(
        None, description="thickness of each link of the stack: the pressure on it"
    )
    allowed_pressure: Annotated[float, Scalar("pressure", "positive")] | None = Field(
        None, description="bearing pressure that the links may have: its safety"
    )

    @model_validator(mode="after")
    def _whole(self) -> Self:
        if (self.stack is None) != (self.layers is None):
            what = "a stack needs the places of its links"
            raise ModelError(what, "write stack: [one, two, three] and layers: [0 mm, 18 mm, 40 mm]")
        if self.stack is None or self.layers is None:
            if self.thicknesses is not None:
                what = "thicknesses are those of a stack"
                raise ModelError(what, "write eye and cheeks, or stack and layers", ("thicknesses",))
            return self
        if len(self.stack) != len(self.layers) or len(self.stack) < 2:
            what = f"{len(self.stack)} links and {len(self.layers)} layers do not go together"
            raise ModelError(what, "give each link of the stack one place", ("layers",))
        if any(b <= a for a, b in pairwise(self.layers)):
            raise ModelError("the layers do not increase", "write them from one end of the bolt", ("layers",))
        if self.thicknesses is not None:
            self._check_room(self.layers, self.thicknesses)
        return self

    def _check_room(self, layers: tuple[float, ...], thick: tuple[float, ...]) -> None:
        if len(thick) != len(layers):
            what = f"{len(layers)} layers and {len(thick)} thicknesses do not go together"
            raise ModelError(what, "give each link of the stack one", ("thicknesses",))
        for k in range(1, len(layers)):
            if (thick[k - 1] + thick[k]) / 2 > (layers[k] - layers[k - 1]) * (1 + 1e-9):
                what = f"links {k} and {k + 1} of the stack overlap"
                raise ModelError(what, "give layers at least half of both thicknesses apart", ("layers",))
