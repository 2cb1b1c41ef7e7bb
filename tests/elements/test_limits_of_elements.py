"""Limits of ropes, belts and cams: strands that just hang slack, tracks that just slip, places where pieces join."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.algebra import plane
from dalembert.core.elements import belt_pulls, strand_limits
from dalembert.core.elements.belt_pulls import BeltPulls, net_sum, tensions
from dalembert.core.elements.cam_curves import SNAP, TURN, lift, piece, same_count, with_jumps
from dalembert.core.elements.force_laws import by_tables, gas_push
from dalembert.core.elements.pushing import AT_SPEED, LOST, forces_at_speed, rounding
from dalembert.core.elements.strand_family import Strand
from dalembert.core.elements.strand_limits import LEAST, RopeGrips, belt_margins, rope_margins
from dalembert.core.layout import Layout, Pose


def rope(*lines: tuple[float, float]) -> tuple[Layout, Pose]:
    """Strands of one rope without wheels, each along a line from the origin."""
    count = len(lines)
    index, none = np.arange(count), np.zeros(count)
    arms = np.array(lines, float)
    family = Strand(
        index, 0 * index, 0 * index, 0 * index + 1, np.zeros((count, 2)), arms, none, none, none, none,
        np.zeros((count, 2)), np.tile([1.0, 0.0], (count, 1)),
    )  # fmt: skip
    layout: Any = SimpleNamespace(algebra=plane, constraints=SimpleNamespace(families=[family]))
    return layout, Pose(np.zeros((2, 2)), np.zeros(2), plane.rotation(np.zeros(2)))


def grips(*wheels: tuple[int, int, float, float, float]) -> RopeGrips:
    """Wheels between two strands: the way round, whole turns more, the coefficient."""
    before, after, way, turns, mu = (np.array(column) for column in zip(*wheels, strict=True))
    return RopeGrips(before, after, way, turns, mu)


def test_a_strand_is_slack_below_a_rounding_part_of_all() -> None:
    """Of 3 N and -2 N 1e-9 of 5 N is rounding."""
    layout, pose = rope((1.0, 0.0), (0.0, 1.0))
    empty = RopeGrips(*(np.zeros(0, int) for _ in range(3)), np.zeros(0), np.zeros(0))
    for x, margin in (
        ([3.0, -2.0], [3 + 5e-9, -2 + 5e-9]),
        ([3.0, 0.0], [3 + 3e-9, 3e-9]),
        ([0.0, 0.0], [0.0, 0.0]),
    ):
        assert rope_margins(layout, empty, pose, np.array(x)) == pytest.approx(margin, abs=1e-15)
    assert LEAST == 1e-9
    none: Any = SimpleNamespace(constraints=SimpleNamespace(families=[]))
    assert rope_margins(layout, None, pose, np.ones(2)).shape == (0,)
    assert rope_margins(none, empty, pose, np.ones(2)).shape == (0,)


@pytest.mark.parametrize(("turns", "angle"), [(0.0, math.pi / 2), (1.0, 2.5 * math.pi)])
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_wheel_holds_up_to_the_tension_of_euler_and_eytelwein(
    way: float, turns: float, angle: float
) -> None:
    """From strand 0 along x to strand 1 along y a rope bends a quarter to the left, or three to the right."""
    layout, pose = rope((1.0, 0.0), (0.0, 1.0))
    mu, angle = 0.3, angle if way > 0 else angle + math.pi
    ratio = math.exp(mu * angle)
    for tight, slack in ((ratio, 1.0), (1.0, ratio)):
        for part, holds in ((1 - 1e-6, True), (1 + 1e-6, False), (1.0, True)):
            x = np.array([tight, slack]) ** part
            margin = rope_margins(layout, grips((0, 1, way, turns, mu)), pose, x)
            assert margin.shape == (3,)
            assert (margin[:2] > 0).all()
            assert (margin[2] >= 0) == holds
    both = rope_margins(
        layout,
        grips((0, 1, way, turns, mu), (1, 0, -way, turns, 0.0)),
        pose,
        np.array([[2.0, 2.0], [2.0, 1.0]]),
    )
    assert both[0] == pytest.approx([2, 2, 4 * math.tanh(mu * angle / 2), 0], abs=1e-8)
    assert both[1, 3] == pytest.approx(-1.0)
    pushed = rope_margins(layout, grips((0, 1, way, turns, 0.0)), pose, np.array([-1.0, -1.0]))
    assert pushed == pytest.approx([-1.0, -1.0, 2e-9], rel=1e-6)


def test_a_belt_slips_or_hangs_slack_from_its_tensions_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """Net sum N = 10 - 2 m v^2 + share |t|: without friction it is slack from |t| = N on; by friction from N tanh(mu
    wrap / 2) on, on either wheel."""
    pulls = BeltPulls(
        np.array([10.0, 10.0]), np.array([0.0, 1.0]), np.array([0.5, 0.0]), np.zeros(2), np.array([False, True]),
        np.array([0.0, 0.4]),
    )  # fmt: skip
    belt = SimpleNamespace(row=np.array([0, 1]))
    monkeypatch.setattr(belt_pulls, "belts", lambda layout: belt)
    monkeypatch.setattr(belt_pulls, "belt_speed", lambda layout, f, pose, twist: np.array([2.0, 5.0]))
    monkeypatch.setattr(belt_pulls, "wraps", lambda layout, f, pose: np.array([[3.0, 2.0], [3.0, 4.0]]))
    layout: Any = SimpleNamespace()
    pose: Any = None
    for t in (5.0, -5.0):
        margins = belt_margins(layout, pulls, pose, np.zeros(3), np.array([t, t]))
        grip = [15 * math.tanh(0.4 * wrap / 2) - 5 + 15e-9 for wrap in (2.0, 4.0)]
        assert margins == pytest.approx([1 + 6e-9, *grip], abs=1e-14)
    assert belt_margins(layout, pulls, pose, np.zeros(3), np.array([6.0, 0.0]))[0] == pytest.approx(
        6e-9, abs=1e-15
    )
    fast = BeltPulls(
        np.array([3.0, 10.0]),
        *(np.array(x) for x in ([0.0, 1.0], [0.5, 0.0], [0, 0], [False, True], [0, 0.4])),
    )
    assert belt_margins(layout, fast, pose, np.zeros(3), np.zeros(2))[0] == pytest.approx(
        -1 + 1e-9, abs=1e-12
    )
    assert belt_margins(layout, None, pose, np.zeros(3), np.ones(2)).shape == (0,)
    monkeypatch.setattr(belt_pulls, "belts", lambda layout: None)
    assert strand_limits.belt_margins(layout, pulls, pose, np.zeros(3), np.ones(2)).shape == (0,)
    assert net_sum(pulls, np.array([2.0, 5.0]), None) == pytest.approx([6.0, 10.0])
    assert net_sum(pulls, np.array([2.0, 5.0]), np.array([-3.0, -3.0])) == pytest.approx([6.0, 13.0])
    tight, slack = tensions(np.array([6.0, 6.0]), np.array([1.0, 0.0]), np.array([-4.0, 4.0]))
    assert (tight.tolist(), slack.tolist()) == ([6.0, 5.0], [2.0, 1.0])


def table() -> np.ndarray[Any, Any]:
    """Five pieces, two of which start elsewhere than they hold: rise, dwell, wave, circle aside, straight line."""
    rows = [
        [0.2, *piece(0.0, c0=1.0, c2=0.5, c7=-0.01)[1:]],
        piece(1.2, c0=1.3),
        [2.0, *piece(1.5, c0=1.3, c1=0.1, amplitude=0.2, frequency=2.0, phase=0.3)[1:]],
        piece(3.1, center=0.3, shift=0.4, circle=1.0, radius=2.0),
        piece(5.0, line=1.1, straight=1.0, shift=-0.3),
    ]
    return np.array(rows, float)


def by_hand(x: float) -> float:
    """The lift of the table in its own words."""
    x = 0.2 + (x - 0.2) % TURN
    if x < 1.2:
        return 1 + 0.5 * x**2 - 0.01 * x**7
    if x < 2.0:
        return 1.3
    if x < 3.1:
        return 1.3 + 0.1 * (x - 1.5) + 0.2 * math.sin(2 * (x - 1.5) + 0.3)
    if x < 5.0:
        v = x - 3.1 + 0.4
        return 0.3 * math.cos(v) + math.sqrt(4 - (0.3 * math.sin(v)) ** 2)
    return 1.1 / math.cos(x - 5.0 - 0.3)


def test_a_table_of_pieces_has_the_lift_of_each_and_its_derivatives() -> None:
    """In numbers and in arrays of objects, at joints, just before them and a turn on; rates by differences."""
    one = table()[None]
    places = [0.0, 0.1, 0.2 - 1e-9, 0.2, 0.4, 1.2 - 1e-9, 1.2, 1.7, 2.0, 2.7, 3.1, 4.0, 5.0 - 1e-9, 5.0, 6.0]
    places += [TURN - 1e-9, TURN, 6.48, 8.0, -0.5, -9.0, 21.0, 6.3, 7.5]
    x = np.array(places)[:, None]
    values = lift(one, x)
    assert values[0][:, 0] == pytest.approx([by_hand(p) for p in places], abs=1e-8)
    h = 1e-5
    for place, first, second in zip(places, values[1][:, 0], values[2][:, 0], strict=True):
        if min(abs((place - start + 1) % TURN - 1) for start in (0.2, 1.2, 2.0, 3.1, 5.0)) > 2 * h:
            low, mid, high = (by_hand(place + k * h) for k in (-1, 0, 1))
            assert first == pytest.approx((high - low) / (2 * h), abs=1e-8)
            assert second == pytest.approx((high - 2 * mid + low) / h**2, abs=1e-4)
    for given in (x, x.reshape(4, 6, 1)):
        objects = lift(one.astype(object), given.astype(object))
        for a, b in zip(objects, lift(one, given), strict=True):
            assert np.array(a, float) == pytest.approx(b, rel=1e-12)
    short = np.array([[1.2 - SNAP / 2], [1.2 - 2 * SNAP], [0.2 - SNAP / 2], [0.2 - 2 * SNAP]])
    before, end = 1.2 - 0.07 * 1.2**6, TURN + 0.2 - 5.3
    last = 1.1 * math.tan(end) / math.cos(end)
    for given in (one, one.astype(object)):
        slopes = np.array(lift(given, short.astype(given.dtype))[1], float)[:, 0]
        assert slopes == pytest.approx([0.0, before, 0.2 - 0.07 * 0.2**6, last])


def test_tables_of_different_length_have_their_last_piece_again() -> None:
    short, long = table()[:2], table()
    both = np.array(same_count([short, long]))
    assert both.shape == (2, 5, long.shape[1])
    assert (both[0, 2:] == short[-1]).all()
    x = np.array([0.3, 1.5, 4.0])
    each = lift(both, np.stack([x, x], axis=-1))[0]
    assert each[:, 0] == pytest.approx([by_hand(0.3), 1.3, 1.3])
    assert each[:, 1] == pytest.approx([by_hand(p) for p in x])


def test_a_second_derivative_jumps_from_a_millionth_of_the_largest_on() -> None:
    """2 a on the first half of a turn, 2 b on the second: both joints jump or none."""
    for a, b, jumps in (
        (1.0, 1.0, 0.0),
        (1.0, 1 + 0.9e-6, 0.0),
        (1.0, 1 + 1.2e-6, 1.0),
        (-1.0, -1 - 1.2e-6, 1.0),
        (1.0, -1.0, 1.0),
    ):
        for size in (1.0, 1e-5, 1e5):
            rows = np.array([piece(0.3, c2=a * size), piece(0.3 + math.pi, c2=b * size)], float)
            assert with_jumps(rows)[:, -1].tolist() == [jumps, jumps], (a, b, size)
    for size in (1.0, -1.0):  # 6 u up to 6, then from 6 + 9e-6 up to 12 and back: of 12 a millionth is more
        grown = [
            piece(0.0, c3=size),
            piece(1.0, c2=size * (3 + 4.5e-6), c3=size),
            piece(2.0, c2=6 * size),
        ]
        assert with_jumps(np.array(grown, float))[:2, -1].tolist() == [1.0, 0.0]
    rows = np.array([piece(0.0, c2=1.0), piece(1.0, c2=1.0, c3=0.0), piece(2.0, c2=2.0)], float)
    assert with_jumps(rows)[:, -1].tolist() == [1.0, 0.0, 1.0]
    bent = np.array(
        [piece(0.0, c3=1.0), piece(1.0, c2=3.0), piece(2.0, c2=0.0)], float
    )  # 6 u is 6 at the end
    assert with_jumps(bent)[:, -1].tolist() == [0.0, 0.0, 1.0]


def springs(**keys: Any) -> Any:
    return SimpleNamespace(**{name: np.array(value) for name, value in keys.items()})


def test_a_table_of_a_spring_bends_at_its_bends() -> None:
    """2 N before 1 m, then 3 N/m, from 2 m on 1 N/m more: 2, 2, 3.5, 5, 9."""
    s = springs(
        start=[[2.0], [0.0]], bends=[[[1.0], [2.0]], [[0.0], [0.0]]], slopes=[[[3.0], [1.0]], [[0.0], [0.0]]]
    )
    at = np.array([[-1.0], [1.0], [1.5], [2.0], [3.0]])
    assert by_tables(s, 0, at)[:, 0] == pytest.approx([2.0, 2.0, 3.5, 5.0, 9.0])
    assert by_tables(s, 1, at)[:, 0].tolist() == [0.0] * 5


def test_a_gas_spring_pushes_by_its_polytrope() -> None:
    """2 cm^2 on 1 dm^3 at 5 bar and 0.4 m: A (p (V / (V - A (l0 - l)))^n - p0); the second is no gas spring."""
    s = springs(
        area=[2e-4, 0.0], volume=[1e-3, 0.0], length=[0.4, 0.0], pressure=[5e5, 0.0], outside=[1e5, 0.0],
        exponent=[1.3, 0.0],
    )  # fmt: skip
    found = gas_push(s, np.array([[0.4, 0.4], [0.3, 0.1], [0.5, 0.2]]))
    expected = [2e-4 * (5e5 * (1e-3 / (1e-3 - 2e-4 * x)) ** 1.3 - 1e5) for x in (0.0, 0.1, -0.1)]
    assert found[:, 0] == pytest.approx(expected)
    assert found[:, 1].tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_what_a_contact_may_lack_is_a_part_of_the_largest_force_or_couple(sign: float) -> None:
    """1e-9 of 8 N, of a contact that reads a couple 1e-9 of 6 N m; of the forces at speed 1e-5 more, 1e-5 m N of
    these by the length of 2 m."""
    layout: Any = SimpleNamespace(length=2.0, algebra=plane)
    p: Any = SimpleNamespace(force=np.array([1.0, 0.0, -1.0]))
    force, moment = sign * np.array([[[3.0, -8.0], [1.0, 2.0]]]), sign * np.array([[-6.0, 4.0]])
    assert rounding(layout, p, force, moment, np.zeros(1)) == pytest.approx(
        LOST * np.array([[8.0, 6.0, 8.0]])
    )
    heavy = np.array([1e6])
    at_speed = LOST * np.array([[8 + 1e6 * AT_SPEED, 6 + 2e6 * AT_SPEED, 8 + 1e6 * AT_SPEED]])
    assert rounding(layout, p, force, moment, heavy) == pytest.approx(at_speed)
    mass = np.array([3.0, 5.0])
    for twist, size in (
        ([[1.0, -4.0, 1.5], [0, 0, 0]], 5 * 2 * 4.0),
        ([[1.0, -4.0, -3.0], [0, 0, 0]], 5 * 2 * 9.0),
    ):
        assert forces_at_speed(layout, mass, sign * np.array(twist)) == pytest.approx(size)
