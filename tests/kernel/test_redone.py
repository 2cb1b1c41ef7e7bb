"""What the general executor answers for a kernel, with derivatives by one step of the compiled equations from there."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.batch_result import NUMBERED
from dalembert.analysis.batch.careful_path import quantity
from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.batch.over_positions import PARTS
from tests.friction.engines import engine, pushed_slider
from tests.friction.rough import cycle, rough_tree
from tests.kernel.comparing import every_number, frictional, general
from tests.kernel.machines import KINDS, ROUGH, four_bar, four_bar_tree
from tests.kernel.test_derivatives import WEIGHTS
from tests.random_mechanisms import random_case, tree
from tests.tiers import tiers


def both(
    m: Any, monkeypatch: pytest.MonkeyPatch, reduce: str | None = None, vary: Sequence[str] = ()
) -> None:
    """The program's own derivatives, exact by the complex step, and those from the general executor's solutions."""
    outputs = [f"effort.{next(iter(m.drives))}", f"reaction.{next(iter(m.joints))}.magnitude"]
    k = da.compile(m, vary=vary or every_number(m), outputs=outputs, derivatives=True, reduce=reduce)
    own = k(redo=False)
    monkeypatch.setattr(Kernel, "may_change_branch", lambda self, values: np.ones(len(values), bool))
    other = k()
    assert other.redone == 1
    size = max(np.nanmax(np.abs(own.value(o)), initial=0.0) for o in outputs)
    for output in outputs:
        a, b = own.gradient(output)[0], other.gradient(output)[0]
        sure = np.isfinite(own.value(output)[0]) if reduce is None else np.ones(a.shape[:-1], bool)
        assert (np.isfinite(b) == np.isfinite(a))[sure].all()
        for n, name in enumerate(k.numbers):
            told = sure & np.isfinite(a[..., n])  # a magnitude of 0 has no slope
            off = np.abs(a[..., n] - b[..., n])[told].max(initial=0.0)
            rounding = 1e-12 * size / max(abs(k.nominal[n]), 2e-2)
            assert off <= 1e-8 * np.abs(a[..., n][told]).max(initial=0.0) + rounding, name


@pytest.mark.parametrize(
    "kind", tiers(["slots", "two drives", "no closed form"], ["pin-pin-pin", "law of a cylinder"])
)
def test_slopes_from_a_solution_are_those_of_the_program(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    both(KINDS[kind](), monkeypatch)


@pytest.mark.parametrize("name", tiers(["slider_crank"], ["whitworth", "stephenson_2"]))
def test_slopes_with_friction(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    both(ROUGH[name](), monkeypatch)


@pytest.mark.parametrize("reduce", [r for r in PARTS if r != "argpeak"])
def test_slopes_of_reductions(reduce: str, monkeypatch: pytest.MonkeyPatch) -> None:
    both(four_bar(24), monkeypatch, reduce)


def test_a_number_without_a_slope_leaves_the_others_theirs(monkeypatch: pytest.MonkeyPatch) -> None:
    """At rest without gravity and loads: a force of size 0 has no slope by gravity, the effort has one."""
    made = four_bar_tree(3) | {"gravity": [0, 0], "loads": {}}
    del made["drives"]["O2"]["speed"], made["drives"]["O2"]["acceleration"]
    both(da.mechanism(made), monkeypatch)


@pytest.mark.parametrize("seed", tiers([300], [11, 42], range(50, 65)))
def test_slopes_of_random_mechanisms(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Wheels among them, whose phases follow from the first position."""
    both(da.mechanism(tree(random_case(seed).drawing)), monkeypatch)


def slopes_are_the_executor_s(m: Any, vary: list[str], output: str, at: np.ndarray, sizes: Any) -> int:
    """Every number has a slope, and it is the general executor's difference of sixth order, at the best of several
    steps; how many positions were the general executor's."""
    k = da.compile(m, vary=vary, outputs=[output], derivatives=True, static=not m.has_speeds)
    undecided = k([at], redo=False).code[0] == 2
    r = k([at])
    here = undecided & np.isin(r.code[0], NUMBERED)
    assert np.isfinite(r.gradient(output)[0][here]).all()
    assert np.isnan(r.gradient(output)[0][undecided & ~here]).all()
    for n, name in enumerate(k.numbers):
        exact = r.gradient(output)[0][here].reshape(here.sum(), -1, len(at))[..., n]
        off = []
        for size in sizes:
            h = size * max(abs(at[n]), 2e-2)
            steps = [at + s * j * h * (np.arange(len(at)) == n) for j in WEIGHTS for s in (1, -1)]
            q = [quantity(general(m, k, step), output)[here] for step in steps]
            slope = sum(w * (q[2 * i] - q[2 * i + 1]) for i, w in enumerate(WEIGHTS.values())) / h
            off.append(np.abs(slope - exact).max(axis=1) - 1e-12 * np.abs(q).max() / h)
        assert np.nanmin(off, axis=0).max() <= 1e-7 * np.abs(exact).max(), name
    return int(here.sum())


@pytest.mark.parametrize(
    ("name", "mu", "count"),
    [("toggle_press", 1.5, 10), pytest.param("scotch_yoke", 0.9, 20, marks=pytest.mark.long)],
)
def test_strong_friction(name: str, mu: float, count: int) -> None:
    """Where the kernel does not show that there is one solution only; where it jams there is no derivative."""
    m = cycle(name, 24).with_values({"friction.coefficient": mu})
    vary = frictional(m)[1:2]
    at = da.compile(m, vary=vary).nominal
    assert slopes_are_the_executor_s(m, vary, "effort.O2", at, (1e-3,)) == count


@pytest.mark.long
def test_a_parallelogram_s_neighbours() -> None:
    """Every design of other geometry goes to the general executor."""
    m = da.four_bar(ground=0.3, crank=0.1, coupler=0.3, rocker=0.1, sweep=(0.3, 3.6), positions=6)
    vary = ["links.ground.points.O4.0", "links.rocker.mass"]
    at = da.compile(m, vary=vary).nominal * [1.001, 1.0]
    assert slopes_are_the_executor_s(m, vary, "reaction.B", at, (1e-4,)) >= 5


@pytest.mark.long
def test_beside_a_dead_centre() -> None:
    """A tenth of a degree beside it, where the closed form is left."""
    m = da.four_bar(ground=0.3, crank=0.1, coupler=0.25, rocker=0.1500002, positions=24)
    vary = ["links.coupler.points.B.0", "links.ground.points.O4.0"]
    at = da.compile(m, vary=vary).nominal
    assert slopes_are_the_executor_s(m, vary, "effort.O2", at, (1e-8, 1e-9)) == 1


@pytest.mark.long
@pytest.mark.parametrize("seed", tiers([12], [14]))
def test_random_mechanisms_with_strong_friction(seed: int) -> None:
    m = da.mechanism(rough_tree(seed))
    vary = frictional(m)[:2]
    slopes_are_the_executor_s(
        m, vary, f"effort.{next(iter(m.drives))}", da.compile(m, vary=vary).nominal, (1e-3, 1e-5)
    )


@pytest.mark.long
def test_a_peak_over_positions_of_both() -> None:
    """A design with some positions in doubt is reduced as a whole, its slopes too."""
    m = cycle("toggle_press", 24).with_values({"friction.coefficient": 1.5})
    vary = frictional(m)[:1]
    k, squares, whole = (
        da.compile(m, vary=vary, outputs=["effort.O2"], reduce=reduce, derivatives=True)
        for reduce in ("peak", "squares", None)
    )
    r, w = k(), whole()
    value, rate = w.effort("O2")[0], w.gradient("effort.O2")[0]
    place = np.abs(value).argmax()
    assert r.redone == w.redone == 1
    assert np.allclose(r.gradient("effort.O2")[0], np.sign(value[place]) * rate[place], rtol=1e-9)
    s, off = squares(target=value + 1 + np.sin(value)), -1 - np.sin(value)
    assert s.redone == 1
    assert np.allclose(s.effort("O2")[0], (off**2).sum(), rtol=1e-9)
    assert np.allclose(s.gradient("effort.O2")[0], 2 * off @ rate, rtol=1e-9)


def test_contacts_that_the_file_s_numbers_do_not_have(monkeypatch: pytest.MonkeyPatch) -> None:
    """Faces without height have no couple: another design has one contact more, or one less."""
    tree = cycle("slider_crank", 12).to_tree()
    tree["joints"]["guide"]["friction"]["half_height"] = 0
    m = da.mechanism(tree)
    k = da.compile(m, vary=frictional(m), outputs=["effort.O2"], derivatives=True)
    values = np.stack([k.nominal, k.nominal + 0.004])
    own = k(values)
    monkeypatch.setattr(Kernel, "may_change_branch", lambda self, values: np.ones(len(values), bool))
    other = k(values)
    assert (own.redone, other.redone) == (0, 2)
    assert np.allclose(own.gradient("effort.O2"), other.gradient("effort.O2"), rtol=1e-9, atol=1e-9)


def test_slopes_of_both_sides_of_a_reversal() -> None:
    """At dead centres, and of a peak that stands at one."""
    m = engine(position=[0, 180])
    k = da.compile(m, vary=["friction.coefficient"], outputs=["effort.O"], static=True, derivatives=True)
    step = 1e-4
    r = k([[0.4 - step], [0.4], [0.4 + step]])
    assert (r.status == "reversal").all()
    for side in (r, r.after):
        values = side.effort("O")
        differences = (values[2] - values[0]) / (2 * step)
        assert side.gradient("effort.O")[1, :, 0] == pytest.approx(differences, rel=1e-6)
    slopes = np.array([side.gradient("effort.O")[1, :, 0] for side in (r, r.after)])
    values = np.array([side.effort("O")[1] for side in (r, r.after)])
    assert abs(slopes[0, 0] - slopes[1, 0]) > 1.0
    peak = da.compile(
        m, vary=["friction.coefficient"], outputs=["effort.O"], reduce="peak", static=True, derivatives=True
    )()
    where = np.unravel_index(np.abs(values).argmax(), values.shape)
    assert peak.effort("O")[0] == pytest.approx(np.abs(values).max(), rel=1e-12)
    assert peak.gradient("effort.O")[0, 0] == pytest.approx(np.sign(values[where]) * slopes[where], rel=1e-9)


def test_what_has_no_answer_has_no_slope() -> None:
    """A rod at 45 degrees: nearly jammed by the general executor's answer, and jammed."""
    k = da.compile(
        pushed_slider(0.5), vary=["joints.guide.friction.coefficient"], static=True, derivatives=True
    )
    mu = np.array([0.5, 0.999999, 1.2])
    r = k(mu[:, None])
    assert list(r.status[:, 0]) == ["ok", "ok", "jammed"]
    exact = 100 * np.sqrt(2) / (1 - mu[:2]) ** 2
    assert r.gradient("load.rod")[:2, 0, 0] == pytest.approx(exact, rel=1e-8)
    assert np.isnan(r.gradient("load.rod")[2]).all()


def test_designs_that_are_refused_have_no_slope() -> None:
    k = da.compile(four_bar(12), vary=["links.rocker.points.B"], outputs=["effort.O2"], derivatives=True)
    r = k([k.nominal, [0.08, 0.0], [np.nan, 0.0]])
    assert np.isfinite(r.gradient("effort.O2")[0]).all()
    closed = r.ok[1]
    assert np.isfinite(r.gradient("effort.O2")[1][closed]).all()
    assert np.isnan(r.gradient("effort.O2")[1][~closed]).all()
    assert np.isnan(r.gradient("effort.O2")[2]).all()


def test_a_jump_of_acceleration_has_derivatives_on_both_sides() -> None:
    """dT/dI is the angular acceleration of a harmonic rise at its end, and then of the dwell."""
    law = {"segments": [{"to": "30 deg", "in": "0.2 s", "by": "harmonic"}, {"dwell": "0.1 s"}], "count": 7}
    arm = {"points": {"O": [0, 0]}, "mass": 2, "center": [0.3, 0], "inertia": 0.2}
    links = {"ground": {"points": {"O": [0, 0]}}, "arm": arm}
    joints = {"O": {"type": "pin", "links": ["ground", "arm"]}}
    m = da.mechanism({"gravity": "none", "links": links, "joints": joints, "drives": {"O": {"law": law}}})
    answer = da.compile(m, ["links.arm.inertia"], ["effort.O"], derivatives=True)([[0.2]])
    assert list(answer.status[0]) == ["ok"] * 4 + ["jump"] + ["ok"] * 2
    assert answer.after is not None
    slopes = [side.gradient("effort.O")[0, 4] for side in (answer, answer.after)]
    bend = np.radians(30) / 2 * (np.pi / 0.2) ** 2
    assert np.ravel(slopes) == pytest.approx([-bend, 0.0], abs=1e-9 * bend)


def test_an_unknown_load_without_power_at_rest_is_no_state_of_rest() -> None:
    """A wedge that is given its effort, with an unknown load along the floor on its block, which only rises."""
    tree = da.wedge().to_tree()
    tree["drives"]["floor"] |= {"speed": 0, "effort": "5 N"}
    load = {"type": "force", "on": "block", "at": "B", "value": "unknown", "direction": "0 deg"}
    tree["loads"] = {"put": load}
    m = da.mechanism(tree)
    r = da.statics(m)
    assert set(r.status) == {"no_balance"}
    assert da.compile(m, static=True)().status[0].tolist() == list(r.status)
    tree["loads"] = {"put": load | {"direction": "90 deg"}}
    m = da.mechanism(tree)
    r = da.statics(m)
    assert set(r.status) == {"at_rest"}
    assert da.compile(m, static=True)().status[0].tolist() == list(r.status)


def test_an_unknown_load_across_the_only_way_has_no_force() -> None:
    """A screw with a given effort: the load's arm is rounding, in a program without a pivot that varies too."""
    tree = da.screw_jack().to_tree()
    tree["drives"]["S"]["effort"] = "5 N"
    tree["loads"] = {
        "put": {"type": "force", "on": "head", "at": "N", "value": "unknown", "direction": "0 deg"}
    }
    for way, status in (("0 deg", "no_balance"), ("30 deg", "ok")):
        tree["loads"]["put"]["direction"] = way
        m = da.mechanism(tree)
        assert set(da.statics(m).status) == {status}
        for vary in ([], ["links.head.mass"]):
            b = da.compile(m, vary)()
            assert set(b.status[0]) == {status}
            assert np.isfinite(b["load.put"]).all() == (status == "ok")


@pytest.mark.parametrize("reduce", [None, "peak"])
def test_positions_to_which_no_motion_leads_are_those_of_the_analysis(reduce: str | None) -> None:
    """A yoke whose slot turns with the crank: it goes to infinity at 90 deg, and closes again behind."""
    m = da.loads("""
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}}
  yoke: {points: {S: [0, 0]}, mass: 2}
joints:
  O: {type: pin, links: [ground, crank]}
  G: {type: slider, links: [ground, yoke], at: [O, S]}
  A: {type: slot, links: [crank, yoke], at: [A, S], direction: 90 deg}
drives: {O: {position: {from: 0 deg, to: 160 deg, count: 9}}}
loads: {P: {type: force, on: yoke, at: S, value: [-10, 0]}}
""")
    r = da.statics(m)
    assert set(r.status) == {"ok", "not_assembled"}
    k = da.compile(m, ["links.crank.points.A.0"], ["effort.O"], reduce)
    b, swept = k([[0.1], [0.12]]), da.sweep(m, "links.crank.points.A.0", [0.1, 0.12], outputs="effort.O")
    statuses = [list(r.status)] * 2 if reduce is None else ["not_assembled"] * 2
    assert b.status.tolist() == statuses
    mine = np.asarray(b["effort.O"]).reshape(2, -1)
    theirs = np.asarray(swept["effort.O"]).reshape(2, -1)
    if reduce is None:
        assert mine == pytest.approx(theirs, rel=1e-9, nan_ok=True)
        assert np.isfinite(mine).any()
    few = m.with_values({"drives.O.position": ["0 deg", "40 deg", "60 deg"]})  # where it closes throughout
    assert (da.compile(few, ["links.crank.points.A.0"])([[0.1], [0.12]]).status == "ok").all()
    assert da.compile(few)().redone == 0


def test_guides_that_do_the_same_may_vary_one_by_one() -> None:
    """Of two equal slots of a rod one has a direction that varies: by the file's number it closes, by others not."""
    m = da.loads("""
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}}
  rod: {points: {A: [0, 0], P: [0.3, 0]}}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  P: {type: slot, links: [ground, rod], at: [O, P]}
  twin: {type: slot, links: [ground, rod], at: [O, P]}
drives: {O: {position: [30 deg, 70 deg]}}
loads: {F: {type: force, on: rod, at: P, value: [-20, 0]}}
assembly: {rod: -10 deg}
""")
    assert da.statics(m).status == ("redundant",) * 2
    for vary in (["joints.P.direction"], ["joints.P.direction", "links.rod.points.P.0"]):
        k = da.compile(m, vary, ["effort.O"])
        b = k([k.nominal, k.nominal + 0.01])
        assert b.status.tolist() == [["ok"] * 2, ["not_assembled"] * 2]
        assert b["effort.O"][0] == pytest.approx(da.statics(m).effort("O"), rel=1e-12)
    k = da.compile(m, ["links.rod.points.P.0"], ["effort.O"])
    assert k([[0.3], [0.31]]).redone == 0  # both guides stay where they are
