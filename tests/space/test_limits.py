"""Joints as limits of others: a screw of no lead, a universal joint and its cross, a shaft that slides;
and turns of more than one whole turn."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, lru_cache, partial

import numpy as np
import pytest

import dalembert as da
from tests.random_space import Drawing, random_case, random_drawing, tree
from tests.random_space.drawing import Array, Drive, Joint, Load
from tests.space.screw_motion import redundant
from tests.space.test_laws import TOLERANCE, solved, undamped, wrenches
from tests.tiers import nth, over


def candidates(d: Drawing, kind: str) -> list[str]:
    """Joints of a kind that nothing else refers to, in a mechanism whose reactions are unique."""
    if redundant(d):
        return []
    taken = {drive.joint for drive in d.drives.values()} | {load.joint for load in d.loads.values()}
    return [name for name, j in d.joints.items() if j.type == kind and name not in taken]


def frame(axis: Array, place: int) -> Array:
    """Axes (rows) with a direction at x (0) or z (2)."""
    e = np.cross(axis, np.eye(3)[np.abs(axis).argmin()])
    e /= np.linalg.norm(e)
    return np.roll(np.array([axis, e, np.cross(axis, e)]), place, axis=0)


def some(kind: str, seed: int) -> list[str]:
    return candidates(undamped(random_case(seed)), kind)


HAS = {
    kind: lru_cache(maxsize=None)(partial(some, kind)) for kind in ("revolute", "universal", "cylindrical")
}
"""Of a seed, its joints of a kind that may be exchanged."""


@over(6, 100)
def test_a_screw_of_small_lead_is_nearly_a_revolute(seed: int) -> None:
    """All reactions go to those of the revolute in proportion to the lead."""
    seed = nth(seed, HAS["revolute"])
    d = undamped(random_case(seed))
    name, r, away = HAS["revolute"](seed)[0], solved(d), []
    j = d.joints[name]
    for lead in (1e-4, 1e-5):
        turned = {"on_i": np.roll(j.on_i, 1, 0), "on_j": np.roll(j.on_j, 1, 0)}
        screw = replace(j, type="screw", lead=lead, **turned)
        other = solved(replace(d, joints={**d.joints, name: screw}))
        away.append([np.max(np.abs(wrenches(other, k) - wrenches(r, k))) for k in d.joints])
    force = max(np.max(np.abs(wrenches(r, k))) for k in d.joints)
    moved = np.array(away[0]) > 1e-6 * force
    assert np.array(away[1])[moved] == pytest.approx(np.array(away[0])[moved] / 10, rel=0.05)


def split(d: Drawing, name: str, first: Joint, second: Joint) -> Drawing:
    """The drawing with a joint made two, and a massless link between them."""
    joints: dict[str, Joint] = {}
    for key, j in d.joints.items():
        joints |= {f"{key} 1": first, f"{key} 2": second} if key == name else {key: j}
    p = d.spots[first.i if first.j == "between" else first.j]
    at = next(iter(p.values()))
    poses = {**d.poses, "between": (np.eye(3), np.asarray(at))}
    return replace(d, joints=joints, poses=poses, spots={**d.spots, "between": {}})


def parts(d: Drawing, name: str, kinds: tuple[str, str], axes: tuple[Array, Array]) -> Drawing:
    """Two joints in place of one, both with their freedoms 0 as drawn but for the slide of the first."""
    j = d.joints[name]
    p, r = d.spots[j.i][j.at_i], d.spots[j.j][j.at_j]
    frames = [frame(axis, 0 if kind == "prismatic" else 2) for kind, axis in zip(kinds, axes, strict=True)]
    slide = float((r - p) @ axes[0])
    first = Joint(kinds[0], j.i, "between", j.at_i, "P", frames[0], frames[0], (slide,))
    second = Joint(kinds[1], "between", j.j, "P", j.at_j, frames[1], frames[1], (0.0,))
    made = split(d, name, first, second)
    made.spots["between"]["P"] = r
    return made


def same_through_both(d: Drawing, name: str, made: Drawing) -> None:
    whole, two = solved(d), solved(made)
    scale = max(np.max(np.abs(wrenches(whole, k))) for k in d.joints)
    p, r = (two.joints.index(f"{name} {k}") for k in (1, 2))
    assert p < r
    for k in d.joints:
        for found in (f"{name} 1", f"{name} 2") if k == name else (k,):
            assert np.max(np.abs(wrenches(two, found) - wrenches(whole, k))) < TOLERANCE * scale, found
    for drive in d.drives:
        assert np.max(np.abs(two.effort(drive) - whole.effort(drive))) < TOLERANCE * scale


@over(6, 40)
def test_a_universal_joint_is_two_revolutes_with_a_massless_cross(seed: int) -> None:
    seed = nth(seed, HAS["universal"])
    d = undamped(random_case(seed))
    for name in HAS["universal"](seed):
        j = d.joints[name]
        same_through_both(d, name, parts(d, name, ("revolute", "revolute"), (j.on_i[1], j.on_j[2])))


@over(6, 40)
def test_a_cylindrical_joint_is_a_prismatic_and_a_revolute_with_a_massless_link(seed: int) -> None:
    seed = nth(seed, HAS["cylindrical"])
    d = undamped(random_case(seed))
    for name in HAS["cylindrical"](seed):
        axis = d.joints[name].on_i[0]
        same_through_both(d, name, parts(d, name, ("prismatic", "revolute"), (axis, axis)))


# turns that are counted


def turning_arm(seed: int) -> tuple[Drawing, str]:
    """One link on a driven joint that turns by two turns and a half, and the name of the drive."""
    d = random_drawing(seed, links=(1, 1), loads=False, redundant=False)
    name = next((n for n, x in d.drives.items() if x.freedom.startswith("turn")), "")
    if name:
        d.drives[name] = replace(d.drives[name], steps=tuple(np.linspace(0, 5 * np.pi, 16).tolist()))
    for other, drive in d.drives.items():
        if other != name:
            d.drives[other] = Drive(drive.joint, drive.freedom, (0.0,) * (16 if name else 1), 0.3, 0.0)
    return d, name


@cache
def arm_turns(seed: int) -> bool:
    d, name = turning_arm(seed)
    return bool(name) and len(d.joints) == 1


@over(6, 80)
def test_turns_are_not_reduced(seed: int) -> None:
    """The freedom follows its drive through whole turns, a screw advances with them, a spring winds up."""
    d, name = turning_arm(nth(seed, arm_turns))
    r, drive = da.dynamics(da.mechanism(tree(d))), d.drives[name]
    assert all(r.ok), r.problems()
    j = d.joints[drive.joint]
    value, rate, _ = r.freedom(drive.joint, drive.freedom)
    assert value == pytest.approx(r.drive_position(name), abs=1e-10)
    assert rate == pytest.approx(drive.speed)
    if j.type == "screw":
        slide, slid, _ = r.freedom(drive.joint, "slide")
        assert slide == pytest.approx(j.lead / (2 * np.pi) * value, abs=1e-10)
        assert slid == pytest.approx(j.lead / (2 * np.pi) * drive.speed)
    if drive.freedom == "turn":
        wound = replace(d, loads={"spring": Load("torsion_spring", joint=drive.joint, value=3.0, free=0.5)})
        more = da.dynamics(da.mechanism(tree(wound))).effort(name) - r.effort(name)
        assert more == pytest.approx(3.0 * (np.array(drive.steps) - 0.5), abs=1e-8)
