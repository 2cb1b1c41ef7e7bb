"""Drawings on pages of paper: nothing lost, nothing outside, in order; what one page holds, and what else there is."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.cli import main
from dalembert.views.paper.pages import MARGIN, PAPERS, _panels, break_pages, room
from dalembert.views.paper.scene import Group, Line, Scene, Text
from tests.tiers import tiers

AT_REST = "seed-002-7d-engine-at-rest"


def words(scene: Scene) -> list[str]:
    return sorted(t.text for t in scene.texts())


@pytest.mark.parametrize("paper", PAPERS)
@pytest.mark.parametrize("name", tiers(["four_bar"], [AT_REST, *(n for n in examples() if n != "four_bar")]))
def test_pages_hold_all_of_a_drawing(name: str, paper: str) -> None:
    whole = da.draw.view(da.solve(da.load((examples() | cases())[name])), "all")
    pages = break_pages(whole, paper)
    assert sorted(w for page in pages for w in words(Scene(page.items))) == words(whole)
    for page in pages:
        left, bottom, right, top = Scene(page.items).bounds
        assert min(left, bottom) >= MARGIN - 1e-6
        assert right <= page.width - MARGIN + 1e-6
        assert top <= page.height - MARGIN + 1e-6
        assert sorted((page.width, page.height)) == sorted(PAPERS[paper])


def test_a_panel_larger_than_a_page_has_one_to_its_size() -> None:
    wide = Scene((Text((0.0, 0.0), "W" * 120, 3.0, anchor="start"),))
    (page,) = break_pages(wide)
    assert page.width > PAPERS["a4"][1]
    along = Scene((Text((0.0, 0.0), "W" * 70, 3.0, anchor="start"),))
    assert [(p.width, p.height) for p in break_pages(along)] == [PAPERS["a4"][::-1]]


def panel(width: float, height: float, x: float = 0.0, top: float = 0.0) -> Group:
    return Group((Line(((x, top - height), (x + width, top))),), f"{width:g} x {height:g}")


A4, ACROSS = PAPERS["a4"], PAPERS["a4"][::-1]


@pytest.mark.parametrize(
    ("panels", "pages"),
    [
        (  # the second row begins below the highest of the first, whatever would fit beside it
            [panel(50, 60), panel(40, 30, 90), panel(20, 10, 0, -70)],
            [(A4, [(12, 225, 62, 285), (70, 255, 110, 285), (12, 207, 32, 217)])],
        ),
        ([panel(89, 9), panel(89, 9, 99)], [(A4, [(12, 276, 101, 285), (109, 276, 198, 285)])]),
        ([panel(89, 9), panel(89.5, 9, 99)], [(A4, [(12, 276, 101, 285), (12, 259, 101.5, 268)])]),
        ([panel(100, 173), panel(100, 92, 0, -200)], [(A4, [(12, 112, 112, 285), (12, 12, 112, 104)])]),
        (
            [panel(100, 173), panel(100, 92.5, 0, -200)],
            [(A4, [(12, 112, 112, 285)]), (A4, [(12, 192.5, 112, 285)])],
        ),
        ([panel(186, 9), panel(9, 9, 0, -9)], [(A4, [(12, 276, 198, 285), (12, 259, 21, 268)])]),
        ([panel(186.5, 9), panel(9, 9, 0, -9)], [(ACROSS, [(12, 189, 198.5, 198), (12, 172, 21, 181)])]),
        ([panel(273, 186), panel(9, 9, 0, -9)], [(ACROSS, [(12, 12, 285, 198)]), (A4, [(12, 276, 21, 285)])]),
        ([panel(186.5, 186.5)], [((210.5, 210.5), [(12, 12, 198.5, 198.5)])]),
        ([panel(9, 273.5)], [((33, 297.5), [(12, 12, 21, 285.5)])]),
        ([panel(9, 9), Line(((0, 0), (99, 0)))], [(A4, [(12, 276, 111, 285)])]),
    ],
)
def test_where_panels_stand_on_pages(
    panels: list[Group | Line],
    pages: list[tuple[tuple[float, float], list[tuple[float, float, float, float]]]],
) -> None:
    found = [
        ((page.width, page.height), [pytest.approx(Scene((item,)).bounds) for item in page.items])
        for page in break_pages(Scene(tuple(panels)))
    ]
    assert found == pages


def stack(width: float, height: float, top: float) -> Group:
    """Two panels below each other."""
    low = height / 2 + 5
    return Group(
        (panel(width, height / 2 - 5, 0, top), panel(width, height - low, 0, top - low)),
        f"both {width:g} x {height:g}",
    )


HEAD = Group((Text((0.0, -210.0), "Heading"),), "heading")


@pytest.mark.parametrize(
    ("panels", "pages"),
    [
        ([panel(99, 200), HEAD, panel(99, 60, 0, -220)], [["99 x 200"], ["heading", "99 x 60"]]),
        ([panel(99, 200), HEAD, panel(99, 40, 0, -220)], [["99 x 200", "heading", "99 x 40"]]),
        ([panel(99, 200), HEAD], [["99 x 200", "heading"]]),
        ([panel(9, 9, 0, 30), stack(150, 250, 0)], [["9 x 9", "both 150 x 250"]]),
        ([panel(9, 9, 0, 30), stack(150, 290, 0)], [["9 x 9", "150 x 140"], ["150 x 140"]]),
        ([panel(9, 9, 0, 30), stack(250, 110, 0)], [["9 x 9", "both 250 x 110"]]),
        ([panel(9, 9, 0, 30), stack(250, 210, 0)], [["9 x 9", "250 x 100"], ["250 x 100"]]),
        ([panel(9, 9, 0, 30), stack(300, 90, 0)], [["9 x 9"], ["300 x 40"], ["300 x 40"]]),
    ],
)
def test_headings_stand_above_their_panels_and_stacks_that_are_too_large_are_unpacked(
    panels: list[Group], pages: list[list[str]]
) -> None:
    found = break_pages(Scene(tuple(panels)))
    assert [[getattr(item, "name", "") for item in page.items] for page in found] == pages


@pytest.mark.long
def test_a_pdf_has_pages(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, out = str(examples()["four_bar"]), tmp_path / "a.pdf"

    def sizes(*options: str) -> list[tuple[float, ...]]:
        assert main(["draw", file, "-o", str(out), "--force", *options]) == 0
        boxes = re.findall(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", out.read_bytes())
        return [tuple(round(float(x) * 25.4 / 72, 1) for x in box) for box in boxes]

    assert sizes() == [(210.0, 297.0)]
    assert "There is also --view free-bodies, motion; --view all draws more pages." in capsys.readouterr().err
    assert sizes("--view", "free-bodies", "--paper", "letter") == [(215.9, 279.4)]
    assert main(["draw", file, "-o", str(tmp_path / "a.svg"), "--paper", "a4"]) == 2
    assert "a.svg has no pages of a4; a .pdf has: a4 or letter" in capsys.readouterr().err


def test_friction_alone() -> None:
    r = da.solve(da.load(cases()["seed-002-7a-engine-friction-circles"]))
    said = " ".join(words(da.draw.friction(r)))
    assert all(title in said for title in ("Pin O: friction circle", "Joint guide: angle of friction"))
    with pytest.raises(da.ModelError, match="this mechanism has no friction to draw"):
        da.draw.friction(da.solve(da.load(examples()["four_bar"])))


@pytest.mark.parametrize(
    ("size", "whole"),
    [
        *(((186.0, 253.0), True), ((186.1, 253.0), False), ((186.0, 253.1), False)),
        *(((273.0, 166.0), True), ((273.1, 166.0), False), ((273.0, 166.1), False)),
    ],
)
def test_a_stack_stays_whole_where_it_has_room_upright_or_along(
    size: tuple[float, float], whole: bool
) -> None:
    """On A4 without its margins and a heading; else its drawings are taken one by one."""
    width, height = size
    inner = [Group((Line(((0.0, y), (width, y))),), f"{y}") for y in (0.0, height)]
    scene = Scene((Group(tuple(inner), "stack"), Group((Line(((0.0, 0.0), (9.0, 9.0))),), "last")))
    names = [p.title for p in _panels(scene, *room("a4"))]
    assert names == (["stack", "last"] if whole else ["0.0", f"{height}", "last"])


def test_motion_is_named_besides_only_where_there_is_a_view_of_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """None in space, and none of what has no drive."""
    for name, motion in (("rssr", False), ("truss", False), ("four_bar", True)):
        assert main(["draw", str(examples()[name]), "-o", str(tmp_path / f"{name}.svg")]) == 0
        besides = capsys.readouterr().err.partition("There is also ")[2]
        assert ("motion" in besides) is motion, name
