"""The page of a study, and its drawings: as data, against the numbers they show."""

from __future__ import annotations

import re
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.studies import StudyResult, running
from dalembert.studies.contributions import ResponseCurve
from dalembert.studies.output import study_report
from dalembert.studies.output.study_views import contour, histogram_scene, response_scene, scatter_scene
from dalembert.views.paper.diagrams import SIZE, ticks
from dalembert.views.paper.scene import Circle, Line, Polygon, Text
from tests.studies.test_answers import ARM, arm


def four_bar(**options: Any) -> StudyResult:
    vary = {"links.coupler.mass": "± 5 %", "links.crank.points.A.0": "uniform ± 2 %"}
    given = {"designs": 200, "seed": 3, "positions": 12, **options}
    return da.study(da.four_bar(), vary, ["effort.O2"], **given).run()


def test_contours_run_where_the_function_has_their_value() -> None:
    """Of a linear function exactly; each piece lies in its cell."""
    x, y = np.linspace(0, 3, 7), np.linspace(-1, 1, 5)
    z = 2 * x[:, None] - 3 * y[None]
    for level in (-1.3, 0.4, 2.0):
        points = np.array(contour(x, y, z, level)).reshape(-1, 2)
        assert len(points) > 4
        assert np.abs(2 * points[:, 0] - 3 * points[:, 1] - level).max() < 1e-12
    assert contour(x, y, z, 99.0) == []


def test_bars_hold_every_design_and_lines_stand_at_their_values() -> None:
    r = four_bar(limits={"effort.O2": "< 6 N*m"})
    counts, _ = r.histogram("effort.O2")
    scene = histogram_scene(r, "effort.O2")
    heights = [max(y for _, y in p.points) for p in scene.flat() if isinstance(p, Polygon)]
    assert counts.sum() == 200
    assert np.array(heights) / max(heights) == pytest.approx(counts[counts > 0] / counts.max())
    lines = [
        p for p in scene.flat() if isinstance(p, Line) and p.role.startswith("curve") and p.points[0][1] == 0
    ]
    assert len(lines) == 4  # median, 5 and 95 %, and the limit
    dots = [p for p in scatter_scene(r, "effort.O2", r.study.paths[0]).flat() if isinstance(p, Circle)]
    assert len(dots) == 200
    many = arm(designs=1001).run()
    dots = [p for p in scatter_scene(many, "effort.O", "heavy").flat() if isinstance(p, Circle)]
    assert len(dots) == 1000


def test_a_response_is_the_analysis_of_each_design() -> None:
    r = four_bar()
    found = r.study.response("effort.O2", "links.crank.points.A.0", count=5)
    assert found.axes[0][[0, -1]] == pytest.approx(r.study.plan.spreads[1].ends)
    for value, peak in zip(found.axes[0], found.values, strict=True):
        design = da.four_bar().with_values({"links.crank.points.A.0": float(value)})
        assert np.abs(da.solve(design, positions=12).effort("O2")).max() == pytest.approx(peak, rel=1e-10)
    two = r.study.response("effort.O2", *r.study.paths, count=4)
    assert two.values.shape == (4, 4)
    assert (
        response_scene(r, two).title
        == "Response of effort.O2 to links.coupler.mass and links.crank.points.A.0"
    )
    with pytest.raises(da.ModelError, match="does not vary"):
        r.study.response("effort.O2", "links.rocker.mass")


def test_lines_of_a_response_lie_where_it_has_their_values() -> None:
    """Of a plane over three masses and four lengths, of which the first design has no value: its cell is grey."""
    r = four_bar(designs=8, positions=2)
    paths = r.study.paths
    x, y = np.array([1.0, 2.0, 4.0]), np.array([1.1, 1.2, 1.3, 1.6])
    z = x[:, None] + 10 * y
    gap = z.copy()
    gap[0, 0] = np.nan
    scene = response_scene(r, ResponseCurve("effort.O2", paths, (x, y), gap))
    (width, height), (low, high) = SIZE, (ticks(1.1, 1.6)[0], ticks(1.1, 1.6)[-1])
    places = {
        role: np.array([p.points for p in scene.flat() if isinstance(p, (Line, Polygon)) and p.role == role])
        for role in ("missing-fill", "curve-1")
    }
    along = {role: 1 + 3 * at[..., 0] / width for role, at in places.items()}
    across = {role: low + (high - low) * at[..., 1] / height for role, at in places.items()}
    assert along["missing-fill"].tolist() == [pytest.approx([1, 2, 2, 1])]
    assert across["missing-fill"].tolist() == [pytest.approx([1.1, 1.1, 1.2, 1.2])]
    found = along["curve-1"] + 10 * across["curve-1"]
    assert len(found) > 10
    assert found[:, 0] == pytest.approx(found[:, 1])
    levels = {f"{level:.9g}" for level in found[:, 0]}
    assert {"14", "15", "16", "17", "18"} <= levels <= {str(level) for level in range(13, 21)}
    assert {"14", "15", "16", "17", "18"} <= {p.text for p in scene.flat() if isinstance(p, Text)}


def test_capability_is_the_distance_of_the_nearer_limit() -> None:
    """Of T = m g c + F with limits at equal distances both count; three sigma to the nearer one is Cpk 1."""
    r = arm().run()
    mean, sigma = (float(of(r.values("effort.O"))) for of in (np.mean, np.std))
    assert r.capability("effort.O", f"< {mean + 3 * sigma} N*m") == pytest.approx(1.0, rel=1e-9)
    both = f"{mean - 2 * sigma}..{mean + 9 * sigma} N*m"
    assert r.capability("effort.O", both) == pytest.approx(2 / 3, rel=1e-9)


def test_equal_values_are_capable_where_they_keep_the_limit() -> None:
    """The couple of a level arm is 2 kg g 0.3 m + 5 N m, whatever changes elsewhere."""
    m = da.loads(ARM.replace("P: [1, 0]", "P: [1, 0], Q: [size, 0]").replace("{heavy", "{size: 1 m, heavy"))
    r = da.study(m, {"size": "± 5 %"}, ["effort.O"], designs=2).run()
    value = float(r["effort.O"][0])
    assert value == pytest.approx(6 * 9.80665 / 10 + 5)
    for limit, capability in (
        ("< 10.9 N*m", np.inf),
        ("< 10.8 N*m", -np.inf),
        (f"<= {value!r} N*m", np.inf),
        ("10.9..11 N*m", -np.inf),
    ):
        assert r.capability("effort.O", limit) == capability


def test_the_page_says_what_the_designs_say(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    s = da.study(
        da.load(examples()["pump"]),
        {"stroke": "± 0.5 mm", "pressure": "5.5..6.5 MPa"},
        ["effort.O", "reaction.A"],
        designs=300,
        limits={"effort.O": "< 380 N*m"},
    )
    r = s.run(tmp_path / "p.zarr")
    assert main(["study", "show", str(tmp_path / "p.zarr"), "--report", str(tmp_path / "p.txt")]) == 0
    text = (tmp_path / "p.txt").read_text()
    for said in (
        f"{r.share('effort.O', '< 380 N*m'):.4%}",
        f"{r.capability('effort.O', '< 380 N*m'):.3f}",
        f"least: design {r.best('effort.O')}",
        f"greatest: design {r.worst('effort.O')}",
        "Worst case",
        "[drawing: Response of effort.O to pressure and stroke]",
        "several numbers a design or none: reaction.A",
    ):
        assert said in " ".join(text.split()) or said in text, said
    assert main(["study", "show", str(tmp_path / "p.zarr"), "--report", str(tmp_path / "p.txt")]) == 2
    assert "p.txt" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (
            {"correlation": {("links.coupler.mass", "links.crank.points.A.0"): 0.5}},
            "No contributions: shares of",
        ),
        ({"reduce": "argpeak"}, "No contributions: reduced by argpeak"),
        ({"reduce": None}, "several numbers a design or none: effort.O2"),
        ({"draw": {"links.coupler.mass": [1.0, 2.0, 3.0]}}, "The designs of a table of links.coupler.mass"),
    ],
)
def test_pages_of_other_studies(options: dict[str, Any], said: str) -> None:
    vary = {} if "draw" in options else {"links.coupler.mass": "± 5 %", "links.crank.points.A.0": "± 2 %"}
    r = da.study(da.four_bar(), vary, ["effort.O2"], designs=20, positions=12, **options).run()
    assert said in " ".join(str(r.report()).split())


def test_a_page_of_designs_that_fail() -> None:
    """A crank that grows until the loop is open: those are counted with their sentence, and keep no limit."""
    vary = {"links.crank.points.A.0": "0.08..0.3 m"}
    r = da.study(da.four_bar(), vary, ["effort.O2"], designs=60, limits={"effort.O2": "< 1 kN*m"}).run()
    failed = 60 - int(r.ok.sum())
    assert 0 < failed < 60
    text = str(r.report())
    assert re.search(rf"not_assembled\s+{r.counts()['not_assembled']}\s", text)
    assert "First: design" in " ".join(text.split())
    assert r.shares()["effort.O2 < 1 kN*m"] <= 1 - failed / 60
    assert text.count("[drawing: Response of ") == 1, "of one number"


def test_shares_on_the_page_are_those_of_the_study() -> None:
    """Linear and Sobol's, each in a column, and how many are left out."""
    r = four_bar(designs=8)
    text = " ".join(str(r.report()).split())
    assert "Shares of the variance of effort.O2" in text
    assert "number linear Sobol Sobol, with interactions" in text
    for path, share in r.study.contributions("effort.O2").shares.items():
        assert f"{path} {share:.2%}" in text


@pytest.mark.parametrize("paths", [["links.coupler.mass"] * 2, [], list("abc")])
def test_a_response_is_to_one_or_two_different_numbers(paths: list[str]) -> None:
    s = da.study(da.four_bar(), {"links.coupler.mass": "± 5 %"}, ["effort.O2"], designs=8, positions=4)
    with pytest.raises(da.ModelError, match=r"one or two different ones|does not vary"):
        s.response("effort.O2", *paths, count=3)


@pytest.mark.parametrize("level", [5.0, -5.0, 0.0])
def test_values_that_differ_by_rounding_stand_in_one_bar(level: float) -> None:
    """Of whichever sign: the intervals are then one unit wide in all, about them."""
    values = np.full(7, level) * (1 + 1e-16 * np.arange(7)) + np.linspace(0, 4e-16, 7) * abs(level)
    few: Any = SimpleNamespace(values=lambda name: values)
    counts, ends = StudyResult.histogram(few, "x", 5)
    assert counts.tolist() == [0, 0, 7, 0, 0]
    assert ends[[0, -1]] == pytest.approx([level - 0.5, level + 0.5])
    for off in (
        (-3e-12, 3e-12) if level else ()
    ):  # one value alone, below or above the others by more than rounding
        few.values = lambda name, off=off: np.append(np.full(9, level), level + off * abs(level))
        assert sorted(StudyResult.histogram(few, "x", 5)[0].tolist()) == [0, 0, 0, 1, 9]
    few.values = lambda name: np.append(values, level + 1)
    assert StudyResult.histogram(few, "x", 5)[0].tolist() == [7, 0, 0, 0, 1]


def test_bars_of_one_value_have_an_axis_about_it() -> None:
    vary = {"links.coupler.mass": "± 5 %"}
    r = da.study(da.four_bar(), vary, ["angle.rocker"], designs=8, positions=3).run()
    scene = histogram_scene(r, "angle.rocker")
    (bar,) = (p for p in scene.flat() if isinstance(p, Polygon))
    xs = sorted({x for x, _ in bar.points})
    lines = [i for i in scene.flat() if isinstance(i, Line) and i.role == "axis"]
    right = max(x for line in lines for x, _ in line.points)
    assert 0.0 < xs[0] < xs[-1] < right


@pytest.mark.parametrize("value", [True, False, None])
def test_what_is_no_quantity_is_no_level(value: object) -> None:
    with pytest.raises(da.ModelError, match="is not a quantity; write a number with its unit"):
        da.study(da.four_bar(), {"links.coupler.mass": [1.0, value]}, ["effort.O2"], designs=4)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_design_is_drawn_where_its_output_is_largest_in_magnitude(
    sign: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Twice as much at the second position as at the third, either way round."""
    m = da.loads(f"""
links: {{ground: {{points: {{O: [0, 0]}}}}, arm: {{points: {{O: [0, 0], A: [1, 0]}}}}}}
joints: {{O: {{type: pin, links: [ground, arm]}}}}
drives: {{O: {{position: [0, 90 deg, 180 deg, 270 deg]}}}}
loads: {{M: {{type: couple, on: arm, value: "{sign}*(1 - 3*sin(O)) N*m"}}}}
""")
    r = da.study(m, {"links.arm.points.A.0": "0.9..1.1 m"}, ["effort.O"], designs=4).run()
    effort = r.study.answer(m)["effort.O"]
    assert effort == pytest.approx(sign * np.array([-1.0, 2.0, -1.0, -4.0]))
    drawn: list[int] = []
    mechanism = study_report.draw.mechanism

    def recorded(result: Any, at: int) -> Any:
        drawn.append(at)
        return mechanism(result, at)

    monkeypatch.setattr(study_report.draw, "mechanism", recorded)
    assert str(r.report())
    assert set(drawn) == {4}


def test_a_study_is_kept_in_memory_up_to_a_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    """One design's bytes for each."""
    s = da.study(da.four_bar(), {"links.coupler.mass": "± 5 %"}, ["effort.O2"], designs=20, positions=12)
    size = 20 * sum(a.nbytes for a in s.block(0, 1)[0].values())
    monkeypatch.setattr(running, "IN_MEMORY", size)
    assert s.run().ok.all()
    monkeypatch.setattr(running, "IN_MEMORY", size - 1)
    with pytest.raises(da.ModelError, match=r"the results take 0\.0 GB; give run"):
        s.run()


def test_a_limit_beside_all_designs_is_drawn_where_it_is() -> None:
    """The axis reaches from the least design or limit to the greatest; bars in the middle of wide limits are narrow."""
    widths = []
    for limits in ({}, {"effort.O2": "-1000 N*m .. 1000 N*m"}):
        scene = histogram_scene(four_bar(limits=limits), "effort.O2")
        xs = [x for p in scene.flat() if isinstance(p, Polygon) for x, _ in p.points]
        axis = [x for p in scene.flat() if isinstance(p, Line) and p.role == "axis" for x, _ in p.points]
        assert min(axis) <= min(xs) < max(xs) <= max(axis)
        widths.append((max(xs) - min(xs)) / (max(axis) - min(axis)))
    assert widths[0] > 0.9
    assert widths[1] < 0.1
