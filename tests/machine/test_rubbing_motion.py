"""Motions with dry friction in machine code: the same as those of the solution in numpy, and laws."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import simpson

import dalembert as da
from dalembert.arrays import Array
from dalembert.machine.motion import stepping
from dalembert.machine.motion.actuation import actuation
from dalembert.machine.motion.coded import traced_friction
from dalembert.machine.motion.coded.coded_motion import CodedState
from dalembert.machine.motion.coded.shared_motion import SharedMotion
from dalembert.machine.motion.integration import Integration
from dalembert.machine.motion.occurrences import Guard
from dalembert.machine.motion.simulation import motion_of
from tests.machine.rubbing_machines import machine
from tests.machine.test_motion_scale import moved
from tests.tiers import tiers

TIME = 1e-9
"""Largest difference between the times of an event."""


def in_numpy(m: da.Mechanism, until: str, monkeypatch: pytest.MonkeyPatch) -> da.Simulation:
    """The motion without machine code for its friction."""
    with monkeypatch.context() as patch:
        patch.setattr(CodedState, "machine", lambda state, t, y: None)
        return da.simulate(m, until, count=11)


@pytest.mark.parametrize("seed", tiers([3, 4], [0, 1, 2, 5, *range(8, 12)], [*range(12, 200)]))
def test_it_is_that_of_the_solution_in_numpy(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    m = da.mechanism(machine(seed))
    s, known = da.simulate(m, "0.4 s", count=11), in_numpy(m, "0.4 s", monkeypatch)
    assert s.status == known.status
    assert [(e.name, e.of) for e in s.events] == [(e.name, e.of) for e in known.events]
    assert max(s.energy_residual, s.law_residual) < 1e-9 or s.status == "stopped"
    if s.status == "stopped":  # where exactly the steps become too small is rounding
        assert s.ended.partition(":")[2] == known.ended.partition(":")[2]
        return
    assert [e.time for e in s.events] == pytest.approx([e.time for e in known.events], abs=TIME)
    for one, other in ((s.schedule, known.schedule), (s, known)):
        for name in ("position", "speed") if one is s.schedule else ("time", "applied"):
            assert getattr(one, name) == pytest.approx(getattr(other, name), rel=1e-7, abs=1e-8)
    assert s.schedule.parts is not None
    assert np.asarray(s.schedule.parts) == pytest.approx(known.schedule.parts, abs=1e-6, nan_ok=True)
    assert s.evaluations < known.evaluations


@pytest.mark.parametrize("seed", tiers([159], [45], [*range(200)]))
def test_none_of_200_ends_in_chatter(seed: int) -> None:
    """In 45, 153 and 159 a block at rest on one that moves has a speed that is rounding."""
    s = da.simulate(da.mechanism(machine(seed)), "0.3 s", count=7)
    assert s.status == "ended"
    assert len(s.events) < 30
    assert max(s.energy_residual, s.law_residual) < 1e-9


CART = """
gravity: standard
units: {length: m, force: N, mass: kg, angle: deg}
links:
  ground: {points: {O: [0, 0]}}
  cart: {points: {A: [0, 0]}, mass: 5}
  bob: {points: {A: [0, 0]}, mass: 2, center: [0.3, 0], inertia: 0.05}
joints:
  rail: {type: slider, links: [ground, cart], at: [O, A], direction: 0, friction: {coefficient: 0.1}}
  A: {type: pin, links: [cart, bob], friction: {coefficient: 0.1, radius: 20 mm}}
drives:
  rail: {position: 0, speed: 0.5 m/s}
  A: {effort: 1 N*m}
start: {A: {position: -80 deg, speed: 2 rad/s}}
"""


def test_the_work_of_a_prescribed_drive_is_that_of_its_effort(monkeypatch: pytest.MonkeyPatch) -> None:
    """A cart at a steady speed with a bob on it, in machine code and without."""
    m = da.loads(CART)
    s, known = da.simulate(m, "0.9 s", count=1801), in_numpy(m, "0.9 s", monkeypatch)
    power = {"rail": 0.5 * s["effort.rail"], "A": s.speed("A")}
    assert known.works["friction"][-1] < 0
    for name, works in known.works.items():
        assert s.works[name][-1] == pytest.approx(works[-1], rel=1e-9)
    for name, values in power.items():
        assert s.works[name][-1] == pytest.approx(simpson(values, x=s.time), rel=1e-4)
    assert s.energy_residual < 1e-9


@pytest.mark.long
def test_what_is_not_sure_in_machine_code_goes_to_the_solution_in_numpy(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Nothing is sure here: all is as without machine code, and no instant is without numbers."""
    m = da.mechanism(machine(18))
    monkeypatch.setattr(traced_friction, "_sure", lambda graph, flags: flags.slips[0].positive() * 0.25)
    s, known = da.simulate(m, "0.2 s", count=11), in_numpy(m, "0.2 s", monkeypatch)
    assert s.evaluations > 100
    assert [(e.name, e.time) for e in s.events] == [
        (e.name, pytest.approx(e.time, abs=TIME)) for e in known.events
    ]
    assert s.acceleration("O") == pytest.approx(known.acceleration("O"), rel=1e-7)
    assert max(s.energy_residual, s.law_residual) < 1e-9


def test_designs_share_one_equation() -> None:
    """Numbers of links, joints and loads are put into it; a start and a motor are beside it."""
    m = da.load(Path(__file__).parents[2] / "docs" / "press.yaml")
    vary = ("parameters.mu", "links.ram.mass", "drives.O.motor.stall", "start.O.speed")
    shared = SharedMotion(m, vary)
    for values in ([0.05, 80.0, 1200.0, 3.0], [0.12, 40.0, 1700.0, 0.0]):
        design = m.with_values(dict(zip(vary, values, strict=True)))
        one, other = motion_of(design, "0.6 s", count=7, shared=shared), da.simulate(design, "0.6 s", count=7)
        assert shared.equation_of(actuation(design)[0]) is not None
        assert [e.sentence for e in one.events] == [e.sentence for e in other.events]
        assert one.position("O") == pytest.approx(other.position("O"), rel=1e-9)
        assert one["reaction.A.magnitude"] == pytest.approx(other["reaction.A.magnitude"], rel=1e-7)
        assert one.law_residual < 1e-9


def test_a_design_of_another_branch_has_its_own_equation() -> None:
    """Which dead centre is passed is decided by lengths."""
    m = da.mechanism(machine(18))
    shared = SharedMotion(m, ("links.crank.points.A",))
    assert shared.equation_of(actuation(m)[0]) is not None
    shared._equation.kernel.__dict__["_deciding"] = np.array([0])
    assert shared.equation_of(actuation(m)[0]) is not None
    longer = m.with_values({"links.crank.points.A": (0.069, 0.0)})
    assert shared.equation_of(actuation(longer)[0]) is None


def sides(patch: pytest.MonkeyPatch) -> list[tuple[float, float]]:
    """Instants at which a contact will bear on another side, and its margins as parts of the largest."""
    out, happen = list[tuple[float, float]](), Integration._happen

    def noted(state: Integration, t: float, y: Array, crossed: list[Guard]) -> None:
        out.extend((t, g.value(t, y) / state.bearing) for g in crossed if g.kind == "side")
        happen(state, t, y, crossed)

    patch.setattr(Integration, "_happen", noted)
    return out


def test_a_step_ends_where_a_guide_bears_on_another_side(monkeypatch: pytest.MonkeyPatch) -> None:
    """There the motion has a corner, whose error no step size control sees surely: so its digits are those in any
    units."""
    found = sides(monkeypatch)
    scale = (1e-15, 1.0, 1e-6)
    one, other = moved("friction", (1.0, 1.0, 1.0)), moved("friction", scale)
    half = len(found) // 2
    assert half > len(one.events)
    assert np.abs([margin for _, margin in found]).max() < 1e-6
    assert [t * 1e6 for t, _ in found[half:]] == pytest.approx([t for t, _ in found[:half]], abs=1e-9)
    assert other.position("O") == pytest.approx(one.position("O"), abs=1e-10)


def test_sides_that_change_now_and_then_are_all_met(monkeypatch: pytest.MonkeyPatch) -> None:
    """They are given up only where one follows another at once."""
    found = sides(monkeypatch)
    moved("friction", (1.0, 1.0, 1.0))
    known = found.copy()
    found.clear()
    monkeypatch.setattr(stepping, "FLICKERS", 2)
    moved("friction", (1.0, 1.0, 1.0))
    assert len(known) > 1
    assert [t for t, _ in found] == [t for t, _ in known]


def test_sides_that_change_without_end_are_left_to_the_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    found, known = sides(monkeypatch), moved("friction", (1.0, 1.0, 1.0))
    assert found
    found.clear()
    monkeypatch.setattr(stepping, "FLICKERS", 0)
    s = moved("friction", (1.0, 1.0, 1.0))
    assert not found
    assert s.position("O") == pytest.approx(known.position("O"), abs=1e-6)
