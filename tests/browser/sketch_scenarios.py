"""Scenarios with a mechanism that is drawn already: its links are pulled, its text is edited, offers are pressed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.model.files.rewriting import text_of
from dalembert.studio.problems import problem_text, problems
from tests.browser.studio_tab import Studio

Place = tuple[float, float]
WHEEL = """units: {length: mm}
links: {ground: {points: {T: [0, 0]}}, wheel: {points: {C: [0, 0], P: [0, 25]}}}
joints: {R: {type: rolling, links: [ground, wheel], at: [T, C], radius: 30}}
assembly: {wheel: [0, 30, 0]}
"""
FREE = """units: {length: mm}  # of the drawing
links:
  ground: {points: {A: [0, 0], D: [100, 0]}}
  crank: &made {points: {A: [0, 0], B: [40, 0]}, mass: 1 kg}  # a remark
  coupler: {points: {B: [0, 0], C: [110, 0]}}
  rocker: {<<: *made, points: {C: [0, 0], D: [80, 0]}}
joints:
  A: {type: pin, links: [ground, crank]}
  B: {type: pin, links: [crank, coupler]}
  C: {type: pin, links: [coupler, rocker]}
  D: {type: pin, links: [ground, rocker]}
assembly: {crank: 60, coupler: 20, rocker: -80}
"""
"""A four-bar with one freedom and no drive."""
COPIES = "copies: [{of: [coupler, rocker], phase: {crank: [0, 90]}}]\n"
ANSWERS = """
answers:
  - {quantity: effort, of: O2, value: 243.23 lbf*in, tolerance: 0.02}
  - {quantity: effort, of: O2, value: 999 lbf*in}
"""


def give(s: Studio, text: str) -> None:
    """Another text, and the whole of it in view."""
    s.changes(
        lambda: s.send({"edit": [[0, len(s.text), text]], "base": s.page.evaluate("studio.state().hash")})
    )
    s.page.evaluate("studio.pick(null); document.activeElement?.blur()")
    s.page.keyboard.press("Escape")
    s.page.keyboard.press("0")


def along(s: Studio, link: str, part: float) -> Place:
    """A place between the first two points of a link."""
    a, b = list(s.drawing()["links"][names(s).index(link)]["points"].values())[:2]
    return a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])


def names(s: Studio) -> list[str]:
    return [link["name"] for link in s.drawing()["links"]]


def pull(s: Studio, start: Place, *path: Place) -> None:
    """Take hold of a link at a place, and lead it along a path."""
    s.page.mouse.move(*s.pixel(*start))
    s.page.mouse.down()
    for at in path:
        s.page.mouse.move(*s.pixel(*at), steps=4)
        followed(s)
    s.changes(s.page.mouse.up)


def followed(s: Studio) -> None:
    """Wait until the link has followed the hand."""
    s.answered()


def miss(s: Studio, link: str, part: float, to: Place) -> float:
    """Pixels from a place of a link to another place."""
    return math.dist(s.pixel(*along(s, link, part)), s.pixel(*to))


def a_first_four_bar(s: Studio) -> None:
    """By what is to be seen alone: buttons and the mouse. What the preview says of a bar is in the file."""
    s.see(0.05, 0.02, 3000)
    page = s.page

    def drag(a: Place, b: Place) -> None:
        page.mouse.move(*s.pixel(*a))
        page.mouse.down()
        page.mouse.move(*s.pixel(*b), steps=5)

    page.click("[data-tool=ground]")
    page.mouse.move(*s.pixel(0.1, 0.0))
    assert page.locator(".preview text").text_content() == "100, 0 mm"
    for at in ((0.0, 0.0), (0.1, 0.0)):
        s.changes(lambda at=at: page.mouse.click(*s.pixel(*at)))  # type: ignore[misc]
    page.click("[data-tool=bar]")
    drag((0.0, 0.0), (0.0203, 0.0342))
    assert page.locator(".preview text").text_content() == "length 40 mm   angle 60°"
    s.changes(page.mouse.up)
    for end in ((0.12, 0.07), (0.1, 0.0)):
        drag(s.point(names(s)[-1]), end)
        s.changes(page.mouse.up)
    s.settled()
    s.changes(lambda: page.click(".verdict button:text-is('Drive A')"))
    for link, long in (("link3", "120"), ("link4", "80")):
        page.mouse.click(*s.pixel(*along(s, link, 0.4)))
        box = page.get_by_label("length", exact=True)
        box.fill(long)
        s.changes(lambda box=box: box.press("Enter"))  # type: ignore[misc]
    page.click("[data-tool=force]")
    drag(s.point("link4", "D"), (s.point("link4", "D")[0], s.point("link4", "D")[1] - 0.04))
    s.changes(page.mouse.up)
    m = da.loads(s.text)
    assert m.links["link2"].points["C"] == (0.04, 0.0)
    assert m.drives["A"].position == pytest.approx(math.radians(60), abs=2e-5)
    torque = float(da.statics(m).effort("A")[0])
    assert s.effort() == pytest.approx(torque, rel=1e-9)
    said = page.inner_text(".verdict").replace("−", "-")
    assert said.startswith(f"Effort of A (torque): {float(f'{torque:.5g}')!r} N·m as drawn.")
    s.changes(lambda: page.click(".verdict button:text-is('Whole turn')"))
    assert len(da.statics(da.loads(s.text)).effort("A")) > 30
    s.effort()


def a_pinned_bar_is_pulled_round(s: Studio) -> None:
    """It keeps its length and its pin, and points to the hand."""
    s.see(0.0, 0.0, 3000)
    s.click("x", 0, 0)
    s.line("b", (0, 0), (0.02, 0.03), "40", "60")
    s.page.keyboard.press("Escape")
    pull(s, along(s, "link2", 0.6), (-0.02, 0.02), (-0.03, -0.01), (0.0, -0.05))
    end = s.point("link2")
    assert end == pytest.approx((0, -0.04), abs=1e-3)
    assert math.hypot(*end) == pytest.approx(0.04, abs=1e-6)


def a_free_bar_follows_and_turns(s: Studio) -> None:
    """Pulled sideways near its end, that end follows the hand and the other lags behind."""
    s.see(0.0, 0.0, 3000)
    s.line("b", (-0.03, 0), (0.03, 0))
    s.page.keyboard.press("Escape")
    pull(s, along(s, "link2", 0.8), (0.018, 0.03))
    (ax, ay), (bx, by) = s.point("link2", "A"), s.point("link2")
    assert miss(s, "link2", 0.8, (0.018, 0.03)) < 3
    assert math.dist((ax, ay), (bx, by)) == pytest.approx(0.06, rel=1e-6)
    assert by > ay + 0.01


def far_beyond_reach_and_back(s: Studio) -> None:
    """The coupler is led out of the window and back in one go: the same assembly at the same place; let go outside, it
    stays closed."""
    give(s, FREE)
    before, hold = s.point("rocker", "C"), along(s, "coupler", 0.5)
    pull(s, hold, (0.4, 0.3), (-0.3, 0.2), (0.02, 0.2), (hold[0] + 0.004, hold[1] + 0.004), hold)
    assert math.dist(s.pixel(*s.point("rocker", "C")), s.pixel(*before)) < 3
    s.page.mouse.move(*s.pixel(*along(s, "coupler", 0.5)))
    s.page.mouse.down()
    s.page.mouse.move(-60, 300, steps=5)
    followed(s)
    s.changes(s.page.mouse.up)
    assert s.drawing()["closed"]
    assert s.point("rocker", "C") == pytest.approx(s.point("coupler", "C"), abs=1e-7)
    assert s.page.evaluate("studio.hand.shadow === null || studio.hand.shadow === undefined")


def both_cranks_of_a_five_bar_by_turns(s: Studio) -> None:
    """Each follows the hand while the linkage stays closed."""
    m = da.five_bar()
    first = {
        f"drives.{d}.position": float(x) for d, x in zip(m.drives, m.schedule().position[0], strict=True)
    }
    give(s, text_of(m.with_values(first), "yaml"))
    assert s.drawing()["freedoms"] == 2
    driven = {link for d in m.drives for link in m.joints[m.drive_joint(d)].links} - {"ground"}
    for link in sorted(driven):
        base, hold = along(s, link, 0.0), along(s, link, 0.7)
        c, z = math.cos(0.2), math.sin(0.2)
        x, y = hold[0] - base[0], hold[1] - base[1]
        to = base[0] + c * x - z * y, base[1] + z * x + c * y
        pull(s, hold, to)
        assert miss(s, link, 0.7, to) < 3
        assert s.drawing()["closed"]


def a_truss_does_not_move(s: Studio) -> None:
    """A pulled member stays, and the part list says that nothing is free."""
    s.open("example", "truss")
    s.choose("", "")
    assert "0 degrees of freedom" in s.page.inner_text(".pane.part")
    s.page.keyboard.press("0")
    link, before = names(s)[1], s.drawing()["links"]
    at = along(s, link, 0.5)
    s.page.mouse.move(*s.pixel(*at))
    s.page.mouse.down()
    s.page.mouse.move(*s.pixel(at[0] + 0.5, at[1] + 0.5), steps=3)
    followed(s)
    s.page.mouse.up()
    s.answered()
    assert s.text == problem_text("example", "truss")
    for old, new in zip(before, s.drawing()["links"], strict=True):
        assert np.allclose(list(old["points"].values()), list(new["points"].values()), atol=1e-9)


def a_scissor_lift_is_pulled_flat_and_up_again(s: Studio) -> None:
    """Five stages without a drive stay together on the way, and come back to the same place."""
    m = da.scissor(5)
    bare = m.model_copy(update={"drives": {}, "loads": {}})
    give(s, text_of(bare, "yaml"))
    top = names(s)[-1]
    before, high = s.drawing()["links"][-1]["points"], s.drawing()["links"][-1]["pose"][1]
    hold = along(s, top, 0.5)
    pull(s, hold, (hold[0], hold[1] - 0.4 * high), (hold[0], hold[1] - 0.8 * high))
    assert s.drawing()["closed"]
    assert s.drawing()["links"][-1]["pose"][1] == pytest.approx(0.2 * high, abs=0.02 * high)
    low = along(s, top, 0.5)
    pull(s, low, (low[0], low[1] + 0.4 * high), (low[0], low[1] + 0.8 * high))
    assert s.drawing()["closed"]
    for name, place in s.drawing()["links"][-1]["points"].items():
        assert place == pytest.approx(before[name], abs=0.02 * high)


def drives_of_one_position_go_along_and_others_keep_the_first(s: Studio) -> None:
    """A crank that is driven at one position, with a unit or not, is driven where it was pulled; of several, not."""
    for position in ("60 deg", "60"):
        give(s, FREE.replace("assembly", f"drives: {{A: {{position: {position}}}}}\nassembly"))
        pull(s, along(s, "crank", 0.6), (0.0, 0.045))
        (drive,) = da.loads(s.text).drives.values()
        assert drive.position == pytest.approx(math.pi / 2, abs=0.02)
        assert ("deg}" in s.text) == ("deg" in position)
        x, y = s.point("crank", "B")
        assert math.atan2(y, x) == pytest.approx(float(drive.position), abs=1e-4)
    text = FREE.replace("assembly", "drives: {A: {position: {from: 60, to: 420, count: 13}}}\nassembly")
    give(s, text)
    before = s.point("crank", "B")
    s.page.mouse.move(*s.pixel(*along(s, "crank", 0.6)))
    s.page.mouse.down()
    s.page.mouse.move(*s.pixel(0.0, 0.045), steps=4)
    followed(s)
    s.page.mouse.up()
    s.until("!studio.hand.shadow")
    s.answered()
    assert s.text == text
    assert s.point("crank", "B") == before
    assert "first position of drive A" in s.page.inner_text(".hint")


def a_wheel_rolls(s: Studio) -> None:
    """Its turn times its radius is the way of its centre."""
    give(s, WHEEL)
    pull(s, along(s, "wheel", 0.5), (0.03, 0.045), (0.06, 0.04))
    wheel = next(x for x in s.drawing()["links"] if x["name"] == "wheel")
    x, y, turn = wheel["pose"]
    assert x > 0.02
    assert (y, turn) == pytest.approx((0.03, -x / 0.03), abs=1e-4)


def a_link_too_short_leaves_a_gap(s: Studio) -> None:
    """Its length is on the drawing; with the old length the linkage closes again."""
    give(s, FREE)
    s.choose("links", "coupler")
    s.type("length", "300")
    s.until("document.querySelector('.gap + text, text.gap')")
    assert " open by " in s.page.locator("text.gap").first.text_content()
    assert s.page.locator("text.gap").first.text_content().endswith(" mm")
    s.type("length", "110")
    s.until("!document.querySelector('text.gap')")
    assert s.drawing()["closed"]


def a_pin_becomes_a_slider(s: Studio) -> None:
    """The pin is deleted, and the sliding link drawn in its place: the link no longer turns."""
    give(s, FREE)
    for name in ("D", "C"):
        s.choose("joints", name)
        s.changes(lambda: s.page.click(".pane.part button.delete"))
    s.page.keyboard.press("l")
    at = s.point("rocker", "D")
    s.page.mouse.click(*s.pixel(*at))
    s.page.keyboard.type("0")
    s.changes(lambda: s.page.keyboard.press("Enter"))
    (slider,) = (j for j in da.loads(s.text).joints.values() if j.type == "slider")
    assert slider.links == ("ground", "rocker")


def a_number_typed_in_the_text_moves_the_drawing(s: Studio) -> None:
    """The length of a link in the file; comments, anchors and aligned lines stay through this and a gesture."""
    give(s, FREE)
    at = FREE.index("[110, 0]") + 1
    s.changes(lambda: s.send({"edit": [[at, at + 3, "120"]], "base": s.page.evaluate("studio.state().hash")}))
    assert math.dist(s.point("coupler", "B"), s.point("coupler", "C")) == pytest.approx(0.12, abs=1e-9)
    s.choose("links", "coupler")
    s.type("length", "115")
    now, first = s.text.splitlines(), FREE.splitlines()
    changed = [line for line in now if line not in first]
    assert len(now) == len(first)
    assert all("coupler" in line or "assembly" in line for line in changed)


def copies_are_refused_with_a_word(s: Studio) -> None:
    """A file with copies is shown and edited as text; a gesture says so."""
    text = FREE + COPIES
    give(s, text)
    s.gesture({"op": "ground", "where": {"at": [0.1, 0.1]}})
    s.page.wait_for_selector(".banners .refusal")
    assert "copies is edited as text" in s.page.inner_text(".banners"), s.page.inner_text(".banners")
    assert s.text == text


def an_offer_is_pressed(s: Studio) -> None:
    """Pulled, then driven by the offer in the sentence: the torque is that of the pose that was let go."""
    give(s, FREE.replace("assembly", "gravity: standard\nassembly"))
    pull(s, along(s, "crank", 0.6), (0.0, 0.045))
    before = s.point("coupler", "C")
    s.page.wait_for_selector(".verdict button")
    s.changes(lambda: s.page.click(".verdict button:text-is('Drive A')"))
    assert s.point("coupler", "C") == pytest.approx(before, abs=1e-6)
    m = da.loads(s.text)
    assert s.effort() == pytest.approx(float(da.statics(m).effort("A")[0]), rel=1e-9)


def switches(s: Studio) -> None:
    """Without inertia the effort is that of statics, without friction that of an analysis with friction off."""
    s.open("example", "four_bar")
    m = da.loads(s.text)
    for box, r in (
        ("dynamics", da.dynamics(m)),
        ("dynamics", da.statics(m)),
        ("dynamics", da.dynamics(m)),
    ):
        assert s.effort() == pytest.approx(float(r.effort("O2")[0]), rel=1e-9), (box, r)
        s.page.get_by_label(box, exact=True).click()
    s.page.get_by_label("dynamics", exact=True).set_checked(True)
    s.changes(lambda: s.open("problem", "seed-002-7a-engine-friction-circles"))
    m = da.loads(s.text)
    (drive,) = m.drives
    for friction in (True, False, True):
        r = da.solve(m.with_values({"friction.enabled": friction}))
        assert s.effort() == pytest.approx(float(r.effort(drive)[0]), rel=1e-9)
        if friction:
            s.page.get_by_label("friction", exact=True).click()
        else:
            s.page.get_by_label("friction", exact=True).set_checked(True)
    s.page.get_by_label("friction", exact=True).set_checked(True)


def answers_of_the_file_are_checked(s: Studio) -> None:
    """A right and a wrong one, written in the text."""
    give(s, problem_text("example", "four_bar") + ANSWERS)
    ticks = ticked(s)
    assert [x[0] for x in ticks] == ["✓", "✗"]
    assert all("243.2" in x for x in ticks)


def ticked(s: Studio) -> list[str]:
    """The answers that are checked, of the text as it is."""
    return [
        f"{'✓' if row['ok'] else '✗'} {row['computed']} {row['why']}"
        for row in s.page.evaluate("studio.socket.send({ask: 'check'}).then(a => a.rows ?? [])")
    ]


def every_problem_is_ticked(s: Studio) -> None:
    """Each printed answer of each bundled problem."""
    count = 0
    for p in problems():
        text = problem_text(p["kind"], p["name"])
        if "\nanswers:" not in text:
            continue
        s.page.click("[role=tab][data-pane=Problems]")
        s.changes(lambda p=p: s.send({"open": {"kind": p["kind"], "name": p["name"]}}))  # type: ignore[misc]
        rows: list[Any] = ticked(s)
        assert rows, p
        assert all(row[0] == "✓" for row in rows), (p, rows)
        count += len(rows)
    assert count > 500


SKETCHES = [
    a_first_four_bar,
    *(a_pinned_bar_is_pulled_round, a_free_bar_follows_and_turns, far_beyond_reach_and_back),
    *(
        both_cranks_of_a_five_bar_by_turns,
        a_truss_does_not_move,
        a_wheel_rolls,
        a_scissor_lift_is_pulled_flat_and_up_again,
        drives_of_one_position_go_along_and_others_keep_the_first,
        a_link_too_short_leaves_a_gap,
    ),
    *(a_pin_becomes_a_slider, a_number_typed_in_the_text_moves_the_drawing, copies_are_refused_with_a_word),
    *(an_offer_is_pressed, switches, answers_of_the_file_are_checked),
]
