"""`da.sweep`: every design as it is by itself, compiled or not; labels, units, statuses; refusals."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch import design_sweep
from dalembert.bundled import cases, examples
from dalembert.notebook import plots
from dalembert.views.notation import Notation, Shown
from tests.notebook.test_cards import read
from tests.tiers import tiers

FOUR_BAR = da.load(examples()["four_bar"])
LBF, INCH = 4.4482216152605, 0.0254
COUPLER, ROCKER = "links.coupler.weight", "links.rocker.weight"


def test_each_design_is_its_own_analysis() -> None:
    grid: dict[str, Any] = {COUPLER: ["5 lbf", "9 lbf"], ROCKER: np.array([10.0, 20.0, 30.0])}
    s = da.sweep(FOUR_BAR, grid, positions=5)
    assert s.shape == (2, 3)
    for i, coupler in enumerate(grid[COUPLER]):
        for j, rocker in enumerate(grid[ROCKER]):
            r = da.dynamics(FOUR_BAR.with_values({COUPLER: coupler, ROCKER: rocker}), positions=5)
            for name in ("effort.O2", "reaction.A", "reaction.B.magnitude"):
                assert s[name][i, j] == pytest.approx(r[name], rel=1e-12, abs=1e-9)
            assert s.over("reaction.A")[i, j] == pytest.approx(r.worst("reaction", "A")[0], rel=1e-12)
            assert s.over("effort.O2", "mean")[i, j] == pytest.approx(r.effort("O2").mean())
    assert s.designs[1] == ("5 lbf", "20 N")


def test_together_is_value_by_value() -> None:
    s = da.sweep(FOUR_BAR, {COUPLER: [20, 40], ROCKER: [10, 30]}, together=True, outputs="effort.O2")
    alone = [
        da.dynamics(FOUR_BAR.with_values({COUPLER: c, ROCKER: r})).effort("O2")
        for c, r in ((20, 10), (40, 30))
    ]
    assert s["effort.O2"] == pytest.approx(np.array(alone), rel=1e-12)
    assert s.to_xarray()["effort.O2"].dims == ("design", "position")
    assert s.to_xarray().coords[ROCKER].attrs == {"units": "N"}


ROUGH = "seed-002-7g-engine-guide-100-mm"


@pytest.mark.parametrize(
    "case",
    tiers(
        [("engine", "links.rod.mass")],
        [("rssr", "loads.resistance.value"), (ROUGH, "links.piston.mass")],
    ),
)
def test_compiled_and_one_by_one_agree(case: tuple[str, str], monkeypatch: pytest.MonkeyPatch) -> None:
    name, path = case
    m = da.load({**examples(), **cases()}[name])
    values = np.linspace(0.1, 1.0, 7)
    alone = da.sweep(m, path, values)
    monkeypatch.setattr(design_sweep, "MANY", 5)
    compiled = da.sweep(m, path, values)
    monkeypatch.setattr(design_sweep, "_collected", None)  # the compiled way was gone
    da.sweep(m, path, values)
    assert (compiled.status == alone.status).all()
    for name, value in alone.answers.arrays.items():
        scale = np.nanmax(np.abs(value), initial=0.0)
        np.testing.assert_allclose(
            compiled[name], value, rtol=1e-9, atol=1e-9 * max(scale, 1e-9), equal_nan=True
        )


@pytest.mark.parametrize("many", [2, 500])
def test_at_rest_few_designs_and_many_have_no_motion(many: int, monkeypatch: pytest.MonkeyPatch) -> None:
    m = da.load(cases()["seed-001-ea-block-at-rest"])
    (drive,) = m.drives
    monkeypatch.setattr(design_sweep, "MANY", many)
    s = da.sweep(m, "loads.N.value.1", [-90.0, -100.0], outputs=[f"drive.{drive}.speed"])
    assert set(s.status.ravel()) == {"at_rest"}
    assert np.isnan(s[f"drive.{drive}.speed"]).all()


@pytest.mark.parametrize("end", ["low", "high"])
def test_the_ends_of_what_friction_leaves_open_are_not_compiled(end: str) -> None:
    m = da.load(cases()["seed-001-eb-block-sliding"])
    (drive,) = m.drives
    name = f"effort.{drive}.{end}"
    with pytest.raises(da.ModelError, match=f"{name} is not compiled; use da.dynamics, da.sweep, da.study"):
        da.compile(m, outputs=[name])
    path = f"drives.{drive}.speed"
    swept = da.sweep(m, path, [0.1, 0.2], outputs=[name])[name]
    assert swept[1] == pytest.approx(da.solve(m.with_values({path: 0.2}))[name])


def test_the_ends_of_what_friction_leaves_open_are_optimized_one_by_one() -> None:
    m, path = da.load(cases()["seed-002-7a-engine-friction-circles"]), "joints.A.friction.radius"
    best = da.optimize(m, {path: (0.03, 0.1)}, "least effort.O.low", positions=[0.7, 0.8], starts=2)
    ends = [
        da.dynamics(m.with_values({path: x}), positions=[0.7, 0.8])["effort.O.low"].min() for x in (0.03, 0.1)
    ]
    assert best.value == pytest.approx(min(ends), rel=1e-6)
    assert min(ends) < max(ends) * 0.99


def test_without_friction_both_ends_are_the_effort_in_every_expression() -> None:
    """A name alone, in an expression and in an aim; a kernel refuses each by the same sentence."""
    m, path = da.four_bar(positions=3), "loads.torque.value"
    effort = da.solve(m)["effort.O2"]
    for text in ("effort.O2.low", "2*effort.O2.low - effort.O2.high"):
        assert da.solve(m)[text] == pytest.approx(effort)
        with pytest.raises(da.ModelError, match=r"effort\.O2\.\w+ is not compiled; use da"):
            da.compile(m, [path], outputs=[text])
        peaks = [
            da.optimize(m, {path: (1.0, 2.0)}, f"peak({aim})", starts=2).value for aim in (text, "effort.O2")
        ]
        assert peaks[0] == pytest.approx(peaks[1], rel=1e-6)


def test_a_sweep_is_labelled_with_units() -> None:
    s = da.sweep(FOUR_BAR, COUPLER, [2 * LBF, 4 * LBF], positions=3, outputs=["effort.O2", "reaction.A"])
    si, of_file = s.to_xarray(), s.to_xarray("file")
    assert si["reaction.A"].dims == (COUPLER, "position", "component")
    assert of_file[COUPLER].values == pytest.approx([2, 4])
    assert [d[COUPLER].attrs["units"] for d in (si, of_file)] == ["N", "lbf"]
    assert of_file["effort.O2"].attrs["units"] == "lbf*in"
    assert (of_file["effort.O2"] * LBF * INCH).values == pytest.approx(si["effort.O2"].values)
    assert si["drive_O2"].sel(position=2).values == pytest.approx(s.nominal.drive_position("O2")[1])
    heavier = of_file["reaction.A"].sel({COUPLER: 4}, method="nearest").sel(component="x")
    assert heavier.values * LBF == pytest.approx(s["reaction.A"][1, :, 0])


def test_statuses_are_kept() -> None:
    s = da.sweep(da.four_bar(), "links.coupler.points.B.0", [0.3, 0.1])
    assert s.ok[0].all()
    assert (s.status[1] == "not_assembled").sum() == 29
    assert np.isnan(s["effort.O2"][1][~s.ok[1]]).all()
    assert np.isnan(s.over("effort.O2")[1])
    ((which, status, sentence),) = s.problems()
    assert (which, status) == ("links.coupler.points.B.0 = 0.1 m: position 23-51", "not_assembled")
    assert sentence.startswith("The linkage does not close between 110 deg and 250 deg of O2")
    assert (
        repr(s) == "<Sweep of links.coupler.points.B.0: 2 designs of 72 positions, 115 ok, 29 not_assembled>"
    )
    shown = read(s)
    assert shown.rows[2][:3] == ["0.1 m", "43 of 72", "-"]
    assert "not_assembled: links.coupler.points.B.0 = 0.1 m: position 23-51: The linkage" in shown.text


def test_reversals_count_on_both_sides() -> None:
    m = da.load(cases()["seed-002-7g-engine-guide-100-mm"])
    drive = next(iter(m.drives))
    there = m.with_values(
        {f"drives.{drive}.position": {"from": 0, "to": 720, "count": 9}, f"drives.{drive}.speed": 10.0}
    )
    r = da.dynamics(there)
    assert r.reverses.any()
    s = da.sweep(there, "links.rod.mass", [1.0])
    exact = da.dynamics(there.with_values({"links.rod.mass": 1.0}))
    before, after = exact.sides
    assert exact.ok.all()
    assert s.over(f"effort.{drive}")[0] == pytest.approx(exact.worst("effort", drive)[0], rel=1e-12)
    assert s.answers.after["reaction.A"][0] == pytest.approx(after["reaction.A"], rel=1e-9)
    assert not (before["reaction.A"] == after["reaction.A"]).all()


ENGINE = """
parameters: {r: 45 mm, l: 3*r}
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [r, 0]}}
  rod: {points: {A: [0, 0], B: [l, 0]}, mass: 1 kg}
  piston: {points: {B: [0, 0]}, mass: 1 kg}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  guide: {type: slider, links: [ground, piston], at: [O, B], direction: 0}
drives: {O: {position: 30, speed: 10 rad/s}}
assembly: {rod: 0}
"""


def test_curves_of_a_sweep_on_axes() -> None:
    """Their places, values and labels: over the cycle, over values in the reader's unit, over values that are texts."""
    from matplotlib.figure import Figure

    def lines(s: da.Sweep, *asked: Any) -> Any:
        ax = Figure().subplots()
        s.plot(*asked, ax=ax)
        return ax, [np.array(line.get_data()) for line in ax.lines], [line.get_label() for line in ax.lines]

    s = da.sweep(FOUR_BAR, COUPLER, [3 * LBF, 1 * LBF], positions=4, outputs=["effort.O2", "reaction.A"])
    ax, drawn, names = lines(s, "reaction.A")
    assert names == ["13.3447 N", "4.44822 N"]
    for (x, y), force in zip(drawn, s["reaction.A"], strict=True):
        assert x == pytest.approx(np.degrees(s.nominal.drive_position("O2")))
        assert y == pytest.approx(np.hypot(*force.T) / LBF)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("O2 in °", "Force in lbf")
    ax, ((x, y),), names = lines(s, "effort.O2", "peak")
    assert (x.tolist(), ax.get_xlabel()) == (pytest.approx([1, 3]), f"{COUPLER} in lbf"), "by rising values"
    assert y == pytest.approx(s.over("effort.O2")[::-1] / LBF / INCH)
    one = da.sweep(FOUR_BAR, {COUPLER: [10.0, 20.0, 40.0], ROCKER: [5.0, 6.0]}, positions=1)
    _, drawn, names = lines(one, "effort.O2")
    assert names == ["5 N", "6 N"]
    for k, (x, y) in enumerate(drawn):
        assert x == pytest.approx(np.array([10, 20, 40]) / LBF)
        assert y == pytest.approx(np.abs(one["effort.O2"][:, k, 0]) / LBF / INCH)
    moved = da.sweep(FOUR_BAR, "drives.O2.position", [[0.0, 0.2, 0.3], [1.0, 1.1, 1.5]], outputs="effort.O2")
    ax, drawn, _ = lines(moved, "effort.O2")
    assert [x.tolist() for x, _ in drawn] == [[1, 2, 3]] * 2
    assert ax.get_xlabel() == "position"
    ax, ((x, _),), _ = lines(moved, "effort.O2", "rms")
    assert (x.tolist(), ax.get_xlabel()) == ([1, 2], "drives.O2.position")
    angles = [plots._positions(of, Shown(of.nominal, Notation()))[2] for of in (s, moved)]
    assert [*angles, plots._values(moved, Shown(moved.nominal, Notation()))[2]] == [True, False, False]
    grid = da.sweep(FOUR_BAR, {COUPLER: [10.0, 20.0], ROCKER: [5.0]}, positions=4, outputs="effort.O2")
    _, drawn, names = lines(grid, "effort.O2")
    assert names == ["10 N, 5 N", "20 N, 5 N"]
    for (_, y), effort in zip(drawn, grid["effort.O2"][:, 0], strict=True):
        assert y == pytest.approx(effort / LBF / INCH)
    many = da.sweep(FOUR_BAR, COUPLER, np.arange(1.0, 14.0), positions=3, outputs="effort.O2")
    ax, _, names = lines(many, "effort.O2")
    assert names == [f"{k} N" for k in (1, 3, 6, 8, 11, 13)]
    assert "effort.O2 by links.coupler.weight, 6 of 13 curves" in {
        t.text for t in many.plot("effort.O2").texts()
    }


def test_a_parameter_is_swept_by_its_name() -> None:
    s = da.sweep(da.loads(ENGINE), "r", ["40 mm", "50 mm"])
    alone = [da.dynamics(da.loads(ENGINE.replace("45 mm", f"{r} mm"))).effort("O") for r in (40, 50)]
    assert s["effort.O"] == pytest.approx(np.array(alone), rel=1e-12)
    assert (s.labels["r"].values, s.labels["r"].unit) == (pytest.approx((0.04, 0.05)), "m")


@pytest.mark.parametrize("path", ["w", "drives.O.speed"])
@pytest.mark.parametrize("first", [0.0, 10.0])
def test_inertia_counts_whichever_design_is_first(
    path: str, first: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = ENGINE.replace("l: 3*r", "l: 3*r, w: 5 rad/s").replace("10 rad/s", "w")
    m = da.loads(text if path == "w" else ENGINE)
    monkeypatch.setattr(design_sweep, "MANY", 2)
    s = da.sweep(m, path, [first, 20.0, 5.0])
    alone = [da.solve(m.with_values({path: w})).effort("O") for w in (first, 20.0, 5.0)]
    assert s["effort.O"] == pytest.approx(np.array(alone), rel=1e-9, abs=1e-12)
    assert abs(s["effort.O"][1, 0] / s["effort.O"][2, 0]) == pytest.approx(16)
    assert "reaction_moment.guide" in s.answers.arrays
    assert "reaction_moment.A" not in s.answers.arrays


def test_curves_of_a_sweep() -> None:
    s = da.sweep(FOUR_BAR, COUPLER, [f"{k} lbf" for k in range(1, 10)], positions=12)
    assert list(s.plot("effort.O2").numbers) == ["1 lbf", "3 lbf", "4 lbf", "6 lbf", "7 lbf", "9 lbf"]
    peak = s.plot("effort.O2", "peak")
    assert peak.numbers["peak of effort.O2"] == pytest.approx(s.over("effort.O2") / LBF / INCH)
    texts = {t.text for t in peak.texts()}
    assert {"links.coupler.weight in lbf", "Torque in lbf·in"} <= texts
    grid = da.sweep(FOUR_BAR, {COUPLER: [30.0, 10.0], ROCKER: [5.0, 6.0, 7.0]}, outputs="reaction.A")
    drawn = grid.plot("reaction.A", "mean").numbers
    assert list(drawn) == ["5 N", "6 N", "7 N"]
    assert drawn["6 N"] == pytest.approx(grid.over("reaction.A", "mean")[::-1, 1] / LBF), "by rising values"
    both = da.sweep(FOUR_BAR, {COUPLER: [30.0, 10.0], ROCKER: [5.0, 6.0]}, together=True, outputs="effort.O2")
    assert list(both.plot("effort.O2").numbers) == ["peak of effort.O2"]
    moved = da.sweep(FOUR_BAR, "drives.O2.position", [[0.0, 0.2], [1.0, 1.1]], outputs="effort.O2")
    assert "position" in {t.text for t in moved.plot("effort.O2").texts()}


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        (lambda: da.sweep(FOUR_BAR, "links.couple.weight", [1]), "did you mean 'coupler'?"),
        (lambda: da.sweep(FOUR_BAR, COUPLER, [1, -2]), "-2 is negative; write a positive one, or 0"),
        (lambda: da.sweep(FOUR_BAR, COUPLER), "a sweep needs values for its path"),
        (lambda: da.sweep(FOUR_BAR, COUPLER, "3 lbf"), "a sweep needs values for its path"),
        (lambda: da.sweep(FOUR_BAR, COUPLER, []), "needs at least one value for each path"),
        (
            lambda: da.sweep(FOUR_BAR, {COUPLER: [1, 2], ROCKER: [1]}, together=True),
            "2 of links.coupler.weight, 1 of",
        ),
        (
            lambda: da.sweep(FOUR_BAR, {COUPLER: range(9999), ROCKER: range(9999)}),
            "99980001 designs are too many",
        ),
        (lambda: da.sweep(FOUR_BAR, COUPLER, [1.0], outputs="efort.O2"), "did you mean 'effort.O2'?"),
        (
            lambda: da.sweep(FOUR_BAR, COUPLER, [1]).plot("effort.O2", "peek"),
            "no curve is drawn of 'peek'; there are",
        ),
        (
            lambda: da.sweep(FOUR_BAR, COUPLER, [1.0])["angle.rocker"],
            "'angle.rocker' is not an output of this sweep; name it in outputs=",
        ),
    ],
)
def test_what_is_no_sweep_is_refused(ask: Any, said: str) -> None:
    with pytest.raises(da.ModelError) as refused:
        ask()
    assert said in str(refused.value)


def test_progress_is_told_and_may_stop_it() -> None:
    told: list[tuple[int, int]] = []
    da.sweep(FOUR_BAR, COUPLER, [1, 2, 3], progress=lambda done, of: told.append((done, of)))
    assert told == [(1, 3), (2, 3), (3, 3)]

    def stop(done: int, of: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        da.sweep(FOUR_BAR, COUPLER, [1, 2, 3], progress=stop)


def test_of_many_curves_six_are_drawn_in_their_order_and_counted() -> None:
    s = da.sweep(FOUR_BAR, COUPLER, [f"{k} lbf" for k in range(1, 61)], positions=2, outputs="effort.O2")
    scene = s.plot("effort.O2")
    assert list(scene.numbers) == [f"{k} lbf" for k in (1, 13, 25, 36, 48, 60)]
    assert scene.title == f"effort.O2 by {COUPLER}, 6 of 60 curves"
    few = da.sweep(FOUR_BAR, COUPLER, ["1 lbf", "2 lbf"], positions=3, outputs="effort.O2")
    assert few.plot("effort.O2").title == f"effort.O2 by {COUPLER}"
    assert list(few.plot("effort.O2").numbers) == ["1 lbf", "2 lbf"]


@pytest.mark.parametrize(("against", "step"), [("angle.rocker", 15.0), ("angle.rocker.speed", None)])
def test_only_angles_have_the_ticks_of_angles(against: str, step: float | None) -> None:
    """Multiples of 15 degrees and no tens of others."""
    r = da.dynamics(FOUR_BAR, positions=24)
    scene = r.plot("effort.O2", against=against)
    ticks = [t.text.replace("−", "-") for t in scene.texts() if t.role == "note" and t.at[1] == -3.2]
    values = np.array([float(text) for text in ticks])
    assert len(values) >= 3
    assert (values % 15 == 0).all() == (step is not None)
