"""Equilibria of a plane that turns: speeds at which their number changes, and small swings about them.

Mechanics: docs/theory.md 10.7.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.one_pass import at_schedule
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.elements.governors import at_rest, governor_drive, limits, statics_at
from dalembert.machine.flywheel.turning_moment import reduced_inertia
from dalembert.model import Mechanism, ModelOrPath, as_mechanism

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


@dataclass(frozen=True)
class TurningRange:
    """Speeds of turning at which the equilibria of a mechanism change, rad/s.

    bifurcation: speeds from which on links leave a place that they kept at every speed, at positions ``at``; folds:
    speeds at which two equilibria meet, extremes of the speed over the drive's range.

    >>> import dalembert as da
    >>> links = {"ground": {"points": {"O": [0, 0]}}, "bob": {"points": {"O": [0, 0]}, "mass": 2, "center": [0.5, 0]}}
    >>> drives = {"O": {"position": "unknown", "effort": 0, "range": ["-91 deg", "-1 deg"]}}
    >>> tree = {"gravity": "standard", "links": links, "joints": {"O": {"type": "pin", "links": ["ground", "bob"]}}}
    >>> m = da.mechanism({**tree, "drives": drives, "turning": {"speed": "8 rad/s"}})
    >>> round(da.turning_range(m).bifurcation[0], 3)    # rad/s
    4.429
    """

    bifurcation: tuple[float, ...]
    at: tuple[float, ...]
    folds: tuple[float, ...]


def turning_range(m: ModelOrPath, drive: str | None = None, count: int = 361) -> TurningRange:
    """Bifurcations and folds of the equilibria over the speed of turning, within the drive's range.

    >>> import dalembert as da
    >>> bar = {"type": "bar", "between": ["O", "B"], "area": "1 cm^2", "density": "7850 kg/m^3"}
    >>> links = {"ground": {"points": {"O": [0, 0]}}, "rod": {"points": {"O": [0, 0], "B": [0.6, 0]}, "shape": bar}}
    >>> drives = {"O": {"position": "unknown", "effort": 0, "range": ["-91 deg", "-1 deg"]}}
    >>> tree = {"gravity": "standard", "links": links, "joints": {"O": {"type": "pin", "links": ["ground", "rod"]}}}
    >>> da.turning_range(da.mechanism({**tree, "drives": drives, "turning": {"speed": "8 rad/s"}})).bifurcation[0]
    4.9514...
    """
    m = as_mechanism(m)
    name = governor_drive(m, drive)
    curve = _Efforts(m, name)
    q = np.linspace(*limits(m, name, None), count)
    loads, unit = curve(q)
    side = np.where(np.abs(unit) > 1e-9 * np.abs(unit).max(), np.sign(unit), 0.0)
    one, places = [], []
    for k in np.flatnonzero(np.append(side[:-1] * side[1:] < 0, False) | (side == 0)):
        x = _root(lambda x: curve(np.array([x]))[1][0], q[k], q[k + 1]) if side[k] else float(q[k])
        if abs(curve(np.array([x]))[0][0]) <= 1e-7 * np.abs(loads).max():
            square = curve.limit(x, q[1] - q[0])
            if square > 0:
                one.append(math.sqrt(square))
                places.append(x)
    with np.errstate(all="ignore"):
        squares = -loads / unit
    falls, beside = np.diff(squares) < 0, side[:-1] * side[1:] > 0
    folds = []
    for k in np.flatnonzero((falls[:-1] != falls[1:]) & beside[:-1] & beside[1:]):
        before, square, behind = squares[k : k + 3]
        square -= (behind - before) ** 2 / (before - 2 * square + behind) / 8  # the vertex of their parabola
        if square > 0:
            folds.append(math.sqrt(square))
    return TurningRange(tuple(one), tuple(places), tuple(folds))


class _Efforts:
    """Effort of a drive beyond the one given without turning, and its change per W^2, at positions."""

    def __init__(self, m: Mechanism, drive: str) -> None:
        self.drive, self.given = drive, float(m.drives[drive].effort or 0.0)  # type: ignore[arg-type]
        self.still, self.unit = (at_rest(m, drive, speed) for speed in (0.0, 1.0))

    def __call__(self, q: Array) -> tuple[Array, Array]:
        still, one = (statics_at(m, self.drive, q).effort(self.drive) for m in (self.still, self.unit))
        return still - self.given, one - still

    def limit(self, x: float, step: float) -> float:
        """W^2 beside a place where both vanish, by Richardson's extrapolation of both sides."""
        rows = []
        for k in range(4):
            h = step / 2**k
            loads, unit = self(np.array([x - h, x + h]))
            rows.append(float(-(loads[1] - loads[0]) / (unit[1] - unit[0])))
        return _extrapolated(rows)


def _extrapolated(rows: list[float]) -> float:
    """Central differences with steps that halve, to step 0 (Richardson)."""
    for order in (4, 16, 64):
        rows = [(order * b - a) / (order - 1) for a, b in pairwise(rows)]
    return rows[0]


def _root(function: Any, low: float, high: float) -> float:
    from scipy.optimize import brentq

    return float(brentq(function, low, high, xtol=1e-14))


def small_swings(r: Result) -> Array:
    """Frequencies, rad/s, of small free swings about the stable equilibrium positions of a result, in their order.

    The square is the slope of the effort over the reduced inertia of the drive that was unknown. Empty without a
    stable position. Raises ModelError for a result that is not of equilibrium positions.

    >>> import dalembert as da
    >>> links = {"ground": {"points": {"O": [0, 0]}}, "bob": {"points": {"O": [0, 0]}, "mass": 2, "center": [0.5, 0]}}
    >>> drives = {"O": {"position": "unknown", "effort": 0, "range": ["-150 deg", "-30 deg"]}}
    >>> tree = {"gravity": "standard", "links": links, "joints": {"O": {"type": "pin", "links": ["ground", "bob"]}}}
    >>> da.small_swings(da.statics(da.mechanism({**tree, "drives": drives}))).round(4).tolist()
    [4.4287]
    """
    if r.stability is None or r.schedule.unknown is None:
        raise ModelError(
            "these are not equilibrium positions", "give a drive position: unknown and its effort"
        )
    drive = r.schedule.unknown
    k = r.drives.index(drive)
    stable = [n for n, word in enumerate(r.stability) if word == "stable"]
    inertia, out = reduced_inertia(r, drive), []
    for n in stable:
        x, rows = r.drive_position(drive)[n], []
        schedule = replace(r.schedule, time=None)
        for step in (2e-2, 1e-2, 5e-3, 2.5e-3):
            position = schedule.position[[n, n]]
            position[:, k] = x + np.array([-step, step]) * (1.0 if r.mechanism.drives[drive].turns else 0.1)
            speed, rising = schedule.speed[[n, n]], schedule.acceleration[[n, n]]  # other drives go on
            here = replace(schedule, position=position, speed=speed, acceleration=rising)
            beside = at_schedule(r.mechanism, here, inertia=r.inertia)
            rows.append(float(np.diff(beside.effort(drive))[0] / np.diff(position[:, k])[0]))
        out.append(math.sqrt(max(_extrapolated(rows), 0.0) / inertia[n]))
    return np.array(out)
