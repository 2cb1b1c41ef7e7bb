"""Designs of one file stand in one assembly mode, whichever way they are computed, also where the file states none."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.careful_path import analyse_design
from dalembert.analysis.batch.tracing.course import in_mode
from dalembert.analysis.batch.tracing.symbolic_model import with_numbers
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.bundled import cases, examples
from dalembert.core.layout import Pose
from dalembert.machine.motion.coded.shared_motion import SharedMotion
from dalembert.machine.motion.simulation import motion_of
from tests.kernel.comparing import changed, difference, every_number

GOVERNOR = da.load(cases()["gov-14-hartnell-governor"])
"""Drawn as it stands. Where its bell is not as drawn the rule of the search would turn it over."""
UP = "links.bell.points.R.1"


@pytest.mark.parametrize("path", [UP, "joints.axis.direction"])
def test_a_design_beside_a_drawn_one_is_not_turned_over(path: str) -> None:
    nominal = float(np.pi / 2 if path.startswith("joints") else 0.0)
    values = [nominal + x for x in (0.0, 1e-4, 1e-3, -1e-3, 1e-2)]
    k = da.compile(GOVERNOR, [path], ["angle.bell", "reaction.Q"], lanes=1)
    compiled = k([[x] for x in values])
    swept = da.sweep(GOVERNOR, path, values, outputs=["angle.bell", "reaction.Q"])
    for name in ("angle.bell", "reaction.Q"):
        assert swept[name] == pytest.approx(compiled[name].reshape(swept[name].shape), abs=1e-9)
    assert np.abs(swept["angle.bell"] - swept["angle.bell"][0]).max() < 0.2
    for x, bell in zip(values, swept["angle.bell"], strict=True):
        _, r = analyse_design(GOVERNOR, k.trace.numbers, np.array([x]), k.trace.course, k.trace.inertia)
        assert r is not None
        assert r.angle("bell") == pytest.approx(bell, abs=1e-9)


def test_many_designs_stand_as_few_do() -> None:
    """From 500 on a sweep is compiled."""
    values = np.linspace(0.0, 1e-3, 501)
    many = da.sweep(GOVERNOR, UP, values.tolist(), outputs="angle.bell")["angle.bell"]
    few = da.sweep(GOVERNOR, UP, values[::100].tolist(), outputs="angle.bell")["angle.bell"]
    assert many[::100] == pytest.approx(few, abs=1e-12)


def test_a_sweep_at_other_positions_or_from_other_places() -> None:
    """Positions that are given are those of all designs; of other drives' positions each has its mode of the rule."""
    at = [0.0, 0.002, 0.004]
    swept = da.sweep(GOVERNOR, UP, [0.0, 1e-3], outputs="angle.bell", positions=at)["angle.bell"]
    assert np.abs(np.diff(swept, axis=0)).max() < 0.05
    found = da.sweep(four_bar(), "drives.O2.position", [1.0, 2.0], outputs="angle.rocker")["angle.rocker"]
    for x, rocker in zip((1.0, 2.0), found, strict=True):
        alone = da.solve(four_bar().with_values({"drives.O2.position": x}))
        assert rocker == pytest.approx(alone.angle("rocker"), abs=1e-12)


def test_a_study_and_an_optimum_stand_as_the_file_does_compiled_or_one_by_one() -> None:
    """Beside it the rule of the search would turn the bell over, by half a turn."""
    spread, of = {UP: "± 1 mm"}, ["angle.bell"]
    compiled = da.study(GOVERNOR, spread, of, designs=12).run()
    alone = da.study(GOVERNOR, spread, [*of, "load.spring.low"], designs=12).run()
    assert alone["angle.bell"] == pytest.approx(compiled["angle.bell"], abs=1e-12)
    bell = da.solve(compiled.study.mechanism_of(3)).angle("bell")
    assert np.abs(bell).max() == pytest.approx(compiled["angle.bell"][3], abs=1e-12)
    spring: list[Any] = ["peak load.spring", lambda r: r.unknown_load("spring")]
    for least in spring:
        best = da.optimize(GOVERNOR, {UP: (-1e-3, 1e-3)}, least, starts=2)
        assert np.abs(best.after.angle("bell")).max() < 0.3
        assert da.solve(best.mechanism).angle("bell") == pytest.approx(best.after.angle("bell"), abs=1e-9)
        assert abs(best.value) < abs(da.solve(GOVERNOR).unknown_load("spring")).max()


def test_a_design_in_space_that_closes_later_is_as_drawn() -> None:
    """A Bennett linkage whose sides have other lengths closes at some positions only, the first one not among them."""
    m = da.bennett()
    at = {"coupler": (-0.13029, -0.0388459, 0.106693), "rocker": (-0.1309836, -0.039094, 0.1064634)}
    numbers = {f"links.{link}.points.B.{k}": x for link, point in at.items() for k, x in enumerate(point)}
    k = da.compile(m, list(numbers), ["effort.O"], lanes=1)
    b = k([list(numbers.values())])
    r = da.solve(k.trace.course.in_mode(with_numbers(m, k.trace.numbers, list(numbers.values()))))
    assert list(b.status[0]) == list(r.status)
    assert (r.status[0], r.status[-1]) == ("not_assembled", "ok")
    assert b.value("effort.O")[0] == pytest.approx(r.effort("O"), rel=1e-9, nan_ok=True)


@pytest.mark.parametrize("positions", [None, [0.001, 0.014]])
def test_a_synthesized_mechanism_stands_as_it_was_found(positions: list[float] | None) -> None:
    name = "point.bell.B.y"
    found = da.synthesize(GOVERNOR, {UP: (5e-4, 2e-3)}, {name: [0.12, 0.1185]}, positions, starts=2)
    assert found.result[name] == pytest.approx(found.found[name], rel=1e-9)


def test_motions_of_designs_begin_as_that_of_the_file_compiled_or_one_by_one() -> None:
    """The governor at rest, its spring left out, falls; designs of a study are simulated as they were computed."""
    tree = GOVERNOR.to_tree()
    for key in ("turning", "answers"):
        tree.pop(key)
    tree |= {"loads": {}, "gravity": "standard", "drives": {"axis": {"position": 0.0, "effort": 0.0}}}
    m, until = da.mechanism(tree), {"until": "0.02 s"}
    s = da.study(m, {UP: [0.0, 1e-3]}, ["point.bell.B.y"], "final", draw="factorial", simulate=until)
    ends = s.run()["point.bell.B.y"]
    assert ends == pytest.approx([0.12, 0.12], abs=1e-4)
    for k, end in enumerate(ends):
        one = s.mechanism_of(k)
        assert da.simulate(one, **until).result.point("bell", "B")[-1, 1] == pytest.approx(end, rel=1e-9)
        shared = SharedMotion(m, (UP,))
        motion = motion_of(m.with_values(s.design(k)), "0.02 s", shared=shared)
        assert motion.result.point("bell", "B")[-1, 1] == pytest.approx(end, rel=1e-9)
    best = da.optimize(m, {UP: (5e-4, 1e-3)}, "final point.bell.B.y", simulate=until, starts=2)
    assert best.value == pytest.approx(0.12, abs=1e-4)
    assert da.simulate(best.mechanism, **until).result.point("bell", "B")[-1, 1] == pytest.approx(best.value)


@pytest.mark.parametrize(
    "m", [GOVERNOR, da.slider_crank(crank=0.05, rod=0.2)], ids=["governor", "slider-crank"]
)
def test_the_mode_is_written_as_places_of_the_links(m: da.Mechanism) -> None:
    """Of their origins in ground's axes, wherever the point is that the equations are written about."""
    tree = m.to_tree()
    tree.pop("assembly", None)
    bare = da.mechanism(tree)
    r = da.solve(bare)
    kept = in_mode(bare, r.compiled, full_pose(r, 0), r.schedule)
    for link in r.links:
        assert kept.assembly[link] == pytest.approx((*r.position(link)[0], r.angle(link)[0]), abs=1e-12)


def four_bar() -> da.Mechanism:
    return bare(da.four_bar())


def test_what_the_file_states_stays_and_so_does_what_begins_elsewhere() -> None:
    m, stated = four_bar(), da.four_bar()
    r = da.solve(m)
    assert in_mode(stated, r.compiled, full_pose(r, 0), r.schedule) is stated
    lost = Pose(np.full((4, 2), np.nan), full_pose(r, 0).turn, full_pose(r, 0).rotation)
    assert in_mode(m, r.compiled, lost, r.schedule) is m
    kept = in_mode(m.with_values({"links.coupler.mass": 3.0}), r.compiled, full_pose(r, 0), r.schedule)
    assert list(kept.assembly) == list(r.links)
    assert da.solve(kept).force_array == pytest.approx(
        da.solve(m.with_values({"links.coupler.mass": 3.0})).force_array
    )
    for m in (bare(da.planetary_train()), bare(da.rssr())):
        r = da.solve(m, positions=3)
        assert in_mode(m, r.compiled, full_pose(r, 0), r.schedule) is m


def bare(m: da.Mechanism) -> da.Mechanism:
    tree = m.to_tree()
    tree.pop("assembly", None)
    return da.mechanism(tree)


def test_in_space_designs_keep_the_mode_of_the_file(tmp_path: Path) -> None:
    """A platform on six legs drawn far from where it stands: drawn again for an axis of a leg that is turned by 11 deg,
    it would hang below its base."""
    file = tmp_path / "hexapod.yaml"
    file.write_text(examples()["hexapod"].read_text().replace("axis: [x, y, 1]", "axis: [1, 0, 0]"))
    m = da.load(file)
    turned = {f"joints.S_6.axis.{k}": x for k, x in enumerate((0.87847674, -0.47778512))}
    names = ["point.platform.P", "reaction.B_6"]
    k = da.compile(m, list(turned), names, lanes=1)
    design = with_numbers(m, k.trace.numbers, list(turned.values()))
    assert da.solve(design)["point.platform.P"][0, 2] == pytest.approx(-0.45)
    b, kept = k([list(turned.values())]), da.solve(k.trace.course.in_mode(design))
    for name in names:
        assert kept[name] == pytest.approx(b.value(name)[0], rel=1e-9, abs=1e-9)
    assert kept["point.platform.P"][0, 2] == pytest.approx(0.55)
    (path, x), *_ = turned.items()
    leg: Any = m.joints["S_6"]
    values = [leg.axis[0], x]
    swept, b = da.sweep(m, path, values, outputs=names), da.compile(m, [path], names, lanes=1)([[x]])
    assert swept["reaction.B_6"][1] == pytest.approx(b.value("reaction.B_6")[0], rel=1e-9)


@pytest.mark.parametrize("seed", [3, 4, 5])
def test_a_follower_stays_on_its_side_of_a_cam_of_other_geometry(seed: int) -> None:
    """A roller touches the cam on both sides of it, with the same angles: what the careful path computes in place of
    Newton's steps that have not converged is on the file's side."""
    m = da.disc_cam().with_values({"links.cam.center": [0.15, 0.0]})
    k = da.compile(m, vary=every_number(m), lanes=1)
    values = changed(k, seed, 0.2)
    b = k([values])
    design = k.trace.course.in_mode(with_numbers(m, k.trace.numbers, values.tolist()))
    assert [*design.assembly] == ["cam", "follower"]
    g = da.dynamics(design, method="careful")
    assert np.sign(g.point("follower", "F")[0, 1]) == np.sign(da.solve(m).point("follower", "F")[0, 1])
    assert list(b.status[0]) == list(g.status)
    assert difference(k, b, 0, g) < 1e-9
