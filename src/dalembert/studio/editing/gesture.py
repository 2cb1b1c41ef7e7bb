"""A gesture: a message of the browser, checked, and what it does to the text."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from dalembert.studio.editing.draft import Draft

Text = Annotated[str, Field(max_length=200)]
"""A name or a typed value."""
Coordinate = Annotated[float, Field(ge=-1e6, le=1e6, allow_inf_nan=False)]
Place = tuple[Coordinate, Coordinate]


class Gesture(BaseModel):
    """A step of undo. Texts are typed values with or without a unit; empty texts were not typed."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=False)

    def apply(self, d: Draft) -> None:
        """Change the draft's text; raises ModelError where that cannot be."""
        raise NotImplementedError


class Where(BaseModel):
    """An end of what is drawn: a place, and the link and point that it snapped to."""

    model_config = ConfigDict(extra="forbid", frozen=True)
    at: Place
    link: Text = ""
    point: Text = ""

    @property
    def end(self) -> tuple[str, str] | None:
        """The point that it snapped to, if any."""
        return (self.link, self.point) if self.point else None
