"""Sections of members: areas, second moments, fibres, shear and torsion by the formulas of elasticity."""

from __future__ import annotations

import math
from typing import Any

import pytest

from dalembert.errors import ModelError
from dalembert.model import Link, Section

B, H = 0.02, 0.05
HEIGHT, WIDTH, WEB, FLANGE = 0.1, 0.06, 0.008, 0.012
CLEAR = HEIGHT - 2 * FLANGE


def strips(powers: tuple[int, int]) -> float:
    """Integral of y^p z^q over an I by its three rectangles, y in the plane."""

    def block(y0: float, y1: float, half: float) -> float:
        p, q = powers
        return (y1 ** (p + 1) - y0 ** (p + 1)) / (p + 1) * 2 * half ** (q + 1) / (q + 1)

    inner, outer = CLEAR / 2, HEIGHT / 2
    return 2 * block(inner, outer, WIDTH / 2) + block(-inner, inner, WEB / 2)


ROUND_TUBE = {"tube": (0.03, 0.05)}
RING = math.pi * (0.025**2 - 0.015**2)
RING_MOMENT = math.pi / 4 * (0.025**4 - 0.015**4)
DISC = math.pi * 0.02**2
SIZES: dict[
    str, tuple[dict[str, Any], float, tuple[float, float], tuple[float, float], tuple[float, float]]
] = {
    "a rectangle": (
        {"rectangle": (B, H)},
        B * H,
        (H * B**3 / 12, B * H**3 / 12),
        (H / 2, B / 2),
        (1500.0, 1500.0),
    ),
    "an I": (
        {"I": (HEIGHT, WIDTH, WEB, FLANGE)},
        strips((0, 0)),
        (strips((0, 2)), strips((2, 0))),
        (HEIGHT / 2, WIDTH / 2),
        (1 / (WEB * CLEAR), 1.5 / (2 * WIDTH * FLANGE)),
    ),
    "a circle": ({"circle": 0.04}, DISC, (DISC * 1e-4,) * 2, (0.02, 0.02), (4 / 3 / DISC,) * 2),
    "a tube": (ROUND_TUBE, RING, (RING_MOMENT,) * 2, (0.025, 0.025), (4 / 3 / RING * 12.25 / 8.5,) * 2),
    "numbers": (
        {"area": 0.002, "modulus": 3e-5, "inertia": 6e-7},
        0.002,
        (6e-7, 6e-7),
        (0.02, 0.02),
        (750.0, 750.0),
    ),
}


@pytest.mark.parametrize(("keys", "area", "seconds", "reach", "shear"), SIZES.values(), ids=SIZES)
def test_measures_of(keys: dict[str, Any], area: float, seconds: Any, reach: Any, shear: Any) -> None:
    section = Section(**keys)
    assert section.area_of == pytest.approx(area, rel=1e-13)
    assert section.second_moments == pytest.approx(seconds, rel=1e-12)
    assert section.reach == pytest.approx(reach, rel=1e-13)
    assert section.shear == pytest.approx(shear, rel=1e-12)
    assert section.round == bool(keys.keys() & {"circle", "tube"})


def torsion_of_a_rectangle(long: float, short: float) -> float:
    """Torque over the greatest shear stress, by Saint-Venant's series."""
    odd = range(1, 30, 2)
    stiff = (
        1
        - 192 / math.pi**5 * short / long * sum(math.tanh(n * math.pi * long / 2 / short) / n**5 for n in odd)
    ) / 3
    steep = 1 - 8 / math.pi**2 * sum(1 / (n * n * math.cosh(n * math.pi * long / 2 / short)) for n in odd)
    return stiff / steep * long * short**2


@pytest.mark.parametrize(("b", "h"), [(0.02, 0.05), (0.05, 0.02), (0.03, 0.031), (0.01, 0.08)])
def test_torsion_of_a_rectangle_is_within_two_parts_in_a_thousand(b: float, h: float) -> None:
    wanted = torsion_of_a_rectangle(max(b, h), min(b, h))
    assert Section(rectangle=(b, h)).torsion == pytest.approx(wanted, rel=2e-3)


@pytest.mark.parametrize(("web", "flange"), [(0.008, 0.012), (0.012, 0.008)])
def test_torsion_of_other_sections(web: float, flange: float) -> None:
    strips_of = (2 * WIDTH * flange**3 + (HEIGHT - 2 * flange) * web**3) / 3
    assert Section(I=(HEIGHT, WIDTH, web, flange)).torsion == pytest.approx(strips_of / 0.012, rel=1e-13)
    assert Section(**ROUND_TUBE).torsion == pytest.approx(2 * RING_MOMENT / 0.025, rel=1e-13)
    assert Section(circle=0.04).torsion == pytest.approx(math.pi / 2 * 0.02**3, rel=1e-13)
    with pytest.raises(ModelError, match=r"^a section given by its numbers has no torsion or biaxial"):
        _ = Section(area=2, modulus=3, inertia=4).torsion


ONE = "write one of rectangle, circle, tube, I, or area, modulus and inertia"


@pytest.mark.parametrize(
    ("keys", "says", "at"),
    [
        ({}, f"the section has no size; {ONE}", ()),
        ({"circle": 2, "tube": (1, 2)}, f"circle and tube give it twice; {ONE}", ()),
        (
            {"circle": 2, "modulus": 3, "inertia": 2},
            f"circle and modulus and inertia give it twice; {ONE}",
            ("modulus",),
        ),
        ({"area": 2}, "the section has no modulus; give area, modulus and inertia, or a shape", ()),
        (
            {"modulus": 2, "inertia": 2},
            "the section has no area; give area, modulus and inertia, or a shape",
            (),
        ),
        (
            {"area": 2, "modulus": 2},
            "the section has no inertia; give area, modulus and inertia, or a shape",
            (),
        ),
        ({"tube": (2, 2)}, "the inner diameter is not smaller; write tube: [inner, outer]", ("tube",)),
        ({"tube": (3, 2)}, "the inner diameter is not smaller; write tube: [inner, outer]", ("tube",)),
        ({"I": (10, 6, 6, 1)}, "web and flanges do not fit; write I: [height, width, web, flange]", ("I",)),
        ({"I": (10, 6, 1, 5)}, "web and flanges do not fit; write I: [height, width, web, flange]", ("I",)),
    ],
)
def test_a_section_without_a_clear_size(keys: dict[str, Any], says: str, at: tuple[str, ...]) -> None:
    with pytest.raises(ModelError) as caught:
        Section(**keys)
    assert (f"{caught.value.what}; {caught.value.remedy}", caught.value.path) == (says, at)


def test_sizes_that_just_fit() -> None:
    assert Section(tube=(1.999, 2)).area_of > 0
    assert Section(I=(10, 6, 5.9, 4.9)).area_of > 0


POINTS = {"A": (0.0, 0.0), "B": (0.3, 0.0), "C": (0.3, 0.4), "D": (0.5, 0.4)}
RING_OF_AB = "the members close a ring at {} and {}; its forces are statically indeterminate"


@pytest.mark.parametrize(
    ("members", "says"),
    [
        ([["A", "B"], ["B", "C"], ["C", "A"]], RING_OF_AB.format("'C'", "'A'")),
        ([["A", "B"], ["B", "A"]], RING_OF_AB.format("'B'", "'A'")),
        ([["A", "B"], ["C", "D"]], "the members are not connected; let each begin at a point of another"),
        ([], "the list of members is empty or not a list; write [[A, B], [B, C]]"),
        ("AB", "the list of members is empty or not a list; write [[A, B], [B, C]]"),
        (["A", "B", "C"], "expected two names, not 3"),
    ],
)
def test_members_are_a_tree(members: Any, says: str) -> None:
    with pytest.raises(ModelError) as caught:
        Link(points=POINTS, members=members)
    assert says in str(caught.value)


@pytest.mark.parametrize(
    "members",
    [
        [["A", "B"], ["B", "C"], ["B", "D"]],
        [["A", "B"], ["C", "D"], ["D", "A"]],
        [["B", "A"], ["C", "A"], ["A", "D"]],
    ],
)
def test_members_stay_in_their_order(members: list[list[str]]) -> None:
    link = Link(points=POINTS, members=members)
    assert [list(pair) for pair in link.members or ()] == members
    assert link.model_dump(mode="json")["members"] == members
    assert Link(points=POINTS, members=members[0]).members == (tuple(members[0]),)


SECTION = {"circle": 0.04}
LINKS: list[tuple[dict[str, Any], str, tuple[str | int, ...]]] = [
    (
        {"members": [["A", "B"], ["B", "E"]]},
        "points 'B' and 'E' are in one place; name two that are apart",
        ("members", 1),
    ),
    (
        {"section": SECTION | {"notch": {"F": 1.5}}},
        "notch at an unknown point 'F'; choose among A, B, C, D, E",
        ("section", "notch", "F"),
    ),
    (
        {"effective_length": {"A-C": 2}},
        "'A-C' is not one of its members; name its members: members: [[A, B]]",
        ("effective_length", "A-C"),
    ),
    (
        {"members": [["A", "B"]], "effective_length": {"A-C": 2}},
        "'A-C' is not one of its members; the only one is 'A-B'",
        ("effective_length", "A-C"),
    ),
    ({"mass_along": "shape"}, "mass_along is by a shape, and there is none; write uniform", ("mass_along",)),
    (
        {"mass_along": "evenly"},
        "mass_along: 'evenly' is not a mass distribution along a member; write uniform, shape, lumped",
        ("mass_along",),
    ),
    ({"mass": 2, "weight": 3}, "both mass and weight are given; leave one of them out", ()),
    (
        {"points": {"center": (1, 2)}},
        "a point is named 'center', the name of the mass centre; give it another name",
        ("points", "center"),
    ),
    (
        {
            "points": {
                "P": {"from": "Q", "at": (1, 2)},
                "Q": {"from": "R", "at": (1, 2)},
                "R": {"from": "P", "at": (1, 2)},
            }
        },
        "points refer to each other in a circle: P from Q from R from P; give one of them a vector",
        ("points", "P", "from"),
    ),
    (
        {"points": {"P": {"from": "Q", "at": (1, 2)}, "Q": {"from": "Z", "at": (1, 2)}}},
        "unknown point 'Z'; choose among P, Q, center",
        ("points", "Q", "from"),
    ),
    (
        {
            "points": {
                "P": {"from": "Q", "turn": 1, "about": "S"},
                "Q": (1, 2),
                "S": {"from": "Q", "at": (1, 2)},
            }
        },
        "a point is turned about 'S', which is placed from another; give that point a vector",
        ("points", "P", "about"),
    ),
    (
        {"points": {"P": {"from": "A", "turn": 1, "mirror": 2}, "A": (1, 2)}},
        "from of point 'P': a point is placed by both turn and mirror; turn it, or mirror it, in the plane",
        ("points", "P", "from"),
    ),
    (
        {"shape": {"type": "sphere", "radius": 2, "density": 3}, "center": (1, 2)},
        "both shape and center are given; leave one of them out: a shape gives both",
        ("center",),
    ),
    (
        {"shape": {"type": "sphere", "radius": 2, "density": 3}, "inertia": 4},
        "both shape and inertia are given; leave one of them out: a shape gives both",
        ("inertia",),
    ),
]


@pytest.mark.parametrize(("keys", "says", "at"), LINKS)
def test_a_link_that_cannot_be(keys: dict[str, Any], says: str, at: tuple[str | int, ...]) -> None:
    with pytest.raises(ModelError) as caught:
        Link(**{"points": POINTS | {"E": (0.3, 0.0)}} | keys)
    error = caught.value
    assert f"{error.what}; {error.remedy}".endswith(says)
    assert error.path == at


def test_a_point_placed_from_another_by_turn_mirror_and_vector() -> None:
    """Turned about B by 90 deg, mirrored in a line at 45 deg through B, each with a vector added; and on from there."""
    points = {
        "B": (1.0, 2.0),
        "A": (4.0, 3.0),
        "T": {"from": "A", "turn": "90 deg", "about": "B", "at": (0.5, 0.25)},
        "M": {"from": "A", "mirror": "45 deg", "about": "B"},
        "O": {"from": "A", "mirror": "0 deg"},
        "C": {"from": "center", "at": (1, 1)},
        "U": {"from": "T", "at": (1, 2)},
    }
    link = Link(points=points, center=(7, 8))
    assert link.point("T") == pytest.approx((1 - 1 + 0.5, 2 + 3 + 0.25))
    assert link.point("M") == pytest.approx((1 + 1, 2 + 3))
    assert link.point("O") == (4, -3)
    assert link.point("C") == (8, 9)
    assert link.point("U") == pytest.approx((1.5, 7.25))
    assert link.point("center") == (7, 8)
    assert Link(points={"B": (1, 2, 3)}).point("center") == (0, 0, 0)
    assert Link().point("center") == (0, 0)
    shape = {"type": "sphere", "radius": 1, "center": (3, 4, 0)}
    for link in (
        Link(points={"B": (1.0, 2.0)}, shape=shape | {"density": 2}),
        Link(points={"B": (1.0, 2.0)}, shape=shape, mass=5),
        Link(points={"B": (1.0, 2.0)}, shape=shape, weight=5),
    ):
        assert link.point("center") == pytest.approx((3, 4))
