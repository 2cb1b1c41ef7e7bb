"""What acts on drives that forces move: efforts, motors, laws, stops; where each begins, and what is refused."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.motion.actuation import (
    FADES,
    Actuation,
    actuation,
    drive_lengths,
    joint_stops,
    read_start,
)
from dalembert.machine.motion.coded.acting_nodes import within
from dalembert.machine.motion.stops.stop_loads import _holding, stop_effort
from dalembert.model.drives.end_stops import Stops

UNKNOWN: Any = None
LINKS = """
gravity: none
links:
  ground: {points: {O: [0, 0], S: [0, 0]}}
  disc: {points: {O: [0, 0], R: [0.3, 0.1]}, inertia: 2}
  ram: {points: {F: [0, 0]}, mass: 3}
  axle: {points: {O: [0, 0]}, inertia: 1}
joints:
  O: {type: pin, links: [ground, disc]%s}
  S: {type: slider, links: [ground, ram], at: [S, F], direction: 0}
  A: {type: pin, links: [ground, axle], at: O}
drives:
"""


def machine(drives: str, pin: str = "", more: str = "") -> Any:
    return da.loads(LINKS % pin + drives + more)


def three(first: str, second: str = "position: 0", third: str = "position: 0") -> str:
    """Drives of the disc, the ram and the axle."""
    return f"  O: {{{first}}}\n  S: {{{second}}}\n  A: {{{third}}}\n"


THREE = """
  O: {position: 0.5 rad, motor: {stall: 40, no_load: 30 rad/s, ratio: 4, inertia: 0.02, efficiency: 0.9}}
  S: {position: 0.2, effort: 'S.speed*2 + 5*time', stops: {from: 0.1, to: 0.6, stiffness: 100, damping: 7}}
  A: {position: 3 rad, speed: 2 rad/s, acceleration: 0.5 rad/s^2}
"""


def test_efforts_are_those_of_motors_texts_and_elastic_stops() -> None:
    acting = actuation(machine(THREE))[1]
    assert acting.free.tolist() == [True, True, False]
    assert acting.position.tolist() == [0.5, 0.2, 3.0]
    assert acting.speed.tolist() == [0.0, 0.0, 2.0]
    assert acting.accelerations(1.0).tolist() == [0.0, 0.0, 0.5]
    q, u = np.array([0.7, 0.75, 1.0]), np.array([2.0, 0.5, 3.0])
    motor = 4 * 40 * (1 - 4 * 2 / 30)
    stop = -(100 * 0.15 + 7 * 0.5)
    assert acting.effort(0.25, q, u) == pytest.approx([motor, 2 * 0.5 + 5 * 0.25 + stop, 0.0])
    acting.gain[0] = 0.9
    assert acting.effort(0.25, q, u)[0] == pytest.approx(0.9 * motor)
    known = acting.known(0.25, q, u)
    names = {"O": 0.7, "S": 0.75, "A": 1.0, "O.speed": 2.0, "S.speed": 0.5, "A.speed": 3.0}
    assert {n: x for n, x in known.items() if n in names} == names
    assert acting.lines(u, u) is None
    along = SimpleNamespace(position=np.stack([q, q * 0]), speed=np.stack([u, -u]))
    forces = acting.elastic_forces(along)  # type: ignore[arg-type]
    assert forces == pytest.approx(np.array([[0, stop, 0], [0, 100 * 0.1 + 7 * 0.5, 0]]))
    assert [s.what for s in acting.switched_efforts] == ["the stop of drive 'S'"]


def test_a_rotor_behind_a_gear_has_its_inertia_times_gain_and_ratio_squared() -> None:
    """The gear's efficiency counts in the sense of its power: driving by eta, driven by 1 / eta."""
    acting = actuation(machine(THREE))[1]
    assert (acting.lossy.tolist(), [*acting.gears]) == ([True, False, False], [0])
    for side, toward, gain in ((1.0, 1.0, 0.9), (-1.0, 1.0, 1 / 0.9), (1.0, -1.0, 1 / 0.9), (-1, -1, 0.9)):
        acting.side[0] = side
        rotor = acting.take_ways(np.array([toward, 1.0, 1.0]))
        assert acting.gain == pytest.approx([gain, 1, 1])
        assert rotor == pytest.approx([0.02 * 16 * gain, 0, 0])
    u, a = np.array([2.0, 0, 0]), np.array([7.0, 1, 1])
    assert acting.shaft(0, u, a) == pytest.approx(160 * (1 - 8 / 30) - 0.02 * 16 * 7)
    assert acting.powers(0.0, u, u, np.array([3.0, 5, 7])) == pytest.approx([6, 0, 0])


def test_a_motor_without_gear_is_a_straight_line_until_its_corner() -> None:
    motor = "motor: {curve: {speed: [0 rad/s, 10 rad/s, 20 rad/s], torque: [8, 6, 0]}}"
    text = three(f"position: 0, {motor}", "position: 0, effort: 7 N")
    acting = actuation(machine(text))[1]
    first, slope = acting.lines(np.array([5.0, 1, 1]), np.ones(3))  # type: ignore[misc]
    assert (first, slope) == (pytest.approx([8, 7, 0]), pytest.approx([-0.2, 0, 0]))
    for ahead, line in ((1.0, (12, -0.6)), (-1.0, (8, -0.2))):
        first, slope = acting.lines(np.array([10.0, 1, 1]), np.array([ahead, 1, 1]))  # type: ignore[misc]
        assert (first[0], slope[0]) == pytest.approx(line)
    acting.on[0] = False
    assert acting.lines(np.array([5.0, 1, 1]), np.ones(3))[0].tolist() == [0, 7, 0]  # type: ignore[index]
    assert acting.effort(0.0, np.zeros(3), np.array([5.0, 1, 1])).tolist() == [0, 7, 0]
    assert acting.longest_step == math.inf


def test_a_late_motor_follows_its_curve_with_its_time_constant() -> None:
    late = "position: 0, motor: {stall: %d, no_load: %d rad/s, time_constant: %s s}"
    text = three(late % (40, 30, 0.2), third=late % (8, 5, 0.5))
    acting = actuation(machine(text))[1]
    assert acting.late == [0, 2]
    assert acting.longest_step == pytest.approx(FADES * 0.2)
    acting.torque = np.array([11.0, 3.0])
    u = np.array([6.0, 9.0, 2.0])
    assert acting.torque_rates(u) == pytest.approx([(32 - 11) / 0.2, (8 * 0.6 - 3) / 0.5])
    assert acting.effort(0.0, u, u) == pytest.approx([11, 0, 3])
    assert acting.motor_effort(2, u) == 3.0
    acting.on[2] = False
    assert acting.torque_rates(u)[1] == pytest.approx(-3 / 0.5)
    assert acting.steady(2, u) == 0
    assert acting.lines(u, u) is None


@pytest.mark.parametrize(
    ("switch", "begins"),
    [
        ("0 s", True),
        ("1 s", False),
        ("0.5 rad", True),
        ("0.4 rad", False),
        ("0 rad/s", True),
    ],
)
def test_a_motor_is_on_at_once_where_its_switch_is_at_its_value(switch: str, begins: bool) -> None:
    text = three(f"position: 0.5 rad, motor: {{stall: 40, no_load: 30 rad/s, on: {switch}}}")
    acting = actuation(machine(text))[1]
    assert acting.on.tolist() == [begins, False, False]
    of = acting.motors[0].on
    assert of is not None
    at = {"time": 2.0, "position": 3.0, "speed": 5.0}[of[0]] - of[1]
    assert acting.switched(of, 0, 2.0, np.array([3.0, 0, 0]), np.array([5.0, 0, 0])) == pytest.approx(at)


def test_prescribed_drives_follow_their_laws() -> None:
    law = "{type: harmonic, from: 0.1, to: 0.5, duration: 2 s, count: 5}"
    text = three("position: 0, effort: 1", f"law: {law}", "position: 0, speed: 1 rad/s")
    acting = actuation(machine(text))[1]
    assert [*acting.laws] == [1]
    assert acting.next_joint(-1.0) == 0.0
    assert acting.next_joint(0.5) == 2.0
    bend = 0.4 * math.pi**2 / 2 / 4 * math.cos(math.pi * 0.25)
    assert acting.accelerations(0.5) == pytest.approx([0, bend, 0])
    y = np.arange(10.0, 17.0)
    acting.follow_laws(0.5, 2.0, y)
    assert y[[0, 2, 3, 5, 6]].tolist() == [10, 12, 13, 15, 16]
    s, v = 0.1 + 0.2 * (1 - math.cos(math.pi / 4)), 0.2 * math.pi / 2 * math.sin(math.pi / 4)
    assert y[[1, 4]] == pytest.approx([s, v])
    assert acting.laws[1].end == 2.0
    acting.follow_laws(0.5, 0.25, y)  # back: no end
    assert acting.laws[1].end == math.inf
    assert actuation(machine(THREE))[1].next_joint(0.0) == math.inf


def test_a_drive_starts_where_its_start_its_law_or_its_first_position_is() -> None:
    """A released drive is not accelerated; a prescribed one keeps its first acceleration."""
    text = three(
        "position: {from: 0.5 rad, to: 2 rad, count: 4}, speed: 3 rad/s, acceleration: 5 rad/s^2, effort: 1",
        "position: [0.2, 0.4], speed: 0.7, acceleration: 0.9",
    )
    more = "start: {A: {position: 1.5 rad, speed: -2 rad/s}}\n"
    prescribed, acting = actuation(machine(text, more=more))
    assert acting.position.tolist() == [0.5, 0.2, 1.5]
    assert acting.speed.tolist() == [3.0, 0.7, -2.0]
    assert acting.acceleration.tolist() == [0.0, 0.9, 0.0]
    assert acting.free.tolist() == [True, False, True]
    assert [d.position for d in prescribed.drives.values()] == [0.5, 0.2, 1.5]
    assert {d.speed for d in prescribed.drives.values()} == {1.0}
    assert all(d.effort is None and d.motor is None and d.law is None for d in prescribed.drives.values())
    again = actuation(
        machine(text, more=more), read_start(machine(text), {"S": {"position": 0.3, "speed": 4}})
    )[1]
    assert again.free.all()
    assert (again.position.tolist(), again.speed.tolist()) == ([0.5, 0.3, 1.5], [3.0, 4.0, -2.0])
    assert read_start(machine(text), None) == read_start(machine(text), {}) == {}
    with pytest.raises(da.ModelError, match="start names the drive 'B', which does not exist"):
        read_start(machine(text), {"B": {"position": 0}})


REST = "  S: {position: 0}\n  A: {position: 0}\n"


@pytest.mark.parametrize(
    ("drives", "pin", "said"),
    [
        ("  O: {position: 0}\n" + REST, "", "no drive is free: none has a start, a motor or an effort"),
        (
            "  O: {position: 0, effort: 1}\n  S: {position: 0, brake: 5}\n  A: {position: 0}\n",
            "",
            "drive 'S' is prescribed, and its brake would have no effect",
        ),
        (
            "  O: {position: 0, effort: 1}\n  S: {position: 0, stops: {from: -1, to: 1}}\n  A: {position: 0}\n",
            "",
            "drive 'S' is prescribed, and its stops would be gone through",
        ),
        (
            "  O: {position: 0, effort: 1, stops: {from: -1 rad, to: 1 rad}}\n" + REST,
            ", stops: {from: -1 rad, to: 1 rad}",
            "joint 'O' and its drive have stops; leave one of them out",
        ),
    ],
)
def test_what_does_not_move_by_forces_is_refused(drives: str, pin: str, said: str) -> None:
    with pytest.raises(da.ModelError) as refused:
        actuation(machine(drives, pin))
    assert said in str(refused.value)


def test_stops_of_a_driven_joint_become_those_of_its_drive() -> None:
    m = machine("  O: {position: 0, effort: 1}\n" + REST, ", stops: {from: -1 rad, to: 2 rad}")
    assert {k: (s.least, s.greatest) for k, s in joint_stops(m).items()} == {("O", "turn"): (-1.0, 2.0)}
    prescribed, acting = actuation(m)
    stops = acting.drives[0].stops
    assert stops is not None
    assert (stops.least, stops.greatest) == (-1.0, 2.0)
    assert joint_stops(prescribed) == {}
    assert joint_stops(acting.m)  # as it was described


def test_positions_of_drives_are_measured_by_the_size_of_links() -> None:
    m = machine("  O: {position: 5}\n  S: {position: -0.25}\n  A: {position: 0}\n")
    assert drive_lengths(m).tolist() == [1.0, 0.3, 1.0]
    lone = """
links: {ground: {points: {S: [0, 0]}}, ram: {points: {F: [0, 0]}, mass: 1}}
joints: {S: {type: slider, links: [ground, ram], at: [S, F]}}
drives: {S: {position: %s}}
"""
    assert drive_lengths(da.loads(lone % "-0.25")).tolist() == [0.25]
    assert drive_lengths(da.loads(lone % "0")).tolist() == [1.0]


@pytest.mark.parametrize(
    ("x", "found"),
    [(5.5, 5.5), (-1.0, 2 * math.pi - 1), (11.9, 11.9 - 2 * math.pi), (4.5, 4.5), (0.2, 0.2 + 2 * math.pi)],
)
def test_an_angle_between_stops_is_found_up_to_full_turns(x: float, found: float) -> None:
    assert within(Stops(5.0, 6.0), x) == pytest.approx(found)
    assert within(Stops(-6.0, -5.0), -x) == pytest.approx(-found)
    wide = Stops(-20.0, 20.0)
    assert within(wide, x) == pytest.approx(min((x + 2 * math.pi * n for n in range(-2, 3)), key=abs))


def held(ends: Any, effort: Any) -> Any:
    return SimpleNamespace(
        drives=("O", "S"),
        friction=None if ends is None else True,
        interval=lambda name: np.array(ends, float)[:, ("O", "S").index(name)],
        effort_array=np.array(effort, float),
    )


def test_a_stop_bears_what_friction_and_brake_leave() -> None:
    """A drive pushed by 20 N that stays with 3 to 8 N, its brake holding 2 more: 10 N are the stop's."""
    ends = [[[0, 0], [3, 8]], [[0, 0], [np.nan, np.nan]], [[0, 0], [3, 8]], [[0, 0], [3, 8]]]
    r, brake = held(ends, [[0, 5], [0, 6], [0, 5], [0, 5]]), np.array([0.0, 2.0])
    low, high = _holding(r, 1, brake)
    assert (low.tolist(), high.tolist()) == ([1, 4, 1, 1], [10, 8, 10, 10])
    pushed = np.array([[np.nan, 20.0], [np.nan, 20.0], [np.nan, -4.0], [np.nan, np.nan]])
    assert stop_effort(r, pushed, brake).tolist() == [[0, -10], [0, -12], [0, 5], [0, 0]]
    smooth = held(None, [[0, 5]] * 4)
    assert stop_effort(smooth, pushed, 0 * brake).tolist() == [[0, -15], [0, -15], [0, 9], [0, 0]]
    assert not stop_effort(smooth, np.full((4, 2), np.nan), brake).any()


def test_what_an_actuation_is_without_a_motor() -> None:
    acting = actuation(machine("  O: {position: 0, effort: 6}\n" + REST))[1]
    assert isinstance(acting, Actuation)
    assert not acting.on.any()
    assert (acting.gears, acting.late, acting.motors) == ({}, [], {})
    assert (acting.turns.tolist(), acting.brake.tolist()) == ([True, False, True], [0, 0, 0])
    first, slope = acting.lines(np.ones(3), np.ones(3))  # type: ignore[misc]
    assert (first.tolist(), slope.tolist()) == ([6, 0, 0], [0, 0, 0])
