"""Superposition sums, virtual work equals the matrix, classes of links, displaced inertia."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.friction.friction_circles import two_pins
from dalembert.analysis.methods.applied_forces import actions, on_link
from dalembert.analysis.methods.members import Share
from dalembert.bundled import cases, examples
from dalembert.views.paper.scene import Text
from tests.random_mechanisms import random_case
from tests.random_space import random_case as random_space_case
from tests.space.test_laws import solved as solved_in_space
from tests.tiers import over, over_seeds

SEEDS = range(100)
CLOSE = 1e-11


def mechanism(seed: int) -> Any:
    return da.mechanism(random_case(seed).tree)


def solved(seed: int) -> Any:
    return da.solve(mechanism(seed))


def published(name: str, **options: Any) -> Any:
    return da.solve(da.load(cases()[name]), **options)


@over_seeds(range(1, 6), SEEDS[6:], block=50)
def test_parts_sum_to_the_whole_and_virtual_work_finds_the_same(seed: int) -> None:
    r = solved(seed)
    good = r.ok
    work = da.virtual_work(r)
    assert (work.gap[good] < CLOSE).all()
    if r.compiled.forcing.separation.any():
        with pytest.raises(da.ModelError, match="superposition is refused"):
            da.superposition(r)
    else:
        parts = da.superposition(r)
        assert (parts.gap[good] < CLOSE).all()
        assert not good.all() or set(parts.sources) >= set(r.mechanism.loads) - set(r.unknown_loads)


@pytest.mark.parametrize("seed", SEEDS[::10])
def test_what_acts_on_a_link_is_in_balance(seed: int) -> None:
    r = solved(seed)
    for link in r.links:
        some = on_link(actions(r), link)
        force = sum(a.force for a in some)
        moment = sum(a.moment(r.center(link)) for a in some)
        largest = max(float(np.nanmax(np.abs(r.force_array), initial=0.0)), 1e-9)
        assert np.nanmax(np.abs(force)) < 1e-9 * largest
        assert np.nanmax(np.abs(moment)) < 1e-8 * largest * r.compiled.layout.length


def test_a_whole_cycle() -> None:
    r = da.solve(da.load(examples()["four_bar"]), positions=72)
    assert (da.superposition(r).gap < CLOSE).all()
    assert (da.virtual_work(r).gap < CLOSE).all()


def test_three_forces_on_a_four_link_book() -> None:
    """Seed 002-3: each force alone, then all (the published figures are graphical)."""
    parts = da.superposition(published("seed-002-3-four-link-three-forces"))
    whole = published("seed-002-3-four-link-three-forces")
    drive = whole.drives[0]
    alone = {s: float(v[0]) for s, v in parts.effort(drive).items()}
    for name, load in (("a", "crank"), ("b", "coupler"), ("c", "rocker")):
        one = published(f"seed-002-3{name}-four-link-force-on-{load}")
        assert math.isclose(one.effort(drive)[0], list(alone.values())["abc".index(name)], rel_tol=1e-9)
    assert math.isclose(sum(alone.values()), whole.effort(drive)[0], rel_tol=1e-12)


def test_a_subcase_is_a_result() -> None:
    r = da.solve(da.load(examples()["four_bar"]))
    part = da.superposition(r).case("T_4")
    assert part.effort("O2")[0] == pytest.approx(-38.0718446 * 0.1129848290276167, rel=1e-8)


def test_members_of_the_loaded_rocker() -> None:
    r = published("seed-000-a-four-bar-loaded-rocker")
    found = da.members(r)
    assert [m.kind for m in found.values()] == ["two-force with couple", "two-force", "three-force"]
    assert found["coupler"].state(0) in ("tension", "compression")
    assert abs(found["coupler"].tension[0]) == pytest.approx(113.530652089 * 4.4482216152605, rel=1e-9)
    order = da.order_of_solution(r)
    assert [step.links for step in order] == [("rocker",), ("crank",)]
    assert order[0].why == "rocker: 3 equations, 3 unknowns in the line of coupler, O4"


def counts(r: Any) -> list[tuple[int, int]]:
    """Equations and unknowns of every step of the order of solution, as its sentence says them."""
    said = [re.findall(r"(\d+) (?:equations|unknowns?)", step.why) for step in da.order_of_solution(r)]
    return [(int(equations), int(unknowns)) for equations, unknowns in said]


@over(5, 200)
def test_every_step_has_as_many_equations_as_unknowns(seed: int) -> None:
    for r in (solved(seed), solved_in_space(random_space_case(seed), inertia=seed % 3 > 0)):
        found = counts(r)
        assert sum(step[0] for step in found) > 0
        if not r.mobility.redundant:
            assert all(equations == unknowns for equations, unknowns in found)


FOOT = """
dalembert: 1
gravity: standard
links:
  ground: {points: {O: [0, 0], S: [0, -1]}}
  arm: {points: {O: [0, 0], A: [1, 0]}, mass: 2, center: [0.5, 0], inertia: 0.1}
  foot: {points: {A: [0, 0], B: [0.5, 0]}}
joints:
  O: {type: pin, links: [ground, arm]}
  A: {type: pin, links: [arm, foot]}
  B: {type: slot, links: [ground, foot], at: [S, B], direction: 0}
drives:
  O: {position: -40 deg, speed: 1 rad/s}
loads:
  nothing: {type: couple, on: foot, value: 0}
assembly: {foot: -30}
"""
TAIL = """
links:
  ground: {points: {O: [0, 0], S: [0, -1]}}
  arm: {points: {O: [0, 0], A: [1, 0]}, mass: 2, center: [0.5, 0], inertia: 0.1}
  rod: {points: {A: [0, 0], B: [3, 0]}}
  block: {points: {B: [0, 0], C: [1, 1]}}
  tip: {points: {C: [0, 0], D: [1, 0]}}
  end: {points: {D: [0, 0]}}
joints:
  O: {type: pin, links: [ground, arm], friction: {radius: 0.05}}
  A: {type: pin, links: [arm, rod], friction: {radius: 0.05}}
  B: {type: pin, links: [rod, block], friction: {radius: 0.05}}
  S: {type: slider, links: [ground, block], at: [S, B], friction: {guide: [0.2, 0.2]}}
  C: {type: weld, links: [block, tip]}
  D: {type: weld, links: [tip, end]}
drives: {O: {position: 40 deg, speed: 1 rad/s}}
gravity: standard
friction: {coefficient: 0.2, enabled: FRICTION}
assembly: {rod: -30}
"""


def test_a_link_without_any_force_is_none_of_two_forces() -> None:
    r = da.solve(da.loads(FOOT))
    found = da.members(r)
    assert found["foot"].kind == "zero-force"
    assert found["foot"].sentence == "foot: zero-force member (nothing in A, B; no couple)"
    assert [step.why for step in da.order_of_solution(r)] == [
        "foot: 3 equations, 3 unknowns in A, B, all zero",
        "arm: 3 equations, 3 unknowns in O, torque O",
    ]
    assert any(note.startswith("Zero-force member.") for note in texts(da.draw.free_body(r, "foot")))
    report = str(da.report(r))
    assert "2 arm: general; 3 foot: zero-force." in report
    assert "Force polygon of link 3" not in report


@pytest.mark.parametrize("friction", ["true", "false"])
def test_a_chain_of_links_without_force(friction: str) -> None:
    """Of pins, a slider and welds; friction circles where nothing acts are no tangents of anything."""
    r = da.solve(da.loads(TAIL.replace("FRICTION", friction)))
    found = da.members(r)
    kinds = {"arm": "general", **dict.fromkeys(("rod", "block", "tip", "end"), "zero-force")}
    assert {link: m.kind for link, m in found.items()} == kinds
    assert found["arm"].circles == (("O",) if friction == "true" else ())
    assert counts(r) == [(3, 3)] * 4
    assert "common tangent" not in str(da.report(r))
    assert two_pins(r, "A") is None
    assert all("tangent" not in note for note in texts(da.draw.mechanism(r)))


def texts(scene: Any) -> list[str]:
    return [item.text for item in scene.items if isinstance(item, Text)]


def test_in_space_a_link_without_any_force() -> None:
    """A link on a turning joint and a ball between planes has six unknowns, all zero."""
    tree = random_space_case(146)
    r = solved_in_space(tree)
    assert "two-force" not in {m.kind for m in da.members(r).values()}
    assert da.members(r)["L2"].kind == "zero-force"


def test_displaced_inertia_book() -> None:
    """Seed 000-B: F = 16 lb, h = 1.8 in."""
    r = published("seed-000-b-crank-inertia-force")
    found = da.displaced_inertia(r, "crank")
    assert np.hypot(*found.force[0]) / 4.4482216152605 == pytest.approx(16.0041450777, rel=1e-9)
    assert found.offset[0] / 0.0254 == pytest.approx(1.7995337995, rel=1e-9)
    arm, force = found.at[0] - found.center[0], found.force[0]
    assert arm[0] * force[1] - arm[1] * force[0] == pytest.approx(found.couple[0], rel=1e-12)


def test_share_of_inertia() -> None:
    r = da.dynamics(da.load(examples()["four_bar"]))
    effort = next(s for s in da.inertia_shares(r) if s.quantity == "effort")
    static = da.statics(da.load(examples()["four_bar"])).effort("O2")[0]
    assert effort.inertia == pytest.approx(abs(r.effort("O2")[0] - static), rel=1e-9)


def test_given_effort_and_unknown_load() -> None:
    r = published("st-03-slider-crank-75-lbft")
    parts = da.superposition(r)
    assert any(s.startswith("effort of") for s in parts.sources)
    assert (parts.gap < CLOSE).all()
    assert (da.virtual_work(r).gap < CLOSE).all()


ROUGH = """
units: {length: m, force: N}
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.3, 0]}}
  rod: {points: {A: [0, 0], B: [1.25, 0]}}
  piston: {points: {B: [0, 0]}}
joints:
  O: {type: pin, links: [ground, crank], friction: {coefficient: 0.4, radius: 0.07}}
  A: {type: pin, links: [crank, rod], friction: {coefficient: 0.4, radius: 0.06}}
  B: {type: pin, links: [rod, piston], friction: {coefficient: 0.4, radius: 0.04}}
  guide: {type: slider, links: [ground, piston], at: [O, B], friction: {coefficient: 0.07}}
drives: {O: {position: 50 deg, speed: 1 rad/s}}
loads: {F: {type: force, on: piston, at: B, value: [-22089, 0]}}
"""


def test_friction_is_refused_by_superposition_checked_by_virtual_work_and_shown_by_itself() -> None:
    r = da.dynamics(da.loads(ROUGH))
    with pytest.raises(da.ModelError, match="superposition is refused: with dry friction"):
        da.superposition(r)
    assert (da.virtual_work(r).gap < 1e-11).all()
    found = da.forces_on(r, "piston")
    assert [a.of for a in found["friction"]] == ["B", "guide"]
    assert found["friction"][1].force[0] == pytest.approx(r.friction_force("guide")[0])
    for link in r.links:
        some = on_link(actions(r), link)
        assert np.abs(sum(a.force for a in some)).max() < 1e-9
        assert np.abs(sum(a.moment(r.center(link)) for a in some)).max() < 1e-9
    assert da.members(r)["rod"].kind == "two-force"


def test_the_share_of_inertia_is_that_of_the_whole() -> None:
    assert Share("A", "reaction", whole=4.0, inertia=1.0).share == 0.25
    assert Share("A", "reaction", whole=0.0, inertia=0.0).share == 0.0
