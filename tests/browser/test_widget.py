"""The widget: what a notebook's kernel and its page say to each other, and that drags arrive in Python."""

from __future__ import annotations

import base64
import json
from typing import Any

import pytest

import dalembert as da
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


def test_python_follows_what_was_dragged() -> None:
    w, seen = da.widget(da.four_bar()), list[Any]()
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
