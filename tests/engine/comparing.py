"""The careful path's answer beside the usual one, and which of the two ways the usual one came."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis import one_pass
from dalembert.analysis.engine import structures
from dalembert.analysis.result.result import Result

ARRAYS = (
    *("point_array", "turn_array", "rotation_array", "twist_array", "acceleration_array"),
    *("force_array", "moment_array", "effort_array", "load_array"),
)


FRICTION = (
    "force",
    "moment",
    "viscous_force",
    "viscous_moment",
    "dry_loss",
    "viscous_loss",
    "cz",
    "rate",
    "argument",
)
FRICTION_SAME = ("sense", "open", "reversing", "blocked", "locked", "critical")


@contextmanager
def counted() -> Iterator[list[str]]:
    """For each analysis in here, what kept programs have answered of it: all, its forces, or nothing."""
    ways: list[str] = []
    whole, forces = one_pass.quick_answer, one_pass.known_forces

    def quick_answer(*given: Any) -> Any:
        found = whole(*given)
        ways.append("all" if isinstance(found, Result) else "")
        return found

    def known_forces(*given: Any) -> Any:
        found = forces(*given)
        ways[-1] = "forces" if found is not None and found.sure.all() else ""
        return found

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(one_pass, "quick_answer", quick_answer)
        patch.setattr(one_pass, "known_forces", known_forces)
        patch.setattr(structures, "TRACE", 0.0)
        yield ways


def _without_rounding(sentence: str | None) -> str:
    """A sentence with figures that are rounding (1e-31 N m) as 0, which programs have there."""
    return re.sub(r"-?\d[.\d]*e-[2-9]\d", "0", sentence or "")


def difference(r: Any, s: Any) -> float:
    """Largest difference of two answers over the largest value of its kind (forces, turns in radians, ...)."""
    assert (r.status, r.mode, r.mobility) == (s.status, s.mode, s.mobility)
    assert [_without_rounding(x) for x in r.reasons] == [_without_rounding(x) for x in s.reasons]
    length = s.compiled.layout.length
    ends = [end for pair in s.ends for end in pair]
    force = max(np.nanmax(np.abs(one.force_array), initial=0.0) for one in (s, *ends))
    least = {
        "force_array": force,
        "effort_array": force * min(length, 1.0),
        "load_array": force * min(length, 1.0),
    }
    least |= {"moment_array": force * length, "turn_array": 1.0, "rotation_array": 1.0, "point_array": length}
    # Where links turn, an acceleration is a sum of terms of the size w^2 (and w v): where they cancel, as in a Hooke
    # joint whose shaft is at its fastest, what is left is their rounding, which has no figures to compare.
    twist = np.abs(s.twist_array)
    turning = np.nanmax(twist[..., s.mechanism.dimension :], initial=0.0)
    least["acceleration_array"] = turning * np.nanmax(twist, initial=0.0)
    worst = 0.0
    for name in ARRAYS:
        mine, other = getattr(r, name), getattr(s, name)
        assert mine.shape == other.shape
        assert (np.isnan(mine) == np.isnan(other)).all()
        off = np.nanmax(np.abs(mine - other), initial=0.0)
        size = max(np.nanmax(np.abs(other), initial=0.0), least.get(name, 0.0), 1e-300)
        worst = max(worst, float(off / size) if off else 0.0)
    assert (r.friction is None, r.after is None) == (s.friction is None, s.after is None)
    if r.after is not None:
        worst = max(worst, difference(r.after, s.after))
    if r.friction is None:
        return worst
    # of friction that bears nothing there is nothing but rounding to compare
    power = force * max(float(np.nanmax(twist, initial=0.0)), turning * length)
    least = {
        "force": force,
        "viscous_force": force,
        "moment": force * length,
        "viscous_moment": force * length,
        "dry_loss": power,
        "viscous_loss": power,
    }
    return max(worst, _friction_difference(r.friction, s.friction, least))


def _friction_difference(f: Any, g: Any, least: dict[str, float]) -> float:
    """Largest difference of what friction does, over the largest value of its kind, or the least size of it."""
    for name in FRICTION_SAME:
        assert np.array_equal(getattr(f, name), getattr(g, name), equal_nan=True), name
    assert (f.single >= g.single).all()  # programs prove more solutions to be the only ones
    worst = 0.0
    for name in FRICTION:
        mine, other = getattr(f, name), getattr(g, name)
        assert (np.isnan(mine) == np.isnan(other)).all(), name
        off = np.nanmax(np.abs(mine - other), initial=0.0)
        size = max(np.nanmax(np.abs(other), initial=0.0), least.get(name, 0.0))
        worst = max(worst, float(off / size) if off else 0.0)
    return worst


def both(m: Any, static: bool = False) -> tuple[float, str]:
    """Difference of both answers, and what of the usual one kept programs gave."""
    run = da.statics if static else da.dynamics
    with counted() as ways:
        usual = run(m)
    careful = run(m, method="careful")
    assert np.nanmax(usual.residual, initial=0.0) < 1e-9
    return difference(usual, careful), ways[0]
