"""Sentences of statuses: which position, joint and number they name, of made-up forces at a few positions."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.analysis.friction import friction_status as friction
from dalembert.analysis.status import brake_verdicts, freewheeling, lost_contacts, outside_tables
from dalembert.analysis.status import slipping_belts as belts
from dalembert.analysis.status import slipping_ropes as ropes
from dalembert.errors import ModelError
from dalembert.model.quantities.coordinates import quantity_name

NAN, INF = math.nan, math.inf
TWO, ONE = np.array([1, 2]), np.array([2])


def joint(*links: str, **more: Any) -> Any:
    values = {"BRAKES": False, "TOOTHED": False, "type": "pin", "contact": SimpleNamespace(mode="pushes")}
    return SimpleNamespace(links=links, **(values | more))


JOINTS = {
    "A": joint("ground", "crank"),
    "B": joint("crank", "rod", BRAKES=True, type="shoe"),
    "C": joint("rod", "ground", BRAKES=True, type="band"),
}


def compiled(**more: Any) -> Any:
    """Two drives, O that turns and S that slides, at three positions, in mm and N."""
    schedule = SimpleNamespace(
        names=("O", "S"),
        position=np.array([[0.0, 0.1], [math.pi / 6, 0.2], [math.pi / 3, 0.35]]),
        speed=np.array([[1.0, 2.0]] * 3),
        time=None,
    )
    layout = SimpleNamespace(
        freedoms=SimpleNamespace(angular=np.array([False, True, False])), driven=np.array([1, 2])
    )
    values = {
        "schedule": schedule,
        "layout": layout,
        "mechanism": SimpleNamespace(units={"length": "mm", "force": "N"}, joints=JOINTS, loads={}),
        "joints": ("A", "B", "C"),
        "links": ("crank", "rod"),
        "known": SimpleNamespace(requested=np.array([True, True]), couple=np.array([True])),
        "forcing": SimpleNamespace(turning=None),
        "unknown_loads": ("F",),
        "contacts": SimpleNamespace(
            joint=np.array([1, 0, 1, 2]),
            fixed=np.array([False, False, False, True]),
            coefficient=np.array([0.25, 0.0, 0.4, 0.9]),
        ),
    }
    return SimpleNamespace(**(values | more))


def test_a_run_of_positions_is_said_by_its_ends_for_every_drive() -> None:
    c = compiled()
    assert friction.arc(c, TWO) == " between 30 deg and 60 deg of O, 200 mm and 350 mm of S"
    assert friction.arc(c, ONE) == " at O = 60 deg and S = 350 mm"
    c.schedule.names = ()
    assert friction.arc(c, TWO) == ""


def pushing(**more: Any) -> Any:
    """Contacts: A pushes at its rear and front end, B a couple, C at its middle and against slip."""
    values = {
        "joint": np.array([0, 0, 1, 2, 2]),
        "force": np.array([1.0, 1.0, 0.0, 1.0, -0.3]),
        "corner": np.array([-1, 1, 0, 0, 0]),
        "slips": np.array([False, False, False, False, True]),
    }
    return SimpleNamespace(**(values | more))


LACKING = [
    (0, 0, "A would have to pull with 7 N{at}: it tips, its rear end lifts off.", "pushes"),
    (0, 1, "A would have to pull with 7 N{at}: it tips, its front end lifts off.", "pushes"),
    (2, 3, "A would have to push with 7 N{at}: the contact is lost.", "pulls"),
]


@pytest.mark.parametrize(("place", "column", "words", "mode"), LACKING)
def test_a_lost_contact_is_said_with_its_force_and_where_it_lifts(
    place: int, column: int, words: str, mode: str
) -> None:
    part = joint("ground", "crank", contact=SimpleNamespace(mode=mode))
    at = pushing(joint=np.array([0, 0, 1, 0, 2]))
    m = SimpleNamespace(units={"length": "mm", "force": "N"}, joints=JOINTS | {"A": part}, loads={})
    lacking = np.zeros((3, 5))
    lacking[2, column], lacking[1, column], lacking[0, 4] = 7.0, 3.0, 90.0
    text = lost_contacts._lost_sentence(compiled(pushing=at, mechanism=m), lacking, TWO)
    where = " between 30 deg and 60 deg of O, 200 mm and 350 mm of S"
    assert text == words.format(at=where) + (
        f" This contact only {mode}; write contact: holds if it carries forces in both directions."
    )
    m.joints = JOINTS | {"A": joint("ground", "crank", TOOTHED=True)}
    text = lost_contacts._lost_sentence(compiled(pushing=at, mechanism=m), lacking, ONE)
    assert ": the teeth change flank." in text
    assert place < 3


def test_lost_contacts_of_clutches_and_brakes_have_words_of_their_own() -> None:
    lacking = np.zeros((3, 5))
    lacking[1, 2] = 0.25
    c = compiled(pushing=pushing())
    assert lost_contacts._lost_sentence(c, lacking, np.array([1])) == (
        "B would have to hold with 250 N*mm in its free sense at O = 30 deg and S = 200 mm: rod runs ahead of crank, "
        "and the drives do not say how fast. Drive both links, or let forces move them (simulate)."
    )
    lacking[1, 3] = 4.0
    assert lost_contacts._lost_sentence(c, lacking, np.array([1])) == (
        "C would have to push with 4 N at O = 30 deg and S = 200 mm: the band goes slack. Reverse the actuating "
        "force, or the sense in which the drum turns."
    )
    assert brake_verdicts.lifting(c, "B", "9 N", ONE) == (
        "B would have to pull with 9 N at O = 60 deg and S = 350 mm: the lining lifts off the drum. Reverse the "
        "actuating force, or the sense in which the drum turns."
    )
    assert brake_verdicts.lifting(c, "A", "9 N", ONE) is None


def test_a_wheel_that_would_slip_says_the_coefficient_that_it_needs(monkeypatch: pytest.MonkeyPatch) -> None:
    forces = np.array([[1.0] * 5, [1.0] * 5, [5.0, 6.0, 7.0, 8.0, -2.0]])
    monkeypatch.setattr(lost_contacts, "contact_forces", lambda *given: forces)
    slipping = np.zeros((3, 5))
    slipping[2, 4], slipping[1, 4] = 2.0, 0.5
    f: Any = SimpleNamespace(force=None, moment=None, unique=None)
    text = lost_contacts._slip_sentence(compiled(pushing=pushing()), slipping, None, f, TWO)  # type: ignore[arg-type]
    assert text == (
        "C slips between 30 deg and 60 deg of O, 200 mm and 350 mm of S: to roll it needs a coefficient of friction "
        "of 0.55 at rest and has 0.3. Load it more, or let forces move it (simulate), where it slides."
    )


def test_contacts_that_lack_force_are_checked_beyond_rounding(monkeypatch: pytest.MonkeyPatch) -> None:
    force = np.array([[3.0, -2.0, -0.1, 1.0, -4.0], [3.0, 2.0, 0.1, 1.0, 4.0], [-0.2, 2.0, 0.1, 1.0, 4.0]])
    monkeypatch.setattr(lost_contacts, "contact_forces", lambda *given: force)
    monkeypatch.setattr(lost_contacts, "rounding", lambda layout, pushing, f, m, heavy: 0.15 + heavy[:, None])
    monkeypatch.setattr(
        lost_contacts, "forces_at_speed", lambda layout, mass, twist: np.array([0.0, 0.0, 0.1])
    )
    c = compiled(pushing=pushing())
    c.forcing.inertia = SimpleNamespace(mass=1)
    f: Any = SimpleNamespace(force=None, moment=None, unique=None)
    pose: Any = None

    def codes(inertia: bool) -> dict[str, list[bool]]:
        return {
            code: flags.tolist()
            for code, flags, _ in lost_contacts.contact_checks(c, pose, np.zeros((3, 2, 3)), f, inertia)
        }

    assert codes(True) == {"contact_lost": [True, False, False], "slips": [True, False, False]}
    assert codes(False) == {"contact_lost": [True, False, True], "slips": [True, False, False]}
    f.unique = np.ones((3, 3, 3), bool)
    f.unique[0, 0, 1] = False
    assert codes(False) == {"contact_lost": [False, False, True], "slips": [True, False, False]}
    c.pushing = pushing(slips=np.zeros(5, bool))
    assert codes(False) == {"contact_lost": [True, False, True]}
    c.pushing = None
    assert codes(False) == {}


def test_a_brake_that_would_have_to_help_names_the_drive_whose_effort_opposes_its_speed() -> None:
    known = SimpleNamespace(
        requested=np.array([False, False]), effort=np.array([[1.0, 1.0], [2.0, -3.0], [-4.0, -3.0]])
    )
    c = compiled(known=known)
    ends = "Give it the sign of the speed, or reverse the speed."
    assert brake_verdicts.helping(c, np.array([1])) == (
        "A brake gives no torque that helps the motion: the effort of S, -3 N at O = 30 deg and S = 200 mm, acts "
        f"against it. {ends}"
    )
    assert brake_verdicts.helping(c, np.array([2])) == (
        "A brake gives no torque that helps the motion: the effort of O, -4000 N*mm at O = 60 deg and S = 350 mm, "
        f"acts against it. {ends}"
    )
    assert brake_verdicts.helping(c, np.array([0])) is None
    known.requested = np.array([True, False])
    assert "effort of S" in (brake_verdicts.helping(c, np.array([2])) or "")
    c.mechanism.joints = {"A": JOINTS["A"]}
    assert brake_verdicts.helping(c, np.array([1])) is None


def test_faces_that_would_drive_what_slips_are_no_balance() -> None:
    twist = np.zeros((3, 2, 3))
    twist[:, 0, 2], twist[:, 1, 2] = [2.0, 2.0, -2.0], [1.0, -5.0, 0.0]
    known = SimpleNamespace(requested=np.array([True, True]), effort=np.zeros((3, 2)))
    c = compiled(unknown_loads=("F", "B"), known=known)
    f: Any = SimpleNamespace(rcond=np.ones(3), load=np.array([[9.0, -1.0], [9.0, -1.0], [9.0, -1.0]]))
    ((code, flags, sentence),) = brake_verdicts.clamp_checks(c, twist, f)
    assert (code, flags.tolist()) == ("no_balance", [False, True, True])
    assert sentence(ONE) == brake_verdicts.HELPED
    f.load = -f.load * [[1, 1], [1, 0], [1, 0]]
    assert brake_verdicts.clamp_checks(c, twist, f)[0][1].tolist() == [True, False, False]
    c.unknown_loads = ("F", "A")
    assert brake_verdicts.clamp_checks(c, twist, f) == []


# clutches


def clutch(way: float = 1.0, pitch: float = 0.0) -> Any:
    return SimpleNamespace(links=("crank", "rod"), RELEASED=True, way=way, pitch=pitch)


def spins(*rates: tuple[float, float]) -> Any:
    twist = np.zeros((len(rates), 2, 3))
    twist[..., 2] = rates
    return twist


def test_a_clutch_freewheels_with_the_greatest_rate_of_its_run() -> None:
    m = SimpleNamespace(units={}, joints={"K": clutch()}, loads={})
    c = compiled(mechanism=m)
    ((code, turns, sentence),) = freewheeling.freewheel_checks(c, spins((1.0, 3.0), (2.0, 2.0), (-1.0, 2.5)))
    assert (code, turns.tolist()) == ("freewheels", [True, True, True])
    where = " between 30 deg and 60 deg of O, 0.2 m and 0.35 m of S"
    assert sentence(TWO) == (
        f"K freewheels{where}: rod turns ahead of crank with {math.degrees(3.5):.6g} deg/s, "
        "and the clutch carries no couple."
    )
    assert sentence(np.array([1])) == (
        "K does not turn at O = 30 deg and S = 0.2 m, as drives hold both of its links: its couple is taken as 0."
    )
    m.loads = {"stop of K on rod": 1}
    ((_, turns, _),) = freewheeling.freewheel_checks(c, spins((1.0, 3.0), (2.0, 2.0), (1.0, 1.0 + 2e-9)))
    assert turns.tolist() == [True, False, False]
    m.joints = {"K": joint("crank", "rod")}
    assert freewheeling.freewheel_checks(c, spins((1.0, 3.0))) == []


@pytest.mark.parametrize(
    ("way", "pitch", "time", "refused"),
    [(-1.0, 0.0, None, True), (1.0, 0.0, None, False), (-1.0, 0.1, None, True), (-1.0, 0.1, 1, False)],
)
def test_a_clutch_turned_in_the_sense_it_blocks_is_refused(
    way: float, pitch: float, time: Any, refused: bool
) -> None:
    m = SimpleNamespace(units={}, joints={"K": clutch(way, pitch)}, loads={})
    c = compiled(mechanism=m)
    c.schedule.time = time
    twist = spins((2.0, 2.0), (1.0, 3.0), (1.0, 9.0))
    if not refused:
        assert len(freewheeling.freewheel_checks(c, twist)) == 1
        return
    with pytest.raises(ModelError) as raised:
        freewheeling.freewheel_checks(c, twist)
    assert str(raised.value) == (
        f"joint 'K' is turned in the sense that it blocks at O = 30 deg and S = 0.2 m, with "
        f"{math.degrees(2):.6g} deg/s; reverse a drive, "
        "or leave one out: then the joint holds"
    )
    assert raised.value.path == ("joints", "K")


def test_rollers_grip_from_their_least_coefficient_on() -> None:
    def rollers(has: float) -> Any:
        return SimpleNamespace(rollers=SimpleNamespace(coefficient=has, least_coefficient=0.06125))

    joints = {"A": joint("ground", "crank"), "K": rollers(0.05), "L": rollers(0.06125), "M": rollers(0.07)}
    m = SimpleNamespace(joints=joints)
    f: Any = SimpleNamespace(moment=np.array([[1.0, 0.0, 1.0, 1.0], [0.0, -2.0, 1.0, 1.0]]))
    ((code, flags, sentence),) = freewheeling.grip_checks(compiled(mechanism=m), f)
    assert (code, flags.tolist()) == ("slips", [False, True])
    assert sentence(ONE) == (
        "The rollers of K do not grip: they need a coefficient of friction of 0.06125, the tangent of half their "
        "wedge, and have 0.05. Make the wedge narrower."
    )
    margins = freewheeling.grip_margins(m)  # type: ignore[arg-type]
    assert margins == pytest.approx([-0.01125, 0.0, 0.00875])


# tables


def beyond(what: str, at: list[float], x: tuple[float, ...], against: str, along: str, shift: float) -> Any:
    table = SimpleNamespace(along=along, x=x, shift=shift, against=against)
    table.beyond = lambda at: (at < x[0] + shift) | (at > x[-1] + shift)
    return SimpleNamespace(what=what, at=np.array(at), table=table)


def test_positions_outside_tables_say_which_ends_they_passed_most() -> None:
    c = compiled(
        beyond=[
            beyond("load 'F'", [0.0, 0.6, 0.9], (0.1, 0.2, 0.4), "drives.S", "length", 0.1),
            beyond("effort of drive 'O'", [0.5, 0.5, 0.6], (0.0, 1.0), "drives.O", "angle", 0.0),
            beyond("load 'G'", [-0.4, -0.3, 0.2], (-0.2, 0.5), "drives.S", "length", 0.0),
        ]
    )
    assert outside_tables.outside(c).tolist() == [True, True, True]
    name = quantity_name("drives.S")
    first = (
        f"Load 'F': its table covers {name} = 200..500 mm, here {name} = %s mm; the value at the end was used"
    )
    last = f"load 'G': its table covers {name} = -200..500 mm, here {name} = -300 mm; the value at the end was used"
    assert outside_tables.outside_sentence(c, TWO) == f"{first % 900}. {last}."
    assert outside_tables.outside_sentence(c, ONE) == f"{first % 900}."
    c.beyond = c.beyond[1:2]
    assert not outside_tables.outside(c).any()


# belts and ropes


def strands(**more: Any) -> Any:
    three = np.ones((3, 1))
    values = {name: three for name in belts.Strands._fields if name != "wrap"} | {"wrap": np.ones((3, 2, 1))}
    return belts.Strands(**(values | {name: np.array(of) for name, of in more.items()}))


def test_a_chain_that_would_have_to_push_says_where_most_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    belt = SimpleNamespace(chain=True)
    monkeypatch.setattr(belts, "belts_of", lambda m: {"V": None, "W": belt})
    both = np.ones((3, 2))
    s = strands(slack=both * [[1, -9], [1, -2], [1, -5]], centrifugal=both * [[1, 1], [1, 0.5], [1, 3]])
    where = " between 30 deg and 60 deg of O, 200 mm and 350 mm of S"
    assert belts._slack_sentence(compiled(), s, 1, TWO) == (
        f"The slack strand of chain W would have to push with 8 N{where}. Raise its tension, or lower the load."
    )
    belt.chain = False
    assert belts._slack_sentence(compiled(), s, 1, np.array([0])).startswith(
        "The slack strand of belt W would have to push with 10 N at O = 0 deg and S = 100 mm."
    )


def test_the_largest_difference_of_tensions_is_that_of_the_equation_of_the_rope() -> None:
    """Tight to slack as E: of a sum N fixed it is N (E-1)/(E+1); a share of it that grows with the load adds."""
    ratio = np.array([3.0])
    assert belts.limit_difference(np.array([8.0]), np.array([0.0]), ratio) == pytest.approx([4.0])
    assert belts.limit_difference(np.array([8.0]), np.array([0.5]), ratio) == pytest.approx([4 / 0.75])
    assert belts.limit_difference(np.array([-8.0]), np.array([0.5]), ratio).tolist() == [0.0]
    assert belts.limit_difference(np.array([8.0]), np.array([1.0]), np.array([INF])).tolist() == [INF]
    assert belts.limit_difference(np.array([8.0]), np.array([0.25]), np.array([INF])) == pytest.approx(
        [8 / 0.75]
    )


def test_a_belt_that_slips_says_what_it_needs_and_from_which_torque_on(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    belt = SimpleNamespace(radii=(0.1, 0.25), links=("motor", "drum"))
    monkeypatch.setattr(belts, "belts_of", lambda m: {"V": belt})
    monkeypatch.setattr(belts, "grip", lambda m, b: 0.5)
    monkeypatch.setattr(belts, "wedge", lambda b: 0.3)
    s = strands(
        needed=[[0.2], [0.7], [0.8]],
        wrap=[[[1.0], [1.0]], [[1.0], [1.0]], [[3.0], [2.5]]],
        net=[[1.0], [1.0], [60.0]],
        difference=[[1.0], [1.0], [-20.0]],
    )
    c = compiled()
    c.forcing.belts = SimpleNamespace(share=np.array([0.4]))
    ratio = math.exp(0.5 * 2.5)
    part = (ratio - 1) / (ratio + 1)
    torque = 0.25 * 52 * part / (1 - 0.4 * part) * 1e3
    where = " between 30 deg and 60 deg of O, 200 mm and 350 mm of S"
    assert belts._slip_sentence(c, s, 0, TWO) == (
        f"Belt V needs 0.24, has 0.15; slips from {torque:.6g} N*mm on, at the wheel of drum{where}. "
        "Raise its tension, its wrap or its coefficient, or lower the load."
    )
    s = s._replace(needed=np.full((3, 1), INF))
    assert "Belt V needs more than any coefficient, has 0.15;" in belts._slip_sentence(c, s, 0, ONE)


def test_ropes_that_hang_slack_or_slip_say_in_which_strand_and_on_which_wheel() -> None:
    wheel: Any = SimpleNamespace(holds=0.4, wedge=0.5, link="drum")
    tension = np.array([[9.0, -90.0, 1.0], [5.0, -2.0, -3.0], [5.0, -2.0, -4.0]])
    lines = ropes.RopeLines(
        tension,
        tension,
        tension,
        (wheel,),
        tension,
        np.array([[9.0], [0.6], [0.5]]),
    )
    c = compiled()
    c.mechanism.ropes = {"R": SimpleNamespace(RING=False), "T": SimpleNamespace(RING=True)}
    where = " between 30 deg and 60 deg of O, 200 mm and 350 mm of S"
    assert ropes._slack_sentence(c, "R", lines, TWO) == (
        f"Rope R would have to push with 4 N in strand 3{where}: it hangs slack. Load it, or move more slowly."
    )
    assert ropes._slip_sentence(c, "T", lines, 0, TWO) == (
        f"Belt T needs 0.3, has 0.2: it slips on drum{where}. "
        "Give it more turns or a greater coefficient, or lower the load."
    )
