"""Power drawn as bands: their widths, ends, senses and columns, by hand from powers that are given."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.power_flow import PowerFlow
from dalembert.views.machine.power_view import Stream, _link_of, _places, _streams, power_scene
from dalembert.views.paper.scene import Arrow, Line, Polygon, Scene
from tests.elements.test_gear_losses import COUPLED

SPRING = {"between": ["ground.O4", "coupler.B"], "stiffness": 10, "free_length": 0.1}
LOADS = {
    "T": {"type": "couple", "on": "rocker", "value": -3},
    "S": {"type": "spring", **SPRING},
    "H": {"type": "torsion_spring", "joint": "B", "stiffness": 2, "free_angle": 0},
}


@cache
def result() -> Any:
    tree = da.four_bar().to_tree()
    tree["drives"] = {"O2": {"position": 0.9, "speed": "2 rad/s"}}
    tree["loads"] = LOADS
    return da.statics(da.mechanism(tree))


def flow(sources: dict[str, float], through: dict[str, list[float]], links: Any = None) -> PowerFlow:
    """Powers (W) at a single position."""
    return PowerFlow(
        result(),
        {n: np.array([v]) for n, v in sources.items()},
        {n: np.array([v]) for n, v in through.items()},
        {n: np.array([v]) for n, v in (links or {}).items()},
        {},
    )


LOSSY = flow(
    {"O2": 110.0, "T": -60.0, "S": -30.0, "rocker": 0.0},
    {"O2": [-110.0, 110.0], "A": [110.0, 104.5], "B": [74.5, 60.0], "O4": [0.0, 0.0]},
)


def test_each_source_is_at_the_link_it_acts_on() -> None:
    places = {"O2": "crank", "T": "rocker", "S": "coupler", "H": "rocker", "coupler": "coupler"}
    assert {name: _link_of(LOSSY, name) for name in places} == places


def test_streams_run_in_the_sense_of_their_power() -> None:
    """Not through joints on the ground, and not where there is less than a billionth of the input."""
    assert _streams(LOSSY) == [
        Stream("O2 in", "crank", 110, 110, ""),
        Stream("rocker", "T out", 60, 60, ""),
        Stream("coupler", "S out", 30, 30, ""),
        Stream("crank", "coupler", 110, 104.5, "A"),
        Stream("coupler", "rocker", 74.5, 60, "B"),
    ]
    back = flow({"T": 50.0, "S": -5e-9, "H": -4.9e-8, "O2": -45}, {"A": [-45, -46.0], "B": [-4e-8, 4.5e-8]})
    assert _streams(back) == [
        Stream("T in", "rocker", 50, 50, ""),
        Stream("crank", "O2 out", 45, 45, ""),
        Stream("coupler", "crank", 46, 45, "A"),
    ]
    least = flow({"T": 50.0, "S": -5.1e-8}, {"A": [3e-8, -5.1e-8], "B": [5.1e-8, -3e-8]})
    assert [s[:2] for s in _streams(least)] == [
        ("T in", "rocker"),
        ("coupler", "S out"),
        ("coupler", "crank"),
        ("coupler", "rocker"),
    ]


def bands(scene: Scene, role: str) -> list[Any]:
    return [np.array(i.points) for i in scene.items if isinstance(i, Polygon) and i.role == role]


def test_bands_are_as_wide_as_their_power_and_lie_below_each_other() -> None:
    """The input's is 22 mm wide: 0.2 mm a watt; columns are 44 mm apart, boxes 5 mm wide, gaps 9 mm high."""
    scene = power_scene(LOSSY)
    boxes = bands(scene, "link-area")
    names = ["O2 in", "crank", "rocker", "T out", "coupler", "S out"]
    left = {"O2 in": 0, "crank": 44, "coupler": 88, "rocker": 132, "T out": 176, "S out": 176}
    height = {"O2 in": 22, "crank": 22, "coupler": 20.9, "rocker": 12, "T out": 12, "S out": 6}
    for name, box in zip(names, boxes, strict=True):
        x, top = left[name], -21.0 if name == "S out" else 0.0
        low = top - height[name]
        expected = [(x, low), (x + 5, low), (x + 5, top), (x, top)]
        assert box == pytest.approx(np.array(expected), abs=1e-9), name
        assert pytest.approx((x + 2.5, top + 2)) in [t.at for t in scene.texts() if t.text == name]
    drawn = {
        (5, 44): (0, 0, -22, -22),
        (137, 176): (0, 0, -12, -12),
        (93, 176): (0, -21, -27, -6),  # S out, from the top of the coupler
        (49, 88): (0, 0, -20.9, -22),
        (93, 132): (-6, 0, -12, -20.9),  # B below it
    }
    for band, ((a, b), ys) in zip(bands(scene, "bar"), drawn.items(), strict=True):
        assert band == pytest.approx(np.array([(a, ys[0]), (b, ys[1]), (b, ys[2]), (a, ys[3])]), abs=1e-9)


def test_what_is_lost_leaves_a_band_downwards_with_its_number() -> None:
    scene = power_scene(LOSSY)
    arrows = [i for i in scene.items if isinstance(i, Arrow)]
    assert [(a.role, a.of, a.kind) for a in arrows] == [
        ("friction", "A", "power"),
        ("friction", "B", "power"),
    ]
    assert [a.value for a in arrows] == pytest.approx([5.5, 14.5])
    middles = [((49 + 88) / 2, -(20.9 + 22) / 2), ((93 + 132) / 2, -(12 + 20.9) / 2)]
    for arrow, (x, y) in zip(arrows, middles, strict=True):
        assert arrow.tail == pytest.approx((x, y))
        assert arrow.head == pytest.approx((x, y - 5))
    texts = {t.text: t for t in scene.texts()}
    assert texts["5.500 W"].at == pytest.approx((69.5, -26.45))
    assert (texts["5.500 W"].size, texts["5.500 W"].anchor, texts["5.500 W"].role) == (2.2, "start", "note")
    assert texts["A 110.0 W"].at == pytest.approx((68.5, -(22 + 20.9) / 4))
    assert texts["B 74.50 W"].at == pytest.approx((112.5, -(6 + 12 + 20.9) / 4))
    assert texts["60.00 W"].at == pytest.approx((156.5, -6))
    assert texts["30.00 W"].at == pytest.approx((134.5, -(0 + 21 + 27 + 6) / 4))
    assert (texts["B 74.50 W"].size, texts["crank"].size) == (2.4, 3.0)
    assert "circulate" not in " ".join(texts)
    near = flow({"O2": 10.0, "T": -10}, {"A": [10, 10 * (1 - 0.9e-9)], "B": [10, 10 * (1 - 1.1e-9)]})
    assert [i.of for i in power_scene(near).items if isinstance(i, Arrow)] == ["B"]


def test_power_that_goes_round_is_said_below_all_boxes() -> None:
    text = COUPLED.replace("FIRST", "0.11, 0.11").replace("SECOND", "0.12, 0.10")
    scene = power_scene(da.statics(da.loads(text)).power_flow())
    low = min(box[:, 1].min() for box in bands(scene, "link-area"))
    assert low == pytest.approx(-22 - 9 - 9 * 22)  # the ring's, below that of the load
    (said,) = (t for t in scene.texts() if "circulate" in t.text)
    assert said.text == "180.0 kW circulate beyond the input"
    assert said.at == pytest.approx((8.0, low - 8))
    (line,) = (i for i in scene.items if isinstance(i, Line))
    assert line.points[0] == pytest.approx((0.0, low - 8))
    assert line.points[1] == pytest.approx((6.0, low - 8))
    assert "circulate beyond the input" in scene.to_svg()


def test_nodes_stand_in_columns_by_how_power_reaches_them() -> None:
    """Two that feed each other have no beginning: the first of them is to the left; ends are in the last column."""

    def columns(*pairs: str) -> dict[str, float]:
        streams = [Stream(p[0], p[1], 2.0, 1.0, "") for p in pairs]
        return {n: x / 44 for n, (x, _) in _places(streams, 1.0)[0].items()}

    assert columns("ab", "bc", "ad", "ce") == {"a": 0, "b": 1, "c": 2, "d": 3, "e": 3}
    assert columns("ab", "ba") == {"a": 0, "b": 1}
    assert columns("ab") == {"a": 0, "b": 1}
    assert columns("ab", "cd", "dc") == {"a": 0, "b": 1, "c": 1, "d": 1}
    assert columns("ab", "cb", "bd", "ad") == {"a": 0, "b": 1, "c": 0, "d": 1}
    place, height = _places([Stream("a", "b", 8.0, 6.0, ""), Stream("c", "b", 5.0, 1.0, "")], 0.5)
    assert height == {"a": 4.0, "b": 3.5, "c": 2.5}
    assert place == {"a": (0, -2), "b": (44, -1.75), "c": (0, -4 - 9 - 1.25)}
