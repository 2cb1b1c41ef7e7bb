"""Tables of designs as files have them; distributions, scatter diagrams and lines of equal value as drawn."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.studies import study_file
from dalembert.studies.output.study_views import axis_label, contour, histogram_scene, scatter_scene
from dalembert.studies.study_file import _pair, _table
from dalembert.views.paper.scene import Circle, Line, Polygon, Scene


@pytest.mark.parametrize(
    ("text", "columns"),
    [
        (
            "stroke [mm],bore [mm]\n50,40\n60,45.5\n",
            {"stroke": ["50 mm", "60 mm"], "bore": ["40 mm", "45.5 mm"]},
        ),
        ("\ufeff a , b [ N*m ]\n\n 1 ,-2e3\n , \n3,+4\n", {"a": ["1", "3"], "b": ["-2e3  N*m", "+4  N*m"]}),
        ('"a"\n"7"\n', {"a": ["7"]}),
    ],
)
def test_a_table_has_a_value_of_each_path_with_its_unit(
    text: str, columns: dict[str, list[str]], tmp_path: Path
) -> None:
    """What is empty is passed over, blanks are too."""
    (tmp_path / "t.csv").write_text(text, encoding="utf-8")
    found = _table(tmp_path / "t.csv")
    assert {k: [" ".join(x.split()) for x in v] for k, v in found.items()} == {
        k: [" ".join(x.split()) for x in v] for k, v in columns.items()
    }


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("a,b\n", 1, "the table has no designs; write a head, `stroke [mm], bore [mm]`, and rows"),
        ("", 1, "the table has no designs; write a head, `stroke [mm], bore [mm]`, and rows"),
        ("\na,\n1,2\n", 2, "a head is empty or occurs twice; write `path [unit]` once each"),
        ("a [m],a [mm]\n1,2\n", 1, "a head is empty or occurs twice; write `path [unit]` once each"),
        ("a,b\n1,2\n3,\n", 3, "'' is not a number; write one, its unit in the head"),
        ("a,b\n1,2\n\n3,4 m\n", 4, "'4 m' is not a number; write one, its unit in the head"),
        ("a,b\n1,2\n3\n", 3, "the row has 1 numbers, but there are 2 heads; give one below each"),
        ("a,b\n1,2,3\n", 2, "the row has 3 numbers, but there are 2 heads; give one below each"),
    ],
)
def test_a_table_that_cannot_be_read_is_refused_at_its_line(
    text: str, line: int, said: str, tmp_path: Path
) -> None:
    path = tmp_path / "t.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ModelError) as refused:
        _table(path)
    assert str(refused.value) == f"{path}:{line}: {said}"


def test_a_table_that_is_none_or_too_large_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "t.csv"
    with pytest.raises(
        ModelError, match=r"^cannot read .*t\.csv: no such file or directory; name a \.csv file$"
    ):
        _table(path)
    path.write_bytes(b"a\n\xff\n")
    with pytest.raises(ModelError, match=r"^cannot read .*t\.csv: it is not utf-8; name a \.csv file$"):
        _table(path)
    path.write_text("a\n1\n")
    monkeypatch.setattr(study_file, "LARGEST", 4)
    assert _table(path) == {"a": ["1"]}
    monkeypatch.setattr(study_file, "LARGEST", 3)
    with pytest.raises(ModelError, match="is larger than 0 MB; leave designs out"):
        _table(path)


def test_a_correlation_names_two_paths() -> None:
    assert _pair(("stroke , bore", 0.5)) == (("stroke", "bore"), 0.5)
    for names in ("stroke", "a, b, c"):
        with pytest.raises(ModelError, match=f"^'{names}' names no two paths; write 'stroke, bore': 0.5$"):
            _pair((names, 0.5))


def studied(**options: Any) -> Any:
    """The torque of a level arm is its weight times its reach."""
    arm = {
        "gravity": [0, -10],
        "links": {
            "ground": {"points": {"O": [0, 0]}},
            "arm": {"points": {"O": [0, 0]}, "mass": "2 kg", "center": [0.25, 0]},
        },
        "joints": {"O": {"type": "pin", "links": ["ground", "arm"]}},
        "drives": {"O": {"position": 0}},
    }
    return da.study(
        da.mechanism(arm), {"links.arm.mass": "1..3 kg"}, ["effort.O"], designs=400, seed=3, **options
    )


def of(scene: Scene, kind: type, *roles: str) -> list[Any]:
    return [item for item in scene.items if isinstance(item, kind) and item.role in roles]


def test_a_distribution_is_drawn_with_its_percentiles_and_limits_over_its_full_height() -> None:
    r = studied(limits={"effort.O": "2.5..9 N*m"}).run()
    scene = histogram_scene(r, "effort.O")
    assert scene.title == "Distribution of effort.O"
    bars = of(scene, Polygon, "bar")
    counts, edges = r.histogram("effort.O")
    assert len(bars) == (counts > 0).sum()
    floor, tops = bars[0].points[0][1], [bar.points[2][1] for bar in bars]
    heights = np.abs(np.array(tops) - floor)
    assert heights / heights.max() == pytest.approx(counts[counts > 0] / counts.max())
    lines = [
        line
        for line in of(scene, Line, "curve-1", "curve-2", "curve-3")
        if line.points[0][0] == line.points[1][0]
    ]
    across = [line for line in lines if abs(line.points[1][1] - line.points[0][1]) >= heights.max()]
    assert len(across) == len(lines) == 5
    assert {line.points[0][1] for line in lines} == {floor}
    left, right = (bars[k].points[n][0] for k, n in ((0, 0), (-1, 1)))
    first, last = edges[np.flatnonzero(counts)[[0, -1]] + [0, 1]]
    places = [first + (line.points[0][0] - left) / (right - left) * (last - first) for line in lines]
    known: dict[str, list[float]] = {line.role: [] for line in lines}
    for line, place in zip(lines, places, strict=True):
        known[line.role].append(place)
    percent = r.percentiles("effort.O", (5.0, 50.0, 95.0))
    assert known["curve-1"] == pytest.approx([percent[50.0]])
    assert known["curve-3"] == pytest.approx([percent[5.0], percent[95.0]])
    assert known["curve-2"] == pytest.approx([2.5, 9.0])


def test_a_scatter_diagram_has_a_dot_for_each_design_with_a_value() -> None:
    r = studied().run()
    r.arrays["effort.O"][7] = np.nan
    scene = scatter_scene(r, "effort.O", "links.arm.mass")
    dots = np.array([circle.center for circle in of(scene, Circle, "curve-1")])
    assert len(dots) == 399
    masses = np.delete(r.study.plan.values(0, 400)[:, 0], 7)
    for column, values in ((dots[:, 0], masses), (np.abs(dots[:, 1]), masses)):
        assert abs(np.corrcoef(column, values)[0, 1]) == pytest.approx(1.0)
    assert scene.title == "Designs: effort.O over links.arm.mass"
    texts = [getattr(item, "text", "") for item in scene.items]
    assert "The first 399 that have one" in texts


def test_an_axis_has_its_unit_where_there_is_one() -> None:
    from dalembert.analysis.output.summary.printed_units import Printed

    to = Printed(da.four_bar().with_values({"units": {"length": "mm"}}).units)
    assert axis_label(to, "links.rod.points.B.0", "length") == "links.rod.points.B.0 in mm"
    assert axis_label(to, "mu", "number") == "mu"


def test_lines_of_equal_value_cross_the_triangles_of_each_cell() -> None:
    """Of 2 x + 3 y on cells that are not square, at 7: a straight line; of unsolved cells there is none."""
    x, y = np.array([0.0, 1.0, 3.0]), np.array([0.0, 2.0, 3.0])
    z = 2 * x[:, None] + 3 * y[None]
    pieces = contour(x, y, z, 7.0)
    for (a, b), (c, d) in pieces:
        assert 2 * a + 3 * b == pytest.approx(7.0)
        assert 2 * c + 3 * d == pytest.approx(7.0)
    ends = sorted(p for piece in pieces for p in piece)
    assert ends[0] == pytest.approx((0.0, 7 / 3))
    assert ends[-1] == pytest.approx((3.0, 1 / 3))
    assert sum(np.hypot(c - a, d - b) for (a, b), (c, d) in pieces) == pytest.approx(np.hypot(3, 2))
    assert contour(x, y, z, 7.0)[:1] == pieces[:1]
    z[0, 1] = np.nan
    left = contour(x, y, z, 7.0)
    assert all(min(a, c) >= 1.0 for (a, _), (c, _) in left)
    assert len(left) < len(pieces)
    assert contour(x, y, z, 99.0) == []
    saddle = np.array([[0.0, 1.0], [1.0, 0.0]])
    points = sorted(p for piece in contour(x[:2], y[:2], saddle, 0.25) for p in piece)
    assert points == [(0.0, 0.5), (0.25, 0.0), (0.75, 2.0), (1.0, 1.5)]
