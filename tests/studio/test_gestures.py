"""Gestures change the text: the file stays readable, its author's text stays, and every step can be undone."""

from __future__ import annotations

import difflib
import re
from random import Random
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.errors import ModelError
from dalembert.model.files.model_files import read_text
from dalembert.model.library.from_files import file_text
from dalembert.studio.document import EMPTY, STEPS, Document
from dalembert.studio.editing.entries import add_entries
from dalembert.studio.editing.gestures import gesture
from dalembert.studio.editing.references import rename, rename_point
from tests.studio.gestures_at_random import message
from tests.tiers import tiers

TEMPLATES = (
    *("four_bar", "slider_crank", "toggle_press", "watt_1", "whitworth", "scotch_yoke", "five_bar"),
    *("crank_shaper", "bucket", "planetary_train"),
)


def at(d: Document, link: str, point: str) -> dict[str, Any]:
    place = next(x for x in d.reading.drawing["links"] if x["name"] == link)["points"][point]
    return {"at": place, "link": link, "point": point}


def drawn_four_bar() -> Document:
    """A four-bar drawn from nothing, with typed lengths."""
    d = Document()
    for x in (0.0, 0.1):
        d.do(gesture({"op": "ground", "where": {"at": [x, 0.0]}}))
    d.do(
        gesture(
            {"op": "bar", "ends": [at(d, "ground", "A"), {"at": [0.02, 0.03]}], "length": "40", "angle": "60"}
        )
    )
    d.do(gesture({"op": "bar", "ends": [at(d, "link2", "C"), {"at": [0.13, 0.08]}]}))
    d.do(gesture({"op": "bar", "ends": [at(d, "link3", "D"), at(d, "ground", "B")]}))
    for link, length in (("link3", "120 mm"), ("link4", "80")):
        d.do(gesture({"op": "length", "link": link, "value": length}))
    return d


def test_a_four_bar_drawn_from_nothing_has_the_torque_of_the_template() -> None:
    d = drawn_four_bar()
    d.do(gesture({"op": "drive", "joint": "A", "position": "60"}))
    d.do(gesture({"op": "couple", "link": "link4", "value": "12,5 N*m"}))
    m = da.four_bar(crank="40 mm", coupler="120 mm", rocker="80 mm", ground="100 mm", positions=1)
    changes: dict[str, object] = {"drives.O2.position": np.pi / 3, "drives.O2.speed": 0.0}
    loads = m.to_tree() | {
        "loads": {"T": {"type": "couple", "on": "rocker", "value": 12.5}},
        "gravity": "none",
    }
    like = da.statics(da.Mechanism.model_validate(loads).with_values(changes))
    assert da.statics(da.loads(d.text)).effort("A") == pytest.approx(like.effort("O2"), rel=1e-9)


def test_every_step_is_undone_to_the_same_bytes_and_done_again() -> None:
    d, texts = Document(), list[str]()
    for n in range(STEPS + 3):
        texts.append(d.text)
        if n % 20:
            d.edit([(len(d.text), len(d.text), f"# {n}\n")])
        else:
            d.do(gesture({"op": "ground", "where": {"at": [0.01 * n, 0.0]}}))
    last = d.text
    undone = [d.text for _ in range(STEPS + 3) if d.undo()]
    assert undone == texts[:2:-1], "a hundred steps"
    while d.redo():
        pass
    assert d.text == last
    assert texts[0] == EMPTY


def drawn(seed: int, count: int) -> tuple[Document, list[str], int]:
    """A template after gestures at random: all its texts, and how many gestures were refused."""
    r, d = Random(seed), Document(file_text(TEMPLATES[seed % len(TEMPLATES)]))
    texts, refused = [d.text], 0
    for _ in range(count):
        asked = message(r, d)
        try:
            d.do(gesture(asked))
        except ModelError:
            refused += 1
        assert not d.reading.error, (asked, d.reading.error)
        if d.text != texts[-1]:
            texts.append(d.text)
    return d, texts, refused


@pytest.mark.parametrize("seed", tiers([0], [1, 2, 3], range(4, 10)))
def test_after_any_gestures_the_file_can_be_read_and_every_step_undone(seed: int) -> None:
    count = 12 if seed == 0 else 40 if seed < 4 else 1000
    d, texts, refused = drawn(seed, count)
    assert refused < 0.6 * count
    da.loads(d.text)
    kept = texts[-STEPS - 1 :]
    assert [d.text for _ in kept[1:] if d.undo()] == kept[-2::-1]


FILES = {**examples(), **cases()}


def efforts(text: str) -> list[float]:
    """Every effort and joint force of a text, bit for bit."""
    m = da.loads(text)
    r = da.dynamics(m)
    parts = [*(r.effort(drive) for drive in m.drives), *(r.reaction(joint) for joint in m.joints)]
    return [float(x) for array in parts for x in np.ravel(array)]


@pytest.mark.parametrize("name", tiers(["four_bar"], ["toggle_press", "engine", "bucket", "pump"]))
def test_a_new_name_changes_no_force(name: str) -> None:
    text = FILES[name].read_text(encoding="utf-8")
    m = da.loads(text)
    new = text
    for kind in ("links", "joints", "loads", "drives"):
        for k, old in enumerate(n for n in getattr(m, kind) if n != "ground"):
            if (kind != "drives" or old not in m.joints) and old in (da.loads(new).to_tree().get(kind) or ()):
                new = rename(new, "yaml", kind, old, f"{kind}_{k}")
    for link in da.loads(new).links:
        for k, point in enumerate(da.loads(new).links[link].points):
            new = rename_point(new, "yaml", link, point, f"p_{link}_{k}")
    assert "links_0" in new
    assert efforts(new) == efforts(text)
    changed = [x for x in difflib.ndiff(text.splitlines(), new.splitlines()) if x[:2] == "+ "]
    assert len(changed) <= len(text.splitlines()), "no line is put in but for `at`"


def test_an_entry_stands_as_its_neighbours_do() -> None:
    text = "links:\r\n  ground:  {}   # fixed\r\n  coupler: {mass: 1}\r\n# end\r\n"
    assert add_entries(text, "yaml", {("links", "a"): {}, ("loads", "F"): {"x": 1}}) == (
        "links:\r\n  ground:  {}   # fixed\r\n  coupler: {mass: 1}\r\n  a:       {}\r\n# end\r\n"
        "\r\nloads:\r\n  F: {x: 1}\r\n"
    )


def test_a_link_goes_with_all_that_needs_it() -> None:
    d = Document(FILES["four_bar"].read_text(encoding="utf-8"))
    d.do(gesture({"op": "delete", "kind": "links", "name": "rocker"}))
    m = da.loads(d.text)
    assert list(m.joints) == ["O2", "A"]
    assert list(m.loads) == ["F_P"]
    assert list(m.assembly) == ["coupler"]
    assert "the book divides its weights by 386" in d.text
    d.do(gesture({"op": "delete", "kind": "links", "name": "crank"}))
    assert "joints:" not in d.text
    assert "drives:" not in d.text


@pytest.mark.parametrize(
    ("asked", "sentence"),
    [
        ({"op": "delete", "kind": "links", "name": "ground"}, "the ground stays"),
        ({"op": "rename", "kind": "links", "name": "link2", "to": "link3"}, "already used in links"),
        ({"op": "rename", "kind": "links", "name": "link2", "to": "a b"}, "cannot be read: rename.to"),
        ({"op": "set", "path": ["links", "link2", "mass"], "value": "-1"}, "mass"),
        ({"op": "set", "path": ["links", "link2", "mass"], "value": "3 mm"}, "a mass is needed"),
        ({"op": "set", "path": ["links", "link2", 4, "mass"], "value": "3"}, "unknown key"),
        ({"op": "length", "link": "link2", "value": "-4"}, "length of -4"),
        ({"op": "couple", "link": "nothing"}, "acts on a moving link"),
        ({"op": "drive", "joint": "Z"}, "joints has no 'Z'"),
        ({"op": "ground", "where": {"at": [float("nan"), 0]}}, "cannot be read"),
        ({"op": "explode"}, "cannot be read"),
        ([], "cannot be read"),
    ],
)
def test_a_refused_gesture_says_why_and_changes_nothing(asked: Any, sentence: str) -> None:
    d = drawn_four_bar()
    before, steps = d.text, d.can
    with pytest.raises(ModelError, match=sentence):
        d.do(gesture(asked))
    assert (d.text, d.can) == (before, steps)
    assert not d.reading.error


def test_a_wrong_text_names_its_line_and_keeps_the_drawing() -> None:
    d = drawn_four_bar()
    links = d.reading.drawing["links"]
    place = d.text.index("pin")
    d.edit([(place, place + 3, "pinn")])
    assert d.reading.line == d.text[:place].count("\n") + 1
    assert "pinn" in d.reading.error
    assert d.reading.drawing["links"] == links
    with pytest.raises(ModelError, match="correct it before"):
        d.do(gesture({"op": "ground", "where": {"at": [0, 0]}}))
    with pytest.raises(ModelError, match="outside the text"):
        d.edit([(0, 10**6, "")])
    assert d.undo()
    assert not d.reading.error


STARTED = """links:
  ground: {points: {O: [0, 0], Q: [1, 0]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}}
  slab: {points: {P: [0, 0]}}
joints: {O: {type: pin, links: [ground, crank]}}
drives: {O: {effort: 0}}
start: {O: {position: 0, speed: 1 rad/s}}
assembly: {slab: [0.3, 0.2, 10]}
"""


@pytest.mark.parametrize(
    ("kind", "name", "left"),
    [
        ("drives", "O", ["links", "joints", "assembly"]),
        ("joints", "O", ["links", "assembly"]),
        ("links", "crank", ["links", "assembly"]),
        ("links", "slab", ["links", "joints", "drives", "start"]),
    ],
)
def test_what_needs_a_thing_goes_with_it(kind: str, name: str, left: list[str]) -> None:
    """A drive's start with the drive, the drive with its joint, the joint with its link; a pose with its link."""
    d = Document(STARTED)
    d.do(gesture({"op": "delete", "kind": kind, "name": name}))
    assert [line.partition(":")[0] for line in d.text.splitlines() if line[0] != " "] == left


def test_a_new_name_is_quoted_as_the_old_one_was() -> None:
    text = """links:
  ground: {points: {O: [0, 0]}}
  'crank': {points: {O: [0, 0], A: [1, 0]}}
joints:
  O: {type: pin, links: [ground, "crank"]}
loads:
  F: {type: force, on: 'crank', at: A, value: [1, 0]}
  G: {type: force, on: crank, at: A, value: [1, 0]}
"""
    expected = text.replace("'crank':", "arm:").replace("crank", "arm")
    assert rename(text, "yaml", "links", "crank", "arm") == expected


@pytest.mark.parametrize("stated", [True, False])
@pytest.mark.parametrize("second", [True, False])
def test_a_loose_link_is_where_it_was_dragged(stated: bool, second: bool) -> None:
    """A link of one point as it lies, a bar with its other end where it was: no joint holds it."""
    text = STARTED if stated else STARTED.partition("assembly")[0]
    d = Document(text.replace("{P: [0, 0]}", "{P: [0, 0], R: [0.1, 0]}") if second else text)

    def drawn() -> Any:
        return next(x for x in d.reading.drawing["links"] if x["name"] == "slab")["points"]

    before = dict(drawn())
    d.do(gesture({"op": "move", "link": "slab", "point": "P", "to": [0.5, -0.1]}))
    assert drawn()["P"] == pytest.approx((0.5, -0.1), abs=1e-7)
    if second:
        assert drawn()["R"] == pytest.approx(before["R"], abs=1e-5)  # the file has 6 digits
    else:
        pose = f"[0.5, -0.1, {10 if stated else 0}]"
        assert yaml_of(d.text)["assembly"] == {"slab": yaml_of(f"x: {pose}")["x"]}


def yaml_of(text: str) -> Any:
    return read_text(text)[0]


def test_a_pose_that_was_not_left_changes_nothing() -> None:
    d = drawn_four_bar()
    before = d.text
    links = {link["name"]: link["pose"] for link in d.reading.drawing["links"] if link["name"] != "ground"}
    d.do(gesture({"op": "pose", "links": links, "drives": {}}))
    assert d.text == before
    (x, y, angle) = links["link2"]
    d.do(gesture({"op": "pose", "links": links | {"link2": (x, y, angle + 0.1)}, "drives": {}}))
    assert d.text != before


def test_gears_turn_about_two_places() -> None:
    """The two ends of a pin are one place, however they are rounded."""
    d = drawn_four_bar()
    before = d.text
    with pytest.raises(ModelError, match=r"^the axes of two gears are apart; draw them at two places$"):
        d.do(gesture({"op": "gear", "first": at(d, "link2", "C"), "second": at(d, "link3", "C")}))
    assert d.text == before


def test_what_is_edited_as_text_and_names_that_are_taken() -> None:
    text = examples()["four_cylinder"].read_text(encoding="utf-8")
    d = Document(
        re.sub(r"value: \{file: .*\}", "value: 100", text.partition("# The exact")[0]).replace(
            "    shift:", "#"
        )
    )
    assert d.reading.error == ""
    said = "a mechanism with copies is edited as text; change the original or the copies in the text"
    with pytest.raises(ModelError, match=rf"^{said}$"):
        d.do(gesture({"op": "ground", "where": {"at": [1.0, 0.0]}}))
    with pytest.raises(ModelError, match=r"^the name 'crank' is already used in links; choose another name$"):
        add_entries(STARTED, "yaml", {("links", "crank"): {}})


def test_a_dragged_point_keeps_bars_straight_and_joints_closed() -> None:
    d = drawn_four_bar()
    d.do(gesture({"op": "drive", "joint": "A", "position": "60"}))
    before = d.reading.drawing["links"][2]["points"]["D"]
    to = [before[0] + 0.01, before[1] - 0.004]
    d.do(gesture({"op": "move", "link": "link3", "point": "D", "to": to}))
    after = {link["name"]: link["points"] for link in d.reading.drawing["links"]}
    assert after["link3"]["D"] == pytest.approx(to, abs=6e-5)
    assert after["link4"]["D"] == pytest.approx(after["link3"]["D"], abs=1e-9)
    assert da.loads(d.text).links["link3"].points["D"][1] == 0.0
    assert "O2" not in d.text
    assert "position: 60" in d.text
    d.do(gesture({"op": "move", "link": "link2", "point": "C", "to": [0.0, 0.04]}))
    assert "position: 90" in d.text, "the drive stands where the crank was moved"


def test_a_pull_moves_as_the_joints_let_it() -> None:
    d = drawn_four_bar()
    sketch = d.reading.sketch
    assert sketch is not None
    assert (sketch.freedoms, sketch.closed) == (1, True)
    m = da.loads(d.text)
    pulled = sketch.pulled("link2", m.point("link2", "C"), (0.0, 0.07))
    x, y, turn = pulled.placed["link2"]
    assert turn == pytest.approx(np.pi / 2, abs=1e-3), "the nearest place on the crank's circle"
    assert (x, y) == pytest.approx((0, 0), abs=1e-9)
    far = pulled.pulled("link3", m.point("link3", "D"), (9.0, 9.0))
    again = far.pulled("link3", m.point("link3", "D"), (9.0, 9.0))
    assert all(np.isfinite(v).all() for v in far.placed.values())
    assert far.placed["link3"] == pytest.approx(again.placed["link3"], abs=0.2)


def test_an_open_sketch_is_drawn_with_its_gap() -> None:
    d = drawn_four_bar()
    d.do(gesture({"op": "length", "link": "link3", "value": "300"}))
    sketch = d.reading.sketch
    assert sketch is not None
    assert not sketch.closed
    assert sketch.gap > 0.01
    assert not d.reading.error


def test_numbers_dragged_on_the_page_are_short_and_typed_ones_exact() -> None:
    d = Document(FILES["four_bar"].read_text(encoding="utf-8"))
    dragged = {"links.crank.points.A.0": 0.15133148634551357, "links.coupler.points.B.0": 14.25 * 0.0254}
    poses = {
        "assembly.crank": 1.0471975511965976,
        "assembly.coupler": 0.365,
        "assembly.rocker": 1.8222934073341648,
    }
    d.do(gesture({"op": "changes", "values": dragged | poses}))
    assert "A: [5.957933, 0]" in d.text
    assert "B: [14.25, 0]" in d.text
    assert da.loads(d.text).links["coupler"].points["B"][0] == 14.25 * 0.0254
    assert "assembly: {crank: 60, coupler: 20.91296, rocker: 104.4097}" in d.text
    before = d.text.splitlines()
    assert (
        len([x for x in before if x not in FILES["four_bar"].read_text(encoding="utf-8").splitlines()]) <= 3
    )


GUIDES = """links:
  ground: {points: {O: [0, 0]}}
  bar: {points: {P: [0.1, 0.1], Q: [0.2, 0.3]}}
  slab: {points: {P: [0, 0], Q: [0.2, 0.1], R: [0.1, 0.1]}}
  twice: {points: {P: [0.1, 0.1], Q: [0.1, 0.1]}}
  arm: {points: {O: [0, 0], A: [0.2, 0]}}
joints: {O: {type: pin, links: [ground, arm]}}
assembly: {bar: [0, 0, 20], slab: [0.3, 0.2, 10], twice: [0.3, 0.2, -10]}
"""


@pytest.mark.parametrize(
    ("guide", "given", "direction", "turned"),
    [
        ("ground", {}, None, 0),
        ("ground", {"direction": 0.5}, 28.648, 28.648),
        ("ground", {"angle": "40"}, 40, 40),
        ("bar", {"direction": 0.5}, 63.435, 83.435),
        ("slab", {}, -10, 0),
        ("slab", {"angle": "40"}, 30, 40),
        ("twice", {"direction": 0.5}, 38.648, 28.648),
    ],
)
@pytest.mark.parametrize("op", ["slot", "slide"])
def test_a_guide_lies_along_its_bar_or_as_it_was_drawn(
    op: str, guide: str, given: dict[str, Any], direction: float | None, turned: float
) -> None:
    """The file has its direction in the axes of its link, and the angle of what slides in it without turning."""
    d = Document(GUIDES)
    d.do(gesture({"op": op, "where": at(d, "arm", "A"), "guide": guide} | given))
    joint = next(part for name, part in yaml_of(d.text)["joints"].items() if name != "O")
    assert joint.get("direction") == direction
    assert joint["links"] == [guide, "arm"]
    assert joint.get("angle") == (-turned if op == "slide" and turned else None)


def test_a_bar_without_a_length_is_not_turned() -> None:
    d = Document(STARTED.replace("{P: [0, 0]}", "{P: [0, 0], R: [0, 0]}"))
    d.do(gesture({"op": "move", "link": "slab", "point": "R", "to": [0.3, 0.4]}))
    tree = yaml_of(d.text)
    assert tree["assembly"] == {"slab": [0.3, 0.2, 10]}
    turn = np.deg2rad(10)
    assert tree["links"]["slab"]["points"]["R"] == pytest.approx(
        [0.2 * np.sin(turn), 0.2 * np.cos(turn)], abs=1e-7
    )


NAMED = """links:
  ground: {points: {center_: [0, 0], anchor: [0.3, -0.4], eye: [1, 1], rail: [0, 2]}}
  drum: {points: {hub: [0, 0], knob: [0.1, 0], image: {from: knob, mirror: 90 deg, about: hub}}}
  lever:
    points: {anchor: [0, 0], grip: [-0.1, 0], tip: [-0.5, 0]}
    members: [[anchor, grip], [grip, tip]]
    section: {rectangle: [10 mm, 20 mm]}
    effective_length: {grip-tip: 0.7}
  block: {points: {rail: [0, 0], loop: [0, 0]}, mass: 1}
joints:
  O: {type: pin, links: [ground, drum], at: [center_, hub]}
  anchor: {type: pin, links: [ground, lever]}
  rail: {type: slider, links: [ground, block], direction: 90 deg}
  strap: {type: band, links: [drum, lever], around: hub, radius: 0.3, wrap: 270 deg,
    ends: [ground.anchor, lever.grip], friction: {coefficient: 0.3}}
  line: {type: rope, through: [block.loop, {round: drum.hub, radius: 40 mm}, lever.tip]}
drives: {O: {position: 0}}
loads: {W: {type: spring, between: [lever.tip, ground.eye], stiffness: 1 N/m, free_length: 1}}
"""


@pytest.mark.parametrize(
    ("link", "point"),
    [
        *(("drum", "hub"), ("drum", "knob"), ("lever", "grip"), ("lever", "tip"), ("block", "loop")),
        *(("ground", "eye"), ("ground", "center_")),
    ],
)
def test_a_new_name_of_a_point_is_written_wherever_it_is_meant(link: str, point: str) -> None:
    """Points placed from it and turned about it, members and their lengths, bands, ropes and springs."""
    da.loads(NAMED)
    assert rename_point(NAMED, "yaml", link, point, "new") == NAMED.replace(point, "new")
    da.loads(NAMED.replace(point, "new"))


@pytest.mark.parametrize(
    ("kind", "name"),
    [
        ("links", "drum"),
        ("links", "lever"),
        ("links", "block"),
        ("joints", "strap"),
        ("joints", "line"),
        ("loads", "W"),
    ],
)
def test_a_new_name_of_a_part_is_written_wherever_it_is_meant(kind: str, name: str) -> None:
    """A band and a rope have points of their own: they need none of a joint's name."""
    assert rename(NAMED, "yaml", kind, name, "new") == NAMED.replace(name, "new")
    da.loads(NAMED.replace(name, "new"))
