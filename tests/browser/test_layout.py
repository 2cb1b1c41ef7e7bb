"""What is seen of a page in windows of many sizes, and keys that work without a click first."""

from __future__ import annotations

import math
from typing import Any

import pytest

import dalembert as da
from dalembert.model.library import template_text
from tests.browser.opened import FILES
from tests.browser.test_page import FOUR_BAR, SHAPER, tab

pytestmark = pytest.mark.long

WINDOWS = [(1024, 600), (1280, 800), (2560, 1440)]
SCALE = """(() => { const m = document.querySelector('.stage svg').getScreenCTM();
const bar = document.querySelector('.stage .scale path').getAttribute('d').replace(/v2/, '');
const [, x, end] = /M(\\S+) \\S+L(\\S+) /.exec(bar);
return [m.a * (end - x), document.querySelector('.stage .scale text').textContent]; })()"""
"""Pixels of the bar of lengths, and what it says."""
OUTSIDE = """(() => { const out = [], over = (a, b) => a.left < b.left - 1 || a.right > b.right + 1
  || a.top < b.top - 1 || a.bottom > b.bottom + 1;
for (const svg of document.querySelectorAll('.body svg')) { const box = svg.getBoundingClientRect();
  if (!box.width) continue;
  for (const e of svg.querySelectorAll('path, circle, text')) {
    if (!e.checkVisibility({visibilityProperty: true})) continue;
    const b = e.getBoundingClientRect();
    if (b.width + b.height && over(b, box)) out.push([svg.getAttribute('aria-label'), e.outerHTML.slice(0, 90)]);
  } } return out; })()"""
"""Parts of the free body in view that its panel cuts off."""
SMALL = """[...document.querySelectorAll('.stage svg text, .chart svg text')]
.filter(e => e.checkVisibility({visibilityProperty: true}))
.map(e => [e.getAttribute('font-size') * e.ownerSVGElement.getScreenCTM().a, e.textContent])
.filter(([size, text]) => text && size < 9)"""
"""Texts of the drawing and of charts under 9 pixels."""


def resize(page: Any, width: int, height: int) -> None:
    page.page.set_viewport_size({"width": width, "height": height})
    page.until(f"innerWidth === {width} && innerHeight === {height}")
    page.frame()
    page.frame()


@pytest.mark.parametrize(("width", "height"), WINDOWS)
def test_the_drawing_fills_the_window_and_its_scale_is_true(opened: Any, width: int, height: int) -> None:
    page = opened(FOUR_BAR)
    resize(page, width, height)
    assert page.run("document.documentElement.scrollHeight") <= height
    box = page.page.locator(".stage svg").bounding_box()
    assert box["height"] > height - 150
    assert box["width"] > 0.5 * width
    (ax, ay), (bx, by) = (page.place(f'.handle[data-name="{joint}"]') for joint in ("O2", "O4"))
    pixels, said = page.run(SCALE)
    points = da.load(FILES[FOUR_BAR]).links["ground"].points
    inches = math.dist(points["O2"], points["O4"]) / 0.0254
    assert said.endswith(" in")
    assert pixels / float(said.split()[0]) == pytest.approx(math.hypot(bx - ax, by - ay) / inches, rel=0.01)
    small = page.run(SMALL)
    assert small == []


def test_the_window_may_change_while_a_handle_is_held(opened: Any) -> None:
    """The point on each curve goes on being drawn, at its value, before the curves follow."""
    page = opened(FOUR_BAR)
    script = "[...document.querySelectorAll('.chart circle')].map(e => +e.getAttribute('cx'))"
    x, y = page.place('.handle[data-name="O4"]')
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    page.page.mouse.move(x + 6, y + 4)
    before = page.run(script)
    for width in (1000, 1400, 1100):  # with no time between the change and the frame
        page.page.set_viewport_size({"width": width, "height": 700})
        page.page.mouse.move(x + width / 200, y + 3)
    page.page.mouse.up()
    resize(page, 1100, 700)
    after = page.run(script)
    assert before
    assert all(map(math.isfinite, after))
    assert after != before


def test_the_scale_is_true_after_a_drag_and_for_a_zoomed_page(opened: Any) -> None:
    page = opened(FOUR_BAR, device_scale_factor=2)
    page.drag('.handle[data-name="O4"]', 90, 10)
    page.run("document.body.style.zoom = 1.5")
    page.frame()
    (ax, ay), (bx, by) = (page.place(f'.handle[data-name="{joint}"]') for joint in ("O2", "O4"))
    pixels, said = page.run(SCALE)
    inches = math.hypot(*(page.value(f"links.ground.points.O4.{k}") for k in (0, 1))) / 0.0254
    assert pixels / float(said.split()[0]) == pytest.approx(math.hypot(bx - ax, by - ay) / inches, rel=0.02)


@pytest.mark.parametrize(("width", "height"), [*WINDOWS, (390, 844)])
def test_what_lowers_the_peak_is_in_view(opened: Any, width: int, height: int) -> None:
    page = opened(SHAPER)
    resize(page, width, height)
    switch = page.page.get_by_text("what lowers the peak")
    box = switch.bounding_box()
    assert box["y"] + box["height"] <= height
    assert box["x"] + box["width"] <= width
    switch.click()
    page.frame()
    words = page.page.locator(".spread")
    assert "arrows lower the peak of" in words.inner_text()
    assert words.bounding_box()["y"] < height
    assert page.run("document.documentElement.scrollWidth") <= width


@pytest.mark.parametrize(
    "name", ["rssr", "sp-06a-hooke-joint-with-flywheel", "four_bar", "engine", "quick_return"]
)
def test_free_bodies_find_room_in_their_panel(opened: Any, name: str) -> None:
    """Every part of every link's, at several places of the cycle."""
    page = opened(name)
    resize(page, 1280, 1400)
    tab(page, "Forces")
    count = page.page.locator(".body").count()
    ends = [0, 0.2, 0.45, 0.7]
    outside = []
    for link in range(count):
        page.page.get_by_label("link", exact=True).select_option(str(link))
        for part in ends:
            page.run(f"page.show(Math.round({part} * page.kernel.end))")
            outside += page.run(OUTSIDE)
    assert outside == []


ARROWS = """(() => { const box = document.querySelector('.stage .paper svg').getBoundingClientRect();
return [...document.querySelectorAll('.stage .paper svg g[data-item]')]
  .filter(g => /^(weight|load|effort|reaction|inertia):/.test(g.dataset.item))
  .flatMap(g => [...g.querySelectorAll('path')].map(e => [g.dataset.item, e.getBoundingClientRect()]))
  .filter(([, b]) => b.width + b.height > 0 && (b.left < box.left || b.right > box.right
    || b.top < box.top || b.bottom > box.bottom)).map(([name]) => name); })()"""
"""Arrows of the drawing that its paper cuts off."""


@pytest.mark.parametrize("template", ["hoist", "ratchet", "screw_jack"])
def test_no_arrow_is_cut_off(opened: Any, template: str) -> None:
    page = opened(html=da.page(da.loads(template_text(template))))
    for width, height in ((1280, 800), (1024, 600)):
        resize(page, width, height)
        assert {k: cut for k in (0, 9, 36) if (cut := page.run(f"page.show({k})") or page.run(ARROWS))} == {}


def test_a_polygon_of_couples_alone_says_that_there_are_no_forces(opened: Any) -> None:
    page = opened(html=da.page(da.loads(template_text("plate_clutch"))))
    tab(page, "Forces")
    page.frame()
    said = page.page.locator(".polygon:visible figcaption").all_inner_texts()
    assert len(said) == 2
    assert all(text.endswith(": no forces") for text in said)
    assert page.page.locator(".polygon:visible svg:visible").count() == 0


def test_keys_work_without_a_click_first(opened: Any) -> None:
    page = opened(FOUR_BAR)
    page.page.keyboard.press("Space")
    page.until("document.querySelector('.readout').textContent !== 'O2 = 60°'")
    page.page.keyboard.press("Space")
    page.frame()
    first = page.value("links.rocker.points.B.0")
    page.drag('.handle[data-name="B"]', 15, 0)
    assert page.value("links.rocker.points.B.0") != first
    page.run("document.activeElement.blur()")
    page.page.keyboard.press("Control+z")
    page.frame()
    assert page.value("links.rocker.points.B.0") == first
    page.page.keyboard.press("Control+Shift+z")
    page.frame()
    assert page.value("links.rocker.points.B.0") != first


def test_keys_in_a_field_are_the_fields_own(opened: Any) -> None:
    page = opened(FOUR_BAR)
    page.drag('.handle[data-name="B"]', 15, 0)
    moved = page.value("links.rocker.points.B.0")
    tab(page, "Change")
    box = page.page.locator('input[data-path="links.rocker.inertia"]')
    box.focus()
    page.page.keyboard.press("Space")
    page.page.keyboard.press("Control+z")
    page.frame()
    assert page.value("links.rocker.points.B.0") == moved
    assert page.page.locator(".readout").inner_text() == "O2 = 60°"
