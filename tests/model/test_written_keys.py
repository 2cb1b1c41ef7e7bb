"""Keys that few files have, as they are written: in SI, with units, and read back equal."""

from __future__ import annotations

import math
from copy import deepcopy
from typing import Any

import pytest

import dalembert as da
from dalembert.model import loads

QUARTER, SIXTH, TEN = "1.5707963267948966 rad", "0.5235987755982988 rad", "0.17453292519943295 rad"
BASE: dict[str, Any] = {
    "units": {"length": "mm", "force": "N", "mass": "kg", "moment": "N*m"},
    "links": {
        "ground": {"points": {"O": [0, 0], "S": [100, 0]}},
        "crank": {"points": {"O": [0, 0], "A": [50, 0], "B": [0, 30]}, "mass": 2},
        "block": {"points": {"S": [0, 0], "P": [10, 0]}, "mass": 1},
    },
    "joints": {
        "O": {"type": "pin", "links": ["ground", "crank"]},
        "S": {"type": "slider", "links": ["ground", "block"], "direction": 30},
    },
    "drives": {"O": {"position": 0, "speed": "3 rad/s"}, "S": {"position": 0, "speed": "2 m/s"}},
    "loads": {},
    "start": {"O": {"position": 0}},
}
SPAN = {"between": ["ground.O", "block.P"]}
COUPLE = {"type": "couple", "on": "crank"}
ARCS = [{"center": [0, 1], "radius": 30, "to": 10}, {"center": [2, 0], "radius": -40, "to": "1 rad"}]
CAM = {"type": "cam", "links": ["crank", "block"], "at": ["O", "P"]}
SHOE = {
    "type": "shoe",
    "links": ["ground", "crank"],
    "at": ["O", "A"],
    "radius": 50,
    "friction": {"coefficient": 0.3},
}
WRITTEN: dict[str, tuple[str, Any, Any]] = {
    "a mirrored point": (
        "links.crank.points.C",
        {"from": "A", "mirror": 30, "about": "B"},
        {"from": "A", "mirror": SIXTH, "about": "B"},
    ),
    "a turned point": (
        "links.crank.points.C",
        {"from": "A", "turn": 30, "about": "B", "at": [3, 4]},
        {"from": "A", "turn": SIXTH, "about": "B", "at": ["0.003 m", "0.004 m"]},
    ),
    "one notch factor": (
        "links.crank.section",
        {"rectangle": [10, 20], "notch": 1.8},
        {"rectangle": ["0.01 m", "0.02 m"], "notch": 1.8},
    ),
    "notch factors of points": (
        "links.crank.section",
        {"circle": 20, "notch": {"A": 1.8, "B": 2}},
        {"circle": "0.02 m", "notch": {"A": 1.8, "B": 2.0}},
    ),
    "a stop below that gives back": ("joints.S.contact", {"pushes": "from below", "restitution": 0.4}, ...),
    "a stop below": ("joints.S.contact", {"pushes": "from below"}, ...),
    "a push that gives back": ("joints.S.contact", {"pushes": True, "restitution": 0.4}, ...),
    "a pull that gives back": ("joints.S.contact", {"pulls": True, "restitution": 0.4}, ...),
    "stops of a guide": (
        "joints.S.stops",
        {"from": -10, "to": 20, "restitution": 0.3},
        {"from": "-0.01 m", "to": "0.02 m", "restitution": 0.3},
    ),
    "one stop of a drive": (
        "drives.O.stops", {"to": 10, "restitution": 0.3}, {"to": TEN, "restitution": 0.3}
    ),
    "friction of a guide": (
        "joints.S.friction",
        {"coefficient": 0.1, "guide": [20, 30], "force": 5},
        {"coefficient": 0.1, "guide": ["0.02 m", "0.03 m"], "force": "5.0 N"},
    ),
    "a spring by a table": (
        "loads.F",
        SPAN | {"type": "spring", "free_length": 20, "force": {"x": [-10, 0, 10], "y": [-5, 0, 20]}},
        {"type": "spring", **SPAN, "stiffness": "0.0 N/m", "free_length": "0.02 m"}
        | {"force": {"x": ["-0.01 m", "0.0 m", "0.01 m"], "y": ["-5.0 N", "0.0 N", "20.0 N"]}},
    ),
    "a damper by a table": (
        "loads.F",
        SPAN | {"type": "damper", "force": {"x": ["-1 m/s", "0 m/s", "2 m/s"], "y": [-5, 0, 20]}},
        {"type": "damper", **SPAN, "damping": "0.0 N*s/m"}
        | {"force": {"x": ["-1.0 m/s", "0.0 m/s", "2.0 m/s"], "y": ["-5.0 N", "0.0 N", "20.0 N"]}},
    ),
    "a table that is zero outside": (
        "loads.T",
        COUPLE | {"value": {"against": "O", "x": [0, 90], "y": [1, 2], "outside": "zero"}},
        COUPLE | {"value": {"against": "O", "x": ["0.0 rad", QUARTER], "y": ["1.0 N*m", "2.0 N*m"], "outside": "zero"}},
    ),
    "a table that is held outside, shifted and smooth": (
        "loads.T",
        COUPLE | {"value": {"against": "O", "x": [0, 90], "y": [1, 2], "outside": "hold", "shift": 10}
                  | {"interpolate": "cubic"}},
        COUPLE | {"value": {"against": "O", "x": ["0.0 rad", QUARTER], "y": ["1.0 N*m", "2.0 N*m"]}
                  | {"shift": TEN, "interpolate": "cubic", "outside": "hold"}},
    ),
    "a spline": (
        "drives.O",
        {"law": {"segments": [{"by": "spline", "time": [0, 1, 2, 3], "position": [0, 10, 30, 90]}]}},
        {"freedom": "turn", "law": {"segments": [
            {"by": "spline", "time": ["0.0 s", "1.0 s", "2.0 s", "3.0 s"], "position": ["0.0 rad", TEN, SIXTH, QUARTER]}
        ], "count": 181}},
    ),
    "rates at the ends of a segment": (
        "drives.O",
        {"law": {"segments": [{"to": 90, "in": "1 s", "by": "polynomial"}
                 | {"ends": {"speed": ["1 rad/s", "0 rad/s"], "acceleration": ["3 rad/s^2", "2 rad/s^2"]}}]}},
        {"freedom": "turn", "law": {"segments": [{"to": QUARTER, "by": "polynomial", "in": "1.0 s"}
            | {"ends": {"speed": ["1.0 rad/s", "0.0 rad/s"], "acceleration": ["3.0 rad/s^2", "2.0 rad/s^2"]}}],
            "count": 181}},
    ),
    "a law of slides by an expression": (
        "drives.S",
        {"law": {"expression": "10 mm*sin(3 rad/s*time) - 3 mm", "duration": "2 s", "count": 5}},
        {"freedom": "slide", "law": {"expression": "10 mm*sin(3 rad/s*time) - 3 mm", "duration": "2.0 s", "count": 5}},
    ),
    "a geared motor that is switched": (
        "drives.O",
        {"motor": {"stall": 20, "no_load": "10 rad/s", "on": "0.5 s", "off": 90, "ratio": 5, "efficiency": 0.9}
                  | {"inertia": "3e-3 kg*m^2", "time_constant": "10 ms"}},
        {"freedom": "turn", "motor": {"stall": "20.0 N*m", "no_load": "10.0 rad/s", "on": "0.5 s", "off": "90.0 s"}
            | {"ratio": 5.0, "inertia": "0.003 kg*m^2", "efficiency": 0.9, "time_constant": "0.01 s"}},
    ),
    "a motor by its curve": (
        "drives.O",
        {"motor": {"curve": {"speed": [0, "10 rad/s"], "torque": [20, 0]}, "off": "5 rad/s"}},
        {"freedom": "turn"}
        | {"motor": {"off": "5.0 rad/s"}
            | {"curve": {"speed": ["0.0 rad/s", "10.0 rad/s"], "torque": ["20.0 N*m", "0.0 N*m"]}}},
    ),
    "a cam of arcs": (
        "joints.F",
        CAM | {"follower": {"roller": 5}, "profile": {"arcs": ARCS}},
        CAM | {"follower": {"roller": "0.005 m"}, "profile": {"arcs": [
            {"center": ["0.0 m", "0.001 m"], "radius": "0.03 m", "to": TEN},
            {"center": ["0.002 m", "0.0 m"], "radius": "-0.04 m", "to": "1.0 rad"}]}},
    ),
    "a cam of points": (
        "joints.F",
        CAM | {"follower": "knife", "profile": {"points": {"angle": [0, 10, 30, 90], "radius": [9, 8, 7, 6]}}},
        CAM | {"follower": "knife", "profile": {"points": {
            "angle": ["0.0 rad", TEN, SIXTH, QUARTER], "radius": ["0.009 m", "0.008 m", "0.007 m", "0.006 m"]}}},
    ),
    "the heat of a brake": (
        "joints.F",
        SHOE | {"heat": {"mass": 2, "capacity": "0.46 kJ/(kg*K)"}},
        SHOE | {"radius": "0.05 m", "heat": {"mass": "2.0 kg", "capacity": "460.0 J/(kg*K)"}},
    ),
}  # fmt: skip


def made(path: str, value: Any, **more: Any) -> tuple[da.Mechanism, list[str]]:
    """The mechanism with a value at a path, and the path."""
    tree = deepcopy(BASE) | more
    *way, last = path.split(".")
    here = tree
    for key in way:
        here = here[key]
    here[last] = value
    return da.mechanism(tree), [*way, last]


@pytest.mark.parametrize("name", WRITTEN)
def test_a_key_is_written_in_si_and_read_back_equal(name: str) -> None:
    path, value, written = WRITTEN[name]
    m, way = made(path, value)
    found: Any = m.to_tree()
    for key in way:
        found = found[key]
    assert found == (value if written is ... else written)
    assert loads(str(m)) == m


RISE = {"to": 90, "in": "1 s", "by": "polynomial"}


@pytest.mark.parametrize(("path", "value"), [
    ("drives.O", {"position": [0, 1], "speed": ["0 rad/s", "3 rad/s"]}),
    ("drives.O", {"position": [0, 1], "speed": "1 rad/s", "acceleration": ["2 rad/s^2", "0 rad/s^2"]}),
    ("drives.O", {"law": {"segments": [RISE | {"ends": {"speed": ["1 rad/s", "0 rad/s"]}}]}}),
    ("drives.O", {"law": {"segments": [{"speed": "0 rad/s", "in": "1 s"}]}}),
    ("drives.O", {"motor": {"curve": {"speed": ["-3 rad/s", "0 rpm", "3 rad/s"], "torque": [20, 9, 0]}}}),
    ("loads.T", COUPLE | {"value": {"against": "O.speed", "x": ["0 rad/s", "1 rad/s"], "y": [1, 2]}}),
    ("loads.T", COUPLE | {"value": {"against": "O.speed", "x": ["-1 rad/s", "0 rad/s"], "y": [1, 2]}}),
    ("start", {"O": {"position": 0, "speed": "0 rad/s"}}),
    ("turning", {"axis": "y", "speed": "0 rad/s"}),
])  # fmt: skip
def test_no_speed_is_written_as_it_is_read(path: str, value: Any) -> None:
    """A bare 0 is no speed in any unit, where every other number needs one."""
    m, _ = made(path, value, gravity="none")
    assert loads(str(m)) == m


@pytest.mark.parametrize(("off", "at"), [
    ("0.5 s", ("time", 0.5)), (0.5, ("time", 0.5)), (0, ("time", 0.0)),
    ("90 deg", ("position", math.pi / 2)), ("0 deg", ("position", 0.0)),
    ("2.5 rad", ("position", 2.5)), ("0 rad/s", ("speed", 0.0)), ("300 rpm", ("speed", 10 * math.pi)),
])  # fmt: skip
def test_a_motor_that_is_saved_is_switched_by_what_it_was(off: Any, at: tuple[str, float]) -> None:
    """Of a time, an angle and a speed only the unit says which it is."""
    m, _ = made("drives.O", {"motor": {"stall": 20, "no_load": "10 rad/s", "off": off}})
    for again in (m, loads(str(m)), da.mechanism(m.to_tree())):
        motor = again.drives["O"].motor
        assert motor is not None
        assert motor.off == at


def test_a_motor_that_slides_is_switched_by_what_it_was() -> None:
    for off, at in (("90 mm", ("position", 0.09)), ("0 mm", ("position", 0.0)), ("20 mm/s", ("speed", 0.02))):
        motor = {"motor": {"stall": 20, "no_load": "10 m/s", "on": off}}
        m, _ = made("drives.S", motor, start={"S": {"position": 0}})
        again = loads(str(m)).drives["S"].motor
        assert again is not None
        assert again.on == at
