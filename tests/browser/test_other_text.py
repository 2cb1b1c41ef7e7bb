"""What is shown of forces, numbers and answers is that of the text and options that are shown, however they come."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.studio.problems import problem_text
from tests.browser.studio_tab import Studio, tabs
from tests.studio.served import serving

__all__ = ["tabs"]

FOUR_BAR = problem_text("example", "four_bar")
HELD = """() => { const page = studio.page(), put = page.replace;
page.replace = async (...a) => { window.waits = true;
  await new Promise(go => { window.go = go; }); await put(...a); }; }"""
"""The page of forces takes other data only when it is told to go."""
SLOW = """() => { const socket = studio.socket, send = socket.send.bind(socket);
socket.send = async m => { const a = send(m); if (m.edit && !window.go) {
  await new Promise(go => { window.go = go; }); } return a; }; }"""
"""The answer of the first edit is taken only when it is told to go."""


LATE = """() => { const make = WebAssembly.instantiate, all = [];
WebAssembly.instantiate = (...a) => new Promise(go => { window.waits = true; all.push(go); }).then(() => make(...a));
window.go = () => { WebAssembly.instantiate = make; for (const go of all) go(); }; }"""
"""Programs of the page are ready only when it is told to go."""
FRAMES = """async () => { for (let k = 0; k < 4; k++) { studio.page().redraw();
await new Promise(done => requestAnimationFrame(done)); } }"""


def typed(s: Studio, text: str) -> None:
    """Letters at the end of the file."""
    s.page.evaluate(
        "t => studio.editor.view.dispatch({ changes: { from: studio.editor.view.state.doc.length, insert: t } })",
        text,
    )


def held(s: Studio, act: Any) -> None:
    """Do something whose forces then wait to be put into the page."""
    s.settled()
    s.page.evaluate(HELD)
    act()
    s.until("window.waits")


@pytest.fixture
def studio(tabs: Any, tmp_path: Path) -> Any:
    (tmp_path / "m.yaml").write_text(FOUR_BAR, encoding="utf-8")
    with serving(tmp_path / "m.yaml") as served:
        yield tabs(served)


@pytest.mark.long
def test_the_fault_of_a_text_is_not_covered_by_forces_of_the_text_before(studio: Studio) -> None:
    s = studio
    held(s, lambda: typed(s, "# a remark\n"))
    s.changes(lambda: typed(s, ": wrong\n"))
    s.page.evaluate("window.go()")
    s.settled()
    assert s.page.inner_text(".verdict").startswith("Line ")
    assert "stale" in str(s.page.get_attribute(".pane.forces", "class"))


@pytest.mark.long
def test_forces_are_not_taken_for_those_of_another_option(studio: Studio) -> None:
    s = studio
    held(s, lambda: typed(s, "# a remark\n"))
    s.page.get_by_label("dynamics", exact=True).click()
    s.answered()
    s.page.evaluate("const go = window.go; window.waits = false; go()")
    s.until("window.waits")
    assert s.page.inner_text(".verdict") == "…"
    assert not s.page.evaluate("studio.settled()")
    s.page.evaluate("window.go()")
    assert s.effort() == pytest.approx(float(da.statics(da.loads(s.text)).effort("O2")[0]), rel=1e-9)


@pytest.mark.long
def test_what_is_typed_while_an_edit_is_on_its_way_is_saved_too(studio: Studio, tmp_path: Path) -> None:
    s = studio
    s.page.evaluate(SLOW)
    typed(s, "# one")
    s.until("window.go")
    typed(s, " and two")
    s.page.keyboard.press("Control+s")
    s.page.evaluate("window.go()")
    s.until("!studio.state().dirty && studio.answered()")
    assert (tmp_path / "m.yaml").read_text(encoding="utf-8") == FOUR_BAR + "# one and two"


@pytest.mark.long
def test_values_beside_the_one_that_is_typed_are_those_of_the_text(studio: Studio) -> None:
    s = studio
    s.choose("links", "crank")
    box = s.page.locator(".pane.part input[aria-label=name]")
    box.focus()
    s.page.keyboard.press("End")
    s.page.keyboard.type("_1")
    s.changes(lambda: s.gesture({"op": "set", "path": ["links", "crank", "weight"], "value": "2.25 lbf"}))
    assert s.page.locator(".pane.part input[aria-label=weight]").input_value() == "2.25 lbf"
    s.page.keyboard.type("2")
    s.changes(lambda: s.page.keyboard.press("Enter"))
    assert "crank_12" in da.loads(s.text).links


@pytest.mark.long
def test_answers_of_another_text_are_taken_away(studio: Studio) -> None:
    s = studio
    s.page.click("[role=tab][data-pane=Answers]")
    s.page.click("button:text-is('Other assemblies')")
    s.page.wait_for_selector(".modes img")
    s.changes(lambda: s.page.click(".modes button:not([disabled])"))
    s.page.wait_for_selector(".modes img")
    s.settled()
    assert s.page.locator(".modes button[disabled]").inner_text() == "as drawn"
    s.changes(lambda: typed(s, "# a remark\n"))
    assert s.page.locator(".modes").count() == 0
    assert "ask again" in s.page.inner_text(".answer")


@pytest.mark.long
def test_ticks_are_those_of_the_text(studio: Studio) -> None:
    s = studio
    s.changes(
        lambda: typed(
            s, "\nanswers:\n  - {quantity: effort, of: O2, value: 243.23 lbf*in, tolerance: 0.02}\n"
        )
    )
    s.page.click("[role=tab][data-pane=Problems]")
    s.page.wait_for_selector(".answers .ok")
    s.changes(lambda: s.gesture({"op": "set", "path": ["links", "crank", "weight"], "value": "9 lbf"}))
    s.page.wait_for_selector(".answers .off")
    assert s.page.locator(".answers .ok").count() == 0


@pytest.mark.long
def test_numbers_of_the_page_that_the_text_refuses_come_back(studio: Studio) -> None:
    s = studio
    before = s.effort()
    s.page.click("[role=tab][data-pane=Forces]")
    s.page.evaluate(FRAMES)  # it has its size
    s.page.evaluate(
        """() => { const gesture = studio.socket.gesture.bind(studio.socket);
        studio.socket.gesture = a => gesture(a.op === 'changes' ? { op: 'changes', values: { nothing: 1 } } : a); }"""
    )
    handle = s.page.locator(".pane.forces .handle[data-name=A]").first.bounding_box()
    x, y = handle["x"] + handle["width"] / 2, handle["y"] + handle["height"] / 2
    s.page.mouse.move(x, y)
    s.page.mouse.down()
    s.page.mouse.move(x + 12, y + 9, steps=3)
    assert s.page.evaluate("[...studio.page().kernel.values]") != s.page.evaluate(
        "studio.page().data.numbers.map(n => n.value)"
    )
    s.page.mouse.up()
    s.settled()
    assert s.page.inner_text(".banners .refusal")
    assert s.effort() == before
    assert s.text == FOUR_BAR


@pytest.mark.long
def test_the_page_is_drawn_while_one_of_other_positions_is_made(studio: Studio) -> None:
    """Without a complaint of the browser, before and after the other one takes its place."""
    s = studio
    s.settled()
    s.page.click("[role=tab][data-pane=Forces]")
    s.page.evaluate("studio.page().show(60)")
    s.page.evaluate(LATE)
    position = {"from": 60, "to": 420, "count": 7}
    s.changes(
        lambda: s.gesture({"op": "set", "path": ["drives", "O2", "position"], "value": json.dumps(position)})
    )
    s.until("window.waits")
    s.page.evaluate(FRAMES)
    assert s.page.evaluate("studio.page().view.t") == 60
    s.page.evaluate("() => { studio.page().redraw(); window.go(); }")
    s.settled()
    s.page.evaluate(FRAMES)
    assert s.page.evaluate("[studio.page().view.t, studio.page().kernel.count]") == [0, 7]
