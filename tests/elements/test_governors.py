"""Governors and a clutch of the books in the plane that turns, and against models in space that turn by a drive."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from tests.machine.published_calls import FOOT, INCH, LEVERS, POUND, RPM, case

PORTER = """units: {length: in, force: lbf, mass: lb}
gravity: [0, -32.2 ft/s^2]
links:
  ground: {points: {O: [0, 0]}}
  upper:  {points: {O: [0, 0], B: [12, 0]}, mass: 15, center: [12, 0]}
  lower:  {points: {B: [0, 0], C: [12, 0]}}
  sleeve: {points: {S: [0, 0], C: [1.5, 0]}, mass: 60}
joints:
  O:    {type: pin, links: [ground, upper]}
  B:    {type: pin, links: [upper, lower]}
  C:    {type: pin, links: [lower, sleeve]}
  lift: {type: slider, links: [ground, sleeve], at: [O, S], direction: 90, angle: -90}
drives: {O: {position: [-48.18968510422141, -33.55730976192071]}}
turning: {axis: y, speed: unknown}
assembly: {upper: -48, lower: -120, sleeve: 0}
"""


def test_a_porter_governor_with_its_lower_arms_off_the_axis() -> None:
    """Bevan, example 13.1."""
    r = da.statics(da.loads(PORTER))
    assert r.point("upper", "B")[:, 0] == pytest.approx([8 * INCH, 10 * INCH], rel=1e-12)
    assert r.turning_speed / RPM == pytest.approx([176.20963733491163, 201.7496684519479], rel=1e-8)
    assert not r.turning_torque.any()


@pytest.mark.parametrize("rpm", [0.0, 120.0, 240.0])
def test_the_spatial_model_with_the_turn_as_a_drive_has_the_same_reactions(rpm: float) -> None:
    flat = da.statics(da.loads(PORTER.replace("unknown", f"{rpm} rpm")))
    angles = [math.asin(radius / 12) for radius in (8, 10)]
    for k, angle in enumerate(angles):
        m = case("GOV-1", drives__turn__speed=rpm * RPM)
        space = da.dynamics(m.with_values({"drives.O": {"position": angle, "speed": 0.0}}))
        assert abs(space.effort("O")[0]) == pytest.approx(abs(flat.effort("O")[k]), abs=1e-9)
        for joint in ("O", "B"):
            turned = space.reaction(joint)[0]  # x and z of space are x and y of the plane
            assert [abs(turned[0]), abs(turned[2])] == pytest.approx(
                np.abs(flat.reaction(joint)[k]), abs=1e-8
            )
            assert turned[1] == pytest.approx(0.0, abs=1e-9)


def test_swinging_in_the_turning_plane_is_the_spatial_motion() -> None:
    """Speed and acceleration of the arm too: Coriolis forces are normal to the plane, and load the shaft."""
    moving = {"drives.O": {"position": [-0.8], "speed": 3.0, "acceleration": -7.0}}
    flat = da.dynamics(da.loads(PORTER.replace("unknown", "90 rpm")).with_values(moving))
    m = case("GOV-1", drives__turn__speed=90 * RPM)
    # the spatial drive is the angle from the vertical, which grows as the planar one does
    arm = {"position": math.pi / 2 - 0.8, "speed": 3.0, "acceleration": -7.0}
    space = da.dynamics(m.with_values({"drives.O": arm}))
    assert abs(flat.effort("O")[0]) == pytest.approx(abs(space.effort("O")[0]), rel=1e-9)
    assert abs(flat.turning_torque[0]) == pytest.approx(abs(space.effort("turn")[0]), rel=1e-9)


def test_small_swings_of_the_spatial_model_are_those_of_the_turning_plane() -> None:
    """About the height that it has at 176 rpm, the turn of the spindle going on; by its equation of motion too."""
    space = case("GOV-1", drives__turn__speed=176 * RPM)
    there = {"drives.O": {"position": "unknown", "effort": 0, "range": ["-80 deg", "-10 deg"]}}
    r, flat = (
        da.dynamics(space),
        da.statics(da.loads(PORTER.replace("unknown", "176 rpm")).with_values(there)),
    )
    assert r.drive_position("O") == pytest.approx(math.pi / 2 + flat.drive_position("O"), rel=1e-9)
    swings = da.small_swings(r)
    assert swings == pytest.approx(da.small_swings(flat), rel=1e-7)
    off = 1e-6
    start = {"O": {"position": float(r.drive_position("O")[0]) + off, "speed": 0.0}}
    held = space.with_values({"drives.O": {"position": 0.0, "effort": 0.0}})
    s = da.simulate(held, math.pi / swings[0] / 2, start=start)
    assert s.position("O")[-1] == pytest.approx(r.drive_position("O")[0], abs=1e-3 * off)


def racks(**more: float) -> da.Mechanism:
    """Half a spring governor whose arms stay right-angled, its ball in a plane that turns about x = 5 - least."""
    given = {"long": 4.0, "mass": 3 * POUND * 9.80665 / (32.2 * FOOT), "least": 3.0, "lean": 0.0} | more
    text = LEVERS % (given | {"out": 0.0, "speed": 0.0})
    tree = da.loads(text).to_tree()
    del tree["loads"]["turning"]
    tree["links"]["ball"]["mass"] = f"{given['mass']!r} kg"
    at = [f"{5 - given['least']} in", "0 in"]
    return da.mechanism({**tree, "turning": {"axis": "y", "at": at, "speed": "1 rpm"}})


def pressed(m: da.Mechanism, out: float, rpm: float) -> float:
    """lbf on the sleeve by half the governor."""
    values: dict[str, Any] = {"drives.radius.position": out * INCH, "turning.speed": f"{rpm} rpm"}
    return float(da.statics(m.with_values(values)).unknown_load("spring")[0]) / (POUND * 9.80665)


def test_a_hartnell_governor_at_a_middle_radius() -> None:
    """Bevan, example 13.3: no obliquity."""
    m = racks()
    low, high, unit = pressed(m, 0, 300), pressed(m, 1.5, 318), pressed(m, 0.5, 1)
    rate = 2 * (high - low) / 0.75
    found = [math.sqrt((low + rate / 2 * 0.25) / unit), rate]
    assert found == pytest.approx([307.84318828167784, 84.0326317578466], rel=1e-8)


def test_a_spring_governor_with_the_weight_of_its_balls() -> None:
    """Bevan, example 13.5."""
    m = racks(long=4.5, least=2.5, lean=3 * POUND * 9.80665)
    rate = 2 * (pressed(m, 1.125, 252) - pressed(m, 0, 240)) / 0.5
    assert rate == pytest.approx(59.304319765737915, rel=1e-8)


def test_a_centrifugal_clutch() -> None:
    """Bhandari, example 11.12: a shoe on its slide in the turning plane, held back by a spring until 500 rpm."""
    text = """
links: {ground: {points: {O: [0, 0]}}, shoe: {points: {G: [0, 0]}, mass: 2.6806470178243726}}
joints: {slide: {type: slider, links: [ground, shoe], at: [O, G]}}
drives: {slide: {position: 140 mm}}
turning: {axis: y, speed: %g rpm}
"""
    spring, pull = (float(da.statics(da.loads(text % n)).effort("slide")[0]) for n in (500, 750))
    torque = 4 * 0.3 * (spring - pull) * 0.165
    assert torque * 750 * RPM == pytest.approx(20e3, rel=1e-8)


def test_a_governor_that_is_isochronous_somewhere_says_where() -> None:
    """A rod above a spring that is too soft further out: the speed has an extreme, and falls behind it."""
    m = da.hartnell_governor(spring_rate="3 N/mm", sweep=(0.0, -0.5))
    g = da.governor(m)
    assert g.stable.any() == (np.diff(g.speed) > 0).any()
    soft = da.governor(da.hartnell_governor(spring_rate="1 N/mm"))
    assert not soft.stable.any()
    assert "no" in soft.text()
    with pytest.raises(da.ModelError, match="the plane does not turn; give it turning"):
        da.governor(da.four_bar())
    with pytest.raises(da.ModelError, match="drive 'O' has one position; give range=\\(first, last\\)"):
        da.governor(da.loads(PORTER.replace("[-48.18968510422141, -33.55730976192071]", "-40")))


def test_effort_and_power_tend_to_the_books() -> None:
    """Porter, equal arms on the axis: c (m + M) g, and 4 c^2 / (1 + 2 c) (m + M) g h; half of it is written."""
    g = da.governor(da.porter_governor(), count=401)
    weight = (5 + 30) * 9.80665 / 2
    assert g.sleeve_force == pytest.approx(weight, rel=1e-9)
    assert g.effort(0.01) == pytest.approx(weight * (0.01 + 0.01**2 / 2), rel=1e-9)
    heights = 0.25 * np.sin(np.radians(np.linspace(60, 35, 401)))
    assert g.book_power(0.1) == pytest.approx(4 * 0.1**2 / 1.2 * weight * heights, rel=1e-9)
    assert g.book_effort(0.1) == pytest.approx(0.1 * weight, rel=1e-9)
    middle = 100
    assert g.power(0.01)[middle] == pytest.approx(g.book_power(0.01)[middle], rel=2e-2)
    assert g.lift_for(0.01)[middle] == pytest.approx(
        2 * (0.25 * math.sin(1.0471975511965976 - middle / 400 * math.radians(25)))
        * (1 - 1 / 1.01**2), rel=1e-3,
    )  # fmt: skip
    assert g.stable.all()
    assert g.isochronous == ()


def test_the_isochronous_place_is_where_the_speed_is_greatest() -> None:
    """Found between coarse positions, against a parabola through fine ones; and the governor is drawn."""

    def made(positions: int, sweep: tuple[str, str]) -> Any:
        return da.governor(da.hartnell_governor(preload="1400 N", sweep=sweep, positions=positions))

    (coarse,) = made(15, ("30 deg", "-40 deg")).isochronous
    fine = made(41, ("-33 deg", "-37 deg"))
    q = np.radians(np.linspace(-33, -37, len(fine.speed)))
    a, b, _ = np.polyfit(q - q.mean(), fine.speed, 2)
    assert a < 0
    assert coarse == pytest.approx(q.mean() - b / (2 * a), abs=1e-3)
    assert fine.isochronous == pytest.approx((coarse,), abs=1e-6)
    assert len(fine.drawings(da.Notation())) == 1


SPRUNG = """gravity: standard
links: {ground: {points: {O: [0, 0]}}, bob: {points: {O: [0, 0]}, mass: 2, center: [0.5, 0]}}
joints: {O: {type: pin, links: [ground, bob]}}
drives: {O: {position: unknown, effort: 0, range: RANGE}}
loads: {S: {type: torsion_spring, joint: O, stiffness: 1 N*m/rad, free_angle: FREE}}
turning: {speed: 8 rad/s}
"""


@pytest.mark.parametrize("ends", [(-171, -10), (-170, -90), (-90, -10), (-80, 80), (-170, -100)])
@pytest.mark.parametrize("free", [-90, -88, -92])
def test_a_bob_leaves_its_lowest_place_only_if_its_spring_is_at_rest_in_it(
    ends: tuple[float, float], free: float
) -> None:
    """(m g c + k)/(m c^2) = W^2 where the spring is free below; else the bob hangs beside it from the first, and two
    more equilibria appear on the other side, at the least W^2 = -(m g c cos q + k (q - q_0))/(m c^2 sin q cos q)."""
    text = SPRUNG.replace("RANGE", f"[{ends[0]}, {ends[1]}]").replace("FREE", f"{free} deg")
    t = da.turning_range(da.loads(text))
    q = np.radians(np.linspace(*ends, 200_001)[1:-1])
    with np.errstate(all="ignore"):
        squares = -(9.80665 * np.cos(q) + q - math.radians(free)) / (0.5 * np.sin(q) * np.cos(q))
    least = (squares[1:-1] < squares[:-2]) & (squares[1:-1] < squares[2:]) & (squares[1:-1] > 0)
    if free == -90:
        here = ends[0] <= -90 <= ends[1]
        assert t.folds == ()
        assert np.degrees(t.at) == pytest.approx([-90.0] if here else [])
        assert t.bifurcation == pytest.approx([math.sqrt(10.80665 / 0.5)] if here else [])
    else:
        assert t.bifurcation == t.at == ()
        assert t.folds == pytest.approx(np.sqrt(squares[1:-1][least]).tolist(), rel=1e-6)
