"""Parts of its description that a mechanism keeps beside their substitutes: ropes beside strands and pulleys."""

from __future__ import annotations

from typing import Any, Self

from pydantic import PrivateAttr

from dalembert.model.joints.elements.belts import Belt
from dalembert.model.joints.elements.ropes import Rope
from dalembert.model.part import Part


def as_rope(name: str, joint: object) -> Rope | None:
    """A joint as a rope: a rope itself, a belt with idlers; None of others."""
    return joint.closed(name) if isinstance(joint, Belt) else joint if isinstance(joint, Rope) else None


class WrittenParts(Part):
    """A description, or one with the strands and pulleys of its ropes."""

    _written: Any = PrivateAttr(None)
    _limited: bool = PrivateAttr(True)

    @property
    def written(self) -> Self:
        """The description as it was written, with its ropes."""
        return self if self._written is None else self._written

    def standing_for(self, written: Self) -> Self:
        """This description as what another one consists of."""
        self._written, self._limited = written, written._limited
        return self

    @property
    def ropes(self) -> dict[str, Rope]:
        """Its ropes, and belts with idlers, by name, also if strands and pulleys replace them."""
        joints = self.written.joints.items()  # type: ignore[attr-defined]
        return {name: rope for name, joint in joints if (rope := as_rope(name, joint)) is not None}

    @property
    def has_limits(self) -> bool:
        """False if its belts and ropes neither slip nor go slack."""
        return self._limited

    @property
    def without_limits(self) -> Self:
        """The description with belts and ropes that neither slip nor go slack."""
        out = self.model_copy()
        out._limited = False
        return out
