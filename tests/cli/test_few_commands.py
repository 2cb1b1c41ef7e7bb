"""Options that few use, and what they print: tables of several files, skeletons, extremes, steps, extras."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.solved.solution_by_steps import solution
from dalembert.cli.installation.doctor_command import extras_text, missing_extras
from dalembert.cli.installation.installed_packages import EXTRAS, PackageState
from tests.cli.conftest import Run

CHECKED = """
quantity      published  exact  computed  tolerance  deviation   ok
-------------------------------------------------------------------

a
effort of O2   243.2376      -  243.2376     0.01 %  3.8e-06 %  yes

b
effort of O2        250      -  243.2376        1 %      2.7 %   NO
mobility              1      -         1                        yes

b, line 33: effort of O2: published 250, computed 243.2376, 2.7 % apart,
  tolerance 1 %

3 answers, 0 with an exact value; 1 not met.
"""
BY_FILE = """
case  answers  exact  agree   ok
--------------------------------
a           1      0      1  yes
b           2      0      1   NO
"""


def test_all_answers_of_several_files_stand_below_their_names(run: Run, folder: Path) -> None:
    text = (folder / "four_bar.yaml").read_text(encoding="utf-8")
    a = "answers:\n  - {quantity: effort, of: O2, value: 243.2376, tolerance: 0.01 %}\n"
    b = "answers:\n  - {quantity: effort, of: O2, value: 250, tolerance: 1 %}\n  - {quantity: mobility, value: 1}\n"
    for name, answers in (("a.yaml", a), ("b.yaml", b)):
        (folder / name).write_text(text + answers, encoding="utf-8")
    assert run("check", "a.yaml", "b.yaml", "--all") == (1, CHECKED.lstrip("\n"), "")
    by_file = BY_FILE + CHECKED[CHECKED.index("\nb, line") :]
    assert run("check", "a.yaml", "b.yaml") == (1, by_file.lstrip("\n"), "")
    one = run("check", "a.yaml", "--all")
    assert (one.status, one.out.splitlines()[2][:12]) == (0, "effort of O2")


def test_a_skeleton_is_drawn_as_dxf_alone(run: Run, folder: Path) -> None:
    said = "s.svg: a skeleton is a DXF file; end its name in .dxf\n"
    assert run("draw", "four_bar.yaml", "-o", "s.svg", "--skeleton") == (2, "", said)
    ezdxf = pytest.importorskip("ezdxf")
    assert run("draw", "four_bar.yaml", "-o", "s.dxf", "--skeleton") == (0, "", "Written: s.dxf\n")
    layers = {e.dxf.layer for e in ezdxf.readfile(folder / "s.dxf").modelspace()}
    assert {"ground", "crank", "coupler", "rocker", "joints"} <= layers
    assert not {e.dxf.layer for e in ezdxf.readfile(folder / "s.dxf").modelspace()} & {"link", "pin"}


def test_the_position_of_an_extreme_is_said(run: Run) -> None:
    r = da.dynamics(da.load("four_bar.yaml"), positions=36)
    effort = r.effort("O2") / 0.1129848290276167
    k = int(np.argmax(effort))
    at = f"{np.degrees(r.drive_position('O2')[k]):g} deg"
    said = f"Position {k + 1} of 36, O2 = {at}: effort.O2 is largest here, {effort[k]:.2f} lbf*in.\n"
    command = ["draw", "four_bar.yaml", "-o", "s.svg", "--view", "mechanism", "--positions", "36"]
    ran = run(*command, "--at", "max effort.O2")
    assert (ran.status, ran.err) == (0, f"Written: s.svg\n{said}")


def test_steps_stand_below_the_answer(run: Run) -> None:
    whole, steps = run("solve", "four_bar.yaml"), run("solve", "four_bar.yaml", "--method", "steps")
    by_hand = solution(da.dynamics(da.load("four_bar.yaml"))).text("file")
    assert steps == (0, f"{whole.out.rstrip()}\n\n{by_hand}\n", "")


def test_a_number_of_designs_is_an_integer(run: Run) -> None:
    said = "--designs 2.5 is not an integer; give one, such as 100000 or 1e6\n"
    assert run("study", "extend", "none", "--designs", "2.5") == (2, "", said)


@pytest.mark.parametrize(
    ("states", "complete"),
    [
        ([("1.0", "0.9")], True),
        ([("1.0", "0.9"), ("", "1.1")], False),
        ([("1.0", "0.9"), ("1.0", "1.1")], False),
        ([("", "0.9"), ("2.0", "1.1")], False),
    ],
)
def test_an_extra_is_complete_with_all_its_packages(states: list[tuple[str, str]], complete: bool) -> None:
    some = [PackageState("fast", f"p{k}", have, least) for k, (have, least) in enumerate(states)]
    head = f"fast      {'complete' if complete else 'MISSING '}  {EXTRAS['fast']}"
    names = ", ".join(f"p{k} {have or 'missing'}" for k, (have, _) in enumerate(states))
    assert extras_text(some) == f"{head}\n{20 * ' '}{names}"
    assert list(missing_extras(some)) == ([] if complete else ["pip install 'dalembert[fast]'"])


def test_virtual_work_on_both_sides_of_a_reversal(run: Run, folder: Path) -> None:
    """At the dead centre the friction of the guide is mu times its normal force, first back, then forth."""
    tree: Any = da.slider_crank(positions=1).to_tree() | {"gravity": "standard"}
    tree["joints"]["guide"]["friction"] = {"coefficient": 0.2}
    tree["drives"]["O2"]["position"] = 0
    m = da.mechanism(tree)
    m.save(folder / "dead.yaml")
    r = da.dynamics(m)
    ran = run("solve", "dead.yaml", "--method", "virtual-work")
    before, after = ran.out.partition("Just before the reversal:")[2].split("Just after it:")
    for text, side, sense in ((before, r.sides[0], -1), (after, r.sides[1], 1)):
        rubbed = next(line for line in text.splitlines() if line.startswith("friction in guide"))
        normal = abs(float(side.reaction("guide", on="piston")[0][1]))
        assert float(rubbed.split()[3]) == pytest.approx(sense * 0.2 * normal, rel=1e-4)
        assert f"Effort that balances the work: O2 = {side.effort('O2')[0]:.5g} N*m" in text
