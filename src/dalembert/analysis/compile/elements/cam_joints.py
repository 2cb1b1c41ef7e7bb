"""Rows of cams in the plane, and the friction of their followers."""

from __future__ import annotations

import numpy as np

from dalembert.analysis.compile.elements.cam_limits import refuse_undercut
from dalembert.analysis.compile.elements.cam_motion import cam_motion
from dalembert.analysis.compile.elements.cam_shapes import CamShape, cam_shape
from dalembert.analysis.compile.plane_rows import RowBuilder
from dalembert.arrays import Array
from dalembert.core.elements.cam_curves import with_jumps
from dalembert.core.elements.cam_family import CamGap, CamRow
from dalembert.model import GROUND, Mechanism

Ends = tuple[int, int]


def add_cam(
    rows: RowBuilder, m: Mechanism, index: int, name: str, ends: Ends, arms: tuple[Array, Array]
) -> CamShape:
    """The row of a cam."""
    shape = cam_shape(m, name)
    if all(np.asarray(value).dtype != object for value in shape.numbers.values()):
        refuse_undercut(m, name)
    rows.add(CamGap if m.joints[name].gaps else CamRow, index, ends, **cam_numbers(shape, *arms))
    return shape


def cam_numbers(shape: CamShape, ui: Array, uj: Array) -> dict[str, object]:
    """Numbers of its row."""
    return {"ui": np.asarray(ui), "uj": np.asarray(uj), **shape.numbers, "curve": with_jumps(shape.curve)}


def follower_at_rest(m: Mechanism, name: str) -> tuple[float, tuple[float, float]] | None:
    """Angle of a follower guided on the ground, at half its lift, and the place of its point; None of others."""
    on = cam_shape(m, name).carrier
    if on is None or on.link != GROUND:
        return None
    c = cam_motion(m, name)
    at, turn = c.placed(np.array([c.middle]))
    center = np.array(m.joint_points(on.pin)[m.joints[on.pin].links.index(GROUND)])
    return float(turn[0]), (float(center[0] + at[0, 0]), float(center[1] + at[0, 1]))
