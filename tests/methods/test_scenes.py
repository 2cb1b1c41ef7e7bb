"""Primitives on paper: their boxes, moved, as data and in rows; frames and scales in round numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest

from dalembert.views.paper.frame import PaperFrame, fit_frame, force_scale, round_up
from dalembert.views.paper.scene import (
    Arc,
    Arrow,
    Circle,
    Group,
    Item,
    Line,
    Polygon,
    Scene,
    Text,
    along,
    around,
    item_box,
    shift_item,
    stack_scenes,
)

LINE = Line(((1.0, 2.0), (4.0, 0.0), (3.0, 7.0)), "spring")
EACH: list[tuple[Item, tuple[float, float, float, float]]] = [
    (LINE, (1, 0, 4, 7)),
    (Polygon(((1.0, 2.0), (4.0, 0.0), (3.0, 7.0)), "block"), (1, 0, 4, 7)),
    (Circle((3.0, -1.0), 2.0, "pin"), (1, -3, 5, 1)),
    (Arrow((5.0, 1.0), (2.0, 6.0), "load", "F", "force", 7.0), (2, 1, 5, 6)),
    (Arc((1.0, 1.0), 3.0, 0.0, math.pi / 2, "load", True, "T", 5.0), (1, 1, 4, 4)),
]


@pytest.mark.parametrize(("item", "box"), EACH, ids=lambda v: type(v).__name__)
def test_a_primitive_s_box_moves_with_it(item: Item, box: tuple[float, float, float, float]) -> None:
    assert item_box(item) == pytest.approx(box)
    moved = shift_item(item, 10.0, -20.0)
    assert item_box(moved) == pytest.approx((box[0] + 10, box[1] - 20, box[2] + 10, box[3] - 20))
    rest = Scene((item, moved)).to_dict()["items"]
    places = {"points", "center", "tail", "head"}
    first, second = ({k: v for k, v in tree.items() if k not in places} for tree in rest)
    assert first == second
    assert first["primitive"] == type(item).__name__.lower()
    group = Group((item, Group((item,), "inner")), "outer")
    both = shift_item(group, 10.0, -20.0)
    assert both == Group((moved, Group((moved,), "inner")), "outer")
    scene = Scene((group, moved))
    assert list(scene.flat()) == [item, item, moved]
    assert scene.bounds == pytest.approx((box[0], box[1] - 20, box[2] + 10, box[3]))
    assert scene.to_dict()["items"][0]["items"][1]["name"] == "inner"


def test_texts_move_as_they_are() -> None:
    text = Text((1.0, 2.0), "a_{b}", 2.6, "note", "end")
    moved = shift_item(text, 1.0, 1.0)
    assert moved == Text((2.0, 3.0), "a_{b}", 2.6, "note", "end")
    left, bottom, right, top = item_box(text)
    assert right == 1.0
    assert left < 0.5
    assert item_box(Text((1.0, 2.0), "a_{b}", 2.6, "note", "start"))[0] == 1.0
    middle = item_box(Text((1.0, 2.0), "a_{b}", 2.6))
    assert (middle[0] + middle[2]) / 2 == pytest.approx(1.0)
    bold = item_box(Text((1.0, 2.0), "a_{b}", 2.6, "title"))
    assert bold[2] - bold[0] > middle[2] - middle[0] == pytest.approx(right - left)
    assert bottom < 2.0 < top
    assert Scene(()).bounds == (0.0, 0.0, 0.0, 0.0)
    assert repr(Scene((text, Group((text,))), "t")) == "<Scene 't': 2 items>"


@pytest.mark.parametrize(("start", "end"), [(0.3, 0.35), (0.0, 1.5), (2.0, -4.0)])
def test_an_arc_s_points_are_close_and_on_it(start: float, end: float) -> None:
    """At most 0.15 rad apart, evenly, with both ends."""
    arc = Arc((1.0, 2.0), 3.0, start, end)
    points = np.array(arc.points)
    turn = np.unwrap(np.arctan2(*(points - [1, 2]).T[::-1]))
    assert np.hypot(*(points - [1, 2]).T) == pytest.approx(3.0)
    assert turn - turn[0] == pytest.approx(np.linspace(0, end - start, len(points)))
    assert arc.points[0] == arc.at(start) == pytest.approx((1 + 3 * math.cos(start), 2 + 3 * math.sin(start)))
    assert len(points) == max(2, math.ceil(abs(end - start) / 0.15) + 1)


def test_places_along_a_line_and_around_a_point() -> None:
    assert along((1.0, 2.0), (5.0, 0.0), 0.0, 0.25, 1.5) == [(1, 2), (2, 1.5), (7, -1)]
    four = around((1.0, 2.0), 3.0, 4, math.pi / 2)
    assert np.array(four) == pytest.approx(np.array([(1, 5), (-2, 2), (1, -1), (4, 2)]))
    assert around((0.0, 0.0), 1.0, 2)[0] == (1.0, 0.0)
    assert Arrow((0.0, 0.0), (3.0, 4.0)).length == 5.0


def test_panels_stand_in_rows_below_each_other() -> None:
    """Each with its upper edge on that of its row; 8 mm apart; no row is wider than told unless one panel is."""
    sizes = {"a": (50.0, 20.0), "b": (60.0, 35.0), "c": (40.0, 10.0), "d": (120.0, 15.0)}
    scenes = [
        Scene((Line(((7.0, 3.0), (7.0 + w, 3.0 + h))),), name, {"force": float(k)}, {"n": k})
        for k, (name, (w, h)) in enumerate(sizes.items())
    ]
    stacked = stack_scenes(scenes, width=118.0, title="all")
    boxes = {g.name: Scene(g.items).bounds for g in stacked.items if isinstance(g, Group)}
    assert boxes == {
        "a": (0, -20, 50, 0),
        "b": (58, -35, 118, 0),
        "c": (0, -53, 40, -43),
        "d": (0, -76, 120, -61),
    }
    assert stacked.title == "all"
    assert stacked.scales == {f"{n}: force": float(k) for k, n in enumerate("abcd")}
    assert stacked.numbers == {n: {"n": k} for k, n in enumerate("abcd")}
    wider = stack_scenes(scenes[:2], gap=9.0, width=118.0)
    assert [Scene(g.items).bounds[0] for g in wider.items if isinstance(g, Group)] == [0, 0]


@pytest.mark.parametrize(
    ("value", "plain"),
    [
        (1.0, 1),
        (1.01, 2),
        (2.0, 2),
        (2.1, 2.5),
        (2.6, 5),
        (5.1, 10),
        (0.031, 0.05),
        (730, 1000),
        (1e-7, 1e-7),
    ],
)
def test_numbers_are_rounded_up_to_a_round_one(value: float, plain: float) -> None:
    assert round_up(value) == plain
    assert round_up(value * (1 + 1e-13)) == plain  # what is above by rounding is not above
    assert [round_up(x) for x in (0.0, -3.0, math.inf, math.nan)] == [1.0] * 4


def test_a_frame_holds_all_places_at_a_round_scale() -> None:
    """A width of 0.5 m on 100 mm asks for 5 mm, a height of 0.33 m on 50 mm for 6.6 mm: 8 mm for one."""
    places = [(0.1, 0.0), (0.6, 0.33), (math.nan, 5.0)]
    frame = fit_frame(places, 100.0, 50.0)
    assert frame == PaperFrame(0.008, (0.35, 0.165))
    assert frame((0.6, 0.33)) == pytest.approx((31.25, 20.625))
    assert frame.line(np.array(places[:2])) == (
        pytest.approx((-31.25, -20.625)),
        pytest.approx((31.25, 20.625)),
    )
    assert frame.length(0.04) == pytest.approx(5.0)
    inches = fit_frame(places, 100.0, 50.0, 0.0254)  # 6.6 mm are 0.26 in: 0.3 in for one
    assert inches.per_mm == pytest.approx(0.3 * 0.0254)
    assert fit_frame([(2.0, 3.0)], 100.0, 50.0) == PaperFrame(0.001, (2.0, 3.0))
    assert fit_frame([(math.nan, 1.0)], 100.0, 50.0) == PaperFrame(1.0)
    assert force_scale([20.0, 130.0, math.inf], 40.0) == 4.0  # 3.25 N for 1 mm
    assert force_scale([20.0, 130.0], 40.0, 4.448) == pytest.approx(0.8 * 4.448)
    assert force_scale([], 40.0, 2.0) == force_scale([0.0, math.nan], 40.0, 2.0) == 2.0
