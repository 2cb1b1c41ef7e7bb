"""Linkages that close in two separate ranges of the drive: both are solved, in the given mode and in any order.

Closed forms say where they close and where they then are.
"""

from __future__ import annotations

from math import acos, asin, degrees, pi, radians
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.arrays import Array
from dalembert.core.position.assembly_modes import NEAR
from tests.laws.test_branches import four_bar_tree, meeting
from tests.tiers import over

WIDE = 2
"""Positions of a range in space that is found: of up to 71 missing ones every second is tried."""

ORDERS = ("as listed", "descending", "random", "one position")


def listed(rng: np.random.Generator, angles: Array, order: str, other: float) -> Array:
    """Angles of the drive, degrees, in an order; or one of them alone, in the range that is not stated."""
    if order == "one position":
        return np.array([other])
    return {"as listed": angles, "descending": angles[::-1], "random": rng.permutation(angles)}[order]


def driven(tree: dict[str, Any], drive: str, angles: Array) -> Any:
    """The tree's kinematics at some angles of a drive, degrees."""
    values = [f"{float(angle)!r} deg" for angle in angles]
    tree["drives"] = {drive: {"position": values if len(values) > 1 else values[0]}}
    return da.kinematics(da.mechanism(tree))


def two_ranges(rng: np.random.Generator) -> tuple[tuple[float, float, float, float], float]:
    """Crank, coupler, rocker, ground of a four-bar that closes in two ranges, and an angle well within one, degrees."""
    while True:
        crank, coupler, rocker, ground = (float(x) for x in rng.uniform(0.5, 2, 4))
        if abs(coupler - rocker) > abs(ground - crank) + 0.05 and coupler + rocker < ground + crank - 0.05:
            break
    low, high = (
        degrees(acos((crank**2 + ground**2 - reach**2) / (2 * crank * ground)))
        for reach in (abs(coupler - rocker), coupler + rocker)
    )
    return (crank, coupler, rocker, ground), low + rng.uniform(0.2, 0.8) * (high - low)


@over(1, 150, block=4)
def test_a_four_bar_closes_in_both_its_ranges(seed: int) -> None:
    rng = np.random.default_rng(seed)
    sizes, start = two_ranges(rng)
    crank, coupler, rocker, ground = sizes
    side = float(rng.choice([-1.0, 1.0]))
    for order in ORDERS:
        tree = four_bar_tree(sizes, start, 360.0, 2, side)
        del tree["assembly"]["crank"]
        angles = listed(rng, start + 5.0 * np.arange(72), order, -start + rng.uniform(-3, 3))
        r = driven(tree, "O2", angles)
        a = crank * np.exp(1j * np.radians(angles))
        closes = (abs(a - ground) < coupler + rocker) & (abs(a - ground) > abs(coupler - rocker))
        np.testing.assert_array_equal(r.ok, closes, err_msg=order)
        b = r.point("rocker", "B") @ [1, 1j]
        # in the other range the stated angles imply the side only where it is clear, else the nearer mode is meant
        between = abs(radians(tree["assembly"]["coupler"] - tree["assembly"]["rocker"])) % pi
        clear = order in ("as listed", "descending") or 2 * NEAR < between < pi - 2 * NEAR
        off = [np.abs(b - meeting(a, coupler, ground, rocker, way))[closes].max() for way in (side, -side)]
        assert (off[0] if clear else min(off)) < 1e-6, order
        entered = r.mode is not None and "beyond a gap" in r.mode
        assert entered == (order != "one position")


@pytest.mark.parametrize("order", ORDERS[:3])
def test_a_range_is_found_however_few_of_the_positions_lie_in_it(order: str) -> None:
    """One of 623, at 345 degrees."""
    rng, once = np.random.default_rng(72), np.arange(25.0, 336.0)
    angles = listed(rng, np.concatenate([once, [345.0], once + 360]), order, 0.0)
    r = driven(four_bar_tree((1.0, 1.0, 1.0, 2.9), 10.0, 0.0, 1, 1.0), "O2", angles)
    np.testing.assert_array_equal(r.ok, angles == 345.0)


def meshing(tree: dict[str, Any]) -> None:
    """A wheel on the ground that the crank turns."""
    tree["links"]["ground"]["points"]["P"] = [-0.5, 0.0]
    tree["links"]["wheel"] = {"points": {"P": [0.0, 0.0]}}
    teeth = {"type": "gear", "links": ["crank", "wheel"], "at": ["O2", "P"], "radii": [0.25, 0.25]}
    tree["joints"] |= {"P": {"type": "pin", "links": ["ground", "wheel"]}, "teeth": teeth}


def rolling(tree: dict[str, Any]) -> None:
    """A wheel that the rocker's rod rolls along the ground."""
    tree["links"]["ground"]["points"]["L"] = [0.0, -3.5]
    tree["links"] |= {"rod": {"points": {"B": [0, 0], "Q": [3.5, 0]}}, "wheel": {"points": {"Q": [0, 0]}}}
    line = {"type": "rolling", "links": ["ground", "wheel"], "at": ["L", "Q"], "direction": 0, "radius": 0.5}
    pins = {"B2": ["rocker", "rod"], "Q": ["rod", "wheel"]}
    tree["joints"] |= {name: {"type": "pin", "links": links, "at": name[0]} for name, links in pins.items()}
    tree["joints"]["line"] = line
    tree["assembly"]["rod"] = -90


@pytest.mark.parametrize(("wheel", "seed"), [(meshing, 3), (rolling, 2)])
def test_a_range_is_found_in_a_list_in_any_order_with_wheels_that_have_a_phase(wheel: Any, seed: int) -> None:
    """9 of 72 positions close, in a range on each side of the gap."""
    tree = four_bar_tree((1.0, 1.0, 1.0, 2.9), 10.0, 0.0, 1, 1.0)
    wheel(tree)
    angles = np.random.default_rng(seed).permutation(5.0 * np.arange(72))
    r = driven(tree, "O2", angles)
    np.testing.assert_array_equal(r.ok, np.cos(np.radians(angles)) > 5.41 / 5.8)
    travel = -angles if wheel is meshing else -np.degrees(r.point("wheel", "Q")[:, 0] / 0.5)
    assert np.nanmax(np.abs(np.ptp((np.degrees(r.angle("wheel")) - travel)[r.ok]))) < 1e-9


@pytest.mark.long
def test_all_ranges_of_two_drives_are_found_however_many_gaps_lie_between_them() -> None:
    rng = np.random.default_rng(3)
    turns = [x.ravel() for x in np.meshgrid(np.arange(0.0, 360.0, 30.0), np.arange(0.0, 360.0, 45.0))]
    order = rng.permutation(len(turns[0]))
    tree = four_bar_tree((1.0, 1.0, 1.0, 2.9), 10.0, 0.0, 1, 1.0)
    tree["links"]["second"] = {"points": {"O4": [0.0, 0.0], "C": [0.3, 0.0]}}
    tree["links"]["rocker"]["points"]["C"] = [0.0, 0.0]
    tree["joints"]["O4"] = {"type": "pin", "links": ["ground", "second"]}
    tree["joints"]["C"] = {"type": "pin", "links": ["second", "rocker"]}
    tree["drives"] = {
        name: {"position": turn[order].tolist()} for name, turn in zip(("O2", "O4"), turns, strict=True)
    }
    r = da.kinematics(da.mechanism(tree))
    ends = np.exp(1j * np.radians(turns[0][order])), 2.9 + 0.3 * np.exp(1j * np.radians(turns[1][order]))
    np.testing.assert_array_equal(r.ok, np.abs(ends[1] - ends[0]) < 2)


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("order", ORDERS[1::2])
def test_a_slider_crank_whose_rod_is_short_closes_in_both_its_ranges(order: str, side: float) -> None:
    rng, radius, rod, offset = np.random.default_rng(1), 1.0, 0.6, 0.1
    lean = degrees(asin(offset / rod))
    tree: dict[str, Any] = {
        "links": {
            "ground": {"points": {"O": [0.0, 0.0], "G": [0.0, offset]}},
            "crank": {"points": {"O": [0.0, 0.0], "A": [radius, 0.0]}},
            "rod": {"points": {"A": [0.0, 0.0], "B": [rod, 0.0]}},
            "block": {"points": {"B": [0.0, 0.0]}},
        },
        "joints": {
            "O": {"type": "pin", "links": ["ground", "crank"]},
            "A": {"type": "pin", "links": ["crank", "rod"]},
            "B": {"type": "pin", "links": ["rod", "block"]},
            "G": {"type": "slider", "links": ["ground", "block"], "at": ["G", "B"], "direction": 0.0},
        },
        "assembly": {"rod": lean if side > 0 else 180 - lean},
    }
    angles = listed(rng, 5.0 * np.arange(72), order, 187.0)
    r = driven(tree, "O", angles)
    a = radius * np.exp(1j * np.radians(angles))
    closes = np.abs(a.imag - offset) < rod
    np.testing.assert_array_equal(r.ok, closes)
    reach = np.sqrt(rod**2 - (a.imag - offset)[closes] ** 2)
    np.testing.assert_allclose(r.point("block", "B")[closes, 0], a.real[closes] + side * reach, atol=1e-6)


@over(1, 100, block=4)
def test_the_second_group_of_a_six_bar_closes_in_two_ranges(seed: int) -> None:
    """The rocker swings; arm and lever close only where its end is neither too near to their pivot nor too far."""
    rng, sizes, turn = np.random.default_rng(seed), (0.5, 1.5, 1.2, 1.4), 5.0 * np.arange(72)
    crank, coupler, rocker, ground = sizes
    first, second = (float(side) for side in rng.choice([-1.0, 1.0], 2))
    b = meeting(crank * np.exp(1j * np.radians(turn)), coupler, ground, rocker, first)
    pivot = complex(ground + rng.uniform(-1, 1), rng.uniform(-1, 1))
    reach = np.quantile(np.abs(b - pivot), rng.uniform(0.6, 0.9))
    p = float(reach * rng.uniform(0.3, 0.7))
    q = float(reach - p)
    closes = (np.abs(b - pivot) < p + q) & (np.abs(b - pivot) > abs(p - q))
    start = int(rng.choice(np.flatnonzero(closes)))
    c = meeting(b, p, pivot, q, second)
    tree = four_bar_tree(sizes, float(turn[start]), 360.0, 2, first)
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
    way = degrees(float(np.angle(c[start] - b[start]))), degrees(float(np.angle(c[start] - pivot)))
    tree["assembly"] |= dict(zip(("arm", "lever"), way, strict=True))
    r = driven(tree, "O2", np.roll(turn, -start))
    np.testing.assert_array_equal(r.ok, np.roll(closes, -start))
    off = r.point("lever", "C") @ [1, 1j] - np.roll(c, -start)
    assert np.abs(off)[r.ok].max() < 1e-6


@over(0, 25, block=3)
def test_an_rssr_closes_in_both_its_ranges(seed: int) -> None:
    """The end of the rocker is where its circle cuts the sphere about the crank's end."""
    rng, turn = np.random.default_rng(seed), 2 * pi * np.arange(72) / 72
    while True:
        crank, rod, rocker = (float(x) for x in rng.uniform(0.5, 2, 3))
        pivot, axis = rng.uniform(-1.5, 1.5, 3), rng.normal(size=3)
        axis /= np.linalg.norm(axis)
        u = np.cross(axis, [0.0, 0.0, 1.0])
        u /= np.linalg.norm(u)
        v = np.cross(axis, u)
        w = np.stack([crank * np.cos(turn), crank * np.sin(turn), 0 * turn], axis=-1) - pivot
        cosine = (rocker**2 + (w * w).sum(axis=-1) - rod**2) / (2 * rocker * np.hypot(w @ u, w @ v))
        closes = np.abs(cosine) < 1
        ends = np.flatnonzero(np.roll(closes, -1) != closes)
        if len(ends) == 4 and np.diff(ends).min() >= WIDE and np.abs(np.abs(cosine) - 1).min() > 1e-3:
            break
    r = da.kinematics(da.mechanism(rssr_tree(crank, rod, rocker, pivot, axis, u)))
    np.testing.assert_array_equal(r.ok, closes)
    arm = r.point("rocker", "B")[closes] - pivot
    found = np.angle(np.exp(1j * (np.arctan2(arm @ v, arm @ u) - np.arctan2(w @ v, w @ u)[closes])))
    side = np.sign(found)
    np.testing.assert_allclose(np.abs(found), np.arccos(cosine[closes]), atol=1e-6)
    assert (side == side[0]).all()


def rssr_tree(
    crank: float, rod: float, rocker: float, pivot: Array, axis: Array, arm: Array
) -> dict[str, Any]:
    ends = {
        "O": ["ground", "crank"],
        "A": ["crank", "rod"],
        "B": ["rod", "rocker"],
        "G": ["ground", "rocker"],
    }
    kinds = {
        "O": {"type": "revolute", "axis": [0.0, 0.0, 1.0]},
        "G": {"type": "revolute", "axis": axis.tolist()},
    }
    return {
        "space": "space",
        "links": {
            "ground": {"points": {"O": [0.0, 0.0, 0.0], "G": pivot.tolist()}},
            "crank": {"points": {"O": [0.0, 0.0, 0.0], "A": [crank, 0.0, 0.0]}},
            "rod": {"points": {"A": [0.0, 0.0, 0.0], "B": [rod, 0.0, 0.0]}},
            "rocker": {"points": {"G": [0.0, 0.0, 0.0], "B": (rocker * arm).tolist()}},
        },
        "joints": {
            name: {"links": links} | kinds.get(name, {"type": "spherical"}) for name, links in ends.items()
        },
        "drives": {"O": {"position": {"from": 0.0, "to": 360.0, "count": 72}}},
    }


@pytest.mark.long
@over(1, 15, block=2)
def test_a_lifted_four_bar_closes_where_the_plane_one_does(seed: int) -> None:
    """Its constraints repeat each other: independent ones are chosen, which tell the sides."""
    rng = np.random.default_rng(seed)
    sizes, start = two_ranges(rng)
    m = da.mechanism(four_bar_tree(sizes, start, 360.0, 72, 1.0))
    plane, lifted = da.kinematics(m), da.kinematics(da.lifted(m))
    np.testing.assert_array_equal([s == "not_assembled" for s in lifted.status], ~plane.ok)
    off = lifted.point("rocker", "B")[:, :2] - plane.point("rocker", "B")
    assert np.abs(off[plane.ok]).max() < 1e-6
