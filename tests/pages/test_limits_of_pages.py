"""What a reader may change on a page, and how the numbers of a text are found again: each rule from both sides."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.model.files.splicing import Change
from dalembert.pages.inputs import _parameter_field, _plain, label, numbers_of
from dalembert.pages.messages.number_reading import required_of
from dalembert.pages.saved_text import (
    _number,
    _other_numbers,
    _parts,
    _pieces,
    _pose_kind,
    _put,
    _put_parameter,
    with_changed_numbers,
)
from dalembert.pages.sweep import file_place, with_cycle
from tests.pages.test_page_inputs import MADE

PRESS = """
parameters: {r: {value: 45 mm, about: crank radius, range: [20 mm, 60 mm]}, l: 3*r, n: 2.5, off: 0 mm}
links:
  ground: {points: {O: [0, 0.01], C: [0.02, -0.03]}}
  crank: {points: {O: [0, 0], A: [r, 0]}, mass: 2, center: [0.01, 0.02], inertia: 0.003}
  rod: {points: {A: [0, 0], B: [l, 0], P: {from: B, at: [0.01, 0.02]}}, weight: 7, center: [0.05, 0]}
  block: {points: {B: [0, 0], Q: [0.03, 0.04]}}
joints:
  O: {type: pin, links: [ground, crank], friction: {coefficient: 0.1, radius: 0.02}}
  A: {type: pin, links: [crank, rod], friction: {radius: 0.01}}
  B: {type: pin, links: [rod, block]}
  C: {type: slider, links: [ground, block], at: [C, B], direction: 5 deg}
drives: {O: {position: 0.3, speed: 10 rad/s, acceleration: 2 rad/s^2}}
friction: {coefficient: 0.15}
loads:
  F: {type: force, on: block, at: Q, value: [30, -40]}
  G: {type: force, on: block, at: Q, value: 50, direction: 210 deg}
  K: {type: spring, between: [ground.O, block.B], stiffness: 800, free_length: 0.1}
  D: {type: damper, between: [ground.O, rod.B], damping: 12}
"""
NUMBERS = """
r n off
links.ground.points.O links.ground.points.C links.crank.points.O
links.crank.mass links.crank.center links.crank.inertia
links.rod.points.A links.rod.weight links.rod.center links.rod.inertia
links.block.points.B links.block.points.Q
joints.O.friction.coefficient joints.O.friction.radius joints.A.friction.radius joints.C.direction
loads.F.value loads.G.value loads.G.direction loads.K.stiffness loads.K.free_length loads.D.damping
friction.coefficient drives.O.speed drives.O.acceleration
"""


def test_the_numbers_that_a_reader_may_change_are_those_that_no_other_sets() -> None:
    m = da.loads(PRESS)
    found = numbers_of(m)
    wanted = NUMBERS.split()
    assert [n for n in found if n in wanted] == wanted
    assert set(found) == set(wanted)
    smooth = numbers_of(da.loads(PRESS.replace("{coefficient: 0.15}", "{coefficient: 0.15, enabled: false}")))
    assert smooth == [n for n in found if "friction" not in n]


@pytest.mark.parametrize(
    ("value", "plain"),
    [
        (1.5, True),
        ((1.5, 2.0), True),
        ((), False),
        ((1.5, "2"), False),
        (None, False),
        (3, False),
        ("a", False),
    ],
)
def test_a_number_or_a_vector_is_plain(value: Any, plain: bool) -> None:
    assert _plain(value) is plain


def test_a_parameter_s_field_has_its_unit_and_what_its_file_says_of_it() -> None:
    p = da.loads(PRESS).parameters
    assert _parameter_field("r", 0.045, p["r"]) == {
        "path": "r",
        "label": "r",
        "value": 0.045,
        "unit": "mm",
        "size": pytest.approx(1e-3, rel=1e-12),
        "kind": p["r"].kind,
        "parameter": True,
        "about": "crank radius",
        "range": [pytest.approx(0.02), pytest.approx(0.06)],
    }
    plain = _parameter_field("n", 2.5, p["n"])
    assert (plain["unit"], plain["size"], plain["kind"]) == ("", 1.0, "number")
    assert not {"about", "range"} & plain.keys()
    assert _parameter_field("off", 0.0, p["off"])["size"] == pytest.approx(1e-3, rel=1e-12)


def test_a_label_names_what_a_path_leads_to() -> None:
    assert label("loads.F.value.0") == "F: value, x"
    assert label("links.rod.points.B.1") == "rod: point B, y"
    assert label("links.rod.center.2") == "rod: mass centre, z"
    assert label("joints.C.direction") == "C: direction"
    assert label("drives.O") == "O"


def test_the_file_s_place_in_its_cycle_is_counted_from_0() -> None:
    m = da.four_bar().with_values({"drives.O2.position": 0.3})
    assert file_place(m, with_cycle(m)) == 0.0
    rocker = da.four_bar(ground=0.3, crank=0.2, coupler=0.15, rocker=0.12, sweep=(-0.5, 0.5))
    for start in (-1.05, 0.0, 1.05):
        one = rocker.with_values({"drives.O2.position": start})
        cycle = with_cycle(one)
        places = np.atleast_1d(cycle.schedule().position[:, 0])
        assert file_place(one, cycle) == pytest.approx(int(np.argmin(np.abs(places - start))), abs=1e-9)
    assert file_place(da.four_bar(), da.four_bar()) == 0.0


# numbers of a text found again

REFUSED = {"positive": "is not positive", "not negative": "is negative"}

A, B = [3.0, 0.5, -8.0], [3.3, 0.6, -9.0]


@pytest.mark.parametrize(
    ("x", "y", "which"),
    [
        ("3", "3.3", 0),
        ("3000", "3300", 0),
        ("0.25", "0.3", 1),
        ("-8", "-9", 2),
        ("8", "9", 2),
        ("3", "3.4", None),
        ("mm", "3.3", None),
        ("3", "0", None),
        ("0", "3", None),
    ],
)
def test_a_number_is_known_by_the_ratio_of_its_two_texts(x: str, y: str, which: int | None) -> None:
    assert _number(x, y, A, B) == which


def test_two_numbers_of_one_ratio_are_not_told_apart_and_a_billionth_is() -> None:
    assert _number("3", "3.3", [3.0, 30.0], [3.3, 33.0]) is None
    assert _number("3", "3.3", [3.0], [3.3 * (1 + 0.9e-9)]) == 0
    assert _number("3", "3.3", [3.0], [3.3 * (1 + 1.2e-9)]) is None
    assert _number("-3", "-3.3", [-3.0], [-3.3 * (1 + 0.9e-9)]) == 0
    assert _number("-3", "-3.3", [-3.0], [-3.3 * (1 + 1.2e-9)]) is None


def test_pieces_of_a_text_are_characters_and_numbers_with_the_sizes_of_their_units() -> None:
    assert _pieces("[3000 mm, 0.5, 7]", "[3300 mm, 0.6, 7]", A, B) == [
        "[",
        [0, 0.001],
        " mm, ",
        [1, 1.0],
        ", ",
        "7",
        "]",
    ]
    assert _pieces("[3000 mm]", "[3400 mm]", A, B) == []
    assert _pieces("[3000 mm]", "[3300 mm, 1]", A, B) == []
    assert _pieces("a 3 b", "c 3.3 b", A, B) == []


def test_parts_are_the_text_with_placeholders_and_the_numbers_that_it_lacks() -> None:
    text = "crank: 3 m, rod: 500 mm, count: 72"
    one = [Change(7, 10, "3 m"), Change(17, 23, "500 mm"), Change(32, 34, "73")]
    two = [Change(7, 10, "3.3 m"), Change(17, 23, "600 mm"), Change(32, 34, "73")]
    parts, missing = _parts(text, one, two, A, B)
    assert parts == [
        "crank: ",
        {"was": "3 m", "of": [0], "now": ["", [0, 1.0], " m"]},
        ", rod: ",
        {"was": "500 mm", "of": [1], "now": ["", [1, 0.001], " mm"]},
        ", count: ",
        {"now": ["", "73", ""]},
        "",
    ]
    assert missing == {2}
    assert _parts(text, one, [*two[:2], Change(31, 34, "73")], A, B) == (None, set())
    assert _parts(text, one[:1], two[:1], A, B)[1] == {1, 2}


def test_numbers_of_a_pose_have_their_kinds() -> None:
    paths = ["assembly.rod", "assembly.rod.position.1", "assembly.rod.axis.2", "assembly.rod.angle"]
    assert [_pose_kind(path) for path in paths] == ["angle", "length", "number", "angle"]


def test_text_is_put_where_a_path_leads() -> None:
    tree: Any = {
        "links": {"a": {"points": {"P": [1.0, 2.0]}, "mass": 3.0}},
        "loads": {"F": {"value": "1 @ 2"}},
    }
    m: Any = None
    _put(tree, ["links", "a", "points", "P", "1"], "@@4@@ m", m)
    _put(tree, ["links", "a", "mass"], "@@5@@ kg", m)
    _put(tree, ["loads", "F", "value", "1"], "@@6@@ N", m)  # polar text gives way to components
    assert tree["links"] == {"a": {"points": {"P": [1.0, "@@4@@ m"]}, "mass": "@@5@@ kg"}}
    assert tree["loads"] == {"F": {"value": [0, "@@6@@ N"]}}
    _put(tree, ["loads", "F", "value", "0"], "@@7@@ N", m)
    assert tree["loads"]["F"]["value"] == ["@@7@@ N", "@@6@@ N"]
    parameters: Any = {"r": {"value": "45 mm", "about": "crank"}, "n": 2.5}
    _put_parameter(parameters, "r", "@@0@@ m")
    _put_parameter(parameters, "n", "@@1@@")
    assert parameters == {"r": {"value": "@@0@@ m", "about": "crank"}, "n": "@@1@@"}


def test_other_numbers_are_near_and_no_two_have_one_ratio() -> None:
    """From a hundredth to three tenths more, four figures in the file's units; a 0 is as if it were 1."""
    m = da.load(examples()["four_bar"])
    k = da.compile(m, vary=["links.crank.points.A", "links.crank.weight"], outputs=["effort.O2"])
    numbers = k.trace.numbers
    links = k.trace.catalogue.compiled.links
    for rough in (set(), {0}):
        one, two = _other_numbers(m, k, rough)
        assert len(one) == len(two) == len(numbers) + len(links)
        sizes = [0.0254, 0.0254, 4.4482216152605, *[1.0] * len(links)]
        sizes[0] = 1.0 if rough else sizes[0]
        nominal = [*(n.value for n in numbers), *[0.5] * len(links)]
        for some in (one, two):
            for x, size, of in zip(some, sizes, nominal, strict=True):
                plain = of / size or 1.0
                assert 1.0099 < x / size / plain < 1.3001
                assert float(f"{x / size:.4g}") == pytest.approx(x / size, rel=1e-12)
        ratios = [round(a / b, 8) for a, b in zip(one, two, strict=True)]
        assert len(set(ratios)) == len(ratios)
        assert 1.0 not in ratios


def test_changes_of_a_page_are_numbers_and_the_places_of_links() -> None:
    m = da.four_bar()
    changed = with_changed_numbers(
        m, {"assembly.rocker": 1.8, "links.crank.points.A.0": 0.11, "assembly.coupler": -0.2}
    )
    assert changed.point("crank", "A")[0] == 0.11
    assert changed.assembly == {"rocker": 1.8, "coupler": -0.2}
    assert with_changed_numbers(m, {"links.crank.points.A.0": 0.11}).assembly == m.assembly
    space = da.rssr()
    link = next(iter(space.links.keys() - {"ground"}))
    pose = {f"assembly.{link}.position.{k}": 0.1 * k for k in range(3)}
    pose |= {f"assembly.{link}.axis.{k}": x for k, x in enumerate((0.0, 0.6, 0.8))}
    placed: Any = with_changed_numbers(space, pose | {f"assembly.{link}.angle": 0.7}).assembly[link]
    assert placed.position == pytest.approx((0.0, 0.1, 0.2))
    assert placed.axis == pytest.approx((0.0, 0.6, 0.8))
    assert placed.angle == 0.7


@pytest.mark.parametrize(
    ("path", "required"),
    [
        ("links.crank.mass", {"sign": "not negative"}),
        ("links.crank.points.A.0", {}),
        ("joints.O.friction.coefficient", {"sign": "not negative"}),
        ("joints.C.direction", {}),
        ("joints.O.friction.radius", {"sign": "not negative"}),
        ("joints.W.radius", {"sign": "positive"}),
        ("loads.F.value.0", {}),
        ("drives.O.speed", {}),
    ],
)
def test_what_is_required_of_a_number_is_what_the_model_requires(path: str, required: dict[str, str]) -> None:
    m = da.loads(MADE["wheel"] if ".W." in path else PRESS)
    assert required_of(m, path) == required
    for value, sign in ((-1.0, ("positive", "not negative")), (0.0, ("positive",))):
        if required.get("sign") in sign:
            with pytest.raises(da.ModelError, match=REFUSED[required["sign"]]):
                m.with_values({path: value})
        elif not required:
            assert m.with_values({path: value})
