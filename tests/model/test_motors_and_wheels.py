"""Motors by their curves and behind gears; belts, ropes, clutches, parameters and expressions: each rule by hand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from dalembert.errors import ModelError
from dalembert.model import Belt, Expression, OneWay, Ratchet, mechanism
from dalembert.model.drives.motors import MotorCurve, motor_curve
from dalembert.model.joints.elements.one_way_joints import released
from dalembert.model.joints.elements.ropes import Sheave, StrandJoint
from dalembert.model.part import ReadingRules

RULES = ReadingRules()
BENT = MotorCurve((-10.0, 5.0, 25.0), (9.0, 6.0, -4.0))
LINE = MotorCurve((0.0, -30.0), (-12.0, 0.0), straight=True)


def refused(call: Any, *arguments: Any, **keys: Any) -> str:
    with pytest.raises(ModelError) as caught:
        call(*arguments, **keys)
    return f"{caught.value.what}; {caught.value.remedy}"


def test_effort_of_a_motor_over_its_speed() -> None:
    assert [BENT.at(v) for v in (-20.0, -10.0, 0.0, 5.0, 15.0, 25.0, 40.0)] == [9, 9, 7, 6, 1, -4, -4]
    assert [LINE.at(v) for v in (10.0, 0.0, -10.0, -30.0, -60.0)] == [-16, -12, -8, 0, 12]
    assert BENT.at(np.array([0.0, 15.0])).tolist() == [7, 1]  # type: ignore[union-attr]
    assert (BENT.kinks, LINE.kinks) == ((-10.0, 5.0, 25.0), ())
    assert (BENT.fastest, LINE.fastest) == (25.0, -30.0)
    assert MotorCurve((-30.0, 5.0), (9.0, 6.0)).fastest == -30.0


@pytest.mark.parametrize(
    ("speed", "ahead", "effort", "slope"),
    [
        (-20.0, 1.0, 9.0, 0.0),
        (-10.0, -1.0, 9.0, 0.0),
        (-10.0, 1.0, 7.0, -0.2),
        (0.0, 1.0, 7.0, -0.2),
        (5.0, -1.0, 7.0, -0.2),
        (5.0, 1.0, 8.5, -0.5),
        (15.0, -1.0, 8.5, -0.5),
        (25.0, -1.0, 8.5, -0.5),
        (25.0, 1.0, -4.0, 0.0),
        (40.0, -1.0, -4.0, 0.0),
    ],
)
def test_the_line_that_a_motor_is_on(speed: float, ahead: float, effort: float, slope: float) -> None:
    assert BENT.line(speed, ahead) == pytest.approx((effort, slope))
    assert LINE.line(speed, ahead) == pytest.approx((-12, -0.4))


def test_a_motor_behind_a_gear() -> None:
    motor = MotorCurve(
        (0.0, 300.0), (2.0, 0.0), True, ratio=12.0, inertia=0.1, efficiency=0.9, time_constant=0.02
    )
    assert motor.geared
    assert motor.keys == {
        "stall": 2.0,
        "no_load": 300.0,
        "ratio": 12.0,
        "inertia": 0.1,
        "efficiency": 0.9,
        "time_constant": 0.02,
    }
    at_drive = motor.at_drive
    assert (at_drive.speed, at_drive.effort) == ((0.0, 25.0), (24.0, 0.0))
    assert (at_drive.geared, at_drive.time_constant) == (False, 0.02)
    for key, value in (("ratio", 5.0), ("inertia", 0.2), ("efficiency", 0.8), ("time_constant", 0.03)):
        assert getattr(motor.with_key(key, value), key) == value
    assert motor.with_key("stall", 3.0).effort == (3.0, 0.0)
    assert motor.with_key("no_load", 200.0).speed == (0.0, 200.0)
    assert (BENT.keys, LINE.keys) == ({}, {"stall": -12.0, "no_load": -30.0})


TREES: list[tuple[str, dict[str, Any]]] = [
    ("angle", {"stall": "2.0 N*m", "no_load": "30.0 rad/s", "on": "0.5 s", "off": "1.5 rad"}),
    ("length", {"stall": "-2.0 N", "no_load": "-3.0 m/s", "on": "0.5 m", "off": "1.5 m/s"}),
    (
        "angle",
        {
            "curve": {"speed": ["0.0 rad/s", "3.0 rad/s"], "torque": ["2.0 N*m", "1.0 N*m"]},
            "off": "2.0 rad/s",
        },
    ),
    (
        "length",
        {"curve": {"speed": ["0.0 m/s", "3.0 m/s"], "force": ["2.0 N", "1.0 N"]}, "time_constant": "0.2 s"},
    ),
    (
        "length",
        {
            "stall": "2.0 N*m",
            "no_load": "30.0 rad/s",
            "off": "1.5 m/s",
            "ratio": 20.0,
            "inertia": "0.1 kg*m^2",
            "efficiency": 0.9,
        },
    ),
]


@pytest.mark.parametrize(("kind", "tree"), TREES)
def test_a_motor_is_written_as_it_was_read(kind: str, tree: dict[str, Any]) -> None:
    motor = motor_curve(tree, kind, RULES)
    assert motor.tree(kind) == tree
    assert motor_curve(motor, kind, RULES) is motor
    assert motor.straight == ("stall" in tree)


GIVE = (
    "a motor needs stall and no_load, or a curve; write motor: {stall: 40 N*m, no_load: 30 rad/s}, or {curve:"
)
CURVE = {"speed": [0, 1, 2], "torque": [5, 4, 3]}


@pytest.mark.parametrize(
    ("kind", "keys", "says"),
    [
        ("angle", {}, GIVE),
        ("angle", {"stall": 2}, GIVE),
        ("angle", {"stall": 2, "no_load": 3, "curve": CURVE}, GIVE),
        ("angle", {"stall": 2, "curve": CURVE}, GIVE),
        (
            "angle",
            {"stall": 2, "no_load": -3},
            "a motor that stalls at 2 and runs free at -3 does not drive; give both the same sign",
        ),
        ("angle", {"stall": 0, "no_load": 3}, "a motor that stalls at 0 and runs free at 3 does not drive"),
        (
            "angle",
            {"curve": CURVE, "ratio": 0},
            "the ratio of the gear is 0; write the speed of the motor over that of the drive",
        ),
        (
            "angle",
            {"curve": CURVE, "inertia": -1},
            "the inertia of the motor is negative; write a positive one, or 0",
        ),
        (
            "angle",
            {"curve": CURVE, "efficiency": 1.1},
            "the efficiency of the gear is 1.1; write a number above 0",
        ),
        (
            "angle",
            {"curve": CURVE, "efficiency": 0},
            "the efficiency of the gear is 0; write a number above 0",
        ),
        (
            "length",
            {"stall": 2, "no_load": 3, "inertia": 1},
            "a motor with inertia turns, and its drive slides; give the ratio",
        ),
        (
            "angle",
            {"curve": CURVE, "time_constant": -1},
            "the time constant of the motor is negative; write the inductance",
        ),
        (
            "angle",
            {"curve": {"speed": [0, 1]}},
            "the curve has no torque; write curve: {speed: [...], torque: [...]}",
        ),
        (
            "length",
            {"curve": {"speed": [0, 1]}},
            "the curve has no force; write curve: {speed: [...], force: [...]}",
        ),
        (
            "angle",
            {"curve": CURVE | {"speed": [0, 1]}},
            "the curve has 2 speeds and 3 values of torque; give lists of equal length",
        ),
        (
            "angle",
            {"curve": {"speed": [0], "torque": [1]}},
            "the curve has 1 speeds and 1 values of torque; give",
        ),
        (
            "angle",
            {"curve": CURVE | {"speed": [0, 1, 1]}},
            "speeds of the curve must increase: point 3 is not at a greater speed than point 2",
        ),
        (
            "angle",
            {"curve": CURVE | {"speed": [1, 0, 2]}},
            "speeds of the curve must increase: point 2 is not at a greater speed than point 1",
        ),
    ],
)
def test_a_motor_that_cannot_be(kind: str, keys: dict[str, Any], says: str) -> None:
    assert says in refused(motor_curve, keys, kind, RULES)
    assert motor_curve({"curve": CURVE, "efficiency": 1, "inertia": 0}, "angle", RULES).geared is False


BELT: dict[str, Any] = {"links": ("a", "b"), "radii": (0.1, 0.3)}


def test_tensions_of_a_belt() -> None:
    for name in ("tension", "tensioner", "tight", "slack"):
        assert Belt(**BELT, **{name: 40.0}).stated_tension == (name, 40.0)
    chain = Belt(**BELT, chain=True)
    assert chain.stated_tension == ("slack", 0.0)
    assert (chain.wheels, chain.internal, chain.pitch_radii, chain.signed_radii) == (
        2,
        False,
        (0.1, 0.3),
        (0.1, -0.3),
    )
    assert Belt(**BELT, crossed=True, slack=1.0).signed_radii == (0.1, 0.3)
    assert Belt(**BELT, slack=1.0).closed("J") is None


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ({}, "its tension is missing: the torque gives the difference of both strands only; write tension"),
        (
            {"tight": 2, "slack": 1},
            "tight and slack are both given, and each gives the sum of the tensions; keep one of them",
        ),
        ({"chain": True, "crossed": True}, "a chain cannot be crossed; leave crossed out, or use a belt"),
        (
            {"chain": True, "friction": {"coefficient": 0.1}},
            "a chain holds by its teeth and has no friction; leave it out",
        ),
        ({"chain": True, "groove": 0.5}, "a chain holds by its teeth and has no groove; leave it out"),
        (
            {"slack": 1, "groove": 3.16},
            "the groove is wider than 180 deg; 38 deg is usual; leave it out for a flat belt",
        ),
        (
            {"crossed": True, "idlers": [{"at": "c.C", "radius": 1, "strand": "left"}]},
            "a crossed belt has no idlers; leave crossed or",
        ),
        (
            {"slack": 1, "idlers": [{"at": "c.C", "radius": 1, "strand": "left"}]},
            "slack is given beside idlers, of which one gives",
        ),
    ],
)
def test_a_belt_that_cannot_be(keys: dict[str, Any], says: str) -> None:
    assert says in refused(Belt, **BELT, **keys)


def test_a_belt_with_idlers_goes_there_and_back() -> None:
    """Clockwise: along the left strand in the order of its idlers, along the right one in the opposite order."""
    idlers = [
        {"at": f"c.{n}", "radius": k + 1, "strand": s}
        for k, (n, s) in enumerate(zip("PQRS", ("left", "right") * 2, strict=True))
    ]
    belt = Belt(**BELT, at=("A", "B"), idlers=idlers, groove=0.6)
    ring = belt.closed("J")
    assert ring is not None
    assert [point.round for point in ring.through] == [
        ("a", "A"),
        ("c", "P"),
        ("c", "R"),
        ("b", "B"),
        ("c", "S"),
        ("c", "Q"),
        ("a", "A"),
    ]
    assert [point.radius for point in ring.through] == [0.1, 1, 3, 0.3, 4, 2, 0.1]
    assert (ring.through[0].pulley, ring.through[3].side) == (False, "left")
    assert ring.wedge == pytest.approx(math.sin(0.3))
    assert Belt(**BELT, at=("A", "B"), idlers=idlers).closed("J").wedge == 1.0  # type: ignore[union-attr]
    assert [place[:3] for place in belt.places("J")][2:] == [
        ("c", n, ("idlers", k, "at")) for k, n in enumerate("PQRS")
    ]


def test_strands_sheaves_and_clutches() -> None:
    strand = StrandJoint(type="strand", links=("a", "b"), radii=(-0.2, 0.3))
    assert (strand.pitch_radii, strand.wheels, strand.internal) == ((0.2, 0.3), 2, False)
    assert StrandJoint(type="strand", links=("a", "b"), radii=(0.2, -0.3)).pitch_radii == (0.2, 0.3)
    sheave = Sheave(type="sheave", links=("a", "b"), efficiency=0.9)
    assert sheave.friction is not None
    assert sheave.friction.coefficient == pytest.approx(0.2 / 1.9)
    assert Sheave(type="sheave", links=("a", "b")).friction is None
    ratchet = Ratchet(links=("a", "b"), free="cw", teeth=24, pawl={"radius": 0.4})
    assert (ratchet.way, ratchet.hinge, ratchet.reach) == (-1.0, False, 0.4)
    assert ratchet.pitch == pytest.approx(math.pi / 12)
    one_way = OneWay(links=("a", "b"), free="ccw")
    assert (one_way.way, one_way.pitch, one_way.reach) == (1.0, 0.0, 0.0)
    for joint in (ratchet, one_way):
        free = released(joint)
        assert (joint.RELEASED, free.RELEASED, free.freedoms, joint.freedoms) == (False, True, ("turn",), ())
        assert (free.way, free.pitch, free.stops.kind) == (joint.way, joint.pitch, "angle")  # type: ignore[attr-defined]
    assert Ratchet(links=("a", "b"), free="cw", teeth=24).reach == 0.0


def of(parameters: dict[str, Any], mass: Any = 1, **more: Any) -> Any:
    return mechanism(
        {"units": {"length": "mm"}, "parameters": parameters, "links": {"ground": {}, "a": {"mass": mass}}}
        | more
    )


@pytest.mark.parametrize(
    ("parameters", "says"),
    [
        (
            {"p": "2*a", "a": "b", "b": "c", "c": "a"},
            "it follows from itself: a from b from c from a; give one of them a value",
        ),
        ({"p": {"value": "45 mm", "range": [1]}}, "a list is not a range; write range: [22.5 mm, 90 mm]"),
        (
            {"p": {"value": "45 mm", "range": [50, 50]}},
            "a range is two increasing values; write range: [22.5 mm, 90 mm]",
        ),
        (
            {"p": {"value": "45 mm", "range": ["1 s", "2 s"]}},
            "'1 s' is a time, but a length is needed; write for example 45 mm",
        ),
        ({"p": {"value": 3, "abuot": "x"}}, "unknown key 'abuot'; did you mean 'about'?"),
        ({"p": {"about": "x"}}, "the key 'value' is missing; write {value: 45 mm, about: ...}"),
        ({"p": {"value": 3, "about": 4}}, "4 is not text; put it in quotes"),
        ({"p": "2*foo"}, "'2*foo' uses 'foo', which is not a parameter;"),
    ],
)
def test_a_parameter_that_cannot_be(parameters: dict[str, Any], says: str) -> None:
    assert says in refused(of, parameters)


def test_parameters_and_their_ranges() -> None:
    m = of({"r": {"value": "45 mm", "range": [20, "0.08 m"]}, "k": 3, "q": "2*r + 1 mm"}, mass="k*2 kg")
    known = m.parameters
    assert (known["r"].value, known["r"].range, known["r"].in_unit()) == (0.045, (0.02, 0.08), 45.0)
    assert float(known["q"].value) == pytest.approx(0.091)
    assert (known["r"].kind, known["k"].kind, known["k"].in_unit(5.0)) == ("length", "number", 5.0)
    assert m.mass("a") == 6.0
    changed = m.with_values({"k": 5, "r": "60"})
    assert changed.mass("a") == 10.0
    assert "'3 s' is a time, but a length is needed; write for example 45 mm" in refused(
        m.with_values, {"r": "3 s"}
    )


@pytest.mark.parametrize(
    ("text", "drives", "says"),
    [
        (
            "1/O",
            {"O": np.array([2.0, 0.0, 0.0])},
            "the expression '1/O' has no finite value at O = 0; change it, or the range of the drive",
        ),
        (
            "log(S)/O",
            {"O": np.array([1.0, 2.0, 3.0]), "S": np.array([4.0, -5.5, -6.0])},
            "the expression 'log(S)/O' has no finite value at O = 2, S = -5.5; change it, or the range of the drive",
        ),
        ("1/0", {}, "the expression '1/0' has no finite value anywhere; change it, or what it follows from"),
    ],
)
def test_an_expression_without_a_finite_value(text: str, drives: dict[str, Any], says: str) -> None:
    assert refused(Expression(text).at, drives) == says


def test_numbers_and_names_of_an_expression() -> None:
    expression = Expression("500*sin(O2) + .5*time - 1e3*links.rod.angle.speed", "kN")
    assert expression.numbers == {"500", ".5", "1e3"}
    assert expression.names == {"O2", "time", "links.rod.angle.speed"}
    at = {"O2": 0.5, "time": 4.0, "links.rod.angle.speed": 0.25}
    assert expression.at(at) == pytest.approx(1e3 * (500 * math.sin(0.5) + 2 - 250))
