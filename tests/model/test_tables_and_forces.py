"""Tables within and beyond their points, their periods and units; components of forces: by hand, and refusals."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from dalembert.errors import ModelError
from dalembert.model import Couple, Expression, ForceLoad, Table
from dalembert.model.part import ReadingRules
from dalembert.model.quantities.written_tables import table, table_tree

RULES = ReadingRules(freedoms={"O": "turn", "S": "slide"})
TURN = 2 * math.pi


def refused(call: Any, *arguments: Any, **keys: Any) -> str:
    with pytest.raises(ModelError) as caught:
        call(*arguments, **keys)
    return f"{caught.value.what}; {caught.value.remedy}"


def test_a_table_within_and_outside_its_points() -> None:
    points = ("O", (1.0, 2.0, 4.0), (10.0, 30.0, 20.0))
    assert [Table(*points).at({"O": x}) for x in (0.5, 1, 1.5, 2, 3, 4, 9)] == [10, 10, 20, 30, 25, 20, 20]
    assert [Table(*points, outside="zero").at({"O": x}) for x in (0.5, 1, 3, 4, 9)] == [0, 10, 25, 20, 0]
    assert [Table(*points, shift=0.5, times=2.0).at({"O": x}) for x in (1.5, 2.0, 3.5)] == [20, 40, 50]
    round_ = Table(*points, period=5.0)
    assert round_.closed() == ((1.0, 2.0, 4.0, 6.0), (10.0, 30.0, 20.0, 10.0))
    assert [round_.at({"O": x}) for x in (5.0, 5.5, 6.5, -1.0, 11.0)] == pytest.approx([15, 12.5, 20, 20, 10])
    beyond = np.array([0.9, 1.0, 4.0, 4.1])
    assert Table(*points).beyond(beyond).tolist() == [True, False, False, True]
    assert Table(*points, shift=0.1).beyond(beyond).tolist() == [True, True, False, False]
    for other in (round_, Table(*points, outside="hold"), Table(*points, outside="zero")):
        assert other.beyond(beyond).tolist() == [False] * 4
    assert [Table(*points, shift=0.5).next_point(x) for x in (0, 1.5, 2, 4.4, 4.5)] == [
        1.5,
        2.5,
        2.5,
        4.5,
        math.inf,
    ]
    assert [round_.next_point(x) for x in (0.0, 1.0, 4.5, 6.0, -3.0)] == [1, 2, 6, 7, -1]
    breaks, coefficients = Table(*points, outside="zero").everywhere()
    assert breaks[[0, -1]] == pytest.approx([-3e9, 3e9], rel=1e-8)
    assert coefficients.tolist() == [[0, 20, -5, 0], [0, 10, 30, 0]]
    with pytest.raises(ModelError, match=r"a table is against 'O', which"):
        Table(*points).at({"P": 1.0})


TABLE = {"against": "O", "x": [0, 1, 3], "y": [2, 5, 4]}


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ({"y": [2, 5]}, "a table has 3 values in x and 2 in y; give one y for each x"),
        ({"x": [1], "y": [1]}, "a table has too few points: 1; give at least 2"),
        ({"x": [0, 1, 1]}, "x of a table does not increase from its item 2 to 3; sort the points"),
        ({"x": [2, 1, 3]}, "x of a table does not increase from its item 1 to 2; sort the points"),
        ({"interpolate": "smooth"}, "'smooth' is not a valid value; write linear or cubic"),
        (
            {"periodic": 2},
            "a periodic table goes over 171.887 deg and repeats after 114.592 deg; leave out the points",
        ),
        (
            {"periodic": 0},
            "a periodic table goes over 171.887 deg and repeats after 0 deg; leave out the points",
        ),
        (
            {"periodic": 3},
            "a periodic table ends with another value than it begins with; give the first value again",
        ),
        ({"outside": "none"}, "outside is 'none'; write one of refuse, hold, zero"),
        (
            {"outside": "hold", "periodic": 5},
            "a periodic table goes on outside its points; leave outside, or periodic, out",
        ),
        ({"columns": [1, 2]}, "columns are of a file; write file: as well, or leave them out"),
        ({"units": ["deg", "N"]}, "units are of a file; write file: as well, or leave them out"),
        ({"file": "a.csv"}, "both file and x are given; leave one of them out"),
        (
            {"times": "2 m", "y": ["2 rad", 3, 4]},
            "the values times this are not a force; a pressure times an area is a force",
        ),
    ],
)
def test_a_table_that_cannot_be(keys: dict[str, Any], says: str) -> None:
    assert says in refused(table, TABLE | keys, "force", RULES)


@pytest.mark.parametrize(
    ("x", "against", "periodic", "period"),
    [
        ([0, 1, TURN], "O", True, TURN),
        ([0, 1, 3], "O", True, TURN),
        ([0, 1, 2 * TURN], "O", True, 2 * TURN),
        ([0, 1, 3], "S", True, 3),
        ([0, 1, 3], "O", 5, 5),
        ([0, 1, 3], "O", False, None),
    ],
)
def test_the_period_of_a_table(x: list[float], against: str, periodic: Any, period: float | None) -> None:
    made = table({"against": against, "x": x, "y": [2, 5, 2], "periodic": periodic}, "force", RULES)
    assert made.period == (None if period is None else pytest.approx(period, rel=1e-12))
    assert made.along == ("angle" if against == "O" else "length")


def test_a_table_is_written_as_it_was_read() -> None:
    keys = TABLE | {
        "times": "0.002 m^2",
        "y": ["2 N/mm^2", 5e6, 4e6],
        "shift": 0.25,
        "outside": "hold",
        "interpolate": "cubic",
    }
    made = table(keys, "force", RULES)
    assert (made.of, made.times, made.y, made.shift) == ("pressure", 0.002, (2e6, 5e6, 4e6), 0.25)
    assert table_tree(made, "force") == {
        "against": "O",
        "x": ["0.0 rad", "1.0 rad", "3.0 rad"],
        "y": ["2000000.0 N/m^2", "5000000.0 N/m^2", "4000000.0 N/m^2"],
        "times": "0.002 m^2",
        "shift": "0.25 rad",
        "interpolate": "cubic",
        "outside": "hold",
    }
    assert table(table_tree(made, "force"), "force", RULES) == made  # type: ignore[arg-type]
    assert (
        table(
            {k: v for k, v in TABLE.items() if k != "against"}, "force", ReadingRules(freedoms={"P": "turn"})
        ).against
        == "P"
    )


@pytest.mark.parametrize(
    ("keys", "wanted"),
    [
        ({"value": "80 N @ 30 deg"}, (80 * math.cos(math.pi / 6), 40)),
        ({"value": (3, -4)}, (3, -4)),
        ({"value": 5, "direction": 0.5}, (5 * math.cos(0.5), 5 * math.sin(0.5))),
        ({"value": 6, "direction": (1, -2, 2)}, (2, -4, 4)),
        ({"value": "unknown", "direction": (2, 3, 6)}, (2 / 7, 3 / 7, 6 / 7)),
        ({"value": (Expression("2*O", "N"), 3)}, (1.5, 3)),
    ],
)
def test_components_of_a_force(keys: dict[str, Any], wanted: tuple[float, ...]) -> None:
    load = ForceLoad(on="a", at="P", **keys)
    assert load.force({"O": 0.75}) == pytest.approx(wanted, rel=1e-14)
    assert load.unknown == (keys["value"] == "unknown")
    assert (load.components is None) == (not isinstance(keys["value"], tuple))
    assert len(load.varying) == (0 if load.unknown else len(load.components or (1,)))


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ({"value": (1, 2), "direction": 0.5}, "a vector needs no direction; leave the direction out"),
        ({"value": 3}, "a single value needs a direction; write direction: 30 deg, or value: [x, y]"),
        (
            {"value": "unknown"},
            "an unknown force needs a direction; write direction: 30 deg, or value: [x, y]",
        ),
        (
            {"value": "3 N @ 2", "direction": 0.5},
            "both a polar value and a direction are given; leave one of them out",
        ),
        (
            {"value": (1, 2), "by": "crank"},
            "a load is exerted by the ground or from outside, not by 'crank'; write by: ground",
        ),
    ],
)
def test_a_force_that_cannot_be(keys: dict[str, Any], says: str) -> None:
    assert says in refused(ForceLoad, on="a", at="P", **keys)
    assert ForceLoad(on="a", at="P", value=(1, 2), by="ground").by == "ground"
    assert Couple(on="a", value="2 N*m").varying == (2.0,)
