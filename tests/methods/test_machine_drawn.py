"""Drawings of machine design by hand, in mm: harmonics as bars, shafts, bolts, cams, governors, ends of speeds."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.views.machine.cycle_views import ChartAxis
from dalembert.views.machine.governor_view import governor_scene
from dalembert.views.machine.pin_view import layers_of, pin_scene
from dalembert.views.machine.shaft_view import shaft_scene
from dalembert.views.machine.shaking_views import harmonics_scene
from dalembert.views.notation import Figures, Notation, Shown
from dalembert.views.paper.scene import Circle, Line, Polygon, Scene
from dalembert.views.plane.elements.cam_view import _charts, cam_scene
from tests.elements.test_cams import machine
from tests.machine.test_shafts import SHAFT

RESULT = da.statics(da.four_bar(), positions=2)


def polygons(scene: Scene, role: str) -> list[Any]:
    return [np.array(i.points) for i in scene.items if isinstance(i, Polygon) and i.role == role]


def lines(scene: Scene, role: str) -> list[Any]:
    return [np.array(i.points) for i in scene.items if isinstance(i, Line) and i.role == role]


def at(scene: Scene, text: str) -> tuple[float, float]:
    (found,) = (t.at for t in scene.texts() if t.text == text)
    return found


@pytest.mark.parametrize("many", [1, 2])
def test_harmonics_are_bars_of_their_orders_without_the_mean(many: int) -> None:
    """Amplitudes of 3 and 7 at twice their size: the axis goes to 15, in steps of 5."""
    amplitude = np.array([[9.0, 9.5], [3.0, 1.5], [7.0, 0.5]])[:, :many]
    h: Any = SimpleNamespace(order=np.array([0, 1, 3]), amplitude=amplitude[:, 0] if many == 1 else amplitude)
    scene = harmonics_scene(h, 2.0, "N", "Bars")
    marks = {float(t.text): t.at[1] for t in scene.texts() if t.at[0] == -1.5 and t.anchor == "end"}
    assert marks == pytest.approx({0: 0, 5: 40 / 3, 10: 80 / 3, 15: 40})
    assert len(lines(scene, "axis")) == 1
    assert len(lines(scene, "grid")) == 3
    wide = 0.7 * 42 / many
    for c in range(many):
        for k, bar in enumerate(polygons(scene, f"curve-{c + 1}")):
            x, y = (k + 0.15) * 42 + c * wide, 40 * 2 * amplitude[k + 1, c] / 15
            assert bar == pytest.approx(np.array([(x, 0), (x + wide, 0), (x + wide, y), (x, y)]))
    assert (at(scene, "1"), at(scene, "3")) == ((21.0, -3.2), (63.0, -3.2))
    assert (at(scene, "order"), at(scene, "Amplitude in N")) == ((42.0, -7.6), (-1.5, 44.2))
    legend = {t.text: t.at for t in scene.texts() if t.at[0] == 95.5}
    assert legend == ({"x": (95.5, 38.0), "y": (95.5, pytest.approx(33.4))} if many == 2 else {})
    assert scene.numbers["order"] == [1, 3]
    np.testing.assert_allclose(np.array(scene.numbers["amplitude"]), 2 * amplitude[1:])


def test_harmonics_that_are_nothing_have_an_axis_to_one() -> None:
    h: Any = SimpleNamespace(order=np.array([0, 1, 2]), amplitude=np.zeros((3, 2)))
    marks = [
        t.text for t in harmonics_scene(h, 1.0, "N", "").texts() if t.at[0] == -1.5 and t.anchor == "end"
    ]
    assert marks == ["0", "1"]


def test_a_chart_s_curves_are_in_the_reader_s_unit_and_its_axis_says_what_they_are() -> None:
    shown = Shown(da.statics(da.loads(SHAFT)), Notation())
    axis = ChartAxis(shown, np.array([1.0, 2.0]), "time", False)
    chart = axis.chart("force", {"a": np.array([4.4482216152605, 8.896443230521])}, "Title", "pull of it")
    assert chart.numbers["a"] == pytest.approx([1, 2])
    assert {"Pull of it in lbf", "time", "Title"} <= {t.text for t in chart.texts()}
    assert "Force in lbf" in {t.text for t in axis.chart("force", {"a": np.ones(2)}, "").texts()}
    percents = axis.percents({"p": np.array([3.0, 5.0])}, "Title", "Speed")
    assert percents.numbers["p"] == [3, 5]
    assert "Speed in %" in {t.text for t in percents.texts()}


def test_a_governor_s_speeds_are_in_rpm_over_the_height_of_its_sleeve() -> None:
    def drawn(interval: Any) -> Scene:
        speed = np.array([20.0, 25.0])
        g: Any = SimpleNamespace(
            result=RESULT, height=np.array([0.1, 0.2]), speed=speed, interval=np.array(interval)
        )
        return governor_scene(g)

    scene = drawn([[19.0, 21.0], [24.0, 27.0]])
    rpm = 30 / math.pi
    assert list(scene.numbers) == ["speed", "falls below", "rises above"]
    assert scene.numbers["speed"] == pytest.approx([20 * rpm, 25 * rpm])
    assert scene.numbers["falls below"] == pytest.approx([19 * rpm, 24 * rpm])
    assert scene.numbers["rises above"] == pytest.approx([21 * rpm, 27 * rpm])
    texts = {t.text for t in scene.texts()}
    assert {"Height of the sleeve in m", "Speed in rpm", "Speed over the height"} <= texts
    assert list(drawn([[20.0, 20.0], [math.nan, math.nan]]).numbers) == ["speed"]


def test_a_shaft_is_to_scale_with_its_bearings_masses_and_shapes() -> None:
    """31 in on 150 mm ask for 0.207 in: 0.25 in for one; its section reaches half an inch, 2 mm."""
    c = da.critical_speeds(da.statics(da.loads(SHAFT)), "shaft")
    scene = shaft_scene(c, Notation())
    assert scene.scales["length"] == pytest.approx(0.25 * 0.0254)
    (block,) = polygons(scene, "block")
    assert block == pytest.approx(np.array([(0, -2), (124, -2), (124, 2), (0, 2)]))
    middle, *bases = lines(scene, "construction")
    assert middle == pytest.approx(np.array([(-5, 0), (129, 0)]))
    for name, x, support in zip("AB", (0.0, 124.0), polygons(scene, "support"), strict=True):
        assert support == pytest.approx(np.array([(x, -2), (x - 3, -7), (x + 3, -7)]))
        assert at(scene, name) == pytest.approx((x, -12))
    balls = [i for i in scene.items if isinstance(i, Circle) and i.role == "pin"]
    assert [b.center for b in balls] == [pytest.approx((28, 11)), pytest.approx((80, 11))]
    assert [b.radius for b in balls] == [3, 3]
    for stem, x in zip(lines(scene, "link"), (28.0, 80.0), strict=True):
        assert stem == pytest.approx(np.array([(x, 2), (x, 8)]))
    heads = {t.text.partition(",")[0]: t.at for t in scene.texts() if t.text.startswith("gear_")}
    assert heads == {"gear_1": pytest.approx((28, 17)), "gear_2": pytest.approx((80, 17))}
    for k, (speed, shape, base) in enumerate(zip(c.speeds, c.shapes, bases, strict=True)):
        y = -14 - 26 * k - 9
        assert base == pytest.approx(np.array([(0, y), (124, y)]))
        curve = lines(scene, "curve-1")[k]
        assert curve[:, 0] == pytest.approx(c.places / (0.25 * 0.0254))
        assert curve[:, 1] - y == pytest.approx(9 * np.array(shape))
        assert at(scene, f"{k + 1}: {speed * 30 / math.pi:.5g} rpm") == pytest.approx((130, y))
    assert "1 mm = 0.25 in along the shaft; the size of a shape is arbitrary." in {
        t.text for t in scene.texts()
    }


def bolt(**size: Any) -> Any:
    plain = {"stack": None, "layers": None, "thicknesses": None, "eye": 0.02, "cheeks": 0.01, "gap": 0.002}
    given = SimpleNamespace(**{**plain, "planes": 2, "diameter": 0.008, **size})
    return SimpleNamespace(
        size=given,
        result=RESULT,
        joint="A",
        pressures={"coupler": np.array([np.nan, 5e6])},
        moment=np.array([np.nan]),
    )


def test_the_links_on_a_bolt_are_its_cheeks_and_its_eye_or_as_they_are_stacked() -> None:
    i, j = RESULT.mechanism.joints["A"].links
    assert layers_of(bolt()) == [
        (i, 0.0, 0.01),
        (j, pytest.approx(0.017), 0.02),
        (i, pytest.approx(0.034), 0.01),
    ]
    assert layers_of(bolt(planes=1)) == [(i, 0.0, 0.01), (j, pytest.approx(0.017), 0.02)]
    assert layers_of(bolt(eye=None, cheeks=None)) == [(i, 0, 0), (j, 0.002, 0), (i, 0.004, 0)]
    stacked = bolt(stack=("a", "b"), layers=(0.01, 0.03))
    assert layers_of(stacked) == [("a", 0.01, 0.0), ("b", 0.03, 0.0)]
    assert layers_of(bolt(stack=("a", "b"), layers=(0.01, 0.03), thicknesses=(0.004, 0.006))) == [
        ("a", 0.01, 0.004),
        ("b", 0.03, 0.006),
    ]


def test_a_bolt_is_in_section_with_its_links_above_and_below() -> None:
    """From -7 to 41 mm, a quarter of the diameter beyond its links: half a millimetre for one."""
    scene = pin_scene(bolt(), Notation())
    assert scene.scales == {"length": pytest.approx(0.0005)}
    left = [(0.002 + 0.0, 0.002 + 0.01), (0.014, 0.034), (0.036, 0.046)]
    blocks = polygons(scene, "block")
    assert len(blocks) == 6
    for k, (a, b) in enumerate(left):
        a, b = a / 0.0005, b / 0.0005
        above, below = blocks[2 * k : 2 * k + 2]
        assert above == pytest.approx(np.array([(a, 8), (b, 8), (b, 16), (a, 16)]))
        assert below == pytest.approx(np.array([(a, -8), (b, -8), (b, -16), (a, -16)]))
    (pin,) = polygons(scene, "pin")
    assert pin == pytest.approx(np.array([(0, -8), (96, -8), (96, 8), (0, 8)]))
    (axis,) = lines(scene, "construction")
    assert axis == pytest.approx(np.array([(-4, 0), (100, 0)]))
    crank, coupler, other = (t for t in scene.texts() if t.text.startswith(("crank", "coupler")))
    assert (crank.text, coupler.text, other.text) == ("crank", "coupler, 5.000 MPa", "crank")
    assert [crank.at[0], coupler.at[0], other.at[0]] == pytest.approx([14, 48, 82])
    rows = [crank.at[1], coupler.at[1], other.at[1]]
    wide = 1.9 * len(coupler.text)
    first = 48 - wide / 2 > 14 + 1.9 * 5 / 2 + 1.9
    assert rows == pytest.approx([20, 20 if first else 25, 20])
    assert scene.title == "Bolt of A, diameter 0.008000 m"


# cams


def test_a_cam_s_charts_are_its_lift_and_what_follows_from_it() -> None:
    design = da.cam(da.mechanism(machine("knife")), "F")
    figures = Figures(design.mechanism.units, Notation())
    charts = _charts(design, figures)
    names = ["Lift", "Velocity", "Acceleration", "Jerk", "Pressure angle"]
    assert [c.title for c in charts[:5]] == names
    assert charts[5].title.startswith("Radius of the cam, up to ")
    assert charts[6].title == "Normal force"
    assert len(charts) == 7
    size = figures.size("length")
    for chart, sign, values in zip(
        charts, ("s", "s'", "s''", "s'''"), design.lift(design.turn), strict=False
    ):
        assert np.array(chart.numbers[sign])[:-1] == pytest.approx(values[:-1] / size, abs=1e-9)
    assert charts[4].numbers["φ"] == pytest.approx(np.degrees(design.pressure_angle(design.turn)))
    radius = np.array(charts[5].numbers["ρ"]) * size
    exact = design.profile_radius(design.turn)
    far = np.abs(radius).max()
    near = np.abs(exact) < 0.99 * far
    assert near.any()
    assert radius[near] == pytest.approx(exact[near])
    assert (np.sign(radius) == np.sign(exact)).all()
    force = np.array(charts[6].numbers["N"]) * figures.size("force")
    assert sorted(force) == pytest.approx(sorted(design.force))
    two = machine("knife")
    drives = {k: {"position": [0.3, 0.5], "speed": "20 rad/s"} for k in two["drives"]}
    few = da.cam(da.mechanism({**two, "drives": drives}), "F")
    assert len(_charts(few, figures)) == 6  # two positions make no chart of their force


def test_a_cam_is_drawn_at_its_greatest_pressure_angle_or_at_a_turn() -> None:
    design = da.cam(da.mechanism(machine("knife")), "F")
    figures = Figures(design.mechanism.units, Notation())
    scene = cam_scene(design, figures)
    peak = design.pressure_angle_peak_at
    assert scene.title == f"Cam F at {figures.text('angle', peak)}"
    greatest = abs(float(design.pressure_angle(peak)))
    assert f"φ = {figures.text('angle', greatest)}" in {t.text for t in scene.texts()}
    other = cam_scene(design, figures, 0.5)
    assert other.title == f"Cam F at {figures.text('angle', 0.5)}"
    (shape,) = polygons(other, "link-area")
    base = float(np.hypot(*design.profile(design.turn).T).min())
    circles = [i for i in other.items if isinstance(i, Circle) and i.role == "construction"]
    assert [c.radius for c in circles] == [pytest.approx(base / other.scales["length"])]
    center = np.array(circles[0].center)
    assert np.hypot(*(shape - center).T).min() == pytest.approx(circles[0].radius, rel=1e-9)
    said = " ".join(t.text for t in other.texts())
    assert "base circle" in said
    assert "prime circle" not in said
    rolled = cam_scene(da.cam(da.mechanism(machine({"roller": "9 mm"})), "F"), figures)
    assert len([i for i in rolled.items if isinstance(i, Circle) and i.role == "construction"]) == 2
    assert "prime circle" in " ".join(t.text for t in rolled.texts())
