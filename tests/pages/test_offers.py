"""Steps that a sketch offers: which links hang free, which points fit, what still moves, and the text of each step."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.pages.sweep import _closing, _reach
from dalembert.pages.unfinished.sketch_offers import (
    MOST,
    TOGETHER,
    _drives,
    _joints,
    _new,
    _pin,
    _pivots,
    _taken,
    unrooted,
)
from dalembert.pages.unfinished.sketch_page import page_or_sketch, unfinished

CHAIN = """
links:
  ground: {points: {O: [0, 0], A: [0.5, 0.1]}}
  one: {points: {O: [0, 0], P: [0.1, 0.2]}}
  two: {points: {P: [0, 0], Q: [0.3, 0], A: [0.2, 0.1]}}
  three: {points: {Q: [0, 0], R: [0.1, 0]}}
  four: {points: {R: [0, 0], S: [0.2, 0]}}
joints:
  O: {type: pin, links: [ground, one]}
  P: {type: pin, links: [one, two]}
  R: {type: pin, links: [three, four]}
"""


def test_links_that_no_joints_lead_to_the_ground_hang_free() -> None:
    m = da.loads(CHAIN)
    assert unrooted(m) == {"three", "four"}
    joints = CHAIN + "  Q: {type: pin, links: [two, three]}\n"
    assert unrooted(da.loads(joints)) == set()
    assert unrooted(da.loads(CHAIN.partition("joints:")[0])) == {"one", "two", "three", "four"}
    assert _taken(m) == {
        *(("ground", "O"), ("one", "O"), ("one", "P"), ("two", "P"), ("three", "R"), ("four", "R")),
    }


def test_a_new_name_is_the_old_one_or_has_the_next_number() -> None:
    assert [_new("A", some) for some in ([], ["B"], ["A"], ["A", "A_2"], {"A": 1, "A_3": 2})] == [
        *("A", "A", "A_2", "A_3", "A_2"),
    ]
    m = da.loads(CHAIN)
    assert _pin(m, ("one", "Q"), ("two", "Q")) == {("joints", "Q"): {"type": "pin", "links": ["one", "two"]}}
    assert _pin(m, ("one", "B"), ("two", "Q")) == {
        ("joints", "Q"): {"type": "pin", "links": ["one", "two"], "at": ["B", "Q"]}
    }
    assert _pin(m, ("two", "P"), ("three", "P")) == {
        ("joints", "P_2"): {"type": "pin", "links": ["two", "three"], "at": ["P", "P"]}
    }


def places(**moved: tuple[float, float]) -> Any:
    """Points of the chain apart from each other, some of them elsewhere."""
    m = da.loads(CHAIN)
    pairs = [(link, point) for link, part in m.links.items() for point in part.points]
    out = {pair: np.array([10.0 * k, 3.0 * k]) for k, pair in enumerate(pairs)}
    return out | {tuple(name.split("_")): np.array(at) for name, at in moved.items()}


@pytest.mark.parametrize(("off", "near"), [(0.9 * TOGETHER, True), (1.1 * TOGETHER, False)])
def test_points_in_one_place_or_of_one_name_are_pinned(off: float, near: bool) -> None:
    """Of links that no joint joins already; within a thousandth of the size of the machine, here 2 m."""
    m = da.loads(CHAIN)
    found = list(_joints(m, places(two_Q=(7.0, 8.0), four_S=(7.0 + 2 * off, 8.0)), 2.0))
    said = ["pin A of ground to A of two", "pin Q of two to Q of three"]
    said += ["pin Q of two to S of four"] * near
    assert [step[1] for step in found] == said
    assert {step[0] for step in found} == {"joint"}
    assert found[0][2] == {("joints", "A"): {"type": "pin", "links": ["ground", "two"]}}


def test_no_more_than_so_many_joints_are_offered() -> None:
    links = {f"l{k}": {"points": {"X": [0, 0]}} for k in range(MOST)}
    m = da.mechanism({"links": {"ground": {"points": {"O": [0, 0]}}, **links}, "joints": {}})
    same = {(link, "X"): np.zeros(2) for link in links}
    assert len(list(_joints(m, same, 1.0))) == min(MOST, MOST * (MOST - 1) // 2)


def test_links_that_hang_free_get_a_pivot_where_they_are_free_points_first() -> None:
    m = da.loads(CHAIN)
    found = list(_pivots(m, places(three_Q=(1.25, -0.5)), {"three", "four"}))
    assert [step[1] for step in found] == [
        "fix Q of three to the ground",
        "fix S of four to the ground",
        "fix R of three to the ground",
        "fix R of four to the ground",
    ][:MOST]
    kind, _, values = found[0]
    assert kind == "ground"
    assert values == {
        ("links", "ground", "points", "Q"): ["1.25 m", "-0.5 m"],
        ("joints", "Q"): {"type": "pin", "links": ["ground", "three"]},
    }
    (taken,) = list(_pivots(m, {("two", "A"): np.array([1.0, 2.0])}, {"two"}))
    assert ("links", "ground", "points", "A_2") in taken[2]
    assert taken[2]["joints", "A"] == {"type": "pin", "links": ["ground", "two"], "at": ["A_2", "A"]}


def test_freedoms_that_still_move_are_driven_where_they_stand_those_on_the_ground_first() -> None:
    m = da.loads("""
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], A: [0.4, 0]}}
  block: {points: {A: [0, 0]}}
  last: {points: {A: [0, 0]}}
joints:
  S: {type: slider, links: [arm, block], at: [A, A]}
  T: {type: slot, links: [block, last], at: [A, A]}
  O: {type: pin, links: [ground, arm]}
""")
    bare = m.model_copy(update={"drives": {}})
    c = compile_mechanism(bare, bare.schedule())
    free = np.ones(len(c.freedoms), bool)
    measures = np.linspace(0.25, 1.0, len(c.freedoms))
    found = list(_drives(m, c, SimpleNamespace(free=free), measures))  # type: ignore[arg-type]
    order = [k for k in range(len(c.freedoms)) if c.freedoms[k][0] == "O"]
    order += [k for k in range(len(c.freedoms)) if c.freedoms[k][0] != "O"]
    assert [step[1] for step in found] == [
        f"drive the {c.freedoms[k][1]} of {c.freedoms[k][0]}" for k in order
    ][:MOST]
    for k, (kind, _, values) in zip(order, found, strict=False):
        joint, freedom = c.freedoms[k]
        turns = freedom in ("turn", "angle") or bool(c.layout.freedoms.angular[k])
        at = f"{np.degrees(measures[k]):.6g} deg" if turns else f"{measures[k]:.6g} m"
        more = {"freedom": freedom} if joint == "T" else {}
        assert kind == "drive"
        assert values == {("drives", joint): {"position": at} | more}
    none = SimpleNamespace(free=np.zeros(len(c.freedoms), bool))
    assert list(_drives(m, c, none, measures)) == []  # type: ignore[arg-type]


def test_what_is_finished_or_in_space_is_no_sketch() -> None:
    assert unfinished(da.four_bar()) is None
    assert unfinished(da.rssr()) is None
    free = da.loads(CHAIN)
    sketch = unfinished(free)
    assert sketch is not None
    assert sketch.measures.shape[0] > 0
    assert sketch.places["ground", "A"].tolist() == [0.5, 0.1]
    data = page_or_sketch(free, False, 0)
    assert data["format"] != page_or_sketch(da.four_bar(), False, 0)["format"]
    kinds = [offer["kind"] for offer in data["missing"]["offers"]]
    assert kinds[0] == "joint"
    assert "ground" in kinds
    assert "drive" not in kinds
    assert not any("page" in offer for offer in data["missing"]["offers"])


def test_how_far_a_link_reaches_is_the_distance_of_its_farthest_point_from_its_origin() -> None:
    assert _reach(da.loads(CHAIN)) == pytest.approx(np.hypot(0.5, 0.1))
    m = da.four_bar(ground=0.3, crank=0.2, coupler=0.15, rocker=0.12, sweep=(-0.5, 0.5))
    m = m.with_values({"drives.O2.position": 0.1})
    values = np.linspace(-3, 3, 61)
    closes = _closing(m, "O2", values, 31)
    status = [da.kinematics(m.with_values({"drives.O2.position": float(q)})).ok[0] for q in values[::6]]
    assert closes[::6].tolist() == status
