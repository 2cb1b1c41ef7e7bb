"""Where labels are tried, what a place costs, which is taken, and words broken into lines, by hand in mm."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from dalembert.views.notation import pretty
from dalembert.views.paper.canvas import (
    Canvas,
    Label,
    _candidates,
    _leader,
    _Placer,
    crossings,
    extents,
    overlapping,
    segments,
)
from dalembert.views.paper.lettering import (
    BOLD,
    break_lines,
    letters_width,
    pieces,
    plain,
    text_box,
    text_width,
    unbroken,
)
from dalembert.views.paper.scene import Arc, Arrow, Circle, Group, Line, Polygon, Scene, Text


def test_places_around_two_points_go_round_from_the_direction_that_is_preferred() -> None:
    """24 at each distance; the box stands beside its point, and the second point costs a fifth of a millimetre."""
    label = Label("x", ((1.0, 2.0), (10.0, -5.0)), math.pi / 2, 3.0, "text", True)
    at, near, gap = _candidates(label, 4.0, 2.0, (0.9, 1.6))
    assert at.shape == near.shape == (96, 2)
    assert near[:48] == pytest.approx(np.tile([1, 2], (48, 1)))
    assert near[48:] == pytest.approx(np.tile([10, -5], (48, 1)))
    assert gap.tolist() == pytest.approx([0.9] * 24 + [1.6] * 24 + [1.1] * 24 + [1.8] * 24)
    assert at[0] == pytest.approx([1, 2 + 0.9 + 2])  # above
    assert at[6] == pytest.approx([1 - 0.9 - 4, 2])  # to the left
    assert at[12] == pytest.approx([1, 2 - 0.9 - 2])
    assert at[48 + 24 + 18] == pytest.approx([10 + 1.6 + 4, -5])
    slanted = math.radians(90 + 15)
    c, s = math.cos(slanted), math.sin(slanted)
    assert at[1] == pytest.approx([1 + 0.9 * c + 1.5 * c * 4, 2 + 0.9 * s + 2])
    plain_label = Label("x", ((1.0, 2.0),), None, 3.0, "text", True)
    assert _candidates(plain_label, 4.0, 2.0, (0.9,))[0][0] == pytest.approx([1 + 0.9 + 4, 2])


def test_a_place_against_the_preferred_direction_costs_up_to_four_millimetres() -> None:
    placer = _Placer([])
    label = Label("x", ((0.0, 0.0),), math.pi / 3, 3.0, "text", True)
    ways = np.array(
        [(math.cos(math.pi / 3 + t), math.sin(math.pi / 3 + t)) for t in (0, math.pi / 2, math.pi)]
    )
    assert placer._preference(label, 5 * ways, 0 * ways) == pytest.approx([0, 2, 4])
    free = Label("x", ((0.0, 0.0),), None, 3.0, "text", True)
    assert placer._preference(free, 5 * ways, 0 * ways).tolist() == [0, 0, 0]


def placed(*texts: str, around: Any = (), **options: Any) -> list[Any]:
    canvas = Canvas()
    canvas.add(*around)
    for text in texts:
        canvas.label(text, (0.0, 0.0), **options)
    return list(canvas.scene(heading=False).items[len(around) :])


def test_a_label_stands_in_the_first_free_place_and_the_next_beside_it() -> None:
    width = text_width("AB", 3.0) / 2
    first, second = placed("AB", "AB", prefer=0.0)
    assert first.at == pytest.approx((0.9 + width, 0.0))
    assert second.at != first.at
    boxes = np.array([first.box, second.box])
    assert not overlapping(boxes[:1], boxes[1:]).any()
    (low,) = placed("A_{1}", prefer=0.0)
    assert low.at[1] == pytest.approx(0.21)  # a twelfth of its size for what hangs below
    (bold,) = placed("AB", prefer=0.0, role="title")
    assert bold.at[0] == pytest.approx(0.9 + BOLD * width)
    assert placed("") == []


def test_a_label_that_is_led_far_away_has_a_line_to_its_place() -> None:
    """A disc of lines of 11 mm around its place leaves room only beyond; without a leader allowed, none is drawn."""
    wall = [Circle((0.0, 0.0), 0.4 * k, "link") for k in range(1, 28)]
    text, line = placed("AB", around=wall, prefer=math.pi / 2)
    assert text.at[1] > 11.2
    assert line.role == "leader"
    assert line.points[1] == (0.0, 0.0)
    edge = (np.clip(0.0, text.box[0], text.box[2]), text.at[1] - 0.65 * 3 - 0.25)
    assert line.points[0][1] == pytest.approx(edge[1])
    assert len(placed("AB", around=wall, prefer=math.pi / 2, leads=False)) == 1
    assert _leader(np.array([1.0, 2.0]), np.array([3.0, -4.0, 5.0, 1.0])).points == ((3.0, 1.0), (1.0, 2.0))


def test_what_has_no_room_and_what_is_too_short_is_named_below() -> None:
    canvas = Canvas()
    canvas.add(*(Line(((-90.0, 0.7 * k), (90.0, 0.7 * k)), "link") for k in range(-90, 91)))
    canvas.label("A 1", (0.0, 0.0))
    canvas.label("B", (0.0, 0.0))
    canvas.label_below("C = 3 N")
    scene = canvas.scene("Head", notes=["Note"])
    notes = [t for t in scene.texts() if t.role == "note"]
    assert [t.text for t in notes] == [
        "Note",
        "Too short for a label: C = 3 N",
        "Without room for a label: A 1, B",
    ]
    bottom = -63.0
    assert np.array([t.at for t in notes]) == pytest.approx(
        np.array([(-90.0, bottom - 4 - 4 * k) for k in range(3)])
    )
    (head,) = (t for t in scene.texts() if t.role == "title")
    assert head.at == pytest.approx((-90.0, 63.0 + 4.5))
    assert (head.size, head.anchor) == (3.6, "start")
    again = canvas.scene("Head", heading=False)
    assert len(again.items) == len(scene.items)  # labels are placed once


def test_a_long_title_stands_in_lines_above_each_other() -> None:
    canvas = Canvas()
    canvas.add(Line(((0.0, 0.0), (10.0, 5.0)), "link"))
    words = [f"word{k}" for k in range(12)]
    scene = canvas.scene(" ".join(words), least=60.0)
    heads = [t for t in scene.texts() if t.role == "title"]
    assert len(heads) > 1
    assert " ".join(t.text for t in heads[::-1]).split() == words  # the last line is the lowest
    assert np.array([t.at for t in heads]) == pytest.approx(
        np.array([(0.0, 9.5 + 4.8 * k) for k in range(len(heads))])
    )
    assert all(text_width(t.text, 3.6 * BOLD) <= 60.0 for t in heads)


def test_space_that_is_kept_clear_has_no_label_and_is_not_drawn() -> None:
    canvas = Canvas()
    canvas.keep_clear(Line(((0.0, -50.0), (0.0, 50.0)), "link"), Line(((-50.0, 0.0), (50.0, 0.0)), "link"))
    canvas.label("AB", (0.0, 0.0), prefer=0.0)
    (text,) = canvas.scene(heading=False).items
    assert isinstance(text, Text)
    left, bottom, right, top = text.box
    assert left > 0 or right < 0
    assert bottom > 0 or top < 0


# strokes and boxes


def test_strokes_are_pieces_of_outlines() -> None:
    items: list[Any] = [
        Line(((0.0, 0.0), (1.0, 2.0), (3.0, 1.0)), "link"),
        Group((Arrow((5.0, 5.0), (6.0, 7.0), "load"), Text((0.0, 0.0), "no stroke"))),
        Polygon(((0.0, 0.0), (4.0, 0.0), (0.0, 3.0)), "block"),
        Polygon(((9.0, 9.0), (8.0, 9.0), (9.0, 8.0)), "missing-fill"),
    ]
    assert segments(items).tolist() == [
        [[0, 0], [1, 2]],
        [[1, 2], [3, 1]],
        [[5, 5], [6, 7]],
        [[0, 0], [4, 0]],
        [[4, 0], [0, 3]],
        [[0, 3], [0, 0]],
    ]
    round_ = segments([Circle((1.0, 2.0), 3.0, "pin")])
    assert np.hypot(*(round_ - [1, 2]).reshape(-1, 2).T) == pytest.approx(3.0)
    assert round_[0, 0] == pytest.approx(round_[-1, 1])
    arc = Arc((1.0, 2.0), 3.0, 0.2, 0.3, "pin")
    assert segments([arc])[0] == pytest.approx(np.array(arc.points[:2]))
    assert segments([Text((0.0, 0.0), "a")]).shape == (0, 2, 2)
    assert extents(segments(items))[:, 1].tolist() == [1, 1, 3, 2]


def test_boxes_that_touch_do_not_overlap_and_strokes_that_touch_do() -> None:
    box = np.array([[0.0, 0.0, 4.0, 2.0]])
    others = [(4, 0, 5, 2), (3.9, 0, 5, 2), (0, 2, 4, 3), (0, 1.9, 4, 3), (-1, -1, 0, 3), (1, 0.5, 2, 1)]
    assert overlapping(box, np.array(others, float)).tolist() == [[False, True, False, True, False, True]]
    strokes = [
        ((4, -1), (4, 3)), ((4.1, -1), (4.1, 3)), ((5, 1), (3, 3)), ((5.1, 1), (3.1, 3)), ((1, 1), (2, 1)),
        ((-2, -1), (-1, 5)), ((0, 2), (-3, 9)), ((-1, 1), (5, 1)),
    ]  # fmt: skip
    met = crossings(box, np.array(strokes, float))
    assert met.tolist() == [[True, False, True, False, True, False, True, True]]


# letters


def test_letters_at_three_levels_and_their_widths() -> None:
    assert [tuple(p) for p in pieces("F_{12}^{n} = a_b^c")] == [
        ("F", 0),
        ("12", -1),
        ("n", 1),
        (" = a_b^c", 0),
    ]
    assert plain("F_{12}^{n} a_b") == "F_12^n a_b"
    assert letters_width("Ai ") == pytest.approx(0.684 + 0.278 + 0.318)
    assert letters_width("−ẋ") == pytest.approx(0.838 + 0.75)
    assert text_width("A_{i}", 5.0) == pytest.approx(5 * (0.684 + 0.72 * 0.278))
    width = 3 * 0.684
    assert text_box((10.0, 20.0), "A", 3.0, "start") == pytest.approx((10, 20 - 1.68, 10 + width, 21.56))
    assert text_box((10.0, 20.0), "A", 3.0, "end") == pytest.approx((10 - width, 20 - 1.68, 10, 21.56))
    assert text_box((10.0, 20.0), "A", 3.0, "middle", True) == pytest.approx(
        (10 - 0.56 * width, 18.32, 10 + 0.56 * width, 21.56)
    )
    low = text_box((10.0, 20.0), "A_{i}", 3.0, "start")
    assert (low[1], low[3]) == pytest.approx((20 - 1.98, 21.56))


def test_lines_are_as_wide_as_allowed() -> None:
    wide = text_width("one two", 3.0)
    assert break_lines("one two three", 3.0, wide) == ["one two", "three"]
    assert break_lines("one two three", 3.0, wide - 1e-9) == ["one", "two", "three"]
    assert break_lines("  one   two ", 3.0, 99.0) == ["one two"]
    assert break_lines("", 3.0, 99.0) == []
    assert break_lines(f"{unbroken('one two')} three", 3.0, 1.0) == ["one two", "three"]


def test_units_are_printed_with_raised_powers() -> None:
    assert [pretty(u) for u in ("N*m", "kg*m^2", "m/s^2", "10^-3 N", "deg/s", "lbf")] == [
        "N·m",
        "kg·m²",
        "m/s²",
        "10⁻³ N",
        "°/s",
        "lbf",
    ]


def test_a_scene_without_labels_is_as_it_was_built() -> None:
    canvas = Canvas()
    item = Line(((0.0, 0.0), (200.0, 5.0)), "link")
    canvas.add(item)
    scene = canvas.scene("Title", notes=["a note"], scales={"length": 2.0}, numbers={"a": 1})
    assert scene.items[0] is item
    assert (scene.title, scene.scales, scene.numbers) == ("Title", {"length": 2.0}, {"a": 1})
    assert Scene(scene.items).bounds[0] == 0.0
