"""The widget: what a notebook's kernel and its page say to each other, and that drags arrive in Python."""

from __future__ import annotations

import base64
import json
import os
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.pages.html_page import BUNDLE

HOST = """async ([code, data]) => {
const module = await import('data:text/javascript;base64,' + code);
const state = {data, changes: {}}, calls = {};
window.sent = [];
window.state = state;
window.calls = calls;
const model = {get: n => state[n], set: (n, v) => { state[n] = v; }, save_changes: () => sent.push({...state.changes}),
  on: (e, f) => { calls[e] = f; }, off: e => { delete calls[e]; }};
window.remove = await module.default.render({model, el: document.body});
}"""


FRAME = "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
"""Until the page has drawn what was done."""


def test_python_follows_what_was_dragged() -> None:
    w, seen = da.widget(da.four_bar()), list[Any]()
    assert {"data", "changes", "frame", "text"} <= w.get_state().keys()  # what the page is told
    w.observe(seen.append, "changes")
    before = w.result.effort("O2")
    w.changes = {"links.rocker.points.B.0": 0.2}
    assert len(seen) == 1
    assert w.mechanism.links["rocker"].points["B"][0] == 0.2
    assert (w.result.effort("O2") != before).all()
    w.mechanism = da.slider_crank()
    assert (w.changes, w.data["title"]) == ({}, w.mechanism.title or "A mechanism")


@pytest.mark.long
def test_a_page_in_a_notebook_sends_each_drag_once(browser: Any) -> None:
    w = da.widget(da.four_bar())
    page = browser.new_page()
    code = base64.b64encode((BUNDLE / "widget.js").read_bytes()).decode()
    page.evaluate(HOST, [code, json.loads(json.dumps(w.data))])
    box = page.locator('.handle[data-name="B"]').bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(1, 5):
        page.mouse.move(x + 5 * k, y)
    page.mouse.up()
    page.wait_for_function("() => sent.length")
    sent = page.evaluate("sent")
    assert len(sent) == 1
    w.changes = sent[0]
    assert w.mechanism.links["rocker"].points["B"][0] == sent[0]["links.rocker.points.B.0"]
    assert w.result.ok.any()
    other = json.loads(json.dumps(da.widget(da.slider_crank()).data)) | {"title": "Another"}
    page.evaluate("async d => { state.data = d; await calls['change:data'](); }", other)
    assert page.locator("h1").inner_text() == "Another"
    page.evaluate("remove()")
    assert page.locator(".dalembert").count() == 0
    page.close()


SKETCH = """
units: {length: mm}
links: {ground: {points: {A: [0, 0]}}, bar: {points: {A: [0, 0], B: [80, 0]}}}
joints: {A: {type: pin, links: [ground, bar]}}
"""


def test_an_unfinished_mechanism_is_a_sketch_in_a_notebook() -> None:
    w = da.widget(da.loads(SKETCH))
    assert w.data["missing"]["offers"][0]["said"] == "drive the turn of A"
    assert w.mechanism.assembly == {}
    w.text = w.data["missing"]["offers"][0]["text"]
    assert list(w.mechanism.drives) == ["A"]
    w.mechanism = da.four_bar()
    assert (w.text, list(w.mechanism.drives)) == ("", ["O2"])


@pytest.mark.long
def test_a_sketch_in_a_notebook_is_pulled_and_finished(browser: Any) -> None:
    w, page = da.widget(da.loads(SKETCH)), browser.new_page()
    code = base64.b64encode((BUNDLE / "widget.js").read_bytes()).decode()
    page.evaluate(HOST, [code, json.loads(json.dumps(w.data))])
    box = page.locator("svg .l-link, svg [data-item]").first.bounding_box()
    x, y = box["x"] + 0.8 * box["width"], box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(1, 9):
        page.mouse.move(x - 6 * k, y - 10 * k)
        page.evaluate(FRAME)
    page.mouse.up()
    page.wait_for_function("() => state.text")
    w.text = page.evaluate("state.text")
    turned = w.mechanism.assembly["bar"]
    assert 0.1 < turned < 3.1
    page.locator("button", has_text="drive the turn of A").click()
    page.wait_for_function("() => state.text.includes('drives')")
    w.text = page.evaluate("state.text")
    assert list(w.mechanism.drives) == ["A"]
    assert w.result.ok.all()
    page.close()


def test_a_mechanism_shows_itself_live_in_a_notebook(monkeypatch: pytest.MonkeyPatch) -> None:
    shown = list[Any]()
    monkeypatch.setattr("IPython.display.display", lambda data, raw: shown.append(data))
    monkeypatch.setattr("dalembert.pages.widget._in_notebook", lambda: True)
    da.four_bar()._ipython_display_()
    view, saved = shown
    assert "application/vnd.jupyter.widget-view+json" in view
    assert 'srcdoc="&lt;!doctype html&gt;' in saved["text/html"]
    with pytest.raises(NotImplementedError):
        da.load(examples()["balance_position"])._ipython_display_()
    monkeypatch.undo()
    with pytest.raises(NotImplementedError):
        da.four_bar()._ipython_display_()


@pytest.fixture
def jupyterlab(tmp_path: Path) -> Iterator[tuple[Path, Callable[[], str]]]:
    """A folder, and what starts JupyterLab on it anew and gives its address."""
    beside = shutil.which("jupyter-lab", path=str(Path(sys.executable).parent))
    program = os.environ.get("DALEMBERT_JUPYTERLAB") or beside
    if not program:
        pytest.skip(
            "there is no JupyterLab: pip install jupyterlab, or set DALEMBERT_JUPYTERLAB to a jupyter-lab"
        )
    folder, own = tmp_path / "notebooks", list[subprocess.Popen[bytes]]()
    folder.mkdir()
    kinds = ("CONFIG", "DATA", "RUNTIME")
    settings = os.environ | {f"JUPYTER_{kind}_DIR": str(tmp_path / kind) for kind in kinds}

    def stop() -> None:
        for process in own:
            process.terminate()
            process.wait(30)
        own.clear()

    def start() -> str:
        stop()
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        options = ["--no-browser", "--allow-root", "--IdentityProvider.token=", f"--port={port}"]
        command = [program, *options, f"--ServerApp.root_dir={folder}"]
        quiet = subprocess.DEVNULL
        own.append(subprocess.Popen(command, env=settings, stdout=quiet, stderr=quiet))
        for _ in range(300):
            with socket.socket() as s:
                if s.connect_ex(("127.0.0.1", port)) == 0:
                    return f"http://127.0.0.1:{port}/lab/tree"
            time.sleep(0.2)
        raise AssertionError("JupyterLab does not start")

    yield folder, start
    stop()


@pytest.mark.long
def test_in_jupyterlab(browser: Any, jupyterlab: tuple[Path, Callable[[], str]]) -> None:
    """What is dragged arrives in Python; the saved notebook, opened without Python, shows the page."""
    folder, start = jupyterlab
    text = "import dalembert as da\nw = da.widget(da.four_bar())\nw"
    point = "links['rocker'].points['B']"
    asked = f"print(w.mechanism.{point} != da.four_bar().{point}, w.result.ok.all())"
    cell: Any = {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None}
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    notebook = {
        "cells": [cell | {"source": source, "id": f"c{k}"} for k, source in enumerate((text, asked))],
        "metadata": {"kernelspec": kernel},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    (folder / "a.ipynb").write_text(json.dumps(notebook), encoding="utf-8")
    page = browser.new_page(viewport={"width": 1400, "height": 1300})
    page.goto(f"{start()}/a.ipynb")
    page.locator(".jp-Cell .jp-Editor").first.click(timeout=90_000)
    page.keyboard.press("Shift+Enter")
    handle = page.locator('.handle[data-name="B"]').first
    handle.wait_for(timeout=60_000)
    page.locator("[data-dalembert]").wait_for(state="hidden", timeout=60_000)
    handle.scroll_into_view_if_needed()
    box, before = handle.bounding_box(), None
    while box != before:  # it moves while the notebook is laid out
        page.wait_for_timeout(300)
        box, before = handle.bounding_box(), box
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(1, 5):
        page.mouse.move(x + 5 * k, y - 2 * k)
    page.mouse.up()
    page.locator(".jp-Cell .jp-Editor").nth(1).click()
    page.keyboard.press("Shift+Enter")
    page.get_by_text("True True").wait_for(timeout=30_000)
    page.keyboard.press("Control+s")
    for _ in range(600):
        if "True True" in (folder / "a.ipynb").read_text(encoding="utf-8"):
            break
        page.wait_for_timeout(100)
    page.close()
    page = browser.new_page(viewport={"width": 1400, "height": 1300})
    page.goto(f"{start()}/a.ipynb")
    page.frame_locator("[data-dalembert]").locator(".handle").first.wait_for(timeout=90_000)
    page.close()
