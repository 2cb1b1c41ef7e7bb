"""Positions where contacts of a moving machine reverse: the numbers just before and just after them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.cli import main
from tests.friction import four_stroke
from tests.friction.four_stroke import FILE
from tests.friction.rough import rough_tree
from tests.tiers import over

ASIDE = 1e-3


def by_hand(theta: float) -> list[four_stroke.Found]:
    """Just before and just after a crank angle."""
    return [four_stroke.forces(theta, four_stroke.senses(theta + side)) for side in (-ASIDE, ASIDE)]


def off(r: Any, k: int, found: four_stroke.Found) -> float:
    """Largest difference of a result at a position from the hand equations."""
    largest = max(np.linalg.norm(f) for f in found.force.values())
    apart = [np.max(np.abs(r.reaction(j)[k] - f)) for j, f in found.force.items()]
    return float(max(*apart, abs(r.effort("O")[k] - found.torque) / four_stroke.R) / largest)


def test_the_hand_equations_hold_where_nothing_reverses() -> None:
    r = da.dynamics(four_stroke.engine())
    for k in (3, 11, 30, 50, 140):
        theta = float(r.drive_position("O")[k])
        assert off(r, k, four_stroke.forces(theta, four_stroke.senses(theta))) < 1e-9


def test_both_sides_of_the_dead_centres_by_hand() -> None:
    """The guide reverses where the rod stands upright, B where the crank lies."""
    r = da.dynamics(four_stroke.engine(), strict=True)
    places = np.flatnonzero(r.reverses)
    assert places.tolist() == [0, 18, 36, 54, 72, 90, 108, 126]
    assert r.ok.all()
    for k in places:
        before, after = by_hand(float(r.drive_position("O")[k]))
        assert off(r, k, before) < 1e-9
        assert off(r.before, k, before) < 1e-9
        assert off(r.after, k, after) < 1e-9
        assert off(r.after, k, before) > 1e-6


def test_the_largest_values_take_reversals_in(capsys: pytest.CaptureFixture[str]) -> None:
    m = four_stroke.engine()
    r = da.dynamics(m)
    peak = max(np.linalg.norm(found.force["B"]) for found in by_hand(np.pi / 2))
    assert peak == pytest.approx(41859.3, abs=0.05)
    assert r.worst("reaction", "B") == (pytest.approx(peak, rel=1e-9), 0)
    assert main(["solve", str(FILE)]) == 0
    said = capsys.readouterr().out
    (line,) = [line for line in said.splitlines() if line.startswith("|F| B")]
    assert line.split() == ["|F|", "B", "N", "41859.3", "90", "deg", "*", "199.2", "525", "deg"]
    assert "* one side of a reversal" in said
    assert "at rest" not in said


# limits, on random mechanisms

TINY = 1e-6


def moved(tree: Any, times: Any) -> Any:
    """The mechanism at times of its motion at constant accelerations; time 0 first, which sets the phase of wheels."""
    out = {**tree, "drives": {}}
    t = np.array([0.0, *times])
    for name, drive in tree["drives"].items():
        turns = isinstance(drive["speed"], str)
        v, a = (float(str(drive[key]).split()[0]) for key in ("speed", "acceleration"))
        way = v * t + a * t * t / 2
        position = drive["position"][0] + (np.degrees(way) if turns else way)
        rate = [f"{x!r} rad/s" if turns else float(x) for x in (v + a * t).tolist()]
        out["drives"][name] = {**drive, "position": position.tolist(), "speed": rate}
    return da.mechanism(out)


def crossing(tree: Any, span: float = 0.4, count: int = 25) -> float | None:
    """A time at which the rate of some contact passes through zero, to the last digit."""
    times = np.linspace(-span, span, count)
    r = da.statics(moved(tree, times))
    if r.friction is None:
        return None
    rate = r.friction.rate[1:]
    known = np.isfinite(r.force_array).all(axis=(1, 2))[1:]
    turns = (rate[1:] * rate[:-1] < 0) & (known[1:] & known[:-1])[:, None] & ~r.compiled.contacts.fixed
    if not turns.any():
        return None
    k, e = (int(n) for n in np.argwhere(turns)[0])
    (a, b), (f, g) = times[k : k + 2], rate[k : k + 2, e]
    for _ in range(8):
        if f == g or abs(b - a) < 1e-15:
            break
        a, b, f = b, b - g * (b - a) / (g - f), g
        if not abs(b) < span:
            return None
        g = da.statics(moved(tree, [b])).friction.rate[1, e]
    return float(b)


def reversing(seed: int, most: float = 0.3) -> tuple[Any, float]:
    """The first of the random mechanisms of a seed in which some contact reverses, with numbers on a side, and when."""
    for other in range(seed, seed + 100_000, 1000):
        tree = rough_tree(other, most, (2, 8))
        time = crossing(tree)
        if time is None:
            continue
        r = da.dynamics(moved(tree, [time]))
        if r.reverses[1] and any(np.isfinite(side.force_array[1]).all() for side in r.sides):
            return tree, time
    raise AssertionError("none of a hundred mechanisms reverses")


@over(2, 200)
def test_both_sides_are_the_limits_of_the_positions_around(seed: int) -> None:
    """Extrapolated from two positions near by; these have one number each, however small a rate is there."""
    tree, time = reversing(seed)
    beside = [time + side * step for side in (-1, 1) for step in (TINY, 2 * TINY)]
    r = da.dynamics(moved(tree, [time, *beside]))
    assert r.reverses.tolist() == [False, True, False, False, False, False]
    assert r.ok[1] == (r.status[1] == "reversal")
    worse = {"jammed", "self_locking"} & set(r.status[2:])
    assert r.status[1] == "reversal" or r.status[1] in worse
    largest = np.nanmax(np.abs(r.force_array[1:])) * max(1.0, r.compiled.layout.length)
    for side, (near, far) in ((r.before, (2, 3)), (r.after, (4, 5))):
        for values in (side.force_array, side.moment_array, side.effort_array, side.friction.moment):
            limit = 2 * values[near] - values[far]
            assert np.array_equal(np.isnan(values[1]), np.isnan(limit))
            assert np.nan_to_num(np.abs(values[1] - limit)).max(initial=0.0) < 1e-7 * largest
        assert not max(side.residual[1], side.power_balance[1]) > 1e-9
