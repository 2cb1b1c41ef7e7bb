"""Wrong forces and questions: what is said, word for word."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from dalembert.errors import AnalysisError, ArgumentError, ModelError
from dalembert.wrench import (
    Axis,
    Couple,
    Force,
    System,
    arrangement,
    components,
    concurrency,
    loads,
    parallel_center,
)

plane = Force([1, 0], at=[0, 1])
WRONG: list[tuple[Callable[[], Any], str]] = [
    (
        lambda: Force([1, 2, 3], at=[0, 0]),
        "a vector has 2 components where 3 are needed; "
        "the plane takes [x, y], space [x, y, z], in all parts of one system",
    ),
    (
        lambda: System(plane, Force([1, 2, 3])),
        "the system has parts in the plane and parts in space; give all vectors 2 components, or all 3",
    ),
    (lambda: System(), "the system has no force and no couple; give it at least one"),
    (lambda: Force("80 lb @ 30 deg"), "'80 lb' is a mass, but a force is needed; "
     "lb is a mass: write lbf (lbf is the force, lbm the mass)"),
    (lambda: Force([float("nan"), 0]), "nan is not a finite number; write a finite one"),
    (lambda: Force([1e61, 0]), "1e+61 is too large; write a number below 1e+60"),
    (lambda: Force([-1e61, 0]), "-1e+61 is too large; write a number below 1e+60"),
    (lambda: Couple(-1e121), "-1e+121 is too large; write a number below 1e+120"),
    (lambda: Force("3, 4"), "'3, 4' is not a vector; write [x, y] or polar text r @ angle"),
    (
        lambda: Force.by_angles(5, ["60 deg", "60 deg", "60 deg"]),
        "the squares of the three direction cosines add to 0.75, not to 1; "
        "two angles leave two values for the third: check them",
    ),
    (
        lambda: Force.by_angles(5, ["60 deg", "45 deg", "59 deg"]),
        "the squares of the three direction cosines add to 1.015, not to 1; "
        "two angles leave two values for the third: check them",
    ),
    (
        lambda: Force.by_angles(5, ["60 deg", "30 deg"]),
        "a vector has 2 components where 3 are needed; "
        "the plane takes [x, y], space [x, y, z], in all parts of one system",
    ),
    (
        lambda: Force.along(5, [1, 1], [1, 1]),
        "a vector of length 0 has no direction; write one along the line",
    ),
    (lambda: Force.directed(5, "30 deg", at=[0, 0, 0]), "a vector has 3 components where 2 are needed; "
     "the plane takes [x, y], space [x, y, z], in all parts of one system"),
    (
        lambda: components([1, 0], [0, 1], [0, -2]),
        "the axes do not point in independent directions; give up to 2 that do",
    ),
    (
        lambda: components([1, 0, 1], [1, 0, 0], [0, 1, 0]),
        "the force does not lie in the axes' plane: 1 N are left; give 3 axes",
    ),
    (
        lambda: plane.moment(Axis([0, 0], [1, 0])),
        "in the plane moments are about points; name the point that the axis passes through",
    ),
    (
        lambda: Axis([0, 0, 1], [1, 0, 0]).crossing(z=0),
        "the line runs at a constant z; cut it at another coordinate",
    ),
    (
        lambda: loads("{space: space, forces: {F: {size: 3, direction: 30}}}"),
        "text:1: direction of force 'F': 30 is not a direction in space; write [x, y, z], or angles: [a, b, c]",
    ),
    (lambda: loads("[1, 2]"), "text:1: a list is not a mapping; write forces: ..."),
    (lambda: Force.directed(5, 30, at=[0, 0, 0]), "a vector has 3 components where 2 are needed; "
     "the plane takes [x, y], space [x, y, z], in all parts of one system"),
    (lambda: Force(3), "3 is not a vector; write [x, y] or [x, y, z]"),
    (lambda: System(plane)["F"], "the system has no part 'F'; there is none"),
    (
        lambda: Force([1, 2, 3]).angle,
        "a force in space has no single angle; ask for its angles, one to each axis",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("asked", "said"), WRONG, ids=[said[:40] for _, said in WRONG])
def test_said(asked: Callable[[], Any], said: str) -> None:
    with pytest.raises(ModelError) as error:
        asked()
    assert str(error.value) == said


def test_angles_to_the_axes_that_are_rounded_leave_the_size() -> None:
    assert Force.by_angles(5, ["60 deg", "45 deg", "59.5 deg"]).size == pytest.approx(5, rel=1e-14)


def test_a_tolerance_is_a_part() -> None:
    for ask in (arrangement, concurrency, parallel_center, System.equilibrium):
        with pytest.raises(
            ArgumentError, match="tolerance is -1; give a number from 0 to 1: a part of the larg"
        ):
            ask(System(plane, plane), tolerance=-1)


def test_no_centre() -> None:
    with pytest.raises(AnalysisError, match="The forces are not parallel, so they have no centre"):
        parallel_center(System(plane, Force([0, 1])))
    with pytest.raises(AnalysisError, match="The parallel forces add to zero, so they have no centre"):
        parallel_center(System(plane, Force([-1, 0])))
    with pytest.raises(AnalysisError, match="The parallel forces add to zero"):
        parallel_center(System(Force([1e-12, 0], at=[0, 2]), plane, Force([-1, 0], at=[0, 1])))
    with pytest.raises(AnalysisError, match="The parallel forces add to zero"):
        parallel_center(System(Force([0.5, 0]), Force([0.5 + 0.7e-9, 0]), Force([-1, 0])))


def test_sentences_of_equilibrium() -> None:
    up, down = Force([0, 10], at=[2, 0]), Force([0, -10], at=[2, 5])
    assert System(up, down).equilibrium().sentence == "In equilibrium: 0 of the largest force is left."
    assert System(up, up).equilibrium().sentence == (
        "Not in equilibrium: the moments about the middle balance, the forces do not. "
        "A force of [0, -20] N on the line through [2, 0] m is missing."
    )
    said = System(Force([0, 0, 5]), Couple([1, 0, 2]), units={"length": "mm"}).equilibrium().sentence
    assert said == (
        "Not in equilibrium: neither forces nor moments balance. "
        "A force of [0, 0, -5] N on the line through [0, 200, 0] mm and a couple of [0, 0, -2000] N*mm are missing."
    )


def test_printed_figures_are_judged_by_their_own_tolerance() -> None:
    """Rounded reactions of a beam: not exact, but in equilibrium to their figures."""
    beam = System(Force([0, 6.67], at=[0, 0]), Force([0, 3.33], at=[3, 0]), Force([0, -10], at=[1, 0]))
    assert not beam.equilibrium().holds
    assert beam.equilibrium(tolerance=1e-3).holds


def test_units_of_bare_numbers() -> None:
    f = Force("600 @ 50", at=[100, 20], units={"length": "mm", "force": "kN"})
    assert f.at.tolist() == [0.1, 0.02]
    assert f.size == pytest.approx(6e5)
    assert Couple(12, units={"length": "mm", "force": "kN"}).moment == pytest.approx(12.0)
    assert Force("[1 kN, 20 N]", at=["1 in", "20 mm"]).at.tolist() == [0.0254, 0.02]


def test_a_system_says_what_it_is_and_equals_its_like() -> None:
    flat, solid = System(plane, Couple(3)), System(Force([1, 0, 2]))
    assert repr(flat) == "System(1 force and 1 couple in plane)"
    assert repr(solid) == "System(1 force and 0 couples in space)"
    assert (len(flat), len(solid)) == (2, 1)
    assert flat == System(plane, Couple(3))
    assert flat != System(plane, Couple(4))
    assert flat != System(plane, Couple(3), units={"length": "mm"})
