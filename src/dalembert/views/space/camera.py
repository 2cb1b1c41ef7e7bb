"""An orthographic camera: projection of points in space onto paper, and their depth."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from dalembert.arrays import Array


@dataclass(frozen=True)
class Camera:
    """Orthographic view towards the origin; z is up on paper.

    ``azimuth`` is the angle of the eye in the xy plane from x towards y, ``elevation`` its angle above that plane
    (radians). Without numbers the view is isometric: x runs to the lower left, y to the lower right.

    >>> Camera()([[1, 0, 0], [0, 1, 0], [0, 0, 1]]).round(3)
    array([[-0.707, -0.408],
           [ 0.707, -0.408],
           [ 0.   ,  0.816]])
    """

    azimuth: float = math.pi / 4
    elevation: float = math.atan(1 / math.sqrt(2))

    @cached_property
    def right(self) -> Array:
        """Unit vector to the right of the paper."""
        return np.array([-math.sin(self.azimuth), math.cos(self.azimuth), 0.0])

    @cached_property
    def up(self) -> Array:
        """Unit vector up the paper."""
        return np.cross(self.eye, self.right)

    @cached_property
    def eye(self) -> Array:
        """Unit vector from the origin to the eye."""
        flat = math.cos(self.elevation)
        return np.array(
            [flat * math.cos(self.azimuth), flat * math.sin(self.azimuth), math.sin(self.elevation)]
        )

    @cached_property
    def _paper(self) -> Array:
        return np.stack([self.right, self.up], axis=-1)

    def __call__(self, points: ArrayLike) -> Array:
        """Places (..., 3) on paper (..., 2); vectors too, since the camera is linear."""
        return np.asarray(np.asarray(points, float) @ self._paper)

    def depth(self, points: ArrayLike) -> Array:
        """Nearness to the eye of places (..., 3): larger is nearer."""
        return np.asarray(np.asarray(points, float) @ self.eye)

    def order(self, points: Sequence[ArrayLike]) -> list[int]:
        """Indices of objects at some places, the farthest first: drawn in this order, near ones cover far ones.

        >>> Camera().order([[1, 1, 1], [0, 0, 0], [2, 2, 2]])
        [1, 0, 2]
        """
        return [int(k) for k in np.argsort(self.depth(np.asarray(points)), kind="stable")]


ISOMETRIC = Camera()
CAMERAS = {
    "isometric": ISOMETRIC,
    "front": Camera(-math.pi / 2, 0.0),
    "side": Camera(0.0, 0.0),
    "top": Camera(-math.pi / 2, math.pi / 2),
}
"""Views by name: from the front x is to the right and z up, from the side y and z, from the top x and y."""
