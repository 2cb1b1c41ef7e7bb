"""The careful path's answer beside the usual one, and which of the two ways the usual one came."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis import one_pass
from dalembert.analysis.result.result import Result

ARRAYS = (
    *("point_array", "turn_array", "rotation_array", "twist_array", "acceleration_array"),
    *("force_array", "moment_array", "effort_array", "load_array"),
)


@contextmanager
def counted() -> Iterator[list[bool]]:
    """For each analysis in here, whether a kept program has answered it."""
    ways: list[bool] = []
    own = one_pass.quick_answer

    def quick_answer(*given: Any) -> Any:
        found = own(*given)
        ways.append(isinstance(found, Result))
        return found

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(one_pass, "quick_answer", quick_answer)
        yield ways


def difference(r: Any, s: Any) -> float:
    """Largest difference of two answers over the largest value of its kind (forces, turns in radians, ...)."""
    assert (r.status, r.reasons, r.mode, r.mobility) == (s.status, s.reasons, s.mode, s.mobility)
    length = s.compiled.layout.length
    force = np.nanmax(np.abs(s.force_array), initial=0.0)
    least = {
        "force_array": force,
        "effort_array": force * min(length, 1.0),
        "load_array": force * min(length, 1.0),
    }
    least |= {"moment_array": force * length, "turn_array": 1.0, "rotation_array": 1.0, "point_array": length}
    worst = 0.0
    for name in ARRAYS:
        mine, other = getattr(r, name), getattr(s, name)
        assert mine.shape == other.shape
        assert (np.isnan(mine) == np.isnan(other)).all()
        off = np.nanmax(np.abs(mine - other), initial=0.0)
        size = max(np.nanmax(np.abs(other), initial=0.0), least.get(name, 0.0), 1e-300)
        worst = max(worst, float(off / size) if off else 0.0)
    return worst


def both(m: Any, static: bool = False) -> tuple[float, bool]:
    """Difference of both answers, and whether a kept program gave the usual one."""
    run = da.statics if static else da.dynamics
    with counted() as ways:
        usual = run(m)
    careful = run(m, method="careful")
    assert np.nanmax(usual.residual, initial=0.0) < 1e-9
    return difference(usual, careful), ways == [True]
