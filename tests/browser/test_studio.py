"""The studio in a real browser: mechanisms drawn from nothing with the mouse and typed lengths have the forces of the
templates; the file is edited either way, and nothing is lost."""

from __future__ import annotations

import json
import math
from pathlib import Path
from random import Random
from typing import Any

import pytest

import dalembert as da
from dalembert.studio.document import EMPTY
from dalembert.studio.problems import problem_text
from tests.browser.studio_tab import Studio, tabs
from tests.studio.served import serving

__all__ = ["tabs"]

FOUR_BAR = problem_text("example", "four_bar")


def polar(a: tuple[float, float], length: float, degrees: float) -> tuple[float, float]:
    return a[0] + length * math.cos(math.radians(degrees)), a[1] + length * math.sin(math.radians(degrees))


def draw_four_bar(s: Studio) -> da.Mechanism:
    s.click("x", 0, 0)
    s.click("x", 0.1, 0)
    s.line("b", (0, 0), (0.02, 0.03), "40", "60")
    s.line("b", polar((0, 0), 0.04, 60), (0.13, 0.07))
    s.line("b", (0.13, 0.07), (0.1, 0))
    s.click("d", 0, 0)
    s.field("link3", "length", "120 mm")
    s.field("link4", "length", "80")
    s.page.keyboard.press("m")
    s.page.keyboard.type("12.5 N*m")
    x, y = s.point("link4", "D")
    s.changes(lambda: s.page.mouse.click(*s.pixel((x + 0.1) / 2, y / 2)))
    m = da.four_bar(crank="40 mm", coupler="120 mm", rocker="80 mm", ground="100 mm", positions=1)
    tree = m.to_tree() | {"loads": {"T": {"type": "couple", "on": "rocker", "value": 12.5}}}
    return da.Mechanism.model_validate(tree).with_values(
        {"drives.O2.position": "60 deg", "drives.O2.speed": 0.0}
    )


def test_a_four_bar_dragged_and_typed_is_saved_and_undone_to_nothing(tabs: Any, tmp_path: Path) -> None:
    with serving(tmp_path / "m.yaml") as served:
        s = tabs(served)
        like = draw_four_bar(s)
        expected = float(da.statics(like).effort("O2")[0])
        m = da.loads(s.text)
        assert float(da.statics(m).effort(next(iter(m.drives)))[0]) == pytest.approx(expected, rel=1e-9)
        assert s.effort() == pytest.approx(expected, rel=1e-9)
        s.page.keyboard.press("Control+s")
        s.until("!studio.state().dirty")
        assert (tmp_path / "m.yaml").read_text(encoding="utf-8") == s.text
        while s.page.evaluate("studio.state().undo"):
            s.page.evaluate("studio.hand.cancel()")
            s.changes(lambda: s.page.click("[aria-label=undo]"))
        assert s.text == EMPTY


@pytest.mark.long
def test_the_file_beside_the_drawing_is_edited_either_way(tabs: Any, tmp_path: Path) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(FOUR_BAR, encoding="utf-8")
    with serving(path) as served:
        one, two = tabs(served), tabs(served)
        one.page.click("[role=tab][data-pane=File]")
        one.page.click(".cm-line:has-text('coupler:') >> nth=0")
        one.page.keyboard.press("Home")
        one.changes(lambda: one.page.keyboard.type("  : wrong"))
        one.until("studio.state().error")
        line = one.page.evaluate("studio.state().line")
        assert FOUR_BAR.splitlines()[line - 1].startswith("  coupler:")
        one.page.wait_for_selector(".cm-lint-marker-error")
        assert f"Line {line}" in one.page.inner_text(".verdict")
        two.until("studio.state().error")
        assert two.page.evaluate("studio.state().drawing.links.length") == 4, "the last good drawing stays"
        while two.text != FOUR_BAR:  # a step for each pause of the typing
            two.changes(lambda: two.page.keyboard.press("Control+z"))
        one.reads(FOUR_BAR)
        assert one.page.evaluate(
            "[...document.querySelectorAll('.cm-line')].map(x => x.textContent).join('\\n')"
        ) == FOUR_BAR.replace("\r", "")
        a = one.point("ground", "O4")
        one.line("v", a, (a[0] - 0.02, a[1]))
        two.until("studio.state().dirty")
        changed = [x for x, y in zip(two.text.splitlines(), FOUR_BAR.splitlines(), strict=True) if x != y]
        assert any("O4:" in x for x in changed)
        assert len(changed) <= 3
        path.write_text("# theirs\n" + FOUR_BAR, encoding="utf-8")
        one.page.click(".choice button:has-text('Load it')")
        one.until("studio.state().text.startsWith('# theirs')")
        assert not one.page.evaluate("studio.state().dirty")
        said = "# typed while earlier letters are on their way "
        one.page.click("[role=tab][data-pane=File]")
        one.page.click(".cm-line >> nth=0")
        one.page.keyboard.press("Home")
        one.page.keyboard.type(said, delay=45)
        two.until(f"studio.state().text.startsWith('{said}# theirs')")


@pytest.mark.long
def test_a_server_that_was_killed_gives_back_what_was_typed(tabs: Any, tmp_path: Path) -> None:
    path = tmp_path / "m.yaml"
    with serving(path) as served:
        s = tabs(served)
        s.click("x", 0, 0)
        s.click("x", 0.1, 0)
        text = s.text
    s.page.wait_for_selector(".ended")
    assert "has stopped" in s.page.inner_text(".ended")
    assert not path.exists()
    with serving(path) as served:
        s = tabs(served)
        assert s.text == text
        assert "not saved" in s.page.inner_text(".choice")
        s.page.click(".choice button:has-text('Go back')")
        s.until("!studio.state().kept")
        assert s.text == EMPTY


@pytest.mark.long
def test_esc_leaves_text_and_undo_as_they_were(tabs: Any, tmp_path: Path) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(FOUR_BAR, encoding="utf-8")
    with serving(path) as served:
        s = tabs(served)
        a, b = s.point("crank", "A"), s.point("rocker", "B")
        for key in "bsogfknc":
            s.page.keyboard.press(key)
            s.page.mouse.click(*s.pixel(*a))
            s.page.mouse.move(*s.pixel(*b), steps=2)
            s.page.keyboard.type("12")
            s.page.keyboard.press("Escape")
            assert s.page.evaluate("studio.canvas.preview.childElementCount") == 0
        s.page.keyboard.press("Escape")
        assert s.page.evaluate("studio.hand.tool.name") == "select"
        s.answered()
        assert (s.text, s.page.evaluate("studio.state().undo")) == (FOUR_BAR, False)


@pytest.mark.long
def test_a_printed_problem_is_ticked(tabs: Any, tmp_path: Path) -> None:
    with serving(tmp_path / "m.yaml") as served:
        s = tabs(served)
        s.page.click("[role=tab][data-pane=Problems]")
        s.changes(lambda: s.page.click(".list button[title='4b-06-bevan-four-bar']"))
        s.page.wait_for_selector(".answers .ok")
        assert s.page.locator(".answers .off").count() == 0
        s.effort()


@pytest.mark.long
def test_a_phone_draws_with_taps(tabs: Any, tmp_path: Path) -> None:
    with serving(tmp_path / "m.yaml") as served:
        s = tabs(served, has_touch=True, viewport={"width": 390, "height": 844})
        for tool, *taps in (
            ("ground", (0, 0)),
            ("bar", (0, 0), (0.03, 0.04)),
            ("bar", (0.03, 0.04), (0.08, 0.05)),
        ):
            s.page.tap(f"[data-tool={tool}]")
            s.until(f"studio.hand.tool.name === '{tool}'")
            before = s.page.evaluate("studio.state().hash")
            for at in taps:
                s.page.touchscreen.tap(*s.pixel(*at))
            s.until(f"studio.answered() && studio.state().hash !== '{before}'")
        m = da.loads(s.text)
        assert list(m.joints) == ["A", "B"]
        assert s.page.evaluate("document.documentElement.scrollWidth") <= 390


@pytest.mark.long
def test_what_is_deleted_while_it_is_dragged_is_let_go(tabs: Any, tmp_path: Path) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(FOUR_BAR, encoding="utf-8")
    with serving(path) as served:
        s = tabs(served)
        at = s.page.evaluate("studio.state().drawing.links.find(l => l.name === 'coupler').points.P")
        x, y = s.pixel(*at)
        s.page.keyboard.press("v")
        s.page.mouse.move(x, y)
        s.page.mouse.down()
        s.page.mouse.move(x + 30, y, steps=3)
        s.page.keyboard.press("Delete")
        s.answered()
        s.page.mouse.move(x + 60, y, steps=3)
        s.page.mouse.up()
        s.answered()
        assert "P" not in da.loads(s.text).links["coupler"].points


HANDLE = """[...document.querySelectorAll('.pane.forces:not(.stale) .handle.joint')]
.map(e => e.getBoundingClientRect()).filter(b => b.width).map(b => [b.x + b.width / 2, b.y + b.height / 2]).at(-1)"""
"""The middle of a joint that can be dragged in the forces."""


@pytest.mark.long
def test_a_drag_in_the_forces_that_is_taken_back_is_taken_back_there_too(tabs: Any, tmp_path: Path) -> None:
    """At once, before the forces of what was dragged are known, and after."""
    path = tmp_path / "m.yaml"
    path.write_text(problem_text("template", "slider_crank"), encoding="utf-8")
    with serving(path) as served:
        s = tabs(served)
        s.page.click("[role=tab][data-pane=Forces]")
        s.until("studio.solved()")
        text, effort = s.text, s.effort()
        for wait in (0, 0, 3000):
            s.until(f"!!({HANDLE})")
            x, y = s.page.evaluate(HANDLE)
            s.page.mouse.move(x, y)
            s.page.mouse.down()
            s.page.mouse.move(x + 20, y + 15, steps=3)
            s.page.mouse.up()
            s.page.wait_for_timeout(wait)
            s.page.evaluate("document.activeElement.blur()")
            s.page.keyboard.press("Control+z")
            s.until(f"studio.solved() && studio.state().text === {json.dumps(text)}")
            assert s.effort() == effort
            assert s.page.evaluate(
                "studio.page().kernel.values.every((v, k) => v === studio.page().data.numbers[k].value)"
            )


@pytest.mark.long
def test_keys_and_drags_at_random_leave_a_readable_file(tabs: Any, tmp_path: Path) -> None:
    r, path = Random(5), tmp_path / "m.yaml"
    path.write_text(FOUR_BAR, encoding="utf-8")
    with serving(path) as served:
        s = tabs(served)
        for k in range(120):
            places = [[200 + r.random() * 400, 100 + r.random() * 500] for _ in range(2)]
            if r.random() < 0.6:
                ends = s.page.evaluate(
                    "studio.state().drawing.links.flatMap(l => Object.values(l.points))",
                )
                places[0] = list(s.pixel(*r.choice(ends)))
            s.page.keyboard.press(
                r.choice("vvbbxpsogdfmknc") if k % 3 else r.choice(["Delete", "Escape", "Control+z", "0"])
            )
            s.page.mouse.move(*places[0])
            s.page.mouse.down()
            s.page.mouse.move(*places[1], steps=2)
            s.page.mouse.up()
            if r.random() < 0.3:
                s.page.keyboard.type("12")
                s.page.keyboard.press("Enter")
        s.answered()
        assert not s.page.evaluate("studio.state().error")
        da.loads(s.text)
        assert s.text != FOUR_BAR
