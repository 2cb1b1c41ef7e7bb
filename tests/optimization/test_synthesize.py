"""`da.synthesize`: a mechanism is found again from what it does, and misfits are least."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

import dalembert as da

MODEL = """dalembert: 1
gravity: none
links:
  ground: {points: {O2: [0, 0], O4: [0.3, 0.0]}}
  crank: {points: {O2: [0, 0], A: [0.1, 0]}}
  coupler: {points: {A: [0, 0], B: [0.28, 0], P: [0.14, 0.1]}}
  rocker: {points: {O4: [0, 0], B: [0.22, 0]}}
joints:
  O2: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, coupler]}
  B: {type: pin, links: [coupler, rocker]}
  O4: {type: pin, links: [ground, rocker]}
drives:
  O2: {position: {from: 0, to: 360 deg, count: 10}}
assembly: {coupler: 50 deg, rocker: 100 deg}
"""
VARY: dict[str, Any] = {
    "links.ground.points.O2": (-0.1, 0.1),
    "links.ground.points.O4": ("[0.15 m, -0.15 m]", "[0.45 m, 0.15 m]"),
    "links.crank.points.A.0": (0.05, 0.2),
    "links.coupler.points.B.0": (0.15, 0.45),
    "links.coupler.points.P": ("[0, 0]", "[0.3 m, 0.25 m]"),
    "links.rocker.points.B.0": (0.12, 0.4),
}


def made() -> da.Mechanism:
    """A four-bar in the bounds."""
    return da.loads(MODEL).with_values(
        {
            "links.ground.points.O2": (0.01, -0.02),
            "links.ground.points.O4": (0.33, 0.03),
            "links.crank.points.A.0": 0.09,
            "links.coupler.points.B.0": 0.3,
            "links.coupler.points.P": (0.17, 0.12),
            "links.rocker.points.B.0": 0.25,
        }
    )


def test_a_path_is_found_again() -> None:
    path = da.kinematics(made())["point.coupler.P"]
    found = da.synthesize(da.loads(MODEL), VARY, {"point.coupler.P": path}, starts=40)
    assert found.error < 1e-12
    assert found.exact > 10
    assert np.allclose(da.kinematics(found.mechanism)["point.coupler.P"], path, atol=1e-10)
    assert np.array_equal(
        da.synthesize(da.loads(MODEL), VARY, {"point.coupler.P": path}, starts=40).values, found.values
    )


@pytest.mark.long
def test_a_motion_at_other_positions() -> None:
    turned = np.radians([10.0, 60, 100, 170, 250])
    k = da.compile(made(), outputs=["point.coupler.P", "angle.coupler"])
    r = k(positions=turned)
    targets = {name: r.value(name)[0] for name in k.outputs}
    found = da.synthesize(da.loads(MODEL), VARY, targets, turned, starts=30)
    assert found.error < 1e-10
    assert all(np.allclose(found.found[name], targets[name], atol=1e-9) for name in targets)


def test_a_function_as_near_as_a_grid_of_designs() -> None:
    """Angles that no four-bar has: the least misfit of two numbers."""
    vary: Any = {"links.crank.points.A.0": (0.06, 0.12), "links.rocker.points.B.0": (0.18, 0.3)}
    m, turned = da.loads(MODEL), np.linspace(0.3, 2.5, 8)
    wanted = 1.6 + 0.2 * np.sin(turned) ** 3
    found = da.synthesize(m, vary, {"angle.rocker": wanted}, turned, starts=10)
    grid = np.array(np.meshgrid(*(np.linspace(*ends, 61) for ends in vary.values()))).reshape(2, -1).T
    off = da.compile(m, vary=list(vary), outputs=["angle.rocker"])(grid, turned).angle("rocker") - wanted
    best = float(np.sqrt(np.nanmin((off**2).mean(axis=1)))) / np.ptp(wanted)
    assert best * 0.9 <= found.error <= best * (1 + 1e-9)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"targets": {}}, "there are no targets"),
        ({"targets": {"point.coupler.P": [1.0]}}, "give 10 positions of 2 components"),
        ({"targets": {"angle.rocker": [np.nan] * 10}}, "not all finite"),
        ({"targets": {"angle.roker": [1.0] * 10}}, "did you mean 'angle.rocker'?"),
        ({"vary": {"links.crank.points.A.0": (0.1, 0.2, 0.01)}}, "takes no steps"),
        ({"vary": {"links.crank.points.A.0": (2.0, 2.1)}}, "has an answer at every position"),
    ],
)
def test_wrong_targets(changed: dict[str, Any], message: str) -> None:
    given: dict[str, Any] = {"vary": VARY, "targets": {"angle.rocker": np.ones(10)}, "starts": 2, **changed}
    with pytest.raises(da.ModelError, match=re.escape(message)):
        da.synthesize(da.loads(MODEL), **given)
