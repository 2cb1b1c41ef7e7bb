"""Work a frame of a live page in Chromium while a joint is dragged; how long making a page takes.

    python benchmarks/page.py [FILE ...]

Needs Chromium and playwright. By default every bundled example of the plane. Of each file several drags of 60 moves:
milliseconds of processor time of the script in the first frame after a move (median, p95), from the mouse's event
to the painted picture (p95), and the fastest of the pages made. On a busy machine the best drag counts.
"""

from __future__ import annotations

import json
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
from dalembert.model.library import scissor

DRAGS, MOVES = 3, 60

WATCH = """() => { window.late = []; const channel = new MessageChannel(), stamps = [];
channel.port1.onmessage = () => late.push(performance.now() - stamps.shift());
addEventListener('pointermove', e => { if (!e.buttons) return;
  requestAnimationFrame(() => { stamps.push(e.timeStamp); channel.port2.postMessage(0); }); }, true); }"""
"""A message that a frame sends arrives behind its painting."""


def mechanism(name: str) -> da.Mechanism:
    """A bundled file by its name, a file by its path; lifts by their stages."""
    if name.startswith("lift_"):
        return scissor(int(name.removeprefix("lift_")))
    return da.load(examples().get(name, Path(name)))


def dragged() -> list[str]:
    """Names of the examples of the plane that have a page."""
    loaded = {name: da.load(path) for name, path in examples().items()}
    return [
        name
        for name, m in loaded.items()
        if m.dimension == 2 and not any(d.unknown for d in m.drives.values())
    ]


def made(m: da.Mechanism) -> tuple[str, float]:
    """A page, and the fewest milliseconds that one took."""
    html, best = "", math.inf
    for _ in range(5):
        start = time.perf_counter()
        html = da.page(m)
        best = min(best, 1e3 * (time.perf_counter() - start))
    return html, best


def drag(page: Any) -> None:
    """A joint is dragged once around a small circle."""
    handles = page.locator(".handle.joint")
    box = handles.nth(min(1, handles.count() - 1)).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(1, MOVES + 1):
        a = 2 * math.pi * k / MOVES
        page.mouse.move(x + 9 * math.sin(a), y - 6 * (1 - math.cos(a)))
        page.wait_for_timeout(8)
    page.mouse.up()


def work(page: Any) -> tuple[float, float]:
    """Median and p95 of the processor time of the first frame after each move of the mouse, ms."""
    page.context.browser.start_tracing(page=page, categories=["devtools.timeline"])
    drag(page)
    found, moved = [], False
    events = json.loads(page.context.browser.stop_tracing())["traceEvents"]
    for event in sorted(events, key=lambda e: e.get("ts", 0)):
        if event["name"] == "EventDispatch" and event["args"]["data"]["type"] == "pointermove":
            moved = True
        elif event["name"] == "FireAnimationFrame" and moved:
            found.append(event["tdur"] / 1e3)
            moved = False
    return statistics.median(found), p95(found)


def until_painted(page: Any) -> float:
    """p95 from event to picture, ms."""
    page.evaluate(WATCH)
    drag(page)
    return p95(page.evaluate("late"))


def p95(some: list[float]) -> float:
    return sorted(some)[int(0.95 * (len(some) - 1))]


def main(names: list[str]) -> None:
    print("                      page    work a frame, ms    event to picture")
    print("                        ms    median       p95             p95, ms")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as p:
        browser = p.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        for name in names:
            html, taken = made(mechanism(name))
            file = Path(folder) / "page.html"
            file.write_text(html, encoding="utf-8")
            page = browser.new_page(viewport={"width": 1280, "height": 800})
            page.goto(file.as_uri())
            page.wait_for_timeout(500)
            median, most = map(min, zip(*(work(page) for _ in range(DRAGS)), strict=True))
            print(f"{Path(name).stem:20}{taken:6.0f}{median:10.2f}{most:10.2f}{until_painted(page):20.1f}")
            page.close()
        browser.close()


if __name__ == "__main__":
    main(sys.argv[1:] or dragged())
