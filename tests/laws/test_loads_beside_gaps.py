"""Loads that depend on the pose where some positions do not close: those that do have the same answers without them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da

OPENS = {
    "links": {
        "ground": {"points": {"O": [0, 0], "C": [0.5, 0]}},
        "crank": {"points": {"O": [0, 0], "A": [0.3, 0]}},
        "rod": {"points": {"A": [0, 0], "B": [0.25, 0]}},
        "rocker": {"points": {"C": [0, 0], "B": [0.3, 0]}},
    },
    "joints": {
        "O": {"type": "pin", "links": ["ground", "crank"]},
        "A": {"type": "pin", "links": ["crank", "rod"]},
        "B": {"type": "pin", "links": ["rod", "rocker"]},
        "C": {"type": "pin", "links": ["ground", "rocker"]},
    },
    "assembly": {"rod": 20, "rocker": 100},
    "loads": {
        "T": {
            "type": "couple",
            "on": "rocker",
            "value": {
                "against": "links.rocker.angle",
                "x": ["-180 deg", "0 deg", "180 deg", "540 deg"],
                "y": [3.0, 7.0, 19.0, 23.0],
            },
        }
    },
}


@pytest.mark.parametrize("method", ["careful", None])
def test_loads_follow_a_link_before_a_gap_as_they_do_without_one(method: Any) -> None:
    more = {} if method is None else {"method": method}
    tree = OPENS | {"drives": {"O": {"position": [f"{a} deg" for a in (30, 50, 70, 150, 180)]}}}
    whole = da.statics(da.mechanism(tree), **more)
    closed = np.array([s != "not_assembled" for s in whole.status])
    assert closed.tolist() == [True, True, True, False, False]
    tree = OPENS | {"drives": {"O": {"position": [f"{a} deg" for a in (30, 50, 70)]}}}
    alone = da.statics(da.mechanism(tree), **more)
    assert whole.effort("O")[:3] == pytest.approx(alone.effort("O"), rel=1e-10)
    turned = np.degrees(alone.angle("rocker"))
    couple = np.interp(turned, [-180, 0, 180, 540], [3.0, 7.0, 19.0, 23.0])
    still = da.statics(
        da.mechanism(tree | {"loads": {"T": {"type": "couple", "on": "rocker", "value": 1.0}}}), **more
    )
    assert alone.effort("O") == pytest.approx(couple * still.effort("O"), rel=1e-9)
