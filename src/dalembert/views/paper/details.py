"""A drawing with its details: parts that are too small, drawn beside it at a larger scale."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.friction_circles import friction_circles, two_pins
from dalembert.model import GROUND
from dalembert.views.notation import Shown
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.paper.scene import Scene, stack_scenes
from dalembert.views.plane.circle_details import SEEN, pin_detail, with_friction_circle
from dalembert.views.plane.guide_details import guide_detail, with_rough_guide

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

ROW = 190.0
"""Width in mm of a drawing with its details."""


def detail_scenes(
    r: Result, k: int, frame: PaperFrame | None, shown: Shown, link: str | None = None, words: bool = True
) -> list[Scene]:
    """Pins whose friction circle is too small in a frame, and guides with friction; of one link, or of all.

    Without words only pins that are too small are drawn; with them, or without a frame, every pin.
    """
    joints = [n for n in r.joints if link is None or link in r.mechanism.joints[n].links]
    out = []
    for name in with_friction_circle(r, joints):
        small = frame is None or frame.length(float(friction_circles(r, name).radii[k])) < SEEN
        if (small or words) and np.isfinite(r.reaction(name)[k]).all():
            out.append(pin_detail(r, name, k, shown, link or _holder(r, name), words))
    return out + [
        guide_detail(r, n, k, shown, link or _holder(r, n), words) for n in with_rough_guide(r, joints)
    ]


def _holder(r: Result, joint: str) -> str:
    """The link whose reaction a detail shows: the one that two pins alone load, else j, unless that is ground."""
    two = two_pins(r, joint) if r.mechanism.joints[joint].hinge else None
    i, j = r.mechanism.joints[joint].links
    return two.link if two is not None else i if j == GROUND else j


def with_details(main: Scene, details: Sequence[Scene]) -> Scene:
    """A drawing and its details as one: side by side where they fit, else below."""
    if not details:
        return main
    full = stack_scenes([main, stack_scenes(details, width=ROW)], width=ROW, title=main.title)
    scales = dict(main.scales)
    for scene in details:
        scales |= scene.scales
    return Scene(full.items, main.title, scales, main.numbers)
