"""Small parts of a description: bolts, guides, contacts, springs by tables and forms of cams, at their limits."""

from __future__ import annotations

import math
from typing import Any

import pytest

from dalembert.errors import ModelError
from dalembert.model import (
    Damper,
    Link,
    Pin,
    Slider,
    Slot,
    Spring,
    Weld,
)
from dalembert.model.joints.elements.cam_profiles import CamProfile
from dalembert.model.joints.elements.cams import Cam
from dalembert.model.joints.elements.pin_keys import PinSize
from dalembert.model.joints.friction_keys import GuideFriction
from dalembert.model.joints.plane_joints import Gear
from dalembert.model.joints.stiffness import Stiffness
from dalembert.model.part import ReadingRules
from dalembert.model.quantities.spans import ForceLaw

TURN = 2 * math.pi


def refused(call: Any, *arguments: Any, **keys: Any) -> str:
    with pytest.raises(ModelError) as caught:
        call(*arguments, **keys)
    return f"{caught.value.what}; {caught.value.remedy}"


STACK = {"diameter": 0.03, "stack": ("a", "b", "a"), "layers": (0, 0.02, 0.05)}


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ({"layers": None}, "a stack needs the places of its links; write stack:"),
        ({"stack": None}, "a stack needs the places of its links; write stack:"),
        (
            {"stack": None, "layers": None, "thicknesses": (1, 2)},
            "thicknesses are those of a stack; write eye",
        ),
        (
            {"layers": (0, 0.02)},
            "3 links and 2 layers do not go together; give each link of the stack one place",
        ),
        ({"stack": ("a",), "layers": (0,)}, "1 links and 1 layers do not go together"),
        ({"layers": (0, 0.02, 0.02)}, "the layers do not increase; write them from one end of the bolt"),
        ({"layers": (0.05, 0.02, 0)}, "the layers do not increase; write them from one end of the bolt"),
        (
            {"thicknesses": (0.01, 0.02)},
            "3 layers and 2 thicknesses do not go together; give each link of the stack",
        ),
        (
            {"thicknesses": (0.021, 0.02, 0.01)},
            "links 1 and 2 of the stack overlap; give layers at least half of both",
        ),
        (
            {"thicknesses": (0.01, 0.02, 0.041)},
            "links 2 and 3 of the stack overlap; give layers at least half of both",
        ),
    ],
)
def test_a_bolt_that_cannot_be(keys: dict[str, Any], says: str) -> None:
    assert refused(PinSize, **STACK | keys).startswith(says)
    assert PinSize(**STACK, thicknesses=(0.02, 0.02, 0.04)).planes == 2
    assert PinSize(diameter=0.03, stack=("a", "b"), layers=(0, 1)).gap == 0.0


def test_damping_of_a_slot() -> None:
    ends = {"links": ("a", "b")}
    assert Slot(**ends, damping=30).damping == (30.0, 0.0)
    assert Slot(**ends, damping={"turn": 0.2}).damping == (0.0, 0.2)
    both = Slot(**ends, damping={"slide": 30, "turn": 0.2})
    assert both.model_dump(mode="json")["damping"] == {"slide": "30.0 N*s/m", "turn": "0.2 N*m*s/rad"}
    assert "is negative" in refused(Slot, **ends, damping={"slide": 30, "turn": -0.2})


@pytest.mark.parametrize("guide", [(1,), (1, 2, 3), (0, 0), (-2, 1), (1, -1)])
def test_a_guide_that_has_no_length(guide: tuple[float, ...]) -> None:
    assert "a guide is two lengths, behind and ahead of the point; write" in refused(
        GuideFriction, guide=guide
    )
    assert GuideFriction(guide=(-1, 1.5)).guide == (-1.0, 1.5)


@pytest.mark.parametrize(
    ("length", "pairs"),
    [
        (2, {"": (2, 2)}),
        ([1, 2], {"": (1, 2)}),
        ({"A-B": [0.5, 3], "B-C": 2}, {"A-B": (0.5, 3), "B-C": (2, 2)}),
    ],
)
def test_effective_lengths(length: Any, pairs: dict[str, tuple[float, float]]) -> None:
    points = {"A": (0, 0), "B": (1, 0), "C": (1, 2)}
    link = Link(points=points, members=(("A", "B"), ("B", "C")), effective_length=length)
    assert link.effective_length == pairs
    assert link.model_dump(mode="json")["effective_length"] == length


@pytest.mark.parametrize(
    ("length", "says"),
    [
        ({}, "no member has an effective length; write effective_length: {A-B: 2}"),
        ([1], "a list of 1 is not an effective length; write a factor, or [in the plane, across it]"),
        ([1, 2, 3], "a list of 3 is not an effective length; write a factor"),
        (0, "0 is not positive"),
        ([1, 0], "0 is not positive"),
    ],
)
def test_effective_lengths_that_cannot_be(length: Any, says: str) -> None:
    assert says in refused(Link, effective_length=length)


def test_a_stiffness_has_one_number_or_three() -> None:
    assert Stiffness(force=[1, 2, 3]).force == (1.0, 2.0, 3.0)
    written = Stiffness(force=[1, 2, 3], moment=4).model_dump(mode="json")
    assert written == {"force": ["1.0 N/m", "2.0 N/m", "3.0 N/m"], "moment": "4.0 N*m/rad"}
    assert "a list of 2 is not a stiffness; write one number, or [x, y, z] in the joint's" in refused(
        Stiffness, force=[1, 2]
    )
    assert "0 is not positive" in refused(Stiffness, force=[1, 0, 3])
    assert "0 is not positive" in refused(Stiffness, moment=0)
    with pytest.raises(ModelError, match=r"a list of 3 is not a stiffness; write one number$"):
        Stiffness.model_validate({"force": [1, 2, 3]}, context=ReadingRules(dimension=2))


BEND = {"x": (-0.5, 1.0, 3.0), "y": (-4.0, 5.0, 4.0)}


def test_a_spring_and_a_damper_by_a_table() -> None:
    between = {"between": ("ground.A", "rod.B")}
    spring, damper = Spring(**between, force=BEND), Damper(**between, force=BEND)
    assert (spring.stiffness, damper.damping) == (0.0, 0.0)
    law = ForceLaw((-0.5, 1.0, 3.0), (-4.0, 5.0, 4.0))
    assert law.bends == ((-0.5, 6.0), (1.0, -6.5), (3.0, 0.5))
    assert spring.law == law
    both = "both a {} and a table of its force are given; leave one of them out"
    assert refused(Spring, **between, force=BEND, stiffness=2) == both.format("stiffness")
    assert refused(Damper, **between, force=BEND, damping=2) == both.format("damping")
    for broken, says in (
        (
            {"x": (1, 2), "y": (1,)},
            "the table has 2 values in x and 1 in y; give one y for each x, two points at least",
        ),
        ({"x": (1,), "y": (1,)}, "the table has 1 values in x and 1 in y; give one y for each x"),
        (
            {"x": (1, 2, 2), "y": (1, 2, 3)},
            "x of the table does not increase from its item 2 to 3; sort the points",
        ),
        (
            {"x": (2, 1, 3), "y": (1, 2, 3)},
            "x of the table does not increase from its item 1 to 2; sort the points",
        ),
    ):
        assert says in refused(Spring, **between, force=broken)


@pytest.mark.parametrize(
    ("contact", "mode", "restitution", "below"),
    [
        ("pulls", "pulls", 0, False),
        ({"pushes": True}, "pushes", 0, False),
        ({"pulls": True, "restitution": 1}, "pulls", 1, False),
        ({"pushes": "from below", "restitution": 0.5}, "holds", 0.5, True),
    ],
)
def test_a_contact_of_a_slider(contact: Any, mode: str, restitution: float, below: bool) -> None:
    joint = Slider(links=("a", "b"), contact=contact)
    known = joint.contact
    assert (known.mode, known.restitution, known.below, known.opened) == (mode, restitution, below, "")
    written = joint.model_dump(mode="json")["contact"]
    assert written == (contact if len(contact) != 1 or below else mode)
    assert Slider(links=("a", "b"), contact=written).contact == known


@pytest.mark.parametrize(
    ("kind", "contact", "says"),
    [
        (Slider, "hold", "unknown contact 'hold'; did you mean 'holds'?"),
        (
            Slider,
            {},
            "the contact does not say what it does; write contact: {pushes: true, restitution: 0.3}",
        ),
        (Slider, {"pushes": True, "pulls": True}, "the contact does not say what it does"),
        (
            Slider,
            {"pushes": False},
            "pushes is false; write pushes: true; of a slider also pushes: from below",
        ),
        (Slider, {"pulls": "from below"}, "pulls is 'from below'; write pulls: true"),
        (Slot, {"pushes": "from below"}, "pushes is 'from below'; write pushes: true"),
        (
            Slot,
            {"pushes": True, "restitution": 1.1},
            "restitution is 1.1; it is the speed after a landing over",
        ),
        (
            Slot,
            {"pushes": True, "restitution": -0.1},
            "restitution is -0.1; it is the speed after a landing over",
        ),
        (Pin, "pushes", "a pin joint transmits forces in all directions; use a slot with contact: pushes"),
        (Weld, "pushes", "a weld joint transmits forces in all directions; use a slot with contact: pushes"),
    ],
)
def test_a_contact_that_cannot_be(kind: Any, contact: Any, says: str) -> None:
    assert says in refused(kind, type=kind.model_fields["type"].default, links=("a", "b"), contact=contact)


GEAR = {"links": ("a", "b"), "radii": (0.1, 0.2)}


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ({"contact": "pulls", "flank": "left"}, "teeth push, they do not pull; write contact: pushes"),
        ({"contact": "pushes"}, "teeth that only push need the flank that they push with; write flank: left"),
        ({"flank": "left"}, "a flank is given without contact; write contact: pushes beside it"),
        (
            {"contact": {"pushes": True, "restitution": 0.2}, "flank": "left"},
            "contact: pushes of teeth is for the plane, without restitution",
        ),
    ],
)
def test_teeth_that_cannot_push(keys: dict[str, Any], says: str) -> None:
    assert says in refused(Gear, **GEAR | {"pressure_angle": 0.3} | keys)


LIFT = [{"to": 2, "in": 1, "by": "cycloidal"}, {"to": 0, "in": TURN - 1, "by": "cycloidal"}]
DOWN = [{"to": -2, "in": 1, "by": "cycloidal"}, {"to": 0, "in": TURN - 1, "by": "cycloidal"}]
ARC = [
    {"center": [0, 1], "radius": 3, "to": 1},
    {"center": [2, 0], "radius": -4, "to": 2},
    {"center": [0, 0], "radius": 5, "to": 3},
]
POINTS = {"angle": [0, 1, 2, 3, 4], "radius": [3, 4, 7, 4, 3]}
FLANK = {"base": 3, "lift": 1, "half_angle": 1}


@pytest.mark.parametrize(
    ("keys", "form", "size"),
    [
        ({"segments": LIFT, "base": 3}, "segments", 3),
        ({"segments": DOWN, "prime": 5}, "segments", 5),
        ({"arcs": ARC}, "arcs", 5),
        ({"points": POINTS}, "points", 7),
        ({"tangent": FLANK, "start": 0.5}, "tangent", 3),
        ({"eccentric": 2, "radius": 5}, "eccentric", 5),
    ],
)
def test_forms_of_a_cam(keys: dict[str, Any], form: str, size: float) -> None:
    profile = CamProfile(**keys)
    assert (profile.form, profile.size) == (form, size)
    if profile.segments is not None:
        assert profile.segments.sign == (1.0 if size == 3 else -1.0)
        assert profile.segments.targets == [LIFT[0]["to"] if size == 3 else -2, 0]
    again = CamProfile(**{k: v for k, v in profile.model_dump(mode="json").items() if v is not None})
    assert again == profile


def test_measures_of_a_tangent_cam() -> None:
    """The nose is at r_base + lift - r_nose, and its flank turns by the half angle: d (1 - cos) = lift."""
    tangent = CamProfile(tangent=FLANK).tangent
    assert tangent is not None
    assert tangent.nose_distance == pytest.approx(1 / (1 - math.cos(1)))
    assert tangent.nose_radius == pytest.approx(4 - 1 / (1 - math.cos(1)))
    assert "the half angle is not below 90 deg" in refused(CamProfile, tangent=FLANK | {"half_angle": 1.6})
    assert "the nose would have a radius of -4168.77 mm" in refused(
        CamProfile, tangent=FLANK | {"half_angle": 0.5}
    )


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ({}, "it has no form; give one of segments, eccentric, arcs, tangent, points"),
        ({"arcs": ARC, "points": POINTS}, "it has arcs and points; give one of"),
        ({"segments": LIFT}, "its size is missing; give base"),
        ({"segments": LIFT, "base": 3, "prime": 4}, "both base and prime are given; give base"),
        ({"arcs": ARC, "base": 3}, "base and prime are for segments, not for arcs; leave them out"),
        ({"arcs": ARC, "prime": 3}, "base and prime are for segments, not for arcs; leave them out"),
        ({"arcs": ARC, "start": 3}, "start is for segments and tangent, not for arcs; leave it out"),
        ({"eccentric": 3}, "a disc needs eccentric and radius; write"),
        ({"arcs": ARC, "radius": 3}, "a disc needs eccentric and radius; write"),
        ({"eccentric": 3, "radius": 3}, "the cam's axis is outside its disc; make the radius larger"),
        (
            {"segments": [LIFT[0], LIFT[1] | {"in": 1}], "base": 3},
            "the segments fill 114.592 deg; add {dwell: rest}",
        ),
        (
            {"segments": [LIFT[0], LIFT[1] | {"in": 7}], "base": 3},
            "the segments fill 458.366 deg; shorten them to a turn of 360 deg",
        ),
        ({"segments": [LIFT[0], LIFT[1] | {"to": 1}], "base": 3}, "the lift ends at 1.0 m; let it return"),
        ({"segments": [LIFT[0], LIFT[1] | {"to": -1}], "base": 3}, "the lift ends at -1.0 m; let it return"),
        (
            {
                "segments": [LIFT[0], {"to": -1, "in": 1, "by": "harmonic"}, LIFT[1] | {"in": TURN - 2}],
                "base": 3,
            },
            "the lift goes both above and below 0",
        ),
        ({"arcs": ARC[:1]}, "a list is not two arcs or more; write arcs:"),
        ({"arcs": [ARC[0], ARC[1] | {"to": 1}]}, "the ends of the arcs do not increase; sort the arcs"),
        (
            {"arcs": [ARC[0], ARC[1], ARC[2] | {"to": 1.5}]},
            "the ends of the arcs do not increase; sort the arcs",
        ),
        ({"arcs": [ARC[0], ARC[1] | {"center": [1, 2, 3]}]}, "a list is not a point; write [x, y]"),
        (
            {"points": POINTS | {"radius": [3, 4, 3, 4]}},
            "it has 5 angles and 4 radii; give at least 4 of each",
        ),
        (
            {"points": {"angle": [0, 1, 2], "radius": [3, 4, 3]}},
            "it has 3 angles and 3 radii; give at least 4 of each",
        ),
        (
            {"points": POINTS | {"angle": [0, 1, 1, 3, 4]}},
            "the angles must increase: item 3 is not greater than item 2; sort",
        ),
        (
            {"points": POINTS | {"angle": [0, -1, 2, 3, 4]}},
            "the angles must increase: item 2 is not greater than item 1; sort",
        ),
        ({"points": POINTS | {"radius": [3, 4, 0, 4, 3]}}, "a radius is not positive; give the distances"),
        ({"points": POINTS | {"angle": [0, 1, 2, 3, 7]}}, "the points span 401.07 deg; give one turn"),
        (
            {"points": {"angle": [0, 1, 2, 3, TURN], "radius": [3, 4, 5, 4, 2]}},
            "the cam does not close: the radii at both ends",
        ),
        (
            {"points": {"angle": [0, 1, 2, 3, TURN], "radius": [3, 4, 5, 4, 4]}},
            "the cam does not close: the radii at both ends",
        ),
        ({"points": {"angle": [0, 1, 2, 3]}}, "the key 'radius' is missing"),
    ],
)
def test_a_cam_that_cannot_be(keys: dict[str, Any], says: str) -> None:
    assert says in refused(CamProfile, **keys)


def test_followers_of_a_cam() -> None:
    cam = {"links": ("a", "b"), "profile": {"eccentric": 2, "radius": 5}}
    for follower, kind, roller in (
        ("knife", "knife", 0.0),
        ("flat", "flat", 0.0),
        ({"roller": 3}, "roller", 3.0),
    ):
        known = Cam(**cam, follower=follower).follower
        assert (known.kind, known.roller) == (kind, roller)
    assert "'ball' is not a follower; write knife, flat, or {roller: 10 mm}" in refused(
        Cam, **cam, follower="ball"
    )
