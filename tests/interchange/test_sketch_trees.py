"""A plane sketch as the tree of a model file, whole: axes of links along their joints, drives, masses and forces."""

from __future__ import annotations

import math
from typing import Any

import pytest

from dalembert.errors import ModelError
from dalembert.interchange.sketches.plane_sketch import PlaneSketch, SketchJoint, SketchMass, sketch_tree

GROUND = "ground"
STEEP, FLAT = math.degrees(math.atan2(4, 3)), math.degrees(math.atan2(3, 4))


def near(value: Any) -> Any:
    """The same tree with its numbers to 1e-12."""
    if isinstance(value, dict):
        return {key: near(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [near(inner) for inner in value]
    return pytest.approx(value, abs=1e-12) if isinstance(value, float) else value


def test_a_sketch_of_every_part() -> None:
    """The crank is along (3, 4) from (1, 1), the rod upwards, the bar along (4, 3) beyond two joints at a place."""
    sketch = PlaneSketch(
        "sketch",
        [
            SketchJoint("B", 4, 5, ["crank", "rod", "arm"], speed=0.0, line=7),
            SketchJoint("A", 1, 1, [GROUND, "crank"], speed=-2.5),
            SketchJoint("C", 4, 9, ["rod", "block"], line=9),
            SketchJoint("S", 4, 9, [GROUND, "block"], math.radians(30), 0.5),
            SketchJoint("D", 7, 5, ["arm"]),
            SketchJoint("E", 2.5, 3, ["crank", "bar"], math.radians(70)),
            SketchJoint("F", 2.5, 3, ["bar"]),
            SketchJoint("G", 2.9, 3.3, ["bar"]),
        ],
        {
            "crank": SketchMass(2, 0.3, 3.5, 1),
            "arm": SketchMass(1, 0.0, 5, 6),
            GROUND: SketchMass(9, 9, 9, 9),
        },
        {"P": ("rod", 5, 7, 3, -4), "Q": (GROUND, 2, 3, 1, 0)},
        gravity=True,
    )
    tree, lines = sketch_tree(sketch, "x")
    pin = {"type": "pin"}
    assert tree == near(
        {
            "dalembert": 1,
            "title": "sketch",
            "gravity": "standard",
            "links": {
                GROUND: {"points": {"A": [1.0, 1.0], "S": [4.0, 9.0]}},
                "crank": {
                    "points": {"A": [0.0, 0.0], "B": [5.0, 0.0], "E": [2.5, 0.0]},
                    "mass": 2,
                    "inertia": 0.3,
                    "center": [1.5, -2.0],
                },
                "rod": {"points": {"B": [0.0, 0.0], "C": [4.0, 0.0]}},
                "arm": {
                    "points": {"B": [0.0, 0.0], "D": [3.0, 0.0]},
                    "mass": 1,
                    "inertia": 0.0,
                    "center": [1.0, 1.0],
                },
                "block": {"points": {"S": [0.0, 0.0], "C": [0.0, 0.0]}},
                "bar": {"points": {"E": [0.0, 0.0], "F": [0.0, 0.0], "G": [0.5, 0.0]}},
            },
            "joints": {
                "B": pin | {"links": ["crank", "rod"], "at": "B"},
                "B_2": pin | {"links": ["crank", "arm"], "at": "B"},
                "A": pin | {"links": [GROUND, "crank"], "at": "A"},
                "C": pin | {"links": ["rod", "block"], "at": "C"},
                "S": {
                    "type": "slider",
                    "links": [GROUND, "block"],
                    "at": "S",
                    "direction": 30.0,
                    "angle": -30.0,
                },
                "E": {
                    "type": "slider",
                    "links": ["crank", "bar"],
                    "at": "E",
                    "direction": 70 - STEEP,
                    "angle": FLAT - 70,
                },
            },
            "drives": {
                "B": {"position": 90 - STEEP},
                "A": {"position": STEEP, "speed": "-2.5 rad/s"},
                "S": {"position": 0, "speed": "0.5 m/s"},
            },
            "loads": {
                "P": {"type": "force", "on": "rod", "at": [2.0, -1.0], "value": [3, -4]},
                "Q": {"type": "force", "on": GROUND, "at": [2.0, 3.0], "value": [1, 0]},
            },
            "assembly": {
                "crank": [1.0, 1.0, STEEP],
                "rod": [4.0, 5.0, 90.0],
                "arm": [4.0, 5.0, 0.0],
                "block": [4.0, 9.0, 0.0],
                "bar": [2.5, 3.0, FLAT],
            },
        }
    )
    assert lines == {("joints", "B"): 7, ("joints", "B_2"): 7, ("joints", "C"): 9}


def test_a_sketch_without_ground_is_refused() -> None:
    with pytest.raises(ModelError) as refused:
        sketch_tree(PlaneSketch("", [SketchJoint("A", 0, 0, ["a", "b"])]), "x.dxf")
    assert str(refused.value) == "x.dxf:1: no joint is on the ground; fix at least one joint"
    tree, _ = sketch_tree(PlaneSketch("", [SketchJoint("A", 0, 0, [GROUND, "b"])]), "x.dxf")
    assert (tree["gravity"], tree["drives"], tree["loads"]) == ("none", {}, {})
