"""Free motion of two benchmarks with one freedom: the states at given times, to be prescribed in model files.

The torque that a motion needs is affine in its acceleration, T = I a + rest, so that without a torque a = -rest / I;
integrated by an eighth-order Runge-Kutta method.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from tests.oracles.jets import Jet
from tests.oracles.reading import Array
from tests.oracles.space import rods, spinning
from tests.oracles.space.moving import frame
from tests.oracles.space.statics import Answer, Body, Hinge

Solve = Callable[[Jet], Answer]


def states(torque: Callable[[Jet], Array], speed: float, times: Array) -> Array:
    """Position, speed and acceleration (T, 3) at the times, from position 0."""
    from scipy.integrate import solve_ivp

    def acceleration(x: float, v: float) -> float:
        t = torque(Jet(np.full(2, x), np.full(2, v), np.array([0.0, 1.0])))
        return float(-t[0] / (t[1] - t[0]))

    found = solve_ivp(
        lambda _, y: [y[1], acceleration(*y)], (0.0, times[-1]), [0.0, speed], "DOP853", times, rtol=1e-13, atol=1e-14
    )  # fmt: skip
    return np.array([[x, v, acceleration(x, v)] for x, v in found.y.T])


def swinging() -> Solve:
    """SP-01: a body on a revolute whose axis is inclined by 45 degrees, released from rest with its arm level."""
    axes = frame((0.0, 1.0, 1.0), (1.0, 0.0, 0.0))
    hinge = Hinge((1.0, 2.0, 3.0), axes, (0.0, 0.0, 0.0), axes)
    m = spinning.Chain({"body": hinge}, {"body": Body(1.0, (2.0, 0.0, 0.0), (0.04, 0.1, 0.1))})
    return lambda turn: spinning.chain(m, [turn])


def slider_crank() -> Solve:
    """SP-12: crank along z and slider along x at the start; rod with its axis along x of its own."""
    x, z = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
    crank_axes = frame(x, z)
    crank = Hinge((0.0, 0.1, 0.12), crank_axes, (0.0, 0.0, 0.0), crank_axes)
    slider = Hinge((0.0, 0.0, 0.0), np.eye(3), (0.0, 0.0, 0.0), np.eye(3))
    down = (0.0, 0.0, -9.81)
    bodies = {
        "crank": Body(0.12, (0.0, 0.0, 0.04), (1e-4, 0.0, 0.0), gravity=down),
        "rod": Body(0.5, (0.15, 0.0, 0.0), (4e-4, 4e-3, 4e-3), gravity=down),
        "follower": Body(2.0, gravity=down),
    }
    m = rods.RodMachine(
        crank, slider, True, (0.0, 0.0, 0.08), (0.0, 0.0, 0.0), (0.3, 0.0, 0.0), (0.0, 0.0, 0.0), bodies,
        np.array([0.0, 1.0, 0.0]), x,
    )  # fmt: skip
    return lambda turn: rods.solve(m, turn)


def moved(solve: Solve, drive: str, speed: float, times: Array) -> tuple[Array, Answer]:
    """The states at the times, and the answer there."""
    found = states(lambda turn: solve(turn).efforts[drive], speed, times)
    return found, solve(Jet(*found.T))
