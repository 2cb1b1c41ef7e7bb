"""What lies far out of sight, is drawn without a complaint of the browser."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from dalembert.studio.problems import problem_text
from tests.browser.studio_tab import tabs
from tests.studio.served import serving

__all__ = ["tabs"]

GEARS = """
units: {{length: m}}
links: {{ground: {{points: {{A: [0, 0], B: [{far}, {far}]}}}}, one: {{points: {{A: [0, 0], P: [{far}, 1]}}}}}}
joints: {{A: {{type: pin, links: [ground, one]}}}}
"""


@pytest.mark.long
def test_places_far_out_of_sight_are_drawn_without_a_complaint(tabs: Any, tmp_path: Path) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(problem_text("example", "four_bar"), encoding="utf-8")
    with serving(path) as served:
        s = tabs(served)
        a = s.point("crank", "A")
        s.page.keyboard.press("b")  # a typed length of any size is previewed
        s.page.mouse.click(*s.pixel(*a))
        s.page.mouse.move(600, 300)
        s.page.keyboard.type("9" * 60)
        assert s.page.locator(".preview path").get_attribute("d").count("e") == 0
        s.page.keyboard.press("Escape")
        for far in (1e7, 1e39, 1e150, 1e308):
            s.page.evaluate("studio.pick(null)")
            text = GEARS.format(far=far)
            s.send({"edit": [[0, len(s.text), text]], "base": s.page.evaluate("studio.state().hash")})
            s.until(f"studio.state().text.includes('{far}')")
            for key in ("0", "+", "-"):
                s.page.keyboard.press(key)
            s.see(0.0, 0.0, 1e7)
            s.page.mouse.move(620, 320)
            s.see(far, far, 1e7)
            s.page.mouse.move(600, 300)
        script = "d => { const w = studio.canvas.window; w.middle = [0, 0]; w.scale = 1e3; return w.px(d); }"
        near = s.page.evaluate(script, [0.01, 0.02])
        assert near[0] - s.page.evaluate(script, [0.0, 0.0])[0] == pytest.approx(10)
        for x in ("1e308", "-Infinity", "NaN"):
            out = s.page.evaluate(f"studio.canvas.window.px([{x}, 0])")
            assert abs(out[0]) <= 1e6
