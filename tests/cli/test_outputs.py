"""What answers are written to: the same options in the same words in every command, checked before the work."""

from __future__ import annotations

import dataclasses
import inspect
import json
from pathlib import Path
from typing import Any, get_args, get_type_hints

import pytest
from cyclopts import App

import dalembert as da
from dalembert.cli import answer_files
from dalembert.cli.app import MODULES, _command
from dalembert.wrench import System
from tests.answers.every_answer import made
from tests.cli.conftest import Run

SHARED = {
    *("json", "csv", "xlsx", "netcdf", "drawing", "report", "units", "axes", "theme", "figures", "force"),
    *("static", "set", "no_friction", "positions", "at"),
}
"""Options that mean the same wherever they are."""
DIFFERENT = {("report", "axes")}
"""The notation of a worked solution has no axes of joints."""
ANSWERS: dict[str, tuple[str, ...]] = {
    "solve": ("Result",),
    "shake": ("Shaking",),
    "flywheel": ("Flywheel",),
    "members": ("MemberTable",),
    "bearings": ("BearingTable",),
    "motor": ("MotorChoice",),
    "simulate": ("Simulation",),
    "balance": ("Balance", "RotorBalance"),
    "optimize": ("Optimum",),
    "study show": ("StudyResult",),
    "grade": ("ClassMarks",),
    "wrench": ("System",),
    "cam": ("CamDesign",),
    "pins": ("PinTable",),
    "shaft": ("CriticalSpeeds",),
}
"""Command -> classes of its answers."""


def commands() -> dict[str, Any]:
    """Functions of all commands, those within `study` too."""
    found = {}
    for name in MODULES:
        _, command = _command(name)
        if isinstance(command, App):
            parts = [part for part in command if not part.startswith("-")]
            found |= {f"{name} {part}": command[part].default_command for part in parts}
        else:
            found[name] = command
    return found


def options(function: Any) -> dict[str, tuple[Any, ...]]:
    """Name of an option -> its type and its sentence."""
    out: dict[str, tuple[Any, ...]] = {}
    hints = get_type_hints(function, include_extras=True)
    for name in inspect.signature(function).parameters:
        if dataclasses.is_dataclass(hints[name]):
            named = get_type_hints(hints[name], include_extras=True)
            out |= {f.name: _said(named[f.name]) for f in dataclasses.fields(hints[name])}
        else:
            out[name] = _said(hints[name])
    return out


def _said(hint: Any) -> tuple[Any, ...]:
    parts = get_args(hint)
    return (str(parts[0]), parts[-1].help) if parts and hasattr(parts[-1], "help") else (str(hint),)


def test_an_option_means_the_same_in_every_command() -> None:
    said: dict[str, dict[tuple[Any, ...], list[str]]] = {}
    for command, function in commands().items():
        for name, what in options(function).items():
            if name in SHARED and (command, name) not in DIFFERENT:
                said.setdefault(name, {}).setdefault(what, []).append(command)
    assert set(said) == SHARED
    assert {name: found for name, found in said.items() if len(found) > 1} == {}
    assert set(said["json"][next(iter(said["json"]))]) - {"validate"} == set(ANSWERS)


@pytest.mark.parametrize("command", ANSWERS)
def test_a_command_has_the_options_of_its_answer(command: str) -> None:
    has = set(options(commands()[command])) | {"model"}
    endings = {
        ".json": "json",
        ".csv": "csv",
        ".xlsx": "xlsx",
        ".nc": "netcdf",
        ".svg": "drawing",
        ".txt": "report",
    }
    for name in ANSWERS[command]:
        writers = made(name).writers()
        assert {option for ending, option in endings.items() if ending in writers} == has & set(
            endings.values()
        )


@pytest.mark.long
def test_o_writes_what_the_ending_selects(run: Run, folder: Path) -> None:
    for ending in ("json", "csv", "xlsx", "nc", "svg", "txt"):
        assert run("solve", "four_bar.yaml", "-o", f"a.{ending}").status == 0
        kind = {"nc": "netcdf", "svg": "drawing", "txt": "report"}.get(ending, ending)
        assert run("solve", "four_bar.yaml", f"--{kind}", f"b.{ending}").status == 0
        if ending not in ("xlsx", "nc"):  # which have times in them
            assert Path(f"a.{ending}").read_bytes() == Path(f"b.{ending}").read_bytes()
    assert run("balance", "four_bar.yaml", "--on", "crank", "-o", "c.yaml").status == 0
    assert da.load("c.yaml").mass("crank") != da.load("four_bar.yaml").mass("crank")
    refused = run("solve", "four_bar.yaml", "-o", "a.yaml")
    assert refused.status == 2
    assert refused.err.startswith(
        "--output a.yaml: this answer cannot be written in this format; use one of .json .csv"
    )


def test_what_cannot_be_written_is_refused_before_the_work(
    run: Run, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(answer_files.Outputs, "deliver", None)
    for option, path, message in (
        (
            "--drawing",
            "a.foo",
            "--drawing a.foo: the ending names no kind of drawing; use one of .svg .pdf .png .dxf",
        ),
        (
            "--report",
            "a.svg",
            "--report a.svg: the ending names no kind of report; use one of .pdf .html .tex .txt",
        ),
        ("--netcdf", "a.csv", "--netcdf a.csv: that is the name of another kind of file"),
        ("--json", "four_bar.yaml", "--json four_bar.yaml: that is the model file"),
    ):
        for command in (["shake"], ["solve"], ["flywheel", "--Cs", "0.1"]):
            ran = run(*command, "four_bar.yaml", option, path)
            assert (ran.status, ran.err[: len(message)]) == (2, message)


def test_people_read_the_units_of_the_file_and_programs_si(run: Run, folder: Path) -> None:
    run("shake", "four_bar.yaml", "--csv", "a.csv", "--json", "a.json", "--netcdf", "a.nc")
    assert "shaking_force.x [lbf]" in Path("a.csv").read_text(encoding="utf-8")
    assert json.loads(Path("a.json").read_text(encoding="utf-8"))["units"] == "SI"
    run("shake", "four_bar.yaml", "--csv", "b.csv", "--json", "b.json", "--units", "si")
    assert "shaking_force.x [N]" in Path("b.csv").read_text(encoding="utf-8")
    assert Path("b.json").read_bytes() == Path("a.json").read_bytes()
    run("shake", "four_bar.yaml", "--json", "c.json", "--units", "file")
    assert json.loads(Path("c.json").read_text(encoding="utf-8"))["units"]["force"] == "lbf"


def test_a_force_system_is_written(run: Run, folder: Path) -> None:
    Path("plate.yaml").write_text("forces: {F: {value: 600 @ 90, at: [0.2, 0]}}\n", encoding="utf-8")
    record = json.loads(run("wrench", "plate.yaml", "--json", "-").out)
    s = da.wrench.load("plate.yaml")
    assert isinstance(s, System)
    assert record["system"]["resultant"] == s.resultant.tolist()
    assert record["system"]["moment_at_origin"] == pytest.approx(120.0)
    assert run("wrench", "plate.yaml", "--csv", "-").out.splitlines()[0] == (
        "part,name,force.x [N],force.y [N],at.x [m],at.y [m],moment [N*m]"
    )
