"""Profiles of cams as curves of the follower: by arcs, flanks, discs and points, against plane geometry."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from dalembert.analysis.compile.elements.point_profiles import EACH, MOST, _fine, _powers, roller_too_large
from dalembert.analysis.compile.elements.profile_tables import CURVES
from dalembert.arrays import Array
from dalembert.core.elements.cam_curves import lift
from dalembert.errors import ModelError
from dalembert.model.joints.elements.cam_profiles import CamArc, CamPoints
from dalembert.model.joints.elements.cams import Cam

TURN = 2 * math.pi


def table(form: str, follower: Any, profile: dict[str, Any], zero: float = 0.0) -> Array:
    """Pieces of a cam with a profile of this form."""
    cam = Cam(links=("cam", "stem"), follower=follower, profile=profile)
    return CURVES[form](cam, "F", zero)


def curve(rows: Array, x: Array) -> tuple[Array, Array, Array]:
    """Value and two derivatives at directions."""
    value, first, second = lift(rows[None], np.asarray(x)[:, None])
    return value[:, 0], first[:, 0], second[:, 0]


def refused(form: str, follower: Any, profile: dict[str, Any]) -> tuple[str, tuple[Any, ...]]:
    with pytest.raises(ModelError) as raised:
        table(form, follower, profile)
    return str(raised.value), raised.value.path


# by points

ANGLES = np.array([0.1, 0.7, 1.2, 1.9, 2.5, 3.3, 4.0, 4.4, 5.3, 5.9])
RADII = 0.04 + 0.004 * np.cos(ANGLES - 0.4) + 0.0012 * np.sin(2 * ANGLES)
POINTS = CamPoints(tuple(ANGLES), tuple(RADII))
SPLINE = CubicSpline([*ANGLES, ANGLES[0] + TURN], [*RADII, RADII[0]], bc_type="periodic")
CLOSED = CamPoints((*POINTS.angle, ANGLES[0] + TURN), (*POINTS.radius, RADII[0]))


@pytest.mark.parametrize("points", [POINTS, CLOSED], ids=["open", "closed"])
def test_a_knife_on_a_cam_by_points_follows_the_cubic_through_them(points: CamPoints) -> None:
    x = np.linspace(0.1, 0.1 + TURN - 1e-6, 57)
    for order, values in enumerate(curve(table("points", "knife", {"points": points}), x)):
        assert values == pytest.approx(SPLINE(x, order), abs=1e-12)


def differences(of: Any, angle: Array) -> tuple[Array, Array, Array, Array]:
    """Direction, value and two derivatives by the direction of a curve (direction, value) of a parameter."""
    h = 1e-4
    at = [np.array(of(angle + k * h)) for k in (-2, -1, 0, 1, 2)]
    first = (at[0] - 8 * at[1] + 8 * at[3] - at[4]) / (12 * h)
    second = (-at[0] + 16 * at[1] - 30 * at[2] + 16 * at[3] - at[4]) / (12 * h * h)
    slope = first[1] / first[0]
    return at[2][0], at[2][1], slope, (second[1] - slope * second[0]) / first[0] ** 2


def normal_at(angle: Array) -> tuple[Array, Array]:
    """Point of the outline and its outward normal, as complex numbers."""
    r, slope = SPLINE(angle), SPLINE(angle, 1)
    tangent = (slope + 1j * r) * np.exp(1j * angle)
    return r * np.exp(1j * angle), -1j * tangent / np.abs(tangent)


def centre(angle: Array) -> tuple[Array, Array]:
    """The centre of a roller of 7 mm: its direction and distance."""
    point, normal = normal_at(angle)
    at = point + 0.007 * normal
    return angle + np.angle(at / np.exp(1j * angle)), np.abs(at)


def face(angle: Array) -> tuple[Array, Array]:
    """A face on the outline: the direction of its normal, and its distance from the axis."""
    point, normal = normal_at(angle)
    return angle + np.angle(normal / np.exp(1j * angle)), (point * normal.conj()).real


@pytest.mark.parametrize(("follower", "of"), [({"roller": 0.007}, centre), ("flat", face)])
def test_rollers_and_faces_follow_the_curve_beside_a_cam_by_points(follower: Any, of: Any) -> None:
    """The pieces have its value and both derivatives where they begin."""
    angle = _fine(POINTS)[0]
    inside = angle[np.abs(angle[:, None] - [*ANGLES, TURN + 0.1]).min(axis=1) > 1e-3]  # the cubic is smooth
    rows = table("points", follower, {"points": POINTS})
    assert len(rows) == EACH * len(ANGLES)
    assert (np.diff(rows[:, 0]) > 0).all()
    direction, value, slope, bend = differences(of, inside)
    got = curve(rows, direction + 1e-9)
    assert got[0] == pytest.approx(value, abs=1e-10)
    assert got[1] == pytest.approx(slope, abs=1e-8)
    assert got[2] == pytest.approx(bend, abs=1e-6)
    between = angle[:-1] + 0.37 * np.diff(angle)
    assert curve(rows, of(between)[0])[0] == pytest.approx(of(between)[1], abs=1e-8)


def test_points_are_refined_as_far_as_there_are_few() -> None:
    angle, (r, first, second) = _fine(POINTS)
    assert angle[:EACH] == pytest.approx(0.1 + 0.1 * np.arange(EACH), abs=1e-12)
    assert angle[EACH : EACH + 2] == pytest.approx([0.7, 0.7 + 0.5 / 6], abs=1e-12)
    for order, values in enumerate((r, first, second)):
        assert values == pytest.approx(SPLINE(angle, order), abs=1e-12)
    for count, each in ((MOST // 4, 4), (MOST // 4 + 1, 3), (MOST, 1), (MOST + 10, 1), (MOST // 6, 6)):
        x = np.linspace(0, TURN, count, endpoint=False)
        assert len(_fine(CamPoints(tuple(x), (0.03,) * count))[0]) == each * count


def test_bernsteins_form_becomes_powers() -> None:
    assert _powers(np.array([2.0, 5.0])).tolist() == [2.0, 3.0]
    assert _powers(np.array([1.0, 3.0, 2.0])).tolist() == [1.0, 4.0, -3.0]
    c = np.array([3.0, -1.0, 4.0, 7.0])
    powers, x = _powers(c), 0.3
    value = sum(math.comb(3, k) * x**k * (1 - x) ** (3 - k) * c[k] for k in range(4))
    assert np.polynomial.polynomial.polyval(x, powers) == pytest.approx(value, rel=1e-14)


HOLLOW = CamPoints(tuple(ANGLES), tuple(0.04 + 0.0125 * np.cos(2 * ANGLES)))


def test_a_roller_larger_than_the_hollow_and_a_face_over_it_are_refused() -> None:
    angle, (r, first, second) = _fine(HOLLOW)
    rho = (r * r + first * first) ** 1.5 / (r * r + 2 * first * first - r * second)
    k = int(np.flatnonzero(rho < 0)[np.argmin(-rho[rho < 0])])
    where = f"{math.degrees(angle[k]):.4g} deg"
    size = -rho[k]
    sentence, path = refused("points", {"roller": size * 1.001}, {"points": HOLLOW})
    assert sentence == (
        f"cam 'F': the roller does not fit the hollow at {where}, of radius {size * 1e3:.4g} mm; "
        "make the roller smaller than that"
    )
    assert path == ("joints", "F", "follower")
    assert len(table("points", {"roller": size * 0.999}, {"points": HOLLOW})) == EACH * len(ANGLES)
    sentence, path = refused("points", "flat", {"points": HOLLOW})
    begins = f"{math.degrees(angle[np.flatnonzero(rho < 0)[0]]):.4g} deg"
    assert sentence == (
        f"cam 'F': it is hollow at {begins}, where a flat face does not reach it; take a roller or a knife edge"
    )
    assert path == ("joints", "F", "follower")
    assert "at 350 deg, of radius 12.5 mm" in str(roller_too_large("F", -math.pi / 18, 0.0125))
    assert "at 0 deg" in str(roller_too_large("F", TURN - 1e-10, 0.0125))


# by arcs: a base circle of 30 mm, flanks, and a nose of 15 mm


def arcs(flank: float, nose: float, far: float) -> tuple[CamArc, ...]:
    """Arcs that meet smoothly; ``flank``: its radius, negative where it is hollow."""
    base = 0.03
    a, b = abs(flank - base), abs(flank - nose)  # of the flank's centre from those of the base and the nose
    x = (a * a + far * far - b * b) / (2 * far)
    y = math.copysign(math.sqrt(a * a - x * x), -flank)
    away = math.copysign(1.0, flank)
    on_base = math.atan2(-away * y, -away * x)
    at = (far + away * (far - x) / b * nose, -away * y / b * nose)
    on_nose = math.atan2(at[1], at[0])
    return (
        CamArc((far, 0.0), nose, on_nose),
        CamArc((x, y), flank, on_base),
        CamArc((0.0, 0.0), base, TURN - on_base),
        CamArc((x, -y), flank, TURN - on_nose),
    )


CONVEX, CONCAVE = arcs(0.1, 0.015, 0.025), arcs(-0.08, 0.015, 0.06)


@pytest.mark.parametrize(("some", "roller"), [(CONVEX, 0.01), (CONCAVE, 0.01), (CONVEX, 0.0)])
def test_a_roller_on_arcs_keeps_its_distance_from_their_centres(
    some: tuple[CamArc, ...], roller: float
) -> None:
    rows = table("arcs", {"roller": roller} if roller else "knife", {"arcs": some})
    assert len(rows) == 4
    ends = [*rows[1:, 0], rows[0, 0] + TURN]
    for arc, start, end in zip(some, rows[:, 0], ends, strict=True):
        x = np.linspace(start + 1e-6, end - 1e-6, 7)
        value, first, second = curve(rows, x)
        at = value * np.exp(1j * x) - complex(*arc.center)
        assert np.abs(at) == pytest.approx(abs(arc.radius + roller), rel=1e-12)
        assert math.copysign(1, arc.radius) * (at * np.exp(-1j * x)).real.min() > 0
        h = 1e-5
        before, behind = curve(rows, x[1:-1] - h), curve(rows, x[1:-1] + h)
        assert first[1:-1] == pytest.approx((behind[0] - before[0]) / (2 * h), abs=1e-8)
        assert second[1:-1] == pytest.approx((behind[1] - before[1]) / (2 * h), abs=1e-7)


def test_a_face_on_arcs_is_their_radius_beyond_their_centres() -> None:
    rows = table("arcs", "flat", {"arcs": CONVEX})
    for arc, start, end in zip(CONVEX, rows[:, 0], [*rows[1:, 0], rows[0, 0] + TURN], strict=True):
        x = np.linspace(start + 1e-6, end - 1e-6, 5)
        beyond = arc.center[0] * np.cos(x) + arc.center[1] * np.sin(x)
        assert curve(rows, x)[0] == pytest.approx(arc.radius + beyond, abs=1e-14)
        turned = -arc.center[0] * np.sin(x) + arc.center[1] * np.cos(x)
        assert curve(rows, x)[1] == pytest.approx(turned, abs=1e-14)


def test_arcs_that_no_follower_reaches_are_refused() -> None:
    sentence, path = refused("arcs", "flat", {"arcs": CONCAVE})
    assert sentence == ("cam 'F': a flat face does not reach its hollow arcs; take a roller or a knife edge")
    assert path == ("joints", "F", "follower")
    middle = math.degrees((CONCAVE[0].to + CONCAVE[1].to) / 2)
    for roller in (0.08, 0.081):
        assert refused("arcs", {"roller": roller}, {"arcs": CONCAVE})[0] == (
            f"cam 'F': the roller does not fit the hollow at {middle:.4g} deg, of radius 80 mm; "
            "make the roller smaller than that"
        )
    assert len(table("arcs", {"roller": 0.0799}, {"arcs": CONCAVE})) == 4


def test_arcs_that_do_not_meet_or_meet_at_an_angle_are_refused() -> None:
    round_ = CamArc((0.0, 0.0), 0.03, math.pi / 2)
    for radius, fits in ((0.03 * (1 + 5e-7), True), (0.03 * (1 + 5e-6), False), (0.04, False)):
        some = (round_, CamArc((0.0, 0.0), radius, TURN))
        if fits:
            assert len(table("arcs", "knife", {"arcs": some})) == 2
            continue
        sentence, path = refused("arcs", "knife", {"arcs": some})
        assert sentence == (
            f"cam 'F': at 90 deg one arc ends at 30 mm and the next begins at {radius * 1e3:.6g} mm; let them meet"
        )
        assert path == ("joints", "F", "profile", "arcs", 0)
    bent = (CamArc((0.0, 0.0), 0.03, math.pi / 2), CamArc((0.004, 0.0), math.hypot(0.03, 0.004), TURN))
    sentence, path = refused("arcs", "knife", {"arcs": bent})
    off = math.degrees(math.atan2(0.004, 0.03))
    assert sentence == (
        f"cam 'F': at 90 deg the tangents of two arcs differ by {off:.3g} deg; "
        "put the centres and the point where they meet on one line"
    )


@pytest.mark.parametrize(("roller", "zero"), [(0.008, 0.35), (0.012, -1.1)])
def test_a_tangent_cam_has_flanks_along_lines_and_a_nose_about_its_centre(roller: float, zero: float) -> None:
    tangent = {"base": 0.025, "lift": 0.012, "half_angle": math.radians(65)}
    rows = table("tangent", {"roller": roller}, {"tangent": tangent}, zero)
    half = math.radians(65)
    far = 0.012 / (1 - math.cos(half))
    nose = 0.025 + 0.012 - far + roller
    reach = math.atan2(far * math.sin(half), 0.025 + roller)
    x = np.array([0.3, 0.9]) * reach
    value = curve(rows, zero - half + x)[0]
    assert value * np.cos(x) == pytest.approx([0.025 + roller] * 2, rel=1e-12)
    assert curve(rows, zero + half - x)[0] == pytest.approx(value, rel=1e-12)
    x = np.linspace(-1, 1, 5) * (half - reach) * 0.99
    at = curve(rows, zero + x)[0] * np.exp(1j * x) - far
    assert np.abs(at) == pytest.approx([nose] * 5, rel=1e-12)
    for direction in (zero + half + 1e-3, zero + math.pi, zero + TURN - half - 1e-3):
        assert curve(rows, np.array([direction]))[0] == pytest.approx(0.025 + roller, rel=1e-12)
    sentence, path = refused("tangent", "flat", {"tangent": tangent})
    assert sentence == (
        "cam 'F': a flat face does not move on the flanks of a tangent cam, and jumps from end to end; "
        "take a roller"
    )
    assert path == ("joints", "F", "follower")


@pytest.mark.parametrize(("follower", "more"), [("knife", 0.0), ({"roller": 0.006}, 0.006)])
def test_a_disc_lifts_by_its_distance_from_the_centre(follower: Any, more: float) -> None:
    rows = table("eccentric", follower, {"eccentric": 0.005, "radius": 0.02})
    x = np.array([0.4, 2.0, 3.5, 5.5])
    at = curve(rows, x)[0] * np.exp(1j * x) - 0.005
    assert np.abs(at) == pytest.approx([0.02 + more] * 4, rel=1e-12)


def test_a_face_on_a_disc_is_its_radius_beyond_its_centre() -> None:
    x = np.array([0.4, 2.0, 3.5, 5.5])
    rows = table("eccentric", "flat", {"eccentric": 0.005, "radius": 0.02})
    for got, want in zip(
        curve(rows, x),
        (0.02 + 0.005 * np.cos(x), -0.005 * np.sin(x), -0.005 * np.cos(x)),
        strict=True,
    ):
        assert got == pytest.approx(want, abs=1e-15)
