"""Every command line of the pages runs, in a folder with the files that they name."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import pytest

from dalembert.cli import main

ROOT = Path(__file__).parents[1]
spec = importlib.util.spec_from_file_location("page_commands", ROOT / "docs" / "site" / "page_commands.py")
assert spec is not None
assert spec.loader is not None
page_commands = importlib.util.module_from_spec(spec)
sys.modules["page_commands"] = page_commands
spec.loader.exec_module(page_commands)
QUICK = ("getting-started.md", "live-pages.md", "rotor.yaml")


def test_commands_are_found() -> None:
    assert sum(1 for page in page_commands.pages() for _ in page_commands.commands(page)) > 70


@pytest.mark.parametrize(
    "page",
    [
        pytest.param(p, id=p.name, marks=() if p.name in QUICK else pytest.mark.long)
        for p in page_commands.pages()
    ],
)
def test_every_command_of_a_page_runs(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def run(arguments: list[str], folder: Path) -> tuple[int, str]:
        monkeypatch.chdir(folder)
        status = main(arguments)
        return status, capsys.readouterr().err

    assert page_commands.failures(page, tmp_path, run) == []
