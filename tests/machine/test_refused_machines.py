"""What questions of machine design refuse, word for word, each asked of a machine that lacks what they need."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import DalembertError
from dalembert.machine.harmonics import harmonics
from dalembert.machine.whole_cycle import turning_angle
from tests.elements.test_cams import machine as cam_machine
from tests.machine.test_members import ARM
from tests.machine.test_simulate import FOUR_BAR

SLIDE = """
links: {ground: {points: {O: [0, 0]}}, ram: {points: {O: [0, 0]}, mass: 2}}
joints: {S: {type: slider, links: [ground, ram], at: O}}
"""
CROSS = """
links: {ground: {points: {O: [0, 0]}}, a: {points: {O: [0, 0]}, mass: 2}, b: {points: {O: [0, 0]}, mass: 1}}
joints:
  S: {type: slider, links: [ground, a], at: O%s}
  T: {type: slider, links: [ground, b], at: O, direction: 90}
start: {S: {position: 0, speed: 0}%s}
"""
BESIDE = CROSS % ("", "") + "drives: {S: {effort: 1}, T: {position: 0, speed: 1}}"
RUBS, BOTH = ", friction: {coefficient: 0.1}", ", T: {position: 0, speed: 0}"
HELD = """
links: {ground: {points: {A: [0, 0], B: [1, 0]}}, bar: {points: {A: [0, 0], B: [1, 0]}, mass: 1}}
joints: {A: {type: pin, links: [ground, bar]}, B: {type: slot, links: [ground, bar]}}
"""
WELDED = """space: space
links: {ground: {points: {A: [0, 0, 0]}}, disc: {points: {A: [0, 0, 0]}, mass: 1}}
joints: {A: {type: weld, links: [ground, disc]}}
"""
CYLINDER = """
links: {ground: {points: {A: [0, 0], G: [0, 0]}}, ram: {points: {B: [0, 0]}, mass: 2}}
joints: {G: {type: slider, links: [ground, ram], at: [G, B]}}
start: {C: {position: 1, speed: 0}}
drives:
  C:
    cylinder: {between: [ground.A, ram.B], bore: 0.1, rod: 0.05, cap_pressure: 10 bar, rod_pressure: 1 bar,
               efficiency: 0.9}
"""
FREEWHEEL = """
links:
  ground: {points: {O: [0, 0]}}
  one: {points: {O: [0, 0]}, inertia: 1.5}
  two: {points: {O: [0, 0]}, inertia: 0.8}
joints:
  A: {type: pin, links: [ground, one], at: O}
  B: {type: pin, links: [ground, two], at: O}
  K: {type: one_way, links: [one, two], at: O, free: ccw}
drives: {A: {effort: 0}, B: {effort: 0}}
start: {A: {position: 0, speed: %g rad/s}, B: {position: 0, speed: %g rad/s}}
"""
UNKNOWN = "drives: {S: {effort: 0}}\nloads: {F: {type: force, on: ram, at: O, value: unknown, direction: 0}}"
WHEEL = da.flywheel_size(100.0, 50.0, Cs=0.02)
STEEP = [{"to": "30 mm", "in": "60 deg", "by": "cycloidal"}, {"to": 0, "in": "60 deg", "by": "cycloidal"}]
SECTION = {"rectangle": [0.02, 0.04], "elasticity": 2e11}


@cache
def engine() -> Any:
    return da.dynamics(da.slider_crank(), positions=12)


@cache
def arm() -> Any:
    return da.member_forces(da.dynamics(da.loads(ARM)), "arm")


def cam(follower: Any, **more: Any) -> Any:
    return da.cam(da.mechanism(cam_machine(follower, **more)), "F")


def started() -> Any:
    return da.loads(FOUR_BAR)


def compiled(text: str, until: Any = "1 s", **more: Any) -> Any:
    return da.compile_motion(da.loads(text), until, **more)


REFUSED: dict[str, Callable[[], Any]] = {
    "unknown joint 'Q'; choose among O2, A, B, guide": lambda: da.pin(engine(), "Q"),
    "unknown joint 'AA'; choose among O2, A, B, guide": lambda: da.bearing(engine(), "AA"),
    "no joint turns about one axis; give the machine a pin": lambda: da.bearings(
        da.dynamics(da.loads(f"{SLIDE}drives: {{S: {{position: 0}}}}"))
    ),
    "2 values are given for 12 positions; give one value per position": lambda: harmonics(
        [1.0, 2.0], np.arange(12) * np.pi / 6
    ),
    "harmonics are taken over the turn of a drive, and there is none; drive a joint": lambda: turning_angle(
        da.statics(da.loads(HELD))
    ),
    "unknown moving link 'rodd'; did you mean 'rod'?": lambda: da.shaking(engine(), links=["rodd"]),
    "(0.0, 0.0, 0.0) is not a point; give 2 numbers, in metres": lambda: da.shaking(
        engine(), about=(0.0, 0.0, 0.0)
    ),
    "counterweight on crank: a disc is density, thickness, largest radius; give three numbers": lambda: (
        da.balance(
            engine(),
            {"crank": da.Counterweight(disc=(7850.0, 0.01))},  # type: ignore[arg-type]
        )
    ),
    "'forces' is not an objective; choose among force, moment, torque": lambda: da.balance(
        engine(), ["crank"]
    ).trade_off("forces"),
    "'torques' is not an objective; choose among force, moment, torque": lambda: da.balance(
        engine(), ["crank"], of={"torques": 1}
    ),
    'no objective to minimise is given; write of="force"': lambda: da.balance(
        engine(), ["crank"], of={"force": 0}
    ),
    "no drive has a torque that could be balanced; balance force or moment": lambda: da.balance(
        da.statics(da.loads(HELD)), ["bar"], of="torque"
    ),
    "3 of two: plane; give one for each of the two planes": lambda: da.balance_rotor(
        da.rotating_shaft(),
        (0.1, 0.2, 0.3),  # type: ignore[arg-type]
        (0.1, 0.1),
    ),
    "1 of two: radius; give one for each of the two planes": lambda: da.balance_rotor(
        da.rotating_shaft(), (0.1, 0.2), (0.1,)
    ),
    "rod does not turn with crank; a rotor is what turns about one axis": lambda: da.balance_rotor(
        da.rssr(), (0.1, 0.2), (0.1, 0.1)
    ),
    "a rotor needs a drive that turns it; drive its shaft": lambda: da.balance_rotor(
        da.loads(WELDED), (0.1, 0.2), (0.1, 0.1)
    ),
    "unknown drive 'sleev'; the only one is 'O'": lambda: da.governor(da.porter_governor(), drive="sleev"),
    "unknown joint 'sleev'; choose among O, B, S, axis": lambda: da.governor(
        da.porter_governor(), sleeve="sleev"
    ),
    "no drive positions the governor; drive the sleeve or an arm": lambda: da.governor(
        da.loads(f"turning: {{axis: y, speed: 10 rad/s}}{HELD}")
    ),
    (
        "the governor has no speed in part of its range: No speed of turning gives O its effort between 10 deg and "
        "177.833 deg of O: the centrifugal forces would have to pull towards the axis. Change the range of the motion, "
        "the loads or the effort.; change the range"
    ): lambda: da.governor(da.porter_governor(), range=("10 deg", "200 deg")),
    "a disc is sized by its radius or its thickness; give one of them": lambda: WHEEL.disc(7850.0),
    "a rim is sized by the breadth or the height of its section; give one of them": lambda: WHEEL.rim(
        7850.0, 0.1, 0.1, 0.1
    ),
    "a rim 0.21 m high reaches beyond its axis; give less height or more radius": lambda: WHEEL.rim(
        7850.0, 0.1, height=0.21
    ),
    "a flywheel at 0 rad/s keeps no energy; give the mean speed": lambda: da.flywheel_size(100.0, 0.0, 0.02),
    "unknown drive 'Q'; the only one is 'O2'": lambda: da.flywheel(engine(), drive="Q"),
    "drive 'S' slides, and a flywheel turns; drive the shaft": lambda: da.flywheel(
        da.dynamics(da.loads(f"{SLIDE}drives: {{S: {{position: {{from: 0, to: 1, count: 4}}, speed: 1}}}}"))
    ),
    (
        "a flywheel needs a machine with one drive, whose effort is unknown; leave one drive, without effort, and no "
        "unknown load"
    ): lambda: da.flywheel(da.dynamics(da.five_bar(), positions=4)),
    "unknown motion curve 'cycloid'; did you mean 'cycloidal'?": lambda: da.law(
        da.four_bar(), "O2", by="cycloid"
    ),
    "drive 'O2' has no law of motion; write law: {segments: [...]}": lambda: da.law(da.four_bar(), "O2"),
    "unknown drive 'O3'; the only one is 'O2'": lambda: da.law(da.four_bar(), "O3"),
    "the law of drive 'S' is an expression, which has no segments; read its motion from a result": lambda: (
        da.law(
            da.loads(
                f"{SLIDE}drives: {{S: {{law: {{expression: 0.1*sin(6 rad/s*time), duration: 1, count: 3}}}}}}"
            ),
            "S",
        )
    ),
    "the machine has no drive, and a motor turns one; drive a joint": lambda: da.motor(
        da.statics(da.loads(HELD))
    ),
    "unknown moving link 'arn'; the only one is 'arm'": lambda: da.member_forces(arm().result, "arn"),
    "link 'arm' has no member 'AB'; the only one is 'O-A'": lambda: arm().curve("AB"),
    "0.7 m is not along member O-A; give 0 to 0.6 m": lambda: arm().curves[0].at(0.7),
    "link 'rod' has no section; give it one: section: {rectangle: [20 mm, 40 mm]}": lambda: da.member_forces(
        engine(), "rod"
    ).stress(),
    "the section of 'arm' has no elasticity; give elasticity: 210 GPa": lambda: arm().deflection(),
    "link 'arm' has no joint 'A'; the only one is 'O'": lambda: arm().deflection(SECTION, supports=["A"]),
    "3 supports do not give one line; name one or two joints": lambda: arm().deflection(
        SECTION, supports=["O"] * 3
    ),
    "a knife edge has no radius: its pressure is without limit; take a roller or a face": lambda: cam(
        "knife"
    ).hertz(0.01),
    "the preload 1 does not close the cam at rest, which needs 700; raise it, or leave it out": lambda: cam(
        {"roller": "8 mm"}
    ).spring_for(preload=1.0, least=1000.0),
    (
        "with friction the normal force is not linear in a spring's force; write friction: {enabled: false}, and "
        "allow for friction in least"
    ): lambda: cam("knife", friction={"coefficient": 0.1}).spring_for(),
    "these are not equilibrium positions; give a drive position: unknown and its effort": lambda: (
        da.small_swings(engine())
    ),
    "drive 'O2' is not a cylinder; write cylinder: {...} of a drive": lambda: engine().cylinder("O2"),
    "drive 'lifts' is not a cylinder; the only one is 'C'": lambda: da.statics(da.cylinder_boom()).cylinder(
        "lifts"
    ),
    # motion under forces
    'the simulation has no end; write until="2 s"': lambda: da.simulate(started(), []),
    "the condition 'O3.speed = 3' names no drive; the only one is 'O2'": lambda: da.simulate(
        started(), "O3.speed = 3"
    ),
    "the condition 'O4.speed = 3' names no drive; the only one is 'O2'": lambda: compiled(
        FOUR_BAR, ["O4.speed = 3", "1 s"]
    ),
    '\'speed > 3\' is not a condition; write "O2.speed = 0 rad/s" or "O2.position = 90 deg"': lambda: (
        compiled(FOUR_BAR, ["speed > 3", "1 s"])
    ),
    "0 is not a number of steps; ask for 1 or more": lambda: da.simulate(started(), "1 s", steps=0),
    "2.5 is not a number of steps; ask for 1 or more": lambda: da.simulate(started(), "1 s", steps=2.5),  # type: ignore[arg-type]
    (
        "no drive is free: none has a start, a motor or an effort; write start: {O2: {position: 60 deg, speed: 0}}, "
        "with the name of a drive"
    ): lambda: da.simulate(da.four_bar(), "1 s"),
    "load 'F' is unknown, but forces move the machine; give it a value": lambda: da.simulate(
        da.loads(f"{SLIDE}{UNKNOWN}\nstart: {{S: {{position: 0, speed: 0}}}}"), "1 s"
    ),
    "drive 'T' has no position to start at; write start: {T: {position: ..., speed: 0}}": lambda: da.simulate(
        da.loads(
            CROSS % ("", "") + "drives: {S: {effort: 1}, T: {position: unknown, effort: 0, range: [0, 1]}}"
        ),
        "1 s",
    ),
    "K starts to turn in the sense that it blocks; start with other speeds": lambda: da.simulate(
        da.loads(FREEWHEEL % (6, 5.9)), "1 s"
    ),
    (
        "cylinder 'C' has losses and both pressures, and a motion under forces leaves such losses out; leave its "
        "efficiency and friction out, or give the joint it moves friction"
    ): lambda: da.simulate(da.loads(CYLINDER), "1 s"),
    'a motion whose condition is never met has no end; add a time: until=["5 s", ...]': lambda: compiled(
        FOUR_BAR, "O2.speed = 1000 rad/s"
    ),
    "a prescribed drive moves beside dry friction or a brake; use da.simulate for such a machine": lambda: (
        compiled(CROSS % (RUBS, "") + "drives: {S: {effort: 1}, T: {position: 0, speed: 1}}")
    ),
    (
        "two or more drives that move freely have dry friction or brakes, and each of them may stick; use da.simulate "
        "for such a machine"
    ): lambda: compiled(CROSS % (RUBS, BOTH) + "drives: {S: {effort: 1}, T: {effort: 1}}"),
    "drive 'T' has a law of motion, whose acceleration changes; use da.simulate for such a machine": lambda: (
        compiled(
            CROSS % ("", "")
            + "drives: {S: {effort: 1}, T: {law: {type: harmonic, from: 0, to: 0.1, duration: 1, count: 3}}}"
        )
    ),
    "'effort.S' was not compiled; compile with outputs=[..., 'effort.S']": lambda: compiled(
        BESIDE, outputs=["effort.T"]
    )().value("effort.S"),
}
"""The sentence, and what is asked."""


@pytest.mark.parametrize("sentence", REFUSED)
def test_a_machine_that_lacks_something_is_told_what(sentence: str) -> None:
    with pytest.raises(DalembertError) as refused:
        REFUSED[sentence]()
    assert re.sub(r"^text:\d+: ", "", str(refused.value)) == sentence


def test_a_free_wheel_may_turn_in_its_free_sense() -> None:
    s = da.simulate(da.loads(FREEWHEEL % (5.9, 6)), "1 s", count=2)
    assert s.speed("B")[-1] == pytest.approx(6.0)


def test_a_cutter_larger_than_the_hollow_of_a_cam_is_refused(tmp_path: Any) -> None:
    c = cam({"roller": "8 mm"}, segments=[*STEEP, {"dwell": "rest"}])
    hollow = -c.profile_radius(np.linspace(0, 2 * np.pi / 3, 20_001))
    least = float(hollow[hollow > 0].min())
    with pytest.raises(DalembertError) as refused:
        c.save(tmp_path / "cam.csv", tolerance=1e-5, cutter=0.5)
    found = float(str(refused.value).split(" of ")[2].split(" mm")[0])
    assert found == pytest.approx(1e3 * least, rel=2e-3)  # of the corners of the outline, and rounded
    assert str(refused.value) == (
        f"a cutter of 500 mm does not fit the hollow of {found:.6g} mm; take a smaller one"
    )
    assert list(tmp_path.iterdir()) == []
    c.save(tmp_path / "cam.csv", tolerance=1e-4, cutter=0.999 * least)
