"""The answer's own checks see what is wrong: one multiplier or effort made wrong, each rises by the known amount.

Residual, power balance, and the gaps of superposition and virtual work are else only asserted to be small, which a
check that always says 0 would be too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.friction.efficiency import load_rate
from dalembert.analysis.methods.applied_forces import state
from dalembert.bundled import examples
from dalembert.core.equilibrium import check_equilibrium, known_sources, statement
from dalembert.core.forcing import total_wrench
from dalembert.kernel import trace
from tests import random_space
from tests.random_mechanisms import random_case
from tests.tiers import over

BOTH = pytest.mark.parametrize("sign", [1.0, -1.0])
FORCE, LENGTH = 10.0, 2.0


def lever(space: bool) -> Any:
    """A bar of 2 m turned about one end, level, with 10 N down at the other, held by its drive; and again upright."""
    z = [0.0] if space else []
    pin = {"type": "revolute", "axis": [0, 0, 1]} if space else {"type": "pin"}
    return da.mechanism(
        {
            "gravity": "none",
            **({"space": "space"} if space else {}),
            "links": {
                "ground": {"points": {"O": [0, 0, *z]}},
                "bar": {"points": {"O": [0, 0, *z], "P": [LENGTH, 0, *z]}},
            },
            "joints": {"O": {**pin, "links": ["ground", "bar"]}},
            "drives": {"O": {"position": [0, 90], "speed": "1 rad/s"}},
            "loads": {"F": {"type": "force", "on": "bar", "at": "P", "value": [0, -FORCE, *z]}},
        }
    )


def multipliers(r: Any) -> tuple[np.ndarray, Callable[[int, float], Any]]:
    """Of constraints, efforts and loads (P, K); and the balance of the result with one of them made wrong."""
    c, at = r.compiled, state(r)
    w = total_wrench(c.layout, *known_sources(c.layout, c.forcing, at.pose, at.moving, r.inertia).values())
    s = statement(c.layout, c.known, at.pose, at.rows, at.solver, w)
    x = s.forces.forces(-s.w.reshape((len(r.status), -1)))

    def rechecked(k: int, amount: float) -> Any:
        wrong = x + amount * (np.arange(x.shape[-1]) == k)
        return check_equilibrium(c.layout, c.forcing, c.known, at.pose, at.moving, s, wrong, s.w)

    return x, rechecked


@BOTH
@pytest.mark.parametrize("space", [False, True], ids=["plane", "space"])
def test_a_wrong_reaction_or_effort_of_a_lever_shows_in_residual_and_power(space: bool, sign: float) -> None:
    r = da.statics(lever(space))
    effort = r.compiled.layout.constraints.count
    assert r.effort("O") == pytest.approx([FORCE * LENGTH, 0.0])
    rechecked = multipliers(r)[1]
    assert rechecked(0, 0.0).residual == pytest.approx(r.residual, abs=1e-15)
    largest = np.array([FORCE, FORCE])  # level: the moment over the length between the bar's points
    over = r.compiled.layout.length
    assert over == LENGTH
    force = rechecked(0, sign * 0.1)
    assert force.residual == pytest.approx(0.1 / largest)
    assert force.power_balance == pytest.approx([0, 0], abs=1e-15)  # reactions have no part in it
    couple = rechecked(effort, sign * 0.3)
    largest[0] += max(0.0, sign * 0.3) / over  # of it the effort itself is a part
    assert couple.residual == pytest.approx(0.3 / over / largest)
    power = np.array([FORCE * LENGTH + max(0.0, sign * 0.3), FORCE * over])
    assert couple.power_balance == pytest.approx(0.3 / power)


def plane_tree(seed: int) -> dict[str, Any]:
    return random_case(seed).tree


def space_tree(seed: int) -> dict[str, Any]:
    return random_space.tree(random_space.random_case(seed))


@over(2, 60)
@pytest.mark.parametrize("made", [plane_tree, space_tree], ids=["plane", "space"])
def test_each_wrong_multiplier_of_a_mechanism_is_left_over_in_the_residual(seed: int, made: Any) -> None:
    r = da.dynamics(da.mechanism(made(seed)))
    layout, at = r.compiled.layout, state(r)
    rows, (x, rechecked) = at.rows, multipliers(r)
    idle = set(layout.constraints.idle)
    on_links = (
        np.concatenate([rows.on_i * x[..., None], rows.on_j * x[..., None]], axis=1) * layout.wrench_scale
    )
    loads = known_sources(layout, r.compiled.forcing, at.pose, at.moving, True).values()
    known = total_wrench(layout, *loads) * layout.wrench_scale
    largest = np.maximum(np.abs(on_links).max(axis=(1, 2)), np.abs(known).max(axis=(1, 2)))
    for k in sorted(set(range(x.shape[1])) - idle):
        column = np.concatenate([rows.on_i[:, k], rows.on_j[:, k]], axis=1)
        moving = np.repeat([rows.i[k] < layout.links, rows.j[k] < layout.links], layout.algebra.n)
        left = np.abs(column * np.tile(layout.wrench_scale, 2))[:, moving].max(axis=1)
        for amount in (1e-3 * largest.max(), -1e-3 * largest.max()):
            found = rechecked(k, amount)
            assert found.residual * largest == pytest.approx(left * abs(amount), rel=0.01), (k, amount)
            driven = k >= layout.constraints.count
            assert (found.power_balance.max() > 1e-6) == driven


@BOTH
def test_the_gap_of_superposition_is_what_its_parts_lack(sign: float) -> None:
    parts = da.superposition(da.dynamics(da.load(examples()["four_bar"])))
    length = parts.result.compiled.layout.length
    kinds = {"force": 1.0, "moment": 1 / length, "efforts": 1 / length}
    largest = max(np.abs(getattr(parts, kind)).max() * scale for kind, scale in kinds.items())
    assert parts.gap.max() < 1e-12
    for kind, scale in kinds.items():
        array = getattr(parts, kind)
        for place in np.ndindex(array.shape):
            wrong = array.copy()
            wrong[place] += sign * 1e-6 * largest / scale
            assert replace(parts, **{kind: wrong}).gap == pytest.approx([1e-6], rel=1e-4), (kind, place)


@BOTH
def test_the_gap_of_virtual_work_is_what_its_effort_is_off(sign: float) -> None:
    found = da.virtual_work(da.statics(lever(False)))
    assert found.gap == pytest.approx([0, 0], abs=1e-15)
    off = replace(found, effort=found.effort + sign * 0.3)
    largest = np.array([FORCE * LENGTH + max(0.0, sign * 0.3), FORCE * LENGTH])
    assert off.gap == pytest.approx(0.3 / largest)


def test_where_nothing_acts_there_are_no_parts() -> None:
    found = da.superposition(da.statics(da.mechanism(lever(False).to_tree() | {"loads": {}})))
    assert found.sources == ()
    assert {len(a) for a in (found.force, found.moment, found.efforts, found.loads)} == {0}
    assert found.gap.tolist() == [0, 0]


def test_the_gap_of_virtual_work_is_what_its_unknown_load_is_off() -> None:
    tree = lever(False).to_tree()
    tree["drives"]["O"] |= {"effort": 5.0}
    tree["loads"]["F"] |= {"value": "unknown", "direction": 270.0}
    tree["drives"]["O"]["position"] = 0.0
    found = da.virtual_work(da.statics(da.mechanism(tree)))
    assert found.load[0] == pytest.approx([2.5])
    assert replace(found, load=found.load - 0.5).gap == pytest.approx([0.5 / 5.0])


@pytest.mark.parametrize("space", [False, True])
def test_the_rate_of_a_couple_is_the_turning_of_its_link(space: bool) -> None:
    tree = lever(space).to_tree()
    tree["drives"]["O"] |= {"position": [0, 90], "effort": 5.0}
    tree["loads"]["T"] = {"type": "couple", "on": "bar", "value": "unknown"}
    if space:
        tree["loads"]["T"]["direction"] = [0, 0, 1]
    r = da.statics(da.mechanism(tree))
    assert load_rate(r, "T") == pytest.approx([1, 1])
    assert r.unknown_load("T") == pytest.approx([FORCE * LENGTH - 5, -5])


@BOTH
def test_a_wrong_multiplier_shows_in_the_residual_of_the_kernel(
    monkeypatch: pytest.MonkeyPatch, sign: float
) -> None:
    balanced = trace._trace_equilibrium

    def wrong(p: Any, layout: Any, *rest: Any) -> Any:
        s, rub = balanced(p, layout, *rest)
        x = np.array(rub.x)
        x[layout.constraints.count] = x[layout.constraints.count] + sign * 0.3
        return s, replace(rub, x=x)

    asked: Any = {"outputs": ["residual", "effort.O"], "static": True}
    assert da.compile(lever(False), **asked)([]).value("residual")[0] == pytest.approx(0, abs=1e-15)
    monkeypatch.setattr(trace, "_trace_equilibrium", wrong)
    assert da.compile(lever(False), **asked)([]).value("residual")[0] == pytest.approx([0.3 / 20, 0.3 / 20])
