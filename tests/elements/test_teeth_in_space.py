"""Teeth in space with friction and losses: worms both ways, wheels as in the plane, bevels, and what bearings feel."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import dalembert as da
from dalembert.reports.working import working
from tests.space.printed import lines

WORM = """space: space
units: {length: mm, moment: N*m}
links:
  ground: {points: {A: [0, 0, 0], B: [0, 125, 0]}}
  worm: {points: {A: [0, 0, 0]}}
  wheel: {points: {B: [0, 0, 0]}}
joints:
  W: {type: revolute, links: [ground, worm], at: A, axis: [0, 0, 1]}
  B: {type: revolute, links: [ground, wheel], axis: [1, 0, 0]}
  G: {type: gear, links: [worm, wheel], at: [A, B], axes: {i: {z: [0, 0, 1]}, j: {z: [1, 0, 0]}}, radii: [25, 100],
      helix_angle: 78, pressure_angle: 20, friction: {coefficient: 0.06}}
drives: {W: {position: 0, speed: 10 rad/s, effort: 20}}
loads: {T: {type: couple, on: wheel, direction: [1, 0, 0], value: unknown}}
"""


def test_a_worm_both_ways() -> None:
    """WOR-11."""
    m = da.loads(WORM)
    r = da.statics(m)
    both = da.efficiency(r)
    assert (both.forward[0], both.reverse[0]) == pytest.approx(
        (0.7585610963535285, 0.6902384011464502), rel=1e-8
    )
    force = np.abs(r.reaction("W", axes="joint")[0])
    assert force == pytest.approx([800.0, 1076.9661806032511, 2854.999499027038], rel=1e-8)

    def pushed(mu: float) -> float:
        """Torque on the worm while the wheel drives."""
        given = {"drives.W": {"position": 0.0, "speed": -10.0}, "joints.G.friction.coefficient": mu}
        return float(da.statics(m.with_values({**given, "loads.T.value": -100.0})).effort("W")[0])

    assert brentq(pushed, 0.1, 0.3, xtol=1e-13) == pytest.approx(0.19973783250094465, rel=1e-8)
    assert math.cos(math.radians(20)) * math.tan(math.radians(12)) == pytest.approx(
        0.19973783250094465, rel=1e-12
    )
    locked = m.with_values({"drives.W": {"position": 0.0, "speed": -10.0}, "loads.T.value": -100.0})
    for mu, word in ((0.199, "ok"), (0.2005, "self_locking")):
        assert da.statics(locked.with_values({"joints.G.friction.coefficient": mu})).status == (word,)


SPUR = WORM.replace("helix_angle: 78", "helix_angle: 0").replace("[1, 0, 0]", "[0, 0, 1]")


@pytest.mark.parametrize(
    ("text", "law"),
    [
        (
            WORM,
            [
                ("S_{G}", "", '3149 "N"'),
                ("|F_{f23}| = mu_{G} S_{G}", "0.06 cdot 3149", '188.9 "N"'),
                ("F_{f23}", "", '(−184.8, 0, 39.28) "N, ground axes"'),
            ],
        ),
        (
            SPUR.replace("friction: {coefficient: 0.06}", "efficiency: 0.9"),
            [
                ("F_{t,G}", "", '760.0 "N, mean of the moments on both wheels over their radii"'),
                (
                    "|M_{f23}| = (1 − eta_{G}) e_{G} F_{t,G}",
                    "0.1 cdot 21.05 cdot 760.0 / 1000",  # 2 N m of the driver's 20 at 10 rad/s of 12.5
                    '1.600 "N·m"',
                ),
                ("M_{f23}", "", '(0, 0, 1.600) "N·m, ground axes"'),
            ],
        ),
    ],
)
def test_the_lines_of_the_friction_of_teeth(text: str, law: list[tuple[str, str, str]]) -> None:
    every = [(w.letters, w.numbers, w.result) for w in lines(working(da.statics(da.loads(text))))]
    first = every.index(law[0])
    assert every[first : first + 3] == law


def test_the_forces_of_a_worm_of_two_starts() -> None:
    """GTR-5, with its radial force."""
    lead = math.degrees(math.atan(0.2))
    text = WORM.replace("helix_angle: 78", f"helix_angle: {90 - lead!r}").replace("0.06", "0.05")
    r = da.statics(da.loads(text))
    force = np.abs(r.reaction("W", axes="joint")[0])
    assert force == pytest.approx([800.0, 1172.7179638769715, 3125.8246190406912], rel=1e-8)
    assert abs(r.unknown_load("T")[0]) == pytest.approx(312.58246190406913, rel=1e-8)
    assert 100 * da.efficiency(r).forward[0] == pytest.approx(78.14561547601728, rel=1e-8)


def test_a_worm_in_machine_code() -> None:
    m = da.loads(WORM)
    k = da.compile(m, vary=["joints.G.friction.coefficient"], derivatives=True, outputs=["load.T"])
    found = k([[0.06], [0.1]])
    for n, mu in enumerate((0.06, 0.1)):
        careful = da.statics(m.with_values({"joints.G.friction.coefficient": mu}), method="careful")
        assert found["load.T"][n, 0] == pytest.approx(careful.unknown_load("T")[0], rel=1e-10)
    h = 1e-5
    up, down = (
        da.statics(m.with_values({"joints.G.friction.coefficient": 0.06 + s})).unknown_load("T")[0]
        for s in (h, -h)
    )
    assert np.ravel(found.gradient("load.T"))[0] == pytest.approx((up - down) / 2 / h, rel=1e-6)


PAIR: dict[str, Any] = {
    "units": {"length": "mm", "moment": "N*m"},
    "links": {
        "ground": {"points": {"A": [0, 0], "B": [60, 0]}},
        "p": {"points": {"A": [0, 0]}},
        "w": {"points": {"B": [0, 0]}},
    },
    "joints": {
        "A": {"type": "pin", "links": ["ground", "p"]},
        "B": {"type": "pin", "links": ["ground", "w"]},
    },
    "drives": {"A": {"position": 0, "speed": "3 rad/s"}},
}


@pytest.mark.parametrize("internal", [False, True])
@pytest.mark.parametrize("load", [-10, 10])
@pytest.mark.parametrize("lost", [{"efficiency": 0.9}, {"friction": {"coefficient": 0.1, "arm": 4}}])
def test_wheels_on_parallel_axes_are_those_of_the_plane(
    internal: bool, load: float, lost: dict[str, Any]
) -> None:
    radii = [20, 80] if internal else [20, 40]
    gear = {
        "type": "gear",
        "links": ["p", "w"],
        "at": ["A", "B"],
        "radii": radii,
        "internal": internal,
        **lost,
    }
    loads = {"T": {"type": "couple", "on": "w", "value": load}}
    flat = da.mechanism({**PAIR, "joints": {**PAIR["joints"], "G": gear}, "loads": loads})
    plane, space = da.statics(flat), da.statics(in_space(gear, loads))
    assert space.effort("A")[0] == pytest.approx(plane.effort("A")[0], rel=1e-10)
    smooth = da.statics(flat.with_values({"friction.enabled": False}))
    assert plane.effort("A")[0] != pytest.approx(smooth.effort("A")[0])
    for joint in ("A", "B"):
        assert space.reaction(joint)[0, :2] == pytest.approx(plane.reaction(joint)[0], rel=1e-9, abs=1e-9)
    assert da.efficiency(space).forward[0] == pytest.approx(da.efficiency(plane).forward[0], rel=1e-9)


def in_space(gear: dict[str, Any], loads: dict[str, Any]) -> da.Mechanism:
    """The pair in space."""
    points = {n: {"points": {p: [*at, 0] for p, at in x["points"].items()}} for n, x in PAIR["links"].items()}
    axis = {"axis": [0, 0, 1]}
    joints = {n: {**j, "type": "revolute", **axis} for n, j in PAIR["joints"].items()}
    made = {n: {**x, "value": [0, 0, x["value"]]} for n, x in loads.items()}
    tree = {
        **PAIR,
        "space": "space",
        "links": points,
        "joints": {**joints, "G": {**gear, **axis}},
        "loads": made,
    }
    return da.mechanism(tree)


@pytest.mark.parametrize("load", [-10.0, 10.0])
def test_a_bevel_pair_has_its_efficiency_both_ways(load: float) -> None:
    eta = 0.93
    tree = {
        "space": "space",
        "units": {"length": "mm", "moment": "N*m"},
        "links": {
            "ground": {"points": {"A": [0, 0, -40], "B": [-20, 0, 0]}},
            "p": {"points": {"A": [0, 0, -40]}},
            "w": {"points": {"B": [-20, 0, 0]}},
        },
        "joints": {
            "A": {"type": "revolute", "links": ["ground", "p"], "axis": [0, 0, 1]},
            "B": {"type": "revolute", "links": ["ground", "w"], "axis": [1, 0, 0]},
            "G": {
                "type": "gear",
                "links": ["p", "w"],
                "at": ["A", "B"],
                "axes": {"i": {"z": [0, 0, 1]}, "j": {"z": [1, 0, 0]}},
                "radii": [20, 40],
                "efficiency": eta,
            },
        },
        "drives": {"A": {"position": 0, "speed": "3 rad/s"}},
        "loads": {"T": {"type": "couple", "on": "w", "value": [load, 0, 0]}},
    }
    r = da.statics(da.mechanism(tree))
    driving = r.effort("A")[0] * 3 > 0
    assert abs(r.effort("A")[0]) == pytest.approx(5 / eta if driving else 5 * eta, rel=1e-9)
    found = r.power_flow()
    assert found.rolling[0] == pytest.approx(max(15.0, abs(r.effort("A")[0] * 3)), rel=1e-9)
    assert found.lost[0] == pytest.approx(abs(abs(r.effort("A")[0] * 3) - 15), rel=1e-9)
    k = da.compile(da.mechanism(tree), vary=["joints.G.efficiency"], outputs=["effort.A"])([[0.93], [0.8]])
    assert np.abs(k["effort.A"][:, 0]) == pytest.approx(
        [5 / e if driving else 5 * e for e in (0.93, 0.8)], rel=1e-9
    )


def test_friction_elsewhere_leaves_bearings_their_separating_force() -> None:
    gear = {"type": "gear", "links": ["p", "w"], "at": ["A", "B"], "radii": [20, 40]}
    m = in_space(gear, {"T": {"type": "couple", "on": "w", "value": -10}})
    rubbed = m.with_values({"joints.A.friction": {"coefficient": 1e-12, "radius": 0.001}})
    assert da.statics(rubbed).reaction("A") == pytest.approx(da.statics(m).reaction("A"), rel=1e-9)
    assert abs(da.statics(m).reaction("A")[0, 0]) > 50


def test_what_teeth_in_space_lack_is_said() -> None:
    with pytest.raises(
        da.ModelError, match="gear 'G': teeth on skew axes slide, and their efficiency follows from it"
    ):
        da.statics(da.loads(WORM.replace("friction: {coefficient: 0.06}", "efficiency: 0.8")))
    gear = {
        "type": "gear",
        "links": ["p", "w"],
        "at": ["A", "B"],
        "radii": [20, 40],
        "friction": {"coefficient": 0.1},
    }
    with pytest.raises(da.ModelError, match="gear 'G': its friction needs the arm of the teeth's contact"):
        da.statics(in_space(gear, {"T": {"type": "couple", "on": "w", "value": -10}}))


def test_a_lifted_pair_keeps_its_efficiency() -> None:
    gear = {"type": "gear", "links": ["p", "w"], "at": ["A", "B"], "radii": [20, 40], "efficiency": 0.9}
    loads = {"T": {"type": "couple", "on": "w", "value": -10}}
    flat = da.mechanism({**PAIR, "joints": {**PAIR["joints"], "G": gear}, "loads": loads})
    assert da.statics(da.lifted(flat)).effort("A") == pytest.approx(da.statics(flat).effort("A"), rel=1e-9)
    assert da.statics(flat).effort("A")[0] == pytest.approx(-5 * 0.9, rel=1e-12)  # the load drives


@pytest.mark.parametrize("lost", [{"efficiency": 0.9}, {"friction": {"coefficient": 0.1, "arm": 4}}])
def test_worked_solutions_have_the_couple_of_lossy_teeth(lost: dict[str, Any]) -> None:
    gear = {"type": "gear", "links": ["p", "w"], "at": ["A", "B"], "radii": [20, 40], **lost}
    r = da.statics(in_space(gear, {"T": {"type": "couple", "on": "w", "value": 10}}))
    couple = float(r.friction_moment("G")[0, 2])
    said = str(da.report(r))
    assert f"M_f23 = (0, 0, {couple:.4f}) N·m" in said
    assert f"= {abs(couple):.4f} N·m" in said


def test_worked_solutions_have_the_friction_of_a_worm() -> None:
    r = da.statics(da.worm_gear())
    force, said = r.friction_force("G")[0], str(da.report(r))
    assert (
        f"|F_f23| = μ_G S_G = 0.05 · {np.linalg.norm(force) / 0.05:.4g} = {np.linalg.norm(force):.4g} N"
        in said
    )
