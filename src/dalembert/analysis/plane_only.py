"""Refuses, with a sentence, what is supported for planar mechanisms only."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.model import Mechanism


def refuse_space(m: Mechanism, what: str, instead: str) -> None:
    """Raises for a mechanism in space: the analysis refused, and the one to use instead.

    >>> from dalembert.model.library import four_bar
    >>> refuse_space(four_bar(), "a force polygon", "use solve")
    """
    if m.dimension == 3:
        raise ModelError(f"{what} is for planar mechanisms, but this one is in space", instead, ("space",))
