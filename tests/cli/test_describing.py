"""`schema`, `new`, `convert`, `examples`: descriptions rather than answers."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import dalembert as da
from dalembert.model.library import TEMPLATES
from tests.cli.conftest import Run
from tests.tiers import tiers


def test_schema_is_json(run: Run) -> None:
    schema = json.loads(run("schema").out)
    assert schema["$schema"].startswith("https://json-schema.org/")
    assert {"links", "joints", "drives", "loads"} <= set(schema["properties"])


def test_schema_to_a_file(run: Run, folder: Path) -> None:
    assert run("schema", "-o", "schema.json") == (0, "Written: schema.json\n", "")
    assert json.loads((folder / "schema.json").read_text(encoding="utf-8"))
    assert run("schema", "-o", "schema.json").status == 2


def test_templates_are_listed(run: Run) -> None:
    listed = run("new").out
    assert all(name in listed for name in TEMPLATES)


SOME = list(TEMPLATES)[::6]


@pytest.mark.parametrize("name", tiers(SOME, [name for name in TEMPLATES if name not in SOME]))
def test_templates_solve(run: Run, name: str) -> None:
    assert run("new", name, "-o", "fresh.yaml") == (0, "Written: fresh.yaml\n", "")
    assert run("solve", "fresh.yaml").status == 0


def test_template_is_printed_without_a_file(run: Run) -> None:
    assert run("new", "four_bar").out.startswith("dalembert: 1\n")


def test_examples(run: Run, folder: Path) -> None:
    listed = run("examples").out
    assert ["four_bar", "Four-bar", "linkage,", "dynamic"] in [line.split() for line in listed.splitlines()]
    assert "published problems" in listed
    assert run("examples", "four_bar").out == (folder / "four_bar.yaml").read_text(encoding="utf-8")
    assert run("examples", "four_bar", "-o", "mine.yaml").status == 0
    assert run("examples", "four_bar", "-o", "mine.yaml").status == 2
    assert run("examples", "four_bar", "-o", "mine.yaml", "--force").status == 0


@pytest.mark.parametrize("ending", ["json", "toml", "yaml"])
def test_convert_means_the_same(run: Run, ending: str) -> None:
    assert run("convert", "four_bar.yaml", "-o", f"other.{ending}") == (0, f"Written: other.{ending}\n", "")
    assert run("solve", f"other.{ending}").out == run("solve", "four_bar.yaml").out
    assert run("convert", "four_bar.yaml", "-o", f"other.{ending}").status == 2
    assert da.load(f"other.{ending}") == da.load("four_bar.yaml")


@pytest.mark.parametrize("command", ["solve", "check", "validate", "schema", "new", "convert", "examples"])
def test_every_command_has_help_with_examples(run: Run, command: str) -> None:
    ran = run(command, "--help")
    assert ran.status == 0
    assert ran.out.startswith(f"Usage: dalembert {command}")
    assert f"\nExamples:\n  dalembert {command}" in ran.out


def test_no_command_shows_help(run: Run) -> None:
    assert run() == run("--help")
    assert "Exit status: 0 all positions solved; 1 some positions are not; 2 the file" in run("--help").out
