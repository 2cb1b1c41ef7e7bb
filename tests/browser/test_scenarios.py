"""What a person does in the studio with mouse, fingers and keys, one scenario a row, all in one tab of one studio."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

import dalembert as da
from dalembert.cli import main
from dalembert.studio.document import EMPTY
from dalembert.studio.problems import problem_text
from tests.browser.sketch_scenarios import SKETCHES, every_problem_is_ticked
from tests.browser.studio_tab import Studio
from tests.studio.served import serving
from tests.tiers import tiers

FOUR_BAR = problem_text("example", "four_bar")


@pytest.fixture(scope="module")
def board(browser: Any, tmp_path_factory: Any) -> Iterator[Studio]:
    """One studio in one tab for all scenarios."""
    path: Path = tmp_path_factory.mktemp("board") / "m.yaml"
    with serving(path) as served:
        context = browser.new_context(viewport={"width": 1280, "height": 800}, has_touch=True)
        studio = Studio(context, served.access.address)
        yield studio
        context.close()
        assert studio.complaints == []


def keys(s: Studio, said: str) -> None:
    """Keys one after the other; what is no name of a key is typed."""
    for key in said.split():
        named = key in ("Enter", "Tab", "Escape", "Delete", "PageDown", "PageUp", "Space") or "+" in key
        (s.page.keyboard.press if named else s.page.keyboard.type)(key)
        s.answered()


def bars(s: Studio) -> None:
    """A crank and a coupler from a ground point, and a second ground point."""
    s.see(0.05, 0.02, 3000)
    for typed in ("0 Tab 0", "100 Tab 0"):
        s.changes(lambda typed=typed: keys(s, f"Escape x {typed} Enter"))  # type: ignore[misc]
    s.line("b", (0, 0), (0.02, 0.03), "40", "60")
    s.line("b", s.point("link2"), (0.08, 0.05), "60", "0")


def by_keys_alone(s: Studio) -> None:
    """A slider-crank without a mouse: its torque is that of the template."""
    s.see(0.1, 0.0, 2000)
    s.changes(lambda: keys(s, "x 0 Tab 0 Enter"))
    s.page.evaluate("studio.canvas.svg.focus()")
    while s.page.evaluate("studio.hand.cursor.end?.link") != "ground":
        keys(s, "PageDown")
    s.changes(lambda: keys(s, "b Enter 50 Tab 45 Enter"))
    aim(s, "link2", s.second("link2"))
    s.changes(lambda: keys(s, "b Enter 200 Tab -10.182 Enter"))
    aim(s, "link3", s.second("link3"))
    s.changes(lambda: keys(s, "s Enter 0 Enter"))
    s.place("ground", s.page.evaluate("Object.keys(studio.state().drawing.links[0].points).at(-1)"), "[0, 0]")
    aim(s, "ground", "A")
    s.changes(lambda: keys(s, "d 45 Enter"))
    aim(s, "link3", s.second("link3"))
    s.changes(lambda: keys(s, "f Enter 1000 Tab 180 Enter"))
    m = da.slider_crank(crank="50 mm", rod="200 mm", positions=1)
    force = {"type": "force", "on": "piston", "at": "B", "value": [-1000.0, 0.0]}
    like = da.Mechanism.model_validate(m.to_tree() | {"loads": {"F": force}, "gravity": "none"})
    like = like.with_values({"drives.O2.position": "45 deg", "drives.O2.speed": 0.0})
    assert s.effort() == pytest.approx(float(da.statics(like).effort("O2")[0]), rel=1e-9)


def aim(s: Studio, link: str, point: str) -> None:
    """Page Down until the cross is on a point."""
    for _ in range(40):
        keys(s, "PageDown")
        if s.page.evaluate("[studio.hand.cursor.end?.link, studio.hand.cursor.end?.point]") == [link, point]:
            return
    raise AssertionError((link, point))


def by_touch_alone(s: Studio) -> None:
    """A four-bar with taps: it closes, and a tap drives it."""
    s.see(0.05, 0.02, 3000)

    def tap(tool: str, *places: tuple[float, float]) -> None:
        s.page.tap(f"[data-tool={tool}]")
        s.until(f"studio.hand.tool.name === '{tool}'")
        s.changes(lambda: [s.page.touchscreen.tap(*s.pixel(*at)) for at in places])

    tap("ground", (0, 0))
    tap("ground", (0.1, 0))
    tap("bar", (0, 0), (0.02, 0.035))
    tap("bar", s.point("link2"), (0.12, 0.06))
    tap("bar", s.point("link3"), (0.1, 0))
    tap("drive", (0, 0))
    assert s.drawing()["freedoms"] == 1
    assert s.drawing()["closed"]
    assert s.effort() == 0.0


def a_hundred_steps(s: Studio) -> None:
    """A hundred steps undone give the first text, and done again the last, byte for byte."""
    first = s.text
    for k in range(100):
        s.changes(lambda k=k: s.gesture({"op": "ground", "where": {"at": [0.01 * k, 0.02]}}))  # type: ignore[misc]
    last = s.text
    s.page.evaluate("document.activeElement?.blur()")
    for key in ("Control+z", "Control+Shift+Z"):
        for _ in range(100):
            s.changes(lambda key=key: s.page.keyboard.press(key))  # type: ignore[misc]
        assert s.text == (first if key == "Control+z" else last)


def a_name_everywhere(s: Studio) -> None:
    """A new name of the crank changes all that refers to it, and no force."""
    s.open("example", "four_bar")
    before = s.effort()
    s.choose("links", "crank")
    s.type("name", "arm")
    assert "crank" not in da.loads(s.text).links
    assert s.text.splitlines()[0:3] == FOUR_BAR.splitlines()[0:3]
    assert s.effort() == before


def deleted_with_all_on_it(s: Studio) -> None:
    """Del takes a link out with its joints, loads and its place in the assembly."""
    s.open("example", "four_bar")
    s.choose("links", "rocker")
    s.page.evaluate("document.activeElement?.blur()")
    s.changes(lambda: s.page.keyboard.press("Delete"))
    m = da.loads(s.text)
    assert (list(m.joints), list(m.loads), list(m.assembly)) == (["O2", "A"], ["F_P"], ["coupler"])


def merged_by_dropping(s: Studio) -> None:
    """A joint dropped on a ground point is pinned there."""
    bars(s)
    end = s.point("link3")
    s.line("v", end, (0.1, 0.0))
    assert any(x["links"] == ["ground", "link3"] for x in s.drawing()["joints"])


def pin_to_weld(s: Studio) -> None:
    """A click of the weld tool on a pin makes it rigid, at the angle that is drawn."""
    bars(s)
    s.click("w", *s.point("link2"))
    (weld,) = (j for j in da.loads(s.text).joints.values() if j.type == "weld")
    assert weld.angle == pytest.approx(-1.0471975511965976, abs=1e-5)
    assert s.drawing()["freedoms"] == 1


def refused_in_fields(s: Studio) -> None:
    """`1,5` is 1.5, a unit is taken along, a negative mass and an overflow are refused at the field."""
    bars(s)
    s.choose("links", "link2")
    s.type("mass", "1,5")
    assert da.loads(s.text).mass("link2") == 1.5
    s.type("mass", "2 lbm")
    before = s.text
    for wrong in ("-1", "1e999", "3 mm"):
        box = s.page.locator(".pane.part input[aria-label=mass]")
        box.fill(wrong)
        box.press("Enter")
        s.answered()
        assert s.page.locator(".pane.part .refused:not(:empty)").count() == 1
        assert s.text == before
        box.fill("2 lbm")
        box.press("Escape")


def another_assembly_by_picture(s: Studio) -> None:
    """The other assembly, chosen by its picture, is that of the file; its effort is computed anew."""
    s.open("template", "four_bar")
    before = s.effort()
    s.page.click("[role=tab][data-pane=Answers]")
    s.page.click("button:text-is('Other assemblies')")
    s.page.wait_for_selector(".modes img")
    assert s.page.locator(".modes button").count() == 2
    s.until("[...document.querySelectorAll('.modes img')].every(x => x.naturalWidth > 0)")
    s.changes(lambda: s.page.click(".modes button:not([disabled])"))
    assert s.effort() == pytest.approx(float(da.dynamics(da.loads(s.text)).effort("O2")[0]), rel=1e-9)
    assert s.effort() != pytest.approx(before)


def shares_of_loads(s: Studio) -> None:
    """What each load adds to the effort is in a table, and adds up."""
    s.open("example", "four_bar")
    s.page.click("[role=tab][data-pane=Answers]")
    s.page.click("button:text-is('Share of each load')")
    s.page.wait_for_selector(".answer td")
    row = s.page.inner_text(".answer tr >> nth=1").split("\t")
    assert row[0] == "effort of O2"
    assert sum(map(float, row[1:-2])) == pytest.approx(float(row[-2]), abs=2e-2)
    assert float(row[-2]) == pytest.approx(243.24, abs=0.01)


def reports_downloaded(s: Studio) -> None:
    """Worked solution, design report and page are downloads: those of the command line."""
    s.open("template", "four_bar")
    asked = (
        ("Report", "m_report.html", ["report"]),
        ("Design", "m_design.html", ["report", "--design"]),
        ("Page", "m.html", ["page"]),
    )
    with TemporaryDirectory() as folder:
        file = Path(folder) / "m.yaml"
        file.write_text(s.text, encoding="utf-8")
        for button, name, command in asked:
            with s.page.expect_download() as waiting:
                s.page.click(f"header button:text-is('{button}')")
            assert waiting.value.suggested_filename == name
            there = Path(folder) / name
            assert main([*command, str(file), "-o", str(there)]) == 0
            own = Path(waiting.value.path()).read_text(encoding="utf-8")
            assert "Four-bar linkage" in own
            assert own == there.read_text(encoding="utf-8")


def joints_of_each_kind(s: Studio) -> None:
    """Each joint drawn once between two links, from point to point."""
    for key, kind in (("a", "circular_slot"), ("r", "rolling"), ("e", "belt"), ("g", "gear")):
        s.empty()
        bars(s)
        s.line(key, s.point("link3"), (0.1, 0.0))
        assert [j.type for j in da.loads(s.text).joints.values()][-1] == kind


def loads_of_each_kind(s: Studio) -> None:
    """Each load drawn once, and a cylinder."""
    bars(s)
    s.line("k", s.point("link3"), (0.1, 0.0), "2 N/mm")
    s.line("n", s.point("link3"), (0.1, 0.0), "40 N*s/m")
    s.line("f", s.point("link3"), (0.12, 0.0), "100 N", "-90")
    s.choose("links", "link2")
    s.changes(lambda: keys(s, "m 3 Enter"))
    s.line("c", s.point("link3"), (0.1, 0.0), "63 mm")
    m = da.loads(s.text)
    assert sorted(x.type for x in m.loads.values()) == ["couple", "damper", "force", "spring"]
    assert m.drives["cylinder1"].cylinder is not None


def a_cam_with_typed_values(s: Studio) -> None:
    """A cam from its axis to the roller of its follower; what is typed of it under Part is in the file."""
    bars(s)
    s.line("b", (0.1, 0), (0.06, 0.04), "50", "135")
    ends = s.drawing()["links"]
    follower = ends[-1]["name"]
    aim(s, "link2", next(iter(ends[1]["points"])))
    keys(s, "j Enter")
    aim(s, follower, s.second(follower))
    s.changes(lambda: keys(s, "Enter"))
    cam = s.drawing()["joints"][-1]["name"]
    s.choose("joints", cam)
    s.type("follower", "{roller: 4 mm}")
    s.type(
        "profile",
        "{base: 60, segments: [{to: 6 deg, in: 120, by: cycloidal}, {to: 0, in: 120, by: cycloidal}, {dwell: rest}]}",
    )
    s.page.locator(".pane.part select:has(option[value=contact])").select_option("contact")
    s.type("contact", "holds")
    joint: Any = da.loads(s.text).joints[cam]
    assert (joint.type, joint.links[1], joint.follower.roller, joint.contact.mode) == (
        "cam",
        follower,
        0.004,
        "holds",
    )
    assert joint.profile.base == 0.06


def a_cam_swings_a_slotted_lever_against_a_spring(s: Studio) -> None:
    """Cam, roller, slot and spring, all drawn; the torque is that of the file."""
    s.see(0.05, 0.05, 3000)
    for typed in ("0 Tab 0", "100 Tab 0", "0 Tab 100"):
        s.changes(lambda typed=typed: keys(s, f"Escape x {typed} Enter"))  # type: ignore[misc]
    s.line("b", (0, 0), (0.02, 0.03), "40", "60")
    s.line("b", (0.1, 0), (0.06, 0.04), "50", "135")
    s.line("b", (0, 0.1), (0.08, 0.02), "120", "-45")
    end = s.point("link3")
    s.line("o", end, (end[0] + 0.007, end[1] - 0.007))
    aim(s, "link2", "A")
    keys(s, "j Enter")
    aim(s, "link3", s.second("link3"))
    s.changes(lambda: keys(s, "Enter"))
    s.choose("joints", s.drawing()["joints"][-1]["name"])
    s.type("follower", "{roller: 4 mm}")
    s.type(
        "profile",
        "{base: 60, segments: [{to: 6 deg, in: 120, by: cycloidal}, {to: 0, in: 120, by: cycloidal}, {dwell: rest}]}",
    )
    s.line("k", s.point("link4"), (0.1, 0.0), "2 N/mm")
    s.choose("loads", s.drawing()["loads"][-1]["name"])
    s.type("free_length", "50 mm")
    s.click("d", 0, 0)
    m = da.loads(s.text)
    kinds = sorted(j.type for j in m.joints.values())
    assert kinds == ["cam", "pin", "pin", "pin", "slot"]
    assert [x.type for x in m.loads.values()] == ["spring"]
    r = da.statics(m)
    assert r.ok.all()
    (drive,) = m.drives
    assert s.effort() == pytest.approx(float(r.effort(drive)[0]), rel=1e-9)
    assert abs(s.effort()) > 1e-4


def crlf_is_kept(s: Studio) -> None:
    """A file with CRLF keeps it through gestures."""
    text = FOUR_BAR.replace("\n", "\r\n")
    s.changes(
        lambda: s.send({"edit": [[0, len(s.text), text]], "base": s.page.evaluate("studio.state().hash")})
    )
    s.choose("links", "crank")
    s.type("weight", "1.6")
    assert s.text.replace("\r\n", "").count("\n") == 0
    assert "1.6" in s.text


QUICK: list[Callable[[Studio], None]] = [by_keys_alone]
LONG: list[Callable[[Studio], None]] = [
    *(
        by_touch_alone,
        a_name_everywhere,
        deleted_with_all_on_it,
        merged_by_dropping,
        pin_to_weld,
        refused_in_fields,
    ),
    *(
        another_assembly_by_picture,
        shares_of_loads,
        reports_downloaded,
        joints_of_each_kind,
        loads_of_each_kind,
    ),
    *(a_cam_with_typed_values, a_cam_swings_a_slotted_lever_against_a_spring, crlf_is_kept, a_hundred_steps),
    *SKETCHES,
]


@pytest.mark.parametrize("scenario", tiers(QUICK, LONG, [every_problem_is_ticked]), ids=lambda f: f.__name__)
def test_scenario(scenario: Callable[[Studio], None], board: Studio) -> None:
    board.empty()
    assert board.text == EMPTY
    scenario(board)
    assert not board.page.evaluate("studio.state().error")
