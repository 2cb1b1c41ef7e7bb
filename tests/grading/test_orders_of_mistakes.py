"""Mistakes of loads and accelerations: how usual each is, and which are none because they change nothing."""

from __future__ import annotations

import numpy as np
import pytest

import dalembert as da
from dalembert.grading.wrong.wrong_problems import WrongProblem
from dalembert.grading.wrong.wrong_wrenches import wrench_changes
from tests.grading.test_wrong_machines import lever, slider_crank
from tests.grading.test_wrong_problems import MORE

SELDOM = (
    *("is ten times too large", "is ten times too small", "too large by 1000", "too small by 1000"),
    *("with the diameter as radius", "an area too small by 4", "component of", "loads F and Q are exchanged"),
    *("degrees are mistaken for radians", "the masses of", "the moments of inertia of", "as the mean of"),
    *("without its x component", "without its y component", "r w^2", "the mass of"),
)
USUAL = (
    *(
        "in link axes",
        "is left out",
        "has the wrong sign",
        "a wrong sign: x Fy",
        "g is missing",
        "only the inertia",
    ),
    *("taken as that of", "without that of", "without the normal", "without the tangential", "wrong sign in"),
)


@pytest.mark.parametrize(
    "m", [da.loads(MORE), slider_crank(0.7, 0.3), lever(0.9)], ids=["four-bar", "engine", "lever"]
)
def test_of_mistakes_of_forces_and_couples_some_are_seldom_and_the_others_less_so(m: da.Mechanism) -> None:
    found = {c.sentence: c.order for c in wrench_changes(da.dynamics(m))}
    assert {s for s, order in found.items() if order == 3} == {
        s for s in found if any(w in s for w in SELDOM)
    }
    for sentence, order in found.items():
        assert order in (2, 3), sentence
        assert order == 3 or any(words in sentence for words in USUAL), sentence


def test_what_is_fixed_has_no_acceleration_to_forget() -> None:
    """At several positions, at one of which a component of the mass centre's acceleration is nothing."""
    m = da.loads(MORE).with_values(
        {
            "drives.O2": {"position": ["0 deg", "33 deg", "71 deg"], "speed": 7.0, "acceleration": 0.0},
            "links.crank.center": [0.05, 0.0],
        }
    )
    r = da.dynamics(m)
    assert float(np.abs(r["point.crank.center.acceleration"]).min()) < 1e-9
    words = "the acceleration of the mass centre of {} is taken without that of {}"
    found = {c.sentence for c in wrench_changes(r)}
    without = {(k, j) for k in r.links for j in r.joints if words.format(k, j) in found}
    assert without == {("crank", "A"), ("coupler", "A"), ("coupler", "B"), ("rocker", "B")}


@pytest.mark.parametrize(("light", "said"), [([], ["coupler", "crank", "rocker"]), (["crank"], [])])
def test_only_the_inertia_of_one_link_is_counted_where_there_are_three(
    light: list[str], said: list[str]
) -> None:
    """Of two it is that the inertia of the other is left out."""
    none = {f"links.{link}.{key}": 0.0 for link in light for key in ("mass", "inertia")}
    r = da.dynamics(da.loads(MORE).with_values(none))
    words = [c.sentence for c in wrench_changes(r) if c.sentence.startswith("only the inertia")]
    assert sorted(words) == [f"only the inertia of {link} is counted" for link in said]


@pytest.mark.parametrize(
    ("sentence", "weight"),
    [
        ("gravity is left out", "concept"),
        ("the weights act upwards", "concept"),
        ("inertia is left out: this is the static answer", "concept"),
        ("the inertia forces are left out", "concept"),
        ("the inertia couples are left out", "concept"),
        ("weight is mistaken for mass: inertia is too large", "concept"),
        ("the position of O2 is counted from the other axis", "concept"),
        ("this is the other assembly mode", "concept"),
        ("the speed of drive O2: rpm mistaken for rad/s", "concept"),
        ("friction is left out", "concept"),
        ("the friction of joint B is left out", "datum"),
        ("load F is left out", "datum"),
        ("the weight of rod is left out", "datum"),
        ("the mass centre of rod is placed at A", "datum"),
    ],
)
def test_what_runs_through_the_problem_is_a_concept_and_one_datum_is_none(sentence: str, weight: str) -> None:
    assert WrongProblem(2, sentence, lambda: None).weight == weight


def test_of_a_fixed_pivot_rounding_is_no_acceleration() -> None:
    """Away from the origin, where the acceleration of the mass centre has no component across the crank."""
    m = slider_crank(0.0, 0.0).with_values(
        {"links.crank.mass": 1.0, "links.crank.center": [0.0537, 0.0], "drives.O.position": [0.0, 0.7, 1.9]}
    )
    r = da.dynamics(m)
    assert float(np.abs(r["point.crank.center.acceleration"]).min()) < 1e-12
    words = "the acceleration of the mass centre of crank is taken without that of "
    found = [c.sentence for c in wrench_changes(r) if c.sentence.startswith(words)]
    assert found == [f"{words}A"]
