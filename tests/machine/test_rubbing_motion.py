"""Motions with dry friction in machine code: the same as those of the solution in numpy, and laws."""

from __future__ import annotations

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.motion.coded import traced_friction
from dalembert.machine.motion.coded.coded_motion import CodedState
from tests.machine.rubbing_machines import machine
from tests.tiers import tiers

TIME = 1e-9
"""Largest difference between the times of an event."""


def in_numpy(m: da.Mechanism, until: str, monkeypatch: pytest.MonkeyPatch) -> da.Simulation:
    """The motion without machine code for its friction."""
    with monkeypatch.context() as patch:
        patch.setattr(CodedState, "machine", lambda state, t, y: None)
        return da.simulate(m, until, count=11)


@pytest.mark.parametrize("seed", tiers([2, 3], [0, 1, 4, 5, *range(8, 18)], [*range(18, 200)]))
def test_it_is_that_of_the_solution_in_numpy(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    m = da.mechanism(machine(seed))
    s, known = da.simulate(m, "0.4 s", count=11), in_numpy(m, "0.4 s", monkeypatch)
    assert s.status == known.status
    assert [(e.name, e.of) for e in s.events] == [(e.name, e.of) for e in known.events]
    assert max(s.energy_residual, s.law_residual) < 1e-9 or s.status == "stopped"
    if s.status == "stopped":  # where exactly the steps become too small is rounding
        assert s.ended.partition(":")[2] == known.ended.partition(":")[2]
        return
    assert [e.time for e in s.events] == pytest.approx([e.time for e in known.events], abs=TIME)
    for one, other in ((s.schedule, known.schedule), (s, known)):
        for name in ("position", "speed") if one is s.schedule else ("time", "applied"):
            assert getattr(one, name) == pytest.approx(getattr(other, name), rel=1e-7, abs=1e-8)
    assert s.schedule.parts is not None
    assert np.asarray(s.schedule.parts) == pytest.approx(known.schedule.parts, abs=1e-6, nan_ok=True)
    assert s.evaluations < known.evaluations


def test_what_is_not_sure_in_machine_code_goes_to_the_solution_in_numpy(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Nothing is sure here: all is as without machine code, and no instant is without numbers."""
    m = da.mechanism(machine(18))
    monkeypatch.setattr(traced_friction, "_sure", lambda graph, flags: flags.slips[0].positive() * 0.25)
    s, known = da.simulate(m, "0.2 s", count=11), in_numpy(m, "0.2 s", monkeypatch)
    assert s.evaluations > 100
    assert [(e.name, e.time) for e in s.events] == [
        (e.name, pytest.approx(e.time, abs=TIME)) for e in known.events
    ]
    assert s.acceleration("O") == pytest.approx(known.acceleration("O"), rel=1e-7)
    assert max(s.energy_residual, s.law_residual) < 1e-9
