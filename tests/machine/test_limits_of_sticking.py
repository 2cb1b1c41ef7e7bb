"""Contacts that stick, by told pushes and forces: which are at rest, which sets are tried, and which are lawful."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.machine.motion.equation import StoppedError
from dalembert.machine.motion.occurrences import say
from dalembert.machine.motion.rest.standstill import EVEN, STILL
from dalembert.machine.motion.rest.sticking import MOST, StickState

UNKNOWN: Any = None
OWN = np.array([2, 0, 1])


class Sticking(StickState):
    """Two drives and three contacts that slip by themselves; ``push``: how the drives change their rates."""

    def __init__(self, push: Any = ((1.0, 2.0, 0.0), (0.0, 0.0, 1.0)), rates: Any = (0.0, 0.0, 0.0)) -> None:
        self.d, self.m = 2, UNKNOWN
        columns = np.zeros((2, 3))
        columns[:, OWN] = push
        own_rates = np.zeros(3)
        own_rates[OWN] = rates
        terms = SimpleNamespace(rates=own_rates, linear=SimpleNamespace(push=columns))

        def equation(t: float, q: Any, u: Any) -> Any:
            return terms

        equation.dry, equation.joints = SimpleNamespace(own=OWN, last="z"), ("A", "B", "C")  # type: ignore[attr-defined]
        self.equation: Any = equation
        self.acting: Any = SimpleNamespace(
            free=np.ones(2, bool), names=("P", "Q"), brake=np.zeros(2), lossy=np.zeros(2, bool)
        )
        self.fastest, self.lengths = np.array([4.0, 1.0]), np.array([1.0, 0.5])
        self.locked, self.bound, self.on_stop = np.zeros(2, bool), np.zeros(2, bool), np.zeros(2)
        self.stuck, self.tied = np.zeros(3, bool), np.zeros(3, bool)
        self.sense, self.toward, self.events = np.ones(3), np.ones(2), []


def test_a_drive_is_slow_below_a_part_of_its_own_speed_or_of_the_machines_pace() -> None:
    s = Sticking()
    assert s._pace_speeds.tolist() == [4.0, 2.0]
    assert s._slowest == pytest.approx([4 * STILL, STILL])
    s.fastest = np.array([4.0, 0.0])
    assert s._slowest == pytest.approx([4 * STILL, 2e-14])


def test_a_drive_is_kept_by_its_brake_its_gear_or_its_stop() -> None:
    for name in ("brake", "lossy"):
        s = Sticking()
        getattr(s.acting, name)[1] = 1
        assert s._kept.tolist() == [False, True]
    s = Sticking()
    s.on_stop[0] = -1.0
    assert s._kept.tolist() == [True, False]
    assert not Sticking()._kept.any()


def test_contacts_rest_whose_rates_are_small_beside_those_of_the_drives() -> None:
    """By the greatest speeds so far times what each changes of a rate: 4, 8 and 1 m/s."""
    for part, resting in ((0.99, [0, 1, 2]), (1.01, [])):
        s = Sticking(rates=np.array([4.0, -8.0, 1.0]) * STILL * part)
        found, rates, push = s._resting(0.0, np.zeros(6))
        assert found.tolist() == resting
        assert rates == pytest.approx(np.array([4.0, -8.0, 1.0]) * STILL * part)
        assert push.tolist() == [[1, 2, 0], [0, 0, 1]]
    s = Sticking(rates=(1.0, 1.0, 1.0))
    s.tied[1] = True
    assert s._resting(0.0, np.zeros(6))[0].tolist() == [1]
    s = Sticking()
    s.acting.free[1] = False
    assert s._resting(0.0, np.zeros(6))[0].tolist() == [0, 1]
    s = Sticking()
    s.locked[0] = True
    assert s._resting(0.0, np.zeros(6))[0].tolist() == [0, 1, 2]  # it is held by contacts alone
    s.acting.brake[0] = 3.0
    assert s._resting(0.0, np.zeros(6))[0].tolist() == [2]
    bare = Sticking()
    bare.equation.dry = None
    assert [len(x.ravel()) for x in bare._resting(0.0, np.zeros(6))] == [0, 0, 0]


def test_what_is_left_of_rates_at_rest_is_taken_from_the_speeds() -> None:
    """The rate of a contact falls by its push times the speed: both vanish, and what is rounding of a drive too."""
    s, push = Sticking(), np.array([[2.0], [0.0]])
    y = np.array([0.0, 0, 0.5, 3.0])
    s._stop(push, np.array([-1.0]), y)
    assert y[2:].tolist() == [0.0, 3.0]
    y = np.array([0.0, 0, 0.5, 3.0])
    s._stop(push, np.array([-1.4]), y)
    assert y[2:] == pytest.approx([-0.2, 3.0])
    y = np.array([0.0, 0, 3e-9, 0.9e-9])
    s._stop(push, np.zeros(1), y)
    assert y[2:].tolist() == [0.0, 0.9e-9]
    s._stop(np.zeros((2, 0)), np.zeros(0), y)
    assert y[3] == 0.9e-9


@pytest.mark.parametrize(
    ("second", "size", "room", "cz", "lawful"),
    [
        ([0, 3.0, 0], [1, 1, 1], [5, 0, 0], [2, 0, 0], True),
        ([0, -3.0, 0], [1, 1, 1], [5, 0, 0], [2, 0, 0], False),  # it goes against its sense
        ([0, -0.9 * EVEN, 0], [1, 1, 1], [5, 0, 0], [2, 0, 0], True),
        ([0, -1.1 * EVEN, 0], [1, 1, 1], [5, 0, 0], [2, 0, 0], False),
        ([0, 3.0, 0], [1, 1, 1], [-1.9 * EVEN, 0, 0], [-2, 0, 0], True),
        ([0, 3.0, 0], [1, 1, 1], [-2.1 * EVEN, 0, 0], [-2, 0, 0], False),  # more than it can hold
    ],
)
def test_a_set_is_lawful_where_what_sticks_holds_and_what_slips_goes_on(
    second: Any, size: Any, room: Any, cz: Any, lawful: bool
) -> None:
    """Of contacts 1 (which sticks) and 2 (which slips in the sense 1), by their places among all."""
    s: Any = Sticking()
    parts = {"second": second, "size": size, "room": room, "cz": cz}
    s.solved = lambda t, y: (SimpleNamespace(**{k: np.array(x, float) for k, x in parts.items()}), UNKNOWN)
    resting, choice = np.array([1, 2]), np.array([0.0, 1.0])
    assert s._lawful(resting, choice, np.array([False, True]), 0.0, UNKNOWN) is lawful
    if second[1] < 0:  # one that cannot move by itself is not asked
        assert s._lawful(resting, choice, np.array([False, False]), 0.0, UNKNOWN)


def chosen(lawful: Any, leaving: Any = (), sense: Any = (1.0, 1.0, 1.0)) -> tuple[Any, list[Any]]:
    """The state after a choice among sets for contacts at rest, and the sets that were tried."""
    s: Any = Sticking()
    tried: list[Any] = []
    s.sense = np.array(sense)
    s.solved = lambda t, y: (SimpleNamespace(cz=np.array([-7.0, 8.0, -9.0])), UNKNOWN)

    def told(resting: Any, choice: Any, loose: Any, t: float, y: Any) -> bool:
        tried.append((choice.tolist(), loose.tolist()))
        return bool(lawful(choice.tolist()))

    s._lawful = told
    resting, _, push = s._resting(0.0, np.zeros(6))
    y = np.array([0.0, 0, 0.0, 0.5])
    s._choose(resting, push, 2.0, y, leaving)
    return s, tried


def test_sets_with_most_sticking_contacts_are_tried_first() -> None:
    """The first two slip together: one of them sticks at most, beside the third."""
    s, tried = chosen(lambda choice: True)
    assert tried == [([0, 1, 0], [False, False, False])]
    assert s.stuck.tolist() == [False, True, True]  # by their places among all contacts
    assert s.tied.tolist() == [True, True, True]
    assert s.bound.tolist() == [True, False]  # the second drive moves
    assert s.equation.dry.last is None
    assert [(e.of, say(e.words)) for e in s.events] == [
        ("A", "A sticks: its friction holds it"),
        ("C", "C sticks: its friction holds it"),
    ]
    s, tried = chosen(lambda choice: choice.count(0) == 0)
    counts = [sum(x != 0 for x in choice) for choice, _ in tried]
    assert counts == sorted(counts)
    assert all(len(loose) == 3 for _, loose in tried)
    assert not s.stuck.any()
    assert (s.tied.any(), s.bound.any()) == (False, False)


def test_contacts_that_leave_slip_against_their_friction() -> None:
    _, tried = chosen(lambda choice: True, leaving=[0])
    choice, _ = tried[0]
    assert choice[0] == 1.0  # friction -9 pushes back
    assert choice[1:] == [0, 0]
    _, tried = chosen(lambda choice: True, leaving=[2])
    assert tried[0][0][2] == -1.0
    assert tried[0][1] == [False, False, True]


def test_where_no_set_is_lawful_the_machine_jams_as_it_was() -> None:
    with pytest.raises(
        StoppedError, match=r"the machine jams: for A, B, C, at rest, neither sticking nor slipping"
    ):
        chosen(lambda choice: False)
    s: Any = Sticking()
    s.stuck[:], s.tied[:], s.bound[:] = True, True, True
    s._choose(np.array([], int), np.zeros((2, 3)), 0.0, np.zeros(6), [])
    assert not np.concatenate([s.stuck, s.tied, s.bound]).any()


def test_too_many_sets_are_refused() -> None:
    s: Any = Sticking(push=np.eye(2, 3))
    s.solved = lambda t, y: (SimpleNamespace(cz=np.zeros(3)), UNKNOWN)
    count = 9
    assert 3**count > MOST > 3 ** (count - 1)
    s.sense = np.ones(count)
    s._options(np.arange(count - 1), np.eye(count)[:, : count - 1], 0.0, UNKNOWN, [])
    with pytest.raises(
        StoppedError, match="9 contacts come to rest at once, in 9 independent directions; which"
    ):
        s._options(np.arange(count), np.eye(count), 0.0, UNKNOWN, [])


def test_drives_begin_in_the_sense_of_their_acceleration() -> None:
    """Those that are slow, free, and held by nothing."""
    s: Any = Sticking()
    s.soon = lambda t, y: (t, y)
    s.at = lambda t, y: (np.array([-3.0, -5.0]), UNKNOWN, UNKNOWN)
    s._begin(0.0, np.array([0.0, 0, 3.9e-9, 1.1e-9]))
    assert s.toward.tolist() == [-1.0, 1.0]
    for name in ("locked", "bound", "on_stop"):
        s.toward[:] = 1.0
        getattr(s, name)[1] = 1
        s._begin(0.0, np.zeros(4))
        assert s.toward.tolist() == [-1.0, 1.0]
        getattr(s, name)[1] = 0
    s.at = lambda t, y: (np.array([0.0, 5.0]), UNKNOWN, UNKNOWN)
    s.toward[:] = -1.0
    s._begin(0.0, np.zeros(4))
    assert s.toward.tolist() == [1.0, 1.0]


class Settling(Sticking):
    """A state whose decisions are kept."""

    def __init__(self, **more: Any) -> None:
        super().__init__(**more)
        self.done: list[Any] = []

    def _settle(self, k: int, t: float, y: Any) -> None:
        self.done.append(k)

    def _choose(self, resting: Any, push: Any, t: float, y: Any, leaving: Any) -> None:
        self.done.append(("choose", resting.tolist(), list(leaving)))

    def _begin(self, t: float, y: Any) -> None:
        self.done.append("begin")


def test_a_machine_of_one_freedom_is_decided_on_by_its_drive_and_others_by_their_contacts() -> None:
    s = Settling()
    assert s.settle([1], 2.0, np.zeros(6), [0]) == [0, 1, 2]
    assert s.done == [("choose", [0, 1, 2], [0]), "begin"]
    s = Settling()
    s.acting.free[0] = False
    assert s.settle([1], 2.0, np.zeros(6)) == [2]
    assert s.done == [1]
    s = Settling()
    s.acting.free[0], s.stuck[0] = False, True
    s.settle([1], 2.0, np.zeros(6))
    assert s.done == [("choose", [2], []), "begin"]
    s = Settling()
    s.acting.brake[1] = 1.0
    s.locked[:] = True
    s.settle([0, 1], 2.0, np.zeros(6))
    assert s.done == [1, ("choose", [0, 1], []), "begin"]
    assert s.locked.tolist() == [False, True]


def test_a_drive_that_moves_no_contact_turns_back() -> None:
    for t, said in ((2.0, ["Q turns back"]), (0.0, [])):
        s = Settling(push=((1.0, 2.0, 1.0), (0.0, 0.0, 0.0)))
        s.settle([1], t, np.zeros(6))
        assert [say(e.words) for e in s.events] == said
        assert all((e.name, e.of) == ("reversal", "Q") for e in s.events)
