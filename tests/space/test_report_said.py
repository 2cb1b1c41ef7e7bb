"""The worked solution in space: what it says, in which notation and formats; friction in figures; both ends at rest."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.model import library
from dalembert.reports.sheet import Matrix, SheetTable
from dalembert.reports.working import working
from dalembert.views.notation import Notation
from tests.methods.space_machines import solved
from tests.space.machines import rssr
from tests.space.printed import adds_up, blocks, close, half_digit, lines, value, words
from tests.space.test_friction import body


def case(name: str) -> Any:
    return da.solve(da.load(cases()[name]))


def text(r: Any, **options: Any) -> str:
    return " ".join(da.report(r, **options).to_bytes("txt").decode().split())


def test_everything_stands_in_the_report_of_the_spatial_four_bar() -> None:
    found = da.report(da.solve(da.load(examples()["rssr"])), at="30 deg").to_bytes("txt").decode()
    for line in (
        "2 Degree of freedom",
        "  F = 6 n − Σ c = 6 · 3 − 16 = 2",
        "  F − spins = 2 − 1 = 1",
        "3 Position and motion",
        "  r_OA + r_AB + r_BC + r_CO = 0",
        "  ω_2 × r_OA + ω_3 × r_AB + ω_4 × r_BC = 0",
        "4 Inertia forces and couples",
        "  F_I3 = −m_3 a_G3 = −0.1106 (−17095, −10880, −12647) / 1000 = (1.891, 1.204, 1.399) N, size 2.643 N",
        "  T_I3' = −(J_3 α_3' + ω_3' × J_3 ω_3') = −((−49.97, 19.17, −54.16) + (0, 0, 0)) "
        "= (49.97, −19.17, 54.16) N·mm",
        "5 Forces, one unknown after the other",
        "6 All equations at once",
        "Link 4 rocker, moments about joint C; R from that point to each force:",
        "  Σ M_Cy: R_Bz F_34x + M_14x' = 0",
        "      (86.99)(−5.418) + 471.3 = 0 N·mm",
        "7 Order of solution",
        "8 Reactions and efforts",
        "Every reaction is unique: equilibrium alone determines it.",
        "  T_12 = 1045 N·mm",
        "9 Superposition",
        "10 Virtual work, the independent check",
        "11 Over the cycle",
        "12 Checks",
    ):
        assert line in found, line


def test_the_gyroscopic_couple_stands_by_itself() -> None:
    found = text(case("sp-04-spinning-disk-on-a-turning-arm"), at=2)
    assert "J_3 α_3' = J_3 (850.8, 0, 0) = (29.72, 0, 0) lbf·in" in found
    assert "ω_3' × J_3 ω_3' = (0, 14.18, 60.00) × J_3 (0, 14.18, 60.00) = (29.72, 0, 0) lbf·in" in found
    assert "−((29.72, 0, 0) + (29.72, 0, 0)) = (−59.45, 0, 0) lbf·in" in found


def test_a_rod_between_two_balls_is_a_two_force_member() -> None:
    """Without weight and inertia; its tension is that of the classes of links."""
    r = da.statics(rssr(**{"gravity": None, "drives.O.position": 0.5}))
    found, tension = text(r), float(da.members(r)["rod"].tension[0])
    assert "Link 3 rod carries the forces of A and B alone: a two-force member, in" in found
    (first, _) = blocks(working(r, 1, ("matrix",), Notation(figures=12)), Matrix)
    assert first.unknowns[0] == "S_{3}"
    assert value(first.values[0]) == pytest.approx(tension, rel=1e-10)
    assert "rocker: 6 equations, 6 unknowns in the line of rod, C; then crank: 6 equations" in found
    assert "inertia off (static)" in found
    assert "Inertia forces" not in found


def test_what_is_redundant_is_named_and_not_solved_step_by_step() -> None:
    sheet = working(da.dynamics(library.bennett(positions=2, determinate=False)), 2)
    said = words(sheet)
    assert "3 of the constraints are redundant, among joints O, A, B, C" in said
    assert "With 3 redundant constraints the links cannot be solved one after the other" in said
    assert "All links: 18 equations with 21 unknowns" in said
    assert "Not unique, because equilibrium alone does not determine them: O (" in said
    assert not blocks(sheet, Matrix)


def test_the_readers_notation() -> None:
    r = solved("rssr")
    found = text(r, at=3, notation=Notation(links="name", order="on-by", letter="G", units="SI"), about="B")
    assert "G_crank,ground" in found
    assert "Link coupler, moments about joint B;" in found
    own = working(r, 3, ("matrix",), Notation(axes="link"))
    for line in lines(own):
        if line.letters.startswith("sum "):
            adds_up(line.numbers)
    with pytest.raises(da.ModelError) as caught:
        da.report(r, notation=Notation(torque=-1))
    assert str(caught.value) == (
        "moments cannot be counted clockwise in space; leave it out: they are positive by the right hand"
    )


@pytest.mark.parametrize("kind", ["pdf", "html", "tex"])
def test_every_format(kind: str, tmp_path: Path) -> None:
    if kind in ("pdf", "html"):
        pytest.importorskip("typst")
    path = tmp_path / f"out.{kind}"
    da.report(case("sp-11-ladder-on-two-rails")).save(path)
    assert path.stat().st_size > 5000


# friction

BEARING = {"coefficient": 0.25, "radius": 0.015, "circle": "sin", "guide": [0.04, 0.1], "thrust_radius": 0.03}
SCREW = {"coefficient": 0.12, "radius": 11e-3, "thread_angle": "15 deg"}
RUBBING: dict[str, tuple[dict[str, Any], list[float], dict[str, Any]]] = {
    "journal": (
        {"type": "revolute", "axis": [0, 0, 1], "friction": BEARING},
        [100, 20, -60],
        {"P": {"position": "30 deg", "speed": "2 rad/s"}},
    ),
    "thrust": (
        {"type": "revolute", "axis": [0, 0, 1], "friction": {"coefficient": 0.25, "thrust_radius": 0.03}},
        [100, 20, -60],
        {"P": {"position": "30 deg", "speed": "-2 rad/s"}},
    ),
    "guide": (
        {"type": "prismatic", "axis": [1, 0, 0], "friction": {"coefficient": 0.2, "guide": [0.05, 0.05]}},
        [0, 30, -40],
        {"P": {"position": 0, "speed": "-1 m/s"}},
    ),
    "sleeve": (
        {"type": "cylindrical", "axis": [1, 0, 0], "friction": {"coefficient": 0.3, "radius": 0.02}},
        [0, 30, -40],
        {
            "slide": {"joint": "P", "freedom": "slide", "position": 0, "speed": "0.05 m/s"},
            "turn": {"joint": "P", "freedom": "turn", "position": 0, "speed": "-4 rad/s"},
        },
    ),
    "screw": (
        {"type": "screw", "axis": [0, 0, 1], "lead": 6e-3, "friction": SCREW},
        [50, 0, -5000],
        {"P": {"freedom": "turn", "position": 0, "speed": "1 rad/s"}},
    ),
}


LAWS = {
    "journal": "r_{P} = R_{P} sin (arctan mu_{P})\nS_{P,1}\nS_{P,2}\n"
    "M_{f12z'} = −(r_{P} S_{P,1} + r_{P} S_{P,2} + mu_{P} R_{t} |F_{12z'}|)",
    "thrust": "M_{f12z'} = mu_{P} R_{t} |F_{12z'}|",
    "guide": "S_{P,1}\nS_{P,2}\nF_{f12x'} = (mu_{P} S_{P,1} + mu_{P} S_{P,2})",
    "sleeve": "S_{P}\np_{x'} = 0.5300, quad p_{t} = −0.8480\n"
    "k_{P} = frac(mu_{P}; (1 + (mu_{P} p_{t})^{2})^{1/2})\n"
    "F_{f12x'} = −k_{P} |p_{x'}| S_{P}\nM_{f12x'} = k_{P} R_{P} |p_{t}| S_{P}",
    "screw": "beta = arctan (frac(l; 2 pi R))\nS_{P,t} = frac(|N_{12x'}|; cos beta cos gamma)\nS_{P}\n"
    "|F_{f12}| = mu_{P} (S_{P,t} + S_{P})\n"
    "F_{f12x'} = −|F_{f12}| sin beta\nM_{f12x'} = −|F_{f12}| R cos beta",
}
"""The lines of the friction law of each, by hand;
p is the part of the slip at 0.05 m/s along, and at 0.02 m times 4 rad/s around."""


def product(numbers: str) -> tuple[float, float]:
    """Value and rounding error of printed products with cosines and sines, and of their sum."""
    minus, inside = numbers.startswith("−"), numbers.removeprefix("−").strip("()")
    total = error = 0.0
    for term in inside.split(" + "):
        factors = []
        for found in re.finditer(r"(cos |sin )?(\d[\d.]*(?:e−?\d+)?)", term):
            turned = {"cos ": math.cos, "sin ": math.sin}.get(found[1] or "")
            number = value(found[2])
            given = (
                len(re.sub(r"\D", "", found[2]).lstrip("0")) < 4
            )  # a number of the file, not a rounded one
            off = 0.0 if given else half_digit(found[2])
            factors.append((turned(math.radians(number)), math.radians(off)) if turned else (number, off))
        size = math.prod(n for n, _ in factors)
        total += size
        error += abs(size) * sum(off / abs(n) for n, off in factors if n)
    return (-total if minus else total), error


@pytest.mark.parametrize("name", list(RUBBING))
def test_friction_in_figures(name: str) -> None:
    """The law's figures give the printed friction, and that is the result's along the joint's axis."""
    joint, load, drives = RUBBING[name]
    r = body(joint, load, [0, 0, 0] if name == "screw" else [0.3, -0.5, 0.2], **drives)
    sheet = working(r)
    axis = r.joint_axes("P")[0, 2 if name in ("journal", "thrust") else 0]
    exact = {"F": float(r.friction_force("P")[0] @ axis), "M": float(r.friction_moment("P")[0] @ axis)}
    last = [line for line in lines(sheet) if re.match(r"[FM]_\{f12[xz]'\} = ", line.letters)]
    assert {line.letters[0] for line in last} == {
        "journal": {"M"},
        "thrust": {"M"},
        "guide": {"F"},
        "sleeve": {"F", "M"},
        "screw": {"F", "M"},
    }[name]
    law = [line.letters for line in lines(sheet) if not re.match("F = |T_|sum |F_{12,d}|F_{z}", line.letters)]
    assert "\n".join(law) == LAWS[name]
    for line in last:
        result = line.result.partition(" ")[0]
        assert close(result, exact[line.letters[0]])
        found, error = product(line.numbers)
        assert found == pytest.approx(value(result), abs=1.1 * error + half_digit(result))
        assert error < 2e-3 * abs(found)
    for line in lines(sheet):
        if line.letters.startswith("sum "):
            adds_up(line.numbers)
    assert "Superposition is refused" in words(sheet)
    assert "Power lost to friction at this position" in [b.caption for b in blocks(sheet, SheetTable)]


def test_at_rest_both_ends_have_their_reactions() -> None:
    joint, load, _ = RUBBING["journal"]
    found = text(body(joint, load, [3, -5, 0], P={"position": "30 deg"}))
    assert "At rest: what friction can hold" in found
    assert "Low end of P, −0.9237 N·m: friction is at its limit in P" in found
    assert "P F_12 −100.0 −20.00 60.00 118.3 M_12 −3.000 5.000 0.9237 5.904" in found
