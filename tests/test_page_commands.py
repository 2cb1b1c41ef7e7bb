"""Every command line of the pages runs, in a folder with the files that they name, and so does their Python."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
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


@pytest.mark.parametrize("page", ["getting-started.md", "kernel.md", "live-pages.md"])
def test_python_without_prompts_runs(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """On the file that the page's commands write, or on names of the page's examples before it."""
    monkeypatch.chdir(tmp_path)
    assert main(["new", "slider_crank", "-o", "engine.yaml"]) == 0
    (tmp_path / "four_bar.yaml").write_text(
        examples()["four_bar"].read_text(encoding="utf-8"), encoding="utf-8"
    )
    k = da.compile(da.four_bar(), vary=["links.coupler.mass"], outputs=["effort.O2"])
    blocks = page_commands.python_blocks(ROOT / "docs" / page)
    assert len(blocks) == 1
    for block in blocks:
        exec(block, {"da": da, "np": np, "k": k, "values": np.array([[1.0], [2.0]])})
    assert "Error" not in capsys.readouterr().err
