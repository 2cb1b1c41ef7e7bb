"""Classic overconstrained linkages: mobility and redundancy as in the literature, efforts and unique components."""

from __future__ import annotations

import numpy as np
import pytest

import dalembert as da
from tests.oracles.space import natural
from tests.oracles.space.classics import CLASSICS
from tests.oracles.space.compliance import shared
from tests.tiers import tiers

STEPS = 3
DRIVEN = [name for name, classic in CLASSICS.items() if classic.drives]


@pytest.mark.parametrize("name", CLASSICS)
def test_mobility_is_the_published_one_along_the_motion(name: str) -> None:
    classic = CLASSICS[name]
    r = da.kinematics(da.mechanism(classic.tree(STEPS if classic.drives else 1)))
    assert r.mobility is not None
    assert (r.mobility.freedoms, r.mobility.redundant) == (classic.freedoms, classic.redundant)
    assert r.mobility.drives == len(classic.drives)
    assert set(r.status) <= {"ok", "redundant"}, r.problems()
    assert np.isfinite(r.position(classic.links[-1])).all()


@pytest.mark.parametrize("name", tiers(DRIVEN[::2], DRIVEN[1::2]))
def test_motion_efforts_and_unique_components_are_those_of_natural_coordinates(name: str) -> None:
    classic = CLASSICS[name]
    tree = classic.tree(STEPS)
    r = da.dynamics(da.mechanism(tree))
    m, path, _ = natural.followed(tree)
    expected = natural.solve(m, path)
    for link in classic.links[1:]:
        k = 4 * m.links.index(link)
        np.testing.assert_allclose(r.position(link), expected.q[:, k], atol=1e-12)
        np.testing.assert_allclose(
            r.rotation(link), np.swapaxes(expected.q[:, k + 1 : k + 4], 1, 2), atol=1e-12
        )
    forces = np.array(list(expected.forces.values()))
    largest = np.max(np.abs(forces))
    for drive, effort in expected.efforts.items():
        np.testing.assert_allclose(r.effort(drive), effort, rtol=0, atol=1e-10 * largest)
    for joint, mask in natural.unique(m, path).items():
        np.testing.assert_array_equal(r.unique(joint), mask, err_msg=joint)
        both = np.concatenate([expected.forces[joint], expected.moments[joint]], -1)
        found = np.concatenate([r.reaction(joint), r.reaction_moment(joint)], -1)
        np.testing.assert_allclose(found[mask], both[mask], rtol=0, atol=1e-10 * largest, err_msg=joint)
        assert np.isnan(found[~mask]).all()


WHOLE = ["Bennett 4R", "Goldberg 5R", "Myard 5R", "Bricard, line-symmetric 6R", "Bricard, plane-symmetric 6R",
         "Schatz 6R (Turbula)", "Waldron hybrid 6R", "parallelogram with a third crank", "Sarrus 6R"]  # fmt: skip


@pytest.mark.parametrize("name", WHOLE)
def test_every_constraint_closes_to_rounding_over_a_turn(name: str) -> None:
    """Fast passages too, where poses between two stations of the march are far from what is interpolated."""
    classic = CLASSICS[name]
    tree = classic.tree(2)
    drive = classic.drives[0]
    tree["drives"][drive]["position"] = {"from": "0 deg", "to": "360 deg", "count": 72}
    r = da.kinematics(da.mechanism(tree))
    m = natural.Machine(tree)
    q = np.tile(natural.drawn(m), (72, 1, 1))
    for link in classic.links[1:]:
        k = 4 * m.links.index(link)
        q[:, k], q[:, k + 1 : k + 4] = r.position(link), np.swapaxes(r.rotation(link), 1, 2)
    solved = np.isfinite(q).all((1, 2))
    assert solved.sum() >= 36
    phi, _, _, _ = natural.system(m.rows, q, 0 * q)
    assert np.max(np.abs(phi[solved])) < 1e-14


@pytest.mark.parametrize("name", tiers(DRIVEN[1::2], DRIVEN[::2]))
def test_stiffness_of_joints_shares_reactions_by_least_energy(name: str) -> None:
    tree = CLASSICS[name].tree(STEPS)
    m, path, _ = natural.followed(tree)
    rng = np.random.default_rng(8)
    stiffness = {joint: (rng.uniform(1e6, 5e6), rng.uniform(1e4, 5e4)) for joint in tree["joints"]}
    for joint, (force, moment) in stiffness.items():
        tree["joints"][joint]["stiffness"] = {"force": f"{force} N/m", "moment": f"{moment} N*m/rad"}
    r = da.dynamics(da.mechanism(tree))
    assert set(r.status) == {"ok"}, r.problems()
    expected = shared(m, natural.solve(m, path), stiffness)
    largest = max(float(np.max(np.abs(force))) for force, _ in expected.values())
    for joint, (force, moment) in expected.items():
        np.testing.assert_allclose(r.reaction(joint), force, rtol=0, atol=1e-10 * largest, err_msg=joint)
        np.testing.assert_allclose(
            r.reaction_moment(joint), moment, rtol=0, atol=1e-10 * largest, err_msg=joint
        )
