"""Other solutions of friction's equations than the physical one: Newton from many random starts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.fixed_point import contacts_in_motion
from dalembert.analysis.friction.joint_friction import unknown_names
from dalembert.arrays import Array
from dalembert.core.friction.contact_equations import repeat
from dalembert.core.friction.friction_solver import roots
from dalembert.errors import NUMBERED, ModelError

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


STARTS = 200
"""Starts of the search."""

DISTINCT = 1e-6
"""Solutions closer than this part of the largest force are one."""


@dataclass(frozen=True)
class Solution:
    """A solution of friction's equations: the unknowns by name, and det(A + J) / det(A)."""

    unknowns: dict[str, float]
    determinant: float


def other_solutions(r: Result, position: int = 0) -> list[Solution]:
    """Solutions at a position (counted from 0) beside the physical one, which the result has.

    Friction's equations may have several solutions where it is strong; the physical one is continued from no friction
    with a positive determinant ratio. Others are sought by Newton from 200 random starts, so some may be missed; none
    where the physical one is proved to be the only one. At a position that jams, all of them are returned.

    >>> import dalembert as da
    >>> m = da.slider_crank().with_values({"joints.B.friction": {"coefficient": 0.1, "radius": "10 mm"}})
    >>> other_solutions(da.statics(m), position=5)
    []
    """
    if r.friction is not None and bool(r.friction.single[position]):
        return []
    contacts, problem, sense = contacts_in_motion(r, position)
    rng = np.random.default_rng(0)
    size = np.abs(problem.y).max() * 10 ** rng.uniform(-1, 4, (STARTS, 1))
    starts = size * rng.uniform(-1, 1, (STARTS, contacts.count))
    z, x, determinant = roots(contacts, repeat(problem, STARTS), np.broadcast_to(sense, starts.shape), starts)
    z = np.where(contacts.fixed, 0.0, z)
    count, names = r.compiled.layout.constraints.count, unknown_names(r)
    assert r.friction is not None
    physical = r.friction.cz[position]
    kept: list[Array] = [] if np.isnan(physical).any() else [physical]
    solutions: list[Solution] = []
    for k in range(len(z)):
        if all(np.abs(z[k] - other).max() > DISTINCT * np.abs(other).max() for other in kept):
            kept.append(z[k])
            values = {name: float(v) for name, v in zip(names, x[k, count:], strict=True)}
            solutions.append(Solution(values, float(determinant[k])))
    return solutions


SOUGHT = (*NUMBERED, "jammed")
"""Statuses whose senses of friction are known."""


def every_other_solution(r: Result) -> dict[int, list[Solution]]:
    """Other solutions at each position (counted from 0) where the physical one is not proved to be the only one.

    Raises ModelError without friction: the equations are linear then.
    """
    if r.friction is None:
        raise ModelError(
            "without friction the equations are linear and have one solution", "do not ask for others"
        )
    doubtful = [k for k, s in enumerate(r.status) if s in SOUGHT and not r.friction.single[k]]
    return {k: other_solutions(r, k) for k in doubtful}
