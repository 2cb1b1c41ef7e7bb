"""How values of a file are understood: vectors, polar text, names, units, Python against file."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from dalembert.errors import ModelError
from dalembert.model import (
    Couple,
    Drive,
    Expression,
    ForceLoad,
    Link,
    Mechanism,
    ModelErrors,
    Pin,
    Slider,
    loads,
    mechanism,
)
from dalembert.model.files.model_files import read_text
from tests.model.parts import FOUR_BAR

IN, LBF = 0.0254, 4.4482216152605


def test_the_contracts_file() -> None:
    m = loads(FOUR_BAR)
    g = 9.80665
    assert m.title == "Four-bar linkage, dynamic"
    assert m.source_text == "Norton, Design of Machinery, example 11-3"
    assert m.space == "plane"
    assert m.gravity_vector == (0.0, 0.0)
    assert m.g == g
    assert m.mass("crank") == pytest.approx(1.5 * LBF / g)
    assert m.mass("ground") == 0.0
    assert m.center("crank") == pytest.approx((3 * IN * math.cos(math.pi / 6), 1.5 * IN))
    assert m.inertia("coupler") == pytest.approx(1.5 * LBF * IN)
    angle = math.radians(100)
    center = m.center("coupler")
    expected = (center[0] + 3 * IN * math.cos(angle), center[1] + 3 * IN * math.sin(angle))
    assert m.points("coupler")["P"] == pytest.approx(expected)
    assert m.joint_points("A") == ((0.127, 0.0), (0.0, 0.0))
    force = m.loads["F_P"]
    assert isinstance(force, ForceLoad)
    assert force.force({}) == pytest.approx((80 * LBF * math.cos(math.radians(330)), -40 * LBF))
    couple = m.loads["T_4"]
    assert isinstance(couple, Couple)
    assert couple.moment({}) == pytest.approx(120 * LBF * IN)
    assert m.assembly == pytest.approx({"coupler": math.radians(20), "rocker": math.radians(104)})


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("3 @ 30", (3 * IN * math.cos(math.pi / 6), 1.5 * IN)),
        ("3 @ 30 deg", (3 * IN * math.cos(math.pi / 6), 1.5 * IN)),
        ("3 in @ 0.5 rad", (3 * IN * math.cos(0.5), 3 * IN * math.sin(0.5))),
        ("3 @ 30 mm", (0.003 * math.cos(math.pi / 6), 0.0015)),
        ("3 mm @ 90", (0.0, 0.003)),
        ("-3 @ 180", (3 * IN, 0.0)),
        ("3@270deg", (0.0, -3 * IN)),
        ("[1 in, 20 mm]", (IN, 0.02)),
        ("[1, -2e-1]", (IN, -0.2 * IN)),
    ],
)
def test_vectors(text: str, expected: tuple[float, float]) -> None:
    m = loads(f"units: {{length: in}}\nlinks: {{a: {{center: {text}}}}}")
    assert m.center("a") == pytest.approx(expected, abs=1e-15)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "value: 155 @ 40.35 lbf",
            (155 * LBF * math.cos(math.radians(40.35)), 155 * LBF * math.sin(math.radians(40.35))),
        ),
        ("value: [3, 4 N]", (3e3, 4.0)),
        ("value: 5, direction: 90", (0.0, 5e3)),
        ("value: 5 N, direction: 1 rad", (5 * math.cos(1), 5 * math.sin(1))),
        ("value: '500*sin(A) @ 90'", (0.0, 500e3 * math.sin(2))),
        ("value: '500*sin(A) @ 90 N'", (0.0, 500 * math.sin(2))),
        ("value: '500*sin(A) N @ 90 deg'", (0.0, 500 * math.sin(2))),
        ("value: ['500*sin(A)', 0]", (500e3 * math.sin(2), 0.0)),
        ("value: {expression: A^2, unit: lbf}, direction: 0", (4 * LBF, 0.0)),
        ("value: {against: A, x: [0, 360], y: [0, 1 N]}, direction: 0", (2 / (2 * math.pi), 0.0)),
        ("value: unknown, direction: 180", (-1.0, 0.0)),
    ],
)
def test_forces(text: str, expected: tuple[float, float]) -> None:
    m = loads(
        "units: {force: kN}\nlinks: {ground: {points: {A: [0, 0]}}, a: {points: {A: [0, 0]}}}\n"
        "joints: {A: {type: pin, links: [ground, a]}}\ndrives: {A: {position: 20}}\n"
        f"loads: {{F: {{type: force, on: a, at: A, {text}}}}}"
    )
    force = m.loads["F"]
    assert isinstance(force, ForceLoad)
    assert force.unknown == ("unknown" in text)
    assert (
        pytest.approx(np.tile(expected, (3, 1)), abs=1e-10) == np.array(force.force({"A": np.full(3, 2.0)})).T
    )


def test_weights_are_divided_by_the_files_gravity() -> None:
    links = "\nlinks: {a: {weight: 98 N}}"
    assert loads(links).mass("a") == 98 / 9.80665
    assert loads("gravity: standard" + links).mass("a") == 98 / 9.80665
    assert loads("gravity: [3, -4]" + links).mass("a") == 98 / 5
    assert loads("g: 386 in/s^2" + links).mass("a") == pytest.approx(98 / (386 * IN))
    assert loads("gravity: 9.8 @ -90" + links).gravity_vector == (0.0, -9.8)


def test_yaml_is_1_2() -> None:
    m = loads("links: {on: {mass: 1e-3}, yes: {mass: 0x10}, 3: {mass: 012}}")
    assert {name: m.mass(name) for name in m.links} == {"on": 0.001, "yes": 16.0, "3": 12.0}


def test_numbers_may_be_names() -> None:
    m = loads(
        "links: {1: {points: {2: [0, 0]}}, 2: {points: {2: [1, 0]}}}\njoints: {2: {type: pin, links: [1, 2]}}\n"
        "drives: {2: {position: 4}}"
    )
    assert m.joints["2"].links == ("1", "2")


@pytest.mark.parametrize("break_", ["\n", "\r\n"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_line_ends_and_byte_order_marks(break_: str, mark: str) -> None:
    assert loads(mark + FOUR_BAR.replace("\n", break_)) == loads(FOUR_BAR)


def test_blank_sections_are_absent() -> None:
    assert loads("title:\nlinks: {a: {}}\njoints:\ndrives:\nloads:\n").loads == {}


def test_who_changes_a_tree_changes_no_later_one() -> None:
    """Short texts are parsed once: each reading has its own tree all the same."""
    tree, source = read_text(FOUR_BAR)
    tree["links"].clear()
    tree["title"] = "another"
    again, its = read_text(FOUR_BAR)
    assert again["title"] == "Four-bar linkage, dynamic"
    assert "crank" in again["links"]
    assert source.line(("links",)) == its.line(("links",)) > 1


def test_anchors_and_aliases() -> None:
    m = loads("links: {a: &a {mass: 2}, b: *a}")
    assert m.mass("b") == 2.0


def test_in_python_bare_numbers_are_si_and_radians() -> None:
    m = Mechanism(
        units={"length": "in"},
        links={"ground": Link(points={"O": (0, 0)}), "a": Link(points={"O": [1, 2]}, center="3 in @ 1")},
        joints={"O": Pin(links=("ground", "a"))},
        drives={"O": Drive(position=1.0, speed=3)},
    )
    assert m.points("a")["O"] == (1.0, 2.0)
    assert m.center("a") == pytest.approx((3 * IN * math.cos(1), 3 * IN * math.sin(1)))
    assert m.drives["O"].freedom == "turn"
    assert m.has_speeds


def test_model_validate_follows_the_files_rules() -> None:
    tree = {"units": {"length": "mm"}, "links": {"a": {"center": [1, "2 m"]}}}
    assert Mechanism.model_validate(tree).center("a") == (0.001, 2.0)
    assert mechanism(tree) == Mechanism.model_validate(tree)


def test_in_python_a_drives_unit_says_its_freedom() -> None:
    assert Drive(position="3 mm").freedom == "slide"
    assert Drive(position={"from": "0 deg", "to": 1, "count": 2}).freedom == "turn"
    assert Drive(position=1.0, speed="1 rpm").freedom == "turn"
    assert Drive(position=1.0).freedom is None
    with pytest.raises(
        ModelError, match="drive 'O' prescribes a slide, and the freedom of joint 'O', a pin, is turn"
    ):
        Mechanism(
            links={"ground": Link(points={"O": (0, 0)}), "a": Link(points={"O": (0, 0)})},
            joints={"O": Pin(links=("ground", "a"))},
            drives={"O": Drive(position="3 mm")},
        )


@pytest.mark.parametrize(
    ("part", "keys", "says"),
    [
        (Link, {"mass": "3 N"}, "mass: '3 N' is a force, but a mass is needed; write one, for example '1.5 kg'"),
        (Link, {"mas": 3}, "unknown key 'mas'; did you mean 'mass'?"),
        (Pin, {}, "the key 'links' is missing; name the two links it connects, links: [ground, crank]"),
        (Slider, {"links": ("a", "a")}, "it connects link 'a' with itself; name two different links"),
        (Drive, {}, "its position is missing; write position: 60 deg, or {from: ..., to: ..., count: ...}, or a law; "
         "effort: 0 if only loads move it"),
        (ForceLoad, {"on": "a", "at": "A", "value": Expression("A", "m"), "direction": 0},
         "value: 'm' is a length, but a force is needed; write one, for example '80 N'"),
    ],
)  # fmt: skip
def test_a_wrong_part_in_python(part: Any, keys: dict[str, Any], says: str) -> None:
    with pytest.raises(ModelError) as caught:
        part(**keys)
    assert str(caught.value) == says


def test_descriptions_are_frozen() -> None:
    m = loads(FOUR_BAR)
    with pytest.raises(ValueError, match="frozen"):
        m.title = "other"  # type: ignore[misc]


def test_an_error_knows_its_path() -> None:
    with pytest.raises(ModelError) as caught:
        mechanism({"links": {"a": {"points": {"P": [1, "2 N"]}}}})
    assert caught.value.path == ("links", "a", "points", "P", 1)
    assert caught.value.file == ""
    with pytest.raises(ModelErrors) as several:
        mechanism({"links": {"a": {"mass": -1, "inertia": -1}}})
    assert [error.path[-1] for error in several.value.errors] == ["mass", "inertia"]


def test_the_line_of_a_path() -> None:
    source = loads(FOUR_BAR, name="four.yaml").source
    assert source is not None
    assert source.name == "four.yaml"
    assert source.line(("links", "coupler", "points", "P", "at")) == 12
    assert source.line(("links", "coupler", "mass")) == 11
    assert source.line(("joints", "O4", "links", 1)) == 22
    assert source.line(()) == 1


SPACE = """
space: space
gravity: standard
links:
  ground: {points: {A: [0, 0, 0], D: [1, 0, 0]}}
  crank: {points: {A: [0, 0, 0], B: [1, 0, 0]}, mass: 1, inertia: [1, 2, 3]}
  rod: {points: {B: [0, 0, 0], C: [1, 0, 0]}, mass: 1, inertia: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}
joints:
  A: {type: revolute, links: [ground, crank], axis: [0, 0, 1]}
  B: {type: spherical, links: [crank, rod]}
  C: {type: universal, links: [ground, rod], at: [D, C], axes: {i: {z: [0, 0, 1]}, j: {z: [0, 1, 0]}}}
drives:
  A: {position: 30, speed: 3 rpm}
  C: {position: 3, freedom: turn2}
loads:
  F: {type: force, on: rod, at: C, value: [1, 2, 3]}
  G: {type: force, on: rod, at: C, value: unknown, direction: [0, 3, 4]}
  T: {type: couple, on: rod, value: [1, 2, 3]}
assembly: {rod: {position: [0, 0, 1], axis: [0, 1, 0], angle: 30}}
"""


def test_a_file_in_space_is_understood() -> None:
    m = loads(SPACE)
    assert m.gravity_vector == (0.0, 0.0, -9.80665)
    assert m.center("crank") == (0.0, 0.0, 0.0)
    assert m.loads["G"].force({}) == (0.0, 0.6, 0.8)  # type: ignore[union-attr]
    assert mechanism(m.to_tree()) == m
    with pytest.raises(ModelError, match=r"'3 @ 4' is polar, which is for the plane; write \[x, y, z\]"):
        loads(SPACE.replace("value: [1, 2, 3]", "value: 3 @ 4"))
    with pytest.raises(
        ModelError, match="is of the type 'pin', which is not for space; take a joint in space"
    ):
        loads(SPACE.replace("type: spherical", "type: pin"))
