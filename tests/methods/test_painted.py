"""Bars, balls and tubes on paper: what is filled, what is lined, and where, seen straight from the side."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
import pytest

from dalembert.reports.report_context import as_formula
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.scene import Circle, Line, Polygon
from dalembert.views.space.camera import Camera
from dalembert.views.space.painter import LONGEST, DepthItem, _cuts, _cylinder, _tube, _wire
from dalembert.views.space.solids import GlassTube, RoundBar
from dalembert.views.space.space_mechanism import _off, mark_center

SIDE = Camera(0.0, 0.0)
"""Along x: y runs to the right of the paper, z up."""
Y = np.array([0.0, 1.0, 0.0])


def taken(pieces: Iterable[DepthItem]) -> list[tuple[float, Any]]:
    """Depth and items of each."""
    return [(piece.depth, piece.items) for piece in pieces]


def bar(length: float, slope: float = 0.0, whole: bool = False) -> RoundBar:
    """Along y, its end turned towards the eye by an angle."""
    end = length * np.array([math.sin(slope), math.cos(slope), 0.0])
    return RoundBar(np.zeros(3), end, 1.0, "solid", whole)


@pytest.mark.parametrize("slope", [0.3, -0.3])
@pytest.mark.parametrize("capped", [True, False])
def test_a_bar_is_filled_from_end_to_end(slope: float, capped: bool) -> None:
    """Two pieces: the far one with its round end, the near one with the end that is seen."""
    pieces = sorted(taken(_cylinder(bar(4.0, slope), SIDE, capped)), key=lambda p: p[0])
    assert len(pieces) == 2
    far, near = (items for _, items in pieces)
    roles = [[item.role for item in some] for some in (far, near)]
    edges = ["solid-edge", "solid-edge"]
    if capped:
        assert roles == [
            ["solid-fill", "solid-fill", *edges, "solid-edge"],
            ["solid-fill", *edges, "solid-top"],
        ]
    else:
        assert roles == [["solid-fill", "solid-fill", *edges], ["solid-fill", "solid-fill", *edges]]
    length = 4.0 * math.cos(slope)
    lines = [
        item for some in (far, near) for item in some if isinstance(item, Line) and len(item.points) == 2
    ]
    assert sorted({round(abs(y), 9) for line in lines for _, y in line.points}) == [1.0]
    ends = sorted(x for line in lines for x, _ in line.points)
    assert (ends[0], ends[-1]) == (pytest.approx(0.0, abs=1e-9), pytest.approx(length))
    filled = [item for some in (far, near) for item in some if isinstance(item, Polygon)]
    xs = [x for item in filled for x, _ in item.points]
    reach = abs(math.sin(slope))  # of the round ends, seen aslant
    assert min(xs) == pytest.approx(-reach, abs=0.02)
    assert max(xs) == pytest.approx(length + reach, abs=0.02)
    depths = [depth for depth, _ in pieces]
    middle = 2.0 * math.sin(abs(slope))
    assert depths[1] - depths[0] == pytest.approx(middle, abs=1e-9)


def test_a_bar_seen_from_its_end_is_its_round_end() -> None:
    (piece,) = taken(_cylinder(RoundBar(np.zeros(3), np.array([3.0, 0, 0]), 1.0), SIDE))
    depth, (cap,) = piece
    assert depth == pytest.approx(3.0)
    assert cap.role == "solid-top"
    assert np.hypot(*np.array(cap.points).T) == pytest.approx(1.0)
    assert list(_cylinder(RoundBar(np.zeros(3), np.zeros(3), 1.0), SIDE)) == []


@pytest.mark.parametrize(
    ("length", "whole", "count"),
    [
        (0.99 * LONGEST, False, 1),
        (1.01 * LONGEST, False, 2),
        (4.5 * LONGEST, False, 5),
        (9 * LONGEST, True, 1),
    ],
)
def test_what_is_long_is_cut_into_even_pieces(length: float, whole: bool, count: int) -> None:
    found = _cuts(np.array([1.0, 0, 0]), np.array([1.0, length, 0]), whole)
    assert found == pytest.approx(np.array([1.0, 0, 0]) + np.linspace(0, length, count + 1)[:, None] * Y)
    pieces = taken(_wire(np.array([[0.0, 0, 0], [0.0, length, 0]]), "wire", SIDE))
    if not whole:
        assert [items[0].points for _, items in pieces] == [
            tuple(map(tuple, found[k : k + 2][:, 1:] + 0.0)) for k in range(count)
        ]


def test_a_tube_is_two_rings_and_two_lines() -> None:
    pieces = taken(_tube(GlassTube(np.zeros(3), 2.0 * Y, 1.0, "tube"), SIDE))
    lines = np.array([items[0].points for _, items in pieces])
    along = lines[np.abs(np.diff(lines[:, :, 0], axis=1)[:, 0]) > 1.9]
    assert sorted(along[:, 0, 1]) == pytest.approx([-1.0, 1.0])
    ends = lines[np.abs(np.diff(lines[:, :, 0], axis=1)[:, 0]) < 1e-9]
    assert sorted({round(x, 9) for x in ends[:, 0, 0]}) == [0.0, 2.0]
    assert np.abs(ends[:, :, 1]).max() == pytest.approx(1.0)
    assert not any(isinstance(item, Circle) for _, items in pieces for item in items)


@pytest.mark.parametrize(
    ("sign", "formula"),
    [("F", "$F$"), ("F_{12}", "$F_{12}$"), ("O2", "O2"), ("AB", "AB"), ("α", "$α$"), ("rod", "rod")],
)
def test_a_sign_with_an_index_or_alone_is_a_formula(sign: str, formula: str) -> None:
    assert as_formula(sign) == formula


@pytest.mark.parametrize(
    ("place", "off"),
    [((3.0, 4.0), 4.0), ((-3.0, 4.0), 5.0), ((9.0, -4.0), 5.0), ((6.0, 0.0), 0.0), ((0.0, 0.5), 0.5)],
)
def test_how_far_a_place_is_from_a_straight_piece(place: tuple[float, float], off: float) -> None:
    """Of six units, in any direction; beside it, and beyond its ends."""
    for angle in (0.0, 0.7, 2.5, -1.6):
        c, s = math.cos(angle), math.sin(angle)

        def at(p: tuple[float, float], c: float = c, s: float = s) -> tuple[float, float]:
            return 2 + c * p[0] - s * p[1], s * p[0] + c * p[1] - 1

        assert _off(at(place), at((0.0, 0.0)), at((6.0, 0.0))) == pytest.approx(off, abs=1e-12)
    assert _off((3.0, 4.0), (0.0, 0.0), (0.0, 0.0)) == 5.0


@pytest.mark.parametrize(("off", "line"), [(2.9, False), (3.1, True)])
def test_a_mass_centre_beside_its_link_has_a_line_to_the_nearest_place(off: float, line: bool) -> None:
    canvas = Canvas()
    mark_center(canvas, (4.0, off), [(0.0, 0.0), (6.0, 0.0), (20.0, 0.0)])
    lines = [item for item in canvas.items if isinstance(item, Line) and item.role == "construction"]
    assert [item.points for item in lines] == ([((4.0, off), (6.0, 0.0))] if line else [])
