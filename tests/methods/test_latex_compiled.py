"""Worked solutions set by a real LaTeX, with their drawings, where one is installed (continuous integration has it)."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.exams.question_sheet import question_sheet
from dalembert.reports import Report
from dalembert.reports.sheet import Beside
from tests.methods.test_latex import SIGNS, named
from tests.tiers import tiers

COMPILER = shutil.which("pdflatex")
pytestmark = pytest.mark.skipif(
    COMPILER is None, reason="no pdflatex: apt-get install texlive-latex-recommended texlive-pictures lmodern"
)
PICTURES = ("four_bar", "rssr", "seed-002-7a-engine-friction-circles")


def compiled(report: Report, folder: Path) -> str:
    """What the compiler says of a report."""
    report.save(folder / "report.tex")
    command = [str(COMPILER), "-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape", "report.tex"]
    done = subprocess.run(command, cwd=folder, capture_output=True, timeout=120, check=False)
    said = done.stdout.decode("utf-8", "replace")
    assert done.returncode == 0, said[-2000:]
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF")
    return said


@pytest.mark.parametrize("name", tiers([], [*PICTURES, *list(examples())[::6], *list(cases())[::18]]))
def test_reports_with_their_drawings_compile_and_fit_the_page(name: str, tmp_path: Path) -> None:
    report = da.report(da.solve(da.load((examples() | cases())[name])))
    said = compiled(report, tmp_path)
    pictures = sum(len(getattr(b, "scenes", ())) + isinstance(b, Beside) for b in report.sheet.blocks)
    assert (tmp_path / "report.tex").read_text(encoding="utf-8").count(r"\begin{tikzpicture}") == pictures > 0
    too_wide = [float(x) for x in re.findall(r"Overfull \\hbox \(([\d.]+)pt too wide\)", said)]
    assert max(too_wide, default=0.0) < 10.0


@pytest.mark.parametrize("sign", tiers([], ["#%", *(s for s in SIGNS if s.isascii() or s in "éß–")]))
def test_any_name_compiles(sign: str, tmp_path: Path) -> None:
    assert "Output written" in compiled(da.report(da.solve(named(sign))), tmp_path)


@pytest.mark.parametrize("name", tiers(["four_bar"], ["rssr"]))
def test_question_sheets_compile(name: str, tmp_path: Path) -> None:
    r = da.solve(da.load(examples()[name]))
    assert "Output written" in compiled(
        question_sheet(r, [da.Answer(quantity="effort", of=r.drives[0], at=1)], "01"), tmp_path
    )
