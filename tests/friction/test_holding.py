"""What friction can hold at rest for some history, beyond the efforts at which motion impends."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.core.friction import holding_range
from dalembert.core.friction.linear_programmes import furthest
from dalembert.pages.page_data import page_data
from tests.friction.engines import engine, pushed_slider
from tests.friction.oracle import resting
from tests.friction.rough import still_tree
from tests.random_mechanisms import pose_array, random_mechanism
from tests.tiers import tiers


def wedge(floor: float, wall: float, slope: float, below: float = 20.0, above: float = 50.0) -> Any:
    """Block A on a floor, pushed along it; B on a wall comes down A's smooth slope as A goes forward."""
    rubbing = {
        name: {
            "type": "slider",
            "links": ["ground", link],
            "at": ["O", "P"],
            "direction": way,
            "friction": {"coefficient": mu},
        }
        for name, link, way, mu in (("floor", "A", 0.0, floor), ("wall", "B", 90.0, wall))
    }
    return da.mechanism(
        {
            "units": {"angle": "deg"},
            "links": {
                "ground": {"points": {"O": [0, 0]}},
                "A": {"points": {"P": [0, 0]}},
                "B": {"points": {"P": [0, 0]}},
            },
            "joints": {
                **rubbing,
                "top": {"type": "slot", "links": ["A", "B"], "at": ["P", "P"], "direction": slope},
            },
            "drives": {"floor": {"position": 0.1, "speed": 0.0}},
            "loads": {
                "W_A": {"type": "force", "on": "A", "at": "P", "value": [0, -below]},
                "W_B": {"type": "force", "on": "B", "at": "P", "value": [0, -above]},
            },
        }
    )


def wedge_effort(floor: float, wall: float, slope: float, below: float = 20.0, above: float = 50.0) -> float:
    """Push with friction floor N on A against it, and wall N' down on B; either may be negative.

    B carries V = above + wall N', with N' = V tan(slope): the slope pushes A back with V tan(slope) (it comes down),
    and the floor bears below + V.
    """
    tan = np.tan(np.radians(slope))
    v = above / (1 - wall * tan)
    return float(floor * (below + v) - v * tan)


@pytest.mark.parametrize(("floor", "wall", "slope"), [(0.6, 0.5, 20.0), (0.2, 0.5, 30.0), (0.9, 0.3, 40.0)])
def test_a_wedge_holds_more_after_it_came_back(
    floor: float, wall: float, slope: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Going forward B comes down and the wall carries a part of it; after going back the wall presses it down."""
    programmes: list[object] = []
    monkeypatch.setattr(
        holding_range, "furthest", lambda *given: programmes.append(given) or furthest(*given)
    )
    r = da.statics(wedge(floor, wall, slope))
    assert len(programmes) <= 6  # no more once nothing is gained
    forward, back = wedge_effort(floor, -wall, slope), wedge_effort(-floor, wall, slope)
    assert r.interval("floor")[0] == pytest.approx((back, forward), rel=1e-12)
    pressed = max(forward, wedge_effort(floor, wall, slope))
    assert r.holding("floor")[0] == pytest.approx((back, pressed), rel=1e-12)
    assert (pressed > forward) == (floor > np.tan(np.radians(slope)))


def test_coefficients_at_rest_hold_also_where_what_moves_is_smooth() -> None:
    """Smooth in motion, and at rest with the coefficients of the wedge above, it holds what that one holds."""
    tree = wedge(0.6, 0.5, 20.0).to_tree()
    for name, mu in (("floor", 0.6), ("wall", 0.5)):
        tree["joints"][name]["friction"] = {"coefficient": 0.0, "static": mu}
    r, alike = da.statics(da.mechanism(tree)), da.statics(wedge(0.6, 0.5, 20.0))
    assert r.holding("floor") == pytest.approx(alike.holding("floor"), rel=1e-12)
    assert r.interval("floor") == pytest.approx(alike.interval("floor"), rel=1e-12)


def test_a_wedge_that_locks_holds_any_effort() -> None:
    """wall tan(slope) > 1: the wall's friction presses B on more than its force on the wall asks."""
    r = da.statics(wedge(1.5, 1.3, 40.0))
    low, high = r.interval("floor")[0]
    assert np.isnan(low)
    assert high == pytest.approx(wedge_effort(1.5, -1.3, 40.0), rel=1e-12)
    assert r.holding("floor")[0].tolist() == [-np.inf, np.inf]


def test_where_one_contact_rubs_motion_impends_at_the_ends() -> None:
    """Block on an incline: P = Q tan(angle +- phi) at both, whatever happened before; the engine too."""
    for mu in (0.3, 0.9):
        low, high = (100 * np.sqrt(2) / (1 + k * mu) for k in (1, -1))
        r = da.statics(pushed_slider(mu, speed=0.0))
        assert r.holding("rod")[0] == pytest.approx((low, high), rel=1e-12)
        assert r.interval("rod")[0] == pytest.approx((low, high), rel=1e-12)
    r = da.statics(engine(speed=0.0))
    assert np.array_equal(r.holding("O"), r.interval("O"))
    moving = da.statics(engine())
    assert np.array_equal(moving.holding("O"), np.stack([moving.effort("O")] * 2, axis=-1))


BEYOND = {23: "low", 34: "low", 27: "high", 58: "high", 49: "low"}
"""Random mechanisms of one drive and 3 to 6 contacts, and on which side more holds than at impending motion."""


@pytest.mark.parametrize("seed", tiers([23, 34], [27, 58, 49]))
def test_states_of_an_independent_solution_fill_what_holds(seed: int) -> None:
    """Of 30 states from the Lagrange equations none lies outside, and one where every contact is at its limit is the
    very end that lies beyond impending motion."""
    tree = still_tree(seed, 0.3)
    r = da.statics(da.mechanism(tree))
    found = resting(tree, pose_array(random_mechanism(seed, (2, 8))), 30, 1)
    for drive, efforts in found.items():
        assert len(efforts) == 30
        (low, high), (start, stop) = r.holding(drive)[0], r.interval(drive)[0]
        room = 1e-9 * np.abs(r.holding(drive)).max()
        assert low - room <= efforts.min()
        assert efforts.max() <= high + room
        lower = BEYOND[seed] == "low"
        outer, end, inner = (low, efforts.min(), start) if lower else (high, efforts.max(), stop)
        assert end == pytest.approx(outer, abs=room)
        assert abs(outer - inner) > 1e3 * room


def test_what_holds_beyond_impending_motion_is_said() -> None:
    r = da.statics(wedge(0.6, 0.5, 20.0))
    said = (
        "Motion impends at -70.9213 N and 21.9845 N; with friction as an earlier motion may have left it, "
        "floor can hold from -70.9213 N to 26.427 N."
    )
    assert str(r.reasons[0]).endswith(said)
    assert said in " ".join(str(r).split())
    (position,) = r.to_dict()["positions"]
    assert position["effort"]["floor"] == pytest.approx(r.interval("floor")[0])
    assert position["holding"]["floor"] == pytest.approx(r.holding("floor")[0])
    assert "after some earlier motions friction can hold −70.92 to 26.43 N" in str(da.report(r))
    locked = da.statics(wedge(1.5, 1.3, 40.0))
    assert str(locked.reasons[0]).endswith("floor can hold any value, its contacts wedged.")
    assert locked.to_dict()["positions"][0]["holding"] == {"floor": [None, None]}
    assert (
        "holding" not in da.statics(wedge(0.6, 0.5, 20.0).with_values({"drives.floor.speed": 1.0})).to_dict()
    )


@pytest.mark.parametrize(("floor", "wall", "slope", "says"), [
    (0.3, 0.0, 10.0, "any value of floor between the two impending motions holds the machine; at both ends friction is "
     "at its limit in floor."),
    (0.3, 1.3, 40.0, "any value of floor up to the high end holds the machine; at the low end no value is large enough "
     "to move the mechanism in this sense; at the high end friction is at its limit in floor, wall."),
])  # fmt: skip
def test_what_is_said_of_a_wedge_at_rest(floor: float, wall: float, slope: float, says: str) -> None:
    r = da.statics(wedge(floor, wall, slope))
    low, high = r.interval("floor")[0]
    assert r.reasons == ("At rest at floor = 0.1 m: " + says,)
    assert high == pytest.approx(wedge_effort(floor, -wall, slope), rel=1e-12)
    if wall:
        assert (np.isnan(low), r.holding("floor")[0, 0]) == (True, -np.inf)
    else:
        assert low == pytest.approx(wedge_effort(-floor, wall, slope), rel=1e-12)


def test_what_holds_beyond_is_counted_over_positions() -> None:
    m = wedge(0.6, 0.5, 20.0).with_values({"drives.floor.position": [0.1, 0.2, 0.3]})
    said = (
        "After some earlier motions friction can hold values of floor beyond them at each of these positions."
    )
    assert str(da.statics(m).reasons[0]).endswith(said)
    bare = m.with_values({"loads.W_B.value": [0, "500 * (floor - 0.3)"]})  # nothing presses the wall at 0.3
    assert str(da.statics(bare).reasons[0]).endswith(said.replace("each of these", "2 of these 3"))


@pytest.mark.parametrize("n", [1, 2, 4, 7])
def test_linear_programmes(n: int) -> None:
    """Those of scipy, one by one; a third have no bound, a third of the limits are 0."""
    from scipy.optimize import linprog

    rng = np.random.default_rng(n)
    g, q = rng.normal(size=(30, 2 * n + 1, n)), rng.normal(size=(30, n))
    h = rng.uniform(0, 1, (30, 2 * n + 1)) * (rng.random((30, 2 * n + 1)) < 2 / 3)
    d, unbounded = furthest(g, h, q)
    assert np.all(np.einsum("bmn,bn->bm", g, d) <= h + 1e-9)
    assert 0 < unbounded.sum() < 30
    for k in range(30):
        found = linprog(-q[k], A_ub=g[k], b_ub=h[k], bounds=(None, None))
        assert unbounded[k] == (found.status == 3)
        if not unbounded[k]:
            assert q[k] @ d[k] == pytest.approx(-found.fun, abs=1e-9)


@pytest.mark.parametrize("turned", [0.0, 41.0])
def test_a_contact_that_would_not_move_takes_the_sense_that_carries_furthest(turned: float) -> None:
    """B is pressed on the wall by Q and stands on A's level top: floor (20 + 50 + wall Q) both ways, also aslant."""
    tree = wedge(0.6, 0.5, 0.0).to_tree()
    for joint, way in (("floor", 0.0), ("wall", 90.0)):  # A turns with its slide, and its top with it
        tree["joints"][joint]["direction"] = f"{way + turned} deg"
    c, s = np.cos(np.radians(turned)), np.sin(np.radians(turned))
    pull = {"W_A": ("A", 0.0, -20.0), "W_B": ("B", 0.0, -50.0), "Q": ("B", 30.0, 0.0)}
    tree["loads"] = {
        name: {"type": "force", "on": link, "at": "P", "value": [c * x - s * y, s * x + c * y]}
        for name, (link, x, y) in pull.items()
    }
    r = da.statics(da.mechanism(tree))
    most = 0.6 * (20 + 50 + 0.5 * 30)
    assert r.interval("floor")[0] == pytest.approx((-most, most), rel=1e-12)
    assert r.holding("floor")[0] == pytest.approx((-most, most), rel=1e-12)


TRUSS_ON_AN_ARM = """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], A: [0.5, 0], B: [0.5, 0.4]}, mass: 2 kg, center: [0.3, 0.1]}
  p: {points: {A: [0, 0], C: [0.4, 0]}, mass: 1 kg, center: [0.2, 0]}
  q: {points: {B: [0, 0], C: [0.5, 0]}, mass: 1 kg, center: [0.2, 0.05]}
joints:
  O: {type: pin, links: [ground, arm]}
  A: {type: pin, links: [arm, p], RUB}
  B: {type: pin, links: [arm, q], RUB}
  C: {type: pin, links: [p, q], RUB}
drives: {O: {position: 20 deg, speed: 2 rad/s, acceleration: 1 rad/s^2}}
assembly: {arm: 20, p: 40, q: -20}
"""


def test_an_effort_that_no_friction_changes_is_one_value() -> None:
    """Two bars and an arm are rigid together: friction of their pins is inside, and the torque of the arm is that
    without it."""
    rough = da.dynamics(
        da.loads(TRUSS_ON_AN_ARM.replace("RUB", "friction: {coefficient: 0.2, radius: 10 mm}"))
    )
    smooth = da.dynamics(da.loads(TRUSS_ON_AN_ARM.replace("RUB", "")))
    assert rough.status == ("at_rest",)
    assert rough.interval("O")[0] == pytest.approx([smooth.effort("O")[0]] * 2, rel=1e-12)
    assert rough.reasons == (
        "No relative motion in A, B, C at O = 20 deg: their friction may have any value within the limits, "
        "and O does not depend on it.",
    )
    assert "17.6549 N*m\n" in rough.text()
    for end in rough.ends[0]:
        for joint in "OABC":
            assert end.reaction(joint)[0] == pytest.approx(smooth.reaction(joint)[0], rel=1e-9)
        assert not np.nan_to_num(end.friction.moment).any()


def test_a_page_says_so_too() -> None:
    """The template of the page is filled there; it is told which unknowns have one value."""
    rough = da.loads(TRUSS_ON_AN_ARM.replace("RUB", "friction: {coefficient: 0.2, radius: 10 mm}"))
    known = {u["name"]: u for u in page_data(rough)["sentences"]["unknowns"]}
    assert known["O"]["single"]
