"""Numbers that a method takes apart, of efforts and of unknown loads; names that a drawing uses."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.cli import main
from dalembert.cli.method_text import _quantities
from dalembert.notebook.plots import _vectors
from dalembert.optimization.side_by_side import _direction


def unknown() -> da.Mechanism:
    loads = {
        "M": {"type": "couple", "on": "rocker", "value": "unknown"},
        "F": {"type": "force", "on": "coupler", "at": "B", "value": [3.0, -20.0]},
    }
    return da.four_bar(positions=3).with_values({"loads": loads, "drives.O2.effort": 3.0})


def test_superposition_takes_unknown_loads_apart(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    m = unknown()
    parts = da.superposition(da.dynamics(m))
    for k in range(3):
        (drive, load), *joints = _quantities(parts, k)
        assert (drive[0], drive[2], load[0], load[2]) == ("O2", "moment", "M", "moment")
        assert load[1][-1] == pytest.approx(parts.result.unknown_load("M")[k])
        assert load[1][:-1].sum() == pytest.approx(load[1][-1])
        assert drive[1][-1] == pytest.approx(3.0)
        for joint, some in zip(parts.result.joints, joints, strict=True):
            totals = {name: values[-1] for name, values, _ in some}
            x, y = parts.result.reaction(joint)[k]
            assert totals[f"{joint} x"] == pytest.approx(x)
            assert totals[f"{joint} y"] == pytest.approx(y)
    m.save(tmp_path / "m.yaml")
    assert main(["solve", str(tmp_path / "m.yaml"), "--method", "superposition"]) == 0
    printed = capsys.readouterr().out.partition("Superposition")[2]
    assert "M" in printed.split()


def test_a_drawing_has_names_or_numbers_of_links(tmp_path: Path) -> None:
    da.four_bar(positions=1).save(tmp_path / "m.yaml")
    said = {}
    for names in (False, True):
        target = tmp_path / f"{names}.svg"
        assert main(["draw", str(tmp_path / "m.yaml"), "-o", str(target), *["--names"] * names]) == 0
        said[names] = target.read_text(encoding="utf-8")
    assert "link 3 coupler" in said[False]  # its number, with its name behind
    assert "link 3" not in said[True]
    assert "coupler" in said[True]


def test_quantities_are_named_once_without_their_components() -> None:
    names = [
        "effort.O",
        "reaction.A.x",
        "reaction.A.y",
        "reaction.A.z",
        "reaction.A.magnitude",
        "angle.rod",
        "y",
        "my",
    ]
    given = {name: np.zeros(2) for name in names}
    assert _vectors(given) == ["effort.O", "reaction.A", "angle.rod", "y", "my"]


def test_a_step_goes_downhill_and_through_no_bound() -> None:
    """A number at its bound stays where the slope pushes it out, and moves where it draws it in."""
    u = np.array([[0.0, 1.0, 0.5], [0.0, 1.0, 0.5]])
    slope = np.array([[1.0, -1.0, 2.0], [-1.0, 1.0, 2.0]])
    inverse = np.stack([np.eye(3)] * 2)
    way = _direction(u, slope, inverse)
    np.testing.assert_allclose(way, [[0, 0, -2], [1, -1, -2]])
    coupled = np.array([[1.0, 0.5, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 3.0]])
    way = _direction(u[1:], slope[1:], coupled[None])
    np.testing.assert_allclose(way, [[0.5, -0.5, -6.0]])
    wrong = _direction(u[1:], slope[1:], -np.eye(3)[None])  # not uphill, whatever it has learnt
    assert (wrong * slope[1:]).sum() < 0
