"""Visible cases of contacts and motions under forces, by their model files: to 1e-8 of the exact value."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da

CASES: dict[str, dict[str, Any]] = {
    c["id"]: c for c in json.loads(Path(__file__).with_name("motion_cases.json").read_text(encoding="utf-8"))
}
Read = Callable[[da.Mechanism], Iterator[float]]


def bead_on_a_dome(m: da.Mechanism) -> Iterator[float]:
    s = da.simulate(m, "force.dome = 0")
    assert s.ended.startswith("force.dome = 0 at ")
    yield 90 - math.degrees(s.position("dome")[-1])
    yield abs(s.speed("dome")[-1]) * 0.5
    yield s.time[-1]


def disc_off_a_cylinder(m: da.Mechanism) -> Iterator[float]:
    s = da.simulate(m, "normal.dome = 0")
    yield 90 - math.degrees(s.position("O")[-1])
    yield abs(s.speed("O")[-1])
    yield s.time[-1]
    s = da.simulate(m, "O.position = 50 deg")
    normal, force = s["normal.dome"][-1], s.result.reaction("dome")[-1]
    yield math.sqrt(force @ force - normal**2) / normal


def block_on_a_table(m: da.Mechanism) -> Iterator[float]:
    s = da.simulate(m, "0.3 s")
    landing = s.event("landing")[0]
    yield s.event("lift-off")[0].time
    yield landing.time
    yield landing.speed
    yield -s.works["impacts"][-1]
    assert max(s.energy_residual, s.law_residual) < 1e-10


def crate_on_a_truck(m: da.Mechanism) -> Iterator[float]:
    c = da.dynamics(m).contact("floor")
    assert c.ahead is not None
    assert c.behind is not None
    yield c.ahead[0]
    yield c.behind[0]
    yield c.lift_acceleration


def bouncing_ball(m: da.Mechanism) -> Iterator[float]:
    s = da.simulate(m, "10 s")
    landings = s.event("landing")
    yield s.event("rest")[0].time
    last = landings[-1]
    tops = [x.speed**2 / (2 * 9.80665) for x in landings[1:]]
    yield 1.5 + 2 * sum(tops) + 2 * last.speed**2 / (2 * 9.80665) * 0.64 / 0.36
    yield landings[2].lost


def crane(m: da.Mechanism) -> Iterator[float]:
    s = da.simulate(m, "8 s")
    k = int(np.flatnonzero(s.time == 2.0)[0])
    yield math.degrees(s.position("T")[-1])
    yield s.speed("T")[-1]
    yield math.degrees(s.position("T")[k])
    yield s.result.effort("rail")[k]
    yield s.position("rail")[-1]


def fall_with_drag(m: da.Mechanism) -> Iterator[float]:
    s = da.simulate(m, "10 s")
    yield s.speed("S")[-1]
    yield s.position("S")[-1]
    yield da.simulate(m, "100 s").speed("S")[-1]
    yield -s.works["loads"][-1]


def slide_on_an_arm(m: da.Mechanism) -> Iterator[float]:
    s = da.simulate(m, "1.3 s")
    yield s.position("S")[-1]
    yield s.speed("S")[-1]
    yield s.result.effort("O")[-1]
    yield s.works["O"][-1]


def working_stroke(m: da.Mechanism) -> Iterator[float]:
    """The mean by the flywheel's panels; the greatest on the continuous curve, near its largest position."""
    r = da.dynamics(m)
    mean = da.turning_moment(r).mean if hasattr(da, "turning_moment") else da.flywheel(r, inertia=1.0).mean
    yield mean * 2 * math.pi
    yield mean
    at = float(r.drive_position("O")[int(np.argmax(r.effort("O")))])
    for width in (0.02, 1e-4, 1e-6):
        fine = np.linspace(at - width, at + width, 101)
        effort = da.dynamics(m, positions=fine).effort("O")
        at = float(fine[int(np.argmax(effort))])
    yield effort.max()


READ: dict[str, Read] = {
    "ONE-1": bead_on_a_dome,
    "ONE-2": disc_off_a_cylinder,
    "ONE-3": block_on_a_table,
    "ONE-5": crate_on_a_truck,
    "ONE-8": bouncing_ball,
    "SIM-1": crane,
    "SIM-2": fall_with_drag,
    "SIM-5": slide_on_an_arm,
    "SIM-6": working_stroke,
}


@pytest.mark.parametrize("case", CASES)
def test_motion_case(case: str) -> None:
    found = list(READ[case](da.loads(CASES[case]["file"])))
    quantities = CASES[case]["quantities"]
    assert len(found) == len(quantities)
    for value, q in zip(found, quantities, strict=True):
        assert value == pytest.approx(q["exact"], rel=1e-8, abs=1e-12), q["name"]
