"""The solution by steps: every number of every bundled file beside the answer, and what the reader chooses."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import actions
from dalembert.analysis.methods.solved.closed_motion import ClosedMotion
from dalembert.analysis.methods.solved.solution_by_steps import PaperSolution
from dalembert.analysis.result.reaction_components import components, remainder
from dalembert.bundled import cases, examples
from dalembert.errors import FORCED, ModelError
from tests.tiers import tiers

FILES = {**examples(), **cases()}
SAME = 1e-9
"""Largest difference between a step and the answer, over the largest force."""


@cache
def solved(name: str) -> PaperSolution | None:
    """The first solved position of a bundled file, step by step."""
    r = da.solve(da.load(FILES[name]))
    k = next((n for n, status in enumerate(r.status) if status in FORCED), None)
    return None if k is None else r.steps(k + 1)


@pytest.mark.parametrize("part", tiers([0], range(1, 6)))
def test_every_number_of_every_bundled_file_is_the_answers(part: int) -> None:
    """A sixth of the files."""
    compared = 0
    for name in list(FILES)[part::6]:
        s = solved(name)
        if s is None:
            continue
        e = s.forces.equations
        scale = max(float(np.nanmax(np.abs(s.result.force_array), initial=0.0)), 1e-300)
        length = e.length
        for step in s.steps:
            for found, right in zip(step.finds, step.right, strict=True):
                size = scale * (length if found.turning else 1.0)
                assert abs(found.value - right) <= SAME * max(size, abs(right)), (name, step.number)
                compared += 1
            left = abs(sum(t.value for t in step.terms))
            assert left <= SAME * max((abs(t.value) for t in step.terms), default=1.0), (name, step.number)
        for effort in (u for u in e.unknowns if u.kind == "effort"):
            assert any(u.name == effort.name for step in s.steps for u in step.unknowns), name
    assert compared > 120


@pytest.mark.long
def test_most_plane_files_need_one_unknown_at_a_time() -> None:
    plane, single, others = 0, 0, []
    for name in FILES:
        s = solved(name)
        if s is None or s.mechanism.dimension == 3 or s.result.friction is not None:
            continue
        if s.result.compiled.forcing.separation.any():
            continue
        plane += 1
        single += s.forces.single
        others += [] if s.forces.single else [name]
    assert plane >= 85
    assert (single >= 83, others) == (True, ["truss", "vw-07-lazy-tongs-between-two-hinges"])


@pytest.mark.long
def test_friction_teeth_and_space_too() -> None:
    rough = [
        s for n in FILES if (s := solved(n)) and (s.result.friction is not None or s.mechanism.dimension == 3)
    ]
    assert len(rough) >= 38
    together = [s.mechanism for s in rough if not s.forces.single]
    braked = {m.title for m in together if any(j.BRAKES for j in m.joints.values())}
    assert {m.title for m in together} - braked <= {"Hexapod, six legs between a base and a platform"}


def test_the_four_bar_is_solved_as_in_the_notes() -> None:
    s = solved("four_bar")
    assert s is not None
    order = [
        (step.links[0], step.equation.kind, step.equation.name, step.unknowns[0].name) for step in s.steps[:5]
    ]
    assert order == [
        ("rocker", "moments", "O4", "B"),
        ("coupler", "moments", "A", "B"),
        ("coupler", "forces", "x", "A"),
        ("coupler", "forces", "y", "A"),
        ("crank", "moments", "O2", "O2"),
    ]
    assert s.steps[-1].kind == "check"
    text = str(s)
    assert "F_43n · 14.90 − 80.00 · 10.41" in text
    assert "F_43 = √(F_43t^2 + F_43n^2) = 87.41 lbf ∠ 90.86 °" in text


def test_the_reader_chooses() -> None:
    r = da.dynamics(da.load(FILES["four_bar"]))
    begun = r.steps(begin="coupler").steps
    assert [step.links for step in begun[:3]] == [("coupler",), ("coupler",), ("rocker",)]
    turned = r.steps(along="30 deg")
    assert "forces along x'" in str(turned)
    assert any(step.equation.name == "A" for step in r.steps(about="A").steps[:2])
    point = r.steps(about=(0.1, 0.2))
    for chosen in (turned, point):
        assert max(step.gap for step in chosen.steps) < 1e-9 * 1000
    with pytest.raises(ModelError, match="unknown link 'couplr' to begin with"):
        r.steps(begin="couplr")
    with pytest.raises(ModelError, match="a point to take moments about has 2 coordinates, not 3"):
        r.steps(about=(0.0, 0.0, 0.0))


def test_what_equilibrium_does_not_settle_is_said() -> None:
    """A beam on two fixed pins: what is across it follows, what is along it does not."""
    beam = {
        "links": {
            "ground": {"points": {"A": [0, 0], "B": [2, 0]}},
            "beam": {"points": {"A": [0, 0], "B": [2, 0]}},
        },
        "joints": {n: {"type": "pin", "links": ["ground", "beam"]} for n in "AB"},
        "loads": {"F": {"type": "force", "on": "beam", "at": [0.5, 0], "value": "100 @ 250 deg"}},
    }
    s = da.statics(da.mechanism(beam)).steps()
    across = 100 * np.sin(np.radians(70))
    assert [step.finds[0].value for step in s.steps] == pytest.approx([0.75 * across, 0.25 * across])
    assert [u.name for u in s.forces.open] == ["A", "B"]
    assert (
        "Equilibrium does not determine the forces A, B: they depend on the elasticity of the links."
        in str(s)
    )


def test_it_is_an_answer() -> None:
    s = solved("four_bar")
    assert s is not None
    rows = s.to_dict()["steps"]
    assert rows[0]["force"] == pytest.approx(rows[0]["force computed"], rel=1e-12)
    assert s.to_dict()["single_unknowns"] is True
    assert "<" in s._repr_html_()


@pytest.mark.parametrize("nth", tiers([7], [1]))
def test_positions_and_rates_in_closed_form_are_the_answers(nth: int) -> None:
    """Each line beside the solver to 1e-8; of 108 plane files with drives 96 are closed throughout."""
    files, closed, lines = 0, 0, 0
    for name in list(FILES)[::nth]:
        s = solved(name)
        if s is None or s.mechanism.dimension == 3 or not s.mechanism.drives:
            continue
        motion = ClosedMotion(s.result, s.position)
        files, closed = files + 1, closed + (not motion.left)
        for step in motion.steps:
            for line in step.lines:
                assert line.gap <= 1e-8 * max(1.0, abs(line.right)), (name, line.letters)
                lines += 1
    assert files >= 108 // nth
    assert closed >= 96 // nth
    assert lines >= {7: 92, 1: 701}[nth]


def test_the_four_bar_closes_by_the_cosine_law() -> None:
    s = solved("four_bar")
    assert s is not None
    text = str(s)
    assert "(15.00^2 + 17.06^2 − 10.00^2)/(2 · 15.00 · 17.06), ψ = 35.62 °" in text
    assert "87.47 + ω_3 · 14.90 = 0, ω_3 = −5.869 rad/s" in text
    assert "a_A,O4B − (ω_3^2 AB)_O4B + ω_4^2 O4B + (α_3 × AB)_O4B = 0" in text


@pytest.mark.parametrize("direction", [0, 40, 180])
@pytest.mark.parametrize("crank", ["35 deg", "200 deg"])
def test_a_slider_crank_closes_whichever_way_its_guide_is_counted(crank: str, direction: float) -> None:
    """Above and below the line of the guide, and with the piston ahead of the pin on it or behind."""
    m = da.slider_crank().with_values({"drives.O2.position": [crank], "joints.guide.direction": direction})
    steps = ClosedMotion(da.dynamics(m), 0).steps
    lines = {line.letters: line for step in steps for line in step.lines}
    ahead = 's = sqrt("AB"^{2} − h^{2})' in lines
    assert ahead == (direction == 0)
    assert ("theta_{AB} = gamma + beta" if ahead else "theta_{AB} = (gamma + 180°) − beta") in lines
    assert max(abs(line.gap) / max(1.0, abs(line.right)) for line in lines.values()) < 1e-12


SLOTTED = """links:
  ground: {points: {O: [0, 0], C: [0, -0.2], S: [0.05, 0.02]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}}
  arm: {points: {C: [0, 0], A: [0, 0], S: [0.05, 0.02]}}
joints:
  O: {type: pin, links: [ground, crank]}
ENDS
drives: {O: {position: 30, speed: 3 rad/s, acceleration: 4 rad/s^2}}
"""
CARRIED = [
    "  A: {type: slot, links: [arm, crank], at: [S, A], direction: 10}",
    "  C: {type: pin, links: [ground, arm]}",
]
FIXED = ["  S: {type: slot, links: [ground, arm], direction: 10}", "  A: {type: pin, links: [crank, arm]}"]
LED = [
    'd = "CA" = sqrt((x_{A} − x_{C})^{2} + (y_{A} − y_{C})^{2})',
    "tan delta = frac(y_{A} − y_{C}; x_{A} − x_{C})",
    "sin beta = frac(h; d)",
    "theta_{A} = delta − beta",
    "−(v_{A})_{n} + omega_{<2>} s = 0",
    "−(v_{A})_{t} − omega_{<2>} h + v_{A} = 0",
    "−(a_{A})_{n} + 2 omega_{<2>} v_{A} − omega_{<2>}^{2} h + alpha_{<2>} s = 0",
]
GUIDED = [
    'sin beta = frac(h; "AS")',
    "theta_{AS} = gamma + beta",
    's = sqrt("AS"^{2} − h^{2})',
    'v_{A,n} + (omega_{<2>} times "AS")_{n} = 0',
    'v_{S} = v_{A,t} + (omega_{<2>} times "AS")_{t}',
    'a_{A,n} − (omega_{<2>}^{2} "AS")_{n} + (alpha_{<2>} times "AS")_{n} = 0',
    'a_{S} = a_{A,t} − (omega_{<2>}^{2} "AS")_{t} + (alpha_{<2>} times "AS")_{t}',
]


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize(("ends", "words", "letters"), [
    (CARRIED, "<2>, with the line of A, between C and A:", LED),
    (FIXED, "<2> between the pin A and the line of S:", GUIDED),
])  # fmt: skip
def test_a_link_between_a_pin_and_a_slot_is_one_step(
    ends: list[str], words: str, letters: list[str], turned: bool
) -> None:
    """The slot in the link itself, or in another, whichever of its joints comes first in the file."""
    r = da.kinematics(da.loads(SLOTTED.replace("ENDS", "\n".join(ends[::-1] if turned else ends))))
    motion = ClosedMotion(r)
    assert motion.left == []
    assert [step.words for step in motion.steps] == ["<1> is driven at O:", words]
    assert [line.letters for line in motion.steps[1].lines] == letters
    assert max(line.gap for step in motion.steps for line in step.lines) < 1e-12


def test_sets_of_links_are_looked_at_up_to_a_number() -> None:
    s = solved("four_bar")
    assert s is not None
    e, found = s.forces.equations, [(0,), (1,), (2,), (0, 1), (1, 2), (0, 1, 2)]
    assert [list(e.connected(3, limit)) for limit in (2, 3, 4)] == [[], found, found]


SCREW = """space: space
links:
  ground: {points: {S: [0, 0, 0]}}
  nut: {points: {S: [0, 0, 0], P: [0.1, 0.05, 0.2]}, mass: 2}
joints:
  S: {type: screw, links: [ground, nut], axis: [1, 2, 2], lead: LEAD}
drives: {S: {position: 30, freedom: turn}}
loads: {F: {type: force, on: nut, at: P, value: [300, -200, 500]}}
"""


@pytest.mark.parametrize("lead", [0.05, -0.02])
def test_the_unknowns_of_a_screw_make_its_whole_reaction(lead: float) -> None:
    """The couple of its thread goes with the force along it, so that five numbers are all there is."""
    r = da.statics(da.loads(SCREW.replace("LEAD", str(lead))))
    for a in (a for a in actions(r) if a.of == "S" and a.kind == "joint"):
        some = components(r, a, 0, np.eye(3))
        assert [(c.turning, c.axis) for c in some] == [
            (False, "x'"), (False, "y'"), (False, "z'"), (True, "y'"), (True, "z'")
        ]  # fmt: skip
        assert np.abs(np.concatenate(remainder(a, 0, some))).max() < 1e-11
        assert some[0].couple == pytest.approx(-lead / (2 * np.pi) * some[0].force)
        assert np.abs(some[0].couple).max() > 1e-3


@pytest.mark.parametrize("part", [0.5e-10, 2e-10])
def test_a_number_is_nothing_below_a_part_of_the_largest_force(part: float) -> None:
    """Two levers apart, one with a force that is rounding beside the other's: the result keeps its number."""
    pulls = {"F": ("a", 1e6), "G": ("b", 1e6 * part)}
    tree = {
        "links": {
            "ground": {"points": {"O": [0, 0], "Q": [1, 0]}},
            "a": {"points": {"O": [0, 0], "P": [0.4, 0]}},
            "b": {"points": {"Q": [0, 0], "P": [0.4, 0]}},
        },
        "joints": {n: {"type": "pin", "links": ["ground", k]} for n, k in (("O", "a"), ("Q", "b"))},
        "drives": {"O": {"position": 0}, "Q": {"position": 0}},
        "loads": {n: {"type": "force", "on": k, "at": "P", "value": [0, -f]} for n, (k, f) in pulls.items()},
    }
    r = da.statics(da.mechanism(tree))
    s = r.steps(1)
    found = [n for step in s.steps if step.kind == "single" for n in step.finds]
    sizes = sorted(abs(n.value) for n in found if n.mark == "y" and not n.turning)
    assert sizes == pytest.approx([0.0 if part < 1e-10 else 1e6 * part, 1e6], rel=1e-9, abs=0)
    assert r.reaction("Q", on="b")[0, 1] == pytest.approx(1e6 * part, rel=1e-9)
