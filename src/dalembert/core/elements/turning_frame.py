"""The plane of a mechanism turns about a line in it: centrifugal wrenches on the links, and the speed that balances.

Coordinates from a point of the axis: x outward, along n, y along the axis, e. Each element of mass dm is pulled outward
by W^2 x dm, on a link m W^2 x_G at the mass centre and the couple -W^2 int x (y - y_G) dm = -W^2 n . J e, with J the
second moments of its mass about the centre. Coriolis and Euler forces are normal to the plane.

Mechanics: docs/theory.md 4.1.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from dalembert.arrays import Array
from dalembert.core.branchless import above, where
from dalembert.core.forcing import Forcing, Inertia, TurningFrame, WrenchSource, total_wrench
from dalembert.core.geometry import arm
from dalembert.core.layout import Layout, Pose

POWERLESS = 1e-12
"""Part of the power of all mass at the characteristic length below which that of centrifugal forces is none."""


def centrifugal(
    layout: Layout, inertia: Inertia, frame: TurningFrame, pose: Pose, square: Array
) -> WrenchSource:
    """Centrifugal wrenches on the links at the square of the speed (...)."""
    g, links, outward = layout.algebra, np.arange(layout.links), _outward(frame)
    r = arm(g, pose, links, inertia.center)
    square = np.asarray(square)[..., None]
    x = ((pose.point[..., :-1, :] + r - frame.at) * outward).sum(axis=-1)
    force = (inertia.mass * x * square)[..., None] * outward
    n, e = (_in_link(pose.rotation[..., :-1, :], v) for v in (outward, frame.axis))
    xx, yy, xy = np.moveaxis(frame.moments, -1, 0)
    product = n[0] * (xx * e[0] + xy * e[1]) + n[1] * (xy * e[0] + yy * e[1])
    moment = g.cross(r, force) - (product * square)[..., None]
    return WrenchSource(
        links, np.concatenate([np.broadcast_to(force, (*moment.shape[:-1], g.d)), moment], -1)
    )


def turning_square(
    layout: Layout, forcing: Forcing, pose: Pose, virtual: Array, sources: Mapping[str, WrenchSource]
) -> Array:
    """Square of the speed (...): as given, or that at which the effort of a drive is the one given.

    By virtual work at unit speed of that drive, P_0 + W^2 P_1 + effort = 0: negative where no speed balances, and not
    finite where P_1 is rounding beside that of all mass at the characteristic length.
    """
    frame = forcing.turning
    assert frame is not None
    if frame.driven < 0:
        return frame.square
    sources = {kind: source for kind, source in sources.items() if kind != "turning"}
    v = virtual[..., frame.driven, :-1, :]
    inertia = forcing.inertia
    unit = centrifugal(layout, inertia, frame, pose, np.ones(1))
    first, second = (
        (total_wrench(layout, *some) * v).sum(axis=(-2, -1)) for some in (sources.values(), (unit,))
    )
    heavy = inertia.mass.sum() * layout.length + np.abs(frame.moments).sum() / layout.length
    turns = layout.freedoms.angular[layout.driven[frame.driven]]
    limit = POWERLESS * heavy * (layout.length if turns else 1.0)
    second = where(above(second * second, limit * limit), second, 0.0)
    return np.asarray(-(first + frame.effort) * (1.0 / second))


def second_moment(layout: Layout, inertia: Inertia, frame: TurningFrame, pose: Pose) -> Array:
    """Moment of inertia of all links about the axis (...): sum (m x_G^2 + n . J n)."""
    outward = _outward(frame)
    r = arm(layout.algebra, pose, np.arange(layout.links), inertia.center)
    x = ((pose.point[..., :-1, :] + r - frame.at) * outward).sum(axis=-1)
    a, b = _in_link(pose.rotation[..., :-1, :], outward)
    xx, yy, xy = np.moveaxis(frame.moments, -1, 0)
    return np.asarray((inertia.mass * x * x + a * a * xx + b * b * yy + 2 * a * b * xy).sum(axis=-1))


def _outward(frame: TurningFrame) -> Array:
    """Unit vector across the axis, to the right of its direction."""
    return np.array([frame.axis[1], -frame.axis[0]])


def _in_link(rotation: Array, v: Array) -> tuple[Array, Array]:
    """Components of a vector in the axes of links with rotations (..., L, 2): cosine and sine."""
    c, s = rotation[..., 0], rotation[..., 1]
    return c * v[0] + s * v[1], c * v[1] - s * v[0]
