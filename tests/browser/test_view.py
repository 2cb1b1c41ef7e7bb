"""How a page is looked at: zoom, pan, what is under the pointer, switches, paths of points, other data in its place."""

from __future__ import annotations

import math
from typing import Any

import pytest

import dalembert as da
from dalembert.pages.page_data import page_data
from tests.browser.opened import FILES
from tests.browser.test_page import FOUR_BAR, OVERLAPS, tab

pytestmark = pytest.mark.long

PLACE = """n => { const p = page.kernel.here, h = page.data.handles.find(x => x.kind === 'joint' && x.name === n);
return h.p.map(r => p[r]); }"""


def test_the_wheel_zooms_about_the_pointer_and_a_drag_moves_the_paper(opened: Any) -> None:
    page = opened(FOUR_BAR)
    x, y = page.place('.handle[data-name="B"]')
    other = page.place('.handle[data-name="O2"]')
    page.page.mouse.move(x, y)
    page.page.mouse.wheel(0, -400)
    page.frame()
    assert page.place('.handle[data-name="B"]') == pytest.approx((x, y), abs=0.6)
    far = page.place('.handle[data-name="O2"]')
    assert math.dist(far, (x, y)) == pytest.approx(math.exp(0.6) * math.dist(other, (x, y)), rel=0.01)
    page.drag(".stage svg", 60, -40)  # its middle is empty
    assert page.place('.handle[data-name="B"]') == pytest.approx((x + 60, y - 40), abs=1)
    page.drag('.handle[data-name="B"]', 15, 5)
    assert page.run("page.view.window !== null")  # a change keeps the window
    page.page.locator(".stage svg").focus()
    page.page.keyboard.press("0")
    page.frame()
    assert page.run("page.view.window") is None


def test_nothing_is_rescaled_while_a_joint_is_dragged(opened: Any) -> None:
    page = opened(FOUR_BAR)
    still = page.place('.handle[data-name="O2"]')
    x, y = page.place('.handle[data-name="B"]')
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    for k in range(1, 9):
        page.page.mouse.move(x + 5 * k, y - 4 * k)
        page.frame()
        assert page.place('.handle[data-name="O2"]') == pytest.approx(still, abs=0.2)
        assert page.place('.handle[data-name="B"]') == pytest.approx((x + 5 * k, y - 4 * k), abs=1.5)
    page.page.mouse.up()
    page.frame()
    assert page.place('.handle[data-name="O2"]') == pytest.approx(still, abs=0.2)  # it still fits


def test_what_is_under_the_pointer_has_a_name(opened: Any) -> None:
    page = opened(FOUR_BAR)
    at = page.place('.handle[data-name="A"]')
    hit = page.page.evaluate("p => page.hit(...p).map(i => [i.kind, i.name])", list(at))
    assert hit[0] == ["joint", "A"]
    assert {"crank", "coupler"} <= {name for kind, name in hit if kind == "link"}
    assert page.page.evaluate("page.hit(700, 150)") == []
    place = page.page.evaluate(PLACE, "A")
    assert page.page.evaluate("p => page.metres(...p)", list(at)) == pytest.approx(place, abs=2e-4)
    page.page.mouse.click(*at)
    page.frame()
    assert page.run("page.view.chosen") == {"kind": "joint", "name": "A"}
    assert page.page.locator(".chosen").count() >= 2


def test_the_menu_traces_a_point_of_the_coupler(opened: Any) -> None:
    """The path is that of the point whose place da.dynamics gives."""
    page = opened(FOUR_BAR)
    at = page.place('.handle.center[data-name^="coupler"]')
    page.page.mouse.click(*at, button="right")
    page.page.get_by_text("Path of this point of coupler").click()
    page.frame()
    ((link, u),) = [(p["link"], p["u"]) for p in page.run("page.view.tracers")]
    m = da.load(FILES[FOUR_BAR])
    assert (link, u) == ("coupler", pytest.approx(list(m.center("coupler")), abs=1e-9))
    drawn = page.run("document.querySelector('.tracers path').getAttribute('d')").replace("M", "")
    dots = [tuple(map(float, p.split(" "))) for p in drawn.split("L")]
    path = da.dynamics(da.loads(page.run("page.text()"))).center("coupler")
    corner = page.page.evaluate("p => page.paper(p)", path[0].tolist())
    for k in (0, 20, 50):
        assert page.page.evaluate("p => page.paper(p)", path[k].tolist()) == pytest.approx(dots[k], abs=0.02)
    assert math.dist(corner, dots[20]) > 5
    page.page.reload()
    page.until("window.page !== undefined")
    assert page.run("page.view.tracers.length") == 1  # the address keeps it
    page.requests[1:] = []


def test_a_crank_pin_turns_the_crank(opened: Any) -> None:
    page = opened(FOUR_BAR)
    (x, y), (ox, oy) = (page.place(f'.handle[data-name="{name}"]') for name in ("A", "O2"))
    page.page.get_by_role("button", name="turn", exact=True).click()
    page.frame()
    before = page.run("[...page.kernel.values]")
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    for k in range(1, 13):
        a = math.atan2(oy - y, x - ox) + k * math.radians(10)
        reach = math.hypot(x - ox, y - oy)
        page.page.mouse.move(ox + reach * math.cos(a), oy - reach * math.sin(a))
        page.frame()
    page.page.mouse.up()
    assert page.run("[...page.kernel.values]") == before
    turned = math.degrees(page.run("page.kernel.position('O2', page.view.t)"))
    assert turned == pytest.approx(180, abs=1.5)


def test_switches_values_digits_and_steps(opened: Any) -> None:
    page = opened(FOUR_BAR)
    arrows = ".stage svg [data-item^='{}:'] path:visible"
    assert page.page.locator(arrows.format("inertia")).count() > 0
    for name in ("inertia", "velocities", "values", "large digits"):
        page.page.get_by_label(name, exact=True).click()
    page.frame()
    assert page.page.locator(arrows.format("inertia")).count() == 0
    assert page.page.locator(".digits").inner_text() == "O2 243.2 lbf·in"
    names = page.page.locator(".stage svg text:visible").all_text_contents()
    assert "F23 = 154.8 lbf" in names
    m = da.load(FILES[FOUR_BAR])
    r = da.dynamics(m)
    speed = float(math.hypot(*r.point_velocity("crank", "A")[0])) / 0.0254
    assert f"vA = {speed:.4g} in/s" in names
    assert page.run(OVERLAPS) == []
    page.page.keyboard.press(".")
    page.page.keyboard.press(">")
    page.frame()
    assert page.run("page.view.t") == 11
    said = page.page.evaluate("location.hash")
    assert "values" in said
    assert "hide=inertia" in said.replace("%7E", "~")


def test_other_data_take_its_place_without_a_change_of_view(opened: Any) -> None:
    """As a studio does after each edit: the pose, the window, the tab and what is chosen stay."""
    page = opened(FOUR_BAR)
    tab(page, "Forces")
    page.run("page.show(20.25)")
    page.page.mouse.move(*page.place('.handle[data-name="B"]'))
    page.page.mouse.wheel(0, -200)
    page.frame()
    pose, window = page.run("page.pose()"), page.run("page.view.window")
    other = da.load(FILES[FOUR_BAR]).with_values({"links.coupler.mass": 3.0})
    page.page.evaluate("async d => { await page.replace(d); }", page_data(other))
    page.frame()
    assert page.run("page.view.window") == window
    assert page.page.locator('[role=tab][aria-selected="true"]').inner_text() == "Forces"
    for link, placed in page.run("page.pose()").items():
        assert placed == pytest.approx(pose[link], abs=1e-9)
    at = page.run("page.kernel.position('O2', page.view.t)")
    row = page.run("page.data.views.charts[0].curves[0].row")
    exact = da.dynamics(other.with_values({"drives.O2.position": at})).effort("O2")[0]
    assert page.run(f"page.kernel.here[{row}]") == pytest.approx(float(exact), rel=1e-9)


def test_two_fingers_zoom(opened: Any) -> None:
    page = opened(FOUR_BAR, has_touch=True)
    before = page.run("page.metres(101, 100)[0] - page.metres(100, 100)[0]")
    client = page.page.context.new_cdp_session(page.page)

    def touch(kind: str, *points: tuple[float, float]) -> None:
        shown = [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(points)]
        client.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": shown})

    touch("touchStart", (640, 120), (700, 120))
    touch("touchMove", (620, 120), (740, 120))
    touch("touchEnd")
    page.frame()
    assert page.run("page.metres(101, 100)[0] - page.metres(100, 100)[0]") == pytest.approx(
        before / 2, rel=0.02
    )
