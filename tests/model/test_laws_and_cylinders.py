"""Laws by expressions with their derivatives, driven circular slots, and cylinders: numbers by hand, and refusals."""

from __future__ import annotations

import math
from typing import Any

import pytest

from dalembert.errors import ModelError
from dalembert.model import FluidCylinder, Mechanism, mechanism
from dalembert.model.drives.cylinders import with_cylinders
from dalembert.model.drives.driven_freedoms import drive_freedoms, with_freedoms
from dalembert.model.drives.expression_laws import Jet, expression_law
from dalembert.model.part import ReadingRules

RULES = ReadingRules()
OVER = ReadingRules(freedoms={"O": "turn", "S": "slide"})


def refused(call: Any, *arguments: Any, **keys: Any) -> tuple[str, tuple[Any, ...]]:
    with pytest.raises(ModelError) as caught:
        call(*arguments, **keys)
    return f"{caught.value.what}; {caught.value.remedy}", caught.value.path


@pytest.mark.parametrize(
    ("expression", "f", "first", "second"),
    [
        (
            "3*sin(2*time)",
            lambda t: 3 * math.sin(2 * t),
            lambda t: 6 * math.cos(2 * t),
            lambda t: -12 * math.sin(2 * t),
        ),
        (
            "3*cos(2*time)",
            lambda t: 3 * math.cos(2 * t),
            lambda t: -6 * math.sin(2 * t),
            lambda t: -12 * math.cos(2 * t),
        ),
        ("tan(time)", math.tan, lambda t: 1 / math.cos(t) ** 2, lambda t: 2 * math.sin(t) / math.cos(t) ** 3),
        (
            "2*exp(-3*time)",
            lambda t: 2 * math.exp(-3 * t),
            lambda t: -6 * math.exp(-3 * t),
            lambda t: 18 * math.exp(-3 * t),
        ),
        ("log(2 + time)", lambda t: math.log(2 + t), lambda t: 1 / (2 + t), lambda t: -1 / (2 + t) ** 2),
        (
            "sqrt(2 + time)",
            lambda t: (2 + t) ** 0.5,
            lambda t: 0.5 * (2 + t) ** -0.5,
            lambda t: -0.25 * (2 + t) ** -1.5,
        ),
        ("atan(time)", math.atan, lambda t: 1 / (1 + t * t), lambda t: -2 * t / (1 + t * t) ** 2),
        ("5/(2 + time)", lambda t: 5 / (2 + t), lambda t: -5 / (2 + t) ** 2, lambda t: 10 / (2 + t) ** 3),
        ("time^3 - 2*time/4", lambda t: t**3 - t / 2, lambda t: 3 * t * t - 0.5, lambda t: 6 * t),
        ("(3 - time)*(time - 1)", lambda t: (3 - t) * (t - 1), lambda t: 4 - 2 * t, lambda t: -2),
    ],
)
def test_a_law_by_an_expression_has_its_derivatives(expression: str, f: Any, first: Any, second: Any) -> None:
    keys = {"expression": expression, "unit": "m", "duration": 1.5, "count": 4}
    law = expression_law(keys, "length", RULES)
    t, *motion = law.motion()
    assert t.tolist() == [0.0, 0.5, 1.0, 1.5]
    for k in range(4):
        wanted = [f(t[k]), first(t[k]), second(t[k])]
        assert [row[k] for row in motion] == pytest.approx(wanted, rel=1e-12, abs=1e-12)
        assert law.at(t[k]) == pytest.approx(wanted, rel=1e-12, abs=1e-12)
    assert law.motion(2)[0].tolist() == [0.0, 1.5]


def test_powers_of_a_function_of_time() -> None:
    x = Jet(3.0, 2.0, 5.0)
    assert x**0 == Jet(1.0, 0.0, 0.0)
    assert x**1 == Jet(3.0, 2.0, 5.0)
    assert x**2 == Jet(9.0, 12.0, 2 * 4 + 2 * 3 * 5)
    assert x ** Jet(-1.0) == Jet(1 / 3, pytest.approx(-2 / 9), pytest.approx(8 / 27 - 5 / 9))
    assert 6 - x == Jet(3.0, -2.0, -5.0)
    assert x * Jet(7.0, 11.0, 13.0) == Jet(21.0, 47.0, 5 * 7 + 2 * 22 + 39)


@pytest.mark.parametrize(
    ("keys", "says", "at"),
    [
        (
            {"expression": "2*S*O"},
            "the law depends on O, S; write law: {expression: 20 mm*sin(2*pi*5 Hz*time)}",
            ("expression",),
        ),
        (
            {"expression": "2*O - 2*O"},
            "the law depends on O; write law: {expression: 20 mm*sin(2*pi*5 Hz*time)}",
            ("expression",),
        ),
        (
            {"expression": "2*sign(time)*abs(time)"},
            "a law with abs has no acceleration everywhere; write it by segments, or by sin, "
            "cos, tan, exp, log, sqrt and atan",
            ("expression",),
        ),
        ({"expression": "2*time", "count": 0}, "count is 0; write an integer from 1 on", ("count",)),
        (
            {"expression": "2*time", "count": 2},
            "a count is given without a duration; write duration: 1 s beside it",
            ("count",),
        ),
        (
            {"expression": "2*time", "duration": -1},
            "-1 is not positive; write a positive one",
            ("duration",),
        ),
    ],
)
def test_an_expression_that_is_no_law(keys: dict[str, Any], says: str, at: tuple[str, ...]) -> None:
    assert refused(expression_law, keys, "length", OVER) == (says, at)
    assert expression_law({"expression": "2*time", "count": 1}, "length", RULES).count == 1


def test_a_slot_round_a_centre_is_driven_by_an_arm() -> None:
    tree: dict[str, Any] = {
        "links": {"plate": {"points": {"C": [0, 0]}}, "rod": {"points": {"P": [0, 0]}}},
        "joints": {"J": {"type": "circular_slot", "links": ["plate", "rod"], "at": ["C", "P"], "radius": 2}},
        "drives": {"d": {"joint": "J", "freedom": "slide", "position": 3}},
    }
    out: Any = with_freedoms(tree)
    assert out["links"] == tree["links"] | {"J_arm": {"points": {"C": [0, 0]}}}
    assert out["joints"] == tree["joints"] | {
        "J_center": {"type": "pin", "links": ["plate", "J_arm"], "at": "C"},
        "J_line": {"type": "slot", "links": ["J_arm", "rod"], "at": ["C", "P"]},
    }
    assert out["drives"] == {"d": {"joint": "J_center", "freedom": "turn", "position": 3}}
    assert drive_freedoms(tree) == {"d": "turn"}
    tree["joints"]["J"].pop("at")
    assert with_freedoms(tree)["joints"]["J_line"]["at"] == ["J", "J"]  # type: ignore[index]


CYLINDER = {"between": ("ground.A", "boom.B"), "bore": 0.08, "rod": 0.045}
SIZED = {"closed": 0.9, "stroke": 0.5}


def test_areas_forces_and_lengths_of_a_cylinder() -> None:
    c = FluidCylinder(**CYLINDER, **SIZED, cap_pressure=5e6, rod_pressure=2e6)
    cap, rod = math.pi * 0.04**2, math.pi * (0.04**2 - 0.0225**2)
    assert c.areas == pytest.approx((cap, rod), rel=1e-14)
    assert c.known_force == pytest.approx(5e6 * cap - 2e6 * rod, rel=1e-14)
    assert c.lengths == pytest.approx((0.9, 1.4), rel=1e-15)
    assert c.barrel_part == pytest.approx(0.7, rel=1e-15)
    assert FluidCylinder(**CYLINDER, **SIZED, barrel_length=0.8).barrel_part == 0.8
    open_ = FluidCylinder(between=CYLINDER["between"], bore=0.08, cap_pressure=5e6)
    assert open_.areas == (pytest.approx(cap), pytest.approx(cap))
    assert (open_.known_force, open_.lengths, open_.barrel_part) == (None, None, None)
    losses = [FluidCylinder(**CYLINDER, **keys).loses for keys in ({}, {"efficiency": 0.9}, {"friction": 3})]
    assert losses == [False, True, True]


@pytest.mark.parametrize(
    ("keys", "says", "at"),
    [
        (
            {"rod": 0.08},
            "the rod is as thick as the bore, or thicker; the bore is the inner diameter of the barrel",
            ("rod",),
        ),
        (
            {"barrel": 0.08, **SIZED},
            "the barrel is not thicker than its bore; barrel is its outer diameter, bore the inner one",
            ("barrel",),
        ),
        (
            {"efficiency": 1.01},
            "an efficiency of 1.01 would give power; write one from 0 to 1, such as 0.94",
            ("efficiency",),
        ),
        (
            {"efficiency": 0.9, "friction": 3},
            "an efficiency and a friction are given; leave one of them out",
            ("friction",),
        ),
        ({"closed": 0.9}, "stroke is missing; give closed and stroke together, or neither", ()),
        ({"stroke": 0.5}, "closed is missing; give closed and stroke together, or neither", ()),
        (
            {"closed": 0.5, "stroke": 0.5},
            "its stroke is as long as the closed cylinder, or longer; closed is the distance of its ends "
            "with the rod in",
            ("stroke",),
        ),
        (
            {"barrel": 0.1},
            "the length of its barrel is not known, and is needed for its column; give closed and stroke, or "
            "barrel_length",
            (),
        ),
        (
            {"mass": (3, 4)},
            "where the masses of barrel and rod are does not follow; give closed and stroke",
            ("mass",),
        ),
        (
            {"ends": ("free", "fixed")},
            "ends: [free, fixed] is not a case that is known; write one of [pin, pin], [fixed, free], "
            "[fixed, pin]",
            (),
        ),
        (
            {"mass": (3, 4, 5), **SIZED},
            "mass: 3 masses are given; write mass: [18 kg, 9 kg], of barrel and rod",
            ("mass",),
        ),
        (
            {"mass": (3, -4), **SIZED},
            "item 2 of mass: -4.0 is negative; write a positive one, or 0",
            ("mass", 1),
        ),
    ],
)
def test_a_cylinder_that_cannot_be(keys: dict[str, Any], says: str, at: tuple[Any, ...]) -> None:
    assert refused(FluidCylinder, **CYLINDER | keys) == (says, at)


BOOM: dict[str, Any] = {
    "links": {
        "ground": {"points": {"O": [0, 0], "A": [0.2, -0.4]}},
        "boom": {"points": {"O": [0, 0], "B": [0.9, 0]}},
    },
    "joints": {"O": {"type": "pin", "links": ["ground", "boom"]}},
    "drives": {
        "C": {
            "cylinder": {"between": ["ground.A", "boom.B"], "bore": 0.08, "mass": [18, 9], **SIZED},
            "position": 1.0,
        }
    },
}


def test_a_cylinder_is_two_links_and_three_joints() -> None:
    """The barrel is 0.7 m long from its end, the rod 1.4 - 0.7 from its own, each a uniform bar."""
    m = mechanism(BOOM)
    assert [(n, j.type, j.links, j.at) for n, j in m.joints.items()][1:] == [
        ("C_base", "pin", ("ground", "C_barrel"), ("A", "base")),
        ("C_head", "pin", ("boom", "C_rod"), ("B", "head")),
        ("C", "slider", ("C_barrel", "C_rod"), ("base", "head")),
    ]
    sized = mechanism(
        BOOM
        | {
            "drives": {
                "C": {
                    **BOOM["drives"]["C"],
                    "cylinder": {**BOOM["drives"]["C"]["cylinder"], "barrel_length": 0.8},
                }
            }
        }
    )
    for made, barrel, rod in ((m, 0.7, 0.7), (sized, 0.8, 0.6)):
        assert [made.mass(n) for n in ("C_barrel", "C_rod")] == [18, 9]
        assert made.center("C_barrel") == pytest.approx((barrel / 2, 0))
        assert made.center("C_rod") == pytest.approx((-rod / 2, 0))
        assert made.inertia("C_barrel") == pytest.approx(18 * barrel**2 / 12)
        assert made.inertia("C_rod") == pytest.approx(9 * rod**2 / 12)
    assert mechanism(m.to_tree()) == m
    says, _ = refused(m.with_values, {"links.C_rod.mass": 3.0})
    assert "the mass of a cylinder's link follows from the cylinder; change the mass of the cylinder" in says


@pytest.mark.parametrize(
    ("change", "says", "at"),
    [
        (
            {"between": ["ground.A", "bom.B"]},
            "the cylinder is between points of the link 'bom', which does not exist; did you mean 'boom'?",
            ("between", 1),
        ),
        (
            {"between": ["ground.Z", "boom.B"]},
            "link 'ground' has no point 'Z'; choose among O, A",
            ("between", 0),
        ),
        (
            {"between": ["ground.A", "ground.O"]},
            "both ends of the cylinder are on ground, so that its length is fixed; name points of two links",
            ("between",),
        ),
    ],
)
def test_a_cylinder_that_joins_nothing(change: dict[str, Any], says: str, at: tuple[Any, ...]) -> None:
    drive = {**BOOM["drives"]["C"], "cylinder": {**BOOM["drives"]["C"]["cylinder"], **change}}
    what, path = refused(with_cylinders, {**BOOM, "drives": {"C": drive}}, RULES)
    assert what.endswith(says)
    assert path == ("drives", "C", "cylinder", *at)


def test_links_and_joints_that_a_cylinder_would_make() -> None:
    rod = {"points": {"head": [0, 0]}, "mass": 9, "center": [-0.35, 0], "inertia": 9 * 0.49 / 12}
    alike = {**BOOM, "links": {**BOOM["links"], "C_rod": rod}}
    assert mechanism(alike).links.keys() == mechanism(BOOM).links.keys()
    for key, value in (("mass", 8), ("center", [-0.3, 0]), ("center", [-0.35, 0.1]), ("inertia", 0.3)):
        other = {**BOOM, "links": {**BOOM["links"], "C_rod": {**rod, key: value}}}
        assert (
            "link 'C_rod' exists, and the cylinder gives its rod and barrel their masses"
            in refused(mechanism, other)[0]
        )
    joint = {"type": "pin", "links": ["ground", "boom"], "at": "O"}
    taken = {**BOOM, "joints": {**BOOM["joints"], "C_head": joint}}
    assert (
        "joint 'C_head' exists, and the cylinder has one of this name; rename that joint"
        in refused(mechanism, taken)[0]
    )
    assert isinstance(mechanism(BOOM), Mechanism)
