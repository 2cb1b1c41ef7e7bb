"""Mistakes that a four-bar has not: the formulas of a slider-crank, Coriolis in a quick return, machines in space."""

from __future__ import annotations

import math
from itertools import combinations
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.grading.wrong.wrong_problems import WrongProblems


def efforts(r: da.Result, words: str, but: str = " nothing") -> dict[str, list[float]]:
    """Efforts of the mistakes whose sentence has some words and not others; NaN where there is no answer."""
    out: dict[str, list[float]] = {}
    for _, sentence, solution in WrongProblems(r):
        if words in sentence and but not in sentence:
            s = solution()
            out.setdefault(sentence, []).append(math.nan if s is None else float(s.effort(r.drives[0])[0]))
    return out


def slider_crank(turn: float, angle: float, **more: Any) -> da.Mechanism:
    """A crank of 50 mm and a rod of 200 mm before a piston of 2 kg, whose guide is turned by an angle."""
    tree: dict[str, Any] = {
        "gravity": "none",
        "links": {
            "ground": {"points": {"O": [1, 2]}},
            "crank": {"points": {"O": [0, 0], "A": [0.05, 0]}},
            "rod": {"points": {"A": [0, 0], "B": [0.2, 0]}},
            "piston": {"points": {"B": [0, 0]}, "mass": 2},
        },
        "joints": {
            "O": {"type": "pin", "links": ["ground", "crank"]},
            "A": {"type": "pin", "links": ["crank", "rod"]},
            "B": {"type": "pin", "links": ["rod", "piston"]},
            "guide": {
                "type": "slider",
                "links": ["ground", "piston"],
                "at": ["O", "B"],
                "direction": f"{angle!r} rad",
            },
        },
        "drives": {"O": {"position": f"{angle + turn!r} rad", "speed": "30 rad/s"}},
        "assembly": {"rod": f"{angle!r} rad", "piston": "0 rad"},
    }
    return da.mechanism(tree | more)


@pytest.mark.parametrize("angle", [0.0, 2.0])
@pytest.mark.parametrize("turn", [0.5, 1.5, 1.7, 2.8, 4.0, 6.0])
def test_the_formulas_of_the_piston_hold_all_round_the_crank(turn: float, angle: float) -> None:
    """x'' = -r w^2 (cos + cos(2 theta)/n) from the dead centre away from the crank, beyond a right angle too: its
    second part has the same sign at both dead centres."""
    r = da.dynamics(slider_crank(turn, angle))
    along = np.array([math.cos(angle), math.sin(angle)])
    speed = float(r["point.piston.B.velocity"][0] @ along)
    one = -0.05 * 900 * math.cos(turn)
    two = one - 0.05 * 900 * math.cos(2 * turn) / 4
    of_piston = "the acceleration of the mass centre of piston is taken as r w^2"
    assert efforts(r, "r w^2") == {
        f"{of_piston} cos(theta)": [pytest.approx(2 * one * speed / 30)],
        f"{of_piston} (cos(theta) + cos(2 theta)/n)": [pytest.approx(2 * two * speed / 30)],
    }


def test_the_formulas_hold_at_each_of_several_positions() -> None:
    """Every position has its own angle: the efforts of all in one answer are those of each alone."""
    turns = [0.5, 1.7, 4.0]
    m = slider_crank(0.5, 0.0).with_values({"drives.O.position": turns})
    for _, sentence, solution in WrongProblems(da.dynamics(m)):
        if "r w^2" in sentence:
            alone = [efforts(da.dynamics(slider_crank(turn, 0.0)), "r w^2")[sentence][0] for turn in turns]
            assert solution().effort("O") == pytest.approx(alone)
    sliding = da.dynamics(lever(0.4).with_values({"drives.O.position": turns[:2]}))
    (left,) = (solution() for _, sentence, solution in WrongProblems(sliding) if sentence == CORIOLIS)
    alone = [efforts(da.dynamics(lever(turn)), "Coriolis")[CORIOLIS][0] for turn in turns[:2]]
    assert left.effort("O") == pytest.approx(alone)


ROUGH = {"type": "slider", "links": ["ground", "piston"], "at": ["O", "B"], "friction": {"coefficient": 0.1}}


def test_of_a_single_rough_joint_friction_is_said_once() -> None:
    """Left out or in the wrong sense everywhere is the same as in that joint, which is not named beside it."""
    tree = slider_crank(1.0, 0.0).to_tree()
    tree["joints"]["guide"] = ROUGH
    said = efforts(da.dynamics(da.mechanism(tree)), "friction")
    everywhere = {"friction is left out", "all friction acts in the wrong sense, with the motion"}
    assert said.keys() == everywhere
    tree["joints"]["B"]["friction"] = {"coefficient": 0.2, "radius": 0.01}
    both = efforts(da.dynamics(da.mechanism(tree)), "friction")
    alone = {f"the friction of joint {j} {what}" for j in ("B", "guide") for what in (
        "is left out", "acts in the wrong sense, with the motion")}  # fmt: skip
    assert everywhere | alone <= both.keys()


def test_only_a_slider_behind_a_turning_crank_has_formulas() -> None:
    """None of one that stands still, of one that its own guide drives, of a block on a lever, of what has no mass."""
    still = {"drives": {"O": {"position": "1 rad", "acceleration": "5 rad/s^2"}}}
    pushed = {"drives": {"guide": {"position": 0.22, "speed": "1 m/s"}}, "assembly": {"crank": "0.6 rad"}}
    light = slider_crank(0.5, 0.0).with_values({"links.piston.mass": 0.0, "links.rod.mass": 1.0})
    for m in (slider_crank(0.5, 0.0, **still), slider_crank(0.5, 0.0, **pushed), light, lever(0.7)):
        assert efforts(da.dynamics(m), "r w^2") == {}


def test_geometry_misread_in_a_static_problem_is_solved_without_inertia() -> None:
    """A machine with masses that moves, as statics is asked: gravity and loads alone, in the new poses too."""
    m = slider_crank(1.0, 0.0, gravity="standard").with_values({"links.rod.mass": 3.0})
    found = efforts(da.statics(m), "", but="assembly mode")
    for words, values in {
        "the length of crank is doubled: crank for stroke": {"links.crank.points.A": [0.1, 0.0]},
        "the length of rod is ten times too large": {"links.rod.points.B": [2.0, 0.0]},
        "the position of O is misread by 10 deg": {"drives.O.position": 1.0 + math.radians(10)},
    }.items():
        anew = float(da.statics(m.with_values(values)).effort("O")[0])
        assert found[words][0] == pytest.approx(anew, rel=1e-9)
        assert float(da.dynamics(m.with_values(values)).effort("O")[0]) != pytest.approx(anew, rel=0.01)


def lever(turn: float, direction: float = 0.0, pivot: float = -0.2, **more: Any) -> da.Mechanism:
    """A crank of 100 mm whose block slides along a heavy lever, turning about a point of the ground."""
    flat = math.atan2(0.1 * math.sin(turn) - pivot, 0.1 * math.cos(turn)) - direction
    tree: dict[str, Any] = {
        "gravity": "none",
        "links": {
            "ground": {"points": {"O": [0, 0], "C": [0, pivot]}},
            "crank": {"points": {"O": [0, 0], "A": [0.1, 0]}},
            "block": {"points": {"A": [0, 0]}},
            "lever": {"points": {"C": [0, 0]}, "mass": 6, "center": [0.2, 0.03], "inertia": 0.125},
        },
        "joints": {
            "O": {"type": "pin", "links": ["ground", "crank"]},
            "A": {"type": "pin", "links": ["crank", "block"]},
            "slide": {
                "type": "slider",
                "links": ["lever", "block"],
                "at": ["C", "A"],
                "direction": f"{direction!r} rad",
            },
            "C": {"type": "pin", "links": ["ground", "lever"]},
        },
        "drives": {"O": {"position": f"{turn!r} rad", "speed": "4 rad/s"}},
        "assembly": {"lever": f"{flat!r} rad", "block": "0 rad"},
    }
    return da.mechanism(tree | more)


CORIOLIS = "the Coriolis acceleration in slide is left out"


@pytest.mark.parametrize(("direction", "pivot"), [(0.0, -0.2), (math.pi, -0.2), (0.6, 0.25), (0.0, -0.05)])
@pytest.mark.parametrize("turn", [0.4, 2.5, 5.1])
def test_without_coriolis_the_lever_has_another_angular_acceleration(
    turn: float, direction: float, pivot: float
) -> None:
    """q x a = d (d alpha + 2 d' w) at the block, and the moment of inertia about the pivot by virtual work."""
    r = da.dynamics(lever(turn, direction, pivot))
    q = 0.1 * np.array([math.cos(turn), math.sin(turn)]) - [0, pivot]
    v = 0.4 * np.array([-math.sin(turn), math.cos(turn)])
    a = -1.6 * np.array([math.cos(turn), math.sin(turn)])
    d2 = float(q @ q)
    across = np.array([-q[1], q[0]])
    speed, right = float(across @ v) / d2, float(r["angle.lever.acceleration"][0])
    wrong = float(across @ a) / d2
    assert right == pytest.approx(wrong - 2 * speed * float(q @ v) / d2)
    about = 0.125 + 6 * (0.2**2 + 0.03**2)
    assert r.effort("O")[0] == pytest.approx(about * right * speed / 4)
    assert efforts(r, "Coriolis") == {CORIOLIS: [pytest.approx(about * wrong * speed / 4)]}


def test_coriolis_is_forgotten_only_where_there_is_some() -> None:
    """None of a lever at rest, without inertia, or where the block's distance does not change (a circle about it)."""
    assert CORIOLIS in efforts(da.dynamics(lever(1.0)), "Coriolis")
    rest = lever(1.0, drives={"O": {"position": "1 rad", "acceleration": "4 rad/s^2"}})
    top = lever(
        math.pi / 2, drives={"O": {"position": "90 deg", "speed": "4 rad/s", "acceleration": "3 rad/s^2"}}
    )
    light = lever(1.0).with_values({"links.lever.inertia": 0.0, "links.block.mass": 1.0})
    for m in (rest, light):
        assert efforts(da.dynamics(m), "Coriolis") == {}
    r = da.dynamics(top)  # d' is rounding there
    for effort in efforts(r, "Coriolis").values():
        assert effort == pytest.approx([r.effort("O")[0]])


def spatial() -> da.Mechanism:
    """Two cranks of any mass centre and moments of inertia, a slender rod on ball joints, forces and a couple."""
    m = da.rssr()
    tree = m.to_tree()
    rod = {"mass": 0.5, "center": list(m.center("rod")), "inertia": np.asarray(m.inertia("rod")).tolist()}
    tree["links"]["rod"] = {"points": tree["links"]["rod"]["points"]} | rod
    for link, mass, off, moments in (
        ("crank", 0.12, (0.02, 0.01, 0.03), (1e-4, 2e-4, 3e-4)),
        ("rocker", 0.3, (0.25, 0.05, -0.02), (3e-4, 1e-4, 2e-4)),
    ):
        tree["links"][link] = {"points": tree["links"][link]["points"]} | {
            "mass": mass, "center": list(off), "inertia": list(moments)
        }  # fmt: skip
    tree["drives"]["O"] = {"position": "40 deg", "speed": "12 rad/s", "acceleration": "5 rad/s^2"}
    tree["loads"] = {
        "F": {"type": "force", "on": "rod", "at": "B", "value": [3, -20, 7]},
        "Q": {"type": "force", "on": "rocker", "at": "B", "value": [0, 11, 5]},
        "M": {"type": "couple", "on": "crank", "value": [0.1, 0.2, 0.3]},
    }
    return da.mechanism(tree)


def in_space() -> dict[str, list[Any]]:
    """Data of the machine in space with one thing wrong, by sentence."""
    m = spatial()
    force = {"F": np.array([3.0, -20.0, 7.0]), "Q": np.array([0.0, 11.0, 5.0])}
    mass, moving = {"crank": 0.12, "rod": 0.5, "rocker": 0.3}, ("crank", "rod", "rocker")
    out: dict[str, list[Any]] = {}

    def of(words: str, values: dict[str, Any]) -> None:
        out.setdefault(words, []).append(values)

    for words, factor in {
        "is ten times too large": 10.0,
        "is ten times too small": 0.1,
        "has an area with the diameter as radius, or pi d^2": 4.0,
        "has an area too small by 4": 0.25,
        "is too large by 1000": 1e3,
        "is too small by 1000": 1e-3,
    }.items():
        for name, f in force.items():
            of(f"load {name} {words}", {f"loads.{name}.value": (factor * f).tolist()})
        of(f"load M {words}", {"loads.M.value": [0.1 * factor, 0.2 * factor, 0.3 * factor]})
        for link in moving if "ten" in words else ():
            of(f"the mass of {link} {words}", {f"links.{link}.mass": mass[link] * factor})
            moments = (factor * np.asarray(m.inertia(link))).tolist()
            of(f"the moment of inertia of {link} {words}", {f"links.{link}.inertia": moments})
    for name, f in force.items():
        for k, axis in enumerate("xyz"):
            if f[k]:
                value = [0.0 if j == k else x for j, x in enumerate(f.tolist())]
                of(f"the {axis} component of {name} is left out", {f"loads.{name}.value": value})
    both = {"loads.F.value": force["Q"].tolist(), "loads.Q.value": force["F"].tolist()}
    of("loads F and Q are exchanged", both)
    for one, two in combinations(moving, 2):
        exchanged = {f"links.{one}.mass": mass[two], f"links.{two}.mass": mass[one]}
        of(f"the masses of {one} and {two} are exchanged", exchanged)
    for name, on in (("F", "rod"), ("Q", "rocker")):
        for point in [*m.points(on), "center"]:
            if point != "B":
                words = f"the moment arm of {name} is wrong: the load is applied at {point}"
                of(words, {f"loads.{name}.at": point})
        of(f"the direction of {name} is counted in link axes", {f"loads.{name}.axes": "link"})
    for link in moving:
        for point in m.points(link):
            place = [float(x) for x in m.points(link)[point]]
            of(f"the mass centre of {link} is placed at {point}", {f"links.{link}.center": place})
    of("the acceleration of drive O is left out", {"drives.O.acceleration": 0.0})
    of("the acceleration of drive O has the wrong sense", {"drives.O.acceleration": -5.0})
    of("the speed of drive O is left out", {"drives.O.speed": 0.0})
    now = math.radians(40)
    for words, angle in (
        ("counted from the other side: its angle has the wrong sign", -now),
        ("counted from the other dead centre", math.pi - now),
        ("counted from the other dead centre, turned by 180 deg", math.pi + now),
        ("counted from the other axis", math.pi / 2 - now),
        *((f"misread by {x} deg", now + sign * math.radians(x)) for x in (10, 20) for sign in (1, -1)),
    ):
        of(f"the position of O is {words}", {"drives.O.position": angle})
    for link, point in (("crank", "A"), ("ground", "C"), ("rocker", "C"), ("rocker", "B"), ("rod", "A")):
        place = [float(x) for x in m.points(link)[point]]
        for k in range(3):
            if place[k]:
                moved = [0.0 if j == k else x for j, x in enumerate(place)]
                name = point if link == "ground" else f"{point} of {link}"
                of(f"the offset of {name} is left out", {f"links.{link}.points.{point}": moved})
    return out


def parts() -> dict[str, float]:
    """Efforts of mistakes that leave parts of the loads out, by what each link's weight and inertia are alone."""
    m = spatial()
    links = ("crank", "rod", "rocker")
    bare = m.with_values({"gravity": "none"})
    rest = float(da.statics(bare).effort("O")[0])

    def alone(of: da.Mechanism, link: str) -> da.Mechanism:
        return of.with_values(
            {f"links.{k}.{key}": 0 for k in links for key in ("mass", "inertia") if k != link}
        )

    weight = {k: float(da.statics(alone(m, k)).effort("O")[0]) - rest for k in links}
    inertia = {k: float(da.dynamics(alone(bare, k)).effort("O")[0]) - rest for k in links}
    whole = rest + sum(weight.values()) + sum(inertia.values())
    out = {"gravity is left out": whole - sum(weight.values())}
    out["inertia is left out: this is the static answer"] = whole - sum(inertia.values())
    lost = 1 - 1 / 9.80665
    out["masses in kg are mistaken for weights in N: g is missing"] = whole - lost * sum(weight.values())
    for k in links:
        out[f"the inertia of {k} is left out"] = whole - inertia[k]
        out[f"the weight of {k} is left out"] = whole - weight[k]
        out[f"the weight of {k} has the wrong sense"] = whole - 2 * weight[k]
        out[f"only the inertia of {k} is counted"] = whole - sum(inertia.values()) + inertia[k]
    return out


@pytest.mark.long
def test_mistakes_in_space_are_the_machine_with_that_made_by_hand() -> None:
    r = da.dynamics(spatial())
    found, hand = efforts(r, "", but="B of rod"), in_space()  # whose poses are sought for long
    for words, some in hand.items():
        anew = []
        for values in some:
            try:
                anew.append(float(da.dynamics(r.mechanism.with_values(values)).effort("O")[0]))
            except da.ModelError:
                anew.append(math.nan)
        assert found.pop(words) == pytest.approx(anew, rel=1e-7, abs=1e-9, nan_ok=True), words
    for words, effort in parts().items():
        assert found.pop(words) == [pytest.approx(effort, rel=1e-8)], words
    scaled = ("inertia", "moments of inertia", "weight", "g is", "load", "speed")  # as in the plane
    assert [words for words in found if not words.removeprefix("the ").startswith(scaled)] == []
