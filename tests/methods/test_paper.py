"""Paper: frames and scales in round numbers, panels in rows, labels beside what they name and over nothing."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from dalembert.views.paper.canvas import LEADER, Canvas, crossings, overlapping, segments
from dalembert.views.paper.frame import FINE, PaperFrame, fit_frame, force_scale, round_up
from dalembert.views.paper.lettering import (
    BOLD,
    SMALL,
    break_lines,
    letters_width,
    pieces,
    plain,
    text_box,
    text_width,
)
from dalembert.views.paper.scene import (
    Arc,
    Arrow,
    Circle,
    Group,
    Line,
    Polygon,
    Scene,
    Text,
    item_box,
    stack_scenes,
)


@pytest.mark.parametrize(
    ("points", "factor", "frame"),
    [
        ([(0, 0), (2.6, 1), (math.nan, 9), (9, math.nan)], 1.0, PaperFrame(0.03, (1.3, 0.5))),
        ([(0, 0), (-1, 2.6)], 1.0, PaperFrame(0.04, (-0.5, 1.3))),
        ([(1, 1), (1, 1.75)], 1.0, PaperFrame(0.01, (1, 1.375))),
        ([(0, 0), (25.4, 0)], 0.0254, PaperFrame(10 * 0.0254, (12.7, 0))),
        ([(2, 3), (2, 3)], 1.0, PaperFrame(0.001, (2, 3))),
        ([(math.nan, 0)], 1.0, PaperFrame(1.0)),
    ],
)
def test_a_frame_holds_all_points_at_a_round_scale(points: Any, factor: float, frame: PaperFrame) -> None:
    found = fit_frame(points, 100.0, 75.0, factor)
    assert (found.per_mm, *found.middle) == pytest.approx((frame.per_mm, *frame.middle))
    assert found((frame.middle[0] + 3, frame.middle[1] - 2)) == pytest.approx(
        (3 / frame.per_mm, -2 / frame.per_mm)
    )
    assert found.length(6.0) == pytest.approx(6.0 / frame.per_mm)


def test_scales_are_the_next_round_number() -> None:
    cases = {1.0: 1, 1.01: 2, 2.1: 2.5, 2.6: 5, 5.1: 10, 0.03: 0.05, 99.0: 100, 1e-7: 1e-7, 3e8: 5e8}
    assert {v: round_up(v) for v in cases} == cases
    assert [round_up(v) for v in (0.0, -3.0, math.nan, math.inf)] == [1.0] * 4
    assert [round_up(v, FINE) for v in (1.1, 3.5, 7.0, 9.0)] == [1.25, 4.0, 8.0, 10.0]
    assert force_scale([3.0, 410.0, math.inf, math.nan], 20.0) == 25.0
    assert force_scale([90.0], 20.0, factor=4.45) == pytest.approx(1.25 * 4.45)
    assert force_scale([0.0], 20.0, factor=4.45) == force_scale([], 20.0, 4.45) == 4.45


def test_widths_of_texts() -> None:
    assert letters_width("iW") == pytest.approx(0.278 + 0.989)
    assert letters_width("θ漢") == pytest.approx(0.612 + 0.75)
    assert text_width("F_{12}^{a} x", 10.0) == pytest.approx(
        10 * (letters_width("F x") + SMALL * letters_width("12a"))
    )
    assert pieces("a_b_{c}^{d}e") == [("a_b", 0), ("c", -1), ("d", 1), ("e", 0)]
    assert plain("F_{12}^{∥}") == "F_12^∥"
    wide = text_width("ab", 2.0)
    for anchor, left in (("start", 1.0), ("middle", 1.0 - wide / 2), ("end", 1.0 - wide)):
        assert text_box((1.0, 5.0), "ab", 2.0, anchor) == pytest.approx((left, 3.88, left + wide, 6.04))
    assert text_box((0, 0), "ab", 2.0, "start", bold=True)[2] == pytest.approx(wide * BOLD)
    assert text_box((0, 0), "a_{b}", 2.0, "start")[1] == pytest.approx(-1.32)
    assert text_box((0, 0), "a^{b}", 2.0, "start")[1] == pytest.approx(-1.12)
    assert Text((0, 0), "ab", 2.0, "title", "start").box[2] == pytest.approx(wide * BOLD)


def test_lines_are_broken_where_the_next_word_has_no_room() -> None:
    room = text_width("aa bb", 3.0)
    assert break_lines("aa bb cc ddddddddddd ee ff", 3.0, room) == ["aa bb", "cc", "ddddddddddd", "ee ff"]
    assert break_lines("aa bb", 3.0, room - 0.01) == ["aa", "bb"]
    assert break_lines("", 3.0, room) == []


ITEMS: Any = [
    (Line(((0, 0), (4, -3))), (0, -3, 4, 0)),
    (Polygon(((0, 0), (4, -3), (1, 7))), (0, -3, 4, 7)),
    (Circle((1, 2), 3), (-2, -1, 4, 5)),
    (Arrow((1, 2), (-3, 5)), (-3, 2, 1, 5)),
    (Arc((0, 0), 2, 0, math.pi / 2), (0, 0, 2, 2)),
    (Text((1, 2), "ab", 2.0, anchor="start"), (1, 0.88, 1 + text_width("ab", 2.0), 3.04)),
]


@pytest.mark.parametrize(("item", "box"), ITEMS, ids=lambda x: type(x).__name__)
def test_boxes_of_primitives_here_and_elsewhere(item: Any, box: Any) -> None:
    assert item_box(item) == pytest.approx(box)
    moved = Scene((Group((item,), "g"), item)).shift(10, -20)
    assert moved.bounds == pytest.approx((box[0] + 10, box[1] - 20, box[2] + 10, box[3] - 20))
    assert len(list(moved.flat())) == 2


def test_an_arc_is_drawn_from_its_start_to_its_end() -> None:
    for start, end in ((0.3, 2.0), (2.0, -1.0), (0.0, 0.1)):
        arc = Arc((1.0, 2.0), 3.0, start, end)
        points = np.array(arc.points) - arc.center
        assert np.hypot(*points.T) == pytest.approx(np.full(len(points), 3.0))
        turns = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
        assert turns == pytest.approx(np.linspace(start, end, len(points)))
        assert abs(turns[1] - turns[0]) <= 0.15 + 1e-9
        assert len(points) == max(2, math.ceil(abs(end - start) / 0.15) + 1)


def test_panels_stand_in_rows_below_each_other() -> None:
    def sheet(width: float, height: float, title: str) -> Scene:
        line = Line(((5.0, 7.0), (5.0 + width, 7.0 + height)))
        return Scene((line,), title, {"force": width}, {"n": height})

    scenes = [sheet(30, 10, "a"), sheet(40, 25, "b"), sheet(50, 5, "c"), sheet(120, 8, "d")]
    whole = stack_scenes(scenes, gap=6.0, width=100.0, title="all")
    boxes = [Scene(g.items).bounds for g in whole.items if isinstance(g, Group)]
    assert boxes == [(0, -10, 30, 0), (36, -25, 76, 0), (0, -36, 50, -31), (0, -50, 120, -42)]
    assert [g.name for g in whole.items if isinstance(g, Group)] == ["a", "b", "c", "d"]
    assert whole.title == "all"
    assert whole.scales == {"a: force": 30, "b: force": 40, "c: force": 50, "d: force": 120}
    assert whole.numbers == {"a": {"n": 10}, "b": {"n": 25}, "c": {"n": 5}, "d": {"n": 8}}
    assert stack_scenes([sheet(120, 8, "a")], width=100.0).bounds == (0, -8, 120, 0)
    exact = stack_scenes([sheet(47, 5, "a"), sheet(47, 5, "b")], gap=6.0, width=100.0)
    assert exact.bounds == pytest.approx((0, -5, 100, 0))


def test_boxes_that_strokes_and_boxes_touch() -> None:
    boxes = np.array([[0.0, 0.0, 4.0, 2.0], [10.0, 0.0, 14.0, 2.0]])
    strokes = {
        ((1, 1), (2, 1)): [True, False],  # inside
        ((-1, 1), (20, 1)): [True, True],
        ((2, -5), (2, 5)): [True, False],
        ((-3, 0), (1, 4)): [False, False],  # past a corner
        ((-1, 0), (1, 3)): [True, False],  # over the same corner
        ((5, 3), (9, -1)): [False, False],  # between them
        ((15, -1), (15, 3)): [False, False],
        ((9, 3), (13, 4)): [False, False],  # above
    }
    found = crossings(boxes, np.array(list(strokes), float))
    assert found.T.tolist() == list(strokes.values())
    assert crossings(boxes, np.array(list(strokes), float)[:, ::-1]).T.tolist() == list(strokes.values())
    other = np.array([[3.0, 1.0, 11.0, 5.0], [4.0, 0.0, 10.0, 2.0], [1.0, 0.5, 2.0, 1.0]])
    assert overlapping(boxes, other).tolist() == [[True, False, True], [True, False, False]]


def test_strokes_are_outlines_of_all_but_texts_and_areas_without_one() -> None:
    square = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
    inside: Any = (
        Polygon(square),
        Line(square),
        Arrow((0, 0), (3, 4)),
        Text((0, 0), "x"),
        Polygon(square, "a-fill"),
    )
    found = segments([Group(inside), Circle((5, 5), 2.0)])
    lengths = np.linalg.norm(found[:, 1] - found[:, 0], axis=1)
    assert lengths[:8] == pytest.approx([1, 1, 1, 1, 1, 1, 1, 5])
    assert lengths[8:].sum() == pytest.approx(4 * math.pi, rel=1e-2)
    assert found[8, 0] == pytest.approx(found[-1, 1])
    assert segments([]).shape == (0, 2, 2)


def placed(items: Any, text: str, *near: Any, **more: Any) -> tuple[Text, list[Line]]:
    canvas = Canvas()
    canvas.add(*items)
    canvas.label(text, *near, **more)
    scene = canvas.scene(heading=False)
    label = scene.texts()[-1]
    return label, [i for i in scene.items if isinstance(i, Line) and i.role == "leader"]


WIDE, HIGH = text_width("ab", 3.0) / 2, 0.65 * 3.0
"""Half of what a label of two letters takes."""


@pytest.mark.parametrize(
    ("prefer", "at"),
    [
        (0.0, (10.9 + WIDE, 20)),
        (math.pi, (9.1 - WIDE, 20)),
        (math.pi / 2, (10, 20.9 + HIGH)),
        (-math.pi / 2, (10, 19.1 - HIGH)),
        (math.pi / 4, (10 + 0.9 * math.sqrt(0.5) + WIDE, 20 + 0.9 * math.sqrt(0.5) + HIGH)),
    ],
)
def test_a_label_stands_beside_its_place_in_its_direction(prefer: float, at: Any) -> None:
    label, leaders = placed([], "ab", (10, 20), prefer=prefer)
    assert label.at == pytest.approx(at)
    assert leaders == []


def test_a_label_gives_way_to_strokes_and_texts() -> None:
    """It keeps the first of its places while there is room; lowered letters lift the line."""
    walls = [Line(((x, -9.0), (x, 9.0))) for x in range(1, 12)]
    assert placed(walls, "ab", (0, 0), prefer=0.0)[0].box[2] < 1.0
    word = Text((0.0, 3.0), "wide word", 3.0)
    assert placed([word], "ab", (0, 0), prefer=math.pi / 2)[0].at[1] < 0.6
    for near in (((0, 0), (50, 0)), ((50, 0), (0, 0))):
        assert abs(placed([], "ab", *near)[0].at[0] - near[0][0]) < 5
    turned = placed([], "a_{b}", (0, 0), prefer=0.0)[0]
    assert turned.at[1] == pytest.approx(0.21)


FENCE = [Line(((-9.0, y), (9.0, y))) for y in np.arange(-8.0, 9.0)]


def test_a_label_that_is_far_away_is_led_to_its_place() -> None:
    """By a line from the edge of its box that crosses no text; one that is not to be led has none."""
    label, (leader,) = placed(FENCE, "ab", (0, 0), prefer=0.0)
    left, low, right, high = label.box
    assert not crossings(np.array([label.box]), segments(FENCE)).any()
    edge, place = leader.points
    assert place == (0, 0)
    assert left - 0.3 <= edge[0] <= right + 0.3
    assert low - 0.6 <= edge[1] <= high + 0.6
    assert math.dist(edge, place) > LEADER
    beside, leaders = placed(FENCE, "ab", (0, 0), prefer=0.0, leads=False)
    assert (beside.at, leaders) == (label.at, [])
    blocks = [Text((0.0, 4.0), "I", 6.0), *FENCE]
    other, (way,) = placed(blocks, "ab", (0, 0), prefer=0.0)
    assert other.at != label.at
    assert not crossings(np.array([blocks[0].box]), np.array([way.points])).any()


def test_a_label_without_room_is_named_below() -> None:
    canvas = Canvas()
    canvas.add(*(Line(((-99.0, y), (99.0, y))) for y in np.arange(-99.0, 99.0)))
    canvas.label("ab", (0, 0))
    canvas.label("cd", (0, 0))
    canvas.label("", (0, 0))
    scene = canvas.scene("Title", notes=["A note"], numbers={"n": 1})
    assert [t.text for t in scene.texts()] == ["Title", "A note", "Without room for a label: ab, cd"]
    title, first, second = scene.texts()
    assert (title.role, title.at) == ("title", (-99.0, 102.5))
    assert (first.role, first.at, second.at) == ("note", (-99.0, -103.0), (-99.0, -107.0))
    assert scene.numbers == {"n": 1}


def test_long_titles_and_notes_are_as_wide_as_the_drawing_and_80_mm_at_least() -> None:
    for width in (20.0, 150.0):
        canvas = Canvas()
        canvas.add(Line(((0.0, 0.0), (width, 0.0))))
        scene = canvas.scene("word " * 60, notes=["note " * 80])
        titles, notes = ([t for t in scene.texts() if t.role == role] for role in ("title", "note"))
        for texts in (titles, notes):
            widths = [t.box[2] - t.box[0] for t in texts]
            assert max(width, 80.0) * 0.85 < max(widths) <= max(width, 80.0)
            assert len(texts) > 2
        assert [t.at[1] for t in sorted(titles, key=lambda t: -t.at[1])] == [t.at[1] for t in titles][::-1]
        assert np.diff([t.at[1] for t in notes]) == pytest.approx(-4.0)
