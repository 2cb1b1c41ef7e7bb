"""Every plane problem in space: the same efforts and forces in its plane, three redundant constraints a loop."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from tests.random_mechanisms import random_mechanism, tree
from tests.tiers import tiers

FILES = {**examples(), **cases()}


def lifts(path: Path) -> bool:
    """Whether a file can be lifted: it is in the plane, which stands, no wheel rolls, no brake rubs, and no position is
    asked for."""
    text = path.read_text(encoding="utf-8")
    return not re.search(
        "space: space|type: (rolling|band|shoe|disc|cone|cam|belt|rope)|position: unknown|turning: ", text
    )


def _plane(path: Path) -> da.Mechanism:
    """A file's mechanism, its friction switched off."""
    m = da.load(path)
    if any(getattr(joint, "friction", None) for joint in m.joints.values()):
        m = m.with_values({"friction.enabled": False})
    return m


LIFTED = [name for name, path in FILES.items() if lifts(path)]


def _loops(m: da.Mechanism) -> int:
    """Independent closed loops of the graph of links and joints; a mesh closes none that could be redundant."""
    joints = [joint for joint in m.joints.values() if joint.type != "gear"]
    group = {name: name for name in m.links}

    def root(name: str) -> str:
        return name if group[name] == name else root(group[name])

    for joint in joints:
        group[root(joint.links[0])] = root(joint.links[1])
    parts = len({root(name) for name in m.links})
    return len(joints) - len(m.links) + parts


@pytest.mark.parametrize("name", tiers(LIFTED[::2], LIFTED[1::2]))
def test_a_plane_mechanism_in_space(name: str) -> None:
    m = _plane(FILES[name])
    solve: Any = da.dynamics if m.has_speeds else da.statics
    count = 3 if m.drives and all(isinstance(d.position, da.Range) for d in m.drives.values()) else None
    plane, space = solve(m, positions=count), solve(da.lifted(m), positions=count)
    good = np.array([status == "ok" for status in plane.status])
    known = (plane.force_array, plane.effort_array)
    scale = max((float(np.abs(a[np.isfinite(a)]).max(initial=0.0)) for a in known), default=0.0) or 1.0
    for drive in plane.drives:
        assert space.effort(drive)[good] == pytest.approx(plane.effort(drive)[good], abs=1e-10 * scale)
    for load in plane.unknown_loads:
        assert space.unknown_load(load)[good] == pytest.approx(
            plane.unknown_load(load)[good], abs=1e-10 * scale
        )
    for joint in plane.joints:
        here, there = plane.reaction(joint)[good], space.reaction(joint)[good, :2]
        assert there == pytest.approx(here, abs=1e-10 * scale, nan_ok=True)
    assert space.mobility is not None
    assert space.mobility.redundant == 3 * _loops(m)
    assert space.mobility.freedoms == plane.mobility.freedoms  # type: ignore[union-attr]


def _random_plane(seed: int) -> da.Mechanism:
    """A small random mechanism without rolling, the turns of its slots sprung too."""
    drawings = (random_mechanism(seed + 1000 * k, (1, 5)) for k in range(50))
    made = next(made for made in map(tree, drawings) if "rolling" not in _types(made))
    free = np.random.default_rng(seed).uniform(-60, 60, len(made["joints"]))
    for angle, (name, joint) in zip(free, made["joints"].items(), strict=True):
        if joint["type"] == "slot":
            coil = {"type": "torsion_spring", "joint": name, "stiffness": 3.0, "free_angle": float(angle)}
            made["loads"][f"coil {name}"] = coil
    return da.mechanism(made)


def _types(made: dict[str, Any]) -> set[str]:
    return {joint["type"] for joint in made["joints"].values()}


QUICK, BLOCKS = (10, 11, 12, 14, 15), [range(k, k + 20) for k in range(16, 216, 20)]


@pytest.mark.parametrize("seeds", tiers([QUICK], BLOCKS[:1], BLOCKS[1:]))
def test_random_mechanisms_in_space_have_the_efforts_of_the_plane(seeds: Sequence[int]) -> None:
    """Slots driven and sprung, sliders at any angle, gears, springs between links at any heights."""
    met: set[str] = set()
    for seed in seeds:
        m = _random_plane(seed)
        high = np.random.default_rng(seed).uniform(-0.1, 0.1, len(m.links) + len(m.joints)).tolist()
        offsets = dict(zip([*m.links, *m.joints], high, strict=True))
        plane, space = da.dynamics(m), da.dynamics(da.lifted(m, offsets))
        scale = np.abs(plane.force_array).max()
        assert plane.ok.all()
        for drive in plane.drives:
            assert space.effort(drive) == pytest.approx(plane.effort(drive), abs=1e-9 * scale), seed
        for link in plane.links:
            angle = plane.angle(link)
            turned = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
            assert space.rotation(link)[:, :2, 0] == pytest.approx(turned, abs=1e-9), seed
        met |= {joint.type for joint in m.joints.values()}
        met |= {f"driven {m.joints[m.drive_joint(drive)].type}" for drive in m.drives}
    assert met >= {"pin", "slider", "slot", "driven slot"}


def test_the_turn_of_a_slot_is_0_where_the_links_axes_agree() -> None:
    """A bar held at 20 deg in a slot along 30 deg: 10 N at 1 m, and 5 N m/rad from 5 deg on."""
    tree = {
        "dalembert": 1,
        "links": {
            "ground": {"points": {"S": [0, 0]}},
            "bar": {"points": {"B": [0, 0]}, "mass": 1, "center": [1, 0]},
        },
        "joints": {"S": {"type": "slot", "links": ["ground", "bar"], "at": ["S", "B"], "direction": 30}},
        "drives": {
            "slide": {"joint": "S", "freedom": "slide", "position": 0.2},
            "turn": {"joint": "S", "freedom": "turn", "position": 20},
        },
        "loads": {"k": {"type": "torsion_spring", "joint": "S", "stiffness": 5, "free_angle": 5}},
        "gravity": [0, -10],
    }
    expected = 10 * np.cos(np.radians(20)) + 5 * np.radians(15)
    for m in (da.mechanism(tree), da.lifted(da.mechanism(tree))):
        assert da.statics(m).effort("turn")[0] == pytest.approx(expected, rel=1e-12)


def test_a_spring_pulls_halfway_between_the_heights_of_its_links() -> None:
    """A bearing at height 0 holds an arm at 0.4 m: the spring's force f at 0.2 m is a moment -0.2 z x f on the arm."""
    spring = {"type": "spring", "between": ["ground.Q", "arm.P"], "stiffness": 100, "free_length": 1}
    m = da.mechanism(
        {
            "dalembert": 1,
            "links": {"ground": {"points": {"O": [0, 0], "Q": [4, 4]}}, "arm": {"points": {"O": [0, 0], "P": [1, 0]}}},
            "joints": {"O": {"type": "pin", "links": ["ground", "arm"]}},
            "drives": {"O": {"position": 0}},
            "loads": {"k": spring},
        }
    )  # fmt: skip
    r = da.statics(da.lifted(m, {"arm": 0.4, "O": 0.0}))
    pull = 100 * (5 - 1) * np.array([3, 4]) / 5
    assert r.reaction("O")[0] == pytest.approx([*-pull, 0])
    assert r.reaction_moment("O")[0] == pytest.approx([0.2 * pull[1], -0.2 * pull[0], 0])


def test_a_pin_that_slides_and_one_that_turns_any_way_make_a_loop_determinate() -> None:
    m = da.four_bar()
    space = da.dynamics(da.lifted(m, {"coupler": 0.02}, {"A": "spherical", "B": "cylindrical"}))
    assert set(space.status) == {"ok"}
    assert space.effort("O2") == pytest.approx(da.dynamics(m).effort("O2"), rel=1e-10)


def test_a_crank_pin_beside_its_bearing_bends_it() -> None:
    """The pin force F at a height h above the bearing's middle is a couple -h x F on the crank there."""
    m = da.load(examples()["four_bar"])
    height = dict.fromkeys(("A", "B", "coupler", "rocker"), 0.05)
    r = da.statics(da.lifted(m, height, {"A": "spherical", "B": "cylindrical"}))
    pin = da.statics(m).reaction("A", on="crank")
    expected = 0.05 * np.stack([pin[:, 1], -pin[:, 0]], axis=1)
    assert r.reaction_moment("O2", on="crank")[:, :2] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    ("offsets", "become", "says"),
    [
        ({"nobody": 0.1}, {}, "unknown link or joint 'nobody' to offset"),
        ({}, {"nobody": "spherical"}, "'nobody' is not a pin that can become spherical"),
    ],
)
def test_what_cannot_be_lifted(offsets: dict[str, float], become: dict[str, Any], says: str) -> None:
    with pytest.raises(da.ModelError, match=says):
        da.lifted(da.four_bar(), offsets, become)


def test_wheels_that_roll_are_not_lifted() -> None:
    tree = {
        "links": {"ground": {"points": {"O": [0, 0]}}, "wheel": {"points": {"C": [0, 0]}}},
        "joints": {"R": {"type": "rolling", "links": ["ground", "wheel"], "at": ["O", "C"], "radius": 0.1}},
        "drives": {"R": {"position": 0}},
    }
    with pytest.raises(
        da.ModelError, match="joint 'R': a rolling joint has no counterpart that could be lifted"
    ):
        da.lifted(da.mechanism(tree))


def test_a_force_at_a_place_of_its_link_stays_there() -> None:
    m = da.four_bar(positions=4)
    tree = m.to_tree()
    tree["loads"] = {"F": {"type": "force", "on": "rocker", "at": [0.05, 0.02], "value": [30, -40]}}
    m = da.mechanism(tree)
    plane, space = da.statics(m), da.statics(da.lifted(m))
    assert space.effort("O2") == pytest.approx(plane.effort("O2"), rel=1e-10)
