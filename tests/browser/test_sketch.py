"""A sketch in the browser: pulled far, by mouse, finger and keys; finished by offers from the pose that is drawn."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.bundled import examples
from dalembert.core.constraints import measure
from dalembert.core.layout import Pose
from dalembert.core.position.first_pose_plane import phase_rows
from dalembert.pages.html_page import html_text
from dalembert.pages.unfinished.sketch_page import page_or_sketch
from tests.pages.test_sketch_page import LOOSE, OPEN

pytestmark = pytest.mark.long

PULL = """async ([count, seed]) => { const s = page.sketch, L = s.data.length, poses = []; let x = seed, far = 0;
const draw = () => ((x = (Math.imul(x, 1664525) + 1013904223) >>> 0) + 0.5) / 4294967296;
for (let k = 0; k < count; k++) {
  const link = Math.floor(draw() * s.data.links.length), u = [(draw() - 0.5) * L, (draw() - 0.5) * L];
  const reach = draw() < 0.3 ? 20 : 1, to = s.at({link, u}).map(c => c + (draw() - 0.5) * 2 * reach * L);
  let where = 'on the way';
  for (let n = 0; n < 60 && where === 'on the way'; n++) where = s.frame({link, u}, to, 1e-4);
  far += where === 'nearest'; poses.push([[...s.pose.point], [...s.pose.turn], s.closed, where]);
} page.redraw(); return [poses, far]; }"""
"""Random points of links pulled to random places, three in ten of them twenty lengths away."""
KNOB = '.handle[data-item="point:coupler.C"]'


def pull(page: Any, dx: float, dy: float, up: bool = True) -> None:
    x, y = page.place(KNOB)
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    for k in range(1, 9):
        page.page.mouse.move(x + dx * k / 8, y + dy * k / 8)
        page.frame()
    for _ in range(20):
        page.frame()
    if up:
        page.page.mouse.up()
        page.frame()


@pytest.mark.parametrize("name", ["four_bar", "quick_return", "scissor_lift", "gear_train", "bucket"])
def test_far_pulls_keep_every_joint_together(opened: Any, name: str) -> None:
    """By the core's own measure of each constraint, which the page does not have."""
    m = da.load(examples()[name])
    bare = m.model_copy(update={"drives": {}, "loads": {}})
    page = opened(html=html_text(page_or_sketch(bare, inside=0)))
    poses, far = page.page.evaluate(PULL, [60, 7])
    page.frame()
    assert far > 20
    c = compile_mechanism(bare, bare.schedule())
    g, layout = c.layout.algebra, c.layout
    kept = np.setdiff1d(np.arange(layout.constraints.count), phase_rows(layout.constraints))
    for point, turn, closed, where in poses:
        assert closed
        assert where != "on the way"
        turns = np.array([*turn, 0.0])
        rotation = np.column_stack([np.cos(turns), np.sin(turns)])
        origin = np.vstack([np.reshape(point, (-1, 2)), [0.0, 0.0]])
        at = origin + g.rotate(rotation, layout.reference) - layout.reference[-1]
        gap = (np.asarray(measure(g, layout.constraints, Pose(at, turns, rotation))) - c.target)[kept]
        assert np.isfinite(gap).all()
        assert np.abs(gap).max() < 1e-9 * max(layout.length, 1.0)


def test_a_pull_too_far_is_stretched_and_says_how_far(opened: Any) -> None:
    page = opened(html=da.page(da.loads(LOOSE)))
    pull(page, 100, -400, up=False)
    said = page.page.locator(".gaps text").text_content()
    assert said.endswith("mm too far")
    ends = page.run(
        "(() => { const p = page.sketch, [x, y] = p.at({link: 1, u: [0.05, 0.03]});"
        "const b = document.querySelector('.handle[data-item=\"point:coupler.C\"]').getBoundingClientRect();"
        "return [x, y, ...page.metres(b.x + b.width / 2, b.y + b.height / 2)]; })()"
    )
    assert ends[:2] == pytest.approx(ends[2:], abs=1e-4)
    page.page.mouse.up()
    page.frame()
    assert page.page.locator(".gaps text").count() == 0
    page.page.keyboard.press("Control+z")
    page.frame()
    first = page.run("[...page.sketch.pose.turn]")
    page.page.get_by_text("Reset").click()
    assert page.run("[...page.sketch.pose.turn]") == pytest.approx(first, abs=1e-12)


def test_the_analysis_takes_over_from_the_pose_drawn(opened: Any) -> None:
    page = opened(html=da.page(da.loads(LOOSE)))
    pull(page, 60, -30)
    drawn = page.run("page.pose()")
    page.page.get_by_text("drive the turn of O2").click()
    page.until("page.kernel !== undefined && page.sketch === undefined")
    page.frame()
    taken = page.run("page.pose()")
    for link in drawn:
        assert math.sin((taken[link][2] - drawn[link][2]) / 2) == pytest.approx(0, abs=1e-9)
    m = da.loads(page.run("page.text()"))
    at = page.run("page.kernel.position('O2', page.view.t)")
    r = da.statics(m.with_values({"drives.O2.position": at, "assembly": {k: x[2] for k, x in drawn.items()}}))
    row = page.run("page.data.views.charts[0].curves[0].row")
    assert page.run(f"page.kernel.here[{row}]") == pytest.approx(float(r.effort("O2")[0]), rel=1e-9)
    page.page.get_by_role("button", name="Back").click()
    page.until("page.sketch !== undefined")
    back = page.run("page.pose()")
    assert back["coupler"] == pytest.approx(drawn["coupler"], abs=1e-9)


def test_parts_come_together_when_a_joint_is_added(opened: Any) -> None:
    page = opened(html=da.page(da.loads(OPEN)), has_touch=True)
    page.page.set_viewport_size({"width": 390, "height": 844})
    page.frame()
    assert page.run("document.documentElement.scrollWidth") <= 390
    page.page.touchscreen.tap(*page.place("button:has-text('pin B of coupler')"))
    page.until("page.sketch === undefined")
    page.frame()
    assert page.run("page.kernel.solved")


def test_by_keys_alone(opened: Any) -> None:
    """A point is reached by Tab and pulled by the arrows; the menu of a joint holds its turn."""
    page = opened(html=da.page(da.loads(LOOSE)))
    before = page.run("[...page.sketch.pose.turn]")
    for _ in range(40):
        page.page.keyboard.press("Tab")
        if page.run("document.activeElement.getAttribute('data-item')") == "point:coupler.C":
            break
    page.page.keyboard.press("ArrowUp")
    page.frame()
    assert page.run("[...page.sketch.pose.turn]") != before
    page.page.keyboard.press("Control+z")
    page.frame()
    assert page.run("[...page.sketch.pose.turn]") == before
    page.page.mouse.click(*page.place('.stage [data-item="joint:O2"]'), button="right")
    page.page.keyboard.press("Enter")
    pull(page, 80, -40)
    assert page.run("[...page.sketch.pose.turn]") == pytest.approx(before, abs=1e-9)
