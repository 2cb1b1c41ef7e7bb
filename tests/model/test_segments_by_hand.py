"""Segments of a motion law one by one: their curves by elementary formulas, their keys, and what is refused."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from dalembert.errors import ModelError
from dalembert.model import read_file
from dalembert.model.drives.curves import Curve
from dalembert.model.drives.laws import Rise, TimeTable
from dalembert.model.drives.laws import law as read_law
from dalembert.model.drives.programmes import Programme, Segment
from dalembert.model.drives.written_programmes import count, programme
from dalembert.model.part import ReadingRules

RULES = ReadingRules()
OVER = ReadingRules(freedoms={"O": "turn", "S": "slide"})


def curve(*segments: dict[str, Any], kind: str = "length", **more: Any) -> Curve:
    return programme({"segments": list(segments), **more}, kind, RULES).curve


def said(tree: dict[str, Any], rules: ReadingRules = RULES) -> tuple[str, tuple[Any, ...]]:
    with pytest.raises(ModelError) as caught:
        programme(tree, "length", rules)
    return f"{caught.value.what}; {caught.value.remedy}", caught.value.path


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(
    ("rise", "ramp", "even"),
    [
        (0.5, 0.4, 0.5 / 0.8 - 0.4),  # reaches its speed v = 0.8 after v/a, and has v (even + ramp) = rise
        (0.08, 0.2, 0.0),  # turns round at half way: a ramp^2 = rise
        (0.32, 0.4, 0.0),  # both at once
    ],
)
def test_a_rise_within_limits_of_speed_and_acceleration(
    sign: float, rise: float, ramp: float, even: float
) -> None:
    start, limits = 0.03, {"speed": 0.8, "acceleration": 2.0}
    made = curve({"to": start + sign * rise, "by": "trapezoidal", **limits}, **{"from": start})
    assert made.duration == pytest.approx(2 * ramp + even, rel=1e-12)
    fast = 2.0 * ramp
    assert made.peaks(1)[0] == pytest.approx(fast, rel=1e-12)
    for t in (0.3 * ramp, 0.9 * ramp):
        assert made.at(t)[:3] == pytest.approx([start + sign * t * t, sign * 2 * t, sign * 2], rel=1e-12)
        end = made.at(made.duration - t)
        assert end[:2] == pytest.approx([start + sign * (rise - t * t), sign * 2 * t], rel=1e-11)
    if even:
        assert made.at(ramp + even / 2)[:3] == pytest.approx(
            [start + sign * rise / 2, sign * 0.8, 0], abs=1e-12
        )
    assert made.at(made.duration, before=True)[0] == pytest.approx(start + sign * rise, rel=1e-12)


def test_parts_of_a_trapezoid_are_those_of_its_time() -> None:
    """Ramps of 1 and 4 parts of 10 and even speed in between: v = rise / (1/2 + 5 + 4/2) * 10 / time."""
    made = curve({"to": 0.9, "in": "2 s", "by": "trapezoidal", "parts": [1, 5, 4]}, **{"from": 0.15})
    speed = 0.75 / (7.5 / 10 * 2)
    assert made.duration == pytest.approx(2.0, rel=1e-14)
    assert made.at(0.1)[:3] == pytest.approx([0.15 + speed * 0.1**2 / 0.4, speed / 2, speed / 0.2])
    assert made.at(0.7)[:3] == pytest.approx([0.15 + speed * 0.6, speed, 0.0], abs=1e-12)
    assert made.at(1.8)[:3] == pytest.approx([0.9 - speed * 0.2**2 / 1.6, speed / 4, -speed / 0.8])


def test_a_polynomial_has_the_rates_of_its_ends() -> None:
    ends = {"speed": [0.1, -0.2], "acceleration": [0.5, 0.6], "jerk": [-2.0, 3.0]}
    made = curve({"to": 0.7, "in": 1.5, "by": "polynomial", "ends": ends}, **{"from": 0.2})
    assert made.at(0.0) == pytest.approx([0.2, 0.1, 0.5, -2.0], rel=1e-12)
    assert made.at(1.5, before=True) == pytest.approx([0.7, -0.2, 0.6, 3.0], rel=1e-10)
    free = curve({"to": 0.7, "in": 1.5, "by": "polynomial", "ends": {"speed": [0.1, -0.2]}}, **{"from": 0.2})
    bend = 2 * (3 * 0.5 / 1.5 - 2 * 0.1 + 0.2) / 1.5  # a cubic: as many conditions as are given
    assert free.at(0.0) == pytest.approx([0.2, 0.1, bend, 2 * (-0.2 - 0.1 - 1.5 * bend) / 1.5**2], rel=1e-12)
    assert free.at(1.5, before=True)[:2] == pytest.approx([0.7, -0.2], rel=1e-10)


def test_a_spline_through_points_of_a_cubic_is_that_cubic() -> None:
    """With its speeds at the ends, and without them by not-a-knot, each on its own interval."""
    time, x = [0.5, 0.8, 1.4, 2.5, 2.7], np.array([0.5, 0.8, 1.4, 2.5, 2.7])
    values = (0.1 + 0.2 * x - 0.3 * x**2 + 0.4 * x**3).tolist()
    rates = [0.2 - 0.6 * t + 1.2 * t * t for t in (0.5, 2.7)]
    for ends in ({}, {"ends": {"speed": rates}}):
        made = curve({"by": "spline", "time": time, "position": values, **ends})
        assert made.duration == pytest.approx(2.2, rel=1e-14)
        for t in (0.6, 1.1, 2.6):
            wanted = [0.1 + 0.2 * t - 0.3 * t**2 + 0.4 * t**3, 0.2 - 0.6 * t + 1.2 * t**2, -0.6 + 2.4 * t]
            assert made.at(t - 0.5)[:3] == pytest.approx(wanted, rel=1e-10)
    bent = curve({"by": "spline", "time": time, "position": values, "ends": {"speed": [3.0, -4.0]}})
    assert bent.at(0.0)[1] == pytest.approx(3.0)
    assert bent.at(2.2, before=True)[1] == pytest.approx(-4.0)


def test_a_constant_speed_goes_on_from_where_the_law_is() -> None:
    made = curve({"speed": -0.3, "in": 2}, {"speed": -0.3, "in": 0.5}, **{"from": 0.7})
    assert made.at(1.5)[:3] == pytest.approx([0.25, -0.3, 0.0])
    assert made.at(2.4)[:3] == pytest.approx([-0.02, -0.3, 0.0])
    assert made.duration == 2.5


def test_instants_of_a_law_are_equal_steps_with_or_without_its_end() -> None:
    segments = ({"to": 2.0, "in": 3, "by": "parabolic"}, {"to": 0.0, "in": 1, "by": "parabolic"})
    made = programme({"segments": segments, "count": 5}, "length", RULES)
    t, s, v, a = made.motion()
    assert t.tolist() == [0, 1, 2, 3, 4]
    assert s == pytest.approx([0, 2 * 2 / 9, 2 - 2 * 2 / 9, 2, 0])
    assert v == pytest.approx([0, 8 / 9, 8 / 9, 0, 0], abs=1e-12)
    assert a == pytest.approx([8 / 9, 8 / 9, -8 / 9, -8, 8])
    assert made.motion(before=True)[3] == pytest.approx([8 / 9, 8 / 9, -8 / 9, -8 / 9, 8])
    again = programme({"segments": segments, "count": 8, "periodic": True}, "length", RULES)
    assert again.motion()[0].tolist() == [0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5]
    assert again.motion(2)[0].tolist() == [0, 2]
    assert programme({"segments": segments}, "length", RULES).count == 181


@pytest.mark.parametrize("w", [3.0, -2.0])
def test_a_law_over_a_slide_rests_beyond_its_ends(w: float) -> None:
    """s = 4 (x/2)^2 of a parabolic rise of 8 over 4; at an end, and turning outwards, it rests."""
    law = programme({"over": "S", "segments": [{"to": 8, "in": 4, "by": "parabolic"}]}, "length", OVER)
    x = np.array([-0.5, 0.0, 1.0, 3.0, 4.0, 4.5])
    s, v, a = law.following(x, np.full(6, w), np.full(6, 5.0))
    assert s == pytest.approx([0, 0, 1, 7, 8, 8])
    assert v == pytest.approx([0, 0, 2 * w, 2 * w, 0, 0], abs=1e-12)
    first, last = (2 * w * w, 0) if w > 0 else (0, -2 * w * w)
    assert a == pytest.approx([0, first, 2 * w * w + 10, -2 * w * w + 10, last, 0], abs=1e-12)
    first, last = last and 2 * w * w, first and -2 * w * w
    before = law.following(x, np.full(6, w), np.full(6, 5.0), before=True)[2]
    assert before == pytest.approx([0, first, 2 * w * w + 10, -2 * w * w + 10, last, 0], abs=1e-12)


WRONG: Any = read_file(Path(__file__).with_name("wrong_segments.yaml"))[0]


@pytest.mark.parametrize(
    ("tree", "rules", "says", "path"),
    [
        (row["change"], rules, row["says"], tuple(row["at"]))
        for key, rules in (("over_time", RULES), ("over_a_drive", OVER))
        for row in WRONG[key]
    ],
)
def test_a_programme_that_cannot_be(
    tree: dict[str, Any], rules: ReadingRules, says: str, path: tuple[Any, ...]
) -> None:
    what, where = said(tree, rules)
    assert what.startswith(says)
    assert where == path


@pytest.mark.parametrize(("value", "least"), [(True, 1), (2.0, 1), ("3", 1), (0, 1), (1, 2), (10_000_001, 1)])
def test_what_is_no_number_of_positions(value: object, least: int) -> None:
    with pytest.raises(ModelError, match=f"write an integer from {least} to 10000000"):
        count(value, least)
    assert [count(n, n) for n in (1, 2, 10_000_000)] == [1, 2, 10_000_000]


WRITTEN: list[tuple[dict[str, Any], ReadingRules]] = [
    (
        {"segments": [{"to": "2.5 m", "by": "harmonic", "in": "2.0 s"}, {"dwell": "1.0 s"}], "count": 181},
        RULES,
    ),
    (
        {
            "from": "0.5 m",
            "segments": [{"to": "1.5 m", "by": "trapezoidal", "in": "2.0 s", "parts": [1.0, 2.0, 3.0]}],
            "count": 7,
        },
        RULES,
    ),
    (
        {
            "segments": [
                {"to": "1.5 m", "by": "trapezoidal", "speed": "2.0 m/s", "acceleration": "3.0 m/s^2"}
            ],
            "count": 7,
        },
        RULES,
    ),
    (
        {
            "segments": [
                {
                    "to": "1.5 m",
                    "by": "s_curve",
                    "speed": "2.0 m/s",
                    "acceleration": "3.0 m/s^2",
                    "jerk": "4.0 m/s^3",
                }
            ],
            "count": 7,
        },
        RULES,
    ),
    ({"segments": [{"in": "1.5 s", "speed": "2.0 m/s"}], "count": 7}, RULES),
    (
        {
            "segments": [
                {
                    "by": "spline",
                    "time": ["0.0 s", "1.0 s", "2.0 s", "3.0 s"],
                    "position": ["0.0 m", "2.0 m", "3.0 m", "5.0 m"],
                    "ends": {"speed": ["1.0 m/s", "2.0 m/s"]},
                }
            ],
            "count": 7,
        },
        RULES,
    ),
    (
        {
            "segments": [
                {
                    "to": "1.5 m",
                    "by": "polynomial",
                    "in": "2.0 s",
                    "ends": {"speed": ["0.0 m/s", "2.0 m/s"], "acceleration": ["1.0 m/s^2", "3.0 m/s^2"]},
                }
            ],
            "count": 7,
        },
        RULES,
    ),
    (
        {
            "over": "O",
            "segments": [
                {"to": "1.5 m", "by": "harmonic", "in": "2.0 rad"},
                {"to": "0.0 m", "by": "harmonic", "in": "1.0 rad"},
                {"dwell": "rest"},
            ],
        },
        OVER,
    ),
    (
        {"over": "O", "segments": [{"to": "1.5 m", "by": "harmonic", "in": "2.0 rad"}], "periodic": False},
        OVER,
    ),
    ({"over": "S", "segments": [{"to": "1.5 m", "by": "harmonic", "in": "2.0 m"}]}, OVER),
    (
        {
            "segments": [
                {"to": "1.5 m", "by": "harmonic", "in": "2.0 s"},
                {"to": "0.0 m", "by": "harmonic", "in": "2.0 s"},
            ],
            "count": 7,
            "periodic": True,
        },
        RULES,
    ),
]


@pytest.mark.parametrize(("tree", "rules"), WRITTEN)
def test_a_programme_is_written_as_it_was_read(tree: dict[str, Any], rules: ReadingRules) -> None:
    made = programme(tree, "length", rules)
    assert made.tree("length") == tree
    assert programme(made.tree("length"), "length", rules) == made


def test_rates_of_a_turn_are_written_as_angular_ones() -> None:
    ends = (("speed", (0.0, 2.0)), ("acceleration", (1.0, 3.0)), ("jerk", (4.0, 5.0)))
    made = Programme((Segment("polynomial", "polynomial", 2.0, 1.5, ends=ends),))
    assert made.tree("angle")["segments"] == [
        {
            "to": "1.5 rad",
            "by": "polynomial",
            "in": "2.0 s",
            "ends": {
                "speed": ["0.0 rad/s", "2.0 rad/s"],
                "acceleration": ["1.0 rad/s^2", "3.0 rad/s^2"],
                "jerk": ["4.0 rad/s^3", "5.0 rad/s^3"],
            },
        }
    ]


def test_a_table_over_time_is_a_spline_by_its_points() -> None:
    t = np.array([0.5, 1.0, 2.0, 3.0, 4.5])
    cubic = 1 - 2 * t + 3 * t**2 - 0.5 * t**3
    table = TimeTable(tuple(t.tolist()), tuple(cubic.tolist()), 9)
    at, s, v, a = table.motion()
    assert at == pytest.approx(np.linspace(0.5, 4.5, 9))
    assert s == pytest.approx(1 - 2 * at + 3 * at**2 - 0.5 * at**3)
    assert v == pytest.approx(-2 + 6 * at - 1.5 * at**2)
    assert a == pytest.approx(6 - 3 * at)
    assert table.motion(3)[0] == pytest.approx([0.5, 2.5, 4.5])


def test_a_periodic_table_repeats_its_first_position_exactly() -> None:
    """Its last one may differ by rounding; the last instant is left out."""
    t = np.arange(0, 13) * math.pi / 6
    position = np.cos(t)
    position[-1] += 1e-12
    table = TimeTable(tuple(t.tolist()), tuple(position.tolist()), 12, periodic=True)
    at, s, v, a = table.motion()
    assert at == pytest.approx(t[:-1])
    assert table.at(2 * math.pi)[0] == table.at(0.0)[0] == 1.0
    assert s == pytest.approx(np.cos(at), abs=1e-9)
    assert v == pytest.approx(-np.sin(at), abs=2e-3)
    assert a == pytest.approx(-np.cos(at), abs=3e-2)


TABLE = {"type": "table", "time": [0, 1, 2, 4], "position": [0, 2, 3, 1], "count": 5}
TIMES = ["0.0 s", "1.0 s", "2.0 s", "4.0 s"]


def test_laws_are_written_as_they_were_read() -> None:
    plain = {"type": "table", "time": TIMES, "position": ["0.0 m", "2.0 m", "3.0 m", "1.0 m"], "count": 5}
    assert read_law(TABLE, "length", RULES).tree("length") == plain
    closed = read_law(TABLE | {"position": [0, 2, 3, 0], "periodic": True}, "length", RULES)
    assert closed.tree("length") == plain | {
        "position": ["0.0 m", "2.0 m", "3.0 m", "0.0 m"],
        "periodic": True,
    }
    rise = {"type": "cycloidal", "from": "0.5 m", "to": "-1.5 m", "duration": "2.0 s", "count": 2}
    assert read_law(rise, "length", RULES).tree("length") == rise


@pytest.mark.parametrize(
    ("changes", "says", "path"),
    [
        ({"position": [0, 2, 3]}, "it has 4 times and 3 positions; give one position for each time", ()),
        (
            {"time": [0, 1, 2], "position": [0, 2, 3]},
            "it has too few points: 3; give at least 4, or a harmonic law",
            (),
        ),
        ({"time": [0, 2, 2, 3]}, "its times do not increase; sort the points", ("time",)),
        ({"time": [0, 3, 2, 1]}, "its times do not increase; sort the points", ("time",)),
        ({"periodic": "yes"}, "'yes' is neither true nor false; write periodic: true", ("periodic",)),
        (
            {"periodic": True},
            "it does not end where it begins; repeat the first position at the end",
            ("periodic",),
        ),
        (
            {"periodic": True, "position": [1, 2, 3, 0]},
            "it does not end where it begins; repeat the first position at the end",
            ("periodic",),
        ),
        ({"type": "tabel"}, "unknown law 'tabel'; did you mean 'table'?", ("type",)),
        (
            {"type": None},
            "the key 'type' is missing; choose among harmonic, cycloidal, polynomial345, table",
            (),
        ),
        ({"count": 0}, "0 is not a number of positions; write an integer from 1 to 10000000", ("count",)),
        (
            {"interpolate": "linear"},
            "a law of motion is not interpolated 'linear': its accelerations would be infinite; "
            "write interpolate: cubic, or leave it out",
            ("interpolate",),
        ),
    ],
)
def test_a_table_over_time_that_cannot_be(changes: dict[str, Any], says: str, path: tuple[str, ...]) -> None:
    with pytest.raises(ModelError) as caught:
        read_law(TABLE | changes, "length", RULES)
    assert (f"{caught.value.what}; {caught.value.remedy}", caught.value.path) == (says, path)


@pytest.mark.parametrize(
    ("form", "part", "slope", "bend"),
    [
        (
            "harmonic",
            (1 - math.cos(0.3 * math.pi)) / 2,
            math.pi / 2 * math.sin(0.3 * math.pi),
            math.pi**2 / 2 * math.cos(0.3 * math.pi),
        ),
        (
            "cycloidal",
            0.3 - math.sin(0.6 * math.pi) / (2 * math.pi),
            1 - math.cos(0.6 * math.pi),
            2 * math.pi * math.sin(0.6 * math.pi),
        ),
        (
            "polynomial345",
            10 * 0.027 - 15 * 0.0081 + 6 * 0.00243,
            30 * 0.09 - 60 * 0.027 + 30 * 0.0081,
            60 * 0.3 - 180 * 0.09 + 120 * 0.027,
        ),
    ],
)
def test_a_rise_at_three_tenths_of_its_time(form: str, part: float, slope: float, bend: float) -> None:
    rise = Rise(form, 0.5, -1.5, 4.0, 11)
    t, s, v, a = (x[3] for x in rise.motion())
    assert (t, s, v, a) == pytest.approx((1.2, 0.5 - 2 * part, -0.5 * slope, -0.125 * bend), rel=1e-12)
