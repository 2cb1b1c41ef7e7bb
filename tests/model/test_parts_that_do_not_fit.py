"""Names that do not exist and parts that do not belong together: each is refused at its place in the file."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from dalembert.errors import ModelError
from dalembert.model import Couple, ForceLoad, Link, Mechanism, ModelErrors, mechanism, read_file
from dalembert.model.part import ReadingRules
from dalembert.model.quantities.written_tables import table as read_table

PLANE: dict[str, Any] = {
    "links": {
        "ground": {"points": {"O": [0, 0], "Q": [0.3, 0.1]}},
        "crank": {"points": {"O": [0, 0], "Ab": [0.05, 0]}, "mass": 2},
        "block": {"points": {"S": [0, 0]}, "mass": 3},
    },
    "joints": {
        "O": {"type": "pin", "links": ["ground", "crank"]},
        "S": {"type": "slider", "links": ["ground", "block"], "at": ["Q", "S"]},
    },
    "drives": {"O": {"position": "20 deg"}, "slide": {"joint": "S", "position": "0.2 m"}},
    "loads": {"F": {"type": "force", "on": "crank", "at": "Ab", "value": [2, 3]}},
}
SPACE: dict[str, Any] = {
    "space": "space",
    "links": {
        "ground": {"points": {"O": [0, 0, 0], "B": [0, 0.2, 0]}},
        "arm": {"points": {"O": [0, 0, 0], "A": [0.1, 0, 0]}, "mass": 2, "inertia": [0.2, 0.3, 0.4]},
        "ball": {"points": {"B": [0, 0, 0]}, "mass": 1},
    },
    "joints": {
        "O": {"type": "revolute", "links": ["ground", "arm"], "axis": [0, 0, 1]},
        "B": {"type": "spherical", "links": ["ground", "ball"]},
    },
    "drives": {"O": {"position": "20 deg"}},
    "loads": {"F": {"type": "force", "on": "arm", "at": "A", "value": [1, 2, 3]}},
}
TIMED = {"speed": "3 rad/s", "position": "20 deg"}
FORCE = {"type": "force", "on": "crank", "at": "Ab", "direction": "30 deg"}


def edited(base: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """The tree with values put at their paths."""
    tree = deepcopy(base)
    for path, value in changes.items():
        at = tree
        *keys, last = path.split("/")
        for key in keys:
            at = at.setdefault(key, {})
        at[last] = value
    return tree


def said(tree: dict[str, Any]) -> list[tuple[tuple[Any, ...], str]]:
    """Path and sentence of every problem."""
    with pytest.raises(ModelError) as caught:
        mechanism(tree)
    error = caught.value
    every = error.errors if isinstance(error, ModelErrors) else [error]
    return [(one.path, f"{one.what}; {one.remedy}") for one in every]


WRONG: Any = read_file(Path(__file__).with_name("wrong_parts.yaml"))[0]
ROWS = [(base, row) for key, base in (("plane", PLANE), ("space", SPACE)) for row in WRONG[key]]


@pytest.mark.parametrize(("base", "row"), ROWS, ids=[str(k) for k in range(len(ROWS))])
def test_what_does_not_fit_is_told_at_its_place(base: dict[str, Any], row: dict[str, Any]) -> None:
    assert said(edited(base, row["change"])) == [(tuple(row["at"]), row["says"])]


def test_problems_are_listed_in_the_order_of_the_file() -> None:
    tree = edited(PLANE, {"assembly": {"blck": 1}, "joints/S/links": ["ground", "blok"]})
    tree = edited(tree, {"loads/F/at": "Z", "drives/N": {"position": 1}, "links/ground/mass": 2})
    assert [path for path, _ in said(tree)] == [
        ("links", "ground"),
        ("joints", "S", "links", 1),
        ("drives", "N"),
        ("loads", "F", "at"),
        ("assembly", "blck"),
    ]


MOVED: dict[str, dict[str, Any]] = {
    "a speed": {"drives/O": TIMED},
    "an acceleration": {"drives/O": {"position": "20 deg", "acceleration": "3 rad/s^2"}},
    "a law": {"drives/O": {"law": {"type": "harmonic", "from": 2, "to": 9, "duration": 3, "count": 5}}},
    "an effort": {"drives/O": {"position": "20 deg", "effort": 2}},
    "a start": {"start": {"O": {"position": 0.2}}},
}


@pytest.mark.parametrize("changes", MOVED.values(), ids=MOVED)
def test_a_load_may_depend_on_time_where_something_moves(changes: dict[str, Any]) -> None:
    m = mechanism(edited(PLANE, {"loads/F": FORCE | {"value": "5*time"}} | changes))
    assert m.loads["F"].value.names == {"time"}


def bodies(point: tuple[float, ...], **keys: Any) -> dict[str, Link]:
    return {"ground": Link(points={"O": (0.0,) * len(point)}), "bar": Link(points={"P": point}, **keys)}


@pytest.mark.parametrize(
    ("space", "links", "says"),
    [
        ("plane", bodies((0.1, 0.2, 0.3)), "3 components, and 2 are needed in the plane; write [x, y]"),
        ("space", bodies((0.1, 0.2)), "2 components, and 3 are needed in space; write [x, y, z]"),
        (
            "space",
            bodies((0.1, 0.2, 0.3), center=(0.1, 0.2)),
            "2 components, and 3 are needed in space; write [x, y, z]",
        ),
        (
            "plane",
            bodies((0.1, 0.2), inertia=(1, 2, 3)),
            "3 components, and 2 are needed in the plane; write [x, y]",
        ),
    ],
)
def test_vectors_have_the_components_of_the_mechanism(space: Any, links: dict[str, Link], says: str) -> None:
    with pytest.raises(ModelError) as caught:
        Mechanism(space=space, links=links)
    assert str(caught.value).splitlines()[-1] == f"a vector of link 'bar' has {says}"


@pytest.mark.parametrize(
    ("base", "load", "says"),
    [
        (
            PLANE,
            Couple(on="crank", value=3.0, direction=(0, 2, 1)),
            "load 'L' has a direction in the plane; leave it out\n"
            "the direction of load 'L' has 3 components, and 2 are needed in the plane; write [x, y]",
        ),
        (
            PLANE,
            ForceLoad(on="crank", at=(0.1, 0.2, 0.3), value=(2.0, 3.0)),
            "the at of load 'L' has 3 components, and 2 are needed in the plane; write [x, y]",
        ),
        (
            PLANE,
            ForceLoad(on="crank", at="O", value=(2.0, 3.0, 4.0)),
            "the value of load 'L' has 3 components, and 2 are needed in the plane; write [x, y]",
        ),
        (
            SPACE,
            ForceLoad(on="arm", at=(0.1, 0.2), value=(2.0, 3.0, 4.0)),
            "the at of load 'L' has 2 components, and 3 are needed in space; write [x, y, z]",
        ),
    ],
)
def test_loads_have_the_components_of_the_mechanism(base: dict[str, Any], load: Any, says: str) -> None:
    m = mechanism(base)
    with pytest.raises(ModelError) as caught:
        Mechanism(space=m.space, links=m.links, joints=m.joints, loads={"L": load})
    assert str(caught.value) == says


TABLE = {"against": "O", "x": ["0 deg", "90 deg"], "y": [2, 3]}


@pytest.mark.parametrize(
    ("against", "says"),
    [
        ("slide", "load 'L' is a table whose x are angles, and the position of drive 'slide' is a length"),
        ("joints.S.slide", "load 'L' is a table whose x are angles, and 'joints.S.slide' is a length"),
        ("time", "load 'L' is a table whose x are angles, and 'time' is a time"),
        ("O.speed", "load 'L' is a table whose x are angles, and 'O.speed' is an angular speed"),
    ],
)
def test_a_table_has_x_of_the_kind_that_it_is_against(against: str, says: str) -> None:
    m = mechanism(edited(PLANE, {"drives/O": TIMED}))
    value = replace(read_table(TABLE, "force", ReadingRules(freedoms={"O": "turn"})), against=against)
    load = ForceLoad(on="crank", at="Ab", value=value, direction=0.3)
    with pytest.raises(ModelError) as caught:
        Mechanism(links=m.links, joints=m.joints, drives=m.drives, loads={"L": load})
    assert str(caught.value) == f"{says}; give x with units of that kind"
    assert caught.value.path == ("loads", "L", "value", "x")
