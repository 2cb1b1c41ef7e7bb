"""The laws of mechanics on random, well-conditioned mechanisms, to 1e-9 of the largest force (times length).

Each law runs on the first mechanisms by default, on 1,000 in all (`tests/tiers.py`).
"""

from __future__ import annotations

from copy import deepcopy
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
import pytest

import dalembert as da
from tests.laws.measures import (
    difference,
    joint_powers,
    joint_wrenches,
    known_wrenches,
    shifted_moment,
    smooth_teeth,
    speed_scale,
    spots,
    state,
)  # fmt: skip
from tests.oracles import lagrange
from tests.oracles.agreement import disagreement, worst
from tests.oracles.reading import machine
from tests.random_mechanisms import (
    IN_LBF,
    MM_N,
    Drawing,
    Rigid,
    Scale,
    Style,
    exchangeable,
    random_case,
    tree,
)  # fmt: skip
from tests.tiers import over

TOLERANCE = 1e-9


def dynamics(made: dict[str, Any]) -> Any:
    r = da.dynamics(da.mechanism(made))
    assert all(r.ok), r.problems()
    return r


def statics(made: dict[str, Any]) -> Any:
    r = da.statics(da.mechanism(made))
    assert all(r.ok), r.problems()
    return r


@lru_cache(maxsize=128)
def answered(seed: int) -> Any:
    return dynamics(random_case(seed).tree)


@over(10)
def test_every_number_is_that_of_the_lagrange_oracle(seed: int) -> None:
    quantity, size = worst(disagreement(answered(seed), random_case(seed).answer))
    assert size < TOLERANCE, quantity


@over(8)
def test_statics_is_that_of_the_lagrange_oracle(seed: int) -> None:
    case = random_case(seed)
    expected = lagrange.solve(case.tree, case.answer.q, inertia=False)
    quantity, size = worst(disagreement(statics(case.tree), expected))
    assert size < TOLERANCE, quantity


@over(8)
def test_every_link_is_in_equilibrium(seed: int) -> None:
    r, answer = answered(seed), random_case(seed).answer
    out_of_balance = (joint_wrenches(r, answer) + known_wrenches(r, answer))[:, 1:]
    length = answer.length()
    assert np.max(np.abs(out_of_balance / [1, 1, length])) < TOLERANCE * answer.force_scale()
    assert np.max(r.residual) < TOLERANCE


@over(8)
def test_power_of_efforts_loads_and_inertia_is_balanced(seed: int) -> None:
    r, answer = answered(seed), random_case(seed).answer
    v = state(r, answer.machine.links)[1]
    power = np.sum(known_wrenches(r, answer) * v, (1, 2))
    power += sum(r.effort(d.name) * d.speed for d in answer.machine.drives)
    assert np.max(np.abs(power)) < TOLERANCE * answer.force_scale() * speed_scale(answer)
    assert np.max(np.abs(r.power_balance)) < TOLERANCE


@over(8)
def test_reactions_do_no_work(seed: int) -> None:
    answer = random_case(seed).answer
    for joint, power in joint_powers(answered(seed), answer).items():
        assert np.max(np.abs(power)) < TOLERANCE * answer.force_scale() * speed_scale(answer), joint


@over(6)
@pytest.mark.parametrize("motion", [Rigid(0.7, 0.3, -2.0), Rigid(-2.9, 100.0, 350.0)])
def test_moving_the_machine_moves_the_answers(seed: int, motion: Rigid) -> None:
    d, r = random_case(seed).drawing, answered(seed)
    moved = dynamics(tree(d, motion=motion))
    force, length = random_case(seed).answer.force_scale(), random_case(seed).answer.length()
    for joint in d.joints:
        expected = np.stack(motion.vector(tuple(r.reaction(joint).T)), -1)
        assert np.max(np.abs(moved.reaction(joint) - expected)) < TOLERANCE * force
        assert (
            np.max(np.abs(moved.reaction_moment(joint) - r.reaction_moment(joint)))
            < TOLERANCE * force * length
        )
        in_link = r.reaction(joint, axes="link"), moved.reaction(joint, axes="link")
        if d.joints[joint].j != "ground":
            assert np.max(np.abs(in_link[0] - in_link[1])) < TOLERANCE * force
    for drive in d.drives:
        assert np.max(np.abs(moved.effort(drive) - r.effort(drive))) < TOLERANCE * force * max(length, 1.0)


@over(6)
@pytest.mark.parametrize("style", [MM_N, IN_LBF], ids=["mm N", "in lbf"])
def test_units_change_nothing(seed: int, style: Style) -> None:
    case = random_case(seed)
    same = dynamics(tree(case.drawing, style))
    assert difference(answered(seed), same, case.drawing, case.answer.length()) < TOLERANCE
    quantity, size = worst(disagreement(same, case.answer))
    assert size < TOLERANCE, quantity


@over(8)
def test_loads_add(seed: int) -> None:
    d = smooth_teeth(random_case(seed).drawing)
    names = sorted(d.loads)
    half = {k: d.loads[k] for k in names[::2]}
    rest = {k: d.loads[k] for k in names[1::2]}
    parts = [
        statics(tree(replace(d, loads=half, gravity=(0.0, 0.0), joints=undamped(d)))),
        statics(tree(replace(d, loads=rest))),
    ]
    whole = statics(tree(d))
    force = random_case(seed).answer.force_scale()
    for joint in d.joints:
        for question in ("reaction", "reaction_moment"):
            total = sum(getattr(p, question)(joint) for p in parts)
            assert np.max(np.abs(total - getattr(whole, question)(joint))) < TOLERANCE * force * 4


def undamped(d: Drawing) -> dict[str, Any]:
    return {k: replace(j, damping=0.0) for k, j in d.joints.items()}


@over(4)
@pytest.mark.parametrize("factor", [1e-6, 3.0, 1e8])
def test_all_forces_scale_together(seed: int, factor: float) -> None:
    case = random_case(seed)
    d = replace(case.drawing, joints=undamped(case.drawing))
    r, scaled = statics(tree(d)), statics(tree(d, scale=Scale(loads=factor, masses=factor)))
    force = case.answer.force_scale()
    for joint in d.joints:
        assert np.max(np.abs(scaled.reaction(joint) / factor - r.reaction(joint))) < TOLERANCE * force


@over(8)
def test_at_speed_0_dynamics_is_statics(seed: int) -> None:
    case = random_case(seed)
    still = tree(case.drawing, scale=Scale(speeds=0.0))
    assert difference(dynamics(still), statics(still), case.drawing, case.answer.length()) < TOLERANCE


@over(8)
def test_inertia_forces_grow_with_the_square_of_speed(seed: int) -> None:
    """What dynamics adds to statics, which keeps the viscous forces, is inertia alone."""
    d = smooth_teeth(random_case(seed).drawing)
    slow, fast = (
        [answer(tree(d, scale=Scale(speeds=s))) for answer in (dynamics, statics)] for s in (1.0, 3.0)
    )
    force = max(float(np.max(np.abs(fast[0].reaction(j)))) for j in d.joints)
    for joint in d.joints:
        added = [r.reaction(joint) - still.reaction(joint) for r, still in (slow, fast)]
        assert np.max(np.abs(9 * added[0] - added[1])) < TOLERANCE * force, joint


@over(8)
def test_exchanging_i_and_j_only_flips_signs(seed: int) -> None:
    case = random_case(seed)
    d, r, swapped = case.drawing, answered(seed), exchangeable(case.drawing)
    other = dynamics(tree(d, exchange=swapped))
    force, length = case.answer.force_scale(), case.answer.length()
    q = state(r, case.answer.machine.links)[0]
    here, there = spots(case.answer.machine, q), spots(machine(tree(d, exchange=swapped)), q)
    for name, joint in d.joints.items():
        sign = -1.0 if name in swapped else 1.0
        assert np.max(np.abs(sign * other.reaction(name) - r.reaction(name))) < TOLERANCE * force
        assert (
            np.max(np.abs(other.reaction(name, on=joint.i) + r.reaction(name, on=joint.j)))
            < TOLERANCE * force
        )
        moved = shifted_moment(r.reaction_moment(name), r.reaction(name), here[name], there[name])
        assert np.max(np.abs(sign * other.reaction_moment(name) - moved)) < TOLERANCE * force * length
    for name, drive in d.drives.items():
        sign = -1.0 if drive.joint in swapped else 1.0
        assert np.max(np.abs(sign * other.effort(name) - r.effort(name))) < TOLERANCE * force * max(
            length, 1.0
        )


@over(8)
def test_a_batch_is_its_positions_one_by_one(seed: int) -> None:
    case, r = random_case(seed), answered(seed)
    for k in range(len(r.status)):
        single = dynamics(at_position(case.tree, r, k))
        for joint in r.joints:
            gap = np.max(np.abs(single.reaction(joint)[0] - r.reaction(joint)[k]))
            assert gap < TOLERANCE * case.answer.force_scale(), (joint, k)


def at_position(made: dict[str, Any], r: Any, k: int) -> dict[str, Any]:
    """The tree with position k alone, assembled as the batch found it."""
    made = deepcopy(made)
    for drive in made["drives"].values():
        drive["position"] = drive["position"][k]
    made["assembly"] = {n: [*r.position(n)[k].tolist(), float(np.degrees(r.angle(n)[k]))] for n in r.links}
    return made


FIRST = np.array([-1, 9, -45, 0, 45, -9, 1]) / 60
SECOND = np.array([2, -27, 270, -490, 270, -27, 2]) / 180


@over(8)
def test_rates_are_the_differences_of_positions(seed: int) -> None:
    """Central differences over seven positions in time, of sixth order."""
    case, h = random_case(seed), 4e-4
    moved = {k: replace(v, steps=in_time(v, h)) for k, v in case.drawing.drives.items()}
    r, length = da.kinematics(da.mechanism(tree(replace(case.drawing, drives=moved)))), case.answer.length()
    assert all(r.ok), r.problems()
    speed, gain = speed_scale(case.answer), float(np.max(np.abs(case.answer.a * [1, 1, length])))
    for link in r.links:
        for x, v, a, unit in (
            (r.angle(link), r.speed(link), r.acceleration(link), length),
            (r.center(link), r.center_velocity(link), r.center_acceleration(link), 1.0),
        ):
            assert np.max(np.abs(FIRST @ x[1:] / h - v[0])) * unit < 1e-7 * max(speed, 1.0)
            assert np.max(np.abs(SECOND @ x[1:] / h**2 - a[0])) * unit < 1e-6 * max(gain, 1.0)


def in_time(drive: Any, h: float) -> tuple[float, ...]:
    """The drawn position first (it carries the rates and the phases), then seven around it in time."""
    return (0.0, *(drive.speed * t + drive.acceleration * t * t / 2 for t in h * np.arange(-3.0, 4.0)))


@pytest.mark.parametrize(("start", "end"), [(0, 360), (360, 0), (0, -360)])
def test_turns_behind_a_gap_are_counted_as_the_drive_counts_them(start: int, end: int) -> None:
    """What lies behind a dead centre is reached around the other way: a spring on the crank is wound by the crank."""
    tree = da.four_bar(ground=0.3, crank=0.1, coupler=0.3, rocker=0.12).to_tree()
    tree["links"]["ground"]["points"]["O4"] = [0.303, 0]
    tree["links"]["rocker"]["points"]["B"] = [0.1, 0]
    tree["drives"]["O2"]["position"] = {"from": start, "to": end, "count": 24}
    plain = da.statics(da.mechanism(tree))
    tree["loads"]["wound"] = {"type": "torsion_spring", "joint": "O2", "stiffness": 3, "free_angle": 0}
    r = da.statics(da.mechanism(tree))
    assert 15 < r.ok.sum() < 24
    angle = r.drive_position("O2")[r.ok]
    assert r.angle("crank")[r.ok] == pytest.approx(angle, abs=1e-12)
    assert (r.effort("O2") - plain.effort("O2"))[r.ok] == pytest.approx(3 * angle, abs=1e-9)
