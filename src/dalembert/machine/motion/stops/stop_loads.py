"""Forces of stops: on drives as an effort, on joints as loads of the analysis, so that all joint forces include them.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.arrays import Array
from dalembert.core.constraints import system
from dalembert.machine.motion.actuation import Actuation, joint_stops
from dalembert.model import GROUND
from dalembert.model.load_types import Couple, ForceLoad, Load
from dalembert.model.quantities.tables import Table

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

ROUNDS, SAME = 40, 1e-13
"""Iterations of the forces of stops with friction, which depends on them; and a change that is rounding."""


def stop_effort(r: Result, pushed: Array, brake: Array) -> Array:
    """Forces (T, D) of stops on drives that rest on them, ``pushed`` by these efforts: the part that friction and a
    ``brake`` (D,) do not hold."""
    out = np.zeros_like(pushed)
    for k in np.flatnonzero(np.isfinite(pushed).any(axis=0)):
        held = np.clip(pushed[:, k], *_holding(r, int(k), brake))
        out[:, k] = np.where(np.isfinite(pushed[:, k]), held - pushed[:, k], 0.0)
    return out


def _holding(r: Result, k: int, brake: Array) -> tuple[Array, Array]:
    """Least and greatest effort (T,) with which a drive stays, its brake included."""
    ends = r.interval(r.drives[k]) if r.friction is not None else r.effort_array[:, [k, k]]
    low, high = np.where(np.isnan(ends), r.effort_array[:, [k, k]], ends).T
    return low - brake[k], high + brake[k]


def with_stop_loads(
    r: Result, stop_forces: Array, pushed: Array, moves: Actuation
) -> tuple[Result, dict[str, Array]]:
    """The analysis with the forces of joints' stops, and these (T,) by joint: ``stop_forces`` (T, J, 2) from
    ``StopState.joint_forces``. Where one drive is at rest it is the least force: friction holds as much as it can."""
    m, names = r.mechanism, list(joint_stops(r.mechanism))
    time = tuple(np.asarray(r.schedule.time).tolist())

    def over_time(values: Array) -> Table:
        return Table("time", time, tuple(values.tolist()))

    force, ratio, loaded = stop_forces[..., 0], stop_forces[..., 1], r
    k, held = (
        int(np.argmax(moves.free)),
        np.cumsum(ratio != 0, axis=1) * (ratio != 0) == 1,
    )  # by the first of two
    sense = np.sign(-stop_effort(r, pushed, moves.brake)[:, k])
    for _ in range(ROUNDS if stop_forces.any() else 0):
        low, high = _holding(loaded, k, moves.brake)
        missing = np.where(sense > 0, high, low) - pushed[:, k]
        more = np.where(held & (sense != 0)[:, None], missing[:, None] / np.where(held, ratio, 1.0), 0.0)
        force = force + np.nan_to_num(more)
        loads = {**m.loads, **loads_of_stops(r, names, force, over_time)}
        loaded = at_schedule(m.model_copy(update={"loads": loads}), r.schedule, inertia=True)
        if not np.nanmax(np.abs(more)) > SAME * np.abs(force).max():
            break
    ends = {"gap_behind": ".behind", "gap_ahead": ".ahead"}
    return loaded, {joint + ends.get(freedom, ""): force[:, n] for n, (joint, freedom) in enumerate(names)}


def loads_of_stops(
    r: Result, names: list[tuple[str, str]], force: Array, value: Callable[[Array], Table | float]
) -> dict[str, Load]:
    """Forces along slides and couples about turns, on both links of each joint whose stop gives some; ``value`` of a
    load from numbers at the positions."""
    c, m = r.compiled, r.mechanism
    rows, d, out = (
        system(c.layout.algebra, c.layout.freedoms, full_pose(r)),
        c.layout.algebra.d,
        dict[str, Load](),
    )
    for k, (joint, freedom) in enumerate(names):
        if not force[:, k].any():
            continue
        row, part = c.freedoms.index((joint, freedom)), m.joints[joint]
        for link, other, point, wrench in zip(
            part.links, part.links[::-1], part.point_names(joint), (rows.on_i, rows.on_j), strict=True
        ):
            along = wrench[:, row, d:] if freedom == "turn" else wrench[:, row, :d]
            tables = tuple(map(value, np.nan_to_num(along * force[:, k, None]).T))
            by = GROUND if other == GROUND else None
            name = f"stop of {joint} on {link}"
            while name in m.loads:
                name += "'"
            if link == GROUND:
                continue
            if freedom == "turn":
                out[name] = Couple(on=link, value=tables if d == 3 else tables[0], by=by)
                continue
            out[name] = ForceLoad(on=link, at=point, value=tables, by=by)
            if freedom != "slide":  # it acts elsewhere: where j touches i, and at an end of a guide
                own, place = c.links.index(link), m.point(link, point)
                r_ = c.layout.algebra.rotate(
                    r.rotation_array[:, own], np.subtract(place, c.layout.reference[own])
                )
                more = wrench[:, row, d] - (r_[:, 0] * along[:, 1] - r_[:, 1] * along[:, 0])
                couple = value(np.nan_to_num(more * force[:, k]))
                out[name + " turns"] = Couple(on=link, value=couple, by=by)
    return out
