"""Aims and conditions along motions under forces: closed forms, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

import dalembert as da
from dalembert.optimization.optimize_file import optimize_file

pytest.importorskip("llvmlite")
WHEEL = """
links: {ground: {points: {O: [0, 0]}}, wheel: {points: {O: [0, 0]}, inertia: 2 kg*m^2}}
joints: {O: {type: pin, links: [ground, wheel]}}
parameters: {n: 2}
drives: {O: {motor: {stall: 10 N*m, no_load: 300 rad/s, ratio: n, inertia: 0.01 kg*m^2}}}
start: {O: {position: 0, speed: 0}}
"""
STOP = """
links: {ground: {points: {O: [0, 0]}}, wheel: {points: {O: [0, 0]}, inertia: flywheel}}
joints: {O: {type: pin, links: [ground, wheel]}}
parameters: {flywheel: 2 kg*m^2}
drives: {O: {effort: 0, brake: 4 N*m}}
start: {O: {position: 0, speed: 20 rad/s}}
"""
UNTIL = {"until": ["60 s", "O.speed = 20 rad/s"], "count": 21}


def run_up(n: float) -> float:
    """Time in which a motor behind a ratio n takes the wheel to 20 rad/s: (J + Jm n^2) w' = n T (1 - n w/w0)."""
    return float(-(2 + 0.01 * n * n) / (n * n * 10 / 300) * np.log(1 - n * 20 / 300))


def test_the_ratio_that_runs_up_soonest() -> None:
    best = da.optimize(da.loads(WHEEL), {"n": (1, 14)}, "final time", simulate=UNTIL, starts=3)
    known = minimize_scalar(run_up, bounds=(1, 14), method="bounded", options={"xatol": 1e-10})
    assert best.value == pytest.approx(known.fun, rel=1e-7)
    assert best.values[0] == pytest.approx(known.x, rel=1e-4)
    assert best.value_before == pytest.approx(run_up(2), rel=1e-7)
    assert len(best.drawings()) == 3


def test_a_file_with_a_condition_along_the_motion(tmp_path: Path) -> None:
    """A wheel stops after J w/M, and turns by J w^2/(2 M) until then: at most 30 rad for J = 0.6."""
    (tmp_path / "stop.yaml").write_text(STOP)
    file = tmp_path / "optimize.yaml"
    file.write_text(
        "optimize: 1\nmodel: stop.yaml\nvary: {flywheel: [0.1 kg*m^2, 3 kg*m^2]}\nleast: -final(time)\n"
        "where: [peak drive.O <= 30 rad]\nsimulate: {until: [30 s, O.speed = 0 rad/s], count: 11}\nstarts: 2\n"
    )
    best = optimize_file(file)
    assert isinstance(best, da.Optimum)
    assert best.feasible
    assert best.values[0] == pytest.approx(0.6, rel=1e-5)
    assert best.value == pytest.approx(-3.0, rel=1e-5)
    file.write_text(file.read_text().replace("least: -final(time)", "least: [final time, peak drive.O]"))
    with pytest.raises(da.ModelError, match="two aims along motions under forces give no front"):
        optimize_file(file)


@pytest.mark.long
def test_what_is_not_compiled_is_simulated() -> None:
    """Behind a gear with losses, where no machine code reaches: the torque that arrives is smaller by them."""
    lossy = da.loads(
        WHEEL.replace("ratio: n,", "ratio: n, efficiency: 0.8,").replace("inertia: 0.01 kg*m^2", "inertia: 0")
    )
    best = da.optimize(lossy, {"n": (2, 6)}, "final time", simulate=UNTIL | {"count": 5}, starts=1)
    n = best.values[0]
    assert best.value == pytest.approx(-2 / (0.8 * n * n * 10 / 300) * np.log(1 - n * 20 / 300), rel=1e-6)


def test_positions_beside_a_motion_are_refused() -> None:
    with pytest.raises(da.ModelError, match="positions is given, and forces move the designs"):
        da.optimize(da.loads(WHEEL), {"n": (1, 14)}, "final time", positions=5, simulate=UNTIL)


BOUNCE = """
links: {ground: {points: {O: [0, 0]}}, wheel: {points: {O: [0, 0]}, inertia: j}}
joints: {O: {type: pin, links: [ground, wheel]}}
parameters: {j: 2 kg*m^2}
drives: {O: {effort: -1 N*m, stops: {from: 0, to: 400, restitution: 0.5}}}
start: {O: {position: 1 rad, speed: 0}}
"""


def test_a_mean_along_a_motion_is_that_of_even_instants() -> None:
    """A wheel falls on its stop after sqrt(2 j) s and rises again with half its speed: that instant is not counted."""
    best = da.optimize(
        da.loads(BOUNCE), {"j": (1, 4)}, "mean drive.O", simulate={"until": "2.4 s", "count": 13}, starts=1
    )
    (j,) = best.values
    assert j == pytest.approx(1.0, rel=1e-6)  # the lightest is down soonest
    t, hit = np.linspace(0, 2.4, 13), np.sqrt(2 * j)
    after = np.maximum(t - hit, 0)
    angle = np.where(t < hit, 1 - t**2 / (2 * j), 0.5 * hit / j * after - after**2 / (2 * j))
    assert best.values_of(best.after, "drive.O") == pytest.approx(angle, abs=1e-9)
    assert best.value == pytest.approx(angle.mean(), rel=1e-9)
    time = best.after.schedule.time
    assert time is not None
    assert len(time) > 13
    assert [time[best.place(best.after, k) - 1] for k in range(13)] == pytest.approx(t, abs=1e-12)
    assert np.isnan(best.sampled(best.after, np.full(len(time), np.nan))).tolist() == [True] * 13
    plain = da.optimize(
        da.four_bar(positions=3), {"links.rocker.points.B.0": (0.2, 0.28)}, "effort.O2", starts=1
    )
    assert [plain.place(plain.after, k) for k in range(3)] == [1, 2, 3]
    assert plain.sampled(plain.after, np.arange(3.0)).tolist() == [0, 1, 2]
