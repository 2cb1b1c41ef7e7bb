"""Motors behind gears: against closed forms, an equal machine without a gear, both senses of power, and wrong keys."""

from __future__ import annotations

import numpy as np
import pytest

import dalembert as da
from tests.tiers import over

FILE = """links: {ground: {points: {O: [0, 0]}}, load: {points: {O: [0, 0]}, inertia: 1.1}}
joints: {O: {type: pin, links: [ground, load]}}
drives: {O: {motor: {stall: 8 N*m, no_load: 300 rad/s, ratio: 12, inertia: 0.003 kg*m^2, efficiency: 0.9}}}
loads: {T: {type: couple, on: load, value: -25}}
start: {O: {position: 0, speed: 0}}
"""


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        (
            "efficiency: 0.9",
            "efficiency: 1.1",
            "the efficiency of the gear is 1.1; write a number above 0, and 1 at most",
        ),
        (
            "efficiency: 0.9",
            "efficiency: 0",
            "the efficiency of the gear is 0; write a number above 0, and 1 at most",
        ),
        (
            "ratio: 12",
            "ratio: -12",
            "the ratio of the gear is -12; write the speed of the motor over that of the drive",
        ),
        (
            "inertia: 0.003",
            "inertia: -0.003",
            "the inertia of the motor is negative; write a positive one, or 0",
        ),
        (
            "0.9}}",
            "0.9}, effort: 3*O}",
            "a motor behind a gear and an effort are given; write that effort as a load",
        ),
    ],
)
def test_wrong_gears_are_told(old: str, new: str, says: str) -> None:
    with pytest.raises(da.ModelError) as caught:
        da.loads(FILE.replace(old, new), name="m.yaml")
    assert says in str(caught.value)
    assert str(caught.value).startswith("m.yaml:3: ")


@over(quick=2, whole=40)
def test_without_loss_it_is_a_direct_motor_and_a_heavier_load(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n, j = rng.uniform(2, 20), 10 ** rng.uniform(-4, -2)
    m = da.four_bar(positions=1)
    motor = {"stall": 8.0, "no_load": 300.0, "ratio": n, "inertia": f"{j} kg*m^2"}
    start = {"O2": {"position": "60 deg", "speed": 0}}
    geared = da.simulate(m.with_values({"drives.O2.motor": motor}), "0.5 s", start)
    crank = m.inertia("crank") + j * n * n
    direct = m.with_values(
        {"links.crank.inertia": crank, "drives.O2.motor": {"stall": 8 * n, "no_load": 300 / n}}
    )
    s = da.simulate(direct, "0.5 s", start)
    assert geared.position("O2") == pytest.approx(s.position("O2"), rel=1e-8)
    assert geared.energy_residual < 1e-9
    assert geared.law_residual < 1e-9


@pytest.mark.parametrize("load", [-25.0, 40.0, -110.0])
def test_both_senses_of_power(load: float) -> None:
    s = da.simulate(da.loads(FILE.replace("-25", str(load))), until="2 s")
    use, u, a = s.motor["O"], s.speed("O"), s.acceleration("O")
    applied = s.applied[:, 0]
    assert applied == pytest.approx(1.1 * a - load, rel=1e-9, abs=1e-9)
    assert use.torque == pytest.approx(8 * (1 - 12 * u / 300), rel=1e-8, abs=1e-8)
    driving = applied * u >= 0
    assert use.loss == pytest.approx(np.where(driving, 0.1 / 0.9 * applied * u, -0.1 * applied * u), abs=1e-8)
    assert s.energy_residual < 1e-9
    assert (use.loss > -1e-9).all()


def test_a_lossy_gear_holds_between_both_its_efficiencies() -> None:
    for load, stays in (
        (-86.0, False),
        (-87.0, True),
        (-106.0, True),
        (-107.0, False),
    ):  # 96 N m times or over 0.9
        s = da.simulate(da.loads(FILE.replace("-25", str(load))), until="0.2 s")
        assert (s.speed("O")[-1] == 0) == stays


def test_a_stop_takes_the_energy_of_links_and_rotor() -> None:
    text = FILE.replace("0.9}}", "0.9}, stops: {from: -1 rad, to: 3 rad, restitution: 0.4}}")
    s = da.simulate(da.loads(text), until="2 s")
    assert s.position("O")[-1] == pytest.approx(3.0)
    assert s.energy_residual < 1e-9
    strike = next(e for e in s.events if "strikes" in e.sentence)
    speed = float(strike.sentence.split(" with ")[1].split()[0])
    assert strike.lost == pytest.approx((1.1 + 0.9 * 0.003 * 144) * speed**2 / 2 * (1 - 0.4**2), rel=1e-5)


def test_the_choice_of_a_motor_takes_that_of_the_file() -> None:
    m = da.slider_crank(crank=0.05, rod=0.2)
    motor = {"stall": 8.0, "no_load": 300.0, "ratio": 6.0, "inertia": "2e-4 kg*m^2", "efficiency": 0.9}
    r = da.dynamics(m)
    given = da.motor(r, inertia=2e-4, ratio=6.0, efficiency=0.9).needs["given"]
    found = da.motor(da.dynamics(m.with_values({"drives.O2.motor": motor}))).needs["given"]
    assert (found.ratio, found.rms, found.torque) == pytest.approx(
        (given.ratio, given.rms, given.torque), rel=1e-12
    )
