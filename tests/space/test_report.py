"""The worked solution in space: what is printed is what was computed, and adds up within its printed digits."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import actions
from dalembert.bundled import cases
from dalembert.model import library
from dalembert.reports.report_context import ReportContext
from dalembert.reports.sections.equilibrium_equations import link_equations
from dalembert.reports.sections.sources import virtual_work
from dalembert.reports.sheet import Drawings, Heading, Matrix, ReportSheet, SheetTable
from dalembert.reports.space_sections.space_mobility import degrees_of_freedom
from dalembert.reports.space_sections.space_motion import space_inertia, space_motion
from dalembert.reports.space_sections.space_order import order_and_solution
from dalembert.reports.space_sections.space_reactions import reaction_tables
from dalembert.reports.working import working
from dalembert.views.notation import Notation, Shown
from tests.methods.readable import text_over_lines, text_overlaps
from tests.methods.space_machines import solved
from tests.random_space import random_case
from tests.space.machines import oracle
from tests.space.printed import adds_up, blocks, close, half_digit, lines, table, value, words
from tests.space.test_laws import solved as random_result
from tests.tiers import tiers

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
SOON = ("rssr", "shaft", "hooke", "disk", "ladder", "bennett", "random 1", "random 2")
"""Those of every run of the tests; the others are long."""
_made: dict[str, tuple[Any, int, ReportSheet]] = {}


def made(name: str) -> tuple[Any, int, ReportSheet]:
    """A result, the position shown and its sheet, built once."""
    if name not in _made:
        seed = int(name.removeprefix("random ")) if name.startswith("random") else None
        r = RESULTS[name]() if seed is None else random_result(random_case(seed), inertia=seed % 3 > 0)
        k = min(AT, len(r.status)) - 1
        _made[name] = (r, k, working(r, k + 1) if seed is None else without_drawings(r, k))
    return _made[name]


def without_drawings(r: Any, k: int) -> ReportSheet:
    """The sections with figures of their own."""
    notation = Notation()
    sheet, shown = ReportSheet(""), Shown(r, notation, k)
    c = ReportContext(r, k, shown, notation=notation)
    for section in (degrees_of_freedom, space_motion, space_inertia):
        section(sheet, c)
    for link in r.links:
        sheet.equations(link_equations(r, link, k, shown)[0])
    for section in (reaction_tables, virtual_work):
        section(sheet, c)
    return sheet


RANDOM = [f"random {seed}" for seed in range(60)]


def each(*names: str) -> Any:
    """A test of each of these results, those of SOON in every run."""
    return pytest.mark.parametrize(
        "name", tiers([n for n in names if n in SOON], [n for n in names if n not in SOON])
    )


every = each(*RESULTS, *RANDOM)


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


def carries(joint: Any, axis: str) -> bool:
    """Whether it can carry a force along one of its own axes; teeth along any."""
    return joint.type == "gear" or axis in joint.pair.forces


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
            if not r.mechanism.joints[joint].pair.moments and not np.abs(least[3:]).any():
                assert set(row[6:]) == {"–"}, joint
            for n, cell in enumerate((*row[2:5], *row[7:10])):
                kind = "force" if n < 3 else "moment"
                nothing = shown.value(kind, 1e-8 * scale * (1.0 if n < 3 else r.compiled.layout.length))
                assert close(cell, shown.value(kind, least[n]), nothing), (joint, axes, n)
                if cell != "–":
                    assert cell.startswith("(") == bool(np.isnan(exact[n])), (joint, axes, n)
                elif axes == "joint" and n < 3:
                    assert not carries(r.mechanism.joints[joint], "xyz"[n]), (joint, n)


@every
def test_motion_is_the_result(name: str) -> None:
    r, k, sheet = made(name)
    shown = Shown(r, Notation())
    fastest = max((np.abs(r.speed(n)[k]).max() for n in r.links), default=0.0)
    if not fastest > 1e-12:
        assert not [t for t in sheet.blocks if isinstance(t, SheetTable) and "omega" in "".join(t.heads)]
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
        lead = f"J_{{{n}}} alpha_{{{n}'}}"
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
    sheet, notation = ReportSheet(""), Notation(figures=13)
    order_and_solution(sheet, ReportContext(r, k, Shown(r, notation, k), notation=notation))
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
    power = [b for b in blocks(sheet, SheetTable) if b.heads[0] == "Power put in by"]
    for b in power:
        rows = {row[0]: row[1] for row in b.rows}
        exact = float(r.effort_array[k] @ r.schedule.speed[k])
        unit = Shown(r, Notation())
        assert close(rows["drives"], unit.value("power", exact), 1e-6)
        assert rows["sum"] == "0"
        error = sum(half_digit(text) for text in rows.values())
        assert sum(value(text) for text in rows.values()) == pytest.approx(0.0, abs=1.05 * error)


@each(*RESULTS)
def test_drawings_and_tables_of_a_report(name: str) -> None:
    _, _, sheet = made(name)
    for scene in (s for b in blocks(sheet, Drawings) for s in b.scenes):
        assert text_overlaps(scene) == []
        assert text_over_lines(scene) == []
    for b in blocks(sheet, SheetTable):
        assert all(len(row) == len(b.heads) for row in b.rows)
    for before, after in zip(sheet.blocks, sheet.blocks[1:], strict=False):
        assert not (
            isinstance(before, Heading) and isinstance(after, Heading) and before.level >= after.level
        )
    assert not isinstance(sheet.blocks[-1], Heading)
