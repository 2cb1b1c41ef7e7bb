"""Loads and efforts that go by time and speed under forces: closed forms, and a table against its own integral."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.model.files.model_files import tree_text
from tests.tiers import tiers

J = 0.8
ROTOR = f"""
links:
  ground: {{points: {{O: [0, 0]}}}}
  rotor: {{points: {{O: [0, 0]}}, mass: 12 kg, inertia: {J} kg*m^2}}
joints: {{O: {{type: pin, links: [ground, rotor]}}}}
"""
MASS = """
links:
  ground: {points: {O: [0, 0]}}
  mass: {points: {P: [0, 0]}, mass: 4 kg}
joints: {S: {type: slider, links: [ground, mass], at: [O, P], direction: 0 deg}}
loads: {F: {type: force, on: mass, at: P, value: 6*sin(3*time) N, direction: 0 deg}}
drives: {S: {position: 0 mm}}
start: {S: {position: 0 mm, speed: 0}}
"""


def rotor(drive: str, load: str = "0", speed: str = "0") -> Any:
    """A rotor on a pin, with a couple on it."""
    loads = f"loads: {{C: {{type: couple, on: rotor, value: {load}}}}}\n"
    return da.loads(f"{ROTOR}{loads}drives: {{O: {drive}}}\nstart: {{O: {{position: 0, speed: {speed}}}}}\n")


def check(s: Any) -> None:
    """Energy and the efforts that made the motion."""
    assert max(s.energy_residual, s.law_residual) < 1e-9
    assert not s.doubt


def test_a_fan_slows_a_rotor_down() -> None:
    s = da.simulate(rotor("{effort: -0.02*O.speed^2 N*m}", speed="100 rad/s"), "2 s")
    assert s.speed("O") == pytest.approx(100 / (1 + 0.02 * 100 * s.time / J), rel=1e-10)
    check(s)


def test_a_motor_drives_a_fan_to_the_balance_of_both() -> None:
    """J w' = a - b w - c w^2 from rest: with roots w1 > 0 > w2, (w - w1)/(w - w2) falls as exp(-c (w1 - w2) t / J)."""
    a, b, c = 40.0, 40 / 150, 0.002
    m = rotor("{motor: {stall: 40 N*m, no_load: 150 rad/s}, effort: -0.002*O.speed^2 N*m}")
    s = da.simulate(m, "8 s")
    root = np.sqrt(b * b + 4 * a * c)
    high, low = (root - b) / (2 * c), (-root - b) / (2 * c)
    part = high / low * np.exp(-root * s.time / J)
    assert s.speed("O") == pytest.approx((high - low * part) / (1 - part), rel=1e-9, abs=1e-9)
    assert da.simulate(m, "60 s").speed("O")[-1] == pytest.approx(high, rel=1e-9)
    check(s)
    assert da.loads(tree_text(m.to_tree())) == m


@pytest.mark.parametrize("dimension", ["", "units: {length: mm}\n"])
def test_a_mass_is_pushed_to_and_fro(dimension: str) -> None:
    """m x'' = F0 sin(w t) from rest: x = F0/(m w) (t - sin(w t)/w)."""
    s = da.simulate(da.loads(dimension + MASS), "2 s")
    t = s.time
    assert s.position("S") == pytest.approx(6 / 12 * (t - np.sin(3 * t) / 3), rel=1e-10, abs=1e-12)
    assert s.speed("S") == pytest.approx(6 / 12 * (1 - np.cos(3 * t)), rel=1e-10, abs=1e-12)
    check(s)


@pytest.mark.parametrize("where", ["load", "effort"])
@pytest.mark.parametrize("seed", tiers([1], range(2, 12)))
def test_no_point_of_a_table_is_stepped_over(seed: int, where: str) -> None:
    """Pulses of a thousandth of the time, between points at which nothing acts: the moment's integral is J w."""
    rng = np.random.default_rng(seed)
    start = np.sort(rng.uniform(0.1, 1.9, 3))
    x = np.concatenate([[0], (start[:, None] + [0, 1e-3, 2e-3]).ravel(), [2.5]]).round(6)
    y = np.concatenate([[0], np.outer(rng.uniform(50, 900, 3), [0, 1, 0]).ravel(), [0]]).round(3)
    table = f"{{against: time, x: {x.tolist()}, y: {y.tolist()}}}"
    s = da.simulate(
        rotor("{position: 0}", table) if where == "load" else rotor(f"{{effort: {table}}}"), "2 s"
    )
    points = np.union1d(x[x < 2], [*s.time])
    value = np.interp(points, x, y)
    integral = np.append(0, np.cumsum(np.diff(points) * (value[1:] + value[:-1]) / 2))
    expected = np.interp(s.time, points, integral) / J
    assert s.speed("O") == pytest.approx(expected, rel=1e-10, abs=1e-12)
    check(s)


@pytest.mark.long
def test_a_periodic_table_goes_on_and_wakes_what_friction_holds() -> None:
    """Held until the table passes the brake, and from then on J w' = M(t) - 3."""
    table = "{against: time, x: [0, 0.5, 1], y: [0, 4, 0], periodic: 1 s}"
    s = da.simulate(rotor("{position: 0}", table), "4.3 s")
    assert J * s.speed("O")[-1] == pytest.approx(8 + 4 * 0.3**2, rel=1e-12)
    pulse = "{against: time, x: [0, 1, 1.0001, 1.0002, 3], y: [0, 0, 900, 0, 0]}"
    s = da.simulate(rotor("{brake: 3 N*m, position: 0}", pulse), "3 s")
    first = next(e.time for e in s.events if e.name == "start")
    assert first == pytest.approx(1 + 1e-4 * 3 / 900, abs=1e-12)
    check(s)


def test_other_analyses_have_time_at_a_constant_speed_and_refuse_others() -> None:
    m = rotor("{position: 0, speed: 2 rad/s}", "5*cos(3*time)")
    assert float(da.statics(m).effort("O")[0]) == pytest.approx(-5)
    r = da.dynamics(m, positions=5)
    assert r.effort("O") == pytest.approx(-5 * np.cos(3 * r["drive.O"] / 2))
    slow = rotor("{position: 0, speed: 2 rad/s, acceleration: 1 rad/s^2}", "5*cos(3*time)")
    with pytest.raises(
        ModelError, match=r"^text:.*depends on time, but several positions without a law have no times"
    ):
        da.dynamics(slow, positions=5)


@pytest.mark.parametrize(
    ("drive", "load", "sentence"),
    [
        (
            "{effort: 3*P.speed}",
            "0",
            "the effort of drive 'O' uses 'P.speed', which is not a drive; the only one is 'O'",
        ),
        ("{position: 0}", "3*P.speed", "load 'C' uses 'P.speed', which is not a drive; the only one is 'O'"),
        (
            "{motor: {stall: 4 N*m, no_load: 9 rad/s}, effort: 3 N*m}",
            "0",
            "a motor and a constant effort are given; write that",
        ),
    ],
)
def test_what_is_wrong_says_so_at_its_line(drive: str, load: str, sentence: str) -> None:
    with pytest.raises(ModelError, match=r"^text:\d+: ") as caught:
        rotor(drive, load)
    assert sentence in str(caught.value)


@pytest.mark.parametrize(("outside", "last"), [("refuse", 4.0), ("hold", 4.0), ("zero", 0.0)])
def test_a_table_that_ends_too_early_is_held_with_a_status_or_zero(outside: str, last: float) -> None:
    table = f"{{against: time, x: [0, 1], y: [0, 4], outside: {outside}}}"
    s = da.simulate(rotor("{position: 0}", table), "2 s")
    slack = 4e-9 if outside == "zero" else 0.0  # 1e-9 of its span beyond its end it is at the end
    assert s["drive.O.speed"][-1] == pytest.approx((2 + last + slack) / J, rel=1e-10)
    assert set(s.result.status) == ({"ok", "outside_table"} if outside == "refuse" else {"ok"})


def test_many_designs_of_an_effort_by_speed_decay() -> None:
    """w' = -w/J."""
    k = da.compile_motion(rotor("{effort: -O.speed N*m}"), "1 s", ["start.O.speed"])
    speed = np.array([2.0, -3.0])
    assert k(speed[:, None]).speed[:, 0] == pytest.approx(speed * np.exp(-1 / J), rel=1e-8)


@pytest.mark.parametrize("sign", ["", "-"])
def test_a_parameter_of_an_effort_by_speed_has_its_dimension(sign: str) -> None:
    k = "parameters: {k: 0.02 N*m*s^2}\n"
    m = da.loads(
        k
        + ROTOR
        + f"drives: {{O: {{effort: {sign}k*O.speed^2}}}}\nstart: {{O: {{position: 0, speed: 2 rad/s}}}}"
    )
    assert da.simulate(m, "1 s").speed("O")[-1] == pytest.approx(
        2 / (1 - (-1 if sign else 1) * 0.04 / J), rel=1e-9
    )


def test_the_drive_of_a_copy_has_an_effort_by_its_own_speed() -> None:
    drives = "drives: {O: {effort: -0.02*O.speed^2 N*m}}\ncopies: [{of: [rotor], count: 2}]\n"
    start = "start: {O: {position: 0, speed: 50 rad/s}, O_2: {position: 0, speed: 10 rad/s}}"
    s = da.simulate(
        da.loads(ROTOR.replace("ground: {points: {", "ground: {points: {O_2: [1, 0], ") + drives + start),
        "1 s",
    )
    for name, first in (("O", 50.0), ("O_2", 10.0)):
        assert s.speed(name)[-1] == pytest.approx(first / (1 + 0.02 * first / J), rel=1e-10)
