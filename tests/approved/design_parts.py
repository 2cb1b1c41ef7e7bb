"""Sections of design reports of machines with every kind of element: verdicts with their limits, and what is below."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.reports.design.element_parts import element_parts
from dalembert.reports.design.force_part import force_part
from dalembert.reports.design.motion_part import motion_part
from dalembert.reports.design.power_parts import balance_part, flywheel_part, motor_part, shaking_part
from dalembert.reports.design.start_up import start_up_part
from dalembert.reports.design.strength_parts import bearing_part, member_part, pin_part
from dalembert.reports.design.verdict import DesignContext
from dalembert.reports.sheet import ReportSheet
from dalembert.reports.writers.plain_writer import plain_text
from tests.approved.commands import BROKEN
from tests.elements.test_cylinders import BOOM, SIZES
from tests.space.machines import door

Find = Callable[[DesignContext], Any]
ELEMENTS = Path(__file__).parents[1] / "elements"
STEEL = {"rectangle": ["20 mm", "40 mm"], "elasticity": "206 GPa"}
TIRED = STEEL | {"yield_stress": "300 MPa", "endurance": "120 MPa", "ultimate": "500 MPa"}
MOTOR = {"stall": "60 N*m", "no_load": "5000 rpm"}
STRONG_BOOM = (
    BOOM.replace(SIZES, f"{SIZES}, closed: 900, stroke: wide")
    .replace("boom: {points", "boom: {section: {rectangle: [80, 120], yield_stress: 235 MPa}, points")
    .replace("gravity:", "parameters: {wide: 400 mm}\ngravity:")
)
PIN = {"diameter": "20 mm", "eye": "30 mm", "cheeks": "15 mm"}


def crank(**values: Any) -> Any:
    """A slider-crank with some values by path, __ for a dot."""
    m = da.slider_crank(crank=0.05, rod=0.2)
    return da.dynamics(m.with_values({k.replace("__", "."): v for k, v in values.items()}), positions=8)


def bundled(name: str, positions: int = 8, **values: Any) -> Any:
    m = da.load((cases() | examples())[name])
    m = m.with_values({k.replace("__", "."): v for k, v in values.items()})
    return da.dynamics(m, positions=positions)


def sections(find: Find, *results: Any) -> str:
    """A design report's sections of some results."""
    sheet = ReportSheet("")
    for r in results:
        for part in find(DesignContext(r, 0, da.Notation())):
            part.put_on(sheet)
    return plain_text(sheet)


def cylinders() -> Iterator[Any]:
    """With columns, without their sizes, and two that would pull on their oil: at one position, and at some."""
    yield bundled("excavator", 3)
    yield da.statics(da.loads(BOOM))
    yield da.statics(
        da.loads(BOOM.replace("standard", "[0, 9.81 m/s^2]").replace(SIZES, f"{SIZES}, rod_pressure: 0"))
    )
    falls = BOOM.replace("standard", "[-9.81 m/s^2, 0]").replace(SIZES, f"{SIZES}, rod_pressure: 0")
    yield da.statics(da.loads(falls.replace("position: 1000", "position: {from: 650, to: 1000, count: 3}")))


def whole(r: Any) -> str:
    return str(da.report(r, design=True))


def motors() -> Iterator[Any]:
    """One that reaches its speed at once, one in 0.7 s, one with too much inertia, one that turns backwards."""
    free = {"loads__load__value": [0, 0]}
    yield crank(**free, drives__O2__motor=MOTOR)
    yield crank(**free, drives__O2__motor=MOTOR, links__crank__inertia="0.1 kg*m^2")
    yield crank(**free, drives__O2__motor=MOTOR, links__crank__inertia="500 kg*m^2")
    back = {"stall": "-60 N*m", "no_load": "-5000 rpm"}
    yield crank(**free, drives__O2__speed="-20 rad/s", drives__O2__motor=back)


DESIGNED: dict[str, Callable[[], str]] = {
    "cylinders": lambda: sections(element_parts, *cylinders()),
    "cam": lambda: sections(element_parts, da.solve(da.disc_cam(positions=12))),
    "belts": lambda: sections(element_parts, da.solve(da.belt_drive(positions=3))),
    "rope": lambda: sections(element_parts, da.solve(da.hoist(positions=3))),
    "brakes": lambda: sections(element_parts, da.solve(da.load(ELEMENTS / "brakes.yaml"))),
    "screw": lambda: sections(element_parts, da.solve(da.screw_jack(positions=3))),
    "pins": lambda: sections(
        pin_part, crank(joints__A__pin=PIN), crank(joints__A__pin=PIN | {"yield_stress": "300 MPa"})
    ),
    "bearings": lambda: sections(
        bearing_part,
        crank(joints__A__bearing={"rating": "12 kN"}),
        crank(joints__A__bearing={"rating": "12 kN", "static_rating": "9 kN"}),
        crank(joints__A__bearing={"diameter": "40 mm", "length": "30 mm"}),
    ),
    "members": lambda: sections(
        member_part,
        crank(),
        crank(links__rod__section=STEEL),
        crank(links__rod__section=TIRED),
        crank(links__rod__section=TIRED | {"notch": 1.8}),
    ),
    "start-up": lambda: sections(start_up_part, *motors()),
    "balance": lambda: sections(balance_part, crank()),
    "boom": lambda: whole(da.statics(da.loads(STRONG_BOOM))),
    "rssr": lambda: whole(bundled("rssr", 5)),
    "does-not-close": lambda: whole(bundled("four_bar", 6, links__crank__points__A=["0.5 m", 0])),
    "motor": lambda: sections(
        motor_part,
        crank(drives__O2__motor=MOTOR),
        crank(drives__O2__motor=MOTOR | {"stall": "600 N*m"}),
        da.dynamics(da.five_bar(positions=3)),
    ),
    "flywheel": lambda: sections(
        flywheel_part, crank(), crank(**{f"links__{link}__mass": 0 for link in ("crank", "rod", "piston")})
    ),
    "shaking": lambda: sections(shaking_part, crank(), crank(gravity="standard", drives__O2__speed="0 rpm")),
    "motion": lambda: sections(
        motion_part, crank(), bundled("excavator", 3), da.statics(da.loads(BROKEN)), da.dynamics(door())
    ),
    "forces": lambda: sections(force_part, crank(), da.dynamics(door())),
}
