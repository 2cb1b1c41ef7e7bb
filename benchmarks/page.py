"""Work a frame of a live page in Chromium, all panels open, while a joint is dragged; how long making a page takes.

    python benchmarks/page.py [FILE ...]

Needs Chromium and playwright. Of each file several drags of 60 moves: milliseconds of script a frame (median, p95),
from the mouse's event to the painted picture (p95), and the fastest of the pages made. On a busy machine the best
drag counts.
"""

from __future__ import annotations

import math
import shutil
import statistics
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from playwright.sync_api import sync_playwright

import dalembert as da
from dalembert.bundled import examples
from dalembert.model.drives.drives import Range
from dalembert.model.library import scissor

FILES = ("four_bar", "engine", "quick_return", "lift_4", "lift_8")
DRAGS, MOVES = 6, 60

WATCH = """() => { window.late = []; const channel = new MessageChannel(), stamps = [];
channel.port1.onmessage = () => late.push(performance.now() - stamps.shift());
addEventListener('pointermove', e => { if (!e.buttons) return;
  requestAnimationFrame(() => { stamps.push(e.timeStamp); channel.port2.postMessage(0); }); }, true); }"""
"""A message that a frame sends arrives behind its painting."""


def mechanism(name: str) -> da.Mechanism:
    """A bundled file by its name, a file by its path; the four-bar with 360 positions, lifts by their stages."""
    if name.startswith("lift_"):
        return scissor(int(name.removeprefix("lift_")))
    m = da.load(examples().get(name, Path(name)))
    if name == "four_bar":
        return m.with_values({"drives.O2.position": Range(0.0, 2 * math.pi, 360)})
    return m


def made(m: da.Mechanism) -> tuple[str, float]:
    """A page, and the fewest milliseconds that one took."""
    html, best = "", math.inf
    for _ in range(5):
        start = time.perf_counter()
        html = da.page(m)
        best = min(best, 1e3 * (time.perf_counter() - start))
    return html, best


def drags(page: Any) -> list[tuple[float, float, float]]:
    """Of each drag the median and p95 of the work a frame, and p95 from event to picture, ms."""
    page.evaluate("document.querySelectorAll('details').forEach(d => d.open = true)")
    page.evaluate(WATCH)
    out = []
    for _ in range(DRAGS):
        box = page.locator(".handle.joint").nth(1).bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        page.evaluate("page.times.length = late.length = 0")
        for k in range(1, MOVES + 1):
            a = 2 * math.pi * k / MOVES
            page.mouse.move(x + 9 * math.sin(a), y - 6 * (1 - math.cos(a)))
            page.wait_for_timeout(8)
        page.mouse.up()
        times, late = sorted(page.evaluate("page.times")), sorted(page.evaluate("late"))
        p95 = [some[int(0.95 * (len(some) - 1))] for some in (times, late)]
        out.append((statistics.median(times), *p95))
    return out


def main(names: list[str]) -> None:
    print("                 page    work a frame, ms    event to picture")
    print("                   ms    median       p95             p95, ms")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as p:
        browser = p.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        for name in names:
            html, taken = made(mechanism(name))
            file = Path(folder) / "page.html"
            file.write_text(html, encoding="utf-8")
            page = browser.new_page(viewport={"width": 1280, "height": 800})
            page.goto(file.as_uri())
            page.wait_for_timeout(500)
            median, p95, late = map(min, zip(*drags(page), strict=True))
            print(f"{Path(name).stem:15}{taken:6.0f}{median:10.2f}{p95:10.2f}{late:20.1f}")
            page.close()
        browser.close()


if __name__ == "__main__":
    main(sys.argv[1:] or list(FILES))
