"""Numbers of an answer at their limits: what is rounding, which unit they have, when a contact is lost; by hand."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.compile.elements.cam_limits import worst_radius
from dalembert.analysis.compile.elements.cam_motion import cam_motion
from dalembert.analysis.compile.elements.profile_tables import _in_order, _radius_at
from dalembert.analysis.friction.efficiency import Efficiency, _steps, _work, supplied
from dalembert.analysis.friction.efficiency import durations as times
from dalembert.analysis.methods.contact_force import SPEEDS, ContactHistory, _lift_factor
from dalembert.analysis.methods.members import Member, Share
from dalembert.analysis.output.rounding import largest
from dalembert.analysis.output.summary.printed_units import Printed, scale_for, unit_with_power
from tests.elements.test_cam_cases import sliding

NAN, INF = math.nan, math.inf


@pytest.mark.parametrize(
    ("most", "least", "force", "moment"),
    [
        ({"force": 999_999.0}, INF, "N", "N*m"),
        ({"force": 999_999.6}, INF, "MN", "MN*m"),  # it would be printed as 1e+06
        ({"force": 1e6}, INF, "MN", "MN*m"),
        ({"force": 9.99e8}, INF, "MN", "MN*m"),
        ({"force": 1e9}, INF, "GN", "GN*m"),
        ({"moment": 9.9e5}, INF, "N", "N*m"),
        (
            {"moment": 1e6},
            INF,
            "kN",
            "kN*m",
        ),  # forces and moments have one power, and moments three more digits
        ({"moment": 9.9e8}, INF, "kN", "kN*m"),
        ({"force": 5.0, "moment": 2e9}, INF, "MN", "MN*m"),
        ({"moment": 1e12}, INF, "GN", "GN*m"),
        ({"force": 1e9}, 1.1e5, "GN", "GN*m"),
        ({"force": 1e9}, 0.9e5, "MN", "MN*m"),  # a force below 1e-4 of the unit: the next lower one
        ({"force": 1e9}, 101.0, "MN", "MN*m"),
        ({"force": 1.001e9}, 99.0, "MN", "MN*m"),  # in kN it would be printed with an exponent
        ({"force": 0.999e9}, 101.0, "MN", "MN*m"),
        ({"force": 0.999e9}, 99.0, "kN", "kN*m"),
        ({"force": 1e6}, 1e-3, "kN", "kN*m"),  # never below kN
        ({}, INF, "N", "N*m"),
    ],
)
def test_forces_and_moments_have_the_unit_of_the_largest(
    most: dict[str, float], least: float, force: str, moment: str
) -> None:
    for sign in (1.0, -1.0):
        to = scale_for(None, {kind: sign * size for kind, size in most.items()}, least)
        assert (to.text("force"), to.text("moment")) == (force, moment)


def test_powers_have_kilowatts_from_ten_on_and_stresses_megapascals() -> None:
    for size, unit in (
        (9_999.9, "W"),
        (1e4, "kW"),
        (9.99e5, "kW"),
        (1e6, "MW"),
        (0.0, "W"),
        (NAN, "W"),
        (INF, "W"),
    ):
        assert scale_for(None, {"power": size}).text("power") == unit
    assert scale_for(None, {}).text("pressure") == "MPa"
    assert scale_for({"length": "mm", "force": "kN"}, {}).text("pressure") == "N/mm^2"
    pounds = {"length": "in", "force": "lbf"}
    for size, unit in ((9e5, "lbf"), (1.1e6, "10^6 lbf")):
        assert scale_for(pounds, {"force": size * 4.4482216152605}).text("force") == unit
    foot = scale_for(pounds, {"power": 5e5 * 0.1129848290276167})
    assert foot.text("power") == "lbf*in/s"  # no watts: from a million on
    assert Printed(None, {"force": 6})("force", 5e6) == 5.0
    assert Printed({"length": "mm", "force": "kN"}).quantity("power", 250.0) == "250 W"
    assert Printed({"length": "ft", "force": "N"}).text("power") == "N*ft/s"
    assert [unit_with_power("N*mm", p) for p in (0, 3, 6)] == ["N*mm", "N*m", "kN*m"]
    assert [unit_with_power("N", p) for p in (0, 3, 12, 15)] == ["N", "kN", "TN", "10^15 N"]


def test_the_largest_number_of_each_position_is_by_size() -> None:
    a, b = np.array([[1.0, -5.0], [NAN, 2.0], [NAN, NAN]]), np.array([[[3.0]], [[-4.0]], [[0.0]]])
    assert largest(3, a, b).tolist() == [5.0, 4.0, 0.0]
    assert largest(3, b).tolist() == [3.0, 4.0, 0.0]
    assert largest(2, np.zeros((2, 0))).tolist() == [0.0, 0.0]


def parts(*forces: tuple[float, float, float]) -> Any:
    """Forces still + linear f + square f^2 of contacts at one position, at the factors at which they are computed."""
    return np.array([[[a + b * f + c * f * f for a, b, c in forces]] for f in SPEEDS])


@pytest.mark.parametrize(
    ("forces", "factor"),
    [
        ([(9.0, 0.0, -1.0)], 3.0),
        ([(9.0, 0.0, -1.0), (4.0, 0.0, -1.0), (4.0, 0.0, 1.0)], 2.0),
        ([(2.0, -1.0, 0.0)], 2.0),
        ([(2.0, -3.0, 1.0)], 1.0),  # and again at 2
        ([(9.0, 0.0, 1.0)], NAN),
        ([(9.0, 0.0, 0.0)], NAN),
        ([(2.0, -2.0, 1.0)], NAN),  # roots 1 +- i
        ([(1.0, -2.0, 1.0)], 1.0),  # it just touches
        ([(-1e-8, 0.0, 1.0)], 0.0),  # open at rest
        ([(-1e-12, 0.0, 1.0)], NAN),  # closed but for rounding
        ([(0.0, 0.0, -1.0)], NAN),
        ([(4.0, 0.0, -1.0), (NAN, 0.0, 0.0)], 2.0),
        ([], NAN),
    ],
)
def test_a_contact_is_lost_from_the_first_factor_of_the_speeds_at_which_its_force_is_zero(
    forces: list[tuple[float, float, float]], factor: float
) -> None:
    given = parts(*forces).reshape(3, 1, len(forces))
    size = float(np.nanmax(np.abs(given[1]), initial=0.0))
    assert _lift_factor(given, size) == pytest.approx(factor, rel=1e-6, nan_ok=True)


def test_a_force_of_zero_still_presses_and_one_below_is_none() -> None:
    needed = np.array([2.0, 0.0, -1e-300, -3.0])
    one = ContactHistory("A", needed, None, None, NAN, NAN)
    assert np.array_equal(one.force, [2.0, 0.0, NAN, NAN], equal_nan=True)
    groove = ContactHistory("A", needed, None, None, NAN, NAN, walls=np.zeros((2, 4)))
    assert groove.force is needed


def fake(position: Any, speed: Any, time: Any = None, period: float | None = None) -> Any:
    """What the times of a result are read from."""
    position, speed = np.array(position, float), np.array(speed, float)
    schedule = SimpleNamespace(
        time=time, position=position[:, None], speed=np.broadcast_to(speed, position.shape)[:, None]
    )
    compiled = SimpleNamespace(period=None if period is None else np.array([9.0, period]), target=np.zeros(1))
    return SimpleNamespace(schedule=schedule, status=("ok",) * len(position), compiled=compiled)


def test_the_time_of_a_step_is_its_length_over_the_mean_speed() -> None:
    assert _steps(fake([0.0, 1.0, 3.0], 2.0)) == pytest.approx([0.5, 1.0])
    assert _steps(fake([0.0, 1.0, 3.0], -2.0)) == pytest.approx([0.5, 1.0])
    assert _steps(fake([0.0, 3.0, 8.0], [2.0, 4.0, 6.0])) == pytest.approx([1.0, 1.0])
    assert _steps(fake([0.0, 2.0, 4.0], 2.0, period=6.0)) == pytest.approx([1.0, 1.0, 1.0])
    assert _steps(fake([0.0, 2.0, 4.0], 2.0, time=np.array([0.0, 5.0, 6.0]))) == pytest.approx([5.0, 1.0])
    assert np.isnan(_steps(fake([0.0, 2.0, 4.0], 0.0))).tolist() == [True, True]
    assert np.isnan(_steps(fake([0.0, 2.0, 4.0], [1.0, -1.0, -1.0]))).tolist() == [True, False]
    assert times(fake([0.0, 1.0, 3.0], 2.0)) == pytest.approx([0.25, 0.75, 0.5])
    assert times(fake([0.0, 2.0, 4.0], 2.0, period=6.0)) == pytest.approx([1.0, 1.0, 1.0])
    assert times(fake([0.0], 2.0)).tolist() == [1.0]


def test_the_work_of_a_cycle_goes_over_single_positions_without_a_value() -> None:
    weight = np.ones(5)
    for values, work in (
        ([1.0, 2.0, 3.0, 4.0, 5.0], 15.0),
        ([1.0, NAN, 3.0, NAN, 5.0], 15.0),
        ([1.0, NAN, NAN, 4.0, 5.0], NAN),
        ([NAN, 2.0, 3.0, 4.0, NAN], 2.0 + 9.0 + 4.0),
        ([NAN] * 5, NAN),
    ):
        one = SimpleNamespace(values=np.array(values))
        r: Any = SimpleNamespace(sides=(one, one))
        assert _work(r, lambda side: side.values, weight) == pytest.approx(work, nan_ok=True)
    two: Any = SimpleNamespace(
        sides=(SimpleNamespace(values=np.ones(5)), SimpleNamespace(values=3 * np.ones(5)))
    )
    assert _work(two, lambda side: side.values, weight) == pytest.approx(10.0)
    assert [supplied(*pair) for pair in ((0.0, 2.0), (2.0, 2.0), (2.0, 0.0), (-2.0, 0.0))] == [
        2.0,
        2.0,
        2.0,
        2.0,
    ]


def test_a_machine_locks_itself_from_an_efficiency_of_zero_on() -> None:
    e = Efficiency(
        np.array([0.5, 0.0, -0.1, NAN, 0.5]), np.array([0.2, 0.0, -0.1, NAN, -0.1]), 0.5, 1.0, 0.5, {},
        np.array([True, False, False, False, True]),
    )  # fmt: skip
    assert [bool(e.driven(k)) for k in range(5)] == [False, False, True, False, False]
    locked, damped = " (0 or less: self-locking)", " (0 or less: the damping takes more at this speed)"
    assert [e.held(k) for k in range(5)] == ["", locked, locked, "", damped]


def test_a_member_without_tension_is_neither_pulled_nor_pressed() -> None:
    rod = Member("rod", "two-force", ("A", "B"), (), np.array([2.0, -2.0, 0.0, NAN]))
    assert [rod.state(k) for k in range(4)] == ["tension", "compression", "", ""]
    assert Member("rod", "general", (), (), None).state(0) == ""
    assert [Share("A", "force", whole, 2.0).share for whole in (4.0, 1.0, 0.0)] == [0.5, 2.0, 0.0]
    one = Member("rod", "two-force", ("A", "B"), (), None, ("A",))
    assert "one line, which touches the friction circle at A and passes the other pin" in one.sentence
    two = Member("rod", "two-force", ("A", "B"), (), None, ("A", "B"))
    assert two.touching == "both forces lie on one common tangent of the friction circles at A, B"
    assert (
        Member("arm", "general", ("A",), (), None, ("A",)).touching
        == "the reaction touches the friction circle at A"
    )
    three = Member("arm", "three-force", ("A", "B", "P"), (), None, ("A", "B"))
    assert "not a two-force member, as P acts too" in three.touching
    four = Member("arm", "four-force", ("A", "B", "P"), ("B",), None, ("A", "B"))
    assert "as P and torque B act too" in four.touching
    pins = Member("arm", "three-force", ("A", "B", "C"), (), None, ("A", "B", "C"))
    assert pins.touching == "each reaction touches the friction circles at A, B, C"


def curve(flat: bool, *values: float, roller: float = 0.5) -> Any:
    """A cam of some curvatures."""
    joint = SimpleNamespace(flat=flat, follower=SimpleNamespace(roller=roller))
    found = np.array(values)
    return SimpleNamespace(joint=joint, curvature=lambda turns, at: found, at=lambda turns: None)


def test_a_roller_is_limited_where_the_curve_is_convex_and_a_face_everywhere_but_on_a_straight_line() -> None:
    """Curvatures 2, 0.5, 0, -4 by m: radii 0.5, 2, none, -0.25."""
    turns = np.zeros(4)
    rolling = worst_radius(curve(False, 2.0, 0.5, 0.0, -4.0), turns)
    assert rolling.tolist() == [0.0, 1.5, INF, INF]
    assert worst_radius(curve(True, 2.0, 0.5, 0.0, -4.0), turns).tolist() == [0.5, 2.0, INF, -0.25]


@pytest.mark.parametrize("sense", ["ccw", "cw"])
def test_the_jerk_over_an_eccentric_disc_is_that_of_a_sine(sense: str) -> None:
    """A flat face on a disc of 40 mm, 15 mm aside: y = 40 + 15 cos of a turn from the top."""
    profile = {"eccentric": "15 mm", "radius": "40 mm", "sense": sense}
    m = da.mechanism(sliding("flat", profile, drive={"position": 0, "speed": "1 rad/s"}))
    c = cam_motion(m, "F")
    turns = np.linspace(0.1, 6.1, 7)
    at = c.at(turns)
    phase = np.arctan2(-at.slope, at.y - 0.04)
    assert at.y == pytest.approx(0.04 + 0.015 * np.cos(phase))
    assert np.diff(phase) % (2 * math.pi) == pytest.approx(np.diff(turns))
    assert at.bend == pytest.approx(-0.015 * np.cos(phase))
    assert c.jerk(turns) == pytest.approx(0.015 * np.sin(phase), abs=1e-9)


def test_arcs_are_met_at_their_distance_from_the_axis() -> None:
    """A circle of 2 about (1, 0): 3 ahead, 1 behind, sqrt 3 across; hollow from inside; none beyond its edge."""
    arc = SimpleNamespace(center=(1.0, 0.0), radius=2.0)
    for angle, r in ((0.0, 3.0), (math.pi, 1.0), (math.pi / 2, math.sqrt(3.0))):
        assert _radius_at(arc, angle) == pytest.approx(r)  # type: ignore[arg-type]
        assert _radius_at(arc, angle, 0.5) == pytest.approx(
            math.cos(angle) + math.sqrt(6.25 - math.sin(angle) ** 2)
        )  # type: ignore[arg-type]
    hollow = SimpleNamespace(center=(5.0, 0.0), radius=-2.0)
    assert _radius_at(hollow, 0.0) == pytest.approx(3.0)  # type: ignore[arg-type]
    assert _radius_at(hollow, math.asin(0.4)) == pytest.approx(5 * math.sqrt(1 - 0.16))  # type: ignore[arg-type]
    assert _radius_at(hollow, math.pi / 2) == pytest.approx(0.0, abs=1e-15)  # type: ignore[arg-type]
    rows = _in_order([[1.0, 1.0, 7.0], [0.5, 0.5, 8.0], [3.0 - 2 * math.pi, 0.0, 9.0]])
    assert rows[:, :2] == pytest.approx(np.array([[1.0, 1.0], [0.5 + 2 * math.pi] * 2, [3.0, 3.0]]))
