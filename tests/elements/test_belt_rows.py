"""The strands of a belt as constraints: length, force and drift against the geometry; where a kernel sees it slip."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.algebra import plane
from dalembert.core.elements import strand_rows
from dalembert.core.layout import Pose

RNG = np.random.default_rng(12)


def wheels(ri: float, rj: float) -> Any:
    """Strands between wheels on the first two of three links."""
    return SimpleNamespace(
        row=np.array([0]), i=np.array([0]), j=np.array([1]), ri=np.array([ri]), rj=np.array([rj]),
        ui=np.array([[0.1, -0.2]]), uj=np.array([[-0.3, 0.1]]),
    )  # fmt: skip


START = np.array([[0.2, 0.1], [2.5, -0.4], [0.0, 0.0]])
TWIST = np.concatenate([RNG.normal(size=(2, 3)), np.zeros((1, 3))])[None]


def at(t: float) -> Pose:
    """A pose along the twists."""
    turn = t * TWIST[0, :, 2]
    return Pose((START + t * TWIST[0, :, :2])[None], turn[None], plane.rotation(turn)[None])


def measure(f: Any, t: float) -> float:
    return float(strand_rows.sum_measure(plane, f, at(t))[0, 0])


@pytest.mark.parametrize(("ri", "rj"), [(0.4, 0.3), (0.4, -0.3), (-0.2, -0.5)])
def test_half_the_strands_of_a_belt_and_what_pulls_their_wheels_apart(ri: float, rj: float) -> None:
    """Between circles of centre distance D: sqrt(D^2 - (ri + rj)^2), and what the wheels take up of it as they move
    apart, so that D alone has a rate: the cosine of the strands' angle to the line of centres."""
    f = wheels(ri, rj)
    ends = [START[k] + u[0] for k, u in ((0, f.ui), (1, f.uj))]
    distance, total = math.dist(*ends), ri + rj
    free = math.sqrt(distance**2 - total**2)
    assert measure(f, 0.0) == pytest.approx(free + total * math.asin(total / distance))
    h = 1e-4
    rate = (measure(f, h) - measure(f, -h)) / (2 * h)
    on_i, on_j = np.zeros((2, 1, 1, 3))
    strand_rows.sum_wrench(plane, f, at(0.0), on_i, on_j)
    assert float(on_i[0, 0] @ TWIST[0, 0] + on_j[0, 0] @ TWIST[0, 1]) == pytest.approx(rate, rel=1e-6)
    force = on_j[0, 0, :2]
    assert math.hypot(*force) == pytest.approx(free / distance)
    assert force == pytest.approx(np.subtract(ends[1], ends[0]) * free / distance**2)
    assert on_i[0, 0, :2] == pytest.approx(-force)
    for couple, end, link in ((on_j[0, 0, 2], ends[1], 1), (-on_i[0, 0, 2], ends[0], 0)):
        arm = end - START[link]
        assert couple == pytest.approx(arm[0] * force[1] - arm[1] * force[0])
    second = (measure(f, h) - 2 * measure(f, 0.0) + measure(f, -h)) / h**2
    drift = float(strand_rows.sum_drift(plane, f, at(0.0), TWIST)[0, 0])
    assert drift == pytest.approx(second, rel=1e-5, abs=1e-5)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_a_kernel_sees_a_belt_slip_where_euler_and_eytelwein_do(sign: float) -> None:
    """Both strands have 700 N together; their pull without that of the belt's own mass reaches e^(mu beta) where the
    fan takes what is computed here. Either way round, a hundredth below and above."""
    m = da.belt_drive()
    speed = float(da.solve(m, positions=1).belt("belt").speed[0])
    own = 0.2 * speed**2
    wrap = math.pi - 2 * math.asin(0.12 / 0.5)
    ratio = math.exp(0.3 * wrap)
    most = 0.18 * (700.0 - 2 * own) * (ratio - 1) / (ratio + 1)
    k = da.compile(m, ["loads.work.value"], ["effort.A"])
    r = k(sign * most * np.array([[0.1], [0.99], [1.01], [3.0]]))
    assert r.status[:, 0].tolist() == ["ok", "ok", "slips", "slips"]
    assert r.redone == 2
    assert r.effort("A")[:2, 0] == pytest.approx(-sign * most * np.array([0.1, 0.99]) / 3.0)
