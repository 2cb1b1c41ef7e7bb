"""Drawings of machine design: shaking forces, balance, flywheels.

In: an answer of ``machine``. Out: ``Scene``. Imports ``machine`` and what ``views`` imports.
"""

from __future__ import annotations

from typing import Any

from dalembert.views.notation import Notation
from dalembert.views.paper.scene import Scene


def scenes_of(answer: Any, notation: Notation | None = None) -> list[Scene]:
    """The drawings of an answer, by what it is."""
    from dalembert.machine.flywheel.flywheels import Flywheel
    from dalembert.views.machine.flywheel_views import flywheel_scenes
    from dalembert.views.machine.shaking_views import shaking_scenes

    return (
        flywheel_scenes(answer, notation)
        if isinstance(answer, Flywheel)
        else shaking_scenes(answer, notation)
    )
