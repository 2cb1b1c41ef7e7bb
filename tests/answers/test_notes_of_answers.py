"""Sentences beside the numbers of an answer: when each is said, with which numbers, and when it is not."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.output import assumptions
from dalembert.analysis.output.summary import printed_contacts, printed_friction, printed_turning
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.model.drives.turning import UNKNOWN
from dalembert.printing import TextTable

NAN, INF, SI = math.nan, math.inf, Printed(None)
MM = Printed({"length": "mm", "force": "N"})


# stops and tables


@pytest.mark.parametrize(
    ("positions", "said"),
    [
        ([0.5, 1.0, 1.5], None),
        ([0.5 - 9e-10, 1.5 + 9e-10], None),  # rounding
        ([0.4, 1.0, 1.5], "1 of 3 positions is beyond them"),
        ([0.4, 1.6, 1.0, 2.0], "3 of 4 positions are beyond them"),
        ([0.5 - 2e-9, 1.0], "1 of 2 positions is beyond them"),
        ([1.0, 1.5 + 2e-9], "1 of 2 positions is beyond them"),
    ],
)
def test_stops_are_mentioned_where_positions_go_beyond_them(positions: list[float], said: str | None) -> None:
    stops: Any = SimpleNamespace(least=0.5, greatest=1.5)
    found = assumptions._beyond("stops of O", stops, np.array(positions))
    assert found == ({"stops of O": f"not counted: {said}, where a stop would push"} if said else {})


def test_brakes_motors_and_starts_of_a_prescribed_motion_are_mentioned() -> None:
    drive = dict.fromkeys(("motor", "stops"))
    drives = {
        "O": SimpleNamespace(turns=True, brake=2.5, **drive),
        "S": SimpleNamespace(turns=False, brake=40.0, motor=object(), stops=None),
        "Q": SimpleNamespace(
            turns=True, brake=0.0, motor=None, stops=SimpleNamespace(least=0.0, greatest=1.0)
        ),
    }
    m = SimpleNamespace(drives=drives, start={"O": 1}, joints={}, loads_on=lambda kind: {})
    schedule = SimpleNamespace(names=("O", "Q"), position=np.array([[9.0, 0.5], [9.0, 1.5]]))
    r: Any = SimpleNamespace(mechanism=m, schedule=schedule, ok=np.array([True]))
    assert assumptions._left_to_forces(r) == {
        "brake of O": "not counted apart: the effort is the moment of motor and brake together; while it slips the "
        "motor gives 2.5 N m more in the direction of motion, at rest the brake takes up to as much",
        "start of O": "not used: the drive is prescribed (simulate starts from it)",
        "brake of S": "not counted apart: the effort is the force of motor and brake together; while it slips the "
        "motor gives 40 N more in the direction of motion, at rest the brake takes up to as much",
        "motor of S": "not used: the effort is what the prescribed motion needs",
        "stops of Q": "not counted: 1 of 2 positions is beyond them, where a stop would push",
    }


def link(mass: float, inertia: float, far: float) -> dict[str, Any]:
    return {"points": {"A": [0, 0], "B": [far, 0]}, "mass": mass, "center": [0, 0], "inertia": inertia}


@pytest.mark.parametrize(
    ("radius", "doubt"),
    [(1.9e-3, True), (2.1e-3, False), (0.4, False), (99.0, False), (101.0, True), (0.0, False)],
)
def test_an_inertia_is_doubted_by_its_radius_of_gyration(radius: float, doubt: bool) -> None:
    """Below 2 mm a metre of reach, or above 100 times the largest reach."""
    links = {"ground": {"points": {"A": [0, 0]}}, "rod": link(2.0, 2.0 * radius**2, 1.0)}
    joints = {"A": {"type": "pin", "links": ["ground", "rod"]}}
    m = da.mechanism({"links": links, "joints": joints, "drives": {"A": {"position": 0}}})
    text = f"that of a radius of gyration of {radius:.3g} m, with points up to 1 m from the mass centre: check its unit"
    assert assumptions._doubts(m) == ({"inertia of rod": text} if doubt else {})
    assert assumptions._reach(m, "rod") == 1.0
    assert assumptions._gyration(m, "rod") == pytest.approx(radius, rel=1e-12)
    assert assumptions._gyration(m, "ground") == 0.0


def test_gravity_is_said_by_its_components_or_as_the_standard_one() -> None:
    tree = da.four_bar(positions=2).to_tree()
    said = {
        "standard": "standard (9.80665 m/s2 along -y)",
        "none": "none",
    }
    for gravity, words in said.items():
        notes = da.statics(da.mechanism(tree | {"gravity": gravity})).assumptions
        assert notes["gravity"] == words
    notes = da.statics(da.mechanism(tree | {"gravity": [0.25, -9.5]})).assumptions
    assert notes["gravity"].startswith("[0.25, -9.5] m/s2")
    assert notes["inertia"] == "off (static)"
    assert da.dynamics(da.mechanism(tree)).assumptions["inertia"] == "on (D'Alembert)"


# a plane that turns


def turning(speed: Any, axis: float = math.radians(30), at: Any = (0.0, 0.0)) -> Any:
    m = SimpleNamespace(turning=SimpleNamespace(axis=axis, at=at, speed=speed))
    m.links = {name: SimpleNamespace(shapes=name == "plate") for name in ("ground", "rod", "bob", "plate")}
    m.inertia = {"ground": 5.0, "rod": 0.0, "bob": 0.4, "plate": 0.5}.get
    return m


def test_a_turning_plane_says_its_line_its_speed_and_its_points() -> None:
    by_speed = turning(20 * math.pi, at=(0.1, -0.25))
    assert printed_turning.turning_note(by_speed) == {
        "turning": "about a line at 30 deg through [0.1, -0.25] m at 600 rpm; bob as points, "
        "inertia about the axis left out"
    }
    balanced = turning(UNKNOWN)
    balanced.inertia = lambda name: 0.0
    assert printed_turning.turning_note(balanced) == {
        "turning": "about a line at 30 deg at the speed that balances"
    }
    assert printed_turning.turning_note(SimpleNamespace(turning=None)) == {}  # type: ignore[arg-type]


def turned(low: float, high: float, speed: float, given: Any = UNKNOWN) -> Any:
    return SimpleNamespace(
        mechanism=turning(given),
        turning_interval=np.array([[low, high], [low, high]]),
        turning_speed=np.array([speed, speed]),
    )


def test_the_speed_of_a_turning_plane_is_one_or_an_interval() -> None:
    w = math.pi / 30
    one = printed_turning.turning_text(turned(40 * w, 40 * w, 40 * w))
    assert one == "The plane turns at 40 rpm (4.18879 rad/s)."
    both = printed_turning.turning_text(turned(30 * w, 50 * w, 40 * w))
    assert " ".join(both.split()) == (
        "The plane may turn at 30 to 50 rpm: friction holds the machine; without it at 40 rpm."
    )
    assert printed_turning.turning_text(turned(30 * w, 50 * w, 40 * w, 40 * w)) == one
    assert printed_turning.turning_text(turned(NAN, NAN, NAN)) == ""
    assert printed_turning.turning_text(SimpleNamespace(mechanism=SimpleNamespace(turning=None))) == ""  # type: ignore[arg-type]


def test_columns_of_a_turning_plane_are_there_where_the_speed_was_unknown() -> None:
    columns = printed_turning.turning_columns
    assert columns(turned(2.0, 3.0, 2.5, 2.5)) == []
    ((name, kind, values),) = columns(turned(2.0, 2.0, 2.0))
    assert (name, kind, values.tolist()) == ("turning", "angular_speed", [2.0, 2.0])
    low, high = columns(turned(2.0, 3.0, 2.5))
    assert (low[0], low[1], low[2].tolist()) == ("turning low", "angular_speed", [2.0, 2.0])
    assert (high[0], high[1], high[2].tolist()) == ("turning high", "angular_speed", [3.0, 3.0])


# contacts


def history(**more: Any) -> Any:
    values = {"lift_factor": NAN, "lift_speed": NAN, "behind": None, "ahead": None, "changes": None}
    return SimpleNamespace(**(values | {"needed": np.array([5.0, -2.0, NAN]), "force": None} | more))


def pushed(contacts: dict[str, Any], **more: Any) -> Any:
    """An answer with contacts at three positions; the first drive stands still."""
    joints = {"F": SimpleNamespace(outlined=False), "K": SimpleNamespace(outlined=False)} | more.pop("of", {})
    values = {
        "compiled": SimpleNamespace(pushing=SimpleNamespace(joint=[1, 0, 1])),
        "inertia": True,
        "force_array": np.array([1.0]),
        "joints": ("F", "K"),
        "drives": ("L", "O"),
        "schedule": SimpleNamespace(names=("L", "O"), speed=np.array([[0.0, 3.0], [0.0, 4.0]])),
        "contact": contacts.__getitem__,
    }
    r = SimpleNamespace(**(values | more))
    r.mechanism = SimpleNamespace(
        joints=joints,
        drives={"L": SimpleNamespace(turns=False), "O": SimpleNamespace(turns=True)},
        drive_joint=lambda name: name,
    )
    return r


@pytest.fixture
def kinds(monkeypatch: pytest.MonkeyPatch) -> None:
    """Contacts push with forces, except K, a clutch; the first drive slides."""
    monkeypatch.setattr(printed_contacts, "contact_kind", lambda r, n: "moment" if n == "K" else "force")
    slides = {"position": "length", "speed": "speed"}
    turns = {"position": "angle", "speed": "angular_speed"}
    monkeypatch.setattr(printed_contacts, "drive_kinds", lambda r, n: slides if n == "L" else turns)


@pytest.mark.usefixtures("kinds")
def test_contacts_are_a_row_each_and_those_that_are_lost_say_up_to_which_speed_they_stay() -> None:
    ends = history(behind=np.array([1.0, 2.0]), ahead=np.array([-3.0, NAN]), lift_factor=0.5, lift_speed=8.0)
    parts = list(printed_contacts.contact_parts(pushed({"F": ends, "K": history()}), SI))
    forces, couples, lost = parts
    assert isinstance(forces, TextTable)
    assert isinstance(couples, TextTable)
    assert forces.heads == ["contact", "least normal force\nN", "greatest\nN", "lost from"]
    assert couples.heads == ["contact", "least couple\nN*m", "greatest\nN*m", "lost from"]
    assert forces.rows == [["F, rear end", "1", "2", "8 rad/s"], ["F, front end", "-3", "-3", "8 rad/s"]]
    assert couples.rows == [["K", "-2", "5", ""]]
    assert lost == "F stays in contact up to 8 rad/s (now 16 rad/s)."


@pytest.mark.usefixtures("kinds")
@pytest.mark.parametrize(
    ("factor", "cell", "lost"), [(0.0, "", False), (0.25, "8 rad/s", True), (1.0, "8 rad/s", False)]
)
def test_a_contact_is_lost_below_the_given_speed_only_if_its_factor_is_below_one(
    factor: float, cell: str, lost: bool
) -> None:
    c = history(lift_factor=factor, lift_speed=8.0, needed=np.full(3, NAN))
    only = pushed({"F": c}, compiled=SimpleNamespace(pushing=SimpleNamespace(joint=[0])))
    table, *more = printed_contacts.contact_parts(only, SI)
    assert isinstance(table, TextTable)
    assert table.rows[0][-1] == cell
    assert len(more) == lost
    for lacking in ({"inertia": False}, {"force_array": np.array([NAN])}):
        assert list(printed_contacts.contact_parts(pushed({"F": c}, **lacking), SI)) == []


@pytest.mark.usefixtures("kinds")
def test_walls_and_discs_are_said_with_the_places_where_they_change() -> None:
    hold = {
        "F": SimpleNamespace(outlined=True, preload=None, contact=SimpleNamespace(mode="holds")),
        "K": SimpleNamespace(outlined=True, preload=5.0, contact=SimpleNamespace(mode="holds")),
        "N": SimpleNamespace(outlined=True, preload=None, contact=SimpleNamespace(mode="pushes")),
    }
    few = history(changes=np.array([0.25, 0.5]))
    many = history(changes=np.arange(1.0, 11.0), force=np.array([3.0, -8.0, NAN]))
    r = pushed({"F": few, "K": many}, of=hold, compiled=SimpleNamespace(pushing=None))
    walls, discs = (" ".join(str(p).split()) for p in printed_contacts.contact_parts(r, SI))
    assert walls == (
        "F goes over from one wall to the other near L = 0.25, 0.5 m: with play it knocks there."
    )
    assert discs == (
        "A disc of K comes off or on near L = 1, 2, 3, 4, 5, 6, 7, 8 and 2 more m; from 4 N of preload on both "
        "stay on."
    )
    for changes in (None, np.zeros(0)):
        none = pushed({"F": history(changes=changes)}, of={"F": hold["F"], "K": hold["N"]})
        none.compiled.pushing = None
        assert list(printed_contacts.contact_parts(none, SI)) == []


# friction


def rubbing(single: list[bool], cz: list[float], critical: list[float]) -> Any:
    friction = SimpleNamespace(single=np.array(single), cz=np.array(cz)[:, None], critical=np.array(critical))
    return SimpleNamespace(friction=friction)


@pytest.mark.parametrize(
    ("friction", "which"),
    [
        (rubbing([True, True], [1.0, 1.0], [NAN, NAN]), None),
        (rubbing([False], [1.0], [NAN]), "here"),
        (rubbing([False], [NAN], [NAN]), None),
        (rubbing([False], [1.0], [0.5]), None),
        (rubbing([False, False, True], [1.0, 2.0, 1.0], [NAN] * 3), "at 2 positions"),
        (rubbing([False, True, True], [1.0, 2.0, 1.0], [NAN] * 3), "at 1 positions"),
        (SimpleNamespace(friction=None), None),
    ],
)
def test_strong_friction_is_mentioned_where_it_may_have_other_solutions(
    friction: Any, which: str | None
) -> None:
    text = printed_friction.branch_note(friction)
    assert text == (
        ""
        if which is None
        else f"Friction is so strong {which} that its equations may have other solutions: given is the physical one, "
        "continued from no friction (`--other-solutions` seeks the others, in Python `da.other_solutions`)."
    )


def both_are(value: float) -> Any:
    """A side of a reversal with this effort, and with -2 times that as its load."""
    return SimpleNamespace(
        effort=lambda name: np.array([value]), unknown_load=lambda name: np.array([-2 * value])
    )


def test_numbers_left_open_are_intervals_or_both_sides(monkeypatch: pytest.MonkeyPatch) -> None:
    kinds = {"O": "moment", "F": "force"}
    interval = {"O": np.array([[-2.0, 3.0], [4.0, INF]]), "F": np.array([[NAN, NAN], [-INF, 7.5]])}
    r: Any = SimpleNamespace(
        status=["at_rest", "ok"],
        reverses=[True, False],
        drives=("O",),
        unknown_loads=("F",),
        interval=interval.__getitem__,
        ends={"O": 1},
        friction=object(),
    )
    r.sides = [both_are(5.0), both_are(-6.0)]
    monkeypatch.setattr(printed_friction, "unknown_kinds", lambda r: kinds)
    assert printed_friction.ends_text(r, "O", SI) == "-2 to 3 N*m"
    assert printed_friction.ends_text(r, "O", SI, 1) == "4 N*m or more"
    assert printed_friction.open_text(r, "O", MM) == "-2000 to 3000 N*mm"
    assert printed_friction.with_ends(r, SI, 0, ["at", "a", "b", "c"]) == ["at", "-2 to 3", "b", "c"]
    assert printed_friction.with_ends(r, SI, 1, ["at", "a", "b"])[1:] == ["4 or more", "7.5 or less"]
    r.ends = {}
    assert printed_friction.with_ends(r, SI, 1, ["at", "a", "b"]) == ["at", "a", "b"]
    r.status = ["ok", "ok"]
    assert printed_friction.open_text(r, "O", SI) == "5 / -6 N*m"
    assert printed_friction.open_text(r, "F", SI) == "-10 / 12 N"
    r.reverses = [False, True]
    assert printed_friction.open_text(r, "O", SI) == ""
