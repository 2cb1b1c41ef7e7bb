"""Friction in closed spatial mechanisms against Newton and Euler's equations link by link with the laws as stated."""

from __future__ import annotations

from copy import deepcopy
from functools import cache, partial
from typing import Any

import numpy as np
import pytest

import dalembert as da
from tests import tiers
from tests.oracles.reading import Array
from tests.oracles.space import natural, random_drawn, rough_machines, rubbing
from tests.space.rough import SOLVED, roughened, solved

TOLERANCE = 1e-11
over: Any = partial(tiers.over, whole=200)


def largest(b: rubbing.Rubbed) -> Array:
    """Largest force, or moment over 1 m, of each position (P,)."""
    return np.max([np.max(np.abs(f), -1) for f in (*b.forces.values(), *b.moments.values())], 0)


def disagreement(r: Any, b: rubbing.Rubbed) -> dict[str, float]:
    """Of reactions on j without their viscous part, efforts and powers lost, where there are numbers."""
    out, good, scale = {}, solved(r), largest(b)
    for k, name in enumerate(r.joints):
        force = r.reaction(name) - r.friction.viscous_force[:, k] - b.forces[name]
        moment = r.reaction_moment(name) - r.friction.viscous_moment[:, k] - b.moments[name]
        out[f"reaction {name}"] = np.max(np.abs(force), -1) / scale
        out[f"moment {name}"] = np.max(np.abs(moment), -1) / scale
        out[f"loss {name}"] = np.abs(r.power_lost(name, "dry") - b.lost[name]) / scale
    for name in r.drives:
        out[f"effort {name}"] = np.abs(r.effort(name) - b.efforts[name]) / scale
    return {key: float(np.max(value[good], initial=0.0)) for key, value in out.items()}


def worst(found: dict[str, float]) -> tuple[str, float]:
    name = max(found, key=lambda key: np.nan_to_num(found[key], nan=np.inf))
    return name, found[name]


@cache
def expected(name: str, dynamic: bool) -> rubbing.Rubbed:
    _, m, path = rough_machines.machine(name)
    return rubbing.solve(m, natural.solve(m, path, dynamic), dynamic)


CYCLES = [(name, dynamic) for name in rough_machines.FRICTION for dynamic in (True, False)]


@pytest.mark.parametrize(
    ("name", "dynamic"),
    [pytest.param(*c, marks=[pytest.mark.long] if c == ("two_rods", True) else []) for c in CYCLES],
)
def test_every_number_over_a_cycle(name: str, dynamic: bool) -> None:
    r = (da.dynamics if dynamic else da.statics)(da.mechanism(rough_machines.machine(name)[0]))
    assert len(r.status) == (8 if name == "two_rods" else 24)
    assert set(r.status) <= set(SOLVED)
    b = expected(name, dynamic)
    assert (b.scale == 1).all()
    part, off = worst(disagreement(r, b))
    assert off < TOLERANCE, part


@pytest.mark.parametrize(("name", "joint"), [("rssp", "F"), ("rssr", "F"), ("rccc", "A"), ("rccc", "C")])
def test_the_ends_of_a_bearing_bear_on_one_side_and_on_opposite_ones(name: str, joint: str) -> None:
    """The machines are such that both ways of contact come up, to and fro."""
    tree, m, path = rough_machines.machine(name)
    b, t = expected(name, True), tree["joints"][joint]
    s = rubbing.Problem(m, natural.solve(m, path), True).joints[joint]
    near, last = rubbing.ends(
        {**t, **t["friction"]}, np.concatenate([b.forces[joint], b.moments[joint]], -1), s
    )
    forth = (s.turn if t["type"] == "revolute" else s.slide) > 0
    sides = set(zip((np.sum(near * last, -1) > 0).tolist(), forth.tolist(), strict=True))
    assert sides == {(True, True), (True, False), (False, True), (False, False)}


@pytest.mark.parametrize(
    "name",
    ["rssr", "rccc", *(pytest.param(name, marks=pytest.mark.long) for name in ("rssp", "press", "two_rods"))],
)
def test_the_ends_at_rest_are_the_two_slow_motions(name: str) -> None:
    """Rods between balls spin as they do in the slow motion: each end is in equilibrium."""
    tree = deepcopy(rough_machines.machine(name)[0])
    drive = tree["drives"]["O"]
    drive["position"]["count"] = 3
    del drive["acceleration"]
    found = []
    for speed in (-1e-3, 1e-3, 0.0):
        drive["speed"] = f"{speed} rad/s"
        found.append(da.statics(da.mechanism(tree)))
    slow = np.sort([r.effort("O") for r in found[:2]], axis=0).T
    assert found[2].interval("O") == pytest.approx(slow, rel=1e-10)
    assert all(np.max(end.residual) < TOLERANCE for end in found[2].ends[0])


@pytest.mark.parametrize("name", ["rssr", "rccc"])
def test_the_taught_iteration_arrives_at_the_answer(name: str) -> None:
    """With the rod spinning as in the answer, and the circles of a cylinder that turns."""
    tree = deepcopy(rough_machines.machine(name)[0])
    tree["drives"]["O"]["position"]["count"] = 2
    r = da.statics(da.mechanism(tree))
    assert da.fixed_point(r).unknowns["O"][-1] == pytest.approx(r.effort("O")[0], rel=1e-9)
    assert da.other_solutions(r) == []


@pytest.mark.long
def test_a_cycle_that_jams_ends_at_the_same_scale_of_friction() -> None:
    tree, _, path = rough_machines.machine("rccc")
    tree = deepcopy(tree)
    for joint in ("O", "A", "C"):
        tree["joints"][joint]["friction"]["coefficient"] = 0.5
    r, m = da.statics(da.mechanism(tree)), natural.Machine(tree)
    jammed = ~solved(r)
    b = rubbing.solve(m, natural.solve(m, path, False), False, smallest=1e-7)
    assert 0 < np.sum(jammed) < len(jammed)
    assert ((b.scale == 1) == ~jammed).all()
    assert b.scale[jammed] == pytest.approx(r.friction.critical[jammed], abs=1e-5)  # type: ignore[union-attr]


def jamming_rod() -> tuple[Any, Array]:
    """Circles that reach along most of the rod, which spins as friction lets it on the way to the branch's end."""
    tree, _, path = rough_machines.machine("rssr")
    tree = deepcopy(tree)
    for joint in "AB":
        tree["joints"][joint]["friction"] = {"coefficient": 0.6, "radius": 0.3, "circle": "tan"}
    return tree, path


def test_a_rod_jams_between_its_balls_at_a_scale_of_friction() -> None:
    """At a position beside those of the long test, with the scale that the independent equations have there."""
    tree, _ = jamming_rod()
    tree["drives"]["O"]["position"] = 115.0
    r = da.statics(da.mechanism(tree))
    assert r.status == ("jammed",)
    assert r.friction.critical == pytest.approx([0.94163], abs=2e-5)  # type: ignore[union-attr]


@pytest.mark.long
def test_a_rod_that_jams_between_its_balls() -> None:
    tree, path = jamming_rod()
    tree["drives"]["O"]["position"]["count"], path = 12, path[::2]
    r, m = da.statics(da.mechanism(tree)), natural.Machine(tree)
    b = rubbing.solve(m, natural.solve(m, path, False), False, smallest=1e-7)
    jammed = ~solved(r)
    assert 0 < np.sum(jammed) < len(jammed)
    assert ((b.scale == 1) == ~jammed).all()
    assert b.scale[jammed] == pytest.approx(r.friction.critical[jammed], abs=2e-5)  # type: ignore[union-attr]
    part, off = worst(disagreement(r, b))
    assert off < TOLERANCE, part


@cache
def drawn(seed: int) -> tuple[Any, Array, Any]:
    """A random mechanism with friction, its path, and the answer."""
    tree, _, path = random_drawn.mechanism(seed)
    roughened(tree, seed)
    return tree, path, da.dynamics(da.mechanism(tree))


@cache
def moves_with_friction(seed: int) -> bool:
    r = drawn(seed)[-1]
    return r.friction is not None and {"at_rest", "reversal"}.isdisjoint(r.status)


@over(2)
def test_random_mechanisms(seed: int) -> None:
    """Solved where the oracle's branch goes on to all of friction, jammed where that ends, at the same scale."""
    tree, path, r = drawn(tiers.nth(seed, moves_with_friction))
    m = natural.Machine(tree)
    b = rubbing.solve(m, natural.solve(m, path))
    assert ((b.scale == 1) == solved(r)).all()
    jammed = ~solved(r)
    assert b.scale[jammed] == pytest.approx(r.friction.critical[jammed], abs=1e-4)
    name, off = worst(disagreement(r, b))
    assert off < TOLERANCE, name
