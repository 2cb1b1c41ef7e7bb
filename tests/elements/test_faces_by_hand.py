"""Discs, cones, pads and what presses them: radii, areas and forces by hand."""

from __future__ import annotations

import math
from typing import Any

import pytest
from scipy.integrate import quad

from dalembert.errors import ModelError
from dalembert.model import Cone, Disc
from dalembert.model.joints.elements.brake_keys import Button, Clamp, Heat

INNER, OUTER = 0.06, 0.1
BETWEEN = ("ground", "disc")


def disc(**keys: Any) -> Disc:
    pressed = {} if keys.keys() & {"force", "pressure", "cylinder", "spring"} else {"force": 3000}
    size = {} if "button" in keys else {"radii": (INNER, OUTER)}
    return Disc(links=BETWEEN, **pressed, **size, **keys)


WORN, EVEN = 0.08, 2 / 3 * (0.001 - 0.000216) / (0.01 - 0.0036)


@pytest.mark.parametrize(
    ("keys", "radius", "area", "resultant"),
    [
        ({}, WORN, 2 * math.pi * 0.06 * 0.04, 0.0),
        ({"law": "pressure"}, EVEN, math.pi * 0.0064, 0.0),
        ({"sector": 1.2}, WORN, 1.2 * 0.06 * 0.04, math.sin(0.6) / 0.6 * WORN),
        ({"sector": 1.2, "law": "pressure"}, EVEN, 0.6 * 0.0064, math.sin(0.6) / 0.6 * EVEN),
    ],
)
def test_a_ring_and_its_parts(keys: dict[str, Any], radius: float, area: float, resultant: float) -> None:
    """By wear p r is the same everywhere, and the force an integral of p r over the angle."""
    part = disc(faces=3, **keys)
    assert part.friction_radius == pytest.approx(radius, rel=1e-14)
    assert part.force_area == pytest.approx(area, rel=1e-14)
    assert part.force_radius == pytest.approx(resultant, rel=1e-14)
    assert part.lever == pytest.approx(3 * radius, rel=1e-14)
    assert part.lining_area == pytest.approx(1.5 * keys.get("sector", 2 * math.pi) * 0.0064, rel=1e-14)
    assert part.edges == (INNER, OUTER)
    assert part.reach == OUTER


def over_distance(radius: float, at: float) -> float:
    """Integral of dA/distance over a disc, in its own polar coordinates: along each ray the root is integrable."""

    def ring(r: float) -> float:
        return (
            r * quad(lambda a: 1 / math.sqrt(at * at + r * r + 2 * at * r * math.cos(a)), 0, 2 * math.pi)[0]
        )

    return quad(ring, 0, radius)[0]


@pytest.mark.parametrize(("radius", "at"), [(0.02, 0.1), (0.05, 0.07)])
def test_a_round_pad(radius: float, at: float) -> None:
    pad = {"radius": radius, "at": at}
    inverse, size = over_distance(radius, at), math.pi * radius**2
    worn, even = disc(button=pad), disc(button=pad, law="pressure")
    assert worn.friction_radius == pytest.approx(size / inverse, rel=1e-4)
    assert worn.force_area == pytest.approx((at - radius) * inverse, rel=1e-4)
    assert even.friction_radius == at
    assert even.force_area == pytest.approx(size, rel=1e-14)
    assert worn.force_radius == even.force_radius == at
    assert worn.edges == pytest.approx((at - radius, at + radius), rel=1e-14)
    assert worn.reach == pytest.approx(at + radius, rel=1e-14)


@pytest.mark.parametrize(
    ("keys", "force"),
    [
        ({"force": 700}, 700),
        ({"force": 0}, 0),
        ({"force": "unknown"}, None),
        ({"pressure": 2e5}, 2e5 * 2 * math.pi * 0.06 * 0.04),
        ({"pressure": 2e5, "law": "pressure"}, 2e5 * math.pi * 0.0064),
        ({"cylinder": {"bore": 0.04, "pressure": 3e6}}, 3e6 * math.pi * 0.0004),
        ({"spring": {"stiffness": 4e4, "compression": 0.008}}, 320),
        ({"force": "unknown", "cylinder": {"bore": 0.04}}, None),
    ],
)
def test_what_presses_the_faces(keys: dict[str, Any], force: float | None) -> None:
    assert disc(**keys).clamped == (None if force is None else pytest.approx(force, rel=1e-14))


def test_a_cylinder_without_a_pressure_has_no_known_force() -> None:
    assert math.isnan(Clamp(bore=0.04).force)
    assert Clamp(bore=0.04).area == pytest.approx(0.04**2 * math.pi / 4, rel=1e-15)
    assert math.isnan(Clamp(stiffness=3, compression=2).area)


SIZE = "the size of its faces is not clear; give radii: [inner, outer]"
FORCES = "write one of force: 3 kN, force: unknown, pressure: 0.3 MPa, cylinder or spring"
PRESSES = (
    "what presses is not clear; write cylinder: {bore: 40 mm, pressure: 20 bar} or spring: {stiffness:, "
    "compression:}"
)


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ({"radii": (0.06, 0.1)}, f"no force presses its faces together; {FORCES}"),
        ({"radii": (0.06, 0.1), "force": 3, "pressure": 2}, f"force and pressure are given; {FORCES}"),
        (
            {"radii": (0.06, 0.1), "force": 3, "cylinder": {"bore": 0.04, "pressure": 2}},
            f"force and cylinder are given; {FORCES}",
        ),
        (
            {"radii": (0.06, 0.1), "cylinder": {"bore": 0.04}},
            f"no force presses its faces together; {FORCES}",
        ),
        ({"force": 3}, SIZE),
        ({"force": 3, "radii": (0.06, 0.1), "button": {"radius": 0.02, "at": 0.1}}, SIZE),
        (
            {"force": 3, "radii": (0.1, 0.1)},
            "the inner radius is not smaller than the outer; write [inner, outer]",
        ),
        ({"force": 3, "radii": (0.1,)}, "a list of 1 is given; two radii are needed; write [inner, outer]"),
        ({"force": 3, "radii": (-0.1, 0.2)}, "-0.1 is negative; write a positive one, or 0"),
        ({"force": -3, "radii": (0.1, 0.2)}, "-3 is negative; write a positive one, or 0"),
        (
            {"force": 3, "button": {"radius": 0.1, "at": 0.1}},
            "the pad reaches over the axis; make at larger than its radius",
        ),
    ],
)
def test_faces_that_are_not_clear(keys: dict[str, Any], says: str) -> None:
    with pytest.raises(ModelError) as caught:
        Disc(links=BETWEEN, **keys)
    error = caught.value
    assert f"{error.what}; {error.remedy}".endswith(says)


@pytest.mark.parametrize(
    "keys",
    [
        {},
        {"pressure": 2},
        {"stiffness": 3},
        {"compression": 3},
        {"bore": 2, "stiffness": 3, "compression": 4},
        {"bore": 2, "compression": 4},
    ],
)
def test_a_clamp_is_a_cylinder_or_a_spring(keys: dict[str, float]) -> None:
    with pytest.raises(ModelError) as caught:
        Clamp(**keys)
    assert str(caught.value) == PRESSES


def test_a_pad_may_nearly_reach_the_axis() -> None:
    assert Button(radius=0.0999, at=0.1).area("wear") > 0


@pytest.mark.parametrize(("mu", "out"), [(0.3, 1.3), (0.1, -0.6), (None, -1)])
def test_a_cone(mu: float | None, out: float) -> None:
    """Pushed in against the friction of its faces; drawn off where mu is above the tangent of the half angle."""
    half = math.atan(mu / (out + 1)) if mu else 0.4
    friction = {"coefficient": mu} if mu else None
    part = Cone(links=BETWEEN, radii=(INNER, OUTER), force=500, faces=2, half_angle=half, friction=friction)
    assert part.slope == pytest.approx(math.sin(half), rel=1e-15)
    assert part.lever == pytest.approx(2 * 0.08 / math.sin(half), rel=1e-14)
    assert part.lining_area == pytest.approx(2 * math.pi * 0.0064 / math.sin(half), rel=1e-14)
    assert part.push_in == pytest.approx(out + 2, rel=1e-12)
    assert part.draw_off == pytest.approx(out, rel=1e-12)


@pytest.mark.parametrize("half", [0.0, -0.2, math.pi / 2, 1.6])
def test_half_the_angle_of_a_cone_is_acute(half: float) -> None:
    with pytest.raises(ModelError) as caught:
        Cone(links=BETWEEN, radii=(INNER, OUTER), force=500, half_angle=half)
    assert caught.value.path == ("half_angle",)
    assert Cone(links=BETWEEN, radii=(INNER, OUTER), force=500, half_angle=1.57).slope < 1


@pytest.mark.parametrize(
    ("written", "capacity"),
    [
        ("460 J/(kg*K)", 460),
        ("0.46 kJ/(kg*K)", 460),
        (" 4.6e2J / ( kg * K ) ", 460),
        ("46E1 J/kg/K", 460),
        (460, 460),
    ],
)
def test_heat_a_kelvin(written: Any, capacity: float) -> None:
    heat = Heat(mass="3 kg", capacity=written)
    assert heat.capacity == pytest.approx(capacity, rel=1e-15)
    assert heat.per_kelvin == pytest.approx(3 * capacity, rel=1e-15)
    assert heat.model_dump(mode="json")["capacity"] == "460.0 J/(kg*K)"


@pytest.mark.parametrize(
    "written", ["460 J/kg", "460", "460 J/(kg*K) more", "460 MJ/(kg*K)", "0 J/(kg*K)", -3]
)
def test_what_is_no_heat_capacity(written: Any) -> None:
    with pytest.raises(ModelError):
        Heat(mass=3, capacity=written)
