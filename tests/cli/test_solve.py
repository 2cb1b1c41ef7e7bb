"""`dalembert solve`: what it prints, in which units, and what it writes."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.cli.conftest import Run

ONE_POSITION = """\
Four-bar linkage, dynamic
Norton, Design of Machinery, example 11-3
Assumptions: gravity none, inertia on (D'Alembert), friction off
Mobility 1, driven by 1 drive, no redundant constraint

drive  position     speed  acceleration           effort
--------------------------------------------------------
O2       60 deg  25 rad/s   -40 rad/s^2  243.2376 lbf*in

joint  by i     on j       F_ij x    F_ij y   |F_ij|  direction  moment
                              lbf       lbf      lbf        deg  lbf*in
-----------------------------------------------------------------------
O2     ground   crank     -117.56  -107.459  159.272    -137.57       0
A      crank    coupler  -118.026  -100.172  154.805   -139.678       0
B      coupler  rocker    1.30956  -87.4015  87.4113   -89.1416       0
O4     ground   rocker   -20.2378   77.6581  80.2518    104.606       0
F_ij is the force by link i on link j, in ground axes; moments about the joint's
point on j.

link      angle  ang. speed  ang. acc.  center x  center y   acc. x   acc. y
            deg       rad/s    rad/s^2        in        in   in/s^2   in/s^2
----------------------------------------------------------------------------
crank        60          25        -40         0         3      120    -1875
coupler  20.917     -5.8694      120.9    6.1725    12.547  -2509.2  -2645.4
rocker   104.41      7.9316     276.29    17.756    4.8427  -1259.7  -648.44
The acceleration is that of the mass center.
"""


def test_one_position(run: Run) -> None:
    ran = run("solve", "four_bar.yaml")
    assert ran.status == 0
    assert ran.err == ""
    assert ran.out.startswith(ONE_POSITION)
    assert ran.out.splitlines()[-1].startswith("Residual ")
    assert "power balance" in ran.out.splitlines()[-1]
    assert max(map(len, ran.out.splitlines())) <= 80


def test_units_and_axes_are_said(run: Run) -> None:
    printed = run("solve", "four_bar.yaml", "--units", "si", "--axes", "link").out
    assert "27.48216 N*m" in printed
    assert "in the axes of link j" in printed
    assert " lbf" not in printed


def test_static_leaves_inertia_out(run: Run) -> None:
    printed = run("solve", "four_bar.yaml", "--static").out
    assert "inertia off (static)" in printed
    assert "243.2376" not in printed


def test_many_positions_are_summed_up(run: Run) -> None:
    printed = run("solve", "four_bar.yaml", "--positions", "36").out
    assert "12 of 36 positions are shown; --all prints every one, --csv FILE writes them." in printed
    assert "over the positions  unit    largest       at  smallest       at" in printed
    assert printed.splitlines()[-1].startswith("36 of 36 positions solved, residual ")
    every = run("solve", "four_bar.yaml", "--positions", "36", "--all").out
    assert sum(line[:1].isdigit() for line in every.splitlines()) == 37


def test_positions_that_do_not_close_are_named(run: Run, edited: Callable[..., str]) -> None:
    file = edited(
        ("A: [5, 0]", "A: [12, 0]"), ("position: 60 deg", "position: {from: 60, to: 300, count: 13}")
    )
    ran = run("solve", file)
    assert ran.status == 1
    assert ran.err == ""
    assert "not_assembled: position" in ran.out
    assert "The linkage does not close" in ran.out.replace("\n  ", " ")
    answer = json.loads(run("solve", file, "--json", "-").out)
    open_ = [p for p in answer["positions"] if p["status"] != "ok"]
    assert open_
    for position in open_:
        assert position["status"] == "not_assembled"
        assert position["reason"].startswith("The linkage does not close")
        assert position["effort"] == {"O2": None}
        assert position["reaction"]["A"] == [None, None]
        assert position["angle"]["rocker"]["value"] is None
        assert position["drive"]["O2"]["value"] is not None


def test_json_is_the_contract(run: Run) -> None:
    ran = run("solve", "four_bar.yaml", "--json", "-")
    answer = json.loads(ran.out)
    assert ran.status == 0
    assert {"dalembert", "title", "units", "friction", "positions"} <= set(answer)
    assert (answer["dalembert"], answer["units"], answer["friction"]) == (2, "SI", False)
    (position,) = answer["positions"]
    words = {"drive", "effort", "power", "reaction", "reaction_moment", "turn", "angle", "point"}
    assert set(position) == {"status", *words, "residual", "power_balance"}
    assert position["drive"]["O2"] == {"value": math.pi / 3, "speed": 25.0, "acceleration": -40.0}
    assert position["status"] == "ok"
    assert position["effort"]["O2"] == pytest.approx(27.4821576052, rel=1e-10)
    assert (
        set(position["reaction"]) == set(position["turn"]) == set(answer["joints"]) == {"O2", "A", "B", "O4"}
    )
    assert answer["joints"]["A"] == {"by": "crank", "on": "coupler"}
    assert position["reaction_moment"]["A"] == 0.0
    assert position["reaction"]["A"] == pytest.approx([-525.00541990866, -445.58839936385], rel=1e-10)
    assert set(position["point"]) == set(position["angle"]) == {"crank", "coupler", "rocker"}
    coupler, center = position["angle"]["coupler"], position["point"]["coupler"]["center"]
    assert set(coupler) == set(position["turn"]["B"]) == {"value", "speed", "acceleration"}
    assert coupler["value"] == pytest.approx(0.36507444430057, rel=1e-10)
    assert position["turn"]["A"]["speed"] == pytest.approx(coupler["speed"] - 25, rel=1e-12)
    assert center["acceleration"] == pytest.approx([-63.7329854218, -67.1929541341], rel=1e-10)
    assert abs(position["residual"]) < 1e-12
    assert abs(position["power_balance"]) < 1e-12


def test_json_in_the_units_of_the_file(run: Run) -> None:
    answer = json.loads(run("solve", "four_bar.yaml", "--json", "-", "--units", "file").out)
    assert answer["units"]["moment"] == "lbf*in"
    assert answer["units"]["angular_speed"] == "deg/s"
    (position,) = answer["positions"]
    assert position["effort"]["O2"] == pytest.approx(243.2375907612, rel=1e-10)
    assert position["drive"]["O2"]["value"] == pytest.approx(60, rel=1e-14)
    assert position["drive"]["O2"]["speed"] == pytest.approx(math.degrees(25), rel=1e-14)
    assert position["reaction"]["A"] == pytest.approx([-118.0259135713, -100.1722571185], rel=1e-10)
    assert position["point"]["coupler"]["center"]["acceleration"] == pytest.approx(
        [-2509.172654401, -2645.391895043]
    )


def test_json_in_link_axes(run: Run) -> None:
    ground = json.loads(run("solve", "four_bar.yaml", "--json", "-").out)["positions"][0]
    link = json.loads(run("solve", "four_bar.yaml", "--json", "-", "--axes", "link").out)["positions"][0]
    turn = ground["angle"]["coupler"]["value"]
    x, y = ground["reaction"]["A"]
    local = [math.cos(turn) * x + math.sin(turn) * y, math.cos(turn) * y - math.sin(turn) * x]
    assert link["reaction"]["A"] == pytest.approx(local, rel=1e-12)
    assert (link["angle"], link["point"]) == (ground["angle"], ground["point"])


def test_redundant_reactions_have_their_least_norm_beside(run: Run, folder: Path) -> None:
    (folder / "beam.yaml").write_text(
        """
links:
  ground: {points: {A: [0, 0], B: [2, 0]}}
  beam: {points: {A: [0, 0], B: [2, 0], P: [1, 0]}}
joints:
  A: {type: pin, links: [ground, beam]}
  B: {type: pin, links: [ground, beam]}
loads:
  F: {type: force, on: beam, at: P, value: [10, -100]}
""",
        encoding="utf-8",
    )
    ran = run("solve", "beam.yaml", "--json", "-")
    assert ran.status == 1
    (position,) = json.loads(ran.out)["positions"]
    assert position["status"] == "redundant"
    assert "A, B" in position["reason"]
    assert position["reaction"]["A"] == [None, pytest.approx(50)]
    assert position["least_norm"]["reaction"]["A"] == pytest.approx([-5, 50])
    assert position["least_norm"]["reaction_moment"]["A"] == 0
    printed = run("solve", "beam.yaml").out
    assert "redundant: 1 constraint is redundant among joints A, B" in printed
    assert "Not unique; with the least sum of squares:" in printed
    welded = (folder / "beam.yaml").read_text(encoding="utf-8").replace("B: {type: pin", "B: {type: weld")
    (folder / "welded.yaml").write_text(welded, encoding="utf-8")
    assert "2 constraints are redundant among joints A, B:" in run("solve", "welded.yaml").out


def test_csv(run: Run, folder: Path) -> None:
    ran = run("solve", "four_bar.yaml", "--positions", "5", "--csv", "turn.csv")
    assert ran.err == "Written: turn.csv\n"
    with (folder / "turn.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["position"] for row in rows] == ["1", "2", "3", "4", "5"]
    assert float(rows[0]["effort.O2 [lbf*in]"]) == pytest.approx(
        27.4821576052 / 0.1129848290276167, rel=1e-10
    )
    assert float(rows[0]["reaction.A.x [lbf]"]) == pytest.approx(
        -525.00541990866 / 4.4482216152605, rel=1e-10
    )
    printed = run("solve", "four_bar.yaml", "--csv", "-", "--units", "file").out
    assert printed.splitlines()[0].startswith("position,status,drive.O2 [deg],drive.O2.speed [deg/s]")
    assert len(printed.splitlines()) == 2


def test_workbook(run: Run, folder: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    run("solve", "four_bar.yaml", "--positions", "3", "--xlsx", "turn.xlsx")
    book = openpyxl.load_workbook(folder / "turn.xlsx", read_only=True)
    first, *rows = list(book["positions"].values)
    assert len(rows) == 3
    assert rows[0][first.index("effort.O2 [lbf*in]")] == pytest.approx(243.2375907, rel=1e-9)
    assert ("inertia", "on (D'Alembert)") in list(book["about"].values)
    book.close()


def test_netcdf(run: Run, folder: Path) -> None:
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    run("solve", "four_bar.yaml", "--positions", "3", "--netcdf", "turn.nc")
    with xarray.open_dataset(folder / "turn.nc", engine="h5netcdf") as data:
        assert data.reaction.dims == ("position", "joint", "component")
        assert data.reaction.attrs["units"] == "N"
        assert data.effort.attrs["units"] == "N*m"
        assert float(data.effort.sel(position=1, drive_name="O2")) == pytest.approx(27.4821576052, rel=1e-10)
        assert list(data.reaction_on.values) == ["crank", "coupler", "rocker", "rocker"]


def test_files_are_never_overwritten_unless_told(run: Run, folder: Path) -> None:
    (folder / "out.json").write_text("mine", encoding="utf-8")
    ran = run("solve", "four_bar.yaml", "--json", "out.json")
    assert ran == (
        2,
        "",
        "out.json exists; name another file, or overwrite it: --force, in Python overwrite=True\n",
    )
    assert (folder / "out.json").read_text(encoding="utf-8") == "mine"
    assert run("solve", "four_bar.yaml", "--json", "out.json", "--force").status == 0
    assert json.loads((folder / "out.json").read_text(encoding="utf-8"))["dalembert"] == 2
    assert sorted(path.name for path in folder.iterdir()) == ["four_bar.yaml", "out.json"]


def test_a_folder_that_is_not_there(run: Run) -> None:
    ran = run("solve", "four_bar.yaml", "--csv", "nowhere/out.csv")
    assert ran == (
        2,
        "",
        "cannot write nowhere/out.csv: folder nowhere does not exist; create it, or name another\n",
    )


def test_equilibrium_positions(run: Run, edited: Callable[..., str]) -> None:
    file = edited(
        ("position: 60 deg, speed: 25 rad/s, acceleration: -40 rad/s^2", "position: unknown, effort: 50")
    )
    ran = run("solve", file)
    assert "stability" in ran.out
    answer = json.loads(run("solve", file, "--json", "-").out)
    assert {p["stability"] for p in answer["positions"]} <= {"stable", "unstable", "neutral"}
    assert all(p["effort"]["O2"] == pytest.approx(50 * 0.1129848290276167) for p in answer["positions"])


JAMS = """\
links: {ground: {points: {A: [0, 0]}}, block: {points: {A: [0, 0]}}}
joints: {A: {type: slider, links: [ground, block], friction: {coefficient: 1.2}}}
drives: {A: {position: [0, 1], speed: [1, -1], effort: 0}}
loads:
  Q: {type: force, on: block, at: A, value: [-100, 0]}
  rod: {type: force, on: block, at: A, value: unknown, direction: 45}
"""


def test_a_drawing_says_which_positions_are_not_ok(run: Run, folder: Path) -> None:
    """The picture is of the first position that is, so that the others have to be named."""
    (folder / "jams.yaml").write_text(
        f"dalembert: 1\nunits: {{length: m, angle: deg}}\n{JAMS}", encoding="utf-8"
    )
    ran = run("draw", "jams.yaml", "-o", "jams.svg")
    assert ran.status == 1
    assert ran.err.startswith("Written: jams.svg\njammed: position 1: Friction jams the mechanism at A = 0 m")


PRESS = """\
dalembert: 1
space: space
links:
  ground: {points: {N: [0, 0, 0.3], G: [0.1, 0, 0]}}
  spindle: {points: {N: [0, 0, 0], K: [0, 0, -0.2]}}
  ram: {points: {K: [0, 0, 0], G: [0.1, 0, -0.1]}}
joints:
  N: {type: screw, links: [ground, spindle], axis: [0, 0, 1], lead: 7 mm, friction: {coefficient: 0.12, radius: 18 mm}}
  K:
    {type: revolute, links: [spindle, ram], axis: [0, 0, 1],
     friction: {coefficient: 0.1, radius: 10 mm, thrust_radius: 15 mm}}
  G: {type: prismatic, links: [ground, ram], axis: [0, 0, 1]}
drives: {N: {freedom: turn, position: 0, speed: -1 rad/s}}
loads: {F: {type: force, on: ram, at: K, value: [0, 0, 20 kN]}}
"""


def test_friction_of_redundant_joints_points_to_stiffness(run: Run, folder: Path) -> None:
    """Nothing is known, so nothing stands under the least-norm heading; with stiffness all is, and named."""
    (folder / "press.yaml").write_text(PRESS, encoding="utf-8")
    ran = run("solve", "press.yaml")
    assert ran.status == 1
    assert "least sum of squares" not in ran.out
    assert "give the joints a stiffness" in " ".join(ran.out.split())
    stiff = PRESS.replace(
        "axis: [0, 0, 1]", "axis: [0, 0, 1], stiffness: {force: 100 kN/mm, moment: 100 kN*m/rad}"
    )
    (folder / "press.yaml").write_text(stiff, encoding="utf-8")
    ran = run("solve", "press.yaml")
    assert ran.status == 0
    assert "mu 0.12, thread 0.018 m" in ran.out  # in the units of the file
    assert "collar 0.015 m" in ran.out
    assert "where the load moves the drive (0 or less: self-locking)" in " ".join(ran.out.split())
