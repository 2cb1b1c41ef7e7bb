"""Records the README's first picture: the four-bar's live page, its joint B dragged round, as docs/figures/page.webp.

Needs Chromium, playwright and Pillow: python docs/record_page.py
"""

from __future__ import annotations

import io
import math
import shutil
import tempfile
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

import dalembert as da
from dalembert.bundled import examples

OUT = Path(__file__).parent / "figures" / "page.webp"


def main() -> None:
    frames = list[Image.Image]()
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as p:
        file = Path(folder) / "four_bar.html"
        da.page(da.load(examples()["four_bar"]), file)
        browser = p.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1180, "height": 660})
        page.goto(file.as_uri())

        def shot(script: str = "0") -> None:
            page.evaluate(script)
            page.wait_for_timeout(60)
            frames.append(Image.open(io.BytesIO(page.screenshot())).convert("RGB").resize((944, 528)))

        page.wait_for_timeout(1000)
        for t in range(0, 24, 2):
            shot(f"page.show({t})")
        box = page.locator('.handle[data-name="B"]').bounding_box()
        assert box is not None
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        for k in range(1, 25):
            a = k / 24 * 2 * math.pi
            page.mouse.move(x + 46 * math.sin(a), y - 30 * (1 - math.cos(a)))
            shot()
        page.mouse.up()
        for t in range(24, 72, 3):
            shot(f"page.show({t})")
        browser.close()
    frames[0].save(OUT, save_all=True, append_images=frames[1:], duration=90, loop=0, quality=45, method=4)


if __name__ == "__main__":
    main()
