"""One gate for every number, typed, dragged or from an address: what the model refuses the page refuses."""

from __future__ import annotations

import re
from typing import Any

import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.model.library import template_text
from tests.browser.opened import FILES
from tests.browser.test_page import FOUR_BAR, tab
from tests.pages.test_page_data import PARAMETRIC

pytestmark = pytest.mark.long

WEIGHT, LENGTH, INERTIA = "links.crank.weight", "links.crank.center.0", "links.crank.inertia"
TYPED = [
    (WEIGHT, "-1 lbf"),
    (WEIGHT, "-1"),
    (WEIGHT, "1,5"),
    (WEIGHT, "1,500"),
    (WEIGHT, "1/3"),
    (WEIGHT, "1 1/2 lbf"),
    (WEIGHT, "abc"),
    (WEIGHT, "2 lb"),
    (WEIGHT, "2 mm"),
    (WEIGHT, "2 N*m"),
    (WEIGHT, "1e999"),
    (WEIGHT, "2 qqq"),
    (WEIGHT, "2 N^9"),
    (WEIGHT, "2 N*"),
    (WEIGHT, "2 (N"),
    (WEIGHT, "2 lbf"),
    (WEIGHT, "2 kip"),
    (WEIGHT, "1.5e1 kg*m/s^2"),
    (WEIGHT, "8 kg·m/s²"),
    (WEIGHT, "0"),
    (LENGTH, "-1.5 ft"),
    (LENGTH, "\u22122 cm"),
    (LENGTH, "30 deg"),
    (INERTIA, "0.02 kg*m^2"),
    (INERTIA, "0.02 lbf-in*s^2"),
    (INERTIA, "-0.02 kg*m^2"),
    ("loads.F_P.direction", "1 rad"),
    ("loads.F_P.direction", "0.25 rev"),
    ("drives.O2.speed", "200 rpm"),
    ("drives.O2.speed", "3 Hz"),
    ("drives.O2.acceleration", "-40 rad/s^2"),
]


def python_reads(path: str, text: str) -> float | str:
    """What `with_values` makes of a text: the SI value, or the message without the place that it begins with."""
    m = da.load(FILES[FOUR_BAR])
    group, name, key, *rest = path.split(".")
    try:
        changed: Any = getattr(m.with_values({path: text}), group)[name]
    except ModelError as error:
        return re.sub(r"^[\w.]+: (item \d+ of )?\w+: ", "", str(error))
    value = getattr(changed, key)
    return float(value[int(rest[0])] if rest else value)


def test_a_typed_text_means_what_it_means_in_a_file_or_is_refused_in_the_same_words(opened: Any) -> None:
    page = opened(FOUR_BAR)
    tab(page, "Change")
    wrong = []
    for path, text in TYPED:
        box = page.page.locator(f'input[data-path="{path}"]')
        before = page.value(path)
        box.fill(text)
        box.press("Enter")
        page.frame()
        said = page.run(
            f"document.querySelector('label:has(input[data-path=\"{path}\"]) .wrong').textContent"
        )
        right = python_reads(path, text)
        if isinstance(right, str) and re.fullmatch(r"[-\d.e]+", text):
            right = right.replace(repr(text), text)  # a bare number: a file has no quotes about it
        same = page.value(path) == before and said == right if isinstance(right, str) else said == ""
        if not same or (isinstance(right, float) and page.value(path) != pytest.approx(right, rel=1e-15)):
            wrong.append((path, text, page.value(path), said, right))
        page.page.keyboard.press("Escape")
    assert wrong == []


@pytest.mark.parametrize("path", [WEIGHT, LENGTH])
def test_no_text_is_half_read(opened: Any, path: str) -> None:
    """A refused number stays as it was, and its file is read again; a bare one is in the unit that stands beside it."""
    page = opened(FOUR_BAR)
    tab(page, "Change")
    box, before = page.page.locator(f'input[data-path="{path}"]'), page.value(path)
    for text in ("1,5", "1/3", "13 13", "1 lbf/in/in/in", "--1", "0x1p3", "Infinity", "NaN"):
        box.fill(text)
        box.press("Enter")
        assert page.value(path) == before
        assert box.get_attribute("aria-invalid") is not None
    box.fill("0.75")
    box.press("Enter")
    page.frame()
    assert box.get_attribute("aria-invalid") is None
    assert page.value(path) == pytest.approx(0.75 * (4.4482216152605 if path == WEIGHT else 0.0254))
    assert da.dynamics(da.loads(page.run("page.text()"))).ok.all()


def test_a_parameter_stays_within_its_range_typed_and_dragged(opened: Any) -> None:
    page = opened(html=da.page(da.loads(PARAMETRIC)))
    tab(page, "Change")
    box = page.page.locator('input[data-path="r"]')
    for text in ("200", "19 mm", "0"):
        box.fill(text)
        box.press("Enter")
        assert page.value("r") == 0.045
        assert (
            "outside its range; write one from 20 mm to 60 mm"
            in page.page.locator("label .wrong").first.inner_text()
        )
    box.press("Escape")
    page.drag('.handle[data-name="A"]', 400, 0)
    assert page.value("r") == 0.06
    page.drag('.handle[data-name="A"]', -5, 300)
    assert 0.02 <= page.value("r") <= 0.06


def test_what_follows_from_a_parameter_is_bounded_too(opened: Any) -> None:
    m = da.loads(PARAMETRIC.replace("mass: m1}", "mass: m1 - 1.5 kg}"))
    page = opened(html=da.page(m))
    tab(page, "Change")
    box = page.page.locator('input[data-path="m1"]')
    with pytest.raises(ModelError) as refused:
        m.with_values({"m1": 1.25})
    box.fill("1.25 kg")
    box.press("Enter")
    page.frame()
    assert page.value("m1") == 2.0
    assert page.page.locator("label:has([data-path=m1]) .wrong").inner_text() == str(refused.value)
    box.fill("1.5 kg")
    box.press("Enter")
    page.frame()
    assert page.value("m1") == 1.5
    page.run("page.set({m1: 1})")
    assert (page.value("m1"), "is negative" in page.page.locator(".mark").inner_text()) == (2.0, True)


@pytest.mark.parametrize(("template", "name"), [("plate_clutch", "faces"), ("ratchet", "teeth")])
def test_what_is_counted_stays_an_integer(opened: Any, template: str, name: str) -> None:
    m = da.loads(template_text(template))
    page = opened(html=da.page(m))
    tab(page, "Change")
    box = page.page.locator(f'input[data-path="{name}"]')
    before = page.value(name)
    with pytest.raises(ModelError) as refused:
        m.with_values({name: before + 0.5})
    for text, value, said in ((f"{before + 0.5}", before, str(refused.value)), ("4", 4.0, "")):
        box.fill(text)
        box.press("Enter")
        page.frame()
        assert page.value(name) == value
        assert page.page.locator(f"label:has([data-path={name}]) .wrong").inner_text() == said


def test_an_address_or_python_cannot_bring_what_the_gate_refuses(opened: Any) -> None:
    page = opened(FOUR_BAR)
    before = page.value(WEIGHT)
    page.run(f"page.set({{'{WEIGHT}': -3, 'links.crank.inertia': Infinity, '{LENGTH}': 0.05}})")
    assert (page.value(WEIGHT), page.value(LENGTH)) == (before, 0.05)
    assert "is negative; write a positive one, or 0" in page.page.locator(".mark").inner_text()
    page.run(f"location.hash = '#t=3&{WEIGHT}=-1&{LENGTH}=0.04'")
    page.page.reload()
    page.until("window.page !== undefined")
    assert (page.value(WEIGHT), page.value(LENGTH)) == (before, 0.04)
    page.requests[1:] = []
