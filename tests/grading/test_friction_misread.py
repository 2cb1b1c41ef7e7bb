"""Mistakes of friction as changes of its coefficients and radii, slips of a value listed, and rates of drives."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.grading.quantities import Series
from dalembert.grading.value_errors import of_value
from dalembert.grading.wrong.wrong_data import _friction_changes, _gravity_changes, _rate_changes
from tests.grading.test_wrong_machines import slider_crank

NAMES = ("O", "A", "guide")
MU, RESTING, LEVER = [0.1, 0.2, 0.15], [0.1, 0.3, 0.15], [0.02, 0.03, 1.0]


@pytest.fixture(scope="module")
def rough() -> da.Result:
    """A crank, a rod and a piston with friction in two pins and the guide."""
    tree = slider_crank(1.0, 0.0).to_tree()
    tree["joints"]["O"]["friction"] = {"coefficient": 0.1, "radius": 0.02}
    tree["joints"]["A"]["friction"] = {"coefficient": 0.2, "radius": 0.03, "static": 0.3}
    tree["joints"]["guide"]["friction"] = {"coefficient": 0.15}
    return da.dynamics(da.mechanism(tree))


def scaled(values: list[float], some: Any, factor: float) -> list[float]:
    return [x * factor if name in some else x for name, x in zip(NAMES, values, strict=True)]


def expected() -> dict[str, Any]:
    """Coefficients, those at rest, radii and whether a circle is R sin(phi), by the sentence."""
    circle, pins = [True, True, False], ("O", "A")

    def times(some: Any, mu: float = 1.0, radius: float = 1.0) -> Any:
        return scaled(MU, some, mu), scaled(RESTING, some, mu), scaled(LEVER, some, radius), circle

    out: dict[str, Any] = {
        "friction is left out": times(NAMES, 0.0),
        "the radius of the friction circles is taken as mu R, not R sin(phi)": (
            MU,
            RESTING,
            LEVER,
            [False] * 3,
        ),
        "the coefficient at rest is mistaken for that of motion": (RESTING, RESTING, LEVER, circle),
        "the radii of O and A are exchanged": (MU, RESTING, [0.03, 0.02, 1.0], circle),
        "all friction acts in the wrong sense, with the motion": times(NAMES, -1.0),
        "the diameter of the pins is mistaken for the radius": times(pins, radius=2.0),
        "the radius of the pins is mistaken for the diameter": times(pins, radius=0.5),
    }
    for i, j in ((0, 1), (0, 2), (1, 2)):
        for here, other in ((i, j), (j, i)):
            words = f"the coefficient of friction of {NAMES[here]} is taken as that of {NAMES[other]}"
            out[words] = ([MU[other] if k == here else x for k, x in enumerate(MU)], RESTING, LEVER, circle)
        words = f"the friction of joints {NAMES[i]} and {NAMES[j]} acts in the wrong sense"
        out[words] = times((NAMES[i], NAMES[j]), -1.0)
    for name in NAMES:
        out[f"the friction of joint {name} is left out"] = times((name,), 0.0)
        out[f"the friction of joint {name} acts in the wrong sense, with the motion"] = times((name,), -1.0)
    for name in pins:
        out[f"the diameter of joint {name} is mistaken for the radius"] = times((name,), radius=2.0)
        out[f"the radius of joint {name} is mistaken for the diameter"] = times((name,), radius=0.5)
    return out


def test_every_mistake_of_friction_changes_what_it_says(rough: da.Result) -> None:
    known = rough.compiled.contacts
    assert known is not None
    assert (known.coefficient.tolist(), known.resting.tolist(), known.lever.tolist()) == (MU, RESTING, LEVER)
    found: dict[str, Any] = {}
    for sentence, change in _friction_changes(rough):
        assert callable(change)
        c = change(rough.compiled).contacts
        assert c is not None
        assert sentence not in found
        found[sentence] = tuple(
            np.asarray(getattr(c, k)).tolist() for k in ("coefficient", "resting", "lever", "circle")
        )
    hand = expected()
    assert found.keys() == hand.keys()
    for sentence, values in hand.items():
        for one, other in zip(found[sentence], values, strict=True):
            assert one == pytest.approx(other), sentence


def test_without_friction_there_is_none_to_misread() -> None:
    assert list(_friction_changes(da.dynamics(slider_crank(1.0, 0.0)))) == []
    tree = slider_crank(1.0, 0.0).to_tree()
    tree["joints"]["O"]["friction"] = {"coefficient": 0.0, "radius": 0.02}
    assert list(_friction_changes(da.dynamics(da.mechanism(tree)))) == []


@pytest.mark.parametrize(
    ("speed", "acceleration", "said"),
    [(3.0, 5.0, 6), (3.0, 0.0, 4), (0.0, 5.0, 2), (0.0, 0.0, 0)],
)
def test_the_rates_of_one_drive_are_misread_and_no_others(
    speed: float, acceleration: float, said: int
) -> None:
    m = da.four_bar(positions=1).with_values(
        {"drives.O2": {"position": 1.0, "speed": speed, "acceleration": acceleration}}
    )
    r = da.dynamics(m)
    found = list(_rate_changes(r, 0, "O2"))
    assert len(found) == said
    factors = {
        "rad/s mistaken for rpm": 30 / math.pi,
        "rpm mistaken for rad/s": math.pi / 30,
        "revolutions per second mistaken for rad/s": 1 / (2 * math.pi),
        "speed of drive O2 is left out": 0.0,
        "acceleration of drive O2 is left out": 0.0,
        "acceleration of drive O2 has the wrong sense": -1.0,
    }
    for sentence, change in found:
        assert callable(change)
        (factor,) = (f for words, f in factors.items() if words in sentence)
        s = change(r.compiled).schedule
        rates = (
            (speed, acceleration * factor) if "acceleration" in sentence else (speed * factor, acceleration)
        )
        assert (float(s.speed[0, 0]), float(s.acceleration[0, 0])) == pytest.approx(rates)


@pytest.mark.parametrize(
    ("units", "g", "said"),
    [
        (
            "m",
            None,
            ["9.81 m/s^2, not 9.80665 m/s^2", "9.8 m/s^2, not 9.80665 m/s^2", "10 m/s^2, not 9.80665 m/s^2"],
        ),
        ("m", "9.81 m/s^2", ["9.8 m/s^2, not 9.81 m/s^2", "10 m/s^2, not 9.81 m/s^2"]),
        ("m", "9.4 m/s^2", ["9.81 m/s^2, not 9.4 m/s^2", "9.8 m/s^2, not 9.4 m/s^2"]),
        ("in", "32.2 ft/s^2", ["32 ft/s^2, not 32.2 ft/s^2", "386 in/s^2, not 386.4 in/s^2"]),
    ],
)
def test_the_g_of_books_is_offered_where_it_is_another_and_near(
    units: str, g: str | None, said: list[str]
) -> None:
    """Within a twentieth, and not where it is the file's own."""
    pull = {"gravity": "standard"} if g is None else {"gravity": [0, f"-{g}"]}
    m = da.four_bar(positions=1).with_values({"units": {"length": units, "mass": "kg", "force": "N"}, **pull})
    found = list(_gravity_changes(da.dynamics(m)))
    assert [s.removeprefix("g is taken as ") for s, _ in found] == said
    for sentence, change in found:
        number, unit = sentence.removeprefix("g is taken as ").partition(",")[0].split()
        size = float(number) * {"m/s^2": 1.0, "ft/s^2": 0.3048, "in/s^2": 0.0254}[unit]
        assert isinstance(change, dict)
        assert change == {"gravity": pytest.approx([0.0, -size])}


OPPOSITE = "the sense is opposite"
REACTION = f"{OPPOSITE}: action mistaken for reaction"


def listed(kind: str, right: Any) -> list[tuple[str, Any, str]]:
    value = np.array(right, float)
    return [(h.sentence, h.value.tolist(), h.kind) for h in of_value(Series(kind, value[None]), value)]


@pytest.mark.parametrize(("kind", "said"), [("force", REACTION), ("moment", REACTION), ("speed", OPPOSITE)])
def test_of_a_number_the_sense_may_be_wrong(kind: str, said: str) -> None:
    assert listed(kind, 3.0) == [(said, -3.0, "sign")]


def test_of_a_vector_of_the_plane_the_sense_and_the_axes_may_be_wrong() -> None:
    other, clockwise = "the angle is counted from the other axis", "the angle is counted clockwise"
    one = "x and y are exchanged, one with the wrong sign"
    *most, (words, value, kind) = listed("force", [3.0, 4.0])
    assert most == [
        (REACTION, [-3, -4], "sign"),
        (f"{other}: x and y are exchanged", [4, 3], "named"),
        (f"{clockwise}: y has the wrong sign", [3, -4], "sign"),
        ("x has the wrong sign", [-3, 4], "sign"),
        (one, [-4, 3], "named"),
        (one, [4, -3], "named"),
    ]
    turned = math.degrees(math.atan2(4, 3))
    assert (words, kind) == ("degrees are mistaken for radians in sine and cosine", "named")
    assert value == pytest.approx([5 * math.cos(turned), 5 * math.sin(turned)])


def test_of_a_vector_in_space_the_axes_may_be_exchanged_or_counted_on() -> None:
    on = "the axes are counted one on: x, y, z for"
    assert listed("velocity", [1.0, 2.0, 3.0]) == [
        (OPPOSITE, [-1, -2, -3], "sign"),
        ("x has the wrong sign", [-1, 2, 3], "sign"),
        ("y has the wrong sign", [1, -2, 3], "sign"),
        ("z has the wrong sign", [1, 2, -3], "sign"),
        ("x and y are exchanged", [2, 1, 3], "named"),
        ("y and z are exchanged", [1, 3, 2], "named"),
        ("x and z are exchanged", [3, 2, 1], "named"),
        (f"{on} z, x, y", [3, 1, 2], "named"),
        (f"{on} y, z, x", [2, 3, 1], "named"),
    ]
    assert listed("length", [1.0, 2.0, 3.0, 4.0]) == [(OPPOSITE, [-1, -2, -3, -4], "sign")]


def test_an_angle_may_be_counted_from_elsewhere_or_be_in_the_other_unit() -> None:
    found = listed("angle", 0.5)
    assert [(words, kind) for words, _, kind in found] == [
        (words, "named")
        for words in (
            REACTION,
            "the angle is counted from the other axis",
            "the angle is counted clockwise",
            "the angle is counted from the negative x axis",
            "the number is in radians, not degrees",
            "the number is in degrees, not radians",
        )
    ]
    values = [0.5 + math.pi, math.pi / 2 - 0.5, -0.5, math.pi - 0.5, 0.5 * math.pi / 180, 0.5 * 180 / math.pi]
    assert [value for _, value, _ in found] == pytest.approx(values)
