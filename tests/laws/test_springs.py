"""Springs and dampers at length zero, in the plane, in space and in the kernel."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import known_actions

ZERO = "compressed to no length, it pushes in no direction, and just before and after in opposite ones"


def block(positions: Any, speed: float = 0.0, **more: Any) -> da.Mechanism:
    """A block on a line through the point Q that a spring and a damper hold it by; 100 N where they push."""
    return da.mechanism(
        {
            "dalembert": 1,
            "links": {
                "ground": {"points": {"O": [0, 0], "Q": [0, 0]}},
                "block": {"points": {"P": [0, 0]}, "mass": 1},
            },
            "joints": {"s": {"type": "slider", "links": ["ground", "block"], "at": ["O", "P"], **more}},
            "drives": {"s": {"position": positions, "speed": speed}},
            "loads": {
                "k": {
                    "type": "spring",
                    "between": ["ground.Q", "block.P"],
                    "stiffness": 100,
                    "free_length": 1,
                },
                "c": {"type": "damper", "between": ["ground.Q", "block.P"], "damping": 5},
            },
        }
    )


def test_a_preloaded_spring_of_length_zero_has_no_force() -> None:
    m = block([-0.001, 0, 0.001])
    for r in (da.statics(m), da.statics(da.lifted(m))):
        assert r.status == ("ok", "undefined_load", "ok")
        assert r.effort("s") == pytest.approx([99.9, np.nan, -99.9], nan_ok=True)
        assert np.isnan(r.force_array[1]).all()
        assert r.position("block")[:, 0] == pytest.approx([-0.001, 0, 0.001])
        assert r.speed("block")[1] == pytest.approx(0 * r.speed("block")[0])
        assert r.reasons[1] == (
            f"The ends of spring k (100 N) coincide at s = 0 m: {ZERO}. "
            "Step over this position, move an end off the other's path, or give no free_length."
        )


def constant(positions: Any, aside: float, **spring: Any) -> da.Mechanism:
    """The block with a constant force spring from a point beside its line."""
    tree = block(positions).with_values({"links.ground.points.Q": (0.0, aside)}).to_tree()
    pull = {"type": "constant_force_spring", "between": ["ground.Q", "block.P"], **spring}
    return da.mechanism(tree | {"loads": {"k": pull}})


@pytest.mark.parametrize("force", [50.0, -50.0])
def test_a_constant_force_spring_keeps_its_force(force: float) -> None:
    """At 0.5 m and at 1.24 m it pulls, or pushes, with the same force along its own line."""
    m = constant([-1.2, -0.4, 0.4, 1.2], 0.3, force=force)
    s = np.array([-1.2, -0.4, 0.4, 1.2])
    slope = s / np.hypot(s, 0.3)
    for r in (da.statics(m), da.statics(da.lifted(m))):
        assert r.effort("s") == pytest.approx(force * slope, rel=1e-12)
        (power,) = (
            a.force @ [1.0, *[0.0] * (a.force.shape[1] - 1)]
            for a in known_actions(r)
            if (a.of, a.kind, a.link) == ("k", "spring", "block")
        )
        assert power == pytest.approx(-force * slope, rel=1e-12)
    k = da.compile(m, ["loads.k.force"], derivatives=True)()
    assert k.effort("s")[0] == pytest.approx(force * slope, rel=1e-12)
    assert k.gradient("effort.s")[0, :, 0] == pytest.approx(slope, rel=1e-12)


@pytest.mark.parametrize(("force", "verb"), [(50.0, "pulls"), (-50.0, "pushes")])
def test_a_constant_force_spring_of_length_zero_has_no_direction(force: float, verb: str) -> None:
    m = constant([-0.001, 0, 0.001], 0.0, force=force)
    for r in (da.statics(m), da.statics(da.lifted(m))):
        assert r.status == ("ok", "undefined_load", "ok")
        assert r.effort("s") == pytest.approx([-force, np.nan, force], nan_ok=True)
        assert r.reasons[1] == (
            f"The ends of spring k (50 N) coincide at s = 0 m: of no length, it {verb} in no direction, and just "
            "before and after in opposite ones. Step over this position, or move an end off the other's path."
        )
    assert da.compile(m)().status.tolist() == [["ok", "undefined_load", "ok"]]


def test_the_kernel_leaves_a_spring_of_length_zero_out_of_no_reduction() -> None:
    m = block([-0.001, 0, 0.001])
    r = da.compile(m)()
    assert r.status.tolist() == [["ok", "undefined_load", "ok"]]
    assert r.effort("s")[0] == pytest.approx([99.9, np.nan, -99.9], nan_ok=True)
    for way in ("peak", "mean", "envelope"):
        reduced = da.compile(m, reduce=way)()
        assert reduced.status.tolist() == ["undefined_load"]
        assert np.isnan(reduced.effort("s")).all()


def test_friction_beside_a_spring_of_length_zero() -> None:
    moving = block([-0.2, 0, 0.2], 0.5, friction={"coefficient": 0.2}).with_values({"gravity": "standard"})
    for r in (da.dynamics(moving), da.dynamics(da.lifted(moving))):
        assert [r.status[k] for k in (0, 1)] == ["ok", "undefined_load"]
        assert r.effort("s") == pytest.approx(2.5 + 0.2 * 9.80665 + np.array([80, np.nan, -80]), nan_ok=True)
    still = da.statics(moving.with_values({"drives.s.speed": 0.0}))
    assert still.status == ("at_rest", "undefined_load", "at_rest")
    assert np.isnan(still.interval("s")[1]).all()


@pytest.mark.parametrize("free", [0.0, 1.0])
def test_a_damper_is_the_same_on_both_sides_of_length_zero(free: float) -> None:
    """Force c v at length zero too; a spring without force there adds none."""
    m = block([-0.001, 0, 0.001], 3.0).with_values({"loads.k.free_length": free})
    if free:
        m = m.with_values({"loads.k.stiffness": 0.0})
    spring = np.array([-0.1, 0, 0.1]) * (not free)
    for r in (da.statics(m), da.statics(da.lifted(m)), da.compile(m, ["loads.c.damping"])()):
        assert r.ok.all()
        assert r.effort("s").ravel() == pytest.approx(15 + spring, rel=1e-12)


def test_kernels_with_springs_of_length_zero_for_some_designs_only() -> None:
    k = da.compile(block([-0.001, 0, 0.001]), ["loads.k.free_length", "loads.c.damping"], derivatives=True)
    r = k([[0, 0], [1, 0]])
    assert r.status.tolist() == [["ok", "no_derivative", "ok"], ["ok", "undefined_load", "ok"]]
    assert r.effort("s")[0] == pytest.approx([-0.1, 0, 0.1])
    slope = [100, np.nan, -100]
    for design in r.gradient("effort.s")[..., 0]:
        assert design == pytest.approx(slope, nan_ok=True)


def test_an_equilibrium_is_not_sought_at_a_spring_of_length_zero() -> None:
    """A spring pushes a bar away from Q on both sides, so that the effort needed jumps from + to - there; the bar
    stands where 50 (l - 0.5) dl/dq + 10 cos q = 0 with l = 2 sin(q/2)."""
    tree: dict[str, Any] = {
        "dalembert": 1,
        "links": {
            "ground": {"points": {"O": [0, 0], "Q": [1, 0]}},
            "bar": {"points": {"O": [0, 0], "P": [1, 0]}, "mass": 1, "center": [1, 0]},
        },
        "joints": {"O": {"type": "pin", "links": ["ground", "bar"]}},
        "gravity": [0, -10],
        "drives": {"O": {"position": "unknown", "effort": 0, "range": [-180, 180]}},
        "loads": {
            "k": {"type": "spring", "between": ["ground.Q", "bar.P"], "stiffness": 50, "free_length": 0.5}
        },
    }
    r = da.statics(da.mechanism(tree))
    q = r.drive_position("O")
    length, rate = 2 * np.abs(np.sin(q / 2)), np.sign(q) * np.cos(q / 2)
    assert r.ok.all()
    assert (np.abs(q) > 0.1).all()
    assert 50 * (length - 0.5) * rate + 10 * np.cos(q) == pytest.approx(0 * q, abs=1e-9)
    assert len(q) == 3
