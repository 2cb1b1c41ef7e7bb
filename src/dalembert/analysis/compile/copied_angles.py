"""Angles of copies as images of the originals' angles, and the drives' positions where they are."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.model.files.copies.likeness import Likeness

Counted = int | str
"""An angle: a freedom's row, or a link."""


class CopiedAngle(NamedTuple):
    """side times the angle of the original plus an offset, radians, in the image's position."""

    original: Counted
    offset: float
    alike: Likeness

    def drives(self, c: Compiled, at: Array) -> Array:
        """The drives' positions (D,) of the image, where the original's are ``at``."""
        new, names = at.copy(), list(c.schedule.names)
        for k, name in enumerate(names):
            joint = c.mechanism.joints[c.mechanism.drive_joint(name)]
            original = self.alike.drives.get(name)
            copied = original is not None or not any(name in other.drives for other in c.mechanism.likenesses)
            if not copied or name in self.alike.drives.values():
                continue
            value = at[k if original is None else names.index(original)]
            more = (self.alike.staying if original is None else self.alike.between)(*joint.links)
            angular = c.layout.freedoms.angular[c.layout.driven[k]]
            new[k] = self.alike.side * value + more if angular else value
        return np.asarray(new)


def copied_angle(c: Compiled, angle: Counted) -> CopiedAngle | None:
    """The original of an angle; None if it is not a copy."""
    for alike in c.mechanism.likenesses:
        if isinstance(angle, str):
            if angle in alike.links:
                return CopiedAngle(alike.links[angle], alike.offsets.get(GROUND, 0.0), alike)
            continue
        joint, freedom = c.freedoms[angle]
        if joint in alike.joints:
            original = c.freedoms.index((alike.joints[joint], freedom))
            return CopiedAngle(original, alike.between(*c.mechanism.joints[joint].links), alike)
    return None
