"""Motors: the ratio of least torque in closed form and by trying, reflected inertia, curves, efficiency, bad input."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.cli import main
from dalembert.errors import ModelError
from tests.machine.cranks import crank_machine
from tests.tiers import over

ARM = """
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], A: [0.6, 0]}, mass: 2, center: [0.3, 0], inertia: 0.06}
joints: {O: {type: pin, links: [ground, arm]}}
drives:
  O: {law: {type: cycloidal, from: 0 deg, to: 90 deg, duration: 1 s, count: 73}}
"""
OWN = 0.06 + 2 * 0.3**2


def test_an_inertia_asks_for_the_ratio_that_makes_both_halves_equal() -> None:
    """n^2 = J / J_m, and half of the torque goes into the motor itself; the peak asks for the same."""
    c = da.motor(da.dynamics(da.loads(ARM)), inertia=0.0015, ratio=4)
    assert c.inertia == pytest.approx(OWN, rel=1e-12)
    best = np.sqrt(OWN / 0.0015)
    assert c.needs["least rms"].ratio == pytest.approx(best, rel=1e-12)
    assert c.needs["least peak"].ratio == pytest.approx(best, rel=1e-6)
    assert c.torque(best) == pytest.approx(2 * c.effort / best, rel=1e-12, abs=1e-12)
    peak = 2 * np.pi * np.pi / 2  # of a cycloidal rise over 1 s
    assert np.abs(c.effort).max() == pytest.approx(OWN * peak, rel=1e-9)
    assert c.needs["given"].torque == pytest.approx((0.0015 * 4 + OWN / 4) * peak, rel=1e-9)
    assert c.rms(c.effort) == pytest.approx(OWN * peak / np.sqrt(2), rel=1e-9)
    assert c.mean(c.power) == pytest.approx(0, abs=1e-12)


@over(3, 200)
def test_no_other_ratio_needs_less(seed: int) -> None:
    m = crank_machine(seed, 48).with_values({"drives.O.acceleration": 40.0})
    c = da.motor(da.dynamics(m), inertia=2e-3, efficiency=0.9)
    rms, peak = c.needs["least rms"], c.needs["least peak"]
    for part in np.geomspace(0.2, 5, 41):
        assert c.need(rms.ratio * part).rms >= rms.rms * (1 - 1e-12)
        assert c.need(peak.ratio * part).torque >= peak.torque * (1 - 1e-6)


@over(3, 200)
def test_inertia_is_twice_the_kinetic_energy(seed: int) -> None:
    """By velocities of the links' own."""
    m = crank_machine(seed)
    r = da.dynamics(m)
    energy = np.zeros(len(r.status))
    for link in r.links:
        arm = r.center(link) - r.position(link)
        across = np.stack([-arm[:, 1], arm[:, 0]], axis=1)
        v = r.velocity(link) + r.speed(link)[:, None] * across
        energy += m.mass(link) * (v**2).sum(axis=1) + m.inertia(link) * r.speed(link) ** 2
    assert da.motor(r).inertia == pytest.approx(energy / r.drive_speed("O") ** 2, rel=1e-9)


def test_efficiency_costs_both_ways() -> None:
    r = da.dynamics(da.loads(ARM))
    whole, lossy = (da.motor(r, efficiency=e) for e in (1.0, 0.8))
    driving = whole.power > 1e-9
    braking = whole.power < -1e-9
    assert lossy.torque(2.0)[driving] == pytest.approx(whole.torque(2.0)[driving] / 0.8)
    assert lossy.torque(2.0)[braking] == pytest.approx(whole.torque(2.0)[braking] * 0.8)
    assert whole.needs.keys() == {"direct"}


CURVE = "speed [rpm], torque [N*m]\n0, 1.5\n300, 1.5\n600, 0\n"


def test_curves_and_rated_torque_judge(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "arm.yaml").write_text(ARM)
    (tmp_path / "motor.csv").write_text(CURVE)
    arguments = [
        "motor",
        str(tmp_path / "arm.yaml"),
        "--inertia",
        "0.0015kg*m^2",
        "--curve",
        str(tmp_path / "motor.csv"),
    ]
    outputs = [
        "--json",
        str(tmp_path / "m.json"),
        "--csv",
        str(tmp_path / "m.csv"),
        "--report",
        str(tmp_path / "m.txt"),
    ]
    assert main([*arguments, "--ratio", "60", *outputs]) == 0
    assert "least rms" in capsys.readouterr().out
    read = json.loads((tmp_path / "m.json").read_text())["motor"]["ratios"]
    assert {name: need["enough"] for name, need in read.items()} == {
        "given": False,  # turns too fast
        "direct": False,  # too little torque
        "least rms": True,
        "least peak": True,
    }
    assert "motor torque least rms [N*m]" in (tmp_path / "m.csv").read_text()
    assert "T_m = J_m n α" in (tmp_path / "m.txt").read_text()
    assert main([*arguments, "--rated", "0.1N*m"]) == 0
    assert " yes" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"drive": "P"}, "there is no drive 'P'"),
        ({"efficiency": 0.0}, "efficiency is 0; give a positive number"),
        ({"ratio": -2.0}, "ratio is -2"),
        ({"curve": "twice"}, r"motor\.csv:3: the curve is no function of the speed"),
        ({"curve": "none"}, r"motor\.csv:2: 'x' in column 'torque' is no finite number"),
    ],
)
def test_what_is_no_motor_is_refused(options: dict[str, Any], said: str, tmp_path: Path) -> None:
    file = tmp_path / "motor.csv"
    texts = {"twice": CURVE.replace("300,", "0,"), "none": CURVE.replace("0, 1.5", "0, x", 1)}
    if "curve" in options:
        file.write_text(texts[options["curve"]])
        options = {"curve": file}
    with pytest.raises(ModelError, match=said):
        da.motor(da.dynamics(da.loads(ARM)), **options)
