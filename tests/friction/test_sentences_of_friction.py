"""What friction does, in sentences: of made-up forces at three positions, before and after a reversal, at both ends."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.analysis.friction import friction_status as status
from dalembert.analysis.friction.friction_circles import TwoPins
from dalembert.analysis.friction.joint_friction import NO_END, holds_beyond
from dalembert.analysis.friction.self_help import _coefficient
from tests.answers.test_status_sentences import JOINTS, ONE, TWO, compiled, joint

NAN, INF = math.nan, math.inf
WHERE = " between 30 deg and 60 deg of O, 200 mm and 350 mm of S"
HERE = " at O = 60 deg and S = 350 mm"


def forces(**friction: Any) -> Any:
    """Efforts of O and S, and the load F, with what friction says of them."""
    none = np.full(3, NAN)
    values = {
        "critical": none,
        "locked": np.zeros(3, bool),
        "reversing": np.zeros((3, 4), bool),
        "open": np.zeros((3, 4), bool),
        "sense": np.zeros((3, 4)),
        "blocked": np.zeros(3, bool),
        "bare_effort": np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]),
        "bare_load": np.array([[7.0], [8.0], [9.0]]),
        "holding": np.zeros((3, 3, 2)),
    }
    return SimpleNamespace(
        friction=SimpleNamespace(**(values | friction)),
        effort=np.array([[1.5, 2.5], [3.5, 4.5], [50.0, 6.5]]),
        load=np.array([[7.5], [8.5], [9.5]]),
        after=None,
        ends=(),
        rcond=np.ones(3),
    )


def test_a_jam_says_from_which_part_of_the_coefficients_on_it_would_move() -> None:
    c = compiled()
    c.contacts.coefficient = np.array([0.25, 0.1, 0.4, 0.9])  # not of brakes alone
    text = status._jam_sentence(c, forces(critical=np.array([0.1, 0.75, 0.5])), TWO)
    assert text == (
        f"Friction jams the mechanism{WHERE}: no effort moves it in this direction, whatever its size. "
        "It would move with less than 0.5 times the coefficients of friction."
    )
    f = forces()
    f.after = forces(critical=np.array([NAN, 0.25, NAN]))
    text = status._jam_sentence(c, f, np.array([1]))
    assert " at O = 30 deg and S = 200 mm, just after contacts reverse: no effort" in text
    assert "less than 0.25 times" in text
    f, f_after = f.after, f
    f.after = f_after
    assert ", just before contacts reverse: " in status._jam_sentence(c, f, np.array([1]))
    f.after = f
    assert "just" not in status._jam_sentence(c, f, np.array([1]))


def test_a_brake_alone_grabs_from_a_coefficient_on() -> None:
    """Contacts of B and A, which has no friction, with 0.25 and 0.4 of B; a fixed one of C does not count."""
    c = compiled()
    assert status._grabbing(c, 0.5, ONE) == (
        f"B: the brake grabs{HERE}: from mu = 0.2 on it holds any torque (now 0.4)."
    )
    c.contacts.fixed = np.zeros(4, bool)
    assert status._grabbing(c, 0.5, ONE) == (
        f"B or C: the brake grabs{HERE}: from mu = 0.45 on it holds any torque (now 0.9)."
    )
    c.contacts.coefficient = np.array([0.25, 0.1, 0.4, 0.9])
    assert status._grabbing(c, 0.5, ONE) is None
    c.contacts.coefficient = np.zeros(4)
    assert status._grabbing(c, 0.5, ONE) is None
    text = status._jam_sentence(compiled(), forces(critical=np.array([NAN, NAN, 0.5])), ONE)
    assert text.startswith("B: the brake grabs")


def test_a_machine_that_locks_itself_says_what_it_needs_where_friction_adds_most() -> None:
    c = compiled()
    needs = "O needs 50000 N*mm and without friction 5000 N*mm, S needs 6.5 N and without friction 6 N, "
    needs += "F needs 9500 N*mm and without friction 9000 N*mm"
    text = status._locked_sentence(c, forces(locked=np.ones(3, bool)), TWO)
    locks = "Self-locking{}: the load cannot drive the machine against its friction;{} {}."
    assert text == locks.format(WHERE, HERE, needs)
    assert status._locked_sentence(c, forces(), ONE) == locks.format(HERE, "", needs)
    c.known.requested = np.array([False, True])
    text = status._locked_sentence(c, forces(), ONE)
    assert text == locks.format(HERE, "", needs.partition(", ")[2])
    c.forcing.turning = SimpleNamespace(driven=1)
    assert "the speed of turning needs 6.5 N" in status._locked_sentence(c, forces(), ONE)
    c.forcing.turning.driven = -1
    assert "S needs 6.5 N" in status._locked_sentence(c, forces(), ONE)
    c.known.requested = np.array([True, True])
    c.forcing.turning.driven = 0
    assert "the speed of turning needs 50000 N*mm" in status._locked_sentence(c, forces(), ONE)


def test_a_reversal_names_its_joints_and_the_values_on_both_sides() -> None:
    c, f = compiled(), forces(reversing=np.array([[False] * 4, [True, False, True, False], [True] * 4]))
    f.after = forces()
    f.after.effort = f.effort + 1
    text = status._reversal_sentence(c, f, np.array([1]))
    values = (
        "O is 3500 N*mm just before and 4500 N*mm just after, S is 4.5 N just before and 5.5 N just after and "
        "F is 8500 N*mm just before and 8500 N*mm just after"
    )
    assert text == f"B reverses at O = 30 deg and S = 200 mm, so friction in it changes sense: {values}."
    assert status._reversal_sentence(c, f, ONE).startswith(f"B, A and C reverse{HERE}, so friction")


# at rest


def ended(*ends: list[float], sense: Any = None, **friction: Any) -> Any:
    """Forces whose ends have these values of O, S and F at every position."""
    f = forces(**friction)
    f.ends = tuple(forces(sense=np.zeros((3, 4)) if sense is None else sense[k]) for k in range(len(ends)))
    for end, (a, b, c) in zip(f.ends, ends, strict=True):
        end.effort, end.load = np.array([[a, b]] * 3), np.array([[c]] * 3)
    return f


def single() -> Any:
    """One unknown: the effort of O."""
    c = compiled(unknown_loads=())
    c.known = SimpleNamespace(requested=np.array([True, False]), couple=np.zeros(0, bool))
    c.schedule.speed = np.zeros((3, 2))
    return c


def one(low: float, high: float, sense: Any = None, holding: Any = None) -> Any:
    f = ended([low, 0, 0], [high, 0, 0], sense=sense)
    for end in f.ends:
        end.load = np.zeros((3, 0))
    f.friction.holding = np.array([[[low, high]]] * 3) if holding is None else np.array([[holding]] * 3)
    return f


B_ONLY, B_AND_A = np.array([[1.0, 0, 0, 0]] * 3), np.array([[-1.0, 1.0, 0, 1.0]] * 3)


@pytest.mark.parametrize(
    ("low", "high", "sense", "range_", "limits"),
    [
        (
            -2.0,
            3.0,
            (B_ONLY, B_ONLY),
            " between the two impending motions",
            "; at both ends friction is at its limit in B",
        ),
        (
            -2.0,
            3.0,
            (B_ONLY, B_AND_A),
            " between the two impending motions",
            "; at the low end friction is at its limit in B; at the high end friction is at its limit in B, A",
        ),
        (
            -2.0,
            NAN,
            (0 * B_ONLY, B_ONLY),
            " from the low end on",
            f"; at the low end friction is at its limit in no joint; at the high end {NO_END}",
        ),
        (
            NAN,
            3.0,
            (B_ONLY, B_ONLY),
            " up to the high end",
            f"; at the low end {NO_END}; at the high end friction is at its limit in B",
        ),
        (NAN, NAN, (B_ONLY, B_ONLY), "", f"; at the low end {NO_END}; at the high end {NO_END}"),
    ],
)
def test_at_rest_one_unknown_has_a_range_and_its_ends(
    low: float, high: float, sense: Any, range_: str, limits: str
) -> None:
    f = one(low, high, sense, [NAN, NAN])
    assert status._open_sentence(single(), f, ONE) == (
        f"At rest{HERE}: any value of O{range_} holds the machine{limits}."
    )


def test_at_rest_several_unknowns_have_an_interval_each() -> None:
    c = compiled()
    c.schedule.speed = np.zeros((3, 2))
    ends = [[-2.0, 1, 1], [3.0, 1, 1], [1, -5.0, 1], [1, 6.0, 1], [1, 1, -7.0], [1, 1, 8.0]]
    sense = [B_ONLY, B_ONLY, B_ONLY, B_AND_A, 0 * B_ONLY, B_ONLY]
    f = ended(*ends, sense=sense)
    f.friction.holding = np.array([[[-2.0, 3.0], [-5.0, 6.0], [-7.0, 8.0]]] * 3)
    assert status._open_sentence(c, f, TWO) == (
        f"At rest{WHERE}: O, S and F each lie in an interval. At the ends of each, the machine is about to move with "
        "the other drives held, and the other unknowns have the values shown for that end; not every combination of "
        "values within the intervals holds the machine. For O, at both ends friction is at its limit in B. For S, at "
        "the low end friction is at its limit in B; at the high end friction is at its limit in B, A. For F, at the "
        "low end friction is at its limit in no joint; at the high end friction is at its limit in B."
    )
    f.friction.holding[2, 1, 1] = 6.5
    assert status._open_sentence(c, f, TWO).endswith(
        " After some earlier motions friction can hold values of S beyond them at 1 of these 2 positions."
    )
    f.friction.holding[1:, 2, 0] = -9.0
    assert status._open_sentence(c, f, TWO).endswith(
        " After some earlier motions friction can hold values of S and F beyond them at each of these positions."
    )
    assert status._open_sentence(c, f, ONE).endswith(
        " Motion impends at -5 N and 6 N; with friction as an earlier motion may have left it, S can hold from -5 N "
        "to 6.5 N. Motion impends at -7000 N*mm and 8000 N*mm; with friction as an earlier motion may have left it, F "
        "can hold from -9000 N*mm to 8000 N*mm."
    )


@pytest.mark.parametrize(
    ("low", "high", "held", "text"),
    [
        (-2.0, 3.0, (-2.0, 3.0), ""),
        (-2.0, 3.0, (-1.0, 2.0), ""),
        (
            -2.0,
            3.0,
            (-INF, 3.0),
            "-2000 N*mm and 3000 N*mm|any value up to 3000 N*mm, below it with contacts wedged",
        ),
        (
            -2.0,
            3.0,
            (-2.0, INF),
            "-2000 N*mm and 3000 N*mm|any value from -2000 N*mm on, its contacts wedged",
        ),
        (-2.0, 3.0, (-INF, INF), "-2000 N*mm and 3000 N*mm|any value, its contacts wedged"),
        (-2.0, NAN, (-4.0, 9.0), "-2000 N*mm|from -4000 N*mm to 9000 N*mm"),
        (NAN, NAN, (-INF, INF), ""),
    ],
)
def test_what_an_earlier_motion_may_have_left_is_said_where_it_is_more(
    low: float, high: float, held: Any, text: str
) -> None:
    found = status._histories(single(), one(low, high, holding=list(held)), ONE, ["O"])
    impends, _, holds = text.partition("|")
    assert found == (
        f" Motion impends at {impends}; with friction as an earlier motion may have left it, O can hold {holds}."
        if text
        else ""
    )
    beyond = holds_beyond(np.array([low, high]), np.array(held))
    assert bool(beyond) == bool(text)


def test_contacts_without_a_rate_leave_some_unknowns_open() -> None:
    c = compiled()
    ends = [[-2.0, 1, 4], [3.0, 1, 4], [1, 5.0, 1], [1, 5.0, 1], [1, 1, 8.0], [1, 1, 8.0]]
    f = ended(*ends, open=np.array([[False] * 4, [False, True, False, False], [True, True, False, False]]))
    text = "No relative motion in {}{}: {} friction may have any value within the limits, and {}."
    tail = "O lies in an interval; S and F do not depend on it"
    assert status._open_sentence(c, f, TWO) == text.format("B, A", WHERE, "their", tail)
    f.ends[3].effort[:, 1] = 5.5
    tail = "O and S each lie in an interval; F does not depend on it"
    assert status._open_sentence(c, f, np.array([1])) == text.format(
        "A", " at O = 30 deg and S = 200 mm", "its", tail
    )
    f.ends[5].load[:] = 8.5
    assert status._open_sentence(c, f, ONE).endswith("and O, S and F each lie in an interval.")
    c.known.requested, c.unknown_loads = np.zeros(2, bool), ()
    assert status._open_sentence(c, f, ONE).startswith("A structure does not move: it holds any load,")


def test_positions_have_a_sentence_of_their_own_where_the_sides_of_a_reversal_differ() -> None:
    f = forces(reversing=np.array([[True] * 4, [True] * 4, [False] * 4]))
    assert status.alone(f).tolist() == [False, False, False]  # nothing after
    f.after = forces()
    assert status.alone(f).tolist() == [True, True, False]
    f.after = forces(critical=np.array([0.5, NAN, NAN]))
    f.friction.critical = np.array([0.5, 0.5, NAN])
    assert status.alone(f).tolist() == [False, True, False]
    f.friction.critical, f.after = np.full(3, NAN), forces(locked=np.array([True, False, True]))
    f.friction.locked = np.array([True, True, False])
    assert status.alone(f).tolist() == [False, True, False]


def test_checks_of_friction_are_in_order_and_only_where_something_is_solved() -> None:
    c, solvable = compiled(), np.array([True, True, False])
    f = forces(
        blocked=np.array([True, False, True]),
        critical=np.array([NAN, 0.5, 0.5]),
        open=np.array([[False] * 4, [False, True, False, False], [True] * 4]),
        locked=np.array([True, False, True]),
        reversing=np.array([[False] * 4, [False, False, True, False], [False] * 4]),
    )
    f.after = forces(critical=np.array([0.5, NAN, NAN]), locked=np.array([False, True, False]))
    checks = [(code, flags.tolist()) for code, flags, _ in status.friction_checks(c, f, solvable)]
    assert checks == [
        ("redundant", [True, False, False]),
        ("at_rest", [False, True, False]),
        ("jammed", [True, True, False]),
    ]
    ((code, flags, _),) = status.locking_checks(c, f, solvable)
    assert (code, flags.tolist()) == ("self_locking", [True, True, False])
    ((code, flags, _),) = status.reversal_checks(c, f)
    assert (code, flags.tolist()) == ("reversal", [False, True, False])
    f.friction = None
    for some in (status.friction_checks(c, f, solvable), status.locking_checks(c, f, solvable)):
        assert some == []
    assert status.reversal_checks(c, f) == []
    assert JOINTS["B"].BRAKES
    assert not joint("a", "b").BRAKES


# small parts


def test_a_link_between_two_pins_is_pulled_or_pressed() -> None:
    link = TwoPins("rod", ("A", "B"), np.array([2.0, -3.0, 0.0, NAN]))
    assert [link.state(k) for k in range(4)] == ["tension", "compression", "", ""]


@pytest.mark.parametrize("blocks", [0.0, 3.0])
def test_the_coefficient_of_a_wound_contact_is_that_of_its_strength(blocks: float) -> None:
    """Strength 2 tanh(grip / 2): of a band mu wrap is the grip, of blocks each has tanh(mu tan(half its angle))."""
    contacts: Any = SimpleNamespace(
        wound=np.array([False, True]),
        lever=np.array([0.25, 1.0]),
        wrap=np.array([0.0, 4.0]),
        blocks=np.array([0.0, blocks]),
    )
    assert _coefficient(contacts, 0, 0.1) == pytest.approx(0.4)
    grip = 1.2
    strong = 2 * math.tanh(grip)
    half = 4.0 / (2 * 3.0)
    expected = math.tanh(grip / 3) / math.tan(half) if blocks else 2 * grip / 4.0
    assert _coefficient(contacts, 1, strong) == pytest.approx(expected, rel=1e-12)
    assert _coefficient(contacts, 1, 2.0) == INF
    assert _coefficient(contacts, 1, 2 * (1 - 1e-10)) == INF
    assert _coefficient(contacts, 1, 2 * (1 - 1e-8)) < INF
