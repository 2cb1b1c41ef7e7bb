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
from dalembert.errors import AnalysisError, ModelError
from dalembert.machine.flywheel.legendre_panels import Panels
from dalembert.machine.flywheel.speed_fluctuation import speed_fluctuation
from dalembert.machine.flywheel.turning_moment import TurningMoment
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


WAVE = "'8*(1 + 0.5*sin(2*O))'"


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


def slides(load: str) -> Any:
    """A slider-crank at 20 rad/s with one load: its effort often crosses its mean just at a position."""
    m = da.slider_crank(crank=0.05, rod=0.2).with_values({"drives.O2.speed": 20.0})
    piston = {"type": "force", "on": "piston", "at": "B", "value": [load, 0]}
    return m.with_values({"loads": {"F": piston}})


MACHINES = {
    "two hundred": da.slider_crank(crank=0.05, rod=0.2),
    "four bar": da.four_bar(ground=0.4, crank=0.1, coupler=0.35, rocker=0.3),
    "engine": da.load(examples()["engine"]),
    "slide": slides("2000*joints.guide.slide"),
    "kinks": slides("400*abs(cos(2*O2)) - 300*max(links.rod.angle, 0)"),
}


@pytest.mark.parametrize("name", MACHINES)
def test_the_fluctuation_is_the_same_at_every_count(name: str) -> None:
    """A zero of T - T_m at a position, on the edge of two panels, once counted once, twice or not at all."""
    m = MACHINES[name]
    r = da.dynamics(m, positions=14400)
    torque = r.effort(next(iter(m.drives)))
    step = r.drive_position(next(iter(m.drives)))[1] - r.drive_position(next(iter(m.drives)))[0]
    above = torque - torque.mean()
    wanted = np.ptp(np.cumsum((above + np.roll(above, -1)) / 2) * step)
    for count in (5, 12, 36, 37, 72, 90, 200):
        f = da.flywheel(da.dynamics(m, positions=count), Cs=0.02)
        assert f.size.energy == pytest.approx(wanted, rel=1e-5), count
        assert len(f.size.pulses) == len(f.zeros) > 0
        assert len(f.zeros) % 2 == 0
        assert str(f)


def test_a_law_that_comes_to_one_speed_by_rounding_is_steady() -> None:
    """A straight line through points of a table: its spline's accelerations are rounding, and no reason to refuse."""
    whole, count = 2 * math.pi / 7, 36
    t = [whole * (1 - 1 / count) * k / 5 for k in range(6)]
    law = {"type": "table", "time": t, "position": [math.degrees(7 * x) for x in t], "count": count}
    text = YOKE.replace("position: {from: 0, to: 360, count: 24}, speed: 10 rad/s", f"law: {json.dumps(law)}")
    r = da.dynamics(da.loads(text))
    assert np.abs(r.drive_acceleration("O")).max() > 0
    steady = da.dynamics(da.loads(YOKE.replace("10 rad/s", "7 rad/s")), positions=count)
    wanted = da.flywheel(steady, Cs=0.02).size.energy
    assert da.flywheel(r, Cs=0.02).size.energy == pytest.approx(wanted, rel=1e-9)
    faster = YOKE.replace("speed: 10 rad/s", "speed: 10 rad/s, acceleration: 1e-6 rad/s^2")
    with pytest.raises(ModelError, match="does not turn at constant speed"):
        da.flywheel(da.dynamics(da.loads(faster)), Cs=0.02)


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
    assert "For the required Cs no flywheel is needed: that of the links alone is smaller." in said
    assert "no flywheel, exact 0 0.008894" in said


def test_the_residual_says_by_how_much_a_motion_is_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    """The law that the motion asks for is shown off by 1 %."""
    r = shaft(WAVE, 300.0, inertia=2.0)
    f = da.flywheel(r, inertia=3.0)
    assert f.exact.residual < 1e-9
    effort = TurningMoment.effort
    monkeypatch.setattr(TurningMoment, "effort", lambda t, *given: 1.01 * effort(t, *given))
    assert da.flywheel(r, inertia=3.0).exact.residual == pytest.approx(0.01, rel=0.05)


def test_a_machine_that_turns_backwards_has_the_same_flywheel() -> None:
    there, back = (da.flywheel(shaft(WAVE, rpm, inertia=2.0), Cs=0.02) for rpm in (300.0, -300.0))
    assert back.size.inertia == pytest.approx(there.size.inertia)
    assert back.size.limits == pytest.approx(there.size.limits)
    assert there.size.limits == pytest.approx((0.99 * 10 * math.pi, 1.01 * 10 * math.pi))
    assert back.exact.greatest[0] == pytest.approx(there.exact.greatest[0], rel=1e-6)
    own = da.flywheel_size(100.0, -20.0, inertia=5.0)
    assert own.fluctuation == pytest.approx(0.05)
    assert own.limits == pytest.approx((19.5, 20.5))
    assert own.mass(0.5) == pytest.approx(20.0)


def test_a_machine_without_inertia_somewhere_has_no_speed() -> None:
    with pytest.raises(AnalysisError, match="nothing in this machine has inertia"):
        speed_fluctuation(*_nothing(0.0))


def _nothing(inertia: float) -> Any:
    """A shaft whose own inertia is nothing at one place of its turn."""
    r = shaft(WAVE, 300.0, inertia=2.0)
    t = TurningMoment(r)
    panels = Panels(t.edges[:-1], np.diff(t.edges))
    own = np.full(panels.points.shape, 2.0)
    own[3, 1] = -1e-9
    return t, panels, own, inertia


@pytest.mark.parametrize(("part", "round_"), [(1.9, True), (2.1, False)])
def test_a_rim_is_no_higher_than_twice_its_radius(part: float, round_: bool) -> None:
    """Of a mean radius R its section reaches the axis at a height of 2 R."""
    radius, height = 0.3, part * 0.3
    inertia = 7000.0 * 2 * math.pi * radius * 0.1 * height * (radius**2 + height**2 / 4)
    size = da.flywheel_size(1.0, 1.0, inertia=inertia)
    if round_:
        assert size.rim(7000.0, radius, breadth=0.1) == pytest.approx(height)
    else:
        with pytest.raises(ModelError, match=r"the rim would be 0\.63 m high about a mean radius of 0\.3 m"):
            size.rim(7000.0, radius, breadth=0.1)


@pytest.mark.parametrize("value", [0.0, -1.0, math.inf, math.nan])
def test_what_is_no_size_is_refused(value: float) -> None:
    size = da.flywheel_size(100.0, 20.0, inertia=5.0)
    for call in (
        lambda: size.mass(value),
        lambda: size.disc(value, radius=1.0),
        lambda: size.disc(7000.0, radius=value),
        lambda: size.disc(7000.0, thickness=value),
        lambda: size.rim(7000.0, value, breadth=0.1),
        lambda: size.rim(7000.0, 0.5, height=value),
        lambda: da.flywheel_size(100.0, 20.0, inertia=value),
        lambda: da.flywheel_size(100.0, 20.0, Cs=value),
    ):
        with pytest.raises(ModelError, match=r"; give a (finite )?number above 0"):
            call()


def test_what_has_no_flywheel_is_refused() -> None:
    m = da.load(examples()["engine"])
    with pytest.raises(ModelError, match=r"give one of them: Cs=0\.02"):
        da.flywheel(da.dynamics(m, positions=72))
    for values in ({"acceleration": 3.0}, {"acceleration": -3.0}, {"speed": 0.0}):
        turned = m.with_values({f"drives.O2.{key}": value for key, value in values.items()})
        with pytest.raises(ModelError) as refused:
            da.flywheel(da.dynamics(turned, positions=72), Cs=0.02)
        assert str(refused.value) == (
            "drive 'O2' does not turn at constant speed, which sizing a flywheel assumes; give it a speed other than "
            "0, and no acceleration"
        )
    with pytest.raises(ModelError, match="not a whole number of turns"):
        da.flywheel(da.dynamics(m.with_values({"drives.O2.position": [0.0, 0.1, 0.2]})), Cs=0.02)
    with pytest.raises(ModelError, match="a machine with one drive"):
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
    assert "dE = 441.636 J, 103.8 % of the work of the cycle" in said
    assert "with this flywheel Cs is 0.019194, 4.03" in said
    read = json.loads(record.read_text())["flywheel"]
    assert read["inertia"] == pytest.approx(0.2237356351)
    assert read["exact"]["Cs"] == pytest.approx(0.0191939110)
    assert "I = (Δ E)/(C_s ω^2)" in sheet.read_text()
    assert main(["flywheel", file]) == 2
    assert "engine.yaml" in capsys.readouterr().err
    scene = da.draw.machine(da.flywheel(da.dynamics(da.load(file), positions=72), Cs=0.02))
    assert {"Turning moment", "Energy above the mean", "book's flywheel"} <= {t.text for t in scene.texts()}
