"""Figures right with the student's own earlier ones: slips carried on by hand, sizes, chance, accelerations."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.grading.figure import figure
from dalembert.grading.marking.key import place
from dalembert.grading.mistakes import SolvedProblem
from dalembert.grading.own_figures import OwnFigures, own_figures
from dalembert.grading.sheet_equations import SheetEquations
from tests.grading.test_explanations import arms

AWAY = (0.7, -0.4)
"""Where the machine stands on the ground."""


def machine(**changes: Any) -> Any:
    m = da.four_bar().with_values({"drives.O2.position": 1.0, "drives.O2.speed": 9.0})
    for point, (x, y) in m.points("ground").items():
        m = m.with_values({f"links.ground.points.{point}": (x + AWAY[0], y + AWAY[1])})
    return m.with_values({"links.coupler.center": (0.09, 0.04), **changes})


def scaled(m: Any, size: float) -> Any:
    """A machine in another size, with the same masses, moments of inertia and loads."""
    tree = m.to_tree()

    def length(x: str | float) -> str:
        return f"{float(str(x).removesuffix(' m')) * size!r} m"

    for link in tree["links"].values():
        link["points"] = {name: [length(x) for x in at] for name, at in link["points"].items()}
        link |= {"center": [length(x) for x in link["center"]]} if "center" in link else {}
    return da.mechanism(tree)


def given(r: Any, quantity: str, of: str, value: Any, **more: Any) -> Any:
    said = " rad/s^2" if quantity == "acceleration" else ""
    shown = [f"{float(x):.5g}" for x in value] if np.ndim(value) else f"{float(value):.5g}{said}"
    return figure(r, da.Answer(quantity=quantity, of=of, value=shown, **more))


def cross(a: Any, b: Any) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def carried(r: Any, off: Any) -> dict[str, Any]:
    """The sheet of one who finds the force in A on the crank wrong by ``off`` and carries it on through the crank."""
    arm = r.position("coupler")[0] - r.position("crank")[0]  # both links begin at their first joints
    a = r.reaction("A", on="crank")[0] + off
    return {
        "A": given(r, "reaction", "A", a, on="crank"),
        "O2": given(r, "reaction", "O2", r.reaction("O2", on="crank")[0] - off, on="crank"),
        "T": given(r, "effort", "O2", float(r.effort("O2")[0]) - cross(arm, off)),
        "B": given(r, "reaction", "B", r.reaction("B")[0]),
    }


def judged(r: Any, sheet: dict[str, Any]) -> tuple[dict[str, str], list[str]]:
    names = list(sheet)
    found = own_figures(SheetEquations(r), list(sheet.values()))
    return {names[n]: how for n, how in found.follows.items()}, [names[n] for n in found.first]


@pytest.mark.parametrize("turn", [1.0, 2.2, 4.0, 5.6])
@pytest.mark.parametrize("off", [(40.0, -60.0), (-13.0, 2.0), (0.0, 150.0)])
def test_a_slip_carried_on_is_right_behind_it(off: tuple[float, float], turn: float) -> None:
    r = da.dynamics(machine(**{"drives.O2.position": turn}))
    follows, first = judged(r, carried(r, np.array(off)))
    assert first == ["A"]
    assert follows == {"O2": "sums of forces on crank", "T": "moments about O2 on crank"}


def test_what_is_not_carried_on_does_not_follow() -> None:
    r = da.dynamics(machine())
    sheet = carried(r, np.array([40.0, -60.0]))
    sheet["T"] = given(r, "effort", "O2", 1.03 * float(sheet["T"].given.value))
    follows, _ = judged(r, sheet)
    assert set(follows) == {"O2"}
    right = carried(r, np.zeros(2))
    assert own_figures(SheetEquations(r), list(right.values())) == OwnFigures()


@pytest.mark.parametrize(("part", "follows"), [("x", {"O2"}), ("y", {"O2"})])
def test_components_follow_one_by_one(part: str, follows: set[str]) -> None:
    r = da.dynamics(machine())
    sheet = carried(r, np.array([40.0, -60.0]))
    axis = "xy".index(part)
    sheet = {
        "A": given(r, "reaction", "A", sheet["A"].given.value[axis], on="crank", component=part),
        "O2": given(r, "reaction", "O2", sheet["O2"].given.value[axis], on="crank", component=part),
    }
    assert set(judged(r, sheet)[0]) == follows


def test_sizes_alone_need_one_violated_equation() -> None:
    """The sum along x of the coupler 60 N out: only sizes are stated, none but one slip gives them all."""
    r = da.dynamics(machine())
    off = np.array([60.0, 0.0])
    arm = r.position("coupler")[0] - r.position("crank")[0]
    sizes = {"A": r.reaction("A", on="crank")[0] + off, "O2": r.reaction("O2", on="crank")[0] - off}
    sheet = {
        n: given(r, "reaction", n, np.hypot(*v), on="crank", component="magnitude") for n, v in sizes.items()
    }
    sheet["T"] = given(r, "effort", "O2", float(r.effort("O2")[0]) - cross(arm, off))
    sheet["B"] = given(r, "reaction", "B", np.hypot(*r.reaction("B")[0]), component="magnitude")
    found = own_figures(SheetEquations(r), list(sheet.values()))
    assert found.slip in ("sum of forces along x on coupler", "sum of forces along x on crank")
    assert len(found.follows) == 2


@pytest.mark.parametrize("off", [(60.0, 0.0), (-60.0, 0.0), (0.0, 45.0), (0.0, -45.0)])
@pytest.mark.parametrize("part", ["x", "y", "magnitude", "direction", "effort"])
def test_one_figure_settles_a_violated_equation(part: str, off: tuple[float, float]) -> None:
    """A sum of the coupler is out: a component along it, a size and the effort say by how much, a direction nothing."""
    r = da.dynamics(machine())
    arm = r.position("coupler")[0] - r.position("crank")[0]
    a, o = r.reaction("A", on="crank")[0] + off, r.reaction("O2", on="crank")[0] - off
    of_a = {"x": a[0], "y": a[1], "magnitude": np.hypot(*a), "direction": np.degrees(np.arctan2(a[1], a[0]))}
    sheet = [
        given(r, "effort", "O2", float(r.effort("O2")[0]) - cross(arm, off)),
        given(r, "reaction", "O2", np.hypot(*o), on="crank", component="magnitude"),
        given(r, "reaction", "B", np.hypot(*r.reaction("B")[0]), component="magnitude"),
    ]
    if part == "effort":
        sheet.append(given(r, "reaction", "A", np.hypot(*a), on="crank", component="magnitude"))
    else:
        sheet.insert(0, given(r, "reaction", "A", of_a[part], on="crank", component=part))
    wrong = [n for n, f in enumerate(sheet) if not f.met]
    found = own_figures(SheetEquations(r), sheet)
    link = "crank" if part in ("x", "y") and 0 not in wrong else "coupler"
    words = f"sum of forces along {'x' if off[0] else 'y'} on {link}"
    if part == "direction":
        assert (found.slip, found.follows) == ("", {})
    else:
        (first,) = found.first
        assert (found.slip, {first, *found.follows}) == (words, set(wrong))
        assert set(found.follows.values()) == {f"equations, all but one slip in the {words}"}
        assert found.numbers == {first: 1}


def test_own_accelerations_move_the_inertia() -> None:
    r = da.dynamics(machine())
    m, change = r.mechanism, 400.0
    share = float(r.speed("rocker")[0] / r.speed("crank")[0])
    sheet = {
        "alpha": given(r, "acceleration", "rocker", float(r.acceleration("rocker")[0]) + change),
        "T": given(r, "effort", "O2", float(r.effort("O2")[0]) + m.inertia("rocker") * change * share),
    }
    assert judged(r, sheet) == ({"T": "powers of all links"}, ["alpha"])


@pytest.mark.parametrize("link", ["crank", "coupler", "rocker"])
def test_own_accelerations_of_a_mass_centre_move_its_inertia_force(link: str) -> None:
    """By the powers of all links: the effort takes the mass times the change, times its velocity at unit speed."""
    r = da.dynamics(machine())
    change = np.array([35.0, -20.0])
    velocity = r.center_velocity(link)[0] / r.speed("crank")[0]
    own = [f"{x:.6g} m/s^2" for x in r.center_acceleration(link)[0] + change]
    sheet = {
        "a": figure(r, da.Answer(quantity="center_acceleration", of=link, value=own)),
        "T": given(r, "effort", "O2", float(r.effort("O2")[0]) + r.mechanism.mass(link) * change @ velocity),
    }
    assert judged(r, sheet) == ({"T": "powers of all links"}, ["a"])


def test_own_accelerations_move_the_moments_about_a_joint() -> None:
    """The crank turned by its torque alone: moments about its bearing of its own inertia force at its centre."""
    r = da.dynamics(machine(**{"links.crank.center": (0.02, 0.015)}))
    change = np.array([90.0, 50.0])
    arm = r.center("crank")[0] - r.position("crank")[0]
    own = [f"{x:.6g} m/s^2" for x in r.center_acceleration("crank")[0] + change]
    torque = float(r.effort("O2")[0]) + r.mechanism.mass("crank") * cross(arm, change)
    sheet = {
        "a": figure(r, da.Answer(quantity="center_acceleration", of="crank", value=own)),
        "A": given(r, "reaction", "A", r.reaction("A", on="crank")[0], on="crank"),
        "T": given(r, "effort", "O2", torque),
    }
    assert judged(r, sheet) == ({"T": "moments about O2 on crank"}, ["a"])


def test_friction_teeth_and_space_have_own_figures_too() -> None:
    """The bearing of a crank from a wrong pin force by the sums of the crank."""
    for name, joint, bearing in (
        ("engine", "A", "O2"),
        ("gear_train", "sun_mesh", "sun_bearing"),
        ("rssr", "A", "O"),
    ):
        r = da.solve(da.load(examples()[name]))
        k = r.mechanism.joints[bearing].links[1] if bearing in r.mechanism.joints else ""
        if not k or k not in r.mechanism.joints[joint].links:
            continue
        off = 0.3 * r.reaction(joint, on=k)[0]
        sheet = {
            "pin": given(r, "reaction", joint, r.reaction(joint, on=k)[0] + off, on=k, at=1),
            "bearing": given(r, "reaction", bearing, r.reaction(bearing, on=k)[0] - off, on=k, at=1),
        }
        assert set(judged(r, sheet)[0]) == {"bearing"}, name
    rough = da.solve(da.load(cases()["seed-002-7g-engine-guide-100-mm"]))
    force = rough.reaction("A", on="crank")[0]
    sheet = {
        "A": given(rough, "reaction", "A", 1.2 * force, on="crank"),
        "T": given(rough, "effort", "O", 1.2 * float(rough.effort("O")[0])),
    }
    assert judged(rough, sheet) == ({"T": "moments about O on crank"}, ["A"])


@pytest.mark.long
def test_figures_that_are_all_wrong_rarely_follow_by_chance() -> None:
    """100 sheets of random numbers near the right ones, 5 figures each: at most 2 in 100 figures follow."""
    r, rng, found = da.dynamics(machine()), np.random.default_rng(5), 0
    equations = SheetEquations(r)
    for _ in range(100):
        sheet = [
            given(r, "reaction", j, r.reaction(j)[0] * (1 + 0.3 * rng.normal(size=2)))
            for j in ("A", "B", "O2", "O4")
        ]
        sheet.append(given(r, "effort", "O2", float(r.effort("O2")[0]) * (1 + 0.3 * rng.normal())))
        found += len(own_figures(equations, sheet).follows)
    assert found <= 10


def test_it_is_said_where_to_look_first() -> None:
    r = da.dynamics(machine())
    sheet = carried(r, np.array([40.0, -60.0]))
    verdicts = SolvedProblem(r.mechanism).verdicts([f.answer for f in sheet.values()])
    assert verdicts[0].kind == "unknown"
    assert verdicts[0].mistake == ("look here first: right with it are reaction of O2 on crank, effort of O2")
    assert verdicts[1].mistake == "right with your own figures, by the sums of forces on crank"
    assert [v.kind for v in verdicts[1:]] == ["follow_through", "follow_through", "right"]


def test_nothing_follows_where_a_position_has_no_single_number() -> None:
    """At rest every effort of an interval is right: there is no equation that one figure leaves to another."""
    problem = SolvedProblem(da.load(cases()["seed-002-7d-engine-at-rest"]))
    wrong = da.Answer(quantity="effort", of="O", value="-9000 N*m")
    force = da.Answer(quantity="reaction", of="A", value="1000 N @ 3 deg", on="crank")
    some = [problem.compare(one) for one in (wrong, force)]
    assert all(f.judged and not f.met for f in some)
    assert problem.own_figures(some) == OwnFigures()


def test_positions_of_a_sheet_are_solved_once_in_whatever_order_they_are_asked() -> None:
    problem = SolvedProblem(da.slider_crank(speed=9.0, positions=12))
    answers = [da.Answer(quantity="effort", of="O2", value="3 N*m", at=at) for at in (1, 9, 1)]
    one, other, _ = figures = [problem.compare(a) for a in answers]
    assert [f.position for f in figures] == [0, 8, 0]
    made = problem.wrong_problems([one, other])
    assert made.which.tolist() == [0, 8]
    assert problem.wrong_problems([other, one, other]) is made
    assert problem.wrong_problems([other]).which.tolist() == [8]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("3", 3),
        ("12345678", 12345678),
        ("123456789", "123456789"),
        ("60 deg", "60 deg"),
        ("", ""),
        (None, None),
        ("²", "²"),
    ],
)
def test_a_place_is_a_number_or_a_drives_value(text: str | None, found: object) -> None:
    assert place(text) == found
    assert type(place(text)) is type(found)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize(
    ("along", "off", "numbers"),
    [
        (300.0, 0.0, 1),  # its moment about O4 is right: only its part along the rocker is wrong
        (-300.0, 0.0, 1),
        (3000.0, 0.002, 1),  # beside the products of its components the rest is rounding
        (300.0, 0.05, 2),
        (-300.0, 0.05, 2),
        (300.0, -0.05, 2),
    ],
)
def test_of_a_force_two_numbers_are_wrong_or_one(along: float, off: float, numbers: int, sense: int) -> None:
    r = da.dynamics(machine(**{"loads.torque.value": 7.0 * sense, "drives.O2.position": 2.5}))
    arm = (r["point.rocker.B"] - r["point.rocker.O4"])[0]
    arm /= np.hypot(*arm)
    share = off * abs(along) * 2 * abs(arm[0] * arm[1])
    force = r.reaction("B", on="rocker")[0] + along * arm + share * np.array([-arm[1], arm[0]])
    sheet = [given(r, "reaction", "B", force, on="rocker"), given(r, "effort", "O2", r.effort("O2")[0])]
    assert own_figures(SheetEquations(r), sheet).numbers == {0: numbers}


@pytest.mark.parametrize("sense", [1, -1])
def test_a_number_is_as_right_as_the_loads_that_it_is_the_rest_of(sense: int) -> None:
    """A couple of 1000 N*m on the crank, held by an effort rounded to 1 N*m; the pin's force has 4 parts in 1000."""
    tree = machine().to_tree()
    tree["loads"]["brake"] = {"type": "couple", "on": "crank", "value": f"{1000 * sense} N*m"}
    r = da.statics(da.mechanism(tree))
    arm = (r["point.crank.A"] - r["point.crank.O2"])[0]
    along = 40 * arm / np.hypot(*arm)
    effort = float(r.effort("O2")[0])
    for rest, numbers in ((3.0, 1), (-3.0, 1), (5.0, 2), (-5.0, 2)):
        across = np.array([-arm[1], arm[0]]) * rest / (arm @ arm)
        sheet = [
            given(r, "reaction", "A", r.reaction("A", on="crank")[0] + along + across, on="crank"),
            given(r, "effort", "O2", effort),
        ]
        assert own_figures(SheetEquations(r), sheet).numbers == {0: numbers}


def test_what_follows_from_right_figures_is_not_carried_on() -> None:
    """A force 0.45 % off is right; the torque by it is 1 % off, which is nearly right and no mistake of before."""
    r = da.dynamics(machine())
    arm, force = r.position("coupler")[0] - r.position("crank")[0], r.reaction("A", on="crank")[0]
    across = np.array([-arm[1], arm[0]]) / np.hypot(*arm)
    off = 0.0045 * np.hypot(*force) * across
    torque = float(r.effort("O2")[0])
    sheet = {
        "A": given(r, "reaction", "A", force + off, on="crank"),
        "T": given(r, "effort", "O2", torque - cross(arm, off)),
    }
    assert (sheet["A"].met, sheet["T"].met) == (True, False)
    assert judged(r, sheet) == ({}, [])


@pytest.mark.parametrize(("size", "turn"), [(1.0, 1.0), (1e-4, 1.0), (1.0, 1.5)])
def test_a_component_follows_from_no_equation_that_has_the_other_one(size: float, turn: float) -> None:
    """The moments about O2 join torque and x component where y is on the sheet, and not as if y were nothing: in a
    machine of any size, and where y has hardly an arm."""
    r = da.dynamics(scaled(machine(**{"drives.O2.position": turn}), size))
    arm, force = r.position("coupler")[0] - r.position("crank")[0], r.reaction("A", on="crank")[0]
    right = float(r.effort("O2")[0])
    rest = -(right + cross(arm, force))  # what acts on the crank besides
    wrong = 1.5 * right
    for y, follows in ((0.0, {}), (force[1], {"T": "moments about O2 on crank"})):
        x = (wrong + rest + arm[0] * y) / arm[1]
        sheet = {
            "T": given(r, "effort", "O2", wrong),
            "x": given(r, "reaction", "A", x, on="crank", component="x"),
        }
        if follows:
            sheet["y"] = given(r, "reaction", "A", y, on="crank", component="y")
        assert judged(r, sheet)[0] == follows
    sheet = {
        "y": given(r, "reaction", "A", force[1] + 40.0, on="crank", component="y"),
        "nothing": given(r, "reaction", "O2", 0.0, on="crank", component="x"),
    }
    assert judged(r, sheet) == ({}, [])  # the sum along y has no x component


@pytest.mark.parametrize("on", ["piston", "ground"])
@pytest.mark.parametrize("off", [250.0, -250.0])
@pytest.mark.parametrize("links", [["ground", "piston"], ["piston", "ground"]])
def test_the_force_of_a_guide_follows_whichever_sense_its_normal_has(
    off: float, on: str, links: list[str]
) -> None:
    """The pin's component across the guide is wrong by as much on the piston as the guide's force."""
    tree = da.slider_crank().with_values({"drives.O2.position": 1.0}).to_tree()
    tree["joints"]["guide"] |= {"links": links, "at": ["C" if link == "ground" else "B" for link in links]}
    m = da.mechanism(tree)
    r = da.dynamics(m)
    pin = r.reaction("B", on="piston")[0] + [0.0, off]
    guide = r.reaction("guide", on="piston")[0] - [0.0, off]
    sheet = {
        "B": given(r, "reaction", "B", pin, on="piston"),
        "guide": given(r, "reaction", "guide", guide if on == "piston" else -guide, on=on),
    }
    assert judged(r, sheet) == ({"guide": "sum of forces along y on piston"}, ["B"])


def test_a_force_follows_from_the_moments_of_two_links_that_have_no_other_unknown() -> None:
    """B from moments about A on the coupler and about O4 on the rocker: the student's angular acceleration of the
    rocker changes the second sum by I and what the sheet says of no other force."""
    r = da.dynamics(machine())
    own = float(r.acceleration("rocker")[0]) + 400.0
    arms = [r["point.coupler.B"][0] - r[f"point.{at}"][0] for at in ("coupler.A", "rocker.O4")]
    across = np.array([[-arm[1], arm[0]] for arm in arms])  # moment of a force at B
    change = np.linalg.solve(across, [0.0, r.mechanism.inertia("rocker") * 400.0])
    sheet = {
        "alpha": given(r, "acceleration", "rocker", own),
        "B": given(r, "reaction", "B", r.reaction("B", on="rocker")[0] + change, on="rocker"),
    }
    words = "moments about A on coupler, moments about O4 on rocker"
    assert judged(r, sheet) == ({"B": words}, ["alpha"])
    sheet["B"] = given(r, "reaction", "B", r.reaction("B", on="rocker")[0] - change, on="rocker")
    assert judged(r, sheet)[0] == {}


@pytest.mark.parametrize(("lean", "follows"), [(0.0505, True), (0.0495, False)])
def test_two_moments_settle_no_force_where_their_arms_are_nearly_in_line(lean: float, follows: bool) -> None:
    """Coupler and rocker lie in line but for an angle whose sine is just above 0.05, or just below."""
    arm = np.array([-0.2 * np.cos(lean), 0.2 * np.sin(lean)])  # of B about C
    moving = {"center": [0.1, 0.02], "mass": 1, "inertia": 0.02}
    tree = {
        "gravity": "none",
        "links": {
            "ground": {"points": {"O": [0, 0], "C": (np.array([0.3, 0.1]) - arm).tolist()}},
            "crank": {"points": {"O": [0, 0], "A": [0, 0.1]}},
            "rod": {"points": {"A": [0, 0], "B": [0.3, 0]}, **moving},
            "rocker": {"points": {"C": [0, 0], "B": arm.tolist()}, **moving},
        },
        "joints": {
            "O": {"type": "pin", "links": ["ground", "crank"]},
            "A": {"type": "pin", "links": ["crank", "rod"]},
            "B": {"type": "pin", "links": ["rod", "rocker"]},
            "C": {"type": "pin", "links": ["ground", "rocker"]},
        },
        "drives": {"O": {"position": "0 rad", "speed": "3 rad/s"}},
        "assembly": {"rod": "0 rad", "rocker": "0 rad"},
    }
    r = da.dynamics(da.mechanism(tree))
    change = np.linalg.solve([[0.0, 0.3], [-arm[1], arm[0]]], [0.0, 0.02 * 5000.0])
    sheet = {
        "alpha": given(r, "acceleration", "rocker", float(r.acceleration("rocker")[0]) + 5000.0),
        "B": given(r, "reaction", "B", r.reaction("B", on="rocker")[0] + change, on="rocker"),
    }
    assert ("B" in judged(r, sheet)[0]) is follows


@pytest.mark.parametrize("again", ["x", "y", "xx", "xy", "coupler", "coupler x"])
def test_a_force_that_is_stated_twice_is_one_force(again: str) -> None:
    """Whole, by components, and on the other link: what follows from it still does."""
    r = da.dynamics(machine())
    sheet = carried(r, np.array([40.0, -60.0]))
    force = sheet["A"].given.value
    if again.startswith("coupler"):
        sheet["A on the other"] = given(r, "reaction", "A", -force, on="coupler")
    for k, part in enumerate(again.removeprefix("coupler").strip()):
        component = force["xy".index(part)]
        sheet[f"A again {k}"] = given(r, "reaction", "A", component, on="crank", component=part)
    follows, first = judged(r, sheet)
    assert first == ["A"]
    assert {name: follows[name] for name in ("O2", "T")} == {
        "O2": "sums of forces on crank",
        "T": "moments about O2 on crank",
    }


@pytest.mark.parametrize("off", [-30.0, 30.0])
@pytest.mark.parametrize("on", ["tip", "arm"])
@pytest.mark.parametrize("part", ["magnitude", "x"])
def test_a_violated_sum_along_one_axis_changes_nothing_across(part: str, off: float, on: str) -> None:
    """Two arms welded together: of the sum along x of the tip only sizes are stated, both along x alone wrong, or one
    component, whichever way it is counted."""
    r = da.statics(arms(0.4))
    p, o = r.reaction("P", on=on)[0], r.reaction("O", on="arm")[0]
    sense = 1.0 if on == "tip" else -1.0
    of_p = p[0] + sense * off if part == "x" else np.hypot(p[0] + sense * off, p[1])
    sheet = {
        "P": given(r, "reaction", "P", of_p, on=on, component=part),
        "O": given(r, "reaction", "O", np.hypot(o[0] + off, o[1]), on="arm", component="magnitude"),
    }
    found = own_figures(SheetEquations(r), list(sheet.values()))
    assert found.slip == "sum of forces along x on tip"
    assert found.follows == {1: "equations, all but one slip in the sum of forces along x on tip"}


@pytest.mark.parametrize(("joint", "slip"), [("A", "sum of forces along x on coupler"), ("O2", "")])
def test_a_sum_is_violated_through_a_joint_of_its_link(joint: str, slip: str) -> None:
    """A force on the coupler that no drawing has, through its own pin or through a bearing that is no joint of it."""
    r = da.dynamics(machine())
    where = r.position("crank")[0] if joint == "O2" else r.position("coupler")[0]
    tree = r.mechanism.to_tree()
    turn = float(r.angle("coupler")[0])
    across = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    tree["links"]["coupler"]["points"]["N"] = (across @ (where - r.position("coupler")[0])).tolist()
    tree.setdefault("loads", {})["E"] = {"type": "force", "on": "coupler", "at": "N", "value": [60, 0]}
    other = da.dynamics(da.mechanism(tree))
    effort = given(r, "effort", "O2", float(other.effort("O2")[0]))
    sizes = [
        given(r, "reaction", j, np.hypot(*other.reaction(j)[0]), component="magnitude")
        for j in ("A", "O2", "B", "O4")
    ]
    of_b = given(r, "reaction", "B", other.reaction("B")[0, 0], component="x")
    for sheet in ([effort, *sizes], [of_b, effort, *sizes]):
        assert own_figures(SheetEquations(r), sheet).slip == slip
