"""Motions under forces in closed form: motors switched while at rest, laws that end, tables that repeat, wheels that
land, prescribed machines that drive against a stop."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from tests.elements.test_landing import signs
from tests.machine.test_refused_machines import CROSS
from tests.machine.test_simulate import FOUR_BAR

G = 9.80665
ROTOR = """
links: {ground: {points: {O: [0, 0]}}, rotor: {points: {O: [0, 0]}, mass: 1, inertia: 0.5}}
joints: {O: {type: pin, links: [ground, rotor]}}
start: {O: {position: 0, speed: %s}}
drives: {O: %s}
"""


def rotor(drive: str, speed: str = "0") -> Any:
    return da.loads(ROTOR % (speed, drive))


def said(s: da.Simulation) -> list[tuple[float, str]]:
    return [(e.time, e.sentence) for e in s.events]


HELD = "O comes to rest and stays: friction holds it; effort 0 N*m, held from -4 N*m to 4 N*m"


def test_a_motor_that_is_switched_on_at_rest_is_held_by_the_brake_until_it_is_off_again() -> None:
    """3 N m at standstill beside a brake of 4 N m."""
    s = da.simulate(
        rotor("{motor: {stall: 3 N*m, no_load: 60 rad/s, on: 1 s, off: 2 s}, brake: 4 N*m}"), "4 s", count=9
    )
    assert said(s) == [
        (0.0, HELD),
        (1.0, "the motor of O is switched on"),
        (2.0, "the motor of O is switched off"),
    ]
    assert s.ended == "at rest from 0 s on"
    assert not s.position("O").any()
    assert s.result.effort("O").tolist() == [0.0] * len(s.time)


def test_a_motor_that_is_switched_on_at_rest_runs_up_against_the_brake() -> None:
    """J w' = 6 (1 - w/60) - 4 from 1 s on; switched off at 2 s, the brake stops it within J w/4."""
    motor = "{motor: {stall: 6 N*m, no_load: 60 rad/s, on: 1 s, off: 2 s}, brake: 4 N*m}"
    s = da.simulate(rotor(motor), "4 s", count=9)
    fast = 20 * (1 - math.exp(-0.2))
    stopped = 2 + 0.5 * fast / 4
    events = [when for when, _ in said(s)]
    assert events == pytest.approx([0, 1, 1, 2, stopped], rel=1e-9)
    assert [text for _, text in said(s)] == [
        HELD,
        "the motor of O is switched on",
        "O starts again",
        "the motor of O is switched off",
        HELD,
    ]
    t = s.time
    speed = np.where(
        t < 1, 0, np.where(t < 2, 20 * (1 - np.exp(-(t - 1) / 5)), np.maximum(fast - 8 * (t - 2), 0))
    )
    assert s.speed("O") == pytest.approx(speed, abs=1e-8)
    assert s.status == "ended"
    assert max(s.energy_residual, s.law_residual) < 1e-9


def beside(law: str) -> Any:
    """A cart that is pushed with 1 N, and another one, of 1 kg across it, that follows a law."""
    return da.loads(CROSS % ("", "") + f"drives: {{S: {{effort: 1}}, T: {{law: {{count: 3, {law}}}}}}}")


def test_a_rise_begins_at_once_and_stays_where_it_ends() -> None:
    """h/2 (1 - cos(pi t)) with its acceleration at both ends on the side of the rise."""
    s = da.simulate(beside("type: harmonic, from: 0.1, to: 0.3, duration: 1"), "1.5 s", count=7)
    t = s.time
    during = t <= 1
    wave = math.pi * np.minimum(t, 1)
    assert s.position("T") == pytest.approx(0.1 + 0.1 * (1 - np.cos(wave)), abs=1e-12)
    assert s.speed("T") == pytest.approx(0.1 * math.pi * np.sin(wave), abs=1e-12)
    bend = np.where(during, 0.1 * math.pi**2 * np.cos(wave), 0)
    assert s.acceleration("T") == pytest.approx(bend, abs=1e-12)
    assert s.result.effort("T") == pytest.approx(bend, abs=1e-12)
    assert s.position("S") == pytest.approx(t**2 / 4, abs=1e-12)
    assert s.works["T"] == pytest.approx(0.5 * s.speed("T") ** 2, abs=1e-12)
    assert s.status == "ended"


def test_a_motion_ends_where_a_table_over_time_does() -> None:
    from scipy.interpolate import CubicSpline

    times, places = [0, 0.2, 0.5, 1], [0, 0.06, 0.1, 0.2]
    s = da.simulate(beside(f"type: table, time: {times}, position: {places}"), "1.5 s", count=7)
    assert (s.status, s.ended) == ("stopped", "stopped at 1 s: the law of T ends at 1 s")
    assert s.time.tolist() == pytest.approx([0, 0.25, 0.5, 0.75, 1])
    assert s.position("T") == pytest.approx(CubicSpline(times, places)(s.time), abs=1e-12)
    assert s.position("S") == pytest.approx(s.time**2 / 4, abs=1e-12)


def work_over(q: Any, x: list[float], y: list[float], period: float = math.inf) -> Any:
    """Integral from 0 to q of a table in straight pieces."""
    turns, rest = np.divmod(q, period)
    edges, values = np.radians(x), np.array(y)
    whole = np.concatenate([[0.0], np.cumsum(np.diff(edges) * (values[1:] + values[:-1]) / 2)])
    k = np.minimum(np.searchsorted(edges, rest, "right") - 1, len(edges) - 2)
    s = rest - edges[k]
    slope = np.diff(values)[k] / np.diff(edges)[k]
    return np.where(turns > 0, turns, 0) * whole[-1] + whole[k] + values[k] * s + slope * s**2 / 2


@pytest.mark.parametrize("way", [1, -1])
def test_an_effort_of_a_table_that_repeats_gives_its_work(way: int) -> None:
    """J (w^2 - w0^2)/2 is the area below the table, turn by turn, forwards and backwards."""
    x, y = [0.0, 90, 180, 270, 360], [0.0, 2, 0, -4, 0]
    table = f"{{effort: {{x: {x}, y: {y}, against: O, periodic: true}}}}"
    s = da.simulate(
        rotor(table, f"{20 * way} rad/s"),
        f"O.position = {900 * way} deg",
        events=[f"O.position = {450 * way} deg"],
    )
    q = s.position("O")
    assert q[-1] == pytest.approx(way * 5 * math.pi, rel=1e-12)
    seen = y if way > 0 else [-v for v in y[::-1]]  # backwards from the end of a turn
    work = work_over(way * q, x, seen, 2 * math.pi)
    assert s.speed("O") == pytest.approx(way * np.sqrt(400 + 4 * work), rel=1e-9)
    assert s.energy_residual < 1e-9
    assert [e.sentence for e in s.event("condition")] == [f"O.position = {n * way} deg" for n in (450, 900)]


def test_compiled_motions_have_the_work_of_their_tables() -> None:
    """Each design ends at 450 deg, behind the table's end, whose last value holds on."""
    x, y = [0.0, 90, 180, 270, 360], [0.0, 2, 0, -4, 1]
    m = rotor(f"{{effort: {{x: {x}, y: {y}, against: O}}}}", "20 rad/s")
    k = da.compile_motion(m, ["5 s", "O.position = 450 deg"], ["links.rotor.inertia"], ["effort.O"], "final")
    inertia = np.array([0.5, 0.6, 2.0])
    r = k(inertia[:, None])
    work = (2 / 2 + 2 / 2 - 4 / 2 - 3 / 2 + 1) * math.pi / 2
    assert r.speed[:, 0] == pytest.approx(np.sqrt(400 + 2 * work / inertia), rel=1e-9)
    assert r.value("effort.O") == pytest.approx([1.0] * 3, rel=1e-12)
    assert r.ended == ("O.position = 450 deg",) * 3


def test_a_prescribed_crank_drives_a_rocker_against_its_stop() -> None:
    """Beside it a cart coasts, which cannot help: the motion ends where the rocker meets the stop."""
    changes = {
        "drives: {O2: {effort: 0}}": "drives: {O2: {position: 60, speed: 2 rad/s}, S: {effort: 1}}",
        "start: {O2: {position: 60 deg, speed: 30 rad/s}}": "start: {S: {position: 0, speed: 0}}",
        "links:\n": "links:\n  cart: {points: {O2: [0, 0]}, mass: 2}\n",
        "joints:\n": "joints:\n  S: {type: slider, links: [ground, cart], at: O2, direction: 0}\n",
        "[ground, rocker]}": "[ground, rocker], stops: {from: 0, to: 115}}",
    }
    text = FOUR_BAR
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new)
    s = da.simulate(da.loads(text), "2 s", count=3)
    assert s.status == "stopped"
    assert s.ended.endswith(": O4 is driven against its stop by what is prescribed")
    assert math.degrees(s.result.angle("rocker")[-1]) == pytest.approx(115, rel=1e-12)
    assert s.position("O2")[-1] == pytest.approx(math.radians(60) + 2 * s.time[-1], rel=1e-12)
    assert s.position("S")[-1] == pytest.approx(s.time[-1] ** 2 / 4, rel=1e-9)


ROLL = """
gravity: standard
links: {ground: {points: {O: [0, 0]}}, disc: {points: {C: [0, 0]}, mass: 3, inertia: 0.015}}
joints:
  track: {type: rolling, links: [ground, disc], at: [O, C], radius: 0.1, direction: 0,
          contact: {pushes: true, restitution: 0}}
drives: {track: {effort: 0}}
start: {track: {position: 0, speed: 10 rad/s}}
loads:
  F: {type: force, on: disc, at: C, value: [0, "30*(sign(time - 0.01) - sign(time - 0.11))"]}
  M: {type: couple, on: disc, value: "0.15*(sign(time - 0.01) - sign(time - 0.11))"}
"""


def test_a_wheel_that_is_lifted_and_spun_rolls_again_when_it_lands() -> None:
    """In the air 60 N lift it and 0.3 N m spin it for 0.1 s; landing keeps J w - m r v about the place of contact."""
    s = da.simulate(da.loads(ROLL), "0.6 s", count=4)
    mass, inertia, radius, before = 3, 0.015, 0.1, 10.0
    rise = 60 / mass - G
    up, high = rise * 0.1, rise * 0.1**2 / 2
    down = math.sqrt(up**2 + 2 * G * high)
    land = 0.11 + (up + down) / G
    spun = before + 0.3 * 0.1 / inertia
    after = (inertia * spun + mass * radius * before * radius) / (inertia + mass * radius**2)
    left, landed = s.events
    assert (left.name, left.sentence, landed.name) == ("lift-off", "track lifts off", "landing")
    assert [left.time, landed.time] == pytest.approx([0.01, land], rel=1e-12)
    assert landed.lost == pytest.approx(mass * down**2 / 2, rel=1e-9)
    at = np.searchsorted(s.time, land * (1 - 1e-9))
    assert s.result.speed("disc") == pytest.approx(
        [10, 10, spun, spun, *[after] * (len(s.time) - at)], rel=1e-9
    )
    velocity = s.result.point_velocity("disc", "C")
    assert velocity[:at, 0] == pytest.approx(-1.0, rel=1e-9)
    assert velocity[at:, 0] == pytest.approx(-radius * after, rel=1e-9)
    slip = (mass * 1.0**2 + inertia * spun**2 - (mass * radius**2 + inertia) * after**2) / 2
    assert s.works["impacts"][-1] == pytest.approx(-mass * down**2 / 2 - slip, rel=1e-9)
    assert s.works["loads"][-1] == pytest.approx(60 * high + 0.3 * 0.1 * (before + spun) / 2, rel=1e-9)
    signs(s)


def test_what_coasts_without_end_is_looked_at_at_every_radian() -> None:
    """No step of the integration is needed, yet each radian counts as one: 1000 rad/s for some 5000 of them."""
    s = da.simulate(rotor("{effort: 0}", "1000 rad/s"), "O.speed = 0 rad/s", steps=5000)
    assert s.status == "not_met"
    assert s.ended.startswith("O.speed = 0 rad/s is not met within ")
    assert s.position("O") == pytest.approx(1000 * s.time, rel=1e-12)
    assert 1000 < s.position("O")[-1] <= 5000


def test_what_has_no_inertia_is_not_moved() -> None:
    text = (ROTOR % ("0", "{effort: 1}")).replace("mass: 1, inertia: 0.5", "mass: 1")
    with pytest.raises(ModelError) as refused:
        da.simulate(da.loads(text), "1 s")
    assert "forces that move O move no mass; give its links masses" in str(refused.value)


PRESSED = """
links: {ground: {points: {O: [0, 0]}}, one: {points: {O: [0, 0]}, mass: 3}, two: {points: {O: [0, 0]}, mass: 1}}
joints:
  A: {type: slider, links: [ground, one], at: O}
  B: {type: slider, links: [one, two], at: O}
  D: {type: slider, links: [ground, two], at: O, stops: {from: 0 m, restitution: 0}}
drives: {A: {effort: 0, brake: 5 N}, B: {effort: "-3 - 10*time"}}
start: {A: {position: 1, speed: 0}, B: {position: -0.98, speed: 0}}
"""


def test_a_braked_cart_pushes_another_to_its_stop_and_is_then_pushed_itself() -> None:
    """3 N + 10 N/s t between them: 0.02 m = 1.5 t^2 + 5/3 t^3 to its stop; at 0.2 s the brake gives way."""
    s = da.simulate(da.loads(PRESSED), "0.4 s", count=5)
    (root,) = (x.real for x in np.roots([5 / 3, 1.5, 0, -0.02]) if abs(x.imag) < 1e-12 and x.real > 0)
    speed = 3 * root + 5 * root**2
    events = {(e.name, e.of): e.time for e in s.events}
    assert [(e.name, e.of) for e in s.events] == [
        ("rest", "A"), ("impact", "D"), ("rest", "D"), ("rest", "A"), ("start", "A"),
    ]  # fmt: skip
    assert [events["impact", "D"], events["start", "A"]] == pytest.approx([root, 0.2], rel=1e-9)
    hit = s.event("impact")[0]
    assert (hit.speed, hit.lost) == (pytest.approx(speed, rel=1e-9), pytest.approx(speed**2 / 2, rel=1e-9))
    t = s.time
    one = 1 + 10 * np.maximum(t - 0.2, 0) ** 3 / 18
    two = np.maximum(0.02 - 1.5 * t**2 - 5 / 3 * t**3, 0)
    assert s.position("A") == pytest.approx(one, abs=1e-10)
    assert s.position("B") == pytest.approx(two - one, abs=1e-10)
    pushed = np.where(t >= root * (1 - 1e-12), 3 + 10 * t, 0)
    assert s.joint_stop_force["D"] == pytest.approx(pushed, rel=1e-9, abs=1e-9)
    held = [e.sentence for e in s.events if (e.name, e.of) == ("rest", "A")]
    assert held == [
        f"A comes to rest and stays: friction holds it; effort 0 N, held from {-8 - 10 * x:.6g} N to {2 - 10 * x:.6g} N"
        for x in (0.0, root)
    ]
    assert max(s.energy_residual, s.law_residual) < 1e-9


def test_a_motion_without_end_is_looked_at_for_some_time_only() -> None:
    """At a milliradian a second a step takes long: the time is the limit, not the steps."""
    s = da.simulate(rotor("{effort: 0}", "0.001 rad/s"), "O.speed = 1 rad/s")
    assert (s.status, s.ended) == ("not_met", "O.speed = 1 rad/s is not met until 100000 s")
    assert (s.time[-1], s.position("O")[-1]) == (1e5, pytest.approx(100, rel=1e-9))


def test_a_brake_gives_way_while_another_cart_is_on_its_way() -> None:
    """3 N + 10 N/s t push two away from one, whose brake of 5 N holds until 0.2 s; two is moved by them alone."""
    s = da.simulate(da.loads(PRESSED.replace("position: -0.98", "position: -0.5")), "0.35 s", count=8)
    assert [(e.name, e.of) for e in s.events] == [("rest", "A"), ("start", "A")]
    assert s.events[1].time == pytest.approx(0.2, rel=1e-9)
    t = s.time
    one = 1 + 10 * np.maximum(t - 0.2, 0) ** 3 / 18
    two = 0.5 - 1.5 * t**2 - 5 / 3 * t**3
    assert s.position("A") == pytest.approx(one, abs=1e-10)
    assert s.position("B") == pytest.approx(two - one, abs=1e-10)
    assert max(s.energy_residual, s.law_residual) < 1e-9


CURVE = "{speed: [10 rad/s, 30 rad/s, 80 rad/s, 100 rad/s], torque: [6 N*m, 8 N*m, 3 N*m, 0 N*m]}"


@pytest.mark.parametrize("begin", [0.0, -5.0, 20.0])
def test_many_designs_run_up_along_the_curve_of_a_motor(begin: float) -> None:
    """J w' = T(w) in straight pieces, level before the first point: t = J/b ln(T2/T1) of each, behind a gear too."""
    text = ROTOR % (f"{begin} rad/s", f"{{motor: {{curve: {CURVE}, ratio: 2}}}}")
    m = da.loads(text)
    inertia = np.array([0.5, 0.8, 3.0])
    k = da.compile_motion(m, ["60 s", "O.speed = 45 rad/s"], ["links.rotor.inertia"], ["effort.O"], "final")
    r = k(inertia[:, None])
    w, torque = np.array([10.0, 30, 80, 90]), np.array([6.0, 8, 3, 1.5])

    def at(speed: float) -> float:
        return float(np.interp(speed, w, torque))

    points = [2 * begin, *(x for x in w if x > 2 * begin)]
    taken = 0.0  # time on the motor's shaft for a unit inertia there
    for a, b in pairwise(points):
        slope = (at(b) - at(a)) / (b - a)
        taken += math.log(at(b) / at(a)) / slope if slope else (b - a) / at(a)
    assert r.time == pytest.approx(inertia * taken / 4, rel=1e-8)
    assert r.value("effort.O") == pytest.approx([3.0] * 3, rel=1e-9)
    for one, time in zip(inertia, r.time, strict=True):
        s = da.simulate(m.with_values({"links.rotor.inertia": float(one)}), ["60 s", "O.speed = 45 rad/s"])
        assert s.time[-1] == pytest.approx(time, rel=1e-8)


def test_a_stop_that_is_only_just_met_within_a_step_is_not_stepped_over() -> None:
    """v = 1 - t: up to 0.49 m of the 0.5 m that it would go, back with half the speed; alone and among many."""
    text = """
links: {ground: {points: {O: [0, 0]}}, cart: {points: {O: [0, 0]}, mass: heavy}}
parameters: {heavy: 1 kg}
joints: {S: {type: slider, links: [ground, cart], at: O}}
drives: {S: {effort: -1 N, stops: {to: 0.49 m, restitution: 0.5}}}
start: {S: {position: 0, speed: 1}}
"""
    mass = np.array([1.0, 1.015, 0.97])
    r = da.compile_motion(da.loads(text), "1.5 s", ["heavy"])(mass[:, None])
    meets = 1 - 0.98 / mass
    hit = mass * (1 - np.sqrt(np.maximum(meets, 0)))
    back = -np.sqrt(np.maximum(meets, 0)) / 2
    after = np.where(meets > 0, 1.5 - hit, np.nan)
    place = np.where(meets > 0, 0.49 + back * after - after**2 / 2 / mass, 1.5 - 1.5**2 / 2 / mass)
    speed = np.where(meets > 0, back - after / mass, 1 - 1.5 / mass)
    assert (meets > 0).tolist() == [True, True, False]
    assert r.position[:, 0] == pytest.approx(place, abs=1e-9)
    assert r.speed[:, 0] == pytest.approx(speed, abs=1e-9)
    assert r.redone == 0
    for one, x in zip(mass, place, strict=True):
        s = da.simulate(da.loads(text).with_values({"heavy": float(one)}), "1.5 s", count=2)
        assert s.position("S")[-1] == pytest.approx(x, abs=1e-10)


def test_two_carts_of_many_designs_bounce_off_each_other() -> None:
    """Momentum is kept, the speed between them comes back with 0.6 of it; drives are one's place and two's from one."""
    text = """
links: {ground: {points: {O: [0, 0]}}, one: {points: {O: [0, 0]}, mass: 3 kg}, two: {points: {O: [0, 0]}, mass: 1 kg}}
joints: {A: {type: slider, links: [ground, one], at: O}, B: {type: slider, links: [one, two], at: O}}
drives: {A: {effort: 0}, B: {effort: 0, stops: {from: 0 m, restitution: 0.6}}}
start: {A: {position: 0.2 m, speed: 0.5}, B: {position: 0.1 m, speed: -4}}
"""
    one = np.array([3.0, 2.0, 9.0])
    r = da.compile_motion(da.loads(text), "0.15 s", ["links.one.mass"])(one[:, None])
    common = (one * 0.5 + 1 * (0.5 - 4)) / (one + 1)
    apart = 0.6 * 4
    after = common - apart / (one + 1)  # one; two has ``apart`` more
    assert r.speed == pytest.approx(np.stack([after, np.full(3, apart)], 1), rel=1e-9)
    meets = 0.1 / 4
    places = np.stack([0.2 + 0.5 * meets + after * (0.15 - meets), np.full(3, apart * (0.15 - meets))], 1)
    assert r.position == pytest.approx(places, rel=1e-9)
    assert r.redone == 0
