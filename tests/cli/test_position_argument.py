"""`--at`: a position by an extreme of a quantity, and that position alone."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.result.position_lookup import position_at
from dalembert.bundled import cases, examples
from dalembert.cli import main
from dalembert.cli.documents.position_argument import TURNS, _path_to, position_alone, solve_at
from tests.cli.conftest import Run

R = da.dynamics(da.four_bar(), positions=37)
SIZES = {
    "max effort.O2": R["effort.O2"],
    "min effort.O2": -R["effort.O2"],
    "peak effort.O2": abs(R["effort.O2"]),
    "max |effort.O2|": abs(R["effort.O2"]),
    "greatest(reaction.B)": np.hypot(*R["reaction.B"].T),
    "least reaction.B.x": -R["reaction.B.x"],
    "max abs(effort.O2) - 2*angle.rocker.speed": abs(R["effort.O2"]) - 2 * R["angle.rocker.speed"],
}


@pytest.mark.parametrize("at", SIZES)
def test_an_extreme_is_where_no_other_position_goes_further(at: str) -> None:
    k, sizes = position_at(R, at), SIZES[at]
    others = np.delete(sizes, k)
    assert sizes[k] > others.max() + 1e-6 * np.ptp(sizes)


def test_of_equal_values_the_first_is_meant() -> None:
    assert position_at(R, "max drive.O2.speed") == 0


def test_both_sides_of_a_reversal_count() -> None:
    m = da.load(cases()["seed-002-7a-engine-friction-circles"])
    r = da.solve(m.with_values({"drives.O.position": {"from": 0.0, "to": 2 * np.pi, "count": 9}}))
    before, after = r.both_sides("effort.O")
    assert not np.array_equal(before, after)
    low, high = np.fmin(before, after), np.fmax(before, after)
    assert position_at(r, "min effort.O") == low.argmin()
    assert position_at(r, "max effort.O") == high.argmax()


@pytest.mark.parametrize(
    ("at", "message"),
    [
        ("max efort.O2", "did you mean 'effort.O2'"),
        ("min load", "unknown quantity"),
        ("maximum effort.O2", "maximum"),
    ],
)
def test_what_is_not_an_extreme_is_refused_by_name(at: str, message: str) -> None:
    with pytest.raises(da.ModelError, match=message):
        position_at(R, at)


@pytest.mark.parametrize("name", ["engine", "gear_train", "rssr", "cam_and_follower"])
def test_a_position_alone_has_the_numbers_it_has_among_the_others(name: str) -> None:
    r = da.solve(da.load(examples()[name]))
    alone, sentence = position_alone(r, "peak reaction." + r.joints[0])
    k = position_at(r, "peak reaction." + r.joints[0])
    assert len(alone.status) == 1
    assert f"Position {k + 1} of {len(r.status)}" in sentence
    largest = np.nanmax(abs(r.force_array[k]))
    assert alone.force_array[0] == pytest.approx(r.force_array[k], abs=1e-9 * largest, nan_ok=True)


def test_solve_prints_the_sentence_and_that_position(run: Run) -> None:
    file = str(examples()["engine"])
    printed = run("solve", file, "--at", "max effort.O2")
    rows = list(csv.DictReader(io.StringIO(run("solve", file, "--csv", "-").out)))
    best = max(rows, key=lambda row: float(row["effort.O2 [N*mm]"]))
    assert printed.out.startswith(f"Position {best['position']} of 720, O2 = ")
    assert f"effort.O2 is largest here, {float(best['effort.O2 [N*mm]']):.6g} N*mm." in printed.out
    only = run("solve", file, "--at", "max effort.O2", "--csv", "-")
    assert len(only.out.splitlines()) == 2
    assert only.err.startswith("Position")


@pytest.mark.parametrize("at", [60, -60, 0, 61])
def test_a_value_that_the_file_has_not_is_gone_to(at: int) -> None:
    """The angle of the file itself, the same one the other way round, and others; in the mode of the file."""
    m = da.load(examples()["four_bar"])
    r, where = solve_at(m, f"{at} deg", static=True, positions=None)
    assert np.degrees(r.drive_position("O2")[position_at(r, where)]) == pytest.approx(at)
    way = da.kinematics(
        m.with_values({"drives.O2.position": [f"{60 + (at - 60) * k / 9} deg" for k in range(10)]})
    )
    assert r.angle("rocker")[0] == pytest.approx(way.angle("rocker")[-1])


def test_a_value_that_the_drive_does_not_reach_has_no_number() -> None:
    """The rocker as a crank that turns only so far: gone to in vain, nothing is solved, and nothing fails."""
    m = da.four_bar().with_values(
        {"links.crank.points.A": [0.9, 0.0], "links.coupler.points.B": [0.6, 0.0], "drives.O2.position": 1.0}
    )
    assert da.kinematics(m).ok.all()
    r, _ = solve_at(m, "179 deg", static=True, positions=None)
    assert r.status == ("not_assembled",)


@pytest.mark.parametrize("turns", [TURNS - 1, -(TURNS - 1), TURNS + 1, -(TURNS + 1), 1e9])
def test_a_value_many_turns_away_is_gone_to_up_to_a_limit(turns: float) -> None:
    m = da.load(examples()["four_bar"])
    at = f"{60 + 360 * turns!r} deg"
    if abs(turns) < TURNS:
        way = _path_to(m, at)
        assert way is not None
        assert way[-1] == pytest.approx(np.radians(60 + 360 * turns))
        return
    with pytest.raises(
        da.ModelError, match=f"is more than {TURNS} turns from that of drive 'O2' in the file"
    ):
        solve_at(m, at, static=True, positions=None)


def test_a_shaft_without_a_name_is_no_shaft(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "shaft.yaml"
    da.rotating_shaft().save(file)
    assert main(["shaft", str(file), "--link", ""]) == 2
    assert "unknown link ''" in capsys.readouterr().err
