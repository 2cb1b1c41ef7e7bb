"""Branches of drawings that few machines meet: files in other forms, nothing to draw, sentences of what is missing."""

from __future__ import annotations

import re
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.views.charts import along
from dalembert.views.formats.animation import Animation, _frame_timing
from dalembert.views.formats.svg import MARGIN, _n, arc_head, arrow_parts
from dalembert.views.not_shown import doubts, has_reactions, on_one, refuse_still
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.frame import round_up
from dalembert.views.paper.scene import Arc, Circle, Group, Line, Scene, Text

TRUSS = da.statics(da.load(examples()["truss"]))


def test_a_structure_has_the_number_of_its_position_along_the_axis_of_a_chart() -> None:
    values, label, angle = along(TRUSS, Shown(TRUSS, Notation()))
    assert (values.tolist(), label, angle) == ([1.0], "position", False)


# files


def box(width: float, height: float, x: float = 0.0, y: float = 0.0) -> Line:
    return Line(((x, y), (x + width, y + height)), "link")


@pytest.mark.parametrize(("paper", "size"), [("a4", (210.0, 297.0)), ("letter", (215.9, 279.4))])
def test_a_drawing_is_broken_into_pages_of_a_pdf(
    paper: str, size: tuple[float, float], tmp_path: Path
) -> None:
    pytest.importorskip("matplotlib")
    panels = Group((box(150, 180),), "first"), Group((box(60, 200, 0, -220),), "second")
    path = tmp_path / "two.pdf"
    Scene(panels, "Two panels").save(path, paper=paper)
    data = path.read_bytes()
    boxes = re.findall(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", data)
    assert [tuple(round(float(x) * 25.4 / 72, 1) for x in one) for one in boxes] == [size, size]
    assert b"/Title (Two panels)" in data
    assert b"/CreationDate" not in data
    Scene(panels, "Two panels").save(path, overwrite=True)
    whole = re.findall(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", path.read_bytes())
    width, height = (float(x) * 25.4 / 72 for x in whole[0])
    assert len(whole) == 1
    assert (width, height) == pytest.approx((156, 406), abs=0.01)
    assert b"/CreationDate" not in path.read_bytes()


@pytest.mark.parametrize(
    ("name", "more", "said"),
    [
        ("a.svg", {"paper": "a4"}, "a.svg has no pages of a4; a .pdf has: a4 or letter"),
        ("a.pdf", {"paper": "a5"}, "a.pdf has no pages of a5; a .pdf has: a4 or letter"),
        ("a.svg", {"theme": "grey"}, "unknown theme 'grey'; choose light or dark or print"),
        ("a.bmp", {}, "a.bmp: drawings are not written as .bmp; use .svg, .pdf, .png or .dxf"),
        ("a", {}, "a: drawings are not written as that; use .svg, .pdf, .png or .dxf"),
    ],
)
def test_a_file_that_no_drawing_has_is_refused(
    name: str, more: dict[str, Any], said: str, tmp_path: Path
) -> None:
    with pytest.raises(da.ModelError) as refused:
        Scene((box(9, 9),)).save(tmp_path / name, **more)
    assert str(refused.value) == said
    assert not list(tmp_path.iterdir())


def test_a_drawing_shows_itself_in_a_notebook() -> None:
    scene = Scene((box(9, 9),), "Line")
    assert scene._repr_svg_() == scene.to_svg()
    assert 'width="15.00mm" height="15.00mm"' in scene.to_svg()
    film = Animation((box(9, 9),), (Scene((Text((0, 0), "a"),)), Scene((Text((20, 30), "b"),))), 3.0, "Film")
    assert film._repr_html_() == film.to_svg()
    with pytest.raises(da.ModelError) as refused:
        film.save("a.mp4")
    assert str(refused.value) == "a.mp4: animations cannot be written in this format; use .svg, .gif or .webp"


def test_a_film_has_room_for_all_of_its_frames_and_shows_each_in_its_part_of_the_time() -> None:
    places = [(0.0, -7.0), (30.0, 4.0), (-5.0, 21.0)]
    frames = tuple(Scene((Circle(at, 2.0, "mark"),)) for at in places)
    film = Animation((box(9, 8),), frames, 3.0, "Film")
    assert film.bounds == (-7.0, -9.0, 32.0, 23.0)
    text = film.to_svg()
    assert f'width="{39 + 2 * MARGIN:.2f}mm" height="{32 + 2 * MARGIN:.2f}mm"' in text
    groups = re.findall(r'<g visibility="(\w+)"><animate ([^>]*)/>(.*?)</g>', text)
    assert [g[0] for g in groups] == ["visible", "hidden", "hidden"]
    told = [re.search(r'values="(.*?)" keyTimes="(.*?)" dur="(.*?)"', g[1]) for g in groups]
    assert [t.groups() for t in told if t] == [
        ("visible;hidden", "0;0.33333", "3s"),
        ("hidden;visible;hidden", "0;0.33333;0.66667", "3s"),
        ("hidden;visible", "0;0.66667", "3s"),
    ]
    centers = [re.search(r'cx="(.*?)" cy="(.*?)"', g[2]) for g in groups]
    expected = [(_n(x + 7 + MARGIN), _n(23 + MARGIN - y)) for x, y in places]
    assert [c.groups() for c in centers if c] == expected
    assert text.index("<path") < text.index("<g ")  # what stands still lies behind
    assert 'values="hidden;visible;hidden" keyTimes="0;0.25;0.5" dur="1.5s"' in _frame_timing(1, 4, 1.5)
    assert 'values="hidden;visible" keyTimes="0;0.75"' in _frame_timing(3, 4, 1.5)


@pytest.mark.parametrize(
    ("length", "size"), [(40.0, 3.0), (4.0, 3.0), (3.0, 2.25), (1.0, 0.75), (0.06, 0.045)]
)
def test_the_head_of_a_short_arrow_is_three_quarters_of_it(length: float, size: float) -> None:
    """Its shaft ends in the head, which is 0.6 as wide as long."""
    e, across = np.array([0.6, -0.8]), np.array([0.8, 0.6])
    tail = np.array([2.0, 5.0])
    tip = tail + length * e
    (start, end), head = arrow_parts((2.0, 5.0), (float(tip[0]), float(tip[1])))
    assert start == (2.0, 5.0)
    assert end == pytest.approx(tuple(tip - 0.8 * size * e))
    corners = [tip, tip - size * e + 0.3 * size * across, tip - size * e - 0.3 * size * across]
    assert np.array(head) == pytest.approx(np.array(corners))


def test_an_arrow_of_no_length_has_no_head() -> None:
    assert arrow_parts((1.0, 2.0), (1.0, 2.04)) == (((1.0, 2.0), (1.0, 2.04)), ())
    assert arrow_parts((1.0, 2.0), (1.0, 2.06))[1] != ()


@pytest.mark.parametrize(("radius", "size"), [(10.0, 2.55), (2.0, 1.8)])
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_the_head_of_an_arc_ends_at_its_end_along_it(radius: float, size: float, way: float) -> None:
    arc = Arc((1.0, 2.0), radius, 0.3, 0.3 + way * 2.0, "effort", True)
    tip, *sides = np.array(arc_head(arc))
    assert tip == pytest.approx(arc.at(0.3 + way * 2.0))
    middle = (sides[0] + sides[1]) / 2
    before = np.array(arc.at(0.3 + way * (2.0 - size / radius)))
    chord = tip - before
    assert (tip - middle) / np.hypot(*(tip - middle)) == pytest.approx(chord / np.hypot(*chord))
    assert np.hypot(*(tip - middle)) == pytest.approx(min(3.0, 0.75 * 2 * np.hypot(*chord)))


# what cannot be drawn


def still(closed: list[bool], stability: Any = None, drives: tuple[str, ...] = ("O",)) -> Any:
    """A result of so many positions, of which some close."""
    places = np.where(np.array(closed)[:, None, None], 1.0, np.nan) * np.ones((len(closed), 3, 2))
    places[~np.array(closed), 0] = 1.0  # a part of a mechanism that does not close may stand
    return SimpleNamespace(
        drives=drives, stability=stability, status=("ok",) * len(closed), point_array=places
    )


@pytest.mark.parametrize(
    ("r", "said"),
    [
        (
            still([True, False, False]),
            "a film needs two positions, and 1 of 3 positions closes; see why: dalembert solve",
        ),
        (
            still([False, False]),
            "a film needs two positions, and no position closes; see why: dalembert solve",
        ),
        (still([False]), "a film needs two positions; ask for more: positions=36, or --positions 36"),
        (still([True]), "a film needs two positions; ask for more: positions=36, or --positions 36"),
        (
            still([True, True], stability=()),
            "a film shows a motion, and here are equilibrium positions; "
            "draw the mechanism, its free bodies or force polygons",
        ),
        (
            still([True, True], drives=()),
            "a film shows a motion, and a structure has none; "
            "draw the mechanism, its free bodies or force polygons",
        ),
    ],
)
def test_a_motion_needs_two_positions_that_close(r: Any, said: str) -> None:
    with pytest.raises(da.ModelError) as refused:
        refuse_still(r, "a film")
    assert str(refused.value) == said
    refuse_still(still([True, False, True]), "a film")


def test_reactions_in_doubt_are_named() -> None:
    free = {"A": [[np.nan, 1.0], [2.0, 3.0]], "B": [[4.0, 5.0], [6.0, 7.0]], "C": [[1.0, 1.0], [8.0, 9.0]]}
    unique = {"A": [[True, True]] * 2, "B": [[True, False], [True, True]], "C": [[True, True], [False, True]]}
    joints = {"A": ("ground", "bar"), "B": ("bar", "rod"), "C": ("rod", "ground")}
    r: Any = SimpleNamespace(
        least_norm=lambda n: np.array(free[n]),
        unique=lambda n: np.array(unique[n]),
        status=("singular", "redundant"),
        joints=tuple("ABC"),
        mechanism=SimpleNamespace(joints={n: SimpleNamespace(links=ends) for n, ends in joints.items()}),
    )
    assert doubts(r, 0, iter("ABC")) == [
        "Not unique, drawn with the least norm: the reactions of B.",
        "Not known (singular): the reactions of A.",
    ]
    assert doubts(r, 1, "ABC") == ["Not unique, drawn with the least norm: the reactions of C."]
    assert doubts(r, 1, "AB") == []
    assert [on_one(r, link) for link in ("ground", "bar", "rod")] == [["A", "C"], ["A", "B"], ["B", "C"]]
    assert [has_reactions(r, link, 0) for link in ("ground", "bar", "rod")] == [False, False, True]
    assert has_reactions(r, "bar", 1)


def test_beyond_the_last_step_a_round_number_is_the_next_power_of_ten() -> None:
    assert round_up(3.1, (1.0, 2.0, 3.0)) == 10.0
    assert round_up(0.0031, (1.0, 2.0, 3.0)) == 0.01
    assert round_up(3.0, (1.0, 2.0, 3.0)) == 3.0


def test_an_unknown_source_of_a_polygon_is_refused() -> None:
    r = da.statics(da.load(examples()["four_bar"]))
    with pytest.raises(da.ModelError, match="unknown source 'F_Q'; choose one of: F_P, T_4"):
        da.draw.force_polygon(r, "rocker", case="F_Q")


def test_the_ball_of_a_symbol_is_where_its_axes_begin() -> None:
    for camera in ("isometric", "front"):
        scene = da.draw.joint("spherical", camera)
        balls = [i for i in scene.items if isinstance(i, Circle) and i.role in ("inner", "outer")]
        assert balls
        assert all(ball.center == pytest.approx((0, 0), abs=1e-9) for ball in balls)


def test_names_of_joints_in_the_table_of_a_free_body_are_bold() -> None:
    r = da.dynamics(da.load(examples()["rssr"]))
    scene = da.draw.free_body(r, "rod", at=1)
    bold = [t.text for t in scene.texts() if t.role == "title" and t.size == 2.6]
    assert bold == ["A", "B"]


def test_pins_lie_on_wheels_whatever_their_order_in_the_file() -> None:
    tree = da.load(examples()["gear_train"]).to_tree()
    for order in (1, -1):
        tree["joints"] = dict([*tree["joints"].items()][::order])
        r = da.dynamics(da.mechanism(tree))
        roles = [getattr(i, "role", "") for i in da.draw.mechanism(r).items]
        assert max(k for k, role in enumerate(roles) if role == "pitch") < roles.index("pin")
