"""A mechanism as a plane sketch, and as the link of PMKS+ and the file of pylinkage made of it, whole."""

from __future__ import annotations

import json
import math
from typing import Any

import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.interchange.file_formats import foreign_bytes
from dalembert.interchange.sketches.drawn_sketch import sketch_of, sliding_blocks
from dalembert.interchange.sketches.plane_sketch import PlaneSketch, SketchJoint, SketchMass
from dalembert.interchange.sketches.pmks_links import decimal

GROUND = "ground"
REVERSED = """
title: reversed
gravity: [0, -9.81]
friction: {enabled: true}
links:
  ground: {points: {O: [1 m, 0.5 m], S: [0 m, 1 m], R: [0 m, 3 m]}}
  crank: {points: {O: [0, 0], T: [0.2 m, 0]}, mass: 2 kg, center: [0.1 m, 0], inertia: 0.3 kg*m^2}
  block: {points: {S: [0, 0]}, mass: 1 kg, center: [0.05 m, 0]}
  other: {points: {R: [0, 0]}, mass: 1 kg}
joints:
  O: {type: pin, links: [crank, ground], friction: {coefficient: 0.1, radius: 0.01 m}}
  S: {type: slider, links: [ground, block], direction: 60 deg}
  R: {type: slider, links: [other, ground], direction: 20 deg, angle: 10 deg}
drives:
  O: {position: {from: 30 deg, to: 50 deg, count: 2}, speed: 2 rad/s, acceleration: 1 rad/s^2}
  S: {position: 0.3 m, speed: -0.1 m/s}
  R: {position: 0.4 m, speed: 0.2 m/s}
loads:
  F: {type: force, on: crank, at: T, value: [3 N, 4 N]}
  G: {type: force, on: ground, at: R, value: [3 N, 4 N]}
  M: {type: couple, on: crank, value: 5 N*m}
answers: [{quantity: effort, of: O, value: 1 N*m, at: 1}]
"""
"""Two joints name the ground last: the crank hangs by 30 deg, and `other` slides back along -10 deg."""

PISTON = """
gravity: none
links:
  ground: {points: {O: [0, 0], C: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.3 m, 0]}, mass: 1 kg}
  rod: {points: {A: [0, 0], B: [0.5 m, 0]}}
  block: {points: {B: [0, 0]}, mass: 2 kg}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, block]}
  S: {type: slider, links: [ground, block], at: [C, B]}
drives: {S: {position: 0.4 m, speed: -0.25 m/s}}
assembly: {crank: [0, 0, 90 deg], rod: [0, 0.3 m, -37 deg]}
loads:
  F: {type: force, on: block, at: B, value: [3 N, -4 N]}
"""

TRUSS = """
gravity: none
links:
  ground: {points: {O: [0, 0], C: [0.8 m, 0]}}
  a: {points: {O: [0, 0], A: [0.5 m, 0]}}
  b: {points: {C: [0, 0], A: [0.5 m, 0]}}
joints:
  O: {type: pin, links: [ground, a]}
  C: {type: pin, links: [ground, b]}
  A: {type: pin, links: [a, b]}
assembly: {a: [0, 0, 37 deg], b: [0.8 m, 0, 143 deg]}
"""
ROUNDED = "coordinates, masses and forces beyond 0.01 mm, 1 g and 0.001 N: a link of PMKS+ is rounded"


def near(*values: float) -> Any:
    return pytest.approx(values, abs=1e-12)


def test_a_sketch_of_joints_that_name_the_ground_last() -> None:
    """Speeds are of the link against the ground; masses are at their centres, forces at their points."""
    sketch = sketch_of(da.loads(REVERSED), "PMKS+")
    c, s = math.sqrt(3) / 2, 0.5
    along = math.cos(math.radians(10)), -math.sin(math.radians(10))
    places = {"O": (1, 0.5), "S": (0.3 * s, 1 + 0.3 * c), "R": (-0.4 * along[0], 3 - 0.4 * along[1])}
    assert {j.name: (j.x, j.y) for j in sketch.joints} == {name: near(*at) for name, at in places.items()}
    assert [j.links for j in sketch.joints] == [[GROUND, "crank"], [GROUND, "block"], [GROUND, "other"]]
    assert sketch.joints[0].slides_along is None
    assert [j.slides_along for j in sketch.joints[1:]] == near(math.radians(60), math.radians(-10))
    assert [j.speed for j in sketch.joints] == near(-2, -0.1, -0.2)
    masses = {n: (m.mass, m.inertia, m.x, m.y) for n, m in sketch.masses.items()}
    assert masses == {
        "crank": near(2, 0.3, 1 + 0.1 * c, 0.5 - 0.1 * s),
        "block": near(1, 0, (0.3 + 0.05) * s, 1 + (0.3 + 0.05) * c),
        "other": near(1, 0, *places["R"]),
    }
    assert {n: (f[0], f[1:]) for n, f in sketch.forces.items()} == {
        "F": ("crank", near(1 + 0.2 * c, 0.5 - 0.2 * s, 3, 4))
    }
    assert (sketch.title, sketch.gravity) == ("reversed", True)
    assert sketch.lost == [
        *("load 'G' (force)", "load 'M' (couple)", "1 of 2 positions: the file has the first"),
        *("accelerations of drives", "dry friction", "published answers"),
    ]


@pytest.mark.parametrize(
    ("gravity", "kept", "note"),
    [
        ("none", False, []),
        ("standard", True, []),
        ("[0, -9.8 m/s^2]", True, []),
        ("[0, -9.79 m/s^2]", False, ["gravity of 0, -9.79 m/s2: X has the standard one, down, or none"]),
        ("[0, 9.81 m/s^2]", False, ["gravity of 0, 9.81 m/s2: X has the standard one, down, or none"]),
        (
            "[1 m/s^2, -9.81 m/s^2]",
            False,
            ["gravity of 1, -9.81 m/s2: X has the standard one, down, or none"],
        ),
        ("[3 m/s^2, 0]", False, ["gravity of 3, 0 m/s2: X has the standard one, down, or none"]),
    ],
)
def test_gravity_of_a_sketch_is_the_standard_one_or_none(gravity: str, kept: bool, note: list[str]) -> None:
    """To a thousandth."""
    sketch = sketch_of(da.loads(PISTON.replace("gravity: none", f"gravity: {gravity}")), "X")
    assert (sketch.gravity, sketch.lost) == (kept, note)


def test_a_block_that_is_driven_is_a_link_of_pmks_plus_in_centimetres_a_second() -> None:
    """Base 64: 9n0 is 40000 thousandths of a centimetre, 7Km 30000; the force of 5 N has an arrow of 40 cm by (3, -4).

    P is 25 cm/s; flags: 4 a fixed pin, 7 a driven slider on the ground; Fe 1 kg, VG 2 kg; the F before them says
    clockwise, without gravity.
    """
    content, lost = foreign_bytes(da.loads(PISTON), "x.pmks")
    assert content.decode() == (
        "app.pmksplus.com/?0P.Fe.P,0.101.4A,O,0,0,0.0B,A,0,7Km,0.0C,B,9n0,0,0.7D,S,9n0,0,0..YRAB,crank,Fe,0,0,0,c5cae9,"
        "A,B,,.YRBC,rod,0,0,0,7Km,303e9f,B,C,,.YPCD,block,VG,0,9n0,0,,C,D,,..2F1,CD,F,9n0,0,Fe0,07q0,1E8..N4\n"
    )
    assert lost == [ROUNDED]
    _, lost = foreign_bytes(da.loads(PISTON.replace("-0.25", "0.123")), "x.pmks")
    assert lost == ["speed 12.3 cm/s: PMKS+ has whole numbers", ROUNDED]


def test_a_truss_has_no_driver() -> None:
    content, lost = foreign_bytes(da.loads(TRUSS), "x.pmks")
    assert content.decode() == (
        "app.pmksplus.com/?0O.Fe.0,0.101.4A,O,0,0,0.4B,C,JY0,0,0.0C,A,9n0,7Km,0..YRAC,a,0,0,0,0,c5cae9,A,C,,."
        "YRBC,b,0,0,JY0,0,303e9f,B,C,,...Nr\n"
    )
    assert lost == [ROUNDED]
    for text in (TRUSS, PISTON):
        with pytest.raises(ModelError) as refused:
            foreign_bytes(da.loads(text), "x.pylinkage.json")
        assert str(refused.value) == (
            "the driver of pylinkage turns a crank on the ground; drive a pin on the ground"
        )


def test_a_link_of_pmks_plus_has_one_drive() -> None:
    first = ["all drives but the first: PMKS+ has one", ROUNDED]
    assert foreign_bytes(da.five_bar(positions=1), "x.pmks")[1] == first
    assert foreign_bytes(da.five_bar(positions=1), "x.pylinkage.json")[1] == [
        "all drives but one: pylinkage has one driver",
        "masses, gravity and speeds: pylinkage has geometry, and a driver with an angle a step",
        "load 'load' (force)",
    ]


@pytest.mark.parametrize(
    ("joint", "length"), [((0.0, 0.0), 100.0), ((0.0, -3.0), 300.0), ((2.0, -0.5), 200.0)]
)
def test_an_arrow_is_as_long_as_the_linkage(joint: tuple[float, float], length: float) -> None:
    """Its largest coordinate, in centimetres; a metre where that is 0. A force of no size points nowhere."""
    tree = {
        "links": {"ground": {"points": {"O": list(joint)}}, "a": {"points": {"O": [0, 0]}}},
        "joints": {"O": {"type": "pin", "links": ["ground", "a"]}},
        "drives": {"O": {"position": 0}},
        "loads": {
            name: {"type": "force", "on": "a", "at": "O", "value": value}
            for name, value in (("F,1", ["0 N", "-7 N"]), ("none", ["0 N", "0 N"]))
        },
    }
    text = foreign_bytes(da.mechanism(tree), "x.pmks")[0].decode()
    first, second = (part.split(",") for part in text.split(".") if part.startswith("2F"))
    assert (first[:3], second[:3]) == (["2F1", "A", "F_1"], ["2F2", "A", "none"])
    x, y = (100 * c for c in joint)
    assert [decimal(n) for n in first[3:]] == [x, y, x, y - length, 7]
    assert [decimal(n) for n in second[3:]] == [x, y, x, y, 0]


@pytest.mark.parametrize(("apart", "fits"), [(0.0, True), (0.9e-9, True), (1.1e-9, False)])
def test_a_block_has_one_pin_at_its_slider(apart: float, fits: bool) -> None:
    pin, slider = (
        SketchJoint("B", 3, 4, ["rod", "block"]),
        SketchJoint("S", 3, 4 + apart, [GROUND, "block"], 0.2),
    )
    masses = {"rod": SketchMass(1, 1, 0, 0), "block": SketchMass(1, 1, 0, 0)}
    for joints in ([pin, slider], [slider, pin]):
        sketch = PlaneSketch("", joints, masses)
        if fits:
            assert sliding_blocks(sketch, "X") == {"block": (pin, slider)}
        else:
            with pytest.raises(
                ModelError, match="link 'block': a sliding link of X has one pin, at its slider; give"
            ):
                sliding_blocks(sketch, "X")
    for joints in ([slider], [pin, pin, slider], [slider, slider]):
        with pytest.raises(
            ModelError, match="link 'block': a sliding link of X has one pin, at its slider; give"
        ):
            sliding_blocks(PlaneSketch("", joints, masses), "X")


ENGINE = PISTON.replace(
    "S: {position: 0.4 m, speed: -0.25 m/s}", "O: {position: 90 deg, speed: -3 rad/s}"
).replace("at: [C, B]}", "at: [C, B], direction: 0 deg}")


def test_a_file_of_pylinkage_of_an_engine() -> None:
    """The crank stands at a right angle and turns clockwise; the piston is a joint that slides along x."""
    content, lost = foreign_bytes(da.loads(ENGINE), "x.pylinkage.json")
    tree = json.loads(content)
    assert (tree["name"], tree["ground"], list(tree)) == ("", GROUND, ["name", "joints", "links", "ground"])
    joints = {j.pop("id"): j for j in tree["joints"]}
    assert {n: j.pop("position") for n, j in joints.items()} == {
        "O": near(0, 0),
        "A": near(0, 0.3),
        "B": near(0.4, 0),
    }
    assert joints["B"].pop("line_point") == near(0.4, 0)
    assert joints == {
        "O": {"type": "ground"},
        "A": {"type": "revolute"},
        "B": {"type": "prismatic", "axis": [1.0, 0.0], "slide_distance": 0.0},
    }
    crank = tree["links"][1]
    assert crank.pop("initial_angle") == pytest.approx(math.pi / 2)
    assert crank.pop("angular_velocity") == pytest.approx(-math.pi / 50)
    assert tree["links"] == [
        {"id": GROUND, "type": "ground", "joints": ["O"]},
        {"id": "crank", "type": "driver", "joints": ["O", "A"], "motor_joint": "O"},
        {"id": "rod", "type": "link", "joints": ["A", "B"]},
    ]
    assert lost == [
        "masses, gravity and speeds: pylinkage has geometry, and a driver with an angle a step",
        "load 'F' (force)",
    ]
