"""Corners of loads, elastic stops and laws of prescribed drives, each at its limits and on both sides of them."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.motion.coded.acting_nodes import within
from dalembert.machine.motion.corners.corner_events import AHEAD, CLEAR, CornerState, Switch
from dalembert.machine.motion.corners.elastic_joints import ElasticState
from dalembert.machine.motion.corners.elastic_stops import ElasticStops, stop_push
from dalembert.machine.motion.corners.one_sided import Sided, has_corners, sided
from dalembert.machine.motion.corners.prescribed_laws import PrescribedLaw
from dalembert.machine.motion.equation import StoppedError
from dalembert.machine.motion.occurrences import Guard, say
from dalembert.model.drives.end_stops import Stops
from dalembert.model.drives.laws import Rise, TimeTable
from dalembert.model.quantities.tables import Table

UNKNOWN: Any = None


def test_functions_with_corners_go_on_straight_on_either_side() -> None:
    for side in (1.0, -1.0):
        of = sided(lambda x, side=side: side)  # type: ignore[misc]
        assert (of["sign"](7.0), of["abs"](0.25), of["abs"](-3.0)) == (side, 0.25 * side, -3.0 * side)
        assert of["max"](2.5, 7.0) == (2.5 if side > 0 else 7.0)
        assert of["min"](2.5, 7.0) == (7.0 if side > 0 else 2.5)
    asked: list[float] = []
    of = sided(lambda x: asked.append(x) or 1.0)  # type: ignore[func-returns-value]
    of["max"](2.5, 7.0), of["min"](2.5, 7.0)
    assert asked == [-4.5, -4.5]


def table(**more: Any) -> Table:
    return Table("O", (1.0, 2.0, 4.0), (3.0, 5.0, 11.0), **more)


def test_a_table_has_corners_where_it_is_linear_and_not_of_time() -> None:
    assert has_corners(table())
    assert not has_corners(Table("O", (1.0, 2.0, 4.0, 5.0), (3.0, 5.0, 11.0, 1.0), interpolate="cubic"))
    assert not has_corners(Table("time", (1.0, 2.0), (3.0, 5.0)))
    assert not has_corners(4.0)


@pytest.mark.parametrize(
    ("x", "side", "value", "switches", "beyond"),
    [
        (1.0, 1, 3.0, (0.0, 1.0), False),
        (1.5, 1, 4.0, (0.5, 0.5), False),
        (2.0, 2, 5.0, (0.0, 2.0), False),
        (3.5, 2, 9.5, (1.5, 0.5), False),
        (4.0, 3, 11.0, (0.0, 3e9), True),
        (4.25, 3, 11.0, (0.25, 3e9), True),
        (0.75, 0, 3.0, (3e9, 0.25), True),
    ],
)
def test_a_table_goes_on_with_its_piece(
    x: float, side: int, value: float, switches: tuple[float, float], beyond: bool
) -> None:
    """Beyond its ends it holds its value, or is zero; times and shift are those of the table."""
    for shift, times, zero in ((0.0, 1.0, False), (0.25, -2.0, False), (0.0, 1.0, True)):
        s = Sided(table(shift=shift, times=times, outside="zero" if zero else "hold"))
        assert not s.beyond
        found = s.at({"O": x + shift})
        assert found == pytest.approx(0.0 if zero and beyond else times * value, abs=1e-12)
        assert s.sides == {0: side}
        assert s.switches == pytest.approx(switches, abs=0.3)
        if not beyond:
            assert s.switches == pytest.approx(switches, abs=1e-12)
        assert s.beyond is beyond
        assert [s.switch(k, {"O": x + shift}) for k in (0, 1)] == s.switches
        assert (s.side(0), s.side(1), s.words(0, {})) == (1.0, 1.0, ())


def test_a_table_is_on_its_piece_until_it_is_flipped() -> None:
    s = Sided(table(), "load 'F'")
    assert s.at({"O": 1.5}) == pytest.approx(4.0)
    assert s.at({"O": 2.5}) == pytest.approx(6.0)  # the first piece drawn on
    assert s.switches == pytest.approx([1.5, -0.5])
    s.flip(1, -1.0)
    assert s.at({"O": 2.5}) == pytest.approx(6.5)
    s.flip(0, -1.0)
    assert (s.sides, s.at({"O": 2.5})) == ({0: 1.0}, pytest.approx(6.0))  # type: ignore[comparison-overlap]
    other = s.again()
    assert (other.sides, other.what, other.value) == ({}, "load 'F'", s.value)


@pytest.mark.parametrize(
    ("x", "side", "value"), [(1.5, 0, 4.0), (4.5, 2, 4.0), (7.5, 4, 4.0), (-1.5, -2, 4.0), (2.5, 1, 4.5)]
)
def test_a_periodic_table_counts_its_pieces_on(x: float, side: int, value: float) -> None:
    """Of a period 3 from 1 on, two pieces each: the second falls from 5 back to 3."""
    s = Sided(Table("O", (1.0, 2.0), (3.0, 5.0), period=3.0))
    value = value if side % 2 == 0 else 5.0 - 0.5
    assert s.at({"O": x}) == pytest.approx(value)
    assert s.sides == {0: side}
    assert not s.beyond
    low = 1.0 + 3 * (side // 2) + side % 2
    assert s.switches == pytest.approx([x - low, low + 1 + side % 2 - x])


def test_an_expression_keeps_its_sides_and_says_what_is_no_number() -> None:
    m = da.slider_crank().with_values({"loads.load.value": ["abs(O2 - 1)", 0.0]})
    value = m.loads["load"].value[0]  # type: ignore[index,union-attr]
    s = Sided(value, "load 'F'")  # type: ignore[arg-type]
    assert s.at({"O2": 3.0}) == pytest.approx(2.0)
    assert s.at({"O2": 0.25}) == pytest.approx(-0.75)
    assert (s.sides, s.switches, s.side(0)) == ({0: 1.0}, [-0.75], 1.0)
    s.flip(0, -1.0)
    assert s.at({"O2": 0.25}) == pytest.approx(0.75)
    assert not s.beyond
    assert has_corners(value)
    smooth = da.slider_crank().with_values({"loads.load.value": ["cos(O2)", 0.0]})
    assert not has_corners(smooth.loads["load"].value[0])  # type: ignore[index,union-attr]


@pytest.mark.parametrize(
    ("side", "x", "rate", "depth", "push"),
    [
        (-1.0, 0.1, -3.0, 0.2, 10 * 0.2 + 2 * 3),
        (-1.0, 0.5, -3.0, -0.2, -2 + 6),
        (1.0, 1.5, 0.5, 0.7, 7 + 1),
        (1.0, 0.5, -3.0, -0.3, -3 - 6),
    ],
)
def test_the_push_of_a_stop_is_that_of_its_side(
    side: float, x: float, rate: float, depth: float, push: float
) -> None:
    stops = Stops(0.3, 0.8, stiffness=10.0, damping=2.0)
    assert stop_push(stops, side, np.array(x), np.array(rate)) == pytest.approx((depth, push))


def both(damping: float) -> ElasticStops:
    stops = Stops(0.3, 0.8, stiffness=10.0, damping=damping)
    return ElasticStops(None, "the stop of S", name="S", freedom="slide", stops=stops)


def state(x: float, rate: float) -> dict[str, float]:
    return {"S": x, "S.speed": rate}


@pytest.mark.parametrize(
    ("x", "rate", "force"), [(0.1, -3.0, 8.0), (0.5, 9.0, 0.0), (1.5, 0.5, -8.0), (0.1, 3.0, 0.0)]
)
def test_the_force_of_an_elastic_stop_stays_on_its_sides(x: float, rate: float, force: float) -> None:
    s = both(2.0)
    assert s.ends == [-1.0, 1.0]
    assert s.at(state(x, rate)) == pytest.approx(force)
    assert len(s.switches) == len(s.sides) == 4
    if force:
        assert s.at(state(0.5, 0.0)) == pytest.approx(10 * (0.3 - 0.5) if force > 0 else -10 * (0.5 - 0.8))
    one = ElasticStops(None, name="S", freedom="slide", stops=Stops(greatest=0.8, stiffness=10.0))
    assert one.ends == [1.0]
    assert one.at(state(1.0, -50.0)) == pytest.approx(-2.0)  # without damping it has one switch
    assert len(one.switches) == 1


def test_an_elastic_stop_says_where_it_is_met_and_left() -> None:
    s = both(0.0)
    s.at(state(0.1, -3.0))
    assert say(s.words(0, state(0.3, -3.0))) == "S meets its elastic stop at 0.3 m with 3 m/s"
    assert say(s.words(1, state(0.8, 2.0))) == "S leaves its elastic stop at 0.8 m"
    damped = both(2.0)
    damped.at(state(1.5, 0.5))  # pressed on its upper end
    assert [damped.sides[k] for k in range(4)] == [-1.0, -1.0, 1.0, 1.0]
    assert say(damped.words(2, state(0.8, 2.0))) == "S meets its elastic stop at 0.8 m with 2 m/s"
    assert say(damped.words(3, state(0.8, -2.5))) == "S meets its elastic stop at 0.8 m with 2.5 m/s"
    assert [damped.words(k, state(0.3, 1.0)) for k in (0, 1)] == [(), ()]  # the other switch is off
    damped.flip(3, -1.0)
    assert damped.words(2, state(0.8, -2.0)) == ()
    assert say(damped.words(3, state(0.8, -2.0))) == "S leaves its elastic stop at 0.8 m"
    turned = ElasticStops(None, name="S", freedom="turn", stops=Stops(-0.5, 0.8, stiffness=10.0))
    turned.at(state(-0.7, 0.0))
    assert say(turned.words(0, state(-0.5, -4.0))) == "S meets its elastic stop at -0.5 rad with 4 rad/s"


def test_full_turns_of_a_joint_are_counted_from_its_last_state_on() -> None:
    s: Any = object.__new__(ElasticState)
    stops = Stops(-0.5, 7.0, stiffness=10.0)
    s.turned = {}
    s.elastic_joints = {0: ElasticStops(None, name="S", freedom="turn", stops=stops)}

    def met(x: float) -> float:
        found = s.joint_motion(0, SimpleNamespace(freedoms=np.array([[x, 1.5, 0, 0]])))
        assert found["S.speed"] == 1.5
        return float(found["S"])

    first = met(0.4)
    assert first == pytest.approx(0.4 + 2 * math.pi * round((within(stops, 0.4) - 0.4) / (2 * math.pi)))
    s.turned = {0: 6.0}
    assert met(0.1) == pytest.approx(0.1 + 2 * math.pi)
    assert met(-0.1) == pytest.approx(2 * math.pi - 0.1)
    s.elastic_joints[0].freedom = "slide"
    assert met(0.1) == 0.1


class Corners(CornerState):
    """A state of one freedom at a rate, whose pace is 4 / s."""

    def __init__(self, *switching: Switch) -> None:
        self.d, self.switching, self.told = 1, [*switching], []  # type: ignore[var-annotated]
        self.acting: Any = SimpleNamespace(free=np.array([True]))
        self.lengths, self.gone_over = np.array([1.0]), math.nan

    def pace(self, t: float, y: Any) -> float:
        return 4.0

    def rate(self, t: float, y: Any) -> Any:
        return np.array([y[1], 6.0])

    def note(self, *said: Any) -> None:  # type: ignore[override]
        self.told.append(said)


def switch(value: Any, side: float = 1.0, **more: Any) -> Switch:
    held = [side]
    return Switch("load 'F'", value, lambda: held[0], lambda x: held.__setitem__(0, x), **more)


def test_a_state_shortly_after_goes_on_with_its_rate() -> None:
    t, y = Corners().soon(2.0, np.array([0.5, 3.0]))
    short = AHEAD / 4
    assert t - 2 == pytest.approx(short, rel=1e-6)
    assert y - [0.5, 3.0] == pytest.approx([3 * short + 3 * short**2, 6 * short], rel=1e-6)


@pytest.mark.parametrize(("slope", "side"), [(2.0, 1.0), (-2.0, -1.0)])
def test_a_switch_at_its_corner_takes_the_side_that_the_motion_goes_to(slope: float, side: float) -> None:
    s = Corners(switch(lambda t, y: slope * y[0], 0.0), switch(lambda t, y: -y[0], 1.0))
    s.take_sides = lambda t, y: None  # type: ignore[method-assign]
    start = np.array([0.0, 3.0])
    s.find_sides(0.0, start)
    assert start.tolist() == pytest.approx([CLEAR, 3.0], rel=1e-12)  # beyond the corner, for all that look
    assert [x.side() for x in s.switching] == [side, 1.0]
    assert [(g.kind, g.which, g.side) for g in s.corner_guards()] == [
        ("corner", 0, side),
        ("corner", 1, 1.0),
    ]
    held = [0.0]
    jump = Switch("load 'F'", lambda t, y: -held[0] * t, lambda: held[0], lambda x: held.__setitem__(0, x))
    jump.value = lambda t, y: (1.0 if held[0] == 0 else -held[0]) * slope * y[0]
    pushed = Corners(jump)
    pushed.take_sides = lambda t, y: None  # type: ignore[method-assign]
    if slope > 0:
        with pytest.raises(StoppedError, match="load 'F' jumps at this state and pushes back"):
            pushed.find_sides(0.0, np.array([0.0, 3.0]))
    else:
        pushed.find_sides(0.0, np.array([0.0, 3.0]))
        assert held == [-1.0]


def gone_over(s: Corners, k: int = 0, t: float = 1.0) -> None:
    x = s.switching[k]
    s.go_over(Guard("corner", k, x.value, x.side()), t, np.array([0.5, 3.0]))


def test_a_switch_goes_over_to_its_other_side_with_its_words() -> None:
    plain = switch(lambda t, y: y[0], 1.0)
    told = switch(lambda t, y: y[0], -1.0, words=lambda t, y: ("it is met",), beyond=lambda: True)
    s = Corners(plain, told)
    gone_over(s, 0)
    gone_over(s, 1, 2.0)
    assert [x.side() for x in s.switching] == [-1.0, 1.0]
    assert [x.passed for x in s.switching] == [[1.0], [2.0]]
    sentence = "load 'F' is beyond the end of its table from here on"
    assert s.told == [(2.0, "stop", "it is met"), (2.0, "table end", sentence)]


def test_switches_within_each_other_go_over_together() -> None:
    """max(0, q sign(q)) just below 0: the jump inside goes over, by which the maximum is where it was; in either order,
    and also where only one of them is met."""
    for order in ([0, 1], [1, 0], [0]):
        inner = switch(lambda t, y: y[0], 1.0)
        outer = switch(lambda t, y, inner=inner: -y[0] * inner.side(), -1.0)
        s = Corners(inner, outer)
        y = np.array([-1e-9, -3.0])
        guards = s.corner_guards()
        for k in order:
            s.go_over(guards[k], 1.0, y)
        assert [x.side() for x in s.switching] == [-1.0, -1.0]
        assert len(inner.passed) == 1
    jump = switch(lambda t, y: y[0], 1.0)
    above = switch(lambda t, y: -jump.side(), -1.0)  # max(0, sign(q))
    table = switch(lambda t, y: -jump.side(), -1.0, nests=False)
    s = Corners(jump, above, table)
    s.go_over(s.corner_guards()[0], 1.0, np.array([-1e-9, -3.0]))
    assert [x.side() for x in s.switching] == [-1.0, 1.0, -1.0]
    level = switch(lambda t, y: jump.side() + 1.0, 1.0)  # sign(sign(q) + 1)
    jump.flip(1.0)
    s = Corners(jump, level)
    s.go_over(s.corner_guards()[0], 1.0, np.array([-1e-9, -3.0]))
    assert [x.side() for x in s.switching] == [-1.0, 0.0]


@pytest.mark.parametrize(("sense", "holds"), [(1.0, True), (-1.0, False)])
def test_a_jump_with_a_speed_that_pushes_back_is_dry_friction(sense: float, holds: bool) -> None:
    """By its speed alone; where its value does not go by the speed it is no friction."""
    for value, dry in ((lambda t, y: sense * y[1], holds), (lambda t, y: sense * y[0], False)):
        s = Corners(switch(value, 1.0))
        if dry:
            with pytest.raises(StoppedError, match="load 'F' jumps with a speed and pushes back"):
                gone_over(s)
        else:
            gone_over(s)
            assert s.switching[0].passed == [1.0]


@pytest.mark.parametrize(
    ("step", "factor", "stops"),
    [
        (2e-4, 0.5, True),
        (2e-4, 0.96, False),  # no sooner than by a part of what it was 41 times before
        (0.5, 0.5, False),  # too slow for a jump that holds
    ],
)
def test_a_switch_that_passes_ever_sooner_holds_the_machine(step: float, factor: float, stops: bool) -> None:
    """Two passes apart by ``step`` now, and by ``step`` over ``factor`` forty passes before."""
    s = Corners(switch(lambda t, y: y[0], 1.0))
    early = step / (0.99 if factor > 0.95 else factor) / 2
    passed = list(np.cumsum([early] * 42))
    s.switching[0].passed = passed
    if stops:
        with pytest.raises(StoppedError, match="it passes the jump ever sooner"):
            gone_over(s, t=passed[-2] + step)
    else:
        gone_over(s, t=passed[-2] + step)
    few = Corners(switch(lambda t, y: y[0], 1.0))
    few.switching[0].passed = passed[:30]
    gone_over(few, t=passed[28] + step)
    assert len(few.switching[0].passed) == 31


RISE = Rise("polynomial345", 0.2, 0.9, 0.4, 5)
TIMES = TimeTable((0.5, 1.0, 1.75, 2.5), (0.1, 0.7, 0.4, 0.1), 5)


def test_a_rise_is_at_rest_before_and_behind_it() -> None:
    law = PrescribedLaw("S", RISE)
    assert law.joints.tolist() == [0.0, 0.4]
    assert law.period == math.inf
    assert [law.next_joint(t) for t in (-1.0, 0.0, 0.1, 0.4, 0.5)] == [0.0, 0.4, 0.4, math.inf, math.inf]
    assert law.at(-0.1).tolist() == [0.2, 0.0, 0.0]
    assert law.at(0.5).tolist() == law.at(0.4).tolist() == [0.9, 0.0, 0.0]
    u = 0.3
    exact = [
        0.2 + 0.7 * (10 * u**3 - 15 * u**4 + 6 * u**5),
        0.7 / 0.4 * 30 * (u - u * u) ** 2,
        0.7 / 0.16 * 60 * u * (1 - u) * (1 - 2 * u),
    ]
    assert law.at(0.12) == pytest.approx(exact)
    law.end = 0.12  # no further is looked
    assert law.at(0.3) == pytest.approx(exact)
    harmonic = PrescribedLaw("S", Rise("harmonic", 0.2, 0.9, 0.4, 5), end=0.4)
    assert harmonic.at(0.4) == pytest.approx([0.9, 0.0, -0.7 * math.pi**2 / 2 / 0.16])


def test_a_table_of_positions_ends_or_repeats() -> None:
    law = PrescribedLaw("S", TIMES)
    assert (law.joints.tolist(), law.period) == ([0.5, 1.0, 1.75, 2.5], math.inf)
    assert [law.next_joint(t) for t in (0.0, 0.5, 1.2, 2.4, 2.5)] == [0.5, 1.0, 1.75, 2.5, math.inf]
    for t in (0.5, 1.3, 2.5):
        assert law.at(t) == pytest.approx(np.array(TIMES.at(t)), abs=1e-15)
    for t in (0.49, 2.51):
        with pytest.raises(StoppedError, match=r"the law of S ends at 2\.5 s"):
            law.at(t)
    again = PrescribedLaw("S", TimeTable(TIMES.time, TIMES.position, 5, periodic=True))
    assert again.period == 2.0
    joints = [again.next_joint(t) for t in (0.6, 2.4, 2.5, 3.1, 6.4, 6.5)]
    assert joints == pytest.approx([1.0, 2.5, 3.0, 3.75, 6.5, 7.0])
    assert again.at(2.9) == pytest.approx(again.at(0.9), abs=1e-12)
