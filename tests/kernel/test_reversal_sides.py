"""Positions where contacts reverse, answered by the kernel itself: both sides as the general executor has them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import dalembert as da
from tests.friction.engines import engine
from tests.kernel.comparing import changed, difference, frictional, general
from tests.kernel.machines import ROUGH
from tests.tiers import tiers


def reversing(m: Any) -> list[float]:
    """Positions of the drive where some contact's rate passes through zero, to the last digit."""
    r = da.dynamics(m)
    q, rate, (drive,) = r.schedule.position[:, 0], r.friction.rate, r.drives

    def at(position: float, e: int) -> float:
        return float(da.dynamics(m.with_values({f"drives.{drive}.position": position})).friction.rate[0, e])

    return sorted(
        brentq(at, q[k], q[k + 1], args=(e,), xtol=1e-15, rtol=4 * np.finfo(float).eps)
        for e in range(rate.shape[1])
        for k in np.flatnonzero(rate[:-1, e] * rate[1:, e] < 0)
    )


@pytest.mark.parametrize("name", tiers(["slider_crank"], [n for n in ROUGH if n != "slider_crank"]))
def test_both_sides_are_those_of_the_general_executor(name: str) -> None:
    m = ROUGH[name]()
    if len(m.drives) != 1 or not (places := reversing(m)):
        pytest.skip("nothing reverses within its motion")
    drive = next(iter(m.drives))
    there = m.with_values({f"drives.{drive}.position": places})
    k = da.compile(there, vary=frictional(m), static=False)
    r = k(np.stack([k.nominal, changed(k, 1, 0.0)]))
    assert r.redone == 0
    assert r.after is not None
    assert (r.status != "ok").all()
    for d in range(2):
        g = general(there, k, r.values[d])
        assert list(r.status[d]) == list(g.status)
        assert difference(k, r, d, g) < 1e-10
        assert difference(k, r.after, d, g.after) < 1e-10


@pytest.mark.parametrize("derivatives", tiers([True], [False]))
@pytest.mark.parametrize(
    "reduce", tiers(["peak", "mean"], ["rms", "envelope", "norm8", "refined_peak", "squares"])
)
def test_reductions_take_both_sides(reduce: str, derivatives: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """As those of the general executor, which is not asked; and the same bits for a design beside any others."""
    m = engine(position=list(range(0, 360, 30)))
    names = ["friction.coefficient", "joints.A.friction.radius"]
    k = da.compile(
        m, vary=names, outputs=["effort.O", "reaction.A"], reduce=reduce, static=True, derivatives=derivatives
    )
    values = k.nominal * np.array([[1, 1], [0.9, 1.1], [1.05, 0.8]])
    r, one = k(values), k(values[1])
    assert r.redone == 0
    for name in k.outputs:
        assert np.array_equal(r.arrays[name][1], one.arrays[name][0])
    from dalembert.analysis.batch import reversal_sides

    monkeypatch.setattr(reversal_sides, "settle_reversals", lambda *rest: None)
    g = k(values)
    assert g.redone == 3
    assert list(r.status) == list(g.status)
    for name, own in (*r.arrays.items(), *r.gradients.items()):
        other = (g.gradients if own is r.gradients.get(name) else g.arrays)[name]
        assert np.allclose(own, other, rtol=1e-11, atol=1e-11 * np.abs(other).max())


def test_a_machine_that_stands_still_keeps_its_interval() -> None:
    m = engine(position=[0, 45, 180])
    r = da.compile(m, vary=["drives.O.speed"], outputs=["effort.O"], static=True)([[0.0], [1.0]])
    assert list(r.status[0]) == ["at_rest"] * 3
    assert list(r.status[1]) == ["reversal", "ok", "reversal"]
