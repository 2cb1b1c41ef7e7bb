"""Lines of a loop's position, velocity and acceleration: each term with its letters, sign and number, and their sum."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.analysis.output.rounding import PART
from dalembert.reports.sections import motion
from dalembert.reports.sections.kinematics import (
    Loop,
    LoopVector,
    _degrees,
    _path_to_ground,
    _ring,
    acceleration_lines,
    position_lines,
    velocity_lines,
    zero_sum,
)
from dalembert.reports.sheet import Paragraph, ReportSheet
from dalembert.units import Units
from dalembert.views.notation import Figures, Notation

FIGURES: Any = Figures(None, Notation(figures=6))
ROD = LoopVector("AB", 2.0, math.radians(30), 3.0, -5.0, None)
SLIDE = LoopVector("s,C", -0.7, math.radians(-50), 1.5, 0.0, (0.4, -0.9))
STILL = LoopVector("OA", 1.1, math.radians(200), 0.0, 0.0, None)
SPUN = LoopVector("CO", 0.6, math.radians(100), 0.0, 7.0, None)
LOOP = Loop(("a", "b"), (ROD, SLIDE, STILL, SPUN))


def numbers(text: str) -> list[float]:
    """The signed numbers of a sum, without the one behind its =."""
    terms = text.partition(" = ")[0].replace(" + ", " +").replace(" − ", " −").split(" ")
    return [float(t.replace("−", "-")) for t in terms]


def last(text: str) -> float:
    return float(text.partition(" = ")[2].split(" ")[0].replace("−", "-"))


def test_the_sides_of_a_loop_are_summed_along_both_axes() -> None:
    for line, f, turn in zip(
        position_lines(LOOP, FIGURES), ("cos", "sin"), (math.cos, math.sin), strict=True
    ):
        names = [f"r_{{{s.name}}} {f} theta_{{{s.name}}}" for s in LOOP.sides]
        assert line.letters == " + ".join(names) + " = 0"
        first = f"2.00000 {f} 30.0000 deg − 0.700000 {f} (−50.0000 deg)"
        first += f" + 1.10000 {f} (−160.0000 deg) + 0.600000 {f} 100.0000 deg"
        assert line.numbers.partition(" = ")[0] == first
        total = sum(s.length * turn(s.angle) for s in LOOP.sides)
        assert last(line.numbers) == pytest.approx(total, rel=1e-5)
        assert line.numbers.endswith(' "m"')


def test_a_slide_of_no_length_has_no_minus() -> None:
    none = LoopVector("s,C", -1e-16, 0.0, 0.0, 0.0, (0.0, 0.0))
    shown: Any = Figures(None, Notation())
    shown.least = {"length": 1e-12}
    assert position_lines(Loop((), (ROD, none)), shown)[0].numbers.startswith("2.000 cos 30")
    assert " + 0 cos 0" in position_lines(Loop((), (ROD, none)), shown)[0].numbers


def test_rates_of_a_loop_are_those_of_turning_and_of_sliding() -> None:
    x, y = velocity_lines(LOOP, FIGURES)
    assert x.letters == (
        "−r_{AB} omega_{AB} sin theta_{AB} − r_{s,C} omega_{s,C} sin theta_{s,C} + v_{s,C} cos theta_{s,C} = 0"
    )
    assert y.letters == (
        "r_{AB} omega_{AB} cos theta_{AB} + r_{s,C} omega_{s,C} cos theta_{s,C} + v_{s,C} sin theta_{s,C} = 0"
    )
    a, b = math.radians(30), math.radians(-50)
    across = [-6 * math.sin(a), 1.05 * math.sin(b), 0.4 * math.cos(b)]
    up = [6 * math.cos(a), -1.05 * math.cos(b), 0.4 * math.sin(b)]
    for line, terms in ((x, across), (y, up)):
        assert numbers(line.numbers) == pytest.approx(terms, rel=1e-5)
        assert last(line.numbers) == pytest.approx(sum(terms), rel=1e-5)
        assert line.numbers.endswith('"m/s"')


def test_second_rates_of_a_loop_have_four_parts() -> None:
    x, y = acceleration_lines(LOOP, FIGURES)
    assert x.letters == (
        "−r_{AB} alpha_{AB} sin theta_{AB} − r_{AB} omega_{AB}^{2} cos theta_{AB} − r_{s,C} omega_{s,C}^{2} cos "
        "theta_{s,C} + a_{s,C} cos theta_{s,C} − 2 omega_{s,C} v_{s,C} sin theta_{s,C} − r_{CO} alpha_{CO} sin "
        "theta_{CO} = 0"
    )
    assert y.letters == (
        "r_{AB} alpha_{AB} cos theta_{AB} − r_{AB} omega_{AB}^{2} sin theta_{AB} − r_{s,C} omega_{s,C}^{2} sin "
        "theta_{s,C} + a_{s,C} sin theta_{s,C} + 2 omega_{s,C} v_{s,C} cos theta_{s,C} + r_{CO} alpha_{CO} cos "
        "theta_{CO} = 0"
    )
    a, b, d = math.radians(30), math.radians(-50), math.radians(100)
    across = [
        10 * math.sin(a),
        -18 * math.cos(a),
        0.7 * 2.25 * math.cos(b),
        -0.9 * math.cos(b),
        -1.2 * math.sin(b),
    ]
    up = [
        -10 * math.cos(a),
        -18 * math.sin(a),
        0.7 * 2.25 * math.sin(b),
        -0.9 * math.sin(b),
        1.2 * math.cos(b),
    ]
    for line, terms in ((x, [*across, -4.2 * math.sin(d)]), (y, [*up, 4.2 * math.cos(d)])):
        assert numbers(line.numbers) == pytest.approx(terms, rel=1e-5)
        assert last(line.numbers) == pytest.approx(sum(terms), rel=1e-5)
    assert acceleration_lines(Loop((), (STILL,)), FIGURES) == []
    assert velocity_lines(Loop((), (STILL, SPUN)), FIGURES) == []


def test_what_rounding_leaves_of_a_sum_is_nothing() -> None:
    """Below a billionth of the largest term."""
    for total, shown in ((1.9e-9, "0"), (-1.9e-9, "0"), (2.1e-9, "2.10000e−09"), (-2.1e-9, "−2.10000e−09")):
        line = zero_sum("a + b", "1 − 1", total, 2.0, FIGURES, "length", "/rad")
        assert (line.letters, line.numbers) == ("a + b = 0", f'1 − 1 = {shown} "m/rad"')
    assert _degrees(math.radians(350), FIGURES) == "(−10.0000 deg)"
    assert _degrees(math.radians(-350), FIGURES) == "10.0000 deg"


def test_a_ring_leads_to_a_joint_and_back_without_what_both_ways_share() -> None:
    parent = {"ground": None, "a": ("O", "ground"), "b": ("A", "a"), "c": ("B", "a"), "d": ("Q", "ground")}
    assert _path_to_ground("b", parent) == [("O", "ground", "a"), ("A", "a", "b")]
    assert _path_to_ground("ground", parent) == []
    assert _ring("C", "b", "c", parent) == [("A", "a", "b"), ("C", "b", "c"), ("B", "c", "a")]
    assert _ring("D", "b", "d", parent) == [
        *(("O", "ground", "a"), ("A", "a", "b"), ("D", "b", "d"), ("Q", "d", "ground")),
    ]


# inertia


@pytest.mark.parametrize(
    ("units", "said"),
    [
        (Units(), ""),
        (
            Units(length="mm"),
            "As 1 N is 1000 kg·mm/s², masses times accelerations are divided by 1000. As 1 N·mm is 1000 kg·mm²/s², "
            "moments of inertia times angular accelerations are divided by 1000.",
        ),
    ],
)
def test_units_of_masses_and_forces_are_compared(units: Any, said: str) -> None:
    sheet = ReportSheet("")
    motion.units_of_inertia(sheet, SimpleNamespace(shown=Figures(units, Notation())))  # type: ignore[arg-type]
    texts = [b.text for b in sheet.blocks if isinstance(b, Paragraph)]
    both = (
        "masses times accelerations and moments of inertia times angular accelerations are divided by 1000."
    )
    assert texts == ([] if not said else texts)
    assert all(t == said or t == f"As 1 N is 1000 kg·mm/s², {both}" for t in texts)
    assert bool(texts) is bool(said)


@pytest.mark.parametrize(
    ("share", "positions", "said"),
    [
        (PART, 2, "Inertia could be neglected: no mass is accelerated over the cycle."),
        (math.nan, 1, "Inertia could be neglected: no mass is accelerated."),
        (
            0.0499,
            2,
            "Inertia could be neglected: it accounts for up to 5.0 % of the largest force of A over the cycle.",
        ),
        (0.05, 1, "Inertia must not be neglected: it accounts for up to 5.0 % of the largest force of A."),
    ],
)
def test_the_share_of_inertia_says_whether_it_may_be_left_out(
    share: float, positions: int, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    worst = SimpleNamespace(share=share, quantity="force", of="A")
    other = SimpleNamespace(share=0.7, quantity="force", of="B")
    sheet, c = ReportSheet(""), SimpleNamespace(r=SimpleNamespace(status=("ok",) * positions))
    monkeypatch.setattr(motion, "inertia_shares", lambda r: [worst, other])
    motion.shares(sheet, c)  # type: ignore[arg-type]
    assert sheet.blocks == [Paragraph(said)]
    sheet = ReportSheet("")
    monkeypatch.setattr(motion, "inertia_shares", lambda r: [])
    motion.shares(sheet, c)  # type: ignore[arg-type]
    assert sheet.blocks == []


def inertia_lines(
    torque: int, force: Any, alpha: float, inertia: float = 0.5, units: Any = None
) -> list[Any]:
    m = SimpleNamespace(mass=lambda link: 2.0, inertia=lambda link: inertia)
    displaced = SimpleNamespace(
        force=np.array([[9.0, 9.0], force]),
        couple=np.array([9.0, -inertia * alpha]),
        offset=np.array([9.0, 0.25]),
    )
    r = SimpleNamespace(
        mechanism=m, center_acceleration=lambda link: np.array([[7.0, 7.0], [-x / 2 for x in force]]),
        acceleration=lambda link: np.array([7.0, alpha]),
    )  # fmt: skip
    shown: Any = Figures(units, Notation(torque=torque))
    shown.link, shown.least = lambda link: "3", {"force": 1e-6, "angular_acceleration": 1e-6}
    c: Any = SimpleNamespace(r=r, k=1, shown=shown, notation=shown.notation)
    made: Any = motion
    old = made.displaced_inertia
    made.displaced_inertia = lambda r, link: displaced
    try:
        return motion._inertia_lines(c, "rod")
    finally:
        made.displaced_inertia = old


def test_an_inertia_force_and_couple_are_worked_out() -> None:
    force, couple, offset = inertia_lines(1, (-3.0, 4.0), -6.0)
    assert force.letters == "F_{I3} = −m_{3} a_{G3}"
    assert force.numbers == "−2.000 (1.500, −2.000)"
    assert force.result == '(−3.000, 4.000) = 5.000 "N" angle 126.87 deg'
    assert couple.letters == "T_{I3} = −I_{3} alpha_{3}"
    assert couple.numbers == "−0.5000 cdot (−6.000)"
    assert couple.result == '3.000 "N·m"'
    assert offset.letters == "h_{3} = frac(|T_{I3}|; F_{I3})"
    assert (offset.numbers, offset.result) == ("frac(3.000; 5.000)", '0.2500 "m"')
    _, couple, offset = inertia_lines(-1, (-3.0, 4.0), -6.0)
    assert (couple.letters, couple.numbers) == ("T_{I3} = I_{3} alpha_{3}", "0.5000 cdot (−6.000)")
    assert couple.result == '−3.000 "N·m"'
    assert offset.numbers == "frac(3.000; 5.000)"


@pytest.mark.parametrize(
    ("size", "alpha", "inertia", "count", "turned"),
    [
        (5.0, 0.9e-6, 0.5, 1, True), (5.0, -1.1e-6, 0.5, 3, True), (0.9e-6, 2.0, 0.5, 2, False),
        (1.1e-6, 2.0, 0.5, 3, True),
        (5.0, 2.0, 0.0, 1, True),
    ],
)  # fmt: skip
def test_what_is_rounding_has_no_line(
    size: float, alpha: float, inertia: float, count: int, turned: bool
) -> None:
    lines = inertia_lines(1, (size, 0.0), alpha, inertia)
    assert len(lines) == count
    assert ("angle 0 deg" in lines[0].result) is turned
