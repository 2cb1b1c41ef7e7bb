"""`--set`: other values of parameters and of any number, on every command that reads a model file."""

from __future__ import annotations

import json
import math
import shutil
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from tests.cli.conftest import Run


@pytest.fixture(autouse=True)
def _pump(folder: Path) -> None:
    shutil.copy(examples()["pump"], folder / "pump.yaml")
    task = "model: pump.yaml\nvary: {bore: [40 mm, 60 mm]}\n"
    (folder / "task.yaml").write_text(f"{task}least: peak effort.O\nstarts: 1\n", encoding="utf-8")
    study = task.replace("[40 mm, 60 mm]", "± 1 %")
    (folder / "study.yaml").write_text(f"{study}outputs: [effort.O]\ndesigns: 4\n", encoding="utf-8")


def test_solve_with_other_values(run: Run) -> None:
    ran = run("solve", "pump.yaml", "--set", "stroke=80mm", "--set", "links.rod.mass = 2 kg", "--json", "-")
    efforts = [p["effort"]["O"] for p in json.loads(ran.out)["positions"]]
    m = da.load("pump.yaml").with_values({"stroke": 0.08, "links.rod.mass": 2.0})
    assert efforts == pytest.approx(da.dynamics(m).effort("O").tolist(), abs=1e-9)
    assert math.dist(*m.links["crank"].points.values()) == pytest.approx(0.04)


def test_a_parameter_that_nothing_uses_is_a_note_and_is_kept(run: Run, folder: Path) -> None:
    text = (
        (folder / "pump.yaml")
        .read_text(encoding="utf-8")
        .replace("parameters:\n", "parameters:\n  spare: 5 N\n")
    )
    (folder / "pump.yaml").write_text(text, encoding="utf-8")
    line = text.splitlines().index("  spare: 5 N") + 1
    ran = run("solve", "pump.yaml", "--set", "stroke=80mm", "--set", "spare=6N")
    assert ran.status == 0
    assert ran.err.startswith(f"pump.yaml:{line}: note: nothing in the file uses the parameter 'spare'")
    assert da.load("pump.yaml").with_values({"stroke": 0.08}).parameters["spare"].value == 5.0


@pytest.mark.parametrize("target", ["out.toml", "out.yaml"])
def test_convert_keeps_parameters(run: Run, target: str) -> None:
    assert run("convert", "pump.yaml", "-o", target, "--set", "ratio=5").status == 0
    assert da.load(target) == da.load("pump.yaml").with_values({"ratio": 5})


@pytest.mark.parametrize(
    "command",
    [
        ["draw", "pump.yaml", "-o", "pump.svg", "--view", "mechanism"],
        ["report", "pump.yaml", "-o", "pump.txt", "--at", "60deg"],
        ["check", "pump.yaml"],
        ["shake", "pump.yaml"],
        ["optimize", "task.yaml"],
        ["study", "run", "study.yaml"],
    ],
)
def test_every_command_that_reads_a_file(run: Run, command: list[str]) -> None:
    ran = run(*command, "--set", "densty=1 kg/m^3")
    assert ran.status == 2
    assert "--set densty=1 kg/m^3: unknown parameter 'densty'; did you mean 'density'?" in ran.err
    assert run(*command, "--set", "density=7850 kg/m^3").status == 0


def test_the_report_gives_the_parameters(run: Run, folder: Path) -> None:
    run("report", "pump.yaml", "-o", "pump.txt", "--at", "60deg", "--method", "matrix", "--set", "bore=60mm")
    lines = (folder / "pump.txt").read_text(encoding="utf-8").splitlines()
    rows = [line.split("  ") for line in lines if line.startswith(("bore ", "area ", "density "))]
    assert [[cell.strip() for cell in row if cell] for row in rows] == [
        ["bore", "60 mm", "diameter of the piston"],
        ["density", "7850 kg/m³", "–"],
        ["area", "pi*bore^2/4 = 2827 mm²", "–"],
    ]


@pytest.mark.parametrize(
    ("setting", "says"),
    [
        ("stroke=2 kg", "--set stroke=2 kg: parameter 'stroke': '2 kg' is a mass, but a length is needed"),
        ("stroke", "--set stroke has no value; write NAME=VALUE, for example --set r=50mm"),
        ("links.rod.mas=2", "--set links.rod.mas=2: path 'links.rod.mas': 'mas' does not exist in links.rod"),
        ("density=-1", "--set density=-1: links.rod: mass: "),
    ],
)
def test_a_wrong_setting_is_told(run: Run, setting: str, says: str) -> None:
    ran = run("solve", "pump.yaml", "--set", setting)
    assert (ran.status, ran.err[: len(says)]) == (2, says)


@pytest.mark.long
def test_a_force_system_and_a_key_with_other_values(run: Run, folder: Path) -> None:
    plate = "forces: {F: {value: 600 @ 90, at: A}}\npoints: {A: [1, 0]}\n"
    (folder / "plate.yaml").write_text(plate, encoding="utf-8")
    ran = run(
        "wrench", "plate.yaml", "--set", "forces.F.value=800 @ 90", "--set", "points.A.0=2", "--json", "-"
    )
    assert json.loads(ran.out)["system"]["moment_at_origin"] == pytest.approx(1600.0)
    assert "the file has no 'forces.G'" in run("wrench", "plate.yaml", "--set", "forces.G=3").err
    (folder / "class").mkdir()
    m = da.load(examples()["pump"]).with_values({"stroke": 0.08})
    r = da.solve(m)
    effort = float(np.interp(math.radians(60), r.drive_position("O"), r.effort("O")))
    (folder / "class" / "ann.yaml").write_text(f"efforts: {{O: {effort} N*m}}", encoding="utf-8")
    for options, right in ((["--set", "stroke=80mm"], True), ([], False)):
        marks = json.loads(run("grade", "class", "--key", "pump.yaml", *options, "--json", "-").out)
        assert (marks["rows"][0]["outcome"] == "right") == right
    (folder / "key.csv").write_text("quantity,of,value\n", encoding="utf-8")
    assert "key.csv is a table" in run("grade", "class", "--key", "key.csv", "--no-friction").err
