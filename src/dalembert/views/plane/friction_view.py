"""Friction alone: the circles with the lines of the reactions, then pins and guides at a larger scale."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dalembert.views.notation import Shown
from dalembert.views.paper.details import detail_scenes
from dalembert.views.paper.scene import Scene, stack_scenes
from dalembert.views.plane.mechanism_view import mechanism_scene
from dalembert.views.space.camera import Camera
from dalembert.views.space.space_mechanism import space_mechanism_scene

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def friction_scene(r: Result, k: int, shown: Shown, camera: Camera | None) -> Scene:
    """The mechanism with its friction circles and every joint with friction in detail, in words too."""
    if camera is not None:
        return space_mechanism_scene(r, k, camera, shown.notation)
    overview = mechanism_scene(r, k, shown.notation, details=False)
    return stack_scenes([overview, *detail_scenes(r, k, None, shown)], title=overview.title)
