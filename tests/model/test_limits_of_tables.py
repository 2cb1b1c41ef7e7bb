"""Limits of tables, motors and laws by expression: their ends, joints and corners, where x turns round; by hand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from dalembert.errors import ModelError
from dalembert.model.drives.expression_laws import Jet, _functions
from dalembert.model.drives.motors import MotorCurve, motor_curve
from dalembert.model.part import ReadingRules
from dalembert.model.quantities.dimensions import (
    EITHER,
    _base_units,
    _plain,
    _power,
    _product,
    kind_of_dimension,
    phrase,
    si_unit,
)
from dalembert.model.quantities.tables import FAR, SLACK, Table
from dalembert.units import file_units

INF = math.inf
RULES = ReadingRules(file_units({}))


def table(outside: str = "refuse", **keys: Any) -> Table:
    """6 at 1, 10 at 2, 30 at 5: slopes 4 and 20/3, over a span of 4."""
    return Table("O", (1.0, 2.0, 5.0), (6.0, 10.0, 30.0), outside=outside, **keys)


@pytest.mark.parametrize("shift", [0.0, 0.5])
@pytest.mark.parametrize("times", [1.0, 2.0, -2.0])
def test_a_table_ends_within_a_billionth_of_its_span(shift: float, times: float) -> None:
    near = SLACK * 4
    for x, inside, value in (
        (1.0, True, 6.0), (1 - 0.9 * near, True, 6.0), (1 - 1.1 * near, False, 6.0), (0.0, False, 6.0),
        (5.0, True, 30.0), (5 + 0.9 * near, True, 30.0), (5 + 1.1 * near, False, 30.0), (9.0, False, 30.0),
        (2.0, True, 10.0), (1.5, True, 8.0), (3.5, True, 20.0),
    ):  # fmt: skip
        at = {"O": x + shift}
        assert table(shift=shift).beyond(at["O"]) == (not inside)
        for outside in ("hold", "zero"):
            assert not table(outside, shift=shift).beyond(at["O"])
        for outside in ("refuse", "hold"):
            assert table(outside, shift=shift, times=times).at(at) == pytest.approx(times * value, abs=1e-6)
        zero = table("zero", shift=shift, times=times).at(at)
        assert zero == pytest.approx(times * value if inside else 0.0, abs=1e-6)
    many = table("zero").at({"O": np.array([0.0, 1.5, 9.0])})
    assert np.asarray(many).tolist() == [0.0, 8.0, 0.0]
    breaks, pieces = table("zero").everywhere()
    assert breaks.tolist() == [1 - 4 * FAR, 1.0, 2.0, 5.0, 5 + 4 * FAR]
    assert pieces.shape == (2, 4)
    assert pieces[:, [0, -1]].tolist() == [[0, 0], [0, 0]]
    assert table("hold").everywhere()[0].tolist() == [1.0, 2.0, 5.0]


@pytest.mark.parametrize("form", ["linear", "cubic"])
def test_a_periodic_table_repeats_and_is_closed_by_its_first_point(form: str) -> None:
    """With the last point and without it; a spline's slopes agree at both ends."""
    x, y = (0.0, 1.0, 2.0, 3.0), (0.0, 2.0, 1.0, -1.0)
    left_out = Table("O", x, y, interpolate=form, period=4.0)
    given = Table("O", (*x, 4.0), (*y, 0.0), interpolate=form, period=4.0)
    assert left_out.closed() == given.closed()
    assert given.closed()[0] == (*x, 4.0)
    for k in (-2, 0, 3):
        for a, b in zip((*x, 4.0), (*y, 0.0), strict=True):
            for one in (left_out, given):
                assert one.at({"O": a + 4 * k}) == pytest.approx(b, abs=1e-12)
        h = 1e-6
        ends = [left_out.at({"O": 4 * k + s * h}) for s in (-2, -1, 0, 1, 2)]
        slopes = ((ends[2] - ends[0]) / (2 * h), (ends[4] - ends[2]) / (2 * h))  # type: ignore[operator]
        if form == "cubic":
            assert slopes[0] == pytest.approx(slopes[1], abs=1e-4)
        else:
            assert slopes == (pytest.approx(1.0), pytest.approx(2.0))
    assert not left_out.beyond(99.0)
    for off, closes in ((0.0, True), (0.9e-9, True), (-0.9e-9, True), (1.2e-9, False), (-1.2e-9, False)):
        span = 4 * (1 + off)
        points = (0.0, 1.0, span)
        if off > 1e-9:
            with pytest.raises(ModelError, match="repeats after"):
                Table("O", points, (1.0, 2.0, 1.0), period=4.0)
        else:
            t = Table("O", points, (1.0, 2.0, 1.0), period=4.0)
            assert len(t.closed()[0]) == (3 if closes else 4)
    for last, fits in ((2 + 3e-9, True), (2 - 3e-9, True), (2 + 5e-9, False), (2 - 5e-9, False)):
        if fits:
            assert Table("O", (0.0, 1.0, 4.0), (2.0, -4.0, last), period=4.0).period == 4.0
        else:
            with pytest.raises(ModelError, match="ends with another value"):
                Table("O", (0.0, 1.0, 4.0), (2.0, -4.0, last), period=4.0)
    assert Table("O", (0.0, 0.2), (2.0, 3.0), period=0.5).at({"O": 0.6}) == pytest.approx(2.5)
    for period in (0.0, -1.0):
        with pytest.raises(ModelError, match="repeats after"):
            Table("O", (0.0, 1.0), (2.0, 2.0), period=period)


def test_the_next_point_of_a_table_is_beyond_a_place() -> None:
    one = table(shift=0.5)
    for at, ahead in (
        (0.0, 1.5),
        (1.5, 2.5),
        (2.0, 2.5),
        (2.5 - 1e-12, 2.5),
        (2.5, 5.5),
        (5.5, INF),
        (9.0, INF),
    ):
        assert one.next_point(at) == ahead
    again = Table("O", (0.0, 1.0, 3.0), (0.0, 1.0, 2.0), period=4.0, shift=0.5)
    for at, ahead in (
        (0.5, 1.5),
        (1.5, 3.5),
        (3.5, 4.5),
        (4.5, 5.5),
        (-0.6, -0.5),
        (-3.5, -2.5),
        (40.5, 41.5),
        (43.6, 44.5),
    ):
        assert again.next_point(at) == pytest.approx(ahead)


@pytest.mark.parametrize(
    ("x", "y", "words"),
    [
        ((0.0,), (1.0,), "too few points: 1"),
        ((0.0, 1.0), (1.0,), "2 values in x and 1 in y"),
        ((0.0, 1.0, 1.0), (1.0, 2.0, 3.0), "does not increase from its item 2 to 3"),
        ((0.0, 2.0, 1.0), (1.0, 2.0, 3.0), "does not increase from its item 2 to 3"),
    ],
)
def test_a_table_has_two_points_at_least_that_go_on(x: Any, y: Any, words: str) -> None:
    with pytest.raises(ModelError, match=words):
        Table("O", x, y)
    assert Table("O", (0.0, 1.0), (1.0, 3.0)).at({"O": 0.5}) == 2.0


CURVE = MotorCurve((-10.0, 0.0, 10.0, 20.0), (6.0, 4.0, 4.0, 0.0))


def test_a_motor_follows_its_lines_and_holds_beyond_their_ends() -> None:
    for speed, effort in (
        (-99.0, 6.0),
        (-10.0, 6.0),
        (-5.0, 5.0),
        (0.0, 4.0),
        (5.0, 4.0),
        (15.0, 2.0),
        (20.0, 0.0),
        (99.0, 0.0),
    ):
        assert CURVE.at(speed) == pytest.approx(effort)
        for ahead in (1.0, -1.0):
            at_rest, slope = CURVE.line(speed, ahead)
            if abs(speed) != 99.0:
                assert at_rest + slope * speed == pytest.approx(effort)
    near = 1e-9 * 20
    for speed, ahead, slope in (
        (10.0, 1.0, -0.4), (10.0, -1.0, 0.0), (10 + 0.9 * near, -1.0, 0.0), (10 - 0.9 * near, 1.0, -0.4),
        (10 + 1.1 * near, -1.0, -0.4), (10 - 1.1 * near, 1.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, -0.2),
        (-10.0, 1.0, -0.2), (-10.0, -1.0, 0.0), (20.0, 1.0, 0.0), (20.0, -1.0, -0.4), (99.0, 1.0, 0.0),
        (-99.0, 1.0, 0.0),
    ):  # fmt: skip
        assert CURVE.line(speed, ahead)[1] == pytest.approx(slope), (speed, ahead)
    straight = MotorCurve((0.0, 20.0), (40.0, 0.0), straight=True)
    for speed in (-10.0, 0.0, 5.0, 20.0, 30.0):
        assert straight.at(speed) == pytest.approx(40 - 2 * speed)
        assert straight.line(speed, 1.0) == pytest.approx((40.0, -2.0))
    assert (straight.kinks, CURVE.kinks, CURVE.fastest) == ((), CURVE.speed, 20.0)
    assert MotorCurve((-30.0, 20.0), (1.0, 0.0)).fastest == -30.0
    geared = MotorCurve((0.0, 300.0), (2.0, 0.0), True, ratio=12.0, inertia=1e-3, efficiency=0.9)
    assert geared.at_drive == MotorCurve((0.0, 25.0), (24.0, 0.0), True)
    assert [m.geared for m in (straight, geared, geared.at_drive)] == [False, True, False]
    for change in ({"ratio": 2.0}, {"inertia": 1e-9}, {"efficiency": 0.99}):
        assert MotorCurve((0.0, 20.0), (40.0, 0.0), True, **change).geared  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("keys", "fits"),
    [
        ({"efficiency": 1.0}, True),
        ({"efficiency": 1.001}, False),
        ({"efficiency": 0.001}, True),
        ({"efficiency": 0.0}, False),
        ({"ratio": 0.001}, True),
        ({"ratio": 0.0}, False),
        ({"inertia": "0 kg*m^2"}, True),
        ({"inertia": "-1e-9 kg*m^2"}, False),
        ({"time_constant": "0 s"}, True),
        ({"time_constant": "-1e-9 s"}, False),
        ({"stall": "-40 N*m"}, False),
        ({"stall": "0 N*m"}, False),
        ({"stall": "-40 N*m", "no_load": "-30 rad/s"}, True),
    ],
)
def test_a_motor_drives_with_a_gear_that_wastes_something_at_most(keys: dict[str, Any], fits: bool) -> None:
    tree = {"stall": "40 N*m", "no_load": "30 rad/s"} | keys
    if fits:
        assert abs(motor_curve(tree, "angle", RULES).effort[0]) == 40.0
    else:
        with pytest.raises(ModelError):
            motor_curve(tree, "angle", RULES)


@pytest.mark.parametrize("name", ["sin", "cos", "tan", "exp", "log", "sqrt", "atan"])
def test_functions_of_time_have_their_first_and_second_derivatives(name: str) -> None:
    """Of a parabola of time, by differences."""
    f, h = _functions()[name], 1e-4

    def at(t: float) -> float:
        return float(f(Jet(0.7 + 0.5 * t + 0.3 * t * t)).value)

    found = f(Jet(0.7, 0.5, 0.6))
    assert found.value == pytest.approx(at(0.0))
    assert found.first == pytest.approx((at(h) - at(-h)) / (2 * h), rel=1e-6)
    assert found.second == pytest.approx((at(h) - 2 * at(0.0) + at(-h)) / h**2, rel=1e-5)


def test_sums_products_and_powers_of_functions_of_time() -> None:
    """x = 2 + 3 t + t^2, y = 4 - t: values and derivatives at t = 0 by hand."""
    x, y = Jet(2.0, 3.0, 2.0), Jet(4.0, -1.0, 0.0)
    for found, known in (
        (x + y, (6.0, 2.0, 2.0)), (1 + x, (3.0, 3.0, 2.0)), (x - y, (-2.0, 4.0, 2.0)), (1 - x, (-1.0, -3.0, -2.0)),
        (x * y, (8.0, 10.0, 2.0)), (2 * x, (4.0, 6.0, 4.0)), (-x, (-2.0, -3.0, -2.0)),
        (x / y, (0.5, 0.875, 0.9375)), (8 / y, (2.0, 0.5, 0.25)),
        (x**2, (4.0, 12.0, 26.0)), (x**1, (2.0, 3.0, 2.0)), (x**0, (1.0, 0.0, 0.0)), (x**-1, (0.5, -0.75, 1.75)),
        (y**0.5, (2.0, -0.25, -0.03125)), (y ** Jet(2.0), (16.0, -8.0, 2.0)),
    ):  # fmt: skip
        assert (found.value, found.first, found.second) == pytest.approx(known)
    still = Jet(0.0, 1.0, 0.0)
    for n, known in ((0, (1.0, 0.0, 0.0)), (1, (0.0, 1.0, 0.0)), (2, (0.0, 0.0, 2.0))):
        power = still**n
        assert (power.value, power.first, power.second) == known


def test_dimensions_of_products_powers_and_roots() -> None:
    force, length, angle = (1, 1, -2, 0), (1, 0, 0, 0), (0, 0, 0, 1)
    assert _product(force, length, 1) == (2, 1, -2, 0)
    assert _product(force, length, -1) == (0, 1, -2, 0)
    assert _product(force, EITHER, 1) == (1, 1, -2, None)
    assert _product(angle, angle, -1) == (0, 0, 0, 0)
    assert _product(None, force, 1) is None
    assert _power((2, 0, -2, None), 0.5) == (1, 0, -1, None)
    assert _power((1, 0, 0, 0), 0.5) == (0.5, 0, 0, 0)
    for x, y in ((2 + 0.9e-9, 2), (2 - 0.9e-9, 2), (2 + 1.1e-9, 2 + 1.1e-9), (-0.5, -0.5)):
        assert _plain(x) == y
    assert isinstance(_plain(2 + 1e-10), int)
    assert kind_of_dimension((1, 1, -2, 0)) == "force"
    assert kind_of_dimension((0, 0, -1, 1)) == "angular_speed"
    assert kind_of_dimension((0, 0, -1, 7)) == "angular_speed"
    assert kind_of_dimension(None) == kind_of_dimension(EITHER) == "number"
    assert kind_of_dimension((9, 0, 0, 0)) is None
    assert [si_unit(x) for x in ((2, 1, -2, 0), (9, 0, 0, 0), (0.5, 1, -3, 0))] == [
        "N*m",
        "m^9",
        "m^0.5*kg/s^3",
    ]
    assert _base_units((0, 0, -1, 0)) == "1/s"
    assert _base_units((1, 1, -1, -2)) == "m*kg/s/rad^2"
    assert _base_units(None) == ""
    assert phrase((1, 1, -2, 0)) == "a force"
    assert phrase((1, 1, -2, 3)) == "in m*kg*rad^3/s^2"
    assert phrase((9, 0, 0, 0)) == "in m^9"
