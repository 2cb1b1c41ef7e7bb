"""What is for mechanisms of the plane only, refused with a sentence."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.model import Mechanism


def refuse_space(m: Mechanism, what: str, instead: str) -> None:
    """Raise for a mechanism in space: what was asked for, and what to ask for in its place.

    >>> from dalembert.model.library import four_bar
    >>> refuse_space(four_bar(), "a force polygon", "use solve")
    """
    if m.dimension == 3:
        raise ModelError(
            f"{what} is for mechanisms of the plane, and this one is in space", instead, ("space",)
        )
