"""One answer of every class that is written, each made once."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import dalembert as da
from dalembert.answer.answer import Answer
from dalembert.bundled import examples
from dalembert.machine.members.member_table import member_table

ROCKER = "links.rocker.points.B.0"


def bar(positions: int = 12) -> da.Result:
    return da.dynamics(da.load(examples()["four_bar"]), positions=positions)


def engine() -> da.Result:
    return da.dynamics(da.load(examples()["engine"]), positions=24)


def study() -> Answer:
    found = da.study(da.four_bar(), {"links.coupler.mass": "± 5 %"}, ["effort.O2"], designs=50)
    return found.run()


def law() -> Answer:
    rise = {"segments": [{"to": 0.025, "in": 0.2, "by": "cycloidal"}], "count": 101}
    links = {"ground": {"points": {"O": [0, 0]}}, "ram": {"points": {"F": [0, 0]}}}
    slide = {"S": {"type": "slider", "links": ["ground", "ram"], "at": ["O", "F"]}}
    tree = {"title": "Ram", "links": links, "joints": slide, "drives": {"S": {"law": rise}}}
    return da.law(da.mechanism(tree), "S")


def marks() -> Answer:
    key = [{"quantity": "effort", "of": "O2", "value": 243.2376, "unit": "lbf*in", "marks": 4}]
    with TemporaryDirectory() as folder:
        for student, effort in (("ann", "-243.2"), ("=bob", "243.2")):
            Path(folder, f"{student}.yaml").write_text(f"efforts: {{O2: {effort}}}", encoding="utf-8")
        return da.grade(folder, key)


def cam() -> Any:
    """A cam that raises a roller."""
    return da.cam(da.load(examples()["cam_and_follower"]), "F")


def bolts() -> Any:
    size = {"diameter": "20 mm", "eye": "30 mm", "cheeks": "15 mm"}
    return da.pins(da.dynamics(da.slider_crank(crank=0.05, rod=0.2).with_values({"joints.A.pin": size})))


def shaft() -> Any:
    """An even shaft on two bearings."""
    described: Any = {
        "points": {"A": [0, 0], "B": [1, 0]},
        "mass": 15,
        "center": [0.5, 0],
        "mass_along": "uniform",
    }
    described["section"] = {"circle": "50 mm", "elasticity": "210 GPa"}
    links = {"ground": {"points": {"A": [0, 0], "B": [1, 0]}}, "shaft": described}
    joints = {n: {"type": kind, "links": ["ground", "shaft"]} for n, kind in (("A", "pin"), ("B", "slot"))}
    tree = {"title": "Shaft", "links": links, "joints": joints}
    return da.critical_speeds(da.statics(da.mechanism(tree)), "shaft")


MADE: dict[str, Callable[[], Answer]] = {
    "Result": bar,
    "Shaking": lambda: da.shaking(engine()),
    "Flywheel": lambda: da.flywheel(engine(), Cs=0.02),
    "MemberTable": lambda: member_table(bar()),
    "BearingTable": lambda: da.bearings(bar()),
    "MotorChoice": lambda: da.motor(engine(), inertia=1e-3),
    "Simulation": lambda: da.simulate(
        da.slider_crank(crank=0.05, rod=0.2),
        "0.02 s",
        start={"O2": {"position": 0.5, "speed": 20.0}},
        count=11,
    ),
    "Balance": lambda: da.balance(da.load(examples()["four_bar"]), ["crank"], positions=12),
    "RotorBalance": lambda: da.balance_rotor(da.rotating_shaft(), (0.05, 0.45), (0.04, 0.06)),
    "Sweep": lambda: da.sweep(da.four_bar(), {"links.coupler.mass": [1.0, 2.0], ROCKER: ["0.2 m", "0.25 m"]}),
    "BatchResult": lambda: da.compile(da.four_bar(), ["links.coupler.mass"])([[1.0], [2.0]]),
    "StudyResult": study,
    "Optimum": lambda: da.optimize(
        da.four_bar(), {ROCKER: (0.2, 0.28)}, "peak effort.O2", "transmission.B >= 20 deg", starts=2
    ),
    "Front": lambda: da.pareto(
        da.four_bar(),
        {"links.coupler.center.1": (-0.1, 0.1), "links.rocker.center.0": (0.05, 0.2)},
        ["effort.O2", "reaction.B.magnitude"],
        points=3,
        starts=4,
        positions=12,
    ),
    "Synthesis": lambda: da.synthesize(
        da.four_bar(),
        {"links.crank.points.A.0": (0.06, 0.12)},
        {"angle.rocker": [1.65, 1.95]},
        [0.2, 1.7],
        starts=2,
    ),
    "MotionLaw": law,
    "CamDesign": cam,
    "PinTable": bolts,
    "CriticalSpeeds": shaft,
    "ClassMarks": marks,
    "System": lambda: da.wrench.System(
        da.wrench.Force("600 @ 60 N", at=["200 mm", 0]), da.wrench.Couple("-20 N*m"), title="Plate"
    ),
}
"""Class -> what makes one of it."""


@cache
def made(name: str) -> Answer:
    """An answer of a class."""
    return MADE[name]()
