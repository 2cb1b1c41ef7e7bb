"""Drift of every kind of row: the rate of its velocity J v where both links keep their twists, by differences.

Links, arms, axes and twists are random and nothing closes, so that no term vanishes; centres of wheels move too.
"""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np
import pytest

from dalembert.algebra import plane, space
from dalembert.arrays import Array
from dalembert.core import layout as rows
from dalembert.core.constraints import drift, measure, rates, system
from dalembert.core.layout import Pose, Rows

STEP, COUNT = 1e-4, 5


def unit(rng: np.random.Generator, d: int) -> Array:
    v = rng.normal(size=(COUNT, d))
    return np.asarray(v / np.linalg.norm(v, axis=1, keepdims=True))


def family(kind: type, rng: np.random.Generator) -> Any:
    """Rows of one kind between links 0 and 1; spins that are set to none are told from ground, link 2."""
    d = 2 if kind in (rows.Along, rows.Mesh, rows.Turn, rows.Meet, rows.Distance) else 3
    size, a = rng.uniform(0.3, 1, (6, COUNT)), unit(rng, d)
    across = np.cross(a, unit(rng, 3)) if d == 3 else a
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    single = np.arange(COUNT)
    values = {
        "row": np.arange(COUNT * d).reshape(COUNT, d) if kind is rows.Meet else single,
        "i": np.full(COUNT, 2 if kind is rows.Idle else 0),
        "j": np.full(COUNT, 1),
        **{name: rng.normal(size=(COUNT, d)) for name in ("ui", "uj")},
        "axis": a,
        "a": a,
        "b": across,
        "p": unit(rng, d),
        "ai": a,
        "aj": unit(rng, d),
        "bi": across,
        "bj": unit(rng, d),
        "ri": size[0],
        "rj": -size[1],
        "pitch": size[2],
        "helix": size[3] - 0.5,
        "ki": size[4],
        "kj": size[5],
        "outward": np.ones(COUNT),
        "direction": np.eye(3)[single % 3],
        "cone": unit(rng, 2),
        "stands": np.zeros(COUNT),
        "drawn": np.tile(space.IDENTITY, (COUNT, 1)),
        "count": np.arange(2 * COUNT).reshape(COUNT, 2) if kind is rows.Gearing else single,
    }
    return kind(**{name: values[name] for name in (f.name for f in fields(kind))})


KINDS = {
    plane: (rows.Meet, rows.Along, rows.Turn, rows.Mesh, rows.Distance),
    space: (rows.Perpendicular, rows.Angle, rows.Helix, rows.Idle, rows.Gearing),
}


@pytest.mark.parametrize(("g", "kind"), [(g, kind) for g, kinds in KINDS.items() for kind in kinds])
def test_the_drift_is_the_rate_of_the_velocity_at_constant_twists(g: Any, kind: type) -> None:
    rng = np.random.default_rng(3)
    f = family(kind, rng)
    count = f.row.size
    made = Rows(count, 2, (f,), np.zeros(count, np.intp), np.zeros(count, bool))
    point, start, twist = (
        rng.normal(size=(3, g.d)),
        rng.normal(size=(3, g.n - g.d)),
        rng.normal(size=(3, g.n)),
    )
    twist[2] = 0.0

    def pose(time: float) -> Pose:
        w = twist[:, g.d :]
        if g is plane:
            turn = (start + w * time)[:, 0]
            return Pose(point + twist[:, : g.d] * time, turn, plane.rotation(turn))
        turned = space.compose(space.exp(w * time), space.exp(start))
        return Pose(point + twist[:, : g.d] * time, np.zeros(2 * COUNT), turned)

    def velocity(time: float) -> Array:
        return rates(system(g, made, pose(time)), twist)

    found = drift(g, made, pose(0.0), twist)
    wanted = (velocity(STEP) - velocity(-STEP)) / (2 * STEP)
    np.testing.assert_allclose(found, wanted, atol=1e-5, rtol=1e-5)
    if kind not in (
        rows.Idle,
        rows.Gearing,
    ):  # measures of the others have the velocity J v wherever they stand
        change = (measure(g, made, pose(STEP)) - measure(g, made, pose(-STEP))) / (2 * STEP)
        np.testing.assert_allclose(velocity(0.0), change, atol=1e-5, rtol=1e-5)
    assert (np.abs(wanted).max() > 0.1) == (kind not in (rows.Turn, rows.Idle))
