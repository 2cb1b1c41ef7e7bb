"""Ends and conditions of motions as they are written, names of contacts, energies of springs, motors in use."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.motion.energies import MotionChecks, gas_energy, table_energy
from dalembert.machine.motion.occurrences import (
    Event,
    EventCondition,
    Guard,
    less,
    read_end,
    say,
)
from dalembert.machine.motion.stops.gap_contacts import GapContact, added_drives
from dalembert.machine.motion.stops.watched_quantities import named_contacts
from dalembert.machine.motors.motor_use import motor_use
from dalembert.model.drives.motors import MotorCurve

UNKNOWN: Any = None
FOUR: Any = da.four_bar()


@pytest.mark.parametrize(
    ("until", "end", "stops"),
    [
        ("2 s", 2.0, []),
        (0.25, 0.25, []),
        (3, 3.0, []),
        (["2 s", 1.5, "500 ms"], 0.5, []),
        ("O2.speed = 0", math.inf, ["O2.speed = 0"]),
        (["O2.position = 90 deg", 4.0], 4.0, ["O2.position = 90 deg"]),
    ],
)
def test_a_motion_ends_at_the_first_of_its_times_and_conditions(
    until: Any, end: float, stops: list[str]
) -> None:
    found, conditions = read_end(FOUR, until, ["O2.speed = 3 rad/s"])
    assert found == end
    assert [(c.text, c.stops) for c in conditions] == [
        *((text, True) for text in stops),
        ("O2.speed = 3 rad/s", False),
    ]


@pytest.mark.parametrize("until", [0, 0.0, -1.0, "-1 s", "0 s", [], [2.0, 0.0], ["O2.speed = 0", -1.0]])
def test_a_motion_without_an_end_is_refused(until: Any) -> None:
    with pytest.raises(da.ModelError, match='the simulation has no end; write until="2 s"'):
        read_end(FOUR, until, [])


@pytest.mark.parametrize(
    ("text", "drive", "what", "value"),
    [
        ("O2.position = 90 deg", 0, "position", math.pi / 2),
        ("  O2.speed=30 rpm ", 0, "speed", math.pi),
        ("O2.speed = 0", 0, "speed", 0.0),
        ("O2.position = 0", 0, "position", 0.0),
    ],
)
def test_a_condition_names_a_drive_its_quantity_and_a_value(
    text: str, drive: int, what: str, value: float
) -> None:
    for kind_of in (None, UNKNOWN):
        (found,) = read_end(FOUR, [1.0, text], [], kind_of)[1]
        assert found == EventCondition(text.strip(), drive, what, pytest.approx(value), True)  # type: ignore[arg-type]
    state = np.array([0.5, 0.25, 7.0, 9.0])  # of two drives
    assert found.place(2) == (2 if what == "speed" else 0)
    assert found.value_at(2)(1.0, state) == pytest.approx((7.0 if what == "speed" else 0.5) - value)


def test_a_condition_may_name_any_quantity_whose_kind_is_known() -> None:
    asked = []

    def kind_of(name: str) -> str:
        asked.append(name)
        return "force"

    for text in ("normal.F = 2 kN", "reaction.A.x.speed = 2 kN"):
        (found,) = read_end(FOUR, 1.0, [text], kind_of)[1]
        assert found == EventCondition(text, -1, "", 2000.0, False, text.split(" ")[0])
    assert asked == ["normal.F", "reaction.A.x.speed"]
    (own,) = read_end(FOUR, 1.0, ["O2.speed = 3 rad/s"], kind_of)[1]
    assert (own.drive, own.name, len(asked)) == (0, "", 2)


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("O3.speed = 2 rad/s", "the condition 'O3.speed = 2 rad/s' names no drive; did you mean O2"),
        ("speed > 3 = 4", "'speed > 3 = 4' is not a condition; write \"O2.speed = 0 rad/s\" or"),
    ],
)
def test_a_condition_that_is_none_is_refused(text: str, said: str, known: bool) -> None:
    with pytest.raises(da.ModelError) as refused:
        read_end(FOUR, 1.0, [text], (lambda name: "number") if known else None)
    assert said.split("; ")[0] in str(refused.value)


def test_slides_have_speeds_and_lengths() -> None:
    slide = {"S": {"type": "slider", "links": ["ground", "ram"], "at": ["O", "F"]}}
    links = {"ground": {"points": {"O": [0, 0]}}, "ram": {"points": {"F": [0, 0]}, "mass": 1}}
    turn = {"O": {"type": "pin", "links": ["ground", "wheel"]}}
    links["wheel"] = {"points": {"O": [0, 0]}, "inertia": 1}
    m = da.mechanism(
        {"links": links, "joints": turn | slide, "drives": {"O": {"position": 0}, "S": {"position": 0}}}
    )
    found = read_end(m, "1 s", ["S.position = 20 mm", "S.speed = 3 m/min", "O.speed = 1 rpm"])[1]
    assert [c.value for c in found] == pytest.approx([0.02, 0.05, math.pi / 30])
    assert [c.place(2) for c in found] == [1, 3, 2]
    for wrong in ("S.position = 20 deg", "O.position = 20 mm"):
        with pytest.raises(da.DalembertError):
            read_end(m, "1 s", [wrong])


def test_an_event_says_its_words_and_numbers() -> None:
    e = Event(0.5, "stop", ("it meets ", ("angle", 0.25), " with ", ("speed", 2.5), "!"))
    assert e.sentence == "it meets 0.25 rad with 2.5 m/s!"
    assert (e.of, math.isnan(e.speed), math.isnan(e.lost)) == ("", True, True)
    assert say(("gone",)) == "gone"
    assert less(lambda t, y: 3 * t, 0.5)(2.0, UNKNOWN) == 5.5


@pytest.mark.parametrize(
    ("value", "least", "zero"),
    [
        (2e-12, 0.0, False),
        (-2e-12, 0.0, False),
        (1e-12, 0.0, True),
        (-9e-13, 0.0, True),
        (0.01, 0.02, True),
        (0.02, 0.02, True),
        (-0.021, 0.02, False),
    ],
)
def test_a_guard_is_at_zero_below_its_least_amount_or_rounding(
    value: float, least: float, zero: bool
) -> None:
    g = Guard("stop", 0, lambda t, y: value, least=least)
    state = np.array([0.5, -0.25, 7e9])  # of one drive; what is behind does not count
    assert g.at_zero(0.0, state, 1) is zero
    large = Guard("stop", 0, lambda t, y: 50 * value)
    if not least:
        assert large.at_zero(0.0, np.array([0.5, -50.0, 7e9]), 1) is zero


def test_guards_know_their_side_but_of_what_is_looked_up_behind_an_event() -> None:
    unsure = ("on", "off", "kink", "side", "gear", "condition")
    for kind in (*unsure, "stop", "corner", "clutch"):
        assert Guard(kind, 0, UNKNOWN).known is (kind not in unsure)


def contact(joint: str, freedom: str, side: float = 1.0, **more: Any) -> GapContact:
    return GapContact(joint, freedom, side, 0.03, 0.4, **more)


def test_contacts_have_names_ends_and_stops() -> None:
    behind, ahead, gap = (contact("G", f) for f in ("gap_behind", "gap_ahead", "gap"))
    assert [c.name for c in (behind, ahead, gap)] == ["G.behind", "G.ahead", "G"]
    assert [c.where for c in (behind, ahead, gap)] == [" at its rear end", " at its front end", ""]
    up, down = contact("G", "gap").stops, contact("G", "gap", -1.0).stops
    assert (up.least, up.greatest, up.restitution, up.kind) == (0.03, math.inf, 0.4, "length")
    assert (down.least, down.greatest) == (-math.inf, 0.03)
    some = [
        contact("A", "gap"),
        contact("B", "gap", drive=0),
        contact("C", "gap", drive=2, slip=0),
        contact("D", "slide", drive=1, slip=3),
    ]
    assert [added_drives([c]) for c in some] == [0, 1, 2, 0]
    assert added_drives(some) == 3


def test_contacts_are_found_by_their_name_and_forces_by_that_of_their_guide() -> None:
    some = [contact("G", "gap_behind"), contact("G", "gap_ahead"), contact("C", "gap")]
    for word in ("normal", "force"):
        assert named_contacts(some, f"{word}.G") == some[:2]
        assert named_contacts(some, f"{word}.G.ahead") == [some[1]]
    assert named_contacts(some, "gap.G") == []
    assert named_contacts(some, "gap.G.behind") == [some[0]]
    assert named_contacts(some, "gap.C") == [some[2]]
    assert named_contacts(some, "reaction.C") == named_contacts(some, "normal.D") == []


def test_the_energy_of_a_table_is_the_area_below_it() -> None:
    """A force that begins with 3 and changes its slope at three lengths: by trapezoids on a fine grid."""
    bends, slopes = (-0.6, -0.2, 0.4), (2.0, -1.0, 5.0)
    s: Any = SimpleNamespace(
        free_length=0.5,
        start=np.array([[3.0]]),
        bends=np.array([[[b] for b in bends]]),
        slopes=np.array([[[k] for k in slopes]]),
    )

    for x in (0.7, 0.1, -0.3):
        grid = np.linspace(0, x, 2001)
        force = 3 + sum(k * np.maximum(grid - b, 0) for b, k in zip(bends, slopes, strict=True))
        found = table_energy(s, np.array([[0.5 + x]])).item()
        assert found == pytest.approx(np.trapezoid(force, grid), rel=1e-5)


@pytest.mark.parametrize("exponent", [1.0, 1.3])
def test_the_energy_of_a_gas_spring_is_the_work_done_on_it(exponent: float) -> None:
    """The gas pushes with p A (V / (V - A x))^n, the air outside helps with p_out A."""
    s: Any = SimpleNamespace(
        length=np.array([0.4, 0.5]),
        volume=np.array([1.0, 3e-4]),
        area=np.array([0.0, 4e-4]),
        exponent=np.array([1.0, exponent]),
        pressure=np.array([1.0, 8e6]),
        outside=np.array([1.0, 1e5]),
    )
    for now in (0.3, 0.62):
        x = np.linspace(0, 0.5 - now, 2001)
        push = 8e6 * 4e-4 * (3e-4 / (3e-4 - 4e-4 * x)) ** exponent - 1e5 * 4e-4
        found = gas_energy(s, np.array([[0.2, now]]))
        assert found[0] == pytest.approx([0.0, np.trapezoid(push, x)], rel=1e-5)


class Checked(MotionChecks):
    """A motion whose energies, works and gaps are told."""

    def __init__(self, kinetic: Any, potential: Any, gap: Any = (0.0,), **works: Any) -> None:
        self.__dict__["_energies"] = (np.array(kinetic, float), np.array(potential, float))
        self.works = {n: np.array(w, float) for n, w in works.items()}
        self.__dict__ |= {"law_gap": np.array(gap), "closure": 0.0}

    @property
    def time(self) -> Any:
        return np.array([0.0, 0.5, 0.75, 1.25])


def test_the_balance_of_energies_is_that_of_what_is_gained_and_done() -> None:
    s = Checked([3, 5, 4], [7, 1, 9], a=[0, -6, 1], b=[0, 2, 1.5])
    # gained 0, -4, 3; works 0, -4, 2.5: off by 0.5, beside the largest exchange, 6
    assert s.energy_residual == pytest.approx(0.5 / 6)
    assert Checked([8, 5, 4], [7, 1, 9], a=[0, -6, 1], b=[0, -3, -3.0]).energy_residual == pytest.approx(0)
    assert Checked([0, 0], [4, 4], a=[1, 1]).energy_residual == 0
    assert (s.kinetic.tolist(), s.potential.tolist()) == ([3, 5, 4], [7, 1, 9])


@pytest.mark.parametrize(
    ("gap", "when"),
    [
        ([0, 1e-5, 9e-6, 0], ""),
        ([0, 2e-5, 0, 0], "at 0.5 s accelerations"),
        ([0, 0, 3e-5, 2e-5], "at 0.75 s and 1 more accelerations"),
        ([2e-5, 2e-5, 4e-5, 2e-5], "at 0 s and 3 more accelerations"),
    ],
)
def test_doubts_of_a_motion_begin_above_their_limit(gap: list[float], when: str) -> None:
    s = Checked([1, 1], [0, 0], gap, a=[0, 0])
    assert s.law_residual == max(gap)
    assert s.doubt.startswith(when) if when else s.doubt == ""
    if when:
        assert s.doubt.endswith(f"asks for other efforts, by {max(gap):.1g} of the largest")
    rough = Checked([1, 1], [0, 0], gap, a=[0, 2e-5])
    assert rough.doubt.endswith("the energy balance has a gap of 2e-05 of the largest energy")
    assert rough.doubt.count("; ") == (1 if when else 0)
    assert "balance" not in Checked([1, 1], [0, 0], gap, a=[0, 1e-5]).doubt


@pytest.mark.parametrize(
    ("effort", "speed", "acceleration", "shaft"),
    [
        (6.0, 2.0, -5.0, 6 / (3 * 0.8)),  # driving
        (-6.0, -2.0, 5.0, -6 / (3 * 0.8)),
        (6.0, -2.0, 5.0, 6 * 0.8 / 3),  # driven
        (-6.0, 2.0, -5.0, -6 * 0.8 / 3),
        (6.0, 0.0, 5.0, 6 / (3 * 0.8)),  # from rest as it is accelerated
        (6.0, 0.0, -5.0, 6 * 0.8 / 3),
        (6.0, 0.0, 0.0, 2.0),
    ],
)
def test_a_gear_loses_in_the_sense_of_its_power(
    effort: float, speed: float, acceleration: float, shaft: float
) -> None:
    motor = MotorCurve((0.0, 9.0), (8.0, 0.0), True, ratio=3.0, efficiency=0.8, inertia=0.02)
    use = motor_use(motor, *(np.array([x]) for x in (effort, speed, acceleration)))
    assert use.speed == pytest.approx([3 * speed])
    assert use.gear_torque == pytest.approx([shaft])
    assert use.torque == pytest.approx([shaft + 0.02 * 3 * acceleration])
    assert use.loss == pytest.approx([shaft * 3 * speed - effort * speed])
    assert (use.loss >= 0).all()
    assert use.power == pytest.approx(use.torque * 3 * speed)
