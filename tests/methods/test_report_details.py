"""Small things of worked solutions: light links, one source of a torque, directions of small resultants."""

from __future__ import annotations

from typing import Any

import pytest

import dalembert as da
from dalembert.analysis.methods.solved.solution_by_steps import solution
from dalembert.reports.working import steps_sheet
from dalembert.reports.writers.plain_writer import plain_text
from dalembert.wrench import Force, System
from tests.interchange.test_sketched_machines import PISTON


def test_a_light_link_has_its_inertia_and_no_rounding_of_it() -> None:
    """1e-9 kg m2 beside 4e-9, and a product of 3e-22 that is none."""
    points = {"points": {"O": [0, 0, 0]}}
    inertia = [[1e-9, 3e-22, 0], [3e-22, 4e-9, 0], [0, 0, 4e-9]]
    tree = {
        "space": "space",
        "links": {"ground": points, "fly": points | {"mass": 1e-6, "inertia": inertia}},
        "joints": {"O": {"type": "revolute", "links": ["ground", "fly"], "axis": [0, 0, 1]}},
        "drives": {"O": {"position": 0}},
    }
    text = str(da.report(da.statics(da.mechanism(tree)), methods=["matrix"]))
    rows = [line.split() for line in text.splitlines()]
    assert ["2", "fly", "1.000e−09", "4.000e−09", "4.000e−09", "0", "0", "0"] in rows


LOADS = {f"F{k}": {"type": "force", "on": "rocker", "at": "B", "value": [k, 2]} for k in (1, 2)}


@pytest.mark.parametrize(
    ("loads", "driven", "told"), [(1, "O2", False), (2, "O2", True), (2, "S", False), (1, "S", False)]
)
def test_a_torque_is_told_source_by_source_where_there_are_two_and_a_driven_crank(
    loads: int, driven: str, told: bool
) -> None:
    tree: Any = da.four_bar(positions=1).to_tree() if driven == "O2" else da.loads(PISTON).to_tree()
    on = {} if driven == "O2" else {"on": "block"}
    tree["loads"] = {name: load | on for name, load in list(LOADS.items())[:loads]}
    tree["gravity"] = "none"
    found = plain_text(steps_sheet(solution(da.statics(da.mechanism(tree)))))
    assert ("The driving torque, source by source" in found) == told
    assert ("Torque at O2 due to each source" in found) == told


@pytest.mark.parametrize(("left", "named"), [(1e-4, True), (2e-9, True), (1e-12, False)])
def test_a_small_resultant_has_a_direction_unless_it_is_rounding(left: float, named: bool) -> None:
    """Of forces of 1000 N."""
    s = System(Force([1000, 0]), Force([-1000, 1000 * left], at=[0, 1]))
    assert ("θ (tan θ = R_y / R_x) = 90.00 °" in str(da.report(s))) == named
