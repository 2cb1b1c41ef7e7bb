"""A page opens, is dragged and follows; the rest of what a person does with it is in test_page.py, which is long."""

from __future__ import annotations

from typing import Any

from tests.browser.test_page import FOUR_BAR, agrees


def test_a_page_opens_and_follows_a_drag(opened: Any) -> None:
    page = opened(FOUR_BAR)
    assert page.page.locator(".stage svg path").count() > 5
    page.drag('.handle[data-name="B"]', 25, -18)
    agrees(page)
