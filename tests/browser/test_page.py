"""The page as a person uses it: dragged, played, typed into, undone, saved, printed, on a phone, in the dark."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.pages.html_page import html_text
from dalembert.pages.page_data import page_data
from dalembert.pages.sweep import with_cycle
from tests.browser.opened import FILES
from tests.pages.test_page_data import PARAMETRIC

FOUR_BAR, ENGINE, SHAPER, LIFT = "four_bar", "engine", "quick_return", "scissor_lift"
pytestmark = pytest.mark.long
AXE = Path(__file__).parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"

HOSTILE = '</script><img src=x onerror=alert(1)><b>bar</b> & "quote" <!--'

TIP = """(() => { const path = document.querySelectorAll('.gradient g')[1].querySelector('path').getAttribute('d');
const [a, b] = path.slice(1).split('L').map(s => s.split(' ').map(Number));
return [b[0] - a[0], b[1] - a[1]]; })()"""
"""The second arrow of a gradient, mm to the right and down."""
PAINTED = """(() => { const c = document.querySelector('.cloud'), g = c.getContext('2d');
return g.getImageData(0, 0, c.width, c.height).data.some(x => x) })()"""
OVERLAPS = """(() => {
const seen = e => e.checkVisibility({visibilityProperty: true});
const box = e => { const b = e.getBoundingClientRect(), h = 0.2 * b.height;
  return [b.left, b.top + h, b.right, b.bottom - h, e.textContent]; };
const all = [...document.querySelectorAll('.stage svg > g text')].filter(seen).map(box), out = [];
const over = (a, b, k) => Math.min(a[k + 2], b[k + 2]) - Math.max(a[k], b[k]) > 1;
all.forEach((a, i) => all.slice(0, i).forEach(b => over(a, b, 0) && over(a, b, 1) && out.push([a[4], b[4]])));
return out; })()"""
"""Pairs of texts in the drawing that overlap by more than a pixel."""
NAMELESS = """[...document.querySelectorAll('button, input, select, [tabindex="0"], svg')]
.filter(e => e.checkVisibility())
.filter(e => !(e.getAttribute('aria-label') || e.labels?.length || e.textContent.trim()))
.map(e => e.outerHTML.slice(0, 80))"""


def tab(page: Any, name: str) -> None:
    page.page.get_by_role("tab", name=name).click()
    page.frame()


def agrees(page: Any, drive: str = "O2") -> None:
    """The whole curve is that of da.dynamics for the file that the page saves."""
    m = da.loads(page.run("page.text()"))
    r = da.dynamics(m) if m.has_speeds else da.statics(m)
    values, good = page.curve(f"effort.{drive}")
    assert good == list(r.ok)
    right = np.array(good)
    exact = r.effort(drive)[right]
    assert np.array(values)[right] == pytest.approx(exact, rel=1e-9, abs=1e-9 * np.abs(exact).max())


@pytest.mark.parametrize("name", [FOUR_BAR, ENGINE, SHAPER, LIFT, "toggle_press", "gear_train", "truss"])
def test_it_opens_and_shows_what_it_should(opened: Any, name: str) -> None:
    page = opened(name)
    assert page.page.locator("h1").inner_text() == da.load(FILES[name]).title
    assert page.page.locator(".stage svg path").count() > 5
    assert page.page.locator(".mark").inner_text() == ""
    scales = page.page.locator(".stage .scale text").all_text_contents()
    assert [bool(re.fullmatch(r"[\d.]+ \S+", text)) for text in scales if text] in ([True], [True, True])


def test_a_dragged_joint_moves_its_points_and_all_forces_follow(opened: Any) -> None:
    page = opened(FOUR_BAR)
    before = page.value("links.coupler.points.B.0")
    page.drag('.handle[data-name="B"]', 25, -18)
    assert page.value("links.coupler.points.B.0") != before
    agrees(page)


def test_a_dragged_ground_joint(opened: Any) -> None:
    page = opened(FOUR_BAR)
    page.drag('.handle[data-name="O4"]', 15, 6)
    agrees(page)


def test_a_pin_of_a_block_stays_where_it_is_in_the_block(opened: Any) -> None:
    page = opened(SHAPER)
    before = page.value("links.block.points.A.0"), page.value("links.crank.points.A.0")
    page.drag('.handle[data-name="A"]', 8, -8)
    assert page.value("links.block.points.A.0") == before[0]
    assert page.value("links.crank.points.A.0") != before[1]
    agrees(page)


def test_a_dragged_mass_centre(opened: Any) -> None:
    page = opened(FOUR_BAR)
    before = page.curve("effort.O2")[0]
    page.drag('.handle.center[data-name^="rocker"]', 20, 0)
    assert page.curve("effort.O2")[0] != before
    agrees(page)


def test_a_dragged_load(opened: Any) -> None:
    page = opened(FOUR_BAR)
    size = page.value("loads.F_P.value")
    page.drag('.handle.load[data-name="F_P"]', 30, 10)
    assert page.value("loads.F_P.value") > 1.2 * size
    agrees(page)


def test_a_turned_slide(opened: Any) -> None:
    page = opened("toggle_press")
    before = page.value("joints.guide.direction")
    page.drag('.handle.direction[data-name="guide"]', 12, 0)
    assert page.value("joints.guide.direction") != before


def test_the_drive_follows_its_dragged_link(opened: Any) -> None:
    page = opened(FOUR_BAR)
    before = page.page.locator(".readout").inner_text()
    page.drag('path[data-link="crank"]', -40, 20)
    assert page.page.locator(".readout").inner_text() != before


def test_a_joint_is_moved_by_the_arrow_keys(opened: Any) -> None:
    page = opened(FOUR_BAR)
    before = page.value("links.rocker.points.B.0")
    page.page.locator('.handle[data-name="B"]').focus()
    page.page.keyboard.press("ArrowRight")
    page.frame()
    assert page.value("links.rocker.points.B.0") != before
    agrees(page)


def test_far_drags_stop_closing_and_come_back(opened: Any) -> None:
    page = opened(FOUR_BAR)
    page.drag('.handle[data-name="A"]', 250, 100)
    _, good = page.curve("effort.O2")
    r = da.dynamics(da.loads(page.run("page.text()")))
    assert good == list(r.ok)
    assert not all(good)
    page.run(f"page.show({good.index(False)})")
    assert "does not close" in page.page.locator(".mark").inner_text()
    tab(page, "Numbers")
    assert page.run("document.querySelector('.answers td').textContent") == "–"
    page.page.get_by_label("undo").click()
    page.frame()
    assert page.page.locator(".mark").inner_text() == ""
    assert all(page.curve("effort.O2")[1])


def test_undo_and_redo(opened: Any) -> None:
    page = opened(FOUR_BAR)
    first = page.value("links.rocker.points.B.0")
    page.drag('.handle[data-name="B"]', 15, 0)
    second = page.value("links.rocker.points.B.0")
    page.page.keyboard.press("Control+z")
    page.frame()
    assert page.value("links.rocker.points.B.0") == first
    page.page.keyboard.press("Control+y")
    page.frame()
    assert page.value("links.rocker.points.B.0") == second
    page.page.get_by_text("Reset").click()
    page.frame()
    assert page.value("links.rocker.points.B.0") == first
    page.page.get_by_label("undo").click()
    page.frame()
    assert page.value("links.rocker.points.B.0") == second


def test_a_typed_number(opened: Any) -> None:
    page = opened(FOUR_BAR)
    tab(page, "Change")
    box = page.page.locator(
        'input[data-path="loads.resistance.value"], input[data-path="links.rocker.inertia"]'
    ).first
    path = box.get_attribute("data-path")
    before = page.value(path)
    box.fill("3")
    box.press("Enter")
    page.frame()
    assert page.value(path) != before
    agrees(page)


def test_an_emptied_number_comes_back(opened: Any) -> None:
    page = opened(FOUR_BAR)
    tab(page, "Change")
    box = page.page.locator('input[data-path="links.rocker.inertia"]')
    before = page.value("links.rocker.inertia")
    box.fill("")
    box.press("Enter")
    page.frame()
    assert page.value("links.rocker.inertia") == before


def test_the_slider_and_a_curve_move_the_drive(opened: Any) -> None:
    page = opened(FOUR_BAR)
    page.page.get_by_label("position in the cycle").fill("10")
    page.frame()
    assert page.page.locator(".readout").inner_text() == "O2 = 110°"
    x, y = page.place(".chart svg")
    page.page.mouse.click(x, y)
    page.frame()
    assert page.page.locator(".readout").inner_text() != "O2 = 110°"


def test_between_positions_it_is_exact_too(opened: Any) -> None:
    page = opened(ENGINE)
    m = da.load(FILES[ENGINE])
    found = page.run(
        """(() => { const c = page.data.views.charts[0].curves[0]; return [0.25, 10.5, 33.125].map(t => {
        page.kernel.at(t); return [page.kernel.position('O2', t), page.kernel.here[c.row]]; }); })()"""
    )
    for position, effort in found:
        at = m.with_values({"drives.O2.position": position})
        assert effort == pytest.approx(float(da.dynamics(at).effort("O2")[0]), rel=1e-9)


def test_play_and_stop(opened: Any) -> None:
    page = opened(FOUR_BAR)
    page.page.get_by_label("play along").click()
    page.until("document.querySelector('.readout').textContent !== 'O2 = 60°'")
    page.page.get_by_label("play along").click()
    page.frame()
    stopped = page.page.locator(".readout").inner_text()
    page.frame()
    assert page.page.locator(".readout").inner_text() == stopped


def test_a_link_is_chosen_by_a_click(opened: Any) -> None:
    page = opened(FOUR_BAR)
    tab(page, "Forces")
    page.page.mouse.click(*page.place('.stage path[data-link="rocker"]'))
    page.frame()
    assert "rocker" in page.run("document.querySelector('.panels select').selectedOptions[0].textContent")
    assert page.page.locator(".body:visible .equation").count() == 3
    sums = page.page.locator(".body:visible .equation").all_inner_texts()
    assert [text.split(" = ")[-1].split()[0] for text in sums] == ["0"] * 3


def test_the_numbers_of_the_position_are_those_of_the_analysis(opened: Any) -> None:
    page = opened(FOUR_BAR)
    tab(page, "Numbers")
    text = page.page.locator(".answers").inner_text()
    assert "243.2 lbf·in" in text
    assert re.search(r"F23 in A\s+154.8 lbf at −139.7°", text)


def test_polygons_and_polar_diagrams_open(opened: Any) -> None:
    page = opened(FOUR_BAR)
    tab(page, "Forces")
    assert page.page.locator(".polygon:visible").count() == 2
    assert (
        "In the order of solution: 3 coupler → 4 rocker → 2 crank"
        in page.page.locator(".polygon:visible").last.inner_text()
    )
    assert page.page.locator(".polygon:visible svg path").count() > 4
    tab(page, "Curves")
    assert page.page.locator(".polar:visible").count() == 4


def test_arrows_say_what_lowers_the_peak(opened: Any) -> None:
    page = opened(FOUR_BAR)
    page.page.get_by_text("what lowers the peak").click()
    page.frame()
    assert page.page.locator(".gradient g:visible").count() >= 2
    drawn = page.run(
        "getComputedStyle(document.querySelectorAll('.gradient g')[1].querySelector('path')).stroke"
    )
    assert drawn not in ("none", "rgb(0, 0, 0)")  # the role has a colour in each theme
    before = max(map(abs, page.curve("effort.O2")[0]))
    tip = page.run(TIP)
    handle = page.run(
        "document.querySelectorAll('.gradient g')[1].querySelector('title').textContent"
    ).split()[-1]
    long = math.hypot(*tip) or 1.0
    page.drag(f'.handle[data-name="{handle}"]', 4 * tip[0] / long, 4 * tip[1] / long)
    assert max(map(abs, page.curve("effort.O2")[0])) < before


def test_a_cloud_of_tolerances(opened: Any) -> None:
    page = opened(FOUR_BAR)
    page.page.get_by_text("tolerances").click()
    page.frame()
    assert re.search(r"O2: .* ± [\d.]+ lbf·in", page.page.locator(".spread").inner_text())
    painted = page.run(PAINTED)
    assert painted
    assert all(page.curve("effort.O2")[1])


def test_the_address_keeps_the_state(opened: Any) -> None:
    page = opened(FOUR_BAR)
    page.drag('.handle[data-name="B"]', 15, 0)
    value = page.value("links.rocker.points.B.0")
    page.page.reload()
    page.until("window.page !== undefined")
    assert page.value("links.rocker.points.B.0") == value
    page.requests.clear()
    page.requests.append("file:")


@pytest.mark.parametrize(
    ("button", "ending", "begins"),
    [
        ("Model file", ".yaml", "title: "),
        ("Curves as CSV", ".csv", "O2 [°]"),
        ("Drawing as SVG", ".svg", "<svg"),
        ("Drawing as PNG", ".png", "PNG"),
    ],
)
def test_what_is_saved(opened: Any, button: str, ending: str, begins: str, tmp_path: Any) -> None:
    page = opened(FOUR_BAR)
    tab(page, "Save")
    with page.page.expect_download() as found:
        page.page.get_by_role("button", name=button).click()
    assert found.value.suggested_filename.endswith(ending)
    found.value.save_as(tmp_path / "saved")
    text = (tmp_path / "saved").read_text(encoding="utf-8", errors="replace")
    assert begins in text[:200]
    page.requests[1:] = [url for url in page.requests[1:] if not url.startswith("blob:")]


def test_space_is_seen_from_elsewhere_and_computed_anew(opened: Any) -> None:
    page = opened("rssr")
    before = page.run("document.querySelector('.stage path[data-link]').getAttribute('d')")
    page.drag(".stage svg", 80, 30)
    assert page.run("document.querySelector('.stage path[data-link]').getAttribute('d')") != before
    tab(page, "Forces")
    assert page.page.locator(".body:visible .equation").count() == 6
    tab(page, "Change")
    box = page.page.locator('input[data-path="loads.resistance.value"]')
    box.fill("3")
    box.press("Enter")
    page.frame()
    agrees(page, "O")


def test_a_joint_in_space_goes_where_the_picture_shows_it(opened: Any) -> None:
    page = opened("rssr")
    before = page.value("links.rocker.points.B.0")
    page.drag('.handle[data-name="B"]', 6, -9)
    assert page.value("links.rocker.points.B.0") != before
    agrees(page, "O")


def test_names_are_off_for_many_joints_and_can_be_had(opened: Any) -> None:
    page = opened(LIFT)
    assert page.page.locator(".stage").get_by_label("names").is_checked() is False
    page.page.locator(".stage").get_by_label("names").check()
    page.frame()
    assert page.page.locator('.stage svg text:visible:has-text("cross_1")').count() >= 1


def test_a_joint_placed_by_a_parameter_takes_it_along(opened: Any) -> None:
    page = opened(html=da.page(da.loads(PARAMETRIC)))
    page.drag('.handle[data-name="A"]', 30, 0)
    assert 0.046 < page.value("r") < 0.09
    agrees(page, "O")


@pytest.mark.parametrize("name", [FOUR_BAR, ENGINE, SHAPER])
def test_no_text_lies_over_text(opened: Any, name: str) -> None:
    """After a drag too, at several places of the cycle."""
    page = opened(name)
    page.drag(".handle.joint", 12, 9)
    for t in (0, 9, 17.5, 30):
        page.run(f"page.show({t})")
        over = page.run(OVERLAPS)
        assert over == []


def test_a_phone(opened: Any) -> None:
    page = opened(ENGINE, has_touch=True)
    page.page.set_viewport_size({"width": 390, "height": 844})
    page.frame()
    assert page.run("document.documentElement.scrollWidth") <= 390
    _, y = page.place(".chart svg")
    page.page.mouse.wheel(0, y)
    page.page.touchscreen.tap(*page.place(".bar button"))
    page.frame()
    assert page.run("page.kernel.solved")


def test_the_dark(opened: Any) -> None:
    page = opened(FOUR_BAR, color_scheme="dark")
    ink = page.run("getComputedStyle(document.querySelector('.dalembert')).backgroundColor")
    assert ink == "rgb(21, 27, 34)"
    stroke = page.run("getComputedStyle(document.querySelector('.l-link')).stroke")
    assert stroke == "rgb(232, 237, 242)"


def test_print_shows_the_drawing_without_the_controls(opened: Any) -> None:
    page = opened(FOUR_BAR)
    page.page.emulate_media(media="print")
    assert page.page.locator(".bar").is_visible() is False
    assert page.page.locator(".stage svg").is_visible()


def test_hostile_titles_and_names_stay_text(opened: Any) -> None:
    m = da.load(FILES[FOUR_BAR]).model_copy(update={"title": HOSTILE})
    page = opened(html=html_text(page_data(m)))
    assert page.page.locator("h1").inner_text() == HOSTILE
    assert page.page.locator("h1 b, img").count() == 0


def test_a_hostile_address_changes_nothing(opened: Any) -> None:
    page = opened(FOUR_BAR)
    before = page.curve("effort.O2")[0]
    page.run("location.hash = '#t=1e99&links.rocker.inertia=NaN&%E0%A4%A=1&nothing=2&<img>=3'")
    page.page.reload()
    page.until("window.page !== undefined")
    assert page.curve("effort.O2")[0] == before
    page.requests[1:] = []


def test_every_control_has_a_name(opened: Any) -> None:
    page = opened(ENGINE)
    tab(page, "Change")
    nameless = page.run(NAMELESS)
    assert nameless == []


@pytest.mark.parametrize(("name", "scheme"), [(FOUR_BAR, "light"), (FOUR_BAR, "dark"), ("rssr", "light")])
def test_nothing_is_in_the_way_of_those_who_see_or_reach_less(opened: Any, name: str, scheme: str) -> None:
    """By axe-core, which `make web` brings: names, roles, contrast, order."""
    if not AXE.exists():
        pytest.skip("web/node_modules has no axe-core: make web")
    page = opened(name, color_scheme=scheme)
    tab(page, "Forces")
    page.page.evaluate(AXE.read_text(encoding="utf-8"))
    faults = page.page.evaluate("async () => (await axe.run()).violations")
    serious = [
        (f["id"], [n["html"][:90] for n in f["nodes"][:3]])
        for f in faults
        if f["impact"] in ("serious", "critical")
    ]
    assert serious == []


def test_friction_is_greyed_where_it_has_no_answer(opened: Any) -> None:
    name = "seed-f-2d-rod-at-45-deg-12"
    page = opened(name)
    m = with_cycle(da.load(FILES[name]))
    r = da.dynamics(m) if m.has_speeds else da.statics(m)
    bad = r.status.index("jammed")
    page.run(f"page.show({bad})")
    assert page.run("document.querySelector('.dalembert').classList.contains('unsolved')")
    said = page.page.locator(".mark").inner_text()
    assert said.startswith("Friction jams the mechanism")
    assert (r.reasons[bad] or "").startswith(said)
