"""Tables: through their points, straight or smooth between them, periodic over turns, nothing outside."""

from __future__ import annotations

import math

import numpy as np
import pytest

from dalembert.analysis import dynamics
from dalembert.errors import ModelError
from dalembert.model import Mechanism, Table, loads
from tests.model.parts import FOUR_BAR

X, Y = (0.0, 1.0, 2.5, 4.0), (1.0, 3.0, -2.0, 1.0)


@pytest.mark.parametrize("interpolate", ["linear", "cubic"])
@pytest.mark.parametrize("period", [None, 4.0])
def test_a_table_goes_through_its_points(interpolate: str, period: float | None) -> None:
    assert Table("O", X, Y, interpolate, period).at({"O": np.array(X)}) == pytest.approx(Y, abs=1e-14)


def test_between_the_points_it_is_straight() -> None:
    place = np.linspace(0, 4, 50).reshape(5, 10)
    assert Table("O", X, Y).at({"O": place}) == pytest.approx(np.interp(place, X, Y), abs=1e-14)


def test_a_cubic_reproduces_cubics() -> None:
    x = np.linspace(-1, 2, 6)
    place = np.linspace(-1, 2, 99)
    table = Table("O", tuple(x), tuple(x**3 - x), "cubic")
    assert table.at({"O": place}) == pytest.approx(place**3 - place, abs=1e-13)


def test_a_periodic_table_repeats_and_closes_itself() -> None:
    x = tuple(math.radians(a) for a in range(0, 360, 30))
    table = Table("O", x, tuple(math.sin(a) for a in x), "cubic", 2 * math.pi)
    place = np.linspace(-9, 9, 77)
    assert table.at({"O": place}) == pytest.approx(np.sin(place), abs=3e-3)
    assert table.at({"O": place + 4 * math.pi}) == pytest.approx(table.at({"O": place}), abs=1e-12)


@pytest.mark.parametrize(("outside", "there"), [("refuse", 1.0), ("hold", 1.0), ("zero", 0.0)])
def test_at_its_end_rounding_is_forgiven_and_nothing_more(outside: str, there: float) -> None:
    table = Table("O", X, Y, outside=outside)
    at = np.array([4.0, 4.0 + 1e-12, 4.0 + 1e-7])
    assert list(table.at({"O": at})) == [1.0, 1.0, there]
    assert list(table.beyond(at)) == [False, False, outside == "refuse"]


def test_another_evaluator_gets_the_table() -> None:
    table = Table("O", X, Y)
    assert table.at({"O": 3.0}, {"table": lambda t, place: (t is table, place)}) == (True, 3.0)


def force(value: str) -> tuple[np.ndarray, ...]:
    text = FOUR_BAR.replace("value: 80 @ 330", f"direction: 0, value: {value}")
    return loads(text).loads["F_P"].force({"O2": np.radians([0.0, 45.0, 359.0])})  # type: ignore[union-attr]


def test_in_a_file_the_units_are_the_files_or_their_own() -> None:
    bare = force("{against: O2, x: [0, 90, 180, 270], y: [0, 1, 2, 1], periodic: true}")[0]
    said = force(
        "{against: O2, x: [0 rad, 0.25 turn, 180 deg, 270], y: [0, 1 lbf, 2, 1], periodic: 360 deg}"
    )[0]
    assert bare == pytest.approx(np.array([0, 0.5, 1 / 90]) * 4.4482216152605, abs=1e-12)
    assert said == pytest.approx(bare, abs=1e-12)


def with_table(table: str, drive: str = "position: 60 deg") -> Mechanism:
    text = FOUR_BAR.replace("value: 80 @ 330", f"direction: 0, value: {{against: O2, {table}}}")
    return loads(text.replace("position: 60 deg", drive).replace(", acceleration: -40 rad/s^2", ""))


@pytest.mark.parametrize("periodic", ["true", "720 deg", "2 turn"])
def test_a_table_may_repeat_after_several_turns(periodic: str) -> None:
    table = f"x: [0, 200, 360, 500, 720], y: [300, 900, 0, -200, 300], periodic: {periodic}"
    r = dynamics(with_table(table, "position: {from: -720, to: 2160, count: 48}"))
    effort = r.effort("O2").reshape(4, 2, 6)
    assert effort[1:] == pytest.approx(np.broadcast_to(effort[0], (3, 2, 6)), rel=1e-9)
    assert np.abs(effort[0, 1] - effort[0, 0]).max() > 0.1 * np.abs(effort).max()


@pytest.mark.parametrize(("x", "turns"), [("0, 300", 1), ("-180, 180", 1), ("180, 900", 2), ("0, 3 turn", 3)])
def test_periodic_true_is_the_whole_turns_a_table_goes_over(x: str, turns: int) -> None:
    table = with_table(f"x: [{x}], y: [1, 1], periodic: true").loads["F_P"].value  # type: ignore[union-attr]
    assert isinstance(table, Table)
    assert table.period == pytest.approx(2 * math.pi * turns)


def test_a_periodic_table_ends_where_it_begins_by_its_largest_value() -> None:
    """Rounding beside the largest value is none, also where another one is zero."""
    text = FOUR_BAR.replace(
        "value: 120}", "value: {against: O2, x: [0, 180, 360], y: [1000, 0, END], periodic: true}}"
    )
    for end, fits in (("1000.0000000001", True), ("1000.000002", False), ("999.999998", False)):
        if fits:
            loads(text.replace("END", end))
            continue
        with pytest.raises(ModelError, match="ends with another value than it begins with"):
            loads(text.replace("END", end))


def test_the_next_point_is_beyond_rounding_of_the_largest() -> None:
    table = Table("time", (0.0, 1e6, 2e6), (0.0, 1.0, 0.0), along="time")
    small = np.spacing(2e6)
    for position, following in (
        *((-5 * small, 0.0), (-3 * small, 1e6), (0.0, 1e6), (1e6 - 5 * small, 1e6), (1e6 - 3 * small, 2e6)),
        *((2e6, math.inf), (-1.0, 0.0)),
    ):
        assert table.next_point(position) == following
