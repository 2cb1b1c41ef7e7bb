"""Aims of designers, mass, stress, buckling, life and functions: against sizes by hand and the tables."""

from __future__ import annotations

import math
from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.design_numbers import not_compiled
from dalembert.optimization.one_by_one import value_of
from dalembert.optimization.optimizing import problem_of
from tests.random_mechanisms import random_case
from tests.tiers import tiers

DOCS = Path(__file__).parents[2] / "docs"
CANTILEVER = """
gravity: none
parameters: {high: 40 mm, broad: 15 mm}
links:
  ground: {points: {O: [0, 0]}}
  beam:
    points: {O: [0, 0], T: [500 mm, 0]}
    mass: 7850 kg/m^3 * broad * high * 500 mm
    section: {rectangle: [broad, high], elasticity: 210 GPa, yield_stress: 355 MPa}
joints: {O: {type: weld, links: [ground, beam]}}
loads: {F: {type: force, on: beam, at: T, value: [0, -2 kN]}}
"""


def beam_sizes(stress: float, sag: float) -> tuple[float, float]:
    """Least h of a cantilever b = 15 mm by its stress M h/2/I, and by its sag F L^3/(3 E I)."""
    force, length, b, elasticity = 2000.0, 0.5, 0.015, 210e9
    by_sag = (4 * force * length**3 / (elasticity * b * sag)) ** (1 / 3)
    return math.sqrt(6 * force * length / (b * stress)), by_sag


@pytest.mark.parametrize(
    ("stress", "sag"), [(160e6, 4e-3), pytest.param(300e6, 2e-3, marks=pytest.mark.long)]
)
def test_the_lightest_beam_is_that_of_its_formulas(stress: float, sag: float) -> None:
    rules = [f"stress.beam <= {stress} Pa", f"peak deflection.beam <= {sag} m"]
    best = da.optimize(
        da.loads(CANTILEVER), {"high": ("20 mm", "90 mm")}, "mass", rules, starts=2, static=True
    )
    h = max(beam_sizes(stress, sag))
    assert best.feasible
    assert best.values[0] == pytest.approx(h, rel=1e-5)
    assert best.value == pytest.approx(7850 * 0.015 * h * 0.5, rel=1e-5)


def test_the_range_of_a_parameter_bounds_it() -> None:
    text = CANTILEVER.replace("high: 40 mm", "high: {value: 40 mm, range: [30 mm, 90 mm]}")
    best = da.optimize(da.loads(text), {"high": "range"}, "mass", starts=2, static=True)
    assert best.bounds.tolist() == [[0.03, 0.09]]
    assert best.values[0] == pytest.approx(0.03)
    with pytest.raises(da.ModelError, match=r"'broad' states no range; write broad: \[low, high\], or give"):
        da.optimize(da.loads(text), {"broad": "range"}, "mass", starts=2, static=True)


def test_an_aim_and_a_condition_may_be_functions() -> None:
    """A made-up cost with its least in the middle, and a condition that moves it."""

    def cost(r: da.Result) -> float:
        return float((r.mechanism.parameters["high"].value - 0.05) ** 2 + r["mass"][0] * 0)

    def thick(r: da.Result) -> Any:
        return np.full(len(r.status), r.mechanism.parameters["high"].value - 0.06)

    vary = {"high": ("20 mm", "90 mm")}
    free = da.optimize(da.loads(CANTILEVER), vary, cost, starts=2, static=True)
    bound = da.optimize(da.loads(CANTILEVER), vary, cost, [thick], starts=2, static=True)
    assert (free.values[0], bound.values[0]) == pytest.approx((0.05, 0.06), abs=1e-5)
    assert "thick >= 0" in bound.text()
    assert "cost" in bound.text()
    with pytest.raises(da.ModelError, match="cost gives 2 numbers; return one, or 1, one a position"):
        value_of(bound.after, "cost", {"cost": lambda r: [1.0, 2.0]})


@pytest.mark.long
def test_a_front_of_mass_and_sag() -> None:
    vary = {"high": ("30 mm", "90 mm")}
    front = da.pareto(
        da.loads(CANTILEVER), vary, ["mass", "peak deflection.beam"], points=3, starts=2, static=True
    )
    sag = front.values[:, 1]
    h = (4 * 2000 * 0.5**3 / (210e9 * 0.015 * sag)) ** (1 / 3)
    np.testing.assert_allclose(front.values[:, 0], 7850 * 0.015 * 0.5 * h, rtol=1e-4)


def test_the_words_are_the_numbers_of_the_tables() -> None:
    m = da.load(DOCS / "lightest-press.yaml").with_values({"joints.A.bearing": {"rating": "60 kN"}})
    r = da.dynamics(m)
    rod = da.member_forces(r, "rod")
    b = rod.buckling()
    loaded = b.compressions > 0
    np.testing.assert_allclose(r["buckling.rod"][loaded], (b.compressions / b.criticals)[loaded], rtol=1e-12)
    assert (r["buckling.rod"][~loaded] == 0).all()
    np.testing.assert_array_equal(r["stress.rod"], rod.stress().equivalent)
    assert r["life.A"][0] == 3600 * da.bearing(r, "A").hours
    assert r["mass"][0] == pytest.approx(sum(m.mass(n) for n in r.links))
    assert da.compile(m, ["web"], ["mass"])([[0.05]]).value("mass").max() == pytest.approx(
        m.with_values({"web": 0.05}).mass("crank") + m.mass("rod") + 30
    )
    with pytest.raises(da.ModelError, match=r"deflection\.rod is not compiled; use da\.dynamics"):
        da.compile(m, outputs=["deflection.rod"])
    spread = m.with_values({"links.rod.mass_along": "uniform"})
    with pytest.raises(
        da.ModelError, match="forces inside 'rod' are not compiled: the mass of 'rod' lies along it"
    ):
        da.compile(spread, outputs=["stress.rod"])


@pytest.mark.parametrize("seed", tiers([4, 9], range(10, 14), range(14, 60)))
def test_compiled_stress_and_buckling_are_those_of_the_tables(seed: int) -> None:
    """On random mechanisms, at another design than the one that was compiled; which links are compiled is stated."""
    tree = deepcopy(random_case(seed).tree)
    for link in tree["links"].keys() - {"ground"}:
        tree["links"][link]["section"] = {"rectangle": [0.02, 0.03], "elasticity": 2e11, "yield_stress": 3e8}
    m = da.mechanism(tree)
    r = da.dynamics(m)
    names = [f"{w}.{n}" for n in r.links for w in ("stress", "buckling") if not not_compiled(r, w, n)]
    path = "links.{}.section.rectangle.1"
    links = sorted({n.partition(".")[2] for n in names})
    if not (links and r.ok.all()):
        pytest.skip("no link of one member between two joints")
    k = da.compile(m, [path.format(n) for n in links], names)
    b = k([[0.05] * len(links)])
    other = da.dynamics(m.with_values({path.format(n): 0.05 for n in links}))
    for name in names:
        np.testing.assert_allclose(
            b.value(name)[0], other[name], rtol=1e-9, atol=1e-12 * np.abs(other[name]).max() + 1e-15
        )


LOADED = """
gravity: [1, -9.81]
links:
  ground: {points: {O: [0, 0], C: [0.4, 0.02]}}
  crank: {points: {O: [0, 0], A: [0.1, 0.02], M: [0.04, -0.03]}, mass: 2, center: [0.03, 0.01], inertia: 0.02,
          section: &bar {rectangle: [0.02, 0.03], elasticity: 2e11, yield_stress: 3e8}, effective_length: [0.9, 0.6]}
  rod: {points: {A: [0, 0], B: [0.35, 0]}, mass: 1, center: [0.2, 0.02], inertia: 0.01, section: *bar}
  rocker: {points: {B: [0.3, 0.05], C: [0, 0]}, mass: 1.5, center: [0.1, 0], inertia: 0.02, section: *bar,
           effective_length: 0.8}
joints: {O: {type: pin, links: %s}, A: {type: pin, links: %s}, B: {type: pin, links: [rod, rocker]},
         C: {type: pin, links: [rocker, ground]}}
drives: {O: {position: {from: 0, to: 360, count: 12}, speed: 20 rad/s, acceleration: 50 rad/s^2}}
loads:
  F: {type: force, on: crank, at: M, value: [300, -900]}
  M: {type: couple, on: crank, value: 25}
  G: {type: force, on: rod, at: center, value: [-40, 700]}
  N: {type: couple, on: rocker, value: -60}
  H: {type: force, on: rocker, at: B, value: [2000, -5000]}
assembly: {rod: 40, rocker: 90}
"""


@pytest.mark.parametrize("links", [("[ground, crank]", "[rod, crank]"), ("[crank, ground]", "[crank, rod]")])
def test_compiled_stress_of_driven_links_with_loads_is_that_of_the_tables(links: tuple[str, str]) -> None:
    """Whichever way its joints name them; with lengths of buckling that the file gives, in the plane and across."""
    m = da.loads(LOADED % links)
    assert {
        n: not_compiled(da.dynamics(m), "buckling", n) for n in ("crank", "rod", "rocker")
    } == dict.fromkeys(("crank", "rod", "rocker"), "")
    vary = {"links.crank.points.A.1": -0.01, "loads.M.value": -15.0, "links.rod.section.rectangle.0": 0.011}
    names = [f"{word}.{n}" for n in ("crank", "rod", "rocker") for word in ("stress", "buckling")]
    b = da.compile(m, [*vary], names)([[*vary.values()]])
    other = da.dynamics(m.with_values(vary))
    for name in names:
        assert np.ptp(other[name]) > 0.01 * other[name].max()
        assert b.value(name)[0] == pytest.approx(other[name], rel=1e-9, abs=1e-12 * other[name].max())


NOT_COMPILED: dict[str, dict[str, Any]] = {
    "it has friction or a plane that turns": {
        "joints": {"A": {"friction": {"coefficient": 0.1, "radius": 0.01}}}
    },
    "the mass of 'rod' lies along it": {"links": {"rod": {"mass_along": "uniform"}}},
    "it is loaded by 'A' otherwise than by forces at points and couples": {"joints": {"A": {"damping": 0.1}}},
    "it is loaded by 'S' otherwise than by forces at points and couples": {
        "loads": {"S": {"type": "spring", "between": ["ground.O", "rod.B"], "stiffness": 10}}
    },
    "it is loaded by 'T' otherwise than by forces at points and couples": {
        "loads": {"T": {"type": "torsion_spring", "joint": "B", "stiffness": 10}}
    },
    "link 'rod' is not one member between two of its points": {
        "links": {"rod": {"points": {"Q": [0.2, 0.1]}, "members": [["A", "B"], ["A", "Q"]]}}
    },
}
LENGTH = "its effective length may depend on the design, unless the file gives it"


def merged(tree: dict[str, Any], more: dict[str, Any]) -> dict[str, Any]:
    inner = {
        k: merged(tree[k], v)
        for k, v in more.items()
        if isinstance(v, dict) and isinstance(tree.get(k), dict)
    }
    return {**tree, **more, **inner}


@pytest.mark.parametrize("why", NOT_COMPILED)
def test_why_the_forces_inside_a_link_are_not_compiled_is_said(why: str) -> None:
    tree = da.loads(LOADED % ("[ground, crank]", "[rod, crank]")).to_tree()
    r = da.dynamics(da.mechanism(merged(tree, NOT_COMPILED[why])))
    assert (not_compiled(r, "stress", "rod"), not_compiled(r, "buckling", "rod")) == (why, why)
    assert (not_compiled(r, "deflection", "rod"), not_compiled(r, "mass", "rod")) == (
        "deflection is not compiled",
        "",
    )


def test_without_a_given_length_the_buckling_of_a_driven_link_is_not_compiled() -> None:
    text = (LOADED % ("[ground, crank]", "[rod, crank]")).replace(", effective_length: [0.9, 0.6]", "")
    r = da.dynamics(da.loads(text))
    assert [not_compiled(r, "buckling", n) for n in ("crank", "rod", "rocker")] == [
        f"the forces inside 'crank' are not compiled: {LENGTH}",
        "",
        "",
    ]
    assert not_compiled(r, "stress", "crank") == ""
    space = da.dynamics(da.rssr().with_values({"links.rod.section": {"circle": 0.02}}))
    assert not_compiled(space, "stress", "rod") == "the mechanism is in space"


def test_designs_by_compiled_numbers_are_those_one_by_one() -> None:
    """Aims and conditions with stress, buckling and life, of a design and their derivatives by differences."""
    m = da.load(DOCS / "lightest-press.yaml").with_values(
        {"joints.A.bearing": {"rating": "60 kN", "kind": "roller"}}
    )
    vary = {"rod": (0.2, 0.5), "diameter": (0.02, 0.06), "crank": (0.04, 0.08)}
    rules = ["peak stress.rod <= 90 MPa", "buckling.rod <= 1/5", "life.A >= 2000 h"]
    fast, *_ = problem_of(m, vary, "mass", rules, 24, False)
    slow, *_ = problem_of(m, vary, "mass", [*rules, lambda r: 1.0], 24, False)
    assert (fast.one_by_one, slow.one_by_one) == (False, True)
    u = np.array([0.3, 0.6, 0.4])
    a, b = fast.at(u), slow.at(u)
    np.testing.assert_allclose(a.margin, b.margin[:3], rtol=1e-9)
    np.testing.assert_allclose(
        a.margin_slope, b.margin_slope[:3], rtol=1e-4, atol=1e-5 * np.abs(a.margin_slope).max()
    )


def test_a_study_has_a_limit_of_stress() -> None:
    """Of a beam whose load scatters evenly: the yield is the share of loads below the limit."""
    m = da.loads(CANTILEVER)
    s = da.study(
        m, {"loads.F.value.1": "-3 kN..-1 kN in 5"}, ["stress.beam"], designs=5, draw="factorial", static=True
    )
    stress = np.sort(s.run().values("stress.beam"))
    np.testing.assert_allclose(stress, np.linspace(1000, 3000, 5) * 0.5 * 6 / (0.015 * 0.04**2), rtol=1e-9)


@pytest.mark.long
def test_the_lightest_press_is_that_of_equations_by_hand() -> None:
    """The documented press at rest: every condition gives one number, by slider-crank and column formulas."""
    m = da.load(DOCS / "lightest-press.yaml").with_values({"gravity": "none"})
    rules = ["peak stress.rod <= 90 MPa", "peak stress.crank <= 160 MPa", "buckling.rod <= 1/5"]
    rules += ["range(slide.G) >= 100 mm", "transmission.B >= 75 deg"]
    vary = {"crank": (0.04, 0.08), "rod": (0.2, 0.5), "diameter": (0.02, 0.06), "web": (0.02, 0.08)}
    best = da.optimize(m, vary, "mass", rules, starts=2, positions=12, static=True)
    q = np.radians(np.arange(0, 360, 30))
    force = 60e3 * (q > np.radians(270))
    r, rod = 0.05, max(0.2, 0.05 / math.cos(math.radians(75)))
    tilt = np.arcsin(r * np.sin(q) / rod)
    push = force / np.cos(tilt)  # along the rod
    across, along = push * np.sin(q + tilt), push * np.cos(q + tilt)
    yield_stress, elasticity = 355e6, 210e9

    def critical(d: float) -> float:
        euler, area = math.pi**3 * elasticity * d**4 / 64 / rod**2, math.pi * d**2 / 4
        johnson = area * yield_stress * (1 - yield_stress * area / (4 * euler))
        return johnson if euler / area > yield_stress / 2 else euler

    def root(f: Any, low: float, high: float) -> float:
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if f(middle) < 0 else (low, middle)
        return high

    d = root(lambda d: critical(d) - 5 * push.max(), 0.02, 0.06)
    d = max(d, math.sqrt(4 * push.max() / math.pi / 90e6))
    web = root(
        lambda h: 160e6 - (np.abs(along) / (0.04 * h) + 6 * np.abs(across) * r / (0.04 * h**2)).max(),
        0.02,
        0.08,
    )
    np.testing.assert_allclose(best.values, [r, rod, d, web], rtol=2e-4)
    assert best.feasible


@pytest.mark.long
def test_a_front_of_two_functions_is_that_of_the_words_they_stand_for() -> None:
    """A lighter beam sags more, h^3 = 4 F L^3/(E b y); the middle of a front is bounded by the second function."""

    def weight(r: da.Result) -> float:
        return sum(r.mechanism.mass(n) for n in r.links)

    def sag(r: da.Result) -> float:
        return float(r["deflection.beam"].max())

    vary = {"high": ("30 mm", "90 mm")}
    front = da.pareto(da.loads(CANTILEVER), vary, [weight, sag], points=3, starts=1, static=True)
    assert front.aims == ("weight", "sag")
    ends = 4 * 2000 * 0.5**3 / (210e9 * 0.015 * np.array([0.03, 0.09]) ** 3)
    assert front.values[:, 1] == pytest.approx([ends[0], ends.mean(), ends[1]], rel=1e-6)
    h = (4 * 2000 * 0.5**3 / (210e9 * 0.015 * front.values[:, 1])) ** (1 / 3)
    assert front.values[:, 0] == pytest.approx(7850 * 0.015 * 0.5 * h, rel=1e-9)
