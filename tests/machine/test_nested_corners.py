"""Corners within corners and jumps in long steps, against motions of constant pieces by hand."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.motion.many.course.course_steps import _unclear
from dalembert.machine.motion.occurrences import first_beyond

WHEEL = """
links: {ground: {points: {O: [0, 0]}}, wheel: {points: {O: [0, 0]}, mass: 1, inertia: 2}}
joints: {O: {type: pin, links: [ground, wheel]}}
drives: {O: {effort: EFFORT}}
LOADS
start: {O: {position: FROM rad, speed: SPEED rad/s}}
"""
END = 3.0


def wheel(law: str, start: tuple[float, float], effort: bool = False) -> da.Mechanism:
    """A wheel of 2 kg m2 under a couple, or an effort, by a law of its angle."""
    text = f"loads: {{T: {{type: couple, on: wheel, value: '{law}'}}}}"
    of, loads = (f"'{law}'", "") if effort else ("0", text)
    words = {"EFFORT": of, "LOADS": loads, "FROM": repr(start[0]), "SPEED": repr(start[1])}
    out = WHEEL
    for word, new in words.items():
        out = out.replace(word, new)
    return da.loads(out)


def by_hand(couple: Callable[[float], float], breaks: list[float], start: tuple[float, float]) -> list[float]:
    """Angle and speed at the end: constant acceleration from one break to the next."""
    t, (q, u) = 0.0, start
    while t < END - 1e-12:
        way = math.copysign(1.0, u)
        a = couple(q + 1e-9 * way) / 2
        times = [END - t]
        for x in breaks:
            roots = [(x - q) / u] if a == 0 else np.roots([a / 2, u, q - x])
            times += [float(np.real(w)) for w in roots if abs(np.imag(w)) < 1e-12 and np.real(w) > 1e-9]
        h = min(times)
        t, q, u = t + h, q + u * h + a * h * h / 2, u + a * h
    return [q, u]


def sign(x: float) -> float:
    return (x > 0) - (x < 0)


ALONG = [k * math.pi / 6 for k in range(-90, 91)]  # of sin, cos and sin(3 q)
LAWS: list[tuple[str, Callable[[float], float], list[float]]] = [
    ("-6*max(0, sign(-sin(O)))", lambda q: -6 * max(0, sign(-math.sin(q))), ALONG[::6]),
    ("6*max(sign(-O), 0)", lambda q: 6 * max(sign(-q), 0), [0.0]),
    ("6*min(0, sign(O))", lambda q: 6 * min(0, sign(q)), [0.0]),
    ("-6*abs(sign(O))", lambda q: -6 * abs(sign(q)), [0.0]),
    ("-6*max(0.5, sign(O))", lambda q: -6 * max(0.5, sign(q)), [0.0]),
    ("-6*sign(cos(O))", lambda q: -6 * sign(math.cos(q)), ALONG[3::6]),
    ("-6*max(0, sign(sin(3*O)))", lambda q: -6 * max(0, sign(math.sin(3 * q))), ALONG[::2]),
    ("-6*sign(sign(O) + 1)", lambda q: -6 * sign(sign(q) + 1), [0.0]),
    ("-6*max(sign(O - 1), sign(O - 2))", lambda q: -6 * max(sign(q - 1), sign(q - 2)), [1.0, 2.0]),
    (
        "-6*max(0, sign(O)*min(1, sign(O + 2)))",
        lambda q: -6 * max(0, sign(q) * min(1, sign(q + 2))),
        [0.0, -2.0],
    ),
]


@pytest.mark.parametrize("start", [(0.0, 2.0), (0.3, -2.0)])
@pytest.mark.parametrize(("law", "couple", "breaks"), LAWS)
def test_jumps_within_corners_are_met(
    law: str, couple: Callable[[float], float], breaks: list[float], start: tuple[float, float]
) -> None:
    """Also right at the start, several within one step, and by the compiled motion."""
    at_end = pytest.approx(by_hand(couple, breaks, start), abs=1e-8)
    m = wheel(law, start)
    s = da.simulate(m, f"{END} s", count=5)
    assert not s.doubt
    assert [s.position("O")[-1], s.speed("O")[-1]] == at_end
    many = da.compile_motion(m, f"{END} s", count=5)()
    assert many.ok[0]
    assert [many.position[0, 0], many.speed[0, 0]] == at_end


@pytest.mark.parametrize(("law", "couple", "breaks"), [LAWS[0], LAWS[3], LAWS[8]])
def test_efforts_jump_as_loads_do(law: str, couple: Any, breaks: list[float]) -> None:
    for start in ((0.0, -2.0), (0.3, 2.0)):
        s = da.simulate(wheel(law, start, effort=True), f"{END} s", count=5)
        assert not s.doubt
        at_end = by_hand(couple, breaks, start)
        assert [s.position("O")[-1], s.speed("O")[-1]] == pytest.approx(at_end, abs=1e-8)


def test_corners_within_corners_take_their_sides_together() -> None:
    """max(0, q sign(q)) is |q|: at 0 its inner jump and its own corner are one."""
    for start in ((0.3, -2.0), (0.0, 2.0)):
        ends = []
        for law in ("-3*max(0, O*sign(O))", "-3*abs(O)", "-3*abs(abs(O))"):
            m = wheel(law, start)
            s = da.simulate(m, f"{END} s", count=3)
            assert not s.doubt
            ends += [s.position("O")[-1], da.compile_motion(m, f"{END} s", count=3)().position[0, 0]]
        assert ends == pytest.approx([ends[0]] * 6, abs=1e-8)


@pytest.mark.parametrize("shift", [-1e-3, 1e-3])
def test_a_dip_between_instants_is_looked_for(shift: float) -> None:
    """A parabola that is just below zero, or just not, between the instants looked at; and fast waves."""
    for place in np.linspace(0.05, 0.95, 13):
        found, _ = first_beyond(lambda t, place=place: (t - place) ** 2 + shift**3, 0.0, 1.0)
        if shift < 0:
            assert abs(found - place) < 1e-4
        else:
            assert found == math.inf
    assert first_beyond(lambda t: 1.0 + shift + math.cos(300 * t), 0.0, 1.0)[0] == (
        pytest.approx(math.pi / 300, rel=0.2) if shift < 0 else math.inf
    )
    assert first_beyond(lambda t: -1.0, 2.0, 3.0)[0] > 2.0  # the start is known
    assert first_beyond(lambda t: 0.0, 2.0, 3.0) == (math.inf, True)


@pytest.mark.parametrize(
    ("values", "unclear"),
    [
        ([1, 0.8, 0.62, 0.4, 0.19, 0.01], False),
        ([1, 0.6, 0.24, -0.2, -0.62, -1], False),  # once, at the end
        ([1, 0.4, -0.1, -0.1, 0.4, 1], True),  # there and back
        ([-1, -0.6, -0.24, 0.2, 0.62, 1], True),  # below, and back
        ([1, 1, 1, 1, 1, 1], False),
        ([0, 0, 0, 0, 0, 0], False),
        ([0.36, 0.16, 0.0484, 0, 0.0441, 0.16], False),  # touches
        ([1, -1, 1, -1, 1, -1], True),  # does not follow
        ([0.0625, 0.0025, 0.0169, 0.1225, 0.3136, 0.5625], False),  # (x - 1/4)^2
        ([0.0605, 0.0005, 0.0149, 0.1205, 0.3116, 0.5605], True),  # 2 mm lower, between
    ],
)
def test_a_step_too_long_to_see_a_switch(values: list[float], unclear: bool) -> None:
    x = np.array([0.0, 0.2, 0.38, 0.6, 0.81, 1.0])[:, None]
    assert _unclear(x, np.array(values, float)[:, None]).item() is unclear


@pytest.mark.parametrize("until", ["0.02 s", "0.05 s"])
def test_turns_are_counted_in_steps_longer_than_a_turn(until: str) -> None:
    """A differential under a constant moment is integrated in few steps, which its wheels' turns are followed in."""
    s = da.simulate(
        da.bevel_differential(), until, start={"left": {"position": 0.0, "speed": "2 rad/s"}}, count=11
    )
    assert max(s.energy_residual, s.law_residual) < 1e-9
    assert s.position("left")[-1] > 0.9
    assert not s.doubt


def test_a_machine_at_a_place_where_it_has_no_inertia_is_refused() -> None:
    """A slider-crank whose only mass is its slider, at its dead centre and beside it."""
    text = """
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}}
  rod: {points: {A: [0, 0], B: [0.4, 0]}}
  ram: {points: {B: [0, 0]}, mass: 2}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, ram]}
  G: {type: slider, links: [ground, ram], at: [O, B]}
drives: {O: {effort: 0}}
start: {O: {position: AT deg, speed: 2 rad/s}}
"""
    for at in ("0", "180"):
        m = da.loads(text.replace("AT", at))
        with pytest.raises(da.ModelError, match="forces that move O move no mass in this position; give"):
            da.simulate(m, "0.05 s")
    s = da.simulate(da.loads(text.replace("AT", "1")), "0.05 s")
    assert not s.doubt
    crank = da.loads(text.replace("AT", "180").replace("A: [0.1, 0]}}", "A: [0.1, 0]}, inertia: 1e-9}", 1))
    assert da.simulate(crank, "1e-4 s").status == "ended"
