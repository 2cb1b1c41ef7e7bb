"""Limits in the solution of friction: rates that are rounding, roots at the ends of a bracket, programmes at a corner;
against closed forms and laws of scale."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import linprog

import dalembert as da
from dalembert.analysis.friction.self_help import _coefficient
from dalembert.core.equilibrium import LinkMotions
from dalembert.core.friction.capstan import capstan
from dalembert.core.friction.contact_equations import (
    ContactResponse,
    SlipState,
    _below,
    argument,
    bearing,
    group_moves,
    impending_senses,
    sign,
    slope,
    strength,
    zero_crossings,
)
from dalembert.core.friction.friction_solver import _goes_on, newton, solve_friction, without_friction
from dalembert.core.friction.linear_programmes import furthest
from dalembert.core.friction.reversal import ASIDE, _moment
from dalembert.core.friction.rod_spin import STEEPEST, _bracket_root, solve_spins
from dalembert.core.friction.spectral_bound import spectral_bound

NAN = math.nan


def contacts(count: int, **keys: Any) -> Any:
    """Contacts of one kind each: forces of two components, alone, led by themselves; else as the keys say."""
    every: dict[str, Any] = {
        **{name: np.zeros(count, bool) for name in ("ball", "signed", "fixed", "circle", "wound", "around")},
        **{name: np.zeros(count) for name in ("wrap", "blocks")},
        **{name: np.ones(count) for name in ("lever", "reckoned", "coefficient", "resting")},
        **{name: np.arange(count) for name in ("leader", "group", "joint")},
    } | {name: np.array(value) for name, value in keys.items()}
    rows = SimpleNamespace(angular=every.pop("angular", np.zeros(count, bool)))
    return SimpleNamespace(count=count, rows=rows, grouped=len(np.unique(every["group"])) < count, **every)


def response(y: Any, h: Any) -> ContactResponse:
    """The response with arguments y (P, 3, E) and H (P, 3, E, E); every multiplier is a force."""
    y, h = np.array(y, float), np.array(h, float)
    return ContactResponse(np.ones((len(y), 2)), np.ones((1, 2, y.shape[-1])), y, h)


@pytest.mark.parametrize("size", [1e-100, 1e-20, 1.0, 1e20])
@pytest.mark.parametrize("mu", [0.0, 0.3, 0.9])
def test_a_block_pressed_by_its_own_friction_has_its_closed_form_at_any_size(size: float, mu: float) -> None:
    """S = |N + k c z| against the slip s: z = -s N / (1 + s k c), by the determinant 1 + s k c; and two contacts with
    forces of two components that press each other do the same at any size of the forces."""
    for s, k in ((1.0, 0.5), (-1.0, 0.5), (1.0, -0.5)):
        r = response([[[3 * size], [0.0], [0.0]]], [[[[k]], [[0.0]], [[0.0]]]])
        found = newton(contacts(1), r, np.array([[s]]), np.array([[mu]]), np.zeros((1, 1)))
        assert found.arrived.tolist() == [True]
        assert found.z / size == pytest.approx(np.array([[-3 * s / (1 + s * k * mu)]]), rel=1e-13)
        assert found.determinant == pytest.approx([1 + s * k * mu])
    h = np.zeros((1, 3, 2, 2))
    h[0, 0], h[0, 1] = [[0.1, 0.4], [-0.3, 0.2]], [[0.3, -0.2], [0.5, 0.1]]
    y = np.array([[[3.0, -1.0], [0.5, 2.0], [0.0, 0.0]]])
    for one in (np.ones((1, 2)), -np.ones((1, 2)), np.array([[1.0, -1.0]])):
        found = newton(contacts(2), response(y * size, h), one, mu * abs(one), np.zeros((1, 2)))
        like = newton(contacts(2), response(y, h), one, mu * abs(one), np.zeros((1, 2)))
        assert found.z / size == pytest.approx(like.z, rel=1e-11)
        left = y[0] + (h[0] @ (mu * like.z[0]))
        assert -one[0] * like.z[0] == pytest.approx(np.hypot(left[0], left[1]), rel=1e-12)


def test_positions_of_a_batch_are_solved_as_each_alone_and_loads_that_are_nothing_do_not_count() -> None:
    """One that is linear, one that is not, one without a load; beside -1 N a contact with 1e-20 N has no part in the
    determinant, which is then that of the other, 1 + 0.5 mu."""
    h = np.zeros((3, 3, 2, 2))
    h[:, 0] = np.diag([0.5, 0.5])
    h[1, 1] = [[0.3, -0.2], [0.5, 0.1]]
    y = np.array([[[-1.0, 1e-20], [0, 0], [0, 0]], [[3.0, -1.0], [0.5, 2.0], [0, 0]], np.zeros((3, 2))])
    sense, c = np.array([[-1.0, 1.0]] * 3), np.full((3, 2), 0.4)
    found = newton(contacts(2), response(y, h), sense, c, np.zeros((3, 2)))
    assert found.arrived.all()
    assert found.z[[0, 2]] == pytest.approx(np.array([[1 / 1.2, 0.0], [0.0, 0.0]]))
    assert found.determinant[0] == pytest.approx(1.2, rel=1e-5)
    for k in range(3):
        alone = newton(contacts(2), response(y[[k]], h[[k]]), sense[[k]], c[[k]], np.zeros((1, 2)))
        assert alone.z == pytest.approx(found.z[[k]], rel=1e-12)
        near = newton(
            contacts(2),
            response(y[[k]], h[[k]]),
            sense[[k]],
            c[[k]],
            alone.z,
            argument(response(y[[k]], h[[k]]), 0.4 * alone.z),
        )
        assert near.near.tolist() == [True]
        assert near.z == pytest.approx(alone.z, rel=1e-12)


@pytest.mark.parametrize("mu", [0.0, 0.9, 1.25, 2.0, 8.0])
@pytest.mark.parametrize("size", [1e-12, 3.0])
def test_friction_that_presses_its_own_contact_jams_from_a_coefficient_on(mu: float, size: float) -> None:
    """N + mu z = z with z = S: N / (1 - mu); it ends where the coefficients have grown to 1."""
    c = contacts(1, coefficient=[mu], resting=[3.0])
    r = response([[[size], [0.0], [0.0]]], [[[[-1.0]], [[0.0]], [[0.0]]]])
    for sense in (1.0, -1.0):
        s = solve_friction(c, r, SlipState(np.array([[sense]]), np.array([[False]]), np.array([[sense]])))
        if sense * mu < 1:
            assert s.z == pytest.approx(np.array([[-sense * size / (1 - sense * mu)]]))
            assert np.isnan(s.critical).all()
            assert s.x == pytest.approx(1 + mu * s.z * np.ones((1, 2)))
            assert s.determinant == pytest.approx([1 - sense * mu])
            assert s.single[0] == (mu < 1)
            assert s.locked.tolist() == [False]
        else:
            assert s.critical == pytest.approx([1 / mu], abs=2e-9)
            assert np.isnan(s.z).all()
    one = contacts(1, coefficient=[1.0])
    bound = solve_friction(one, r, SlipState(np.array([[-1.0]]), np.array([[False]]), np.array([[-1.0]])))
    assert bound.z == pytest.approx(np.array([[size / 2]]))
    assert bound.single.tolist() == [False]  # at 1 nothing is proved
    rest = solve_friction(c, r, SlipState(np.array([[1.0]]), np.array([[True]]), np.zeros((1, 1))))
    assert rest.critical == pytest.approx([1 / 3], abs=2e-9)


WEDGE = """
links:
  ground: {points: {O: [0, 0]}}
  up: {points: {A: [0, 0]}}
  rod: {points: {A: [0, 0], B: [1.4142135623730951, 0]}}
  side: {points: {B: [0, 0]}}
joints:
  V: {type: slider, links: [ground, up], at: [O, A], direction: 90}
  A: {type: pin, links: [up, rod]}
  B: {type: pin, links: [rod, side]}
  H: {type: slider, links: [ground, side], at: [O, B], direction: 0, friction: {coefficient: MU}}
drives: {V: {position: [1.0], speed: -1}}
loads: {F: {type: force, on: side, at: B, value: [-3, 0]}}
assembly: {rod: -45}
"""


@pytest.mark.parametrize(
    ("mu", "jams"),
    [(0.5, False), (1 - 1e-6, False), (1 - 1e-8, False), (1 - 1e-11, True), (1.0, True), (1.2, True)],
)
def test_beside_the_coefficient_that_jams_no_huge_force_is_answered(mu: float, jams: bool) -> None:
    """A rod at 45 deg pushes a block: F / (1 - mu); at 1 rounding alone would decide what comes out."""
    m = da.loads(WEDGE.replace("MU", repr(mu)))
    kernel = da.compile(m, ["joints.H.friction.coefficient"], ["effort.V"])([[mu], [0.25]])
    for r in (da.statics(m), da.statics(m, method="careful")):
        assert r.status == (("jammed",) if jams else ("ok",))
        assert tuple(kernel.status[0]) == r.status
        for effort in (r.effort("V"), kernel["effort.V"][0]):
            expected = math.nan if jams else -3 / (1 - mu)
            assert effort == pytest.approx([expected], rel=1e-15 / (1 - mu) if mu < 1 else 0, nan_ok=True)
    assert kernel["effort.V"][1] == pytest.approx([-4])


def test_forces_that_grow_in_many_stages_are_answered() -> None:
    """Ten contacts, each pressed by the one before and by itself with 0.9: 10^10 in all, nearly all digits are left."""
    count = 10
    h = np.zeros((1, 3, count, count))
    h[0, 0] = -np.eye(count) - np.eye(count, k=-1)
    y = np.zeros((1, 3, count))
    y[0, 0, 0] = 1.0
    c = contacts(count, coefficient=[0.9] * count)
    s = solve_friction(
        c, response(y, h), SlipState(np.ones((1, count)), np.zeros((1, count), bool), np.ones((1, count)))
    )
    assert s.determinant == pytest.approx([1e-10])
    assert s.z[0] == pytest.approx([-10.0 * 9.0**k for k in range(count)], rel=1e-12)


def test_without_friction_the_separation_of_teeth_stays() -> None:
    """A fixed contact has strength 1 at any scale: z = N / (1 - k); the others have none."""
    r = response(
        [[[3.0, 5.0], [0.0, 0.0], [0.0, 0.0]]],
        [np.pad([[[0.25, 0.0], [0.0, 0.0]]], ((0, 2), (0, 0), (0, 0)))],
    )
    assert without_friction(contacts(2), r) is r.x
    for fixed, added in (([True, False], 4.0), ([True, True], 9.0)):
        x = without_friction(contacts(2, fixed=fixed), r)
        assert x == pytest.approx(np.array([[1 + added, 1 + added]]))


@pytest.mark.parametrize(
    ("first", "more", "end", "near"),
    [
        *(
            (1.0, 0.19, 1.19, True),
            (1.0, 0.21, 1.21, False),
            (-1.0, -0.19, 1.19, True),
            (1.0, -0.21, 0.79, False),
        ),
        *(
            (4e-4, 5e-4, 1.0, True),
            (5e-4, 6e-4, 1.0, False),
            (4e-4, -5e-4, -1.0, True),
            (0.0, 0.0, 0.0, True),
        ),
    ],
)
def test_a_branch_goes_on_where_newton_ends_within_a_fifth_of_its_first_step_or_hardly_moves(
    first: float, more: float, end: float, near: bool
) -> None:
    start = end - first - more
    way = [np.array([[x, 0.0]]) for x in (start, start + first, end)]
    assert _goes_on(*way).tolist() == [near]
    assert _goes_on(*(x[:, ::-1] for x in way)).tolist() == [near]


def test_the_bound_of_a_positive_matrix_is_its_largest_sum_where_all_sums_are_equal() -> None:
    """|h| of one contact; rows of equal sums; and within a few per cent above the largest eigenvalue."""
    for part in (0, 1, 2):
        h = np.zeros((2, 3, 2, 2))
        h[0, part], h[1, part] = [[0.5, -0.25], [-0.5, 0.25]], [[0.0, 3.0], [-3.0, 0.0]]
        assert spectral_bound(contacts(2), response(np.ones((2, 3, 2)), h)) == pytest.approx([0.75, 3.0])
    h = np.zeros((1, 3, 2, 2))
    h[0, 0] = [[2.0, 0.1], [0.3, 0.5]]
    largest = 1.25 + math.hypot(0.75, math.sqrt(0.03))
    assert largest <= spectral_bound(contacts(2), response(np.ones((1, 3, 2)), h))[0] <= 1.01 * largest
    nothing = spectral_bound(contacts(2), response(np.ones((1, 3, 2)), 0 * h))
    assert nothing[0] < 1e-100
    h[0] = [np.diag([-3.0, -3.0]), np.diag([4.0, 4.0]), np.diag([12.0, 4.0])]
    for keys, bound in (
        ({}, 12.0),
        ({"ball": [True, True]}, 13.0),
        ({"ball": [True, False]}, 13.0),
        ({"signed": [True, True]}, 3.0),
    ):
        some = contacts(2, **keys)
        assert spectral_bound(some, response(np.ones((1, 3, 2)), h)) == pytest.approx([bound], rel=1e-2)


def test_the_bearing_force_is_the_larger_of_the_force_and_the_tilt_and_has_its_slope() -> None:
    """Of (3, 4) 5, of a tilt of -6 beside it 6; of a guide's faces the force with its sign; of a ball the length."""
    y = np.array([[3.0, 3.0, 3.0, -3.0], [4.0, 4.0, 4.0, 4.0], [2.0, -6.0, 5.0, 12.0]])
    plain = contacts(4)
    assert bearing(plain, y).tolist() == [5.0, 6.0, 5.0, 12.0]
    steep, size = slope(plain, y, np.array(12.0))
    assert size.tolist() == [5.0, 6.0, 5.0, 12.0]
    assert pytest.approx(np.array([[0.6, 0.8, 0], [0, 0, -1], [0.6, 0.8, 0], [0, 0, 1]])) == steep.T
    faces = contacts(4, signed=[True, False, False, True])
    assert bearing(faces, y).tolist() == [3.0, 6.0, 5.0, -3.0]
    steep, size = slope(faces, y, np.array(12.0))
    assert size.tolist() == [3.0, 6.0, 5.0, -3.0]
    assert steep.T[[0, 3]].tolist() == [[1, 0, 0], [1, 0, 0]]
    balls = contacts(4, ball=[False, True, True, True])  # the first has two components
    assert bearing(balls, y) == pytest.approx([5.0, math.sqrt(61), math.sqrt(50), 13.0])
    steep, size = slope(balls, y, np.array(12.0))
    assert size == pytest.approx([5.0, math.sqrt(61), math.sqrt(50), 13.0])
    assert steep.T[3] == pytest.approx(np.array([-3.0, 4.0, 12.0]) / 13)
    assert steep.T[0] == pytest.approx([0.6, 0.8, 0.0])
    for keys in (
        {},
        {"ball": [True]},
        {"signed": [True]},
    ):  # of a load that is nothing: hardly any
        for force, length in ((1e-13, 1.0), (1e-14, 1.0), (1e-15, 0.1), (-1e-15, 0.1)):
            here = np.array([[force], [0.0], [0.0]])
            (found,) = slope(contacts(1, **keys), here, np.array(1.0))[0].T
            assert abs(found[0]) == pytest.approx(1.0 if "signed" in keys else length, rel=1e-9)


LAYOUT: Any = SimpleNamespace(length=2.0, wrench_scale=np.array([1.0, 1.0, 0.5]))


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_rate_below_a_part_of_the_fastest_is_rest(sense: float) -> None:
    """Slides as they are, turns times the length of the machine; contacts that are led follow, teeth never rest."""
    rate = sense * np.array([0.9, 1.1, 0.4, 0.6])
    turning = [False, False, True, True]
    for keys, still in (
        ({}, [True, False, True, False]),
        ({"leader": [1, 0, 0, 3]}, [False, True, True, False]),
        ({"fixed": [True, True, False, False]}, [False, False, True, False]),
    ):
        assert _below(LAYOUT, contacts(4, angular=turning, **keys), rate, np.array([1.0])).tolist() == still
    assert _below(LAYOUT, contacts(4, angular=turning), np.zeros(4), np.zeros(1)).all()


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_rate_passes_through_zero_where_it_would_be_gone_in_a_billionth_of_the_motion(sense: float) -> None:
    """Fastest 4 m/s over 2 m: 0.5 s, 5e-10 s of it; a rate of 1 e-9 m/s passes with 2 m/s^2, and not with less."""
    twist, rate = np.array([[sense * 4.0, 0.0, 0.0], [0.0, 0.0, 0.0]]), np.array([sense * 1e-9] * 2)
    for second, passes in ((2.02, True), (1.98, False), (-2.02, True), (-1.98, False)):
        one = zero_crossings(LAYOUT, contacts(2), twist, rate, np.array([second, 0.0]))
        assert one.tolist() == [passes, False]
        led = zero_crossings(LAYOUT, contacts(2, leader=[1, 0]), twist, rate, np.array([second, 0.0]))
        assert led.tolist() == [False, passes]
        fixed = zero_crossings(LAYOUT, contacts(2, fixed=[True, False]), twist, rate, np.array([second, 0.0]))
        assert fixed.tolist() == [False, False]
    pair = contacts(2, group=[0, 0], reckoned=[1.0, 0.5])  # (0.6, 2 * 0.5 * 0.8) of a slip of 1e-9
    for second, passes in ((2.02, True), (1.98, False)):
        found = zero_crossings(LAYOUT, pair, twist, np.array([0.6e-9, 1.6e-9]), np.array([0.0, 2 * second]))
        assert found.tolist() == [passes, passes]


def test_a_group_slips_along_one_direction_and_rests_only_as_a_whole() -> None:
    pair = contacts(3, group=[0, 0, 1])
    value, none = np.array([3.0, -4.0, -2.0]), np.array([False, False, False])
    assert sign(pair, value, none) == pytest.approx([0.6, -0.8, -1.0])
    assert sign(pair, value, np.array([True, False, True])) == pytest.approx([0.0, -1.0, 0.0])
    assert sign(contacts(3), value, np.array([True, False, False])).tolist() == [0.0, -1.0, -1.0]
    assert group_moves(pair, np.array([1.0, 0.0, 0.0])).tolist() == [True, True, False]
    moves = np.array([True, True, False])
    assert impending_senses(pair, value, moves) == pytest.approx([-0.6, 0.8, 0.0])
    assert impending_senses(contacts(3), value, moves).tolist() == [-1.0, 1.0, 0.0]


def test_the_strength_of_a_contact_is_that_of_its_shape() -> None:
    """Lever mu, of a circle lever mu / sqrt(1 + mu^2), of a band by the capstan equation; teeth at any scale 1."""
    keys = {
        "coefficient": [0.75] * 4,
        "resting": [2.4] * 4,
        "lever": [2.0] * 4,
        "circle": [False, True, False, False],
    }
    c = contacts(
        4, **keys, wound=[False, False, True, False], wrap=[0, 0, 2.0, 0], fixed=[False, False, False, True]
    )
    assert strength(c, 1.0) == pytest.approx([1.5, 1.2, 4 * math.tanh(0.75), 2.0])
    assert strength(c, 1.0, True) == pytest.approx([4.8, 2 * 2.4 / 2.6, 4 * math.tanh(2.4), 2.0])
    assert strength(c, 0.5, np.array([True, False, True, True])) == pytest.approx(
        [2.4, 0.75 / math.hypot(1, 0.375), 4 * math.tanh(1.2), 2.0]
    )
    assert strength(c, 0.0).tolist() == [0.0, 0.0, 0.0, 2.0]
    around = contacts(
        3, coefficient=[0.75] * 3, group=[0, 0, 1], around=[True, True, False], angular=[True, False, True]
    )
    assert strength(around, 1.0, sense=np.array([1.0, 0.0, 1.0])) == pytest.approx([0.6, 0.6, 0.75])
    assert strength(around, 1.0, sense=np.array([0.0, 1.0, 1.0])) == pytest.approx([0.75] * 3)


def test_the_coefficient_of_a_strength_is_the_inverse_of_the_strength() -> None:
    """Of a lever, a lining and blocks; a strength of 2 is never reached by a lining."""
    c = contacts(
        3, lever=[0.05, 1.0, 1.0], wound=[False, True, True], wrap=[0.0, 4.0, 3.0], blocks=[0.0, 0.0, 5.0]
    )
    for mu in (0.1, 0.4):
        assert _coefficient(c, 0, 0.05 * mu) == pytest.approx(mu)
        for e in (1, 2):
            strong = capstan(np.array([mu]), c.wrap[[e]], c.blocks[[e]])[0]
            assert _coefficient(c, e, float(strong)) == pytest.approx(mu)
    for e in (1, 2):
        assert _coefficient(c, e, 2.0) == math.inf
        assert _coefficient(c, e, 2 * (1 - 0.9e-9)) == math.inf
        assert math.isfinite(_coefficient(c, e, 2 * (1 - 1.1e-9)))
    assert _coefficient(c, 0, 2.0) == pytest.approx(40.0)


def moving(twist: float, acceleration: float, part: int) -> Any:
    """A machine whose fastest link has one component of speed and acceleration, the others less."""
    v, a = np.zeros((1, 3, 3)), np.zeros((1, 3, 3))
    v[0, 1, part], a[0, 1, part], v[0, 0, 0], a[0, 2, 1] = twist, acceleration, twist / 9, acceleration / 9
    return LinkMotions(v, a, np.zeros((1, 0, 3, 3)), np.ones(1))


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_place_aside_of_a_reversal_is_reached_by_the_speed_or_from_rest_by_the_acceleration(
    sense: float,
) -> None:
    """A hundredth of 2 m: at 0.1 m/s 0.2 s, from rest with 1 m/s^2 sqrt(0.04) = 0.2 s; the shorter of both. A turn of 1
    rad/s moves its link as 2 m/s does."""
    for part, scale in ((0, 1.0), (1, 1.0), (2, 0.5)):
        for v, a, dt in (
            (0.1, 0.0, 0.2),
            (0.0, 1.0, 0.2),
            (0.1, 4.0, 0.1),
            (0.4, 1.0, 0.05),
            (0.0, 0.0, math.inf),
        ):
            at = moving(sense * v * scale, -sense * a * scale, part)
            assert _moment(LAYOUT, at) == pytest.approx([dt]), (part, v, a)
    assert ASIDE == 0.01


@pytest.mark.parametrize(
    ("moment", "root"),
    [
        (lambda x: 0.7 - x, 0.7),
        (lambda x: x + 1.5, -1.5),
        (lambda x: (x - 0.3) ** 3, 0.3),
        (lambda x: np.where(x > 1e-3, 1.0, -1e-6), 1e-3),
        (lambda x: np.tanh(50 * (x + 1.2)), -1.2),
        (lambda x: 2.0 - x, 0.0),  # beyond the steepest: no spin is computed
        (lambda x: -2.0 - x, 0.0),
        (lambda x: x * x, 0.0),
        (lambda x: STEEPEST - x, 0.0),
    ],
)
def test_a_spin_is_the_root_of_its_moment_and_none_without_a_change_of_sign(
    moment: Callable[[Any], Any], root: float
) -> None:
    both = _bracket_root(lambda x: np.array([-x[0], moment(x[1])]), (2,))  # the first is met at once
    assert both == pytest.approx([0.0, root], abs=1e-5 if root in (0.3, 1e-3) else 1e-12)
    found = _bracket_root(moment, (2,))
    assert found == pytest.approx([root] * 2, abs=1e-5 if root in (0.3, 1e-3) else 1e-12)


def test_rods_spin_together_or_each_as_it_would_beside_the_other() -> None:
    """Two moments that depend on each other, linear: the root by hand; where one of them has none within the limit,
    the other's is taken at rest of that one."""
    at = np.array([[0.3, -0.8], [1.1, 0.2], [-0.2, -0.7]])
    for matrix in (np.array([[2.0, 0.5], [-0.4, 1.0]]), np.array([[1.0, 0.95], [0.95, 1.0]])):
        assert solve_spins((3, 2), lambda x, m=matrix: (at - x) @ m.T) == pytest.approx(at, abs=1e-9)  # type: ignore[misc]
        bent = lambda x, m=matrix: (at + at**3 - x - x**3) @ m.T  # noqa: E731
        assert solve_spins((3, 2), bent) == pytest.approx(at, abs=1e-9)
    never = solve_spins((1, 2), lambda x: np.stack([0.3 - x[:, 0], np.exp(10 * x[:, 1])], axis=-1))
    assert never == pytest.approx(np.array([[0.3, 0.0]]), abs=1e-9)
    beyond = np.array([[0.3, 2.0]])
    assert solve_spins((1, 2), lambda x: beyond - x) == pytest.approx(np.array([[0.3, 0.0]]), abs=1e-9)
    below = np.array([[0.3, -2.0]])
    assert solve_spins((1, 2), lambda x: below - x) == pytest.approx(np.array([[0.3, 0.0]]), abs=1e-9)
    assert solve_spins((1, 1), lambda x: beyond[:, :1] - x) == pytest.approx(np.array([[0.3]]), abs=1e-12)


def test_a_programme_ends_at_the_corner_that_another_method_finds() -> None:
    """Boxes by hand, a corner with more limits than unknowns, one limit of size 0, and at random against a library."""
    box = np.concatenate([np.eye(2), -np.eye(2)])[None]
    for q, h, d in (
        ([3.0, -2.0], [1.0, 2.0, 3.0, 4.0], [1.0, -4.0]),
        ([3.0, 2.0], [0.0, 2.0, 3.0, 4.0], [0.0, 2.0]),
        ([-3.0, 0.0], [0.0, 2.0, 3.0, 4.0], [-3.0, 0.0]),
        ([0.0, 0.0], [1.0, 1.0, 1.0, 1.0], [0.0, 0.0]),
    ):
        found, unbounded = furthest(box, np.array([h]), np.array([q]))
        assert found == pytest.approx(np.array([d]))
        assert not unbounded[0]
    corner = np.array([[[1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [2.0, 1.0]]])  # all but the third meet in (1, 1)
    found, _ = furthest(corner, np.array([[1.0, 1.0, 3.0, 3.0]]), np.array([[1.0, 1.0]]))
    assert found == pytest.approx(np.array([[1.0, 1.0]]))
    strip = np.array([[[1.0, 1.0], [-1.0, -1.0]]] * 3)  # |x + y| <= 1
    q = np.array([[1.0, 1.0], [1.0, -1.0], [2.0, 1.0]])
    found, unbounded = furthest(strip, np.ones((3, 2)), q)
    assert unbounded.tolist() == [False, True, True]
    assert (q * found).sum(axis=1) == pytest.approx([1.0, *(q * found).sum(axis=1)[1:]])
    assert (np.abs(found.sum(axis=1)) <= 1 + 1e-9).all()
    assert ((q * found).sum(axis=1)[1:] >= 500).all()
    rng = np.random.default_rng(7)
    g, h, q = rng.normal(size=(12, 9, 3)), rng.uniform(0.0, 1.0, size=(12, 9)), rng.normal(size=(12, 3))
    found, unbounded = furthest(g, h, q)
    for k in range(12):
        known = linprog(-q[k], g[k], h[k], bounds=(None, None))
        assert unbounded[k] == (known.status == 3)
        if known.status == 0:
            assert q[k] @ found[k] == pytest.approx(-known.fun)
            assert (g[k] @ found[k] <= h[k] + 1e-9).all()
