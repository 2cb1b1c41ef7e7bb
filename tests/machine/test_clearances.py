"""Clearances: a massless rod between two worn pins is a rod of another length; worst cases by turning the offsets."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da

CRANK, ROD, C = 0.05, 0.2, 2e-5
PRESS = """
gravity: none
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [50 mm, 0]}}
  rod: {points: {A: [0, 0], B: [200 mm, 0]}}
  piston: {points: {B: [0, 0]}}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod], clearance: 0.02 mm}
  B: {type: pin, links: [rod, piston], clearance: 0.02 mm}
  G: {type: slider, links: [ground, piston], at: [O, B]}
drives: {O: {position: {from: 10 deg, to: 170 deg, count: 9}}}
loads: {F: {type: force, on: piston, at: B, value: [-1 kN, 0]}}
assembly: {rod: -5 deg}
"""


def piston(q: Any, offset: Any = (0.0, 0.0), rod: float = ROD) -> Any:
    """Place of the piston with the rod's first pin off the crank's."""
    x, y = CRANK * np.cos(q) + offset[0], CRANK * np.sin(q) + offset[1]
    return x + np.sqrt(rod**2 - y**2)


@pytest.mark.parametrize("sense", [-1, 1])
def test_by_the_force_a_rod_is_longer_or_shorter_by_both_clearances(sense: int) -> None:
    """Pressed, the rod's centres come nearer to each other by c at each end; pulled, they part."""
    m = da.loads(PRESS).with_values({"loads.F.value.0": sense * 1000.0})
    r = da.statics(m)
    x = da.clearance_error(r, "piston", "B")
    q = r.drive_position("O")
    exact = piston(q, rod=ROD + sense * 2 * C) - piston(q)
    np.testing.assert_allclose(x.by_force[:, 0], exact, rtol=1e-3)
    np.testing.assert_allclose(x.by_force[:, 1], 0, atol=1e-12)
    np.testing.assert_array_equal(r["play.piston.B"], x.by_force)


def test_the_worst_case_is_that_of_all_directions() -> None:
    r = da.statics(da.loads(PRESS))
    q = r.drive_position("O")
    x = da.clearance_error(r, "piston", "B", {"A": C})
    around = np.radians(np.arange(0, 360, 0.5))
    errors = [piston(q, (C * np.cos(a), C * np.sin(a))) - piston(q) for a in around]
    np.testing.assert_allclose(x.worst[:, 0], np.max(np.abs(errors), axis=0), rtol=1e-3)
    both = da.clearance_error(r, "piston", "B")
    assert (np.abs(both.by_force) <= both.worst * (1 + 1e-9) + 1e-15).all()
    assert "piston.B in x" in both.text()


def test_without_force_a_journal_is_pressed_nowhere() -> None:
    r = da.statics(da.loads(PRESS).with_values({"loads.F.value.0": 0.0}))
    x = da.clearance_error(r, "piston", "B")
    assert np.isnan(x.by_force).all()
    assert np.isfinite(x.worst).all()
    for clearances, says in (
        ({"G": C}, "joint 'G' is not a pin"),
        ({"Z": C}, "unknown joint 'Z'"),
        ({}, "no pin has"),
    ):
        with pytest.raises(da.ModelError, match=says):
            da.clearance_error(r, "piston", "B", clearances)


@pytest.mark.long
def test_a_study_scatters_clearances_beside_lengths() -> None:
    """The spread of the piston's place at 90 deg: that of the rod's length and of both clearances, 2 c / cos(tilt)."""
    m = da.loads(PRESS).with_values({"drives.O.position": np.pi / 2})
    vary = {"links.rod.points.B.0": "normal 0.02 mm", "joints.A.clearance": "uniform ± 100 %"}
    s = da.study(
        m, vary, ["point.piston.B.x + play.piston.B.x"], designs=60, draw="sobol", seed=3, static=True
    )
    r = s.run()
    tilt = np.arcsin(CRANK / ROD)
    spread = np.hypot(2e-5, C / np.sqrt(3)) / np.cos(tilt)
    assert r.ok.all()
    assert r.values("point.piston.B.x + play.piston.B.x").std() == pytest.approx(spread, rel=0.1)


def test_contributions_at_every_position() -> None:
    """x = r cos q + sqrt(l^2 - r^2 sin^2 q): the derivatives by r and by l give the shares at each angle."""
    spreads = {"links.crank.points.A.0": "normal 0.01 mm", "links.rod.points.B.0": "normal 0.03 mm"}
    s = da.study(da.loads(PRESS), spreads, ["point.piston.B.x"], designs=100, static=True)
    found = s.contributions_along("point.piston.B.x", 512)
    q = np.radians(np.arange(10, 171, 20))
    root = np.sqrt(ROD**2 - (CRANK * np.sin(q)) ** 2)
    parts = np.array([(np.cos(q) - CRANK * np.sin(q) ** 2 / root) * 1e-5, ROD / root * 3e-5]) ** 2
    sigma = s.plan.spreads[0].sigma / 1e-5  # of a normal cut at three standard deviations
    np.testing.assert_allclose(found.sigma, np.sqrt(parts.sum(axis=0)) * sigma, rtol=0.02)
    np.testing.assert_allclose([*found.shares.values()], parts / parts.sum(axis=0), atol=0.02)
    np.testing.assert_allclose([*found.total.values()], parts / parts.sum(axis=0), atol=0.02)
    single = da.study(da.loads(PRESS), spreads, ["range(slide.G)"], designs=10, static=True)
    with pytest.raises(da.ModelError, match="is one number of the cycle"):
        single.contributions_along("range(slide.G)")
