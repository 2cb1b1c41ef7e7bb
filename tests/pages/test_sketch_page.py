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
