"""A pin in a block that slides in a slot: its friction circle feels the whole force between pin and block."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import dalembert as da
from dalembert.analysis.friction.lines_of_action import slot_face
from tests.friction.oracle import branch, compared
from tests.friction.rough import rough_tree, unlawful
from tests.kernel.comparing import difference
from tests.oracles.reading import machine
from tests.random_mechanisms import pose_array, random_mechanism
from tests.tiers import over

CRANK, BAR, MASS, INERTIA, GRAVITY = 0.5, 2.0, 1.0, 0.3, 10.0


def bar(speed: float = 10.0, circle: str = "sin", **friction: float) -> Any:
    """A crank pulls a bar whose end is guided in a level slot, with damping and friction there."""
    return da.mechanism(
        {
            "links": {
                "ground": {"points": {"O": [0, 0], "S": [2, 0]}},
                "crank": {"points": {"O": [0, 0], "A": [CRANK, 0]}},
                "bar": {
                    "points": {"A": [0, 0], "B": [BAR, 0]},
                    "mass": MASS,
                    "center": [BAR / 2, 0],
                    "inertia": INERTIA,
                },
            },
            "joints": {
                "O": {"type": "pin", "links": ["ground", "crank"]},
                "A": {"type": "pin", "links": ["crank", "bar"]},
                "S": {
                    "type": "slot",
                    "links": ["ground", "bar"],
                    "at": ["S", "B"],
                    "damping": {"slide": 100, "turn": 0},
                    "friction": {"coefficient": 0.2, "radius": 0.05, "circle": circle} | friction,
                },
            },
            "drives": {"O": {"position": [50, 130, 250, 330], "speed": f"{speed} rad/s"}},
            "gravity": [0, -GRAVITY],
            "assembly": {"bar": -5},
        }
    )


def lever(mu: float, circle: str) -> float:
    return 0.05 * (math.sin(math.atan(mu)) if circle == "sin" else mu)


def by_hand(angle: float, speed: float, circle: str) -> tuple[float, float, float]:
    """Normal force, force along the slot and couple on the bar: moments about A, one equation in the normal force."""
    c, s = math.cos(angle), math.sin(angle)
    turned = math.asin(-CRANK * s / BAR)
    cb, sb = math.cos(turned), math.sin(turned)
    rate = -CRANK * c * speed / (BAR * cb)
    gain = (CRANK * s * speed**2 + BAR * sb * rate**2) / (BAR * cb)
    slip = -CRANK * s * speed - BAR * sb * rate
    ax = -CRANK * c * speed**2 - BAR / 2 * (cb * rate**2 + sb * gain)
    ay = -CRANK * s * speed**2 + BAR / 2 * (cb * gain - sb * rate**2)

    def forces(normal: float) -> tuple[float, float, float]:
        along = -math.copysign(0.2 * abs(normal), slip) - 100 * slip
        return normal, along, -math.copysign(lever(0.2, circle) * math.hypot(normal, along), rate)

    def moment(normal: float) -> float:
        _, along, couple = forces(normal)
        own = BAR / 2 * (cb * -MASS * (GRAVITY + ay) + sb * MASS * ax) - INERTIA * gain
        return BAR * (cb * normal - sb * along) + couple + own

    return forces(brentq(moment, -1e6, 1e6, xtol=1e-13, rtol=1e-14))


@pytest.mark.parametrize("circle", ["sin", "tan"])
@pytest.mark.parametrize("speed", [10.0, -10.0, 0.3])
def test_equations_written_by_hand(speed: float, circle: str) -> None:
    m = bar(speed, circle)
    r, k = da.dynamics(m), da.compile(m, outputs=["reaction.S", "effort.O", "reaction_moment.S"])()
    for n, angle in enumerate(r.drive_position("O")):
        normal, along, couple = by_hand(float(angle), speed, circle)
        assert r.reaction("S")[n] == pytest.approx([along, normal], rel=1e-9)
        assert r.friction_moment("S")[n] == pytest.approx(couple, rel=1e-9)
        assert k.reaction("S")[0, n] == pytest.approx([along, normal], rel=1e-9)
        table = da.fixed_point(r, n)
        assert table.arrived
        assert table.friction["S pin"][-1] == pytest.approx(couple, rel=1e-9)
    assert k.redone == 0


def test_the_line_of_action_touches_the_circle() -> None:
    r = da.dynamics(bar())
    circle = da.friction_circles(r, "S")
    to = circle.taken.point - circle.center
    arm = to[:, 0] * circle.taken.direction[:, 1] - to[:, 1] * circle.taken.direction[:, 0]
    assert np.abs(arm) == pytest.approx(lever(0.2, "sin"), rel=1e-12)
    assert circle.radius == pytest.approx(lever(0.2, "sin"))
    force = r.reaction("S")
    moment = to[:, 0] * force[:, 1] - to[:, 1] * force[:, 0]
    assert moment == pytest.approx(r.friction_moment("S"), rel=1e-12)


def test_the_normal_force_in_drawings_is_normal() -> None:
    """What damping adds lies along the slot, beside friction: the angle between normal force and reaction is phi."""
    face = slot_face(da.dynamics(bar()), "S")
    assert face.normal[:, 0] == pytest.approx(0, abs=1e-9)
    assert np.abs(face.friction[:, 0] / face.normal[:, 1]) == pytest.approx(0.2)


@pytest.mark.parametrize("circle", ["sin", "tan"])
def test_at_rest_with_the_coefficient_at_rest(circle: str) -> None:
    """At both ends slide and pin are at their limits, of the coefficient at rest."""
    r = da.statics(bar(0.0, circle, static=0.35))
    assert set(r.status) == {"at_rest"}
    for end in r.ends[0]:
        force = end.reaction("S")
        assert np.abs(force[:, 0] / force[:, 1]) == pytest.approx(0.35)
        assert np.abs(end.friction_moment("S")) == pytest.approx(
            lever(0.35, circle) * np.hypot(*force.T), rel=1e-9
        )


def damped(seed: int) -> tuple[int, dict[str, Any], Any]:
    """The next random mechanism, with damping and a friction circle in every slot, that friction does not stop."""
    for n in range(100 * seed, 100 * seed + 100):
        tree, rng = rough_tree(n, most=0.4, links=(2, 8)), np.random.default_rng(n)
        slots = [joint for joint in tree["joints"].values() if joint["type"] == "slot"]
        for joint in slots:
            joint["damping"] = {"slide": float(rng.uniform(1, 30))}
            joint["friction"] = {
                "radius": float(rng.uniform(0.01, 0.08)),
                "coefficient": float(rng.uniform(0.05, 0.4)),
            }
        r = da.dynamics(da.mechanism(tree)) if slots else None
        if r is not None and set(r.status) <= {"ok", "self_locking"}:
            return n, tree, r
    raise AssertionError("no such mechanism among a hundred")


@over(0, 60)
def test_the_law_and_the_oracle_on_random_mechanisms(seed: int) -> None:
    n, tree, r = damped(seed)
    assert np.max(unlawful(r)) < 1e-9
    found = branch(tree, pose_array(random_mechanism(n, (2, 8))))
    assert found.scale == 1
    assert compared(r, found, machine(tree)) < 1e-9
    k = da.compile(da.mechanism(tree))
    assert difference(k, k(), 0, r) < 1e-9
