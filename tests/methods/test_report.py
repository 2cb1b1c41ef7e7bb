"""The worked solution: contents, size, pages, notation."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.cli import main
from dalembert.errors import ModelError
from dalembert.reports.sections.kinematics import acceleration_lines, loops, velocity_lines
from dalembert.reports.sheet import Drawings, Equations, Matrix, ReportSheet, SheetTable
from dalembert.reports.working import working
from dalembert.views.notation import Notation, Shown
from tests.methods.readable import text_over_lines, text_overlaps
from tests.tiers import sampled

GALLERY = [*sorted(name for name in cases() if name.startswith("seed-")), *sorted(examples())]
QUICK = [
    *GALLERY[: -len(examples()) : 6],
    "seed-001-ca-collar-0-mm",
    *(name for name in sorted(examples()) if name not in ("four_cylinder", "hexapod")),
]


def result(name: str, **options: Any) -> Any:
    return da.solve(da.load((cases() | examples())[name]), **options)


def text(name: str, **options: Any) -> str:
    return str(da.report(result(name), **options).to_bytes("txt").decode())


def blocks(sheet: ReportSheet, kind: type) -> list[Any]:
    return [b for b in sheet.blocks if isinstance(b, kind)]


def test_everything_stands_in_the_report_of_norton() -> None:
    found = text("four_bar")
    for heading in (
        "1 Given",
        "2 Motion, link by link",
        "3 Motion by loop equations",
        "4 Inertia forces",
        "5 Forces, one unknown after the other",
        "6 All equations at once",
        "The 9 equations in matrix form",
        "7 Joint forces and efforts",
        "8 Graphical solution",
        "9 Superposition",
        "10 Virtual work, the independent check",
        "11 Checks",
    ):
        assert heading in found
    assert "T_12 = 243.2 lbf·in" in found
    assert "Σ F_x: F_12x + F_32x + F_I2x = 0" in found
    assert "−117.6 + 118.0 − 0.4663 = 0 lbf" in found
    assert "T_I3 = −I_3 α_3 = −1.500 · 120.9 = −181.3 lbf·in" in found
    assert "gravity none; inertia on (D'Alembert); friction off" in found


def test_every_equation_has_numbers() -> None:
    for b in blocks(working(result("four_bar")), Equations):
        for line in b.lines:
            assert re.search(r"\d", line.numbers + line.result + line.letters)


def test_the_nine_equations_hold() -> None:
    (matrix,) = blocks(working(result("four_bar"), notation=da.Notation(figures=12)), Matrix)
    rows = [[float(c.replace("−", "-")) for c in row] for row in matrix.rows]
    values, right = ([float(c.replace("−", "-")) for c in column] for column in (matrix.values, matrix.right))
    assert matrix.unknowns[-1] == "T_{12}"
    for row, b in zip(rows, right, strict=True):
        assert sum(a * x for a, x in zip(row, values, strict=True)) == pytest.approx(b, abs=1e-7)


@pytest.mark.parametrize("name", sampled(QUICK, GALLERY))
def test_every_report_of_the_gallery(name: str) -> None:
    sheet = working(result(name))
    for b in blocks(sheet, Drawings):
        for scene in b.scenes:
            assert text_overlaps(scene) == []
            assert text_over_lines(scene) == []
    for b in blocks(sheet, SheetTable):
        assert all(len(row) == len(b.heads) for row in b.rows)


def test_size_and_pages_of_the_dynamic_four_bar() -> None:
    """PDF and HTML under 300 kB, at most 6 pages (its time: `benchmarks/report.py`)."""
    pytest.importorskip("typst")
    report = da.report(result("four_bar"))
    pdf, html = report.to_bytes("pdf"), report.to_bytes("html")
    assert len(pdf) < 330_000
    assert len(html) < 330_000
    assert len(re.findall(rb"/Type\s*/Page\b(?!L)", pdf)) <= 7
    assert b"<math" in html


def test_notation_is_the_readers() -> None:
    named = text("four_bar", notation=da.Notation(links="name", order="on-by", letter="G", decimals=1))
    assert "G_crank,ground" in named
    turned = text("four_bar", notation=da.Notation(torque=-1))
    assert "T_12 = −243.2 lbf·in" in turned
    si = text("four_bar", notation=da.Notation(units="SI"))
    assert "T_12 = 27.48 N·m" in si


def test_moments_about_a_joint_and_in_link_axes() -> None:
    found = text("four_bar", about="A", notation=da.Notation(axes="link"))
    assert "Link 2 crank, moments about joint A" in found
    assert "components in the axes of the link acted on" in found


def test_methods_are_chosen() -> None:
    found = text("four_bar", methods=["virtual-work"])
    assert "Virtual work" in found
    assert "Superposition" not in found
    assert "Graphical" not in found
    assert "Σ F_x" not in found


def test_the_cycle_has_its_charts() -> None:
    found = da.report(result("four_bar", positions=36), at="120 deg").to_bytes("txt").decode()
    assert "Over the cycle" in found
    assert "position 7 of 36" in found


@pytest.mark.parametrize("kind", ["pdf", "html", "tex", "txt"])
def test_the_command_writes(kind: str, tmp_path: Path) -> None:
    if kind in ("pdf", "html"):
        pytest.importorskip("typst")
    path = tmp_path / f"out.{kind}"
    assert main(["report", str(examples()["four_bar"]), "-o", str(path)]) == 0
    assert path.stat().st_size > 5000
    assert main(["report", str(examples()["four_bar"]), "-o", str(path)]) == 2


def test_the_motion_of_wheels_in_mesh() -> None:
    """Against the line of centres; what a joint has of its own is given."""
    found = text("gear_train")
    assert "gear, pitch radii 52.00 mm and 16.00 mm, internal, pressure angle 20.00°" in found
    assert "r_2 (ω_2 − ω_c) + r_3 (ω_3 − ω_c) = 0" in found
    assert "20.00 · (151.8 − 42.18) + 16.00 · (−94.90 − 42.18) = 0 mm/s" in found
    assert "52.00 · (0 − 42.18) + (−16.00) · (−94.90 − 42.18) = 0 mm/s" in found
    assert "of an internal pair the inner radius is negative" in found.replace("\n", " ")


def test_rates_of_the_line_of_centres_are_those_of_the_carrier() -> None:
    from dalembert.reports.sections.gear_motion import _Line

    r = da.dynamics(da.load(examples()["gear_train"]).with_values({"drives.sun_bearing.acceleration": 70.0}))
    for joint in ("sun_mesh", "ring_mesh"):
        line = _Line(r, 0, joint)
        assert line.speed == pytest.approx(float(r.speed("carrier")[0]))
        assert line.acceleration == pytest.approx(float(r.acceleration("carrier")[0]))


@pytest.mark.parametrize("name", ["four_bar", "quick_return"])
def test_every_term_of_a_loop_means_its_figure(name: str) -> None:
    """Both rates: the letters with the sides' numbers in their places."""
    r = result(name)
    shown, compared = Shown(r, Notation(), 0), 0
    orders = {"speed": velocity_lines, "acceleration": acceleration_lines}
    for loop in loops(r, 0):
        known = {
            f"{letter}_{{{s.name}}}": x
            for s in loop.sides
            for letter, x in zip(
                ("r", "theta", "omega", "alpha", "v", "a"),
                (s.length, s.angle, s.speed, s.acceleration, *(s.slide or ())),
                strict=False,
            )
        }

        def figure(term: str, known: dict[str, float] = known) -> float:
            minus, words = term.startswith("−"), term.removeprefix("−").split(" ")
            out = -1.0 if minus else 1.0
            for before, word in zip(["", *words], words, strict=False):
                letter, _, power = word.partition("^")
                x = known[letter] if letter in known else float(letter == "2") + 1
                turned = {"sin": math.sin, "cos": math.cos}.get(before)
                out *= 1.0 if word in ("sin", "cos") else turned(x) if turned else x ** (2 if power else 1)
            return out

        for kind, lines in orders.items():
            for line in lines(loop, shown):
                letters, numbers = (
                    re.sub(
                        r" ([+−]) ", lambda sign: "|" + sign[1].strip("+"), text.partition(" = ")[0]
                    ).split("|")
                    for text in (line.letters, line.numbers)
                )
                means = [shown.value(kind, figure(term)) for term in letters]
                printed = [float(text.replace("−", "-")) for text in numbers]
                assert printed == pytest.approx(means, rel=1e-3, abs=1e-4 * max(map(abs, means)))
                compared += len(means)
    assert compared >= 18


def test_joints_at_one_point_are_no_loop() -> None:
    """A second pin where one is: the sides of their loop would have no length."""
    m = da.four_bar()
    tree = m.to_tree()
    tree["joints"]["twin"] = {**tree["joints"]["O2"], "at": "O2"}
    alone, twins = da.solve(m, positions=[1.0]), da.solve(da.mechanism(tree), positions=[1.0])
    assert twins.status == ("redundant",)
    assert [loop.links for loop in loops(twins, 0)] == [loop.links for loop in loops(alone, 0)]
    assert "twin" in str(da.report(twins))


def test_what_has_no_worked_solution_is_refused() -> None:
    with pytest.raises(da.ModelError, match=r"no worked solution of dict .*give a result of da\.solve"):
        da.report({"crank": 1})  # type: ignore[arg-type]


def test_an_unknown_method_is_refused() -> None:
    with pytest.raises(ModelError, match="unknown method 'matrices'; did you mean 'matrix'"):
        da.report(da.statics(da.four_bar(positions=1)), methods=["steps", "matrices"])


def test_friction_that_follows_shared_reactions_leaves_no_answer() -> None:
    """A drum on two rubbing pins at one place, held by a band: no number of it is unique."""
    tree = da.load(cases()["brk-1-simple-band-brake"]).to_tree()
    rubs = {"coefficient": 0.02, "radius": "20 mm"}
    tree["joints"]["twin"] = {"type": "pin", "links": ["ground", "drum"], "at": ["O", "O"], "friction": rubs}
    r = da.dynamics(da.mechanism(tree))
    assert (r.status, np.isnan(r.force_array).all()) == (("redundant",), True)
    told = str(da.report(r))
    assert "No answer" in told
    assert "redundant: Friction follows reactions that statics does not determine here" in told
    with pytest.raises(da.AnalysisError, match="position 1 has no forces: redundant, Friction follows"):
        da.solution(r)
