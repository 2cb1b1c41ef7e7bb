"""Single values of a copy that is turned or mirrored: angles, vectors, motors, tables and texts, by hand."""

from __future__ import annotations

import math
from typing import Any

import pytest

from dalembert.errors import ModelError
from dalembert.model.files.copies.images import Image
from dalembert.model.part import ReadingRules

RULES = ReadingRules(freedoms={"O": "turn"})
TURNED = Image("_2", {"base": 0.5, "arm": -0.25}, False, 0.75, "", RULES)
MIRRORED = Image("_2", {"base": 0.5, "arm": -0.25}, True, 0.75, "", RULES)
QUARTER = math.pi / 2


def number(text: object) -> float:
    return float(str(text).split()[0])


def test_an_image_has_the_angle_of_its_link_or_twice_that_of_its_line() -> None:
    links = ("base", "arm", "rod")
    assert [TURNED.offset(n) for n in links] == [0.5, -0.25, 0.0]
    assert [MIRRORED.offset(n) for n in links] == [1.0, -0.5, 0.0]
    assert (TURNED.side, MIRRORED.side) == (1, -1)


def test_an_angle_of_an_image() -> None:
    assert TURNED.angle("30 deg") == "30 deg"
    assert number(TURNED.angle("30 deg", 0.25)) == pytest.approx(math.pi / 6 + 0.25)
    assert number(TURNED.angle(-0.125, 0.25)) == 0.125
    assert number(MIRRORED.angle("30 deg")) == pytest.approx(-math.pi / 6)
    assert MIRRORED.angle(0.125, 1.0) == "0.875 rad"
    assert MIRRORED.angle("3 m", 1.0) == "3 m"


def test_a_quantity_with_a_number_added() -> None:
    assert TURNED.plus("20 mm", 0.5, "length") == "0.52 m"
    assert TURNED.plus(2, -0.5, "angle") == "1.5 rad"


def test_two_angles_stay_in_order() -> None:
    keys = {"from": 0.125, "to": 0.5, "restitution": 0.3}
    assert TURNED.interval(keys, 0.25) == {"from": "0.375 rad", "to": "0.75 rad", "restitution": 0.3}
    assert MIRRORED.interval(keys, 1.0) == {"to": "0.875 rad", "from": "0.5 rad", "restitution": 0.3}
    assert MIRRORED.interval({"from": 0.125}, 1.0) == {"to": "0.875 rad"}
    assert TURNED.interval([0.125, 0.5], 0.25) == ["0.375 rad", "0.75 rad"]
    assert MIRRORED.interval([0.125, 0.5], 1.0) == ["0.5 rad", "0.875 rad"]
    assert MIRRORED.interval("both", 1.0) == "both"


def test_a_motor_of_an_image() -> None:
    curve = {"speed": [0, 2, 5], "torque": [7, 6, 0]}
    keys = {"stall": 3, "no_load": "10 rad/s", "on": "0.25 rad", "off": "5 rad/s", "ratio": 4}
    assert TURNED.motor(keys | {"curve": curve}, 0.5) == keys | {"on": "0.75 rad", "curve": curve}
    back = {"stall": -3, "no_load": "-10 rad/s", "on": "0.25 rad", "off": "-5 rad/s", "ratio": 4}
    assert MIRRORED.motor(keys, 0.5) == back
    assert MIRRORED.motor({"curve": curve}, 0.5) == {"curve": {"speed": [-5, -2, 0], "torque": [0, -6, -7]}}
    assert MIRRORED.motor({"on": "2 s", "off": "nonsense"}, 0.5) == {"on": "2 s", "off": "nonsense"}
    assert MIRRORED.motor("nonsense", 0.5) == "nonsense"


@pytest.mark.parametrize(
    ("mirrored", "offset", "wanted"),
    [
        (False, 0.0, [3, 5]),
        (False, math.pi, [-3, -5]),
        (False, QUARTER, [-5, 3]),
        (False, -QUARTER, [5, -3]),
        (True, 0.0, [3, -5]),
        (True, math.pi, [-3, 5]),
        (True, QUARTER, [5, 3]),
        (True, -QUARTER, [-5, -3]),
    ],
)
def test_a_vector_turned_by_quarters_keeps_its_digits(
    mirrored: bool, offset: float, wanted: list[int]
) -> None:
    image = MIRRORED if mirrored else TURNED
    assert image.components([3, 5], offset) == wanted


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("value", [["30 mm", "50 mm"], [0.03, "5 cm"], "r"])
def test_a_vector_turned_by_an_angle(side: int, value: Any) -> None:
    image = TURNED if side > 0 else MIRRORED
    angle, size = math.atan2(0.05, 0.03), math.hypot(0.03, 0.05)
    if value == "r":
        text = str(image.components(f"{size!r} m @ {angle!r} rad", 0.25))
        r, at = text.split(" @ ")
        assert (number(r), number(at)) == pytest.approx((size, side * angle + 0.25))
        assert (r.split()[1], at.split()[1]) == ("m", "rad")
    else:
        x, y = image.components(value, 0.25)  # type: ignore[misc]
        wanted = size * math.cos(side * angle + 0.25), size * math.sin(side * angle + 0.25)
        assert (number(x), number(y)) == pytest.approx(wanted)
        assert (x.split()[1], y.split()[1]) == ("m", "m")


def test_what_is_no_vector_of_the_plane_stays() -> None:
    for value in ([1, 2, 3], ["3 N", "4 m"], "A"):
        assert TURNED.components(value, 0.25) == value


def test_a_force_of_expressions_turned_by_an_angle() -> None:
    """The image of f(O), g(O) is c f - s g, s f + c g, in the units of each."""
    cos, sin = math.cos(0.25), math.sin(0.25)
    x, y = TURNED.components(
        [{"expression": "2*O", "unit": "kN"}, {"expression": "O^2", "unit": "N"}], 0.25, "force"
    )  # type: ignore[misc]
    assert x == {"expression": f"{cos * 1000!r}*(2*O) + {-sin!r}*(O^2)", "unit": "N"}
    assert y == {"expression": f"{sin * 1000!r}*(2*O) + {cos!r}*(O^2)", "unit": "N"}
    x, y = TURNED.components([{"expression": "2*O", "unit": "kN"}, 3], 0.25, "force")  # type: ignore[misc]
    assert x == {"expression": f"{cos * 1000!r}*(2*O) + {-sin * 3!r}", "unit": "N"}
    table = {"against": "O", "x": [0, 1], "y": [2, 3]}
    with pytest.raises(ModelError, match=r"^a component of a rotated vector is a table; write each"):
        TURNED.components([table, 3], 0.25, "force")


@pytest.mark.parametrize(
    ("value", "wanted"),
    [
        (5, -5),
        (-2.5, 2.5),
        ("5 m", "-5 m"),
        ("-5 m", "5 m"),
        ("+5", "-5"),
        (" 3.5 deg ", "-3.5 deg"),
        ("5°", "-5°"),
        ("2*O", "-(2*O)"),
        ("2*O + 3", "-(2*O + 3)"),
        (True, True),
        ("unknown", "unknown"),
        (None, None),
        ([1, "2 m", [3]], [-1, "-2 m", [-3]]),
        ({"expression": "O", "unit": "N"}, {"expression": "-(O)", "unit": "N"}),
        ({"x": [1], "y": [2]}, {"x": [1], "y": [2], "times": -1}),
        ({"x": [1], "y": [2], "times": "3 m"}, {"x": [1], "y": [2], "times": "-3 m"}),
    ],
)
def test_the_negative_of_a_value(value: Any, wanted: Any) -> None:
    assert TURNED.negative(value) == wanted
    assert MIRRORED.opposite(value) == wanted
    assert TURNED.opposite(value) == value


def test_a_table_against_the_opposite() -> None:
    table = {"x": [1, "2 deg", -3], "y": [4, 5, 6], "times": 2}
    assert TURNED.reversed_table(table) == {"x": [3, "-2 deg", -1], "y": [6, 5, 4], "times": 2}
    for broken in ({"file": "a.csv"}, {"x": [1, 2]}, {"y": [1, 2]}):
        with pytest.raises(ModelError, match=r"^the columns of a file are not mirrored; write that load's"):
            TURNED.reversed_table(broken)


LIFT = [{"to": "0.5 rad", "in": 1, "by": "harmonic"}, {"to": "2 mm", "in": 1}, {"dwell": "rest"}, {"to": 0.5}]


def test_a_cam_of_an_image() -> None:
    cam = {"profile": {"base": 3, "segments": LIFT, "start": 0.25}, "face": "0.125 rad"}
    assert TURNED.cam(cam, 0.5) == {"profile": {"base": 3, "segments": LIFT, "start": "0.75 rad"}}
    back = [LIFT[0] | {"to": "-0.5 rad"}, *LIFT[1:]]
    mirrored = {"base": 3, "segments": back, "start": "0.25 rad", "sense": "cw"}
    assert MIRRORED.cam(cam, 0.5) == {"profile": mirrored, "face": "-0.125 rad"}
    cam["profile"]["sense"] = "cw"  # type: ignore[index]
    assert MIRRORED.cam(cam, 0.5)["profile"]["sense"] == "ccw"  # type: ignore[index]
    disc = {"profile": {"eccentric": 3, "radius": 5}}
    assert TURNED.cam(disc, 0.5) == disc
    assert TURNED.cam({"profile": {"base": 3, "segments": LIFT}}, 0.0) == {
        "profile": {"base": 3, "segments": LIFT}
    }
    for form in ("arcs", "points"):
        assert TURNED.cam({"profile": {form: [1, 2]}}, 0.5) == {"profile": {form: [1, 2]}}
        with pytest.raises(ModelError, match=r"^the arcs or points of a cam are not mirrored") as caught:
            MIRRORED.cam({"profile": {form: [1, 2]}}, 0.5)
        assert caught.value.path == ("mirror",)
