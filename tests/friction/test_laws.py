"""Laws of friction on random mechanisms with coefficients up to 0.6, and the energy of whole cycles."""

from __future__ import annotations

from copy import deepcopy
from functools import cache, lru_cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.friction.fixed_point import contacts_at
from dalembert.core.friction.friction_solver import solve_friction
from tests.friction.oracle import branch, compared
from tests.friction.rough import CYCLES, cycle, rough, rough_tree, still_tree, unlawful
from tests.laws.measures import joint_wrenches, known_wrenches
from tests.oracles.reading import machine
from tests.random_mechanisms import Rigid, pose_array, random_mechanism
from tests.tiers import nth, over

SOLVED = ("ok", "self_locking")
OFF = {"enabled": False, "coefficient": 0.1}
VERDICTS = (*SOLVED, "jammed", "at_rest", "not_assembled", "singular", "redundant")


def solved(r: Any) -> Any:
    return np.array([s in SOLVED for s in r.status])


@lru_cache(maxsize=64)
def answered(seed: int) -> Any:
    return da.dynamics(rough(seed))


@cache
def rubs(seed: int) -> bool:
    """There is friction, a drive, and a number at some position."""
    r = answered(seed)
    return r.friction is not None and bool(r.drives) and bool(solved(r).any())


@cache
def rubs_throughout(seed: int) -> bool:
    """There is friction, and a number at every position."""
    return rubs(seed) and bool(solved(answered(seed)).all())


@cache
def begins(seed: int) -> bool:
    """There is friction, and at the first position a number or a jam."""
    r = answered(seed)
    return r.friction is not None and r.status[0] in (*SOLVED, "jammed")


@cache
def rests(seed: int) -> bool:
    """Without speed friction holds it, within bounds."""
    r = da.statics(da.mechanism(still_tree(seed, 0.4)))
    return r.status == ("at_rest",) and all(np.isfinite(r.holding(d)).all() for d in r.drives)


@over(8, 1000)
def test_solved_or_a_verdict_and_no_wrong_number(seed: int) -> None:
    """Links balance, every contact obeys its law; what is not solved has no number, and a sentence."""
    r = answered(seed)
    assert set(r.status) <= set(VERDICTS)
    good = solved(r)
    if good.any() and r.friction is not None:
        assert np.max(unlawful(r)[good]) < 1e-9
        assert np.max(r.residual[good]) < 1e-9
        assert np.max(r.power_balance[good]) < 1e-9
        assert all(np.min(r.power_lost(j)[good]) > -1e-9 * scale(r) for j in r.joints)
    for k in np.flatnonzero(~good):
        assert r.reasons[k]
        if r.status[k] != "redundant" and r.drives:
            assert np.isnan([r.effort(d)[k] for d in r.drives]).all()


def scale(r: Any) -> float:
    """Largest force times the fastest relative rate."""
    return float(np.nanmax(np.abs(r.force_array)) * np.nanmax(np.abs(r.twist_array)) + 1e-300)


@over(8, 200)
def test_virtual_work_with_the_losses_of_friction(seed: int) -> None:
    r = answered(nth(seed, rubs))
    assert np.max(da.virtual_work(r).gap[solved(r)]) < 1e-10


@over(6, 200)
def test_links_balance(seed: int) -> None:
    seed = nth(seed, rubs_throughout)
    tree, r = rough_tree(seed), answered(seed)
    for joint in tree["joints"].values():
        joint.pop("damping", None)  # a reaction with friction has the viscous part in it
    answer: Any = SimpleNamespace(machine=machine(tree))
    out = (joint_wrenches(r, answer) + known_wrenches(r, answer))[:, 1:]
    assert np.max(np.abs(out)) < 1e-9 * np.max(np.abs(r.force_array)) * max(
        1.0, np.max(np.abs(r.point_array))
    )


@over(3, 200)
def test_the_oracle_follows_the_same_branch(seed: int) -> None:
    seed = nth(seed, begins)
    tree, drawing = rough_tree(seed), random_mechanism(seed, (2, 12))
    r, found = answered(seed), branch(tree, pose_array(drawing))
    if r.status[0] == "jammed":
        assert found.scale == pytest.approx(r.friction.critical[0], abs=2e-5)
    else:
        assert found.scale == 1
        assert compared(r, found, machine(tree)) < 1e-9


@over(6, 100)
def test_a_batch_is_a_loop(seed: int) -> None:
    """Each position with the first one alone, which sets the phase of meshes."""
    seed = nth(seed, rubs)
    whole = answered(seed)
    assert len(whole.status) > 1
    for k in range(1, len(whole.status)):
        tree = rough_tree(seed)
        for drive in tree["drives"].values():
            drive["position"] = [drive["position"][0], drive["position"][k]]
        two = da.dynamics(da.mechanism(tree))
        assert two.status == (whole.status[0], whole.status[k])
        close = {"rtol": 1e-8, "atol": 1e-9 * finite_forces(whole), "equal_nan": True}
        assert all(np.allclose(two.reaction(j)[1], whole.reaction(j)[k], **close) for j in whole.joints)


@over(6, 100)
def test_reversing_the_motion_reverses_the_senses(seed: int) -> None:
    seed = nth(seed, rubs)
    r, tree = da.statics(rough(seed)), rough_tree(seed)
    for drive in tree["drives"].values():
        turns = isinstance(drive["speed"], str)
        value = -float(str(drive["speed"]).split()[0])
        drive["speed"] = f"{value!r} rad/s" if turns else value
    back = da.statics(da.mechanism(tree))
    told = ~r.friction.open & ~r.compiled.contacts.fixed
    assert (r.friction.sense[told] != 0).any()
    assert np.array_equal(back.friction.sense[told], -r.friction.sense[told], equal_nan=True)


@over(6, 200)
def test_no_coefficient_is_no_friction(seed: int) -> None:
    tree = rough_tree(nth(seed, rubs), most=0.0)
    r, plain = da.dynamics(da.mechanism(tree)), da.dynamics(da.mechanism({**tree, "friction": OFF}))
    assert plain.friction is None
    for name in r.drives:
        good = solved(r)
        assert good.any()
        assert np.allclose(
            r.effort(name)[good], plain.effort(name)[good], rtol=1e-9, atol=1e-9 * forces(plain)
        )


@over(4, 200)
def test_small_coefficients_go_to_no_friction(seed: int) -> None:
    """The change of the efforts is linear in a small coefficient: halving it halves the change."""
    _, changes = small_changes(nth(seed, small_coefficients_show))
    assert np.max(np.abs(changes[0] - 2 * changes[1])) < 0.02 * np.max(np.abs(changes[0]))


@cache
def small_coefficients_show(seed: int) -> bool:
    """A small coefficient changes the efforts by more than rounding does."""
    if not rubs(seed):
        return False
    plain, changes = small_changes(seed)
    return bool(changes[0].size and np.max(np.abs(changes[0])) > 1e-8 * forces(plain))


@lru_cache(maxsize=8)
def small_changes(seed: int) -> tuple[Any, list[Any]]:
    """The result without friction, and what coefficients of 1e-4 and half that change in the efforts."""
    changes = []
    plain = da.dynamics(da.mechanism({**rough_tree(seed), "friction": OFF}))
    for part in (1e-4, 5e-5):
        tree = rough_tree(seed)
        for joint in tree["joints"].values():
            if "friction" in joint:
                joint["friction"]["coefficient"] = part * joint["friction"].get("coefficient", 0.3)
        r = da.dynamics(da.mechanism(tree))
        good = solved(r)
        changes.append(np.array([r.effort(d)[good] - plain.effort(d)[good] for d in r.drives]))
    return plain, changes


def forces(r: Any) -> float:
    """Largest force times (at least one) metre."""
    return float(np.nanmax(np.abs(r.force_array))) * max(1.0, r.compiled.layout.length)


@over(6, 200)
def test_scaling_all_loads_scales_everything(seed: int) -> None:
    k, seed = 3.7, nth(seed, rubs)
    tree = rough_tree(seed)
    r, larger = answered(seed), da.dynamics(da.mechanism(_scaled(tree, k)))
    assert larger.status == r.status
    close = {"rtol": 1e-8, "atol": 1e-8 * finite_forces(r), "equal_nan": True}
    for joint in r.joints:
        assert np.allclose(larger.reaction(joint), k * r.reaction(joint), **close)
    for drive in r.drives:
        assert np.allclose(larger.effort(drive), k * r.effort(drive), **close)


def finite_forces(r: Any) -> float:
    return forces(r) if np.isfinite(r.force_array).any() else 1.0


def _scaled(tree: dict[str, Any], k: float) -> dict[str, Any]:
    """All masses, loads, stiffnesses and dampings times k."""
    out = deepcopy(tree)
    for link in out["links"].values():
        for key in ("mass", "inertia"):
            if key in link:
                link[key] *= k
    for part in (*out["loads"].values(), *out["joints"].values()):
        for key in ("value", "stiffness", "damping", "force"):
            if key in part:
                part[key] = _times(part[key], k)
    return out


def _times(value: Any, k: float) -> Any:
    if isinstance(value, dict):
        return {key: _times(v, k) for key, v in value.items()}
    if isinstance(value, list):
        return [k * v for v in value]
    if isinstance(value, str):
        number, unit = value.split()
        return f"{float(number) * k!r} {unit}"
    return k * value


@over(6, 100)
def test_moving_the_machine_turns_the_forces(seed: int) -> None:
    motion, seed = Rigid(1.1, 300.0, -200.0), nth(seed, rubs)
    r, moved = answered(seed), da.dynamics(da.mechanism(rough_tree(seed, motion=motion)))
    assert moved.status == r.status
    c, s = np.cos(motion.turn), np.sin(motion.turn)
    for joint in r.joints:
        force = r.reaction(joint)
        turned = np.stack([c * force[:, 0] - s * force[:, 1], s * force[:, 0] + c * force[:, 1]], -1)
        assert np.allclose(
            moved.reaction(joint), turned, rtol=1e-7, atol=1e-8 * finite_forces(r), equal_nan=True
        )


@over(6, 60)
def test_no_friction_within_its_limits_leaves_what_holds(seed: int) -> None:
    """At rest, with friction anywhere within its limits in every joint, no effort is beyond what is said to hold."""
    r = da.statics(da.mechanism(still_tree(nth(seed, rests), 0.4)))
    contacts, problem, told = contacts_at(r, 0)
    rng, count = np.random.default_rng(seed), 100
    part = rng.uniform(-1, 1, (count, contacts.count))
    part[: count // 2] = np.sign(part[: count // 2])
    part = np.where(contacts.fixed, -1.0, part[:, contacts.leader])
    x = solve_friction(
        contacts, problem, told._replace(sense=part, open=np.broadcast_to(told.open, part.shape))
    ).x
    x = x[np.isfinite(x).all(axis=1)]
    assert len(x) >= 10
    first = r.compiled.layout.constraints.count
    for k, drive in enumerate(r.drives):
        low, high = r.holding(drive)[0]
        room = 1e-9 * (np.abs(x[:, first + k]).max() + forces(r.ends[0][0]))
        assert low - room <= np.min(x[:, first + k])
        assert np.max(x[:, first + k]) <= high + room


@pytest.mark.parametrize("template", CYCLES.split())
def test_energy_of_a_whole_cycle(template: str) -> None:
    """Input power = power against the loads + losses of the joints + change of kinetic energy, and over the cycle."""
    r = da.dynamics(cycle(template))
    good = solved(r)
    assert good.all(), r.problems()
    given = sum(r.effort(d) * r.drive_speed(d) for d in r.drives) + load_power(r)
    lost = sum(r.power_lost(j) for j in r.joints)
    largest = np.max(np.abs(given)) + np.max(np.abs(lost))
    assert np.min(lost) > 0
    assert np.max(np.abs(given - lost - kinetic_rate(r))) < 1e-9 * largest
    assert abs(np.sum(given - lost - kinetic_rate(r))) < 1e-9 * largest * len(good)


def load_power(r: Any) -> Any:
    """Power of forces, couples and weights on the links."""
    m, power = r.mechanism, np.zeros(len(r.status))
    drives = {d: r.drive_position(d) for d in r.drives}
    for load in m.loads.values():
        if load.type == "couple":
            value = load.value.at(drives) if hasattr(load.value, "at") else load.value
            power = power + value * r.speed(load.on)
            continue
        assert load.type == "force"
        fx, fy = load.force(drives)
        force = np.stack(np.broadcast_arrays(fx * np.ones(len(power)), fy * np.ones(len(power))), -1)
        if load.axes == "link":
            c, s = np.cos(r.angle(load.on)), np.sin(r.angle(load.on))
            force = np.stack([c * force[:, 0] - s * force[:, 1], s * force[:, 0] + c * force[:, 1]], -1)
        power = power + (force * r.point_velocity(load.on, load.at)).sum(-1)
    for link in r.links:
        power = power + m.mass(link) * (r.center_velocity(link) * np.array(m.gravity_vector)).sum(-1)
    return power


def kinetic_rate(r: Any) -> Any:
    """Rate of kinetic energy: m v . a + I omega alpha, over all links."""
    m = r.mechanism
    return sum(
        m.mass(k) * (r.center_velocity(k) * r.center_acceleration(k)).sum(-1)
        + m.inertia(k) * r.speed(k) * r.acceleration(k)
        for k in r.links
    )
