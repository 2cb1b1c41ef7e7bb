"""Figures in the paper and the guide are those of the kept benchmarks; no table of a benchmark is typed."""

from __future__ import annotations

import importlib.util
import json
import re
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from dalembert.grading.marking.rubric import SHARES
from dalembert.machine.motion.stepping import Limits
from dalembert.pages.unfinished.sketch_page import INSIDE
from dalembert.studio.document import STEPS

ROOT = Path(__file__).parents[1]
ORDINALS = {12: "twelfth", 13: "thirteenth", 20: "twentieth", 24: "twenty-fourth", 25: "twenty-fifth"}


def kept(name: str) -> str:
    return (ROOT / "benchmarks" / "kept" / f"{name}.txt").read_text(encoding="utf-8")


def page(path: str) -> str:
    return " ".join((ROOT / path).read_text(encoding="utf-8").split())


def number(pattern: str, text: str) -> float:
    found = re.search(pattern, text)
    assert found is not None, pattern
    return float(found[1])


def test_the_paper_has_the_kept_ratios() -> None:
    paper, kernel = page("paper/paper.md"), kept("kernel")
    assert f"takes {number(r'ratio (0.[0-9]+)', kernel):.2f} of the time" in paper
    assert f"cost {number(r'ns: ([0-9.]+) times', kernel):.1f} times the torque" in paper
    ratios = [
        float(row.split()[-4]) for row in kept("by_hand").splitlines() if row.endswith(("e-16", "e-15"))
    ]
    assert len(ratios) == 7
    first, last = (ORDINALS[round(x)] for x in (min(ratios), max(ratios)))
    assert f"take a {first} to a {last} of the time" in paper
    known = [float(row.split()[-1]) for row in kept("stewart").splitlines() if "poses known" in row]
    assert f"take {100 / min(known):.1f} % of the time" in paper


def test_the_guide_says_of_optimisation_what_the_kept_table_says() -> None:
    rows = [[cell.strip() for cell in row.split("|")[1:-1]] for row in kept("optimize").splitlines()[6:]]
    ours = [row for row in rows if row[0] == "torque, N m" and row[1].startswith("da.")]
    assert [row[3] for row in ours] == ["41", "1001"]
    assert all(row[1].startswith("da.optimize, 10 of 10 best alike") for row in ours)
    rivals = [float(row[4]) for row in rows if row[0] == "torque, N m" and row[1].startswith("scipy")]
    assert all(float(ours[0][4]) < x < 1.001 * float(ours[0][4]) for x in rivals)
    exact = re.search(r"\| path.*da.synthesize, (\d+) of (\d+) exact", kept("optimize"))
    assert exact is not None
    assert Fraction(int(exact[1]), int(exact[2])) > Fraction(1, 2)
    said = page("docs/optimization.md")
    assert "All ten best designs reach the same peak torque, from 40 random starts as from 1,000" in said
    assert "most of the starts within wide bounds recover it" in said


def test_steps_of_friction_in_the_kernel() -> None:
    rows = re.findall(r"^\S.*? +\d+ +[\d.]+ +[\d.]+ +[\d.]+ +(\d) ", kept("kernel_friction"), re.MULTILINE)
    assert set(rows) == {"3", "4"}
    assert "(3 or 4 on the bundled mechanisms, 7 at most)" in page("docs/kernel.md")


@pytest.mark.parametrize(
    "path", [p for p in sorted((ROOT / "docs").glob("*.md")) if "table of bench" in p.read_text("utf-8")]
)
def test_tables_of_benchmarks_are_put_in_by_the_site(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    names = re.findall(r"<!-- table of benchmarks/kept/(\w+)\.txt -->", path.read_text(encoding="utf-8"))
    assert names
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "site"))
    text = module("build").resolved(path.read_text(encoding="utf-8"))
    for name in names:
        assert kept(name).splitlines()[-1] in text
    assert "<!--" not in text


def test_limits_that_the_guide_states() -> None:
    assert f"the last {STEPS} steps" in page("docs/studio.md")
    assert f"up to {INSIDE} such steps" in page("docs/live-pages.md")
    assert f"ends after {Limits.steps:,} integration steps" in page("docs/machine.md")


def test_shares_of_the_outcomes_are_those_of_the_rubric() -> None:
    rows = re.findall(
        r"^\| ((?:`\w+`(?:, )?)+) \| ([\d.]+) \|",
        (ROOT / "docs" / "exams.md").read_text("utf-8"),
        re.MULTILINE,
    )
    stated = {name: float(share) for names, share in rows for name in re.findall(r"\w+", names)}
    assert stated == SHARES


def test_a_law_counts_its_machines_by_tier() -> None:
    """A block of seeds counts as many, a long test not by default."""
    counts = module("law_counts").Counts()
    counts.pytest_collection_modifyitems(
        [
            law("holds", 3),
            law("holds", range(20), "long"),
            law("also", range(7), "exhaustive"),
            law("not", None),
        ]
    )
    assert json.loads(json.dumps(counts.modules)) == {
        "tests/laws/test_one.py": {"said": "It holds.", "laws": ["also", "holds"], "machines": [1, 21, 28]}
    }


def law(name: str, seed: Any, mark: str = "") -> SimpleNamespace:
    return SimpleNamespace(
        originalname=name,
        path=ROOT / "tests" / "laws" / "test_one.py",
        module=SimpleNamespace(__doc__="It holds.\n\nMore."),
        callspec=SimpleNamespace(params={} if seed is None else {"seed": seed}),
        get_closest_marker=lambda asked: asked if asked == mark else None,
    )


def module(name: str) -> Any:
    spec = importlib.util.spec_from_file_location(f"site_{name}", ROOT / "docs" / "site" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made
