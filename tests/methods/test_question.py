"""Question figures and data: the same whatever the answer is, with what the problem states."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.cli import main
from dalembert.reports.report_context import METHODS, ReportContext
from dalembert.reports.sections.given import knowns
from dalembert.reports.sheet import ReportSheet
from dalembert.reports.writers.plain_writer import plain_text
from dalembert.views.notation import Shown
from dalembert.views.stated import as_stated, drive_text, stated_lines, vector_text
from tests.tiers import tiers

FRICTION = "seed-002-7a-engine-friction-circles"


def falsified(r: da.Result) -> da.Result:
    """The result with other answers: efforts, unknown loads and reactions changed, in sense too."""
    asked = [r.mechanism.drives[d].effort is None for d in r.drives]
    return replace(
        r,
        effort_array=np.where(asked, 1.0 - 3.0 * r.effort_array, r.effort_array),
        load_array=2.0 - 5.0 * r.load_array,
        force_array=-7.0 * r.force_array,
        moment_array=1.0 - r.moment_array,
    )


def sheet_text(r: da.Result) -> str:
    sheet, notation = ReportSheet("question"), as_stated(None)
    knowns(sheet, ReportContext(r, 0, Shown(r, notation), METHODS, "", notation, question=True))
    return plain_text(sheet)


SHOWN = ("four_bar", "rssr", "balance_position", "two_drives", FRICTION)


@pytest.mark.parametrize("name", tiers(SHOWN, [n for n in examples() if n not in SHOWN]))
def test_a_question_shows_nothing_of_the_answer(name: str) -> None:
    r = da.solve(da.load((examples() | cases())[name]))
    wrong = falsified(r)
    assert da.draw.question(wrong, 1).to_dict() == da.draw.question(r, 1).to_dict()
    assert sheet_text(wrong) == sheet_text(r)


def test_it_states_what_is_given() -> None:
    r = da.dynamics(da.load(examples()["four_bar"]))
    said = [t.text for t in da.draw.question(r).texts()]
    assert {"F_{P} = 80 lbf", "T_{4} = 120 lbf·in", "T_{12}"} <= set(said)
    whole = " ".join(said)
    assert "Drive O2: 60°, 25 rad/s, −40 rad/s²." in whole
    assert "weight 5.8 lbf, centre (5, 0); inertia 0.8" in whole
    assert "F_{P}: 80 lbf ∠ −30° on 3 coupler at P." in whole
    (asked,) = [a for a in da.draw.question(r).flat() if getattr(a, "of", "") == "O2"]
    assert asked.value is None or asked.value == 1.0


def test_equilibria_are_not_drawn_where_they_are() -> None:
    r = da.solve(da.load(examples()["balance_position"]))
    scene = da.draw.question(r)
    assert scene.title == r.mechanism.title
    words = " ".join(t.text for t in scene.texts())
    assert "Not drawn at an equilibrium position" in words
    assert "position unknown, effort 0" in words
    assert not any(f"{np.degrees(x):.1f}"[:4] in words for x in r.drive_position("O"))
    assert scene.to_dict()["items"] != da.draw.mechanism(r).to_dict()["items"]


@pytest.mark.parametrize("name", tiers([], sorted(cases())[::3]))
def test_cases_as_questions(name: str) -> None:
    r = da.solve(da.load(cases()[name]))
    assert da.draw.question(falsified(r)).to_dict() == da.draw.question(r).to_dict()


def test_the_command_refuses_another_view(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = str(examples()["four_bar"])
    out = str(tmp_path / "q.svg")
    assert main(["draw", file, "--question", "-o", out]) == 0
    assert "80 lbf" in Path(out).read_text(encoding="utf-8")
    assert main(["draw", file, "--question", "--view", "motion", "-o", f"{tmp_path}/m.svg"]) == 2
    assert "--question draws the mechanism, and not motion" in capsys.readouterr().err


ROUGH = """
friction: {coefficient: 0.11}
gravity: [0, -9.8]
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}, mass: 1.2, center: [0.05, 0], inertia: 0.01}
  rod: {points: {A: [0, 0], B: [0.3, 0]}}
  block: {points: {B: [0, 0]}, mass: 3}
joints:
  O: {type: pin, links: [ground, crank], friction: {radius: 0.012}}
  A: {type: pin, links: [crank, rod], friction: {radius: 0.017, coefficient: 0.07, static: 0.09}}
  B: {type: pin, links: [rod, block]}
  F:
    {type: slider, links: [ground, block], at: [O, B], direction: 11 deg,
     friction: {coefficient: 0.13, guide: [0.41, 0.33], half_height: 0.026}}
drives: {O: {position: 50 deg, speed: 3.1 rad/s, acceleration: -2 rad/s^2}}
loads:
  P: {type: force, on: block, at: B, value: [-30, -40]}
  M: {type: couple, on: rod, value: -2.5}
  s: {type: spring, between: [crank.A, block.B], stiffness: 410, free_length: 0.173}
  t: {type: torsion_damper, joint: B, damping: 0.4}
assembly: {rod: -30}
"""


def test_a_question_states_every_number_that_is_given() -> None:
    """A line a part; friction as it was given, and only where it is on."""
    m = da.loads(ROUGH)
    joints = [
        "Joint O: pin; μ = 0.11, R = 0.012 m.",
        "Joint A: pin; μ = 0.07, at rest 0.09, R = 0.017 m.",
        "Joint F: slider, along 11°; μ = 0.13, half height = 0.026 m, guide 0.41 m behind and 0.33 m ahead.",
    ]
    links = [
        "2 crank, local axes, in m: O (0, 0); A (0.1, 0); mass 1.2 kg, centre (0.05, 0); inertia 0.01 kg·m².",
        "3 rod, local axes, in m: A (0, 0); B (0.3, 0).",
        "4 block, local axes, in m: B (0, 0); mass 3 kg, centre (0, 0).",
        "1 ground, local axes, in m: O (0, 0).",
    ]
    loads = [
        "P: 50 N ∠ −126.87° on 4 block at B.",
        "M: −2.5 N·m on 3 rod.",
        "s: stiffness 410 N/m, free length 0.173 m, between crank.A and block.B.",
        "t: damping 0.4 N·m·s, in B.",
        "Gravity 9.8 m/s² ∠ −90°.",
    ]
    rough, smooth = (
        Shown(da.dynamics(m.with_values({"friction.enabled": on})), as_stated(None)) for on in (True, False)
    )
    assert stated_lines(rough, 0) == [*links, *joints, *loads]
    assert stated_lines(smooth, 0) == [*links, "Joint F: slider, along 11°.", *loads]
    assert drive_text(rough, 0, "O") == "50°, 3.1 rad/s, −2 rad/s²"


def test_components_in_space_are_rounded_beside_the_largest() -> None:
    """Whatever its sign: what is rounding beside -5 N is 0."""
    shown = Shown(da.statics(da.load(examples()["rssr"])), da.Notation())
    assert vector_text(shown, "force", np.array([1e-14, -5.0, 0.0])) == vector_text(
        shown, "force", np.array([0.0, -5.0, 0.0])
    )
    small = vector_text(shown, "force", np.array([1e-4, -5.0, 0.0]))
    assert "0.0001" in small
