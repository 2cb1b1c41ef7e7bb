"""Slips of single figures, by numbers alone: how near explains, what chance does as well, and which slip counts."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.grading.figure import StudentValue
from dalembert.grading.quantities import Series
from dalembert.grading.tolerance import Closeness, Target
from dalembert.grading.value_slips import (
    alike,
    coincidence,
    density,
    distance,
    explains,
    others,
    slip_of,
    width,
)

OPPOSITE = "the sense is opposite: action mistaken for reaction"


def made(
    given: Any, right: Any, halves: tuple[float, ...] = (), near: float = 0.005, **more: Any
) -> StudentValue:
    """A figure beside the one value that is right."""
    value, kind, polar = np.array(given, float), more.get("kind", "force"), more.get("polar", False)
    close = Closeness(value, kind, near, halves, polar, more.get("stated", False))
    answer = da.Answer(**{"quantity": "effort", "of": "O"} | more.get("answer", {}))
    rights = (np.array(right, float),)
    series = Series(kind, np.zeros((1, *value.shape)))
    return StudentValue(answer, series, 0, Target(value, "", polar), close, rights, False, "", "")


def test_small_slips_are_more_frequent_than_large_ones() -> None:
    """0.93 exp(-(d / 0.3)^2 / 2) + 0.075 / (1 + d)^2."""
    assert density(0.0) == pytest.approx(1.005)
    assert density(0.3) == pytest.approx(0.93 * 0.6065306597 + 0.075 / 1.69)
    assert density(3.0) == pytest.approx(0.075 / 16)


@pytest.mark.parametrize(
    ("right", "value", "explained"),
    [
        (102, 100.39, True),  # nearly right: only what is five times nearer
        (102, 100.41, False),
        (98, 99.61, True),
        (98, 99.59, False),
        (103, 100.55, True),  # 3 % are nearly right still
        (103, 100.61, False),
        (103.01, 100.55, False),  # else what is within the tolerance
        (103.01, 100.49, True),
        (103.01, 99.51, True),
        (103.01, 99.49, False),
    ],
)
def test_a_value_explains_a_figure_that_is_nearly_right_only_by_coming_much_nearer(
    right: float, value: float, explained: bool
) -> None:
    assert explains(made(100, right), np.array(value)) is explained


def test_the_distance_is_that_of_the_nearest_value_and_none_where_no_value_explains() -> None:
    f = made(100, 150, (0.3,))
    assert distance(f, [np.array(100.45), np.array(99.6), np.array(107.0)]) == pytest.approx(0.004)
    assert distance(f, [np.array(100.45), np.array(100.25)]) == 0.0  # rounded to its digits
    assert distance(f, [np.array(101.0), np.array(60.0)]) is None
    assert distance(f, []) is None


@pytest.mark.parametrize(
    ("figure", "off", "room"),
    [
        (made(100, 150), 0.001, 0.005),  # of a figure without digits
        (made(100, 150, (0.07,)), 0.0, 7e-4),
        (made(100, 150, (0.07,)), 0.003, 0.003),
        (made(100, 150, (0.01,)), 0.0, 2e-4),  # no figure is trusted further
        (made(100, 150, (0.07,), 0.02), 0.0, 7e-4),
        (made(100, 150, (0.07,), 0.02, stated=True), 0.0, 0.02),
        (made(0.7, 0.2, (0.001,), kind="angle"), 0.0, 0.005),
        (made([60, -80], [1, 2], (0.2, 0.6)), 0.0, 0.006),
        (made([60, -80], [1, 2], (0.3, 0.002), polar=True), 0.0, 0.003),
        (made([60, -80], [1, 2], (0.1, 0.004), polar=True), 0.0, 0.004),
        (made([60, -80], [1, 2], (0.1, 0.05), polar=True), 0.0, 0.01),
        (made(-200, 150, (0.3,)), 0.0, 1.5e-3),
    ],
)
def test_the_room_in_which_a_figure_speaks_for_a_value(figure: StudentValue, off: float, room: float) -> None:
    assert width(figure, off) == pytest.approx(room)


@pytest.mark.parametrize(
    ("figure", "value", "chance"),
    [
        (made(100, 200, (0.07,)), 130.0, 14e-4 * (0.93 * math.exp(-((7 / 6) ** 2) / 2) + 0.075 / 1.35**2)),
        (made(100, -200, (0.07,)), -130.0, 14e-4 * (0.93 * math.exp(-((7 / 6) ** 2) / 2) + 0.075 / 1.35**2)),
        (made(100, 0, (0.07,)), 0.3, 14e-4 * (0.93 * math.exp(-0.5) + 0.075 / 1.69)),
        (made([60, 80], [30, -40], (0.3, 0.4)), [30, -25.0], 8e-3 * (0.93 * math.exp(-0.5) + 0.075 / 1.69)),
        (made(0.5, 2.0, kind="angle"), 0.8, 0.01 * (0.93 * math.exp(-0.5) + 0.075 / 1.69)),
        (made(0.5, 2.0, kind="angle"), 0.5, 0.01 * (0.93 * math.exp(-1 / 18) + 0.075 / 1.21)),
        (made(100, 130, near=0.6, stated=True), 130.0, 1.0),
        (made(100, 130, near=0.4, stated=True), 130.0, 0.8 * 1.005),
    ],
)
def test_a_wrong_number_lies_near_a_value_by_chance(figure: StudentValue, value: Any, chance: float) -> None:
    assert coincidence(figure, np.array(value), 0.0) == pytest.approx(chance)


def test_a_coincidence_is_as_wide_as_the_value_is_off() -> None:
    f = made(100, 200, (0.07,))
    assert coincidence(f, np.array(130.0), 0.0021) == pytest.approx(3 * coincidence(f, np.array(130.0), 0.0))


def test_two_values_are_alike_within_twice_the_room_of_a_figure() -> None:
    f = made(100, 150, (0.07,))
    near = [alike(f, np.array(50.0), np.array(x)) for x in (50.139, 49.861, 50.141, 49.859)]
    assert near == [True, True, False, False]
    force = made([60, -80], [1, 2], (0.2, 0.6))
    assert alike(force, np.array([3.0, 4.0]), np.array([3.7, 3.05]))
    assert not alike(force, np.array([3.0, 4.0]), np.array([3.7, 2.95]))


def test_the_chance_of_a_slip_counts_thirty_of_them_and_both_numbers_of_a_vector() -> None:
    """Of a sense one number speaks, of exchanged axes both do."""
    sign = slip_of(made(-103, 103, (0.05,)), [np.array(103.0)], None, 0)
    assert sign is not None
    assert (sign.sentence, sign.kind, float(sign.value)) == (OPPOSITE, "sign", -103.0)
    assert sign.chance == pytest.approx(30 * 2 * 0.05 / 103 * density(2.0))
    force = made([40, 30], [30, 40], (0.05, 0.05))
    exchanged = slip_of(force, force.right, None, 0)
    assert exchanged is not None
    assert exchanged.sentence == "the angle is counted from the other axis: x and y are exchanged"
    assert (exchanged.kind, exchanged.value.tolist()) == ("named", [40, 30])
    assert exchanged.chance == pytest.approx(30 * (2 * 0.001 * density(math.sqrt(0.08))) ** 2)


def test_of_slips_with_the_same_value_the_simplest_counts_and_of_others_the_least_likely_by_chance() -> None:
    force = made([-50, 50], [50, -50], (0.05, 0.05))  # opposite, or with exchanged axes
    slip = slip_of(force, force.right, None, 0)
    assert slip is not None
    assert (slip.sentence, slip.kind) == (OPPOSITE, "sign")
    for values in ([-100.3, -99.99], [-99.99, -100.3]):
        nearest = slip_of(made(100, -100.3, (0.05,)), [np.array(x) for x in values], None, 0)
        assert nearest is not None
        assert float(nearest.value) == 99.99


def test_a_slip_that_chance_explains_as_well_is_none() -> None:
    """Half of a value, to 1.8 % (30 x 2 x 0.018 x 0.265 = 0.29 of such are expected) and to 2 % (0.32)."""
    sure = slip_of(made(50, 100, near=0.018, stated=True), [np.array(100.0)], None, 0)
    assert sure is not None
    assert (sure.sentence, sure.kind, sure.value) == ("a factor of 2", "unit", 50.0)
    assert slip_of(made(50, 100, near=0.02, stated=True), [np.array(100.0)], None, 0) is None
    assert slip_of(made(73, 100, (0.05,)), [np.array(100.0)], None, 0) is None


def joint(name: str) -> tuple[dict[str, Any], str]:
    return {"of": name, "on": None, "by": None}, f"this is joint {name}"


def axes(link: str) -> tuple[dict[str, Any], str]:
    said = f"components are along and across link {link}, not ground axes"
    return {"axes": "link", "on": link, "by": None}, said


SIZE = ({"component": "magnitude"}, "this is the magnitude, not the component")


@pytest.mark.parametrize(
    ("answer", "named"),
    [
        ({"quantity": "reaction", "of": "A"}, [*map(joint, ("O2", "B", "O4")), axes("crank"), axes("coupler")]),
        ({"quantity": "moment", "of": "O4"}, [*map(joint, ("O2", "A", "B")), axes("rocker")]),
        (
            {"quantity": "reaction", "of": "O2", "component": "x"},
            [
                *map(joint, ("A", "B", "O4")),
                axes("crank"),
                ({"component": "y"}, "the angle is counted from the other axis: x for y"),
                SIZE,
            ],
        ),
        (
            {"quantity": "center", "of": "rocker", "component": "y"},
            [
                ({"component": "x"}, "the angle is counted from the other axis: x for y"),
                SIZE,
                ({"of": "crank"}, "this is link crank"),
                ({"of": "coupler"}, "this is link coupler"),
            ],
        ),
        *(
            ({"quantity": q, "of": "crank"}, [({"of": n}, f"this is link {n}") for n in ("coupler", "rocker")])
            for q in ("angle", "speed", "acceleration", "center_acceleration")
        ),
        ({"quantity": "effort", "of": "O2"}, []),
        ({"quantity": "reaction", "of": "A", "component": "direction"},
         [*map(joint, ("O2", "B", "O4")), axes("crank"), axes("coupler")]),
    ],
)  # fmt: skip
def test_something_else_is_another_joint_other_axes_another_component_or_another_link(
    answer: dict[str, Any], named: list[Any]
) -> None:
    r = da.dynamics(da.four_bar(positions=1))
    assert list(others(r, made(1, 2, answer=answer))) == named


def test_of_a_figure_of_zero_two_values_are_alike_within_a_hundredth() -> None:
    f = made(0, 150)
    assert [alike(f, np.array(3.0), np.array(x)) for x in (3.009, 2.991, 3.011)] == [True, True, False]


def test_for_a_slip_of_an_angle_its_one_number_speaks() -> None:
    f = made(math.pi / 2 - 0.3, 0.3, (1e-4,), kind="angle")
    slip = slip_of(f, f.right, None, 0)
    assert slip is not None
    assert (slip.sentence, slip.kind) == ("the angle is counted from the other axis", "named")
    assert slip.chance == pytest.approx(30 * 2 * 0.005 * density(0.1))


def test_the_force_of_another_joint_is_a_slip_where_the_problem_is_known() -> None:
    r = da.dynamics(da.four_bar(positions=3).with_values({"loads.torque.value": 7.0}))
    force, right = r.reaction("B", on="rocker")[2], r.reaction("O2", on="crank")[2]
    f = made(force, right, (1e-5, 1e-5), answer={"quantity": "reaction", "of": "O2"})
    assert slip_of(f, f.right, None, 2) is None
    slip = slip_of(f, f.right, r, 2)
    assert slip is not None
    assert (slip.sentence, slip.kind) == ("this is joint B", "named")
    assert slip.value == pytest.approx(force)
    assert slip_of(f, f.right, r, 1) is None
    assert slip_of(f, f.right, r, 17) is None
