"""Random mechanisms of all pairs in one and two loops, with springs, dampers and loads, against natural coordinates."""

from __future__ import annotations

import numpy as np
import pytest

import dalembert as da
from tests.oracles.reading import Array
from tests.oracles.space import natural, random_drawn
from tests.oracles.space.agreement import gap
from tests.tiers import tiers

TOLERANCE = 1e-11


@pytest.mark.parametrize("seed", tiers(range(10), range(10, 50), range(50, 500)))
def test_every_number_is_that_of_natural_coordinates(seed: int) -> None:
    tree, m, path = random_drawn.mechanism(seed)
    for dynamic, analysis in ((True, da.dynamics), (False, da.statics)):
        r = analysis(da.mechanism(tree))
        assert set(r.status) == {"ok"}, r.problems()
        found = disagreement(r, m, natural.solve(m, path, dynamic))
        worst = max(found, key=lambda key: np.nan_to_num(found[key], nan=np.inf))
        assert found[worst] < TOLERANCE, worst


@pytest.mark.parametrize("seed", tiers(range(5), range(5, 12)))
def test_doubled_joint_is_named_and_only_its_own_reactions_are_left_open(seed: int) -> None:
    """A joint beside its like: what both carry together is shared in no definite way, all else is as before."""
    tree, _, path = random_drawn.mechanism(seed)
    name, joint = next(iter(tree["joints"].items()))
    tree["joints"]["again"] = {**joint, "at": name}
    m = natural.Machine(tree)
    r = da.dynamics(da.mechanism(tree))
    assert set(r.status) == {"redundant"}, r.problems()
    assert r.mobility is not None
    assert r.mobility.redundant == 6 - random_drawn.FREEDOMS[joint["type"]]
    assert set(r.mobility.redundant_joints) == {name, "again"}
    expected = natural.solve(m, path)
    largest = max(size(f) for f in (*expected.forces.values(), *expected.moments.values()))
    for drive, effort in expected.efforts.items():
        assert gap(r.effort(drive), effort, largest) < TOLERANCE
    for other, mask in natural.unique(m, path).items():
        np.testing.assert_array_equal(r.unique(other), mask, err_msg=other)
        both = np.concatenate([expected.forces[other], expected.moments[other]], -1)
        found = np.concatenate([r.reaction(other), r.reaction_moment(other)], -1)
        np.testing.assert_allclose(found[mask], both[mask], rtol=0, atol=TOLERANCE * largest, err_msg=other)
        assert np.isnan(found[~mask]).all()


def disagreement(r: da.Result, m: natural.Machine, expected: natural.Natural) -> dict[str, float]:
    """Largest differences; lengths are of the order of 1, forces and moments over the largest force."""
    largest = max(float(np.max(np.abs(f))) for f in (*expected.forces.values(), *expected.moments.values()))
    out = {}
    for name, force in expected.forces.items():
        out[f"reaction {name}"] = gap(r.reaction(name), force, largest)
        out[f"moment {name}"] = gap(r.reaction_moment(name), expected.moments[name], largest)
    for name, effort in expected.efforts.items():
        out[f"effort {name}"] = gap(r.effort(name), effort, largest)
    for k, link in enumerate(m.links[1:], 1):
        part = slice(4 * k + 1, 4 * k + 4)
        out[f"position {link}"] = gap(r.position(link), expected.q[:, 4 * k], 1.0)
        out[f"rotation {link}"] = gap(r.rotation(link), np.swapaxes(expected.q[:, part], 1, 2), 1.0)
        out[f"velocity {link}"] = gap(r.velocity(link), expected.v[:, 4 * k], size(expected.v))
        out[f"speed {link}"] = gap(
            np.cross(r.speed(link)[:, None], expected.q[:, part]), expected.v[:, part], size(expected.v)
        )
    return out


def size(rates: Array) -> float:
    return float(np.max(np.abs(rates)))
