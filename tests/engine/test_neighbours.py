"""Pairs of descriptions that differ in one element, one analysed after the other: each has a program of its own.

A program is kept by its structure's key. A key that leaves something out answers the second of a pair with the program
of the first, in agreement with all of its own checks: only the careful path's answer shows it.
"""

from __future__ import annotations

from itertools import permutations
from typing import Any

import pytest
from ruamel.yaml import YAML

import dalembert as da
from dalembert.analysis.engine import structures
from tests.engine.comparing import counted, difference
from tests.engine.neighbours import neighbours
from tests.friction.rough import rough_tree
from tests.random_mechanisms import random_case
from tests.random_mechanisms import tree as plane_tree
from tests.random_space import random_case as random_space_case
from tests.random_space import tree as space_tree
from tests.tiers import over_seeds

TOLERANCE = 1e-9

CRANK = """
dalembert: 1
gravity: [2.7, -9.3]
links:
  ground: {points: {O: [0.013, -0.021], B: [0.52, -0.11]}}
  crank:
    {points: {O: [0.004, 0.003], A: [0.104, -0.007], S: [0.051, 0.036]},
     mass: 1.13, center: [0.047, 0.012], inertia: 0.0131}
  rod:
    {points: {A: [0.006, -0.005], B: [0.363, 0.017], D: [0.171, 0.094]},
     mass: 2.07, center: [0.133, 0.029], inertia: 0.0437}
  block: {points: {B: [0.009, 0.007], Q: [0.021, 0.033]}, mass: 3.19, center: [0.019, -0.006], inertia: 0.0231}
joints:
  O: {type: pin, links: [ground, crank], damping: 0.071}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, block]}
  F: {type: slider, links: [ground, block], at: B, direction: 11.0, angle: 7.0}
drives:
  O: {position: [47.0, 59.0], speed: 3.1 rad/s, acceleration: -5.7 rad/s^2}
loads:
  P: {type: force, on: rod, at: D, axes: ground, value: [31.0, -17.0]}
  R: {type: force, on: block, at: Q, axes: link, value: [-13.0, 23.0]}
  M: {type: couple, on: rod, value: 2.3}
  spring: {type: spring, between: [crank.S, block.Q], stiffness: 410.0, free_length: 0.173}
  damper: {type: damper, between: [ground.B, rod.D], damping: 19.0}
  strip: {type: constant_force_spring, between: [crank.S, ground.B], force: 29.0}
  twist: {type: torsion_damper, joint: B, damping: 0.37}
assembly: {rod: -31.0}
"""
"""Whose motion and forces are all answered by one program."""

ROUGH = """
dalembert: 1
gravity: [2.7, -9.3]
friction: {coefficient: 0.11, circle: sin}
links:
  ground: {points: {O: [0.013, -0.021], B: [0.52, -0.11]}}
  crank: {points: {O: [0.004, 0.003], A: [0.104, -0.007]},
     mass: 1.13, center: [0.047, 0.012], inertia: 0.0131}
  rod:
    {points: {A: [0.006, -0.005], B: [0.363, 0.017], D: [0.171, 0.094]},
     mass: 2.07, center: [0.133, 0.029], inertia: 0.0437}
  block: {points: {B: [0.009, 0.007], Q: [0.021, 0.033]}, mass: 3.19, center: [0.019, -0.006], inertia: 0.0231}
joints:
  O: {type: pin, links: [ground, crank], friction: {radius: 0.012}}
  A: {type: pin, links: [crank, rod], friction: {radius: 0.017, coefficient: 0.07, circle: tan}}
  B: {type: pin, links: [rod, block], friction: {radius: 0.009}}
  F:
    {type: slider, links: [ground, block], at: B, direction: 11.0, angle: 7.0,
     friction: {coefficient: 0.13, guide: [0.41, 0.33], half_height: 0.026}}
drives:
  O: {position: [47.0, 59.0], speed: 3.1 rad/s, acceleration: -5.7 rad/s^2}
loads:
  P: {type: force, on: rod, at: D, axes: ground, value: [31.0, -17.0]}
  R: {type: force, on: block, at: Q, axes: link, value: [-13.0, 23.0]}
assembly: {rod: -31.0}
"""
"""Whose contacts slip: its forces come from a program."""

WHEELS = """
dalembert: 1
gravity: [2.7, -9.3]
friction: {coefficient: 0.11}
links:
  ground: {points: {O: [0.013, -0.021], C: [0.193, 0.075]}}
  first: {points: {O: [0.004, 0.003], S: [0.051, 0.036]},
     mass: 1.13, center: [0.047, 0.012], inertia: 0.0131}
  second: {points: {C: [0.006, -0.005], S: [0.063, 0.017]},
     mass: 2.07, center: [0.033, 0.029], inertia: 0.0437}
joints:
  O: {type: pin, links: [ground, first]}
  C: {type: pin, links: [ground, second], friction: {radius: 0.013}}
  G:
    {type: gear, links: [first, second], at: [O, C], radii: [0.077, 0.127], internal: false, pressure_angle: 23.0,
     friction: {arm: 0.007}}
drives:
  O: {position: [47.0, 59.0], speed: 3.1 rad/s, acceleration: -5.7 rad/s^2}
loads:
  M: {type: couple, on: second, value: -7.3}
  P: {type: force, on: second, at: S, axes: link, value: [31.0, -17.0]}
  twist: {type: torsion_spring, joint: C, stiffness: 0.37, free_angle: 17.0}
assembly: {second: 21.0}
"""

SPATIAL = """
dalembert: 1
space: space
gravity: [2.7, -9.3, 1.9]
links:
  ground: {points: {O: [0.013, -0.021, 0.007], C: [0.213, 0.047, -0.083]}}
  crank:
    {points: {O: [0.004, 0.003, -0.006], A: [0.064, 0.009, 0.011], S: [0.021, 0.033, 0.014]},
     mass: 1.13, center: [0.031, 0.012, 0.008], inertia: [0.0011, 0.0023, 0.0029]}
  rod:
    {points: {A: [0.061, 0.002, -0.004], B: [0.306, 0.039, 0.026], S: [0.19, 0.05, -0.03]},
     mass: 2.07, center: [0.17, 0.029, 0.013], inertia: [0.0031, 0.0123, 0.0137]}
  rocker:
    {points: {C: [0.207, 0.053, -0.079], B: [0.311, 0.041, 0.023], S: [0.27, 0.013, 0.017]},
     mass: 1.61, center: [0.257, 0.048, -0.021], inertia: [0.0019, 0.0027, 0.0037]}
joints:
  O: {type: revolute, links: [ground, crank], axis: [0.0, 0.0, 1.0], damping: 0.071}
  A: {type: universal, links: [crank, rod], axes: {i: {z: [0.2, 0.1, 0.9]}, j: {z: [0.1, 0.8, -0.3]}}}
  B: {type: spherical, links: [rod, rocker]}
  C: {type: revolute, links: [ground, rocker], axis: [0.1, 0.98, 0.03]}
drives:
  O: {position: [7.0, 19.0], speed: 3.1 rad/s, acceleration: -5.7 rad/s^2}
loads:
  P: {type: force, on: rod, at: S, axes: ground, value: [31.0, -17.0, 8.0]}
  M: {type: couple, on: rocker, axes: link, value: [2.3, -1.7, 0.9]}
  spring: {type: spring, between: [crank.S, rocker.S], stiffness: 410.0, free_length: 0.173}
  twist: {type: torsion_damper, joint: C, damping: 0.37}
"""


@pytest.fixture(autouse=True)
def alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """No programs but those of this test."""
    monkeypatch.setattr(structures, "STRUCTURES", structures.Structures())


def answer(m: Any, static: bool, **how: Any) -> Any:
    """The answer, or the sentence with which it is refused."""
    try:
        return (da.statics if static else da.dynamics)(m, **how)
    except da.ModelError as error:
        return str(error)


def read(tree: Any) -> Any:
    try:
        return da.mechanism(tree)
    except da.ModelError:
        return None


def check(trees: list[tuple[str, Any]], static: int = 5) -> list[str]:
    """Analyse each with what is kept of those before it, some in statics too; how programs answered."""
    run = [(name, m, k) for name, t in trees if (m := read(t)) for k in (False, True)]
    run = [each for k, each in enumerate(run) if not (each[2] and k // 2 % static)]
    with counted() as ways:
        for name, m, k in run:
            found, careful = answer(m, k), answer(m, k, method="careful")
            if isinstance(careful, str) or isinstance(found, str):
                assert found == careful, name
            else:
                assert difference(found, careful) < TOLERANCE, (name, k)
    return [way for way in ways if way]


def is_moved(name: str) -> bool:
    """True if a joint is on another link: a first pose by search takes as long as 40 other changes."""
    return " on " in name and " for " in name


@pytest.mark.parametrize(
    ("text", "step", "least"),
    [
        *((CRANK, 3, 35), (ROUGH, 4, 22), (WHEELS, 3, 22), (SPATIAL, 7, 15)),
        *(pytest.param(text, 0, 0, marks=pytest.mark.long) for text in (CRANK, ROUGH, WHEELS, SPATIAL)),
    ],
    ids=[f"{tier}{name}" for tier in ("", "every-") for name in ("plane", "rough", "wheels", "space")],
)
def test_neighbours(text: str, step: int, least: int) -> None:
    """Every nth change and every sixteenth of the joints on another link; all of them where n is 0."""
    tree = YAML(typ="safe").load(text)
    every = list(neighbours(tree))
    kept, slow = ([x for x in every if is_moved(x[0]) == moved] for moved in (False, True))
    some = [*kept[::step], *slow[::16]] if step else every
    assert len(check([("itself", tree), *some])) >= (least or len(every) // 3)


@over_seeds([], range(100), block=1)
def test_neighbours_of_random_mechanisms(seed: int) -> None:
    """A fiftieth of those in the plane, in space and with friction, each before and after the others."""
    drawn = (plane_tree(random_case(seed).drawing), rough_tree(seed), space_tree(random_space_case(seed)))
    groups = [[("itself", tree), *list(neighbours(tree))[seed % 50 :: 50]] for tree in drawn]
    # a mechanism whose first pose only the careful path finds uses no program; one of the three does
    used = [check(some) or check(some[::-1]) for some in groups]
    assert any(used)


def test_what_is_asked_is_part_of_the_key(monkeypatch: pytest.MonkeyPatch) -> None:
    """Motion alone, statics and dynamics of one mechanism, in every order."""
    m = da.mechanism(YAML(typ="safe").load(CRANK))
    asked = {"motion": da.kinematics, "statics": da.statics, "dynamics": da.dynamics}
    careful = {name: asked[name](m, method="careful") for name in ("statics", "dynamics")}
    for order in permutations(asked):
        monkeypatch.setattr(structures, "STRUCTURES", structures.Structures())
        for name in order:
            found = asked[name](m)
            if name != "motion":
                assert difference(found, careful[name]) < TOLERANCE, (order, name)


def test_an_assembly_mode_has_the_names_of_its_own_mechanism() -> None:
    """Two descriptions that differ in a link's name alone have one program, and each its own sentence."""
    text = CRANK.replace("assembly: {rod: -31.0}\n", "")
    for name in ("rod", "bar", "rod"):
        r = da.dynamics(da.loads(text.replace("rod", name)))
        assert r.mode is not None
        assert r.mode.startswith(f"assembly mode {name} -33.56 deg (from a search); other modes")
        assert r.mode.endswith(f": {name} -131.50 deg")
    assert len(structures.STRUCTURES.found) == 1
