"""Numbers with a limit: the last one that is allowed is read, the first one beyond it is refused in its words."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

import dalembert as da
from dalembert.model import (
    Belt,
    Drive,
    DriveScrew,
    FluidCylinder,
    Gear,
    GuideFriction,
    Rope,
    Section,
    Shoe,
    Slot,
    SpaceJoint,
    Table,
)
from dalembert.model.files.yaml_text import DEEPEST
from dalembert.model.joints.elements.brake_keys import Button, Clamp
from dalembert.model.joints.elements.cam_profiles import CamProfile
from dalembert.model.joints.elements.pin_keys import PinSize
from dalembert.model.part import ReadingRules
from dalembert.units import file_units

SPACE = ReadingRules(file_units({}), dimension=3)
TWO = {"links": ("ground", "wheel")}
STOPPED = {"position": 0.0, "stops": {"from": -1.0, "to": 1.0}}


def gear(**keys: Any) -> Gear:
    return Gear.model_validate(TWO | {"type": "gear", "radii": (0.1, 0.2)} | keys)


def gear_in_space(**keys: Any) -> Gear:
    tree = TWO | {"type": "gear", "radii": (0.1, 0.2), "axis": [0, 0, 1]} | keys
    return Gear.model_validate(tree, context=SPACE)


def rope(efficiency: float) -> Rope:
    return Rope.model_validate({"type": "rope", "through": ["load.L", "ground.P"], "efficiency": efficiency})


def pulley(efficiency: float) -> Rope:
    wheel = {"round": "ground.P", "radius": 0.1, "efficiency": efficiency}
    return Rope.model_validate({"type": "rope", "through": ["load.L", wheel, "hand.H"]})


def motor(**keys: Any) -> Drive:
    return Drive.model_validate(
        {"position": 0.0, "motor": {"stall": "10 N*m", "no_load": "100 rad/s"} | keys}
    )


def slot(restitution: float) -> Slot:
    contact = {"pushes": True, "restitution": restitution}
    return Slot.model_validate(TWO | {"type": "slot", "contact": contact})


def shoe(begin: float, end: float, pressure: str = "pinned") -> Shoe:
    keys = {"type": "shoe", "at": ("O", "Q"), "radius": 0.15, "width": 0.03, "pressure": pressure}
    return Shoe.model_validate(TWO | keys | {"from": f"{begin!r} rad", "to": f"{end!r} rad"})


def cylinder(**keys: Any) -> FluidCylinder:
    return FluidCylinder.model_validate({"between": ["ground.A", "rod.B"], "bore": 0.1} | keys)


def screw(**keys: Any) -> DriveScrew:
    return DriveScrew.model_validate({"lead": 0.008, "radius": 0.015} | keys)


def belt(groove: float) -> Belt:
    keys = {"type": "belt", "radii": (0.1, 0.2), "tension": 100, "groove": f"{groove!r} rad"}
    return Belt.model_validate(TWO | keys)


def points(angles: list[float], radii: list[float]) -> CamProfile:
    return CamProfile.model_validate({"points": {"angle": [f"{x!r} rad" for x in angles], "radius": radii}})


def tangent(half: float, lift: float = 0.01) -> CamProfile:
    keys = {"base": 0.03, "lift": lift, "half_angle": f"{half!r} rad"}
    return CamProfile.model_validate({"tangent": keys})


def guide(*lengths: float) -> GuideFriction:
    return GuideFriction.model_validate({"coefficient": 0.1, "guide": list(lengths)})


def table(x: list[float], y: list[float], period: Any = None) -> Table:
    return Table("O", tuple(x), tuple(y), "linear", period)


def law(time: list[float], position: list[float], periodic: bool = False) -> Drive:
    keys = {"type": "table", "time": time, "position": position, "count": 3, "periodic": periodic}
    return Drive.model_validate({"law": keys})


def stack(links: Any, layers: Any, thick: Any = None) -> PinSize:
    keys = {"diameter": 0.02, "stack": links, "layers": layers, "thicknesses": thick}
    return PinSize.model_validate({key: value for key, value in keys.items() if value is not None})


def clamp(keys: Any) -> Clamp:
    return Clamp.model_validate(keys)


UNCLEAR = "what presses is not clear; write cylinder: .bore: 40 mm"
OVER = 1 + 1e-6
EFFICIENCY = "an efficiency is greater than 1"
BACK = "restitution is .*write a number from 0 .no rebound. to 1"
TURN = 2 * math.pi
LIMITS: dict[str, tuple[Callable[..., Any], tuple[Any, ...], tuple[Any, ...], str]] = {
    "efficiency of teeth": (lambda x: gear(efficiency=x), (1.0,), (OVER,), "is above 1; write a number above 0"),
    "efficiency of a rope": (rope, (1.0,), (OVER,), EFFICIENCY),
    "efficiency of a pulley": (pulley, (1.0,), (OVER,), EFFICIENCY),
    "efficiency of a cylinder": (lambda x: cylinder(efficiency=x), (1.0,), (OVER,), "would give power"),
    "efficiency and friction": (
        lambda x: cylinder(efficiency=x, friction=5.0), (1.0,), (0.999,), "an efficiency and a friction are given"),
    "efficiency of a motor's gear": (
        lambda x: motor(efficiency=x), (1.0,), (OVER,), "the efficiency of the gear is 1; write a number above 0"),
    "no efficiency of a motor's gear": (
        lambda x: motor(efficiency=x), (1e-9,), (0.0,), "the efficiency of the gear is 0; write a number above 0"),
    "ratio of a motor": (lambda x: motor(ratio=x), (1e-9,), (0.0,), "the ratio of the gear is 0"),
    "inertia of a motor": (lambda x: motor(inertia=x), (0.0,), (-1e-9,), "the inertia of the motor is negative"),
    "lag of a motor": (
        lambda x: motor(time_constant=x), (0.0,), (-1e-9,), "the time constant of the motor is negative"),
    "a motor at no load": (
        lambda x: motor(no_load=f"{x} rad/s"), (1e-6,), (0.0,), "does not drive; give both the same sign"),
    "no rebound": (slot, (0.0,), (-1e-6,), BACK),
    "full rebound": (slot, (1.0,), (OVER,), BACK),
    "no rebound of stops": (
        lambda x: Drive.model_validate({**STOPPED, "stops": {"from": -1.0, "restitution": x}}), (0.0,), (-1e-6,), BACK),
    "full rebound of stops": (
        lambda x: Drive.model_validate({**STOPPED, "stops": {"to": 1.0, "restitution": x}}), (1.0,), (OVER,), BACK),
    "stops apart": (
        lambda a, b: Drive.model_validate({**STOPPED, "stops": {"from": a, "to": b}}), (0.0, 1e-9), (0.5, 0.5),
        "the stops go from 0.5 to 0.5"),
    "helix to the right": (
        lambda x: gear_in_space(helix_angle=f"{x} rad"), (1.4999,), (1.5,), "not between -86 and 86 deg"),
    "helix to the left": (
        lambda x: gear_in_space(helix_angle=f"{x} rad"), (-1.4999,), (-1.5,), "not between -86 and 86 deg"),
    "no pressure angle": (
        lambda x: gear(pressure_angle=f"{x} rad"), (0.0,), (-1e-6,), "not between 0 and 68 deg"),
    "steep pressure angle": (
        lambda x: gear(pressure_angle=f"{x} rad"), (1.1999,), (1.2,), "not between 0 and 68 deg"),
    "internal wheels": (
        lambda a, b: gear(radii=(a, b), internal=True), (0.1, 0.1001), (0.1, 0.1), "as large as the internal wheel"),
    "groove": (belt, (3.1499,), (3.15,), "the groove is wider than 180 deg"),
    "thread angle": (lambda x: screw(thread_angle=f"{x} rad"), (1.4999,), (1.5,), "not below 86 deg"),
    "a jam": (
        lambda x: screw(friction={"coefficient": x}), (TURN * 15 / 8 * (1 - 1e-9),), (TURN * 15 / 8,),
        "the thread jams: no torque raises a load"),
    "rod": (lambda x: cylinder(rod=x), (0.0999,), (0.1,), "as thick as the bore"),
    "barrel": (
        lambda x: cylinder(barrel=x, barrel_length=1.0), (0.1001,), (0.1,),
        "the barrel is not thicker than its bore"),
    "stroke": (
        lambda x: cylinder(closed=0.5, stroke=x), (0.4999,), (0.5,), "its stroke is as long as the closed cylinder"),
    "an arc": (shoe, (0.3, 0.3001), (0.3, 0.3), "ends where it begins, or before"),
    "a pinned lining behind its pin": (shoe, (0.0, 2.0), (-1e-6, 2.0), "a pinned lining presses from 0 to 180 deg"),
    "a pinned lining beyond": (shoe, (0.5, math.pi), (0.5, math.pi * OVER), "a pinned lining presses from 0 to 180"),
    "a lining longer than the drum": (
        shoe, (0.0, math.pi), (-1.0, TURN - 1.0 + 1e-6), "longer than the drum's circumference"),
    "a cosine": (
        lambda a, b: shoe(a, b, "cosine"), (-1.0, math.pi - 1.0), (-1.0, math.pi - 1.0 + 1e-6),
        "a cosine of pressure ends 90 deg from its middle"),
    "notch": (lambda x: Section(circle=0.05, notch=x), (1.0,), (1 - 1e-6,), "is below 1; write K_f"),
    "tube": (lambda x: Section(tube=[x, 0.05]), (0.0499,), (0.05,), "the inner diameter is not smaller"),
    "web": (lambda x: Section(I=[0.2, 0.1, x, 0.01]), (0.0999,), (0.1,), "web and flanges do not fit"),
    "flanges": (lambda x: Section(I=[0.2, 0.1, 0.01, x]), (0.0999,), (0.1,), "web and flanges do not fit"),
    "points of a cam": (
        points, ([0, 1, 2, 3], [1, 1, 1, 1]), ([0, 1, 2], [1, 1, 1]), "3 angles and 3 radii; give at least 4"),
    "radii of a cam": (
        points, ([0, 1, 2, 3], [1, 1, 1, 1]), ([0, 1, 2, 3], [1, 1, 1]), "4 angles and 3 radii; give at least 4"),
    "angles of a cam": (
        points, ([0, 1, 2, 2.0001], [1, 1, 1, 1]), ([0, 1, 2, 2], [1, 1, 1, 1]), "item 4 is not greater than item 3"),
    "a radius of a cam": (
        points, ([0, 1, 2, 3], [1, 1e-9, 1, 1]), ([0, 1, 2, 3], [1, 0, 1, 1]), "not positive"),
    "a turn of a cam": (
        points, ([0, 1, 2, TURN], [1, 2, 2, 1]), ([0, 1, 2, TURN * OVER], [1, 2, 2, 1]), "the points span 360"),
    "a closed cam": (
        points, ([1, 2, 3, TURN + 0.99], [1, 2, 2, 3]), ([1, 2, 3, TURN + 1], [1, 2, 2, 3]), "the cam does not close"),
    "half angle of a tangent cam": (tangent, (1.2,), (math.pi / 2,), "the half angle is not below 90 deg"),
    "nose of a tangent cam": (
        tangent, (math.acos(0.7), 0.0128571), (math.acos(0.7), 0.0128572), "the nose would have a radius of -"),
    "parts of a stack": (
        stack, (["a", "b"], [0.0, 0.02]), (["a"], [0.0]), "1 links and 1 layers do not go together; give each"),
    "layers of a stack": (
        stack, (["a", "b", "a"], [0.0, 0.02, 0.04]), (["a", "b", "a"], [0.0, 0.02]), "3 links and 2 layers do not"),
    "layers in their order": (
        stack, (["a", "b"], [0.02, 0.0201]), (["a", "b"], [0.02, 0.02]), "the layers do not increase; write them from"),
    "room of a stack": (
        stack, (["a", "b", "a"], [0.0, 0.03, 0.06], [0.02, 0.04, 0.02]),
        (["a", "b", "a"], [0.0, 0.03, 0.06], [0.02, 0.04, 0.020001]),
        "links 2 and 3 of the stack overlap; give layers at least half of both thicknesses apart"),
    "room of the first": (
        stack, (["a", "b"], [0.0, 0.03], [0.02, 0.04]), (["a", "b"], [0.0, 0.03], [0.02, 0.040001]),
        "links 1 and 2 of the stack overlap"),
    "thicknesses of a stack": (
        stack, (["a", "b"], [0.0, 0.03], [0.02, 0.04]), (["a", "b"], [0.0, 0.03], [0.02]),
        "2 layers and 1 thicknesses do not go together; give each link of the stack one"),
    "a stack without places": (
        stack, (["a", "b"], [0.0, 0.03]), (["a", "b"], None), "a stack needs the places of its links; write stack:"),
    "thicknesses without a stack": (
        stack, (None, None), (None, None, [0.02]), "thicknesses are those of a stack; write eye and cheeks, or"),
    "a button": (
        lambda x: Button(radius=x, at=0.05), (0.0499,), (0.05,), "the pad reaches over the axis; make at larger"),
    "a clamp of one kind": (
        clamp, ({"bore": 0.04},), ({"bore": 0.04, "stiffness": 1e4, "compression": 0.01},), UNCLEAR),
    "a clamp by a spring": (clamp, ({"stiffness": 1e4, "compression": 0.0},), ({"stiffness": 1e4},), UNCLEAR),
    "a clamp at all": (clamp, ({"bore": 0.04, "pressure": 0.0},), ({},), UNCLEAR),
    "half a spring beside a cylinder": (clamp, ({"bore": 0.04},), ({"bore": 0.04, "compression": 0.01},), UNCLEAR),
    "guide": (guide, (-0.02, 0.0201), (-0.02, 0.02), "a guide is two lengths"),
    "lengths of a guide": (guide, (0.02, 0.03), (0.02, 0.03, 0.04), "a guide is two lengths"),
    "points of a table": (table, ([0, 1], [3, 4]), ([0], [3]), "a table has too few points: 1; give at least 2"),
    "both columns of a table": (
        table, ([0, 1], [3, 4]), ([0, 1], [3]), "a table has 2 values in x and 1 in y; give one y for each x"),
    "x of a table": (
        table, ([0, 1, 1.0001], [3, 4, 5]), ([0, 1, 1], [3, 4, 5]), "does not increase from its item 2 to 3"),
    "a period": (table, ([0, 2], [3, 3], 2.0), ([0, 2.001], [3, 3], 2.0), "a periodic table goes over"),
    "a period above 0": (table, ([0, 2], [3, 3], 2.0), ([0, 2], [3, 3], 0.0), "a periodic table goes over"),
    "ends of a period": (
        table, ([0, 1, 2], [-3, 5, -3], 2.0), ([0, 1, 2], [-3, 5, 3], 2.0), "ends with another value than it begins"),
    "ends of a period below 0": (
        table, ([0, 1, 2], [-3, -5, -3], 2.0), ([0, 1, 2], [-3, -5, -4], 2.0), "ends with another value than it"),
    "a small cam that is closed": (
        points, ([1, 2, 3, TURN + 1], [0.01, 0.02, 0.02, 0.01]),
        ([1, 2, 3, TURN + 1], [0.01, 0.02, 0.02, 0.01 + 5e-8]), "the cam does not close"),
    "points of a law": (
        law, ([0, 1, 2, 3], [0, 1, 2, 1]), ([0, 1, 2], [0, 1, 2]), "it has too few points: 3; give at least 4"),
    "columns of a law": (
        law, ([0, 1, 2, 3], [0, 1, 2, 1]), ([0, 1, 2, 3], [0, 1, 2]), "4 times and 3 positions"),
    "times of a law": (
        law, ([0, 1, 2, 2.001], [0, 1, 2, 1]), ([0, 1, 2, 2], [0, 1, 2, 1]), "its times do not increase"),
    "ends of a law": (
        law, ([0, 1, 2, 3], [-2, 1, 2, -2], True), ([0, 1, 2, 3], [-2, 1, 2, 2], True), "does not end where it begins"),
}  # fmt: skip


@pytest.mark.parametrize("name", LIMITS)
def test_the_last_number_allowed_is_read_and_the_first_beyond_refused(name: str) -> None:
    make, inside, outside, said = LIMITS[name]
    make(*inside)
    with pytest.raises(da.ModelError, match=said):
        make(*outside)


@pytest.mark.parametrize(
    ("kind", "written", "read"),
    [
        ("revolute", 0.2, {"turn": 0.2}),
        ("prismatic", 3, {"slide": 3.0}),
        ("sphere_in_cylinder", "4 N*s/m", {"slide": 4.0}),
        ("cylindrical", {"turn": 0.1}, {"turn": 0.1}),
        ("universal", {"turn2": 0, "turn1": 0.3}, {"turn2": 0.0, "turn1": 0.3}),
        ("spherical", {}, {}),
        ("cylindrical", 0.1, "it has the freedoms slide, turn; write {slide: 0.2}"),
        ("spherical", 0.1, "this joint has no freedom about one axis to damp; leave it out"),
        ("revolute", {"slide": 0.1}, "unknown key 'slide'"),
        ("revolute", -0.1, "is negative"),
    ],
)
def test_damping_of_a_single_freedom_is_a_number_of_several_named(kind: str, written: Any, read: Any) -> None:
    tree = {"type": kind, **TWO, "damping": written}
    tree |= {} if kind in ("spherical",) else {"axis": [0, 0, 1]} if kind != "universal" else {
        "axes": {"i": {"z": [0, 1, 0]}, "j": {"z": [0, 0, 1]}}
    }  # fmt: skip
    if isinstance(read, dict):
        assert SpaceJoint.model_validate(tree, context=SPACE).damping == read
    else:
        with pytest.raises(da.ModelError) as refused:
            SpaceJoint.model_validate(tree, context=SPACE)
        assert read in str(refused.value)


def test_without_mass_a_link_has_its_centre_where_its_volume_has_it() -> None:
    """Two boxes of unequal volume: 1 at 0 and 3 at 4 along x have their centre at 3."""
    sides = {0.0: [1.0, 1.0, 1.0], 4.0: [1.0, 3.0, 1.0]}
    shapes = [{"type": "box", "size": size, "center": [x, 0, 0]} for x, size in sides.items()]
    tree = {"space": "space", "links": {"ground": {}, "body": {"points": {}, "mass": 0, "shape": shapes}}}
    m = da.mechanism(tree)
    assert (m.mass("body"), tuple(m.center("body"))) == (0.0, (3.0, 0.0, 0.0))
    assert not any(x for row in m.inertia("body") for x in row)
    heavy = da.mechanism(tree | {"links": {"ground": {}, "body": tree["links"]["body"] | {"mass": 8.0}}})
    assert (heavy.mass("body"), tuple(heavy.center("body"))) == (8.0, (3.0, 0.0, 0.0))
    assert heavy.inertia("body")[1][1] == pytest.approx(2 * (1 + 1) / 12 + 6 * 2 / 12 + 2 * 3**2 + 6 * 1**2)


@pytest.mark.parametrize(
    "deep", ["x = " + "[" * 1001, "x." * 1001 + "y = 1", "x = " + "{ a = " * 1001, "x = " + "{ a = " * 900]
)
def test_toml_that_is_nested_too_deep_is_refused_at_its_line(deep: str) -> None:
    with pytest.raises(da.ModelError) as refused:
        da.loads(f"# a bar\n{deep}\n", "toml")
    assert (
        str(refused.value)
        == f"text:2: the file is nested deeper than {DEEPEST} levels; a model file needs 6 or so"
    )
