"""Templates of other sizes: lengths and angles between their drawn points and axes, and the sizes that they refuse."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.model.library.spatial import slim

RAD = math.pi / 180


def angle(a: Any, b: Any) -> float:
    """Degrees between two vectors."""
    return math.degrees(math.atan2(np.linalg.norm(np.cross(a, b)), np.dot(a, b)))


@pytest.mark.parametrize("sizes", [{}, {"crank": 0.08, "coupler": 0.25, "rocker": 0.2, "ground": 0.28}])
def test_a_four_bar_is_drawn_closed(sizes: dict[str, float]) -> None:
    m = da.four_bar(**sizes)
    crank, ground = m.point("crank", "A")[0], m.point("ground", "O4")[0]
    by_coupler = crank + m.point("coupler", "B")[0] * np.exp(1j * m.assembly["coupler"])
    by_rocker = ground + m.point("rocker", "B")[0] * np.exp(1j * m.assembly["rocker"])
    assert by_coupler == pytest.approx(by_rocker, abs=1e-8)
    assert by_rocker.imag > 0
    for link, size in sizes.items():
        ends = [np.array(p) for p in m.points(link).values()]
        assert np.linalg.norm(ends[0] - ends[1]) == pytest.approx(size, rel=1e-12)


@pytest.mark.parametrize(("offset", "rod"), [(0.0, 0.24), (0.03, 0.2), (-0.05, 0.3)])
def test_a_slider_crank_is_drawn_closed(offset: float, rod: float) -> None:
    m = da.slider_crank(crank=0.07, rod=rod, offset=offset)
    end = 0.07 + rod * np.exp(1j * m.assembly["rod"])
    assert end.imag == pytest.approx(offset, abs=1e-8)
    assert end.real > 0.07
    assert m.assembly["piston"] == 0.0


@pytest.mark.parametrize("arcs", [(30.0, 70.0, 80.0, 75.0), (25.0, 85.0, 60.0, 70.0)])
@pytest.mark.parametrize("determinate", [True, False])
def test_axes_of_a_spherical_four_bar(arcs: tuple[float, ...], determinate: bool) -> None:
    """Neighbouring points on the sphere have the angles given, the last those of ground."""
    m = da.spherical_four_bar(arcs=arcs, radius=0.3, determinate=determinate)
    o, a = m.point("crank", "O"), m.point("crank", "A")
    b, c = m.point("rocker", "B"), m.point("rocker", "C")
    assert m.point("coupler", "B") == b
    assert [np.linalg.norm(p) for p in (o, a, b, c)] == pytest.approx([0.3] * 4)
    assert [angle(p, q) for p, q in pairwise((o, a, b, c, o))] == pytest.approx(list(arcs), abs=1e-9)
    assert c[1] == 0
    assert np.dot(b, np.cross(a, c)) > 0
    for name, p in (("O", o), ("A", a), ("B", b), ("C", c)):
        joint = m.joints[name]
        if joint.type != "spherical":
            assert angle(joint.axis, p) == pytest.approx(0, abs=1e-6)  # type: ignore[union-attr]
    kinds = ["revolute", "revolute", "spherical", "cylindrical"] if determinate else ["revolute"] * 4
    assert [joint.type for joint in m.joints.values()] == kinds


def test_axes_and_distances_of_a_spatial_four_bar() -> None:
    """Each link is the common perpendicular of its axes, of the length given; ground slides half its offset aside."""
    angles, offsets = (25.0, 85.0, 60.0, 70.0), (0.04, 0.13, 0.11, 0.17)
    m = da.rccc(axes=angles, offsets=offsets)
    axes = [np.array(m.joints[n].axis) for n in "OABC"]  # type: ignore[union-attr]
    assert [angle(p, q) for p, q in pairwise([*axes, axes[0]])] == pytest.approx(list(angles), abs=1e-9)
    links = [("crank", "O", "A"), ("coupler", "A", "B"), ("rocker", "B", "C")]
    for k, (link, start, end) in enumerate(links[:2]):
        line = np.array(m.point(link, end)) - m.point(link, start)
        assert np.linalg.norm(line) == pytest.approx(offsets[k])
        assert [line @ axes[k], line @ axes[k + 1]] == pytest.approx([0, 0], abs=1e-12)
    line = np.array(m.point("rocker", "C")) - m.point("rocker", "B")
    across = line - (line @ axes[3]) * axes[3]
    assert line @ axes[3] == pytest.approx(0.17 / 2)
    assert np.linalg.norm(across) == pytest.approx(0.11)
    assert across @ axes[2] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize(
    ("twists", "start"), [((40.0, 70.0), 90.0), ((75.0, 35.0), 60.0), ((30.0, 50.0), 120.0)]
)
def test_the_links_of_bennett(twists: tuple[float, float], start: float) -> None:
    """Opposite links are equal in length and twist, a / sin(alpha) = b / sin(beta), each square to its two axes."""
    m = da.bennett(length=0.3, twists=twists, start=start, determinate=False)
    axes = [np.array(m.joints[n].axis) for n in "OABC"]  # type: ignore[union-attr]
    at = [np.array(m.point("crank", "O")), np.array(m.point("crank", "A")), np.array(m.point("rocker", "B"))]
    at.append(np.array(m.point("rocker", "C")))
    other = 0.3 * math.sin(twists[1] * RAD) / math.sin(twists[0] * RAD)
    ring = list(zip([*at, at[0]], [*axes, axes[0]], strict=True))
    for ((p, u), (q, v)), size, twist in zip(
        pairwise(ring), (0.3, other, 0.3, other), twists * 2, strict=True
    ):
        assert np.linalg.norm(q - p) == pytest.approx(size, rel=1e-9)
        assert angle(u, v) == pytest.approx(twist, abs=1e-7)
        assert [(q - p) @ u, (q - p) @ v] == pytest.approx([0, 0], abs=1e-9)
    assert angle(at[1] - at[0], [1, 0, 0]) == pytest.approx(start)


def test_a_slender_link_in_space() -> None:
    tree = slim(3.0, A=(1.0, 2.0, 3.0), B=(3.0, 5.0, 9.0))
    assert tree["points"] == {"A": [1, 2, 3], "B": [3, 5, 9]}
    assert tree["mass"] == pytest.approx(21)
    assert tree["center"] == [2, 3.5, 6]
    u = np.array([2, 3, 6]) / 7
    assert np.array(tree["inertia"]) == pytest.approx(21 * 49 / 12 * (np.eye(3) - np.outer(u, u)))


@pytest.mark.parametrize(("stages", "width"), [(1, 0.3), (3, 0.7)])
def test_a_scissor_lift_leans_by_its_width(stages: int, width: float) -> None:
    m = da.scissor(stages, link=0.8, widths=(width, 0.5))
    lean = math.acos(width / 0.8)
    for k in range(1, stages + 1):
        assert m.assembly[f"left_{k}"] == pytest.approx(lean)
        assert m.assembly[f"right_{k}"] == pytest.approx(math.pi - lean)
    assert len(m.links) == 2 * stages + 2
    assert len(m.joints) == 4 + stages + 2 * (stages - 1)
    turned = da.scissor(stages, link=0.8, widths=(width, 0.5), drive="turn").drives["base_pin"].position
    assert (turned.start, turned.stop) == pytest.approx((lean, math.acos(0.5 / 0.8)))  # type: ignore[union-attr]


CENTIMETRES: list[tuple[Any, dict[str, Any], str]] = [
    (
        da.inverted_slider_crank,
        {"crank": 0.2, "ground": 0.2},
        "the crank pin passes O4 at 0 m, not farther than the slide's offset of 0 m; "
        "let ground and crank differ by more, or take a smaller offset",
    ),
    (
        da.inverted_slider_crank,
        {"crank": 0.2, "ground": 0.25, "offset": -0.05},
        "the crank pin passes O4 at 0.05 m, not farther than the slide's offset of 0.05 m; let",
    ),
    (
        da.inverted_slider_crank,
        {"crank": 0.2, "ground": 0.3, "rocker": 0.4999},
        "the block goes out to 0.5 m from O4, and the rocker ends at "
        "0.4999 m; lengthen the rocker to 0.5 m or more",
    ),
    (
        da.whitworth,
        {"crank": 0.1, "ground": 0.1},
        "the crank 0.1 m is not longer than the ground O2 O4 0.1 m, so the arm would not go round; "
        "lengthen the crank, or take the template crank_shaper",
    ),
    (
        da.crank_shaper,
        {"crank": 0.1, "ground": 0.1},
        "the crank 0.1 m is not shorter than the ground O2 O4 0.1 m, so the lever would not "
        "swing to and fro; shorten the crank, or take the template whitworth",
    ),
    (da.hooke_joint, {"angle": 0.0}, "angle is 0 degrees; give one between 0 and 90 degrees"),
    (da.hooke_joint, {"angle": 90.0}, "angle is 90 degrees; give one between 0 and 90 degrees"),
    (da.double_cardan, {"angle": -28.5}, "angle is -28.5 degrees; give one between 0 and 90 degrees"),
    (
        da.five_bar,
        {"sweep": (1.0, 1.0)},
        "the sweep of the crank begins where it ends; give two different angles",
    ),
    (
        da.bevel_differential,
        {"sweep": (1.0, 1.0)},
        "the sweep of the left wheel begins where it ends; give two different angles",
    ),
    (da.rssr, {"axis": (0.0, 0.0, 0.0)}, "axis has no direction; give one component other than 0"),
    (da.rssp, {"direction": (0.0, 0.0, 0.0)}, "direction has no direction; give one component other than 0"),
    (
        da.bennett,
        {"twists": (40.0, 40.0)},
        "bennett: twists 40 and 40, start 90 degrees; give two different twists and a start, all below "
        "180 degrees",
    ),
    (da.bennett, {"twists": (40.0, 180.0)}, "bennett: twists 40 and 180, start 90 degrees; give"),
    (da.bennett, {"start": 180.0}, "bennett: twists 40 and 70, start 180 degrees; give"),
    (
        da.spherical_four_bar,
        {"arcs": (30.0, 10.0, 10.0, 75.0)},
        "spherical_four_bar does not close from 0 to 360 degrees of the crank; change the angles",
    ),
    (
        da.scissor,
        {"stages": 0},
        "scissor: stages is 0; it must be an integer of at least 1; for example scissor(3)",
    ),
    (da.scissor, {"stages": True}, "scissor: stages is True; it must be an integer of at least 1"),
    (
        da.scissor,
        {"stages": 2, "link": 0.5, "widths": (0.3, 0.5)},
        "scissor: with the roller 0.5 m from the base pin, links of 0.5 m lie flat; "
        "give widths below 0.5 m, or longer links",
    ),
    (
        da.scissor,
        {"stages": 2, "link": 0.5, "widths": (0.6, 0.3)},
        "scissor: with the roller 0.6 m from the base pin",
    ),
    (
        da.scissor,
        {"stages": 2, "drive": "push"},
        'scissor: drive is \'push\'; it is "slide" (the roller) or "turn" (the base pin)',
    ),
]


@pytest.mark.parametrize(("template", "sizes", "says"), CENTIMETRES)
def test_sizes_that_a_template_refuses(template: Any, sizes: dict[str, Any], says: str) -> None:
    with pytest.raises(ModelError) as caught:
        template(**sizes)
    assert says in f"{caught.value.what}; {caught.value.remedy}"


@pytest.mark.parametrize("template", [da.whitworth, da.crank_shaper, da.inverted_slider_crank])
def test_an_arm_may_just_hold_its_block(template: Any) -> None:
    arm = {da.whitworth: "slot", da.crank_shaper: "lever", da.inverted_slider_crank: "rocker"}[template]
    crank, ground = (0.2, 0.1) if template is da.whitworth else (0.1, 0.2)
    sizes = {"crank": crank, "ground": ground} | ({} if arm == "rocker" else {"rod": 2.0})
    assert template(**sizes, **{arm: crank + ground}).links
    with pytest.raises(ModelError, match=f"the {arm} ends at 0.299"):
        template(**sizes, **{arm: 0.299})
