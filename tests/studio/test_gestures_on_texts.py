"""Gestures on a text: what they write, in which units, what they refuse, and from where on something has moved."""

from __future__ import annotations

import math
from typing import Any

import pytest

from dalembert.errors import ModelError
from dalembert.studio.editing.edit_gestures import (
    _short,
    cluster,
    is_number,
    joint_ends,
    joint_type,
    move_end,
    number_or_text,
)
from dalembert.studio.editing.load_gestures import typed
from tests.studio.test_drafts import PLACED, TEXT, done, draft, refused


def test_points_that_joints_hold_move_together() -> None:
    d = draft()
    assert cluster(d, ("bar", "A")) == [("bar", "A"), ("arm", "A")]
    assert cluster(d, ("arm", "A")) == [("arm", "A"), ("bar", "A")]
    assert cluster(d, ("arm", "P")) == [("arm", "P")]
    for off, count in ((0.29e-6, 2), (0.31e-6, 1)):
        d.placed["arm"] = (PLACED["arm"][0] + off, *PLACED["arm"][1:])
        assert len(cluster(d, ("bar", "A"))) == count
    rolling = draft(TEXT.replace("A: {type: pin", "A: {type: rolling"))
    assert cluster(rolling, ("bar", "A")) == [("bar", "A")]
    assert joint_ends(d) == {"O": (("ground", "O"), ("bar", "O")), "A": (("bar", "A"), ("arm", "A"))}
    other = draft(
        TEXT.replace("A: {type: pin, links: [bar, arm]}", "B: {type: pin, links: [bar, arm], at: [A, P]}")
    )
    assert joint_ends(other)["B"] == (("bar", "A"), ("arm", "P"))
    assert (joint_type(d, "O"), joint_type(d, "A"), joint_type(d, "X")) == ("pin", "pin", "")


def test_a_bar_that_is_moved_is_turned_and_made_longer() -> None:
    d, values, poses = draft(), dict[Any, Any](), dict[str, Any]()
    move_end(d, ("bar", "A"), (0.03, 0.04), values, poses)
    assert values == {("links", "bar", "points", "A"): [50, 0]}
    assert poses == {"bar": (0.0, 0.0, pytest.approx(math.atan2(4, 3)))}
    values, poses = {}, {}
    a = d.world(("bar", "A"))
    move_end(d, ("bar", "O"), (-0.2, 0.3), values, poses)
    assert values == {("links", "bar", "points", "A"): [pytest.approx(1e3 * math.dist(a, (-0.2, 0.3))), 0]}
    assert poses["bar"] == (-0.2, 0.3, pytest.approx(math.atan2(a[1] - 0.3, a[0] + 0.2)))
    values, poses = {}, {}
    move_end(d, ("arm", "P"), (0.2, 0.1), values, poses)
    assert poses == {}
    assert values["links", "arm", "points", "P"] == pytest.approx(
        [1e3 * x for x in d.local("arm", (0.2, 0.1))]
    )
    values, poses = {}, {}
    move_end(d, ("lone", "C"), (0.2, 0.1), values, poses)
    assert (values, poses) == ({}, {"lone": (0.2, 0.1, 0.0)})
    move_end(d, ("ground", "Q"), (0.25, 0.1), values, poses)
    assert values == {("links", "ground", "points", "Q"): [250, 100]}
    with pytest.raises(ModelError, match=r"^a bar needs two ends that are apart; move the point elsewhere$"):
        move_end(d, ("bar", "A"), (0.29e-7, 0.0), {}, {})
    move_end(d, ("bar", "A"), (0.31e-7, 0.0), {}, {})
    worded = draft(TEXT.replace("P: [30, 40]", "P: [30, a]"))
    with pytest.raises(
        ModelError, match=r"^point 'P' of 'arm' is an expression; change its parameters, or its text$"
    ):
        move_end(worded, ("arm", "P"), (0.2, 0.1), {}, {})


def test_a_length_of_a_bar_is_set() -> None:
    slanted = draft(TEXT.replace("A: [100, 0]}, mass", "A: [30, -40]}, mass"))
    slanted.points["bar", "A"] = (0.03, -0.04)
    tree = done({"op": "length", "link": "bar", "value": "0,2 m"}, slanted)
    assert tree["links"]["bar"]["points"]["A"] == [120, -160]
    assert done({"op": "length", "link": "bar", "value": "75"})["links"]["bar"]["points"]["A"] == [75, 0]
    for value in ("0", "-3"):
        said = f"a length of {value} is not possible; give a length greater than 0"
        assert refused({"op": "length", "link": "bar", "value": value}) == said
    for link in ("arm", "lone", "ground"):
        if link != "ground":
            said = f"{link!r} is not a bar; change its points instead"
            assert refused({"op": "length", "link": link, "value": "5"}) == said


def test_a_link_that_was_not_moved_changes_nothing() -> None:
    """By a ten-millionth of the width, 0.3 m, or a ten-millionth of a radian."""
    x, y, angle = PLACED["bar"]
    for pose, moved in (
        *(
            ((x + 0.29e-7, y, angle), False),
            ((x, y - 0.31e-7, angle), True),
            ((x, y, angle + 2 * math.pi), False),
        ),
        *(((x, y, angle - 0.9e-7), False), ((x, y, angle - 1.1e-7), True), ((x, y, angle + 1.1e-7), True)),
    ):
        tree = done({"op": "pose", "links": {"bar": pose}, "drives": {}})
        assert ("assembly" in tree) is moved, pose
    tree = done({"op": "pose", "links": {"lone": [0.0, 0.0, 0.0]}, "drives": {}})
    assert tree["assembly"] == {"lone": [0, 0, 0]}


@pytest.mark.parametrize(
    ("drive", "joint", "position", "written"),
    [
        ("position: 40", "type: pin", 0.5, pytest.approx(28.648)),
        ("position: 40 rad", "type: pin", 0.5, "0.5 rad"),
        ("position: 40 °", "type: pin", math.radians(12.5), "12.5 °"),
        ("position: 40", "type: slider", 0.0512345678, pytest.approx(51.2346)),
        ("position: 2 cm", "type: slider", 0.0512345678, "5.12346 cm"),
        ("position: unknown", "type: pin", 0.5, "unknown"),
        ("position: 40, freedom: slide", "type: slot", 0.05, 50),
        ("position: 40, freedom: turn", "type: slot", 0.5, pytest.approx(28.648)),
        ("position: {from: 1, to: 2}", "type: pin", 0.5, {"from": 1, "to": 2}),
    ],
)
def test_a_drive_follows_its_pose_in_its_unit(drive: str, joint: str, position: float, written: Any) -> None:
    d = draft(TEXT.replace("O: {position: 40}", f"O: {{{drive}}}").replace("O: {type: pin", f"O: {{{joint}"))
    tree = done({"op": "pose", "links": {"bar": [0, 0, 1.0]}, "drives": {"O": position, "X": 3}}, d)
    assert tree["drives"]["O"]["position"] == written


def test_values_are_typed_as_a_file_says_them() -> None:
    for text, value in (
        *((" 5 ", 5), ("5.5", 5.5), ("1,5", 1.5), ("true", True), ("false", False), ("2 mm", "2 mm")),
        *(
            ("[1, 2]", [1, 2]),
            ("[1; 2,5]", [1, 2.5]),
            ("[1 mm, b]", ["1 mm", "b"]),
            ("{a: 1, b: [2, 3]}", {"a": 1, "b": [2, 3]}),
        ),
        *(("[1, 2, 3]", [1, 2, 3]), ("[[1, 2], [3, 4]]", [[1, 2], [3, 4]])),
    ):
        assert number_or_text(text) == value, text
        assert type(number_or_text(text)) is type(value)
    assert [is_number(x) for x in (1, 2.5, True, "1", None)] == [True, True, False, False, False]
    d = draft()
    assert [typed(d, t, "length") for t in ("12", "1,5", " 3 cm ", "1,5 cm")] == [12, 1.5, "3 cm", "1.5 cm"]
    assert done({"op": "set", "path": ["links", "bar", "mass"], "value": ""})["links"]["bar"].keys() == {
        "points"
    }
    assert done({"op": "set", "path": ["links", "bar", "mass"], "value": None})["links"]["bar"].keys() == {
        "points"
    }
    assert (
        done({"op": "set", "path": ["links", "bar", "mass"], "value": "2,5"})["links"]["bar"]["mass"] == 2.5
    )
    assert (
        done({"op": "set", "path": ["links", "bar", "mass"], "value": False})["links"]["bar"]["mass"] is False
    )


def test_numbers_that_were_dragged_are_short_in_the_unit_of_the_file() -> None:
    d = draft()
    for path, x, shown in (
        ("links.bar.points.A.0", 0.123456789123, 0.1234568), ("links.bar.points.A.0", 0.1234567891, 0.1234567891),
        ("links.bar.center.0", -0.0333333333333, -0.03333333), ("assembly.bar", 1 / 3, math.radians(19.09859)),
        ("joints.O.direction", 1.0000000001 / 3, math.radians(19.09859)), ("links.bar.mass", 1 / 3, 0.3333333),
    ):  # fmt: skip
        assert _short(d, path, x) == pytest.approx(shown, rel=1e-13), path
    assert _short(d, "links.bar.mass", 0.25) == 0.25


def test_a_force_is_drawn_or_typed() -> None:
    where = {"at": [0, 0], "link": "arm", "point": "P"}
    drawn = done({"op": "force", "where": where, "vector": [-3000, 4000]})["loads"]["F2"]
    assert drawn == {
        "type": "force",
        "on": "arm",
        "at": "P",
        "value": f"5 @ {round(math.degrees(math.atan2(4, -3)), 3)}",
    }
    typed_in = done({"op": "force", "where": where, "vector": [1, 1], "value": "2,5", "angle": "-30"})
    assert typed_in["loads"]["F2"]["value"] == "2.5 @ -30"
    with_unit = done({"op": "force", "where": where, "value": "200 N", "angle": "0.5 rad"})["loads"]["F2"]
    assert (with_unit["value"], with_unit["direction"]) == ("200 N", pytest.approx(28.648))
    for bad in ({"at": [0, 0]}, {"at": [0, 0], "link": "ground", "point": "O"}):
        said = "a force acts on a point of a moving link; draw it from such a point"
        assert refused({"op": "force", "where": bad, "vector": [1, 1]}) == said


def test_a_couple_and_spans_have_their_usual_values() -> None:
    assert done({"op": "couple", "link": "bar"})["loads"]["T1"] == {
        "type": "couple",
        "on": "bar",
        "value": "10 N*m",
    }
    for link in ("ground", "X"):
        said = "a couple acts on a moving link; click a link of the drawing"
        assert refused({"op": "couple", "link": link}) == said
    ends = {
        "first": {"at": [0, 0], "link": "ground", "point": "Q"},
        "second": {"at": [0, 0], "link": "bar", "point": "A"},
    }
    long = pytest.approx(1e3 * math.dist((0.3, 0.0), draft().world(("bar", "A"))), rel=1e-5)
    between = ["ground.Q", "bar.A"]
    spring = done({"op": "spring", **ends})["loads"]["K1"]
    assert spring == {"type": "spring", "between": between, "stiffness": "1000 N/m", "free_length": long}
    damper = done({"op": "damper", "value": "7 N*s/m", **ends})["loads"]["D1"]
    assert damper == {"type": "damper", "between": between, "damping": "7 N*s/m"}
    cylinder = done({"op": "cylinder", **ends})["drives"]["cylinder1"]
    assert cylinder == {"position": long, "cylinder": {"between": between, "bore": "50 mm"}}
    same = {"first": ends["first"], "second": {"at": [0, 0], "link": "ground", "point": "O"}}
    for op, some in (
        ("damper", same),
        ("spring", {**ends, "second": {"at": [1, 1]}}),
        ("spring", {**ends, "first": {"at": [1, 1]}}),
    ):
        assert (
            refused({"op": op, **some})
            == f"a {op} joins points of two links; drag from one point to the other"
        )


@pytest.mark.parametrize(
    ("joint", "more", "keys"),
    [
        ("type: pin", {"here": 0.5}, {"position": pytest.approx(28.648)}),
        ("type: pin", {"position": "12", "speed": "60 rpm"}, {"position": 12, "speed": "60 rpm"}),
        ("type: pin", {"whole_turn": True}, {"position": {"from": 0, "to": 360, "count": 72}}),
        ("type: slider", {"here": 0.05, "whole_turn": True}, {"position": 50}),
        (
            "type: slot",
            {"here": 0.05, "freedom": "slide", "speed": "3"},
            {"position": 50, "freedom": "slide", "speed": 3},
        ),
        (
            "type: slot",
            {"here": 0.5, "freedom": "turn"},
            {"position": pytest.approx(28.648), "freedom": "turn"},
        ),
        ("type: pin", {"here": 0.5, "freedom": "turn"}, {"position": pytest.approx(28.648)}),
    ],
)
def test_a_joint_is_driven(joint: str, more: dict[str, Any], keys: dict[str, Any]) -> None:
    changed = TEXT.replace("A: {type: pin", f"A: {{{joint}").replace("length: mm", "length: mm, speed: mm/s")
    assert done({"op": "drive", "joint": "A", **more}, draft(changed))["drives"]["A"] == keys
    assert done({"op": "drive", "joint": "O", "here": 1.0})["drives"] == {
        "O": {"position": pytest.approx(57.296)}
    }
    assert refused({"op": "drive", "joint": "X"}) == "joints has no 'X'; click a joint of the drawing"


def test_what_is_taken_out_takes_with_it_what_needs_it() -> None:
    tree = done({"op": "delete", "kind": "points", "link": "arm", "name": "P"})
    assert "P" not in tree["links"]["arm"]["points"]
    assert "loads" not in tree
    assert set(tree["joints"]) == {"O", "A"}
    tree = done({"op": "delete", "kind": "points", "link": "bar", "name": "A"})
    assert (set(tree["joints"]), set(tree["loads"])) == ({"O"}, {"F1"})
    tree = done({"op": "delete", "kind": "links", "name": "bar"})
    assert {"joints", "drives"}.isdisjoint(tree)
    assert set(tree["loads"]) == {"F1"}
    said = "link 'arm' has no point 'X'; choose a point of the drawing"
    assert refused({"op": "delete", "kind": "points", "link": "arm", "name": "X"}) == said
    assert (
        refused({"op": "delete", "kind": "links", "name": "ground"}) == "the ground stays; delete its points"
    )
    assert (
        refused({"op": "delete", "kind": "loads", "name": "X"})
        == "loads has no 'X'; choose one that is in the file"
    )
    said = "ground is the name of the fixed link; rename another link"
    assert refused({"op": "rename", "kind": "links", "name": "ground", "to": "earth"}) == said


def test_drives_of_pins_follow_the_bar_that_was_moved() -> None:
    named = TEXT.replace("  O: {position: 40}", "  D: {joint: O, position: 40}\n  A: {position: 3 rad}")
    drives = done({"op": "move", "link": "bar", "point": "A", "to": [0.03, 0.04]}, draft(named))["drives"]
    assert drives == {"D": {"joint": "O", "position": pytest.approx(53.13)}, "A": {"position": "3 rad"}}
