"""What is written of a result in space with friction."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import actions
from dalembert.cli import main

FILE = Path(__file__).parents[1] / "model" / "rssr.yaml"


@pytest.fixture
def rough() -> Any:
    """The spatial four-bar with a universal joint, rough in its bearings and its ball."""
    tree = da.load(FILE).to_tree()
    del tree["answers"]
    journal = {"coefficient": 0.1, "radius": "10 mm"}
    tree["joints"]["O"]["friction"] = journal | {"guide": ["20 mm", "20 mm"], "thrust_radius": "12 mm"}
    tree["joints"]["C"]["friction"] = dict(journal)
    tree["joints"]["A"]["friction"] = {"coefficient": 0.1, "radius": "6 mm"}
    return da.mechanism(tree)


def test_json_and_tables_have_friction_s_part(rough: Any) -> None:
    r = da.dynamics(rough)
    answer = json.loads(json.dumps(r.to_dict(axes="joint"), allow_nan=False))
    frame = r.to_dataframe(axes="joint")
    arrays = r.to_xarray(axes="joint")
    k = int(np.flatnonzero(r.ok)[-1])
    for joint in ("O", "C", "A"):
        position = answer["positions"][k]
        force, moment = position["friction_force"][joint], position["friction_moment"][joint]
        axes = np.array(answer["positions"][k]["joint_axes"][joint]["force"])
        assert force == pytest.approx(axes @ r.friction_force(joint)[k], abs=1e-12)
        assert moment == pytest.approx(axes @ r.friction_moment(joint)[k], abs=1e-12)
        assert position["power_lost"][joint] == r.power_lost(joint)[k]
        assert frame[f"friction_moment.{joint}.y [N*m]"].iloc[k] == moment[1]
        assert float(arrays["friction_moment"].sel(joint=joint, component="z")[k]) == moment[2]
        assert float(arrays["friction_force"].sel(joint=joint, component="x")[k]) == force[0]


def test_free_bodies_and_virtual_work_hold_with_friction(rough: Any) -> None:
    r = da.dynamics(rough)
    everything = actions(r)
    good = r.ok
    for link in r.links:
        some = [a for a in everything if a.link == link]
        assert np.abs(sum(a.force for a in some)[good]).max() < 1e-11
        assert np.abs(sum(a.moment(r.center(link)) for a in some)[good]).max() < 1e-12
    assert np.max(da.virtual_work(r).gap[good]) < 1e-12
    assert "friction in A" in {a.source for a in da.virtual_work(r).actions}
    assert {m.kind for m in da.members(r).values()} == {"general"}


STILL = {"drives.O.speed": 0.0, "drives.O.position": 0.5}


@pytest.mark.parametrize(
    ("changes", "method"),
    [({}, "matrix"), ({}, "virtual-work"), ({}, "fixed-point"), (STILL, "matrix"), (STILL, "virtual-work")],
)
def test_it_is_printed(
    rough: Any, changes: Any, method: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rough.with_values(changes).save(tmp_path / "rough.yaml")
    some = [] if changes else ["--positions", "1"]
    assert main(["solve", str(tmp_path / "rough.yaml"), "--method", method, *some]) == (1 if changes else 0)
    out = capsys.readouterr().out
    if method != "virtual-work":
        assert "M_ij z" in out
    if changes:
        assert "At the low end of O:" in out
    elif method == "matrix":
        rows = [line.split() for line in out.splitlines() if line.startswith(("O  ", "A  ", "C  "))]
        laws = [row for row in rows if "mu" in row]
        assert [row[0] for row in laws] == ["O", "A", "C"]


def test_what_friction_s_drawings_show_is_for_the_plane(rough: Any) -> None:
    r = da.dynamics(rough)
    for ask in (da.friction_circles, da.guide_contact):
        with pytest.raises(da.ModelError, match="is for planar mechanisms, but this one is in space; ask "):
            ask(r, "C")
    with pytest.raises(da.ModelError, match="superposition is refused: with dry friction"):
        da.superposition(r)
