"""Forces against MuJoCo, from the MJCF files that are written: its inverse dynamics, and multipliers of the loops."""

from __future__ import annotations

import pytest

import dalembert as da
from dalembert.bundled import examples
from tests.tiers import tiers

mujoco = pytest.importorskip("mujoco")


@pytest.mark.parametrize("name", tiers(["rssr"], ["four_bar", "engine"]))
def test_torque_and_loop_forces_are_those_of_mujoco(name: str) -> None:
    from benchmarks.cross_check import compared

    found = compared(da.load(examples()[name]), 8)
    assert found.closed < 1e-14
    assert found.motion < 1e-11
    assert found.torque < 1e-12
    assert found.force < 1e-12
    # its soft constraints, and what mj_inverse makes of a closed loop, are other numbers
    assert 1e-7 < found.soft_force < 1e-2
    assert found.closed_torque > 0.1


@pytest.mark.long
def test_another_mass_is_seen() -> None:
    """The comparison tells a coupler that is 1 % heavier."""
    from benchmarks import cross_check

    m = da.load(examples()["four_bar"])
    heavy = m.with_values({"links.coupler.weight": "7.777 lbf"})
    closed = cross_check.ClosedModel(m)
    assert closed.model.body("coupler").mass[0] == pytest.approx(m.mass("coupler"), rel=1e-14)
    found = cross_check.compared(heavy, 8)
    assert found.torque < 1e-12
    assert abs(da.dynamics(heavy).effort("O2")[0] / da.dynamics(m).effort("O2")[0] - 1) > 1e-4
