"""Every page of the built site opened in Chromium from its file: no script error, no request, no picture missing.

One page of each kind is read by axe-core too, in two sizes, light and dark, if `npm ci` has been run in web/: no
serious finding; and is drawn to build/site-pictures, to be looked at.

    python docs/site/check_pages.py [--chromium PATH] [--kinds]
"""

from __future__ import annotations

import argparse
import shutil
import sys
from pathlib import Path
from typing import Any

from playwright.sync_api import sync_playwright

SITE = Path(__file__).resolve().parents[2] / "build" / "site"
AXE = Path(__file__).resolve().parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"
PICTURES = SITE.parent / "site-pictures"
KINDS = [
    "index",
    "learn",
    "getting-started",
    "theory",
    "model-keys",
    "commands",
    "api",
    "quantities",
    "validation",
    "licences",
    "search",
    "gallery/index",
    "gallery/example-four_bar",
    "gallery/example-rssr",
    "tutorials/student",
    "tutorials/designer",
    "_static/problems/example-four_bar-solution",
    "_static/problems/example-four_bar-live",
]
"""A page of each kind."""
SIZES = {"wide": {"width": 1280, "height": 900}, "narrow": {"width": 390, "height": 844}}
SERIOUS = """async (report) => (await axe.run(document, {
  iframes: false,
  rules: {'scrollable-region-focusable': {enabled: !report}},  // a stop at each equation would be worse
})).violations
  .filter(v => ['serious', 'critical'].includes(v.impact))
  .map(v => `${v.id} (${v.nodes.length}): ${v.nodes[0].target.join(' ')}: ${v.nodes[0].failureSummary}`)"""
THEME = "Got invalid theme mode"
"""What the theme itself says at the first load."""
BROKEN = "[...document.images].filter(i => i.loading !== 'lazy' && !(i.complete && i.naturalWidth)).map(i => i.src)"


def read_by_axe(browser: Any) -> list[str]:
    """Serious findings of one page of each kind; its pictures are written beside."""
    found = []
    PICTURES.mkdir(exist_ok=True)
    script = AXE.read_text(encoding="utf-8")
    for scheme in ("light", "dark"):
        for size, viewport in SIZES.items():
            page = browser.new_context(offline=True, viewport=viewport, color_scheme=scheme).new_page()
            for kind in KINDS:
                page.goto((SITE / f"{kind}.html").as_uri())
                page.wait_for_load_state("load")
                page.screenshot(path=PICTURES / f"{kind.replace('/', '-')}-{size}-{scheme}.png")
                page.evaluate(script)
                found += [
                    f"{kind}, {size}, {scheme}: {each}" for each in page.evaluate(SERIOUS, "solution" in kind)
                ]
            page.context.close()
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--chromium", default=shutil.which("chromium"))
    parser.add_argument("--kinds", action="store_true", help="only one page of each kind, by axe-core")
    options = parser.parse_args()
    if options.kinds:
        with sync_playwright() as p:
            found = read_by_axe(p.chromium.launch(executable_path=options.chromium))
        print("\n".join(found), f"{len(KINDS)} kinds of pages, {len(found)} findings", sep="\n")
        return 1 if found else 0
    return open_all(options.chromium)


def open_all(chromium: str) -> int:
    """Open every page, and read one of each kind."""
    found: list[str] = []
    pages = sorted(p for p in SITE.rglob("*.html") if p.name != "webpack-macros.html")  # a part of the theme
    with sync_playwright() as p:
        browser = p.chromium.launch(executable_path=chromium)
        page = browser.new_context(offline=True).new_page()
        where = ""

        def note(what: str) -> None:
            found.append(f"{where}: {what}")

        def console(message: Any) -> None:
            if message.type == "error" and THEME not in message.text:
                note(message.text)

        def request(sent: Any) -> None:
            if not sent.url.startswith(("file:", "data:", "blob:")):
                note(f"asks for {sent.url}")

        page.on("console", console)
        page.on("pageerror", lambda error: note(str(error)) if where else None)
        page.on("request", request)
        for path in pages:
            where = str(path.relative_to(SITE))
            page.goto(path.as_uri())
            found += [f"{where}: no picture {src}" for src in page.evaluate(BROKEN)]
        where = ""
        page.remove_listener("console", console)  # from a file a search shows no excerpts, and says so
        page.goto((SITE / "search.html").as_uri() + "?q=friction")
        page.wait_for_selector("ul.search li a", timeout=10_000)
        if AXE.is_file():
            found += read_by_axe(browser)
        browser.close()
    print("\n".join(found))
    print(f"{len(pages)} pages opened, {len(found)} findings")
    return 1 if found or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
