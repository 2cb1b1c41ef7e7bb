"""Every pair in any axes: constraints and freedoms are reciprocal and together complete; rows are what they measure."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from dalembert.analysis.compile.pair_table import _with_pin, local_axes
from dalembert.arrays import Array
from dalembert.core.constraints import drift, measure, system
from dalembert.model.joints.pairs import AXES, PAIRS
from tests.space.bodies import allowed, body_on, moved, placed

KINDS = [(kind, {}) for kind in PAIRS] + [
    (kind, {"blocked": axis}) for kind in ("slotted_sphere", "slotted_sphere_in_cylinder") for axis in "yz"
]
CASES = [pytest.param(kind, keys, id="-".join([kind, *keys.values()])) for kind, keys in KINDS]

TABLE = {
    "sphere_between_planes": (3, 2, "Fx"),
    "sphere_in_cylinder": (3, 1, "Fy Fz"),
    "cylinder_between_planes": (2, 2, "Fx My"),
    "spherical": (3, 0, "Fx Fy Fz"),
    "slotted_sphere_in_cylinder": (2, 1, "Fy Fz Mx"),
    "plane": (1, 2, "Fx My Mz"),
    "slotted_sphere": (2, 0, "Fx Fy Fz Mx"),
    "torus": (2, 0, "Fx Fy Fz Mx"),
    "cylindrical": (1, 1, "Fy Fz My Mz"),
    "slotted_cylinder": (1, 1, "Fy Fz Mx My"),
    "revolute": (1, 0, "Fx Fy Fz Mx My"),
    "prismatic": (0, 1, "Fy Fz Mx My Mz"),
}
"""The classic table: turns, slides, reactions."""


@pytest.mark.parametrize("kind", TABLE)
def test_the_classic_table(kind: str) -> None:
    turns, slides, reactions = TABLE[kind]
    pair = PAIRS[kind]
    carried = [f"F{a}" for a in pair.forces] + [f"M{a}" for a in pair.moments]
    assert (len(pair.turns), len(pair.slides), " ".join(carried)) == (turns, slides, reactions)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize(("kind", "keys"), CASES)
def test_freedoms_and_constraints_are_reciprocal_and_complete(
    kind: str, keys: dict[str, str], seed: int
) -> None:
    rng = np.random.default_rng(seed)
    c, pose = placed(body_on(kind, rng, **keys), rng)
    g, rows = c.layout.algebra, c.layout.constraints
    off = np.abs(measure(g, rows, pose) - c.target)[0]
    assert off[~_screws(c)].max(initial=0.0) < 1e-12
    wrenches, twists = system(g, rows, pose).on_j[0], allowed(c, pose, kind)
    assert np.abs(wrenches @ twists.T).max(initial=0.0) < 1e-12
    assert np.linalg.matrix_rank(wrenches, tol=1e-9) == len(wrenches)
    assert np.linalg.matrix_rank(twists, tol=1e-9) == len(twists)
    assert len(wrenches) + len(twists) == 6


def _screws(c: Any) -> NDArray[np.bool_]:
    """Rows of screws: where the thread begins is free."""
    mask = np.zeros(c.layout.constraints.count, bool)
    for f in c.layout.constraints.families:
        if type(f).__name__ == "Helix":
            mask[f.row] = True
    return mask


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("kind", "keys"), CASES)
def test_reactions_lie_in_the_joints_axes(kind: str, keys: dict[str, str], seed: int) -> None:
    rng = np.random.default_rng(100 + seed)
    m = body_on(kind, rng, **keys)
    c, pose = placed(m, rng)
    g, joint = c.layout.algebra, m.joints["P"]
    rows = system(g, c.layout.constraints, pose).on_j[0]
    arm = g.rotate(pose.rotation[0, 0], c.geometries[0].uj)
    force, moment = rows[:, :3], rows[:, 3:] - np.cross(arm, rows[:, :3])
    pair = joint.pair
    blocked = [AXES.index(a) for a in pair.forces], [AXES.index(a) for a in pair.moments]
    for part, carried, of_moment in zip((force, moment), blocked, (False, True), strict=True):
        axes = local_axes(joint, c.geometries[0], pose.rotation[0, 1], pose.rotation[0, 0], of_moment)
        assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)
        assert np.linalg.det(axes) == pytest.approx(1.0)
        inside = part @ axes.T
        others = [k for k in range(3) if k not in carried]
        if kind == "screw":  # the one along the axis brings a moment along it
            others = [k for k in others if k != 0]
        assert np.abs(inside[:, others]).max(initial=0.0) < 1e-12


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("kind", "keys"), [case for case in CASES if case.values[0] != "weld"])
def test_rows_are_the_derivatives_of_their_measures(kind: str, keys: dict[str, str], seed: int) -> None:
    """Against central differences along motions that the joint allows: rates, and drift as the second derivative."""
    rng = np.random.default_rng(200 + seed)
    c, pose = placed(body_on(kind, rng, **keys), rng)
    g, step = c.layout.algebra, 1e-4
    twists = allowed(c, pose, kind)
    twist = rng.normal(size=len(twists)) @ twists
    whole = np.zeros((1, 2, 6))
    whole[0, 0] = twist
    for rows in (c.layout.constraints, c.layout.freedoms):
        there = [measure(g, rows, moved(pose, twist, sign * step))[0] for sign in (-1, 0, 1)]
        at = system(g, rows, pose).on_j[0] @ twist
        assert (there[2] - there[0]) / (2 * step) == pytest.approx(
            _swapped(rows, at, c, pose, twist), abs=1e-6
        )
        second = (there[2] - 2 * there[1] + there[0]) / step**2
        assert second == pytest.approx(drift(g, rows, pose, whole)[0], abs=1e-6)


def _swapped(rows: Any, at: Array, c: Any, pose: Any, twist: Array) -> Array:
    """Rates of rows whose j is the ground are told by their wrench on i."""
    on_i = system(c.layout.algebra, rows, pose).on_i[0] @ twist
    return np.where(rows.ends[1] == 1, on_i, at)


@pytest.mark.parametrize("place", [1, 2])
@pytest.mark.parametrize("other", [[1.0, 2.0, 3.0], [0.0, 0.6, 0.8], [0.0, -0.6, -0.8 + 1e-6]])
def test_axes_of_a_pin_are_square_whatever_the_other_pin(place: int, other: list[float]) -> None:
    """Also where the other pin is in line with it, so that any direction across will do."""
    pin, unit = np.array([0.0, 0.6, 0.8]), np.array(other) / np.linalg.norm(other)
    axes = _with_pin(pin, place, unit)
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1)
    assert axes[place] == pytest.approx(pin)
    assert axes[0] @ unit == pytest.approx(0, abs=1e-5)
