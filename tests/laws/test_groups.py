"""Assur groups of J and the sign of each; the end of a straight motion of the drives; wheels that have a phase."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.core.constraints import dense, measure, stack_rows
from dalembert.core.layout import Layout, Pose
from dalembert.core.position import assur_groups
from dalembert.core.position.assembly_modes import Wanted, distinct, measures, sort_modes
from dalembert.core.position.assur_groups import (
    block_triangular,
    groups,
    independent_rows,
    on_independent_rows,
    senses,
)
from dalembert.core.position.newton import close_loops, displace, distance
from dalembert.core.position.whole_turns import (
    INWARD,
    phase_freedoms,
    phase_links,
    rigid_turns,
    straight_path,
)
from tests.laws.test_marching import first, linkage


def posed(m: Any) -> tuple[Layout, Pose]:
    r = da.kinematics(m)
    return r.compiled.layout, full_pose(r, slice(None))


def scaled(layout: Layout, pose: Pose) -> np.ndarray:
    """J without dimensions at each pose."""
    return dense(layout, stack_rows(layout, pose)) * layout.row_scale[:, None] * layout.column_scale


@pytest.mark.parametrize("make", [da.four_bar, da.slider_crank, da.inverted_slider_crank, da.rssr, da.watt_1])
def test_the_determinant_is_the_product_of_the_groups_determinants(make: Any) -> None:
    """Each row and column is in one group, and a group needs only those before it."""
    layout, pose = posed(make(positions=7))
    found, j = groups(layout, pose), scaled(layout, pose)
    rows, columns = (np.concatenate([getattr(g, part) for g in found]) for part in ("row", "column"))
    assert sorted(rows) == sorted(columns) == list(range(layout.unknowns))
    of = np.repeat(np.arange(len(found)), [len(g.row) for g in found])
    ordered = np.abs(j[:, rows][:, :, columns]).max(axis=0)
    assert ordered[of[:, None] < of].max() < 1e-9
    each = np.stack([np.linalg.det(j[:, g.row[:, None], g.column]) for g in found], axis=1)
    assert np.abs(each.prod(axis=1)) == pytest.approx(np.abs(np.linalg.det(j)))
    assert (senses(layout, found, pose) == np.sign(each)).all()


def test_two_ways_of_closing_differ_in_the_sign_of_their_group() -> None:
    """Coupler and rocker of a four-bar above or below the line from the crank's end to the fixed pin."""
    lengths, poses = (0.1, 0.25, 0.2, 0.3), []
    for stated in ({"coupler": 30.0, "rocker": 100.0}, {"coupler": 300.0, "rocker": 250.0}):
        c = linkage(lengths, [40.0], stated)
        poses.append(first(c))
    layout = c.layout
    both = Pose(*(np.stack(part) for part in zip(*poses, strict=True)))
    assert distance(layout, both.at(slice(0, 1)), both.at(slice(1, 2)))[0] > 0.5
    found = groups(layout, both)
    sign = senses(layout, found, both)
    changed = (sign[0] != sign[1]).nonzero()[0]
    assert len(changed) == 1
    dyad = found[changed[0]]
    assert {int(k) for k in dyad.column // 3} == {1, 2}


def test_links_that_close_only_together_have_more_ways_than_signs() -> None:
    """Four links of a Stephenson linkage are one group, and then nothing is told; of three links it would be."""
    layout, pose = posed(da.stephenson_2(positions=3))
    assert groups(layout, pose) == []
    watt, watts_pose = posed(da.watt_1(positions=3))
    assert groups(watt, watts_pose)


def test_rows_that_repeat_others_are_left_out_from_either_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """A plane four-bar lifted into space has 21 rows for 18 unknowns; both choices of 18 are whole and differ."""
    layout, pose = posed(da.lifted(da.four_bar(positions=5)))
    count, j = layout.stack.count, scaled(layout, pose)
    assert (count, layout.unknowns, np.linalg.matrix_rank(j[0])) == (21, 18, 18)
    found = groups(layout, pose)
    sizes = np.cumsum([len(g.row) for g in found])
    half = int(np.searchsorted(sizes, 18)) + 1
    choices = []
    for some in (found[:half], found[half:]):
        rows, columns = (np.concatenate([getattr(g, part) for g in some]) for part in ("row", "column"))
        assert sorted(columns) == list(range(18))
        assert np.linalg.matrix_rank(j[0, rows]) == 18
        choices.append(set(rows.tolist()))
    for order, chosen in zip((np.arange(count), np.arange(count)[::-1]), choices, strict=True):
        kept = independent_rows(j[0], order)
        assert set(kept.tolist()) == chosen
        for k, row in enumerate(order):  # a row is kept where it raises the rank of those before
            more = np.linalg.matrix_rank(j[0, order[: k + 1]]) > (
                np.linalg.matrix_rank(j[0, order[:k]]) if k else 0
            )
            assert (row in kept) == more
    assert choices[0] != choices[1]
    monkeypatch.setattr(assur_groups, "LARGEST", 18)
    assert groups(layout, pose)
    monkeypatch.setattr(assur_groups, "LARGEST", 17)
    assert groups(layout, pose) == []


def test_newton_by_independent_rows_returns_to_the_pose() -> None:
    """The pose moved by a hundredth of a radian closes again, with the rows left out closed too."""
    c = da.kinematics(da.lifted(da.four_bar(positions=5))).compiled
    layout, pose = c.layout, full_pose(da.kinematics(da.lifted(da.four_bar(positions=5))), slice(0, 1))
    chosen = on_independent_rows(layout, pose.at(0))
    rng = np.random.default_rng(3)
    off = displace(
        layout, pose, 0.01 * rng.normal(size=(1, layout.links, 6)) * [*[layout.length] * 3, 1, 1, 1]
    )
    again, missing = close_loops(chosen, off, c.targets[:1])
    assert missing[0] < 1e-12
    assert distance(layout, again, pose)[0] < 1e-10
    square, still = posed(da.four_bar(positions=2))
    assert on_independent_rows(square, still.at(0)) is square


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_row_depends_on_those_before_where_a_millionth_of_it_is_left(size: float) -> None:
    """Whatever its size, and that of the others."""
    rng = np.random.default_rng(8)
    first, second, third = np.linalg.qr(rng.normal(size=(5, 5)))[0][:3]
    along = 7.0 * first - 2.0 * second
    rows = np.stack(
        [50.0 * first, 0.02 * second, along + 1.2e-6 * 7.28 * third, along + 0.8e-6 * 7.28 * third]
    )
    for k, kept in ((2, [0, 1, 2]), (3, [0, 1])):
        some = np.stack([rows[0], rows[1], size * rows[k]])
        assert independent_rows(some, np.arange(3)).tolist() == kept
    assert independent_rows(rows[[0, 0, 1]], np.arange(3)[::-1]).tolist() == [2, 1]
    assert block_triangular([[0], [0]], 2) is None
    assert block_triangular([[0], [1]], 3) is None


def test_the_teeth_have_a_phase_and_links_have_none() -> None:
    """Two wheels in mesh, the first with a drive and the second with a rod: its phase turns the second and what hangs
    on it; the second wheel turns the other way."""
    links = {
        "ground": {"points": {"O": [0, 0], "P": [0.3, 0], "Q": [0.9, 0.1]}},
        "first": {"points": {"O": [0, 0]}},
        "second": {"points": {"P": [0, 0], "A": [0.1, 0]}},
        "rod": {"points": {"A": [0, 0], "B": [0.5, 0]}},
        "last": {"points": {"Q": [0, 0], "B": [0, 0.4]}},
    }
    pins = {"O": ("ground", "first"), "P": ("ground", "second"), "A": ("second", "rod"), "B": ("rod", "last")}
    joints = {n: {"type": "pin", "links": list(on)} for n, on in (pins | {"Q": ("ground", "last")}).items()}
    joints["teeth"] = {"type": "gear", "links": ["first", "second"], "at": ["O", "P"], "radii": [0.1, 0.2]}
    m = da.mechanism({"links": links, "joints": joints, "drives": {"O": {"position": [0, 10]}}})
    c = da.kinematics(m).compiled
    layout, pose = c.layout, full_pose(da.kinematics(m), slice(0, 1)).at(0)
    assert phase_links(layout, pose).tolist() == [False, True, True, True]
    turned = {
        name for (name, _), moved in zip(c.freedoms, phase_freedoms(layout, pose), strict=True) if moved
    }
    assert turned == {"P", "A", "B", "Q", "teeth"} & {name for name, _ in c.freedoms}
    plain, still = posed(da.four_bar(positions=2))
    assert not phase_links(plain, still.at(0)).any()
    assert not phase_freedoms(plain, still.at(0)).any()


@pytest.mark.parametrize(("start", "goal", "way"), [(290.0, 220.0, -1), (-290.0, -220.0, 1)])
def test_a_turn_at_the_end_of_a_motion_that_ends_is_moved_back(start: float, goal: float, way: int) -> None:
    """By its last step, a thousandth of a radian at most, towards where the motion came from; at a goal that is met it
    is not."""
    stated = {"coupler": 270.0} if start > 0 else {"coupler": 90.0}
    c = linkage((0.3, 0.15, 0.2, 0.2), [start], stated)
    layout, pose, here = c.layout, first(c), c.targets[0]
    there = here.copy()
    there[-1] = np.radians(goal)
    end = straight_path(layout, pose, here, there)
    assert not end.met
    reached = measure(layout.algebra, layout.freedoms, end.pose.at(None))[0]
    came = measure(layout.algebra, layout.freedoms, pose.at(None))[0]
    back = end.phi - reached
    assert (np.abs(back) <= INWARD * (1 + 1e-9)).all()
    assert (np.sign(back) == np.sign(came - reached)).all()
    assert np.abs(back).max() > 1e-4
    dead = np.arccos((0.3**2 + 0.2**2 - 0.35**2) / (2 * 0.3 * 0.2))
    assert end.pose.turn[0] == pytest.approx(way * (dead - 2 * np.pi), abs=1e-6)
    assert np.abs(back[layout.driven]).max() < 1e-5  # of the drive itself the last step was shorter
    there[-1] = np.radians(start - 20.0 * way)
    met = straight_path(layout, pose, here, there)
    assert met.met
    assert met.pose.turn[0] == pytest.approx(there[-1])
    assert met.phi == pytest.approx(measure(layout.algebra, layout.freedoms, met.pose.at(None))[0])


def turned(layout: Layout, angles: list[float], at: list[tuple[float, float]]) -> Pose:
    """Poses of a single moving link, by its angle and place."""
    turn = np.column_stack([angles, np.zeros(len(angles))])
    point = np.stack([np.array(at, float), np.zeros((len(at), 2))], axis=1)
    return Pose(point, turn, layout.algebra.rotation(turn))


def test_ways_of_closing_are_in_order_and_each_is_there_once() -> None:
    """By distance from the given angles, whole turns aside; without those the highest first. Poses 1e-4 apart, whole
    turns aside, are the same."""
    points = {"O": [0, 0], "A": [0.5, 0]}
    tree = {
        "links": {"ground": {"points": {"O": [0, 0]}}, "arm": {"points": points}},
        "joints": {"O": {"type": "pin", "links": ["ground", "arm"]}},
        "drives": {"O": {"position": [0]}},
    }
    layout = da.kinematics(da.mechanism(tree)).compiled.layout
    unit = layout.length
    poses = turned(
        layout, [0.3, 2.0, -1.0, 6.0], [(0, 0.1 * unit), (0, 0.4 * unit), (0, -0.2 * unit), (0, 0.2 * unit)]
    )
    unknown = Wanted(np.full(2, np.nan), np.full((2, 2), np.nan), None)
    assert not unknown.any_known
    assert sort_modes(layout, poses, unknown).tolist() == [1, 3, 0, 2]
    along, height = measures(layout, poses)
    assert along.tolist() == [0.0] * 4
    assert height == pytest.approx([0.2, 0.8, -0.4, 0.4], abs=1e-6)  # of the link, and of its end in the pin
    near = Wanted(np.array([0.2, 0.0]), np.full((2, 2), np.nan), None)
    assert near.any_known
    assert sort_modes(layout, poses, near).tolist() == [0, 3, 2, 1]  # off by 0.1, 0.48, 1.2 and 1.8
    again = turned(
        layout,
        [0.3, 0.3 + 2 * np.pi, 0.3 + 0.9e-4, 0.3 - 1.1e-4, 0.3, 0.3],
        [(0, 0), (0, 0), (0, 0), (0, 0), (0.9e-4 * unit, 0), (0, -1.1e-4 * unit)],
    )
    kept = distinct(layout, again)
    assert kept.turn[:, 0].tolist() == [0.3, 0.3 - 1.1e-4, 0.3]
    assert kept.point[:, 0, 1].tolist() == [0.0, 0.0, -1.1e-4 * unit]


def test_links_with_a_fixed_angle_between_them_turn_together() -> None:
    """A slider stays with its guide, a driven crank with the ground; a coupler and a rocker are free."""
    layout, _ = posed(da.slider_crank(positions=2))
    crank, rod, piston, ground = rigid_turns(layout)
    assert crank == piston == ground != rod
    layout, _ = posed(da.four_bar(positions=2))
    crank, coupler, rocker, ground = rigid_turns(layout)
    assert crank == ground
    assert len({coupler, rocker, ground}) == 3
