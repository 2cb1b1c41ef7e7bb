"""Linkages near a change point: close branches are distinguished, and a motion stays on its branch through a crossing.

Closed forms (circles that meet, Bennett's relation) say where a linkage is that stays on its branch.
"""

from __future__ import annotations

from math import asin, degrees, pi, radians, sin
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.arrays import Array
from dalembert.core.layout import Pose
from dalembert.core.position.motion_path import _add_turns
from dalembert.model.library import bennett
from tests.tiers import over, tiers

SEEDS = 40
STEADY = 1e-5
"""Length that is missing to a change point above which no position may be lost."""


def lengths(rng: np.random.Generator, missing: float) -> tuple[float, float, float, float]:
    """Crank, coupler, rocker, ground of a linkage whose shortest link turns fully, by no more than ``missing``."""
    kind = rng.integers(3)
    if kind == 0:  # any
        p, q = rng.uniform(1, 3, 2)
        longest = rng.uniform(max(p, q), p + q - 0.3)
        shortest = p + q - longest - missing
    else:  # nearly a parallelogram, or a kite, by the order below
        p, longest = rng.uniform(0.3, 1), rng.uniform(1.2, 3)
        q, shortest = longest, p - missing
    a, b, c = rng.permutation([p, q, longest])
    return (shortest, a, b, c) if rng.random() < 0.6 else (a, b, c, shortest)


def meeting(a: Array, coupler: float, o4: complex, rocker: float, side: float) -> Array:
    """Where coupler and rocker meet, on one side of the way from A to O4."""
    way = o4 - a
    distance = np.abs(way)
    angle = np.arccos(np.clip((coupler**2 + distance**2 - rocker**2) / (2 * coupler * distance), -1.0, 1.0))
    return np.asarray(a + coupler * way / distance * np.exp(1j * side * angle))


def angle(way: Array | complex) -> float:
    return float(np.angle(way, deg=True))


def four_bar(sizes: tuple[float, ...], start: float, turn: float, count: int, side: float) -> da.Mechanism:
    return da.mechanism(four_bar_tree(sizes, start, turn, count, side))


def four_bar_tree(
    sizes: tuple[float, ...], start: float, turn: float, count: int, side: float
) -> dict[str, Any]:
    crank, coupler, rocker, ground = (float(size) for size in sizes)
    a = np.array(crank * np.exp(1j * radians(start)))
    b = complex(meeting(a, coupler, ground, rocker, side))
    return {
        "links": {
            "ground": {"points": {"O2": [0.0, 0.0], "O4": [ground, 0.0]}},
            "crank": {"points": {"O2": [0.0, 0.0], "A": [crank, 0.0]}},
            "coupler": {"points": {"A": [0.0, 0.0], "B": [coupler, 0.0]}},
            "rocker": {"points": {"O4": [0.0, 0.0], "B": [rocker, 0.0]}},
        },
        "joints": {
            "O2": {"type": "pin", "links": ["ground", "crank"]},
            "A": {"type": "pin", "links": ["crank", "coupler"]},
            "B": {"type": "pin", "links": ["coupler", "rocker"]},
            "O4": {"type": "pin", "links": ["ground", "rocker"]},
        },
        "drives": {
            "O2": {"position": {"from": start, "to": start + turn, "count": count}},
        },
        "assembly": {
            "crank": start,
            "coupler": angle(b - a),
            "rocker": angle(b - ground),
        },
    }


@pytest.mark.parametrize("seed", tiers(range(0, SEEDS, 2), range(1, SEEDS, 2)))
def test_a_linkage_near_its_change_point_stays_on_its_side(seed: int) -> None:
    rng = np.random.default_rng(seed)
    missing = 10 ** rng.uniform(-9, -1)
    sizes = lengths(rng, missing)
    _, coupler, rocker, ground = sizes
    start, turn = rng.uniform(0, 360), rng.choice([360.0, -360.0, 720.0, 200.0])
    count, side = int(rng.choice([8, 37, 73, 181, 361])), rng.choice([-1.0, 1.0])
    r = da.kinematics(four_bar(sizes, start, turn, count, side))
    a = r.point("crank", "A") @ [1, 1j]
    b = r.point("rocker", "B") @ [1, 1j]
    ok = r.ok
    assert ok.all() or missing < STEADY
    away = np.abs(b - meeting(a, coupler, ground, rocker, side))
    assert away[ok].max(initial=0.0) < 1e-6  # the root in the closed form loses half of the digits


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("missing", [1e-2, 1e-4, 1e-6])
def test_an_offset_slider_crank_that_hardly_turns_over(missing: float, side: float) -> None:
    r, h = 1.0, 0.7
    rod = r + h + missing
    tree = {
        "links": {
            "ground": {"points": {"O": [0.0, 0.0], "G": [0.0, -h]}},
            "crank": {"points": {"O": [0.0, 0.0], "A": [r, 0.0]}},
            "rod": {"points": {"A": [0.0, 0.0], "B": [rod, 0.0]}},
            "block": {"points": {"B": [0.0, 0.0]}},
        },
        "joints": {
            "O": {"type": "pin", "links": ["ground", "crank"]},
            "A": {"type": "pin", "links": ["crank", "rod"]},
            "B": {"type": "pin", "links": ["rod", "block"]},
            "G": {"type": "slider", "links": ["ground", "block"], "at": ["G", "B"], "direction": 0.0},
        },
        "drives": {"O": {"position": {"from": 0.0, "to": 720.0, "count": 289}}},
        "assembly": {"rod": degrees(-asin(h / rod) if side > 0 else pi + asin(h / rod))},
    }
    result = da.kinematics(da.mechanism(tree))
    assert result.ok.all()
    a, b = result.point("crank", "A"), result.point("block", "B")
    assert np.abs(b[:, 1] + h).max() < 1e-9
    reach = np.sqrt(rod**2 - (a[:, 1] + h) ** 2)
    np.testing.assert_allclose(b[:, 0], a[:, 0] + side * reach, atol=1e-6)


@pytest.mark.parametrize("determinate", [True, False])
@pytest.mark.parametrize("start", [52.5, 90.0, 130.0])
def test_bennett_over_the_poses_where_all_lies_on_one_line(start: float, determinate: bool) -> None:
    """tan(theta / 2) tan(phi / 2) = sin((beta + alpha) / 2) / sin((beta - alpha) / 2): Bennett, 1903."""
    twists = 40.0, 70.0
    m = bennett(start=start, twists=twists, sweep=(0.0, 2 * pi), positions=145, determinate=determinate)
    r = da.kinematics(m)
    o, a, b = r.point("crank", "O"), r.point("crank", "A"), r.point("rocker", "B")
    theta = radians(start) + r.drive_position("O")
    alpha, beta = (radians(twist) for twist in twists)
    half = sin((beta + alpha) / 2) / sin((beta - alpha) / 2) / np.tan(theta / 2)
    cosine = np.sum((a - o) * (b - a), axis=1) / (
        np.linalg.norm(a - o, axis=1) * np.linalg.norm(b - a, axis=1)
    )
    np.testing.assert_allclose(cosine, np.cos(2 * np.arctan(half)), atol=1e-9)


@pytest.mark.parametrize("count", [8, 73, 360])
def test_a_parallelogram_goes_straight_through_its_change_points(count: int) -> None:
    sizes = (0.5, 1.5, 0.5, 1.5)
    r = da.kinematics(four_bar(sizes, 40.0, 360.0, count, 1.0))
    crank, rocker = r.angle("crank"), r.angle("rocker")
    clear = np.abs(np.sin(crank)) > 1e-6
    np.testing.assert_allclose(np.cos(rocker - crank)[clear], 1.0, atol=1e-12)


def test_what_lies_behind_a_turn_too_sharp_to_follow_is_said_to_close() -> None:
    sizes = (0.969245892, 1.551008023, 1.551008023, 0.969245821)
    r = da.kinematics(four_bar(sizes, 187.15, 200.0, 181, 1.0))
    ((where, status, sentence),) = r.problems()
    assert (where, status) == ("157-181", "not_assembled")
    assert sentence.startswith("The linkage closes between 360.483 deg and 387.15 deg of O2, but the motion")


@pytest.mark.parametrize("seed", range(6))
def test_a_lifted_linkage_stays_with_the_plane_one(seed: int) -> None:
    """Its constraints repeat each other: there is no determinant that tells branches apart."""
    rng = np.random.default_rng(100 + seed)
    sizes = lengths(rng, 10 ** rng.uniform(-5, -1))
    m = four_bar(sizes, rng.uniform(0, 360), 360.0, 73, 1.0)
    plane, space = da.kinematics(m), da.kinematics(da.lifted(m))
    turned = space.rotation("rocker")
    assert plane.ok.all()
    angle = np.arctan2(turned[:, 1, 0], turned[:, 0, 0])
    np.testing.assert_allclose(np.exp(1j * angle), np.exp(1j * plane.angle("rocker")), atol=1e-6)


@pytest.mark.parametrize("ratio", [0.5, 1.0, 1.5, 2.0])
def test_wheels_keep_their_phase_behind_a_gap(ratio: float) -> None:
    """The other way around the gap leads to the same pose only where the wheels come round in whole turns."""
    first, second = 0.1, 0.1 * ratio
    link = {"A": [0.0, 0.0], "C": [0.1, 0.0]}
    tree = {
        "links": {
            "ground": {"points": {"O": [0.0, 0.0], "Q": [first + second, 0.0]}},
            "wheel": {"points": {"O": [0.0, 0.0], "A": [0.08, 0.0]}},
            "other": {"points": {"Q": [0.0, 0.0], "B": [0.07, 0.0]}},
            "one": {"points": link},
            "two": {"points": {"B": link["A"], "C": link["C"]}},
        },
        "joints": {
            "O": {"type": "pin", "links": ["ground", "wheel"]},
            "Q": {"type": "pin", "links": ["ground", "other"]},
            "mesh": {
                "type": "gear",
                "links": ["wheel", "other"],
                "at": ["O", "Q"],
                "radii": [first, second],
            },
            "A": {"type": "pin", "links": ["wheel", "one"]},
            "B": {"type": "pin", "links": ["other", "two"]},
            "C": {"type": "pin", "links": ["one", "two"]},
        },
        "drives": {"O": {"position": {"from": 0.0, "to": 360.0, "count": 72}}},
    }
    r = da.kinematics(da.mechanism(tree))
    turned, other, ok = r.angle("wheel"), r.angle("other"), r.ok
    np.testing.assert_allclose(turned[ok], r.drive_position("O")[ok], atol=1e-12)
    np.testing.assert_allclose((other - other[0])[ok] * ratio, -turned[ok], atol=1e-9)
    assert not ok.all()
    assert ok[-1] or ratio not in (0.5, 1.0)


@pytest.mark.parametrize(
    ("second", "third", "whole"), [(0.05, 0.1, (-2, 1)), (0.15, 0.1, (0, 0)), (0.1, 0.4, (-1, 0))]
)
def test_wheels_that_come_round_in_whole_turns_are_counted_further(
    second: float, third: float, whole: tuple[int, int]
) -> None:
    """Of a train whose first wheel, of 0.1 m, is driven once round; a wheel behind one that does not stays."""
    at = np.cumsum([0.0, 0.1 + second, second + third])
    wheels = ("one", "two", "three")
    tree: dict[str, Any] = {
        "links": {"ground": {"points": {w: [x, 0.0] for w, x in zip(wheels, at, strict=True)}}},
        "joints": {w: {"type": "pin", "links": ["ground", w]} for w in wheels},
        "drives": {"one": {"position": [0, 10]}},
    }
    tree["links"] |= {w: {"points": {w: [0.0, 0.0]}} for w in wheels}
    for i, j, radii in (("one", "two", [0.1, second]), ("two", "three", [second, third])):
        tree["joints"][i + j] = {"type": "gear", "links": [i, j], "at": [i, j], "radii": radii}
    m = da.mechanism(tree)
    c = compile_mechanism(m, m.schedule())
    pose = Pose(*(np.zeros(shape) for shape in ((4, 2), (4,), (4, 2))))
    more = np.zeros(c.layout.stack.count)
    more[-1] = 2 * pi
    assert _add_turns(c.layout, pose, more).turn / (2 * pi) == pytest.approx([1, *whole, 0])


def blocked(rng: np.random.Generator) -> tuple[float, float, float, float]:
    """Crank, coupler, rocker, ground of a linkage whose crank swings only, over half a turn or more."""
    while True:
        a, b, c, ground = rng.uniform(0.5, 2, 4)
        reach = np.abs(ground - a * np.exp(1j * np.linspace(0, 2 * pi, 361)))
        if 0 < ((reach > b + c) | (reach < abs(b - c))).mean() < 0.5:
            return a, b, c, ground


def starting(rng: np.random.Generator, sizes: tuple[float, ...]) -> float:
    """An angle of the crank, in degrees, where the linkage closes well."""
    crank, coupler, rocker, ground = sizes
    while True:
        start = rng.uniform(0, 360)
        reach = abs(ground - crank * np.exp(1j * radians(start)))
        if abs(coupler - rocker) + 0.02 < reach < coupler + rocker - 0.02:
            return float(start)


@over(8, 200)
def test_what_lies_behind_a_dead_centre_keeps_the_side_of_every_group(seed: int) -> None:
    """Where two groups of a six-bar linkage are both on their other side, det J has the same sign."""
    rng = np.random.default_rng(seed)
    sizes = blocked(rng)
    crank, coupler, rocker, ground = sizes
    start, turn = starting(rng, sizes), rng.choice([360.0, 330.0, 700.0, -300.0, 1080.0])
    first, second = rng.choice([-1.0, 1.0], 2)
    pivot = complex(ground + rng.uniform(-1, 1), rng.uniform(-1, 1))
    far, near = abs(pivot - ground) + rocker, abs(abs(pivot - ground) - rocker)
    total, apart = far + 0.2, rng.uniform(-0.7, 0.7) * near
    p, q = (total + apart) / 2, (total - apart) / 2
    b = meeting(np.array(crank * np.exp(1j * radians(start))), coupler, ground, rocker, first)
    c = meeting(b, p, pivot, q, second)
    tree = four_bar_tree(sizes, start, turn, 73, first)
    tree["links"]["ground"]["points"]["G"] = [pivot.real, pivot.imag]
    tree["links"] |= {
        "arm": {"points": {"B": [0.0, 0.0], "C": [p, 0.0]}},
        "lever": {"points": {"G": [0.0, 0.0], "C": [q, 0.0]}},
    }
    tree["joints"] |= {
        "B2": {"type": "pin", "links": ["rocker", "arm"], "at": "B"},
        "C": {"type": "pin", "links": ["arm", "lever"]},
        "G": {"type": "pin", "links": ["ground", "lever"]},
    }
    tree["assembly"] |= {"arm": angle(c - b), "lever": angle(c - pivot)}
    r = da.kinematics(da.mechanism(tree))
    where = ("crank", "A"), ("rocker", "B"), ("lever", "C")
    a, b, c = (r.point(*point)[r.ok] @ [1, 1j] for point in where)
    assert np.abs(b - meeting(a, coupler, ground, rocker, first)).max() < 1e-6
    assert np.abs(c - meeting(b, p, pivot, q, second)).max() < 1e-6


@over(0, 100)
def test_a_lifted_linkage_behind_a_dead_centre_is_never_on_the_other_side(seed: int) -> None:
    rng = np.random.default_rng(seed)
    sizes = blocked(rng)
    _, coupler, rocker, ground = sizes
    turn, side = rng.choice([360.0, 330.0, 700.0, -300.0]), rng.choice([-1.0, 1.0])
    r = da.kinematics(da.lifted(four_bar(sizes, starting(rng, sizes), turn, 37, side)))
    a, b = (r.point(*point)[r.ok] @ [1, 1j, 0] for point in (("crank", "A"), ("rocker", "B")))
    assert np.abs(b - meeting(a, coupler, ground, rocker, side)).max() < 1e-6
