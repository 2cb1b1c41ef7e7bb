"""What is written of a result in space: JSON, tables, arrays, the printed answer; in any axes."""

from __future__ import annotations

import csv
import json
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.algebra import space
from dalembert.bundled import examples
from dalembert.cli import main
from tests.space.machines import door, oracle, rssr

AXES = ("ground", "link", "joint")
every_axes = pytest.mark.parametrize("axes", AXES)


@every_axes
def test_json_has_vectors_of_three_components(axes: Any) -> None:
    r = da.dynamics(oracle("rsur"))
    answer = json.loads(json.dumps(r.to_dict(axes=axes), allow_nan=False))
    assert answer["reaction_axes"] == axes
    assert answer["mobility"]["passive"] == []
    for k, position in enumerate(answer["positions"]):
        assert ("joint_axes" in position) == (axes == "joint")
        for joint, found in answer["joints"].items():
            i, j = r.mechanism.joints[joint].links
            assert (found["by"], found["on"]) == (i, j)
            assert position["reaction"][joint] == r.reaction(joint, j, axes)[k].tolist()
            assert position["reaction_moment"][joint] == r.reaction_moment(joint, j, axes)[k].tolist()
        for link, found in position["point"].items():
            assert position["rotation"][link] == r.rotation(link)[k].tolist()
            assert position["angle"][link] == {
                "speed": r.speed(link)[k].tolist(),
                "acceleration": r.acceleration(link)[k].tolist(),
            }
            assert found["origin"]["value"] == r.position(link)[k].tolist()
            assert found["center"]["acceleration"] == r.center_acceleration(link)[k].tolist()


def test_rotation_turns_link_components_into_ground_components() -> None:
    r = da.dynamics(oracle("rsur"))
    first = r.to_dict()["positions"][0]
    origin = np.array(first["point"]["rod"]["origin"]["value"])
    at = origin + np.array(first["rotation"]["rod"]) @ r.mechanism.point("rod", "B")
    assert at == pytest.approx(r.point("rod", "B")[0], abs=1e-15)


def test_axes_of_link_and_joint_are_the_same_vectors() -> None:
    r = da.dynamics(oracle("rsur"))
    own = r.to_dict(axes="joint")["positions"]
    link = r.to_dict(axes="link")["positions"]
    answer = r.to_dict()
    for k, position in enumerate(answer["positions"]):
        for joint, found in answer["joints"].items():
            rotation = np.array(position["rotation"][found["on"]])
            axes = np.array(own[k]["joint_axes"][joint]["force"])
            for name in ("reaction", "reaction_moment"):
                vector = np.array(position[name][joint])
                assert rotation.T @ vector == pytest.approx(link[k][name][joint], abs=1e-12)
                assert axes @ vector == pytest.approx(own[k][name][joint], abs=1e-12)


def test_a_moment_may_have_axes_of_its_own() -> None:
    """A slotted sphere in a cylinder: its forces keep to the cylinder, its moment to the slot."""
    m = da.mechanism(
        {
            "space": "space",
            "links": {
                "ground": {"points": {"A": [0, 0, 0], "B": [1, 0, 0]}},
                "beam": {"points": {"A": [0, 0, 0], "B": [1, 0, 0]}},
            },
            "joints": {
                "A": {
                    "type": "slotted_sphere_in_cylinder",
                    "links": ["ground", "beam"],
                    "axes": {
                        "i": {"x": [1, 0, 0], "z": [0, 0, 1]},
                        "j": {"x": [0.8, 0, -0.6], "z": [0.6, 0, 0.8]},
                    },
                },
                "B": {"type": "spherical", "links": ["ground", "beam"]},
            },
            "loads": {"M": {"type": "couple", "on": "beam", "value": [1, 2, 3]}},
        }
    )
    r = da.statics(m)
    assert r.ok.all()
    found, ground = r.to_dict(axes="joint")["positions"][0], r.to_dict()["positions"][0]
    for part, name in (("force", "reaction"), ("moment", "reaction_moment")):
        turned = np.array(found["joint_axes"]["A"][part]) @ ground[name]["A"]
        assert turned == pytest.approx(found[name]["A"])
    assert found["reaction_moment"]["A"][1:] == pytest.approx([0, 0], abs=1e-14)
    assert abs(found["reaction_moment"]["A"][0]) > 0.1
    assert "moment" not in found["joint_axes"]["B"]


def test_a_rod_that_could_spin_is_named() -> None:
    r = da.dynamics(rssr())
    assert r.to_dict()["mobility"]["passive"] == ["rod"]


@every_axes
def test_what_is_not_unique_is_null_with_least_norm_beside(axes: Any) -> None:
    r = da.dynamics(door())
    answer = json.loads(json.dumps(r.to_dict(axes=axes), allow_nan=False))
    assert answer["mobility"]["redundant"] == 5
    assert answer["mobility"]["redundant_joints"] == ["A", "B"]
    for k, position in enumerate(answer["positions"]):
        assert position["status"] == "redundant"
        assert position["effort"]["A"] == pytest.approx(r.effort("A")[k])
        least = position["least_norm"]
        for joint in answer["joints"]:
            both = least["reaction"][joint] + least["reaction_moment"][joint]
            assert both == r.least_norm(joint, axes=axes)[k].tolist()
            for name in ("reaction", "reaction_moment"):
                for given, beside in zip(position[name][joint], least[name][joint], strict=True):
                    assert given is None or given == beside


def test_in_the_axes_of_a_skew_hinge_its_own_moment_is_unique() -> None:
    """About their own line two hinges carry nothing: known in the joint's axes, hidden in ground's and the link's."""
    r = da.dynamics(door(axis=(1.0, 2.0, 3.0)))
    for joint in ("A", "B"):
        own = r.to_dict(axes="joint")["positions"][0]
        assert own["reaction_moment"][joint][:2] == [None, None]
        assert own["reaction_moment"][joint][2] == pytest.approx(0.0, abs=1e-10)
        assert own["reaction"][joint] == [None, None, None]
        assert r.to_dict()["positions"][0]["reaction_moment"][joint] == [None, None, None]
    both = sum(r.least_norm(joint, axes="joint")[0, 2] for joint in ("A", "B"))
    whole = sum(r.least_norm(joint)[0, :3] for joint in ("A", "B"))
    assert both == pytest.approx(whole @ np.array([1, 2, 3]) / np.sqrt(14))


@every_axes
def test_tables_hold_the_numbers_of_the_json_answer(axes: Any) -> None:
    r = da.dynamics(door())
    frame = r.to_dataframe(axes=axes)
    answer = r.to_dict(axes=axes)
    for k, position in enumerate(answer["positions"]):
        for name, unit in (("reaction", "N"), ("reaction_moment", "N*m")):
            for c, axis in enumerate("xyz"):
                given = frame[f"{name}.B.{axis} [{unit}]"].iloc[k]
                expected = position[name]["B"][c]
                assert np.isnan(given) if expected is None else given == expected
                least = frame[f"{name}.B.least_norm.{axis} [{unit}]"].iloc[k]
                assert least == position["least_norm"][name]["B"][c]
        rotation = position["rotation"]["door"]
        assert [frame[f"rotation.door.{a}{b}"].iloc[k] for a in "xyz" for b in "xyz"] == list(
            chain.from_iterable(rotation)
        )
        assert frame["angle.door.speed.z [rad/s]"].iloc[k] == position["angle"]["door"]["speed"][2]


def test_arrays_are_labelled(tmp_path: Path) -> None:
    import xarray

    r = da.dynamics(oracle("rsur"))
    r.to_netcdf(tmp_path / "r.nc")
    with xarray.open_dataset(tmp_path / "r.nc", engine="h5netcdf") as found:
        assert list(found["component"].values) == list(found["link_axis"].values) == ["x", "y", "z"]
        one = found["reaction_moment"].sel(joint="B", component="y")
        assert np.array_equal(one, r.reaction_moment("B")[:, 1])
        assert found["rotation"].dims == ("position", "link", "component", "link_axis")
        assert np.array_equal(found["rotation"].sel(link="rod"), r.rotation("rod"))
        assert np.array_equal(found["angle_speed"].sel(link="rod"), r.speed("rod"))


def test_csv_and_workbook_agree(tmp_path: Path) -> None:
    from openpyxl import load_workbook

    r = da.dynamics(rssr())
    r.to_csv(tmp_path / "r.csv")
    r.to_xlsx(tmp_path / "r.xlsx")
    with open(tmp_path / "r.csv", encoding="utf-8") as stream:
        plain = list(csv.reader(stream))
    sheet = [list(row) for row in load_workbook(tmp_path / "r.xlsx")["positions"].values]
    assert plain[0] == sheet[0]
    assert "rotation.rod.xy" in plain[0]
    for one, other in zip(plain[1:], sheet[1:], strict=True):
        assert [float(x) for x in one[2:-1]] == pytest.approx([float(x) for x in other[2:-1]], rel=1e-14)


def test_one_position_is_printed_in_full(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    one = rssr(**{"drives.O.position": np.pi / 2})
    one.save(tmp_path / "one.yaml")
    assert main(["solve", str(tmp_path / "one.yaml"), "--axes", "joint", "--units", "si"]) == 0
    out = capsys.readouterr().out
    words = " ".join(out.split())
    assert (
        "F_ij and M_ij are by link i on link j, in the joint's axes; moments about the joint's point on j"
        in words
    )
    assert "rod could spin between\n  ball joints: no spin" in out
    tables = [
        [line.split() for line in part.splitlines() if line.startswith(("C ", "rocker "))]
        for part in out.split("\n\n")
    ]
    force, moment, place, rates, *_ = [rows[0] for rows in tables if rows]
    r = da.dynamics(one)
    assert [float(x) for x in force[3:6]] == pytest.approx(r.reaction("C", axes="joint")[0], rel=1e-5)
    assert [float(x) for x in moment[3:6]] == pytest.approx(
        r.reaction_moment("C", axes="joint")[0], rel=1e-5, abs=1e-12
    )
    assert float(place[1]) == pytest.approx(0.6511, rel=1e-4)
    assert [float(x) for x in place[2:5]] == [-1, 0, 0]
    assert [float(x) for x in rates[1:4]] == pytest.approx(r.speed("rocker")[0], rel=1e-4, abs=1e-12)


def test_redundant_positions_are_printed_with_their_least_norm(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    still = {"drives.A.position": 0.5, "drives.A.speed": 0, "drives.A.acceleration": 0}
    door().with_values(still).save(tmp_path / "door.yaml")
    assert main(["solve", str(tmp_path / "door.yaml")]) == 1
    out = capsys.readouterr().out
    assert "5 redundant constraints among joints A, B" in out
    unique, least = out.split("Not unique; with the least sum of squares:")
    row = next(line for line in unique.splitlines() if line.startswith("B "))
    assert row.split()[3:] == ["-", "-", "-", "-"]
    row = next(line for line in least.splitlines() if line.startswith("B "))
    assert "-" not in row.split()[3:]


@every_axes
@pytest.mark.parametrize("method", ["matrix", "superposition", "virtual-work"])
def test_every_printed_answer_of_a_turn(axes: str, method: str, capsys: pytest.CaptureFixture[str]) -> None:
    asked = ["solve", str(examples()["rssr"]), "--axes", axes, "--method", method, "--positions", "8"]
    assert main(asked) == 0
    out = capsys.readouterr().out
    assert "effort O" in out
    assert not any(word == "nan" for word in out.split())


def test_in_the_plane_joints_have_no_axes(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", str(examples()["four_bar"]), "--axes", "joint"]) == 2
    assert "a planar joint has no local axes; use those of ground or of the link" in capsys.readouterr().err


def test_axis_and_angle_give_the_rotation() -> None:
    rng = np.random.default_rng(5)
    for angle in (0.0, 1e-12, 1e-5, 1.0, 3.0, np.pi - 1e-5, np.pi - 1e-9, np.pi):
        w = rng.normal(size=3)
        w *= angle / np.linalg.norm(w)
        found, axis = space.angle_and_axis(space.matrix(space.exp(w)))
        again = space.matrix(space.exp(found * np.array(axis)))
        assert again == pytest.approx(space.matrix(space.exp(w)), abs=3e-9)
