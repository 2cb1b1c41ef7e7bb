"""What the drives do, position by position."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.errors import ModelError
from dalembert.model import Drive, Mechanism, loads
from dalembert.model.drives.schedule import schedule
from tests.model.parts import FOUR_BAR

TWO = """
links: {{ground: {{points: {{A: [0, 0], B: [0, 0]}}}}, a: {{points: {{A: [0, 0]}}}}, b: {{points: {{B: [0, 0]}}}}}}
joints:
  A: {{type: pin, links: [ground, a]}}
  B: {{type: slider, links: [ground, b]}}
units: {{length: mm}}
drives:
  A: {{{0}}}
  B: {{{1}}}
"""


def two(first: str, second: str) -> Mechanism:
    return loads(TWO.format(first, second))


def test_single_values() -> None:
    found = loads(FOUR_BAR).schedule()
    assert found.names == ("O2",)
    assert found.position.tolist() == [[math.pi / 3]]
    assert found.speed.tolist() == [[25.0]]
    assert found.acceleration.tolist() == [[-40.0]]
    assert found.time is None
    assert found.unknown is None


def test_a_structure_has_one_position_and_no_drive() -> None:
    found = schedule({})
    assert found.position.shape == (1, 0)
    assert found.count == 1


@pytest.mark.parametrize(
    ("span", "expected"),
    [
        ("{from: 0, to: 360, count: 4}", [0, 90, 180, 270]),
        ("{from: 90, to: -270, count: 4}", [90, 0, -90, -180]),
        ("{from: 0, to: 720, count: 4}", [0, 180, 360, 540]),
        ("{from: 0, to: 90, count: 4}", [0, 30, 60, 90]),
        ("{from: 5, to: 5, count: 2}", [5, 5]),
        ("{from: 5, to: 25, count: 1}", [5]),
        ("[1, 2 deg, 4]", [1, 2, 4]),
    ],
)
def test_a_full_turn_does_not_repeat_its_first_position(span: str, expected: list[float]) -> None:
    found = two(f"position: {span}", "position: 3").schedule()
    assert np.degrees(found.position[:, 0]) == pytest.approx(expected, abs=1e-9)
    assert found.position[:, 1] == pytest.approx(0.003)


def test_a_slide_repeats_nothing() -> None:
    found = two("position: 0", "position: {from: 0, to: 6283.185307179586, count: 3}").schedule()
    assert found.position[:, 1] == pytest.approx([0, math.pi, 2 * math.pi])


def test_ranges_advance_together_and_single_values_combine() -> None:
    found = two(
        "position: {from: 0, to: 90, count: 3}, speed: [1 rad/s, 2 rad/s, 3 rad/s]",
        "position: [1, 2, 3], speed: 5",
    ).schedule()
    assert found.position[:, 1] == pytest.approx([0.001, 0.002, 0.003])
    assert found.speed.tolist() == [[1.0, 0.005], [2.0, 0.005], [3.0, 0.005]]


@pytest.mark.parametrize(
    ("first", "second", "positions", "says"),
    [
        (
            "position: {from: 0, to: 90, count: 3}",
            "position: [1, 2]",
            None,
            "the numbers of positions differ: 3 of drive 'A' "
            "and 2 of drive 'B'; drives advance together: give equal counts, or single values",
        ),
        (
            "position: [1, 2]",
            "position: 3",
            5,
            "the numbers of positions differ: 2 of drive 'A', but positions=5; "
            "the list sets the count: leave the number out, or write {from, to, count}",
        ),
        (
            "position: unknown, effort: 1",
            "position: 1",
            5,
            "positions=5 cannot be used: the positions of drive 'A' are computed within its range; "
            "leave the number out",
        ),
        (
            "position: unknown, effort: 1",
            "position: unknown, effort: 1, range: [0, 1]",
            None,
            "the positions of 2 drives are unknown: A, B; leave one unknown, give the others",
        ),
        ("position: 1", "position: 1", 0, "positions=0 is out of range; use 1 to 10000000"),
        (
            "law: {type: harmonic, from: 0, to: 90, duration: 1, count: 5}",
            "law: {type: harmonic, from: 0, to: 90, duration: 2, count: 5}",
            None,
            "the laws of drives 'A' and 'B' have different times; give them the same duration",
        ),
    ],
)
def test_what_does_not_go_together(first: str, second: str, positions: int | None, says: str) -> None:
    mechanism = two(first, second)
    with pytest.raises(ModelError) as caught:
        mechanism.schedule(positions)
    assert str(caught.value) == says


def test_positions_replace_the_counts_of_ranges() -> None:
    mechanism = two("position: {from: 0, to: 360, count: 3}", "position: {from: 0, to: 9, count: 3}")
    found = mechanism.schedule(10)
    assert found.position[:, 0] == pytest.approx(np.radians(np.arange(0, 360, 36)))
    assert found.position[:, 1] == pytest.approx(np.arange(10) / 1000)


def test_positions_step_a_lone_turn_round() -> None:
    found = two("position: 30, speed: 2 rpm", "position: 1").schedule(4)
    assert np.degrees(found.position[:, 0]) == pytest.approx([30, 120, 210, 300])
    assert (found.position[:, 1] == 0.001).all()


def test_positions_of_a_structure_are_refused() -> None:
    assert schedule({}, 1).count == 1
    with pytest.raises(ModelError) as caught:
        schedule({}, 5)
    assert str(caught.value) == ("positions=5 cannot be used: a structure has no drive; leave the number out")


def test_positions_without_one_turn_are_refused() -> None:
    drives = {"A": Drive(position=0.0, freedom="turn"), "B": Drive(position=0.0, freedom="turn")}
    with pytest.raises(ModelError) as caught:
        schedule(drives, 5)
    assert str(caught.value) == (
        "positions=5 needs one drive that turns, not 2 (A, B); "
        "give one drive its steps in the file: position: {from: 0 deg, to: 360 deg, count: 72}"
    )


@pytest.mark.parametrize("form", ["harmonic", "cycloidal", "polynomial345"])
def test_a_law_rises_from_rest_to_rest_and_its_rates_are_its_derivatives(form: str) -> None:
    law = f"law: {{type: {form}, from: 10, to: 100, duration: 0.5, count: 20001}}"
    found = two("position: 0", law).schedule()
    t, s, v, a = found.time, found.position[:, 1], found.speed[:, 1], found.acceleration[:, 1]
    assert t[[0, -1]].tolist() == [0.0, 0.5]
    assert s[[0, -1]] == pytest.approx([0.01, 0.1])
    assert v[[0, -1]] == pytest.approx([0.0, 0.0], abs=1e-12)
    assert np.gradient(s, t)[1:-1] == pytest.approx(v[1:-1], abs=1e-6)
    assert np.gradient(v, t)[1:-1] == pytest.approx(a[1:-1], abs=1e-4)


def test_a_law_from_a_table_is_smooth() -> None:
    times = np.linspace(0, 2, 41)
    text = f"law: {{type: table, time: {times.tolist()}, position: {np.degrees(np.sin(times)).tolist()}, count: 7}}"
    found = two(text, "position: 1").schedule(9)
    assert found.time == pytest.approx(np.linspace(0, 2, 9))
    assert found.position[:, 0] == pytest.approx(np.sin(found.time), abs=1e-6)
    assert found.speed[:, 0] == pytest.approx(np.cos(found.time), abs=1e-4)
    assert found.acceleration[:, 0] == pytest.approx(-np.sin(found.time), abs=1e-2)


def test_a_periodic_table_of_time_does_not_repeat_its_first_instant() -> None:
    text = "law: {type: table, time: [0, 1, 2, 3, 4], position: [0, 9, 0, -9, 0], count: 4, periodic: true}"
    found = two(text, "position: 1").schedule()
    assert found.time.tolist() == [0.0, 1.0, 2.0, 3.0]
    assert found.speed[0, 0] == pytest.approx(-found.speed[2, 0])


@pytest.mark.parametrize(
    ("key", "says"),
    [
        ("count", "the key 'count' is missing; write {type: table, time: [...], position: [...], count: 50}"),
        ("time", "the key 'time' is missing; write {type: table, time: [...], position: [...], count: 50}"),
        ("tim", "unknown key 'tim' in law of drive 'A'; did you mean 'time'?"),
    ],
)
def test_a_table_of_time_has_its_keys_and_no_others(key: str, says: str) -> None:
    keys = {"type": "table", "time": "[0, 1, 2]", "position": "[0, 9, 0]", "count": "4"}
    keys = {k: v for k, v in keys.items() if k != key} | ({key: "3"} if key == "tim" else {})
    with pytest.raises(ModelError) as refused:
        two(f"law: {{{', '.join(f'{k}: {v}' for k, v in keys.items())}}}", "position: 1")
    assert str(refused.value).endswith(says)


def test_an_unknown_position() -> None:
    found = two("position: unknown, effort: 3", "position: 1").schedule()
    assert found.unknown == "A"
    assert found.range == (0.0, 2 * math.pi)
    assert np.isnan(found.position[0, 0])


@pytest.mark.parametrize(
    ("drive", "moves"),
    [("position: 3", False), ("position: 3, speed: 0", False), ("position: 3, speed: 1 rpm", True),
     ("position: 3, acceleration: 1 rad/s^2", True), ("position: [1, 2], speed: [0 rad/s, 1 rad/s]", True),
     ("law: {type: harmonic, from: 0, to: 90, duration: 1, count: 5}", True)],
)  # fmt: skip
def test_has_speeds(drive: str, moves: bool) -> None:
    assert two(drive, "position: 1").has_speeds is moves


# positions of a call: a count, or values of the drives


FIVE = da.five_bar()
SHIFTED = np.array([[0.1, 2.0], [0.2, 2.1], [0.3, 2.2]]) + FIVE.schedule().position[0] - [0.1, 2.0]


def test_values_of_the_drives_are_positions() -> None:
    m = da.four_bar()
    full, r = da.dynamics(m, 36), da.dynamics(m, positions=da.four_bar().schedule(36).position[:, 0])
    assert r["drive.O2"] == pytest.approx(full["drive.O2"], abs=0)
    assert r["effort.O2"] == pytest.approx(full["effort.O2"], rel=1e-12)
    for given in (SHIFTED, SHIFTED.tolist(), SHIFTED.ravel()):
        assert (da.statics(FIVE, given).schedule.position == SHIFTED).all()
    assert len(da.statics(m, np.int64(5))) == 5
    assert da.sweep(m, "links.coupler.mass", [1.0], positions=[0.1, 0.2])["effort.O2"].shape == (1, 2)
    best = da.optimize(
        m, {"links.coupler.mass": (0.5, 2)}, "peak effort.O2", positions=[0.1, 0.2, 0.3], starts=2
    )
    assert best.after["drive.O2"].tolist() == best.before["drive.O2"].tolist() == [0.1, 0.2, 0.3]
    assert best.value == pytest.approx(best.after.peak("effort.O2").value)


def test_values_do_not_replace_a_law_or_an_unknown() -> None:
    with pytest.raises(
        ModelError, match="drive 'cylinder' follows a law, which gives its positions; leave positions"
    ):
        da.dynamics(examples()["bucket"], positions=[0.8])
    with pytest.raises(ModelError, match="drive 'A' has its position computed; leave positions out"):
        two("position: unknown, effort: 3", "position: 1").schedule([[0.1, 0.2]])


def test_a_number_of_positions_is_one_in_a_kernel_too() -> None:
    m = da.four_bar()
    k = da.compile(m, ["links.coupler.mass"], ["effort.O2"])
    assert k(positions=12)["effort.O2"][0] == pytest.approx(da.dynamics(m, 12)["effort.O2"], rel=1e-9)
    assert k(positions=[0.1, 0.2])["effort.O2"][0] == pytest.approx(da.dynamics(m, [0.1, 0.2])["effort.O2"])
    with pytest.raises(da.ModelError, match=r"positions=72\.0 is not an integer"):
        k(positions=72.0)
    with pytest.raises(da.ModelError, match=r"positions of shape \(\)"):
        k(positions=np.array(72.0))


@pytest.mark.parametrize(
    ("model", "positions", "says"),
    [
        (FIVE, 72.0, "positions=72.0 is not an integer; give a number of positions, or a list of values"),
        (FIVE, True, "positions=True is not an integer; give a number of positions, or a list of values"),
        (FIVE, [0.1, 0.2, 0.3], "positions of shape (3,) do not fit 2 drive(s); give (position, drive)"),
        (FIVE, [[0.1], [0.2]], "positions of shape (2, 1) do not fit 2 drive(s); give (position, drive)"),
        (FIVE, [], "positions of shape (0,) do not fit 2 drive(s); give (position, drive)"),
        (
            FIVE,
            [[0.1, np.nan]],
            "positions are not finite; give a list of numbers, one for each position and drive",
        ),
        (
            FIVE,
            "ab",
            "positions are 'ab', not numbers; give a list of numbers, one for each position and drive",
        ),
    ],
)
def test_positions_that_are_none(model: da.Mechanism, positions: Any, says: str) -> None:
    with pytest.raises(da.ModelError) as caught:
        da.statics(model, positions)
    assert str(caught.value) == says
