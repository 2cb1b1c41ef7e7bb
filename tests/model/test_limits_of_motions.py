"""Limits of motion programmes and of the drives' positions: joints, ends, steps, jumps, at the limit and beside it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from dalembert.errors import ModelError
from dalembert.model.drives.curves import SAME, Curve, CurvePiece, polynomial, s_curve, trapezoid, unit_rise
from dalembert.model.drives.drives import Drive, Range
from dalembert.model.drives.programmes import RISES, Programme, Segment
from dalembert.model.drives.schedule import Schedule, _steps, schedule

PI, NAN = math.pi, math.nan


def of(*parts: tuple[float, tuple[float, ...]], periodic: bool = False) -> Curve:
    """A curve of polynomials by length and coefficients."""
    return Curve(tuple(CurvePiece(length, c) for length, c in parts), periodic)


STEPS = of((1.0, (0.0, 1.0)), (2.0, (1.0, 0.0)), (1.0, (1.0, -1.0)))


@pytest.mark.parametrize(
    ("x", "behind", "before"),
    [
        (0.0, (0.0, 1.0), (0.0, 1.0)),
        (1.0, (1.0, 0.0), (1.0, 1.0)),
        (1.0 - 0.9 * 4 * SAME, (1.0, 0.0), (1.0, 1.0)),  # within a part of the duration it is the joint
        (1.0 + 0.9 * 4 * SAME, (1.0, 0.0), (1.0, 1.0)),
        (1.0 - 1.1 * 4 * SAME, (1.0, 1.0), (1.0, 1.0)),
        (1.0 + 1.1 * 4 * SAME, (1.0, 0.0), (1.0, 0.0)),
        (3.0, (1.0, -1.0), (1.0, 0.0)),
        (4.0, (0.0, -1.0), (0.0, -1.0)),
        (-0.5, (0.0, 0.0), (0.0, 0.0)),  # it rests beyond its ends
        (4.5, (0.0, 0.0), (0.0, 0.0)),
    ],
)
def test_a_joint_of_pieces_is_behind_it_or_before_it_within_rounding(
    x: float, behind: tuple[float, float], before: tuple[float, float]
) -> None:
    assert STEPS.at(x)[:2] == pytest.approx(behind, abs=1e-7)
    assert STEPS.at(x, before=True)[:2] == pytest.approx(before, abs=1e-7)
    assert STEPS.at(np.array([x, x]), before=True)[:2] == pytest.approx(
        np.array([before, before]).T, abs=1e-7
    )


@pytest.mark.parametrize("turns", [-2, 0, 1])
def test_the_end_of_a_periodic_curve_is_its_beginning(turns: int) -> None:
    """Up with 1 for 1, down with 1/3 for 3: at 0 and 4 alike, from either side."""
    c = of((1.0, (0.0, 1.0)), (3.0, (1.0, -1 / 3)), periodic=True)
    for x, behind, before in (
        (0.0, (0.0, 1.0), (0.0, -1 / 3)),
        (-0.9 * 4 * SAME, (0.0, 1.0), (0.0, -1 / 3)),
        (0.9 * 4 * SAME, (0.0, 1.0), (0.0, -1 / 3)),
        (-1.2 * 4 * SAME, (0.0, -1 / 3), (0.0, -1 / 3)),
        (1.2 * 4 * SAME, (0.0, 1.0), (0.0, 1.0)),
        (1.0, (1.0, -1 / 3), (1.0, 1.0)),
        (2.5, (0.5, -1 / 3), (0.5, -1 / 3)),
    ):
        assert c.at(x + 4 * turns)[:2] == pytest.approx(behind, abs=1e-7), x
        assert c.at(x + 4 * turns, before=True)[:2] == pytest.approx(before, abs=1e-7), x
    assert c.at(0.0)[0] == pytest.approx(0.0, abs=1e-15)
    assert abs(c.at(-0.9 * 4 * SAME)[0]) < 1e-8


def test_a_rate_jumps_from_a_billionth_of_the_largest_on() -> None:
    for off, jumps in ((0.0, []), (0.9e-9, []), (1.1e-9, [1.0]), (-1.1e-9, [1.0]), (-0.9e-9, [])):
        for size in (1.0, -1e-6):
            c = of((1.0, (0.0, size)), (2.0, (size, size * (1 + off))))
            assert c.jumps(1) == jumps, off
    back = of((1.0, (0.0, 1.0)), (1.0, (1.0, -1.0)), periodic=True)
    assert back.jumps(1) == [1.0, 2.0]
    assert back.jumps(0) == []
    assert of((1.0, (0.0, 1.0)), (1.0, (1.0, -1.0))).jumps(1) == [1.0]
    assert of((1.0, (0.0, 0.0, 1.0)), (1.0, (1.0, 2.0, -1.0))).jumps(2) == [1.0]


PEAKS: dict[str, tuple[float, float, float]] = {
    "constant_speed": (1.0, 0.0, 0.0),
    "parabolic": (2.0, 4.0, 0.0),
    "harmonic": (PI / 2, PI**2 / 2, PI**3 / 2),
    "cycloidal": (2.0, 2 * PI, 4 * PI**2),
    "modified_sine": (4 * PI / (4 + PI), 4 * PI**2 / (4 + PI), 16 * PI**3 / (4 + PI)),
    "modified_trapezoid": (2.0, 8 * PI / (2 + PI), 32 * PI**2 / (2 + PI)),
    "polynomial345": (15 / 8, 10 / math.sqrt(3), 60.0),
    "polynomial4567": (35 / 16, 84 / math.sqrt(125), 52.5),
}
"""Greatest speed, acceleration and jerk of a unit rise in a unit of time, from the handbooks' formulas."""


@pytest.mark.parametrize("form", RISES)
def test_the_rises_have_the_peaks_of_the_handbooks(form: str) -> None:
    """Also of a rise of -3 in 2 s, by scale, and where it begins at 5; the middle is half the rise."""
    unit = Curve(unit_rise(form))
    assert unit.at(np.array([0.0, 0.5, 1.0]))[0] == pytest.approx([0.0, 0.5, 1.0], abs=1e-12)
    scaled = Curve(tuple(p.scaled(5.0, -3.0, 2.0) for p in unit_rise(form)))
    assert scaled.at(np.array([0.0, 1.0, 2.0]))[0] == pytest.approx([5.0, 3.5, 2.0])
    for order, peak in enumerate(PEAKS[form], 1):
        assert unit.peaks(order)[0] == pytest.approx(peak, rel=1e-9, abs=1e-12), order
        assert scaled.peaks(order)[0] == pytest.approx(3 * peak / 2**order, rel=1e-9, abs=1e-12), order
    x = np.linspace(0.003, 0.997, 401)
    for order in (1, 2, 3):
        assert np.abs(unit.at(x)[order]).max() <= unit.peaks(order)[0] * (1 + 1e-12)
        h = 1e-6
        inside = [k for k in range(len(x)) if np.abs(unit.times - x[k]).min() > 2 * h]
        slopes = (unit.at(x[inside] + h)[order - 1] - unit.at(x[inside] - h)[order - 1]) / (2 * h)
        assert slopes == pytest.approx(unit.at(x[inside])[order], rel=1e-4, abs=1e-4)


def test_the_first_of_equal_peaks_is_named() -> None:
    """Of a sine wave the first crest; of two equal speeds the first piece; the largest at the very end."""
    assert of((1.0, (0.0, 2.0)), (1.0, (2.0, -2.0))).peaks(1) == (2.0, 0.0)
    assert of((1.0, (0.0, 1.0)), (1.0, (1.0, -2.0))).peaks(1) == (2.0, 1.0)
    assert of((2.0, (0.0, 0.0, 1.0))).peaks(1) == (4.0, 2.0)
    assert of((2.0, (1.0, -2.0, 1.0))).peaks(0) == (1.0, 0.0)  # 1 at both ends
    wave = Curve((CurvePiece(3.0, (0.0,), 2.0, PI, 0.0),))
    assert wave.peaks(0) == (pytest.approx(2.0), pytest.approx(0.5))
    assert wave.peaks(1) == (pytest.approx(2 * PI), 0.0)
    for phase in (-9.0, -1.0, 2.0, 9.0):  # wherever it begins
        piece = CurvePiece(2.0, (0.0,), 2.0, PI, phase)
        crests = piece.extremes(0)
        assert crests == sorted(crests)
        assert len(crests) == 2
        assert np.abs(np.sin(PI * np.array(crests) + phase)) == pytest.approx([1.0, 1.0])
    slow = CurvePiece(1.0, (0.0, 0.0, 1.0), 1.0, 1.0, 0.0)  # 2 u + cos u: never at rest but beyond
    assert slow.extremes(1) == []  # 2 - sin u
    (flat,) = CurvePiece(2.0, (0.0, -math.cos(1.2)), 1.0, 1.0, 0.0).extremes(0)
    assert flat == pytest.approx(1.2)
    (flat,) = CurvePiece(1.0, (0.0, -2 * math.cos(1.2)), 1.0, 2.0, 0.0).extremes(0)  # u = 1.2 / 2
    assert flat == pytest.approx(0.6)
    assert CurvePiece(2.0, (0.0, 1.0, -1.0)).extremes(0) == [0.5]
    assert CurvePiece(0.5, (0.0, 1.0, -1.0)).extremes(0) == []  # at its end, not within
    assert CurvePiece(0.5, (3.0,)).extremes(0) == []
    assert CurvePiece(1.0, (0.0, 1.0, -1.0, 1.0)).extremes(0) == []  # slope 1 - 2 u + 3 u^2 is never 0


@pytest.mark.parametrize(
    ("rise", "limits", "peaks", "time", "reached"),
    [
        # ramps of 0.5 s to 2 m/s^2; 1.5 s to 2 m/s; 3 m in two of these
        (3.0, (2.0, 2.0, 4.0), (2.0, 2.0, 4.0), 3.0, "speed, acceleration and jerk"),
        (5.0, (2.0, 2.0, 4.0), (2.0, 2.0, 4.0), 4.0, "speed, acceleration and jerk"),
        (-5.0, (2.0, 2.0, 4.0), (2.0, 2.0, 4.0), 4.0, "speed, acceleration and jerk"),
        # v j = a^2: the acceleration is just reached: two ramps of 1 s to 1 m/s
        (2.0, (1.0, 1.0, 1.0), (1.0, 1.0, 1.0), 4.0, "speed, acceleration and jerk"),
        # less: sqrt(v/j) = 0.5 s ramps to 0.5 m/s^2
        (0.25, (0.25, 2.0, 1.0), (0.25, 0.5, 1.0), 2.0, "speed and jerk"),
        (0.5, (0.25, 2.0, 1.0), (0.25, 0.5, 1.0), 3.0, "speed and jerk"),
        # 2 a^3 / j^2 = 2: four ramps of 1 s without a hold; from it on the acceleration is held
        (2.0, (9.0, 1.0, 1.0), (1.0, 1.0, 1.0), 4.0, "acceleration and jerk"),
        (6.0, (9.0, 1.0, 1.0), (2.0, 1.0, 1.0), 6.0, "acceleration and jerk"),
        (0.25, (9.0, 1.0, 1.0), (0.25, 0.5, 1.0), 2.0, "jerk"),
        (-0.25, (9.0, 1.0, 1.0), (0.25, 0.5, 1.0), 2.0, "jerk"),
    ],
)
def test_an_s_curve_reaches_the_limits_that_its_rise_allows(
    rise: float,
    limits: tuple[float, float, float],
    peaks: tuple[float, float, float],
    time: float,
    reached: str,
) -> None:
    pieces, which = s_curve(rise, *limits)
    c = Curve(pieces)
    assert c.duration == pytest.approx(time)
    assert [c.peaks(order)[0] for order in (1, 2, 3)] == pytest.approx(peaks)
    assert c.at(c.duration)[:3] == pytest.approx([rise, 0.0, 0.0], abs=1e-12)
    assert c.at(c.duration / 2)[0] == pytest.approx(rise / 2)
    assert which == reached
    assert all(p.length > 1e-9 for p in pieces)


def test_an_even_speeding_up_reaches_its_speed_where_there_is_way_for_it() -> None:
    """v^2/a = 2 m: shorter rises are two ramps of sqrt(h/a), longer ones keep the speed between; at 2 m they agree."""
    for rise, time, parts in (
        (0.5, 2.0, (1.0, 0.0, 1.0)),
        (2.0, 4.0, (2.0, 0.0, 2.0)),
        (2.0 + 1e-9, 4.0, (2.0, 1e-9, 2.0)),
        (3.0, 5.0, (2.0, 1.0, 2.0)),
    ):
        found, each = Segment("limited", limits=(1.0, 0.5), to=rise)._limited(rise)
        assert found == pytest.approx(time)
        assert each == pytest.approx(parts, abs=1e-8)
    for to in (3.0, -1.0):
        c = Curve(Segment("limited", limits=(1.0, 0.5), to=to).pieces(1.0, NAN))
        assert c.at(c.duration)[0] == pytest.approx(to)
        assert c.peaks(1)[0] == pytest.approx(1.0)
        assert c.peaks(2)[0] == pytest.approx(0.5)
    for parts, speed in (
        ((1.0, 2.0, 1.0), 4 / 3),
        ((0.0, 1.0, 0.0), 1.0),
        ((1.0, 0.0, 1.0), 2.0),
        ((0.0, 1.0, 1.0), 4 / 3),
    ):
        c = Curve(trapezoid(parts))
        assert c.at(1.0)[0] == pytest.approx(1.0)
        assert c.peaks(1)[0] == pytest.approx(speed)
        assert len(c.pieces) == sum(x > 0 for x in parts)
    assert trapezoid((0.0, 1.0, 1.0))[0].start()[1] == pytest.approx(4 / 3)
    assert trapezoid((1.0, 1.0, 0.0))[-1].end()[1] == pytest.approx(4 / 3)


def test_a_polynomial_meets_what_is_given_at_both_ends() -> None:
    for end in (
        (3.0, None, None, None),
        (3.0, -1.0, None, None),
        (3.0, -1.0, 0.5, None),
        (3.0, -1.0, 0.5, 2.0),
    ):
        p = polynomial(2.0, (1.0, 0.5, -0.25, 4.0), end)
        known = sum(x is not None for x in end)
        assert p.start()[:known] == pytest.approx([1.0, 0.5, -0.25, 4.0][:known])
        assert p.end()[:known] == pytest.approx([x for x in end if x is not None])
        assert len(p.polynomial) == 2 * known


def constant(length: float, to: float, speed: float) -> Segment:
    return Segment("constant", length=length, to=to, limits=(speed,))


@pytest.mark.parametrize(
    ("off", "fits"), [(0.0, True), (0.9e-6, True), (1.2e-6, False), (-1.2e-6, False), (-0.9e-6, True)]
)
def test_a_speed_may_differ_by_a_millionth_where_segments_join(off: float, fits: bool) -> None:
    for speed in (2.0, -2.0):
        p = Programme((constant(1.0, NAN, speed), constant(1.0, NAN, speed * (1 + off))), start=0.0)
        if fits:
            assert p.curve.duration == 2.0
        else:
            with pytest.raises(ModelError, match=r"the speed jumps from .* at 1 s"):
                _ = p.curve


@pytest.mark.parametrize("speed", [2.0, -2.0])
def test_a_speed_that_begins_or_ends_at_rest_jumps(speed: float) -> None:
    moves, rests = constant(1.0, NAN, speed), Segment("dwell", length=1.0)
    for segments in ((moves, rests), (rests, moves)):
        with pytest.raises(ModelError, match=r"the speed jumps from .* at 1 s"):
            _ = Programme(segments).curve
    assert Programme((rests, rests)).curve.duration == 2.0


def test_a_law_that_is_periodic_ends_where_it_begins() -> None:
    """Within a billionth of its largest position, and with the speed at which it begins."""
    for off, fits in ((0.0, True), (0.9e-9, True), (1.1e-9, False), (-1.1e-9, False)):
        rise = Segment("rise", by="cycloidal", length=1.0, to=1.0)
        p = Programme((rise, Segment("rise", by="cycloidal", length=1.0, to=off)), periodic=True)
        if fits:
            assert p.curve.duration == 2.0
        else:
            with pytest.raises(ModelError, match="does not end where it begins"):
                _ = p.curve
    for last, fits in ((1.0, True), (1 + 0.5e-9, True), (1 + 2e-9, False)):
        bow = (("speed", (1.0, -1.0)),)
        back = (("speed", (-1.0, last)),)
        up = Segment("polynomial", length=1.0, to=0.0, ends=bow)
        p = Programme((up, Segment("polynomial", length=1.0, to=0.0, ends=back)), periodic=True)
        if fits:
            assert p.curve.duration == 2.0
        else:
            with pytest.raises(ModelError, match="the speed jumps where the law begins again"):
                _ = p.curve


def test_a_dwell_fills_what_is_left_of_a_turn() -> None:
    rise, rest = Segment("rise", by="cycloidal", length=PI, to=1.0), Segment("dwell")
    back = Segment("rise", by="cycloidal", length=PI / 2, to=0.0)
    p = Programme((rise, back, rest), over="O", periodic=True, turn=2 * PI)
    assert [x.length for x in p.curve.pieces] == pytest.approx([PI, PI / 2, PI / 2])
    full = Programme((rise, Segment("rise", by="cycloidal", length=PI, to=0.0), rest), over="O", turn=2 * PI)
    with pytest.raises(ModelError, match="fill 360 deg before this dwell"):
        _ = full.curve
    for off, fits in ((0.9e-9, True), (1.2e-9, False), (-1.2e-9, False)):
        some = Programme((rise, Segment("rise", by="cycloidal", length=PI * (1 + 2 * off), to=0.0)), over="O",
                         periodic=True, turn=2 * PI)  # fmt: skip
        if fits:
            assert some.curve.duration == pytest.approx(2 * PI)
        else:
            with pytest.raises(ModelError, match="fill 360 deg of a turn"):
                _ = some.curve


def test_a_law_over_another_drive_rests_beyond_its_ends_and_follows_the_sense() -> None:
    """s = u^2 up to 1: where the master leaves, and before it comes, the follower rests; at the joint of a jump the
    acceleration is that of the side from which the master comes, or to which it goes."""
    p = Programme((Segment("rise", by="parabolic", length=2.0, to=1.0),), over="O")
    x = np.array([0.5, 0.5, 1.0, 1.0, 1.0, -0.5, 2.5, 0.0, 0.0, 2.0, 2.0])
    w = np.array([3.0, -3.0, 3.0, -3.0, 0.0, 3.0, 3.0, 3.0, -3.0, 3.0, -3.0])
    a = np.array([2.0, 2.0, 0.0, 0.0, 2.0, 5.0, 5.0, 0.0, 0.0, 0.0, 0.0])
    s, v, acc = p.following(x, w, a)
    assert s == pytest.approx([0.125, 0.125, 0.5, 0.5, 0.5, 0, 1, 0, 0, 1, 1])
    assert v == pytest.approx([1.5, -1.5, 3, -3, 0, 0, 0, 0, 0, 0, 0])
    assert acc == pytest.approx([9 + 1, 9 + 1, -9, 9, 2, 0, 0, 9, 0, 0, -9])
    before = p.following(x, w, a, before=True)[2]
    assert before == pytest.approx([9 + 1, 9 + 1, 9, -9, 2, 0, 0, 0, 9, -9, 0])
    t, s, v, acc = p.motion(3)
    assert (t.tolist(), s.tolist(), v.tolist(), acc.tolist()) == (
        [0, 1, 2],
        [0, 0.5, 1],
        [0, 1, 0],
        [1, -1, -1],
    )
    assert p.motion(3, before=True)[3].tolist() == [1, 1, -1]
    cycle = Programme(
        (
            Segment("rise", by="parabolic", length=2.0, to=1.0),
            Segment("rise", by="parabolic", length=2.0, to=0.0),
        ),
        periodic=True,
    )
    assert cycle.motion(4)[0].tolist() == [0, 1, 2, 3]


@pytest.mark.parametrize(
    ("span", "turns", "end"),
    [
        ((0.0, 2 * PI), True, False),
        ((1.0, 1 + 4 * PI), True, False),
        ((2 * PI, 0.0), True, False),
        ((0.0, 2 * PI), False, True),
        ((0.0, PI), True, True),
        ((0.0, 2 * PI * (1 + 0.9e-9)), True, False),
        ((0.0, 2 * PI * (1 + 1.1e-9)), True, True),
        ((0.0, 2 * PI * (1 - 1.1e-9)), True, True),
        ((0.0, 0.0), True, True),
    ],
)
def test_a_full_turn_does_not_repeat_its_start(span: tuple[float, float], turns: bool, end: bool) -> None:
    start, stop = span
    steps = _steps(Range(start, stop, 5), 5, turns)
    assert len(steps) == 5
    assert steps[0] == start
    assert steps[-1] == pytest.approx(stop if end else start + (stop - start) * 4 / 5)
    drive = Drive.model_validate({"position": 0.0})  # it turns
    one, two = (
        schedule({"O": drive.model_copy(update={"position": Range(start, stop, count)})}) for count in (1, 2)
    )
    assert one.position.tolist() == [[start]]
    if turns:
        assert two.position[:, 0] == pytest.approx([start, start + (stop - start) / (1 if end else 2)])


def moving(position: Any, speed: Any, acceleration: Any = 0.0, **more: Any) -> Schedule:
    columns = [np.atleast_2d(np.array(x, float)).T for x in (position, speed, acceleration)]
    columns = [np.broadcast_to(c, np.broadcast_shapes(*(x.shape for x in columns))) for c in columns]
    return Schedule(tuple("ABC"[: columns[0].shape[1]]), *columns, **more)


def test_the_time_is_that_of_the_first_drive_with_a_constant_speed() -> None:
    def times(s: Schedule) -> Any:
        return None if s.clock is None else s.clock.tolist()

    assert times(moving([1.0, 2.0, 4.0], 2.0)) == [0.0, 0.5, 1.5]
    assert times(moving([1.0, 2.0, 4.0], 2.0, began=np.array([0.0]))) == [0.5, 1.0, 2.0]
    assert times(moving([1.0, 2.0, 4.0], [2.0, 2.0, 3.0])) is None
    assert times(moving([1.0, 2.0, 4.0], 2.0, [0.0, 0.0, 1.0])) is None
    assert times(moving([1.0, 2.0, 4.0], 0.0)) is None
    assert times(moving([1.0], 0.0)) == [0.0]
    assert times(moving([1.0], 2.0, 5.0)) == [0.0]
    assert times(moving([1.0, 2.0], 0.0, time=np.array([3.0, 4.0]))) == [3.0, 4.0]
    two = moving([[1.0, 2.0, 4.0], [0.0, 3.0, 9.0]], [[0.0] * 3, [6.0] * 3])
    assert times(two) == [0.0, 0.5, 1.5]
    late = moving([[1.0, 2.0, 4.0], [0.0, 3.0, 9.0]], [[0.0, 0.0, 1.0], [6.0] * 3])
    assert times(late) is None  # the first drive that moves at all has no constant speed


def test_a_machine_moves_where_a_drive_has_a_speed_or_only_turns_back() -> None:
    for speed, acceleration, moves in (
        ([1.0, 0.0, -1.0], [0.0, -1.0, 0.0], [True, True, True]),
        ([1.0, 0.0, -1.0], [0.0, 0.0, 0.0], [True, False, True]),
        ([0.0, 1.0, 0.0], [1.0, 0.0, -1.0], [False, True, False]),
        ([0.0, 0.0, -1.0], [0.0, -1.0, 0.0], [False, False, True]),
        ([1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [True, False, False]),
    ):
        assert moving([1.0, 2.0, 1.0], speed, acceleration).moves.tolist() == moves
    both = moving([[1.0, 2.0], [0.0, 0.0]], [[0.0, 0.0], [0.0, 3.0]])
    assert both.moves.tolist() == [False, True]
    turning = moving(
        [[1.0, 2.0, 1.0], [0.0] * 3], [[1.0, 0.0, -1.0], [0.0] * 3], [[0.0, -1.0, 0.0], [0.0] * 3]
    )
    assert turning.moves.tolist() == [True, True, True]  # one of the drives turns back
    law = {"segments": [{"to": 1.0, "in": 2, "by": "parabolic"}], "count": 3}
    jump = schedule({"O": Drive.model_validate({"law": law}), "S": Drive.model_validate({"position": 0.2})})
    assert jump.acceleration == pytest.approx(np.array([[1.0, 0.0], [1.0, 0.0], [-1.0, 0.0]]))
    assert jump.just_after.acceleration == pytest.approx(np.array([[1.0, 0.0], [-1.0, 0.0], [-1.0, 0.0]]))
    after = moving([1.0, 2.0], 1.0, [0.0, 2.0], after=np.array([[0.0], [3.0]]))
    assert after.jumps.tolist() == [[False], [True]]
    assert after.just_after.acceleration.tolist() == [[0.0], [3.0]]
    assert after.just_after.after is None
    assert moving([1.0, 2.0], 1.0).jumps.tolist() == [[False], [False]]


def test_positions_by_number_step_a_lone_turn_and_by_list_are_taken_as_they_are() -> None:
    turn = {"O": Drive.model_validate({"position": 0.5, "speed": 1.0})}
    four = schedule(turn, 4)
    assert four.position[:, 0] == pytest.approx(0.5 + np.arange(4) * PI / 2)
    assert schedule(turn, 1).position.tolist() == [[0.5]]
    assert schedule(turn, [1.0, 3.0]).position.tolist() == [[1.0], [3.0]]
    assert schedule(turn, [[1.0], [3.0]]).position.tolist() == [[1.0], [3.0]]
    for wrong in (0, -1, [], [[1.0, 2.0]], [math.inf], [1.0, math.nan], True, 2.0):
        with pytest.raises(ModelError):
            schedule(turn, wrong)  # type: ignore[arg-type]
    two = {"O": turn["O"], "S": Drive.model_validate({"position": 0.2})}
    assert schedule(two, [1.0, 2.0, 3.0, 4.0]).position.tolist() == [[1.0, 2.0], [3.0, 4.0]]
    with pytest.raises(ModelError, match="do not fit 2 drive"):
        schedule(two, [1.0, 2.0, 3.0])
