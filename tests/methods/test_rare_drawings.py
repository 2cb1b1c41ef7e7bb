"""What few drawings have: numbers for names, curves with gaps, unknown loads, mirrored systems, trade-offs."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.views.force_system import force_system_scene
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.diagrams import curves_scene
from dalembert.views.paper.scene import Line, Polygon, Scene
from dalembert.views.plane.outline import unbroken
from dalembert.views.stated import axes_text, load_text, vector_text
from dalembert.wrench import Force, System

NAN = math.nan


@pytest.mark.parametrize(
    ("names", "shown"),
    [
        (("crank", "coupler", "rocker"), ("1", "2", "3", "4")),
        (("2", "3", "4"), ("1", "2", "3", "4")),
        (("2", "3", "piston"), ("1", "2", "3", "4")),
        (("12", "rod", "14"), ("1", "12", "3", "14")),
        (("1", "2", "3"), ("ground", "1", "2", "3")),
        (("1", "rod", "7"), ("ground", "1", "rod", "7")),  # the ground would be 1 as well
        (("rod", "4", "lever"), ("ground", "rod", "4", "lever")),  # the lever would be 4 as well
    ],
)
def test_no_two_links_have_one_number(names: tuple[str, ...], shown: tuple[str, ...]) -> None:
    text = json.dumps(da.four_bar(positions=1).to_tree())
    for old, new in zip(("crank", "coupler", "rocker"), names, strict=True):
        text = text.replace(f'"{old}"', f'"{new}"')
    some = Shown(da.dynamics(da.mechanism(json.loads(text))), Notation())
    assert tuple(some.link(link) for link in ("ground", *names)) == shown


@pytest.mark.parametrize(
    ("path", "runs"),
    [
        ([[0, 0], [1, 0], [NAN, 0], [5, 0], [NAN, 0], [3, 0], [3, 1]], [[0, 1], [3, 3]]),
        ([[0, 0], [1, 0], [1, 1], [0, 0.1]], [[0, 1, 1, 0, 0]]),
        ([[0, 0], [1, 0], [NAN, 0], [1, 1], [0, 0.1]], [[0, 1], [1, 0, 0]]),
        ([[NAN, 0], [1, 0], [2, 0], [2, 0.1]], [[1, 2, 2]]),
        ([[2, 2], [2, 2]], []),
        ([[NAN, NAN]], []),
    ],
)
def test_a_path_is_drawn_in_runs_of_two_points_or_more(path: Any, runs: list[list[float]]) -> None:
    assert [run[:, 0].tolist() for run in unbroken(np.array(path, float))] == runs


def boxes(scene: Scene) -> list[Any]:
    """Corners of the areas where values are missing, without that of the legend."""
    grey = [np.array(i.points) for i in scene.items if isinstance(i, Polygon) and i.role == "missing-fill"]
    return [p for p in grey if np.ptp(p[:, 1]) > 10]


def field(scene: Scene) -> tuple[float, float, float, float]:
    """Left, right, bottom, top of the axes."""
    corner = next(
        np.array(i.points)
        for i in scene.items
        if isinstance(i, Line) and i.role == "axis" and len(i.points) == 3
    )
    return (corner[:, 0].min(), corner[:, 0].max(), corner[:, 1].min(), corner[:, 1].max())


@pytest.mark.parametrize(
    ("values", "missing"),
    [
        ([1, 2, 3, 2, 1], []),
        ([1, 2, NAN, NAN, 3], [(0.25, 1)]),
        ([NAN, 2, 5, NAN, NAN], [(0, 0.25), (0.5, 1)]),
        ([NAN] * 5, [(0, 1)]),
    ],
)
def test_ranges_without_a_value_are_grey_from_axis_to_axis(values: list[float], missing: list[Any]) -> None:
    scene = curves_scene(np.linspace(2.0, 10.0, 5), {"a": np.array(values)}, "x", "y")
    left, right, low, high = field(scene)
    places = [(left + a * (right - left), left + b * (right - left)) for a, b in missing]
    found = boxes(scene)
    assert len(found) == len(places)
    for corners, (a, b) in zip(found, places, strict=True):
        assert corners == pytest.approx(np.array([(a, low), (b, low), (b, high), (a, high)]))


def test_a_curve_at_one_place_is_upright_in_the_middle() -> None:
    scene = curves_scene(np.array([2.0, 2.0]), {"a": np.array([1.0, 3.0])}, "x", "y")
    left, right, *_ = field(scene)
    (curve,) = [
        i.points for i in scene.items if isinstance(i, Line) and i.role == "curve-1" and len(i.points) == 2
    ][:1]
    assert [x for x, _ in curve] == pytest.approx([(left + right) / 2] * 2)


@pytest.mark.parametrize(
    ("load", "said"),
    [
        ({"type": "couple"}, "unknown on 4 rocker"),
        ({"type": "force", "at": "B", "direction": "30 deg"}, "unknown along 30.00° on 4 rocker at B"),
        (
            {"type": "force", "at": "B", "direction": "30 deg", "axes": "link"},
            "unknown along 30.00° of its link on 4 rocker at B",
        ),
        (
            {"type": "force", "at": [0.1, 0.02], "direction": 0},
            "unknown along 0° on 4 rocker at (0.1000, 0.02000)",
        ),
    ],
)
def test_an_unknown_load_has_its_direction_and_its_place(load: dict[str, Any], said: str) -> None:
    tree: Any = da.four_bar(positions=1).to_tree()
    tree["drives"]["O2"]["effort"] = 3.0
    tree["loads"] = {"T": load | {"on": "rocker", "value": "unknown"}}
    assert load_text(Shown(da.dynamics(da.mechanism(tree)), Notation()), 0, "T") == said


def test_what_has_no_number_is_said() -> None:
    shown = Shown(da.dynamics(da.four_bar(positions=1)), Notation())
    assert vector_text(shown, "force", np.array([NAN, 1.0])) == "no value"
    assert vector_text(shown, "force", np.array([1.0, 2e-15, -3.0])) == "(1.000, 0, −3.000) N"
    assert [Notation().degrees(x) for x in (math.inf, NAN, math.pi)] == ["-", "-", "180.00"]


@pytest.mark.parametrize(
    ("kind", "keys", "said"),
    [
        ("cylindrical", {"axis": [0, 0, 2]}, ", axis (0, 0, 2)"),
        (
            "universal",
            {"axes": {"i": {"z": [0, 0, 1]}, "j": {"z": [0, 1, 0]}}},
            ", on ground z (0, 0, 1), on a z (0, 1, 0)",
        ),
        (
            "cylindrical",
            {"axes": {"i": {"x": [1, 0, 0], "z": [0, 0, 1]}}},
            ", on ground x (1, 0, 0), z (0, 0, 1)",
        ),
    ],
)
def test_a_joint_in_space_is_said_with_its_axes(kind: str, keys: dict[str, Any], said: str) -> None:
    links = {name: {"points": {"P": [0, 0, 0]}} for name in ("ground", "a")}
    joint = {"type": kind, "links": ["ground", "a"], **keys}
    m = da.mechanism({"space": "space", "links": links, "joints": {"P": joint}})
    assert axes_text(m.joints["P"]) == said


def test_a_mirrored_wrench_is_drawn_to_the_same_scale_of_moments() -> None:
    """Two skew forces, and the same with the second one as far below: a couple about their axis of the other sense."""
    found = []
    for height in (0.3, -0.3):
        system = System(Force([1e4, 0, 0]), Force([0, 5e3, 0], at=[0, 0, height]))
        found.append((system.central_axis().moment, force_system_scene(system).scales["moment-seen"]))
    (right, one), (left, other) = found
    assert (right, one) == (pytest.approx(-left), pytest.approx(other))
    assert right * left < 0


@pytest.mark.parametrize("count", [24, 3])
def test_a_trade_off_is_drawn_as_it_is_computed(count: int) -> None:
    """Percent of the force that is left, and of the torque; of three positions at least."""
    m = da.load(examples()["four_bar"]).with_values({"drives.O2.acceleration": 0.0})
    b = da.balance(m, {"crank": {"mass": 3}, "rocker": {"mass": 3}}, positions=count)
    pairs = 100 * np.array(b.trade_off("torque"))
    scene = next(s for s in b.drawings(Notation()) if s.title.startswith("Trade-off"))
    assert scene.title == "Trade-off: rms of force against torque"
    (curve,) = [
        np.array(i.points) for i in scene.items if isinstance(i, Line) and len(i.points) == len(pairs)
    ]
    for k in (0, 1):
        drawn, own = curve[:, k], pairs[:, k]
        assert (drawn - drawn[0]) / (drawn[-1] - drawn[0]) == pytest.approx(
            (own - own[0]) / (own[-1] - own[0])
        )


@pytest.mark.parametrize("couple", [1e4, -1e4])
def test_a_torque_of_either_sign_is_charted(couple: float) -> None:
    tree = da.slider_crank(crank=0.05, rod=0.2).to_tree()
    loads = {"M": {"type": "couple", "on": "crank", "value": couple}}
    b = da.balance(da.mechanism({**tree, "loads": loads}), {"crank": {"mass": 3}}, positions=8)
    assert (b.result.effort("O2") * couple < 0).all()
    assert "Torque of O2" in [s.title for s in b.drawings(Notation())]


def test_two_positions_have_no_trade_off() -> None:
    m = da.load(examples()["four_bar"]).with_values({"drives.O2.acceleration": 0.0})
    b = da.balance(m, {"crank": {"mass": 3}}, positions=2)
    assert [s.title for s in b.drawings(Notation())] == ["Shaking force"]
