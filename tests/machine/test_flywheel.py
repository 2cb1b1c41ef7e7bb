"""Flywheels: books, quadrature, an integrator, and the law that the motion found asks for a constant torque."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.cli import main
from dalembert.errors import ModelError
from tests.machine.closed_forms import turn
from tests.machine.cranks import crank_machine
from tests.tiers import over

SHAFT = """
links:
  ground: {points: {O: [0, 0]}}
  shaft: {points: {O: [0, 0]}, inertia: %g}
joints:
  O: {type: pin, links: [ground, shaft]}
drives:
  O: {position: {from: 0 deg, to: %g deg, count: 72}, speed: %.17g rad/s}
loads:
  engine: {type: couple, on: shaft, value: %s}
"""


def shaft(value: str, rpm: float, period: float = 360.0, inertia: float = 0.0) -> Any:
    """A shaft that a couple turns against a constant load."""
    return da.dynamics(da.loads(SHAFT % (inertia, period, rpm * math.pi / 30, value)))


def test_three_cylinders_with_triangular_diagrams() -> None:
    """Khurmi, example 16.11: the sum goes between 45 and 90 N m, three times a turn, with kinks on its mean."""
    one = "{against: O, periodic: 360 deg, x: [0, 60, 180, 360], y: [0, 90, 0, 0], shift: %d deg}"
    loads = "".join(f"\n  gas_{k}: {{type: couple, on: shaft, value: {one % k}}}" for k in (120, 240))
    f = da.flywheel(
        da.dynamics(da.loads(SHAFT % (0, 360, 20 * math.pi, one % 0) + loads)), inertia=12 * 0.08**2
    )
    assert f.mean == pytest.approx(-67.5, rel=1e-9)
    assert sorted(f.size.pulses) == pytest.approx([-3.75 * math.pi] * 3 + [3.75 * math.pi] * 3, rel=1e-8)
    assert f.size.fluctuation == pytest.approx(3.75 * math.pi / (0.0768 * 400 * math.pi**2), rel=1e-8)


def test_discs_and_rims_have_the_inertia() -> None:
    f = da.flywheel_size(5000.0, 20.0, Cs=0.02)
    radius, thickness = f.disc(7200.0, thickness=0.08)
    assert math.pi * 7200 * thickness * radius**4 / 2 == pytest.approx(f.inertia)
    assert f.disc(7200.0, radius=radius)[1] == pytest.approx(0.08)
    height = f.rim(7200.0, 0.9, breadth=0.2)
    ring = quad(lambda r: 2 * math.pi * 7200 * 0.2 * r**3, 0.9 - height / 2, 0.9 + height / 2)[0]
    assert ring == pytest.approx(f.inertia)
    assert f.rim(7200.0, 0.9, height=height) == pytest.approx(0.2)
    with pytest.raises(ModelError, match="give more breadth or radius"):
        f.rim(7200.0, 0.1, breadth=0.01)


# the exact speed


def scotch_yoke(inertia: float) -> tuple[float, float]:
    """Least and greatest speed of (J + m r^2 sin^2 q) q'^2 / 2 + W(q) constant by quadrature, mean speed 10."""
    own = lambda q: inertia + 2.0 * 0.01 * np.sin(q) ** 2  # noqa: E731
    energy = lambda e, q: np.sqrt(2 * (e - 3.0 * np.cos(q)) / own(q))  # noqa: E731

    def late(e: float) -> float:
        return (
            float(quad(lambda q: 1 / energy(e, q), 0, 2 * math.pi, epsabs=1e-13, epsrel=1e-12)[0])
            - 2 * math.pi / 10
        )

    e = brentq(late, 50 * inertia * 0.5, 50 * inertia * 3 + 20, xtol=1e-14, rtol=1e-14)
    fine = energy(e, turn(20000))
    return float(fine.min()), float(fine.max())


YOKE = """
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}}
  yoke: {points: {S: [0, 0]}, mass: 2}
joints:
  O: {type: pin, links: [ground, crank]}
  slot: {type: slot, links: [yoke, crank], at: [S, A], direction: 90}
  guide: {type: slider, links: [ground, yoke], at: [O, S], direction: 0}
drives:
  O: {position: {from: 0, to: 360, count: 24}, speed: 10 rad/s}
loads:
  F: {type: couple, on: crank, value: 3*sin(O)}
"""


def test_the_exact_speed_is_that_of_the_quadrature() -> None:
    f = da.flywheel(da.dynamics(da.loads(YOKE)), inertia=0.8)
    assert f.exact is not None
    low, high = scotch_yoke(0.8)
    assert f.exact.least[0] == pytest.approx(low, rel=1e-8)
    assert f.exact.greatest[0] == pytest.approx(high, rel=1e-7)
    assert f.own == pytest.approx(0.01, rel=1e-12)


def test_with_a_damper_it_is_that_of_an_integrator() -> None:
    text = YOKE + "  d: {type: torsion_damper, joint: O, damping: 0.05}\n"
    f = da.flywheel(da.dynamics(da.loads(text)), inertia=0.8)
    assert f.exact is not None
    assert f.exact.residual < 1e-9

    def rate(q: float, w: Any) -> Any:
        own = 0.8 + 0.02 * math.sin(q) ** 2
        return [
            (f.exact.torque + 3 * math.sin(q) - 0.05 * w[0] - 0.02 * math.sin(q) * math.cos(q) * w[0] ** 2)
            / own
            / w[0]
        ]

    start = float(np.interp(0.0, f.exact.angle, f.exact.speed))
    run = solve_ivp(rate, (0, 40 * math.pi), [start], rtol=1e-10, atol=1e-12, dense_output=True)
    last = run.sol(38 * math.pi + turn(4000))[0]
    assert (last.min(), last.max()) == pytest.approx((f.exact.least[0], f.exact.greatest[0]), rel=1e-6)


def test_the_flywheel_for_a_fluctuation_gives_it() -> None:
    f = da.flywheel(da.dynamics(da.load(examples()["engine"]), positions=72), Cs=0.02)
    assert f.exact is not None and f.exact_size is not None  # noqa: PT018
    assert f.exact_size.fluctuation == pytest.approx(0.02, rel=1e-9)
    assert f.exact_size.inertia == pytest.approx(f.inertia - f.own, rel=0.01)
    assert sum(f.size.pulses) == pytest.approx(0, abs=1e-9 * f.size.energy)
    coarse = np.ptp(f.energy)
    assert coarse < f.size.energy < 1.02 * coarse  # at positions only the extremes are missed


@over(3, 200)
def test_the_motion_found_asks_for_a_constant_torque(seed: int) -> None:
    r = da.dynamics(crank_machine(seed, damped=seed % 3 == 0))
    assert r.ok.all(), r.problems()
    scale = float(np.abs(r.effort(r.drives[0])).max())
    f = da.flywheel(r, inertia=max(scale / 5, 1.0))
    assert f.exact is not None, f.reason
    assert f.exact.residual < 1e-9
    assert sum(f.size.pulses) == pytest.approx(0, abs=1e-8 * max(f.size.energy, 1e-9 * scale))


def test_reactions_that_are_not_unique_do_not_matter() -> None:
    m = crank_machine(2)
    a, b = (da.flywheel(da.dynamics(x), Cs=0.05) for x in (m, da.lifted(m)))
    assert set(b.result.status) == {"redundant"}
    assert a.exact_size is not None
    assert b.exact_size is not None
    assert b.exact_size.inertia == pytest.approx(a.exact_size.inertia, rel=1e-9)


def test_an_even_effort_needs_none() -> None:
    rotor = da.dynamics(da.load(cases()["ba-01-rotor-with-four-masses"]), positions=72)
    for r in (shaft("0", 100), shaft("30", 100), rotor):
        f = da.flywheel(r, Cs=0.02)
        assert f.inertia == 0
        assert f.reason == "the effort never differs from its mean"
        assert "no flywheel is needed" in str(f)


def test_links_that_turn_steadily_by_themselves_need_none() -> None:
    said = " ".join(str(da.flywheel(da.dynamics(da.v_engine()), Cs=0.02)).split())
    assert "has the mean 0 N*m" in said
    assert "For the Cs asked for no flywheel is needed: that of the links alone is smaller." in said
    assert "no flywheel, exact 0 0.008894" in said


def test_what_has_no_flywheel_is_refused() -> None:
    m = da.load(examples()["engine"])
    with pytest.raises(ModelError, match=r"give one of them: Cs=0\.02"):
        da.flywheel(da.dynamics(m, positions=72))
    with pytest.raises(ModelError, match="does not turn at one speed"):
        da.flywheel(da.dynamics(m.with_values({"drives.O2.acceleration": 3.0}), positions=72), Cs=0.02)
    with pytest.raises(ModelError, match="no whole number of turns"):
        da.flywheel(da.dynamics(m.with_values({"drives.O2.position": [0.0, 0.1, 0.2]})), Cs=0.02)
    with pytest.raises(ModelError, match="a machine of one drive"):
        da.flywheel(da.dynamics(da.load(examples()["two_drives"])), Cs=0.02)


def test_the_command_prints_draws_and_writes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    record, sheet = tmp_path / "f.json", tmp_path / "f.txt"
    file = str(examples()["engine"])
    assert (
        main(
            [
                "flywheel",
                file,
                "--Cs",
                "0.02",
                "--positions",
                "72",
                "--json",
                str(record),
                "--report",
                str(sheet),
            ]
        )
        == 0
    )
    said = capsys.readouterr().out
    assert "dE = 441636 N*mm, 103.8 % of the work of the cycle" in said
    assert "with that flywheel Cs is 0.019194, 4.03" in said
    read = json.loads(record.read_text())["flywheel"]
    assert read["inertia"] == pytest.approx(0.2237356351)
    assert read["exact"]["Cs"] == pytest.approx(0.0191939110)
    assert "I = (Δ E)/(C_s ω^2)" in sheet.read_text()
    assert main(["flywheel", file]) == 2
    assert "engine.yaml" in capsys.readouterr().err
    scene = da.draw.machine(da.flywheel(da.dynamics(da.load(file), positions=72), Cs=0.02))
    assert {"Turning moment", "Energy above the mean", "book's flywheel"} <= {t.text for t in scene.texts()}
