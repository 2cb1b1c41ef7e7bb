"""First poses: groups of links laid down one after another, every way that they close."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.linkages import chain

import dalembert as da
from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.bundled import examples
from dalembert.core.position.assur_plan import plan
from tests.random_mechanisms import Drawing, pose_array, tree
from tests.random_mechanisms.groups import driven, dyad, single, welded
from tests.tiers import over


@pytest.mark.parametrize("groups", [24, 49])
def test_a_long_chain_closes_at_its_first_position(groups: int) -> None:
    """Every rocker on the side of its rod that the file's angles state; Newton from a few starts finds none."""
    m = chain(groups, positions=1)
    r = da.kinematics(m)
    assert r.ok.all()
    turn = np.array([r.angle(f"rocker{k}")[0] - r.angle(f"rod{k}")[0] for k in range(groups)])
    ends = [r.point(f"{link}{k}", f"B{k}")[0] for k in range(groups) for link in ("rod", "rocker")]
    np.testing.assert_allclose(ends[::2], ends[1::2], atol=1e-9)
    assert (np.sin(turn) > 0).all()


def test_a_slide_belongs_to_a_group_in_closed_form() -> None:
    m = da.load(examples()["quick_return"])
    way = plan(compile_mechanism(m, m.schedule()).layout)
    assert way is not None
    assert way.closed


def test_wheels_turn_where_their_links_do_not_close_at_angle_0() -> None:
    """A pinion drives a rocker that can reach no angle near 0: its coupler would have to be 0.3 m long."""
    m = da.mechanism(
        {
            "links": {
                "ground": {"points": {"O": [0, 0], "R": [0.3, 0], "P": [0.36, 0]}},
                "crank": {"points": {"O": [0, 0], "A": [0.1, 0]}},
                "coupler": {"points": {"A": [0, 0], "B": [0.25, 0]}},
                "rocker": {"points": {"R": [0, 0], "B": [0.1, 0]}},
                "pinion": {"points": {"P": [0, 0]}},
            },
            "joints": {
                "O": {"type": "pin", "links": ["ground", "crank"]},
                "A": {"type": "pin", "links": ["crank", "coupler"]},
                "B": {"type": "pin", "links": ["coupler", "rocker"]},
                "R": {"type": "pin", "links": ["ground", "rocker"]},
                "P": {"type": "pin", "links": ["ground", "pinion"]},
                "teeth": {
                    "type": "gear",
                    "links": ["rocker", "pinion"],
                    "at": ["R", "P"],
                    "radii": [0.04, 0.02],
                },
            },
            "drives": {"P": {"position": 0}},
        }
    )
    r = da.kinematics(m)
    assert r.ok.all()
    assert np.linalg.norm(r.point("coupler", "B") - r.point("rocker", "B")) < 1e-9


def described(seed: int) -> tuple[Drawing, Compiled]:
    """A drawing of groups that have closed forms, and its description without an assembly."""
    rng = np.random.default_rng(seed)
    steps = [dyad, dyad, dyad, single, driven, welded]
    while True:
        d = Drawing(seed=seed)
        driven(d, rng)
        while len(d.poses) < 6:
            steps[int(rng.integers(len(steps)))](d, rng)
        made = tree(d)
        del made["assembly"]
        m = da.mechanism(made)
        c = compile_mechanism(m, m.schedule())
        way = plan(c.layout)
        if way is not None and way.closed:
            return d, c


@over(15, 400)
def test_the_drawn_pose_is_one_of_the_ways_found(seed: int) -> None:
    """Whatever joints a group has: the lengths were read off that pose."""
    drawing, c = described(seed)
    found = c.guess.modes(c.layout, c.targets[0])
    assert found is not None
    drawn = pose_array(drawing)[0, 1:]
    arm = c.layout.algebra.rotate(found.pose.rotation, c.layout.reference)
    origin = found.pose.point - arm
    origin = origin[:, :-1] - origin[:, -1:]
    off = np.abs(origin - drawn[:, :2]).max(axis=(1, 2))
    turned = np.abs(np.exp(1j * found.pose.turn[:, :-1]) - np.exp(1j * drawn[:, 2])).max(axis=1)
    assert np.maximum(off, turned).min() < 1e-9
