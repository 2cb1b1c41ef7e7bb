"""The single equations that a sheet is judged by: which there are, that the true forces fulfil them, and what figures
say of their unknowns."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.grading.figure import StudentValue, figure
from dalembert.grading.sheet_equations import SheetEquations


def four_bar() -> da.Mechanism:
    return da.four_bar(positions=1).with_values(
        {"drives.O2": {"position": "50 deg", "speed": 9.0, "acceleration": 4.0}, "loads.torque.value": 7.0}
    )


@pytest.fixture(scope="module")
def solved() -> da.Result:
    return da.dynamics(four_bar())


@pytest.fixture(scope="module")
def equations(solved: da.Result) -> SheetEquations:
    return SheetEquations(solved)


@pytest.fixture(scope="module")
def space() -> da.Result:
    return da.dynamics(da.rssr().with_values({"drives.O.position": "1 rad"}))


def given(r: da.Result, value: Any, **answer: Any) -> StudentValue:
    return figure(r, da.Answer(**answer, value=value))


BODIES = ("crank", "coupler", "rocker", "crank and coupler", "coupler and rocker")
JOINTS = dict(zip(BODIES, ("O2 A", "A B", "B O4", "O2 A B", "A B O4"), strict=True))


def test_there_are_sums_of_one_link_and_of_two_and_the_powers_of_all(equations: SheetEquations) -> None:
    words = [row.words for row in equations.rows]
    for body, joints in JOINTS.items():
        assert {f"sum of forces along {axis} on {body}" for axis in "xy"} <= set(words)
        about = {text for text in words if text.startswith("moments") and text.endswith(f" on {body}")}
        assert about == {f"moments about {joint} on {body}" for joint in joints.split()}
    assert words[-1] == "powers of all links"
    assert len(words) == len(set(words)) == 5 * 2 + 2 * 3 + 3 * 2 + 1


def test_the_true_forces_fulfil_every_equation(equations: SheetEquations) -> None:
    values = [u.value for u in equations.e.unknowns]
    for row in equations.rows:
        some = {n: float(c @ values[n]) for n, c in row.parts.items()}
        assert sum(some.values()) + row.known == pytest.approx(
            0.0, abs=1e-9 * max(map(abs, some.values()))
        ), row.words
        assert row.kind == row.words.split()[0].replace("sum", "forces")


def test_an_equation_has_the_unknowns_that_act_on_its_links_and_not_through_its_point(
    equations: SheetEquations,
) -> None:
    names = {n: name for (_, name), n in equations.index.items()}
    kinds = {n: kind for (kind, _), n in equations.index.items()}
    has = {row.words: {(kinds[n], names[n]) for n in row.parts} for row in equations.rows}
    assert has["sum of forces along x on coupler"] == {("joint", "A"), ("joint", "B")}
    assert has["moments about A on coupler"] == {("joint", "B")}
    assert has["moments about O2 on crank"] == {("joint", "A"), ("effort", "O2")}
    assert has["moments about B on coupler and rocker"] == {("joint", "A"), ("joint", "O4")}
    assert has["powers of all links"] == {("effort", "O2")}
    of_links = {row.words: [equations.e.links[k] for k in row.links] for row in equations.rows}
    assert of_links["sum of forces along y on rocker"] == ["rocker"]
    assert of_links["moments about A on crank and coupler"] == ["crank", "coupler"]
    assert len(of_links["powers of all links"]) == 3


def test_a_sum_of_forces_counts_each_force_of_its_link(equations: SheetEquations, solved: da.Result) -> None:
    """Along y on the coupler: the reactions on it, its weight and its inertia force are nothing together."""
    row = next(row for row in equations.rows if row.words == "sum of forces along y on coupler")
    mass = solved.mechanism.mass("coupler")
    known = -mass * solved.center_acceleration("coupler")[0] + mass * np.array(
        solved.mechanism.gravity_vector
    )
    assert row.known == pytest.approx(known[1])
    assert row.twist[equations.e.links.index("coupler")].tolist() == [0, 1, 0]
    assert np.abs(row.twist).sum() == 1


@pytest.mark.parametrize("on", ["on", "by"])
@pytest.mark.parametrize(
    ("joint", "i", "j"), [("O2", "ground", "crank"), ("A", "crank", "coupler"), ("B", "coupler", "rocker")]
)
def test_a_reaction_is_of_its_joint_with_the_sign_of_the_link_that_it_acts_on(
    on: str, joint: str, i: str, j: str, equations: SheetEquations, solved: da.Result
) -> None:
    for acts_on, other in ((i, j), (j, i)):
        link = acts_on if on == "on" else other
        f = given(solved, ["3 N", "4 N"], quantity="reaction", of=joint, **{on: link})
        found = equations.of(f)
        assert found is not None
        n, rows, part = found
        assert (n, part) == (equations.index["joint", joint], None)
        assert rows @ equations.e.unknowns[n].value == pytest.approx(solved.reaction(joint, on=acts_on)[0])
    plain = equations.of(given(solved, "3 N", quantity="reaction", of=joint, component="y"))
    assert plain is not None
    assert plain[1] @ equations.e.unknowns[n].value == pytest.approx(solved.reaction(joint, on=j)[0])
    assert plain[2] == "y"


def test_what_a_figure_says_of_an_unknown(equations: SheetEquations, solved: da.Result) -> None:
    effort = equations.linear(given(solved, "-3.5 N*m", quantity="effort", of="O2"))
    assert effort is not None
    assert (effort[0], effort[1].tolist(), effort[2].tolist()) == (
        equations.index["effort", "O2"],
        [[1]],
        [-3.5],
    )
    whole = equations.linear(given(solved, ["3 N", "-4 N"], quantity="reaction", of="A"))
    part = equations.linear(given(solved, "-4 N", quantity="reaction", of="A", component="y"))
    first = equations.linear(given(solved, "3 N", quantity="reaction", of="A", component="x"))
    assert whole is not None
    assert part is not None
    assert first is not None
    assert (whole[2].tolist(), part[2].tolist()) == ([3, -4], [-4])
    assert np.array_equal(part[1], whole[1][[1]])
    assert np.array_equal(first[1], whole[1][[0]])
    for answer in (
        {"quantity": "reaction", "of": "A", "component": "magnitude"},
        {"quantity": "reaction", "of": "A", "component": "x", "axes": "link", "on": "crank"},
        {"quantity": "drive", "of": "O2"},
    ):
        assert equations.linear(given(solved, 0.3, **answer)) is None
    assert (
        equations.linear(given(solved, "30 deg", quantity="reaction", of="A", component="direction")) is None
    )


def test_figures_of_one_unknown_are_put_together(equations: SheetEquations, solved: da.Result) -> None:
    x = {"quantity": "reaction", "of": "A", "on": "coupler", "component": "x"}
    y = {"quantity": "reaction", "of": "A", "on": "crank", "component": "y"}
    some = [
        given(solved, "7 N", **x),
        given(solved, "2 N*m", quantity="effort", of="O2"),
        given(solved, "-9 N", **y),
        given(solved, "5 N", quantity="reaction", of="B", component="magnitude"),
    ]
    a = equations.index["joint", "A"]
    both = equations.stated(some, [0, 1, 2, 3])
    assert both.keys() == {a, equations.index["effort", "O2"]}
    force = equations.e.unknowns[a].force
    assert (force @ both[a].value).tolist() == pytest.approx([7, 9])
    assert both[a].through == pytest.approx(np.eye(2))
    assert both[a].figures == (0, 2)
    one = equations.stated(some, [0])
    assert list(one) == [a]
    assert (force @ one[a].value).tolist() == pytest.approx([7, 0])
    assert force @ one[a].through @ np.linalg.pinv(force) == pytest.approx(np.diag([1.0, 0.0]))


def test_the_acceleration_of_a_sheet_changes_what_acts_on_its_link(
    equations: SheetEquations, solved: da.Result
) -> None:
    m = solved.mechanism
    turning, moving = (
        solved.acceleration("rocker")[0] + 5.0,
        solved.center_acceleration("coupler")[0] + [2.0, -3.0],
    )
    some = [
        given(solved, "7 N", quantity="reaction", of="A", component="x"),
        given(solved, f"{float(turning)!r} rad/s^2", quantity="acceleration", of="rocker"),
        given(solved, [f"{float(x)!r} m/s^2" for x in moving], quantity="center_acceleration", of="coupler"),
        given(solved, "3 m/s^2", quantity="center_acceleration", of="coupler", component="x"),
        given(solved, "3 rad/s", quantity="speed", of="coupler"),
    ]
    found = equations.accelerations(some, [0, 1, 2, 3, 4])
    assert found.keys() == {1, 2}
    assert found[1][0] == solved.links.index("rocker")
    assert found[1][1] == pytest.approx(np.array([0, 0, -5.0 * m.inertia("rocker")]))
    force = -m.mass("coupler") * np.array([2.0, -3.0])
    x, y = solved.center("coupler")[0]
    assert found[2][0] == solved.links.index("coupler")
    assert found[2][1] == pytest.approx(np.array([*force, x * force[1] - y * force[0]]))
    assert equations.accelerations(some, [0, 2]).keys() == {2}


def test_without_inertia_and_in_space_accelerations_change_nothing(space: da.Result) -> None:
    still = da.statics(four_bar())
    some = [given(still, "5 rad/s^2", quantity="acceleration", of="rocker")]
    assert SheetEquations(still).accelerations(some, [0]) == {}
    part = ["1 m/s^2", "2 m/s^2", "3 m/s^2"]
    moving = [given(space, part, quantity="center_acceleration", of="rocker")]
    assert SheetEquations(space).accelerations(moving, [0]) == {}


def test_in_space_moments_are_about_axes_through_joints(space: da.Result) -> None:
    q = SheetEquations(space)
    words = [row.words for row in q.rows]
    assert {f"sum of forces along {axis} on rod" for axis in "xyz"} <= set(words)
    assert {f"moments about A (axis {axis}) on crank" for axis in "xyz"} <= set(words)
    for row in q.rows:
        some = [float(c @ q.e.unknowns[n].value) for n, c in row.parts.items()]
        size = max([1e-6, *map(abs, some), abs(row.known)])
        assert sum(some) + row.known == pytest.approx(0.0, abs=1e-8 * size), row.words
