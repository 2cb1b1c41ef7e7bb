"""A mechanism that is not finished has a sketch: its program, what is missing, and the text of each offer."""

from __future__ import annotations

import base64
import json
import re
import zlib
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.bundled import examples
from dalembert.errors import ModelError
from dalembert.pages.unfinished.sketch_page import page_or_sketch

LOOSE = """
title: Four bars without a drive  # a remark
units: {length: mm}
links:
  ground:  {points: {O2: [0, 0], O4: [100, 0]}}
  crank:   {points: {O2: [0, 0], A: [40, 0]}}
  coupler: {points: {A: [0, 0], B: [100, 0], C: [50, 30]}}
  rocker:  {points: {O4: [0, 0], B: [80, 0]}}
joints:
  O2: {type: pin, links: [ground, crank]}
  A:  {type: pin, links: [crank, coupler]}
  B:  {type: pin, links: [coupler, rocker]}
  O4: {type: pin, links: [ground, rocker]}
loads:
  P: {type: force, on: coupler, at: C, value: [10, -20]}
"""
OPEN = LOOSE.replace("  B:  {type: pin, links: [coupler, rocker]}\n", "").replace(
    "loads:", "drives: {O2: {position: 60 deg}}\nassembly: {coupler: 20 deg, rocker: 100 deg}\nloads:"
)
GRAVITY = "gravity: [0, -9.81 m/s^2]\n"
BAR = "title: A bar\nlinks:\n  bar: {points: {O: [0, 0], A: [0.1, 0]}}\njoints: {}\n"
"""All free; not joined at B; a bar that hangs on nothing."""


def inside(offer: Any) -> Any:
    return json.loads(zlib.decompress(base64.b64decode(offer["page"])))


@pytest.mark.parametrize(
    ("text", "kinds", "finished"),
    [
        (LOOSE, ["drive"] * 4, [True] * 4),
        pytest.param(OPEN, ["joint", "drive", "drive"], [True, False, False], marks=pytest.mark.long),
    ],
)
def test_each_offer_is_a_file_and_one_step_further(text: str, kinds: list[str], finished: list[bool]) -> None:
    m = da.loads(text)
    with pytest.raises(ModelError) as refused:
        da.statics(m)
    data = page_or_sketch(m)
    assert data["format"] == "dalembert-sketch/1"
    assert data["missing"]["sentence"] == f"{refused.value.what}; {refused.value.remedy}"
    offers = data["missing"]["offers"]
    assert [o["kind"] for o in offers] == kinds
    kept = text.splitlines()
    for offer, whole in zip(offers, finished, strict=True):
        assert len(set(kept) - set(offer["text"].splitlines())) <= 1  # the line to which it is added
        after = da.loads(offer["text"])
        assert (inside(offer)["format"] == "dalembert-page/1") is whole
        if whole:
            assert da.statics(after).ok.all()


BESIDE = """
links:
  ground: {points: {O2: [0, 0], O4: [100 mm, 0], Q: [1, 0], P: [2, 0]}}
  crank: {points: {O2: [0, 0], A: [40 mm, 0]}}
  coupler: {points: {A: [0, 0], B: [100 mm, 0]}}
  rocker: {points: {O4: [0, 0], B: [80 mm, 0]}}
  arm: {points: {Q: [0, 0]}}
joints:
  O2: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, coupler]}
  B: {type: pin, links: [coupler, rocker]}
  O4: {type: pin, links: [ground, rocker]}
  Q: {type: pin, links: [ground, arm]}
drives: {O2: {position: 60 deg}, O4: {position: 100 deg}}
assembly: {coupler: 20 deg, rocker: 100 deg}
"""
"""A four-bar with two drives, and an arm with none: as many drives as freedoms, in the wrong place."""
BLOCK = """
  bar: {points: {P: [0, 0], R: [0.5, 0]}}
joints:
  S: {type: slot, links: [ground, bar], at: [P, P], direction: 0}"""


@pytest.mark.parametrize(
    ("text", "offered"),
    [
        (
            OPEN,
            [
                ("joint", "pin B of coupler to B of rocker", "joints", "B"),
                ("drive", "drive the turn of O4", "drives", "O4"),
                ("drive", "drive the turn of A", "drives", "A"),
            ],
        ),
        (BESIDE, [("drive", "drive the turn of Q", "drives", "Q")]),
        (
            BESIDE.replace("\njoints:", BLOCK),
            [
                ("drive", "drive the slide of S", "drives", "S"),
                ("drive", "drive the turn of S", "drives", "S"),
                ("drive", "drive the turn of Q", "drives", "Q"),
            ],
        ),
    ],
    ids=["open", "beside", "slot"],
)
def test_what_is_offered_adds_one_thing(text: str, offered: list[tuple[str, ...]]) -> None:
    """A joint where two points of one name are loose; a drive of what still moves, with its freedom."""
    offers = page_or_sketch(da.loads(text), inside=0)["missing"]["offers"]
    assert [(o["kind"], o["said"]) for o in offers] == [row[:2] for row in offered]
    assert not any("page" in o for o in offers)
    before = da.loads(text)
    for offer, (kind, said, section, name) in zip(offers, offered, strict=True):
        after = da.loads(offer["text"])
        assert set(getattr(after, section)) - set(getattr(before, section)) == {name}
        if kind == "drive":
            assert after.drives[name].freedom == said.split()[2]


def test_of_one_kind_six_are_offered() -> None:
    """Eight bars at one place, of which none is joined: pins and pivots; then all pinned, and none driven."""
    bars = "".join(f"  b{k}: {{points: {{P: [0, 0]}}}}\n" for k in range(8))
    text = f"links:\n  ground: {{points: {{P: [0, 0]}}}}\n{bars}joints: {{}}\n"
    offers = page_or_sketch(da.loads(text), inside=0)["missing"]["offers"]
    pins = [o["said"] for o in offers if o["kind"] == "joint"]
    assert pins == [f"pin P of ground to P of b{k}" for k in range(6)]
    fixed = [o["said"] for o in offers if o["kind"] == "ground"]
    assert fixed == [f"fix P of b{k} to the ground" for k in range(6)]
    joints = ", ".join(f"J{k}: {{type: pin, links: [ground, b{k}], at: P}}" for k in range(8))
    pinned = da.loads(text.replace("joints: {}", f"joints: {{{joints}}}"))
    offers = page_or_sketch(pinned, inside=0)["missing"]["offers"]
    assert [o["said"] for o in offers] == [f"drive the turn of J{k}" for k in range(6)]


@pytest.mark.parametrize("axes", ["", ", axes: link"])
def test_a_force_by_its_size_and_direction_is_drawn_like_its_components(axes: str) -> None:
    """In degrees: 10 N at 30 deg are 8.66 N and 5 N; all the rest of the sketch is the same."""
    found = []
    for value in ("10, direction: 30", "[8.660254037844387, 4.999999999999999]"):
        data = page_or_sketch(da.loads(LOOSE.replace("[10, -20]", value + axes)), inside=0)
        assert data["views"]["mechanism"]["arrows"]
        found.append({k: v for k, v in data.items() if k not in ("text", "missing")})
    assert found[0] == found[1]


def test_a_bar_is_grounded_then_driven() -> None:
    """By offers alone; the last one gives the torque that holds its weight."""
    data = page_or_sketch(da.loads(BAR.replace("0.1, 0]}", "0.1, 0]}, mass: 2, center: [0.05, 0]") + GRAVITY))
    grounded = data["missing"]["offers"][0]
    assert grounded["said"] == "fix O of bar to the ground"
    driven = inside(grounded)["missing"]["offers"][0]
    assert driven["said"] == "drive the turn of O"
    m = da.loads(driven["text"])
    assert da.statics(m).effort("O")[0] == pytest.approx(2 * 9.81 * 0.05)


def test_more_drives_than_freedoms() -> None:
    m = da.four_bar().with_values({"drives": {"O2": {"position": 1.0}, "O4": {"position": 2.0}}})
    offers = page_or_sketch(m, inside=0)["missing"]["offers"]
    assert [o["said"] for o in offers] == ["leave out drive O2", "leave out drive O4"]
    assert list(da.loads(offers[0]["text"]).drives) == ["O4"]


def test_the_saved_text_has_the_pose_that_is_drawn() -> None:
    """Any pose that closes is written and found again, whatever the links hang on."""
    data = page_or_sketch(da.loads(LOOSE), inside=0)
    pose = data["sketch"]["pose"]
    assert [(arrow["of"], arrow["link"]) for arrow in data["views"]["mechanism"]["arrows"]] == [
        ("P", "coupler")
    ]
    numbers = [x for k, turn in enumerate(pose["turn"]) for x in (*pose["point"][2 * k : 2 * k + 2], turn)]
    text = re.sub(r"@@(\d+)@@", lambda k: repr(numbers[int(k[1])]), data["text"])
    m = da.loads(text)
    c = compile_mechanism(m, m.schedule())
    found = c.first_modes
    assert found is not None
    assert np.abs(np.sin((found.pose.turn[0, :-1] - pose["turn"]) / 2)).max() < 1e-9
    assert "# a remark" in text


def test_what_is_finished_or_only_refused_is_no_sketch() -> None:
    assert page_or_sketch(da.four_bar())["format"] == "dalembert-page/1"
    with pytest.raises(ModelError, match="equilibrium positions"):
        page_or_sketch(da.load(examples()["balance_position"]))
    space = da.load(examples()["rssr"])
    with pytest.raises(ModelError, match="freedom"):
        page_or_sketch(space.model_copy(update={"drives": {}, "loads": {}}))
