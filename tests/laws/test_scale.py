"""A watch and a crane: with all lengths times a factor the freedoms, redundant joints and forces are the same."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da


def crank(size: float, drive: bool, twin: bool = False) -> Any:
    """A slider-crank of a size in m with a force on its block; a second guide like the first makes it redundant."""
    joints: dict[str, Any] = {
        "O": {"type": "pin", "links": ["ground", "crank"]},
        "A": {"type": "pin", "links": ["crank", "rod"]},
        "B": {"type": "pin", "links": ["rod", "block"]},
        "guide": {"type": "slider", "links": ["ground", "block"], "at": ["O", "B"]},
    }
    if twin:
        joints["twin"] = dict(joints["guide"])
    return da.mechanism(
        {
            "gravity": "none",
            "links": {
                "ground": {"points": {"O": [0, 0]}},
                "crank": {"points": {"O": [0, 0], "A": [size, 0]}},
                "rod": {"points": {"A": [0, 0], "B": [3 * size, 0]}},
                "block": {"points": {"B": [0, 0]}},
            },
            "joints": joints,
            "drives": {"O": {"position": 50}} if drive else {},
            "loads": {"F": {"type": "force", "on": "block", "at": "B", "value": [-10, -3]}} if drive else {},
            "assembly": {"crank": 50, "rod": -15},
        }
    )


@pytest.mark.parametrize("size", [1e-5, 1e-3, 1.0, 1e4])
def test_size_changes_no_freedom_and_no_force(size: float) -> None:
    unit, sized = (da.statics(crank(s, True)) for s in (1.0, size))
    assert sized.status == ("ok",)
    for joint in unit.joints:
        assert sized.reaction(joint) == pytest.approx(unit.reaction(joint), abs=1e-9)
    assert sized.effort("O") / size == pytest.approx(unit.effort("O"), rel=1e-9)
    with pytest.raises(
        da.ModelError, match=r"one of O \(turn\), A \(turn\), B \(turn\), guide \(slide\), or constrain"
    ):
        da.mobility(crank(size, False))
    found, double = da.mobility(crank(size, True, twin=True)), da.statics(crank(size, True, twin=True))
    assert found.redundant == 2
    assert set(found.redundant_joints) == {"guide", "twin"}
    assert double.status == ("redundant",)
    assert double.unique("B").all()
    assert not double.unique("guide")[0, 1]
    assert np.isfinite(double.least_norm("guide")).all()


def test_a_motion_that_nobody_waits_for_is_refused() -> None:
    tree = crank(1.0, True).to_tree()
    tree["drives"]["O"]["position"] = [0, 1e13]
    with pytest.raises(
        da.ModelError, match=r"drive 'O' goes from 0 deg to 1e\+13 deg between two positions; check the"
    ):
        da.statics(da.mechanism(tree))


def test_two_freedoms_without_drives_are_named_together() -> None:
    tree = crank(1.0, False).to_tree()
    del tree["joints"]["guide"]
    with pytest.raises(
        da.ModelError, match=r"has 3 degrees of freedom and no drive; add 3 drives at some of O \(turn\), A"
    ):
        da.statics(da.mechanism(tree))
