"""Stops at their limits: the last of many bounces, none at all, no push, slow pushes, ends of a range met at once."""

from __future__ import annotations

import math

import numpy as np
import pytest

import dalembert as da

CART = """
gravity: none
links:
  ground: {points: {O: [0, 0]}}
  cart: {points: {F: [0, 0]}, mass: 2}
joints: {S: {type: slider, links: [ground, cart], at: [O, F], direction: 0}}
drives: {S: {effort: %r N, stops: {from: 0, to: 1, restitution: %r}}}
start: {S: {position: 0.5, speed: %r m/s}}
"""


@pytest.mark.parametrize("push", [-0.002, -1.0, 1.0, 3000.0])
def test_the_bounces_of_any_push_end_at_their_limit(push: float) -> None:
    """t0 (1 + e) / (1 - e), however slowly or fast the cart is pushed against its stop."""
    e, t0 = 0.3, math.sqrt(2 * 0.5 * 2 / abs(push))
    s = da.simulate(da.loads(CART % (push, e, 0.0)), f"{3 * t0!r} s", count=3)
    rest = s.event("S stays on its stop")
    assert [x.time for x in rest] == pytest.approx([t0 * (1 + e) / (1 - e)], rel=5e-11)
    assert s.position("S")[-1] == (1.0 if push > 0 else 0.0)
    assert sum(x.lost for x in s.event("impact")) == pytest.approx(abs(push) / 2, rel=1e-10)


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize(
    ("restitution", "impacts"),
    [(0.0, 1), (0.9e-6, 1), (1.1e-6, 2), (0.9e-3, 2), (1.1e-3, 3)],
)
def test_a_rebound_below_a_millionth_of_the_greatest_speed_is_none(
    restitution: float, impacts: int, sense: float
) -> None:
    """Without any force the cart goes to and fro: each way takes longer by 1 / e; then it rests where it struck."""
    s = da.simulate(da.loads(CART % (0.0, restitution, 2.0 * sense)), "1e7 s", count=3)
    hits = s.event("impact")
    speeds = 2 * restitution ** np.arange(impacts)
    assert [x.speed for x in hits] == pytest.approx(speeds.tolist(), rel=1e-9)
    times = np.cumsum([0.25, *(1 / speeds[1:])])
    assert [x.time for x in hits] == pytest.approx(times.tolist(), rel=1e-9)
    assert s.event("S stays on its stop")[0].time == hits[-1].time
    first, last = (1.0, 0.0) if sense > 0 else (0.0, 1.0)
    assert s.position("S")[-1] == (first if impacts % 2 else last)
    assert s.speed("S")[-1] == 0
    assert s.time[-1] == 1e7
