"""Mechanisms that run elsewhere: compiled by gcc and run by fmpy in another process, by a C program, and by Node."""

from __future__ import annotations

import io
import json
import math
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.errors import ModelError
from dalembert.interchange.file_formats import foreign_bytes
from dalembert.interchange.targets import forward_dynamics
from dalembert.interchange.targets.source_archive import sources_bytes
from dalembert.interchange.targets.source_fmu import fmu_bytes
from dalembert.interchange.targets.target_variables import kernel_of, target_function
from dalembert.model.drives.starting import Start

RUNNER = Path(__file__).parent / "run_fmu.py"
GCC, NODE = shutil.which("gcc"), shutil.which("node")


def run_fmu(content: bytes, folder: Path, rows: Any, version: str) -> dict[str, Any]:
    """Compiles a unit, validates its description, and runs rows or a motion in another process."""
    fmpy = pytest.importorskip("fmpy")
    if GCC is None:
        pytest.skip("no C compiler")
    from fmpy.validation import validate_fmu

    (folder / "x.fmu").write_bytes(content)
    assert validate_fmu(str(folder / "x.fmu")) == []
    with zipfile.ZipFile(folder / "x.fmu") as archive:
        archive.extractall(folder)
    include = Path(fmpy.__file__).parent / "c-code"
    name = fmpy.read_model_description(str(folder)).modelExchange.modelIdentifier
    place = fmpy.platform if version == "2.0" else fmpy.platform_tuple  # where fmpy looks for it
    library = folder / "binaries" / place / f"{name}.so"
    library.parent.mkdir(parents=True)
    source = folder / "sources" / f"fmi{version[0]}.c"
    options = ["-O2", "-shared", "-fPIC", f"-I{include}", "-o", str(library), str(source), "-lm"]
    subprocess.run([GCC, *options], check=True)
    command = [sys.executable, "-I", str(RUNNER), str(folder), str(library), version]
    ran = subprocess.run(command, input=json.dumps(rows), capture_output=True, text=True, check=True)
    return dict(json.loads(ran.stdout.splitlines()[-1]))


LATER = [
    pytest.param("rssr", "3.0", marks=pytest.mark.long),
    pytest.param("four_bar", "3.0", marks=pytest.mark.long),
]


def expected(m: da.Mechanism, drive: str, row: dict[str, float]) -> dict[str, float]:
    """Every number of dynamics at one position."""
    values = {f"drives.{drive}.{key}": row[f"drive.{drive}.{key}"] for key in ("speed", "acceleration")}
    r = da.dynamics(m.with_values(values), positions=[row[f"drive.{drive}.position"]])
    out = {f"effort.{drive}": float(r.effort(drive)[0])}
    for joint in m.joints:
        force = r.reaction(joint)[0]
        out |= {f"reaction.{joint}.{letter}": float(x) for letter, x in zip("xyz", force, strict=False)}
    return out


@pytest.mark.parametrize(("name", "version"), [("four_bar", "2.0"), *LATER])
def test_a_unit_gives_the_numbers_of_dynamics_at_the_same_instant(
    name: str, version: str, tmp_path: Path
) -> None:
    m = da.load(examples()[name])
    drive = next(iter(m.drives))
    rng = np.random.default_rng(7)
    rows = [
        {
            f"drive.{drive}.{key}": float(x)
            for key, x in zip(("position", "speed", "acceleration"), values, strict=True)
        }
        for values in rng.uniform((0, -30, -100), (6.28, 30, 100), (6, 3))
    ]
    found = run_fmu(fmu_bytes(kernel_of(m), version), tmp_path, rows, version)
    assert found["alone"]
    assert found["status"] == [0] * 6
    for row, answer in zip(rows, found["answers"], strict=True):
        given = dict(zip(found["outputs"], answer, strict=True))
        right = expected(m, drive, row)
        size = max(map(abs, right.values()))
        assert max(abs(right[key] - given[key]) for key in right if key in given) < 1e-12 * size
        assert len(right.keys() & given.keys()) > 8
    assert found["units"][f"effort.{drive}"] == "N*m"
    assert found["units"][f"drive.{drive}.position"] == "rad"
    if name == "four_bar":
        unit, factor = found["shown"]["effort.O2"]
        assert (unit, 27.482157605 * factor) == ("lbf*in", pytest.approx(243.2375907612))
        assert found["shown"]["drive.O2.position"] == ["deg", pytest.approx(180 / math.pi)]


@pytest.mark.parametrize(
    ("name", "version"),
    [
        ("four_bar", "3.0"),
        pytest.param("excavator", "2.0", marks=pytest.mark.long),
        pytest.param("rssr", "2.0", marks=pytest.mark.long),
    ],
)
def test_accelerations_of_a_unit_with_states_need_the_efforts_that_were_given(
    name: str, version: str, tmp_path: Path
) -> None:
    """Inverse dynamics of each random state and effort, along the acceleration that the unit finds."""
    m = da.load(examples()[name])
    rng, (start,), drives = np.random.default_rng(8), m.schedule().position[:1], list(m.drives)
    rows = []
    for _ in range(4):
        q, u = start * (1 + 0.1 * rng.uniform(-1, 1, len(drives))), rng.uniform(-5, 5, len(drives))
        state = {"position": q, "speed": u, "effort": rng.uniform(-100, 100, len(drives))}
        rows.append(
            {f"drive.{d}.{what}": float(x[i]) for what, x in state.items() for i, d in enumerate(drives)}
        )
    content, _ = foreign_bytes(m, "x.fmu", version, forward=True)
    found = run_fmu(content, tmp_path, rows, version)
    assert found["alone"]
    assert found["status"] == [0] * len(rows)
    lawless = {"law": None, "position": 0.0, "speed": 1.0, "acceleration": 1.0}
    m = m.model_copy(update={"drives": {n: d.model_copy(update=lawless) for n, d in m.drives.items()}})
    for row, answer in zip(rows, found["answers"], strict=True):
        of = dict(zip(found["outputs"], answer, strict=True)) | row
        rates = {
            f"drives.{d}.{what}": of[f"drive.{d}.{what}"]
            for d in drives
            for what in ("speed", "acceleration")
        }
        r = da.dynamics(m.with_values(rates), positions=[[of[f"drive.{d}.position"] for d in drives]])
        size = max(float(np.abs(r.reaction(joint)).max()) for joint in m.joints)
        gap = max(abs(float(r.effort(d)[0]) - of[f"drive.{d}.effort"]) for d in drives)
        assert gap < 1e-12 * max(size, np.abs(r.effort_array).max())


@pytest.mark.parametrize("version", ["2.0", pytest.param("3.0", marks=pytest.mark.long)])
def test_a_unit_with_states_moves_as_simulate_does(version: str, tmp_path: Path) -> None:
    m = da.slider_crank(crank=0.05, rod=0.2)
    m = m.model_copy(update={"start": {"O2": Start(0.5, 20.0)}})
    s = da.simulate(m, until="0.5 s", count=51)
    content, lost = foreign_bytes(m, "x.fmu", version, forward=True)
    motion = {"kind": "CoSimulation", "until": 0.5, "count": 51, "tolerance": 1e-12}
    found = run_fmu(content, tmp_path, motion, version)
    assert lost == []
    for key in ("position", "speed"):
        ours = getattr(s.schedule, key)[:, 0]
        assert np.abs(np.array(found[f"drive.O2.{key}"]) - ours).max() < 1e-8 * np.abs(ours).max()
    force = s.result.reaction("A")
    assert np.abs(np.array(found["reaction.A.x"]) - force[:, 0]).max() < 1e-6 * np.abs(force).max()


@pytest.mark.long
def test_a_position_that_does_not_close_has_nan_and_its_status(tmp_path: Path) -> None:
    m = da.four_bar(ground=0.5, crank=0.4, coupler=0.2, rocker=0.3, sweep=(0.2, 1.0))
    rows = [{"drive.O2.position": x} for x in (0.4, math.pi, 0.4)]
    found = run_fmu(fmu_bytes(da.compile(m, ["links.coupler.mass"])), tmp_path, rows, "2.0")
    assert found["status"][1] == 1
    assert all(map(math.isnan, found["answers"][1]))
    assert found["answers"][0] == found["answers"][2]


def test_a_slide_is_a_length_and_its_effort_a_force() -> None:
    content, lost = foreign_bytes(da.load(examples()["bucket"]), "x.fmu")
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        text = archive.read("modelDescription.xml").decode()
    position, effort = (
        text.index(f'name="{name}"') for name in ("drive.cylinder.position", "effort.cylinder")
    )
    assert '<Real unit="m" ' in text[position : position + 200]
    assert '<Real unit="N"/>' in text[effort : effort + 250]
    bases = dict(re.findall(r'<Unit name="([^"]+)">\s*<BaseUnit ([^/]*?)/>', text))
    assert (bases["m"].strip(), bases["N"].strip()) == ('m="1"', 'm="1" kg="1" s="-2"')
    assert lost == ["the motion: position, speed and acceleration of the drives are inputs"]
    assert content == foreign_bytes(da.load(examples()["bucket"]), "x.fmu")[0]


@pytest.mark.long
def test_the_version_is_chosen_on_the_command_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for version, argument in (("2.0", []), ("3.0", ["--fmi", "3.0"])):
        out = tmp_path / f"{version}.fmu"
        assert main(["convert", str(examples()["four_bar"]), str(out), *argument]) == 0
        with zipfile.ZipFile(out) as archive:
            assert f'fmiVersion="{version}"' in archive.read("modelDescription.xml").decode()
    assert main(["convert", str(examples()["four_bar"]), str(tmp_path / "x.sdf"), "--fmi", "3.0"]) == 2
    assert "fmi 3.0 is for a file .fmu, not " in capsys.readouterr().err
    assert not (tmp_path / "x.sdf").exists()


@pytest.mark.long
def test_what_only_python_computes_is_refused() -> None:
    with pytest.raises(ModelError, match=r"FMI 1\.0 is not written; use 2\.0 or 3\.0"):
        fmu_bytes(da.compile(da.four_bar(), ["links.coupler.mass"]), "1.0")
    with pytest.raises(ModelError, match="is computed outside the program"):
        foreign_bytes(da.load(examples()["cam_and_follower"]), "x.fmu")
    rough = da.slider_crank().with_values({"joints.B.friction": {"coefficient": 0.1, "radius": "10 mm"}})
    with pytest.raises(ModelError, match="has no dry friction"):
        foreign_bytes(rough, "x.fmu", forward=True)
    m = da.load(examples()["excavator"])
    m = m.model_copy(update={"start": {"boom_cylinder": Start(*m.schedule().position[0, :1])}})
    with pytest.raises(
        ModelError, match="forces move drive 'boom_cylinder', but drive 'stick_cylinder' is presc"
    ):
        foreign_bytes(m, "x.fmu", forward=True)


def unpacked(m: da.Mechanism, folder: Path) -> Path:
    """The sources of a mechanism in a folder."""
    with zipfile.ZipFile(io.BytesIO(sources_bytes(kernel_of(m)))) as archive:
        archive.extractall(folder)
        return folder / next(name for name in archive.namelist() if name.endswith(".mjs"))


def test_components_of_a_vector_have_letters() -> None:
    arm = """
space: space
links: {ground: {points: {O: [0, 0, 0]}}, arm: {points: {O: [0, 0, 0]}, mass: 1, center: [1, 0, 0]}}
joints: {O: {type: revolute, links: [ground, arm], axis: [0, 0, 1]}}
drives: {O: {position: 0}}
"""
    k = da.compile(da.loads(arm), [], ["reaction.O", "effort.O"])
    named = [(v.name, v.unit) for v in target_function(k, "arm").outputs]
    assert named == [*((f"reaction.O.{letter}", "N") for letter in "xyz"), ("effort.O", "N*m")]


def test_c_sources_build_by_make_and_print_the_first_position(tmp_path: Path) -> None:
    if GCC is None or shutil.which("make") is None:
        pytest.skip("no C compiler")
    m = da.load(examples()["four_bar"])
    types = unpacked(m, tmp_path).with_suffix(".d.mts").read_text(encoding="utf-8")
    assert 'export type NumberName = "drives.O2.speed" | "drives.O2.acceleration";' in types
    assert 'export type OutputName = "effort.O2" | "reaction.O2.0" | ' in types
    subprocess.run(["make", "-s", "CFLAGS=-O2 -std=c99 -Wall -Werror"], cwd=tmp_path, check=True)
    ran = subprocess.run([str(tmp_path / "example")], capture_output=True, text=True, check=True)
    head, first, *_ = ran.stdout.splitlines()
    assert head == "status 0"
    assert first.endswith("effort.O2 N*m")
    assert float(first.split()[0]) == pytest.approx(float(da.dynamics(m).effort("O2")[0]), rel=1e-13)


SCRIPT = """
import { load, channels, numbers } from "%s";
const solve = await load();
const rows = Array.from({ length: 300 }, (_, k) => [(2 * Math.PI * k) / 300]);
const answer = solve(rows, { "drives.O2.speed": 10 });
let refused = "";
try { solve(rows, { nothing: 1 }); } catch (error) { refused = error.message; }
const found = { channels, numbers, refused, status: [...answer.status], effort: [...answer["effort.O2"]] };
console.log(JSON.stringify(found));
"""


def test_the_loader_runs_in_node(tmp_path: Path) -> None:
    if NODE is None:
        pytest.skip("no Node")
    m = da.load(examples()["four_bar"])
    module = unpacked(m, tmp_path)
    (tmp_path / "run.mjs").write_text(SCRIPT % f"./{module.name}", encoding="utf-8")
    ran = subprocess.run([NODE, str(tmp_path / "run.mjs")], capture_output=True, text=True, check=True)
    found = json.loads(ran.stdout)
    assert found["channels"] == ["position O2"]
    assert found["refused"].startswith("unknown number nothing; use drives.O2.speed")
    r = da.dynamics(
        m.with_values({"drives.O2.speed": 10.0}), positions=list(np.arange(300) * 2 * np.pi / 300)
    )
    ours = r.effort("O2")
    assert found["status"] == [0] * 300
    assert np.abs(np.array(found["effort"]) - ours).max() < 1e-12 * np.abs(ours).max()


def test_the_drives_of_a_program_that_forces_move_are_without_brakes_and_motors() -> None:
    m = da.four_bar().with_values(
        {"drives.O2.brake": "5 N*m", "drives.O2.effort": 2.0, "drives.O2.position": 0.3}
    )
    (drive,) = forward_dynamics._steady(m).values()
    assert (drive.brake, drive.speed, drive.acceleration, drive.effort) == (0.0, 1.0, 0.0, None)
    assert (drive.motor, drive.position) == (None, 0.3)
