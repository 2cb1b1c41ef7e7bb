"""Arrangement of the forces of a system: collinear, concurrent, parallel, coplanar."""

from __future__ import annotations

import numpy as np

from dalembert.algebra.lines import meeting_point
from dalembert.arrays import Array
from dalembert.bounds import require
from dalembert.errors import AnalysisError
from dalembert.wrench.forces import Axis
from dalembert.wrench.reading import read_only
from dalembert.wrench.system import EXACT, System


def arrangement(system: System, tolerance: float = EXACT) -> str:
    """Arrangement of the lines of action: the most special term that holds.

    `no forces`, `collinear`, `concurrent`, `parallel`, `coplanar` (in space), `general`. Couples do not count.

    >>> from dalembert.wrench import Force, System
    >>> arrangement(System(Force([1, 0], at=[0, 1]), Force([0, 2], at=[3, 0]), Force([1, 1], at=[5, 3])))
    'concurrent'
    """
    require("tolerance", tolerance)
    lines = _lines(system)
    if not lines:
        return "no forces"
    if _parallel(lines, tolerance):
        limit = tolerance * system.length
        same = all(lines[0].distance(line.point) <= limit for line in lines)
        return "collinear" if same else "parallel"
    if concurrency(system, tolerance) is not None:
        return "concurrent"
    if system.dimension == 3 and _coplanar(lines, tolerance):
        return "coplanar"
    return "general"


def concurrency(system: System, tolerance: float = EXACT) -> Array | None:
    """The point (m) where all lines of action meet; None where they do not, or are parallel."""
    require("tolerance", tolerance)
    forces = [f for f in system.forces if f.size > 0]
    if len(forces) < 2:
        return None
    meeting = meeting_point(np.array([f.at for f in forces]), np.array([f.line.direction for f in forces]))
    if meeting is None:
        return None
    point, away = meeting
    reach = max(system.length, float(np.linalg.norm(point - system.middle)))
    return read_only(point) if away <= tolerance * reach else None


def parallel_center(system: System, tolerance: float = EXACT) -> Array:
    """The centre of parallel forces (m): sum of f r / sum of f; the resultant passes through it however they turn.

    Raises AnalysisError where the forces are not parallel, or their sum is zero.

    >>> from dalembert.wrench import Force, System
    >>> parallel_center(System(Force([0, -30], at=[0, 0]), Force([0, -10], at=[4, 0])))
    array([1., 0.])
    """
    require("tolerance", tolerance)
    lines = _lines(system)
    if not lines or not _parallel(lines, tolerance):
        raise AnalysisError("The forces are not parallel, so they have no centre. Ask for the central axis.")
    signed = np.array([f.vector @ lines[0].direction for f in system.forces])
    if abs(signed.sum()) <= tolerance * np.abs(signed).max():
        raise AnalysisError(
            "The parallel forces add to zero, so they have no centre. They are a couple or nothing."
        )
    middle = system.middle
    return read_only(middle + signed @ np.array([f.at - middle for f in system.forces]) / signed.sum())


def _lines(system: System) -> list[Axis]:
    return [f.line for f in system.forces if f.size > 0]


def _parallel(lines: list[Axis], tolerance: float) -> bool:
    first = lines[0].direction
    return all(np.linalg.norm(one.direction - (one.direction @ first) * first) <= tolerance for one in lines)


def _coplanar(lines: list[Axis], tolerance: float) -> bool:
    """True if one plane contains all points and directions: the least spread of both together is zero."""
    places = np.array([line.point for line in lines])
    away = places - places.mean(axis=0)
    reach = float(np.abs(away).max(initial=0.0)) or 1.0
    spread = np.linalg.svd(np.vstack([away / reach, [line.direction for line in lines]]), compute_uv=False)
    return bool(spread[-1] <= tolerance * spread[0])
