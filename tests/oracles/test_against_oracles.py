"""Every answer of the product against the oracles, to 1e-10 of the largest, over whole cycles."""

from __future__ import annotations

import numpy as np
import pytest

import dalembert as da
from tests.oracles import energy, hand, lagrange
from tests.oracles.agreement import disagreement, worst
from tests.oracles.catalogue import EXAMPLES, assembled
from tests.oracles.parts import couple, force, ground, link, pin, slider, tree

TOLERANCE = 1e-10


@pytest.mark.parametrize("name", EXAMPLES)
def test_dynamics_is_that_of_lagrange(name: str) -> None:
    example = assembled(EXAMPLES[name])
    closed = energy.solve(example.tree, example.kinematics)
    r = da.dynamics(da.mechanism(example.tree))
    assert r.status == ("ok",) * len(closed.q), r.problems()
    quantity, size = worst(disagreement(r, lagrange.solve(example.tree, closed.q)))
    assert size < TOLERANCE, quantity
    for drive, effort in closed.efforts.items():
        np.testing.assert_allclose(r.effort(drive), effort, rtol=0, atol=TOLERANCE * np.max(np.abs(effort)))


@pytest.mark.parametrize("name", EXAMPLES)
def test_statics_is_that_of_lagrange_without_inertia(name: str) -> None:
    example = assembled(EXAMPLES[name])
    closed = energy.solve(example.tree, example.kinematics)
    r = da.statics(da.mechanism(example.tree))
    quantity, size = worst(disagreement(r, lagrange.solve(example.tree, closed.q, inertia=False)))
    assert size < TOLERANCE, quantity


CRANK, COUPLER = hand.Body(1.2, 0.07, 0.3, 0.004), hand.Body(2.3, 0.2, -0.4, 0.03)
ROCKER = hand.Body(1.7, 0.11, 0.5, 0.02)


def body(b: hand.Body, **points: tuple[float, float]) -> dict[str, object]:
    return link(b.m, (b.r * np.cos(b.delta), b.r * np.sin(b.delta)), b.I, **points)


def test_four_bar_is_the_nine_equations_over_a_turn() -> None:
    abcd, count = (0.1, 0.35, 0.25, 0.4), 60
    links = {
        "ground": ground(O2=(0, 0), O4=(0.4, 0)),
        "crank": body(CRANK, O2=(0, 0), A=(0.1, 0)),
        "coupler": body(COUPLER, A=(0, 0), B=(0.35, 0)),
        "rocker": body(ROCKER, O4=(0, 0), B=(0.25, 0)),
    }
    joints = {
        "O2": pin("ground", "crank"), "A": pin("crank", "coupler"), "B": pin("coupler", "rocker"),
        "O4": pin("ground", "rocker"),
    }  # fmt: skip
    drive = {
        "position": {"from": 0, "to": 360, "count": count},
        "speed": "21 rad/s",
        "acceleration": "-90 rad/s^2",
    }
    loads = {"F": force("coupler", "center", [80.0, -140.0]), "T": couple("rocker", 13.0)}
    made = tree(links, joints, {"O2": drive}, loads, gravity="none")
    expected = [
        hand.four_bar(abcd, (CRANK, COUPLER, ROCKER), (80.0, -140.0), 13.0, t, 21.0, -90.0)
        for t in np.linspace(0, 2 * np.pi, count, endpoint=False)
    ]
    made["assembly"] = {"coupler": np.degrees(expected[0]["t3"]), "rocker": np.degrees(expected[0]["t4"])}
    r = da.dynamics(da.mechanism(made))
    found = {
        "t3": np.remainder(r.angle("coupler") + np.pi, 2 * np.pi) - np.pi, "t4": r.angle("rocker"),
        "w3": r.speed("coupler"), "w4": r.speed("rocker"), "al3": r.acceleration("coupler"),
        "al4": r.acceleration("rocker"), "T": r.effort("O2"),
    } | vectors(r, F12="O2", F23="A", F34="B", F14="O4")  # fmt: skip
    check(found, expected)


def test_slider_crank_is_the_hand_calculation_over_a_turn() -> None:
    count = 60
    links = {
        "ground": ground(O=(0, 0), S=(0, 0.02)),
        "crank": body(CRANK, O=(0, 0), A=(0.08, 0)),
        "rod": body(COUPLER, A=(0, 0), B=(0.26, 0)),
        "piston": link(1.4, (0, 0), 0.002, B=(0, 0)),
    }
    joints = {
        "O": pin("ground", "crank"), "A": pin("crank", "rod"), "B": pin("rod", "piston"),
        "S": slider("ground", "piston", 0.0, at=["S", "B"]),
    }  # fmt: skip
    drive = {
        "position": {"from": 0, "to": 360, "count": count},
        "speed": "50 rad/s",
        "acceleration": "200 rad/s^2",
    }
    made = tree(links, joints, {"O": drive}, {"gas": force("piston", "B", [-900.0, 0.0])}, gravity="none")
    made["assembly"] = {"rod": 4.0}
    r = da.dynamics(da.mechanism(made))
    expected = [
        hand.slider_crank(0.08, 0.26, 0.02, (CRANK, COUPLER), 1.4, -900.0, t, 50.0, 200.0)
        for t in np.linspace(0, 2 * np.pi, count, endpoint=False)
    ]
    found = {
        "t3": r.angle("rod"), "w3": r.speed("rod"), "al3": r.acceleration("rod"), "T": r.effort("O"),
        "x": r.point("piston", "B")[:, 0], "dx": r.point_velocity("piston", "B")[:, 0],
        "ddx": r.point_acceleration("piston", "B")[:, 0], "N": r.reaction("S")[:, 1],
    } | vectors(r, F12="O", F23="A", F34="B")  # fmt: skip
    check(found, expected)
    np.testing.assert_allclose(r.reaction_moment("S"), 0, atol=1e-9)


def vectors(r: da.Result, **joints: str) -> dict[str, np.ndarray]:
    return {
        f"{name}{c}": r.reaction(joint)[:, k] for name, joint in joints.items() for k, c in enumerate("xy")
    }


def check(found: dict[str, np.ndarray], expected: list[dict[str, float]]) -> None:
    for name, values in found.items():
        column = np.array([row[name] for row in expected])
        largest = np.max(np.abs(column))
        np.testing.assert_allclose(values, column, rtol=0, atol=TOLERANCE * largest, err_msg=name)
