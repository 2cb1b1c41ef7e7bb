"""Mistakes of loads, moments, accelerations and geometry of a four-bar, each beside the same made by hand, none solved
anew but where a load is another."""

from __future__ import annotations

import re
from collections import defaultdict
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.superposition import changed_by
from dalembert.grading.wrong.misread_geometry import misread_geometry
from dalembert.grading.wrong.wrong_wrenches import wrench_changes
from tests.grading.test_wrong_problems import MORE, ByHand


@pytest.fixture(scope="module")
def hand() -> ByHand:
    return ByHand(da.loads(MORE))


def efforts(r: da.Result) -> dict[str, list[float]]:
    out: dict[str, list[float]] = defaultdict(list)
    for c in wrench_changes(r):
        out[c.sentence].append(float(changed_by(r, c.added).effort("O2")[0]))
    return out


def test_mistakes_of_forces_and_couples_have_the_efforts_of_those_made_by_hand(hand: ByHand) -> None:
    """Loads by other loads, all else by virtual work."""
    hand.loads()
    hand.moments()
    hand.accelerations()
    found = efforts(hand.r)
    assert len(hand.out) > 80
    for words, some in hand.out.items():
        assert found[words] == pytest.approx(some, rel=1e-8, abs=1e-8 * abs(hand.effort)), words


def test_masses_and_inertia_of_links_are_scaled_exchanged_or_counted_alone(hand: ByHand) -> None:
    """Each link's share of the effort is found by virtual work of its weight and its inertia."""
    found, r, m = efforts(hand.r), hand.r, hand.m
    pull = np.array(m.gravity_vector)
    mass, inertia = {}, {}
    for link in r.links:
        _, force, at, couple = hand.inertia(link)
        power = float(np.dot(force + m.mass(link) * pull, hand.velocity(link, at)))
        mass[link] = -power / hand.speed
        inertia[link] = -couple * hand.turn(link, "speed") / hand.speed
    for words, factor in {"is ten times too large": 10.0, "is ten times too small": 0.1}.items():
        for link in r.links:
            for what, part in (("mass", mass), ("moment of inertia", inertia)):
                effort = hand.effort + (factor - 1) * part[link]
                assert found[f"the {what} of {link} {words}"] == [pytest.approx(effort, rel=1e-8)]
    sizes = {"masses": (mass, m.mass), "moments of inertia": (inertia, m.inertia)}
    for words, (part, size) in sizes.items():
        for one, two in (("crank", "coupler"), ("crank", "rocker"), ("coupler", "rocker")):
            a, b = float(size(one)), float(size(two))
            effort = hand.effort + (b / a - 1) * part[one] + (a / b - 1) * part[two]
            assert found[f"the {words} of {one} and {two} are exchanged"] == [pytest.approx(effort, rel=1e-8)]
    for link in r.links:
        others = sum(
            (np.dot(f, hand.velocity(k, at)) + c * hand.turn(k, "speed")) / hand.speed
            for k, f, at, c in map(hand.inertia, set(r.links) - {link})
        )
        said = f"only the inertia of {link} is counted"
        assert found[said] == [pytest.approx(hand.effort + float(others), rel=1e-8)]


class Described(ByHand):
    """The same mistakes as values of the description, which are not solved."""

    def anew(self, words: str, values: dict[str, Any]) -> None:
        self.out[words].append(values)  # type: ignore[arg-type]


def numbers(values: dict[str, Any]) -> dict[str, list[float]]:
    """Values in SI by their paths; positions of drives within a turn are as they are."""
    out = {}
    for path, value in values.items():
        text = re.sub(r"\b(m|rad)\b", "", value) if isinstance(value, str) else str(value)
        out[path] = [
            float(x) for x in re.findall(r"-?\d+\.?\d*(?:e[-+]?\d+)?", text.replace("np.float64", ""))
        ]
    return out


def test_geometry_is_misread_as_by_hand() -> None:
    described = Described(da.loads(MORE))
    described.geometry()
    found: dict[str, list[Any]] = defaultdict(list)
    for c in misread_geometry(described.r):
        found[c.sentence].append(numbers(c.values))
    assert found.keys() == described.out.keys()
    for words, some in described.out.items():
        wanted: list[Any] = [numbers(values) for values in some]  # type: ignore[arg-type]
        assert len(found[words]) == len(wanted), words
        for one, other in zip(found[words], wanted, strict=True):
            assert one.keys() == other.keys(), words
            for path in other:
                assert one[path] == pytest.approx(other[path], rel=1e-9, abs=1e-12), (words, path)
