"""Engines by the general mechanism: closed forms, the books' harmonics, couples, firing orders; rotors."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from tests.machine.closed_forms import crank_points, shaking_of, turn


def test_a_radial_engine_of_three() -> None:
    """Rattan, chapter 14 (BAL-5): order 1 turns with the crank, order 2 against it."""
    r = da.dynamics(da.radial_engine(cylinders=3, crank=0.06, rod=0.24, piston_mass=1.0, speed=80 * math.pi))
    s, e = da.shaking(r), da.engine_series(r)
    book = da.harmonics(e.force, r.drive_position("O"), 4)
    exact = s.harmonics(4)
    assert abs(exact.forward[1]) == pytest.approx(5684.89213502747, rel=1e-8)
    assert abs(book.forward[1]) == pytest.approx(5684.89213502747, rel=1e-8)
    assert abs(exact.backward[2]) == pytest.approx(1444.1049651109442, rel=1e-8)
    assert abs(book.backward[2]) == pytest.approx(1421.2230337568676, rel=1e-8)
    assert np.hypot(*s.force.T).max() == pytest.approx(7105.692334336165, rel=1e-8)
    lines = [2 * math.pi * k / 3 for k in range(3)]
    expected = sum(
        shaking_of([(1.0, crank_points(turn(576), 0.06, 0.24, b)[1])], 80 * math.pi) for b in lines
    )
    assert s.force == pytest.approx(expected[::8], abs=1e-9 * 7105)


def test_a_v_twin_at_a_right_angle() -> None:
    """BAL-9: the crank balances all of order 1; order 2 is left along one line."""
    m = da.v_engine(crank=0.03, rod=0.03 / 0.28, piston_mass=0.5, speed=200 * math.pi)
    b = da.balance(m, ["crank"])
    assert b.placed["crank"].moment == pytest.approx(0.015, rel=1e-8)
    left = da.harmonics(b.after.force, b.result.drive_position("O"), 2)
    assert left.amplitude[1].max() < 1e-8
    assert left.amplitude[2] == pytest.approx([0, 2392.628862719443], rel=1e-8, abs=1e-8)
    book = da.harmonics(da.engine_series(b.after.result).force, b.result.drive_position("O"), 2)
    assert book.amplitude[2] == pytest.approx([0, 2344.8983710786633], rel=1e-8, abs=1e-8)


def order(m: Any, k: int, of: str = "force") -> float:
    return float(np.abs(da.shaking(da.dynamics(m)).harmonics([k], of).amplitude).max())


def test_what_engines_in_line_leave() -> None:
    four, six = da.in_line_engine(), da.in_line_engine(cylinders=6)
    single = da.in_line_engine(cylinders=1)
    assert order(four, 1) < 1e-8
    assert order(four, 2) == pytest.approx(4 * order(single, 2))
    assert order(four, 2, "couple") < 1e-8
    assert max(order(six, k) for k in (1, 2, 4)) < 1e-8
    assert max(order(six, k, "couple") for k in (1, 2)) < 1e-8
    assert order(six, 6) == pytest.approx(6 * order(single, 6), rel=1e-6)
    assert da.engine_series(da.dynamics(six)).loss == pytest.approx(1.0, abs=1e-6)  # all that is left
    three = da.in_line_engine(cylinders=3)
    assert order(three, 1) < 1e-8
    arm = abs(sum(z * np.exp(2j * math.pi * k / 3) for z, k in ((-0.09, 0), (0, 2), (0.09, 1))))
    r = da.dynamics(three)
    going = (0.45 + 0.2) * 0.045 * (100 * math.pi) ** 2
    along = da.shaking(r).harmonics([1], "couple").amplitude[0]
    assert along[1] == pytest.approx(going * arm + 0.4 * 0.045 * (100 * math.pi) ** 2 * arm, rel=1e-6)


def test_firing_orders_set_throws_and_gas() -> None:
    m = da.in_line_engine(firing_order=(1, 2, 4, 3), gas=1e4)
    points = m.points("crank")
    assert [points[f"A_{k}"][0] > 0 for k in (1, 2, 3, 4)] == [True, False, False, True]
    r = da.dynamics(m)
    torque = r.effort("O")
    assert np.allclose(torque, np.roll(torque, 36), rtol=1e-9, atol=1e-6)  # four times in two turns
    assert da.shaking(r).parts["external"][0].max() == 0
    with pytest.raises(ModelError, match=r"firing order \(1, 1, 2, 3\) of 4 cylinders"):
        da.in_line_engine(firing_order=(1, 1, 2, 3))
    with pytest.raises(ModelError, match="3 cylinders are not pairs"):
        da.v_engine(cylinders=3)


LOCOMOTIVE = """
units: {angle: deg}
links:
  ground: {points: {O: [0, 0]}}
  axle: {points: {O: [0, 0], A: [0.3, 0], B: [0, 0.3]}}
  left: {points: {S: [0, 0]}, mass: %.17g, place: 0.35}
  right: {points: {S: [0, 0]}, mass: %.17g, place: -0.35}
joints:
  O: {type: pin, links: [ground, axle]}
  slot_left: {type: slot, links: [left, axle], at: [S, A], direction: 90}
  slot_right: {type: slot, links: [right, axle], at: [S, B], direction: 90}
  guide_left: {type: slider, links: [ground, left], at: [O, S], direction: 0}
  guide_right: {type: slider, links: [ground, right], at: [O, S], direction: 0}
drives:
  O: {position: {from: 0, to: 360, count: 72}, speed: %.17g rad/s}
"""


def test_an_inside_cylinder_locomotive() -> None:
    """Sarkar 12.7 (BAL-3): what a part c of the reciprocating masses leaves, cranks at a right angle, 0.7 m apart."""
    speed = 25 / 0.85
    part = 40e3 / (69.625 * speed**2)
    assert part == pytest.approx(0.664129263913824, rel=1e-8)
    mass = 300 * (1 - part)
    s = da.shaking(da.dynamics(da.loads(LOCOMOTIVE % (mass, mass, speed))))
    assert np.abs(s.force[:, 0]).max() == pytest.approx(36980.41999650296, rel=1e-8)
    assert s.couple is not None
    assert np.abs(s.couple[:, 1]).max() == pytest.approx(12943.146998776036, rel=1e-8)


def test_a_four_crank_engine() -> None:
    """Sarkar 12.4 (BAL-4), its last step: the resultant couple of the reciprocating masses."""
    arm = 1.2727922061357857
    text = LOCOMOTIVE.replace("0.3, 0]", "0.45, 0]").replace("[0, 0.3]", "[-0.45, 0]")
    text = text.replace("place: 0.35", f"place: {arm / 2}").replace("place: -0.35", f"place: {-arm / 2}")
    s = da.shaking(da.dynamics(da.loads(text % (900, 900, 3 * math.pi))))
    assert s.couple is not None
    assert np.abs(s.couple[:, 1]).max() == pytest.approx(45788.32831383069, rel=1e-8)


def test_the_unbalanced_force_across_a_stroke() -> None:
    """GATE 2014 (BA-07), through the shaking force of the bundled case."""
    from dalembert.bundled import cases

    s = da.shaking(da.dynamics(da.load(cases()["ba-07-partly-balanced-slider-crank"])))
    assert abs(s.force[0, 1]) == pytest.approx(30, rel=1e-8)


def test_the_text_has_both_series() -> None:
    said = str(da.shaking(da.dynamics(da.in_line_engine())))
    assert "4 cylinders, by the book's two harmonics: its force is off by 4.61 %" in said.replace("\n", " ")


def test_a_place_belongs_to_the_plane() -> None:
    with pytest.raises(ModelError, match="a place along the normal is for mechanisms of the plane"):
        da.loads("space: space\nlinks: {ground: {}, a: {place: 1}}")


def test_a_rotor_in_two_planes_leaves_its_bearings_alone() -> None:
    m = da.rotating_shaft().with_values({"gravity": None})
    fast = da.dynamics(m)
    found = da.balance_rotor(m, (0.05, 0.45), (0.04, 0.06))
    after = da.dynamics(found.mechanism)
    bearings = [j for j, joint in m.joints.items() if "ground" in joint.links]
    size = max(float(np.abs(fast.reaction(j)).max()) for j in bearings)
    assert size > 1
    assert max(float(np.abs(after.reaction(j)).max()) for j in bearings) < 1e-9 * size
    assert np.abs(after.effort(after.drives[0])).max() < 1e-9 * size
    with pytest.raises(ModelError, match="give two planes"):
        da.balance_rotor(m, (0.1, 0.1), (0.04, 0.06))
    with pytest.raises(ModelError, match=r"use da\.balance"):
        da.balance_rotor(da.four_bar(), (0.1, 0.2), (0.04, 0.06))
