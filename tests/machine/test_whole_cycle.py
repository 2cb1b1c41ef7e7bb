"""What each position of a cycle stands for, and which machines are taken round a turn."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import AnalysisError, ModelError
from dalembert.machine.harmonics import EVEN, whole_turns
from dalembert.machine.whole_cycle import (
    durations,
    over_a_turn,
    refuse_unknown,
    solved_over_a_turn,
    turning_angle,
)


def at(positions: Any, speed: float = 4.0) -> Any:
    m = da.four_bar().with_values({"drives.O2.position": positions, "drives.O2.speed": speed})
    return da.dynamics(m)


TURN = tuple(np.arange(8) * np.pi / 4)


@pytest.mark.parametrize(
    ("positions", "speed", "own"),
    [
        (TURN, 4.0, [np.pi / 16] * 8),
        (TURN, -4.0, [np.pi / 16] * 8),
        (TURN[::-1], -4.0, [np.pi / 16] * 8),
        ((0.0, 0.4, 0.6), 2.0, [0.1, 0.15, 0.05]),
        ((0.6, 0.4, 0.0), -2.0, [0.05, 0.15, 0.1]),
        ((0.6, 0.4, 0.0), 2.0, [0.05, 0.15, 0.1]),
        (0.3, 2.0, [1.0]),
        (0.3, 0.0, [1.0]),
    ],
)
def test_a_position_stands_for_the_time_halfway_to_its_neighbours(
    positions: Any, speed: float, own: list[float]
) -> None:
    assert durations(at(positions, speed)) == pytest.approx(own)


def test_of_a_law_it_is_its_own_time() -> None:
    law = {"type": "table", "time": [0, 1, 3, 4], "position": [0.0, 0.2, 0.5, 0.6], "count": 5}
    r = da.dynamics(da.four_bar().with_values({"drives.O2": {"law": law}}))
    assert durations(r) == pytest.approx([0.5, 1, 1, 1, 0.5])


def test_without_a_speed_no_time_is_known() -> None:
    with pytest.raises(
        ModelError, match="the time of each position is not known; give a drive a range and a speed"
    ):
        durations(at((0.1, 0.2), 0.0))


def test_a_machine_of_one_position_goes_round() -> None:
    single = da.four_bar().with_values({"drives.O2.position": 0.3})
    assert over_a_turn(single) == 72
    assert over_a_turn(single, 5) == 5
    assert over_a_turn(da.four_bar()) is None
    two = da.five_bar()
    assert over_a_turn(two) is None
    ends = {f"drives.{name}.position": 0.5 for name in two.drives}
    assert over_a_turn(two.with_values(ends)) is None  # which of them would go round?
    slide = da.scissor()
    assert over_a_turn(slide.with_values({f"drives.{n}.position": 0.4 for n in slide.drives})) is None


@pytest.mark.parametrize(
    ("angle", "turns"),
    [
        (np.arange(12) * np.pi / 6, 1),
        (-np.arange(12) * np.pi / 6, 1),
        (5.0 + np.arange(12) * np.pi / 3, 2),
        (np.arange(3) * 2 * np.pi / 3, 1),
        (np.arange(12) * np.pi / 6 + 0.4 * EVEN * (np.arange(12) == 5), 1),
    ],
)
def test_turns_of_a_period(angle: Any, turns: int) -> None:
    assert whole_turns(angle) == turns


@pytest.mark.parametrize(
    ("angle", "said"),
    [
        (np.arange(2) * np.pi, "a period needs at least 3 positions, all of them solved"),
        ([0.0, np.nan, 1.0], "a period needs at least 3 positions, all of them solved"),
        (np.arange(12) * np.pi / 6 + 3 * EVEN * (np.arange(12) == 5), "the positions are not even"),
        (np.zeros(5), "the positions are not even: steps of 0 to 0 deg"),
        (np.arange(13) * np.pi / 6, "the positions cover 390 deg, which is not a whole number of turns"),
        (np.arange(4) * 0.01, "the positions cover 2.29"),
    ],
)
def test_what_is_no_period(angle: Any, said: str) -> None:
    with pytest.raises(ModelError, match=said):
        whole_turns(np.asarray(angle))


def test_an_unknown_number_is_refused_with_its_position() -> None:
    r = at(TURN)
    good, bad = np.ones(8), np.where(np.arange(8) == 3, np.nan, 1.0)
    refuse_unknown(r, "sums", good, np.ones((8, 2)))
    with pytest.raises(AnalysisError, match="sums; position 4: "):
        refuse_unknown(r, "sums", good, np.stack([good, bad], axis=1))
    np.testing.assert_array_equal(turning_angle(r), r.drive_position("O2"))
    with pytest.raises(ModelError, match=r"over the turn of a drive, and \w+ slides; drive a crank"):
        turning_angle(da.statics(da.scissor()))


def test_a_file_of_one_position_is_solved_over_a_turn_where_it_turns() -> None:
    """Not at rest, nor where a turn does not close everywhere, nor where positions are asked for."""
    m = da.slider_crank(crank=0.05, rod=0.2).with_values({"drives.O2.position": 0.5})
    turned = solved_over_a_turn(m)
    assert len(turned.status) == 72
    assert turned.effort("O2") == pytest.approx(da.dynamics(m, positions=72).effort("O2"), rel=1e-12)
    still = solved_over_a_turn(m, static=True)
    assert still.effort("O2") == pytest.approx(da.statics(m, positions=72).effort("O2"), rel=1e-12, abs=1e-12)
    for other in (m.with_values({"drives.O2.speed": 0.0}), m.with_values({"links.rod.points.B.0": 0.045})):
        alone = solved_over_a_turn(other)
        assert alone.drive_position("O2").tolist() == [0.5]
        assert alone.ok.all()
    assert len(solved_over_a_turn(m, positions=5).status) == 5
    assert len(solved_over_a_turn(da.slider_crank(positions=8)).status) == 8
