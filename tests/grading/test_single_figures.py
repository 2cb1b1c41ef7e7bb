"""One figure beside what is computed: ends of an interval, both sides of a reversal, kinds of a key, slips."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases
from dalembert.grading.figure import _kind_of, _numbers, figure, figure_of_key, values_of
from dalembert.grading.own_figures import _amounts, _shown
from tests.grading.test_slips_of_figures import made


@pytest.mark.parametrize(
    ("given", "met", "off"),
    [
        (3.0, True, 0.0),
        (7.0, True, 0.0),
        (5.0, True, 0.0),
        (7.03, True, 0.0),  # within the tolerance of an end
        (7.2, False, 0.2 / 7.2),
        (2.5, False, 0.2),
        (-5.0, False, 1.6),
    ],
)
@pytest.mark.parametrize("right", [(3.0, 7.0), (7.0, 3.0)])
def test_at_rest_everything_between_the_ends_is_right(
    given: float, met: bool, off: float, right: tuple[float, float]
) -> None:
    f = replace(made(given, 0.0), right=tuple(np.array(x) for x in right), interval=True)
    assert f.met is met
    assert f.off == pytest.approx(off)
    ends = replace(f, interval=False)
    assert ends.met is (met and given != 5.0)


def test_the_nearest_of_two_values_counts_and_without_one_nothing_is_judged() -> None:
    f = replace(made(10.0, 0.0), right=(np.array(12.0), np.array(9.5)))
    assert (f.met, f.off, f.judged) == (False, pytest.approx(0.05), True)
    none = replace(f, right=())
    assert (none.met, math.isnan(none.off), none.judged) == (False, True, False)


@pytest.mark.parametrize(
    ("given", "answer", "polar", "said"),
    [
        (
            -3.0,
            {"component": "magnitude", "value": "-3 N"},
            False,
            "a magnitude is never negative; the direction or",
        ),
        (0.0, {"component": "magnitude", "value": "0 N"}, False, ""),
        (-3.0, {"component": "x", "value": "-3 N"}, False, ""),
        (
            [-3.0, 0.0],
            {"value": " -3 N @ 0"},
            True,
            "a magnitude is never negative: the opposite sense is a direction",
        ),
        ([-3.0, 0.0], {"value": "3 N @ 180"}, True, ""),
        ([-3.0, 0.0], {"value": ["-3 N", "0 N"]}, False, ""),
    ],
)
def test_what_no_computation_can_give_is_never_right(
    given: Any, answer: dict[str, Any], polar: bool, said: str
) -> None:
    f = made(given, given, polar=polar, answer={"quantity": "reaction", "of": "A", **answer})
    assert f.impossible.startswith(said)
    assert bool(f.impossible) == bool(said)
    assert f.met is not bool(said)


@pytest.mark.parametrize(
    ("value", "kind"),
    [
        ("3 N*m", "moment"), ("3 kN @ 20 deg", "force"), (("1 mm", "2 mm"), "length"),
        ("-2.5e3 rad/s", "angular_speed"),
        ("3", "number"), (7, "number"), ("30 deg", "angle"), ("5 m/s^2", "acceleration"), ("2 W", "power"),
    ],
)  # fmt: skip
def test_the_kind_of_a_key_is_that_of_its_unit(value: Any, kind: str) -> None:
    assert _kind_of(value) == kind


@pytest.mark.parametrize(
    ("given", "right", "met", "computed"),
    [
        ("31.5 N", "31.5 N", True, "31.5"),
        ("3.15 kN", "3150 N", True, "3.15 kN"),
        ("31.5 N @ 20", "31.5 N @ 20 deg", True, "31.5 @ 20"),
        (("3 N", "4 N"), ("3 N", "4 N"), True, "[3, 4]"),
        (("3 N", "4 N"), "5 N @ 53.13", True, "[3.00"),
        (("1 N", "2 N", "3 N"), ("1 N", "2 N", "3.1 N"), False, "[1, 2, 3.1]"),
    ],
)
def test_a_figure_beside_the_value_of_a_key(given: Any, right: Any, met: bool, computed: str) -> None:
    keys = {"quantity": "reaction", "of": "A"}
    f = figure_of_key(da.Answer(**keys, value=given), da.Answer(**keys, value=right))
    assert (f.met, f.judged, f.interval, f.reason, f.position) == (met, True, False, "", 0)
    assert f.computed.startswith(computed)


@pytest.mark.parametrize(
    ("component", "given", "value", "kind"),
    [
        ("magnitude", "5 N", 5.0, "force"),
        ("x", "-3 N", -3.0, "force"),
        ("direction", "126.87 deg", 2.2143, "angle"),
    ],
)
def test_a_component_is_beside_that_of_the_vector_of_a_key(
    component: str, given: str, value: float, kind: str
) -> None:
    keys = {"quantity": "reaction", "of": "A"}
    f = figure_of_key(
        da.Answer(**keys, component=component, value=given), da.Answer(**keys, value=("-3 N", "4 N"))
    )
    assert (f.series.kind, f.met) == (kind, True)
    assert float(f.right[0]) == pytest.approx(value, abs=1e-4)
    same = figure_of_key(*(da.Answer(**keys, component="x", value=x) for x in ("-3.2 N", "-3 N")))
    assert (same.met, same.off) == (False, pytest.approx(0.0625))


def test_values_without_a_number_and_those_twice_are_left_out() -> None:
    some = _numbers(
        [np.array(x) for x in ([1.0, 2.0], [1.0, math.nan], [2.0, 1.0], [1.0, 2.0], [math.inf, 0.0])]
    )
    assert [v.tolist() for v in some] == [[1, 2], [2, 1]]


def test_at_rest_the_ends_of_an_effort_are_right_with_all_between() -> None:
    r = da.solve(da.load(cases()["seed-002-7d-engine-at-rest"]))
    low, high = (float(x) for x in r.interval("O")[0])
    assert low < high
    plain = da.Answer(quantity="effort", of="O", value=f"{(low + high) / 2!r} N*m")
    values, between = values_of(r, plain, 0)
    assert ([float(v) for v in values], between) == ([low, high], True)
    f = figure(r, plain)
    assert (f.met, f.interval, f.off) == (True, True, 0.0)
    assert f.computed == f"{low:.7g} to {high:.7g}"
    sizes, between = values_of(r, plain.model_copy(update={"component": "magnitude"}), 0)
    assert ([float(v) for v in sizes], between) == ([abs(low), abs(high)], False)
    one, between = values_of(r, plain.model_copy(update={"quantity": "effort_low"}), 0)
    assert ([float(v) for v in one], between) == ([low], False)


def test_a_figure_that_is_not_finite_or_at_no_position_is_refused() -> None:
    r = da.dynamics(da.four_bar(positions=3))
    with pytest.raises(da.ModelError, match="the answer has 3 positions; say which: at: 1, or at: 60 deg"):
        figure(r, da.Answer(quantity="effort", of="O2", value="3 N*m"))
    found = figure(r, da.Answer(quantity="effort", of="O2", value="3 N*m", at=2))
    assert (found.position, found.words) == (1, "effort of O2, at no. 2")
    assert found.computed == f"{r.effort('O2')[1]:.7g}"
    largest = figure(r, da.Answer(quantity="effort", of="O2", value="3 N*m", extreme="maxabs"))
    assert largest.position == int(np.abs(r.effort("O2")).argmax())
    with pytest.raises(da.ModelError, match="is not a finite number; write"):
        figure(r, da.Answer(quantity="effort", of="O2", value="1e400 N*m", at=2))


VALUE, CHANGE = np.array([3.0, -4.0]), np.array([1.0, 2.0])


def slipped(given: Any, component: str | None = None) -> Any:
    return made(given, given, answer={"quantity": "reaction", "of": "A", "component": component})


def test_the_amounts_of_a_slip_that_give_a_figure() -> None:
    assert _amounts(slipped([5.0, 0.0]), VALUE, CHANGE) == pytest.approx([2.0])
    assert _amounts(slipped([5.0, 5.0]), VALUE, CHANGE) == pytest.approx([4.0])  # the nearest on its line
    assert _amounts(slipped(4.5, "x"), VALUE, CHANGE) == pytest.approx([1.5])
    assert _amounts(slipped(4.5, "y"), VALUE, CHANGE) == pytest.approx([4.25])
    assert _amounts(slipped(4.5, "x"), VALUE, np.array([0.0, 2.0])) == []
    assert _amounts(slipped(4.5, "direction"), VALUE, CHANGE) == []
    size = float(np.hypot(3 + 1.5, -4 + 3.0))
    both = _amounts(slipped(size, "magnitude"), VALUE, CHANGE)
    assert both == pytest.approx([1.5, 0.5])
    assert [float(np.hypot(*(VALUE + x * CHANGE))) for x in both] == pytest.approx([size, size])
    assert _amounts(slipped(4.0, "magnitude"), VALUE, CHANGE) == []  # nearer than the line ever is
    assert _amounts(slipped(20.0, "magnitude"), VALUE, -CHANGE)[0] > 0


@pytest.mark.parametrize(
    ("whole", "component", "rank", "shown"),
    [
        ([-7.0], None, 1, -7.0),
        ([-7.0], "magnitude", 1, 7.0),
        ([-7.0], "magnitude", 0, -7.0),
        ([3.0, -4.0], None, 2, [3.0, -4.0]),
        ([3.0, -4.0], "magnitude", 2, 5.0),
        ([3.0, -4.0], "y", 2, -4.0),
        ([0.0, -4.0], "direction", 2, -math.pi / 2),
    ],
)
def test_the_number_that_a_figure_is_of_a_force(
    whole: Any, component: str | None, rank: int, shown: Any
) -> None:
    found = _shown(slipped(1.0, component), np.array(whole), rank)
    assert found.tolist() == pytest.approx(shown)
