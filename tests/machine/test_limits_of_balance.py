"""Balance, rotors, the book's series and checks of motions at the limits of what they tell apart."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.balance.rotors import RotorBalance
from dalembert.machine.motion.energies import DOUBT, MotionChecks

UNKNOWN: Any = None


@pytest.mark.parametrize(
    ("planes", "reach"),
    [
        ((0.1, 0.4), 0.4),
        ((0.4, 0.1), 0.4),
        ((-0.2, 0.5), 0.7),
        ((0.5, -0.2), 0.7),
        ((-0.5, -0.1), 0.5),
        ((-0.1, -0.5), 0.5),
    ],
)
def test_what_a_rotor_has_left_counts_at_the_farthest_place_of_its_planes(
    planes: tuple[float, float], reach: float
) -> None:
    """The larger of the force and the couple over that distance, beside both corrections."""

    def left(force: complex, couple: complex, moment: tuple[float, float] = (0.3, 0.2)) -> float:
        both = np.array(moment)
        return RotorBalance(
            UNKNOWN, "shaft", planes, (0j, 0j), both, both, both, both, "x", (force, couple), UNKNOWN, UNKNOWN
        ).residual

    assert left(0j, 3e-3 + 4e-3j) == pytest.approx(5e-3 / reach / 0.5)
    assert left(-3e-3 + 4e-3j, 1e-4j) == pytest.approx(5e-3 / 0.5)
    assert left(1.0, 1.0, (0.0, 0.0)) == 0.0
    assert left(0j, 1e-3, (0.0, 0.2)) == pytest.approx(1e-3 / reach / 0.2)


FOUR_BAR = {
    "ground": {"points": {"O2": [0, 0], "O4": [0.2, 0]}},
    "crank": {"points": {"O2": [0, 0], "A": [0.05, 0]}, "mass": 1, "center": [0.02, 0], "inertia": 1e-3},
    "coupler": {"points": {"A": [0, 0], "B": [0.2, 0]}, "mass": 2, "center": [0.1, 0.02], "inertia": 1e-2},
    "rocker": {"points": {"O4": [0, 0], "B": [0.12, 0]}, "mass": 1, "center": [0.05, 0], "inertia": 2e-3},
}


@pytest.mark.parametrize("order", [["crank", "coupler", "rocker"], ["rocker", "coupler", "crank"]])
def test_a_missing_counterweight_belongs_on_a_link_with_a_pivot_in_whatever_order_they_are_written(
    order: list[str],
) -> None:
    """One on the coupler would do as well, but not one on the crank alone."""
    pins = {
        "O2": ["ground", "crank"],
        "A": ["crank", "coupler"],
        "B": ["coupler", "rocker"],
        "O4": ["ground", "rocker"],
    }
    m = da.mechanism(
        {
            "links": {name: FOUR_BAR[name] for name in ("ground", *order)},
            "joints": {name: {"type": "pin", "links": links} for name, links in pins.items()},
            "drives": {"O2": {"position": {"from": 0, "to": 330, "count": 12}, "speed": "10 rad/s"}},
            "assembly": {"coupler": "40 deg", "rocker": "90 deg"},
        }
    )
    assert da.balance(m, ["crank"]).missing() == ["rocker"]
    assert da.balance(m, {"crank": {}, "coupler": {"radius": 0.5, "mass": 500}}).complete
    assert da.balance(m, ["rocker"]).missing() == ["crank"]


INCLINED = """
links:
  ground: {points: {O: [0.3, -0.1], C: [%r, %r]}}
  crank: {points: {O: [0, 0], A: [0.05, 0]}, mass: 0}
  rod: {points: {A: [0, 0], B: [0.2, 0]}, mass: 0.4, center: [0.05, 0], inertia: 1e-3}
  piston: {points: {B: [0, 0]}, mass: 0.6}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  S: {type: slider, links: [ground, piston], at: [C, B], direction: %r}
drives: {O: {position: {from: 10, to: 370, count: 12}, speed: 40 rad/s}}
assembly: {rod: %r, piston: [%r, %r, 0]}
units: {angle: rad}
"""


def inclined(turn: float, aside: float) -> Any:
    """An engine whose cylinder is turned by an angle, and moved aside."""
    u, v = np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])
    place, guess = np.array([0.3, -0.1]) + aside * v, np.array([0.3, -0.1]) + 0.24 * u + aside * v
    text = INCLINED % (*place.tolist(), turn, turn, *guess.tolist())
    text = text.replace("from: 10, to: 370", f"from: {turn + 0.2!r}, to: {turn + 0.2 + 2 * np.pi!r}")
    return da.dynamics(da.loads(text))


@pytest.mark.parametrize("turn", [0.5, 0.25 * np.pi, 2.2, -2.0])
def test_an_inclined_cylinder_has_the_series_of_a_level_one(turn: float) -> None:
    """Its force is turned with it; a line that misses the crank on either side, by more than rounding, has none."""
    c, s = np.cos(turn), np.sin(turn)
    force = da.engine_series(inclined(turn, 0.0)).force
    level = da.engine_series(inclined(0.0, 0.0)).force
    assert force == pytest.approx(level @ np.array([[c, s], [-s, c]]), abs=1e-9 * np.abs(level).max())
    assert da.engine_series(inclined(turn, 1e-10)).force == pytest.approx(force, abs=1e-6)
    for aside in (4e-10, -4e-10):
        with pytest.raises(da.ModelError, match=r"the line of piston passes the crank by 4e-10 m"):
            da.engine_series(inclined(turn, aside))


@pytest.mark.parametrize(
    ("gaps", "balance", "said"),
    [
        ([0.0, DOUBT, DOUBT], DOUBT, ""),
        ([0.0, 2 * DOUBT, DOUBT], DOUBT, "at 0.25 s accelerations"),
        ([3 * DOUBT, DOUBT, 2 * DOUBT], DOUBT, "at 0 s and 1 more accelerations"),
        ([3 * DOUBT, 4 * DOUBT, 2 * DOUBT], DOUBT, "at 0 s and 2 more accelerations"),
        ([0.0, 0.0, 0.0], 1.1 * DOUBT, "the energy balance has a gap of 1e-05 of the largest energy"),
    ],
)
def test_a_motion_is_in_doubt_beyond_the_limit_of_its_checks(
    gaps: list[float], balance: float, said: str
) -> None:
    gap = np.array(gaps)
    checks = SimpleNamespace(
        law_gap=gap, law_residual=gap.max(), energy_residual=balance, time=np.array([0.0, 0.25, 0.5])
    )
    doubt: Any = MotionChecks.doubt
    found = doubt.fget(checks)
    assert found.startswith(said)
    assert bool(found) is bool(said)
