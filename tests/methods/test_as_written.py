"""Given data as the file has them: sizes and angles, units, letters; nothing where a reader would not understand it."""

from __future__ import annotations

import dalembert as da
from dalembert.reports.sections.as_written import AsWritten

TEXT = """
units: {length: mm, force: kN}
parameters: {p: 3 MPa, A: 20 mm^2, q: 1.5}
links:
  ground: {points: {O: [0, 0], C: 300 @ 0}}
  a:
    points: {O: [0, 0], B: 120 mm @ -30, D: {from: B, at: 50 @ 0.5 rad}, E: {from: center, at: 20 @ 90 deg}}
    mass: 2
    center: 60 @ -30
    inertia: 3 kg*m^2
  b: {points: {O: [0, 0], C: [0, 0]}, mass: 500 g, center: [1, 2]}
joints:
  O: {type: pin, links: [ground, a]}
  C: {type: pin, links: [ground, b]}
drives:
  O: {position: -30, speed: 2*q rad/s}
  C: {position: {from: 0, to: 90, count: 3}, speed: 300 rpm}
loads:
  polar: {type: force, on: a, at: B, value: 5 @ -90}
  sized: {type: force, on: a, at: B, value: p*A, direction: 40}
  parts: {type: force, on: a, at: B, value: [p*A, -2 kN], axes: link}
  plain: {type: force, on: a, at: B, value: [1, 2]}
  turn: {type: couple, on: a, value: -2 N*m}
  power: {type: couple, on: a, value: 2 N*m*q**2}
"""
KINDS = {"position": "angle", "speed": "angular_speed", "acceleration": "angular_acceleration"}


def test_links_drives_and_loads_as_they_are_written() -> None:
    m = da.loads(TEXT)
    w = AsWritten(m)
    assert [w.point("a", name) for name in "OBDE"] == [
        *("", "120 mm ∠ −30°", "50 ∠ 0.5 rad from B", "20 ∠ 90° from centre"),
    ]
    assert (w.point("ground", "C"), w.point("b", "Z"), w.point("z", "Z")) == ("300 ∠ 0°", "", "")
    assert [w.center(link) for link in "ab"] == ["60 ∠ −30°", ""]
    assert [w.of_link(link, "mass", "mass") for link in "ab"] == ["2 kg", "500 g"]
    assert [w.of_link(link, "inertia", "inertia") for link in "ab"] == ["3 kg·m²", ""]
    assert w.drive("O", KINDS) == "−30°, 2·q rad/s"
    assert (w.drive("C", KINDS), w.drive("Z", KINDS)) == ("", "")
    assert [w.load(name) for name in m.loads] == [
        *("5 kN ∠ −90°", "p·A ∠ 40°", "(p·A, −2 kN) in link axes", "", "−2 N·m", "2 N·m·q²"),
    ]
    assert w.by_letters() == ["sized", "parts", "power"]


def test_values_put_in_later_take_their_place() -> None:
    m = da.loads(TEXT).with_values({"loads.turn.value": "7 N*m", "links.a.mass": "4 kg"})
    w = AsWritten(m)
    assert (w.load("turn"), w.load("polar")) == ("7 N·m", "5 kN ∠ −90°")
    assert w.of_link("a", "mass", "mass") == "4 kg"
    assert AsWritten(da.four_bar()).load("load") == ""
