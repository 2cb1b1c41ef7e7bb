"""Cams that cannot be made: undercut places, and the sizes from which on there are none."""

from __future__ import annotations

import math

import numpy as np

from dalembert.algebra.extremes import least_within
from dalembert.analysis.compile.elements.cam_motion import CamMotion, cam_motion
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model import Mechanism

PLACES = 721
"""Turns at which a profile is looked at."""
FEW = 4
"""Places that are looked at more closely."""
NEAR = 1e-3
"""Part of the base radius below which the least radius is looked at between places."""
ENOUGH = 1e-9
"""Part of a radius that two may differ by."""


def worst_radius(c: CamMotion, turns: Array) -> Array:
    """Radius (N,) that must not be below 0: of the cam where the follower's curve is convex, else infinite."""
    curvature = c.curvature(turns, c.at(turns))
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = 1.0 / curvature
    if c.joint.flat:
        return np.asarray(np.where(curvature > 0, radius, np.where(curvature < 0, radius, np.inf)))
    return np.asarray(np.where(curvature > 0, radius - c.joint.follower.roller, np.inf))


def refuse_undercut(m: Mechanism, name: str) -> None:
    """Raise ModelError for a profile by lift that the follower would undercut."""
    if m.joints[name].profile.segments is None:  # type: ignore[union-attr]
        return
    c = cam_motion(m, name)
    if c.joint.follower.kind == "knife":
        return
    turns = c.turns(PLACES)
    worst = worst_radius(c, turns)
    bad = np.flatnonzero(worst < -ENOUGH * _base(c))
    if not bad.size:
        return
    run = np.split(bad, np.flatnonzero(np.diff(bad) > 1) + 1)[0]
    low, high = (f"{math.degrees(turns[k]):.4g}" for k in (run[0], run[-1]))
    least = least_size(m, name, c)[0]
    size = f"a base radius from {least * 1e3:.6g} mm on" if np.isfinite(least) else "a smaller lift"
    where = f"cam {name!r} is undercut from {low} to {high} deg of its turn"
    path = ("joints", name, "profile")
    if c.joint.flat:
        raise ModelError(
            f"{where}: the outline that a flat face needs turns back on itself", f"take {size}", path
        )
    radius = float(worst[run].min()) + c.joint.follower.roller
    raise ModelError(
        f"{where}: the curve of the roller's centre has a radius of {radius * 1e3:.4g} mm there, and the roller "
        f"{c.joint.follower.roller * 1e3:.4g} mm",
        f"take {size}, or a roller up to {radius * 1e3:.4g} mm",
        path,
    )


def _base(c: CamMotion) -> float:
    p = c.joint.profile
    return float(p.base if p.base is not None else (p.prime or 0.0) - c.joint.follower.roller)


def least_size(m: Mechanism, name: str, c: CamMotion) -> tuple[float, float]:
    """Base radius from which on the cam is not undercut, m, and the turn (rad) at which a smaller one is first."""
    from scipy.optimize import brentq

    if c.joint.profile.segments is None:
        return math.nan, math.nan
    turns = np.sort([*c.turns(PLACES), *(c.joins - 1e-8)])

    def worst(base: float, sign_only: bool = False) -> tuple[float, float]:
        other = _with_base(m, name, base)
        values = worst_radius(other, turns)
        left, right, k = np.roll(values, 1), np.roll(values, -1), int(np.argmin(values))
        out = [(float(values[k]), float(turns[k]))]
        near = max(NEAR * base, float(max(left[k], right[k]) - values[k]))
        if sign_only and abs(out[0][0]) > near:
            return out[0]
        bends = np.maximum(left, right) > values + ENOUGH * base  # not within a dwell
        low = np.flatnonzero((values <= left) & (values <= right) & (values <= values[k] + near) & bends)[
            :FEW
        ]
        least, at = least_within(
            lambda t: worst_radius(other, t),
            turns[np.maximum(low - 1, 0)],
            turns[np.minimum(low + 1, len(turns) - 1)],
        )
        out += zip(least.tolist(), at.tolist(), strict=True)
        smallest = min(value for value, _ in out)
        return smallest, min(at for value, at in out if value <= smallest + ENOUGH * base)

    def margin(base: float) -> float:
        try:
            return worst(base, sign_only=True)[0]
        except ModelError:  # too small for the offset or the arm
            return -base

    high = _base(c)
    for _ in range(60):
        if margin(high) >= 0:
            break
        high *= 1.5
    else:
        return math.inf, math.nan
    low = high
    for _ in range(60):
        low *= 0.7
        if margin(low) < 0:
            break
    else:
        return 0.0, math.nan
    base = float(brentq(margin, low, high, xtol=1e-15, rtol=1e-13))
    try:
        return base, worst(base * (1 + 1e-12))[1]
    except ModelError:
        return base, math.nan


def _with_base(m: Mechanism, name: str, base: float) -> CamMotion:
    joint = m.joints[name]
    profile = joint.profile.model_copy(update={"base": base, "prime": None})  # type: ignore[union-attr]
    return cam_motion(
        m.model_copy(update={"joints": {**m.joints, name: joint.model_copy(update={"profile": profile})}}),
        name,
    )
