"""The command run inside the test, in a folder of its own that has the four-bar example."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from dalembert.bundled import examples
from dalembert.cli import main


class Ran(NamedTuple):
    """What a command printed and returned."""

    status: int
    out: str
    err: str


Run = Callable[..., Ran]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copy(examples()["four_bar"], tmp_path / "four_bar.yaml")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")  # the width that help is set in
    return tmp_path


@pytest.fixture
def run(folder: Path, capsys: pytest.CaptureFixture[str]) -> Run:
    def ran(*arguments: str) -> Ran:
        status = main(arguments)
        captured = capsys.readouterr()
        return Ran(status, captured.out, captured.err)

    return ran


@pytest.fixture
def edited(folder: Path) -> Callable[..., str]:
    """The example with some text replaced, as a new file."""

    def edit(*changes: tuple[str, str], name: str = "edited.yaml") -> str:
        text = (folder / "four_bar.yaml").read_text(encoding="utf-8")
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        (folder / name).write_text(text, encoding="utf-8")
        return name

    return edit
