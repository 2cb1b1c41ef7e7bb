"""The laws of friction on random mechanisms in space with coefficients up to 0.6."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
import pytest

import dalembert as da
from tests.oracles.reading import Array
from tests.random_space import IN_LBF, MM_N, Options, Rigid, exchangeable, tree
from tests.random_space.drawing import about
from tests.space.free_bodies import Balance
from tests.space.rough import SOLVED, across_line, drawing, friction_laws, rough, roughened, solved
from tests.space.screw_motion import seen
from tests.tiers import nth, over_seeds

TOLERANCE = 1e-9
VERDICTS = (*SOLVED, "jammed", "at_rest", "no_balance")
QUICK = (39, 58, 45, 54, 42, 50)
"""Seeds with all kinds of joints, rods, a lock, a jam and joints at rest."""


def over(quick: int) -> Callable[..., Any]:
    """A law on some of the quick seeds, one test each, and on 200."""
    return over_seeds(QUICK[:quick], range(200))


@lru_cache(maxsize=64)
def answered(seed: int) -> Any:
    return da.dynamics(rough(seed))


@lru_cache(maxsize=64)
def still(seed: int) -> Any:
    return da.statics(rough(seed))


def largest(r: Any) -> float:
    """Largest reaction, effort or load; 1 m is the length of all these machines."""
    parts = [r.force_array, r.moment_array, *(r.effort(d) for d in r.drives)]
    found = [np.nanmax(np.abs(a), initial=0.0) for a in parts]
    return float(max(found)) or 1.0


def close(r: Any, other: Any, factor: float = 1.0, turn: Array | None = None, within: float = 1e-8) -> None:
    """The same verdicts; reactions turned, all times a factor."""
    assert other.status == r.status
    turn = np.eye(3) if turn is None else turn
    room = {"rtol": 0, "atol": within * factor * largest(r), "equal_nan": True}
    for joint in r.joints:
        assert np.allclose(other.reaction(joint), factor * r.reaction(joint) @ turn.T, **room), joint
        assert np.allclose(other.reaction_moment(joint), factor * r.reaction_moment(joint) @ turn.T, **room)
    for drive in r.drives:
        assert np.allclose(other.effort(drive), factor * r.effort(drive), **room), drive


@over(6)
def test_solved_or_a_verdict_and_no_wrong_number(seed: int) -> None:
    """Every link balances, no loss is negative, the power that goes in is lost; else no number, and a sentence."""
    r, d = answered(seed), drawing(seed)
    assert set(r.status) <= set(VERDICTS)
    good = solved(r)
    for k in np.flatnonzero(~good):
        assert r.reasons[k]
        assert np.isnan([r.effort(name)[k] for name in r.drives]).all()
    if good.any():
        check_numbers(r, d, good)


def check_numbers(r: Any, d: Any, good: Array) -> None:
    b = Balance(r, d, seen(r, d))
    room = (
        TOLERANCE * max(b.scale if good.all() else 0.0, largest(r)) * max(np.nanmax(np.abs(b.s.twist)), 1.0)
    )
    assert np.max(np.abs(b.out[good])) < room
    lost = {name: r.power_lost(name) for name in r.joints}
    assert all(np.min(p[good]) > -room for p in lost.values())
    assert np.max(np.abs(b.power() - sum(lost.values()))[good]) < room
    assert np.max(r.residual[good]) < TOLERANCE
    assert np.max(r.power_balance[good]) < TOLERANCE
    assert np.max(da.virtual_work(r).gap[good]) < TOLERANCE


@lru_cache(maxsize=512)
def rubs(seed: int) -> bool:
    """It has friction, and numbers at some position."""
    r = answered(seed)
    return r.friction is not None and bool(solved(r).any())


@over_seeds([seed for seed in QUICK if seed not in (42, 50)], range(150))
def test_friction_is_mu_times_what_bears_against_the_slip(seed: int) -> None:
    seed = seed if seed in QUICK and rubs(seed) else nth(seed, rubs)
    r, d = answered(seed), drawing(seed)
    good, s = solved(r), seen(r, d)
    b = Balance(r, d, s)
    for name, law in friction_laws(r, d, s).items():
        found = np.concatenate([r.friction_force(name), r.friction_moment(name)], -1)
        j = d.joints[name]
        rod = next((link for link in (j.i, j.j) if link in d.rods), None)
        if rod is not None and law.any():
            size = [np.linalg.norm(w[good, 3:], axis=-1) for w in (found, law)]
            assert np.max(np.abs(size[0] - size[1])) < TOLERANCE * largest(r)
            parts = [across_line(b.at, rod, w[:, 3:])[good] for w in (found, law)]
            assert np.min(np.sum(parts[0] * parts[1], -1)) >= 0
            assert np.max(np.abs(np.cross(*parts))) < TOLERANCE * largest(r) ** 2
        else:
            assert np.max(np.abs(found - law)[good]) < TOLERANCE * largest(r), name


@over(2)
@pytest.mark.parametrize("factor", [1e-5, 3.7])
def test_scaling_all_loads_scales_everything(seed: int, factor: float) -> None:
    close(still(seed), da.statics(rough(seed, Options(loads=factor))), factor)


@over(2)
def test_moving_the_machine_turns_the_answers(seed: int) -> None:
    motion = Rigid(about(np.array([1.0, 2.0, -0.5]), 0.7), np.array([30.0, -20.0, 1.0]))
    close(answered(seed), da.dynamics(rough(seed, Options(motion=motion))), turn=motion.turn)


@over(1)
@pytest.mark.parametrize("style", [MM_N, IN_LBF], ids=["mm N", "in lbf"])
def test_units_change_nothing(seed: int, style: Any) -> None:
    close(answered(seed), da.dynamics(rough(seed, Options(style=style))))


@over(1)
def test_the_order_of_links_and_joints_changes_nothing(seed: int) -> None:
    close(answered(seed), da.dynamics(rough(seed, Options(order=seed))))


@over(1)
def test_exchanging_i_and_j_only_flips_signs(seed: int) -> None:
    """Guides apart, whose ends are told from a point of j."""
    swapped = exchangeable(drawing(seed))
    r = da.dynamics(rough(seed, plain=True))
    other = da.dynamics(rough(seed, Options(exchange=swapped), plain=True))
    assert other.status == r.status
    room = {"rtol": 0, "atol": 1e-8 * largest(r), "equal_nan": True}
    for name, j in drawing(seed).joints.items():
        assert np.allclose(other.reaction(name, on=j.j), r.reaction(name, on=j.j), **room)
        assert np.allclose(other.power_lost(name), r.power_lost(name), **room)


@over(1)
def test_a_batch_is_its_positions_one_by_one(seed: int) -> None:
    """The last position after the first alone."""
    whole, made = answered(seed), tree(drawing(seed))
    for drive in made["drives"].values():
        drive["position"] = drive["position"][::2]
    two = da.dynamics(da.mechanism(roughened(made, seed)))
    assert two.status == whole.status[::2]
    room = {"rtol": 0, "atol": 1e-8 * largest(whole), "equal_nan": True}
    for joint in whole.joints:
        assert np.allclose(two.reaction(joint), whole.reaction(joint)[::2], **room)


@over(2)
def test_no_coefficient_is_no_friction(seed: int) -> None:
    made = tree(drawing(seed))
    free = da.dynamics(da.mechanism(made))
    none = da.dynamics(rough(seed, most=0.0))
    for drive in free.drives:
        good = solved(none)
        assert np.allclose(
            none.effort(drive)[good], free.effort(drive)[good], rtol=0, atol=1e-10 * largest(free)
        )


@over_seeds(range(2), range(20))
def test_small_coefficients_go_to_no_friction(seed: int) -> None:
    """The change of the efforts is linear in a small coefficient: halving it halves the change."""
    _, changes = small_changes(nth(seed, small_coefficients_show))
    assert np.max(np.abs(changes[0] - 2 * changes[1])) < 0.02 * np.max(np.abs(changes[0]))


@lru_cache(maxsize=64)
def small_changes(seed: int) -> tuple[Any, list[Any]]:
    """The result without friction, and what coefficients up to 2e-4 and half of them change in the efforts."""
    free, changes = da.dynamics(da.mechanism(tree(drawing(seed)))), []
    for most in (2e-4, 1e-4):
        r = da.dynamics(rough(seed, most=most))
        changes.append(np.array([r.effort(d) - free.effort(d) for d in r.drives])[:, solved(r)])
    return free, changes


def small_coefficients_show(seed: int) -> bool:
    free, changes = small_changes(seed)
    return bool(changes[0].size and np.max(np.abs(changes[0])) > 1e-8 * largest(free))


@over_seeds(range(2), range(100))
def test_reversing_the_motion_reverses_friction_s_senses(seed: int) -> None:
    """Raising and lowering the same load: no friction lies between them."""
    seed = nth(seed, slips)
    r, back = still(seed), da.statics(rough(seed, Options(speeds=-1.0)))
    told = senses_of_motion(r) & np.isfinite(back.friction.sense)
    assert told.any()
    assert np.allclose(back.friction.sense[told], -r.friction.sense[told], rtol=0, atol=1e-9)


def senses_of_motion(r: Any) -> Any:
    """Where a contact slips; the spin of a rod may follow the loads."""
    return ~r.friction.open & ~r.compiled.contacts.ball & np.isfinite(r.friction.sense)


def slips(seed: int) -> bool:
    r = still(seed)
    return r.friction is not None and bool(senses_of_motion(r).any())


def test_the_drawings_have_everything() -> None:
    """All joints with friction, rods, jams and locks come up."""
    kinds = {k for seed in QUICK for k in answered(seed).compiled.contacts.kind}
    assert kinds == {"pin", "collar", "guide", "ball", "thread"}
    assert any(len(drawing(seed).rods) > 1 for seed in QUICK)
    assert {s for seed in QUICK for s in answered(seed).status} >= {"ok", "jammed", "self_locking", "at_rest"}
