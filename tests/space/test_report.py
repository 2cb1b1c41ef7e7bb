"""The worked solution in space: what is printed is what was computed, and adds up within its printed digits."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.actions import actions
from dalembert.bundled import cases, examples
from dalembert.model import library
from dalembert.report.chosen import Chosen
from dalembert.report.sheet import Equations, Figure, Heading, Matrix, Paragraph, Sheet, Table, Working
from dalembert.report.solution import order_and_solution
from dalembert.report.working import working
from dalembert.views.canvas import text_over_lines, text_overlaps
from dalembert.views.notation import Notation, Shown
from tests.methods.space_machines import solved
from tests.space.machines import oracle, rssr
from tests.space.test_friction import body

AT = 3
"""The position shown, from 1."""


def case(name: str) -> Any:
    return da.solve(da.load(cases()[name]))


LIFTED = {"A": "spherical", "B": "cylindrical"}
RESULTS: dict[str, Any] = {
    "rssr": lambda: solved("rssr"),
    "shaft": lambda: solved("shaft"),
    "hooke": lambda: solved("hooke"),
    "disk": lambda: case("sp-04-spinning-disk-on-a-turning-arm"),
    "ladder": lambda: case("sp-11-ladder-on-two-rails"),
    "bennett": lambda: da.dynamics(library.bennett(positions=4, determinate=False)),
    "press": lambda: solved("press"),
    "slider crank": lambda: solved("slider_crank"),
    "lifted": lambda: da.dynamics(da.lifted(da.four_bar(), {"coupler": "20 mm"}), positions=4),
    "lifted free": lambda: da.dynamics(da.lifted(da.four_bar(), {"coupler": "20 mm"}, LIFTED), positions=4),
    "gyroscope": lambda: da.dynamics(oracle("gyroscope")),
    "rccc": lambda: da.dynamics(library.rccc(positions=4)),
    "bevel": lambda: da.dynamics(library.bevel_differential(positions=4)),
    "double cardan": lambda: da.dynamics(library.double_cardan(positions=4)),
}
SOON = ("rssr", "shaft", "hooke", "disk", "ladder", "bennett")
"""Those of every run of the tests; the others are long."""
_made: dict[str, tuple[Any, int, Sheet]] = {}


def made(name: str) -> tuple[Any, int, Sheet]:
    """A result, the position shown and its sheet, built once."""
    if name not in _made:
        r = RESULTS[name]()
        k = min(AT, len(r.status)) - 1
        _made[name] = (r, k, working(r, k + 1))
    return _made[name]


every = pytest.mark.parametrize(
    "name", [n if n in SOON else pytest.param(n, marks=pytest.mark.long) for n in RESULTS]
)


def blocks(sheet: Sheet, kind: type) -> list[Any]:
    return [b for b in sheet.blocks if isinstance(b, kind)]


def lines(sheet: Sheet) -> list[Working]:
    return [line for b in blocks(sheet, Equations) for line in b.lines]


def table(sheet: Sheet, *heads: str) -> Table:
    (found,) = (b for b in blocks(sheet, Table) if b.heads[: len(heads)] == heads)
    assert isinstance(found, Table)
    return found


def words(sheet: Sheet) -> str:
    return " ".join(b.text for b in blocks(sheet, Paragraph))


# numbers as they are printed


def value(text: str) -> float:
    """A printed number, in brackets or not."""
    return 0.0 if text in ("–", "none") else float(text.strip("()").replace("−", "-"))


def half_digit(text: str) -> float:
    """Half a unit of the last digit of a printed number."""
    size, _, power = text.strip("()").replace("−", "-").partition("e")
    if text in ("–", "none") or not float(size):
        return 0.0
    decimals = len(size.partition(".")[2])
    return 0.5 * 10.0 ** (int(power or 0) - decimals)


def close(text: str, exact: float, more: float = 0.0) -> bool:
    """Whether a printed number is a computed one rounded; what is rounding is printed as 0."""
    return abs(value(text) - exact) <= max(1.01 * half_digit(text), 1e-9 * abs(exact), more)


def printed_terms(text: str) -> Iterator[tuple[float, float]]:
    """Value and rounding error of each term of a printed sum: numbers, and products (a)(b)."""
    for sign, term in re.findall(r"(^−|^| − | \+ )((?:\([^)]*\))+|[\d.e−]+)", text):
        factors = re.findall(r"\(([^)]*)\)", term) or [term]
        size = math.prod(value(f) for f in factors)
        error = sum(
            half_digit(f) * math.prod(abs(value(g)) for n, g in enumerate(factors) if n != k)
            for k, f in enumerate(factors)
        )
        yield (-size if "−" in sign else size), error


def adds_up(text: str) -> None:
    """A printed sum is zero within the printed digits of its terms, and its total is printed as 0."""
    left, _, right = text.partition(" = ")
    found = list(printed_terms(left))
    assert found, text
    assert abs(math.fsum(v for v, _ in found)) <= 1.05 * sum(e for _, e in found) + 1e-12, text
    assert right.startswith("0 "), text


@every
def test_equations_and_loops_add_up_as_printed(name: str) -> None:
    r, _, sheet = made(name)
    sums = [line for line in lines(sheet) if line.letters.startswith("sum ")]
    assert len(sums) == 6 * len(r.links)
    for line in sums:
        adds_up(line.numbers)
    for line in lines(sheet):
        if re.match(r"[xyz]: quad", line.letters):
            adds_up(line.letters[8:])


@every
def test_the_figures_in_the_equations_are_those_of_the_result(name: str) -> None:
    """Every sign is given with the number that the result has for it, on that link, in these axes."""
    r, k, sheet = made(name)
    known = signs(r, k)
    seen = set()
    for line in lines(sheet):
        if not line.letters.startswith("sum "):
            continue
        letters = line.letters.partition("quad ")[2].removesuffix(" = 0")
        texts = re.split(r" [−+] ", letters.removeprefix("−"))
        numbers = re.findall(r"(?:\([^)]*\))+|[\d.e−]+", line.numbers.rpartition(" = ")[0].removeprefix("−"))
        numbers = [n for n in numbers if n != "−"]
        for text, number in zip(texts, numbers, strict=True):
            sign = text.split(" ")[-1]
            if sign in known:
                last = re.findall(r"\(([^)]*)\)", number)
                size = last[-1] if last else number
                assert close(size, known[sign], 1e-7) or (not last and close(size, abs(known[sign]), 1e-7)), (
                    line
                )
                seen.add(sign)
    assert len(seen) >= 5 * len(r.links)


def signs(r: Any, k: int) -> dict[str, float]:
    """What the signs of reactions, weights and inertia stand for, in the file's units."""
    shown, out = Shown(r, Notation()), {}
    for joint, described in r.mechanism.joints.items():
        for on in described.links:
            for axes, prime in (("ground", ""), ("joint", "'")):
                whole = r.least_norm(joint, on, axes)[k]
                for n, axis in enumerate("xyz"):
                    parts = (
                        (shown.reaction, "force", whole[n]),
                        (shown.joint_moment, "moment", whole[n + 3]),
                    )
                    for sign, kind, number in parts:
                        index = sign(joint, on)[:-1]
                        comma = "," if "," in index else ""
                        out[f"{index}{comma}{axis}{prime}}}"] = shown.value(kind, number)
    for a in actions(r):
        if a.kind in ("weight", "inertia"):
            turned = a.source.startswith("inertia couple")
            v = a.couple[k] if turned else a.force[k]
            letter = "W_{" if a.kind == "weight" else "T_{I" if turned else "F_{I"
            for n, axis in enumerate("xyz"):
                number = shown.value("moment" if turned else "force", v[n])
                out[f"{letter}{shown.link(a.link)}{axis}}}"] = number
    return out


@every
def test_tables_of_reactions_are_the_result(name: str) -> None:
    """Both tables, component by component; in brackets exactly what is not unique."""
    r, k, sheet = made(name)
    shown = Shown(r, Notation())
    scale = max(np.abs(r.force_array[k]).max(), np.abs(r.moment_array[k]).max() / r.compiled.layout.length)
    for axes, prime in (("ground", ""), ("joint", "'")):
        rows = table(sheet, "Joint", "Force", f"x{prime}").rows
        assert [row[0] for row in rows] == list(r.joints)
        for joint, row in zip(r.joints, rows, strict=True):
            i, j = r.mechanism.joints[joint].links
            on = i if j == "ground" else j
            exact = np.concatenate([f(joint, on, axes)[k] for f in (r.reaction, r.reaction_moment)])
            least = r.least_norm(joint, on, axes)[k]
            for n, cell in enumerate((*row[2:5], *row[7:10])):
                kind = "force" if n < 3 else "moment"
                nothing = shown.value(kind, 1e-8 * scale * (1.0 if n < 3 else r.compiled.layout.length))
                assert close(cell, shown.value(kind, least[n]), nothing), (joint, axes, n)
                if cell != "–":
                    assert cell.startswith("(") == bool(np.isnan(exact[n])), (joint, axes, n)


@every
def test_motion_is_the_result(name: str) -> None:
    r, k, sheet = made(name)
    shown = Shown(r, Notation())
    fastest = max((np.abs(r.speed(n)[k]).max() for n in r.links), default=0.0)
    if not fastest:
        return
    reads = (
        ("omega", "angular_speed", r.speed, 1e-9 * fastest),
        ("alpha", "angular_acceleration", r.acceleration, 1e-9 * fastest**2),
    )
    heads = ["Link"]
    for letter, kind, _, _ in reads:
        heads += [f"${letter}_{{x}}$ ({shown.unit(kind)})", f"${letter}_{{y}}$", f"${letter}_{{z}}$"]
    rows = table(sheet, *heads).rows
    for link, row in zip(r.links, rows, strict=True):
        for n, (_, kind, read, nothing) in enumerate(reads):
            for cell, exact in zip(row[1 + 3 * n : 4 + 3 * n], read(link)[k], strict=True):
                assert close(cell, shown.value(kind, exact), shown.value(kind, nothing)), (link, kind)


def vector(text: str) -> list[str]:
    found = re.search(r"\(([^()]*,[^()]*)\)", text)
    assert found is not None, text
    return found[1].split(", ")


@every
def test_inertia_couples_are_the_sum_of_their_parts(name: str) -> None:
    """-(J alpha + omega x J omega) as printed; in ground axes that of the equations."""
    r, k, sheet = made(name)
    shown, found = Shown(r, Notation()), lines(sheet)
    known = signs(r, k)
    for link in r.links:
        n = shown.link(link)
        lead = f"J_{{{n}}} alpha_{{{n}}}"
        at = next((m for m, line in enumerate(found) if line.letters == lead), None)
        if at is None:
            assert all(abs(known.get(f"T_{{I{n}{a}}}", 0.0)) < 1e-6 for a in "xyz")
            continue
        parts = [vector(line.result) for line in found[at : at + 3]]
        for a, b, total in zip(*parts, strict=True):
            error = half_digit(a) + half_digit(b) + half_digit(total)
            assert value(a) + value(b) + value(total) == pytest.approx(0.0, abs=1.05 * error)
        for cell, axis in zip(vector(found[at + 3].result), "xyz", strict=True):
            assert close(cell, known[f"T_{{I{n}{axis}}}"], 1e-7)


@every
def test_the_matrices_hold(name: str) -> None:
    r, k, _ = made(name)
    sheet, notation = Sheet(""), Notation(figures=13)
    order_and_solution(sheet, Chosen(r, k, Shown(r, notation), notation=notation))
    for matrix in blocks(sheet, Matrix):
        rows = np.array([[value(c) for c in row] for row in matrix.rows])
        x, b = (np.array([value(c) for c in column]) for column in (matrix.values, matrix.right))
        largest = np.abs(rows * x).max(initial=1.0)
        assert rows @ x == pytest.approx(b, abs=1e-9 * largest)
        assert np.linalg.matrix_rank(rows) == len(x)


@every
def test_degree_of_freedom_and_powers(name: str) -> None:
    r, k, sheet = made(name)
    count = table(sheet, "Joint", "Type", "Links")
    constraints, found = int(count.rows[-1][-1]), r.mobility
    passive = len(found.passive)
    assert constraints == sum(int(row[-1]) for row in count.rows[:-1])
    assert 6 * len(r.links) - constraints - passive == found.freedoms - found.redundant
    assert f"Mobility {found.freedoms}" in words(sheet)
    for joint in found.redundant_joints:
        assert joint in words(sheet)
    power = [b for b in blocks(sheet, Table) if b.heads[0] == "Power put in by"]
    for b in power:
        rows = {row[0]: row[1] for row in b.rows}
        exact = float(r.effort_array[k] @ r.schedule.speed[k])
        unit = Shown(r, Notation())
        assert close(rows["drives"], unit.value("power", exact), 1e-6)
        assert rows["sum"] == "0"
        error = sum(half_digit(text) for text in rows.values())
        assert sum(value(text) for text in rows.values()) == pytest.approx(0.0, abs=1.05 * error)


@every
def test_drawings_and_tables_of_a_report(name: str) -> None:
    _, _, sheet = made(name)
    for scene in (s for b in blocks(sheet, Figure) for s in b.scenes):
        assert text_overlaps(scene) == []
        assert text_over_lines(scene) == []
    for b in blocks(sheet, Table):
        assert all(len(row) == len(b.heads) for row in b.rows)
    for before, after in zip(sheet.blocks, sheet.blocks[1:], strict=False):
        assert not (
            isinstance(before, Heading) and isinstance(after, Heading) and before.level >= after.level
        )
    assert not isinstance(sheet.blocks[-1], Heading)


# what is said


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
        "  F_I3 = −m_3 a_G3 = −0.1106 (−17095, −10880, −12647) = (1.891, 1.204, 1.399) N, size 2.643 N",
        "  T_I3 = −(J_3 α_3 + ω_3 × J_3 ω_3) = (49.97, −19.17, 54.16) N·mm, link axes",
        "5 Free bodies and their equations",
        "Link 4 rocker, moments about joint C; R from there to each force:",
        "  Σ M_Cy: R_Bz F_34x + M_14x' = 0",
        "      (86.99)(−5.418) + 471.3 = 0 N·mm",
        "6 Order of solution",
        "7 Reactions and efforts",
        "Every reaction is unique: equilibrium alone settles it.",
        "  T_12 = 1045 N·mm",
        "8 Superposition",
        "9 Virtual work, the independent check",
        "10 Over the cycle",
        "11 Checks",
    ):
        assert line in found, line


def test_the_gyroscopic_couple_stands_by_itself() -> None:
    found = text(case("sp-04-spinning-disk-on-a-turning-arm"), at=2)
    assert "J_3 α_3 = (29.72, 0, 0) lbf·in" in found
    assert "ω_3 × J_3 ω_3 = (29.72, 0, 0) lbf·in" in found
    assert "T_I3 = −(J_3 α_3 + ω_3 × J_3 ω_3) = (−59.45, 0, 0) lbf·in" in found


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
    _, _, sheet = made("bennett")
    said = words(sheet)
    assert "3 of the constraints are redundant, among joints O, A, B, C" in said
    assert "With 3 redundant constraints the links cannot be solved one after the other" in said
    assert "All links: 18 equations with 21 unknowns" in said
    assert "Not unique, as equilibrium alone leaves them open: O (" in said
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


def product(numbers: str) -> tuple[float, float]:
    """Value and rounding error of printed products with cosines and sines, and of their sum."""
    minus, inside = numbers.startswith("−"), numbers.removeprefix("−").strip("()")
    total = error = 0.0
    for term in inside.split(" + "):
        factors = []
        for found in re.finditer(r"(cos |sin )?(\d[\d.]*(?:e−?\d+)?)", term):
            turned = {"cos ": math.cos, "sin ": math.sin}.get(found[1] or "")
            number, off = value(found[2]), half_digit(found[2])
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
    axis = r.joint_axes("P")[0, 2 if name == "journal" else 0]
    exact = {"F": float(r.friction_force("P")[0] @ axis), "M": float(r.friction_moment("P")[0] @ axis)}
    last = [line for line in lines(sheet) if re.match(r"[FM]_\{f12[xz]'\} = ", line.letters)]
    assert {line.letters[0] for line in last} == {
        "journal": {"M"},
        "guide": {"F"},
        "sleeve": {"F", "M"},
        "screw": {"F", "M"},
    }[name]
    for line in last:
        result = line.result.partition(" ")[0]
        assert close(result, exact[line.letters[0]])
        found, error = product(line.numbers)
        assert found == pytest.approx(value(result), abs=1.1 * error + half_digit(result))
    for line in lines(sheet):
        if line.letters.startswith("sum "):
            adds_up(line.numbers)
    assert "Superposition is refused" in words(sheet)


def test_at_rest_both_ends_have_their_reactions() -> None:
    joint, load, _ = RUBBING["journal"]
    found = text(body(joint, load, [3, -5, 0], P={"position": "30 deg"}))
    assert "At rest: what friction can hold" in found
    assert "Low end of P, −0.9237 N·m: friction is at its limit in P" in found
    assert "P F_12 −100.0 −20.00 60.00 118.3 M_12 −3.000 5.000 0.9237 5.904" in found
