"""Rules of the description one by one: paths, gravity, names of quantities, stops and schedules."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.model import Drive, Schedule
from dalembert.model.drives.end_stops import end_stops
from dalembert.model.drives.schedule import schedule
from dalembert.model.gravity import gravity_doubt
from dalembert.model.joints.space_joints import _square
from dalembert.model.part import ReadingRules
from dalembert.model.paths import _mirror, as_in_file, latest, set_value, value_at
from dalembert.model.stated_answers import StatedAnswer, parts_of_name

RULES = ReadingRules()


def refused(call: Any, *arguments: Any, **keys: Any) -> tuple[str, tuple[Any, ...]]:
    with pytest.raises(ModelError) as caught:
        call(*arguments, **keys)
    return f"{caught.value.what}; {caught.value.remedy}", caught.value.path


def test_a_product_of_inertia_is_put_into_both_places() -> None:
    rows = ((1.0, 2.0, 3.0), (2.0, 4.0, 5.0), (3.0, 5.0, 6.0))
    for i, j in ((0, 1), (1, 0), (0, 2), (2, 0), (1, 2), (2, 1)):
        changed = tuple(tuple(9.0 if (a, b) == (i, j) else rows[a][b] for b in range(3)) for a in range(3))
        both = tuple(tuple(9.0 if {a, b} == {i, j} else rows[a][b] for b in range(3)) for a in range(3))
        assert _mirror(changed, [str(i), str(j)]) == both
    assert _mirror(rows, ["1"]) is rows
    assert _mirror(rows, ["2", "2"]) is rows


def test_values_at_paths() -> None:
    m = da.four_bar()
    assert value_at(m, ["links", "crank", "mass"]) == m.links["crank"].mass
    assert value_at(m, ["links", "crank", "points", "A", "0"]) == 0.09
    assert value_at(m, []) is m
    other = set_value(m, ["links", "crank", "points", "A", "1"], 0.7)
    assert other.links["crank"].points["A"] == (0.09, 0.7)
    assert m.links["crank"].points["A"] == (0.09, 0.0)
    for path, says, at in (
        (
            "links.crnk.mass",
            "path 'links.crnk': 'crnk' does not exist in links; did you mean 'crank'?",
            ("links",),
        ),
        ("lnks", "path 'lnks': 'lnks' does not exist; did you mean 'links'?", ()),
        (
            "links.crank.mass.x.y",
            "the path 'links.crank.mass.x.y' goes into a single value; leave out its end",
            ("links", "crank", "mass"),
        ),
        (
            "links.crank.points.A.2",
            "path 'links.crank.points.A.2': '2' does not exist in links.crank.points.A; choose among 0, 1",
            ("links", "crank", "points", "A"),
        ),
    ):
        assert refused(value_at, m, path.split(".")) == (says, at)
        assert refused(m.with_values, {path: 1.0}) == (says, at)


def test_of_changes_the_last_one_counts() -> None:
    earlier = {"a.b": 1, "a.bc": 2, "a.b.c": 3, "d": 4}
    assert latest(earlier, {"a.b": 9}) == {"a.bc": 2, "d": 4, "a.b": 9}
    assert latest(earlier, {"a": 9, "e": 5}) == {"d": 4, "a": 9, "e": 5}


def test_texts_that_are_lists_are_read_as_a_file_has_them() -> None:
    assert as_in_file("[1, 2 mm]") == ["1", "2 mm"]
    assert as_in_file(" {a: 3, b: [true, x]}") == {"a": "3", "b": [True, "x"]}
    assert as_in_file("[1, 2]", "title") == "[1, 2]"
    assert as_in_file({"title": "[1]", "x": "[1]", "y": ("[2]", 3)}) == {
        "title": "[1]",
        "x": ["1"],
        "y": [["2"], 3],
    }


@pytest.mark.parametrize(
    ("vector", "says"),
    [
        ((0.0, -1.01), ""),
        ((0.0, 0.0, 29.9), ""),
        ((0.0, 0.0), ""),
        ((0.6, -0.8 * 1.2), ""),
        (
            (0.0, -0.99),
            "0.99 m/s2 is not between 1 and 30 m/s2: write gravity: standard, or [0, -9.81 m/s^2]",
        ),
        (
            (0.0, 0.0, 30.1),
            "30.1 m/s2 is not between 1 and 30 m/s2: write gravity: standard, or [0, 0, -9.81 m/s^2]",
        ),
        (
            (20.0, 24.0),
            "31.2 m/s2 is not between 1 and 30 m/s2: write gravity: standard, or [0, -9.81 m/s^2]",
        ),
    ],
)
def test_gravity_in_doubt(vector: tuple[float, ...], says: str) -> None:
    assert gravity_doubt(vector) == says


@pytest.mark.parametrize(
    ("name", "keys"),
    [
        ("effort.O2", {"quantity": "effort", "of": "O2"}),
        ("effort.O2.low", {"quantity": "effort_low", "of": "O2"}),
        ("reaction.A.x", {"quantity": "reaction", "of": "A", "component": "x"}),
        ("reaction.A.high.y", {"quantity": "reaction_high", "of": "A", "component": "y"}),
        ("reaction_moment.A", {"quantity": "moment", "of": "A"}),
        ("drive.O2.speed", {"quantity": "drive_speed", "of": "O2"}),
        ("angle.rod.acceleration", {"quantity": "acceleration", "of": "rod"}),
        (
            "point.rod.P.velocity.direction",
            {"quantity": "point_velocity", "of": "rod.P", "component": "direction"},
        ),
        ("point.rod.origin", {"quantity": "position", "of": "rod"}),
        (
            "point.rod.center.acceleration.z",
            {"quantity": "center_acceleration", "of": "rod", "component": "z"},
        ),
        ("slide1.B.speed", {"quantity": "slide1_speed", "of": "B"}),
        ("turning_speed.low", {"quantity": "turning_speed_low"}),
        ("residual", {"quantity": "residual"}),
        ("shaking_force.magnitude", {"quantity": "shaking_force", "component": "magnitude"}),
        ("effort.x", {"quantity": "effort", "of": "x"}),
        ("acceleration.rod", {"quantity": "acceleration", "of": "rod"}),
    ],
)
def test_the_name_of_a_quantity(name: str, keys: dict[str, str]) -> None:
    assert parts_of_name(name) == keys
    if "." in name:
        answer = StatedAnswer(quantity=name)
        assert (answer.quantity, answer.of, answer.component) == tuple(
            map(keys.get, ("quantity", "of", "component"))
        )
        assert answer.name == (
            "angle.rod.acceleration"
            if name == "acceleration.rod"
            else name.removesuffix(f".{keys.get('component')}")
        )


def test_what_is_no_name_of_a_quantity() -> None:
    says, _ = refused(parts_of_name, "effrt.O2")
    assert (
        says
        == "unknown quantity 'effrt.O2'; write effort.NAME, reaction.NAME.x or another of docs/quantities.md"
    )
    for value in (True, [1, [2, None, {}]], math.inf, {"a": 1}):
        with pytest.raises(ModelError):
            StatedAnswer(quantity="effort", of="O", value=value)
    assert StatedAnswer(quantity="rotation", of="a", value=[[1, 2], [3, 4]]).value == ((1, 2), (3, 4))
    with pytest.raises(ModelError):
        StatedAnswer(quantity="rotation", of="a", tolerance=[[1, 2], [3, 4]])


@pytest.mark.parametrize(
    ("keys", "says", "at"),
    [
        (
            {"restitution": 0.5},
            "the stops say neither from nor to; write stops: {from: 0 mm, to: 80 mm, restitution: 0.4}; one of the "
            "two is enough",
            (),
        ),
        (
            {"from": 2, "to": 2},
            "the stops go from 2 to 2; give from the least and to the greatest position",
            ("from",),
        ),
        (
            {"from": 2, "to": 1},
            "the stops go from 2 to 1; give from the least and to the greatest position",
            ("from",),
        ),
        (
            {"to": 1, "restitution": 1.1},
            "restitution is 1.1; it is the speed after an impact over the speed before; write a number "
            "from 0 (no rebound) to 1 (no energy lost)",
            ("restitution",),
        ),
        (
            {"to": 1, "restitution": -0.1},
            "restitution is -0.1; it is the speed after an impact over the speed before; write a number "
            "from 0 (no rebound) to 1 (no energy lost)",
            ("restitution",),
        ),
        ({"to": 1, "stiffness": 0}, "0 is not positive; write a positive one", ("stiffness",)),
        (
            {"to": 1, "damping": 3},
            "the stops have a damping without a stiffness; write stiffness: 2e5 N/m, or a damper load",
            ("damping",),
        ),
        (
            {"to": 1, "stiffness": 3, "restitution": 0.2},
            "the stops have a restitution and a stiffness; leave one out; what an elastic "
            "stop takes of the speed is its damping",
            ("restitution",),
        ),
    ],
)
def test_stops_that_cannot_be(keys: dict[str, Any], says: str, at: tuple[str, ...]) -> None:
    assert refused(end_stops, keys, "length", RULES) == (says, at)


def test_stops_as_they_are_written() -> None:
    for keys, written in (
        ({"to": 2}, {"to": "2.0 m"}),
        ({"from": -1, "restitution": 1}, {"from": "-1.0 m", "restitution": 1.0}),
        ({"from": -1, "to": 2, "restitution": 0.0}, {"from": "-1.0 m", "to": "2.0 m"}),
        (
            {"from": 1, "stiffness": 3, "damping": 4},
            {"from": "1.0 m", "stiffness": "3.0 N/m", "damping": "4.0 N*s/m"},
        ),
    ):
        stops = end_stops(keys, "length", RULES)
        assert stops.tree("length") == written
        assert (stops.least, stops.greatest) == (keys.get("from", -math.inf), keys.get("to", math.inf))
    turn = end_stops({"to": 2, "stiffness": 3, "damping": 4}, "angle", RULES)
    assert turn.tree("angle") == {"to": "2.0 rad", "stiffness": "3.0 N*m/rad", "damping": "4.0 N*m*s/rad"}


def moving(position: Any, speed: Any, acceleration: Any = 0.0, **more: Any) -> Schedule:
    return Schedule(
        ("a", "b"), *(np.array(x, float) * np.ones((3, 2)) for x in (position, speed, acceleration)), **more
    )


def test_a_clock_runs_with_the_first_drive_that_has_a_constant_speed() -> None:
    at = [[1, 10], [2, 12], [4, 16]]
    assert moving(at, [0, 2]).clock == pytest.approx([0, 1, 3])
    assert moving(at, [-0.5, 2]).clock == pytest.approx([0, -2, -6])
    assert moving(at, [0, 2], began=np.array([1, 8.0])).clock == pytest.approx([1, 2, 4])
    assert moving(at, [[0, 2], [0, 2], [0, 3]]).clock is None
    assert moving(at, [0, 2], [0, 0.1]).clock is None
    assert moving(at, 0).clock is None
    assert moving(at, [0, 2], time=np.array([5, 6, 7.0])).clock == pytest.approx([5, 6, 7])


def test_a_machine_moves_also_where_it_only_turns_round() -> None:
    speeds, bends = [[1, 0], [0, 0], [-1, 0]], [[-3, 0], [-3, 0], [-3, 0]]
    assert moving(0, speeds, bends).moves.tolist() == [True, True, True]
    assert moving(0, speeds).moves.tolist() == [True, False, True]
    assert moving(0, [[0, 0], [0, 0], [-1, 0]], bends).moves.tolist() == [False, False, True]
    after = moving(0, speeds, bends, after=np.array([[-3, 0], [4, 0], [-3, 0.0]]))
    assert after.jumps.tolist() == [[False, False], [True, False], [False, False]]
    assert after.just_after.acceleration.tolist() == [[-3, 0], [4, 0], [-3, 0]]
    assert not moving(0, speeds).jumps.any()


def test_a_lone_turn_is_stepped_round() -> None:
    turn, slide = Drive(position=0.5, freedom="turn"), Drive(position=0.2, freedom="slide")
    s = schedule({"S": slide, "O": turn}, 4)
    assert s.position.tolist() == [[0.2, pytest.approx(0.5 + k * math.pi / 2)] for k in range(4)]
    assert schedule({"O": turn}, 1).position.tolist() == [[0.5]]
    assert refused(schedule, {"S": slide}, 4)[0].startswith(
        "positions=4 needs one drive that turns, not 0 (none); give one"
    )
    assert refused(schedule, {"O": turn, "P": turn}, 4)[0].startswith(
        "positions=4 needs one drive that turns, not 2 (O, P);"
    )
    assert refused(schedule, {}, 4) == (
        "positions=4 cannot be used: a structure has no drive; leave the number out",
        ("drives",),
    )
    assert refused(schedule, {"O": turn}, 0)[0] == "positions=0 is out of range; use 1 to 10000000"
    lists = {"O": Drive(position=(1, 2, 3), freedom="turn"), "P": Drive(position=(1, 2), freedom="turn")}
    assert refused(schedule, lists) == (
        "the numbers of positions differ: 3 of drive 'O' and 2 of drive 'P'; "
        "drives advance together: give equal counts, or single values",
        ("drives", "P"),
    )
    assert refused(schedule, {"O": lists["O"]}, 2) == (
        "the numbers of positions differ: 3 of drive 'O', but positions=2; "
        "the list sets the count: leave the number out, or write {from, to, count}",
        ("drives", "O"),
    )
    assert schedule({"O": turn, "S": slide}, [[1, 2], [3, 4]]).position.tolist() == [[1, 2], [3, 4]]
    assert schedule({"O": turn, "S": slide}, [1, 2, 3, 4]).position.tolist() == [[1, 2], [3, 4]]
    assert refused(schedule, {"O": turn, "S": slide}, [1, 2, 3])[0].startswith(
        "positions of shape (3,) do not fit 2 drive(s)"
    )


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_vector_along_an_axis_in_either_sense_gives_no_direction_across_it(sign: float) -> None:
    """Up to a cosine of 0.9, from both sides."""
    axis = (0.0, 0.0, 1.0)
    for cosine, known in ((0.899, True), (0.901, False)):
        across = _square((3.0 * math.sqrt(1 - cosine**2), 0.0, 3.0 * sign * cosine), axis)
        assert (across is not None) is known
        assert across is None or across == pytest.approx((1.0, 0.0, 0.0))
