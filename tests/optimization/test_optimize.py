"""`da.optimize`: against a grid of designs, against a published mechanism's known figure, and by its own laws."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases
from dalembert.optimization import pareto_front
from dalembert.optimization.aims import parse_aim, parse_condition
from dalembert.optimization.design_problem import DesignProblem
from dalembert.optimization.optimizers import METHODS
from tests.tiers import tiers

WHERE = ("transmission.B >= 33 deg",)
BOX = {"links.ground.points.O4.0": (0.28, 0.36), "links.rocker.points.B.0": (0.2, 0.28)}
TORQUE: dict[str, Any] = {
    "links.ground.points.O4": ("[17 in, -2 in]", "[21 in, 2 in]"),
    "links.coupler.points.B": ("[13 in, -2 in]", "[17 in, 2 in]"),
    "links.cw.weight": (0.0, "10 lbf"),
    "links.cw.center": ("[-15 in, -15 in]", "[15 in, 15 in]"),
}


def norton() -> da.Mechanism:
    """Norton's example 11-3 over a turn at constant speed, with a counterweight welded to the coupler."""
    text = cases()["seed-003-norton-11-3"].read_text(encoding="utf-8").split("# The book rounds")[0]
    for old, new in (
        ("  rocker:  {", "  cw: {points: {W: [0, 0]}, weight: 0, center: [0, 0], inertia: 0}\n  rocker:  {"),
        ("  O4: {type", "  W: {type: weld, links: [coupler, cw], at: [A, W]}\n  O4: {type"),
        ("position: 60,", "position: {from: 0, to: 360, count: 72},"),
        (", acceleration: -40 rad/s^2", ""),
    ):
        assert old in text
        text = text.replace(old, new)
    return da.loads(text)


@pytest.mark.long
def test_peak_torque_of_norton_11_3() -> None:
    best = da.optimize(norton(), TORQUE, "peak effort.O2", WHERE, starts=40)
    assert best.feasible
    assert best.value_before == pytest.approx(42.487, abs=1e-3)
    assert best.value == pytest.approx(23.4184, abs=1e-3)  # differential evolution: 23.4204
    r = da.dynamics(best.mechanism)
    assert np.abs(r["effort.O2"]).max() == best.value
    assert np.degrees(r["transmission.B"]).min() >= 33 - 1e-4


def test_no_design_of_a_grid_is_better() -> None:
    m, where = da.four_bar(), ("transmission.B >= 50 deg", "peak reaction.O4.magnitude <= 130 N")
    best = da.optimize(m, BOX, "rms effort.O2", where, starts=20, seed=3)
    grid = np.array(np.meshgrid(*(np.linspace(*ends, 61) for ends in BOX.values()))).reshape(2, -1).T
    r = da.compile(m, vary=list(BOX), outputs=["effort.O2", "transmission.B", "reaction.O4.magnitude"])(grid)
    good = (r.value("transmission.B").min(axis=1) >= np.radians(50)) & (r.magnitude("O4").max(axis=1) <= 130)
    values = np.sqrt((r.effort("O2") ** 2).mean(axis=1))[good & r.ok.all(axis=1)]
    assert best.feasible
    assert values.min() * (1 - 0.02) <= best.value <= values.min() * (1 + 1e-9)


@pytest.mark.parametrize("aim", ["peak effort.O2", "mean power.O2", "rms shaking_force.magnitude"])
def test_gradients_of_aim_and_conditions(aim: str) -> None:
    m, low, high = da.four_bar(), np.array([0.28, 0.2]), np.array([0.36, 0.28])
    conditions = tuple(map(parse_condition, ("transmission.B >= 60 deg", "reaction.A.magnitude <= 40")))
    p = DesignProblem(m, tuple(BOX), low, high, parse_aim(aim), conditions, m.schedule().position)
    u = np.array([[0.31, 0.52], [0.7, 0.4]])
    for k, h in enumerate(np.eye(2) * 1e-6):
        slope = (p(u + h).value - p(u - h).value) / 2e-6
        assert np.allclose(slope, p(u).slope[:, k], rtol=1e-6, atol=1e-7)


@pytest.mark.parametrize(
    "method", tiers([], [name for name, (does, _) in METHODS.items() if does != "front"])
)
def test_another_optimizer_finds_the_same_design(method: str) -> None:
    pytest.importorskip(method.partition(".")[0])
    where = ("transmission.B >= 50 deg", "peak reaction.O4.magnitude <= 130 N")
    best = da.optimize(da.four_bar(), BOX, "peak effort.O2", where, starts=8, positions=24, method=method)
    same = da.optimize(da.four_bar(), BOX, "peak effort.O2", where, starts=8, positions=24)
    assert best.feasible
    assert best.value == pytest.approx(same.value, rel=1e-7)


@pytest.mark.parametrize(
    "method", tiers([], [name for name, (does, _) in METHODS.items() if does == "front"])
)
def test_an_evolved_front_lies_on_that_by_bounds(method: str) -> None:
    """Each of its designs keeps the condition, and is as good as the best by one aim that is no worse by the other."""
    pytest.importorskip("pymoo")
    box = {"links.coupler.center.1": (-0.1, 0.1), "links.rocker.center.0": (0.05, 0.2)}
    aims, rule, m = ["effort.O2", "reaction.B.magnitude"], "reaction.O4.magnitude <= 110", da.four_bar()
    front = da.pareto(m, box, aims, rule, points=4, starts=8, positions=12, method=method)
    assert len(front.designs) == 4
    assert (np.diff(front.values, axis=0) * [1, -1] > 0).all()
    for first, second in front.values:
        bound = f"peak reaction.B.magnitude <= {float(second)!r}"
        best = da.optimize(m, box, aims[0], [rule, bound], starts=4, positions=12).value
        assert first == pytest.approx(best, rel=2e-3)


@pytest.mark.parametrize("method", ["nlopt", "pymoo.de"])
def test_a_method_whose_package_is_missing(
    method: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from dalembert.optimization.optimize_file import optimize_file

    monkeypatch.setattr("dalembert.optimization.optimizers.find_spec", lambda package: None)
    package = method.partition(".")[0]
    with pytest.raises(da.ModelError, match=f"needs {package}; pip install {package}"):
        da.optimize(da.four_bar(), BOX, "peak effort.O2", method=method)
    with pytest.raises(da.ModelError, match=f"optimize.yaml:9: method '.*' needs {package}"):
        optimize_file(written(tmp_path, f"{FILE}method: {method}\n"))


def test_the_least_closure_margin_over_a_turn_is_that_of_grashof() -> None:
    """Of random cranks: the shortest and the longest distance from A to O4 are within what coupler and rocker reach."""
    rng, ends = np.random.default_rng(2), np.append(np.linspace(0, 2 * np.pi, 24, endpoint=False), np.pi)
    names = ["links.crank.points.A.0", "links.coupler.points.B.0", "links.rocker.points.B.0"]
    k = da.compile(da.four_bar(), [*names, "links.ground.points.O4.0"], ["closure.B"], derivatives=True)
    lengths = k.nominal * rng.uniform(0.6, 1.4, (200, 4))
    margin = k(lengths, ends).value("closure.B").min(axis=1)
    crank, coupler, rocker, ground = lengths.T
    grashof = np.minimum(coupler + rocker - crank - ground, abs(ground - crank) - abs(coupler - rocker))
    assert 50 < (grashof > 1e-3).sum() < 190
    assert np.allclose(margin[grashof > 1e-3], grashof[grashof > 1e-3], rtol=0, atol=1e-12)
    assert np.isnan(margin[grashof < -1e-3]).all()
    assert np.allclose(
        da.kinematics(da.four_bar())["closure.B"],
        da.compile(da.four_bar(), outputs=["closure.B"])().value("closure.B")[0],
        atol=1e-14,
    )
    engine = da.slider_crank()
    rod, crank_length = engine.links["rod"].points["B"][0], engine.links["crank"].points["A"][0]
    assert da.kinematics(engine)["closure.B"].min() == pytest.approx(rod - crank_length, rel=1e-3)


@pytest.mark.long
def test_a_design_with_every_kind_of_condition() -> None:
    vary: Any = {**BOX, "links.crank.points.A.0": ("60 mm", "120 mm", "5 mm")}
    where = ("closure.B >= 15 mm", "point.coupler.B.x <= 0.36 m", "abs(point.coupler.B.y) <= 270 mm", *WHERE)
    best = da.optimize(da.four_bar(), vary, "peak angle.rocker.speed", where, starts=20)
    r, lengths = da.dynamics(best.mechanism), dict(zip(best.numbers, best.values, strict=True))
    assert best.feasible
    ground, rocker, crank = (lengths[path] for path in vary)
    assert abs(crank / 0.005 - round(crank / 0.005)) < 1e-9
    assert min(0.3 + rocker - crank - ground, ground - crank - abs(0.3 - rocker)) >= 15e-3 - 1e-4
    assert r["point.coupler.B.x"].max() <= 0.36 + 1e-6
    assert np.abs(r["point.coupler.B.y"]).max() <= 0.27 + 1e-6


@pytest.mark.long
def test_steps() -> None:
    vary: Any = {**BOX, "links.rocker.points.B.0": (0.2, 0.28, "5 mm")}
    best = da.optimize(da.four_bar(), vary, "peak effort.O2", starts=10)
    steps = (best.values[1] - 0.2) / 0.005
    assert abs(steps - round(steps)) < 1e-9
    free = da.optimize(da.four_bar(), BOX, "peak effort.O2", starts=10)
    assert free.value <= best.value <= 1.05 * free.value


def test_the_same_again_and_written(tmp_path: Path) -> None:
    one, two = (da.optimize(da.four_bar(), BOX, "peak effort.O2", WHERE, starts=10, seed=5) for _ in range(2))
    assert np.array_equal(one.values, two.values)
    one.save(tmp_path / "best.yaml")
    with pytest.raises(da.DalembertError, match=r"is there already|exists"):
        one.save(tmp_path / "best.yaml")
    again = da.dynamics(da.load(tmp_path / "best.yaml"))
    assert np.abs(again["effort.O2"]).max() == pytest.approx(one.value, rel=1e-12)
    assert "margin of transmission.B >= 33 deg [deg]" in str(one)


@pytest.mark.long
def test_conditions_that_no_design_keeps() -> None:
    best = da.optimize(da.four_bar(), BOX, "peak effort.O2", "transmission.B >= 89 deg", starts=5)
    assert not best.feasible
    assert "No design meets every condition" in str(best)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"vary": {}}, "no number varies"),
        ({"vary": {"links.crank.mas": (1, 2)}}, "mas"),
        ({"vary": {"links.crank.mass": (2, 1)}}, "the bounds of 'links.crank.mass' go from 2 to 1"),
        ({"vary": {"links.crank.mass": (1, "2 in")}}, "'2 in' is a length, but a mass is needed"),
        ({"vary": {"links.crank.mass": (1, 2, 0)}}, "step > 0"),
        ({"vary": {"links.crank.mass": 3}}, "give (low, high) or (low, high, step)"),
        ({"least": "peek effort.O2"}, "'peek', which is not an aim; did you mean 'peak'?"),
        ({"least": "peak efort.O2"}, "unknown output 'efort.O2'; did you mean 'effort.O2'?"),
        ({"where": "transmission.B"}, "'transmission.B' is not a condition"),
        ({"where": "rms effort.O2 <= 3 N"}, "3 N is a force, and rms(effort.O2) is a moment"),
        (
            {"method": "nlopt.slsq"},
            "unknown method 'nlopt.slsq' for this problem; did you mean 'nlopt.slsqp'?",
        ),
        ({"method": "pymoo.nsga2"}, "unknown method 'pymoo.nsga2' for this problem"),
        ({"starts": 0}, "starts is 0; give a whole number from 1 to 1000000"),
        ({"vary": {"links.crank.points.A.0": (1.0, 1.1)}}, "can be solved at every position"),
    ],
)
def test_wrong_problems(changed: dict[str, Any], message: str) -> None:
    given: dict[str, Any] = {"vary": BOX, "least": "peak effort.O2", "starts": 3, **changed}
    with pytest.raises(da.ModelError, match=re.escape(message)):
        da.optimize(da.four_bar(), **given)


FILE = """\
optimize: 1
model: four_bar.yaml
vary:
  links.ground.points.O4.0: [280 mm, 360 mm]
  links.rocker.points.B: ["[200 mm, 0]", "[280 mm, 0]"]
least: peak effort.O2
where: [transmission.B >= 33 deg]
starts: 5
"""


def written(folder: Path, text: str = FILE) -> Path:
    da.four_bar().save(folder / "four_bar.yaml", overwrite=True)
    (folder / "optimize.yaml").write_text(text, encoding="utf-8")
    return folder / "optimize.yaml"


def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from dalembert.cli.answer_files import LabelledOutputs
    from dalembert.cli.studies.optimize_command import optimize

    file, best = written(tmp_path), tmp_path / "best.yaml"
    assert optimize(file, out=LabelledOutputs(output=best)) == 0
    same = da.optimize(da.four_bar(), BOX, "peak effort.O2", WHERE, starts=5)
    found = float(np.abs(da.dynamics(da.load(best))["effort.O2"]).max())
    assert found == pytest.approx(same.value, rel=1e-5)
    assert "peak effort.O2" in capsys.readouterr().out
    with pytest.raises(da.ModelError, match=r"is there already|exists"):
        optimize(file, out=LabelledOutputs(output=best))
    assert optimize(written(tmp_path, FILE.replace("33", "89"))) == 1
    two = FILE.replace(
        "least: peak effort.O2", "least: [peak effort.O2, peak reaction.B.magnitude]\npoints: 2"
    )
    assert optimize(written(tmp_path, two), out=LabelledOutputs(csv=tmp_path / "front.csv")) == 0
    front = da.pareto(da.four_bar(), BOX, ["peak effort.O2", "peak reaction.B.magnitude"], WHERE, 2, starts=5)
    rows = (tmp_path / "front.csv").read_text(encoding="utf-8").splitlines()[1:]
    assert [[*map(float, row.split(",")[1:3])] for row in rows] == front.values.tolist()
    with pytest.raises(da.ModelError, match=r"yaml:6: two aims give several designs"):
        optimize(file, out=LabelledOutputs(output=tmp_path / "front.yaml"))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("four_bar.yaml", "none.yaml", "optimize.yaml:2: model file"),
        ("least: peak effort.O2", "least: 3", "optimize.yaml:6: no aim to minimize"),
        ("starts: 5", "points: 5", "optimize.yaml:8: points are those of a front"),
        ("least:", "last:", "optimize.yaml:6: unknown key 'last'; did you mean 'least'?"),
        ("[280 mm, 360 mm]", "280 mm", "optimize.yaml:4: the bounds of 'links.ground.points.O4.0'"),
        ("starts: 5", "starts: many", "optimize.yaml:8: starts is 'many'"),
        ("optimize: 1", "optimize: 2", "optimize.yaml:1: unknown format version 2"),
        ("effort.O2", "efort.O2", "optimize.yaml:6: unknown output 'efort.O2'"),
        ("280 mm,", "280 kg,", "'280 kg' is a mass, but a length is needed"),
    ],
)
def test_wrong_files(tmp_path: Path, old: str, new: str, message: str) -> None:
    from dalembert.optimization.optimize_file import optimize_file

    with pytest.raises(da.ModelError, match=re.escape(message)):
        optimize_file(written(tmp_path, FILE.replace(old, new, 1)))


@pytest.mark.parametrize(
    ("values", "kept"),
    [
        ([(1, 9), (2, 5), (3, 4)], [0, 1, 2]),
        ([(3, 4), (1, 9), (2, 5)], [1, 2, 0]),  # by the first aim
        ([(1, 9), (2, 9.5), (3, 4)], [0, 2]),  # worse by both
        ([(1, 5), (1, 4), (2, 4.5)], [1]),  # as good by one, better by the other
        ([(1, 5), (2, 5 * (1 - 0.9e-6)), (3, 5 * (1 - 1.1e-6))], [0, 2]),  # no better but for rounding
        ([(1, 5), (1, 5)], [0]),
    ],
)
def test_a_front_has_no_design_that_another_one_betters(
    values: list[tuple[float, float]], kept: list[int]
) -> None:
    assert pareto_front._undominated(np.array(values, float)) == kept


@pytest.mark.long
def test_a_front_goes_from_one_aim_to_the_other() -> None:
    """Its ends are the best designs by each aim alone; between them what one aim gains the other loses."""
    box = {"links.coupler.center.1": (-0.1, 0.1), "links.rocker.center.0": (0.05, 0.2)}
    aims = ["effort.O2", "reaction.B.magnitude"]
    front = da.pareto(da.four_bar(), box, aims, points=4, starts=4, positions=12)
    first, second = (da.optimize(da.four_bar(), box, aim, starts=4, positions=12).value for aim in aims)
    assert len(front.designs) == 4
    assert front.values[0, 0] == pytest.approx(first, rel=1e-6)
    assert front.values[-1, 1] == pytest.approx(second, rel=1e-6)
    assert (np.diff(front.values[:, 0]) > 0).all()
    assert (np.diff(front.values[:, 1]) < 0).all()
    for design, values in zip(front.designs, front.values, strict=True):
        r = da.solve(design.mechanism, positions=12)
        assert [np.abs(r[aim]).max() for aim in aims] == pytest.approx(values, rel=1e-9)
    assert "reaction.B.magnitude" in str(front)
    other = da.pareto(
        da.four_bar(), box, ["effort.O2", "rms reaction.B.magnitude"], points=3, starts=4, positions=12
    )
    assert (np.diff(other.values, axis=0) * [1, -1] > 0).all()
    for design, values in zip(other.designs, other.values, strict=True):
        force = da.solve(design.mechanism, positions=12)["reaction.B.magnitude"]
        assert np.sqrt(np.mean(force**2)) == pytest.approx(values[1], rel=1e-9)


def test_the_page_of_an_optimum_has_both_designs(tmp_path: Path) -> None:
    best = da.optimize(da.four_bar(), BOX, "peak effort.O2", WHERE, starts=3, positions=12)
    da.report(best).save(tmp_path / "best.txt")
    text = (tmp_path / "best.txt").read_text()
    for row in [*best.number_rows(), *best.aim_rows()]:
        assert all(cell in text for cell in row)
    assert text.count("[drawing: Four-bar linkage") == 2
    assert "[drawing: effort.O2 over the cycle]" in text
