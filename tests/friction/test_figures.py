"""Exact figures: the classic engine, the slider that jams, the collar, the four contacts of a guide, superposition."""

from __future__ import annotations

import math

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.circles import friction_circles
from dalembert.analysis.friction import guide_contact, joints_at_limit
from tests.friction.engines import collar, engine, guided, pushed_slider


@pytest.mark.parametrize(
    ("mu", "circle", "speed", "torque", "force"),
    [
        (0.4, "tan", 1.0, -4521.8475172, 22111.54224802),
        (0.4, "tan", -1.0, -7304.0150358, 22973.74855761),
        (0.4, "sin", 1.0, -4612.83866791, 22115.81371761),
        (0.4, "sin", -1.0, -7206.40213647, 22958.30435055),
        (0.05, "tan", 1.0, -5637.37610835, 22171.89276292),
        (0.05, "sin", 1.0, -5637.57546877, 22171.90509821),
        (0.05, "tan", -1.0, -6118.85212972, 22794.44090068),
    ],
)
def test_the_engine(mu: float, circle: str, speed: float, torque: float, force: float) -> None:
    r = da.statics(engine(mu, circle, speed=speed))
    assert r.effort("O")[0] == pytest.approx(torque, rel=1e-10)
    assert np.hypot(*r.reaction("A")[0]) == pytest.approx(force, rel=1e-10)
    assert r.ok.all()


def test_the_engine_arm_and_angle() -> None:
    r = da.statics(engine())
    circle = friction_circles(r, "A")
    line = circle.taken
    arm = line.point[0, 0] * line.direction[0, 1] - line.point[0, 1] * line.direction[0, 0]
    assert circle.radius == pytest.approx(0.024)
    # the arm to the line of the force on the crank's own friction circle: what is left of it is the torque
    assert abs(r.effort("O")[0]) / np.hypot(*r.reaction("A")[0]) == pytest.approx(0.2045016791, rel=1e-9)
    assert abs(arm) - 0.028 == pytest.approx(0.2045016791, rel=1e-9)
    assert math.degrees(math.atan2(*line.direction[0, ::-1])) == pytest.approx(-8.7603531215, rel=1e-9)


def test_the_engine_within_the_printed_figure() -> None:
    assert da.statics(engine()).effort("O")[0] == pytest.approx(-4484, rel=0.01)


@pytest.mark.parametrize(
    ("guide", "torque", "normal", "couple", "lower", "upper"),
    [
        (0.2, -4521.8475172, 3367.63159301, 353.78467597, 3367.63159301, 0.0),
        (0.11, -4521.8475172, 3367.63159301, 353.78467597, 3367.63159301, 0.0),
        (0.1, -4519.40973109, 3365.81605953, 353.5939461, 3450.87776026, 85.06170073),
        (0.08, -4506.78485039, 3356.41371969, 352.60618849, 3881.99553791, 525.58181822),
        (0.05, -4469.32989932, 3328.51926371, 349.67575183, 5161.01715015, 1832.49788644),
        (0.02, -4325.5354009, 3221.42876719, 338.4254189, 10071.34985609, 6849.92108891),
        (0.01, -4105.39317039, 3057.47853941, 321.20171832, 17588.8251857, 14531.3466463),
    ],
)
def test_the_engine_with_a_guide_of_finite_length(
    guide: float, torque: float, normal: float, couple: float, lower: float, upper: float
) -> None:
    r = da.statics(engine(guide=guide))
    assert r.effort("O")[0] == pytest.approx(torque, rel=1e-10)
    contact = guide_contact(r, "guide")
    found = contact.normal[0], contact.couple[0], contact.lower[0], contact.upper[0]
    assert found == pytest.approx((normal, couple, lower, upper), rel=1e-9, abs=1e-6)
    assert contact.mode[0] == ("lower face" if guide > 0.105 else "lower ahead, upper behind")


def test_the_engine_at_rest_is_a_band() -> None:
    r = da.statics(engine(speed=0.0))
    assert r.status == ("at_rest",)
    assert r.interval("O")[0] == pytest.approx([-7304.0150358, -4521.8475172], rel=1e-10)
    assert np.isnan(r.effort("O")[0])
    low, high = r.ends[0]
    assert joints_at_limit(low) == joints_at_limit(high) == ("O", "A", "B", "guide")
    assert np.hypot(*low.reaction("A")[0]) == pytest.approx(22973.74855761, rel=1e-10)
    assert np.hypot(*high.reaction("A")[0]) == pytest.approx(22111.54224802, rel=1e-10)


def test_the_engine_at_rest_with_a_known_torque_is_a_band_of_loads() -> None:
    m = engine(
        speed=0.0,
        drives={"O": {"position": 50, "effort": -4521.8475172}},
        loads={"gas": {"type": "force", "on": "piston", "at": "B", "value": "unknown", "direction": 180}},
    )
    r = da.statics(m)
    assert r.status == ("at_rest",)
    low, high = r.interval("gas")[0]
    assert low == pytest.approx(22089.32334555 * 4521.8475172 / 7304.0150358, rel=1e-9)
    assert high == pytest.approx(22089.32334555, rel=1e-9)


def test_coefficients_at_rest_beside_those_of_motion() -> None:
    m = engine(mu=0.3, speed=0.0, friction={"coefficient": 0.3, "static": 0.4, "circle": "tan"})
    assert da.statics(m).interval("O")[0] == pytest.approx([-7304.0150358, -4521.8475172], rel=1e-10)


@pytest.mark.parametrize(("mu", "force"), [(0.3, 202.0305), (0.9, 1414.2136), (0.999, 141421.3562)])
def test_a_rod_at_45_degrees_pushes_a_slider(mu: float, force: float) -> None:
    r = da.statics(pushed_slider(mu))
    assert r.unknown_load("rod")[0] == pytest.approx(100 / (math.cos(math.pi / 4) * (1 - mu)), rel=1e-9)
    assert r.unknown_load("rod")[0] == pytest.approx(force, rel=1e-6)
    assert r.friction.determinant[0] == pytest.approx(1 - mu, rel=1e-9)
    assert r.ok.all()


@pytest.mark.parametrize("mu", [1.001, 1.2, 2.0])
def test_a_rod_at_45_degrees_jams_above_1(mu: float) -> None:
    r = da.statics(pushed_slider(mu))
    assert r.status == ("jammed",)
    assert np.isnan(r.unknown_load("rod")[0])
    assert np.isnan(r.reaction("guide")[0]).all()
    assert r.friction.critical[0] == pytest.approx(1 / mu, rel=1e-9)
    assert r.reasons[0] == (
        "Friction jams the mechanism at guide = 1 m: no effort moves it in this sense, whatever its size. "
        f"It would move with less than {1 / mu:.6g} times the coefficients of friction."
    )


@pytest.mark.parametrize(
    ("mu", "force", "ratio"), [(0.3, 108.7857, 1.3), (1.001, 70.6753, 2.001), (1.2, 64.2824, 2.2)]
)
def test_the_other_sense_stays_on_the_physical_branch(mu: float, force: float, ratio: float) -> None:
    r = da.statics(pushed_slider(mu, speed=-1.0))
    assert r.unknown_load("rod")[0] == pytest.approx(force, rel=1e-6)
    assert r.friction.determinant[0] == pytest.approx(ratio, rel=1e-9)


@pytest.mark.parametrize("e", [0.0, 0.03, 0.05, 0.1, 0.15, 0.2, 0.25])
def test_an_eccentric_collar(e: float) -> None:
    r = da.statics(collar(e))
    delivered = 100 * (1 - 2 * 0.25 * e / 0.1)
    assert -r.effort("bar")[0] == pytest.approx(delivered, abs=1e-9)
    assert r.status == (("self_locking",) if e > 0.2 else ("ok",))


@pytest.mark.parametrize(
    ("normal", "couple", "mode", "lower", "upper"),
    [
        (10.0, 0.2, "lower face", 10.0, 0.0),
        (-10.0, 0.2, "upper face", 0.0, 10.0),
        (2.0, 1.0, "lower ahead, upper behind", 11.0, 9.0),
        (2.0, -1.0, "lower behind, upper ahead", 11.0, 9.0),
        (10.0, 0.5, "lower face", 10.0, 0.0),
        (0.0, 1.0, "lower ahead, upper behind", 10.0, 10.0),
    ],
)
def test_the_four_contacts_of_a_guide(
    normal: float, couple: float, mode: str, lower: float, upper: float
) -> None:
    r = da.statics(guided(normal, couple, 0.05, 0.05))
    contact = guide_contact(r, "guide")
    assert (contact.lower[0], contact.upper[0]) == pytest.approx((lower, upper), rel=1e-12, abs=1e-12)
    assert r.effort("guide")[0] == pytest.approx(0.3 * (lower + upper), rel=1e-12)
    assert contact.mode[0] == mode or abs(abs(2 * couple / 0.1) - abs(normal)) < 1e-12


def test_the_faces_of_a_guide_make_a_couple() -> None:
    """Friction mu N on the lower face, 0.04 m below the pin, turns the block; a guide off its middle."""
    r = da.statics(guided(10.0, 0.0, 0.05, 0.15, half_height=0.04))
    faces = -0.3 * 0.04 * 10.0
    assert r.friction_moment("guide")[0] == pytest.approx(faces, rel=1e-12)
    tilt = abs(2 * -faces - 0.1 * 10.0) / 0.2
    assert r.effort("guide")[0] == pytest.approx(0.3 * max(10.0, tilt), rel=1e-12)


def test_two_circles_joined_by_a_link_need_an_internal_tangent() -> None:
    """A rod between circles of 24 and 16 mm transmits nothing where it is shorter than 40 mm."""
    for length in (0.03, 0.0399, 0.0401, 0.06):
        m = engine(0.4, loads={"gas": {"type": "force", "on": "piston", "at": "B", "value": [-100, 0]}})
        m = m.with_values(
            {"links.rod.points.B": (length, 0.0), "joints.guide.friction": None, "joints.O.friction": None}
        )
        m = m.with_values({"links.crank.points.A": (0.001, 0.0), "drives.O.position": 1.5})
        jams = da.statics(m).status == ("jammed",)
        assert jams == (length < 0.04), length


def test_superposition_fails_and_scaling_holds() -> None:
    def torque(loads: dict[str, object]) -> float:
        return float(da.statics(engine(loads=loads)).effort("O")[0])

    def gas(k: float) -> dict[str, object]:
        return {"type": "force", "on": "piston", "at": "B", "value": [-22089.32334555 * k, 0]}

    w = {"type": "force", "on": "rod", "at": "W", "value": [0, -8000]}
    assert torque({"F": gas(1)}) == pytest.approx(-4521.8475171969, rel=1e-9)
    assert torque({"W": w}) == pytest.approx(1122.000537194, rel=1e-9)
    assert torque({"F": gas(1), "W": w}) == pytest.approx(-3675.7597329996, rel=1e-9)
    assert torque({"F": gas(2)}) == pytest.approx(-9043.6950343937, rel=1e-9)
    assert torque({"F": gas(-1)}) == pytest.approx(7304.0150357981, rel=1e-9)


def test_superposition_is_refused() -> None:
    with pytest.raises(da.ModelError, match="friction"):
        da.superposition(da.statics(engine()))


def test_the_dead_band_around_the_dead_centres() -> None:
    """Self-locking between the dead centres and 9.536624 and 167.3790397 deg of the seeds."""
    for edge, inner, outer in ((9.536624, 9.53, 9.55), (167.3790397, 167.39, 167.37)):
        assert da.statics(engine(position=inner)).status == ("self_locking",), edge
        assert da.statics(engine(position=outer)).status == ("ok",), edge


def test_a_guide_without_relative_motion_leaves_an_interval() -> None:
    r = da.statics(engine(position=0))
    assert r.status == ("at_rest",)
    low, high = r.interval("O")[0]
    assert 0 < low < high
    assert r.reasons[0] == (
        "No relative motion in guide at O = 0 deg: the friction there may have any value within its limits, "
        "and O lies in an interval."
    )
