"""Copies written out: in space by a quarter turn, value by value; and copies that do not say what they mean."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from dalembert.errors import ModelError
from dalembert.model import mechanism
from dalembert.model.description import file_rules
from dalembert.model.files.copies.expansion import expand
from dalembert.model.part import ReadingRules
from dalembert.model.quantities.varying import value_at, varying
from dalembert.model.quantities.written_tables import table

SPACE: dict[str, Any] = {
    "space": "space",
    "links": {
        "ground": {"points": {"A": [1, 2, 3], "C": ["4 mm", 5, 6]}},
        "arm": {
            "points": {"A": [0, 0, 0], "B": {"from": "A", "at": [1, 2, 3]}, "D": [7, 8, 9]},
            "center": [3, 5, 7],
            "inertia": [1, 2, 3],
        },
    },
    "joints": {"J": {"type": "revolute", "links": ["ground", "arm"], "at": "A", "axis": [1, 2, 3]}},
    "drives": {"J": {"position": 0.5}},
    "loads": {
        "F": {"type": "force", "on": "arm", "at": [1, 2, 3], "value": [4, 5, 6]},
        "T": {"type": "couple", "on": "arm", "value": [7, 8, 9]},
        "U": {"type": "force", "on": "arm", "at": "D", "value": "unknown", "direction": [1, 2, 3]},
    },
    "assembly": {"arm": {"position": [1, 2, 3], "axis": [0, 1, 5], "angle": 0.25}},
    "copies": [{"of": ["arm"], "count": 2, "phase": {"ground": "90 deg"}}],
}


def written_out(tree: dict[str, Any]) -> Any:
    return expand(tree, file_rules(tree))[0]


def test_a_copy_in_space_by_a_quarter_turn() -> None:
    """[x, y, z] becomes [-y, x, z]; what ground has of the joint is a new point of it."""
    out = written_out(SPACE)
    arm = out["links"]["arm_2"]
    assert arm["points"] == {"A": [0, 0, 0], "B": {"from": "A", "at": [-2, 1, 3]}, "D": [-8, 7, 9]}
    assert arm["center"] == [-5, 3, 7]
    assert out["links"]["ground"]["points"] == SPACE["links"]["ground"]["points"] | {"A_2": [-2, 1, 3]}
    assert out["joints"]["J_2"] == {
        "type": "revolute",
        "links": ["ground", "arm_2"],
        "at": ["A_2", "A"],
        "axis": [-2, 1, 3],
    }
    assert out["drives"]["J_2"] == {"position": 0.5}
    loads = out["loads"]
    assert (loads["F_2"]["on"], loads["F_2"]["at"], loads["F_2"]["value"]) == (
        "arm_2",
        [-2, 1, 3],
        [-5, 4, 6],
    )
    assert loads["T_2"]["value"] == [-8, 7, 9]
    assert (loads["U_2"]["at"], loads["U_2"]["value"], loads["U_2"]["direction"]) == (
        "D",
        "unknown",
        [-2, 1, 3],
    )
    assert out["assembly"]["arm_2"] == {"position": [-2, 1, 3], "axis": [-1, 0, 5], "angle": 0.25}
    assert out["links"]["arm"] == SPACE["links"]["arm"]
    assert mechanism(SPACE).links.keys() == {"ground", "arm", "arm_2"}


@pytest.mark.parametrize(
    ("inertia", "turned"),
    [
        ([1, 2, 3], [[2, 0, 0], [0, 1, 0], [0, 0, 3]]),
        ([[1, 2, 3], [2, 4, 5], [3, 5, 60]], [[4, -2, -5], [-2, 1, 3], [-5, 3, 60]]),
    ],
)
def test_an_inertia_by_a_quarter_turn(inertia: Any, turned: Any) -> None:
    tree = {**SPACE, "links": {**SPACE["links"], "arm": {**SPACE["links"]["arm"], "inertia": inertia}}}
    rows = written_out(tree)["links"]["arm_2"]["inertia"]
    assert {x.split(" ")[1] for row in rows for x in row} == {"kg*m^2"}
    assert np.array([[float(x.split()[0]) for x in row] for row in rows]) == pytest.approx(np.array(turned))
    assert rows == [list(row) for row in zip(*rows, strict=True)]


def test_shapes_and_axes_by_a_quarter_turn() -> None:
    shapes = [
        {"type": "sphere", "radius": 1, "center": [1, 2, 3], "density": 2},
        {"type": "cylinder", "radius": 1, "axis": [1, 2, 3], "length": 4, "density": 2},
        {"type": "box", "size": [1, 2, 3], "axes": {"x": [1, 2, 0], "z": [0, 0, 1]}, "density": 2},
        {"type": "box", "size": [1, 2, 3], "density": 2},
    ]
    arm = {"points": {"A": [0, 0, 0]}, "shape": shapes}
    tree = {**SPACE, "links": {**SPACE["links"], "arm": arm}, "loads": {}}
    tree["joints"] = {"J": SPACE["joints"]["J"] | {"at": ["C", "A"]}}
    tree["joints"]["J"].pop("axis")
    tree["joints"]["J"] |= {"axes": {"i": {"z": [1, 2, 3]}, "j": {"x": [3, 0, 1], "z": [0, 4, 0]}}}
    out = written_out(tree)
    made = out["links"]["arm_2"]["shape"]
    assert (made[0]["center"], made[1]["axis"]) == ([-2, 1, 3], [-2, 1, 3])
    assert made[2]["axes"] == {"x": [-2, 1, 0], "z": [0, 0, 1]}
    assert made[3] == shapes[3]
    axes = out["joints"]["J_2"]["axes"]
    assert axes == {"i": {"z": [-2, 1, 3]}, "j": {"x": [0, 3, 1], "z": [-4, 0, 0]}}
    assert out["links"]["ground"]["points"]["C_2"] == [-5, "4 mm", 6]
    one = {**tree, "links": {**tree["links"], "arm": {**arm, "shape": shapes[0]}}}
    assert written_out(one)["links"]["arm_2"]["shape"] == made[0]


PLANE: dict[str, Any] = {
    "links": {
        "ground": {"points": {"O": [0, 0]}},
        "rod": {"points": {"O": [0, 0]}},
        "cam": {"points": {"O": [0, 0]}},
        "arm": {"points": {"O": [0, 0]}},
    },
    "joints": {"J": {"type": "pin", "links": ["ground", "rod"], "at": "O"}},
}


@pytest.mark.parametrize(
    ("entry", "says", "at"),
    [
        ({"of": ["xyz"], "count": 2}, "unknown moving link 'xyz'; choose among arm, cam, rod", ("of", 0)),
        (
            {"of": ["rod", "ground"], "count": 2},
            "unknown moving link 'ground'; choose among arm, cam, rod",
            ("of", 1),
        ),
        ({"of": [], "count": 2}, "it says no links; write {of: [rod, piston], phase:", ("of",)),
        ({"count": 2}, "it says no links; write {of: [rod, piston], phase:", ()),
        (
            {"of": ["rod"], "phase": {"rod": [0, 90]}},
            "'rod' is not a link outside the copies; choose among arm, cam, ground",
            ("phase",),
        ),
        (
            {"of": ["rod"], "mirror": {"xyz": 90}},
            "'xyz' is not a link outside the copies; choose among arm, cam, ground",
            ("mirror",),
        ),
        (
            {"of": ["rod"], "phase": 90, "count": 2},
            "90 does not say on which link; write phase: {crank: [0, 180]}",
            ("phase",),
        ),
        (
            {"of": ["rod"], "phase": {"ground": 90}, "mirror": 90},
            "it is both turned and mirrored; write phase or mirror",
            ("mirror",),
        ),
        (
            {"of": ["rod"]},
            "it does not say how many, from 2 to 100; write count: 4, the original among them",
            (),
        ),
        ({"of": ["rod"], "count": 1}, "it does not say how many, from 2 to 100; write count: 4", ("count",)),
        (
            {"of": ["rod"], "count": 101},
            "it does not say how many, from 2 to 100; write count: 4",
            ("count",),
        ),
        (
            {"of": ["rod"], "count": True},
            "it does not say how many, from 2 to 100; write count: 4",
            ("count",),
        ),
        (
            {"of": ["rod"], "count": 2, "phase": {"ground": [0, 1, 2], "arm": [0, 1, 2, 3]}},
            "count is 2, but a list has 4 values; give one",
            (),
        ),
        (
            {"of": ["rod"], "phase": {"ground": [5, 90]}},
            "a list begins with 5, and the original stays; begin with 0",
            ("phase", 0),
        ),
        (
            {"of": ["rod"], "count": 3, "names": ["a"]},
            "2 names are needed, of the copies only; write names: [left, right]",
            ("names",),
        ),
        (
            {"of": ["rod"], "count": 3, "names": ["a", "a"]},
            "2 names are needed, of the copies only",
            ("names",),
        ),
        ({"of": ["rod"], "count": 2, "names": "a"}, "1 names are needed, of the copies only", ("names",)),
        (
            {"of": ["rod"], "count": 2, "shift": 30},
            "shift has no effect: none of its loads depends on a drive that is not copied; leave shift out",
            ("shift",),
        ),
    ],
)
def test_copies_that_do_not_say_what_they_mean(entry: dict[str, Any], says: str, at: tuple[Any, ...]) -> None:
    with pytest.raises(ModelError) as caught:
        written_out({**PLANE, "copies": [entry]})
    assert f"{caught.value.what}; {caught.value.remedy}".startswith(f"copies 1: {says}")
    assert caught.value.path == ("copies", 0, *at)


def test_copies_are_numbered_or_named() -> None:
    out = written_out(
        {
            **PLANE,
            "copies": [
                {"of": ["rod"], "count": 3, "phase": {"ground": 30}},
                {"of": ["arm"], "count": 2, "names": ["b"]},
            ],
        }
    )
    assert list(out["links"]) == ["ground", "rod", "cam", "arm", "rod_2", "rod_3", "arm_b"]
    assert list(out["joints"]) == ["J", "J_2", "J_3"]
    twice = {**PLANE, "links": PLANE["links"] | {"rod_2": {}}, "copies": [{"of": ["rod"], "count": 2}]}
    with pytest.raises(
        ModelError, match=r"^copies 1: its link 'rod_2' already exists; give the copies other names"
    ):
        mechanism(twice)
    taken = {
        **PLANE,
        "joints": PLANE["joints"] | {"J_2": PLANE["joints"]["J"]},
        "copies": [{"of": ["rod"], "count": 2}],
    }
    with pytest.raises(ModelError) as caught:
        written_out(taken)
    assert caught.value.what == "copies 1: its joint 'J_2' already exists"


@pytest.mark.parametrize(
    ("first", "along"), [("1 mm", "length"), ("1 deg", "angle"), (1, "angle"), ("0.5 rad", "angle")]
)
def test_the_first_x_says_what_a_table_is_along(first: Any, along: str) -> None:
    last = "2 m" if along == "length" else 2
    assert table({"against": "Z", "x": [first, last], "y": [3, 4]}, "force", ReadingRules()).along == along


def test_values_that_change_have_the_shape_of_their_drives() -> None:
    rules = ReadingRules()
    assert value_at(3, {}) == 3.0
    assert value_at(3, {"O": np.zeros((2, 3))}).shape == (2, 3)  # type: ignore[union-attr]
    assert value_at(varying("2*O", "force", rules), {"O": np.array([1.0, 2.0])}).tolist() == [2, 4]  # type: ignore[union-attr]
    both = value_at(varying("2*O", "force", rules), {"O": 1.5, "P": np.zeros(2)})
    assert both.tolist() == [3, 3]  # type: ignore[union-attr]
    for text in ("nan", "-inf", "Infinity", ""):
        with pytest.raises(ModelError):
            varying(text, "force", rules)
    assert varying("2*O kN", "force", rules).at({"O": 1.5}) == 3000.0  # type: ignore[union-attr]
    assert varying({"expression": "2*O", "unit": "kN"}, "force", rules).at({"O": 1.5}) == 3000.0  # type: ignore[union-attr]
    assert varying("1e3 N", "force", rules) == 1000.0
