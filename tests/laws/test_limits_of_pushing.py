"""What pushes, pulls and grips: forces of contacts and belts, what of them is rounding, and how their rows add up."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.algebra import plane
from dalembert.arrays import Array
from dalembert.core import equilibrium as eq
from dalembert.core import gear_rows
from dalembert.core.elements import belt_pulls, pushing, strand_limits
from dalembert.core.forcing import WrenchSource
from dalembert.core.layout import Along, BeltMesh, ConstraintRows, Distance, Pose, Rows


def layout_of(*families: Any, **more: Any) -> Any:
    values = {"algebra": plane, "links": 2, "length": 0.4, "constraints": SimpleNamespace(families=families)}
    return SimpleNamespace(**(values | more))


TURN = np.array([[0.5, -1.2, 0.0]])
POSE = Pose(np.array([[[0.1, 0.2], [1.3, -0.4], [0.0, 0.0]]]), TURN, plane.rotation(TURN))


def contacts(force: Any, moment: Any, **more: Any) -> pushing.Pushing:
    count = len(force)
    values: dict[str, Any] = {
        "joint": np.arange(count) % 2,
        "row": np.arange(count) % 2,
        "corner": np.zeros(count, np.intp),
        "tangent": np.zeros(count),
    }
    return pushing.Pushing(force=np.array(force), moment=np.array(moment), **(values | more))


def test_what_a_contact_may_lack_is_a_part_of_the_largest_force_or_couple() -> None:
    force = np.array([[[3.0, -40.0], [1.0, 2.0]], [[0.5, 0.25], [-8.0, 1.0]]])
    moment = np.array([[-7.0, 2.0], [0.5, 0.25]])
    p = contacts([1.0, 0.0, -0.5], [0.0, 1.0, 2.0])
    found = pushing.rounding(layout_of(), p, force, moment, np.array([0.0, 2e6]))
    couple = 0.5 + 1e-5 * 0.4 * 2e6
    assert found == pytest.approx(
        1e-9 * np.array([[40.0, 7.0, 40.0], [28.0, couple, 28.0]]), rel=1e-12, abs=0.0
    )


def test_forces_at_speed_are_by_the_faster_of_turning_and_moving() -> None:
    twist = np.array([[[3.0, 1.0, 2.0], [-0.5, 0.2, -9.0]], [[-6.0, 1.0, 2.0], [0.5, 0.2, 1.0]]])
    found = pushing.forces_at_speed(layout_of(), np.array([-2.5, 1.5]), twist)
    assert found == pytest.approx([2.5 * 0.4 * 9.0**2, 2.5 * 0.4 * (6.0 / 0.4) ** 2])


def rows() -> tuple[Along, Distance]:
    one = {"ui": np.array([[0.2, 0.1]]), "uj": np.array([[-0.3, 0.4]])}
    ends = {"i": np.array([0]), "j": np.array([1])}
    along = Along(row=np.array([0]), axis=np.array([[0.6, 0.8]]), pitch=np.zeros(1), **ends, **one)
    return along, Distance(row=np.array([1]), **ends, **one)


def test_normals_are_the_axis_of_a_slide_and_the_line_of_a_distance() -> None:
    unit = pushing.normals(layout_of(*rows()), POSE, np.array([1, 0, 7]))
    axis = complex(0.6, 0.8) * np.exp(0.5j)
    line = complex(1.3, -0.4) + (-0.3 + 0.4j) * np.exp(-1.2j) - 0.1 - 0.2j - (0.2 + 0.1j) * np.exp(0.5j)
    line /= abs(line)
    assert unit[0] == pytest.approx(np.array([[line.real, line.imag], [axis.real, axis.imag], [0.0, 0.0]]))


def test_forces_of_contacts_are_of_the_normal_the_couple_and_the_tangent() -> None:
    layout, force, moment = layout_of(*rows()), np.array([[[2.0, -5.0], [4.0, 1.0]]]), np.array([[7.0, -3.0]])
    p = contacts([1.5, 1.0, 0.3], [0.0, 2.0, 0.0], tangent=np.array([0.0, 0.0, -1.0]))
    unit = pushing.normals(layout, POSE, p.row)[0]
    first, second = unit[0] @ force[0, 0], unit[1] @ force[0, 1]
    across = unit[2, 0] * force[0, 0, 1] - unit[2, 1] * force[0, 0, 0]
    assert pushing.contact_forces(layout, p, POSE, force, moment)[0] == pytest.approx(
        [1.5 * first, second - 6.0, 0.3 * first]
    )
    slips = contacts(
        [1.5, 1.0, 0.3], [0.0, 2.0, 0.0], tangent=np.array([0.0, 0.0, -1.0]), corner=np.array([0, 0, 2])
    )
    assert slips.slips.tolist() == [False, False, True]
    assert pushing.contact_forces(layout, slips, POSE, force, moment)[0, 2] == pytest.approx(
        0.3 * first - across
    )
    none = np.zeros(1)
    margins = pushing.contact_margins(layout, p, POSE, force, moment, none)
    assert margins == pytest.approx(
        pushing.contact_forces(layout, p, POSE, force, moment)
        + pushing.rounding(layout, p, force, moment, none),
        rel=1e-14,
    )
    assert pushing.contact_margins(layout, None, POSE, force, moment, none).size == 0
    assert p.key != slips.key


# belts


def belt(ri: float = 0.2, rj: float = -0.35) -> BeltMesh:
    known: dict[str, Any] = {"row": [0], "i": [0], "j": [1], "ui": [[0.0, 0.1]], "uj": [[0.2, 0.0]], "ri": [ri], "rj": [rj]}  # fmt: skip  # noqa: E501
    return BeltMesh(**{name: np.array(value) for name, value in known.items()})


TWIST = np.array([[[0.3, -0.2, 4.0], [1.0, 0.7, -2.0], [0.0, 0.0, 0.0]]])
LINE = complex(1.3, -0.4) + 0.2 * np.exp(-1.2j) - 0.1 - 0.2j - 0.1j * np.exp(0.5j)
RATE = complex(1.0, 0.7) - 2j * 0.2 * np.exp(-1.2j) - complex(0.3, -0.2) - 4j * 0.1j * np.exp(0.5j)


def pulls(**more: Any) -> belt_pulls.BeltPulls:
    values = {
        "constant": 90.0,
        "share": 0.0,
        "mass": 0.5,
        "carried": 0.3,
        "gripped": True,
        "grip": 0.4,
    } | more
    return belt_pulls.BeltPulls(**{name: np.array([value]) for name, value in values.items()})


@pytest.mark.parametrize(("ri", "rj"), [(0.2, -0.35), (0.2, 0.35), (-0.35, 0.2)])
def test_a_belt_runs_against_its_line_of_centres_and_pulls_its_shafts_together(ri: float, rj: float) -> None:
    f, layout = belt(ri, rj), layout_of(belt(ri, rj))
    turning = (np.conj(LINE) * RATE).imag / abs(LINE) ** 2
    speed = belt_pulls.belt_speed(layout, f, POSE, TWIST)
    assert speed == pytest.approx(np.array([[ri * (4.0 - turning)]]))
    force = belt_pulls.pull_on_j(layout, f, POSE, np.array([[50.0]]))
    cosine = math.sqrt(1 - (ri + rj) ** 2 / abs(LINE) ** 2)
    pull = -50.0 * cosine * LINE / abs(LINE)
    assert force[0, 0] == pytest.approx([pull.real, pull.imag])
    link, wrench = belt_pulls.pull_wrench(layout, f, POSE, force)
    assert link.tolist() == [0, 1]
    for k, (at, on) in enumerate(((0.1j * np.exp(0.5j), -pull), (0.2 * np.exp(-1.2j), pull))):
        assert wrench[0, k] == pytest.approx([on.real, on.imag, (np.conj(at) * on).imag])
    gamma = math.asin((ri + rj) / abs(LINE))
    wraps = belt_pulls.wraps(layout, f, POSE)[0, :, 0]
    assert wraps == pytest.approx([math.pi + 2 * gamma, math.pi + 2 * gamma * math.copysign(1, rj)])


def test_tensions_of_a_belt_are_by_the_size_of_their_difference() -> None:
    net, speed = np.array([[30.0]]), np.array([[3.0]])
    for difference in (8.0, -8.0):
        d = np.array([[difference]])
        tight, slack = belt_pulls.tensions(net, np.array([[2.5]]), d)
        assert (tight.item(), slack.item()) == (21.5, 13.5)
        assert belt_pulls.net_sum(pulls(share=-1.0), speed, d).item() == 90.0 - 9.0 - 8.0
        assert belt_pulls.net_sum(pulls(share=1.0), speed, d).item() == 90.0 - 9.0 + 8.0
    assert belt_pulls.net_sum(pulls(share=1.0), speed, None).item() == 81.0


@pytest.mark.parametrize("difference", [25.0, -25.0])
def test_margins_of_a_belt_are_those_of_its_grip_on_both_wheels_or_of_its_slack_strand(
    difference: float,
) -> None:
    f, layout = belt(), layout_of(belt())
    speed = belt_pulls.belt_speed(layout, f, POSE, TWIST).item()
    net = 90.0 - 2 * 0.5 * speed**2
    x = np.array([[difference, 7.0]])
    grip = strand_limits.belt_margins(layout, pulls(), POSE, TWIST, x)[0]
    wraps = belt_pulls.wraps(layout, f, POSE)[0, :, 0]
    expected = [2 * math.tanh(0.4 * wrap / 2) * net / 2 - 25.0 for wrap in wraps]
    assert grip == pytest.approx(expected, rel=1e-7)
    slack = strand_limits.belt_margins(layout, pulls(gripped=False), POSE, TWIST, x)[0]
    assert slack == pytest.approx([net - 25.0], rel=1e-7)
    assert slack[0] - (net - 25.0) == pytest.approx(strand_limits.LEAST * abs(net), rel=1e-3)
    for lacking in (layout_of(), layout):
        none = None if lacking is layout else pulls()
        assert strand_limits.belt_margins(lacking, none, POSE, TWIST, x).size == 0


# equilibrium


def test_a_residual_is_over_the_largest_force_of_all() -> None:
    layout: Any = layout_of(wrench_scale=np.array([1.0, 1.0, 1 / 0.4]))
    w = np.array([[[1.0, -2.0, 0.4], [0.5, 0.0, 0.0]], [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]])
    sources = [WrenchSource(np.array([0, 1]), np.array([[[-1.0, 2.0, -9.0], [-3.0, 0.0, 0.0]]] * 2))]
    off, largest = eq._residual(layout, sources, w)
    assert largest == pytest.approx([22.5, 22.5])
    assert off == pytest.approx([8.6 / 0.4 / 22.5, 1.0])
    nothing = [WrenchSource(np.array([0]), np.zeros((2, 1, 3)))]
    assert eq._residual(layout, nothing, 0 * w)[0].tolist() == [0.0, 0.0]
    small = [WrenchSource(np.array([0]), np.array([[[0.0, 1.5, 0.0]]] * 2))]
    off, largest = eq._residual(layout, small, -3 * w[:1] * np.ones((2, 1, 1)))
    assert largest.tolist() == [6.0, 6.0]
    assert off == pytest.approx([7.5 / 6.0] * 2)


def test_components_are_unique_where_nothing_moves_them() -> None:
    shift = np.array([[[0.0, 9e-9], [0.0, -2e-8]], [[5e-9, 0.0], [2e-8, 0.0]]])
    assert eq.unique(shift).tolist() == [[True, False], [True, False]]


def test_shifts_are_those_of_forces_and_couples_of_each_joint() -> None:
    free = np.array([[[1.0, 0.5], [0.0, -2.0], [3.0, 0.0], [4.0, 0.0], [0.0, 0.0], [-5e-8, 0.0]]])
    constraints = SimpleNamespace(
        joint=np.array([0, 1, -1, 1]), angular=np.array([False, True, False, False]), families=(), count=4
    )
    layout: Any = layout_of(joints=2, constraints=constraints)
    on_j = np.array([[[0.6, 0.8, 9.0], [7.0, 7.0, 1.5], [1.0, 1.0, 1.0], [0.0, -1.0, 3.0]]])
    some = ConstraintRows(np.zeros(4, int), np.ones(4, int), constraints.angular, 0 * on_j, on_j)
    shift, others = eq.shifts(layout, POSE, some, free)
    assert shift[0, 0] == pytest.approx(np.array([[0.6, 0.3], [0.8, 0.4], [0.0, 0.0]]))
    assert shift[0, 1] == pytest.approx(np.array([[0.0, 0.0], [-4.0, 0.0], [0.0, -3.0]]))
    assert others.tolist() == [[True, False]]


def test_rows_of_a_joint_are_summed_in_batches_of_one_a_joint() -> None:
    joint, angular = np.array([0, 0, 1, -1, 0, 1]), np.array([False, False, False, False, True, True])
    made = Rows(6, 2, (), joint, angular)
    lots = [(turns, lot.tolist()) for turns, lot in made.lots]
    assert lots == [(False, [0, 2]), (False, [1]), (True, [4, 5])]


def test_rows_one_after_the_other_have_the_positions_of_both() -> None:
    one = ConstraintRows(
        np.array([0]), np.array([1]), np.array([True]), np.full((1, 3), 2.0), np.full((1, 3), 3.0)
    )
    two = ConstraintRows(np.array([2]), np.array([0]), np.array([False]), np.full((4, 1, 3), 5.0), np.full((4, 1, 3), 7.0))  # fmt: skip  # noqa: E501
    both = one + two
    assert (both.i.tolist(), both.j.tolist(), both.angular.tolist()) == ([0, 2], [1, 0], [True, False])
    assert both.on_i.shape == (4, 2, 3)
    assert both.on_i[3, :, 0].tolist() == [2.0, 5.0]
    assert both.on_j[2, :, 1].tolist() == [3.0, 7.0]
    assert both.at(slice(0, 2)).on_j.shape == (2, 2, 3)
    assert both.rows(slice(1, None)).on_i[0, 0].tolist() == [5.0] * 3


# gears in space


def fit(span: Any, axes: Any, e: Any, radii: tuple[float, float]) -> Any:
    vectors = [np.array(v, float) for v in (*axes, *e)]
    return gear_rows._fit(np.array(span, float), (vectors[0], vectors[1]), (vectors[2], vectors[3]), radii)


def test_wheels_on_crossed_axes_are_shifted_and_scaled_until_they_meet() -> None:
    """si = -3 s and sj = 2 s, of which (si^2 + sj^2) / 5^2 + (s - 1)^2 is least: s = 25 / 38."""
    x, _, z = np.eye(3)
    worst, (si, sj, scale), gap = fit([0.0, 0.0, 0.0], (z, x), (x, z), (2.0, -3.0))
    assert gap == pytest.approx(0.0, abs=1e-12)
    assert (si, sj, scale) == pytest.approx((-75 / 38, 50 / 38, 25 / 38))
    assert worst == pytest.approx(15 / 38)


@pytest.mark.parametrize(("distance", "gap"), [(5.0, 0.0), (5.5, 0.0), (4.0, 0.0)])
def test_wheels_on_parallel_axes_are_scaled_to_their_distance(distance: float, gap: float) -> None:
    x, _, z = np.eye(3)
    for sign in (1.0, -1.0):
        worst, (_, _, scale), left = fit([sign * distance, 0, 0], (z, z), (sign * x, sign * x), (2.0, -3.0))
        assert scale == pytest.approx(distance / 5.0)
        assert left == pytest.approx(gap, abs=1e-12)
        assert worst == pytest.approx(abs(distance / 5.0 - 1), abs=1e-12)


def test_what_no_shift_or_radius_brings_together_is_a_gap() -> None:
    x, _, z = np.eye(3)
    worst, _, gap = fit([5.0, 0.75, 0.0], (z, z), (x, x), (2.0, -3.0))
    assert gap == pytest.approx(0.75)
    assert worst == pytest.approx(0.15)


def test_a_pitch_cone_points_from_the_apex() -> None:
    x, y, z = np.eye(3)
    for height, radius in ((3.0, 4.0), (-3.0, 4.0), (3.0, -4.0), (0.0, 4.0)):
        span = height * z - 2.0 * y  # j's axis along y meets i's at this height
        cone = gear_rows._cone(z, x, radius, y, span)
        side = 1.0 if height >= 0 else -1.0
        assert cone == pytest.approx(np.array([height, -radius]) * side / math.hypot(height, radius))


def test_a_direction_is_none_of_what_is_too_short() -> None:
    assert gear_rows._unit(np.array([0.0, 3.0, -4.0]), 1.0) == pytest.approx([0.0, 0.6, -0.8])
    for size in (1.0, 0.5):
        assert not gear_rows._unit(np.array([0.0, 0.0, size]), 1.0).any()


def test_teeth_part_to_the_side_of_the_smaller_wheel() -> None:
    normal: Array = np.array([[[0.0, 0.0, 1.0]] * 4])
    up, down = [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]
    f: Any = SimpleNamespace(ri=np.array([2.0, 2.0, -3.0, 1.0]), rj=np.array([1.0, 5.0, 1.0, -4.0]))
    mesh: Any = SimpleNamespace(normal=normal)
    away, inside = gear_rows._sides(
        f, mesh, np.array([[down, up, up, up]]), np.array([[down, down, down, up]])
    )
    # sides of i: 1, -1, 1, -1; of j: 1, 1, 1, 1; the smaller wheel is j, i, j, i
    assert away.tolist() == [1.0, 1.0, 1.0, 1.0]
    assert inside.tolist() == [1.0, -1.0, 1.0, -1.0]
    away, _ = gear_rows._sides(f, mesh, np.array([[down, down, up, down]]), np.array([[up, down, up, up]]))
    # of i: 1, 1, 1, 1; of j: -1, 1, -1, 1
    assert away.tolist() == [-1.0, -1.0, -1.0, -1.0]
