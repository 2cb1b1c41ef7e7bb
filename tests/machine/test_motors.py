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
from dalembert.model.drives.motors import MotorCurve
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


def test_every_number_of_a_motor_is_that_of_its_formula() -> None:
    """A four-bar at uneven positions of a crank that slows down: each stands for its own time."""
    places = (0.1, 0.4, 0.5, 1.1, 1.9, 2.0)
    m = da.four_bar().with_values(
        {"drives.O2.position": places, "drives.O2.speed": -7.0, "drives.O2.acceleration": 30.0}
    )
    r = da.dynamics(m)
    c = da.motor(r, inertia=0.002, ratio=3.0, efficiency=0.8)
    q, effort = np.array(places), r.effort("O2")
    assert (effort < 0).any()
    assert (effort > 0).any()
    time = np.array([0.15, 0.2, 0.35, 0.7, 0.45, 0.05]) / 7
    assert np.diff(q) == pytest.approx([0.3, 0.1, 0.6, 0.8, 0.1])
    np.testing.assert_allclose(c.time, time)
    lost = np.where(effort * -7 >= 0, 1 / 0.8, 0.8)
    torque = 0.002 * 3 * 30 + effort * lost / 3
    np.testing.assert_allclose(c.torque(3.0), torque)
    share = time / time.sum()
    rms = np.sqrt((torque**2 * share).sum())
    need = c.needs["given"]
    assert (need.rms, need.torque) == pytest.approx((rms, np.abs(torque).max()))
    assert (need.ratio, need.speed, need.enough) == (3.0, 21.0, None)
    best = np.sqrt(np.sqrt(((effort * lost) ** 2 * share).sum()) / (0.002 * 30))
    assert c.needs["least rms"].ratio == pytest.approx(best)
    record = c.record(lambda kind, value: {kind: value})["motor"]
    for name, kind, x in (("effort", "moment", effort), ("power", "power", -7 * effort)):
        sizes = {"greatest": np.abs(x).max(), "rms": np.sqrt((x**2 * share).sum()), "mean": (x * share).sum()}
        assert record[name] == {what: {kind: pytest.approx(value)} for what, value in sizes.items()}
    assert record["ratios"]["given"] == {
        "ratio": 3.0,
        "rms": {"moment": pytest.approx(rms)},
        "torque": {"moment": pytest.approx(np.abs(torque).max())},
        "speed": {"angular_speed": 21.0},
        "enough": None,
    }
    assert record["drive"] == "O2"
    columns = {x.name: (x.kind, x.values) for x in c.columns()}
    for name, kind, own in (
        ("effort.O2", "moment", effort),
        ("drive.O2.speed", "angular_speed", np.full(6, -7.0)),
        ("drive.O2.acceleration", "angular_acceleration", np.full(6, 30.0)),
        ("power.O2", "power", -7 * effort),
        ("reflected_inertia.O2", "inertia", c.inertia),
        ("motor_torque.given", "moment", torque),
    ):
        assert columns[name][0] == kind
        np.testing.assert_allclose(columns[name][1], own)


@pytest.mark.parametrize(
    ("curve", "enough"),
    [
        (((0.0, 60.0), (2.02, 2.02)), True),
        (((0.0, 60.0), (1.98, 1.98)), False),  # too little torque
        (((0.0, 39.0), (5.0, 5.0)), False),  # it turns no faster than that, whatever its torque
        (((0.0, 41.0), (5.0, 5.0)), True),
        (((-41.0, 0.0), (5.0, 5.0)), True),
        (((0.0, 80.0), (4.04, 0.0)), True),  # 2 N m at 40 rad/s
        (((0.0, 80.0), (3.96, 0.0)), False),
        (((0.0, 80.0), (-4.04, 0.0)), True),
        (((-80.0, 0.0), (0.0, 3.96)), False),
        (((-80.0, -20.0), (0.0, -3.04)), True),  # 2.03 N m
    ],
)
def test_a_curve_is_enough_from_its_limits_on(
    curve: tuple[tuple[float, ...], tuple[float, ...]], enough: bool
) -> None:
    """A shaft at 20 rad/s whose load takes 4 N m, behind a gear of 2: 40 rad/s and 2 N m; both ways round."""
    text = ARM.replace("law: {type: cycloidal, from: 0 deg, to: 90 deg, duration: 1 s, count: 73}", "{}")
    for sign in (1, -1):
        drive = f"position: {{from: 0 deg, to: 360 deg, count: 8}}, speed: {sign * 20} rad/s"
        shaft = text.replace("{}", drive).replace("mass: 2, center: [0.3, 0], inertia: 0.06", "mass: 0")
        shaft += f"loads: {{M: {{type: couple, on: arm, value: {-4 * sign}}}}}\n"
        r = da.dynamics(da.loads(shaft))
        assert da.motor(r, ratio=2, curve=MotorCurve(*curve)).needs["given"].enough is enough


def test_a_rated_torque_is_held_against_the_rms() -> None:
    r = da.dynamics(da.loads(ARM))
    rms, peak = (getattr(da.motor(r).needs["direct"], name) for name in ("rms", "torque"))
    assert da.motor(r, rated=rms * 1.001).needs["direct"].enough
    assert da.motor(r, rated=rms * 0.999).needs["direct"].enough is False
    assert rms * 1.3 < peak
    weak = MotorCurve((0.0, 100.0), (rms, rms))  # enough in the mean, not at the peak
    assert da.motor(r, rated=rms * 2, curve=weak).needs["direct"].enough is False


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
    assert "motor_torque.least_rms [N*m]" in (tmp_path / "m.csv").read_text()
    assert "T_m = J_m n α" in (tmp_path / "m.txt").read_text()
    assert main([*arguments, "--rated", "0.1N*m"]) == 0
    assert " yes" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"drive": "P"}, "unknown drive 'P'"),
        ({"efficiency": 0.0}, "efficiency is 0; give a number above 0, at most 1"),
        ({"ratio": -2.0}, "ratio is -2"),
        ({"curve": "twice"}, r"motor\.csv:3: speeds of the curve must increase"),
        ({"curve": "none"}, r"motor\.csv:2: 'x' in column 'torque' is not a finite number"),
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


LINE = """
links:
  ground: {points: {O: [0, 0]}}
  rotor: {points: {O: [0, 0]}, inertia: 0.5}
joints: {O: {type: pin, links: [ground, rotor]}}
drives: {O: {position: {from: 0, to: 360, count: 72}, speed: %s rad/s, motor: {stall: 40 N*m, no_load: 100 rad/s}}}
loads: {T: {type: couple, on: rotor, value: %s}}
"""


def spun(speed: float, load: str, **options: Any) -> Any:
    return da.motor(da.dynamics(da.loads(LINE % (speed, load))), **options)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize(
    ("speed", "load", "enough"),
    [
        (50.0, 19.99, True),  # 40 (1 - 50 / 100)
        (50.0, 20.01, False),
        (99.9, 0.03, True),
        (100.0, 0.0, True),
        (100.1, 0.0, False),  # beyond no load, where even no torque is not to be had
        (150.0, 19.0, False),  # and the line would be -20 N m
    ],
)
def test_a_motor_is_judged_by_its_line_and_not_beyond_its_speed(
    sense: int, speed: float, load: float, enough: bool
) -> None:
    for pull in (load, -load):  # driving and braking alike
        assert spun(sense * speed, f"{pull} N*m").needs["direct"].enough is enough
    assert spun(sense * speed / 4, f"{4 * load} N*m", ratio=4).needs["given"].enough is enough
    against = LINE.replace("40 N*m", "-40 N*m").replace("100 rad/s", "-100 rad/s")
    assert da.motor(da.dynamics(da.loads(against % (speed, f"{load} N*m")))).needs["direct"].enough is enough


def test_the_rated_torque_is_held_against_the_rms_and_negative_peaks_count() -> None:
    """3 + 12 cos q for the load: rms sqrt(9 + 72), and the largest of the effort is -15 N m, not 9."""
    load, rms = "{expression: 3 + 12*cos(O), unit: N*m}", 9.0
    for rated, enough in ((rms * 1.0000001, True), (rms * 0.9999999, False)):
        c = spun(20.0, load, rated=rated, curve=None)
        assert c.needs["direct"].rms == pytest.approx(rms, rel=1e-12)
        assert c.needs["direct"].torque == pytest.approx(15.0, rel=1e-12)
        assert c.effort.min() == pytest.approx(-15.0, rel=1e-12)
        assert c.needs["direct"].enough is enough
    row = next(line for line in str(c).splitlines() if line.startswith("effort"))
    assert row.split()[2:5] == ["15", "0", "deg"]
    assert c.mean(c.power) == pytest.approx(-60.0, rel=1e-12)  # -3 N m at 20 rad/s


def test_a_drive_without_effort_has_its_own_sentence() -> None:
    assert "The drive needs no effort; the motor needs no torque either." in " ".join(
        str(spun(20.0, "0 N*m")).split()
    )
    free = LINE.replace("inertia: 0.5", "inertia: 0").replace(
        "speed: %s", "acceleration: 3 rad/s^2, speed: %s"
    )
    c = da.motor(da.dynamics(da.loads(free % (20.0, "0 N*m"))), inertia=1e-3)
    said = " ".join(str(c).split())
    assert (
        "The drive needs no effort; only the motor's acceleration needs torque: the lower the ratio, the less."
        in said
    )
    assert "Torque falls as the ratio rises" not in said
