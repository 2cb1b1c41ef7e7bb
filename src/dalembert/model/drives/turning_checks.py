"""Requirements of a turning plane: gravity along its axis, a given effort where its speed is unknown."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from dalembert.errors import ModelError
from dalembert.model.drives.turning import UNKNOWN
from dalembert.model.quantities.figures import unit_vector
from dalembert.model.quantities.values import Vector

if TYPE_CHECKING:
    from dalembert.model.description import Mechanism

ALONG = 1e-9
"""Part of gravity across the axis that is rounding."""


def freed_drive(m: Mechanism) -> str | None:
    """The drive whose effort is given, where the speed of the turning frame is unknown."""
    if m.turning is None or m.turning.speed != UNKNOWN:
        return None
    known = [name for name, drive in m.drives.items() if drive.effort is not None]
    return known[0] if known else next(iter(m.drives), None)


def plane_moments(m: Mechanism, link: str) -> Vector:
    """int x x, y y, x y dm about the mass centre in link axes, kg m2; 0 of a link that is not a shape."""
    part = m.links[link]
    if not part.shapes:
        return (0.0, 0.0, 0.0)
    weighed = part.mass is not None or part.weight is not None
    (xx, xy, _), (_, yy, _), (_, _, zz) = part.mass_properties(m.mass(link) if weighed else None).inertia
    return (yy + zz - xx) / 2, (zz + xx - yy) / 2, -xy


def refuse_unsteady(m: Mechanism) -> None:
    """Raise ModelError where the plane does not turn at a known constant speed."""
    if m.turning is None or (m.turning.speed != UNKNOWN and not m.turning.acceleration):
        return
    key = "acceleration" if m.turning.speed != UNKNOWN else "speed"
    what = f"the {key} of turning is {'unknown' if key == 'speed' else 'not 0'}, and forces move the machine"
    raise ModelError(what, "give turning a constant speed", ("turning", key))


def turning_problems(m: Mechanism) -> Iterator[ModelError]:
    """Parts of a description that a frame that turns excludes."""
    if m.turning is None:
        return
    if m.dimension == 3:
        remedy = "in space join the frame to ground by a revolute, and drive it at this speed"
        yield ModelError("turning is for the plane", remedy, ("turning",))
        return
    if len(m.turning.at) != 2:
        yield ModelError("a point of the axis has 3 components", "write at: [x, y]", ("turning", "at"))
    c, s = unit_vector(m.turning.axis)
    gravity = m.gravity_vector
    if abs(s * gravity[0] - c * gravity[1]) > ALONG * math.hypot(*gravity):
        what = "gravity is not along the axis of turning, so that in the turning plane it goes round"
        yield ModelError(what, "turn about the line of gravity, or write gravity: none", ("turning", "axis"))
    if m.turning.speed == UNKNOWN:
        yield from _unknown_speed(m)


def _unknown_speed(m: Mechanism) -> Iterator[ModelError]:
    path = ("turning", "speed")
    known = [name for name, drive in m.drives.items() if drive.effort is not None]
    if not m.drives:
        remedy = "drive the sleeve with effort: 0, or give the speed"
        yield ModelError("the speed of turning is unknown, and no drive holds the mechanism", remedy, path)
    elif len(known) > 1 or (not known and len(m.drives) > 1):
        what = f"the speed of turning is unknown, and {len(known) or 'no'} efforts of the drives are given"
        yield ModelError(what, "give the effort of one drive, 0 for one that holds nothing", path)
    loads = [name for name, load in m.loads.items() if load.unknown]
    if loads:
        what = f"both the speed of turning and the load {loads[0]!r} are unknown"
        yield ModelError(what, "give one of them", path)
    for name, drive in m.drives.items():
        if drive.position == UNKNOWN:
            what = f"both the speed of turning and the position of drive {name!r} are unknown"
            yield ModelError(what, "give one of them", path)
