"""Loads on two links at poses and speeds that close nothing: each wrench from its formula, in complex numbers."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.algebra import plane, space
from dalembert.arrays import Array
from dalembert.core import forcing as fc
from dalembert.core.equilibrium import Known, load_rows, relative, virtual_power
from dalembert.core.geometry import point_motion
from dalembert.core.layout import ConstraintRows, Pose

PLANE: Any = SimpleNamespace(algebra=plane, links=2, length=1.5, wrench_scale=np.ones(3))
AT, TURN = np.array([0.3 - 0.7j, -1.1 + 0.4j, 0j]), np.array([0.8, -2.1, 0.0])
V, W = np.array([1.3 + 0.6j, -0.4 - 2.2j, 0j]), np.array([3.5, -1.7, 0.0])
A, ALPHA = np.array([-5.0 + 2.0j, 7.0 + 4.0j]), np.array([11.0, -6.0])


def xy(z: Any) -> Array:
    return np.stack([np.real(z), np.imag(z)], axis=-1)


POSE = Pose(xy(AT)[None], TURN[None], plane.rotation(TURN)[None])
TWIST = np.concatenate([xy(V), W[:, None]], axis=1)[None]


def arm(link: int, u: complex) -> complex:
    return complex(u * np.exp(1j * TURN[link]))


def cross(a: complex, b: complex) -> float:
    return float((np.conj(a) * b).imag)


def source(of: fc.WrenchSource, k: int) -> tuple[complex, float]:
    """Force and couple of a contribution."""
    x, y, m = of.wrench[0, k] if of.wrench.ndim == 3 else of.wrench[k]
    return complex(x, y), float(m)


CENTER = (0.25 - 0.15j, -0.4 + 0.35j)
INERTIA = fc.Inertia(
    np.array([2.5, 4.0]), xy(np.array(CENTER)), np.array([[0.3], [0.7]]), np.array([1.5, -9.0])
)


def test_a_mass_centre_moves_with_its_link() -> None:
    acceleration = np.concatenate([xy(A), ALPHA[:, None]], axis=1)[None]
    place, speed, accelerated = fc.center_motion(PLANE, INERTIA, POSE, TWIST, acceleration)
    weight = fc.weight(PLANE, INERTIA, POSE)
    inertia = fc.inertia_wrench(PLANE, INERTIA, POSE, TWIST, acceleration)
    for k in range(2):
        r = arm(k, CENTER[k])
        assert place[0, k] == pytest.approx(xy(AT[k] + r))
        assert speed[0, k] == pytest.approx(xy(V[k] + 1j * W[k] * r))
        a = A[k] + 1j * ALPHA[k] * r - W[k] ** 2 * r
        assert accelerated[0, k] == pytest.approx(xy(a))
        force, couple = source(weight, k)
        g = INERTIA.mass[k] * complex(1.5, -9.0)
        assert force == pytest.approx(g)
        assert couple == pytest.approx(cross(r, g))
        force, couple = source(inertia, k)
        f = -INERTIA.mass[k] * a
        assert force == pytest.approx(f)
        assert couple == pytest.approx(cross(r, f) - INERTIA.inertia[k, 0] * ALPHA[k])


def test_forces_and_couples_follow_their_link_or_the_ground() -> None:
    u, value = np.array([0.5 + 0.2j, -0.3 + 0.6j, 0.7 - 0.9j]), np.array([4 - 3j, 2 + 5j, -7 + 1j])
    link, follows = np.array([0, 1, 1]), np.array([True, False, True])
    found = fc.force_wrench(PLANE, fc.PointForces(link, xy(u), follows, xy(value)[None]), POSE)
    for k in range(3):
        force = value[k] * np.exp(1j * TURN[link[k]]) if follows[k] else value[k]
        assert source(found, k)[0] == pytest.approx(force)
        assert source(found, k)[1] == pytest.approx(cross(arm(link[k], u[k]), force))
    couples = fc.couple_wrench(PLANE, fc.Couples(link, np.array([[[3.0], [-2.0], [5.0]]]), follows), POSE)
    assert couples.wrench[0].tolist() == [[0, 0, 3.0], [0, 0, -2.0], [0, 0, 5.0]]
    assert found.link.tolist() == couples.link.tolist() == [0, 1, 1]


def springs(**more: Any) -> fc.Springs:
    """Springs between a point of link 0 and one of link 1 that do nothing but what is given."""
    count = len(next(iter(more.values()))) if "start" not in more else more["start"].shape[1]
    zero = np.zeros(count)
    names = [
        "stiffness",
        "free_length",
        "damping",
        "force",
        "area",
        "volume",
        "pressure",
        "length",
        "exponent",
        "outside",
    ]
    values: dict[str, Any] = dict.fromkeys(names, zero)
    values |= {"a": np.zeros(count, np.intp), "b": np.ones(count, np.intp)}
    values |= {"at_a": np.tile([0.2, 0.5], (count, 1)), "at_b": np.tile([-0.6, 0.1], (count, 1))}
    values |= {
        "start": np.zeros((2, count)),
        "bends": np.zeros((2, 0, count)),
        "slopes": np.zeros((2, 0, count)),
    }
    return fc.Springs(**(values | {name: np.asarray(of) for name, of in more.items()}))


ENDS = arm(0, 0.2 + 0.5j), arm(1, -0.6 + 0.1j)
LINE = AT[1] + ENDS[1] - AT[0] - ENDS[0]
RATE = V[1] + 1j * W[1] * ENDS[1] - V[0] - 1j * W[0] * ENDS[0]
LENGTH = abs(LINE)
STRETCHING = float((np.conj(LINE) * RATE).real / LENGTH)


def pulls(s: fc.Springs, tension: list[float]) -> None:
    """The tensions of springs, on both their links."""
    found, e = fc.spring_wrench(PLANE, s, POSE, TWIST), LINE / LENGTH
    count = len(tension)
    assert found.link.tolist() == [0] * count + [1] * count
    for k, t in enumerate(tension):
        for at, sign in ((0, 1.0), (1, -1.0)):
            force, couple = source(found, k + at * count)
            assert force == pytest.approx(sign * t * e, rel=1e-12)
            assert couple == pytest.approx(cross(ENDS[at], sign * t * e), rel=1e-12)


def test_springs_pull_by_their_stretch_dampers_by_its_rate() -> None:
    s = springs(stiffness=[40.0, 25.0, 0.0, 0.0], free_length=[0.3, 0.0, 0.7, 0.0], damping=[0.0, 3.0, 8.0, 0.0], force=[0.0, 0.0, 0.0, -6.5])  # fmt: skip  # noqa: E501
    pulls(s, [40 * (LENGTH - 0.3), 25 * LENGTH + 3 * STRETCHING, 8 * STRETCHING, -6.5])


def test_gas_springs_push_by_their_compression() -> None:
    s = springs(
        area=[0.02], volume=[0.05], pressure=[9e5], length=[LENGTH + 0.4], exponent=[1.3], outside=[1e5]
    )
    pulls(s, [-0.02 * (9e5 * (0.05 / (0.05 - 0.02 * 0.4)) ** 1.3 - 1e5)])


def test_tables_of_springs_bend_where_they_say() -> None:
    low, high = LENGTH - 0.3 - 0.1, LENGTH - 0.3 + 0.1
    s = springs(
        start=np.array([[4.0], [-2.0]]),
        bends=np.array([[[low], [high]], [[STRETCHING - 0.5], [STRETCHING + 0.5]]]),
        slopes=np.array([[[30.0], [70.0]], [[6.0], [90.0]]]),
        free_length=[0.3],
    )
    pulls(s, [4.0 + 30.0 * 0.1 - 2.0 + 6.0 * 0.5])
    margins = fc.table_margins(PLANE, s, POSE, TWIST)
    assert [float(np.ravel(x)[0]) for x in margins] == pytest.approx([0.1, -0.1, 0.5, -0.5])


def test_what_pushes_at_no_length_and_what_needs_a_direction() -> None:
    cases: list[tuple[dict[str, Any], bool, bool]] = [
        ({"stiffness": [3.0]}, False, False),
        ({"stiffness": [3.0], "free_length": [0.1]}, True, True),
        ({"stiffness": [0.0], "free_length": [0.1]}, False, False),
        ({"force": [-2.0]}, True, True),
        ({"area": [0.1]}, True, True),
        ({"damping": [2.0]}, False, True),
        ({"start": np.array([[1.0], [0.0]])}, True, True),
        ({"start": np.array([[0.0], [1.0]])}, False, True),
        (
            {
                "start": np.zeros((2, 1)),
                "bends": np.zeros((2, 1, 1)),
                "slopes": np.array([[[2.0]], [[0.0]]]),
            },
            True,
            True,
        ),
        (
            {
                "start": np.zeros((2, 1)),
                "bends": np.zeros((2, 1, 1)),
                "slopes": np.array([[[0.0]], [[2.0]]]),
            },
            False,
            True,
        ),
    ]
    for keys, pushes, needs in cases:
        assert fc.pushes_at_zero_length(springs(**keys)).tolist() == [pushes], keys
        assert fc.needs_direction(springs(**keys)).tolist() == [needs], keys


@pytest.mark.parametrize("far", [0.0, 1e-10, 2e-9])
def test_a_spring_of_no_length_has_the_direction_of_its_motion_or_none(far: float) -> None:
    """Shorter than 1e-9 of the machine's length; a plain spring keeps its direction to the last."""
    s = springs(stiffness=[3.0, 3.0, 0.0], free_length=[0.0, 0.2, 0.0], damping=[0.0, 0.0, 2.0])
    span = np.array([[far * 0.6, far * 0.8]] * 3)
    rate = np.array([[-3.0, 4.0]] * 3)
    found = fc._direction(PLANE, s, span, (span * span).sum(axis=-1), rate)
    along, moving, none = [0.6, 0.8], [-0.6, 0.8], [np.nan, np.nan]
    expected = {0.0: [moving, none, moving], 1e-10: [along, none, moving], 2e-9: [along] * 3}[far]
    assert found == pytest.approx(np.array(expected), nan_ok=True)
    assert fc._vanished(PLANE) == pytest.approx(1.5e-9**2, rel=1e-12, abs=0.0)
    still = fc._direction(PLANE, s, 0 * span, 0 * span[:, 0], 0 * rate)
    assert still[[0, 2]].tolist() == [[0.0, 0.0]] * 2


def test_the_square_of_a_length_is_counted_from_the_shortest_with_a_direction() -> None:
    none = Pose(np.zeros((1, 3, 2)), np.zeros((1, 3)), plane.rotation(np.zeros((1, 3))))
    for far in (1e-9, 2e-9):
        near = springs(force=[1.0], at_a=[[0.0, 0.0]], at_b=[[0.0, far]])
        assert fc.away(PLANE, near, none).ravel() == pytest.approx([far**2 - 1.5e-9**2], rel=1e-9, abs=0.0)


@pytest.mark.parametrize("count", [3, fc.MANY, fc.MANY + 1])
def test_contributions_are_added_by_link_and_those_on_the_ground_left_out(count: int) -> None:
    rng = np.random.default_rng(5)
    link, wrench = np.arange(count) % 3, rng.normal(size=(2, count, 3))
    more = fc.WrenchSource(np.array([1]), np.array([[5.0, -7.0, 11.0]]))
    total = fc.total_wrench(PLANE, fc.WrenchSource(link, wrench), more)
    assert total.shape == (2, 2, 3)
    for k in range(2):
        extra = more.wrench[0] if k == 1 else 0.0
        assert total[:, k] == pytest.approx(wrench[:, link == k].sum(axis=1) + extra)


def test_a_row_acts_on_both_its_links() -> None:
    rng = np.random.default_rng(2)
    on_i, on_j = rng.normal(size=(2, 1, 2, 3))
    rows = ConstraintRows(np.array([2, 0]), np.array([0, 1]), np.zeros(2, bool), on_i, on_j)
    found = fc.pair(rows, np.array([[2.0, -3.0]]))
    assert found.link.tolist() == [2, 0, 0, 1]
    assert found.wrench[0] == pytest.approx(
        np.array([2 * on_i[0, 0], -3 * on_i[0, 1], 2 * on_j[0, 0], -3 * on_j[0, 1]])
    )


def test_unit_loads_act_at_their_points_in_their_axes() -> None:
    u, direction = np.array([0.4 - 0.3j, 0.8 + 0.1j, 0j]), np.array([0.6 + 0.8j, -0.8 + 0.6j, 0j])
    follows, couple = np.array([True, False, False]), np.array([False, False, True])
    known = Known(np.ones(0, bool), np.zeros((1, 0)), np.array([0, 1, 1]), xy(u), xy(direction), np.array([[0.0], [0.0], [1.0]]), follows, couple)  # fmt: skip  # noqa: E501
    rows = load_rows(PLANE, known, POSE)
    assert rows.i.tolist() == [2, 2, 2]
    assert rows.j.tolist() == [0, 1, 1]
    assert not rows.on_i.any()
    turned = direction[0] * np.exp(1j * TURN[0])
    expected = [
        [turned.real, turned.imag, cross(arm(0, u[0]), turned)],
        [-0.8, 0.6, cross(arm(1, u[1]), direction[1])],
        [0.0, 0.0, 1.0],
    ]
    assert rows.on_j[0] == pytest.approx(np.array(expected))


def test_an_amount_is_over_a_size_or_itself() -> None:
    assert relative(np.array([6.0, 6.0]), np.array([3.0, 0.0])).tolist() == [2.0, 6.0]


def test_virtual_power_is_that_of_loads_and_efforts_without_reactions() -> None:
    rng = np.random.default_rng(8)
    v, w = rng.normal(size=(1, 1, 3, 3)), rng.normal(size=(1, 2, 3))
    v[..., 2, :] = 0.0
    on_i, on_j = rng.normal(size=(2, 1, 3, 3))
    rows = ConstraintRows(np.array([0, 2, 0]), np.array([1, 0, 1]), np.zeros(3, bool), on_i, on_j)
    layout: Any = SimpleNamespace(constraints=SimpleNamespace(count=1))
    x = np.array([[100.0, 2.0, -3.0]])
    power = (v[0, 0, :2] * w[0]).sum()
    power += 2.0 * (on_j[0, 1] @ v[0, 0, 0]) - 3.0 * (on_i[0, 2] @ v[0, 0, 0] + on_j[0, 2] @ v[0, 0, 1])
    assert virtual_power(layout, v, rows, x, w) == pytest.approx(np.array([[power]]))


def test_a_point_in_space_moves_with_its_link() -> None:
    rng = np.random.default_rng(4)
    v, w, r = rng.normal(size=(3, 3))
    pose = Pose(np.zeros((2, 3)), np.zeros(0), np.tile(space.IDENTITY, (2, 1)))
    twist = np.array([[*v, *w], [0.0] * 6])
    speed, second = point_motion(space, pose, twist, np.array([0]), r[None])
    assert speed[0] == pytest.approx(v + np.cross(w, r))
    assert second[0] == pytest.approx(np.cross(w, np.cross(w, r)))
    layout: Any = SimpleNamespace(algebra=space, links=1, length=1.0)
    principal = np.array([0.2, 0.5, 0.9, 0.0, 0.0, 0.0])
    a, alpha = rng.normal(size=(2, 3))
    matrix = np.diag([0.2, 0.5, 0.9])
    inertia = fc.Inertia(np.array([3.0]), r[None], _inertia_of(principal), np.array([0.0, 0.0, -9.0]))
    found = fc.inertia_wrench(layout, inertia, pose, twist, np.array([[*a, *alpha]]))
    force = -3.0 * (a + np.cross(alpha, r) + np.cross(w, np.cross(w, r)))
    couple = np.cross(r, force) - matrix @ alpha - np.cross(w, matrix @ w)
    assert found.wrench[0] == pytest.approx(np.array([*force, *couple]))


def _inertia_of(principal: Array) -> Array:
    """As a row of the layout: a matrix row by row."""
    return np.diag(principal[:3]).reshape(1, 9)
