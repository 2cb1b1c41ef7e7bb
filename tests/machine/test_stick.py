"""Contacts that stick and slip in machines of several freedoms: closed forms and an integration of its own."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import dalembert as da

G = 9.80665

ROTORS = """
links:
  ground: {points: {O: [0, 0]}}
  one: {points: {O: [0, 0]}, mass: 1 kg, inertia: 2 kg*m^2}
  two: {points: {O: [0, 0]}, mass: 1 kg, inertia: 3 kg*m^2}
  across: {points: {O: [0, 0]}}
  up: {points: {O: [0, 0]}}
joints:
  O: {type: pin, links: [ground, one]}
  C: {type: pin, links: [one, two], at: O, friction: {coefficient: 0.1, radius: 100 mm, circle: tan%s}}
  X: {type: slider, links: [ground, across], at: [O, O], direction: 0 deg}
  Y: {type: slider, links: [across, up], at: [O, O], direction: 90 deg}
  P: {type: pin, links: [up, two], at: O}
drives: {O: {effort: %s}, P: {effort: 0}}
start: {O: {position: 0, speed: %s rad/s}, P: {position: 0, speed: 0}}
loads: {press: {type: force, on: two, at: O, value: 6000 N, direction: -90 deg}}
"""


def rotors(effort: str, speed: float, static: str = "") -> Any:
    """Two rotors, 2 and 3 kg m2, with 60 N m of a loaded pin between them; their drives are angles from ground."""
    return da.loads(ROTORS % (static, effort, speed))


def test_a_loaded_pin_brings_two_rotors_to_one_speed() -> None:
    """Case MOT-8 with friction of a joint: 40 rad/s after 2 s, and 6000 J of heat."""
    s = da.simulate(rotors("0", 100), "3 s", count=31)
    (rest,) = s.events
    assert (rest.sentence, rest.of) == ("C sticks: its friction holds it", "C")
    assert rest.time == pytest.approx(2, rel=1e-9)
    assert s.speed("O")[-1] == pytest.approx(40, rel=1e-9)
    assert s.speed("P") - s.speed("O") == pytest.approx(50 * (s.time - 2).clip(max=0), abs=1e-9)
    assert -s.works["friction"][-1] == pytest.approx(6000, rel=1e-9)
    assert max(s.energy_residual, s.law_residual) < 1e-9


@pytest.mark.parametrize(("static", "limit"), [("", 60.0), (", static: 0.15", 90.0)])
def test_it_slips_again_where_the_coefficient_at_rest_is_passed(static: str, limit: float) -> None:
    """40 t N m on the first: both turn with 40 t / 5 until 3/5 of it is what the pin carries."""
    s = da.simulate(rotors("40*time", 0, static), "6 s", count=61)
    held, slips = s.events
    assert (held.sentence, held.time) == ("C sticks: its friction holds it", 0)
    when = limit * 5 / 3 / 40
    assert (slips.sentence, slips.time) == ("C slips again", pytest.approx(when, rel=1e-9))
    together = s.time < when - 1e-9
    assert s.acceleration("P")[together] == pytest.approx(8 * s.time[together], abs=1e-9)
    assert s.speed("O") - s.speed("P") == pytest.approx(
        np.where(
            together, 0.0, (20 * (s.time**2 - when**2) - 60 * (s.time - when)) / 2 - 20 * (s.time - when)
        ),
        abs=1e-8,
    )
    assert np.abs(s.result.friction_moment("C")[together]) == pytest.approx(24 * s.time[together], abs=1e-9)
    assert max(s.energy_residual, s.law_residual) < 1e-9


BLOCKS = """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  one: {points: {O: [0, 0]}, mass: 2 kg}
  two: {points: {O: [0, 0]}, mass: 1 kg}
joints:
  A: {type: slider, links: [ground, one], at: [O, O], direction: 0 deg, friction: {coefficient: 0.2}}
  B: {type: slider, links: [one, two], at: [O, O], direction: 0 deg, friction: {coefficient: 0.3}}
drives: {A: {effort: 10*time}, B: {effort: 0}}
start: {A: {position: 0 m, speed: 0}, B: {position: 0 m, speed: 0}}
"""


def test_a_block_is_carried_on_another_until_it_slips() -> None:
    """Both rest until the force is 0.2 (m + M) g; the upper one slips where the acceleration is 0.3 g."""
    s = da.simulate(da.loads(BLOCKS), "3 s", count=31)
    *_, first, then = s.events
    assert (first.sentence, first.time) == ("A slips again", pytest.approx(0.2 * 3 * G / 10, rel=1e-9))
    assert (then.sentence, then.time) == ("B slips again", pytest.approx(0.5 * 3 * G / 10, rel=1e-9))
    alone = s.time > then.time
    lower = np.where(alone, (10 * s.time - 0.2 * 3 * G - 0.3 * G) / 2, (10 * s.time - 0.2 * 3 * G) / 3)
    assert s.acceleration("A") == pytest.approx(lower.clip(min=0), abs=1e-9)
    assert s.acceleration("B") == pytest.approx(np.where(alone, 0.3 * G - lower, 0.0), abs=1e-9)
    assert max(s.energy_residual, s.law_residual) < 1e-9


PENDULUM = """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  one: {points: {O: [0, 0], A: [1, 0]}, mass: 2 kg, center: [0.5, 0], inertia: 0.2 kg*m^2}
  two: {points: {A: [0, 0]}, mass: 1 kg, center: [0.4, 0], inertia: 0.1 kg*m^2}
  across: {points: {O: [0, 0]}}
  up: {points: {O: [0, 0]}}
joints:
  O: {type: pin, links: [ground, one]}
  A: {type: pin, links: [one, two], friction: {coefficient: 1.5, radius: 80 mm, circle: tan}}
  X: {type: slider, links: [ground, across], at: [O, O], direction: 0 deg}
  Y: {type: slider, links: [across, up], at: [O, O], direction: 90 deg}
  P: {type: pin, links: [up, two], at: [O, A]}
drives: {O: {effort: 0}, P: {effort: 0}}
start: {O: {position: 0 deg, speed: 0}, P: {position: -150 deg, speed: 0}}
"""


def own_rates(t: float, y: np.ndarray, sense: float) -> tuple[np.ndarray, float, float]:
    """Accelerations, the couple in the pin A and its limit, by Newton and Euler of two bars; sense 0: they stick."""
    q, u = y[:2], y[2:]
    e = np.exp(1j * q)
    couple = limit = 0.0
    for _ in range(200):
        # unknown: accelerations a1, a2, force (x, y) of one on two at A, couple of one on two
        m = np.zeros((5, 5))
        right = np.zeros(5)
        arm = [1j * e[0], 1j * 0.4 * e[1]]  # of the centre of two with a1, a2
        fall = -(u[0] ** 2) * e[0] - u[1] ** 2 * 0.4 * e[1] + 1j * G
        m[0, :3] = arm[0].real, arm[1].real, -1
        m[1, [0, 1, 3]] = arm[0].imag, arm[1].imag, -1
        right[:2] = -fall.real, -fall.imag
        m[2, 1], m[2, 2], m[2, 3], m[2, 4] = (
            0.1,
            -0.4 * e[1].imag,
            0.4 * e[1].real,
            -1,
        )  # about the centre of two
        m[3, 0], m[3, 2], m[3, 3], m[3, 4] = 0.2 + 2 * 0.25, -e[0].imag, e[0].real, 1  # of one about O
        right[3] = -2 * G * 0.5 * e[0].real
        m[4] = [1, -1, 0, 0, 0] if sense == 0 else [0, 0, 0, 0, 1]
        right[4] = 0 if sense == 0 else couple
        x = np.linalg.solve(m, right)
        limit = 1.5 * 0.08 * math.hypot(x[2], x[3])
        if sense == 0 or abs(-sense * limit - couple) < 1e-15 * limit:
            return x[:2], float(x[4]), limit
        couple = -sense * limit
    raise AssertionError


def own_motion(end: float) -> tuple[np.ndarray, list[tuple[float, float]]]:
    """State at the end, and when which state of the pin began: 1 and -1 slip, 0 sticks."""
    t, y, sense, met = 0.0, np.array([0, -math.pi / 3, 0, 0]), 0.0, []
    _, couple, limit = own_rates(0, y, 0)
    sense = 0.0 if abs(couple) <= limit else -float(np.sign(couple))
    while t < end:

        def rate(t: float, y: np.ndarray, s: float = sense) -> np.ndarray:
            return np.concatenate([y[2:], own_rates(t, y, s)[0]])

        def over(t: float, y: np.ndarray, s: float = sense) -> float:
            if s:
                return float((y[3] - y[2]) * s) + 1e-14
            _, couple, limit = own_rates(t, y, 0)
            return limit - abs(couple)

        over.terminal, over.direction = True, -1  # type: ignore[attr-defined]
        f = solve_ivp(rate, (t, end), y, method="DOP853", rtol=1e-11, atol=1e-12, events=over)
        t, y = float(f.t[-1]), f.y[:, -1].copy()
        if f.status != 1:
            break
        _, couple, limit = own_rates(t, y, 0)
        y[3] = y[2] if sense else y[3]
        sense = -float(np.sign(couple)) if sense == 0 or abs(couple) > limit else 0.0
        met.append((t, sense))
    return y, met


def test_a_double_pendulum_sticks_and_slips_as_one_integrated_by_hand() -> None:
    s = da.simulate(da.loads(PENDULUM), "3 s", count=31)
    y, met = own_motion(3.0)
    assert {sense for _, sense in met} == {0.0, 1.0, -1.0}
    assert [e.time for e in s.events if e.of == "A"] == pytest.approx([t for t, _ in met], rel=1e-7)
    turned = s.position("O")[-1], s.position("P")[-1] + math.pi / 2
    assert turned == pytest.approx(y[:2], abs=1e-7)
    assert [s.speed(n)[-1] for n in ("O", "P")] == pytest.approx(y[2:], abs=1e-6)
    assert max(s.energy_residual, s.law_residual) < 1e-9


def test_friction_is_sought_near_the_last_and_on_the_path_where_that_is_not_the_solution(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Newton's steps count if they have arrived at a solution of a positive determinant."""
    from types import SimpleNamespace

    from dalembert.machine.motion.rest import dry_friction

    near, path = np.array([3.0]), np.array([5.0])
    monkeypatch.setattr(dry_friction, "solve_friction", lambda *_: SimpleNamespace(z=path[None]))
    nothing: Any = dry_friction.ContactResponse(*(np.zeros(1) for _ in dry_friction.ContactResponse._fields))
    for arrived, determinant, found in (
        *((True, 0.5, near), (True, 2.0, near)),
        *((True, 0.0, path), (True, -0.5, path), (False, 0.5, path), (False, -0.5, path)),
    ):
        solution = SimpleNamespace(arrived=[arrived], determinant=[determinant], z=near[None])
        monkeypatch.setattr(dry_friction, "newton", lambda *_, s=solution: s)
        contacts: Any = None
        dry = dry_friction.DryFriction(contacts, np.zeros(0, int), np.array([1.0]))
        z = dry._slip(nothing, np.ones(1), np.ones(1))
        assert z is not None
        assert z.tolist() == found.tolist()
        assert dry.last is z


PUSHED = """
gravity: [0, -1]
links:
  ground: {points: {O: [0, 0], R: [1, 0]}}
  crank: {points: {O: [0, 0], A: [0.05, 0]}, mass: 2, inertia: 0.01}
  rod: {points: {A: [0, 0], B: [0.2, 0]}, mass: 1, center: [0.1, 0], inertia: 0.004}
  ram: {points: {B: [0, 0]}, mass: 3}
  rotor: {points: {R: [0, 0]}, mass: 1, inertia: 0.1}
joints:
  O: {type: pin, links: [ground, crank], friction: {coefficient: 0.2, radius: 12 mm}}
  A: {type: pin, links: [crank, rod], friction: {coefficient: 0.2, radius: 10 mm}}
  B: {type: pin, links: [rod, ram], friction: {coefficient: 0.2, radius: 8 mm}}
  S: {type: slider, links: [ground, ram], at: [O, B], direction: 0 deg, friction: {coefficient: 0.15}}
  R: {type: pin, links: [ground, rotor], at: R}
loads: {work: {type: force, on: ram, at: B, value: 2 N, direction: 180 deg}}
drives: {O: {effort: -20*time}, R: {effort: 0}}
start: {O: {position: 60 deg, speed: 0}, R: {position: 0, speed: 5 rad/s}}
assembly: {rod: -12}
"""


@pytest.mark.long
def test_contacts_that_slip_together_hold_while_the_range_of_the_effort_says_so() -> None:
    """Beside a rotor that turns freely four contacts decide; without it a slider-crank has one freedom, and its effort
    at rest a range. One contact after the other passes from one limit to the other before all slip."""
    s = da.simulate(da.loads(PUSHED), "0.2 s", count=11)
    tree = da.loads(PUSHED).model_dump(mode="json")
    for part, name in (("links", "rotor"), ("joints", "R"), ("drives", "R"), ("start", "R")):
        del tree[part][name]
    alone = da.simulate(da.mechanism(tree), "0.2 s", count=11)
    rest, start = (next(e.time for e in alone.events if e.name == name) for name in ("rest", "start"))
    assert start - rest > 1e-3
    assert next(e.time for e in s.events if "sticks" in e.sentence) == pytest.approx(rest, rel=1e-9)
    slips = [(e.of, e.time) for e in s.events if "slips again" in e.sentence]
    assert [name for name, _ in slips[:4]] == ["O", "A", "B", "S"]
    assert [t for _, t in slips[:4]] == pytest.approx([start] * 4, rel=1e-7)
    assert s.position("O")[-1] == pytest.approx(alone.position("O")[-1], rel=1e-8)
    assert max(s.energy_residual, s.law_residual) < 1e-9
