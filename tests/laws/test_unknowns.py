"""Knowns and unknowns exchanged: the given value is computed again; duplicates are not unique; all else stays."""

from __future__ import annotations

from copy import deepcopy
from functools import lru_cache, partial
from typing import Any

import numpy as np
import pytest

import dalembert as da
from tests.laws.test_laws import TOLERANCE, dynamics
from tests.random_mechanisms import random_case
from tests.tiers import nth, over


@lru_cache(maxsize=256)
def first_drive_feels_the_force(seed: int) -> bool:
    """A thousand times the force changes its effort."""
    tree = random_case(seed).tree
    size, drive = np.hypot(*tree["loads"]["F0"]["value"]), next(iter(tree["drives"]))
    more = _with_force(tree, [1000 * c for c in tree["loads"]["F0"]["value"]])
    weighed = dynamics(more).effort(drive) - dynamics(tree).effort(drive)
    return bool(np.min(np.abs(weighed)) >= 1e-3 * 999 * size)


@over(6, 200)
def test_a_force_is_found_from_the_effort_that_balances_it(seed: int) -> None:
    """An effort made known and a force made unknown give back the force."""
    case = random_case(nth(seed, first_drive_feels_the_force))
    r = dynamics(case.tree)
    force, drive = case.tree["loads"]["F0"], next(iter(case.tree["drives"]))
    size, direction = np.hypot(*force["value"]), np.degrees(np.arctan2(*force["value"][::-1]))
    made = _with_force(case.tree, "unknown", direction=float(direction))
    made["drives"][drive]["effort"] = float(r.effort(drive)[0])
    for other in made["drives"].values():
        other["position"] = other["position"][0]
    found = dynamics(made)
    assert abs(found.unknown_load("F0")[0] - size) < 1e3 * TOLERANCE * case.answer.force_scale()
    for joint in r.joints:
        gap = np.max(np.abs(found.reaction(joint)[0] - r.reaction(joint)[0]))
        assert gap < 1e3 * TOLERANCE * case.answer.force_scale(), joint


def _with_force(tree: dict[str, Any], value: Any, **more: Any) -> dict[str, Any]:
    made = deepcopy(tree)
    made["loads"]["F0"] |= {"value": value, **more}
    return made


def undamped(kind: str, seed: int) -> list[str]:
    """Joints of a kind without a damper."""
    joints = random_case(seed).tree["joints"]
    return [name for name, joint in joints.items() if joint["type"] == kind and "damping" not in joint]


SOME = {kind: lru_cache(maxsize=512)(partial(undamped, kind)) for kind in ("pin", "slider")}


@over(4, 200)
@pytest.mark.parametrize("kind", ["pin", "slider"])
def test_a_doubled_joint_is_redundant_and_changes_nothing_else(seed: int, kind: str) -> None:
    case = random_case(found := nth(seed, SOME[kind]))
    made, pin = deepcopy(case.tree), SOME[kind](found)[-1]
    made["joints"]["twin"] = deepcopy(made["joints"][pin])
    single, double = dynamics(case.tree), da.dynamics(da.mechanism(made))
    force = case.answer.force_scale()
    assert set(double.status) == {"redundant"}
    assert double.mobility.redundant == 2
    assert {"twin", pin} <= set(double.mobility.redundant_joints)
    for drive in single.drives:
        assert np.max(np.abs(double.effort(drive) - single.effort(drive))) < 10 * TOLERANCE * force
    for joint in single.joints:
        if joint != pin:
            assert np.max(np.abs(double.reaction(joint) - single.reaction(joint))) < 10 * TOLERANCE * force
    assert np.all(np.isnan(double.reaction("twin")) | ~double.unique("twin")[:, :2])
    half = double.least_norm("twin") - double.least_norm(pin)
    assert np.max(np.abs(half)) < 10 * TOLERANCE * force
    whole = (double.least_norm("twin") + double.least_norm(pin))[:, :2]
    assert np.max(np.abs(whole - single.reaction(pin))) < 10 * TOLERANCE * force
