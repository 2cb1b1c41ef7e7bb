"""The laws of mechanics on random mechanisms in space, to 1e-9 of the largest force (times metres).

Each law runs on the first mechanisms by default, on 500 in all (`tests/tiers.py`).
"""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from dataclasses import replace
from functools import lru_cache, partial
from typing import Any

import numpy as np
import pytest

import dalembert as da
from tests import tiers
from tests.laws.test_laws import FIRST, SECOND, in_time
from tests.random_space import IN_LBF, MM_N, Drawing, Options, Rigid, Style, exchangeable, random_case, tree
from tests.random_space.drawing import Array, about, rotation
from tests.space.free_bodies import Balance
from tests.space.screw_motion import Places, at_origin, equations, gaps, redundant, seen, standing

TOLERANCE = 1e-9
over: Callable[..., Any] = partial(tiers.over, whole=500)


def solved(d: Drawing, options: Options = Options(), inertia: bool = True) -> Any:  # noqa: B008
    """The result, all positions as they should be: redundant where the drawing is."""
    m = da.mechanism(tree(d, options))
    r = da.dynamics(m) if inertia else da.statics(m)
    assert set(r.status) == {"redundant" if redundant(d) else "ok"}, r.problems()
    return r


@lru_cache(maxsize=128)
def answered(seed: int) -> Any:
    return solved(random_case(seed))


@lru_cache(maxsize=128)
def balance(seed: int) -> Balance:
    r, d = answered(seed), random_case(seed)
    return Balance(r, d, seen(r, d))


def undamped(d: Drawing) -> Drawing:
    loads = {k: load for k, load in d.loads.items() if "damper" not in load.type}
    return replace(d, joints={k: replace(j, damping={}) for k, j in d.joints.items()}, loads=loads)


# positions and rates


@over(8)
def test_every_joint_closes_and_every_drive_stands_where_it_is_told(seed: int) -> None:
    d, r = random_case(seed), answered(seed)
    assert max(gaps(d, seen(r, d)).values()) < 1e-11
    assert (r.mobility.freedoms, r.mobility.redundant) == (len(d.drives), redundant(d))
    for name, drive in d.drives.items():
        value, rate, second = r.freedom(drive.joint, drive.freedom)
        away = value - r.drive_position(name)
        if not drive.freedom.startswith("slide"):
            away = away - 2 * np.pi * np.round(away[0] / (2 * np.pi))
        assert np.max(np.abs(away)) < 1e-11
        assert np.max(np.abs(rate - drive.speed)) < 1e-9
        assert np.max(np.abs(second - drive.acceleration)) < 1e-8


@over(8)
def test_speeds_are_those_of_the_joints_screws(seed: int) -> None:
    d, r = random_case(seed), answered(seed)
    s = seen(r, d)
    expected = equations(d, s).solved(d, {name: x.speed for name, x in d.drives.items()})
    assert np.max(np.abs(at_origin(s.twist, s.origin) - expected)) < TOLERANCE


@over(6)
def test_rates_are_the_differences_of_positions(seed: int) -> None:
    """Central differences over seven positions in time, of sixth order; of rods along their line only.

    The steps are short beside the time in which the rates change: near a dead position that is soon.
    """
    d = random_case(seed)
    drawn = seen(answered(seed), d)
    h = 4e-4 / max(1.0, 0.04 * np.max(np.abs(drawn.rate[0])) / np.max(np.abs(drawn.twist[0])))
    moved = {k: replace(v, steps=in_time(v, h)) for k, v in d.drives.items()}
    d = replace(d, drives=moved)
    r = da.kinematics(da.mechanism(tree(d)))
    assert all(r.ok), r.problems()
    s = seen(r, d)
    at, speed, gain = Places(d, s), np.max(np.abs(s.twist)), np.max(np.abs(s.rate))
    for k, link in enumerate(s.links):
        for x, v, a in _moving(d, at, link, k):
            assert np.max(np.abs(np.tensordot(FIRST, x[1:], 1) / h - v[0])) < 1e-7 * max(speed, 1.0), link
            assert np.max(np.abs(np.tensordot(SECOND, x[1:], 1) / h**2 - a[0])) < 1e-6 * max(gain, 1.0), link


def _moving(d: Drawing, at: Places, link: str, k: int) -> list[tuple[Array, Array, Array]]:
    """Vectors (P, 3) of a link with their rates and second rates: of its origin and axes, or of a rod's two ends."""
    s = at.s
    v, w, a, alpha = s.twist[:, k, :3], s.twist[:, k, 3:], s.rate[:, k, :3], s.rate[:, k, 3:]

    def turning(u: Array) -> tuple[Array, Array, Array]:
        return u, np.cross(w, u), np.cross(alpha, u) + np.cross(w, np.cross(w, u))

    if link not in d.rods:
        return [(s.origin[:, k], v, a), *(turning(s.rotation[:, k, :, n]) for n in range(3))]
    if any(j.i == link and j.pair.slides for j in d.joints.values()):
        return []
    out = []
    for p in d.rods[link]:
        arm = turning(at.point(link, p) - s.origin[:, k])
        out.append((s.origin[:, k] + arm[0], v + arm[1], a + arm[2]))
    return out


# forces


@over(8)
def test_every_link_is_in_equilibrium(seed: int) -> None:
    b = balance(seed)
    assert np.max(np.abs(b.out)) < TOLERANCE * b.scale
    assert np.max(b.r.residual) < TOLERANCE


@over(8)
def test_reactions_do_no_work_on_any_motion_that_the_joint_allows(seed: int) -> None:
    b = balance(seed)
    for joint in b.d.joints:
        assert np.max(np.abs(b.work(joint)), initial=0.0) < TOLERANCE * b.scale, joint


@over(8)
def test_power_of_efforts_loads_and_inertia_is_balanced(seed: int) -> None:
    b = balance(seed)
    assert np.max(np.abs(b.power())) < TOLERANCE * b.scale * max(np.max(np.abs(b.s.twist)), 1.0)
    assert np.max(b.r.power_balance) < TOLERANCE


@over(8)
def test_efforts_are_those_of_virtual_work(seed: int) -> None:
    b = balance(seed)
    for drive, effort in b.virtual_work().items():
        assert np.max(np.abs(effort - b.r.effort(drive))) < 10 * TOLERANCE * b.scale, drive


@over(6)
def test_methods_on_paper_agree_with_the_matrix(seed: int) -> None:
    """The product's own virtual work and superposition."""
    r = answered(seed)
    assert np.max(da.virtual_work(r).gap) < TOLERANCE
    assert np.max(da.superposition(r).gap) < TOLERANCE


@over(8)
def test_every_link_is_in_equilibrium_without_inertia(seed: int) -> None:
    """Dampers act at the drives' speeds; of a motion, statics asks nothing else."""
    d = random_case(seed)
    r = solved(d, inertia=False)
    b = Balance(r, d, seen(r, d), inertia=False)
    assert np.max(np.abs(b.out)) < TOLERANCE * b.scale


# what must change nothing, or only turn or scale


def wrenches(r: Any, joint: str) -> Array:
    return np.asarray(r.least_norm(joint))


def alike(r: Any, other: Any, seed: int, turn: Array | None = None, factor: float = 1.0) -> None:
    """All reactions and efforts the same, reactions turned, all times a factor; unique ones marked the same."""
    scale, turn = balance(seed).scale, np.eye(3) if turn is None else turn
    for joint in r.joints:
        parts = np.split(wrenches(r, joint), 2, -1)
        expected = factor * np.concatenate([part @ turn.T for part in parts], -1)
        assert np.max(np.abs(wrenches(other, joint) - expected)) < TOLERANCE * scale * factor, joint
        assert np.array_equal(r.unique_in is None, other.unique_in is None)
    for drive in r.drives:
        assert np.max(np.abs(other.effort(drive) - factor * r.effort(drive))) < TOLERANCE * scale * factor


MOTIONS = [
    Rigid(about(np.array([1.0, 2.0, -0.5]), 0.7), np.array([0.3, -2.0, 1.0])),
    Rigid(about(np.array([0.1, -1.0, 3.0]), -2.9), np.array([100.0, 350.0, -40.0])),
]


@over(5)
@pytest.mark.parametrize("motion", MOTIONS, ids=["near", "far"])
def test_moving_the_machine_turns_the_answers(seed: int, motion: Rigid) -> None:
    d, r = random_case(seed), answered(seed)
    moved = solved(d, Options(motion=motion))
    alike(r, moved, seed, motion.turn)
    for joint, j in d.joints.items():
        if j.j == "ground":
            continue
        for place in ("link", "joint"):
            there = [x.least_norm(joint, axes=place) for x in (r, moved)]
            assert np.max(np.abs(there[1] - there[0])) < TOLERANCE * balance(seed).scale


@over(5)
@pytest.mark.parametrize("style", [MM_N, IN_LBF], ids=["mm N", "in lbf"])
def test_units_change_nothing(seed: int, style: Style) -> None:
    alike(answered(seed), solved(random_case(seed), Options(style=style)), seed)


@over(6)
def test_the_axes_that_a_link_is_described_in_change_nothing(seed: int) -> None:
    d, rng = random_case(seed), np.random.default_rng(seed)
    frames = {link: (rotation(rng), rng.uniform(-1, 1, 3)) for link in d.links if link != "ground"}
    if any(
        j.type == "universal" for j in d.joints.values()
    ):  # the zero of its turns is told by the links' axes
        frames = {link: pose for link, pose in frames.items() if not _on_universal(d, link)}
    alike(answered(seed), solved(d, Options(frames=frames)), seed)


def _on_universal(d: Drawing, link: str) -> bool:
    return any(j.type == "universal" and link in (j.i, j.j) for j in d.joints.values())


@over(6)
def test_the_order_of_links_and_joints_changes_nothing(seed: int) -> None:
    alike(answered(seed), solved(random_case(seed), Options(order=seed)), seed)


@over(6)
def test_exchanging_i_and_j_only_flips_signs(seed: int) -> None:
    d, b = random_case(seed), balance(seed)
    swapped = exchangeable(d)
    other = solved(d, Options(exchange=swapped))
    for name, j in d.joints.items():
        sign = -1.0 if name in swapped else 1.0
        p, q = b.at.ends(j)
        unique = b.r.unique(name).all() and other.unique(name).all()
        if not unique:
            continue
        force, moment = np.split(wrenches(b.r, name), 2, -1)
        moment = moment + (np.cross(q - p, force) if name in swapped else 0.0)
        found = sign * wrenches(other, name)
        assert np.max(np.abs(found - np.concatenate([force, moment], -1))) < TOLERANCE * b.scale, name
        on = other.reaction(name, on=j.i) + other.reaction(name, on=j.j)
        assert np.max(np.abs(on)) < TOLERANCE * b.scale
    for name, drive in d.drives.items():
        sign = -1.0 if drive.joint in swapped else 1.0
        assert np.max(np.abs(sign * other.effort(name) - b.r.effort(name))) < TOLERANCE * b.scale


@over(6)
def test_a_batch_is_its_positions_one_by_one(seed: int) -> None:
    d, r = random_case(seed), answered(seed)
    s = seen(r, d)
    for k in range(len(r.status)):
        poses = {link: (s.rotation[k, n], s.origin[k, n]) for n, link in enumerate(s.links)}
        made = tree(d)
        for drive in made["drives"].values():
            drive["position"] = drive["position"][k]
        single = da.dynamics(da.mechanism(made | {"assembly": assembly(d, poses)}))
        assert set(single.status) == set(r.status)
        for joint in r.joints:
            gap = np.max(np.abs(wrenches(single, joint)[0] - wrenches(r, joint)[k]))
            assert gap < TOLERANCE * balance(seed).scale, (joint, k)


def assembly(d: Drawing, poses: dict[str, tuple[Array, Array]]) -> dict[str, Any]:
    """Poses as a file gives them."""
    found: dict[str, Any] = tree(replace(d, poses=poses, posed=True))["assembly"]
    return found


@over(6)
def test_at_speed_0_dynamics_is_statics(seed: int) -> None:
    d = random_case(seed)
    still = Options(speeds=0.0)
    alike(solved(d, still), solved(d, still, inertia=False), seed)


@over(6)
def test_inertia_forces_grow_with_the_square_of_speed(seed: int) -> None:
    d = undamped(random_case(seed))
    still = solved(d, inertia=False)
    slow, fast = (solved(d, Options(speeds=s)) for s in (1.0, 3.0))
    force = max(float(np.max(np.abs(wrenches(fast, j)))) for j in d.joints)
    for joint in d.joints:
        added = [wrenches(r, joint) - wrenches(still, joint) for r in (slow, fast)]
        assert np.max(np.abs(9 * added[0] - added[1])) < TOLERANCE * force, joint


@over(3)
@pytest.mark.parametrize("factor", [1e-6, 2.0, 1e8])
def test_all_forces_scale_with_the_loads(seed: int, factor: float) -> None:
    d = random_case(seed)
    r = solved(d, inertia=False)
    free = replace(d, joints={k: replace(j, damping={}) for k, j in d.joints.items()})
    if any(j.damping for j in d.joints.values()):
        r = solved(free, inertia=False)
    alike(r, solved(free, Options(loads=factor), inertia=False), seed, factor=factor)


@over(6)
def test_loads_add(seed: int) -> None:
    d = undamped(random_case(seed))
    names = sorted(d.loads)
    half, rest = ({k: d.loads[k] for k in names[n::2]} for n in (0, 1))
    parts = [
        solved(replace(d, loads=half, gravity=np.zeros(3)), inertia=False),
        solved(replace(d, loads=rest), inertia=False),
    ]
    whole = solved(d, inertia=False)
    for joint in d.joints:
        total = sum(wrenches(p, joint) for p in parts)
        assert np.max(np.abs(total - wrenches(whole, joint))) < 4 * TOLERANCE * balance(seed).scale


@lru_cache(maxsize=512)
def doubles(seed: int) -> list[str]:
    """Joints that can be doubled: no welds, not those of rods, without damping."""
    d = random_case(seed)
    joints = [name for name, j in d.joints.items() if not j.damping and j.type != "weld"]
    return [name for name in joints if not {d.joints[name].i, d.joints[name].j} & set(d.rods)]


@over(6)
def test_a_doubled_joint_is_redundant_and_changes_no_effort(seed: int) -> None:
    seed = tiers.nth(seed, doubles)
    d, made = random_case(seed), tree(random_case(seed))
    name = doubles(seed)[-1]
    made["joints"]["twin"] = deepcopy(made["joints"][name])
    double, single = da.dynamics(da.mechanism(made)), answered(seed)
    assert set(double.status) == {"redundant"}
    assert double.mobility.redundant == redundant(d) + 6 - d.joints[name].pair.count
    assert {"twin", name} <= set(double.mobility.redundant_joints)
    scale = balance(seed).scale
    for drive in single.drives:
        assert np.max(np.abs(double.effort(drive) - single.effort(drive))) < 10 * TOLERANCE * scale
    both = wrenches(double, "twin") + wrenches(double, name)
    if single.unique(name).all():
        assert np.max(np.abs(both - wrenches(single, name))) < 10 * TOLERANCE * scale


@pytest.mark.long
def test_the_drawings_have_everything() -> None:
    """All pairs, drives, loads, rods, redundant ones and both ways to tell the first pose come up."""
    drawings = [random_case(seed) for seed in range(40)]
    kinds = {j.type for d in drawings for j in d.joints.values()}
    assert len(kinds) == 15
    assert {x.freedom for d in drawings for x in d.drives.values()} >= {"turn", "slide", "turn1", "turn2"}
    assert any(j.axis is not None for d in drawings for j in d.joints.values())
    assert {load.type for d in drawings for load in d.loads.values()} == {
        "force", "couple", "spring", "constant_force_spring", "damper", "torsion_spring", "torsion_damper",
    }  # fmt: skip
    assert any(d.rods for d in drawings)
    assert {d.posed for d in drawings} == {True, False}
    assert {bool(redundant(d)) for d in drawings} == {True, False}
    assert max(max(gaps(d, standing(d)).values()) for d in drawings[:8]) < 1e-13
