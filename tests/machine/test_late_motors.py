"""Motors with a time constant: against closed forms, their own equation along random motions, and today's at 0."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import simpson

import dalembert as da
from dalembert.arrays import Array
from tests.tiers import over

INERTIA, STALL, FREE = 0.8, 40.0, 150.0
ROTOR = """units: {time: s}
links: {ground: {points: {O: [0, 0]}}, rotor: {points: {O: [0, 0]}, inertia: 0.8 kg*m^2}}
joints: {O: {type: pin, links: [ground, rotor]}}
drives: {O: {motor: {stall: 40 N*m, no_load: 150 rad/s, time_constant: 2 ms}}}
start: {O: {position: 0, speed: 0}}
"""


def run_up(tau: float, t: Array) -> tuple[Array, Array]:
    """Speed and torque of a flywheel from rest: J w'' + J w'/tau + T0/(w0 tau) w = T0/tau."""
    p = np.roots([1.0, 1 / tau, STALL / (FREE * INERTIA * tau)]).astype(complex)
    c = np.linalg.solve([[1.0, 1.0], p], [-FREE, 0.0])
    e = np.exp(np.multiply.outer(t, p))
    return (FREE + e @ c).real, (INERTIA * (e * p) @ c).real


@pytest.mark.parametrize(("tau", "until"), [(2e-3, 0.3), (0.5, 2.0), (5.0, 20.0)])
def test_a_flywheel_runs_up_as_in_closed_form(tau: float, until: float) -> None:
    s = da.simulate(da.loads(ROTOR.replace("2 ms", f"{tau} s")), until)
    speed, torque = run_up(tau, s.time)
    assert (s.speed("O").max() > FREE) == (tau == 5.0)  # it swings past its free speed
    assert s.speed("O") == pytest.approx(speed, abs=1e-9 * FREE)
    assert s.applied[:, 0] == pytest.approx(torque, abs=1e-9 * STALL)
    assert max(s.energy_residual, s.law_residual) < 1e-9


def test_its_torque_builds_up_while_a_brake_holds_it_and_decays_switched_off() -> None:
    text = ROTOR.replace("2 ms}", "50 ms, on: 0.1 s, off: 0.3 s}, brake: 3 N*m")
    s = da.simulate(da.loads(text), "3 s")
    begin = 0.1 - 0.05 * np.log(1 - 3 / STALL)
    assert [e.name for e in s.events] == ["rest", "motor on", "start", "motor off", "rest"]
    assert s.events[2].time == pytest.approx(begin, rel=1e-9)
    assert s.event("motor off")[0].time == 0.3
    last = s.events[3].time
    k = np.flatnonzero((s.time >= last) & (s.time < s.events[4].time))
    driven, decay = s.applied[k, 0] + 3.0, np.exp(-(s.time[k] - last) / 0.05)
    assert driven == pytest.approx(driven[0] * decay, abs=1e-9 * STALL)
    assert max(s.energy_residual, s.law_residual) < 1e-9
    held = da.simulate(da.loads(text.replace("brake: 3", "brake: 45")), "3 s")
    assert held.ended.startswith("at rest from ")
    assert held.position("O")[-1] == 0


@over(quick=0, whole=40)
def test_along_a_motion_it_follows_its_line(seed: int) -> None:
    """Of a crank with links on it, behind a gear with losses: T(t) = integral of (line - T)/tau, and, for a short time
    constant, nearly the motion without one, by a difference in proportion to it."""
    rng = np.random.default_rng(seed)
    tau = 10 ** rng.uniform(-2, -1)
    m, start = da.four_bar(positions=1), {"O2": {"position": "60 deg", "speed": 0}}
    motor = {
        "stall": rng.uniform(6, 12),
        "no_load": 300.0,
        "ratio": 9.0,
        "inertia": "2e-4 kg*m^2",
        "efficiency": 0.9,
    }

    def moved(late: float, count: int = 3) -> da.Simulation:
        motors = {"drives.O2.motor": motor | ({"time_constant": f"{late} s"} if late else {})}
        return da.simulate(m.with_values(motors), "0.1 s", start, count=count)

    s = moved(tau, 501)
    use = s.motor["O2"]
    rate = (motor["stall"] * (1 - use.speed / 300.0) - use.torque) / tau  # type: ignore[operator]
    assert use.torque[0] == pytest.approx(0.0, abs=1e-9)
    # Simpson's rule meets a corner where the crank reverses
    assert use.torque[-1] == pytest.approx(simpson(rate, x=s.time), abs=1e-6 * np.abs(use.torque).max())
    assert max(s.energy_residual, s.law_residual) < 1e-9
    at_once, *short = (moved(late).position("O2")[-1] for late in (0.0, 1e-3, 1e-4))
    far, near = (abs(x - at_once) for x in short)
    assert near < 0.12 * far < 1e-2


def test_a_negative_one_is_refused() -> None:
    with pytest.raises(
        da.ModelError, match=r"m\.yaml:4: time_constant of motor of drive 'O': the time constant"
    ):
        da.loads(ROTOR.replace("2 ms", "-2 ms"), name="m.yaml")
