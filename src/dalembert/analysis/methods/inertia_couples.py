"""In space: the inertia couple of a link by Euler's equations, its gyroscopic part by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.arrays import Array

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


class Turning(NamedTuple):
    """Rotation of a link and its moments, all in link axes, in which its inertia J (3, 3) is constant.

    speed omega, acceleration alpha (P, 3); momentum J omega, rate J alpha, gyroscopic omega x J omega (P, 3).
    The inertia couple is -(rate + gyroscopic).
    """

    inertia: Array
    speed: Array
    acceleration: Array
    momentum: Array
    rate: Array
    gyroscopic: Array


def turning(r: Result, link: str) -> Turning:
    """Euler's equations of a link about its mass centre.

    >>> import dalembert as da
    >>> from dalembert.bundled import cases
    >>> r = da.dynamics(da.load(cases()["sp-04-spinning-disk-on-a-turning-arm"]))
    >>> (turning(r, "disk").gyroscopic[1] / (0.45359237 * 9.80665 * 0.0254)).round(2).tolist()  # lbf in
    [29.72, 0.0, 0.0]
    """
    inertia = inertia_matrix(r, link)
    unturn = np.swapaxes(r.rotation(link), -1, -2)
    speed, acceleration = ((unturn @ v[..., None])[..., 0] for v in (r.speed(link), r.acceleration(link)))
    momentum = speed @ inertia.T
    return Turning(
        inertia, speed, acceleration, momentum, acceleration @ inertia.T, np.cross(speed, momentum)
    )


def inertia_matrix(r: Result, link: str) -> Array:
    """Inertia of a link about its mass centre (3, 3), kg m2, in link axes."""
    inertia = r.compiled.forcing.inertia.inertia[..., r.links.index(link), :]
    return np.asarray(np.broadcast_to(inertia, (*inertia.shape[:-1], 9)).reshape(3, 3))
