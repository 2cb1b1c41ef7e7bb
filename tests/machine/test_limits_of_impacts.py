"""Impacts and contacts of motions at their limits: who strikes, when, with which impulses, and what is said."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.machine.motion.equation import StoppedError
from dalembert.machine.motion.occurrences import Guard
from dalembert.machine.motion.stops.clutch_stops import ClutchState
from dalembert.machine.motion.stops.gap_contacts import GapContact
from dalembert.machine.motion.stops.impacts import LEFT, LOOKS, Stop, StopState, _impulses, _stays
from dalembert.machine.motion.stops.touching import TouchState
from dalembert.model.drives.end_stops import Stops

UNKNOWN: Any = None


def test_a_stop_has_two_ends_and_turns_of_joints_are_near_them() -> None:
    turn, drive, slide = (
        Stop("S", freedom, Stops(-0.5, 0.75), **{kind: 0})  # type: ignore[arg-type]
        for freedom, kind in (("turn", "joint"), ("turn", "drive"), ("slide", "joint"))
    )
    assert (turn.end(-1.0), turn.end(1.0)) == (-0.5, 0.75)
    assert turn.near(0.25, 7.0) == pytest.approx(0.25 + 2 * math.pi)
    assert turn.near(0.25, -5.0) == pytest.approx(0.25 - 2 * math.pi)
    assert turn.near(0.25, 3.0) == 0.25
    assert math.isnan(turn.near(math.nan, 3.0))
    assert (drive.near(0.25, 7.0), slide.near(0.25, 7.0)) == (0.25, 0.25)


def test_impulses_push_and_leave_no_gap_that_closes() -> None:
    """Of one that is met I = gap / response; of several the complementary ones: by hand."""
    assert _impulses(np.array([[4.0]]), np.array([6.0])).tolist() == [1.5]
    assert _impulses(np.array([[4.0]]), np.array([-6.0])).tolist() == [0.0]
    pair = np.array([[2.0, 1.0], [1.0, 3.0]])
    assert _impulses(pair, np.array([5.0, 10.0])) == pytest.approx([1.0, 3.0])
    assert _impulses(pair, np.array([6.0, 1.0])) == pytest.approx([3.0, 0.0])  # the second is pushed off
    assert _impulses(pair, np.array([-1.0, 6.0])) == pytest.approx([0.0, 2.0])
    assert _impulses(pair, np.array([-1.0, -6.0])) == pytest.approx([0.0, 0.0])
    twice = np.array([[2.0, 2.0], [2.0, 2.0]])  # two stops at one place share it
    assert twice @ _impulses(twice, np.array([4.0, 4.0])) == pytest.approx([4.0, 4.0])


class Striking(StopState):
    """A state whose stop has the told path."""

    def __init__(self, path: Any, rate: Any, least: float = -math.inf, greatest: float = math.inf) -> None:
        self.stops = [Stop("S", "slide", Stops(least, greatest), drive=0)]
        self.stops[0].looks = [(0.0, path(0.0), rate(0.0))]
        self.path, self.rated, self.asked = path, rate, 0

    def motion_of(self, stop: Any, t: float, y: Any) -> tuple[float, float]:
        self.asked += 1
        return float(self.path(t)), float(self.rated(t))

    def met(self, side: float, after: float = 1.0) -> float | None:
        return self.strikes(Guard("stop", 0, UNKNOWN, -side), lambda t: UNKNOWN, 0.0, after)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_stop_is_met_where_the_path_first_reaches_it(sign: float) -> None:
    """Also where the step ends before it again; a stop that is not reached is not met."""

    def striking(path: Any, rate: Any, end: float) -> Striking:
        ends = {"greatest": end} if sign > 0 else {"least": -end}
        return Striking(lambda t: sign * path(t), lambda t: sign * rate(t), **ends)

    line = striking(lambda t: 0.2 + t, lambda t: 1.0, 0.75)
    assert line.met(sign) == pytest.approx(0.55, abs=1e-14)
    assert len(line.stops[0].looks) == LOOKS
    asked = line.asked
    line.met(sign)
    assert line.asked - asked < LOOKS  # the looks of the same step are kept
    assert striking(lambda t: 0.2 + t, lambda t: 1.0, 1.25).met(sign) is None
    bow = striking(lambda t: 4 * t * (1 - t), lambda t: 4 - 8 * t, 0.9)
    assert bow.met(sign) == pytest.approx((1 - math.sqrt(0.1)) / 2, rel=1e-12)
    assert bow.met(sign, 0.25) is None


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_part_on_its_stop_that_leaves_it_first_meets_it_when_it_comes_back(sign: float) -> None:
    """From a place within rounding of the stop; one that only goes on is met at once."""
    for place in (0.0, 0.5 * LEFT):
        path = lambda t, place=place: sign * (place - 3 * t * (0.05 - t))  # noqa: E731
        s = Striking(
            path, lambda t: sign * (6 * t - 0.15), **({"greatest": 0.0} if sign > 0 else {"least": 0.0})
        )
        assert s.met(sign) == pytest.approx(0.05, rel=1e-9)
    on = Striking(lambda t: sign * t, lambda t: sign, **({"greatest": 0.0} if sign > 0 else {"least": 0.0}))
    assert on.met(sign) == 0.0


@pytest.mark.parametrize(
    ("contact", "way", "said"),
    [(None, 0.0, "stays on its stop"), (None, -1.0, "holds"), (True, -1.0, "stays in contact")],
)
def test_what_rests_on_a_stop_says_how(contact: Any, way: float, said: str) -> None:
    assert _stays(Stop("S", "slide", Stops(), contact=contact, way=way)) == said


class Impacts(StopState):
    """A state of two free drives that notes what it is told."""

    def __init__(self, dry: bool = False, count: int = 2) -> None:
        self.equation: Any = SimpleNamespace(dry=dry)
        self.acting: Any = SimpleNamespace(free=np.ones(count, bool))
        self.losses, self.events, self.d = [], [], 2


@pytest.mark.parametrize(("dry", "count", "rough"), [(True, 2, True), (True, 1, False), (False, 2, False)])
def test_an_impact_is_told_with_its_place_speeds_and_loss(dry: bool, count: int, rough: bool) -> None:
    s = Impacts(dry, count)
    left = " (friction during the impact is left out)" if rough else ""
    stop = Stop("S", "slide", Stops(-0.5, 0.75), drive=0)
    s._note_impact(stop, 1.0, 2.0, (3.0, 1.5, 7.0))
    s._note_impact(stop, -1.0, 2.5, (3.0, 0.0, 9.0))
    first, second = s.events
    told = "S strikes its stop at 0.75 m with 3 m/s and rebounds at 1.5 m/s; 7 J are lost"
    assert first.sentence == told + left
    assert (
        second.sentence == "S strikes its stop at -0.5 m with 3 m/s and does not rebound; 9 J are lost" + left
    )
    assert (first.name, first.of, first.speed, first.lost, first.time) == ("impact", "S", 3.0, 7.0, 2.0)
    assert s.losses == [(2.0, 7.0), (2.5, 9.0)]
    gap = GapContact("G", "gap_ahead", 1.0, 0.0, 0.2)
    s._note_impact(Stop("G", "gap_ahead", Stops(), contact=gap), 1.0, 2.0, (3.0, 0.0, 7.0))
    landed = s.events[-1]
    assert (landed.name, landed.of) == ("landing", "G.ahead")
    assert landed.sentence.startswith("G lands at its front end with 3 m/s and does not rebound")


def test_a_stop_touches_what_rests_on_it_or_is_within_rounding_of_it() -> None:
    for x, touches in ((0.75, True), (0.75 - 1.7e-12, True), (0.75 + 1.7e-12, True), (0.75 - 1.8e-12, False)):
        s: Any = Striking(lambda t, x=x: x, lambda t: 0.0, -0.5, 0.75)
        assert s._touches(s.stops[0], 1.0, 0.0, UNKNOWN) is touches
        assert not s._touches(s.stops[0], -1.0, 0.0, UNKNOWN)
        s.stops[0].resting = -1.0
        assert s._touches(s.stops[0], -1.0, 0.0, UNKNOWN)
    s = Striking(lambda t: 0.2, lambda t: 0.0)
    assert not s._touches(s.stops[0], 1.0, 0.0, UNKNOWN)


def test_motions_of_stops_are_those_of_their_drive_or_joint() -> None:
    s: Any = Impacts()
    freedoms = np.array([[9.0, 9, 9, 9, 9], [0.25, -4.0, 1.5, 2.0, 7.0]])
    s.equation = lambda t, q, u: SimpleNamespace(freedoms=freedoms)
    joint, drive = Stop("J", "slide", Stops(), joint=1), Stop("S", "slide", Stops(), drive=1)
    y = np.array([0.5, 0.75, 3.0, 5.0])
    assert s.motion_of(joint, 0.0, y) == (0.25, -4.0)
    assert s.motion_of(drive, 0.0, y) == (0.75, 5.0)
    assert s._row(joint, s.equation(0, 0, 0)).tolist() == [2.0, 7.0]
    assert s._row(drive, s.equation(0, 0, 0)).tolist() == [0.0, 1.0]
    s._others_move = lambda: False
    assert (s._drive_of(joint), s._drive_of(drive)) == (-1, 1)
    s.acting.free[0] = False
    assert (s._drive_of(joint), s._drive_of(drive)) == (1, 1)
    s._others_move = lambda: True
    assert (s._drive_of(joint), s._drive_of(drive)) == (-1, 1)


class Clutch(ClutchState):
    """A state with one clutch."""

    def __init__(self, way: float, pitch: float, angle: float = 0.3) -> None:
        self.fastest = np.array([2.0, 10.0])
        self.m: Any = SimpleNamespace(joints={"C": SimpleNamespace(angle=angle)})
        self.stops = [Stop("C", "turn", Stops(), joint=0, way=way, pitch=pitch)]


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_clutch_holds_where_it_starts_unless_it_turns(way: float) -> None:
    """Slower than a billionth of the fastest is rest; a ratchet holds at the last tooth that it has passed."""
    for rate, holds in ((0.0, True), (1e-8, True), (1.01e-8, False), (3.0, False), (-1e-8, True)):
        s = Clutch(way, 0.0)
        s._place_clutch(s.stops[0], 0.9, way * rate)
        ends = (s.stops[0].end(-way), s.stops[0].end(way))
        assert ends == (0.9 if holds else -way * math.inf, way * math.inf)
        assert s.stops[0].looks == [(0.0, 0.9, way * rate)]
    with pytest.raises(Exception, match="C starts to turn in the sense that it blocks"):
        Clutch(way, 0.0)._place_clutch(s.stops[0], 0.9, -way * 1.01e-8)
    for x, tooth in ((0.9, 0.8), (0.8, 0.8), (0.8 - 1e-13, 0.8), (0.79, 0.55), (0.2, 0.05), (1.06, 1.05)):
        s = Clutch(way, 0.25, way * 0.3)
        s._place_clutch(s.stops[0], way * x, way * 3.0)
        assert s.stops[0].end(-way) == pytest.approx(way * tooth)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_clutch_latches_where_it_rests_and_a_ratchet_at_its_next_tooth(way: float) -> None:
    s: Any = Clutch(way, 0.25)
    s.motion_of = lambda stop, t, y: (way * 0.9, way * 2.0)
    s._hold_from(s.stops[0], way * 0.8)
    (guard,) = s.clutch_guards()
    assert (guard.kind, guard.which, guard.side) == ("clutch", 0, 1.0)
    assert guard.value(0.0, UNKNOWN) == pytest.approx(1.05 - 0.9)
    assert not s.latch(0, 0.0, UNKNOWN)
    assert s.stops[0].end(-way) == pytest.approx(way * 1.05)
    s._let_turn(s.stops[0])
    assert s.stops[0].end(-way) == pytest.approx(way * 1.05)
    plain: Any = Clutch(way, 0.0)
    plain.motion_of = s.motion_of
    (guard,) = plain.clutch_guards()
    assert guard.value(0.0, UNKNOWN) == pytest.approx(2.0)
    assert plain.latch(0, 0.0, UNKNOWN)
    assert plain.stops[0].end(-way) == way * 0.9
    assert plain.clutch_guards() == []  # it holds
    plain.stops[0].resting = 1.0
    plain._let_turn(plain.stops[0])
    assert (plain.stops[0].end(-way), plain.stops[0].resting) == (-way * math.inf, 0.0)


class Touching(TouchState):
    """Contacts by gaps that are drives, with told efforts and accelerations."""

    def __init__(self, *contacts: GapContact) -> None:
        self.contacts, self.closed, self.before = contacts, set(), set()
        self.equation: Any = SimpleNamespace(dry=None)
        self.told: list[Any] = []

    def note(self, *said: Any, of: str = "") -> None:
        self.told.append((*said, of))


GAPS = [
    GapContact(n, "gap", side, 0.0, 0.0, drive=k)
    for k, (n, side) in enumerate(zip("ABC", (1, -1, 1), strict=True))
]


@pytest.mark.parametrize(
    ("pushing", "closed", "said"),
    [
        ([{"A", "B", "C"}], "ABC", []),
        ([{"A", "C"}], "AC", ["B lifts off"]),
        ([{"B"}, set()], "B", ["A lifts off"]),
        ([{"C"}, {"A", "B"}], "AB", []),  # sets with most closed ones are tried first
        ([set()], "", ["A lifts off", "B lifts off"]),
    ],
)
def test_contacts_that_touch_are_closed_as_many_as_push(pushing: Any, closed: str, said: list[str]) -> None:
    s: Any = Touching(*GAPS)
    s.closed = {GAPS[0], GAPS[1]}
    s._touching = lambda c, y: True

    def close_some(near: Any, some: Any, y: Any) -> None:
        s.closed = {c for c, stays in zip(near, some, strict=True) if stays}
        y[:] = 7.0

    s._close_some = close_some
    s._pushes_all = lambda near, t, y: {c.joint for c in s.closed} in pushing
    s.decide_gaps(2.0, np.zeros(3))
    assert {c.joint for c in s.closed} == {*closed}
    assert sorted(s.told) == [(2.0, "lift-off", text, text[0]) for text in said]


def test_contacts_of_which_no_set_pushes_stop_the_motion() -> None:
    s: Any = Touching(*GAPS)
    s.closed = {GAPS[1]}
    s._touching = lambda c, y: c is not GAPS[2]
    s._pushes_all = lambda near, t, y: False
    s._close_some = lambda near, some, y: setattr(
        s, "closed", {c for c, stays in zip(near, some, strict=True) if stays}
    )
    with pytest.raises(StoppedError, match="no set of the contacts A, B satisfies the signs"):
        s.decide_gaps(2.0, np.zeros(3))
    assert s.closed == {GAPS[1]}
    many: Any = Touching(*(GapContact(f"G{k}", "gap", 1.0, 0.0, 0.0, drive=k) for k in range(11)))
    many._touching = lambda c, y: True
    with pytest.raises(StoppedError, match="11 contacts touch at once; 10 can be decided"):
        many.decide_gaps(2.0, np.zeros(3))


def test_closed_contacts_push_and_open_ones_open_but_for_rounding() -> None:
    s: Any = Touching(*GAPS)
    s.soon = lambda t, y: (t, y)
    s.closed = {GAPS[0], GAPS[1]}
    for effort, a, good in (
        ([5.0, -7, 0], [0, 0, 2.0], True),
        ([-6e-9, -7, 0], [0, 0, 2.0], True),
        ([-8e-9, -7, 0], [0, 0, 2.0], False),
        ([5.0, 8e-9, 0], [0, 0, 2.0], False),
        ([5.0, -7, 0], [3.0, 0, -2.9e-9], True),
        ([5.0, -7, 0], [3.0, 0, -3.1e-9], False),
    ):
        s.at = lambda t, y, effort=effort, a=a: (np.array(a), np.array(effort), UNKNOWN)
        assert s._pushes_all(GAPS, 0.0, UNKNOWN) is good
    s.at = lambda t, y: (UNKNOWN, np.array([5.0, -7, 4]), UNKNOWN)
    assert {c.joint: f for c, f in s.normals(0.0, UNKNOWN).items()} == {"A": 5.0, "B": 7.0}
    assert [s.contact_force(c, 0.0, UNKNOWN) for c in GAPS] == [5.0, 7.0, 0.0]


def test_why_a_motion_stops_names_the_contacts_that_are_lost() -> None:
    s: Any = Touching(*GAPS)
    s.closed = {*GAPS}
    assert s.why_stopped("no reason") == "no reason"
    s.closed = {GAPS[1]}
    assert s.why_stopped("no reason").startswith("without contact at A and C the gaps do not determine")
    slides: Any = Touching(GapContact("S", "slide", 1.0, 0.0, 0.0, drive=0))
    assert slides.why_stopped("no reason") == "no reason"


@pytest.mark.parametrize(
    ("speed", "near", "closed", "touching"),
    [
        (5e-9, True, False, True),  # a billionth of the greatest speed so far
        (-5e-9, True, False, True),
        (5.1e-9, True, False, False),
        (-5.1e-9, True, False, False),
        (0.0, False, False, False),
        (3.0, False, True, True),
    ],
)
def test_a_contact_touches_where_its_gap_is_closed_and_stays(
    speed: float, near: bool, closed: bool, touching: bool
) -> None:
    s: Any = Touching(*GAPS)
    s.d, s.fastest, s.gap_stops = 3, np.array([5.0, 2.0, 1.0]), dict.fromkeys(GAPS, "stop")
    s.closed = {GAPS[1]} if closed else set()
    asked: list[Any] = []
    s._touches = lambda stop, side, t, y: asked.append((stop, side)) or near  # type: ignore[func-returns-value]
    y = np.array([9.0, 9, 9, 9, speed, 9, 9])
    assert bool(s._touching(GAPS[1], y)) is touching
    assert asked == ([("stop", 1.0)] if abs(speed) <= 5e-9 and not closed else [])


def test_a_guide_with_friction_is_not_followed_on_one_end() -> None:
    ends = [GapContact("G", f, 1.0, 0.0, 0.0, drive=k) for k, f in enumerate(("gap_behind", "gap_ahead"))]
    s: Any = Touching(*ends, GapContact("H", "gap", 1.0, 0.0, 0.0, drive=2))
    s.m = SimpleNamespace(joints={"G": None, "H": None})
    for moving, resting, closed, refused in (
        (0.2, 0.0, ends[:1], True),
        (0.0, 0.2, ends[1:], True),
        (0.0, 0.0, ends[:1], False),
        (0.2, 0.2, ends, False),
        (0.2, 0.2, [], False),
        (0.2, 0.2, [s.contacts[2]], False),
    ):
        contacts = SimpleNamespace(
            coefficient=np.array([moving, 0.0]), resting=np.array([resting, 0.0]), joint=np.array([0, 1])
        )
        s.equation.dry, s.closed = SimpleNamespace(contacts=contacts), set(closed)
        if refused:
            with pytest.raises(StoppedError, match="G tips, and its guide has friction"):
                s._refuse_rough_tips()
        else:
            s._refuse_rough_tips()
            assert s.closed == set(closed)
