"""Studies of motions under forces: each design is da.simulate's, whoever computes it; failed ones are no numbers."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.studies import Study, StudyResult, motion_engines
from dalembert.studies.motion_engines import SimulationEngine
from dalembert.studies.output.study_text import summary
from dalembert.studies.store import Store
from dalembert.studies.study_file import load_study
from tests.tiers import tiers

MODEL = """
units: {length: mm, angle: deg}
gravity: standard
parameters:
  torque: 8 N*m
links:
  ground: {points: {O2: [0, 0]}}
  crank: {points: {O2: [0, 0], A: [50, 0]}, mass: 2 kg, inertia: 0.02 kg*m^2}
  rod: {points: {A: [0, 0], B: [200, 0]}, mass: 1 kg, center: [80, 0], inertia: 0.004 kg*m^2}
  piston: {points: {B: [0, 0]}, mass: 1.5 kg}
joints:
  O2: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  S: {type: slider, links: [ground, piston], at: [O2, B], direction: 0 deg}
drives: {O2: {motor: {stall: torque, no_load: 60 rad/s}}}
start: {O2: {position: 30, speed: 0}}
"""
UNTIL = ["3 s", "O2.speed = 40 rad/s"]
WAY = {"until": UNTIL}
VARY = {
    "torque": "± 10 %",
    "drives.O2.motor.no_load": "± 5 %",
    "links.piston.mass": "± 5 %",
    "start.O2.position": "0..90 deg",
}
OUTPUTS = ["time", "reaction.A.magnitude", "O2.speed", "O2.position"]
KEYS = {
    "study": "1",
    "model": "m.yaml",
    "simulate": "{until: [3 s, O2.speed = 40 rad/s]}",
    "vary": "{torque: ± 10 %}",
    "outputs": "[time]",
    "designs": "10",
}


def run_up(**options: Any) -> Study:
    given: dict[str, Any] = {
        "designs": 40,
        "seed": 3,
        "reduce": "final",
        "simulate": {"until": UNTIL},
        **options,
    }
    return da.study(da.loads(MODEL), VARY, OUTPUTS, **given)


def write(folder: Path, **changed: str | None) -> Path:
    (folder / "m.yaml").write_text(MODEL)
    (folder / "s.yaml").write_text(
        "".join(f"{k}: {v}\n" for k, v in {**KEYS, **changed}.items() if v is not None)
    )
    return folder / "s.yaml"


def saved(s: Study, n: int, folder: Path) -> da.Mechanism:
    """A design written to a file and read again."""
    s.mechanism_of(n).save(folder / f"{n}.yaml")
    return da.load(folder / f"{n}.yaml")


def test_each_design_is_that_of_simulate(tmp_path: Path) -> None:
    s = run_up(simulate={"until": UNTIL, "tolerance": 1e-11})
    r = s.run()
    assert r.counts() == {"ok": 40}
    for n in (0, 39):
        own = da.simulate(saved(s, n, tmp_path), UNTIL)
        assert r["time"][n] == pytest.approx(own.time[-1], rel=1e-9)
        assert r["O2.position"][n] == pytest.approx(own.position("O2")[-1], rel=1e-9)
        assert r["O2.speed"][n] == pytest.approx(40, rel=1e-9)
        assert r["reaction.A.magnitude"][n] == pytest.approx(own.result["reaction.A.magnitude"][-1], rel=1e-7)


def test_what_a_motion_ends_with_is_not_reduced() -> None:
    final, peak, every = (run_up(reduce=reduce, keep=True).run() for reduce in ("final", "peak", None))
    for name in ("time", "O2.speed", "O2.position"):
        assert (final[name] == peak[name]).all()
        assert (final[name] == every[name]).all()
    assert every["reaction.A.magnitude"].shape == (40, 201)
    assert (np.abs(every["reaction.A.magnitude"]).max(axis=1) == peak["reaction.A.magnitude"]).all()
    assert peak.kinds == {
        "time": "time",
        "reaction.A.magnitude": "force",
        "O2.speed": "angular_speed",
        "O2.position": "angle",
    }
    assert every.to_xarray()["reaction.A.magnitude"].shape == (40, 201)


@pytest.mark.parametrize("reduce", tiers([None], ["peak"]))
def test_a_store_goes_on_with_the_same_bits(
    tmp_path: Path, reduce: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(motion_engines, "AT_ONCE", 1 << 16)
    s = run_up(designs=600, reduce=reduce)
    whole, stored = s.run(threads=1), s.run(tmp_path / "s.zarr", threads=2)
    assert len(stored.ledger) > 2
    store = Store(tmp_path / "s.zarr")
    store.open()
    store.forget(1)
    again = StudyResult.open(tmp_path / "s.zarr").study
    assert again.prints == s.prints
    for found in (stored, again.run(tmp_path / "s.zarr"), pickle.loads(pickle.dumps(s)).run()):
        assert all((found[name] == whole[name]).all() for name in [*OUTPUTS, "status"])
    assert (run_up(designs=300, reduce=reduce).extended(600).run()["time"] == whole["time"]).all()


@pytest.mark.long
def test_undecided_motions_are_no_numbers() -> None:
    """A long crank comes to a dead centre."""
    vary = {"links.crank.points.A.0": "50..350 mm"}
    s = da.study(da.loads(MODEL), vary, OUTPUTS, designs=60, simulate=WAY, limits={"time": "< 9 s"})
    r = s.run()
    lost = r.counts()["undecided"]
    assert 0 < lost < 60
    assert len(r.values("reaction.A.magnitude")) == len(r.values("time")) == 60 - lost == r.ok.sum()
    assert r.share("time", "< 9 s") == pytest.approx(1 - lost / 60)
    assert r.failed()[0].sentence.startswith(
        "The steps of the motion became too small, or it comes near a dead"
    )
    text = " ".join(
        f"{summary(r)} {da.study(s.mechanism, vary, ['time'], designs=60, simulate=WAY).run().report()}".split()
    )
    assert "each simulated until 3 s or O2.speed = 40 rad/s, 201 instants" in text
    assert "Over the instants: peak." in text
    assert "First: design" in text


def test_a_study_of_machines_that_rub_is_compiled(tmp_path: Path) -> None:
    """Dry friction in a pin; peaks over the same instants and events as a motion alone; none is computed one by one."""
    rough = MODEL.replace("A: {type: pin, ", "A: {type: pin, friction: {coefficient: 0.1, radius: 9 mm}, ")
    given: dict[str, Any] = {
        "designs": 3,
        "reduce": "peak",
        "simulate": {"until": ["0.1 s"], "tolerance": 1e-11},
    }
    s = da.study(da.loads(rough), VARY, OUTPUTS, **given)
    r = s.run()
    assert not s.why_slow
    assert (s.run(tmp_path / "s.zarr")["time"] == r["time"]).all()
    for n in range(3):
        own = da.simulate(s.mechanism_of(n), "0.1 s", tolerance=1e-11)
        peak = np.nanmax(np.abs(own.result["reaction.A.magnitude"]))
        assert r["reaction.A.magnitude"][n] == pytest.approx(peak, rel=1e-7)
        assert r["O2.speed"][n] == pytest.approx(own.speed("O2")[-1], rel=1e-8)


def test_what_is_not_compiled_is_simulated_one_by_one() -> None:
    """A crank behind a gear with losses."""
    lossy = MODEL.replace("no_load: 60 rad/s}", "no_load: 60 rad/s, efficiency: 0.9}")
    given: Any = {"until": ["0.1 s"], "tolerance": 1e-11}
    s = da.study(da.loads(lossy), VARY, OUTPUTS, designs=1, simulate=given)
    r = s.run()
    assert s.why_slow.startswith("the gear of the motor of drive 'O2' has losses")
    own = da.simulate(s.mechanism_of(0), "0.1 s", tolerance=1e-11)
    assert r["O2.position"][0] == pytest.approx(own.position("O2")[-1], rel=1e-10)


@pytest.mark.parametrize("reduce", ["peak", "mean", "final", None])
def test_simulations_one_by_one_are_the_compiled_ones(reduce: str | None) -> None:
    s = run_up(designs=3, reduce=reduce, simulate={"until": "0.1 s", "tolerance": 1e-11})
    assert s.motion is not None
    slow = SimulationEngine(s.mechanism, s.paths, s.outputs, reduce, False, None, "", s.motion)
    found, fast = slow.block(s.plan.values(0, 3)), s.run()
    for name in OUTPUTS:
        assert found[name] == pytest.approx(fast[name], rel=1e-7, abs=1e-9)
    assert not found["status"].any()


WRONG: list[tuple[dict[str, str | None], int, str]] = [
    ({"simulate": "2 s"}, 3, "simulate is '2 s', not a mapping; write simulate: {until: 2 s}"),
    ({"simulate": "{count: 5}"}, 3, "the motion does not say until when; write simulate: {until: 2 s}"),
    ({"simulate": "{until: 2 s, coutn: 5}"}, 3, "unknown key 'coutn'; did you mean 'count'?"),
    ({"simulate": "{until: 2 m}"}, 3, "'2 m' is a length, but a time is needed"),
    ({"simulate": "{until: O2.speed = 3 rad/s}"}, 3, "has no end; add a time: [5 s, ...]"),
    ({"simulate": "{until: [2 s, O3.speed = 0]}"}, 3, "names no drive; the only one is 'O2'"),
    (
        {"simulate": "{until: 2 s, count: 1}"},
        3,
        "count is 1; it must be an integer of at least 2; write count: 1000",
    ),
    ({"simulate": "{until: 2 s, count: 1e7}"}, 3, "instants=10000000 is out of range; use 2 to 100000"),
    ({"simulate": "{until: 2 s, tolerance: 1}"}, 3, "the tolerance 1 is not between 1e-14 and 1e-3"),
    ({"simulate": "{until: 2 s, tolerance: fine}"}, 3, "'fine' is not a plain number"),
    (
        {"simulate": "{until: 2 s, start: {O3: {position: 0}}}"},
        3,
        "start names the drive 'O3', which does not exist",
    ),
    ({"simulate": "{until: 2 s, start: {O2: {speed: 0}}}"}, 3, "its position is missing"),
    ({"vary": "{start.O3.speed: 1..2 rad/s}"}, 4, "'O3' does not exist in start"),
    ({"vary": "{drives.O2.motor.stal: ± 5 %}"}, 4, "did you mean 'stall'?"),
    ({"vary": "{drives.O2.motor.stall: ± 5 mm}"}, 4, "'5 mm' is a length, but a moment is needed"),
    ({"vary": "{drives.O2.effort: ± 5 %}"}, 4, "drives.O2.effort"),
    (
        {"simulate": None, "vary": "{start.O2.speed: 1..2 rad/s}"},
        3,
        "is of a motion under forces; write simulate",
    ),
    ({"outputs": "[time, O2.sped]"}, 5, "unknown output 'O2.sped'; did you mean 'O2.speed'?"),
    ({"reduce": "last"}, 7, "unknown reduction 'last'"),
    ({"reduce": "squares"}, 7, "a study has no target for squares"),
    ({"static": "true"}, 7, "static is given, and the study simulates; leave static out"),
    ({"positions": "12"}, 7, "positions is given, and the study simulates; leave positions out"),
    ({"simulate": None, "outputs": "[effort.O2]", "reduce": "final"}, 6, "unknown reduction 'final'"),
]


@pytest.mark.parametrize(("changed", "line", "sentence"), WRONG)
def test_a_malformed_study_of_motions_is_refused_with_line_and_remedy(
    tmp_path: Path, changed: dict[str, str | None], line: int, sentence: str
) -> None:
    path = write(tmp_path, **changed)
    with pytest.raises(da.ModelError) as said:
        load_study(path)
    assert str(said.value).startswith(f"{path}:{line}: ")
    assert sentence in str(said.value)


def test_a_file_says_the_same_as_the_call(tmp_path: Path) -> None:
    """Bare numbers are in the units of the file: degrees."""
    path = write(
        tmp_path,
        simulate="{until: [3, O2.speed = 40 rad/s], start: {O2: {position: 60, speed: 0}}, count: 2e1}",
    )
    s, start = load_study(path), {"O2": {"position": "60 deg"}}
    given = {"until": UNTIL, "start": start, "count": 20}
    own = da.study(da.loads(MODEL), {"torque": "± 10 %"}, ["time"], designs=10, simulate=given)
    assert (s.run()["time"] == own.run()["time"]).all()
