"""Figures carried forward from a wrong one, made by hand: which follow, by which equation, and which one is first."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.grading.figure import StudentValue, figure
from dalembert.grading.own_figures import OwnFigures, own_figures
from dalembert.grading.sheet_equations import SheetEquations


@pytest.fixture(scope="module")
def r() -> da.Result:
    return da.dynamics(
        da.four_bar(positions=1).with_values(
            {
                "drives.O2": {"position": "50 deg", "speed": 9.0, "acceleration": 4.0},
                "loads.torque.value": 7.0,
            }
        )
    )


@pytest.fixture(scope="module")
def equations(r: da.Result) -> SheetEquations:
    return SheetEquations(r)


def force(r: da.Result, joint: str, on: str, off: Any = (0.0, 0.0)) -> StudentValue:
    x, y = r.reaction(joint, on=on)[0] + np.array(off)
    value = [f"{float(x)!r} N", f"{float(y)!r} N"]
    return figure(r, da.Answer(quantity="reaction", of=joint, on=on, value=value))


def effort(r: da.Result, off: float = 0.0) -> StudentValue:
    return figure(r, da.Answer(quantity="effort", of="O2", value=f"{float(r.effort('O2')[0]) + off!r} N*m"))


def moment(r: da.Result, joint: str, about: str, link: str, off: Any) -> float:
    """Of a force at a joint of a link about another of its joints."""
    x, y = r[f"point.{link}.{joint}"][0] - r[f"point.{link}.{about}"][0]
    return float(x * off[1] - y * off[0])


OFF = np.array([30.0, -50.0])


def test_the_force_at_the_other_end_of_a_link_follows_by_its_sums(
    r: da.Result, equations: SheetEquations
) -> None:
    """A on the coupler is wrong by some force, B by the opposite one: the first is what is solved for first."""
    some = [
        force(r, "A", "coupler", OFF),
        force(r, "O4", "rocker"),
        force(r, "B", "coupler", -OFF),
        effort(r),
    ]
    found = own_figures(equations, some)
    a, b = (equations.order[equations.index["joint", name]] for name in "AB")
    first, rest = (0, 2) if a <= b else (2, 0)
    assert found == OwnFigures({rest: "sums of forces on coupler"}, {first: [rest]}, {first: 2})


def test_the_torque_follows_by_the_moments_about_its_pin(r: da.Result, equations: SheetEquations) -> None:
    """The force on the crank is that on the coupler turned round."""
    some = [effort(r, moment(r, "A", "O2", "crank", OFF)), force(r, "A", "coupler", OFF)]
    found = own_figures(equations, some)
    assert found == OwnFigures({0: "moments about O2 on crank"}, {1: [0]}, {1: 2})
    other = own_figures(equations, [effort(r, -moment(r, "A", "O2", "crank", OFF)), some[1]])
    assert other.follows == {}
    assert other.numbers == {0: 1, 1: 2}
    assert other.first == {}


@pytest.mark.parametrize(("off", "numbers"), [((30.0, 0.0), 1), ((0.0, -50.0), 1), ((30.0, -50.0), 2)])
def test_of_a_force_one_number_is_wrong_where_an_equation_gives_the_other(
    off: tuple[float, float], numbers: int, r: da.Result, equations: SheetEquations
) -> None:
    found = own_figures(equations, [force(r, "B", "coupler"), force(r, "A", "coupler", off)])
    assert (found.numbers, found.follows, found.first, found.slip) == ({1: numbers}, {}, {}, "")


def test_what_follows_is_followed_by_others(r: da.Result, equations: SheetEquations) -> None:
    """From A to B to O4 by sums, and from A to the torque."""
    some = [
        effort(r, moment(r, "A", "O2", "crank", OFF)),
        force(r, "O4", "rocker", OFF * -1),
        force(r, "B", "rocker", OFF),
        force(r, "A", "coupler", OFF),
    ]
    found = own_figures(equations, some)
    assert len(found.follows) == 3
    (first,) = found.first
    assert found.numbers == {first: 2}
    assert sorted([first, *found.follows]) == [0, 1, 2, 3]
    assert sorted(found.first[first]) == sorted(found.follows)
    assert found.follows.get(0) == "moments about O2 on crank"


def test_right_figures_and_single_ones_say_nothing(r: da.Result, equations: SheetEquations) -> None:
    assert own_figures(equations, [effort(r), force(r, "A", "coupler")]) == OwnFigures()
    assert own_figures(equations, [effort(r, 9.0)]) == OwnFigures()
    assert own_figures(equations, []) == OwnFigures()


def test_a_component_follows_by_one_sum(r: da.Result, equations: SheetEquations) -> None:
    """Along y on the coupler; along x it is as it was."""
    x, y = r.reaction("B", on="coupler")[0] - OFF
    parts = [
        figure(r, da.Answer(quantity="reaction", of="B", on="coupler", component=c, value=f"{float(v)!r} N"))
        for c, v in (("x", x), ("y", y))
    ]
    a = force(r, "A", "coupler", OFF)
    found = own_figures(equations, [parts[1], a, parts[0]])
    words = {0: "sum of forces along y on coupler", 2: "sum of forces along x on coupler"}
    assert {k: how for k, how in found.follows.items() if k != 1}.items() <= words.items()
    assert set(found.follows) | set(found.first) == {0, 1, 2}
    size = {"component": "magnitude", "value": f"{float(np.hypot(x, y))!r} N"}
    sizes = figure(r, da.Answer(quantity="reaction", of="B", on="coupler", **size))
    assert own_figures(equations, [sizes, a]).follows == {0: "sums of forces on coupler"}
