"""States of free motions that files prescribe: without a torque, of one energy, and where integrations have them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.oracles.jets import Jet
from tests.oracles.space import free_motion
from tests.oracles.space.free_motion import Solve
from tests.oracles.space.statics import Answer
from tests.tiers import tiers

import dalembert as da
from dalembert.model import load

CASES = Path(__file__).parents[2] / "cases"

SWINGING = ("sp-01-swinging-body-on-an-inclined-revolute", free_motion.swinging(), "J1", [0.0, 0.2, 0.5, 1.0])
CRANK = (
    "sp-12-spatial-slider-crank",
    free_motion.slider_crank(),
    "O",
    [0.0, 0.1, 0.2, 0.27, 0.3, 0.5, 1.0, 2.0, 5.0],
)

every_motion = pytest.mark.parametrize(("name", "solve", "drive", "times"), [SWINGING, CRANK])


def states(name: str) -> np.ndarray:
    """Position, speed and acceleration of the drive, a row each, as the file gives them."""
    found = load(CASES / f"{name}.yaml").schedule()
    return np.array([found.position[:, 0], found.speed[:, 0], found.acceleration[:, 0]])


def energy(answer: Answer) -> np.ndarray:
    """Kinetic and potential, J."""
    total = np.zeros(len(answer.poses[next(iter(answer.poses))].w))
    for link, body in answer.bodies.items():
        pose = answer.poses[link]
        center = pose.point(body.center)
        spin = np.einsum("...ji,...j->...i", pose.rotation.x, pose.w)
        total += 0.5 * body.mass * np.sum(center.v**2, -1) + 0.5 * np.sum(spin * (spin @ body.matrix), -1)
        total -= body.mass * center.x @ np.asarray(body.gravity)
    return total


@every_motion
def test_states_need_no_torque_and_keep_the_energy(
    name: str, solve: Solve, drive: str, times: list[float]
) -> None:
    answer = solve(Jet(*states(name)))
    assert len(answer.efforts[drive]) == len(times)
    np.testing.assert_allclose(answer.efforts[drive], 0.0, atol=1e-12 * answer.force_scale())
    np.testing.assert_allclose(energy(answer), energy(answer)[0], rtol=1e-12)


@pytest.mark.long
@every_motion
def test_states_are_reached_at_their_times(name: str, solve: Solve, drive: str, times: list[float]) -> None:
    until = [t for t in times if t <= 0.5]
    given = states(name)[:, : len(until)]
    found, _ = free_motion.moved(solve, drive, given[1, 0], np.array(until))
    np.testing.assert_allclose(found.T, given, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("last", tiers([2], [8]))
def test_a_simulation_reaches_them(last: int) -> None:
    """All states of the one, of the other those of the first 0.2 s; the whole 5 s in the long tier."""
    for name, _, _, times in (SWINGING, CRANK):
        m = load(CASES / f"{name}.yaml")
        drive = next(iter(m.drives))
        given, k = states(name), min(last, len(times) - 1) if name == CRANK[0] else len(times) - 1
        begin = {drive: {"position": float(given[0, 0]), "speed": float(given[1, 0])}}
        count = round(times[k] * 100) + 1
        s = da.simulate(m, f"{times[k]} s", start=begin, count=count)
        at = [int(np.argmin(np.abs(s.time - t))) for t in times[: k + 1]]
        found = np.array([s.position(drive), s.speed(drive), s.acceleration(drive)])[:, at]
        np.testing.assert_allclose(found, given[:, : k + 1], rtol=1e-8, atol=1e-8)
