"""Belts, ropes and wedges as they are drawn: strands touch their wheels, bands are as wide as their tension says."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.paper.scene import Circle, Line, Polygon, Text
from dalembert.views.plane.elements.belt_drawings import (
    STEP,
    arc,
    belt_items,
    rope_items,
    strand,
    tangent,
    width_of,
)
from dalembert.views.plane.elements.wedge_drawing import wedge_corners, wedge_items

A, B = (3.0, -2.0), (23.0, 13.0)
FRAME = PaperFrame(0.01, (0.05, -0.02))


def middle_line(band: Polygon) -> tuple[Any, Any]:
    """Middle line of a band, and its width at each of its points."""
    points = np.array(band.points)
    left, right = points[: len(points) // 2], points[len(points) // 2 :][::-1]
    return (left + right) / 2, np.hypot(*(left - right).T)


@pytest.mark.parametrize(
    "radii", [(2.0, 5.0), (-2.0, -5.0), (2.0, -5.0), (-3.0, 4.0), (4.0, 4.0), (0.0, 3.0)]
)
def test_a_strand_touches_both_circles_on_its_left_where_the_radius_is_positive(
    radii: tuple[float, float],
) -> None:
    ends = np.array(tangent(A, B, *radii))
    along = (ends[1] - ends[0]) / math.dist(*ends)
    left = np.array([-along[1], along[0]])
    for end, center, radius in zip(ends, (A, B), radii, strict=True):
        assert end - center == pytest.approx(radius * left)
    assert math.dist(*ends) == pytest.approx(math.sqrt(25.0**2 - (radii[0] - radii[1]) ** 2))
    inside = tangent((0.0, 0.0), (1.0, 0.0), 5.0, 2.0)  # no strand touches both: no error
    assert np.isfinite(inside).all()


def test_a_band_is_as_wide_as_its_tension_says() -> None:
    """From 0.5 to 2.4 mm; 1 mm where no tension is known."""
    assert [width_of(t, 40.0) for t in (40.0, 20.0, 0.0, -5.0)] == [2.4, 1.45, 0.5, 0.5]
    assert [width_of(t, size) for t, size in ((5.0, 0.0), (math.nan, 40.0), (math.inf, 40.0))] == [1.0] * 3
    line, width = middle_line(strand(A, B, 1.6))
    assert line == pytest.approx(np.array([A, B]))
    assert width == pytest.approx([1.6, 1.6])
    across = np.subtract(*np.array(strand(A, B, 1.6).points)[[0, 3]])
    assert across @ np.subtract(B, A) == pytest.approx(0.0, abs=1e-9)
    assert strand(A, A, 1.0).points == ((3.0, -2.0),) * 4


@pytest.mark.parametrize(("ccw", "turn"), [(True, 250.0), (False, -110.0)])
def test_the_tension_changes_on_a_wheel_as_the_capstan_equation_says(ccw: bool, turn: float) -> None:
    """From 30 to 280 degrees about A, either way; equal angles change the width by equal factors."""
    start, end = ((A[0] + 9 * math.cos(t), A[1] + 9 * math.sin(t)) for t in np.radians([30.0, 280.0]))
    line, width = middle_line(arc(A, 4.0, start, end, ccw, (0.5, 2.0)))
    assert np.hypot(*(line - A).T) == pytest.approx(4.0)
    angle = np.unwrap(np.arctan2(*(line - A).T[::-1]))
    share = np.linspace(0, 1, len(line))
    assert np.degrees(angle) == pytest.approx(30.0 + turn * share)
    assert width == pytest.approx(0.5 * 4.0**share)
    assert abs(np.diff(angle)).max() <= STEP


def check_belt(m: Any, tight_above: bool) -> None:
    r = da.solve(m, positions=1)
    belt, joint = r.belt("belt"), m.joints["belt"]
    (wheel, spoke, other, _, lower, upper, first, second, mark) = belt_items(r, "belt", 0, FRAME)
    at = [np.array(FRAME(r.point(*place)[0])) for place in zip(joint.links, joint.at, strict=True)]
    for circle, center, radius in zip((wheel, other), at, joint.radii, strict=True):
        assert isinstance(circle, Circle)
        assert (*circle.center, circle.radius) == pytest.approx((*center, radius / 0.01))
    turned = float(r.angle(joint.links[0])[0])
    assert isinstance(spoke, Line)
    rim = at[0] + 6.0 * np.array([math.cos(turned), math.sin(turned)])
    assert np.array(spoke.points) == pytest.approx(np.array([at[0], rim]))
    lines = [middle_line(band) for band in (lower, upper)]
    tight, slack = float(belt.tight[0]), float(belt.slack[0])
    widths = [width_of(t, tight) for t in ((slack, tight) if tight_above else (tight, slack))]
    for (line, width), wanted, side in zip(lines, widths, (-1, 1), strict=True):
        assert width == pytest.approx([wanted] * 2)
        e = (line[1] - line[0]) / math.dist(*line)
        left = np.array([-e[1], e[0]])
        assert (line[0] - at[0]) @ left == pytest.approx(side * 6.0)
        assert (line[1] - at[1]) @ left == pytest.approx(side * 18.0 * (-1 if joint.crossed else 1))
        assert (line[0] - at[0]) @ e == pytest.approx(0.0, abs=1e-9)
    for band, center, ends in ((first, at[0], (lines[1], lines[0])), (second, at[1], (lines[0], lines[1]))):
        around, width = middle_line(band)
        which = 0 if band is first else 1
        assert around[0] == pytest.approx(ends[0][0][which])
        assert around[-1] == pytest.approx(ends[1][0][which])
        assert (width[0], width[-1]) == pytest.approx((ends[0][1][0], ends[1][1][0]))
        outwards = np.subtract(center, at[0] if band is second else at[1])
        assert (around[len(around) // 2] - center) @ outwards > 0  # away from the other wheel
        wrapped = np.unwrap(np.arctan2(*(around - center).T[::-1]))
        lean = math.asin((24.0 if joint.crossed else 12.0) / 50.0) * (1 if joint.crossed or which else -1)
        assert abs(wrapped[-1] - wrapped[0]) == pytest.approx(math.pi + 2 * lean)
    assert isinstance(mark, Text)
    assert mark.text == "T_{1}"
    line = lines[1 if tight_above else 0][0]
    e = (line[1] - line[0]) / math.dist(*line)
    beside = (np.array(mark.at) - line.mean(axis=0)) @ np.stack([e, [-e[1], e[0]]], axis=1)
    assert beside == pytest.approx([0.0, 3.0 if tight_above else -3.0], abs=1e-9)


@pytest.mark.parametrize("crossed", [False, True])
@pytest.mark.parametrize("torque", [-15.0, 15.0])
def test_a_belt_lies_on_its_wheels_and_names_its_tight_strand(crossed: bool, torque: float) -> None:
    tree = da.belt_drive().to_tree()
    tree["joints"]["belt"]["crossed"] = crossed
    (load,) = tree["loads"].values()
    load["value"] = torque
    m = da.mechanism(tree)
    r = da.solve(m, positions=1)
    check_belt(m, float(r.belt("belt").torque[0, 0]) < 0)


def test_a_rope_runs_from_wheel_to_wheel() -> None:
    """Strands touch their wheels on the side that the file says; an end without a wheel is on it."""
    r = da.solve(da.hoist(), positions=1)
    m = r.mechanism  # with its pulleys and strands
    (rope,) = m.ropes.values()
    names = [n for n, j in m.joints.items() if getattr(j, "rope", "") and j.WRAPPED]
    items = [rope_items(r, n, 0, FRAME) for n in names]
    assert not any(items[1:])  # all with the first strand
    places = [m.point(*p.round) if p.round[0] == "ground" else r.point(*p.round)[0] for p in rope.through]
    at = [np.array(FRAME(p)) for p in places]
    discs = [i for i in items[0] if isinstance(i, Circle)]
    wheels = [(c, p) for c, p in zip(at, rope.through, strict=True) if p.radius]
    assert [(*d.center, d.radius) for d in discs] == [pytest.approx((*c, p.radius / 0.01)) for c, p in wheels]
    bands = [i for i in items[0] if isinstance(i, Polygon)]
    count = len(rope.through) - 1
    tension = r.rope("rope").tension[0]
    lines = []
    for band, (a, b), (p, q), t in zip(
        bands[:count], pairwise(at), pairwise(rope.through), tension, strict=True
    ):
        line, width = middle_line(band)
        assert width == pytest.approx([0.6 * width_of(float(t), tension.max())] * 2)
        e = (line[1] - line[0]) / math.dist(*line)
        left = np.array([-e[1], e[0]])
        for end, center, point in ((line[0], a, p), (line[1], b, q)):
            side = {"left": 1, "right": -1, None: 0}[point.side]
            assert (end - center) @ left == pytest.approx(side * point.radius / 0.01, abs=1e-9)
            assert (end - center) @ e == pytest.approx(0.0, abs=1e-9)
        lines.append(line)
    for band, k in zip(bands[count:], range(1, count), strict=True):
        around, _ = middle_line(band)
        assert around[0] == pytest.approx(lines[k - 1][1])
        assert around[-1] == pytest.approx(lines[k][0])
        turn = np.unwrap(np.arctan2(*(around - at[k]).T[::-1]))
        assert (turn[-1] > turn[0]) == (rope.through[k].side == "right")


@pytest.mark.parametrize("lean", [0.0, 30.0, -75.0])
def test_a_wedge_has_the_length_of_its_stroke_and_its_face_s_height(lean: float) -> None:
    """Over 100 mm a face of 10 degrees rises by 17.6 mm; on a leaning floor the wedge leans, in its axes too."""
    e, n = (np.array([math.cos(t), math.sin(t)]) for t in np.radians([lean, lean + 90.0]))
    tree = da.wedge().to_tree()
    tree["links"]["ground"]["points"]["G"] = tree["links"]["wedge"]["points"]["F"] = (0.1 * e).tolist()
    tree["joints"]["floor"] |= {"direction": f"{lean} deg", "angle": f"{-lean} deg"}
    tree["joints"]["face"] |= {"direction": f"{170 + lean} deg", "angle": f"{-170 - lean} deg"}
    tree["joints"]["guide"] |= {"direction": f"{90 + lean} deg"}
    r = da.statics(da.mechanism(tree))
    high = 0.1 * math.tan(math.radians(10.0))
    corners = wedge_corners(r, "wedge")
    assert corners == pytest.approx(np.array([high * n, 0 * n, 0.1 * e]), abs=1e-12)
    assert wedge_corners(r, "block") is None
    assert wedge_items(r, "block", 3, FRAME) == []
    (drawn,) = wedge_items(r, "wedge", 3, FRAME)
    assert isinstance(drawn, Polygon)
    at = r.point("wedge", "W")[3]
    assert np.array(drawn.points) == pytest.approx(np.array([FRAME(at + c) for c in corners]))
