"""Worked solutions of what the bundled machines do not have: friction in space, unknown loads there, screws at rest."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.wrench import Couple, Force, System
from tests.elements.test_cylinders import BOOM
from tests.space.test_friction import body
from tests.space.test_gears import Z, pair, wheel
from tests.space.test_report_said import BEARING, RUBBING, SCREW

RSSR = (
    (Path(__file__).parents[1] / "model" / "rssr.yaml").read_text(encoding="utf-8").partition("answers:")[0]
)
ROUGH = RSSR.replace(
    "A: {type: spherical, links: [crank, rod]}",
    "A: {type: spherical, links: [crank, rod], friction: {coefficient: 0.1, radius: 12}}",
).replace("position: {from: 0, to: 360, count: 12}", "position: 30")
SOUGHT = RSSR.replace(
    "O: {position: {from: 0, to: 360, count: 12}, speed: 300 rpm}",
    "O: {position: 40, speed: 300 rpm, effort: 3000}",
).replace("value: 2000}", "value: unknown}")
PENDULUM = """
units: {length: mm}
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], P: [300, 0]}, mass: 2 kg, center: 150 @ 0, inertia: 0.02 kg*m^2}
joints: {O: {type: pin, links: [ground, arm], damping: 0.3 N*m*s/rad}}
drives: {O: {position: 30 deg, speed: 4 rad/s, acceleration: -10 rad/s^2}}
loads:
  F: {type: force, on: arm, at: P, value: 20 N, direction: 200 deg}
  T: {type: couple, on: arm, value: 3*sin(O) N*m}
parameters: {push: 3 N, lean: 20 deg}
"""
ROUGH_BOOM = BOOM.replace(
    "links: [ground, boom]}", "links: [ground, boom], friction: {coefficient: 0.15, radius: 40}}"
).replace("position: 1000", "position: 1000, speed: 50 mm/s")


SYSTEMS = (
    System(
        Force([-3, -4], at=[2, 1]),
        Force([0, "-5 kN"], at=["300 mm", 0]),
        title="Back and down",
        units={"force": "kN", "length": "mm"},
    ),
    System(Force([0, -5], at=[2, 1]), Couple(-3), title="Down"),
    System(Force([-5, 0], at=[2, 1]), Couple(4), title="To the left"),
    System(Force([6, 0]), Force([-2, 0], at=[0, 3]), Force([-4, 0], at=[1, -1]), title="A couple"),
    System(Force([6, 0], at=[0, 1]), Force([-6, 0], at=[0, 1]), Force([0, 0], at=[2, 2]), title="Nothing"),
    System(
        Force([-2, 3, -6], at=[1, -1, 2]),
        Couple([0, -4, 2]),
        title="A wrench",
        units={"length": "mm", "force": "kN"},
    ),
    System(Force([0, 0, -4], at=[1, 2, 0]), Force([0, 0, -2], at=[-1, 1, 3]), title="Parallel in space"),
    System(Force([0, -3, 0], at=[1, 2, 0]), Couple([3, 5, 3]), title="A wrench along an axis"),
    System(Couple([1, -2, 2]), Couple([0, 0, "-3 kN*mm"]), title="Couples in space"),
    System(Force([0, 2]), Force([0, -2], at=[0.5, 0]), Couple(3), title="Small forces"),
)
CLOCKWISE = da.Notation(links="name", order="on-by", letter="G", torque=-1, axes="link")


def force_systems() -> str:
    return "\n".join([str(da.report(s)) for s in SYSTEMS] + [str(da.report(SYSTEMS[5], at=[1, -1, 2]))])


FRICTION = re.compile(r"^\d+ Friction\n-+\n(.*?)(?=^\d+ [A-Z].*\n--)", re.MULTILINE | re.DOTALL)
TURNED = {"P": {"position": "30 deg", "speed": "-2 rad/s"}}
RUB: dict[str, Any] = RUBBING | {
    "journal of tan": (
        {
            "type": "revolute",
            "axis": [0, 0, 1],
            "friction": {"coefficient": 0.25, "radius": 0.015, "circle": "tan"},
        },
        [100, 20, -60],
        TURNED,
    ),
    "guide without ends": (
        {"type": "prismatic", "axis": [1, 0, 0], "friction": {"coefficient": 0.2}},
        [0, 30, -40],
        {"P": {"position": 0, "speed": "1 m/s"}},
    ),
    "sleeve with ends": (
        {
            "type": "cylindrical",
            "axis": [1, 0, 0],
            "friction": {"coefficient": 0.3, "radius": 0.02, "circle": "tan", "guide": [0.05, 0.08]},
        },
        [0, 30, -40],
        {
            "slide": {"joint": "P", "freedom": "slide", "position": 0, "speed": "-0.05 m/s"},
            "turn": {"joint": "P", "freedom": "turn", "position": 0, "speed": "4 rad/s"},
        },
    ),
    "nut that goes down": (
        {"type": "screw", "axis": [0, 0, 1], "lead": -6e-3, "friction": SCREW},
        [50, 0, -5000],
        {"P": {"freedom": "turn", "position": 0, "speed": "1 rad/s"}},
    ),
    "bearing turned back": (
        {"type": "revolute", "axis": [0, 0, 1], "friction": BEARING},
        [100, 20, -60],
        TURNED,
    ),
}


def rough_joints() -> str:
    """The sections on friction of one body on one joint, and of wheels in mesh."""
    made = {
        name: body(joint, load, [0.3, -0.5, 0.2], **drives) for name, (joint, load, drives) in RUB.items()
    }
    small, large = wheel([0, 0, 0], Z, 0.05), wheel([0.15, 0, 0], Z, 0.1)
    crossed = wheel([0, 0, 0], Z, 0.05), wheel([0.15, 0, 0], [0, -0.6, 0.8], 0.1)
    for name, (a, b), keys in (
        ("mesh with an efficiency", (small, large), {"efficiency": 0.95}),
        ("mesh that rubs", (small, large), {"friction": {"coefficient": 0.1, "arm": 0.004}}),
        ("crossed wheels", crossed, {"friction": {"coefficient": 0.1}}),
    ):
        made[name] = da.dynamics(pair(a, b, [0, 0, -10], **keys), positions=1)
    texts = {name: str(da.report(r, methods=["steps"])) for name, r in made.items()}
    return "\n".join(f"--- {name}\n{found[1]}" for name, t in texts.items() if (found := FRICTION.search(t)))


ONE_REDUNDANT = da.lifted(da.four_bar(positions=1), {}, {"B": "spherical"})
"""A plane four-bar in space with a ball: one constraint too many."""


def rods(mass: bool) -> da.Mechanism:
    """The spatial four-bar with the far end of its rod named first, and perhaps a rod without mass."""
    tree: Any = da.load(examples()["rssr"]).to_tree()
    tree["joints"] = {name: tree["joints"][name] for name in "BAOC"}
    if not mass:
        rod = tree["links"]["rod"]
        tree["links"]["rod"] = {"points": rod["points"]}
    return da.mechanism(tree)


def report(m: Any, at: int | None = None, **options: Any) -> Callable[[], str]:
    def written() -> str:
        made = m() if callable(m) else da.loads(m)
        return str(da.report(da.dynamics(made), **({} if at is None else {"at": at}), **options))

    return written


WORKED_OUT: dict[str, Callable[[], str]] = {
    "solution-force-systems": force_systems,
    **{
        f"solution-{name}-clockwise": report(lambda of=of: da.load((cases() | examples())[of]), notation=notation)
        for name, of, notation in (
            ("quick-return", "quick_return", CLOCKWISE),
            ("engine", "seed-002-7gb-engine-guide-10-mm", da.Notation(torque=-1, axes="link")),
            ("epicyclic", "gtr-3-compound-epicyclic-train", CLOCKWISE),
        )
    },
    "solution-rssr-in-link-axes": report(
        lambda: da.load(examples()["rssr"]), 4, notation=da.Notation(order="on-by", axes="link", units="SI")
    ),
    "solution-rssr-by-matrix": report(lambda: rods(True), 4, methods=["matrix"]),
    "solution-rssr-with-a-light-rod": report(lambda: rods(False), 4, methods=["matrix"]),
    "solution-rough-joints": rough_joints,
    "solution-hydraulic-lift": report(lambda: da.load(cases()["vw-01-hydraulic-lift"])),
    "solution-one-redundant": report(lambda: ONE_REDUNDANT, methods=["steps", "matrix"]),
    "solution-rough-ball": report(ROUGH),
    "solution-sought-couple-in-space": report(SOUGHT),
    "solution-damped-arm": report(PENDULUM),
    "solution-damped-arm-by-virtual-work": report(PENDULUM, methods=["virtual-work"]),
    "solution-jack-at-rest": report(lambda: da.screw_jack().with_values({"drives.S.speed": 0.0})),
    "solution-boom": report(BOOM),
    "solution-rough-boom": report(ROUGH_BOOM),
    "solution-four-bar-otherwise": report(
        lambda: da.load(examples()["four_bar"]), methods=["steps"], about="A", begin="coupler", along="30 deg"
    ),
    "solution-ladder": report(lambda: da.load(cases()["sp-11-ladder-on-two-rails"])),
}  # fmt: skip
