"""A text under a gesture: its names, numbers, places and changes, and the limits from which something has moved."""

from __future__ import annotations

import math
from typing import Any

import pytest

from dalembert.errors import ModelError
from dalembert.model.files.model_files import read_text
from dalembert.model.files.splicing import REMOVED
from dalembert.studio.editing import entries
from dalembert.studio.editing.draft import Draft
from dalembert.studio.editing.entries import add_entries
from dalembert.studio.editing.gestures import gesture

TEXT = """units: {length: mm, force: kN, angle: deg, moment: N*m}
links:
  ground: {points: {O: [0, 0], Q: [300, 0]}}
  bar: {points: {O: [0, 0], A: [100, 0]}, mass: 1}
  arm: {points: {A: [0, 0], P: [30, 40], Q: [-20, 10]}}
  lone: {points: {C: [0, 0]}}
joints:
  O: {type: pin, links: [ground, bar]}
  A: {type: pin, links: [bar, arm]}
drives:
  O: {position: 40}
loads:
  F1: {type: force, on: arm, at: P, value: 3 @ 30}
"""
PLACED = {"bar": (0.0, 0.0, math.radians(30)), "arm": (0.1 * math.cos(math.pi / 6), 0.05, math.radians(-50))}
POINTS = {
    ("ground", "O"): (0.0, 0.0), ("ground", "Q"): (0.3, 0.0), ("bar", "O"): (0.0, 0.0), ("bar", "A"): (0.1, 0.0),
    ("arm", "A"): (0.0, 0.0), ("arm", "P"): (0.03, 0.04), ("arm", "Q"): (-0.02, 0.01), ("lone", "C"): (0.0, 0.0),
}  # fmt: skip


def draft(text: str = TEXT) -> Draft:
    d = Draft(text, "yaml", read_text(text, "yaml")[0], PLACED)
    d.points = dict(POINTS)
    return d


def done(message: dict[str, Any], d: Draft | None = None) -> Any:
    """The tree of the text after a gesture."""
    d = d or draft()
    gesture(message).apply(d)
    return read_text(d.text, "yaml")[0]


def refused(message: dict[str, Any], text: str = TEXT) -> str:
    with pytest.raises(ModelError) as error:
        done(message, draft(text))
    return str(error.value)


def test_places_go_from_a_link_to_the_ground_and_back() -> None:
    d = draft()
    x, y, angle = PLACED["arm"]
    c, s = math.cos(angle), math.sin(angle)
    at = x + 0.03 * c - 0.04 * s, y + 0.03 * s + 0.04 * c
    assert d.world(("arm", "P")) == pytest.approx(at)
    assert d.local("arm", at) == pytest.approx((0.03, 0.04))
    assert d.local("nowhere", (0.2, 0.7)) == (0.2, 0.7)
    assert d.world(("lone", "C")) == (0.0, 0.0)
    with pytest.raises(ModelError, match=r"^link 'arm' has no point 'X'; choose a point of the drawing$"):
        d.world(("arm", "X"))
    assert list(d.ends()) == list(POINTS)
    del d.points["arm", "P"]
    assert ("arm", "P") not in set(d.ends())


def test_the_width_of_a_drawing_is_the_larger_of_its_spans() -> None:
    d = draft()
    assert d.width == pytest.approx(0.3 - 0.0)
    d.points["ground", "Q"] = (0.1, -0.7)
    assert d.width == pytest.approx(0.7 + max(d.world(e)[1] for e in d.ends()))
    d.points = {("ground", "O"): (0.2, 0.2)}
    assert d.width == 0.1
    d.points = {}
    assert d.width == 0.1


def test_names_of_new_things_are_free() -> None:
    d = draft()
    assert d.letter() == "B"
    assert d.letter("B") == "D"
    assert d.letter("B", "D") == "F"
    taken = [c for c in "ABCDEFGHIJKLMNOPQRSTUVWXYZ" if c != "N"]
    assert d.letter(*taken) == "A1"
    assert d.numbered("loads", "F", 1) == "F2"
    assert d.numbered("loads", "F", 3) == "F3"
    assert d.numbered("loads", "T", 1) == "T1"
    assert d.numbered("assembly", "T", 2) == "T2"
    with pytest.raises(ModelError, match=r"^the name 'F1' is already used in loads; choose another name$"):
        d.put("loads", "F1", {})


def test_numbers_are_in_the_units_of_the_file() -> None:
    d = draft()
    assert d.size("1,5", "length") == pytest.approx(0.0015)
    assert d.size(" -2,25 m", "length") == pytest.approx(-2.25)
    assert d.size("3", "force") == pytest.approx(3000)
    assert (d.number(0.1234567), d.number(0.12), d.number(0.1234567, "length", 3)) == (123.4567, 120, 123)
    assert isinstance(d.number(0.12), int)
    assert isinstance(d.number(1e9), float), "1e12 mm is no number to write with all its figures"
    assert isinstance(d.number(9.99e8), int)
    assert (d.with_unit(0.125, "length", "m"), d.with_unit(0.5, "length", "cm")) == ("0.125 m", "50 cm")
    assert d.with_unit(1 / 3, "length", "mm", 4) == "333.3 mm"
    assert [d.angle_text(math.radians(x)) for x in (370.0, -190.0, 12.34567, 0.0004)] == [10, 170, 12.346, 0]
    assert d.vector((0.1, 2e-10)) == [100, 0]
    assert d.vector((0.1, -4e-10)) == [100, -4e-7]
    assert d.vector((-1.0, 0.9e-9)) == [-1000, 0]
    assert d.vector((1.1e-9, 1.0)) == [1.1e-6, 1000]
    assert d.vector((0.123456789, 0.1), 4) == [123.5, 100]


def test_a_drawn_length_has_four_figures_of_the_width() -> None:
    d = draft()
    for width, step in ((0.3, 1e-4), (0.0999, 1e-5), (1.0, 1e-3), (0.0, 1e-12)):
        assert d.drawn(0.123456789012345, width) == pytest.approx(
            round(0.123456789012345 / step) * step, abs=step / 1e3
        )
    inches = Draft(
        TEXT.replace("length: mm", "length: in"),
        "yaml",
        read_text(TEXT.replace("length: mm", "length: in"), "yaml")[0],
        {},
    )
    assert inches.unit_step == pytest.approx(2.54)
    assert inches.drawn(0.1234, 0.3) == pytest.approx(round(0.1234 / 2.54e-4) * 2.54e-4)
    assert d.unit_step == pytest.approx(1.0)


def test_changes_of_a_draft_are_seen_at_once_and_written_together() -> None:
    d = draft()
    d.put("loads", "T1", {"type": "couple", "on": "bar", "value": 2})
    d.splice({("loads", "T1", "value"): 7})
    d.put("assembly", "bar", 30)
    d.splice({("assembly", "bar"): 31, ("links", "bar", "mass"): 5, ("links", "arm", "center"): [1, 2]})
    d.splice({("links", "arm", "points", "P", 1): 9, ("drives", "O", "position"): REMOVED})
    d.splice({("drives", "O", "never"): REMOVED})
    assert d.tree["loads"]["T1"]["value"] == 7
    assert d.tree["drives"]["O"] == {}
    tree = read_text(d.text, "yaml")[0]
    assert tree["loads"]["T1"] == {"type": "couple", "on": "bar", "value": 7}
    assert tree["assembly"] == {"bar": 31}
    assert (tree["links"]["bar"]["mass"], tree["links"]["arm"]["center"]) == (5, [1, 2])
    assert tree["links"]["arm"]["points"]["P"] == [30, 9]
    assert d.text == d.text
    assert not d.entries("start")
    copied = TEXT + "copies: {x: {of: [bar]}}\n"
    with pytest.raises(ModelError) as error:
        Draft(copied, "yaml", read_text(copied, "yaml")[0], {})
    said = "a mechanism with copies is edited as text; change the original or the copies in the text"
    assert str(error.value) == said


def test_a_point_is_added_in_the_axes_of_its_link() -> None:
    d = draft()
    at = d.world(("arm", "P"))
    d.add_point("arm", "B", at)
    assert d.points["arm", "B"] == pytest.approx((0.03, 0.04))
    tree = read_text(d.text, "yaml")[0]
    assert tree["links"]["arm"]["points"]["B"] == pytest.approx([30, 40])
    assert d.has_point("arm", "B")
    assert not d.has_point("arm", "C")
    assert not d.has_point("none", "C")
    bare = draft(TEXT.replace("lone: {points: {C: [0, 0]}}", "lone: {mass: 2}"))
    bare.add_point("lone", "C", (0.2, -0.1))
    assert read_text(bare.text, "yaml")[0]["links"]["lone"] == {"mass": 2, "points": {"C": [200, -100]}}


def test_a_pose_is_an_angle_or_a_place_and_an_angle() -> None:
    d = draft()
    d.assemble("bar", 0.01, 0.02, math.radians(33), joined=True)
    d.assemble("lone", 0.01, -0.02, math.radians(44), joined=False)
    d.assemble("bar", 0.01, 0.02, math.radians(-12.5), joined=True)
    assert read_text(d.text, "yaml")[0]["assembly"] == {"bar": -12.5, "lone": [10, -20, 44]}
    assert d.placed["bar"] == (0.01, 0.02, math.radians(-12.5))


def test_entries_are_added_behind_the_last_of_their_section() -> None:
    entry: dict[tuple[str, str], object] = {("loads", "T"): 5}
    for text, after in (
        ("loads:\n  F: 3\n", "loads:\n  F: 3\n  T: 5\n"), ("loads:\n  F: 3", "loads:\n  F: 3\n  T: 5"),
        ("loads:\r\n  F: 3\r\n", "loads:\r\n  F: 3\r\n  T: 5\r\n"), ("a: 1\n", "a: 1\n\nloads:\n  T: 5\n"),
        ("a: 1", "a: 1\n\nloads:\n  T: 5\n"), ("loads:\n  F: 3\na: 1\n", "loads:\n  F: 3\n  T: 5\na: 1\n"),
        ("loads:\n  long:  {x: 1}\n", "loads:\n  long:  {x: 1}\n  T:     5\n"),
    ):  # fmt: skip
        assert add_entries(text, "yaml", entry) == after
    with pytest.raises(ModelError, match=r"^the name 'T' is already used in loads; choose another name$"):
        add_entries("loads:\n  T: 3\n", "yaml", entry)


def test_with_a_link_go_the_cylinders_between_its_points_and_no_others() -> None:
    """A drive of its joint too; of a link that is no end of the cylinder the drive stays."""
    tree: Any = {
        "links": {"ground": {}, "boom": {}, "arm": {}},
        "joints": {"A": {"links": ["ground", "boom"]}, "B": {"links": ["boom", "arm"]}},
        "drives": {"A": {"cylinder": {"between": ["ground.C", "arm.D"]}}},
    }
    gone = [set(entries._dependents(tree, "links", link)) for link in ("arm", "boom")]
    assert gone[0] == {("links", "arm"), ("joints", "B"), ("drives", "A")}
    assert gone[1] == {("links", "boom"), ("joints", "A"), ("joints", "B"), ("drives", "A")}
    tree["drives"]["A"]["cylinder"] = {"between": ["ground.C", "boom.D"]}
    assert set(entries._dependents(tree, "links", "arm")) == {("links", "arm"), ("joints", "B")}
