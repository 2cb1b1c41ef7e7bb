"""What the README shows is what happens: its file, its command with its answer, its Python."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest

from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.errors import STATUSES

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(language: str) -> str:
    """The first block of a language."""
    found = re.search(rf"```{language}\n(.*?)```", README, re.DOTALL)
    assert found is not None
    return found[1]


def test_its_file_is_the_example() -> None:
    assert block("yaml") == examples()["four_bar"].read_text(encoding="utf-8")


def test_its_command_gives_its_answer(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    command, _, answer = block("console").partition("\n")
    assert command.startswith("$ dalembert ")
    assert main(command.split()[2:]) == 0
    *printed, checks = capsys.readouterr().out.splitlines()
    *shown, shown_checks = answer.splitlines()
    assert printed == shown
    rounding = re.compile(r"\d\.\de-\d\d")  # differs from one processor to the next
    assert rounding.sub("#", checks) == rounding.sub("#", shown_checks)


def test_its_python_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    failed, tried = doctest.testfile(str(ROOT / "README.md"), module_relative=False)
    assert tried > 3
    assert failed == 0


def test_links_lead_somewhere() -> None:
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").glob("*.md")]
    links = [(p, to) for p in pages for to in re.findall(r"\]\(([^)#]+)", p.read_text(encoding="utf-8"))]
    assert len(links) > 100
    inside = [(p, to) for p, to in links if not to.startswith("https://")]
    assert [f"{p.name}: {to}" for p, to in inside if not p.parent.joinpath(to).exists()] == []


def test_the_guide_has_every_status() -> None:
    page = (ROOT / "docs" / "statuses.md").read_text(encoding="utf-8")
    for code, status in STATUSES.items():
        assert f"| `{code}` | {status.sentence} | {status.remedy}".rstrip() in page


def pages_with_examples() -> list[object]:
    """Every page of the guide with an example that runs; the quick ones by default."""
    pages = [p for p in sorted((ROOT / "docs").glob("*.md")) if ">>> " in p.read_text(encoding="utf-8")]
    quick = {"methods.md", "quantities.md", "friction.md"}
    return [pytest.param(p.name, marks=() if p.name in quick else pytest.mark.long) for p in pages]


@pytest.mark.parametrize("page", pages_with_examples())
def test_pages_run(page: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    flags = doctest.NORMALIZE_WHITESPACE
    failed, tried = doctest.testfile(str(ROOT / "docs" / page), module_relative=False, optionflags=flags)
    assert tried > 3
    assert failed == 0
