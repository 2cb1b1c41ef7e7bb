"""Reactions beyond statics by the stiffness of joints, against the elementary solutions for rigid bodies on springs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.model.description import mechanism


def table(stiffness: dict[str, Any], kind: str = "spherical") -> da.Mechanism:
    """A rigid plate on four legs, loaded off its middle."""
    feet = {"a": [0, 0, 0], "b": [2, 0, 0], "c": [2, 1, 0], "d": [0, 1, 0]}
    joints = {
        name: {"type": kind, "links": ["ground", "plate"], "stiffness": {"force": stiffness[name]}}
        for name in feet
    }
    return mechanism(
        {
            "space": "space",
            "links": {"ground": {"points": feet}, "plate": {"points": {**feet, "P": [1.4, 0.3, 0]}}},
            "joints": joints,
            "loads": {"F": {"type": "force", "on": "plate", "at": "P", "value": [0, 0, -100]}},
        }
    )


def test_a_table_on_four_legs() -> None:
    """Each leg carries its stiffness times its sinking: equilibrium and a rigid plate give the sinking."""
    k = {"a": 1e6, "b": 2e6, "c": 1.5e6, "d": 0.7e6}
    r = da.statics(table(k))
    at = np.array([[0, 0], [2, 0], [2, 1], [0, 1]], float)
    stiff = np.array(list(k.values()))
    shape = np.column_stack([np.ones(4), at])
    sinking = np.linalg.solve(shape.T @ (stiff[:, None] * shape), 100 * np.array([1, 1.4, 0.3]))
    expected = stiff * (shape @ sinking)
    assert r.status == ("ok",)
    assert [r.reaction(name)[0, 2] for name in k] == pytest.approx(expected, rel=1e-9)
    assert np.abs([r.reaction(name)[0, :2] for name in k]).max() < 1e-9
    assert "by the joints' stiffness" in r.assumptions["redundant reactions"]


def test_each_axis_has_its_own_stiffness() -> None:
    """Two guides side by side: a couple is shared by their turning stiffness, in the joint's axes."""
    joint = {"type": "prismatic", "links": ["ground", "bar"], "axis": [1, 0, 0]}
    tree = {
        "space": "space",
        "links": {
            "ground": {"points": {"a": [0, 0, 0], "b": [0, 0, 0]}},
            "bar": {"points": {"a": [0, 0, 0], "b": [0, 0, 0]}},
        },
        "joints": {
            "a": {**joint, "stiffness": {"force": 1e6, "moment": [1e3, 2e3, 3e3]}},
            "b": {**joint, "stiffness": {"force": 1e6, "moment": [3e3, 2e3, 1e3]}},
        },
        "drives": {"a": {"position": 0}},
        "loads": {"M": {"type": "couple", "on": "bar", "value": [40, 40, 40]}},
    }
    r = da.statics(mechanism(tree))
    axes = r.joint_axes("a")[0]
    shares = np.array([1 / 4, 1 / 2, 3 / 4])
    assert r.reaction_moment("a", axes="joint")[0] == pytest.approx(-shares * (axes @ np.full(3, 40.0)))


def test_what_is_left_rigid_stays_open() -> None:
    """Only legs a and b yield: c and d stay rigid, and the four are not unique."""
    tree = table(dict.fromkeys("abcd", 1e6)).to_tree()
    for name in "cd":
        del tree["joints"][name]["stiffness"]
    r = da.statics(mechanism(tree))
    assert r.status == ("redundant",)


def test_in_the_plane() -> None:
    """A beam on three supports of one stiffness, loaded in the middle: a third each."""
    tree = {
        "links": {
            "ground": {"points": {"a": [0, 0], "b": [1, 0], "c": [2, 0]}},
            "beam": {"points": {"a": [0, 0], "b": [1, 0], "c": [2, 0]}},
        },
        "joints": {
            name: {"type": "pin", "links": ["ground", "beam"], "stiffness": {"force": "1 kN/mm"}}
            for name in "abc"
        },
        "loads": {"F": {"type": "force", "on": "beam", "at": "b", "value": [0, -30]}},
    }
    r = da.statics(mechanism(tree))
    assert r.status == ("ok",)
    assert [r.reaction(name)[0, 1] for name in "abc"] == pytest.approx([10.0, 10.0, 10.0])


def test_a_determinate_mechanism_does_not_feel_it() -> None:
    m = da.four_bar()
    tree = m.to_tree()
    for joint in tree["joints"].values():
        joint["stiffness"] = {"force": "1 kN/mm"}
    with_, without = da.dynamics(mechanism(tree)), da.dynamics(m)
    assert with_.effort("O2") == pytest.approx(without.effort("O2"), rel=1e-12)
    assert "redundant reactions" not in with_.assumptions
