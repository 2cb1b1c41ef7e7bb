"""A governor's speed over the height of its sleeve, with both ends of what friction holds."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.diagrams import curves_scene
from dalembert.views.paper.scene import Scene

if TYPE_CHECKING:
    from dalembert.machine.elements.governors import Governor

RPM = np.pi / 30


def governor_scene(g: Governor, notation: Notation | None = None) -> Scene:
    """Speed in rpm over the height."""
    shown = Shown(g.result, notation or Notation())
    x = g.height / shown.size("length")
    curves = {"speed": g.speed / RPM}
    if not np.array_equal(g.interval[:, 0], g.interval[:, 1], equal_nan=True):
        curves |= {"falls below": g.interval[:, 0] / RPM, "rises above": g.interval[:, 1] / RPM}
    label = f"Height of the sleeve in {shown.unit('length')}"
    return curves_scene(x, curves, label, "Speed in rpm", "Speed over the height", False)
