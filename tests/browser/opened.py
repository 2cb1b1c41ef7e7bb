"""Pages opened in a real Chromium: one browser for all tests, one page for each."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.bundled import cases, examples

FILES = {**cases(), **examples()}
NAMES = ("chromium", "chromium-browser", "google-chrome")
WANTED = "DALEMBERT_BROWSER"
MISSING = f"there is no Chromium: apt-get install chromium, or set {WANTED} to one; make test-browser does"


def browser_path() -> str:
    """The browser to use; where none is found the test is skipped, but fails where one was asked for."""
    asked = os.environ.get(WANTED)
    found = asked or next(filter(None, map(shutil.which, NAMES)), None)
    if found and Path(found).exists():
        return found
    if asked:
        pytest.fail(f"{WANTED}={asked}, and no browser is there")
    pytest.skip(MISSING)


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    path = browser_path()
    sync_api = pytest.importorskip("playwright.sync_api", reason="pip install playwright")
    with sync_api.sync_playwright() as p:
        started = p.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield started
        started.close()


@cache
def html_of(name: str) -> str:
    return da.page(da.load(FILES[name]))


class Opened:
    """A page with what it asked for and complained about."""

    def __init__(self, page: Any, html: str, folder: Path) -> None:
        self.page, self.requests, self.complaints = page, list[str](), list[str]()
        file = folder / "page.html"
        file.write_text(html, encoding="utf-8")
        page.on("request", lambda r: self.requests.append(r.url))
        page.on("console", lambda m: self.complaints.append(m.text))
        page.on("pageerror", lambda e: self.complaints.append(str(e)))
        page.goto(file.as_uri())
        self.until("window.page !== undefined")
        self.frame()  # its size is known

    def until(self, holds: str) -> None:
        """Wait for something; the page's policy forbids what Playwright would wait by."""
        for _ in range(1500):
            if self.page.evaluate(holds):
                return
            self.page.wait_for_timeout(20)
        raise AssertionError(f"never: {holds}")

    def frame(self) -> None:
        """Wait until the page has drawn what was done."""
        self.page.evaluate(
            "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
        )

    def run(self, script: str) -> Any:
        found = self.page.evaluate(script)
        self.frame()
        return found

    def place(self, selector: str) -> tuple[float, float]:
        box = self.page.locator(selector).first.bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drag(self, selector: str, dx: float, dy: float, steps: int = 4) -> None:
        """Take hold of the middle of an element and move it."""
        self.page.locator(selector).first.scroll_into_view_if_needed()
        x, y = self.place(selector)
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        for k in range(1, steps + 1):
            self.page.mouse.move(x + dx * k / steps, y + dy * k / steps)
        self.page.mouse.up()
        self.frame()

    def value(self, path: str) -> float:
        return float(
            self.page.evaluate(
                "p => page.kernel.values[page.data.numbers.findIndex(n => n.path === p)]", path
            )
        )

    def curve(self, of: str) -> tuple[list[float], list[bool]]:
        """Values of a curve over the cycle, and where they are answers."""
        return tuple(
            self.page.evaluate(
                """of => { const k = page.kernel;
                const c = page.data.views.charts.flatMap(x => x.curves).find(x => x.of === of);
                const all = [...Array(k.count).keys()];
                return [all.map(p => k.value(c.row, p)), all.map(p => !!k.good[p])]; }""",
                of,
            )
        )


@pytest.fixture
def opened(browser: Any, tmp_path: Path) -> Iterator[Callable[..., Opened]]:
    """Opens the page of a bundled file, or other HTML; at the end nothing was asked for, nothing complained about."""
    context, made = [], []

    def one(name: str = "", html: str = "", **options: Any) -> Opened:
        context.append(browser.new_context(viewport={"width": 1280, "height": 800}, **options))
        made.append(Opened(context[-1].new_page(), html or html_of(name), tmp_path))
        return made[-1]

    yield one
    for page in made:
        assert [url for url in page.requests if not url.startswith("file:")] == []
        assert len(page.requests) == 1
        assert page.complaints == []
    for each in context:
        each.close()
