"""The page saves the assembly that it shows: dragged far, off change points, to where nothing closes and back."""

from __future__ import annotations

import math
import random
import re
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import NUMBERED
from dalembert.pages.saved_text import with_changed_numbers
from tests.browser.opened import FILES
from tests.browser.test_page import FOUR_BAR

CHANGE_POINT = "seed-002-4-four-link-two-couples"
PAGES = [
    FOUR_BAR,
    "quick_return",
    "scissor_lift",
    "toggle_press",
    "bucket",
    "gear_train",
    "rssr",
    CHANGE_POINT,
    "engine",
    "pump",
]
DRAGS = 6
"""Drags of one test; ten tests a page are sixty."""
OPEN = {(CHANGE_POINT, 6): "at positions that are dead centres whether it closes is a matter of rounding"}
"""Drags whose page and file have answers at different positions."""
HANDLES = """[...document.querySelectorAll('.stage .handle.joint, .stage .handle.point, .stage .handle.direction')]
.map(e => [e.dataset.kind, e.dataset.name])"""
CURVES = """(() => { const k = page.kernel, all = [...Array(k.count).keys()];
return {good: all.map(p => !!k.good[p]), marks: all.map(p => page.data.statuses[k.markAt(p)].status),
  noise: page.data.noise, curves: page.data.views.charts.flatMap(c => c.curves)
  .map(c => [c.of, all.map(p => k.good[p] ? k.value(c.row, p) : 0)])}; })()"""
FAR = """page.data.numbers.forEach((n, k) => { if (/points.J/.test(n.path)) page.kernel.values[k] += 30; })"""
"""The joint J by 30 m."""
FINITE = """[...page.kernel.values, ...page.kernel.motion.assembly()].every(Number.isFinite)
&& !document.querySelector('.dalembert').innerHTML.includes('NaN')"""


def answer_of(m: da.Mechanism, static: bool = False) -> da.Result:
    """What the page of a mechanism shows."""
    return da.dynamics(m) if m.has_speeds and not static else da.statics(m)


def same_as(page: Any, r: da.Result) -> float | None:
    """Every curve is that of an analysis of the file, at the same positions but for those that the page calls
    undecided: the largest difference over the largest value. None where the page has no answer at any position.
    """
    shown = page.run(CURVES)
    good = np.array(shown["good"])
    if not good.any():
        return None
    off = 0.0
    undecided = np.array([mark == "undecided" for mark in shown["marks"]])
    assert (good | undecided).tolist() == (np.isin(r.status, list(NUMBERED)) | undecided).tolist()
    for of, found in shown["curves"]:
        kind, name, *_ = of.split(".")
        exact = {
            "effort": lambda n=name: r.effort(n),
            "load": lambda n=name: r.unknown_load(n),
            "reaction": lambda n=name: np.linalg.norm(r.reaction(n), axis=-1),
        }[kind]()[good]
        largest = max(np.abs(exact).max(), 1e12 * shown["noise"]["force"], 1e12 * shown["noise"]["moment"])
        assert np.array(found)[good] == pytest.approx(exact, rel=1e-9, abs=1e-9 * largest)
        off = max(off, float(np.abs(np.array(found)[good] - exact).max()) / largest if largest else 0.0)
    return off


def agrees(page: Any) -> float | None:
    off = same_as(page, answer_of(da.loads(page.run("page.text()"))))
    assert page.run(FINITE)
    return off


@pytest.mark.parametrize(
    ("name", "which"),
    [
        (FOUR_BAR, -1),
        *(pytest.param(name, 0, marks=pytest.mark.long) for name in PAGES),
        *(
            pytest.param(name, k, marks=[pytest.mark.exhaustive, *known])
            for name in PAGES
            for k in range(1, 10)
            for known in [[pytest.mark.xfail(reason=OPEN[name, k])] if (name, k) in OPEN else []]
        ),
    ],
)
def test_far_drags_are_saved_as_they_are_shown(opened: Any, name: str, which: int) -> None:
    """Prints what it has seen: pytest -s -m "" -k far_drags tests/browser."""
    page, draw, seen = opened(name), random.Random(f"{name} {which}" if which else name), []
    handles = page.run(HANDLES)
    for _ in range(2 if which < 0 else DRAGS):
        page.page.get_by_text("Reset").click()
        page.run(f"page.show({draw.choice([0, draw.random()])} * page.kernel.end)")
        kind, joint = draw.choice(handles)
        far, way = draw.uniform(180, 300), draw.uniform(0, 2 * math.pi)
        page.drag(f'.stage .handle.{kind}[data-name="{joint}"]', far * math.cos(way), far * math.sin(way), 8)
        seen.append(agrees(page))
    known = [off for off in seen if off is not None]
    print(f"{name} {which}: {len(known)} of {len(seen)} close, {max(known, default=0.0):.1e} at most")


@pytest.mark.long
def test_a_range_behind_a_gap_in_space_more_than_half_a_turn_away(opened: Any) -> None:
    """Its drive is counted from the range that is known: 310 deg, not -50 deg."""
    m = da.load(FILES["rssr"]).with_values(
        {
            "links.ground.points.O": (0.082, 0.033, -0.025),
            "links.crank.points.O": (-0.006, -0.088, -0.025),
            "assembly": {
                "crank": {"position": (0.0024, -0.0061, 0), "axis": (0, 0, 1), "angle": 2.0944},
                "rod": {"position": (-0.0176, 0.0286, 0), "axis": (-0.19, 0.41, -0.89), "angle": 0.33},
                "rocker": {"position": (0, 0.15, 0), "axis": (-1, 0, 0), "angle": 0.44},
            },
        }
    )
    page = opened(html=da.page(m))
    assert same_as(page, answer_of(m)) is not None
    good = np.flatnonzero(page.run(CURVES)["good"])
    assert {12, 33} < set(good.tolist())
    assert not set(range(26, 31)) & set(good.tolist())


@pytest.mark.long
def test_a_range_behind_a_gap_that_is_reached_by_its_branch_alone(opened: Any) -> None:
    """Where no motion leads the angle of the block is unknown to the page until it has closed its lever."""
    m = da.load(FILES["quick_return"]).with_values(
        {
            "links.crank.points.A": (-0.183, -0.0536),
            "assembly": {"crank": 0.0, "block": 2.4669, "lever": 2.4669, "rod": 2.4064, "ram": 0.0},
        }
    )
    page = opened(html=da.page(m))
    assert same_as(page, answer_of(m)) is not None
    good = np.flatnonzero(page.run(CURVES)["good"])
    assert set(range(5)) | {14, 15} < set(good.tolist())
    assert not set(range(5, 14)) & set(good.tolist())


def test_off_a_change_point_the_motion_is_continuous(opened: Any) -> None:
    page = opened(CHANGE_POINT)
    page.drag('.handle[data-name="B"]', -8, 6)
    values, good = page.curve("effort.A")
    assert all(good)
    assert -4 < values[25] < -2  # 8.08 where it leaps
    assert np.abs(np.diff(values)).max() < 4.5
    agrees(page)


@pytest.mark.long
def test_dragged_to_where_nothing_closes_and_taken_hold_of_again(opened: Any) -> None:
    page = opened("bucket")
    before = page.run("[...page.kernel.motion.held.pose.turn]")
    for far in (300, -300):
        page.run(FAR)
        page.run("page.show(3)")
        page.drag('.stage .handle.joint[data-name="Q"]', far, 200)
        page.drag('.stage .handle.joint[data-name="Q"]', far, 200)
        assert page.run(FINITE)
    page.page.get_by_text("Reset").click()
    page.run("page.show(0)")
    assert page.run("[...page.kernel.motion.held.pose.turn]") == pytest.approx(before, abs=1e-9)
    agrees(page)


@pytest.mark.long
def test_where_nothing_closes_it_says_how_far_it_misses(opened: Any) -> None:
    page = opened(FOUR_BAR)
    page.drag('.handle[data-name="A"]', 250, 100)
    _, good = page.curve("effort.O2")
    page.run(f"page.show({good.index(False)})")
    assert re.fullmatch(r"B is open by [\d.]+ in", page.page.locator(".gaps text").text_content())
    page.drag('.stage .handle[data-name="B"]', 30, -30)
    assert page.run("page.kernel.solved")
    assert page.page.locator(".gaps text").count() == 0
    agrees(page)


@pytest.mark.long
def test_a_planet_goes_round_its_sun(opened: Any) -> None:
    page = opened("gear_train")
    before = page.value("links.carrier.points.P.0")
    page.drag('.handle[data-name="P"]', -40, -90)
    at = page.value("links.carrier.points.P.0"), page.value("links.carrier.points.P.1")
    assert at[1] != 0
    assert math.hypot(*at) == pytest.approx(before, rel=1e-12)
    agrees(page)


@pytest.mark.long
def test_undo_the_address_and_a_widget_keep_the_assembly(opened: Any) -> None:
    page = opened(FOUR_BAR)
    page.drag('.handle[data-name="A"]', 250, 100)
    page.drag('.handle[data-name="B"]', -200, 150)
    second = page.run("page.text()")
    page.page.keyboard.press("Control+z")
    page.frame()
    agrees(page)
    page.page.keyboard.press("Control+y")
    page.frame()
    assert page.run("page.text()") == second
    said = page.run("Object.fromEntries(new URLSearchParams(location.hash.slice(1)))")
    changes = {path: float(x) for path, x in said.items() if path != "t"}
    assert "assembly.rocker" in changes
    page.page.reload()
    page.until("window.page !== undefined")
    page.requests[1:] = []
    agrees(page)
    same_as(page, answer_of(with_changed_numbers(da.loads(second), changes)))


def test_the_saved_file_is_its_authors_own(opened: Any) -> None:
    page = opened(FOUR_BAR)
    own = FILES[FOUR_BAR].read_text(encoding="utf-8").splitlines()
    page.drag('.handle[data-name="B"]', 25, -18)
    saved = page.run("page.text()").splitlines()
    other = [b for a, b in zip(own, saved, strict=True) if a != b]
    assert [line.split(":")[0].strip() for line in other] == ["points", "rocker", "O2", "assembly"]
    assert "weight: 5.8, center: 5 @ 0" in other[1]
