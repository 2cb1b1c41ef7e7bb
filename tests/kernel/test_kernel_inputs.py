"""Numbers, positions and targets that a kernel is given: what is taken, in which order, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.checked_input import (
    check_positions,
    design_values,
    drive_values,
    numbers,
    read_target,
    targets,
)
from dalembert.analysis.batch.compiled_kernel import _check_count
from dalembert.errors import ModelError

NAMES, NOMINAL = ("links.rod.mass", "links.crank.mass", "g"), np.array([2.5, 3.5, 9.75])
TWO = {"effort.O": (4, 1), "reaction.A": (4, 2)}


def said(call: Callable[[], Any]) -> str:
    with pytest.raises(ModelError) as raised:
        call()
    return str(raised.value)


REAL = "give an array of real numbers, in SI and radians"


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ([1 + 2j], f"values are complex; {REAL}"),
        ([True, False], f"values are true and false; {REAL}"),
        (["1", "2"], f"values are text; {REAL}"),
        ([b"1"], f"values are text; {REAL}"),
        (np.array([1], "m8[s]"), f"values are times; {REAL}"),
        (np.array(["2020-01-01"], "M8[D]"), f"values are dates; {REAL}"),
        (np.zeros(2, [("a", float)]), f"values are records; {REAL}"),
        (np.array([1.5, 2j], object), f"values are complex; {REAL}"),
        (np.array([1.5, True], object), f"values are not all numbers; {REAL}"),
        (np.array([1.5, None], object), f"values are not all numbers; {REAL}"),
        ([[1.0], [1.0, 2.0]], f"values are not all numbers; {REAL}"),
        ([10**400], "values are too large for the arithmetic; give numbers below 1.8e308"),
        (
            np.ma.masked_array([1.0, 2.0], [True, False]),
            "values are masked in places; give numbers everywhere, or leave those designs out",
        ),
        (
            SimpleNamespace(units="m", magnitude=2.0),
            "values carry units; give plain numbers, in SI and radians",
        ),
    ],
)
def test_an_array_that_is_not_of_real_numbers_is_refused_by_its_kind(values: Any, sentence: str) -> None:
    assert said(lambda: numbers("values", values)) == sentence


def test_whole_and_decimal_numbers_are_taken_and_an_array_of_floats_is_not_copied() -> None:
    assert numbers("values", [2, 3]).tolist() == [2.0, 3.0]
    assert numbers("values", [Decimal("0.25"), 7]).dtype == float  # type: ignore[arg-type]
    assert numbers("values", np.ma.masked_array([4.0, 5.0], [False, False])).tolist() == [4.0, 5.0]
    assert numbers("values", NOMINAL) is NOMINAL
    with pytest.raises(ModelError):
        numbers("values", SimpleNamespace(units="m", magnitude=1.0))
    assert numbers("values", np.float32(0.5)).tolist() == 0.5


@pytest.mark.parametrize(
    ("values", "designs"),
    [
        (None, [[2.5, 3.5, 9.75]]),
        ([4.0, 5.0, 6.0], [[4.0, 5.0, 6.0]]),
        ([[4.0, 5.0, 6.0], [7.0, 8.0, 9.5]], [[4.0, 5.0, 6.0], [7.0, 8.0, 9.5]]),
        ({"g": 4.0}, [[2.5, 3.5, 4.0]]),
        ({"g": [4.0, 5.0], "links.rod.mass": 7.0}, [[7.0, 3.5, 4.0], [7.0, 3.5, 5.0]]),
        ({"g": [4.0], "links.crank.mass": [7.0, 8.0]}, [[2.5, 7.0, 4.0], [2.5, 8.0, 4.0]]),
    ],
)
def test_designs_are_rows_of_numbers_in_the_order_of_their_names(
    values: Any, designs: list[list[float]]
) -> None:
    assert design_values(values, NAMES, NOMINAL).tolist() == designs


def test_many_designs_of_one_number_are_a_list() -> None:
    assert design_values([4.0, 5.0], ["g"], NOMINAL[2:]).tolist() == [[4.0], [5.0]]
    assert design_values([4.0, 5.0], ["g", "h"], NOMINAL[:2]).tolist() == [[4.0, 5.0]]
    assert design_values(4.0, ["g"], NOMINAL[2:]).tolist() == [[4.0]]


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        (
            [4.0, 5.0],
            "values of shape (2,) do not fit 3 numbers; give (design, number) in the order of .numbers",
        ),
        (
            np.ones((1, 2, 3)),
            "values of shape (1, 2, 3) do not fit 3 numbers; give (design, number) in the order of .numbers",
        ),
        (
            {"links.rod.mas": 4.0},
            "the kernel does not vary 'links.rod.mas'; did you mean 'links.rod.mass'?",
        ),
        (
            {"g": [4.0, 5.0], "links.rod.mass": [1.0, 2.0, 3.0]},
            "values do not fit each other: g of shape (2,), links.rod.mass of shape (3,); "
            "give one value, or one for each design",
        ),
        (
            {"g": [[4.0, 5.0]]},
            "values do not fit each other: g of shape (1, 2); give one value, or one for each design",
        ),
        ({"g": "4"}, f"g are text; {REAL}"),
    ],
)
def test_designs_that_do_not_fit_the_numbers_are_refused(values: Any, sentence: str) -> None:
    assert said(lambda: design_values(values, NAMES, NOMINAL)) == sentence


def written(*shape: int) -> np.ndarray[Any, Any]:
    return np.empty(shape)


def read_only() -> np.ndarray[Any, Any]:
    array = np.empty((4, 1))
    array.flags.writeable = False
    return array


ONE = {"effort.O": (4, 1)}
SHARED = np.empty((4, 1))


@pytest.mark.parametrize(
    ("out", "shapes", "sentence"),
    [
        (
            {"effort.O": written(4, 1)},
            TWO,
            "out= is for effort.O, and there are results of effort.O, reaction.A; "
            "give an array of each by its name",
        ),
        (
            {"effort.O": written(4, 1), "x": written(4, 2)},
            TWO,
            "out= is for effort.O, x, and there are results of effort.O, reaction.A; "
            "give an array of each by its name",
        ),
        ([1.0], ONE, "out= of effort.O is not a writable array of floats; give np.empty((4, 1))"),
        (
            np.empty((4, 1), int),
            ONE,
            "out= of effort.O is not a writable array of floats; give np.empty((4, 1))",
        ),
        (read_only(), ONE, "out= of effort.O is not a writable array of floats; give np.empty((4, 1))"),
        (written(4), ONE, "out= of effort.O has shape (4,); give one of shape (4, 1)"),
        (
            {"effort.O": SHARED, "effort.P": SHARED},
            {"effort.O": (4, 1), "effort.P": (4, 1)},
            "out= uses one array for several results; give a separate array for each",
        ),
    ],
)
def test_arrays_for_the_results_that_do_not_fit_are_refused(out: Any, shapes: Any, sentence: str) -> None:
    assert said(lambda: targets(out, shapes)) == sentence


def test_arrays_for_the_results_are_found_by_name_in_the_order_of_the_outputs() -> None:
    first, second = written(4, 1), written(4, 2)
    found = targets({"reaction.A": second, "effort.O": first}, TWO)  # type: ignore[arg-type]
    assert list(found) == ["effort.O", "reaction.A"]
    assert found["effort.O"] is first
    assert found["reaction.A"] is second
    assert targets(first, ONE)["effort.O"] is first  # type: ignore[arg-type]


def test_a_number_of_positions_is_a_schedule_and_an_array_is_positions() -> None:
    m = da.slider_crank()
    assert np.allclose(drive_values(m, 4)[:, 0], np.arange(4) * np.pi / 2)
    assert len(drive_values(m, np.int64(3))) == 3
    assert drive_values(m, [[0.25], [0.75]]).tolist() == [[0.25], [0.75]]
    assert "positions of shape () do not fit 1 drive(s)" in said(lambda: drive_values(m, np.array(3)))
    assert "positions are text" in said(lambda: drive_values(m, ["a"]))


def schedule(speed: Any, acceleration: Any) -> Any:
    return SimpleNamespace(names=("O",), speed=np.array(speed), acceleration=np.array(acceleration))


STEADY = schedule([[2.0], [2.0]], [[3.0], [3.0]])


@pytest.mark.parametrize(
    ("positions", "of", "sentence"),
    [
        ([[0.25], [np.inf]], STEADY, "positions are not all finite; give numbers that are"),
        ([0.25], STEADY, "positions of shape (1,) do not fit 1 drive(s); give (position, drive)"),
        ([[0.25, 1.0]], STEADY, "positions of shape (1, 2) do not fit 1 drive(s); give (position, drive)"),
        (
            np.zeros((0, 1)),
            STEADY,
            "positions of shape (0, 1) do not fit 1 drive(s); give (position, drive)",
        ),
        (
            [[0.25]],
            schedule([[2.0], [2.5]], [[3.0], [3.0]]),
            "the drives' speeds change along the file's positions; leave positions out",
        ),
        (
            [[0.25]],
            schedule([[2.0], [2.0]], [[3.0], [3.5]]),
            "the drives' speeds change along the file's positions; leave positions out",
        ),
    ],
)
def test_positions_that_do_not_fit_the_drives_are_refused(positions: Any, of: Any, sentence: str) -> None:
    assert said(lambda: check_positions(np.array(positions), of)) == sentence


def test_positions_at_steady_speeds_are_taken() -> None:
    check_positions(np.array([[0.25], [0.75], [2.0]]), STEADY)
    with pytest.raises(ModelError) as raised:
        check_positions(np.array([[0.25]]), schedule([[2.0], [2.5]], [[3.0], [3.0]]))
    assert raised.value.path == ("drives",)


@pytest.mark.parametrize(
    ("target", "shapes", "reduce", "sentence"),
    [
        ([1.0], ONE, "rms", 'only squares are taken to a target; compile with reduce="squares"'),
        ([1.0], ONE, None, 'only squares are taken to a target; compile with reduce="squares"'),
        (
            {"effort.P": [1.0]},
            ONE,
            "squares",
            "target= is for effort.P, and there are outputs effort.O; give an array of each by its name",
        ),
        ([1.0, 2.0], ONE, "squares", "target= of effort.O has shape (2,); give one of shape (4,)"),
        (
            np.ones(4),
            {"reaction.A": (4, 2)},
            "squares",
            "target= of reaction.A has shape (4,); give one of shape (4, 2)",
        ),
        (
            [1.0, 2.0, np.nan, 4.0],
            ONE,
            "squares",
            "targets of effort.O are not all finite; leave those positions out: positions=",
        ),
        (["a"], ONE, "squares", f"targets of effort.O are text; {REAL}"),
    ],
)
def test_targets_that_do_not_fit_the_outputs_are_refused(
    target: Any, shapes: Any, reduce: Any, sentence: str
) -> None:
    assert said(lambda: read_target(target, shapes, reduce)) == sentence


def test_targets_are_taken_flat_or_with_one_column() -> None:
    for given in ([1.0, 2.0, 3.0, 4.0], [[1.0], [2.0], [3.0], [4.0]]):
        assert read_target(given, ONE, "squares")["effort.O"].tolist() == [[1.0], [2.0], [3.0], [4.0]]
    both = {"reaction.A": np.arange(8.0).reshape(4, 2), "effort.O": np.arange(4.0)}
    read = read_target(both, TWO, "squares")
    assert list(read) == ["effort.O", "reaction.A"]
    assert read["reaction.A"].tolist() == both["reaction.A"].tolist()


def test_a_count_is_a_whole_number_from_one_on() -> None:
    for count in (None, 1, 2, np.int64(5)):
        assert _check_count("threads", count) is None  # type: ignore[func-returns-value]
    for wrong in (0, -3, True, 1.5, "2"):
        assert said(lambda wrong=wrong: _check_count("lanes", wrong)) == (  # type: ignore[misc]
            f"lanes={wrong!r} is not a number of lanes; give 1 or more, or leave it out"
        )
