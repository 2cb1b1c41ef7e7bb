"""Motion programmes: the textbooks' coefficients, derivatives by quadrature, laws over another drive, refusals."""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

import dalembert as da
from dalembert.errors import ModelError
from dalembert.model.drives.curves import Curve, CurvePiece, s_curve, trapezoid, unit_rise
from dalembert.model.drives.programmes import RISES

PI = math.pi
COEFFICIENTS = {  # Norton, Design of Machinery, table 8-3, in closed form; jerk inside the rise
    "constant_speed": (1.0, 0.0, 0.0),
    "parabolic": (2.0, 4.0, 0.0),
    "harmonic": (PI / 2, PI**2 / 2, PI**3 / 2),
    "cycloidal": (2.0, 2 * PI, 4 * PI**2),
    "polynomial345": (15 / 8, 10 / math.sqrt(3), 60.0),
    "polynomial4567": (35 / 16, 84 * math.sqrt(5) / 25, 105 / 2),
    "modified_sine": (4 * PI / (4 + PI), 4 * PI**2 / (4 + PI), 16 * PI**3 / (4 + PI)),
    "modified_trapezoid": (2.0, 8 * PI / (2 + PI), 32 * PI**2 / (2 + PI)),
}


def ram(law: object, **more: object) -> dict[str, Any]:
    """A ram on the ground's slide, with a shaft whose drive a law may be over."""
    return {
        "units": {"length": "mm"},
        "gravity": [0, 0],
        "links": {
            "ground": {"points": {"O": [0, 0], "P": [200, 0]}},
            "shaft": {"points": {"O": [0, 0]}},
            "ram": {"points": {"F": [0, 0]}, "mass": 2.0},
        },
        "joints": {
            "O": {"type": "pin", "links": ["ground", "shaft"]},
            "S": {"type": "slider", "links": ["ground", "ram"], "at": ["P", "F"], "direction": 90},
        },
        "drives": {"O": {"position": 0, **more}, "S": {"law": law}},
    }


RISE, BACK = {"to": 25, "in": "0.2 s", "by": "cycloidal"}, {"to": 0, "in": "0.3 s", "by": "modified_sine"}
TURN = [
    {"to": "25 mm", "in": "100 deg", "by": "cycloidal"},
    {"dwell": "40 deg"},
    {"to": "0 mm", "in": "120 deg", "by": "modified_sine"},
    {"dwell": "rest"},
]


def test_a_rise_has_the_coefficients_of_the_textbooks() -> None:
    assert set(RISES) == set(COEFFICIENTS)
    for form, expected in COEFFICIENTS.items():
        curve = Curve(unit_rise(form))
        assert [curve.peaks(k)[0] for k in (1, 2, 3)] == pytest.approx(expected, rel=1e-12, abs=1e-12), form
        assert curve.at(1.0)[0] == pytest.approx(1.0)
        assert curve.duration == 1.0


@pytest.mark.parametrize("form", [*RISES, "trapezoidal", "s_curve", "negative s_curve"])
def test_each_rate_is_the_derivative_of_the_one_before(form: str) -> None:
    """Changes by quadrature of the next rate, within every piece; peaks are not passed anywhere."""
    pieces = {
        "trapezoidal": lambda: trapezoid([1, 2, 3]),
        "s_curve": lambda: s_curve(0.5, 0.8, 4, 50)[0],
        "negative s_curve": lambda: s_curve(-0.12, 0.8, 4, 50)[0],
    }.get(form, lambda: unit_rise(form))()
    curve = Curve(pieces)
    for start, end in pairwise(curve.times):
        low, high = start + 0.1 * (end - start), end - 0.2 * (end - start)
        for order in range(3):
            change = quad(lambda t, k=order + 1: curve.at(t)[k], low, high, epsabs=1e-13)[0]
            assert change == pytest.approx(curve.at(high)[order] - curve.at(low)[order], abs=1e-10)
    dense = curve.at(np.linspace(0, curve.duration, 4001))
    for order in (1, 2, 3):
        peak, where = curve.peaks(order)
        assert np.abs(dense[order]).max() <= peak * (1 + 1e-12)
        sides = [curve.at(where, before=side)[order] for side in (False, True)]
        assert max(map(abs, sides)) == pytest.approx(peak)
    repeated = Curve(pieces, periodic=True)
    assert not curve.jumps(0)
    assert len(repeated.jumps(2)) == {"parabolic": 2, "harmonic": 1, "trapezoidal": 3}.get(form, 0)


@pytest.mark.parametrize(
    ("rise", "duration", "peak", "reached"),
    [
        (0.5, 0.905, 0.8, "speed, acceleration and jerk"),
        (0.12, 0.43552777669262355, 0.551055553385247, "acceleration and jerk"),
        (0.02, 0.23392141905702932, 50 * (0.02 / 100) ** (2 / 3), "jerk"),
    ],
)
def test_an_s_curve_takes_the_least_time_within_its_limits(
    rise: float, duration: float, peak: float, reached: str
) -> None:
    """Limits 0.8 m/s, 4 m/s^2, 50 m/s^3; where the speed's limit is low, the acceleration's is not reached."""
    pieces, said = s_curve(rise, 0.8, 4.0, 50.0)
    curve = Curve(pieces)
    assert (curve.duration, curve.peaks(1)[0]) == pytest.approx((duration, peak))
    assert said == reached
    assert curve.at(duration, before=True)[:3] == pytest.approx([rise, 0, 0], abs=1e-12)
    slow, said = s_curve(0.5, 0.2, 4.0, 50.0)  # v j < a^2
    assert said == "speed and jerk"
    assert Curve(slow).peaks(2)[0] == pytest.approx(50 * math.sqrt(0.2 / 50))


def test_a_programme_over_a_drive_is_that_over_time_at_constant_speed() -> None:
    """And beside it s'' w^2 + s' alpha; whole turns and turns back do not matter."""
    w, at = 10.0, np.array([-400.0, -30.0, 10, 30, 100, 120, 170, 230, 300, 770])
    r = da.dynamics(
        da.mechanism(ram({"over": "O", "segments": TURN}, position=at.tolist(), speed="10 rad/s"))
    )
    timed = [{**s} for s in TURN]
    for s in timed:
        key = "in" if "in" in s else "dwell"
        angle = 100 if s[key] == "rest" else float(str(s[key]).split()[0])
        s[key] = f"{math.radians(angle) / w!r} s"
    m = da.mechanism(ram({"segments": timed, "count": 2, "periodic": True}))
    law = m.drives["S"].law
    assert law is not None
    s, v, a, _ = law.curve.at(np.radians(at) / w)
    assert r.drive_position("S") == pytest.approx(s)
    assert r.drive_speed("S") == pytest.approx(v)
    assert r.effort("S") == pytest.approx(2.0 * a)
    spun = da.dynamics(
        da.mechanism(
            ram({"over": "O", "segments": TURN}, position=30, speed="10 rad/s", acceleration="5 rad/s^2")
        )
    )
    values = spun.drive_position("S")[0], spun.drive_speed("S")[0], spun.drive_acceleration("S")[0]
    assert values == pytest.approx((3.7158663567967145e-3, 0.1875028727214618, 4.997988637952187))


@pytest.mark.parametrize("speed", [10.0, -10.0])
def test_forces_have_two_numbers_where_the_acceleration_jumps(speed: float) -> None:
    """Before and after, by the sense in which the other drive turns; beside the joint of pieces there is one."""
    turn = [
        {"to": "25 mm", "in": "100 deg", "by": "harmonic"},
        {"dwell": "40 deg"},
        {"to": 0, "in": "120 deg", "by": "parabolic"},
        {"dwell": "rest"},
    ]
    at = [0, 50, 100, 100 + 1e-6, 140, 200, 260, 300]
    m = da.mechanism(ram({"over": "O", "segments": turn}, position=at, speed=f"{speed} rad/s"))
    r = da.dynamics(m)
    assert r.status == ("jump", "ok", "jump", "ok", "jump", "jump", "jump", "ok")
    assert r.after is not None
    slow, fast = (2 * speed**2 * x for x in (0.0125 * (1.8) ** 2, 0.1 * (1.5 / PI) ** 2))  # m s'' w^2
    clockwise = [(0, slow), (-slow, 0), (0, -fast), (-fast, fast), (fast, 0)]
    two = np.array(clockwise)[:, :: int(np.sign(speed))].T
    jumps = np.flatnonzero(np.array(r.status) == "jump")
    for side, expected in zip(r.sides, two, strict=True):
        assert side.effort("S")[jumps] == pytest.approx(expected, abs=1e-12)
        assert side.drive_acceleration("S")[jumps] == pytest.approx(expected / 2, abs=1e-12)
        assert side.power_balance.max() < 1e-12
    assert "The acceleration of drive 'S' jumps at O = 0 deg and S = 0 mm" in str(r.reasons[0])
    answer = da.compile(m, ["links.ram.mass"], ["effort.S"])([[2.0], [4.0]])
    assert tuple(answer.status[1]) == r.status
    for side, both in zip(r.sides, answer.both_sides("effort.S"), strict=True):
        assert both[1] == pytest.approx(2 * side.effort("S"), abs=1e-12)
    largest = da.compile(m, ["links.ram.mass"], ["effort.S"], reduce="peak")([[2.0]])
    assert largest["effort.S"][0] == pytest.approx(max(slow, fast))
    assert set(da.statics(m).status) == {"ok"}


def test_a_polynomial_ends_with_the_rates_it_is_given() -> None:
    """40 mm from rest to 0.3 m/s without acceleration, then even: a = 6 (h/T^2) ... by hand at half time."""
    ends = {"speed": ["0 m/s", "0.3 m/s"], "acceleration": ["0 m/s^2", "0 m/s^2"]}
    even = {"speed": "0.3 m/s", "in": "0.1 s"}
    law = da.mechanism(
        ram({"segments": [{"to": 40, "in": "0.25 s", "by": "polynomial", "ends": ends}, even], "count": 8})
    )
    curve = law.drives["S"].law.curve  # type: ignore[union-attr]
    assert curve.at(0.125)[0] == pytest.approx(8.28125e-3)
    assert curve.peaks(2)[0] == pytest.approx(1.847520861406802)
    assert curve.at(0.0)[3] == pytest.approx(38.4)
    assert curve.at(0.35)[0] == pytest.approx(0.07)
    spline = {
        "by": "spline",
        "time": [0, 1, 2, 4],
        "position": [0, 5, 3, 0],
        "ends": {"speed": [0, "1 mm/s"]},
    }
    curve = da.mechanism(ram({"segments": [spline], "count": 9})).drives["S"].law.curve  # type: ignore[union-attr]
    assert curve.at(np.array([0, 1, 2, 4]))[0] == pytest.approx([0, 5e-3, 3e-3, 0], abs=1e-15)
    assert [curve.at(0.0)[1], curve.at(4.0)[1]] == pytest.approx([0, 1e-3], abs=1e-12)
    assert not [*curve.jumps(1), *curve.jumps(2)]


def test_a_programme_is_written_as_it_is_read() -> None:
    limits = {"speed": "0.3 m/s", "acceleration": "4 m/s^2"}
    laws = (
        {"over": "O", "segments": TURN},
        {"segments": [RISE, {"dwell": "0.1 s"}, BACK], "count": 40, "periodic": True},
        {
            "segments": [{"to": 50, "by": "trapezoidal", **limits}, {"dwell": "0.1 s"}],
            "count": 9,
            "from": "10 mm",
        },
        {"segments": [{"to": 50, "in": "2 s", "by": "trapezoidal", "parts": [1, 2, 1]}], "count": 3},
        {"segments": [{"to": 50, "by": "s_curve", **limits, "jerk": "50 m/s^3"}], "count": 3},
    )
    for law in laws:
        m = da.mechanism(ram(law))
        again = da.mechanism(m.model_dump(mode="json"))
        assert again.drives["S"].law == m.drives["S"].law
        assert again == m
    limited = da.mechanism(ram(laws[2])).drives["S"].law.curve  # type: ignore[union-attr]
    assert limited.duration == pytest.approx(0.04 / 0.3 + 0.3 / 4 + 0.1)
    assert limited.peaks(1)[0] == pytest.approx(0.3)
    short = da.mechanism(ram({"segments": [{"to": 20, "by": "trapezoidal", **limits}], "count": 3}))
    assert short.drives["S"].law.curve.duration == pytest.approx(2 * math.sqrt(0.02 / 4))  # type: ignore[union-attr]


def test_the_law_of_a_drive_has_its_coefficients_and_peaks() -> None:
    m = da.mechanism(ram({"over": "O", "segments": TURN}, position=0))
    law, other = da.law(m, "S"), da.law(m, "S", by="modified_sine")
    assert tuple(law.coefficients.values()) == pytest.approx(COEFFICIENTS["cycloidal"])
    assert tuple(other.coefficients.values()) == pytest.approx(COEFFICIENTS["modified_sine"])
    b = math.radians(100)
    assert law.peak_speed == pytest.approx(2 * 0.025 / b)
    assert law.peak_acceleration == pytest.approx(2 * PI * 0.025 / b**2)
    assert np.abs(law.acceleration).max() == pytest.approx(law.peak_acceleration, rel=1e-12)
    assert law.times == pytest.approx(np.radians([0, 100, 140, *(140 + 120 * np.array([1, 7, 8]) / 8), 360]))
    text = str(other)
    assert "Law of S over O, 360 deg long." in text
    assert "modified_sine     0   25  100  1.7596  5.52796  69.4664" in text
    worked = da.report(
        da.dynamics(da.mechanism(ram({"over": "O", "segments": TURN}, position=75, speed="10 rad/s")))
    )
    peaks = [2 * 25e-3 / (b / 10), 2 * PI * 25e-3 / (b / 10) ** 2, 4 * PI**2 * 25e-3 / (b / 10) ** 3]
    row = next(line for line in worked.to_bytes("txt").decode().splitlines() if line.startswith("cycloidal "))
    assert list(map(float, row.split()[1:6])) == pytest.approx(
        [100, 25, *COEFFICIENTS["cycloidal"]], rel=5e-4
    )
    assert list(map(float, row.split()[6:])) == pytest.approx([x * 1e3 for x in peaks], rel=5e-4)
    harmonic = da.law(da.mechanism(ram({"segments": [{**RISE, "by": "harmonic"}, BACK], "count": 9})), "S")
    assert "The acceleration jumps at 0.2 s." in str(harmonic)
    rise = {"type": "polynomial345", "from": 0, "to": 10, "duration": "2 s", "count": 5}
    assert da.law(da.mechanism(ram(rise)), "S").coefficients["C_j"] == pytest.approx(60)
    table = {"type": "table", "time": [0, 1, 2, 3], "position": [0, 1, 4, 9], "count": 5}
    assert da.law(da.mechanism(ram(table)), "S").acceleration == pytest.approx(2e-3)
    with pytest.raises(ModelError, match="drive 'O' has no law of motion"):
        da.law(m, "O")
    with pytest.raises(ModelError, match="unknown motion curve 'sine'; choose among constant_speed"):
        da.law(m, "S", by="sine")


@pytest.mark.parametrize(
    ("law", "words"),
    [
        ({"segments": [], "count": 3}, "an empty list is not a list of segments"),
        ({"segments": [{**RISE, "by": "sine"}], "count": 3}, "unknown motion curve 'sine'"),
        ({"segments": [{"to": 5, "in": "1 s"}], "count": 3}, "the key 'by' is missing"),
        ({"segments": [{**RISE, "in": "0 s"}], "count": 3}, "'0 s' is not positive"),
        ({"segments": [{**RISE, "in": "30 deg"}], "count": 3}, "a time"),
        (
            {"segments": [{"to": 5, "in": "1 s", "by": "constant_speed"}, RISE], "count": 3},
            "the speed jumps from 0.005",
        ),
        (
            {"segments": [RISE, {"dwell": "rest"}], "count": 3},
            "fills a turn of another drive, and this law is over time",
        ),
        ({"segments": [RISE], "count": 3, "periodic": True}, "does not end where it begins"),
        ({"over": "O", "segments": TURN[:3]}, r"the segments fill 260 deg of a turn.*add \{dwell: rest\}"),
        ({"over": "O", "segments": [*TURN[:3], {"dwell": "110 deg"}]}, "the segments fill 370 deg"),
        ({"over": "S", "segments": [{"to": 0, "in": 5, "by": "cycloidal"}]}, "over each other in a circle"),
        ({"over": "Q", "segments": TURN}, "over 'Q', which is not a drive"),
        (
            {"over": "O", "segments": [{"to": 5, "by": "s_curve", "speed": 1, "acceleration": 1, "jerk": 1}]},
            "limits of speed",
        ),
        (
            {
                "segments": [{"to": 5, "in": "1 s", "by": "polynomial", "ends": {"acceleration": [0, 0]}}],
                "count": 3,
            },
            "below it",
        ),
        (
            {"segments": [{"to": 5, "in": "1 s", "by": "trapezoidal", "parts": [0, 1, 0]}], "count": 3},
            "are not the parts",
        ),
        (
            {"segments": [{"by": "spline", "time": [0, 2, 1, 3], "position": [0, 1, 2, 3]}], "count": 3},
            "item 3 is not greater",
        ),
    ],
)
def test_a_programme_that_makes_no_sense_is_refused(law: dict[str, Any], words: str) -> None:
    with pytest.raises(ModelError, match=words):
        da.kinematics(da.mechanism(ram(law)))


@pytest.mark.parametrize(("slope", "places"), [
    ([1.25, -1, 1], []),  # (u - 0.5)^2 + 1: its roots are 0.5 + i and 0.5 - i
    ([0.16, -1, 1], [0.2, 0.8]),
    ([-0.24, -1, 1], []),  # -0.2 and 1.2 are outside of the piece
])  # fmt: skip
def test_a_polynomial_is_stationary_at_the_real_roots_of_its_slope(
    slope: list[float], places: list[float]
) -> None:
    piece = CurvePiece(1.0, (3.0, *(c / (k + 1) for k, c in enumerate(slope))))
    assert sorted(piece.extremes(0)) == pytest.approx(places)
    assert piece.extremes(1) == pytest.approx([0.5])
