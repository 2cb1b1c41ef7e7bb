"""Every page of the built site opened in Chromium from its file: no script error, no request, no picture missing.

python docs/site/check_pages.py [--chromium PATH]
"""

from __future__ import annotations

import argparse
import shutil
import sys
from pathlib import Path
from typing import Any

from playwright.sync_api import sync_playwright

SITE = Path(__file__).resolve().parents[2] / "build" / "site"
THEME = "Got invalid theme mode"
"""What the theme itself says at the first load."""
BROKEN = "[...document.images].filter(i => i.loading !== 'lazy' && !(i.complete && i.naturalWidth)).map(i => i.src)"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--chromium", default=shutil.which("chromium"))
    found: list[str] = []
    pages = sorted(p for p in SITE.rglob("*.html") if p.name != "webpack-macros.html")  # a part of the theme
    with sync_playwright() as p:
        browser = p.chromium.launch(executable_path=parser.parse_args().chromium)
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
        browser.close()
    print("\n".join(found))
    print(f"{len(pages)} pages opened, {len(found)} findings")
    return 1 if found or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
