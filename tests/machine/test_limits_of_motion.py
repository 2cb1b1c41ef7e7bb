"""Small parts of motions under forces at their limits: roots of events, sizes of states, elastic stops, near poses."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.motion import integration
from dalembert.machine.motion.coded.steps import state_sizes
from dalembert.machine.motion.corners.elastic_stops import stop_forces
from dalembert.machine.motion.equation import LastPose
from dalembert.machine.motion.many.course.guards import first_root
from dalembert.model.drives.end_stops import Stops
from tests.machine.test_stops import FLYWHEEL

UNKNOWN: Any = None


def test_a_root_is_on_the_far_side_or_where_it_begins() -> None:
    """Of curves that are 0 or less at the start it is the start; of one that is 0 at the end, the end."""
    curves = (
        lambda t: 2 - t * t,
        lambda t: -t,  # 0 at the start
        lambda t: -1 - t,
        lambda t: 3 - t,  # 0 at the end
        lambda t: 1e-9 - 1e-9 * t**3,
        lambda t: 1 - t**9,
        lambda t: 2 - math.exp(t),
    )
    roots = (math.sqrt(2), 0.0, 0.0, 3.0, 1.0, 1.0, math.log(2))

    def value(t: Any, k: Any) -> Any:
        return np.array([curves[n](x) for n, x in zip(k, t, strict=True)])

    every = np.arange(len(curves))
    low, high = np.zeros(len(curves)), np.full(len(curves), 3.0)
    found = first_root(value, low, high, np.zeros(len(curves)))
    assert found == pytest.approx(roots, rel=1e-14, abs=0)
    assert (value(found, every) <= 0).all()
    rough = first_root(value, low, high, np.full(len(curves), 0.2))
    assert (rough >= np.array(roots)).all()
    assert (rough - roots).max() <= 0.4
    assert (value(rough, every) <= 0).all()
    back = first_root(lambda t, k: value(-t, k), -low, -high, np.zeros(len(curves)))
    assert back == pytest.approx([-x for x in roots], rel=1e-14, abs=0)


def test_natural_sizes_are_those_of_the_fastest_freedom() -> None:
    """w = max(|u| / X, sqrt(|a| / X)); speeds X w, works m (X w)^2; 1/s where all rests, 1 J where nothing has mass."""
    length, mass = np.array([2.0, 1.0]), np.array([[0.5, 3.0]])
    for u, a, pace in (
        ([-6, 1], [0, -4], 3),
        ([0.25, -0.5], [0.125, 0], 0.5),
        ([6, 1], [0, 4], 3),
        ([-6, 1], [0, -16], 4),
        ([1, -5], [8, 16], 5),
        ([0, 0], [-18, 0], 3),
        ([0, 0], [0, 0], 1),
        ([0, 0], [math.inf, 0], 1),
    ):
        size, w = state_sizes(np.array([u], float), np.array([a], float), length, mass)
        assert w == pytest.approx([pace])
        work = max(0.5 * (2 * pace) ** 2, 3 * pace**2)
        assert size == pytest.approx(np.array([[2, 1, 2 * pace, pace, *[work] * 6]]))
        bare = state_sizes(np.array([u], float), np.array([a], float), length)[0]
        assert bare.tolist() == size[:, :4].tolist()
        weightless = state_sizes(np.array([u], float), np.array([a], float), length, 0 * mass)[0]
        assert weightless[0, 4:].tolist() == [1.0] * 6


@pytest.mark.parametrize(
    ("x", "rate", "force"),
    [
        (0.0, -6.0, 0.0),  # just touched: no depth, no force, however fast
        (1.0, 6.0, 0.0),
        (-0.1, 0.0, 1.0),
        (1.1, 0.0, -1.0),
        (-0.1, -2.0, 1.4),
        (1.1, 2.0, -1.4),
        (-0.1, 4.9, 0.02),
        (1.1, -4.9, -0.02),
        (-0.1, 5.1, 0.0),  # it leaves faster than the stop follows: nothing pulls
        (1.1, -5.1, 0.0),
        (0.5, 9.0, 0.0),
    ],
)
def test_an_elastic_stop_pushes_beyond_its_end_and_never_pulls(x: float, rate: float, force: float) -> None:
    stops = Stops(0.0, 1.0, stiffness=10.0, damping=0.2)
    assert stop_forces(stops, np.array([x]), np.array([rate])) == pytest.approx([force], abs=1e-12)


@pytest.mark.parametrize(("room", "ended"), [(0, False), (-1, True)])
def test_as_many_events_may_happen_as_there_is_room_for(
    room: int, ended: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    m = da.loads(FLYWHEEL)
    count = len(da.simulate(m, "3 s").events)
    monkeypatch.setattr(integration, "MOST_EVENTS", count + room)
    s = da.simulate(m, "3 s")
    assert ("events have happened; ask for a shorter time" in str([e.sentence for e in s.events])) is ended
    assert bool(s.time[-1] < 3) is ended


@pytest.mark.parametrize(
    ("q", "last", "anchor", "taken"),
    [
        (0.0, 1.0, -2.0, False),
        (0.0, -1.0, 2.0, False),
        (0.0, 2.0, -1.0, True),
        (0.0, -2.0, 1.0, True),
        (0.0, 1.0, -1.0, True),  # of two as near that of the step
        (3.0, 2.5, 3.6, False),
    ],
)
def test_a_state_begins_from_the_nearer_pose(q: float, last: float, anchor: float, taken: bool) -> None:
    """By the farthest of its drives, whichever way."""
    for other in (0.1, -0.1):
        known = LastPose("last", None, UNKNOWN, np.array([last, 0.0]), ("anchor", np.array([anchor, 0.0])))  # type: ignore[arg-type]
        known.start(np.array([q, other]))
        assert known.pose == ("anchor" if taken else "last")
        assert known.at.tolist() == [q, other]  # type: ignore[union-attr]
