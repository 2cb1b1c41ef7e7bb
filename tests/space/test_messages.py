"""What is said about descriptions in space that mean nothing, word for word."""

from __future__ import annotations

from collections.abc import Sequence
from copy import deepcopy
from typing import Any

import pytest

import dalembert as da
from tests.oracles.space.machines import EXAMPLES

FORCE = {"type": "force", "on": "rod", "at": "B", "value": 100}
NONE = "all its components are 0; write the direction it points in, for example [0, 0, 1]"

WRONG: list[tuple[str, Sequence[str], Any, str]] = [
    ("rssr", ["assembly", "rod", "axis"], [0, 0, 0], f"axis of rod of assembly: {NONE}"),
    ("rssr", ["drives", "O", "axis"], [0, 0, 1],
     "drive 'O' has an axis, but joint 'O', a revolute joint, defines its axis itself; leave it out"),
    ("rotor", ["drives", "A", "axis"], None,
     "drive 'A' turns joint 'A', a spherical joint, which can turn about any axis; "
     "write axis: [0, 0, 1], in the axes of ground"),
    ("rotor", ["drives", "A", "axis"], [0, 0, 0], f"axis of drive 'A': {NONE}"),
    ("rotor", ["drives", "A", "axis"], [0, 1],
     "axis of drive 'A': a vector has 2 components where 3 are needed; write [x, y, z]"),
    ("rsup", ["joints", "F", "axes", "i", "x"], [0, 0, 0], f"x of i of axes of joint 'F': {NONE}"),
    ("rsup", ["joints", "B", "axes", "i", "z"], [0, 0, 0], f"z of i of axes of joint 'B': {NONE}"),
    ("rsup", ["loads", "X"], {**FORCE, "direction": [0, 0, 0]}, f"direction of load 'X': {NONE}"),
    ("rsup", ["loads", "X"], {**FORCE, "direction": 30},
     "the direction of load 'X' is an angle, which is for the plane; write direction: [x, y, z]"),
    ("rsup", ["loads", "X"], {"type": "couple", "on": "rod", "value": 9, "direction": [0, 0, 0]},
     f"direction of load 'X': {NONE}"),
    ("rsup", ["loads", "X"], {"type": "couple", "on": "rod", "value": 9},
     "load 'X' needs a direction in space; write direction: [0, 0, 1], or value: [x, y, z]"),
    ("rsup", ["links", "rod", "inertia"], [[1, 2, 0], [2, 1, 0], [0, 0, 1]],
     "inertia of link 'rod': the matrix of inertia has the principal value -1 kg m2, and no body has a negative one; "
     "check the signs of the products of inertia"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("name", "path", "value", "says"), WRONG, ids=[f"{c[0]}-{c[1][-1]}-{k}" for k, c in enumerate(WRONG)]
)
def test_wrong_description_is_told_what_and_where(
    name: str, path: Sequence[str], value: Any, says: str
) -> None:
    tree = deepcopy(EXAMPLES[name].tree)
    part = tree
    for key in path[:-1]:
        part = part[key]
    if value is None:
        del part[path[-1]]
    else:
        part[path[-1]] = value
    with pytest.raises(da.ModelError) as caught:
        da.mechanism(tree)
    assert str(caught.value) == says
