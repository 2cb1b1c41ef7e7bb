"""Given data in the words of the file: sizes and angles, units, letters of parameters, and what a reader could not
understand alone."""

from __future__ import annotations

from typing import Any

import pytest

import dalembert as da
from dalembert.reports.sections.as_written import (
    AsWritten,
    _angle,
    _expression,
    _is_expression,
    _parts,
    _polar,
    _with_unit,
)

TEXT = """units: {length: mm, force: N, angle: deg, mass: kg, moment: N*m}
parameters: {p: 2 MPa, A: 30 mm^2}
links:
  ground: {points: {O: [0, 0], Q: [4, 0]}}
  rod:
    points: {O: [0, 0], B: 30 @ -20, C: {from: center, at: 3 mm @ 30}, D: {from: B, at: 2 @ 0.5 rad}}
    mass: 2
    center: 15 @ 10
    inertia: 0.01 kg*m^2
  arm: {points: {O: [0, 0], E: [1, 2]}}
joints: {O: {type: pin, links: [ground, rod]}, Q: {type: pin, links: [ground, arm], at: [Q, O]}}
drives:
  O: {position: 30, speed: 300 rpm, acceleration: -2 rad/s^2}
  Q: {law: {type: harmonic, from: 0, to: 1, duration: 1, count: 3}}
loads:
  P: {type: force, on: rod, at: B, value: -p*A @ 30}
  Q: {type: force, on: rod, at: B, value: 5 @ 30, axes: link}
  R: {type: force, on: rod, at: B, value: p*A, direction: 0.5 rad}
  S: {type: force, on: rod, at: B, value: [p*A, 3 kN]}
  T: {type: couple, on: rod, value: 7}
  U: {type: force, on: rod, at: B, value: [1, 2]}
  V: {type: spring, between: [ground.Q, rod.B], stiffness: 5, free_length: 3}
"""


@pytest.mark.parametrize(
    ("raw", "plain", "written"),
    [
        (5, "N", "5 N"), (-2.5, "N", "−2.5 N"), ("3 kN", "N", "3 kN"), (" 4 ", "", "4"), ("30 deg", "N", "30°"),
        ("7", "deg", "7°"), ("2 N*m", "", "2 N·m"), (True, "N", ""), (None, "N", ""), ([1], "N", ""),
        ("p*A", "N", "p·A"),
        ("3 apples", "N", "3 apples"), ("2+3", "N", ""), ("2e-3", "m", "2e−3 m"),
    ],
)  # fmt: skip
def test_a_number_has_its_unit_or_that_of_the_file(raw: Any, plain: str, written: str) -> None:
    assert _with_unit(raw, plain) == written


def test_expressions_have_signs_of_multiplication() -> None:
    for text, written in (
        ("p*A", "p·A"), ("a ** 2 - b", "a² − b"), ("a^3*b", "a³·b"), ("a^23", "a^23"), ("a^30", "a^30"),
        ("pi * d^2/4", "π·d²/4"),
        ("pin", "pin"),
    ):  # fmt: skip
        assert _expression(text) == written
    assert [_is_expression(x) for x in ("p", "3 mm", "3", "3 apples", "-p*A", 5)] == [
        True,
        False,
        False,
        True,
        True,
        False,
    ]
    assert (_parts([1, "p"]), _parts("3 @ p"), _parts(7)) == ([1, "p"], ["3 ", " p"], ["7"])
    assert [_angle(x) for x in (30, "0.5 rad", "a", "12 deg", "3 mm")] == ["30°", "0.5 rad", "", "12°", ""]
    for raw, written in (
        ("3 @ 30", "3 ∠ 30°"),
        ("3 mm @ 1 rad", "3 mm ∠ 1 rad"),
        ("3 @ a", ""),
        ("3 @ 1 @ 2", ""),
        ([1, 2], ""),
    ):
        assert _polar(raw) == written
    assert _polar("3 @ 30", "N") == "3 N ∠ 30°"


def test_links_drives_and_loads_are_told_as_the_file_states_them() -> None:
    w = AsWritten(da.loads(TEXT))
    assert [w.point("rod", n) for n in "OBCD"] == [
        "",
        "30 ∠ −20°",
        "3 mm ∠ 30° from centre",
        "2 ∠ 0.5 rad from B",
    ]
    assert (w.center("rod"), w.center("arm")) == ("15 ∠ 10°", "")
    assert w.of_link("rod", "mass", "mass") == "2 kg"
    assert w.of_link("rod", "inertia", "inertia") == "0.01 kg·m²"
    assert w.of_link("arm", "mass", "mass") == ""
    kinds = {"position": "angle", "speed": "angular_speed", "acceleration": "angular_acceleration"}
    assert w.drive("O", kinds) == "30°, 300 rpm, −2 rad/s²"
    assert (w.drive("Q", kinds), w.drive("X", kinds)) == ("", "")
    assert w.by_letters() == ["P", "R", "S"]
    assert {n: w.load(n) for n in "PQRSTUVX"} == {
        "P": "−p·A ∠ 30°", "Q": "5 N ∠ 30° in link axes", "R": "p·A ∠ 0.5 rad", "S": "(p·A, 3 kN)", "T": "7 N·m",
        "U": "", "V": "", "X": "",
    }  # fmt: skip


def test_values_that_were_changed_stand_in_for_those_of_the_file() -> None:
    m = da.loads(TEXT).with_values(
        {
            "links.rod.mass": "3 kg",
            "links.arm.points.E.1": 9,
            "loads.T.value": "8 N*m",
            "loads.U.value": "4 @ 20",
        }
    )
    w = AsWritten(m)
    assert w.of_link("rod", "mass", "mass") == "3 kg"
    assert w._at(["links", "arm", "points", "E"]) == [1, 9]
    assert (w._at(["links", "arm", "points", "E", "1"]), w._at(["links", "arm", "points", "E", "2"])) == (
        9,
        None,
    )
    assert w._at(["links", "arm", "points", "E", "x"]) is None
    assert (w.load("T"), w.load("U")) == ("8 N·m", "4 N ∠ 20°")
    assert AsWritten(da.loads(TEXT)).of_link("rod", "mass", "mass") == "2 kg", (
        "the file itself is not changed"
    )
    bare = AsWritten(da.four_bar())
    assert (bare.load("x"), bare.by_letters(), bare.point("crank", "A")) == ("", [], "")
