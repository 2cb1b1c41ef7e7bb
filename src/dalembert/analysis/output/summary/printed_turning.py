"""Printed speed of a plane that turns, and what its centrifugal forces leave out."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array
from dalembert.model.drives.turning import LINES, UNKNOWN
from dalembert.model.links.link import GROUND
from dalembert.printing import number, wrap

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism

RPM = math.pi / 30


def turning_note(m: Mechanism) -> dict[str, str]:
    """Rotation of the turning plane, and links whose inertia about the axis is not known; empty where it does not."""
    if m.turning is None:
        return {}
    axis = {direction: name for name, direction in LINES.items()}.get(m.turning.axis)
    line = f"the {axis} axis" if axis else f"a line at {number(math.degrees(m.turning.axis))} deg"
    if any(m.turning.at):
        line += f" through [{number(m.turning.at[0])}, {number(m.turning.at[1])}] m"
    how = (
        "at the speed that balances"
        if m.turning.speed == UNKNOWN
        else f"at {number(float(m.turning.speed) / RPM)} rpm"
    )
    points = [name for name in m.links if name != GROUND and not m.links[name].shapes and m.inertia(name)]
    lumped = f"; {', '.join(points)} as points, inertia about the axis left out" if points else ""
    return {"turning": f"about {line} {how}{lumped}"}


def turning_text(result: Result) -> str:
    """The speed of a single position in words; empty where the plane does not turn."""
    if result.mechanism.turning is None:
        return ""
    (low, high), speed = result.turning_interval[0], float(result.turning_speed[0])
    if not math.isfinite(speed):
        return ""
    text = f"The plane turns at {number(speed / RPM, 6)} rpm ({number(speed, 6)} rad/s)."
    if result.mechanism.turning.speed == UNKNOWN and high - low > 1e-12 * high:
        ends = f"{number(low / RPM, 6)} to {number(high / RPM, 6)} rpm"
        text = f"The plane may turn at {ends}: friction holds the machine; without it at {number(speed / RPM, 6)} rpm."
    return wrap(text)


def turning_columns(result: Result) -> list[tuple[str, str, Array]]:
    """Name, kind and values of the speeds of a frame, beside those of the drives."""
    if result.mechanism.turning is None or result.mechanism.turning.speed != UNKNOWN:
        return []
    low, high = result.turning_interval.T
    if np.array_equal(low, high, equal_nan=True):
        return [("turning", "angular_speed", result.turning_speed)]
    return [("turning low", "angular_speed", low), ("turning high", "angular_speed", high)]
