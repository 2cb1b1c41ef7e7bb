"""Halves of a cycle, what they would change, motors at rest and shafts from their other end: twins and formulas."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.motors.motor_choice import MotorChoice
from dalembert.machine.motors.motor_use import motor_use
from dalembert.machine.whole_cycle import _beyond, halves, sampled, sampling
from dalembert.model.drives.motors import MotorCurve
from tests.machine.test_motors import ARM

UNKNOWN: Any = None


def result(count: int, closed: bool = True, timed: bool = False) -> Any:
    """Even positions of one drive over a turn, or over a part of one."""
    q = np.arange(count) * 2 * np.pi / count if closed else np.linspace(0, 1, count)
    schedule = SimpleNamespace(time=q if timed else None)
    return SimpleNamespace(
        status=("ok",) * count, schedule=schedule, drives=["O"], drive_position=lambda name: q
    )


@pytest.mark.parametrize(
    ("count", "closed", "timed", "expected"),
    [
        (5, True, False, []),
        (5, False, False, []),
        (6, True, False, [[0, 2, 4], [1, 3, 5]]),
        (6, False, False, [[0, 2, 4, 5], [0, 1, 3, 5]]),
        (6, True, True, [[0, 2, 4, 5], [0, 1, 3, 5]]),
        (7, True, False, []),
        (7, False, False, [[0, 2, 4, 6], [0, 1, 3, 5, 6]]),
        (7, True, True, [[0, 2, 4, 6], [0, 1, 3, 5, 6]]),
    ],
)
def test_halves_of_positions_keep_the_ends_of_a_range(
    count: int, closed: bool, timed: bool, expected: list[list[int]]
) -> None:
    assert [half.tolist() for half in halves(result(count, closed, timed))] == expected


@pytest.mark.parametrize(
    ("y", "closed", "beyond"),
    [
        ([0, 3, 4, 3, 0, 0], True, 0.0),  # the peak is where it is greatest
        ([0, 3, 4, 4, 3, 0], True, 1 / 8),  # half-way between two equal ones: 1^2 / (8 (8 - 3 - 4))
        ([4, 3, 0, 0, 0, 4], True, 1 / 8),  # round the end of a turn
        ([4, 3, 0, 0, 0, 4], False, 0.0),
        ([0, 0, 0, 0, 3, 4], False, 0.0),
        ([3, 4, 2, 0, 0, 0], True, 1 / 24),
        ([3, 4, 2, 0, 0, 0], False, 1 / 24),
        ([1, 1, 1, 1, 1, 1], True, 0.0),
    ],
)
def test_a_parabola_goes_beyond_its_greatest_value_by_its_formula(
    y: list[float], closed: bool, beyond: float
) -> None:
    assert _beyond(np.array(y, float), closed) == pytest.approx(beyond)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_what_halves_change_has_no_sign(sign: float) -> None:
    """The mean of 0 2 4 2 0 4 is 2, of every other 4 / 3 and 8 / 3; its greatest is not met by one half."""
    y = sign * np.array([0.0, 2, 4, 2, 0, 4])

    def of(at: Any) -> dict[str, float]:
        return {
            "mean": float(y[at].mean()),
            "peak": float(np.abs(y[at]).max()),
            "zero": float((y[at] - y[at]).sum()),
        }

    found = sampling(result(6), of, {})
    assert found == pytest.approx({"mean": (8 / 3 - 4 / 3) / 2 / 2, "peak": 0.0, "zero": 0.0})
    z = sign * np.array([0.0, 3, 4, 4, 3, 0])
    peaked = sampling(result(6), lambda at: {"greatest": float(np.abs(z[at]).max())}, {"greatest": z})
    assert peaked == pytest.approx({"greatest": 1 / 8 / 4})
    fewer = sampling(result(6), lambda at: {"count": sign * len(at)}, {})
    assert fewer == pytest.approx({"count": 0.5})
    none = sampling(result(5), lambda at: {"greatest": 3.0}, {"greatest": z})
    assert math.isnan(none["greatest"])


def test_a_sentence_on_positions_names_what_changes_most() -> None:
    r, known = result(6), {"mean": 0.01, "peak": 0.25, "other": math.nan}
    start = "Means and greatest values are those of the 6 positions, not of the motion between them"
    assert sampled(r, known) == f"{start}: with every other position they differ by 25 % at most (peak)."
    assert sampled(r, {"other": math.nan}) == f"{start}."
    assert sampled(result(1), known) == ""
    assert sampled(result(2), {}, "Sums").startswith("Sums are those of the 2 positions")


def test_what_a_motor_holds_at_rest_passes_its_gear_as_what_it_lifts() -> None:
    """T / (n eta) while it drives, however slowly, and eta T / n while it is driven."""
    speed, effort = np.array([1e-9, 0.0, -1e-9, -1e-9, 0.0, 1e-9]), np.array([8.0, 8, 8, -8, -8, -8])
    still = np.zeros(6)
    c = MotorChoice(UNKNOWN, "O", effort, speed, still, still + 1, still + 1, efficiency=0.5)
    assert c.torque(2.0) == pytest.approx([8, 8, 2, -8, -8, -2])
    assert c.least_rms() is None


@pytest.mark.parametrize(("part", "enough"), [(1 - 1e-9, False), (1.0, True), (1 + 1e-9, True)])
def test_a_motor_may_have_just_the_torque_that_is_needed(part: float, enough: bool) -> None:
    """6 N m at most, by its curve, and sqrt(20) rms, by its rating; bare, it has no inertia and loses nothing."""
    effort, one = np.array([2.0, -6.0, 2.0, -6.0]), np.ones(4)

    def need(torque: float = 6.0, rated: float | None = None) -> Any:
        curve = MotorCurve((0.0, 3.0), (torque, torque))
        return MotorChoice(UNKNOWN, "O", effort, one, one, one, one, curve=curve, rated=rated).need(1.0)

    assert need(6 * part).enough is enough
    assert need(rated=math.sqrt(20) * part).enough is enough
    assert need(6 * 0.9, math.sqrt(20) * 2).enough is False
    bare = MotorChoice(UNKNOWN, "O", effort, one, one, one, one)
    assert bare.torque(2.0).tolist() == [1.0, -3.0, 1.0, -3.0]
    assert (bare.need(2.0).enough, bare.least_rms()) == (None, None)


def test_a_motor_turns_as_fast_as_its_curve_goes() -> None:
    effort, speed, one = np.ones(3), np.array([1.5, -2.0, 0.0]), np.ones(3)
    c = MotorChoice(
        UNKNOWN, "O", effort, speed, one, one, one, curve=MotorCurve((0.0, 2.0, 4.0), (9.0, 7.0, 1.0))
    )
    assert c.allowed(1.0).tolist() == [7.5, 7.0, 9.0]
    assert c.allowed(2.0).tolist() == [4.0, 1.0, 9.0]
    assert np.isnan(c.allowed(2.0 + 1e-9)).tolist() == [False, True, False]


@pytest.mark.parametrize("speed", [1.0, -1.0, 2.0, 1e-9])
@pytest.mark.parametrize("effort", [3.0, -3.0])
def test_the_sense_of_a_gears_power_is_that_of_its_speed_and_at_rest_that_of_its_start(
    speed: float, effort: float
) -> None:
    motor = MotorCurve((0.0, 9.0), (8.0, 0.0), True, ratio=2.0, efficiency=0.5, inertia=0.25)
    for v, a in ((speed, speed), (speed, -speed), (0.0, speed)):
        use = motor_use(motor, *(np.array([x]) for x in (effort, v, a)))
        way = effort * (v or a) > 0
        shaft = effort / 2 * (2 if way else 0.5)
        assert use.gear_torque == pytest.approx([shaft])
        assert use.torque == pytest.approx([shaft + 0.25 * 2 * a])
        assert use.speed == pytest.approx([2 * v])
        assert use.loss == pytest.approx([shaft * 2 * v - effort * v])
        assert use.loss[0] >= 0
        assert use.power == pytest.approx(use.torque * 2 * v)


@pytest.mark.parametrize("static", [False, True])
def test_a_motor_that_turns_the_other_way_needs_as_much(static: bool) -> None:
    """With loads of the other sign all efforts are; rms and greatest values, and what halves change, are not."""
    way = {1.0: "to: 90 deg", -1.0: "to: -90 deg"}
    found = {}
    for sign, end in way.items():
        load = f"\nloads: {{F: {{type: couple, on: arm, value: '{-sign!r}*(2 + sin({sign!r}*O))'}}}}\n"
        text = "gravity: none" + ARM.replace("to: 90 deg", end) + load
        r = da.statics(da.loads(text)) if static else da.dynamics(da.loads(text))
        found[sign] = da.motor(r, inertia=1e-3, ratio=3.0, efficiency=0.8)
    there, back = found.values()
    assert back.effort == pytest.approx(-there.effort, rel=1e-9, abs=1e-12)
    assert back._summary() == pytest.approx(there._summary(), rel=1e-9)
    assert back.sampling() == pytest.approx(there.sampling(), rel=1e-6, abs=1e-12)
    assert there._summary()["greatest effort"] == pytest.approx(np.abs(there.effort).max())
    for name, need in there.needs.items():
        assert back.needs[name].torque == pytest.approx(need.torque, rel=1e-6)


SHAFT = """
gravity: standard
links:
  ground: {points: {A: [0, 0], B: [1, 0]}}
  one: {points: {A: [0, 0], M: [0.4, 0]}, members: [%s], mass: 3, center: [0.2, 0], mass_along: uniform,
        section: {circle: 40 mm, elasticity: 210 GPa}}
  two: {points: {M: [0, 0], B: [0.6, 0]}, members: [%s], mass: 2, center: [0.3, 0], mass_along: uniform,
        section: {circle: 30 mm, elasticity: 210 GPa}}
joints:
  A: {type: %s, links: [ground, one]}
  M: {type: weld, links: [one, two]}
  B: {type: %s, links: [ground, two]}
"""


@pytest.mark.parametrize("kinds", [("weld", "slot"), ("pin", "weld")])
def test_a_shaft_does_not_go_by_the_sense_in_which_its_pieces_are_written(kinds: tuple[str, str]) -> None:
    ways = (("[A, M]", "[M, B]", "one"), ("[M, A]", "[M, B]", "two"), ("[A, M]", "[B, M]", "one"))
    found = [da.critical_speeds(da.statics(da.loads(SHAFT % (*w[:2], *kinds))), w[2]) for w in ways]
    for c in found:
        assert c.speeds == pytest.approx(found[0].speeds, rel=1e-9)
        assert (c.dunkerley, c.rayleigh) == pytest.approx((found[0].dunkerley, found[0].rayleigh), rel=1e-9)
        assert sum(m.density * (m.end - m.start) for m in c.beam.spread) == pytest.approx(5.0)
        assert all(m.end > m.start for m in c.beam.spread)
        assert c.change >= 0
    low = found[0]
    to = low.scale("SI")
    assert low.record(to)["shaft"]["sag"] == pytest.approx(-low.sag.min())
    assert f"Largest sag under 5 kg across it: {-low.sag.min():.6g} m" in " ".join(low.text("SI").split())


@pytest.mark.parametrize("turn", [60, -60, 120, 180])
def test_what_is_welded_on_at_an_angle_is_carried_and_no_piece_of_the_shaft(turn: float) -> None:
    """An arm with a section of its own: the shaft is as stiff as without, and only its mass counts."""
    text = SHAFT % ("[A, M]", "[M, B]", "pin", "slot")
    arm = """  arm: {points: {M: [0, 0], E: [0.2, 0]}, mass: 1, inertia: 1e-3%s}
joints:
  E: {type: weld, links: [one, arm], at: M, angle: %r}
"""
    section = ", section: {circle: 40 mm, elasticity: 210 GPa}, mass_along: lumped"
    with_, without = (
        da.critical_speeds(da.statics(da.loads(text.replace("joints:\n", arm % (own, turn)))), "one")
        for own in (section if abs(turn) != 180 else "", "")
    )
    assert with_.speeds == pytest.approx(without.speeds, rel=1e-9)
    assert with_.masses.keys() == without.masses.keys() == {"arm"}
    assert with_.beam.length == pytest.approx(1.0)


def test_an_even_shaft_is_held_by_its_welds_at_either_end() -> None:
    """beta^2 sqrt(EI / (mu L^4)): beta L = 1.8751 clamped and free, 3.9266 clamped and pinned, 4.7300 clamped twice."""
    text = SHAFT.replace("circle: 30 mm", "circle: 40 mm").replace("mass: 2,", "mass: 4.5,")
    unit = math.sqrt(210e9 * math.pi / 64 * 0.04**4 / 7.5)
    for kinds, beta in (
        (("weld", "slot"), 3.926602312),
        (("pin", "weld"), 3.926602312),
        (("weld", "weld"), 4.730040745),
        (("pin", "slot"), math.pi),
    ):
        c = da.critical_speeds(da.statics(da.loads(text % ("[A, M]", "[M, B]", *kinds))), "one")
        assert c.speeds[0] == pytest.approx(beta**2 * unit, rel=1e-6)
    free = text.replace("  A: {type: %s, links: [ground, one]}\n", "")
    c = da.critical_speeds(da.statics(da.loads(free % ("[A, M]", "[M, B]", "weld"))), "one")
    assert c.speeds[0] == pytest.approx(1.875104069**2 * unit, rel=1e-6)
