"""The local axes of joints in space, from what each link says of them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from dalembert.errors import ModelError
from dalembert.model.joints.pairs import PAIRS, freedoms_of
from dalembert.model.joints.space_joints import Frame, Frames, SpaceJoint, frames
from dalembert.model.quantities.vectors import cross, dot, length, less, plus, times, unit

Y = (0.0, 1.0, 0.0)


@pytest.mark.parametrize(
    ("axis", "main", "x", "z"),
    [
        ((0, 0, 2), "z", (1, 0, 0), (0, 0, 1)),
        ((0.6, 0, 0.8), "z", (0.8, 0, -0.6), (0.6, 0, 0.8)),  # x of the link, made square to it
        ((24, 0, 7), "z", (0, 1, 0), (0.96, 0, 0.28)),  # along x within 26 deg, so y
        ((0, 0, -3), "z", (1, 0, 0), (0, 0, -1)),
        ((-24, 7, 0), "z", (0.28, 0.96, 0), (-0.96, 0.28, 0)),
        ((3, 0, 0), "x", (1, 0, 0), (0, 0, 1)),
        ((0.6, 0, 0.8), "x", (0.6, 0, 0.8), (-0.8, 0, 0.6)),  # z of the link, made square to it
        ((7, 0, 24), "x", (0.28, 0, 0.96), (0.96, 0, -0.28)),  # along z, so x
    ],
)
def test_axes_beside_a_single_one(axis: Any, main: str, x: Any, z: Any) -> None:
    for frame in frames(None, axis, main):
        assert frame == pytest.approx(np.array([x, np.cross(z, x), z]), abs=1e-14)
        assert np.linalg.det(frame) == pytest.approx(1)


def frame(**keys: Any) -> Frame:
    return Frame(**keys)


@pytest.mark.parametrize(
    ("i", "j", "of_i", "of_j"),
    [
        (
            {"x": (0, 2, 0), "z": (3, 0, 0)},
            {},
            [(0, 1, 0), (0, 0, 1), (1, 0, 0)],
            [(0, 1, 0), (0, 0, 1), (1, 0, 0)],
        ),
        (
            {"x": (0, 2, 0)},
            {"z": (3, 0, 0)},
            [(0, 1, 0), (0, 0, 1), (1, 0, 0)],
            [(0, 1, 0), (0, 0, 1), (1, 0, 0)],
        ),
        (
            {"z": (0, 2, 0)},
            {"z": (3, 0, 0)},
            [(1, 0, 0), (0, 0, -1), (0, 1, 0)],
            [(0, 1, 0), (0, 0, 1), (1, 0, 0)],
        ),
        ({}, {"z": (0, -2, 0)}, [(1, 0, 0), (0, 0, 1), (0, -1, 0)], [(1, 0, 0), (0, 0, 1), (0, -1, 0)]),
        ({}, {}, np.eye(3), np.eye(3)),
    ],
)
def test_axes_that_one_link_leaves_out(i: Any, j: Any, of_i: Any, of_j: Any) -> None:
    first, second = frames(Frames(i=frame(**i), j=frame(**j)), None, "z")
    assert first == pytest.approx(np.array(of_i), abs=1e-14)
    assert second == pytest.approx(np.array(of_j), abs=1e-14)
    assert frames(None, None, "z") == (((1, 0, 0), (0, 1, 0), (0, 0, 1)),) * 2


def test_the_other_links_axis_is_made_square_to_its_own() -> None:
    """j has z along (0.6, 0, 0.8) and takes x of i, (1, 0, 0), across it."""
    _, second = frames(Frames(i=frame(x=(2, 0, 0)), j=frame(z=(0.6, 0, 0.8))), None, "z")
    assert second == pytest.approx(np.array([(0.8, 0, -0.6), (0, 1, 0), (0.6, 0, 0.8)]), abs=1e-14)


@pytest.mark.parametrize(
    ("z", "fits"), [((0, 0, 1), True), ((5e-7, 0, 1), True), ((2e-6, 0, 1), False), ((-2e-6, 0, 1), False)]
)
def test_x_and_z_are_at_a_right_angle(z: Any, fits: bool) -> None:
    if fits:
        assert Frame(x=(3, 0, 0), z=z).z == z
    else:
        with pytest.raises(ModelError, match=r"^x and z are not at a right angle; turn one of them"):
            Frame(x=(3, 0, 0), z=z)


@pytest.mark.parametrize(
    ("blocked", "moments", "turns"), [(None, "x", "yz"), ("x", "x", "yz"), ("y", "y", "zx"), ("z", "z", "xy")]
)
def test_a_slotted_sphere_turns_about_the_axes_that_are_not_blocked(
    blocked: Any, moments: str, turns: str
) -> None:
    joint = SpaceJoint(type="slotted_sphere", links=("a", "b"), axis=(0, 0, 1), blocked=blocked)
    assert (joint.pair.moments, joint.pair.turns) == (moments, turns)
    assert joint.pair.forces == "xyz"


FREEDOMS = {
    "weld": "",
    "revolute": "turn",
    "prismatic": "slide",
    "screw": "turn slide",
    "cylindrical": "slide turn",
    "universal": "turn1 turn2",
    "spherical": "turn",
    "plane": "slide1 slide2 turn",
    "sphere_between_planes": "slide1 slide2 turn",
    "sphere_in_cylinder": "slide turn",
    "cylinder_between_planes": "slide1 slide2 turn1 turn2",
    "slotted_sphere": "turn1 turn2",
    "torus": "turn1 turn2",
    "slotted_cylinder": "slide turn",
    "slotted_sphere_in_cylinder": "slide turn1 turn2",
    "hinge": "",
}


@pytest.mark.parametrize("kind", FREEDOMS)
def test_freedoms_of_a_joint_by_its_table(kind: str) -> None:
    assert freedoms_of(kind) == tuple(FREEDOMS[kind].split())


@pytest.mark.parametrize(
    ("kind", "damped"),
    [
        ("spherical", ()),
        ("sphere_in_cylinder", ("slide",)),
        ("sphere_between_planes", ("slide1", "slide2")),
        ("plane", ("slide1", "slide2", "turn")),
        ("screw", ("turn", "slide")),
    ],
)
def test_a_ball_has_no_turn_to_damp(kind: str, damped: tuple[str, ...]) -> None:
    assert PAIRS[kind].damped == damped
    assert PAIRS[kind].ball == ("spher" in kind)


def test_vectors_of_three_numbers() -> None:
    a, b = (2.0, -3.0, 5.0), (7.0, 11.0, -13.0)
    assert cross(a, b) == (39 - 55, 35 + 26, 22 + 21)
    assert dot(a, b) == 14 - 33 - 65
    assert length(a) == pytest.approx(38**0.5, rel=1e-15)
    assert unit(b) == pytest.approx([x / 339**0.5 for x in b], rel=1e-15)
    assert times(3.0, a) == (6, -9, 15)
    assert less(a, b) == (-5, -14, 18)
    assert plus(a, b, (0.5, 0.25, 0.125)) == (9.5, 8.25, -7.875)


@pytest.mark.parametrize(
    ("kind", "keys", "says"),
    [
        ("revolute", {}, "a revolute joint needs its axis; write axis: [0, 0, 1], or axes"),
        (
            "sphere_in_cylinder",
            {},
            "a sphere_in_cylinder joint needs its axis; write axis: [0, 0, 1], or axes",
        ),
        (
            "universal",
            {"axis": Y},
            "a universal joint needs the directions of its two pins; "
            "write axes: {i: {z: [0, 0, 1]}, j: {z: [0, 1, 0]}}",
        ),
        (
            "universal",
            {"axes": {"i": {"z": Y}}},
            "a universal joint needs the directions of its two pins; "
            "write axes: {i: {z: [0, 0, 1]}, j: {z: [0, 1, 0]}}",
        ),
        (
            "cylindrical",
            {"axis": Y, "damping": 3},
            "damping: it has the freedoms slide, turn; write {slide: 0.2}",
        ),
        (
            "spherical",
            {"damping": 3},
            "damping: this joint has no freedom about one axis to damp; leave it out",
        ),
        ("revolute", {"axis": Y, "damping": -3}, "damping: -3 is negative; write a positive one, or 0"),
        (
            "revolute",
            {"axis": Y, "friction": {"coefficient": 0.1}},
            "friction: its friction needs the radius of its journal; "
            "write radius: 10 mm, or thrust_radius alone for a collar",
        ),
        (
            "spherical",
            {"friction": {"coefficient": 0.1}},
            "friction: its friction needs the radius of its ball; write radius: 10 mm",
        ),
        (
            "prismatic",
            {"axis": Y, "friction": {"coefficient": 0.1, "radius": 3}},
            "radius of friction: the friction of a prismatic joint has no radius; leave it out",
        ),
        ("revolute", {"axis": Y, "friction": {"coefficient": 0.1, "thrust_radius": 3, "guide": [0.1]}}, ""),
    ],
)
def test_a_joint_in_space_that_is_not_complete(kind: str, keys: dict[str, Any], says: str) -> None:
    with pytest.raises(ModelError) as caught:
        SpaceJoint(type=kind, links=("a", "b"), **keys)
    where, what = says.partition(": ")[::2] if ": " in says[:22] else ("", says)
    assert what in f"{caught.value.what}; {caught.value.remedy}"
    assert not where or caught.value.path[0] in where


def test_damping_of_several_freedoms_by_name() -> None:
    joint = SpaceJoint(type="cylindrical", links=("a", "b"), axis=Y, damping={"turn": 3, "slide": 0})
    assert joint.damping == {"turn": 3.0, "slide": 0.0}
    assert joint.model_dump(mode="json")["damping"] == {"turn": "3.0 N*m*s/rad", "slide": "0.0 N*s/m"}
